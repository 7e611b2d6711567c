// SPDX-License-Identifier: Apache-2.0
#include "path/shape_ahead.hpp"

#include <cstring>

namespace nc {
namespace {

template <class T, size_t n>
bool same(const T (&a)[n], const T (&b)[n]) {
  return std::memcmp(a, b, sizeof a) == 0;
}

/// Of kinds that have a table; to the last bit. What a degree or a map does not use may differ, and then the table is made once more.
bool same_curve(const MoveShape& a, const MoveShape& b) {
  if (a.kind != b.kind || std::memcmp(&a.map, &b.map, sizeof a.map) != 0) return false;
  if (a.kind == ShapeKind::rational)
    return a.span.degree == b.span.degree && same(a.span.point, b.span.point) && same(a.span.weight, b.span.weight) && same(a.span.axis, b.span.axis);
  if (a.kind == ShapeKind::spline) return same(a.spline.c, b.spline.c) && same(a.spline.axis, b.spline.axis);
  const Exponential &x = a.exponential, &y = b.exponential;
  return x.k == y.k && x.d == y.d && x.end == y.end && x.degrees_per_rad == y.degrees_per_rad && x.linear == y.linear && x.rotary == y.rotary;
}

}  // namespace

bool ShapeAhead::is(const MoveShape& what, const PlainMove& move) const {
  return begun_ && same_curve(shape_.what, what) && shape_.base.start == *move.start && shape_.base.end == *move.end;
}

bool ShapeAhead::go_on(const MoveShape& what, const PlainMove& move, unsigned axis_count, uint32_t rotary, int64_t* left) {
  if (!has_table(what.kind)) return true;
  if (!is(what, move)) {
    constexpr int64_t kBeginCost = 25000;
    shape_ = {};
    shape_.what = what;
    begin_base(*move.start, *move.end, axis_count, programmed_degrees(what.map, rotary), &shape_);
    maker_.begin(shape_, axis_count);
    begun_ = true;
    made_ = false;
    *left -= kBeginCost;
  }
  while (!made_ && *left > 0) {
    int64_t cost = 0;
    made_ = maker_.go_on(axis_count, &shape_, &cost);
    *left -= cost;
  }
  return made_;
}

bool ShapeAhead::give(const PlainMove& move, CurveShape* shape) const {
  if (!made_ || !is(shape->what, move)) return false;
  const MoveShape what = shape->what;
  const Affine to_machine = shape->to_machine;
  *shape = shape_;
  shape->what = what;
  shape->to_machine = to_machine;
  return true;
}

}  // namespace nc
