// SPDX-License-Identifier: Apache-2.0
// Reading blocks: the window at every byte offset, blocks longer than the window, the cache of compiled
// blocks, read failures.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "lex_helpers.hpp"

namespace nc::test {
namespace {

/// A bit of everything; the longest block without comments has less than 60 characters.
const char kMixed[] =
    "%\r\n"
    "O100 (MIXED)\r\n"
    "N1 G90 G54 G00 X0 Y0\r\n"
    "G1 X1.25 Y-3.5 Z.125 F500;G2 X3 I5;\n"
    "\n"
    "/2 N20 M98 <sub 1.NC> L2\n"
    "#1=100 #2=#1+SIN[30]*2 (ok)\n"
    "#3000=70(CALL#PROGRAMMER#TEL#530)\n"
    "IF [#1 EQ 5] GOTO 20\n"
    "WHILE [#2 LT [#1 + 7]] DO1 ; END1\n"
    "G1 X 1 2 . 5 (comment; % in the middle) Y3\n"
    "G0 X? Y5 ; G4\n"
    "DPRNT[X#1[42]]\n"
    "(unclosed ; % \n"
    "S1=500 ,R5. M03\n"
    "M30%\n"
    "O200 N5 X1\n"
    "M99";

TEST(BlockReader, WindowAtEveryByteOffset) {
  Texts memory;
  const std::string text = kMixed;
  const auto expected = memory.all(memory.add_memory("a", text));
  EXPECT_EQ(expected.size(), 23u);
  for (unsigned window = 60; window < 480; ++window) {
    Texts t(window);
    ASSERT_EQ(t.all(t.add_callback("a", text)), expected) << window;
  }
  // The text shifted through one window, byte by byte.
  for (unsigned shift = 0; shift < 130; ++shift) {
    const std::string shifted = std::string(shift, ' ') + "\n" + text;
    Texts m, t(61);
    ASSERT_EQ(t.all(t.add_callback("a", shifted)), m.all(m.add_memory("a", shifted))) << shift;
  }
}

TEST(BlockReader, LongBlocksAreReadAcrossWindows) {
  // Comments and blanks of any length do not count; columns, messages and what follows stay as they are.
  const std::string comment = "(" + std::string(5000, ';') + "% anything)";
  const std::string blanks(900, ' ');
  const std::string text = "G1 X1." + comment + "Y2. " + blanks + "Z3.\n" + comment + "\n" + blanks + "%" +
                           std::string(700, 'x') + "\n" + "#3006=1 " + comment + "(TAKE FIVE)\n" +
                           "M98 <a b.nc> " + comment + "\n" + "G2 X5" + comment + ";G3 X6" + comment + "%\n" +
                           "(" + std::string(3000, 'u') + "\nM30\n";
  Texts memory;
  const auto expected = memory.all(memory.add_memory("a", text));
  for (unsigned window : {32u, 33u, 64u, 100u, 512u, 513u, 1024u, 4096u, 5200u, 65536u}) {
    Texts t(window);
    ASSERT_EQ(t.all(t.add_callback("a", text)), expected) << window;
  }
}

TEST(BlockReader, TooMuchForTheWindow) {
  std::string words = "G1";
  for (int i = 0; i < 30; ++i) words += " X1.25";
  const std::string text = words + "\nM30\n";
  Texts t(64);
  const unsigned file = t.add_callback("a", text);
  const Block* b = t.reader.read(file, 0, 1);
  ASSERT_NE(b, nullptr);
  EXPECT_TRUE(b->has_fault);
  EXPECT_EQ(b->fault.condition, Condition::block_too_long);
  EXPECT_EQ(b->next, words.size() + 1);
  EXPECT_EQ(b->next_line, 2u);
  b = t.reader.read(file, b->next, b->next_line);
  EXPECT_FALSE(b->has_fault);
  EXPECT_EQ(letter_of(b->words[0].slot), 'M');
}

// In memory and through any window: the feeder has other things to do than to look for the end of a line of gigabytes.
TEST(BlockReader, ABlockHasAMebibyteAtMost) {
  constexpr std::size_t kMost = 1 << 20;
  const std::string good = "G1" + std::string(kMost - 5, ' ') + "X1\nM30\n", end = "%" + std::string(2 * kMost, '\0');
  for (const char filling : {' ', '(', 'X', '\0'}) {
    const std::string longer = "G1 X1" + std::string(3 * kMost, filling) + "\nM30\n";
    for (const unsigned window : {512u, 65536u, 0u}) {
      Texts t(window == 0 ? 512 : window);
      const auto add = [&](const char* name, const std::string& text) { return window == 0 ? t.add_memory(name, text) : t.add_callback(name, text); };
      const Block* b = t.reader.read(add("good", good), 0, 1);
      ASSERT_NE(b, nullptr);
      EXPECT_FALSE(b->has_fault) << window;
      EXPECT_EQ(b->next, kMost);
      b = t.reader.read(add("end", end), 0, 1);
      ASSERT_NE(b, nullptr);
      EXPECT_TRUE(b->percent && !b->has_fault) << "behind it a tape has feed holes";
      b = t.reader.read(add("longer", longer), 0, 1);
      ASSERT_NE(b, nullptr);
      EXPECT_TRUE(b->has_fault) << window << " " << filling;
      EXPECT_EQ(b->fault.condition, Condition::block_too_long) << window << " " << filling;
      EXPECT_EQ(b->next, kMost) << window << " " << filling;
      EXPECT_EQ(b->next_line, 1u);
    }
  }
}

TEST(BlockReader, TheCutOfATooLongBlockIsNotTakenForAnotherFault) {
  Texts t(16);
  const unsigned file = t.add_callback("a", "N" + std::string(40, '0') + "1\nX1\n");
  const Block* b = t.reader.read(file, 0, 1);
  EXPECT_EQ(b->fault.condition, Condition::block_too_long);  // and not the sequence number 0
  EXPECT_EQ(t.reader.read(file, b->next, 2)->words.size(), 1u);
}

TEST(BlockReader, WhatStandsBehindASemicolonIsSeenThroughEveryWindow) {
  // The words of the first block alone are as long as the smallest of these windows: in no window may the text behind them be lost.
  const std::string text = "G1X1Y10G01X25F50; " + std::string(600, ' ') + "Y2\nM30\n";
  for (unsigned window = 16; window < 40; ++window) {
    Texts t(window, 32, with_semicolon(Semicolon::ends_line));
    const Block* b = t.reader.read(t.add_callback("a", text), 0, 1);
    ASSERT_NE(b, nullptr);
    EXPECT_TRUE(b->has_fault) << window;
    EXPECT_EQ(b->fault.condition, window < 18 ? Condition::block_too_long : Condition::behind_semicolon) << window;
    EXPECT_EQ(b->next_line, 2u) << window;
  }
}

TEST(BlockReader, ALongCommentDoesNotJoinWhatItParts) {
  const std::string text = "G1 X1(" + std::string(700, 'c') + ") 0 Z3\nM30\n";
  Texts memory, t(64);
  const Block* whole = memory.reader.read(memory.add_memory("a", text), 0, 1);
  const Block* b = t.reader.read(t.add_callback("a", text), 0, 1);
  ASSERT_TRUE(whole != nullptr && b != nullptr);
  EXPECT_TRUE(whole->has_fault);
  EXPECT_TRUE(b->has_fault);  // and not X10
  EXPECT_EQ(b->fault.condition, whole->fault.condition);
}

class ReaderOfRandomTexts : public testing::TestWithParam<Semicolon> {};
INSTANTIATE_TEST_SUITE_P(Semicolons, ReaderOfRandomTexts,
                         testing::Values(Semicolon::unknown, Semicolon::ends_line, Semicolon::comment, Semicolon::ends_block));

TEST_P(ReaderOfRandomTexts, AreTheSameThroughEveryWindow) {
  const IsoRules rules = with_semicolon(GetParam());
  std::mt19937 random(3);
  const char alphabet[] = "GXYZN0123456789.-#[]()=;%/ \n\r,<>IFDOMQ\t+*\x80?O\"";
  for (int round = 0; round < 1000; ++round) {
    std::string text;
    for (unsigned i = 0, n = random() % 300; i < n; ++i) text += alphabet[random() % (sizeof alphabet - 1)];
    Texts m(65536, 32, rules), t(320 + random() % 50, 32, rules), narrow(24 + random() % 30, 32, rules);
    ASSERT_EQ(t.all(t.add_callback("a", text)), m.all(m.add_memory("a", text))) << text;
    // For a narrow window blocks may be too long, but they are the same blocks.
    const unsigned a = narrow.add_callback("a", text), b = m.add_memory("b", text);
    uint64_t at = 0;
    for (uint32_t line = 1;;) {
      const Block* x = narrow.reader.read(a, at, line);
      const Block* y = m.reader.read(b, at, line);
      ASSERT_TRUE(x != nullptr && y != nullptr);
      ASSERT_EQ(x->end_of_text, y->end_of_text) << text;
      ASSERT_EQ(x->next, y->next) << text;
      ASSERT_EQ(x->next_line, y->next_line) << text;
      if (x->end_of_text) break;
      at = x->next;
      line = x->next_line;
    }
  }
}

TEST_P(ReaderOfRandomTexts, HaveTheSameHeadsForASearch) {
  // The search finds the head of a block only where reading finds it: nothing behind a ';' that ends the line.
  std::mt19937 random(5);
  const char alphabet[] = "N1X2;;( )\n\n/ ";
  for (int round = 0; round < 2000; ++round) {
    std::string text;
    for (unsigned i = 0, n = random() % 60; i < n; ++i) text += alphabet[random() % (sizeof alphabet - 1)];
    Texts t(65536, 32, with_semicolon(GetParam()));
    const unsigned file = t.add_memory("a", text);
    for (const uint32_t n : {1u, 2u, 12u, 22u}) {
      bool again = false;
      uint64_t offset = 0;
      uint32_t line = 1;
      const bool found = t.reader.find_sequence(file, n, &offset, &line, 0, 0, &again);
      bool read = false;
      uint64_t at = 0;
      for (uint32_t at_line = 1; !read;) {
        const Block* b = t.reader.read(file, at, at_line);
        ASSERT_NE(b, nullptr);
        if (b->end_of_text || (b->percent && at != 0)) break;
        read = b->has_n && b->n == n;
        if (read) break;
        if (b->has_fault || b->percent) {  // a head that cannot be read, or a start mark, does not count here
          read = found;
          offset = at;
          break;
        }
        at = b->next;
        at_line = b->next_line;
      }
      if (!found) continue;
      ASSERT_TRUE(read) << n << " in " << text;
      ASSERT_EQ(offset, at) << n << " in " << text;
    }
  }
}

TEST(BlockReader, CachedBlocksAreTheSame) {
  const std::string text = kMixed;
  for (unsigned cached : {0u, 1u, 2u, 5u, 64u}) {
    Texts t(96, cached);
    const unsigned file = t.add_callback("a", text);
    const auto first = t.all(file);
    for (int round = 0; round < 3; ++round) ASSERT_EQ(t.all(file), first) << cached;
  }
}

TEST(BlockReader, CacheIsUsed) {
  // The text of the host changes without the reader's knowledge, so that the old text shows what comes from the cache.
  Texts t(64, 64);
  const std::string old_text = "X1\nX2\nX3\n";
  const unsigned file = t.add_memory("a", old_text);
  t.all(file);
  t.all(file);
  const_cast<char&>(t.store.entry(file)->memory[1]) = '7';
  EXPECT_EQ(t.reader.read(file, 0, 1)->words[0].value, 1);
  t.reader.forget(file);
  EXPECT_EQ(t.reader.read(file, 0, 1)->words[0].value, 7);
}

TEST(BlockReader, ReplacedTextIsReadAfresh) {
  for (const bool callback : {false, true}) {
    Texts t(64, 64);
    const auto add = [&](const std::string& text) {
      return callback ? t.add_callback("a", text) : t.add_memory("a", text);
    };
    const unsigned file = add("X1\nX2\nX3\n");
    t.all(file);
    t.all(file);
    EXPECT_EQ(t.reader.read(file, 3, 2)->words[0].value, 2);
    EXPECT_EQ(add("Y5\nY6\nY7 M30\n"), file);
    const Block* b = t.reader.read(file, 3, 2);
    EXPECT_EQ(letter_of(b->words[0].slot), 'Y');
    EXPECT_EQ(b->words[0].value, 6);
    EXPECT_EQ(t.all(file).size(), 3u);
  }
}

TEST(BlockReader, LineOfACachedBlockFollowsTheCaller) {
  Texts t;
  const unsigned file = t.add_memory("a", "X1\nX2\n");
  t.all(file);
  t.reader.read(file, 0, 1);
  const Block* b = t.reader.read(file, 0, 11);
  EXPECT_EQ(b->line, 11u);
  EXPECT_EQ(b->next_line, 12u);
}

TEST(BlockReader, ManyTextsInTurn) {
  Texts t(64, 16);
  std::vector<unsigned> files;
  for (int i = 0; i < 12; ++i)
    files.push_back(t.add_callback("p" + std::to_string(i), "X" + std::to_string(i) + "\nY1\n"));
  for (int round = 0; round < 5; ++round) {
    for (int i = 0; i < 12; ++i) EXPECT_EQ(t.reader.read(files[i], 0, 1)->words[0].value, i);
  }
}

TEST(BlockReader, ReadFailures) {
  struct Host {
    std::string text = "G1 X1\nG1 X2\nG1 X3\n";
    long fail_beyond = 0;
    bool lie = false;
  } host;
  Texts t(8, 4);
  TextEntry entry;
  entry.user = &host;
  entry.size = host.text.size();
  entry.read = [](void* user, uint64_t offset, char* buffer, size_t size) -> long {
    Host& h = *static_cast<Host*>(user);
    if (h.lie) return static_cast<long>(size) + 1;
    if (h.fail_beyond != 0 && static_cast<long>(offset + size) > h.fail_beyond) return -1;
    size = std::min(size, h.text.size() - static_cast<size_t>(offset));
    std::memcpy(buffer, h.text.data() + offset, size);
    return static_cast<long>(size);
  };
  unsigned file = 0;
  ASSERT_EQ(t.store.add(entry, "a", &file), NC_OK);
  host.fail_beyond = 10;
  EXPECT_NE(t.reader.read(file, 0, 1), nullptr);
  EXPECT_EQ(t.reader.read(file, 6, 2), nullptr);
  host.fail_beyond = 0;
  ASSERT_NE(t.reader.read(file, 6, 2), nullptr);  // a failure is not remembered
  EXPECT_EQ(t.reader.read(file, 6, 2)->words[1].value, 2);
  host.lie = true;
  EXPECT_EQ(t.reader.read(file, 12, 3), nullptr);
  EXPECT_EQ(t.reader.read(99, 0, 1), nullptr);
}

/// A search that could not read the text finds nothing and reports that. It takes neither the same number elsewhere nor a program of the host
/// instead.
TEST(BlockReader, SearchesInATextThatHasChanged) {
  struct Host {
    std::string text;
    uint64_t changed_from = UINT64_MAX;
  } host;
  host.text = "N1 G1 X1\nWHILE[1]DO1\n" + std::string(600, ' ') + "\nEND1\nN7 X2\nM30\nO55\nM99\n";
  Texts t(64, 0);
  TextEntry entry;
  entry.user = &host;
  entry.size = host.text.size();
  entry.read = [](void* user, uint64_t offset, char* buffer, size_t size) -> long {
    const Host& h = *static_cast<Host*>(user);
    if (offset + size > h.changed_from) return NC_READ_CHANGED;
    std::memcpy(buffer, h.text.data() + offset, size);
    return static_cast<long>(size);
  };
  unsigned file = 0;
  ASSERT_EQ(t.store.add(entry, "a", &file), NC_OK);
  t.add_memory("O7", "M99\n");
  uint64_t offset = 0;
  uint32_t line = 1;
  bool again = false;
  host.changed_from = 300;
  EXPECT_FALSE(t.reader.find_sequence(file, 7, &offset, &line, 0, 0, &again));
  EXPECT_EQ(t.reader.failure(), Condition::program_changed);
  offset = host.text.find("   ");
  EXPECT_FALSE(t.reader.find_loop_end(file, 1, &offset, &line));
  EXPECT_EQ(t.reader.failure(), Condition::program_changed);
  bool asked = false;
  t.store.on_missing([](void* user, nc_control*, const char*) { return *static_cast<bool*>(user) = true, false; }, &asked, nullptr);
  EXPECT_FALSE(t.reader.find_program(55, file).valid());
  EXPECT_EQ(t.reader.failure(), Condition::program_changed);
  EXPECT_FALSE(asked);
  host.changed_from = UINT64_MAX;
  offset = 0;
  EXPECT_TRUE(t.reader.find_sequence(file, 7, &offset, &line, 0, 0, &again));
  EXPECT_EQ(t.reader.failure(), Condition::none);
  EXPECT_TRUE(t.reader.find_program(55, file).valid());
}

TEST(BlockReader, TextThatIsShorterThanPromised) {
  Texts t(64);
  TextEntry entry;
  entry.size = 1000;
  entry.read = [](void*, uint64_t offset, char* buffer, size_t size) -> long {
    const std::string text = "G1 X1\nG2 X2";
    if (offset >= text.size()) return 0;
    size = std::min(size, text.size() - static_cast<size_t>(offset));
    std::memcpy(buffer, text.data() + offset, size);
    return static_cast<long>(size);
  };
  unsigned file = 0;
  ASSERT_EQ(t.store.add(entry, "a", &file), NC_OK);
  EXPECT_EQ(t.all(file).size(), 2u);
}

}  // namespace
}  // namespace nc::test
