// SPDX-License-Identifier: Apache-2.0
// Codes that act on the macro interface by number, bar the operator's overrides one by one, or say which tool is in the spindle: M50 to M53 and M61 to M68 as
// LinuxCNC has them. They act in front of the motion of their block.
#include <cmath>
#include <cstdint>

#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

constexpr double kPeriod_s = 0.01;       ///< from one question for an input to the next
constexpr unsigned kBits = 32;

/// A number that has to stand in the block, below `count`.
Execution number_below(BlockInHand& in, Role word, unsigned count, uint32_t* number) {
  if (!in.words.has(word)) return in.raise(Condition::words_missing, word);
  const double raw = in.words.get(word);
  const bool good = whole_number(raw, number) && *number < count && raw == std::floor(raw);
  return good ? Execution::done : in.raise(Condition::value_range, word, raw);
}

/// M62 to M65: P is the number of an output, a bit of the first word. It changes where the axes begin the motion that follows.
Execution put_output(BlockContext& in, bool on) {
  uint32_t number = 0;
  const Execution did = number_below(in, Role::output_number, kBits, &number);
  if (did == Execution::done) give_out_bits(in, 0, 1u << number, on ? 1u << number : 0, on ? 1 : 0);
  return did;
}

/// M67, M68: E is the number of an analog output, a word of its own behind that of the outputs; Q its value, which goes out as a whole number.
Execution put_value(BlockContext& in) {
  uint32_t number = 0;
  const Execution did = number_below(in, Role::word_number, NC_WORDS - 1, &number);
  if (did != Execution::done) return did;
  if (!in.words.has(Role::word_value)) return in.raise(Condition::words_missing, Role::word_value);
  const double value = in.words.get(Role::word_value);
  if (value != std::floor(value) || !(value >= INT32_MIN && value <= INT32_MAX)) return in.raise(Condition::value_range, Role::word_value, value);
  give_out_bits(in, number + 1, ~0u, static_cast<uint32_t>(static_cast<int32_t>(value)), value);
  return did;
}

/// M50 to M53: P1, or no P, allows what P0 bars.
Execution switch_override(BlockContext& in, const Auxiliary& code) {
  constexpr unsigned kFeed = 0, kSpindle = 1, kAdaptive = 2;
  uint32_t on = 1;
  if (in.words.has(Role::override_switch)) {
    const Execution did = number_below(in, Role::override_switch, 2, &on);
    if (did != Execution::done) return did;
  }
  if (code.which == kAdaptive) return on == 0 ? Execution::done : in.raise(Condition::no_function, Role::misc_code, code.number);
  if (code.which == kSpindle) return on == 1 ? Execution::done : in.raise(Condition::no_function, Role::misc_code, code.number);
  const int bit = code.which == kFeed ? NC_DISABLE_OVERRIDE : NC_DISABLE_FEED_HOLD;
  in.state.disabled = static_cast<uint8_t>(on != 0 ? in.state.disabled & ~bit : in.state.disabled | bit);
  Action& action = in.emit(ItemKind::action).action;
  action.kind = NC_ACTION_CONTROL;
  action.index = NC_CONTROL_DISABLE;
  action.value = in.state.disabled;
  return Execution::done;
}

/// M61 Q: the tool that is in the spindle, without a change of tools.
Execution name_tool(BlockInHand& in) {
  if (!in.words.has(Role::named_tool)) return in.raise(Condition::words_missing, Role::named_tool);
  const double raw = in.words.get(Role::named_tool);
  uint32_t tool = 0;
  if (!whole_number(raw, &tool) || raw != std::floor(raw) || tool > in.dialect->rules.range.largest_tool) return in.raise(Condition::value_range, Role::named_tool, raw);
  in.state.modal.tool = in.state.spindle_tool = tool;
  return Execution::done;
}

// ---- waiting

enum class Wait : uint8_t { none, rise, fall, high, low };

/// The function of the block that waits, nullptr = there is none.
const Auxiliary* waiting(const BlockInHand& in) {
  for (const Auxiliary& m : in.words.auxiliary)
    if (m.function == MiscFunction::machine_input) return &m;
  return nullptr;
}

void answer(InForce& in, double value) { in.change(&ProgramRecords::answer, InputAnswer{value}); }

/// True: the input has done what the block waits for.
bool has_come(InputWait* wait, bool on) {
  const auto kind = static_cast<Wait>(wait->kind);
  if (kind == Wait::high || kind == Wait::low) return on == (kind == Wait::high);
  const bool edge = wait->seen && wait->last != on && on == (kind == Wait::rise);
  wait->seen = true;
  wait->last = on;
  return edge;
}

}  // namespace

void give_out_bits(BlockContext& in, uint32_t word, uint32_t mask, uint32_t bits, double value) {
  in.change(&ProgramRecords::output, word, InterfaceOutput{(in.records->output[word].bits & ~mask) | (bits & mask)});
  Action& action = in.emit(ItemKind::action).action;
  action.kind = NC_ACTION_OUTPUT;
  action.index = word;
  action.mask = mask;
  action.bits = bits & mask;
  action.value = value;
}

Execution act_on_machine(BlockContext& in, const Auxiliary& code) {
  switch (code.function) {
    case MiscFunction::machine_output: return put_output(in, code.which != 0);
    case MiscFunction::machine_value: return put_value(in);
    case MiscFunction::override_of_one: return switch_override(in, code);
    case MiscFunction::tool_number: return name_tool(in);
    default: return Execution::done;
  }
}

bool takes_word_number(const BlockInHand& in) {
  for (const Auxiliary& m : in.words.auxiliary)
    if (m.function == MiscFunction::machine_value || m.function == MiscFunction::machine_input) return true;
  return false;
}

bool waits_for_input(const BlockInHand& in) { return waiting(in) != nullptr; }

Execution wait_for_input(BlockInHand& in) {
  const Command& w = in.words;
  if (w.auxiliary.size() > 1 || !w.functions.empty() || w.any(in.axis_words.all())) return in.raise(Condition::must_stand_alone, Role::misc_code, waiting(in)->number);
  const WordSet own = in.set_of({Role::sequence_number, Role::program_number, Role::misc_code, Role::output_number, Role::word_number, Role::input_wait, Role::input_limit});
  if (const WordSet others = w.present & ~own; others != 0) return in.raise_first(Condition::illegal_address, others);  // they would be lost
  InputWait wait;
  const bool analog = w.has(Role::word_number);
  if (analog == w.has(Role::output_number)) return in.raise(analog ? Condition::two_words : Condition::words_missing, Role::output_number, w.get(Role::output_number));
  Execution did = analog ? number_below(in, Role::word_number, NC_WORDS - 1, &wait.number) : number_below(in, Role::output_number, kBits, &wait.number);
  uint32_t kind = 0;
  if (did == Execution::done && w.has(Role::input_wait)) did = number_below(in, Role::input_wait, analog ? 1 : 5, &kind);  // an analog input is only read
  if (did != Execution::done) return did;
  const double limit = w.has(Role::input_limit) ? w.get(Role::input_limit) : 0;
  if (!(limit >= 0) || limit > in.dialect->rules.range.longest_input_wait_s || (kind != 0 && limit == 0)) return in.raise(Condition::value_range, Role::input_limit, limit);
  wait.analog = analog;
  wait.kind = static_cast<uint8_t>(kind);
  wait.left = static_cast<uint32_t>(std::ceil(limit / kPeriod_s));
  in.jobs.input_wait = wait;
  in.next_step = Step::input;
  return Execution::later;
}

Execution continue_input_wait(BlockContext& in) {
  if (!in.world_fresh) return in.need(NC_SYNC_INPUT);
  InputWait& wait = in.jobs.input_wait;
  if (wait.analog) {
    answer(in, static_cast<double>(static_cast<int32_t>(in.world.input[wait.number + 1])));
    return Execution::done;
  }
  const bool on = (in.world.input[0] >> wait.number & 1) != 0;
  const bool come = static_cast<Wait>(wait.kind) == Wait::none || has_come(&wait, on);
  if (come || wait.left == 0) {
    answer(in, come ? (on ? 1 : 0) : -1);
    return Execution::done;
  }
  --wait.left;
  Gate& gate = in.emit(ItemKind::gate).gate;
  gate.kind = NC_GATE_DWELL_SECONDS;
  gate.value = kPeriod_s;
  return in.need(NC_SYNC_INPUT);
}

}  // namespace nc
