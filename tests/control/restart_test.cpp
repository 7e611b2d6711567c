// SPDX-License-Identifier: Apache-2.0
// Programs that are begun inside (nc/restart.h): from the place on the machine does what it does when the program runs from its head, nothing moves before the
// operator moves it, and no step of an axis is larger than it can be.
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "support/random_program.hpp"
#include "support/seeds.hpp"
#include "support/watched_machine.hpp"

namespace nc::test {
namespace {

constexpr unsigned kAxes = 3;

nc_restart_place at_block(uint64_t blocks) {
  nc_restart_place place;
  nc_restart_place_init(&place);
  place.number = blocks;
  return place;
}
nc_restart_place at_line(uint32_t line, uint32_t passing = 1) {
  nc_restart_place place = at_block(line);
  place.by = NC_RESTART_LINE;
  place.passing = passing;
  return place;
}
nc_restart_place at_sequence(uint32_t n, uint32_t passing = 1) {
  nc_restart_place place = at_line(n, passing);
  place.by = NC_RESTART_SEQUENCE;
  return place;
}

/// A machine with a program that has not been started.
class RestartMachine : public WatchedMachine {
 public:
  RestartMachine(bool optimal, const std::string& text) : WatchedMachine(NC_DIALECT_M700, "XYZ", {200, 200, 200}, optimal, 40) {
    bench.tool(1, 4).param("1084", "0.1");
    drive = std::make_unique<Drive>(bench, text);
    step(3);
  }
  nc_status find(const nc_restart_place& place) {
    nc_restart_found_init(&found);
    const nc_status begun = nc_restart_begin(bench.control(), 0, &place, nullptr);
    if (begun != NC_OK) return begun;
    nc_status status = NC_BUDGET;
    for (unsigned n = 0; n < 100000 && status == NC_BUDGET; ++n) {
      status = nc_restart_find(bench.control(), 0, 3, &found);
      if (n % 16 == 0) step();  // the scan goes on meanwhile, and so does the feeder
    }
    return status;
  }
  /// Moves each axis back, one behind the other, in the order of their numbers.
  void bring_axes() {
    for (unsigned i = 0; i < kAxes; ++i) {
      drive->in.manual[i] = {NC_MANUAL_RETURN, 0, 0};
      for (unsigned n = 0; n < 20000 && (n < 3 || drive->out.state == NC_STATE_MANUAL); ++n) step();
      drive->in.manual[i] = {};
      step(2);
    }
  }
  bool until_stop() {
    step(12);
    for (unsigned n = 0; n < 4000000 && (drive->out.state == NC_STATE_RUNNING || drive->out.state == NC_STATE_MANUAL); ++n) step();
    step(3);
    return drive->out.state != NC_STATE_RUNNING;
  }
  /// The start that comes to the place, and stands there.
  void enter() {
    press();
    ASSERT_TRUE(until_stop());
    ASSERT_EQ(drive->out.state, NC_STATE_STOPPED);
    ASSERT_EQ(drive->out.cause, NC_CAUSE_RESTART);
  }
  bool to_end() {
    for (unsigned n = 0; n < 60 && !drive->ended; ++n) {  // M01 and M00 stop
      press();
      if (!until_stop()) return false;
      if (drive->out.state == NC_STATE_ALARM) return false;
    }
    return drive->ended;
  }
  bool at(const nc_axes& place) const {
    for (unsigned i = 0; i < kAxes; ++i)
      if (std::fabs(drive->out.command.v[i] - place.v[i]) > 1e-9) return false;
    return true;
  }
  nc_restart_found found{};
};

class Restart : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(BothLaws, Restart, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

TEST_P(Restart, TellsTheStateAndGoesOnFromThePlace) {
  RestartMachine m(GetParam(), "G90 G54 G21\nM3 S1200\nT7 M6\nM8\nG0 X10. Y5.\nG91 G18\nN50 G1 Z-3. F600\nG90 X40.\nM9\nM30");
  ASSERT_EQ(m.find(at_sequence(50)), NC_OK);
  EXPECT_EQ(m.found.source.line, 7u);
  EXPECT_EQ(m.found.blocks, 6u);
  EXPECT_DOUBLE_EQ(m.found.machine.v[0], 10);
  EXPECT_DOUBLE_EQ(m.found.machine.v[1], 5);
  EXPECT_TRUE(m.found.s_given && m.found.t_given && !m.found.b_given);
  EXPECT_EQ(m.found.s, 1200);
  EXPECT_EQ(m.found.t, 7u);
  ASSERT_EQ(m.found.m_count, 3u);
  EXPECT_EQ(m.found.m[0], 3u);
  EXPECT_EQ(m.found.m[1], 6u);
  EXPECT_EQ(m.found.m[2], 8u);
  EXPECT_EQ(m.found.asked, 0u);
  nc_modal modal = NC_INIT(nc_modal);
  ASSERT_EQ(nc_modal_get(m.bench.control(), 0, m.found.modal, &modal), NC_OK);
  EXPECT_EQ(modal.code[2], 180) << "G18";
  EXPECT_EQ(modal.code[3], 910) << "G91";
  m.enter();
  EXPECT_EQ(m.drive->out.restart_axes, 3u);
  EXPECT_EQ(m.drive->out.command.v[0], 0) << "nothing moves by itself";
  EXPECT_EQ(m.drive->out.strobe, 0) << "and nothing is given out";
  m.press();
  m.step(50);
  EXPECT_EQ(m.drive->out.state, NC_STATE_STOPPED) << "the axes are not there";
  EXPECT_EQ(m.drive->out.cause, NC_CAUSE_RESTART);
  m.bring_axes();
  EXPECT_EQ(m.drive->out.restart_axes, 0u);
  EXPECT_TRUE(m.at(m.found.machine));
  EXPECT_EQ(m.drive->out.moved_by_hand, 0u);
  ASSERT_TRUE(m.to_end());
  EXPECT_NEAR(m.drive->out.command.v[0], 40, 1e-9);
  EXPECT_NEAR(m.drive->out.command.v[1], 5, 1e-9);
  EXPECT_NEAR(m.drive->out.command.v[2], -3, 1e-9);
  EXPECT_EQ(m.drive->out.m, 30u);
  EXPECT_LT(m.worst, 1.001);
}

TEST_P(Restart, TellsTheToolOfTheNewestChangeBesideTheOneThatIsCalledAhead) {
  RestartMachine m(GetParam(), "T4 M6\nT5\nM6 B3\nS700 M3\nT6\nM8\nN50 G1 X4. F600\nM30");
  ASSERT_EQ(m.find(at_sequence(50)), NC_OK);
  EXPECT_EQ(m.found.t, 6u);
  EXPECT_TRUE(m.found.change_t_given);
  EXPECT_EQ(m.found.change_t, 5u);
  ASSERT_EQ(m.found.m_count, 3u);
  const uint32_t m6 = m.found.m_order[0], m3 = m.found.m_order[1], m8 = m.found.m_order[2];
  EXPECT_LT(m.found.change_t_order, m.found.b_order);
  EXPECT_LT(m.found.b_order, m6);
  EXPECT_LT(m6, m.found.s_order);
  EXPECT_LT(m.found.s_order, m3);
  EXPECT_LT(m3, m.found.t_order);
  EXPECT_LT(m.found.t_order, m8);
}

TEST_P(Restart, TheToolChangeIsNeverTheCodeThatIsLeftOut) {
  std::string text = "T4 M6\n";
  for (unsigned code = 100; code < 100 + NC_RESTART_CODES + 5; ++code) text += "M" + std::to_string(code) + "\n";
  RestartMachine m(GetParam(), text + "N50 G1 X4. F600\nM30");
  ASSERT_EQ(m.find(at_sequence(50)), NC_OK);
  EXPECT_EQ(m.found.m_count, NC_RESTART_CODES + 6u);
  EXPECT_EQ(m.found.m[0], 6u);
  EXPECT_EQ(m.found.m[1], 106u);
  EXPECT_EQ(m.found.m[NC_RESTART_CODES - 1], 136u);
  for (unsigned i = 1; i < NC_RESTART_CODES; ++i) EXPECT_LT(m.found.m_order[i - 1], m.found.m_order[i]);
}

TEST_P(Restart, BlocksOfMdiBringSpindleAndToolThereAndAxesComeBackBehindThem) {
  RestartMachine m(GetParam(), "M3 S1200\nG0 X10. Y5.\nG1 Z-3. F600\nX40.\nM30");
  ASSERT_EQ(m.find(at_line(3)), NC_OK);
  m.enter();
  const std::string blocks = "M3 S1200\nG0 X-50. Z20.";
  ASSERT_EQ(nc_mdi_load(m.bench.control(), 0, blocks.data(), blocks.size()), NC_OK);
  m.press();
  ASSERT_TRUE(m.until_stop());
  EXPECT_EQ(m.drive->out.cause, NC_CAUSE_MDI_ENDED);
  EXPECT_EQ(m.drive->out.s, 1200);
  EXPECT_NEAR(m.drive->out.command.v[0], -50, 1e-9);
  EXPECT_EQ(m.drive->out.restart_axes, 7u);
  m.press();
  m.step(30);
  EXPECT_EQ(m.drive->out.state, NC_STATE_STOPPED);
  EXPECT_EQ(m.drive->out.cause, NC_CAUSE_RESTART);
  m.bring_axes();
  ASSERT_TRUE(m.at(m.found.machine));
  ASSERT_TRUE(m.to_end());
  EXPECT_NEAR(m.drive->out.command.v[0], 40, 1e-9);
  EXPECT_NEAR(m.drive->out.command.v[2], -3, 1e-9);
  EXPECT_LT(m.worst, 1.001);
}

// What the operator enters in the stop brings tool and spindle there. The rest of the program is that of the program, whatever modes the blocks have left.
TEST_P(Restart, BlocksOfMdiAtThePlaceLeaveTheProgramItsModes) {
  const std::string program = "G90 G54 G21 G17 G94 G0 X10. Y5.\nG43 H3 Z-10.\nG1 X20. F1200\nN50 G1 X30.\nY15.\nG2 X40. Y5. R10.\nG91 G1 X5. Z-1.\nG90 X0 Y0\nM30";
  const auto prepare = [](RestartMachine* m) { m->bench.work_offset(1, {10, 5, 0}).work_offset(2, {33, 44, 55}).tool(3, 7); };
  RestartMachine whole(GetParam(), program);
  prepare(&whole);
  ASSERT_TRUE(whole.to_end()) << whole.drive->alarm();
  for (const char* blocks : {"T2 M6\nM3 S500", "G91", "G20", "G18", "G55", "F77.", "G95 F0.1", "G68 X0 Y0 R30.", "G51.1 X0", "G49", "G49 G0 Z-3.\nX1. Y1.", "G91 G28 Z0\nT2 M6", "G41 D1", "G96 S100",
                             "G61", "G99 G81 X1. Y1. Z-1. R0 F100.", "G20 G91 G18 G55\nM3 S500"}) {
    SCOPED_TRACE(blocks);
    RestartMachine m(GetParam(), program);
    prepare(&m);
    ASSERT_EQ(m.find(at_sequence(50)), NC_OK);
    m.enter();
    for (unsigned twice = 0; twice < 2; ++twice) {
      ASSERT_EQ(nc_mdi_load(m.bench.control(), 0, blocks, std::strlen(blocks)), NC_OK);
      m.press();
      ASSERT_TRUE(m.until_stop());
      ASSERT_EQ(m.drive->out.cause, NC_CAUSE_MDI_ENDED) << m.drive->alarm();
    }
    m.bring_axes();
    EXPECT_EQ(m.drive->out.restart_axes, 0u);
    ASSERT_TRUE(m.to_end()) << m.drive->alarm();
    const auto expected = whole.drive->ends(), ends = m.drive->ends();
    ASSERT_GE(ends.size(), 5u);
    for (unsigned back = 1; back <= 5; ++back)
      for (unsigned i = 0; i < kAxes; ++i) EXPECT_NEAR(ends[ends.size() - back].v[i], expected[expected.size() - back].v[i], 1e-9) << back << ' ' << i;
    EXPECT_LT(m.worst, 1.001);
  }
}

// The place was found with the offsets that were there. With others it would be another one, and the blocks behind it would not belong to it.
TEST_P(Restart, OffsetsThatBlocksOfMdiChangeAtThePlaceEndTheRun) {
  for (const char* blocks : {"G10 L10 P3 R9.", "G10 L2 P1 X-3.", "G52 X5.", "G92 X7.", "M3 S500\nG10 L2 P2 X1.", "G10 L10 P3 R9.\nG43 H3 Z5."}) {
    SCOPED_TRACE(blocks);
    RestartMachine m(GetParam(), "G90 G54 G0 X10. Y5.\nG43 H3 Z-10.\nG1 X20. F1200\nN50 G1 X30.\nM30");
    m.bench.tool(3, 7);
    ASSERT_EQ(m.find(at_sequence(50)), NC_OK);
    m.enter();
    ASSERT_EQ(nc_mdi_load(m.bench.control(), 0, blocks, std::strlen(blocks)), NC_OK);
    m.press();
    ASSERT_TRUE(m.until_stop());
    EXPECT_EQ(m.drive->out.state, NC_STATE_ALARM);
    EXPECT_EQ(m.drive->alarm(), "NC-RESTART");
    m.drive->in.reset = true;
    m.step(5);
    m.drive->in.reset = false;
    m.step(5);
    EXPECT_EQ(m.find(at_sequence(50)), NC_OK);
  }
}

// What a search has read has not been executed: the tool in the spindle is the one that was there, by which `iso` finds a length without H.
TEST(RestartSearches, AreNoToolChange) {
  for (unsigned given_up = 0; given_up < 4; ++given_up) {
    SCOPED_TRACE(given_up);
    Bench bench(NC_DIALECT_ISO);
    bench.tool(1, 10).tool(3, 30);
    const auto ends = [&](const std::string& text) { return bench.run(text).moves().back().machine.v[2]; };
    EXPECT_NEAR(ends("T1 M6\nG43\nG1 Z5 F600\nM30\n"), 15, 1e-9);
    const std::string searched = "T3 M6\nG0 X1\nX2\nM30\n";
    unsigned file = 0;
    ASSERT_EQ(nc_program_add_text(bench.control(), "searched", searched.data(), searched.size(), &file), NC_OK);
    ASSERT_EQ(nc_program_select(bench.control(), 0, file), NC_OK);
    nc_restart_place place = at_line(given_up == 0 ? 99 : 3);
    nc_restart_found found;
    nc_restart_found_init(&found);
    ASSERT_EQ(nc_restart_begin(bench.control(), 0, &place, nullptr), NC_OK);
    nc_status status = NC_BUDGET;
    while (status == NC_BUDGET) status = nc_restart_find(bench.control(), 0, 10, &found);
    ASSERT_EQ(status, given_up == 0 ? NC_ENDED : NC_OK);
    if (given_up == 1) {
      ASSERT_EQ(nc_restart_cancel(bench.control(), 0), NC_OK);
    }
    if (given_up == 2) {
      ASSERT_EQ(nc_reset(bench.control(), 0), NC_OK);
    }
    EXPECT_NEAR(ends("G43\nG1 Z6 F600\nM30\n"), 16, 1e-9) << "and so it is where another program is selected";
  }
}

// What the operator moves and turns in the stop is no hole of the program, and no word of its tap (P186).
TEST_P(Restart, BlocksOfMdiAtAPlaceWithinACycleAreNoHoles) {
  const std::string program = "M3 S500\nG90 G54 G0 X0 Y0\nG81 X10. Z-8. R2. F600\nX20.\nN50 X30.\nG80 X5.\nM30";
  RestartMachine whole(GetParam(), program);
  ASSERT_TRUE(whole.to_end()) << whole.drive->alarm();
  RestartMachine m(GetParam(), program);
  ASSERT_EQ(m.find(at_sequence(50)), NC_OK);
  m.enter();
  const std::string blocks = "M3 S500\nX-5. Y-5.\nX-6.";
  const size_t before = m.drive->ends().size();
  ASSERT_EQ(nc_mdi_load(m.bench.control(), 0, blocks.data(), blocks.size()), NC_OK);
  m.press();
  ASSERT_TRUE(m.until_stop());
  ASSERT_EQ(m.drive->out.cause, NC_CAUSE_MDI_ENDED) << m.drive->alarm();
  for (size_t i = before; i < m.drive->ends().size(); ++i) EXPECT_EQ(m.drive->ends()[i].v[2], 0) << "no hole";
  m.bring_axes();
  ASSERT_TRUE(m.to_end()) << m.drive->alarm();
  const auto expected = whole.drive->ends(), ends = m.drive->ends();
  for (unsigned back = 1; back <= 4; ++back)
    for (unsigned i = 0; i < kAxes; ++i) EXPECT_NEAR(ends[ends.size() - back].v[i], expected[expected.size() - back].v[i], 1e-9) << back << ' ' << i;

  RestartMachine tap(GetParam(), "M3 S500\nG90 G54 G0 X0 Y0\nG84 X10. Z-8. R2. F1. S500 ,R1\nN50 X30.\nG80 X5.\nM30");
  ASSERT_EQ(tap.find(at_sequence(50)), NC_OK);
  tap.enter();
  ASSERT_EQ(nc_mdi_load(tap.bench.control(), 0, "M3 S500", 7), NC_OK);
  tap.press();
  ASSERT_TRUE(tap.until_stop());
  EXPECT_EQ(tap.drive->out.cause, NC_CAUSE_MDI_ENDED) << tap.drive->alarm();
}

// In a block stop of a program that was begun inside blocks of MDI keep what they change, as in every other one (12.4.4).
TEST_P(Restart, BlocksOfMdiBehindThePlaceKeepTheirModes) {
  RestartMachine m(GetParam(), "G90 G0 X10.\nN50 G1 X20. F6000\nM0\nX3.\nM30");
  ASSERT_EQ(m.find(at_sequence(50)), NC_OK);
  m.enter();
  m.bring_axes();
  m.press();
  ASSERT_TRUE(m.until_stop());
  ASSERT_EQ(m.drive->out.cause, NC_CAUSE_PROGRAM_STOP);
  ASSERT_EQ(nc_mdi_load(m.bench.control(), 0, "G91", 3), NC_OK);
  m.press();
  ASSERT_TRUE(m.until_stop());
  ASSERT_TRUE(m.to_end()) << m.drive->alarm();
  EXPECT_NEAR(m.drive->out.command.v[0], 23, 1e-9);
}

TEST_P(Restart, AResetInTheStopGivesThePlaceUp) {
  RestartMachine m(GetParam(), "G0 X10.\n#100=7\nX20.\nX30.\nM30");
  ASSERT_EQ(m.find(at_line(3)), NC_OK);
  m.enter();
  m.drive->in.reset = true;
  m.step(5);
  m.drive->in.reset = false;
  m.step(5);
  EXPECT_EQ(m.drive->out.state, NC_STATE_IDLE);
  EXPECT_EQ(m.drive->out.restart_axes, 0u);
  ASSERT_TRUE(m.to_end());
  EXPECT_EQ(m.drive->ends().size(), 3u) << "from the head";
  EXPECT_TRUE(m.drive->alarm().empty());
}

TEST_P(Restart, ThePositionIsNotSetBehindTheSearch) {  // the program would begin at its head
  RestartMachine m(GetParam(), "G0 X10.\nX20.\nX30.\nM30");
  const nc_axes stand{};
  EXPECT_EQ(nc_position_set(m.bench.control(), 0, &stand), NC_OK);
  ASSERT_EQ(m.find(at_line(3)), NC_OK);
  EXPECT_EQ(nc_position_set(m.bench.control(), 0, &stand), NC_E_STATE);
  m.enter();  // at the place
  m.drive->in.reset = true;
  m.step(5);
  m.drive->in.reset = false;
  m.step(5);
  EXPECT_EQ(nc_position_set(m.bench.control(), 0, &stand), NC_OK);
  ASSERT_EQ(m.find(at_line(3)), NC_OK);
  ASSERT_EQ(nc_restart_cancel(m.bench.control(), 0), NC_OK);
  EXPECT_EQ(nc_position_set(m.bench.control(), 0, &stand), NC_OK);
}

TEST_P(Restart, WhatHasChangedBehindTheSearchIsAnAlarm) {
  RestartMachine m(GetParam(), "G0 X10.\nG54\nX20.\nX30.\nM30");
  ASSERT_EQ(m.find(at_line(3)), NC_OK);
  m.bench.work_offset(1, {5, 0, 0});
  m.press();
  m.step(50);
  EXPECT_EQ(m.drive->out.state, NC_STATE_ALARM);
  EXPECT_EQ(m.drive->alarm(), "NC-RESTART");
  EXPECT_EQ(m.drive->out.command.v[0], 0);
  m.drive->in.reset = true;
  m.step(5);
  m.drive->in.reset = false;
  m.step(5);
  ASSERT_EQ(m.find(at_line(3)), NC_OK);
  EXPECT_DOUBLE_EQ(m.found.machine.v[0], 15);
  m.drive->in.mirror = 1;
  m.press();
  m.step(50);
  EXPECT_EQ(m.drive->alarm(), "NC-RESTART") << "mirrored the program would go elsewhere";
}

TEST_P(Restart, PassingsAndProgramsThatAreCalled) {
  const std::string text = "O1\n#1=0\nWHILE[#1 LT 5] DO1\nN10 G91 G0 X1.\n#1=#1+1\nEND1\nM98 P2 L3\nG90 X0\nM30\nO2\nN10 G91 Y2.\nM99\n%";
  RestartMachine m(GetParam(), text);
  ASSERT_EQ(m.find(at_sequence(10, 4)), NC_OK);
  EXPECT_DOUBLE_EQ(m.found.machine.v[0], 3);
  ASSERT_EQ(m.find(at_line(11, 2)), NC_OK);
  EXPECT_DOUBLE_EQ(m.found.machine.v[0], 5);
  EXPECT_DOUBLE_EQ(m.found.machine.v[1], 2);
  EXPECT_EQ(m.found.source.depth, 1u);
  EXPECT_EQ(m.find(at_sequence(10, 6)), NC_ENDED);
  EXPECT_EQ(m.find(at_sequence(11)), NC_E_NOT_FOUND);
  EXPECT_EQ(m.find(at_line(500)), NC_ENDED);
  m.press();
  ASSERT_TRUE(m.until_stop());
  EXPECT_EQ(m.drive->ends().size(), 5u + 3 + 1) << "where nothing was found, the next start begins at the head";
}

/// A long program is searched in pieces; the program behind it is none of it, wherever a piece ends.
TEST_P(Restart, ASequenceNumberOfTheProgramBehindIsNotFound) {
  constexpr size_t kPiece = 1 << 20;
  std::string text;
  while (text.size() < kPiece) text += "G0X1.\n";
  RestartMachine m(GetParam(), text + "O2\nN77 G0 X1.\nM99\n%");
  EXPECT_EQ(m.find(at_sequence(77)), NC_E_NOT_FOUND);
}

TEST_P(Restart, AnAlarmBeforeThePlace) {
  RestartMachine m(GetParam(), "G0 X10.\nG2 X1. Y1. I1. J9.\nX20.\nM30");
  EXPECT_EQ(m.find(at_line(3)), NC_ALARMED);
  nc_alarm alarm = NC_INIT(nc_alarm);
  ASSERT_EQ(nc_alarm_get(m.bench.control(), 0, &alarm), NC_OK);
  EXPECT_EQ(std::string(alarm.code), "P62");
  EXPECT_EQ(alarm.source.line, 2u);
  EXPECT_EQ(nc_restart_find(m.bench.control(), 0, 10, &m.found), NC_E_STATE);
}

TEST_P(Restart, ArgumentsThatAreRefused) {
  RestartMachine m(GetParam(), "G0 X10.\nX20.\nM30");
  nc_control* const c = m.bench.control();
  nc_restart_place place = at_line(0);
  EXPECT_EQ(nc_restart_begin(c, 0, &place, nullptr), NC_E_ARGUMENT);
  place = at_line(2);
  place.by = 3;
  EXPECT_EQ(nc_restart_begin(c, 0, &place, nullptr), NC_E_ARGUMENT);
  place = at_line(2);
  place.in_file = true;
  place.file = 9999;
  EXPECT_EQ(nc_restart_begin(c, 0, &place, nullptr), NC_E_ARGUMENT);
  place = at_line(2);
  place.start_given = true;
  place.start.v[1] = NAN;
  EXPECT_EQ(nc_restart_begin(c, 0, &place, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_restart_begin(c, 7, &place, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_restart_begin(c, 0, nullptr, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_restart_find(c, 0, 10, &m.found), NC_E_STATE);
  EXPECT_EQ(nc_restart_cancel(c, 0), NC_OK);
  nc_restart_coordinates left{};
  EXPECT_EQ(nc_restart_coordinates_get(c, 7, false, &left), NC_E_ARGUMENT);
  EXPECT_EQ(nc_restart_coordinates_get(c, 0, false, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_restart_coordinates_set(c, 7, &left), NC_E_ARGUMENT);
  EXPECT_EQ(nc_restart_coordinates_set(c, 0, nullptr), NC_E_ARGUMENT);
  left.local[2].v[1] = NAN;
  EXPECT_EQ(nc_restart_coordinates_set(c, 0, &left), NC_E_ARGUMENT);
  left.local[2].v[1] = 0;
  EXPECT_EQ(nc_restart_coordinates_set(c, 0, &left), NC_OK);
  place = at_line(2);
  m.press();
  EXPECT_EQ(nc_restart_coordinates_set(c, 0, &left), NC_E_STATE) << "the program runs";
  EXPECT_EQ(nc_restart_begin(c, 0, &place, nullptr), NC_E_STATE) << "the program runs";
  EXPECT_EQ(nc_restart_cancel(c, 0), NC_E_STATE);
}

/// Each start in blocks of MDI is one of theirs, in single block as well, and the bar stays until the program goes on.
TEST_P(Restart, BlocksOfMdiInSingleBlockKeepTheBar) {
  for (const bool there : {false, true}) {
    RestartMachine m(GetParam(), "G90 G0 X10. Y5.\nG1 Z-3. F600\nG91 G1 X40.\nG90 X60.\nM30");
    ASSERT_EQ(m.find(at_line(3)), NC_OK);
    m.enter();
    if (there) m.bring_axes();
    m.drive->in.single_block = true;
    const std::string blocks = "M8\nG0 X-50. Z20.";
    ASSERT_EQ(nc_mdi_load(m.bench.control(), 0, blocks.data(), blocks.size()), NC_OK);
    m.press();
    ASSERT_TRUE(m.until_stop());
    EXPECT_EQ(m.drive->out.cause, NC_CAUSE_SINGLE_BLOCK);
    m.press();
    ASSERT_TRUE(m.until_stop());
    EXPECT_EQ(m.drive->out.cause, NC_CAUSE_MDI_ENDED);
    EXPECT_NEAR(m.drive->out.command.v[0], -50, 1e-9);
    EXPECT_EQ(m.drive->out.restart_axes, there ? 5u : 7u);
    m.press();
    m.step(100);
    EXPECT_EQ(m.drive->out.state, NC_STATE_STOPPED);
    EXPECT_EQ(m.drive->out.cause, NC_CAUSE_RESTART);
    EXPECT_NEAR(m.drive->out.command.v[0], -50, 1e-9) << "the program does not go on from here";
    m.bring_axes();
    m.drive->in.single_block = false;
    ASSERT_TRUE(m.to_end());
    EXPECT_NEAR(m.drive->out.command.v[0], 60, 1e-9);
    EXPECT_NEAR(m.drive->out.command.v[2], -3, 1e-9);
  }
}

TEST_P(Restart, AStartThatIsTakenBackKeepsTheBar) {
  for (unsigned late = 0; late < 6; ++late) {
    RestartMachine m(GetParam(), "G90 G0 X10. Y5.\nG1 Z-3. F600\nX40.\nM30");
    ASSERT_EQ(m.find(at_line(3)), NC_OK);
    m.enter();
    m.bring_axes();
    m.drive->in.cycle_start = true;
    m.drive->step(0);  // the feeder is late
    m.drive->in.feed_hold = true;
    for (unsigned n = 0; n < late; ++n) m.drive->step(0);
    m.step(20);
    m.drive->in.cycle_start = m.drive->in.feed_hold = false;
    m.step(5);
    if (m.drive->out.state != NC_STATE_STOPPED) continue;  // the start was the earlier one
    m.drive->in.manual[1] = {NC_MANUAL_STEP, 0, 7};
    m.step(300);
    m.drive->in.manual[1] = {};
    m.step(3);
    EXPECT_EQ(m.drive->out.restart_axes, 2u) << late;
    m.press();
    m.step(50);
    EXPECT_EQ(m.drive->out.state, NC_STATE_STOPPED) << late;
  }
}

/// The path of a place is planned while the axes stand beside it, and begins there where they are near enough. Behind the way to the place it begins at the place.
TEST_P(Restart, GoesOnWhereTheAxesStoodHardlyBesideThePlace) {
  for (const char* beside : {"0.0005", "0.001", "0.01", "0.02", "0.03", "1."}) {
    RestartMachine m(GetParam(), std::string("G90 G0 X10.\nG0 X0 Y") + beside + "\nG0 Y30.\nG1 X5. F600\nM30");
    ASSERT_EQ(m.find(at_line(3)), NC_OK);
    m.enter();
    EXPECT_EQ(m.drive->out.restart_axes, 2u) << beside;
    m.bring_axes();
    EXPECT_TRUE(m.at(m.found.machine)) << beside;
    ASSERT_TRUE(m.to_end()) << beside;
    EXPECT_NEAR(m.drive->out.command.v[0], 5, 1e-9);
    EXPECT_NEAR(m.drive->out.command.v[1], 30, 1e-9);
    EXPECT_LT(m.worst, 1.001) << beside;
  }
}

TEST_P(Restart, TheFirstBlockIsAPlaceToo) {
  RestartMachine m(GetParam(), "G91 G0 X10. Y5.\nG1 X3. F600\nM30");
  nc_restart_place place = at_line(1);
  place.start_given = true;
  place.start.v[0] = 100;
  ASSERT_EQ(m.find(place), NC_OK);
  EXPECT_EQ(m.found.blocks, 0u);
  EXPECT_DOUBLE_EQ(m.found.machine.v[0], 100);
  m.enter();
  EXPECT_EQ(m.drive->out.restart_axes, 1u);
  EXPECT_EQ(m.drive->out.command.v[0], 0);
  m.bring_axes();
  ASSERT_TRUE(m.to_end());
  EXPECT_NEAR(m.drive->out.command.v[0], 113, 1e-9);
  EXPECT_NEAR(m.drive->out.command.v[1], 5, 1e-9);
}

/// nc_outputs::blocks of a run that was stopped names the place in the next one, whatever was executed beside the program.
TEST_P(Restart, BlocksBesideTheProgramDoNotCount) {
  RestartMachine m(GetParam(), "G0 X10.\nM0\nX20.\nX30.\nM0\nX40.\nM30");
  m.press();
  ASSERT_TRUE(m.until_stop());
  const std::string blocks = "M8\n#1=5\nG0 Z5.";
  ASSERT_EQ(nc_mdi_load(m.bench.control(), 0, blocks.data(), blocks.size()), NC_OK);
  m.press();
  ASSERT_TRUE(m.until_stop());
  ASSERT_EQ(m.drive->out.cause, NC_CAUSE_MDI_ENDED);
  m.press();
  ASSERT_TRUE(m.until_stop());
  ASSERT_EQ(m.drive->out.cause, NC_CAUSE_PROGRAM_STOP);
  EXPECT_NEAR(m.drive->out.command.v[0], 30, 1e-9);
  const uint64_t blocks_done = m.drive->out.blocks;
  m.drive->in.reset = true;
  m.step(5);
  m.drive->in.reset = false;
  m.step(5);
  ASSERT_EQ(m.find(at_block(blocks_done)), NC_OK);
  EXPECT_EQ(m.found.source.line, 5u) << "the M0 was not finished";
  m.enter();
  EXPECT_EQ(m.drive->out.blocks, blocks_done);
}

/// The usual place of a restart is the call of what a tool does.
TEST_P(Restart, ACallIsAPlace) {
  const std::string text = "O1\nN1 G91 G0 X1.\nN2 M98 P2 L3\nN3 G65 P3 A1.\nM30\nO2\nN1 Y2.\nM99\nO3\nN1 Z#1\nM99\n%";
  const struct {
    uint32_t sequence, line, moves;
    double x, y, z;
  } places[] = {{2, 3, 4, 1, 0, 0}, {3, 4, 1, 1, 6, 0}};
  for (const auto& place : places) {
    RestartMachine m(GetParam(), text);
    ASSERT_EQ(m.find(at_sequence(place.sequence)), NC_OK);
    EXPECT_EQ(m.found.source.line, place.line);
    EXPECT_DOUBLE_EQ(m.found.machine.v[0], place.x);
    EXPECT_DOUBLE_EQ(m.found.machine.v[1], place.y);
    EXPECT_DOUBLE_EQ(m.found.machine.v[2], place.z);
    m.enter();
    m.bring_axes();
    const size_t before = m.drive->ends().size();
    ASSERT_TRUE(m.to_end());
    EXPECT_EQ(m.drive->ends().size() - before, place.moves);
    EXPECT_NEAR(m.drive->out.command.v[1], 6, 1e-9);
    EXPECT_NEAR(m.drive->out.command.v[2], 1, 1e-9);
  }
  RestartMachine torn(GetParam(), "O1\nG10 L10 P1 R2.\nG41 D1 G1 X10. F600\nX20.\nM98 P2\nX40.\nG40 X50. Y9.\nM30\nO2\nX30.\nM99\n%");
  EXPECT_EQ(torn.find(at_line(5)), NC_E_NOT_FOUND) << "a call amid a contour";
  EXPECT_EQ(torn.find(at_line(6)), NC_OK);
}

TEST_P(Restart, AStartDuringTheSearchIsAnAlarm) {
  RestartMachine m(GetParam(), "G0 X10.\nX20.\nX30.\nX40.\nM30");
  const nc_restart_place place = at_block(3);
  ASSERT_EQ(nc_restart_begin(m.bench.control(), 0, &place, nullptr), NC_OK);
  ASSERT_EQ(nc_restart_find(m.bench.control(), 0, 1, &m.found), NC_BUDGET);
  m.press();
  m.step(50);
  EXPECT_EQ(m.drive->alarm(), "NC-RESTART");
  EXPECT_EQ(m.drive->out.command.v[0], 0);
}

/// Coordinate systems are moved along with what is moved by hand, and in the stop of a restart nothing was: the axes are brought there.
TEST_P(Restart, ManualAbsoluteOffShiftsNothing) {
  RestartMachine m(GetParam(), "G90 G0 X10. Y5.\nG1 Z-3. F600\nX40.\nM30");
  m.drive->in.manual_absolute_off = true;
  ASSERT_EQ(m.find(at_line(3)), NC_OK);
  m.enter();
  EXPECT_EQ(m.drive->out.moved_by_hand, 0u);
  const std::string blocks = "G90 G0 X20.";
  ASSERT_EQ(nc_mdi_load(m.bench.control(), 0, blocks.data(), blocks.size()), NC_OK);
  m.press();
  ASSERT_TRUE(m.until_stop());
  EXPECT_NEAR(m.drive->out.command.v[0], 20, 1e-9);
  m.bring_axes();
  EXPECT_EQ(m.drive->out.moved_by_hand, 0u);
  ASSERT_TRUE(m.to_end());
  EXPECT_NEAR(m.drive->out.command.v[0], 40, 1e-9);
}

TEST_P(Restart, TheClampOfTheSpindleIsThatOfAllItsBlocks) {
  RestartMachine m(GetParam(), "G0 X50.\nG96 S100 P1\nG92 S150\nG92 Q20\nM3\nG1 X40. F3000\nX5.\nM30");
  ASSERT_EQ(m.find(at_line(7)), NC_OK);
  m.enter();
  m.bring_axes();
  ASSERT_TRUE(m.to_end());
  EXPECT_LE(m.drive->out.spindle_rev_min[0], 150.001);
}

/// Behind a way by hand and back again the program goes on with what was read, in a mode that stops beside the end of a block as well.
TEST_P(Restart, BackToThePathInAnyBlockStop) {
  RestartMachine m(GetParam(), "G90 G0 X10. Y5.\nG91 G1 Y30. F900\nG2 X10. R5.\nG1 X60.\nM30");
  m.drive->in.single_block = true;
  m.press();
  ASSERT_TRUE(m.until_stop());
  m.press();
  ASSERT_TRUE(m.until_stop());
  ASSERT_EQ(m.drive->out.state, NC_STATE_STOPPED);
  const nc_axes left = m.drive->out.command;
  m.drive->in.manual[0] = {NC_MANUAL_STEP, 0, 5};
  m.step(400);
  m.drive->in.manual[0] = {};
  m.step(3);
  EXPECT_EQ(m.drive->out.moved_by_hand, 1u);
  m.bring_axes();
  EXPECT_TRUE(m.at(left));
  EXPECT_EQ(m.drive->out.moved_by_hand, 0u);
  m.drive->in.single_block = false;
  ASSERT_TRUE(m.to_end()) << m.drive->alarm();
}

TEST_P(Restart, ATextThatWasReplacedIsAnAlarm) {
  RestartMachine m(GetParam(), "G0 X10.\nX20.\nX30.\nM30");
  ASSERT_EQ(m.find(at_line(3)), NC_OK);
  m.bench.add("main", "G0 X10.\n(other)\nX20.\nX99.\nM30");
  m.press();
  m.step(50);
  EXPECT_EQ(m.drive->alarm(), "NC-RESTART");
  EXPECT_EQ(m.drive->out.command.v[0], 0);
}

TEST_P(Restart, CancelBeginsAtTheHead) {
  RestartMachine m(GetParam(), "G0 X10.\nX20.\nX30.\nM30");
  ASSERT_EQ(m.find(at_line(3)), NC_OK);
  EXPECT_EQ(nc_restart_cancel(m.bench.control(), 0), NC_OK);
  ASSERT_TRUE(m.to_end());
  EXPECT_EQ(m.drive->ends().size(), 3u);
}

/// States that the scan keeps have to be those of the program there: overrides that it has switched off, a clamp of the spindle.
TEST_P(Restart, TheScanGetsTheStatesOfTheProgram) {
  RestartMachine m(GetParam(), "#3004=2\nG92 S500\nM3 S1200\nG0 X10.\nG1 X20. F600\nM30");
  m.drive->in.feed_override = 0.5;
  ASSERT_EQ(m.find(at_line(5)), NC_OK);
  m.enter();
  m.bring_axes();
  m.press();
  m.step(200);
  EXPECT_EQ(m.drive->out.override_source, NC_OVERRIDE_PROGRAM);
  ASSERT_TRUE(m.to_end());
}

/// The moves of a program that runs from its head, and which of its block ends each comes behind.
struct WholeRun {
  std::vector<nc_item> moves;
  std::vector<size_t> behind;  ///< [n]: number of moves in front of the end of block n
  std::map<uint32_t, double> vars;
};

void load_subs(Bench& bench, const RandomProgram& program) {
  for (size_t i = 0; i < program.subs.size(); ++i) bench.add("O" + std::to_string(i + 1), program.subs[i]);
}

TEST_P(Restart, AnywhereInRandomPrograms) {
  unsigned begun = 0, hang_together = 0;
  const auto from = static_cast<uint32_t>(wish("NC_FIRST_SEED", 1));
  for (uint32_t seed = from; seed < from + seeds(60, 15); ++seed) {
    SCOPED_TRACE(seed);
    const RandomProgram program = ProgramMaker(seed, false).make();
    RestartMachine whole(GetParam(), program.main);
    load_subs(whole.bench, program);
    RestartMachine part(GetParam(), program.main);
    load_subs(part.bench, program);
    std::mt19937 random(seed);
    // The whole run, offline.
    WholeRun run;
    {
      Bench bench(NC_DIALECT_M700, [](nc_config& c) { axes("XYZ")(c); });
      bench.tool(1, 4).param("1084", "0.1");
      load_subs(bench, program);
      const Outcome done = bench.run(program.main);
      if (!done.alarm.empty()) continue;
      for (const Step& step : done.steps) {
        if (step.item.kind == NC_ITEM_MOVE) run.moves.push_back(step.item);
        if (step.item.kind == NC_ITEM_MARK && step.item.u.mark.report) run.behind.push_back(run.moves.size());
      }
      run.vars = done.vars;
    }
    const uint64_t blocks = std::uniform_int_distribution<uint64_t>(1, run.behind.size() - 2)(random);
    nc_restart_place place = at_block(blocks);
    place.start_given = true;
    nc_axes stands{};
    for (unsigned i = 0; i < kAxes; ++i) stands.v[i] = std::uniform_real_distribution<double>(-30, 30)(random);
    for (unsigned i = 0; i < kAxes; ++i) {
      part.drive->in.manual[i] = {NC_MANUAL_STEP, 0, stands.v[i]};
    }
    part.step(1200);
    for (nc_manual& manual : part.drive->in.manual) manual = {};
    part.step(3);
    const nc_status status = part.find(place);
    if (status == NC_E_NOT_FOUND || status == NC_ENDED) {  // between the end of what was called and that of the block that has called it, too
      ++hang_together;
      continue;
    }
    ASSERT_EQ(status, NC_OK) << part.drive->alarm();
    EXPECT_EQ(part.found.blocks, blocks);
    ++begun;
    part.enter();
    EXPECT_TRUE(part.at(stands)) << "nothing has moved";
    part.bring_axes();
    ASSERT_TRUE(part.at(part.found.machine));
    ASSERT_TRUE(part.to_end()) << part.drive->alarm() << " line " << part.drive->out.source.line << " cause " << int{part.drive->out.cause} << " behind " << part.drive->out.blocks << " blocks";
    EXPECT_LT(part.worst, 1.001) << "axis " << part.worst_axis << " line " << part.worst_line;
    const std::vector<nc_axes> ends = part.drive->ends();
    const size_t first = run.behind[blocks - 1];
    ASSERT_EQ(ends.size(), run.moves.size() - first) << program.main;
    for (size_t i = 0; i < ends.size(); ++i)
      for (unsigned a = 0; a < kAxes; ++a) ASSERT_NEAR(ends[i].v[a], run.moves[first + i].u.move.machine.v[a], GetParam() ? 0.021 : 1e-6) << "move " << i << " line " << run.moves[first + i].source.line << "\n" << program.main;
    for (unsigned n = 100; n < 110; ++n) {
      const double value = part.bench.var_now(n);
      const double wanted = run.vars.contains(n) ? run.vars.at(n) : NAN;
      EXPECT_TRUE(value == wanted || (std::isnan(value) && std::isnan(wanted))) << "#" << n;
    }
  }
  EXPECT_GT(begun, 5u);
  std::printf("%u begun inside, %u where blocks hang together\n", begun, hang_together);
}

/// Programs in which each block may change a mode, and each move is another one under it: planes, units, offsets, shifts, rotation, scaling, polar coordinates, lengths,
/// compensation, cycles, loops and sub programs.
class ModesMaker {
 public:
  explicit ModesMaker(uint32_t seed) : random_(seed) {}
  RandomProgram make() {
    RandomProgram p;
    for (int i = 1; i <= 2; ++i) {
      text_ = "O" + std::to_string(i) + "\n";
      in_sub_ = true;
      for (int n = number(2, 5); n > 0; --n) block();
      p.subs.push_back(text_ + "M99\n");
    }
    in_sub_ = false;
    text_ = "G90 G54 G17 G21 G94 G0 X0 Y0 Z5. F800\nM3 S900\nG10 L2 P2 X3. Y-4. Z1.\nG10 L10 P2 R2.5\n";
    for (int n = number(15, 40); n > 0; --n) block();
    p.main = text_ + "G40 G80 G69 G50 G15 G49 G21 G90 G94\nG0 Z20.\nM30\n";
    return p;
  }

 private:
  int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  std::string place(int reach = 6) { return std::to_string(number(-reach * 1000, reach * 1000) / 1000.0); }
  std::string xy() { return " X" + place() + " Y" + place(); }
  void block() {
    switch (number(0, 27)) {
      case 0: text_ += "G68" + xy() + " R" + place(90) + "\n"; break;
      case 1: text_ += "G69\n"; break;
      case 2: text_ += "G20 F" + std::to_string(number(10, 40)) + ".\n"; break;
      case 3: text_ += "G21 F" + std::to_string(number(300, 900)) + ".\n"; break;
      case 4: text_ += "G43 H2 Z" + place(4) + "\n"; break;
      case 5: text_ += "G49\n"; break;
      case 6: text_ += "G92 X" + place() + "\n"; break;
      case 7: text_ += "G52 Y" + place() + "\n"; break;
      case 8: text_ += "G51 X0 Y0 Z0 P" + std::to_string(number(5, 15) / 10.0) + "\n"; break;
      case 9: text_ += "G50\n"; break;
      case 10: text_ += std::string(number(0, 1) == 0 ? "G18" : "G19") + " G0 X" + place() + " Z" + place() + "\nG17\n"; break;
      case 11: text_ += "G91 G1" + xy() + "\nZ" + place(1) + "\nG90\n"; break;
      case 12: text_ += "G5" + std::to_string(number(4, 6)) + " G0" + xy() + "\n"; break;
      case 13: text_ += "G16 G0 X" + std::to_string(number(1, 6)) + ". Y" + place(90) + "\nY" + place(90) + "\nG15\n"; break;
      case 14: text_ += "G95 G1" + xy() + " F0." + std::to_string(number(1, 9)) + "\nG94 F" + std::to_string(number(20, 800)) + ".\n"; break;
      case 15: text_ += "G81" + xy() + " Z-2. R1. F200.\n" + xy() + "\nG80\n"; break;
      case 16: text_ += "S" + std::to_string(number(500, 1500)) + "\n"; break;
      case 17: text_ += "M" + std::to_string(number(7, 9)) + "\n"; break;
      case 18:
        if (!in_sub_) text_ += "M98 P" + std::to_string(number(1, 2)) + " L" + std::to_string(number(1, 2)) + "\n";
        break;
      case 19: text_ += "#101=#101+1\nG1 X#101 F500.\n"; break;
      case 20: text_ += "G2 X" + place() + " Y" + place() + " R9.\n"; break;
      case 21: text_ += "G53 G0 Z" + place(9) + "\n"; break;
      default: text_ += std::string(number(0, 1) == 0 ? "G0" : "G1") + xy() + (number(0, 2) == 0 ? " Z" + place(3) : "") + "\n"; break;
    }
  }
  std::mt19937 random_;
  std::string text_;
  bool in_sub_ = false;
};

/// As AnywhereInRandomPrograms: from the place on the moves are those of the whole run, whatever modes are in force there.
TEST_P(Restart, AnywhereAmidModes) {
  unsigned begun = 0, alarms = 0, nowhere = 0;
  const auto from = static_cast<uint32_t>(wish("NC_FIRST_SEED", 1));
  for (uint32_t seed = from; seed < from + seeds(60, 20); ++seed) {
    SCOPED_TRACE(seed);
    const RandomProgram program = ModesMaker(seed).make();
    WholeRun run;
    {
      Bench bench(NC_DIALECT_M700, [](nc_config& c) { axes("XYZ")(c); });
      bench.tool(1, 4).param("1084", "0.1").var(101, 1);
      load_subs(bench, program);
      const Outcome done = bench.run(program.main);
      if (!done.alarm.empty() || done.steps.empty()) {
        ++alarms;
        continue;
      }
      for (const Step& step : done.steps) {
        if (step.item.kind == NC_ITEM_MOVE) run.moves.push_back(step.item);
        if (step.item.kind == NC_ITEM_MARK && step.item.u.mark.report) run.behind.push_back(run.moves.size());
      }
    }
    RestartMachine part(GetParam(), program.main);
    part.bench.var(101, 1);
    load_subs(part.bench, program);
    std::mt19937 random(seed);
    const uint64_t blocks = std::uniform_int_distribution<uint64_t>(1, run.behind.size() - 2)(random);
    nc_restart_place place = at_block(blocks);
    place.start_given = true;
    const nc_status status = part.find(place);
    if (status == NC_E_NOT_FOUND || status == NC_ENDED) {  // blocks hang together; between the end of what was called and that of the block that has called it
      ++nowhere;
      continue;
    }
    ASSERT_EQ(status, NC_OK) << part.drive->alarm() << " behind " << blocks << " blocks\n" << program.main;
    ++begun;
    part.enter();
    part.bring_axes();
    ASSERT_TRUE(part.at(part.found.machine));
    ASSERT_TRUE(part.to_end()) << part.drive->alarm() << " line " << part.drive->out.source.line << " cause " << int{part.drive->out.cause} << "\n" << program.main;
    EXPECT_LT(part.worst, 1.001);
    const std::vector<nc_axes> ends = part.drive->ends();
    const size_t first = run.behind[blocks - 1];
    ASSERT_EQ(ends.size(), run.moves.size() - first) << program.main;
    for (size_t i = 0; i < ends.size(); ++i)
      for (unsigned a = 0; a < kAxes; ++a) ASSERT_NEAR(ends[i].v[a], run.moves[first + i].u.move.machine.v[a], GetParam() ? 0.021 : 1e-6) << "move " << i << " line " << run.moves[first + i].source.line << "\n" << program.main;
  }
  EXPECT_GT(begun, 5u);
  EXPECT_LT(nowhere, begun / 4);
  std::printf("%u begun inside, %u programs with alarms, %u places between two blocks\n", begun, alarms, nowhere);
}

}  // namespace
}  // namespace nc::test
