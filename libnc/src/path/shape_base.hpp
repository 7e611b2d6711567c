// SPDX-License-Identifier: Apache-2.0
// The curves of path/shape.hpp in programmed coordinates: their derivatives by their own parameter u, and u as a function of the length.
#pragma once

#include "path/shape.hpp"

namespace nc {

/// Sets start, end, length and table of a shape whose kind is not `plain`.
void make_base(const AxisVec& start, const AxisVec& end, unsigned axis_count, uint32_t rotary, CurveShape* shape);
/// The parameter u at the length s.
double base_parameter(const CurveShape& shape, double s, unsigned axis_count) NC_RT;
AxisVec base_position(const CurveShape& shape, double u, unsigned axis_count) NC_RT;
CurvePoint base_evaluate(const CurveShape& shape, double s, unsigned axis_count) NC_RT;

}  // namespace nc
