// SPDX-License-Identifier: Apache-2.0
// Drawing of a tool path with different lines for rapid and feed, axes with ticks in mm and a scale bar; as SVG and as PNG.
//
// The path is that of the tip of the tool in workpiece coordinates, so that the drawing shows the part: it contains radius
// compensation, but not work offset and tool length. The other choice is machine coordinates, which contain
// all of these. Only the linear axes X, Y, Z are drawn. Arcs and helices are
// drawn from their geometry in steps of at most 3 degrees. When there are more vertices than a
// drawing can show, their number is reduced, so the memory is bounded for programs of any length.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nc/nc.h"

namespace nc::tools {

/** The view of the path. The isometric view is from +X -Y +Z, with Z up. */
enum class PlotView { kIsometric, kXY, kXZ, kYZ };

/** The coordinates that are drawn; points must be added in these coordinates. */
enum class PlotCoordinates { kWork, kMachine };

/** What the colour of a feed piece shows. kSide: on which side of the programmed path the tool goes; the drawing then has that path, and the tool's disc at the
 * ends of its blocks. */
enum class PlotColor { kKind, kTool, kFeed, kZ, kSide };

/** Values of kSide. */
inline constexpr float kSideNone = NC_SIDE_NONE, kSideLeft = NC_SIDE_LEFT, kSideRight = NC_SIDE_RIGHT, kSideSpace = NC_SIDE_SPACE;

/** On which side of its programmed path a move goes, and in which plane, as nc_move_side() says. */
struct PlotSide {
  nc_side side = NC_SIDE_NONE;
  uint8_t plane_axis[2] = {0, 1};
};

/** A vertex of the path, mm. */
struct PlotVertex {
  float x, y, z;
  float value;  // value that the colour shows, of the piece that ends here
  bool rapid;   // the piece that ends here is a rapid
};

/** The end of a piece of the programmed path, mm. Where the tool is not beside it, it is not drawn. */
struct ProgrammedVertex {
  double x[3];
  bool beside;
};

/** The tool beside the end of a block, mm: a disc in the plane of these two axes. */
struct PlotDisc {
  double x[3], radius;
  int axis[2];
};

/** Collects a tool path and draws it. */
class ToolpathPlot {
 public:
  void set_title(std::string title) { title_ = std::move(title); }
  void set_view(PlotView view) { view_ = view; }

  void set_coordinates(PlotCoordinates coordinates) { coordinates_ = coordinates; }
  PlotCoordinates coordinates() const { return coordinates_; }

  void set_color(PlotColor color) { color_ = color; }
  /** Sets the tool for the pieces that follow. */
  void set_tool(double number) { tool_ = number; }

  /** Sets the side of the moves that follow. A move without a side that begins beside its programmed start leads back from the side of the one before. */
  void set_side(const PlotSide& side) { in_force_ = side; }

  /** Sets the feed for the pieces that add_point() adds from here on. */
  void set_feed(double mm_min) { feed_mm_min_ = mm_min; }

  /** Says that the path was executed, so that its feeds are speeds. */
  void set_executed(bool executed) { executed_ = executed; }

  /** Says that the path ends in an alarm with this code. */
  void set_alarm(std::string code) { alarm_ = std::move(code); }
  /** Sets a sentence for the head that tells why the path ends where it does, such as the alarm in words. */
  void set_sentence(std::string text) { sentence_ = std::move(text); }

  /** Adds a move of the item stream. `zero` is the workpiece zero of nc_move_zero(); all zeros give machine coordinates. */
  void add_move(const nc_move& move, const nc_system_config& system, const nc_axes& zero = {});

  /** Adds a straight piece from the previous point to this one, mm; the first point only sets the start. */
  void add_point(bool rapid, double x, double y, double z);

  /** The number of vertices that are kept. */
  size_t size() const { return vertices_.size(); }

  /** A vertex that is kept, mm. */
  std::array<double, 3> point(size_t i) const { return {vertices_[i].x, vertices_[i].y, vertices_[i].z}; }

  const std::vector<PlotVertex>& vertices() const { return vertices_; }

  /** The programmed path and the tool beside it, with kSide. They are collected for the first kMostBeside pieces; beside_all() is false when there were more. */
  const std::vector<ProgrammedVertex>& programmed() const { return programmed_; }
  const std::vector<PlotDisc>& discs() const { return discs_; }
  bool beside_all() const { return beside_all_; }
  static constexpr size_t kMostBeside = 200'000;

  /** Writes the drawing. @return false with *error when the file cannot be written. */
  bool write_svg(const std::string& path, std::string* error) const;
  bool write_png(const std::string& path, std::string* error) const;

 private:
  friend class PlotPainter;
  void push(bool rapid, double x, double y, double z);
  void thin();
  void note_side(const nc_move& move, const nc_system_config& system, const nc_axes& zero);

  std::vector<PlotVertex> vertices_;
  double min_step_ = 0.0;  // mm; shorter feed pieces are merged
  double low_[3] = {0, 0, 0}, high_[3] = {0, 0, 0};
  std::string title_ = "Tool path", alarm_, sentence_;
  PlotView view_ = PlotView::kIsometric;
  PlotColor color_ = PlotColor::kKind;
  double tool_ = 0.0, feed_mm_min_ = 0.0;
  PlotSide in_force_;
  float side_ = kSideNone;  // of the move added last
  double programmed_end_[3] = {0, 0, 0};  // of the move added last, mm
  std::vector<ProgrammedVertex> programmed_;
  std::vector<PlotDisc> discs_;
  bool beside_all_ = true;
  PlotCoordinates coordinates_ = PlotCoordinates::kWork;
  bool executed_ = false;
};

}  // namespace nc::tools
