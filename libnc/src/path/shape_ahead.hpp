// SPDX-License-Identifier: Apache-2.0
// The table of a curve takes some hundred thousand instructions. Who wants to have the processor back before has it made here, little by little, ahead of
// make_shaped(), which then takes what is there. It hangs on the curve as it is programmed and on nothing else, so what has become of the program meanwhile
// does not matter: a table of another curve is not taken.
#pragma once

#include "path/shape_base.hpp"

namespace nc {

class ShapeAhead {
 public:
  /// Makes a part of what make_shaped() will need for this move, and subtracts from `left` what it takes, in instructions. @return whether all is there
  bool go_on(const MoveShape& what, const PlainMove& move, unsigned axis_count, uint32_t rotary, int64_t* left);
  /// Gives the base of `shape`, whose `what` is set, if it is what was made last.
  bool give(const PlainMove& move, CurveShape* shape) const;

 private:
  bool is(const MoveShape& what, const PlainMove& move) const;

  CurveShape shape_;
  TableMaker maker_;
  bool begun_ = false, made_ = false;
};

}  // namespace nc
