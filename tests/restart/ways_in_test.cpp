// SPDX-License-Identifier: Apache-2.0
// A program stands at a place to which it was brought, its recovery list is open or an axis is away: no way leads past that. Two part systems, each with a place
// of its own.
#include <array>
#include <random>

#include "restart_machine.hpp"
#include "runtime/refusal.hpp"
#include "runtime/test_config.hpp"
#include "support/seeds.hpp"

namespace {

using namespace nc::rt;

class WaysIn : public testing::Test {
 protected:
  static constexpr const char* kMore =
      "[motion]\nmode = \"trapezoid\"\n"
      "[[point]]\nname = \"stick\"\ntype = \"word\"\ndirection = \"input\"\n[[point]]\nname = \"grip\"\ndirection = \"input\"\n[[point]]\nname = \"wheel\"\ntype = \"word\"\ndirection = \"input\"\n"
      "[[point]]\nname = \"held\"\ndirection = \"input\"\ninitial = 1\n"
      "[[joystick]]\naxis = \"X\"\ninput = \"stick\"\nlow = 0\nmiddle = 500\nhigh = 1000\ntop_speed = 20.0\ndead_man = \"grip\"\n"
      "[[handwheel]]\ncounter = \"wheel\"\nbits = 16\naxes = { Y = \"in1\" }\n"
      "[[axis]]\nsystem = 2\nname = \"X\"\nmax_velocity = 200.0\nmax_acceleration = 2000.0\nmax_jerk = 50000.0\nsoft_limits = [-500.0, 500.0]\n"
      "[signals]\n\"plc.cycle_start\" = \"in0\"\n\"plc.feed_hold_n\" = \"held\"\n";
  static constexpr const char* kFirst = "G90 G54 T5 M6\nG0 X10. Y10.\nN40 G1 X20. F1200.\nX30.\nM30\n";
  static constexpr const char* kSecond = "G90 M8\nG0 X5.\nN40 G1 X7. F600.\nX9.\nM30\n";

  void SetUp() override {
    config = nc::test::parse_or_fail(nc::test::base_toml() + kMore);
    machine = std::make_unique<nc::test::PathMachine>(config);
    std::vector<ConfigError> errors;
    runtime = Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr) << (errors.empty() ? "" : errors[0].text());
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
    hold("held", 1);
    hold("stick", 500);
    select(0, "first.nc", kFirst);
    select(1, "second.nc", kSecond);
    for (unsigned s = 0; s < 2; ++s) {
      ASSERT_EQ(runtime->find_restart(s, {RestartBy::kSequence, 40, 0, ""}), Answer::kDone);
      ASSERT_TRUE(until([&] { return restart(s).phase == RestartPhase::kFound; })) << restart(s).text;
    }
    ASSERT_EQ(start(kAllSystems), Answer::kDone);
    ASSERT_TRUE(until([&] { return restart(0).phase == RestartPhase::kStands && restart(1).phase == RestartPhase::kStands; })) << restart(0).text << restart(1).text;
  }
  void select(unsigned system, const char* name, const char* text) {
    Command command;
    command.kind = CommandKind::kSelectProgram;
    command.system = static_cast<std::uint8_t>(system);
    unsigned file = 0;
    ASSERT_EQ(nc_program_add_text(runtime->control(), name, text, std::strlen(text), &file), NC_OK);
    command.number = file;
    ASSERT_EQ(runtime->execute(command), Answer::kDone);
  }
  void hold(const char* point, std::int32_t value) { machine->hold(config.points.find(point), value); }
  Answer start(std::uint8_t system) {
    Command command;
    command.kind = CommandKind::kCycleStart;
    command.system = system;
    return runtime->execute(command);
  }
  Answer mode(Mode wanted) { return runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(wanted)); }
  RestartStatus restart(unsigned s) const { return runtime->info().system[s].restart; }
  nc_outputs out(unsigned s = 0) const { return runtime->snapshot().system[s].nc; }
  void steps(int n) {
    while (n-- > 0) runtime->step();
  }
  template <class Condition>
  bool until(Condition condition, int most = 20000) {
    while (most-- > 0 && !condition()) runtime->step();
    return condition();
  }
  Answer hand(CommandKind kind, unsigned axis, double value) {
    Command command;
    command.kind = kind;
    command.axis = static_cast<std::uint8_t>(axis);
    command.value = value;
    return runtime->execute(command);
  }
  void approach(unsigned system, unsigned axis) {
    Command command;
    command.kind = CommandKind::kApproach;
    command.system = static_cast<std::uint8_t>(system);
    command.axis = static_cast<std::uint8_t>(axis);
    command.value = 50;
    for (int i = 0; i < 500 && (out(system).restart_axes >> axis & 1u) != 0; ++i) {
      ASSERT_EQ(runtime->execute(command), Answer::kDone);
      steps(20);
    }
    command.kind = CommandKind::kJog;
    command.value = 0;
    ASSERT_EQ(runtime->execute(command), Answer::kDone);
    steps(50);
  }
  void confirm(unsigned system) {
    Command command;
    command.kind = CommandKind::kConfirmRestart;
    command.system = static_cast<std::uint8_t>(system);
    command.number = kEveryEntry;
    ASSERT_EQ(runtime->execute(command), Answer::kDone);
  }
  bool stand() const { return restart(0).phase == RestartPhase::kStands && restart(1).phase == RestartPhase::kStands; }

  // One of all ways in which anything begins to move here.
  void try_a_way(std::mt19937& random) {
    const auto below = [&random](unsigned n) { return static_cast<unsigned>(random() % n); };
    switch (below(13)) {
      case 0: (void)start(0); break;
      case 1: (void)start(1); break;
      case 2: (void)start(kAllSystems); break;
      case 3: hold("in0", static_cast<std::int32_t>(below(2))); break;
      case 4: (void)runtime->force("plc.cycle_start", below(2)); break;
      case 5: (void)runtime->release(""); break;
      case 6:
      case 7: (void)mode(std::array{Mode::kAuto, Mode::kManual, Mode::kMdi}[below(3)]); break;
      case 8:
        if (runtime->load_mdi(below(2) == 0 ? "M55\n" : "G4 P50\n") == Answer::kDone) (void)start(0);
        break;
      case 9: (void)hand(below(2) == 0 ? CommandKind::kStep : CommandKind::kJog, below(3), static_cast<double>(below(20)) - 10); break;
      case 10: hold("grip", static_cast<std::int32_t>(below(2))); break;
      case 11: hold("stick", std::array{0, 500, 500, 1000}[below(4)]), hold("wheel", static_cast<std::int32_t>(below(400))), hold("in1", static_cast<std::int32_t>(below(2))); break;
      case 12: hold("held", below(3) != 0), (void)runtime->execute(CommandKind::kSingleBlock, 0, below(2)); break;
    }
  }

  Config config;
  VirtualClock clock;
  std::unique_ptr<nc::test::PathMachine> machine;
  std::unique_ptr<Runtime> runtime;
};

TEST_F(WaysIn, NoneLeadsPastWhatIsOpen) {
  const std::uint64_t first = nc::test::wish("NC_FIRST_SEED", 1), seeds = nc::test::seeds(4, 1);
  unsigned refused = 0, by_hand = 0, ran = 0;
  for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(static_cast<unsigned>(seed));
    for (unsigned s = 0; s < 2 && seed % 2 == 0; ++s) confirm(s);  // then an axis is away all the same
    for (int n = 0; n < 8000; ++n) {
      if (random() % 6 == 0) try_a_way(random);
      runtime->step();
      ASSERT_TRUE(stand()) << n << ": " << restart(0).text << ", " << restart(1).text;
      by_hand += out().state == NC_STATE_MANUAL;
      ran += out().state == NC_STATE_RUNNING;
    }
    refused += runtime->snapshot().system[0].refusal.count;
  }
  EXPECT_GE(refused, 100u) << "else it shows little";
  EXPECT_GE(by_hand, 100u);
  EXPECT_GE(ran, 100u) << "blocks of MDI";
}

TEST_F(WaysIn, EachPartSystemGoesOnWhenItsOwnListIsDoneAndItsAxesAreThere) {
  EXPECT_EQ(start(0), Answer::kRestartOpen);
  EXPECT_EQ(start(1), Answer::kRestartOpen);
  confirm(1);
  EXPECT_EQ(start(1), Answer::kRestartAxes);
  EXPECT_EQ(start(kAllSystems), Answer::kRestartOpen) << "of the first one";
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(approach(1, 0));
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  EXPECT_EQ(start(kAllSystems), Answer::kRestartOpen);
  EXPECT_TRUE(stand());
  ASSERT_EQ(start(1), Answer::kDone);
  ASSERT_TRUE(until([&] { return runtime->info().system[1].runs == 1; }));
  EXPECT_NEAR(out(1).command.v[0], 9, 1e-9);
  EXPECT_EQ(restart(0).phase, RestartPhase::kStands);
  confirm(0);
  EXPECT_EQ(start(0), Answer::kRestartAxes);
  EXPECT_EQ(start(kAllSystems), Answer::kRestartAxes);
  EXPECT_EQ(runtime->info().system[1].runs, 1u) << "the other one is not begun at its head either";
}

// A button that is refused gets no answer, so the screen of each part system names the axis, and whose it is.
TEST_F(WaysIn, ARefusedStartNamesTheAxisAndItsPartSystem) {
  confirm(0);
  confirm(1);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  for (unsigned axis = 0; axis < 3; ++axis) ASSERT_NO_FATAL_FAILURE(approach(0, axis));
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  ASSERT_EQ(out(0).restart_axes, 0u);
  ASSERT_NE(out(1).restart_axes, 0u);
  hold("in0", 1);
  steps(50);
  hold("in0", 0);
  steps(5);
  const auto text = [this](unsigned s) { return refusal_text(config, s, runtime->snapshot().system[s].refusal); };
  EXPECT_EQ(text(0), "cycle start refused: an axis is not where the program goes on: bring it there by hand first (X of part system 2)");
  EXPECT_EQ(text(1), "cycle start refused: an axis is not where the program goes on: bring it there by hand first (X)");
}

}  // namespace
