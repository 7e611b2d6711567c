// SPDX-License-Identifier: Apache-2.0
// The surface that dense feed moves leave: a height map over X and Y of the lowest place of the path.
//
// A finishing program lays thousands of passes beside each other; as lines they are one patch of ink. Where the passes lie so near that a
// drawing shows no gap between them, the map has a height for every cell, and the drawing can shade it. It is the surface that the tool's
// tip runs over: the shape of the tool is not known here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nc::tools {

class Relief {
 public:
  struct Place {
    double x, y, z;  // mm
  };

  /** Cells over the rectangle from (low_x, low_y) to (high_x, high_y), mm; square ones, kAcross along the longer side. */
  Relief(double low_x, double low_y, double high_x, double high_y);

  /** A feed piece; `value` is kept with the heights. Pieces come in the order of the program. */
  void add(const Place& from, const Place& to, float value);

  /** All pieces are in: finds where they make a surface and closes the gaps between the passes. */
  void finish();

  /** Whether there is a surface at all. */
  bool any() const { return any_; }
  /** Whether the surface goes through above or below this place. */
  bool covers(double x, double y) const;
  /** Whether a move down to this place is a hole in the surface: that is higher all around. */
  bool is_hole(double x, double y, double z) const;
  /** mm, the width of a cell. */
  double cell_mm() const { return cell_mm_; }

  unsigned columns() const { return columns_; }
  unsigned rows() const { return rows_; }
  /** A cell: whether it is of the surface, its centre with its height, its value, its slope in X and Y. */
  bool covered(unsigned column, unsigned row) const { return surface_[at(column, row)] != 0; }
  Place place(unsigned column, unsigned row) const;
  float value(unsigned column, unsigned row) const { return value_[at(column, row)]; }
  void slope(unsigned column, unsigned row, double* dz_dx, double* dz_dy) const;

  static constexpr unsigned kAcross = 900;
  /** Passes nearer than this many cells have nothing between them that a drawing shows. */
  static constexpr unsigned kGap = 8;
  /** Narrower bands are some lines side by side and stay lines. */
  static constexpr unsigned kNarrowest = 61;

 private:
  using Mask = std::vector<std::uint8_t>;
  size_t at(unsigned column, unsigned row) const { return size_t{row} * columns_ + column; }
  Mask grown(const Mask& mask, unsigned by) const;
  Mask shrunk(const Mask& mask, unsigned by) const;
  void drop_what_was_cut_off();
  bool stands_above_its_sides(unsigned column, unsigned row) const;
  bool stands_alone(unsigned column, unsigned row) const;
  void fill();
  void smooth();

  double low_x_, low_y_, cell_mm_;
  unsigned columns_, rows_;
  bool any_ = false;
  std::uint32_t pieces_ = 0;
  std::vector<float> height_, value_;
  std::vector<std::uint32_t> piece_;  // that has left the height; 0 = none
  Mask surface_;
};

}  // namespace nc::tools
