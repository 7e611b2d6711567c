// SPDX-License-Identifier: Apache-2.0
// Switches along an axis of the simulated machine, its brake and its weight: they go by where the axis really is, not by what its encoder counts.
#include <gtest/gtest.h>

#include "hal/sim/sim_machine.hpp"

namespace {

using namespace nc::hal;

struct Bench {
  PointTable table;
  SimConfig config;
  Feedback feedback;
  PointImage image;
  Command command;

  Bench() {
    for (const char* name : {"dog", "minus", "plus", "index"}) table.add({name, PointType::kBit, PointDirection::kInput});
    table.add({"brake", PointType::kBit, PointDirection::kOutput});
    config.axis_count[0] = 1;
    SimSwitches& switches = config.axis[0][0].switches;
    switches.offset = 100;
    switches.dog = {0, true, 101, 102};
    switches.minus = {1, false, -1e9, 50};
    switches.plus = {2, true, 105, 1e9};
    switches.index = 3;
    switches.pitch = 2;
    switches.mark = 1;
    switches.brake = 4;
    switches.brake_times = {0.01, 0.02};
    switches.weight = 9810;
  }
  void cycle(SimMachine& machine, double to, bool on = true, bool brake = true) {
    command.system[0].enable = true;
    command.system[0].off = on ? 0 : 1;
    command.system[0].position.v[0] = to;
    image.value[4] = brake;
    machine.write(command, image);
    machine.read(&feedback, &image);
  }
};

TEST(SimSwitches, AreOnAtTheirPlaces) {
  Bench b;
  SimMachine machine(b.config, b.table);
  std::string error;
  ASSERT_TRUE(machine.start(b.image, &error));
  machine.read(&b.feedback, &b.image);
  EXPECT_EQ(b.image.value[0], 1u) << "a closed contact, before the first cycle too";
  EXPECT_EQ(b.image.value[2], 1u);
  struct Row {
    double at;
    unsigned dog, minus, plus, index;
  };
  for (const Row& row : {Row{0.5, 1, 0, 1, 0}, {1.5, 0, 0, 1, 1}, {2.5, 1, 0, 1, 0}, {3.5, 1, 0, 1, 1}, {5.5, 1, 0, 0, 1}, {5.6, 1, 0, 0, 0}, {-60, 1, 1, 1, 1}}) {
    b.cycle(machine, row.at);
    EXPECT_NEAR(b.feedback.system[0].actual.v[0], row.at, 1e-9) << "its encoder counts from where it was switched on";
    EXPECT_NEAR(machine.place(0, 0), row.at + 100, 1e-9);
    EXPECT_EQ(b.image.value[0], row.dog) << row.at;
    EXPECT_EQ(b.image.value[1], row.minus) << row.at;
    EXPECT_EQ(b.image.value[2], row.plus) << row.at;
    EXPECT_EQ(b.image.value[3], row.index) << row.at;
  }
}

TEST(SimSwitches, WhatNeitherDriveNorBrakeHoldsFalls) {
  Bench b;
  SimMachine machine(b.config, b.table);
  std::string error;
  ASSERT_TRUE(machine.start(b.image, &error));
  for (int n = 0; n < 30; ++n) b.cycle(machine, 0);
  EXPECT_EQ(b.feedback.system[0].not_following, 0u);
  for (int n = 0; n < 100; ++n) b.cycle(machine, 0, true, false);
  for (int n = 0; n < 100; ++n) b.cycle(machine, 0, false, false);
  EXPECT_EQ(b.feedback.system[0].actual.v[0], 0) << "the brake";
  EXPECT_EQ(b.feedback.system[0].not_following, 1u);
  for (int n = 0; n < 100; ++n) b.cycle(machine, 0, true, false);
  for (int n = 0; n < 100; ++n) b.cycle(machine, 0, true, true);
  EXPECT_EQ(b.feedback.system[0].actual.v[0], 0) << "the drive";
  for (int n = 0; n < 100; ++n) b.cycle(machine, 0, false, true);
  EXPECT_NEAR(b.feedback.system[0].actual.v[0], -9810 * 0.1 * 0.1 / 2, 0.6) << "nothing";
}

}  // namespace
