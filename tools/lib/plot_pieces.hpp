// SPDX-License-Identifier: Apache-2.0
// What of a tool path a drawing shows: its frame, and the path without what lies outside of that or is part of a shaded surface.
#pragma once

#include <vector>

#include "tools/lib/relief.hpp"
#include "tools/lib/toolpath_plot.hpp"

namespace nc::tools {

struct PlotBox {
  double low[3], high[3];  // mm
};

/** The frame: all feed moves, and of the rapids what lies near to them. A way to the reference point or to the tool changer would otherwise
 * make the part small. Without feed moves, all that there is. */
PlotBox plot_box(const ToolpathPlot& plot);

/** Whether some of the path lies outside of `box`. */
bool goes_outside(const ToolpathPlot& plot, const PlotBox& box);

/** The place in `box` that is nearest to this vertex. */
PlotVertex into_box(const PlotVertex& vertex, const PlotBox& box);

/** The surface that the feed moves make; its any() is false where they make none. */
Relief plot_relief(const ToolpathPlot& plot, const PlotBox& box);

enum class Ink { kNone, kRapid, kFeed };

/** A piece of the drawing ends here; it has begun at the vertex before. */
struct InkVertex {
  float x, y, z, value;
  Ink ink;
};

/** The path with its rapids cut off at the box, and without the feed pieces that `relief` shows. */
std::vector<InkVertex> ink_of(const ToolpathPlot& plot, const PlotBox& box, const Relief& relief);

}  // namespace nc::tools
