// SPDX-License-Identifier: Apache-2.0
// Looking for O lines, sequence numbers and the ends of loops: M700 13.3.1, 13.5.7.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "lex_helpers.hpp"

namespace nc::test {
namespace {

const char kPrograms[] =
    "%\n"
    "O1000 (MAIN ; O5 )\n"
    "N10 G1 X1\n"
    "(N20) G1 X2 N20\n"
    " n 3 0 X3;N40 X4;/N50 X5\n"
    "/3 N60 X6 (N70\n"
    "N10 X7\n"
    "X8;(c)N80 X9\n"
    "M30%\n"
    "O2000 N5 X1\n"
    "N10 X2\n"
    "O2001\n"
    "M99\n"
    "%\n"
    "O2002\n";

struct Result {
  bool found;
  uint64_t offset;
  uint32_t line;
};

Result search(Texts& t, unsigned file, uint32_t n, uint64_t from, uint32_t line, uint64_t limit = 0,
              bool head = true) {
  bool again = false;
  Result r{false, from, line};
  r.found = t.reader.find_sequence(file, n, &r.offset, &r.line, limit, 0, &again, head);
  EXPECT_FALSE(again);
  return r;
}

class Search : public testing::TestWithParam<unsigned> {
 protected:
  Search() : t(GetParam() == 0 ? 64 : GetParam()) {}
  unsigned add(const std::string& text) {
    return GetParam() == 0 ? t.add_memory("a", text) : t.add_callback("a", text);
  }
  static uint64_t at(const char* what) { return std::string(kPrograms).find(what); }
  Texts t;
};

TEST_P(Search, SequenceNumbers) {
  const unsigned file = add(kPrograms);
  const struct {
    uint32_t n;
    const char* where;
    uint32_t line;
  } rows[] = {{10, "N10 G1", 3}, {30, " n 3 0", 5}, {40, "N40", 5},
              {50, "/N50", 5},   {60, "/3 N60", 6}, {80, "(c)N80", 8}};
  for (const auto& row : rows) {
    const Result r = search(t, file, row.n, 0, 1);
    EXPECT_TRUE(r.found) << row.n;
    EXPECT_EQ(r.offset, at(row.where)) << row.n;
    EXPECT_EQ(r.line, row.line) << row.n;
    // At the place that was found there is a block with that number.
    const Block* b = t.reader.read(file, r.offset, r.line);
    ASSERT_NE(b, nullptr);
    EXPECT_TRUE(b->has_n);
    EXPECT_EQ(b->n, row.n);
  }
  // These numbers are not at the head of a block, in a comment, or in another program.
  for (uint32_t n : {20u, 70u, 5u, 0u, 1u}) EXPECT_FALSE(search(t, file, n, 0, 1).found) << n;
}

TEST_P(Search, TheNextOneBelowWins) {  // M700 13.5.7 (Note 1)
  const unsigned file = add(kPrograms);
  const Result below = search(t, file, 10, at("(N20)"), 4, 0, false);
  EXPECT_TRUE(below.found);
  EXPECT_EQ(below.offset, at("N10 X7"));
  EXPECT_FALSE(search(t, file, 10, at("X8;"), 8, 0, false).found);
  // The search goes from the head to the block that asks.
  const Result above = search(t, file, 10, 0, 1, at("X8;"));
  EXPECT_EQ(above.offset, at("N10 G1"));
  EXPECT_FALSE(search(t, file, 80, 0, 1, at("X8;")).found);
  EXPECT_FALSE(search(t, file, 80, 0, 1, at("(c)N80")).found);
  EXPECT_TRUE(search(t, file, 80, 0, 1, at("(c)N80") + 1).found);
}

TEST(SearchMemory, AJumpIsLookedForOnce) {
  // The text changes without the reader's knowledge; only remembered results do not show that.
  Texts t;
  const unsigned file = t.add_memory("a", "G1 X1\nN10 X2\nN11 X3\n");
  EXPECT_EQ(search(t, file, 10, 0, 1).offset, 6u);
  EXPECT_FALSE(search(t, file, 17, 0, 1).found);
  const_cast<char&>(t.store.entry(file)->memory[8]) = '7';  // N17
  EXPECT_EQ(search(t, file, 10, 0, 1).offset, 6u);
  EXPECT_FALSE(search(t, file, 17, 0, 1).found);
  EXPECT_TRUE(search(t, file, 17, 0, 1, 20).found);  // another question
  EXPECT_FALSE(search(t, file, 10, 0, 1, 20).found);
  t.reader.forget(file);
  EXPECT_FALSE(search(t, file, 10, 0, 1).found);
  EXPECT_EQ(search(t, file, 17, 0, 1).offset, 6u);
}

TEST_P(Search, EndsOfPrograms) {
  const unsigned file = add(kPrograms);
  const Result five = search(t, file, 5, at("O2000"), 10);
  EXPECT_TRUE(five.found);
  EXPECT_EQ(five.offset, at("O2000"));
  EXPECT_TRUE(search(t, file, 10, at("O2000"), 10).found);
  EXPECT_FALSE(search(t, file, 10, at("O2000"), 10, 0, false).found);  // not the head: another program begins
  EXPECT_FALSE(search(t, file, 10, at("O2001"), 12).found);
  EXPECT_FALSE(search(t, file, 10, at("%\nO2000"), 9, 0, false).found);
}

TEST_P(Search, Programs) {
  const unsigned file = add(kPrograms);
  for (int round = 0; round < 2; ++round) {  // second: from the index
    for (uint32_t number : {2001u, 1000u, 2000u, 2002u}) {
      const ProgramRef r = t.reader.find_program(number, file);
      ASSERT_TRUE(r.valid()) << number;
      EXPECT_EQ(r.file, file);
      EXPECT_EQ(r.offset, at(("O" + std::to_string(number)).c_str()));
      EXPECT_EQ(t.reader.read(file, r.offset, r.line)->o, number);
    }
    EXPECT_EQ(t.reader.find_program(2000, file).line, 10u);
    EXPECT_FALSE(t.reader.find_program(5, file).valid());
    EXPECT_FALSE(t.reader.find_program(2, file).valid());
  }
  // A number of the store comes first.
  const unsigned other = t.add_memory("O2000.nc", "M99\n");
  EXPECT_EQ(t.reader.find_program(2000, file).file, other);
}

TEST_P(Search, MoreProgramsThanTheIndexHolds) {
  std::string text;
  for (int i = 1; i <= 300; ++i) text += "O" + std::to_string(i) + "\nX1\nM99\n";
  const unsigned file = add(text);
  std::mt19937 random(4);
  for (int i = 0; i < 300; ++i) {
    const uint32_t number = 1 + random() % 300;
    const ProgramRef r = t.reader.find_program(number, file);
    ASSERT_TRUE(r.valid()) << number;
    EXPECT_EQ(r.offset, text.find("O" + std::to_string(number) + "\n"));
    EXPECT_EQ(r.line, 3 * (number - 1) + 1);
  }
  EXPECT_FALSE(t.reader.find_program(301, file).valid());
}

TEST_P(Search, IndexFollowsAReplacedText) {
  const unsigned file = add("O1\nM99\nO2\nM99\n");
  EXPECT_EQ(t.reader.find_program(2, file).offset, 7u);
  EXPECT_EQ(add("O2\nM99\nO3\n"), file);
  EXPECT_EQ(t.reader.find_program(2, file).offset, 0u);
  EXPECT_TRUE(t.reader.find_program(3, file).valid());
  EXPECT_FALSE(t.reader.find_program(1, file).valid());
}

TEST_P(Search, GivesUpWithinItsBudget) {
  std::string text = "O1\n";
  for (int i = 0; i < 500; ++i) text += "G1 X1.5 Y2.5\n";
  const size_t target = text.size();
  text += "N99 M30\n";
  const unsigned file = add(text);
  uint64_t offset = 0;
  uint32_t line = 1;
  bool again = true, head = true;
  unsigned calls = 0;
  for (; again; ++calls) {
    ASSERT_LT(calls, 1000u);
    const bool found = t.reader.find_sequence(file, 99, &offset, &line, 0, 100, &again, head);
    head = false;
    EXPECT_EQ(found, !again);
  }
  EXPECT_EQ(offset, target);
  EXPECT_EQ(line, 502u);
  EXPECT_GT(calls, 50u);
}

TEST_P(Search, LoopEnds) {  // M700 13.5.7
  const std::string text =
      "WHILE [#1 LT 3] DO1\n"
      "DO2 (END1)\n"
      "N5 #1=#1+1\n"
      "END2\n"
      "WHILE[#3 EQ 1]DO3;WHILE[#3 EQ 1]DO2;END2;END3\n"
      "END1\n"
      "X1\n"
      "DO4\n"
      "DO5\n"
      "END4\n"
      "END5\n";
  const unsigned file = add(text);
  const auto end_of = [&](const char* from, uint32_t m, uint32_t* line) -> long {
    uint64_t offset = text.find(from);
    if (!t.reader.find_loop_end(file, m, &offset, line)) return -1;
    return static_cast<long>(offset);
  };
  uint32_t line = 2;
  EXPECT_EQ(end_of("DO2 (END1)", 1, &line), static_cast<long>(text.find("X1\n")));
  EXPECT_EQ(line, 7u);
  line = 3;
  EXPECT_EQ(end_of("N5", 2, &line), static_cast<long>(text.find("WHILE[#3")));
  EXPECT_EQ(line, 5u);
  line = 5;
  EXPECT_EQ(end_of("WHILE[#3 EQ 1]DO2", 3, &line), static_cast<long>(text.find("\nEND1\n")) + 1);
  line = 9;
  EXPECT_EQ(end_of("DO5", 4, &line), -1);  // the loops overlap
  line = 10;
  EXPECT_EQ(end_of("END4", 5, &line), -1);
  line = 12;
  EXPECT_EQ(end_of("END5\n", 4, &line), -1);
  const unsigned open = t.add_memory("open", "DO1\nX1\nO5\nEND1\n");
  uint64_t offset = 4;
  line = 2;
  EXPECT_FALSE(t.reader.find_loop_end(open, 1, &offset, &line));  // not beyond the program
}

TEST_P(Search, LoopsTooDeep) {
  std::string text;
  for (int i = 1; i <= 28; ++i) text += "DO" + std::to_string(i) + "\n";
  for (int i = 28; i >= 1; --i) text += "END" + std::to_string(i) + "\n";
  const unsigned file = add(text);
  uint64_t offset = 4;
  uint32_t line = 2;
  EXPECT_TRUE(t.reader.find_loop_end(file, 1, &offset, &line));
  EXPECT_EQ(offset, text.size());
}

/// The scanner finds the same blocks and numbers as the lexer.
TEST_P(Search, AgreesWithTheLexer) {
  std::mt19937 random(5);
  const char alphabet[] = "NNNOGX0123456789 \n\n;%/()#\r,.";
  for (int round = 0; round < 2000; ++round) {
    std::string text = "G1\n";  // not a head: O and % end the program
    for (unsigned i = 0, n = random() % 120; i < n; ++i) text += alphabet[random() % (sizeof alphabet - 1)];
    const unsigned file = add(text);
    uint64_t at = 0;
    uint32_t line = 1;
    uint32_t wanted = 1 + random() % 20;
    Result expected{false, 0, 1};
    for (;;) {
      const Block* b = t.reader.read(file, at, line);
      if (b->end_of_text || b->percent || b->has_o) break;
      if (b->has_fault && (b->fault.letter == 'O' || b->fault.letter == 'N' || b->fault.letter == '/')) {
        wanted = 0;  // a head with a fault is not compared further
        break;
      }
      if (b->has_n && b->n == wanted) {
        expected = {true, b->begin, b->line};
        break;
      }
      at = b->next;
      line = b->next_line;
    }
    if (wanted == 0) continue;
    const Result got = search(t, file, wanted, 0, 1);
    ASSERT_EQ(got.found, expected.found) << text << "\nN" << wanted;
    if (!got.found) continue;
    ASSERT_EQ(got.offset, expected.offset) << text << "\nN" << wanted;
    ASSERT_EQ(got.line, expected.line) << text << "\nN" << wanted;
  }
}

INSTANTIATE_TEST_SUITE_P(Windows, Search, testing::Values(0u, 128u, 131u, 200u));

}  // namespace
}  // namespace nc::test
