// SPDX-License-Identifier: Apache-2.0
// Drives that start anew, go silent or lose frames, at any instant: behind the end of it and some resets the machine is ready again, whatever has happened.
//
//   NC_SEEDS=300 NC_FIRST_SEED=1000 test_canopen --gtest_filter='CanReboot.AnyOf*'     more sessions; NC_LOG=1 prints what happens
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "can_rig.hpp"
#include "support/seeds.hpp"

namespace {

using nc::hal::canopen::CanFrame;
using nc::hal::canopen::NodePhase;
using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::test::can_toml;
using nc::test::CanRig;
using nc::test::SimDrive;

void start_moving(CanRig* rig) {
  rig->bring_up();
  ASSERT_EQ(rig->mdi("G90 G01 X300. Y150. Z60. F9000"), Answer::kDone);
  rig->step(300);
  ASSERT_GT(rig->plant_mm(0), 5.0);
}

// One reset, which is enough.
void expect_ready_behind_a_reset(CanRig* rig) {
  ASSERT_TRUE(rig->until([&] { return rig->machine->service().all_operational(); }, 9000)) << rig->said();
  rig->step(20);
  ASSERT_EQ(rig->run(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(rig->until([&] { return rig->following(); }, 3000)) << rig->alarms() << rig->said();
  rig->step(50);
  EXPECT_EQ(rig->alarms(), "");
}

// A drive whose processor has started anew, which nobody has heard, and which has gone to "operational" by itself: its heartbeat is there all the time, its
// PDOs are not those that it was given.
TEST(CanReboot, ADriveThatHasLostItsPdosButNotItsHeartbeatIsSetUpAgain) {
  CanRig rig;
  start_moving(&rig);
  SimDrive& drive = *rig.drives[1];
  drive.unheard = drive.starts_itself = true;
  drive.stored_heartbeat = 100;
  drive.power_cycle();
  rig.step(10);
  EXPECT_EQ(rig.alarms(), "R12 Drive fault: its positions do not come, axis Y (line 1)\n");
  rig.step(3000);
  expect_ready_behind_a_reset(&rig);
}

// The same with a drive that goes on without positions: it is set up again once by itself, then with each reset, and works when it is repaired.
TEST(CanReboot, ADriveWhosePositionsStayAwayIsSetUpOnceByItselfAndWithEachReset) {
  CanRig rig;
  start_moving(&rig);
  SimDrive& drive = *rig.drives[1];
  drive.no_tpdo = true;
  const unsigned before = drive.resets_seen;
  rig.step(10'000);
  EXPECT_EQ(drive.resets_seen, before + 1);
  EXPECT_EQ(rig.alarms(), "R12 Drive fault: its positions do not come, axis Y (line 1)\n");
  rig.run(CommandKind::kReset);
  rig.step(5000);
  EXPECT_EQ(drive.resets_seen, before + 2);
  EXPECT_EQ(rig.alarms(), "R12 Drive fault: its positions do not come, axis Y (line 1)\n");
  drive.no_tpdo = false;
  rig.step(10);
  expect_ready_behind_a_reset(&rig);
}

// A position of before says nothing about where the axis is now: while positions are missing there is no following error, however fast the axis is to go.
TEST(CanReboot, AMissingPositionIsNoFollowingError) {
  CanRig rig(can_toml("lost_after = 100\n"));
  start_moving(&rig);
  rig.drives[1]->dead = true;
  rig.step(120);
  EXPECT_EQ(rig.alarms(), "R12 Drive fault: its positions do not come, axis Y (line 1)\n");
}

TEST(CanReboot, APositionThatComesAgainIsJudged) {
  CanRig rig(can_toml("lost_after = 100\n"));
  start_moving(&rig);
  rig.drives[1]->plant().blocked = true;
  rig.drives[1]->no_tpdo = true;
  rig.step(60);
  EXPECT_EQ(rig.alarms(), "");
  rig.drives[1]->no_tpdo = false;
  rig.step(3);
  EXPECT_EQ(rig.alarms(), "R11 Following error beyond its limit, axis Y (line 1)\n");
}

// It boots once more while it is being set up, just where its mode is written: what it was told before is gone.
TEST(CanReboot, ABootAnywhereInItsSetUpBeginsTheSetUpAnew) {
  unsigned frames = 0;  // it is older than the rig, which sends still while it is taken down
  CanRig rig;
  rig.bring_up();
  SimDrive& drive = *rig.drives[1];
  rig.bus.behind_frame = [&] {
    if (frames > 0 && --frames == 0) drive.power_cycle();
  };
  for (unsigned at = 1; at <= 700; at += 3) {
    drive.power_cycle();
    frames = at;
    for (unsigned n = 0; n < 3000 && (n < 400 || !rig.machine->service().all_operational()); ++n) rig.step();
    ASSERT_TRUE(rig.machine->service().all_operational()) << "frame " << at << ": " << rig.said();
    rig.step(20);
    ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
    ASSERT_TRUE(rig.until([&] { return rig.following(); }, 1000)) << "frame " << at << ": " << rig.alarms() << rig.said();
    rig.step(20);
    ASSERT_EQ(rig.alarms(), "") << "frame " << at;
  }
}

// An encoder that counts from 0 when its drive boots: what the drive has found by homing is gone.
TEST(CanReboot, ADriveThatStartsAnewIsNotHomedAnyMore) {
  CanRig rig(can_toml("", "homing = { method = 17, fast = 10.0, slow = 1.0, acceleration = 100.0, position = 0.0, request = \"home_x\", done = \"x_homed\" }\n"));
  rig.bring_up();
  ASSERT_EQ(rig.mdi("#1100=1"), Answer::kDone);
  const auto homed = [&] {
    nc::hal::Feedback feedback;
    nc::hal::PointImage image;
    rig.machine->read(&feedback, &image);
    return image.value[rig.config.canopen.nodes[0].axes[0].homed] != 0;
  };
  ASSERT_TRUE(rig.until(homed, 3000)) << rig.alarms();
  rig.step(200);
  ASSERT_TRUE(homed());
  rig.drives[0]->loses_position = true;
  rig.drives[0]->power_cycle();
  rig.step(5);
  EXPECT_FALSE(homed());
  expect_ready_behind_a_reset(&rig);
  EXPECT_FALSE(homed());
}

// A quick stop that is taken back does not shorten the next one, behind which a drive that still moves loses its torque.
TEST(CanReboot, EachQuickStopHasItsWholeTime) {
  using nc::hal::canopen::DriveWay;
  using nc::hal::canopen::DriveWish;
  DriveWay way(10);
  constexpr std::uint16_t kEnabled = 0x1227, kQuickStop = 0x0002;
  for (int round = 0; round < 3; ++round) {
    for (int n = 0; n < 8; ++n) EXPECT_EQ(way.next(kEnabled, DriveWish::kOff) & 0xF, kQuickStop) << round << " " << n;
    (void)way.next(kEnabled, DriveWish::kOn);
  }
}

// ---- sessions ----

unsigned long setting(const char* name, unsigned long otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoul(text, nullptr, 10);
}

class Session {
 public:
  // With `speed` the drive of X is given a speed, and its position is held by the control.
  Session(unsigned long seed, bool speed)
      : seed_(seed), random_(seed), log_(std::getenv("NC_LOG") != nullptr), tried_(speed ? 0 : 2), rig_(nc::test::can_toml("", speed ? "mode = \"velocity\"\nvelocity_delay = 2.0\n" : "")) {}

  void run(unsigned incidents) {
    rig_.bring_up();
    for (auto& drive : rig_.drives) {
      drive->out = [this, node = drive->node(), send = drive->out](const CanFrame& frame) {
        if (node != loser_ || below(100) >= loss_percent_) send(frame);
      };
    }
    rig_.bus.behind_frame = [this] {
      if (frames_ > 0 && --frames_ == 0 && strike_) {
        const auto strike = std::move(strike_);
        strike_ = nullptr;
        strike();
      }
    };
    for (unsigned n = 0; n < incidents && !testing::Test::HasFailure(); ++n) {
      where_ = "seed " + std::to_string(seed_) + ", incident " + std::to_string(n) + ": ";
      incident();
      comes_back();
      works();
    }
  }

 private:
  unsigned below(unsigned bound) { return static_cast<unsigned>(random_() % bound); }
  bool one_in(unsigned n) { return below(n) == 0; }
  void tell(const std::string& what) {
    where_ += what + "; ";
    if (log_) std::printf("%9.3f s %s\n", static_cast<double>(rig_.now_ns) * 1e-9, what.c_str());
  }
  void step(unsigned n = 1) {
    for (; n > 0; --n) {
      rig_.step();
      const std::string now = rig_.alarms();
      if (now != said_ && log_) std::printf("%9.3f s alarms: %s\n", static_cast<double>(rig_.now_ns) * 1e-9, now.c_str());
      said_ = now;
      // Each alarm is R12, names its axis, and says why; or R14, when all nodes are away at once.
      for (std::size_t at = 0; at < now.size();) {
        const std::size_t end = now.find('\n', at);
        const std::string line = now.substr(at, end - at);
        const bool named = line.starts_with("R12 Drive fault: ") && line.find(", axis ") != std::string::npos;
        if (!named && !line.starts_with("R14 No connection to the machine") && !testing::Test::HasFailure()) ADD_FAILURE() << where_ << line;
        at = end + 1;
      }
    }
  }

  // A drive boots, at a frame of the control within the next cycles.
  void boot(SimDrive* drive, bool unheard, bool alone, unsigned off_ms) {
    drive->unheard = unheard;
    drive->starts_itself = alone;
    drive->stored_heartbeat = alone || one_in(2) ? 50 + below(100) : 0;
    drive->loses_position = one_in(3);
    tell("node " + std::to_string(drive->node()) + " boots behind " + std::to_string(off_ms) + " ms" + (unheard ? ", unheard" : "") + (alone ? ", operational by itself" : ""));
    frames_ = 1 + below(40);
    if (off_ms == 0) {
      strike_ = [drive] { drive->power_cycle(); };
      step(15);
      return;
    }
    strike_ = [drive] { drive->dead = true; };
    step(15 + off_ms);
    frames_ = 1 + below(40);
    strike_ = [drive] { drive->power_cycle(); };
    step(15);
  }
  void boot(SimDrive* drive) {
    const bool unheard = one_in(3);
    boot(drive, unheard, unheard && one_in(2), one_in(2) ? 0 : one_in(3) ? below(4000) : below(300));
  }

  void incident() {
    if (one_in(2)) {
      (void)rig_.mdi("G91 G01 X" + std::string(one_in(2) ? "" : "-") + "20. Y10. Z5. F9000");
      step(below(200));
    }
    for (unsigned times = one_in(3) ? 1 + below(3) : 1; times > 0; --times) {
      SimDrive* drive = rig_.drives[below(3)].get();
      switch (below(6)) {
        case 0:
        case 1: boot(drive); break;
        case 2:  // and once more in its set-up
          boot(drive);
          (void)rig_.until([&] { return rig_.machine->cyclic().phase(drive->node() - 1) == NodePhase::kSetUp; }, 3000);
          step(below(400));
          boot(drive);
          break;
        case 3: {  // its positions stay away
          const unsigned ms = below(one_in(2) ? 10 : 6000);
          tell("node " + std::to_string(drive->node()) + " sends no positions for " + std::to_string(ms) + " ms");
          drive->no_tpdo = true;
          step(ms);
          drive->no_tpdo = false;
          break;
        }
        case 4: {
          const unsigned ms = below(1000);
          tell("node " + std::to_string(drive->node()) + " sends no heartbeat for " + std::to_string(ms) + " ms");
          drive->no_heartbeat = true;
          step(ms);
          drive->no_heartbeat = false;
          break;
        }
        default: {  // a bad contact
          loser_ = drive->node();
          loss_percent_ = 1 + below(90);
          const unsigned ms = below(2000);
          tell("of node " + std::to_string(loser_) + " " + std::to_string(loss_percent_) + " % are lost for " + std::to_string(ms) + " ms");
          step(ms);
          loser_ = 0;
          break;
        }
      }
      if (one_in(2)) {  // the operator is impatient; it boots in the middle of a reset, too
        tell("reset");
        if (one_in(3)) {
          frames_ = 1 + below(60);
          strike_ = [this, drive] {
            tell("node " + std::to_string(drive->node()) + " boots");
            drive->power_cycle();
          };
        }
        (void)rig_.run(CommandKind::kReset);
        step(below(100));
      }
    }
  }

  // Behind the end of what is wrong: the nodes come back by themselves within the longest pause and one attempt (one without positions when the time of its quick
  // stop is over), the axes with three resets.
  void comes_back() {
    const unsigned most = 15'000;
    unsigned n = 0;
    for (; n < most && (n < 2500 || !rig_.machine->service().all_operational()); ++n) step();
    ASSERT_LT(n, most) << where_ << rig_.said();
    double stands[3];
    for (unsigned a = 0; a < 3; ++a) stands[a] = rig_.plant_mm(a);
    unsigned resets = 0;
    const auto clean = [&] { return rig_.alarms().empty() && rig_.following() && rig_.enabled(); };
    while (!clean() && resets < 3) {
      ++resets;
      tell("reset behind it");
      (void)rig_.run(CommandKind::kReset);
      for (unsigned wait = 0; wait < 5000 && !clean(); ++wait) {
        step();
        if (wait > 100 && !rig_.alarms().empty() && rig_.machine->service().all_operational()) break;
      }
      step(100);
    }
    ASSERT_TRUE(clean()) << where_ << rig_.alarms() << rig_.said();
    for (unsigned a = 0; a < 3; ++a) EXPECT_NEAR(rig_.plant_mm(a), stands[a], 0.002) << where_ << "axis " << a << " has moved by itself";
  }

  // A short way is gone, all of it and nothing else.
  void works() {
    if (testing::Test::HasFailure()) return;
    (void)rig_.run(CommandKind::kReset);
    ASSERT_TRUE(rig_.until([&] { return rig_.idle() && rig_.following(); }, 4000)) << where_ << rig_.alarms();
    step(30);
    const double from = rig_.plant_mm(tried_);
    ASSERT_EQ(rig_.mdi(std::string("G91 G01 ") + "XYZ"[tried_] + (from > 0 ? "-" : "") + "2. F9000"), Answer::kDone) << where_;
    step(20);
    ASSERT_TRUE(rig_.until([&] { return rig_.idle(); }, 3000)) << where_ << rig_.alarms();
    step(20);
    EXPECT_NEAR(rig_.plant_mm(tried_), from + (from > 0 ? -2 : 2), 0.002) << where_;
  }

  const unsigned long seed_;
  std::mt19937_64 random_;
  const bool log_;
  const unsigned tried_;  // axis that moves behind each incident
  CanRig rig_;
  std::string where_, said_;
  unsigned frames_ = 0, loser_ = 0, loss_percent_ = 0;
  std::function<void()> strike_;
};

TEST(CanReboot, AnyOfThemAtAnyInstantEndsBehindResets) {
  const unsigned long first = setting("NC_FIRST_SEED", 1), seeds = nc::test::seeds(6, 2);
  for (unsigned long seed = first; seed < first + seeds && !HasFailure(); ++seed) Session(seed, seed % 2 == 0).run(10);
}

}  // namespace
