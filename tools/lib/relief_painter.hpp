// SPDX-License-Identifier: Apache-2.0
// Draws a Relief shaded by light from one side. Private: needs cairo.
#pragma once

#include <cairo.h>

#include <functional>

#include "tools/lib/drawing.hpp"
#include "tools/lib/relief.hpp"

namespace nc::tools {

struct ReliefView {
  struct Point {
    double x, y;   // px on the page
    double depth;  // the larger, the nearer to who looks
  };
  std::function<Point(const Relief::Place&)> project;
  std::function<Color(float value)> color;
  double light[3];  // towards it; any length
  double width, height;  // px of the page
};

void paint_relief(cairo_t* c, const Relief& relief, const ReliefView& view);

}  // namespace nc::tools
