// SPDX-License-Identifier: Apache-2.0
#include "dialect/m700/filters.hpp"

namespace nc::m700 {
namespace {

uint16_t whole_cycles(double ms, double cycle_s) { return static_cast<uint16_t>(filter_cycles(ms, cycle_s)); }

/// Acceleration after interpolation. In the normal mode each axis has time constants of its own: linear, exponential, or one behind the other
/// (M700 13.15).
FilterTimes after(const TimeConstants& constants, const FilteredMove& move, double cycle_s) {
  FilterTimes times;
  bool any = false;
  for (unsigned i = 0; i < kMaxAxes; ++i) {
    const bool has = constants.linear_ms[i] > 0 || constants.exponential_ms[i] > 0;
    const bool moves = (move.moving >> i & 1) != 0, limited = (move.limited >> i & 1) != 0;
    if (moves && !has && limited) return {};
    any = any || (moves && has);
    times.mean[i] = whole_cycles(constants.linear_ms[i], cycle_s);
    times.lag_s[i] = static_cast<float>(constants.exponential_ms[i] / 1000);
  }
  if (!any) return {};
  times.kind = FilterTimes::Kind::after;
  times.one_way = move.straight && move.kind != FilteredMove::Kind::cut;
  return times;
}

/// The filters of acceleration before interpolation (M700 13.15 "S-pattern filter control"). They are the same for all axes.
FilterTimes before(double first_ms, double second_ms, double cycle_s) {
  FilterTimes times;
  if (!(first_ms > 0) && !(second_ms > 0)) return times;
  times.kind = FilterTimes::Kind::before;
  for (uint16_t& cycles : times.mean) cycles = whole_cycles(first_ms, cycle_s);
  times.second = whole_cycles(second_ms, cycle_s);
  return times;
}

}  // namespace

FilterTimes filter_times(const FilterParameters& p, const FilteredMove& move, double cycle_s) {
  switch (move.kind) {
    case FilteredMove::Kind::skip:
      return after(p.skip, move, cycle_s);
    case FilteredMove::Kind::rapid: {
      if (p.rapid_before) return before(p.pattern_rapid_ms, p.pattern_second_ms, cycle_s);
      const FilterTimes times = after(p.rapid, move, cycle_s);
      if (times.kind != FilterTimes::Kind::none || !move.high_accuracy) return times;
      return before(p.pattern_rapid_ms, p.pattern_second_ms, cycle_s);  // a move without constants is accelerated before interpolation
    }
    case FilteredMove::Kind::cut:
      break;
  }
  if (move.high_accuracy) return before(p.pattern_cut_ms, p.pattern_second_ms, cycle_s);
  return after(p.cut, move, cycle_s);
}

}  // namespace nc::m700
