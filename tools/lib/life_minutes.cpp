// SPDX-License-Identifier: Apache-2.0
#include "tools/lib/life_minutes.hpp"

namespace nc::tools {
namespace {

/// What NC_LIFE_FLAGS says is counted: 0 is minutes.
constexpr unsigned kCounted = 0x30;
constexpr double kEnded = 2;  // of NC_LIFE_STATUS

double column(const nc_control* control, unsigned place, nc_life_column column) {
  double value = 0.0;
  return nc_tool_life_get(control, place, column, &value) == NC_OK ? value : 0.0;
}

bool is_registered(const nc_control* control, unsigned place, uint32_t tool) {
  return column(control, place, NC_LIFE_GROUP) != 0.0 && column(control, place, NC_LIFE_TOOL) == tool;
}

// The place from before, else the first one with the number of the tool, 0 = it is registered no more.
unsigned place_of(const nc_control* control, unsigned place, uint32_t tool) {
  if (is_registered(control, place, tool)) return place;
  for (unsigned other = 1; tool != 0 && other <= NC_TOOL_LIVES; ++other)
    if (is_registered(control, other, tool)) return other;
  return 0;
}

}  // namespace

void wear_tool(nc_control* control, unsigned place, uint32_t tool, double minutes) {
  const unsigned at = place_of(control, place, tool);
  if (at == 0 || (static_cast<unsigned>(column(control, at, NC_LIFE_FLAGS)) & kCounted) != 0) return;
  const double used = column(control, at, NC_LIFE_USED) + minutes, life = column(control, at, NC_LIFE_LIFE);
  nc_tool_life_set(control, at, NC_LIFE_USED, used);  // at the end of its range the count stays where it is
  if (life > 0.0 && used >= life && column(control, at, NC_LIFE_STATUS) < kEnded) nc_tool_life_set(control, at, NC_LIFE_STATUS, kEnded);
}

}  // namespace nc::tools
