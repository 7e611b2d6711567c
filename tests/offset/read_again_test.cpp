// SPDX-License-Identifier: Apache-2.0
// Compensated contours that are read again from the end of a block, as after a recalculation: the same path, the same alarms.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/pull.hpp"

namespace nc::test {
namespace {

using Setting = std::vector<std::pair<const char*, const char*>>;

/// Goes back to every mark that can be gone back to, and compares what comes then. Returns how many that were. P153 may come in an earlier block: in
/// doubt about a way out (CONTOUR_CHECK) the second reading knows from the start what the first one has found some blocks later.
unsigned reads_again(const std::string& text, const Setting& setting = {}) {
  SCOPED_TRACE(text);
  Bench bench;
  for (const auto& [name, value] : setting) bench.param(name, value);
  const Outcome run = bench.run(text);
  unsigned marks = 0;
  for (const Step& step : run.steps) {
    if (step.item.kind != NC_ITEM_MARK || !step.item.u.mark.report) continue;
    if (bench.rewind(step.item.serial, step.machine) != NC_OK) continue;
    ++marks;
    const Outcome rest = bench.finish();
    EXPECT_EQ(rest.status, run.status) << "from line " << step.item.source.line << " with " << run.alarm;
    EXPECT_EQ(rest.alarm, run.alarm) << "from line " << step.item.source.line;
    const bool earlier = run.alarm == "P153" && rest.alarm_line < run.alarm_line;
    if (!earlier) {
      EXPECT_EQ(rest.alarm_line, run.alarm_line) << "from line " << step.item.source.line;
      EXPECT_EQ(rest.steps.size(), run.steps.size() - step.item.serial) << "from line " << step.item.source.line;
    }
    for (size_t i = 0; i + (earlier ? 2 : 0) < rest.steps.size() && step.item.serial + i < run.steps.size(); ++i)
      if (exactly(rest.steps[i]) != exactly(run.steps[step.item.serial + i])) {
        ADD_FAILURE() << "from line " << step.item.source.line << "\n" << exactly(rest.steps[i]) << "\n" << exactly(run.steps[step.item.serial + i]);
        break;
      }
    if (testing::Test::HasFailure()) return marks;
  }
  return marks;
}

TEST(ReadAgain, AnArcBehindAChangeOfSideLosesItsFullTurn) {
  EXPECT_GE(reads_again("G90 G94\nG10 L10 P1 R5.\nG1 F1000\nG42 D1 Y38.475\nY-0.841\nG41\nG3 I-8.186 J8.664\nG1 Y30.\nG40 X50.\nM30"), 8u);
}

TEST(ReadAgain, AVectorOfIJKMayLieAnywhere) {
  EXPECT_GE(reads_again("G18 G90 G94\nG10 L10 P1 R5.\nG1 F1000 D1\nG42 X17.407 K-3.239\nX17.408\nG3 Z-9.601 R29.771\nG1 G40 X60.\nM30"), 6u);
}

TEST(ReadAgain, AVectorThatG38Holds) {
  EXPECT_GE(reads_again("G90 G94\nG10 L10 P1 R5.\nF1000\nG42 D1\nG1 X18.400 Y-25.350 G38\nY-25.351\nG2 X23.501 R-21.432\nG1 X60.\nG40 Y0\nM30"), 7u);
  EXPECT_GE(reads_again("G90 G94\nG10 L10 P1 R5.\nF1000\nG42 D1\nG1 X18.400 Y-25.350\nG38 X30. Y-25.350\nY-25.351\nG2 X33.501 R-21.432\nG1 X60.\nG40 Y0\nM30"), 7u);
}

TEST(ReadAgain, ALineOfAMicrometreBack) {
  EXPECT_GE(reads_again("G90 G94 G1\nG10 L10 P1 R3.\nF1000\nG42 D1\nY6.934\nG2 Y23.587 J8.326\nY23.586\nG1 Y21.764\nG40 X20.\nM30", {{"8102", "1"}}), 5u);
}

TEST(ReadAgain, WhatIsInDoubtOfAWayIn) {
  const std::string circle = "G90 G94\nG10 L10 P1 R5.\nG1 F8000\nG41 D1 X0. Y0.\nY36.479\nG2 J-11.051\nG1 G40 Y60.\nM30";
  EXPECT_GE(reads_again(circle, {{"CONTOUR_CHECK", "1"}}), 4u);  // a whole turn closes at once, and leaves nothing in doubt
  EXPECT_GE(reads_again(circle, {{"CONTOUR_CHECK", "1"}, {"8102", "1"}}), 1u);
  // Back through the first block of a contour that does not close.
  const std::string open = "G90 G94\nG10 L10 P1 R5.\nG1 F8000\nG41 D1 X0. Y0.\nY60.\nX20.\nX40.\nX60.\nX80.\nY30.\nX60.\nX40.\nX20.\nX-40.\nY-40.\nG40 X-60.\nM30";
  EXPECT_GE(reads_again(open, {{"CONTOUR_CHECK", "1"}}), 7u);
  EXPECT_GE(reads_again(open, {{"CONTOUR_CHECK", "1"}, {"8102", "1"}}), 7u);
}

TEST(ReadAgain, BlocksThatAreLeftOut) {
  const std::string groove = "G90 G94\nG10 L10 P1 R20.\nG1 G41 X0 Y0 D1 F500\nX20. Y-40.\nX50. Y-100.\nX70.\nX120. Y0\nX150.\nG40 Y50.\nM30";
  const Outcome run = Bench().param("8102", "1").run(groove);
  EXPECT_EQ(run.alarm, "");
  // Not from the end of the block in front of the one that is left out: it is left out because of that block.
  EXPECT_EQ(reads_again(groove, {{"8102", "1"}}), run.lines().size() - 1);
}

/// A contour of anything.
std::string random_program(unsigned seed) {
  std::mt19937 random(seed);
  const auto real = [&random](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto chance = [&real](double share) { return real(0, 1) < share; };
  char line[160];
  std::string text = "G90 G94 G17\nG10 L10 P1 R5.\nG10 L10 P2 R4.\nG1 F1000\n";
  double x = 0, y = 0;
  const auto to = [&](double scale) {
    x += scale * real(-1, 1);
    y += scale * real(-1, 1);
    std::snprintf(line, sizeof line, "X%.3f Y%.3f", x, y);
    return std::string(line);
  };
  text += std::string(chance(0.5) ? "G41" : "G42") + " D1 " + (chance(0.8) ? to(40) : "") + "\n";
  const unsigned blocks = 3 + static_cast<unsigned>(real(0, 9));
  for (unsigned i = 0; i < blocks; ++i) {
    const double kind = real(0, 1), scale = chance(0.15) ? 2e-3 : chance(0.3) ? 6 : 40;
    if (kind < 0.5) {
      text += "G1 " + to(scale);
    } else if (kind < 0.75) {
      const double away = scale * real(0.6, 1.5);
      text += (chance(0.5) ? "G2 " : "G3 ") + to(scale * 0.4);
      std::snprintf(line, sizeof line, " R%.3f", away);
      text += line;
    } else if (kind < 0.8) {
      std::snprintf(line, sizeof line, "%s I%.3f J%.3f", chance(0.5) ? "G2" : "G3", real(-15, 15), real(-15, 15));
      text += line;
    } else if (kind < 0.84) {
      text += chance(0.5) ? "G41" : "G42";
    } else if (kind < 0.87) {
      std::snprintf(line, sizeof line, "G41 G1 %s I%.3f J%.3f", to(20).c_str(), real(-5, 5), real(-5, 5));
      text += line;
    } else if (kind < 0.89) {
      text += "G39 G1 " + to(20);
    } else if (kind < 0.91) {
      text += "G38 G1 " + to(20);
    } else if (kind < 0.94) {
      text += chance(0.5) ? "M8" : "#100=#100+1\nG4 P1";
    } else if (kind < 0.96) {
      text += "Z-" + std::to_string(i);
    } else if (kind < 0.98) {
      text += "D2";
    } else {
      text += "G53 G0 X0 Y0";
      x = y = 0;
    }
    text += "\n";
  }
  return text + "G1 G40 " + to(40) + "\n" + (chance(0.3) ? "G42 D2 G1 " + to(30) + "\n" + to(30) + "\nG40 " + to(20) + "\n" : "") + "M30";
}

TEST(ReadAgain, RandomContoursComeOutAsTheyDid) {
  unsigned marks = 0, alarms = 0;
  const char* const seeds = std::getenv("NC_SEEDS");
  const unsigned count = seeds != nullptr ? static_cast<unsigned>(std::atoi(seeds)) : 250;
  for (unsigned seed = 1; seed <= count && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Setting setting;
    if (seed % 2 == 0) setting.push_back({"CONTOUR_CHECK", "1"});
    if (seed % 3 == 0) setting.push_back({"8102", "1"});
    if (seed % 7 == 0) setting.push_back({"8103", "1"});
    const std::string text = random_program(seed);
    marks += reads_again(text, setting);
    alarms += m700(text).alarm.empty() ? 0 : 1;
  }
  EXPECT_GT(marks, count * 4);
  EXPECT_LT(alarms, count * 8 / 10);
}

}  // namespace
}  // namespace nc::test
