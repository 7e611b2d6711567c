// SPDX-License-Identifier: Apache-2.0
// The words of the tapping cycles (M700 13.1.1 (6), G84 and G74): whether a tap goes with the angle of the spindle, and what it then needs.
#include <cmath>

#include "base/units.hpp"
#include "interpret/feed.hpp"
#include "interpret/functions/cycle.hpp"

namespace nc {
namespace {

/// Series 8 G84: each tap goes with the spindle, and its lead has a word of its own.
bool lead_has_word(const InForce& in) { return in.dialect->rules.cycle.tap_has_lead_word; }

/// HX 12.3.5: synchronous taps have codes of their own. Their F is a feed like any other, and with the speed in force it makes the lead.
bool rigid_by_code(const BlockInHand& in) {
  if (lead_has_word(in)) return true;
  const Function function = in.words.cycle != nullptr ? in.words.cycle->function : in.state.modal.of(Mode::cycle);
  return function == Function::cycle_rigid_tap || function == Function::cycle_rigid_reverse_tap;
}

/// Precaution (20): ,R decides; without it the parameter, or an M code.
bool synchronous(const BlockInHand& in) {
  if (rigid_by_code(in)) return true;
  const Command& w = in.words;
  const TapControl modal = w.cycle != nullptr && in.state.cycle.kind == CycleKind::none ? TapControl::by_parameter : in.state.cycle.tap;
  if (w.has_tap_control) return w.tap_control == 1;
  if (modal != TapControl::by_parameter) return modal == TapControl::synchronous;
  bool by_code = in.state.tap_code || in.settings.tap_synchronous;
  for (const Auxiliary& m : w.auxiliary) by_code = by_code || m.taps_synchronously;
  return by_code;
}

/// The lead, mm/rev: F, or E as ridges per inch (appendix 1, P183 and P184). Ranges as of threads (6.7.1).
Execution take_pitch(BlockInHand& in) {
  const Command& w = in.words;
  const bool inch = in.state.modal.is(Function::inch), ridges = w.has(Role::tap_ridges);
  if (!ridges && !w.has(Role::feed)) return Execution::done;
  const Role word = ridges ? Role::tap_ridges : Role::feed;
  const RangeRules& range = in.dialect->rules.range;
  const double value = w.get(word), unit = inch ? kMillimetresPerInch : 1.0;
  const double pitch = !ridges ? value * unit : value > 0 ? kMillimetresPerInch / value : 0;
  if (!(pitch > 0 && pitch < (inch ? range.end_of_lead_inch * kMillimetresPerInch : range.end_of_lead_mm))) return in.raise(Condition::tap_pitch, word, value);
  in.state.cycle.pitch = pitch;
  return Execution::done;
}

Execution take_lead_word(BlockInHand& in) {
  if (!in.words.has(Role::tap_lead)) return Execution::done;
  const double pitch = length_of(in, Role::tap_lead);
  if (!(pitch > 0 && pitch < in.dialect->rules.range.end_of_lead_mm)) return in.raise(Condition::tap_pitch, Role::tap_lead, in.words.get(Role::tap_lead));
  in.state.cycle.pitch = pitch;
  return Execution::done;
}

/// HX 12.3.5: F = n x f.
Execution take_pitch_of_feed(BlockInHand& in) {
  const ModalState& modal = in.state.modal;
  const Execution did = check_feed(in, Function::linear);
  if (did != Execution::done || !(modal.spindle > 0)) return did;  // without a speed check_tap() raises its alarm
  const double feed = modal.feed * (modal.is(Function::inch) ? kMillimetresPerInch : 1.0);
  const double pitch = modal.is(Function::feed_per_revolution) ? feed : feed / modal.spindle;
  if (!(pitch > 0 && pitch < in.dialect->rules.range.end_of_lead_mm)) return in.raise(Condition::tap_pitch, Role::feed, modal.feed);
  in.state.cycle.pitch = pitch;
  return Execution::done;
}

}  // namespace

bool taps(const BlockInHand& in) {
  const Command& w = in.words;
  if (w.motion != nullptr || w.one_shot != nullptr) return false;
  return is_tap(w.cycle != nullptr ? cycle_kind(*in.dialect, w.cycle->function) : in.state.cycle.kind);
}

bool taps_with_spindle(const BlockInHand& in) { return taps(in) && synchronous(in) && !rigid_by_code(in); }

bool keeps_spindle_of_tap(const BlockInHand& in) {
  const Command& w = in.words;
  const CycleState& c = in.state.cycle;
  return w.motion == nullptr && w.cycle == nullptr && is_tap(c.kind) && c.synchronous && !rigid_by_code(in);
}

/// P186: in the mode of synchronous tapping the spindle is the tap's. The block that selects it brings its S.
Execution check_tap_speed(BlockInHand& in) {
  const double s = in.words.get(Role::spindle_speed);
  return in.words.cycle != nullptr ? Execution::done : in.raise(Condition::tap_speed_word, Role::spindle_speed, s);
}

Execution take_tap_words(BlockInHand& in) {
  const Command& w = in.words;
  CycleState& c = in.state.cycle;
  if (w.has_tap_control) {
    if (w.tap_control != 0 && w.tap_control != 1) return in.raise(Condition::value_range, Role::option_tap_control, w.tap_control);
    c.tap = w.tap_control == 1 ? TapControl::synchronous : TapControl::floating;
  }
  if (w.has_return_speed) {
    uint32_t speed = 0;
    if (!whole_number(w.return_speed, &speed) || speed > in.dialect->rules.range.most_return_speed) return in.raise(Condition::value_range, Role::option_return_speed, w.return_speed);
    c.return_speed = speed;
  }
  c.synchronous = synchronous(in);
  if (lead_has_word(in)) return take_lead_word(in);
  if (rigid_by_code(in)) return take_pitch_of_feed(in);
  return c.synchronous ? take_pitch(in) : Execution::done;
}

Execution check_tap(BlockInHand& in) {
  const CycleState& c = in.state.cycle;
  // P181: a speed has been commanded; that of a synchronous tap stands in the block of its code.
  const bool missing = c.synchronous && !rigid_by_code(in) && in.words.cycle != nullptr ? !in.words.has(Role::spindle_speed) : false;
  if (missing || !(in.state.modal.spindle > 0)) {
    if (!in.dialect->rules.cycle.keeps_spindle_direction) return in.raise(Condition::tap_no_speed, Role::spindle_speed);
  }
  if (c.synchronous && !(c.pitch > 0)) return in.raise(Condition::tap_no_pitch, lead_has_word(in) ? Role::tap_lead : Role::feed);
  return Execution::done;
}

namespace {

/// From rest to rest with this highest speed and slope, s.
double stroke_time(const TapLaw& law, double turns) {
  const double speed = law.rev_min / 60;
  return speed * speed <= law.slope * turns ? turns / speed + speed / law.slope : 2 * std::sqrt(turns / law.slope);
}

}  // namespace

/// M700 13.1.1, "acceleration/deceleration pattern": up to three stages, none of them steeper than the one before (precaution (13)), no speed above the highest
/// (14). A stroke has one slope: with the last stage that its speed would reach it keeps each of them, and so it does with an earlier one up to the end of that. The
/// higher speed would make a short hole slower, which never comes to it and would have its slope all the same.
TapLaw tap_law(const InForce& in, double rev_min, double turns) {
  const TapStage* const stage = in.settings.tap_stage;
  const double most = in.settings.tap_most_rev_min > 0 ? in.settings.tap_most_rev_min : HUGE_VAL, clamp = in.state.spindle_clamp.of_tap();
  const double wanted = std::fmin(rev_min, clamp > 0 ? std::fmin(clamp, most) : most);
  double from = 0;
  TapLaw best{wanted, 0}, law{wanted, 0};
  for (unsigned i = 0; i < 3 && from < wanted; ++i) {
    const double to = i == 2 ? most : std::fmin(stage[i].rev_min, most);
    if (!(to > from) || to == HUGE_VAL) continue;  // the machine has no such stage
    if (stage[i].seconds > 0) {
      const double own = (to - from) / 60 / stage[i].seconds;
      law.slope = law.slope > 0 ? std::fmin(law.slope, own) : own;
    }
    law.rev_min = std::fmin(wanted, to);
    if (law.slope > 0 && (best.slope == 0 || stroke_time(law, turns) <= stroke_time(best, turns))) best = law;
    from = to;
  }
  law.rev_min = wanted;  // above the end of the last stage goes its slope on
  return best.slope == 0 || stroke_time(law, turns) <= stroke_time(best, turns) ? law : best;
}

CycleKind tap_in_cuts(const InForce& in, CycleKind kind) {
  if (!(in.state.cycle.tap_q >= 1e-6)) return kind;
  const bool to_r = in.settings.tap_to_r;
  // With a floating holder and no way back between the cuts the spindle would turn back and forth where the axis stands, and tear the tap off its holder.
  if (!to_r && !in.state.cycle.synchronous && !(in.settings.tap_clearance > 0)) return kind;
  if (kind == CycleKind::tap) return to_r ? CycleKind::deep_tap : CycleKind::peck_tap;
  if (kind == CycleKind::reverse_tap) return to_r ? CycleKind::deep_reverse_tap : CycleKind::peck_reverse_tap;
  return kind;
}

}  // namespace nc
