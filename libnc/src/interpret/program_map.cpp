// SPDX-License-Identifier: Apache-2.0
// Pass n of a rotated figure is pass 1 turned about the centre c by (n - 1) a, where a is the angle from the start to the end of pass 1
// as seen from c:  p = c + R((n - 1) a) (q - c).  The radius is not scaled: when start and end are not on one circle, the first move of
// a pass leads from where the last one ended to the end point of its turned block (M700 13.3.3 (4)).
//
// Scaling and mirror image that are in force when the figure is called act on its centre and radius, too: they lie behind the turn
// (13.19 (5)). What the sub program commands is part of the shape, and all of its blocks are turned: it lies in front (13.19 (6), 13.3.3 (3)).
#include "interpret/program_map.hpp"

#include "interpret/plane.hpp"
#include "interpret/work_rotation.hpp"

#include <cmath>
#include <numbers>

namespace nc {
namespace {

PlaneAxes plane(const Interpreter& in) { return plane_axes(in); }

double figure(const Interpreter& in, unsigned what) { return in.notes.get(Notes::figure_key(what)); }

void rotate(double angle, double* h, double* v) {
  const double c = std::cos(angle), s = std::sin(angle), x = *h;
  *h = c * x - s * *v;
  *v = s * x + c * *v;
}

/// The plane coordinates of `p` turned about the centre of the figure.
void turn(const Interpreter& in, double angle, AxisVec& p) {
  const PlaneAxes axes = plane(in);
  if (axes.h < 0 || axes.v < 0) return;
  const auto h = static_cast<unsigned>(axes.h), v = static_cast<unsigned>(axes.v);
  double dh = p[h] - figure(in, Notes::kCenterH), dv = p[v] - figure(in, Notes::kCenterV);
  rotate(angle, &dh, &dv);
  p[h] = figure(in, Notes::kCenterH) + dh;
  p[v] = figure(in, Notes::kCenterV) + dv;
}

double rotation_angle(const Interpreter& in) { return in.notes.get(Notes::rotation_key(Notes::kRotationAngle)) * std::numbers::pi / 180; }

/// The plane coordinates of `p` turned about the centre of G68.
void turn_coordinates(const Interpreter& in, double angle, AxisVec& p) {
  const PlaneAxes axes = plane(in);
  if (axes.h < 0 || axes.v < 0) return;
  const auto h = static_cast<unsigned>(axes.h), v = static_cast<unsigned>(axes.v);
  const double ch = in.notes.get(Notes::rotation_key(Notes::kRotationH)), cv = in.notes.get(Notes::rotation_key(Notes::kRotationV));
  double dh = p[h] - ch, dv = p[v] - cv;
  rotate(angle, &dh, &dv);
  p[h] = ch + dh;
  p[v] = cv + dv;
}

double scaled_by(const Interpreter& in, unsigned axis, double value, double factor) {
  const double center = in.notes.get(Notes::scaling_key(axis));
  return center + factor * (value - center);
}

/// Axes that are scaled and mirrored by program in front of the turn of a figure, and behind it.
unsigned scaled_in_figure(const Interpreter& in) { return in_figure(in) ? in.state.scaled & in.state.figure_scaled : 0u; }
unsigned mirror_in_figure(const Interpreter& in) { return in_figure(in) ? in.state.mirror & in.state.figure_mirror : 0u; }
unsigned scaled_behind(const Interpreter& in) { return in.state.scaled ^ scaled_in_figure(in); }
unsigned mirror_behind(const Interpreter& in) { return in.state.mirror ^ mirror_in_figure(in); }

double scaled(const Interpreter& in, unsigned axis, double value) {
  return ((in.state.scaled >> axis) & 1) != 0 ? scaled_by(in, axis, value, scale_of(in, axis)) : value;
}

double unscaled(const Interpreter& in, unsigned axis, double value) {
  return ((in.state.scaled >> axis) & 1) != 0 ? scaled_by(in, axis, value, 1 / scale_of(in, axis)) : value;
}

double reflected(const Interpreter& in, unsigned axis, double value) { return 2 * in.notes.get(Notes::mirror_key(axis)) - value; }

double by_program(const Interpreter& in, unsigned axis, double value) {
  return ((in.state.mirror >> axis) & 1) != 0 ? reflected(in, axis, value) : value;
}

/// About where the axis stood on the machine when the program began.
double by_switch(const Interpreter& in, unsigned axis, double value) {
  if (((in.state.switch_mirror >> axis) & 1) == 0) return value;
  return 2 * (in.notes.get(Notes::switch_mirror_key(axis)) - in.zero()[axis]) - value;
}

/// Axes whose direction is turned round: mirrored by one of the two.
unsigned turned_axes(const Interpreter& in) { return in.state.mirror ^ in.state.switch_mirror; }

bool has(unsigned axes, unsigned axis) { return ((axes >> axis) & 1) != 0; }

/// In front of the turn of a figure, and the way back.
void map_shape(const Interpreter& in, AxisVec& p) {
  const unsigned scaled_axes = scaled_in_figure(in), mirrored_axes = mirror_in_figure(in);
  for (unsigned i = 0; (scaled_axes | mirrored_axes) != 0 && i < in.axis_count; ++i) {
    if (has(scaled_axes, i)) p[i] = scaled(in, i, p[i]);
    if (has(mirrored_axes, i)) p[i] = reflected(in, i, p[i]);
  }
}
void unmap_shape(const Interpreter& in, AxisVec& p) {
  const unsigned scaled_axes = scaled_in_figure(in), mirrored_axes = mirror_in_figure(in);
  for (unsigned i = 0; (scaled_axes | mirrored_axes) != 0 && i < in.axis_count; ++i) {
    if (has(mirrored_axes, i)) p[i] = reflected(in, i, p[i]);
    if (has(scaled_axes, i)) p[i] = unscaled(in, i, p[i]);
  }
}

/// Everything behind the figure, and its way back.
void map_figure(const Interpreter& in, AxisVec& p) {
  const unsigned scaled_axes = scaled_behind(in), mirrored_axes = mirror_behind(in);
  for (unsigned i = 0; scaled_axes != 0 && i < in.axis_count; ++i)
    if (has(scaled_axes, i)) p[i] = scaled(in, i, p[i]);
  if (in.state.rotated) turn_coordinates(in, rotation_angle(in), p);
  for (unsigned i = 0; i < in.axis_count; ++i) p[i] = by_switch(in, i, has(mirrored_axes, i) ? reflected(in, i, p[i]) : p[i]);
  if (in.state.work_turned) turn_work(in, p);
}
void unmap_figure(const Interpreter& in, AxisVec& p) {
  const unsigned scaled_axes = scaled_behind(in), mirrored_axes = mirror_behind(in);
  if (in.state.work_turned) unturn_work(in, p);
  for (unsigned i = 0; i < in.axis_count; ++i) {
    p[i] = by_switch(in, i, p[i]);
    if (has(mirrored_axes, i)) p[i] = reflected(in, i, p[i]);
  }
  if (in.state.rotated) turn_coordinates(in, -rotation_angle(in), p);
  for (unsigned i = 0; scaled_axes != 0 && i < in.axis_count; ++i)
    if (has(scaled_axes, i)) p[i] = unscaled(in, i, p[i]);
}

bool odd(const Interpreter& in, unsigned h, unsigned v) { return (((turned_axes(in) >> h) ^ (turned_axes(in) >> v)) & 1) != 0; }

}  // namespace

AxisVec to_program(const Interpreter& in, const AxisVec& work) {
  AxisVec p = work;
  unmap_figure(in, p);
  if (!in_figure(in)) return p;
  if (in.state.frame[in.state.depth].figure == kFigureMoved) {
    turn(in, -figure(in, Notes::kAngle), p);
  } else {  // nothing of this pass has moved yet: its increments count from where the figure began
    const PlaneAxes axes = plane(in);
    if (axes.h >= 0) p[static_cast<unsigned>(axes.h)] = figure(in, Notes::kStartH);
    if (axes.v >= 0) p[static_cast<unsigned>(axes.v)] = figure(in, Notes::kStartV);
  }
  unmap_shape(in, p);
  return p;
}

AxisVec from_program(const Interpreter& in, const AxisVec& programmed) {
  AxisVec p = programmed;
  if (in_figure(in)) {
    map_shape(in, p);
    turn(in, figure(in, Notes::kAngle), p);
  }
  map_figure(in, p);
  return p;
}

double mirrored(const Interpreter& in, unsigned axis, double value) {
  return by_switch(in, axis, by_program(in, axis, value));
}

double unmirrored(const Interpreter& in, unsigned axis, double value) {
  return by_program(in, axis, by_switch(in, axis, value));
}

double scale_of(const Interpreter& in, unsigned axis) {
  return ((in.state.scaled >> axis) & 1) != 0 ? in.notes.get(Notes::scaling_key(kMaxAxes)) : 1.0;
}

bool scaled_unevenly(const Interpreter& in, unsigned h, unsigned v) {
  const unsigned shape = scaled_in_figure(in), behind = scaled_behind(in);
  return has(shape, h) != has(shape, v) || has(behind, h) != has(behind, v);
}

double mapped_on(const Interpreter& in, unsigned axis, double programmed) { return mirrored(in, axis, scaled(in, axis, programmed)); }
double programmed_on(const Interpreter& in, unsigned axis, double work) { return unscaled(in, axis, unmirrored(in, axis, work)); }

uint32_t moved_axes(const Interpreter& in, uint32_t axes) {
  const PlaneAxes p = plane(in);
  if ((in_figure(in) || in.state.rotated) && p.h >= 0 && p.v >= 0) {
    const uint32_t both = (1u << p.h) | (1u << p.v);
    if ((axes & both) != 0) axes |= both;
  }
  return in.state.work_turned ? moved_by_work_rotation(in, axes) : axes;
}

uint32_t begin_mapped_move(Interpreter& in, uint32_t commanded) {
  commanded = moved_axes(in, commanded);
  figure_has_moved(in);
  if (in.state.work_turn_pending) work_rotation_reached(in, commanded);
  return commanded;
}

void map_arc(const Interpreter& in, unsigned h, unsigned v, double center[2], bool* ccw) {
  const unsigned shape = mirror_in_figure(in), behind = mirror_behind(in) ^ in.state.switch_mirror;
  center[0] *= scale_of(in, h) * (has(shape, h) ? -1 : 1);  // both by the same factor, so it does not matter where
  center[1] *= scale_of(in, v) * (has(shape, v) ? -1 : 1);
  if (in_figure(in)) rotate(figure(in, Notes::kAngle), &center[0], &center[1]);
  if (in.state.rotated) rotate(rotation_angle(in), &center[0], &center[1]);
  if (has(behind, h)) center[0] = -center[0];
  if (has(behind, v)) center[1] = -center[1];
  if (in.state.work_turned) turn_work_direction(in, h, v, center);
  if (odd(in, h, v)) *ccw = !*ccw;
}

void map_compensation(const Interpreter& in, Compensation& comp) {
  const unsigned shape = mirror_in_figure(in), behind = mirror_behind(in) ^ in.state.switch_mirror;
  for (unsigned i = 0; i < 2; ++i)
    if (has(shape, comp.axis[i])) comp.vector[i] = -comp.vector[i];
  if (in_figure(in)) rotate(figure(in, Notes::kAngle), &comp.vector[0], &comp.vector[1]);
  for (unsigned i = 0; i < 2; ++i)
    if (has(behind, comp.axis[i])) comp.vector[i] = -comp.vector[i];
  if (in.state.work_turned) turn_work_direction(in, comp.axis[0], comp.axis[1], comp.vector);
  if (odd(in, comp.axis[0], comp.axis[1])) comp.side = static_cast<int8_t>(-comp.side);
}

void begin_figure(Interpreter& in, const double center[2]) {
  const PlaneAxes axes = plane(in);
  const AxisVec at = to_program(in, in.position());
  const double start[2] = {axes.h >= 0 ? at[static_cast<unsigned>(axes.h)] : 0, axes.v >= 0 ? at[static_cast<unsigned>(axes.v)] : 0};
  in.state.frame[in.state.depth].figure = kFigureStarts;
  in.state.figure_scaled = in.state.figure_mirror = 0;
  in.program_changed();
  in.set_note(Notes::figure_key(Notes::kStartH), start[0]);
  in.set_note(Notes::figure_key(Notes::kStartV), start[1]);
  in.set_note(Notes::figure_key(Notes::kCenterH), start[0] + center[0]);
  in.set_note(Notes::figure_key(Notes::kCenterV), start[1] + center[1]);
  in.set_note(Notes::figure_key(Notes::kStep), 0);
  in.set_note(Notes::figure_key(Notes::kAngle), 0);
}

double shape_scaled(const Interpreter& in, unsigned axis, double value) {
  return has(scaled_in_figure(in), axis) ? scaled(in, axis, value) : value;
}

void turn_figure(Interpreter& in) {
  const PlaneAxes axes = plane(in);
  uint8_t& state = in.state.frame[in.state.depth].figure;
  if (axes.h < 0 || axes.v < 0) return;
  const double angle = figure(in, Notes::kAngle);
  double step = figure(in, Notes::kStep);
  if (angle == 0 && step == 0) {  // behind pass 1
    AxisVec end = in.position();
    unmap_figure(in, end);
    const double c[2] = {figure(in, Notes::kCenterH), figure(in, Notes::kCenterV)};
    const double from = std::atan2(figure(in, Notes::kStartV) - c[1], figure(in, Notes::kStartH) - c[0]);
    const double to = std::atan2(end[static_cast<unsigned>(axes.v)] - c[1], end[static_cast<unsigned>(axes.h)] - c[0]);
    step = to - from;
    in.set_note(Notes::figure_key(Notes::kStep), step);
  }
  in.set_note(Notes::figure_key(Notes::kAngle), std::fmod(angle + step, 2 * std::numbers::pi));
  state = kFigureStarts;
}

}  // namespace nc
