// SPDX-License-Identifier: Apache-2.0
// G02.3, G03.3: a linear axis moves exponentially with the angle of a rotary axis (M700 6.11).
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "base/units.hpp"
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kNoWay = 1e-9;

/// The words I, J in degrees, R in mm, F and Q in mm/min.
struct ExponentialWords {
  double taper = 0, torsion = 0, radius = 0, feed = 0, feed_end = 0;
};

Execution angle_word(BlockInHand& in, Role word, double* angle) {
  *angle = length_value(in, in.words.written(word), true, true);
  if (*angle == 0 || std::fabs(*angle) > in.dialect->rules.range.steepest_exponential_deg) return in.raise(Condition::value_range, word, in.words.get(word));
  return Execution::done;
}

Execution take_words(BlockInHand& in, ExponentialWords* words) {
  const Command& w = in.words;
  for (const Role word : {Role::taper_angle, Role::torsion_angle, Role::exponential_radius, Role::feed})
    if (!w.has(word)) return in.raise(Condition::format_error, word);
  Execution did = angle_word(in, Role::taper_angle, &words->taper);
  if (did == Execution::done) did = angle_word(in, Role::torsion_angle, &words->torsion);
  if (did != Execution::done) return did;
  words->radius = length_of(in, Role::exponential_radius);
  if (!(words->radius > 0)) return in.raise(Condition::value_range, Role::exponential_radius, w.get(Role::exponential_radius));
  did = feed_of(in, &words->feed);
  if (did != Execution::done) return did;
  if (!(words->feed > 0)) return in.raise(Condition::value_range, Role::feed, w.get(Role::feed));
  const double unit = in.state.modal.is(Function::inch) ? kMillimetresPerInch : 1.0;
  words->feed *= unit;
  words->feed_end = words->feed;
  if (w.has(Role::exponential_end_feed)) {
    words->feed_end = w.get(Role::exponential_end_feed) * unit;
    if (!(words->feed_end > 0) || words->feed_end > in.dialect->rules.number.largest_feed_mm) return in.raise(Condition::value_range, Role::exponential_end_feed, w.get(Role::exponential_end_feed));
  }
  return Execution::done;
}

Execution check_modes(BlockInHand& in) {
  const State& state = in.state;
  if (state.high_speed == SpeedMode::accuracy_2) return in.raise_mode(Condition::illegal_g, Mode::motion);
  const bool length_starts = state.length_value != 0 && in.words.any({Role::length_number});
  if (!state.modal.is(Function::scaling_off) || state.any_mirror() != 0 || !state.modal.is(Function::rotation_off) || state.work_turned || state.comp.side != 0 || length_starts ||
      state.frame[state.depth].figure != 0)
    return in.raise(Condition::exponential_mode);
  return Execution::done;
}

}  // namespace

Execution move_exponential(BlockContext& in, const AxisVec& target, uint32_t commanded, bool negative) {
  Execution did = check_modes(in);
  if (did != Execution::done) return did;
  ExponentialWords words;
  did = take_words(in, &words);
  if (did != Execution::done) return did;
  const WordSlot linear_name = in.settings.exponential_linear, rotary_name = in.settings.exponential_rotary;
  const int linear = in.axis_words.axis(linear_name), rotary = in.axis_words.axis(rotary_name);
  if (linear < 0 || rotary < 0 || ((in.rotary >> linear) & 1) != 0 || ((in.rotary >> rotary) & 1) == 0) return in.raise(Condition::exponential_axes);
  const auto x = static_cast<unsigned>(linear), c = static_cast<unsigned>(rotary);
  MoveFrame frame = frame_of_move(in, target, commanded);
  const double way = frame.end[x] - frame.start[x];
  if (((commanded >> x) & 1) == 0 || std::fabs(way) < kNoWay || ((commanded >> c) & 1) != 0) {
    LinearStyle style;  // the move is a straight line at the F of the block
    const bool inch = in.state.modal.is(Function::inch);
    style.feed_mm_min = inch ? words.feed / kMillimetresPerInch * feed_unit(in, frame.start, frame.end) : words.feed;  // 3.2 note 6
    move_linear(in, target, commanded, style);
    return Execution::done;
  }
  // x = r (e^(t/D) - 1) / tan i, D = tan j / tan i, so t = D ln(x tan i / r + 1).
  const double tan_i = std::tan(words.taper / kDegrees), tan_j = std::tan(words.torsion / kDegrees);
  const double argument = way * tan_i / words.radius + 1;
  if (!(argument > 0)) return in.raise(Condition::exponential_mode);  // the curve does not reach the end point
  const double d = tan_j / tan_i, turn = d * std::log(argument);
  const double sign = turn < 0 ? -1 : 1, sense = negative ? -1 : 1;
  MoveShape shape;
  shape.kind = ShapeKind::exponential;
  shape.map = in.state.map;
  shape.exponential = Exponential{words.radius / tan_i, d * sign, turn * sign, sense * sign * kDegrees, static_cast<uint8_t>(x),
                                  static_cast<uint8_t>(c)};
  frame.end[c] = frame.start[c] + sense * turn * kDegrees;
  Move& move = emit_shaped(in, frame, shape, NC_MOVE_EXPONENTIAL);
  move.feed_mm_min = words.feed;  // it is per minute, also in G95, and does not become modal
  move.feed_end = static_cast<float>(words.feed_end);
  return Execution::done;
}

}  // namespace nc
