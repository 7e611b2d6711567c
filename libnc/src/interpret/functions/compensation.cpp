// SPDX-License-Identifier: Apache-2.0
// G40-G42 and G43/G44/G49: what the words ask for. The geometry of radius compensation is offset/.
#include <cmath>
#include <initializer_list>

#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"
#include "interpret/work_rotation.hpp"

namespace nc {
namespace {

/// Amount of compensation number n for length (H) or radius (D). M700 12.1: type I has one amount for both.
double amount(const Interpreter& in, uint32_t n, bool radius) {
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

Did offset_number(Interpreter& in, char letter, uint32_t* number) {
  if (!whole_number(in.words.get(letter), number) || *number > in.frames.tool_offsets())
    return in.raise(Condition::no_offset_number, letter, in.words.get(letter));
  return Did::done;
}

/// Tool length compensation of the H in force, with the sign of G43 or G44.
double length_amount(const Interpreter& in) {
  const double value = amount(in, in.state.modal.h, false);
  return in.state.modal.code[kGroupLength] == 440 ? -value : value;
}

/// M700 12.1 (2), (3): an H holds until the next one, whatever block it stands in.
Did take_length_number(Interpreter& in) {
  const Did did = offset_number(in, 'H', &in.state.modal.h);
  if (did == Did::done) in.state.modal.h_given = 1;
  return did;
}

/// M700 12.2 (3): the axis that G43 or G44 compensates, by the words of its block: Zp before Yp before Xp, each the basic axis or the
/// parallel axis of #1029 to #1031; Z with #1080 and when none of them is named.
int length_axis_of_block(const Interpreter& in) {
  const int z = in.axis_of['Z' - 'A'];
  if (in.dialect->id != NC_DIALECT_M700 || in.settings.drilling_axis_z) return z;
  for (const unsigned pair : {2u, 1u, 0u}) {
    const int axis = axis_of_pair(in, pair);
    if (axis >= 0 && ((in.words.axes >> axis) & 1) != 0) return axis;
  }
  return z;
}

/// Letters of the compensation vector on the plane (h, v).
void plane_of(const Interpreter& in, Compensation& comp, char letters[2]) {
  const PlaneAxes plane = plane_axes(in);
  for (unsigned i = 0; i < 2; ++i) letters[i] = plane.center[i];
  comp.axis[0] = static_cast<uint8_t>(plane.h < 0 ? 0 : plane.h);
  comp.axis[1] = static_cast<uint8_t>(plane.v < 0 ? 0 : plane.v);
}

bool take_vector(const Interpreter& in, const char letters[2], double vector[2]) {
  bool any = false;
  for (unsigned i = 0; i < 2; ++i) {
    vector[i] = in.words.has(letters[i]) ? length_of(in, letters[i]) : 0;
    any = any || in.words.has(letters[i]);
  }
  return any && (vector[0] != 0 || vector[1] != 0);
}

}  // namespace

void take_changed_amounts(Interpreter& in) {
  State& state = in.state;
  if (in.dialect->id != NC_DIALECT_M700) return;
  const int16_t code = state.modal.code[kGroupLength];
  if (code == 430 || code == 440) state.length_value = length_amount(in);
  if (state.comp.side != 0) state.comp.radius = amount(in, state.modal.d, true);
}

Did set_compensation(Interpreter& in, Function function) {
  State& state = in.state;
  Compensation& comp = state.comp;
  const int16_t motion = state.modal.code[kGroupMotion];
  const bool arc = motion == 20 || motion == 30;
  char letters[2];
  if (function == Function::comp_off) {
    if (comp.side == 0) return Did::done;
    if (arc && in.words.axes != 0) return in.raise(Condition::arc_in_compensation_start, 'G', 40);  // M700 12.4.1: cancel must not be circular
    plane_of(in, comp, letters);
    comp.cancel_vector = in.dialect->id == NC_DIALECT_M700 && take_vector(in, letters, comp.vector);
    comp.side = 0;
    state.moves_since_comp_off = 0;
    return Did::done;
  }
  if (arc) return in.raise(Condition::arc_in_compensation_start, 'G', function == Function::comp_left ? 41 : 42);
  if (state.cycle.kind != CycleKind::none && in.words.motion == nullptr) return in.raise(Condition::cycle_in_compensation, 'G', 41);
  // DGSHAPE G41 G42: the direction of the shift cannot be changed while the offset is in progress.
  const int8_t side = function == Function::comp_left ? int8_t{1} : int8_t{-1};
  if (in.dialect->id == NC_DIALECT_DGSHAPE && comp.side == -side) return in.raise(Condition::not_in_compensation, 'G', side > 0 ? 41 : 42);
  if (in.dialect->id == NC_DIALECT_DGSHAPE && state.modal.code[kGroupPlane] != 170) return in.raise(Condition::plane_mismatch, 'G', 41);
  if (in.words.has('D')) {
    const Did did = offset_number(in, 'D', &state.modal.d);
    if (did != Did::done) return did;
  } else if (state.modal.d == 0) {
    return in.raise(Condition::no_offset_number, 'D');
  }
  // M700 12.5: I, J and K together start the three-dimensional compensation.
  if (in.words.has('I') && in.words.has('J') && in.words.has('K')) return in.raise(Condition::space_compensation, 'K');
  plane_of(in, comp, letters);
  if (tilts_plane(in, comp.axis[0], comp.axis[1])) return in.raise(Condition::plane_mismatch, 'G', function == Function::comp_left ? 41 : 42);  // 13.21
  comp.type_b = in.settings.comp_type_b;
  comp.check = in.settings.interference_check;
  comp.avoid = in.settings.interference_avoid;
  comp.radius = amount(in, state.modal.d, true);
  comp.side = state.modal.d == 0 ? int8_t{0} : side;
  comp.has_vector = in.dialect->id == NC_DIALECT_M700 && take_vector(in, letters, comp.vector);
  // M700 12.4.3: the vector is gone to at once, even when the block names no axis; cutting takes a feed (3.2, P62).
  if (comp.has_vector && comp.side != 0 && motion != 0) return check_feed(in, motion);
  return Did::done;
}

Did change_radius(Interpreter& in) {
  const Did did = offset_number(in, 'D', &in.state.modal.d);
  if (did != Did::done) return did;
  const int16_t code = in.state.modal.code[kGroupCompensation];
  if (code != 410 && code != 420) return Did::done;
  // M700 12.4.5: the amount changes with the block; D00 cancels (12.4.1).
  in.state.comp.radius = amount(in, in.state.modal.d, true);
  in.state.comp.side = in.state.modal.d == 0 ? int8_t{0} : code == 410 ? int8_t{1} : int8_t{-1};
  return Did::done;
}

Did change_length(Interpreter& in) {
  for (const uint32_t m : in.words.m) {  // a sequence number (M700 13.3.1, 13.12)
    const MiscRow* row = find_misc(*in.dialect, m);
    if (is_interrupt_on(in, m) || (row != nullptr && (row->function == MiscFunction::call_sub || row->function == MiscFunction::call_external)))
      return Did::done;
  }
  const Did did = take_length_number(in);
  const int16_t code = in.state.modal.code[kGroupLength];
  // Like a changed amount it acts from the next command of the axis on (12.1).
  if (did == Did::done && (code == 430 || code == 440)) in.state.length_value = length_amount(in);
  return did;
}

Did set_length(Interpreter& in, Function function) {
  State& state = in.state;
  const bool m700 = in.dialect->id == NC_DIALECT_M700;
  if (in.words.has('H') && (m700 || function != Function::length_off)) {
    const Did did = take_length_number(in);
    if (did != Did::done) return did;
  }
  if (function == Function::length_off) {
    state.length_value = 0;
  } else {
    // M700 App.1 P170: no number has been commanded, and H0 is one (12.2 (2) (d)). DGSHAPE G43: the format is G43 H n.
    if (m700 ? state.modal.h_given == 0 : state.modal.h == 0 && !in.words.has('H')) return in.raise(Condition::no_offset_number, 'H');
    const int axis = length_axis_of_block(in);
    if (axis < 0) return in.raise(Condition::illegal_axis, 'Z');
    state.length_axis = static_cast<uint8_t>(axis);
    state.length_value = length_amount(in);
  }
  if (m700) return Did::done;
  // DGSHAPE G43: without a Z word the block itself moves Z by the offset, together with the axes that it names.
  const uint32_t axis_bit = 1u << state.length_axis;
  if ((in.words.axes & axis_bit) == 0 && in.words.one_shot == nullptr) {
    const int16_t motion = state.modal.code[kGroupMotion];
    const bool line = (motion == 0 || motion == 10) && in.words.cycle == nullptr && (state.cycle.kind == CycleKind::none || in.words.motion != nullptr);
    if (in.words.axes != 0 && line) {
      in.words.axis[state.length_axis] = in.position()[state.length_axis];
      in.words.axes |= axis_bit;
      return Did::done;
    }
    LinearStyle style;
    style.kind = state.modal.code[kGroupMotion] == 0 || state.modal.feed <= 0 ? NC_MOVE_RAPID : NC_MOVE_LINE;
    style.feed_mm_min = feed_mm_min(in);
    move_linear(in, in.position(), axis_bit, style);
  }
  return Did::done;
}

}  // namespace nc
