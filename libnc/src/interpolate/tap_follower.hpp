// SPDX-License-Identifier: Apache-2.0
// The axis of a synchronous tap follows the angle that its spindle really has (M700 13.1.1). The path commands both, the place of the axis and the angle
// of the spindle. The encoder shows by how much the spindle is behind (or before) what it was commanded; the axis is commanded that much of the lead behind
// its path. So a spindle that lags as it accelerates, or runs on at the bottom, takes the axis along. A drive that does what it is told changes nothing.
//
// What the encoder shows is compared with the command at which the axis stood when it was read: with that of the cycle before, or behind a bus with an
// older one (nc_inputs::spindle_age_s). For let the axis be led to p(t) + d(t), with the path p and the difference d, and reach it a dead time D later. At the
// time t of a measurement it stands at p(t - D) + d(t - D), and with turns n(t) and lead h the thread asks for h n(t). With d(t) = h n(t) - p(t - D), which is
// what this compares, the two are apart by d(t) - d(t - D): what the lag of the spindle changes in the dead time, and nothing while it turns at one speed.
//
// A spindle that fails must not take the axis along without end. Where it is more turns away from its command than its acceleration explains, and where
// its encoder jumps, there is trouble(), which is an alarm. From then on the axis follows a spindle that runs out no farther than it can, and a jump not
// at all. In no case does it leave the limits of its stroke.
#pragma once

#include <algorithm>
#include <cmath>

#include "nc/types.h"

namespace nc {

class TapFollower {
 public:
  struct Limits {
    double velocity = 0, acceleration = 0, jerk = 0;  ///< of the axis, mm/s, mm/s^2, mm/s^3; 0 = none
    double cycle_s = 0.001;
    double before = 0;                        ///< place of the axis in the cycle before, mm
    double low = -HUGE_VAL, high = HUGE_VAL;  ///< of its stroke, mm
    double most_apart = 2;                    ///< revolutions that the spindle may be away from its command
  };
  enum class Trouble : uint8_t { none, apart, jumped };

  /// The spindle is taken over where it stands, at `turns` revolutions of its encoder and `commanded` ones of the tap.
  void begin(double turns, double commanded) NC_RT {
    if (!active_) beside_ = 0;
    began_ = turns - commanded;
    aim_ = beside_;
    fresh_ = !active_;
    active_ = true;
    count_ = 0;  // older commands than this one are the same: the spindle stands
    remember(commanded);
    age_s_ = 0;
    ends_ = stands_ = fades_ = rests_ = false;
    earlier_[0] = earlier_[1] = beside_;
    turns_ = turns;
    seen_ = true;
    apart_ = fastest_ = 0;
    trouble_ = Trouble::none;
  }
  /// The same while both turn: from here on the axis, which was commanded to `place` with `speed`, goes by what the encoder shows.
  void begin_moving(double turns, double commanded, double place, double speed, double per_mm) NC_RT {
    begin(turns, commanded);
    fresh_ = false;
    last_ = place;
    speed_ = speed;
    fastest_ = std::fabs(speed * per_mm);
  }
  /// The axis has been put where it is: it is on its path.
  void drop() NC_RT { active_ = false; }
  /// The spindle is let go. The axis comes back to its path.
  void end() NC_RT { ends_ = true; }
  /// The same while the path rests and its caller waits until active() is over: it may then use more of what the axis can.
  void end_at_rest() NC_RT { ends_ = rests_ = true; }
  bool ended() const NC_RT { return ends_; }
  bool waited_for() const NC_RT { return active_ && rests_; }
  /// The axis is on its path, but for the resolution of an encoder, and stays so while what is left fades beside other moves.
  bool on_path() const NC_RT { return !active_ || (std::fabs(beside_) <= kArrived && settled() && unfelt() && carried_away() <= kArrived); }
  bool active() const NC_RT { return active_; }
  /// on_path(), or the spindle stands near its command and comes no nearer.
  bool arrived() const NC_RT { return on_path() || (stands_ && settled() && trouble_ == Trouble::none && std::fabs(apart_) <= kStands); }
  /// Why the spindle cannot be followed any more; until begin().
  Trouble trouble() const NC_RT { return active_ ? trouble_ : Trouble::none; }
  /// The spindle does not come to the place where it is let go.
  void say_apart() NC_RT { trouble_ = Trouble::apart; }
  /// Axis and spindle have come to rest beside the path, or where the spindle could not be followed any more. What a spindle that counts as standing may turn is no such place:
  /// to take both there gives the spindle another command, behind which it turns as little again, and so on without end.
  bool rests_beside() const NC_RT { return active_ && stands_ && speed_ == 0 && (std::fabs(beside_) > kTaken || trouble_ != Trouble::none); }
  /// Both rest, but for rounding.
  bool rests() const NC_RT { return active_ && stands_ && std::fabs(speed_) <= kRests; }

  /**
   * One cycle.
   * @param turns of the encoder, if it was `measured`: at the beginning of the cycle with an axis that has no dead time
   * @param age_s their age as nc_inputs::spindle_age_s has it, 0..NC_SPINDLE_AGE_MAX
   * @param commanded revolutions that the spindle is commanded for the end of the cycle, since begin()
   * @param per_mm revolutions per mm of the axis
   * @param place of the axis that the path commands
   * @return what is added to that place, mm
   */
  double step(bool measured, double turns, double age_s, double commanded, double per_mm, double place, const Limits& limits) NC_RT {
    const double time = limits.cycle_s;
    cycle_s_ = time;
    acceleration_ = limits.acceleration;
    jerk_ = limits.jerk;
    if (ends_ && (fades_ || rests_ || (std::fabs(beside_) <= kFaded && settled()))) return fade(place, limits);
    const bool follows = measured && !ends_ && per_mm != 0;
    // A bus may bring one measurement in several cycles, which is then older each time. Only a new one says whether the spindle turns.
    const double since_s = time + age_s_ - age_s;
    const bool newer = measured && (!seen_ || since_s > kOfCycle * time);
    const double aim = follows ? aim_at(turns, age_s, newer ? since_s : time, per_mm, limits) : 0;
    fastest_ = std::max(fastest_, std::fabs(commanded - newest_command()) / time);
    remember(commanded);
    if (!measured) stands_ = true;
    else if (newer) stands_ = std::fabs(turns - turns_) <= kStill;
    if (measured) turns_ = turns;
    age_s_ = measured ? age_s : 0;
    seen_ = measured;
    if (fresh_) {  // it stands; where what an earlier tap has left still fades, place and speed are known
      last_ = limits.before;
      speed_ = 0;
      fresh_ = false;
    }
    const double of_path = (place - last_ + beside_) / time, change = limits.acceleration * time;
    const double behind = follows ? aim_ - beside_ : aim - beside_;  // what earlier cycles have left to be made good
    double back = behind / time;
    if (limits.acceleration > 0) {  // in such a way that it can end
      const double most = std::sqrt(2 * kOfAcceleration * limits.acceleration * std::fabs(behind));
      back = std::clamp(back, -most, most);
    }
    double speed = of_path + back + (follows ? (aim - aim_) / time : 0);
    aim_ = aim;
    if (limits.velocity > 0) speed = std::clamp(speed, std::min(of_path, -limits.velocity), std::max(of_path, limits.velocity));
    if (limits.acceleration > 0) speed = std::clamp(speed, speed_ - change, speed_ + change);
    const double inside = within_stroke(speed, of_path, limits);
    if (follows && inside != speed && std::fabs(aim_ - beside_) * std::fabs(per_mm) > kBeside) trouble_ = Trouble::apart;
    speed = inside;
    last_ += speed * time;
    speed_ = speed;
    earlier_[1] = earlier_[0];
    earlier_[0] = beside_;
    beside_ = last_ - place;
    return beside_;
  }
  /// How far the axis is beside its path.
  double beside() const NC_RT { return active_ ? beside_ : 0; }

 private:
  /// How the axis moves beside its path. A difference of places is the speed of half a cycle ago.
  double own_acceleration() const NC_RT { return (beside_ - 2 * earlier_[0] + earlier_[1]) / (cycle_s_ * cycle_s_); }
  double own_speed() const NC_RT { return (beside_ - earlier_[0]) / cycle_s_ + 0.5 * own_acceleration() * cycle_s_; }
  /// The axis has no speed and no acceleration of its own to speak of.
  bool settled() const NC_RT { return std::fabs((beside_ - earlier_[0]) / cycle_s_) <= kSlow && std::fabs(own_acceleration()) <= kSteady; }
  /// Its acceleration is too little to be felt beside moves that use all that the axis can.
  bool unfelt() const NC_RT { return acceleration_ <= 0 || std::fabs(own_acceleration()) <= kUnfelt * acceleration_; }
  /// The farthest that the speed and the acceleration with which an unfelt fade begins carry the axis, mm: their parts of the polynomial are at most 0.19 v T and
  /// 0.018 a T^2.
  double carried_away() const NC_RT {
    const double time = fade_time(kUnfelt, beside_, own_speed(), own_acceleration());
    return time * (0.19 * std::fabs(own_speed()) + 0.018 * time * std::fabs(own_acceleration()));
  }
  /// The spindle is let go: what the axis is beside its path fades as a polynomial of degree 5 that begins with its speed and acceleration and ends with
  /// none. It lasts as long as it takes until what it adds to the acceleration and the jerk of the path is not felt, or, while the path rests, is within the
  /// limits of the axis.
  double fade(double place, const Limits& limits) NC_RT {
    const double time = limits.cycle_s;
    if (!fades_) begin_fade(limits);
    faded_ += time;
    if (faded_ > fade_s_ - 0.5 * time) {
      active_ = fades_ = false;
      return beside_ = 0;
    }
    const double before = last_;
    const double t = faded_ / fade_s_, b = from_[0], v = from_[1] * fade_s_, a = from_[2] * fade_s_ * fade_s_;
    const double c3 = -10 * b - 6 * v - 1.5 * a, c4 = 15 * b + 8 * v + 1.5 * a, c5 = -6 * b - 3 * v - 0.5 * a;
    const double x = b + t * (v + t * (0.5 * a + t * (c3 + t * (c4 + t * c5))));
    last_ = std::clamp(place + x, limits.low, limits.high);
    speed_ = (last_ - before) / time;
    return beside_ = last_ - place;
  }

  void begin_fade(const Limits& limits) NC_RT {
    fades_ = true;
    faded_ = 0;
    from_[0] = beside_;
    from_[1] = own_speed();
    from_[2] = own_acceleration();
    fade_s_ = std::ceil(fade_time(rests_ ? kAtRest : kUnfelt, from_[0], from_[1], from_[2]) / limits.cycle_s - 1e-9) * limits.cycle_s;
  }

  /// How long it takes to fade from a place b, a speed v and an acceleration a with this share of the limits for each of the three parts of the polynomial. The greatest
  /// acceleration and jerk of them are 6 b / T^2 and 60 b / T^3, 6 v / T and 36 v / T^2, and 9 a / T, all of them at its ends or below.
  double fade_time(double share, double b, double v, double a) const NC_RT {
    double time = 10 * cycle_s_;
    if (acceleration_ > 0) time = std::max({time, std::sqrt(6 * std::fabs(b) / (share * acceleration_)), 6 * std::fabs(v) / (share * acceleration_)});
    if (jerk_ > 0) time = std::max({time, std::cbrt(60 * std::fabs(b) / (share * jerk_)), std::sqrt(36 * std::fabs(v) / (share * jerk_)), 9 * std::fabs(a) / (share * jerk_)});
    return time;
  }

  /// How far the axis has to be beside its path, mm: by what the spindle is beside its command.
  double aim_at(double turns, double age_s, double since_s, double per_mm, const Limits& limits) NC_RT {
    if (!std::isfinite(turns) || (seen_ && std::fabs(turns - turns_) > kJump + kFaster * fastest_ * since_s)) trouble_ = Trouble::jumped;
    if (trouble_ == Trouble::jumped) return aim_;
    apart_ = turns - began_ - command_before(age_s / limits.cycle_s);
    if (std::fabs(apart_) > limits.most_apart) trouble_ = Trouble::apart;
    const double farthest = limits.most_apart + kRunOut_s * fastest_;
    return std::clamp(apart_, -farthest, farthest) / per_mm;
  }
  void remember(double commanded) NC_RT {
    newest_ = (newest_ + 1) % kCommands;
    command_[newest_] = commanded;
    count_ = std::min(count_ + 1, kCommands);
  }
  double newest_command() const NC_RT { return command_[newest_]; }
  /// What was commanded so many cycles before the newest command, between two of them as a part of both.
  double command_before(double cycles) const NC_RT {
    const double back = std::clamp(cycles, 0.0, count_ - 1.0);
    const auto whole = static_cast<unsigned>(back);
    const auto at = [this](unsigned n) { return command_[(newest_ + kCommands - std::min(n, count_ - 1)) % kCommands]; };
    return at(whole) + (at(whole + 1) - at(whole)) * (back - whole);
  }
  /// The speed with which the axis can still stop in front of the end of its stroke. Where it is on its path it goes as its path does.
  double within_stroke(double speed, double of_path, const Limits& limits) const NC_RT {
    const double own = std::fabs(beside_) <= kArrived ? std::fabs(of_path) : 0, a = kOfStroke * limits.acceleration, b = 0.5 * a * limits.cycle_s;
    const auto most = [&](double room) {
      if (!(room > 0)) return 0.0;
      const double reached = room / limits.cycle_s;
      return a > 0 ? std::min(std::max(std::sqrt(2 * a * room + b * b) - b, own), reached) : reached;
    };
    return std::clamp(speed, -most(last_ - limits.low), most(limits.high - last_));
  }

  static constexpr double kArrived = 1e-3;        ///< mm
  static constexpr double kRests = 1e-6;          ///< mm/s
  static constexpr double kStill = 1e-6;          ///< revolutions in one cycle
  static constexpr double kTaken = 1e-5;          ///< mm: more than that of any lead
  static constexpr double kUnfelt = 3e-4;         ///< share of the limits of the axis that is not felt ...
  static constexpr double kAtRest = 0.25;         ///< ... and that it may have of them alone; each of three parts has so much
  static constexpr double kFaded = 0.05, kSlow = 0.1, kSteady = 3;  ///< mm, mm/s, mm/s^2: what may fade
  static constexpr double kOfAcceleration = 0.5;  ///< share of the axis' acceleration with which it comes back
  static constexpr double kOfStroke = 0.85;       ///< and with which it stops in front of the end of its stroke; its last cycle may take an eighth more
  // Revolutions: by which a spindle that stands may be beside its command as it is let go, outside of the hole; which the axis may miss because its
  // stroke ends.
  static constexpr double kStands = 0.02, kBeside = 0.25;
  static constexpr double kRunOut_s = 1;  ///< seconds of the highest speed commanded: so far the axis goes along with a spindle that runs out
  // No spindle turns more than this from one measurement to the next: revolutions, and times the highest speed commanded.
  static constexpr double kJump = 0.1, kFaster = 2;

  static constexpr unsigned kCommands = 512;  ///< cycles that are remembered: more than NC_SPINDLE_AGE_MAX of cycles of 0.12 ms
  static constexpr double kOfCycle = 0.5;     ///< measurements that lie nearer together than this share of a cycle are one
  bool active_ = false, fresh_ = false, ends_ = false, stands_ = false;
  bool seen_ = false;  ///< turns_ is of the cycle before
  double turns_ = 0, age_s_ = 0, began_ = 0;
  double command_[kCommands] = {};  ///< the last commands, revolutions since begin(), around newest_
  unsigned newest_ = 0, count_ = 0;
  double aim_ = 0, beside_ = 0, last_ = 0, speed_ = 0;
  double earlier_[2] = {};  ///< beside_ of the two cycles before
  double cycle_s_ = 0.001, acceleration_ = 0, jerk_ = 0;  ///< of the last cycle's Limits
  bool fades_ = false, rests_ = false;
  double from_[3] = {}, faded_ = 0, fade_s_ = 0;  ///< what it fades from with its first two derivatives, since when and for how long, s
  double apart_ = 0;    ///< revolutions that the spindle is before its command
  double fastest_ = 0;  ///< that was commanded since begin(), rev/s
  Trouble trouble_ = Trouble::none;
};

}  // namespace nc
