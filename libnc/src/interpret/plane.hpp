// SPDX-License-Identifier: Apache-2.0
// The plane of G17, G18, G19 and its axes: the basic axes, and the parallel axes that parameters give them.
#pragma once

#include "interpret/motion.hpp"

namespace nc {

struct PlaneAxes {
  int h, v;        ///< index of the first and second axis, right-handed; -1 = the machine has no such axis
  Plane plane;
  Role center[2];  ///< the words that give the centre on these axes
};

/// Which axis of the pair I, J or K (0, 1, 2) the block in hand means: the parallel axis (#1029 to #1031) where the block names it and not the basic one,
/// otherwise the basic axis (#1026 to #1028); -1 = the machine has no such axis.
int8_t axis_of_pair(const BlockInHand& in, unsigned pair);

/// The plane in force.
PlaneAxes plane_axes(const InForce& in);

/// Executes G17, G18 or G19 of the block in hand. M700 6.3: of each pair the axis that the block names is taken, the basic one when it names both or none.
Execution select_plane(BlockInHand& in, const FunctionRow& row);

/// HX 4.7: the axis (I, J or K: 0, 1, 2) of the plane in force that the rotary axis of a cylinder stands for.
unsigned cylinder_stands_for(const InForce& in);
/// It takes that axis' place in the plane.
void put_cylinder_axis(InForce& in);

/// The basic axes of a plane, which it has at power on and reset, and the third basic axis.
void basic_plane_axes(const InForce& in, Function plane, int8_t axis[2], int8_t* third);

/// A plane by its first and second pair I, J, K (0, 1, 2), right-handed. M700 6.3: G17 = IJ, G18 = KI (K is horizontal), G19 = JK.
struct PlanePair {
  uint8_t first, second;
  Plane plane;
  unsigned third() const { return 3u - first - second; }  ///< the pair that it leaves out
};
PlanePair pair_of(Function plane);

}  // namespace nc
