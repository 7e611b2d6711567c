// SPDX-License-Identifier: Apache-2.0
// A machine starts, moves and stops with the threads of the bus. Its timing is not tested.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "can_rig.hpp"

namespace {

using nc::hal::Command;
using nc::hal::Feedback;
using nc::hal::PointImage;
using nc::hal::canopen::CanMachine;

std::int64_t now_ns() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

// A port that steps the simulated drives in the thread of the bus.
struct TickingPort final : nc::hal::canopen::CanPort {
  explicit TickingPort(nc::test::LoopbackBus* made) : bus(made), port(made) {}
  bool open(std::string* error) override { return port.open(error); }
  void close() noexcept override { port.close(); }
  bool send(const nc::test::CanFrame& frame) noexcept override {
    if (frame.id == 0x80) bus->tick(now_ns());
    return port.send(frame);
  }
  bool receive(nc::test::CanFrame* frame) noexcept override { return port.receive(frame); }
  nc::test::LoopbackBus* bus;
  nc::test::LoopbackBus::Port port;
};

struct Machine {
  explicit Machine(unsigned nodes, const std::string& more = "") {
    const auto errors = nc::rt::parse_config(nc::test::can_toml("priority = 0\ncommand_timeout_ms = 1000\nlost_after = 100\nheartbeat_ms = 2000\n" + more), "can.toml", &config);
    for (const auto& error : errors) ADD_FAILURE() << error.text();
    for (unsigned n = 0; n < nodes; ++n) {
      drives.push_back(std::make_unique<nc::test::SimDrive>(n + 1));
      bus.attach(drives.back().get());
    }
    machine = std::make_unique<CanMachine>(config.canopen, std::make_unique<TickingPort>(&bus));
  }
  nc::rt::Config config;
  nc::test::LoopbackBus bus;
  std::vector<std::unique_ptr<nc::test::SimDrive>> drives;
  std::unique_ptr<CanMachine> machine;
};

TEST(CanThreads, AMachineStartsFollowsAndStops) {
  Machine rig(3);
  PointImage image;
  std::string error;
  ASSERT_TRUE(rig.machine->start(image, &error)) << error;
  auto feedback = std::make_unique<Feedback>();
  Command command;
  command.system[0].enable = true;
  bool follows = false;
  double target = 0;
  for (unsigned i = 0; i < 60'000 && target < 1.0; ++i) {
    rig.machine->read(feedback.get(), &image);
    follows = feedback->system[0].not_following == 0;
    // Where the thread of the bus waits for a processor its axis must not be told to make up for it in one SYNC: that would be a jump.
    if (follows && std::abs(feedback->system[0].actual.v[0] - target) < 0.015) target += 0.01;
    if (!follows) command.system[0].position = feedback->system[0].actual;
    command.system[0].position.v[0] = target;
    ASSERT_EQ(feedback->system[0].drive_fault, 0u) << feedback->system[0].drive_fault_code[0];
    rig.machine->write(command, image);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_TRUE(follows);
  for (unsigned i = 0; i < 60'000 && std::abs(feedback->system[0].actual.v[0] - target) > 0.001; ++i) {
    rig.machine->read(feedback.get(), &image);
    rig.machine->write(command, image);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_NEAR(feedback->system[0].actual.v[0], target, 0.001);
  rig.machine->stop();
  for (const auto& drive : rig.drives) EXPECT_FALSE(drive->enabled());
}

TEST(CanThreads, AMachineWithoutADriveDoesNotStartAndSaysWhich) {
  Machine rig(2, "boot_timeout_s = 4.0\nsdo_timeout_ms = 100\n");
  PointImage image;
  std::string error;
  EXPECT_FALSE(rig.machine->start(image, &error));
  EXPECT_NE(error.find("CANopen on test: "), std::string::npos) << error;
  EXPECT_NE(error.find("node 3 (Z drive): 1000h:0: no answer"), std::string::npos) << error;
  EXPECT_EQ(error.find("bit rate"), std::string::npos) << "the others are heard: " << error;
  rig.machine->stop();
}

// As with another bit rate than the drives have, or with a wire that is not there.
TEST(CanThreads, ABusOnWhichNothingIsHeardSaysWhereToLook) {
  Machine rig(0, "boot_timeout_s = 1.0\nsdo_timeout_ms = 100\n");
  PointImage image;
  std::string error;
  EXPECT_FALSE(rig.machine->start(image, &error));
  EXPECT_NE(error.find("nothing at all has come from the bus: look at its bit rate, wires and terminators"), std::string::npos) << error;
  rig.machine->stop();
}

}  // namespace
