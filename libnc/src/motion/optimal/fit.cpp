// SPDX-License-Identifier: Apache-2.0
#include "motion/optimal/fit.hpp"

#include <algorithm>

namespace nc::optimal {

void cell_moments(const Edges& line, double from, double to, unsigned axis_count, unsigned* edge,
                  CellMoments* out) {
  const double h = to - from;
  unsigned& e = *edge;
  while (e + 2 < line.count && line.u[e + 1] <= from) ++e;
  out->from = from;
  out->length = h;
  const double share = (from - line.u[e]) / line.length[e];
  for (unsigned i = 0; i < axis_count; ++i) {
    out->at[i] = line.vertex[e][i] + share * (line.vertex[e + 1][i] - line.vertex[e][i]);
    for (AxisVec& m : out->moment) m[i] = 0;
  }
  for (;; ++e) {
    // With c the middle of the edge and d its length, both in s: `even` are the integrals of (c + x)^n over x
    // from -d/2 to d/2, `odd` those of (c + x)^n x/d, for n = 1 to 3.
    const double a = std::max(line.u[e], from), b = std::min(line.u[e + 1], to), d = (b - a) / h;
    const double c = (0.5 * (a + b) - from) / h, q = d * d / 12;
    const double middle = (0.5 * (a + b) - line.u[e]) / line.length[e], part = (b - a) / line.length[e];
    const double even[3] = {d * c, d * (c * c + q), d * c * (c * c + 3 * q)};
    const double odd[3] = {q, 2 * c * q, 3 * c * c * q + d * d * d * d / 80};
    for (unsigned i = 0; i < axis_count; ++i) {
      const double way = line.vertex[e + 1][i] - line.vertex[e][i];
      const double mean = line.vertex[e][i] - out->at[i] + middle * way, slope = part * way;
      out->moment[0][i] += d * mean;
      for (unsigned n = 0; n < 3; ++n) out->moment[n + 1][i] += even[n] * mean + odd[n] * slope;
    }
    if (e + 2 >= line.count || line.u[e + 1] >= to) break;
  }
}

AxisVec fitted_control(const CellMoments* const cell[4], unsigned axis_count) {
  const double from = cell[0]->from, to = cell[3]->from + cell[3]->length;
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  // Polar forms of the Legendre polynomials P1 to P3, orthogonal over x from -1 to 1, at the knots; that of P0
  // is 1. The kernel of the fit, k0 + k1 x + k2 x^2 + k3 x^3, is the sum of (2n + 1) / 2 times them times Pn.
  const double x1 = (cell[1]->from - middle) / half, x2 = (cell[2]->from - middle) / half;
  const double x3 = (cell[3]->from - middle) / half;
  const double b1 = (x1 + x2 + x3) / 3, b2 = (x1 * x2 + x2 * x3 + x3 * x1 - 1) / 2;
  const double b3 = (5 * x1 * x2 * x3 - 3 * b1) / 2;
  const double k0 = 0.5 - 1.25 * b2, k1 = 1.5 * b1 - 5.25 * b3, k2 = 3.75 * b2, k3 = 8.75 * b3;
  AxisVec out = cell[0]->at;
  for (unsigned n = 0; n < 4; ++n) {
    const CellMoments& m = *cell[n];
    const double a = m.length / half, b = (m.from - middle) / half;  // x = a s + b
    const double w0 = a * (k0 + b * (k1 + b * (k2 + b * k3)));
    const double w1 = a * a * (k1 + b * (2 * k2 + b * 3 * k3));
    const double w2 = a * a * a * (k2 + 3 * b * k3), w3 = a * a * a * a * k3;
    const double whole = w0 + w1 / 2 + w2 / 3 + w3 / 4;
    for (unsigned i = 0; i < axis_count; ++i) {
      out[i] += whole * (m.at[i] - cell[0]->at[i]) + w0 * m.moment[0][i] + w1 * m.moment[1][i] +
                w2 * m.moment[2][i] + w3 * m.moment[3][i];
    }
  }
  return out;
}

}  // namespace nc::optimal
