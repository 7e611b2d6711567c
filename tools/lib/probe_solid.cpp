// SPDX-License-Identifier: Apache-2.0
// See probe_solid.hpp.
//
// How the first entry is found. Let f(s) be the clearance at the part s of the way. A step ds changes f by at most rate * ds, where rate is the length
// of the straight way plus, for each rotary axis, the length of the arc of the point that it turns furthest. So there is no surface within a step of
// f / rate, and such a step is safe. Near a surface these steps would become shorter and shorter; therefore the shortest step is a millionth of the
// way. It can only pass over a part of the solid whose chord is shorter than that. Once f is negative, bisection finds where it became negative.
#include "tools/lib/probe_solid.hpp"

#include <algorithm>
#include <cmath>

namespace nc::tools {
namespace {

constexpr double kTouch = 1e-9;       // mm: a smaller depth counts as rounding and not as inside
constexpr double kLeastStep = 1e-6;   // shortest step, as a part of the way
constexpr double kDegree = 3.14159265358979323846 / 180.0;

double length(const Point3& v) { return std::hypot(v[0], v[1], v[2]); }

Point3 difference(const Point3& a, const Point3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

// The distance from a body that is enclosed by surfaces at right angles. A point outside of more than one surface is nearest to their common edge.
double inside_of_all(const double* out, int count) {
  double most = -std::numeric_limits<double>::infinity(), squares = 0.0;
  for (int i = 0; i < count; ++i) {
    most = std::max(most, out[i]);
    if (out[i] > 0.0) squares += out[i] * out[i];
  }
  return most > 0.0 ? std::sqrt(squares) : most;
}

// Sine and cosine that are exact at multiples of 90 degrees, the usual angles of tables.
void sine_cosine(double degrees, double* sine, double* cosine) {
  const double turns = std::floor(degrees / 90.0 + 0.5), rest = (degrees - turns * 90.0) * kDegree;
  const double s = std::sin(rest), c = std::cos(rest);
  switch (static_cast<int>(std::fmod(turns, 4.0) + 4.0) % 4) {
    case 0: *sine = s, *cosine = c; break;
    case 1: *sine = c, *cosine = -s; break;
    case 2: *sine = -s, *cosine = -c; break;
    default: *sine = -c, *cosine = s; break;
  }
}

// Turns a point about an axis that is parallel to a machine axis; positive by the right-hand rule.
Point3 turned(const Point3& p, const ProbeTurn& turn, double degrees) {
  const auto u = static_cast<size_t>((turn.about + 1) % 3), v = static_cast<size_t>((turn.about + 2) % 3);
  double sine = 0.0, cosine = 1.0;
  sine_cosine(degrees, &sine, &cosine);
  const double a = p[u] - turn.center[u], b = p[v] - turn.center[v];
  Point3 out = p;
  out[u] = turn.center[u] + cosine * a - sine * b;
  out[v] = turn.center[v] + sine * a + cosine * b;
  return out;
}

}  // namespace

double ProbeShape::distance(const Point3& p) const {
  switch (kind) {
    case Kind::kBox: {
      double out[3];
      for (size_t i = 0; i < 3; ++i) out[i] = std::max(low[i] - p[i], p[i] - high[i]);
      return inside_of_all(out, 3);
    }
    case Kind::kCylinder: {
      const auto a = static_cast<size_t>(axis), u = (a + 1) % 3, v = (a + 2) % 3;
      const double out[2] = {std::hypot(p[u] - center[u], p[v] - center[v]) - radius, std::max(low[a] - p[a], p[a] - high[a])};
      return inside_of_all(out, 2);
    }
    case Kind::kSphere:
      return length(difference(p, center)) - radius;
    case Kind::kHalfSpace: {
      const Point3 d = difference(p, center);
      return d[0] * normal[0] + d[1] * normal[1] + d[2] * normal[2];
    }
  }
  return std::numeric_limits<double>::infinity();
}

double ProbeSolid::clearance(const Point3& p, const double* angles) const {
  Point3 at = p;
  for (size_t i = 0; i < 3; ++i) at[i] += ball_center[i];
  // The table has turned by minus the command. Seen from the solid, the ball has turned by the command.
  for (const ProbeTurn& turn : turns) at = turned(at, turn, angles[turn.axis_index]);
  double d = shape.distance(at);
  for (const ProbeShape& hole : holes) d = std::max(d, -hole.distance(at));
  return d - ball_radius;
}

double ProbeSolid::first_entry(const Way& way) const {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Point3 along = difference(way.to, way.from);
  double rate = length(along);
  double reach = 0.0;  // sum of the distances from each axis to the next one, so far
  for (size_t i = 0; i < turns.size(); ++i) {
    const ProbeTurn& turn = turns[i];
    if (i > 0) reach += length(difference(turn.center, turns[i - 1].center));
    const double furthest = std::max(length(difference(way.from, turns[0].center)), length(difference(way.to, turns[0].center)));
    const double by = std::fabs(way.angles_to[turn.axis_index] - way.angles_from[turn.axis_index]) * kDegree;
    rate += by * (furthest + length(ball_center) + 2.0 * reach);
  }
  std::vector<double> angles;
  size_t count = 0;
  for (const ProbeTurn& turn : turns) count = std::max(count, size_t{turn.axis_index} + 1);
  angles.resize(count);
  const auto at = [&](double s) {
    Point3 p;
    for (size_t i = 0; i < 3; ++i) p[i] = way.from[i] + s * along[i];
    for (const ProbeTurn& turn : turns) {
      const double a = way.angles_from[turn.axis_index], b = way.angles_to[turn.axis_index];
      angles[turn.axis_index] = a + s * (b - a);
    }
    return clearance(p, angles.data());
  };
  if (!(rate > 0.0)) return at(0.0) < -kTouch ? 0.0 : kNever;
  if (at(0.0) < -kTouch) return 0.0;  // the ball is inside already
  const double beyond = 1.0 + 2.0 * kTouch / rate;
  double before = 0.0;
  for (double s = 0.0; before < beyond;) {
    const double f = at(s);
    if (f < -0.5 * kTouch) {
      double in = s, out = before;
      for (int i = 0; i < 60 && in - out > 0.0; ++i) {
        const double middle = out + (in - out) / 2;
        (at(middle) < 0.0 ? in : out) = middle;
      }
      return out * rate <= kTouch ? 0.0 : std::min(out, 1.0);
    }
    before = s;
    s = std::min(beyond, s + std::max(f / rate, kLeastStep));
  }
  return kNever;
}

}  // namespace nc::tools
