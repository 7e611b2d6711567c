// SPDX-License-Identifier: Apache-2.0
// See drawing.hpp.
#include "tools/lib/drawing.hpp"

#include <cmath>
#include <cstdio>

#include "tools/lib/number_text.hpp"
#include "tools/lib/whole_file.hpp"

#if defined(__SANITIZE_ADDRESS__)
#define NC_ADDRESS_SANITIZER 1
#elif defined(__has_feature)  // clang
#if __has_feature(address_sanitizer)
#define NC_ADDRESS_SANITIZER 1
#endif
#endif
#if defined(NC_ADDRESS_SANITIZER)
// fontconfig, which cairo uses to find the font, never frees some of its blocks.
extern "C" const char*
__lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier): the name that the sanitizer looks for
  return "leak:libfontconfig";
}
#endif

namespace nc::tools {
namespace {

cairo_status_t write_stream(void* closure, const unsigned char* data, unsigned length) {
  return std::fwrite(data, 1, length, static_cast<std::FILE*>(closure)) == length ? CAIRO_STATUS_SUCCESS
                                                                                  : CAIRO_STATUS_WRITE_ERROR;
}

}  // namespace

void use(cairo_t* c, const Color& color) {
  cairo_set_source_rgb(c, color.r, color.g, color.b);
}

double nice_step(double span, double count) {
  const double raw = span / count;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (double factor : {1.0, 2.0, 5.0})
    if (factor * power >= raw * (1.0 - 1e-9)) return factor * power;
  return 10.0 * power;
}

// The ticks are counted, because adding a small step to a large number may not change it, which would be an endless loop.
std::vector<double> ticks_between(double low, double high, double step) {
  constexpr int kMost = 100;
  std::vector<double> ticks;
  const double first = std::ceil(low / step - 1e-9);
  for (int k = 0; k < kMost && (first + k) * step <= high + 1e-9 * step; ++k)
    ticks.push_back((first + k) * step);
  return ticks;
}

std::string tick_text(double value) {
  char text[kNumberText];
  return std::string(text, number_text(value, text));
}

void put_text(cairo_t* c, double x, double y, const std::string& text, double size, double align) {
  cairo_set_font_size(c, size);
  cairo_text_extents_t extents;
  cairo_text_extents(c, text.c_str(), &extents);
  cairo_move_to(c, x - align * extents.x_advance, y);
  cairo_show_text(c, text.c_str());
}

bool write_drawing(const DrawingFile& target, const std::function<void(cairo_t*)>& paint,
                   std::string* error) {
  if (!load_cairo(error)) return false;
  WholeFile whole;
  std::string why;
  if (!whole.open(target.path, &why)) {
    if (error) *error = target.path + ": cannot be created";
    return false;
  }
  std::FILE* const file = whole.stream();
  cairo_surface_t* surface =
      target.svg ? cairo_svg_surface_create_for_stream(write_stream, file, target.width, target.height)
                 : cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(target.width),
                                              static_cast<int>(target.height));
  cairo_t* context = cairo_create(surface);
  cairo_set_source_rgb(context, 1, 1, 1);
  cairo_paint(context);
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  paint(context);
  cairo_status_t status = cairo_status(context);
  cairo_destroy(context);
  if (status == CAIRO_STATUS_SUCCESS && !target.svg)
    status = cairo_surface_write_to_png_stream(surface, write_stream, file);
  cairo_surface_finish(surface);
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface);
  cairo_surface_destroy(surface);
  if (status == CAIRO_STATUS_SUCCESS && whole.commit(&why)) return true;
  if (error)
    *error = target.path + ": " +
             (status == CAIRO_STATUS_SUCCESS ? "write error" : cairo_status_to_string(status));
  return false;
}

}  // namespace nc::tools
