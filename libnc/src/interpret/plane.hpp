// SPDX-License-Identifier: Apache-2.0
// The plane of G17, G18, G19 and the axes that it has: basic axes and, where a parameter gives them one, their parallel axes.
#pragma once

#include "interpret/interpreter.hpp"

namespace nc {

struct PlaneAxes {
  int h, v;        ///< first and second axis, right-handed; -1 = the machine has none
  Plane plane;
  char center[2];  ///< addresses of the centre words
};

/// Which axis of the pair I, J or K (0, 1, 2) the block in hand means: the parallel one of #1029 to #1031 where the block names it and
/// not the basic one (#1026 to #1028), else that; -1 = the machine has none.
int8_t axis_of_pair(const Interpreter& in, unsigned pair);

/// The plane in force.
PlaneAxes plane_axes(const Interpreter& in);

/// G17, G18, G19 (times 10) in the block in hand: M700 6.3, the axis of a pair that the block names, the basic one when it names
/// both or none.
Did select_plane(Interpreter& in, int16_t code);

/// The plane `code` with its basic axes: power on, reset.
void select_basic_plane(Interpreter& in, int16_t code);

}  // namespace nc
