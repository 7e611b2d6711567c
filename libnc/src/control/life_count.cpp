// SPDX-License-Identifier: Apache-2.0
// Tool life management where the machine cuts: the minutes that the scan has counted go into the table, and the state of the tool in the spindle goes to the
// machine. It is no part of the program, so no rewind takes it back.
#include <algorithm>

#include "control/life_count.hpp"
#include "control/part_system.hpp"
#include "dialect/dialect.hpp"
#include "frame/tool_life.hpp"
#include "interpolate/life_ring.hpp"

namespace nc {
namespace {

/// The slot of the tool that is in the spindle, kNone = it is not registered there any more.
unsigned slot_of(const ToolLives& lives, const MountedTool& mounted) {
  return mounted.place == 0 ? ToolLives::kNone : lives.find({mounted.place - 1U, mounted.number});
}

}  // namespace

void count_minutes(const HostTables& tables, unsigned slot, double minutes, double most) {
  if (slot == ToolLives::kNone) return;
  const ToolLife& tool = tables.lives().tool[slot];
  if (tool.flags.method != LifeMethod::time) return;
  const double used = std::min(most, tool.used + minutes);
  tables.set_life(slot, &ToolLife::used, used);
  if (tool.life != 0 && used >= static_cast<double>(tool.life) && tool.lives()) tables.set_life(slot, &ToolLife::status, LifeStatus::ended);
}

void PartSystem::count_tool_life() {
  constexpr double kMinute_ms = 60000;
  const HostTables tables = interpreter.tables();
  const ToolLives& lives = tables.lives();
  MountedTool mounted;
  uint32_t ms = 0;
  while (executor.tool_cut(&mounted, &ms)) {
    const unsigned slot = slot_of(lives, mounted);
    if (ms != LifeRing::kBroken) count_minutes(tables, slot, ms / kMinute_ms, dialect_->rules.range.most_life_minutes);
    else if (slot != ToolLives::kNone) tables.set_life(slot, &ToolLife::status, LifeStatus::error_1);
  }
  const unsigned in_spindle = slot_of(lives, executor.tool_in_spindle());
  if (in_spindle == ToolLives::kNone) return executor.tell_tool_life(0, 0);
  const ToolLife& tool = lives.tool[in_spindle];
  const uint32_t ended = !tool.lives() ? +NC_TOOL_LIFE_ENDED : 0, all = lives.all_ended(tool.group) ? +NC_TOOL_GROUP_ENDED : 0;
  executor.tell_tool_life(ended | all, static_cast<uint32_t>(tool.group));
}

}  // namespace nc
