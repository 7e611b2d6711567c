// SPDX-License-Identifier: Apache-2.0
// Homing by the drive, and its touch probe.
#include <gtest/gtest.h>

#include "can_rig.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::test::can_toml;
using nc::test::CanRig;

constexpr const char* kHoming =
    "homing = { method = 17, fast = 20.0, slow = 2.0, acceleration = 200.0, position = -30.0, request = \"home_x\", done = \"x_homed\", timeout_s = 5.0 }\n";

TEST(CanFunctions, TheDriveHomesAndTheControlIsWhereItSays) {
  CanRig rig(can_toml("", kHoming));
  rig.bring_up();
  EXPECT_EQ(rig.drives[0]->object(0x6098, 0), 17u);
  EXPECT_EQ(rig.drives[0]->object(0x6099, 1), 40'000u);
  EXPECT_EQ(rig.drives[0]->object(0x607C, 0), 0u);
  ASSERT_EQ(rig.mdi("#1100 = 1"), Answer::kDone);
  rig.step(200);
  EXPECT_EQ(rig.drives[0]->object(0x6061, 0), 8u);  // back in cyclic position
  ASSERT_TRUE(rig.until([&] { return rig.following() && rig.idle(); }, 3000)) << rig.alarms();
  rig.step(10);
  EXPECT_EQ(rig.alarms(), "");
  EXPECT_NEAR(rig.command(0), -30.0, 0.001);
  EXPECT_NEAR(rig.plant_mm(0), 0.0, 0.001);
  EXPECT_EQ(rig.runtime->snapshot().interface_input[0] & 1u, 1u);  // x_homed
  ASSERT_EQ(rig.mdi("G90 G01 X0. F6000"), Answer::kDone);
  rig.step(20);
  ASSERT_TRUE(rig.until([&] { return rig.idle(); }, 3000));
  rig.step(20);
  EXPECT_NEAR(rig.plant_mm(0), 30.0, 0.001);
}

// CiA 402 adds the home offset to the mark to get the zero (6064h = -607Ch at the mark), and many makers have 6064h = 607Ch there.
TEST(CanFunctions, TheMarkIsWhereItIsWhicheverSignTheDriveGivesItsOffset) {
  for (const bool subtracts : {false, true}) {
    SCOPED_TRACE(subtracts);
    CanRig rig(can_toml("", kHoming));
    rig.drives[0]->offset_subtracts = subtracts;
    rig.bring_up();
    ASSERT_EQ(rig.mdi("#1100 = 1"), Answer::kDone);
    rig.step(200);
    ASSERT_TRUE(rig.until([&] { return rig.following() && rig.idle(); }, 3000)) << rig.alarms();
    rig.step(10);
    EXPECT_NEAR(rig.command(0), -30.0, 0.001);
    EXPECT_NEAR(rig.actual(0), -30.0, 0.001);
  }
}

// CiA 402 lets a drive be without a home offset: then it is 0, which is all that the control asks for. One that cannot be set may be another value.
TEST(CanFunctions, ADriveWithoutAHomeOffsetHomesAllTheSame) {
  CanRig rig(can_toml("", kHoming));
  rig.drives[0]->remove_object(0x607C, 0);
  rig.bring_up();
  ASSERT_EQ(rig.mdi("#1100 = 1"), Answer::kDone);
  rig.step(200);
  ASSERT_TRUE(rig.until([&] { return rig.following() && rig.idle(); }, 3000)) << rig.alarms();
  rig.step(10);
  EXPECT_NEAR(rig.command(0), -30.0, 0.001);
  EXPECT_EQ(rig.alarms(), "");
}

TEST(CanFunctions, AHomeOffsetThatCannotBeSetIsRefused) {
  for (const auto& [code, text] : {std::pair{0x06010002u, "the object can only be read"}, {0x08000022u, "not now: the state of the device forbids it"}, {0x06090011u, "the sub-index does not exist"}}) {
    CanRig rig(can_toml("", kHoming));
    rig.drives[0]->refuses[0x607C00] = code;
    EXPECT_FALSE(rig.boot(3000));
    EXPECT_NE(rig.machine->service().missing().find(std::string("node 1 (X drive): 607Ch:0: ") + text + " (written: 0h)"), std::string::npos) << rig.machine->service().missing();
  }
}

// So is its acceleration, which is the drive's own where the file gives none.
TEST(CanFunctions, WithoutAnAccelerationOfItsHomingTheDriveKeepsItsOwn) {
  std::string homing = kHoming;
  homing.replace(homing.find("acceleration = 200.0, "), 22, "");
  CanRig rig(can_toml("", homing));
  rig.drives[0]->remove_object(0x609A, 0);
  rig.bring_up();
  CanRig given(can_toml("", kHoming));
  given.drives[0]->remove_object(0x609A, 0);
  EXPECT_FALSE(given.boot(3000));
  EXPECT_NE(given.machine->service().missing().find("609Ah:0: the object does not exist"), std::string::npos) << given.machine->service().missing();
}

// ---- the control asks for it: homing of the axis itself, docs/homing.md ----

// Y has its servo off while X is homed.
std::string asked_by_the_control() {
  std::string text = can_toml("", kHoming);
  const auto replace = [&text](const std::string& from, const std::string& to) {
    ASSERT_NE(text.find(from), std::string::npos);
    text.replace(text.find(from), from.size(), to);
  };
  replace("[macro_interface]\n\"#1100\" = \"home_x\"\n\"#1000\" = \"x_homed\"\n", "[signals]\n\"plc.servo_off.Y\" = \"x_homed\"\n");
  replace("soft_limits = [-500.0, 500.0]\n", "soft_limits = [-500.0, 500.0]\nhoming = { kind = \"drive\", request = \"home_x\", done = \"x_homed\" }\n");
  return text;
}

Answer home_all(CanRig* rig) {
  nc::rt::Command home;
  home.kind = CommandKind::kHome;
  home.system = nc::rt::kAllSystems;
  return rig->runtime->execute(home);
}

TEST(CanFunctions, TheControlAsksTheDriveAndWatchesWhatIsNotHomed) {
  CanRig rig(asked_by_the_control());
  rig.bring_up();
  EXPECT_EQ(rig.mdi("G90 G01 X0. F6000"), Answer::kNotHomed);
  ASSERT_EQ(rig.run(CommandKind::kSetMode, static_cast<std::uint32_t>(nc::rt::Mode::kManual)), Answer::kDone);
  const auto flags = [&] { return rig.runtime->snapshot().system[0].axes; };
  EXPECT_EQ(flags().homed, 0b110u);
  for (int times = 0; times < 2; ++times) {  // also again: what the drive has said before does not count
    ASSERT_EQ(home_all(&rig), Answer::kDone);
    rig.step(5);
    EXPECT_EQ(flags().homing, 1u);
    ASSERT_TRUE(rig.until([&] { return flags().homing == 0; }, 3000)) << rig.alarms();
    EXPECT_EQ(rig.alarms(), "");
    EXPECT_EQ(flags().homed, 0b111u);
    rig.step(30);
    EXPECT_NEAR(rig.command(0), -30.0, 0.001);
    EXPECT_NEAR(rig.plant_mm(0), 0.0, 0.001);
  }
}

// A drive clears "homing attained" of the homing before when it begins, and that may be late.
TEST(CanFunctions, WhatADriveHasSaidOfTheHomingBeforeDoesNotCount) {
  CanRig rig(asked_by_the_control());
  rig.bring_up();
  ASSERT_EQ(rig.run(CommandKind::kSetMode, static_cast<std::uint32_t>(nc::rt::Mode::kManual)), Answer::kDone);
  const auto flags = [&] { return rig.runtime->snapshot().system[0].axes; };
  const auto homes = [&] {
    ASSERT_EQ(home_all(&rig), Answer::kDone) << rig.alarms();
    rig.step(5);
    ASSERT_TRUE(rig.until([&] { return flags().homing == 0; }, 6000)) << rig.alarms();
  };
  homes();
  ASSERT_EQ(flags().homed, 0b111u) << rig.alarms();
  for (const int begins : {0, 1, 9, 10, 11, 100, 1500}) {
    SCOPED_TRACE(begins);
    rig.step(100);
    rig.drives[0]->homing_begins = begins;
    rig.drives[0]->plant().position += 5 * nc::test::kIncrementsPerMm;  // its encoder has slipped
    rig.step(100);
    homes();
    EXPECT_EQ(rig.alarms(), "");
    EXPECT_EQ(flags().homed, 0b111u);
    rig.step(30);
    EXPECT_NEAR(rig.plant_mm(0), 0.0, 0.001) << "it counts as homed, and has not found its mark";
  }
  rig.step(100);
  rig.drives[0]->homing_begins = -1;
  homes();
  EXPECT_NE(rig.alarms().find("its homing does not begin"), std::string::npos) << rig.alarms();
  EXPECT_EQ(flags().homed, 0b110u);
}

// Its place becomes the mark: that may be over between two SYNCs, so nothing of it is seen in the status but its end.
TEST(CanFunctions, ADriveThatHomesWhereItStandsMayDoThatAtOnce) {
  std::string text = asked_by_the_control();
  text.replace(text.find("method = 17"), 11, "method = 37");
  CanRig rig(text);
  rig.drives[0]->homing_syncs = 1;
  rig.bring_up();
  ASSERT_EQ(rig.run(CommandKind::kSetMode, static_cast<std::uint32_t>(nc::rt::Mode::kManual)), Answer::kDone);
  for (int times = 0; times < 3; ++times) {
    SCOPED_TRACE(times);
    rig.step(100);
    rig.drives[0]->plant().position += 5 * nc::test::kIncrementsPerMm;
    rig.step(100);
    ASSERT_EQ(home_all(&rig), Answer::kDone) << rig.alarms();
    rig.step(5);
    ASSERT_TRUE(rig.until([&] { return rig.runtime->snapshot().system[0].axes.homing == 0; }, 6000)) << rig.alarms();
    EXPECT_EQ(rig.alarms(), "");
    rig.step(30);
    EXPECT_NEAR(rig.plant_mm(0), 0.0, 0.001);
    EXPECT_NEAR(rig.command(0), -30.0, 0.001);
  }
}

TEST(CanFunctions, OneDriveGoesOffAndItsPositionIsFollowed) {
  CanRig rig(asked_by_the_control());
  rig.bring_up();
  ASSERT_EQ(rig.run(CommandKind::kSetMode, static_cast<std::uint32_t>(nc::rt::Mode::kManual)), Answer::kDone);
  EXPECT_TRUE(rig.drives[1]->enabled());
  ASSERT_EQ(home_all(&rig), Answer::kDone);
  ASSERT_TRUE(rig.until([&] { return rig.runtime->snapshot().system[0].axes.homed == 7; }, 3000)) << rig.alarms();
  rig.step(300);
  EXPECT_TRUE(rig.drives[0]->enabled());
  EXPECT_FALSE(rig.drives[1]->enabled());
  EXPECT_TRUE(rig.drives[2]->enabled());
  EXPECT_EQ(rig.alarms(), "") << "it was asked for, and is no fault";
  for (unsigned i = 0; i < 30; ++i) {
    rig.drives[1]->plant().position += 0.1 * nc::test::kIncrementsPerMm;  // someone turns it
    rig.step();
  }
  rig.step(50);
  EXPECT_EQ(rig.alarms(), "");
  EXPECT_NEAR(rig.command(1), 3.0, 0.001);
  EXPECT_NEAR(rig.command(0), -30.0, 0.001) << "the others stay where they are";
}

TEST(CanFunctions, NothingStartsWhileADriveHomes) {
  CanRig rig(can_toml("", kHoming));
  rig.bring_up();
  ASSERT_EQ(rig.mdi("#1100 = 1"), Answer::kDone);
  ASSERT_TRUE(rig.until([&] { return !rig.following(); }, 300));
  EXPECT_EQ(rig.mdi("G01 Y5. F600"), Answer::kDrivesOff);
}

// A drive that loses its power while it homes comes back in the mode cyclic position.
TEST(CanFunctions, ADriveThatIsLostWhileItHomesComesBack) {
  CanRig rig(can_toml("", kHoming));
  rig.bring_up();
  ASSERT_EQ(rig.mdi("#1100 = 1"), Answer::kDone);
  ASSERT_TRUE(rig.until([&] { return rig.drives[0]->object(0x6061, 0) == 6; }, 300));
  ASSERT_EQ(rig.runtime->execute(CommandKind::kReset), Answer::kDone);
  rig.drives[0]->dead = true;
  rig.step(2000);
  rig.drives[0]->power_cycle();
  ASSERT_TRUE(rig.until([&] { return rig.machine->cyclic().ready(); }, 9000)) << rig.said();
  EXPECT_EQ(rig.drives[0]->object(0x6061, 0), 8u);
  ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(rig.until([&] { return rig.following(); }, 3000)) << rig.alarms() << rig.said();
}

// The axis of an interrupted program cannot be homed.
TEST(CanFunctions, NothingHomesInAProgram) {
  CanRig rig(can_toml("", kHoming));
  rig.bring_up();
  ASSERT_EQ(rig.mdi("#1100 = 1\nG90 G01 X50. F3000\nM00\nX60."), Answer::kDone);
  ASSERT_TRUE(rig.until([&] { return rig.runtime->snapshot().system[0].nc.state == NC_STATE_STOPPED; }, 5000)) << rig.alarms();
  rig.step(300);
  EXPECT_TRUE(rig.following());
  EXPECT_EQ(rig.drives[0]->object(0x6061, 0), 8u);
  EXPECT_NEAR(rig.command(0), 50.0, 0.001);
}

TEST(CanFunctions, AHomingThatFailsIsAFaultOfItsAxis) {
  CanRig rig(can_toml("", kHoming));
  rig.drives[0]->homing_fails = true;
  rig.bring_up();
  ASSERT_EQ(rig.mdi("#1100 = 1"), Answer::kDone);
  rig.step(400);
  EXPECT_NE(rig.alarms().find("its homing has failed, axis X"), std::string::npos) << rig.alarms();
  EXPECT_EQ(rig.runtime->snapshot().interface_input[0] & 1u, 0u);
}

TEST(CanFunctions, ATouchProbeIsASkipSignalAndIsReadyAgain) {
  CanRig rig(can_toml("sync_us = 2000\n", "probe = { skip_signal = 1 }\n"));
  rig.bring_up();
  rig.step(50);
  for (int edge = 0; edge < 2; ++edge) {
    const double target = edge == 0 ? 100 : 0;
    ASSERT_EQ(rig.mdi("G90 G31 X" + std::to_string(target) + " F3000"), Answer::kDone);
    rig.step(300);
    ASSERT_FALSE(rig.idle());
    rig.drives[0]->probe_edge();
    const double at = rig.plant_mm(0);
    rig.step(5);
    ASSERT_TRUE(rig.until([&] { return rig.idle(); }, 1000)) << rig.alarms();
    EXPECT_LT(std::abs(rig.plant_mm(0) - at), 3.0) << edge;  // it has stopped near that place
    rig.step(200);
  }
  EXPECT_EQ(rig.alarms(), "");
}

constexpr const char* kSkipMove = "G90 G31 X100. Y50. F3354\n#500=#5061\n#501=#5062";

double common(CanRig* rig, unsigned number) {
  double value = 0;
  bool vacant = true;
  EXPECT_EQ(nc_variable_get(rig->runtime->control(), 0, number, &value, &vacant), NC_OK);
  EXPECT_FALSE(vacant);
  return value;
}

// The edge comes in the middle between two SYNCs, at 50 mm/s and a lag of the motor: the program gets the place that the drive has latched, and for the
// other axes the place where they were then. The measured place would be 0.05 mm farther, the commanded one more.
TEST(CanFunctions, ASkipMoveHasThePlaceThatTheDriveHasLatched) {
  CanRig rig(can_toml("sync_us = 2000\n", "probe = { skip_signal = 1 }\n"));
  for (auto& drive : rig.drives) drive->plant().lag = 0.5;
  rig.bring_up();
  rig.step(50);
  ASSERT_EQ(rig.mdi(kSkipMove), Answer::kDone);
  rig.step(300);
  ASSERT_FALSE(rig.idle());
  double x[2] = {}, y[2] = {};
  for (double& place : x) {
    y[&place - x] = rig.plant_mm(1);
    place = rig.plant_mm(0);
    if (&place == x) rig.step(2);
  }
  ASSERT_NEAR(x[1] - x[0], 0.1, 0.001);
  const double edge = x[0] + 0.75 * (x[1] - x[0]);
  rig.drives[0]->probe_edge(0, std::lround(edge * nc::test::kIncrementsPerMm));
  ASSERT_TRUE(rig.until([&] { return rig.idle(); }, 1000)) << rig.alarms();
  EXPECT_NEAR(common(&rig, 500), edge, 0.0006);
  EXPECT_NEAR(common(&rig, 501), y[0] + 0.75 * (y[1] - y[0]), 0.0012);
  EXPECT_EQ(rig.alarms(), "");
}

// The same where the other drive's answer to that SYNC is late, and comes with the next one: the signal waits for it. With the last position that was known Y would be
// up to a SYNC's way beside the line.
TEST(CanFunctions, ASkipSignalWaitsForTheAnswerThatSaysWhereTheOtherAxisWas) {
  CanRig rig(can_toml("sync_us = 2000\n", "probe = { skip_signal = 1 }\n"));
  rig.bring_up();
  rig.step(50);
  ASSERT_EQ(rig.mdi(kSkipMove), Answer::kDone);
  rig.step(300);
  ASSERT_FALSE(rig.idle());
  const double x = rig.plant_mm(0), y = rig.plant_mm(1);
  int of_y = 0;
  rig.bus.late = [&of_y](const nc::hal::canopen::CanFrame& frame) { return frame.id == 0x182 && of_y++ == 0 ? 2u : 0u; };
  rig.step(2);
  const double x1 = rig.plant_mm(0), y1 = rig.plant_mm(1);
  ASSERT_NEAR(x1 - x, 0.1, 0.001);
  ASSERT_EQ(of_y, 1);
  rig.drives[0]->probe_edge(0, std::lround((x + 0.25 * (x1 - x)) * nc::test::kIncrementsPerMm));
  ASSERT_TRUE(rig.until([&] { return rig.idle(); }, 1000)) << rig.alarms();
  EXPECT_GT(of_y, 10);
  EXPECT_NEAR(common(&rig, 500), x + 0.25 * (x1 - x), 0.0006);
  EXPECT_NEAR(common(&rig, 501), y + 0.25 * (y1 - y), 0.0012);
  EXPECT_EQ(rig.alarms(), "");
}

constexpr unsigned kNever = 1'000'000;  // cycles of the bus

// Where a skip move at 44.7 mm/s in X and 22.4 in Y has found its edge, a quarter of the way behind a SYNC.
struct SkipOfTwo {
  // `late`: as of LoopbackBus, of an answer from the SYNC of the edge on, where it is the n-th of its axis.
  template <class Late>
  SkipOfTwo(Late late, bool from_the_start = false) : rig(can_toml("sync_us = 2000\n", "probe = { skip_signal = 1 }\n")) {
    const auto delay = [this, late](const nc::hal::canopen::CanFrame& frame) { return late(frame.id, frame.id == 0x180 + kOf[0] ? of[0]++ : frame.id == 0x180 + kOf[1] ? of[1]++ : 0); };
    if (from_the_start) rig.bus.late = delay;
    rig.bring_up();
    rig.step(50);
    EXPECT_EQ(rig.mdi(kSkipMove), Answer::kDone);
    rig.step(300);
    EXPECT_FALSE(rig.idle());
    const double x = rig.plant_mm(0), y = rig.plant_mm(1);
    rig.bus.late = delay;
    rig.step(2);
    const double x1 = rig.plant_mm(0), y1 = rig.plant_mm(1);
    EXPECT_NEAR(x1 - x, 0.08944, 0.0115);
    edge[0] = x + 0.25 * (x1 - x);
    edge[1] = y + 0.25 * (y1 - y);
    way_of_y = y1 - y;
    rig.drives[0]->probe_edge(0, std::lround(edge[0] * nc::test::kIncrementsPerMm));
    EXPECT_TRUE(rig.until([&] { return rig.idle(); }, 1000)) << rig.alarms();
    EXPECT_EQ(rig.alarms(), "");
    found[0] = common(&rig, 500);
    found[1] = common(&rig, 501);
  }
  static constexpr unsigned kOf[2] = {1, 2};
  CanRig rig;
  unsigned of[2] = {};
  double edge[2] = {}, found[2] = {}, way_of_y = 0;
};

// An answer that never comes: the axis was on the line between the one before and the one behind.
TEST(CanFunctions, ASkipSignalWaitsForTheAnswerBehindOneThatIsLost) {
  for (const unsigned lost : {1u, 2u}) {  // lost_after is 3
    SCOPED_TRACE(lost);
    SkipOfTwo of_y([lost](unsigned id, unsigned n) { return id == 0x182 && n < lost ? kNever : 0u; });
    EXPECT_NEAR(of_y.found[0], of_y.edge[0], 0.0006);
    EXPECT_NEAR(of_y.found[1], of_y.edge[1], 0.0012);
    SkipOfTwo of_x([lost](unsigned id, unsigned n) { return id == 0x181 && n < lost ? kNever : 0u; });  // the axis of the probe
    EXPECT_NEAR(of_x.found[0], of_x.edge[0], 0.0006);
    EXPECT_NEAR(of_x.found[1], of_x.edge[1], 0.0012);
    SkipOfTwo of_both([lost](unsigned id, unsigned n) { return (id == 0x181 || id == 0x182) && n < lost ? kNever : 0u; });
    EXPECT_NEAR(of_both.found[0], of_both.edge[0], 0.0006);
    EXPECT_NEAR(of_both.found[1], of_both.edge[1], 0.0012);
  }
}

// Drives on a busy line, which answer by turns: no SYNC has the answers of all, and the edge has its place, however long that goes on.
TEST(CanFunctions, ASkipSignalWaitsForNoSyncThatHasAllAnswers) {
  for (const unsigned syncs : {4u, 40u, 90u}) {
    SCOPED_TRACE(syncs);
    SkipOfTwo by_turns([syncs](unsigned id, unsigned n) {
      const bool of_x = id == 0x181 && n % 2 == 0, of_y = id == 0x182 && n % 2 == 1;
      return n > 0 && n < syncs && (of_x || of_y) ? kNever : 0u;
    });
    EXPECT_NEAR(by_turns.found[0], by_turns.edge[0], 0.0006);
    EXPECT_NEAR(by_turns.found[1], by_turns.edge[1], 0.0012);
  }
}

// An answer that is always late is taken for that to the next SYNC: nothing in it says to which it is. Where all are late alike, as through a slow adapter, they belong together.
TEST(CanFunctions, ASkipPositionWithAnswersThatAreAlwaysLate) {
  SkipOfTwo all([](unsigned id, unsigned) { return id >= 0x180 && id < 0x500 ? 2u : 0u; }, true);
  EXPECT_NEAR(all.found[0], all.edge[0], 0.0006);
  EXPECT_NEAR(all.found[1], all.edge[1], 0.0012);
  SkipOfTwo of_y([](unsigned id, unsigned) { return id == 0x182 ? 2u : 0u; }, true);
  EXPECT_NEAR(of_y.found[0], of_y.edge[0], 0.0006);
  EXPECT_NEAR(of_y.found[1], of_y.edge[1] - of_y.way_of_y, 0.0012) << "off by its way in a SYNC (docs/canopen.md, Touch probe)";
}

// A probe that is wired to all drives: each latches its own axis.
TEST(CanFunctions, EachDriveOfTheSignalLatchesItsOwnAxis) {
  std::string toml = can_toml("sync_us = 2000\n", "probe = { skip_signal = 1 }\n");
  toml.insert(toml.find("[[canopen.drive]]\nname = \"Z"), "probe = { skip_signal = 1 }\n");
  CanRig rig(toml);
  rig.bring_up();
  rig.step(50);
  ASSERT_EQ(rig.mdi(kSkipMove), Answer::kDone);
  rig.step(300);
  const double x = rig.plant_mm(0), y = rig.plant_mm(1);
  rig.drives[0]->probe_edge(0, std::lround((x - 0.02) * nc::test::kIncrementsPerMm));
  rig.drives[1]->probe_edge(0, std::lround((y + 0.004) * nc::test::kIncrementsPerMm));  // not where the line was
  ASSERT_TRUE(rig.until([&] { return rig.idle(); }, 1000)) << rig.alarms();
  EXPECT_NEAR(common(&rig, 500), x - 0.02, 0.0006);
  EXPECT_NEAR(common(&rig, 501), y + 0.004, 0.0006);
}

// What is no place of the last SYNCs, because 60BAh counts in another unit, would be a wrong measure: it is a fault.
TEST(CanFunctions, APlaceWhereTheAxisWasNotIsAFault) {
  CanRig rig(can_toml("sync_us = 2000\n", "probe = { skip_signal = 1 }\n"));
  rig.bring_up();
  rig.step(50);
  ASSERT_EQ(rig.mdi("G90 G31 X100. F3000"), Answer::kDone);
  rig.step(300);
  rig.drives[0]->probe_edge(0, 7);
  rig.step(400);
  EXPECT_NE(rig.alarms().find("its touch probe has latched a place at which the axis was not, axis X"), std::string::npos) << rig.alarms();
}

}  // namespace
