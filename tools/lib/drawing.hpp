// SPDX-License-Identifier: Apache-2.0
// What the drawings of the tools share: ink, text, ticks, and the way into an SVG or PNG file. Private: needs
// cairo.
#pragma once

#include <cairo.h>

#include <functional>
#include <string>
#include <vector>

namespace nc::tools {

struct Color {
  double r, g, b;
};
inline constexpr Color kInk{0.15, 0.15, 0.15}, kGrid{0.85, 0.85, 0.85};

void use(cairo_t* c, const Color& color);

/** Tick distance: 1, 2 or 5 times a power of ten, so that there are at most about `count` of them. */
double nice_step(double span, double count);

/** Multiples of `step` from low to high. */
std::vector<double> ticks_between(double low, double high, double step);

/** A tick's number. */
std::string tick_text(double value);

/** `align` 0: begins at x, 1: ends there. */
void put_text(cairo_t* c, double x, double y, const std::string& text, double size, double align = 0.0);

/** Where a drawing goes; px in a PNG, points in an SVG. */
struct DrawingFile {
  std::string path;
  bool svg;
  double width, height;
};

/** Paint on a white page and write it. @return false with *error when the file cannot be written. */
bool write_drawing(const DrawingFile& file, const std::function<void(cairo_t*)>& paint, std::string* error);

}  // namespace nc::tools
