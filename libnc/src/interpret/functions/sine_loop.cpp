// SPDX-License-Identifier: Apache-2.0
// G06 of the Series 8: to and fro between the start of the block and the end that its words give, along a sine, as long as an input is on. The axes
// always end at the start. F is the speed in the middle of the way.
#include <cmath>
#include <numbers>

#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/program_map.hpp"

namespace nc {
namespace {

/// The input that keeps the loop going is the first one that the family has a name for (Series 8: @RUNG6).
bool goes_on(const BlockInHand& in) {
  for (const VariableRow& row : in.dialect->variables->rows)
    if (row.what == SystemVariable::input_bit) return (in.world.input[row.part] & 1) != 0;
  return false;
}

/// The axes that the way moves. A rotation makes more of them than the block has words for.
uint32_t axes_of_way(const BlockInHand& in) {
  const AxisVec from = in.position(), to = target_of_words(in);
  uint32_t axes = 0;
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (std::fabs(to[i] - from[i]) >= 1e-9) axes |= 1u << i;
  return axes;
}

/// Without the first three, which are all that a circle has.
uint32_t beyond_third(uint32_t axes) {
  for (unsigned i = 0; i < 3; ++i) axes &= axes - 1;
  return axes;
}

/// One way there and back, of three axes at most. False: there is no way. The axes go as the shadow of a point that goes round a circle at an even speed, so they turn round without a stop.
bool make_pass(BlockContext& in) {
  const AxisVec from = in.position(), to = target_of_words(in);
  MoveShape shape;
  shape.kind = ShapeKind::sine;
  shape.map = in.state.map;
  SpaceArc& arc = shape.arc;
  arc = SpaceArc{};
  double way = 0;
  unsigned used = 0;
  const uint32_t axes = axes_of_way(in);
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if ((axes >> i & 1) == 0) continue;
    arc.axis[used] = static_cast<uint8_t>(i);
    arc.center[used] = (from[i] + to[i]) / 2;
    arc.e1[used++] = from[i] - to[i];
    way += (to[i] - from[i]) * (to[i] - from[i]);
  }
  way = std::sqrt(way);
  if (!(way / 2 > kNoRadius_mm)) return false;
  for (unsigned i = 0; i < used; ++i) arc.e1[i] /= way;
  for (unsigned i = used, other = 0; i < 3; ++i, ++other) {  // the arc has three axes; the others of it stand
    while ((axes >> other & 1) != 0) ++other;
    arc.axis[i] = static_cast<uint8_t>(other);
    arc.center[i] = other < in.axis_count ? from[other] : 0;
  }
  arc.radius = way / 2;
  arc.sweep = 2 * std::numbers::pi;
  Move& move = emit_shaped(in, frame_of_move(in, from, in.words.target.axes()), shape, NC_MOVE_SPLINE);
  move.exact_stop = true;
  set_modal_feed(in, move, feed_mm_min(in));
  return true;
}

}  // namespace

Execution do_sine_loop(BlockContext& in) {
  const FunctionRow& row = *in.words.one_shot;
  const Command& w = in.words;
  if (w.target.axes() == 0) return in.raise_code(Condition::words_missing, row);
  if ((w.target.axes() & in.rotary) != 0) return in.raise_axis(Condition::illegal_axis, first_of(w.target.axes() & in.rotary));
  if (in.state.compensated()) return in.raise_code(Condition::not_in_compensation, row);
  const Execution did = check_feed(in, Function::linear);
  if (did != Execution::done) return did;
  const uint32_t fourth = beyond_third(axes_of_way(in));
  if (fourth != 0) return in.raise_axis(Condition::illegal_axis, first_of(fourth));
  if (!make_pass(in)) return in.raise_code(Condition::value_range, row);
  in.next_step = Step::loop;
  return Execution::later;
}

Execution continue_sine_loop(BlockContext& in) {
  if (!in.world_fresh) return in.need(NC_SYNC_INPUT);
  if (!goes_on(in)) return Execution::done;
  make_pass(in);
  return in.need(NC_SYNC_INPUT);
}

}  // namespace nc
