// SPDX-License-Identifier: Apache-2.0
#include "interpret/work_rotation.hpp"

#include <cmath>
#include <initializer_list>

#include "interpret/program_map.hpp"

namespace nc {
namespace {

constexpr double kSame = 1e-9;  // mm

using Which = Notes::WorkRotation;

double note(const BlockContext& in, Which which, unsigned what) {
  return in.notes.get(Notes::work_rotation_key(which, what));
}

/// What turns, and about which point.
struct PlaneTurn {
  int h = -1, v = -1;         ///< axes, -1 = there is none of the name in the parameter
  double deg = 0;
  double center[2] = {0, 0};  ///< machine coordinates
};

bool turns(const BlockContext& in, Which which) { return note(in, which, Notes::kTurnAngle) != 0; }

PlaneTurn turn_of(const BlockContext& in, Which which) {
  PlaneTurn t;
  t.h = static_cast<int>(note(in, which, Notes::kTurnAxisH));
  t.v = static_cast<int>(note(in, which, Notes::kTurnAxisV));
  t.deg = note(in, which, Notes::kTurnAngle);
  t.center[0] = note(in, which, Notes::kTurnH);
  t.center[1] = note(in, which, Notes::kTurnV);
  return t;
}

bool known(const PlaneTurn& t) { return t.h >= 0 && t.v >= 0 && t.h != t.v; }

/// Bits of the axes of a rotation that is one.
uint32_t plane_bits(const BlockContext& in, Which which) {
  if (!turns(in, which)) return 0;
  const PlaneTurn t = turn_of(in, which);
  return known(t) ? 1u << t.h | 1u << t.v : 0u;
}

uint32_t plane_bits(const BlockContext& in) {
  return plane_bits(in, Notes::kTurnCommanded) | plane_bits(in, Notes::kTurnReached);
}

}  // namespace

void refresh_work_rotation(BlockContext& in) {
  State& state = in.state;
  state.work_turned = turns(in, Notes::kTurnCommanded) || turns(in, Notes::kTurnReached);
  bool same = true;
  for (unsigned what = 0; what < Notes::kTurnSize; ++what)
    same = same && note(in, Notes::kTurnCommanded, what) == note(in, Notes::kTurnReached, what);
  state.work_turn_pending = state.work_turned && !same;
  in.program_changed();
}

void take_work_rotation(BlockContext& in, bool at_head) {
  const Settings& s = in.settings;
  const auto axis = [&in](char name, unsigned standard) {
    if (name != 0) return static_cast<double>(in.axis_named(name));
    return standard < in.axis_count ? static_cast<double>(standard) : -1.0;
  };
  double values[Notes::kTurnSize];
  values[Notes::kTurnAngle] = std::fmod(s.work_turn_deg, 360);
  for (unsigned i = 0; i < 2; ++i) {
    values[Notes::kTurnH + i] = s.work_turn_center[i];
    values[Notes::kTurnAxisH + i] = axis(s.work_turn_axis[i], i);
  }
  for (unsigned what = 0; what < Notes::kTurnSize; ++what) {
    if (at_head) {  // nothing has been read that could be taken back
      in.notes.set(Notes::work_rotation_key(Notes::kTurnCommanded, what), values[what]);
      in.notes.set(Notes::work_rotation_key(Notes::kTurnReached, what), values[what]);
    } else {
      in.set_note(Notes::work_rotation_key(Notes::kTurnCommanded, what), values[what]);
    }
  }
  refresh_work_rotation(in);
}

Affine work_rotation(const BlockContext& in, Notes::WorkRotation which) {
  if (!in.state.work_turned || !turns(in, which)) return Affine{};
  const PlaneTurn t = turn_of(in, which);
  if (!known(t)) return Affine{};
  const auto h = static_cast<unsigned>(t.h), v = static_cast<unsigned>(t.v);
  const AxisVec& zero = in.zero();
  return Affine::rotation(h, v, Affine::Angle::degrees(t.deg), t.center[0] - zero[h], t.center[1] - zero[v]);
}

uint32_t moved_by_work_rotation(const BlockContext& in, uint32_t axes) {
  const uint32_t both = plane_bits(in);
  return (axes & both) != 0 ? axes | both : axes;
}

void work_rotation_reached(BlockContext& in, uint32_t commanded) {
  if (!in.state.work_turn_pending || (commanded & plane_bits(in)) == 0) return;
  for (unsigned what = 0; what < Notes::kTurnSize; ++what)
    in.set_note(Notes::work_rotation_key(Notes::kTurnReached, what), note(in, Notes::kTurnCommanded, what));
  refresh_work_rotation(in);
}

bool turns_axis(const BlockContext& in, unsigned axis) {
  return in.state.work_turned && ((plane_bits(in) >> axis) & 1) != 0;
}

bool tilts_plane(const BlockContext& in, unsigned h, unsigned v) {
  return turns_axis(in, h) != turns_axis(in, v);
}

Execution check_work_rotation(BlockContext& in) {
  for (const Which which : {Notes::kTurnCommanded, Notes::kTurnReached}) {
    const PlaneTurn t = turn_of(in, which);
    if (!turns(in, which) || known(t)) continue;
    return in.raise(Condition::illegal_axis, in.settings.work_turn_axis[t.h < 0 ? 0 : 1]);
  }
  const Function motion = in.state.modal.of(Mode::motion);
  const bool straight = is_line(motion) || motion == Function::thread || in.words.one_shot != nullptr ||
                        in.state.cycle.kind != CycleKind::none;
  if (!in.state.work_turn_pending || straight) return Execution::done;
  // The start of the curve would not be turned, its end would.
  const AxisVec start = in.position(), turned = from_program(in, to_program(in, start));
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (std::fabs(start[i] - turned[i]) > kSame) return in.raise(Condition::arc_deviation, Role::code);
  return Execution::done;
}

}  // namespace nc
