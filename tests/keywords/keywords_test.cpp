// SPDX-License-Identifier: Apache-2.0
// A language without letters and codes runs on the same core: it needs tables and a reader, and nothing outside them. What it moves is compared with what the
// same part does as a program of m700.
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "family.hpp"
#include "support/pull.hpp"

namespace nc::keywords {
namespace {

using test::Bench;
using test::Outcome;

constexpr nc_dialect kKeywordFamily = NC_DIALECT_DGSHAPE;  // whose place it has in this program

Outcome keywords(const std::string& text) { return Bench(kKeywordFamily).run(text); }

long read_at(void* user, uint64_t offset, char* buffer, size_t size) {
  const std::string& text = *static_cast<const std::string*>(user);
  const size_t left = offset < text.size() ? text.size() - static_cast<size_t>(offset) : 0;
  const size_t count = left < size ? left : size;
  std::memcpy(buffer, text.data() + offset, count);
  return static_cast<long>(count);
}

/// The same through a window: a text in memory is read where it lies.
Outcome in_windows(std::string text) {
  Bench bench(kKeywordFamily);
  unsigned file = 0;
  EXPECT_EQ(nc_program_add(bench.control(), "main", read_at, &text, text.size(), &file), NC_OK);
  EXPECT_EQ(nc_program_select(bench.control(), 0, file), NC_OK);
  return bench.finish();
}

const char* const kPart =
    "! a part\n"
    "PROGRAM 1\n"
    "SPEED 1000 SPINDLE | FEED 500   ! two blocks\n"
    "RAPID X+1 Y+2 Z+5\n"
    "LINE Z-1\n"
    "LEFT OFFSET 1 X10 Y10\n"
    "LINE Y30.125\n"
    "CIRCLE X20 Y40.125 RADIUS 10\n"
    "LINE X40\n"
    "CENTRE X60 Y60\n"
    "RAPID Z+5\n"
    "PECK X70 Y10 Z-12 LEVEL 2 STEP 4 FEED 100\n"
    "X80\n"
    "NODRILL\n"
    "CALL 2 TIMES 2\n"
    "WAIT 500\n"
    "HALT\n"
    "END\n"
    "PROGRAM 2 ! CALL | here is no block end\n"
    "INCREMENTAL LINE X-5.5\n"
    "ABSOLUTE\n"
    "RETURN\n";

const char* const kSamePart =
    "O1\n"
    "S1000 M3\nF500\n"
    "G0 X1. Y2. Z5.\n"
    "G1 Z-1.\n"
    "G41 D1 X10. Y10.\n"
    "G1 Y30.125\n"
    "G2 X20. Y40.125 R10.\n"
    "G1 X40.\n"
    "G40 X60. Y60.\n"
    "G0 Z5.\n"
    "G83 X70. Y10. Z-12. R2. Q4. F100\n"
    "X80.\n"
    "G80\n"
    "M98 P2 L2\n"
    "G4 P500\n"
    "M5\n"
    "M2\n"
    "O2\n"
    "G91 G1 X-5.5\n"
    "G90\n"
    "M99\n";

void expect_same_moves(const Outcome& a, const Outcome& b) {
  const std::vector<nc_move> one = a.moves(), other = b.moves();
  ASSERT_EQ(one.size(), other.size());
  for (size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].kind, other[i].kind) << i;
    for (unsigned axis = 0; axis < 3; ++axis) EXPECT_NEAR(one[i].machine.v[axis], other[i].machine.v[axis], 1e-9) << i;
  }
}

TEST(Keywords, MoveAsTheSamePartInAnotherLanguage) {
  Bench words(kKeywordFamily), letters(NC_DIALECT_M700);
  const Outcome ours = words.tool(1, 3).run(kPart), same = letters.tool(1, 3).run(kSamePart);
  EXPECT_EQ(ours.alarm, "") << ours.alarm_detail << " line " << ours.alarm_line;
  EXPECT_EQ(same.alarm, "") << same.alarm_detail << " line " << same.alarm_line;
  EXPECT_TRUE(ours.ended_ok);
  EXPECT_GT(ours.moves().size(), 15u);
  expect_same_moves(ours, same);
  EXPECT_EQ(ours.path(), same.path());
  EXPECT_EQ(ours.dwells(), same.dwells());
}

/// What shares a block, and what a mode bars, is said by the family's own tables before those of all families.
TEST(Keywords, TablesOfTheFamilySayWhatSharesABlock) {
  const auto side = [](nc_dialect family, const char* text) { return Bench(family).tool(1, 3).run(text).last_modal().code[7]; };
  EXPECT_EQ(side(kKeywordFamily, "FEED 100\nRIGHT OFFSET 1 WAIT 10\nEND\n"), 100);
  EXPECT_EQ(side(NC_DIALECT_M700, "F100\nG42 D1 G4 P10\nM2\n"), 400) << "ignored: M700 appendix 2";
  EXPECT_EQ(keywords("FEED 100\nRIGHT OFFSET 1 LINE X10\nINCREMENTAL X1\nEND\n").alarm, "NC-OFFSET-CODE");
  EXPECT_EQ(keywords("FEED 100\nLINE X10\nINCREMENTAL X1\nEND\n").alarm, "");
}

// nc_action::letter: SPEED has the word of an axis that could be called S; commands have a word that no letter stands for.
TEST(Keywords, AnActionHasALetterOnlyWhereItsWordHasOne) {
  std::string ours;
  for (const nc_item& item : keywords(kPart).of(NC_ITEM_ACTION))
    if (item.u.action.kind <= NC_ACTION_B) ours += (item.u.action.letter == 0 ? "-" : std::string(1, item.u.action.letter)) + test::brief(item.u.action.value) + " ";
  EXPECT_EQ(ours, "S1000 -3 -5 -2 ");
}

TEST(Keywords, RewindAnywhereAndGoOnTheSameWay) {
  Bench bench(kKeywordFamily);
  const Outcome whole = bench.tool(1, 3).run(kPart);
  ASSERT_TRUE(whole.ended_ok);
  unsigned rewound = 0;
  for (size_t i = 0; i < whole.steps.size(); ++i) {
    if (whole.steps[i].item.kind != NC_ITEM_MARK) continue;
    if (bench.rewind(whole.steps[i].item.serial, whole.steps[i].machine) != NC_OK) continue;
    ++rewound;
    const Outcome rest = bench.finish();
    EXPECT_EQ(rest.alarm, "") << rest.alarm_detail;
    std::vector<std::string> expected = whole.path();
    const std::vector<std::string> got = rest.path();
    ASSERT_LE(got.size(), expected.size());
    expected.erase(expected.begin(), expected.end() - static_cast<std::ptrdiff_t>(got.size()));
    EXPECT_EQ(got, expected);
  }
  EXPECT_GT(rewound, 5u);
}

TEST(Keywords, NameTheirOwnWordsInAlarms) {
  const Outcome feed = keywords("PROGRAM 1\n\nLINE X+10\nEND\n");
  EXPECT_EQ(feed.alarm, "FEEDLESS");
  EXPECT_EQ(feed.alarm_line, 3u);
  EXPECT_NE(feed.alarm_detail.find("FEED"), std::string::npos) << feed.alarm_detail;
  const Outcome level = keywords("PROGRAM 1\nLINE X1 | FEED\nEND\n");
  EXPECT_EQ(level.alarm_line, 2u);
  const Outcome missing = keywords("FEED 100\nLINE X1 LEVEL\nEND\n");
  EXPECT_NE(missing.alarm_detail.find("LEVEL"), std::string::npos) << missing.alarm_detail;
  const Outcome program = keywords("FEED 100\nCALL 77\nEND\n");
  EXPECT_NE(program.alarm_detail.find("PROGRAM 77"), std::string::npos) << program.alarm_detail;
  for (const Outcome* run : {&feed, &level, &missing, &program})
    for (const char c : run->alarm_detail) EXPECT_GE(c, ' ') << run->alarm_detail;
}

TEST(Keywords, AreRefusedInTheRightLineWhereTheyAreWrong) {
  const Outcome unknown = keywords("FEED 100 ! fine\n! | BLUE\n\nLINE X1 | LINE BLUE 5 ! here\nEND\n");
  EXPECT_EQ(unknown.alarm_line, 4u) << unknown.alarm_detail;
  EXPECT_EQ(unknown.path(), std::vector<std::string>{"line 1 0 0 F100"});
  EXPECT_EQ(keywords("FEED 100\nLINE X1 ?\nEND\n").alarm_line, 2u);
}

TEST(Keywords, FindAProgramByItsOwnHeader) {
  // A search that looked for O at the head of a block would not see this header.
  const Outcome run = keywords("PROGRAM 1\nFEED 100\nCALL 2\nEND\n! \nPROGRAM 3\nLINE X3\nRETURN\n\nPROGRAM 2\nLINE X2\nRETURN\n");
  EXPECT_EQ(run.alarm, "") << run.alarm_detail;
  EXPECT_EQ(run.path(), std::vector<std::string>{"line 2 0 0 F100"});
}

TEST(Keywords, BlockThatDoesNotFitTheWindowIsRefusedAndTheRestIsRead) {
  const std::string longer(20000, ' ');
  const Outcome run = in_windows("FEED 100\nLINE X1\nLINE" + longer + "X2\nEND\n");
  EXPECT_EQ(run.alarm_line, 3u);
  EXPECT_NE(run.alarm_message.find("long"), std::string::npos) << run.alarm_message;
  // A search passes over it and goes on in the right line.
  const Outcome behind = in_windows("FEED 100\nCALL 2\nEND\nPROGRAM 4\nLINE" + longer + "X2\nRETURN\nPROGRAM 2\nLINE X2\nLINE X BLUE\nRETURN\n");
  EXPECT_EQ(behind.path(), std::vector<std::string>{"line 2 0 0 F100"});
  EXPECT_EQ(behind.alarm_line, 9u);
}

TEST(Keywords, ShowCodesByTheirNames) {
  Bench bench(kKeywordFamily);
  const Outcome run = bench.run("FEED 100\nLINE X1\nEND\n");
  ASSERT_FALSE(run.steps.empty());
  char codes[NC_GROUPS][8];
  const unsigned count = nc_modal_codes_get(bench.control(), &run.steps.back().modal, codes, NC_GROUPS);
  bool metric = false;
  for (unsigned i = 0; i < count; ++i) metric = metric || std::string(codes[i]) == "METRIC";
  EXPECT_TRUE(metric);
}

}  // namespace
}  // namespace nc::keywords
