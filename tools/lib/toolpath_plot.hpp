// SPDX-License-Identifier: Apache-2.0
// Drawing of a tool path: rapid and feed told apart, axes with ticks in mm, a scale bar; as SVG and as PNG.
//
// The path is that of the tool's tip in workpiece coordinates, so that the drawing shows the part: radius
// compensation is in it, work offset and tool length are not. Machine coordinates, where all of these are in
// it, are the other choice. Drawn are the linear axes X, Y, Z. Arcs and helices are
// drawn from their geometry in steps of at most 3 degrees. Vertices are thinned when there are more than a
// drawing can show, so the memory is bounded whatever the program's length.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nc/nc.h"

namespace nc::tools {

/** From where the path is looked at. Isometric: from +X -Y +Z, Z up. */
enum class PlotView { kIsometric, kXY, kXZ, kYZ };

/** Whose coordinates are drawn; whoever adds the points gives them in these. */
enum class PlotCoordinates { kWork, kMachine };

/** What the colour of a feed piece says. */
enum class PlotColor { kKind, kTool, kFeed, kZ };

/** A vertex of the path, mm. */
struct PlotVertex {
  float x, y, z;
  float value;  // of the piece that ends here: what its colour says
  bool rapid;   // of the same piece
};

/** Collects a tool path and draws it. */
class ToolpathPlot {
 public:
  void set_title(std::string title) { title_ = std::move(title); }
  void set_view(PlotView view) { view_ = view; }

  void set_coordinates(PlotCoordinates coordinates) { coordinates_ = coordinates; }
  PlotCoordinates coordinates() const { return coordinates_; }

  void set_color(PlotColor color) { color_ = color; }
  /** The tool that cuts from here on. */
  void set_tool(double number) { tool_ = number; }

  /** The feed of the pieces from here on, for those that add_point() adds. */
  void set_feed(double mm_min) { feed_mm_min_ = mm_min; }

  /** The path is one that was driven: feeds are speeds. */
  void set_executed(bool executed) { executed_ = executed; }

  /** The path ends in an alarm of this code. */
  void set_alarm(std::string code) { alarm_ = std::move(code); }
  /** Why the path ends where it does, for the head: the alarm in words, for one. */
  void set_sentence(std::string text) { sentence_ = std::move(text); }

  /** A move of the item stream, drawn from `zero`: all zeros give machine coordinates (see nc_move_zero). */
  void add_move(const nc_move& move, const nc_system_config& system, const nc_axes& zero = {});

  /** A straight piece from the point before to this one, mm; the first point only sets the start. */
  void add_point(bool rapid, double x, double y, double z);

  /** Vertices that are kept. */
  size_t size() const { return vertices_.size(); }

  /** A vertex that is kept, mm. */
  std::array<double, 3> point(size_t i) const { return {vertices_[i].x, vertices_[i].y, vertices_[i].z}; }

  const std::vector<PlotVertex>& vertices() const { return vertices_; }

  /** Write the drawing. @return false with *error when the file cannot be written. */
  bool write_svg(const std::string& path, std::string* error) const;
  bool write_png(const std::string& path, std::string* error) const;

 private:
  friend class PlotPainter;
  void push(bool rapid, double x, double y, double z);
  void thin();

  std::vector<PlotVertex> vertices_;
  double min_step_ = 0.0;  // mm; shorter feed pieces are merged
  double low_[3] = {0, 0, 0}, high_[3] = {0, 0, 0};
  std::string title_ = "Tool path", alarm_, sentence_;
  PlotView view_ = PlotView::kIsometric;
  PlotColor color_ = PlotColor::kKind;
  double tool_ = 0.0, feed_mm_min_ = 0.0;
  PlotCoordinates coordinates_ = PlotCoordinates::kWork;
  bool executed_ = false;
};

}  // namespace nc::tools
