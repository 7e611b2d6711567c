// SPDX-License-Identifier: Apache-2.0
#include "offset/walls.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "base/same_place.hpp"
#include "base/units.hpp"

namespace nc {
namespace {

constexpr double kFull = 2 * kPi;
constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Radii that differ by less count as one.
constexpr double kOneRadius_mm = 1e-4;
/// So do amounts.
constexpr double kOneAmount_mm = 1e-4;
/// Blocks that are programmed twice differ by the last digits of their words, in inch 2.54 um.
constexpr double kOneBlock_mm = 2.54 * kCloses_mm;
/// Vectors whose lengths differ by less end on one circle about the corner.
constexpr double kBends_mm = 1e-6;
/// A way that leads from the lengthened wall by no more than this sine leads straight on along it: a hundredth is more than what the three digits of its words make of it, and of a tangent.
constexpr double kStraightOn = 0.01;
/// Straight on the tool sinks beside the wall at the angle whose tangent is the radius over the way. A way of the tool's diameter takes 0.11 R of the wall's end and 0.24 R of its length, one of the radius
/// 0.29 R and 0.41 R: from there on it leads into the wall rather than along it.
constexpr double kStraightRadii = 2;
double mean_radius(const Piece& arc) { return 0.5 * (arc.radius + arc.radius_end); }

/// The ray from the centre to this point goes through the arc.
bool faces(const Piece& arc, Vec2 point) {
  const double sweep = std::abs(arc.sweep);
  if (sweep >= kFull) return true;
  const Vec2 p = point - arc.center;
  const Vec2 a = (arc.sweep >= 0 ? arc.from : arc.to) - arc.center, b = (arc.sweep >= 0 ? arc.to : arc.from) - arc.center;  // counter-clockwise from a to b
  if (sweep <= kPi) return cross(a, p) >= 0 && cross(p, b) >= 0 && (sweep > 1 || dot(p, a) >= 0);
  return !(cross(b, p) > 0 && cross(p, a) > 0);
}

/// Distance from the inside of the line, its ends aside.
double to_line(const Piece& line, Vec2 point) {
  const Vec2 way = line.to - line.from;
  const double squares = dot(way, way), foot = dot(point - line.from, way);
  if (!(squares > 0) || foot < 0 || foot > squares) return kInfinite;
  return std::abs(cross(way, point - line.from)) / std::sqrt(squares);
}

double to_inside(const Piece& piece, Vec2 point) {
  if (!piece.round) return to_line(piece, point);
  return faces(piece, point) ? std::abs(norm(point - piece.center) - mean_radius(piece)) : kInfinite;
}

bool lines_cross(const Piece& a, const Piece& b) {
  const Vec2 u = a.to - a.from, w = b.to - b.from, d = b.from - a.from;
  const double c = cross(u, w);
  if (c == 0) return false;
  const double s = cross(d, w) / c, t = cross(d, u) / c;
  return s >= 0 && s <= 1 && t >= 0 && t <= 1;
}

/// Where two curves cross: up to two places.
template <class Place>
struct Crossings {
  Place at[2] = {Place{}, Place{}};
  unsigned count = 0;
  const Place* begin() const { return at; }
  const Place* end() const { return at + count; }
};

/// Where the line from `from` along the unit vector `u` crosses a circle: lengths from `from`.
Crossings<double> line_crosses_circle(Vec2 from, Vec2 u, Vec2 center, double radius) {
  const double foot = dot(center - from, u), away = cross(u, center - from), squares = radius * radius - away * away;
  if (squares < 0) return {};
  const double half = std::sqrt(squares);
  return {{foot - half, foot + half}, 2};
}

/// Where two circles cross, as vectors from the centre of the first one. Circles about one centre cross nowhere.
Crossings<Vec2> circles_cross(Vec2 center, double radius, Vec2 other_center, double other_radius) {
  const Vec2 beside = other_center - center;
  const double apart = norm(beside);
  if (!(apart > kNoLength)) return {};
  const Vec2 e = (1 / apart) * beside;
  const double along = (radius * radius - other_radius * other_radius + apart * apart) / (2 * apart), squares = radius * radius - along * along;
  if (squares < 0) return {};
  const Vec2 across = std::sqrt(squares) * left_of(e);
  return {{along * e - across, along * e + across}, 2};
}

/// Where the line passes the centre nearest, and where it crosses the circle.
double line_to_arc(const Piece& line, const Piece& arc) {
  const Vec2 way = line.to - line.from;
  const double length = norm(way), radius = mean_radius(arc);
  double best = kInfinite;
  if (!(length > kNoLength)) return best;
  const Vec2 u = (1 / length) * way;
  const double foot = dot(arc.center - line.from, u);
  if (foot >= 0 && foot <= length) {
    const Vec2 nearest = line.from + foot * u;
    if (faces(arc, nearest)) best = std::abs(norm(nearest - arc.center) - radius);
  }
  for (const double t : line_crosses_circle(line.from, u, arc.center, radius))
    if (t >= 0 && t <= length && faces(arc, line.from + t * u)) return 0;
  return best;
}

double arc_to_arc(const Piece& a, const Piece& b) {
  const Vec2 d = b.center - a.center;
  const double apart = norm(d), ra = mean_radius(a), rb = mean_radius(b);
  if (!(apart > kNoLength)) {  // about one centre: side by side where they face each other
    return faces(a, b.from) || faces(a, b.to) || faces(b, a.from) ? std::abs(ra - rb) : kInfinite;
  }
  const Vec2 e = (1 / apart) * d;
  double best = kInfinite;
  for (const double s : {1.0, -1.0})
    for (const double t : {1.0, -1.0}) {
      const Vec2 p = a.center + s * ra * e, q = b.center + t * rb * e;
      if (faces(a, p) && faces(b, q)) best = std::min(best, norm(p - q));
    }
  for (const Vec2 way : circles_cross(a.center, ra, b.center, rb)) {
    const Vec2 hit = a.center + way;
    if (faces(a, hit) && faces(b, hit)) return 0;
  }
  return best;
}

void arc_of(const Section& section, Vec2 start, Piece* piece) {
  piece->round = true;
  piece->center = start + (1 / section.begin.curvature) * left_of(section.begin.u);
  piece->radius = std::abs(1 / section.begin.curvature);
  piece->radius_end = std::abs(1 / section.end.curvature);
  piece->sweep = section.sweep;
}

/// The direction of travel at one of its ends.
Vec2 tangent(const Piece& wall, Vec2 end) { return wall.round ? std::copysign(1.0, wall.sweep) * left_of(unit(end - wall.center)) : unit(wall.to - wall.from); }

/// The sine by which a direction at one of its ends may be off.
double unsure_direction(const Piece& wall) { return kStraightOn + kLastDigit_mm / (wall.round ? mean_radius(wall) : norm(wall.to - wall.from)); }

// Straight on along the wall, beyond its end, the manual's own ways lead (12.4.1): what they cut of the end is theirs.
bool leads_straight_on(Vec2 far, const Piece& wall, Vec2 end) {
  const double straight_on = unsure_direction(wall);
  const Vec2 beyond = norm(end - wall.to) <= norm(end - wall.from) ? tangent(wall, end) : -1.0 * tangent(wall, end);
  return dot(far, beyond) > 0 && std::abs(dot(far, left_of(beyond))) <= straight_on * norm(far);
}

bool cuts_end(const WayPast& way, const Piece& wall, Vec2 end) {
  const Vec2 beside = way.comes ? way.path.to : way.path.from, far = (way.comes ? way.path.from : way.path.to) - end;
  const double amount = std::min(way.amount, norm(beside - end)), least = amount - way.margin;
  if (std::min({to_inside(way.path, end), norm(way.path.from - end), norm(way.path.to - end)}) >= least) return false;
  // Straight on it is the manual's own way. But one that leads away from the end of another wall, along the line of this one, cuts nothing of it and is no such way.
  return !leads_straight_on(far, wall, end) || norm(far) < kStraightRadii * amount - way.margin;
}

/// How far its points may lie beside the arc of its mean radius.
double slack(const Piece& piece) { return piece.round ? 0.5 * std::abs(piece.radius - piece.radius_end) : 0; }

/// The point of a piece so far along it, 0 its start and 1 its end.
Vec2 point_at(const Piece& piece, double part) {
  if (part <= 0 || part >= 1) return part <= 0 ? piece.from : piece.to;
  if (!piece.round) return piece.from + part * (piece.to - piece.from);
  const double c = std::cos(part * piece.sweep), s = std::sin(part * piece.sweep), radius = piece.radius + part * (piece.radius_end - piece.radius);
  const Vec2 out = unit(piece.from - piece.center);
  return piece.center + radius * Vec2{c * out.h - s * out.v, s * out.h + c * out.v};
}

/// The two halves of a line or of an arc.
void halve(const Piece& piece, Piece half[2]) {
  half[0] = without_stretch(piece, false, 0.5);
  half[1] = without_stretch(piece, true, 0.5);
}

/// Places along a piece, as parts of it.
struct Places {
  double part[8];
  unsigned count = 0;
  void add(double at) {
    if (at > 0 && at < 1 && count < sizeof part / sizeof part[0]) part[count++] = at;
  }
};

/// Where an arc, as the circle of its mean radius, is in this direction from its centre.
void add_direction(const Piece& arc, Vec2 way, Places* places) {
  if (arc.sweep == 0) return;
  const double ahead = turned(arc.from - arc.center, way, arc.sweep);
  places->add((ahead * arc.sweep < 0 ? ahead + std::copysign(kFull, arc.sweep) : ahead) / arc.sweep);
}

void add_circle(const Piece& piece, Vec2 center, double radius, Places* places) {
  if (piece.round) {
    for (const Vec2 way : circles_cross(piece.center, mean_radius(piece), center, radius)) add_direction(piece, way, places);
    return;
  }
  const Vec2 way = piece.to - piece.from;
  const double length = norm(way);
  if (!(length > 0)) return;
  for (const double along : line_crosses_circle(piece.from, (1 / length) * way, center, radius)) places->add(along / length);
}

void add_line(const Piece& piece, Vec2 point, Vec2 u, Places* places) {
  if (piece.round) {
    for (const double along : line_crosses_circle(point, u, piece.center, mean_radius(piece))) add_direction(piece, point + along * u - piece.center, places);
    return;
  }
  const double across = cross(piece.to - piece.from, u);
  if (across != 0) places->add(cross(point - piece.from, u) / across);
}

/// All that is as near to a piece as `clear` ends on a circle about one of its ends, or on a curve beside it. Between two places in which a line or an arc passes one of these it is either
/// near or farther away throughout, so the first farther one between two such places is the end of the stretch.
double circular_stretch(const Piece& piece, bool from_start, const Piece& other, double clear) {
  Places places;
  add_circle(piece, other.from, clear, &places);
  add_circle(piece, other.to, clear, &places);
  if (other.round) {
    add_circle(piece, other.center, mean_radius(other) + clear, &places);
    if (mean_radius(other) > clear) add_circle(piece, other.center, mean_radius(other) - clear, &places);
  } else if (norm(other.to - other.from) > kNoLength) {
    const Vec2 u = unit(other.to - other.from);
    for (const double side : {-1.0, 1.0}) add_line(piece, other.from + side * clear * left_of(u), u, &places);
  }
  if (!from_start)
    for (unsigned i = 0; i < places.count; ++i) places.part[i] = 1 - places.part[i];
  std::sort(places.part, places.part + places.count);
  double begins = 0;
  for (unsigned i = 0; i <= places.count; ++i) {
    const double ends = i < places.count ? places.part[i] : 1, between = 0.5 * (begins + ends);
    Piece place;
    place.from = place.to = point_at(piece, from_start ? between : 1 - between);
    if (distance(place, other) > clear) return begins;
    begins = ends;
  }
  return 1;
}

}  // namespace

Piece wall_of(const Section& section, Vec2 start) {
  Piece wall;
  wall.from = start;
  wall.to = start + section.delta;
  if (section.begin.curvature != 0) arc_of(section, start, &wall);
  return wall;
}

Piece path_of(const Section& section, Vec2 start, Vec2 from, Vec2 to) {
  Piece path;
  path.from = start + from;
  path.to = start + section.delta + to;
  if (section.begin.curvature == 0 || section.dead || section.oblique || is_point(section.begin, section.offset, unsure_of(section.inch))) return path;
  arc_of(section, start, &path);
  const Vec2 center = path.center;
  path.radius = norm(path.from - center);
  path.radius_end = norm(path.to - center);
  if (!(path.radius > kNoLength) || !(path.radius_end > kNoLength)) {  // the tool turns in one place, or comes to the centre
    path.round = false;
    return path;
  }
  path.sweep += turned(start + section.delta - center, path.to - center, -path.sweep) - turned(start - center, path.from - center, path.sweep);
  return path;
}

bool bendable(Vec2 from, Vec2 to) { return norm(from) > kNoLength && std::abs(norm(from) - norm(to)) < kBends_mm && norm(to - from) > kNoLength; }

double corner_sweep(Vec2 from, Vec2 to, double offset) {
  return turned(from, to, offset > 0 ? -1 : 1);
}

Piece arc_about(Vec2 center, Vec2 from, Vec2 to, double offset) {
  Piece arc;
  arc.from = center + from;
  arc.to = center + to;
  arc.round = true;
  arc.center = center;
  arc.radius = norm(from);
  arc.radius_end = norm(to);
  arc.sweep = corner_sweep(from, to, offset);
  return arc;
}

Piece way_at(Vec2 point, Vec2 from, Vec2 to, bool bends, double offset) {
  if (bends && bendable(from, to)) return arc_about(point, from, to, offset);
  Piece line;
  line.from = point + from;
  line.to = point + to;
  return line;
}

Box box_of(const Piece& piece) {
  Box box;
  box.take(piece.from);
  box.take(piece.to);
  if (!piece.round) return box;
  const double radius = std::max(piece.radius, piece.radius_end);
  for (const Vec2 way : {Vec2{1, 0}, Vec2{-1, 0}, Vec2{0, 1}, Vec2{0, -1}}) {
    const Vec2 point = piece.center + radius * way;
    if (faces(piece, point)) box.take(point);
  }
  return box;
}

double distance(const Piece& path, const Piece& wall, OpenEnds open) {
  double best = std::min(to_inside(wall, path.from), to_inside(wall, path.to));
  for (const Vec2 end : {path.from, path.to}) {
    if (!open.from) best = std::min(best, norm(end - wall.from));
    if (!open.to) best = std::min(best, norm(end - wall.to));
  }
  if (!open.from) best = std::min(best, to_inside(path, wall.from));
  if (!open.to) best = std::min(best, to_inside(path, wall.to));
  if (path.round && wall.round) return std::min(best, arc_to_arc(path, wall));
  if (path.round || wall.round) return std::min(best, path.round ? line_to_arc(wall, path) : line_to_arc(path, wall));
  return lines_cross(path, wall) ? 0 : best;
}

bool goes_straight_on(const Piece& before, const Piece& behind) {
  const Vec2 u = tangent(before, before.to), w = tangent(behind, behind.from);
  return dot(u, w) > 0 && std::abs(cross(u, w)) <= std::max(unsure_direction(before), unsure_direction(behind));
}

bool lies_along(const Piece& block, const Piece& wall) {
  if (block.round != wall.round) return false;
  if (block.round && (block.sweep * wall.sweep < 0 || std::abs(block.sweep) > std::abs(wall.sweep) + kStraightOn || norm(block.center - wall.center) > kOneBlock_mm)) return false;
  if (!block.round && dot(block.to - block.from, wall.to - wall.from) <= 0) return false;
  const auto on_it = [&](Vec2 point) {
    Piece place;
    place.from = place.to = point;
    return distance(place, wall) <= kOneBlock_mm;
  };
  return on_it(block.from) && on_it(block.to);
}

bool cuts_end(const WayPast& way, const Piece& wall, OpenEnds open) { return (open.from && cuts_end(way, wall, wall.from)) || (open.to && cuts_end(way, wall, wall.to)); }

bool comes_nearer(const Piece& path, const Piece& wall, double least, OpenEnds open) {
  const double slack_path = slack(path), slack_wall = slack(wall), d = distance(path, wall, open);
  if (slack_path + slack_wall <= kOneRadius_mm) return d < least;
  if (d - slack_path - slack_wall >= least) return false;
  Piece half[2];
  if (slack_path >= slack_wall) {
    halve(path, half);
    return comes_nearer(half[0], wall, least, open) || comes_nearer(half[1], wall, least, open);
  }
  halve(wall, half);
  return comes_nearer(path, half[0], least, {open.from, false}) || comes_nearer(path, half[1], least, {false, open.to});
}

// Where all of the two is farther apart than the larger amounts, or somewhere nearer than the smallest one, that says it. Between the two it is asked of the halves
// of what changes more, which ends as soon as the amounts of two pieces are one.
bool comes_nearer(const Piece& path, Amount of_path, const Piece& wall, Amount of_wall, double margin, OpenEnds open) {
  const double most = std::min(std::max(of_path.start, of_path.end), std::max(of_wall.start, of_wall.end));
  const double least = std::min({of_path.start, of_path.end, of_wall.start, of_wall.end});
  if (!comes_nearer(path, wall, most - margin, open)) return false;
  if (most - least <= kOneAmount_mm || comes_nearer(path, wall, least - margin, open)) return true;
  const double path_changes = std::abs(of_path.end - of_path.start), wall_changes = std::abs(of_wall.end - of_wall.start);
  if (std::max(path_changes, wall_changes) <= kOneAmount_mm) return false;
  Piece half[2];
  if (path_changes >= wall_changes) {
    const double middle = 0.5 * (of_path.start + of_path.end);
    halve(path, half);
    return comes_nearer(half[0], {of_path.start, middle}, wall, of_wall, margin, open) || comes_nearer(half[1], {middle, of_path.end}, wall, of_wall, margin, open);
  }
  const double middle = 0.5 * (of_wall.start + of_wall.end);
  halve(wall, half);
  return comes_nearer(path, of_path, half[0], {of_wall.start, middle}, margin, {open.from, false}) ||
         comes_nearer(path, of_path, half[1], {middle, of_wall.end}, margin, {false, open.to});
}

double stretch_beside(const Piece& piece, bool from_start, const Piece& other, double clear) {
  if (slack(piece) <= kOneRadius_mm) return circular_stretch(piece, from_start, other, clear);
  const double half_length = 0.5 * std::max(piece.radius, piece.radius_end) * std::abs(piece.sweep) + slack(piece);
  Piece middle;
  middle.from = middle.to = point_at(piece, 0.5);
  if (distance(middle, other) + half_length <= clear) return 1;
  Piece half[2];
  halve(piece, half);
  const double first = stretch_beside(half[from_start ? 0 : 1], from_start, other, clear);
  return first < 1 ? 0.5 * first : 0.5 + 0.5 * stretch_beside(half[from_start ? 1 : 0], from_start, other, clear);
}

Piece without_stretch(const Piece& piece, bool from_start, double part) {
  Piece rest = piece;
  if (from_start) {
    rest.from = point_at(piece, part);
    rest.radius = piece.radius + part * (piece.radius_end - piece.radius);
  } else {
    rest.to = point_at(piece, 1 - part);
    rest.radius_end = piece.radius_end - part * (piece.radius_end - piece.radius);
  }
  rest.sweep = (1 - part) * piece.sweep;
  return rest;
}

bool on_one_level(const Section& a, const Section& b) {
  const double low = std::max(std::min(a.level, a.level_end), std::min(b.level, b.level_end));
  const double high = std::min(std::max(a.level, a.level_end), std::max(b.level, b.level_end));
  return low <= high + kLevel_mm;
}

bool closes(const Chain& chain, unsigned first, unsigned last) {
  for (unsigned from = first; from <= last; ++from) {
    Vec2 at;
    bool away = false;
    for (unsigned i = from; i <= last; ++i) {
      const Section& section = chain[i];
      at = at + section.delta + (i == from ? Vec2{} : section.approach);
      away = away || norm(at) > kAway_mm || (std::abs(section.sweep) > kPi && std::abs(section.begin.curvature) * kAway_mm < 1);
      if (away && norm(at) <= kCloses_mm) return true;
    }
  }
  return false;
}

}  // namespace nc
