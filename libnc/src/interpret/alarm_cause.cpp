// SPDX-License-Identifier: Apache-2.0
// Why a block has raised an alarm, where the fault itself does not say it: an option that is off, a code of another control, a vacant variable. All this is
// found when the block is given up; while programs run nothing is noted for it, except a vacant F.
#include <cstring>

#include "dialect/alarms.hpp"
#include "dialect/common_options.hpp"
#include "dialect/foreign_codes.hpp"
#include "dialect/foreign_words.hpp"
#include "dialect/text.hpp"
#include "interpret/interpreter.hpp"

namespace nc {
namespace {

// ---- options --------------------------------------------------------------------------------------------------------------

bool in_range(uint32_t number, uint32_t first, uint32_t last) { return number >= first && number <= last; }

/// The smallest value of nc_config::variable_sets with which the common variable `number` exists, 0 = there is none.
unsigned sets_with(const Dialect& dialect, uint32_t number) {
  if (dialect.variables->common[0].last != 0) return 0;  // the family fixes its common variables
  for (const CommonOption& row : kCommonOptions)
    if (in_range(number, row.first, row.last)) return row.sets;
  return 0;
}

/// "#1037", as the family calls the parameter.
TextWriter& put_parameter(const Interpreter& in, ParameterOf parameter, TextWriter& out) {
  char key[kParameterKeySize];
  int bit = -1;
  return parameter_place(*in.dialect, parameter, key, &bit) ? out.put('#').put(key) : out;
}

/// Writes which option a system variable needs. False: no option is missing.
bool put_system_variable_option(const Interpreter& in, uint32_t number, TextWriter& out) {
  const VariableRow* const row = find_variable(*in.dialect->variables, number);
  if (row == nullptr) return false;
  const VariablePlace place = place_in(*row, number);
  if (row->what == SystemVariable::tool_offset && place.index >= in.frames.tool_offsets())
    out.put("The option tool_offsets is ").put_integer(in.frames.tool_offsets()).put('.');
  else if (row->what == SystemVariable::tool_offset && place.part > 0 && !in.settings.tool_memory_2)  // a wear or a radius
    put_parameter(in, Parameter::tool_memory_type, out.put("It needs tool offsets of type II (")).put(" = 2).");
  else if (row->what == SystemVariable::work_offset && place.part > Frames::kStandardSystems + in.frames.extended_systems())
    out.put("The option work_offsets is ").put_integer(in.frames.extended_systems()).put('.');
  else
    return false;
  return true;
}

/// For P241: writes which option would give the variable. False: there is no such option.
bool put_variable_option(const Interpreter& in, uint32_t number, TextWriter& out) {
  const bool exists = in.common->exists(number);  // then the alarm has another cause: it cannot have a name, for example
  const unsigned sets = exists ? 0 : sets_with(*in.dialect, number);
  if (sets != 0) {
    out.put("It comes with the option variable_sets = ").put_integer(sets).put(" or more.");
  } else if (!exists && in_range(number, kExtendedCommon.first, kExtendedCommon.last)) {
    out.put("The option extended_variables is off.");
  } else if (!exists && in_range(number, kLocals + 1, kLastOfMachine)) {
    out.put("The option variable_ranges can give it to the machine.");
  } else {
    return put_system_variable_option(in, number, out);
  }
  return true;
}

bool put_option(const Interpreter& in, TextWriter& out, bool* instead) {
  const Fault& fault = in.fault;
  if (fault.condition == Condition::variable_number && fault.has_value && fault.value >= 0 && fault.value < UINT32_MAX)
    return put_variable_option(in, static_cast<uint32_t>(fault.value), out);
  const Block* const block = in.block;
  const bool then = fault.condition == Condition::if_statement && block != nullptr && !block->has_fault &&
                    in.statement < block->statements.size() && block->statements[in.statement].kind == StatementKind::if_then;
  if (!then) return false;
  out.put("IF [...] THEN needs the option macro_extensions, which is off.");
  *instead = true;
  return true;
}

/// Writes a distance of a measurement: the word that gives it in the block, or else the parameter.
void put_distance(const Interpreter& in, Role role, ParameterOf parameter, TextWriter& out) {
  if (in.words.has(role)) put_word(out, in.word(role));
  else put_parameter(in, parameter, out);
}

/// M700 15.1 (7), HX 4.10: says what the distances and the feed of a measurement have to be, one of which is out of its range. False: the alarm is another one.
bool put_measurement(const Interpreter& in, TextWriter& out) {
  const Fault& fault = in.fault;
  const bool measures = in.block != nullptr && !in.block->has_fault && in.words.one_shot != nullptr && in.words.one_shot->function == Function::measure_length;
  if (!measures || fault.condition != Condition::value_range) return false;
  if (is_about(fault, *in.dialect, Role::feed) && !in.words.has(Role::feed)) {
    put_parameter(in, Parameter::measure_feed, out.put("The measuring feed, ")).put(", has no value.");
    return true;
  }
  if (!is_about(fault, *in.dialect, Role::measure_range) && !is_about(fault, *in.dialect, Role::measure_deceleration)) return false;
  out.put("The way to the measuring position must be longer than ");
  put_distance(in, Role::measure_deceleration, Parameter::measure_deceleration, out);
  put_distance(in, Role::measure_deceleration, Parameter::measure_deceleration, out.put(" (measuring feed), and "));
  put_distance(in, Role::measure_range, Parameter::measure_range, out.put(" longer than "));
  out.put(" (range).");
  return true;
}

// ---- codes of other controls ------------------------------------------------------------------------------------------------

bool put_foreign(const Interpreter& in, TextWriter& out) {
  const Fault& fault = in.fault;
  if (is_about(fault, *in.dialect, Role::code) && fault.has_value && (fault.condition == Condition::illegal_g || fault.condition == Condition::no_function)) {
    const char* const hint = foreign_code_hint(fault.value);
    if (hint == nullptr) return false;
    out.put(hint);
    return true;
  }
  // An O-word shows by letters without numbers, so the block must be one that could not be read; an O number before a block that can be read is no O-word.
  // It also shows as a program that has ended without M30, because behind the first blocks an O begins another program.
  const bool unreadable = in.block != nullptr && (in.block->has_fault || fault.condition == Condition::format_error ||
                                                  fault.condition == Condition::program_end || fault.condition == Condition::sub_without_return || fault.condition == Condition::variable_use);
  if (!unreadable || in.dialect->lex->formula == Formula::ngc) return false;  // this family has O-words and named parameters, and sentences of its own
  char text[160] = {};
  const TextEntry* const entry = in.store->entry(in.source.file);
  if (entry == nullptr || TextWindow::read(*entry, in.block->begin, text, sizeof text - 1) <= 0) return false;
  for (char& c : text)
    if (c == '\n' || c == '\r') c = 0;
  const LinuxcncWord word = linuxcnc_word(text);
  if (word == LinuxcncWord::none) return false;
  put_linuxcnc_hint(*in.dialect, word, out);
  return true;
}

// ---- vacant variables ---------------------------------------------------------------------------------------------------------

/// Alarms that a vacant variable may cause, and the words in which such a variable is searched for: a word that is only a vacant variable is ignored; in a
/// formula it counts as 0 (M700 13.5.4).
enum class Suspected : uint8_t { any_word, named_word, feed, lead, speed, offset, number, kind, program };
struct Suspects {
  Condition condition;
  Suspected words;
};
constexpr Suspects kSuspects[] = {
    {Condition::no_feed, Suspected::feed},
    {Condition::skip_feed_zero, Suspected::feed},
    {Condition::arc_feed_zero, Suspected::feed},
    {Condition::thread_lead, Suspected::lead},
    {Condition::surface_speed, Suspected::speed},
    {Condition::no_offset_number, Suspected::offset},
    {Condition::data_input_number, Suspected::number},
    {Condition::data_input_kind, Suspected::kind},
    {Condition::arc_center, Suspected::any_word},
    {Condition::arc_deviation, Suspected::any_word},
    {Condition::words_missing, Suspected::any_word},
    {Condition::measure_axis, Suspected::any_word},
    {Condition::nesting, Suspected::program},
    {Condition::address_missing, Suspected::named_word},
    {Condition::program_missing, Suspected::named_word},
    {Condition::sequence_missing, Suspected::named_word},
    {Condition::value_range, Suspected::named_word},
    {Condition::calculation, Suspected::any_word},
    {Condition::division_by_zero, Suspected::any_word},
    {Condition::variable_number, Suspected::any_word},
};

/// Reads variables for the evaluator, and remembers the first one that was vacant.
struct VacancyReader {
  VariableReader reader;
  uint32_t vacant = 0;
  bool found = false;
  static Eval read(void* self, uint32_t number, Value* value, Fault* fault, uint32_t* sync) {
    VacancyReader& me = *static_cast<VacancyReader*>(self);
    const Eval eval = me.reader.read(me.reader.self, number, value, fault, sync);
    if (eval == Eval::ok && value->vacant && number != 0 && !me.found) {  // #0 is vacant on purpose
      me.found = true;
      me.vacant = number;
    }
    return eval;
  }
  static bool find_name(void* self, const char* name, size_t length, uint32_t* number) {
    const VacancyReader& me = *static_cast<VacancyReader*>(self);
    return me.reader.find_name(me.reader.self, name, length, number);
  }
};

bool vacant_in(Interpreter& in, uint16_t code, uint32_t* number) {
  if (code == kNoCode) return false;
  VacancyReader vacancy{variable_reader(in)};
  const VariableReader reader{&vacancy, VacancyReader::read, VacancyReader::find_name};
  const Fault kept = in.fault;
  Value value;
  Fault fault;
  uint32_t sync = 0;
  evaluate(*in.block, code, reader, eval_options(in), &value, &fault, &sync);
  in.fault = kept;
  *number = vacancy.vacant;
  return vacancy.found;
}

WordSet suspected_words(const Interpreter& in, Suspected words) {
  switch (words) {
    case Suspected::any_word: return ~uint32_t{0};
    case Suspected::named_word: return set_of(word_of(in.fault));
    case Suspected::feed: return in.set_of({Role::feed});
    case Suspected::lead: return in.set_of({Role::thread_lead, Role::fine_thread_lead});
    case Suspected::speed: return in.set_of({Role::spindle_speed});
    case Suspected::offset: return in.set_of({Role::offset_number, Role::length_number});
    case Suspected::number: return in.set_of({Role::input_number});
    case Suspected::kind: return in.set_of({Role::input_kind});
    case Suspected::program: return in.set_of({Role::call_program});
  }
  return 0;
}

bool put_vacant_word(Interpreter& in, Suspected words, TextWriter& out) {
  const WordSet suspects = suspected_words(in, words);
  unsigned at = 0;
  WordSlot word = kNoWord;
  uint16_t code = 0;
  while (next_expression(*in.block, suspects, &at, &word, &code)) {
    uint32_t number = 0, lone = 0;
    if (!vacant_in(in, code, &number)) continue;
    if (lone_variable(*in.block, code, &lone))
      put_word(out, word).put('#').put_integer(number).put(" is vacant.");
    else
      put_word(out.put("In the value of "), word).put(", #").put_integer(number).put(" is vacant.");
    return true;
  }
  return false;
}

bool put_vacant_statement(Interpreter& in, TextWriter& out) {
  const Statement& s = in.block->statements[in.statement];
  const bool jumps = s.kind == StatementKind::if_goto || s.kind == StatementKind::go_to;
  const bool conditional = s.kind == StatementKind::if_goto || s.kind == StatementKind::while_do || s.kind == StatementKind::if_then;
  uint32_t number = 0, target = 0;
  if ((jumps || s.kind == StatementKind::assign) && vacant_in(in, s.target, &number)) {
    out.put(jumps ? "In the number behind GOTO, #" : "In the number of the variable, #").put_integer(number).put(" is vacant.");
    return true;
  }
  // A jump to a missing place is not caused by its condition, in which a vacant variable is often intended.
  if (in.fault.condition == Condition::sequence_missing || s.kind == StatementKind::go_to) return false;
  if (!(conditional || s.kind == StatementKind::assign) || !vacant_in(in, s.value, &number)) return false;
  if (conditional)
    out.put("In the condition");
  else if (constant_number(*in.block, s.target, &target))
    out.put("In the value for #").put_integer(target);
  else
    out.put("In the formula");
  out.put(", #").put_integer(number).put(" is vacant, which counts as 0.");
  return true;
}

bool put_vacant(Interpreter& in, TextWriter& out) {
  const Suspects* suspects = nullptr;
  for (const Suspects& row : kSuspects)
    if (row.condition == in.fault.condition) suspects = &row;
  if (suspects == nullptr || in.block == nullptr || in.block->has_fault) return false;
  if (in.statement < in.block->statements.size()) return put_vacant_statement(in, out);
  if (put_vacant_word(in, suspects->words, out)) return true;
  if (in.fault.condition != Condition::no_feed || in.state.vacant_feed == 0) return false;
  out.put("F#").put_integer(in.state.vacant_feed).put(" was vacant in line ").put_integer(in.state.vacant_feed_line);
  out.put(in.state.vacant_feed_file == in.source.file ? "." : " of another program.");
  return true;
}

}  // namespace

void note_cause(Interpreter& in) {
  AlarmStory& story = in.alarm_story;
  TextWriter out(story.cause.s, sizeof story.cause.s);
  if (in.fault.condition == Condition::not_accepted && in.begins_inside()) {  // HX 2.3.4
    out.put("A reset has stopped this block in its middle, ");
    if (in.words.target.incremental() != 0) out.put("from where its increments lead elsewhere.");
    else if (in.words.corner != Corner::none) out.put("at its corner, where it cannot begin.");
    else out.put("where only a line can begin.");
    out.put(" Select the program to begin at its head.");
    story.instead = true;
    return;
  }
  if (put_measurement(in, out)) {
    story.instead = true;
    return;
  }
  if (put_option(in, out, &story.instead)) return;
  if (put_foreign(in, out)) {
    story.instead = true;
    return;
  }
  put_vacant(in, out);
}

}  // namespace nc
