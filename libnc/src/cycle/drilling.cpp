// SPDX-License-Identifier: Apache-2.0
#include "cycle/drilling.hpp"

#include <cmath>

namespace nc {
namespace {

using Kind = CycleStep::Kind;

CycleStep rapid(double to) { return {Kind::rapid, to, 0}; }
CycleStep feed(double to) { return {Kind::feed, to, 0}; }
CycleStep dwell(double seconds) { return {Kind::dwell, 0, seconds}; }
CycleStep stop_point() { return {Kind::stop_point, 0, 0}; }

/// Steps 0 and 1 are the same in every cycle: rapid to the R point, and a place where single block stops (M700 13.1.1, "SB: 1, 2").
constexpr uint32_t kFirst = 2;

/// G81 G82 G85 G89: down at feed, dwell where the cycle has one, back at rapid or feed.
CycleStep plain_step(const Hole& h, uint32_t step) {
  const bool dwells = h.kind == CycleKind::spot || h.kind == CycleKind::bore_dwell;
  const bool feeds_back = h.kind == CycleKind::bore_feed || h.kind == CycleKind::bore_dwell;
  switch (step - kFirst) {
    case 0: return feed(h.bottom);
    case 1: return dwells && h.dwell_s > 0 ? dwell(h.dwell_s) : feeds_back ? feed(h.r) : rapid(h.return_to);
    case 2:
      if (dwells && h.dwell_s > 0) return feeds_back ? feed(h.r) : rapid(h.return_to);
      return feeds_back && h.return_to != h.r ? rapid(h.return_to) : CycleStep{};
    case 3: return dwells && h.dwell_s > 0 && feeds_back && h.return_to != h.r ? rapid(h.return_to) : CycleStep{};
    default: return {};
  }
}

/// G83: cut q, back to R, down again to d above the last bottom, cut ... (M700 13.1.1 G83; DGSHAPE G83 with d = 1 mm).
CycleStep peck_step(const Hole& h, HoleProgress& p) {
  const double down = h.bottom < h.r ? -1.0 : 1.0;
  if (p.step == kFirst) p.depth = h.r;
  switch ((p.step - kFirst) % 3) {
    case 0: {  // cut
      if (p.depth == h.bottom) return {};
      const double next = p.depth + down * h.q;
      // The last cut ends at the bottom, shorter if needed; a rest below the resolution is not a peck of its own.
      p.depth = (h.bottom - next) * down <= 1e-9 ? h.bottom : next;
      return feed(p.depth);
    }
    case 1: return rapid(p.depth == h.bottom ? h.return_to : h.r);
    default:
      if (p.depth == h.bottom) return {};
      return rapid(p.depth - down * std::fmin(h.clearance, std::fabs(p.depth - h.r)));
  }
}

/// G73: cut q, dwell, back by m, cut ...
CycleStep chip_break_step(const Hole& h, HoleProgress& p) {
  const double down = h.bottom < h.r ? -1.0 : 1.0;
  if (p.step == kFirst) p.depth = h.r;
  switch ((p.step - kFirst) % 3) {
    case 0: {
      if (p.depth == h.bottom) return {};
      const double next = p.depth + down * h.q;
      p.depth = (h.bottom - next) * down <= 1e-9 ? h.bottom : next;
      return feed(p.depth);
    }
    case 1:
      if (h.dwell_s > 0) return dwell(h.dwell_s);
      ++p.step;
      [[fallthrough]];
    default: return rapid(p.depth == h.bottom ? h.return_to : p.depth - down * h.clearance);
  }
}

}  // namespace

CycleStep next_step(const Hole& hole, HoleProgress& progress) {
  CycleStep step;
  if (progress.step == 0) {
    step = rapid(hole.r);
  } else if (progress.step == 1) {
    step = stop_point();
  } else if (hole.kind == CycleKind::peck) {
    step = peck_step(hole, progress);
  } else if (hole.kind == CycleKind::step) {
    step = chip_break_step(hole, progress);
  } else {
    step = plain_step(hole, progress.step);
  }
  ++progress.step;
  return step;
}

}  // namespace nc
