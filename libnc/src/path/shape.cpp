// SPDX-License-Identifier: Apache-2.0
// Evaluation of shapes: first the programmed coordinates at a path length, then the map to the axes, then the affine map to the machine.
#include "path/shape.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/units.hpp"
#include "path/shape_ahead.hpp"

namespace nc {
namespace {

constexpr double kDegrees = 180 / kPi;
constexpr double kAtPole = 1e-9;  // mm

// ---- the angle about the pole, continuous along a line or an arc ---------------------------------------------------

/// Angle about the pole, rad, from (x0, y0) to (x, y) along a line: less than half a turn.
double turn_of_line(double x0, double y0, double x, double y) { return std::atan2(x0 * y - y0 * x, x0 * x + y0 * y); }

/// Angle of the point C + r e^(it) about the pole, rad, continuous in t. Where the pole is inside the circle it is t + arg(1 + C e^(-it) / r), otherwise
/// arg(C) + arg(1 + r e^(it) / C). The argument of the last arg stays in the right half plane, so that it never jumps.
double angle_on_circle(const Circle& c, bool circles_pole, double r, double t) {
  const double cx = c.center[0], cy = c.center[1];
  if (circles_pole) {
    const double qx = (cx * std::cos(t) + cy * std::sin(t)) / r, qy = (cy * std::cos(t) - cx * std::sin(t)) / r;
    return t + std::atan2(qy, 1 + qx);
  }
  const double distance = std::hypot(cx, cy), g = std::atan2(cy, cx);
  const double b = distance > 0 ? r / distance : 0;
  return g + std::atan2(b * std::sin(t - g), 1 + b * std::cos(t - g));
}

bool circles_pole(const Circle& c) {
  return std::hypot(c.center[0], c.center[1]) < 0.5 * (c.radius_start + c.radius_end);
}

/// The circle with the linear axis of the map as its first and the rotary axis as its second, whatever their order in the plane is.
Circle pole_circle(const Curve& base, const AxisMap& map) {
  Circle c = base.circle;
  if (base.h == map.linear) return c;
  std::swap(c.center[0], c.center[1]);
  c.angle_start = kPi / 2 - c.angle_start;
  c.sweep = -c.sweep;
  return c;
}

/// Angle from the start of `base` to its point `p`, where the parameter of the arc is u.
double turned(const CurveShape& shape, const AxisVec& p, double u) {
  const Curve& base = shape.base;
  const AxisMap& map = shape.what.map;
  if (!base.circular) {
    const double x0 = base.start[map.linear], y0 = base.start[map.rotary];
    if (std::hypot(x0, y0) < kAtPole) return 0;
    return turn_of_line(x0, y0, p[map.linear], p[map.rotary]);
  }
  const Circle c = pole_circle(base, map);
  const double r = c.radius_start + (c.radius_end - c.radius_start) * u;
  return angle_on_circle(c, shape.circles_pole, r, c.angle_start + c.sweep * u) - shape.circle_arg;
}

// ---- from programmed coordinates to the axes -----------------------------------------------------------------------

/// Turns the programmed point *p into the position of the axes.
void map_position(const CurveShape& shape, double u, AxisVec* p) {
  const AxisMap& map = shape.what.map;
  if (map.kind == AxisMap::Kind::polar) {
    const double deg = shape.begin_deg + turned(shape, *p, u) * kDegrees;
    (*p)[map.linear] = map.side * std::hypot((*p)[map.linear], (*p)[map.rotary]);
    (*p)[map.rotary] = (deg - shape.to_machine.offset()[map.rotary]) / shape.to_machine.coefficient(map.rotary, map.rotary);
  } else if (map.kind == AxisMap::Kind::cylinder) {
    (*p)[map.rotary] /= map.scale;
  }
}

struct Complex {
  double re, im;
  Complex operator*(Complex o) const { return {re * o.re - im * o.im, re * o.im + im * o.re}; }
  Complex operator-(Complex o) const { return {re - o.re, im - o.im}; }
};

/// Derivatives of radius and angle. Let z = x + iy and w = z'/z. Then (ln z)' = w, w' = z''/z - w^2, w'' = z'''/z - (z''/z) w - 2 w w'; the real part of ln z
/// is the logarithm of the radius, the imaginary part is the angle.
void map_polar_derivatives(const AxisMap& map, const AxisVec& at, CurvePoint* q) {
  const unsigned l = map.linear, r = map.rotary;
  const double x = at[l], y = at[r], rho = std::hypot(x, y);
  if (rho < kAtPole) {  // at the pole only the radius changes
    q->d1[l] = map.side * std::hypot(q->d1[l], q->d1[r]);
    q->d1[r] = q->d2[l] = q->d2[r] = q->d3[l] = q->d3[r] = 0;
    return;
  }
  const Complex inverse{x / (rho * rho), -y / (rho * rho)};
  const Complex w1 = Complex{q->d1[l], q->d1[r]} * inverse;
  const Complex q2 = Complex{q->d2[l], q->d2[r]} * inverse, q3 = Complex{q->d3[l], q->d3[r]} * inverse;
  const Complex w2 = q2 - w1 * w1;
  const Complex w3 = q3 - q2 * w1 - Complex{2, 0} * (w1 * w2);
  const double a = w1.re, b = w2.re, c = w3.re;
  q->d1[l] = map.side * rho * a;
  q->d2[l] = map.side * rho * (a * a + b);
  q->d3[l] = map.side * rho * (a * a * a + 3 * a * b + c);
  q->d1[r] = w1.im * kDegrees;
  q->d2[r] = w2.im * kDegrees;
  q->d3[r] = w3.im * kDegrees;
}

void map_derivatives(const CurveShape& shape, const AxisVec& at, CurvePoint* q) {
  const AxisMap& map = shape.what.map;
  if (map.kind == AxisMap::Kind::polar) {
    map_polar_derivatives(map, at, q);
    // The angle is that of the machine already, so the factor of to_machine is divided out.
    for (AxisVec* d : {&q->d1, &q->d2, &q->d3}) (*d)[map.rotary] /= shape.to_machine.coefficient(map.rotary, map.rotary);
  } else if (map.kind == AxisMap::Kind::cylinder) {
    for (AxisVec* d : {&q->d1, &q->d2, &q->d3}) (*d)[map.rotary] /= map.scale;
  }
}

/// The parameter u at the length s, which only the angle of a polar arc needs; otherwise 0.
double arc_parameter(const CurveShape& shape, double s) {
  return shape.what.map.kind == AxisMap::Kind::polar && shape.base.circular ? curve_arc_parameter(shape.base, s) : 0.0;
}

AxisVec programmed_position(const CurveShape& shape, double s, unsigned axis_count) {
  if (shape.what.kind == ShapeKind::plain) return curve_position(shape.base, s, axis_count);
  return base_position(shape, base_parameter(shape, s, axis_count), axis_count);
}

/// Machine position for the programmed point p; frozen axes stay where the curve starts.
AxisVec axes_at(const CurveShape& shape, const Curve& curve, AxisVec p, double u, unsigned axis_count) {
  map_position(shape, u, &p);
  AxisVec m = shape.to_machine.apply(p);
  for (unsigned i = 0; shape.what.map.frozen != 0 && i < axis_count; ++i)
    if (((shape.what.map.frozen >> i) & 1) != 0) m[i] = curve.start[i];
  return m;
}

}  // namespace

bool MoveShape::operator==(const MoveShape& other) const {
  if (std::memcmp(&map, &other.map, sizeof map) != 0 || kind != other.kind) return false;
  return kind == ShapeKind::plain;  // two other shapes are never taken as the same
}

PolarReach polar_reach(const CurveShape& shape) {
  const Curve& base = shape.base;
  const AxisMap& map = shape.what.map;
  PolarReach out;
  if (base.circular) {
    const Circle c = pole_circle(base, map);
    const double r = std::min(c.radius_start, c.radius_end);
    out.curvature = r > 0 ? 1 / r : HUGE_VAL;
    out.distance = std::min(std::hypot(base.start[map.linear], base.start[map.rotary]), std::hypot(base.end[map.linear], base.end[map.rotary]));
    // The point of the circle that is nearest to the pole counts when the arc contains it.
    const double nearest = std::atan2(-c.center[1], -c.center[0]) - c.angle_start, whole = 2 * kPi;
    const double ahead = c.sweep > 0 ? nearest - whole * std::floor(nearest / whole) : -nearest - whole * std::floor(-nearest / whole);
    if (ahead <= std::fabs(c.sweep)) {
      const double radius = c.radius_start + (c.radius_end - c.radius_start) * (c.sweep != 0 ? ahead / std::fabs(c.sweep) : 0);
      out.distance = std::min(out.distance, std::fabs(radius - std::hypot(c.center[0], c.center[1])));
    }
    return out;
  }
  const double x0 = base.start[map.linear], y0 = base.start[map.rotary], x1 = base.end[map.linear], y1 = base.end[map.rotary];
  const double dx = x1 - x0, dy = y1 - y0, way = std::hypot(dx, dy);
  out.distance = std::min(std::hypot(x0, y0), std::hypot(x1, y1));
  if (!(way > 0)) {
    out.radial = true;
    return out;
  }
  const double aside = std::fabs(x0 * dy - y0 * dx) / way, along = -(x0 * dx + y0 * dy) / way;
  if (along > 0 && along < way) out.distance = aside;
  out.radial = aside < kAtPole && (along <= kAtPole || along >= way - kAtPole);
  return out;
}

bool jumps_at_pole(const Curve& curve) {
  constexpr double kThroughPole = 1e-6;  // mm
  constexpr double kSameAngle = 1e-6;    // deg
  if (curve.shape == nullptr || curve.shape->what.map.kind != AxisMap::Kind::polar) return false;
  const unsigned rotary = curve.shape->what.map.rotary;
  const PolarReach reach = polar_reach(*curve.shape);
  if (reach.radial) return std::fabs(curve.end[rotary] - curve.start[rotary]) > kSameAngle;
  return reach.distance < kThroughPole;
}

double leaves_from(const Curve& curve, unsigned axis_count) {
  const CurveShape& shape = *curve.shape;
  const AxisMap& map = shape.what.map;
  const AxisVec first = shape_position(curve, 0, axis_count);
  double off = 0;
  for (unsigned i = 0; i < axis_count; ++i)
    if (((map.frozen >> i) & 1) == 0) off = std::max(off, std::fabs(first[i] - curve.start[i]));
  if (map.kind != AxisMap::Kind::polar || ((map.frozen >> map.rotary) & 1) != 0) return off;
  // The angle is counted on from the position of the rotary axis. If that is not the angle of the start point, the difference would vanish at the end of the
  // move, which takes its angle from the end point.
  const double x = shape.base.start[map.linear], y = shape.base.start[map.rotary], radius = std::hypot(x, y);
  if (radius < kAtPole) return off;
  const double angle = map.angle + std::atan2(map.side * y, map.side * x) * kDegrees;
  return std::max(off, std::fabs(std::remainder(angle - curve.start[map.rotary], 360.0)) * std::min(1.0, radius / kDegrees));
}

double polar_turn(const Curve& base, const AxisMap& map) {
  if (!base.circular) {
    if (std::hypot(base.start[map.linear], base.start[map.rotary]) < kAtPole) return 0;
    return turn_of_line(base.start[map.linear], base.start[map.rotary], base.end[map.linear], base.end[map.rotary]);
  }
  const Circle c = pole_circle(base, map);
  const bool inside = circles_pole(c);
  return angle_on_circle(c, inside, c.radius_end, c.angle_start + c.sweep) - angle_on_circle(c, inside, c.radius_start, c.angle_start);
}

/// The base of a shape that is the line or circle of the move itself.
static void make_plain(const PlainMove& move, unsigned axis_count, uint32_t degrees, CurveShape* shape) {
  if (move.circle != nullptr) {
    shape->base = make_arc(*move.start, *move.end, move.h, move.v, *move.circle, axis_count, degrees);
  } else {
    make_line(*move.start, *move.end, axis_count, degrees, &shape->base);
  }
}

/// Sets what begins and ends where on the machine, for a shape whose base is made.
static void place_shape(const AxisVec& machine_start, unsigned axis_count, CurveShape* shape, Curve* curve) {
  const AxisMap& map = shape->what.map;
  double end_turn = 0;
  if (map.kind == AxisMap::Kind::polar) {
    shape->begin_deg = machine_start[map.rotary];
    if (shape->base.circular) {
      const Circle c = pole_circle(shape->base, map);
      shape->circles_pole = circles_pole(c);
      shape->circle_arg = angle_on_circle(c, shape->circles_pole, c.radius_start, c.angle_start);
    }
    end_turn = polar_turn(shape->base, map);
  }
  curve->circular = false;
  curve->shape = shape;
  curve->start = machine_start;
  curve->length = shape->base.length;
  curve->end = axes_at(*shape, *curve, shape->base.end, 1.0, axis_count);
  if (map.kind == AxisMap::Kind::polar && ((map.frozen >> map.rotary) & 1) == 0) {
    // The end is calculated from the angle of the end point, so that rounding does not add up from move to move.
    const double x = shape->base.end[map.linear], y = shape->base.end[map.rotary];
    const double about = machine_start[map.rotary] + end_turn * kDegrees;
    curve->end[map.rotary] = about;
    if (std::hypot(x, y) >= kAtPole) {
      const double exact = map.angle + std::atan2(map.side * y, map.side * x) * kDegrees;
      curve->end[map.rotary] = exact + 360 * std::nearbyint((about - exact) / 360);
    }
  }
  for (unsigned i = 0; i < kMaxAxes; ++i) curve->delta[i] = i < axis_count ? curve->end[i] - curve->start[i] : 0;
}

uint32_t programmed_degrees(const AxisMap& map, uint32_t rotary) {
  return map.kind != AxisMap::Kind::none ? rotary & ~(1u << map.rotary) : rotary;
}

void make_shaped(const MoveShape& what, const PlainMove& move, const Affine& to_machine, const AxisVec& machine_start, unsigned axis_count,
                 uint32_t rotary, CurveShape* shape, Curve* curve, const ShapeAhead* ahead) {
  shape->what = what;
  shape->to_machine = to_machine;
  const uint32_t degrees = programmed_degrees(what.map, rotary);
  if (what.kind == ShapeKind::plain) {
    make_plain(move, axis_count, degrees, shape);
  } else if (ahead == nullptr || !ahead->give(move, shape)) {
    make_base(*move.start, *move.end, axis_count, degrees, shape);
  }
  place_shape(machine_start, axis_count, shape, curve);
}

AxisVec shaped_end(const MoveShape& what, const PlainMove& move, const Affine& to_machine, const AxisVec& machine_start, unsigned axis_count,
                   uint32_t rotary) {
  CurveShape shape;
  Curve curve;
  shape.what = what;
  shape.to_machine = to_machine;
  const uint32_t degrees = programmed_degrees(what.map, rotary);
  if (what.kind == ShapeKind::plain) {
    make_plain(move, axis_count, degrees, &shape);
  } else {
    begin_base(*move.start, *move.end, axis_count, degrees, &shape);
  }
  place_shape(machine_start, axis_count, &shape, &curve);
  return curve.end;
}

AxisVec to_programmed(const AxisMap& map, const Affine& to_machine, const AxisVec& machine) {
  AxisVec p = to_machine.apply_inverse(machine);
  if (map.kind == AxisMap::Kind::cylinder) p[map.rotary] *= map.scale;
  if (map.kind == AxisMap::Kind::polar) {
    const double radius = p[map.linear], angle = (machine[map.rotary] - map.angle) / kDegrees;
    p[map.linear] = radius * std::cos(angle);
    p[map.rotary] = radius * std::sin(angle);
  }
  return p;
}

AxisVec shape_position(const Curve& curve, double s, unsigned axis_count) {
  const CurveShape& shape = *curve.shape;
  return axes_at(shape, curve, programmed_position(shape, s, axis_count), arc_parameter(shape, s), axis_count);
}

CurvePoint shape_programmed(const CurveShape& shape, double s, unsigned axis_count) {
  if (shape.what.kind == ShapeKind::plain) return curve_evaluate(shape.base, s, axis_count);
  return base_evaluate(shape, s, axis_count);
}

CurvePoint shape_evaluate(const Curve& curve, double s, unsigned axis_count) {
  const CurveShape& shape = *curve.shape;
  const double at = std::min(curve.length, std::max(0.0, s));
  CurvePoint q = shape_programmed(shape, at, axis_count);
  const AxisVec p = q.position;
  map_derivatives(shape, p, &q);
  for (AxisVec* d : {&q.d1, &q.d2, &q.d3}) {
    if (!shape.to_machine.only_translates()) *d = shape.to_machine.direct(*d);
    for (unsigned i = 0; shape.what.map.frozen != 0 && i < axis_count; ++i)
      if (((shape.what.map.frozen >> i) & 1) != 0) (*d)[i] = 0;
  }
  q.position = s <= 0 ? curve.start : s >= curve.length ? curve.end : axes_at(shape, curve, p, arc_parameter(shape, at), axis_count);
  return q;
}

/// Extremes lie at the ends, or where d1 changes its sign; such a place is found by bisection.
void shape_bounds(const Curve& curve, unsigned axis_count, AxisVec* low, AxisVec* high) {
  constexpr unsigned kPieces = 32;
  constexpr unsigned kHalvings = 40;
  for (unsigned i = 0; i < axis_count; ++i) {
    (*low)[i] = std::min(curve.start[i], curve.end[i]);
    (*high)[i] = std::max(curve.start[i], curve.end[i]);
  }
  CurvePoint before = shape_evaluate(curve, 0, axis_count);
  for (unsigned k = 1; k <= kPieces; ++k) {
    const double from = curve.length * (k - 1) / kPieces, to = curve.length * k / kPieces;
    const CurvePoint after = shape_evaluate(curve, to, axis_count);
    for (unsigned i = 0; i < axis_count; ++i) {
      double a = from, b = to;
      if (before.d1[i] * after.d1[i] < 0) {
        for (unsigned n = 0; n < kHalvings; ++n) {
          const double middle = 0.5 * (a + b);
          (shape_evaluate(curve, middle, axis_count).d1[i] * before.d1[i] > 0 ? a : b) = middle;
        }
      }
      const double x = shape_position(curve, b, axis_count)[i];
      (*low)[i] = std::min((*low)[i], x);
      (*high)[i] = std::max((*high)[i], x);
    }
    before = after;
  }
}

}  // namespace nc
