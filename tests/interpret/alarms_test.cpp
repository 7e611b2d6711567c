// SPDX-License-Identifier: Apache-2.0
// Wrong programs: each raises the alarm of the manual in the right line, and the machine rests where the block before ended.
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

struct Row {
  const char* code;
  const char* program;
  unsigned line;
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.code << ": " << row.program; }

class M700Alarm : public testing::TestWithParam<Row> {};

TEST_P(M700Alarm, OnItsLineAndNothingMoved) {
  const Row& row = GetParam();
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    axes("XYZc")(c);
    c.system[0].axis[0].soft_limited = true;
    c.system[0].axis[0].soft_min = -500;
    c.system[0].axis[0].soft_max = 500;
  });
  bench.add("O9", "G67\nM99\n");
  bench.param("2106", "5", 'C').tool(1, 2);
  // The first block moves, so that the end of the block before differs from the start of the program.
  const Outcome run = bench.run("G0 X7.\nG1 F100\n" + std::string(row.program) + "\nX99.\nM30");
  EXPECT_EQ(run.alarm, row.code);
  EXPECT_EQ(run.alarm_line, row.line + 2);
  EXPECT_EQ(run.status, NC_ALARMED);
  EXPECT_FALSE(run.ended_ok);
  EXPECT_FALSE(run.alarm_detail.empty());
  ASSERT_GE(run.steps.size(), 2u);
  EXPECT_EQ(run.steps.back().item.kind, NC_ITEM_END);
  EXPECT_EQ(run.steps[run.steps.size() - 2].item.kind, NC_ITEM_ALARM);
  for (const nc_item& item : run.of(NC_ITEM_MOVE)) EXPECT_LT(item.source.line, run.alarm_line);
  const std::vector<nc_move> moves = run.moves();
  EXPECT_EQ(run.end_work.v[0], moves.back().work.v[0]);
  // The alarm can be read again, and the next program runs.
  Step step;
  EXPECT_EQ(bench.pull(&step), NC_ALARMED);
  EXPECT_TRUE(bench.run("M30").ended_ok);
}

const Row kRows[] = {
    {"P11", "U5.", 1},
    {"P20", "C7.", 1},
    {"P32", "X1. &", 1},
    {"P33", "X1. F", 1},
    {"P33", "G7", 1},
    {"P34", "G123.4", 1},
    {"P34", "G14", 1},
    {"P34", "G-1", 1},
    {"P34", "#1=-1\nG#1", 2},
    {"P34", "G[0-30]", 1},
    {"P34", "G100", 1},
    {"P35", "X123456.", 1},
    {"P36", "X8.\n%", 2},
    {"P37", "N0", 1},
    {"P37", "O0", 1},
    {"P435", "G27 X0 M9", 1},
    {"P430", "G29 X1.", 1},
    {"P436", "G29 X0 M9", 1},
    {"P39", "G54.1 P97", 1},
    {"P65", "G5 P3", 1},
    {"P62", "F0\nX8.", 2},
    {"P62", "F0\nG41 D1 I-20.", 2},  // no axis word, but the vector is a movement
    {"P70", "G2 X20. I3.", 1},
    {"P71", "G2 X20. R3.", 1},
    {"P74", "G2.4 X20. Y1.\nM8", 2},
    {"P75", "G2.4 X20. Y1.\nX30.\nG16", 3},
    {"P93", "G33 Z1. F0", 1},
    {"P35", "G33 Z1. F1. Q361.", 1},
    {"P482", "G7.1 C20.", 1},
    {"P112", "G41 D1 X20.\nG18 X30.", 2},
    {"P125", "G93\nG31 X9. F9", 2},
    {"P126", "G8 P1\nG61", 2},
    {"P130", "G0 A5", 1},
    {"P132", "G96 S0", 1},
    {"P141", "G68 X0 Y0 R30.\nG45 X1. D1", 2},
    {"P142", "G45 G2 X9. Y9. I5. D1", 1},
    {"P170", "G45 X1.", 1},
    {"P170", "G45 X1. D999", 1},
    {"P150", "G38 I1.", 1},
    {"P151", "G2 X9. I1.\nG41 D1 X20. I5.", 2},
    {"P151", "G1 X1.\nG41 D1\nG2 X9. I4.", 3},           // 12.4.1: wherever compensation is commanded, it starts with a straight movement ...
    {"P151", "G1 X1.\nG42 D1 X1.\nG3 X9. I4.", 3},
    {"P151", "G1 X1.\nG41 D1\nM8\nG2 X9. I4.", 4},
    {"P151", "G41 D0 G1 X1.\nD1\nG2 X9. I4.", 3},
    {"P151", "G41 D1 G1 X9.\nX20.\nG40\nG2 X29. I4.5", 4},  // ... and ends with one
    {"P151", "G41 D1 G1 X9.\nX20.\nD0\nG2 X29. I4.5", 4},
    {"P151", "G41 D1 G1 X9.\nX20.\nG40\nZ5.\nG2 X29. I4.5", 5},  // a movement across the plane does neither
    {"P151", "G41 D1 G1 X9.\nX20.\nG40\nZ5.\nG12 I20. D1", 5},
    {"P151", "G1 X1.\nG41 D1\nZ5.\nG2 X9. I4.", 4},
    {"P155", "G41 D1 G1 X9.\nX20.\nG40\nG81 Z-5. R2.", 4},  // the tool stands beside the place of the hole
    {"P155", "G41 D1 G1 X9.\nX20.\nG40\nZ5.\nG81 X20. Z-5. R2.", 5},
    {"P33", "G2.1 X9. P1", 1},                           // no centre
    {"P33", "G12 D1", 1},                                // no radius
    {"P155", "G41 D1 X20.\nG81 Z-5. R1.", 2},
    {"P170", "G43 H999 Z1.", 1},
    {"P170", "G41 X1.", 1},
    {"P172", "G10 L7 P1 R1.", 1},
    {"P33", "G10 P1 R1.5", 1},
    {"P33", "G10 L20 P1", 1},
    {"P173", "G10 L10 P999 R1.", 1},
    {"P180", "G77 Z-5. R1.", 1},
    {"P181", "G84 Z-5. R1. F1.", 1},
    {"P183", "G84 Z-5. R1. S100 ,R1", 1},
    {"P184", "G84 Z-5. R1. F1000. S100 ,R1", 1},
    {"P186", "G84 Z-5. R1. F1. S100 ,R1\nX5. S200", 2},
    {"P221", "G34 X0 Y0 I5. J0 K0", 1},
    {"P222", "G36 X0 Y0 I5. J0 P0 K4", 1},
    {"P223", "G12 I2. D1", 1},
    {"P230", "M98 H5\nN5 M98 H5", 2},
    {"P231", "GOTO 77", 1},
    {"P232", "M98 P77", 1},
    {"P241", "#99=1", 1},
    {"P242", "#100", 1},
    {"P243", "#1000=1", 1},
    {"P111", "G68 X0 Y0 R5.\nG18", 2},
    {"P272", "X1. #100=1", 1},
    {"P275", "G65 P9 I1I1I1I1I1I1I1I1I1I1I1", 1},
    {"P276", "G67", 1},
    {"P277", "#3000=1(STOP)", 1},
    {"P280", "#100=[[[[[[1]]]]]]", 1},
    {"P281", "#100=[1", 1},
    {"P282", "#100=SQRT[-1]", 1},
    {"P282", "#100=LN[0]", 1},
    {"P283", "#100=1/0", 1},
    {"P290", "IF[1 EQ 1] THEN #100=1", 1},
    {"P291", "WHILE[1 EQ 1] X1.", 1},
    {"P292", "SETVN500", 1},
    {"P294", "END1", 1},
    {"P296", "G65 A1.", 1},
    {"P920", "G68 X0 Y0 Z0 I1 J0 K0 R5.", 1},
    {"P380", "G81 X20. Z-1. R1. ,C2.", 1},
    {"P381", "X20. ,C2.\nG2 X30. I5.", 2},
    {"P382", "X20. ,C2.\nM8", 2},
    {"P383", "X8. ,C2.", 1},
    {"P384", "X20. ,C2.\nY1.", 2},
    {"P385", "G0 X20. ,C2.", 1},
    {"P390", "G0 X20. ,A45.", 1},
    {"P392", "A10.\nX20. Y9. A10.5", 2},
    {"P393", "A10.\nG91 X20. Y9. A50.", 2},
    {"P394", "A10.\nM8", 2},
    {"P395", "A10.\nX20. A50.", 2},
    {"P396", "A10.\nG19 X20. Y9. A50.", 2},
    {"P397", "A0\nG3 X20. Y50. R1.", 2},
    {"P33", "G30.1 X1.", 1},
    {"P452", "G22 X9. I7.\nX8.", 2},
    {"P438", "G54.1 P1\nG52 X1.", 2},
    {"P482", "G12.1", 1},
    {"P34", "G6.2 P4 K0 X7.", 1},
    {"P552", "G5 P10000\nG6.2 P4 K0 X8.", 2},
    {"P551", "G5 P10000\nG6.2 P2 K1 X7.\nX8. K0", 3},
    {"P604", "G37", 1},
    {"P605", "G37 Z-5. H1", 1},
    {"P606", "G37 Z-5.", 1},
    {"P603", "G31.1 X9.", 1},
    {"P603", "G31 X9.", 1},
    {"P608", "G41 D1 X20.\nG31 X30. F1", 2},
    {"P33", "G2.3 X1.", 1},
    {"P610", "G2.3 X1. I5. J5. R2. F100", 1},
    {"P900", "G41.1", 1},
    {"P930", "G43.1 H1", 1},
    {"P940", "G43.4 H1", 1},
    {"M01-0007", "X501.", 1},
};

std::string row_name(const testing::TestParamInfo<Row>& info) {
  std::string name = std::to_string(info.index) + "_";
  for (const char* c = info.param.code; *c != 0; ++c) name += *c == '-' ? '_' : *c;
  return name;
}

INSTANTIATE_TEST_SUITE_P(Codes, M700Alarm, testing::ValuesIn(kRows), row_name);

TEST(Alarm, InASubProgramNamesItsProgramAndLine) {
  Bench bench;
  bench.add("O9", "G0 X1.\n\nG67\nM99\n");
  bench.run("M98 P9\nM30");
  nc_alarm alarm{};
  ASSERT_EQ(nc_alarm_get(bench.control(), 0, &alarm), NC_OK);
  EXPECT_STREQ(alarm.code, "P276");
  EXPECT_EQ(alarm.source.program, 9u);
  EXPECT_EQ(alarm.source.line, 3u);
  EXPECT_EQ(alarm.source.depth, 1);
}

TEST(Alarm, IsThereFromItsItemToTheNextStart) {
  Bench bench;
  bench.start("G0 X1.\nG67\nM30");
  nc_alarm alarm{};
  EXPECT_EQ(nc_alarm_get(bench.control(), 0, &alarm), NC_E_NOT_FOUND);
  bench.finish();
  EXPECT_EQ(nc_alarm_get(bench.control(), 0, &alarm), NC_OK);
  EXPECT_EQ(nc_reset(bench.control(), 0), NC_OK);
  EXPECT_EQ(nc_alarm_get(bench.control(), 0, &alarm), NC_E_NOT_FOUND);
}

TEST(Alarm, AFileThatCannotBeRead) {
  struct Text {
    std::string s = "G0 X1.\nX2.\nM30\n";
    static long read(void* user, uint64_t offset, char* buffer, size_t size) {
      const std::string& s = static_cast<Text*>(user)->s;
      if (offset > 7) return -1;
      const size_t n = std::min<size_t>(size, 7);
      s.copy(buffer, n, offset);
      return static_cast<long>(n);
    }
  } text;
  Bench bench;
  unsigned file = 0;
  ASSERT_EQ(nc_program_add(bench.control(), "broken", &Text::read, &text, text.s.size(), &file), NC_OK);
  ASSERT_EQ(nc_program_select(bench.control(), 0, file), NC_OK);
  const Outcome run = bench.finish();
  EXPECT_EQ(run.alarm, "P461");
  EXPECT_EQ(run.status, NC_ALARMED);
}

TEST(Alarm, AFileCutInTheMiddleOfABlock) {
  const Outcome run = m700("G0 X1.\nX2. Y");
  EXPECT_EQ(run.alarm, "P33");  // half a word
  EXPECT_EQ(run.path(), (Path{"rapid 1 0 0"}));
  EXPECT_EQ(m700("G0 X1.\nM3").alarm, "P36");
}

struct DgshapeRow {
  const char* code;
  const char* program;
};

TEST(DgshapeAlarm, EveryErrorOfTheManual) {  // DGSHAPE 5
  const DgshapeRow rows[] = {
      {"NC-TOOL", "M06"},
      {"NC-TOOL", "T1"},
      {"NC-TOOL", "M06T1T2"},
      {"NC-TOOL", "M06M06T1"},
      {"NC-INCREMENTAL", "G91G53X1000"},
      {"NC-SPINDLE", "G81Z-1000F60000"},
      {"NC-OFFSET-START", "G2G41D1X20000I10000F60000"},
      {"NC-OFFSET-START", "G1G41D1X20000F60000\nX40000\nG3G40X60000I10000"},
      {"NC-OFFSET-CODE", "G1G41D1X20000F60000\nG18X30000"},
      {"NC-OFFSET-CODE", "G1G41D1X20000F60000\nG10P1R1000"},
      {"NC-OFFSET-CODE", "G1G41D1X20000F60000\nG80"},
      {"NC-OFFSET-CODE", "G1G41D1X20000F60000\nX30000\nG42X40000"},
      {"NC-OFFSET-CODE", "G1G41D1X20000F60000\nG50"},
      {"NC-OFFSET-CODE", "G1G41D1X20000F60000\nG55X30000"},
      {"NC-OFFSET-CODE", "G1G41D1X20000F60000\nG92X0"},
      {"NC-OFFSET-CODE", "M03\nG1G41D1X20000F60000\nG81Z-1000"},
      {"NC-OFFSET-CODE", "G1G41D1X20000F60000\nG28X0"},
      {"NC-PLANE", "G18G41D1X20000F60000"},
      {"NC-RANGE", "G0X100000."},
      {"NC-NO-SUCH-CODE", "G44"},
      {"NC-NO-SUCH-CODE", "G31X1000"},
      {"NC-WORDS", "G51X0Y0"},
      {"NC-FEED", "G1X1000"},
      {"NC-ADDRESS", "B1000"},
  };
  for (const DgshapeRow& row : rows) {
    Bench bench(NC_DIALECT_DGSHAPE);
    bench.tool(1, 2);
    EXPECT_EQ(bench.run("%\n" + std::string(row.program) + "\nM02").alarm, row.code) << row.program;
  }
}

std::string dgshape_alarm(const char* text) { return Bench(NC_DIALECT_DGSHAPE).run(text).alarm; }

TEST(Dgshape, ThePercentBlockHoldsNoWord) {  // DGSHAPE 1-1, 2-6
  for (const char* text : {"%G0X5.\nM02", "% O1\nM02", "%N1\nM02", "G90\n%\nM02", "M02", "N1\n%\nM02"})
    EXPECT_EQ(dgshape_alarm(text), "NC-START") << text;
  for (const char* text : {"%\nM02", "% \nM02", "%(part 1)\nM02", "% PART A\nM02", "\n\n%\nM02", "(head)\n%\nM02", "\r\n%\r\nM02\r\n% G0X5.\r\n"})
    EXPECT_EQ(dgshape_alarm(text), "") << text;
  EXPECT_EQ(m700("% G0X5.\nG0 X1.\nM30").path(), (Path{"rapid 1 0 0"}));  // M700: the rest of the line is text
}

TEST(Dgshape, OneProgramNumber) {  // DGSHAPE 1-1, 2-6; the comment example prints it behind "G90"
  EXPECT_EQ(dgshape("G90\nO0001\nG0X1.\nM02").path(), (Path{"rapid 1 0 0"}));
  EXPECT_EQ(dgshape("O1\nG0X1.\nO2\nM02").alarm, "NC-FORMAT");
  EXPECT_EQ(dgshape("G90\nO1\nG0X1.\nO2\nM02").alarm_line, 5u);
}

TEST(Alarm, DetailsNameWhatTheFamilyHas) {
  EXPECT_EQ(dgshape("G0X1.").alarm_detail, "The text of the program ends without M02 or M30.");
  EXPECT_EQ(m700("G0 X1.").alarm_detail, "The text of the program ends without M02 or M30.");
  Bench bench;
  bench.add("O5", "G0 X1.\n");
  EXPECT_EQ(bench.run("M98 P5\nM30").alarm_detail, "The text of the sub program ends without M99.");
  for (const char* block : {"#1=1+", "#1=SIN30", "#1=--5", "#1=[1+*2]"}) {
    const Outcome run = m700(std::string(block) + "\nM30");
    EXPECT_NE(run.alarm, "") << block;
    EXPECT_EQ(run.alarm_detail.find("no result"), std::string::npos) << block;
  }
}

TEST(Dgshape, SampleProgramOfSection16) {
  Bench bench(NC_DIALECT_DGSHAPE, [](nc_config& c) { c.system[0].axis[2].reference[0] = 100; });
  bench.tool(1, 3, NC_TOOL_RADIUS);
  // A square of the kind the manual prints: start to (8,8), the tool 3 mm to the left of the contour, back to the start.
  const Outcome run = bench.run(
      "%\nO0001\nN1G90G54\nN2G00X0Y0Z20000\nN3G41D1X8000Y8000\nN4G01Z-2000F120000\nN5Y43000F300000\nN6X42000\nN7Y8000\nN8X8000\n"
      "N9G40G00X0Y0\nN10Z20000\nN11M02\n%");
  EXPECT_EQ(run.alarm, "");
  EXPECT_TRUE(run.ended_ok);
  const Path path = run.path();
  ASSERT_GE(path.size(), 8u);
  EXPECT_EQ(path[1], "rapid 5 8 20");  // perpendicular to the next block in the plane, though Z comes between
  EXPECT_EQ(path[2], "line 5 8 -2 F120");
  EXPECT_EQ(path[3], "line 5 46 -2 F300");
  EXPECT_EQ(path[4], "line 45 46 -2 F300");
  EXPECT_EQ(path[path.size() - 2], "rapid 0 0 -2");
}

TEST(Sentences, AFormulaNamesWhatHasNoResult) {
  const auto detail = [](const std::string& formula) { return m700("#1=" + formula + "\nM30").alarm_detail; };
  EXPECT_EQ(detail("2+SQRT[-4]*ABS[3]"), "SQRT has no result for -4.");
  EXPECT_EQ(detail("SQRT[4]+ACOS[2]"), "ACOS has no result for 2.");
  EXPECT_EQ(detail("LN[1-1]"), "LN has no result for 0.");
  EXPECT_EQ(detail("5000000000 AND 1"), "AND has no result for 5000000000.");
  EXPECT_EQ(detail("1 OR 6000000000"), "OR has no result for 6000000000.");
  EXPECT_EQ(detail("BCD[123456789]"), "BCD has no result for 123456789.");
  EXPECT_EQ(detail("EXP[9999]"), "EXP has no result for 9999.");
  EXPECT_EQ(detail("1+TAN[90]"), "TAN 90: the formula divides by zero.");
  EXPECT_EQ(detail("7/[3-3]"), "/ 0: the formula divides by zero.");
  EXPECT_EQ(m700("G1 X[3*SQRT[0-9]] F1\nM30").alarm_detail, "SQRT has no result for -9.");
  EXPECT_EQ(detail("5+").substr(0, 36), "The formula is not written correctly");
}

}  // namespace
}  // namespace nc::test
