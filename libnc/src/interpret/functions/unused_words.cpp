// SPDX-License-Identifier: Apache-2.0
// Words that no code of their block takes. LinuxCNC makes each of them an error, with the list of the codes that would take it; other families pass over them.
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// What the fixed cycle of the block takes (RS-274/NGC 3.5.16, LinuxCNC G73, G74).
WordSet words_of_cycle(const BlockContext& in, Function cycle) {
  WordSet words = in.set_of({Role::cycle_level, Role::cycle_count});
  switch (cycle) {
    case Function::cycle_peck:
    case Function::cycle_step: return words | in.set_of({Role::cycle_depth_step});
    case Function::cycle_back_bore: return words | in.set_of({Role::vector_x, Role::vector_y, Role::vector_z});
    case Function::cycle_spot:
    case Function::cycle_tap:
    case Function::cycle_reverse_tap:
    case Function::cycle_bore_stop:
    case Function::cycle_bore_stop_dwell:
    case Function::cycle_bore_dwell: return words | in.set_of({Role::cycle_dwell});
    default: return words;
  }
}

/// What the motion, the cycle or the one-shot function of the block takes beside the axes.
WordSet words_of_motion(const BlockContext& in) {
  const Command& w = in.words;
  if (w.one_shot != nullptr) {
    switch (w.one_shot->function) {
      case Function::dwell: return in.set_of({Role::dwell_time});
      case Function::data_input:  // its kinds that are not built have further words, and alarms that say so
        return in.set_of({Role::input_kind, Role::input_number, Role::input_amount, Role::vector_x, Role::vector_y, Role::cycle_depth_step});
      default: return 0;
    }
  }
  if (w.cycle != nullptr) return w.cycle->function != Function::cycle_off ? words_of_cycle(in, w.cycle->function) : 0;
  if (in.state.cycle.kind != CycleKind::none && w.motion == nullptr) return words_of_cycle(in, in.state.modal.of(Mode::cycle));
  const Function motion = in.state.modal.of(Mode::motion);
  if (motion == Function::thread) return in.set_of({Role::thread_lead});
  return is_arc(motion) ? in.set_of({Role::vector_x, Role::vector_y, Role::vector_z, Role::arc_radius, Role::arc_turns}) : 0;
}

WordSet words_of_mode(const BlockContext& in, Function function) {
  switch (function) {
    case Function::comp_left:
    case Function::comp_right: return in.set_of({Role::offset_number});
    case Function::length_plus: return in.set_of({Role::length_number});
    case Function::surface_on: return in.set_of({Role::clamp_highest});
    case Function::cutting_mode: return in.set_of({Role::arc_turns, Role::cycle_depth_step});  // P Q of LinuxCNC G64
    default: return 0;
  }
}

WordSet words_of_misc(const BlockContext& in, MiscFunction function) {
  switch (function) {
    case MiscFunction::override_of_one: return in.set_of({Role::override_switch});
    case MiscFunction::machine_output: return in.set_of({Role::output_number});
    case MiscFunction::machine_input: return in.set_of({Role::output_number, Role::word_number, Role::input_wait, Role::input_limit});
    case MiscFunction::machine_value: return in.set_of({Role::word_number, Role::word_value});
    case MiscFunction::tool_number: return in.set_of({Role::named_tool});
    case MiscFunction::spindle_oriented: return in.set_of({Role::orient_angle, Role::cycle_dwell, Role::cycle_depth_step});  // R P Q of LinuxCNC M19
    default: return 0;
  }
}

}  // namespace

Execution check_unused_words(BlockContext& in) {
  const Command& w = in.words;
  const WordSet all = in.set_of({Role::offset_number, Role::length_number, Role::vector_x, Role::vector_y, Role::vector_z, Role::arc_radius, Role::arc_turns,
                                 Role::cycle_depth_step, Role::cycle_count}) & ~in.axis_words.all();
  if (!w.any(all)) return Execution::done;
  WordSet used = words_of_motion(in);
  for (const FunctionRow* row : w.functions) used |= words_of_mode(in, row->function);
  for (const Auxiliary& m : w.auxiliary) used |= words_of_misc(in, m.function);
  const WordSet unused = w.present & all & ~used;
  return unused == 0 ? Execution::done : in.raise_first(Condition::illegal_address, unused);
}

}  // namespace nc
