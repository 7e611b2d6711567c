// SPDX-License-Identifier: Apache-2.0
// See relief.hpp.
#include "tools/lib/relief.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace nc::tools {
namespace {

constexpr unsigned kBorder = 2 * Relief::kGap;  // cells around the rectangle, so that growing and shrinking need not handle its edges
constexpr int kDirections[4][2] = {{1, 0}, {0, 1}, {1, 1}, {1, -1}};

}  // namespace

Relief::Relief(double low_x, double low_y, double high_x, double high_y)
    : cell_mm_(std::max({high_x - low_x, high_y - low_y, 1e-6}) / kAcross) {
  low_x_ = low_x - kBorder * cell_mm_;
  low_y_ = low_y - kBorder * cell_mm_;
  columns_ = static_cast<unsigned>((high_x - low_x) / cell_mm_) + 2 * kBorder + 1;
  rows_ = static_cast<unsigned>((high_y - low_y) / cell_mm_) + 2 * kBorder + 1;
  const size_t cells = size_t{columns_} * rows_;
  height_.assign(cells, 0.0F);
  value_.assign(cells, 0.0F);
  piece_.assign(cells, 0);
}

void Relief::add(const Place& from, const Place& to, float value) {
  ++pieces_;
  // Steps of half a cell miss no cell along the way. A piece that would need more than kMostSteps is longer than the rectangle.
  constexpr double kMostSteps = 4.0 * kAcross;
  const auto steps = static_cast<unsigned>(std::min(kMostSteps, std::ceil(2.0 * std::hypot(to.x - from.x, to.y - from.y) / cell_mm_)));
  for (unsigned k = 0; k <= steps; ++k) {
    const double t = steps > 0 ? static_cast<double>(k) / steps : 1.0;
    const double column = (from.x + t * (to.x - from.x) - low_x_) / cell_mm_, row = (from.y + t * (to.y - from.y) - low_y_) / cell_mm_;
    if (!(column >= 0 && row >= 0 && column < columns_ && row < rows_)) continue;
    const size_t cell = at(static_cast<unsigned>(column), static_cast<unsigned>(row));
    const double lowest = steps > 0 ? from.z + t * (to.z - from.z) : std::min(from.z, to.z);
    const float z = static_cast<float>(lowest);
    if (piece_[cell] != 0 && z > height_[cell]) continue;
    height_[cell] = z;
    value_[cell] = value;
    piece_[cell] = pieces_;
  }
}

// The mask enlarged by all cells that are at most `by` columns and rows away from it: first along the rows, then along the columns.
Relief::Mask Relief::grown(const Mask& mask, unsigned by) const {
  Mask along(mask.size(), 0), out(mask.size(), 0);
  const auto sweep = [by](const Mask& in, Mask* to, size_t start, size_t step, unsigned count) {
    unsigned reach = 0;  // number of cells that the last set cell still covers, first forwards and then backwards
    for (unsigned i = 0; i < count; ++i) {
      reach = in[start + i * step] ? by + 1 : reach - (reach > 0);
      if (reach > 0) (*to)[start + i * step] = 1;
    }
    reach = 0;
    for (unsigned i = count; i-- > 0;) {
      reach = in[start + i * step] ? by + 1 : reach - (reach > 0);
      if (reach > 0) (*to)[start + i * step] = 1;
    }
  };
  for (unsigned row = 0; row < rows_; ++row) sweep(mask, &along, at(0, row), 1, columns_);
  for (unsigned column = 0; column < columns_; ++column) sweep(along, &out, column, columns_, rows_);
  return out;
}

Relief::Mask Relief::shrunk(const Mask& mask, unsigned by) const {
  Mask out(mask.size());
  for (size_t i = 0; i < mask.size(); ++i) out[i] = mask[i] ? 0 : 1;
  out = grown(out, by);
  for (std::uint8_t& cell : out) cell = cell ? 0 : 1;
  return out;
}

// True for a cell of a path that is not part of the surface. Between the passes of finishing the map still has passes of roughing, although their
// material has been cut off, and feed moves that lead above the surface from one place to another.
bool Relief::stands_above_its_sides(unsigned column, unsigned row) const {
  const size_t cell = at(column, row);
  unsigned lower = 0;
  for (const auto& way : kDirections) {
    bool is_lower[2] = {false, false}, is_later[2] = {false, false};
    for (int side = 0; side < 2; ++side)
      for (int k = 1; k <= static_cast<int>(kGap) && !is_later[side]; ++k) {
        const int sign = side == 0 ? k : -k;
        const long c = long{column} + sign * way[0], r = long{row} + sign * way[1];
        if (c < 0 || r < 0 || c >= long{columns_} || r >= long{rows_}) break;
        const size_t other = at(static_cast<unsigned>(c), static_cast<unsigned>(r));
        // On this side it goes down from here more steeply than 45 degrees. On a slope of the part it would go up on the other side.
        if (piece_[other] == 0 || height_[cell] - height_[other] <= static_cast<float>((k + 1) * cell_mm_)) continue;
        is_lower[side] = true;
        is_later[side] = piece_[other] > piece_[cell];
      }
    if (is_later[0] && is_later[1]) return true;  // the cells on both sides are lower and were cut later
    lower += is_lower[0] && is_lower[1];
  }
  return lower >= 3 && stands_alone(column, row);
}

// True when the cell belongs to a line with few cells of the same height around it. A rib or a crest of the part is wider.
bool Relief::stands_alone(unsigned column, unsigned row) const {
  constexpr unsigned kAlike = 10;  // percent of the cells around it that may have the same height
  constexpr long kAround = kGap;
  const size_t cell = at(column, row);
  unsigned alike = 0;
  for (long r = long{row} - kAround; r <= long{row} + kAround; ++r)
    for (long c = long{column} - kAround; c <= long{column} + kAround; ++c) {
      if (c < 0 || r < 0 || c >= long{columns_} || r >= long{rows_}) continue;
      const size_t other = at(static_cast<unsigned>(c), static_cast<unsigned>(r));
      if (piece_[other] == 0) continue;
      const long away = std::max(std::labs(c - long{column}), std::labs(r - long{row}));
      alike += std::fabs(height_[other] - height_[cell]) <= static_cast<float>(static_cast<double>(away + 1) * cell_mm_);
    }
  return 100 * alike < kAlike * (2 * kGap + 1) * (2 * kGap + 1);
}

void Relief::drop_what_was_cut_off() {
  Mask drop(piece_.size(), 0);
  for (unsigned row = 0; row < rows_; ++row)
    for (unsigned column = 0; column < columns_; ++column)
      if (piece_[at(column, row)] != 0 && stands_above_its_sides(column, row)) drop[at(column, row)] = 1;
  for (size_t i = 0; i < drop.size(); ++i)
    if (drop[i]) piece_[i] = 0;
}

// Sets the heights between the passes: first to that of the nearest pass, then they are relaxed until the surface is straight from pass to pass. The heights of
// the passes do not change.
void Relief::fill() {
  std::vector<unsigned> steps(piece_.size(), UINT32_MAX);
  std::vector<size_t> front, next;
  for (size_t i = 0; i < piece_.size(); ++i) {
    if (!surface_[i] || piece_[i] == 0) continue;
    steps[i] = 0;
    front.push_back(i);
  }
  for (; !front.empty(); front.swap(next)) {
    next.clear();
    for (const size_t i : front)
      for (const size_t other : {i - 1, i + 1, i - columns_, i + columns_}) {
        if (!surface_[other] || steps[other] != UINT32_MAX) continue;
        steps[other] = steps[i] + 1;
        height_[other] = height_[i];
        value_[other] = value_[i];
        next.push_back(other);
      }
  }
  std::vector<size_t> open;
  for (size_t i = 0; i < piece_.size(); ++i)
    if (surface_[i] && piece_[i] == 0) open.push_back(i);
  constexpr unsigned kSweeps = 3 * kGap;
  for (unsigned sweep = 0; sweep < kSweeps; ++sweep)
    for (const size_t i : open) {
      float sum = 0;
      unsigned count = 0;
      for (const size_t other : {i - 1, i + 1, i - columns_, i + columns_}) {
        if (!surface_[other]) continue;
        sum += height_[other];
        ++count;
      }
      if (count > 0) height_[i] = sum / static_cast<float>(count);
    }
}

// A pass may lie anywhere in its cell. On a slope that makes steps of up to the height of a cell, which light from the side would show as
// stripes. Taking the mean over 3 x 3 cells of the surface twice removes them, and widens an edge by at most two cells.
void Relief::smooth() {
  for (int round = 0; round < 2; ++round) {
    const std::vector<float> before = height_;
    for (size_t i = 0; i < height_.size(); ++i) {
      if (!surface_[i]) continue;
      float sum = 0;
      unsigned count = 0;
      for (const size_t row : {i - columns_, i, i + columns_})
        for (size_t k = row - 1; k <= row + 1; ++k) {
          if (!surface_[k]) continue;
          sum += before[k];
          ++count;
        }
      height_[i] = sum / static_cast<float>(count);
    }
  }
}

void Relief::finish() {
  drop_what_was_cut_off();
  Mask touched(piece_.size());
  for (size_t i = 0; i < piece_.size(); ++i) touched[i] = piece_[i] != 0;
  const Mask closed = shrunk(grown(touched, kGap / 2), kGap / 2);
  // Shrinking removes narrow bands; growing again restores the rest, with its corners.
  const Mask wide = shrunk(closed, kNarrowest / 2);
  surface_ = grown(wide, kNarrowest / 2 + kGap);
  for (size_t i = 0; i < surface_.size(); ++i) surface_[i] = surface_[i] && closed[i];
  surface_ = grown(shrunk(surface_, 1), 1);
  any_ = std::find(surface_.begin(), surface_.end(), 1) != surface_.end();
  if (!any_) return;
  fill();
  smooth();
}

bool Relief::covers(double x, double y) const {
  const double column = (x - low_x_) / cell_mm_, row = (y - low_y_) / cell_mm_;
  if (!any_ || !(column >= 0 && row >= 0 && column < columns_ && row < rows_)) return false;
  return covered(static_cast<unsigned>(column), static_cast<unsigned>(row));
}

bool Relief::is_hole(double x, double y, double z) const {
  constexpr int kAside = 4;  // cells; at this distance the smoothing has not blurred the hole
  const double column = (x - low_x_) / cell_mm_, row = (y - low_y_) / cell_mm_;
  for (const auto& way : {std::pair{-kAside, 0}, std::pair{kAside, 0}, std::pair{0, -kAside}, std::pair{0, kAside}}) {
    const double c = column + way.first, r = row + way.second;
    if (!(c >= 0 && r >= 0 && c < columns_ && r < rows_)) return true;
    const size_t cell = at(static_cast<unsigned>(c), static_cast<unsigned>(r));
    if (surface_[cell] && height_[cell] < z + kAside * cell_mm_) return false;
  }
  return true;
}

Relief::Place Relief::place(unsigned column, unsigned row) const {
  return {low_x_ + (column + 0.5) * cell_mm_, low_y_ + (row + 0.5) * cell_mm_, double{height_[at(column, row)]}};
}

void Relief::slope(unsigned column, unsigned row, double* dz_dx, double* dz_dy) const {
  // The slope between the two neighbours; a neighbour that is not part of the surface is replaced by the cell itself.
  const auto between = [&](size_t low, size_t here, size_t high) {
    const size_t from = surface_[low] ? low : here, to = surface_[high] ? high : here;
    const int cells = (from != here) + (to != here);
    return cells == 0 ? 0.0 : double{height_[to] - height_[from]} / (cells * cell_mm_);
  };
  const size_t i = at(column, row);
  *dz_dx = between(i - 1, i, i + 1);
  *dz_dy = between(i - columns_, i, i + columns_);
}

}  // namespace nc::tools
