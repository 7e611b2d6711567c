// SPDX-License-Identifier: Apache-2.0
// G40-G42 and G43/G44/G49: what the words ask for. The geometry of radius compensation is offset/.
#include <cmath>
#include <initializer_list>
#include <numbers>

#include "frame/tool_life.hpp"
#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"
#include "interpret/work_rotation.hpp"

namespace nc {
namespace {

/// Amount of compensation number n for length (H) or radius (D). M700 12.1: type I has one amount for both.
double amount(const InForce& in, uint32_t n, bool radius) {
  if (n == 0) return 0;
  const Frames& f = in.frames;
  if (!in.settings.tool_memory_2) {
    const double value = f.get(f.tool_key(n, NC_TOOL_LENGTH));
    return radius && in.settings.diameter_offsets ? value / 2 : value;
  }
  const unsigned shape = radius ? NC_TOOL_RADIUS : NC_TOOL_LENGTH;
  const double value = f.get(f.tool_key(n, shape)) + f.get(f.tool_key(n, shape + 1));
  return radius && in.settings.diameter_offsets ? value / 2 : value;  // M700 12.4.9: wear is halved too
}

bool length_in_force(const ModalState& modal) { return modal.is(Function::length_plus) || modal.is(Function::length_minus); }

/// Tool length compensation of the H in force, with the sign of G43 or G44.
double length_amount(const InForce& in) {
  const double value = amount(in, in.state.modal.h, false);
  return in.state.modal.is(Function::length_minus) ? -value : value;
}

/// M700 12.1 (2), (3): an H holds until the next one, whatever block it stands in.
Execution take_length_number(BlockInHand& in) {
  const Execution did = offset_number(in, Role::length_number, &in.state.modal.h);
  if (did == Execution::done) in.state.modal.h_given = 1;
  return did;
}

/// The tool in the spindle, which the block may change first (LinuxCNC, order of execution).
uint32_t tool_in_spindle(const BlockInHand& in) {
  const Command& w = in.words;
  uint32_t tool = in.state.spindle_tool, named = 0;
  for (const Auxiliary& m : w.auxiliary) {
    if (m.function == MiscFunction::tool_change) tool = w.has(Role::tool) && whole_number(w.get(Role::tool), &named) ? named : in.state.selected_tool;
    if (m.function == MiscFunction::tool_number && whole_number(w.get(Role::named_tool), &named)) tool = named;
  }
  return tool;
}

/// The word names an offset. Where the code without it means the tool in the spindle, so does 0 (LinuxCNC G41 D0, G43 H0).
bool names_offset(const BlockInHand& in, Role word, bool number_is_that_of_tool) {
  return in.words.has(word) && !(number_is_that_of_tool && in.words.get(word) == 0);
}

/// The offset that goes with the tool in the spindle (LinuxCNC G41, G43), which is not the one that T has selected since.
Execution number_of_tool(BlockInHand& in, Role word, uint32_t* number) {
  const uint32_t tool = tool_in_spindle(in);
  if (tool == kNoTool) return in.raise(Condition::tool_unknown);
  if (tool > in.tool_offsets()) return in.raise(Condition::no_offset_number, word, tool);
  *number = tool;
  return Execution::done;
}

/// M700 12.2 (3): the axis that G43 or G44 compensates, by the words of its block: Zp before Yp before Xp, each the basic axis or the
/// parallel axis of #1029 to #1031; Z with #1080 and when none of them is named.
int length_axis_of_block(const BlockInHand& in) {
  if (in.dialect->rules.length.axis_on_plane) {
    const PlanePair plane = pair_of(in.state.modal.of(Mode::plane));
    return axis_of_pair(in, 3u - plane.first - plane.second);
  }
  const int z = in.axis_called(Role::basic_z);
  if (!in.dialect->rules.length.axis_by_words || in.settings.drilling_axis_z) return z;
  for (const unsigned pair : {2u, 1u, 0u}) {
    const int axis = axis_of_pair(in, pair);
    if (axis >= 0 && in.words.target.commands(static_cast<unsigned>(axis))) return axis;
  }
  return z;
}

/// The words of the compensation vector on the plane (h, v).
void plane_of(const InForce& in, Compensation& comp, Role words[2]) {
  const PlaneAxes plane = plane_axes(in);
  for (unsigned i = 0; i < 2; ++i) words[i] = plane.center[i];
  comp.axis[0] = static_cast<uint8_t>(plane.h < 0 ? 0 : plane.h);
  comp.axis[1] = static_cast<uint8_t>(plane.v < 0 ? 0 : plane.v);
}

bool take_vector(const BlockInHand& in, const Role words[2], double vector[2]) {
  bool any = false;
  for (unsigned i = 0; i < 2; ++i) {
    vector[i] = in.words.has(words[i]) ? length_of(in, words[i]) : 0;
    any = any || in.words.has(words[i]);
  }
  return any && (vector[0] != 0 || vector[1] != 0);
}

/// The word has the number that stands for the offset of the tool in the spindle.
bool means_managed_tool(const BlockInHand& in, Role word) {
  const uint32_t number = in.dialect->rules.compensation.number_of_managed_tool;
  return in.settings.life_managed && number != 0 && in.words.get(word) == number;
}

}  // namespace

Execution offset_number(BlockInHand& in, Role word, uint32_t* number) {
  if (means_managed_tool(in, word)) {
    const unsigned in_spindle = in.managed_tool();
    if (in_spindle == ToolLives::kNone) return in.raise(Condition::tool_unknown, word, in.words.get(word));  // never the row of the table: its amount is no tool's
    const ToolLife& tool = in.lives->tool[in_spindle];
    *number = static_cast<uint32_t>(word == Role::length_number ? tool.length : tool.radius);
    return Execution::done;
  }
  if (!whole_number(in.words.get(word), number) || *number > in.tool_offsets())
    return in.raise(Condition::no_offset_number, word, in.words.get(word));
  return Execution::done;
}

Execution take_radius_number(BlockInHand& in) {
  const Execution did = offset_number(in, Role::offset_number, &in.state.modal.d);
  if (did == Execution::done) in.state.modal.d_given = 1;
  return did;
}

double radius_amount(const InForce& in, uint32_t number) { return amount(in, number, true); }

/// M700 12.3: what the handle has added belongs to the number that was in force then, and ends with it.
double amount_along_tool(InForce& in) {
  State& state = in.state;
  if (state.length_handle_number != state.modal.h) state.length_by_handle = 0;
  state.length_handle_number = state.modal.h;
  return amount(in, state.modal.h, false) + state.length_by_handle;
}

void take_changed_amounts(InForce& in) {
  State& state = in.state;
  if (!in.dialect->rules.compensation.takes_changed_amounts) return;
  if (length_in_force(state.modal)) state.length_value = length_amount(in);
  if (state.modal.is(Function::length_along_tool)) state.tool_length = amount_along_tool(in);
  if (state.comp.side != 0) state.comp.radius = radius_amount(in, state.modal.d);
}

Execution set_compensation(BlockInHand& in, Function function) {
  State& state = in.state;
  Compensation& comp = state.comp;
  const CompensationRules& rules = in.dialect->rules.compensation;
  const Function motion = state.modal.of(Mode::motion);
  const bool arc = is_arc(motion);
  Role words[2];
  if (function == Function::comp_off && state.space.on) {
    end_space_compensation(in);
    return Execution::done;
  }
  if (function == Function::comp_off) {
    if (comp.side == 0) return Execution::done;
    if (arc && in.words.target.axes() != 0) return in.raise_function(Condition::arc_in_compensation_start, function);  // M700 12.4.1: cancel must not be circular
    plane_of(in, comp, words);
    comp.cancel_vector = rules.vector_by_words && take_vector(in, words, comp.vector);
    comp.side = 0;
    comp.by_hand[0] = comp.by_hand[1] = 0;
    state.moves_since_comp_off = 0;
    return Execution::done;
  }
  if (means_space(in)) return set_space_compensation(in, function);
  const bool changes_on_arc = rules.side_changes_on_arc && comp.side != 0 && state.moved_side != 0;
  if (arc && !changes_on_arc) return in.raise_function(Condition::arc_in_compensation_start, function);
  if (state.cycle.kind != CycleKind::none && in.words.motion == nullptr) return in.raise_function(Condition::cycle_in_compensation, function);
  const int8_t side = function == Function::comp_left ? int8_t{1} : int8_t{-1};
  if (comp.side == -side && !rules.may_change_side) return in.raise_function(Condition::not_in_compensation, function);
  if (!state.modal.is(Function::plane_xy) && rules.xy_plane_only) return in.raise_function(Condition::plane_mismatch, function);
  if (names_offset(in, Role::offset_number, rules.number_is_that_of_tool)) {
    const Execution did = take_radius_number(in);
    if (did != Execution::done) return did;
  } else if (rules.number_is_that_of_tool) {
    const Execution did = number_of_tool(in, Role::offset_number, &state.modal.d);
    if (did != Execution::done) return did;
  } else if (state.modal.d_given == 0 && !rules.number_may_be_missing) {
    return in.raise(Condition::no_offset_number, Role::offset_number);
  }
  if (!rules.vector_by_words && in.words.has(Role::vector_x) && in.words.has(Role::vector_y) && in.words.has(Role::vector_z))
    return in.raise(Condition::space_compensation, Role::vector_z);
  plane_of(in, comp, words);
  if (tilts_plane(in, comp.axis[0], comp.axis[1])) return in.raise_function(Condition::plane_mismatch, function);  // 13.21
  comp.type_b = in.settings.comp_type_b;
  comp.check = in.settings.interference_check;
  comp.walls = in.settings.contour_check;
  comp.avoid = in.settings.interference_avoid;
  comp.square_in_spike = rules.square_in_spike;
  if (rules.arc_below_deg > 0) comp.arc_cos = static_cast<float>(std::cos((180 - rules.arc_below_deg) * std::numbers::pi / 180));
  comp.radius = radius_amount(in, state.modal.d);
  comp.side = state.modal.d == 0 ? int8_t{0} : side;
  comp.has_vector = rules.vector_by_words && !arc && take_vector(in, words, comp.vector);  // of an arc they are its centre
  // M700 12.4.3: the vector is gone to at once, even when the block names no axis; cutting takes a feed (3.2, P62).
  if (comp.has_vector && comp.side != 0 && motion != Function::rapid) return check_feed(in, motion);
  return Execution::done;
}

Execution go_beside_start(BlockContext& in) {
  const Command& w = in.words;
  const Compensation& comp = in.state.comp;
  const bool pending = comp.side != 0 && in.state.moved_side == 0;
  const bool of_plane = (w.target.axes() >> comp.axis[0] & 1) != 0 || (w.target.axes() >> comp.axis[1] & 1) != 0;
  if (w.comp_entry && !(pending && of_plane)) return in.raise_function(Condition::not_accepted, Function::comp_entry);
  if (pending && of_plane && !w.comp_entry && w.one_shot == nullptr && w.cycle == nullptr) {
    move_nowhere(in);
    in.state.moved_side = comp.side;  // the first move may be an arc: it begins beside its start
  }
  return Execution::done;
}

bool gives_length_in_cycle(const BlockInHand& in) {
  const Command& w = in.words;
  if (!in.dialect->rules.cycle.takes_length_number || w.motion != nullptr || w.one_shot != nullptr) return false;
  return w.cycle != nullptr ? w.cycle->function != Function::cycle_off : in.state.cycle.kind != CycleKind::none;
}

Execution take_length_in_cycle(BlockInHand& in) {
  const Execution did = offset_number(in, Role::offset_number, &in.state.modal.h);
  if (did != Execution::done) return did;
  const int axis = in.axis_called(Role::basic_z);
  if (axis < 0) return in.raise(Condition::illegal_axis, Role::basic_z);
  in.state.modal.h_given = 1;
  in.state.length_axis = static_cast<uint8_t>(axis);
  in.state.modal.set(Function::length_plus);
  in.state.length_value = amount(in, in.state.modal.h, false);
  return Execution::done;
}

Execution change_radius(BlockInHand& in) {
  if (in.state.space.on) return change_space_number(in);
  const Execution did = take_radius_number(in);
  if (did != Execution::done) return did;
  const bool left = in.state.modal.is(Function::comp_left);
  if (!left && !in.state.modal.is(Function::comp_right)) return Execution::done;
  // M700 12.4.5: the amount changes with the block; D00 cancels (12.4.1).
  in.state.comp.radius = radius_amount(in, in.state.modal.d);
  in.state.comp.side = in.state.modal.d == 0 ? int8_t{0} : left ? int8_t{1} : int8_t{-1};
  return Execution::done;
}

Execution change_length(BlockInHand& in) {
  if (has_words_of_call(in)) return Execution::done;  // H is a sequence number (M700 13.3.1, 13.12)
  const Execution did = take_length_number(in);
  // Like a changed amount it acts from the next command of the axis on (12.1).
  if (did == Execution::done && length_in_force(in.state.modal)) in.state.length_value = length_amount(in);
  if (did == Execution::done && in.state.modal.is(Function::length_along_tool)) in.state.tool_length = amount_along_tool(in);
  return did;
}

/// LinuxCNC G43.1: the axis words are the amounts and move nothing.
static Execution set_length_of_block(BlockInHand& in) {
  const int z = in.axis_called(Role::basic_z);
  if (z < 0) return in.raise(Condition::illegal_axis, Role::basic_z);
  const uint32_t others = in.words.target.axes() & ~(1u << z);
  if (others != 0) return in.raise_axis(Condition::illegal_axis, first_of(others));
  if (in.words.target.axes() == 0) return in.raise_function(Condition::words_missing, Function::length_of_block);
  in.state.length_axis = static_cast<uint8_t>(z);
  in.state.length_value = in.words.target[static_cast<unsigned>(z)];
  in.state.applied[static_cast<unsigned>(z)] = in.state.length_value;
  in.words.target.clear();
  return Execution::done;
}

/// M700 12.2 (1), (3)(c), DGSHAPE G43: the amount is gone by, or back, in the block of the code, together with what the block names and also where it names nothing. The axis is
/// commanded to where it is. In the mode of an arc the amount goes as a line (M700 App. 2); that of G43 and G44, which may not stand beside an arc, is refused.
static Execution go_by_length(BlockContext& in) {
  State& state = in.state;
  const uint32_t axis_bit = 1u << state.length_axis;
  if ((in.words.target.axes() & axis_bit) != 0 || state.applied[state.length_axis] == state.length_value) return Execution::done;
  const Function motion = state.modal.of(Mode::motion);
  const bool cycle = in.words.cycle != nullptr || (state.cycle.kind != CycleKind::none && in.words.motion == nullptr);
  if (is_line(motion) && !cycle) {
    in.words.target.set(state.length_axis, TargetKind::incremental, 0);
    return Execution::done;
  }
  LinearStyle style;
  style.kind = motion == Function::rapid || cycle ? NC_MOVE_RAPID : NC_MOVE_LINE;
  style.feed_mm_min = feed_mm_min(in);
  if (is_arc(motion) && !cycle && in.words.target.axes() == 0 && !state.modal.is(Function::length_off)) return in.raise_function(Condition::length_beside_arc, state.modal.of(Mode::length));
  if (style.kind == NC_MOVE_LINE) {
    const Execution did = check_feed(in, Function::linear);
    if (did != Execution::done) return did;
    style.special_feed = special_feed(in);
  }
  move_linear(in, in.position(), axis_bit, style);
  return Execution::done;
}

Execution set_length(BlockContext& in, Function function) {
  if (function == Function::length_of_block) return set_length_of_block(in);
  State& state = in.state;
  const LengthRules& rules = in.dialect->rules.length;
  if (names_offset(in, Role::length_number, rules.number_is_that_of_tool) && (rules.number_in_any_block || function != Function::length_off)) {
    const Execution did = take_length_number(in);
    if (did != Execution::done) return did;
  } else if (rules.number_is_that_of_tool && function != Function::length_off) {
    const Execution did = number_of_tool(in, Role::length_number, &state.modal.h);
    if (did != Execution::done) return did;
    state.modal.h_given = 1;
  }
  const bool ends_along_tool = state.tool_length != 0 && function != Function::length_along_tool;
  in.words.comp_command = in.words.comp_command || ends_along_tool;  // that vector goes at once
  state.tool_length = 0;
  if (function != Function::length_along_tool) state.length_by_handle = 0;
  if (function == Function::length_off) {
    state.length_value = 0;
    // App. 2: the movement of G49 goes as a line in the mode of an arc, and so in front of the one beside it.
    if (ends_along_tool && is_arc(state.modal.of(Mode::motion)) && in.words.target.axes() != 0 && in.words.one_shot == nullptr) {
      const Execution did = check_feed(in, Function::linear);
      if (did != Execution::done) return did;
      move_nowhere(in, true);
    }
  } else {
    if (rules.zero_is_number ? state.modal.h_given == 0 : state.modal.h == 0 && !in.words.has(Role::length_number)) return in.raise(Condition::no_offset_number, Role::length_number);
    if (function == Function::length_along_tool) return set_length_along_tool(in, amount_along_tool(in));
    const int axis = length_axis_of_block(in);
    if (axis < 0) return in.raise(Condition::illegal_axis, Role::basic_z);
    state.length_axis = static_cast<uint8_t>(axis);
    state.length_value = length_amount(in);
  }
  if (rules.shifts_reading) state.applied[state.length_axis] = state.length_value;
  return rules.moves_at_once && in.words.one_shot == nullptr ? go_by_length(in) : Execution::done;  // beside a macro call it only becomes modal (M700 App. 2)
}

}  // namespace nc
