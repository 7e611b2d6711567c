// SPDX-License-Identifier: Apache-2.0
// Following a law in time, exactly: in a cell u'' = b'/2 is linear in u, u'' = a + w (u - u_k) with w =
// b''/2, so
//     u - u_k = v S(t) + a C(t),   S = sinh(sqrt(w) t) / sqrt(w),   C = (cosh(sqrt(w) t) - 1) / w     (sin
//     and cos where w < 0).
// In the cells next to rest the jerk is constant and u is a cubic of time.
#pragma once

#include <cmath>

#include "motion/optimal/time_law.hpp"

namespace nc::optimal {

/// Place and motion in a cell.
struct CellState {
  double x = 0, v = 0, a = 0;
};

/// S(t), its derivative, and C(t).
inline void law_functions(double w, double t, double* s, double* ds, double* c) NC_RT {
  const double y = w * t * t;
  if (std::fabs(y) < 0.5) {  // the series: 1e-16 with nine terms
    double sk = 1, dk = 1, ck = 0.5, term_s = 1, term_d = 1, term_c = 0.5;
    for (unsigned k = 1; k < 9; ++k) {
      const double n = 2.0 * k;
      term_s *= y / (n * (n + 1));
      term_d *= y / ((n - 1) * n);
      term_c *= y / ((n + 1) * (n + 2));
      sk += term_s;
      dk += term_d;
      ck += term_c;
    }
    *s = t * sk;
    *ds = dk;
    *c = t * t * ck;
    return;
  }
  const double root = std::sqrt(std::fabs(w)), z = root * t;
  if (w > 0) {
    *s = std::sinh(z) / root;
    *ds = std::cosh(z);
  } else {
    *s = std::sin(z) / root;
    *ds = std::cos(z);
  }
  *c = (*ds - 1) / w;
}

/// State `t` seconds after the cell was entered.
inline CellState cell_state(const Law& law, const Mesh& mesh, unsigned k, double t) NC_RT {
  CellState q;
  if (k == 0 && mesh.from_rest) {
    const double v1 = std::sqrt(law.b[1]), whole = 3 * mesh.h[0] / v1, j = 2 * v1 / (whole * whole);
    return {j * t * t * t / 6, j * t * t / 2, j * t};
  }
  if (k == law.cells - 1) {
    const double v0 = std::sqrt(law.b[k]), whole = 3 * mesh.h[k] / v0, j = 2 * v0 / (whole * whole);
    const double left = std::fmax(0, whole - t);
    return {mesh.h[k] - j * left * left * left / 6, j * left * left / 2, -j * left};
  }
  const double v = std::sqrt(law.b[k]), a = 0.5 * law.slope[k], w = law.half2[k];
  double s, ds, c;
  law_functions(w, t, &s, &ds, &c);
  q.x = v * s + a * c;
  q.v = v * ds + a * s;
  q.a = a * ds + w * v * s;  // a + w x
  return q;
}

/// Seconds that a cell takes: the integral of dx / sqrt(b) over a quadratic b is 2 artanh(z) / sqrt(w) with z = sqrt(w) h / (v0 + v1),
/// which follows from S / (1 + cosh) = C / S = tanh(sqrt(w) t / 2) / sqrt(w).
inline double cell_seconds(const Law& law, const Mesh& mesh, unsigned k) {
  const double v0 = std::sqrt(law.b[k]), v1 = std::sqrt(law.b[k + 1]), h = mesh.h[k];
  if ((k == 0 && mesh.from_rest) || k == law.cells - 1) return 3 * h / std::fmax(v0, v1);
  const double w = law.half2[k], mean = h / (v0 + v1), y = w * mean * mean;
  if (std::fabs(y) < 0.02) {  // the series: 1e-17 with eight terms
    double sum = 0;
    for (unsigned n = 8; n-- > 0;) sum = sum * y + 1.0 / (2 * n + 1);
    return 2 * mean * sum;
  }
  const double root = std::sqrt(std::fabs(w));
  return 2 * (w > 0 ? std::atanh(root * mean) : std::atan(root * mean)) / root;
}

}  // namespace nc::optimal
