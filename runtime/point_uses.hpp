// SPDX-License-Identifier: Apache-2.0
// What each point of a machine is used for, and which uses one point cannot have together. The rows are those of the table in docs/connecting-a-machine.md.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "runtime/config.hpp"

namespace nc::rt {

class TableReader;

// Who gives a point its value, and who goes by it.
enum class PointWay : std::uint8_t { kSetsOutput, kObeysOutput, kGivesInput, kReadsInput };

struct PointRoleRow {
  PointRole role;
  PointWay way;
  const char* keys;   // of the configuration
  const char* what;   // "the brake of axis %": % is the axis, the spindle or the number
  const char* other;  // what else the point may be; for the document
};
std::span<const PointRoleRow> point_roles();  // in the order of PointRole

// Behind all sections: two uses of one point that cannot be, each an error with both lines; and homing that its drive does not hear of.
void check_point_uses(TableReader* root, const Config& config);

}  // namespace nc::rt
