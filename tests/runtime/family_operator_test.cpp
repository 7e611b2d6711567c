// SPDX-License-Identifier: Apache-2.0
// An operator who does anything at the shipped machines of the families: start, hold, reset, modes, jog, MDI, overrides, single block, and the mains go off at any
// moment. In every cycle the axes keep their limits; whatever was done, a reset and a start run the part to the end that its first run had.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "places/places.hpp"
#include "runtime/config.hpp"
#include "runtime/runtime.hpp"
#include "support/seeds.hpp"
#include "walls_machine.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::Mode;

/// A family's shipped machine with its part, and what its operator types.
struct Shop {
  const char* name;
  const char* machine;
  const char* part;
  std::vector<const char*> mdi;  ///< blocks of MDI, all of them within the machine's stroke
};

const Shop kShops[] = {
    {"hx", "drill-mill.toml", "bracket.nc", {"G21 G90 G00 X5. Y5.\n", "G91 G01 X1. F500.\n", "M03 S1000\n", "G21 G90 G54 G01 X10. F2000.\nX0.\nY10.\n", "G90 G28 Z0\n", "#500=#500+1\n"}},
    {"series8", "knee-mill.toml", "jig-plate.s8", {"G71G90G00X5Y5\n", "G71G90F500\nG01X10\nG01X0\n", "M03S500\n", "M05\n", "G71F1000G91G01X1\nX-1\n"}},
    {"dgshape", "modelling-machine.toml", "keytag.nc", {"%\nG21G90G00X5.Y5.\n", "%\nG21G91G01X1.F10.\n", "%\nG28Z0\n", "%\nM03S1000\n"}},
    {"iso", "router.toml", "plate.ngc", {"G21 G90 G0 X5 Y5\n", "G21 G91 G1 X1 F500\n", "M3 S1000\n", "#100=[#100+1]\n", "G21 G90 G28 Z0\n", "G21 G90 F2000 G1 X10\nX0\n"}},
};

void PrintTo(const Shop& shop, std::ostream* out) { *out << shop.name; }

std::string read_file(const std::filesystem::path& path) {
  std::ifstream stream(path);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

class FamilyOperator : public testing::TestWithParam<Shop> {
 protected:
  void SetUp() override {
    const std::filesystem::path root(nc::test::kSourceDir);
    for (const auto& error : nc::rt::load_config((root / "etc" / GetParam().machine).string(), &config_)) FAIL() << error.text();
    text_ = read_file(root / "examples" / "parts" / GetParam().part);
    ASSERT_FALSE(text_.empty());
  }

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool chance(double p) { return uniform(0, 1) < p; }
  unsigned draw(unsigned n) { return static_cast<unsigned>(random_() % n); }

  /// The control is switched on, with the axes where they stand.
  void power_on() {
    machine_ = std::make_unique<nc::test::WatchedMachine>(config_, &recording_);
    std::vector<nc::rt::ConfigError> errors;
    runtime_ = nc::rt::Runtime::create(config_, {&clock_, machine_.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime_, nullptr) << (errors.empty() ? "" : errors[0].text());
    ASSERT_EQ(nc_program_add_text(runtime_->control(), "part", text_.data(), text_.size(), &file_), NC_OK);
    std::string error;
    ASSERT_TRUE(runtime_->start_stepping(&error)) << error;
    ASSERT_EQ(runtime_->select_program(file_), Answer::kDone);
  }
  void power_off() {
    const nc_axes at = runtime_->snapshot().system[0].actual;
    runtime_.reset();
    for (unsigned a = 0; a < config_.nc.system[0].axis_count; ++a) {
      const nc_axis_config& axis = config_.nc.system[0].axis[a];
      config_.start[0].v[a] = axis.soft_limited ? std::min(axis.soft_max, std::max(axis.soft_min, at.v[a])) : at.v[a];
      config_.sim.start[0].v[a] = config_.start[0].v[a];
    }
    ++power_cuts;
  }

  Answer ask(CommandKind kind, unsigned axis = 0, double value = 0, std::uint32_t number = 0) {
    nc::rt::Command command;
    command.kind = kind;
    command.axis = static_cast<std::uint8_t>(axis);
    command.value = value;
    command.number = number;
    return runtime_->execute(command);
  }
  Answer mode(Mode wanted) { return ask(CommandKind::kSetMode, 0, 0, static_cast<std::uint32_t>(wanted)); }
  nc_outputs out() const { return runtime_->snapshot().system[0].nc; }

  /// What he does in one cycle; most often nothing.
  void act() {
    const unsigned axes = config_.nc.system[0].axis_count;
    if (chance(0.01)) (void)ask(CommandKind::kCycleStart);
    if (chance(0.002)) (void)ask(CommandKind::kFeedHold);
    if (chance(0.0008)) (void)ask(CommandKind::kReset);
    if (chance(0.002)) (void)mode(chance(0.7) ? Mode::kAuto : chance(0.5) ? Mode::kManual : Mode::kMdi);
    if (chance(0.003)) (void)ask(CommandKind::kFeedOverride, 0, chance(0.05) ? 0 : uniform(0, 2));
    if (chance(0.003)) (void)ask(CommandKind::kRapidOverride, 0, chance(0.05) ? 0 : uniform(0, 1));
    if (chance(0.002)) (void)ask(CommandKind::kSingleBlock, 0, 0, chance(0.3) ? 1 : 0);
    if (chance(0.002)) (void)ask(CommandKind::kOptionalStop, 0, 0, draw(2));
    if (chance(0.01)) (void)ask(chance(0.5) ? CommandKind::kStep : CommandKind::kJog, draw(axes), uniform(-20, 20));
    if (chance(0.0005)) (void)ask(CommandKind::kReference, draw(axes));
    if (chance(0.001)) {  // behind a reset he wants to type something
      (void)ask(CommandKind::kReset);
      for (int i = 0; i < 200; ++i) runtime_->step();
      (void)mode(Mode::kMdi);
    }
    if (chance(0.02)) {
      const auto& blocks = GetParam().mdi;
      mdi += runtime_->load_mdi(blocks[draw(static_cast<unsigned>(blocks.size()))]) == Answer::kDone;
    }
  }

  /// A part may count from where the axes stand at home (G92 of the jig plate). Z first, out of the part.
  void go_home() {
    ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
    (void)ask(CommandKind::kRapidOverride, 0, 1);
    const unsigned axes = config_.nc.system[0].axis_count;
    for (unsigned k = 0; k < axes; ++k) {
      const unsigned a = k == 0 ? 2 : k <= 2 ? k - 1 : k;
      ASSERT_EQ(ask(CommandKind::kReference, a), Answer::kDone) << "axis " << a;
      for (int i = 0; i < 20000 && (i < 20 || !out().distance_zero); ++i) runtime_->step();
    }
  }
  /// Starts the part from a clean state and runs it; where the axes stand at its end.
  void run_part(nc_axes* end) {
    for (int i = 0; i < 3000 && (out().state != NC_STATE_IDLE || !out().distance_zero || i < 10); ++i) {
      if (i % 300 == 0) (void)ask(CommandKind::kReset);
      runtime_->step();
    }
    ASSERT_EQ(out().state, NC_STATE_IDLE) << "cause " << int{out().cause};
    ASSERT_NO_FATAL_FAILURE(go_home());
    ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
    ASSERT_EQ(runtime_->select_program(file_), Answer::kDone);
    (void)ask(CommandKind::kSingleBlock, 0, 0, 0);
    (void)ask(CommandKind::kOptionalStop, 0, 0, 0);
    (void)ask(CommandKind::kFeedOverride, 0, 2);
    (void)ask(CommandKind::kRapidOverride, 0, 1);
    const std::uint64_t runs = runtime_->info().system[0].runs;
    ASSERT_EQ(ask(CommandKind::kCycleStart), Answer::kDone);
    for (std::uint64_t n = 0; n < 2'000'000 && runtime_->info().system[0].runs == runs && !runtime_->snapshot().alarmed(); ++n)
      for (unsigned i = 0; i < 16; ++i) runtime_->step();
    const nc::rt::Snapshot now = runtime_->snapshot();
    const nc_alarm& why = runtime_->info().system[0].program_alarm;
    ASSERT_FALSE(now.alarmed()) << runtime_->alarm_text(now.alarms.alarm[0]) << ' ' << why.code << " line " << why.source.line << ' ' << why.detail.s;
    ASSERT_TRUE(runtime_->info().system[0].ended_ok);
    for (int i = 0; i < 3000 && !out().distance_zero; ++i) runtime_->step();
    *end = out().command;
  }
  void expect_same(const nc_axes& end, const nc_axes& first) {
    for (unsigned a = 0; a < config_.nc.system[0].axis_count; ++a) EXPECT_NEAR(end.v[a], first.v[a], 1e-6) << "axis " << a;
  }

  void session(std::uint64_t seed, unsigned scans, const nc_axes& first) {
    random_.seed(seed);
    ASSERT_NO_FATAL_FAILURE(power_on());
    for (unsigned n = 0; n < scans; ++n) {
      act();
      runtime_->step();
      moved += out().distance_zero ? 0 : 1;
      running += out().state == NC_STATE_RUNNING ? 1 : 0;
      if (chance(0.0001)) {
        power_off();
        ASSERT_NO_FATAL_FAILURE(power_on());
      }
      for (const std::string& what : recording_.violations) FAIL() << "scan " << n << ": " << what;
    }
    nc_axes end{};
    ASSERT_NO_FATAL_FAILURE(run_part(&end));
    expect_same(end, first);
    for (const std::string& what : recording_.violations) ADD_FAILURE() << what;
    runtime_.reset();
  }

  nc::rt::Config config_;
  std::string text_;
  unsigned file_ = 0;
  nc::test::Recording recording_;
  nc::rt::VirtualClock clock_;
  std::unique_ptr<nc::test::WatchedMachine> machine_;
  std::unique_ptr<nc::rt::Runtime> runtime_;
  std::mt19937_64 random_;
  std::uint64_t moved = 0, running = 0, mdi = 0, power_cuts = 0;
};

TEST_P(FamilyOperator, WhoDoesAnythingLeavesTheLimitsAndThePart) {
  nc_axes first{};
  ASSERT_NO_FATAL_FAILURE(power_on());
  ASSERT_NO_FATAL_FAILURE(run_part(&first));
  runtime_.reset();
  const std::uint64_t from = nc::test::wish("NC_FIRST_SEED", 1), count = nc::test::seeds(4, 1);
  for (std::uint64_t seed = from; seed < from + count; ++seed) {
    SCOPED_TRACE(seed);
    ASSERT_NO_FATAL_FAILURE(session(seed, 12000, first));
    ASSERT_FALSE(HasFailure());
  }
  std::printf("%s: %llu sessions, cycles with motion %llu, in the program %llu, texts of MDI %llu, power cuts %llu, velocity %.4f and acceleration %.4f of the limits\n", GetParam().name,
              static_cast<unsigned long long>(count), static_cast<unsigned long long>(moved), static_cast<unsigned long long>(running), static_cast<unsigned long long>(mdi),
              static_cast<unsigned long long>(power_cuts), recording_.velocity_ratio, recording_.acceleration_ratio);
  EXPECT_GT(moved, 100u);
  EXPECT_GT(running, 100u);
}

INSTANTIATE_TEST_SUITE_P(Shops, FamilyOperator, testing::ValuesIn(kShops), [](const testing::TestParamInfo<Shop>& shop) { return std::string(shop.param.name); });

}  // namespace
