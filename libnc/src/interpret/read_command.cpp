// SPDX-License-Identifier: Apache-2.0
// From the block in hand to its command with targets: the front end of the family reads its words (command/reader.hpp); whether they may stand together now
// and in which unit their numbers count is said here.
#include "interpret/read_command.hpp"

#include <bit>
#include <cmath>
#include <initializer_list>

#include "base/units.hpp"
#include "command/reader.hpp"
#include "command/words_of_block.hpp"
#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/interpreter.hpp"

namespace nc {
namespace {

/// Raises an alarm for a code that may not be commanded in a mode in force. A curve that the block itself ends does not count.
Execution check_modes(Interpreter& in, const FunctionRow& row, double value) {
  const State& state = in.state;
  const Function before = state.modal.of(Mode::motion), motion = bars_codes(before) ? motion_behind(*in.block, in.front, before) : before;
  if (is_space_arc(before) && is_space_arc(motion)) {
    const Execution did = check_in_space_arc(in, row);
    if (did != Execution::done) return did;
  }
  const unsigned modes = (state.modal.is(Function::polar_command_on) ? unsigned{kInPolarCommand} : 0u) |
                         (state.frame[state.depth].figure != 0 ? unsigned{kInFigure} : 0u) |
                         (is_exponential(before) && is_exponential(motion) ? unsigned{kInExponential} : 0u) |
                         (state.scaled != 0 || state.rotated ? unsigned{kInMap} : 0u) |
                         (state.comp.side != 0 ? unsigned{kInCompensation} : 0u);
  const Condition bad = modes != 0 ? barred(*in.dialect, modes, row.function) : Condition::none;
  return bad == Condition::none ? Execution::done : in.raise(bad, Role::code, value);
}

/// There are modes in force in which some codes may not be commanded.
bool checks_codes(const State& state) { return state.special != 0 || state.mapped || state.comp.side != 0 || bars_codes(state.modal.of(Mode::motion)); }

/// Whether the code may be commanded now, and whether it is built.
Execution check_code(Interpreter& in, const FunctionRow& row, double value) {
  if (checks_codes(in.state)) {
    const Execution did = check_modes(in, row, value);
    if (did != Execution::done) return did;
  }
  if (row.missing == nullptr) return Execution::done;
  if (in.state.fine_mode != FineMode::none) return in.raise(Condition::illegal_g, Role::code, value);  // M700 13.17: the code is not in the list, whether the machine has it or not
  const bool excluded = refused_in_inverse_time(row.function) && inverse_time_so_far(in);
  return excluded ? in.raise(Condition::inverse_time_code, Role::code, value) : in.raise_code(Condition::no_function, row);
}

/// The block may have ,C or ,R: it has a motion, and programmed coordinates are those of the axes. In a fixed cycle ,R means something else (M700 13.1.1).
bool may_have_corner(const Interpreter& in) {
  const Command& w = in.words;
  const bool cycle = w.cycle != nullptr || (in.state.cycle.kind != CycleKind::none && w.motion == nullptr);
  return w.one_shot == nullptr && !cycle && (in.state.special & (kSpecialMap | kSpecialSpline)) == 0;
}

/// M700 13.1.1: ,R of a tap is no corner, and ,S is of a tap alone.
Execution take_tap_options(Interpreter& in) {
  Command& w = in.words;
  const bool control = w.corner == Corner::rounding && in.dialect->addresses.same(Role::option_tap_control, Role::option_corner_radius);
  if (!control && !w.has_return_speed) return Execution::done;
  if (!taps(in)) return w.has_return_speed ? in.raise(Condition::illegal_address, Role::option_return_speed, w.return_speed) : Execution::done;
  if (!control) return Execution::done;
  w.has_tap_control = true;
  w.tap_control = w.corner_size.value;
  w.corner = Corner::none;
  return Execution::done;
}

/// Axis words without numbers are allowed, and count as 0: M700 14.10 has "G28 XYZ", 6.9 "G19 Z C", and 6.16 (4) "G07 Y". In any other block a word has a
/// number (3.2 (1)).
bool takes_bare_axes(const Command& w) {
  if (w.one_shot != nullptr) return w.one_shot->function == Function::reference_return || w.one_shot->function == Function::hypothetical_axis;
  for (const FunctionRow* row : w.functions)
    if (is_plane(row->function)) return true;
  return false;
}

/// Whether the words that stand behind commas or alone may stand in this block.
Execution check_command(Interpreter& in) {
  Command& w = in.words;
  const Execution options = take_tap_options(in);
  if (options != Execution::done) return options;
  if (w.corner != Corner::none && !may_have_corner(in)) return in.raise(Condition::corner_option, corner_word(w), w.corner_size.value);
  if (w.bare_axis != kNoWord && !takes_bare_axes(w)) return in.raise(Condition::format_error, w.bare_axis);
  // M700 15.5: feeds behind a skip signal belong to G31.
  if (w.counted_feeds != 0 && (w.one_shot == nullptr || w.one_shot->function != Function::skip)) return in.raise(Condition::format_error, Role::feed);
  return Execution::done;
}

Interpreter& interpreter_of(void* core) { return *static_cast<Interpreter*>(core); }

}  // namespace

const CoreQuestions kCoreAnswers = {
    .evaluation = [](void* core) {
      Interpreter& in = interpreter_of(core);
      return Evaluation{variable_reader(in), eval_options(in)};
    },
    .check_code = [](void* core, const FunctionRow& row, double written) {
      return check_code(interpreter_of(core), row, written) == Execution::done ? Reading::done : Reading::fault;
    },
    .has_modal_call = [](const void* core) { return has_modal_call(*static_cast<const Interpreter*>(core)); },
    .length = [](const void* core, Written number) { return length_value(*static_cast<const Interpreter*>(core), number, false, true); },
};

Execution read_block_command(Interpreter& in) {
  in.front.checks_codes = checks_codes(in.state);
  const Reading read = read_command(*in.block, in.front, in.words);
  if (read != Reading::done) return in.executed(read);
  // For the alarm of a move that has no feed because of it (alarm_cause.cpp).
  if (in.words.vacant_feed != Command::kNoVariable) [[unlikely]] {
    in.state.vacant_feed = in.words.vacant_feed;
    in.state.vacant_feed_line = in.source.line;
    in.state.vacant_feed_file = in.source.file;
  }
  return check_command(in);
}

bool is_incremental(const BlockInHand& in) {
  const FunctionRow* const once = in.words.distance_once;
  return once != nullptr ? once->function == Function::incremental_once : in.state.modal.is(Function::incremental);
}

// ---- units -----------------------------------------------------------------------------------------------------------

namespace {

/// raw * unit, calculated as a division by the whole number 1/unit where that is exact, so that 12345 * 0.001 is exactly the double 12.345.
double scaled(double raw, double unit) {
  if (unit >= 1) return raw * unit;
  return raw / std::nearbyint(1 / unit);
}

bool in_inches(const InForce& in) { return in.state.modal.is(Function::inch); }

}  // namespace

namespace {

/// length_value() of a word that is read in whole units without a point if `whole` is true.
double length_read(const InForce& in, Written number, bool rotary, bool setting_unit, bool tenfold, bool whole) {
  const bool in_inch = in_inches(in) && !rotary;
  const Settings& s = in.settings;
  const double raw = number.value;
  double value = raw;
  if (number.is_expression() && in.dialect->rules.number.rounds_formulas) {
    const double unit = rotary ? s.setting_unit_deg : in_inch ? s.setting_unit_inch : s.setting_unit_mm;
    value = scaled(std::round(raw * std::nearbyint(1 / unit)), unit);
  } else if (!number.pointed()) {
    if (!whole) {  // M700 5.3, type I: the least command unit; tenfold 2.2
      const double unit = setting_unit ? (rotary ? s.setting_unit_deg : in_inch ? s.setting_unit_inch : s.setting_unit_mm)
                                       : (rotary ? s.command_unit_deg : in_inch ? s.command_unit_inch : s.command_unit_mm);
      value = scaled(tenfold ? raw * s.tenfold : raw, unit);
    }
  }
  return in_inch ? value * kMillimetresPerInch : value;
}

}  // namespace

double length_value(const InForce& in, Written number, bool rotary, bool setting_unit, bool tenfold) {
  return length_read(in, number, rotary, setting_unit, tenfold, in.settings.whole_positions());
}

double axis_value(const InForce& in, unsigned axis, Written number, bool rotary) {
  const Settings& s = in.settings;
  if (((s.own_unit_axes >> axis) & 1) == 0 || number.pointed() || s.whole_positions()) return length_value(in, number, rotary, false);
  const bool in_inch = in_inches(in) && !rotary;
  const double value = scaled(number.value * s.tenfold, in_inch ? s.own_unit[axis] / 10 : s.own_unit[axis]);
  return in_inch ? value * kMillimetresPerInch : value;
}

double length_of(const BlockInHand& in, WordSlot word, bool setting_unit) { return length_value(in, in.words.written(word), false, setting_unit); }

double length_of(const BlockInHand& in, Role word, bool setting_unit) {
  const bool whole = word == Role::cycle_depth_step ? in.settings.whole_steps() : in.settings.whole_positions();
  return length_read(in, in.words.written(word), false, setting_unit, true, whole);
}

namespace {

/// The largest feed, mm/min or inch/min.
double largest_feed(const BlockInHand& in) {
  const NumberRules& rules = in.dialect->rules.number;
  if (in.words.pointed(Role::feed)) return in_inches(in) ? rules.largest_feed_inch : rules.largest_feed_mm;
  return in_inches(in) ? rules.largest_undotted_feed_inch : rules.largest_undotted_feed_mm;
}

}  // namespace

Execution feed_of(BlockInHand& in, double* feed) {
  const double raw = in.words.get(Role::feed);
  const bool whole = !in.dialect->rules.number.undotted_feed_in_least_unit || in.words.pointed(Role::feed) || in.settings.calculator_reads_feed();
  const double value = whole ? raw : scaled(raw, in_inches(in) ? 0.0001 : 0.001);
  if (!(value >= 0) || value > largest_feed(in)) return in.raise(Condition::value_range, Role::feed, raw);
  *feed = value;
  return Execution::done;
}

namespace {

/// M700 2.1, 5.3: the value is in the range of coordinates. DGSHAPE 2-1 "range 1": the same limits for numbers with a point (the manual has the two labels
/// exchanged).
bool in_range(const InForce& in, double value, Written number, bool rotary) {
  const Settings& s = in.settings;
  const double last = rotary ? s.last_deg : in_inches(in) ? s.last_inch : s.last_mm;
  return std::fabs(value) <= last || (in.dialect->rules.number.undotted_range_is_digits && !number.has_point());
}

/// Bit i: the word of axis i is incremental.
uint32_t increments_of_block(const Interpreter& in) {
  const Command& w = in.words;
  if (w.distance_once != nullptr) return is_incremental(in) ? ~uint32_t{0} : 0;
  // Families without the rule below have at most one of G90/G91 in a block, so that the order of words does not matter: the code counts
  // for the whole block.
  if (!in.distance_by_word) return in.state.modal.is(Function::incremental) ? ~uint32_t{0} : 0;
  return incremental_axes(*in.block, in.axis_words, w, in.block_starts_incremental);  // M700 5.1; the last one stays modal
}

}  // namespace

Execution resolve_axes(Interpreter& in) {
  Command& w = in.words;
  const uint32_t incremental = increments_of_block(in);
  const WordSet named = w.present & in.axis_words.all();
  const WordSlot seconds = w.one_shot != nullptr && w.one_shot->function == Function::dwell ? w.addresses->word(Role::dwell_seconds) : kNoWord;
  for (WordSet left = named; left != 0; left &= left - 1) {
    const WordSlot word = first_word(left);
    const auto axis = static_cast<unsigned>(in.axis_words.axis(word));
    // M700 6.10: in the plane of polar coordinate interpolation the rotary axis is commanded in mm or inch.
    const bool turns = ((in.rotary >> axis) & 1) != 0 && !(in.state.map.kind == AxisMap::Kind::polar && axis == in.state.map.rotary);
    const Written number = w.written(word);
    const double value = axis_value(in, axis, number, turns);
    // Seconds of a dwell have a range of their own.
    if (word != seconds && !in_range(in, value, number, turns)) return in.raise(Condition::value_range, word, number.value);
    w.target.set(axis, (incremental >> axis & 1) != 0 ? TargetKind::incremental : TargetKind::absolute, value);
  }
  const uint32_t axes = w.target.axes();
  // M700 10.5, precaution (2), and (2), note: this is checked as the block is read.
  if ((axes & in.closed_axes) != 0 && (w.one_shot == nullptr || goes_to_position(w.one_shot->function)))
    return in.raise_axis(Condition::no_reference, static_cast<unsigned>(std::countr_zero(axes & in.closed_axes)));
  for (WordSet lengths = w.present & in.dialect->length_addresses; lengths != 0; lengths &= lengths - 1) {
    const WordSlot word = first_word(lengths);
    const Written number = w.written(word);
    if (!in_range(in, length_value(in, number, false, true), number, false)) return in.raise(Condition::value_range, word, number.value);
  }
  return Execution::done;
}

}  // namespace nc
