// SPDX-License-Identifier: Apache-2.0
// Arcs in space, exponential curves, spans of NURBS and blocks of splines as functions of their own parameter u:
//
//     space arc     u in [0, 1], angle = sweep u, all other axes linearly; |dP/du| is constant
//     exponential   u in [0, end] is the angle of M700 6.11
//     rational      u in [0, 1] of one knot span
//     spline        u in [0, 1] of one block
//
// Let sigma = |dP/du| over the axes that make the length. Then du/ds = 1/sigma; u(s) itself comes from a table of exact values at equal steps of s, with
// quintic interpolation between them.
#include "path/shape_base.hpp"

#include <algorithm>
#include <cmath>

namespace nc {
namespace {

/// A point and its derivatives by u.
struct ByParameter {
  AxisVec p, d1, d2, d3;
};

void space_arc_at(const CurveShape& shape, double u, unsigned axis_count, ByParameter* q) {
  const SpaceArc& a = shape.what.arc;
  for (unsigned i = 0; i < axis_count; ++i) {
    q->p[i] = shape.base.start[i] + shape.base.delta[i] * u;
    q->d1[i] = shape.base.delta[i];
  }
  const double t = a.sweep * u, c = a.radius * std::cos(t), s = a.radius * std::sin(t), w = a.sweep;
  for (unsigned i = 0; i < 3; ++i) {
    const double radial = a.e1[i] * c + a.e2[i] * s, tangential = a.e2[i] * c - a.e1[i] * s;
    q->p[a.axis[i]] = a.center[i] + radial;
    q->d1[a.axis[i]] = w * tangential;
    q->d2[a.axis[i]] = -w * w * radial;
    q->d3[a.axis[i]] = -w * w * w * tangential;
  }
}

void exponential_at(const CurveShape& shape, double u, unsigned axis_count, ByParameter* q) {
  const Exponential& e = shape.what.exponential;
  const double whole = shape.base.delta[e.linear];
  const double x = e.k * std::expm1(u / e.d), slope = (x + e.k) / e.d;
  for (unsigned i = 0; i < axis_count; ++i) {
    if (i == e.rotary) continue;
    const double share = shape.base.delta[i] / whole;
    q->p[i] = shape.base.start[i] + share * x;
    q->d1[i] = share * slope;
    q->d2[i] = q->d1[i] / e.d;
    q->d3[i] = q->d2[i] / e.d;
  }
  q->p[e.rotary] = shape.base.start[e.rotary] + e.degrees_per_rad * u;
  q->d1[e.rotary] = e.degrees_per_rad;
}

/// Turns Bernstein coefficients of degree `n` into those of powers of u. The degree is at most 3, so only small numbers lose accuracy by cancellation.
void to_powers(const double (&b)[4], unsigned n, double (&a)[4]) {
  a[0] = b[0];
  a[1] = a[2] = a[3] = 0;
  if (n == 1) {
    a[1] = b[1] - b[0];
  } else if (n == 2) {
    a[1] = 2 * (b[1] - b[0]);
    a[2] = (b[2] - b[1]) - (b[1] - b[0]);
  } else {
    a[1] = 3 * (b[1] - b[0]);
    a[2] = 3 * ((b[2] - b[1]) - (b[1] - b[0]));
    a[3] = (b[3] - b[0]) - 3 * (b[2] - b[1]);
  }
}

void make_powers(CurveShape* shape) {
  const RationalSpan& r = shape->what.span;
  to_powers(r.weight, r.degree, shape->power[3]);
  for (unsigned i = 0; i < 3; ++i) {
    double b[4];
    for (unsigned k = 0; k < 4; ++k) b[k] = r.axis[i] < kMaxAxes ? r.point[k][i] * r.weight[k] : 0;
    to_powers(b, r.degree, shape->power[i]);
  }
}

double value_of(const double (&a)[4], double u) { return ((a[3] * u + a[2]) * u + a[1]) * u + a[0]; }
double slope_of(const double (&a)[4], double u) { return (3 * a[3] * u + 2 * a[2]) * u + a[1]; }

void rational_at(const CurveShape& shape, double u, unsigned axis_count, ByParameter* q) {
  const RationalSpan& r = shape.what.span;
  for (unsigned i = 0; i < axis_count; ++i) q->p[i] = shape.base.start[i];
  const double(&w)[4] = shape.power[3];
  const double iw = 1 / value_of(w, u), w1 = slope_of(w, u), w2 = 6 * w[3] * u + 2 * w[2], w3 = 6 * w[3];
  for (unsigned i = 0; i < 3; ++i) {
    if (r.axis[i] >= kMaxAxes) continue;
    const double(&n)[4] = shape.power[i];
    // N = w P, differentiated three times.
    const double p = value_of(n, u) * iw;
    const double d1 = (slope_of(n, u) - w1 * p) * iw;
    const double d2 = (6 * n[3] * u + 2 * n[2] - 2 * w1 * d1 - w2 * p) * iw;
    const double d3 = (6 * n[3] - 3 * w1 * d2 - 3 * w2 * d1 - w3 * p) * iw;
    const unsigned axis = r.axis[i];
    q->p[axis] = p;
    q->d1[axis] = d1;
    q->d2[axis] = d2;
    q->d3[axis] = d3;
  }
}

AxisVec rational_point(const CurveShape& shape, double u) {
  const RationalSpan& r = shape.what.span;
  AxisVec p = shape.base.start;
  const double iw = 1 / value_of(shape.power[3], u);
  for (unsigned i = 0; i < 3; ++i)
    if (r.axis[i] < kMaxAxes) p[r.axis[i]] = value_of(shape.power[i], u) * iw;
  return p;
}

/// |dP/du| alone; the length is its integral.
double rational_speed(const CurveShape& shape, double u) {
  const double iw = 1 / value_of(shape.power[3], u), w1 = slope_of(shape.power[3], u);
  double sum = 0;
  for (unsigned i = 0; i < 3; ++i) {
    const double d = (slope_of(shape.power[i], u) - w1 * value_of(shape.power[i], u) * iw) * iw;
    sum += d * d;
  }
  return std::sqrt(sum);
}

void spline_at(const CurveShape& shape, double u, unsigned axis_count, ByParameter* q) {
  const SplineSpan& r = shape.what.spline;
  for (unsigned i = 0; i < axis_count; ++i) q->p[i] = shape.base.start[i];
  for (unsigned i = 0; i < 3; ++i) {
    if (r.axis[i] >= kMaxAxes) continue;
    const double a = r.c[0][i], b = r.c[1][i], c = r.c[2][i], d = r.c[3][i], e = r.c[4][i];
    const unsigned axis = r.axis[i];
    q->p[axis] += ((((e * u + d) * u + c) * u + b) * u + a) * u;
    q->d1[axis] = (((5 * e * u + 4 * d) * u + 3 * c) * u + 2 * b) * u + a;
    q->d2[axis] = ((20 * e * u + 12 * d) * u + 6 * c) * u + 2 * b;
    q->d3[axis] = (60 * e * u + 24 * d) * u + 6 * c;
  }
}

AxisVec spline_point(const CurveShape& shape, double u) {
  const SplineSpan& r = shape.what.spline;
  AxisVec p = shape.base.start;
  for (unsigned i = 0; i < 3; ++i)
    if (r.axis[i] < kMaxAxes) p[r.axis[i]] += ((((r.c[4][i] * u + r.c[3][i]) * u + r.c[2][i]) * u + r.c[1][i]) * u + r.c[0][i]) * u;
  return p;
}

double spline_speed(const CurveShape& shape, double u) {
  const SplineSpan& r = shape.what.spline;
  double sum = 0;
  for (unsigned i = 0; i < 3; ++i) {
    if (r.axis[i] >= kMaxAxes) continue;
    const double d = (((5 * r.c[4][i] * u + 4 * r.c[3][i]) * u + 3 * r.c[2][i]) * u + 2 * r.c[1][i]) * u + r.c[0][i];
    sum += d * d;
  }
  return std::sqrt(sum);
}

double exponential_speed(const CurveShape& shape, double u) {
  const Exponential& e = shape.what.exponential;
  const double slope = e.k / e.d * std::exp(u / e.d);
  return std::sqrt(slope * slope * shape.along2 + e.degrees_per_rad * e.degrees_per_rad);
}

void by_parameter(const CurveShape& shape, double u, unsigned axis_count, ByParameter* q) {
  switch (shape.what.kind) {
    case ShapeKind::sine:
    case ShapeKind::space_arc: space_arc_at(shape, u, axis_count, q); break;
    case ShapeKind::exponential: exponential_at(shape, u, axis_count, q); break;
    case ShapeKind::spline: spline_at(shape, u, axis_count, q); break;
    default: rational_at(shape, u, axis_count, q); break;
  }
}

double dot(const CurveShape& shape, const AxisVec& a, const AxisVec& b, unsigned axis_count) {
  double sum = 0;
  for (unsigned i = 0; i < axis_count; ++i)
    if (((shape.length_axes >> i) & 1) != 0) sum += a[i] * b[i];
  return sum;
}

/// Derivatives of u by the length: 1/sigma, -sigma'/sigma^3, (3 sigma'^2 - sigma sigma'')/sigma^5, where primes are derivatives by u.
struct ByLength {
  double u1 = 0, u2 = 0, u3 = 0;
};

ByLength by_length(const CurveShape& shape, const ByParameter& q, unsigned axis_count) {
  ByLength out;
  if (shape.what.kind == ShapeKind::sine) {
    out.u1 = 1 / shape.base.length;
    return out;
  }
  const double sigma = std::sqrt(dot(shape, q.d1, q.d1, axis_count));
  if (!(sigma > 0)) return out;
  const double s1 = dot(shape, q.d1, q.d2, axis_count) / sigma;
  const double s2 = (dot(shape, q.d2, q.d2, axis_count) + dot(shape, q.d1, q.d3, axis_count) - s1 * s1) / sigma;
  out.u1 = 1 / sigma;
  const double u1_3 = out.u1 * out.u1 * out.u1;
  out.u2 = -s1 * u1_3;
  out.u3 = (3 * s1 * s1 - sigma * s2) * u1_3 * out.u1 * out.u1;
  return out;
}

double sigma_at(const CurveShape& shape, double u, unsigned axis_count) {
  if (shape.what.kind == ShapeKind::rational) return rational_speed(shape, u);
  if (shape.what.kind == ShapeKind::spline) return spline_speed(shape, u);
  if (shape.what.kind == ShapeKind::exponential) return exponential_speed(shape, u);
  ByParameter q;
  by_parameter(shape, u, axis_count, &q);
  return std::sqrt(dot(shape, q.d1, q.d1, axis_count));
}

/// Length from `from` to `to`, by Gauss-Legendre integration with five points in each of `panels` parts.
double length_between(const CurveShape& shape, double from, double to, unsigned panels, unsigned axis_count) {
  constexpr double kNode[5] = {0.04691007703066800, 0.23076534494715845, 0.5, 0.76923465505284155, 0.95308992296933200};
  constexpr double kWeight[5] = {0.11846344252809454, 0.23931433524968324, 0.28444444444444444, 0.23931433524968324, 0.11846344252809454};
  const double part = (to - from) / panels;
  double sum = 0;
  for (unsigned n = 0; n < panels; ++n)
    for (int i = 0; i < 5; ++i) sum += kWeight[i] * sigma_at(shape, from + part * (n + kNode[i]), axis_count);
  return sum * part;
}

/// The number of parts with which the error of the length is below `fine`; at most kMost.
unsigned panels_for(const CurveShape& shape, double from, double to, double fine, unsigned axis_count) {
  constexpr unsigned kMost = 16;
  unsigned panels = 1;
  double coarse = length_between(shape, from, to, 1, axis_count);
  for (; panels < kMost; panels *= 2) {
    const double finer = length_between(shape, from, to, 2 * panels, axis_count);
    if (std::fabs(finer - coarse) <= fine) break;
    coarse = finer;
  }
  return panels;
}

double last_parameter(const CurveShape& shape) { return shape.what.kind == ShapeKind::exponential ? shape.what.exponential.end : 1.0; }

/// Quintic through value, first and second derivative at both ends of one step of length h; t in [0, 1].
double quintic(const ParameterTable& table, unsigned k, double h, double t) {
  const double p0 = table.u[k], p1 = table.u[k + 1];
  const double v0 = table.du[k] * h, v1 = table.du[k + 1] * h;
  const double a0 = table.ddu[k] * h * h * 0.5, a1 = table.ddu[k + 1] * h * h * 0.5;
  const double rest = p1 - p0 - v0 - a0, slope = v1 - v0 - 2 * a0, bend = a1 - a0;
  const double c3 = 10 * rest - 4 * slope + bend;
  const double c4 = -15 * rest + 7 * slope - 2 * bend;
  const double c5 = 6 * rest - 3 * slope + bend;
  return ((((c5 * t + c4) * t + c3) * t + a0) * t + v0) * t + p0;
}

constexpr unsigned kPieces = TableMaker::kPieces;

/// The parameter at the length s: finds the piece, then uses Newton's method in it. `at`: the length up to the beginning of each piece, which is integrated
/// in so many `panels`.
double solve_parameter(const CurveShape& shape, const double* at, const uint8_t* panels, double s, unsigned axis_count) {
  const double last = last_parameter(shape);
  unsigned k = 0;
  while (k + 1 < kPieces && at[k + 1] <= s) ++k;
  const double from = last * k / kPieces, to = last * (k + 1) / kPieces;
  const double whole = at[k + 1] - at[k];
  double u = whole > 0 ? from + (to - from) * (s - at[k]) / whole : from;
  for (int i = 0; i < 20; ++i) {
    const double sigma = sigma_at(shape, u, axis_count);
    if (!(sigma > 0)) break;
    const double step = (at[k] + length_between(shape, from, u, panels[k], axis_count) - s) / sigma;
    u = std::clamp(u - step, from, to);
    if (std::fabs(step) < 1e-15 * last) break;
  }
  return u;
}

/// One step of Newton's method from u towards the place whose length from the beginning of step k is `behind`.
double towards(const CurveShape& shape, unsigned k, double behind, double u, unsigned axis_count) {
  const double sigma = sigma_at(shape, u, axis_count);
  if (!(sigma > 0)) return u;
  const double over = length_between(shape, shape.table.u[k], u, shape.table.panels[k], axis_count) - behind;
  return std::clamp(u - over / sigma, 0.0, last_parameter(shape));
}

/// Sets how many parts and steps of Newton's method it takes to find a place in step k.
void set_effort(const CurveShape& shape, unsigned k, double fine, unsigned axis_count, ParameterTable* table) {
  constexpr unsigned kMost = 4, kLooks = 4;
  const double h = shape.base.length / ParameterTable::kSteps;
  table->panels[k] = static_cast<uint8_t>(panels_for(shape, table->u[k], table->u[k + 1], fine, axis_count));
  unsigned steps = 0;
  for (unsigned n = 1; n < kLooks; ++n) {
    const double behind = h * n / kLooks;
    double u = quintic(*table, k, h, static_cast<double>(n) / kLooks);
    for (unsigned done = 0; done <= kMost; ++done) {
      const double error = length_between(shape, table->u[k], u, table->panels[k], axis_count) - behind;
      if (std::fabs(error) <= fine) break;
      steps = std::max(steps, std::min(done + 1, kMost));
      u = towards(shape, k, behind, u, axis_count);
    }
  }
  table->newton[k] = static_cast<uint8_t>(steps);
}

/// `steps` steps of Newton's method in interval n of a divided step.
double inside_interval(const CurveShape& shape, unsigned n, double behind, unsigned steps, unsigned axis_count) {
  const ParameterTable& t = shape.table;
  const double from = t.graded_u[n], to = t.graded_u[n + 1], whole = t.behind[n + 1] - t.behind[n], wanted = behind - t.behind[n];
  double u = from + (to - from) * (whole > 0 ? wanted / whole : 0);
  for (unsigned k = 0; k < steps; ++k) {
    const double sigma = sigma_at(shape, u, axis_count);
    if (!(sigma > 0)) break;
    u = std::clamp(u - (length_between(shape, from, u, 1, axis_count) - wanted) / sigma, from, to);
  }
  return u;
}

/// Halves intervals of step k until each of them can be integrated in one part. False, and the table is as before, when there are too many intervals.
bool divide_step(const CurveShape& shape, unsigned k, double fine, unsigned axis_count, ParameterTable* table) {
  constexpr unsigned kDeepest = 40;
  ParameterTable& t = *table;
  const unsigned first = t.places;
  double ends[kDeepest + 1] = {t.u[k + 1]};  // ends of the intervals that are still to be looked at
  unsigned open = 1, n = first;
  if (first + 2 > ParameterTable::kGraded) return false;
  t.graded_u[n] = t.u[k];
  t.behind[n] = 0;
  while (open > 0) {
    const double from = t.graded_u[n], to = ends[open - 1], middle = 0.5 * (from + to);
    const double coarse = length_between(shape, from, to, 1, axis_count), finer = length_between(shape, from, to, 2, axis_count);
    if (std::fabs(coarse - finer) > fine && open <= kDeepest && middle > from && middle < to) {
      ends[open++] = middle;
      continue;
    }
    if (n + 2 > ParameterTable::kGraded) return false;
    --open;
    ++n;
    t.graded_u[n] = to;
    t.behind[n] = t.behind[n - 1] + finer;
  }
  t.first[k] = static_cast<uint8_t>(first);
  t.graded[k] = static_cast<uint8_t>(n - first);
  t.places = static_cast<uint8_t>(n + 1);
  return true;
}

/// Sets how many steps of Newton's method each interval of a divided step takes.
void set_interval_effort(const CurveShape& shape, unsigned k, double fine, unsigned axis_count, ParameterTable* table) {
  constexpr unsigned kMost = 12;
  constexpr double kLooks[] = {1e-4, 0.003, 0.05, 0.25, 0.5, 0.75, 0.95, 0.997, 1 - 1e-4};  // dense at the ends: next to a cusp the length grows as a square
  ParameterTable& t = *table;
  for (unsigned n = t.first[k]; n < unsigned{t.first[k]} + t.graded[k]; ++n) {
    t.effort[n] = 1;
    for (const double look : kLooks) {
      const double wanted = (t.behind[n + 1] - t.behind[n]) * look;
      for (unsigned steps = t.effort[n]; steps <= kMost; ++steps) {
        t.effort[n] = static_cast<uint8_t>(steps);
        const double u = inside_interval(shape, n, t.behind[n] + wanted, steps, axis_count);
        if (std::fabs(length_between(shape, t.graded_u[n], u, 1, axis_count) - wanted) <= fine) break;
      }
    }
  }
}

/// The parameter in a divided step. The length of the step was integrated more finely here than for the table, so the difference (some nm) is spread evenly
/// over the step.
double graded_parameter(const CurveShape& shape, unsigned k, double behind, unsigned axis_count) {
  const ParameterTable& t = shape.table;
  unsigned low = t.first[k], high = low + t.graded[k];
  behind *= t.behind[high] * ParameterTable::kSteps / shape.base.length;
  while (high - low > 1) {
    const unsigned middle = (low + high) / 2;
    (t.behind[middle] <= behind ? low : high) = middle;
  }
  return inside_interval(shape, low, behind, t.effort[low], axis_count);
}

}  // namespace

void TableMaker::begin(const CurveShape& shape, unsigned axis_count) {
  next_ = 0;
  about_ = length_between(shape, 0, last_parameter(shape), kPieces, axis_count);
  at_[0] = 0;
}

/// The length of one of the equal pieces of the parameter.
void TableMaker::measure(unsigned k, const CurveShape& shape, unsigned axis_count) {
  constexpr double kMeasured = 1e-13;  // share of the length: the error with which it is integrated
  const double last = last_parameter(shape), from = last * k / kPieces, to = last * (k + 1) / kPieces;
  panels_[k] = static_cast<uint8_t>(panels_for(shape, from, to, kMeasured * about_, axis_count));
  at_[k + 1] = at_[k] + length_between(shape, from, to, panels_[k], axis_count);
}

void TableMaker::place(unsigned k, unsigned axis_count, CurveShape* shape) const {
  constexpr unsigned kSteps = ParameterTable::kSteps;
  ParameterTable& table = shape->table;
  const double s = shape->base.length * k / kSteps;
  table.u[k] = k == 0 ? 0 : k == kSteps ? last_parameter(*shape) : solve_parameter(*shape, at_, panels_, s, axis_count);
  ByParameter q;
  by_parameter(*shape, table.u[k], axis_count, &q);
  const ByLength d = by_length(*shape, q, axis_count);
  table.du[k] = d.u1;
  table.ddu[k] = d.u2;
}

/// How a place within a step is found.
void TableMaker::divide(unsigned k, unsigned axis_count, CurveShape* shape) {
  constexpr double kFine = 1e-11;      // share of the length: an error of a place below this does not show, not even in third differences
  constexpr double kMeasured = 1e-13;
  constexpr unsigned kAtOnce = 4;      // a step is divided when more parts than this have to be integrated for one point
  constexpr unsigned kNear = 2;        // a step is divided when more steps of Newton's method than this are needed
  ParameterTable& table = shape->table;
  if (k == 0) table.places = 0;
  set_effort(*shape, k, kFine * shape->base.length, axis_count, &table);
  table.graded[k] = 0;
  if (table.newton[k] <= kNear && table.newton[k] * table.panels[k] <= kAtOnce) return;
  if (divide_step(*shape, k, kMeasured * shape->base.length, axis_count, &table))
    set_interval_effort(*shape, k, kFine * shape->base.length, axis_count, &table);
}

bool TableMaker::go_on(unsigned axis_count, CurveShape* shape, int64_t* cost) {
  constexpr unsigned kSteps = ParameterTable::kSteps, kPlaced = kPieces + kSteps + 1;
  constexpr int64_t kPart = 400;  // instructions, to integrate one part of a curve
  constexpr unsigned kOfPiece = 3, kOfPlace = 5, kOfStep = 8, kOfInterval = 40;  // parts that are integrated for each part and interval of the result
  const unsigned n = next_++;
  if (n < kPieces) {
    measure(n, *shape, axis_count);
    *cost = kPart * kOfPiece * panels_[n];
    if (n + 1 < kPieces) return false;
    shape->base.length = at_[kPieces];
    return !(shape->base.length > 0);
  }
  if (n < kPlaced) {
    place(n - kPieces, axis_count, shape);
    *cost = kPart * kOfPlace * panels_[std::min(2 * (n - kPieces), kPieces - 1)];
    return false;
  }
  const unsigned k = n - kPlaced;
  divide(k, axis_count, shape);
  *cost = kPart * (kOfStep * shape->table.panels[k] + kOfInterval * shape->table.graded[k]);
  return k + 1 == kSteps;
}

bool has_table(ShapeKind kind) { return kind == ShapeKind::exponential || kind == ShapeKind::rational || kind == ShapeKind::spline; }

void begin_base(const AxisVec& start, const AxisVec& end, unsigned axis_count, uint32_t rotary, CurveShape* shape) {
  Curve& base = shape->base;
  base.circular = false;
  base.shape = nullptr;
  base.start = start;
  base.end = end;
  for (unsigned i = 0; i < kMaxAxes; ++i) base.delta[i] = i < axis_count ? end[i] - start[i] : 0;
  // M700 6.11: on an exponential curve all axes make the length, because its feed is that of all axes; otherwise only the linear ones do.
  shape->length_axes = (1u << axis_count) - 1;
  if (shape->what.kind != ShapeKind::exponential) shape->length_axes &= ~rotary;
  if (shape->what.kind == ShapeKind::rational) make_powers(shape);
  if (shape->what.kind == ShapeKind::exponential) {
    const Exponential& e = shape->what.exponential;
    shape->along2 = 0;
    for (unsigned i = 0; i < axis_count; ++i)
      if (i != e.rotary) shape->along2 += base.delta[i] * base.delta[i] / (base.delta[e.linear] * base.delta[e.linear]);
  }
  if (shape->what.kind == ShapeKind::space_arc) {
    base.length = sigma_at(*shape, 0, axis_count);
    return;
  }
  if (shape->what.kind == ShapeKind::sine) {
    base.length = shape->what.arc.radius * std::fabs(shape->what.arc.sweep);
    return;
  }
}

void make_base(const AxisVec& start, const AxisVec& end, unsigned axis_count, uint32_t rotary, CurveShape* shape) {
  begin_base(start, end, axis_count, rotary, shape);
  if (!has_table(shape->what.kind)) return;
  TableMaker maker;
  maker.begin(*shape, axis_count);
  int64_t cost = 0;
  while (!maker.go_on(axis_count, shape, &cost)) {
  }
}

double base_parameter(const CurveShape& shape, double s, unsigned axis_count) {
  const double length = shape.base.length;
  if (!(s > 0)) return 0;
  if (s >= length) return last_parameter(shape);
  if (shape.what.kind == ShapeKind::space_arc || shape.what.kind == ShapeKind::sine) return s / length;
  constexpr unsigned kSteps = ParameterTable::kSteps;
  const double place = s / length * kSteps;
  const unsigned k = std::min(kSteps - 1, static_cast<unsigned>(place));
  const double behind = (place - k) * length / kSteps;
  if (shape.table.graded[k] != 0) return graded_parameter(shape, k, behind, axis_count);
  double u = quintic(shape.table, k, length / kSteps, place - k);
  for (unsigned n = 0; n < shape.table.newton[k]; ++n) u = towards(shape, k, behind, u, axis_count);
  return u;
}

AxisVec base_position(const CurveShape& shape, double u, unsigned axis_count) {
  if (shape.what.kind == ShapeKind::rational) return rational_point(shape, u);
  if (shape.what.kind == ShapeKind::spline) return spline_point(shape, u);
  ByParameter q;
  by_parameter(shape, u, axis_count, &q);
  return q.p;
}

CurvePoint base_evaluate(const CurveShape& shape, double s, unsigned axis_count) {
  const double u = base_parameter(shape, s, axis_count), last = last_parameter(shape);
  ByParameter q;
  by_parameter(shape, u, axis_count, &q);
  const AxisVec at = q.p;
  ByLength d = by_length(shape, q, axis_count);
  if (d.u1 == 0) {  // control points coincide here: the tangent is taken from the curve right beside
    constexpr double kBeside = 1e-5;
    by_parameter(shape, u + (u < 0.5 * last ? kBeside : -kBeside) * last, axis_count, &q);
    d = by_length(shape, q, axis_count);
  }
  CurvePoint out;
  out.position = at;
  for (unsigned i = 0; i < axis_count; ++i) {
    out.d1[i] = q.d1[i] * d.u1;
    out.d2[i] = q.d2[i] * d.u1 * d.u1 + q.d1[i] * d.u2;
    out.d3[i] = q.d3[i] * d.u1 * d.u1 * d.u1 + 3 * q.d2[i] * d.u1 * d.u2 + q.d1[i] * d.u3;
  }
  return out;
}

}  // namespace nc
