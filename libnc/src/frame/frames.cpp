// SPDX-License-Identifier: Apache-2.0
#include "frame/frames.hpp"

namespace nc {

void Frames::create(const FramesConfig& config, Arena& arena) {
  config_ = config;
  table_ = arena.make<double>(size());
}

double Frames::zero(unsigned system, unsigned axis) const {
  // Only G54..G59 have a local system (M700 14.11: P438 for G54.1).
  const double local = system < 6 ? table_[local_key(system, axis)] : 0.0;
  return table_[external_key(axis)] + table_[work_key(system, axis)] + table_[shift_key(axis)] + local;
}

AxisVec Frames::zero(unsigned system) const {
  AxisVec z;
  for (unsigned i = 0; i < kMaxAxes; ++i) z[i] = zero(system, i);
  return z;
}

}  // namespace nc
