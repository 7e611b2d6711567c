// SPDX-License-Identifier: Apache-2.0
// Drawing of a tool path: rapid and feed told apart, axes with ticks in mm, a scale bar; as SVG and as PNG.
//
// The path is the machine's (all compensation included) on the linear axes X, Y, Z. Arcs and helices are
// drawn from their geometry in steps of at most 3 degrees. Vertices are thinned when there are more than a
// drawing can show, so the memory is bounded whatever the program's length.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nc/nc.h"

namespace nc::tools {

/** From where the path is looked at. Isometric: from +X -Y +Z, Z up. */
enum class PlotView { kIsometric, kXY, kXZ, kYZ };

/** Collects a tool path and draws it. */
class ToolpathPlot {
 public:
  void set_title(std::string title) { title_ = std::move(title); }
  void set_view(PlotView view) { view_ = view; }

  /** A move of the item stream, machine coordinates. */
  void add_move(const nc_move& move, const nc_system_config& system);

  /** A straight piece from the point before to this one, mm; the first point only sets the start. */
  void add_point(bool rapid, double x, double y, double z);

  /** Vertices that are kept. */
  size_t size() const { return vertices_.size(); }

  /** Write the drawing. @return false with *error when the file cannot be written. */
  bool write_svg(const std::string& path, std::string* error) const;
  bool write_png(const std::string& path, std::string* error) const;

 private:
  friend class PlotPainter;
  struct Vertex {
    float x, y, z;
    bool rapid;  // of the piece that ends here
  };
  void push(bool rapid, double x, double y, double z);
  void thin();

  std::vector<Vertex> vertices_;
  double min_step_ = 0.0;  // mm; shorter feed pieces are merged
  double low_[3] = {0, 0, 0}, high_[3] = {0, 0, 0};
  std::string title_ = "Tool path";
  PlotView view_ = PlotView::kIsometric;
};

}  // namespace nc::tools
