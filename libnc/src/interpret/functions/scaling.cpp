// SPDX-License-Identifier: Apache-2.0
// Scaling G50 G51 (M700 13.19) and coordinate rotation by program G68 G69 (13.20). What they make of a point:
// program_map.cpp.
#include <cmath>
#include <numbers>

#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"
#include "interpret/program_map.hpp"
#include "interpret/work_rotation.hpp"

namespace nc {
namespace {

constexpr double kFactorUnit = 1e-6, kLeastFactor = 1e-6, kLargestFactor = 99.999999;

/// P of G51, else #8072; a parameter out of range is 1.
bool factor_of(const Interpreter& in, double* factor) {
  const BlockWords& w = in.words;
  if (w.has('P')) {
    *factor = w.pointed('P') ? w.get('P') : w.get('P') * kFactorUnit;
    return *factor >= kLeastFactor - 1e-12 && *factor <= kLargestFactor + 1e-12;
  }
  *factor = in.settings.scaling_factor;
  if (!(*factor >= kLeastFactor && *factor <= kLargestFactor)) *factor = 1;
  return true;
}

/// DGSHAPE G51: one factor for X, Y and Z, held within its range; a centre that is not given is where the
/// tool stands.
Did scale_dgshape(Interpreter& in) {
  const BlockWords& w = in.words;
  if (!w.has('P')) return in.raise(Condition::words_missing, 'P');
  const AxisVec at = to_program(in, in.position());
  in.state.scaled = 0;
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (((in.rotary >> i) & 1) != 0) continue;
    const bool given = ((w.axes >> i) & 1) != 0, incremental = ((w.incremental >> i) & 1) != 0;
    in.set_note(Notes::scaling_key(i), !given ? at[i] : incremental ? at[i] + w.axis[i] : w.axis[i]);
    in.state.scaled |= static_cast<uint8_t>(1u << i);
  }
  in.set_note(Notes::scaling_key(kMaxAxes), std::fmin(std::fmax(w.get('P'), 0.001), 999.999));
  in.program_changed();
  in.state.modal.code[kGroupScaling] = 510;
  return Did::done;
}

}  // namespace

Did do_scaling(Interpreter& in) {
  if (in.dialect->id == NC_DIALECT_DGSHAPE) return scale_dgshape(in);
  const BlockWords& w = in.words;
  double factor = 1;
  if (!factor_of(in, &factor)) return in.raise(Condition::value_range, 'P', w.get('P'));
  const AxisVec at = to_program(in, in.position());
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (((w.axes >> i) & 1) == 0) continue;
    in.set_note(Notes::scaling_key(i), ((w.incremental >> i) & 1) != 0 ? at[i] + w.axis[i] : w.axis[i]);
  }
  in.set_note(Notes::scaling_key(kMaxAxes), factor);  // (8): the newest counts for all axes
  in.state.scaled |= static_cast<uint8_t>(w.axes);
  if (in_figure(in)) in.state.figure_scaled |= static_cast<uint8_t>(w.axes);  // (6)
  in.program_changed();
  in.state.modal.code[kGroupScaling] = 510;
  return Did::done;
}

void end_scaling(Interpreter& in) {
  in.state.scaled = 0;
  in.program_changed();
  in.state.modal.code[kGroupScaling] = 500;
}

Did do_rotation(Interpreter& in) {
  const BlockWords& w = in.words;
  if (w.has('I') && w.has('J') && w.has('K')) return in.raise(Condition::space_conversion, 'G', 68);  // 13.22
  const PlaneAxes plane = plane_axes(in);
  if (plane.h < 0 || plane.v < 0) return in.raise(Condition::plane_mismatch, 'G', 68);
  for (const FunctionRow* row : w.g)
    if (row->group == kGroupPlane)
      return in.raise(Condition::plane_in_rotation, 'G', row->code / 10.0);  // (13): not in the same block
  if (w.has('R')) {                                                          // (4), (5)
    const double r = length_value(in, w.get('R'), w.flags['R' - 'A'], true, true);
    const double before = in.state.modal.code[kGroupDistance] == 910
                              ? in.notes.get(Notes::rotation_key(Notes::kRotationAngle))
                              : 0;
    in.set_note(Notes::rotation_key(Notes::kRotationAngle), std::fmod(before + r, 360));
  }
  AxisVec at = in.position();
  if (in.state.work_turned) unturn_work(in, at);  // 13.21 comes behind this rotation
  const int axes[2] = {plane.h, plane.v};
  for (unsigned i = 0; i < 2; ++i) {
    const auto axis = static_cast<unsigned>(axes[i]);
    const bool given = ((w.axes >> axis) & 1) != 0;  // absolute also in G91
    in.set_note(Notes::rotation_key(i), given ? w.axis[axis] : unmirrored(in, axis, at[axis]));
  }
  in.state.rotated = true;
  in.program_changed();
  in.state.modal.code[kGroupRotation] = 680;
  return Did::done;
}

void end_rotation(Interpreter& in) {
  in.state.rotated = false;
  in.program_changed();
  in.state.modal.code[kGroupRotation] = 690;
}

void keep_rotation_center(Interpreter& in, const AxisVec& zero_before) {
  if (!in.state.rotated) return;
  const PlaneAxes plane = plane_axes(in);
  const int axes[2] = {plane.h, plane.v};
  for (unsigned i = 0; i < 2; ++i) {
    const auto axis = static_cast<unsigned>(axes[i]);
    const unsigned key = Notes::rotation_key(i);
    in.set_note(key, in.notes.get(key) + zero_before[axis] - in.zero()[axis]);
  }
}

}  // namespace nc
