// SPDX-License-Identifier: Apache-2.0
// From words to values: expressions, the G and M codes of the block, units and the rules of decimal points.
#include "interpret/block_words.hpp"

#include <bit>
#include <cmath>
#include <initializer_list>

#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/interpreter.hpp"
#include "modal/precedence.hpp"

namespace nc {
namespace {

/// The motion that will be in force when the whole block has been read; codes that are expressions are not considered.
Function motion_of_block(const Interpreter& in) {
  Function motion = in.state.modal.of(Mode::motion);
  for (const Word& word : in.block->words) {
    if (!in.is(word, Role::code) || (word.flags & kWordExpression) != 0) continue;
    const FunctionRow* const row = in.codes.find(word.value);
    if (row != nullptr && mode_of(row->function) == Mode::motion) motion = row->function;
  }
  return motion;
}

/// Raises an alarm for a code that may not be commanded in a mode in force. A curve that the block itself ends does not count.
Execution check_modes(Interpreter& in, const FunctionRow& row, double value) {
  const State& state = in.state;
  const Function before = state.modal.of(Mode::motion), motion = bars_codes(before) ? motion_of_block(in) : before;
  if (is_space_arc(before) && is_space_arc(motion)) {
    const Execution did = check_in_space_arc(in, row);
    if (did != Execution::done) return did;
  }
  const unsigned modes = (state.modal.is(Function::polar_command_on) ? unsigned{kInPolarCommand} : 0u) |
                         (state.frame[state.depth].figure != 0 ? unsigned{kInFigure} : 0u) |
                         (is_exponential(before) && is_exponential(motion) ? unsigned{kInExponential} : 0u) |
                         (state.comp.side != 0 && in.dialect->rules.compensation.bars_scaling_and_cycle_end ? unsigned{kInDiameterOffset} : 0u);
  const Condition bad = modes != 0 ? barred(modes, row.function) : Condition::none;
  return bad == Condition::none ? Execution::done : in.raise(bad, Role::code, value);
}

/// G51 and G68: appendix 2 has no row for them, so it does not say to which code the words belong when another such code stands in the block.
bool shares_no_words(Function function) { return function == Function::scaling_on || function == Function::rotation_on; }

/// Puts a G code of the block into in.words by its function.
Execution take_g(Interpreter& in, double value) {
  const FunctionRow* const row = in.codes.find(value);
  if (row == nullptr) return in.raise(Condition::illegal_g, Role::code, value);
  if (in.state.special != 0 || in.state.mapped || in.state.comp.side != 0 || bars_codes(in.state.modal.of(Mode::motion))) {
    const Execution did = check_modes(in, *row, value);
    if (did != Execution::done) return did;
  }
  if (row->missing != nullptr) {
    if (in.state.fine_mode != FineMode::none) return in.raise(Condition::illegal_g, Role::code, value);  // M700 13.17: the code is not in the list, whether the machine has it or not
    const bool excluded = refused_in_inverse_time(row->function) && inverse_time_so_far(in);
    return excluded ? in.raise(Condition::inverse_time_code, Role::code, value) : in.raise_code(Condition::no_function, *row);
  }
  BlockWords& w = in.words;
  if (!w.g.push_back(row)) return in.raise(Condition::format_error, Role::code, value);
  switch (row->function) {
    case Function::exact_stop_once: w.exact_stop = true; return Execution::done;
    case Function::corner_behind: w.corner_code = row; return Execution::done;
    case Function::absolute_once:
    case Function::incremental_once: w.distance_once = row; return Execution::done;
    case Function::comp_entry: w.comp_entry = true; return Execution::done;
    case Function::macro_modal_off:  // M700 13.5.1: G67 without a modal call in force
      return has_modal_call(in) ? Execution::done : in.raise(Condition::cancel_without_call, Role::code, value);
    case Function::stroke_check_on:
      if (w.one_shot != nullptr && w.one_shot->function == Function::holes_on_grid) return Execution::done;  // M700 13.2, G37.1 note 5
      w.one_shot = row;
      return Execution::done;
    case Function::macro_modal:
    case Function::macro_every_block:
      w.one_shot = row;  // takes the words of the block though it is modal
      return Execution::done;
    case Function::scaling_on:
    case Function::rotation_on:
      if (w.one_shot != nullptr) return in.raise(Condition::format_error, Role::code, value);
      w.one_shot = row;
      return Execution::done;
    case Function::mirror_on:
    case Function::mirror_off:  // G51.1 and G50.1 take the words, unless by App. 2 they belong to another code of the block
      if (w.one_shot != nullptr && precedence_of(w.one_shot->function).mirror == Precedence::ignored) return Execution::done;
      w.one_shot = row;
      return Execution::done;
    default: break;
  }
  const Mode mode = mode_of(row->function);
  if (mode == Mode::none || mode == Mode::interpolation) {
    if (w.one_shot != nullptr && shares_no_words(w.one_shot->function)) return in.raise(Condition::format_error, Role::code, value);
    w.one_shot = row;
  } else if (mode == Mode::motion) {
    w.motion = row;
  } else if (mode == Mode::cycle) {
    w.cycle = row;
  }
  return Execution::done;
}

Execution take_m(Interpreter& in, double value) {
  uint32_t code = 0;
  if (!whole_number(value, &code)) return in.raise(Condition::value_range, Role::misc_code, value);
  const MiscRow* row = find_misc(*in.dialect, code);
  if (row != nullptr && row->missing != nullptr) return in.raise(Condition::no_function, Role::misc_code, code);
  if (!in.words.m.push_back(code)) return in.raise(Condition::format_error, Role::misc_code, value);
  return Execution::done;
}

/// M700 13.1.1: "0.001 to 999.999 (mm)"; 6.1 and 6.2 give no range for the same word.
bool in_position_range(double mm) { return mm > 0.001 - 1e-9 && mm < 999.999 + 1e-9; }

/// The block may have ,C or ,R: it has a motion, and programmed coordinates are those of the axes. In a fixed cycle ,R means something else (M700 13.1.1).
bool may_have_corner(const Interpreter& in) {
  const BlockWords& w = in.words;
  const bool cycle = w.cycle != nullptr || (in.state.cycle.kind != CycleKind::none && w.motion == nullptr);
  return w.one_shot == nullptr && !cycle && (in.state.special & (kSpecialMap | kSpecialSpline)) == 0;
}

/// M700 13.1.1: ,R of a tap is no corner, and ,S is of a tap alone.
Execution take_tap_options(Interpreter& in) {
  BlockWords& w = in.words;
  const bool control = w.corner == Corner::rounding && in.dialect->addresses.at(Role::option_tap_control) == in.dialect->addresses.at(Role::option_corner_radius);
  if (!control && !w.has_return_speed) return Execution::done;
  if (!taps(in)) return w.has_return_speed ? in.raise(Condition::illegal_address, Role::option_return_speed, w.return_speed) : Execution::done;
  if (!control) return Execution::done;
  w.has_tap_control = true;
  w.tap_control = w.corner_raw;
  w.corner = Corner::none;
  return Execution::done;
}

bool calls_sub(const Interpreter& in) {
  for (const uint32_t m : in.words.m)
    if (misc_function(*in.dialect, m) == MiscFunction::call_sub) return true;
  return false;
}

/// Axis letters without numbers are allowed, and count as 0: M700 14.10 has "G28 XYZ", 6.9 "G19 Z C", and 6.16 (4) "G07 Y". In any other block a word is a
/// letter and a number (3.2 (1)).
bool takes_bare_axes(const BlockWords& w) {
  if (w.one_shot != nullptr) return w.one_shot->function == Function::reference_return || w.one_shot->function == Function::hypothetical_axis;
  for (const FunctionRow* row : w.g)
    if (is_plane(row->function)) return true;
  return false;
}

/// Series 8 G10: L or R is the corner that the line of the block ends with.
Execution take_corner_code(Interpreter& in) {
  BlockWords& w = in.words;
  const bool round = w.has(Role::option_corner_radius), cut = w.has(Role::option_chamfer);
  if (round == cut) return in.raise_code(Condition::words_missing, *w.corner_code);
  const Role word = round ? Role::option_corner_radius : Role::option_chamfer;
  w.corner = round ? Corner::rounding : Corner::chamfer;
  w.corner_flags = w.flag(word);
  w.corner_raw = w.get(word);
  w.present &= ~in.addresses({word});
  return Execution::done;
}

/// Behind the macro call that is word `first` stands another macro call, of a different kind.
bool calls_another(const Interpreter& in, unsigned first) {
  for (unsigned i = first + 1; i < in.block->words.size(); ++i) {
    const Word& word = in.block->words[i];
    if (!in.is(word, Role::code) || (word.flags & kWordExpression) != 0) continue;
    const FunctionRow* const row = in.codes.find(word.value);
    if (row != nullptr && is_macro_call(row->function) && row->function != in.words.one_shot->function) return true;
  }
  return false;
}

/// Checks words that may stand only once. `twice`: the addresses that the block has more than once.
Execution check_words_stand_once(Interpreter& in, uint32_t twice) {
  const BlockWords& w = in.words;
  if (twice != 0) return in.raise(Condition::format_error, letter_of(first_of(twice)), w.raw[first_of(twice)]);
  for (unsigned i = 1; i < w.g.size(); ++i)
    for (unsigned k = 0; k < i; ++k)
      if (mode_of(w.g[i]->function) != Mode::none && mode_of(w.g[i]->function) == mode_of(w.g[k]->function)) return in.raise_code(Condition::format_error, *w.g[i]);
  return Execution::done;
}

/// Notes the variable of an F that is vacant, for the alarm of a move that has no feed because of it (alarm_cause.cpp).
[[gnu::cold, gnu::noinline]] void note_vacant_feed(Interpreter& in, const Word& word) {
  uint32_t number = 0;
  if (!lone_variable(*in.block, word.code, &number)) return;
  in.state.vacant_feed = number;
  in.state.vacant_feed_line = in.source.line;
  in.state.vacant_feed_file = in.source.file;
}

}  // namespace

bool whole_number(double raw, uint32_t* number) {
  const double whole = std::floor(raw + 1e-9);
  if (!(whole >= 0) || whole > 4294967295.0) return false;
  *number = static_cast<uint32_t>(whole);
  return true;
}

Execution gather_words(Interpreter& in) {
  const uint32_t codes = in.code_addresses;
  BlockWords& w = in.words;
  w.present = w.axes = w.incremental = 0;
  w.g.clear();
  w.m.clear();
  w.one_shot = w.motion = w.cycle = nullptr;
  w.exact_stop = w.fin_behind_dwell = w.comp_entry = false;
  w.corner_code = w.distance_once = nullptr;
  w.in_position = w.in_position_drill = 0;
  w.counted_feeds = 0;
  w.device = 0;
  w.has_angle = false;
  w.corner = Corner::none;
  w.has_tap_control = w.has_return_speed = false;
  w.absolute_at = w.incremental_at = 0;
  const Word* const words = in.block->words.begin();
  const unsigned count = in.block->words.size();
  uint32_t present = 0, twice = 0;
  char bare_axis = 0;
  w.late_number = 0;
  for (unsigned i = 0; i < count; ++i) {
    const Word& word = words[i];
    const unsigned at = address_of(word);
    double value = word.value;
    // Nearly all words are like this: a number behind a letter that is neither that of a code nor that of a block number.
    if ((word.flags & (kWordExpression | kWordComma | kWordCount | kWordNoValue)) == 0 && ((codes >> at) & 1) == 0) {
      twice |= present & 1u << at;
      present |= 1u << at;
      w.raw[at] = value;
      w.flags[at] = word.flags;
      continue;
    }
    if ((word.flags & kWordExpression) != 0) {
      Value v;
      const Eval eval = evaluate(*in.block, word.code, variable_reader(in), EvalOptions{in.settings.asin_0_360}, &v, &in.fault,
                                 &in.sync_needed);
      if (eval == Eval::fault) return Execution::fault;
      if (eval == Eval::need_sync) return Execution::sync;
      if (v.vacant) {  // M700 13.5.4: a word with only a vacant variable is ignored
        if (in.is(word, Role::feed)) note_vacant_feed(in, word);
        continue;
      }
      value = v.number;
    }
    if ((word.flags & kWordComma) != 0 && (in.is(word, Role::option_in_position) || in.is(word, Role::option_in_position_drill))) {
      const double width = length_value(in, value, word.flags, false, true);
      if (!in_position_range(width)) return in.raise(Condition::value_range, word.letter, value);
      (in.is(word, Role::option_in_position) ? w.in_position : w.in_position_drill) = width;
      continue;
    }
    if ((word.flags & kWordComma) != 0 && in.is(word, Role::option_device)) {
      uint32_t device = 0;
      if (!whole_number(value, &device) || device > 4) return in.raise(Condition::value_range, Role::option_device, value);
      w.device = static_cast<int8_t>(device);
      continue;
    }
    if ((word.flags & kWordComma) != 0 && in.is(word, Role::option_return_speed)) {
      w.has_return_speed = true;
      w.return_speed = value;
      continue;
    }
    if ((word.flags & kWordComma) != 0) {  // M700 13.7 ,C ,R; 13.8 ,A
      if (in.is(word, Role::option_angle)) {
        w.has_angle = true;
        w.angle_flags = word.flags;
        w.angle_raw = value;
        continue;
      }
      const bool chamfer = in.is(word, Role::option_chamfer);
      if (!chamfer && !in.is(word, Role::option_corner_radius)) return in.raise(Condition::no_function, word.letter, value);
      w.corner = chamfer ? Corner::chamfer : Corner::rounding;
      w.corner_flags = word.flags;
      w.corner_raw = value;
      continue;
    }
    if ((word.flags & kWordCount) != 0) {
      if (!in.is(word, Role::feed) || word.index < 1 || word.index > 8) return in.raise(Condition::format_error, word.letter, word.index);
      w.counted_feeds = static_cast<uint8_t>(w.counted_feeds | 1u << (word.index - 1));
      w.counted_feed[word.index - 1] = value;
      continue;
    }
    const bool bare = (word.flags & kWordNoValue) != 0;
    const bool bare_is_zero = in.dialect->rules.block.bare_word_is_zero && !in.is(word, Role::code);
    if (bare && (in.is(word, Role::misc_code) || !(in.dialect->bare_letters || bare_is_zero))) return in.raise(Condition::format_error, word.letter);
    if (in.is(word, Role::code)) {
      const Execution did = take_g(in, value);
      if (did != Execution::done) return did;
      if (w.g.back()->function == Function::absolute) w.absolute_at |= uint64_t{1} << i;
      if (w.g.back()->function == Function::incremental) w.incremental_at |= uint64_t{1} << i;
      if (in.words.one_shot != nullptr && is_macro_call(in.words.one_shot->function)) {
        // All further words are arguments. M700 App.2: G65 beside G66 is an error.
        if (calls_another(in, i)) return in.raise(Condition::format_error, Role::code, value);
        break;
      }
      continue;
    }
    if (in.is(word, Role::misc_code)) {
      const Execution did = take_m(in, value);
      if (did != Execution::done) return did;
      continue;
    }
    if (in.is(word, Role::sequence_number) || in.is(word, Role::program_number)) w.late_number = word.letter;
    if (bare && !bare_is_zero) {  // any other address needs a number
      if (in.axis_of[at] < 0) return in.raise(Condition::format_error, word.letter);
      bare_axis = word.letter;
      value = 0;
    }
    twice |= present & 1u << at;
    present |= 1u << at;
    w.raw[at] = value;
    w.flags[at] = word.flags;
  }
  w.present = present;
  if ((twice != 0 || w.g.size() > 1) && in.dialect->rules.block.words_stand_once) {
    const Execution did = check_words_stand_once(in, twice);
    if (did != Execution::done) return did;
  }
  if (w.device != 0 && !calls_sub(in)) return in.raise(Condition::no_function, Role::option_device, w.device);
  if (w.corner_code != nullptr) {
    const Execution did = take_corner_code(in);
    if (did != Execution::done) return did;
  }
  const Execution options = take_tap_options(in);
  if (options != Execution::done) return options;
  if (w.corner != Corner::none && !may_have_corner(in)) return in.raise(Condition::corner_option, corner_word(w), w.corner_raw);
  if (bare_axis != 0 && !takes_bare_axes(w)) return in.raise(Condition::format_error, bare_axis);
  // M700 15.5: feeds behind a skip signal belong to G31.
  if (w.counted_feeds != 0 && (w.one_shot == nullptr || w.one_shot->function != Function::skip)) return in.raise(Condition::format_error, Role::feed);
  return Execution::done;
}

bool is_incremental(const BlockContext& in) {
  const FunctionRow* const once = in.words.distance_once;
  return once != nullptr ? once->function == Function::incremental_once : in.state.modal.is(Function::incremental);
}

char first_of_block(const BlockContext& in, uint32_t of) {
  for (const Word& word : in.block->words)
    if ((of >> address_of(word) & 1) != 0) return word.letter;
  return letter_of(first_of(of));
}

// ---- units -----------------------------------------------------------------------------------------------------------

namespace {

/// raw * unit, calculated as a division by the whole number 1/unit where that is exact, so that 12345 * 0.001 is exactly the double 12.345.
double scaled(double raw, double unit) {
  if (unit >= 1) return raw * unit;
  return raw / std::nearbyint(1 / unit);
}

bool inch(const BlockContext& in) { return in.state.modal.is(Function::inch); }

}  // namespace

double length_value(const BlockContext& in, double raw, uint8_t flags, bool rotary, bool setting_unit, bool tenfold) {
  const bool pointed = (flags & (kWordPoint | kWordExpression)) != 0;
  const bool in_inch = inch(in) && !rotary;
  const Settings& s = in.settings;
  double value = raw;
  if ((flags & kWordExpression) != 0 && in.dialect->rules.number.rounds_formulas) {
    const double unit = rotary ? s.setting_unit_deg : in_inch ? s.setting_unit_inch : s.setting_unit_mm;
    value = scaled(std::round(raw * std::nearbyint(1 / unit)), unit);
  } else if (!pointed) {
    if (!s.whole_positions()) {  // M700 5.3, type I: the least command unit; tenfold 2.2
      const double unit = setting_unit ? (rotary ? s.setting_unit_deg : in_inch ? s.setting_unit_inch : s.setting_unit_mm)
                                       : (rotary ? s.command_unit_deg : in_inch ? s.command_unit_inch : s.command_unit_mm);
      value = scaled(tenfold ? raw * s.tenfold : raw, unit);
    }
  }
  return in_inch ? value * 25.4 : value;
}

double axis_value(const BlockContext& in, unsigned axis, double raw, uint8_t flags, bool rotary) {
  const Settings& s = in.settings;
  const bool pointed = (flags & (kWordPoint | kWordExpression)) != 0;
  if (((s.own_unit_axes >> axis) & 1) == 0 || pointed || s.whole_positions()) return length_value(in, raw, flags, rotary, false);
  const bool in_inch = inch(in) && !rotary;
  const double value = scaled(raw * s.tenfold, in_inch ? s.own_unit[axis] / 10 : s.own_unit[axis]);
  return in_inch ? value * 25.4 : value;
}

double length_of(const BlockContext& in, char axis_name, bool setting_unit) {
  const unsigned at = address_of(axis_name);
  return length_value(in, in.words.raw[at], in.words.flags[at], false, setting_unit);
}

double length_of(const BlockContext& in, Role word, bool setting_unit) {
  const unsigned at = in.words.addresses->at(word);
  return length_value(in, in.words.raw[at], in.words.flags[at], false, setting_unit);
}

namespace {

/// The largest feed, mm/min or inch/min.
double largest_feed(const BlockContext& in) {
  const NumberRules& rules = in.dialect->rules.number;
  if (in.words.pointed(Role::feed)) return inch(in) ? rules.largest_feed_inch : rules.largest_feed_mm;
  return inch(in) ? rules.largest_undotted_feed_inch : rules.largest_undotted_feed_mm;
}

}  // namespace

Execution feed_of(BlockContext& in, double* feed) {
  const double raw = in.words.get(Role::feed);
  const bool whole = !in.dialect->rules.number.undotted_feed_in_least_unit || in.words.pointed(Role::feed) || in.settings.calculator_reads_feed();
  const double value = whole ? raw : scaled(raw, inch(in) ? 0.0001 : 0.001);
  if (!(value >= 0) || value > largest_feed(in)) return in.raise(Condition::value_range, Role::feed, raw);
  *feed = value;
  return Execution::done;
}

namespace {

/// M700 2.1, 5.3: the value is in the range of coordinates. DGSHAPE 2-1 "range 1": the same limits for numbers with a point (the manual has the two labels
/// exchanged).
bool in_range(const BlockContext& in, double value, uint8_t flags, bool rotary) {
  const Settings& s = in.settings;
  const double last = rotary ? s.last_deg : inch(in) ? s.last_inch : s.last_mm;
  return std::fabs(value) <= last || (in.dialect->rules.number.undotted_range_is_digits && (flags & kWordPoint) == 0);
}

/// Bit i: the word of axis i is incremental.
uint32_t incremental_axes(const Interpreter& in) {
  const BlockWords& w = in.words;
  if (w.distance_once != nullptr) return is_incremental(in) ? ~uint32_t{0} : 0;
  // Families without the rule below have at most one of G90/G91 in a block, so that the order of words does not matter: the code counts
  // for the whole block.
  if (!in.distance_by_word) return in.state.modal.is(Function::incremental) ? ~uint32_t{0} : 0;
  // M700 5.1: for each axis word the G90 or G91 before it in the block counts; the last one stays modal.
  bool incremental = in.block_starts_incremental;
  uint32_t axes = 0;
  for (unsigned i = 0; i < in.block->words.size(); ++i) {
    if (((w.absolute_at >> i) & 1) != 0) incremental = false;
    if (((w.incremental_at >> i) & 1) != 0) incremental = true;
    const int axis = in.axis_of[address_of(in.block->words[i])];
    if (axis < 0) continue;
    const uint32_t bit = 1u << axis;
    axes = incremental ? axes | bit : axes & ~bit;
  }
  return axes;
}

}  // namespace

Execution resolve_axes(Interpreter& in) {
  BlockWords& w = in.words;
  w.incremental = incremental_axes(in);
  const uint32_t named = w.present & in.axis_letters;
  uint32_t axes = 0;
  for (uint32_t left = named; left != 0; left &= left - 1) {
    const auto at = static_cast<unsigned>(std::countr_zero(left));
    const auto axis = static_cast<unsigned>(in.axis_of[at]);
    axes |= 1u << axis;
    // M700 6.10: in the plane of polar coordinate interpolation the rotary axis is commanded in mm or inch.
    const bool turns = ((in.rotary >> axis) & 1) != 0 && !(in.state.map.kind == AxisMap::Kind::polar && axis == in.state.map.rotary);
    const double value = axis_value(in, axis, w.raw[at], w.flags[at], turns);
    const bool time = at == w.addresses->at(Role::dwell_seconds) && w.one_shot != nullptr && w.one_shot->function == Function::dwell;  // seconds have a range of their own
    if (!time && !in_range(in, value, w.flags[at], turns)) return in.raise(Condition::value_range, letter_of(at), w.raw[at]);
    w.axis[axis] = value;
  }
  w.axes = axes;
  w.incremental &= axes;
  // M700 10.5, precaution (2), and (2), note: this is checked as the block is read.
  if ((axes & in.closed_axes) != 0 && (w.one_shot == nullptr || goes_to_position(w.one_shot->function)))
    return in.raise_axis(Condition::no_reference, static_cast<unsigned>(std::countr_zero(axes & in.closed_axes)));
  for (uint32_t lengths = w.present & in.dialect->length_addresses; lengths != 0; lengths &= lengths - 1) {
    const unsigned at = first_of(lengths);
    if (!in_range(in, length_value(in, w.raw[at], w.flags[at], false, true), w.flags[at], false)) return in.raise(Condition::value_range, letter_of(at), w.raw[at]);
  }
  return Execution::done;
}

}  // namespace nc
