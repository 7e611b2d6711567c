// SPDX-License-Identifier: Apache-2.0
#include "frame/affine.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace nc {
namespace {

constexpr unsigned kBlock = Affine::kMostCoupled;

using Axes = Eigen::Matrix<double, kMaxAxes, kMaxAxes, Eigen::RowMajor>;
using Block = Eigen::Matrix<double, kBlock, kBlock, Eigen::RowMajor>;
using BlockVec = Eigen::Matrix<double, kBlock, 1>;

Eigen::Map<const Block> block_of(const double* rows) { return Eigen::Map<const Block>(rows); }

}  // namespace

Affine::Angle Affine::Angle::degrees(double angle) {
  const double quarter = std::remainder(angle, 360) / 90;  // -2 to 2
  if (quarter == 0) return {1, 0};
  if (quarter == 1) return {0, 1};
  if (quarter == -1) return {0, -1};
  if (std::fabs(quarter) == 2) return {-1, 0};
  return radians(angle * std::numbers::pi / 180);
}

Affine::Angle Affine::Angle::radians(double angle) {
  // An angle between two directions, or a sum of such angles, is off by a few units of its last place: near a quarter turn, a quarter turn is meant.
  constexpr double kQuarter = std::numbers::pi / 2, kLastPlaces = 1e-14;
  const double turned = std::remainder(angle, 4 * kQuarter), quarters = std::nearbyint(turned / kQuarter);
  if (std::fabs(turned - quarters * kQuarter) <= kLastPlaces * (1 + std::fabs(angle))) return degrees(quarters * 90);
  return {std::cos(angle), std::sin(angle)};
}

Affine Affine::stretch(unsigned axis, double factor, double center) {
  Affine map;
  map.stretch_[axis] = factor;
  map.offset_[axis] = center - factor * center;
  map.translates_ = factor == 1;
  return map;
}

Affine Affine::rotation(unsigned h, unsigned v, const Angle& angle, double center_h, double center_v) {
  Affine map;
  if (h == v) return map;
  const bool ascending = h < v;
  const double sin = ascending ? angle.sin : -angle.sin;
  map.offset_[h] = center_h - angle.cos * center_h + angle.sin * center_v;
  map.offset_[v] = center_v - angle.sin * center_h - angle.cos * center_v;
  if (sin == 0) {  // no turn or half a turn: no axis depends on another one
    map.stretch_[h] = map.stretch_[v] = angle.cos;
    map.translates_ = angle.cos == 1;
    return map;
  }
  map.axis_[0] = static_cast<uint8_t>(ascending ? h : v);
  map.axis_[1] = static_cast<uint8_t>(ascending ? v : h);
  map.coupled_count_ = 2;
  map.translates_ = false;
  map.block_[0] = map.block_[kBlock + 1] = angle.cos;
  map.block_[1] = -sin;
  map.block_[kBlock] = sin;
  return map;
}

bool Affine::then(const Affine& next) {
  if (next.translates_) {
    for (unsigned i = 0; i < kMaxAxes; ++i) offset_[i] += next.offset_[i];
    return true;
  }
  const AxisVec offset = next.apply_linear(offset_);
  Axes first, second;
  for (unsigned i = 0; i < kMaxAxes; ++i)
    for (unsigned k = 0; k < kMaxAxes; ++k) {
      first(i, k) = coefficient(i, k);
      second(i, k) = next.coefficient(i, k);
    }
  const Axes both = second.lazyProduct(first);
  Affine map;
  for (unsigned i = 0; i < kMaxAxes; ++i) {
    bool alone = true;
    for (unsigned k = 0; k < kMaxAxes; ++k) alone = alone && (i == k || (both(i, k) == 0 && both(k, i) == 0));
    if (alone) {
      map.stretch_[i] = both(i, i);
      continue;
    }
    if (map.coupled_count_ == kMostCoupled) return false;
    map.axis_[map.coupled_count_++] = static_cast<uint8_t>(i);
  }
  for (unsigned i = 0; i < map.coupled_count_; ++i)
    for (unsigned k = 0; k < map.coupled_count_; ++k) map.block_[i * kBlock + k] = both(map.axis_[i], map.axis_[k]);
  map.translates_ = both == Axes::Identity();
  map.offset_ = offset;
  *this = map;
  return true;
}

Affine Affine::inverse() const {
  Affine map;
  if (translates_) {
    for (unsigned i = 0; i < kMaxAxes; ++i) map.offset_[i] = -offset_[i];
    return map;
  }
  map.translates_ = false;
  map.coupled_count_ = coupled_count_;
  for (unsigned i = 0; i < kMostCoupled; ++i) map.axis_[i] = axis_[i];
  for (unsigned i = 0; i < kMaxAxes; ++i) map.stretch_[i] = 1 / stretch_[i];
  if (coupled_count_ != 0) Eigen::Map<Block>(map.block_) = block_of(block_).inverse();
  const AxisVec back = map.direct(offset_);
  for (unsigned i = 0; i < kMaxAxes; ++i) map.offset_[i] = -back[i];
  return map;
}

AxisVec Affine::direct(const AxisVec& direction) const {
  AxisVec q;
  for (unsigned i = 0; i < kMaxAxes; ++i) q[i] = stretch_[i] * direction[i];
  if (coupled_count_ == 0) return q;
  BlockVec of = BlockVec::Zero();
  for (unsigned k = 0; k < coupled_count_; ++k) of[k] = direction[axis_[k]];
  const BlockVec to = block_of(block_) * of;
  for (unsigned k = 0; k < coupled_count_; ++k) q[axis_[k]] = to[k];
  return q;
}

AxisVec Affine::apply_linear(const AxisVec& p) const {
  AxisVec q = direct(p);
  for (unsigned i = 0; i < kMaxAxes; ++i) q[i] += offset_[i];
  return q;
}

double Affine::coefficient(unsigned to, unsigned from) const {
  int row = -1, column = -1;
  for (unsigned k = 0; k < coupled_count_; ++k) {
    if (axis_[k] == to) row = static_cast<int>(k);
    if (axis_[k] == from) column = static_cast<int>(k);
  }
  if (row >= 0 && column >= 0) return block_of(block_)(row, column);
  return to == from ? stretch_[to] : 0.0;
}

uint32_t Affine::coupled() const {
  uint32_t axes = 0;
  for (unsigned k = 0; k < coupled_count_; ++k) axes |= 1u << axis_[k];
  return axes;
}

bool Affine::keeps_plane(unsigned h, unsigned v) const {
  for (unsigned k = 0; k < coupled_count_; ++k) {
    const unsigned other = axis_[k];
    if (other == h || other == v) continue;
    if (coefficient(other, h) != 0 || coefficient(other, v) != 0 || coefficient(h, other) != 0 || coefficient(v, other) != 0) return false;
  }
  return true;
}

double Affine::determinant(unsigned h, unsigned v) const {
  if (translates_) return 1;
  return coefficient(h, h) * coefficient(v, v) - coefficient(h, v) * coefficient(v, h);
}

bool Affine::same_linear(const Affine& other) const {
  return std::memcmp(&stretch_, &other.stretch_, sizeof stretch_) == 0 && std::memcmp(block_, other.block_, sizeof block_) == 0 &&
         std::memcmp(axis_, other.axis_, sizeof axis_) == 0 && coupled_count_ == other.coupled_count_;
}

}  // namespace nc
