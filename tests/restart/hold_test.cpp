// SPDX-License-Identifier: Apache-2.0
// A feed hold amid a block on the simulated machine: the operator moves axes by hand, leads them back to the path, and the program goes on as it would have.
#include <random>

#include "restart_machine.hpp"
#include "runtime/test_config.hpp"
#include "support/seeds.hpp"

namespace {

using namespace nc::rt;

const char* const kPart = "G90 G54 G0 X10. Y10.\nG1 Z-5. F3000\nG1 X90. Y40. F3000\nG2 X60. Y70. I-20. J10.\nG1 X10. Y60.\nG4 X0.3\nG81 X40. Y20. Z-8. R2. F1200\nX60.\nG80\nG0 Z20.\nM30\n";

class Hold : public testing::TestWithParam<bool> {
 protected:
  void build(const std::string& more = "") {
    runtime.reset();
    config = nc::test::parse_or_fail(nc::test::base_toml() + "[motion]\nmode = \"" + (GetParam() ? "optimal" : "trapezoid") + "\"\n" + more);
    machine = std::make_unique<nc::test::PathMachine>(config);
    std::vector<ConfigError> errors;
    runtime = Runtime::create(config, {&clock, machine.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr);
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
  }
  void TearDown() override { EXPECT_EQ(machine == nullptr ? 0u : machine->violations, 0u) << "limits of the axes"; }
  void begin(const std::string& source) {
    const std::string& text = texts.emplace_back(source);
    unsigned file = 0;
    ASSERT_EQ(nc_program_add_text(runtime->control(), "part.nc", text.data(), text.size(), &file), NC_OK);
    ASSERT_EQ(runtime->select_program(file), Answer::kDone);
    ASSERT_EQ(start(), Answer::kDone);
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
  Answer start() { return runtime->execute(CommandKind::kCycleStart); }
  Answer mode(Mode mode) { return runtime->execute(CommandKind::kSetMode, 0, static_cast<std::uint32_t>(mode)); }
  Answer by_hand(CommandKind kind, unsigned axis, double value) {
    Command command;
    command.kind = kind;
    command.axis = static_cast<std::uint8_t>(axis);
    command.value = value;
    return runtime->execute(command);
  }
  // After so many scans. False where the program has ended before.
  bool hold_after(int scans) {
    steps(scans);
    if (out().state != NC_STATE_RUNNING) return false;
    EXPECT_EQ(runtime->execute(CommandKind::kFeedHold), Answer::kDone);
    EXPECT_TRUE(until([&] { return out().state == NC_STATE_HOLD && out().manual_allowed; }, 5000));
    stood = out().command;
    return true;
  }
  bool rests() {
    return until([&] { return out().distance_zero && out().state != NC_STATE_MANUAL; }, 20000);
  }
  void jog(unsigned axis, double velocity, int scans) {
    for (int n = 0; n < scans; n += 20) {
      const Answer answer = by_hand(CommandKind::kJog, axis, velocity);
      EXPECT_TRUE(answer == Answer::kDone || answer == Answer::kSoftLimit);
      steps(20);
    }
    let_go(axis);
  }
  void let_go(unsigned axis) {
    EXPECT_EQ(by_hand(CommandKind::kJog, axis, 0), Answer::kDone);
    EXPECT_TRUE(rests());
    steps(3);
  }
  void approach(unsigned axis, double velocity = 40) {
    for (int i = 0; i < 2000 && (out().restart_axes >> axis & 1u) != 0; ++i) {
      ASSERT_EQ(by_hand(CommandKind::kApproach, axis, velocity), Answer::kDone) << axis;
      steps(20);
    }
    let_go(axis);
    EXPECT_EQ(out().command.v[axis], stood.v[axis]) << axis;
  }
  std::vector<unsigned> any_order(std::mt19937& random) {
    std::vector<unsigned> order{0, 1, 2};
    std::shuffle(order.begin(), order.end(), random);
    return order;
  }
  bool to_end() {
    const std::uint64_t runs = runtime->info().system[0].runs;
    return until([&] { return runtime->info().system[0].runs != runs || runtime->snapshot().alarmed(); }) && !runtime->snapshot().alarmed();
  }
  void reset() {
    ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
    ASSERT_TRUE(until([&] { return !runtime->snapshot().resetting && out().state == NC_STATE_IDLE; }));
    steps(5);
  }
  // What a random operator does by hand.
  void hand(std::mt19937& random) {
    const auto uniform = [&random](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
    const unsigned axis = random() % 3;
    switch (random() % 4) {
      case 0: jog(axis, uniform(-90, 90), 20 + static_cast<int>(random() % 600)); break;
      case 1:
        EXPECT_EQ(by_hand(CommandKind::kStep, axis, uniform(-30, 30)), Answer::kDone);
        EXPECT_TRUE(until([&] { return out().state == NC_STATE_MANUAL; }, 10));
        EXPECT_TRUE(rests());
        break;
      case 2:
        ASSERT_EQ(by_hand(CommandKind::kApproach, axis, uniform(1, 60)), Answer::kDone);
        steps(static_cast<int>(random() % 150));
        let_go(axis);
        break;
      default:
        ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
        EXPECT_TRUE(out().restart_axes == 0 || start() == Answer::kRestartAxes);
        EXPECT_EQ(mode(Mode::kMdi), Answer::kMiddleOfBlock);
        EXPECT_EQ(mode(Mode::kManual), Answer::kDone);
        break;
    }
    steps(3);
    EXPECT_EQ(out().state, NC_STATE_HOLD);
  }

  Config config;
  nc::rt::VirtualClock clock;
  std::unique_ptr<nc::test::PathMachine> machine;
  std::unique_ptr<Runtime> runtime;
  std::deque<std::string> texts;
  nc_axes stood{};  // where the path has stopped
};
INSTANTIATE_TEST_SUITE_P(BothLaws, Hold, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

// The tool is lifted out of the work, goes aside, and comes back in an order of its own: first across, then down.
TEST_P(Hold, TheToolIsLiftedAndComesBackToThePath) {
  build();
  ASSERT_NO_FATAL_FAILURE(begin(kPart));
  ASSERT_TRUE(until([&] { return out().source.line == 3 && out().command.v[0] > 40; }));
  ASSERT_TRUE(hold_after(0));
  EXPECT_EQ(mode(Mode::kMdi), Answer::kMiddleOfBlock);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  jog(2, 40, 600);
  jog(0, -60, 400);
  EXPECT_EQ(out().restart_axes, 5u);
  EXPECT_EQ(out().return_place.v[2], stood.v[2]);
  EXPECT_EQ(mode(Mode::kMdi), Answer::kMiddleOfBlock);
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  EXPECT_EQ(start(), Answer::kRestartAxes);
  EXPECT_STREQ(answer_text(Answer::kRestartAxes), "an axis is not where the program goes on: bring it there by hand first");
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  ASSERT_EQ(by_hand(CommandKind::kApproach, 0, 20), Answer::kDone);
  steps(50);
  EXPECT_EQ(by_hand(CommandKind::kApproach, 2, 20), Answer::kAxesMove) << "one after the other";
  let_go(0);
  ASSERT_NO_FATAL_FAILURE(approach(0));
  ASSERT_NO_FATAL_FAILURE(approach(2));
  EXPECT_EQ(start(), Answer::kNotInThisMode);
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(to_end());
  EXPECT_NEAR(out().command.v[0], 60, 1e-9);
  EXPECT_NEAR(out().command.v[1], 20, 1e-9);
  EXPECT_NEAR(out().command.v[2], 20, 1e-9);
}

// An operator who lets go of the dead man's button on the way: the axis stands, and the start is refused.
TEST_P(Hold, TheReturnIsADeadMans) {
  build();
  ASSERT_NO_FATAL_FAILURE(begin(kPart));
  ASSERT_TRUE(until([&] { return out().source.line == 3 && out().command.v[0] > 40; }));
  ASSERT_TRUE(hold_after(0));
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  jog(1, 60, 1000);
  ASSERT_EQ(by_hand(CommandKind::kApproach, 1, 10), Answer::kDone);
  steps(500);
  EXPECT_TRUE(out().distance_zero);
  EXPECT_EQ(out().restart_axes, 2u);
  ASSERT_NO_FATAL_FAILURE(approach(1));
  EXPECT_EQ(out().restart_axes, 0u);
}

// Holds at any time, anything by hand: no limit is exceeded, the axes are back to the last bit, and the program ends where it does.
TEST_P(Hold, ARandomOperatorLosesNothing) {
  const std::uint64_t count = nc::test::seeds(12, 3);
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(static_cast<unsigned>(seed));
    build();
    ASSERT_NO_FATAL_FAILURE(begin(kPart));
    unsigned holds = 0;
    while (hold_after(50 + static_cast<int>(random() % 2500))) {
      ++holds;
      ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
      for (unsigned n = random() % 5; n > 0; --n) ASSERT_NO_FATAL_FAILURE(hand(random));
      for (const unsigned axis : any_order(random)) ASSERT_NO_FATAL_FAILURE(approach(axis));
      for (unsigned a = 0; a < 3; ++a) ASSERT_EQ(out().command.v[a], stood.v[a]);
      ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
      ASSERT_EQ(start(), Answer::kDone);
    }
    ASSERT_EQ(out().state, NC_STATE_IDLE);
    EXPECT_FALSE(runtime->snapshot().alarmed());
    EXPECT_GT(holds, 0u);
    EXPECT_NEAR(out().command.v[0], 60, 1e-9);
    EXPECT_NEAR(out().command.v[1], 20, 1e-9);
    EXPECT_NEAR(out().command.v[2], 20, 1e-9);
    ASSERT_EQ(machine->violations, 0u);
  }
}

// A rotary axis counts on over its turns by hand, too: it comes back by all of them, to the last bit, and the path goes on.
TEST_P(Hold, ARotaryAxisComesBackByAllItsTurns) {
  build("[[axis]]\nname = \"C\"\nrotary = true\nmax_velocity = 400.0\nmax_acceleration = 4000.0\nmax_jerk = 80000.0\n");
  ASSERT_NO_FATAL_FAILURE(begin("G90 G54 G0 X10.\nG1 X60. C700. F2000\nC-40. F4000\nM30\n"));
  ASSERT_TRUE(until([&] { return out().source.line == 2 && out().command.v[0] > 30; }));
  ASSERT_TRUE(hold_after(0));
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  EXPECT_EQ(by_hand(CommandKind::kStep, 3, 720), Answer::kDone);
  EXPECT_TRUE(until([&] { return out().state == NC_STATE_MANUAL; }, 10));
  EXPECT_TRUE(rests());
  EXPECT_EQ(out().restart_axes, 8u) << "two whole turns are not the place";
  jog(3, 90, 400);
  jog(0, 30, 100);
  ASSERT_NO_FATAL_FAILURE(approach(3, 300));
  ASSERT_NO_FATAL_FAILURE(approach(0));
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(to_end());
  EXPECT_NEAR(out().command.v[0], 60, 1e-9);
  const double c = out().command.v[3];
  EXPECT_NEAR(c - 360 * std::floor(c / 360), 320, 1e-9);
}

// A reset with axes away: they stay where they are, and the block that was held is found again as behind any hold.
TEST_P(Hold, BehindAResetTheBlockIsFoundAgain) {
  build();
  ASSERT_NO_FATAL_FAILURE(begin(kPart));
  ASSERT_TRUE(until([&] { return out().source.line == 5; }));
  ASSERT_TRUE(hold_after(100));
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  jog(2, 40, 600);
  const double z = out().command.v[2];
  ASSERT_NO_FATAL_FAILURE(reset());
  EXPECT_EQ(out().command.v[2], z);
  EXPECT_EQ(out().restart_axes, 0u);
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  ASSERT_EQ(runtime->find_restart(0, {RestartBy::kLastStop, 0, 0, ""}), Answer::kDone);
  ASSERT_TRUE(until([&] { return runtime->info().system[0].restart.phase == RestartPhase::kFound; })) << runtime->info().system[0].restart.text;
  EXPECT_EQ(runtime->info().system[0].restart.found.source.line, 5u);
}

// The blocks of MDI that are held: only MDI goes on with them.
TEST_P(Hold, BlocksOfMdiGoOnInMdi) {
  build();
  ASSERT_EQ(mode(Mode::kMdi), Answer::kDone);
  ASSERT_EQ(runtime->load_mdi("G90 G1 X80. F3000\n"), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(hold_after(400));
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  jog(1, 60, 200);
  EXPECT_EQ(mode(Mode::kAuto), Answer::kNotWhileRunning);
  ASSERT_EQ(mode(Mode::kMdi), Answer::kDone);
  EXPECT_EQ(start(), Answer::kRestartAxes);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(approach(1));
  ASSERT_EQ(mode(Mode::kMdi), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(until([&] { return out().state == NC_STATE_IDLE; }, 20000));
  EXPECT_EQ(out().command.v[0], 80);
  EXPECT_EQ(out().command.v[1], stood.v[1]);
}

// Behind a thread, where a hold has become a block stop, the start is refused as elsewhere while an axis is away, of a program and of blocks of MDI; blocks of MDI in the stop
// of a program do not take that back.
TEST_P(Hold, BehindAThreadTheStartWaitsForTheAxes) {
  for (const bool mdi : {false, true}) {
    SCOPED_TRACE(mdi ? "MDI" : "a program");
    build();
    const std::string& text = texts.emplace_back("G90 G54 G0 Z20.\nM3 S600\nG33 Z0 F1.\nG94 G1 X60. F1500.\nX20.\n");
    if (mdi) {
      ASSERT_EQ(mode(Mode::kMdi), Answer::kDone);
      ASSERT_EQ(runtime->load_mdi(text), Answer::kDone);
      ASSERT_EQ(start(), Answer::kDone);
    } else {
      ASSERT_NO_FATAL_FAILURE(begin(text + "M30\n"));
    }
    ASSERT_TRUE(until([&] { return out().source.line == 3 && out().command.v[2] < 15; }));
    ASSERT_EQ(runtime->execute(CommandKind::kFeedHold), Answer::kDone);
    ASSERT_TRUE(until([&] { return out().state == NC_STATE_STOPPED && out().manual_allowed; }, 20000));
    stood = out().command;
    steps(3);
    ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
    jog(2, 40, 300);
    EXPECT_EQ(out().restart_axes, 4u);
    if (!mdi) {
      ASSERT_EQ(mode(Mode::kMdi), Answer::kDone);
      ASSERT_EQ(runtime->load_mdi("M8\n"), Answer::kDone);
      ASSERT_EQ(start(), Answer::kDone);
      ASSERT_TRUE(until([&] { return out().cause == NC_CAUSE_MDI_ENDED; }, 5000));
      EXPECT_EQ(out().restart_axes, 4u);
    }
    ASSERT_EQ(mode(mdi ? Mode::kMdi : Mode::kAuto), Answer::kDone);
    EXPECT_EQ(start(), Answer::kRestartAxes);
    steps(300);
    EXPECT_EQ(out().state, NC_STATE_STOPPED) << "started beside the path";
    ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
    ASSERT_NO_FATAL_FAILURE(approach(2));
    ASSERT_EQ(mode(mdi ? Mode::kMdi : Mode::kAuto), Answer::kDone);
    ASSERT_EQ(start(), Answer::kDone);
    ASSERT_TRUE(until([&] { return out().state == NC_STATE_IDLE; }, 20000));
    EXPECT_EQ(out().command.v[0], 20);
    EXPECT_EQ(out().command.v[2], stood.v[2]);
  }
}

// The buttons of the machine lead back as the command of a client does.
TEST_P(Hold, AButtonLeadsBack) {
  build("[signals]\n\"plc.restart_approach.Y\" = \"in0\"\n\"plc.jog_feed\" = \"word_in\"\n");
  const int button = config.points.find("in0"), feed = config.points.find("word_in");
  machine->hold(feed, 1200);
  ASSERT_NO_FATAL_FAILURE(begin(kPart));
  ASSERT_TRUE(until([&] { return out().source.line == 3 && out().command.v[0] > 40; }));
  ASSERT_TRUE(hold_after(0));
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  jog(1, -60, 400);
  ASSERT_EQ(out().restart_axes, 2u);
  machine->hold(button, 1);
  EXPECT_TRUE(until([&] { return out().restart_axes == 0; }, 20000));
  machine->hold(button, 0);
  steps(20);
  EXPECT_EQ(out().command.v[1], stood.v[1]);
}

// What was refused or stopped before a start is no news behind it.
TEST_P(Hold, AStartTakesAnOlderRefusalAway) {
  build();
  ASSERT_NO_FATAL_FAILURE(begin(kPart));
  ASSERT_TRUE(until([&] { return out().source.line == 3 && out().command.v[0] > 40; }));
  ASSERT_TRUE(hold_after(0));
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  ASSERT_EQ(by_hand(CommandKind::kJog, 1, 10), Answer::kDone);
  steps(1000);  // not asked for again
  ASSERT_EQ(runtime->snapshot().system[0].refusal.asked, Asked::kJog);
  ASSERT_NO_FATAL_FAILURE(approach(1));
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  steps(3);
  EXPECT_EQ(runtime->snapshot().system[0].refusal.asked, Asked::kNothing);
}

}  // namespace
