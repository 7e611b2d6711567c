// SPDX-License-Identifier: Apache-2.0
// Faults on a bus of drives: each one stops the axes and raises an alarm that names it. When its cause is gone the machine runs again after a reset,
// but nothing moves before the operator starts it.
#include <gtest/gtest.h>

#include <regex>

#include "can_rig.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::test::can_toml;
using nc::test::CanRig;

void expect_in(const std::string& text, const std::string& part) { EXPECT_NE(text.find(part), std::string::npos) << "\"" << part << "\" is not in: " << text; }

// Starts a long move, and runs to its middle.
void start_moving(CanRig* rig) {
  rig->bring_up();
  ASSERT_EQ(rig->mdi("G90 G01 X300. Y150. Z60. F9000"), Answer::kDone);
  rig->step(300);
  ASSERT_FALSE(rig->idle());
  ASSERT_GT(rig->plant_mm(0), 5.0);
}

bool plants_stand(CanRig* rig) {
  const double x = rig->plant_mm(0), y = rig->plant_mm(1), z = rig->plant_mm(2);
  rig->step(5);
  return rig->plant_mm(0) == x && rig->plant_mm(1) == y && rig->plant_mm(2) == z;
}

// Expects that all axes stop with this alarm, and stay at rest without the operator.
void expect_stopped(CanRig* rig, const std::string& alarm) {
  EXPECT_TRUE(rig->until([&] { return plants_stand(rig); }, 400));
  expect_in(rig->alarms(), alarm);
  EXPECT_EQ(rig->run(CommandKind::kCycleStart), Answer::kAlarmActive);
  const double x = rig->plant_mm(0);
  rig->step(500);
  EXPECT_EQ(rig->plant_mm(0), x);
}

// Expects that after a reset nothing moves, and that a program then runs to its end.
void expect_runs_again(CanRig* rig) {
  ASSERT_EQ(rig->run(CommandKind::kReset), Answer::kDone);
  const double x = rig->plant_mm(0);
  ASSERT_TRUE(rig->until([&] { return rig->following(); }, 3000)) << rig->alarms() << rig->said();
  rig->step(50);
  EXPECT_EQ(rig->alarms(), "");
  EXPECT_NEAR(rig->plant_mm(0), x, 0.001);  // nothing has moved by itself
  ASSERT_EQ(rig->mdi("G90 G01 X1. Y2. Z3. F9000"), Answer::kDone);
  rig->step(20);
  ASSERT_TRUE(rig->until([&] { return rig->idle(); }, 9000)) << rig->alarms();
  rig->step(20);
  EXPECT_NEAR(rig->plant_mm(0), 1.0, 0.001);
  EXPECT_NEAR(rig->plant_mm(2), 3.0, 0.001);
}

TEST(CanFault, AFaultOfADriveIsAnAlarmWithTheTextOfItsEmergency) {
  CanRig rig;
  start_moving(&rig);
  rig.drives[1]->trip(0, 0x3210, 0x05);
  rig.step(3);
  expect_stopped(&rig, "R12 Drive fault: EMCY 3210h: DC link over-voltage (error register 05h), axis Y");
  expect_runs_again(&rig);
}

TEST(CanFault, ASilentHeartbeatStopsTheOthersToo) {
  CanRig rig;
  start_moving(&rig);
  rig.drives[2]->no_heartbeat = true;
  rig.step(400);
  expect_stopped(&rig, "R12 Drive fault: its heartbeat does not come, axis Z");
  rig.drives[2]->no_heartbeat = false;
  ASSERT_TRUE(rig.until([&] { return rig.machine->service().all_operational(); }, 9000)) << rig.said();
  expect_runs_again(&rig);
}

TEST(CanFault, ADriveThatLosesItsPowerComesBackIntoServiceBehindAReset) {
  CanRig rig;
  start_moving(&rig);
  rig.drives[0]->dead = true;
  rig.step(10);
  expect_in(rig.alarms(), "its positions do not come, axis X");
  rig.step(2000);
  rig.drives[0]->power_cycle();
  ASSERT_TRUE(rig.until([&] { return rig.machine->service().all_operational(); }, 9000)) << rig.said();
  expect_runs_again(&rig);
}

TEST(CanFault, ANodeThatBeginsAnewByItselfIsAFault) {
  CanRig rig;
  start_moving(&rig);
  rig.drives[0]->power_cycle();
  rig.step(5);
  expect_stopped(&rig, "its node has started anew by itself, axis X");
  ASSERT_TRUE(rig.until([&] { return rig.machine->service().all_operational(); }, 9000)) << rig.said();
  expect_runs_again(&rig);
}

TEST(CanFault, ANodeThatCannotBeSetUpAgainIsNamedBehindAReset) {
  CanRig rig;
  start_moving(&rig);
  rig.drives[0]->refuses[0x6060u << 8] = 0x06090030;  // it takes no mode any more: value range exceeded
  rig.drives[0]->power_cycle();
  rig.step(5);
  expect_stopped(&rig, "its node has started anew by itself, axis X");
  ASSERT_TRUE(rig.until([&] { return rig.said().find("6060h:0: the value is out of its range") != std::string::npos; }, 9000)) << rig.said();
  ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
  rig.step(500);
  expect_in(rig.alarms(), "its node cannot be set up, the log says why, axis X");
  EXPECT_EQ(rig.run(CommandKind::kCycleStart), Answer::kAlarmActive);
  rig.drives[0]->refuses.clear();  // repaired
  ASSERT_TRUE(rig.until([&] { return rig.machine->service().all_operational(); }, 9000)) << rig.said();
  expect_runs_again(&rig);
}

TEST(CanFault, PositionsThatDoNotComeStopTheAxes) {
  CanRig rig;
  start_moving(&rig);
  rig.drives[1]->no_tpdo = true;
  rig.step(8);
  expect_in(rig.alarms(), "R12 Drive fault: its positions do not come, axis Y");
  rig.step(100);
  EXPECT_FALSE(rig.drives[0]->enabled());
  rig.drives[1]->no_tpdo = false;
  rig.step(10);
  expect_runs_again(&rig);
}

bool is_position_of_y(const nc::hal::canopen::CanFrame& frame) { return frame.id == 0x182; }

// Its positions come in bursts, as those of a drive with a busy processor or of a gateway do: never more than there were SYNCs.
TEST(CanFault, PositionsThatComeLateAndTogetherAreNotTwoNodes) {
  CanRig rig;
  start_moving(&rig);
  std::vector<nc::hal::canopen::CanFrame> held;
  unsigned frames = 0;
  rig.drives[1]->out = [&held, &frames, send = rig.drives[1]->out](const nc::hal::canopen::CanFrame& frame) {
    if (!is_position_of_y(frame)) return send(frame);
    held.push_back(frame);
    if (++frames % 3 != 0) return;
    for (const auto& late : held) send(late);
    held.clear();
  };
  rig.step(600);
  EXPECT_EQ(rig.alarms(), "");
  ASSERT_TRUE(rig.until([&] { return rig.idle(); }, 9000)) << rig.alarms();
  EXPECT_NEAR(rig.plant_mm(1), 150.0, 0.001);
}

TEST(CanFault, TwoNodesUnderOneNumberStopTheAxes) {
  CanRig rig;
  start_moving(&rig);
  rig.drives[1]->out = [send = rig.drives[1]->out](const nc::hal::canopen::CanFrame& frame) {
    send(frame);
    if (is_position_of_y(frame)) send(frame);
  };
  rig.step(30);
  expect_in(rig.alarms(), "R12 Drive fault: two nodes send under its identifier, axis Y");
  expect_stopped(&rig, "R12");
}

TEST(CanFault, ABlockedAxisIsAFollowingError) {
  CanRig rig;
  start_moving(&rig);
  rig.drives[0]->plant().blocked = true;
  rig.step(60);
  expect_in(rig.alarms(), "R11 Following error beyond its limit, axis X");
  rig.drives[0]->plant().blocked = false;
}

TEST(CanFault, TheDrivesOwnFollowingErrorIsToldAsItsEmergency) {
  CanRig rig(can_toml("", "", "objects = [{ index = 0x6065, value = 1000 }]\n"));  // 0.5 mm, less than the limit of the control
  start_moving(&rig);
  EXPECT_EQ(rig.drives[0]->object(0x6065, 0), 1000u);
  rig.drives[0]->plant().blocked = true;
  rig.step(60);
  expect_in(rig.alarms(), "EMCY 8611h: following error (error register 21h), axis X");
}

TEST(CanFault, ADriveThatIsSwitchedOffByItsSafetyInputIsAFault) {
  CanRig rig;
  start_moving(&rig);
  rig.drives[1]->leave_enabled(0);
  rig.step(5);
  expect_stopped(&rig, "it has left \"operation enabled\" by itself, axis Y");
  expect_runs_again(&rig);
}

TEST(CanFault, ADriveThatFaultsAtEnablingIsNamedAtTheStart) {
  CanRig rig;
  rig.drives[1]->faults_at_enabling = true;
  ASSERT_TRUE(rig.boot()) << rig.said();
  rig.make_runtime();
  rig.step(300);
  expect_in(rig.alarms(), "EMCY 2310h: continuous over current (error register 03h), axis Y");
  EXPECT_EQ(rig.mdi("G01 X1. F100"), Answer::kAlarmActive);
  rig.drives[1]->faults_at_enabling = false;
  expect_runs_again(&rig);
}

TEST(CanFault, ADriveThatDoesNotComeOnIsNamed) {
  CanRig rig;
  rig.drives[2]->never_enables = true;
  ASSERT_TRUE(rig.boot()) << rig.said();
  rig.make_runtime();
  rig.step(100);
  EXPECT_EQ(rig.mdi("G01 X1. F100"), Answer::kDrivesOff);
  rig.step(3200);
  expect_in(rig.alarms(), "it does not come to \"operation enabled\", axis Z");
}

TEST(CanFault, WithTheBusOffTheDrivesStopByThemselvesAndComeBack) {
  CanRig rig;
  start_moving(&rig);
  rig.bus.go_off();
  rig.step(5);
  expect_in(rig.alarms(), "R14 No connection to the machine");
  rig.step(1000);
  rig.bus.come_back();
  ASSERT_TRUE(rig.until([&] { return rig.machine->service().all_operational(); }, 9000)) << rig.said();
  expect_runs_again(&rig);
}

TEST(CanFault, AScanThatGivesNoPositionsStopsTheAxes) {
  CanRig rig;
  start_moving(&rig);
  for (int i = 0; i < 25; ++i) rig.bus_step();  // the bus goes on, the scan does not
  for (int i = 0; i < 200; ++i) rig.bus_step();
  for (unsigned n = 0; n < 3; ++n) EXPECT_FALSE(rig.drives[n]->enabled()) << n;
  rig.step(5);
  expect_in(rig.alarms(), "the scan has given no positions in time");
}

TEST(CanFault, AScanThatIsLateByOneCycleIsBridged) {
  CanRig rig;
  start_moving(&rig);
  const double before = rig.plant_mm(0);
  rig.step(1);
  const double per_cycle = rig.plant_mm(0) - before;
  const double at = rig.plant_mm(0);
  rig.bus_step();  // without a scan
  EXPECT_NEAR(rig.plant_mm(0) - at, per_cycle, 0.01);
  rig.step(50);
  EXPECT_EQ(rig.alarms(), "");
}

// The time of the program stands still while the scan does. So an axis that went on would have to go back by a jump when the scan is there again.
TEST(CanFault, AScanThatIsLateByManyCyclesSendsNoAxisBack) {
  for (const char* const mode : {"", "mode = \"velocity\"\nvelocity_delay = 2.0\n"}) {
    for (const int late : {2, 3, 8, 15}) {
      SCOPED_TRACE(std::string(mode) + std::to_string(late));
      CanRig rig(can_toml("", mode));
      start_moving(&rig);
      double at = rig.plant_mm(0), least = 0, most = 0;
      rig.step();
      const double per_cycle = rig.plant_mm(0) - at;
      at = rig.plant_mm(0);
      const auto look = [&] {
        const double way = rig.plant_mm(0) - at;
        least = std::min(least, way);
        most = std::max(most, way);
        at = rig.plant_mm(0);
      };
      const double begin = at;
      for (int i = 0; i < late; ++i) {
        rig.bus_step();
        look();
      }
      EXPECT_LE(at - begin, 2.5 * per_cycle) << "what was on its way, and one cycle that is bridged";
      for (int i = 0; i < 50; ++i) {
        rig.step();
        look();
      }
      EXPECT_GE(least, -0.002);
      EXPECT_LE(most, per_cycle * 1.2);
      EXPECT_EQ(rig.alarms(), "");
    }
  }
}

// The speed of a move that ends falls from SYNC to SYNC, so an axis that went on as before would pass the end, and a control that ended just then would leave it there.
TEST(CanFault, AScanThatIsLateWhileAnAxisBrakesSendsItNotBeyondItsEnd) {
  constexpr double kEnd = 5.0, kFine = 0.1 / nc::test::kIncrementsPerMm;  // mm: one increment of the encoder here
  const std::string toml = std::regex_replace(std::regex_replace(can_toml(), std::regex("encoder = 10000\n"), "encoder = 100000\n"), std::regex("max_jerk = 50000.0"), "max_jerk = 1000000.0");
  const auto mm = [](CanRig* rig) { return rig->plant_mm(0) / 10; };
  for (const double way : {1.0, -1.0}) {
    const std::string block = "G90 G01 X" + std::to_string(way * kEnd) + " F6000";
    unsigned cycles = 0;  // of the whole move
    for (int late = -1; late < 30; ++late) {
      SCOPED_TRACE(block + ", " + std::to_string(late) + " cycles before its end");
      CanRig rig(toml);
      rig.bring_up();
      ASSERT_EQ(rig.mdi(block), Answer::kDone);
      if (late < 0) {
        for (; way * mm(&rig) < kEnd - kFine / 2 && cycles < 3000; ++cycles) rig.step();
        continue;
      }
      rig.step(cycles - static_cast<unsigned>(late));
      double at = way * mm(&rig), least = 0, most = at;
      const auto look = [&] {
        least = std::min(least, way * mm(&rig) - at);
        at = way * mm(&rig);
        most = std::max(most, at);
      };
      for (int i = 0; i < 4; ++i) {
        rig.bus_step();  // without a scan
        look();
      }
      for (int i = 0; i < 100; ++i) {
        rig.step();
        look();
      }
      EXPECT_LE(most, kEnd + 1.5 * kFine);  // set-points are whole increments
      EXPECT_GE(least, -1.5 * kFine);
      EXPECT_NEAR(at, kEnd, kFine);
      EXPECT_EQ(rig.alarms(), "");
    }
  }
}

TEST(CanFault, AResetInMotionIsAnOrderlyStopOnThePath) {
  CanRig rig;
  start_moving(&rig);
  ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(rig.until([&] { return rig.idle(); }, 1000));
  rig.step(20);
  EXPECT_TRUE(rig.following());
  EXPECT_NEAR(rig.plant_mm(1), rig.plant_mm(0) / 2, 0.01);  // still on the line
  EXPECT_EQ(rig.alarms(), "");
}

TEST(CanFault, TheEndOfTheControlStopsTheDrivesAndTheirNodes) {
  CanRig rig;
  rig.bring_up();
  rig.machine->stop();
  for (unsigned n = 0; n < 3; ++n) {
    EXPECT_NE(rig.drives[n]->nmt_state(), 5u);
    EXPECT_FALSE(rig.drives[n]->enabled());
  }
}

// The control crashes: its heartbeat ends, and each drive stops by itself (1016h, 6007h).
TEST(CanFault, DrivesStopByThemselvesWhenTheControlIsGone) {
  CanRig rig;
  start_moving(&rig);
  for (int i = 0; i < 400; ++i) {
    rig.now_ns += 1'000'000;
    {  // another node still sends SYNC
      nc::hal::canopen::CanFrame sync;
      sync.id = 0x80;
      for (auto& drive : rig.drives) drive->on_frame(sync);
    }
    rig.bus.tick(rig.now_ns);
  }
  for (unsigned n = 0; n < 3; ++n) EXPECT_FALSE(rig.drives[n]->enabled()) << n;
}

}  // namespace
