// SPDX-License-Identifier: Apache-2.0
// The events and hits of a setup act at the same blocks, with the same effects, whether the items are pulled (trace) or a machine executes
// them (motion): random programs with sub programs, blocks that take no time, syncs and skip moves, with random events.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "own_folder.hpp"
#include "support/seeds.hpp"
#include "tools/lib/machine_choice.hpp"
#include "tools/lib/offline_run.hpp"
#include "tools/lib/session.hpp"
#include "tools/lib/virtual_machine.hpp"

namespace nc::tools {
namespace {

class Maker {
 public:
  explicit Maker(uint32_t seed) : random_(seed) {}

  // Sub programs are in the file of the main program. Each value that is read becomes a digit of #500 in base 3; each probed place goes into
  // #501.
  std::string program() {
    lines_ = {"G90 G21 G94 F3000", "#500=0", "#501=0", "G0 X0 Y0"};
    const int main = number(6, 14);
    for (int i = 0; i < main; ++i) block(true);
    lines_.push_back("M30");
    main_lines_ = static_cast<int>(lines_.size());
    for (int sub = 1; sub <= kSubs; ++sub) {
      lines_.push_back("O" + std::to_string(sub));
      const int count = number(1, 4);
      for (int i = 0; i < count; ++i) block(false);
      if (sub < kSubs && number(0, 2) == 0) lines_.push_back("M98 P" + std::to_string(sub + 1));
      lines_.push_back("M99");
    }
    std::string text;
    for (const std::string& line : lines_) text += line + "\n";
    return text;
  }

  std::string setup() {
    std::string text = R"({"hits": [)";
    for (int i = number(0, 3); i > 0; --i) text += std::string(number(0, 2) == 0 ? "null" : R"({"at": {"Z": -)" + std::to_string(number(0, 5)) + "}}") + (i > 1 ? "," : "");
    text += R"(], "events": [)";
    const int events = number(1, 6);
    for (int i = 0; i < events; ++i) text += (i ? "," : "") + event();
    return text + "]}";
  }

 private:
  static constexpr int kSubs = 3;
  int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }

  void block(bool main) {
    switch (number(0, 10)) {
      case 0: lines_.push_back("G91 G1 X" + std::to_string(number(1, 9) * 0.1)); break;
      case 1: lines_.push_back("G91 G1 X" + std::to_string(number(1, 40) * 0.001)); break;  // shorter than a cycle
      case 2: lines_.push_back("G4 P" + std::to_string(number(1, 20))); break;
      case 3: lines_.push_back("M" + std::to_string(number(20, 23))); break;
      case 4:
      case 5: lines_.push_back("#510=#510+1"); break;  // no time
      case 6: lines_.push_back("G17"); break;
      case 7:
      case 8: read(); break;
      case 9: probe(); break;
      default:
        if (main) lines_.push_back("M98 P" + std::to_string(number(1, kSubs)) + (number(0, 3) == 0 ? " L2" : ""));
        else read();
    }
  }
  void read() { lines_.push_back("#500=#500*3+#100" + std::to_string(number(0, 1)) + "+#1002*0.5"); }
  void probe() {
    lines_.push_back("G90 G31 Z-5. F600");
    lines_.push_back("#501=#501*2+#5063");
    lines_.push_back("G90 G0 Z0");
  }
  std::string event() {
    std::string text = R"({"when": {)";
    const int kind = number(0, 5);
    const int line = number(4, static_cast<int>(lines_.size()));
    if (kind == 0) {
      text += R"("m": )" + std::to_string(number(20, 23));
    } else if (kind <= 3 || line <= main_lines_) {
      text += R"("line": )" + std::to_string(number(4, main_lines_));
    } else {
      const auto head = std::find_if(lines_.rend() - line, lines_.rend(), [](const std::string& l) { return l[0] == 'O'; });
      text += R"("line": )" + std::to_string(line) + R"(, "program": )" + head->substr(1);
    }
    text += "}";
    switch (number(0, 8)) {
      case 0: text += R"(, "signals": {"skip": )" + std::to_string(number(0, 1)) + "}"; break;
      case 1: text += number(0, 2) == 0 ? R"(, "signals": {"reset": 1})" : R"(, "signals": {"feed_hold": 1})"; break;
      default: text += R"(, "inputs": {"100)" + std::to_string(number(0, 2)) + R"(": )" + std::to_string(number(0, 1)) + "}"; break;
    }
    return text + "}";
  }

  std::mt19937 random_;
  std::vector<std::string> lines_;
  int main_lines_ = 0;
};

struct Effect {
  bool ran = false;
  std::map<uint32_t, double> variables;
  nc_axes end = {};
  std::vector<std::string> unused;
  std::string error;
};

std::map<uint32_t, double> variables_of(const nc_control* control) {
  std::map<uint32_t, double> all;
  uint32_t number = 0;
  double value = 0;
  for (uint32_t from = 0; nc_variable_next(control, kPartSystem, from, &number, &value) == NC_OK; from = number + 1) all[number] = value;
  return all;
}

class EventProperty : public OwnFolder {
 protected:
  void SetUp() override {
    OwnFolder::SetUp();
    options_.program = folder_ + "/p.nc";
    options_.setup = folder_ + "/s.json";
  }
  void write(const std::string& program, const std::string& setup) const {
    std::ofstream(options_.program) << program;
    std::ofstream(options_.setup) << setup;
  }

  Effect pulled() const {
    Effect effect;
    Session session;
    if (!session.configure(options_, &effect.error) || !session.start(options_, &effect.error)) return effect;
    ControlSource items(session.control(), session.dialect());
    VirtualWorld world(session.setup(), session.config().system[0]);
    RunSink sink;
    const RunResult result = run_offline(&items, &world, &sink, session.decides(), 0);
    effect.ran = result.how == RunResult::How::kEnded || result.how == RunResult::How::kReset;
    effect.error = result.error + result.alarm.code;
    effect.variables = variables_of(session.control());
    effect.end = world.machine();
    effect.unused = world.unused();
    return effect;
  }
  Effect driven(bool optimal) const {
    Effect effect;
    Session session;
    if (!session.configure(options_, &effect.error)) return effect;
    MachineOptions machine;
    if (optimal) machine.tolerance = 0.01;
    if (!set_machine_limits(machine, nullptr, &session.config(), &effect.error) || !session.start(options_, &effect.error)) return effect;
    const MachineResult result = run_machine(session.control(), session.config(), session.setup(), session.decides(), 1000, LoopLimits(), [&](const nc_outputs& out) {
      effect.end = out.command;
      return true;
    });
    effect.ran = result.how == MachineResult::How::kEnded;
    effect.error = result.error + result.alarm.code;
    nc_feed(session.control(), 100);  // so that the feeder sees the end, or a reset
    effect.variables = variables_of(session.control());
    effect.unused = result.unused;
    return effect;
  }

  SessionOptions options_;
};

TEST_F(EventProperty, TraceAndMotionFireTheSameEventsWithTheSameEffects) {
  unsigned fired = 0, probed = 0;
  const uint64_t count = nc::test::seeds(40, 8);
  for (uint32_t seed = 1; seed <= count; ++seed) {
    Maker maker(seed);
    const std::string program = maker.program(), setup = maker.setup();
    write(program, setup);
    const Effect trace = pulled();
    ASSERT_TRUE(trace.ran) << trace.error << "\n" << program << setup;
    for (const bool optimal : {false, true}) {
      const Effect motion = driven(optimal);
      const std::string what = "seed " + std::to_string(seed) + (optimal ? " optimal\n" : "\n") + program + setup;
      ASSERT_TRUE(motion.ran) << motion.error << "\n" << what;
      ASSERT_EQ(trace.unused, motion.unused) << what;
      for (const auto& [number, value] : trace.variables) {
        ASSERT_TRUE(motion.variables.count(number)) << number << "\n" << what;
        // A touch is seen in the cycle in which it comes: at 10 mm/s and 1 ms that is 0.01 mm, which #501 doubles with each touch.
        ASSERT_NEAR(motion.variables.at(number), value, number == 501 ? 1.0 : 1e-9) << number << "\n" << what;
      }
      for (int axis = 0; axis < 2; ++axis) ASSERT_NEAR(motion.end.v[axis], trace.end.v[axis], 1e-6) << what;
      ASSERT_NEAR(motion.end.v[2], trace.end.v[2], 0.3) << what;  // after a touch the axes have braked before a reset
    }
    fired += trace.unused.empty() ? 1 : 0;
    probed += trace.variables.count(501) && trace.variables.at(501) != 0 ? 1 : 0;
  }
  EXPECT_GE(fired, count / 8);
  EXPECT_GE(probed, count / 8);
}

// The two cases for which the random programs were written: an event at the line of an M99, and two blocks without time before a sync.
TEST_F(EventProperty, OfALineThatReturnsAndOfBlocksWithoutTime) {
  const std::string program = "G91 G1 X1. F3000\nM98 P1\n#100=#1000\nM98 P1\n#110=1\n#111=1\n#101=#1001\nGOTO 20\nN10 M98 P1\nM30\nN20 #112=1\nGOTO 10\nO1\nG1 X1.\n#102=#1002\nM99\n";
  for (const char* when : {R"("line": 16, "program": 1)", R"("line": 5)", R"("line": 6)", R"("line": 2)", R"("line": 9)"}) {
    write(program, std::string(R"({"events": [{"when": {)") + when + R"(}, "inputs": {"1000": 1, "1001": 1, "1002": 1}}]})");
    const Effect trace = pulled(), motion = driven(false);
    ASSERT_TRUE(trace.ran && motion.ran) << trace.error << motion.error;
    EXPECT_TRUE(trace.unused.empty()) << when;
    EXPECT_TRUE(motion.unused.empty()) << when;
    EXPECT_EQ(trace.variables, motion.variables) << when;
    EXPECT_EQ(motion.variables.at(102), 1) << when;  // each of these events comes before the last call
  }
  write(program, R"({"events": [{"when": {"line": 9}, "inputs": {"1002": 1}}, {"when": {"line": 10}, "inputs": {"1002": 0}}]})");
  EXPECT_EQ(pulled().variables.at(102), 1) << "line 9 is the one that calls, though a jump has come to it";
  EXPECT_EQ(driven(false).variables.at(102), 1);
}

// M700 13.12: the signal acts within the cycle in which the line begins.
TEST_F(EventProperty, AMacroInterruptComesInBoth) {
  write("G91\nM96 P9\nG1 X20. F3000\nX20.\nX20.\nM97\nM30\nO9\n#100=#100+1\nM99\n",
        R"({"events": [{"when": {"line": 4}, "signals": {"macro_interrupt": 1}}]})");
  const Effect trace = pulled(), motion = driven(false);
  ASSERT_TRUE(trace.ran && motion.ran) << trace.error << motion.error;
  EXPECT_EQ(trace.variables.at(100), 1);
  EXPECT_EQ(trace.variables, motion.variables);
  EXPECT_NEAR(motion.end.v[0], trace.end.v[0], 1e-6);
}

// M700 13.12, type 1: the tool stops at once, and a dwell is interrupted; without a move in the interrupt program they go on from there.
TEST_F(EventProperty, AnEventAtATimeComesInTheMiddleOfABlock) {
  const std::string main = "G1 F600\nM96 P9\nG2 X20. I10.\nG4 P2000\nG1 X30.\n#110=#3001\nM97\nM30\n";
  const std::string pulses =
      R"({"clock": "1970-01-01T00:00:00", "events": [{"when": {"seconds": 1}, "signals": {"macro_interrupt": 1}}, {"when": {"seconds": 1.1}, "signals": {"macro_interrupt": 0}},
        {"when": {"seconds": 2}, "signals": {"macro_interrupt": 1}}, {"when": {"seconds": 2.1}, "signals": {"macro_interrupt": 0}},
        {"when": {"seconds": 4}, "signals": {"macro_interrupt": 1}}]})";
  write(main + "O9\n#100=#100+1\n#[100+#100]=#5041\nM99\n", pulses);
  const Effect goes_on = pulled();
  ASSERT_TRUE(goes_on.ran) << goes_on.error;
  EXPECT_EQ(goes_on.variables.at(100), 3);
  EXPECT_NEAR(goes_on.variables.at(101), 10 - 10 * std::cos(1), 1e-3);
  EXPECT_NEAR(goes_on.variables.at(102), 10 - 10 * std::cos(2), 1e-3);
  EXPECT_NEAR(goes_on.variables.at(103), 20, 1e-9);
  EXPECT_NEAR(goes_on.variables.at(110), 1000 * (M_PI + 2 + 1), 2) << "nothing has been executed twice";
  EXPECT_NEAR(goes_on.end.v[0], 30, 1e-9);
  write(main + "O9\nG91 G1 Z5.\nG90 M99\n", pulses);
  const Effect lost = pulled();
  ASSERT_TRUE(lost.ran) << lost.error;
  EXPECT_NEAR(lost.end.v[1], 10 * std::sin(1), 1e-3) << "the rest of the arc is lost";
  write(main + "O9\nM99\n", R"({"events": [{"when": {"seconds": 1}, "signals": {"reset": 1}}]})");
  const Effect reset = pulled();
  EXPECT_NEAR(reset.end.v[1], 10 * std::sin(1), 1e-3) << reset.error;
}

// The item at which a reset comes is not executed, and nothing behind it is read.
TEST_F(EventProperty, AResetLeavesTheAxesAtTheEndOfTheBlockBefore) {
  write("G91\nG1 X5. F3000\nX5.\n#100=1\nX5.\nM30\n", R"({"events": [{"when": {"line": 3}, "signals": {"reset": 1}}]})");
  for (const bool optimal : {false, true}) {
    const Effect motion = driven(optimal);
    ASSERT_TRUE(motion.ran) << motion.error;
    EXPECT_NEAR(motion.end.v[0], 5, 1e-9);
    EXPECT_EQ(motion.variables.count(100), 0u);
  }
  EXPECT_NEAR(pulled().end.v[0], 5, 1e-9);
}

// docs/trace.md: the move ends at the place of the hit, within the distance of one cycle.
TEST_F(EventProperty, AHitEndsTheMoveWhereItIs) {
  write("G31 Z-10. F600\n#100=#5063\nG0 Z0\nG31 Z-10. F600\n#101=#5063\nG0 Z0\nG31 Z-10. F600\n#102=#5063\nM30\n",
        R"({"hits": [{"at": {"Z": -3.0205}}, null, {"at": {"Z": -10}}]})");
  for (const bool optimal : {false, true}) {
    const Effect motion = driven(optimal);
    ASSERT_TRUE(motion.ran) << motion.error;
    EXPECT_TRUE(motion.unused.empty());
    EXPECT_NEAR(motion.variables.at(100), -3.0205, 0.0101);
    EXPECT_NEAR(motion.variables.at(101), -10, 1e-9);
    EXPECT_NEAR(motion.variables.at(102), -10, 0.0101);
  }
}

}  // namespace
}  // namespace nc::tools
