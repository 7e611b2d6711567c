// SPDX-License-Identifier: Apache-2.0
// Names and pockets of tools: what may be a name, and the file in which they are kept.
#include <gtest/gtest.h>

#include <random>

#include "runtime/retain/tool_label_data.hpp"
#include "test_config.hpp"

namespace {

using namespace nc::rt;

constexpr unsigned kTools = 200;

TEST(ToolNames, AreOneLineOfText) {
  for (const char* name : {"", "drill 8", "Schaftfr\xc3\xa4ser \xc3\x98" "10", "\xe5\x88\x80\xe5\x85\xb7", "\xc2\xa0", "a=b;\"\\'"}) EXPECT_EQ(tool_name_trouble(name), "") << name;
  EXPECT_EQ(tool_name_trouble(std::string(kLongestToolName, 'x')), "");
  EXPECT_EQ(tool_name_trouble(std::string(kLongestToolName + 1, 'x')), "must have at most 64 bytes");
  for (const std::string& name : {std::string("a\nb"), std::string("\r"), std::string("a\0b", 3), std::string("\x1b[31m"), std::string("\x7f"), std::string("\xc2\x80"), std::string("\xc2\x9f"), std::string("\xe2\x80\xa8"), std::string("\xe2\x80\xa9")})
    EXPECT_EQ(tool_name_trouble(name), "must not have control characters");
  for (const char* name : {"M\xfcller", "\xc3", "\xc0\xaf", "\xed\xa0\x80", "\x83\x41"}) EXPECT_EQ(tool_name_trouble(name), "must be a text in UTF-8");  // Latin-1, cut off, overlong, half of a pair, Shift-JIS
}

TEST(ToolLabels, ThoseOfTheConfiguration) {
  const Config config = nc::test::parse_or_fail(nc::test::base_toml() + "[tool_offsets]\n1 = { length = 3, name = \"drill\", pocket = 7 }\n2 = 4.5\n9 = { pocket = 0 }\n");
  EXPECT_EQ(configured_labels(config), (ToolLabels{{1, {"drill", 7}}, {9, {"", 0}}}));
}

TEST(RetainedToolLabels, ComeBack) {
  const ToolLabels configured = {{1, {"face mill", 1}}, {2, {"", 2}}, {3, {"drill", 0}}};
  const ToolLabels now = {{1, {"end", 0}}, {2, {"", 1}}, {3, {"", 3}}, {200, {"a=b \xe2\x82\xac", 9999}}};
  const std::string bytes = encode_tool_labels(now, configured);
  ToolLabels read = configured;
  std::vector<std::string> remarks;
  ASSERT_TRUE(restore_tool_labels(bytes, kTools, &read, &remarks));
  EXPECT_EQ(read, now);
  EXPECT_TRUE(remarks.empty());
  EXPECT_EQ(encode_tool_labels(configured, configured), "nc tools 1\nend\n") << "nothing that the configuration has";
  read = configured;
  ASSERT_TRUE(restore_tool_labels(bytes, 100, &read, &remarks));
  EXPECT_EQ(read.count(200), 0u) << "there are not so many tools any more";
}

TEST(RetainedToolLabels, WhatIsChangedInTheConfigurationCountsFromThere) {
  const std::string bytes = encode_tool_labels({{1, {"new", 20}}, {5, {"", 30}}}, {{1, {"old", 1}}});
  ToolLabels read = {{1, {"old", 8}}, {6, {"saw", 30}}};
  std::vector<std::string> remarks;
  ASSERT_TRUE(restore_tool_labels(bytes, kTools, &read, &remarks));
  EXPECT_EQ(label_of(read, 1), (ToolLabel{"new", 8}));
  EXPECT_EQ(label_of(read, 5).pocket, 0u);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0], "tool 5 was in pocket 30, which the configuration gives to tool 6 (saw): it is in none");
}

TEST(RetainedToolLabels, BytesThatMakeNoSenseChangeNothing) {
  const ToolLabels configured = {{1, {"drill", 1}}};
  const std::string good = encode_tool_labels({{1, {"tap", 2}}, {7, {"", 3}}}, configured);
  ToolLabels read = configured;
  std::vector<std::string> remarks;
  for (std::size_t cut = 0; cut < good.size(); ++cut) EXPECT_FALSE(restore_tool_labels(good.substr(0, cut), kTools, &read, &remarks)) << cut;
  for (const char* rows : {"tool 0 name\n\nx\n", "tool 3\n\nx\n", "tool 3 size\n0\n1\n", "tool 03 name\n\nx\n", "tool 3 pocket\n0\n-1\n", "tool 3 pocket\n0\n10000\n", "tool 3 pocket\n0\n1.0\n", "tool 3 pocket\n0\n\n", "tool 3 name\n\na\tb\n",
                           "tool 3 name\n\n\xff\n", "tool 3 pocket\n0\n5\ntool 4 pocket\n0\n5\n", "tool 3 name\n\na\ntool 3 name\n\nb\n"})
    EXPECT_FALSE(restore_tool_labels(std::string("nc tools 1\n") + rows + "end\n", kTools, &read, &remarks)) << rows;
  EXPECT_FALSE(restore_tool_labels("nc tools 2\nend\n", kTools, &read, &remarks));
  EXPECT_EQ(read, configured);
  std::mt19937 chance(1);
  for (unsigned i = 0; i < 5000; ++i) {
    std::string noise = good;
    for (unsigned k = 0; k < 3; ++k) noise[chance() % noise.size()] = static_cast<char>(chance());
    ToolLabels other = configured;
    const bool taken = restore_tool_labels(noise, kTools, &other, &remarks);
    EXPECT_TRUE(taken || other == configured);
    for (const auto& [tool, label] : other) EXPECT_TRUE(tool_name_trouble(label.name).empty() && other_in_pocket(other, tool) == 0);
  }
}

TEST(RetainedToolLabels, SayWhenAnotherVersionHasWrittenThem) {
  ToolLabelTable table;
  ToolLabelData data(&table, kTools, {});
  EXPECT_EQ(data.why_refused("nc tools 2\nsomething\n"), " is of another version of the control");
  for (const char* bytes : {"", "nc tools", "nc tools 1\n", "nc tools x\n", "nc tables 2\n", "nc tools 2x\n"}) EXPECT_EQ(data.why_refused(bytes), " makes no sense") << bytes;
}

}  // namespace
