// SPDX-License-Identifier: Apache-2.0
// Of which other family a program with an alarm is, as `ncsim check` says it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "places/places.hpp"
#include "tools/command_fixture.hpp"
#include "tools/lib/codes_of_line.hpp"
#include "tools/lib/dialect_names.hpp"
#include "tools/lib/other_dialects.hpp"

namespace nc::tools {
namespace {

class OtherDialects : public CommandTest {};

TEST_F(OtherDialects, CheckSaysWhichOtherDialectReadsTheProgram) {
  file("ngc.nc", "G21 ; millimetres\n#<depth> = 2\nG0 X1\nG1 Z[-#<depth>] F100\nM2\n");
  const Outcome ngc = ncsim("check ngc.nc");
  EXPECT_EQ(ngc.code, 2);
  EXPECT_NE(ngc.err.find("note: this looks like a program of iso, as which it ends without an alarm; try --dialect iso\n"), std::string::npos) << ngc.err;
  file("m700.nc", "#500=1\nWHILE [#500 LE 3] DO1\nG0 X#500\n#500=#500+1\nEND1\nM30\n");
  EXPECT_EQ(ncsim("check m700.nc").err, "");
  EXPECT_NE(ncsim("check --dialect iso m700.nc").err.find("looks like a program of m700 or hx,"), std::string::npos);
  file("s8.nc", "G71G90G94\nF100\nG00X10Y0Z5\nG01Z-1\nG03X0Y10I10\nG00XYZ5 ; BACK\nM30\n");
  for (const char* other : {"m700", "dgshape", "iso", "hx"})
    EXPECT_NE(ncsim(std::string("check --dialect ") + other + " s8.nc").err.find("looks like a program of series8,"), std::string::npos) << other;
  EXPECT_EQ(ncsim("check --dialect series8 s8.nc").err, "");
  EXPECT_NE(ncsim("check --dialect series8 ngc.nc").err.find("looks like a program of iso,"), std::string::npos);
  // What no family reads has no such note.
  file("none.nc", "G0 X1.\nG1 X2.\nM30\n");
  EXPECT_EQ(ncsim("check none.nc").err.find("looks like a program of"), std::string::npos);
  // A setup belongs to the family of before: the others are tried without it. What it does wrong is no sign of another family.
  file("s.json", "{\"axes\": [\"X\", \"Y\"]}");
  EXPECT_NE(ncsim("check --setup s.json ngc.nc").err.find("looks like a program of iso,"), std::string::npos);
  file("z.nc", "G00 X1.\nZ1.\nM30\n");
  EXPECT_EQ(ncsim("check --setup s.json z.nc").code, 2);
  EXPECT_EQ(ncsim("check --setup s.json z.nc").err.find("looks like a program of"), std::string::npos);
}

// A program of each family, as it is written there, has an alarm in each other one, and its own is named.
TEST_F(OtherDialects, AProgramOfAnotherFamilyIsRecognised) {
  const std::map<std::string, std::string> programs = {
      {"m700", "O1\n#100=1\nWHILE [#100 LE 3] DO1\nG00 G90 X[#100*10.] Y0\nG43 H1 Z5.\nG99 G81 Z-2. R1. F100\n#100=#100+1\nEND1\nG80\nG51.1 X0\nG00 X5.\nG50.1 X0\nG28 Z0\nM30\n"},
      {"dgshape", "%\nO0001\nG21G17G90\nG28G91Z0\nG90\nG10P1R1.5\nM06T1\nG54\nS60\nM03\nG00X10000Y10000\nZ5000\nG01Z-1000F600000\nX20000\nG00Z5000\nM05\nM06T0\nM30\n%\n"},
      {"iso", "%\n(pocket)\nG21 G17 G90 G64 P0.02 G40 G49 G80\nM6 T1 G43\nS12000 M3\nG0 X10 Y10\nG0 Z5\nG1 Z-1 F300\nG2 X20 Y20 I10 J0 F800\nG4 P0.5\n#<top> = 5 ; up\nG0 Z#<top>\nM5\nM2\n%\n"},
      {"hx", "O0200\nG17 G21 G90 G54 G113\nT1 M06\nS900 M03\nG00 X10. Y10. ; START\nG51 X0 Y0 I-1000 J1000\nG01 Z-1. F100\nX20.\nG50\nG84.2 X5. Z-3. R1. F450\nG80\nG00 Z5.\nM30\n"},
      {"series8", "; PLATE\nG71G90G17G94\nT01D01\nM06\nM03 S6000\nG00X10Y0Z5\nF400\nG01Z-1\nG03X0Y10I10\nG01G10X-20L2\nY20\nG00XYZ5\nM30\n"},
  };
  ASSERT_EQ(programs.size(), dialect_names().size());
  for (const auto& [name, text] : programs) {
    file(name + ".nc", text);
    EXPECT_EQ(ncsim("check --dialect " + name + " " + name + ".nc").code, 0) << name << ncsim("check --dialect " + name + " " + name + ".nc").out;
    for (const std::string& other : dialect_names()) {
      if (other == name) continue;
      const Outcome check = ncsim("check --dialect " + other + " " + name + ".nc");
      EXPECT_EQ(check.code, 2) << name << " as " << other << check.out;
      const size_t says = check.err.find("note: this looks like a program of "), names = check.err.find(name, says), end = check.err.find(", as which", says);
      EXPECT_TRUE(says != std::string::npos && names < end) << name << " as " << other << ": " << check.out << check.err;
    }
  }
}

// The parts that are shipped, each as a program of each other family: with a slip of its own, a sub program that is missing, and a code that needs a parameter
// (G101 of bracket.nc), it is of its own family all the same. In its own family a slip is no sign of another one.
TEST_F(OtherDialects, APartWithMistakesIsRecognised) {
  struct Part {
    const char *family, *file, *slip, *call;
  };
  const std::vector<Part> parts = {{"hx", "bracket.nc", "G01 X\n", "M98 P7777\n"},
                                   {"dgshape", "keytag.nc", "G01X1.Y\n", ""},
                                   {"iso", "plate.ngc", "G1 X\n", "M98 P7777\n"},
                                   {"series8", "jig-plate.s8", "G02X1Y1I-3\n", ""},
                                   {"m700", "every-cycle.nc", "G01 X\n", "M98 P7777\n"}};
  for (const Part& part : parts) {
    const std::string text = content(std::string(nc::test::kSourceDir) + "/examples/parts/" + part.file);
    const size_t middle = text.find('\n', text.size() / 2) + 1;
    file("part.nc", text.substr(0, middle) + part.slip + part.call + text.substr(middle));
    const Outcome own = ncsim(std::string("check --dialect ") + part.family + " part.nc");
    EXPECT_EQ(own.code, 2) << part.family;
    EXPECT_EQ(own.err.find("looks like"), std::string::npos) << part.family << own.err;
    for (const std::string& other : dialect_names()) {
      if (other == part.family) continue;
      const Outcome check = ncsim("check --dialect " + other + " part.nc");
      EXPECT_NE(check.err.find(std::string("note: this looks like a program of ") + part.family + ", as which "), std::string::npos)
          << part.family << " as " << other << ": " << check.out << check.err;
    }
  }
}

// A mistake of its own that another family has another rule for is no sign of that family.
TEST_F(OtherDialects, AMistakeIsNoSignOfAnotherFamily) {
  const std::vector<std::pair<std::string, std::string>> programs = {
      {"m700", "G00 X0 Y0\nG02 X10. Y0 R2. F100\nM30\n"},         // Series 8 takes half the chord
      {"m700", "G91 G00 X1.\nG31 X5. F0\nM30\n"},                 // no feed of the skip
      {"dgshape", "%\nG21G90\nG00X1.\nG81X1.Z-1.R2.F100.\nM02\n%\n"},  // the spindle stands
      {"hx", "G00 X0 Y0\nG03 X10. Y0 R2. F100\nM30\n"},
      {"iso", "G0 X1\nG1 X2\nM2\n"},
  };
  for (const auto& [family, text] : programs) {
    file("p.nc", text);
    const Outcome check = ncsim("check --dialect " + family + " p.nc");
    EXPECT_EQ(check.code, 2) << family << text;
    EXPECT_EQ(check.err.find("looks like"), std::string::npos) << family << text << check.err;
  }
}

// A family that reads every line is not passed over for one that refuses some of them, whose gaps look like many mistakes of the family in between. Printed
// in the manual of the Series 8 (G57).
TEST_F(OtherDialects, TheOneThatReadsMoreIsNamed) {
  file("s8.nc", "G90G71G17G94\nG00X5Y5 ;move 1\nG57R.5;turn on scaling with a factor of .5\nG01F50X6 ;move 2\nY10 ;move 3\nX8Y12 ;move 4\nG58 ;turn off scaling\nM30\n");
  EXPECT_EQ(ncsim("check --dialect series8 s8.nc").code, 0);
  for (const char* other : {"m700", "dgshape", "iso", "hx"})
    EXPECT_NE(ncsim(std::string("check --dialect ") + other + " s8.nc").err.find("looks like a program of series8,"), std::string::npos) << other;
  file("macro.nc", "G90 G17 G94 G21\n#111=123\n#112=5.55\nG00 X#111 Y#112\n#113=#111+#112\n#114=#111-#112\n#115=#111*#112\n#116=#111/#112\n#117=#112/#111\nG00 X#116 Y#117\nM30\n");
  EXPECT_NE(ncsim("check --dialect series8 macro.nc").err.find("looks like a program of m700 or hx,"), std::string::npos);
}

TEST_F(OtherDialects, AProgramFromStandardInputIsRecognised) {
  file("ngc.nc", "G21 ; millimetres\n#<depth> = 2\nG0 X1\nG1 Z[-#<depth>] F100\nM2\n");
  EXPECT_NE(ncsim("check - < ngc.nc").err.find("looks like a program of iso,"), std::string::npos);
}

// Numbers with and without a point, as DGSHAPE 1-5 prints them side by side, are no sign of another family where one of them would be metres away.
TEST_F(OtherDialects, LengthsThatMachinesDoNotHaveAreThousandths) {
  file("p.nc", "%\nG90G21G17G54\nG10L2P1X10.Y20.\nG10L2P6X-5000Z-2000\nG00X0Y0Z0\nG59X1.Y1.Z1.\nM02\n");
  EXPECT_EQ(ncsim("check --dialect dgshape p.nc").code, 0);
  EXPECT_EQ(ncsim("check --dialect dgshape p.nc").err.find("looks like"), std::string::npos);
}

// A few blocks, of which each line that shows it stands behind another one: a code that the family does not have is no consequence of the alarm in front of it,
// and it tells more than what the other family finds in this line (a probe that has not touched).
TEST_F(OtherDialects, AShortProgramIsRecognised) {
  file("named.nc", "#<a>=1\nG0 X#<a>\nG64 P0.01\nG38.2 Z-5 F10\nM2\n");
  for (const char* other : {"m700", "dgshape", "hx", "series8"})
    EXPECT_NE(ncsim(std::string("check --dialect ") + other + " named.nc").err.find("looks like a program of iso,"), std::string::npos) << other;
  file("comment.nc", "%\nG0 X1. ; hi\nG64 P0.01\nM30\n");
  EXPECT_NE(ncsim("check --dialect dgshape comment.nc").err.find("looks like a program of iso,"), std::string::npos);
  // One code that the m700 does not have, and lengths that are mm without a point.
  const std::string loop = "G55R45\nG01F50X10\nG87 X5. Y6. R3.5 Z3.0 F20.\nR2.0 Z1.0\nG06X1Y1\nM30\n";
  file("loop.nc", loop);
  for (const char* other : {"m700", "dgshape", "iso", "hx"})
    EXPECT_NE(ncsim(std::string("check --dialect ") + other + " loop.nc").err.find("looks like a program of series8,"), std::string::npos) << other;
  // One such code alone, or twice in two lines, is a slip.
  file("slip.nc", "G00 X1. Y1.\nG06 X2. Y2.\nM30\n");
  EXPECT_EQ(ncsim("check slip.nc").err.find("looks like"), std::string::npos);
  file("slip.nc", "G00 X1. Y1.\nG06 X2. Y2.\nG06 X3. Y3.\nM30\n");
  EXPECT_EQ(ncsim("check slip.nc").err.find("looks like"), std::string::npos);
  // Neither is a word behind a cycle that is refused: without its cycle it is refused as well.
  file("cycle.nc", "G00 X0. Y0. Z5.\nG82 X1. Z-1. R1. P0.5 F100\nX2. P0.7\nM30\n");
  EXPECT_EQ(ncsim("check --dialect hx cycle.nc").err.find("looks like"), std::string::npos);
}

TEST(CodesOfLine, AreThoseOutsideOfComments) {
  EXPECT_EQ(codes_of_line(NC_DIALECT_ISO, "N10 G90g1 X2 (G4) G38.2G 0 5. ; G7"), (CodeSet{900, 10, 382, 50}));
  EXPECT_EQ(codes_of_line(NC_DIALECT_M700, "IF [#1 EQ 1] GOTO 12"), CodeSet());
  EXPECT_EQ(codes_of_line(NC_DIALECT_M700, "G#1 G[2] G123456 G-4 ,G5"), CodeSet());
  EXPECT_EQ(codes_of_line(NC_DIALECT_M700, "G90 G1.2.3 G3"), (CodeSet{900, 12})) << "up to the second point";
  EXPECT_EQ(codes_of_line(NC_DIALECT_M700, "G G5"), (CodeSet{50})) << "G alone is a word without a number";
  // A name and a formula are none; what stands behind a fault is not looked at.
  EXPECT_EQ(codes_of_line(NC_DIALECT_ISO, "G1 X#<g4_x> F[100 + #<g7>] G90"), (CodeSet{10, 900}));
  EXPECT_EQ(codes_of_line(NC_DIALECT_ISO, "G1 X#<g4_x> #<g8>=2 G90"), (CodeSet{10}));
  EXPECT_EQ(codes_of_line(NC_DIALECT_DGSHAPE, "G1 X1 #<g8>"), (CodeSet{10}));
  EXPECT_EQ(codes_of_line(NC_DIALECT_M700, "G90G10L2P1,C1G1"), (CodeSet{900, 100, 10}));
  const CodeSet own = codes_of_family(NC_DIALECT_SERIES8);
  EXPECT_EQ(own.count(60), 1u);
  EXPECT_EQ(own.count(640), 0u);
  EXPECT_EQ(codes_of_family(NC_DIALECT_ISO).count(382), 1u);
  EXPECT_EQ(codes_of_family(NC_DIALECT_M700).count(710), 1u);
  EXPECT_EQ(codes_of_family(NC_DIALECT_M700, true).count(710), 0u) << "listed, and not there";
}

/// The note about `text` as a program of `own`, and how much was read for it.
std::string note_about(const std::string& own, const std::string& text, uint64_t* work = nullptr) {
  SessionOptions options;
  options.program = "p.nc";
  options.dialect = own;
  options.dialect_given = true;
  options.text = text;
  return other_dialect_note(options, RunLimits(), own, false, work);
}

// What is read for the note has a bound, however long the program is, and whatever it does; a long program is recognised all the same.
TEST(OtherDialectsOfALongProgram, AreFoundByABoundedNumberOfBlocks) {
  const uint64_t bound = kMostReadByFamily * dialect_names().size();
  std::string lines = "G21G90\nG1X0.F200\n";
  for (int i = 0; i < 100'000; ++i) lines += i % 2 == 0 ? "X1.Y2.\n" : "X2.Y1.\n";
  std::string slips;
  for (int i = 0; i < 12; ++i) slips += "G01 X\n";
  uint64_t work = 0;
  EXPECT_NE(note_about("m700", lines + slips + "M30\n", &work).find("looks like a program of series8,"), std::string::npos);
  EXPECT_GE(work, 400'000u) << "both have read it to its end";
  EXPECT_LE(work, bound);
  // The lines of slips are behind the loop, which each run of each family would go through again.
  const std::string loop = "#1=0\nWHILE [#1 LT 100000] DO1\nG00 X[#1*0.001]\n#1=#1+1\nEND1\n";
  note_about("m700", loop + slips + "M30\n", &work);
  EXPECT_LE(work, bound);
  // A hole of very many pecks is one block.
  note_about("m700", "G00 X0 Y0 Z10.\nG83 X1. Z-800. R2. Q0.001 F100\n" + slips + "M30\n", &work);
  EXPECT_LE(work, bound);
}

// The cases made from the manuals: what one of a family does wrong is hardly ever a sign of another family, and where a program is said to be of another
// one than that in which it is read, that is its own, nearly always. Many are a few blocks that two families read alike.
TEST(OtherDialectsOfTheManuals, AreRecognised) {
  const std::string folder = nc::test::kSharedDir + "/conformance";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << folder << " is not here";
  unsigned faults = 0, wrong = 0, read_as_other = 0, named = 0, third = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".json") continue;
    std::ifstream file(entry.path());
    const Json all = Json::parse(file);
    unsigned count = 0;
    for (const Json& one : all["cases"]) {
      if (!one.contains("program") || !one["program"].is_string()) continue;
      const std::string own = one.value("dialect", "m700"), text = one["program"];
      if (own == "m700" && count++ % 4 != 0) continue;  // there are many of them
      const bool plain = !one.contains("setup") || one["setup"].empty();
      if (plain) {  // a note only where it has an alarm in its own family
        const bool alarmed = one["expect"].dump().find("\"alarm\"") != std::string::npos;
        const std::string note = note_about(own, text);
        faults += alarmed;
        wrong += !note.empty();
        EXPECT_EQ(note, "") << one["id"] << "\n" << text;
      }
      for (const std::string& other : dialect_names()) {
        if (other == own) continue;
        const std::string note = note_about(other, text);
        ++read_as_other;
        if (note.empty()) continue;
        ++named;
        third += note.substr(0, note.find(", as which")).find(own) == std::string::npos;
      }
    }
  }
  RecordProperty("faults", static_cast<int>(faults));
  RecordProperty("named", static_cast<int>(named));
  RecordProperty("third", static_cast<int>(third));
  EXPECT_GT(faults, 10u);
  EXPECT_EQ(wrong, 0u) << "of " << faults;
  EXPECT_GE(named * 100, read_as_other) << named << " of " << read_as_other << ": most are too short for a note, which needs two lines that show it";
  EXPECT_LE(third * 10, named) << third << " of " << named << " are said to be of a third family";
}

}  // namespace
}  // namespace nc::tools
