// SPDX-License-Identifier: Apache-2.0
// The maps of a program as matrices (interpret/program_map.hpp), kept until something that they are made of changes.
#pragma once

#include "frame/affine.hpp"

namespace nc {

/// Everything that the matrices are made of. It is compared whole, so that whoever changes one of these, a rewind for example, does not
/// have to know of the matrices.
struct ProgramMatricesKey {
  uint64_t records = ~uint64_t{0};  ///< Journalled::changes()
  AxisVec zero;                   ///< of the workpiece coordinates: some centres are points of the machine
  int8_t plane[2] = {-1, -1};
  uint8_t scaled = 0, mirror = 0, figure_scaled = 0, figure_mirror = 0, switch_mirror = 0;
  bool rotated = false, work_turned = false, in_figure = false;
  bool operator==(const ProgramMatricesKey&) const = default;
};

struct ProgramMatrices {
  ProgramMatricesKey made_of;
  Affine forward;          ///< from programmed points to workpiece coordinates
  Affine backward;         ///< where the axes stand as a programmed point: through the rotation by parameter that they have reached
  Affine directions;       ///< forward without the factors of scaling
  Affine before_mirror;    ///< from workpiece coordinates to those in front of mirror image, where the centre of G68 is a point
  Affine to_turned;        ///< from workpiece coordinates to those behind the turn of a figure, as they are from its pass 1 on
  Affine shape_to_program; ///< from coordinates in front of that turn to programmed ones
};

}  // namespace nc
