// SPDX-License-Identifier: Apache-2.0
// A bank of GPIO lines as a point bus: its thread, and the image that it exchanges with the scan.
#include "hal/gpio/gpio_bus.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <thread>

#include "fake_lines.hpp"
#include "hal/bus_thread.hpp"

namespace {

using nc::hal::PointImage;
using nc::hal::gpio::BankConfig;
using nc::hal::gpio::GpioBus;
using nc::test::FakeBoard;
using nc::test::FakeChip;
using nc::test::gpio_line;

constexpr unsigned kOk = 0, kDoor = 1, kStop = 2, kLamp = 3;

class GpioBusTest : public testing::Test {
 protected:
  GpioBusTest() {
    config.name = "board";
    config.chip = "fake";
    config.ok_point = kOk;
    config.lines = {gpio_line(kDoor, "door", false), gpio_line(kStop, "stop", false), gpio_line(kLamp, "lamp", true)};
    config.lines[1].hold_on_loss = true;
  }
  ~GpioBusTest() override {
    set([](FakeBoard& b) { b.stuck = false; });
    board.wake.notify_all();
    if (bus) bus->stop();
  }
  bool start() {
    bus = std::make_unique<GpioBus>(config, std::make_unique<FakeChip>(&board));
    return bus->start(image, &error);
  }
  void set(const std::function<void(FakeBoard&)>& change) {
    const std::lock_guard lock(board.mutex);
    change(board);
  }
  unsigned level(const std::string& line) {
    const std::lock_guard lock(board.mutex);
    return board.level[line];
  }
  // Scans until `so` returns true; false if it does not within a minute, which is far too long.
  bool until(const std::function<bool()>& so) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    do {
      bus->read(&image);
      bus->write(image);
      if (so()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } while (std::chrono::steady_clock::now() < end);
    return false;
  }

  FakeBoard board;
  BankConfig config;
  std::unique_ptr<GpioBus> bus;
  PointImage image;
  std::string error;
};

TEST_F(GpioBusTest, PointsAndLinesFollowEachOther) {
  image.value[kLamp] = 1;
  ASSERT_TRUE(start()) << error;
  EXPECT_EQ(level("lamp"), 1u) << "the initial value, from the request on";
  ASSERT_TRUE(until([&] { return image.good[kDoor] != 0; }));
  EXPECT_EQ(image.value[kOk], 1u);
  EXPECT_EQ(image.good[kOk], 1);
  EXPECT_EQ(image.good[kLamp], 1);
  EXPECT_EQ(image.value[kLamp], 1u) << "an output is not overwritten";
  set([](FakeBoard& b) { b.level["door"] = 1; });
  EXPECT_TRUE(until([&] { return image.value[kDoor] == 1; }));
  image.value[kLamp] = 0;
  EXPECT_TRUE(until([&] { return level("lamp") == 0; }));
}

TEST_F(GpioBusTest, AChipThatIsPulledOutAndPutInAgain) {
  ASSERT_TRUE(start());
  set([](FakeBoard& b) { b.level["door"] = b.level["stop"] = 1; });
  ASSERT_TRUE(until([&] { return image.value[kDoor] == 1 && image.value[kStop] == 1; }));
  set([](FakeBoard& b) { b.present = false; });
  ASSERT_TRUE(until([&] { return image.value[kOk] == 0; }));
  EXPECT_EQ(image.good[kDoor] + image.good[kStop] + image.good[kLamp], 0);
  EXPECT_EQ(image.value[kDoor], 0u);
  EXPECT_EQ(image.value[kStop], 1u) << "holds";
  set([](FakeBoard& b) { b.present = true; });
  ASSERT_TRUE(until([&] { return image.value[kOk] == 1 && image.value[kDoor] == 1; }));
  EXPECT_EQ(image.good[kLamp], 1);
}

TEST_F(GpioBusTest, AThreadThatIsStuckIsSeenByTheScan) {
  ASSERT_TRUE(start());
  set([](FakeBoard& b) { b.level["door"] = b.level["stop"] = 1; });
  ASSERT_TRUE(until([&] { return image.value[kDoor] == 1 && image.value[kStop] == 1; }));
  set([](FakeBoard& b) { b.stuck = true; });
  ASSERT_TRUE(until([&] { return image.value[kOk] == 0; }));
  EXPECT_EQ(image.good[kDoor] + image.good[kStop] + image.good[kLamp], 0);
  EXPECT_EQ(image.value[kDoor], 0u);
  EXPECT_EQ(image.value[kStop], 1u);
  set([](FakeBoard& b) { b.stuck = false; });
  board.wake.notify_all();
  EXPECT_TRUE(until([&] { return image.value[kOk] == 1 && image.good[kDoor] != 0; }));
}

TEST_F(GpioBusTest, TheWatchdogGoesToAndFroWithTheScan) {
  config.has_watchdog = true;
  config.watchdog.name = "alive";
  config.watchdog.output = true;
  ASSERT_TRUE(start());
  EXPECT_TRUE(until([&] {
    const std::lock_guard lock(board.mutex);
    return board.changes["alive"] >= 6;
  }));
}

TEST_F(GpioBusTest, ATakenLineEndsTheStart) {
  board.owner["lamp"] = "leds-gpio";
  EXPECT_FALSE(start());
  EXPECT_EQ(error, "GPIO board: line lamp is taken by \"leds-gpio\"");
  bus->stop();
}

TEST_F(GpioBusTest, TheEndWritesItsValuesAndAStartAfterItBeginsAnew) {
  config.lines[2].stop_value = 1;
  ASSERT_TRUE(start());
  ASSERT_TRUE(until([&] { return image.good[kDoor] != 0; }));
  bus->stop();
  EXPECT_EQ(level("lamp"), 1u);
  EXPECT_EQ(board.releases, 1u);
  set([](FakeBoard& b) { b.level["door"] = 1; });
  image.value[kLamp] = 0;
  ASSERT_TRUE(bus->start(image, &error)) << error;
  EXPECT_EQ(level("lamp"), 0u);
  EXPECT_TRUE(until([&] { return image.value[kDoor] == 1 && image.good[kDoor] != 0; }));
}

TEST_F(GpioBusTest, AnEdgeOfAProbeIsSeenByOneScan) {
  config.lines[0].line.edges = true;
  config.probes.push_back({0, 1, 4, false});
  nc::hal::gpio::Encoder encoder;
  encoder.point = 7;
  encoder.a.name = "a";
  encoder.b.name = "b";
  encoder.a.edges = encoder.b.edges = true;
  config.encoders.push_back(encoder);
  ASSERT_TRUE(start()) << error;
  ASSERT_EQ(bus->probes().size(), 1u);
  EXPECT_EQ(bus->probes()[0].system, 1);
  EXPECT_EQ(bus->probes()[0].signal, 4);
  ASSERT_TRUE(until([&] { return image.good[kDoor] != 0 && image.good[7] != 0; }));
  EXPECT_FALSE(bus->probes()[0].on || bus->probes()[0].edge);
  const std::int64_t when = nc::hal::monotonic_ns();
  set([when](FakeBoard& b) {
    b.turn("door", true, when);
    b.turn("a", true, when);
    b.turn("b", true, when + 1);
  });
  ASSERT_TRUE(until([&] { return bus->probes()[0].edge; }));
  EXPECT_EQ(bus->probes()[0].edge_ns, when);
  EXPECT_TRUE(bus->probes()[0].on);
  EXPECT_EQ(image.value[kDoor], 1u);
  bus->read(&image);
  EXPECT_TRUE(bus->probes()[0].on && !bus->probes()[0].edge);
  EXPECT_TRUE(until([&] { return image.value[7] == 2; }));
}

}  // namespace
