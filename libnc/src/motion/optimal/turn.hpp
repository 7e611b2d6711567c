// SPDX-License-Identifier: Apache-2.0
// The shape of a sharp corner: one axis stops while the other starts, each with constant jerk (docs/motion-optimal.md, "Geometry").
#pragma once

namespace nc::optimal {

// A sharp corner: q'' = (t2 - t1) K(u), K linear between its knots. On the curve x = -c (1 - t)^3, y = c t^3,
// u = x + y, it would be K = 2 t (1 - t) / (3 c (t^2 + (1 - t)^2)^3); these are its values at u = c times
// kTurnAt, so normalised that its integral is 1.
inline constexpr unsigned kTurnKnots = 7;  ///< on either side of the corner
inline constexpr double kTurnAt[kTurnKnots + 1] = {0, 0.1, 0.2, 0.32, 0.45, 0.6, 0.78, 1};
inline constexpr double kTurnK[kTurnKnots + 1] = {1.3333, 1.2431, 1.0217, 0.7089, 0.4312, 0.2172, 0.0784, 0};

/// Integrals of K and of u K over one side.
struct TurnIntegrals {
  double whole = 0, moment = 0;
};
constexpr TurnIntegrals turn_integrals() {
  TurnIntegrals sum;
  for (unsigned n = 0; n < kTurnKnots; ++n) {
    const double a = kTurnAt[n], b = kTurnAt[n + 1], ka = kTurnK[n], kb = kTurnK[n + 1];
    sum.whole += (b - a) * (ka + kb) / 2;
    sum.moment += (b - a) / 6 * (a * (2 * ka + kb) + b * (ka + 2 * kb));
  }
  return sum;
}
inline constexpr double kTurnScale = 0.5 / turn_integrals().whole;
/// The corner is cut by this times c |t2 - t1|.
inline constexpr double kTurnDepth = turn_integrals().moment * kTurnScale;

}  // namespace nc::optimal
