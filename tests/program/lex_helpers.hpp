// SPDX-License-Identifier: Apache-2.0
// Shared by the tests of program/ and macro/: word formats like those of the two dialects, a text as a block, a store.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "alarm/condition.hpp"
#include "dialect/iso_lexer.hpp"
#include "program/store.hpp"

namespace nc::test {

inline IsoRules m700_rules() {
  IsoRules rules = iso_rules();
  rules.macros = rules.statements = rules.skip_numbers = rules.comma_words = rules.angle_names = true;
  rules.semicolon = rules.mdi_semicolon = Semicolon::ends_block;
  rules.slash_only_at_head = false;
  for (WordFormat& f : rules.word) f.known = true;
  for (char c : {'D', 'H', 'L', 'M', 'N', 'O', 'S', 'T'}) rules.word[c - 'A'].integer = true;
  rules.word['N' - 'A'].integer_digits = 6;
  rules.word['G' - 'A'].integer_digits = 3;
  rules.word['G' - 'A'].fraction_digits = 1;
  return rules;
}

inline IsoRules dgshape_rules() {
  IsoRules rules = iso_rules();
  for (char c :
       {'A', 'D', 'F', 'G', 'H', 'I', 'J', 'K', 'L', 'M', 'N', 'O', 'P', 'Q', 'R', 'S', 'T', 'X', 'Y', 'Z'}) {
    rules.word[c - 'A'].known = true;
  }
  for (char c : {'D', 'H', 'K', 'N', 'O', 'S', 'T'}) rules.word[c - 'A'].integer = true;
  return rules;
}

inline IsoRules with_semicolon(Semicolon semicolon) {
  IsoRules rules = m700_rules();
  rules.semicolon = semicolon;
  return rules;
}

inline std::unique_ptr<Block> lex(const std::string& text, const IsoRules& rules = m700_rules(),
                                  LexResult* result = nullptr) {
  auto block = std::make_unique<Block>();
  // A copy of exactly this size, so that a sanitizer finds a read beyond it.
  const std::vector<char> exact(text.begin(), text.end());
  const LexResult r = lex_block(exact.data(), exact.size(), rules, rules.semicolon, nullptr, *block);
  if (result != nullptr) *result = r;
  return block;
}

inline Condition fault_of(const std::string& text, const IsoRules& rules = m700_rules()) {
  const auto block = lex(text, rules);
  return block->has_fault ? block->fault.condition : Condition::none;
}

inline std::string text_of(const Block& block, unsigned at, unsigned length) {
  return std::string(block.text.begin() + at, length);
}

/// Everything that lexing produced, as text: two blocks are equal if their texts are.
inline std::string dump(const Block& b) {
  std::string s;
  const auto add = [&s](const char* name, long long v) {
    s += std::string(name) + "=" + std::to_string(v) + " ";
  };
  add("next", static_cast<long long>(b.next));
  add("line", b.line);
  add("next_line", b.next_line);
  add("percent", b.percent);
  add("end", b.end_of_text);
  add("skip", b.skip);
  add("has_n", b.has_n);
  add("n", b.n);
  add("has_o", b.has_o);
  add("o", b.o);
  add("empty", b.empty);
  add("fault", b.has_fault ? static_cast<int>(b.fault.condition) : 0);
  for (const Word& w : b.words) {
    s += "\n word ";
    s += letter_of(w.slot);
    char number[48];
    std::snprintf(number, sizeof number, " %a", w.value);
    s += number;
    add(" flags", w.flags);
    add("index", w.index);
    add("column", w.column);
    add("code", w.code);
  }
  for (const Statement& t : b.statements) {
    s += "\n statement ";
    add("kind", static_cast<int>(t.kind));
    add("target", t.target);
    add("value", t.value);
    add("number", t.number);
    s += text_of(b, t.text, t.text_length);
  }
  s += "\n code ";
  for (uint8_t c : b.code) s += std::to_string(c) + ",";
  for (double c : b.constants) s += std::to_string(c) + ",";
  s += "\n text " + std::string(b.text.begin(), b.text.size());
  s += "\n name " + text_of(b, b.name, b.name_length);
  return s;
}

/// A store with its reader; texts in memory or through a callback that gives few bytes at a time.
class Texts {
 public:
  explicit Texts(unsigned window = 65536, unsigned cached = 32, IsoRules lex_rules = m700_rules())
      : rules(lex_rules),
        memory_(std::make_unique_for_overwrite<char[]>(kMemory)),
        arena_(memory_.get(), kMemory) {
    store.create(16, 0, {rules.program_letter, 99999999}, arena_);
    reader.create(&store, &rules, window, cached, arena_);
  }

  unsigned add_memory(const std::string& name, const std::string& text) {
    TextEntry entry;
    kept_.push_back(std::make_unique<std::string>(text));
    entry.memory = kept_.back()->data();
    entry.size = text.size();
    unsigned file = 0;
    EXPECT_EQ(store.add(entry, name.c_str(), &file), NC_OK);
    return file;
  }

  unsigned add_callback(const std::string& name, const std::string& text) {
    TextEntry entry;
    kept_.push_back(std::make_unique<std::string>(text));
    entry.user = kept_.back().get();
    entry.size = text.size();
    entry.read = [](void* user, uint64_t offset, char* buffer, size_t size) -> long {
      const std::string& t = *static_cast<std::string*>(user);
      if (offset >= t.size()) return 0;
      size_t n = std::min(size, t.size() - static_cast<size_t>(offset));
      if (n > 7) n -= n % 3;  // a host may give fewer bytes than it is asked for
      std::memcpy(buffer, t.data() + offset, n);
      return static_cast<long>(n);
    };
    unsigned file = 0;
    EXPECT_EQ(store.add(entry, name.c_str(), &file), NC_OK);
    return file;
  }

  /// All blocks of a text as dump() writes them.
  std::vector<std::string> all(unsigned file) {
    std::vector<std::string> blocks;
    uint64_t at = 0;
    uint32_t line = 1;
    for (;;) {
      const Block* b = reader.read(file, at, line);
      EXPECT_NE(b, nullptr);
      if (b == nullptr) return blocks;
      EXPECT_EQ(b->begin, at);
      EXPECT_EQ(b->line, line);
      EXPECT_EQ(b->file, file);
      if (b->end_of_text) return blocks;
      EXPECT_GT(b->next, at);
      if (b->next <= at) return blocks;
      blocks.push_back(dump(*b));
      at = b->next;
      line = b->next_line;
    }
  }

  IsoRules rules;
  ProgramStore store;
  BlockReader reader;

 private:
  static constexpr size_t kMemory = 512 << 10;
  std::unique_ptr<char[]> memory_;
  Arena arena_;
  std::vector<std::unique_ptr<std::string>> kept_;
};

}  // namespace nc::test
