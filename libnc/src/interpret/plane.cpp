// SPDX-License-Identifier: Apache-2.0
#include "interpret/plane.hpp"

namespace nc {
namespace {

int8_t index_of(const InForce& in, WordSlot name) { return static_cast<int8_t>(in.axis_words.axis(name)); }

}  // namespace

PlanePair pair_of(Function plane) {
  if (plane == Function::plane_zx) return {2, 0, Plane::zx};
  if (plane == Function::plane_yz) return {1, 2, Plane::yz};
  return {0, 1, Plane::xy};
}

int8_t axis_of_pair(const BlockInHand& in, unsigned pair) {
  const WordSlot basic = in.settings.plane_basic[pair], parallel = in.settings.plane_parallel[pair];
  const bool second = in.words.has(parallel) && !in.words.has(basic);
  return index_of(in, second ? parallel : basic);
}

unsigned cylinder_stands_for(const InForce& in) {
  const PlanePair pair = pair_of(in.state.modal.of(Mode::plane));
  const unsigned first = pair.first == 0 || pair.second == 0 ? 0u : 1u;  // X, or Y in the plane without X
  return !in.settings.cylinder_second_axis ? first : pair.first == first ? pair.second : pair.first;
}

void put_cylinder_axis(InForce& in) {
  const PlanePair pair = pair_of(in.state.modal.of(Mode::plane));
  in.state.plane_axis[pair.first == cylinder_stands_for(in) ? 0 : 1] = static_cast<int8_t>(in.state.map.rotary);
}

PlaneAxes plane_axes(const InForce& in) {
  const PlanePair pair = pair_of(in.state.modal.of(Mode::plane));
  return {in.state.plane_axis[0], in.state.plane_axis[1], pair.plane, {vector_along(pair.first), vector_along(pair.second)}};
}

Execution select_plane(BlockInHand& in, const FunctionRow& row) {
  State& state = in.state;
  const PlanePair pair = pair_of(row.function);
  const int8_t h = axis_of_pair(in, pair.first), v = axis_of_pair(in, pair.second);
  const bool changes = !state.modal.is(row.function) || state.plane_axis[0] != h || state.plane_axis[1] != v;
  const Rules& rules = in.dialect->rules;
  if (state.rotated && (changes || !rules.rotation.plane_in_block)) return in.raise_code(Condition::plane_in_rotation, row);  // M700 13.20
  if (state.scaled != 0 && changes && rules.scaling.binds_plane) return in.raise_code(Condition::plane_in_rotation, row);  // Series 8 G57: "in the active plane"
  const bool other = row.function != Function::plane_xy;
  if (other && state.comp.side != 0 && rules.compensation.xy_plane_only) return in.raise_code(Condition::plane_in_compensation, row);
  if (other && state.cycle.kind != CycleKind::none && rules.cycle.xy_plane_only) return in.raise_code(Condition::cycle_wrong_plane, row);
  const bool ends_only = state.moves_since_comp_off == 0 && !rules.compensation.end_is_at_once;
  if (changes && (state.comp.side != 0 || ends_only) && rules.compensation.plane_is_fixed)
    return in.raise_code(Condition::plane_in_compensation, row);
  state.modal.set(row);
  state.plane_axis[0] = h;
  state.plane_axis[1] = v;
  state.third_axis = axis_of_pair(in, pair.third());
  if (state.map.kind == AxisMap::Kind::cylinder && rules.mill.rotary_in_block) put_cylinder_axis(in);
  return Execution::done;
}

/// The axes are found by their names in the machine, because the words of a mode that ends here (G12.1, M700 6.10) are not among these.
void basic_plane_axes(const InForce& in, Function plane, int8_t axis[2], int8_t* third) {
  const PlanePair pair = pair_of(plane);
  const auto basic = [&in](unsigned of_pair) {
    int8_t found = -1;
    for (unsigned k = 0; k < in.axis_count; ++k)
      if (in.axis_words.word(k) == in.settings.plane_basic[of_pair]) found = static_cast<int8_t>(k);
    return found;
  };
  axis[0] = basic(pair.first);
  axis[1] = basic(pair.second);
  *third = basic(pair.third());
}

}  // namespace nc
