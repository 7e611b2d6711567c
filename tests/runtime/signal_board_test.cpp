// SPDX-License-Identifier: Apache-2.0
// Signals that are connected to the machine without a ladder, the values of the table for monitors, and what the runtime
// does when a link is lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <deque>
#include <memory>

#include "hal/composite.hpp"
#include "hal/sim/sim_machine.hpp"
#include "runtime/runtime.hpp"
#include "runtime/share/publisher.hpp"
#include "runtime/share/text.hpp"
#include "test_config.hpp"

namespace {

using namespace nc::rt;

// A link whose partner is present or not, as the test sets it.
struct FakeLink final : nc::hal::PointBus {
  bool start(const nc::hal::PointImage&, std::string*) override { return true; }
  void read(nc::hal::PointImage* image) noexcept override {
    image->value[ok_point] = ok;
    if (values == nullptr) return;
    for (const nc::hal::modbus::PointMap& map : *values) {
      image->good[map.point] = static_cast<std::uint8_t>(ok);
      image->value[map.point] = ok != 0 ? active : map.loss_value;
    }
  }
  void write(const nc::hal::PointImage&) noexcept override {}
  void stop() noexcept override {}
  unsigned ok_point = 0, ok = 0, active = 0;
  const std::vector<nc::hal::modbus::PointMap>* values = nullptr;
};

class Board : public testing::Test {
 protected:
  void build(const std::string& toml, const std::string& ladder = "") {
    std::string text = nc::test::base_toml() + toml;
    if (!ladder.empty()) {
      path_ = testing::TempDir() + "nc_board_" + std::to_string(getpid()) + ".il";
      FILE* file = std::fopen(path_.c_str(), "w");
      ASSERT_NE(file, nullptr);
      std::fwrite(ladder.data(), 1, ladder.size(), file);
      std::fclose(file);
      text += "[ladder]\nprogram = \"" + path_ + "\"\n";
    }
    config = nc::test::parse_or_fail(text);
    machine = std::make_unique<nc::hal::SimMachine>(config.sim, config.points);
    std::vector<nc::hal::PointBus*> buses;
    if (!config.modbus.empty()) {
      link.ok_point = config.modbus[0].link.ok_point;
      buses.push_back(&link);
    }
    hal = std::make_unique<nc::hal::Composite>(machine.get(), buses, config.points);
    std::vector<ConfigError> errors;
    runtime = Runtime::create(config, {&clock, hal.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr) << (errors.empty() ? "" : errors[0].text());
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
  }
  void TearDown() override {
    if (!path_.empty()) std::remove(path_.c_str());
  }
  void start(const std::string& source) {
    unsigned file = 0;
    const std::string& text = texts.emplace_back(source);
    ASSERT_EQ(nc_program_add_text(runtime->control(), "p", text.data(), text.size(), &file), NC_OK);
    ASSERT_EQ(runtime->select_program(file), Answer::kDone);
    ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  }
  void steps(int n) {
    while (n-- > 0) runtime->step();
  }
  unsigned point(const char* name) const { return static_cast<unsigned>(config.points.find(name)); }
  std::int32_t value(const std::string& name) {
    SignalBoard& board = *runtime->signals();
    std::vector<std::int32_t> values(board.signals().size());
    std::uint64_t scan = 0;
    board.want();
    EXPECT_FALSE(board.take(values.data(), &scan)) << "nothing before the next scan";
    steps(1);
    EXPECT_TRUE(board.take(values.data(), &scan));
    EXPECT_EQ(scan, runtime->snapshot().scan);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (board.signals()[i].name == name) return values[i];
    ADD_FAILURE() << name;
    return 0;
  }
  Config config;
  VirtualClock clock;
  std::unique_ptr<nc::hal::SimMachine> machine;
  FakeLink link;
  std::unique_ptr<nc::hal::Composite> hal;
  std::unique_ptr<Runtime> runtime;
  std::deque<std::string> texts;
  std::string path_;
};

TEST_F(Board, PointsAreSignalsWhereTheConfigurationSaysSo) {
  build("[signals]\n\"plc.feed_hold_n\" = \"in0\"\n"
      "\"nc.hold_lamp\" = \"lamp\"\n\"nc.line\" = \"word_lamp\"\n\"plc.feed_override\" = \"word_in\"\n[[point]]\nname = \"lamp\"\n"
      "direction = \"output\"\n[[point]]\nname = \"word_lamp\"\ntype = \"word\"\ndirection = \"output\"\n");
  machine->set_input(point("in0"), 1);
  machine->set_input(point("word_in"), 5000);
  start("G91 G1 X400. F1200\nM30\n");
  steps(500);
  EXPECT_NEAR(runtime->snapshot().system[0].nc.feed_mm_min, 600, 1) << "plc.feed_override";
  EXPECT_EQ(machine->outputs().value[point("word_lamp")], 1u) << "nc.line";
  EXPECT_EQ(machine->outputs().value[point("lamp")], 0u);
  machine->set_input(point("in0"), 0);  // a broken wire
  steps(500);
  EXPECT_EQ(runtime->snapshot().system[0].nc.state, NC_STATE_HOLD);
  EXPECT_EQ(machine->outputs().value[point("lamp")], 1u);
  EXPECT_EQ(value("plc.feed_hold_n"), 0);
  EXPECT_EQ(value("nc.hold_lamp"), 1);
}

TEST_F(Board, ShowsWhatTheLadderSaysAndSafeValuesWithoutOne) {
  build("");
  EXPECT_EQ(value("plc.interlock_n"), 1);
  EXPECT_EQ(value("plc.feed_override"), -1);
  EXPECT_EQ(value("nc.ready"), 1);
  runtime.reset();
  build("", "LD in0\nOUT plc.interlock_n\nLD SM400\nMOV K7000 plc.feed_override\nOUT plc.skip.3\nLD nc.m_strobe\nOUT plc.fin2\nEND\n");
  EXPECT_EQ(value("plc.interlock_n"), 0);
  EXPECT_EQ(value("plc.feed_override"), 7000);
  EXPECT_EQ(value("plc.skip.3"), 1);
  EXPECT_EQ(value("plc.skip.2"), 0);
}

TEST_F(Board, AWiredOutputIsNotTheLaddersToWrite) {
  const std::string wires = "[signals]\n\"nc.cycle_lamp\" = \"out1\"\n[[point]]\nname = \"out1\"\ndirection = \"output\"\n";
  build(wires, "LD out1\nOUT out0\nLD nc.m_strobe\nOUT plc.fin2\nEND\n");
  start("G91 G1 X400. F1200\nM30\n");
  steps(100);
  EXPECT_EQ(machine->outputs().value[point("out1")], 1u);
  EXPECT_EQ(runtime->ladder()->devices().bit[runtime->ladder()->engine().find("out1")->index], 1);
  std::vector<ConfigError> errors;
  FILE* file = std::fopen(path_.c_str(), "w");
  std::fputs("LD in0\nOUT out1\nEND\n", file);
  std::fclose(file);
  EXPECT_EQ(LadderTask::create(config, &errors), nullptr);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].text().find("read-only"), std::string::npos) << errors[0].text();
}

// A reset clears R17 when its cause is gone; otherwise R17 comes back.
TEST_F(Board, AStoppedLadderBeginsAgainByReset) {
  build("", "LD SM402\nMOV K7 D0\nLD nc.m_strobe\nOUT plc.fin2\nP1\nLD in0\nCJ P1\nLD SM400\nOUT out0\nEND\n");
  steps(10);
  EXPECT_EQ(machine->outputs().value[point("out0")], 1u);
  machine->set_input(point("in0"), 1);
  steps(10);
  const auto alarm = [&] {
    const Snapshot now = runtime->snapshot();
    return now.alarms.count == 0 ? std::string() : runtime->alarm_text(now.alarms.alarm[0]).substr(0, 3);
  };
  EXPECT_EQ(alarm(), "R17");
  EXPECT_EQ(value("plc.fin2"), 0);
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  steps(100);
  EXPECT_EQ(alarm(), "R17") << "the cause is there still";
  machine->set_input(point("in0"), 0);
  steps(100);
  EXPECT_EQ(alarm(), "R17") << "not by itself";
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  steps(100);
  EXPECT_EQ(alarm(), "");
  const LadderTask& ladder = *runtime->ladder();
  EXPECT_EQ(ladder.devices().word[ladder.engine().find("D0")->index], 7) << "it began with its first scan";
  start("M8\nG91 G1 X1. F1200\nM30\n");
  const std::uint64_t runs = runtime->info().system[0].runs;
  for (int i = 0; i < 5000 && runtime->info().system[0].runs == runs; ++i) runtime->step();
  EXPECT_GT(runtime->info().system[0].runs, runs) << "and does its work";
}

TEST_F(Board, ALinkWithAnAlarmStopsTheMachineWhenItIsLost) {
  build("[[modbus]]\nname = \"io\"\nhost = \"127.0.0.1\"\nport = 1\nalarm = true\n[[point]]\nname = \"p\"\ndirection = \"input\"\n"
      "modbus = { link = \"io\", table = \"coil\", address = 0 }\n");
  const auto alarm = [&] {
    const Snapshot now = runtime->snapshot();
    return now.alarms.count == 0 ? std::string() : runtime->alarm_text(now.alarms.alarm[0]);
  };
  link.ok = 0;
  steps(9000);
  EXPECT_EQ(alarm(), "") << "it may come up later than the control";
  link.ok = 1;
  steps(5000);
  EXPECT_EQ(alarm(), "");
  link.ok = 0;
  steps(5);
  EXPECT_EQ(alarm(), "R18 Link lost: io (127.0.0.1 port 1)");
  link.ok = 1;
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  steps(100);
  EXPECT_EQ(alarm(), "");
}

// A chip with the contacts of eight alarms, the limit switches and the dogs of all axes: each of its points shows what is configured for a loss, and that says
// nothing about the machine.
TEST_F(Board, ALostChipIsOneAlarmAndNotOneForEachLine) {
  std::string text = "[[modbus]]\nname = \"io\"\nhost = \"127.0.0.1\"\nport = 1\nalarm = true\n", wires = "[signals]\n";
  for (int n = 1; n <= 8; ++n) {
    const std::string number = std::to_string(n);
    text += "[[point]]\nname = \"fault_" + number + "\"\ndirection = \"input\"\nmodbus = { link = \"io\", table = \"coil\", address = " + number + ", on_loss = 1 }\n";
    wires += "\"plc.alarm." + number + "\" = \"fault_" + number + "\"\n";
  }
  build(text + wires);
  const auto alarms = [&] {
    const Snapshot now = runtime->snapshot();
    std::string all;
    for (unsigned i = 0; i < now.alarms.count; ++i) all += runtime->alarm_text(now.alarms.alarm[i]) + "\n";
    return all;
  };
  link.ok = 1;
  link.values = &config.modbus[0].link.points;
  steps(100);
  ASSERT_EQ(alarms(), "");
  link.ok = 0;
  steps(100);
  EXPECT_EQ(alarms(), "R18 Link lost: io (127.0.0.1 port 1)\n");
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  steps(100);
  EXPECT_EQ(alarms(), "R18 Link lost: io (127.0.0.1 port 1)\n") << "it is lost still";
  link.ok = 1;
  link.active = 1;
  steps(100);
  EXPECT_NE(alarms().find("R16 Alarm of the ladder 8\n"), std::string::npos) << "a contact of a chip that answers counts";
}

// Before the link counts as lost (it may come up later than the control) its values count as configured.
TEST_F(Board, AContactOfALinkThatHasNotComeYetIsAnAlarm) {
  build("[[modbus]]\nname = \"io\"\nhost = \"127.0.0.1\"\nport = 1\nalarm = true\n[[point]]\nname = \"p\"\ndirection = \"input\"\n"
      "modbus = { link = \"io\", table = \"coil\", address = 0, on_loss = 1 }\n[signals]\n\"plc.alarm.3\" = \"p\"\n");
  link.values = &config.modbus[0].link.points;
  steps(100);
  EXPECT_EQ(runtime->snapshot().alarms.count, 1u);
  EXPECT_EQ(runtime->alarm_text(runtime->snapshot().alarms.alarm[0]).substr(0, 3), "R16");
}

TEST_F(Board, ALinkThatNeverComesIsAnAlarmAfterAWhile) {
  build("[[modbus]]\nname = \"io\"\nhost = \"127.0.0.1\"\nport = 1\nalarm = true\n[[point]]\nname = \"p\"\ndirection = \"input\"\n"
      "modbus = { link = \"io\", table = \"coil\", address = 0 }\n");
  steps(10010);
  EXPECT_EQ(runtime->snapshot().alarms.count, 1u);
}

// The memory for monitors has room for the largest machine and for every text of the table.
TEST(SignalRows, FitIntoTheSegment) {
  nc_config nc;
  nc_config_init(&nc);
  nc.system_count = NC_MAX_SYSTEMS;
  for (nc_system_config& system : nc.system) {
    system.axis_count = NC_MAX_AXES;
    system.spindle_count = NC_MAX_SPINDLES;
    for (unsigned a = 0; a < NC_MAX_AXES; ++a) {
      system.axis[a].name = "XYZABCUVW"[a % 9];
      system.axis[a].spindle = static_cast<std::uint8_t>(a < NC_MAX_SPINDLES ? a + 1 : 0);
    }
  }
  EXPECT_LE(machine_signals(nc).size(), share::kMaxSignals);
  share::SignalText row{};
  for (const Signal& signal : machine_signals(nc)) {
    EXPECT_LT(signal.name.size(), row.name.size()) << signal.name;
    EXPECT_LT(std::string(signal.row->meaning).size(), row.meaning.size()) << signal.name;
    EXPECT_LT(std::string(signal.row->timing).size(), row.timing.size()) << signal.name;
  }
}

}  // namespace
