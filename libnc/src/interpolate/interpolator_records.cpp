// SPDX-License-Identifier: Apache-2.0
// What the scan does with each kind of record.
#include <algorithm>
#include <cmath>

#include "base/same_place.hpp"
#include "interpolate/interpolator.hpp"
#include "path/shape.hpp"

namespace nc {
namespace {

uint32_t code_number(double value) {
  return value >= 0 && value < 4294967296.0 ? static_cast<uint32_t>(value) : 0;
}

}  // namespace

Interpolator::Done Interpolator::execute(const Record& r, const nc_inputs& in) {
  Done done = Done::yes;
  // The plan comes to rest before such a record, so any speed that is left is rounding.
  if (r.kind == ItemKind::gate || r.kind == ItemKind::sync || r.kind == ItemKind::alarm ||
      r.kind == ItemKind::end)
    law_.v = 0;
  switch (r.kind) {
    case ItemKind::move:
      done = move(r, in);
      break;
    case ItemKind::action:
      done = action(r.action, in);
      break;
    case ItemKind::gate:
      done = gate(r.gate, in);
      break;
    case ItemKind::sync:
      done = sync(r, in);
      break;
    case ItemKind::mark:
      mark(r.mark, in);
      return Done::yes;
    case ItemKind::alarm:
      if (!messages_.empty()) return wait(NC_CAUSE_NONE);  // what the program has printed before goes out first
      alarm();
      break;
    case ItemKind::end:
      if (!messages_.empty()) return wait(NC_CAUSE_NONE);
      modal_ = r.end.modal;
      settle_axes();
      recalculate_ = false;
      forget_length();
      length_ = r.end.along_tool;
      interrupt_mode_ = 0;
      interrupt_rest_.forget();
      interrupt_wanted_ = hold_behind_tap_ = false;
      tapping_ = 0;
      if (!tap_.held) release_tap();
      suppress_ = disable_ = 0;  // M700 9.1: the end of the program resets
      block_begun_ = begins_again_ = in_mdi_ = false;
      run_.end();
      run_ended_ = true;
      state_ = NC_STATE_IDLE;
      shared_->world.write({});  // serials begin anew with the next run
      return Done::yes;
  }
  // A program that is begun inside stands in front of a block.
  if (done == Done::yes) block_begun_ = r.kind != ItemKind::gate || !r.gate.begins_again;
  return done;
}

Interpolator::Done Interpolator::wait(nc_stop_cause cause) {
  cause_ = cause;
  time_ = 0;
  return Done::no;
}

/// The alarm item that stops the program. Its text is in the interpreter.
void Interpolator::alarm() {
  alarmed_ = true;
  state_ = NC_STATE_ALARM;
}

/// The move does not begin where the axes stand, which should never happen: nothing moves, and the feeder shows an internal alarm.
Interpolator::Done Interpolator::fault(const Record& r) {
  alarmed_ = true;
  faulted_ = ScanFault::move;
  stop_in(r.source, last_block_);
  return Done::no;
}

/// Notes the block at which a program is stopped by an alarm that is no item of it.
void Interpolator::stop_in(const nc_source& block, BlockSeq behind) {
  stopped_ = true;
  stopped_at_ = block;
  stopped_behind_ = behind;
}

// ---- moves
// --------------------------------------------------------------------------------------------------------------

/// False when the move cannot be begun: it would jump.
bool Interpolator::begin_move(const Record& r, const nc_inputs&) {
  const Segment& s = r.segment;
  // Where the path that has come to rest leads over this move, it has begun already: several may be gone in one cycle, and a hold may come to rest behind
  // the beginning of a move before the one in front is counted off.
  if (at_rest() && !follower_.rests_behind(tail_)) {
    // Axes that were stopped on a smoothed line may stand beside the programmed line; whether its path goes on there is checked when it does.
    const double most = optimal_ != nullptr ? kReached + 2 * config_.tolerance : kReached;
    const AxisVec from = s.begun > 0 ? curve_position(s.curve, s.begun, config_.axis_count) : s.curve.start;
    for (unsigned i = 0; i < config_.axis_count; ++i) {
      if (std::fabs(from[i] - wanted_[i]) > most) return false;
    }
  }
  for (unsigned i = 0; by_hand_ != 0 && i < config_.axis_count; ++i)
    if (std::fabs(s.curve.delta[i]) > kAddingUp) by_hand_ &= ~(1u << i);
  law_.s = s.begun;
  moving_ = true;
  elsewhere_ = false;
  block_begun_ = true;
  thread_locked_ = false;
  skip_braking_ = false;
  if (s.skip) skipped_ = false;
  skip_last_ = 0;  // M700 15.5 (10): a signal that is on rises with the block
  skip_feed_ = s.start_feed_mm_s;
  return true;
}

void Interpolator::end_move(const Record& r, const nc_inputs& in) {
  // The rest of a move that a skip signal has ended is not executed, although the plan leads over it: what follows is planned anew, from where
  // the axes are.
  if (skip_braking_ && follower_.at_rest()) {
    follower_.give_up();
    passing_ = false;
  }
  path_end_ = skip_braking_ ? wanted_ : r.segment.curve.end;
  law_.s = 0;
  tap_.turns += r.segment.curve.length * r.segment.tap_rev_per_mm;
  moving_ = skip_braking_ = rounding_ = false;
  rapid_behind_ = r.segment.rapid;
  check_ = r.segment.rapid || r.segment.exact_stop || r.segment.skip;
  if (r.segment.index_axes != 0) index_.arrive();
  latest_ = &r.segment;
  block_has_thread_ |= r.segment.thread;
  if (r.segment.skip && !skipped_) {
    skip_position_ = wanted_;
    skip_behind_ = filter_.active() && !all_locked(r.segment, in) ? r.segment.skip_mask : uint8_t{0};
    skip_behind_away_ = r.segment.skip_away;
  }
}

/// A smoothed corner has led the axes beside the end of the newest move.
bool Interpolator::beside_path_end() const {
  for (unsigned i = 0; optimal_ != nullptr && i < config_.axis_count; ++i)
    if (std::fabs(wanted_[i] - path_end_[i]) > kReached) return true;
  return false;
}

/// Feed of the segment at an override of 100 %. M700 6.11: on an exponential curve the feed changes evenly with its linear axis from F to Q. 7.3: the
/// handle may have changed the feed of F1 to F5.
double Interpolator::programmed_feed(const Segment& s) const {
  if (s.digit_step_mm_s > 0)
    return std::clamp(s.feed_mm_s + digit_pulses_[s.feed_digit - 2] * static_cast<double>(s.digit_step_mm_s), 0.0,
                      static_cast<double>(s.digit_most_mm_s));
  if (s.skip_speeds != nullptr) return skip_feed_;
  if (!(s.feed_end_mm_s > 0) || s.curve.shape == nullptr) return s.feed_mm_s;
  const unsigned axis = s.curve.shape->what.exponential.linear;
  const double share = (wanted_[axis] - s.curve.start[axis]) / s.curve.delta[axis];
  return s.feed_mm_s + (s.feed_end_mm_s - s.feed_mm_s) * std::min(1.0, std::max(0.0, share));
}

/// M700 7.3: the first handle changes the feed while a cut with F1 to F5 is in execution, neither in dry run nor with an axis locked (5). The change
/// stays, and the feed is kept within 0 and #1506.
void Interpolator::turn_feed_handle(const nc_inputs& in) {
  if (in.feed_pulses == 0 || !moving_ || state_ != NC_STATE_RUNNING || in.dry_run || in.locked != 0) return;
  const Segment& s = current().segment;
  if (!(s.digit_step_mm_s > 0)) return;
  const double step = static_cast<double>(s.digit_step_mm_s), most = static_cast<double>(s.digit_most_mm_s);
  double& pulses = digit_pulses_[s.feed_digit - 2];
  pulses = std::clamp(pulses + in.feed_pulses, -s.feed_mm_s / step, (most - s.feed_mm_s) / step);
}

/// Why a move that needs a turning spindle does not go on.
nc_stop_cause Interpolator::no_spindle(const nc_inputs& in) const {
  return encoder(in).unmeasured ? NC_CAUSE_SPINDLE_UNMEASURED : NC_CAUSE_SPINDLE_STOPPED;
}

/// M700 6.7.1: a thread that is cut from rest begins when the spindle is at its start angle, at that moment within the cycle. It does not begin when
/// its feed would exceed the largest cutting feed.
bool Interpolator::thread_may_begin(const Segment& s, const nc_inputs& in) {
  const double speed = encoder(in).rev_per_s;
  if (spindle_reversed(in)) {
    wait(NC_CAUSE_SPINDLE_REVERSED);
    return false;
  }
  if (speed != 0 && s.feed_mm_rev * std::fabs(speed) > s.speed_limit * (1 + 1e-9)) {
    wait(NC_CAUSE_SPINDLE_FAST);
    return false;
  }
  if (!encoder(in).turns_valid && !encoder(in).unmeasured) return true;
  if (speed == 0) {
    wait(no_spindle(in));
    return false;
  }
  const double ahead = (static_cast<double>(s.thread_angle) / 360 - spindle_turns(in)) * (speed > 0 ? 1 : -1);
  const double until = (ahead - std::floor(ahead)) / std::fabs(speed);
  if (until >= time_) {
    wait(NC_CAUSE_SPINDLE_ANGLE);
    return false;
  }
  time_ -= until;
  return true;
}

/// Path speed of a thread. First it goes to the speed that belongs to the measured speed of the spindle; once that is reached, each place on the path
/// belongs to an angle of the spindle, and the speed also corrects the error of that place: speed and angle may be measured a little
/// differently, and the angle counts.
double Interpolator::thread_speed(const Segment& s, const nc_inputs& in) {
  constexpr double kReturn = 0.2;  // share of an error that is corrected in one cycle
  const double pace = s.feed_mm_rev * std::fabs(encoder(in).rev_per_s);
  if (!encoder(in).turns_valid) return pace;
  const double turns = spindle_turns(in);
  if (!thread_locked_) {
    if (law_.v >= pace && pace > 0) {
      thread_locked_ = true;
      thread_origin_ = turns - std::copysign(law_.s / s.feed_mm_rev, encoder(in).rev_per_s);
    }
    return pace;
  }
  const double behind = s.feed_mm_rev * std::fabs(turns - thread_origin_) - law_.s;
  return std::max(0.0, pace + kReturn * behind / config_.cycle_s);
}

/// M700 15.5 (9): at the rising edge of a skip signal its feed acts; when several rise together, the smallest.
void Interpolator::change_skip_feed(const SkipSpeeds& speeds, uint32_t signals) {
  const uint32_t rises = signals & ~skip_last_ & speeds.mask;
  skip_last_ = signals;
  double feed = HUGE_VAL;
  for (unsigned i = 0; i < SkipSpeeds::kSignals; ++i)
    if (((rises >> i) & 1) != 0) feed = std::min(feed, speeds.feed_mm_min[i] / 60);
  if (feed < HUGE_VAL) skip_feed_ = feed;
}

/// M700 7.10: factor by which the feed is lowered before an inner corner. The corner may lie some blocks ahead, where blocks are shorter than the zone
/// in which the feed is lowered.
double Interpolator::corner_factor(const Segment& s) const {
  constexpr unsigned kRecordsAhead = 128;  // the most records that are looked at in one cycle
  if (s.slow_zone > 0) return law_.s >= s.curve.length - static_cast<double>(s.slow_zone) ? static_cast<double>(s.slow_factor) : 1;
  double way = s.curve.length - law_.s;
  for (uint32_t at = tail_ + 1; at != end_ && at - tail_ < kRecordsAhead && way < static_cast<double>(s.corner_reach); ++at) {
    const Record& r = ring_[at & mask_];
    if (r.kind != ItemKind::move) continue;
    if (!(r.segment.corner_reach > 0)) break;  // rapid traverse, or the mode has ended
    way += r.segment.curve.length;
    if (r.segment.slow_zone > 0) return way <= static_cast<double>(r.segment.slow_zone) ? static_cast<double>(r.segment.slow_factor) : 1;
  }
  return 1;
}

/// Path speed that is wanted now; 0 lets the path come to rest.
double Interpolator::speed_cap(const Segment& s, const nc_inputs& in) {
  if ((s.thread ? thread_braking() : braking()) || skip_braking_) return 0;
  double cap = s.rapid ? s.speed_limit * in.rapid_override : std::min(s.speed_limit, tap_axis_most(s, &AxisLimits::velocity));
  nc_stop_cause cause = NC_CAUSE_OVERRIDE_ZERO;
  if (dry_feed(s) >= 0) {
    if (dry_feed(s) < cap) cause = dry_stop(in);
    cap = std::min({cap, s.dry_limit, dry_feed(s)});
  } else if (s.thread) {
    cap = std::min(cap, thread_speed(s, in));
    cause = no_spindle(in);
  } else if (!s.rapid) {
    const double override_now = s.fixed_override ? 1 : feed_override(in);
    double feed = s.feed_mm_rev > 0 ? s.feed_mm_rev * std::fabs(encoder(in).rev_per_s) : programmed_feed(s);
    // M700 7.3, 7.4 note 3: operation alarms 104 and 105.
    if (feed <= 0) cause = s.feed_mm_rev > 0 ? no_spindle(in) : NC_CAUSE_FEED_ZERO;
    // M700 7.10: on top of the override, below the clamp.
    if (s.slow_zone > 0 || s.corner_reach > 0) feed *= corner_factor(s);
    // M700 15.2: a skip move goes at 100 %, unless the override is 0.
    cap = std::min(cap, s.skip && override_now > 0 ? feed : feed * override_now);
  }
  if (cap <= 0 && at_rest()) cause_ = cause;
  return cap;
}

Interpolator::Done Interpolator::move(const Record& r, const nc_inputs& in) {
  const Segment& s = r.segment;
  if (!(s.curve.length > 0)) return Done::yes;
  const bool begins = !moving_;
  Done lost = Done::yes;
  if (c_axes_ != 0 && lost_move(r, &lost)) return lost;
  if (filter_.active() && moving_ && skip_braking_ && at_rest()) {  // the path rested already when the signal came, but the axes still moved
    end_move(r, in);
    return Done::yes;
  }
  if ((filter_.active() || s.filter.kind != FilterTimes::Kind::none) && !filters_ready(r)) return alarmed_ ? Done::no : wait(NC_CAUSE_IN_POSITION);
  if (begins && tapping_ != 0 && at_rest() && tap_disturbed(in)) return wait(NC_CAUSE_TAP_SPINDLE);
  if (begins && at_rest() && tap_follower_.waited_for()) return wait(NC_CAUSE_SPINDLE_ANGLE);
  if ((s.index_axes | s.unclamps) != 0) {
    if (begins && !unclamp_for(s, in)) return Done::no;
    if (law_.s > s.begun) index_.leave(s.index_axes);
  }
  if (begins && s.tap_rev_per_mm != 0) {
    if (at_rest() && !tap_spindle_ready(in)) return Done::no;
    note_tap(s, in);
  }
  if (begins && goes_by_spindle(s) && at_rest() && optimal_ == nullptr && !thread_may_begin(s, in)) return Done::no;
  if (begins && !begin_move(r, in)) return fault(r);
  latest_ = &s;
  if (s.skip_speeds != nullptr && !all_locked(s, in)) change_skip_feed(*s.skip_speeds, in.skip);
  if (!skipped_ && skip_ends(s, in)) {
    // The signal was sampled with the position that the axes had when this cycle began.
    skip_braking_ = true;
    note_skip(in, begins || s.skip_away ? 0 : in.skip & s.skip_mask);
    // M700 15.2: a signal that is on already at the start leaves no movement. A path that comes at speed has to brake first.
    if (begins && follower_.at_rest()) {
      end_move(r, in);
      return Done::yes;
    }
  }
  if (optimal_ != nullptr) return follow_plan(r, in);
  const double from = law_.s;
  const LawGoal goal{s.curve.length, plan_->exit2(ordinal_), speed_cap(s, in), std::min(s.acceleration, tap_axis_most(s, &AxisLimits::acceleration))};
  time_ = advance(law_, goal, time_);
  path_length_ += law_.s - from;
  if (law_.s >= s.curve.length) {
    wanted_ = s.curve.end;
    end_move(r, in);
    return Done::yes;
  }
  wanted_ = curve_position(s.curve, law_.s, config_.axis_count);
  if (s.rounds()) round_arc(s);
  if (skip_braking_ && at_rest()) {
    end_move(r, in);
    return Done::yes;
  }
  return Done::no;
}

// ---- actions
// ------------------------------------------------------------------------------------------------------------

Interpolator::Done Interpolator::action(const Action& a, const nc_inputs& in) {
  switch (a.kind) {
    case NC_ACTION_OUTPUT:  // M700 13.5.5: the bits of one word, in the image that the outputs carry
      if (a.index < NC_WORDS) {
        output_[a.index] = (output_[a.index] & ~a.mask) | (a.bits & a.mask);
        output_written_[a.index] |= a.mask;
      }
      return Done::yes;
    case NC_ACTION_MESSAGE:
      return messages_.push({a.text, a.index}) ? Done::yes : wait(NC_CAUSE_NONE);
    case NC_ACTION_CONTROL:
      if (a.index == NC_CONTROL_SUPPRESS) suppress_ = code_number(a.value);
      if (a.index == NC_CONTROL_DISABLE) disable_ = code_number(a.value);
      if (a.index == NC_CONTROL_SURFACE_RADIUS) spindles_.surface_radius(a.value, a.bits);
      if (a.index == NC_CONTROL_SURFACE_SPEED && (!in.auxiliary_lock || a.bits == 0)) spindles_.surface(a.value, a.bits);
      if (a.index == NC_CONTROL_SPINDLE_CLAMP) spindles_.clamp(a.bits, a.mask, code_number(a.value));
      if (a.index == NC_CONTROL_INTERRUPT) {
        const uint32_t mode = code_number(a.value);
        interrupt_rest_.change(interrupt_mode_, mode);
        interrupt_mode_ = mode;
        block_waits_ = true;  // a block that changes the state of the interrupt is finished first
      }
      if (a.index == NC_CONTROL_TOOL_LIFE && !in.auxiliary_lock) {  // else the tool of before stays in the spindle
        const auto cut_ms = static_cast<uint32_t>(std::lround(cut_s_ * 1000));
        if (tool_.place != 0 && cut_ms != 0 && !shared_->lives.push(tool_, cut_ms)) return wait(NC_CAUSE_NONE);
        tool_ = {static_cast<uint8_t>(code_number(a.value)), a.bits};
        cut_s_ = 0;
      }
      if (a.index == NC_CONTROL_TAPPING) return take_tapping(static_cast<uint8_t>(code_number(a.value)));
      return Done::yes;
    case NC_ACTION_CURRENT_LIMIT:  // M700 15.6
      if (a.index < kMaxAxes) current_limit_[a.index] = static_cast<uint16_t>(code_number(a.value));
      return Done::yes;
    default:
      return strobe(a, in);
  }
}

/// Gives out M, S, T or B with its strobe. A strobe rises only when FIN is off and the last strobe of its kind is complete; a code that is given
/// out while the axes move cannot wait for that.
Interpolator::Done Interpolator::strobe(const Action& a, const nc_inputs& in) {
  if (in.auxiliary_lock && !a.program_flow) return Done::yes;
  const uint8_t bit = static_cast<uint8_t>(1u << a.kind);
  const bool awaited = !(suppress_ & NC_SUPPRESS_FIN);  // M700 13.5.9: #3003 bit 1
  if (awaited && at_rest() && (fin_ || ((strobe_ | own_fin_) & bit))) {
    held_ = bit;
    return wait(NC_CAUSE_FIN);
  }
  switch (a.kind) {
    case NC_ACTION_M:
      m_ = code_number(a.value);
      spindles_.turn(a.turn);
      if (a.turn != SpindleTurn::as_it_is) release_tap();
      break;
    case NC_ACTION_S:
      release_tap();
      spindles_.command(a.value);
      break;
    case NC_ACTION_T:
      t_ = code_number(a.value);
      break;
    default:
      b_ = code_number(a.value);
      break;
  }
  strobe_ = static_cast<uint8_t>(strobe_ | bit);
  fin_low_ = !fin_;
  own_low_ = static_cast<uint8_t>((own_fin_ & bit) != 0 ? own_low_ & ~bit : own_low_ | bit);
  return Done::yes;
}

// ---- gates
// --------------------------------------------------------------------------------------------------------------

bool Interpolator::in_position(const nc_inputs& in, double width_of_block) const {
  if (!filter_.settled(wanted_)) return false;
  if (!in.actual_valid) return true;
  if ((border_.lost_axes() & ~spindles_now()) != 0) return false;
  for (unsigned i = 0; i < config_.axis_count; ++i) {
    const double width = width_of_block > 0 ? width_of_block : config_.limits[i].in_position;
    if ((spindles_now() >> i & 1) != 0) continue;  // the axis is a spindle now
    if (width > 0 && std::fabs(in.actual.v[i] - wanted_[i] - turned_[i] - added_by_tap(i)) > width) return false;
  }
  return true;
}

Interpolator::Done Interpolator::dwell(double rate, double amount) {
  if (!gate_begun_) {
    gate_begun_ = true;
    gate_left_ = amount;
  }
  if (gate_left_ > rate * time_) {
    gate_left_ -= rate * time_;
    return wait(NC_CAUSE_DWELL);
  }
  if (gate_left_ > 0) time_ -= gate_left_ / rate;  // the rest of the cycle is for the next record
  gate_begun_ = false;
  return Done::yes;
}

/// A dwell in revolutions does not end while the spindle stands.
Interpolator::Done Interpolator::dwell_turns(double turns, const nc_inputs& in) {
  const Done done = dwell(std::fabs(encoder(in).rev_per_s), turns);
  if (done == Done::no && encoder(in).unmeasured) cause_ = NC_CAUSE_SPINDLE_UNMEASURED;
  return done;
}

/// M700 9.1: when the optional stop switch is on as M01 is reached, M01 is given out with strobe and completion like any M code, and then the program
/// stops.
Interpolator::Done Interpolator::optional_stop(const nc_inputs& in) {
  if (!gate_begun_) {
    if (!in.optional_stop) return Done::yes;
    Action m01;
    m01.value = 1;
    m01.program_flow = true;
    if (strobe(m01, in) != Done::yes) return Done::no;
    gate_begun_ = true;
  }
  if (fin_wait() != 0 && !(suppress_ & NC_SUPPRESS_FIN)) return wait(NC_CAUSE_FIN);
  gate_begun_ = false;
  state_ = NC_STATE_STOPPED;
  cause_ = NC_CAUSE_PROGRAM_STOP;
  return Done::yes;
}

Interpolator::Done Interpolator::gate(const Gate& g, const nc_inputs& in) {
  switch (g.kind) {
    case NC_GATE_FIN:
      return fin_wait() != 0 && !(suppress_ & NC_SUPPRESS_FIN) ? wait(NC_CAUSE_FIN) : Done::yes;
    case NC_GATE_DWELL_SECONDS:
    case NC_GATE_DWELL_TURNS:
      if ((in.skip & g.skip_mask) != 0) {  // M700 15.3 (2): the rest of the dwell is cancelled
        gate_begun_ = false;
        return Done::yes;
      }
      return g.kind == NC_GATE_DWELL_SECONDS ? dwell(1.0, g.value) : dwell_turns(g.value, in);
    case NC_GATE_IN_POSITION:
      return in_position(in, g.value) ? Done::yes : wait(NC_CAUSE_IN_POSITION);
    case NC_GATE_OPTIONAL_STOP:
      return optional_stop(in);
    case NC_GATE_STOP:
      state_ = NC_STATE_STOPPED;
      cause_ = g.behind_mdi ? NC_CAUSE_MDI_ENDED : g.begins_again ? NC_CAUSE_RESTART : NC_CAUSE_PROGRAM_STOP;
      if (g.behind_mdi) in_mdi_ = false;
      if (g.begins_again) stand_at_restart();
      return Done::yes;
  }
  return Done::yes;
}

Interpolator::Done Interpolator::sync(const Record& r, const nc_inputs& in) {
  if (!in_position(in)) return wait(NC_CAUSE_IN_POSITION);
  if (stale_ != 0) settle_axes(), elsewhere_ = false;  // nothing is committed beyond a sync, and its answer tells the interpreter where the axes are
  recalculate_ = false;
  ScanWorld w;
  w.serial = r.serial;
  for (unsigned i = 0; i < kMaxAxes; ++i) {
    w.world.machine.v[i] = wanted_[i];
    w.world.skip_machine.v[i] = skip_position_[i];
  }
  for (unsigned i = 0; i < NC_WORDS; ++i) w.world.input[i] = in.input[i];
  w.world.skipped = skipped_;
  for (unsigned i = 0; i < 2; ++i) w.world.tool_angle[i] = in.tool_angle[i];
  w.world.clock_ms = in.clock_ms;
  w.world.power_on_ms = static_cast<double>(power_cycles_) * config_.cycle_s * 1e3;
  w.world.run_ms = static_cast<double>(run_cycles_) * config_.cycle_s * 1e3;
  shared_->world.write(w);
  return Done::yes;
}

/// The end of a block, or a place inside a cycle where single block may stop.
void Interpolator::mark(const Mark& m, const nc_inputs& in) {
  modal_ = m.modal;
  block_ends_with(m);
  if (m.report) {
    if (!m.aside) ++blocks_;
    interrupt_rest_.block_ended();
  }
  block_begun_ = !m.resume;  // a block that stops at one of its places has begun, even when nothing moved yet
  const bool thread = block_has_thread_;
  if (m.report) block_has_thread_ = false;
  if (m.report && m.resume && m.stop && !m.beside && !thread && interrupt_wanted_ && at_rest() && state_ == NC_STATE_RUNNING) {
    // The records behind this block are given up, and the feeder goes on with the interrupt program. Where blocks cannot be read again from the end of
    // this one, the interrupt waits for the next.
    interrupt_wanted_ = false;
    cut_.inside = false;
    if (stale_ != 0) settle_axes();
    rereading_ = reread_reached_ = reread_interrupt_ = true;
    return;
  }
  // Blocks that are read again begin at the end of this one. Where the axes stand beside it, the next block end serves, which the plan comes to exactly. A changed
  // length leads away from this end anyway, by a line.
  if (m.resume && at_rest() && ((recalculate_ && !beside_path_end()) || length_waits() || (stale_ != 0 && may_read_again()))) {
    settle_axes();
    recalculate_ = false;
    rereading_ = reread_reached_ = true;
    reread_interrupt_ = false;
  }
  if (thread || !stops_at(m, in)) return;
  if (hold_behind_thread_) {
    hold_behind_thread_ = false;
    stop_held();
  } else {
    state_ = NC_STATE_STOPPED;
    cause_ = NC_CAUSE_SINGLE_BLOCK;
  }
}

/// But behind a thread.
bool Interpolator::stops_at(const Mark& m, const nc_inputs& in) const {
  return m.stop && at_rest() && state_ == NC_STATE_RUNNING && (hold_behind_thread_ || (in.single_block && !(suppress_ & NC_SUPPRESS_SINGLE_BLOCK)));
}

}  // namespace nc
