// SPDX-License-Identifier: Apache-2.0
// Rotation of the workpiece coordinate systems by parameter: G10 I J, G10 K, #8621 to #8627 (M700 13.21).
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "support/pull.hpp"

namespace nc::test {
namespace {

Path path_of(const std::string& text) { return m700("G90 G0\n" + text + "\nM30").path(); }
std::string alarm_of(const std::string& text) { return m700(text + "\nM30").alarm; }

TEST(WorkRotation, ByAngleAndByVector) {
  EXPECT_EQ(path_of("G10 K90.\nX10.\nY5."), (Path{"rapid 0 10 0", "rapid -5 10 0"}));
  EXPECT_EQ(path_of("G10 K-90.\nX10."), (Path{"rapid 0 -10 0"}));
  EXPECT_EQ(path_of("G10 I3. J4.\nX10."), (Path{"rapid 6 8 0"}));
  EXPECT_EQ(path_of("G10 I-1.\nX10."), (Path{"rapid -10 0 0"}));  // the other one as it is stored, 0
  EXPECT_EQ(path_of("G10 J2.\nG10 I2.\nX10.\nG10 I0 J0\nX20."), (Path{"rapid 7.071068 7.071068 0", "rapid 14.142136 14.142136 0"}));  // no vector
  EXPECT_EQ(path_of("G10 K90000\nX10."), (Path{"rapid 0 10 0"}));  // 0.001 deg
}

TEST(WorkRotation, Variables) {  // 13.5.5: #30060 to #30068, the coordinate rotation parameters
  const std::string read = "#100=#30060 #101=#30061 #102=#30062 #103=#30063 #104=#30064 #105=#30065 #106=#30066 #107=#30067 #108=#30068\n";
  const auto expect = [](const Outcome& run, const std::vector<double>& expected) {
    EXPECT_EQ(run.alarm, "");
    for (uint32_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(run.var(100 + i), expected[i], 1e-9) << i;
  };
  Bench bench;
  bench.param("8623", "10").param("8624", "20");
  expect(bench.run("G10 K30.\n" + read + "M30"), {1, 2, 10, 20, 30, 0.5, std::sqrt(0.75), 0, 0});
  bench.param("8621", "Y").param("8622", "Z");
  expect(bench.run("G10 I3. J4.\n" + read + "M30"), {2, 3, 10, 20, std::atan2(4, 3) * 180 / std::numbers::pi, 0.8, 0.6, 3, 4});
  expect(m700("G68 X1. Y2. R30.\n" + read + "M30"), {1, 2, 0, 0, 0, 0, 1, 0, 0});  // that of 13.20 is another rotation
}

TEST(WorkRotation, EverySystemTurnsAboutAPointOfTheMachine) {  // (1), (2)
  Bench bench;
  bench.work_offset(1, {10, 0, 0}).work_offset(2, {100, 0, 0}).work_offset(101, {0, 50, 0}).param("8623", "10").param("8624", "20");
  const Outcome run = bench.run("G10 K90.\nG0 X0 Y0\nG55 X0 Y0 Z3.\nG54.1 P1 X0 Y0\nG54 G52 X5.\nX0 Y0\nG92 Z7.\nX1.\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 30 20 0", "rapid 30 110 3", "rapid -20 10 3", "rapid 30 25 3", "rapid 30 26 3"}));
}

// 14.5, 14.10 (3): the place where the tool stands gets the commanded coordinates, also in systems that are turned: the words that name it move nothing.
TEST(WorkRotation, APositionThatIsSetIsThatOfTheProgram) {
  const auto path = [](const char* text) { return m700(std::string(text) + "\nM30").path(); };
  EXPECT_EQ(path("G10 K90.\nG0 X10. Y0\nG92 X0 Y0\nX0 Y0\nX5. Y0"), (Path{"rapid 0 10 0", "rapid 0 15 0"}));
  EXPECT_EQ(path("G10 K90.\nG0 X10. Y0\nG92 X3.\nX3. Y0\nX5. Y0"), (Path{"rapid 0 10 0", "rapid 0 12 0"}));  // Y stays what it was
  EXPECT_EQ(path("G10 K90.\nG0 X10. Y2.\nG92 X1. Y1.\nG91 X1.\nG90 X1. Y1."), (Path{"rapid -2 10 0", "rapid -2 11 0", "rapid -2 10 0"}));
  EXPECT_EQ(path("G0 X10. Y0\nG92 X0 Y0\nG10 K90.\nX5. Y0"), (Path{"rapid 10 0 0", "rapid 0 15 0"}));  // the printed order: set, then turned about the centre
  Bench bench;
  bench.param("8623", "10").param("8624", "20").work_offset(1, {1, 2, 0});
  EXPECT_EQ(bench.run("G10 K30.\nG0 X10. Y5.\nG92 X0 Y0\nX0 Y0\nG92 X7. Y8.\nX7. Y8.\nM30").path().size(), 1u);
}

TEST(WorkRotation, TheMachineAndTheCounterDoNotTurn) {  // (2), (3)
  const Outcome run = m700("G10 K90.\nG0 X10.\n#100=#5001 #101=#5002 #102=#5021 #103=#5022\nG53 X3. Y4.\nG28 X5. Y0\nM30");
  EXPECT_EQ(run.path(), (Path{"rapid 0 10 0", "rapid 3 4 0", "rapid 0 5 0", "rapid 0 0 0"}));
  EXPECT_EQ(run.work().front(), "rapid 0 10 0");
  EXPECT_NEAR(run.var(100), 0, 1e-9);
  EXPECT_NEAR(run.var(101), 10, 1e-9);
  EXPECT_NEAR(run.var(102), 0, 1e-9);
  EXPECT_NEAR(run.var(103), 10, 1e-9);
}

TEST(WorkRotation, OneAngleTakesThePlaceOfTheOther) {
  EXPECT_EQ(path_of("G10 K30.\nG10 K90.\nX10."), (Path{"rapid 0 10 0"}));
  EXPECT_EQ(path_of("G10 K90.\nX10.\nG10 K360.\nX10."), (Path{"rapid 0 10 0", "rapid 10 0 0"}));
}

TEST(WorkRotation, ActsWithTheNextMoveOfItsAxes) {  // (4), precaution (1)
  EXPECT_EQ(path_of("X10.\nG10 K90.\nZ1.\nX10."), (Path{"rapid 10 0 0", "rapid 10 0 1", "rapid 0 10 1"}));
  EXPECT_EQ(path_of("X10.\nG10 K90.\nG91 X5.\nX5."), (Path{"rapid 10 0 0", "rapid 0 15 0", "rapid 0 20 0"}));
  for (const char* next : {"G90 X15.", "G91 X5."})  // "canceled at the next movement command regardless of the G90 or G91 setting"
    EXPECT_EQ(path_of("G10 K90.\nX10.\nG10 K0\n" + std::string(next)), (Path{"rapid 0 10 0", "rapid 15 0 0"})) << next;
  EXPECT_EQ(path_of("X10.\nG10 K90.\nG10 K0\nG91 X5."), (Path{"rapid 10 0 0", "rapid 15 0 0"}));
}

TEST(WorkRotation, FirstMoveIsStraight) {  // precaution (2)
  EXPECT_EQ(alarm_of("F100\nG0 X10.\nG10 K15.\nG2 X20. R5."), "P70");
  EXPECT_EQ(alarm_of("F100\nG0 X10.\nG10 K15.\nG3 X0 Y10. I-10."), "P70");
  EXPECT_EQ(alarm_of("F100\nG0 X10.\nG10 K15.\nG2.1 X20. I5. P1"), "P70");
  EXPECT_EQ(alarm_of("F100\nG10 K15.\nG2 X20. I10."), "");  // from the centre of rotation: nothing is turned away
  EXPECT_EQ(alarm_of("F100\nG0 X10.\nG10 K15.\nG1 X10.\nG2 X20. I5."), "");
  EXPECT_EQ(alarm_of("F100\nG0 X10.\nG10 K15.\nG81 X5. Z-5. R-1."), "");
}

TEST(WorkRotation, ArcsInEveryPlane) {
  EXPECT_EQ(path_of("G10 K90.\nX10.\nG3 X0 Y10. I-10. F100\nG2 X10. Y0 R10."),
            (Path{"rapid 0 10 0", "ccw -10 0 0 c0,0 F100", "cw 0 10 0 c0,0 F100"}));
  Bench bench;
  bench.param("8621", "Z").param("8622", "X");  // the plane of G18, and its opposite sense for G18 with X, Z
  EXPECT_EQ(bench.run("G18 G10 K90.\nG0 Z10.\nG3 Z0 X10. K-10. F100\nM30").path(), (Path{"rapid 10 0 0", "ccw 0 0 -10 c0,0 F100"}));
  bench.param("8621", "X").param("8622", "Z");
  EXPECT_EQ(bench.at(0, 0, 0).run("G18 G10 K90.\nG0 Z10.\nG3 Z0 X10. K-10. F100\nM30").path(), (Path{"rapid -10 0 0", "ccw 0 0 10 c0,0 F100"}));
  for (const char* block : {"G18 G2 X2. R1.", "G19 G3 Z2. J1.", "G18 G41 D1 X9.", "G18 G81 X1. Y-5. R-1."})  // planes that it tilts
    EXPECT_EQ(alarm_of("F100\nG10 K15.\nG1 X1. Y1.\n" + std::string(block)), "P113") << block;
  EXPECT_EQ(alarm_of("F100\nG18 G41 D1 G1 X9.\nG10 K15."), "P113");
}

TEST(WorkRotation, RadiusCompensationIsThatOfTheTurnedPath) {
  Bench bench;
  bench.tool(1, 2);
  const char* shape = "G1 G41 D1 X20. Y0 F100\nX20. Y30.\nX40. I3. J1. G41\nG40 X50. Y30. I1. J2.\n";
  const std::vector<nc_move> plain = bench.run(std::string("G90 G1 X1. F100\n") + shape + "M30").moves();
  const std::vector<nc_move> turned = bench.at(0, 0, 0).run(std::string("G90 G10 K90.\nG1 X1. F100\n") + shape + "M30").moves();
  ASSERT_EQ(plain.size(), turned.size());
  for (size_t i = 0; i < plain.size(); ++i) {
    EXPECT_NEAR(turned[i].machine.v[0], -plain[i].machine.v[1], 1e-9) << i;
    EXPECT_NEAR(turned[i].machine.v[1], plain[i].machine.v[0], 1e-9) << i;
  }
}

TEST(WorkRotation, IsBehindTheMapsOfTheProgram) {
  EXPECT_EQ(path_of("G10 K90.\nG51.1 X0\nX10. Y5."), (Path{"rapid -5 -10 0"}));
  EXPECT_EQ(path_of("G10 K90.\nG51 X0 Y0 P2.\nX10. Y5."), (Path{"rapid -10 20 0"}));
  EXPECT_EQ(path_of("G10 K90.\nG68 X10. Y0 R90.\nX20. Y0"), (Path{"rapid -10 10 0"}));
  EXPECT_EQ(path_of("G10 K90.\nX10.\nG68 R90.\nX20. Y0"), (Path{"rapid 0 10 0", "rapid -10 10 0"}));  // its centre where the program stands
  EXPECT_EQ(path_of("G10 K90.\nX10.\nG91 G68 R90.\nX5. Y0"), (Path{"rapid 0 10 0", "rapid -5 10 0"}));
  Bench bench;
  bench.add("O1", "G1 X10. Y10. F100\nX0 Y10.\nM99\n");
  EXPECT_EQ(bench.run("G90 G10 K90.\nG0 X10.\nM98 P1 L2 I-10.\nM30").path(),
            (Path{"rapid 0 10 0", "line -10 10 0 F100", "line -10 0 0 F100", "line -10 -10 0 F100", "line 0 -10 0 F100"}));
}

TEST(WorkRotation, HolesOfACycle) {
  EXPECT_EQ(path_of("Z10.\nG10 K90.\nG81 X5. Y1. Z-8. R2. F100\nX6."),
            (Path{"rapid 0 0 10", "rapid -1 5 10", "rapid -1 5 2", "line -1 5 -8 F100", "rapid -1 5 10", "rapid -1 6 10", "rapid -1 6 2",
                  "line -1 6 -8 F100", "rapid -1 6 10"}));
}

TEST(WorkRotation, PrintedExample) {  // pallet: the shape of each system stands turned about the machine's zero
  Bench bench;
  bench.tool(1, 0).work_offset(1, {100, 0, 0}).work_offset(2, {0, 200, 0});
  const std::string shape = "G91 G1 G42 D1 F300\nX100.\nG3 Y50. R25.\nG1 X-100.\nG3 Y-50. R25.\nG1 G40\n";
  const Outcome run = bench.run("G10 K15.\nG90 G54 G0 X0 Y0\n" + shape + "G90 G55 G0 X0 Y0\n" + shape + "M30");
  ASSERT_EQ(run.alarm, "");
  const std::vector<nc_move> moves = run.moves();
  ASSERT_EQ(moves.size(), 10U);
  const double c = std::cos(std::numbers::pi / 12), s = std::sin(std::numbers::pi / 12);
  const double ends[5][2] = {{0, 0}, {100, 0}, {100, 50}, {0, 50}, {0, 0}};
  for (size_t i = 0; i < 10; ++i) {
    const double x = ends[i % 5][0] + (i < 5 ? 100 : 0), y = ends[i % 5][1] + (i < 5 ? 0 : 200);
    EXPECT_NEAR(moves[i].machine.v[0], c * x - s * y, 1e-6) << i;
    EXPECT_NEAR(moves[i].machine.v[1], s * x + c * y, 1e-6) << i;
  }
}

/// Pieces of programs; '%' is a number, '$' another.
constexpr const char* kPieces[] = {
    "G0 X% Y$", "G1 X% Y$", "G91 X%\nG90", "G1 X0 Y%\nG2 X20. Y% I10.", "G1 X0 Y0\nG3 X12. Y9. R10.",
    "G0\nG41 D1 X% Y$\nG1 X40. Y$\nX40. Y60.\nG40 X80. Y9.", "G0 Z10.\nG81 X% Y$ Z-5. R1.\nX9.\nG80",
    "G68 X% Y$ R33.\nG0 X$\nG69", "G51 X% Y$ P1.5\nG1 X5. Y%\nG50", "G51.1 X%\nG1 X$ Y%\nG50.1",
    "G55 G0 X% Y$\nG54 X0 Y0", "G52 X%\nG1 X$ Y%\nG52 X0", "G0 X20. Y0\nM98 P1 L3 I-20. J0"};

std::string random_program(std::mt19937& random) {
  const auto number = [&random] {
    const std::string text = brief(static_cast<double>(random() % 60000) / 1000 - 30);
    return text.find('.') == std::string::npos ? text + '.' : text;
  };
  std::string program = "G90 G0 X1. Y1.\nF100\n";
  for (unsigned piece = 0; piece < 8; ++piece) {
    const std::string first = number(), second = number();
    for (const char* c = kPieces[random() % std::size(kPieces)]; *c != 0; ++c)
      program += *c == '%' ? first : *c == '$' ? second : std::string(1, *c);
    program += '\n';
  }
  return program + "M30";
}

TEST(WorkRotation, WholeProgramsAreTurned) {
  std::mt19937 random(13);
  size_t compared = 0;
  for (unsigned n = 0; n < 100; ++n) {
    const std::string text = random_program(random);
    const auto run = [&](const char* angle) {
      Bench bench;
      bench.add("O1", "G51 X20. Y0 P0.5\nG1 X24. Y3.\nX20. Y0\nG50\nG51.1 Y1.\nX22. Y3.\nG50.1\nX0 Y20.\nM99\n");
      bench.tool(1, 1.5).work_offset(1, {2, 0, 0}).work_offset(2, {7, -3, 0});
      bench.param("8623", "5").param("8624", "-8").param("8627", angle);
      return bench.run(text);
    };
    const Outcome plain = run("0"), turned = run("37");
    ASSERT_EQ(plain.alarm, turned.alarm) << text << turned.alarm_detail;
    const std::vector<nc_move> before = plain.moves(), after = turned.moves();
    ASSERT_EQ(before.size(), after.size()) << text;
    const double c = std::cos(37 * std::numbers::pi / 180), s = std::sin(37 * std::numbers::pi / 180);
    for (size_t i = 0; i < before.size(); ++i, ++compared) {
      const double x = before[i].machine.v[0] - 5, y = before[i].machine.v[1] + 8;
      ASSERT_NEAR(after[i].machine.v[0], 5 + c * x - s * y, 1e-6) << text << i;
      ASSERT_NEAR(after[i].machine.v[1], -8 + s * x + c * y, 1e-6) << text << i;
      ASSERT_NEAR(after[i].machine.v[2], before[i].machine.v[2], 1e-9) << text << i;
      ASSERT_EQ(after[i].kind, before[i].kind) << text << i;
      ASSERT_EQ(after[i].ccw, before[i].ccw) << text << i;
    }
  }
  EXPECT_GT(compared, 1000U);
}

TEST(WorkRotation, ParametersOfTheFamily) {
  Bench bench;
  bench.param("8627", "90").param("8623", "10");
  // "Validated with the cycle start"; increments count from where the axes stand.
  EXPECT_EQ(bench.at(10, 0, 0).run("G0 X20.\nM30").path(), (Path{"rapid 10 10 0"}));
  EXPECT_EQ(bench.at(10, 0, 0).run("G91 G0 X5.\nM30").path(), (Path{"rapid 10 5 0"}));
  // What G10 sets stays after the end of the program.
  EXPECT_EQ(bench.at(0, 0, 0).run("G10 I0 J2.\nM30").alarm, "");
  double value = 0;
  for (const auto& [key, expected] : {std::pair{"8625", 0.0}, {"8626", 2.0}, {"8627", 90.0}}) {
    EXPECT_EQ(nc_parameter_get(bench.control(), 0, key, 0, &value), NC_OK);
    EXPECT_EQ(value, expected) << key;
  }
  EXPECT_EQ(bench.run("G10 K-15.5\nM30").alarm, "");
  for (const auto& [key, expected] : {std::pair{"8625", 0.0}, {"8626", 0.0}, {"8627", -15.5}}) {
    EXPECT_EQ(nc_parameter_get(bench.control(), 0, key, 0, &value), NC_OK);
    EXPECT_EQ(value, expected) << key;
  }
  // Parameters that are set by 13.11 act at once, too; a vector that is entered as data causes no calculation (precaution (3)).
  EXPECT_EQ(Bench().run("G0 X10.\nG10 L70\nP8627 D90.\nG11\nG91 X5.\nM30").path(), (Path{"rapid 10 0 0", "rapid 0 15 0"}));
  EXPECT_EQ(Bench().run("G10 L70\nP8625 D1.\nP8626 D1.\nG11\nG0 X10.\nM30").path(), (Path{"rapid 10 0 0"}));
  EXPECT_EQ(nc_parameter_set(bench.control(), 0, "8627", 0, "361"), NC_E_ARGUMENT);
  EXPECT_EQ(nc_parameter_set(bench.control(), 0, "8621", 0, "Q"), NC_OK);
  EXPECT_EQ(bench.at(0, 0, 0).run("G0 X10.\nM30").alarm, "P11");  // no such axis
}

TEST(WorkRotation, Words) {
  EXPECT_EQ(alarm_of("G10 K361."), "P35");
  EXPECT_EQ(alarm_of("G10 K-360."), "");
  EXPECT_EQ(alarm_of("G10 I1000000. J1."), "P35");
  EXPECT_EQ(alarm_of("G10 I1. J-1000000."), "P35");
  EXPECT_EQ(alarm_of("G10 I1. K30."), "P33");
  EXPECT_EQ(alarm_of("G10 I0 J0 K30."), "");
  EXPECT_EQ(alarm_of("G10 X5. K30."), "P33");
  EXPECT_EQ(alarm_of("G10 P1 R5. K30."), "P33");
  EXPECT_EQ(alarm_of("G10 L2 P1 X5. K30."), "");  // a work offset: K has no meaning there
}

TEST(WorkRotation, RewindTakesItBack) {
  Bench bench;
  bench.start("G0 X10.\nG10 K90.\nX20.\nM30");
  Step step;
  uint64_t first = 0;
  nc_axes at{};
  while (bench.pull(&step) == NC_OK)
    if (first == 0 && step.item.kind == NC_ITEM_MARK) first = step.item.serial, at = step.machine;
  double value = 0;
  nc_parameter_get(bench.control(), 0, "8627", 0, &value);
  ASSERT_EQ(value, 90);
  ASSERT_EQ(bench.rewind(first, at), NC_OK);
  nc_parameter_get(bench.control(), 0, "8627", 0, &value);
  EXPECT_EQ(value, 0);
  EXPECT_EQ(bench.finish().path(), (Path{"rapid 0 20 0"}));
}

TEST(WorkRotation, MillingModesAndExponentialCurvesExcludeIt) {  // 6.11 (3); as the rotation of 13.20
  const auto alarm = [](const char* text) {
    Bench bench(NC_DIALECT_M700, axes("XYZc"));
    bench.param("1516", "C").param("1030", "C").param("1514", "X").param("1515", "C");
    return bench.run(std::string(text) + "\nM30").alarm;
  };
  EXPECT_EQ(alarm("G10 K30.\nG12.1"), "P485");
  EXPECT_EQ(alarm("G12.1\nG10 K30."), "P481");
  EXPECT_EQ(alarm("G10 K30.\nG1 X0 Y0 F9\nG10 K0\nG0 X1.\nG12.1"), "");
  EXPECT_EQ(alarm("G10 K30.\nG2.3 X10. I80. J80. R105. F500"), "P612");
}

}  // namespace
}  // namespace nc::test
