// SPDX-License-Identifier: Apache-2.0
// The example machines of etc/ that are on a CAN bus, against simulated nodes: they come up, are homed, and cut.
#include <gtest/gtest.h>

#include "can_rig.hpp"
#include "places/places.hpp"
#include "sim_module.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::Mode;
using nc::test::CanRig;
using nc::test::SimDrive;

struct Example : CanRig {
  explicit Example(const std::string& name) : CanRig(File{nc::test::kSourceDir + "/etc/" + name}) {}
  SimDrive& add(unsigned node, unsigned axes = 1) {
    drives.push_back(std::make_unique<SimDrive>(node, axes));
    bus.attach(drives.back().get());
    drives.back()->sync_s = config.canopen.sync_us * 1e-6;
    for (unsigned a = 0; a < axes; ++a) drives.back()->set_object(0x6065 + 0x800 * a, 0, 4, 10'000'000);
    return *drives.back();
  }
  std::uint32_t homed() const { return runtime->snapshot().system[0].axes.homed; }
  void home_all(std::uint32_t axes) {
    ASSERT_EQ(run(CommandKind::kSetMode, static_cast<std::uint32_t>(Mode::kManual)), Answer::kDone);
    nc::rt::Command home;
    home.kind = CommandKind::kHome;
    home.system = nc::rt::kAllSystems;
    ASSERT_EQ(runtime->execute(home), Answer::kDone);
    ASSERT_TRUE(until([&] { return homed() == axes; }, 6000)) << alarms() << homed();
    step(100);
  }
  void cut(const std::string& text, unsigned most = 20'000) {
    ASSERT_EQ(mdi(text), Answer::kDone) << alarms();
    step(20);
    ASSERT_TRUE(until([&] { return idle(); }, most)) << alarms() << runtime->snapshot().system[0].nc.cause;
    EXPECT_EQ(alarms(), "");
    step(20);
  }
};

constexpr const char* kPart = "G21 G90 G94 G54\nG00 X-10. Y-10. Z-5.\nG01 Z-8. F600\nX-30. F1500\nG02 X-20. Y-20. I10.\nG01 X-10. Y-10.\nG00 Z-1.";

TEST(ExampleMachines, TheCanMillIsHomedByItsProgramAndCuts) {
  Example rig("can_mill.toml");
  for (const unsigned node : {1u, 2u, 3u}) rig.add(node);
  rig.bring_up();
  for (const char* request : {"#1100 = 1", "#1101 = 1", "#1102 = 1"}) {
    ASSERT_EQ(rig.mdi(request), Answer::kDone) << rig.alarms();
    rig.step(200);
    ASSERT_TRUE(rig.until([&] { return rig.following() && rig.idle(); }, 3000)) << rig.alarms();
    rig.step(20);
  }
  EXPECT_EQ(rig.runtime->snapshot().interface_input[0] & 7u, 7u) << "all of them say that they are";
  rig.cut(kPart);
  EXPECT_NEAR(rig.drives[0]->plant().position / 13107.2, -10, 1e-4);
  EXPECT_NEAR(rig.drives[1]->plant().position / 13107.2, -10, 1e-4);
  EXPECT_NEAR(rig.drives[2]->plant().position / 26214.4, -1, 1e-4);
}

TEST(ExampleMachines, ThePulseMillHasThreeAxesOnOneCard) {
  Example rig("pulse_mill.toml");
  SimDrive& card = rig.add(1, 3);
  rig.bring_up();
  EXPECT_EQ(rig.mdi("G01 X-1. F100"), Answer::kNotHomed);
  rig.home_all(7);
  rig.cut(kPart);
  EXPECT_NEAR(card.plant(0).position, -10 * 320.0, 1);
  EXPECT_NEAR(card.plant(1).position, -10 * 320.0, 1);
  EXPECT_NEAR(card.plant(2).position, 1 * 400.0, 1) << "its motor turns the other way";
}

// The buttons of the panel are bits of its module's first byte.
struct TableMill : Example {
  TableMill() : Example("table_mill.toml") {
    for (const unsigned node : {1u, 2u, 3u, 4u, 5u}) add(node);
    SimDrive& panel = add(20, 0);
    panel.more_defaults = [&panel] { nc::test::module_objects(&panel); };
    panel.more_defaults();
    // The clamp follows its valve, and the emergency stop chain is closed.
    bus.behind_frame = [this, &panel] { panel.set_object(0x6000, 1, 1, buttons | (panel.object(0x6200, 1) & 1u) << 1, false); };
  }
  void up() {
    bring_up();
    ASSERT_TRUE(until([&] { return alarms().empty() && runtime->ladder() != nullptr && good("chain_closed"); }, 3000)) << alarms() << said();
    step(100);
  }
  bool good(const char* name) {
    nc::hal::Feedback feedback;
    nc::hal::PointImage image;
    shell.read(&feedback, &image);
    return image.good[static_cast<unsigned>(config.points.find(name))] != 0;
  }
  void turn_wheel(int to) {
    drives[5]->set_object(0x6401, 1, 2, static_cast<std::uint16_t>(to), false);
    step(400);
  }
  SimDrive& spindle() { return *drives[4]; }
  std::uint32_t buttons = 1;
};

TEST(ExampleMachines, TheTableMillIndexesAndTurnsItsSpindle) {
  TableMill rig;
  rig.up();
  rig.home_all(0xF);
  bool opened = false;
  ASSERT_EQ(rig.mdi("S1200 M03\nG90 G00 B90.\nG00 X-10.\nM05"), Answer::kDone) << rig.alarms();
  rig.step(20);
  ASSERT_TRUE(rig.until(
      [&] {
        opened |= (rig.drives[5]->object(0x6200, 1) & 1u) != 0;
        return rig.idle();
      },
      20'000))
      << rig.alarms();
  EXPECT_TRUE(opened);
  EXPECT_EQ(rig.drives[5]->object(0x6200, 1) & 1u, 0u) << "it is clamped";
  EXPECT_NEAR(rig.drives[3]->plant().position / (131072.0 * 90 / 360), 90, 1e-3);
  EXPECT_NEAR(rig.spindle().plant().velocity, 0, 1) << "M05 is done when it stands";
  rig.cut(std::string("S3000 M03\nM08\n") + kPart);
  EXPECT_NEAR(rig.spindle().plant().velocity, 3000.0 / 60 * 4096, 1);
  EXPECT_EQ(rig.drives[5]->object(0x6200, 1) & 2u, 2u) << "coolant";
  rig.cut("M19\nM09");
  const double turns = rig.spindle().plant().position / 4096;
  EXPECT_NEAR(turns - std::round(turns), 0, 1.0 / 360);
  EXPECT_EQ(rig.mdi("G00 B32."), Answer::kDone);
  rig.step(200);
  EXPECT_FALSE(rig.alarms().empty()) << "no place of the table";
}

TEST(ExampleMachines, TheTableMillHasAHandwheel) {
  TableMill rig;
  rig.up();
  rig.home_all(0xF);
  ASSERT_EQ(rig.run(CommandKind::kSetMode, static_cast<std::uint32_t>(Mode::kManual)), Answer::kDone);
  rig.turn_wheel(500);
  EXPECT_NEAR(rig.command(0), 0, 1e-9) << "no axis is chosen";
  rig.buttons = 1 | 1u << 3;  // X
  rig.step(50);
  rig.turn_wheel(400);
  EXPECT_NEAR(rig.command(0), -0.1, 1e-6) << "0.001 mm a count";
  rig.buttons = 1 | 1u << 4 | 1u << 6;  // Y, times 10
  rig.step(50);
  rig.turn_wheel(300);
  EXPECT_NEAR(rig.command(0), -0.1, 1e-6);
  EXPECT_NEAR(rig.command(1), -1.0, 1e-6);
  rig.buttons = 1 | 1u << 5 | 1u << 7;  // Z, times 100
  rig.step(50);
  rig.turn_wheel(290);
  EXPECT_NEAR(rig.command(2), -1.0, 1e-6);
  // Its counter has 16 bits, and goes over.
  rig.buttons = 1;
  rig.turn_wheel(32760);
  rig.buttons = 1 | 1u << 3;
  rig.step(50);
  rig.turn_wheel(-32766);  // 10 further
  EXPECT_NEAR(rig.command(0), -0.09, 1e-6);
}

TEST(ExampleMachines, ThePanelOfTheTableMillIsLostAndNothingJumps) {
  TableMill rig;
  rig.up();
  rig.home_all(0xF);
  ASSERT_EQ(rig.run(CommandKind::kSetMode, static_cast<std::uint32_t>(Mode::kManual)), Answer::kDone);
  rig.buttons = 1 | 1u << 3;
  rig.step(50);
  rig.drives[5]->dead = true;
  rig.step(600);
  EXPECT_EQ(rig.alarms(), "R18 Link lost: panel (node 20)\n") << "and no open chain beside it";
  rig.drives[5]->power_cycle();
  rig.drives[5]->set_object(0x6401, 1, 2, 4000, false);  // somebody has turned the wheel meanwhile
  ASSERT_TRUE(rig.until([&] { return rig.good("wheel"); }, 12'000)) << rig.said();
  ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
  rig.step(500);
  EXPECT_EQ(rig.alarms(), "");
  EXPECT_NEAR(rig.command(0), 0, 1e-9);
  rig.buttons = 0;  // the chain opens
  rig.step(50);
  EXPECT_EQ(rig.alarms().rfind("R16 Alarm of the ladder 1: The emergency stop chain is open", 0), 0u) << rig.alarms();
}

}  // namespace
