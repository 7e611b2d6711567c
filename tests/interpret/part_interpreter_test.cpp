// SPDX-License-Identifier: Apache-2.0
// The interface of an interpreter that control uses: its items in the queue, rewinding, an end by a later stage, the rehearsal of a cycle. Here
// there is no control, stage or commit behind it.
#include "interpret/part_interpreter.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "dialect/dialect.hpp"
#include "macro/variables.hpp"

namespace nc::test {
namespace {

class Interpreted {
 public:
  explicit Interpreted(const std::string& text) : text_(text) {
    nc_config_init(&config_);
    Arena measuring;
    lay_out(measuring);
    const size_t size = measuring.used() + 64;
    memory_ = std::make_unique<char[]>(size);
    void* begin = memory_.get();
    size_t left = size;
    Arena arena(std::align(64, measuring.used(), begin, left), left);
    lay_out(arena);
    TextEntry entry;
    entry.memory = text_.data();
    entry.size = text_.size();
    unsigned file = 0;
    if (arena.overflowed() || store.add(entry, "1", &file) != NC_OK) ADD_FAILURE() << "no room";
    ProgramRef program;
    program.file = static_cast<uint16_t>(file);
    in.select(program, false);
    in.reset(false);
  }
  /// Takes the items up to the end of the next block; returns their kinds, one letter each.
  std::string block() {
    std::string kinds;
    Item* front = nullptr;
    uint32_t budget = 1000;
    while ((status = in.next(budget, &front)) == NC_OK) {
      kinds += "magsMAE"[static_cast<unsigned>(front->kind)];
      if (front->kind == ItemKind::move) moves.push_back(front->move.end);
      const bool last = front->kind == ItemKind::mark;
      in.queue().pop();
      if (last) break;
    }
    return kinds;
  }

  nc_status status = NC_OK;
  std::vector<AxisVec> moves;
  ProgramStore store;
  PartInterpreter in;

 private:
  void lay_out(Arena& arena) {
    const Dialect& family = dialect(static_cast<nc_dialect>(config_.dialect));
    store.create(config_.programs, 1, {family.lex->program_letter, family.rules.range.largest_program}, arena);
    CommonRanges ranges;
    ranges.first[0] = 100, ranges.last[0] = 199;
    common_.create(ranges, arena);
    vendor_.create(nullptr, 0, family, nullptr, arena);
    InterpreterConfig in_config;
    in_config.dialect = &family;
    in_config.system = &config_.system[0];
    in_config.vendor = &vendor_;
    in.create(in_config, &store, &common_, arena);
  }

  std::string text_;
  nc_config config_;
  std::unique_ptr<char[]> memory_;
  CommonVariables common_;
  VendorCodes vendor_;
};

TEST(PartInterpreter, MakesABlockWhenItsQueueIsEmpty) {
  Interpreted run("G90 G0 X1.\nX2. M3\nM30\n");
  EXPECT_EQ(run.block(), "mM");
  EXPECT_TRUE(run.in.queue().empty());
  uint32_t none = 0;
  Item* front = nullptr;
  EXPECT_EQ(run.in.next(none, &front), NC_BUDGET);
  EXPECT_EQ(front, nullptr);
  uint32_t one = 1;
  EXPECT_EQ(run.in.next(one, &front), NC_OK);
  EXPECT_EQ(one, 0u);
  EXPECT_EQ(front, run.in.queue().front());
  EXPECT_EQ(run.in.next(none, &front), NC_OK) << "what stands in the queue costs no budget";
  EXPECT_EQ(run.block().back(), 'M');
  run.block();
  run.block();
  EXPECT_EQ(run.status, NC_ENDED);
  EXPECT_TRUE(run.in.ended());
  EXPECT_FALSE(run.in.alarmed());
}

TEST(PartInterpreter, GoesBackBehindABlock) {
  Interpreted run("G90 G0 X1.\n#100=7\nX2.\nM30\n");
  run.block();
  const BlockSeq behind = run.in.newest_block();
  const HostTables tables = run.in.tables();
  run.block();
  run.block();
  Value value;
  ASSERT_TRUE(tables.variable(100, &value));
  EXPECT_EQ(value.number, 7);
  EXPECT_EQ(run.in.machine()[0], 2);
  ASSERT_TRUE(run.in.remembers(behind));
  ASSERT_TRUE(run.in.rewind(behind));
  ASSERT_TRUE(tables.variable(100, &value));
  EXPECT_TRUE(value.vacant);
  EXPECT_EQ(run.in.machine()[0], 1);
  EXPECT_EQ(run.in.newest_block(), behind);
  run.block();
  EXPECT_EQ(run.block(), "mM");
  ASSERT_EQ(run.moves.size(), 3u);
  EXPECT_EQ(run.moves[2][0], run.moves[1][0]);
}

TEST(PartInterpreter, AFaultBehindItTakesThePlaceOfWhatIsQueued) {
  Interpreted run("G90 G0 X1.\nX2.\nM30\n");
  uint32_t budget = 10;
  Item* front = nullptr;
  ASSERT_EQ(run.in.next(budget, &front), NC_OK);
  Fault fault;
  fault.condition = Condition::soft_limit;
  const nc_source where = front->source;
  run.in.abort(fault, where);
  ASSERT_NE(run.in.queue().front(), nullptr);
  EXPECT_EQ(run.in.queue().front()->kind, ItemKind::alarm);
  EXPECT_TRUE(run.in.alarmed());
  EXPECT_EQ(run.in.raised().fault.condition, Condition::soft_limit);
  EXPECT_EQ(run.in.raised().source.line, where.line);
  run.block();
  EXPECT_EQ(run.status, NC_ALARMED);
}

TEST(PartInterpreter, ARehearsalOfACycleLeavesNothingBehind) {
  Interpreted run("G90 G0 Z50.\nG91 G81 X10. Y10. Z-5. R-45. F100 L3\nM30\n"), plain("G90 G0 Z50.\nG91 G81 X10. Y10. Z-5. R-45. F100 L3\nM30\n");
  run.block();
  uint32_t budget = 10;
  Item* front = nullptr;
  ASSERT_EQ(run.in.next(budget, &front), NC_OK);
  ASSERT_TRUE(run.in.in_cycle());
  const uint64_t before = run.in.state_hash();
  const unsigned queued = run.in.queue().size();
  unsigned shown = 0;
  EXPECT_TRUE(run.in.rehearse_cycle([](void* count, const Item& move) { return move.kind == ItemKind::move && ++*static_cast<unsigned*>(count) != 0; }, &shown));
  EXPECT_GT(shown, 2u);
  EXPECT_EQ(run.in.queue().size(), queued);
  EXPECT_EQ(run.in.state_hash(), before);
  EXPECT_FALSE(run.in.rehearse_cycle([](void*, const Item&) { return false; }, nullptr));
  plain.block();
  EXPECT_EQ(run.block(), plain.block());
  ASSERT_EQ(run.moves.size(), plain.moves.size());
  for (size_t i = 0; i < run.moves.size(); ++i) EXPECT_EQ(run.moves[i], plain.moves[i]);
}

// The program sees what the host sets, and a rewind does not take that back.
TEST(PartInterpreter, TheHostsTables) {
  Interpreted run("G90 G0 X#100\nX#101\nM30\n");
  const HostTables tables = run.in.tables();
  run.in.rewind(0);
  ASSERT_TRUE(tables.set_variable(100, {3, false}));
  ASSERT_TRUE(tables.set_variable(101, {4, false}));
  EXPECT_FALSE(tables.set_variable(99999999, {4, false}));
  run.block();
  const BlockSeq behind = run.in.newest_block();
  ASSERT_TRUE(tables.set_variable(101, {5, false}));
  ASSERT_TRUE(run.in.rewind(behind));
  run.block();
  ASSERT_EQ(run.moves.size(), 2u);
  EXPECT_EQ(run.moves[0][0], 3);
  EXPECT_EQ(run.moves[1][0], 5);
  EXPECT_EQ(tables.axis_named('X'), 0);
  EXPECT_EQ(tables.axis_named('?'), -1);
  tables.set_interface_output(0, 0xff, 0x5a);
  EXPECT_EQ(tables.interface_output(0), 0x5au);
  tables.set_tool(1, NC_TOOL_LENGTH, 12.5);
  EXPECT_EQ(tables.frames().get(tables.frames().tool_key(1, NC_TOOL_LENGTH)), 12.5);
}

}  // namespace
}  // namespace nc::test
