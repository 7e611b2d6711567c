// SPDX-License-Identifier: Apache-2.0
// High-accuracy control: G61.1, a mode of group 13, and G08, a function of its own that excludes the other codes of that group
// (M700 13.15). What the mode asks of the motion is in motion/m700_accuracy.hpp.
#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

constexpr int16_t kCuttingMode = 640;  // G64

/// 13.15 "relation with other functions" (1): what G08 P1 needs. The manual gives it no code; P34 as for the modes of 13.17.
bool refuses_command(const Interpreter& in) {
  const State& state = in.state;
  const int16_t* const modal = state.modal.code;
  return state.high_speed != 0 || state.fine_mode != FineMode::none || state.accuracy_command || modal[kGroupPolarCommand] != 150 ||
         state.comp.side != 0 || modal[kGroupCompensation] != 400 || modal[kGroupLength] != 490 || state.any_mirror() != 0 ||
         has_modal_call(in) || modal[kGroupFeed] != 940 || modal[kGroupSurfaceSpeed] != 970 || state.interrupt_on;
}

/// (2), and 13.20: modes in which high-accuracy control cannot be commanded.
Did check_modes_before(Interpreter& in, double code) {
  const int16_t* const modal = in.state.modal.code;
  if (in.state.map.kind != AxisMap::Kind::none) return in.raise(Condition::mill_code, 'G', code);
  if (modal[kGroupNormalLine] != 401) return in.raise(Condition::not_accepted, 'G', code);
  if (modal[kGroupRotation] != 690) return in.raise(Condition::illegal_g, 'G', code);
  return Did::done;
}

}  // namespace

Did check_cutting_code(Interpreter& in, const FunctionRow& row) {
  const double code = row.code / 10.0;
  // After G08 P1 the group is G64; any other code of it is an error.
  if (in.state.accuracy_command && row.code != kCuttingMode) return in.raise(Condition::in_high_accuracy, 'G', code);
  if (row.function != Function::high_accuracy_mode) return Did::done;
  if (!in.settings.high_accuracy_code) return in.raise(Condition::illegal_g, 'G', code);  // precaution (3)
  return check_modes_before(in, code);
}

Did do_high_accuracy(Interpreter& in) {
  State& state = in.state;
  const BlockWords& w = in.words;
  constexpr double kCode = 8;
  if (w.g.size() > 1 || !w.m.empty() || (w.present & ~letters("P")) != 0) return in.raise(Condition::must_stand_alone, 'G', kCode);
  if (!w.has('P')) return in.raise(Condition::format_error, 'P');
  uint32_t p = 0;
  if (!whole_number(w.get('P'), &p) || p > 1) return in.raise(Condition::value_range, 'P', w.get('P'));
  if (p == 1) {
    const Did did = check_modes_before(in, kCode);
    if (did != Did::done) return did;
    if (refuses_command(in)) return in.raise(Condition::illegal_g, 'G', kCode);
    const int16_t before = state.modal.code[kGroupCutting];
    state.modal.code[kGroupCutting] = kCuttingMode;  // and G08 P0 does not bring the old one back
    if (before != kCuttingMode) change_cutting_mode(in, before);
  }
  state.accuracy_command = p == 1;
  state.refresh_accuracy();
  return Did::done;
}

}  // namespace nc
