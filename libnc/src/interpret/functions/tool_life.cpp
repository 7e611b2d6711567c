// SPDX-License-Identifier: Apache-2.0
// Tool life management: its data by program (G10 L3, data blocks, G11), the tool that T selects of a group, and the counting of mounts and uses. The
// minutes are counted by the machine (control/life_count.cpp). The manual has the variables (M700 13.5.5, 10.15) and alarms P178, P179; the rest is the
// practice of the field (docs/decisions.md).
#include <cmath>

#include "frame/tool_life.hpp"
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

constexpr uint32_t kLastNumber = 99999999;
constexpr double kMostMinutes = 4000, kMostTimes = 9999;  // 10.15

void set(BlockContext& in, unsigned slot, LifeColumn column, double value) { in.set_table(ToolLife(in.frames).key(slot, column), value); }
void set(BlockContext& in, ToolInUse which, double value) { in.set_table(in.frames.tool_in_use_key(static_cast<unsigned>(which)), value); }

void clear_slot(BlockContext& in, unsigned slot) {
  for (unsigned column = 0; column < kLifeColumns; ++column) set(in, slot, static_cast<LifeColumn>(column), 0);
  const ToolLife lives(in.frames);
  if (lives.in_spindle() == slot) set(in, ToolInUse::spindle, 0);
  if (lives.selected() == slot) set(in, ToolInUse::selected, 0);
}

Execution number_of(BlockContext& in, Role word, uint32_t least, uint32_t most, uint32_t* number) {
  if (!in.words.has(word)) return in.raise(Condition::format_error, word);
  if (whole_number(in.words.get(word), number) && *number >= least && *number <= most) return Execution::done;
  return in.raise(Condition::value_range, word, in.words.get(word));
}

/// P L Q: a group, and what its tools have in common. Q1 counts mounts, which is what holds without Q; Q2 minutes, Q3 uses.
Execution take_group(BlockContext& in) {
  LifeInput& input = in.state.life_input;
  const Command& w = in.words;
  uint32_t group = 0, method = 1;
  Execution did = number_of(in, Role::life_group, 1, kLastNumber, &group);
  if (did != Execution::done) return did;
  const ToolLife lives(in.frames);
  const bool known = lives.registered(group) != 0;
  if (input.kind == LifeInput::Kind::remove) {
    if (!known) return in.raise(Condition::life_group, Role::life_group, group);
    for (unsigned slot = 0; slot < kLifeTools; ++slot)
      if (lives.group(slot) == group) clear_slot(in, slot);
    return Execution::done;
  }
  if (input.kind == LifeInput::Kind::anew && (known || group == input.group)) return in.raise(Condition::life_group, Role::life_group, group);
  if (w.has(Role::life_method)) {
    did = number_of(in, Role::life_method, 1, 3, &method);
    if (did != Execution::done) return did;
  }
  const LifeMethod counts = method == 1 ? LifeMethod::mounts : method == 2 ? LifeMethod::time : LifeMethod::uses;
  if (!w.has(Role::life_span)) return in.raise(Condition::format_error, Role::life_span);
  const double life = w.get(Role::life_span), most = counts == LifeMethod::time ? kMostMinutes : kMostTimes;
  if (!(life >= 0 && life <= most && life == std::trunc(life))) return in.raise(Condition::value_range, Role::life_span, life);
  for (unsigned slot = 0; slot < kLifeTools; ++slot)  // a group that is given again loses its tools
    if (lives.group(slot) == group) clear_slot(in, slot);
  input.group = group;
  input.life = life;
  input.flags = static_cast<uint8_t>(static_cast<unsigned>(counts) << 4);
  return Execution::done;
}

/// T H D: the next tool of the group.
Execution take_tool(BlockContext& in) {
  const LifeInput& input = in.state.life_input;
  uint32_t tool = 0, length = 0, radius = 0;
  if (!input.group || input.kind == LifeInput::Kind::remove) return in.raise(Condition::format_error, Role::life_group);
  Execution did = number_of(in, Role::life_tool, 1, kLastNumber, &tool);
  if (did == Execution::done && in.words.has(Role::life_length)) did = number_of(in, Role::life_length, 0, in.frames.tool_offsets(), &length);
  if (did == Execution::done && in.words.has(Role::life_radius)) did = number_of(in, Role::life_radius, 0, in.frames.tool_offsets(), &radius);
  if (did != Execution::done) return did;
  const unsigned slot = ToolLife(in.frames).free_slot();
  if (slot == ToolLife::kNone) return in.raise(Condition::life_full, Role::life_tool, tool);
  set(in, slot, LifeColumn::group, input.group);
  set(in, slot, LifeColumn::tool, tool);
  set(in, slot, LifeColumn::flags, input.flags);
  set(in, slot, LifeColumn::life, input.life);
  set(in, slot, LifeColumn::length, length);
  set(in, slot, LifeColumn::radius, radius);
  return Execution::done;
}

/// One more of what is counted in times.
void count(BlockContext& in, unsigned slot) {
  const ToolLife lives(in.frames);
  const double used = lives.get(slot, LifeColumn::used) + 1, life = lives.get(slot, LifeColumn::life);
  set(in, slot, LifeColumn::used, std::fmin(used, kMostTimes));
  if (life > 0 && used >= life && lives.lives(slot)) set(in, slot, LifeColumn::status, static_cast<double>(LifeStatus::ended));
}

}  // namespace

/// Without P everything that is registered goes; P1 adds groups, or registers them anew; P2 removes them.
Execution begin_tool_life_input(BlockContext& in) {
  const Command& w = in.words;
  uint32_t how = 0;
  if (w.has(Role::input_number)) {
    const Execution did = number_of(in, Role::input_number, 1, 2, &how);
    if (did != Execution::done) return did;
  }
  const bool alone = word_count(*in.block) == (how != 0 ? 3U : 2U);
  if (!alone || in.state.cycle.kind != CycleKind::none || in.state.compensated()) return in.raise(Condition::format_error, Role::input_kind, w.get(Role::input_kind));
  in.state.life_input = {};
  in.state.life_input.kind = how == 0 ? LifeInput::Kind::anew : how == 1 ? LifeInput::Kind::add : LifeInput::Kind::remove;
  for (unsigned slot = 0; how == 0 && slot < kLifeTools; ++slot) clear_slot(in, slot);
  return Execution::done;
}

Execution tool_life_block(BlockContext& in) {
  const Command& w = in.words;
  if (!w.functions.empty() || !w.auxiliary.empty()) {
    const bool ends = w.functions.size() == 1 && ends_data_input(w.functions[0]->function) && word_count(*in.block) == 1;
    if (!ends && w.functions.empty()) return in.raise(Condition::illegal_address, Role::misc_code, w.auxiliary[0].number);
    if (!ends) return in.raise_code(Condition::illegal_address, *w.functions[0]);
    in.state.life_input = {};
    return Execution::done;
  }
  const WordSet set_words = in.set_of({Role::life_group, Role::life_span, Role::life_method}), of_tool = in.set_of({Role::life_tool, Role::life_length, Role::life_radius});
  if (w.present == 0) return Execution::done;
  if ((w.present & ~set_words) == 0) return take_group(in);
  if ((w.present & ~of_tool) == 0) return take_tool(in);
  const WordSet others = w.present & ~(w.has(Role::life_group) ? set_words : of_tool);
  return in.raise_first(Condition::illegal_address, others);
}

Execution select_managed_tool(BlockContext& in, uint32_t* tool) {
  const ToolLife lives(in.frames);
  const bool of_group = !in.settings.life_by_tool && *tool != 0;
  const unsigned slot = of_group ? lives.next_of(*tool) : lives.with_tool(*tool);
  if (of_group && slot == ToolLife::kNone) return in.raise(Condition::life_group, Role::tool, *tool);
  if (slot != ToolLife::kNone) *tool = static_cast<uint32_t>(lives.get(slot, LifeColumn::tool));
  set(in, ToolInUse::selected, slot == ToolLife::kNone ? 0 : slot + 1);
  return Execution::done;
}

void take_managed_tool(BlockContext& in) {
  const ToolLife lives(in.frames);
  const unsigned slot = lives.selected();
  set(in, ToolInUse::spindle, slot == ToolLife::kNone ? 0 : slot + 1);
  set(in, ToolInUse::cutting, 0);
  if (slot != ToolLife::kNone) {
    if (lives.status(slot) == LifeStatus::unused) set(in, slot, LifeColumn::status, static_cast<double>(LifeStatus::in_use));
    if (lives.method(slot) == LifeMethod::mounts) count(in, slot);
  }
  Action& action = in.emit(ItemKind::action).action;
  action.kind = NC_ACTION_CONTROL;
  action.index = NC_CONTROL_TOOL_LIFE;
  action.value = slot == ToolLife::kNone ? 0 : slot + 1;
}

/// A use is a cut behind rapid traverse.
void count_tool_use(BlockContext& in, bool cuts) {
  const unsigned key = in.frames.tool_in_use_key(static_cast<unsigned>(ToolInUse::cutting));
  const bool before = in.frames.get(key) != 0;
  if (before == cuts) return;
  in.set_table(key, cuts ? 1 : 0);
  const unsigned slot = ToolLife(in.frames).in_spindle();
  if (cuts && slot != ToolLife::kNone && ToolLife(in.frames).method(slot) == LifeMethod::uses) count(in, slot);
}

}  // namespace nc
