// SPDX-License-Identifier: Apache-2.0
// Tool life management: its data by program (G10 L3, data blocks, G11), the tool that T selects of a group, and the counting of mounts and uses. The
// minutes are counted by the machine (control/life_count.cpp). The manual has the variables (M700 13.5.5, 10.15) and alarms P178, P179; the rest is the
// practice of the field (docs/decisions.md).
#include <cmath>

#include "frame/tool_life.hpp"
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// A block that removes tools waits for the machine to come to it: until then the machine counts in their rows, and what is taken back of a block that was only read (a
/// reset, the tables as the executed blocks have left them) would take the minutes of cutting with it. The journal has no older blocks to take back then, so all tools
/// may go at once.
Execution wait_for_removal(BlockInHand& in, unsigned tools) {
  if (!in.shared_known()) return in.need(NC_SYNC_SHARED);
  return tools > 0 && !in.world_fresh ? in.need(NC_SYNC_STOPPED) : Execution::done;
}

/// The tool with number `slot` from 0 is in the spindle, and its life is managed from here on.
void tell_machine(BlockContext& in, unsigned slot) {
  Action& action = in.emit(ItemKind::action).action;
  action.kind = NC_ACTION_CONTROL;
  action.index = NC_CONTROL_TOOL_LIFE;
  action.value = slot == ToolLives::kNone ? 0 : slot + 1;
  action.bits = in.lives->registered_in(slot).number;
}

void register_tool(InForce& in, unsigned slot, const ToolLife& tool) { in.lives.change(in.state.seq + 1, &ToolLives::tool, slot, tool); }

/// A tool that is in the spindle stays there, and is found again where it is registered anew.
void clear_slot(InForce& in, unsigned slot) { register_tool(in, slot, ToolLife{}); }

void clear_group(InForce& in, uint32_t group) {
  for (unsigned slot = 0; slot < kLifeTools; ++slot)
    if (in.lives->tool[slot].group == group) clear_slot(in, slot);
}

/// The group has got tools by the input that is under way.
bool given_before(const InForce& in, uint32_t group) {
  const uint8_t* const registered = in.state.life_input.registered;
  for (unsigned slot = 0; slot < kLifeTools; ++slot)
    if ((registered[slot / 8] >> slot % 8 & 1) != 0 && in.lives->tool[slot].is_of(group)) return true;
  return false;
}

Execution number_of(BlockInHand& in, Role word, uint32_t least, uint32_t most, uint32_t* number) {
  if (!in.words.has(word)) return in.raise(Condition::words_missing, word);
  if (whole_number(in.words.get(word), number) && *number >= least && *number <= most) return Execution::done;
  return in.raise(Condition::value_range, word, in.words.get(word));
}

/// P L Q: a group, and what its tools have in common. Q1 counts mounts, which is what holds without Q; Q2 minutes, Q3 uses.
Execution take_group(BlockContext& in) {
  LifeInput& input = in.state.life_input;
  const Command& w = in.words;
  uint32_t group = 0, method = 1;
  Execution did = number_of(in, Role::life_group, 1, in.dialect->rules.range.largest_life_number, &group);
  if (did != Execution::done) return did;
  const unsigned before = in.lives->registered(group);
  did = wait_for_removal(in, before);
  if (did != Execution::done) return did;
  const bool known = before != 0;
  if (input.kind == LifeInput::Kind::remove) {
    const WordSet data = w.present & in.set_of({Role::life_span, Role::life_method});  // of a group that was to be registered
    if (data != 0) return in.raise_first(Condition::illegal_address, data);
    if (!known) return in.raise(Condition::life_group, Role::life_group, group);
    clear_group(in, group);
    return Execution::done;
  }
  // Appendix 1, P179: commanded in duplicate. What was registered before this input may be registered anew.
  if (group == input.group || (input.kind == LifeInput::Kind::anew ? known : given_before(in, group))) return in.raise(Condition::life_group, Role::life_group, group);
  if (w.has(Role::life_method)) {
    did = number_of(in, Role::life_method, 1, 3, &method);
    if (did != Execution::done) return did;
  }
  const LifeMethod counts = method == 1 ? LifeMethod::mounts : method == 2 ? LifeMethod::time : LifeMethod::uses;
  if (!w.has(Role::life_span)) return in.raise(Condition::words_missing, Role::life_span);
  const double life = w.get(Role::life_span), most = in.dialect->rules.range.most_life(counts == LifeMethod::time);
  if (!(life >= 0 && life <= most && life == std::trunc(life))) return in.raise(Condition::value_range, Role::life_span, life);
  clear_group(in, group);  // a group that is given again loses its tools
  input.group = group;
  input.life = static_cast<uint32_t>(life);
  input.method = counts;
  return Execution::done;
}

/// T H D: the next tool of the group.
Execution take_tool(BlockInHand& in) {
  if (!in.shared_known()) return in.need(NC_SYNC_SHARED);  // another part system may register a tool in the same place
  LifeInput& input = in.state.life_input;
  uint32_t tool = 0, length = 0, radius = 0;
  if (!input.group) return in.raise(Condition::words_missing, Role::life_group);
  if (input.kind == LifeInput::Kind::remove) return in.raise(Condition::format_error, Role::life_group);
  Execution did = number_of(in, Role::life_tool, 1, in.dialect->rules.range.largest_life_number, &tool);
  if (did == Execution::done && in.words.has(Role::life_length)) did = number_of(in, Role::life_length, 0, in.frames.tool_offsets(), &length);
  if (did == Execution::done && in.words.has(Role::life_radius)) did = number_of(in, Role::life_radius, 0, in.frames.tool_offsets(), &radius);
  if (did != Execution::done) return did;
  const unsigned slot = in.lives->free_slot();
  if (slot == ToolLives::kNone) return in.raise(Condition::life_full, Role::life_tool, tool);
  ToolLife registered;
  registered.group = input.group;
  registered.tool = tool;
  registered.flags.method = input.method;
  registered.life = input.life;
  registered.length = length;
  registered.radius = radius;
  register_tool(in, slot, registered);
  input.registered[slot / 8] = static_cast<uint8_t>(input.registered[slot / 8] | 1U << slot % 8);
  return Execution::done;
}

/// One more of what is counted in times.
void count(InForce& in, unsigned slot) {
  const ToolLife& tool = in.lives->tool[slot];
  in.change_life(slot, &ToolLife::used, std::fmin(tool.used + 1, in.dialect->rules.range.most_life(tool.flags.method == LifeMethod::time)));
  if (tool.life != 0 && tool.used >= static_cast<double>(tool.life) && tool.lives()) in.change_life(slot, &ToolLife::status, LifeStatus::ended);
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
  unsigned any = 0;
  for (const ToolLife& tool : in.lives->tool) any += how == 0 && !(tool == ToolLife{}) ? 1u : 0u;
  const Execution did = how == 0 ? wait_for_removal(in, any) : Execution::done;
  if (did != Execution::done) return did;
  in.state.life_input = {};
  in.state.life_input.kind = how == 0 ? LifeInput::Kind::anew : how == 1 ? LifeInput::Kind::add : LifeInput::Kind::remove;
  for (unsigned slot = 0; how == 0 && slot < kLifeTools; ++slot)
    if (!(in.lives->tool[slot] == ToolLife{})) clear_slot(in, slot);
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

Execution select_managed_tool(BlockInHand& in, uint32_t* tool) {
  const ToolLives& lives = *in.lives;
  const bool of_group = !in.settings.life_by_tool && *tool != 0;
  const unsigned slot = of_group ? lives.next_of(*tool) : lives.with_tool(*tool);
  if (of_group && slot == ToolLives::kNone) return in.raise(Condition::life_group, Role::tool, *tool);
  if (slot != ToolLives::kNone) *tool = static_cast<uint32_t>(lives.tool[slot].tool);
  in.change(&ProgramRecords::tools, &ToolsInUse::selected, lives.registered_in(slot));
  return Execution::done;
}

void take_managed_tool(BlockContext& in) {
  const unsigned slot = in.lives->find(in.records->tools.selected);
  in.change(&ProgramRecords::tools, &ToolsInUse::spindle, in.lives->registered_in(slot));
  in.change(&ProgramRecords::tools, &ToolsInUse::cutting, false);
  if (slot != ToolLives::kNone) {
    const ToolLife& tool = in.lives->tool[slot];
    if (tool.lives()) in.change_life(slot, &ToolLife::status, LifeStatus::in_use);
    if (tool.flags.method == LifeMethod::mounts) count(in, slot);
  }
  tell_machine(in, slot);
}

/// A use is a cut behind rapid traverse.
void count_tool_use(InForce& in, bool cuts) {
  const ToolsInUse& tools = in.records->tools;
  if (tools.cutting == cuts) return;
  in.change(&ProgramRecords::tools, &ToolsInUse::cutting, cuts);
  const unsigned slot = in.managed_tool();
  if (cuts && slot != ToolLives::kNone && in.lives->tool[slot].flags.method == LifeMethod::uses) count(in, slot);
}

}  // namespace nc
