// SPDX-License-Identifier: Apache-2.0
#include "interpret/work_rotation.hpp"

#include <cmath>
#include <initializer_list>

#include "interpret/program_map.hpp"

namespace nc {
namespace {

constexpr double kSame = 1e-9;  // mm

/// Bits of the two axes of a rotation; 0 where it does not rotate.
uint32_t plane_bits(const WorkTurn& turn) {
  return turn.turns() && turn.has_plane() ? 1u << turn.axis[0] | 1u << turn.axis[1] : 0u;
}

uint32_t plane_bits(const InForce& in) {
  const WorkTurns& turns = in.records->work_turn;
  return plane_bits(turns.commanded) | plane_bits(turns.reached);
}

/// A rotation concerns one of the three axes on which three-dimensional radius compensation has its vector, and another one that is not among them.
bool tilts_space(const InForce& in, const WorkTurn& turn) {
  unsigned turned = 0;
  for (const uint8_t axis : in.state.space.axis) turned += plane_bits(turn) >> axis & 1;
  return in.state.space.on && turned == 1;
}

}  // namespace

void refresh_work_rotation(InForce& in) {
  const WorkTurns& turns = in.records->work_turn;
  in.state.work_turned = turns.commanded.turns() || turns.reached.turns();
  in.state.work_turn_pending = in.state.work_turned && !(turns.commanded == turns.reached);
  in.program_changed();
}

void take_work_rotation(InForce& in, bool at_head) {
  const Settings& s = in.settings;
  const auto axis = [&in](WordSlot name, unsigned standard) {
    if (name != kNoWord) return in.axis_words.axis(name);
    return standard < in.axis_count ? static_cast<int>(standard) : -1;
  };
  WorkTurn turn;
  turn.deg = std::fmod(s.work_turn_deg, 360);
  for (unsigned i = 0; i < 2; ++i) {
    turn.center[i] = s.work_turn_center[i];
    turn.axis[i] = axis(s.work_turn_axis[i], i);
  }
  if (at_head) {  // no block has been read yet that could be taken back
    in.records.change_from_outside(&ProgramRecords::work_turn, WorkTurns{turn, turn});
  } else {
    in.change(&ProgramRecords::work_turn, &WorkTurns::commanded, turn);
  }
  refresh_work_rotation(in);
}

Affine work_rotation(const InForce& in, const WorkTurn& turn) {
  if (!turn.turns() || !turn.has_plane()) return Affine{};
  const auto h = static_cast<unsigned>(turn.axis[0]), v = static_cast<unsigned>(turn.axis[1]);
  const AxisVec& zero = in.zero();
  return Affine::rotation(h, v, Affine::Angle::degrees(turn.deg), turn.center[0] - zero[h], turn.center[1] - zero[v]);
}

uint32_t moved_by_work_rotation(const InForce& in, uint32_t axes) {
  const uint32_t both = plane_bits(in);
  return (axes & both) != 0 ? axes | both : axes;
}

void work_rotation_reached(InForce& in, uint32_t commanded) {
  if (!in.state.work_turn_pending || (commanded & plane_bits(in)) == 0) return;
  in.change(&ProgramRecords::work_turn, &WorkTurns::reached, in.records->work_turn.commanded);
  refresh_work_rotation(in);
}

bool turns_axis(const InForce& in, unsigned axis) {
  return in.state.work_turned && ((plane_bits(in) >> axis) & 1) != 0;
}

bool tilts_plane(const InForce& in, unsigned h, unsigned v) {
  return turns_axis(in, h) != turns_axis(in, v);
}

Execution check_work_rotation(BlockInHand& in) {
  const WorkTurns& turns = in.records->work_turn;
  for (const WorkTurn* turn : {&turns.commanded, &turns.reached}) {
    if (tilts_space(in, *turn)) return in.raise_mode(Condition::plane_mismatch, Mode::radius);
    if (!turn->turns() || turn->has_plane()) continue;
    return in.raise(Condition::illegal_axis, in.settings.work_turn_axis[turn->axis[0] < 0 ? 0 : 1]);
  }
  const Function motion = in.state.modal.of(Mode::motion);
  const bool straight = is_line(motion) || motion == Function::thread || in.words.one_shot != nullptr ||
                        in.state.cycle.kind != CycleKind::none;
  if (!in.state.work_turn_pending || straight) return Execution::done;
  // The end of the curve would be rotated, but its start not yet.
  const AxisVec start = in.position(), turned = from_program(in, to_program(in, start));
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (std::fabs(start[i] - turned[i]) > kSame) return in.raise(Condition::arc_deviation, Role::code);
  return Execution::done;
}

}  // namespace nc
