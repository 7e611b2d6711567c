// SPDX-License-Identifier: Apache-2.0
// Draws a Relief shaded by light from one side. Private header: needs cairo.
#pragma once

#include <functional>

#include "tools/lib/drawing.hpp"
#include "tools/lib/relief.hpp"

namespace nc::tools {

struct ReliefView {
  struct Point {
    double x, y;   // px on the page
    double depth;  // the larger, the nearer to the viewer
  };
  std::function<Point(const Relief::Place&)> project;
  std::function<Color(float value)> color;
  double light[3];  // direction towards the light; a vector of any length
  double width, height;  // size of the page in px
};

void paint_relief(cairo_t* c, const Relief& relief, const ReliefView& view);

}  // namespace nc::tools
