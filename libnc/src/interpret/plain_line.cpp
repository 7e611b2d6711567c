// SPDX-License-Identifier: Apache-2.0
// The short way for blocks like "G1 X1.5 Y2.0 Z-0.25" in absolute millimetres, as nearly every block of a program from a CAM system is. It does what
// execute_words() does with such a block and leaves every other block to it. So a rule that is added there needs at most a condition here, when it changes
// what these words mean. tests/interpret/plain_line_test.cpp runs random programs both ways.
#include "command/plain_line.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/interpreter.hpp"

namespace nc {
namespace {

/// The modes are such that the axis words of a line are its end point in work coordinates, and nothing else acts in the block.
bool plain_modes(const Interpreter& in) {
  const State& s = in.state;
  const ModalState& m = s.modal;
  return s.special == 0 && s.modal_call == 0 && !s.mapped && !s.parameter_input && s.life_input.kind == LifeInput::Kind::none && s.meeting.kind == MeetingFirst::Kind::none &&
         s.fine_mode == FineMode::none && !s.tool_angles_old && m.is(Function::absolute) &&
         m.is(Function::metric) && m.feed > 0 && !in.code_calls.any && !in.settings.check_cutting && !in.settings.corners_always && !stands_beside(s.comp) && !s.by_hand &&
         (!in.dialect->rules.compensation.begins_beside_start || s.comp.side == 0 || s.moved_side != 0) &&
         (s.unit_used || !in.dialect->rules.block.unit_is_of_program);
}

}  // namespace

bool execute_plain_line(Interpreter& in) {
  State& s = in.state;
  if (s.cycle.kind != CycleKind::none) return false;  // its words mean holes
  const Function before = s.modal.of(Mode::motion);
  PlainLine line;
  if (!read_plain_line(*in.block, in.front, in.settings.last_mm, [&in] { return in.variables.locals(in.macro_level()); }, kLocals, &line)) return false;
  if (!(line.named ? plain_motion(before) : before == Function::linear) || line.axes == 0 || (line.axes & in.rotary) != 0 || !plain_modes(in)) return false;
  in.modal_kept = !line.named || s.modal.holds(in.codes.linear());
  if (!in.modal_kept) s.modal.set(in.codes.linear());
  LinearStyle style;
  style.feed_mm_min = s.modal.feed;
  style.exact_stop = s.modal.is(Function::exact_stop_mode);
  move_linear(in, line.value, line.axes, style);
  s.comp.has_vector = s.comp.cancel_vector = false;
  return true;
}

}  // namespace nc
