// SPDX-License-Identifier: Apache-2.0
// Why a block has raised an alarm, as far as the fault does not say so itself: the option that is off, the code of another control, the
// vacant variable. All of it is found when the block is given up; nothing is noted for it while programs run, but for a vacant F.
#include <cmath>
#include <cstring>

#include "dialect/alarms.hpp"
#include "dialect/text.hpp"
#include "interpret/interpreter.hpp"

namespace nc {
namespace {

// ---- options --------------------------------------------------------------------------------------------------------------

bool in_range(uint32_t number, uint32_t first, uint32_t last) { return number >= first && number <= last; }

/// Common variables that an option has (M700 13.4): the smallest value of `variable_sets` with `number`, 0 = none.
unsigned sets_with(uint32_t number) {
  constexpr struct {
    uint32_t first, last;
    unsigned sets;
  } kSets[] = {{100, 149, 100}, {500, 549, 100}, {150, 199, 200}, {550, 599, 200}, {600, 699, 300}, {700, 999, 600}};
  for (const auto& row : kSets)
    if (in_range(number, row.first, row.last)) return row.sets;
  return 0;
}

/// P241 of a variable that an option would give. False: no option has it.
bool put_variable_option(const Interpreter& in, uint32_t number, TextWriter& out) {
  const bool exists = in.common->exists(number);  // it cannot have the name that SETVN gives it, or the like
  const unsigned sets = exists ? 0 : sets_with(number);
  if (sets != 0) {
    out.put("It comes with the option variable_sets = ").put_integer(sets).put(" or more.");
  } else if (!exists && in_range(number, 900000, 907399)) {
    out.put("The option extended_variables is off.");
  } else if (!exists && in_range(number, kLocals + 1, 499)) {
    out.put("The option variable_ranges can give it to the machine.");
  } else if (in_range(number, 2001, 2800) || in_range(number, 10001, 17999)) {
    const bool wear_or_radius = number > 10999 || in_range(number, 2201, 2800);
    const uint32_t index = number < 10000 ? (number - 2001) % 200 + 1 : number % 1000;
    if (index > in.frames.tool_offsets())
      out.put("The option tool_offsets is ").put_integer(in.frames.tool_offsets()).put('.');
    else if (wear_or_radius && !in.settings.tool_memory_2)
      out.put("It needs tool offsets of type II (#1037 = 2).");
    else
      return false;
  } else if (in_range(number, 7001, 8920) && (number - 7001) / 20 >= in.frames.extended_systems()) {
    out.put("The option work_offsets is ").put_integer(in.frames.extended_systems()).put('.');
  } else {
    return false;
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

// ---- codes of other controls ------------------------------------------------------------------------------------------------

struct ForeignCode {
  double code;
  const char* hint;
};
constexpr ForeignCode kForeignCodes[] = {
    {90.1, "G90.1 (absolute arc centres) does not exist here: I J K always count from the start of the arc."},
    {91.1, "G91.1 is not known and not needed here: I J K always count from the start of the arc. Leave it out."},
};

/// Words behind the number or name of an O-word of LinuxCNC.
constexpr const char* kOWords[] = {"SUB",   "ENDSUB", "CALL",     "RETURN", "IF",       "ELSEIF",   "ELSE",
                                   "ENDIF", "WHILE",  "ENDWHILE", "DO",     "CONTINUE", "BREAK",    "REPEAT",
                                   "ENDREPEAT"};
constexpr char kOWordHint[] = "O-words of LinuxCNC do not exist here: M98 P_ and M99 or G65 call, IF [ ] GOTO and WHILE [ ] DO branch.";

char capital(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

void skip_blanks(const char** at) {
  while (**at == ' ' || **at == '\t') ++*at;
}
void skip_digits(const char** at) {
  while (**at >= '0' && **at <= '9') ++*at;
}

/// "o100 sub", "N10 O<name> call [1]", "o[#1] if [...]".
bool is_o_word(const char* at) {
  skip_blanks(&at);
  if (capital(*at) == 'N') skip_digits(&++at);
  skip_blanks(&at);
  if (capital(*at++) != 'O') return false;
  skip_blanks(&at);
  const char close = *at == '<' ? '>' : *at == '[' ? ']' : 0;
  if (close != 0) {
    at = std::strchr(at, close);
    if (at == nullptr) return false;
    ++at;
  } else {
    skip_digits(&at);
  }
  skip_blanks(&at);
  char word[12] = {};
  for (unsigned n = 0; n + 1 < sizeof word && capital(*at) >= 'A' && capital(*at) <= 'Z'; ++at) word[n++] = capital(*at);
  for (const char* known : kOWords)
    if (std::strcmp(word, known) == 0) return true;
  return false;
}

bool put_foreign(const Interpreter& in, TextWriter& out) {
  const Fault& fault = in.fault;
  if (fault.letter == 'G' && fault.has_value && (fault.condition == Condition::illegal_g || fault.condition == Condition::no_function)) {
    for (const ForeignCode& row : kForeignCodes) {
      if (std::fabs(fault.value - row.code) > 1e-6) continue;
      out.put(row.hint);
      return true;
    }
    return false;
  }
  // Letters without numbers: an O number in front of a block that makes sense is none of these.
  const bool unreadable = in.block != nullptr && (in.block->has_fault || fault.condition == Condition::format_error);
  if (!unreadable) return false;
  char text[80] = {};
  const TextEntry* const entry = in.store->entry(in.source.file);
  if (entry == nullptr || TextWindow::read(*entry, in.block->begin, text, sizeof text - 1) <= 0) return false;
  for (char& c : text)
    if (c == '\n' || c == '\r') c = 0;
  if (!is_o_word(text)) return false;
  out.put(kOWordHint);
  return true;
}

// ---- vacant variables ---------------------------------------------------------------------------------------------------------

/// Alarms that a vacant variable can be behind, and the words that are looked at for one: a word with nothing but a vacant variable is
/// ignored, in a formula it counts as 0 (M700 13.5.4). "" = the word that the fault names, "*" = any word.
struct Suspects {
  Condition condition;
  const char* letters;
};
constexpr Suspects kSuspects[] = {
    {Condition::no_feed, "F"},
    {Condition::skip_feed_zero, "F"},
    {Condition::arc_feed_zero, "F"},
    {Condition::thread_lead, "FE"},
    {Condition::surface_speed, "S"},
    {Condition::no_offset_number, "DH"},
    {Condition::g10_p, "P"},
    {Condition::g10_l, "L"},
    {Condition::arc_center, "*"},
    {Condition::arc_deviation, "*"},
    {Condition::words_missing, "*"},
    {Condition::measure_axis, "*"},
    {Condition::nesting, "P"},
    {Condition::address_missing, ""},
    {Condition::program_missing, ""},
    {Condition::sequence_missing, ""},
    {Condition::value_range, ""},
    {Condition::calculation, "*"},
    {Condition::division_by_zero, "*"},
    {Condition::variable_number, "*"},
};

/// Reads for the evaluator and remembers the first variable that was vacant.
struct VacancyReader {
  VariableReader reader;
  uint32_t vacant = 0;
  bool found = false;
  static Eval read(void* self, uint32_t number, Value* value, Fault* fault, uint32_t* sync) {
    VacancyReader& me = *static_cast<VacancyReader*>(self);
    const Eval eval = me.reader.read(me.reader.self, number, value, fault, sync);
    if (eval == Eval::ok && value->vacant && number != 0 && !me.found) {  // #0 is meant to be
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
  evaluate(*in.block, code, reader, EvalOptions{in.settings.asin_0_360}, &value, &fault, &sync);
  in.fault = kept;
  *number = vacancy.vacant;
  return vacancy.found;
}

bool put_vacant_word(Interpreter& in, const char* letters, TextWriter& out) {
  const char own[2] = {in.fault.letter, 0};
  if (*letters == 0) letters = own;
  for (const Word& word : in.block->words) {
    if ((word.flags & kWordExpression) == 0 || (*letters != '*' && std::strchr(letters, word.letter) == nullptr)) continue;
    uint32_t number = 0, lone = 0;
    if (!vacant_in(in, word.code, &number)) continue;
    if (lone_variable(*in.block, word.code, &lone))
      out.put(word.letter).put('#').put_integer(number).put(" is vacant.");
    else
      out.put("In the value of ").put(word.letter).put(", #").put_integer(number).put(" is vacant.");
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
  // Whether a condition holds is no reason for a jump that leads nowhere; a vacant variable there is often meant.
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
  if (put_vacant_word(in, suspects->letters, out)) return true;
  if (in.fault.condition != Condition::no_feed || in.state.vacant_feed == 0) return false;
  out.put("F#").put_integer(in.state.vacant_feed).put(" was vacant in line ").put_integer(in.state.vacant_feed_line);
  out.put(in.state.vacant_feed_file == in.source.file ? "." : " of another program.");
  return true;
}

}  // namespace

void note_cause(Interpreter& in) {
  AlarmStory& story = in.alarm_story;
  TextWriter out(story.cause.s, sizeof story.cause.s);
  if (put_option(in, out, &story.instead)) return;
  if (put_foreign(in, out)) {
    story.instead = true;
    return;
  }
  put_vacant(in, out);
}

}  // namespace nc
