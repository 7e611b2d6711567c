// SPDX-License-Identifier: Apache-2.0
// Axes are moved by hand in a block stop, with MDI blocks and resets in between, under every map and at every curve: the program goes on from
// where the axes really are, or is refused with an alarm. No axis ever gets a larger step than it can do in one cycle.
#include <gtest/gtest.h>

#include <random>

#include "support/seeds.hpp"
#include "support/watched_machine.hpp"

namespace nc::test {
namespace {

class HandMachine : public WatchedMachine {
 public:
  explicit HandMachine(bool optimal, double x = 20) : WatchedMachine(NC_DIALECT_M700, "XYZc", {100, 100, 100, 360}, optimal, 20) {
    bench.param("1516", "C").param("8025", "1").param("1084", "0.1").tool(4, 1.5).at(x, 0, 0);
  }
  bool until_stop() {
    for (unsigned n = 0; n < 200000; ++n) {
      step();
      if (n > 15 && (drive->out.state == NC_STATE_STOPPED || drive->out.state == NC_STATE_IDLE || drive->out.state == NC_STATE_ALARM)) return true;
    }
    return false;
  }
  /// Moves an axis by hand, by a distance of `by`.
  void move(unsigned axis, double by) {
    drive->in.manual[axis] = {NC_MANUAL_STEP, 0, by};
    step();
    drive->in.manual[axis] = {};
    const unsigned settle = static_cast<unsigned>(std::fabs(by) / (axis < 3 ? 100 : 360) / kCycle) + 400;
    step(settle);
  }
  double at(unsigned axis) const { return drive->out.command.v[axis]; }
};

class ByHand : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(BothLaws, ByHand, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

TEST_P(ByHand, AcrossThePoleOfG12) {
  HandMachine m(GetParam());
  m.start("G12.1\nG1 X9. Y0 F3000\nX9. Y1.\nX5. Y5.\nG13.1\nM30");
  for (unsigned block = 0; block < 4; ++block) {
    ASSERT_TRUE(m.until_stop());
    if (std::fabs(m.at(0) - 9) < 0.01) break;
    m.press();
  }
  ASSERT_NEAR(m.at(0), 9, 0.01);
  m.move(0, -17.9);
  ASSERT_NEAR(m.at(0), -8.9, 0.01);
  m.press();
  ASSERT_TRUE(m.until_stop());
  EXPECT_LT(m.worst, 1.001) << "axis " << m.worst_axis << " line " << m.worst_line;
  if (m.drive->alarm().empty()) {
    EXPECT_LT(m.at(0), 0) << "on the side where the axis is";
    EXPECT_NEAR(std::fabs(m.at(0)), std::hypot(9, 1), 0.01);
  } else {
    EXPECT_EQ(m.drive->alarm(), "P486");
  }
}

// M700 12.4.4 (2): an absolute word leads to the programmed path at the end of the next block; an incremental one, or none, leaves the way by hand.
TEST_P(ByHand, UnderRadiusCompensationTheToolIsOnItsPathAtTheEndOfTheNextBlock) {
  struct {
    const char* next;
    double x, end;
  } const cases[] = {{"X0 Y60.", -3, -1.5}, {"X0 Y60.", -20, -1.5}, {"X0 Y60.", 3, -1.5}, {"G91 X0 Y60.", -3, -4.5}, {"Y60.", -3, -4.5}};
  const double beside = GetParam() ? 0.0101 : 1e-6;  // the optimal mode stops on the rounding of a corner, within the tolerance
  for (const auto& part : cases) {
    SCOPED_TRACE(std::string(part.next) + " moved by " + std::to_string(part.x));
    HandMachine m(GetParam());
    m.start("G90 G0 X0 Y-80.\nG41 D4 G1 X0 Y-60. F6000\nY-40.\nY0.\n" + std::string(part.next) + "\nG90 X-60.\nG40 X-60. Y0\nM30");
    for (unsigned block = 0; block < 4; ++block) {
      ASSERT_TRUE(m.until_stop());
      if (block < 3) m.press();
    }
    ASSERT_NEAR(m.at(0), -1.5, 0.01);
    ASSERT_NEAR(m.at(1), 0, 0.01);
    m.move(0, part.x);
    m.press();
    ASSERT_TRUE(m.until_stop());
    EXPECT_NEAR(m.at(0), part.end, beside);
    m.press();
    ASSERT_TRUE(m.until_stop());
    EXPECT_NEAR(m.at(1), 58.5, beside);
    EXPECT_EQ(m.drive->alarm(), "");
    EXPECT_LT(m.worst, 1.001);
  }
}

// An arc in absolute words that begins beside the path is not the programmed one, by R no less than about a centre: P70 before anything moves (M700 12.4.4, decisions 6.15).
// In increments it goes along with the way by hand as a whole, and led back the axes stand where the program has left them.
TEST_P(ByHand, ACompensatedArcFromBesideThePathIsNotTheProgrammedOne) {
  struct {
    const char* arc;
    bool back;
    std::string alarm;
  } const cases[] = {{"G3 X-20. Y20. R20.", false, "P70"}, {"G3 X-20. Y20. I-20. J0", false, "P70"}, {"G2 X20. Y20. R20.", false, "P70"},
      {"G91 G3 X-20. Y20. R20.", false, ""}, {"G91 G3 X-20. Y20. I-20. J0", false, ""}, {"G3 X-20. Y20. R20.", true, ""}};
  for (const auto& part : cases) {
    SCOPED_TRACE(std::string(part.arc) + (part.back ? " led back" : ""));
    HandMachine m(GetParam());
    m.start("G90 G0 X0 Y-80.\nG41 D4 G1 X0 Y-60. F6000\nY-40.\nY0.\n" + std::string(part.arc) + "\nG91 G1 X-20.\nG40 X-20.\nM30");
    for (unsigned block = 0; block < 4; ++block) {
      ASSERT_TRUE(m.until_stop());
      if (block < 3) m.press();
    }
    const nc_axes stopped = m.drive->out.command;
    m.move(0, -3);
    if (part.back) m.move(0, 3);
    const nc_axes moved = m.drive->out.command;
    ASSERT_NEAR(moved.v[0], stopped.v[0] - (part.back ? 0 : 3), 1e-9);
    m.press();
    ASSERT_TRUE(m.until_stop());
    EXPECT_EQ(m.drive->alarm(), part.alarm);
    if (!part.alarm.empty()) {
      EXPECT_NEAR(m.at(0), moved.v[0], 1e-6);
      EXPECT_NEAR(m.at(1), moved.v[1], 1e-6);
    }
    EXPECT_LT(m.worst, 1.001);
  }
}

// The time-optimal mode stops on the rounding of a corner, beside the end of the block by the tolerance at most. Whoever moves an axis by hand there, be it one that the arc behind does not
// name, or one that he brings back, has not moved the arc.
TEST_P(ByHand, AnArcBehindAStopOnARounding) {
  for (const char* arc : {"G3 X-20. Y20. R20.", "G3 X-20. Y20. I-20. J0", "G2 X20. Y20. I20. J0", "G2 X0 Y40. J20.", "G91 G3 X-20. Y20. R20."}) {
    for (const unsigned axis : {0u, 1u, 2u}) {
      for (const char* comp : {"", "G41 D4 "}) {
        SCOPED_TRACE(std::string(comp) + arc + " axis " + std::to_string(axis));
        HandMachine m(GetParam());
        m.start("G90 G0 X0 Y-80.\n" + std::string(comp) + "G1 X0 Y-60. F6000\nY-40.\nY0.\n" + arc + "\nG91 G1 X-20.\nG40 X-20.\nM30");
        for (unsigned block = 0; block < 4; ++block) {
          ASSERT_TRUE(m.until_stop());
          if (block < 3) m.press();
        }
        m.move(axis, 3);
        if (axis < 2) m.move(axis, -3);
        m.press();
        ASSERT_TRUE(m.until_stop());
        EXPECT_EQ(m.drive->alarm(), "");
        EXPECT_LT(m.worst, 1.001);
      }
    }
  }
}

struct Program {
  const char* name;
  const char* text;
};
const Program kPrograms[] = {
    {"polar", "G12.1\nG1 X12. Y4. F6000\nX-3. Y9.\nG3 X-9. Y-3. R12.\nG1 X5. Y-8.\nX14. Y2.\nG13.1\nG0 X30.\nM30"},
    {"polar with radius compensation", "G12.1\nG41 D4 G1 X12. Y4. F6000\nX-3. Y9.\nX-9. Y-3.\nG3 X5. Y-8. R12.\nG1 X14. Y2.\nG40 X20. Y0\nG13.1\nM30"},
    {"cylinder", "G19 Z0 C0 G0\nG07.1 C15.\nG1 Z5. F6000\nC60.\nG2 Z10. C80. R9.\nG1 Z2. C-40.\nG07.1 C0\nG0 X25.\nM30"},
    {"cylinder with radius compensation", "G19 Z0 C0 G0\nG07.1 C15.\nG41 D4 G1 Z5. F6000\nC60.\nZ10. C90.\nZ2. C-40.\nG40 C-60.\nG07.1 C0\nM30"},
    {"arc in space", "G1 X20. F6000\nG02.4 X25. Y5. Z3.\nX30. Y0. Z6.\nG1 X20. Z0\nG02.4 X25. Y5. Z3.\nX30. Y0. Z6.\nG1 X10.\nM30"},
    {"arcs with radius compensation", "G41 D4 G1 X25. Y5. F6000\nG3 X35. Y15. R10.\nG2 X45. Y25. I10.\nG1 X50. Y30.\nG3 X40. Y40. I-5. J5.\nG40 G1 X30. Y45.\nM30"},
    {"hypothetical axis", "G07 Z0\nG17 G2 X20. Y0 Z10. I-5. F6000\nG1 X30. Z12.\nG07 Z1\nG1 X10. Y5.\nM30"},
    {"nurbs", "G1 X20. Y0 F6000\nG06.2 P4 K0 X20. Y0\nK0 X25. Y5.\nK0 X30. Y-5.\nK0 X35. Y0\nK1\nK1\nK1\nK1\nG1 X20.\nM30"},
};

TEST_P(ByHand, NothingJumpsWhateverIsDone) {
  unsigned hands = 0, alarms = 0, ends = 0;
  const uint64_t count = seeds(160, 40);
  for (unsigned seed = 0; seed < count; ++seed) {
    std::mt19937 random(seed);
    const Program& program = kPrograms[seed % std::size(kPrograms)];
    HandMachine m(GetParam());
    m.start(program.text);
    for (unsigned stops = 0; stops < 25; ++stops) {
      ASSERT_TRUE(m.until_stop()) << program.name << " seed " << seed;
      if (m.drive->out.state == NC_STATE_ALARM || !m.drive->alarm().empty()) {
        ++alarms;
        m.drive->in.reset = true;
        m.step(5);
        m.drive->in.reset = false;
        break;
      }
      if (m.drive->ended) {
        ++ends;
        break;
      }
      const unsigned what = random() % 8;
      if (what < 3 && m.drive->out.manual_allowed) {
        ++hands;
        m.drive->in.manual_absolute_off = random() % 3 == 0;
        const unsigned axis = random() % 4;
        const double most = axis == 3 ? 250 : axis == 0 ? 45 : 15;
        m.move(axis, std::uniform_real_distribution<>(-most, most)(random));
      } else if (what == 7 && random() % 4 == 0) {
        m.drive->in.reset = true;
        m.step(5);
        m.drive->in.reset = false;
        m.step(5);
        break;
      }
      m.press();
    }
    ASSERT_LT(m.worst, 1.001) << program.name << " seed " << seed << " axis " << m.worst_axis << " line " << m.worst_line;
    // MDI, then the program once more, from where the axes are.
    m.drive->in.single_block = false;
    m.step(20);
    if (m.drive->out.state != NC_STATE_IDLE) continue;
    const std::string mdi = "G90 G0 X20. Y0 Z0 C0";
    if (nc_mdi_load(m.bench.control(), 0, mdi.data(), mdi.size()) != NC_OK) continue;
    m.drive->ended = false;
    m.press();
    for (unsigned n = 0; n < 4000 && !m.drive->ended; ++n) m.step();
    ASSERT_LT(m.worst, 1.001) << program.name << " seed " << seed << " MDI";
  }
  EXPECT_GT(hands, count / 3);
  EXPECT_GT(ends, count / 8);
  EXPECT_GT(alarms, count / 32);
}

/// Runs with single block to the stop behind line 2, moves Z by 37.5 there, and goes on block by block.
std::vector<nc_axes> with_z_raised(HandMachine& m, const std::string& text, bool off, std::vector<uint32_t>* marked) {
  m.start(text);
  std::vector<nc_axes> stops;
  for (unsigned stop = 0; stop < 12; ++stop) {
    EXPECT_TRUE(m.until_stop());
    stops.push_back(m.drive->out.command);
    marked->push_back(m.drive->out.moved_by_hand);
    EXPECT_EQ(m.drive->out.manual_absolute, !m.drive->in.manual_absolute_off);
    if (m.drive->ended || m.drive->out.state != NC_STATE_STOPPED) break;
    if (stop == 1) {
      m.move(2, 37.5);
      EXPECT_EQ(m.drive->out.moved_by_hand, 4u);
      m.drive->in.manual_absolute_off = off;
    }
    m.press();
  }
  EXPECT_EQ(m.drive->alarm(), "");
  EXPECT_LT(m.worst, 1.001);
  return stops;
}

constexpr const char* kRaised = "G90 G1 Z-2. F6000\nX25.\nX30.\nG91 Z-1.\nG90 Z5.\n#100=#5003\nM30";

TEST_P(ByHand, ManualAbsoluteOnAnAbsoluteWordGoesToItsPlace) {  // M700 12.4.4 (2)
  HandMachine m(GetParam());
  std::vector<uint32_t> marked;
  const std::vector<nc_axes> stops = with_z_raised(m, kRaised, false, &marked);
  ASSERT_GE(stops.size(), 5u);
  EXPECT_NEAR(stops[2].v[2], 35.5, 0.011);  // an axis that the block does not name stays, and the mark says so
  EXPECT_EQ(marked[2], 4u);
  EXPECT_NEAR(stops[3].v[2], 34.5, 0.011);  // an incremental word counts from there
  EXPECT_EQ(marked[3], 0u);
  EXPECT_NEAR(stops[4].v[2], 5, 1e-3);
  EXPECT_NEAR(m.bench.var_now(100), 5, 1e-3);
}

TEST_P(ByHand, ManualAbsoluteOffTheCoordinatesGoAlong) {  // M700 12.4.4 (1), 14.12
  HandMachine m(GetParam());
  std::vector<uint32_t> marked;
  const std::vector<nc_axes> stops = with_z_raised(m, kRaised, true, &marked);
  ASSERT_GE(stops.size(), 5u);
  EXPECT_NEAR(stops[2].v[2], 35.5, 0.011);
  EXPECT_EQ(marked[2], 0u);
  EXPECT_NEAR(stops[3].v[2], 34.5, 0.011);
  EXPECT_NEAR(stops[4].v[2], 42.5, 1e-3);
  EXPECT_NEAR(m.bench.var_now(100), 5, 1e-3);  // Z5 in the shifted coordinate system
  // The shift lasts until the coordinate system is preset (G92.1).
  m.drive->in.single_block = false;
  const std::string mdi = "G92.1 Z0;G90 G0 Z5.";
  m.step(50);
  ASSERT_EQ(nc_mdi_load(m.bench.control(), 0, mdi.data(), mdi.size()), NC_OK);
  m.drive->ended = false;
  m.press();
  for (unsigned n = 0; n < 3000 && !m.drive->ended; ++n) m.step();
  EXPECT_NEAR(m.at(2), 5, 1e-3);
}

TEST_P(ByHand, RadiusCompensationWithManualAbsolute) {  // M700 12.4.4: back on the path at the end of the next block, or shifted
  for (const bool off : {false, true}) {
    HandMachine m(GetParam());
    m.start("G17 G90 G41 D4 G1 X25. Y5. F6000\nY20.\nY40.\nX60.\nG40 X70. Y50.\nM30");
    std::vector<nc_axes> stops;
    for (unsigned stop = 0; stop < 8 && !m.drive->ended; ++stop) {
      ASSERT_TRUE(m.until_stop());
      stops.push_back(m.drive->out.command);
      if (m.drive->out.state != NC_STATE_STOPPED) break;
      if (stop == 1) {
        m.move(0, -6);
        m.drive->in.manual_absolute_off = off;
      }
      m.press();
    }
    EXPECT_EQ(m.drive->alarm(), "") << off;
    ASSERT_GE(stops.size(), 4u);
    EXPECT_NEAR(stops[3].v[0], off ? 54 : 60, 0.01) << off;
    EXPECT_LT(m.worst, 1.001) << off;
  }
}

// CONTOUR_CHECK goes by where the contour and the tool are on the table: a plate is closed where it is programmed, and a way back from where the axes have been
// moved to is compared with it before anything moves.
TEST_P(ByHand, TheCheckOfAContourKnowsWhereTheToolIs) {
  const char* const blocks = "G17 G90 G0 X10. Y-10.\nG42 D4 G1 X10. Y0 F6000\nX30. Y0\nX30. Y20.\nX0 Y20.\nX0 Y0\nX10. Y0\nG40 X10. Y-10.\nM30";
  const char* const single = "G17 G90 G0 X10. Y-10.\nG42 D4 G1 X10. Y0 F6000\nX30.\nY20.\nX0\nY0\nX10.\nG40 Y-10.\nM30";
  struct {
    const char* program;
    unsigned stop, axis;
    double by;
    std::string alarm;
  } const cases[] = {{blocks, 2, 1, 0.3, ""}, {blocks, 2, 0, 0.3, ""}, {single, 2, 1, 0.3, ""}, {single, 3, 0, 2, ""}, {blocks, 2, 1, -5, ""},
      {blocks, 2, 0, -20, "P153 L4"}, {blocks, 6, 1, 5, "P153 L8"}, {single, 2, 0, -0.5, "P153 L4"}};
  for (const auto& part : cases) {
    SCOPED_TRACE(std::string(part.program == single ? "single " : "") + std::to_string(part.stop) + " by " + std::to_string(part.by));
    HandMachine m(GetParam());
    m.bench.param("CONTOUR_CHECK", "1");
    m.start(part.program);
    nc_axes moved{};
    for (unsigned stop = 0; stop < 10 && !m.drive->ended; ++stop) {
      ASSERT_TRUE(m.until_stop());
      if (m.drive->out.state != NC_STATE_STOPPED) break;
      if (stop == part.stop) m.move(part.axis, part.by), moved = m.drive->out.command;
      m.press();
    }
    nc_alarm alarm{};
    const bool alarmed = nc_alarm_get(m.bench.control(), 0, &alarm) == NC_OK;
    EXPECT_EQ(alarmed ? std::string(alarm.code) + " L" + std::to_string(alarm.source.line) : "", part.alarm);
    if (part.alarm.empty()) {
      EXPECT_TRUE(m.drive->ended);
    } else {
      EXPECT_NEAR(m.at(0), moved.v[0], 1e-6);
      EXPECT_NEAR(m.at(1), moved.v[1], 1e-6);
    }
    EXPECT_LT(m.worst, 1.001);
  }
}

/// MDI keeps its modes from block to block; between two of them the axes are moved by hand.
TEST_P(ByHand, BetweenBlocksOfMdi) {
  for (const char* on : {"G12.1", "G19;G07.1 C15."}) {
    for (unsigned seed = 0; seed < 12; ++seed) {
      std::mt19937 random(seed);
      HandMachine m(GetParam());
      m.start("M30");
      m.step(20);
      for (const std::string& block : {std::string(on), std::string("G1 F6000 Z1."), std::string("Z4."), std::string("Z2.")}) {
        const std::string text = block + (block[0] == 'Z' && on[1] == '1' && on[2] == '2' ? " X9. Y3." : "");
        if (nc_mdi_load(m.bench.control(), 0, text.data(), text.size()) != NC_OK) continue;
        m.drive->ended = false;
        m.drive->in.single_block = false;
        m.press();
        for (unsigned n = 0; n < 3000 && !m.drive->ended; ++n) m.step();
        if (!m.drive->alarm().empty()) break;
        m.move(random() % 2 == 0 ? 0 : 3, std::uniform_real_distribution<>(-40, 40)(random));
      }
      ASSERT_LT(m.worst, 1.001) << on << " seed " << seed << " axis " << m.worst_axis;
    }
  }
}

/// The marks name an axis that was moved by hand until the program moves it, whatever the coordinate systems leave of the difference.
TEST_P(ByHand, SaysSoUntilTheProgramMovesTheAxis) {
  std::mt19937 random(7);
  for (unsigned n = 0; n < 30; ++n) {
    const auto any = [&random] { return std::round(std::uniform_real_distribution<>(-9, 9)(random) * 1000) / 1000; };
    HandMachine m(GetParam());
    m.bench.work_offset(1, {any(), any(), any()});
    m.start("G54 G91 G0 X1. Z1.\nY2.\nX1.\nG90 Z0\nX0\nM30");
    ASSERT_TRUE(m.until_stop());
    m.move(2, any());
    for (const uint32_t marked : {4u, 4u, 0u}) {  // Y, X, Z
      m.press();
      ASSERT_TRUE(m.until_stop());
      EXPECT_EQ(m.drive->out.moved_by_hand, marked) << n << " line " << m.drive->out.source.line;
    }
  }
}

/// A block stop at a corner that the optimal mode rounds is beside the corner. With manual absolute off the coordinate systems are shifted only
/// by the motion by hand, since the distances from the corners would add up from stop to stop.
TEST_P(ByHand, ManualAbsoluteOffShiftsByTheHandAlone) {
  HandMachine m(GetParam());
  std::string text = "G90 G1 F3000\n";
  for (unsigned n = 1; n <= 12; ++n) text += "X" + std::to_string(20 + n) + ". Y" + std::to_string(n % 2) + ". Z" + std::to_string(n % 2 == 0 ? 3 : 0) + ".\n";
  m.start(text + "G9 X40. Y7. Z5.\nM30");
  m.drive->in.manual_absolute_off = true;
  double by_hand = 0;
  bool beside = false;
  for (unsigned stop = 0; stop < 20 && !m.drive->ended; ++stop) {
    ASSERT_TRUE(m.until_stop());
    if (m.drive->ended) break;
    beside = beside || std::fabs(m.at(1) - std::nearbyint(m.at(1))) > 1e-4;
    if (stop > 0 && stop < 12) {
      m.move(2, 0.25);
      by_hand += 0.25;
    }
    m.press();
  }
  EXPECT_EQ(beside, GetParam());
  EXPECT_EQ(m.drive->alarm(), "");
  EXPECT_NEAR(m.at(2), 5 + by_hand, 1e-9);
  EXPECT_NEAR(m.at(0), 40, 1e-9);
  EXPECT_NEAR(m.at(1), 7, 1e-9);
}

}  // namespace
}  // namespace nc::test
