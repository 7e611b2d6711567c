// SPDX-License-Identifier: Apache-2.0
#include "motion/optimal/tube_fit.hpp"

#include <algorithm>
#include <cmath>

namespace nc::optimal {
namespace {

/// Of the weight that the third derivative gives a control point, which the places of a cell share: with more the steps are shorter, with less
/// the places come into their tube later.
constexpr double kPenalty = 2;

}  // namespace

void TubeFit::begin(unsigned first, unsigned count, unsigned axis_count) {
  first_ = first;
  count_ = std::min(count, kControls);
  axis_count_ = axis_count;
  places_ = 0;
  for (unsigned n = 0; n < count_; ++n) {
    for (double& b : band_[n]) b = 0;
    for (unsigned i = 0; i < axis_count_; ++i) known_[n][i] = 0;
  }
}

/// weight times the square of a sum of the four control points of a cell, for the matrix and the right side.
void TubeFit::add(unsigned cell, const double row[4], double weight, const AxisVec* control) {
  for (unsigned a = 0; a < 4; ++a) {
    if (!moves(cell + a)) continue;
    const unsigned n = cell + a - first_;
    for (unsigned b = 0; b < 4; ++b) {
      const double both = weight * row[a] * row[b];
      if (moves(cell + b)) {
        if (b <= a) band_[n][a - b] += both;
      } else {
        for (unsigned i = 0; i < axis_count_; ++i) known_[n][i] -= both * control[cell + b][i];
      }
    }
  }
}

void TubeFit::add_third(unsigned cell, const double third[4], double weight, const AxisVec* control) {
  add(cell, third, weight, control);
}

bool TubeFit::add_place(unsigned cell, const double basis[4], const AxisVec& line, double radius) {
  if (places_ == kPlaces) return false;
  Place& p = place_[places_++];
  std::copy(basis, basis + 4, p.basis);
  p.line = line;
  p.dual = {};
  p.radius = radius;
  p.cell = cell;
  return true;
}

/// The places of a cell share the mean of what its control points have on the diagonal.
void TubeFit::weigh() {
  for (unsigned from = 0, to = 0; from < places_; from = to) {
    const unsigned cell = place_[from].cell;
    double sum = 0;
    unsigned counted = 0;
    for (unsigned j = cell; j < cell + 4; ++j)
      if (moves(j)) sum += band_[j - first_][0], ++counted;
    while (to < places_ && place_[to].cell == cell) ++to;
    for (unsigned m = from; m < to; ++m) place_[m].weight = kPenalty * sum / (std::max(counted, 1u) * (to - from));
  }
}

/// Cholesky's factor, in place.
bool TubeFit::factorize() {
  for (unsigned n = 0; n < count_; ++n) {
    for (unsigned d = std::min(n, 3u); d > 0; --d) {
      double sum = band_[n][d];
      for (unsigned l = d + 1; l <= std::min(n, 3u); ++l) sum -= band_[n][l] * band_[n - d][l - d];
      band_[n][d] = sum / band_[n - d][0];
    }
    double sum = band_[n][0];
    for (unsigned l = 1; l <= std::min(n, 3u); ++l) sum -= band_[n][l] * band_[n][l];
    if (!(sum > 0)) return false;
    band_[n][0] = std::sqrt(sum);
  }
  return true;
}

bool TubeFit::prepare(const AxisVec* control) {
  weigh();
  for (unsigned m = 0; m < places_; ++m) add(place_[m].cell, place_[m].basis, place_[m].weight, control);
  return factorize();
}

void TubeFit::begin_step() { std::copy(known_, known_ + count_, right_); }

/// Each place goes to the nearest point of its ball, with what it was moved by before (its multiplier).
void TubeFit::pass(unsigned from, unsigned to, const AxisVec* control) {
  for (unsigned m = from; m < std::min(to, places_); ++m) {
    Place& p = place_[m];
    double off[kMaxAxes], size = 0;
    for (unsigned i = 0; i < axis_count_; ++i) {
      off[i] = p.dual[i] - p.line[i];
      for (unsigned b = 0; b < 4; ++b) off[i] += p.basis[b] * control[p.cell + b][i];
      size += off[i] * off[i];
    }
    const double share = size > p.radius * p.radius ? p.radius / std::sqrt(size) : 1;
    for (unsigned i = 0; i < axis_count_; ++i) {
      p.dual[i] = off[i] * (1 - share);
      const double wanted = p.weight * (p.line[i] + off[i] * share - p.dual[i]);
      for (unsigned b = 0; b < 4; ++b)
        if (moves(p.cell + b)) right_[p.cell + b - first_][i] += p.basis[b] * wanted;
    }
  }
}

void TubeFit::solve(AxisVec* control) {
  for (unsigned n = 0; n < count_; ++n)
    for (unsigned i = 0; i < axis_count_; ++i) {
      double sum = right_[n][i];
      for (unsigned d = 1; d <= std::min(n, 3u); ++d) sum -= band_[n][d] * right_[n - d][i];
      right_[n][i] = sum / band_[n][0];
    }
  for (unsigned n = count_; n-- > 0;)
    for (unsigned i = 0; i < axis_count_; ++i) {
      double sum = right_[n][i];
      for (unsigned d = 1; d <= 3 && n + d < count_; ++d) sum -= band_[n + d][d] * right_[n + d][i];
      right_[n][i] = sum / band_[n][0];
      control[first_ + n][i] = right_[n][i];
    }
}

void TubeFit::tighten(unsigned cell, double share, unsigned* place) {
  while (*place < places_ && place_[*place].cell < cell) ++*place;
  for (; *place < places_ && place_[*place].cell == cell; ++*place) place_[*place].radius *= share;
}

}  // namespace nc::optimal
