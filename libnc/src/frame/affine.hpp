// SPDX-License-Identifier: Apache-2.0
// Affine maps of the axes of a part system: what leads from programmed points to the compensation frame (interpret/program_map.hpp), and
// from there to machine coordinates. Moves name the latter by id, so that a move that was read long ago keeps the frame that was in
// force then.
//
// Nearly every map moves only: machine = point + offset. That is what the functions in this header do, inline; everything else is in
// affine.cpp. A map that turns does so with few axes: those that depend on each other ("coupled") are one small matrix, every other axis
// has a factor of its own. Two planes that turn independently (G68 and 13.21 of the M700 about different ones) couple four axes, a
// conversion in space three.
#pragma once

#include <cstring>

#include "stream/stream.hpp"

namespace nc {

class Affine {
 public:
  /// Axes that can depend on each other at once.
  static constexpr unsigned kMostCoupled = 4;

  /// What a rotation is made with.
  struct Angle {
    double cos = 1, sin = 0;
    /// Whole quarters are exact: a rotation by 90 degrees exchanges coordinates to the last bit.
    static Angle degrees(double angle);
    static Angle radians(double angle);
  };

  constexpr Affine() = default;  ///< every point stays where it is
  static constexpr Affine translation(const AxisVec& by) {
    Affine map;
    map.offset_ = by;
    return map;
  }
  /// One axis is stretched by `factor`, not 0, about `center`; -1 reflects it there.
  static Affine stretch(unsigned axis, double factor, double center);
  /// The axes h, v turn from h towards v about a point of theirs.
  static Affine rotation(unsigned h, unsigned v, const Angle& angle, double center_h, double center_v);

  /// `next` acts behind this. False, and nothing is changed, where more than kMostCoupled axes would depend on each other.
  [[nodiscard]] bool then(const Affine& next);
  Affine inverse() const;

  bool only_translates() const { return translates_; }
  bool translates_by(const AxisVec& by) const { return translates_ && std::memcmp(&offset_, &by, sizeof by) == 0; }
  AxisVec apply(const AxisVec& p) const {
    if (!translates_) [[unlikely]] return apply_linear(p);
    AxisVec q;
    for (unsigned i = 0; i < kMaxAxes; ++i) q[i] = p[i] + offset_[i];
    return q;
  }
  AxisVec apply_inverse(const AxisVec& q) const {
    if (!translates_) [[unlikely]] return inverse().apply_linear(q);
    AxisVec p;
    for (unsigned i = 0; i < kMaxAxes; ++i) p[i] = q[i] - offset_[i];
    return p;
  }
  /// A direction: without the offset.
  AxisVec direct(const AxisVec& direction) const;
  /// Where the origin goes.
  const AxisVec& offset() const { return offset_; }

  /// Way of axis `to` per way of axis `from`.
  double coefficient(unsigned to, unsigned from) const;
  /// Bit i: axis i is one of those that depend on each other.
  uint32_t coupled() const;
  /// Neither of the two axes depends on another one, nor another one on them: a circle about their normal stays one, if it is not stretched.
  bool keeps_plane(unsigned h, unsigned v) const;
  /// Of the plane (h, v), where it is kept: area per area, negative where its sense is turned round.
  double determinant(unsigned h, unsigned v) const;
  /// The plane is turned over: arcs go the other way round, and what was left of a path is on its right.
  bool reflects(unsigned h, unsigned v) const { return determinant(h, v) < 0; }
  /// An axis that depends on no other one: its coordinate.
  double on_axis(unsigned axis, double value) const { return stretch_[axis] * value + offset_[axis]; }

  bool operator==(const Affine& other) const {
    if (translates_) return other.translates_by(offset_);
    return !other.translates_ && std::memcmp(&offset_, &other.offset_, sizeof offset_) == 0 && same_linear(other);
  }

 private:
  AxisVec apply_linear(const AxisVec& p) const;
  bool same_linear(const Affine& other) const;

  bool translates_ = true;
  uint8_t coupled_count_ = 0;
  uint8_t axis_[kMostCoupled] = {};  ///< the coupled ones in ascending order
  AxisVec offset_;
  AxisVec stretch_{{1, 1, 1, 1, 1, 1, 1, 1}};  ///< of the axes that are not coupled; 1 for those that are
  /// Row by row, of the coupled axes; behind them that of a map that leaves everything as it is.
  double block_[kMostCoupled * kMostCoupled] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
};

}  // namespace nc
