// SPDX-License-Identifier: Apache-2.0
// A Modbus link on a serial line: exchange, silent units, late and damaged answers, a line that vanishes, stop.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <random>
#include <thread>

#include "hal/modbus/rtu_session.hpp"
#include "hal/serial_key.hpp"
#include "modbus/link_rig.hpp"
#include "modbus/serial_device.hpp"

namespace {

using namespace nc::test;
using nc::hal::modbus::SerialConfig;

TEST(ModbusSerial, EveryTableBothWaysTwoUnits) {
  SerialDevice device;
  device.tables().with([](auto& units) {
    units[1].coil = {{0, 1}, {5, 0}, {6, 0}};
    units[1].discrete = {{100, 1}};
    units[247].input = {{7, 0xFFFE}};
    units[247].holding = {{65534, 0x1234}, {65535, 0x5678}, {20, 0}, {21, 0}};
  });
  LinkRig rig;
  const unsigned coil = rig.add(Table::kCoil, 0), discrete = rig.add(Table::kDiscrete, 100);
  const unsigned input = rig.add(Table::kInput, 7, Format::kS16, false, 247);
  const unsigned wide = rig.add(Table::kHolding, 65534, Format::kU32, false, 247);
  const unsigned horn = rig.add(Table::kCoil, 6, Format::kBit, true);
  const unsigned speed = rig.add(Table::kHolding, 20, Format::kU32, true, 247);
  rig.start_serial(device.path());
  ASSERT_TRUE(rig.until([&] { return rig.link->statistics().state == LinkState::kOk && rig.good(wide); })) << rig.log();
  EXPECT_EQ(rig.value(coil), 1u);
  EXPECT_EQ(rig.value(discrete), 1u);
  EXPECT_EQ(static_cast<std::int32_t>(rig.value(input)), -2);
  EXPECT_EQ(rig.value(wide), 0x12345678u);
  rig.image.value[horn] = 1;
  rig.image.value[speed] = 0xABCD0001;
  EXPECT_TRUE(rig.until([&] { return device.tables().coil(1, 6) == 1 && device.tables().holding(247, 20) == 0xABCD && device.tables().holding(247, 21) == 1; }));
  EXPECT_EQ(rig.link->statistics().errors, 0u) << rig.log();
  EXPECT_EQ(device.damaged(), 0u);
  EXPECT_NE(rig.log().find("connected to " + device.path()), std::string::npos) << rig.log();
}

TEST(ModbusSerial, FramesArePartedByTheSilenceOfTheStandard) {
  SerialConfig line;
  line.baud = 9600;
  EXPECT_EQ(line.bits_per_character(), 11u);
  EXPECT_NEAR(static_cast<double>(nc::hal::modbus::frame_gap(line).count()), 3.5e6 * 11 / 9600, 2);
  line.baud = 19200;
  EXPECT_NEAR(static_cast<double>(nc::hal::modbus::frame_gap(line).count()), 3.5e6 * 11 / 19200, 2);
  line.baud = 115200;
  EXPECT_EQ(nc::hal::modbus::frame_gap(line).count(), 1750);

  SerialDevice device;
  device.tables().with([](auto& units) { units[1].holding = {{0, 5}, {9, 6}}; });
  LinkRig rig;
  rig.config.serial.baud = 9600;
  rig.config.poll_ms = 1;
  rig.add(Table::kHolding, 0, Format::kU16);
  rig.add(Table::kHolding, 9, Format::kU16);  // another request
  rig.start_serial(device.path());
  ASSERT_TRUE(rig.until([&] { return rig.link->statistics().requests > 40; })) << rig.log();
  EXPECT_GE(device.shortest_gap_us(), 3.5e6 * 11 / 9600 - 100);
}

TEST(ModbusSerial, ASilentUnitIsLostAndItsNeighbourGoesOn) {
  SerialDevice device;
  device.tables().with([](auto& units) {
    units[1].holding = {{0, 5}};
    units[2].holding = {{0, 6}, {1, 0}};
  });
  LinkRig rig;
  rig.short_timeouts(40);
  const unsigned alive = rig.add(Table::kHolding, 0, Format::kU16, false, 1), dead = rig.add(Table::kHolding, 0, Format::kU16, false, 2);
  const unsigned lamp = rig.add(Table::kHolding, 1, Format::kU16, true, 2);
  rig.start_serial(device.path());
  ASSERT_TRUE(rig.until([&] { return rig.good(alive) && rig.good(dead) && rig.good(lamp); })) << rig.log();
  rig.image.value[lamp] = 9;
  ASSERT_TRUE(rig.until([&] { return device.tables().holding(2, 1) == 9; }));
  device.set_silent({2});
  ASSERT_TRUE(rig.until([&] { return !rig.good(dead); }));
  EXPECT_EQ(rig.value(dead), 0u);
  device.tables().with([](auto& units) { units[1].holding[0] = 50; units[2].holding[1] = 0; });  // it has lost its memory
  EXPECT_TRUE(rig.until([&] { return rig.good(alive) && rig.value(alive) == 50; }));
  EXPECT_TRUE(rig.ok());
  EXPECT_EQ(rig.link->statistics().connects, 1u) << "the line stays open";
  device.set_silent({});
  EXPECT_TRUE(rig.until([&] { return rig.good(dead) && rig.value(dead) == 6; }));
  EXPECT_TRUE(rig.until([&] { return device.tables().holding(2, 1) == 9; })) << "the output is written again";
}

// The answer to one request comes when the next is under way. It looks like the answer to that.
TEST(ModbusSerial, ALateAnswerIsTakenForNoOther) {
  SerialDevice device;
  device.tables().with([](auto& units) { units[1].holding = {{0, 100}, {10, 200}}; });
  LinkRig rig;
  rig.short_timeouts(300);
  rig.config.lost_after = 100;
  const unsigned first = rig.add(Table::kHolding, 0, Format::kU16), second = rig.add(Table::kHolding, 10, Format::kU16);
  rig.start_serial(device.path());
  std::mt19937 random(5);
  unsigned late = 0;
  device.set_fault([&](const Bytes&, Answer right) {
    if (random() % 4 != 0) return right;
    // Behind the time-out, and by much less than it.
    const std::uint64_t before = rig.link->statistics().timeouts;
    for (unsigned n = 0; n < 10000 && rig.link->statistics().timeouts == before; ++n) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ++late;
    return right;
  });
  ASSERT_TRUE(rig.until([&] {
    EXPECT_TRUE(!rig.good(first) || rig.value(first) == 100) << rig.value(first);
    EXPECT_TRUE(!rig.good(second) || rig.value(second) == 200) << rig.value(second);
    return rig.link->statistics().timeouts > 6;
  })) << rig.log();
  device.set_fault({});
  EXPECT_GT(late, 5u);
}

TEST(ModbusSerial, WhatIsNoAnswerToTheRequestIsNotBelieved) {
  SerialDevice device;
  device.tables().with([](auto& units) { units[1].holding = {{0, 5}}; });
  LinkRig rig;
  rig.short_timeouts(60);
  const unsigned point = rig.add(Table::kHolding, 0, Format::kU16);
  rig.map().on_loss = OnLoss::kValue;
  rig.map().loss_value = 99;
  rig.start_serial(device.path());
  ASSERT_TRUE(rig.until([&] { return rig.good(point) && rig.value(point) == 5; }));
  const struct {
    const char* name;
    Bytes answer;
  } kWrong[] = {
      {"check sum", {1, 3, 2, 2, 154, 0, 0}},
      {"unit", rtu_frame({2, 3, 2, 2, 154})},
      {"function", rtu_frame({1, 4, 2, 2, 154})},
      {"count", rtu_frame({1, 3, 4, 2, 154, 2, 154})},
      {"half", {1, 3, 2, 2}},
      {"two at once", [] { Bytes b = rtu_frame({1, 3, 2, 2, 154}); const Bytes c = b; b.insert(b.end(), c.begin(), c.end()); b[5] ^= 1; return b; }()},
      {"noise", Bytes(40, 0x55)},
  };
  for (const auto& wrong : kWrong) {
    SCOPED_TRACE(wrong.name);
    device.set_fault([&](const Bytes&, Answer right) {
      right.bytes = wrong.answer;
      return right;
    });
    const std::uint64_t errors = rig.link->statistics().errors;
    ASSERT_TRUE(rig.until([&] {
      EXPECT_TRUE(rig.value(point) == 5 || rig.value(point) == 99) << rig.value(point);
      return !rig.good(point) && rig.link->statistics().errors >= errors + 2;
    })) << rig.log();
    device.set_fault({});
    ASSERT_TRUE(rig.until([&] { return rig.good(point) && rig.value(point) == 5; })) << rig.log();
  }
}

TEST(ModbusSerial, BytesThatNobodyAskedForAreAnErrorAndGoAway) {
  SerialDevice device;
  device.tables().with([](auto& units) { units[1].holding = {{0, 5}}; });
  LinkRig rig;
  rig.short_timeouts(200);
  rig.config.poll_ms = 60;
  const unsigned point = rig.add(Table::kHolding, 0, Format::kU16);
  rig.start_serial(device.path());
  ASSERT_TRUE(rig.until([&] { return rig.good(point); }));
  for (unsigned n = 0; n < 3; ++n) {
    const std::uint64_t errors = rig.link->statistics().errors, requests = rig.link->statistics().requests;
    ASSERT_TRUE(rig.until([&] { return rig.link->statistics().requests > requests; }));
    device.put(rtu_frame({1, 3, 2, 2, 154}));
    ASSERT_TRUE(rig.until([&] {
      EXPECT_NE(rig.value(point), 666u);
      return rig.link->statistics().errors > errors;
    })) << rig.log();
    ASSERT_TRUE(rig.until([&] { return rig.good(point) && rig.value(point) == 5; }));
  }
}

// Of two units on one line: flipped bits, ends that are missing, noise in front and behind, answers of the other unit, answers cut in two, and silence, in any order. What is
// shown is what the units have, or the value for a loss; and with the noise gone both are there again.
TEST(ModbusSerial, AnyDamageShowsNoWrongValueAndHeals) {
  constexpr unsigned kAnswers = 400;
  std::mt19937 random(20260404);  // in front of the device, whose thread uses them until its end
  std::atomic<unsigned> answers{0};
  SerialDevice device;
  device.tables().with([](auto& units) {
    units[1].holding = {{0, 500}};
    units[2].holding = {{0, 700}};
  });
  LinkRig rig;
  rig.short_timeouts(20);
  rig.config.poll_ms = 1;
  rig.config.serial.baud = 115'200;
  const unsigned first = rig.add(Table::kHolding, 0, Format::kU16, false, 1);
  rig.map().on_loss = OnLoss::kValue;
  rig.map().loss_value = 99;
  const unsigned second = rig.add(Table::kHolding, 0, Format::kU16, false, 2);
  device.set_fault([&](const Bytes&, Answer right) {
    const auto pick = [&](std::size_t n) { return static_cast<unsigned>(random() % n); };
    if (right.bytes.empty() || answers.fetch_add(1) >= kAnswers) return right;
    switch (pick(9)) {
      case 0: right.bytes[pick(right.bytes.size())] ^= static_cast<std::uint8_t>(1u << pick(8)); break;
      case 1: right.bytes.resize(pick(right.bytes.size())); break;
      case 2: right.bytes.insert(right.bytes.begin(), static_cast<std::uint8_t>(random())); break;
      case 3: right.bytes.push_back(static_cast<std::uint8_t>(random())); break;
      case 4: right.bytes = rtu_frame({static_cast<std::uint8_t>(right.bytes[0] == 1 ? 2 : 1), 3, 2, 3, 33}); break;
      case 5: {
        Bytes noise(1 + pick(60));
        for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random());
        right.bytes = noise;
        break;
      }
      case 6: right.bytes.clear(); break;
      case 7: {
        const Bytes once = right.bytes;
        right.bytes.insert(right.bytes.end(), once.begin(), once.end());
        break;
      }
      default: break;
    }
    return right;
  });
  rig.start_serial(device.path());
  ASSERT_TRUE(rig.until([&] {
    EXPECT_TRUE(rig.value(first) == 500 || rig.value(first) == 99) << rig.value(first);
    EXPECT_TRUE(rig.value(second) == 700 || rig.value(second) == 0) << rig.value(second);
    EXPECT_TRUE(!rig.good(first) || rig.value(first) == 500);
    EXPECT_TRUE(!rig.good(second) || rig.value(second) == 700);
    return testing::Test::HasFailure() || answers >= kAnswers;
  }, 120)) << answers << rig.log();
  EXPECT_TRUE(rig.until([&] { return rig.good(first) && rig.good(second) && rig.value(first) == 500 && rig.value(second) == 700; })) << rig.log();
  EXPECT_GT(rig.link->statistics().errors, kAnswers / 10);
}

TEST(ModbusSerial, AnExceptionIsAnAnswer) {
  SerialDevice device;
  device.tables().with([](auto& units) { units[1].holding = {{0, 5}}; });
  LinkRig rig;
  const unsigned there = rig.add(Table::kHolding, 0, Format::kU16), nowhere = rig.add(Table::kHolding, 500, Format::kU16);
  rig.start_serial(device.path());
  ASSERT_TRUE(rig.until([&] { return rig.good(there) && rig.link->statistics().exceptions > 0; }));
  EXPECT_FALSE(rig.good(nowhere));
  EXPECT_EQ(rig.link->statistics().errors, 0u);
  EXPECT_TRUE(rig.until([&] { return rig.log().find("holding 500 unit 1, function 3: Illegal data address") != std::string::npos; })) << rig.log();  // said behind the count
}

TEST(ModbusSerial, ALineThatVanishesIsOpenedAgainWhereItComesBack) {
  auto device = std::make_unique<SerialDevice>();
  device->tables().with([](auto& units) { units[1].holding = {{0, 5}}; });
  const std::string name = "/tmp/nc-serial-" + std::to_string(::getpid());
  std::remove(name.c_str());
  ASSERT_EQ(::symlink(device->path().c_str(), name.c_str()), 0);
  LinkRig rig;
  rig.short_timeouts(200);
  const unsigned point = rig.add(Table::kHolding, 0, Format::kU16);
  rig.start_serial(name);
  ASSERT_TRUE(rig.until([&] { return rig.good(point); }));
  device->vanish();
  ASSERT_TRUE(rig.until([&] { return !rig.ok(); })) << rig.log();
  EXPECT_FALSE(rig.good(point));
  EXPECT_NE(rig.log().find("lost: "), std::string::npos) << rig.log();
  device = std::make_unique<SerialDevice>();
  device->tables().with([](auto& units) { units[1].holding = {{0, 7}}; });
  std::remove(name.c_str());
  ASSERT_EQ(::symlink(device->path().c_str(), name.c_str()), 0);
  EXPECT_TRUE(rig.until([&] { return rig.good(point) && rig.value(point) == 7; })) << rig.log();
  std::remove(name.c_str());
}

TEST(ModbusSerial, ALineThatIsNotThereIsNamed) {
  LinkRig rig;
  rig.add(Table::kHolding, 0, Format::kU16);
  rig.start_serial("/dev/nc-no-such-line");
  ASSERT_TRUE(rig.until([&] { return rig.log().find("lost: ") != std::string::npos; }));
  EXPECT_NE(rig.log().find("serial line /dev/nc-no-such-line: No such file or directory"), std::string::npos) << rig.log();
}

TEST(ModbusSerial, ADriverWithoutRs485IsNamed) {
  SerialDevice device;
  LinkRig rig;
  rig.add(Table::kHolding, 0, Format::kU16);
  rig.config.serial.rs485 = nc::hal::modbus::Rs485::kDriver;
  rig.start_serial(device.path());
  ASSERT_TRUE(rig.until([&] { return rig.log().find("lost: ") != std::string::npos; }));
  EXPECT_NE(rig.log().find("rs485: "), std::string::npos) << rig.log();
}

TEST(ModbusSerial, SafeValuesAreWrittenAtTheEndAndASilentLineDoesNotHoldIt) {
  SerialDevice device;
  device.tables().with([](auto& units) { units[1].holding = {{0, 0}}; });
  {
    LinkRig rig;
    const unsigned out = rig.add(Table::kHolding, 0, Format::kU16, true);
    rig.map().initial = 8;
    rig.start_serial(device.path());
    rig.image.value[out] = 50;
    ASSERT_TRUE(rig.until([&] { return device.tables().holding(1, 0) == 50; }));
    rig.link->stop();
    EXPECT_EQ(device.tables().holding(1, 0), 8);
  }
  LinkRig rig;
  rig.config.response_timeout_ms = 60000;
  rig.config.byte_timeout_ms = 100;
  const unsigned out = rig.add(Table::kHolding, 0, Format::kU16, true);
  rig.start_serial(device.path());
  rig.image.value[out] = 50;
  ASSERT_TRUE(rig.until([&] { return device.tables().holding(1, 0) == 50; }));
  device.set_silent({1});
  rig.image.value[out] = 51;
  for (unsigned n = 0; n < 20; ++n) {
    rig.scan();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const auto begin = std::chrono::steady_clock::now();
  rig.link->stop();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(40)) << "not the time of an answer";
}

TEST(SerialKey, TwoNamesOfOneLineAreOne) {
  SerialDevice device;
  const std::string name = "/tmp/nc-serial-key-" + std::to_string(::getpid());
  std::remove(name.c_str());
  ASSERT_EQ(::symlink(device.path().c_str(), name.c_str()), 0);
  EXPECT_EQ(nc::hal::serial_key(name), nc::hal::serial_key(device.path()));
  SerialDevice other;
  EXPECT_NE(nc::hal::serial_key(name), nc::hal::serial_key(other.path()));
  EXPECT_NE(nc::hal::serial_key("/dev/nc-none"), nc::hal::serial_key("/dev/nc-none-either"));
  std::remove(name.c_str());
}

}  // namespace
