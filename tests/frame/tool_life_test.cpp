// SPDX-License-Identifier: Apache-2.0
// The table of tool life: its members as columns of numbers, and which tool of a group is to be used (M700 13.5.5, 10.15).
#include "frame/tool_life.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <memory>

namespace nc::test {
namespace {

TEST(ToolLives, EachColumnIsAMemberOfItsOwn) {
  for (unsigned column = 0; column < kLifeColumns; ++column) {
    ToolLife tool;
    visit_column(static_cast<LifeColumn>(column), [&tool](auto member) { from_life_number(2, tool.*member); });
    for (unsigned other = 0; other < kLifeColumns; ++other) EXPECT_EQ(life_number(tool, static_cast<LifeColumn>(other)), other == column ? 2 : 0) << column;
    uint64_t words[kLifeColumns];
    std::memcpy(words, &tool, sizeof words);
    for (unsigned other = 0; other < kLifeColumns; ++other) EXPECT_EQ(words[other] != 0, other == column) << "two part systems may write two columns";
  }
}

TEST(ToolLives, TheFlagsAreGivenBackAsTheyAre) {
  for (unsigned bits = 0; bits < 256; ++bits) {
    ToolLife tool;
    from_life_number(bits, tool.flags);
    EXPECT_EQ(life_number(tool, LifeColumn::flags), bits);
    EXPECT_EQ(tool.flags.method, static_cast<LifeMethod>(bits / 16 % 4));
  }
}

std::unique_ptr<ToolLives> two_groups() {
  auto lives = std::make_unique<ToolLives>();
  for (const auto& [slot, group, number] : {std::array{0U, 10U, 101U}, {2U, 20U, 201U}, {3U, 10U, 102U}, {5U, 10U, 103U}}) {
    lives->tool[slot].group = group;
    lives->tool[slot].tool = number;
  }
  return lives;
}

TEST(ToolLives, TheToolsOfAGroup) {
  const auto lives = two_groups();
  EXPECT_EQ(lives->first_group(), 10U);
  EXPECT_EQ(ToolLives{}.first_group(), 0U);
  EXPECT_EQ(lives->registered(10), 3U);
  EXPECT_EQ(lives->registered(30), 0U);
  EXPECT_EQ(lives->registered(0), 0U) << "free slots are no group";
  EXPECT_EQ(lives->nth(10, 2), 3U);
  EXPECT_EQ(lives->nth(10, 4), ToolLives::kNone);
  EXPECT_EQ(lives->nth(10, 0), ToolLives::kNone);
  EXPECT_EQ(lives->number_in_group(5), 3U);
  EXPECT_EQ(lives->free_slot(), 1U);
  EXPECT_EQ(lives->with_tool(201), 2U);
  EXPECT_EQ(lives->with_tool(0), ToolLives::kNone);
}

TEST(ToolLives, TheNextToolOfAGroup) {  // #60003
  const auto lives = two_groups();
  EXPECT_EQ(lives->next_of(10), 0U);
  lives->tool[3].status = LifeStatus::in_use;
  EXPECT_EQ(lives->next_of(10), 3U) << "the one in use comes before one that is new";
  EXPECT_EQ(lives->current_of(10, 5), 5U) << "the spindle has one of the group";
  EXPECT_EQ(lives->current_of(10, 2), 3U);
  EXPECT_EQ(lives->current_of(10, ToolLives::kNone), 3U);
  lives->tool[0].status = LifeStatus::error_1;
  EXPECT_EQ(lives->first_alive(10), 3U);
  lives->tool[3].status = LifeStatus::ended;
  EXPECT_EQ(lives->next_of(10), 5U);
  EXPECT_FALSE(lives->all_ended(10));
  lives->tool[5].status = LifeStatus::error_2;
  EXPECT_EQ(lives->next_of(10), 5U) << "all being worn, the last";
  EXPECT_TRUE(lives->all_ended(10));
  EXPECT_FALSE(lives->all_ended(30)) << "there is no such group";
  EXPECT_EQ(lives->next_of(30), ToolLives::kNone);
}

}  // namespace
}  // namespace nc::test
