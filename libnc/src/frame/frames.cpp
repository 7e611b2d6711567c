// SPDX-License-Identifier: Apache-2.0
#include "frame/frames.hpp"

namespace nc {

void Frames::create(const FramesConfig& config, Arena& arena) {
  config_ = config;
  table_ = arena.make<double>(size());
}

void Frames::compute_zero(unsigned system) const {
  for (unsigned i = 0; i < kMaxAxes; ++i) {
    // Only G54..G59 have a local system (M700 14.11: P438 for G54.1).
    const double local = system < 6 ? table_[local_key(system, i)] : 0.0;
    cached_[i] = table_[external_key(i)] + table_[work_key(system, i)] + table_[shift_key(i)] + local;
  }
  cached_system_ = system;
}

}  // namespace nc
