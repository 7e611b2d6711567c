// SPDX-License-Identifier: Apache-2.0
// Machine lock: axes are commanded and shown as if they moved, their drives stand, and no change of the lock moves anything.
#include <random>
#include <utility>

#include "support/seeds.hpp"
#include "switch_machine.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::Mode;

class AxisLock : public nc::test::SwitchMachine {};

TEST_F(AxisLock, CountsAndStands) {
  build();
  turn("machine_lock", 1);
  start("G91 G1 X10. Y-4. F1200\nG0 Z3.\nM30\n");
  EXPECT_GE(until([&] {
              for (unsigned a = 0; a < 3; ++a) EXPECT_EQ(drive(a), 0) << a;
              for (unsigned a = 0; a < 3; ++a) EXPECT_EQ(hal->given.system[0].velocity.v[a], 0) << a;
              return out().state == NC_STATE_IDLE && counted(2) == 3;
            }),
            0);
  steps(50);
  EXPECT_NEAR(counted(0), 10, 1e-9);
  EXPECT_NEAR(counted(1), -4, 1e-9);
  EXPECT_NEAR(runtime->snapshot().system[0].actual.v[0], 10, 1e-6) << "what is measured is shown as counted, too";
  EXPECT_EQ(flags().locked, 7u);
  EXPECT_EQ(flags().beside, 7u);
  EXPECT_EQ(alarm(), "");
}

// What was counted is given up by a reset, and nothing moves before that.
TEST_F(AxisLock, NothingJumpsWhenItGoesOff) {
  build();
  turn("machine_lock", 1);
  start("G91 G1 X10. Y-4. F1200\nM30\n");
  until_end();
  turn("machine_lock", 0);
  const auto stands = [&] { return drive(0) == 0 && drive(1) == 0 && drive(2) == 0; };
  for (int n = 0; n < 20; ++n) {
    steps(1);
    ASSERT_TRUE(stands());
  }
  EXPECT_EQ(flags().locked, 0u);
  EXPECT_EQ(flags().beside, 3u);
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kLockLeft);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  EXPECT_EQ(ask(CommandKind::kJog, 0, 10), Answer::kLockLeft);
  EXPECT_EQ(ask(CommandKind::kStep, 1, 1), Answer::kLockLeft);
  EXPECT_EQ(ask(CommandKind::kStep, 2, 1), Answer::kDone) << "it was not moved";
  ASSERT_GE(until([&] { return std::abs(drive(2) - 1) < 1e-9 && out().distance_zero; }), 0);
  EXPECT_EQ(drive(0), 0);
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_GE(until([&] {
              EXPECT_NEAR(drive(0), 0, 1e-12);
              EXPECT_NEAR(drive(1), 0, 1e-12);
              return flags().beside == 0 && !runtime->snapshot().resetting;
            },
                  3000),
            0);
  steps(3);
  EXPECT_NEAR(counted(0), 0, 1e-12);
  EXPECT_NEAR(counted(1), 0, 1e-12);
  EXPECT_NEAR(runtime->snapshot().system[0].actual.v[0], 0, 1e-6);
  EXPECT_TRUE(out().distance_zero);
  start("G91 G1 X10. F1200\nM30\n");  // from where the machine stands
  until_end();
  EXPECT_NEAR(drive(0), 10, 1e-9);
  EXPECT_NEAR(counted(0), 10, 1e-9);
}

// The switch was on when the machine was switched on: the drives are given the place where they stand, in the first scan as in every other.
TEST_F(AxisLock, IsOnBeforeTheControlIs) {
  build("", 100, "machine_lock");
  EXPECT_EQ(flags().locked, 7u);
  EXPECT_EQ(flags().beside, 0u);
  EXPECT_EQ(drive(0), 100);
  EXPECT_EQ(counted(0), 100);
  start("G91 G1 X10. F1200\nM30\n");
  ASSERT_GE(until([&] { return drive(0) != 100 || (out().state == NC_STATE_IDLE && counted(0) == 110); }), 0);
  EXPECT_EQ(drive(0), 100);
}

// A drive that goes off in the lock is taken over where it stands, and what is counted stays.
TEST_F(AxisLock, ADriveThatFailsIsTakenOverWhereItStands) {
  build();
  turn("machine_lock", 1);
  start("G91 G1 X50. F1200\nM30\n");
  ASSERT_GE(until([&] { return counted(0) > 10; }), 0);
  hal->machine.fail_drive(0, 0, true);
  steps(500);
  EXPECT_NE(alarm(), "");
  EXPECT_GT(counted(0), 10);
  EXPECT_NEAR(drive(0), 0, 1e-9);
  hal->machine.fail_drive(0, 0, false);
  reset();
  EXPECT_EQ(alarm(), "");
  EXPECT_NEAR(counted(0), 0, 1e-9);
  turn("machine_lock", 0);
  steps(3);
  start("G91 G1 X5. F1200\nM30\n");
  until_end();
  EXPECT_NEAR(drive(0), 5, 1e-9);
}

class LockedTap : public nc::test::SwitchMachine {
 protected:
  static constexpr const char* kParameters = "[parameters]\n\"3005\" = 3000\n\"3013\" = 600\n\"3017\" = 250\n";
  static constexpr const char* kProgram = "G90 G0 Z10.\nG84 X0 Y0 Z-8. R2. S600 F1.5 P100 ,R1\nG80\nM30\n";
  double turns() const { return hal->machine.spindle_turns(0, 0); }
};

// M700 13.1.1: a spindle that turned while its axis stands would bore in one place.
TEST_F(LockedTap, TheSpindleStandsWithItsAxis) {
  build(kParameters);
  turn("axis_lock.Z", 1);
  steps(3);
  start(kProgram);
  ASSERT_GE(until([&] { return out().tapping && counted(2) < 1; }), 0);
  const double began = turns();
  double deepest = 0, turned = 0;
  ASSERT_GE(until([&] {
              EXPECT_EQ(drive(2), 0);
              deepest = std::min(deepest, counted(2));
              turned = std::max(turned, std::abs(turns() - began));
              return !out().tapping;
            }),
            0);
  EXPECT_NEAR(deepest, -8, 1e-6);
  EXPECT_LT(turned, 1e-3);
  until_end();
}

// It is in no hole: a reset leaves nothing to be drawn out.
TEST_F(LockedTap, AResetLeavesNoTapInItsHole) {
  build(kParameters);
  turn("axis_lock.Z", 1);
  steps(3);
  start(kProgram);
  ASSERT_GE(until([&] { return out().tapping && counted(2) < -3; }), 0);
  reset();
  EXPECT_FALSE(out().tap_retract_possible);
  EXPECT_EQ(out().tap_holds, 0u);
  EXPECT_EQ(out().spindle_synchronous, 0);
  EXPECT_NEAR(counted(2), 0, 1e-12);
}

TEST_F(LockedTap, NoLockIsTakenOverWhileATapStandsInItsHole) {
  build(kParameters);
  start(kProgram);
  ASSERT_GE(until([&] { return out().tapping && counted(2) < -3; }), 0);
  reset();
  ASSERT_TRUE(out().tap_retract_possible);
  turn("machine_lock", 1);
  steps(20);
  EXPECT_EQ(flags().locked, 0u);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  nc::rt::Command draw;
  draw.kind = CommandKind::kTapRetract;
  draw.number = 1;
  ASSERT_EQ(runtime->execute(draw), Answer::kDone);
  ASSERT_GE(until([&] { return flags().locked == 7u; }), 0);
  EXPECT_NEAR(drive(2), 2, 2e-3);
}

// The lock of the tool's axis is the Z lock.
TEST_F(AxisLock, OneAxisAlone) {
  build();
  turn("axis_lock.Z", 1);
  start("G90 G0 X5. Y5. Z20.\nG81 R2. Z-8. F600\nX9.\nG80\nM30\n");
  EXPECT_GE(until([&] {
              EXPECT_EQ(drive(2), 0);
              return out().state == NC_STATE_IDLE && runtime->info().system[0].runs > 0;
            }),
            0);
  EXPECT_NEAR(drive(0), 9, 1e-9);
  EXPECT_NEAR(drive(1), 5, 1e-9);
  EXPECT_EQ(flags().beside, 4u);
}

// A locked program is started again and again from where it has counted to, or behind a reset from the machine's place.
TEST_F(AxisLock, AResetTakesBackWhatIsCountedWhileItIsOn) {
  build();
  turn("machine_lock", 1);
  start("G91 G1 X10. F6000\nM30\n");
  until_end();
  ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  until_end();
  EXPECT_NEAR(counted(0), 20, 1e-9);
  reset();
  EXPECT_NEAR(counted(0), 0, 1e-12);
  EXPECT_EQ(drive(0), 0);
  ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  until_end();
  EXPECT_NEAR(counted(0), 10, 1e-9);
}

TEST_F(AxisLock, ActsBetweenBlocksAndNotAmidThem) {
  build();
  turn("single_block", 1);
  start("G91 G1 X10. F1200\nX10.\nX10.\nM30\n");
  ASSERT_GE(until([&] { return counted(0) > 4; }), 0);
  turn("machine_lock", 1);
  ASSERT_GE(until([&] { return out().state == NC_STATE_STOPPED; }), 0);
  EXPECT_NEAR(drive(0), 10, 1e-9) << "the block in execution ends as it has begun";
  steps(3);
  EXPECT_EQ(flags().locked, 7u);
  ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  steps(50);
  turn("machine_lock", 0);  // too late for this block
  ASSERT_GE(until([&] { return out().state == NC_STATE_STOPPED; }), 0);
  EXPECT_NEAR(counted(0), 20, 1e-9);
  EXPECT_NEAR(drive(0), 10, 1e-9);
  steps(3);
  EXPECT_EQ(flags().locked, 0u);
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kLockLeft);
  reset();
  EXPECT_NEAR(counted(0), 10, 1e-9);
  EXPECT_NEAR(drive(0), 10, 1e-9);
}

// The lock goes off in the scan behind an accepted start, before the program has begun: it may not move the axis from the wrong place.
TEST_F(AxisLock, AStartThatWasGivenBeforeItWentOffMovesNothing) {
  for (int late = 0; late < 6; ++late) {
    SCOPED_TRACE(late);
    build();
    turn("machine_lock", 1);
    start("G91 G1 X10. F1200\nM30\n");
    until_end();
    ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
    steps(late);
    turn("machine_lock", 0);
    for (int n = 0; n < 1500; ++n) {
      steps(1);
      ASSERT_EQ(drive(0), 0) << n;
    }
    reset();
    EXPECT_NEAR(counted(0), 0, 1e-12);
  }
}

// M700 15.2 (8).
TEST_F(AxisLock, NoSignalEndsASkipMoveOfLockedAxes) {
  for (const bool filters : {false, true}) {
    for (const char* lock : {"", "axis_lock.X", "machine_lock"}) {
      SCOPED_TRACE(lock);
      build();
      if (*lock != 0) turn(lock, 1);
      start(std::string(filters ? "#2004=0\n" : "") + "G91 G31 X20. F600\nM30\n");
      ASSERT_GE(until([&] { return counted(0) > 5; }), 0);
      turn("skip.1", 1);
      until_end();
      EXPECT_EQ(std::abs(counted(0) - 20) < 1e-9, *lock != 0) << counted(0);
    }
    build();
    turn("axis_lock.Z", 1);
    start("G91 G31 X20. Z1. F600\nM30\n");  // X can meet something
    ASSERT_GE(until([&] { return counted(0) > 5; }), 0);
    turn("skip.1", 1);
    until_end();
    EXPECT_LT(counted(0), 19);
  }
}

TEST_F(AxisLock, TheReferenceLampIsOfTheMachine) {
  build();
  start("G90 G0 X7.\nM30\n");
  until_end();
  turn("axis_lock.X", 1);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  steps(2);
  ASSERT_EQ(ask(CommandKind::kReference, 0), Answer::kDone);
  ASSERT_GE(until([&] { return std::abs(counted(0)) < 1e-9 && out().distance_zero; }), 0);
  steps(3);
  const std::vector<nc::rt::Signal> all = nc::rt::machine_signals(config.nc);
  const auto value = [&](const std::string& name) {
    std::int32_t found = -1;
    nc::hal::Feedback feedback;
    const nc::rt::Snapshot now = runtime->snapshot();
    feedback.system[0].actual = now.system[0].actual;
    const nc::rt::AxisFlags axes[] = {now.system[0].axes};
    nc::rt::LadderStatus status;
    status.axes = axes;
    const nc_outputs outputs[] = {now.system[0].nc};
    const nc::rt::LadderImage image{nullptr, nullptr, &feedback, outputs, nullptr, 1, &status, nullptr, &config.nc};
    for (const nc::rt::Signal& signal : all)
      if (signal.name == name) found = signal.row->read(image, signal.system, signal.index);
    return found;
  };
  EXPECT_EQ(value("nc.at_reference.X"), 0) << "it is counted there, and stands at 7";
  EXPECT_EQ(value("nc.position.X"), 7000);
  EXPECT_EQ(value("nc.axis_locked.X"), 1);
  EXPECT_EQ(value("nc.lock_left.X"), 1);
  EXPECT_EQ(value("nc.at_reference.Y"), 1);
  EXPECT_EQ(value("nc.lock_left.Y"), 0);
}

// ---- a random operator ----

// Every axis of the machine keeps its limits in each scan, and is where it is shown unless it was moved in a lock.
class RandomLocks : public nc::test::SwitchMachine {
 protected:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng_); }
  bool chance(double p) { return uniform(0, 1) < p; }

  // What the drive of an axis was given in one scan.
  void watch(const nc::hal::SystemCommand& given, unsigned a, bool jerks) {
    const double dt = config.nc.cycle_s;
    const nc_axis_config& axis = config.nc.system[0].axis[a];
    const double x = given.position.v[a], v = (x - last_[a]) / dt, acceleration = (v - velocity_[a]) / dt, jerk = (acceleration - acceleration_[a]) / dt;
    const bool off = !given.enable || (given.off >> a & 1u) != 0;  // then the command goes with the drive
    quiet_[a] = off ? 0 : quiet_[a] + 1;
    comes_on_ |= quiet_[a] == 1 ? 1u << a : 0;
    if (quiet_[a] > 3) {
      ASSERT_LE(std::abs(v), 1.001 * std::max(axis.rapid, axis.max_velocity)) << "axis " << a << " jumps: " << last_[a] << " to " << x << ", state " << int{out().state};
      ASSERT_LE(std::abs(acceleration), 1.001 * axis.max_acceleration) << "axis " << a << ": " << velocity_[a] << " to " << v << ", state " << int{out().state};
      if (jerks) {
        ASSERT_LE(std::abs(jerk), 1.001 * axis.max_jerk) << "axis " << a << ": " << acceleration_[a] << " to " << acceleration << ", state " << int{out().state};
      }
      speed = std::max(speed, std::abs(v) / std::max(axis.rapid, axis.max_velocity));
      slope = std::max(slope, std::abs(acceleration) / axis.max_acceleration);
      if (jerks) turn_ = std::max(turn_, std::abs(jerk) / axis.max_jerk);
      if (locked_before_ >> a & flags().locked >> a & 1u) {
        ASSERT_NEAR(x, last_[a], 1e-12) << "a locked axis moves";
      }
    }
    last_[a] = x, velocity_[a] = v, acceleration_[a] = acceleration;
  }
  void look(bool jerks) {
    if (out().state == NC_STATE_RUNNING) ++running_;
    else running_ = 0;
    for (const nc::hal::SystemCommand& given : hal->all)
      for (unsigned a = 0; a < 3; ++a) {
        watch(given, a, jerks && running_ > 5);  // motion by hand has no limit of jerk
        if (HasFatalFailure()) return;
      }
    hal->all.clear();
    const std::uint32_t came_on = std::exchange(comes_on_, 0);
    locked_before_ = flags().locked;
    for (unsigned a = 0; a < 3; ++a) {
      if ((came_on >> a & 1u) != 0) {
        ASSERT_NEAR(last_[a], runtime->snapshot().system[0].actual.v[a] - flags().counted[a], 0.05) << "axis " << a << " jumps when its drive comes on";
      }
      if ((flags().beside >> a & 1u) == 0) {
        ASSERT_NEAR(last_[a], counted(a), 2e-9) << "axis " << a << " is not where it is shown";
      }
    }
  }
  void session(std::uint64_t seed, bool optimal) {
    rng_.seed(seed);
    for (unsigned& quiet : quiet_) quiet = 0;
    locked_before_ = running_ = comes_on_ = 0;
    build(optimal ? "[motion]\nmode = \"optimal\"\ntolerance = 0.005\n" : "");
    turn("jog_feed", 1000);
    select("N1 G91 G1 X8. Y3. F3000\nG2 X4. Y4. R4.\nG1 X-6. Z2.\nG0 X-6. Y-7. Z-2.\nM8\nG1 X3. F400\nX-3.\nM99\n");
    const char* const locks[] = {"machine_lock", "axis_lock.X", "axis_lock.Z", "single_block", "dry_run", "jog_rapid", "auxiliary_lock"};
    unsigned on[7] = {};
    bool failed[3] = {};
    for (int n = 0; n < 6000; ++n) {
      if (chance(0.01)) {
        const unsigned which = static_cast<unsigned>(rng_() % 7);
        turn(locks[which], on[which] ^= 1);
      }
      if (chance(0.004)) turn("jog_feed", static_cast<std::uint32_t>(rng_() % 8) * 500);
      if (chance(0.01)) (void)runtime->execute(CommandKind::kCycleStart);
      if (chance(0.003)) (void)runtime->execute(CommandKind::kFeedHold);
      if (chance(0.003)) (void)runtime->execute(CommandKind::kReset);
      if (chance(0.004)) (void)mode(chance(0.6) ? Mode::kAuto : Mode::kManual);
      if (chance(0.01)) (void)ask(chance(0.5) ? CommandKind::kStep : chance(0.8) ? CommandKind::kJog : CommandKind::kReference, static_cast<unsigned>(rng_() % 3), uniform(-3, 3));
      if (chance(0.002)) (void)runtime->execute(CommandKind::kFeedOverride, uniform(0, 2));
      if (chance(0.01)) turn("jog_p.X", chance(0.5) ? 1 : 0);
      if (chance(0.01)) turn("jog_m.Y", chance(0.5) ? 1 : 0);
      turn("handle.Z", chance(0.02) ? static_cast<std::uint32_t>(rng_() % 40) : 0);
      if (const unsigned a = static_cast<unsigned>(rng_() % 3); chance(failed[a] ? 0.01 : 0.0005)) hal->machine.fail_drive(0, a, failed[a] = !failed[a]);
      steps(1);
      moved += out().distance_zero ? 0 : 1;
      locked += flags().locked != 0 ? 1 : 0;
      left += (flags().beside & ~flags().locked) != 0 ? 1 : 0;
      look(optimal);
      if (HasFatalFailure()) return;
    }
  }
  double speed = 0, slope = 0, turn_ = 0;
  std::uint64_t moved = 0, locked = 0, left = 0;

 private:
  std::mt19937_64 rng_;
  double last_[3] = {}, velocity_[3] = {}, acceleration_[3] = {};
  std::uint32_t locked_before_ = 0, running_ = 0, comes_on_ = 0;
  unsigned quiet_[3] = {};  // scans since the drive has followed its command
};

TEST_F(RandomLocks, KeepTheLimits) {
  const std::uint64_t first = nc::test::wish("NC_FIRST_SEED", 1), count = nc::test::seeds(24, 4);
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    SCOPED_TRACE(seed);
    ASSERT_NO_FATAL_FAILURE(session(seed, seed % 2 == 1));
  }
  std::printf("%llu sessions: velocity %.4f, acceleration %.4f, jerk %.4f of the limits; scans with motion %llu, locked %llu, beside %llu\n",
              static_cast<unsigned long long>(count), speed, slope, turn_, static_cast<unsigned long long>(moved), static_cast<unsigned long long>(locked),
              static_cast<unsigned long long>(left));
  EXPECT_GT(moved, 0u);
  EXPECT_GT(locked, 0u);
  EXPECT_GT(left, 0u);
}

}  // namespace
