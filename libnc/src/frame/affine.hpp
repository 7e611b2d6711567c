// SPDX-License-Identifier: Apache-2.0
// Affine maps of the axes of a part system: from programmed points to the compensation frame (interpret/program_map.hpp), and from there to machine
// coordinates. Moves name the latter map by its id, so that a move which was read long ago keeps the map that was in force then.
//
// Nearly every map only shifts: machine = point + offset. The inline functions in this header do that; everything else is in affine.cpp. A map that
// rotates concerns few axes: those that depend on each other ("coupled") have one small matrix, every other axis has a factor of its own. Two
// independent rotations in different planes (G68 and 13.21 of the M700) couple four axes, a conversion in space three.
#pragma once

#include <bit>
#include <cstring>

#include "stream/stream.hpp"

namespace nc {

class Affine {
 public:
  /// The most axes that can depend on each other.
  static constexpr unsigned kMostCoupled = 4;

  /// An angle of rotation, by its cosine and sine.
  struct Angle {
    double cos = 1, sin = 0;
    /// Quarter turns are exact: a rotation by 90 degrees exchanges coordinates without rounding.
    static Angle degrees(double angle);
    static Angle radians(double angle);
  };

  constexpr Affine() = default;  ///< every point stays where it is
  static constexpr Affine translation(const AxisVec& by) {
    Affine map;
    map.offset_ = by;
    return map;
  }
  /// Stretches one axis by `factor`, which is not 0, about `center`; -1 reflects it there.
  static Affine stretch(unsigned axis, double factor, double center);
  /// Rotates the plane of the axes h and v, from h towards v, about a point.
  static Affine rotation(unsigned h, unsigned v, const Angle& angle, double center_h, double center_v);

  /// Makes this the map that does what it did before and then `next`. False, and nothing is changed, when more than kMostCoupled axes would depend on
  /// each other.
  [[nodiscard]] bool then(const Affine& next);
  Affine inverse() const;

  bool only_translates() const { return translates_; }
  bool translates_by(const AxisVec& by) const {
    uint64_t other_bits = 0;  // compared without a branch for each axis, because every move asks
    for (unsigned i = 0; i < kMaxAxes; ++i) other_bits |= std::bit_cast<uint64_t>(offset_[i]) ^ std::bit_cast<uint64_t>(by[i]);
    return translates_ && other_bits == 0;
  }
  AxisVec apply(const AxisVec& p) const {
    if (!translates_) [[unlikely]] return apply_linear(p);
    AxisVec q;
    for (unsigned i = 0; i < kMaxAxes; ++i) q[i] = p[i] + offset_[i];
    return q;
  }
  /// The same of no more than kAxes axes.
  template <unsigned kAxes>
  AxisVec apply_to(const AxisVec& p) const {
    if (!translates_) [[unlikely]] return apply_linear(p);
    AxisVec q;
    for (unsigned i = 0; i < kAxes; ++i) q[i] = p[i] + offset_[i];
    return q;
  }
  AxisVec apply_inverse(const AxisVec& q) const {
    if (!translates_) [[unlikely]] return inverse().apply_linear(q);
    AxisVec p;
    for (unsigned i = 0; i < kMaxAxes; ++i) p[i] = q[i] - offset_[i];
    return p;
  }
  /// Maps a direction, so without the offset.
  AxisVec direct(const AxisVec& direction) const;
  /// The point to which the origin is mapped.
  const AxisVec& offset() const { return offset_; }

  /// By how much the mapped coordinate on axis `to` grows when the coordinate on axis `from` grows by 1.
  double coefficient(unsigned to, unsigned from) const;
  /// Bit i: axis i is one of those that depend on each other.
  uint32_t coupled() const;
  /// Neither of the two axes depends on a third one, nor a third one on them: a circle in their plane stays a circle, if it is not stretched.
  bool keeps_plane(unsigned h, unsigned v) const;
  /// The factor by which areas of the plane (h, v) grow, where the plane is kept; negative where the plane is turned over.
  double determinant(unsigned h, unsigned v) const;
  /// The plane is turned over: clockwise arcs become counter-clockwise ones, and what was left of a path is on its right.
  bool reflects(unsigned h, unsigned v) const { return determinant(h, v) < 0; }
  /// The mapped coordinate of an axis that depends on no other one.
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
  uint8_t axis_[kMostCoupled] = {};  ///< the coupled axes in ascending order
  AxisVec offset_;
  AxisVec stretch_{{1, 1, 1, 1, 1, 1, 1, 1}};  ///< factors of the axes that are not coupled; 1 for those that are
  /// The matrix of the coupled axes, row by row; the unused rest is as in a unit matrix.
  double block_[kMostCoupled * kMostCoupled] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
};

}  // namespace nc
