// SPDX-License-Identifier: Apache-2.0
// Tool life management where the machine cuts: the minutes that the scan has counted go into the table, and the state of the tool in the spindle goes to the
// machine. It is no part of the program, so no rewind takes it back.
#include <algorithm>

#include "control/part_system.hpp"
#include "frame/tool_life.hpp"
#include "interpolate/life_ring.hpp"

namespace nc {

void PartSystem::count_tool_life() {
  constexpr double kMinute_ms = 60000, kMostMinutes = 4000;
  const HostTables tables = interpreter.tables();
  const ToolLives& lives = tables.lives();
  uint8_t number = 0;
  uint32_t ms = 0;
  while (executor.tool_cut(&number, &ms)) {
    const unsigned slot = number - 1U;
    if (number == 0 || slot >= kLifeTools || lives.tool[slot].is_free()) continue;
    const ToolLife& tool = lives.tool[slot];
    if (ms == LifeRing::kBroken) {
      tables.set_life(slot, &ToolLife::status, LifeStatus::error_1);
      continue;
    }
    if (tool.flags.method != LifeMethod::time) continue;
    const double used = std::min(kMostMinutes, tool.used + ms / kMinute_ms);
    tables.set_life(slot, &ToolLife::used, used);
    if (tool.life != 0 && used >= static_cast<double>(tool.life) && tool.lives()) tables.set_life(slot, &ToolLife::status, LifeStatus::ended);
  }
  const unsigned in_spindle = executor.tool_in_spindle();
  if (in_spindle == 0 || in_spindle > kLifeTools) return executor.tell_tool_life(0, 0);
  const ToolLife& tool = lives.tool[in_spindle - 1];
  const uint32_t ended = !tool.is_free() && !tool.lives() ? +NC_TOOL_LIFE_ENDED : 0, all = lives.all_ended(tool.group) ? +NC_TOOL_GROUP_ENDED : 0;
  executor.tell_tool_life(ended | all, static_cast<uint32_t>(tool.group));
}

}  // namespace nc
