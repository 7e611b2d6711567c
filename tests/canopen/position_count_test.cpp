// SPDX-License-Identifier: Apache-2.0
// The 64-bit count of an axis from the 32 bits of its drive: a drive that says impossible places is a fault, and never leaves the count off by a turn of the 32 bits.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "can_rig.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::test::can_toml;
using nc::test::CanRig;
using nc::test::kIncrementsPerMm;

constexpr double kTurn = 4294967296.0;  // of the 32 bits
constexpr const char* kText = "R12 Drive fault: its position has jumped farther than the axis can move: home it again, axis X";

// X is homed where it stands, and again behind each fault.
std::string homed_where_it_stands(const std::string& kind = "here") {
  std::string text = can_toml();
  const std::string x = "name = \"X\"\n";
  text.insert(text.find(x) + x.size(), "homing = { kind = \"" + kind + "\" }\n");
  return text;
}

bool x_is_homed(const CanRig& rig) { return (rig.runtime->snapshot().system[0].axes.homed & 1u) != 0; }

void home(CanRig* rig) {
  ASSERT_EQ(rig->run(CommandKind::kSetMode, static_cast<std::uint32_t>(nc::rt::Mode::kManual)), Answer::kDone);
  nc::rt::Command home;
  home.kind = CommandKind::kHome;
  home.system = nc::rt::kAllSystems;
  ASSERT_EQ(rig->runtime->execute(home), Answer::kDone) << rig->alarms();
  ASSERT_TRUE(rig->until([&] { return x_is_homed(*rig); }, 3000)) << rig->alarms();
}

TEST(PositionCount, PlacesAtHalfTheRangeAreAFaultAndNoTurnIsLeft) {
  CanRig rig(homed_where_it_stands());
  rig.bring_up();
  home(&rig);
  for (const double way : {1.0, -1.0}) {
    SCOPED_TRACE(way);
    for (const double place : {kTurn / 2 - 1, kTurn - 2, kTurn}) {  // the last one is where it is
      rig.drives[0]->plant().encoder_at = way * place;
      rig.step();
    }
    rig.drives[0]->plant().encoder_at.reset();
    rig.step(20);
    EXPECT_NE(rig.alarms().find(kText), std::string::npos) << rig.alarms();
    EXPECT_FALSE(x_is_homed(rig));
    EXPECT_DOUBLE_EQ(rig.plant_mm(0), 0);
    ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
    ASSERT_TRUE(rig.until([&] { return rig.following() && rig.alarms().empty(); }, 3000)) << rig.alarms();
    EXPECT_NEAR(rig.actual(0), 0, 0.001);
    EXPECT_FALSE(x_is_homed(rig));
    home(&rig);
    EXPECT_DOUBLE_EQ(rig.plant_mm(0), 0);
  }
}

// A reset that is given all the time takes the fault away before the scan sees it, and leaves no place that is taken for known.
TEST(PositionCount, AResetMeanwhileLeavesNoAxisHomed) {
  for (unsigned offset = 0; offset < 8; ++offset) {
    SCOPED_TRACE(offset);
    CanRig rig(homed_where_it_stands());
    rig.bring_up();
    home(&rig);
    for (unsigned i = 0; i < 8; ++i) {
      if (i == offset) rig.drives[0]->plant().position += 40 * kIncrementsPerMm;
      if (i == offset) rig.drives[0]->plant().blocked = true;
      (void)rig.run(CommandKind::kReset);
    }
    rig.step(20);
    EXPECT_FALSE(x_is_homed(rig)) << rig.alarms();
  }
}

// The encoder of such an axis is taken anew.
TEST(PositionCount, AnAbsoluteEncoderIsTakenAnew) {
  CanRig rig(homed_where_it_stands("absolute"));
  rig.drives[0]->plant().position = 20 * kIncrementsPerMm;
  rig.bring_up();
  EXPECT_TRUE(x_is_homed(rig));
  rig.drives[0]->plant().encoder_at = -kTurn / 2;
  rig.step(2);
  rig.drives[0]->plant().encoder_at.reset();
  rig.step(10);
  EXPECT_NE(rig.alarms().find(kText), std::string::npos) << rig.alarms();
  EXPECT_FALSE(x_is_homed(rig));
  ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(rig.until([&] { return rig.following() && rig.alarms().empty(); }, 3000)) << rig.alarms();
  EXPECT_TRUE(x_is_homed(rig));
  EXPECT_NEAR(rig.actual(0), 20, 0.001);
}

// A rotary axis turns on for years: its counter overflows, and that is no jump.
TEST(PositionCount, WhereTheCounterOverflowsItGoesOn) {
  for (const double way : {1.0, -1.0}) {
    SCOPED_TRACE(way);
    std::string text = can_toml();
    for (std::size_t at = 0; (at = text.find("soft_limits = [-500.0, 500.0]\n", at)) != std::string::npos;) text.erase(at, 30);
    CanRig rig(text);
    const double from = way * (kTurn / 2 - 5 * kIncrementsPerMm);
    rig.drives[0]->plant().position = from;
    rig.bring_up();
    ASSERT_EQ(rig.mdi(std::string("G91 G00 X") + (way > 0 ? "" : "-") + "40."), Answer::kDone) << rig.alarms();
    rig.step(20);
    ASSERT_TRUE(rig.until([&] { return rig.idle(); }, 5000)) << rig.alarms();
    rig.step(20);
    EXPECT_EQ(rig.alarms(), "");
    EXPECT_NEAR(rig.actual(0), from / kIncrementsPerMm + way * 40, 0.001);
  }
}

// A drive that comes back counts from its own zero, and its axis comes on where it says that it is.
TEST(PositionCount, ADriveThatComesBackCountsFromItsOwnZero) {
  CanRig rig(homed_where_it_stands());
  rig.bring_up();
  home(&rig);
  rig.drives[0]->power_cycle();
  rig.drives[0]->plant().position = -300 * kIncrementsPerMm;
  ASSERT_TRUE(rig.until([&] { return rig.alarms().find("started anew") != std::string::npos; }, 100)) << rig.alarms();
  ASSERT_TRUE(rig.until([&] { return rig.machine->service().all_operational(); }, 9000)) << rig.said();
  rig.step(20);
  EXPECT_EQ(rig.alarms().find("jumped"), std::string::npos) << rig.alarms();
  EXPECT_FALSE(x_is_homed(rig));
  ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(rig.until([&] { return rig.following() && rig.alarms().empty(); }, 3000)) << rig.alarms();
  EXPECT_NEAR(rig.actual(0), -300, 0.001);
}

// At the largest velocity, with answers that are lost or late.
TEST(PositionCount, RapidWithLostAnswersIsNoJump) {
  CanRig rig;
  rig.bring_up();
  ASSERT_EQ(rig.mdi("G90 G00 X400. Y-400. Z400."), Answer::kDone);
  for (unsigned i = 0; i < 6000 && !(i > 20 && rig.idle()); ++i) {
    rig.drives[0]->no_tpdo = i % 3 != 0;
    rig.drives[1]->no_tpdo = i % 2 == 0;
    rig.step();
  }
  EXPECT_TRUE(rig.idle());
  EXPECT_EQ(rig.alarms(), "");
}

}  // namespace
