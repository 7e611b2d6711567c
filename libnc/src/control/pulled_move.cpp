// SPDX-License-Identifier: Apache-2.0
// What a sink may ask of the move that it has pulled last.
#include <cstring>

#include "control/part_system.hpp"

namespace nc {

nc_status PartSystem::move_point(double share, nc_axes* machine) const {
  const Curve& curve = commit_.curve();
  if (online_ || !(curve.length > 0)) return NC_E_STATE;
  const AxisVec at = curve_position(curve, share * curve.length, axis_count_);
  std::memcpy(machine->v, at.v, sizeof machine->v);
  return NC_OK;
}

nc_status PartSystem::move_zero(nc_axes* zero) const {
  if (online_ || pulled_ != ItemKind::move) return NC_E_STATE;
  std::memcpy(zero->v, (*interpreter.pools().transforms)[move_transform_].offset().v, sizeof zero->v);
  return NC_OK;
}

nc_status PartSystem::move_side(nc_side* side, uint8_t plane_axis[2]) const {
  if (online_ || pulled_ != ItemKind::move) return NC_E_STATE;
  if (move_offset_ == 0) {
    *side = move_in_space_ ? NC_SIDE_SPACE : NC_SIDE_NONE;
    return NC_OK;
  }
  *side = move_offset_ > 0 ? NC_SIDE_LEFT : NC_SIDE_RIGHT;
  plane_axis[0] = move_plane_axis_[0];
  plane_axis[1] = move_plane_axis_[1];
  return NC_OK;
}

}  // namespace nc
