// SPDX-License-Identifier: Apache-2.0
// G30.1 to G30.6: to the tool change position, the axes in the order of the code (M700 13.13).
#include <initializer_list>

#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// The table of 13.13: axes of one step stand together.
constexpr const char* kOrder[6][3] = {
    {"Z", "XY", ""},   // G30.1
    {"Z", "X", "Y"},   // G30.2
    {"Z", "Y", "X"},   // G30.3
    {"X", "YZ", ""},   // G30.4
    {"Y", "XZ", ""},   // G30.5
    {"XYZ", "", ""}    // G30.6
};

uint32_t axes_named(const Interpreter& in, const char* names) {
  uint32_t axes = 0;
  for (; *names != 0; ++names)
    if (in.axis_of[*names - 'A'] >= 0) axes |= 1u << in.axis_of[*names - 'A'];
  return axes;
}

}  // namespace

Did do_tool_change_return(Interpreter& in) {
  if (in.words.axes != 0) return in.raise(Condition::format_error, 'G', in.words.one_shot_code / 10.0);
  const auto& order = kOrder[in.words.one_shot_code - 301];
  AxisVec place;
  for (unsigned i = 0; i < in.axis_count; ++i) place[i] = in.settings.tool_change[i];
  const uint32_t standard = axes_named(in, "XYZ"), added = in.settings.tool_change_axes & ~standard;
  uint32_t all = added;
  bool first = true;
  for (const char* names : order) {
    const uint32_t axes = axes_named(in, names);
    if (axes == 0) continue;
    if (!first) in.emit_stop_point();  // in single block each step is a block of its own
    first = false;
    move_to_place(in, place, axes);
    all |= axes;
  }
  for (unsigned i = 0; i < in.axis_count; ++i) {  // added axes by #1092, behind the others
    if (((added >> i) & 1) == 0) continue;
    if (!first) in.emit_stop_point();
    first = false;
    move_to_place(in, place, 1u << i);
  }
  cancel_length_of(in, all);
  return Did::done;
}

}  // namespace nc
