// SPDX-License-Identifier: Apache-2.0
// G30.1 to G30.6: to the tool change position, the axes in the order of the code (M700 13.13).
#include <initializer_list>

#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// The table of 13.13: the axes of one step are in one element.
constexpr uint8_t kX = 1, kY = 2, kZ = 4;  // bit n: basic axis n
constexpr uint8_t kOrder[6][3] = {
    {kZ, kX | kY, 0},        // G30.1
    {kZ, kX, kY},            // G30.2
    {kZ, kY, kX},            // G30.3
    {kX, kY | kZ, 0},        // G30.4
    {kY, kX | kZ, 0},        // G30.5
    {kX | kY | kZ, 0, 0},    // G30.6
};

/// The axes of a set of basic axes that the machine has.
uint32_t axes_of(const InForce& in, uint8_t basic) {
  uint32_t axes = 0;
  for (unsigned i = 0; i < 3; ++i) {
    const int axis = in.axis_called(basic_along(i));
    if ((basic >> i & 1) != 0 && axis >= 0) axes |= 1u << axis;
  }
  return axes;
}

}  // namespace

Execution do_tool_change_return(BlockContext& in) {
  if (in.words.target.axes() != 0) return in.raise_code(Condition::format_error, *in.words.one_shot);
  const auto& order = kOrder[in.words.one_shot->number];
  AxisVec place;
  for (unsigned i = 0; i < in.axis_count; ++i) place[i] = in.settings.tool_change[i];
  const uint32_t standard = axes_of(in, kX | kY | kZ), added = in.settings.tool_change_axes & ~standard;
  uint32_t all = added;
  bool first = true;
  for (const uint8_t basic : order) {
    const uint32_t axes = axes_of(in, basic);
    if (axes == 0) continue;
    if (!first) in.emit_stop_point();  // single block stops after each step
    first = false;
    move_to_place(in, place, axes);
    all |= axes;
  }
  for (unsigned i = 0; i < in.axis_count; ++i) {  // axes added by #1092 move after the others
    if (((added >> i) & 1) == 0) continue;
    if (!first) in.emit_stop_point();
    first = false;
    move_to_place(in, place, 1u << i);
  }
  cancel_length_of(in, all);
  return Execution::done;
}

}  // namespace nc
