// SPDX-License-Identifier: Apache-2.0
// Cavities milled from the full material: G34, G35 and G36 of the Series 8. The manual has their titles alone; the words are those of docs/series8.md.
#include <algorithm>
#include <cmath>

#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"
#include "interpret/program_map.hpp"

namespace nc {
namespace {

/// A length that has to be above 0.
Execution positive(BlockInHand& in, Role word, double* value) {
  if (!in.words.has(word)) return in.raise(Condition::words_missing, word);
  *value = length_of(in, word);
  return *value > 0 ? Execution::done : in.raise(Condition::value_range, word, in.words.get(word));
}

/// Z, and R above it: of this block, else those that an earlier cycle or cavity had.
Execution take_levels(BlockInHand& in) {
  const Command& w = in.words;
  CycleState& kept = in.state.cycle;
  CavityOfBlock& c = in.jobs.cavity;
  const AxisVec at = program_mapped(in) ? to_program(in, in.position()) : in.position();
  const bool z = w.target.commands(c.axis), incremental = is_incremental(in);
  if (w.has(Role::cycle_level)) {
    c.r = axis_value(in, c.axis, w.written(Role::cycle_level), false) + (incremental ? at[c.axis] : 0);
  } else if (kept.has_r && !kept.r_incremental) {
    c.r = kept.r;
  } else {
    return in.raise(Condition::words_missing, Role::cycle_level);
  }
  if (z) {
    c.bottom = w.target[c.axis] + (w.target.counts_on(c.axis) ? c.r : 0);
  } else if (kept.has_z && !kept.z_incremental) {
    c.bottom = kept.z;
  } else {
    return in.raise(Condition::words_missing, Role::basic_z);
  }
  if (!(c.bottom < c.r)) return in.raise(Condition::level_below_bottom, Role::cycle_level, c.r);
  kept.has_r = kept.has_z = true;
  kept.r_incremental = kept.z_incremental = false;
  kept.r = c.r;
  kept.z = c.bottom;
  return Execution::done;
}

/// The path of the centre of the cutter: the cavity without the radius of the cutter on each side.
Execution take_shape(BlockInHand& in, Function function, double scale) {
  const Command& w = in.words;
  Cavity& shape = in.jobs.cavity.shape;
  shape.circle = function == Function::cavity_circle;
  shape.ccw = function != Function::cavity_cw;
  if (w.has(Role::offset_number)) {
    const Execution did = take_radius_number(in);
    if (did != Execution::done) return did;
  }
  const double cutter = radius_amount(in, in.state.modal.d) / scale;
  double size[2] = {0, 0};
  Execution did = positive(in, Role::cavity_length, &size[0]);
  if (did == Execution::done && !shape.circle) did = positive(in, Role::cavity_width, &size[1]);
  if (did != Execution::done) return did;
  for (unsigned i = 0; i < (shape.circle ? 1u : 2u); ++i) {
    shape.half[i] = (shape.circle ? size[i] : size[i] / 2) - cutter;
    const Role word = i == 0 ? Role::cavity_length : Role::cavity_width;
    if (shape.half[i] < (shape.circle ? kNoRadius_mm : 0.0)) return in.raise(Condition::cavity_size, word, w.get(word));
  }
  double corner = cutter, step = cutter;
  if (!shape.circle && w.has(Role::cavity_corner)) did = positive(in, Role::cavity_corner, &corner);
  if (did != Execution::done) return did;
  if (corner < cutter - kNoRadius_mm) return in.raise(Condition::cavity_corner, Role::cavity_corner, w.get(Role::cavity_corner));  // the cutter cannot make it
  shape.corner = std::fmax(corner - cutter, 0);
  if (shape.corner > std::fmin(shape.half[0], shape.half[1]) && !shape.circle) return in.raise(Condition::cavity_corner, Role::cavity_corner, w.get(Role::cavity_corner));
  if (!w.has(Role::cavity_step) && in.state.modal.d == 0) return in.raise(Condition::words_missing, Role::offset_number);
  if (w.has(Role::cavity_step) || !(step > 0)) did = positive(in, Role::cavity_step, &step);
  if (did != Execution::done) return did;
  shape.rings = rings_of_cavity(shape, step);
  const double least = shape.circle ? shape.half[0] : std::fmin(shape.half[0], shape.half[1]);
  const bool walls = cutter > 0 && shape.rings > 0 && least / shape.rings > 2 * cutter + kNoRadius_mm;  // something would be left between two rings
  if (walls) return in.raise(Condition::cavity_step, Role::cavity_step, w.get(Role::cavity_step));
  if (!shape.circle && cutter > 0) shape.rings = std::max(shape.rings, rings_of_cavity(shape, widest_step_round_corners(cutter)));
  in.jobs.cavity.cut = in.jobs.cavity.r - in.jobs.cavity.bottom;
  return w.has(Role::cavity_cut) ? positive(in, Role::cavity_cut, &in.jobs.cavity.cut) : Execution::done;
}

/// A place of the plane, by what it is beside the centre, at the level where the cutter is.
AxisVec place(const BlockInHand& in, const double beside[2]) {
  AxisVec at = program_mapped(in) ? as_programmed_end(in, in.position()) : in.position();
  for (unsigned i = 0; i < 2; ++i) at[static_cast<unsigned>(in.state.plane_axis[i])] = in.jobs.cavity.center[i] + beside[i];
  return program_mapped(in) ? from_program(in, at) : at;
}

void go(BlockContext& in, const AxisVec& target, uint32_t axes, bool rapid) {
  LinearStyle style;
  style.kind = rapid ? NC_MOVE_RAPID : NC_MOVE_LINE;
  style.feed_mm_min = feed_mm_min(in);
  style.special_feed = !rapid && special_feed(in);
  style.exact_stop = axes == 1u << in.jobs.cavity.axis;
  move_linear(in, target, axes, style);
}

void go_to_level(BlockContext& in, double level, bool rapid) {
  AxisVec target = in.position();
  target[in.jobs.cavity.axis] = mapped_on(in, in.jobs.cavity.axis, level);
  go(in, target, 1u << in.jobs.cavity.axis, rapid);
}

uint32_t plane_bits(const InForce& in) { return 1u << in.state.plane_axis[0] | 1u << in.state.plane_axis[1]; }

void make_piece(BlockContext& in, const CavityPiece& piece) {
  const AxisVec target = place(in, piece.to);
  if (!piece.arc) return go(in, target, plane_bits(in), false);
  const AxisVec at = program_mapped(in) ? as_programmed_end(in, in.position()) : in.position();
  ArcWords words;
  for (unsigned i = 0; i < 2; ++i) words.center[i] = in.jobs.cavity.center[i] + piece.center[i] - at[static_cast<unsigned>(in.state.plane_axis[i])];
  move_arc_by(in, plane_axes(in), target, plane_bits(in), words, piece.ccw);
}

}  // namespace

Execution do_cavity(BlockContext& in) {
  const FunctionRow& row = *in.words.one_shot;
  const PlaneAxes plane = plane_axes(in);
  const int z = in.axis_called(Role::basic_z);
  if (plane.h < 0 || plane.v < 0 || z < 0 || !in.state.modal.is(Function::plane_xy)) return in.raise_code(Condition::plane_mismatch, row);
  if (in.state.compensated()) return in.raise_code(Condition::not_in_compensation, row);
  in.jobs.cavity = CavityOfBlock{};
  in.jobs.cavity.axis = static_cast<uint8_t>(z);
  const auto h = static_cast<unsigned>(plane.h), v = static_cast<unsigned>(plane.v);
  Execution did = take_levels(in);
  if (did == Execution::done) did = take_shape(in, row.function, std::fabs(scale_of(in, h)));
  if (did == Execution::done) did = check_feed(in, Function::linear);
  if (did != Execution::done) return did;
  const uint32_t axes = in.words.target.axes() & ~(1u << z);
  const AxisVec over = target_of(in, in.position(), in.words.target.without(1u << z));
  go(in, over, axes, true);
  const AxisVec centre = program_mapped(in) ? as_programmed_end(in, in.position()) : in.position();
  in.jobs.cavity.center[0] = centre[h];
  in.jobs.cavity.center[1] = centre[v];
  in.emit_stop_point();
  go_to_level(in, in.jobs.cavity.r, true);
  in.emit_stop_point();
  in.jobs.cavity.depth = in.jobs.cavity.r;
  in.jobs.cavity.ring = in.jobs.cavity.shape.rings + 1;  // a depth is to be begun
  in.next_step = Step::cavity;
  return Execution::later;
}

Execution continue_cavity(BlockContext& in) {
  CavityOfBlock& c = in.jobs.cavity;
  while (in.queue_has_room()) {
    CavityPiece piece;
    if (c.ring > c.shape.rings) {
      if (c.depth != c.r) make_piece(in, CavityPiece{});  // off the wall, to the centre
      if (c.depth == c.bottom) {
        go_to_level(in, c.r, true);
        return Execution::done;
      }
      if (c.depth != c.r) in.emit_stop_point();
      c.depth = c.depth - c.cut > c.bottom + 1e-9 ? c.depth - c.cut : c.bottom;
      go_to_level(in, c.depth, false);
      c.ring = c.piece = 0;
    } else if (piece_of_cavity(c.shape, c.ring, c.piece, &piece)) {
      make_piece(in, piece);
      ++c.piece;
    } else {
      ++c.ring;
      c.piece = 0;
    }
  }
  return Execution::later;
}

}  // namespace nc
