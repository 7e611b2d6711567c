// SPDX-License-Identifier: Apache-2.0
// A program that is begun inside, on the simulated machine: the rest of it has the path of the whole run, and nothing moves before the operator has said so.
#include "restart_machine.hpp"

#include "runtime/test_config.hpp"

namespace {

using namespace nc::rt;

// The whole run is known at one place for each scan, and its corners lie between two of them.
constexpr double kChord = 2e-4;

const char* const kPart =
    "N10 G90 G54 G17 G21 T5 M6\n"
    "S1200 M3\n"
    "G0 X10. Y10.\n"
    "N40 G1 Z-2. F600. M8\n"
    "N50 G91 G1 X20. F1200.\n"
    "Y15.\n"
    "N70 G2 X-10. Y10. I0. J10.\n"
    "N80 G90 G1 X5. Y5.\n"
    "N90 G0 Z20. M9\n"
    "M5\n"
    "M30\n";

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

TEST_F(Restart, TheRestOfAPartHasThePathOfTheWholeRun) {
  build();
  select(kPart);
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(to_end());
  const std::vector<nc_axes> whole = machine->path;

  ASSERT_EQ(find(RestartBy::kSequence, 70), Answer::kDone) << runtime->explain(Answer::kNoPlace);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  EXPECT_EQ(restart().found.source.line, 7u);
  machine->path.clear();
  steps(300);
  EXPECT_EQ(machine->path.size(), 1u) << "nothing moves before the operator has said so";
  EXPECT_EQ(start(), Answer::kRestartOpen);
  ASSERT_NO_FATAL_FAILURE(mdi("T5 M6\nS1200 M3\nM8\n"));
  EXPECT_EQ(restart().list.open(), 0u);
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  EXPECT_EQ(start(), Answer::kRestartAxes);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  for (const unsigned axis : {0u, 1u, 2u}) ASSERT_NO_FATAL_FAILURE(approach(axis));
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  machine->path.clear();
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(to_end());
  EXPECT_LT(most_beside(whole, machine->path), kChord);
  EXPECT_NEAR(machine->path.back().v[2], 20, 1e-9);
  EXPECT_EQ(restart().phase, RestartPhase::kEnded);
}

// Comes to the place, is given nothing, and has its axes there.
TEST_F(Restart, AWrongToolOrAStandingSpindleIsRefused) {
  build("[signals]\n\"plc.cycle_start\" = \"in0\"\n");
  select(kPart);
  ASSERT_EQ(find(RestartBy::kLine, 6), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  const auto open = [&] {
    std::string all;
    const RestartStatus now = restart();
    for (const RecoveryEntry& entry : now.list.entries())
      if (entry.state == RecoveryEntry::State::kOpen) all += now.list.text(entry) + " ";
    return all;
  };
  EXPECT_EQ(open(), "T5 M6 S1200 M3 M8 ");
  ASSERT_NO_FATAL_FAILURE(mdi("T6 M6\nS1200 M3\nM8\n"));
  EXPECT_EQ(open(), "T5 M6 ") << "the wrong tool";
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  EXPECT_EQ(start(), Answer::kRestartOpen);
  ASSERT_NO_FATAL_FAILURE(mdi("T5\n"));
  EXPECT_EQ(open(), "M6 ") << "it is called, and tool 6 is in the spindle";
  ASSERT_NO_FATAL_FAILURE(mdi("M6\nM3\nM8\n"));
  EXPECT_EQ(open(), "");
  ASSERT_NO_FATAL_FAILURE(mdi("M5\n"));
  EXPECT_EQ(open(), "M3 ") << "the spindle has been stopped again";
  ASSERT_NO_FATAL_FAILURE(mdi("M3\n"));
  EXPECT_EQ(open(), "");
  ASSERT_NO_FATAL_FAILURE(mdi("M55\n"));
  EXPECT_EQ(open(), "M6 M3 M8 ") << "M55 is none of the list, so nothing is known of those any more";
  ASSERT_NO_FATAL_FAILURE(mdi("M6\nM3\n"));
  ASSERT_NO_FATAL_FAILURE(mdi("S900\n"));
  EXPECT_EQ(open(), "S1200 M8 ");
  ASSERT_NO_FATAL_FAILURE(mdi("S1200 M6\n"));
  EXPECT_EQ(open(), "M3 M8 ") << "a tool change behind M3 has stopped the spindle";
  ASSERT_NO_FATAL_FAILURE(mdi("M3\n"));
  ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, 99), Answer::kOutOfRange);
  ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, 4), Answer::kDone);
  EXPECT_EQ(open(), "");
  ASSERT_NO_FATAL_FAILURE(mdi("M9\n"));
  EXPECT_EQ(open(), "M6 M3 M8 ") << "and what was confirmed is not any more";
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  // By a button as by a command.
  const std::uint32_t refusals = runtime->snapshot().system[0].refusal.count;
  machine->hold(config.points.find("in0"), 1);
  steps(10);
  machine->hold(config.points.find("in0"), 0);
  steps(10);
  EXPECT_EQ(runtime->snapshot().system[0].refusal.count, refusals + 1);
  EXPECT_EQ(runtime->snapshot().system[0].refusal.why, Answer::kRestartOpen);
  EXPECT_EQ(out().state, NC_STATE_STOPPED);
  ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, kEveryEntry), Answer::kDone);
  EXPECT_EQ(start(), Answer::kRestartAxes);
}

TEST(RecoveryNames, OutputsHaveTheNameOfTheFamily) {
  const struct {
    nc_dialect dialect;
    unsigned word;
    const char* text;
  } rows[] = {{NC_DIALECT_M700, 1, "#1133 bits 3 = 1"},
              {NC_DIALECT_HX, 1, "#7533 bits 3 = 1"},
              {NC_DIALECT_ISO, 1, "#6132 bits 3 = 1"},
              {NC_DIALECT_ISO, 0, "output word 0 bits 3 = 1"}};  // of that one it has the bits alone
  for (const auto& row : rows) {
    nc_restart_found found;
    nc_restart_found_init(&found);
    found.output_written[row.word] = 3;
    found.output[row.word] = 1;
    RecoveryList list;
    list.begin(found, row.dialect);
    ASSERT_EQ(list.entries().size(), 1u);
    EXPECT_EQ(list.text(list.entries().front()), row.text);
  }
}

TEST_F(Restart, TheListHasWhatCountsAndTheNewestOfTheSpindle) {
  build();
  select("T1\nS500 M3\nM5\nM0\nM6\nM1\nS800 M4\nM8\nM9\nM8\n#1100=1\nN9 G1 X1. F600.\nM30\n");
  ASSERT_EQ(find(RestartBy::kSequence, 9), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  const RestartStatus now = restart();
  std::string all;
  for (const RecoveryEntry& entry : now.list.entries()) all += now.list.text(entry) + "; ";
  EXPECT_EQ(all, "T1; M6; S800; M4; M9; M8; #1132 bits 1 = 1; ");
}

// The usual way: behind a tool change the next tool is called, so that the changer brings it meanwhile. The tool in the spindle is that of the T in front of the change.
TEST_F(Restart, AToolThatIsCalledAheadIsNotTheOneInTheSpindle) {
  build();
  select("N10 G90 G54 T1 M6\nS500 M3\nN20 T2\nN30 G0 X5. Y5.\nN50 G1 Y15. F1200.\nN60 M6\nX5.\nM30\n");
  ASSERT_EQ(find(RestartBy::kSequence, 50), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  const auto open = [&] {
    std::string all;
    const RestartStatus now = restart();
    for (const RecoveryEntry& entry : now.list.entries())
      if (entry.state == RecoveryEntry::State::kOpen) all += now.list.text(entry) + " ";
    return all;
  };
  EXPECT_EQ(open(), "T1 M6 S500 M3 T2 ");
  ASSERT_NO_FATAL_FAILURE(mdi("T2\n"));
  ASSERT_NO_FATAL_FAILURE(mdi("M6\n"));
  EXPECT_EQ(open(), "T1 M6 S500 M3 ") << "tool 2 is in the spindle";
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  EXPECT_EQ(start(), Answer::kRestartOpen);
  ASSERT_NO_FATAL_FAILURE(mdi("T1\n"));
  EXPECT_EQ(open(), "M6 S500 M3 T2 ");
  ASSERT_NO_FATAL_FAILURE(mdi("T2\n"));
  EXPECT_EQ(open(), "T1 M6 S500 M3 ") << "it was called before the change of tool 1";
  ASSERT_NO_FATAL_FAILURE(mdi("T1 M6\nS500 M3\n"));
  EXPECT_EQ(open(), "T2 ");
  ASSERT_NO_FATAL_FAILURE(mdi("T2\n"));
  EXPECT_EQ(open(), "") << "called ahead of the next change, it leaves tool 1 in the spindle";
  ASSERT_NO_FATAL_FAILURE(mdi("M6\n"));
  EXPECT_EQ(open(), "T1 M6 M3 ") << "now it does not";
}

// Tool 1 is broken, a new one is put in its place by hand, and the next one stands ready.
TEST_F(Restart, AToolThatTheOperatorConfirmsIsInTheSpindleUntilAnotherOneIsChanged) {
  build();
  select("T1 M6\nT2\nG0 X5.\nN50 G1 X15. F1200.\nM30\n");
  ASSERT_EQ(find(RestartBy::kSequence, 50), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, kEveryEntry), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(mdi("T2\n"));
  EXPECT_EQ(restart().list.open(), 0u);
  ASSERT_NO_FATAL_FAILURE(mdi("M6\n"));
  EXPECT_EQ(restart().list.open(), 2u) << "T1 and M6";
  ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, 0), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(mdi("M6\n"));
  EXPECT_EQ(restart().list.open(), 2u) << "what was confirmed is in the spindle; the change brings tool 2";
}

TEST_F(Restart, AMachineWhoseTChangesTheToolHasOneT) {
  build();
  select("T1\nG0 X5.\nT2\nN50 G1 X15. F1200.\nM30\n");
  ASSERT_EQ(find(RestartBy::kSequence, 50), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  ASSERT_EQ(restart().list.entries().size(), 1u);
  EXPECT_EQ(restart().list.text(restart().list.entries().front()), "T2");
  ASSERT_NO_FATAL_FAILURE(mdi("T1\n"));
  EXPECT_EQ(restart().list.open(), 1u);
  ASSERT_NO_FATAL_FAILURE(mdi("T2\n"));
  EXPECT_EQ(restart().list.open(), 0u);
}

TEST_F(Restart, OneAxisAtATimeAndOnlyWhileItIsAskedFor) {
  build();
  select(kPart);
  ASSERT_EQ(find(RestartBy::kSequence, 80), Answer::kDone);
  EXPECT_EQ(ask_approach(0), Answer::kNotInThisMode);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  EXPECT_EQ(ask_approach(0), Answer::kNotInThisMode);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  EXPECT_EQ(ask_approach(7), Answer::kAxisUnknown);
  EXPECT_EQ(ask_approach(0, 1e5), Answer::kOutOfRange);
  EXPECT_EQ(ask_approach(0, -1), Answer::kOutOfRange);
  EXPECT_EQ(ask_approach(0, 0), Answer::kNoJogFeed);
  EXPECT_EQ(ask_approach(0, 20), Answer::kLetGoFirst) << "it was asked for in another mode, and has been asked for since";
  let_go(0);
  ASSERT_EQ(ask_approach(0, 20), Answer::kDone);
  steps(30);
  EXPECT_GT(out().velocity.v[0], 0);
  EXPECT_EQ(ask_approach(1, 20), Answer::kAxesMove);
  let_go(1);
  // Nobody asks again: the axis stops, and it is away still.
  steps(400);
  EXPECT_EQ(out().velocity.v[0], 0);
  EXPECT_EQ(out().restart_axes & 1u, 1u);
  ASSERT_NO_FATAL_FAILURE(approach(1));
  ASSERT_NO_FATAL_FAILURE(approach(0));
  ASSERT_NO_FATAL_FAILURE(approach(2));
  EXPECT_EQ(out().restart_axes, 0u);
  EXPECT_NEAR(out().command.v[0], restart().found.machine.v[0], 1e-9);
}

TEST_F(Restart, AButtonLeadsItsAxisToThePlaceAsLongAsItIsHeld) {
  build("[signals]\n\"plc.restart_approach.X\" = \"in0\"\n\"plc.restart_approach.Y\" = \"in1\"\n\"plc.jog_feed\" = \"word_in\"\n");
  const int x = config.points.find("in0"), y = config.points.find("in1"), feed = config.points.find("word_in");
  select(kPart);
  ASSERT_EQ(find(RestartBy::kSequence, 80), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  machine->hold(feed, 1200);
  machine->hold(x, 1);
  steps(30);
  EXPECT_EQ(out().velocity.v[0], 0) << "not in this mode";
  EXPECT_EQ(runtime->snapshot().system[0].refusal.why, Answer::kNotInThisMode);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  steps(30);
  EXPECT_EQ(out().velocity.v[0], 0) << "it was on before: it must be let go first";
  machine->hold(x, 0);
  steps(5);
  machine->hold(x, 1);
  steps(50);
  EXPECT_NEAR(out().velocity.v[0], 20, 1e-6);
  machine->hold(y, 1);
  steps(50);
  EXPECT_EQ(out().velocity.v[1], 0) << "one axis at a time";
  EXPECT_GT(out().velocity.v[0], 0) << "and the first one goes on";
  machine->hold(x, 0);
  steps(100);
  EXPECT_EQ(out().velocity.v[0], 0);
  EXPECT_EQ(out().velocity.v[1], 0) << "the other one does not begin by itself";
  EXPECT_EQ(out().restart_axes & 3u, 3u);
  machine->hold(y, 0);
  steps(5);
  for (const int button : {y, x}) {
    machine->hold(button, 1);
    steps(3000);
    machine->hold(button, 0);
    steps(50);
  }
  EXPECT_EQ(out().restart_axes & 3u, 0u);
  EXPECT_FALSE(runtime->snapshot().alarmed());
}

TEST_F(Restart, TheLastStopIsFoundAndTheRestHasThePathOfTheWholeRun) {
  build();
  select(kPart);
  ASSERT_EQ(find(RestartBy::kLastStop), Answer::kNoPlace) << "nothing has been stopped";
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(to_end());
  ASSERT_EQ(find(RestartBy::kLastStop), Answer::kNoPlace) << "it has come to its end";
  const std::vector<nc_axes> whole = machine->path;
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(until([&] { return out().source.line == 7 && out().velocity.v[0] != 0; }));
  steps(40);
  ASSERT_NO_FATAL_FAILURE(reset());
  ASSERT_EQ(find(RestartBy::kPowerOff), Answer::kNoPlace);
  ASSERT_EQ(find(RestartBy::kLastStop), Answer::kDone) << runtime->explain(Answer::kNoPlace);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  EXPECT_EQ(restart().found.source.line, 7u);
  ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, kEveryEntry), Answer::kDone);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  for (const unsigned axis : {2u, 0u, 1u}) ASSERT_NO_FATAL_FAILURE(approach(axis));
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  machine->path.clear();
  ASSERT_EQ(start(), Answer::kDone);
  // It is stopped once more, and goes on once more.
  ASSERT_TRUE(until([&] { return out().source.line == 8 && out().velocity.v[0] != 0; }));
  steps(20);
  ASSERT_NO_FATAL_FAILURE(reset());
  EXPECT_LT(most_beside(whole, machine->path), kChord);
  ASSERT_EQ(find(RestartBy::kLastStop), Answer::kDone) << runtime->explain(Answer::kNoPlace);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  EXPECT_EQ(restart().found.source.line, 8u);
}

// M700 13.2, 13.5.1: the macro of G66 runs at each place of a pattern. A place to begin inside lies in one of these runs, or between two of them.
TEST_F(Restart, InTheMacroOfAPatternTheRestHasAllItsPlaces) {
  const char* const part =
      "N10 G90 G54 G17 G21 G0 X5. Y5. Z10.\n"
      "G66 P200 Z-5. F1200.\n"
      "N20 G37.1 X10. Y10. I6. P2 J6. K2\n"
      "N30 G67\n"
      "G0 X0 Y0\n"
      "M30\n"
      "O200\n"
      "N50 G91 G1 Z#26 F#9\n"
      "N60 G0 Z-#26\n"
      "N70 G90\n"
      "M99\n";
  build();
  select(part);
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(to_end());
  const std::vector<nc_axes> whole = machine->path;
  const auto rest_of_whole = [&] {
    ASSERT_NO_FATAL_FAILURE(come_to_place());
    ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, kEveryEntry), Answer::kDone);
    ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
    for (const unsigned axis : {2u, 0u, 1u}) ASSERT_NO_FATAL_FAILURE(approach(axis));
    ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
    machine->path.clear();
    ASSERT_EQ(start(), Answer::kDone);
    ASSERT_TRUE(to_end());
    EXPECT_LT(most_beside(whole, machine->path), kChord);
    EXPECT_LT(most_beside(machine->path, {whole.end() - 1, whole.end()}), kChord);
  };
  for (const std::uint32_t passing : {1u, 3u}) {
    SCOPED_TRACE(passing);
    ASSERT_EQ(find(RestartBy::kLine, 8, passing), Answer::kDone) << runtime->explain(Answer::kNoPlace);
    ASSERT_NO_FATAL_FAILURE(rest_of_whole());
    unsigned holes = 0;  // what comes down at 5 behind the place
    for (std::size_t i = 1; i < machine->path.size(); ++i) holes += machine->path[i].v[2] < 5.001 && machine->path[i - 1].v[2] >= 5.001 ? 1 : 0;
    EXPECT_EQ(holes, 5 - passing);
  }
  // Stopped by a reset in a macro, and on the way between two places: the pattern of that run goes on, not a new one.
  for (const bool in_macro : {true, false}) {
    SCOPED_TRACE(in_macro);
    ASSERT_EQ(start(), Answer::kDone);
    ASSERT_TRUE(until([&] { return out().source.line == (in_macro ? 8u : 3u) && machine->path.back().v[0] > 12 && (in_macro ? out().velocity.v[2] : out().velocity.v[0]) != 0; }));
    steps(10);
    ASSERT_NO_FATAL_FAILURE(reset());
    ASSERT_EQ(find(RestartBy::kLastStop), Answer::kDone) << runtime->explain(Answer::kNoPlace);
    ASSERT_NO_FATAL_FAILURE(rest_of_whole());
  }
}

// A loop that is long enough for the search to take many steps of the feeder.
const char* const kLoop = "#1=0\nN1 #1=#1+1\nG1 X[#1/100000] F6000.\nIF[#1LT300000]GOTO1\nN9 G1 X20.\nM30\n";

TEST_F(Restart, AResetOrAnotherModeEndsTheSearch) {
  build();
  select(kLoop);
  ASSERT_EQ(find(RestartBy::kSequence, 9), Answer::kDone);
  steps(5);
  ASSERT_EQ(restart().phase, RestartPhase::kSearching) << restart().text;
  EXPECT_GT(restart().read, 0u);
  EXPECT_EQ(start(), Answer::kRestartSearch);
  EXPECT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, kEveryEntry), Answer::kNoPlace);
  ASSERT_NO_FATAL_FAILURE(reset());
  EXPECT_EQ(restart().phase, RestartPhase::kLost) << restart().text;
  EXPECT_EQ(start(), Answer::kRestartLost);
  ASSERT_EQ(find(RestartBy::kSequence, 9), Answer::kDone);
  steps(5);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  steps(5);
  EXPECT_EQ(restart().phase, RestartPhase::kLost);
  EXPECT_EQ(restart().text, "another mode has been chosen");
  EXPECT_EQ(find(RestartBy::kSequence, 9), Answer::kNotInThisMode);
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  EXPECT_EQ(start(), Answer::kRestartLost);
  ASSERT_EQ(find(RestartBy::kSequence, 9), Answer::kDone);
  steps(5);
  ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
  EXPECT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kNoPlace);
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(until([&] { return out().source.line == 3; }));
  EXPECT_LT(out().command.v[0], 0.1);
}

// A reset gives the place up, wherever the operator is with it, and an alarm does. The whole program is not what the next press of the button means, so it begins neither inside
// nor at its head, by command or button, however often reset is pressed, before it is said what is meant.
TEST_F(Restart, BehindAResetOrAnAlarmNothingBeginsAtTheHeadWithoutAWord) {
  for (const bool stands : {false, true})
    for (const bool alarm : {false, true})
      for (const unsigned way : {0u, 1u, 2u}) {
        SCOPED_TRACE(std::string(stands ? "at the place, " : "place found, ") + (alarm ? "alarm, way " : "reset, way ") + std::to_string(way));
        build("[[point]]\nname = \"trouble\"\ndirection = \"input\"\n[signals]\n\"plc.alarm.1\" = \"trouble\"\n");
        select(kPart);
        ASSERT_EQ(find(RestartBy::kSequence, 50), Answer::kDone);
        ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kFound; })) << restart().text;
        if (stands) {
          ASSERT_EQ(start(), Answer::kDone);
          ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kStands; })) << restart().text;
        }
        if (alarm) {
          machine->hold(config.points.find("trouble"), 1);
          ASSERT_TRUE(until([&] { return runtime->snapshot().alarmed(); }));
          steps(5);
          machine->hold(config.points.find("trouble"), 0);
        }
        const double before = out().command.v[0];
        for (unsigned press = 0; press < 3; ++press) {
          ASSERT_NO_FATAL_FAILURE(reset());
          steps(5);
          EXPECT_EQ(restart().phase, RestartPhase::kLost) << restart().text;
          EXPECT_EQ(start(), Answer::kRestartLost);
          steps(50);
          EXPECT_EQ(out().state, NC_STATE_IDLE);
          EXPECT_EQ(out().command.v[0], before);
        }
        EXPECT_NE(restart().text.find(alarm ? "alarm" : stands ? "given up" : "reset"), std::string::npos) << restart().text;
        if (way == 0) {
          ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
        } else if (way == 1) {
          select(kPart);
        } else {
          ASSERT_EQ(find(RestartBy::kSequence, 50), Answer::kDone);
          ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kFound; })) << restart().text;
        }
        EXPECT_EQ(start(), Answer::kDone);
      }
}

TEST_F(Restart, WhatIsNotThereIsSaidAndNothingStartsBeforeItIsCancelled) {
  build();
  select(kPart);
  struct Row {
    RestartBy by;
    std::uint64_t number;
    const char* text;
  };
  for (const Row& row : {Row{RestartBy::kSequence, 4711, "no such sequence number"}, Row{RestartBy::kLine, 99, "ended before it came there"}, Row{RestartBy::kBlock, 1000000, "ended before it came there"}}) {
    ASSERT_EQ(find(row.by, row.number), Answer::kDone);
    ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kLost; }));
    EXPECT_NE(restart().text.find(row.text), std::string::npos) << restart().text;
  }
  EXPECT_EQ(find(RestartBy::kSequence, 0), Answer::kRefusedByControl) << "0 is no sequence number";
  EXPECT_EQ(runtime->find_restart(0, {RestartBy::kLine, 3, 0, "other.nc"}), Answer::kNoPlace);
  EXPECT_EQ(runtime->find_restart(1, {RestartBy::kLine, 3, 0, ""}), Answer::kAxisUnknown);
  EXPECT_EQ(start(), Answer::kRestartLost);
  steps(50);
  EXPECT_EQ(out().state, NC_STATE_IDLE);
  ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(to_end());
  EXPECT_NEAR(out().command.v[2], 20, 1e-9);
  select("G90 G1 X1. F600.\n#1=SQRT[-1]\nN3 X2.\nM30\n", "wrong.nc");
  ASSERT_EQ(find(RestartBy::kSequence, 3), Answer::kDone);
  ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kLost; }));
  EXPECT_NE(restart().text.find("(line 2)"), std::string::npos) << restart().text;
  EXPECT_FALSE(runtime->snapshot().alarmed()) << "nothing has run";
}

// A search reads the program with what it writes. Where the program does not go on from its place, nothing of that stays.
class SearchedWrites : public Restart {
 protected:
  void begin(const std::string& more = "") {
    build(more);
    ASSERT_EQ(runtime->change([](nc_control* control) {
      (void)nc_work_offset_set(control, 0, 1, 0, -3);
      (void)nc_variable_set(control, 0, 500, 7, false);
      (void)nc_variable_set(control, 0, 501, 0, true);
    }), Answer::kDone);
    select("G90 G54\nG91 G10 L2 P1 X1.\n#500=#500+1\n#501=5\nG90 G0 X5.\nX6.\nM30\n");
  }
  void search(unsigned line = 6, RestartPhase phase = RestartPhase::kFound) {
    ASSERT_EQ(find(RestartBy::kLine, line), Answer::kDone);
    ASSERT_TRUE(until([&] { return restart().phase == phase; })) << restart().text;
  }
  // Offset, the variable that is counted, and whether the other one is vacant.
  std::string values() {
    double offset = 0, counted = 0, other = 0;
    bool vacant = false, other_vacant = false;
    EXPECT_EQ(runtime->look([&](nc_control* control) {
      (void)nc_work_offset_get(control, 0, 1, 0, &offset);
      (void)nc_variable_get(control, 0, 500, &counted, &vacant);
      (void)nc_variable_get(control, 0, 501, &other, &other_vacant);
    }), Answer::kDone);
    char text[64];
    std::snprintf(text, sizeof text, "%g %g %s", offset, counted, other_vacant ? "vacant" : "set");
    return text;
  }
};

TEST_F(SearchedWrites, ArePutBackWhenThePlaceIsGivenUp) {
  ASSERT_NO_FATAL_FAILURE(begin());
  const std::string before = "-3 7 vacant";
  ASSERT_EQ(values(), before);
  ASSERT_NO_FATAL_FAILURE(search());
  EXPECT_EQ(values(), "-2 8 set");
  ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
  EXPECT_EQ(values(), before) << "cancelled";
  ASSERT_NO_FATAL_FAILURE(search());
  ASSERT_NO_FATAL_FAILURE(reset());
  EXPECT_EQ(values(), before) << "a reset";
  ASSERT_NO_FATAL_FAILURE(search());
  ASSERT_EQ(runtime->select_program(0), Answer::kDone);
  EXPECT_EQ(values(), before) << "another program";
  ASSERT_NO_FATAL_FAILURE(search(99, RestartPhase::kLost));
  EXPECT_EQ(values(), before) << "not found";
  ASSERT_NO_FATAL_FAILURE(search());
  ASSERT_NO_FATAL_FAILURE(search(5));
  EXPECT_EQ(values(), "-2 8 set") << "another search begins with what was there before the first one";
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kStands; }));
  ASSERT_NO_FATAL_FAILURE(reset());
  EXPECT_EQ(values(), before) << "a reset at the place";
}

// What counts once more is named, and nobody goes on without having seen it. A variable that was vacant cannot have counted, and what has the same value behind the search does not.
TEST_F(SearchedWrites, AreAnEntryToBeConfirmedWhereTheyHaveChangedAnything) {
  ASSERT_NO_FATAL_FAILURE(begin());
  ASSERT_NO_FATAL_FAILURE(search());
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  const RestartStatus now = restart();
  ASSERT_EQ(now.list.entries().size(), 1u);
  EXPECT_EQ(now.list.text(now.list.entries()[0]), "written in front of the place: #500 = 8 (it was 7), work offset 1 X = -2 (it was -3)");
  EXPECT_EQ(start(), Answer::kRestartOpen);
  ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, 0), Answer::kDone);
  EXPECT_EQ(start(), Answer::kRestartAxes);
  ASSERT_NO_FATAL_FAILURE(reset());
  select("G90 G54\nG10 L2 P1 X-3.\n#500=7\n#501=5\nG90 G0 X5.\nX6.\nM30\n");
  ASSERT_NO_FATAL_FAILURE(search());
  EXPECT_TRUE(restart().list.entries().empty());
}

TEST_F(SearchedWrites, OfManyTheFirstAreNamedAndTheRestCounted) {
  build();
  ASSERT_EQ(runtime->change([](nc_control* control) {
    for (unsigned n = 0; n < 40; ++n) (void)nc_variable_set(control, 0, 500 + n, 1, false);
  }), Answer::kDone);
  select("#1=0\nWHILE[#1LT40]DO1\n#[500+#1]=#1+10\n#1=#1+1\nEND1\nN6G90 G0 X5.\nM30\n");
  ASSERT_NO_FATAL_FAILURE(search());
  const RestartStatus now = restart();
  ASSERT_EQ(now.list.entries().size(), 1u);
  const std::string text = now.list.text(now.list.entries()[0]);
  EXPECT_NE(text.find("#500 = 10 (it was 1), #501 = 11 (it was 1)"), std::string::npos) << text;
  EXPECT_NE(text.find("and 32 more"), std::string::npos) << text;
}

// The search executes what the program writes, so it needs what a start needs.
TEST_F(SearchedWrites, AProgramThatMayNotBeginIsNotSearched) {
  struct Refuses : StartGate {
    bool may_begin(unsigned, unsigned) override { return false; }
    Looked look_again() override { return Looked::kSame; }
    bool waits(unsigned) override { return false; }
    std::string remark(unsigned) override { return "line 3: the axis is not there"; }
  } gate;
  ASSERT_NO_FATAL_FAILURE(begin());
  runtime->set_start_gate(&gate);
  EXPECT_EQ(find(RestartBy::kLine, 6), Answer::kNotChecked);
  EXPECT_EQ(runtime->explain(Answer::kNotChecked), "line 3: the axis is not there");
  steps(20);
  EXPECT_EQ(restart().phase, RestartPhase::kNone);
  EXPECT_EQ(values(), "-3 7 vacant");
  runtime->set_start_gate(nullptr);
}

TEST_F(SearchedWrites, StayWhereTheProgramGoesOnOrSomebodyElseHasWritten) {
  ASSERT_NO_FATAL_FAILURE(begin());
  ASSERT_NO_FATAL_FAILURE(search());
  ASSERT_EQ(runtime->change([](nc_control* control) { (void)nc_work_offset_set(control, 0, 1, 0, -8); }), Answer::kDone);
  steps(3);
  EXPECT_EQ(restart().phase, RestartPhase::kLost);
  EXPECT_EQ(values(), "-8 7 vacant");
  ASSERT_NO_FATAL_FAILURE(search());
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, kEveryEntry), Answer::kDone);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  for (const unsigned axis : {2u, 1u, 0u}) ASSERT_NO_FATAL_FAILURE(approach(axis));
  ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(to_end());
  EXPECT_EQ(values(), "-7 8 set");
}

// The search takes tools of groups, counts their mounts, and registers tools anew.
class SearchedLives : public SearchedWrites {
 protected:
  using Rows = std::map<std::string, double>;
  void begin_lives(const std::string& source, const Rows& rows) {
    build("[parameters]\n\"1103\" = 1\n");
    ASSERT_EQ(runtime->change([&](nc_control* control) {
      for (const auto& [key, value] : rows) EXPECT_EQ(nc_tool_life_set(control, static_cast<unsigned>(key[0] - '0'), static_cast<nc_life_column>(key[2] - '0'), value), NC_OK) << key;
    }), Answer::kDone);
    select(source);
  }
  // "1 5" is the column NC_LIFE_USED of the first tool.
  Rows lives() {
    Rows rows;
    EXPECT_EQ(runtime->look([&](nc_control* control) {
      for (unsigned number = 1; number <= 9; ++number)
        for (unsigned column = 0; column <= NC_LIFE_AUXILIARY; ++column) {
          double value = 0;
          if (nc_tool_life_get(control, number, static_cast<nc_life_column>(column), &value) == NC_OK && value != 0) rows[std::to_string(number) + " " + std::to_string(column)] = value;
        }
    }), Answer::kDone);
    return rows;
  }
};

TEST_F(SearchedLives, ArePutBackWhenThePlaceIsGivenUp) {
  const Rows before = {{"1 0", 7}, {"1 1", 11}, {"1 2", 16}, {"1 4", 3}, {"1 5", 1}, {"2 0", 7}, {"2 1", 12}, {"2 2", 16}, {"2 4", 3}};
  ASSERT_NO_FATAL_FAILURE(begin_lives("T7 M6\nT7 M6\nT7 M6\nG0 X5.\nX6.\nM30\n", before));
  ASSERT_EQ(lives(), before);
  ASSERT_NO_FATAL_FAILURE(search(5));
  EXPECT_NE(lives(), before) << "else it shows nothing";
  ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
  EXPECT_EQ(lives(), before) << "cancelled";
  ASSERT_NO_FATAL_FAILURE(search(5));
  ASSERT_NO_FATAL_FAILURE(reset());
  EXPECT_EQ(lives(), before) << "a reset";
  ASSERT_NO_FATAL_FAILURE(search(99, RestartPhase::kLost));
  EXPECT_EQ(lives(), before) << "not found";
}

// What is counted decides which lives a tool may have, so no order of the columns fits every change.
TEST_F(SearchedLives, OfMinutesComeBackBehindOnesOfTimesAndTheOtherWayRound) {
  const Rows minutes = {{"1 0", 7}, {"1 1", 11}, {"1 4", 100}, {"1 5", 20.5}}, times = {{"1 0", 7}, {"1 1", 11}, {"1 2", 16}, {"1 4", 9000}, {"1 5", 8000}};
  for (const Rows& before : {minutes, times}) {
    const char* const other = before == minutes ? "G10 L3\nP7 L9000 Q1\nT11\nG11\nT7 M6\nX6.\nM30\n" : "G10 L3\nP7 L100 Q2\nT11\nG11\nT7 M6\nX6.\nM30\n";
    ASSERT_NO_FATAL_FAILURE(begin_lives(other, before));
    ASSERT_EQ(lives(), before);
    ASSERT_NO_FATAL_FAILURE(search(6));
    EXPECT_NE(lives(), before);
    ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
    EXPECT_EQ(lives(), before);
  }
}

// The outputs that the search has written were given out by nobody: a program that writes one bit of their word later gives out that one.
TEST_F(SearchedWrites, OutputsOfASearchThatIsGivenUpAreNotGivenOutLater) {
  build();
  select("#1100=1\n#1101=1\nG0 X5.\nX6.\nM30\n");
  ASSERT_NO_FATAL_FAILURE(search(4));
  ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
  select("#1102=1\n#500=#1100\nG0 X1.\nM30\n", "other.nc");
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(to_end());
  EXPECT_EQ(runtime->snapshot().interface_output[0], 4u);
  double read = 0;
  EXPECT_EQ(runtime->look([&](nc_control* control) { (void)nc_variable_get(control, 0, 500, &read, nullptr); }), Answer::kDone);
  EXPECT_EQ(read, 0);
}

TEST_F(Restart, AChangedProgramAndAnotherOneAreRefused) {
  build();
  runtime->set_program_hash([&](unsigned file) { return std::to_string(std::hash<std::string>()(texts.at(file))); });
  select(kPart);
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(until([&] { return out().source.line == 6; }));
  ASSERT_NO_FATAL_FAILURE(reset());
  select("G0 X1.\nM30\n", "other.nc");
  EXPECT_EQ(find(RestartBy::kLastStop), Answer::kNoPlace);
  EXPECT_EQ(runtime->explain(Answer::kNoPlace), "at the last stop the program was part.nc, and other.nc is selected");
  ASSERT_EQ(nc_program_remove(runtime->control(), 0), NC_OK);
  std::string changed = kPart;
  changed.replace(changed.find("X20."), 4, "X21.");
  texts.pop_front();
  texts.push_front(changed);
  unsigned file = 9;
  ASSERT_EQ(nc_program_add_text(runtime->control(), "part.nc", texts[0].data(), texts[0].size(), &file), NC_OK);
  ASSERT_EQ(file, 0u);
  ASSERT_EQ(runtime->select_program(file), Answer::kDone);
  EXPECT_EQ(find(RestartBy::kLastStop), Answer::kNoPlace);
  EXPECT_NE(runtime->explain(Answer::kNoPlace).find("has been changed since"), std::string::npos) << runtime->explain(Answer::kNoPlace);
}

// A place that the operator means, and that somebody else's change has lost, is no reason to begin the whole program.
TEST_F(Restart, ChangedTablesLoseThePlaceAndNothingStartsBeforeTheOperatorSaysSo) {
  build();
  select(kPart);
  const auto lose = [&] {
    ASSERT_EQ(find(RestartBy::kSequence, 80), Answer::kDone);
    ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kFound; }));
    ASSERT_EQ(runtime->change([](nc_control*) {}), Answer::kDone);
    EXPECT_EQ(start(), Answer::kRestartLost);
    steps(3);
    EXPECT_EQ(restart().phase, RestartPhase::kLost);
    EXPECT_EQ(start(), Answer::kRestartLost);
    steps(50);
    EXPECT_EQ(out().state, NC_STATE_IDLE);
  };
  ASSERT_NO_FATAL_FAILURE(lose());
  ASSERT_NO_FATAL_FAILURE(reset());  // says nothing of the place
  EXPECT_EQ(restart().phase, RestartPhase::kLost);
  EXPECT_EQ(start(), Answer::kRestartLost);
  ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
  EXPECT_EQ(restart().phase, RestartPhase::kEnded);
  ASSERT_NO_FATAL_FAILURE(lose());
  ASSERT_EQ(find(RestartBy::kSequence, 80), Answer::kDone);
  ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kFound; }));
  ASSERT_NO_FATAL_FAILURE(lose());
  ASSERT_EQ(runtime->select_program(0), Answer::kDone);
  EXPECT_EQ(restart().phase, RestartPhase::kEnded);
  ASSERT_NO_FATAL_FAILURE(lose());
  ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
  ASSERT_EQ(start(), Answer::kDone);
  EXPECT_TRUE(to_end());
  EXPECT_EQ(runtime->info().system[0].runs, 1u);
}

TEST_F(Restart, AStartOfAllPartSystemsBeginsNoOtherProgramAtItsHead) {
  build("[[axis]]\nsystem = 2\nname = \"X\"\nmax_velocity = 200.0\nmax_acceleration = 2000.0\nmax_jerk = 50000.0\nsoft_limits = [-500.0, 500.0]\n");
  select(kPart);
  const std::string& text = texts.emplace_back("G90 G1 X5. F600.\nN2 X7.\nM30\n");
  unsigned file = 0;
  ASSERT_EQ(nc_program_add_text(runtime->control(), "second.nc", text.data(), text.size(), &file), NC_OK);
  Command choose;
  choose.kind = CommandKind::kSelectProgram;
  choose.system = 1;
  choose.number = file;
  ASSERT_EQ(runtime->execute(choose), Answer::kDone);
  ASSERT_EQ(runtime->find_restart(1, {RestartBy::kSequence, 2, 0, ""}), Answer::kDone);
  ASSERT_TRUE(until([&] { return runtime->info().system[1].restart.phase == RestartPhase::kFound; }));
  machine->path.clear();
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(until([&] { return runtime->info().system[1].restart.phase == RestartPhase::kStands; }));
  steps(200);
  EXPECT_EQ(out().state, NC_STATE_IDLE);
  EXPECT_EQ(machine->path.size(), 1u);
  EXPECT_EQ(start(), Answer::kRestartAxes);
  EXPECT_EQ(out().state, NC_STATE_IDLE);
}

// Behind motion by hand in any block stop.
TEST_F(Restart, AnAxisComesBackToThePathInABlockStop) {
  build();
  select("G90 G1 X10. F3000.\nM0\nY5.\nM30\n");
  ASSERT_EQ(start(), Answer::kDone);
  ASSERT_TRUE(until([&] { return out().state == NC_STATE_STOPPED; }));
  steps(3);
  ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
  Command step;
  step.kind = CommandKind::kStep;
  step.value = 3;
  ASSERT_EQ(runtime->execute(step), Answer::kDone);
  ASSERT_TRUE(until([&] { return out().command.v[0] > 12.9999 && out().distance_zero; }));
  steps(5);
  for (int i = 0; i < 500 && std::abs(out().command.v[0] - 10) > 1e-9; ++i) {
    ASSERT_EQ(ask_approach(0), Answer::kDone) << i << " " << refusal_text(config, 0, runtime->snapshot().system[0].refusal);
    steps(20);
  }
  EXPECT_NEAR(out().command.v[0], 10, 1e-9);
}

// What a run leaves in force of the coordinate systems outlives it (M700 9.1). The rest of the part is that of the run, so it is read with what the run was begun with.
class CoordinatesLeft : public Restart {
 protected:
  void by_mdi(const std::string& blocks) {
    ASSERT_EQ(mode(Mode::kMdi), Answer::kDone);
    ASSERT_EQ(runtime->load_mdi(blocks), Answer::kDone) << runtime->explain(Answer::kRefusedByControl);
    ASSERT_EQ(start(), Answer::kDone);
    ASSERT_TRUE(to_end());
    steps(5);
    ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  }
  // Runs the part once as a whole and once up to its line 3, with the machine and its coordinate systems as `head` leaves them.
  void stop_in(const std::string& part, const std::string& head = "G92.1 X0 Y0\nG52 X0 Y0\nG53 G0 X-20. Y-10.\n") {
    build();
    for (const bool whole : {true, false}) {
      ASSERT_NO_FATAL_FAILURE(by_mdi(head));
      ASSERT_NO_FATAL_FAILURE(select(part));
      machine->path.clear();
      ASSERT_EQ(start(), Answer::kDone);
      if (whole) {
        ASSERT_TRUE(to_end());
        whole_ = machine->path;
      } else {
        ASSERT_TRUE(until([&] { return out().source.line == 3 && out().velocity.v[0] != 0; }));
        steps(40);
        ASSERT_NO_FATAL_FAILURE(reset());
      }
    }
  }
  void expect_rest_of_whole() {
    ASSERT_NO_FATAL_FAILURE(come_to_place());
    EXPECT_EQ(restart().found.source.line, 3u);
    ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, kEveryEntry), Answer::kDone);
    ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
    for (const unsigned axis : {2u, 0u, 1u}) ASSERT_NO_FATAL_FAILURE(approach(axis));
    ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
    machine->path.clear();
    ASSERT_EQ(start(), Answer::kDone);
    ASSERT_TRUE(to_end());
    EXPECT_LT(most_beside(whole_, machine->path), kChord);
    for (unsigned a = 0; a < 3; ++a) EXPECT_NEAR(machine->path.back().v[a], whole_.back().v[a], 1e-9) << a;
  }
  // Of X, as the executed blocks have left it.
  double shift() {
    nc_restart_coordinates left{};
    EXPECT_EQ(runtime->look([&](nc_control* control) { (void)nc_restart_coordinates_get(control, 0, false, &left); }), Answer::kDone);
    return left.shift.v[0];
  }
  std::vector<nc_axes> whole_;
};
const char* const kShifted = "G90 G54 G0 X5. Y5.\nG92 X30.\nG1 X60. F1500.\nX30.\nM30\n";
const char* const kLocal = "G90 G54 G0 X5. Y5.\nG52 X10. Y12.\nG1 X60. F1500.\nX30. Y1.\nM30\n";

TEST_F(CoordinatesLeft, ByG92DoNotCountTwice) {
  ASSERT_NO_FATAL_FAILURE(stop_in(kShifted));
  ASSERT_EQ(find(RestartBy::kLastStop), Answer::kDone) << runtime->explain(Answer::kNoPlace);
  ASSERT_NO_FATAL_FAILURE(expect_rest_of_whole());
}

TEST_F(CoordinatesLeft, ByG52DoNotCountTwice) {
  ASSERT_NO_FATAL_FAILURE(stop_in(kLocal));
  ASSERT_EQ(find(RestartBy::kLastStop), Answer::kDone) << runtime->explain(Answer::kNoPlace);
  ASSERT_NO_FATAL_FAILURE(expect_rest_of_whole());
}

// The shift was in force before the run: the rest is cut with it.
TEST_F(CoordinatesLeft, OfTheBeginningCountAsInTheRun) {
  ASSERT_NO_FATAL_FAILURE(stop_in(kShifted, "G92.1 X0 Y0\nG53 G0 X-20. Y-10.\nG92 X0 Y7.\n"));
  ASSERT_NO_FATAL_FAILURE(by_mdi("G92.1 X0 Y0\n"));
  ASSERT_NO_FATAL_FAILURE(select(kShifted));
  ASSERT_EQ(find(RestartBy::kLastStop), Answer::kDone) << runtime->explain(Answer::kNoPlace);
  ASSERT_NO_FATAL_FAILURE(expect_rest_of_whole());
}

TEST_F(CoordinatesLeft, AreThoseOfBeforeWhereThePlaceIsGivenUp) {
  ASSERT_NO_FATAL_FAILURE(stop_in(kShifted));
  const double left = shift();
  for (int time = 0; time < 3; ++time) {
    ASSERT_EQ(find(RestartBy::kLastStop), Answer::kDone) << runtime->explain(Answer::kNoPlace);
    ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kFound; })) << restart().text;
    EXPECT_NEAR(restart().found.machine.v[0], 5, 1e-9) << time;
    if (time == 2) break;
    if (time == 0) {
      ASSERT_EQ(runtime->execute(CommandKind::kCancelRestart), Answer::kDone);
    } else {
      ASSERT_NO_FATAL_FAILURE(reset());
    }
    steps(20);
    EXPECT_NEAR(shift(), left, 1e-9) << time;
  }
  ASSERT_NO_FATAL_FAILURE(expect_rest_of_whole());
}

// Nobody has kept what the part was begun with: it is what a cycle start would begin with, and the operator says whether that is right.
TEST_F(CoordinatesLeft, AreAnEntryToBeConfirmedWhereTheBeginningIsNotKnown) {
  ASSERT_NO_FATAL_FAILURE(stop_in(kShifted));
  ASSERT_EQ(find(RestartBy::kLine, 3), Answer::kDone);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  const RestartStatus now = restart();
  ASSERT_EQ(now.list.entries().size(), 1u);
  EXPECT_EQ(now.list.text(now.list.entries()[0]), "shift of the workpiece coordinates X-25 in force at the beginning");
  EXPECT_EQ(now.list.open(), 1u);
  EXPECT_EQ(start(), Answer::kRestartOpen);
  ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, 0), Answer::kDone);
  EXPECT_EQ(start(), Answer::kRestartAxes);
  ASSERT_NO_FATAL_FAILURE(reset());
  ASSERT_NO_FATAL_FAILURE(by_mdi("G92.1 X0 Y0\n"));
  ASSERT_NO_FATAL_FAILURE(select(kShifted));
  ASSERT_EQ(find(RestartBy::kLine, 3), Answer::kDone);
  ASSERT_TRUE(until([&] { return restart().phase == RestartPhase::kFound; })) << restart().text;
  EXPECT_TRUE(restart().list.entries().empty());
  ASSERT_NO_FATAL_FAILURE(expect_rest_of_whole());
}

// plc.mirror mirrors about where the axis stands when the program is begun. Where that is not known it is where the axis stands now, and only the operator knows whether the part was begun there.
class Mirrored : public CoordinatesLeft {
 protected:
  void stop_in_mirrored() {
    build("[signals]\n\"plc.mirror.X\" = \"in0\"\n");
    machine->hold(config.points.find("in0"), 1);
    steps(5);
    ASSERT_NO_FATAL_FAILURE(by_mdi("G53 G0 X-30. Y-10.\n"));
    ASSERT_NO_FATAL_FAILURE(select(kMirrored));
    ASSERT_EQ(start(), Answer::kDone);
    ASSERT_TRUE(until([&] { return out().source.line == 3 && out().velocity.v[0] != 0; }));
    steps(40);
    ASSERT_NO_FATAL_FAILURE(reset());
  }
  static constexpr const char* kMirrored = "G90 G54 G0 X5. Y5.\nG1 Y7. F1500.\nN30 X60. F1500.\nX30.\nM30\n";
};

TEST_F(Mirrored, APlaceByNumberSaysAboutWhatItIsMirrored) {
  ASSERT_NO_FATAL_FAILURE(stop_in_mirrored());
  ASSERT_EQ(find(RestartBy::kLastStop), Answer::kDone) << runtime->explain(Answer::kNoPlace);
  ASSERT_NO_FATAL_FAILURE(come_to_place());
  EXPECT_TRUE(restart().list.entries().empty());
  EXPECT_NEAR(restart().found.machine.v[0], -65, 1e-9) << "5 mirrored about -30";
  ASSERT_NO_FATAL_FAILURE(reset());
  for (const RestartBy by : {RestartBy::kLine, RestartBy::kSequence, RestartBy::kBlock}) {
    ASSERT_EQ(find(by, by == RestartBy::kLine ? 3 : by == RestartBy::kSequence ? 30 : 2), Answer::kDone);
    ASSERT_NO_FATAL_FAILURE(come_to_place());
    const RestartStatus now = restart();
    ASSERT_EQ(now.list.entries().size(), 1u);
    char text[120];
    std::snprintf(text, sizeof text, "mirror image by the machine about X%.10g, where the axis stands now", out().command.v[0]);
    EXPECT_EQ(now.list.text(now.list.entries()[0]), text);
    EXPECT_EQ(start(), Answer::kRestartOpen);
    ASSERT_NO_FATAL_FAILURE(reset());
  }
}

// The switch is not where it was in the run.
TEST_F(Mirrored, AStopOfARunThatWasMirroredOtherwiseIsSaid) {
  ASSERT_NO_FATAL_FAILURE(stop_in_mirrored());
  machine->hold(config.points.find("in0"), 0);
  steps(5);
  EXPECT_EQ(find(RestartBy::kLastStop), Answer::kNoPlace);
  EXPECT_NE(runtime->explain(Answer::kNoPlace).find("mirror"), std::string::npos) << runtime->explain(Answer::kNoPlace);
  machine->hold(config.points.find("in0"), 1);
  steps(5);
  ASSERT_EQ(find(RestartBy::kLastStop), Answer::kDone) << runtime->explain(Answer::kNoPlace);
}

}  // namespace
