// SPDX-License-Identifier: Apache-2.0
// See plot_pieces.hpp.
#include "tools/lib/plot_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace nc::tools {
namespace {

constexpr double kMargin = 0.25;  // margin around the feed moves in which rapids are shown, as a fraction of the longest side

std::array<double, 3> place(const PlotVertex& v) { return {double{v.x}, double{v.y}, double{v.z}}; }

/// Finds the part [*from, *to] of the way from a to b (0 to 1) that lies in the box (algorithm of Liang and Barsky). @return false when none does.
bool clip(const PlotBox& box, const std::array<double, 3>& a, const std::array<double, 3>& b, double* from, double* to) {
  *from = 0.0;
  *to = 1.0;
  for (size_t i = 0; i < 3; ++i) {
    const double way = b[i] - a[i];
    if (way == 0.0) {
      if (a[i] < box.low[i] || a[i] > box.high[i]) return false;
      continue;
    }
    const double low = (box.low[i] - a[i]) / way, high = (box.high[i] - a[i]) / way;
    *from = std::max(*from, std::min(low, high));
    *to = std::min(*to, std::max(low, high));
  }
  return *from < *to;
}

class Inker {
 public:
  Inker(const PlotBox& box, const Relief& relief, std::vector<InkVertex>* out) : box_(box), relief_(relief), out_(*out) {}

  void rapid(const PlotVertex& a, const PlotVertex& b) {
    double from = 0, to = 1;
    if (!clip(box_, place(a), place(b), &from, &to)) return put(a, b, 1.0, Ink::kNone);
    cut(a, b, from, to, Ink::kRapid);
  }

  // Draws a feed piece only where it does not lie over the shaded surface.
  void feed(const PlotVertex& a, const PlotVertex& b) {
    double from = 0, to = 1;
    if (!inside(a) || !inside(b)) return clip(box_, place(a), place(b), &from, &to) ? cut(a, b, from, to, Ink::kFeed) : put(a, b, 1.0, Ink::kNone);
    if (!relief_.any()) return put(a, b, 1.0, Ink::kFeed);
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (length < relief_.cell_mm() && relief_.is_hole(b.x, b.y, std::min(a.z, b.z))) return put(a, b, 1.0, Ink::kFeed);
    const auto steps = static_cast<unsigned>(std::max(1.0, std::ceil(length / relief_.cell_mm())));  // the number is bounded, because both ends are inside of the frame
    bool shaded = relief_.covers(a.x, a.y);
    for (unsigned k = 1; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps;
      const bool next = relief_.covers(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y));
      if (next != shaded && k < steps) put(a, b, t, shaded ? Ink::kNone : Ink::kFeed);
      if (k == steps) put(a, b, 1.0, shaded ? Ink::kNone : Ink::kFeed);
      shaded = next;
    }
  }

 private:
  bool inside(const PlotVertex& v) const {
    const std::array<double, 3> p = place(v);
    for (size_t i = 0; i < 3; ++i)
      if (p[i] < box_.low[i] || p[i] > box_.high[i]) return false;
    return true;
  }
  void cut(const PlotVertex& a, const PlotVertex& b, double from, double to, Ink ink) {
    if (from > 0.0) put(a, b, from, Ink::kNone);
    put(a, b, to, ink);
    if (to < 1.0) put(a, b, 1.0, Ink::kNone);
  }
  void put(const PlotVertex& a, const PlotVertex& b, double t, Ink ink) {
    const auto mix = [t](float x, float y) { return static_cast<float>(x + t * (double{y} - x)); };
    if (ink == Ink::kNone && !out_.empty() && out_.back().ink == Ink::kNone) out_.pop_back();  // several pieces in a row that are not drawn become one
    out_.push_back({mix(a.x, b.x), mix(a.y, b.y), mix(a.z, b.z), b.value, ink});
  }
  const PlotBox& box_;
  const Relief& relief_;
  std::vector<InkVertex>& out_;
};

}  // namespace

namespace {

struct Extent {
  PlotBox box{};
  bool any = false;
  void widen(const PlotVertex& v) {
    const std::array<double, 3> p = place(v);
    for (size_t i = 0; i < 3; ++i) {
      box.low[i] = any ? std::min(box.low[i], p[i]) : p[i];
      box.high[i] = any ? std::max(box.high[i], p[i]) : p[i];
    }
    any = true;
  }
  double longest() const { return std::max({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]}); }
};

/// The extent of all feed moves, except for runs of feed moves that are not longer than `least`.
Extent feed_extent(const std::vector<PlotVertex>& all, double least) {
  Extent extent;
  double length = 0;
  for (size_t i = 1, run = 1; i < all.size(); ++i) {
    if (all[i].rapid) continue;
    if (all[i - 1].rapid || i == 1) {
      run = i;
      length = 0;
    }
    length += std::hypot(all[i].x - all[i - 1].x, all[i].y - all[i - 1].y, all[i].z - all[i - 1].z);
    if ((i + 1 < all.size() && !all[i + 1].rapid) || !(length > least)) continue;
    for (size_t k = run - 1; k <= i; ++k) extent.widen(all[k]);
  }
  return extent;
}

}  // namespace

static PlotBox path_box(const ToolpathPlot& plot);

PlotBox plot_box(const ToolpathPlot& plot) {
  PlotBox box = path_box(plot);
  for (const PlotDisc& disc : plot.discs())
    for (const int axis : disc.axis) {
      box.low[axis] = std::min(box.low[axis], disc.x[axis] - disc.radius);
      box.high[axis] = std::max(box.high[axis], disc.x[axis] + disc.radius);
    }
  return box;
}

static PlotBox path_box(const ToolpathPlot& plot) {
  Extent whole;
  for (const PlotVertex& v : plot.vertices()) whole.widen(v);
  if (!whole.any) whole.widen({});
  if (whole.longest() == 0.0) {  // the program has no moves
    constexpr double kAround = 5.0;  // mm
    for (size_t i = 0; i < 3; ++i) {
      whole.box.low[i] -= kAround;
      whole.box.high[i] += kAround;
    }
    return whole.box;
  }
  // In an executed path the scan in which a rapid begins may count as a tiny piece of feed far away from the part. Such short runs are ignored.
  constexpr double kLeastRun = 1e-3;
  Extent feed = feed_extent(plot.vertices(), kLeastRun * whole.longest());
  if (!feed.any) feed = feed_extent(plot.vertices(), 0.0);
  if (!feed.any) return whole.box;
  const double margin = kMargin * feed.longest();
  for (size_t i = 0; i < 3; ++i) {
    feed.box.low[i] = std::max(whole.box.low[i], feed.box.low[i] - margin);
    feed.box.high[i] = std::min(whole.box.high[i], feed.box.high[i] + margin);
  }
  // The start of the path is included in the frame if the drawing becomes at most 1.5 times as large, so that the part keeps two thirds of its size.
  constexpr double kLargest = 1.5;
  Extent with_start = feed;
  with_start.widen(plot.vertices().front());
  return with_start.longest() <= kLargest * feed.longest() ? with_start.box : feed.box;
}

bool goes_outside(const ToolpathPlot& plot, const PlotBox& box) {
  return std::any_of(plot.vertices().begin(), plot.vertices().end(), [&box](const PlotVertex& v) {
    const PlotVertex in = into_box(v, box);
    return in.x != v.x || in.y != v.y || in.z != v.z;
  });
}

PlotVertex into_box(const PlotVertex& vertex, const PlotBox& box) {
  PlotVertex out = vertex;
  float* const p[3] = {&out.x, &out.y, &out.z};
  for (size_t i = 0; i < 3; ++i) *p[i] = static_cast<float>(std::clamp(double{*p[i]}, box.low[i], box.high[i]));
  return out;
}

Relief plot_relief(const ToolpathPlot& plot, const PlotBox& box) {
  Relief relief(box.low[0], box.low[1], box.high[0], box.high[1]);
  const auto& all = plot.vertices();
  for (size_t i = 1; i < all.size(); ++i)
    if (!all[i].rapid) relief.add({all[i - 1].x, all[i - 1].y, all[i - 1].z}, {all[i].x, all[i].y, all[i].z}, all[i].value);
  relief.finish();
  return relief;
}

std::vector<InkVertex> ink_of(const ToolpathPlot& plot, const PlotBox& box, const Relief& relief) {
  std::vector<InkVertex> out;
  Inker inker(box, relief, &out);
  const auto& all = plot.vertices();
  if (!all.empty()) out.push_back({all[0].x, all[0].y, all[0].z, all[0].value, Ink::kNone});
  for (size_t i = 1; i < all.size(); ++i) {
    if (all[i].rapid) inker.rapid(all[i - 1], all[i]);
    else inker.feed(all[i - 1], all[i]);
  }
  return out;
}

}  // namespace nc::tools
