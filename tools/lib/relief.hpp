// SPDX-License-Identifier: Apache-2.0
// The surface that dense feed moves leave: a map over X and Y with the lowest height of the path in each cell.
//
// A finishing program makes thousands of passes beside each other; drawn as lines they would be one dark patch. Where the passes are so near that a
// drawing shows no gap between them, the map has a height for every cell, and the drawing can shade it. It is the surface over which the tip of the
// tool moves, because the shape of the tool is not known here.
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

  /** Divides the rectangle from (low_x, low_y) to (high_x, high_y), mm, into square cells, kAcross of them along the longer side. */
  Relief(double low_x, double low_y, double high_x, double high_y);

  /** Adds a feed piece; `value` is kept with the heights. Pieces must be added in the order of the program. */
  void add(const Place& from, const Place& to, float value);

  /** To be called when all pieces were added: finds where they make a surface and closes the gaps between the passes. */
  void finish();

  /** Whether there is a surface at all. */
  bool any() const { return any_; }
  /** Whether there is a surface at this place in X and Y. */
  bool covers(double x, double y) const;
  /** Whether a move down to this place makes a hole in the surface, because the surface is higher all around. */
  bool is_hole(double x, double y, double z) const;
  /** The width of a cell in mm. */
  double cell_mm() const { return cell_mm_; }

  unsigned columns() const { return columns_; }
  unsigned rows() const { return rows_; }
  /** For a cell: whether it is part of the surface, its centre with its height, its value, its slope in X and Y. */
  bool covered(unsigned column, unsigned row) const { return surface_[at(column, row)] != 0; }
  Place place(unsigned column, unsigned row) const;
  float value(unsigned column, unsigned row) const { return value_[at(column, row)]; }
  void slope(unsigned column, unsigned row, double* dz_dx, double* dz_dy) const;

  static constexpr unsigned kAcross = 900;
  /** When passes are nearer than this number of cells, a drawing shows no gap between them. */
  static constexpr unsigned kGap = 8;
  /** Bands narrower than this number of cells are only some lines side by side and are drawn as lines. */
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
  std::vector<std::uint32_t> piece_;  // number of the piece that has the height of the cell; 0 = none
  Mask surface_;
};

}  // namespace nc::tools
