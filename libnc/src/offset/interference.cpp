// SPDX-License-Identifier: Apache-2.0
// Interference check and avoidance (M700 12.4.8).
#include "offset/interference.hpp"

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "offset/walls.hpp"

namespace nc {
namespace {

// Blocks between two joints that are compared: of five blocks the joint at the end of the first and that at the end of the fourth are known; an
// interference behind the fourth moving block is not found (M700 12.4.8 "When interference check cannot be executed").
constexpr unsigned kMaxSpan = 3;
// The avoidance joins a block to the next but one or the one behind that, or to the one behind the joints that interfere.
constexpr unsigned kReach = 2;
// Below this the cosine of the angle between two vectors is rounding: at right angles is not "more than 90 degrees".
constexpr double kCosineNoise = 1e-8;
// Directions are one where they differ by less, in rad: lines of half a micrometre have theirs to some 1e-9 of where they lie on the table.
constexpr double kOneDirection = 1e-8;
constexpr double kBackwards_mm = 1e-6;
constexpr double kHalfTurn = kPi + 1e-8;

// Do the vectors a, standing at the origin, and b, standing at d, cross? Touching ends do not, nor do those that touch but for the last digit: at the centre of an arc of the
// tool's radius. They cross in s a = d + t b, s and t compared without a division.
bool vectors_cross(Vec2 a, Vec2 b, Vec2 d, double unsure) {
  const double c = cross(a, b), size = std::abs(c);
  if (c * c <= kOneDirection * kOneDirection * (dot(a, a) * dot(b, b))) return false;
  const double s = std::copysign(1, c) * cross(d, b), t = std::copysign(1, c) * cross(d, a);
  const double near_end = 1e-9 * size;
  if (!(s > near_end && s < size - near_end && t > near_end && t < size - near_end)) return false;
  return (size - s) * norm(a) >= unsure * size || (size - t) * norm(b) >= unsure * size;
}

// An offset curve: a line through `point` along `u`, or a circle about `center`.
struct OffsetCurve {
  bool circle;
  Vec2 point, u, center;
  double radius;
};

OffsetCurve curve_of(const Leg& leg, Vec2 joint, double offset) {
  OffsetCurve curve{};
  curve.circle = leg.curvature != 0;
  curve.u = leg.u;
  curve.point = joint + perpendicular(leg, offset);
  if (curve.circle) {
    curve.center = joint + (1 / leg.curvature) * left_of(leg.u);
    curve.radius = std::abs(1 / leg.curvature - offset);
  }
  return curve;
}

// Two curves that overlap by this, so negative where they are apart: false where they do not meet. Where they touch rounding would decide whether they do, and where.
bool overlaps(double by, double square, double* root) {
  *root = by > kOneLength_mm ? std::sqrt(std::max(square, 0.0)) : 0;
  return by >= -kOneLength_mm;
}

unsigned line_circle(const OffsetCurve& line, const OffsetCurve& circle, Vec2 hit[2]) {
  const Vec2 to_center = circle.center - line.point;
  const double foot = dot(to_center, line.u), away = cross(line.u, to_center);
  double h;
  if (!overlaps(circle.radius - std::abs(away), (circle.radius - away) * (circle.radius + away), &h)) return 0;
  hit[0] = line.point + (foot - h) * line.u;
  hit[1] = line.point + (foot + h) * line.u;
  return 2;
}

unsigned circle_circle(const OffsetCurve& a, const OffsetCurve& b, Vec2 hit[2]) {
  const Vec2 d = b.center - a.center;
  const double distance = norm(d);
  if (distance < kOneLength_mm) return 0;
  const double x = (a.radius * a.radius - b.radius * b.radius + distance * distance) / (2 * distance);
  const double sum = a.radius + b.radius, difference = std::abs(a.radius - b.radius);
  const double outside = sum - distance, inside = distance - difference;
  double h;
  if (!overlaps(std::min(outside, inside), outside * (sum + distance) * inside * (difference + distance) / (4 * distance * distance), &h)) return 0;
  const Vec2 e = (1 / distance) * d;
  hit[0] = a.center + x * e + h * left_of(e);
  hit[1] = a.center + x * e - h * left_of(e);
  return 2;
}

unsigned curves_meet(const OffsetCurve& a, const OffsetCurve& b, Vec2 hit[2]) {
  if (a.circle && b.circle) return circle_circle(a, b, hit);
  if (a.circle) return line_circle(b, a, hit);
  if (b.circle) return line_circle(a, b, hit);
  const double c = cross(a.u, b.u);
  if (std::abs(c) < kOneDirection) return 0;  // parallel walls
  hit[0] = a.point + (cross(b.point - a.point, b.u) / c) * a.u;
  return 1;
}

// How far a point is from the whole of a curve.
double distance_from(const OffsetCurve& curve, Vec2 point) {
  return std::abs(curve.circle ? norm(point - curve.center) - curve.radius : cross(curve.u, point - curve.point));
}

// Where the offset curves of two sections meet that begin and end there, nearest to `middle`; of one that is a point, in the centre of its arc. False: they do not.
bool meeting_of(const Section& before, const Section& behind, Vec2 from_joint, Vec2 middle, Vec2* x) {
  const double unsure = unsure_of(before.inch);
  if (!tool_fits(before.end, before.offset, unsure) || !tool_fits(behind.begin, behind.offset, unsure)) return false;
  const OffsetCurve a = curve_of(before.end, {}, before.offset), b = curve_of(behind.begin, from_joint, behind.offset);
  const bool at_a = is_point(before.end, before.offset, unsure);
  if (at_a || is_point(behind.begin, behind.offset, unsure)) {
    *x = at_a ? a.center : b.center;
    return distance_from(at_a ? b : a, *x) < unsure;
  }
  Vec2 hit[2];
  const unsigned hits = curves_meet(a, b, hit);
  if (hits == 0) return false;
  *x = hits == 2 && norm(hit[1] - middle) < norm(hit[0] - middle) - kOneLength_mm ? hit[1] : hit[0];
  return true;
}

// From the joint of section i to that of section j, programmed.
Vec2 joint_distance(const Chain& chain, unsigned i, unsigned j) {
  Vec2 d;
  for (unsigned k = i + 1; k <= j; ++k) d = d + chain[k].approach + chain[k].delta;
  return d;
}

Vec2 start_vector(const Chain& chain, unsigned i, Vec2 first_vector) {
  return i == 0 ? first_vector : chain[i - 1].joint.v[chain[i - 1].joint.n - 1];
}

// Would a line run backwards between these two vectors? (12.4.8 alarm (2)(a)(ii), (c))
bool runs_backwards(const Section& section, Vec2 from, Vec2 to) {
  if (section.begin.curvature != 0 || section.part) return false;
  return dot(section.delta + to - from, section.begin.u) < -kBackwards_mm;
}

// The same of an arc: its sweep has changed its sign.
bool arc_runs_backwards(const Section& section, Vec2 from, Vec2 to) {
  if (section.begin.curvature == 0 || section.sweep == 0 || is_point(section.begin, section.offset, unsure_of(section.inch))) return false;
  const double sense = section.sweep > 0 ? 1 : -1;
  const Vec2 radius_start = (-sense / std::abs(section.begin.curvature)) * left_of(section.begin.u);
  const Vec2 radius_end = (-sense / std::abs(section.end.curvature)) * left_of(section.end.u);
  const Vec2 now_start = radius_start + from, now_end = radius_end + to;
  if (!longer_than(now_start, kBackwards_mm) || !longer_than(now_end, kBackwards_mm)) return false;  // the tool turns in one place
  // The arc tangent of a number is no more than the number: what turns by less than there is of the arc leaves some of it.
  const double along_start = dot(radius_start, now_start), along_end = dot(radius_end, now_end);
  if (along_start > 0 && along_end > 0 &&
      std::abs(section.sweep) > std::abs(cross(radius_start, now_start)) / along_start + std::abs(cross(radius_end, now_end)) / along_end)
    return false;
  const double sweep = section.sweep + turned(radius_end, now_end, -sense) - turned(radius_start, now_start, sense);
  return sweep * sense * norm(now_start) < -kBackwards_mm;
}

// Where an arc has lost a vector of its own, a line leads between those that are left (12.4.8, the figure's "linear movement"). Not where it would go back, or cut
// into the arc: vectors of lengthened corners inside of an arc lie beyond it. And around more than half a turn it would leave the arc out. The line leaves something of
// the arc uncut, as the avoidance may; without it that is an alarm.
bool line_fits(const Section& section, Vec2 from, Vec2 to) {
  if (std::abs(section.sweep) > kHalfTurn || dot(section.delta + to - from, section.delta) < -kBackwards_mm * norm(section.delta)) return false;
  Piece line;
  line.from = from;
  line.to = section.delta + to;
  return !comes_nearer(line, wall_of(section, {}), std::abs(section.offset) - kEnters_mm);
}

// Can the tool not go along the block between these vectors?
inline bool leads_astray(const Section& section, Vec2 from, Vec2 to) {
  if (section.oblique && section.begin.curvature != 0) return !section.avoid || !line_fits(section, from, to);
  return runs_backwards(section, from, to) || arc_runs_backwards(section, from, to);
}

// Does it begin or end with a vector that is not its own any more?
bool runs_obliquely(const Section& section, bool erased_before) {
  if (!erased_before && !section.joint.first_erased) return false;
  return !section.start && !section.cancel && !section.dead;
}

// The joint at the end of this section leads to the other side.
bool changes_side(const Chain& chain, unsigned i) { return i + 1 < chain.size() && chain[i].offset * chain[i + 1].offset < 0; }

/// Section i, or the one that has taken its place where it is left out already.
unsigned live_at(const Chain& chain, unsigned i) {
  while (i > 0 && chain[i].dead) --i;
  return i;
}

// The way of the block behind section j, which starts at `d`. As long as the joint at its end is not known, it is the way up to an inner corner of a right angle.
// False: there is none to speak of.
bool way_behind(const Chain& chain, unsigned j, Vec2 d, Piece* way) {
  const Section& section = chain[j];
  if (j + 1 >= chain.size() || !section.jointed || section.commanded || section.joint.n == 0) return false;
  const Section& next = chain[j + 1];
  if (next.cancel || next.vanished || next.offset != section.offset) return false;
  const bool known = next.jointed && next.joint.n > 0;
  if (!known && (next.begin.curvature != 0 || norm(next.delta) <= std::abs(next.offset) + kOneLength_mm)) return false;
  const Vec2 leave = known ? next.joint.v[0] : perpendicular(next.end, next.offset) - std::abs(next.offset) * next.end.u;
  *way = path_of(next, d + section.delta + next.approach, section.joint.v[section.joint.n - 1], leave);
  return true;
}

// Does the tool go along the two sections, joined at `x`, without coming nearer than the amount to what is left out between them, or to the other one? Places count
// from the end of section i; `d` is the start of section j.
bool keeps_amount(const Chain& chain, unsigned i, unsigned j, Vec2 d, Vec2 from, Vec2 x, Vec2 leave) {
  const Section& before = chain[i];
  const Section& behind = chain[j];
  const Piece first = path_of(before, -1 * before.delta, from, x), second = path_of(behind, d, x - d, leave);
  const double least = std::abs(before.offset) - kEnters_mm;
  if (comes_nearer(first, wall_of(behind, d), least) || comes_nearer(second, wall_of(before, -1 * before.delta), least)) return false;
  Piece third;
  const bool goes_on = way_behind(chain, j, d, &third);
  Vec2 start;
  for (unsigned k = i + 1; k < j; ++k) {
    const Piece wall = wall_of(chain[k], start + chain[k].approach);
    if (comes_nearer(first, wall, least) || comes_nearer(second, wall, least) || (goes_on && comes_nearer(third, wall, least))) return false;
    start = wall.to;
  }
  return true;
}

// By how much the contour turns to the tool from the end of section i to the start of section j, in rad; away from it negative. Which way a corner turns classify() says, of a cusp, too.
double turn_to_tool(const Chain& chain, unsigned i, unsigned j) {
  double turn = 0;
  for (unsigned k = i; k < j; ++k) {
    const Leg& end = chain[k].end;
    const Leg& begin = chain[k + 1].begin;
    if (k > i) turn += std::copysign(1, chain[i].offset) * chain[k].sweep;
    const Turn corner = classify(end, begin, chain[i].offset);
    const double angle = std::atan2(std::abs(cross(end.u, begin.u)), dot(end.u, begin.u));
    if (corner != Turn::straight) turn += corner == Turn::inner ? angle : -angle;
  }
  return turn;
}

// M700 12.4.8 alarm (2)(c): do the joints of sections i and j belong to a groove whose walls are parallel or go apart towards its bottom? The walls are the blocks in front of the first joint and behind
// the last one, or, where that is its mouth, those between them.
bool walls_do_not_close(const Chain& chain, unsigned i, unsigned j) {
  const double half = kPi - kOneDirection;
  if (j + 1 < chain.size() && turn_to_tool(chain, i, j + 1) >= half) return true;
  return j > i + 1 && turn_to_tool(chain, i + 1, j) >= half;
}

// Could the tool stand somewhere along section k, with the contour from the start of section i to the end of section j around it? Asked at a few places: near its
// ends a block between others is out of reach anyway. Places count from the end of section i.
bool can_be_reached(const Chain& chain, unsigned k, unsigned i, unsigned j) {
  constexpr unsigned kPlaces = 8;
  const double least = std::abs(chain[k].offset) - kEnters_mm;
  const Vec2 start = joint_distance(chain, i, k) - chain[k].delta;
  for (unsigned n = 1; n < kPlaces; ++n) {
    const double share = static_cast<double>(n) / kPlaces;
    Piece tool;
    if (chain[k].begin.curvature != 0) {
      const Vec2 center = start + (1 / chain[k].begin.curvature) * left_of(chain[k].begin.u), spoke = start - center;
      const double c = std::cos(share * chain[k].sweep), s = std::sin(share * chain[k].sweep);
      const Vec2 turned = {c * spoke.h - s * spoke.v, s * spoke.h + c * spoke.v};
      tool.from = center + (1 - chain[k].begin.curvature * chain[k].offset) * turned;
    } else {
      tool.from = start + share * chain[k].delta + perpendicular(chain[k].begin, chain[k].offset);
    }
    tool.to = tool.from;
    bool free = !comes_nearer(tool, wall_of(chain[i], -1 * chain[i].delta), least);
    Vec2 end;
    for (unsigned m = i + 1; m <= j && free; ++m) {
      const Piece wall = wall_of(chain[m], end + chain[m].approach);
      free = !comes_nearer(tool, wall, least);
      end = wall.to;
    }
    if (free) return true;
  }
  return false;
}

// Joins section `i` directly to section `j`; the ones between are left out. Those from `besides` on interfere with nothing: they are only left out where the tool
// could not go along them either. False: no avoidance vector can be made.
bool go_round(Chain* chain, unsigned i, unsigned j, unsigned besides, Vec2 first_vector) {
  Section& before = (*chain)[i];
  const Section& behind = (*chain)[j];
  if (before.start || before.dead || before.vanished || behind.dead || behind.vanished || behind.cancel) return false;
  for (unsigned k = i; k < j; ++k)
    if ((*chain)[k].commanded) return false;  // 12.4.3 precaution (2): never erased
  const Vec2 d = joint_distance(*chain, i, j - 1) + behind.approach;
  Vec2 x;
  if (!meeting_of(before, behind, d, 0.5 * d, &x)) return false;
  // Blocks that run all but back beside each other meet far from both: no avoidance vector (12.4.8 alarm (2)(b)).
  if (norm(x) > kExtremelyLarge * std::abs(before.offset) + norm(d) + kOneLength_mm) return false;
  const Vec2 from = start_vector(*chain, i, first_vector), leave = behind.jointed ? behind.joint.v[0] : perpendicular(behind.end, behind.offset);
  if (runs_backwards(before, from, x) || arc_runs_backwards(before, from, x)) return false;
  if (runs_backwards(behind, x - d, leave) || arc_runs_backwards(behind, x - d, leave)) return false;
  for (unsigned k = besides; k < j; ++k)
    if (!(*chain)[k].dead && can_be_reached(*chain, k, i, j)) return false;
  if (!keeps_amount(*chain, i, j, d, from, x, leave)) return false;  // a rib that stands between them, or a circle that runs on through a wall
  chain->note_compared(0);  // joints have changed
  chain->note_left_out();
  before.joint = ContourJoint::single(x);
  for (unsigned k = i + 1; k < j; ++k) {
    (*chain)[k].joint = ContourJoint::single(x - joint_distance(*chain, i, k));
    (*chain)[k].jointed = true;
    (*chain)[k].dead = (*chain)[k].bound = true;
    (*chain)[k].vanished = false;
  }
  return true;
}

// Erases the vectors from `keep_before` on at the end of section i and up to `last_erased` at the end of
// section j.
void erase_vectors(ContourJoint* before, unsigned keep_before, ContourJoint* behind, unsigned last_erased) {
  before->last_erased = before->last_erased || keep_before < before->n;
  behind->first_erased = true;
  before->n = static_cast<uint8_t>(keep_before);
  unsigned n = 0;
  for (unsigned k = last_erased + 1; k < behind->n; ++k) behind->v[n++] = behind->v[k];
  behind->n = static_cast<uint8_t>(n);
  before->lengthened = behind->lengthened = before->corner_arc = behind->corner_arc = false;
}

struct Crossing {
  bool found = false;
  unsigned before = 0, behind = 0;
};

// From the outermost vectors inwards: (1)-(4)', (2)-(3)', (3)-(2)', (4)-(1)'. `walls_only`: just those that stand on the blocks between the two
// joints. Of a groove with several blocks these tell whether the tool fits between its walls; the tips of lengthened corners may cross outside of it.
Crossing find_crossing(const ContourJoint& before, const ContourJoint& behind, Vec2 d, double unsure, bool walls_only) {
  const unsigned steps = before.n > behind.n ? before.n : behind.n;
  for (unsigned k = walls_only ? steps - 1 : 0; k < steps; ++k) {
    const unsigned i = k < before.n ? k : before.n - 1u;
    const unsigned j = k < behind.n ? behind.n - 1u - k : 0u;
    if (vectors_cross(before.v[i], behind.v[j], d, unsure)) return {true, i, j};
  }
  return {};
}

// The square of the longest vector of a joint.
double longest_square(const ContourJoint& joint) {
  double most = dot(joint.v[0], joint.v[0]);
  for (unsigned k = 1; k < joint.n; ++k) most = std::max(most, dot(joint.v[k], joint.v[k]));
  return most;
}

// Are two joints so far apart that none of their vectors can cross? Vectors that do are together at least as long as that: |d|^2 <= (|a| + |b|)^2 <=
// 2 (|a|^2 + |b|^2). The rest is room for rounding: vectors_cross() takes angles down to 1e-12, where it may be off by some 1e-4 of these lengths, and
// the distance is a sum of coordinates, which are exact to far less than a nanometre.
bool too_far_to_cross(double longest_before, double longest_behind, Vec2 d) { return dot(d, d) > 2.2 * (longest_before + longest_behind) + 1e-12; }

// Does the contour turn to the tool behind section i? Straight on is no turn, and of a cusp the curvatures tell.
bool turns_to(const Chain& chain, unsigned i) { return classify(chain[i].end, chain[i + 1].begin, chain[i].offset) == Turn::inner; }

// Do the blocks between the joints of sections i and j, all of them walls on one side, come back towards the tool: at a corner, or along an arc? Not where the program
// gives a vector, which may lie anywhere (12.4.3).
bool comes_back(const Chain& chain, unsigned i, unsigned j) {
  if (chain[i].dead || chain[i].vanished || chain[i].commanded || changes_side(chain, i)) return false;
  bool back = false;
  for (unsigned k = i + 1; k <= j; ++k) {
    const Section& section = chain[k];
    if (section.dead || section.vanished || section.commanded || !is_wall(section) || changes_side(chain, k)) return false;
    back = back || (k < j && turns_to(chain, k)) || section.begin.curvature * section.offset > 0;
  }
  return back;
}

// Of a lengthened corner the vectors at right angles to its lines are passed, and not gone to where the lines are short (OffsetStage::release()).
unsigned first_driven(const Section& section, Vec2 start) { return section.joint.lengthened && section.merge_first && runs_beside(section, start) ? 1 : 0; }
unsigned last_driven(const Section& section) { return section.joint.n - (section.joint.lengthened && section.merge_last ? 2u : 1u); }

// The way along section k, which starts at `start`, between the corners at its two ends.
Piece driven_path(const Chain& chain, unsigned k, Vec2 start) {
  const Section& section = chain[k];
  const Vec2 last = start_vector(chain, k, {});
  return path_of(section, start, chain[k - 1].joint.v[last_driven(chain[k - 1])], section.joint.v[first_driven(section, last)]);
}

// A joint and its place.
struct PlacedJoint {
  const ContourJoint& joint;
  Vec2 at;
};

// Could the tool, at two joints or on its way between them, come to the line that ends at `end`?
bool in_reach(const Section& line, Vec2 end, PlacedJoint first, PlacedJoint last) {
  const Vec2 u = line.begin.u;
  const double most = std::abs(line.offset) + kOneLength_mm;
  const auto beyond = [](const ContourJoint& joint, Vec2 way, double far) {
    unsigned n = 0;
    while (n < joint.n && dot(way, joint.v[n]) > far) ++n;
    return n == joint.n;
  };
  const auto all_beyond = [&](Vec2 way, double far) { return beyond(first.joint, way, far + dot(way, end - first.at)) && beyond(last.joint, way, far + dot(way, end - last.at)); };
  return !(all_beyond(-u, dot(u, line.delta) + most) || all_beyond(u, most) || all_beyond(left_of(u), most) || all_beyond(-left_of(u), most));
}

// The same of two blocks that may bend, whose middles are so far apart: what turns by no more than half a circle lies within that of its chord.
bool in_reach(const Section& a, const Section& b, Vec2 apart, double longest) {
  if (std::abs(a.sweep) > kPi || std::abs(b.sweep) > kPi) return true;
  return norm(apart) <= 0.5 * (norm(a.delta) + norm(b.delta)) + std::sqrt(longest) + std::abs(a.offset) + kOneLength_mm;
}

// Three blocks between two joints, at one of which the contour does not turn to the tool, and the tool there, or along the wall at it, could come to the wall on the other
// side. `d` leads from the one to the other, and the squares are those of the longest vectors at the two.
bool may_have_mouth(const Chain& chain, unsigned i, unsigned j, Vec2 d, double longest_before, double longest_behind) {
  if (j + 1 >= chain.size()) return false;
  const Section& into = chain[i + 1];
  const Section& out = chain[j];
  const Vec2 foot = into.approach + into.delta;
  if (into.begin.curvature == 0 && out.begin.curvature == 0)
    return (in_reach(out, d, {chain[i].joint, {}}, {into.joint, foot}) && !turns_to(chain, i)) || (in_reach(into, foot, {chain[j - 1].joint, d - out.delta - out.approach}, {out.joint, d}) && !turns_to(chain, j));
  const Vec2 apart = d - 0.5 * out.delta - foot + 0.5 * into.delta;
  return in_reach(into, out, apart, std::max(longest_before, longest_behind)) && (!turns_to(chain, i) || !turns_to(chain, j));
}

// Is the mouth of a groove of three blocks narrower than the tool? The vectors on its walls tell where the walls are about parallel. Where they go apart below
// the mouth these vectors point down and need not cross, nor do they where one wall is lower than the tool; so here it is asked whether the tool, at the corner on one
// side of the mouth and along the wall below, comes nearer than the amount to the wall on the other side. Where the contour closes they may be ways in and out.
bool mouth_too_narrow(const Chain& chain, unsigned i, unsigned j, Vec2 first_vector) {
  if (!comes_back(chain, i, j)) return false;
  const bool in_front = !turns_to(chain, i), behind = !turns_to(chain, j);
  const Vec2 d = joint_distance(chain, i, j);
  const Section& into = chain[i + 1];
  const Section& out = chain[j];
  if (!on_one_level(into, out)) return false;
  const Piece first = wall_of(into, into.approach), last = wall_of(out, d - out.delta);
  const double least = std::min({std::abs(chain[i].offset), std::abs(into.offset), std::abs(out.offset)}) - enters_of(into.inch) - slop_of(first) - slop_of(last);  // at the first joint that of the block in front
  const auto enters = [&](unsigned k, Vec2 at, const Piece& wall) {
    const ContourJoint& joint = chain[k].joint;
    for (unsigned n = first_driven(chain[k], start_vector(chain, k, first_vector)); n < last_driven(chain[k]); ++n)
      if (comes_nearer(way_at(at, joint.v[n], joint.v[n + 1], joint.corner_arc, into.offset), wall, least)) return true;
    return false;
  };
  const bool into_last = in_front && (enters(i, {}, last) || comes_nearer(driven_path(chain, i + 1, first.from), last, least));
  const bool into_first = behind && !into_last && (enters(j, d, first) || comes_nearer(driven_path(chain, j, last.from), first, least));
  return (into_last || into_first) && !closes(chain, i, chain.size() - 1);
}

// Does the tool stay in one place between the joints of sections i and j, as far as the last digit tells? That is so where nothing but points is left of arcs, and of lines
// between them that lead from one to the other.
bool stays_in_place(const Chain& chain, unsigned i, unsigned j) {
  const double unsure = unsure_of(chain[j].inch);
  const auto point = [&](unsigned k) { return is_point(chain[k].begin, chain[k].offset, unsure) && is_point(chain[k].end, chain[k].offset, unsure); };
  for (unsigned k = i + 1; k <= j; ++k) {
    if (point(k)) continue;
    const Section& line = chain[k];
    if (line.begin.curvature != 0 || !point(k - 1) || k + 1 >= chain.size() || !point(k + 1) || chain[k - 1].joint.n == 0 || line.joint.n == 0) return false;
    const Vec2 way = line.delta + line.joint.v[0] - start_vector(chain, k, {});
    if (norm(way) >= 2 * unsure) return false;  // each of the two places is known to one
  }
  return true;
}

// Do the joints of sections i and j lie at one place, as far as the last digit tells, since the contour has closed between them? Vectors of one place do not cross.
bool has_closed(const Chain& chain, unsigned i, unsigned j, Vec2 d) {
  if (j < i + 2 || norm(d) > enters_of(chain[j].inch)) return false;
  Vec2 at;
  bool away = false;
  for (unsigned k = i + 1; k < j; ++k) {
    at = at + chain[k].approach + chain[k].delta;
    away = away || norm(at) > kAway_mm;
  }
  return away;
}

// Checks the joint of section i against that of j. `live` is i, or where i is left out already the section
// that has taken its place. `*crosses`: they do not go as they were.
Finding check_pair(Chain* chain, unsigned live, unsigned i, unsigned j, bool may_wait, Vec2 first_vector,
                   unsigned* at, bool* crosses) {
  Section& before = (*chain)[i];
  Section& behind = (*chain)[j];
  const Vec2 d = joint_distance(*chain, i, j);
  const Crossing crossing = find_crossing(before.joint, behind.joint, d, unsure_of(before.inch), j - i == kMaxSpan);
  if (!crossing.found || has_closed(*chain, i, j, d) || (j == i + 1 && behind.part) || stays_in_place(*chain, i, j)) return Finding::none;
  *crosses = true;
  *at = live;
  const Vec2 a = before.joint.v[crossing.before], b = behind.joint.v[crossing.behind];
  const ContourJoint whole_before = before.joint;
  const ContourJoint whole_behind = behind.joint;
  erase_vectors(&before.joint, crossing.before, &behind.joint, crossing.behind);
  chain->note_compared(0);
  chain->note_change();
  for (unsigned k = i + 1; k <= j; ++k) (*chain)[k].bound = true;
  // What remains is the path, but for a change of side: without a vector of it a block would begin or end on the side of the other.
  if (before.joint.n > 0 && behind.joint.n > 0 && j == i + 1 && !changes_side(*chain, i) && !changes_side(*chain, j)) {
    behind.oblique = runs_obliquely(behind, before.joint.last_erased);
    if (!leads_astray(behind, before.joint.v[before.joint.n - 1], behind.joint.v[0])) return Finding::none;
    *at = j;
    return Finding::alarm;
  }
  const bool one_sided = behind.joint.n > 0 && whole_behind.n > 1;
  before.joint = whole_before;
  behind.joint = whole_behind;
  if (!before.avoid) return Finding::alarm;  // 12.4.8 alarm (1)
  // Avoidance: with valid vectors left on one side only it is an alarm (2)(a), with vectors at more than 90 degrees (2)(b), between parallel or widening walls (2)(c).
  if (one_sided || dot(a, b) < -kCosineNoise * norm(a) * norm(b) || walls_do_not_close(*chain, i, j)) return Finding::alarm;
  const unsigned farthest = std::max(live + 1 + kReach, j + 1);
  for (unsigned target = j + 1; target <= farthest && target < chain->size(); ++target) {
    if (go_round(chain, live, target, j + 1, first_vector)) return Finding::none;
  }
  return may_wait && chain->size() <= farthest ? Finding::none : Finding::alarm;
}

bool may_be_erased(const Section& section) {
  return section.check && section.jointed && !section.commanded && !section.vanished && section.joint.n > 0;
}

// An arc that has no offset circle at all can only be left out.
Finding leave_out_vanished(Chain* chain, unsigned last_call, Vec2 first_vector, unsigned* at) {
  for (unsigned i = 1; i < chain->size(); ++i) {
    if (!(*chain)[i].vanished) continue;
    *at = i;
    bool done = false;
    if (walls_do_not_close(*chain, i - 1, i)) return Finding::alarm;
    for (unsigned target = i + 1; target <= i + kReach && target < chain->size() && !done; ++target) {
      done = go_round(chain, live_at(*chain, i - 1), target, i + 1, first_vector);
    }
    if (!done && (i < last_call || chain->size() > i + kReach || (*chain)[chain->size() - 1].cancel))
      return Finding::alarm;
  }
  return Finding::none;
}

// "When interference check cannot be executed (1)" (M700 12.4.8): fewer than three of the five blocks that are read from the one in front of this section on move.
bool too_few_move(const Chain& chain, unsigned i, const ChainStart& start) {
  return i + 1 < chain.size() && chain[i + 1].block - (i == 0 ? start.block : chain[i - 1].block) >= kPreRead;
}

// M700 12.4.8 alarm (2)(c): a block that runs against its programmed direction between its vectors. The vectors of short blocks need not cross
// for that.
Finding check_direction(Chain* chain, unsigned i, const ChainStart& start, unsigned* at) {
  Section& section = (*chain)[i];
  const bool along_contour = !section.start && !section.cancel && !section.dead && !section.vanished && section.jointed && section.joint.n > 0;
  if (!along_contour || !section.check) return Finding::none;
  const Vec2 from = start_vector(*chain, i, start.vector), to = section.joint.v[0];
  const bool given = section.commanded || (i == 0 ? start.commanded : !may_be_erased((*chain)[i - 1]));
  if (given || too_few_move(*chain, i, start)) {  // such a vector may lie anywhere; but no arc turns the other way round for it
    *at = i;
    return arc_runs_backwards(section, from, to) ? Finding::alarm : Finding::none;
  }
  if (!leads_astray(section, from, to) || (i > 0 && stays_in_place(*chain, i - 1, i))) return Finding::none;
  *at = i;
  if (!section.avoid || i == 0 || walls_do_not_close(*chain, i - 1, i)) return Finding::alarm;
  for (unsigned target = i + 1; target <= i + kReach && target < chain->size(); ++target)
    if (go_round(chain, live_at(*chain, i - 1), target, i + 1, start.vector)) return Finding::none;
  return Finding::alarm;
}

// Do the ways along section i and the block in front of it, and round the corners at its two ends, keep the amount to these blocks and to the one behind? Places
// count from its start.
bool ways_keep_amount(const Chain& chain, unsigned i, Vec2 first_vector) {
  const Section& section = chain[i];
  const double least = std::abs(section.offset) - kEnters_mm;
  Piece walls[3], ways[2 * ContourJoint::kMax];
  unsigned of_walls = 0, of_ways = 0;
  const auto along = [&](unsigned k, Vec2 start) {
    walls[of_walls++] = wall_of(chain[k], start);
    ways[of_ways++] = path_of(chain[k], start, start_vector(chain, k, first_vector), chain[k].joint.v[0]);
    const ContourJoint& joint = chain[k].joint;
    for (unsigned n = 0; n + 1 < joint.n; ++n) ways[of_ways++] = way_at(start + chain[k].delta, joint.v[n], joint.v[n + 1], false, section.offset);
  };
  if (i > 0 && !chain[i - 1].start) along(i - 1, -1 * chain[i - 1].delta);
  along(i, {});
  if (i + 1 < chain.size() && !chain[i + 1].cancel) walls[of_walls++] = wall_of(chain[i + 1], section.delta);
  for (unsigned n = 0; n < of_ways; ++n)
    for (unsigned k = 0; k < of_walls; ++k)
      if (comes_nearer(ways[n], walls[k], least)) return false;
  return true;
}

// The first and the last vector of a lengthened corner stand at right angles to lines, which pass them on the way to the others (OffsetStage::release()). A line that is
// shorter than that, since it leads to an inner corner or comes from one, does not come there, and a vector that the tool does not reach tells nothing: what is
// compared is where the tool leaves the line, or comes to it. Not where the ways themselves cut into these blocks: then the vectors that cross are right.
void keep_to_the_way(Chain* chain, unsigned i, Vec2 first_vector) {
  Section& section = (*chain)[i];
  if (section.begin.curvature != 0 || section.commanded || section.dead || section.joint.n == 0) return;
  const Vec2 u = section.begin.u;
  if (ContourJoint* before = i == 0 ? nullptr : &(*chain)[i - 1].joint; before != nullptr && before->lengthened && (*chain)[i - 1].merge_last) {
    const Vec2 end = section.delta + section.joint.v[0], last = before->v[before->n - 1], outer = before->v[before->n - 2];
    const bool short_of_it = runs_beside(section, section.joint.v[0]) && dot(end - last, u) < 0 && dot(end - outer, u) >= -kOneLength_mm;
    if (short_of_it) {
      before->v[before->n - 1] = end;
      if (!ways_keep_amount(*chain, i, first_vector)) before->v[before->n - 1] = last;
    }
  }
  if (section.joint.lengthened && section.merge_first) {
    const Vec2 start = start_vector(*chain, i, first_vector), first = section.joint.v[0], outer = section.joint.v[1];
    const bool behind_it = runs_beside(section, start) && dot(section.delta + first - start, u) < 0 && dot(section.delta + outer - start, u) >= -kOneLength_mm;
    if (behind_it) {
      section.joint.v[0] = start - section.delta;
      if (!ways_keep_amount(*chain, i, first_vector)) section.joint.v[0] = first;
    }
  }
}

// Vectors have been erased, and others held: what goes by them.
void follow_changes(Chain* chain, const ChainStart& start) {
  bool erased_before = start.erased;
  for (unsigned i = 0; i < chain->size(); ++i) {
    Section& section = (*chain)[i];
    if (section.holds && i > 0) section.joint.set(start_vector(*chain, i, start.vector));  // the vector that is held may have been changed
    section.oblique = runs_obliquely(section, erased_before);
    erased_before = section.joint.last_erased;
  }
}

}  // namespace

Finding check_interference(Chain* chain, unsigned last_call, const ChainStart& start, unsigned* at) {
  const Vec2 first_vector = start.vector;
  if (chain->may_have_vanished() && leave_out_vanished(chain, last_call, first_vector, at) == Finding::alarm) return Finding::alarm;
  bool apart = true;
  unsigned j = std::max(chain->compared(), 1u);
  for (; j < chain->size() && (*chain)[j].jointed; ++j) {
    const Section& section = (*chain)[j];
    if (section.joint.lengthened || (*chain)[j - 1].joint.lengthened) {
      if (j == 1) keep_to_the_way(chain, 0, first_vector);
      keep_to_the_way(chain, j, first_vector);
    }
    if (!may_be_erased(section) || section.dead) continue;
    bool crosses = false;
    Vec2 d;  // from the joint that it is compared with
    const double longest = longest_square(section.joint);
    const Section* next = &section;
    for (unsigned span = 1; span <= kMaxSpan && span <= j; ++span) {
      const unsigned i = j - span;
      const Section& behind = *next;
      next = &(*chain)[i];
      d = d + behind.approach + behind.delta;
      const double longest_before = longest_square(next->joint);
      const bool far = !crosses && too_far_to_cross(longest_before, longest, d);
      const bool mouth = span == kMaxSpan && may_have_mouth(*chain, i, j, d, longest_before, longest);
      if (far && !mouth) continue;
      if (span > 1 && behind.dead) continue;  // seen from the section left out already
      const unsigned live = live_at(*chain, i);
      if (!may_be_erased((*chain)[i]) || !may_be_erased((*chain)[live]) || (*chain)[live].dead) continue;
      const bool may_wait = live >= last_call;
      bool pair_crosses = false;
      if (!far && check_pair(chain, live, i, j, may_wait, first_vector, at, &pair_crosses) == Finding::alarm) return Finding::alarm;
      crosses = crosses || pair_crosses;
      if (section.dead) break;
      if (mouth && !pair_crosses && mouth_too_narrow(*chain, i, j, first_vector)) {
        *at = live;
        return Finding::alarm;
      }
    }
    if (crosses) apart = false;
  }
  chain->note_compared(apart ? j : 0);
  if (start.erased || chain->may_have_changed()) follow_changes(chain, start);
  for (unsigned i = 0; i < last_call && i < chain->size(); ++i)  // as late as can be: those behind may have changed its end
    if (check_direction(chain, i, start, at) == Finding::alarm) return Finding::alarm;
  return Finding::none;
}

}  // namespace nc
