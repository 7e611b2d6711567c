// SPDX-License-Identifier: Apache-2.0
// cairo, loaded when the first picture is drawn. Linked as other libraries are, it would bring twenty more (X11 among them) into every start of ncsim, and
// a board without a screen would need them all to check a program. Private header: needs cairo's own headers.
#pragma once

#include <cairo-svg.h>
#include <cairo.h>

#include <string>

namespace nc::tools {

// The functions of cairo that the painters use. In this namespace each name is a pointer to the function of that name, so that painters read like any other
// code that uses cairo; load_cairo() sets the pointers. One that is missing in this list is found by the linker.
#define NC_FOR_EACH_CAIRO_FUNCTION(X)                                                                                                              \
  X(cairo_arc)                                                                                                                                     \
  X(cairo_close_path)                                                                                                                              \
  X(cairo_create)                                                                                                                                  \
  X(cairo_destroy)                                                                                                                                 \
  X(cairo_fill)                                                                                                                                    \
  X(cairo_get_source)                                                                                                                              \
  X(cairo_image_surface_create)                                                                                                                    \
  X(cairo_image_surface_get_data)                                                                                                                  \
  X(cairo_image_surface_get_stride)                                                                                                                \
  X(cairo_line_to)                                                                                                                                 \
  X(cairo_move_to)                                                                                                                                 \
  X(cairo_new_path)                                                                                                                                \
  X(cairo_paint)                                                                                                                                   \
  X(cairo_pattern_set_filter)                                                                                                                      \
  X(cairo_rectangle)                                                                                                                               \
  X(cairo_restore)                                                                                                                                 \
  X(cairo_save)                                                                                                                                    \
  X(cairo_scale)                                                                                                                                   \
  X(cairo_select_font_face)                                                                                                                        \
  X(cairo_set_dash)                                                                                                                                \
  X(cairo_set_font_size)                                                                                                                           \
  X(cairo_set_line_join)                                                                                                                           \
  X(cairo_set_line_width)                                                                                                                          \
  X(cairo_set_source_rgb)                                                                                                                          \
  X(cairo_set_source_surface)                                                                                                                      \
  X(cairo_show_text)                                                                                                                               \
  X(cairo_status)                                                                                                                                  \
  X(cairo_status_to_string)                                                                                                                        \
  X(cairo_stroke)                                                                                                                                  \
  X(cairo_surface_destroy)                                                                                                                         \
  X(cairo_surface_finish)                                                                                                                          \
  X(cairo_surface_mark_dirty)                                                                                                                      \
  X(cairo_surface_status)                                                                                                                          \
  X(cairo_surface_write_to_png_stream)                                                                                                             \
  X(cairo_svg_surface_create_for_stream)                                                                                                           \
  X(cairo_text_extents)

#define NC_CAIRO_POINTER(name) extern decltype(&::name) name;
NC_FOR_EACH_CAIRO_FUNCTION(NC_CAIRO_POINTER)
#undef NC_CAIRO_POINTER

/**
 * Loads cairo, once for the process. Any thread. Before the first call of it the pointers above are null.
 * @return false with *error where cairo is not installed or lacks a function; a later call tries again
 */
bool load_cairo(std::string* error);

}  // namespace nc::tools
