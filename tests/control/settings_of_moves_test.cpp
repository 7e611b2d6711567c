// SPDX-License-Identifier: Apache-2.0
// A move is executed with the parameters as they were when it was made, however long a stage holds it back. A parameter that the program writes
// after it (G10 L70), or the operator meanwhile, acts on later moves.
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

constexpr uint8_t kX = 1u << 0, kB = 1u << 3;

/// The index tables that the first move of line 3 drives. Compensation, a corner or fairing holds it back while #2076 is written.
int tables_of_held_move(const std::string& text, const std::function<void(Bench&)>& set, const std::function<void(Bench&)>& meanwhile = {}) {
  Bench bench(NC_DIALECT_M700, axes("XYZb"));
  bench.tool(1, 2).param("8033", "1").param("8029", "0.1");
  set(bench);
  bench.start(text);
  int tables = -1;
  Step step;
  nc_status status = NC_OK;
  while (status == NC_OK || status == NC_BUDGET) {
    status = bench.pull(&step, 1);
    if (status == NC_BUDGET && meanwhile) meanwhile(bench);
    if (status == NC_OK && step.item.kind == NC_ITEM_MOVE && step.item.source.line == 3 && tables < 0) tables = step.item.u.move.index_axes;
  }
  EXPECT_EQ(status, NC_ENDED) << text;
  return tables;
}

std::function<void(Bench&)> table(const char* value, char axis) {
  return [value, axis](Bench& bench) { bench.param("2076", value, axis); };
}

TEST(SettingsOfMoves, AProgramWritesBehindAHeldMove) {
  const auto lines = [](const char* value) { return "G5 P10000\nG1 F1000\nX10.\nG10 L70\nP2076 A1 D" + std::string(value) + "\nG11\nX20.\nX30.\nG5 P0\nM30"; };
  EXPECT_EQ(tables_of_held_move(lines("1"), table("0", 'X')), 0);
  EXPECT_EQ(tables_of_held_move(lines("0"), table("1", 'X')), kX);
  // Written before the move it acts on the move.
  EXPECT_EQ(tables_of_held_move("G5 P10000\nG1 F1000\nX10.\nX20.\nG5 P0\nM30", table("1", 'X')), kX);
}

TEST(SettingsOfMoves, TheOperatorWritesWhileAMoveIsHeld) {
  const std::string end = "X30.\nY40.\nG40 X50.\nM30";
  struct Held {
    const char* text;
    unsigned read;  ///< so many blocks give out no item when they are read; the last of them is line 3
  };
  for (const auto& [held, read] : {Held{"G1 F100\nG41 D1 X10.\nY10. B90.\n", 3}, Held{"G1 F100\nX10.\nY10. B90. ,C1.\n", 1}}) {
    for (const char* before : {"0", "1"}) {
      const bool was = *before == '1';
      unsigned reads = 0;
      const int tables = tables_of_held_move(held + end, table(before, 'B'), [&, read = read](Bench& bench) {
        if (++reads == read) table(was ? "0" : "1", 'B')(bench);
      });
      EXPECT_EQ(tables, was ? kB : 0) << held << "before " << before;
      EXPECT_GE(reads, read);
    }
  }
}

}  // namespace
}  // namespace nc::test
