// SPDX-License-Identifier: Apache-2.0
// Evaluation of lines and circular arcs by path length.
//
// An arc is P(u) = C + R(u) (cos t(u), sin t(u)) with u in [0, 1], R(u) = R0 + (R1 - R0) u and t(u) = t0 + sweep u; all other axes change linearly with
// u. Its speed by u is
//     sigma(u) = |dP/du| = sqrt(b^2 + (sweep R(u))^2),   b^2 = (R1 - R0)^2 + (linear axes outside the plane)^2
// and the length s(u) is the integral of sigma. With equal radii sigma is constant and s = L u. Where the radii differ (the end point lies beside the
// circle, within the arc tolerance) s(u) is inverted by Newton's method, which converges from any start because s is monotone and convex or concave; a few
// steps reach the last bit.
#include "path/curve.hpp"

#include <algorithm>
#include <cmath>

#include "path/shape.hpp"

namespace nc {
namespace {

constexpr double kHalfPi = 1.57079632679489661923;
/// Below this relative difference of the radii sigma is constant to 1e-8, and u = s / L is used.
constexpr double kEqualRadii = 1e-8;

double squared(double x) {
  return x * x;
}

/// What is needed to evaluate an arc, in addition to the curve itself.
struct Spiral {
  double r0, dr, sweep, b2;
  bool uniform;
};

double sigma_at(const Spiral& a, double u) {
  return std::sqrt(a.b2 + squared(a.sweep * (a.r0 + a.dr * u)));
}

/// Integral of sigma from 0 to u.
double spiral_length(const Spiral& a, double u) {
  const double slope = std::fabs(a.sweep) * a.dr;
  const double x0 = std::fabs(a.sweep) * a.r0;
  const double x1 = x0 + slope * u;
  if (std::fabs(slope) > 0.05 * std::max(x0, std::fabs(x0 + slope))) {
    // The closed form: with x = |sweep| R, the integral of sqrt(b^2 + x^2) dx / slope.
    const double b = std::sqrt(a.b2);
    const auto g = [&](double x) { return 0.5 * (x * std::sqrt(a.b2 + x * x) + a.b2 * std::asinh(x / b)); };
    return (g(x1) - g(x0)) / slope;
  }
  // With nearly equal radii the closed form loses accuracy by cancellation; Gauss-Legendre with 5 points is exact to the last bits there.
  constexpr double kNode[5] = {0.04691007703066800, 0.23076534494715845, 0.5, 0.76923465505284155,
                               0.95308992296933200};
  constexpr double kWeight[5] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444,
                                 0.23931433524968324, 0.11846344252809454};
  double sum = 0;
  for (int i = 0; i < 5; ++i) sum += kWeight[i] * sigma_at(a, u * kNode[i]);
  return sum * u;
}

/// The values of the curve's circle. In b^2 only linear axes outside the plane count; rotary axes do not make length.
Spiral spiral_of(const Curve& c) {
  Spiral a;
  a.r0 = c.circle.radius_start;
  a.dr = c.circle.radius_end - c.circle.radius_start;
  a.sweep = c.circle.sweep;
  a.uniform = std::fabs(a.dr) <= kEqualRadii * std::max(c.circle.radius_start, c.circle.radius_end);
  a.b2 = 0;
  if (!a.uniform) a.b2 = squared(a.dr) + c.linear2;
  return a;
}

/// u for a path length s in (0, length).
double spiral_parameter(const Curve& c, const Spiral& a, double s) {
  double u = s / c.length;
  if (a.uniform) return u;
  for (int i = 0; i < 8; ++i) {
    const double step = (spiral_length(a, u) - s) / sigma_at(a, u);
    u -= step;
    if (u < 0) u = 0;
    if (u > 1) u = 1;
    if (std::fabs(step) < 1e-15) break;
  }
  return u;
}

/// Extremes of one axis of the plane, x(u) = C + R(u) cos t(u) with t = t0 + sweep u - phase; phase is 0 for the first axis, pi/2 for the second. They lie
/// where R' cos t = R sweep sin t, that is, where t - atan(R' / (R sweep)) = n pi. The left side is monotone in u with a slope between sweep and 2 sweep, so
/// every n has one root, and Newton's method finds it.
void arc_axis_bounds(const Curve& c, uint8_t axis, double phase, double* low, double* high) {
  const Circle& k = c.circle;
  const double center = k.center[phase > 0 ? 1 : 0];
  const double dr = k.radius_end - k.radius_start, pi = 2 * kHalfPi;
  const auto radius = [&](double u) { return k.radius_start + dr * u; };
  const auto lean = [&](double u) { return dr == 0 ? 0.0 : std::atan(dr / (radius(u) * k.sweep)); };
  const auto left_side = [&](double u) { return k.angle_start + k.sweep * u - phase - lean(u); };
  const auto take = [&](double n) {
    double u = 0.5;
    for (int i = 0; i < 30; ++i) {
      const double tangent = std::tan(lean(u)), share = tangent * tangent / (1 + tangent * tangent);
      const double step = (left_side(u) - n * pi) / (k.sweep * (1 + share));
      u = std::min(1.0, std::max(0.0, u - step));
      if (std::fabs(step) < 1e-14) break;
    }
    const double x = center + radius(u) * std::cos(k.angle_start + k.sweep * u - phase);
    *low = std::min(*low, x);
    *high = std::max(*high, x);
  };
  *low = std::min(c.start[axis], c.end[axis]);
  *high = std::max(c.start[axis], c.end[axis]);
  if (k.sweep == 0) return;
  const double from = left_side(0) / pi, to = left_side(1) / pi;
  const double first = std::ceil(std::min(from, to)), last = std::floor(std::max(from, to));
  // R is monotone, so of the extremes of many turns the outermost one on each side is among the first two or the last two.
  for (double n = first; n <= last && n <= first + 1; n += 1) take(n);
  for (double n = last; n >= first && n >= last - 1; n -= 1) take(n);
}

}  // namespace

Curve make_line(const AxisVec& start, const AxisVec& end, unsigned axis_count, uint32_t rotary) {
  Curve c;
  make_line(start, end, axis_count, rotary, &c);
  return c;
}

Curve make_arc(const AxisVec& start, const AxisVec& end, uint8_t h, uint8_t v, const Circle& circle,
               unsigned axis_count, uint32_t rotary) {
  Curve c;
  c.circular = true;
  c.h = h;
  c.v = v;
  c.start = start;
  c.end = end;
  c.circle = circle;
  for (unsigned i = 0; i < axis_count; ++i) {
    c.delta[i] = end[i] - start[i];
    if (i != h && i != v && !(rotary >> i & 1)) c.linear2 += squared(c.delta[i]);
  }
  const Spiral a = spiral_of(c);
  if (a.uniform) {
    const double r = 0.5 * (circle.radius_start + circle.radius_end);
    c.length = std::sqrt(squared(r * circle.sweep) + c.linear2);
  } else {
    c.length = spiral_length(a, 1.0);
  }
  return c;
}

AxisVec curve_position(const Curve& c, double s, unsigned axis_count) {
  if (!(s > 0)) return c.start;
  if (s >= c.length) return c.end;
  if (c.shape != nullptr) return shape_position(c, s, axis_count);
  AxisVec p;
  if (!c.circular) {
    const double u = s / c.length;
    for (unsigned i = 0; i < axis_count; ++i) p[i] = c.start[i] + c.delta[i] * u;
    return p;
  }
  const Spiral a = spiral_of(c);
  const double u = spiral_parameter(c, a, s);
  for (unsigned i = 0; i < axis_count; ++i) p[i] = c.start[i] + c.delta[i] * u;
  const double r = a.r0 + a.dr * u, t = c.circle.angle_start + a.sweep * u;
  p[c.h] = c.circle.center[0] + r * std::cos(t);
  p[c.v] = c.circle.center[1] + r * std::sin(t);
  return p;
}

double curve_arc_parameter(const Curve& c, double s) {
  if (!(s > 0)) return 0;
  if (s >= c.length) return 1;
  return spiral_parameter(c, spiral_of(c), s);
}

CurvePoint curve_evaluate(const Curve& c, double s, unsigned axis_count) {
  if (c.shape != nullptr) return shape_evaluate(c, s, axis_count);
  CurvePoint out;
  out.position = curve_position(c, s, axis_count);
  if (!(c.length > 0)) return out;
  if (!c.circular) {
    for (unsigned i = 0; i < axis_count; ++i) out.d1[i] = c.delta[i] / c.length;
    return out;
  }
  const Spiral a = spiral_of(c);
  const double at = std::min(c.length, std::max(0.0, s));
  const double u = at >= c.length ? 1.0 : at <= 0 ? 0.0 : spiral_parameter(c, a, at);
  // Derivatives of u by s: u' = 1/sigma, u'' = -sigma'/sigma^3, u''' = (3 sigma'^2 - sigma sigma'')/sigma^5
  // (primes of sigma by u).
  double u1 = 1 / c.length, u2 = 0, u3 = 0;
  const double r = a.r0 + a.dr * u;
  if (!a.uniform) {
    const double sg = sigma_at(a, u);
    const double q1 = 2 * squared(a.sweep) * r * a.dr, q2 = 2 * squared(a.sweep * a.dr);
    const double sg1 = q1 / (2 * sg), sg2 = (q2 / 2 - sg1 * sg1) / sg;
    u1 = 1 / sg;
    u2 = -sg1 * u1 * u1 * u1;
    u3 = (3 * sg1 * sg1 - sg * sg2) * u1 * u1 * u1 * u1 * u1;
  }
  for (unsigned i = 0; i < axis_count; ++i) {
    out.d1[i] = c.delta[i] * u1;
    out.d2[i] = c.delta[i] * u2;
    out.d3[i] = c.delta[i] * u3;
  }
  // In the plane: derivatives of R e^(it) by u, written as (radial, tangential) components.
  const double t = c.circle.angle_start + a.sweep * u, ct = std::cos(t), st = std::sin(t);
  const double w = a.sweep;
  const double p1r = a.dr, p1t = r * w;
  const double p2r = -r * w * w, p2t = 2 * a.dr * w;
  const double p3r = -3 * a.dr * w * w, p3t = -r * w * w * w;
  const double d1r = p1r * u1, d1t = p1t * u1;
  const double d2r = p2r * u1 * u1 + p1r * u2, d2t = p2t * u1 * u1 + p1t * u2;
  const double d3r = p3r * u1 * u1 * u1 + 3 * p2r * u1 * u2 + p1r * u3;
  const double d3t = p3t * u1 * u1 * u1 + 3 * p2t * u1 * u2 + p1t * u3;
  out.d1[c.h] = d1r * ct - d1t * st;
  out.d1[c.v] = d1r * st + d1t * ct;
  out.d2[c.h] = d2r * ct - d2t * st;
  out.d2[c.v] = d2r * st + d2t * ct;
  out.d3[c.h] = d3r * ct - d3t * st;
  out.d3[c.v] = d3r * st + d3t * ct;
  return out;
}

void curve_bounds(const Curve& c, unsigned axis_count, AxisVec* low, AxisVec* high) {
  for (unsigned i = 0; i < axis_count; ++i) {
    (*low)[i] = std::min(c.start[i], c.end[i]);
    (*high)[i] = std::max(c.start[i], c.end[i]);
  }
  if (c.shape != nullptr) return shape_bounds(c, axis_count, low, high);
  if (!c.circular) return;
  arc_axis_bounds(c, c.h, 0.0, &(*low)[c.h], &(*high)[c.h]);
  arc_axis_bounds(c, c.v, kHalfPi, &(*low)[c.v], &(*high)[c.v]);
}

}  // namespace nc
