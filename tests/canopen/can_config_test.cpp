// SPDX-License-Identifier: Apache-2.0
// The section [canopen]: what is made from it, and what is refused, with line and key.
#include <gtest/gtest.h>

#include <fcntl.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "can_rig.hpp"
#include "places/places.hpp"
#include "runtime/hal_factory.hpp"
#include "runtime/machine_canopen.hpp"
#include "runtime/machine_lock.hpp"
#include "tools/lib/daemon_options.hpp"

namespace {

using nc::rt::Config;
using nc::test::can_axis;
using nc::test::can_toml;

std::vector<std::string> errors_of(const std::string& text) {
  Config config;
  std::vector<std::string> texts;
  for (const auto& error : nc::rt::parse_config(text, "can.toml", &config)) texts.push_back(error.text());
  return texts;
}
std::string only_error(const std::string& text) {
  const auto errors = errors_of(text);
  std::string all;
  for (const std::string& error : errors) all += error + "\n";
  EXPECT_EQ(errors.size(), 1u) << all;
  return errors.empty() ? "" : errors[0];
}
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}
void expect_in(const std::string& text, const std::string& part) { EXPECT_NE(text.find(part), std::string::npos) << "\"" << part << "\" is not in: " << text; }

TEST(CanConfig, UnitsComeFromEncoderGearAndPitch) {
  Config config;
  ASSERT_TRUE(nc::rt::parse_config(replaced(can_toml(), "pitch = 10.0", "pitch = 5.0\nreverse = true\nzero = 7.5"), "can.toml", &config).empty());
  ASSERT_EQ(config.canopen.nodes.size(), 3u);
  const nc::hal::canopen::AxisMap& axis = config.canopen.nodes[0].axes[0];
  EXPECT_DOUBLE_EQ(axis.increments_per_unit, -4000.0);  // 10000 x 2 / 5
  EXPECT_DOUBLE_EQ(axis.zero, 7.5);
  EXPECT_DOUBLE_EQ(axis.max_velocity, 200.0);
  EXPECT_EQ(config.canopen.sync_us, 1000u);
}

TEST(CanConfig, AnAxisThatCountsBackwardsMovesWhereItIsTold) {
  nc::test::CanRig rig(replaced(can_toml(), "pitch = 10.0", "pitch = 10.0\nreverse = true\nzero = 3.0"));
  rig.bring_up();
  EXPECT_NEAR(rig.command(0), 3.0, 1e-9);
  ASSERT_EQ(rig.mdi("G90 G01 X10. F6000"), nc::rt::Answer::kDone);
  rig.step(20);
  ASSERT_TRUE(rig.until([&] { return rig.idle(); }, 3000));
  rig.step(20);
  EXPECT_DOUBLE_EQ(rig.drives[0]->plant().position, -14'000);
}

TEST(CanConfig, ABusThatIsTooFullIsRefusedWithTheArithmetic) {
  std::string text = can_toml("sync_us = 1000\n") + "[[canopen.drive]]\nnode = 4\naxis = [{ name = \"A\", encoder = 10000, pitch = 10.0 }]\n";
  text = replaced(text, "[[point]]", can_axis("A") + "[[point]]");
  const std::string error = only_error(text);
  expect_in(error, "can.toml:");
  expect_in(error, "canopen.sync_us: the bus would be fuller than 80 %: SYNC 55 + 8 PDOs of 6 bytes, 115 each");
  expect_in(error, "97.8 %");
  EXPECT_TRUE(errors_of(replaced(text, "sync_us = 1000", "sync_us = 2000")).empty());
}

TEST(CanConfig, EachAxisIsOnOneDrive) {
  expect_in(errors_of(replaced(can_toml(), "[[canopen.drive.axis]]\nname = \"Z\"", "[[canopen.drive.axis]]\nname = \"Z\"\nslot = 1\nencoder = 1\npitch = 1.0\n[[canopen.drive.axis]]\nname = \"Z\"")).at(1),
            "canopen.drive[3].axis[2].name: axis Z is on this drive already");
  const std::string text = can_toml();
  expect_in(only_error(text.substr(0, text.rfind("[[canopen.drive]]"))), "canopen: axis Z is on no drive: [[canopen.drive.axis]]");
  expect_in(errors_of(replaced(can_toml(), "name = \"Y\"\nencoder", "name = \"X\"\nencoder")).at(1), "canopen.drive[2].axis[1].name: axis X is on drive \"X drive\" already");
  expect_in(errors_of(replaced(can_toml(), "name = \"Y\"\nencoder", "name = \"Q\"\nencoder")).at(1), "there is no axis \"Q\": see [[axis]]");
}

TEST(CanConfig, EachDriveHasANumberOfItsOwn) {
  expect_in(only_error(replaced(can_toml(), "node = 2", "node = 1")), "canopen.drive[2].node: drive \"X drive\" has this number already");
  expect_in(only_error(replaced(can_toml(), "node = 2", "node = 127")), "canopen.drive[2].node: is the control's own number: canopen.node_id");
  expect_in(only_error(replaced(can_toml(), "node = 2", "node = 128")), "canopen.drive[2].node: ");
}

TEST(CanConfig, EachDriveHasANameOfItsOwn) {
  expect_in(only_error(replaced(can_toml(), "\"Y drive\"", "\"X drive\"")), "canopen.drive[2].name: drive \"X drive\" is node 1 already");
  expect_in(only_error(replaced(replaced(can_toml(), "\"X drive\"", "\"drive 2\""), "name = \"Y drive\"\n", "")), "canopen.drive[2].name: drive \"drive 2\" is node 1 already");
}

// What the control writes into a drive by itself is not taken back behind it: each object that the plan of the set-up writes, that a command PDO carries, or that the
// service writes. An object that is written for a function which this drive does not have is the file's own.
TEST(CanConfig, WhatTheControlSetsIsNotSetByTheFile) {
  const auto with = [](const std::string& object) { return can_toml("", "", "objects = [{ index = 0x6065, value = 1000 }, " + object + "]\n"); };
  for (const char* object : {"index = 0x1017, bytes = 2", "index = 0x1016, sub = 1", "index = 0x1400, sub = 1", "index = 0x1803, sub = 1", "index = 0x1600", "index = 0x1A00, sub = 2", "index = 0x6040, bytes = 2",
                             "index = 0x6060, bytes = 1", "index = 0x607A", "index = 0x605A, bytes = 2", "index = 0x60C2, sub = 1, bytes = 1"}) {
    const auto errors = errors_of(with("{ " + std::string(object) + ", value = 0 }"));
    ASSERT_EQ(errors.size(), 3u) << object;
    EXPECT_EQ(errors[0].rfind("can.toml:", 0), 0u);
    expect_in(errors[0], "canopen.drive[1].objects[2].index: ");
    expect_in(errors[0], "is set by the control itself");
  }
  for (const char* object : {"index = 0x6098, bytes = 1", "index = 0x60FF", "index = 0x60B8, bytes = 2", "index = 0x2000", "index = 0x1010, sub = 1"})
    EXPECT_TRUE(errors_of(with("{ " + std::string(object) + ", value = 0 }")).empty()) << object;
  EXPECT_EQ(errors_of(can_toml("", "homing = { method = 1, fast = 1.0, slow = 1.0, acceleration = 1.0, request = \"home_x\", done = \"x_homed\" }\n",
                               "objects = [{ index = 0x6098, bytes = 1, value = 1 }]\n")).size(), 1u);
}

TEST(CanConfig, WhatIsMissingOrWrongIsNamed) {
  expect_in(only_error(replaced(can_toml(), "interface = \"test\"\n", "")), "canopen.interface: is missing");
  expect_in(only_error(replaced(can_toml(), "encoder = 10000\n", "")), "canopen.drive[1].axis[1].encoder: is missing");
  expect_in(only_error(can_toml("sync_us = 1500\n")), "canopen.sync_us: must be a whole number of servo cycles (machine.cycle_us = 1000)");
  expect_in(only_error(can_toml("sync_us = 257000\n")), "canopen.sync_us: ");
  expect_in(only_error(replaced(can_toml("sync_us = 25600\n"), "hal =", "cycle_us = 25600\nhal =")), "canopen.sync_us: a SYNC period of 25600 us cannot be told to a drive (60C2h)");
  expect_in(only_error(can_toml("heartbeet_ms = 100\n")), "canopen.heartbeet_ms: unknown key");
  expect_in(only_error(replaced(can_toml(), "gear = [2, 1]", "gear = [0, 1]")), "axis[1].gear: is [turns of the motor, turns of the screw], both above 0");
  expect_in(only_error(can_toml("", "homing = { method = 0, fast = 1.0, slow = 1.0, acceleration = 1.0, request = \"home_x\", done = \"x_homed\" }\n")), "homing.method: 0 is no homing");
  expect_in(only_error(can_toml("", "homing = { method = 1, fast = 1.0, slow = 1.0, acceleration = 1.0, request = \"x_homed\", done = \"x_homed\" }\n")),
            "homing.request: point \"x_homed\" must be a bit and an output");
  expect_in(only_error(can_toml("", "homing = { method = 1, fast = 1.0, slow = 1.0, acceleration = 1.0, request = \"nobody\", done = \"x_homed\" }\n")), "no point is named \"nobody\"");
  expect_in(only_error(replaced(can_toml(), "encoder = 10000", "encoder = 1000000000")), "is beyond the 32 bits of a drive's position");
  std::string none = can_toml();
  none.resize(none.find("[canopen]"));
  expect_in(only_error(none), "machine: hal = \"canopen\" needs a section [canopen] that names the bus and its drives");
}

// A drive with 23 bits a turn: what it would be told of its homing does not fit into its objects.
TEST(CanConfig, WhatADriveIsToldOfItsHomingFitsIntoItsObjects) {
  const auto with = [](const std::string& encoder, const std::string& homing) {
    return replaced(replaced(can_toml("", "homing = { method = 1, " + homing + ", request = \"home_x\", done = \"x_homed\" }\n"), "encoder = 10000", "encoder = " + encoder), "gear = [2, 1]", "gear = [1, 1]");
  };
  EXPECT_TRUE(errors_of(with("8388608", "fast = 50.0, slow = 5.0, acceleration = 5000.0")).empty());
  expect_in(only_error(with("8388608", "fast = 50.0, slow = 5.0, acceleration = 6000.0")), "axis[1].homing.acceleration: with 838860.8 increments per unit is beyond the 32 bits that a drive takes");
  expect_in(only_error(with("8388608", "fast = 6000.0, slow = 5.0, acceleration = 500.0")), "axis[1].homing.fast: with 838860.8");
  expect_in(only_error(with("16777216", "fast = 50.0, slow = 5.0, acceleration = 500.0, position = 1000.0")), "with 1677721.6 increments per unit the soft limit -500 is beyond the 32 bits of a drive's position");
  expect_in(only_error(replaced(with("8388608", "fast = 50.0, slow = 5.0, acceleration = 500.0, position = 26.0"), "pitch", "zero = -26.0\npitch")), "axis[1].zero: is not homing.position");
  EXPECT_TRUE(errors_of(replaced(with("8388608", "fast = 50.0, slow = 5.0, acceleration = 500.0, position = 26.0"), "pitch", "zero = 26.0\npitch")).empty());
  expect_in(only_error(with("100", "fast = 50.0, slow = 0.01, acceleration = 500.0")), "axis[1].homing.slow: with 10 increments per unit is 0 for the drive, which would not move");
}

TEST(CanConfig, APdoCarriesOneAxis) {
  const auto with = [](const std::string& first, const std::string& second) {
    return replaced(replaced(replaced(can_toml("sync_us = 4000\n", first), "[[point]]", can_axis("A") + "[[point]]"),
                             "[[canopen.drive]]\nname = \"Y drive\"", "[[canopen.drive.axis]]\nname = \"A\"\nslot = 1\nencoder = 10000\npitch = 10.0\n" + second + "[[canopen.drive]]\nname = \"Y drive\""), "", "");
  };
  EXPECT_TRUE(errors_of(with("", "rpdo = 2\ntpdo = 2\n")).empty());
  expect_in(only_error(with("", "rpdo = 1\n")), "canopen.drive[1].axis: X and A would have RPDO 1 of this drive: rpdo");
  expect_in(only_error(with("probe = { skip_signal = 1 }\n", "rpdo = 2\ntpdo = 2\n")), "canopen.drive[1].axis: X and A would have TPDO 2 of this drive: tpdo");
  expect_in(only_error(with("", "tpdo = 512\nprobe = { skip_signal = 1 }\n")), "canopen.drive[1].axis: A needs TPDO 513 for its probe");
}

TEST(CanConfig, FourAxesOfOneNodeAreAllThatItHasIdentifiersFor) {
  std::string text = can_toml("sync_us = 4000\n", "probe = { skip_signal = 1 }\n");
  for (const char* name : {"A", "B", "C"}) {
    text = replaced(text, "[[point]]", can_axis(name) + "[[point]]");
    text = replaced(text, "[[canopen.drive]]\nname = \"Y drive\"", "[[canopen.drive.axis]]\nname = \"" + std::string(name) + "\"\nslot = " + std::to_string(name[0] - 'A' + 1) + "\nencoder = 10000\npitch = 10.0\n[[canopen.drive]]\nname = \"Y drive\"");
  }
  expect_in(only_error(text), "canopen.drive[1].axis: a node has identifiers for four PDOs of each direction");
}

TEST(CanConfig, ADataSheetThatDoesNotFitIsRefusedWithBothLines) {
  const std::string folder = testing::TempDir();
  std::ofstream(folder + "/bad.eds") << "[6040]\nDataType=0x0006\nAccessType=rw\nPDOMapping=0\n";
  const auto errors = errors_of(can_toml("", "", "eds = \"" + folder + "/bad.eds\"\n"));
  ASSERT_FALSE(errors.empty());
  expect_in(errors[0], "canopen.drive[1].eds: ");
  expect_in(errors[0], "bad.eds:1: 6040h:0 cannot be mapped into a PDO (PDOMapping)");
  expect_in(errors_of(can_toml("", "", "eds = \"nobody.eds\"\n")).at(0), "nobody.eds\" cannot be read");
}

TEST(CanConfig, TheInterfaceIsTheMachinesOwnAndThereIsNoVirtualTime) {
  Config config;
  ASSERT_TRUE(nc::rt::parse_config(can_toml(), "can.toml", &config).empty());
  bool found = false;
  for (const auto& resource : nc::rt::machine_resources(config, false)) found |= resource.meaning == "CAN interface test";
  EXPECT_TRUE(found);
  nc::tools::DaemonOptions options;
  options.fast = true;
  expect_in(nc::tools::conflict_of(options, config), "--fast cannot be: the drives of a bus run in real time (hal = \"canopen\")");
}

// A control that has the adapter under one of its names locks it under all of them.
TEST(CanConfig, OneAdapterIsOneMachineUnderEveryName) {
  char folder[] = "/tmp/nc-can-XXXXXX";
  ASSERT_NE(mkdtemp(folder), nullptr);
  const int master = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_TRUE(master >= 0 && ::grantpt(master) == 0 && ::unlockpt(master) == 0);
  const std::string tty = ptsname(master), link = std::string(folder) + "/by-id";
  ASSERT_EQ(::symlink(tty.c_str(), link.c_str()), 0);
  const auto resources = [](const std::string& interface) {
    Config config;
    EXPECT_TRUE(nc::rt::parse_config(replaced(can_toml(), "\"test\"", '"' + interface + '"'), "can.toml", &config).empty());
    std::vector<nc::rt::MachineResource> of_bus;
    nc::rt::canopen_resources(config, &of_bus);
    return of_bus;
  };
  nc::rt::MachineLock first, second, third;
  std::string error;
  ASSERT_TRUE(first.take(resources("slcan:" + tty), &error)) << error;
  EXPECT_FALSE(second.take(resources("slcan:" + link), &error));
  expect_in(error, "CAN interface slcan:" + link);
  EXPECT_TRUE(third.take(resources("slcan:" + tty + "7"), &error)) << error;
  ::close(master);
  ::unlink(link.c_str());
  ::rmdir(folder);
}

// The shipped example cuts on simulated drives that have its node numbers.
TEST(CanConfig, TheExampleRuns) {
  Config config;
  for (const auto& error : nc::rt::load_config(nc::test::kSourceDir + "/etc/can_mill.toml", &config)) ADD_FAILURE() << error.text();
  ASSERT_EQ(config.canopen.nodes.size(), 3u);
  nc::test::CanRig rig(can_toml(), {});
  rig.config = config;
  for (const auto& node : config.canopen.nodes) {
    rig.drives.push_back(std::make_unique<nc::test::SimDrive>(node.id));
    rig.bus.attach(rig.drives.back().get());
  }
  ASSERT_TRUE(rig.boot()) << rig.said();
  rig.make_runtime();
  ASSERT_TRUE(rig.until([&] { return rig.following(); }, 3000)) << rig.alarms();
  ASSERT_EQ(rig.mdi("G90 G01 X-5. Y-5. Z-5. F3000"), nc::rt::Answer::kDone);
  rig.step(20);
  ASSERT_TRUE(rig.until([&] { return rig.idle(); }, 9000)) << rig.alarms();
  rig.step(20);
  EXPECT_EQ(rig.alarms(), "");
  for (unsigned n = 0; n < 3; ++n) {
    const auto& axis = config.canopen.nodes[n].axes[0];
    EXPECT_NEAR(rig.drives[n]->plant().position / axis.increments_per_unit + axis.zero, -5.0, 2 / std::abs(axis.increments_per_unit)) << n;
  }
}

}  // namespace
