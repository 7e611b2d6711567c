// SPDX-License-Identifier: Apache-2.0
// See homing.hpp.
#include "runtime/axes/homing.hpp"

#include <cmath>

namespace nc::rt {
namespace {

constexpr double kAtSpeed = 1.001;  // multiple of the creep speed up to which an axis counts as slow, because the end of a ramp is rounded

}  // namespace

// Without a default, so that a fault that is new is not forgotten here: the compiler asks for it.
const char* homing_fault_text(HomingFault fault) {
  switch (fault) {
    case HomingFault::kNone: break;
    case HomingFault::kNoDog: return "its switch was not found";
    case HomingFault::kDogStays: return "its switch stays on";
    case HomingFault::kDogShort: return "the dog was left before the axis had come down to the creep speed";
    case HomingFault::kNoIndex: return "no index pulse was found";
    case HomingFault::kTimeout: return "it takes too long";
    case HomingFault::kUnreadable: return "its switch cannot be read";
  }
  return "";
}

void AxisHoming::begin(const HomingConfig& config, const Seen& seen) noexcept {
  config_ = config;
  time_s_ = 0;
  mark_ = seen.actual;
  switch (config.kind) {
    case HomingKind::kSwitch:
    case HomingKind::kLimit: return enter(seen.dog ? Phase::kAway : Phase::kSeek, seen);
    case HomingKind::kDrive: return enter(seen.done ? Phase::kDriveForgets : Phase::kDrive, seen);
    case HomingKind::kHere: return enter(Phase::kRest, seen);
    case HomingKind::kAbsolute:
    case HomingKind::kNone: return enter(Phase::kReturn, seen);
  }
}

void AxisHoming::enter(Phase phase, const Seen& seen) noexcept {
  phase_ = phase;
  from_ = seen.actual;
  was_on_ = false;
  crept_ = false;
}

AxisHoming::Wish AxisHoming::fail(HomingFault fault) noexcept {
  phase_ = Phase::kIdle;
  Wish wish;
  wish.manual.kind = NC_MANUAL_JOG;
  wish.fault = fault;
  return wish;
}

AxisHoming::Wish AxisHoming::go(int direction, double speed) const noexcept {
  Wish wish;
  wish.manual = {NC_MANUAL_JOG, direction * speed, 0};
  return wish;
}

AxisHoming::Wish AxisHoming::rest_then(Phase next, const Seen& seen) noexcept {
  if (seen.velocity == 0 && time_s_ > 2 * seen.cycle_s) enter(next, seen);
  return go(1, 0);
}

bool AxisHoming::beyond(double travel, const Seen& seen) const noexcept { return std::abs(seen.actual - from_) > travel; }

AxisHoming::Wish AxisHoming::found(const Seen& seen) noexcept {
  mark_ = seen.actual;
  index_before_ = true;  // a pulse that is on already is none that comes
  const bool index = config_.index.present();
  enter(index ? Phase::kIndex : Phase::kRest, seen);
  return index ? go(way_, config_.creep) : go(1, 0);
}

AxisHoming::Wish AxisHoming::seek(const Seen& seen) noexcept {
  if (seen.dog) {
    enter(config_.leaves ? Phase::kLeave : Phase::kSeekRest, seen);
    return config_.leaves ? go(config_.direction, config_.creep) : go(1, 0);
  }
  return beyond(config_.travel, seen) ? fail(HomingFault::kNoDog) : go(config_.direction, config_.fast);
}

// Back over the edge. A dog that is shorter than the braking distance was passed: then it comes on first, and goes off behind that.
AxisHoming::Wish AxisHoming::back(const Seen& seen) noexcept {
  was_on_ |= seen.dog;
  const bool limit = config_.kind == HomingKind::kLimit;
  if (was_on_ && !seen.dog) {
    way_ = -config_.direction;
    if (limit) return found(seen);
    enter(Phase::kBackRest, seen);
    return go(1, 0);
  }
  if (beyond(config_.travel, seen)) return fail(was_on_ ? HomingFault::kDogStays : HomingFault::kNoDog);
  return go(-config_.direction, limit ? config_.creep : config_.fast);
}

AxisHoming::Wish AxisHoming::leave(const Seen& seen) noexcept {
  const bool slow = std::abs(seen.velocity) <= config_.creep * kAtSpeed;
  if (!seen.dog) {
    if (!crept_) return fail(HomingFault::kDogShort);
    way_ = config_.direction;
    return found(seen);
  }
  crept_ |= slow;
  return beyond(config_.travel, seen) ? fail(HomingFault::kDogStays) : go(config_.direction, config_.creep);
}

AxisHoming::Wish AxisHoming::look_for_index(const Seen& seen) noexcept {
  const bool rises = seen.index && !index_before_;
  index_before_ = seen.index;
  if (rises) {
    mark_ = seen.actual;
    enter(Phase::kRest, seen);
    return go(1, 0);
  }
  return beyond(config_.index_travel, seen) ? fail(HomingFault::kNoIndex) : go(way_, config_.creep);
}

AxisHoming::Wish AxisHoming::step(const Seen& seen) noexcept {
  if (phase_ == Phase::kIdle) return {};
  if (phase_ != Phase::kSet) time_s_ += seen.cycle_s;  // there it may have to wait for other axes
  if (time_s_ > config_.timeout_s) return fail(HomingFault::kTimeout);
  if (!seen.readable) return fail(HomingFault::kUnreadable);
  Wish wish;
  switch (phase_) {
    case Phase::kIdle: break;
    case Phase::kAway:
      if (!seen.dog) enter(Phase::kAwayRest, seen);
      else if (beyond(config_.travel, seen)) return fail(HomingFault::kDogStays);
      return go(-config_.direction, seen.dog ? config_.fast : 0);
    case Phase::kAwayRest: return rest_then(Phase::kSeek, seen);
    case Phase::kSeek: return seek(seen);
    case Phase::kSeekRest: return rest_then(Phase::kBack, seen);
    case Phase::kBack: return back(seen);
    case Phase::kBackRest: return rest_then(Phase::kCreep, seen);
    case Phase::kCreep:
      way_ = config_.direction;
      if (seen.dog) return found(seen);
      return beyond(config_.travel, seen) ? fail(HomingFault::kNoDog) : go(config_.direction, config_.creep);
    case Phase::kLeave: return leave(seen);
    case Phase::kIndex: return look_for_index(seen);
    case Phase::kRest: return rest_then(Phase::kSet, seen);
    case Phase::kSet:
      wish.set = seen.all_stand;
      wish.mark = mark_;
      return wish;
    case Phase::kReturn:
      wish.manual.kind = NC_MANUAL_REFERENCE;
      wish.done = seen.at_reference && seen.velocity == 0;
      if (wish.done) phase_ = Phase::kIdle;
      return wish;
    case Phase::kDriveForgets:  // what it said of the homing before
      wish.request = true;
      if (!seen.done) enter(Phase::kDrive, seen);
      return wish;
    case Phase::kDrive:
      wish.request = !seen.done;
      wish.done = seen.done;
      if (wish.done) phase_ = Phase::kIdle;
      return wish;
  }
  return wish;
}

}  // namespace nc::rt
