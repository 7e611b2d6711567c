// SPDX-License-Identifier: Apache-2.0
// What a drawing by sides has beside the path of the tool: the programmed path, on which side of it the tool goes, and how large the tool is.
//
// A move tells its programmed end and where the tool goes. The difference is the vector of radius compensation, as long as the program does not rotate, scale or
// mirror its coordinates. Between two vectors that lie equally far beside a line, or of an arc by the difference of the radii, the tool goes beside its block by
// its radius. Other moves, the start and the cancel among them, have the side of the larger vector.
#include <algorithm>
#include <cmath>

#include "tools/lib/toolpath_plot.hpp"

namespace nc::tools {
namespace {

constexpr double kNothing = 1e-6;  // mm

struct Place {
  double x[3] = {0, 0, 0};
};

Place place_of(const nc_axes& axes, const nc_system_config& system) {
  Place place;
  for (unsigned i = 0; i < system.axis_count; ++i)
    if (const char name = system.axis[i].name; name >= 'X' && name <= 'Z') place.x[name - 'X'] = axes.v[i];
  return place;
}

Place minus(const Place& a, const Place& b) {
  Place d;
  for (int i = 0; i < 3; ++i) d.x[i] = a.x[i] - b.x[i];
  return d;
}

bool is_something(const Place& vector) { return std::hypot(vector.x[0], vector.x[1], vector.x[2]) > kNothing; }

/// The plane in which these two vectors and this way lie: XY, ZX or YZ.
void plane_of(const Place& before, const Place& behind, const Place& way, int axis[2]) {
  const auto flat = [&](int i) { return std::fabs(before.x[i]) < kNothing && std::fabs(behind.x[i]) < kNothing; };
  axis[0] = 0;
  axis[1] = 1;
  if (!flat(2) || (std::fabs(way.x[2]) > kNothing && (flat(0) || flat(1)) && std::fabs(way.x[flat(0) ? 1 : 0]) < kNothing)) {
    axis[0] = flat(1) ? 2 : 1;
    axis[1] = flat(1) ? 0 : 2;
  }
}

float side_of(double to_the_left) { return to_the_left > 0 ? kSideLeft : kSideRight; }

}  // namespace

void ToolpathPlot::note_side(const nc_move& move, const nc_system_config& system, const nc_axes& zero) {
  const Place origin = place_of(zero, system), end = place_of(move.work, system);
  const Place from = minus(place_of(move.machine_start, system), origin), to = minus(place_of(move.machine, system), origin);
  const Place start = programmed_.empty() ? from : Place{{programmed_.back().x[0], programmed_.back().x[1], programmed_.back().x[2]}};
  const Place before = minus(from, start), behind = minus(to, end), way = minus(end, start);
  const bool beside = is_something(before) || is_something(behind);
  if (programmed_.size() >= kMostBeside) {
    beside_all_ = false;
    return;
  }
  const auto put = [&](const Place& p) { programmed_.push_back({{p.x[0], p.x[1], p.x[2]}, beside}); };
  if (programmed_.empty()) put(start);
  int axis[2];
  plane_of(before, behind, way, axis);
  double radius = 0;
  if (move.center_axes == 2) {
    const int h = system.axis[move.plane_axis[0]].name - 'X', v = system.axis[move.plane_axis[1]].name - 'X';
    if (h >= 0 && h < 3 && v >= 0 && v < 3) {
      axis[0] = h;
      axis[1] = v;
      const double dh = start.x[h] - move.center[0], dv = start.x[v] - move.center[1], eh = end.x[h] - move.center[0], ev = end.x[v] - move.center[1];
      const double own = std::hypot(eh, ev), tool = std::hypot(move.machine.v[move.plane_axis[0]] - move.machine_center[0], move.machine.v[move.plane_axis[1]] - move.machine_center[1]);
      double sweep = std::atan2(dh * ev - dv * eh, dh * eh + dv * ev);
      if (move.ccw && sweep <= kNothing) sweep += 2 * M_PI;
      if (!move.ccw && sweep >= -kNothing) sweep -= 2 * M_PI;
      const int steps = std::max(1, static_cast<int>(std::ceil(std::fabs(sweep) / (3 * M_PI / 180))));
      for (int k = 1; k < steps; ++k) {
        const double t = static_cast<double>(k) / steps, angle = std::atan2(dv, dh) + t * sweep;
        Place p;
        for (int i = 0; i < 3; ++i) p.x[i] = start.x[i] + t * way.x[i];
        p.x[h] = move.center[0] + own * std::cos(angle);
        p.x[v] = move.center[1] + own * std::sin(angle);
        put(p);
      }
      if (own > kNothing && is_something(way)) radius = (move.ccw ? 1 : -1) * (own - tool);
    }
  } else if (const double length = std::hypot(way.x[axis[0]], way.x[axis[1]]); length > kNothing) {
    const auto to_the_left = [&](const Place& vector) { return (way.x[axis[0]] * vector.x[axis[1]] - way.x[axis[1]] * vector.x[axis[0]]) / length; };
    const double a = to_the_left(before), b = to_the_left(behind);
    if (std::fabs(a - b) < kNothing) radius = b;
    else if (beside) side_ = side_of(std::fabs(b) > std::fabs(a) ? b : a);
  }
  put(end);
  if (!beside) side_ = kSideNone;
  if (std::fabs(radius) < 1e-3) return;
  side_ = side_of(radius);
  discs_.push_back({{to.x[0], to.x[1], to.x[2]}, std::fabs(radius), {axis[0], axis[1]}});
}

}  // namespace nc::tools
