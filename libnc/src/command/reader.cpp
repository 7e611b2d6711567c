// SPDX-License-Identifier: Apache-2.0
#include "command/reader.hpp"

#include <algorithm>
#include <iterator>

#include "dialect/precedence.hpp"
#include "modal/modes.hpp"

namespace nc {
namespace {

/// G51 and G68: appendix 2 has no row for them, so it does not say to which code the words belong when another such code stands in the block.
bool shares_no_words(Function function) { return function == Function::scaling_on || function == Function::rotation_on; }

bool in_position_range(const RangeRules& range, double mm) {
  constexpr double kNoise = 1e-9;
  return mm > range.least_in_position_mm - kNoise && mm < range.most_in_position_mm + kNoise;
}

}  // namespace

class CommandReader {
 public:
  CommandReader(const Block& block, FrontEnd& front, Command& command) : block_(block), front_(front), w_(command) {}

  Reading read();

 private:
  void clear();
  Reading take_code(double value);
  Reading give_words(const FunctionRow& row, double value);
  Reading leave_out_earlier(Mode mode);
  Reading check_call_ends();
  Reading take_misc(double value);
  Reading take_option(const Word& word, double value);
  Reading take_corner_code();
  Reading check_words_stand_once(WordSet twice);
  bool calls_another(unsigned first) const;
  bool ends_call_behind(unsigned first) const;
  bool calls_sub() const;

  const Block& block_;
  FrontEnd& front_;
  Command& w_;
};

/// Puts a G code of the block into the command by its function.
Reading CommandReader::take_code(double value) {
  const FunctionRow* const row = front_.codes->find(value);
  if (row == nullptr) return front_.refuse(Condition::illegal_g, Role::code, value);
  if (front_.checks_codes || row->missing != nullptr) {
    const Reading may = front_.questions->check_code(front_.core, *row, value);
    if (may != Reading::done) return may;
  }
  const Mode mode = mode_of(row->function);
  const bool only_last = !front_.dialect->rules.block.words_stand_once && mode != Mode::none && mode != Mode::interpolation;
  if (only_last && !w_.functions.empty()) {
    const Reading left = leave_out_earlier(mode);
    if (left != Reading::done) return left;
  }
  if (!w_.functions.push_back(row)) return front_.refuse(Condition::format_error, Role::code, value);
  return give_words(*row, value);
}

/// M700 3.7 note 2, DGSHAPE 1: of several codes of one group the last one counts. What stands before it is as if it were not written, so that it takes no
/// words either: G68 G69 X0 Y0 R90. The modes of interpolation have blocks of their own (M700 6.9, 6.10), in which a second code is a fault.
Reading CommandReader::leave_out_earlier(Mode mode) {
  Command& w = w_;
  bool earlier = false;
  for (const FunctionRow* row : w.functions) earlier = earlier || mode_of(row->function) == mode;
  if (!earlier) return Reading::done;
  const auto all = w.functions;
  w.functions.clear();
  w.one_shot = w.motion = w.cycle = nullptr;
  for (const FunctionRow* row : all) {
    if (mode_of(row->function) == mode) continue;
    w.functions.push_back(row);
    const Reading given = give_words(*row, row->code / 10.0);
    if (given != Reading::done) return given;
  }
  return Reading::done;
}

/// Decides what the words of the block belong to, now that it has this code, too.
Reading CommandReader::give_words(const FunctionRow& code, double value) {
  Command& w = w_;
  const FunctionRow* const row = &code;
  switch (row->function) {
    case Function::exact_stop_once: w.exact_stop = true; return Reading::done;
    case Function::corner_behind: w.corner_code = row; return Reading::done;
    case Function::absolute_once:
    case Function::incremental_once: w.distance_once = row; return Reading::done;
    case Function::comp_entry: w.comp_entry = true; return Reading::done;
    case Function::stroke_check_on:
      if (w.one_shot != nullptr && w.one_shot->function == Function::holes_on_grid) return Reading::done;  // M700 13.2, G37.1 note 5
      w.one_shot = row;
      return Reading::done;
    case Function::macro_modal:
    case Function::macro_every_block:
      w.one_shot = row;  // takes the words of the block though it is modal
      return Reading::done;
    case Function::scaling_on:
    case Function::rotation_on:
      if (w.one_shot != nullptr) return front_.refuse(Condition::format_error, Role::code, value);
      w.one_shot = row;
      return Reading::done;
    case Function::mirror_on:
    case Function::mirror_off:  // G51.1 and G50.1 take the words, unless by App. 2 they belong to another code of the block
      if (w.one_shot != nullptr && precedence_of(*front_.dialect, w.one_shot->function).mirror == Precedence::ignored) return Reading::done;
      w.one_shot = row;
      return Reading::done;
    default: break;
  }
  const Mode mode = mode_of(row->function);
  if (mode == Mode::none || mode == Mode::interpolation) {
    if (w.one_shot != nullptr && shares_no_words(w.one_shot->function)) return front_.refuse(Condition::format_error, Role::code, value);
    w.one_shot = row;
  } else if (mode == Mode::motion) {
    w.motion = row;
  } else if (mode == Mode::cycle) {
    w.cycle = row;
  }
  return Reading::done;
}

Reading CommandReader::take_misc(double value) {
  uint32_t code = 0;
  const double within = front_.dialect->rules.block.whole_words_within;
  if (within >= 0 && !make_whole(within, &value)) return front_.refuse(Condition::format_error, Role::misc_code, value);
  if (!whole_number(value, &code)) return front_.refuse(Condition::value_range, Role::misc_code, value);
  const MiscRow* row = find_misc(*front_.dialect, code);
  const Dialect& dialect = *front_.dialect;
  if (row == nullptr && dialect.rules.auxiliary.codes_are_listed && !puts_out(dialect, code)) return front_.refuse(Condition::illegal_g, Role::misc_code, code);
  if (row != nullptr && row->missing != nullptr) return front_.refuse(Condition::no_function, Role::misc_code, code);
  return w_.auxiliary.push_back(auxiliary_of(dialect, *front_.misc_codes, row, code)) ? Reading::done : front_.refuse(Condition::format_error, Role::misc_code, value);
}

/// A word behind a comma.
Reading CommandReader::take_option(const Word& word, double value) {
  Command& w = w_;
  const FrontEnd& front = front_;
  constexpr Role kOptions[] = {Role::option_in_position,   Role::option_in_position_drill, Role::option_device, Role::option_return_speed, Role::option_angle,
                               Role::option_chamfer, Role::option_corner_radius};
  const bool known = std::any_of(std::begin(kOptions), std::end(kOptions), [&](Role role) { return front.is(word, role); });
  if (known && (word.flags & kWordNoValue) != 0 && !front.dialect->rules.block.bare_word_is_zero) return front_.refuse(Condition::format_error, slot_of(word));
  if (front.is(word, Role::option_in_position) || front.is(word, Role::option_in_position_drill)) {
    const double width = front.questions->length(front.core, Written{value, word.flags});
    if (!in_position_range(front.dialect->rules.range, width)) return front_.refuse(Condition::value_range, slot_of(word), value);
    (front.is(word, Role::option_in_position) ? w.in_position : w.in_position_drill) = width;
    return Reading::done;
  }
  if (front.is(word, Role::option_device)) {
    uint32_t device = 0;
    if (!whole_number(value, &device) || device > 4) return front_.refuse(Condition::value_range, Role::option_device, value);
    w.device = static_cast<int8_t>(device);
    return Reading::done;
  }
  if (front.is(word, Role::option_return_speed)) {
    w.has_return_speed = true;
    w.return_speed = value;
    return Reading::done;
  }
  if (front.is(word, Role::option_angle)) {  // M700 13.8
    w.has_angle = true;
    w.angle = {value, word.flags};
    return Reading::done;
  }
  const bool chamfer = front.is(word, Role::option_chamfer);  // M700 13.7
  if (!chamfer && !front.is(word, Role::option_corner_radius)) return front_.refuse(Condition::no_function, slot_of(word), value);
  if (w.corner != Corner::none && front.dialect->rules.block.corner_words_exclude) return front_.refuse(Condition::two_words, slot_of(word), value);
  w.corner = chamfer ? Corner::chamfer : Corner::rounding;
  w.corner_size = {value, word.flags};
  return Reading::done;
}

bool CommandReader::calls_sub() const {
  for (const Auxiliary& auxiliary : w_.auxiliary)
    if (auxiliary.function == MiscFunction::call_sub) return true;
  return false;
}

/// Series 8 G10: L or R is the corner that the line of the block ends with.
Reading CommandReader::take_corner_code() {
  Command& w = w_;
  const bool round = w.has(Role::option_corner_radius), cut = w.has(Role::option_chamfer);
  if (round == cut) return front_.refuse_code(round ? Condition::two_words : Condition::words_missing, *w.corner_code);
  const Role word = round ? Role::option_corner_radius : Role::option_chamfer;
  w.corner = round ? Corner::rounding : Corner::chamfer;
  w.corner_size = w.written(word);
  w.present &= ~set_of(front_.dialect->addresses.word(word));
  return Reading::done;
}

/// Behind the macro call that is word `first` stands another macro call, of a different kind.
bool CommandReader::calls_another(unsigned first) const {
  for (unsigned i = first + 1; i < block_.words.size(); ++i) {
    const FunctionRow* const row = front_.code_of(block_.words[i]);
    if (row != nullptr && is_macro_call(row->function) && row->function != w_.one_shot->function) return true;
  }
  return false;
}

/// Behind the modal macro call that is word `first` stands the code that ends it, which is the one that counts (M700 3.7 note 2).
bool CommandReader::ends_call_behind(unsigned first) const {
  if (mode_of(w_.one_shot->function) != Mode::macro || front_.dialect->rules.block.words_stand_once) return false;
  for (unsigned i = first + 1; i < block_.words.size(); ++i) {
    const FunctionRow* const row = front_.code_of(block_.words[i]);
    if (row != nullptr && row->function == Function::macro_modal_off) return true;
  }
  return false;
}

/// M700 13.5.1: G67 without a modal call in force.
Reading CommandReader::check_call_ends() {
  if (front_.dialect->rules.program.modal_end_may_stand_alone) return Reading::done;
  for (const FunctionRow* row : w_.functions)
    if (row->function == Function::macro_modal_off && !front_.questions->has_modal_call(front_.core)) return front_.refuse_code(Condition::cancel_without_call, *row);
  return Reading::done;
}

/// Checks words that may stand only once. `twice`: those that the block has more than once. The codes that are no modes are a group of their own, of which a
/// block has one, too (RS-274/NGC 3.4, table 4, group 0).
Reading CommandReader::check_words_stand_once(WordSet twice) {
  const Command& w = w_;
  if (twice != 0) return front_.refuse(Condition::format_error, first_word(twice), w.get(first_word(twice)));
  for (unsigned i = 1; i < w.functions.size(); ++i)
    for (unsigned k = 0; k < i; ++k)
      if (mode_of(w.functions[i]->function) == mode_of(w.functions[k]->function)) return front_.refuse_code(Condition::format_error, *w.functions[i]);
  return Reading::done;
}

void CommandReader::clear() {
  Command& w = w_;
  w.present = 0;
  w.target.clear();
  w.functions.clear();
  w.auxiliary.clear();
  w.one_shot = w.motion = w.cycle = nullptr;
  w.exact_stop = w.fin_behind_dwell = w.stops_given_out = w.moved_before = w.comp_entry = false;
  w.corner_code = w.distance_once = nullptr;
  w.in_position = w.in_position_drill = 0;
  w.counted_feeds = 0;
  w.device = 0;
  w.has_angle = false;
  w.corner = Corner::none;
  w.has_tap_control = w.has_return_speed = false;
  w.absolute_at = w.incremental_at = 0;
  w.bare_axis = w.late_number = kNoWord;
  w.vacant_feed = Command::kNoVariable;
}

Reading CommandReader::read() {
  FrontEnd& front = front_;
  const WordSet codes = front.code_words;
  const Dialect& dialect = *front.dialect;
  Command& w = w_;
  clear();
  const Word* const words = block_.words.begin();
  const unsigned count = block_.words.size();
  WordSet present = 0, twice = 0;
  for (unsigned i = 0; i < count; ++i) {
    const Word& word = words[i];
    const unsigned at = index_of(slot_of(word));
    double value = word.value;
    // Nearly all words are like this: a number behind a letter that is neither that of a code nor that of a block number.
    if ((word.flags & (kWordExpression | kWordComma | kWordCount | kWordNoValue)) == 0 && ((codes >> at) & 1) == 0) {
      twice |= present & 1u << at;
      present |= 1u << at;
      w.value_[at] = value;
      w.form_[at] = word.flags;
      continue;
    }
    if ((word.flags & kWordExpression) != 0) {
      Value v;
      const Reading read = front.evaluate_code(block_, word.code, &v);
      if (read != Reading::done) return read;
      if (v.vacant) {  // M700 13.5.4: a word with only a vacant variable is ignored
        if (uint32_t number = 0; front.is(word, Role::feed) && lone_variable(block_, word.code, &number)) w.vacant_feed = number;
        continue;
      }
      value = v.number;
    }
    if ((word.flags & kWordComma) != 0) {
      const Reading read = take_option(word, value);
      if (read != Reading::done) return read;
      continue;
    }
    if ((word.flags & kWordCount) != 0) {
      if (!front.is(word, Role::feed) || word.index < 1 || word.index > 8) return front.refuse(Condition::format_error, slot_of(word), word.index);
      w.counted_feeds = static_cast<uint8_t>(w.counted_feeds | 1u << (word.index - 1));
      w.counted_feed[word.index - 1] = value;
      continue;
    }
    const bool bare = (word.flags & kWordNoValue) != 0;
    const bool bare_is_zero = dialect.rules.block.bare_word_is_zero && !front.is(word, Role::code);
    if (bare && (front.is(word, Role::misc_code) || !(dialect.bare_letters || bare_is_zero))) return front.refuse(Condition::format_error, slot_of(word));
    if (front.is(word, Role::code)) {
      const Reading read = take_code(value);
      if (read != Reading::done) return read;
      if (w.functions.back()->function == Function::absolute) w.absolute_at |= uint64_t{1} << i;
      if (w.functions.back()->function == Function::incremental) w.incremental_at |= uint64_t{1} << i;
      if (w.one_shot != nullptr && is_macro_call(w.one_shot->function)) {
        // All further words are arguments. M700 App.2: G65 beside G66 is an error.
        if (calls_another(i)) return front.refuse(Condition::format_error, Role::code, value);
        if (!ends_call_behind(i)) break;
      }
      continue;
    }
    if (front.is(word, Role::misc_code)) {
      const Reading read = take_misc(value);
      if (read != Reading::done) return read;
      continue;
    }
    if (front.is(word, Role::sequence_number) || front.is(word, Role::program_number)) w.late_number = slot_of(word);
    if (bare && !bare_is_zero) {  // any other word needs a number
      if (front.axis_words->axis(slot_of(word)) < 0) return front.refuse(Condition::format_error, slot_of(word));
      w.bare_axis = slot_of(word);
      value = 0;
    }
    twice |= present & 1u << at;
    present |= 1u << at;
    w.value_[at] = value;
    w.form_[at] = word.flags;
  }
  w.present = present;
  if ((twice != 0 || w.functions.size() > 1) && dialect.rules.block.words_stand_once) {
    const Reading once = check_words_stand_once(twice);
    if (once != Reading::done) return once;
  }
  if (!w.functions.empty()) {
    const Reading ends = check_call_ends();
    if (ends != Reading::done) return ends;
  }
  if (w.device != 0 && !calls_sub()) return front.refuse(Condition::no_function, Role::option_device, w.device);
  return w.corner_code != nullptr ? take_corner_code() : Reading::done;
}

Reading read_command(const Block& block, FrontEnd& front, Command& command) { return CommandReader(block, front, command).read(); }

uint32_t incremental_axes(const Block& block, const AxisWords& axis_words, const Command& command, bool incremental) {
  uint32_t axes = 0;
  for (unsigned i = 0; i < block.words.size(); ++i) {
    if (((command.absolute_at >> i) & 1) != 0) incremental = false;
    if (((command.incremental_at >> i) & 1) != 0) incremental = true;
    const int axis = axis_words.axis(slot_of(block.words[i]));
    if (axis < 0) continue;
    const uint32_t bit = 1u << axis;
    axes = incremental ? axes | bit : axes & ~bit;
  }
  return axes;
}

}  // namespace nc
