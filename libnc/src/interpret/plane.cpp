// SPDX-License-Identifier: Apache-2.0
#include "interpret/plane.hpp"

namespace nc {
namespace {

/// The planes as pairs of I, J, K: M700 6.3, G17 = IJ, G18 = KI (K is horizontal), G19 = JK.
struct Pair {
  uint8_t first, second;
  Plane plane;
};

Pair pair_of(int16_t code) {
  if (code == 180) return {2, 0, Plane::zx};
  if (code == 190) return {1, 2, Plane::yz};
  return {0, 1, Plane::xy};
}

int8_t index_of(const Interpreter& in, char letter) { return letter == 0 ? int8_t{-1} : in.axis_of[letter - 'A']; }

}  // namespace

int8_t axis_of_pair(const Interpreter& in, unsigned pair) {
  const char basic = in.settings.plane_basic[pair], parallel = in.settings.plane_parallel[pair];
  const bool second = parallel != 0 && in.words.has(parallel) && !(basic != 0 && in.words.has(basic));
  return index_of(in, second ? parallel : basic);
}

PlaneAxes plane_axes(const Interpreter& in) {
  const Pair pair = pair_of(in.state.modal.code[kGroupPlane]);
  return {in.state.plane_axis[0], in.state.plane_axis[1], pair.plane, {static_cast<char>('I' + pair.first), static_cast<char>('I' + pair.second)}};
}

Did select_plane(Interpreter& in, int16_t code) {
  State& state = in.state;
  if (state.rotated) return in.raise(Condition::plane_in_rotation, 'G', code / 10.0);  // M700 13.20
  const Pair pair = pair_of(code);
  const int8_t h = axis_of_pair(in, pair.first), v = axis_of_pair(in, pair.second);
  const bool changes = state.modal.code[kGroupPlane] != code || state.plane_axis[0] != h || state.plane_axis[1] != v;
  if (in.dialect->id == NC_DIALECT_DGSHAPE) {
    // DGSHAPE G40-G42, G80: XY plane only.
    if (code != 170 && state.comp.side != 0) return in.raise(Condition::plane_in_compensation, 'G', code / 10.0);
    if (code != 170 && state.cycle.kind != CycleKind::none) return in.raise(Condition::cycle_wrong_plane, 'G', code / 10.0);
  } else if (changes && (state.comp.side != 0 || state.moves_since_comp_off == 0)) {
    return in.raise(Condition::plane_in_compensation, 'G', code / 10.0);  // M700 App.1 P112, also right after G40
  }
  state.modal.code[kGroupPlane] = code;
  state.plane_axis[0] = h;
  state.plane_axis[1] = v;
  return Did::done;
}

void select_basic_plane(Interpreter& in, int16_t code) {
  const Pair pair = pair_of(code);
  in.state.modal.code[kGroupPlane] = code;
  in.state.plane_axis[0] = index_of(in, in.settings.plane_basic[pair.first]);
  in.state.plane_axis[1] = index_of(in, in.settings.plane_basic[pair.second]);
}

}  // namespace nc
