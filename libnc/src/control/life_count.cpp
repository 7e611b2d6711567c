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
  const ToolLife lives(tables.frames());
  uint8_t number = 0;
  uint32_t ms = 0;
  while (executor.tool_cut(&number, &ms)) {
    const unsigned slot = number - 1U;
    if (number == 0 || slot >= kLifeTools || !lives.group(slot)) continue;
    if (ms == LifeRing::kBroken) {
      tables.set_shared(lives.key(slot, LifeColumn::status), static_cast<double>(LifeStatus::error_1));
      continue;
    }
    if (lives.method(slot) != LifeMethod::time) continue;
    const double used = std::min(kMostMinutes, lives.get(slot, LifeColumn::used) + ms / kMinute_ms), life = lives.get(slot, LifeColumn::life);
    tables.set_shared(lives.key(slot, LifeColumn::used), used);
    if (life > 0 && used >= life && lives.lives(slot)) tables.set_shared(lives.key(slot, LifeColumn::status), static_cast<double>(LifeStatus::ended));
  }
  const unsigned tool = executor.tool_in_spindle();
  if (tool == 0 || tool > kLifeTools) return executor.tell_tool_life(0, 0);
  const uint32_t group = lives.group(tool - 1), ended = group && !lives.lives(tool - 1) ? +NC_TOOL_LIFE_ENDED : 0, all = lives.all_ended(group) ? +NC_TOOL_GROUP_ENDED : 0;
  executor.tell_tool_life(ended | all, group);
}

}  // namespace nc
