// SPDX-License-Identifier: Apache-2.0
// A runtime on virtual time in which the tests of this room begin a program inside: it selects, searches, confirms and approaches as an operator does.
#pragma once

#include "restart_machine.hpp"

#include "runtime/test_config.hpp"

namespace nc::test::inside {

using namespace rt;

// The whole run is known at one place for each scan, and its corners lie between two of them.
constexpr double kChord = 2e-4;

class Restart : public testing::Test {
 protected:
  void build(const std::string& more = "") {
    runtime.reset();
    config = nc::test::parse_or_fail(nc::test::base_toml() + "[motion]\nmode = \"trapezoid\"\n" + more);
    machine = std::make_unique<nc::test::PathMachine>(config);
    std::vector<ConfigError> errors;
    runtime = Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr);
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
  }
  void TearDown() override {
    EXPECT_EQ(machine == nullptr ? 0u : machine->violations, 0u) << "limits of the axes";
  }
  void select(const std::string& source, const std::string& name = "part.nc") {
    const std::string& text = texts.emplace_back(source);
    unsigned file = 0;
    ASSERT_EQ(nc_program_add_text(runtime->control(), name.c_str(), text.data(), text.size(), &file), NC_OK);
    ASSERT_EQ(runtime->select_program(file), Answer::kDone);
  }
  void steps(int n) {
    while (n-- > 0) runtime->step();
  }
  template <class Condition>
  bool until(Condition condition, int most = 200000) {
    while (most-- > 0 && !condition()) runtime->step();
    return condition();
  }
  nc_outputs out() const { return runtime->snapshot().system[0].nc; }
  RestartStatus restart() const { return runtime->info().system[0].restart; }
  Answer start() { return runtime->execute(CommandKind::kCycleStart); }
  Answer mode(Mode mode) { return runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(mode)); }
  Answer find(RestartBy by, std::uint64_t number = 0, std::uint32_t passing = 0) { return runtime->find_restart(0, {by, number, passing, ""}); }
  void reset() {
    ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
    ASSERT_TRUE(until([&] { return !runtime->snapshot().resetting && out().state == NC_STATE_IDLE; }));
    steps(5);
  }
  bool to_end() {
    const std::uint64_t runs = runtime->info().system[0].runs;
    return until([&] { return runtime->info().system[0].runs != runs || runtime->snapshot().alarmed(); }) && !runtime->snapshot().alarmed();
  }
  void mdi(const std::string& blocks) {
    ASSERT_EQ(mode(Mode::kMdi), Answer::kDone);
    ASSERT_EQ(runtime->load_mdi(blocks), Answer::kDone) << runtime->explain(Answer::kRefusedByControl);
    const std::uint64_t serial = out().serial;
    ASSERT_EQ(start(), Answer::kDone);
    ASSERT_TRUE(until([&] { return out().state == NC_STATE_STOPPED && out().cause == NC_CAUSE_MDI_ENDED && out().serial != serial; }));
    steps(3);
  }
  void let_go(unsigned axis) {
    Command stop;
    stop.kind = CommandKind::kJog;
    stop.axis = static_cast<std::uint8_t>(axis);
    ASSERT_EQ(runtime->execute(stop), Answer::kDone);
  }
  Answer ask_approach(unsigned axis, double velocity = 50) {
    Command command;
    command.kind = CommandKind::kApproach;
    command.axis = static_cast<std::uint8_t>(axis);
    command.value = velocity;
    return runtime->execute(command);
  }
  void approach(unsigned axis) {
    for (int i = 0; i < 2000 && (out().restart_axes >> axis & 1u) != 0; ++i) {
      ASSERT_EQ(ask_approach(axis), Answer::kDone) << axis;
      steps(20);
    }
    EXPECT_EQ(out().restart_axes >> axis & 1u, 0u) << axis;
    let_go(axis);
    steps(5);
  }
  // From the found place to the stop in front of it.
  void come_to_place() {
    ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kFound || restart().phase == RestartPhase::kEnded; })) << restart().text;
    ASSERT_EQ(restart().phase, RestartPhase::kFound) << restart().text;
    ASSERT_EQ(start(), Answer::kDone);
    ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kStands; }));
  }
  // The places of the run from the one on that is nearest to where `rest` begins must be those of `rest`: compared as a curve.
  static double most_beside(const std::vector<nc_axes>& whole, const std::vector<nc_axes>& rest) {
    double most = 0;
    for (const nc_axes& place : rest) {
      double least = 1e9;
      for (std::size_t i = 0; i + 1 < whole.size(); ++i) {
        double length = 0, along = 0, square = 0;
        for (unsigned a = 0; a < 3; ++a) {
          const double way = whole[i + 1].v[a] - whole[i].v[a];
          length += way * way;
          along += (place.v[a] - whole[i].v[a]) * way;
        }
        const double share = length == 0 ? 0 : std::clamp(along / length, 0.0, 1.0);
        for (unsigned a = 0; a < 3; ++a) {
          const double beside = place.v[a] - whole[i].v[a] - share * (whole[i + 1].v[a] - whole[i].v[a]);
          square += beside * beside;
        }
        least = std::min(least, std::sqrt(square));
      }
      most = std::max(most, least);
    }
    return most;
  }

  Config config;
  VirtualClock clock;
  std::unique_ptr<nc::test::PathMachine> machine;
  std::unique_ptr<Runtime> runtime;
  std::deque<std::string> texts;
};

}  // namespace nc::test::inside
