// SPDX-License-Identifier: Apache-2.0
// The curves of path/shape.hpp in programmed coordinates: their derivatives by their own parameter u, and u as a function of the length.
#pragma once

#include "path/shape.hpp"

namespace nc {

/// Makes the table and the length of a curve little by little.
class TableMaker {
 public:
  static constexpr unsigned kPieces = 64;  ///< equal pieces of the parameter in which the whole length is integrated

  /// `shape`: what begin_base() has made of it.
  void begin(const CurveShape& shape, unsigned axis_count);
  /// A part of the work: a piece is measured, a place of the table is found, or one of its steps is looked at. @return whether the table is made
  /// @param cost  about what that took, in instructions
  bool go_on(unsigned axis_count, CurveShape* shape, int64_t* cost);

 private:
  void measure(unsigned k, const CurveShape& shape, unsigned axis_count);
  void place(unsigned k, unsigned axis_count, CurveShape* shape) const;
  void divide(unsigned k, unsigned axis_count, CurveShape* shape);

  double at_[kPieces + 1];   ///< length up to the beginning of each piece
  uint8_t panels_[kPieces];  ///< parts in which it is integrated
  double about_ = 0;         ///< the whole length, nearly
  unsigned next_ = 0;
};

/// The length of such a curve comes from a table.
bool has_table(ShapeKind kind);
/// Sets start, end, and what else needs no table, of a shape whose kind is not `plain`.
void begin_base(const AxisVec& start, const AxisVec& end, unsigned axis_count, uint32_t rotary, CurveShape* shape);
/// The same with length and table.
void make_base(const AxisVec& start, const AxisVec& end, unsigned axis_count, uint32_t rotary, CurveShape* shape);
/// The parameter u at the length s.
double base_parameter(const CurveShape& shape, double s, unsigned axis_count) NC_RT;
AxisVec base_position(const CurveShape& shape, double u, unsigned axis_count) NC_RT;
CurvePoint base_evaluate(const CurveShape& shape, double s, unsigned axis_count) NC_RT;

}  // namespace nc
