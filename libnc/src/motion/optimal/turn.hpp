// SPDX-License-Identifier: Apache-2.0
// The shape of a sharp corner: one axis stops while the other starts, each with constant jerk (docs/motion-optimal.md, "Geometry").
#pragma once

namespace nc::optimal {

// A sharp corner: q'' = (t2 - t1) K(u), so q = v + u t1 + T(u) (t2 - t1) with T'' = K. On the curve x = -c (1 - t)^3, y = c t^3 of the time t from 0
// to 1, u = x + y, it is K = 2 t (1 - t) / (3 c (t^2 + (1 - t)^2)^3). It is followed in pieces, between even times, with the cubic that has the values
// and slopes of K at both ends.
inline constexpr unsigned kTurnKnots = 4;  ///< on either side of the corner
inline constexpr unsigned kTurnPieces = 2 * kTurnKnots;

/// A piece of T for a reach of 1 on either side, by the way x behind its start at `at`: from -1 to 1.
struct TurnPiece {
  double at = 0, length = 0;
  double c[6] = {};
};

struct TurnShape {
  TurnPiece piece[kTurnPieces];
  double depth = 0;  ///< T at the corner
  // A cubic spline with the knots of the pieces has a K that is linear in each of them.
  double chord[kTurnPieces + 1] = {};  ///< its values, with the integral 1
  double rest[kTurnPieces][6] = {};    ///< T less that of the chord; with its first two derivatives it is 0 at both ends of the corner
};

constexpr TurnShape turn_shape() {
  constexpr auto way = [](double t) { return t * t * t - (1 - t) * (1 - t) * (1 - t); };
  constexpr auto even = [](double t) { return t * t + (1 - t) * (1 - t); };
  TurnShape out;
  double whole = 0, whole_chord = 0;
  for (unsigned n = 0; n < kTurnPieces; ++n) {
    double k[2] = {}, slope[2] = {};
    for (unsigned end = 0; end < 2; ++end) {
      const double t = static_cast<double>(n + end) / kTurnPieces, w = even(t);
      k[end] = 2 * t * (1 - t) / (3 * w * w * w);
      slope[end] = 2 * (1 - 2 * t) * (w + 6 * t * (1 - t)) / (9 * w * w * w * w * w);
    }
    TurnPiece& p = out.piece[n];
    p.at = way(static_cast<double>(n) / kTurnPieces);
    p.length = way(static_cast<double>(n + 1) / kTurnPieces) - p.at;
    const double h = p.length, rise = (k[1] - k[0]) / h;
    p.c[2] = k[0] / 2;
    p.c[3] = slope[0] / 6;
    p.c[4] = (3 * rise - 2 * slope[0] - slope[1]) / (12 * h);
    p.c[5] = (slope[0] + slope[1] - 2 * rise) / (20 * h * h);
    whole += h * (2 * p.c[2] + h * (3 * p.c[3] + h * (4 * p.c[4] + h * 5 * p.c[5])));
    whole_chord += h * (k[0] + k[1]) / 2;
    out.chord[n] = k[0];
  }
  for (double& k : out.chord) k /= whole_chord;
  double value = 0, slope = 0;  // the integral of K is 1, whatever the cubics have made of it
  double value_chord = 0, slope_chord = 0;
  for (unsigned n = 0; n < kTurnPieces; ++n) {
    TurnPiece& p = out.piece[n];
    const double h = p.length;
    for (unsigned j = 2; j < 6; ++j) p.c[j] /= whole;
    p.c[0] = value;
    p.c[1] = slope;
    if (n == kTurnKnots) out.depth = value;
    value += h * (slope + h * (p.c[2] + h * (p.c[3] + h * (p.c[4] + h * p.c[5]))));
    slope += h * (2 * p.c[2] + h * (3 * p.c[3] + h * (4 * p.c[4] + h * 5 * p.c[5])));
    const double k = out.chord[n], rise = (out.chord[n + 1] - k) / h;
    const double chord[6] = {value_chord, slope_chord, k / 2, rise / 6, 0, 0};
    for (unsigned j = 0; j < 6; ++j) out.rest[n][j] = p.c[j] - chord[j];
    value_chord += h * (slope_chord + h * (k / 2 + h * rise / 6));
    slope_chord += h * (k + h * rise / 2);
  }
  return out;
}
inline constexpr TurnShape kTurn = turn_shape();
/// The corner is cut by this times c |t2 - t1|.
inline constexpr double kTurnDepth = kTurn.depth;

}  // namespace nc::optimal
