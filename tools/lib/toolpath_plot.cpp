// SPDX-License-Identifier: Apache-2.0
// The path of a drawing: makes a bounded number of vertices from moves. The drawing itself is in
// plot_painter.cpp.
#include "tools/lib/toolpath_plot.hpp"

#include <algorithm>
#include <cmath>

namespace nc::tools {
namespace {

constexpr size_t kMaxVertices = 2'000'000;  // 40 MB; a drawing shows far fewer
constexpr double kStepDeg = 3.0;            // with this step an arc of radius r differs from its chord by at most 0.00034 r
constexpr double kFarthest = 1e9;           // mm
constexpr unsigned kMaxTurnsDrawn = 2000;

// Index of the axis called `name`, or -1.
int axis_index(const nc_system_config& system, char name) {
  for (unsigned i = 0; i < system.axis_count; ++i)
    if (system.axis[i].name == name) return static_cast<int>(i);
  return -1;
}

struct LinearAxes {
  int index[3];
  explicit LinearAxes(const nc_system_config& system)
      : index{axis_index(system, 'X'), axis_index(system, 'Y'), axis_index(system, 'Z')} {}
  double get(const nc_axes& axes, int which) const { return index[which] < 0 ? 0.0 : axes.v[index[which]]; }
};

bool is_circular(const nc_move& move) {
  return move.plane != NC_PLANE_NONE;
}

}  // namespace

void ToolpathPlot::add_point(bool rapid, double x, double y, double z) {
  // Places farther than 1000 km from zero are not drawn; this also excludes values that are not numbers.
  if (!(std::fabs(x) < kFarthest && std::fabs(y) < kFarthest && std::fabs(z) < kFarthest)) return;
  if (!vertices_.empty()) {
    PlotVertex& last = vertices_.back();
    const double step = std::hypot(x - last.x, y - last.y, z - last.z);
    // The last vertex is replaced only inside a run of feed pieces, so that the corners between feed and rapid do not
    // move.
    const size_t n = vertices_.size();
    if (!rapid && step < min_step_ && n >= 2 && !last.rapid && !vertices_[n - 2].rapid) vertices_.pop_back();
  }
  push(rapid, x, y, z);
  if (vertices_.size() > kMaxVertices) thin();
}

void ToolpathPlot::push(bool rapid, double x, double y, double z) {
  const double p[3] = {x, y, z};
  for (int i = 0; i < 3; ++i) {
    low_[i] = vertices_.empty() ? p[i] : std::min(low_[i], p[i]);
    high_[i] = vertices_.empty() ? p[i] : std::max(high_[i], p[i]);
  }
  const double value = color_ == PlotColor::kTool ? tool_ : color_ == PlotColor::kFeed ? feed_mm_min_ : color_ == PlotColor::kZ ? z : color_ == PlotColor::kSide ? double{side_} : 0.0;
  vertices_.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(value), rapid});
}

// Doubles the shortest step that is kept until half of the room is free again.
void ToolpathPlot::thin() {
  const double extent = std::hypot(high_[0] - low_[0], high_[1] - low_[1], high_[2] - low_[2]);
  min_step_ = std::max(min_step_ * 2.0, extent / 100'000.0);
  while (vertices_.size() > kMaxVertices / 2) {
    size_t kept = 1;
    for (size_t i = 1; i < vertices_.size(); ++i) {
      const PlotVertex& v = vertices_[i];
      const PlotVertex& last = vertices_[kept - 1];
      const bool edge = v.rapid || i + 1 == vertices_.size() || vertices_[i + 1].rapid;
      if (edge || std::hypot(v.x - last.x, v.y - last.y, v.z - last.z) >= min_step_) vertices_[kept++] = v;
    }
    const bool rapids_only = kept == vertices_.size() && min_step_ > extent;
    vertices_.resize(kept);
    if (rapids_only) {  // only rapids and corners are left: every second vertex is kept
      for (size_t i = 0; i < kept / 2; ++i) vertices_[i] = vertices_[2 * i];
      vertices_.resize(kept / 2);
    }
    min_step_ *= 2.0;
  }
}

void ToolpathPlot::add_move(const nc_move& move, const nc_system_config& system, const nc_axes& zero) {
  if (color_ == PlotColor::kSide) note_side(move, system, zero);
  const LinearAxes linear(system);
  const auto at = [&](const nc_axes& axes, int i) { return linear.get(axes, i) - linear.get(zero, i); };
  if (vertices_.empty())
    add_point(true, at(move.machine_start, 0), at(move.machine_start, 1), at(move.machine_start, 2));
  const bool rapid = move.kind == NC_MOVE_RAPID;
  feed_mm_min_ = move.feed_mm_min;
  if (!is_circular(move)) {
    add_point(rapid, at(move.machine, 0), at(move.machine, 1), at(move.machine, 2));
    return;
  }
  const int first = move.plane_axis[0], second = move.plane_axis[1];
  const double du = move.machine_start.v[first] - move.machine_center[0];
  const double dv = move.machine_start.v[second] - move.machine_center[1];
  const double eu = move.machine.v[first] - move.machine_center[0];
  const double ev = move.machine.v[second] - move.machine_center[1];
  const double start_radius = std::hypot(du, dv), end_radius = std::hypot(eu, ev);
  const double start_rad = std::atan2(dv, du);
  double sweep_deg = move.sweep_deg;
  const unsigned turns = std::min(move.turns, kMaxTurnsDrawn);
  if (std::fabs(sweep_deg) < 360.0 * turns - 1e-6) sweep_deg += std::copysign(360.0 * turns, sweep_deg);
  const int steps = std::clamp(static_cast<int>(std::ceil(std::fabs(sweep_deg) / kStepDeg)), 1, 400'000);
  for (int k = 1; k <= steps; ++k) {
    const double t = static_cast<double>(k) / steps;
    nc_axes p = {};
    for (unsigned i = 0; i < system.axis_count && i < NC_MAX_AXES; ++i)
      p.v[i] = move.machine_start.v[i] + t * (move.machine.v[i] - move.machine_start.v[i]);
    if (k < steps) {
      const double angle = start_rad + t * sweep_deg * M_PI / 180.0;
      const double radius = start_radius + t * (end_radius - start_radius);
      p.v[first] = move.machine_center[0] + radius * std::cos(angle);
      p.v[second] = move.machine_center[1] + radius * std::sin(angle);
    }
    add_point(rapid, at(p, 0), at(p, 1), at(p, 2));
  }
}

}  // namespace nc::tools
