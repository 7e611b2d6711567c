// SPDX-License-Identifier: Apache-2.0
// Which file in a folder is the sub program that was called.
#include "tools/lib/program_files.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace nc::tools {
namespace {

class FolderTest : public testing::Test {
 protected:
  void SetUp() override {
    char pattern[] = "/tmp/nc-folder-XXXXXX";
    ASSERT_NE(mkdtemp(pattern), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void touch(const std::string& name) { std::ofstream(folder_ + "/" + name) << "M99\n"; }
  std::string found(const std::string& name) {
    ProgramFiles files(folder_);
    const std::string path = files.find(name);
    return path.empty() ? "" : path.substr(folder_.size() + 1);
  }
  std::string folder_;
};

TEST_F(FolderTest, ByNumberWithAnyEndingAndCase) {
  touch("o1000.NC");
  touch("O20");
  touch("O0030.min");
  touch("O40x.nc");
  touch("50.nc");
  EXPECT_EQ(found("O1000"), "o1000.NC");
  EXPECT_EQ(found("O20"), "O20");
  EXPECT_EQ(found("O30"), "O0030.min");
  EXPECT_EQ(found("O40"), "") << "O40x is another name";
  EXPECT_EQ(found("O50"), "") << "a number needs its O";
  EXPECT_EQ(found("O100"), "");
}

TEST_F(FolderTest, TheExactNameWinsThenTheFirstInOrder) {
  touch("O7.nc");
  touch("O7.a");
  EXPECT_EQ(found("O7"), "O7.a");
  touch("O7");
  EXPECT_EQ(found("O7"), "O7");
}

TEST_F(FolderTest, SeesWhatHasComeSince) {
  const ProgramFiles files(folder_);
  EXPECT_EQ(files.find("O9"), "");
  touch("O9.nc");
  EXPECT_EQ(files.find("O9"), folder_ + "/O9.nc");
  std::filesystem::remove(folder_ + "/O9.nc");
  EXPECT_EQ(files.find("O9"), "");
}

TEST_F(FolderTest, ByFileName) {
  touch("Flange.nc");
  touch("O5");
  EXPECT_EQ(found("Flange.nc"), "Flange.nc");
  EXPECT_EQ(found("FLANGE.NC"), "Flange.nc");
  EXPECT_EQ(found("Flange"), "");
}

TEST_F(FolderTest, NeverLeavesTheFolder) {
  touch("O1");
  std::filesystem::create_directory(folder_ + "/sub");
  std::ofstream(folder_ + "/sub/O2") << "M99\n";
  EXPECT_EQ(found("sub/O2"), "");
  EXPECT_EQ(found("../etc/passwd"), "");
  EXPECT_EQ(found(".."), "");
  EXPECT_EQ(found(""), "");
  EXPECT_EQ(ProgramFiles("").find("O1"), "");
  EXPECT_EQ(ProgramFiles("/nonexistent").find("O1"), "");
}

}  // namespace
}  // namespace nc::tools
