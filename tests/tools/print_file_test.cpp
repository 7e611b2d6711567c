// SPDX-License-Identifier: Apache-2.0
#include "tools/lib/print_file.hpp"

#include <gtest/gtest.h>

#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

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

// A disk that is full: the process may not make a file larger than this. A line that has no room is lost as a whole, and the next one that has some stands by itself.
TEST(PrintFile, AFullDiskLeavesWholeLines) {
  char pattern[] = "/tmp/nc-print-XXXXXX";
  ASSERT_NE(mkdtemp(pattern), nullptr);
  const std::string path = std::string(pattern) + "/out.txt";
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    (void)signal(SIGXFSZ, SIG_IGN);
    rlimit limit{25, RLIM_INFINITY};
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(1);
    PrintFile file;
    std::string error;
    if (!file.open(path, &error)) _exit(2);
    if (!file.write(text("line one")) || !file.write(text("line two"))) _exit(3);
    if (file.write(text("line three")) || file.write(text("line four"))) _exit(4);
    limit.rlim_cur = RLIM_INFINITY;
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(5);
    _exit(file.write(text("line five")) ? 0 : 6);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  std::ostringstream content;
  content << std::ifstream(path).rdbuf();
  EXPECT_EQ(content.str(), "line one\nline two\nline five\n");
  std::filesystem::remove_all(pattern);
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
