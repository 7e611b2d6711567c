// SPDX-License-Identifier: Apache-2.0
// See run_plot.hpp.
#include "tools/lib/run_plot.hpp"

#include <cmath>

namespace nc::tools {

namespace {

double distance(const double (&a)[3], const double (&b)[3]) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

}  // namespace

RunPlot::RunPlot(const nc_config& config, PlotView view, PlotCoordinates coordinates, PlotColor color)
    : cycle_s_(config.cycle_s), color_(color) {
  const nc_system_config& system = config.system[0];
  for (unsigned a = 0; a < system.axis_count; ++a)
    for (unsigned k = 0; k < 3; ++k)
      if (system.axis[a].name == "XYZ"[k]) index_[k] = static_cast<int>(a);
  plot.set_view(view);
  plot.set_coordinates(coordinates);
  plot.set_color(color);
  plot.set_executed(true);
}

RunPlot::Point RunPlot::point_of(const rt::PositionSample& sample) const {
  const nc_axes& where = plot.coordinates() == PlotCoordinates::kWork ? sample.work : sample.command;
  Point point;
  for (unsigned k = 0; k < 3; ++k) point.x[k] = index_[k] < 0 ? 0 : where.v[index_[k]];
  point.rapid = sample.rapid;
  return point;
}

void RunPlot::moved(const rt::PositionSample& sample) {
  if (sample.system != 0) return;
  // The workpiece coordinates of the start are known only with the first move, so the first sample only sets the start.
  if (count_++ == 0) {
    start_ = command_ = sample.command;
    return;
  }
  Point point = point_of(sample);
  if (count_ == 2) {
    last_ = point;
    for (unsigned k = 0; k < 3; ++k)
      if (index_[k] >= 0) last_.x[k] += start_.v[index_[k]] - sample.command.v[index_[k]];
    emit(last_);
    vertex_is_last_ = true;
  }
  const double step = distance(point.x, last_.x);
  double driven = 0;
  for (const int axis : index_)
    if (axis >= 0) driven = std::hypot(driven, sample.command.v[axis] - command_.v[axis]);
  command_ = sample.command;
  // When a tool length or another work zero comes into force, the coordinates of the tip jump without a motion. That is drawn like a rapid.
  constexpr double kJumpMm = 1.0;
  if (step > kJumpMm + 2.0 * driven) {
    end_piece(true);
    point.rapid = true;
    emit(last_ = point);
    vertex_is_last_ = true;
    return;
  }
  if (driven == 0.0) return;  // while the axes wait, the sample is neither rapid nor feed
  point.speed_mm_min = step / cycle_s_ * 60.0;
  point.tool = tool_now();
  const bool begins = vertex_is_last_ || !goes_on(point);
  if (begins) end_piece(point.rapid);
  if (begins) piece_speed_ = point.speed_mm_min;
  samples_ = begins ? 1 : samples_ + 1;
  vertex_is_last_ = false;
  last_ = point;
}

void RunPlot::finish() {
  if (count_ > 1) end_piece(false);
}

// True when `next` lies in the direction in which the path has left the last vertex, and has the same colour as `last_`.
bool RunPlot::goes_on(const Point& next) const {
  if (next.rapid != last_.rapid || next.tool != last_.tool) return false;
  constexpr double kSpeedStep = 0.1;
  if (color_ == PlotColor::kFeed && std::fabs(next.speed_mm_min - piece_speed_) > kSpeedStep * piece_speed_) return false;
  double dot = 0, a = 0, b = 0;
  for (unsigned k = 0; k < 3; ++k) {
    const double u = last_.x[k] - vertex_.x[k], v = next.x[k] - last_.x[k];
    dot += u * v;
    a += u * u;
    b += v * v;
  }
  if (a < 1e-12 || b < 1e-12) return true;
  constexpr double kCos2Deg = 0.99939;
  return dot > kCos2Deg * std::sqrt(a * b);
}

// The tool of the last finished block. After the first M06 a T alone only prepares the next tool.
double RunPlot::tool_now() {
  nc_modal modal;
  if (color_ != PlotColor::kTool || !modal_ || !modal_(&modal)) return 0;
  constexpr std::uint32_t kToolChange = 6;
  changer_ = changer_ || modal.m == kToolChange;
  if (modal.m == kToolChange || !changer_) tool_ = modal.tool;
  return tool_;
}

// Ends a piece at last_. A piece of a single sample before a rapid is drawn as rapid: in the scan in which a rapid begins or ends, the sample may have the kind
// of the neighbouring block.
void RunPlot::end_piece(bool before_rapid) {
  if (vertex_is_last_) return;
  if (samples_ == 1 && before_rapid) last_.rapid = true;
  emit(last_);
}

void RunPlot::emit(const Point& point) {
  plot.set_tool(point.tool);
  plot.set_feed(point.speed_mm_min);
  plot.add_point(point.rapid, point.x[0], point.x[1], point.x[2]);
  vertex_ = point;
}

}  // namespace nc::tools
