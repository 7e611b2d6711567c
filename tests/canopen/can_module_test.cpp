// SPDX-License-Identifier: Apache-2.0
// I/O modules of CiA 401 beside the drives: [[can_io]] and the table can_io of a point.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "can_rig.hpp"
#include "hal/canopen/bus_load.hpp"
#include "hal/canopen/setup_plan.hpp"
#include "sim_module.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::Config;
using nc::test::can_toml;
using nc::test::CanRig;
using nc::test::SimDrive;

constexpr const char* kModule = "[[can_io]]\nname = \"io\"\nnode = 10\nalarm = true\n";
constexpr const char* kPoints =
    "[[point]]\nname = \"door\"\ndirection = \"input\"\ncan_io = { module = \"io\", digital = 1, on_loss = 1 }\n"
    "[[point]]\nname = \"pressed\"\ndirection = \"input\"\ncan_io = { module = \"io\", digital = 11, active_low = true, on_loss = \"hold\" }\n"
    "[[point]]\nname = \"load\"\ndirection = \"input\"\ntype = \"word\"\ncan_io = { module = \"io\", analog = 5, on_loss = -7 }\n"
    "[[point]]\nname = \"coolant\"\ndirection = \"output\"\ncan_io = { module = \"io\", digital = 2 }\n"
    "[[point]]\nname = \"brake\"\ndirection = \"output\"\ncan_io = { module = \"io\", digital = 9, active_low = true }\n"
    "[[point]]\nname = \"speed\"\ndirection = \"output\"\ntype = \"word\"\ncan_io = { module = \"io\", analog = 1, on_stop = 12 }\n";

std::string with_module(const std::string& module = kModule, const std::string& points = kPoints) {
  std::string text = can_toml("sync_us = 2000\n");
  text.insert(text.find("[macro_interface]"), points);
  const std::string wires = "\"#1001\" = \"door\"\n\"#1002\" = \"pressed\"\n\"#1101\" = \"coolant\"\n\"#1102\" = \"brake\"\n\"#1133\" = \"speed\"\n\"#1033\" = \"load\"\n";
  text.insert(text.find("\"#1000\" = "), wires);
  return text + module;
}

std::string errors_of(const std::string& text, const std::string& file = "can.toml") {
  Config config;
  std::string all;
  for (const auto& error : nc::rt::parse_config(text, file, &config)) all += error.text() + "\n";
  return all;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

// The drives of CanRig, and a module with 16 digital inputs and outputs, 8 analog inputs and 2 analog outputs.
struct ModuleRig : CanRig {
  explicit ModuleRig(const std::string& toml = with_module()) : CanRig(toml) {
    drives.push_back(std::make_unique<SimDrive>(10, 0));
    io().more_defaults = [this] { nc::test::module_objects(&io()); };
    io().more_defaults();
    bus.attach(&io());
  }
  SimDrive& io() { return *drives[3]; }
  // Also the module, for which the drives do not wait.
  void bring_all_up() {
    bring_up();
    ASSERT_TRUE(until([&] { return quality("door"); }, 3000)) << said();
    step(20);
  }
  std::uint32_t input(unsigned bit) const { return runtime->snapshot().interface_input[0] >> bit & 1u; }
  bool quality(const char* point) {
    nc::hal::Feedback feedback;
    nc::hal::PointImage image;
    shell.read(&feedback, &image);
    return image.good[static_cast<unsigned>(config.points.find(point))] != 0;
  }
  std::uint32_t value(const char* point) {
    nc::hal::Feedback feedback;
    nc::hal::PointImage image;
    image.value[static_cast<unsigned>(config.points.find(point))] = 99;
    shell.read(&feedback, &image);
    return image.value[static_cast<unsigned>(config.points.find(point))];
  }
};

TEST(CanModule, InputsAndOutputsAreThoseOfTheModule) {
  ModuleRig rig;
  rig.bring_all_up();
  rig.step(50);
  EXPECT_TRUE(rig.quality("door"));
  EXPECT_TRUE(rig.quality("coolant"));
  EXPECT_EQ(rig.value("io.ok"), 1u);
  EXPECT_EQ(rig.input(1), 0u);
  EXPECT_EQ(rig.input(2), 1u) << "it is active low";
  rig.io().set_object(0x6000, 1, 1, 0x01, false);
  rig.io().set_object(0x6000, 2, 1, 0x04, false);
  rig.io().set_object(0x6401, 5, 2, 0xFFFE, false);
  rig.step(10);
  EXPECT_EQ(rig.input(1), 1u);
  EXPECT_EQ(rig.input(2), 0u);
  EXPECT_EQ(rig.value("load"), static_cast<std::uint32_t>(-2));
  ASSERT_EQ(rig.mdi("#1101 = 1\n#1102 = 1\n#1133 = 5000"), Answer::kDone);
  ASSERT_TRUE(rig.until([&] { return rig.idle(); }, 300));
  rig.step(10);
  EXPECT_EQ(rig.io().object(0x6200, 1), 0x02u);
  EXPECT_EQ(rig.io().object(0x6200, 2), 0x00u) << "it is active low";
  EXPECT_EQ(rig.io().object(0x6411, 1), 5000u);
  EXPECT_EQ(rig.alarms(), "");
}

TEST(CanModule, ItIsSetUpWithItsPdosAndWithWhatItDoesWithoutTheControl) {
  ModuleRig rig(with_module(replaced(kModule, "alarm = true", "every = 5")));
  rig.bring_all_up();
  rig.step(100);
  const SimDrive& io = rig.io();
  EXPECT_EQ(io.object(0x1800, 1), 0x18Au);
  EXPECT_EQ(io.object(0x1800, 2), 5u);
  EXPECT_EQ(io.object(0x1A00, 0), 2u);
  EXPECT_EQ(io.object(0x1A00, 2), 0x60000208u);
  EXPECT_EQ(io.object(0x1A02, 1), 0x64010510u) << "analog input 5 is the first one of PDO 3";
  EXPECT_EQ(io.object(0x1801, 1), 0x28Au) << "and 1 to 4 are in PDO 2";
  EXPECT_EQ(io.object(0x1803, 1) >> 31, 1u);
  EXPECT_EQ(io.object(0x1400, 2), 255u);
  EXPECT_EQ(io.object(0x6207, 1), 0x00u);
  EXPECT_EQ(io.object(0x6207, 2), 0x01u) << "the brake is off without the control: its output is on";
  EXPECT_EQ(io.object(0x6423, 0), 1u);
  EXPECT_TRUE(rig.quality("door"));
}

// Also a module's mapping is the control's, which is known only behind all points.
TEST(CanModule, WhatTheControlSetsIsNotSetByTheFile) {
  const auto with = [](const char* object) { return errors_of(with_module(std::string(kModule) + "objects = [{ " + object + ", value = 0 }]\n")); };
  for (const char* object : {"index = 0x1017, bytes = 2", "index = 0x1A00, sub = 1", "index = 0x6207, sub = 1, bytes = 1", "index = 0x6200, sub = 1, bytes = 1"}) {
    EXPECT_EQ(with(object).rfind("can.toml:", 0), 0u) << object;
    EXPECT_NE(with(object).find("can_io[1].objects[1].index: "), std::string::npos) << with(object);
    EXPECT_NE(with(object).find("is set by the control itself"), std::string::npos) << with(object);
  }
  EXPECT_EQ(with("index = 0x6444, sub = 1"), "");
  EXPECT_NE(errors_of(replaced(with_module(), "\"Y drive\"", "\"io\"")).find("canopen.drive[2].name: module \"io\" is node 10 already"), std::string::npos);
}

TEST(CanModule, ALostModuleIsOneAlarmAndComesBack) {
  ModuleRig rig;
  rig.bring_all_up();
  rig.io().set_object(0x6000, 2, 1, 0x04, false);
  rig.step(50);
  ASSERT_EQ(rig.input(2), 0u);
  ASSERT_EQ(rig.mdi("#1101 = 1"), Answer::kDone);
  rig.step(50);
  rig.io().dead = true;
  rig.step(600);
  EXPECT_EQ(rig.alarms(), "R18 Link lost: io (node 10) (line 1)\n");
  EXPECT_FALSE(rig.quality("door"));
  EXPECT_FALSE(rig.quality("coolant"));
  EXPECT_EQ(rig.input(1), 1u) << "on_loss";
  EXPECT_EQ(rig.input(2), 0u) << "it holds";
  EXPECT_EQ(rig.value("load"), static_cast<std::uint32_t>(-7));
  EXPECT_TRUE(rig.following()) << "the axes hold";
  rig.io().power_cycle();
  ASSERT_TRUE(rig.until([&] { return rig.quality("door"); }, 12'000)) << rig.said();
  ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
  rig.step(20);
  EXPECT_EQ(rig.alarms(), "");
  EXPECT_EQ(rig.input(1), 0u);
  EXPECT_EQ(rig.io().object(0x6200, 1), 0x02u) << "its outputs are what the control wants now";
}

TEST(CanModule, InputsThatStayAwayAreALostModule) {
  ModuleRig rig;
  rig.bring_all_up();
  rig.step(50);
  rig.io().no_tpdo = true;
  ASSERT_TRUE(rig.until([&] { return !rig.quality("door"); }, 30));
  rig.io().no_tpdo = false;
  ASSERT_TRUE(rig.until([&] { return rig.quality("door"); }, 9000)) << rig.said();
}

TEST(CanModule, ADriveUnderItsNumberIsRefused) {
  CanRig rig(with_module(), {1, 2, 3, 10});
  EXPECT_FALSE(rig.machine != nullptr && rig.machine->service().refused());
  (void)rig.boot(3000);
  EXPECT_TRUE(rig.machine->service().refused());
  EXPECT_NE(rig.said().find("node 10 (io): 1000h:0 is 192h, not 191h"), std::string::npos) << rig.said();
}

TEST(CanModule, TheDrivesDoNotWaitForIt) {
  ModuleRig rig;
  rig.io().dead = true;
  rig.bring_up();
  EXPECT_FALSE(rig.quality("door"));
  EXPECT_EQ(rig.input(1), 1u);
}

TEST(CanModule, TheLoadOfTheBusCountsIt) {
  Config config;
  ASSERT_EQ(errors_of(with_module()), "");
  ASSERT_TRUE(nc::rt::parse_config(with_module(), "can.toml", &config).empty());
  const double every = nc::hal::canopen::bus_load(config.canopen).share;
  const unsigned bits = nc::hal::canopen::worst_bits(2) + nc::hal::canopen::worst_bits(8) + nc::hal::canopen::worst_bits(2) +  // inputs
                        nc::hal::canopen::worst_bits(2) + nc::hal::canopen::worst_bits(2);
  config.canopen.nodes[0].module->every = 10;
  EXPECT_NEAR(every - nc::hal::canopen::bus_load(config.canopen).share, 0.9 * bits / 2000, 1e-9);
  // With a SYNC in each millisecond there is no room for it beside three axes, however rarely it is asked.
  const std::string full = replaced(with_module(), "sync_us = 2000", "sync_us = 1000");
  EXPECT_NE(errors_of(full).find("the bus would be fuller than 80 %: SYNC 55 + 6 PDOs of 6 bytes, 115 each + 1 modules "), std::string::npos) << errors_of(full);
  EXPECT_NE(errors_of(replaced(full, "alarm = true", "every = 40")).find("where the PDOs of all modules come together the bus would be fuller than 95 %"), std::string::npos);
}

// A channel has 16 bits, and so has the counter of a handwheel behind it.
TEST(CanModule, ACounterOfAHandwheelIsAsWideAsItsChannel) {
  const std::string wheel = with_module() + "[[handwheel]]\ncounter = \"load\"\naxes = { X = \"door\" }\n";
  Config config;
  for (const auto& error : nc::rt::parse_config(wheel, "can.toml", &config)) ADD_FAILURE() << error.text();
  ASSERT_EQ(config.handwheels.size(), 1u);
  EXPECT_EQ(config.handwheels[0].bits, 16u);
  EXPECT_NE(errors_of(wheel + "bits = 32\n").find("handwheel[1].bits: the counter is an input of 16 bits"), std::string::npos);
}

TEST(CanModule, WhatIsWrongInTheFileIsNamed) {
  const std::string good = with_module();
  const struct {
    const char *from, *to, *says;
  } rows[] = {
      {"node = 10", "node = 2", "canopen.drive[2].node: module \"io\" has this number already"},
      {"node = 10", "node = 127", "can_io[1].node: is the control's own number: canopen.node_id"},
      {"node = 10", "node = 128", "can_io[1].node: must be"},
      {"alarm = true", "every = 241", "can_io[1].every: must be"},
      {"alarm = true", "evry = 2", "can_io[1].evry"},
      {"name = \"io\"\nnode", "name = \"an io\"\nnode", "can_io[1].name: must be 1 to 32 letters"},
      {"digital = 11", "digital = 1", "point[4].can_io.digital: point \"door\" is on it already"},
      {"digital = 11", "digital = 65", "point[4].can_io.digital: must be"},
      {"digital = 11", "digital = 0", "point[4].can_io.digital: must be"},
      {"digital = 11", "analog = 1", "point[4].can_io.analog: is a word, but the point is a bit"},
      {"analog = 5", "digital = 5", "point[5].can_io.digital: is a bit, but the point is a word"},
      {"analog = 5", "analog = 5, digital = 3", "point[5].can_io.analog: has no meaning beside digital"},
      {"analog = 5, ", "", "point[5].can_io.digital: is missing: the number of the input or output on the module; or analog"},
      {"on_loss = \"hold\"", "on_loss = \"keep\"", "point[4].can_io.on_loss: must be \"hold\", 0 or 1"},
      {"on_loss = -7", "on_loss = 40000", "point[5].can_io.on_loss: must be"},
      {"on_loss = -7", "on_stop = 1", "point[5].can_io.on_stop: is for outputs; an input has on_loss"},
      {"on_stop = 12", "on_loss = 1", "point[8].can_io.on_loss: is for inputs; an output has on_stop"},
      {"on_stop = 12", "active_low = true", "point[8].can_io.active_low: is for digital inputs and outputs"},
      {"module = \"io\", digital = 1,", "module = \"oi\", digital = 1,", "point[3].can_io.module: no module is named \"oi\": see [[can_io]]"},
      {"module = \"io\", digital = 1,", "digital = 1,", "point[3].can_io.module"},
  };
  ASSERT_EQ(errors_of(good), "");
  for (const auto& row : rows) {
    const std::string said = errors_of(replaced(good, row.from, row.to));
    EXPECT_NE(said.find(row.says), std::string::npos) << row.to << "\n" << said;
    EXPECT_EQ(said.rfind("can.toml:", 0), 0u) << said;
  }
  EXPECT_NE(errors_of(good + "[[can_io]]\nname = \"io\"\nnode = 11\n").find("can_io[2].name: a bus \"io\" is already there"), std::string::npos);
  EXPECT_NE(errors_of(good + "[[can_io]]\nname = \"io2\"\nnode = 10\n").find("can_io[2].node: module \"io\" has this number already"), std::string::npos);
  EXPECT_NE(errors_of(good + "[[can_io]]\nname = \"io2\"\nnode = 11\n").find("can_io[2].node: no point uses the module \"io2\""), std::string::npos);
  EXPECT_NE(errors_of("[machine]\nname = \"a\"\n" + nc::test::can_axis("X") + kModule).find("can_io[1].name: an I/O module is on the bus of the drives: it needs machine.hal = \"canopen\""),
            std::string::npos);
}

TEST(CanModule, TheDataSheetIsComparedWithWhatThePointsNeed) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / ("can_module_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "io.eds") << "[1A00]\nParameterName=m\nObjectType=0x9\nSubNumber=1\n[1A00sub0]\nParameterName=n\nDataType=0x0005\nAccessType=rw\nPDOMapping=0\n"
                                      "[6000]\nParameterName=in\nObjectType=0x8\nSubNumber=2\n[6000sub1]\nParameterName=a\nDataType=0x0005\nAccessType=ro\nPDOMapping=1\n";
  const std::string said = errors_of(with_module(std::string(kModule) + "eds = \"io.eds\"\n"), (folder / "can.toml").string());
  EXPECT_NE(said.find("can_io[1].eds: io.eds: 6000h:2 does not exist in this module"), std::string::npos) << said;
  EXPECT_NE(said.find("can_io[1].eds: io.eds: 6401h:5 does not exist in this module"), std::string::npos) << said;
  EXPECT_EQ(said.find("6000h:1 "), std::string::npos) << said;
  EXPECT_NE(errors_of(with_module(std::string(kModule) + "eds = \"no.eds\"\n"), (folder / "can.toml").string()).find("can_io[1].eds: \""), std::string::npos);
  std::filesystem::remove_all(folder);
}

}  // namespace
