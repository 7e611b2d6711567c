// SPDX-License-Identifier: Apache-2.0
// The second watch of an axis whose position is held here: the way of the speeds that its drive was given against the way that is measured. With an encoder that stands the distance of the axis
// from its set-points grows no faster than these go, and the loop turns the motor faster and faster meanwhile: at a slow feed it has gone many times the limit when the distance comes to that.
//
// What is given and what is measured is remembered for a while: d' = speed given - speed measured - d / T, and a' = |speed given| - a / T, with T = kMemory / gain. The axis is lost when a is more
// than kWay limits and |d| more than the share kShare of a: of what was given next to nothing has been measured. Why no sound axis comes there:
//   The speed given is that of the set-points and gain * e, with the distance e of the axis. So d is what T remembers of the change of e and of gain * e: at most (2 + kMemory) E
//   while no distance is beyond E. Lost means |d| > kShare * kWay limits: an axis whose distance stays within kShare * kWay / (2 + kMemory) = 3/16 of its limit is never lost, whatever its drive makes
//   of the speed and whatever its set-points do.
//   Beyond that the drive must make less than a quarter of what it is given, for times as long as T. A drive with a wrong scale makes more of it. One that is late makes the whole of it, later:
//   d is then the change of the distance, at most two limits where it reverses, and that is less than kShare * kWay = 2.25 limits.
// Where the encoder stands and the set-points go on, |d| is a, and the motor turns until that is kWay limits: at a fast feed by those, and at a slow one by gain * limit^2 / (22 * speed) in addition,
// because what is given is forgotten in T: the distance is kWay / kMemory limits then.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace nc::hal::canopen {

class WayWatch {
 public:
  WayWatch() = default;
  // `gain`: 1/s; `limit`: of the distance, increments; `delay`: SYNCs from the one in which a speed is given to the one that knows the place to which it has led.
  WayWatch(double gain, double sync_s, double limit, double delay)
      : forgets_(std::min(1.0, gain * sync_s / kMemory)), most_(kWay * limit), back_(static_cast<unsigned>(std::clamp(std::lround(delay), 1L, static_cast<long>(kGiven)))) {}

  // The axis is not led by its speed: nothing is remembered.
  void rest(std::int64_t position) noexcept {
    std::fill(given_, given_ + kGiven, 0.0);
    difference_ = given_at_all_ = 0;
    position_ = position;
  }
  // Once per SYNC, in front of give(). `position` in increments; as before where none has come. True: the axis is lost.
  bool step(std::int64_t position) noexcept {
    const double given = given_[back_ - 1];
    difference_ += given - static_cast<double>(position - position_) - forgets_ * difference_;
    given_at_all_ += std::abs(given) - forgets_ * given_at_all_;
    position_ = position;
    return given_at_all_ > most_ && std::abs(difference_) > kShare * given_at_all_;
  }
  // The way in increments that the speed given in this SYNC makes until the next one.
  void give(double way) noexcept {
    std::copy_backward(given_, given_ + kGiven - 1, given_ + kGiven);
    given_[0] = way;
  }

 private:
  static constexpr double kMemory = 10, kWay = 3, kShare = 0.75;
  static constexpr unsigned kGiven = 9;

  double forgets_ = 1, most_ = HUGE_VAL;  // share that is forgotten in a SYNC; increments
  unsigned back_ = 1;
  double given_[kGiven] = {};             // of the last SYNCs, the newest first
  double difference_ = 0, given_at_all_ = 0;  // d and a, increments
  std::int64_t position_ = 0;
};

}  // namespace nc::hal::canopen
