// SPDX-License-Identifier: Apache-2.0
// What a reader of the segment sees of a runtime on virtual time; alarms and their history; block texts.
#include "runtime/share/publisher.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "hal/sim/sim_machine.hpp"
#include "runtime/share/segment.hpp"
#include "runtime/share/service.hpp"
#include "runtime/share/text.hpp"

namespace nc::rt::share {
namespace {

constexpr char kMachine[] = R"(
[machine]
name = "Unit"
[[axis]]
name = "X"
max_velocity = 200.0
max_acceleration = 2000.0
[[axis]]
name = "C"
rotary = true
max_velocity = 90.0
max_acceleration = 900.0
[[point]]
name = "clamp"
direction = "output"
[[point]]
name = "pallet"
type = "word"
initial = 7
direction = "input"
[macro_interface]
"#1100" = "clamp"
"#1032" = "pallet"
)";

class SharePublisher : public testing::Test {
 protected:
  void SetUp() override {
    const auto errors = parse_config(machine_text(), "unit.toml", &config_);
    ASSERT_TRUE(errors.empty()) << errors.front().text();
    sim_ = std::make_unique<hal::SimMachine>(config_.sim, config_.points);
    tap_ = std::make_unique<PointTap>(sim_.get(), config_.points.size());
    std::vector<ConfigError> refused;
    runtime_ = Runtime::create(config_, {&clock_, tap_.get(), nullptr, nullptr}, &refused);
    ASSERT_NE(runtime_, nullptr);
    std::string error;
    name_ = "unit-p" + std::to_string(getpid());
    ASSERT_TRUE(owner_.create(name_, false, false, machine_block(config_, name_), &error)) << error;
    publisher_ = std::make_unique<Publisher>(runtime_.get(), &programs_, tap_.get(), owner_.get(), true);
    ASSERT_TRUE(runtime_->start_stepping(&error)) << error;
    publisher_->publish();
    ASSERT_TRUE(reader_.open(name_, &error)) << error;
  }
  virtual std::string machine_text() { return kMachine; }
  void TearDown() override {
    for (const std::string& path : path_) std::filesystem::remove(path);
    if (runtime_ != nullptr) runtime_->stop();
  }
  void select(const std::string& text, unsigned system = 0) {
    path_[system] = (std::filesystem::temp_directory_path() / (name_ + (system == 0 ? ".nc" : "-2.nc"))).string();
    std::ofstream(path_[system]) << text;
    text_[system] = text;
    unsigned file = 0;
    ASSERT_EQ(nc_program_add_text(runtime_->control(), system == 0 ? "unit.nc" : "unit2.nc", text_[system].data(), text_[system].size(), &file), NC_OK);
    std::string error;
    shown_[system] = ProgramText::open_file(path_[system], {}, &error);
    ASSERT_NE(shown_[system], nullptr) << error;
    programs_.add(file, path_[system], shown_[system]);
    Command command;
    command.kind = CommandKind::kSelectProgram;
    command.system = static_cast<std::uint8_t>(system);
    command.number = file;
    ASSERT_EQ(runtime_->execute(command), Answer::kDone);
  }
  void steps(unsigned count) {
    for (unsigned i = 0; i < count; ++i) runtime_->step();
  }
  StatusBlock look() {
    publisher_->publish();
    StatusBlock block{};
    std::string error;
    EXPECT_TRUE(reader_.status(&block, &error)) << error;
    return block;
  }
  HistoryBlock history() {
    HistoryBlock block{};
    std::uint64_t sequence = 0;
    std::string error;
    EXPECT_TRUE(reader_.history(&block, &sequence, &error)) << error;
    return block;
  }

  Config config_;
  VirtualClock clock_;
  std::unique_ptr<hal::SimMachine> sim_;
  std::unique_ptr<PointTap> tap_;
  std::unique_ptr<Runtime> runtime_;
  std::shared_ptr<ProgramText> shown_[2];
  ProgramTable programs_{NC_DIALECT_M700};
  SegmentOwner owner_;
  SegmentReader reader_;
  std::unique_ptr<Publisher> publisher_;
  std::string name_, path_[2], text_[2];
};

TEST_F(SharePublisher, ShowsTheMachine) {
  const MachineBlock& machine = reader_.get()->machine;
  EXPECT_EQ(text_of(machine.machine), "Unit");
  EXPECT_EQ(text_of(machine.share), name_);
  EXPECT_EQ(machine.axis_count[0], 2u);
  EXPECT_EQ(text_of(machine.axis[0][1].name), "C");
  EXPECT_EQ(machine.axis[0][1].rotary, 1u);
  EXPECT_EQ(machine.point_count, 2u);
  EXPECT_EQ(text_of(machine.point[1].name), "pallet");
}

// M700 14.13: the displayed position of a rotary axis stays within one turn while the axis counts on.
TEST_F(SharePublisher, ShowsARotatingAxisWithinOneTurn) {
  select("G90 G0 C350.\nG91 C100.\nM30\n");
  ASSERT_EQ(runtime_->execute(CommandKind::kCycleStart), Answer::kDone);
  steps(20000);
  EXPECT_NEAR(look().system[0].axis[1].commanded, 450, 1e-6);  // #8213 = 3: all linear
  ASSERT_EQ(nc_parameter_set(runtime_->control(), 0, "8213", 'C', "1"), NC_OK);
  steps(10);
  const SystemStatus shown = look().system[0];
  EXPECT_NEAR(shown.axis[1].commanded, 90, 1e-6);
  EXPECT_NEAR(shown.axis[1].actual, 90, 1e-3);
  EXPECT_NEAR(shown.axis[1].work, 90, 1e-6);
}

TEST_F(SharePublisher, ShowsTheBlockInExecution) {
  select("G90\n#1100=1\nN7 G1 X50. F1200.\nM30\n");
  ASSERT_EQ(runtime_->execute(CommandKind::kCycleStart), Answer::kDone);
  steps(300);
  const StatusBlock block = look();
  const SystemStatus& system = block.system[0];
  EXPECT_EQ(system.run_state, static_cast<std::uint32_t>(NC_STATE_RUNNING));
  EXPECT_EQ(system.line, 3u);
  EXPECT_EQ(system.sequence_number, 7u);
  EXPECT_EQ(text_of(system.block), "N7 G1 X50. F1200.");
  EXPECT_EQ(text_of(system.program), name_ + ".nc");
  EXPECT_NE(text_of(system.modal).find("G90"), std::string::npos) << text_of(system.modal);
  EXPECT_NEAR(system.feed_mm_min, 1200, 1);
  EXPECT_GT(system.axis[0].commanded, 1.0);
  EXPECT_NEAR(system.axis[0].work + system.axis[0].distance_to_go, 50, 1e-6);
  EXPECT_EQ(system.program_lines, 4u);
  EXPECT_EQ(system.percent, 75u);
  EXPECT_EQ(block.interface_output[0] & 1, 1u);
  EXPECT_EQ(block.scan, runtime_->snapshot().scan);
  steps(5000);
  EXPECT_EQ(look().system[0].runs, 1u);
  EXPECT_EQ(look().system[0].percent, 100u);
  EXPECT_EQ(look().system[0].last_run_ok, 1u);
}

// The progress of a program is that of the present run, not of the run before or of another program.
TEST_F(SharePublisher, ShowsHowFarTheProgramIs) {
  const char* const kFourLines = "G91 G1 X10. F6000\nG1 X10.\nG1 X10.\nM30\n";
  select(kFourLines);
  EXPECT_EQ(look().system[0].percent, 0u);
  ASSERT_EQ(runtime_->execute(CommandKind::kCycleStart), Answer::kDone);
  steps(2000);
  ASSERT_EQ(look().system[0].runs, 1u);
  EXPECT_EQ(look().system[0].percent, 100u);
  ASSERT_EQ(runtime_->execute(CommandKind::kCycleStart), Answer::kDone);
  steps(20);
  EXPECT_EQ(look().system[0].percent, 25u) << "the first block again";
  EXPECT_EQ(look().system[0].main_line, 1u);
  ASSERT_EQ(runtime_->execute(CommandKind::kReset), Answer::kDone);
  steps(500);
  EXPECT_EQ(look().system[0].percent, 0u) << "given up: at its head";
  ASSERT_EQ(runtime_->execute(CommandKind::kCycleStart), Answer::kDone);
  steps(2000);
  EXPECT_EQ(look().system[0].percent, 100u);
  select(kFourLines);
  EXPECT_EQ(look().system[0].percent, 0u) << "selected, and nothing of it has run";
  EXPECT_EQ(look().system[0].runs, 2u);
}

TEST_F(SharePublisher, ShowsThePoints) {
  steps(3);
  publisher_->publish();
  steps(2);
  publisher_->publish();
  EXPECT_EQ(reader_.get()->points.sequence(), 0u) << "only while someone wants them";
  reader_.get()->points_until = RealClock().now_ns() + kPointsWantedNs;
  publisher_->publish();  // asks
  steps(2);               // the scan fills
  publisher_->publish();  // takes
  PointsBlock points{};
  std::string error;
  ASSERT_TRUE(reader_.points(&points, &error)) << error;
  EXPECT_EQ(points.count, 2u);
  EXPECT_EQ(points.value[1], 7u);
  EXPECT_EQ(points.good[1], 1);
  SignalsBlock signals{};
  ASSERT_TRUE(reader_.signals(&signals, &error)) << error;
  const MachineBlock& machine = reader_.get()->machine;
  ASSERT_EQ(signals.count, machine.signal_count);
  EXPECT_GT(signals.scan, 3u);
  bool seen = false;
  for (unsigned i = 0; i < signals.count; ++i) {
    if (text_of(machine.signal[i].name) != "plc.interlock_n") continue;
    seen = true;
    EXPECT_EQ(signals.value[i], 1);
    EXPECT_EQ(machine.signal[i].safe, 1);
    EXPECT_EQ(machine.signal[i].from_nc, 0u);
    EXPECT_NE(text_of(machine.signal[i].meaning).find("decelerate"), std::string::npos);
  }
  EXPECT_TRUE(seen);
  signals.count = machine.signal_count + 1;
  owner_.get()->signals.store(signals);
  EXPECT_FALSE(reader_.signals(&signals, &error)) << "more than there are";
}

TEST_F(SharePublisher, AlarmsComeAndGoWithNumberAndTimes) {
  select("G90\nG1 X50.\nM30\n");  // no F
  ASSERT_EQ(runtime_->execute(CommandKind::kCycleStart), Answer::kDone);
  steps(50);
  StatusBlock block = look();
  ASSERT_EQ(block.alarm_count, 1u);
  EXPECT_EQ(text_of(block.alarm[0].code), "P62");
  EXPECT_EQ(block.alarm[0].line, 2u);
  EXPECT_GT(block.alarm[0].raised_ns, 0);
  EXPECT_EQ(block.alarm[0].cleared_ns, 0);
  EXPECT_EQ(history().last_sequence, 1u);
  EXPECT_EQ(history().entry[0].cleared_ns, 0);
  ASSERT_EQ(runtime_->execute(CommandKind::kReset), Answer::kDone);
  steps(50);
  block = look();
  EXPECT_EQ(block.alarm_count, 0u);
  EXPECT_EQ(history().last_sequence, 1u);
  EXPECT_GE(history().entry[0].cleared_ns, history().entry[0].raised_ns);
  ASSERT_EQ(runtime_->execute(CommandKind::kCycleStart), Answer::kDone);
  steps(50);
  EXPECT_EQ(look().alarm[0].sequence, 2u) << "the same alarm again is another occurrence";
}

TEST_F(SharePublisher, MachineAndIntakeSpeakOfTheSameThings) {
  RuntimeMachine machine(runtime_.get(), &programs_);
  EXPECT_EQ(machine.state().axis_count[0], 2u);
  EXPECT_EQ(machine.state().program[0], "");
  select("G90\nM30\n");
  steps(2);
  EXPECT_EQ(machine.state().program[0], name_ + ".nc");
  Command mode;
  mode.kind = CommandKind::kSetMode;
  mode.number = static_cast<std::uint32_t>(Mode::kMdi);
  EXPECT_EQ(machine.execute(mode), Answer::kDone);
  EXPECT_EQ(machine.load_mdi(0, "N3 G90\n"), Answer::kDone);
  EXPECT_EQ(programs_.mdi(0), "N3 G90\n");
  steps(2);
  EXPECT_EQ(machine.state().program[0], "MDI");
  EXPECT_EQ(machine.select_program(0, "none.nc"), Answer::kNotInThisMode);
  mode.number = static_cast<std::uint32_t>(Mode::kAuto);
  machine.execute(mode);
  EXPECT_EQ(machine.select_program(0, "none.nc"), Answer::kNotLoaded);
  EXPECT_EQ(machine.explain(Answer::kNotLoaded), "there is no folder of programs");
}

TEST_F(SharePublisher, TheMachineSaysWhetherItsAxesMove) {
  RuntimeMachine machine(runtime_.get(), &programs_);
  EXPECT_FALSE(machine.state().moves[0]);
  select("G1 C90. F5400.\nM30\n");
  ASSERT_EQ(runtime_->execute(CommandKind::kCycleStart), Answer::kDone);
  steps(300);
  EXPECT_TRUE(machine.state().moves[0]);
  ASSERT_EQ(runtime_->execute(CommandKind::kFeedHold), Answer::kDone);
  steps(3);
  EXPECT_EQ(machine.state().run_state[0], NC_STATE_HOLD);
  EXPECT_TRUE(machine.state().moves[0]) << "a tenth of a second to rest";
  steps(200);
  EXPECT_FALSE(machine.state().moves[0]);
  EXPECT_FALSE(machine.state().moves[1]) << "there is no such part system";
}

class ShareTwoSystems : public SharePublisher {
 protected:
  std::string machine_text() override {
    std::string text = kMachine;
    text.insert(text.find("[[point]]"), "[[axis]]\nsystem = 2\nname = \"X\"\nmax_velocity = 200.0\nmax_acceleration = 2000.0\n");
    return text;
  }
};

TEST_F(ShareTwoSystems, EachShowsItsOwnProgram) {
  select("G1 X5. F6000.\nM30\n");
  steps(3);
  EXPECT_EQ(look().system[0].program_ready, 1u);
  EXPECT_EQ(look().system[1].program_ready, 0u);
  select("G1 X5. F6000.\nG1 X6.\nN7 G1 X50. F600.\nG1 X60.\nM30\n", 1);
  ASSERT_EQ(runtime_->execute(CommandKind::kCycleStart), Answer::kDone);
  steps(1000);
  const StatusBlock block = look();
  const SystemStatus &first = block.system[0], &second = block.system[1];
  EXPECT_EQ(first.runs, 1u);
  EXPECT_EQ(first.last_run_ok, 1u);
  EXPECT_EQ(first.percent, 100u);
  EXPECT_EQ(first.program_lines, 2u);
  EXPECT_EQ(first.main_line, 2u);
  EXPECT_EQ(second.runs, 0u);
  EXPECT_EQ(second.last_run_ok, 0u);
  EXPECT_EQ(second.percent, 60u);
  EXPECT_EQ(second.program_lines, 5u);
  EXPECT_EQ(second.main_line, 3u);
  EXPECT_EQ(second.sequence_number, 7u);
  EXPECT_EQ(text_of(second.block), "N7 G1 X50. F600.");
}

TEST_F(ShareTwoSystems, EachShowsItsOwnBlocksOfMdi) {
  RuntimeMachine machine(runtime_.get(), &programs_);
  Command mode;
  mode.kind = CommandKind::kSetMode;
  mode.number = static_cast<std::uint32_t>(Mode::kMdi);
  ASSERT_EQ(machine.execute(mode), Answer::kDone);
  ASSERT_EQ(machine.load_mdi(0, "N3 G1 X5. F600.\n"), Answer::kDone);
  ASSERT_EQ(machine.load_mdi(1, "N4 G1 X-5. F600.\n"), Answer::kDone);
  ASSERT_EQ(runtime_->execute(CommandKind::kCycleStart), Answer::kDone);
  steps(100);
  EXPECT_EQ(text_of(look().system[0].block), "N3 G1 X5. F600.");
  EXPECT_EQ(text_of(look().system[1].block), "N4 G1 X-5. F600.");
}

// Both part systems are in alarm, and each alarm tells what is wrong in its own one; so does the history, with the messages.
TEST_F(ShareTwoSystems, AlarmsAndMessagesAreOfTheirPartSystem) {
  select("#3006=1(FIRST)\nM30\n");
  select("#3006=2(SECOND)\nG1 X[1/0] F600.\nM30\n", 1);
  Command start;
  start.kind = CommandKind::kCycleStart;
  start.system = 1;
  ASSERT_EQ(runtime_->execute(start), Answer::kDone);
  steps(50);
  EXPECT_EQ(text_of(look().system[1].message), "SECOND");
  EXPECT_EQ(look().system[1].message_count, 1u);
  EXPECT_EQ(text_of(look().system[0].message), "") << "it has said nothing";
  EXPECT_EQ(history().entry[0].system, 1u);
  start.system = 0;
  ASSERT_EQ(runtime_->execute(start), Answer::kDone);
  steps(50);
  EXPECT_EQ(text_of(look().system[0].message), "FIRST");
  EXPECT_EQ(text_of(look().system[1].message), "SECOND") << "its own stays";
  EXPECT_EQ(look().system[0].message_count + look().system[1].message_count, 2u);
  EXPECT_EQ(history().entry[1].system, 0u);
  ASSERT_EQ(runtime_->execute(CommandKind::kReset), Answer::kDone);
  steps(100);
  select("G1 X1. F600.\nM98 P77\nM30\n");
  select("G1 X1. F600.\n\nG1 X[1/0]\nM30\n", 1);
  ASSERT_EQ(runtime_->execute(CommandKind::kCycleStart), Answer::kDone);
  steps(1000);
  const StatusBlock block = look();
  ASSERT_EQ(block.alarm_count, 2u);
  for (unsigned n = 0; n < 2; ++n) {
    const Entry& alarm = block.alarm[n];
    EXPECT_EQ(text_of(alarm.code), alarm.system == 0 ? "P232" : "P283") << text_of(alarm.text);
    EXPECT_EQ(alarm.line, alarm.system == 0 ? 2u : 3u);
  }
}

// The status is published every 10 ms; no message in between is lost.
TEST_F(ShareTwoSystems, MessagesBetweenTwoPicturesAreAllInTheHistory) {
  select("#3006=1(ONE)\n#3006=2(TWO)\nM30\n");
  select("#3006=1(OTHER)\nM30\n", 1);
  for (unsigned n = 0; n < 200 && runtime_->info().messages < 3; ++n) {
    if (n % 5 == 0) (void)runtime_->execute(CommandKind::kCycleStart);
    runtime_->step();
  }
  ASSERT_EQ(runtime_->info().messages, 3u);
  const StatusBlock block = look();
  EXPECT_EQ(text_of(block.system[0].message), "TWO");
  EXPECT_EQ(block.system[0].message_count, 2u);
  EXPECT_EQ(text_of(block.system[1].message), "OTHER");
  std::string said;
  for (unsigned n = 0; n < 3; ++n) said.append(text_of(history().entry[n].text)).append(" ");
  EXPECT_EQ(said, "ONE OTHER TWO ");
}

// A service for a runtime on virtual time; its intake thread takes the commands from the ring.
class ShareService : public SharePublisher {
 protected:
  // Starts the service and sends a feed hold, for which a client needs no control; returns whether an answer comes.
  bool answered(bool commands, Ack* ack) {
    const std::string name = name_ + "-s";
    Service service(runtime_.get(), &programs_, tap_.get(), {name, commands, false, true});
    std::string error;
    EXPECT_TRUE(service.create(&error) && service.start(&error)) << error;
    SegmentReader reader;
    EXPECT_TRUE(reader.open(name, &error)) << error;
    EXPECT_EQ(reader.claim_commands(&error), commands) << error;
    Request request{};
    set_text(&request.client, "unit");
    request.sequence = 1;
    request.kind = static_cast<std::uint32_t>(RequestKind::kFeedHold);
    request.lifespan_ms = 10'000;
    request.issued_ns = wall_ns();
    request.expected_mode = request.expected_run_state = kAny;
    EXPECT_TRUE(reader.get()->commands.push(request));
    wake(&reader.get()->wake_intake);
    bool got = false;
    for (unsigned i = 0; i < (commands ? 5000 : 100) && !got; ++i) {
      got = reader.get()->acks.pop(ack);
      usleep(1000);
    }
    service.stop();
    EXPECT_TRUE(reader.owner_gone());
    return got;
  }
};

TEST_F(ShareService, TakesNoCommandsUnlessItIsToldTo) {
  Ack ack{};
  EXPECT_FALSE(answered(false, &ack));
}

TEST_F(ShareService, AnswersACommand) {
  Ack ack{};
  ASSERT_TRUE(answered(true, &ack));
  EXPECT_EQ(ack.sequence, 1u);
  EXPECT_EQ(text_of(ack.client), "unit");
  EXPECT_NE(ack.reason, static_cast<std::uint32_t>(AckReason::kNoControl));
}

// ---- alarms without a runtime ----

struct Texts final : AlarmLog::Describer {
  bool known = true;
  bool describe(const ActiveAlarm& alarm, Entry* entry) override {
    set_text(&entry->code, "R" + std::to_string(static_cast<int>(alarm.id)));
    return known;
  }
};

AlarmList list(std::initializer_list<std::uint64_t> scans) {
  AlarmList alarms;
  for (const std::uint64_t scan : scans) {
    alarms.alarm[alarms.count].id = AlarmId::kDriveFault;
    alarms.alarm[alarms.count++].scan = scan;
  }
  return alarms;
}

TEST(ShareAlarmLog, KeepsTheLast256) {
  AlarmLog log;
  Texts texts;
  for (std::uint64_t i = 1; i <= 1000; ++i) {
    EXPECT_TRUE(log.update(list({i}), &texts, static_cast<std::int64_t>(i)));
    EXPECT_EQ(log.active().size(), 1u);
    EXPECT_EQ(log.active()[0].sequence, i);
  }
  EXPECT_TRUE(log.update(list({}), &texts, 2000));
  EXPECT_TRUE(log.active().empty());
  EXPECT_FALSE(log.update(list({}), &texts, 2001));
  const HistoryBlock& history = log.history();
  EXPECT_EQ(history.last_sequence, 1000u);
  for (std::uint64_t i = 1000 - kHistory + 1; i <= 1000; ++i) {
    const Entry& entry = history.entry[(i - 1) % kHistory];
    EXPECT_EQ(entry.sequence, i);
    EXPECT_EQ(entry.cleared_ns, i == 1000 ? 2000 : static_cast<std::int64_t>(i + 1));
  }
}

// Two links, or two files, are lost in one scan.
TEST(ShareAlarmLog, TwoOfAKindInOneScanAreTwo) {
  struct Plain final : AlarmLog::Describer {
    bool describe(const ActiveAlarm&, Entry*) override { return true; }
  } plain;
  AlarmLog log;
  AlarmList list;
  list.count = 2;
  for (unsigned i = 0; i < 2; ++i) {
    list.alarm[i].id = AlarmId::kLinkLost;
    list.alarm[i].scan = 7;
    list.alarm[i].detail = i;
  }
  EXPECT_TRUE(log.update(list, &plain, 1000));
  EXPECT_EQ(log.active().size(), 2u);
  list.count = 1;
  EXPECT_TRUE(log.update(list, &plain, 2000));
  EXPECT_EQ(log.active().size(), 1u);
}

TEST(ShareAlarmLog, WaitsForTheTextsButNotForEver) {
  AlarmLog log;
  Texts texts;
  texts.known = false;
  EXPECT_FALSE(log.update(list({5}), &texts, 1000));
  EXPECT_TRUE(log.active().empty());
  EXPECT_TRUE(log.update(list({5}), &texts, 1000 + AlarmLog::kWaitForTextNs));
  ASSERT_EQ(log.active().size(), 1u);
  EXPECT_EQ(log.active()[0].raised_ns, 1000);
  AlarmLog other;
  EXPECT_FALSE(other.update(list({5}), &texts, 1000));
  EXPECT_FALSE(other.update(list({}), &texts, 1001)) << "gone before anyone saw it";
}

// ---- block texts ----

std::shared_ptr<ProgramText> program_of(const std::string& bytes, const ProgramText::Options& options = {}) {
  const std::string path = (std::filesystem::temp_directory_path() / ("nc-text-" + std::to_string(getpid()))).string();
  std::ofstream(path, std::ios::binary) << bytes;
  std::string error;
  const auto program = ProgramText::open_file(path, options, &error);
  EXPECT_NE(program, nullptr) << error;
  std::filesystem::remove(path);
  return program;
}

TEST(ShareBlockText, FindsLinesForwardsAndBackwards) {
  const auto program = program_of("G90\r\n" + std::string(10000, 'X') + "\n\n/N12 G1\nlast");
  BlockText text;
  EXPECT_EQ(text.line(program, 1), "G90");
  EXPECT_EQ(text.line(program, 4), "/N12 G1");
  EXPECT_EQ(text.line(program, 2), std::string(127, 'X'));
  EXPECT_EQ(text.line(program, 3), "");
  EXPECT_EQ(text.line(program, 5), "last");
  EXPECT_EQ(text.line(program, 6), "");
  EXPECT_EQ(text.line(program, 7), "");
  EXPECT_EQ(text.line(program, 5), "last");
  EXPECT_EQ(text.line(nullptr, 1), "");
}

TEST(ShareBlockText, LongLinesTakeSeveralCalls) {
  const auto program = program_of(std::string(3 * BlockText::kBytesPerCall, 'X') + "\nG1\n");
  BlockText text;
  unsigned calls = 1;
  for (; text.line(program, 2).empty() && calls < 10; ++calls) {
  }
  EXPECT_EQ(text.line(program, 2), "G1");
  EXPECT_EQ(calls, 4u);
}

TEST(ShareBlockText, IsCutBetweenCharactersAndAlwaysUtf8) {
  for (std::size_t before = 122; before < 130; ++before) {
    ProgramText::Options options;
    options.encoding = Encoding::kLatin1;
    const auto program = program_of("(" + std::string(before, 'A') + "\xC4\xD6\xDC)\n", options);
    BlockText text;
    const std::string line = text.line(program, 1);
    EXPECT_LE(line.size(), 127u);
    EXPECT_EQ(valid_utf8(line), line);
  }
}

TEST(ShareBlockText, SequenceNumbers) {
  EXPECT_EQ(sequence_number("N10 G1"), 10u);
  EXPECT_EQ(sequence_number(" /n007G1"), 7u);
  EXPECT_EQ(sequence_number("G1 N5"), 0u);
  EXPECT_EQ(sequence_number(""), 0u);
  EXPECT_EQ(line_of_text("G0 X1\nG1\n", 2), "G1");
  EXPECT_EQ(line_of_text("G0 X1\n", 5), "");
}

// ---- configuration ----

TEST(ShareConfigSection, IsReadAndChecked) {
  const std::string machine = kMachine;
  Config config;
  ASSERT_TRUE(parse_config(machine, "a", &config).empty());
  EXPECT_FALSE(config.share.enabled);
  EXPECT_FALSE(config.share.commands) << "commands are off unless they are asked for";
  ASSERT_TRUE(parse_config(machine + "[share]\nenabled = true\nname = \"mill-3\"\ncommands = true\n", "a", &config).empty());
  EXPECT_TRUE(config.share.enabled && config.share.commands);
  EXPECT_EQ(config.share.name, "mill-3");
  const auto errors = parse_config(machine + "[share]\nname = \"../Mill\"\nother = 1\n", "a", &config);
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_NE(errors[0].text().find("share.name"), std::string::npos) << errors[0].text();
}

}  // namespace
}  // namespace nc::rt::share
