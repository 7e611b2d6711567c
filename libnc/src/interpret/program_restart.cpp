// SPDX-License-Identifier: Apache-2.0
// Program restart (HX 2.3.4): a start behind a reset goes on with the block that the reset has stopped, in the modes and with the feed that were in force. That
// block is executed anew from where the machine stands then: an absolute word goes to its place, an increment counts from there. Stopped in the middle of a
// block that is no straight line, that is an alarm.
//
// What ends with a reset in spite of that are the modes that need the blocks in front: radius compensation, cycles, modal calls, maps of the axes. Going on
// in the middle of these would cut beside the path, so there the program begins at its head, as it does without the parameter.
#include "command/words_of_block.hpp"
#include "interpret/interpreter.hpp"

namespace nc {

bool Interpreter::may_begin_here() const {
  if (mdi || ended || state.end_seen || state.repeat.active || state.owes_mark) return false;
  if (state.compensated() || state.moved_side != 0 || !state.modal.is(Function::cycle_off)) return false;
  if (state.map.active() || state.spline.on || state.nurbs.active() || state.arc_step != ArcStep::none || state.meeting.kind != MeetingFirst::Kind::none) return false;
  if (state.parameter_input || state.life_input.kind != LifeInput::Kind::none) return false;
  if (state.interrupt_depth != 0 || state.codes_left != 0) return false;
  for (unsigned level = 0; level <= state.depth; ++level) {
    const CallFrame& frame = state.frame[level];
    if (frame.modal_call != 0 || frame.modal_slot != 0 || frame.figure != 0) return false;
    if (frame.origin == CallOrigin::interrupt || frame.origin == CallOrigin::mdi) return false;
  }
  return true;
}

void Interpreter::keep_place(bool stands) {
  if (!settings.stays_behind_reset || !stands) return forget_place();
  // Nothing has been executed since the place was kept: it stays. Nor since the head of the program: where the machine was stopped in the first block, it is the place.
  if (state.seq == 0 && (place_.kept || !feeding)) return;
  place_.kept = may_begin_here();
  if (!place_.kept) return;
  place_.head = state.seq == 0;
  place_.stack = state;
  place_.machine = state.machine;
}

/// A corner lies on the line from the beginning of its block. Who stands beside that line, as on the arc or the chamfer itself, or nearer to its end than the
/// corner is large, does not come to this corner any more: the line from there would have another one, or none (HX 4.3).
static bool comes_to_its_corner(const Interpreter& in, const Move& line, const AxisVec& stands) {
  constexpr double kBeside_mm = 1e-4;  // an axis at rest on its line is nearer to it
  double whole = 0, left = 0, along = 0;  // squares of the line as it was and as it is now, and their product
  for (unsigned i = 0; i < in.axis_count; ++i) {
    const double to_go = line.end[i] - line.start[i];
    const double was = to_go + stands[i] - in.began_at()[i];
    whole += was * was;
    left += to_go * to_go;
    along += was * to_go;
  }
  const bool beside = !(whole > 0) || along < 0 || left - along * along / whole > kBeside_mm * kBeside_mm;
  return !beside && left >= line.corner_mm * line.corner_mm;
}

/// The block is a plain straight line. From where the axes stand now an arc would have another centre, and a cycle would take the height in the hole for its
/// initial level.
static bool is_straight(const Interpreter& in) {
  const Function motion = motion_behind(*in.block, in.front, in.state.modal.of(Mode::motion));
  return (motion == Function::linear || motion == Function::rapid) && in.words.one_shot == nullptr && in.words.cycle == nullptr;
}

/// What the block has become leads from where the axes stand to where it did before. An increment that is gone anew would end beside the part by what had been
/// made of it.
static bool leads_there(const Interpreter& in, const AxisVec& stands, Execution did) {
  // At the end of a chamfer the axes may stand where the words of the block lead: from there they are no line, and have no corner.
  if (did == Execution::fault) return in.fault.condition != Condition::corner_short;
  for (unsigned i = 0; i < in.queue.size(); ++i) {
    const Item& item = in.queue[i];
    if (item.kind != ItemKind::move) continue;
    if (in.words.target.incremental() != 0 || (item.move.corner != Corner::none && !comes_to_its_corner(in, item.move, stands))) return false;
  }
  return true;
}

Execution execute_begun_inside(Interpreter& in) {
  if (!is_straight(in)) return in.raise(Condition::not_accepted);
  const AxisVec stands = in.state.machine;
  const Execution did = execute_read_words(in);
  return leads_there(in, stands, did) ? did : in.raise(Condition::not_accepted);
}

}  // namespace nc
