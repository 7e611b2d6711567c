// SPDX-License-Identifier: Apache-2.0
// Words -> values: expressions, the G and M codes of the block, units and decimal point rules.
#include "interpret/block_words.hpp"

#include <bit>
#include <cmath>
#include <initializer_list>

#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "modal/company.hpp"

namespace nc {
namespace {

/// A G or M number that came out of an expression may carry representation noise.
bool near_integer(double value, double* integer) {
  *integer = std::nearbyint(value);
  return std::fabs(value - *integer) < 1e-6;
}

/// Row of a G code as it is written, nullptr = there is none; `code` is its number times 10.
const FunctionRow* row_of(const Interpreter& in, double value, double* code) {
  const bool direct = value >= 0 && value < Interpreter::kDirectCodes;
  const int whole = direct ? static_cast<int>(value) : 0;
  if (direct && whole == value) {
    *code = whole * 10;
    return in.direct_function[whole];
  }
  if (!near_integer(value * 10, code) || *code < 0 || *code > 9999) return nullptr;
  return find_function(*in.dialect, static_cast<int>(*code));
}

/// The code of group 1 that will be in force when the whole block has been read, as far as its codes are plain numbers.
int16_t motion_of_block(const Interpreter& in) {
  int16_t motion = in.state.modal.code[kGroupMotion];
  for (const Word& word : in.block->words) {
    if (word.letter != 'G' || (word.flags & kWordExpression) != 0) continue;
    double code = 0;
    const FunctionRow* const row = row_of(in, word.value, &code);
    if (row != nullptr && row->group == kGroupMotion) motion = row->code;
  }
  return motion;
}

/// Codes that a mode in force does not bear. A curve that the block itself leaves bears everything.
Did check_modes(Interpreter& in, const FunctionRow& row, double value) {
  const State& state = in.state;
  const int16_t motion = bars_codes(state.modal.code[kGroupMotion]) ? motion_of_block(in) : int16_t{0};
  if (is_space_arc(state.modal.code[kGroupMotion]) && is_space_arc(motion)) {
    const Did did = check_in_space_arc(in, row);
    if (did != Did::done) return did;
  }
  const unsigned modes = (state.modal.code[kGroupPolarCommand] == 160 ? unsigned{kInPolarCommand} : 0u) |
                         (state.frame[state.depth].figure != 0 ? unsigned{kInFigure} : 0u) |
                         (is_exponential(state.modal.code[kGroupMotion]) && is_exponential(motion) ? unsigned{kInExponential} : 0u) |
                         (state.comp.side != 0 && in.dialect->id == NC_DIALECT_DGSHAPE ? unsigned{kInDiameterOffset} : 0u);
  const Condition bad = modes != 0 ? barred(modes, row.code) : Condition::none;
  return bad == Condition::none ? Did::done : in.raise(bad, 'G', value);
}

/// G51, G68: appendix 2 has no row for them, so whose the words would be beside another such code is not said.
bool shares_no_words(Function function) { return function == Function::scaling_on || function == Function::rotation_on; }

/// Files a G code under what it is.
Did take_g(Interpreter& in, double value) {
  double code = 0;
  const FunctionRow* const row = row_of(in, value, &code);
  if (row == nullptr) return in.raise(Condition::illegal_g, 'G', value);
  if (in.state.special != 0 || in.state.mapped || in.state.comp.side != 0 || bars_codes(in.state.modal.code[kGroupMotion])) {
    const Did did = check_modes(in, *row, value);
    if (did != Did::done) return did;
  }
  if (row->function == Function::missing) {
    if (in.state.fine_mode != FineMode::none) return in.raise(Condition::illegal_g, 'G', value);  // M700 13.17: not in its list, fitted or not
    const bool excluded = refused_in_inverse_time(row->code) && inverse_time_so_far(in);
    return excluded ? in.raise(Condition::inverse_time_code, 'G', value) : in.raise(Condition::no_function, 'G', code);
  }
  BlockWords& w = in.words;
  if (!w.g.push_back(row)) return in.raise(Condition::format_error, 'G', value);
  switch (row->function) {
    case Function::exact_stop_once: w.exact_stop = true; return Did::done;
    case Function::modal_off: return Did::done;
    case Function::macro_modal_off:  // M700 13.5.1: G67 without a modal call in force
      return has_modal_call(in) ? Did::done : in.raise(Condition::cancel_without_call, 'G', value);
    case Function::macro_modal:
    case Function::macro_every_block:
    case Function::stroke_check_on:
      w.one_shot = row;  // takes the words of the block though it is modal
      w.one_shot_code = static_cast<int16_t>(code);
      return Did::done;
    case Function::scaling_on:
    case Function::rotation_on:
      if (w.one_shot != nullptr) return in.raise(Condition::format_error, 'G', value);
      w.one_shot = row;
      w.one_shot_code = static_cast<int16_t>(code);
      return Did::done;
    case Function::mirror_on:
    case Function::mirror_off:  // So does this, unless App. 2 lets another one take them.
      if (w.one_shot != nullptr && company_of(w.one_shot->function).mirror == Beside::ignored) return Did::done;
      w.one_shot = row;
      w.one_shot_code = static_cast<int16_t>(code);
      return Did::done;
    default: break;
  }
  if (row->group == kGroupOneShot || row->group == kGroupInterpolationMode) {
    if (w.one_shot != nullptr && shares_no_words(w.one_shot->function)) return in.raise(Condition::format_error, 'G', value);
    w.one_shot = row;
    w.one_shot_code = static_cast<int16_t>(code);
  } else if (row->group == kGroupMotion) {
    w.motion = row;
  } else if (row->group == kGroupCycle) {
    w.cycle = row;
  }
  return Did::done;
}

Did take_m(Interpreter& in, double value) {
  uint32_t code = 0;
  if (!whole_number(value, &code)) return in.raise(Condition::value_range, 'M', value);
  const MiscRow* row = find_misc(*in.dialect, code);
  if (row != nullptr && row->function == MiscFunction::missing) return in.raise(Condition::no_function, 'M', code);
  if (!in.words.m.push_back(code)) return in.raise(Condition::format_error, 'M', value);
  return Did::done;
}

/// M700 13.1.1: "0.001 to 999.999 (mm)"; 6.1 and 6.2 print no range for the same word.
bool in_position_range(double mm) { return mm > 0.001 - 1e-9 && mm < 999.999 + 1e-9; }

/// M98: what ,D belongs to.
bool calls_program(const BlockWords& w) {
  for (const uint32_t m : w.m)
    if (m == 98) return true;
  return false;
}

/// M700 14.10 prints "G28 XYZ", 6.9 "G19 Z C", and 6.16 (4) has "G07 Y": zeros. A word of any other block is a letter and a number (3.2 (1)).
bool takes_bare_axes(const BlockWords& w) {
  if (w.one_shot != nullptr) return w.one_shot->function == Function::reference_return || w.one_shot->function == Function::hypothetical_axis;
  for (const FunctionRow* row : w.g)
    if (row->group == kGroupPlane) return true;
  return false;
}

/// Behind the macro call that is word `first` there is one of another kind.
bool calls_another(const Interpreter& in, unsigned first) {
  for (unsigned i = first + 1; i < in.block->words.size(); ++i) {
    const Word& word = in.block->words[i];
    if (word.letter != 'G' || (word.flags & kWordExpression) != 0) continue;
    double code = 0;
    const FunctionRow* const row = row_of(in, word.value, &code);
    if (row != nullptr && is_macro_call(row->function) && row->code != in.words.one_shot->code) return true;
  }
  return false;
}

/// For the alarm of the move that has no feed because of it (alarm_cause.cpp).
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

bool BlockWords::pointed(char letter) const { return (flags[letter - 'A'] & (kWordPoint | kWordExpression)) != 0; }

Did gather_words(Interpreter& in) {
  constexpr uint32_t kCodes = letters("GMNO");
  BlockWords& w = in.words;
  w.present = w.axes = w.incremental = 0;
  w.g.clear();
  w.m.clear();
  w.one_shot = w.motion = w.cycle = nullptr;
  w.one_shot_code = 0;
  w.exact_stop = w.fin_behind_dwell = false;
  w.in_position = w.in_position_drill = 0;
  w.counted_feeds = 0;
  w.device = 0;
  w.absolute_at = w.incremental_at = 0;
  const Word* const words = in.block->words.begin();
  const unsigned count = in.block->words.size();
  uint32_t present = 0;
  char bare_axis = 0;
  w.late_number = 0;
  for (unsigned i = 0; i < count; ++i) {
    const Word& word = words[i];
    const unsigned at = static_cast<unsigned>(word.letter - 'A');
    double value = word.value;
    // Nearly all words: a number behind a letter that is neither a code nor the number of the block.
    if ((word.flags & (kWordExpression | kWordComma | kWordCount | kWordNoValue)) == 0 && ((kCodes >> at) & 1) == 0) {
      present |= 1u << at;
      w.raw[at] = value;
      w.flags[at] = word.flags;
      continue;
    }
    if ((word.flags & kWordExpression) != 0) {
      Value v;
      const Eval eval = evaluate(*in.block, word.code, variable_reader(in), EvalOptions{in.settings.asin_0_360}, &v, &in.fault,
                                 &in.sync_needed);
      if (eval == Eval::fault) return Did::fault;
      if (eval == Eval::need_sync) return Did::sync;
      if (v.vacant) {  // M700 13.5.4: a word with only a vacant variable is ignored
        if (word.letter == 'F') note_vacant_feed(in, word);
        continue;
      }
      value = v.number;
    }
    if ((word.flags & kWordComma) != 0 && (word.letter == 'I' || word.letter == 'J') && in.dialect->id == NC_DIALECT_M700) {
      const double width = length_value(in, value, word.flags, false, true);
      if (!in_position_range(width)) return in.raise(Condition::value_range, word.letter, value);
      (word.letter == 'I' ? w.in_position : w.in_position_drill) = width;
      continue;
    }
    if ((word.flags & kWordComma) != 0 && word.letter == 'D' && in.dialect->id == NC_DIALECT_M700) {
      uint32_t device = 0;
      if (!whole_number(value, &device) || device > 4) return in.raise(Condition::value_range, 'D', value);
      w.device = static_cast<int8_t>(device);
      continue;
    }
    if ((word.flags & kWordComma) != 0) {  // M700 13.7 ,C ,R; 13.8 ,A; 13.1.1 ,S of a tap
      const bool corner = word.letter == 'C' || word.letter == 'R';
      return in.raise(corner ? Condition::corner_option : word.letter == 'A' ? Condition::geometric_option : Condition::no_function, word.letter, value);
    }
    if ((word.flags & kWordCount) != 0) {
      if (word.letter != 'F' || word.index < 1 || word.index > 8) return in.raise(Condition::format_error, word.letter, word.index);
      w.counted_feeds = static_cast<uint8_t>(w.counted_feeds | 1u << (word.index - 1));
      w.counted_feed[word.index - 1] = value;
      continue;
    }
    const bool bare = (word.flags & kWordNoValue) != 0;
    if (bare && (word.letter == 'M' || !in.dialect->bare_letters)) return in.raise(Condition::format_error, word.letter);
    if (word.letter == 'G') {
      const Did did = take_g(in, value);
      if (did != Did::done) return did;
      if (w.g.back()->function == Function::absolute) w.absolute_at |= uint64_t{1} << i;
      if (w.g.back()->function == Function::incremental) w.incremental_at |= uint64_t{1} << i;
      if (in.words.one_shot != nullptr && is_macro_call(in.words.one_shot->function)) {
        // The rest are arguments. M700 App.2: G65 beside G66 is an error.
        if (calls_another(in, i)) return in.raise(Condition::format_error, 'G', value);
        break;
      }
      continue;
    }
    if (word.letter == 'M') {
      const Did did = take_m(in, value);
      if (did != Did::done) return did;
      continue;
    }
    if (word.letter == 'N' || word.letter == 'O') w.late_number = word.letter;
    if (bare) {  // any other address needs a number
      if (in.axis_of[at] < 0) return in.raise(Condition::format_error, word.letter);
      bare_axis = word.letter;
      value = 0;
    }
    present |= 1u << at;
    w.raw[at] = value;
    w.flags[at] = word.flags;
  }
  w.present = present;
  if (w.device != 0 && !calls_program(w)) return in.raise(Condition::no_function, 'D', w.device);
  if (bare_axis != 0 && !takes_bare_axes(w)) return in.raise(Condition::format_error, bare_axis);
  // M700 15.5: feeds behind a skip signal belong to G31.
  if (w.counted_feeds != 0 && (w.one_shot == nullptr || w.one_shot->function != Function::skip)) return in.raise(Condition::format_error, 'F');
  return Did::done;
}

// ---- units -----------------------------------------------------------------------------------------------------------

namespace {

/// raw * unit, computed as a division by the whole number 1/unit where that is exact: 12345 * 0.001 is 12.345 and nothing else.
double scaled(double raw, double unit) {
  if (unit >= 1) return raw * unit;
  return raw / std::nearbyint(1 / unit);
}

bool inch(const Interpreter& in) { return in.state.modal.code[kGroupUnit] == 200; }

/// DGSHAPE 3: which words the calculator type reads as whole units.
bool dgshape_whole_units(const Interpreter& in, bool feed) {
  if (!in.settings.calculator) return false;
  switch (in.settings.calculator_words) {
    case 0: return false;
    case 1: return true;
    case 2: return feed;
    default: return !feed;
  }
}

}  // namespace

double length_value(const Interpreter& in, double raw, uint8_t flags, bool rotary, bool setting_unit, bool tenfold) {
  const bool pointed = (flags & (kWordPoint | kWordExpression)) != 0;
  const bool in_inch = inch(in) && !rotary;
  const Settings& s = in.settings;
  double value = raw;
  if (!pointed) {
    if (in.dialect->id == NC_DIALECT_DGSHAPE) {
      if (!dgshape_whole_units(in, false)) value = scaled(raw, in_inch ? 0.0001 : 0.001);
    } else if (!s.decimal_type_2) {  // M700 5.3, type I: the least command unit; tenfold 2.2
      const double unit = setting_unit ? (rotary ? s.setting_unit_deg : in_inch ? s.setting_unit_inch : s.setting_unit_mm)
                                       : (rotary ? s.command_unit_deg : in_inch ? s.command_unit_inch : s.command_unit_mm);
      value = scaled(tenfold ? raw * s.tenfold : raw, unit);
    }
  }
  return in_inch ? value * 25.4 : value;
}

double axis_value(const Interpreter& in, unsigned axis, double raw, uint8_t flags, bool rotary) {
  const Settings& s = in.settings;
  const bool pointed = (flags & (kWordPoint | kWordExpression)) != 0;
  if (((s.own_unit_axes >> axis) & 1) == 0 || pointed || s.decimal_type_2) return length_value(in, raw, flags, rotary, false);
  const bool in_inch = inch(in) && !rotary;
  const double value = scaled(raw * s.tenfold, in_inch ? s.own_unit[axis] / 10 : s.own_unit[axis]);
  return in_inch ? value * 25.4 : value;
}

double length_of(const Interpreter& in, char letter, bool setting_unit) {
  const unsigned at = static_cast<unsigned>(letter - 'A');
  return length_value(in, in.words.raw[at], in.words.flags[at], false, setting_unit);
}

namespace {

/// M700 5.3; DGSHAPE 2-1 "range 1". In mm/min or inch/min.
double largest_feed(const Interpreter& in) {
  if (in.dialect->id == NC_DIALECT_M700) return inch(in) ? 1e6 : 1e7;
  if (!in.words.pointed('F')) return 99999999;
  return inch(in) ? 9999.9999 : 99999.999;
}

}  // namespace

Did feed_of(Interpreter& in, double* feed) {
  const double raw = in.words.get('F');
  // M700 7.2: F1 = 1.000 in both decimal point types. DGSHAPE 3: 0.001 mm/min (0.0001 inch/min) unless the calculator type reads F.
  const bool whole = in.dialect->id != NC_DIALECT_DGSHAPE || in.words.pointed('F') || dgshape_whole_units(in, true);
  const double value = whole ? raw : scaled(raw, inch(in) ? 0.0001 : 0.001);
  if (!(value >= 0) || value > largest_feed(in)) return in.raise(Condition::value_range, 'F', raw);
  *feed = value;
  return Did::done;
}

namespace {

/// M700 2.1, 5.3. DGSHAPE 2-1 "range 1": the same numbers with a point (the two labels are exchanged in print); without one eight digits of
/// whatever unit the word is read in.
bool in_range(const Interpreter& in, double value, uint8_t flags, bool rotary) {
  const Settings& s = in.settings;
  const double last = rotary ? s.last_deg : inch(in) ? s.last_inch : s.last_mm;
  return std::fabs(value) <= last || (in.dialect->id == NC_DIALECT_DGSHAPE && (flags & kWordPoint) == 0);
}

/// Axes whose words count from where the axis is.
uint32_t incremental_axes(const Interpreter& in) {
  const BlockWords& w = in.words;
  // Families without the rule below have at most one of G90/G91 in a block, so that the order of words does not matter: the code counts
  // for the whole block.
  if (!in.distance_by_word) return in.state.modal.code[kGroupDistance] == 910 ? ~uint32_t{0} : 0;
  // M700 5.1: each axis word goes by the G90/G91 before it in the block; the last one stays modal.
  bool incremental = in.block_starts_incremental;
  uint32_t axes = 0;
  for (unsigned i = 0; i < in.block->words.size(); ++i) {
    if (((w.absolute_at >> i) & 1) != 0) incremental = false;
    if (((w.incremental_at >> i) & 1) != 0) incremental = true;
    const int axis = in.axis_of[in.block->words[i].letter - 'A'];
    if (axis < 0) continue;
    const uint32_t bit = 1u << axis;
    axes = incremental ? axes | bit : axes & ~bit;
  }
  return axes;
}

}  // namespace

Did resolve_axes(Interpreter& in) {
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
    const char letter = static_cast<char>('A' + at);
    const bool time = letter == 'X' && w.one_shot != nullptr && w.one_shot->function == Function::dwell;  // seconds: a range of its own
    if (!time && !in_range(in, value, w.flags[at], turns)) return in.raise(Condition::value_range, letter, w.raw[at]);
    w.axis[axis] = value;
  }
  w.axes = axes;
  w.incremental &= axes;
  // M700 10.5, precaution (2), and (2), note: checked as the block is read.
  if ((axes & in.closed_axes) != 0 && (w.one_shot == nullptr || goes_to_position(w.one_shot->function)))
    return in.raise_axis(Condition::no_reference, static_cast<unsigned>(std::countr_zero(axes & in.closed_axes)));
  if (!w.any(letters("IJKQR"))) return Did::done;
  for (const char letter : {'I', 'J', 'K', 'Q', 'R'})
    if (w.has(letter) && !in_range(in, length_of(in, letter), w.flags[letter - 'A'], false)) return in.raise(Condition::value_range, letter, w.get(letter));
  return Did::done;
}

}  // namespace nc
