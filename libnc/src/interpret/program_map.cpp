// SPDX-License-Identifier: Apache-2.0
// Pass n of a rotated figure is pass 1 rotated about the centre c by (n - 1) a, where a is the angle from the start to the end of pass 1 as seen from c:
// p = c + R((n - 1) a) (q - c).  The radius is not scaled: when start and end are not on one circle, the first move of a pass leads from where the last
// pass ended to the rotated end point of its block (M700 13.3.3 (4)).
//
// Scaling and mirror image that are in force when the figure is called act on its centre and radius, too, so they come after the rotation (13.19 (5)).
// Those that the sub program commands are a part of the shape, of which all blocks are rotated, so they come before it (13.19 (6), 13.3.3 (3)).
//
// Each map is affine, and so is the composition of all. It is calculated when a block asks for it for the first time after a change.
#include "interpret/program_map.hpp"

#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"
#include "interpret/work_rotation.hpp"

#include <cmath>
#include <numbers>

namespace nc {
namespace {

PlaneAxes plane(const InForce& in) { return plane_axes(in); }

bool has(unsigned axes, unsigned axis) { return ((axes >> axis) & 1) != 0; }

/// Axes that are scaled and mirrored by program before the rotation of a figure; and those that are so after it.
unsigned scaled_in_figure(const InForce& in) { return in_figure(in) ? in.state.scaled & in.state.figure_scaled : 0u; }
unsigned mirror_in_figure(const InForce& in) { return in_figure(in) ? in.state.mirror & in.state.figure_mirror : 0u; }
unsigned scaled_behind(const InForce& in) { return in.state.scaled ^ scaled_in_figure(in); }
unsigned mirror_behind(const InForce& in) { return in.state.mirror ^ mirror_in_figure(in); }

// ---- each map by itself

/// Makes `map` the map that does what it did before and then `next`. G68 and the figure rotate the plane in force, 13.21 at most one other plane, so there are never more
/// coupled axes than a map can hold.
void add(Affine& map, const Affine& next) {
  static_assert(Affine::kMostCoupled >= 4);
  [[maybe_unused]] const bool fits = map.then(next);
}

Affine scaling_of_axis(const InForce& in, unsigned axis) {
  return Affine::stretch(axis, scale_of(in, axis), in.records->maps.scaling_center[axis]);
}

Affine scaling(const InForce& in, unsigned axes) {
  Affine map;
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (has(axes, i)) add(map, scaling_of_axis(in, i));
  return map;
}

/// What of the scaling is a mirror: a factor below 0 turns the axis round.
Affine mirror_by_scaling(const InForce& in, unsigned axes) {
  Affine map;
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (has(axes, i) && scale_of(in, i) < 0) add(map, Affine::stretch(i, -1, in.records->maps.scaling_center[i]));
  return map;
}

Affine mirror_by_program(const InForce& in, unsigned axes) {
  Affine map;
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (has(axes, i)) add(map, Affine::stretch(i, -1, in.records->maps.mirror_center[i]));
  return map;
}

/// Mirror image by switch: about the machine position at which each axis stood when the program began.
Affine mirror_by_switch(const InForce& in) {
  Affine map;
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (has(in.state.switch_mirror, i)) add(map, Affine::stretch(i, -1, in.records->switch_mirror.center[i] - in.zero()[i]));
  return map;
}

Affine in_plane(const InForce& in, const Affine::Angle& angle, const double center[2]) {
  const PlaneAxes axes = plane(in);
  if (axes.h < 0 || axes.v < 0) return Affine{};
  return Affine::rotation(static_cast<unsigned>(axes.h), static_cast<unsigned>(axes.v), angle, center[0], center[1]);
}

Affine rotation_by_program(const InForce& in) {
  if (!in.state.rotated) return Affine{};
  const ProgramMaps& maps = in.records->maps;
  return in_plane(in, Affine::Angle::degrees(maps.rotation_deg), maps.rotation_center);
}

Affine turn_of_figure(const InForce& in) {
  if (!in_figure(in)) return Affine{};
  const Figure& figure = in.records->figure;
  return in_plane(in, Affine::Angle::radians(figure.angle), figure.center);
}

// ---- all of them

/// The composition of all maps. `turn`: the rotation by parameter, as commanded or as the axes have reached it; `stretched`: with scaling.
Affine whole_map(const BlockInHand& in, const WorkTurn& turn, bool stretched) {
  const auto scaled = stretched ? scaling : mirror_by_scaling;
  Affine map = scaled(in, scaled_in_figure(in));
  add(map, mirror_by_program(in, mirror_in_figure(in)));
  add(map, turn_of_figure(in));
  add(map, scaled(in, scaled_behind(in)));
  add(map, rotation_by_program(in));
  add(map, mirror_by_program(in, mirror_behind(in)));
  add(map, mirror_by_switch(in));
  add(map, work_rotation(in, turn));
  return map;
}

ProgramMatricesKey key_of(const InForce& in) {
  const State& state = in.state;
  const PlaneAxes axes = plane(in);
  ProgramMatricesKey key;
  key.records = in.records.changes();
  key.zero = in.zero();
  key.plane[0] = static_cast<int8_t>(axes.h);
  key.plane[1] = static_cast<int8_t>(axes.v);
  key.scaled = state.scaled;
  key.mirror = state.mirror;
  key.figure_scaled = state.figure_scaled;
  key.figure_mirror = state.figure_mirror;
  key.switch_mirror = state.switch_mirror;
  key.rotated = state.rotated;
  key.work_turned = state.work_turned;
  key.in_figure = in_figure(in);
  return key;
}

void make_matrices(const BlockInHand& in, ProgramMatrices* m) {
  const WorkTurns& turns = in.records->work_turn;
  m->forward = whole_map(in, turns.commanded, true);
  m->directions = whole_map(in, turns.commanded, false);
  m->backward = whole_map(in, turns.reached, true).inverse();
  Affine behind_rotation = mirror_by_program(in, mirror_behind(in));
  add(behind_rotation, mirror_by_switch(in));
  add(behind_rotation, work_rotation(in, turns.reached));
  m->before_mirror = behind_rotation.inverse();
  Affine behind_turn = scaling(in, scaled_behind(in));
  add(behind_turn, rotation_by_program(in));
  add(behind_turn, behind_rotation);
  m->to_turned = behind_turn.inverse();
  Affine shape = scaling(in, scaled_in_figure(in));
  add(shape, mirror_by_program(in, mirror_in_figure(in)));
  m->shape_to_program = shape.inverse();
}

const ProgramMatrices& matrices(const BlockInHand& in) {
  const ProgramMatricesKey key = key_of(in);
  if (!(in.program_matrices.made_of == key)) {
    make_matrices(in, &in.program_matrices);
    in.program_matrices.made_of = key;
  }
  return in.program_matrices;
}

/// Maps a direction on the axes h and v, whose plane the map keeps.
void map_direction(const Affine& map, unsigned h, unsigned v, double direction[2]) {
  const double first = direction[0], second = direction[1];
  direction[0] = map.coefficient(h, h) * first + map.coefficient(h, v) * second;
  direction[1] = map.coefficient(v, h) * first + map.coefficient(v, v) * second;
}

}  // namespace

AxisVec as_programmed_end(const BlockInHand& in, const AxisVec& work) { return matrices(in).backward.apply(work); }

AxisVec to_program(const BlockInHand& in, const AxisVec& work) {
  const ProgramMatrices& m = matrices(in);
  if (in.state.map_begins) {  // Series 8 G55, G57: the programmed position is the one from before the map
    AxisVec p = m.backward.apply(work);
    const PlaneAxes axes = plane(in);
    if (axes.h >= 0) p[static_cast<unsigned>(axes.h)] = in.records->maps.start[0];
    if (axes.v >= 0) p[static_cast<unsigned>(axes.v)] = in.records->maps.start[1];
    return p;
  }
  if (in.state.frame[in.state.depth].figure != kFigureStarts) return m.backward.apply(work);
  // This pass has not moved yet, so its increments count from where the figure began.
  AxisVec p = m.to_turned.apply(work);
  const PlaneAxes axes = plane(in);
  if (axes.h >= 0) p[static_cast<unsigned>(axes.h)] = in.records->figure.start[0];
  if (axes.v >= 0) p[static_cast<unsigned>(axes.v)] = in.records->figure.start[1];
  return m.shape_to_program.apply(p);
}

AxisVec from_program(const BlockInHand& in, const AxisVec& programmed) { return matrices(in).forward.apply(programmed); }

AxisVec in_front_of_mirror(const BlockInHand& in, const AxisVec& work) {
  return program_mapped(in) ? matrices(in).before_mirror.apply(work) : work;
}

double scale_of(const InForce& in, unsigned axis) {
  return ((in.state.scaled >> axis) & 1) != 0 ? in.records->maps.scaling_factor[axis] : 1.0;
}

bool scaled_unevenly(const InForce& in, unsigned h, unsigned v) {
  const unsigned shape = scaled_in_figure(in), behind = scaled_behind(in);
  return has(shape, h) != has(shape, v) || has(behind, h) != has(behind, v) ||
         (has(in.state.scaled, h) && std::fabs(scale_of(in, h)) != std::fabs(scale_of(in, v)));
}

double mapped_on(const BlockInHand& in, unsigned axis, double programmed) {
  return program_mapped(in) ? matrices(in).forward.on_axis(axis, programmed) : programmed;
}
double programmed_on(const BlockInHand& in, unsigned axis, double work) {
  return program_mapped(in) ? matrices(in).backward.on_axis(axis, work) : work;
}

uint32_t moved_axes(const InForce& in, uint32_t axes) {
  const PlaneAxes p = plane(in);
  if ((in_figure(in) || in.state.rotated || in.state.map_begins) && p.h >= 0 && p.v >= 0) {
    const uint32_t both = (1u << p.h) | (1u << p.v);
    if ((axes & both) != 0) axes |= both;
  }
  return in.state.work_turned ? moved_by_work_rotation(in, axes) : axes;
}

uint32_t begin_mapped_move(InForce& in, uint32_t commanded) {
  commanded = moved_axes(in, commanded);
  figure_has_moved(in);
  const PlaneAxes axes = plane(in);
  if (in.state.map_begins && axes.h >= 0 && (commanded >> axes.h & 1) != 0) in.state.map_begins = false;
  if (in.state.work_turn_pending) work_rotation_reached(in, commanded);
  if (in.state.space.on) mirror_space_vector(in, commanded);
  return commanded;
}

void map_arc(const BlockInHand& in, unsigned h, unsigned v, double center[2], bool* ccw) {
  const Affine& map = matrices(in).forward;
  map_direction(map, h, v, center);
  if (map.reflects(h, v)) *ccw = !*ccw;
}

void map_compensation(const BlockInHand& in, Compensation& comp) {
  const Affine& map = matrices(in).directions;
  map_direction(map, comp.axis[0], comp.axis[1], comp.vector);
  if (map.reflects(comp.axis[0], comp.axis[1])) comp.side = static_cast<int8_t>(-comp.side);
}

void begin_figure(BlockInHand& in, const double center[2]) {
  const PlaneAxes axes = plane(in);
  const AxisVec at = to_program(in, in.position());
  Figure figure;
  figure.start[0] = axes.h >= 0 ? at[static_cast<unsigned>(axes.h)] : 0;
  figure.start[1] = axes.v >= 0 ? at[static_cast<unsigned>(axes.v)] : 0;
  for (unsigned i = 0; i < 2; ++i) figure.center[i] = figure.start[i] + center[i];
  in.state.frame[in.state.depth].figure = kFigureStarts;
  in.state.figure_scaled = in.state.figure_mirror = 0;
  in.program_changed();
  in.change(&ProgramRecords::figure, figure);
}

double shape_scaled(const InForce& in, unsigned axis, double value) {
  return has(scaled_in_figure(in), axis) ? scaling_of_axis(in, axis).on_axis(axis, value) : value;
}

void turn_figure(BlockInHand& in) {
  const PlaneAxes axes = plane(in);
  uint8_t& state = in.state.frame[in.state.depth].figure;
  if (axes.h < 0 || axes.v < 0) return;
  Figure figure = in.records->figure;
  if (figure.angle == 0 && figure.step == 0) {  // pass 1 has ended
    const AxisVec end = matrices(in).to_turned.apply(in.position());
    const double* const c = figure.center;
    const double from = std::atan2(figure.start[1] - c[1], figure.start[0] - c[0]);
    const double to = std::atan2(end[static_cast<unsigned>(axes.v)] - c[1], end[static_cast<unsigned>(axes.h)] - c[0]);
    figure.step = to - from;
  }
  figure.angle = std::fmod(figure.angle + figure.step, 2 * std::numbers::pi);
  in.change(&ProgramRecords::figure, figure);
  state = kFigureStarts;
}

}  // namespace nc
