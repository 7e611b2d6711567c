// SPDX-License-Identifier: Apache-2.0
#include "frame/tool_life.hpp"

#include <initializer_list>

namespace nc {

uint32_t ToolLife::first_group() const {
  for (unsigned slot = 0; slot < kLifeTools; ++slot)
    if (group(slot)) return group(slot);
  return 0;
}

unsigned ToolLife::registered(uint32_t of_group) const {
  unsigned count = 0;
  for (unsigned slot = 0; slot < kLifeTools; ++slot) count += of_group && group(slot) == of_group ? 1u : 0u;
  return count;
}

unsigned ToolLife::nth(uint32_t of_group, unsigned number) const {
  return first(of_group, [&number](unsigned) { return --number == 0; });
}

unsigned ToolLife::number_in_group(unsigned slot) const {
  unsigned number = 1;
  for (unsigned before = 0; before < slot; ++before) number += group(before) == group(slot) ? 1u : 0u;
  return number;
}

unsigned ToolLife::free_slot() const {
  for (unsigned slot = 0; slot < kLifeTools; ++slot)
    if (!group(slot)) return slot;
  return kNone;
}

unsigned ToolLife::with_tool(uint32_t tool) const {
  for (unsigned slot = 0; slot < kLifeTools; ++slot)
    if (group(slot) && get(slot, LifeColumn::tool) == tool) return slot;
  return kNone;
}

unsigned ToolLife::next_of(uint32_t of_group) const {
  for (const LifeStatus wanted : {LifeStatus::in_use, LifeStatus::unused}) {
    const unsigned slot = first(of_group, [&](unsigned at) { return status(at) == wanted; });
    if (slot != kNone) return slot;
  }
  return nth(of_group, registered(of_group));
}

unsigned ToolLife::current_of(uint32_t of_group) const {
  const unsigned slot = in_spindle();
  return slot != kNone && of_group && group(slot) == of_group ? slot : next_of(of_group);
}

bool ToolLife::all_ended(uint32_t of_group) const {
  return registered(of_group) != 0 && first(of_group, [this](unsigned at) { return lives(at); }) == kNone;
}

}  // namespace nc
