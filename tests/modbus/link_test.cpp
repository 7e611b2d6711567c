// SPDX-License-Identifier: Apache-2.0
// A Modbus link against a server on loopback: exchange, loss, exceptions, stop.
#include <pthread.h>

#include <algorithm>
#include <thread>

#include "modbus/link_rig.hpp"

namespace {

using namespace nc::test;

TEST(ModbusLink, EveryTableBothWaysTwoUnits) {
  LoopbackServer server;
  server.with([](auto& units) {
    units[1].coil = {{0, 1}, {5, 0}, {6, 0}};
    units[1].discrete = {{100, 1}};
    units[2].input = {{7, 0xFFFE}};
    units[2].holding = {{65534, 0x5678}, {65535, 0x1234}, {20, 0}, {21, 0}, {30, 0}};
  });
  LinkRig rig;
  const unsigned coil = rig.add(Table::kCoil, 0), discrete = rig.add(Table::kDiscrete, 100);
  const unsigned input = rig.add(Table::kInput, 7, Format::kS16, false, 2);
  const unsigned wide = rig.add(Table::kHolding, 65534, Format::kU32, false, 2);
  rig.map().order = nc::hal::modbus::WordOrder::kCdab;
  const unsigned lamp = rig.add(Table::kCoil, 5, Format::kBit, true),
                 horn = rig.add(Table::kCoil, 6, Format::kBit, true);
  const unsigned speed = rig.add(Table::kHolding, 20, Format::kF32, true, 2);
  rig.map().scale = 0.5;
  const unsigned enable = rig.add(Table::kHolding, 30, Format::kBit, true, 2);
  rig.map().bit = 3;
  const unsigned brake = rig.add(Table::kHolding, 30, Format::kBit, true, 2);
  rig.map().bit = 15;
  rig.start(server.port());
  ASSERT_TRUE(rig.until([&] { return rig.link->statistics().state == LinkState::kOk; }));
  rig.scan();
  for (const unsigned point : {coil, discrete, input, wide, lamp, horn, speed, enable, brake})
    EXPECT_TRUE(rig.good(point));
  EXPECT_TRUE(rig.ok());
  EXPECT_EQ(rig.value(coil), 1u);
  EXPECT_EQ(rig.value(discrete), 1u);
  EXPECT_EQ(static_cast<std::int32_t>(rig.value(input)), -2);
  EXPECT_EQ(rig.value(wide), 0x12345678u);
  rig.image.value[horn] = rig.image.value[brake] = 1;
  rig.image.value[speed] = 3;
  EXPECT_TRUE(rig.until([&] {
    return server.coil(1, 6) == 1 && server.holding(2, 30) == 0x8000 && server.holding(2, 20) == 0x40C0;
  }));
  EXPECT_EQ(server.coil(1, 5), 0);
  EXPECT_EQ(server.holding(2, 21), 0) << "6.0 as a float: 40C0 0000";
  rig.image.value[enable] = 1;
  EXPECT_TRUE(rig.until([&] { return server.holding(2, 30) == 0x8008; }));
  server.with([](auto& units) { units[2].input[7] = 40; });
  EXPECT_TRUE(rig.until([&] { return rig.value(input) == 40; }));
  const auto statistics = rig.link->statistics();
  EXPECT_EQ(statistics.errors + statistics.timeouts + statistics.exceptions + statistics.reconnects(), 0u);
  EXPECT_GT(statistics.requests, 5u);
  EXPECT_GT(statistics.round_trip_mean_us, 0.0);
  EXPECT_GE(statistics.round_trip_max_us, statistics.round_trip_us);
}

// Four inputs, one for each reaction to a loss, which are all 5 while the link works.
struct LossRig : LinkRig {
  LossRig() {
    off = add(Table::kHolding, 0, Format::kU16);
    hold = add(Table::kHolding, 1, Format::kU16);
    map().on_loss = OnLoss::kHold;
    map().initial = 77;
    value = add(Table::kHolding, 2, Format::kU16);
    map().on_loss = OnLoss::kValue;
    map().loss_value = 99;
    out = add(Table::kHolding, 3, Format::kU16, true);
    map().initial = 8;
  }
  static void fill(LoopbackServer* server) {
    server->with([](auto& units) { units[1].holding = {{0, 5}, {1, 5}, {2, 5}, {3, 0}}; });
  }
  bool there() const {
    return ok() && good(off) && good(hold) && good(value) && LinkRig::value(off) == 5 &&
           LinkRig::value(value) == 5;
  }
  bool gone() const { return !ok() && !good(off) && !good(hold) && !good(value) && !good(out); }
  unsigned off, hold, value, out;
};

TEST(ModbusLink, NotThereAtTheStartThenThere) {
  std::uint16_t port = 0;
  { port = LoopbackServer().port(); }
  LossRig rig;
  rig.start(port);
  ASSERT_TRUE(rig.until([&] { return rig.link->statistics().errors > 3; }));
  rig.scan();
  EXPECT_TRUE(rig.gone());
  EXPECT_EQ(rig.value, 3u);
  EXPECT_EQ(rig.image.value[rig.off], 0u);
  EXPECT_EQ(rig.image.value[rig.hold], 77u) << "nothing to hold yet: the initial value";
  EXPECT_EQ(rig.image.value[rig.value], 99u);
  EXPECT_NE(rig.link->statistics().last_error.find("connect to 127.0.0.1"), std::string::npos);
  LoopbackServer server(port);
  LossRig::fill(&server);
  EXPECT_TRUE(rig.until([&] { return rig.there(); }));
  EXPECT_TRUE(rig.until([&] { return server.holding(1, 3) == 8; })) << "outputs have their initial value";
}

TEST(ModbusLink, KilledAndBack) {
  auto server = std::make_unique<LoopbackServer>();
  const std::uint16_t port = server->port();
  LossRig::fill(server.get());
  LossRig rig;
  rig.start(port);
  ASSERT_TRUE(rig.until([&] { return rig.there(); }));
  rig.image.value[rig.out] = 4;
  ASSERT_TRUE(rig.until([&] { return server->holding(1, 3) == 4 && rig.good(rig.out); }));
  server.reset();
  ASSERT_TRUE(rig.until([&] { return rig.gone(); }));
  EXPECT_EQ(rig.image.value[rig.off], 0u);
  EXPECT_EQ(rig.image.value[rig.hold], 5u);
  EXPECT_EQ(rig.image.value[rig.value], 99u);
  EXPECT_EQ(rig.link->statistics().state, LinkState::kLost);
  EXPECT_NE(rig.log().find("io: lost: "), std::string::npos) << rig.log();
  server = std::make_unique<LoopbackServer>(port);
  LossRig::fill(server.get());
  EXPECT_TRUE(rig.until([&] { return rig.there(); }));
  EXPECT_TRUE(rig.until([&] { return server->holding(1, 3) == 4; })) << "outputs are written again";
  EXPECT_GE(rig.link->statistics().reconnects(), 1u);
}

// A service manager may start the whole control with a real-time policy.
TEST(ModbusLink, StartsFromARealTimeThread) {
  LoopbackServer server;
  server.with([](auto& units) { units[1].holding = {{0, 5}}; });
  LinkRig rig;
  const unsigned there = rig.add(Table::kHolding, 0, Format::kU16);
  bool allowed = false;
  std::thread([&] {
    sched_param priority{};
    priority.sched_priority = 1;
    allowed = pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority) == 0;
    if (allowed) rig.start(server.port());
  }).join();
  if (!allowed) GTEST_SKIP() << "no real-time priority here";
  EXPECT_TRUE(rig.until([&] { return rig.good(there); }));
}

TEST(ModbusLink, AnExceptionIsNamedAndLeavesTheConnection) {
  LoopbackServer server;
  server.with([](auto& units) { units[1].holding = {{0, 5}}; });
  LinkRig rig;
  const unsigned there = rig.add(Table::kHolding, 0, Format::kU16);
  const unsigned missing = rig.add(Table::kHolding, 500, Format::kU16);
  rig.map().on_loss = OnLoss::kValue;
  rig.map().loss_value = 1;
  const unsigned no_output = rig.add(Table::kCoil, 3, Format::kBit, true);
  rig.start(server.port());
  ASSERT_TRUE(rig.until([&] { return rig.link->statistics().exceptions >= 2 && rig.good(there); }));
  rig.scan();
  EXPECT_FALSE(rig.good(missing));
  EXPECT_EQ(rig.value(missing), 1u);
  EXPECT_FALSE(rig.good(no_output));
  EXPECT_TRUE(rig.ok());
  EXPECT_EQ(rig.link->statistics().state, LinkState::kDegraded);
  EXPECT_EQ(server.connections(), 1u);
  EXPECT_EQ(rig.link->statistics().errors, 0u);
  EXPECT_NE(rig.log().find("io: holding 500 unit 1, function 3: Illegal data address"), std::string::npos)
      << rig.log();
  EXPECT_NE(rig.log().find("io: coil 3 unit 1, function 5: Illegal data address"), std::string::npos)
      << rig.log();
  server.with([](auto& units) { units[1].holding[500] = 6, units[1].coil[3] = 1; });
  EXPECT_TRUE(rig.until([&] { return rig.good(missing) && rig.value(missing) == 6 && rig.good(no_output); }));
  EXPECT_NE(rig.log().find("io: again good: holding 500 unit 1\n"), std::string::npos) << "without the old error: " << rig.log();
  EXPECT_NE(rig.log().find("io: again good: coil 3 unit 1\n"), std::string::npos) << rig.log();
  EXPECT_EQ(server.connections(), 1u);
}

// A device that is busy at every second request: each block comes and goes several times a second, for days.
TEST(ModbusLink, AnExceptionThatComesAndGoesFillsNoLog) {
  LoopbackServer server;
  LinkRig rig;
  server.with([&](auto& units) {
    for (unsigned n = 0; n < 10; ++n) units[1].holding[100 * n] = 1;
  });
  for (unsigned n = 0; n < 10; ++n) rig.add(Table::kHolding, 100 * n, Format::kU16);
  server.set_fault([times = std::map<unsigned, unsigned>()](const Bytes& request, Answer right) mutable {
    if (++times[request[8] * 256u + request[9]] % 2 == 0) right.bytes = {request[0], request[1], 0, 0, 0, 3, request[6], static_cast<std::uint8_t>(request[7] | 0x80), 6};
    return right;
  });
  rig.start(server.port());
  ASSERT_TRUE(rig.until([&] { return rig.link->statistics().exceptions >= 100; }));
  rig.link->stop();
  const std::string log = rig.log();
  EXPECT_LE(std::count(log.begin(), log.end(), '\n'), 62) << log;
  EXPECT_NE(log.find("more of these, the last one: "), std::string::npos) << log;
}

// A gateway whose unit 2 does not answer.
TEST(ModbusLink, ADeadUnitTakesNoOtherWithIt) {
  LoopbackServer server;
  server.with([](auto& units) { units[1].holding = units[2].holding = units[3].holding = {{0, 5}}; });
  LinkRig rig;
  rig.short_timeouts(150);
  const unsigned first = rig.add(Table::kHolding, 0, Format::kU16, false, 1);
  const unsigned second = rig.add(Table::kHolding, 0, Format::kU16, false, 2);
  const unsigned third = rig.add(Table::kHolding, 0, Format::kU16, false, 3);
  rig.start(server.port());
  ASSERT_TRUE(rig.until([&] { return rig.good(first) && rig.good(second) && rig.good(third); }));
  server.set_fault([](const Bytes& request, Answer right) {
    if (request[6] == 2) right.bytes.clear();
    return right;
  });
  server.with([](auto& units) { units[1].holding[0] = units[3].holding[0] = 6; });
  EXPECT_TRUE(rig.until([&] { return !rig.good(second) && rig.value(second) == 0; }));
  EXPECT_TRUE(rig.until(
      [&] { return rig.good(first) && rig.value(first) == 6 && rig.good(third) && rig.value(third) == 6; }));
  EXPECT_NE(rig.log().find("unit 2"), std::string::npos) << rig.log();
  server.set_fault({});
  EXPECT_TRUE(rig.until([&] { return rig.good(second) && rig.value(second) == 5; }));
}

// With one byte now and then no time-out of the protocol library comes, but the scan sees that the thread is stuck.
TEST(ModbusLink, AnAnswerThatDripsIsNotBelieved) {
  LoopbackServer server;
  LossRig::fill(&server);
  LossRig rig;
  rig.short_timeouts(400);
  rig.start(server.port());
  ASSERT_TRUE(rig.until([&] { return rig.there(); }));
  server.set_fault([](const Bytes&, Answer right) {
    right.drip_ms = 250;
    return right;
  });
  EXPECT_TRUE(rig.until([&] { return rig.gone(); }));
  EXPECT_EQ(rig.image.value[rig.off], 0u);
  EXPECT_EQ(rig.image.value[rig.hold], 5u);
  EXPECT_EQ(rig.image.value[rig.value], 99u);
  server.set_fault({});
  EXPECT_TRUE(rig.until([&] { return rig.there(); }));
}

TEST(ModbusLink, StopWritesTheSafeValues) {
  LoopbackServer server;
  LossRig::fill(&server);
  LossRig rig;
  rig.start(server.port());
  rig.image.value[rig.out] = 4;
  ASSERT_TRUE(rig.until([&] { return server.holding(1, 3) == 4; }));
  rig.link->stop();
  EXPECT_EQ(server.holding(1, 3), 8);
  rig.link->stop();  // a second time does nothing
  std::string error;
  EXPECT_TRUE(rig.link->start(rig.image, &error)) << "and it can be started again: " << error;
  EXPECT_TRUE(rig.until([&] { return rig.there(); }));
}

// Three adjacent coils and two registers: what becomes of each when its control ends, and with which value the next control begins.
class HoldRig : public LinkRig {
 public:
  HoldRig() {
    using nc::hal::modbus::OnStop;
    clamp = add(Table::kCoil, 10, Format::kBit, true);
    map().on_stop = OnStop::kHold;
    lamp = add(Table::kCoil, 11, Format::kBit, true);
    door = add(Table::kCoil, 12, Format::kBit, true);
    map().on_stop = OnStop::kValue;
    map().stop_value = 1;
    pressure = add(Table::kHolding, 20, Format::kU16, true);
    map().on_stop = OnStop::kHold;
    map().scale = 0.1;
  }
  static void fill(LoopbackServer* server, std::uint16_t clamped, std::uint16_t raw_pressure) {
    server->with([&](auto& units) {
      units[1].coil = {{10, clamped}, {11, 0}, {12, 0}};
      units[1].holding = {{20, raw_pressure}};
    });
  }
  // The partner counts the writes to the coil of the clamp that would open it.
  static void count_openings(LoopbackServer* server, std::atomic<unsigned>* openings) {
    server->set_fault([openings](const Bytes& request, Answer right) {
      const unsigned function = request[7], first = request[8] * 256u + request[9];
      if (function == 5 && first == 10 && request[10] == 0) ++*openings;
      if (function == 15 && first <= 10 && (request[13] >> (10 - first) & 1) == 0) ++*openings;
      return right;
    });
  }
  unsigned clamp, lamp, door, pressure;
};

TEST(ModbusLink, AtTheEndAnOutputHoldsOrHasItsValue) {
  LoopbackServer server;
  HoldRig::fill(&server, 0, 5);
  HoldRig rig;
  rig.start(server.port());
  ASSERT_TRUE(rig.until([&] { return rig.good(rig.clamp) && rig.good(rig.pressure); }));
  for (const unsigned point : {rig.clamp, rig.lamp}) rig.image.value[point] = 1;
  rig.image.value[rig.pressure] = 7;
  ASSERT_TRUE(rig.until([&] { return server.coil(1, 10) == 1 && server.coil(1, 11) == 1 && server.holding(1, 20) == 70; }));
  rig.link->stop();
  EXPECT_EQ(server.coil(1, 10), 1) << "hold";
  EXPECT_EQ(server.coil(1, 11), 0) << "initial";
  EXPECT_EQ(server.coil(1, 12), 1) << "a value";
  EXPECT_EQ(server.holding(1, 20), 70) << "hold";
}

// After a crash as after an orderly end: nothing is written to the output before the control has read it.
TEST(ModbusLink, AnOutputThatHoldsIsTakenOverAsItIsFound) {
  LoopbackServer server;
  HoldRig::fill(&server, 1, 70);
  std::atomic<unsigned> openings{0};
  HoldRig::count_openings(&server, &openings);
  HoldRig rig;
  rig.start(server.port());
  ASSERT_TRUE(rig.until([&] { return rig.good(rig.clamp) && rig.good(rig.pressure); }));
  EXPECT_EQ(rig.value(rig.clamp), 1u) << "the scan begins with it";
  EXPECT_EQ(rig.value(rig.pressure), 7u) << "in units of the point";
  rig.config.refresh_ms = 10;
  for (int n = 0; n < 100; ++n) rig.scan();
  EXPECT_EQ(openings, 0u);
  EXPECT_EQ(server.coil(1, 10), 1);
  EXPECT_EQ(server.holding(1, 20), 70);
  rig.image.value[rig.clamp] = 0;  // from then on the control decides
  EXPECT_TRUE(rig.until([&] { return server.coil(1, 10) == 0; }));
}

// The partner starts later than the control, which has meanwhile commanded the clamp to open.
TEST(ModbusLink, WhatTheControlWantsGoesBeforeWhatIsFound) {
  LoopbackServer server;
  HoldRig::fill(&server, 1, 70);
  HoldRig rig;
  rig.config.points[0].initial = 1;
  rig.start(server.port());
  rig.image.value[rig.clamp] = 0;
  rig.link->write(rig.image);  // before the first look at what has been read
  EXPECT_TRUE(rig.until([&] { return server.coil(1, 10) == 0; }));
  EXPECT_EQ(rig.value(rig.clamp), 0u);
  EXPECT_EQ(server.holding(1, 20), 70) << "nobody has asked for anything else";
}

TEST(ModbusLink, OutputsThatCannotBeReadBackBeginAsOthersAndThatIsSaid) {
  LoopbackServer server;
  HoldRig::fill(&server, 1, 70);
  server.set_fault([](const Bytes& request, Answer right) {
    if (request[7] == 1) {  // read coils: illegal function
      right.bytes.resize(9);
      right.bytes[5] = 3;
      right.bytes[7] = 0x81;
      right.bytes[8] = 1;
    }
    return right;
  });
  HoldRig rig;
  rig.start(server.port());
  EXPECT_TRUE(rig.until([&] { return server.coil(1, 10) == 0 && rig.good(rig.clamp); }));
  EXPECT_NE(rig.log().find("cannot be read back: coil 10 unit 1, function 1"), std::string::npos) << rig.log();
  EXPECT_EQ(server.holding(1, 20), 70);
}

// The partner gives this exception instead of the first `times` answers to "read coils".
void refuse_reading_coils(LoopbackServer* server, std::uint8_t exception, unsigned times, std::atomic<unsigned>* openings) {
  server->set_fault([=, left = times](const Bytes& request, Answer right) mutable {
    if (request[7] == 5 && request[9] == 10 && request[10] == 0) ++*openings;
    if (request[7] == 15 && request[9] == 10 && (request[13] & 1) == 0) ++*openings;
    if (request[7] != 1 || left == 0) return right;
    --left;
    right.bytes.resize(9);
    right.bytes[5] = 3;
    right.bytes[7] = 0x81;
    right.bytes[8] = exception;
    return right;
  });
}

// A station that has just been switched on is busy, or its gateway does not reach it yet: that passes, and says nothing about the clamp.
TEST(ModbusLink, AnExceptionThatPassesDoesNotOpenWhatHolds) {
  for (const std::uint8_t exception : {3, 4, 5, 6, 7, 8, 10, 11}) {
    LoopbackServer server;
    HoldRig::fill(&server, 1, 70);
    std::atomic<unsigned> openings{0};
    refuse_reading_coils(&server, exception, 2, &openings);
    HoldRig rig;
    rig.start(server.port());
    EXPECT_TRUE(rig.until([&] { return rig.good(rig.clamp); })) << int{exception};
    EXPECT_EQ(rig.value(rig.clamp), 1u) << int{exception};
    EXPECT_EQ(openings, 0u) << int{exception};
    EXPECT_NE(rig.log().find("io: coil 10 unit 1, function 1: "), std::string::npos) << rig.log();
    EXPECT_NE(rig.log().find("io: again good: coil 10 unit 1"), std::string::npos) << rig.log();
    EXPECT_EQ(rig.log().find("initial values"), std::string::npos) << rig.log();
  }
}

TEST(ModbusLink, WhatTheControlWantsDoesNotWaitForAReadThatNeverSucceeds) {
  LoopbackServer server;
  HoldRig::fill(&server, 0, 70);
  std::atomic<unsigned> openings{0};
  refuse_reading_coils(&server, 4, ~0u, &openings);
  HoldRig rig;
  rig.start(server.port());
  ASSERT_TRUE(rig.until([&] { return rig.log().find("coil 10 unit 1, function 1: ") != std::string::npos; }));
  EXPECT_FALSE(rig.good(rig.clamp));
  rig.image.value[rig.clamp] = 1;
  EXPECT_TRUE(rig.until([&] { return server.coil(1, 10) == 1 && rig.good(rig.clamp); }));
  EXPECT_EQ(openings, 0u);
}

TEST(ModbusLink, StopEndsWithAPartnerThatIsSilent) {
  LoopbackServer server;
  LossRig::fill(&server);
  LossRig rig;
  rig.short_timeouts();
  rig.start(server.port());
  ASSERT_TRUE(rig.until([&] { return rig.there(); }));
  server.set_fault([](const Bytes&, Answer right) {
    right.drip_ms = 250;  // so slow that it takes nearly for ever
    return right;
  });
  const auto requests = server.functions().size();
  ASSERT_TRUE(rig.until([&] { return server.functions().size() > requests; }));
  rig.link->stop();
  EXPECT_EQ(rig.link->statistics().state, LinkState::kLost);
  EXPECT_NE(rig.log().find("safe values not written"), std::string::npos) << rig.log();
}

TEST(ModbusLink, WritesOnChangeAndToRefresh) {
  LoopbackServer server;
  server.with([](auto& units) { units[1].holding = {{0, 5}, {1, 5}}; });
  for (const bool refresh : {false, true}) {
    LinkRig rig;
    rig.config.refresh_ms = refresh ? 20 : 3600000;
    rig.add(Table::kHolding, 0, Format::kU16, true);
    const unsigned in = rig.add(Table::kHolding, 1, Format::kU16);
    rig.start(server.port());
    ASSERT_TRUE(rig.until([&] { return rig.good(in); }));
    const auto writes = [&] {
      const auto functions = server.functions();
      return std::count(functions.begin(), functions.end(), 6);
    };
    const auto before = writes();
    const auto requests = rig.link->statistics().requests;
    ASSERT_TRUE(rig.until([&] { return rig.link->statistics().requests > requests + 100; }));
    if (refresh)
      EXPECT_GT(writes(), before);
    else
      EXPECT_EQ(writes(), before);
  }
}

TEST(ModbusLink, AHostThatDoesNotExistIsAnErrorAndNoCrash) {
  LossRig rig;
  rig.config.host = "no..host";  // no valid name, so that the resolver asks no server
  rig.start(1);
  EXPECT_TRUE(rig.until([&] { return rig.link->statistics().errors > 0; }));
  EXPECT_NE(rig.link->statistics().last_error.find("no..host"), std::string::npos);
}

TEST(ModbusLink, ANotANumberIsNotGood) {
  LoopbackServer server;
  server.with([](auto& units) { units[1].input = {{0, 0x7FC0}, {1, 0}, {2, 0x41A0}, {3, 0}}; });
  LinkRig rig;
  const unsigned nan = rig.add(Table::kInput, 0, Format::kF32),
                 number = rig.add(Table::kInput, 2, Format::kF32);
  rig.start(server.port());
  EXPECT_TRUE(rig.until([&] { return rig.good(number) && rig.value(number) == 20; }));
  EXPECT_FALSE(rig.good(nan));
  EXPECT_EQ(rig.value(nan), 0u);
}

}  // namespace
