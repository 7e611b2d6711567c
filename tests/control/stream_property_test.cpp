// SPDX-License-Identifier: Apache-2.0
// What is promised of the stream, tested with random programs: after a rewind to a mark the same items come again with the same serials and
// the same variables; windows, look-ahead, budgets, and other controls in the same process change nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "support/pull.hpp"
#include "support/random_program.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

const auto kPrograms = static_cast<uint32_t>(seeds(120, 30));

void prepare(Bench& bench, const RandomProgram& program) {
  for (unsigned n = 1; n <= 9; ++n) bench.tool(n, 0.2 * n);
  bench.work_offset(1, {1, 2, 3}).work_offset(3, {-5, 0, 1});
  bench.param("8013", "0.5").param("8012", "0.3").param("8103", "1");
  bench.input[0] = 0x55;
  bench.skip_at = [](const nc_item& move) -> std::optional<double> {
    if (move.serial % 3 == 0) return std::nullopt;
    return 0.1 + static_cast<double>(move.serial % 7) / 10;
  };
  for (size_t i = 0; i < program.subs.size(); ++i) bench.add("O" + std::to_string(i + 1), program.subs[i]);
}

/// Everything that a program leaves, as text.
std::string leavings(Bench& bench) {
  std::string all;
  uint32_t number = 0;
  double value = 0;
  for (; nc_variable_next(bench.control(), 0, number, &number, &value) == NC_OK; ++number) all += std::to_string(number) + "=" + brief(value) + " ";
  for (unsigned n = 1; n <= 20; ++n) all += "T" + brief(bench.tool_now(n)) + " ";
  for (unsigned k = 0; k <= 6; ++k)
    for (unsigned axis = 0; axis < 3; ++axis) all += "W" + brief(bench.work_offset_now(k, axis)) + " ";
  for (unsigned word = 0; word < NC_WORDS; ++word) {
    uint32_t bits = 0;
    nc_interface_output_get(bench.control(), 0, word, &bits);
    all += "O" + std::to_string(bits) + " ";
  }
  return all;
}

Path texts(const std::vector<Step>& steps) {
  Path all;
  for (const Step& step : steps) all.push_back(exactly(step));
  return all;
}

/// Whether two streams are the same; if not, the message shows the first difference.
testing::AssertionResult same(const Path& a, const Path& b) {
  for (size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    const std::string left = i < a.size() ? a[i] : "(nothing)", right = i < b.size() ? b[i] : "(nothing)";
    if (left != right) return testing::AssertionFailure() << "item " << i << " differs:\n  " << left << "\n  " << right;
  }
  return testing::AssertionSuccess();
}

struct Reference {
  std::vector<Step> steps;
  Path text;
  std::string left;
  std::string alarm;
};

Reference reference(const RandomProgram& program) {
  Bench bench;
  prepare(bench, program);
  const Outcome run = bench.run(program.main);
  return {run.steps, texts(run.steps), leavings(bench), run.alarm};
}

TEST(RandomPrograms, AreWorthTesting) {
  unsigned moves = 0, syncs = 0, ended = 0, deep = 0;
  for (uint32_t seed = 0; seed < kPrograms; ++seed) {
    const Reference r = reference(ProgramMaker(seed).make());
    ended += r.alarm.empty();
    for (const Step& step : r.steps) {
      moves += step.item.kind == NC_ITEM_MOVE;
      syncs += step.item.kind == NC_ITEM_SYNC;
      deep += step.item.source.depth > 1;
    }
  }
  EXPECT_GT(ended, kPrograms * 2 / 3);
  EXPECT_GT(moves, kPrograms * 40);
  EXPECT_GT(syncs, kPrograms * 2);
  EXPECT_GT(deep, kPrograms);
}

TEST(Rewind, FromTheEndToAnyMark) {
  unsigned refused = 0;
  for (uint32_t seed = 0; seed < kPrograms; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RandomProgram program = ProgramMaker(seed).make();
    const Reference expected = reference(program);
    Bench bench(NC_DIALECT_M700, [](nc_config& c) { c.look_ahead = 4096; });
    prepare(bench, program);
    const std::string before = leavings(bench);
    ASSERT_TRUE(same(texts(bench.run(program.main).steps), expected.text));
    std::mt19937 random(seed);
    std::vector<const Step*> marks;
    for (const Step& step : expected.steps)
      if (step.item.kind == NC_ITEM_MARK && step.item.u.mark.report) marks.push_back(&step);
    for (unsigned i = 0; i < 4 && !marks.empty(); ++i) {
      const Step* mark = marks[random() % marks.size()];
      const nc_status went = bench.rewind(mark->item.serial, mark->machine);
      if (went == NC_E_NOT_FOUND) {  // in a contour a read of the machine goes in front of blocks that wait for their corner: no place to read again from
        ++refused;
        continue;
      }
      ASSERT_EQ(went, NC_OK) << mark->item.serial;
      const Path rest = texts(bench.finish().steps);
      const Path wanted(expected.text.begin() + static_cast<long>(mark->item.serial), expected.text.end());
      ASSERT_TRUE(same(rest, wanted)) << "from " << mark->item.serial;
      ASSERT_EQ(leavings(bench), expected.left) << "from " << mark->item.serial;
    }
    // Serial 0 is the head of the program: after a rewind to it the program has changed nothing.
    ASSERT_EQ(bench.rewind(0, nc_axes{}), NC_OK);
    EXPECT_EQ(leavings(bench), before);
    ASSERT_TRUE(same(texts(bench.finish().steps), expected.text));
    EXPECT_EQ(leavings(bench), expected.left);
  }
  EXPECT_LT(refused, kPrograms / 10);
}

TEST(Rewind, InTheMiddleOfARun) {
  unsigned refused = 0, done = 0;
  for (uint32_t seed = 0; seed < kPrograms; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RandomProgram program = ProgramMaker(seed).make();
    const Reference expected = reference(program);
    Bench bench;
    prepare(bench, program);
    bench.start(program.main);
    std::mt19937 random(seed * 7 + 1);
    std::vector<Step> steps;
    unsigned rewinds = 0;
    for (;;) {
      Step step;
      const nc_status status = bench.pull(&step, 1 + random() % 5);
      if (status == NC_BUDGET) continue;
      if (status != NC_OK) break;
      steps.push_back(step);
      ASSERT_EQ(step.item.serial, steps.size());  // no gaps
      if (random() % 30 != 0 || rewinds > 40) continue;
      // Back to one of the last marks.
      size_t back = 1 + random() % 60;
      size_t i = steps.size();
      while (i > 0 && back > 0) {
        --i;
        if (steps[i].item.kind == NC_ITEM_MARK && steps[i].item.u.mark.report) --back;
      }
      if (back != 0) continue;
      const nc_status went = bench.rewind(steps[i].item.serial, steps[i].machine);
      if (went == NC_E_NOT_FOUND) {  // in a contour a read of the machine goes in front of blocks that wait for their corner: no place to read again from
        ++refused;
        continue;
      }
      ASSERT_EQ(went, NC_OK);
      steps.resize(i + 1);
      ++rewinds;
      ++done;
    }
    ASSERT_TRUE(same(texts(steps), expected.text));
    EXPECT_EQ(leavings(bench), expected.left);
  }
  EXPECT_LT(refused, done / 20);
}

/// Whether reading can be taken back to this mark when nothing behind it has been read. In a contour whose blocks depend on one before the mark it cannot
/// (nc/run.h), which has nothing to do with the age of the mark.
bool resumes_at_once(const RandomProgram& program, const Step& mark) {
  Bench bench(NC_DIALECT_M700, [](nc_config& c) { c.look_ahead = 64; });
  prepare(bench, program);
  bench.start(program.main);
  for (Step step; step.item.serial < mark.item.serial;) {
    const nc_status status = bench.pull(&step);
    if (status != NC_OK && status != NC_BUDGET) return false;
  }
  return bench.rewind(mark.item.serial, mark.machine) == NC_OK;
}

TEST(Rewind, ReachesTheWholeLookAhead) {
  unsigned refused = 0, done = 0;
  for (uint32_t seed = 0; seed < kPrograms; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RandomProgram program = ProgramMaker(seed).make();
    Bench bench(NC_DIALECT_M700, [](nc_config& c) { c.look_ahead = 64; });
    prepare(bench, program);
    const Outcome run = bench.run(program.main);
    const Path expected = texts(run.steps);
    std::vector<const Step*> marks;
    for (const Step& step : run.steps)
      if (step.item.kind == NC_ITEM_MARK && step.item.u.mark.report) marks.push_back(&step);
    if (marks.size() < 64) continue;
    const Step* oldest = marks[marks.size() - 64];
    const nc_status went = bench.rewind(oldest->item.serial, oldest->machine);
    if (went == NC_E_NOT_FOUND) {
      ASSERT_FALSE(resumes_at_once(program, *oldest)) << "mark " << oldest->item.serial << " is not known any more";
      ++refused;
      continue;
    }
    ASSERT_EQ(went, NC_OK);
    ++done;
    const Path wanted(expected.begin() + static_cast<long>(oldest->item.serial), expected.end());
    ASSERT_TRUE(same(texts(bench.finish().steps), wanted));
  }
  EXPECT_LE(refused, done / 20);
}

TEST(Rewind, WhatTheHostChangesStays) {  // nc/run.h: changed offsets and variables act from the next block
  Bench bench;
  bench.start("#100=1\nG0 X#100\n#100=2\nG10 L2 P1 Y5.\nG0 X#101 Y0\n#101=9\nM30");
  std::vector<Step> steps = bench.finish().steps;
  ASSERT_EQ(bench.var_now(101), 9);
  const auto mark = std::find_if(steps.begin(), steps.end(), [](const Step& s) { return s.item.kind == NC_ITEM_MARK && s.item.source.line == 2; });
  ASSERT_NE(mark, steps.end());
  bench.var(101, 33).work_offset(1, {0, 0, 7});
  ASSERT_EQ(bench.rewind(mark->item.serial, mark->machine), NC_OK);
  EXPECT_EQ(bench.var_now(100), 1);    // the program's own write is taken back
  EXPECT_EQ(bench.var_now(101), 33);   // the write of the host is not
  EXPECT_EQ(bench.work_offset_now(1, 1), 0);
  EXPECT_EQ(bench.finish().path(), (Path{"rapid 33 5 0"}));
  EXPECT_EQ(bench.work_offset_now(1, 2), 7);
}

TEST(Rewind, TheBlockInExecutionIsTheSameAgain) {  // M700 13.5.5: macro statements are executed together with the block before them
  Bench bench;
  bench.start("N1 G54 G0 X1.\nN2 #1=1\nN3 #500=#4314\nN4 G0 X2.\nN5 #501=#4314\nN6 #502=#4314\nM30");
  const std::vector<Step> steps = bench.finish().steps;
  const double expected[] = {1, 4, 4};
  for (unsigned i = 0; i < 3; ++i) ASSERT_EQ(bench.var_now(500 + i), expected[i]);
  unsigned marks = 0;
  for (const Step& step : steps) {
    if (step.item.kind != NC_ITEM_MARK || !step.item.u.mark.report) continue;
    ++marks;
    ASSERT_EQ(bench.rewind(step.item.serial, step.machine), NC_OK);
    bench.finish();
    for (unsigned i = 0; i < 3; ++i) EXPECT_EQ(bench.var_now(500 + i), expected[i]) << "from line " << step.item.source.line;
  }
  EXPECT_EQ(marks, 7u);
}

TEST(Rewind, SwitchesActFromTheNextBlock) {  // M700 4.2 with a recalculation request
  Bench bench;
  bench.start("G0 X1.\n/X2.\nX3.\nM30");
  const std::vector<Step> steps = bench.finish().steps;
  nc_switches_set(bench.control(), 0, 1u << 1, 0);
  ASSERT_EQ(steps[1].item.kind, NC_ITEM_MARK);
  ASSERT_EQ(bench.rewind(steps[1].item.serial, steps[1].machine), NC_OK);
  EXPECT_EQ(bench.finish().path(), (Path{"rapid 3 0 0"}));
}

TEST(Rewind, DoesNotReachIntoTheRunBefore) {
  Bench bench;
  bench.run("#100=1\n#101=2\nG10 L2 P1 X5.\n#102=3\n#103=4\nM30");
  bench.start("G0 X1.\nG0 X2.\n#104=5\nM30");
  const std::vector<Step> steps = bench.finish().steps;
  ASSERT_EQ(bench.rewind(steps[1].item.serial, steps[1].machine), NC_OK);
  EXPECT_EQ(bench.var_now(100), 1);
  EXPECT_EQ(bench.var_now(103), 4);
  EXPECT_TRUE(std::isnan(bench.var_now(104)));
  EXPECT_EQ(bench.work_offset_now(1, 0), 5);
  EXPECT_EQ(bench.finish().path(), (Path{"rapid 7 0 0"}));
}

TEST(Rewind, OnlyToMarks) {
  Bench bench;
  bench.start("G0 X1.\nX2.\nM30");
  const std::vector<Step> steps = bench.finish().steps;
  for (const Step& step : steps) {
    const bool mark = step.item.kind == NC_ITEM_MARK;
    EXPECT_EQ(nc_rewind(bench.control(), 0, step.item.serial) == NC_OK, mark) << step.item.serial;
    bench.finish();
  }
  EXPECT_EQ(nc_rewind(bench.control(), 0, 12345), NC_E_NOT_FOUND);
}

TEST(Stream, SizesAndBudgetsChangeNothing) {
  for (uint32_t seed = 0; seed < kPrograms; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RandomProgram program = ProgramMaker(seed).make();
    const Reference expected = reference(program);
    std::mt19937 random(seed + 99);
    for (unsigned i = 0; i < 3; ++i) {
      Bench bench(NC_DIALECT_M700, [&](nc_config& c) {
        c.look_ahead = 64u << random() % 8;
        c.window_bytes = 512 + random() % 5000;
      });
      prepare(bench, program);
      ASSERT_TRUE(same(texts(bench.run(program.main, 1 + random() % 20).steps), expected.text));
      EXPECT_EQ(leavings(bench), expected.left);
    }
  }
}

/// A text behind a callback that gives fewer bytes than it is asked for, at random.
struct StingyText {
  std::string text;
  std::mt19937 random{1};
  static long read(void* user, uint64_t offset, char* buffer, size_t size) {
    StingyText& t = *static_cast<StingyText*>(user);
    if (offset >= t.text.size()) return 0;
    size_t n = std::min<size_t>(size, t.text.size() - static_cast<size_t>(offset));
    n = 1 + t.random() % n;
    std::memcpy(buffer, t.text.data() + offset, n);
    return static_cast<long>(n);
  }
};

TEST(Stream, TextsReadInPieces) {
  for (uint32_t seed = 0; seed < kPrograms; seed += 2) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RandomProgram program = ProgramMaker(seed).make();
    const Reference expected = reference(program);
    Bench bench(NC_DIALECT_M700, [](nc_config& c) { c.window_bytes = 512; });
    prepare(bench, program);
    std::vector<std::unique_ptr<StingyText>> texts_of_subs;
    for (size_t i = 0; i < program.subs.size(); ++i) {
      texts_of_subs.push_back(std::make_unique<StingyText>());
      texts_of_subs.back()->text = program.subs[i];
      ASSERT_EQ(nc_program_add(bench.control(), ("O" + std::to_string(i + 1)).c_str(), &StingyText::read, texts_of_subs.back().get(),
                               program.subs[i].size(), nullptr),
                NC_OK);
    }
    StingyText main;
    main.text = program.main;
    unsigned file = 0;
    ASSERT_EQ(nc_program_add(bench.control(), "main", &StingyText::read, &main, main.text.size(), &file), NC_OK);
    ASSERT_EQ(nc_program_select(bench.control(), 0, file), NC_OK);
    ASSERT_TRUE(same(texts(bench.finish().steps), expected.text));
  }
}

TEST(Stream, TwoControlsDoNotKnowEachOther) {
  for (uint32_t seed = 0; seed + 1 < kPrograms; seed += 2) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RandomProgram program[2] = {ProgramMaker(seed).make(), ProgramMaker(seed + 1).make()};
    const Reference expected[2] = {reference(program[0]), reference(program[1])};
    Bench bench[2];
    std::vector<Step> steps[2];
    for (unsigned i = 0; i < 2; ++i) prepare(bench[i], program[i]), bench[i].start(program[i].main);
    std::mt19937 random(seed);
    bool open[2] = {true, true};
    while (open[0] || open[1]) {
      const unsigned i = random() % 2;
      if (!open[i]) continue;
      Step step;
      const nc_status status = bench[i].pull(&step, 3);
      if (status == NC_OK) steps[i].push_back(step);
      open[i] = status == NC_OK || status == NC_BUDGET;
    }
    for (unsigned i = 0; i < 2; ++i) {
      ASSERT_TRUE(same(texts(steps[i]), expected[i].text));
      EXPECT_EQ(leavings(bench[i]), expected[i].left);
    }
  }
}

TEST(Stream, APartSystemKeepsToItself) {  // two part systems of one control: common variables are shared, nothing else
  Bench bench(NC_DIALECT_M700, [](nc_config& c) {
    c.system_count = 2;
    c.system[1] = c.system[0];
  });
  const std::string one = "#500=1\nG91 G0 X1.\nX1.\nM30", two = "G0 X10.\nX20.\nM30";
  unsigned first = 0, second = 0;
  ASSERT_EQ(nc_program_add_text(bench.control(), "one", one.data(), one.size(), &first), NC_OK);
  ASSERT_EQ(nc_program_add_text(bench.control(), "two", two.data(), two.size(), &second), NC_OK);
  ASSERT_EQ(nc_program_select(bench.control(), 0, first), NC_OK);
  ASSERT_EQ(nc_program_select(bench.control(), 1, second), NC_OK);
  std::string seen;
  nc_item item;
  for (bool more = true; more;) {
    more = false;
    for (unsigned system = 0; system < 2; ++system) {
      if (nc_pull(bench.control(), system, 10, &item) != NC_OK) continue;
      more = true;
      EXPECT_EQ(item.source.system, system);
      if (item.kind == NC_ITEM_MOVE) seen += std::to_string(system) + ":" + brief(item.u.move.machine.v[0]) + " ";
    }
  }
  EXPECT_EQ(seen, "1:10 0:1 1:20 0:2 ");
  double value = 0;
  bool vacant = true;
  EXPECT_EQ(nc_variable_get(bench.control(), 1, 500, &value, &vacant), NC_OK);
  EXPECT_FALSE(vacant);
}

}  // namespace
}  // namespace nc::test
