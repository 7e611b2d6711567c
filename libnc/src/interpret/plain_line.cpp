// SPDX-License-Identifier: Apache-2.0
// The short way for blocks like "G1 X1.5 Y2.0 Z-0.25" in absolute millimetres, as nearly every block of a program from a CAM system is. It does what
// execute_words() does with such a block and leaves every other block to it. So a rule that is added there needs at most a condition here, when it changes
// what these words mean. tests/interpret/plain_line_test.cpp runs random programs both ways.
#include <cmath>

#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// The modes are such that the axis words of a line are its end point in work coordinates, and nothing else acts in the block.
bool plain_modes(const BlockContext& in) {
  const State& s = in.state;
  const ModalState& m = s.modal;
  return s.special == 0 && s.modal_call == 0 && !s.mapped && !s.parameter_input && s.life_input.kind == LifeInput::Kind::none && s.meeting.kind == MeetingFirst::Kind::none &&
         s.fine_mode == FineMode::none && s.cycle.kind == CycleKind::none && m.is(Function::absolute) &&
         m.is(Function::metric) && m.feed > 0 && !in.code_calls.any && !in.settings.check_cutting;
}

/// The value of a word like X#3, where the local variable is not vacant.
[[gnu::noinline]] bool local_number(const BlockContext& in, uint16_t code, double* number) {
  uint32_t variable = 0;
  if (!lone_variable(*in.block, code, &variable) || variable - 1 >= kLocals) return false;
  *number = in.variables.locals(in.macro_level())[variable - 1];
  return *number == *number;  // NaN = vacant
}

}  // namespace

bool execute_plain_line(BlockContext& in) {
  State& s = in.state;
  const Function before = s.modal.of(Mode::motion);
  bool named = false;
  uint32_t axes = 0;
  AxisVec value;
  for (const Word& word : in.block->words) {
    const unsigned at = address_of(word);
    const int axis = in.axis_of[at];
    if (axis < 0) {  // of the words that are no axis words only G1 is allowed
      if (!in.is(word, Role::code) || word.value != in.codes.linear_number() || (word.flags & ~kWordPoint) != 0) return false;
      named = true;
      continue;
    }
    // A word with a point is in millimetres, whatever the unit of words without a point is; so is a variable.
    double number = word.value;
    if ((word.flags & ~(kWordNegative | kWordPlus)) != kWordPoint && (word.flags != kWordExpression || !local_number(in, word.code, &number)))
      return false;
    if (!(std::fabs(number) <= in.settings.last_mm)) return false;
    if ((axes >> axis & 1) != 0) return false;  // the axis is commanded twice
    axes |= 1u << axis;
    value[static_cast<unsigned>(axis)] = number;
  }
  if (!(named ? plain_motion(before) : before == Function::linear) || axes == 0 || (axes & in.rotary) != 0 || !plain_modes(in)) return false;
  in.modal_kept = !named || s.modal.holds(in.codes.linear());
  if (!in.modal_kept) s.modal.set(in.codes.linear());
  LinearStyle style;
  style.feed_mm_min = s.modal.feed;
  style.exact_stop = s.modal.is(Function::exact_stop_mode);
  move_linear(in, value, axes, style);
  s.comp.has_vector = s.comp.cancel_vector = false;
  return true;
}

}  // namespace nc
