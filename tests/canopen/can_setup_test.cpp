// SPDX-License-Identifier: Apache-2.0
// The set-up of the nodes: what is written into them; and drives that differ from the configuration, each of which is refused with object and
// reason.
#include <gtest/gtest.h>

#include "can_rig.hpp"

namespace {

using nc::rt::Answer;
using nc::test::can_toml;
using nc::test::CanRig;

void expect_in(const std::string& text, const std::string& part) { EXPECT_NE(text.find(part), std::string::npos) << "\"" << part << "\" is not in: " << text; }

TEST(CanSetup, PdosAreMappedAndHeartbeatsGoBothWays) {
  CanRig rig;
  rig.bring_up();
  const nc::test::SimDrive& drive = *rig.drives[1];
  EXPECT_EQ(drive.object(0x1600, 0), 2u);
  EXPECT_EQ(drive.object(0x1600, 1), 0x60400010u);
  EXPECT_EQ(drive.object(0x1600, 2), 0x607A0020u);
  EXPECT_EQ(drive.object(0x1A00, 1), 0x60410010u);
  EXPECT_EQ(drive.object(0x1A00, 2), 0x60640020u);
  EXPECT_EQ(drive.object(0x1400, 1), 0x202u);
  EXPECT_EQ(drive.object(0x1800, 1), 0x182u);
  EXPECT_EQ(drive.object(0x1800, 2), 1u);
  EXPECT_NE(drive.object(0x1801, 1) & 0x80000000u, 0u);  // a PDO of the drive's own mapping is switched off
  EXPECT_EQ(drive.object(0x1017, 0), 100u);
  EXPECT_EQ(drive.object(0x1016, 1), 127u << 16 | 250u);
  EXPECT_EQ(drive.object(0x60C2, 1), 1u);
  EXPECT_EQ(drive.object(0x60C2, 2), 0xFDu);  // 1 x 10^-3 s
  EXPECT_EQ(drive.object(0x6007, 0), 3u);
  EXPECT_EQ(drive.object(0x6060, 0), 8u);
  EXPECT_TRUE(drive.heard_heartbeats.contains(127));
}

TEST(CanSetup, ANodeThatIsSilentIsNamed) {
  CanRig rig;
  rig.drives[1]->dead = true;
  EXPECT_FALSE(rig.boot());
  expect_in(rig.machine->service().missing(), "node 2 (Y drive): 1000h:0: no answer");
}

TEST(CanSetup, ADriveWithoutAnObjectIsRefusedWithIt) {
  CanRig rig;
  rig.drives[0]->remove_object(0x60C2, 1);
  EXPECT_FALSE(rig.boot(3000));
  expect_in(rig.machine->service().missing(), "node 1 (X drive): 60C2h:1: the object does not exist (written: 1h)");
  EXPECT_TRUE(rig.machine->service().refused());
}

TEST(CanSetup, AnAbortIsToldWithItsObjectAndText) {
  CanRig rig;
  rig.drives[2]->refuses[0x160002] = 0x06040041;
  EXPECT_FALSE(rig.boot(3000));
  expect_in(rig.machine->service().missing(), "node 3 (Z drive): 1600h:2: the object cannot be mapped into a PDO (written: 607A0020h)");
}

TEST(CanSetup, AMappingThatTheDriveKeepsIsSeen) {
  CanRig rig;
  rig.drives[0]->set_object(0x1600, 2, 4, 0x60600008);
  rig.drives[0]->keeps_mapping = true;
  EXPECT_FALSE(rig.boot(3000));
  expect_in(rig.machine->service().missing(), "1600h:2 is 60600008h, not 607A0020h");
}

TEST(CanSetup, TwoDrivesWithOneNumberAreSeen) {
  CanRig rig(can_toml(), {1, 2, 3, 2});
  EXPECT_FALSE(rig.boot(3000));
  expect_in(rig.machine->service().missing(), "node 2 (Y drive): two nodes answer under this number");
}

TEST(CanSetup, ASecondDriveThatComesLaterIsSeenByItsPositions) {
  CanRig rig;
  rig.bring_up();
  nc::test::SimDrive twin(2);
  twin.set_object(0x1800, 1, 4, 0x182);
  twin.set_object(0x1800, 2, 1, 1);
  twin.set_object(0x1A00, 0, 1, 2);
  twin.set_object(0x1A00, 1, 4, 0x60410010);
  twin.set_object(0x1A00, 2, 4, 0x60640020);
  twin.out = [&](const nc::test::CanFrame& frame) {
    if (frame.id == 0x182) rig.bus.from_drive(frame);
  };
  nc::test::CanFrame start, sync;
  start.length = 2;
  start.data[0] = 1;
  sync.id = 0x80;
  twin.on_frame(start);
  for (int i = 0; i < 100; ++i) {
    twin.on_frame(sync);
    rig.step();
  }
  expect_in(rig.alarms(), "axis Y");
}

TEST(CanSetup, ADriveThatAnswersForAnotherIsNotTaken) {
  CanRig rig(can_toml("", "", "vendor = 0x1234\nproduct = 0x5678\n"));
  rig.drives[1]->dead = true;
  rig.drives[2]->answers_as = 2;
  EXPECT_FALSE(rig.boot(5000));
  const std::string missing = rig.machine->service().missing();
  expect_in(missing, "node 2 (Y drive)");
  expect_in(missing, "node 3 (Z drive)");
}

TEST(CanSetup, AnotherProductIsRefused) {
  CanRig rig(can_toml("", "", "vendor = 0x1234\nproduct = 0x5678\n"));
  rig.drives[1]->set_object(0x1018, 2, 4, 0x9999, false);
  EXPECT_FALSE(rig.boot(3000));
  expect_in(rig.machine->service().missing(), "node 2 (Y drive): 1018h:2 is 9999h, not 5678h");
}

TEST(CanSetup, AnInputModuleIsNoDrive) {
  CanRig rig;
  rig.drives[0]->set_object(0x1000, 0, 4, 0x000F0191, false);
  EXPECT_FALSE(rig.boot(3000));
  expect_in(rig.machine->service().missing(), "node 1 (X drive): 1000h:0 is 191h, not 192h");
}

TEST(CanSetup, AnswersInSegmentsAreRead) {
  CanRig rig;
  for (auto& drive : rig.drives) drive->answers_segmented = true;
  rig.bring_up();
  EXPECT_TRUE(rig.enabled());
}

TEST(CanSetup, ASlowerSyncIsToldToTheDrivesAndMovesThem) {
  CanRig rig(can_toml("sync_us = 2000\n"));
  rig.bring_up();
  EXPECT_EQ(rig.drives[0]->object(0x60C2, 1), 2u);
  const unsigned syncs = rig.drives[0]->syncs;
  rig.step(100);
  EXPECT_EQ(rig.drives[0]->syncs - syncs, 50u);
  ASSERT_EQ(rig.mdi("G90 G01 X10. F6000"), Answer::kDone);
  rig.step(20);
  ASSERT_TRUE(rig.until([&] { return rig.idle(); }, 3000));
  rig.step(20);
  EXPECT_NEAR(rig.plant_mm(0), 10.0, 0.001);
  EXPECT_EQ(rig.alarms(), "");
}

TEST(CanSetup, ThreeAxesOfOneNodeAreOnItsObjectsBy800h) {
  std::string toml = can_toml();
  toml.resize(toml.find("[[canopen.drive]]"));
  toml += "[[canopen.drive]]\nname = \"all\"\nnode = 5\n";
  for (const char* name : {"X", "Y", "Z"}) toml += "[[canopen.drive.axis]]\nname = \"" + std::string(name) + "\"\nencoder = 10000\ngear = [2, 1]\npitch = 10.0\n";
  CanRig rig(toml, {});
  rig.drives.push_back(std::make_unique<nc::test::SimDrive>(5, 3));
  rig.bus.attach(rig.drives[0].get());
  ASSERT_TRUE(rig.boot()) << rig.said();
  rig.make_runtime();
  ASSERT_TRUE(rig.until([&] { return rig.following(); }, 2000)) << rig.alarms();
  ASSERT_EQ(rig.mdi("G90 G01 X10. Y20. Z-5. F6000"), Answer::kDone);
  rig.step(20);
  ASSERT_TRUE(rig.until([&] { return rig.idle(); }, 3000));
  rig.step(20);
  EXPECT_EQ(rig.drives[0]->object(0x1640, 2), 0x687A0020u);
  EXPECT_EQ(rig.drives[0]->object(0x1680, 2), 0x707A0020u);
  for (const auto& [axis, place] : {std::pair{0u, 10.0}, {1u, 20.0}, {2u, -5.0}}) EXPECT_NEAR(rig.drives[0]->plant(axis).position / 2000, place, 0.001);
}

TEST(CanSetup, AnInterfaceThatIsNotThereIsAnError) {
  CanRig rig;
  rig.bus.refuses_to_open = true;
  EXPECT_FALSE(rig.boot(10));
  EXPECT_EQ(rig.log.back(), "CANopen on test: there is no such interface");
}

}  // namespace
