// SPDX-License-Identifier: Apache-2.0
// G12 and G13: cut a circle, from its centre and back to it (M700 13.10).
#include <cmath>

#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/motion.hpp"
#include "interpret/plane.hpp"
#include "interpret/program_map.hpp"

namespace nc {
namespace {

/// M700 13.10 (4): the block may hold only the code, the radius, the offset number and the feed.
Execution check_format(BlockInHand& in) {
  const Command& w = in.words;
  const uint32_t others = w.present & ~in.set_of({Role::circle_radius, Role::offset_number, Role::feed, Role::sequence_number, Role::program_number});
  if (others != 0) {
    return in.raise_first(Condition::illegal_address, others);
  }
  return w.auxiliary.empty() ? Execution::done : in.raise(Condition::illegal_address, Role::misc_code, w.auxiliary[0].number);
}

/// Radius of the path in programmed coordinates: the sign of the radius word does not count; a positive offset makes the circle smaller (13.10 (1)). Scaling
/// enlarges the circle but not the tool (13.19).
Execution path_radius(BlockInHand& in, double scale, double* radius) {
  const Command& w = in.words;
  uint32_t number = 0;
  if (!w.has(Role::offset_number)) return in.raise(Condition::no_offset_number, Role::offset_number);
  const Execution did = offset_number(in, Role::offset_number, &number);
  if (did != Execution::done) return did;
  if (!w.has(Role::circle_radius)) return in.raise(Condition::words_missing, Role::circle_radius);
  *radius = std::fabs(length_of(in, Role::circle_radius)) - radius_amount(in, number) / scale;
  // Half of it is the radius of the way in and out, which has to be a real circle, too.
  return *radius / 2 > kNoRadius_mm ? Execution::done : in.raise(Condition::circle_radius, Role::circle_radius, w.get(Role::circle_radius));
}

}  // namespace

/// The figure of 13.10: half a circle from the centre to the point of the circle on the positive side of the plane's first axis, the whole circle, and half a
/// circle back, all in the same direction.
Execution do_circle_cut(BlockContext& in) {
  const FunctionRow& row = *in.words.one_shot;
  Execution did = check_format(in);
  if (did != Execution::done) return did;
  // 12.4.1: compensation neither starts nor ends with an arc.
  if (in.words.comp_command || starts_or_ends_compensation(in)) return in.raise_code(Condition::arc_in_compensation_start, row);
  const PlaneAxes plane = plane_axes(in);
  if (plane.h < 0 || plane.v < 0) return in.raise_code(Condition::plane_mismatch, row);
  const auto h = static_cast<unsigned>(plane.h);
  const uint32_t axes = 1u << h | 1u << plane.v;
  // In inch a degree of a rotary axis has the length of a tenth of an inch (3.2 note 5); 13.10 does not say what that means here.
  if ((in.rotary & axes) != 0 && in.state.modal.is(Function::inch)) return in.raise(Condition::no_function, in.axis_words.word(first_of(in.rotary & axes)));
  double radius = 0;
  did = path_radius(in, std::fabs(scale_of(in, h)), &radius);
  if (did == Execution::done) did = check_feed(in, row.function);
  if (did != Execution::done) return did;
  const bool mapped = program_mapped(in), ccw = row.function == Function::circle_cut_ccw;
  const AxisVec center = in.position();
  AxisVec entry = mapped ? to_program(in, center) : center;
  entry[h] += radius;
  if (mapped) entry = from_program(in, entry);
  struct {
    const AxisVec* end;
    double to_center;  ///< along the first axis of the plane, from where the arc starts
  } const arcs[] = {{&entry, radius / 2}, {&entry, -radius}, {&center, -radius / 2}};
  for (const auto& arc : arcs) {
    ArcWords words;
    words.center[0] = arc.to_center;
    did = move_arc_by(in, plane, *arc.end, axes, words, ccw);
    if (did != Execution::done) return in.raise_code(in.fault.condition, row);
  }
  return Execution::done;
}

}  // namespace nc
