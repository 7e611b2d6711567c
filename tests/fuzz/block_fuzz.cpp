// SPDX-License-Identifier: Apache-2.0
// Any bytes as a program text: the reader goes through it to its end, a narrow window finds the same blocks
// as the whole text, the searches agree with the lexer, all expressions can be run. The first byte chooses
// dialect and window.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "dialect/iso_lexer.hpp"
#include "macro/expression.hpp"
#include "program/store.hpp"

namespace {

[[noreturn]] void broken(const char* what) {
  std::fprintf(stderr, "broken: %s\n", what);
  std::abort();
}

struct Text {
  const char* data;
  size_t size;
};

long read_at(void* user, uint64_t offset, char* buffer, size_t size) {
  const Text& t = *static_cast<const Text*>(user);
  if (offset >= t.size) return 0;
  if (size > t.size - offset) size = t.size - static_cast<size_t>(offset);
  std::memcpy(buffer, t.data + offset, size);
  return static_cast<long>(size);
}

nc::IsoRules rules_of(uint8_t choice) {
  nc::IsoRules rules = nc::iso_rules();
  const bool macros = (choice & 1) == 0;
  rules.macros = rules.statements = rules.skip_numbers = rules.comma_words = rules.angle_names = macros;
  if ((choice & 0x80) != 0) rules.formula = nc::Formula::ngc;
  rules.semicolon = macros ? static_cast<nc::Semicolon>(choice >> 1 & 3) : nc::Semicolon::unknown;
  for (unsigned i = 0; i < 26; ++i) {
    rules.word[i].known = macros || i % 5 != 0;
    rules.word[i].integer = i % 7 == 0;
    rules.word[i].integer_digits = static_cast<uint8_t>(1 + i % 19);
    rules.word[i].fraction_digits = static_cast<uint8_t>(i % 9);
  }
  return rules;
}

nc::Eval variable(void*, uint32_t number, nc::Value* value, nc::Fault*, uint32_t*) {
  *value = number % 3 == 0 ? nc::Value{} : nc::Value::of(number * 0.5 - 20);
  return nc::Eval::ok;
}

void run_expressions(const nc::Block& block) {
  const nc::VariableReader reader{nullptr, variable, nullptr};
  nc::Value value;
  nc::Fault fault;
  uint32_t sync = 0;
  for (const nc::Word& w : block.words) {
    if ((w.flags & nc::kWordExpression) != 0) nc::evaluate(block, w.code, reader, {}, &value, &fault, &sync);
  }
  for (const nc::Statement& s : block.statements) {
    if (s.text + s.text_length > static_cast<int>(block.text.size())) broken("text of a statement");
    using K = nc::StatementKind;
    const bool target = s.kind == K::assign || s.kind == K::if_goto || s.kind == K::go_to;
    const bool formula =
        s.kind == K::assign || s.kind == K::if_goto || s.kind == K::while_do || s.kind == K::if_then;
    if (target) nc::evaluate(block, s.target, reader, {}, &value, &fault, &sync);
    if (formula) nc::evaluate(block, s.value, reader, {}, &value, &fault, &sync);
  }
}

struct Fixture {
  static constexpr size_t kMemory = 256 << 10;
  std::unique_ptr<char[]> memory{new char[kMemory]};
  nc::Arena arena{memory.get(), kMemory};
  nc::ProgramStore store;
  nc::IsoRules rules;
  nc::BlockReader whole, narrow;
  Fixture(uint8_t choice) : rules(rules_of(choice)) {
    store.create(2, 0, {rules.program_letter, 99999999}, arena);
    whole.create(&store, &rules, 64, 8, arena);
    narrow.create(&store, &rules, 16 + choice / 2, choice % 16, arena);
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  Fixture f(data[0]);
  Text text{reinterpret_cast<const char*>(data) + 1, size - 1};
  nc::TextEntry entry;
  entry.memory = text.data;
  entry.size = text.size;
  f.store.add(entry, "memory", nullptr);
  entry.memory = nullptr;
  entry.read = read_at;
  entry.user = &text;
  f.store.add(entry, "callback", nullptr);
  for (int round = 0; round < 2; ++round) {  // the second time from the cache
    uint64_t at = 0;
    for (uint32_t line = 1;;) {
      const nc::Block* a = f.whole.read(0, at, line);
      const nc::Block* b = f.narrow.read(1, at, line);
      if (a == nullptr || b == nullptr) broken("no block");
      if (a->next != b->next || a->next_line != b->next_line || a->end_of_text != b->end_of_text ||
          a->percent != b->percent || a->skip != b->skip) {
        broken("the window shows");
      }
      // A block that is too long for the window has a fault there.
      if (!b->has_fault && (a->has_fault || a->n != b->n || a->o != b->o ||
                            a->words.size() != b->words.size() || a->code.size() != b->code.size())) {
        broken("the window changes a block");
      }
      if (a->end_of_text) break;
      if (a->next <= at || a->next > text.size) broken("no progress");
      run_expressions(*a);
      run_expressions(*b);
      at = a->next;
      line = a->next_line;
    }
  }
  for (uint32_t n : {1u, 10u}) {
    uint64_t x = 0, y = 0;
    uint32_t x_line = 1, y_line = 1;
    bool again = false;
    const bool found = f.whole.find_sequence(0, n, &x, &x_line, 0, 0, &again);
    if (found != f.narrow.find_sequence(1, n, &y, &y_line, 0, 0, &again) || x != y || x_line != y_line)
      broken("find_sequence");
    if (f.whole.find_program(n, 0).offset != f.narrow.find_program(n, 1).offset) broken("find_program");
    x = y = 0;
    x_line = y_line = 1;
    if (f.whole.find_loop_end(0, n, &x, &x_line) && x > text.size) broken("find_loop_end");
    f.narrow.find_loop_end(1, n, &y, &y_line);
  }
  return 0;
}
