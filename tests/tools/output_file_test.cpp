// SPDX-License-Identifier: Apache-2.0
// Output is buffered and complete, and a failure is reported.
#include "tools/lib/output_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstring>

#include "fake_items.hpp"

namespace nc::tools {
namespace {

TEST(OutputFile, EverythingArrivesInOrder) {
  ScratchFile scratch;
  OutputFile out(scratch.descriptor());
  std::string expected;
  for (int i = 0; i < 100'000; ++i) {
    const std::string line = std::to_string(i) + "\n";
    std::memcpy(out.reserve(64), line.data(), line.size());
    out.advance(line.size());
    expected += line;
  }
  ASSERT_TRUE(out.flush());
  EXPECT_EQ(scratch.content(), expected);
}

TEST(OutputFile, FullDiskIsReported) {
  const int full = open("/dev/full", O_WRONLY);
  if (full < 0) GTEST_SKIP() << "no /dev/full here";
  OutputFile out(full);
  *out.reserve(1) = 'x';
  out.advance(1);
  EXPECT_FALSE(out.failed()) << "nothing was written yet";
  EXPECT_FALSE(out.flush());
  EXPECT_EQ(out.error_text(), "No space left on device");
  close(full);
}

TEST(OutputFile, ReaderThatWentAwayIsReported) {
  std::signal(SIGPIPE, SIG_IGN);
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  OutputFile out(ends[1]);
  *out.reserve(1) = 'x';
  out.advance(1);
  EXPECT_FALSE(out.flush());
  EXPECT_EQ(out.error_text(), "Broken pipe");
  close(ends[1]);
}

}  // namespace
}  // namespace nc::tools
