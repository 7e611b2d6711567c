// SPDX-License-Identifier: Apache-2.0
// The same part written for each family gives the same path of the tool: where the manuals agree, so do the families. Where they do not, each
// difference has its row at the end.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/pull.hpp"

namespace nc::test {
namespace {

constexpr double kSame_mm = 0.001;

struct Family {
  nc_dialect dialect;
  const char* begin;  ///< what its programs begin with
  nc_tool_column radius;
};
// In m700 each offset has one value by default, radius or length.
constexpr Family kM700{NC_DIALECT_M700, "", NC_TOOL_LENGTH};
constexpr Family kHx{NC_DIALECT_HX, "", NC_TOOL_RADIUS};
constexpr Family kIso{NC_DIALECT_ISO, "", NC_TOOL_RADIUS};
constexpr Family kDgshape{NC_DIALECT_DGSHAPE, "%\n", NC_TOOL_RADIUS};
constexpr Family kAll[] = {kM700, kHx, kIso, kDgshape};
constexpr Family kSeries8{NC_DIALECT_SERIES8, "", NC_TOOL_RADIUS};

Outcome run_as(const Family& family, const std::string& text) {
  Bench bench(family.dialect);
  bench.tool(1, 3, family.radius);
  const Outcome run = bench.run(family.begin + text);
  EXPECT_EQ(run.alarm, "") << bench.config().dialect << ": " << run.alarm_detail;
  return run;
}

/// The moves of a run are those of another one.
void expect_same(const Outcome& run, const Outcome& as, const Family& family) {
  const std::vector<nc_move> moves = run.moves(), others = as.moves();
  ASSERT_EQ(moves.size(), others.size()) << family.dialect;
  ASSERT_FALSE(moves.empty());
  for (size_t i = 0; i < moves.size(); ++i) {
    SCOPED_TRACE("family " + std::to_string(family.dialect) + ", move " + std::to_string(i));
    EXPECT_EQ(moves[i].kind, others[i].kind);
    for (unsigned axis = 0; axis < 3; ++axis) EXPECT_NEAR(moves[i].machine.v[axis], others[i].machine.v[axis], kSame_mm) << axis;
    EXPECT_NEAR(moves[i].radius, others[i].radius, kSame_mm);
    EXPECT_NEAR(moves[i].length, others[i].length, kSame_mm);
    EXPECT_NEAR(moves[i].feed_mm_min, others[i].feed_mm_min, kSame_mm);
  }
}

TEST(SamePart, AContourWithCompensation) {
  const std::string text =
      "G17 G21 G40 G49 G80 G90 G54\nG00 X-15. Y-10. Z5.\nG01 Z-3. F200.\nG41 D1 G01 X0. Y-5. F400.\nY30.\nG02 X10. Y40. I10. J0.\nG01 X60.\nX70. Y20.\nY0.\nX-5.\n"
      "G40 G01 X-15. Y-10.\nG00 Z5.\nM30\n";
  const Outcome m700 = run_as(kM700, text);
  for (const Family& family : kAll) expect_same(run_as(family, text), m700, family);
}

TEST(SamePart, APocketOfArcsAndLines) {
  const std::string text =
      "G17 G21 G40 G90 G54\nG00 X40. Y25. Z2.\nG01 Z-1.5 F150.\nX46. F600.\nG03 X46. Y25. I-6. J0.\nG01 X52. Y25.\nY32.\nG03 X49. Y35. R3.\nG01 X28.\nY18.\nX52.\nY25.\n"
      "G91 G02 X-6. Y-6. R-6.\nG90 G00 Z2.\nM30\n";
  const Outcome m700 = run_as(kM700, text);
  for (const Family& family : kAll) expect_same(run_as(family, text), m700, family);
}

TEST(SamePart, ACircleOfHoles) {
  const std::string text =
      "G17 G21 G40 G90 G54\nM03 S1000\nG00 X0. Y0. Z20.\nG99 G81 X20. Y0. Z-5. R2. F120.\nX10. Y17.321\nX-10. Y17.321\nG98 X-20. Y0.\nG82 X-10. Y-17.321 Z-5. R2. P%s\n"
      "G80\nG00 X0. Y0.\nM05\nM30\n";
  const auto with_dwell = [&](const char* p) { return std::string(text).replace(text.find("%s"), 2, p); };
  const Outcome m700 = run_as(kM700, with_dwell("500"));
  for (const Family& family : kAll) {
    const Outcome run = run_as(family, with_dwell(family.dialect == NC_DIALECT_ISO ? "0.5" : "500"));  // RS-274/NGC 3.5.16.2: seconds
    expect_same(run, m700, family);
    EXPECT_EQ(run.dwells(), (std::vector<double>{0.5})) << family.dialect;
  }
}

// Those that have macros; RS-274 has the expressions.
TEST(SamePart, ARowOfHolesByAMacro) {
  const std::string loop =
      "G17 G21 G90 G54 G00 X0. Y0. Z10.\n#100=0\nWHILE [#100 LT 4] DO 1\nG00 X[10.+#100*12.5] Y[#100*2.]\nZ1.\nG01 Z-3. F100.\nG00 Z10.\n#100=#100+1\nEND 1\nM30\n";
  std::string line = "G17 G21 G90 G54 G00 X0. Y0. Z10.\n";
  for (int i = 0; i < 4; ++i) line += "#100=" + std::to_string(i) + "\nG00 X[10.+#100*12.5] Y[#100*2.]\nZ1.\nG01 Z-3. F100.\nG00 Z10.\n";
  const Outcome m700 = run_as(kM700, loop);
  expect_same(run_as(kHx, loop), m700, kHx);
  expect_same(run_as(kIso, line + "M30\n"), m700, kIso);
}

// The words of the Series 8 differ too much for one text: each part stands beside its twin.
TEST(SamePart, IsWrittenForTheSeries8InItsOwnWords) {
  struct Twin {
    const char *m700, *series8;
  };
  const Twin twins[] = {
      // A contour with compensation: a straight entry is G43, corners are G10, the centre has no sign.
      {"G17 G21 G40 G80 G90 G54\nG00 X-15. Y-10. Z5.\nG01 Z-3. F200.\nG41 D1 G01 X0. Y-5. F400.\nY30.\nG02 X10. Y40. I10. J0.\nG01 X60. ,R4.\nX70. Y20. ,C3.\nY0.\nX-5.\n"
       "G40 G01 X-15. Y-10.\nG00 Z5.\nM30\n",
       "G17G71G40G80G90\nG00X-15Y-10Z5\nG01Z-3F200\nD1\nG41G43G01X0Y-5F400\nY30\nG02X10Y40I10\nG01G10X60R4\nG10X70Y20L3\nY0\nX-5\nG40\nX-15Y-10\nG00Z5\nM30\n"},
      // A pocket of arcs and lines.
      {"G17 G21 G40 G90 G54\nG00 X40. Y25. Z2.\nG01 Z-1.5 F150.\nX46. F600.\nG03 X40. Y31. I-6. J0.\nX34. Y25. I0. J-6.\nX40. Y19. I6.\nX46. Y25. J6.\nG01 X52.\nY32.\nG03 X49. Y35. R3.\n"
       "G01 X28.\nY18.\nX52.\nY25.\nG91 G02 X-6. Y-6. R-6.\nG90 G00 Z2.\nM30\n",
       "G17G71G40G90\nG00X40Y25Z2\nG01Z-1.5F150\nX46F600\nG03X40Y31I6\nX34Y25J6\nX40Y19I6\nX46Y25J6\nG01X52\nY32\nG03X49Y35R3\nG01X28\nY18\nX52\nY25\nG68G02X-6Y-6R-6\nG00Z2\nM30\n"},
      // A circle of holes: R is where each one ends, P is in seconds, and the pecks have words of their own.
      {"G17 G21 G40 G90 G54\nM03 S1000\nG00 X0. Y0. Z20.\nG99 G81 X20. Y0. Z-5. R2. F120.\nX10. Y17.321\nG82 X-10. Y-17.321 P500\nG80\nG00 Z20.\nX0. Y0.\nM05\nM30\n",
       "G17G71G40G90\nM03S1000\nG00XYZ20\nG81X20YZ-5R2F120\nX10Y17.321\nG82X-10Y-17.321P.5\nG80\nG00Z20\nXY\nM05\nM30\n"},
      // The same shape turned and half as large about the zero point.
      {"G17 G21 G90 G54\nG68 X0. Y0. R30.\nG00 X20. Y0.\nG01 Y10. F100.\nG69\nG51 X0. Y0. P0.5\nG01 X40. Y30.\nX20. Y10.\nG50\nM30\n",
       "G17G71G90\nG55R30\nG00X20Y0\nG01Y10F100\nG56\nG57R.5\nG01X40Y30\nX20Y10\nG58\nM30\n"},
  };
  for (const Twin& twin : twins) {
    SCOPED_TRACE(twin.series8);
    expect_same(run_as(kSeries8, twin.series8), run_as(kM700, twin.m700), kSeries8);
  }
}

// ---- where they differ -----------------------------------------------------------------------------------------------------------

TEST(SamePart, WhereTheManualsDiffer) {
  struct Difference {
    const char* text;
    Path m700, hx, iso;
  };
  const Difference differences[] = {
      // M700 5.3, HX 8.4: a number without a point is in the least unit; RS-274/NGC 3.3.2.1: in mm
      {"G00 X1000\nM30\n", {"rapid 1 0 0"}, {"rapid 1 0 0"}, {"rapid 1000 0 0"}},
      // M700 3.7: G01 is in force at the start of a program, and has no feed yet; HX 3.2: G00
      {"X1.\nM30\n", {}, {"rapid 1 0 0"}, {"rapid 1 0 0"}},
      // M700 13.5.4: a word is what a formula gives; HX 14.2.4: rounded to the least unit
      {"G00 X[10./3.]\nM30\n", {"rapid 3.333333 0 0"}, {"rapid 3.333 0 0"}, {"rapid 3.333333 0 0"}},
      // M700 5.1: each word goes by the code in front of it; HX: one code for the block. RS-274 3.4: two are a fault
      {"G00 X1.\nG90 G91 X2.\nM30\n", {"rapid 1 0 0", "rapid 3 0 0"}, {"rapid 1 0 0", "rapid 3 0 0"}, {"rapid 1 0 0"}},
      {"G00 X1. Y1.\nG91 X2. G90 Y2.\nM30\n", {"rapid 1 1 0", "rapid 3 2 0"}, {"rapid 1 1 0", "rapid 2 2 0"}, {"rapid 1 1 0"}},
      // M700 14.4 (4): an increment in machine coordinates; HX 7.1.1: nothing; LinuxCNC G53: a fault
      {"G00 X1.\nG91 G53 X2.\nM30\n", {"rapid 1 0 0", "rapid 3 0 0"}, {"rapid 1 0 0"}, {"rapid 1 0 0"}},
      // M700 13.1.1: R takes the sign of Z in increments; HX 12.1.3: each has its own
      {"G00 Z20.\nG91 G99 G81 X1. Z-5. R-18. F100.\nG80\nM30\n",
       {"rapid 0 0 20", "rapid 1 0 20", "rapid 1 0 2", "line 1 0 -3 F100", "rapid 1 0 2"},
       {"rapid 0 0 20", "rapid 1 0 20", "rapid 1 0 2", "line 1 0 -3 F100", "rapid 1 0 2"},
       {"rapid 0 0 20", "rapid 1 0 20", "rapid 1 0 2", "line 1 0 -3 F100", "rapid 1 0 2"}},
      {"G00 Z20.\nG91 G99 G81 X1. Z-5. R3. F100.\nG80\nM30\n",
       {"rapid 0 0 20", "rapid 1 0 20", "rapid 1 0 17", "line 1 0 12 F100", "rapid 1 0 17"},
       {"rapid 0 0 20", "rapid 1 0 20", "rapid 1 0 23", "line 1 0 18 F100", "rapid 1 0 23"},
       {"rapid 0 0 20", "rapid 0 0 23", "rapid 1 0 23", "line 1 0 18 F100", "rapid 1 0 23"}},
  };
  for (const Difference& difference : differences) {
    EXPECT_EQ(Bench(NC_DIALECT_M700).run(difference.text).path(), difference.m700) << difference.text;
    EXPECT_EQ(Bench(NC_DIALECT_HX).run(difference.text).path(), difference.hx) << difference.text;
    EXPECT_EQ(Bench(NC_DIALECT_ISO).run(difference.text).path(), difference.iso) << difference.text;
  }
}

}  // namespace
}  // namespace nc::test
