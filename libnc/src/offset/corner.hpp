// SPDX-License-Identifier: Apache-2.0
// The geometry of a joint between two blocks: where the centre of the tool passes (M700 12.4.1, 12.4.2;
// DGSHAPE G40-G42).
//
// Everything is relative to the programmed point of the joint. A block is known near its joint by its unit
// tangent u in the direction of travel and its signed curvature k (counter-clockwise positive, 0 for a line).
// The offset o is signed too: the amount to the left of the direction of travel (G42 and negative amounts
// make it negative). n is the left normal of u.
//
// A point at vector w lies on the curve that runs at the distance o beside the block exactly when
//
//     w.n = o + k/2 (|w|^2 - o^2)
//
// For a line (k = 0) that is w.n = o. For an arc the centre is at n/k and the offset circle has the radius
// |1/k - o|: |w - n/k|^2 = (1/k - o)^2, multiplied by k/2. So lines and arcs go through one formula, and two
// blocks give two linear equations in w and q = |w|^2; q itself comes from a quadratic. The smaller q is the
// intersection nearer to the joint.
#pragma once

#include <cstdint>

#include "base/same_place.hpp"
#include "offset/plane_vector.hpp"
#include "stream/stream.hpp"

namespace nc {

/// What the last of three digits makes of the radius of an arc, I and J and both ends together, but for one arc in fifty; less than what the check of walls allows (kEnters_mm).
inline constexpr double kLastDigit_mm = 9e-4 + kOneLength_mm;
/// The same of words in millimetres or of four digits in inch, whose last one is 2.54 um.
inline double unsure_of(bool inch) { return inch ? 2.54 * kLastDigit_mm : kLastDigit_mm; }

/// A block as seen from its joint.
struct Leg {
  Vec2 u;                ///< unit tangent in the direction of travel
  double curvature = 0;  ///< 1/mm, counter-clockwise positive, 0 = line
};

/// A circular move has a radius at both of its ends. One that begins or ends in its centre has no tangent there; it
/// counts as the straight line between its ends, which is what it is programmed as (interpret/arc.cpp).
bool goes_round(const Move& move);

/// The legs of a move at its start and at its end. False when the move does not go anywhere in the plane of
/// compensation.
bool make_legs(const Move& move, Leg* begin, Leg* end);

/// Vectors at a joint in the order of travel. The block before ends at v[0], the block behind starts at v[n -
/// 1].
struct ContourJoint {
  static constexpr unsigned kMax = 4;  // M700 12.4.8: (1) to (4)
  Vec2 v[kMax];
  uint8_t n = 0;
  bool corner_arc = false;  ///< from v[0] to v[1] on an arc about the programmed point (G39), else straight
  bool lengthened =
      false;  ///< the first two vectors lie on the lengthened block before, the last two on the one behind (outer corner of four vectors, or of three with one on both)
  bool first_erased = false;  ///< 12.4.8 has erased the vector on the curve of the block before: where that one ends now need not lie on it
  bool last_erased = false;   ///< ... and the one on the curve of the block behind, where that one begins

  static ContourJoint single(Vec2 w) {
    ContourJoint joint;
    joint.set(w);
    return joint;
  }
  /// Makes it the joint of this one vector.
  void set(Vec2 w) {
    v[0] = w;
    n = 1;
    corner_arc = lengthened = first_erased = last_erased = false;
  }
  /// Makes it the same as another: of one vector in nearly every block.
  void copy(const ContourJoint& other) {
    v[0] = other.v[0];
    for (unsigned k = 1; k < other.n; ++k) v[k] = other.v[k];
    n = other.n;
    corner_arc = other.corner_arc;
    lengthened = other.lengthened;
    first_erased = other.first_erased;
    last_erased = other.last_erased;
  }
};

/// A line shorter than this has no direction: the last digit of its words decides where it leads, and a corner beside it would take the tool
/// anywhere. It goes along with the vector of the joint before it, which is that of the blocks around it, so the path is off by less than this,
/// half of what the check of walls allows (kEnters_mm). Several in a row are a block as soon as they lead this far.
inline constexpr double kNoDirection_mm = 5e-4 - kOneLength_mm;

/// "Extremely large" (M700 12.4.2, G40 I J K) has no number in the manual: chosen as ten times the amount, a turn of
/// 168.5 degrees.
inline constexpr double kExtremelyLarge = 10;

enum class Turn : uint8_t { straight, inner, obtuse, acute };

/// Which kind of corner this is for a tool at the signed offset. Of a cusp, where the path goes straight back, the curvatures tell on which side it does.
Turn classify(const Leg& before, const Leg& behind, double offset);

/// Does the path turn back by half a turn, as far as the digits of its words can tell?
bool is_cusp(const Leg& before, const Leg& behind);

/// Sine of the turn to the left; of a cusp its sign is that of the side on which the two blocks lie apart, which the curvatures tell.
double sine_of_turn(const Leg& before, const Leg& behind);

/// The path turns towards the tool from one vector at right angles to the next one: an arc about such a corner would lead into it.
bool turns_to_tool(Vec2 before, Vec2 behind, double offset);

/// Vector at right angles to a block.
inline Vec2 perpendicular(const Leg& leg, double offset) {
  return offset * left_of(leg.u);
}

/// True when the offset curve exists: the amount is not larger than the radius on the inside of an arc (equal
/// makes a point).
inline bool offset_exists(const Leg& leg, double offset) {
  return 1 - leg.curvature * offset > -1e-9;
}

/// The offset curve inside of an arc that is as large as the tool, as far as the last digit tells (`unsure`), is a point: its centre.
inline bool is_point(const Leg& leg, double offset, double unsure) {
  return leg.curvature != 0 && std::abs(1 / leg.curvature - offset) < unsure;
}

/// Can the tool go along the block at all?
inline bool tool_fits(const Leg& leg, double offset, double unsure) { return offset_exists(leg, offset) || is_point(leg, offset, unsure); }

/// Vector to the intersection of two offset curves, the one nearest to the joint.
bool intersection(const Leg& before, double offset_before, const Leg& behind, double offset_behind, Vec2* w);

/// The joint inside the mode. False: no intersection on the inner side (M700 12.4.1 (4)). The amounts are those in front of it and behind it: they differ where the amount
/// changes in the joint itself, not along one of the blocks.
/// The ways that the two blocks lead, `delta_before` and `delta_behind`, bound how much a change of side may cut off.
bool joint_in_mode(const Leg& before, double offset_before, Vec2 delta_before, const Leg& behind, double offset_behind, Vec2 delta_behind, double unsure, ContourJoint* joint);

/// DGSHAPE G40 to G42, "Exceptions": lines that meet at an inner angle of a degree or less have their intersection more than a hundred radii away. Two vectors at right
/// angles take its place.
bool is_of_spike(const ContourJoint& joint, double offset);
ContourJoint joint_of_spike(const Leg& before, const Leg& behind, double offset);

/// The joint at the end of a start block.
ContourJoint joint_at_start(const Leg& before, const Leg& behind, double offset, bool type_b);

/// The joint before a cancel block.
ContourJoint joint_at_cancel(const Leg& before, const Leg& behind, double offset, bool type_b);

/// The joint before a cancel block with I J K: `direction` is the hypothetical path's.
ContourJoint joint_at_cancel_vector(const Leg& before, Vec2 direction, double offset);

/// The tool goes round the corner.
bool is_outer(const Leg& before, const Leg& behind, double offset);

/// The joint of G39: an arc about the programmed point from one perpendicular to the other.
ContourJoint joint_corner_arc(const Leg& before, const Leg& behind, double offset);

/// The joint at an outer corner: an arc where the cosine of the turn is below `arc_cos`, else the intersection (Series 8 G41). False: it is no such corner.
bool joint_of_outer_corner(const Leg& before, const Leg& behind, double offset, double arc_cos, ContourJoint* joint);

/// End vector that the words of the block itself give (G41/G42/G38 with I J K).
Vec2 commanded_vector(const Compensation& comp);

/// Signed offset to the left of the direction of travel (M700 12.4.2: side = G code times the sign of the
/// amount).
inline double signed_offset(const Compensation& comp) {
  return comp.side * comp.radius;
}

}  // namespace nc
