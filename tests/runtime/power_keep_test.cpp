// SPDX-License-Identifier: Apache-2.0
// What is written when the supply says that it fails, and what the next start says of it. What the axes do then: tests/axes/power_test.cpp.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <thread>

#include "hal/sim/sim_machine.hpp"
#include "runtime/retain/keeper.hpp"
#include "runtime/retain/place.hpp"
#include "runtime/runtime.hpp"
#include "stepping.hpp"
#include "test_config.hpp"

namespace {

using namespace nc::rt;
using namespace std::chrono_literals;

template <class Done>
bool wait_until(Done done) {
  for (int n = 0; n < 15000; ++n) {
    if (done()) return true;
    std::this_thread::sleep_for(2ms);
  }
  return false;
}

// The simulated machine with a supply that another thread switches; the scan's thread sees it with its next read.
class SuppliedMachine final : public nc::hal::Hal {
 public:
  explicit SuppliedMachine(const Config& config)
      : machine_(config.sim, config.points), point_(static_cast<unsigned>(config.points.find("power_good"))), lock_(static_cast<unsigned>(config.points.find("locked"))) {}
  void power(bool good) { good_.store(good, std::memory_order_relaxed); }
  void lock(bool on) { locked_.store(on, std::memory_order_relaxed); }
  double stands_at(unsigned axis) const { return stands_[axis].load(std::memory_order_relaxed); }

  bool start(const nc::hal::PointImage& initial, std::string* error) override { return machine_.start(initial, error); }
  void read(nc::hal::Feedback* feedback, nc::hal::PointImage* image) noexcept override {
    machine_.set_input(point_, good_.load(std::memory_order_relaxed) ? 1 : 0);
    machine_.set_input(lock_, locked_.load(std::memory_order_relaxed) ? 1 : 0);
    machine_.read(feedback, image);
    for (unsigned a = 0; a < stands_.size(); ++a) stands_[a].store(feedback->system[0].actual.v[a], std::memory_order_relaxed);
  }
  void write(const nc::hal::Command& command, const nc::hal::PointImage& image) noexcept override { machine_.write(command, image); }
  void stop() noexcept override { machine_.stop(); }

 private:
  nc::hal::SimMachine machine_;
  unsigned point_, lock_;
  std::atomic<bool> good_{true}, locked_{false};
  std::array<std::atomic<double>, 3> stands_{};
};

class PowerKeep : public testing::Test {
 protected:
  void SetUp() override {
    folder = std::filesystem::path(testing::TempDir()) / ("nc-power-" + std::to_string(getpid()));
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  void TearDown() override {
    runtime.reset();
    std::filesystem::remove_all(folder);
  }
  void start(const std::string& kept, const std::string& power) {
    runtime.reset();
    std::string text = nc::test::base_toml();
    text.replace(text.find("name = \"test\""), 13, "name = \"test\"\n" + kept);
    config = nc::test::parse_or_fail(text +
                                     "[[point]]\nname = \"power_good\"\ndirection = \"input\"\ninitial = 1\n[[point]]\nname = \"locked\"\ndirection = \"input\"\n"
                                     "[signals]\n\"plc.power_fail_n\" = \"power_good\"\n\"plc.machine_lock\" = \"locked\"\n"
                                     "[scheduling]\npolicy = \"other\"\nlock_memory = false\noverrun = \"count\"\n[power]\nstop_s = 20.0\nsettle_s = 0.01\n" + power);
    config.file = (folder / "test.toml").string();
    machine = std::make_unique<SuppliedMachine>(config);
    std::vector<ConfigError> errors;
    runtime = Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr) << (errors.empty() ? "" : errors[0].text());
    std::string error;
    ASSERT_TRUE(runtime->start(&error)) << error;
  }
  void power(bool good) { machine->power(good); }
  std::string alarms() const {
    std::string all;
    const Snapshot now = runtime->snapshot();
    for (unsigned i = 0; i < now.alarms.count; ++i) all += runtime->alarm_text(now.alarms.alarm[i]) + "\n";
    return all;
  }
  bool says(const char* text) const { return alarms().find(text) != std::string::npos; }
  void run_into_the_failure() {
    unsigned number = 0;
    const std::string& source = texts.emplace_back("#500=7\nG90 G1 X1. F600.\n#500=8\nG1 X20. F6.\n#500=9\nM30\n");
    ASSERT_EQ(runtime->look([&](nc_control* control) { (void)nc_program_add_text(control, "part.nc", source.data(), source.size(), &number); }), Answer::kDone);
    ASSERT_EQ(runtime->select_program(number), Answer::kDone);
    ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
    ASSERT_TRUE(wait_until([&] { return runtime->snapshot().system[0].nc.source.line == 4 && runtime->info().system[0].main_line == 3; }));
    power(false);
    ASSERT_TRUE(wait_until([&] { return says("came to rest"); })) << alarms();
  }
  std::vector<ProgramPlace> places() const {
    RetainStore store((folder / "place").string());
    std::string bytes, error;
    std::vector<ProgramPlace> found;
    EXPECT_EQ(store.load(&bytes, &error), RetainStore::Loaded::kWhole) << error;
    EXPECT_TRUE(decode_places(bytes, &found));
    return found;
  }
  // The files as they are now, for a control that starts when the power is back: what is written later is lost.
  void power_goes() {
    std::filesystem::remove_all(folder / "cut");
    std::filesystem::create_directory(folder / "cut");
    for (const char* name : {"vars", "place"}) std::filesystem::copy_file(folder / name, folder / "cut" / name);
    runtime.reset();
    for (const char* name : {"vars", "place"}) std::filesystem::rename(folder / "cut" / name, folder / name);
    for (const char* name : {"vars.old", "place.old"}) std::filesystem::remove(folder / name);
  }
  const std::string kKept = "variables = \"vars\"\nretain_every_s = 3600\n", kPlace = "place = \"place\"\n";
  std::filesystem::path folder;
  Config config;
  RealClock clock;
  std::unique_ptr<SuppliedMachine> machine;
  std::unique_ptr<Runtime> runtime;
  std::deque<std::string> texts;
};

TEST_F(PowerKeep, WhatWasExecutedAndThePlaceAreOnTheDiskBeforeTheAlarmSaysSo) {
  start(kKept, kPlace);
  EXPECT_TRUE(places().empty());
  run_into_the_failure();
  EXPECT_TRUE(says("retained data were written within")) << alarms();
  EXPECT_TRUE(says("(line 4)")) << alarms();
  const std::vector<ProgramPlace> found = places();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].program, "part.nc");
  EXPECT_EQ(found[0].line, 4u);
  EXPECT_EQ(found[0].main_line, 3u);
  ASSERT_FALSE(found[0].at.empty());
  EXPECT_NEAR(found[0].at[0].second, runtime->snapshot().system[0].nc.command.v[0], 0.01) << "where it stands; with its drive off the command follows the encoder, which settles";
  power_goes();

  start(kKept, kPlace);
  EXPECT_EQ(nc::test::variable_of(*runtime, 500, std::nan("")), 8) << "of the blocks that were executed";
  ASSERT_TRUE(wait_until([&] { return says("R25 The power failed in a program: part.nc, line 4, X"); })) << alarms();
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kWarningActive) << "somebody has to look first";
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(wait_until([&] { return alarms().empty(); })) << alarms();
  runtime.reset();
  EXPECT_TRUE(places().empty()) << "it has been seen";
}

// With the machine lock on the program is somewhere else than the axes. The place that is kept is where they stand: there the next start finds them.
TEST_F(PowerKeep, UnderAMachineLockThePlaceIsWhereTheAxesStand) {
  start(kKept, kPlace);
  machine->lock(true);
  ASSERT_TRUE(wait_until([&] { return runtime->snapshot().system[0].axes.locked == 7; }));
  const double stood[] = {machine->stands_at(0), machine->stands_at(1), machine->stands_at(2)};
  run_into_the_failure();
  EXPECT_GT(std::fabs(runtime->snapshot().system[0].axes.counted[0]), 0.9) << "the program has gone on without its axes";
  const std::vector<ProgramPlace> found = places();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].line, 4u);
  ASSERT_EQ(found[0].at.size(), 3u);
  for (unsigned a = 0; a < 3; ++a) EXPECT_NEAR(found[0].at[a].second, stood[a], 0.01) << a;
  power_goes();

  start(kKept, kPlace);
  char where[80];
  std::snprintf(where, sizeof where, "R25 The power failed in a program: part.nc, line 4, X%.3f ", found[0].at[0].second);
  ASSERT_TRUE(wait_until([&] { return says(where); })) << alarms() << where;
  EXPECT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kWarningActive);
}

TEST_F(PowerKeep, ThePlaceIsToldAtEveryStartUntilSomebodyHasSeenIt) {
  start(kKept, kPlace);
  run_into_the_failure();
  power_goes();
  for (int n = 0; n < 2; ++n) {
    start(kKept, kPlace);
    ASSERT_TRUE(wait_until([&] { return says("R25"); })) << alarms();
    runtime.reset();
    EXPECT_EQ(places().size(), 1u);
  }
}

TEST_F(PowerKeep, WhenThePowerComesBackThePlaceIsForgottenWithTheReset) {
  start(kKept, kPlace);
  run_into_the_failure();
  power(true);
  std::this_thread::sleep_for(100ms);
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(wait_until([&] { return alarms().empty() && !runtime->snapshot().resetting; })) << alarms();
  runtime.reset();
  EXPECT_TRUE(places().empty());
}

TEST_F(PowerKeep, WithoutFilesTheAlarmSaysThatNothingIsKept) {
  start("", "");
  run_into_the_failure();
  EXPECT_TRUE(says("no retained data are configured")) << alarms();
}

// A tap that a power cut meets in its hole has to be known behind it, also where the hole is done long before the interval ends.
TEST_F(PowerKeep, ATapIsOnTheDiskWhileItGoesIn) {
  start("offsets = \"offsets\"\nretain_every_s = 3600\n", "[parameters]\n\"3005\" = 3000\n\"3013\" = 600\n\"3017\" = 250\n");
  const auto kept = [&] {
    RetainStore store((folder / "offsets").string());
    std::string bytes, error;
    return store.load(&bytes, &error) == RetainStore::Loaded::kWhole ? bytes : "";
  };
  EXPECT_EQ(kept().find("tap 0 0"), std::string::npos);
  unsigned number = 0;
  const std::string& source = texts.emplace_back("G90 G0 Z1.\nG84 X0 Y0 Z-3. R0. S60 F0.1 ,R1\nG80\nM30\n");  // 6 mm/min: half a minute
  ASSERT_EQ(runtime->look([&](nc_control* control) { (void)nc_program_add_text(control, "tap.nc", source.data(), source.size(), &number); }), Answer::kDone);
  ASSERT_EQ(runtime->select_program(number), Answer::kDone);
  ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  ASSERT_TRUE(wait_until([&] { return kept().find("tap 0 0") != std::string::npos; })) << kept();
  EXPECT_EQ(runtime->snapshot().system[0].nc.state, NC_STATE_RUNNING) << alarms();
}

// ---- the keeper alone ----

// Data of which a copy is there only when the test gives it.
class SlowData final : public RetainedData {
 public:
  const char* name() const override { return "data"; }
  const char* start() const override { return "are gone"; }
  bool restore(const std::string&) override { return true; }
  std::string now() override { return "start"; }
  void want() override { ++wanted; }
  bool take(std::string* bytes) override {
    const std::lock_guard lock(mutex);
    if (ready.empty()) return false;
    *bytes = std::move(ready);
    ready.clear();
    return true;
  }
  void give(const std::string& bytes) {
    const std::lock_guard lock(mutex);
    ready = bytes;
  }
  std::atomic<int> wanted{0};
  std::mutex mutex;
  std::string ready;
};

TEST_F(PowerKeep, ARequestInTheMiddleOfAWriteIsAnsweredByTheNextOne) {
  const std::string path = (folder / "data").string();
  std::atomic<std::uint32_t> answered{0};
  std::atomic<bool> saved{false};
  RetainKeeper keeper(1, [](unsigned, bool) {}, [] { return true; }, [&](std::uint32_t request, SaveResult result) {
    saved = result == SaveResult::kSaved;
    answered = request; });
  auto owned = std::make_unique<SlowData>();
  SlowData* data = owned.get();
  keeper.add(0, std::move(owned), path);
  keeper.restore(nullptr);
  std::string error;
  ASSERT_TRUE(keeper.start(&error)) << error;
  ASSERT_TRUE(wait_until([&] { return data->wanted == 1; }));  // the ordinary turn has begun
  keeper.hurry(5);
  data->give("before");
  ASSERT_TRUE(wait_until([&] { return data->wanted >= 2; }));
  EXPECT_EQ(answered, 0u) << "that copy may be older than the request";
  data->give("behind");
  ASSERT_TRUE(wait_until([&] { return answered == 5u; }));
  EXPECT_TRUE(saved);
  RetainStore store(path);
  std::string bytes;
  EXPECT_EQ(store.load(&bytes, &error), RetainStore::Loaded::kWhole);
  EXPECT_EQ(bytes, "behind");
}

TEST(PowerPlace, BytesThatMakeNoSenseAreNoPlace) {
  const std::vector<ProgramPlace> places = {{0, "part.nc", 11, 4, 9001, 1, {{'X', 1.5}, {'Y', -3}}}, {1, "MDI", 0, 1, 0, 0, {}}};
  std::vector<ProgramPlace> found;
  const std::string bytes = encode_places(places);
  ASSERT_TRUE(decode_places(bytes, &found));
  EXPECT_EQ(found, places);
  EXPECT_EQ(place_text(places, true), "part system 1: part.nc, behind line 11, in O9001, line 4, X1.500 Y-3.000; part system 2: MDI, line 1");
  for (std::size_t cut = 1; cut + 1 < bytes.size(); ++cut) EXPECT_FALSE(decode_places(bytes.substr(0, cut), &found)) << cut;
  for (const char* wrong : {"ncplace 2\nend\n", "ncplace 1\nprogram x\nend\n", "ncplace 1\nsystem 99\nend\n", "ncplace 1\nsystem 0\nat XY 1\nend\n", "ncplace 1\nsystem 0\nat X nan\nend\n",
                            "ncplace 1\nsystem 0\nblock 1\nend\n"})
    EXPECT_FALSE(decode_places(wrong, &found)) << wrong;
  EXPECT_TRUE(found.empty());
}

}  // namespace
