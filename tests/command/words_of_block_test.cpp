// SPDX-License-Identifier: Apache-2.0
// Questions about the words of a block that is not executed yet, or about their order.
#include "command/words_of_block.hpp"

#include "command/caller.hpp"
#include "command/plain_line.hpp"
#include "dialect/foreign_words.hpp"
#include "front_end_helpers.hpp"

namespace nc::test {
namespace {

class WordsOfBlockTest : public FrontEndTest {
 protected:
  bool plain(const std::string& text, PlainLine* line) {
    const double locals[] = {4, std::nan("")};
    *line = {};
    return read_plain_line(compile(text), front, 1000, [&locals] { return locals; }, 2, line);
  }
};

TEST_F(WordsOfBlockTest, OrderAndNumber) {
  const Block& block = compile("G10 L2 P1 L20 X[#1] R1.");
  const WordSlot kind = word(Role::input_kind), number = word(Role::input_number);
  EXPECT_EQ(word_count(block), 6u);
  EXPECT_EQ(count_of(block, kind), 2u);
  EXPECT_EQ(place_of(block, kind), 4u);
  EXPECT_EQ(place_of(block, number), 3u);
  EXPECT_EQ(place_of(block, word(Role::feed)), 0u);
  EXPECT_TRUE(has_any(block, set_of(number)));
  EXPECT_FALSE(has_any(block, set({Role::feed})));
  EXPECT_FALSE(has_only(block, set_of(number)));
  EXPECT_EQ(first_of_block(block, set_of(number) | set_of(kind)), kind);
  EXPECT_EQ(first_of_block(block, set({Role::feed})), word(Role::feed));
  EXPECT_EQ(first_expression(block), axis_words.word(0));
  double value = 0;
  EXPECT_EQ(first_with_point(block, ~WordSet{0}, &value), word(Role::arc_radius));
  EXPECT_EQ(value, 1);
  EXPECT_EQ(first_expression(compile("X1.")), kNoWord);
  unsigned at = 0;
  WordSlot found = kNoWord;
  uint16_t code = 0;
  EXPECT_TRUE(next_expression(block, ~WordSet{0}, &at, &found, &code));
  EXPECT_EQ(found, axis_words.word(0));
  EXPECT_FALSE(next_expression(block, ~WordSet{0}, &at, &found, &code));
}

TEST_F(WordsOfBlockTest, CodesThatAreNotExecutedYet) {
  EXPECT_TRUE(stands_before(compile("X1. G4"), front, axis_words.word(0), Function::dwell));
  EXPECT_FALSE(stands_before(compile("G4 X1."), front, axis_words.word(0), Function::dwell));
  EXPECT_EQ(motion_behind(compile("G1 X1. G2"), front, Function::rapid), Function::arc_cw);
  EXPECT_EQ(motion_behind(compile("X1."), front, Function::rapid), Function::rapid);
  EXPECT_EQ(motion_behind(compile("G#1"), front, Function::rapid), Function::rapid);
}

TEST_F(WordsOfBlockTest, ABlockToComeThatOnlyMoves) {
  ComingMove move;
  ASSERT_TRUE(read_coming_move(compile("X1. G91 Y2. F100"), front, 3, false, &move));
  EXPECT_EQ(move.axes, 3u);
  EXPECT_EQ(move.incremental, 2u);
  EXPECT_TRUE(move.relative);
  EXPECT_EQ(move.value[1].value, 2);
  for (const char* other : {"Z1.", "X#1", "G2 X1.", "M98 X1.", "F100", "X1. ,C1.", "X1. R2."}) EXPECT_FALSE(read_coming_move(compile(other), front, 3, false, &move)) << other;
}

TEST_F(WordsOfBlockTest, APlainLine) {
  PlainLine line;
  ASSERT_TRUE(plain("G1 X1.5 Z-2.", &line));
  EXPECT_TRUE(line.named);
  EXPECT_EQ(line.axes, 5u);
  EXPECT_EQ(line.value[2], -2);
  ASSERT_TRUE(plain("X#1", &line));
  EXPECT_FALSE(line.named);
  EXPECT_EQ(line.value[0], 4);
  for (const char* other : {"X1", "X#2", "X#3", "X1. X2.", "X1. F1.", "G0 X1.", "X1001.", "G1 R1."}) EXPECT_FALSE(plain(other, &line)) << other;
}

TEST_F(WordsOfBlockTest, CodesThatCall) {
  calls.any = true;
  calls.m[0].code = 50;
  calls.m[0].program = 9001;
  calls.ascii[0].word = word(Role::tool);
  calls.ascii[0].program = 9002;
  Caller caller;
  ASSERT_EQ(find_caller(compile("G91 X1. M50"), front, false, false, &caller), Reading::done);
  EXPECT_EQ(caller.at, 2u);
  EXPECT_EQ(caller.word, word(Role::misc_code));
  EXPECT_EQ(caller.call, &calls.m[0]);
  EXPECT_FALSE(caller.ascii);
  ASSERT_EQ(find_caller(compile("T5"), front, false, false, &caller), Reading::done);
  EXPECT_TRUE(caller.ascii);
  EXPECT_EQ(caller.value, 5);
  for (const char* none : {"G65 P1 M50", "G10 L2 T5", "M30 X1."}) {
    caller = {};
    ASSERT_EQ(find_caller(compile(none), front, false, false, &caller), Reading::done);
    EXPECT_EQ(caller.call, nullptr) << none;
  }
  caller = {};
  ASSERT_EQ(find_caller(compile("T5"), front, false, true, &caller), Reading::done);  // M700 13.5.3: in a fixed cycle
  EXPECT_EQ(caller.call, nullptr);
}

TEST_F(WordsOfBlockTest, PartsOfABlock) {
  const Block& block = compile("G91 X1. G1 M50 Y2.");
  Block copy;
  copy_codes_before(block, front, 3, copy);
  ASSERT_EQ(word_count(copy), 2u);
  EXPECT_EQ(copy.words[1].value, 1);
  copy_without(block, 3, copy);
  EXPECT_EQ(word_count(copy), 4u);
  EXPECT_FALSE(has_any(copy, set({Role::misc_code})));
}

TEST_F(WordsOfBlockTest, WordsOfLinuxcnc) {
  EXPECT_EQ(linuxcnc_word("N10 o100 sub"), LinuxcncWord::o_word);
  EXPECT_EQ(linuxcnc_word("#<feed> = 1"), LinuxcncWord::named_parameter);
  EXPECT_EQ(linuxcnc_word("(o100 sub) G0 X1"), LinuxcncWord::none);
  EXPECT_EQ(linuxcnc_word("O100"), LinuxcncWord::none);
}

}  // namespace
}  // namespace nc::test
