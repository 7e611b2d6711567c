// SPDX-License-Identifier: Apache-2.0
// Programs that change tools, and are stopped at any moment by a reset or by a power failure, also amid a tool change and while FIN does not come: begun inside at the stop, they cut with the tool of the program, give
// out every code that is still to come, and repeat none but those of the block that was stopped.
#include <map>
#include <random>

#include "restart_fixture.hpp"
#include "support/seeds.hpp"

namespace {

using namespace nc::test::inside;

class RestartTools : public Restart {
 protected:
  unsigned below(unsigned n) { return static_cast<unsigned>(random() % n); }

  // Cuts in blocks of their own, which know their tool.
  std::string program() {
    std::string text = "G90 G54 G21 F6000.\n";
    unsigned line = 1, tool = 0;
    const auto add = [&](const std::string& block) {
      text += block + "\n";
      ++line;
    };
    tool_of_.clear();
    codes_of_.clear();
    for (unsigned part = 2 + below(3); part > 0; --part) {
      const unsigned next = 1 + below(6);
      if (below(2) == 0) add("T" + std::to_string(next) + " M6"), codes_of_[line] = 2;
      else {
        add("T" + std::to_string(next)), codes_of_[line] = 1;
        add("G1 X" + std::to_string(below(20)) + ".5"), tool_of_[line] = tool;
        add("M6"), codes_of_[line] = 1;
      }
      tool = next;
      add("S" + std::to_string(300 + below(900)) + " M3"), codes_of_[line] = 2;
      if (below(2) == 0) add("M8"), codes_of_[line] = 1;
      for (unsigned cut = 1 + below(4); cut > 0; --cut) {
        add("G1 X" + std::to_string(below(40)) + ". Y" + std::to_string(below(40)) + ". Z-" + std::to_string(below(9)) + "."), tool_of_[line] = tool;
        if (below(3) == 0) add("G91 G1 X3. Y-2."), tool_of_[line] = tool, add("G90");
      }
      add("G0 Z20.");
      if (below(3) == 0) add("M9"), codes_of_[line] = 1;
    }
    add("G1 X41. Y-3. Z21."), tool_of_[line] = tool;
    add("M5"), codes_of_[line] = 1;
    return text + "M30\n";
  }

  // The supply has said that it fails, and is back: a reset acknowledges that.
  void power_fails() {
    const int supply = config.points.find("supply");
    machine->hold(supply, 0);
    ASSERT_TRUE(until([&] { return runtime->snapshot().alarmed() && out().distance_zero; }, 3000));
    steps(static_cast<int>(below(300)));
    machine->hold(supply, 1);
    steps(100);
  }
  // One scan, whose strobes are counted and whose tool is that of the block in execution.
  void scan() {
    runtime->step();
    const nc_outputs now = out();
    const unsigned risen = now.strobe & ~strobe_;
    strobe_ = now.strobe;
    for (unsigned group = 0; group < 3; ++group) {
      if ((risen >> group & 1u) != 0) given_.push_back(group == 0 ? "M" + std::to_string(now.m) : group == 1 ? "S" : "T" + std::to_string(now.t));
    }
    const auto found = tool_of_.find(now.source.line);
    if (now.state != NC_STATE_RUNNING || runtime->snapshot().mode != Mode::kAuto || now.distance_zero || found == tool_of_.end() || found->second == 0) return;
    ++cut_;
    ASSERT_EQ(machine->sim.tool(0), found->second) << "line " << found->first << " cuts with the wrong tool";
  }
  bool run_to_end(unsigned most = 100000) {
    const std::uint64_t runs = runtime->info().system[0].runs;
    for (unsigned n = 0; n < most && !HasFatalFailure(); ++n) {
      if (runtime->info().system[0].runs != runs || runtime->snapshot().alarmed()) break;
      scan();
    }
    return runtime->info().system[0].runs != runs && !runtime->snapshot().alarmed();
  }
  // The operator works through the list, gives out what is open, one after the other, or in one go, and sometimes tries to start too soon.
  void recover() {
    for (int times = 0; times < 20; ++times) {
      std::string next;
      const RestartStatus now = restart();
      unsigned entry = 0;
      for (const RecoveryEntry& each : now.list.entries()) {
        if (each.state != RecoveryEntry::State::kOpen) continue;
        next = now.list.text(each);
        entry = static_cast<unsigned>(&each - now.list.entries().data()) + 1;
        break;
      }
      if (next.empty()) return;
      if (below(3) == 0) {
        ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
        ASSERT_EQ(start(), Answer::kRestartOpen) << next;
      }
      const bool code = next[0] == 'T' || next[0] == 'S' || next[0] == 'M';
      if (code && next.find(' ') == std::string::npos) {
        ASSERT_NO_FATAL_FAILURE(mdi(next + "\n")) << next;
      } else {
        ASSERT_EQ(runtime->execute(CommandKind::kConfirmRestart, 0, entry), Answer::kDone) << next;
        steps(5);
      }
    }
    FAIL() << "the list does not come to its end";
  }
  void lead_back() {
    ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
    unsigned order[3] = {0, 1, 2};
    std::shuffle(order, order + 3, random);
    for (const unsigned axis : order) ASSERT_NO_FATAL_FAILURE(approach(axis));
    ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
  }

  // Cuts with two tools whose lengths act, behind each of which the next one is called.
  std::string part_with_lengths() {
    std::string text = "G90 G54 G21 F3000.\nG0 X2. Y3.\n";  // by its line a place counts from where the axes stand
    for (unsigned tool = 1; tool <= 2; ++tool) {
      const std::string number = std::to_string(tool);
      text += "T" + number + " M6\nS900 M3\nG43 H" + number + " Z15.\n";
      for (unsigned cut = 3 + below(4); cut > 0; --cut) {
        const std::string x = std::to_string(below(40)), y = std::to_string(below(40));
        if (below(4) == 0) text += "G91 G1 X3. Z-1.\nG90\n";
        else if (below(3) == 0) text += "G2 X" + x + ".3 Y" + y + ".2 R60.\n";
        else text += "G1 X" + x + ". Y" + y + ". Z-" + std::to_string(below(9)) + ".\n";
      }
      text += "G0 Z20.\n";
    }
    return text + "G49 Z30.\nM5\nM30\n";
  }
  void begin_part(const std::string& text, double length) {
    ASSERT_NO_FATAL_FAILURE(build("[tool_offsets]\n1 = { length = " + std::to_string(length) + " }\n2 = { length = 22.0 }\n"));
    ASSERT_NO_FATAL_FAILURE(select(text));
    ASSERT_EQ(start(), Answer::kDone);
  }
  // Blocks of MDI where no program is interrupted.
  void mdi_alone(const std::string& blocks) {
    ASSERT_EQ(mode(Mode::kMdi), Answer::kDone);
    ASSERT_EQ(runtime->load_mdi(blocks), Answer::kDone) << runtime->explain(Answer::kRefusedByControl);
    const std::uint64_t runs = runtime->info().system[0].runs;
    ASSERT_EQ(start(), Answer::kDone);
    ASSERT_TRUE(until([&] { return out().state == NC_STATE_IDLE && runtime->info().system[0].runs != runs; }, 20000));
    steps(3);
  }
  void jog_away(unsigned axis, double velocity, int scans) {
    Command jog;
    jog.kind = CommandKind::kJog;
    jog.axis = static_cast<std::uint8_t>(axis);
    jog.value = velocity;
    for (int n = 0; n < scans; n += 50) {
      ASSERT_EQ(runtime->execute(jog), Answer::kDone);
      steps(50);
    }
    ASSERT_NO_FATAL_FAILURE(let_go(axis));
    ASSERT_TRUE(until([&] { return out().distance_zero; }, 2000));
  }

  std::mt19937_64 random;
  std::map<std::uint32_t, unsigned> tool_of_, codes_of_;  // by line
  std::vector<std::string> given_;
  unsigned strobe_ = 0;
  std::uint64_t cut_ = 0, inside_ = 0, cuts_ = 0;
};

constexpr const char* kSupply =
    "[[point]]\nname = \"supply\"\ndirection = \"input\"\ninitial = 1\n[signals]\n\"plc.power_fail_n\" = \"supply\"\n[power]\nsettle_s = 0.05\n";

TEST_F(RestartTools, NoCodeIsLostAndNothingIsCutWithTheWrongTool) {
  const std::uint64_t first = nc::test::wish("NC_FIRST_SEED", 1), seeds = nc::test::seeds(30, 5);
  for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    random.seed(seed);
    ASSERT_NO_FATAL_FAILURE(build());
    const std::string text = program();
    SCOPED_TRACE(text);
    ASSERT_NO_FATAL_FAILURE(select(text));
    given_.clear();
    ASSERT_EQ(start(), Answer::kDone);
    const std::uint64_t begun = runtime->snapshot().scan;
    ASSERT_TRUE(run_to_end());
    const std::vector<std::string> all = given_;
    const nc_axes end = out().command;
    const auto length = static_cast<unsigned>(runtime->snapshot().scan - begun);
    // The same once more from where it was begun, and stopped.
    const bool power = below(3) == 0;
    ASSERT_NO_FATAL_FAILURE(build(power ? kSupply : ""));
    ASSERT_NO_FATAL_FAILURE(select(text));
    given_.clear();
    strobe_ = 0;
    ASSERT_EQ(start(), Answer::kDone);
    const unsigned stop = 1 + below(length - 20);
    for (unsigned n = 0; n < stop && !HasFatalFailure(); ++n) {
      if (below(400) == 0) machine->sim.hold_fin(below(2) == 0);
      scan();
    }
    ASSERT_FALSE(HasFatalFailure());
    machine->sim.hold_fin(false);
    if (out().state == NC_STATE_IDLE) continue;
    const std::vector<std::string> before = given_;
    if (power) {
      ASSERT_NO_FATAL_FAILURE(power_fails());
      ++cuts_;
    }
    ASSERT_NO_FATAL_FAILURE(reset());
    const Answer found = find(power ? RestartBy::kPowerOff : RestartBy::kLastStop);
    ASSERT_EQ(found, Answer::kDone) << restart().text;
    ASSERT_NO_FATAL_FAILURE(come_to_place());
    ASSERT_NO_FATAL_FAILURE(recover());
    ASSERT_NO_FATAL_FAILURE(lead_back());
    given_.clear();
    strobe_ = out().strobe;
    ASSERT_EQ(start(), Answer::kDone) << restart().text;
    ++inside_;
    ASSERT_TRUE(run_to_end()) << restart().text;
    for (unsigned a = 0; a < 3; ++a) EXPECT_NEAR(out().command.v[a], end.v[a], 1e-6) << a;
    ASSERT_LE(given_.size(), all.size());
    EXPECT_TRUE(std::equal(given_.rbegin(), given_.rend(), all.rbegin())) << "other codes than those of the rest of the program";
    EXPECT_GE(before.size() + given_.size(), all.size()) << "codes are lost";
    EXPECT_LE(before.size() + given_.size(), all.size() + 2) << "codes of blocks that were done are given out once more";
  }
  std::printf("%llu begun inside, %llu behind a power failure, %llu scans cut\n", static_cast<unsigned long long>(inside_), static_cast<unsigned long long>(cuts_), static_cast<unsigned long long>(cut_));
  EXPECT_GT(inside_, seeds / 2);
}

// The whole of it as an operator does it: hold in the cut, out of the part by hand, reset, another tool of the same number with another length, back to the block and on. What is cut then is what the
// whole program cuts with the new length. The hold is behind the first block that leads Z: an axis that no block has named yet is where it stands.
TEST_F(RestartTools, BehindABrokenToolThePartIsThatOfTheNewLength) {
  const std::uint64_t first = nc::test::wish("NC_FIRST_SEED", 1), seeds = nc::test::seeds(6, 2);
  for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    random.seed(seed);
    const std::string text = part_with_lengths();
    SCOPED_TRACE(text);
    const double before = 20, after = before + below(2000) / 1000.0 - 1;
    ASSERT_NO_FATAL_FAILURE(begin_part(text, after));
    ASSERT_TRUE(to_end());
    const std::vector<nc_axes> whole = machine->path;
    ASSERT_NO_FATAL_FAILURE(begin_part(text, before));
    ASSERT_TRUE(until([&] { return out().source.line == 6; }, 20000));
    steps(static_cast<int>(below(2500)));
    const std::uint32_t line = out().source.line;
    ASSERT_EQ(runtime->execute(CommandKind::kFeedHold), Answer::kDone);
    ASSERT_TRUE(until([&] { return out().distance_zero && out().state != NC_STATE_RUNNING; }, 5000));
    if (out().state == NC_STATE_IDLE) continue;
    ASSERT_EQ(mode(Mode::kManual), Answer::kDone);
    ASSERT_NO_FATAL_FAILURE(jog_away(2, 40, 500));
    ASSERT_NO_FATAL_FAILURE(jog_away(below(2), below(2) == 0 ? 30 : -30, 300));
    ASSERT_NO_FATAL_FAILURE(reset());
    char length[40];
    std::snprintf(length, sizeof length, "G10 L10 P1 R%.3f\n", after);
    ASSERT_NO_FATAL_FAILURE(mdi_alone(length));
    if (below(2) == 0) {
      ASSERT_NO_FATAL_FAILURE(mdi_alone("T1 M6\n"));
    }
    ASSERT_NO_FATAL_FAILURE(reset());
    ASSERT_EQ(mode(Mode::kAuto), Answer::kDone);
    const Answer found = below(2) == 0 ? find(RestartBy::kLastStop) : find(RestartBy::kLine, line);
    ASSERT_EQ(found, Answer::kDone) << restart().text;
    ASSERT_NO_FATAL_FAILURE(come_to_place());
    EXPECT_EQ(start(), Answer::kRestartOpen) << "the spindle stands";
    ASSERT_NO_FATAL_FAILURE(recover());
    ASSERT_NO_FATAL_FAILURE(lead_back());
    machine->path.clear();
    ASSERT_EQ(start(), Answer::kDone) << restart().text;
    ++inside_;
    ASSERT_TRUE(to_end()) << restart().text;
    EXPECT_LE(most_beside(whole, machine->path), kChord);
    for (unsigned a = 0; a < 3; ++a) EXPECT_NEAR(out().command.v[a], whole.back().v[a], 1e-6) << a;
  }
  EXPECT_GT(inside_, seeds / 2);
}

}  // namespace
