// SPDX-License-Identifier: Apache-2.0
#include "frame/tool_life.hpp"

#include <initializer_list>

namespace nc {
namespace {

constexpr unsigned kMethodShift = 4, kMethodMask = 3;

}  // namespace

double life_number(uint64_t value) { return static_cast<double>(value); }
double life_number(double value) { return value; }
double life_number(LifeStatus value) { return static_cast<double>(value); }
double life_number(LifeFlags value) { return value.others | static_cast<uint32_t>(value.method) << kMethodShift; }

void from_life_number(double number, uint64_t& value) { value = static_cast<uint64_t>(number); }
void from_life_number(double number, double& value) { value = number; }
void from_life_number(double number, LifeStatus& value) { value = static_cast<LifeStatus>(number); }
void from_life_number(double number, LifeFlags& value) {
  const auto bits = static_cast<uint32_t>(number);
  value = {static_cast<LifeMethod>(bits >> kMethodShift & kMethodMask), bits & ~(kMethodMask << kMethodShift)};
}

double life_number(const ToolLife& tool, LifeColumn column) {
  return visit_column(column, [&tool](auto member) { return life_number(tool.*member); });
}

uint64_t ToolLives::first_group() const {
  for (const ToolLife& any : tool)
    if (!any.is_free()) return any.group;
  return 0;
}

unsigned ToolLives::registered(uint64_t group) const {
  unsigned count = 0;
  for (const ToolLife& any : tool) count += any.is_of(group) ? 1u : 0u;
  return count;
}

unsigned ToolLives::nth(uint64_t group, unsigned number) const {
  return first(group, [&number](const ToolLife&) { return --number == 0; });
}

unsigned ToolLives::number_in_group(unsigned slot) const {
  unsigned number = 1;
  for (unsigned before = 0; before < slot; ++before) number += tool[before].group == tool[slot].group ? 1u : 0u;
  return number;
}

unsigned ToolLives::free_slot() const {
  for (unsigned slot = 0; slot < kLifeTools; ++slot)
    if (tool[slot].is_free()) return slot;
  return kNone;
}

unsigned ToolLives::with_tool(uint64_t number) const {
  for (unsigned slot = 0; slot < kLifeTools; ++slot)
    if (!tool[slot].is_free() && tool[slot].tool == number) return slot;
  return kNone;
}

unsigned ToolLives::next_of(uint64_t group) const {
  for (const LifeStatus wanted : {LifeStatus::in_use, LifeStatus::unused}) {
    const unsigned slot = first(group, [wanted](const ToolLife& any) { return any.status == wanted; });
    if (slot != kNone) return slot;
  }
  return nth(group, registered(group));
}

unsigned ToolLives::current_of(uint64_t group, unsigned in_spindle) const {
  return in_spindle != kNone && tool[in_spindle].is_of(group) ? in_spindle : next_of(group);
}

unsigned ToolLives::first_alive(uint64_t group) const {
  return first(group, [](const ToolLife& any) { return any.lives(); });
}

}  // namespace nc
