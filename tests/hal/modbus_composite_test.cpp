// SPDX-License-Identifier: Apache-2.0
// One machine and its point buses as one Hal; and the buffer between a bus's thread and the scan.
#include <gtest/gtest.h>

#include <thread>

#include "hal/composite.hpp"
#include "hal/sim/sim_machine.hpp"
#include "hal/triple_buffer.hpp"

namespace {

using nc::hal::Point;
using nc::hal::PointDirection;
using nc::hal::PointImage;
using nc::hal::PointType;

// A bus with one input and one output.
struct FakeBus : nc::hal::PointBus {
  FakeBus(unsigned in, unsigned out, bool starts = true) : input(in), output(out), can_start(starts) {}
  bool start(const PointImage&, std::string* error) override {
    started = can_start;
    if (!can_start) *error = "no thread";
    return can_start;
  }
  void read(PointImage* image) noexcept override {
    image->value[input] = value;
    image->good[input] = good;
  }
  void write(const PointImage& image) noexcept override { written = image.value[output]; }
  void stop() noexcept override { stopped = true; }

  unsigned input, output;
  bool can_start, started = false, stopped = false;
  std::uint32_t value = 0, written = 0;
  std::uint8_t good = 0;
};

class CompositeTest : public testing::Test {
 protected:
  static nc::hal::PointTable table() {
    nc::hal::PointTable points;
    points.add({"own_in", PointType::kBit, PointDirection::kInput, 1});
    points.add({"bus1_in", PointType::kWord, PointDirection::kInput, 5, 1});
    points.add({"bus1_out", PointType::kWord, PointDirection::kOutput, 0, 1});
    points.add({"bus2_in", PointType::kWord, PointDirection::kInput, 0, 2});
    points.add({"bus2_out", PointType::kWord, PointDirection::kOutput, 0, 2});
    points.add({"own_out", PointType::kBit, PointDirection::kOutput, 0});
    return points;
  }
  const nc::hal::PointTable points = table();
  nc::hal::SimConfig sim;
  nc::hal::SimMachine machine{sim, points};
  FakeBus bus1{1, 2}, bus2{3, 4};
  nc::hal::Composite hal{&machine, {&bus1, &bus2}, points};
  PointImage image;
  nc::hal::Feedback feedback;
  std::string error;
};

TEST_F(CompositeTest, EachReadsAndWritesItsOwnPoints) {
  image.value[0] = 1;
  ASSERT_TRUE(hal.start(image, &error));
  bus1.value = 11;
  bus1.good = 1;
  bus2.value = 22;
  hal.read(&feedback, &image);
  EXPECT_EQ(image.value[0], 1u);
  EXPECT_EQ(image.value[1], 11u);
  EXPECT_EQ(image.value[3], 22u);
  EXPECT_EQ(image.good[0], 1);
  EXPECT_EQ(image.good[5], 1);
  EXPECT_EQ(image.good[1], 1);
  EXPECT_EQ(image.good[3], 0);
  image.value[2] = 7;
  image.value[4] = 8;
  hal.write({}, image);
  EXPECT_EQ(bus1.written, 7u);
  EXPECT_EQ(bus2.written, 8u);
  hal.stop();
  EXPECT_TRUE(machine.stopped() && bus1.stopped && bus2.stopped);
}

TEST_F(CompositeTest, ALostMachineMakesItsPointsBadAndNoOthers) {
  ASSERT_TRUE(hal.start(image, &error));
  bus1.good = 1;
  machine.fail_bus(true);
  hal.read(&feedback, &image);
  EXPECT_EQ(image.good[0], 0);
  EXPECT_EQ(image.good[5], 0);
  EXPECT_EQ(image.good[1], 1);
  machine.fail_bus(false);
  hal.read(&feedback, &image);
  EXPECT_EQ(image.good[0], 1);
}

TEST_F(CompositeTest, ABusThatDoesNotStartIsAnErrorAndEverythingCanBeStopped) {
  FakeBus broken(3, 4, false);
  nc::hal::Composite with_broken(&machine, {&bus1, &broken}, points);
  EXPECT_FALSE(with_broken.start(image, &error));
  EXPECT_EQ(error, "no thread");
  with_broken.stop();
  EXPECT_TRUE(machine.stopped() && bus1.stopped && broken.stopped);
}

TEST(ModbusTripleBuffer, NewestWinsAndNothingIsTorn) {
  nc::hal::TripleBuffer<std::vector<std::uint64_t>> buffer(std::vector<std::uint64_t>(64, 0));
  EXPECT_FALSE(buffer.take());
  constexpr std::uint64_t kStates = 200000;
  std::thread writer([&] {
    for (std::uint64_t n = 1; n <= kStates; ++n) {
      for (std::uint64_t& cell : buffer.back()) cell = n;
      buffer.publish();
    }
  });
  std::uint64_t last = 0;
  bool whole = true, forward = true;
  while (last != kStates) {
    if (!buffer.take()) continue;
    const std::vector<std::uint64_t>& state = buffer.front();
    for (const std::uint64_t cell : state) whole &= cell == state[0];
    forward &= state[0] > last;
    last = state[0];
  }
  writer.join();
  EXPECT_TRUE(whole);
  EXPECT_TRUE(forward);
  EXPECT_FALSE(buffer.take()) << "nothing new behind the last state";
}

}  // namespace
