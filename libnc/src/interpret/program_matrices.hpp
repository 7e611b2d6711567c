// SPDX-License-Identifier: Apache-2.0
// The maps of a program (interpret/program_map.hpp) as matrices, which are kept until something changes from which they are calculated.
#pragma once

#include "frame/affine.hpp"

namespace nc {

/// Everything from which the matrices are calculated. It is compared as a whole, so that code which changes one of these values (a rewind, for example)
/// need not know of the matrices.
struct ProgramMatricesKey {
  uint64_t records = ~uint64_t{0};  ///< Journalled::changes()
  AxisVec zero;                   ///< zero point of the workpiece coordinates, because some centres are given in machine coordinates
  int8_t plane[2] = {-1, -1};
  uint8_t scaled = 0, mirror = 0, figure_scaled = 0, figure_mirror = 0, switch_mirror = 0;
  bool rotated = false, work_turned = false, in_figure = false;
  bool operator==(const ProgramMatricesKey&) const = default;
};

struct ProgramMatrices {
  ProgramMatricesKey made_of;
  Affine forward;          ///< from programmed points to workpiece coordinates
  Affine backward;         ///< from the place of the axes to a programmed point, by the rotation by parameter that the axes have reached
  Affine directions;       ///< `forward` without the factors of scaling
  Affine before_mirror;    ///< from workpiece coordinates to those before mirror image, in which the centre of G68 is given
  Affine to_turned;        ///< from workpiece coordinates to those right behind the rotation of a figure
  Affine shape_to_program; ///< from the coordinates right before that rotation to programmed ones
};

}  // namespace nc
