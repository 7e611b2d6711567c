// SPDX-License-Identifier: Apache-2.0
// Words, blocks, comments, skip signs, numbers of blocks and programs: M700 3.1-3.5, 5.3; DGSHAPE 1, 2.
#include <gtest/gtest.h>

#include "lex_helpers.hpp"

namespace nc::test {
namespace {

TEST(Lexer, WordsOfALine) {
  const auto b = lex("N10 G01 X-12.5 Y+3 Z.25 F500\n");
  EXPECT_FALSE(b->has_fault);
  EXPECT_FALSE(b->empty);
  EXPECT_TRUE(b->has_n);
  EXPECT_EQ(b->n, 10u);
  ASSERT_EQ(b->words.size(), 5u);
  const char* letters = "GXYZF";
  const double values[] = {1, -12.5, 3, 0.25, 500};
  for (unsigned i = 0; i < 5; ++i) {
    EXPECT_EQ(letter_of(b->words[i].slot), letters[i]);
    EXPECT_EQ(b->words[i].value, values[i]);
    EXPECT_EQ(b->words[i].code, kNoCode);
  }
  EXPECT_EQ(b->words[0].flags, 0);
  EXPECT_EQ(b->words[1].flags, kWordPoint | kWordNegative);
  EXPECT_EQ(b->words[2].flags, kWordPlus);
  EXPECT_EQ(b->words[3].flags, kWordPoint);
  EXPECT_EQ(b->words[0].column, 5);
  EXPECT_EQ(b->words[4].column, 25);
}

TEST(Lexer, LowerCaseAndBlanksAnywhere) {
  const auto plain = lex("N7G1X-10.5Y20\n"), loose = lex("\tn 7\r g 1 x - 1 0 . 5 y2\t0 \r\n");
  ASSERT_EQ(loose->words.size(), 3u);
  EXPECT_EQ(loose->n, 7u);
  for (unsigned i = 0; i < 3; ++i) {
    EXPECT_EQ(letter_of(loose->words[i].slot), letter_of(plain->words[i].slot));
    EXPECT_EQ(loose->words[i].value, plain->words[i].value);
    EXPECT_EQ(loose->words[i].flags, plain->words[i].flags);
  }
}

TEST(Lexer, NegativeZeroIsMarked) {  // M700 12.6: X-0 differs from X0
  const auto b = lex("X-0 Y0");
  EXPECT_EQ(b->words[0].flags, kWordNegative);
  EXPECT_TRUE(std::signbit(b->words[0].value));
  EXPECT_EQ(b->words[1].flags, 0);
}

TEST(Lexer, IntegerWordsDropTheirDecimals) {  // M700 5.3
  const auto b = lex("S1000.7 T12.9 M3.123456789");
  EXPECT_EQ(b->words[0].value, 1000);
  EXPECT_EQ(b->words[1].value, 12);
  EXPECT_EQ(b->words[2].value, 3);
  EXPECT_EQ(b->words[0].flags, kWordPoint);
}

TEST(Lexer, LettersWithoutAValue) {
  const auto b = lex("G X40. Y Z (to) \n");
  ASSERT_EQ(b->words.size(), 4u);
  EXPECT_EQ(b->words[0].flags, kWordNoValue);
  EXPECT_EQ(b->words[1].value, 40);
  EXPECT_EQ(b->words[2].flags, kWordNoValue);
  EXPECT_EQ(b->words[3].flags, kWordNoValue);
  const auto end = lex("G28 X");
  ASSERT_EQ(end->words.size(), 2u);
  EXPECT_EQ(end->words[1].flags, kWordNoValue);
}

TEST(Lexer, BlockEnds) {
  LexResult r;
  lex("G1 X1\nG2", m700_rules(), &r);
  EXPECT_EQ(r.used, 6u);
  EXPECT_TRUE(r.newline);
  lex("G1 X1;G2", m700_rules(), &r);
  EXPECT_EQ(r.used, 6u);
  EXPECT_FALSE(r.newline);
  EXPECT_FALSE(r.ran_out);
  lex("G1 X1", m700_rules(), &r);
  EXPECT_EQ(r.used, 5u);
  EXPECT_TRUE(r.ran_out);
  EXPECT_EQ(fault_of("G1 X1;G2", dgshape_rules()), Condition::illegal_character);
}

TEST(Lexer, FaultsDoNotLoseThePlace) {
  for (const char* text : {"G1 X1 ? Y2 (a;b\n", "G1 X1 ? Y2 (a;b) \n", "#=5 ( \n", "X[1+ ] \n", "N0 X \n",
                           "DPRNT[A(];)B\n", "M98 <A(;>) \n"}) {
    LexResult r;
    const auto b = lex(std::string(text) + "G2", m700_rules(), &r);
    EXPECT_TRUE(b->has_fault) << text;
    EXPECT_EQ(r.used, std::strlen(text)) << text;
    EXPECT_TRUE(r.newline) << text;
  }
}

TEST(Lexer, CommentsAreIgnoredEverywhere) {  // M700 3.1, 3.2
  const auto b = lex("G00 X12. (G01 X99. F1 @ ?) Y-3.\n");
  ASSERT_EQ(b->words.size(), 3u);
  EXPECT_EQ(b->words[2].value, -3);
  LexResult r;
  const auto semicolon = lex("(G0X-1000 ;) G1X-2000F500\n", m700_rules(), &r);
  EXPECT_EQ(semicolon->words.size(), 3u);
  EXPECT_EQ(r.used, 26u);
  const auto percent = lex("G1 (100 %) X1\n");
  EXPECT_EQ(percent->words.size(), 2u);
  const auto high = lex(std::string("G1 (\xff\xc3\xa9\0 ok) X1\n", 16));
  EXPECT_FALSE(high->has_fault);
  EXPECT_EQ(high->words.size(), 2u);
  const auto inside = lex("G(a)1(b) X(c)-(d)1(e)5(f).5\n");
  ASSERT_EQ(inside->words.size(), 2u);
  EXPECT_EQ(inside->words[1].value, -15.5);
  const auto only = lex("(only)\n");
  EXPECT_TRUE(only->empty);
}

TEST(Lexer, UnclosedCommentEndsWithItsLine) {
  LexResult r;
  const auto b = lex("G1 X1 (oops ; %\nY2\n", m700_rules(), &r);
  EXPECT_FALSE(b->has_fault);
  EXPECT_EQ(b->words.size(), 2u);
  EXPECT_EQ(r.used, 16u);
  EXPECT_TRUE(r.newline);
}

TEST(Lexer, Percent) {
  LexResult r;
  const auto b = lex("%  anything ; here ( \nG1", m700_rules(), &r);
  EXPECT_TRUE(b->percent);
  EXPECT_FALSE(b->has_fault);
  EXPECT_TRUE(b->empty);
  EXPECT_EQ(r.used, 22u);
  // After words it begins a new block.
  const auto end = lex("M30%\n", m700_rules(), &r);
  EXPECT_FALSE(end->percent);
  EXPECT_EQ(r.used, 3u);
  EXPECT_FALSE(r.newline);
}

TEST(Lexer, OptionalSkip) {  // M700 3.4
  const auto b = lex("/N20 G1 X25. Y25.\n");
  EXPECT_EQ(b->skip, 1);
  EXPECT_EQ(b->n, 20u);
  EXPECT_EQ(b->words.size(), 3u);
  EXPECT_EQ(lex("/3G1")->skip, 3);
  EXPECT_EQ(lex(" / 9 N5")->skip, 9);
  EXPECT_EQ(lex("/9 N5")->n, 5u);
  EXPECT_EQ(fault_of("/0G1"), Condition::value_range);
  EXPECT_EQ(lex("/G04X1000", dgshape_rules())->skip, 1);
  EXPECT_EQ(fault_of("/3G1", dgshape_rules()), Condition::format_error);
  EXPECT_EQ(fault_of("N20 /G1 X2."), Condition::format_error);
  EXPECT_EQ(fault_of("G1 /X2.", dgshape_rules()), Condition::format_error);
  // In other places '/' divides: N20 G1 X25./Y25. of the manual is an error.
  EXPECT_EQ(fault_of("N20 G1 X25./Y25."), Condition::calculation);
}

TEST(Lexer, NumbersAtTheHeadHaveTheLettersOfTheFamily) {
  IsoRules rules = m700_rules();
  rules.program_letter = 'L';
  rules.sequence_letter = 'Q';
  const auto both = lex("L5 Q7 G3\n", rules);
  EXPECT_TRUE(both->has_o);
  EXPECT_EQ(both->o, 5u);
  EXPECT_EQ(both->n, 7u);
  EXPECT_EQ(both->words.size(), 1u);
  const auto words = lex("O5 N7 G3\n", rules);  // ordinary words
  EXPECT_FALSE(words->has_o || words->has_n || words->has_fault);
  EXPECT_EQ(words->words.size(), 3u);
  EXPECT_EQ(fault_of("Q#1", rules), Condition::variable_use);
  rules.program_letter = rules.sequence_letter = 0;  // there are no such numbers
  EXPECT_EQ(lex("O5 N7 G3\n", rules)->words.size(), 3u);
  EXPECT_TRUE(lex("\n", rules)->empty);
}

TEST(Lexer, ProgramAndSequenceNumbers) {  // M700 3.5
  const auto o = lex("O12345678 (MAIN)\n");
  EXPECT_TRUE(o->has_o);
  EXPECT_EQ(o->o, 12345678u);
  EXPECT_TRUE(o->empty);
  const auto both = lex("O1 N2 G3\n");
  EXPECT_EQ(both->o, 1u);
  EXPECT_EQ(both->n, 2u);
  EXPECT_EQ(both->words.size(), 1u);
  EXPECT_EQ(lex("O00000001", dgshape_rules())->o, 1u);
  EXPECT_EQ(fault_of("N0 G1"), Condition::number_zero);
  EXPECT_EQ(fault_of("O0"), Condition::number_zero);
  EXPECT_EQ(fault_of("O"), Condition::format_error);
  EXPECT_EQ(fault_of("N1234567"), Condition::value_range);
  EXPECT_EQ(lex("N000001234")->n, 1234u);
  EXPECT_EQ(fault_of("N#1"), Condition::variable_use);  // M700 13.4 (3): not in O, N
  EXPECT_EQ(fault_of("O[1]"), Condition::variable_use);
  // Not at the head of a block they are words.
  const auto later = lex("G65 P9100 A1 N5 O6\n");
  EXPECT_FALSE(later->has_n);
  ASSERT_EQ(later->words.size(), 5u);
  EXPECT_EQ(letter_of(later->words[3].slot), 'N');
  EXPECT_EQ(later->words[4].value, 6);
  EXPECT_EQ(fault_of("G65 P1 N#1"), Condition::variable_use);
}

TEST(Lexer, RangesOfWords) {
  EXPECT_EQ(fault_of("G00X100000000"), Condition::value_range);
  EXPECT_EQ(fault_of("G00X99999999"), Condition::none);
  EXPECT_EQ(fault_of("G00X0000000099999999."), Condition::none);
  EXPECT_EQ(fault_of("G1234"), Condition::value_range);
  EXPECT_EQ(fault_of("G54.1"), Condition::none);
  EXPECT_EQ(fault_of("G54.12"), Condition::value_range);
  EXPECT_EQ(fault_of("X1.1234567890123456789012345"), Condition::none);
  const auto b = lex("X-100000000");
  EXPECT_EQ(b->fault.letter, 'X');
  EXPECT_EQ(b->fault.value, -100000000);
  EXPECT_EQ(fault_of("X99999999999999999999999999999999"), Condition::value_range);
}

/// M700 3.1: blank tape and rows that were punched out are ignored in any place.
TEST(Lexer, NulAndDeleteAreIgnored) {
  const std::string plain = "/2N10 G1 X-12.5 Y#1 ,R[#2+1.] F100\n", other = "IF[#100EQ5]GOTO20\n", third = "#3000=12(STOP)\n";
  for (const std::string& text : {plain, other, third}) {
    const std::string expected = [&] {
      const auto block = lex(text);
      std::string all;
      for (const Word& w : block->words) all += letter_of(w.slot) + std::to_string(w.value) + std::to_string(w.flags) + " ";
      for (const Statement& t : block->statements) all += std::to_string(static_cast<int>(t.kind)) + text_of(*block, t.text, t.text_length);
      return all + std::to_string(block->n) + std::to_string(block->skip) + std::to_string(block->code.size());
    }();
    for (const char ignored : {'\0', '\x7f'}) {
      for (size_t at = 0; at <= text.size(); ++at) {
        std::string changed = text;
        changed.insert(at, 1, ignored);
        const auto block = lex(changed);
        std::string all;
        for (const Word& w : block->words) all += letter_of(w.slot) + std::to_string(w.value) + std::to_string(w.flags) + " ";
        for (const Statement& t : block->statements) all += std::to_string(static_cast<int>(t.kind)) + text_of(*block, t.text, t.text_length);
        all += std::to_string(block->n) + std::to_string(block->skip) + std::to_string(block->code.size());
        EXPECT_EQ(all, expected) << at;
        EXPECT_FALSE(block->has_fault) << at;
      }
    }
  }
}

/// A message that is too long is cut between two characters.
TEST(Lexer, LongMessagesAreCutBetweenCharacters) {
  for (size_t before = 120; before < 128; ++before) {
    const std::string text = "#3000=1(" + std::string(before, 'A') + "\u00d8\u5de5\U0001f527\u00d8\u00d8\u00d8)\n";
    const auto block = lex(text);
    ASSERT_EQ(block->statements.size(), 1u);
    const std::string kept = text_of(*block, block->statements[0].text, block->statements[0].text_length);
    EXPECT_LE(kept.size(), 127u);
    EXPECT_GE(kept.size(), 124u);
    EXPECT_EQ(text.find(kept), 8u);
    EXPECT_NE(static_cast<unsigned char>(text[8 + kept.size()]) & 0xc0, 0x80) << before;
  }
}

TEST(Lexer, UnknownLettersAndCharacters) {
  EXPECT_EQ(fault_of("G1 U1", dgshape_rules()), Condition::illegal_address);
  EXPECT_EQ(lex("G1 U1", dgshape_rules())->fault.letter, 'U');
  EXPECT_EQ(fault_of("U", dgshape_rules()), Condition::illegal_address);
  EXPECT_EQ(fault_of("V#", dgshape_rules()), Condition::illegal_address);
  for (char c : {'!', '"', '$', '&', '\'', ')', ':',    '>',    '?',    '@',    '\\', '^',
                 '_', '`', '{', '|', '}',  '~', '\x01', '\x80', '\xff'}) {
    EXPECT_EQ(fault_of(std::string("G1 ") + c + "X1\n"), Condition::illegal_character) << static_cast<int>(c);
    EXPECT_EQ(fault_of(std::string(1, c)), Condition::illegal_character) << static_cast<int>(c);
    EXPECT_NE(fault_of(std::string("G1 X") + c + "\n"), Condition::none) << static_cast<int>(c);
    EXPECT_NE(fault_of(std::string("#1=") + c + "\n"), Condition::none) << static_cast<int>(c);
  }
  for (const char* text : {"#1=5", "X#1", "X[1]", "<A>", ",R1"}) {
    EXPECT_EQ(fault_of(text, dgshape_rules()), Condition::illegal_character) << text;
  }
  EXPECT_EQ(fault_of("X1+2", dgshape_rules()), Condition::format_error);
}

TEST(Lexer, MalformedWords) {
  for (const char* text : {"X-", "X--1", "X+-1", "X.", "X-.", "12", "(a)5", "G1.2.3", "=5", "X1=5",
                           "S1=", "S1.=5", "S-1=5", ",5", ",", "+1"}) {
    const Condition c = fault_of(text);
    EXPECT_TRUE(c == Condition::format_error || c == Condition::illegal_character)
        << text << " " << static_cast<int>(c);
  }
  EXPECT_EQ(fault_of("S256=5"), Condition::value_range);
}

TEST(Lexer, CountedAndCommaWords) {
  const auto b = lex("S1=500 F2=10.5 G1 X1. ,R5. ,C2\n");
  ASSERT_EQ(b->words.size(), 6u);
  EXPECT_EQ(b->words[0].flags, kWordCount);
  EXPECT_EQ(b->words[0].index, 1);
  EXPECT_EQ(b->words[0].value, 500);
  EXPECT_EQ(b->words[1].index, 2);
  EXPECT_EQ(b->words[1].value, 10.5);
  EXPECT_EQ(letter_of(b->words[4].slot), 'R');
  EXPECT_EQ(b->words[4].flags, kWordComma | kWordPoint);
  EXPECT_EQ(b->words[5].flags, kWordComma);
  const auto expression = lex("S3=#1*2");
  EXPECT_EQ(expression->words[0].flags, kWordCount | kWordExpression);
  EXPECT_EQ(expression->words[0].index, 3);
}

TEST(Lexer, Names) {
  const auto b = lex("M98 <parts-12 A.RAF> L2\n");
  EXPECT_FALSE(b->has_fault);
  EXPECT_EQ(text_of(*b, b->name, b->name_length), "parts-12 A.RAF");
  EXPECT_EQ(b->words.size(), 2u);
  for (const char* text : {"M98 <>", "M98 <A", "M98 <A\nB>", "M98 <A> <B>", "M98 <A;B>"}) {
    EXPECT_EQ(fault_of(text), Condition::format_error) << text;
  }
}

TEST(Lexer, TooLong) {
  std::string words, statements, texts;
  for (int i = 0; i < 60; ++i) words += "X1";
  EXPECT_EQ(fault_of(words), Condition::block_too_long);
  for (int i = 0; i < 20; ++i) statements += "#1=5";
  EXPECT_EQ(fault_of(statements), Condition::block_too_long);
  EXPECT_EQ(fault_of("DPRNT[" + std::string(300, 'A') + "]"), Condition::block_too_long);
  EXPECT_EQ(fault_of("#1=1" +
                     [] {
                       std::string s;
                       for (int i = 0; i < 200; ++i) s += "+#100";
                       return s;
                     }()),
            Condition::block_too_long);
  EXPECT_EQ(fault_of("M98 <" + std::string(300, 'A') + ">"), Condition::block_too_long);
}

TEST(Lexer, ColumnsSaturate) {
  const auto b = lex("G1" + std::string(300, ' ') + "X1");
  EXPECT_EQ(b->words[0].column, 1);
  EXPECT_EQ(b->words[1].column, 255);
}

// ---- macro statements
// ----------------------------------------------------------------------------------------------

TEST(Lexer, WordsWithExpressions) {  // M700 13.4 (3), 5.3
  const auto b = lex("G0 X#1 Y-#2 Z[#1+#3+1000] I#1+10 J123+0 K10-5 A-[1+2] B 2*#1\n");
  EXPECT_FALSE(b->has_fault);
  ASSERT_EQ(b->words.size(), 9u);
  for (unsigned i = 1; i < 9; ++i) {
    EXPECT_EQ(b->words[i].flags, kWordExpression) << i;
    EXPECT_NE(b->words[i].code, kNoCode);
  }
  EXPECT_EQ(lex("X SIN[30] Y1")->words.size(), 2u);
  EXPECT_EQ(lex("XSIN[30]")->words[0].flags, kWordExpression);
  EXPECT_EQ(lex("X-SIN[30]")->words[0].flags, kWordExpression);
  EXPECT_EQ(lex("G65 P#1 A[#2]")->words.size(), 3u);
}

TEST(Lexer, Assignments) {
  const auto b = lex("N10 #22=#20 #23=#21;");
  EXPECT_FALSE(b->has_fault);
  EXPECT_EQ(b->n, 10u);
  ASSERT_EQ(b->statements.size(), 2u);
  EXPECT_EQ(b->statements[0].kind, StatementKind::assign);
  EXPECT_EQ(lex("#1=5 END1")->statements.size(), 2u);
  EXPECT_EQ(lex("##10=100")->statements.size(), 1u);
  EXPECT_EQ(lex("#[#10+1]=1000")->statements.size(), 1u);
  EXPECT_EQ(lex("[#DIST]=25")->statements.size(), 1u);
  EXPECT_EQ(fault_of("#1"), Condition::no_equals);    // M700 P242
  EXPECT_EQ(fault_of("#1 5"), Condition::no_equals);  // #15
  EXPECT_EQ(fault_of("#1=#2#3"), Condition::no_equals);
  EXPECT_EQ(fault_of("#1="), Condition::calculation);
  EXPECT_EQ(fault_of("#=5"), Condition::variable_number);
  EXPECT_EQ(fault_of("#-5=1"), Condition::variable_number);
  EXPECT_EQ(fault_of("#1=#--5"), Condition::variable_number);
  EXPECT_EQ(fault_of("#1=#-[#1]"), Condition::variable_number);
  EXPECT_EQ(fault_of("#1=--5"), Condition::calculation);
  EXPECT_EQ(fault_of("#1=#[-[-5]]"), Condition::none);
  EXPECT_EQ(fault_of("#1=#[-#1]"), Condition::none);
  EXPECT_EQ(fault_of("#NAME=5"), Condition::variable_name);
  EXPECT_EQ(fault_of("[#A*]=5"), Condition::variable_name);
  EXPECT_EQ(fault_of("[5]=5"), Condition::format_error);
}

TEST(Lexer, Brackets) {  // M700 13.4 (Note 2), P280, P281
  EXPECT_EQ(fault_of("#543=-[[[[[#120]/2+15.]*3-#100]/#520+#125+#128]*#130+#132]"), Condition::none);
  EXPECT_EQ(fault_of("#543=[[[[[[#120]/2+15.]*3-#100]/#520+#125+#128]*#130+#132]]"),
            Condition::bracket_nesting);
  EXPECT_EQ(fault_of("#1=[SIN[[[[1]]]]]"), Condition::none);
  EXPECT_EQ(fault_of("#1=[[SIN[[[[1]]]]]]"), Condition::bracket_nesting);
  for (const char* text :
       {"#102=[#101+[3*4]", "#1=[", "#1=SIN[30", "#1=5]", "#1=]", "X[1", "X1]", "X[#1+[2]",
        "IF[#1 EQ 1 GOTO5", "IF[[#1 EQ 1] GOTO5", "IF[#1 EQ 1]] GOTO5", "WHILE[[#1 EQ 1] DO1", "WHILE[#1 EQ 1]] DO1", "WHILE[#1 EQ 1 DO1", "X[1+[2 Y]", "GOTO[5", "DPRNT[X#1[42]", "SETVN500[A", "[#DIST=5", "#[1=5"}) {
    EXPECT_EQ(fault_of(text), Condition::bracket_pair) << text;
  }
  EXPECT_EQ(fault_of("#1=[5 X]"), Condition::calculation);
  EXPECT_EQ(fault_of("IF[[#1 EQ 1]] GOTO5"), Condition::if_statement);  // as many: it is the condition that is wrong
  EXPECT_EQ(fault_of("WHILE[[#1 EQ 1]] DO1"), Condition::while_statement);
  EXPECT_EQ(fault_of("#1=SIN 30"), Condition::calculation);  // M700 13.5.6 (Note 3)
  EXPECT_EQ(fault_of("#1=FOO[30]"), Condition::calculation);
}

TEST(Lexer, Control) {  // M700 13.5.7
  auto b = lex("IF [#2 EQ1] GOTO100;");
  ASSERT_EQ(b->statements.size(), 1u);
  EXPECT_EQ(b->statements[0].kind, StatementKind::if_goto);
  EXPECT_EQ(lex("i f[#1lt#2]g oto[#101+10]")->statements[0].kind, StatementKind::if_goto);
  EXPECT_EQ(lex("GOTO #101")->statements[0].kind, StatementKind::go_to);
  b = lex("WHILE [#112 LT 26] DO127");
  EXPECT_EQ(b->statements[0].kind, StatementKind::while_do);
  EXPECT_EQ(b->statements[0].number, 127u);
  b = lex("DO1 END1");
  ASSERT_EQ(b->statements.size(), 2u);
  EXPECT_EQ(b->statements[0].kind, StatementKind::do_loop);
  EXPECT_EQ(b->statements[1].kind, StatementKind::end_loop);
  b = lex("IF[#1 EQ 1]THEN #2=5");
  ASSERT_EQ(b->statements.size(), 2u);
  EXPECT_EQ(b->statements[0].kind, StatementKind::if_then);
  for (const char* text :
       {"IF [#1 EQ 1]", "IF #1 EQ 1 GOTO 5", "IF [#1] GOTO 5", "IF [#1 EQ] GOTO 5",
        "IF [#1 EQ 1 EQ 2] GOTO 5", "IF [#1 EQ 1] GOTO", "IF [[#1 EQ 1] AND [#2 EQ 2]] GOTO 5", "IF"}) {
    EXPECT_EQ(fault_of(text), Condition::if_statement) << text;
  }
  for (const char* text : {"WHILE [#1 EQ 1]", "WHILE [#1] DO1", "WHILE [#1 LT 2] DO", "WHILE DO1", "DO0",
                           "DO128", "DO", "END", "END 1.5", "DO#1"}) {
    EXPECT_EQ(fault_of(text), Condition::while_statement) << text;
  }
  EXPECT_EQ(fault_of("GOTO"), Condition::format_error);
}

TEST(Lexer, WordsAndStatementsDoNotMix) {  // M700 P272
  for (const char* text : {"X#1=#3+100", "G1 X1 #1=5", "#1=5 G1 X1", "G1 GOTO 5", "G1 IF[#1 EQ 1]GOTO 5",
                           "#1=2 <A>", "X1 DO1", "G1 POPEN", "G1 [#A]=5"}) {
    EXPECT_EQ(fault_of(text), Condition::macro_and_words) << text;
  }
  EXPECT_EQ(fault_of("G65 P9010 A#1 B[#2+1] C-#3"), Condition::none);
}

TEST(Lexer, Messages) {  // M700 13.5.5, #3000 and #3006
  auto b = lex("#3000=70(CALL#PROGRAMMER#TEL#530)\n");
  ASSERT_EQ(b->statements.size(), 1u);
  EXPECT_EQ(text_of(*b, b->statements[0].text, b->statements[0].text_length), "CALL#PROGRAMMER#TEL#530");
  EXPECT_EQ(text_of(*b, b->comment, b->comment_length), "CALL#PROGRAMMER#TEL#530");
  b = lex("#1=2 #3006=1 ( take five; 100 % ) \n");
  EXPECT_EQ(b->statements[0].text_length, 0);
  EXPECT_EQ(text_of(*b, b->statements[1].text, b->statements[1].text_length), " take five; 100 % ");
  b = lex("#1=5(A)#2=6(B)");
  EXPECT_EQ(text_of(*b, b->statements[0].text, b->statements[0].text_length), "A");
  EXPECT_EQ(text_of(*b, b->statements[1].text, b->statements[1].text_length), "B");
  b = lex("#3000=1(" + std::string(1000, 'X') + ")");
  EXPECT_FALSE(b->has_fault);
  EXPECT_EQ(b->statements[0].text_length, 127);
  EXPECT_EQ(lex("G1 (A) X1 (B)")->text.size(), 0u);
}

TEST(Lexer, OutputStatements) {  // M700 13.5.8
  const auto b = lex("dprnt[X#1[42] Y#2[ 3 1 ]]");
  ASSERT_EQ(b->statements.size(), 1u);
  EXPECT_EQ(b->statements[0].kind, StatementKind::print_decimal);
  EXPECT_EQ(text_of(*b, b->statements[0].text, b->statements[0].text_length), "X#1[42]Y#2[31]");
  EXPECT_EQ(lex("BPRNT[A]")->statements[0].kind, StatementKind::print_binary);
  EXPECT_EQ(lex("POPEN")->statements[0].kind, StatementKind::open_port);
  EXPECT_EQ(lex("PCLOS;")->statements[0].kind, StatementKind::close_port);
  EXPECT_EQ(fault_of("DPRNT"), Condition::format_error);
  const auto names = lex("SETVN 500 [A234567,DIST, TOOL25]");
  ASSERT_EQ(names->statements.size(), 1u);
  EXPECT_EQ(names->statements[0].kind, StatementKind::set_name);
  EXPECT_EQ(names->statements[0].number, 500u);
  EXPECT_EQ(text_of(*names, names->statements[0].text, names->statements[0].text_length),
            "A234567,DIST,TOOL25");
  EXPECT_EQ(fault_of("SETVN[A]"), Condition::name_statement);
  EXPECT_EQ(fault_of("SETVN500"), Condition::name_statement);
}

TEST(Lexer, KeywordsAreWordsWithoutMacros) {
  const auto b = lex("D O", dgshape_rules());
  EXPECT_EQ(b->words.size(), 2u);
  EXPECT_EQ(fault_of("IF"), Condition::if_statement);
}

}  // namespace
}  // namespace nc::test
