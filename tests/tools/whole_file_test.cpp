// SPDX-License-Identifier: Apache-2.0
// A file that is written as a whole or not at all.
#include "tools/lib/whole_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace nc::tools {
namespace {

namespace fs = std::filesystem;

class WholeFiles : public testing::Test {
 protected:
  void SetUp() override {
    char pattern[] = "/tmp/nc-whole-XXXXXX";
    ASSERT_NE(mkdtemp(pattern), nullptr);
    folder_ = pattern;
    path_ = folder_ + "/out.toml";
  }
  void TearDown() override { fs::remove_all(folder_); }
  static std::string content(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }
  std::size_t files() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator())); }
  // Writes the text; whether it was committed.
  bool write(const std::string& path, const std::string& text, bool commit = true) {
    WholeFile file;
    if (!file.open(path, &error_)) return false;
    return std::fwrite(text.data(), 1, text.size(), file.stream()) == text.size() && (!commit || file.commit(&error_));
  }
  std::string folder_, path_, error_;
};

TEST_F(WholeFiles, IsThereWhenItIsWhole) {
  EXPECT_TRUE(write(path_, "one\n")) << error_;
  EXPECT_EQ(content(path_), "one\n");
  struct stat info {};
  ASSERT_EQ(stat(path_.c_str(), &info), 0);
  const mode_t mask = umask(0);
  (void)umask(mask);
  EXPECT_EQ(info.st_mode & 07777, 0666 & ~mask) << "as any new file";
  ASSERT_EQ(chmod(path_.c_str(), 0640), 0);
  EXPECT_TRUE(write(path_, "two\n"));
  EXPECT_EQ(content(path_), "two\n");
  ASSERT_EQ(stat(path_.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 07777, 0640u) << "as the file that it replaces";
  EXPECT_EQ(files(), 1u);
}

TEST_F(WholeFiles, WhatIsGivenUpLeavesWhatWasThere) {
  EXPECT_TRUE(write(path_, "half", false));
  EXPECT_EQ(files(), 0u);
  std::ofstream(path_) << "old";
  EXPECT_TRUE(write(path_, "half", false));
  EXPECT_EQ(content(path_), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(WholeFiles, WhatIsNoPlainFileIsWrittenAsItIs) {
  if (fs::exists("/dev/full")) {
    EXPECT_FALSE(write("/dev/full", "x"));
    EXPECT_NE(error_.find("No space left"), std::string::npos) << error_;
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
  }
  EXPECT_TRUE(write("/dev/null", "x"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_FALSE(write(folder_, "x"));
  EXPECT_FALSE(write(folder_ + "/none/out", "x"));
  EXPECT_NE(error_.find(folder_ + "/none/out"), std::string::npos) << error_;
}

TEST_F(WholeFiles, LinksStayLinks) {
  std::ofstream(folder_ + "/real") << "old";
  fs::create_symlink("real", path_);
  EXPECT_TRUE(write(path_, "new"));
  EXPECT_TRUE(fs::is_symlink(path_));
  EXPECT_EQ(content(folder_ + "/real"), "new");
  fs::create_hard_link(folder_ + "/real", folder_ + "/other");
  EXPECT_TRUE(write(path_, "newer"));
  EXPECT_EQ(content(folder_ + "/other"), "newer") << "both names are the same file still";
  EXPECT_EQ(files(), 3u);
}

}  // namespace
}  // namespace nc::tools
