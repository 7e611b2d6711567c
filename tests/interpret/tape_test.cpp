// SPDX-License-Identifier: Apache-2.0
// Programs from tapes (M700 3.1, 3.6): label skip, the two codes, parity H and V, and what a tape cannot do.
#include <gtest/gtest.h>

#include <bit>
#include <map>
#include <string>

#include "support/pull.hpp"

namespace nc::test {
namespace {

/// The text in ISO code as a punch writes it: hole 8 makes the number of holes even.
std::string iso(const std::string& text) {
  std::string rows;
  for (const char c : text) {
    const unsigned holes = static_cast<unsigned>(std::popcount(static_cast<unsigned char>(c)));
    rows += static_cast<char>(static_cast<unsigned char>(c) | (holes % 2 != 0 ? 0x80 : 0));
  }
  return rows;
}

/// The text in EIA code, for the characters that the tests use.
std::string eia(const std::string& text) {
  static const std::map<char, int> kRows = {{'0', 0x20}, {'1', 0x01}, {'2', 0x02}, {'3', 0x13},  {'4', 0x04},
                                            {'5', 0x15}, {'9', 0x19}, {'F', 0x76}, {'G', 0x67},  {'M', 0x54},
                                            {'X', 0x37}, {'Y', 0x38}, {'Z', 0x29}, {'-', 0x40},  {'.', 0x6b},
                                            {'(', 0x1a}, {')', 0x4a}, {' ', 0x10}, {'\n', 0x80}, {'%', 0x0b}};
  std::string rows;
  for (const char c : text) rows += static_cast<char>(kRows.at(c));
  return rows;
}

Outcome run_tape(Bench& bench, const std::string& rows, nc_tape code, unsigned unit = 1) {
  const unsigned file = bench.add("tape", rows);
  EXPECT_EQ(nc_program_tape(bench.control(), file, static_cast<uint8_t>(code), unit), NC_OK);
  EXPECT_EQ(nc_program_select(bench.control(), 0, file), NC_OK);
  return bench.finish();
}

const char kText[] = "%LABEL X5. (\nG00 X10. Y-20.\nG1 Z-5. F500 (CUT)\nM30\n%";

TEST(Tape, TheLabelIsNotRead) {
  Bench bench;
  const Outcome text = run_tape(bench, kText, NC_TAPE_TEXT);
  EXPECT_EQ(text.alarm, "");
  EXPECT_EQ(text.path(), (Path{"rapid 10 -20 0", "line 10 -20 -5 F500"}));
  EXPECT_EQ(text.lines(), (std::vector<unsigned>{2, 3, 4}));                         // lines of the file
  EXPECT_EQ(bench.at(0, 0, 0).run("G00 X1. M30\n%").path(), (Path{"rapid 1 0 0"}));  // a text has no label
  EXPECT_EQ(run_tape(bench, "G00 X1. M30", NC_TAPE_TEXT).alarm, "P36");              // all of it is the label
}

TEST(Tape, RowsOfBothCodes) {
  Bench bench;
  EXPECT_EQ(run_tape(bench, iso(kText), NC_TAPE_ISO).path(), (Path{"rapid 10 -20 0", "line 10 -20 -5 F500"}));
  const std::string rows = eia("X5.5\nG00 X10. Y-20.\nG1 Z-5. F500\nM30\n%");
  bench.at(0, 0, 0);
  const Outcome run = run_tape(bench, rows, NC_TAPE_EIA);
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.path(), (Path{"rapid 10 -20 0", "line 10 -20 -5 F500"}));
  // Leader and deleted rows are ignored; CR LF ends a block, as LF does.
  const std::string blanks(40, '\0');
  bench.at(0, 0, 0);
  const Outcome leader =
      run_tape(bench, blanks + iso("\r\nG00 X1\r\nG0 Y2.") + "\xff" + blanks + iso("\r\nM30\r\n%") + blanks,
               NC_TAPE_ISO);
  EXPECT_EQ(leader.alarm, "");
  EXPECT_EQ(leader.path(), (Path{"rapid 0.001 0 0", "rapid 0.001 2 0"}));
}

TEST(Tape, ARowWithAWrongNumberOfHoles) {
  const std::string good = iso(kText);
  for (const char* where :
       {"X10", "CUT", "Z-5"}) {  // in a comment, too: it is part of the significant section
    std::string bad = good;
    bad[std::string(kText).find(where) + 1] ^= 0x10;
    Bench bench;
    const Outcome run = run_tape(bench, bad, NC_TAPE_ISO);
    EXPECT_EQ(run.alarm, "P30") << where;
    EXPECT_EQ(run.alarm_line, where[0] == 'X' ? 2u : 3u) << where;
  }
  std::string bad_label = good;
  bad_label[2] ^= 0x10;
  Bench bench;
  EXPECT_EQ(run_tape(bench, bad_label, NC_TAPE_ISO).alarm, "");
  std::string bad = eia("\nG00 X1\nM30\n%");
  bad[6] ^= 0x04;
  EXPECT_EQ(run_tape(bench, bad, NC_TAPE_EIA).alarm, "P30");
  // Skipped or not, a block is checked (3.4).
  nc_switches_set(bench.control(), 0, 2, 0);
  std::string skipped = iso("\n/G00 X1\nM30\n%");
  EXPECT_EQ(run_tape(bench, skipped, NC_TAPE_ISO).alarm, "");
  skipped[3] ^= 0x02;
  EXPECT_EQ(run_tape(bench, skipped, NC_TAPE_ISO).alarm, "P30");
}

TEST(Tape, ABlockWithAnOddNumberOfCharacters) {
  // "G00 X1" and its end are seven.
  const std::string odd = iso("LABEL\nG00 X1\nM30\n%"), even = iso("LABEL\nG00  X1\nM30\n%");
  Bench bench;
  EXPECT_EQ(run_tape(bench, odd, NC_TAPE_ISO).alarm, "");  // not asked for
  bench.param("9215", "1");
  EXPECT_EQ(run_tape(bench, odd, NC_TAPE_ISO, 1).alarm, "");  // another unit's parameter
  const Outcome run = run_tape(bench, odd, NC_TAPE_ISO, 2);
  EXPECT_EQ(run.alarm, "P31");
  EXPECT_EQ(run.alarm_line, 2u);
  EXPECT_EQ(run_tape(bench, even, NC_TAPE_ISO, 2).alarm, "");
  std::string deleted = odd;
  deleted.insert(10, "\xff");  // a deleted row does not count
  EXPECT_EQ(run_tape(bench, deleted, NC_TAPE_ISO, 2).alarm, "P31");
  EXPECT_EQ(run_tape(bench, "LABEL\nG00 X1\nM30\n%", NC_TAPE_TEXT, 2).alarm, "");  // a text has no rows
}

TEST(Tape, ASearchForASequenceNumberChecksTheRowsItPasses) {
  Bench bench;
  std::string sub = iso("\nG0 X1.\nN5 G0 X2.\nM99\n%");
  const auto call = [&] {
    const unsigned file = bench.add("O7", sub);
    EXPECT_EQ(nc_program_tape(bench.control(), file, NC_TAPE_ISO, 1), NC_OK);
    bench.at(0, 0, 0);
    return bench.run("M98 P7 H5\nM30\n%");
  };
  EXPECT_EQ(call().path(), (Path{"rapid 2 0 0"}));
  sub[5] ^= 0x01;
  EXPECT_EQ(call().alarm, "P30");
}

TEST(Tape, NoJumpsOnATape) {
  Bench bench;
  EXPECT_EQ(run_tape(bench, iso("\nGOTO 5\nN5 M30\n%"), NC_TAPE_ISO).alarm, "P295");
  EXPECT_EQ(run_tape(bench, iso("\nIF [1 EQ 1] GOTO 5\nN5 M30\n%"), NC_TAPE_ISO).alarm, "P295");
  EXPECT_EQ(run_tape(bench, iso("\nWHILE [1 EQ 2] DO 1\nEND 1\nM30\n%"), NC_TAPE_ISO).alarm, "P295");
  // 13.3.1: M99 P of a sub program goes on behind the call.
  bench.add("O7", "G0 X1.\nM99 P9\n");
  bench.at(0, 0, 0);
  const Outcome run = run_tape(bench, iso("\nM98 P7\nG0 Y1.\nN9 G0 Z1.\nM30\n%"), NC_TAPE_ISO);
  EXPECT_EQ(run.path(), (Path{"rapid 1 0 0", "rapid 1 1 0", "rapid 1 1 1"}));
}

TEST(Tape, WhatIsRefused) {
  Bench bench;
  const unsigned file = bench.add("tape", "\nM30\n%");
  EXPECT_EQ(nc_program_tape(bench.control(), file, NC_TAPE_EIA + 1, 1), NC_E_ARGUMENT);
  EXPECT_EQ(nc_program_tape(bench.control(), file, NC_TAPE_ISO, 0), NC_E_ARGUMENT);
  EXPECT_EQ(nc_program_tape(bench.control(), file, NC_TAPE_ISO, 6), NC_E_ARGUMENT);
  EXPECT_EQ(nc_program_tape(bench.control(), 9999, NC_TAPE_ISO, 1), NC_E_ARGUMENT);
}

}  // namespace
}  // namespace nc::test
