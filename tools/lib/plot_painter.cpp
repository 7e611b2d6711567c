// SPDX-License-Identifier: Apache-2.0
// Draws a ToolpathPlot with cairo: projection, axes with ticks in mm, the path, a legend and a scale bar.
//
// Isometric projection from (+X, -Y, +Z): the unit vectors to the right and up on the page are (1, 1, 0)/sqrt 2 and
// (-1, 1, 2)/sqrt 6. So the three axes are shortened by the same factor, sqrt(2/3), and one scale bar is right for all
// of them.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "tools/lib/drawing.hpp"
#include "tools/lib/plot_pieces.hpp"
#include "tools/lib/relief_painter.hpp"
#include "tools/lib/toolpath_plot.hpp"

namespace nc::tools {
namespace {

constexpr double kWidth = 1400, kHeight = 1000;  // px in the PNG, points in the SVG
constexpr double kLeft = 90, kRight = 60, kTop = 90, kBottom = 110;
constexpr double kMinPixels = 0.3;  // vertices nearer than this to the last one that was drawn are skipped
constexpr int kStrokeChunk = 500;   // vertices in one stroke, because the time of cairo for a stroke grows faster than its length
constexpr double kIsoShortening = 0.81649658092772603;  // sqrt(2/3)

constexpr Color kRapid{0.85, 0.20, 0.10}, kFeed{0.05, 0.30, 0.75}, kStart{0.10, 0.55, 0.20}, kEnd{0.15, 0.15, 0.15},
    kAlarm{0.80, 0.00, 0.55};
constexpr Color kSurface{0.42, 0.58, 0.86};  // surface of feed moves when the colour shows the kind; light enough that shades are seen
// Direction towards the light for each PlotView: it comes from the left of the viewer, in XY also from above on the page.
constexpr double kLight[][3] = {{-0.75, 0.0, 0.65}, {-0.55, 0.45, 0.70}, {-0.55, -0.45, 0.70}, {0.45, -0.55, 0.70}};
constexpr unsigned kShades = 16;
// Colours from low to high values; neither end is as light as the page or as red as the rapids.
constexpr Color kRamp[] = {{0.27, 0.00, 0.33}, {0.23, 0.32, 0.55}, {0.13, 0.57, 0.55}, {0.37, 0.79, 0.38}, {0.90, 0.80, 0.10}};
constexpr Color kTools[] = {{0.05, 0.30, 0.75}, {0.00, 0.55, 0.30}, {0.90, 0.55, 0.00}, {0.50, 0.20, 0.65},
                            {0.00, 0.60, 0.70}, {0.45, 0.30, 0.15}, {0.85, 0.35, 0.60}, {0.40, 0.40, 0.40}};
// By nc_side.
constexpr Color kSides[] = {{0.05, 0.30, 0.75}, {0.00, 0.55, 0.30}, {0.90, 0.55, 0.00}, {0.50, 0.20, 0.65}};
constexpr const char* kSideNames[] = {"no side", "on the left", "on the right", "in space"};
constexpr Color kProgrammed{0.45, 0.45, 0.45}, kDisc{0.65, 0.65, 0.65};
// The part of a sentence that fits beside the legend.
std::string first_line(const std::string& text) {
  constexpr size_t kMost = 150;
  std::string line = text.substr(0, text.find('\n'));
  if (line.size() <= kMost) return line;
  size_t end = kMost;
  while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xC0) == 0x80) --end;  // does not cut inside a character of UTF-8
  return line.substr(0, end) + "...";
}

constexpr double kMark = 4.5;            // px: half of a mark's width
constexpr double kArrow = 7.0;           // px
constexpr double kArrowDistance = 120;   // shortest path from one arrow to the next, px
constexpr double kMostArrows = 60;       // most arrows in a drawing, because more of them would hide the path

struct Page {
  double u, v;  // to the right and up; mm, or px after px() and py()
};

}  // namespace

/** Paints one drawing on one cairo context. */
class PlotPainter {
 public:
  PlotPainter(const ToolpathPlot& plot, cairo_t* context)
      : plot_(plot), c_(context), box_(plot_box(plot)), relief_(plot_relief(plot, box_)), ink_(ink_of(plot, box_, relief_)) {}

  void paint() {
    fit();
    read_values();
    if (plot_.view_ == PlotView::kIsometric)
      box();
    else
      frame();
    surface();
    beside();
    path(Ink::kRapid);
    path(Ink::kFeed);
    directions();
    marks();
    head();
    color_legend();
    scale_bar();
  }

 private:
  Page project(double x, double y, double z) const {
    switch (plot_.view_) {
      case PlotView::kXY:
        return {x, y};
      case PlotView::kXZ:
        return {x, z};
      case PlotView::kYZ:
        return {y, z};
      case PlotView::kIsometric:
        break;
    }
    return {(x + y) / std::sqrt(2.0), (-x + y + 2.0 * z) / std::sqrt(6.0)};
  }
  double px(const Page& p) const { return kLeft + offset_x_ + (p.u - low_.u) * scale_; }
  double py(const Page& p) const { return kHeight - kBottom - offset_y_ - (p.v - low_.v) * scale_; }

  // Chooses the scale, which is the same in both directions, and puts the path in the middle.
  void fit() {
    for (int i = 0; i < 3; ++i) {
      lo_[i] = box_.low[i];
      hi_[i] = box_.high[i];
    }
    low_ = high_ = project(lo_[0], lo_[1], lo_[2]);
    for (int corner = 1; corner < 8; ++corner) {
      const Page p =
          project(corner & 1 ? hi_[0] : lo_[0], corner & 2 ? hi_[1] : lo_[1], corner & 4 ? hi_[2] : lo_[2]);
      low_ = {std::min(low_.u, p.u), std::min(low_.v, p.v)};
      high_ = {std::max(high_.u, p.u), std::max(high_.v, p.v)};
    }
    const double span = std::max({high_.u - low_.u, high_.v - low_.v, 1e-3});
    const double pad = 0.03 * span;
    low_ = {low_.u - pad, low_.v - pad};
    high_ = {high_.u + pad, high_.v + pad};
    const double room_x = kWidth - kLeft - kRight, room_y = kHeight - kTop - kBottom;
    scale_ = std::min(room_x / (high_.u - low_.u), room_y / (high_.v - low_.v));
    offset_x_ = (room_x - (high_.u - low_.u) * scale_) / 2;
    offset_y_ = (room_y - (high_.v - low_.v) * scale_) / 2;
  }

  // Views of a plane: draws a frame, ticks with a light grid, and the names of the axes.
  void frame() {
    const bool yz = plot_.view_ == PlotView::kYZ, xy = plot_.view_ == PlotView::kXY;
    const double x0 = px(low_), x1 = px(high_), y0 = py(low_), y1 = py(high_);
    cairo_set_line_width(c_, 0.8);
    const double step = nice_step(std::max(high_.u - low_.u, high_.v - low_.v), 12);
    for (const double t : ticks_between(low_.u, high_.u, step)) {
      const double x = px({t, low_.v});
      line(kGrid, x, y0, x, y1);
      line(kInk, x, y0, x, y0 + 5);
      put_text(c_, x, y0 + 20, tick_text(t), 13, 0.5);
    }
    for (const double t : ticks_between(low_.v, high_.v, step)) {
      const double y = py({low_.u, t});
      line(kGrid, x0, y, x1, y);
      line(kInk, x0 - 5, y, x0, y);
      put_text(c_, x0 - 9, y + 4, tick_text(t), 13, 1.0);
    }
    use(c_, kInk);
    cairo_rectangle(c_, x0, y1, x1 - x0, y0 - y1);
    cairo_stroke(c_);
    put_text(c_, x1, y0 + 40, std::string(yz ? "Y" : "X") + " [mm]", 15, 1.0);
    put_text(c_, x0 - 9, y1 - 10, std::string(xy ? "Y" : "Z") + " [mm]", 15, 0.5);
  }

  // Isometric view: draws the box around the path, and ticks along its three front edges.
  void box() {
    cairo_set_line_width(c_, 0.8);
    for (int edge = 0; edge < 12; ++edge) {
      const int axis = edge / 4, b = (axis + 1) % 3, d = (axis + 2) % 3;
      double from[3], to[3];
      from[b] = to[b] = edge & 1 ? hi_[b] : lo_[b];
      from[d] = to[d] = edge & 2 ? hi_[d] : lo_[d];
      from[axis] = lo_[axis];
      to[axis] = hi_[axis];
      const Page p = project(from[0], from[1], from[2]), q = project(to[0], to[1], to[2]);
      line(kGrid, px(p), py(p), px(q), py(q));
    }
    const double step = nice_step(std::max({hi_[0] - lo_[0], hi_[1] - lo_[1], hi_[2] - lo_[2], 1e-3}), 8);
    // X along the front edge at the lowest Y, Y along the right edge at the highest X, Z up the left edge.
    ticks(0, step, lo_[1], lo_[2], -10, 16, 1.0, "X");
    ticks(1, step, hi_[0], lo_[2], 10, 16, 0.0, "Y");
    ticks(2, step, lo_[0], lo_[1], -12, 4, 1.0, "Z");
  }

  // Draws the ticks of one axis of the box; `first` and `second` are the coordinates of the two other axes, in the order X, Y, Z.
  void ticks(int axis, double step, double first, double second, double dx, double dy, double align,
             const char* name) {
    const auto at = [&](double t) {
      double p[3];
      int other = 0;
      for (int i = 0; i < 3; ++i) p[i] = i == axis ? t : (other++ == 0 ? first : second);
      return project(p[0], p[1], p[2]);
    };
    line(kInk, px(at(lo_[axis])), py(at(lo_[axis])), px(at(hi_[axis])), py(at(hi_[axis])));
    for (const double t : ticks_between(lo_[axis], hi_[axis], step)) {
      const Page p = at(t);
      line(kInk, px(p), py(p), px(p) + dx / 2, py(p) + dy / 4);
      put_text(c_, px(p) + dx, py(p) + dy, tick_text(t), 13, align);
    }
    const Page middle = at((lo_[axis] + hi_[axis]) / 2);
    put_text(c_, px(middle) + 4 * dx, py(middle) + 2.2 * dy, std::string(name) + " [mm]", 15, align);
  }

  void line(const Color& color, double x0, double y0, double x1, double y1) {
    use(c_, color);
    cairo_move_to(c_, x0, y0);
    cairo_line_to(c_, x1, y1);
    cairo_stroke(c_);
  }

  // Finds the lowest and highest value of the feed pieces, and for the colour by tool all tools.
  void read_values() {
    bool any = false;
    for (size_t i = 1; i < plot_.vertices_.size(); ++i) {
      const auto& v = plot_.vertices_[i];
      if (v.rapid) continue;
      low_value_ = any ? std::min(low_value_, v.value) : v.value;
      high_value_ = any ? std::max(high_value_, v.value) : v.value;
      any = true;
      if (plot_.color_ == PlotColor::kTool) tools_.insert(v.value);
    }
  }

  // The index of the colour for a value. Values are grouped into kShades colours, so that pieces of one colour can be drawn together.
  unsigned shade(float value) const {
    if (plot_.color_ == PlotColor::kKind) return 0;
    if (plot_.color_ == PlotColor::kSide) return static_cast<unsigned>(value);
    if (plot_.color_ == PlotColor::kTool)
      return static_cast<unsigned>(std::distance(tools_.begin(), tools_.find(value))) % std::size(kTools);
    if (!(high_value_ > low_value_)) return 0;
    const float share = (value - low_value_) / (high_value_ - low_value_);
    return std::min(kShades - 1, static_cast<unsigned>(share * kShades));
  }

  Color feed_color(unsigned shade) const {
    if (plot_.color_ == PlotColor::kKind) return kFeed;
    if (plot_.color_ == PlotColor::kTool) return kTools[shade];
    if (plot_.color_ == PlotColor::kSide) return kSides[shade % std::size(kSides)];
    const double place = shade / (kShades - 1.0) * (std::size(kRamp) - 1);
    const size_t i = std::min(std::size(kRamp) - 2, static_cast<size_t>(place));
    const double t = place - static_cast<double>(i);
    const Color &a = kRamp[i], &b = kRamp[i + 1];
    return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
  }

  void legend_line(const Color& color, double y, const char* text) {
    const double x = kWidth - kRight - 130;
    line(color, x, y - 5, x + 40, y - 5);
    use(c_, kInk);
    put_text(c_, x + 50, y, text, 14);
  }

  // Draws the programmed path, and the tool at the ends of its blocks.
  void beside() {
    const auto to = [this](const double* x, bool begins) {
      const Page p = project(x[0], x[1], x[2]);
      if (begins) cairo_move_to(c_, px(p), py(p));
      else cairo_line_to(c_, px(p), py(p));
    };
    constexpr size_t kMostDiscs = 80;  // more of them would hide the path
    const std::vector<PlotDisc>& discs = plot_.discs();
    const size_t every = std::max<size_t>(1, (discs.size() + kMostDiscs - 1) / kMostDiscs);
    use(c_, kDisc);
    cairo_set_line_width(c_, 0.8);
    for (size_t i = 0; i < discs.size(); i += every) {
      constexpr unsigned kSteps = 72;
      for (unsigned k = 0; k <= kSteps; ++k) {
        double x[3] = {discs[i].x[0], discs[i].x[1], discs[i].x[2]};
        x[discs[i].axis[0]] += discs[i].radius * std::cos(2 * M_PI * k / kSteps);
        x[discs[i].axis[1]] += discs[i].radius * std::sin(2 * M_PI * k / kSteps);
        to(x, k == 0);
      }
      cairo_stroke(c_);
    }
    use(c_, kProgrammed);
    cairo_set_line_width(c_, 1.0);
    const std::vector<ProgrammedVertex>& all = plot_.programmed();
    for (size_t i = 1; i < all.size(); ++i) {
      if (!all[i].beside) continue;
      const double a[3] = {all[i - 1].x[0], all[i - 1].x[1], all[i - 1].x[2]}, b[3] = {all[i].x[0], all[i].x[1], all[i].x[2]};
      to(a, true);
      to(b, false);
      cairo_stroke(c_);
    }
  }

  // Draws the meaning of the colours at the right edge below the head.
  void color_legend() {
    const double x = kWidth - kRight - 130;
    double y = kTop + 20;
    if (plot_.color_ == PlotColor::kKind || plot_.vertices_.empty()) return;
    cairo_set_line_width(c_, 3);
    if (plot_.color_ == PlotColor::kSide) {
      for (unsigned k = 0; k < std::size(kSides); ++k, y += 20) legend_line(kSides[k], y, kSideNames[k]);
      cairo_set_line_width(c_, 1);
      legend_line(kProgrammed, y, plot_.beside_all() ? "programmed" : "programmed (in part)");
      return;
    }
    if (plot_.color_ == PlotColor::kTool) {
      for (const float tool : tools_) {
        if (y > kHeight - kBottom) {
          put_text(c_, x, y, "and more", 14);
          return;
        }
        line(feed_color(static_cast<unsigned>(std::distance(tools_.begin(), tools_.find(tool))) % std::size(kTools)), x, y - 5, x + 40, y - 5);
        use(c_, kInk);
        put_text(c_, x + 50, y, tool == 0 ? "no tool" : "T" + tick_text(double{tool}), 14);
        y += 20;
      }
      return;
    }
    put_text(c_, x, y, plot_.color_ == PlotColor::kZ ? "Z [mm]" : plot_.executed_ ? "speed [mm/min]" : "feed [mm/min]", 14);
    constexpr double kBar = 8;  // px, height of a shade
    for (unsigned k = 0; k < kShades; ++k) {
      use(c_, feed_color(kShades - 1 - k));
      cairo_rectangle(c_, x, y + 10 + k * kBar, 40, kBar);
      cairo_fill(c_);
    }
    use(c_, kInk);
    put_text(c_, x + 50, y + 20, tick_text(std::round(double{high_value_} * 1e3) / 1e3), 14);
    put_text(c_, x + 50, y + 10 + kShades * kBar, tick_text(std::round(double{low_value_} * 1e3) / 1e3), 14);
  }

  // Draws the surface that dense passes leave, lit from the left. (If the light came from below on the page, a hollow would look like a hill.)
  void surface() {
    if (!relief_.any()) return;
    ReliefView view;
    view.project = [this](const Relief::Place& p) {
      const Page page = project(p.x, p.y, p.z);
      return ReliefView::Point{px(page), py(page), depth(p)};
    };
    view.color = [this](float value) { return plot_.color_ == PlotColor::kKind ? kSurface : feed_color(shade(value)); };
    for (int i = 0; i < 3; ++i) view.light[i] = kLight[static_cast<int>(plot_.view_)][i];
    view.width = kWidth;
    view.height = kHeight;
    paint_relief(c_, relief_, view);
  }

  // The coordinate of a place towards the viewer.
  double depth(const Relief::Place& p) const {
    switch (plot_.view_) {
      case PlotView::kXY:
        return p.z;
      case PlotView::kXZ:
        return -p.y;
      case PlotView::kYZ:
        return p.x;
      case PlotView::kIsometric:
        break;
    }
    return p.x - p.y + p.z;
  }

  // Draws all pieces of one kind. Rapids are dashed and drawn first, feed moves over them.
  void path(Ink ink) {
    const bool rapid = ink == Ink::kRapid;
    const double dash[] = {6.0, 4.0};
    if (rapid) cairo_set_dash(c_, dash, 2, 0);
    use(c_, rapid ? kRapid : kFeed);
    cairo_set_line_width(c_, rapid ? 1.0 : 1.2);
    cairo_set_line_join(c_, CAIRO_LINE_JOIN_ROUND);
    bool open = false;
    int pieces = 0;
    double last_x = 0, last_y = 0;
    unsigned shade_now = 0;
    const auto shade_of = [&](size_t i) { return rapid ? 0 : shade(ink_[i].value); };
    for (size_t i = 1; i < ink_.size(); ++i) {
      if (ink_[i].ink != ink) {
        if (open) cairo_stroke(c_);
        open = false;
        continue;
      }
      const Page to = on_page(i);
      if (open && shade_of(i) != shade_now) {
        cairo_stroke(c_);
        open = false;
      }
      if (!open) {
        shade_now = shade_of(i);
        if (!rapid) use(c_, feed_color(shade_now));
        const Page from = on_page(i - 1);
        cairo_move_to(c_, last_x = from.u, last_y = from.v);
        open = true;
        pieces = 0;
      }
      const bool run_ends = i + 1 == ink_.size() || ink_[i + 1].ink != ink || shade_of(i + 1) != shade_now;
      if (!run_ends && std::hypot(to.u - last_x, to.v - last_y) < kMinPixels) continue;
      cairo_line_to(c_, last_x = to.u, last_y = to.v);
      if (++pieces >= kStrokeChunk) {
        cairo_stroke(c_);
        cairo_move_to(c_, to.u, to.v);
        pieces = 0;
      }
    }
    if (open) cairo_stroke(c_);
    cairo_new_path(c_);
    cairo_set_dash(c_, nullptr, 0, 0);
  }

  // The place of a vertex on the page, px.
  Page on_page(size_t i) const {
    const Page p = project(ink_[i].x, ink_[i].y, ink_[i].z);
    return {px(p), py(p)};
  }

  // Draws arrows along the path at equal distances; the first one comes after half a distance.
  void directions() {
    double total = 0;
    for (size_t i = 1; i < ink_.size(); ++i)
      if (ink_[i].ink != Ink::kNone) total += std::hypot(on_page(i).u - on_page(i - 1).u, on_page(i).v - on_page(i - 1).v);
    const double distance = std::max(kArrowDistance, total / kMostArrows);
    double due = std::min(distance, total) / 2;
    for (size_t i = 1; i < ink_.size(); ++i) {
      if (ink_[i].ink == Ink::kNone) continue;
      const Page from = on_page(i - 1), to = on_page(i);
      const double length = std::hypot(to.u - from.u, to.v - from.v);
      while (due < length) {
        arrow(ink_[i].ink == Ink::kRapid ? kRapid : feed_color(shade(ink_[i].value)),
              {from.u + (to.u - from.u) * due / length, from.v + (to.v - from.v) * due / length},
              {(to.u - from.u) / length, (to.v - from.v) / length});
        due += distance;
      }
      due -= length;
    }
  }

  // Draws an arrow whose point is `tip`; `way` is a unit vector. Both are on the page.
  void arrow(const Color& color, const Page& tip, const Page& way) {
    constexpr double kSlim = 0.45;  // half of its width divided by its length
    use(c_, color);
    cairo_move_to(c_, tip.u, tip.v);
    cairo_line_to(c_, tip.u - kArrow * (way.u + kSlim * way.v), tip.v - kArrow * (way.v - kSlim * way.u));
    cairo_line_to(c_, tip.u - kArrow * (way.u - kSlim * way.v), tip.v - kArrow * (way.v + kSlim * way.u));
    cairo_close_path(c_);
    cairo_fill(c_);
  }

  // Marks the place where the path begins and where it ends, at the end of the program or in an alarm. When a place is outside of the frame, the mark is at the
  // frame and has the coordinates of the place.
  void marks() {
    if (plot_.vertices_.empty()) return;
    const PlotVertex &first_vertex = plot_.vertices_.front(), &last_vertex = plot_.vertices_.back();
    const std::string start_place = place_outside(first_vertex), end_place = place_outside(last_vertex);
    const Page first = mark_place(first_vertex, start_place.empty(), true), last = mark_place(last_vertex, end_place.empty(), false);
    const bool alarmed = !plot_.alarm_.empty();
    if (alarmed) alarm_mark(last);
    else end_mark(last);
    start_mark(first);
    if (!start_place.empty()) mark_text(first, 4 * kMark, "start at" + start_place);
    if (alarmed || !end_place.empty())
      mark_text(last, -2 * kMark, (alarmed ? "alarm " + plot_.alarm_ : std::string("end")) + (end_place.empty() ? "" : " at" + end_place));
  }

  // The place of a mark on the page. For a place outside of the frame it is where the path enters the frame first or leaves it last.
  Page mark_place(const PlotVertex& vertex, bool inside, bool first) const {
    for (size_t k = 1; !inside && k < ink_.size(); ++k) {
      const size_t i = first ? k : ink_.size() - k;
      if (ink_[i].ink != Ink::kNone) return on_page(first ? i - 1 : i);
    }
    const PlotVertex v = into_box(vertex, box_);
    const Page p = project(v.x, v.y, v.z);
    return {px(p), py(p)};
  }

  // A text such as " X0 Y0 Z400, outside"; empty for a place in the frame.
  std::string place_outside(const PlotVertex& v) const {
    const PlotVertex in = into_box(v, box_);
    if (in.x == v.x && in.y == v.y && in.z == v.z) return "";
    const double place[3] = {v.x, v.y, v.z};
    std::string text;
    for (int i = 0; i < 3; ++i) text += std::string(" ") + "XYZ"[i] + tick_text(std::round(place[i] * 1e3) / 1e3);
    return text + ", outside";
  }

  // Writes a text beside a mark, on the side where there is room, `down` px below it.
  void mark_text(const Page& at, double down, const std::string& text) {
    use(c_, kInk);
    const bool left = at.u > kWidth / 2;
    put_text(c_, at.u + (left ? -3 : 3) * kMark, at.v + down, text, 14, left ? 1.0 : 0.0);
  }

  void start_mark(const Page& at) {
    use(c_, kStart);
    cairo_arc(c_, at.u, at.v, kMark, 0, 2 * M_PI);
    cairo_fill(c_);
  }

  // The mark of the end is hollow and larger than that of the start, so that both are visible when the path ends where it began.
  void end_mark(const Page& at) {
    use(c_, kEnd);
    cairo_set_line_width(c_, 1.6);
    cairo_rectangle(c_, at.u - 1.5 * kMark, at.v - 1.5 * kMark, 3 * kMark, 3 * kMark);
    cairo_stroke(c_);
  }

  void alarm_mark(const Page& at) {
    cairo_set_line_width(c_, 3);
    line(kAlarm, at.u - 2 * kMark, at.v - 2 * kMark, at.u + 2 * kMark, at.v + 2 * kMark);
    line(kAlarm, at.u - 2 * kMark, at.v + 2 * kMark, at.u + 2 * kMark, at.v - 2 * kMark);
  }

  // The sentence about the part of the path outside of the frame; empty when the whole path is inside.
  std::string outside() const {
    if (!goes_outside(plot_, box_)) return "";
    std::string text = "; rapids are cut off at the frame: the path goes from";
    for (const double* end : {plot_.low_, plot_.high_}) {
      if (end == plot_.high_) text += " to";
      for (int i = 0; i < 3; ++i) text += std::string(" ") + "XYZ"[i] + tick_text(std::round(end[i] * 1e3) / 1e3);
    }
    return text;
  }

  void head() {
    use(c_, kInk);
    put_text(c_, kLeft, 40, plot_.title_, 22);
    static constexpr const char* kViews[] = {"isometric", "XY", "XZ", "YZ"};
    put_text(c_, kLeft, 62,
             std::string("view ") + kViews[static_cast<int>(plot_.view_)] +
                 (plot_.coordinates_ == PlotCoordinates::kWork ? ", workpiece coordinates of the tool's tip, mm"
                                                               : ", machine coordinates, mm") +
                 (relief_.any() ? "; dense passes shaded" : "") + outside(),
             13);
    if (!plot_.sentence_.empty()) {
      use(c_, kAlarm);
      put_text(c_, kLeft, 80, first_line(plot_.sentence_), 13);
    }
    const double x = kWidth - kRight - 130;
    const double dash[] = {6.0, 4.0};
    cairo_set_line_width(c_, 2);
    line(plot_.color_ == PlotColor::kKind ? kFeed : kInk, x, 30, x + 40, 30);
    cairo_set_dash(c_, dash, 2, 0);
    line(kRapid, x, 50, x + 40, 50);
    cairo_set_dash(c_, nullptr, 0, 0);
    start_mark({x + 8, 69});
    const bool alarmed = !plot_.alarm_.empty();
    if (alarmed) alarm_mark({x + 76, 69});
    else end_mark({x + 76, 69});
    use(c_, kInk);
    put_text(c_, x + 50, 35, "feed", 14);
    put_text(c_, x + 50, 55, "rapid", 14);
    put_text(c_, x + 20, 74, "start", 14);
    put_text(c_, x + 92, 74, alarmed ? "alarm " + plot_.alarm_ : "end", 14);
  }

  void scale_bar() {
    const double unit = scale_ * (plot_.view_ == PlotView::kIsometric ? kIsoShortening : 1.0);
    const double length_mm = nice_step(220.0 / unit, 1.0) > 300.0 / unit ? nice_step(220.0 / unit, 2.0)
                                                                         : nice_step(220.0 / unit, 1.0);
    const double x0 = kLeft, x1 = kLeft + length_mm * unit, y = kHeight - 28;
    cairo_set_line_width(c_, 2);
    line(kInk, x0, y, x1, y);
    line(kInk, x0, y - 5, x0, y + 5);
    line(kInk, x1, y - 5, x1, y + 5);
    std::string text = tick_text(length_mm) + " mm";
    if (plot_.view_ == PlotView::kIsometric) text += " along each axis";
    put_text(c_, x1 + 12, y + 5, text, 14);
  }

  const ToolpathPlot& plot_;
  cairo_t* c_;
  PlotBox box_;
  Relief relief_;
  std::vector<InkVertex> ink_;
  double lo_[3] = {0, 0, 0}, hi_[3] = {0, 0, 0};
  Page low_{0, 0}, high_{0, 0};
  float low_value_ = 0, high_value_ = 0;
  std::set<float> tools_;
  double scale_ = 1, offset_x_ = 0, offset_y_ = 0;
};

bool ToolpathPlot::write_svg(const std::string& path, std::string* error) const {
  return write_drawing({path, true, kWidth, kHeight}, [this](cairo_t* c) { PlotPainter(*this, c).paint(); }, error);
}
bool ToolpathPlot::write_png(const std::string& path, std::string* error) const {
  return write_drawing({path, false, kWidth, kHeight}, [this](cairo_t* c) { PlotPainter(*this, c).paint(); }, error);
}

}  // namespace nc::tools
