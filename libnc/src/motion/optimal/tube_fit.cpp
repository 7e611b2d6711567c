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

TubeFit::Wide TubeFit::wide(const AxisVec& v) {
  Wide out;
  for (unsigned i = 0; i < kMaxAxes; ++i) out.group[i / 4][i % 4] = v[i];
  return out;
}

void TubeFit::begin(unsigned first, unsigned count, unsigned axis_count) {
  first_ = first;
  count_ = std::min(count, kControls);
  axis_count_ = axis_count;
  places_ = 0;
  for (unsigned n = 0; n < count_; ++n) {
    for (double& b : band_[n]) b = 0;
    known_[n] = {};
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
        const Wide at = wide(control[cell + b]);
        for (unsigned g = 0; g < kGroups; ++g) known_[n].group[g] -= all(both) * at.group[g];
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
  p.line = wide(line);
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
template <unsigned groups>
[[gnu::always_inline]] inline void TubeFit::pass_of(unsigned from, unsigned to, const AxisVec* control) {
  for (unsigned m = from; m < to; ++m) {
    Place& p = place_[m];
    Four off[groups], size{};
    for (unsigned g = 0; g < groups; ++g) {
      off[g] = p.dual.group[g] - p.line.group[g];
      for (unsigned b = 0; b < 4; ++b) off[g] += all(p.basis[b]) * four_of(control[p.cell + b].v + 4 * g);
      size += off[g] * off[g];
    }
    const double size2 = sum(size), share = size2 > p.radius * p.radius ? p.radius / std::sqrt(size2) : 1;
    for (unsigned g = 0; g < groups; ++g) {
      p.dual.group[g] = off[g] * all(1 - share);
      const Four wanted = all(p.weight) * (p.line.group[g] + off[g] * all(share) - p.dual.group[g]);
      for (unsigned b = 0; b < 4; ++b)
        if (moves(p.cell + b)) right_[p.cell + b - first_].group[g] += all(p.basis[b]) * wanted;
    }
  }
}

NC_FOR_WIDE_VECTORS void TubeFit::pass(unsigned from, unsigned to, const AxisVec* control) {
  static_assert(kMaxAxes % 4 == 0);
  to = std::min(to, places_);
  axis_count_ <= 4 ? pass_of<1>(from, to, control) : pass_of<kGroups>(from, to, control);
}

NC_FOR_WIDE_VECTORS void TubeFit::solve(AxisVec* control) {
  const unsigned groups = (axis_count_ + 3) / 4;
  for (unsigned n = 0; n < count_; ++n) {
    const double per = 1 / band_[n][0];
    for (unsigned g = 0; g < groups; ++g) {
      Four sum = right_[n].group[g];
      for (unsigned d = 1; d <= std::min(n, 3u); ++d) sum -= all(band_[n][d]) * right_[n - d].group[g];
      right_[n].group[g] = sum * all(per);
    }
  }
  for (unsigned n = count_; n-- > 0;) {
    const double per = 1 / band_[n][0];
    for (unsigned g = 0; g < groups; ++g) {
      Four sum = right_[n].group[g];
      for (unsigned d = 1; d <= 3 && n + d < count_; ++d) sum -= all(band_[n + d][d]) * right_[n + d].group[g];
      right_[n].group[g] = sum * all(per);
      for (unsigned i = 4 * g; i < std::min(axis_count_, 4 * g + 4); ++i) control[first_ + n][i] = right_[n].group[g][i % 4];
    }
  }
}

void TubeFit::tighten(unsigned cell, double share, unsigned* place) {
  while (*place < places_ && place_[*place].cell < cell) ++*place;
  for (; *place < places_ && place_[*place].cell == cell; ++*place) place_[*place].radius *= share;
}

}  // namespace nc::optimal
