// SPDX-License-Identifier: Apache-2.0
// G05: high-speed machining I and II (M700 13.16) and high-speed high-accuracy control II with SSS (13.17); G05.1: high-speed
// high-accuracy control I and the spline (13.17, 13.18). This control looks ahead as far in every mode, so the modes decide what may be
// commanded (fine_mode.cpp), turn high-accuracy control on and open the spline; blocks are never merged.
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

constexpr double kHighSpeed = 5, kHighSpeedAccuracy = 5.1;

bool in_mode_2(const State& state) { return state.fine_mode == FineMode::accuracy2 || state.fine_mode == FineMode::smooth; }

bool other_words(const BlockWords& w, uint32_t allowed) { return w.g.size() > 1 || !w.m.empty() || (w.present & ~allowed) != 0; }

/// 6.11, 6.12: what excludes the modes of 13.17 and the spline.
bool excluded(const State& state) {
  const int16_t motion = state.modal.code[kGroupMotion];
  return state.modal.code[kGroupPolarCommand] == 160 || motion == 23 || motion == 33;
}

/// 13.17.1 "relation with other functions" (1), 13.17.2: the modal state that a mode starts from. Mode I takes the modes of group 13 but
/// G61.1 and the feed per revolution and constant surface speed, without a promise; it alone asks for G49.
bool wrong_state(const Interpreter& in, FineMode mode) {
  const State& state = in.state;
  const int16_t* const modal = state.modal.code;
  if (state.comp.side != 0 || modal[kGroupCompensation] != 400 || state.any_mirror() != 0 || has_modal_call(in) ||
      modal[kGroupRotation] != 690 || state.cycle.kind != CycleKind::none || modal[kGroupCycle] != 800 || state.interrupt_on)
    return true;
  if (mode != FineMode::accuracy1) return modal[kGroupCutting] != 640 || modal[kGroupFeed] != 940 || modal[kGroupSurfaceSpeed] != 970;
  const int16_t cutting = modal[kGroupCutting];
  const bool cutting_known = cutting == 610 || cutting == 620 || cutting == 630 || cutting == 640;
  return modal[kGroupLength] != 490 || !cutting_known || (modal[kGroupFeed] != 940 && modal[kGroupFeed] != 950);
}

Did start(Interpreter& in, FineMode mode, double code) {
  State& state = in.state;
  if (!in.settings.high_speed_codes || excluded(state)) return in.raise(Condition::illegal_g, 'G', code);
  if (state.modal.code[kGroupNormalLine] != 401) return in.raise(Condition::not_accepted, 'G', code);  // 13.14
  if (wrong_state(in, mode)) return in.raise(Condition::illegal_g, 'G', code);
  state.fine_mode = mode;
  state.refresh_accuracy();
  return Did::done;
}

/// Precaution (5): radius compensation is turned off inside the mode.
Did leave(Interpreter& in, double code) {
  State& state = in.state;
  if (state.comp.side != 0 || state.modal.code[kGroupCompensation] != 400) return in.raise(Condition::illegal_g, 'G', code);
  state.fine_mode = FineMode::none;
  state.spline = SplineState{};
  state.refresh_special();
  state.refresh_accuracy();
  return Did::done;
}

/// The machine slows down once at these blocks (13.16 restriction (4), 13.17.1 precaution (4)).
void slow_down(Interpreter& in) { in.emit(ItemKind::gate).gate.kind = NC_GATE_IN_POSITION; }

Did high_speed_machining(Interpreter& in, uint32_t p) {
  State& state = in.state;
  // 13.20: mode III is refused in a rotation; it is in no part of the manual but that and the list of P.
  if (p == 3 && state.modal.code[kGroupRotation] != 690) return in.raise(Condition::illegal_g, 'G', kHighSpeed);
  if (p == 3) return in.raise(Condition::high_speed_3, 'P', p);  // App.1 P65
  if (in_mode_2(state)) return in.raise(Condition::illegal_g, 'G', kHighSpeed);  // not in the list of 13.17
  const int16_t motion = state.modal.code[kGroupMotion];
  if (motion == 23 || motion == 33) return in.raise(Condition::illegal_g, 'G', kHighSpeed);  // 6.11
  if (state.high_speed != p) slow_down(in);
  state.high_speed = static_cast<uint16_t>(p);
  return Did::done;
}

/// Basic axes named with G05.1 Q2; false when there are other words.
bool spline_axes(const Interpreter& in, uint8_t* axes) {
  uint32_t named = 0;
  *axes = 0;
  for (const char name : in.settings.plane_basic) {
    const int axis = name == 0 ? -1 : in.axis_of[name - 'A'];
    if (axis < 0 || !in.words.has(name)) continue;
    named |= 1u << (name - 'A');
    *axes = static_cast<uint8_t>(*axes | 1u << axis);
  }
  return !other_words(in.words, named | letters("Q"));
}

Did spline_on(Interpreter& in) {
  State& state = in.state;
  if (!in_mode_2(state) || !in.settings.spline_allowed || !in.settings.high_speed_codes || excluded(state))
    return in.raise(Condition::illegal_g, 'G', kHighSpeedAccuracy);  // 13.18 (3), (4), precaution (2)
  uint8_t axes = 0;
  if (!spline_axes(in, &axes)) return in.raise(Condition::must_stand_alone, 'G', kHighSpeedAccuracy);  // precaution (5)
  state.spline = SplineState{};
  state.spline.on = true;
  state.spline.axes = axes;
  state.refresh_special();
  slow_down(in);
  return Did::done;
}

}  // namespace

Did do_high_speed(Interpreter& in) {
  State& state = in.state;
  const BlockWords& w = in.words;
  if (!w.has('P')) return in.raise(Condition::format_error, 'P');
  uint32_t p = 0;
  if ((w.flags['P' - 'A'] & kWordPoint) != 0) return in.raise(Condition::format_error, 'P', w.get('P'));
  if (!whole_number(w.get('P'), &p) || (p > 3 && p != kHighAccuracy2)) return in.raise(Condition::value_range, 'P', w.get('P'));
  // 13.17.1 precaution (5) makes it P33, 13.16 restriction (8) P35.
  const bool accuracy = p == kHighAccuracy2 || (p == 0 && in_mode_2(state));
  if (other_words(w, letters("P"))) return in.raise(accuracy ? Condition::must_stand_alone : Condition::value_range, 'G', kHighSpeed);
  if (state.fine_mode == FineMode::accuracy1) return in.raise(Condition::illegal_g, 'G', kHighSpeed);  // 13.17.1 precaution (11)
  if (p == kHighAccuracy2 && in_mode_2(state)) return Did::done;
  Did did = Did::done;
  if (p == 0 && in_mode_2(state)) did = leave(in, kHighSpeed);
  if (p == kHighAccuracy2) did = start(in, in.settings.smooth_control ? FineMode::smooth : FineMode::accuracy2, kHighSpeed);
  if (p >= 1 && p <= 3) return high_speed_machining(in, p);
  if (did != Did::done) return did;
  if (state.high_speed != p) slow_down(in);
  state.high_speed = static_cast<uint16_t>(p);
  return Did::done;
}

Did do_high_speed_accuracy(Interpreter& in) {
  State& state = in.state;
  const BlockWords& w = in.words;
  if (!w.has('Q') || (w.flags['Q' - 'A'] & kWordPoint) != 0) return in.raise(Condition::format_error, 'Q');
  uint32_t q = 0;
  if (!whole_number(w.get('Q'), &q) || q > 2) return in.raise(Condition::value_range, 'Q', w.get('Q'));
  if (q == 2) return spline_on(in);
  if (other_words(w, letters("Q"))) return in.raise(Condition::must_stand_alone, 'G', kHighSpeedAccuracy);
  if (q == 1) {
    if (in_mode_2(state)) return in.raise(Condition::illegal_g, 'G', kHighSpeedAccuracy);  // 13.17.1 precaution (10)
    if (state.fine_mode == FineMode::accuracy1) return Did::done;
    state.high_speed = 0;  // 13.16: cancels high-speed machining
    const Did did = start(in, FineMode::accuracy1, kHighSpeedAccuracy);
    if (did == Did::done) slow_down(in);
    return did;
  }
  if (state.spline.on) {
    state.spline = SplineState{};
    state.refresh_special();
    slow_down(in);
    return Did::done;
  }
  if (state.fine_mode != FineMode::accuracy1) return Did::done;
  const Did did = leave(in, kHighSpeedAccuracy);
  if (did == Did::done) slow_down(in);
  return did;
}

}  // namespace nc
