// SPDX-License-Identifier: Apache-2.0
// Functions that the drawings of the tools share: colours, text, ticks, and writing an SVG or PNG file. Private header: needs
// cairo.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/lib/cairo_library.hpp"

namespace nc::tools {

struct Color {
  double r, g, b;
};
inline constexpr Color kInk{0.15, 0.15, 0.15}, kGrid{0.85, 0.85, 0.85};

void use(cairo_t* c, const Color& color);

/** The distance of ticks: 1, 2 or 5 times a power of ten, so that there are at most about `count` ticks. */
double nice_step(double span, double count);

/** Multiples of `step` from low to high. */
std::vector<double> ticks_between(double low, double high, double step);

/** The number at a tick. */
std::string tick_text(double value);

/** Writes a text; with `align` 0 it begins at x, with 1 it ends there. */
void put_text(cairo_t* c, double x, double y, const std::string& text, double size, double align = 0.0);

/** The file of a drawing; its size is in px for a PNG and in points for an SVG. */
struct DrawingFile {
  std::string path;
  bool svg;
  double width, height;
};

/** Paints on a white page and writes it. @return false with *error when the file cannot be written. */
bool write_drawing(const DrawingFile& file, const std::function<void(cairo_t*)>& paint, std::string* error);

}  // namespace nc::tools
