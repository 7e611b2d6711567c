// SPDX-License-Identifier: Apache-2.0
// Curves of a profile; see profile_plot.hpp. The drawing itself is in profile_painter.cpp.
#include "tools/lib/profile_plot.hpp"

#include <algorithm>
#include <cmath>

namespace nc::tools {

ProfilePlot::ProfilePlot(const nc_config& config)
    : system_(config.system[0]), cycle_s_(config.cycle_s), rows_(system_.axis_count) {
  // The trapezoid does not limit the jerk, even when the configuration has a limit. So the limit is drawn only for the time-optimal mode.
  const bool keeps_jerk = config.motion_mode == NC_MOTION_OPTIMAL;
  for (unsigned i = 0; i < system_.axis_count; ++i) linear_ = linear_ || !system_.axis[i].rotary;
  curves_.push_back({"path speed", linear_ ? "mm/s" : "deg/s", 0.0, {}});
  for (unsigned i = 0; i < system_.axis_count; ++i) {
    const nc_axis_config& axis = system_.axis[i];
    const std::string unit = axis.rotary ? "deg/s" : "mm/s";
    curves_.push_back({std::string(1, axis.name) + " acceleration", unit + "2", axis.max_acceleration, {}});
    curves_.push_back({std::string(1, axis.name) + " jerk", unit + "3", keeps_jerk ? axis.max_jerk : 0.0, {}});
  }
}

void ProfilePlot::begin(const nc_axes& start) {
  last_ = start;
  rows_.begin(start);
}

void ProfilePlot::cycle(const nc_outputs& out) {
  if (rows_.counts(out)) add(out.command);
}

void ProfilePlot::end() {
  constexpr int kDifferences = 3;  // the order of the jerk
  for (int i = 0; i < kDifferences; ++i) add(nc_axes(last_));
}

void ProfilePlot::add(const nc_axes& position) {
  if (cycles_ == kBuckets * per_bucket_) halve();
  const bool first = cycles_ % per_bucket_ == 0;
  double speed = 0.0;
  for (unsigned i = 0; i < system_.axis_count; ++i) {
    const double v = (position.v[i] - last_.v[i]) / cycle_s_, a = (v - velocity_.v[i]) / cycle_s_;
    add(1 + 2 * i, a, first);
    add(2 + 2 * i, (a - acceleration_.v[i]) / cycle_s_, first);
    velocity_.v[i] = v;
    acceleration_.v[i] = a;
    if (!linear_ || !system_.axis[i].rotary) speed = std::hypot(speed, v);
  }
  add(0, speed, first);
  last_ = position;
  ++cycles_;
}

void ProfilePlot::add(size_t curve, double value, bool first) {
  const float v = static_cast<float>(value);
  std::vector<Range>& range = curves_[curve].range;
  if (first) return range.push_back({v, v});
  range.back() = {std::min(range.back().low, v), std::max(range.back().high, v)};
}

void ProfilePlot::halve() {
  for (Curve& curve : curves_) {
    for (size_t i = 0; i < kBuckets / 2; ++i) {
      const Range a = curve.range[2 * i], b = curve.range[2 * i + 1];
      curve.range[i] = {std::min(a.low, b.low), std::max(a.high, b.high)};
    }
    curve.range.resize(kBuckets / 2);
  }
  per_bucket_ *= 2;
}

double ProfilePlot::peak(size_t curve) const {
  double most = 0.0;
  for (const Range& r : curves_[curve].range)
    most = std::max({most, std::fabs(double{r.low}), std::fabs(double{r.high})});
  return most;
}

}  // namespace nc::tools
