// SPDX-License-Identifier: Apache-2.0
#include "offset/walls.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "base/same_place.hpp"

namespace nc {
namespace {

constexpr double kFull = 2 * 3.14159265358979323846;
constexpr double kSameRadius_mm = 1e-6;

double turned(Vec2 a, Vec2 b) { return std::atan2(cross(a, b), dot(a, b)); }

/// The ray from the centre to this point goes through the arc.
bool faces(const Piece& arc, Vec2 point) {
  if (std::abs(arc.sweep) >= kFull) return true;
  const double along = turned(arc.from - arc.center, point - arc.center);
  if (arc.sweep >= 0) return (along < 0 ? along + kFull : along) <= arc.sweep;
  return (along > 0 ? along - kFull : along) >= arc.sweep;
}

double to_line(Vec2 from, Vec2 to, Vec2 point) {
  const Vec2 way = to - from;
  const double squares = dot(way, way);
  const double part = squares > 0 ? std::clamp(dot(point - from, way) / squares, 0.0, 1.0) : 0;
  return norm(point - from - part * way);
}

double to_point(const Piece& piece, Vec2 point) {
  if (!piece.round) return to_line(piece.from, piece.to, point);
  const double ends = std::min(norm(point - piece.from), norm(point - piece.to));
  return faces(piece, point) ? std::min(ends, std::abs(norm(point - piece.center) - piece.radius)) : ends;
}

bool lines_cross(const Piece& a, const Piece& b) {
  const Vec2 u = a.to - a.from, w = b.to - b.from, d = b.from - a.from;
  const double c = cross(u, w);
  if (c == 0) return false;
  const double s = cross(d, w) / c, t = cross(d, u) / c;
  return s >= 0 && s <= 1 && t >= 0 && t <= 1;
}

/// Where the line passes the centre nearest, and where it crosses the circle.
double line_to_arc(const Piece& line, const Piece& arc) {
  const Vec2 way = line.to - line.from;
  const double length = norm(way);
  double best = std::numeric_limits<double>::infinity();
  if (!(length > kNoLength)) return best;
  const Vec2 u = (1 / length) * way;
  const double foot = dot(arc.center - line.from, u), away = cross(u, arc.center - line.from);
  const Vec2 nearest = line.from + std::clamp(foot, 0.0, length) * u;
  if (faces(arc, nearest)) best = std::abs(norm(nearest - arc.center) - arc.radius);
  const double squares = arc.radius * arc.radius - away * away;
  if (squares < 0) return best;
  const double half = std::sqrt(squares);
  for (const double t : {foot - half, foot + half})
    if (t >= 0 && t <= length && faces(arc, line.from + t * u)) return 0;
  return best;
}

double arc_to_arc(const Piece& a, const Piece& b) {
  const Vec2 d = b.center - a.center;
  const double apart = norm(d);
  if (!(apart > kNoLength)) {  // about one centre: side by side where they face each other
    return faces(a, b.from) || faces(a, b.to) || faces(b, a.from) ? std::abs(a.radius - b.radius) : std::numeric_limits<double>::infinity();
  }
  const Vec2 e = (1 / apart) * d;
  double best = std::numeric_limits<double>::infinity();
  for (const double s : {1.0, -1.0})
    for (const double t : {1.0, -1.0}) {
      const Vec2 p = a.center + s * a.radius * e, q = b.center + t * b.radius * e;
      if (faces(a, p) && faces(b, q)) best = std::min(best, norm(p - q));
    }
  const double x = (a.radius * a.radius - b.radius * b.radius + apart * apart) / (2 * apart), squares = a.radius * a.radius - x * x;
  if (squares < 0) return best;
  for (const double h : {std::sqrt(squares), -std::sqrt(squares)}) {
    const Vec2 hit = a.center + x * e + h * left_of(e);
    if (faces(a, hit) && faces(b, hit)) return 0;
  }
  return best;
}

bool arc_of(const Section& section, Vec2 start, Piece* piece) {
  const double radius = std::abs(1 / section.begin.curvature);
  if (std::abs(radius - std::abs(1 / section.end.curvature)) > kSameRadius_mm) return false;
  piece->round = true;
  piece->center = start + (1 / section.begin.curvature) * left_of(section.begin.u);
  piece->radius = radius;
  piece->sweep = section.sweep;
  return true;
}

}  // namespace

bool wall_of(const Section& section, Vec2 start, Piece* wall) {
  wall->from = start;
  wall->to = start + section.delta;
  return section.begin.curvature == 0 || arc_of(section, start, wall);
}

bool path_of(const Section& section, Vec2 start, Vec2 from, Vec2 to, Piece* path) {
  path->from = start + from;
  path->to = start + section.delta + to;
  if (section.begin.curvature == 0) return true;
  if (!arc_of(section, start, path)) return false;
  const Vec2 center = path->center;
  const double radius = norm(path->from - center);
  if (std::abs(radius - norm(path->to - center)) > kSameRadius_mm) return false;
  if (!(radius > kSameRadius_mm)) {  // the tool turns in one place
    path->round = false;
    return true;
  }
  path->radius = radius;
  path->sweep += turned(start + section.delta - center, path->to - center) - turned(start - center, path->from - center);
  return true;
}

double distance(const Piece& a, const Piece& b) {
  double best = std::min(std::min(to_point(a, b.from), to_point(a, b.to)), std::min(to_point(b, a.from), to_point(b, a.to)));
  if (a.round && b.round) return std::min(best, arc_to_arc(a, b));
  if (a.round || b.round) return std::min(best, a.round ? line_to_arc(b, a) : line_to_arc(a, b));
  return lines_cross(a, b) ? 0 : best;
}

}  // namespace nc
