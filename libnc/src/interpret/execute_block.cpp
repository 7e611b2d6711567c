// SPDX-License-Identifier: Apache-2.0
// The order in which the words of one block act (M700 App.2, docs/architecture.md "One block"):
//
//   1. modes that say how words are read: G90/G91, G20/G21, planes, feed mode, return level
//   2. F; coordinate systems; radius and length compensation
//   3. S, T, second auxiliary function, M codes
//   4. the one-shot function, or the fixed cycle, or the motion in force
//   5. M00 M01 M02 M30 M98 M99
#include <algorithm>

#include "base/units.hpp"
#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/interpreter.hpp"
#include "interpret/plane.hpp"
#include "interpret/work_rotation.hpp"

namespace nc {
namespace {

bool has_own_feed(const InForce& in, Function motion) {
  const AddressTable& addresses = in.dialect->addresses;
  const bool lead = motion == Function::thread && addresses.same(Role::thread_lead, Role::feed);
  return lead || is_exponential(motion);
}

/// The F of a skip block or of a measurement belongs to that block only and does not become modal (M700 15.2).
bool keeps_its_feed(const InForce& in, Function one_shot) {
  const AddressTable& addresses = in.dialect->addresses;
  if (one_shot == Function::dwell && addresses.same(Role::dwell_time, Role::feed)) return true;  // Series 8 G04 F
  return (is_skip(one_shot) && !in.dialect->rules.skip.feed_is_modal) || one_shot == Function::measure_length;
}

/// The D of the block is not for radius compensation: it is a range (M700 15.1), or the offset number of one circle (13.10 (3)), or of a cavity.
bool keeps_its_offset_number(const FunctionRow* one_shot) {
  if (one_shot != nullptr && cuts_cavity(one_shot->function)) return true;
  return one_shot != nullptr && (one_shot->function == Function::measure_length || cuts_circle(one_shot->function));
}

/// The H of the block is not the number that the length is compensated by: it is that of the offset that is measured (M700 15.1, P605), or of G45 to G48
/// (12.2 (2)(e), example 3).
bool keeps_its_length_number(const Dialect& dialect, const FunctionRow* one_shot) {
  if (one_shot == nullptr) return false;
  return one_shot->function == Function::measure_length || (offsets_position(one_shot->function) && dialect.rules.length.position_offset_has_number);
}

/// E is the lead of a thread (M700 6.7) or an argument of a macro. Elsewhere a text like X1E-05 would be X1 and a word E that is ignored, so it is an alarm.
/// In a thread block it is one, too, when E has a sign, or is a small letter directly behind another number (Z1e1).
Execution check_lead_word(Interpreter& in) {
  const Command& w = in.words;
  if (w.has(Role::word_number) && !takes_word_number(in)) return in.raise(Condition::exponent, Role::word_number, w.get(Role::word_number));
  if (!w.has(Role::fine_thread_lead)) return Execution::done;
  const bool thread = in.state.modal.is(Function::thread) && w.one_shot == nullptr && w.cycle == nullptr;
  const bool exponent = w.written(Role::fine_thread_lead).has_sign_or_exponent();
  const bool ridges = in.dialect->addresses.same(Role::tap_ridges, Role::fine_thread_lead) && taps_with_spindle(in);
  return (thread || ridges) && !exponent ? Execution::done : in.raise(Condition::exponent, Role::fine_thread_lead, w.get(Role::fine_thread_lead));
}

/// M700 App.2: a code of radius or length compensation beside this one-shot function is ignored. G49 beside a reference return is not (12.2), and where
/// nothing is passed over it is beside none.
bool ignores_compensation(const Dialect& dialect, const FunctionRow* one_shot, const FunctionRow& modal) {
  if (one_shot == nullptr) return false;
  if (modal.function == Function::length_off && (is_reference_move(one_shot->function) || dialect.rules.block.unused_words_are_faults)) return false;
  const PrecedenceRow& beside = precedence_of(dialect, one_shot->function);
  return (mode_of(modal.function) == Mode::length ? beside.length : beside.radius) == Precedence::ignored;
}

bool ignores_cycle(const Dialect& dialect, const FunctionRow* one_shot) { return one_shot != nullptr && precedence_of(dialect, one_shot->function).cycle == Precedence::ignored; }

/// M700 App.2, column G66 G67: a one-shot function, a cycle or a mirror beside G67 is not executed where the table says so.
Execution drop_beside_cancel(Interpreter& in) {
  Command& w = in.words;
  for (const FunctionRow* row : w.functions) {
    if (row->function != Function::macro_modal_off) continue;
    const bool one_shot = w.one_shot != nullptr && precedence_of(*in.dialect, w.one_shot->function).macro == Precedence::loses;
    const bool cycle = w.cycle != nullptr && w.cycle->function != Function::cycle_off && precedence_of(*in.dialect, row->function).cycle == Precedence::ignored;
    if (in.dialect->rules.block.unused_words_are_faults && (one_shot || cycle)) return in.raise_code(Condition::illegal_address, one_shot ? *w.one_shot : *w.cycle);
    if (one_shot) w.one_shot = nullptr;
    if (cycle) w.cycle = nullptr;
    if (one_shot || (cycle && w.one_shot == nullptr)) w.present &= ~in.axis_words.all();  // the axis words belong to it and are dropped, too
    break;
  }
  return Execution::done;
}

/// LinuxCNC G20, G21: the feed in force is as fast in the new unit as it was. A feed in inverse time has none.
void keep_speed(InForce& in, Function unit) {
  if (!in.dialect->rules.block.unit_keeps_speed || in.state.modal.is(unit) || in.state.modal.is(Function::inverse_time_feed)) return;
  double& feed = in.state.modal.feed;
  feed = unit == Function::inch ? feed / kMillimetresPerInch : feed * kMillimetresPerInch;
}

}  // namespace

/// Step 1: modes that decide how other words are read.
Execution apply_reading_modes(Interpreter& in) {
  in.block_starts_incremental = in.state.modal.is(Function::incremental);
  in.distance_by_word = false;
  const Function feed_mode = in.state.modal.of(Mode::feed), cutting = in.state.modal.of(Mode::cutting);
  for (const FunctionRow* row : in.words.functions) {
    switch (row->function) {
      case Function::absolute:
      case Function::incremental:
        in.state.modal.set(*row);
        in.distance_by_word = in.dialect->rules.block.distance_by_word;
        break;
      case Function::plane_xy:
      case Function::plane_zx:
      case Function::plane_yz: {
        const Execution did = select_plane(in, *row);
        if (did != Execution::done) return did;
        break;
      }
      case Function::inch:
      case Function::metric:
        keep_speed(in, row->function);
        in.state.modal.set(*row);
        break;
      case Function::feed_per_minute:
      case Function::feed_per_revolution:
      case Function::inverse_time_feed:
      case Function::return_initial:
      case Function::return_r:
      case Function::rapid:
      case Function::linear:
      case Function::arc_cw:
      case Function::arc_ccw:
      case Function::spiral_cw:
      case Function::spiral_ccw:
      case Function::exponential_positive:
      case Function::exponential_negative:
      case Function::space_arc_first:
      case Function::space_arc_second:
      case Function::nurbs:
      case Function::thread:
      case Function::probe:
      case Function::probe_try:
      case Function::probe_away:
      case Function::probe_away_try:
      case Function::normal_line_off:
      case Function::centre_incremental:
      case Function::centre_absolute:
      case Function::high_speed_on:
      case Function::high_speed_off:
        in.state.modal.set(*row);
        break;
      case Function::stroke_check_off:
        if (in.words.one_shot != nullptr && in.words.one_shot->function == Function::holes_on_grid) break;  // M700 13.2, G37.1 note 5
        in.state.modal.set(*row);
        in.state.stroke_box = 0;
        break;
      case Function::exact_stop_mode:
      case Function::corner_override:
      case Function::tapping_mode:
      case Function::cutting_mode:
      case Function::high_accuracy_mode: {
        const Execution did = check_cutting_code(in, *row);
        if (did != Execution::done) return did;
        in.state.modal.set(*row);
        in.state.refresh_accuracy();
        break;
      }
      case Function::macro_modal_off: cancel_modal_call(in); break;
      case Function::scaling_off: end_scaling(in); break;
      case Function::rotation_off: end_rotation(in); break;
      case Function::polar_command_on:
      case Function::polar_command_off: {
        const Execution did = select_polar_command(in, *row);
        if (did != Execution::done) return did;
        in.state.refresh_special();
        break;
      }
      default: break;
    }
  }
  if (!in.state.modal.is(cutting)) change_cutting_mode(in, cutting);
  return !in.state.modal.is(feed_mode) ? change_feed_mode(in, feed_mode) : Execution::done;
}

namespace {

/// Step 2: coordinate systems and compensation.
Execution apply_systems(Interpreter& in) {
  for (const FunctionRow* row : in.words.functions) {
    Execution did = Execution::done;
    switch (row->function) {
      case Function::work_system:
      case Function::extended_system: did = select_work_system(in, *row); break;
      default: break;
    }
    if (did != Execution::done) return did;
  }
  const FunctionRow* one_shot = in.words.one_shot;
  const FunctionRow* radius = nullptr;
  in.words.comp_command = false;
  const FunctionRow* length = nullptr;
  for (const FunctionRow* row : in.words.functions) {  // the last code of a group counts (M700 3.7, DGSHAPE 1)
    const Mode mode = mode_of(row->function);
    if (mode != Mode::radius && mode != Mode::length) continue;
    if (!ignores_compensation(*in.dialect, one_shot, *row)) {
      (mode == Mode::radius ? radius : length) = row;
    } else if (in.dialect->rules.block.unused_words_are_faults && !(row->function == Function::comp_off && in.state.modal.is(row->function))) {
      return in.raise_code(Condition::illegal_address, *row);  // what follows would be cut without it
    }
  }
  if (radius != nullptr) {
    in.state.modal.set(*radius);
    const bool before = in.state.compensated();
    const Execution did = set_compensation(in, radius->function);
    in.words.comp_command = before || in.state.compensated();
    if (did != Execution::done) return did;
  } else if (in.state.space.on && gives_space_vector(in)) {
    const Execution did = change_space_vector(in);
    if (did != Execution::done) return did;
  } else if (in.words.has(Role::offset_number) && gives_length_in_cycle(in)) {
    const Execution did = take_length_in_cycle(in);
    if (did != Execution::done) return did;
  } else if (in.words.has(Role::offset_number) && !keeps_its_offset_number(one_shot) && !limits_surface_speed(in)) {
    const Execution did = change_radius(in);
    if (did != Execution::done) return did;
  }
  if (length != nullptr) {
    in.state.modal.set(*length);
    return set_length(in, length->function);
  }
  const bool own_number = in.words.has(Role::length_number) && in.dialect->rules.length.number_in_any_block;
  return own_number && !in.words.meeting && !keeps_its_length_number(*in.dialect, one_shot) ? change_length(in) : Execution::done;
}

/// The cycle of the block is made although a motion stands in it, too (CycleBeside).
bool cycle_counts(const BlockInHand& in) {
  const Command& w = in.words;
  if (w.cycle == nullptr || w.cycle->function == Function::cycle_off) return false;
  switch (in.dialect->rules.cycle.beside) {
    case CycleBeside::motion:
    case CycleBeside::fault: return false;
    case CycleBeside::cycle: return true;
    case CycleBeside::last: break;
  }
  bool counts = false;
  for (const FunctionRow* row : w.functions) {
    if (row == w.cycle) counts = true;
    if (row == w.motion) counts = false;
  }
  return counts;
}

/// M700 App.2: codes of length compensation and of work systems before a macro call only become modal. So do motions, which end a fixed cycle (13.1.1 (4)).
Execution update_beside_call(Interpreter& in) {
  const PrecedenceRow& beside = precedence_of(*in.dialect, in.words.one_shot->function);
  if (in.words.motion != nullptr && !cycle_counts(in)) cancel_cycle(in);
  for (const FunctionRow* row : in.words.functions) {
    Execution did = Execution::done;
    if (row->function == Function::work_system && beside.work == Precedence::modal) did = select_work_system(in, *row);
    if (mode_of(row->function) == Mode::length && beside.length == Precedence::modal) {
      in.state.modal.set(*row);
      did = set_length(in, row->function);
    }
    if (did != Execution::done) return did;
  }
  return Execution::done;
}

/// Step 4: the one-shot function, the fixed cycle, or the motion.
Execution execute_motion(Interpreter& in) {
  const Command& w = in.words;
  if ((w.target.axes() & in.rotary) != 0 && (w.one_shot == nullptr || goes_to_position(w.one_shot->function))) {
    const Execution did = check_index_positions(in);
    if (did != Execution::done) return did;
  }
  if (in.state.work_turned && (w.target.axes() != 0 || w.any({Role::vector_x, Role::vector_y, Role::vector_z, Role::arc_radius}))) {
    const Execution did = check_work_rotation(in);
    if (did != Execution::done) return did;
  }
  return w.meeting ? move_to_meet(in) : execute_motion_of_words(in);
}

}  // namespace

namespace {

/// Series 8: a function with places of its own beside the code of a cycle. I J K would be words of both, and only one of them would be executed.
bool has_places_of_its_own(Function f) { return f == Function::holes_on_frame_ccw || f == Function::holes_on_frame_cw || cuts_cavity(f) || f == Function::sine_loop; }

/// The hole of the block is made with this function in it: single-direction positioning (M700 6.8, HX 4.2), and position offset, which does not count
/// for a cycle (M700 12.6).
bool makes_holes_beside(const BlockInHand& in, Function f) {
  const bool ends = in.words.cycle->function == Function::cycle_off;
  return !ends && (f == Function::unidirectional || (offsets_position(f) && !in.dialect->rules.compensation.bars_position_offset));
}

/// A code of the group of cycles beside a function that has the words of the block. The code that ends a cycle needs none, and acts. That of a cycle
/// would drill at the places of the other function, or the other one would be left out; M700 App.2 says of some that the cycle is.
Execution take_cycle_beside(BlockContext& in, const FunctionRow& one_shot) {
  const FunctionRow& cycle = *in.words.cycle;
  if (cycle.function == Function::cycle_off) {
    cancel_cycle(in);
    in.state.modal.set(cycle);
    return Execution::done;
  }
  if (has_places_of_its_own(one_shot.function)) return in.raise_code(Condition::format_error, one_shot);
  if (in.dialect->rules.block.unused_words_are_faults) return in.raise_code(Condition::illegal_address, cycle);
  return ignores_cycle(*in.dialect, &one_shot) ? Execution::done : in.raise_code(Condition::format_error, one_shot);
}

/// LinuxCNC, modal groups: G38.2 to G38.5 stay in force, so axis words without a code of a motion probe once more. They are executed as one-shot functions.
Execution take_probing(BlockInHand& in) {
  Command& w = in.words;
  if (!is_probing(in.state.modal.of(Mode::motion))) return Execution::done;
  if (w.motion != nullptr) {
    if (w.one_shot != nullptr) return in.raise_code(Condition::format_error, *w.motion);  // both use the axis words
    w.one_shot = w.motion;
  } else if (w.target.axes() != 0 && w.one_shot == nullptr && in.state.cycle.kind == CycleKind::none) {
    w.one_shot = row_in_force(*in.dialect, in.state.modal, Mode::motion);
  }
  return Execution::done;
}

/// Where the end of a cycle is one of the motions (RS-274/NGC 3.4): it is the one in force from its block on, until another motion or a cycle stands in a
/// block, and axis words that a motion would take have none.
Execution check_motion_in_force(BlockInHand& in) {
  const Command& w = in.words;
  State& s = in.state;
  const bool off = w.motion == nullptr && (w.cycle == nullptr ? s.motion_off : w.cycle->function == Function::cycle_off);
  if (off != s.motion_off) {
    s.motion_off = off;
    s.refresh_special();
  }
  const bool by_motion = w.one_shot == nullptr || (w.one_shot->function == Function::machine_move && in.dialect->rules.coordinate.machine_move_by_motion);
  if (!off || !by_motion || w.target.axes() == 0) return Execution::done;
  return in.raise_first(Condition::illegal_address, w.present & in.axis_words.all());
}

/// M700 13.8: ,A is the angle of a line of G01. In the formats of G12 and G13 (13.10) it is no address.
Execution refuse_line_angle(BlockInHand& in) {
  const bool circle = in.words.one_shot != nullptr && cuts_circle(in.words.one_shot->function);
  return in.raise(circle ? Condition::illegal_address : Condition::geometric_option, Role::option_angle, in.words.angle.value);
}

}  // namespace

bool cycle_goes_on(const BlockInHand& in) {
  const Command& w = in.words;
  if (w.motion != nullptr && !cycle_counts(in)) return false;
  if (w.cycle == nullptr) return in.state.cycle.kind != CycleKind::none;
  return w.cycle->function != Function::cycle_off;
}

Execution execute_motion_of_words(BlockContext& in) {
  const Command& w = in.words;
  if (in.dialect->rules.cycle.end_is_motion) {
    const Execution did = check_motion_in_force(in);
    if (did != Execution::done) return did;
  }
  if (w.motion != nullptr && !cycle_counts(in)) {
    if (w.cycle != nullptr && w.cycle->function != Function::cycle_off && in.dialect->rules.cycle.beside == CycleBeside::fault)
      return in.raise_code(Condition::format_error, *w.cycle);
    cancel_cycle(in);  // M700 13.1.1 (4): G00 to G03 cancel the cycle, also when a cycle code stands in the same block
  } else if (w.cycle != nullptr) {
    if (w.one_shot == nullptr || makes_holes_beside(in, w.one_shot->function)) return do_cycle(in);
    const Execution did = take_cycle_beside(in, *w.one_shot);
    if (did != Execution::done) return did;
  }
  if (w.has_angle && (w.one_shot != nullptr || in.state.cycle.kind != CycleKind::none)) return refuse_line_angle(in);
  const Execution probes = take_probing(in);
  if (probes != Execution::done) return probes;
  const bool of_hole = in.state.cycle.kind != CycleKind::none && w.one_shot != nullptr && w.one_shot->function == Function::unidirectional;
  if (w.one_shot != nullptr && !of_hole) return execute_one_shot(in);  // G60 of a hole: M700 6.8, HX 4.2
  if (in.state.cycle.kind != CycleKind::none) return do_cycle(in);
  if (w.has_angle || w.has(Role::line_angle)) {
    const Execution did = take_line_angle(in);
    if (did != Execution::done) return did;
  }
  return move_by_words(in);
}

namespace {

Execution finish(Interpreter& in, Execution did) {
  if (did != Execution::done) return did;
  in.state.comp.has_vector = false;
  in.state.comp.cancel_vector = false;
  if (in.state.modal_call != 0 && calls_behind_place(in)) return make_modal_call_first(in);
  if (codes_behind_motion(in)) did = auxiliary_before(in);
  if (did != Execution::done) return did;
  if (in.state.modal_call != 0 && goes_on_elsewhere(in)) return make_modal_call_first(in);
  did = codes_behind(in);
  if (did != Execution::done || (in.after_block == nullptr && in.state.modal_call == 0)) return did;
  return call_behind_block(in);
}

/// Executes what is left of a block whose motion, and the macro behind it, have been executed: the other places of its pattern, its call of a program, or the return from its own.
Execution execute_codes_left(Interpreter& in) {
  in.state.codes_left &= ~(1u << in.state.depth);
  if (in.state.frame[in.state.depth].places_made != 0) return finish(in, go_on_in_pattern(in));
  in.words.target.clear();
  return execute_behind_motion(in);
}

/// G10 of tool data in G91 adds to the values in the table (M700 12.7), so it reads what part systems share. This is asked before anything of the block
/// is executed, because the block is read again after the answer of the sync.
bool adds_to_shared(const Interpreter& in) {
  const Command& w = in.words;
  if (w.one_shot == nullptr || w.one_shot->function != Function::data_input || !w.has(Role::input_amount) ||
      !in.dialect->rules.data_input.incremental_adds)
    return false;
  for (const FunctionRow* row : w.functions)
    if (row->function == Function::incremental) return true;
  return in.state.modal.is(Function::incremental);
}

/// The block has only axis words, F and a code of a motion, as most blocks of a long program. For such a block everything that concerns other words is left
/// out; the order is the same as for every block.
bool only_moves(const BlockInHand& in) {
  const Command& w = in.words;
  // Motions with words of their own, and modes that change what words mean, take the long way.
  // A block that leaves a curve over several blocks (G02.4, G06.2) is one of its own, too; a rotation by parameter has rules (13.21).
  if (in.state.special != 0 || in.state.work_turned || (in.state.space.on && in.state.mapped) || in.state.meeting.kind != MeetingFirst::Kind::none || w.has_angle || !plain_motion(in.state.modal.of(Mode::motion)) || (w.motion != nullptr && !plain_motion(w.motion->function))) return false;
  if (in.dialect->rules.compensation.begins_beside_start && in.state.compensated()) return false;
  const bool codes = w.functions.empty() || (w.functions.size() == 1 && w.motion != nullptr);
  return codes && w.auxiliary.empty() && (w.present & ~(in.axis_words.all() | in.set_of({Role::feed}))) == 0 && in.state.cycle.kind == CycleKind::none &&
         in.state.modal_call == 0;
}

Execution execute_move(Interpreter& in) {
  Command& w = in.words;
  in.distance_by_word = false;
  ModalState& modal = in.state.modal;
  const bool same = w.motion == nullptr || modal.holds(*w.motion);
  in.modal_kept = same && !w.has(Role::feed);
  if (!same) modal.set(*w.motion);
  Execution did = resolve_axes(in);
  if (did == Execution::done && w.has(Role::feed)) did = in.settings.feed_by_digit ? take_feed_word(in) : feed_of(in, &modal.feed);
  if (did == Execution::done) did = move_by_words(in);
  if (did != Execution::done) return did;
  in.state.comp.has_vector = false;
  in.state.comp.cancel_vector = false;
  return in.after_block == nullptr ? Execution::done : call_behind_block(in);
}

/// The block has only axis words, and a cycle is in force that takes nothing from the spindle, as most blocks of a drilling program. As in only_moves(),
/// everything that concerns other words is left out.
bool only_drills(const BlockInHand& in) {
  const Command& w = in.words;
  const State& s = in.state;
  return s.cycle.kind != CycleKind::none && !is_tap(s.cycle.kind) && w.functions.empty() && w.auxiliary.empty() && !w.has_angle &&
         (w.present & ~in.axis_words.all()) == 0 && (w.present & in.axis_words.all()) != 0 && s.special == 0 && !s.work_turned && s.modal_call == 0 &&
         s.meeting.kind == MeetingFirst::Kind::none && !s.compensated() && plain_motion(s.modal.of(Mode::motion));
}

Execution execute_holes(Interpreter& in) {
  in.distance_by_word = false;
  Execution did = resolve_axes(in);
  if (did == Execution::done && (in.words.target.axes() & in.rotary) != 0) did = check_index_positions(in);
  if (did == Execution::done) did = do_cycle(in);
  return finish(in, did);
}

/// T and M06 under tool life management go by what the machine has counted when it comes to them.
bool names_managed_tool(const BlockInHand& in) {
  if (in.words.has(Role::tool)) return true;
  for (const Auxiliary& m : in.words.auxiliary)
    if (m.function == MiscFunction::tool_change) return true;
  return false;
}

/// DGSHAPE 2-2, G20: the unit is chosen in front of anything that counts in it.
Execution check_unit(Interpreter& in) {
  for (const FunctionRow* row : in.words.functions)
    if (mode_of(row->function) == Mode::unit && in.state.unit_used && !in.state.modal.is(row->function)) return in.raise_code(Condition::not_accepted, *row);
  const bool moves_length = std::any_of(in.words.functions.begin(), in.words.functions.end(), [](const FunctionRow* row) { return mode_of(row->function) == Mode::length && row->function != Function::length_off; });
  in.state.unit_used = in.state.unit_used || moves_length || in.words.any(in.axis_words.all() | in.set_of({Role::feed, Role::input_amount, Role::arc_radius}));
  return Execution::done;
}

}  // namespace

Execution execute_words(Interpreter& in) {
  if (in.state.parameter_input) {
    const Execution read = read_block_command(in);
    return read == Execution::done ? parameter_block(in) : read;
  }
  if (in.state.life_input.kind != LifeInput::Kind::none) {
    const Execution read = read_block_command(in);
    return read == Execution::done ? tool_life_block(in) : read;
  }
  if (in.codes_call) {
    bool taken = false;
    const Execution did = dispatch_block(in, &taken);
    if (taken || did != Execution::done) return did;
  }
  const Execution did = read_block_command(in);
  if (did != Execution::done) return did;
  if (in.begins_inside()) [[unlikely]] return execute_begun_inside(in);
  return execute_read_words(in);
}

Execution execute_read_words(Interpreter& in) {
  Execution did = Execution::done;
  Command& w = in.words;
  if (in.state.codes_left != 0 && (in.state.codes_left >> in.state.depth & 1) != 0) return execute_codes_left(in);
  if (in.state.fine_mode != FineMode::none) {
    did = check_fine_block(in);
    if (did != Execution::done) return did;
  }
  if (in.dialect->rules.block.unit_is_of_program) {
    did = check_unit(in);
    if (did != Execution::done) return did;
  }
  if (turned_outside(in)) [[unlikely]] {
    did = take_tool_angles(in);
    if (did != Execution::done) return did;
  }
  if (only_moves(in)) return execute_move(in);
  if (only_drills(in)) return execute_holes(in);
  const bool macro_call = w.one_shot != nullptr && is_macro_call(w.one_shot->function);
  const Function motion_before = in.state.modal.of(Mode::motion);  // M700 App.2: codes of motions beside G37 are ignored
  if (!in.shared_known() && adds_to_shared(in)) return in.need(NC_SYNC_SHARED);
  if (in.settings.life_managed && !in.world_fresh && names_managed_tool(in)) return in.need(NC_SYNC_CLOCK);
  did = apply_reading_modes(in);
  if (did != Execution::done) return did;
  if (macro_call) {
    did = update_beside_call(in);
    return did == Execution::done ? call_macro(in) : did;
  }
  if (w.functions.size() > 1) did = drop_beside_cancel(in);
  if (did != Execution::done) return did;
  if (in.state.modal_call != 0 && block_is_argument(in)) return call_with_block(in);
  did = check_lead_word(in);
  if (did != Execution::done) return did;
  // M700 3.2 note 9, DGSHAPE 1-1: N and O stand at the beginning of a block. Behind other words no search would find them. (N of G10 is something else.)
  if (w.late_number != kNoWord && (w.one_shot == nullptr || w.one_shot->function != Function::data_input))
    return in.raise(Condition::format_error, w.late_number, w.get(w.late_number));
  if (!w.auxiliary.empty() && waits_for_input(in)) return wait_for_input(in);
  did = check_precedence(in);
  if (did == Execution::done && in.state.map.kind != AxisMap::Kind::none) did = check_mill_block(in);
  if (did != Execution::done) return did;
  did = resolve_axes(in);
  if (did == Execution::done && in.dialect->rules.block.unused_words_are_faults) did = check_unused_words(in);
  if (did != Execution::done) return did;
  if (is_space_arc(in.state.modal.of(Mode::motion)) || in.state.arc_step != ArcStep::none) did = check_space_arc_block(in);
  if (did == Execution::done && in.state.nurbs.active()) did = check_nurbs_block(in);
  if (did != Execution::done) return did;
  w.meeting = begins_or_ends_meeting(in);
  if (in.state.modal.is(Function::polar_command_on) && !has_line_angle(in)) resolve_polar_words(in);
  // The F of a thread is its lead (6.7.1), that of an exponential curve acts on this curve alone (6.11), that of a synchronous tap is its lead: none of them
  // becomes the modal feed.
  const bool own_feed = w.one_shot != nullptr ? keeps_its_feed(in, w.one_shot->function)
                                              : has_own_feed(in, in.state.modal.of(Mode::motion)) || taps_with_spindle(in);
  if (in.state.modal.is(Function::inverse_time_feed)) did = check_inverse_time_block(in);
  if (did == Execution::done && w.has(Role::feed) && !own_feed) did = take_feed_word(in);
  if (did != Execution::done) return did;
  const auto has_vector_in_space = [&in] { return in.state.space.on || in.state.tool_length != 0; };
  const bool had_one = has_vector_in_space();
  const SpaceVector space_before = in.state.space;
  const double length_before = in.state.tool_length;
  did = apply_systems(in);
  in.words.vector_in_space = had_one || has_vector_in_space();
  if (did != Execution::done) return did;
  if (!in.dialect->rules.length.stands_beside_arc && is_arc(in.state.modal.of(Mode::motion)) && w.target.axes() != 0 && w.one_shot == nullptr && w.cycle == nullptr) {
    // M700 App.2: an arc and G43/G44 in one block; so of G43.1, along whose vector the tool would plunge while it goes round.
    for (const FunctionRow* row : w.functions)
      if (row->function == Function::length_plus || row->function == Function::length_minus || row->function == Function::length_along_tool)
        return in.raise_code(Condition::length_beside_arc, *row);
  }
  if (!w.functions.empty()) did = set_surface_speed(in);
  if (did == Execution::done && !codes_behind_motion(in)) did = auxiliary_before(in);
  if (did != Execution::done) return did;
  const bool ignores_motion = !in.dialect->rules.block.unused_words_are_faults;
  if (ignores_motion && w.one_shot != nullptr && w.one_shot->function == Function::measure_length) in.state.modal.set(motion_before);
  if (in.dialect->rules.compensation.begins_beside_start) did = go_beside_start(in);
  if (did != Execution::done) return did;
  // Another number or code alone only counts from the next I J K on (M700 12.5 (4), (5)): it moves nothing and takes no feed.
  const bool keeps_vector = space_before.on && in.state.space == space_before && in.state.tool_length == 0 && length_before == 0 && !gives_space_vector(in);
  const bool may_turn = in.state.space.on && in.state.mapped;
  if ((!w.comp_command || keeps_vector) && !may_turn) return finish(in, execute_motion(in));
  const bool by_command = w.comp_command && !keeps_vector;
  const SpaceVector vector_before = space_compensation_vector(in);
  const AxisVec before = in.state.machine;
  did = execute_motion(in);
  const bool at_once = !in.dialect->rules.compensation.code_alone_waits || in.state.comp.has_vector || in.state.comp.cancel_vector;
  // An axis that comes to its mirror image or to a rotation (13.21) where it stands turns the vector without a way.
  const bool leads = by_command || !(space_compensation_vector(in) == vector_before);
  if (did == Execution::done && in.state.machine == before && at_once && leads) {
    // The vector is gone to at once (M700 12.3, 12.5): as a line that takes a feed (3.2, P62), which a block that only waits for its vector does not.
    if (w.vector_in_space && !in.state.modal.is(Function::rapid)) did = check_feed(in, Function::linear);
    if (did == Execution::done) move_nowhere(in, w.vector_in_space);
  }
  return finish(in, did);
}

Execution continue_block(Interpreter& in) {
  const Step step = in.next_step;
  Execution did = Execution::done;
  if (step == Step::cycle) did = continue_cycle(in);
  if (step == Step::skip_answered) did = skip_answered(in);
  if (step == Step::measured) did = measured(in);
  if (step == Step::reference_check) did = compare_reference(in);
  if (step == Step::cavity) did = continue_cavity(in);
  if (step == Step::loop) did = continue_sine_loop(in);
  if (step == Step::input) did = continue_input_wait(in);
  if (step == Step::stitch) did = continue_stitch(in);
  if (did == Execution::later) return did;
  if (did == Execution::done) in.next_step = Step::none;
  return finish(in, did);
}

}  // namespace nc
