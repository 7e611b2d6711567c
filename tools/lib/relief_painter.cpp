// SPDX-License-Identifier: Apache-2.0
// Draws the cells of a relief as triangles with a depth buffer, so that nearer cells hide those behind them.
#include "tools/lib/relief_painter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace nc::tools {
namespace {

constexpr int kFine = 2;           // number of pixels of the picture along one pixel of the page, which makes edges smooth
constexpr double kShadow = 0.30;   // part of the colour that is left where no light falls
constexpr double kWrap = 0.30;     // how far light comes around an edge, as from a window and not from a lamp
constexpr double kLightest = 0.50; // how near to white the colour becomes where the light falls vertically

/// The colour of a surface where light falls on it at an angle with this cosine to its normal.
std::uint32_t lit(const Color& color, double cosine) {
  const double light = std::max(0.0, (cosine + kWrap) / (1.0 + kWrap));
  // Up to 3/4 of the light the colour goes from dark to full, above that from full towards white.
  constexpr double kFull = 0.75;
  const double shade = kShadow + (1.0 - kShadow) * std::min(1.0, light / kFull);
  const double white = std::max(0.0, light - kFull) / (1.0 - kFull) * kLightest;
  const auto byte = [&](double part) {
    const double value = part * shade;
    return static_cast<std::uint32_t>(std::lround(255.0 * (value + white * (1.0 - value))));
  };
  return 0xFF000000U | byte(color.r) << 16 | byte(color.g) << 8 | byte(color.b);
}

class Picture {
 public:
  Picture(double width, double height)
      : width_(static_cast<int>(width) * kFine),
        height_(static_cast<int>(height) * kFine),
        pixel_(size_t(width_) * size_t(height_), 0),
        depth_(pixel_.size(), -std::numeric_limits<float>::infinity()) {}

  void triangle(const ReliefView::Point& a, const ReliefView::Point& b, const ReliefView::Point& c, std::uint32_t color) {
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (std::fabs(area) < 1e-9) return;
    const auto first = [](double least, int count) { return std::clamp(static_cast<int>(std::ceil(least * kFine - 0.5)), 0, count); };
    const auto last = [](double most, int count) { return std::clamp(static_cast<int>(std::floor(most * kFine - 0.5)), -1, count - 1); };
    const int x0 = first(std::min({a.x, b.x, c.x}), width_), x1 = last(std::max({a.x, b.x, c.x}), width_);
    const int y0 = first(std::min({a.y, b.y, c.y}), height_), y1 = last(std::max({a.y, b.y, c.y}), height_);
    for (int iy = y0; iy <= y1; ++iy)
      for (int ix = x0; ix <= x1; ++ix) {
        const double x = (ix + 0.5) / kFine, y = (iy + 0.5) / kFine;
        // Barycentric coordinates of the pixel's centre.
        const double u = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / area;
        const double v = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area;
        constexpr double kEdge = 1e-6;  // a pixel whose centre is on an edge belongs to both triangles, so that there is no gap
        if (u < -kEdge || v < -kEdge || u + v > 1.0 + kEdge) continue;
        const float depth = static_cast<float>(a.depth + u * (b.depth - a.depth) + v * (c.depth - a.depth));
        const size_t i = size_t(iy) * size_t(width_) + size_t(ix);
        if (depth < depth_[i]) continue;
        depth_[i] = depth;
        pixel_[i] = color;
      }
  }

  void put_on(cairo_t* c) const {
    cairo_surface_t* image = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width_, height_);
    if (cairo_surface_status(image) == CAIRO_STATUS_SUCCESS) {
      unsigned char* data = cairo_image_surface_get_data(image);
      const size_t stride = static_cast<size_t>(cairo_image_surface_get_stride(image)), row = size_t(width_) * sizeof(std::uint32_t);
      for (size_t y = 0; y < size_t(height_); ++y)
        std::copy_n(reinterpret_cast<const unsigned char*>(pixel_.data()) + y * row, row, data + y * stride);
      cairo_surface_mark_dirty(image);
    }
    cairo_save(c);
    cairo_scale(c, 1.0 / kFine, 1.0 / kFine);
    cairo_set_source_surface(c, image, 0, 0);
    cairo_pattern_set_filter(cairo_get_source(c), CAIRO_FILTER_GOOD);
    cairo_paint(c);
    cairo_restore(c);
    cairo_surface_destroy(image);
  }

 private:
  int width_, height_;
  std::vector<std::uint32_t> pixel_;
  std::vector<float> depth_;
};

}  // namespace

void paint_relief(cairo_t* c, const Relief& relief, const ReliefView& view) {
  const double length = std::hypot(view.light[0], view.light[1], view.light[2]);
  Picture picture(view.width, view.height);
  for (unsigned row = 0; row + 1 < relief.rows(); ++row)
    for (unsigned column = 0; column + 1 < relief.columns(); ++column) {
      if (!relief.covered(column, row) || !relief.covered(column + 1, row) || !relief.covered(column, row + 1) || !relief.covered(column + 1, row + 1)) continue;
      double dz_dx, dz_dy;
      relief.slope(column, row, &dz_dx, &dz_dy);
      // The normal is (-dz/dx, -dz/dy, 1).
      const double cosine = (view.light[2] - dz_dx * view.light[0] - dz_dy * view.light[1]) / (length * std::hypot(dz_dx, dz_dy, 1.0));
      const std::uint32_t color = lit(view.color(relief.value(column, row)), cosine);
      const ReliefView::Point p = view.project(relief.place(column, row)), q = view.project(relief.place(column + 1, row)),
                              r = view.project(relief.place(column + 1, row + 1)), s = view.project(relief.place(column, row + 1));
      picture.triangle(p, q, r, color);
      picture.triangle(p, r, s, color);
    }
  picture.put_on(c);
}

}  // namespace nc::tools
