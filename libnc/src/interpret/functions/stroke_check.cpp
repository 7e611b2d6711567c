// SPDX-License-Identifier: Apache-2.0
// G22: an area in which no block may start or end (M700 15.7), or which no way may enter (HX 15.5.3). Commit checks the moves, with every compensation in
// them (control/commit.cpp). G23 ends it and is handled with the reading modes of a block (execute_block.cpp).
#include <algorithm>

#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// HX 15.5.3: an axis has both of its points, which differ. While the area in force limits the axis, another area that leaves it out would drop it unsaid.
Execution check_points(BlockInHand& in, WordSlot upper, Role lower, double upper_point, double lower_point, bool limited) {
  const Command& w = in.words;
  const bool above = w.has(upper), below = w.has(lower);
  if (above != below || (!above && limited)) return in.raise(Condition::words_missing, above ? in.word(lower) : upper);
  return above && upper_point == lower_point ? in.raise(Condition::value_range, lower, w.get(lower)) : Execution::done;
}

/// The area of the words, and the words that are taken.
Execution area_of_words(BlockInHand& in, StrokeBox* box, WordSet* taken) {
  const Command& w = in.words;
  const bool needs_area = in.dialect->rules.coordinate.stroke_check_needs_area;
  const StrokeBox before = in.state.stroke_box != 0 ? in.stroke_boxes[in.state.stroke_box - 1] : StrokeBox{};
  for (unsigned i = 0; i < StrokeBox::kBasicAxes; ++i) {
    const WordSlot name = in.settings.plane_basic[i];
    const int axis = in.axis_words.axis(name);
    const Role lower = vector_along(i);
    if (axis < 0) {
      if (w.has(lower)) return in.raise(Condition::illegal_address, lower, w.get(lower));
      continue;
    }
    *taken |= set_of(name);
    // (2): a word that is omitted is 0. The words are machine coordinates in the unit of the program, in G90 and in G91.
    const auto index = static_cast<unsigned>(axis);
    const bool turns = ((in.rotary >> index) & 1) != 0;
    const double upper_point = w.has(name) ? w.target[index] : 0;
    const double lower_point = w.has(lower) ? axis_value(in, index, w.written(lower), turns) : 0;
    if (needs_area) {
      const Execution did = check_points(in, name, lower, upper_point, lower_point, before.axis[i] >= 0);
      if (did != Execution::done) return did;
    }
    if (upper_point == lower_point) continue;  // (3)
    box->axis[i] = static_cast<int8_t>(axis);
    box->turns[i] = ((in.settings.machine_turn >> index) & 1) != 0;
    box->low[i] = std::min(upper_point, lower_point);
    box->high[i] = std::max(upper_point, lower_point);
  }
  return Execution::done;
}

/// The block has a word of an area.
bool gives_area(const BlockInHand& in) {
  WordSet words = in.set_of({Role::vector_x, Role::vector_y, Role::vector_z});
  for (const WordSlot name : in.settings.plane_basic) words |= set_of(name);
  return in.words.any(words);
}

}  // namespace

Execution do_stroke_check(BlockContext& in) {
  const Command& w = in.words;
  const bool stored = in.dialect->rules.coordinate.stroke_check_needs_area;
  StrokeBox box;
  WordSet taken = in.set_of({Role::vector_x, Role::vector_y, Role::vector_z});
  if (stored && !gives_area(in)) {
    box = in.records->area.box;
    if (!box.limits_any()) return in.raise_code(Condition::words_missing, *w.one_shot);
  } else {
    const Execution did = area_of_words(in, &box, &taken);
    if (did != Execution::done) return did;
  }
  // (7): an address that has no meaning in this block.
  const WordSet other = w.present & ~taken & ~in.set_of({Role::sequence_number, Role::program_number, Role::feed, Role::spindle_speed, Role::misc_code, Role::tool});
  if (other != 0) return in.raise_first(Condition::illegal_address, other);
  box.outside = in.settings.box_outside;
  box.way = in.dialect->rules.coordinate.stroke_check_sees_way;
  if (stored) in.change(&ProgramRecords::area, StoredArea{box});
  in.state.stroke_box = box.limits_any() ? in.stroke_boxes.intern(box) + 1 : 0;
  in.state.modal.set(*w.one_shot);
  return Execution::done;
}

}  // namespace nc
