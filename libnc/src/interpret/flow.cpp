// SPDX-License-Identifier: Apache-2.0
// Where the program goes on: GOTO, WHILE, sub programs, macro calls, the ends of texts (M700 13.3, 13.5.1, 13.5.7).
#include <algorithm>
#include <cmath>

#include "interpret/calls.hpp"
#include "interpret/interpreter.hpp"
#include "interpret/plane.hpp"
#include "interpret/program_map.hpp"

namespace nc {
namespace {

constexpr char kDataServer[] = "198:";      // the place of its programs in the store (nc_program_missing)

/// Searches for a sequence number. M700 13.5.7, 13.12: from the next block to the end of the program, then from its beginning.
bool find_from_here(Interpreter& in, const CallFrame& frame, uint32_t n, uint64_t* offset, uint32_t* line) {
  bool again = false;
  *offset = frame.offset;
  *line = frame.line;
  if (in.reader.find_sequence(frame.program.file, n, offset, line, 0, kWholeText, &again, false)) return true;
  if (in.reader.failure() != Condition::none) return false;
  *offset = frame.program.offset;
  *line = frame.program.line;
  return in.reader.find_sequence(frame.program.file, n, offset, line, frame.offset, kWholeText, &again);
}

/// Forgets the loops that a jump to `offset` leaves. The end of a loop is known once its END has been executed or searched for.
void leave_loops(Interpreter& in, uint64_t offset) {
  State& s = in.state;
  while (s.loop_count > top(in).loop_base) {
    Loop& loop = s.loop[s.loop_count - 1];
    if (loop.end == 0) {
      uint64_t end = loop.body;
      uint32_t line = loop.line;
      if (!in.reader.find_loop_end(top(in).program.file, loop.number, &end, &line)) break;
      loop.end = end;
    }
    if (offset >= loop.offset && offset < loop.end) break;
    --s.loop_count;
  }
}

/// M700 13.5.7 (12): finds a WHILE or DO of this program that has no END.
bool loop_without_end(Interpreter& in, uint32_t* number) {
  const State& s = in.state;
  for (unsigned i = top(in).loop_base; i < s.loop_count; ++i) {
    uint64_t end = s.loop[i].body;
    uint32_t line = s.loop[i].line;
    *number = s.loop[i].number;
    if (s.loop[i].end == 0 && !in.reader.find_loop_end(top(in).program.file, s.loop[i].number, &end, &line)) return true;
  }
  return false;
}

Execution jump_to_sequence(Interpreter& in, double number) {
  uint32_t n = 0;
  uint64_t offset = 0;
  uint32_t line = 0;
  if (!whole_number(number, &n) || !find_from_here(in, top(in), n, &offset, &line)) return in.raise(Condition::sequence_missing, Role::sequence_number, number);
  leave_loops(in, offset);
  if (in.reader.failure() != Condition::none) return in.raise(Condition::read_failed);
  top(in).offset = offset;
  top(in).line = line;
  in.jumped = true;
  return Execution::done;
}

Execution begin_loop(Interpreter& in, const Statement& statement, bool condition) {
  State& s = in.state;
  CallFrame& frame = top(in);
  if (statement.number < 1 || statement.number > in.dialect->lex->most_loop_number) return in.raise(Condition::while_statement, Role::loop_number, statement.number);
  const uint64_t here = in.block->begin;
  const bool again = s.loop_count > frame.loop_base && s.loop[s.loop_count - 1].offset == here;
  if (!condition) {
    uint64_t end = again && s.loop[s.loop_count - 1].end != 0 ? s.loop[s.loop_count - 1].end : 0;
    uint32_t line = again ? s.loop[s.loop_count - 1].end_line : 0;
    if (end == 0) {
      end = in.block->next;
      line = in.block->next_line;
      if (!in.reader.find_loop_end(frame.program.file, statement.number, &end, &line)) return in.raise(Condition::loop_pair, Role::loop_number, statement.number);
    }
    if (again) --s.loop_count;
    frame.offset = end;
    frame.line = line;
    in.jumped = true;
    return Execution::done;
  }
  if (again) return Execution::done;
  for (unsigned i = frame.loop_base; i < s.loop_count; ++i)  // the number m of an open loop may not be used again inside of it
    if (s.loop[i].number == statement.number) return in.raise(Condition::loop_pair, Role::loop_number, statement.number);
  if (unsigned{s.loop_count} - frame.loop_base >= in.dialect->rules.program.loops_in_one_another || s.loop_count >= kMaxLoops) return in.raise(Condition::loop_nesting, Role::loop_number, statement.number);
  s.loop[s.loop_count++] = Loop{here, in.block->next, 0, in.block->line, 0, statement.number};
  return Execution::done;
}

Execution end_loop(Interpreter& in, const Statement& statement) {
  State& s = in.state;
  CallFrame& frame = top(in);
  if (s.loop_count == frame.loop_base || s.loop[s.loop_count - 1].number != statement.number)
    return in.raise(Condition::loop_pair, Role::loop_end, statement.number);
  Loop& loop = s.loop[s.loop_count - 1];
  loop.end = in.block->next;
  loop.end_line = in.block->next_line;
  frame.offset = loop.offset;
  frame.line = loop.line;
  in.jumped = true;
  return Execution::done;
}

/// Finds which variable an assignment writes, and its new value.
Execution assigned(Interpreter& in, const Statement& statement, uint32_t* variable, Value* value) {
  uint32_t n = 0;
  Execution did = Execution::done;
  if (!constant_number(*in.block, statement.target, &n)) {
    Value number;
    did = evaluate_here(in, statement.target, &number);
    if (did != Execution::done) return did;
    if (!variable_number(number, eval_options(in), &n)) return in.raise(Condition::variable_number, Sign::variable, number.or_zero());
  }
  did = evaluate_here(in, statement.value, value);
  if (did != Execution::done) return did;
  *variable = n;
  return n == 0 ? in.raise(Condition::variable_use, Sign::variable, 0) : Execution::done;  // M700 13.5.4: #0 cannot be written
}

Execution store(Interpreter& in, const Statement& statement, uint32_t n, Value value) {
  if (in.variables.set(n, in.macro_level(), value, in.state.seq + 1)) return Execution::done;
  return write_system_variable(in, n, value, statement);
}

/// Makes all assignments of the block at once: their values are calculated before the first variable is written.
Execution assign_at_once(Interpreter& in) {
  const auto& statements = in.block->statements;
  FixedVector<uint32_t, decltype(Block::statements)::capacity()> variables;
  FixedVector<Value, decltype(Block::statements)::capacity()> values;
  for (const Statement& statement : statements) {
    uint32_t n = 0;
    Value value;
    const Execution did = assigned(in, statement, &n, &value);
    if (did != Execution::done) return did;
    variables.push_back(n);
    values.push_back(value);
  }
  for (unsigned i = 0; i < statements.size(); ++i) {
    const Execution did = store(in, statements[i], variables[i], values[i]);
    if (did != Execution::done) return did;
  }
  in.statement = statements.size() - 1;  // all statements of the block have been executed
  return Execution::done;
}

Execution assign(Interpreter& in, const Statement& statement) {
  if (in.dialect->rules.block.assigns_at_once && in.block->statements.size() > 1) return assign_at_once(in);
  uint32_t n = 0;
  Value value;
  const Execution did = assigned(in, statement, &n, &value);
  return did == Execution::done ? store(in, statement, n, value) : did;
}

}  // namespace

// ---- entering programs ------------------------------------------------------------------------------------------------------

Execution evaluate_here(Interpreter& in, uint16_t code, Value* value) {
  const Eval eval = evaluate(*in.block, code, variable_reader(in), eval_options(in), value, &in.fault, &in.sync_needed);
  if (eval == Eval::fault) return Execution::fault;
  return eval == Eval::need_sync ? Execution::sync : Execution::done;
}

/// M700 App.1 P35: the P of a program has no sign and no more than its digits; the same holds for H and for the P of M99.
Execution called_number(Interpreter& in, Role word, double value, uint32_t* number) {
  const double within = in.dialect->rules.block.whole_words_within;
  if (within >= 0 && !make_whole(within, &value)) return in.raise(Condition::format_error, word, value);
  return whole_number(value, number) && *number <= in.dialect->rules.range.largest_program ? Execution::done : in.raise(Condition::value_range, word, value);
}

Execution find_called(Interpreter& in, bool has_p, double p, bool own_allowed, ProgramRef* program) {
  if (in.block->name_length > 0) {
    if (in.block->name_length > 32) return in.raise(Condition::program_missing, Sign::file_name);  // M700 13.3.1: at most 32 characters
    *program = in.reader.find_program(in.block->text.begin() + in.block->name, in.block->name_length);
    return program->valid() ? Execution::done : in.raise(Condition::program_missing, Sign::file_name);
  }
  if (!has_p) {
    if (!own_allowed || !in.dialect->rules.program.own_without_number) return in.raise(Condition::address_missing, Role::call_program);
    *program = top(in).program;
    return Execution::done;
  }
  uint32_t number = 0;
  const Execution did = called_number(in, Role::call_program, p, &number);
  return did == Execution::done ? find_number(in, number, program) : did;
}

Execution find_number(Interpreter& in, uint32_t number, ProgramRef* program) {
  if (number == 0) return in.raise(Condition::program_missing, Role::call_program, number);
  // Blocks of MDI find the sub programs in the file of the program that they interrupt.
  const CallFrame& caller = top(in).origin == CallOrigin::mdi ? in.state.frame[in.state.depth - 1] : top(in);
  *program = in.reader.find_program(number, caller.program.file);
  if (!program->valid()) return in.raise(Condition::program_missing, Role::call_program, number);
  program->number = number;
  return Execution::done;
}

Execution repetitions(Interpreter& in, bool has_l, double l, uint32_t* count) {
  *count = 1;
  if (has_l && (!whole_number(l, count) || *count > in.dialect->rules.range.most_call_repeats)) return in.raise(Condition::value_range, Role::call_repeats, l);
  return Execution::done;
}

bool only_calls(const Interpreter& in) {
  if (!has_only(*in.block, in.set_of({Role::misc_code, Role::call_program, Role::call_repeats, Role::call_sequence}))) return false;
  return in.words.auxiliary.size() == 1;
}

/// One more sub program would be too many in one another.
static bool too_many_subs(const Interpreter& in) {
  unsigned subs = 1;
  for (unsigned level = 1; level <= in.state.depth; ++level)
    subs += in.state.frame[level].kind == CallKind::sub && in.state.frame[level].origin != CallOrigin::mdi ? 1u : 0u;
  return subs > in.dialect->rules.program.sub_programs_in_one_another;
}

Execution enter(Interpreter& in, const Entry& entry) {
  State& s = in.state;
  const bool mdi = entry.origin == CallOrigin::mdi;  // takes a level (M700 13.3.1), also in a family without calls, but is no sub program
  if (!mdi && entry.kind == CallKind::sub && too_many_subs(in)) return in.raise(Condition::nesting, Role::call_program, entry.program.number);
  if (s.depth + 1u > (mdi ? std::max(in.dialect->call_depth, 1u) : in.dialect->call_depth) || s.depth + 1u >= kMaxFrames) return in.raise(Condition::nesting, Role::call_program, entry.program.number);
  const CallFrame& caller = top(in);
  const uint8_t level = caller.macro_level;
  const uint8_t modal = entry.slot == 0 ? caller.modal_call : modal_call(in, entry.slot).below;
  top(in).call_line = in.source.line;
  ++s.depth;
  CallFrame& frame = top(in);
  frame = CallFrame{};
  frame.program = entry.program;
  frame.offset = frame.begin = entry.offset;
  frame.line = frame.begin_line = entry.line;
  frame.repeats = entry.passes - 1;
  frame.kind = entry.kind;
  frame.origin = entry.origin;
  frame.modal_call = modal;
  frame.modal_slot = entry.slot;
  frame.macro_level = static_cast<uint8_t>(entry.kind == CallKind::macro ? level + 1 : level);
  frame.loop_base = s.loop_count;
  frame.started = entry.offset != entry.program.offset;
  frame.last_sequence = entry.last_sequence;
  if (modal != caller.modal_call) {
    show_modal_call(in);
  } else {
    in.program_changed();
  }
  return Execution::later;  // the mark of the calling block comes after the return
}

namespace {

/// I J K of M98: the centre of the figure, relative to the position of the axes at the call (M700 13.3.3).
void figure_center(const Interpreter& in, double center[2]) {
  const PlanePair plane = pair_of(in.state.modal.of(Mode::plane));
  const Role h = vector_along(plane.first), v = vector_along(plane.second);
  if (in.words.has(h)) center[0] = length_of(in, h);
  if (in.words.has(v)) center[1] = length_of(in, v);
}

}  // namespace

/// A modal call that was commanded or cancelled stays so in the program that goes on.
void leave_program(Interpreter& in) {
  State& s = in.state;
  const CallFrame& frame = top(in);
  s.codes_left &= ~(1u << s.depth);
  if (frame.modal_slot == 0 && frame.origin != CallOrigin::interrupt && frame.origin != CallOrigin::mdi) s.frame[s.depth - 1].modal_call = frame.modal_call;
  --s.depth;
  show_modal_call(in);
}

Execution execute_statement(Interpreter& in, const Statement& statement) {
  const bool jumps = statement.kind == StatementKind::if_goto || statement.kind == StatementKind::go_to || statement.kind == StatementKind::while_do;
  if (jumps && in.reader.is_tape(top(in).program.file)) return in.raise(Condition::jump_on_tape);  // M700 App.1
  switch (statement.kind) {
    case StatementKind::assign: return assign(in, statement);
    case StatementKind::if_goto:
    case StatementKind::while_do: {
      Value condition;
      const Execution did = evaluate_here(in, statement.value, &condition);
      if (did != Execution::done) return did;
      const bool holds = condition.or_zero() != 0;
      if (statement.kind == StatementKind::while_do) return begin_loop(in, statement, holds);
      if (!holds) return Execution::done;
      [[fallthrough]];
    }
    case StatementKind::go_to: {
      Value target;
      const Execution did = evaluate_here(in, statement.target, &target);
      return did == Execution::done ? jump_to_sequence(in, target.or_zero()) : did;
    }
    case StatementKind::do_loop: return begin_loop(in, statement, true);
    case StatementKind::end_loop: return end_loop(in, statement);
    case StatementKind::if_then: {  // an option of later models: the rest of the block is executed only when the condition holds
      if (!in.settings.macro_extensions) return in.raise(Condition::if_statement);
      Value condition;
      const Execution did = evaluate_here(in, statement.value, &condition);
      if (did == Execution::done && condition.or_zero() == 0) in.jumped = true;  // the rest of the block is not executed
      return did;
    }
    case StatementKind::set_name: return set_names(in, statement);
    case StatementKind::open_port: return open_port(in);
    case StatementKind::close_port: return close_port(in);
    case StatementKind::print_decimal: return print_decimal(in, statement);
    case StatementKind::print_binary: return print_binary(in, statement);
  }
  return in.raise(Condition::internal);
}

Execution find_start(Interpreter& in, const ProgramRef& program, uint64_t* offset, uint32_t* line) {
  const Command& w = in.words;
  *offset = program.offset;
  *line = program.line;
  if (!w.has(Role::call_sequence)) return Execution::done;
  uint32_t n = 0;
  bool again = false;
  const Execution did = called_number(in, Role::call_sequence, w.get(Role::call_sequence), &n);
  if (did != Execution::done) return did;
  if (in.reader.find_sequence(program.file, n, offset, line, 0, kWholeText, &again)) return Execution::done;
  return in.raise(Condition::sequence_missing, Role::call_sequence, w.get(Role::call_sequence));
}

namespace {

/// M700 13.3.1: finds a sub program on one of the devices 1 to 4.
Execution find_on_device(Interpreter& in, ProgramRef* program) {
  const Command& w = in.words;
  const DevicePlace place = place_of_device(*in.dialect, w.device);
  const unsigned length = in.block->name_length;
  uint32_t number = 0;
  if (length == 0 && !w.has(Role::call_program)) return in.raise(Condition::address_missing, Role::call_program);
  const Execution did = length == 0 ? called_number(in, Role::call_program, w.get(Role::call_program), &number) : Execution::done;
  if (did != Execution::done) return did;
  if (length <= 32) *program = in.reader.find_external(place.text, in.block->text.begin() + in.block->name, length, number);
  if (!program->valid()) return length != 0 ? in.raise(Condition::program_missing, Sign::file_name) : in.raise(Condition::program_missing, Role::call_program, number);
  if (number != 0) program->number = number;
  return Execution::done;
}

}  // namespace

/// HX 2.4.3: R names the block of the sub program that is its last one.
static Execution find_end(Interpreter& in, const ProgramRef& program, uint64_t offset, uint32_t line, uint32_t* number) {
  const Command& w = in.words;
  *number = 0;
  if (!w.has(Role::call_end_sequence)) return Execution::done;
  const Execution did = called_number(in, Role::call_end_sequence, w.get(Role::call_end_sequence), number);
  bool again = false;
  if (did != Execution::done || in.reader.find_sequence(program.file, *number, &offset, &line, 0, kWholeText, &again)) return did;
  return in.raise(Condition::sequence_missing, Role::call_end_sequence, w.get(Role::call_end_sequence));
}

Execution call_sub(Interpreter& in) {
  const Command& w = in.words;
  if (in_mdi(in) && in.dialect->rules.program.no_call_in_mdi) return in.raise_misc(Condition::call_in_mdi, MiscFunction::call_sub);
  if (top(in).figure != 0) return in.raise_misc(Condition::nesting, MiscFunction::call_sub);  // M700 13.3.3 (6): no branch from a rotating program
  uint32_t passes = 1;
  Execution did = repetitions(in, w.has(Role::call_repeats), w.has(Role::call_repeats) ? w.get(Role::call_repeats) : 1, &passes);
  if (did != Execution::done || passes == 0) return did;  // M700 13.3.1: with L0 no call is made, so no program is searched for
  ProgramRef program;
  did = w.device != 0 ? find_on_device(in, &program) : find_called(in, w.has(Role::call_program), w.has(Role::call_program) ? w.get(Role::call_program) : 0, true, &program);
  if (did != Execution::done) return did;
  uint64_t offset = 0;
  uint32_t line = 0;
  did = find_start(in, program, &offset, &line);
  if (did != Execution::done) return did;
  // M700 13.3.1: single block does not stop at a block that only calls; where the block has other words it stops after these have been executed.
  const bool stops = !only_calls(in);
  const bool figure = w.any({Role::vector_x, Role::vector_y, Role::vector_z});
  if (figure && in.state.rotated) return in.raise_misc(Condition::rotation_in_figure, MiscFunction::call_sub);  // M700 13.3.3 precaution (2)
  double center[2] = {0, 0};
  if (figure) figure_center(in, center);
  uint32_t last = 0;
  did = find_end(in, program, offset, line, &last);
  if (did != Execution::done) return did;
  did = enter(in, Entry{program, CallKind::sub, CallOrigin::word, passes, offset, line, 0, last});
  if (did != Execution::later) return did;
  if (figure) begin_figure(in, center);
  in.keep_call();
  if (stops) in.emit_stop_point(true);  // the call has been made, so after the stop the sub program is read
  return did;
}

/// M700 13.3.2: calls a program of the data server. It is one that the host has under such a name (BlockReader::find_external), or else one in the memory.
Execution call_external(Interpreter& in) {
  const Command& w = in.words;
  if (w.has(Role::call_sequence)) return in.raise(Condition::format_error, Role::call_sequence, w.get(Role::call_sequence));  // no call of a sequence number
  for (unsigned level = 1; level <= in.state.depth; ++level)
    if (in.state.frame[level].origin == CallOrigin::external) return in.raise_misc(Condition::nesting, MiscFunction::call_external);  // only one M198 may be open
  if (top(in).figure != 0) return in.raise_misc(Condition::nesting, MiscFunction::call_external);
  Entry entry;
  entry.origin = CallOrigin::external;
  Execution did = repetitions(in, w.has(Role::call_repeats), w.has(Role::call_repeats) ? w.get(Role::call_repeats) : 1, &entry.passes);
  if (did != Execution::done || entry.passes == 0) return did;
  uint32_t number = 0;
  if (in.block->name_length == 0) {
    did = w.has(Role::call_program) ? called_number(in, Role::call_program, w.get(Role::call_program), &number) : in.raise(Condition::address_missing, Role::call_program);
    if (did != Execution::done) return did;
  }
  const char* name = in.block->text.begin() + in.block->name;
  if (in.block->name_length <= 32) entry.program = in.reader.find_external(kDataServer, name, in.block->name_length, number);
  const bool outside = entry.program.valid();
  if (!outside) did = find_called(in, w.has(Role::call_program), number, false, &entry.program);
  if (did != Execution::done) return did;
  if (number != 0) entry.program.number = number;
  if (outside) {
    // The text up to the first line feed is not executed, unless the file begins with an O number.
    const Block* first = in.reader.peek(entry.program.file);
    if (first == nullptr) return in.raise(Condition::read_failed);
    while (!first->end_of_text && !first->has_o && first->line == 1) {
      entry.program.offset = first->next;
      entry.program.line = first->next_line;
      if (first->next_line > 1) break;
      first = in.reader.peek(entry.program.file, first->next, first->next_line);
      if (first == nullptr) return in.raise(Condition::read_failed);
    }
  }
  entry.offset = entry.program.offset;
  entry.line = entry.program.line;
  const bool stops = !only_calls(in);
  did = enter(in, entry);
  if (did != Execution::later) return did;
  in.keep_call();
  if (stops) in.emit_stop_point(true);
  return did;
}

Execution check_loops_closed(Interpreter& in) {
  uint32_t number = 0;
  return loop_without_end(in, &number) ? in.raise(Condition::loop_pair, Role::loop_number, number) : Execution::done;
}

/// HX 2.4.4: the main program goes back as often as L says. `repeats` of its frame is one more than what is left of that, 0 = nothing is counted.
static Execution count_return(Interpreter& in, bool* goes_back) {
  CallFrame& frame = top(in);
  uint32_t times = 0;
  const Execution did = repetitions(in, true, in.words.get(Role::return_passes), &times);
  if (did != Execution::done) return did;
  if (frame.repeats == 0) frame.repeats = times + 1;
  *goes_back = --frame.repeats != 0;
  return Execution::done;
}

/// The block in hand is the first of its text that is not blank.
static bool heads_text(Interpreter& in) {
  const ProgramRef& text = top(in).program;
  const uint64_t begin = in.block->begin;
  const uint32_t line = in.block->line;
  uint64_t at = text.offset;
  for (uint32_t at_line = text.line; at < begin;) {
    const Block* before = in.reader.read(text.file, at, at_line);
    if (before == nullptr || !before->empty || before->has_n || before->has_o || before->next <= at) break;
    at = before->next;
    at_line = before->next_line;
  }
  in.block = in.reader.read(text.file, begin, line);
  return at == begin;
}

Execution return_sub(Interpreter& in) {
  State& s = in.state;
  const Command& w = in.words;
  if (check_loops_closed(in) != Execution::done) return Execution::fault;
  if (is_text_of_its_own(in)) {  // M700 13.3.1 (3): M99 in the main program, and in MDI, goes to the beginning of the program
    CallFrame& frame = top(in);
    if (w.has(Role::return_passes) && in.dialect->rules.program.main_program_counts) {
      bool goes_back = false;
      const Execution did = count_return(in, &goes_back);
      if (did != Execution::done || !goes_back) return did;
    }
    if (w.has(Role::return_sequence) && !in.reader.is_tape(frame.program.file)) return jump_to_sequence(in, w.get(Role::return_sequence));
    // Blocks of MDI in a block stop that begin with it have nothing to go back for: they end, and the program goes on with the next start.
    if (frame.origin == CallOrigin::mdi && only_calls(in) && heads_text(in)) return Execution::done;
    s.loop_count = frame.loop_base;
    frame.offset = frame.program.offset;
    frame.line = frame.program.line;
    frame.started = false;
    in.begins_again = true;
    return Execution::done;
  }
  // HX 2.4.4 prints L beside M99 of a main program. Setting the number of passes anew in each one, as below, a sub program would not end.
  if (w.has(Role::return_passes) && in.dialect->rules.program.main_program_counts) return in.raise(Condition::illegal_address, Role::return_passes, w.get(Role::return_passes));
  CallFrame& frame = top(in);
  const bool interrupted = frame.origin == CallOrigin::interrupt;
  s.loop_count = frame.loop_base;
  if (w.has(Role::return_passes)) {  // 13.3.1 has only "M99 (P_ L_)"; as in FANUC, L is the number of passes still to come, counting this one
    uint32_t passes = 0;
    const Execution did = repetitions(in, true, w.get(Role::return_passes), &passes);
    if (did != Execution::done) return did;
    frame.repeats = passes == 0 ? 0 : passes - 1;
  }
  if (frame.repeats > 0) {
    --frame.repeats;
    if (frame.figure != 0) turn_figure(in);
    frame.offset = frame.begin;
    frame.line = frame.begin_line;
    frame.started = frame.begin != frame.program.offset;
    in.finish_block(!only_calls(in), !only_calls(in));
    return Execution::later;
  }
  if (w.has(Role::return_sequence) && !in.reader.is_tape(s.frame[s.depth - 1].program.file)) {  // M700 13.3.1: a tape has no P of M99
    uint32_t n = 0;
    uint64_t offset = 0;
    uint32_t line = 0;
    CallFrame& caller = s.frame[s.depth - 1];
    if (s.interrupt_depth == s.depth) in.leave_interrupt(true);
    const Execution did = called_number(in, Role::return_sequence, w.get(Role::return_sequence), &n);
    if (did != Execution::done) return did;
    if (!find_from_here(in, caller, n, &offset, &line)) return in.raise(Condition::sequence_missing, Role::return_sequence, n);
    leave_program(in);
    s.codes_left &= ~(1u << s.depth);
    caller.places_made = 0;
    leave_loops(in, offset);
    if (in.reader.failure() != Condition::none) return in.raise(Condition::read_failed);
    caller.offset = offset;
    caller.line = line;
  } else {
    if (s.interrupt_depth == s.depth) in.leave_interrupt(false);
    leave_program(in);
  }
  const bool stops = !only_calls(in);
  s.owes_mark = !interrupted && (s.codes_left >> s.depth & 1) == 0;
  in.finish_block(stops, stops);
  if (interrupted) in.know_world_again();
  return Execution::later;
}

/// HX 2.4.3: the last block of a pass has been run, as if M99 stood behind it. It has had its mark.
Execution return_behind_last(Interpreter& in) {
  State& s = in.state;
  if (check_loops_closed(in) != Execution::done) return Execution::fault;
  CallFrame& frame = top(in);
  frame.last_begun = false;
  s.loop_count = frame.loop_base;
  if (frame.repeats > 0) {
    --frame.repeats;
    frame.offset = frame.begin;
    frame.line = frame.begin_line;
    frame.started = frame.begin != frame.program.offset;
  } else {
    leave_program(in);
    s.owes_mark = (s.codes_left >> s.depth & 1) == 0;
  }
  in.keep_call();
  return Execution::later;
}

Execution text_ended(Interpreter& in) {
  if (top(in).origin == CallOrigin::mdi) return in.leave_mdi();
  // M700 App.1 P36: '%', the end of the text, or the next O number was read before M02, M30 or M99.
  if (in.state.depth > 0) return in.raise_misc(Condition::sub_without_return, MiscFunction::return_sub);
  // A text of MDI may end without a code for it, but not within a loop.
  if (in.mdi && check_loops_closed(in) != Execution::done) return Execution::fault;
  if (in.dialect->end_code_required && !(in.mdi && in.block->end_of_text)) return in.raise(Condition::program_end);
  in.state.end_seen = true;
  Item& end = in.emit(ItemKind::end);
  end.end.ok = true;
  end.end.work = in.position();
  end.end.modal = in.modals.intern(in.state.modal);
  if (in.mdi) end.end.along_tool = in.along_tool();
  in.ended = true;
  return Execution::later;
}

}  // namespace nc
