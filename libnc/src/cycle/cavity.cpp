// SPDX-License-Identifier: Apache-2.0
#include "cycle/cavity.hpp"

#include <algorithm>
#include <cmath>

namespace nc {
namespace {

constexpr double kSharp_mm = 1e-6;  // a corner below this is none: what is left of a radius by rounding is no arc

double least_half(const Cavity& cavity) { return cavity.circle ? cavity.half[0] : std::min(cavity.half[0], cavity.half[1]); }

CavityPiece line_to(double h, double v) {
  CavityPiece piece;
  piece.to[0] = h;
  piece.to[1] = v;
  return piece;
}

/// To and fro on the line that is left in the middle, and back to where the next ring begins.
bool middle_line(double h, double v, unsigned number, CavityPiece* piece) {
  const double end[3][2] = {{h, v}, {-h, -v}, {h, 0}};
  if (number >= 3 || (h == 0 && v == 0)) return false;
  *piece = line_to(end[number][0], end[number][1]);
  return true;
}

bool round_circle(const Cavity& cavity, double radius, unsigned number, CavityPiece* piece) {
  if (number >= 2) return false;
  *piece = line_to(radius, 0);
  piece->arc = number == 1;
  piece->ccw = cavity.ccw;
  return true;
}

/// From the middle of the first axis' positive side round the rectangle: even numbers are its sides, odd ones its corners.
bool round_rectangle(const Cavity& cavity, double h, double v, double corner, unsigned nth, CavityPiece* piece) {
  constexpr unsigned kPieces = 10;
  if (nth >= kPieces) return false;
  if (nth == 0 || nth == 9) {
    *piece = line_to(h, 0);
    return true;
  }
  const unsigned quadrant = (nth - 1) / 2;  // of the corner, counted in the direction of travel
  const double along = quadrant == 0 || quadrant == 3 ? 1 : -1;
  const double across = (quadrant < 2 ? 1 : -1) * (cavity.ccw ? 1.0 : -1.0);
  const bool into = nth % 2 == 1, side_of_v = quadrant % 2 == 0;  // the side that leads to this corner runs along the second axis
  const double a = along * (h - corner), b = across * (v - corner);
  *piece = into == side_of_v ? line_to(along * h, b) : line_to(a, across * v);
  piece->arc = !into && corner > 0;
  piece->ccw = cavity.ccw;
  piece->center[0] = a;
  piece->center[1] = b;
  return true;
}

}  // namespace

double widest_step_round_corners(double cutter) { return (1 + std::sqrt(0.5)) * cutter; }

uint32_t rings_of_cavity(const Cavity& cavity, double step) {
  const double rings = std::ceil(least_half(cavity) / step - 1e-9);
  return rings > 0 ? static_cast<uint32_t>(std::min(rings, 1e6)) : 0;
}

bool piece_of_cavity(const Cavity& cavity, uint32_t ring, unsigned number, CavityPiece* piece) {
  const double least = least_half(cavity);
  const double inset = cavity.rings == 0 ? least : least * (cavity.rings - ring) / cavity.rings;
  const double h = cavity.half[0] - inset, v = cavity.half[1] - inset;
  if (cavity.circle) return ring != 0 && round_circle(cavity, h, number, piece);
  if (ring == 0) return middle_line(std::max(h, 0.0), std::max(v, 0.0), number, piece);
  const double corner = cavity.corner - inset;
  return round_rectangle(cavity, h, v, corner > kSharp_mm ? corner : 0, number, piece);
}

}  // namespace nc
