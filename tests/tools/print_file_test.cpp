// SPDX-License-Identifier: Apache-2.0
#include "tools/lib/print_file.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace nc::tools {
namespace {

nc_text text(const char* line) {
  nc_text t{};
  std::snprintf(t.s, sizeof t.s, "%s", line);
  return t;
}

// Each line has its own result: a failure is reported for every line that cannot be written.
TEST(PrintFile, SaysOfEachLineWhetherItIsThere) {
  PrintFile file;
  std::string error;
  ASSERT_TRUE(file.open("/dev/full", &error)) << error;
  EXPECT_FALSE(file.write(text("A")));
  EXPECT_FALSE(file.write(text("B")));
  EXPECT_FALSE(file.good());
  EXPECT_EQ(file.error(), "No space left on device");
  PrintFile good;
  ASSERT_TRUE(good.open("/dev/null", &error)) << error;
  EXPECT_TRUE(good.write(text("A")));
}

TEST(PrintLines, GivesEachLineOnce) {
  PrintLines lines;
  lines.write(text("\x12%"));  // POPEN switches the punch on
  lines.write(text("X 12.5\r"));
  EXPECT_EQ(lines.take(), (std::vector<std::string>{"X 12.5"}));
  EXPECT_TRUE(lines.take().empty());
}

TEST(PrintLines, SaysHowManyItDoesNotShow) {
  PrintLines lines;
  for (int i = 0; i < 1003; ++i) lines.write(text("A"));
  const std::vector<std::string> shown = lines.take();
  ASSERT_EQ(shown.size(), 1001u);
  EXPECT_EQ(shown.back(), "3 more lines, not shown");
  lines.write(text("B"));
  EXPECT_EQ(lines.take(), std::vector<std::string>{"B"});
}

}  // namespace
}  // namespace nc::tools
