// SPDX-License-Identifier: Apache-2.0
// Retained data in a running control: common variables come back, and what is lost or cannot be written is an alarm.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <thread>
#include <tuple>

#include "hal/sim/sim_machine.hpp"
#include "runtime/retain/tables.hpp"
#include "runtime/retain/variables.hpp"
#include "runtime/runtime.hpp"
#include "stepping.hpp"
#include "test_config.hpp"

namespace {

using namespace nc::rt;
using namespace std::chrono_literals;

class RetainedControl : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("nc-kept-" + std::to_string(getpid()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directory(folder_);
    put("own.il", "LD nc.m_strobe\nOUT plc.fin2\nLD SM400\nOUT L5\nEND\n");
  }
  void TearDown() override {
    runtime.reset();
    std::filesystem::remove_all(folder_);
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  void put(const std::string& name, const std::string& bytes) {
    std::ofstream(file(name), std::ios::binary | std::ios::trunc) << bytes;
  }
  void configure(const std::string& more = "") {
    std::string text = nc::test::base_toml();
    text.replace(text.find("name = \"test\""), 13,
                 "name = \"test\"\nvariables = \"" + file("vars") + "\"\noffsets = \"" + file("offsets") + "\"\nretain_every_s = 0.02");
    config = nc::test::parse_or_fail(text + "[ladder]\nprogram = \"" + file("own.il") + "\"\nretain = \"" + file("devices") +
                                     "\"\n[scheduling]\npolicy = \"other\"\nlock_memory = false\noverrun = \"count\"\n" + more);
  }
  void build() {
    runtime.reset();
    machine = std::make_unique<nc::hal::SimMachine>(config.sim, config.points);
    std::vector<ConfigError> errors;
    runtime = Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr) << (errors.empty() ? "" : errors[0].text());
  }
  void up() {
    build();
    std::string error;
    ASSERT_TRUE(runtime->start(&error)) << error;
  }
  template <class Done>
  bool until(Done done) {
    for (int n = 0; n < 15000; ++n) {
      if (done()) return true;  // not asked again: a file that is being replaced is away for a moment
      std::this_thread::sleep_for(2ms);
    }
    return false;
  }
  // Enters a program in the feeder thread, to which the control belongs while it runs.
  unsigned add(const std::string& text) {
    unsigned number = 0;
    nc_status status = NC_E_STATE;
    const std::string& source = texts.emplace_back(text);
    EXPECT_EQ(runtime->look([&](nc_control* control) { status = nc_program_add_text(control, "p", source.data(), source.size(), &number); }), Answer::kDone);
    EXPECT_EQ(status, NC_OK);
    return number;
  }
  std::string variables_now() {
    std::string bytes;
    EXPECT_EQ(runtime->look([&](nc_control* control) { bytes = encode_variables(control); }), Answer::kDone);
    return bytes;
  }
  void run(const std::string& text) {
    const std::uint64_t runs = runtime->info().system[0].runs;
    ASSERT_EQ(runtime->select_program(add(text)), Answer::kDone);
    ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
    ASSERT_TRUE(until([&] { return runtime->info().system[0].runs > runs; }));
  }
  double variable(std::uint32_t number) const { return nc::test::variable_of(*runtime, number, std::nan("")); }
  double work(unsigned index, unsigned axis) const {
    double value = 0;
    EXPECT_EQ(nc_work_offset_get(runtime->control(), 0, index, axis, &value), NC_OK);
    return value;
  }
  double tool(unsigned number) const {
    double value = 0;
    EXPECT_EQ(nc_tool_offset_get(runtime->control(), number, NC_TOOL_LENGTH, &value), NC_OK);
    return value;
  }
  double parameter(const char* key, char axis = 0) const {
    double value = 0;
    EXPECT_EQ(nc_parameter_get(runtime->control(), 0, key, axis, &value), NC_OK);
    return value;
  }
  bool saved(const char* name, std::string* bytes) const {
    RetainStore store(file(name));
    std::string error;
    return store.load(bytes, &error) == RetainStore::Loaded::kWhole;
  }
  std::string alarms() const {
    std::string all;
    const Snapshot now = runtime->snapshot();
    for (unsigned i = 0; i < now.alarms.count; ++i) all += runtime->alarm_text(now.alarms.alarm[i]) + "\n";
    return all;
  }
  std::filesystem::path folder_;
  Config config;
  RealClock clock;
  std::unique_ptr<nc::hal::SimMachine> machine;
  std::unique_ptr<Runtime> runtime;
  std::deque<std::string> texts;
};

TEST_F(RetainedControl, VariablesAndTheirNamesComeBack) {
  configure();
  up();
  EXPECT_EQ(alarms(), "");
  run("#500=1.25 #501=-3 #999=70000.5 #150=9\nSETVN500[PART,TOOL]\n#1=5\nM30\n");
  runtime->stop();
  up();
  EXPECT_EQ(alarms(), "");
  EXPECT_EQ(variable(500), 1.25);
  EXPECT_EQ(variable(501), -3);
  EXPECT_EQ(variable(999), 70000.5);
  EXPECT_EQ(variable(150), 9);
  EXPECT_TRUE(std::isnan(variable(502)));
  char name[8] = "";
  ASSERT_EQ(nc_variable_name_get(runtime->control(), 501, name), NC_OK);
  EXPECT_STREQ(name, "TOOL");
  run("#501=#0\n#[#500*400]=[#PART]+1\nM30\n");  // #[1.25*400] is #500 again
  runtime->stop();
  up();
  EXPECT_EQ(variable(500), 2.25);
  EXPECT_TRUE(std::isnan(variable(501))) << "vacant again is vacant";
}

// A variable is in the file one period of the keeper after it was set, while the control still runs.
TEST_F(RetainedControl, AreWrittenWhileItRuns) {
  configure();
  up();
  run("#500=41\nM30\n");
  ASSERT_TRUE(until([&] {
    RetainStore store(file("vars"));
    std::string bytes, error;
    if (store.load(&bytes, &error) != RetainStore::Loaded::kWhole) return false;
    Config other = config;
    other.variables.clear();
    const std::size_t size = nc_memory_required(&other.nc);
    std::vector<char> memory(size + 64);
    void* place = memory.data() + (64 - reinterpret_cast<std::uintptr_t>(memory.data()) % 64) % 64;
    nc_status status = NC_OK;
    nc_control* control = nc_create(&other.nc, place, size, &status);
    double value = 0;
    bool vacant = true;
    return restore_variables(control, bytes) && nc_variable_get(control, 0, 500, &value, &vacant) == NC_OK && value == 41;
  }));
}

// M700 13.4, #1129 PwrVC1.
TEST_F(RetainedControl, AParameterClearsTheFirstOnesAtPowerOff) {
  configure("[parameters]\n\"1129\" = 1\n");
  up();
  run("#500=1 #150=9\nM30\n");
  runtime->stop();
  up();
  EXPECT_EQ(variable(500), 1);
  EXPECT_TRUE(std::isnan(variable(150)));
}

TEST_F(RetainedControl, WhatIsLostIsAnAlarmUntilReset) {
  configure();
  put("vars", "garbage");
  put("devices", "garbage");
  put("offsets", "garbage");
  up();
  ASSERT_TRUE(until([&] { return runtime->snapshot().alarms.count == 3; })) << alarms();
  const std::string text = alarms();
  EXPECT_NE(text.find("R19 Retained data lost: devices of the ladder are lost and begin with 0: " + file("devices") +
                      " is damaged\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("R19 Retained data lost: common variables are lost and are vacant: " + file("vars") + " is damaged\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("R19 Retained data lost: offsets and parameters are lost and are those of the configuration: " + file("offsets")), std::string::npos)
      << text;
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kWarningActive) << "nobody starts without having seen it";
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(until([&] { return !runtime->snapshot().resetting && alarms().empty(); }));
  run("#500=1\nM30\n");
  runtime->stop();
  up();
  EXPECT_EQ(alarms(), "");
  EXPECT_TRUE(std::filesystem::exists(file("vars.damaged")));
}

// If the control is ended, or killed, before anybody has acknowledged the loss, it reports it again; the damaged file is not overwritten.
TEST_F(RetainedControl, ALossIsToldAtEveryStartUntilSomebodyHasSeenIt) {
  configure();
  put("vars", "garbage");
  for (unsigned start = 0; start < 3; ++start) {
    up();
    ASSERT_TRUE(until([&] { return runtime->snapshot().alarms.count == 1; })) << start << ": " << alarms();
    EXPECT_EQ(alarms().find("R19 Retained data lost: common variables are lost and are vacant: "), 0u) << alarms();
    std::this_thread::sleep_for(60ms);  // several periods of the keeper
    if (start == 1) {  // as a service ends
      ASSERT_EQ(runtime->execute(CommandKind::kEnd), Answer::kDone);
      ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
      ASSERT_TRUE(until([&] { return !runtime->snapshot().resetting; }));
    }
    runtime->stop();
    EXPECT_TRUE(std::filesystem::exists(file("vars")));
    EXPECT_FALSE(std::filesystem::exists(file("vars.damaged")));
  }
  up();
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(until([&] { return !runtime->snapshot().resetting && alarms().empty(); }));
  run("#500=7\nM30\n");
  runtime->stop();
  EXPECT_TRUE(std::filesystem::exists(file("vars.damaged")));
  up();
  EXPECT_EQ(alarms(), "");
  EXPECT_EQ(variable(500), 7);
}

TEST_F(RetainedControl, AFileThatWasTakenAwayIsSaid) {
  configure("[tool_offsets]\n1 = 120.0\n");
  up();
  run("G10 L10 P1 R121.\nM30\n");
  runtime->stop();
  std::filesystem::remove(file("offsets"));
  up();
  ASSERT_TRUE(until([&] { return runtime->snapshot().alarms.count == 1; })) << "an older tool table in silence";
  EXPECT_EQ(alarms(), "R19 Retained data lost: offsets and parameters are those of the last time but one: " + file("offsets") + " is missing\n");
}

TEST_F(RetainedControl, BytesOfAnotherKindAreKeptForALook) {
  configure();
  up();
  run("#500=7\nM30\n");
  runtime->stop();
  std::filesystem::copy_file(file("vars"), file("offsets"), std::filesystem::copy_options::overwrite_existing);
  std::filesystem::remove(file("offsets.old"));
  up();
  ASSERT_TRUE(until([&] { return runtime->snapshot().alarms.count == 1; })) << alarms();
  EXPECT_NE(alarms().find(file("offsets") + " makes no sense"), std::string::npos) << alarms();
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(until([&] { return std::filesystem::exists(file("offsets.damaged")); }));
}

// A file that a later version has written is named as one, and it is there still behind the reset that acknowledges its loss. Names and pockets of tools have a file of their own, so
// that a program without them leaves it as it is.
TEST_F(RetainedControl, AFileOfAnotherVersionIsNamedAndKeptForALook) {
  configure();
  for (const char* name : {"offsets", "offsets.tools"}) {
    RetainStore later(file(name));
    std::string error;
    ASSERT_TRUE(later.save(std::string("nc ") + (name[7] == 0 ? "tables" : "tools") + " 2\nwhat is not known yet\n", &error)) << error;
  }
  up();
  ASSERT_TRUE(until([&] { return runtime->snapshot().alarms.count == 2; })) << alarms();
  EXPECT_NE(alarms().find("offsets and parameters are lost and are those of the configuration: " + file("offsets") + " is of another version of the control\n"), std::string::npos) << alarms();
  EXPECT_NE(alarms().find("names and pockets of tools are lost and are those of the configuration: " + file("offsets.tools") + " is of another version of the control\n"), std::string::npos) << alarms();
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  for (const char* name : {"offsets.damaged", "offsets.tools.damaged"}) {
    std::string bytes;
    ASSERT_TRUE(until([&] { return std::filesystem::exists(file(name)); })) << name;
    EXPECT_TRUE(saved(name, &bytes));
    EXPECT_NE(bytes.find("what is not known yet"), std::string::npos) << name;
  }
}

TEST_F(RetainedControl, OneGenerationBackIsSaid) {
  configure();
  up();
  run("#500=1\nM30\n");
  runtime->stop();
  put("vars", "torn");
  up();
  ASSERT_TRUE(until([&] { return runtime->snapshot().alarms.count == 1; }));
  EXPECT_NE(alarms().find("R19 Retained data lost: common variables are those of the last time but one"), std::string::npos)
      << alarms();
}

// The same as a full disk for the file: the new file beside it cannot be created.
TEST_F(RetainedControl, WhatCannotBeWrittenIsAnAlarmThatLetsTheProgramEnd) {
  configure();
  up();
  ASSERT_EQ(runtime->select_program(add("#500=1\nG4 X0.3\n#500=2\nG4 X0.3\nM30\n")), Answer::kDone);
  std::filesystem::create_directory(file("vars.new"));
  ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  ASSERT_TRUE(until([&] { return runtime->snapshot().alarms.count == 1; }));
  EXPECT_EQ(alarms().find("R20 Retained data are not kept: common variables cannot be written: " + file("vars")), 0u) << alarms();
  EXPECT_TRUE(runtime->snapshot().alarmed());
  EXPECT_FALSE(runtime->snapshot().stopped_by_alarm());
  ASSERT_TRUE(until([&] { return runtime->info().system[0].runs == 1; })) << "the part is finished";
  EXPECT_TRUE(runtime->info().system[0].ended_ok);
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kWarningActive) << "the next one is not begun";
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(until([&] { return !runtime->snapshot().resetting; }));
  EXPECT_EQ(alarms().find("R20 "), 0u) << "its cause is still there, and so is the warning: " << alarms();
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(until([&] { return !runtime->snapshot().resetting; }));
  EXPECT_EQ(alarms().find("R20 "), 0u) << "whoever resets how often: " << alarms();
  ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone) << "it has been acknowledged, and the machine can be used";
  ASSERT_TRUE(until([&] { return runtime->info().system[0].runs == 2; }));
  EXPECT_EQ(alarms().find("R20 "), 0u) << alarms();
  std::filesystem::remove(file("vars.new"));
  ASSERT_TRUE(until([&] { return alarms().empty(); })) << "it has gone with its cause: " << alarms();
  std::filesystem::create_directory(file("vars.new"));
  run("#500=1\nM30\n");
  ASSERT_TRUE(until([&] { return !alarms().empty(); })) << "it comes again";
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kWarningActive) << "and nobody has acknowledged that";
  std::filesystem::remove(file("vars.new"));
  std::string kept;
  ASSERT_TRUE(until([&] { return saved("vars", &kept) && kept == variables_now(); }));
  EXPECT_EQ(alarms().find("R20 "), 0u) << "what has gone by itself has been, and is there until somebody has seen it: " << alarms();
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(until([&] { return !runtime->snapshot().resetting && alarms().empty(); })) << alarms();
  runtime->stop();
  up();
  EXPECT_EQ(variable(500), 1) << "written as soon as it went";
}

// After a restart the offsets that programs have set are there again, and the parameters.
TEST_F(RetainedControl, OffsetsAndParametersComeBack) {
  configure("[work_offsets]\nG54 = { X = -10.0, Y = -20.0 }\n[tool_offsets]\n1 = 120.0\n2 = 90.0\n[parameters]\n\"8075\" = 0.25\n");
  up();
  run("G10 L2 P1 X-11.5 Y0\nG10 L20 P3 Z4.\nG10 L2 P0 X0.125\n#5222=-20.25\nG10 L10 P1 R121.0625\nG10 L10 P7 R0.1\nG10 L10 P2 R0\n"
      "G10 L70\nP8075 D0.5\nP2037 A2 D-3.\nP1267 H01\nG11\nM30\n");
  runtime->stop();
  up();
  EXPECT_EQ(alarms(), "");
  EXPECT_EQ(work(1, 0), -11.5);
  EXPECT_EQ(work(1, 1), -20.25);
  EXPECT_EQ(work(103, 2), 4);
  EXPECT_EQ(work(0, 0), 0.125);
  EXPECT_EQ(tool(1), 121.0625);
  EXPECT_EQ(tool(7), 0.1);
  EXPECT_EQ(tool(2), 0) << "taken away is taken away";
  EXPECT_EQ(parameter("8075"), 0.5);
  EXPECT_EQ(parameter("2037", 'Y'), -3);
  EXPECT_EQ(parameter("1267/bit0"), 1);
  run("#500=[#5221+#10001]\nM30\n");  // and programs see them
  EXPECT_EQ(variable(500), -11.5 + 121.0625);
}

// An offset that was changed in the configuration has its new value; the others keep what the programs have set.
TEST_F(RetainedControl, WhatIsChangedInTheConfigurationCountsFromThere) {
  configure("[work_offsets]\nG54 = { X = -10.0, Y = -20.0 }\n[tool_offsets]\n1 = 120.0\n2 = 90.0\n");
  up();
  run("G10 L2 P1 X-11. Y-21.\nG10 L10 P1 R121.\nG10 L10 P2 R91.\nM30\n");
  runtime->stop();
  configure("[work_offsets]\nG54 = { X = -10.5, Y = -20.0 }\n[tool_offsets]\n1 = 120.0\n2 = 93.0\n");
  up();
  EXPECT_EQ(work(1, 0), -10.5);
  EXPECT_EQ(work(1, 1), -21);
  EXPECT_EQ(tool(1), 121);
  EXPECT_EQ(tool(2), 93);
  runtime->stop();
  up();  // and it stays so at the next start
  EXPECT_EQ(work(1, 0), -10.5);
  EXPECT_EQ(work(1, 1), -21);
}

// A power cut in the middle of a program: blocks that were only read ahead have had no effect.
TEST_F(RetainedControl, WhatIsKeptInTheMiddleIsWhatWasExecuted) {
  configure("[tool_offsets]\n1 = 120.0\n");
  up();
  ASSERT_EQ(runtime->select_program(add("#500=1\nG10 L10 P1 R121.\nG4 X600.\n#500=2\nG10 L10 P1 R122.\nG10 L70\nP8075 D0.5\nG11\nM30\n")), Answer::kDone);
  ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  ASSERT_TRUE(until([&] { return runtime->snapshot().system[0].nc.cause == NC_CAUSE_DWELL; }));
  std::string variables, tables;
  ASSERT_TRUE(until([&] { return saved("vars", &variables) && saved("offsets", &tables) && tables.find("121") != std::string::npos; }));
  std::this_thread::sleep_for(100ms);  // several periods of the keeper
  ASSERT_TRUE(until([&] { return saved("vars", &variables) && saved("offsets", &tables); }));
  EXPECT_EQ(tables, "nc tables 1\ntool 1 0\n120\n121\nend\n");
  for (const char* name : {"vars", "offsets"})  // the next control finds what a power cut would leave now
    std::filesystem::copy_file(file(name), file(std::string("cut.") + name));
  runtime->stop();
  up();
  EXPECT_EQ(variable(500), 1) << "nor when the control is ended in the middle";
  EXPECT_EQ(tool(1), 121);
  runtime->stop();
  for (const char* name : {"vars", "offsets"})
    std::filesystem::copy_file(file(std::string("cut.") + name), file(name), std::filesystem::copy_options::overwrite_existing);
  up();
  EXPECT_EQ(variable(500), 1);
  EXPECT_EQ(tool(1), 121);
}

// M700 13.4: each part system has its own #100 to #199, unless parameter #1303 says otherwise.
TEST(RetainedVariables, EachPartSystemHasItsOwn) {
  nc_config config;
  nc_config_init(&config);
  config.system_count = 2;
  config.system[1] = config.system[0];
  const std::size_t size = nc_memory_required(&config);
  ASSERT_GT(size, 0u);
  const std::size_t room = (size + 63) / 64 * 64;
  const std::unique_ptr<void, decltype(&std::free)> before(std::aligned_alloc(64, room), &std::free), after(std::aligned_alloc(64, room), &std::free);
  nc_status status = NC_OK;
  nc_control *one = nc_create(&config, before.get(), size, &status), *two = nc_create(&config, after.get(), size, &status);
  ASSERT_TRUE(one != nullptr && two != nullptr);
  ASSERT_EQ(nc_variable_set(one, 0, 150, 1, false), NC_OK);
  ASSERT_EQ(nc_variable_set(one, 1, 150, 2, false), NC_OK);
  ASSERT_EQ(nc_variable_set(one, 1, 160, 3, false), NC_OK);
  ASSERT_EQ(nc_variable_set(one, 1, 500, 4, false), NC_OK);
  ASSERT_TRUE(restore_variables(two, encode_variables(one)));
  EXPECT_EQ(encode_variables(two), encode_variables(one));
  double value = 0;
  bool vacant = true;
  for (const auto& [system, number, wanted] : {std::tuple(0u, 150u, 1.0), {1u, 150u, 2.0}, {1u, 160u, 3.0}, {0u, 500u, 4.0}, {1u, 500u, 4.0}}) {
    ASSERT_EQ(nc_variable_get(two, system, number, &value, &vacant), NC_OK);
    EXPECT_FALSE(vacant) << number;
    EXPECT_EQ(value, wanted) << number;
  }
  ASSERT_EQ(nc_variable_get(two, 0, 160, &value, &vacant), NC_OK);
  EXPECT_TRUE(vacant);
}

// A machine with #400 to #499, of which #450 and up begin vacant.
TEST(RetainedVariables, FurtherRangesAreKeptUnlessTheConfigurationSaysNot) {
  std::string text = nc::test::base_toml();
  const std::string name = "name = \"test\"";
  text.replace(text.find(name), name.size(),
               name + "\nvariable_ranges = [{first = 400, last = 449}, {first = 450, last = 499, kept = false}]\nmacro_extensions = true\nextended_variables = true");
  const Config config = nc::test::parse_or_fail(text);
  ASSERT_EQ(config.not_kept.size(), 1u);
  EXPECT_EQ(config.not_kept[0].first, 450u);
  const std::size_t size = nc_memory_required(&config.nc);
  ASSERT_GT(size, 0u);
  const std::size_t room = (size + 63) / 64 * 64;
  const std::unique_ptr<void, decltype(&std::free)> before(std::aligned_alloc(64, room), &std::free), after(std::aligned_alloc(64, room), &std::free);
  nc_status status = NC_OK;
  nc_control *one = nc_create(&config.nc, before.get(), size, &status), *two = nc_create(&config.nc, after.get(), size, &status);
  ASSERT_TRUE(one != nullptr && two != nullptr);
  for (const ConfigError& error : apply_config(config, one)) ADD_FAILURE() << error.text();
  double on = 0;
  ASSERT_EQ(nc_parameter_get(one, 0, "macro_extensions", 0, &on), NC_OK);
  EXPECT_EQ(on, 1);
  for (const unsigned number : {400u, 449u, 450u, 499u, 900000u}) ASSERT_EQ(nc_variable_set(one, 0, number, number, false), NC_OK) << number;
  ASSERT_TRUE(restore_variables(two, encode_variables(one), config.not_kept));
  double value = 0;
  bool vacant = false;
  for (const unsigned number : {400u, 449u, 450u, 499u, 900000u}) {
    ASSERT_EQ(nc_variable_get(two, 0, number, &value, &vacant), NC_OK) << number;
    EXPECT_EQ(vacant, number == 450 || number == 499) << number;
    EXPECT_TRUE(vacant || value == number) << number;
  }
}

TEST(RetainedTables, BytesThatMakeNoSenseChangeNothing) {
  Config config = nc::test::parse_or_fail(nc::test::base_toml());
  const std::size_t size = nc_memory_required(&config.nc);
  std::vector<char> memory(size + 64);
  void* place = memory.data() + (64 - reinterpret_cast<std::uintptr_t>(memory.data()) % 64) % 64;
  nc_status status = NC_OK;
  nc_control* control = nc_create(&config.nc, place, size, &status);
  ASSERT_NE(control, nullptr);
  const TableRows configured = read_tables(control, config.nc);
  ASSERT_EQ(nc_tool_offset_set(control, 1, NC_TOOL_LENGTH, 1e-7), NC_OK);
  ASSERT_EQ(nc_work_offset_set(control, 0, 101, 2, -1.0 / 3), NC_OK);
  ASSERT_EQ(nc_parameter_set(control, 0, "1326", 0, "SERVER NAME"), NC_OK);
  const TableRows now = read_tables(control, config.nc);
  const std::string good = encode_changes(now, configured);
  TableRows parsed;
  ASSERT_TRUE(parse_tables(table_text(now), &parsed));
  EXPECT_EQ(parsed, now);
  for (std::size_t cut = 0; cut < good.size(); ++cut) EXPECT_FALSE(restore_changes(control, config.nc, configured, good.substr(0, cut))) << cut;
  EXPECT_FALSE(restore_changes(control, config.nc, configured, good + "x"));
  EXPECT_FALSE(restore_changes(control, config.nc, configured, good + "x\n"));
  EXPECT_EQ(read_tables(control, config.nc), now);
  std::mt19937 chance(1);
  for (unsigned i = 0; i < 5000; ++i) {
    std::string noise = good;
    for (unsigned k = 0; k < 3; ++k) noise[chance() % noise.size()] = static_cast<char>(chance());
    (void)restore_changes(control, config.nc, configured, noise);
  }
  ASSERT_EQ(nc_tool_offset_set(control, 1, NC_TOOL_LENGTH, 0), NC_OK);
  ASSERT_TRUE(restore_changes(control, config.nc, configured, good));
  double value = 0;
  ASSERT_EQ(nc_tool_offset_get(control, 1, NC_TOOL_LENGTH, &value), NC_OK);
  EXPECT_EQ(value, 1e-7) << "to the last bit";
}

TEST_F(RetainedControl, AFileOfAnotherControlIsAnAlarm) {
  configure();
  RetainStore other(file("vars"));
  std::string error;
  ASSERT_TRUE(other.lock(&error)) << error;
  up();
  ASSERT_TRUE(until([&] { return runtime->snapshot().alarms.count == 1; }));
  EXPECT_EQ(alarms().find("R20 Retained data are not kept: common variables are not kept: "), 0u) << alarms();
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(until([&] { return !runtime->snapshot().resetting; }));
  EXPECT_EQ(alarms().find("R20 Retained data are not kept: common variables are not kept: "), 0u) << "as long as this control runs: " << alarms();
}

TEST(RetainedVariables, BytesThatMakeNoSenseChangeNothing) {
  Config config = nc::test::parse_or_fail(nc::test::base_toml());
  const std::size_t size = nc_memory_required(&config.nc);
  std::vector<char> memory(size + 64);
  void* place = memory.data() + (64 - reinterpret_cast<std::uintptr_t>(memory.data()) % 64) % 64;
  nc_status status = NC_OK;
  nc_control* control = nc_create(&config.nc, place, size, &status);
  ASSERT_NE(control, nullptr);
  ASSERT_EQ(nc_variable_set(control, 0, 500, 3, false), NC_OK);
  ASSERT_EQ(nc_variable_name_set(control, 500, "ABC"), NC_OK);
  const std::string good = encode_variables(control);
  ASSERT_TRUE(restore_variables(control, good));
  EXPECT_EQ(encode_variables(control), good);
  for (std::size_t cut = 0; cut < good.size(); ++cut) EXPECT_FALSE(restore_variables(control, good.substr(0, cut))) << cut;
  EXPECT_FALSE(restore_variables(control, good + "x"));
  EXPECT_EQ(encode_variables(control), good);
  std::mt19937 chance(1);
  for (unsigned i = 0; i < 20000; ++i) {
    std::string noise = good;
    for (unsigned k = 0; k < 3; ++k) noise[chance() % noise.size()] = static_cast<char>(chance());
    (void)restore_variables(control, noise);
  }
}

}  // namespace
