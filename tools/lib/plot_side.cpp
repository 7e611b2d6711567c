// SPDX-License-Identifier: Apache-2.0
// What a drawing by sides has beside the path of the tool: the programmed path, on which side of it the tool goes, and how large the tool is.
//
// A move tells its programmed end and where the tool goes. The difference is the vector of radius compensation, as long as the program does not rotate, scale or
// mirror its coordinates. The side is that of the code in force, in the move that leads to it, too, wherever that comes from; the move that leads back has the
// side that it leaves. Between two vectors that lie equally far beside a line, or of an arc by the difference of the radii, the tool goes beside its block by
// its radius: its disc is drawn there. A vector in space leads to no side and has no disc.
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

/// 0, 1 or 2 where the axis of this index is X, Y or Z; -1 for another one, which is not drawn.
int drawn_axis(const nc_system_config& system, unsigned index) {
  const char name = index < system.axis_count ? system.axis[index].name : 0;
  return name >= 'X' && name <= 'Z' ? name - 'X' : -1;
}

}  // namespace

void ToolpathPlot::note_side(const nc_move& move, const nc_system_config& system, const nc_axes& zero) {
  const Place origin = place_of(zero, system), end = place_of(move.work, system);
  const Place from = minus(place_of(move.machine_start, system), origin), to = minus(place_of(move.machine, system), origin);
  const Place start = programmed_.empty() ? from : Place{{programmed_end_[0], programmed_end_[1], programmed_end_[2]}};
  for (int i = 0; i < 3; ++i) programmed_end_[i] = end.x[i];
  const Place before = minus(from, start), behind = minus(to, end), way = minus(end, start);
  const bool leads_back = in_force_.side == NC_SIDE_NONE && is_something(before);
  if (!leads_back) side_ = static_cast<float>(in_force_.side);
  if (!is_something(before) && !is_something(behind)) side_ = kSideNone;
  const bool beside = side_ != kSideNone;
  if (programmed_.size() >= kMostBeside) {
    beside_all_ = false;
    return;
  }
  const auto put = [&](const Place& p) { programmed_.push_back({{p.x[0], p.x[1], p.x[2]}, beside}); };
  if (programmed_.empty()) put(start);
  const int first = drawn_axis(system, in_force_.plane_axis[0]), second = drawn_axis(system, in_force_.plane_axis[1]);
  const bool to_a_side = (in_force_.side == NC_SIDE_LEFT || in_force_.side == NC_SIDE_RIGHT) && first >= 0 && second >= 0;
  double radius = 0;  // of the tool, where the move goes beside its block
  if (move.center_axes == 2) {
    const int h = drawn_axis(system, move.plane_axis[0]), v = drawn_axis(system, move.plane_axis[1]);
    if (h >= 0 && v >= 0) {
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
      if (own > kNothing && is_something(way)) radius = std::fabs(own - tool);
    }
  } else if (const double length = to_a_side ? std::hypot(way.x[first], way.x[second]) : 0; length > kNothing) {
    const auto to_the_left = [&](const Place& vector) { return (way.x[first] * vector.x[second] - way.x[second] * vector.x[first]) / length; };
    if (std::fabs(to_the_left(before) - to_the_left(behind)) < kNothing) radius = std::fabs(to_the_left(behind));
  }
  put(end);
  if (to_a_side && radius >= 1e-3) discs_.push_back({{to.x[0], to.x[1], to.x[2]}, radius, {first, second}});
}

}  // namespace nc::tools
