// SPDX-License-Identifier: Apache-2.0
// How fast text becomes blocks, and how fast expressions are evaluated. items_per_second of the benches that read
// text is blocks per second.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

#include "dialect/iso_lexer.hpp"
#include "macro/expression.hpp"
#include "program/store.hpp"

namespace {

nc::IsoRules m700_like() {
  nc::IsoRules rules = nc::iso_rules();
  rules.semicolon = nc::Semicolon::ends_line;
  rules.macros = rules.skip_numbers = rules.comma_words = rules.angle_names = true;
  rules.slash_only_at_head = false;
  for (nc::WordFormat& f : rules.word) f.known = true;
  for (char c : {'D', 'H', 'L', 'M', 'N', 'O', 'S', 'T'}) rules.word[c - 'A'].integer = true;
  return rules;
}

/// Lines as a CAM system writes them for a surface.
std::string surface(unsigned lines) {
  std::string text;
  char line[80];
  for (unsigned i = 0; i < lines; ++i) {
    std::snprintf(line, sizeof line, "G1 X%.3f Y%.3f Z%.4f\n", 0.137 * (i % 1000), -0.25 * (i % 777),
                  3.0 - 0.0031 * (i % 613));
    text += line;
  }
  return text;
}

struct Reader {
  std::unique_ptr<char[]> memory = std::make_unique<char[]>(4 << 20);
  nc::Arena arena{memory.get(), 4 << 20};
  nc::IsoRules rules = m700_like();
  nc::ProgramStore store;
  nc::BlockReader reader;
  Reader() {
    store.create(8, 0, {rules.program_letter, 99999999}, arena);
    reader.create(&store, &rules, 65536, 256, arena);
  }
};

void run(benchmark::State& state, Reader& reader, size_t bytes) {
  uint64_t blocks = 0;
  for (auto _ : state) {
    uint64_t at = 0;
    uint32_t line = 1;
    double sum = 0;
    for (;;) {
      const nc::Block* b = reader.reader.read(0, at, line);
      if (b->end_of_text) break;
      if (b->words.size() != 0) sum += b->words[0].value;
      at = b->next;
      line = b->next_line;
      ++blocks;
    }
    benchmark::DoNotOptimize(sum);
    state.PauseTiming();
    reader.reader.forget(0);  // so that the next round does not read from the cache
    state.ResumeTiming();
  }
  state.SetItemsProcessed(static_cast<int64_t>(blocks));
  state.SetBytesProcessed(static_cast<int64_t>(state.iterations() * bytes));
}

void lexer_alone(benchmark::State& state) {
  const std::string text = surface(1000);
  const nc::IsoRules rules = m700_like();
  auto block = std::make_unique<nc::Block>();
  int64_t blocks = 0;
  for (auto _ : state) {
    for (size_t at = 0; at < text.size(); ++blocks) {
      at += nc::lex_block(text.data() + at, text.size() - at, rules, rules.semicolon, nullptr, *block).used;
      benchmark::DoNotOptimize(block->words.size());
    }
  }
  state.SetItemsProcessed(blocks);
}
BENCHMARK(lexer_alone);

void read_memory(benchmark::State& state) {
  const std::string text = surface(200000);
  Reader r;
  nc::TextEntry entry;
  entry.memory = text.data();
  entry.size = text.size();
  r.store.add(entry, "a.nc", nullptr);
  run(state, r, text.size());
}
BENCHMARK(read_memory)->Unit(benchmark::kMillisecond);

void read_at_callback(benchmark::State& state) {
  const std::string text = surface(200000);
  Reader r;
  nc::TextEntry entry;
  entry.user = const_cast<std::string*>(&text);
  entry.size = text.size();
  entry.read = [](void* user, uint64_t offset, char* buffer, size_t size) -> long {
    const auto& t = *static_cast<const std::string*>(user);
    size = std::min(size, t.size() - static_cast<size_t>(offset));
    std::memcpy(buffer, t.data() + offset, size);
    return static_cast<long>(size);
  };
  r.store.add(entry, "a.nc", nullptr);
  run(state, r, text.size());
}
BENCHMARK(read_at_callback)->Unit(benchmark::kMillisecond);

/// A loop body of 20 blocks is read again and again, from the cache.
void read_loop(benchmark::State& state) {
  const std::string text = surface(20);
  Reader r;
  nc::TextEntry entry;
  entry.memory = text.data();
  entry.size = text.size();
  r.store.add(entry, "a.nc", nullptr);
  int64_t blocks = 0;
  for (auto _ : state) {
    uint64_t at = 0;
    uint32_t line = 1;
    for (;;) {
      const nc::Block* b = r.reader.read(0, at, line);
      if (b->end_of_text) break;
      benchmark::DoNotOptimize(b->words[0].value);
      at = b->next;
      line = b->next_line;
      ++blocks;
    }
  }
  state.SetItemsProcessed(blocks);
}
BENCHMARK(read_loop);

void find_sequence(benchmark::State& state) {
  std::string text = surface(200000) + "N777 M30\n";
  Reader r;
  nc::TextEntry entry;
  entry.memory = text.data();
  entry.size = text.size();
  r.store.add(entry, "a.nc", nullptr);
  for (auto _ : state) {
    uint64_t at = 0;
    uint32_t line = 1;
    bool again = false;
    r.reader.forget(0);  // the reader would remember the place after the first search
    if (!r.reader.find_sequence(0, 777, &at, &line, 0, 0, &again)) state.SkipWithError("not found");
  }
  state.SetItemsProcessed(state.iterations() * 200001);
  state.SetBytesProcessed(static_cast<int64_t>(state.iterations() * text.size()));
}
BENCHMARK(find_sequence)->Unit(benchmark::kMillisecond);

void evaluate(benchmark::State& state, const char* text) {
  auto block = std::make_unique<nc::Block>();
  block->clear();
  size_t at = 0;
  uint16_t code = 0;
  nc::Fault fault;
  if (!nc::compile_expression(*block, text, std::strlen(text), &at, false, &code, &fault))
    state.SkipWithError("does not compile");
  double variables[200];
  for (int i = 0; i < 200; ++i) variables[i] = i * 0.5;
  const nc::VariableReader reader{variables,
                                  [](void* self, uint32_t number, nc::Value* value, nc::Fault*, uint32_t*) {
                                    *value = nc::Value::of(static_cast<double*>(self)[number]);
                                    return nc::Eval::ok;
                                  },
                                  nullptr};
  nc::Value value;
  uint32_t sync = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(nc::evaluate(*block, code, reader, {}, &value, &fault, &sync));
    benchmark::DoNotOptimize(value.number);
  }
}
BENCHMARK_CAPTURE(evaluate, variable, "#101");
BENCHMARK_CAPTURE(evaluate, sum, "#101+#102*2");
BENCHMARK_CAPTURE(evaluate, polar, "#101*COS[#102]");
BENCHMARK_CAPTURE(evaluate, manual, "-[[[[[#120]/2+15.]*3-#100]/#150+#125+#128]*#130+#132]");

}  // namespace
