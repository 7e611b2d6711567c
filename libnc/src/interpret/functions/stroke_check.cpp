// SPDX-License-Identifier: Apache-2.0
// G22: an area in which no block may start or end (M700 15.7). Commit checks the moves, with every compensation in them (control/commit.cpp). G23 ends it
// and is handled with the reading modes of a block (execute_block.cpp).
#include <algorithm>

#include "interpret/functions/functions.hpp"

namespace nc {

Execution do_stroke_check(BlockContext& in) {
  const Command& w = in.words;
  StrokeBox box;
  uint32_t taken = in.set_of({Role::vector_x, Role::vector_y, Role::vector_z});
  bool any = false;
  for (unsigned i = 0; i < StrokeBox::kBasicAxes; ++i) {
    const WordSlot name = in.settings.plane_basic[i];
    const int axis = in.axis_words.axis(name);
    const Role lower = vector_along(i);
    if (axis < 0) {
      if (w.has(lower)) return in.raise(Condition::illegal_address, lower, w.get(lower));
      continue;
    }
    taken |= set_of(name);
    // (2): a word that is omitted is 0. The words are machine coordinates in the unit of the program, in G90 and in G91.
    const auto index = static_cast<unsigned>(axis);
    const bool turns = ((in.rotary >> index) & 1) != 0;
    const double upper_point = w.has(name) ? w.target[index] : 0;
    const double lower_point = w.has(lower) ? axis_value(in, index, w.written(lower), turns) : 0;
    if (upper_point == lower_point) continue;  // (3)
    box.axis[i] = static_cast<int8_t>(axis);
    box.turns[i] = ((in.settings.machine_turn >> index) & 1) != 0;
    box.low[i] = std::min(upper_point, lower_point);
    box.high[i] = std::max(upper_point, lower_point);
    any = true;
  }
  // (7): an address that has no meaning in this block.
  const uint32_t other = w.present & ~taken & ~in.set_of({Role::sequence_number, Role::program_number, Role::feed, Role::spindle_speed, Role::misc_code, Role::tool});
  if (other != 0) {
    return in.raise_first(Condition::illegal_address, other);
  }
  if (!any && in.dialect->rules.coordinate.stroke_check_needs_area) return in.raise_code(Condition::words_missing, *w.one_shot);
  box.outside = in.settings.box_outside;
  box.way = in.dialect->rules.coordinate.stroke_check_sees_way;
  in.state.stroke_box = any ? in.stroke_boxes.intern(box) + 1 : 0;
  in.state.modal.set(*w.one_shot);
  return Execution::done;
}

}  // namespace nc
