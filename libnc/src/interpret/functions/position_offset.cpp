// SPDX-License-Identifier: Apache-2.0
// G45 to G48: the way of the block is made longer or shorter by an offset (M700 12.6).
#include <cmath>

#include "base/same_place.hpp"
#include "base/units.hpp"
#include "interpret/by_hand.hpp"
#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"
#include "interpret/program_map.hpp"

namespace nc {
namespace {

/// An end of an arc counts as lying on an axis of its circle when it is no farther away than this, mm: the coarsest least input increment.
constexpr double kOnAxis_mm = 0.001;

bool is_twice(Function function) { return function == Function::offset_twice_longer || function == Function::offset_twice_shorter; }

/// The amount by which G45 makes a way longer and G46 shorter (12.6): the offset of D in the block, or else of the last D, which may be D0.
Execution amount_of(BlockInHand& in, double* amount) {
  const ModalState& modal = in.state.modal;
  if (modal.d_given == 0 && !in.words.has(Role::offset_number)) return in.raise(Condition::no_offset_number, Role::offset_number);
  *amount = radius_amount(in, modal.d);
  const Function function = in.words.one_shot->function;
  if (function == Function::offset_shorter || function == Function::offset_twice_shorter) *amount = -*amount;
  return Execution::done;
}

/// A length with its sign, made longer by `by`. A length that is shortened below 0 changes its direction (12.6, precaution (2)).
double longer(double length, double by) { return length + (std::signbit(length) ? -by : by); }

/// Makes the way of each axis of the block longer, and puts it into the block as an incremental word; where the axis was moved by hand, as an absolute one.
void lengthen_ways(BlockInHand& in, double amount, bool arc) {
  Command& w = in.words;
  const bool mapped = program_mapped(in);
  const AxisVec position = mapped ? to_program(in, in.position()) : in.position();
  AxisVec target = target_of_words(in);
  if (mapped) target = to_program(in, target);
  const double ways = is_twice(w.one_shot->function) ? 2 * amount : amount;
  const AxisVec by_hand = arc ? AxisVec{} : way_by_hand(in);
  for (uint32_t left = w.target.axes(); left != 0; left &= left - 1) {
    const unsigned i = first_of(left);
    const bool by_increment = w.target.counts_on(i);
    // "From the end point of the preceding block": who has moved the axis by hand past the place has not changed its side (12.4.4).
    const double from = (in.rotary >> i & 1) != 0 ? position[i] : position[i] - by_hand[i];
    const double way = by_increment ? w.target[i] : target[i] - from;
    // Precaution (3): the sign of an incremental 0 counts; an absolute word without a way stays, and so does the axis on which a half circle ends where it
    // began. A way between two coordinates is none up to what adding them up has rounded.
    const bool stays = by_increment ? arc && way == 0 : std::fabs(way) <= kAddingUp;
    const double goes = stays ? 0 : longer(way, ways / std::fabs(scale_of(in, i)));
    if (by_hand[i] != 0 && !by_increment && (in.rotary >> i & 1) == 0) {
      w.target.set(i, TargetKind::absolute, from + goes);
    } else {
      w.target.set(i, TargetKind::incremental, goes);
    }
  }
}

/// An arc would keep no radius. An arc from axis to axis has its radius in one word, R or one of I, J and K, which the alarm then names.
Execution radius_vanishes(BlockInHand& in, const ArcWords& words, const PlaneAxes& plane) {
  if (!words.has_radius && words.center[0] != 0 && words.center[1] != 0) return in.raise_code(Condition::offset_arc, *in.words.one_shot);
  const Role radius = words.has_radius ? Role::arc_radius : plane.center[words.center[0] != 0 ? 0 : 1];
  return in.raise(Condition::offset_arc, radius, in.words.get(radius));
}

/// No part of a circle that an offset arc may be. An absolute word leads from a start that is offset to the programmed end, and the longer way past the one on the circle: who has programmed it so has to be told of G91.
Execution no_part_of_circle(BlockInHand& in, const FunctionRow& row, bool absolute) {
  return absolute ? in.raise_function(Condition::offset_arc, Function::absolute) : in.raise_code(Condition::offset_arc, row);
}

/// Makes the arc that the programmed one becomes. It has the same centre where the arc begins beside its programmed start by the same amount.
Execution move_offset_arc(BlockContext& in, double amount, bool ccw) {
  const FunctionRow& row = *in.words.one_shot;
  const PlaneAxes plane = plane_axes(in);
  if (plane.h < 0 || plane.v < 0) return in.raise_mode(Condition::plane_mismatch, Mode::motion);
  Execution did = check_feed(in, in.state.modal.of(Mode::motion));
  ArcWords words;
  if (did == Execution::done) did = read_arc_words(in, plane, in.words.target.axes(), &words);
  if (did != Execution::done) return did;
  const auto h = static_cast<unsigned>(plane.h), v = static_cast<unsigned>(plane.v);
  const double by = amount / std::fabs(scale_of(in, h));
  const auto vanishes = [by](double word) { return word != 0 && std::fabs(word) + by <= 0; };
  if (vanishes(words.radius) || vanishes(words.center[0]) || vanishes(words.center[1])) return radius_vanishes(in, words, plane);
  const auto by_place = [&in](unsigned axis) { return in.words.target.commands(axis) && !in.words.target.counts_on(axis); };
  const bool absolute = by_place(h) || by_place(v);
  lengthen_ways(in, amount, true);
  if (words.has_radius) words.radius = longer(words.radius, by);
  for (double& center : words.center)
    if (center != 0) center = longer(center, by);
  const double start[2] = {0, 0};
  const double end[2] = {in.words.target.commands(h) ? in.words.target[h] : 0, in.words.target.commands(v) ? in.words.target[v] : 0};
  Circle circle;
  bool straight = false;
  const Condition bad = make_circle(start, end, words, ccw, kOnAxis_mm, &circle, &straight);
  const auto on_axis = [&circle](const double at[2]) {
    return std::fmin(std::fabs(at[0] - circle.center[0]), std::fabs(at[1] - circle.center[1])) < kOnAxis_mm;
  };
  const long quarters = std::lround(std::fabs(circle.sweep) / (kPi / 2));
  const bool fits = is_twice(row.function) ? quarters == 2 : quarters == 1 || quarters == 3;
  if (bad != Condition::none || straight || !on_axis(start) || !on_axis(end) || !fits) return no_part_of_circle(in, row, absolute);
  return move_arc_by(in, plane, target_of_words(in), in.words.target.axes(), words, ccw);
}

}  // namespace

Execution do_position_offset(BlockContext& in) {
  const FunctionRow& row = *in.words.one_shot;
  if (in.dialect->rules.compensation.bars_position_offset && in.state.compensated()) return in.raise_code(Condition::not_in_compensation, row);
  if (in.state.cycle.kind != CycleKind::none) return do_cycle(in);  // precaution (1)
  if (in.state.rotated) return in.raise_code(Condition::offset_in_figure, row);  // App. 1, P141
  const Function motion = in.state.modal.of(Mode::motion);
  if (!plain_motion(motion)) return in.raise_mode(Condition::illegal_g, Mode::motion);
  if (in.words.target.axes() == 0 && !in.words.any({Role::arc_radius, Role::vector_x, Role::vector_y, Role::vector_z})) return Execution::done;
  double amount = 0;
  const Execution did = amount_of(in, &amount);
  if (did != Execution::done) return did;
  if (is_arc(motion)) return move_offset_arc(in, amount, motion == Function::arc_ccw);
  lengthen_ways(in, amount, false);
  return move_by_words(in);
}

}  // namespace nc
