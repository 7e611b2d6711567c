// SPDX-License-Identifier: Apache-2.0
// What drives say by EMCY: it is in the alarm of their fault whenever it comes and for as long as the fault is there, and in the log, however often it is said.
#include <gtest/gtest.h>

#include <algorithm>

#include "can_rig.hpp"

namespace {

using nc::hal::canopen::CanFrame;
using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::test::CanRig;

const std::string kOverVoltage = "R12 Drive fault: EMCY 3210h: DC link over-voltage (error register 05h), axis Y";

bool is_emergency(const CanFrame& frame) { return (frame.id & 0x780) == 0x80; }

std::size_t lines_with(const CanRig& rig, const std::string& part) {
  return static_cast<std::size_t>(std::count_if(rig.log.begin(), rig.log.end(), [&](const std::string& line) { return line.find(part) != std::string::npos; }));
}

// Drives send their EMCY by a task of its own: the status word says "fault" before.
TEST(CanEmergency, OneThatComesBehindTheFaultIsInItsAlarm) {
  for (const unsigned late : {1u, 2u, 5u, 20u, 100u}) {
    CanRig rig;
    rig.bring_up();
    rig.bus.late = [late](const CanFrame& frame) { return is_emergency(frame) ? late : 0; };
    rig.drives[1]->trip(0, 0x3210, 0x05);
    ASSERT_TRUE(rig.until([&] { return !rig.alarms().empty(); }, 20)) << late;
    rig.step(late + 10);
    EXPECT_EQ(rig.alarms().rfind(kOverVoltage, 0), 0u) << late << ": " << rig.alarms();
    rig.step(2000);
    EXPECT_EQ(rig.runtime->snapshot().alarms.count, 1u) << rig.alarms();
  }
}

// A drive says it once, and its cause is still there behind one reset and the next.
TEST(CanEmergency, ItStaysInTheAlarmBehindAResetThatDoesNotHelp) {
  CanRig rig;
  rig.bring_up();
  rig.drives[1]->keeps_fault = true;
  rig.drives[1]->trip(0, 0x3210, 0x05);
  rig.step(20);
  for (unsigned resets = 0; resets < 3; ++resets) {
    (void)rig.run(CommandKind::kReset);
    rig.step(1000);
    EXPECT_EQ(rig.alarms().rfind(kOverVoltage, 0), 0u) << resets << ": " << rig.alarms();
  }
  // Mended, it is gone with the fault, and a later one that says nothing has no reason.
  rig.drives[1]->keeps_fault = false;
  ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(rig.until([&] { return rig.following() && rig.alarms().empty(); }, 3000)) << rig.alarms();
  rig.bus.late = [](const CanFrame& frame) { return is_emergency(frame) ? 1'000'000u : 0; };
  rig.drives[1]->trip(0, 0x4210, 0x09);
  rig.step(100);
  EXPECT_EQ(rig.alarms().rfind("R12 Drive fault, axis Y", 0), 0u) << rig.alarms();
}

// A loose contact, or a node that has gone mad: thousands in a second fill no log and stop nothing that their status does not.
TEST(CanEmergency, AFloodOfThemIsAFewLinesAndMovesOn) {
  CanRig rig;
  rig.bring_up();
  const std::size_t before = rig.log.size();
  ASSERT_EQ(rig.mdi("G90 G01 X300. Y150. Z60. F3600"), Answer::kDone);
  for (unsigned n = 0; n < 5000; ++n) {
    for (unsigned more = 0; more < 3; ++more) rig.drives[1]->emergency(more == 2 ? 0 : 0x8110 + 0x10 * (n % 2), 0x11);
    rig.step();
  }
  EXPECT_EQ(rig.alarms(), "");
  EXPECT_LE(rig.log.size() - before, 8u);
  ASSERT_TRUE(rig.until([&] { return rig.idle(); }, 9000)) << rig.alarms();
  rig.step(20);
  EXPECT_NEAR(rig.plant_mm(0), 300.0, 0.001);
  for (unsigned n = 0; n < 60'000 && lines_with(rig, "9992 more of these, the last one: EMCY 81") == 0; ++n) rig.bus_step();
  EXPECT_EQ(lines_with(rig, "9992 more of these, the last one: EMCY 81"), 1u) << rig.log.back();
}

TEST(CanEmergency, TheSameOneLaterIsANewLine) {
  CanRig rig;
  rig.bring_up();
  for (unsigned times = 1; times <= 3; ++times) {
    rig.drives[0]->emergency(0x4210, 0x09);
    rig.step(20);
    EXPECT_EQ(lines_with(rig, "node 1 (X drive): EMCY 4210h: device too hot"), times);
    rig.step(3000);
  }
}

// What a node says of itself does not hide why it cannot be used.
TEST(CanEmergency, ItStandsBesideTheReasonForWhichANodeIsRefused) {
  unsigned frames = 0;  // the machine speaks to its nodes at its end, too
  CanRig rig;
  rig.drives[1]->refuses[0x160002] = 0x06040041;
  rig.bus.behind_frame = [&] {
    if (++frames % 16 == 0) rig.drives[1]->emergency(0x3220, 0x05);
  };
  EXPECT_FALSE(rig.boot(2000));
  const std::string missing = rig.machine->service().missing();
  EXPECT_NE(missing.find("1600h:2"), std::string::npos) << missing;
  EXPECT_NE(missing.find("EMCY 3220h: DC link under-voltage"), std::string::npos) << missing;
}

}  // namespace
