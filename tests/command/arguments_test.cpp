// SPDX-License-Identifier: Apache-2.0
// What a call gets of the words of its block: values of local variables, by number; words for a function of the vendor.
#include "command/arguments.hpp"

#include "front_end_helpers.hpp"

namespace nc::test {
namespace {

class ArgumentsTest : public FrontEndTest {
 protected:
  MacroCall call_of(const std::string& text, bool every_word = false) {
    MacroCall call;
    EXPECT_EQ(read_arguments(compile(text), front, every_word, call), Reading::done) << text;
    return call;
  }
  static double local(const MacroCall& call, unsigned number) { return call.argument[number - 1].vacant ? -1 : call.argument[number - 1].number; }
};

/// M700 13.5.1, argument designation I.
TEST_F(ArgumentsTest, LettersBecomeVariables) {
  variables[500] = 8;
  const MacroCall call = call_of("G65 P9010 L3 A1. B2 C3. X#500 Y#501 Z5.");
  EXPECT_TRUE(call.has_program);
  EXPECT_EQ(call.program, 9010);
  EXPECT_TRUE(call.has_repeats);
  EXPECT_EQ(call.repeats, 3);
  EXPECT_EQ(local(call, 1), 1);
  EXPECT_EQ(local(call, 2), 2);
  EXPECT_EQ(local(call, 3), 3);
  EXPECT_EQ(local(call, 24), 8);
  EXPECT_EQ(local(call, 25), -1);
  EXPECT_EQ(local(call, 26), 5);
  EXPECT_FALSE(call_of("G65 A1.").has_program);
}

/// M700 13.5.1, argument designation II: ten groups of I J K.
TEST_F(ArgumentsTest, GroupsOfThree) {
  const MacroCall call = call_of("G65 P1 I1. K3. J5. I7.");
  EXPECT_EQ(local(call, 4), 1);
  EXPECT_EQ(local(call, 6), 3);
  EXPECT_EQ(local(call, 8), 5);
  EXPECT_EQ(local(call, 10), 7);
  std::string many = "G65 P1";
  for (unsigned i = 0; i < 11; ++i) many += " I1.";
  MacroCall too_many;
  EXPECT_EQ(read_arguments(compile(many), front, false, too_many), Reading::refused);
  EXPECT_EQ(front.refusal.condition, Condition::macro_argument);
}

/// M700 13.5.1, G66.1: every word is an argument, P and L, too.
TEST_F(ArgumentsTest, EveryWord) {
  const MacroCall call = call_of("X1. L2", true);
  EXPECT_FALSE(call.has_repeats);
  EXPECT_EQ(local(call, 12), 2);
  MacroCall refused_call;
  EXPECT_EQ(read_arguments(compile("G65 P1 X1. N5"), front, false, refused_call), Reading::refused);
  EXPECT_EQ(front.refusal.condition, Condition::illegal_address);
  EXPECT_EQ(front.refusal.word, word(Role::sequence_number));
}

TEST_F(ArgumentsTest, WordsOfAVendor) {
  VendorWords words;
  ASSERT_EQ(read_vendor_words(compile("G91 G200 X1. Y#9 P7"), front, 1, words), Reading::done);
  ASSERT_EQ(words.size(), 2u);
  EXPECT_EQ(words[0].address, 'X');
  EXPECT_EQ(words[1].address, 'P');
  EXPECT_EQ(words[1].value, 7);
}

}  // namespace
}  // namespace nc::test
