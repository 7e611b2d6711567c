// SPDX-License-Identifier: Apache-2.0
// The part of a tool path that a drawing shows: its frame, and the path without the pieces outside of the frame and those in a shaded surface.
#pragma once

#include <vector>

#include "tools/lib/relief.hpp"
#include "tools/lib/toolpath_plot.hpp"

namespace nc::tools {

struct PlotBox {
  double low[3], high[3];  // mm
};

/** The frame: it contains all feed moves and the parts of the rapids near them. If it contained all rapids, a move to the reference point or to the tool
 * changer would make the part small. Without feed moves it contains everything. */
PlotBox plot_box(const ToolpathPlot& plot);

/** True when a part of the path lies outside of `box`. */
bool goes_outside(const ToolpathPlot& plot, const PlotBox& box);

/** The place in `box` that is nearest to this vertex. */
PlotVertex into_box(const PlotVertex& vertex, const PlotBox& box);

/** The surface that the feed moves make; any() is false when they make none. */
Relief plot_relief(const ToolpathPlot& plot, const PlotBox& box);

enum class Ink { kNone, kRapid, kFeed };

/** The end of a piece of the drawing, which begins at the previous vertex. */
struct InkVertex {
  float x, y, z, value;
  Ink ink;
};

/** The path with its rapids cut off at the box, and without the feed pieces that `relief` shows. */
std::vector<InkVertex> ink_of(const ToolpathPlot& plot, const PlotBox& box, const Relief& relief);

}  // namespace nc::tools
