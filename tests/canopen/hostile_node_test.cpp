// SPDX-License-Identifier: Apache-2.0
// A node that does not keep to anything sends what it likes, under the identifiers of others too, at any time. The set-points that the control gives stay those of
// axes that can be moved, the axes stand when it is over, and behind some resets the machine makes its part.
//
//   NC_SEEDS=300 NC_FIRST_SEED=1000 test_canopen --gtest_filter='CanHostile.*'
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "can_rig.hpp"
#include "support/seeds.hpp"

namespace {

using nc::hal::canopen::CanFrame;
using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::test::can_toml;
using nc::test::CanRig;
using nc::test::kIncrementsPerMm;

class HostileNode {
 public:
  HostileNode(unsigned long seed, bool positions) : seed_(seed), positions_(positions), random_(seed) {}

  void run() {
    rig_.bring_up();
    rig_.bus.records = true;
    for (unsigned round = 0; round < 6 && !testing::Test::HasFailure(); ++round) {
      where_ = "seed " + std::to_string(seed_) + ", round " + std::to_string(round) + ": ";
      if (below(3) > 0) (void)rig_.mdi("G91 G01 X" + std::string(below(2) ? "-" : "") + "20. Y10. Z5. F6000");
      const unsigned kinds = 1 + below(255), percent = 1 + below(100);
      for (unsigned n = 50 + below(1500); n > 0; --n) {
        for (unsigned frames = below(100) < percent ? 1 + below(10) : 0; frames > 0; --frames)
          if (CanFrame frame = any(); (kinds >> below(8) & 1) != 0) rig_.bus.from_drive(frame);
        if (below(200) == 0) (void)rig_.run(CommandKind::kReset);
        step();
      }
      comes_back();
      works();
    }
  }

 private:
  unsigned below(unsigned bound) { return static_cast<unsigned>(random_() % bound); }

  CanFrame any() {
    static constexpr unsigned kKinds[] = {0x080, 0x580, 0x700, 0x280, 0x180, 0x000, 0x600, 0x200};
    unsigned kind = kKinds[below(8)];
    if (kind == 0x180 && !positions_) kind = 0x700;
    CanFrame frame;
    frame.id = static_cast<std::uint16_t>(below(20) == 0 ? below(0x800) : kind + 1 + below(4));
    if (!positions_ && frame.id > 0x180 && frame.id <= 0x184) frame.id = 0x7FF;
    frame.length = static_cast<std::uint8_t>(below(4) == 0 ? below(9) : 8);
    for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(below(3) == 0 ? 0 : random_());
    if (kind == 0x700 && below(2) == 0) {
      static constexpr std::uint8_t kStates[] = {0, 4, 5, 0x7F};
      frame.length = 1;
      frame.data[0] = kStates[below(4)];
    }
    return frame;
  }

  // Each set-point that goes to a drive that is to follow is one that its axis can go to from the one before.
  void step() {
    rig_.step();
    for (const CanFrame& frame : rig_.bus.sent) {
      if (frame.id < 0x201 || frame.id > 0x203) continue;
      const unsigned a = frame.id - 0x201;
      const unsigned control = frame.data[0] | static_cast<unsigned>(frame.data[1]) << 8;
      std::uint32_t raw = 0;
      for (unsigned i = 0; i < 4; ++i) raw |= static_cast<std::uint32_t>(frame.data[2 + i]) << (8 * i);
      const auto target = static_cast<std::int32_t>(raw);
      const bool on = (control & 0xF) == 0xF, was_on = on_[a];
      if (on && was_on && !positions_) {
        EXPECT_LE(std::abs(target - target_[a]) / kIncrementsPerMm, 0.42) << where_ << "axis " << a;
      }
      on_[a] = on;
      target_[a] = target;
    }
    rig_.bus.sent.clear();
    for (unsigned a = 0; a < 3; ++a) {
      const double place = rig_.plant_mm(a);
      EXPECT_TRUE(std::isfinite(rig_.command(a)) && std::isfinite(rig_.actual(a))) << where_;
      if (known_ && !positions_) {
        EXPECT_LE(std::abs(place - place_[a]), 0.42) << where_ << "axis " << a << " jumps";
      }
      place_[a] = place;
    }
    known_ = true;
  }

  void comes_back() {
    for (unsigned n = 0; n < 20'000 && (n < 2500 || !rig_.machine->service().all_operational()); ++n) step();
    ASSERT_TRUE(rig_.machine->service().all_operational()) << where_ << rig_.said();
    for (unsigned n = 0; n < 500; ++n) step();  // a simulated drive that was out of "operational" ends its quick stop now
    if (!rig_.alarms().empty()) {
      const double stands[] = {rig_.plant_mm(0), rig_.plant_mm(1), rig_.plant_mm(2)};
      const auto clean = [&] { return rig_.alarms().empty() && rig_.following() && rig_.enabled(); };
      for (unsigned resets = 0; resets < 3 && !clean(); ++resets) {
        (void)rig_.run(CommandKind::kReset);
        for (unsigned wait = 0; wait < 5000 && !clean(); ++wait) {
          step();
          if (wait > 700 && !rig_.alarms().empty() && rig_.machine->service().all_operational()) break;
        }
        for (unsigned n = 0; n < 100; ++n) step();
      }
      ASSERT_TRUE(clean()) << where_ << rig_.alarms() << rig_.said();
      for (unsigned a = 0; a < 3; ++a) EXPECT_NEAR(rig_.plant_mm(a), stands[a], 0.002) << where_ << "axis " << a << " has moved by itself";
    }
  }

  void works() {
    if (testing::Test::HasFailure()) return;
    (void)rig_.run(CommandKind::kReset);
    ASSERT_TRUE(rig_.until([&] { return rig_.idle() && rig_.following(); }, 4000)) << where_ << rig_.alarms();
    for (unsigned n = 0; n < 30; ++n) step();
    const double from = rig_.plant_mm(1);
    ASSERT_EQ(rig_.mdi(std::string("G91 G01 Y") + (from > 0 ? "-" : "") + "2. F6000"), Answer::kDone) << where_;
    for (unsigned n = 0; n < 20; ++n) step();
    for (unsigned n = 0; n < 3000 && !rig_.idle(); ++n) step();
    for (unsigned n = 0; n < 20; ++n) step();
    EXPECT_NEAR(rig_.plant_mm(1), from + (from > 0 ? -2 : 2), 0.002) << where_ << rig_.alarms();
  }

  const unsigned long seed_;
  const bool positions_;  // it gives positions for those of the drives, too: then nothing is known of the axes, but the machine comes back
  std::mt19937_64 random_;
  CanRig rig_;
  std::string where_;
  bool known_ = false, on_[3] = {};
  std::int32_t target_[3] = {};
  double place_[3] = {};
};

TEST(CanHostile, ANodeThatSendsAnythingMovesNothing) {
  const unsigned long first = nc::test::wish("NC_FIRST_SEED", 1), seeds = nc::test::seeds(3, 1);
  for (unsigned long seed = first; seed < first + seeds && !HasFailure(); ++seed) HostileNode(seed, false).run();
}

TEST(CanHostile, BehindOneThatGivesPositionsForOthersTheMachineComesBack) {
  const unsigned long first = nc::test::wish("NC_FIRST_SEED", 1), seeds = nc::test::seeds(3, 1);
  for (unsigned long seed = first; seed < first + seeds && !HasFailure(); ++seed) HostileNode(seed, true).run();
}

}  // namespace
