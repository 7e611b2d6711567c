// SPDX-License-Identifier: Apache-2.0
// Moves in the optimal mode: the scan goes along the chain of cells of the plan, and counts off the records that it passes.
#include <algorithm>
#include <cmath>

#include "interpolate/interpolator.hpp"

namespace nc {
namespace {

constexpr double kJump = 1e-6;        ///< mm or deg: axes that are no farther away stand where the path goes on
constexpr double kAtEnd = 1e-7;       ///< mm: a path that rests no farther before the end of a record has reached it ...
constexpr double kRounding = 1e-13;   ///< ... plus this share of the path length: the rounding of adding up some hundred cells
constexpr double kPassed = 1e-9;      ///< mm: a moving path that is farther than this behind the end of a record has passed it
constexpr double kHit = 1e-6;         ///< mm or deg: how near to an exact stop the axes have to be in some cycle
constexpr double kPatience = 0.03;     ///< s: how long the planner may take for a stop before the scan brakes itself
constexpr double kWayToRest = 1.5;     ///< times a stop on a line: what such a way to rest may take at first ...
constexpr double kLongerWay_s = 0.1;   ///< ... and once more as long behind so many s, because a plan that uses its limits in full leaves a long way only
constexpr double kTurnsChange = 0.002; ///< share by which the speed of the spindle has to change before another plan is made
constexpr double kPlannedTurns = 0.02; ///< share by which it may differ from the speed of the plan when a thread begins

/// The place from which on a path at rest counts as having come to u.
double nearly(double u) { return u - kAtEnd - kRounding * std::fabs(u); }

}  // namespace

void Interpolator::take_plan() {
  if (optimal_ == nullptr) {
    plan_ = &planner_->newest();
    end_ = plan_->end;
    return;
  }
  const optimal::Proposal& offer = optimal_->newest();
  end_ = offer.end;
  follower_.look(offer);
  no_law_ = offer.failed && offer.generation == follower_.generation();
}

/// The axes would jump when the path goes on at `place`, because they do not stand there.
bool Interpolator::would_jump(const AxisVec& place) const {
  for (unsigned i = 0; i < config_.axis_count; ++i)
    if (std::fabs(place[i] - wanted_[i]) > kJump) return true;
  return false;
}

/// A path at rest has come to the end of the record in front, at `place`. Where the plan rests a little before a place where the path itself rests, it has done so only if no axis
/// shows it: along a line that is short for the turn of a rotary axis, nanometres are many of its degrees, and they would be gone when the path goes on. Elsewhere the path goes on
/// from where it is, be it at the end of a block, which a rounded corner passes at some distance.
bool Interpolator::rests_at(const AxisVec& place) const {
  const double end = optimal_->store().passed[tail_ & mask_];
  return follower_.u() >= end || (follower_.u() >= nearly(end) && !(follower_.before_path_end() && would_jump(place)));
}

/// Why a move does not go on, when there is nothing to follow.
nc_stop_cause Interpolator::standing(const Segment& s, const nc_inputs& in) {
  if (s.rapid && !(in.rapid_override > 0)) return NC_CAUSE_OVERRIDE_ZERO;
  if (dry_feed(s) == 0) return dry_stop(in);
  if (s.rapid || dry_feed(s) > 0) return NC_CAUSE_STARVED;
  if (s.feed_mm_rev > 0 && encoder(in).rev_per_s == 0) return no_spindle(in);
  if (!(s.feed_mm_rev > 0) && !(programmed_feed(s) > 0)) return NC_CAUSE_FEED_ZERO;  // M700 7.3: operation alarm 104
  return s.fixed_override || feed_override(in) > 0 ? NC_CAUSE_STARVED : NC_CAUSE_OVERRIDE_ZERO;
}

/// The path has to come to rest as soon as the limits allow.
bool Interpolator::path_stops(const nc_inputs& in) const {
  const Segment* s = moving_ ? &current().segment : nullptr;  // M700 15.2: a skip move goes at 100 %, unless the override is 0
  if (s != nullptr && s->thread && !follower_.at_rest()) return dry_.on() && thread_braking();  // one with its spindle is stopped by follow_spindle()
  return braking() || skip_braking_ || (s != nullptr && s->skip && !(feed_override(in) > 0));
}

Interpolator::Done Interpolator::follow_plan(const Record& r, const nc_inputs& in) {
  const Segment& s = r.segment;
  if (follower_.at_rest() && !passing_) {
    if (skip_braking_) {
      end_move(r, in);
      return Done::yes;
    }
    if (braking() || (s.skip && !(feed_override(in) > 0))) {  // M700 15.2: a skip move goes at 100 %, unless the override is 0
      return wait(braking() ? cause_ : NC_CAUSE_OVERRIDE_ZERO);
    }
    // The path may rest at the end of several records, and a hold may have come before all of them were counted off.
    if (follower_.rests_behind(tail_) && rests_at(s.curve.end)) return passed(r, in);
    if (follower_.idle()) {
      return wait(no_law_ ? NC_CAUSE_NO_LAW : standing(s, in));
    }
    if (time_ > 0 && would_jump(follower_.start())) return fault(r);
    if (s.thread && time_ > 0 && !begin_thread(s, in)) return Done::no;
  }
  silent_ = path_stops(in) && !follower_.at_rest() && !follower_.stops() ? silent_ + time_ : 0;
  if (time_ > 0) {
    if (silent_ > kPatience) follower_.brake({}, kWayToRest + (silent_ - kPatience) / kLongerWay_s);
    const double from = follower_.u();
    if (goes_by_spindle(s)) {
      follow_spindle(s, in);
    } else {
      time_ = follower_.advance(time_);
    }
    passing_ = follower_.halted();
    path_length_ += follower_.u() - from;
    law_.v = follower_.v();
    wanted_ = follower_.position();
  }
  const double end = optimal_->store().passed[tail_ & mask_], u = follower_.u();
  law_.s = std::clamp(s.curve.length - (end - u), 0.0, s.curve.length);
  passing_ = passing_ && u > end + kPassed;
  // Where a stop happens to end right in front of a place that is no rest of the path, what is left is gone when the path goes on.
  const bool beside = follower_.halted() && !follower_.at_path_end();
  if (follower_.at_rest() ? (beside ? u < end : !rests_at(s.curve.end)) : !(u > end + kPassed)) return Done::no;
  return passed(r, in);
}

/// M700 6.7.1: a thread begins when the spindle is at its start angle, and only with a plan that was made for about the speed that the spindle has.
bool Interpolator::begin_thread(const Segment& s, const nc_inputs& in) {
  const double planned = follower_.planned_turns(), turns = std::fabs(encoder(in).rev_per_s);
  if ((planned < 0) != dry_.on()) {  // the planner has not heard of it yet
    wait(NC_CAUSE_STARVED);
    return false;
  }
  if (dry_.on()) return true;
  if (spindle_reversed(in)) {
    wait(NC_CAUSE_SPINDLE_REVERSED);
    return false;
  }
  if (std::fabs(turns - planned) > kPlannedTurns * planned) {
    wait(turns > 0 ? NC_CAUSE_SPINDLE_ANGLE : no_spindle(in));
    return false;
  }
  if (law_.s > s.begun) {  // an interlock has stopped the thread: it goes on at any angle, so its groove is lost
    if (s.feed_mm_rev * turns > s.speed_limit) {
      wait(NC_CAUSE_SPINDLE_FAST);
      return false;
    }
  } else if (!thread_may_begin(s, in)) {
    return false;
  }
  sync_.begin(spindle_turns(in), planned);
  return true;
}

/// One step along a thread. An interlock, a reset or an alarm stops it along its plan, as fast as the limits of the axes allow.
void Interpolator::follow_spindle(const Segment& s, const nc_inputs& in) {
  if (thread_braking()) follower_.brake(sync_.pace());
  if (follower_.braking()) {
    time_ = follower_.advance(time_);
    return;
  }
  const nc_spindle_inputs& spindle = encoder(in);
  SpindleSync::Sample sample;
  sample.rev_per_s = spindle.rev_per_s;
  sample.turns = spindle_turns(in) + time_ * spindle.rev_per_s;
  sample.u = follower_.u();
  sample.v = follower_.planned_v();
  sample.lead = s.feed_mm_rev;
  const double planned = sync_.advance(time_, sample, SpindleSync::reach_of(s, sync_.planned(), optimal_->axis_limits()));
  const double left = follower_.advance_plan(planned, sync_.sigma());
  time_ = left > 0 && sync_.sigma() > 0 ? std::min(time_, left / sync_.sigma()) : 0;
}

/// If the path goes on within this cycle, no cycle gives out a place within kHit of the exact stop (M700 7.7): neither the cycle before did, nor will
/// this one, in whose rest an axis may go jerk * time^3 / 6.
bool Interpolator::misses(const AxisVec& stop) const {
  double before = 0, behind = 0;
  for (unsigned i = 0; i < config_.axis_count; ++i) {
    before = std::max(before, std::fabs(command_[i] - stop[i]));
    behind = std::max(behind, config_.limits[i].jerk * time_ * time_ * time_ / 6);
  }
  return before > kHit && behind > kHit;
}

/// The path has come to the end of the record of this move.
Interpolator::Done Interpolator::passed(const Record& r, const nc_inputs& in) {
  const Segment& s = r.segment;
  if (follower_.at_path_end() && nearly(follower_.u()) <= optimal_->store().passed[tail_ & mask_] && !would_jump(s.curve.end)) {
    wanted_ = s.curve.end;
    if (s.exact_stop && !s.rapid && time_ > 0 && misses(s.curve.end)) time_ = 0;
  }
  passed_at_ = s.curve.end;
  end_move(r, in);
  return Done::yes;
}

/// Tells the planner everything that the plan depends on.
void Interpolator::tell_planner(const nc_inputs& in, const ScanStatus& status) {
  optimal::Following f;
  follower_.say(&f);
  f.brake = path_stops(in);
  if (!cutting_thread()) feed_scale_ = status.feed_override;
  f.scale.feed = feed_scale_;
  f.scale.rapid = in.rapid_override;
  f.scale.dry = dry_;
  for (unsigned i = 0; i < sizeof digit_pulses_ / sizeof digit_pulses_[0]; ++i) f.scale.pulses[i] = digit_pulses_[i];
  if (moving_ && current().segment.skip_speeds != nullptr && skip_feed_ != current().segment.start_feed_mm_s) f.scale.skip_feed = skip_feed_;
  const double turns = std::fabs(encoder(in).rev_per_s);
  if (!cutting_thread() && (std::fabs(turns - turns_) > kTurnsChange * turns_ || turns == 0)) turns_ = turns;
  f.scale.turns = turns_;
  // In the mode of a tap its spindle stays what it is (M700 10.6.1), so that the plan of its strokes can be made for that.
  f.scale.turning_axis = static_cast<int8_t>((tapping_ & NC_TAPPING_CYCLE) != 0 ? tap_as_axis() : -1);
  f.block_rests = status.single_block;
  f.tail = tail_;
  f.s = moving_ ? law_.s : 0;
  f.machine = aside_.on ? aside_.path : wanted_;
  f.epoch = run_.epoch();
  optimal_->say(f);
}

}  // namespace nc
