// SPDX-License-Identifier: Apache-2.0
// G15, G16: the axis words of the plane are radius and angle (M700 6.12).
#include <cmath>

#include "base/units.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"
#include "interpret/program_map.hpp"

namespace nc {
namespace {

/// The code has axis words that are places to go to, and is not among those whose words M700 6.12 and HX 8.3 say to be no radius and angle: single-direction
/// positioning, position offset, patterns of holes.
bool takes_polar_words(Function f) { return f == Function::unidirectional || offsets_position(f) || is_hole_pattern(f); }

/// M700 6.12: the words of this block are not radius and angle: those of data, machine positions, returns, measurements, and codes that set up other modes.
/// The codes that end scaling and rotation are not listed, and take no words.
bool reads_plain_words(const BlockInHand& in) {
  const Command& w = in.words;
  if (w.one_shot != nullptr) return !takes_polar_words(w.one_shot->function);
  return in.dialect->rules.coordinate.pole_stays && is_arc(in.state.modal.of(Mode::motion)) && w.cycle == nullptr && in.state.cycle.kind == CycleKind::none;
}

/// The targets of the plane's axes are meant as radius and angle.
void name_polar_targets(BlockInHand& in, unsigned h, unsigned v) {
  Targets& target = in.words.target;
  if (target.commands(h)) target.set(h, target.counts_on(h) ? TargetKind::radius_increment : TargetKind::radius, target[h]);
  if (!target.commands(v)) return;
  const double angle = length_value(in, in.words.written(in.axis_words.word(v)), true, false);  // in degrees, also in inch mode
  target.set(v, target.counts_on(v) ? TargetKind::angle_increment : TargetKind::angle, angle);
}

}  // namespace

Execution select_polar_command(BlockInHand& in, const FunctionRow& row) {
  State& state = in.state;
  if (row.function == Function::polar_command_on) {
    if (state.high_speed == SpeedMode::accuracy_2) return in.raise_code(Condition::illegal_g, row);
    if (is_space_arc(state.modal.of(Mode::motion))) return in.raise_code(Condition::space_arc_mode, row);  // 6.14 (a)
  }
  state.modal.set(row);
  state.polar_angle_known = false;
  state.polar_pole[0] = state.polar_pole[1] = 0;
  return Execution::done;
}

void resolve_polar_words(BlockInHand& in) {
  Command& w = in.words;
  State& state = in.state;
  in.jobs.polar_holes.on = false;
  if (reads_plain_words(in)) {
    if (w.target.axes() != 0) state.polar_angle_known = false;
    return;
  }
  const PlaneAxes plane = plane_axes(in);
  if (plane.h < 0 || plane.v < 0) return;
  const auto h = static_cast<unsigned>(plane.h), v = static_cast<unsigned>(plane.v);
  name_polar_targets(in, h, v);
  const bool has_radius = w.target.commands(h), has_angle = w.target.commands(v);
  if (!has_radius && !has_angle) return;  // there is nothing to convert
  const AxisVec position = program_mapped(in) ? to_program(in, in.position()) : in.position();
  const bool stays = in.dialect->rules.coordinate.pole_stays, moves = w.target.kind(h) == TargetKind::radius_increment;
  double pole[2] = {0, 0};
  if (moves) {
    pole[0] = position[h], pole[1] = position[v];
  } else if (stays && !has_radius) {
    for (unsigned i = 0; i < 2; ++i) pole[i] = state.polar_pole[i];
  }
  for (unsigned i = 0; i < 2; ++i) state.polar_pole[i] = stays ? pole[i] : 0;
  const double out[2] = {position[h] - (stays ? pole[0] : 0), position[v] - (stays ? pole[1] : 0)};
  const double radius = has_radius ? w.target[h] : std::hypot(out[0], out[1]);
  const double seen = stays && moves ? 0 : std::atan2(out[1], out[0]) * 180 / kPi;
  double angle = seen;
  PolarHoles& holes = in.jobs.polar_holes;
  holes = PolarHoles{};
  if (has_angle) {
    angle = w.target[v];
    if (w.target.kind(v) == TargetKind::angle_increment) {
      holes.angle_step = angle;
      angle += state.polar_angle_known ? state.polar_angle : seen;
    }
  }
  if (moves && holes.angle_step == 0) holes.radius_step = radius;
  holes.on = (holes.angle_step != 0 || holes.radius_step != 0) && (w.one_shot == nullptr || !is_hole_pattern(w.one_shot->function));
  for (unsigned i = 0; i < 2; ++i) holes.pole[i] = pole[i];
  holes.axis[0] = static_cast<uint8_t>(h), holes.axis[1] = static_cast<uint8_t>(v);
  holes.radius = radius, holes.angle = angle;
  state.polar_angle = angle;
  state.polar_angle_known = true;
  // A negative radius leads to the other side, as |r| at 180 degrees more.
  w.target.set(h, TargetKind::absolute, pole[0] + radius * std::cos(angle * kPi / 180));
  w.target.set(v, TargetKind::absolute, pole[1] + radius * std::sin(angle * kPi / 180));
}

/// Words that count on do so from hole to hole of their block, too (M700 13.1.1, L; HX 12.1.2, K): a step of the angle leads round the pole, one of the
/// radius alone outwards.
void step_polar_hole(BlockInHand& in) {
  PolarHoles& polar = in.jobs.holes.polar;
  polar.radius += polar.radius_step;
  polar.angle += polar.angle_step;
  in.state.polar_angle = polar.angle;
  in.jobs.holes.target.set(polar.axis[0], TargetKind::absolute, polar.pole[0] + polar.radius * std::cos(polar.angle * kPi / 180));
  in.jobs.holes.target.set(polar.axis[1], TargetKind::absolute, polar.pole[1] + polar.radius * std::sin(polar.angle * kPi / 180));
}

}  // namespace nc
