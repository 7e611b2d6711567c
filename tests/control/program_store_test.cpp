// SPDX-License-Identifier: Apache-2.0
// The program store through the public API: which programs may be removed and when, and which are always there.
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "support/pull.hpp"

namespace nc::test {
namespace {

nc_program_info info_of(Bench& bench, unsigned file) {
  nc_program_info info{};
  EXPECT_EQ(nc_program_get(bench.control(), file, &info), NC_OK);
  return info;
}

/// Pulls until a block at this depth has ended; false at the end of the program.
bool pull_to(Bench& bench, unsigned depth) {
  nc_item item{};
  while (nc_pull(bench.control(), 0, 1000, &item) == NC_OK)
    if (item.kind == NC_ITEM_MARK && item.source.depth == depth) return true;
  return false;
}

TEST(ProgramsOfAControl, WhatNothingRefersToCanBeRemoved) {
  Bench bench;
  const unsigned a = bench.add("a.nc", "M98 P1\nG0 X1.\nM30\n"), sub = bench.add("O1", "G0 Y1.\nM99\n"), other = bench.add("b.nc", "M30\n");
  EXPECT_FALSE(info_of(bench, a).in_use);
  EXPECT_STREQ(info_of(bench, sub).name, "O1");
  EXPECT_EQ(info_of(bench, sub).number, 1u);
  EXPECT_EQ(info_of(bench, sub).size, 11u);
  ASSERT_EQ(nc_program_select(bench.control(), 0, a), NC_OK);
  EXPECT_EQ(nc_program_remove(bench.control(), a), NC_E_STATE) << "it is selected";
  ASSERT_TRUE(pull_to(bench, 1));
  EXPECT_TRUE(info_of(bench, sub).in_use);
  EXPECT_EQ(nc_program_remove(bench.control(), sub), NC_E_STATE) << "it is being executed";
  EXPECT_EQ(nc_program_remove(bench.control(), a), NC_E_STATE) << "it has called";
  EXPECT_EQ(nc_program_remove(bench.control(), other), NC_OK);
  nc_program_info info;
  EXPECT_EQ(nc_program_get(bench.control(), other, &info), NC_E_NOT_FOUND);
  EXPECT_EQ(nc_program_select(bench.control(), 0, other), NC_E_NOT_FOUND);
  EXPECT_EQ(bench.add("c.nc", "M30\n"), other) << "the place comes back";
  ASSERT_EQ(nc_program_select(bench.control(), 0, other), NC_OK);
  EXPECT_EQ(nc_program_remove(bench.control(), sub), NC_OK);
  EXPECT_EQ(nc_program_remove(bench.control(), a), NC_OK);
  EXPECT_EQ(nc_program_remove(bench.control(), a), NC_E_NOT_FOUND);
  EXPECT_EQ(nc_program_remove(bench.control(), 99999), NC_E_NOT_FOUND);
  EXPECT_EQ(nc_program_remove(nullptr, a), NC_E_ARGUMENT);
}

/// Blocks that were read ahead may be taken back, which brings the sub program back into the call stack.
TEST(ProgramsOfAControl, ACallThatMayComeBackKeepsItsProgram) {
  Bench bench(NC_DIALECT_M700, [](nc_config& c) { c.look_ahead = 64; });
  std::string text = "M98 P1\n";
  for (int i = 0; i < 2000; ++i) text += "G0 X" + std::to_string(i % 7) + ".\n";
  const unsigned main = bench.add("a.nc", text + "M30\n"), sub = bench.add("O1", "G0 Y1.\nG0 Y2.\nM99\n");
  ASSERT_EQ(nc_program_select(bench.control(), 0, main), NC_OK);
  nc_item item{};
  uint64_t inside = 0;
  while (item.kind != NC_ITEM_MARK || item.source.line < 4 || item.source.depth != 0) {
    ASSERT_EQ(nc_pull(bench.control(), 0, 1000, &item), NC_OK);
    if (item.kind == NC_ITEM_MARK && item.source.depth == 1) inside = item.serial;
  }
  EXPECT_EQ(nc_program_remove(bench.control(), sub), NC_E_STATE);
  ASSERT_EQ(nc_rewind(bench.control(), 0, inside), NC_OK);
  unsigned blocks = 0;
  while (nc_program_remove(bench.control(), sub) == NC_E_STATE) {
    ASSERT_TRUE(pull_to(bench, 0));
    ++blocks;
  }
  EXPECT_GE(blocks, 64u);
  EXPECT_LT(blocks, 1500u);
  EXPECT_NE(nc_rewind(bench.control(), 0, inside), NC_OK);
}

TEST(ProgramsOfAControl, ProgramsOfModalCallsAndInterruptsStay) {
  for (const char* call : {"G66 P1", "G66.1 P1", "M96 P1"}) {
    Bench bench;
    bench.param("1109", "0");
    std::string text = std::string(call) + "\n";
    for (int i = 0; i < 600; ++i) text += "#100=" + std::to_string(i) + "\n";
    const unsigned main = bench.add("a.nc", text + "M30\n"), sub = bench.add("O1", "#101=1\nM99\n");
    ASSERT_EQ(nc_program_select(bench.control(), 0, main), NC_OK);
    nc_item item{};
    while (item.kind != NC_ITEM_MARK || item.source.line < 500) ASSERT_EQ(nc_pull(bench.control(), 0, 1000, &item), NC_OK) << call;
    EXPECT_EQ(nc_program_remove(bench.control(), sub), NC_E_STATE) << call;
    ASSERT_EQ(nc_reset(bench.control(), 0), NC_OK);
    EXPECT_EQ(nc_program_remove(bench.control(), sub), NC_OK) << call;
  }
}

TEST(ProgramsOfAControl, ProtectedProgramsStay) {
  Bench bench;
  const unsigned file = bench.add("O9001", "M99\n");
  bench.param("1121", "1");
  EXPECT_TRUE(info_of(bench, file).is_protected);
  EXPECT_EQ(nc_program_remove(bench.control(), file), NC_E_STATE);
  bench.param("1121", "0");
  EXPECT_EQ(nc_program_remove(bench.control(), file), NC_OK);
}

TEST(ProgramsOfAControl, TheOrderOfUse) {
  Bench bench;
  const unsigned a = bench.add("a.nc", "M98 P1\nM30\n"), one = bench.add("O1", "M99\n"), two = bench.add("O2", "M99\n");
  EXPECT_LT(info_of(bench, a).used, info_of(bench, one).used);
  EXPECT_LT(info_of(bench, one).used, info_of(bench, two).used);
  ASSERT_EQ(nc_program_select(bench.control(), 0, a), NC_OK);
  EXPECT_LT(info_of(bench, two).used, info_of(bench, a).used);
  while (pull_to(bench, 0)) {
  }
  EXPECT_LT(info_of(bench, a).used, info_of(bench, one).used);
}

TEST(ProgramsOfAControl, MdiFindsRoomInAFullStore) {
  Bench bench(NC_DIALECT_M700, [](nc_config& c) { c.programs = 2; });
  bench.add("a", "M30\n");
  bench.add("b", "M30\n");
  ASSERT_EQ(nc_program_add_text(bench.control(), "c", "M30", 3, nullptr), NC_E_MEMORY);
  ASSERT_EQ(nc_mdi_load(bench.control(), 0, "G0 X1.", 6), NC_OK);
  nc_item item{};
  ASSERT_EQ(nc_pull(bench.control(), 0, 10, &item), NC_OK);
  EXPECT_EQ(nc_program_remove(bench.control(), item.source.file), NC_E_STATE);
  EXPECT_EQ(nc_program_add_text(bench.control(), "c", "M30", 3, nullptr), NC_E_MEMORY);
  EXPECT_EQ(nc_program_remove(bench.control(), 0), NC_OK);
  EXPECT_EQ(nc_program_add_text(bench.control(), "c", "M30", 3, nullptr), NC_OK);
  EXPECT_EQ(nc_program_add_text(bench.control(), "d", "M30", 3, nullptr), NC_E_MEMORY);
}

// M700 13.3.1: leading zeros of P are dropped, so the file "0100" can only be called as <0100>. The store knows what a name means, whoever enters the text.
TEST(ProgramsOfAControl, ANumberWithLeadingZerosIsAName) {
  Bench bench;
  EXPECT_EQ(info_of(bench, bench.add("0100", "G0 Y1.\nM99\n")).number, 100u) << "what #4115 reads";
  EXPECT_EQ(info_of(bench, bench.add("O0200.nc", "G0 Y2.\nM99\n")).number, 200u);
  EXPECT_EQ(info_of(bench, bench.add("300.nc", "M99\n")).number, 300u);
  EXPECT_EQ(info_of(bench, bench.add("123456789", "M99\n")).number, 0u);
  EXPECT_EQ(bench.run("M98 P100\nM30").alarm, "P232");
  EXPECT_EQ(bench.run("M98 <0100>\nM98 P200\nM30").path(), (Path{"rapid 0 1 0", "rapid 0 2 0"}));
}

TEST(ProgramsOfAControl, NamesOf255Bytes) {
  Bench bench;
  const std::string name(255, 'n');
  const unsigned file = bench.add(name, "G0 X3.\nM30\n");
  EXPECT_EQ(info_of(bench, file).name, name);
  EXPECT_EQ(nc_program_add_text(bench.control(), std::string(NC_MAX_NAME, 'n').c_str(), "M30", 3, nullptr), NC_E_ARGUMENT);
}

/// A text that has changed raises an alarm in the block that needs it, whatever the block looks for.
TEST(ProgramsOfAControl, ATextThatHasChangedIsAnAlarm) {
  struct Host {
    std::string text;
    uint64_t from = UINT64_MAX;
  };
  const std::string blanks(5000, ' ');
  for (const std::string& first : {std::string("G0 X5."), std::string("GOTO9"), std::string("M98 P7"), std::string("WHILE[#100EQ1]DO1"),
                                   std::string("M98 H9")}) {
    Bench bench(NC_DIALECT_M700, [](nc_config& c) { c.window_bytes = 1024; });
    Host host{"#100=0\n" + first + "\n" + blanks + "\nEND1\nN9 G0 X9.\nM30\nO7 (7)\nG0 Y1.\nM99\n"};
    unsigned file = 0;
    const auto read = [](void* user, uint64_t offset, char* buffer, size_t size) -> long {
      const Host& h = *static_cast<Host*>(user);
      if (offset + size > h.from) return NC_READ_CHANGED;
      std::memcpy(buffer, h.text.data() + offset, size);
      return static_cast<long>(size);
    };
    ASSERT_EQ(nc_program_add(bench.control(), "p", read, &host, host.text.size(), &file), NC_OK);
    ASSERT_EQ(nc_program_select(bench.control(), 0, file), NC_OK);
    host.from = 1024;
    nc_item item{};
    nc_status status = NC_OK;
    unsigned moves = 0;
    while ((status = nc_pull(bench.control(), 0, 1000, &item)) == NC_OK) moves += item.kind == NC_ITEM_MOVE;
    EXPECT_EQ(status, NC_ALARMED) << first;
    EXPECT_EQ(moves, first[0] == 'G' && first[1] == '0' ? 1u : 0u) << first;
    nc_alarm alarm{};
    ASSERT_EQ(nc_alarm_get(bench.control(), 0, &alarm), NC_OK);
    EXPECT_STREQ(alarm.code, "P461") << first;
    EXPECT_STREQ(alarm.detail.s, "The file of the program has changed since it was selected: reset, and select it again.") << first;
  }
}

}  // namespace
}  // namespace nc::test
