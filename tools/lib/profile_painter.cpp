// SPDX-License-Identifier: Apache-2.0
// Draws a ProfilePlot with cairo: one panel for each curve over a common time axis, with limits as dashed lines.
#include <algorithm>
#include <cmath>

#include "tools/lib/drawing.hpp"
#include "tools/lib/profile_plot.hpp"

namespace nc::tools {
namespace {

constexpr double kWidth = 1400, kPanel = 150, kGap = 34;  // px in the PNG, points in the SVG
constexpr double kLeft = 110, kRight = 60, kTop = 90, kBottom = 70;
constexpr Color kCurve{0.05, 0.30, 0.75}, kLimit{0.85, 0.20, 0.10};
constexpr double kLimitTolerance = 1.001;  // the tolerance with which limits are checked everywhere

double height_of(size_t panels) {
  return kTop + kBottom + static_cast<double>(panels) * (kPanel + kGap);
}

}  // namespace

/** Paints one drawing on one cairo context. */
class ProfilePainter {
 public:
  ProfilePainter(const ProfilePlot& plot, cairo_t* context)
      : plot_(plot), c_(context), end_(std::max(1.0, static_cast<double>(plot.cycles_)) * plot.cycle_s_) {}

  static double height(const ProfilePlot& plot) { return height_of(plot.curves_.size()); }

  void paint() {
    use(c_, kInk);
    put_text(c_, kLeft, 40, plot_.title_, 22);
    put_text(
        c_, kLeft, 62,
        "finite differences of the commanded positions, cycle " + tick_text(plot_.cycle_s_ * 1e6) + " us",
        13);
    for (size_t i = 0; i < plot_.curves_.size(); ++i) panel(i);
    use(c_, kInk);
    put_text(c_, kWidth - kRight, height(plot_) - 22, "time [s]", 15, 1.0);
  }

 private:
  double px(double t) const { return kLeft + t / end_ * (kWidth - kLeft - kRight); }

  void panel(size_t index) {
    const ProfilePlot::Curve& curve = plot_.curves_[index];
    const double top = kTop + static_cast<double>(index) * (kPanel + kGap) + 18, bottom = top + kPanel;
    const double peak = plot_.peak(index);
    const double high = 1.08 * std::max({peak, curve.limit, 1e-6}), low = index == 0 ? 0.0 : -high;
    const auto py = [&](double v) { return bottom - (v - low) / (high - low) * kPanel; };
    cairo_set_line_width(c_, 0.8);
    for (const double t : ticks_between(0, end_, nice_step(end_, 14))) {
      line(kGrid, px(t), top, px(t), bottom);
      use(c_, kInk);
      if (index + 1 == plot_.curves_.size()) put_text(c_, px(t), bottom + 18, tick_text(t), 13, 0.5);
    }
    for (const double v : ticks_between(low, high, nice_step(high - low, 5))) {
      line(kGrid, kLeft, py(v), kWidth - kRight, py(v));
      use(c_, kInk);
      put_text(c_, kLeft - 9, py(v) + 4, tick_text(v), 12, 1.0);
    }
    limits(curve, py(curve.limit), py(-curve.limit));
    values(curve, py);
    use(c_, kInk);
    cairo_rectangle(c_, kLeft, top, kWidth - kLeft - kRight, kPanel);
    cairo_stroke(c_);
    put_text(c_, kLeft, top - 5, curve.name + " [" + curve.unit + "]", 14);
    std::string most = "at most " + tick_text(std::round(peak * 10) / 10);
    if (curve.limit > 0) most += ", limit " + tick_text(curve.limit);
    use(c_, curve.limit > 0 && peak > curve.limit * kLimitTolerance ? kLimit : kInk);
    put_text(c_, kWidth - kRight, top - 5, most, 13, 1.0);
  }

  void limits(const ProfilePlot::Curve& curve, double y_high, double y_low) {
    if (curve.limit <= 0) return;
    const double dash[] = {6.0, 4.0};
    cairo_set_dash(c_, dash, 2, 0);
    line(kLimit, kLeft, y_high, kWidth - kRight, y_high);
    line(kLimit, kLeft, y_low, kWidth - kRight, y_low);
    cairo_set_dash(c_, nullptr, 0, 0);
  }

  // Draws a curve through the lowest and the highest value of each piece of time.
  template <typename Y>
  void values(const ProfilePlot::Curve& curve, const Y& py) {
    if (curve.range.empty()) return;
    use(c_, kCurve);
    cairo_set_line_width(c_, 1.1);
    cairo_set_line_join(c_, CAIRO_LINE_JOIN_ROUND);
    constexpr size_t kStrokeChunk = 500;  // short strokes, because the time of cairo for a stroke grows faster than its length
    const double per_piece = static_cast<double>(plot_.per_bucket_) * plot_.cycle_s_;
    double last = 0.0;
    cairo_move_to(c_, px(0), py(0));
    for (size_t i = 0; i < curve.range.size(); ++i) {
      const double x = px(std::min(end_, (static_cast<double>(i) + 1) * per_piece));
      const double low = double{curve.range[i].low}, high = double{curve.range[i].high};
      const bool up = std::fabs(low - last) <= std::fabs(high - last);
      cairo_line_to(c_, x, py(up ? low : high));
      last = up ? high : low;
      if (low < high) cairo_line_to(c_, x, py(last));
      if (i % kStrokeChunk == kStrokeChunk - 1) {
        cairo_stroke(c_);
        cairo_move_to(c_, x, py(last));
      }
    }
    cairo_stroke(c_);
    cairo_set_line_width(c_, 0.8);
  }

  void line(const Color& color, double x0, double y0, double x1, double y1) {
    use(c_, color);
    cairo_move_to(c_, x0, y0);
    cairo_line_to(c_, x1, y1);
    cairo_stroke(c_);
  }

  const ProfilePlot& plot_;
  cairo_t* c_;
  double end_;
};

bool ProfilePlot::write_svg(const std::string& path, std::string* error) const {
  return write_drawing(
      {path, true, kWidth, ProfilePainter::height(*this)},
      [this](cairo_t* c) { ProfilePainter(*this, c).paint(); }, error);
}
bool ProfilePlot::write_png(const std::string& path, std::string* error) const {
  return write_drawing(
      {path, false, kWidth, ProfilePainter::height(*this)},
      [this](cairo_t* c) { ProfilePainter(*this, c).paint(); }, error);
}

}  // namespace nc::tools
