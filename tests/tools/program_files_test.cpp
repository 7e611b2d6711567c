// SPDX-License-Identifier: Apache-2.0
// Which file in a folder is the sub program that was called.
#include "tools/lib/program_files.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "own_folder.hpp"
#include "support/pull.hpp"

namespace nc::tools {
namespace {

class FolderTest : public OwnFolder {
 protected:
  void touch(const std::string& name) { std::ofstream(folder_ + "/" + name) << "M99\n"; }
  std::string found(const std::string& name) {
    ProgramFiles files(folder_);
    const std::string path = files.find(name);
    return path.empty() ? "" : path.substr(folder_.size() + 1);
  }
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

// ---- programs of a control ----

class ProgramsTest : public FolderTest {
 protected:
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ + "/" + name, std::ios::binary) << text; }
  static unsigned descriptors() {
    unsigned count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) ++count;
    return count;
  }
  unsigned selected(ProgramFiles* files, test::Bench& bench, const std::string& name) {
    unsigned file = 0;
    std::string error;
    EXPECT_EQ(files->add(bench.control(), folder_ + "/" + name, &file, &error), NC_OK) << error;
    EXPECT_EQ(nc_program_select(bench.control(), 0, file), NC_OK);
    return file;
  }
  // Runs to the end; returns the code of the alarm, or "". *x gets the X positions of the moves.
  static std::string run(test::Bench& bench, std::string* x, const std::function<void(unsigned)>& before_item = {}) {
    nc_item item{};
    nc_status status = NC_OK;
    for (unsigned n = 0;; ++n) {
      if (before_item) before_item(n);
      if ((status = nc_pull(bench.control(), 0, 1000, &item)) != NC_OK) break;
      if (item.kind == NC_ITEM_MOVE) *x += test::brief(item.u.move.machine.v[0]) + " ";
    }
    nc_alarm alarm{};
    return status == NC_ALARMED && nc_alarm_get(bench.control(), 0, &alarm) == NC_OK ? alarm.code : "";
  }
};

TEST_F(ProgramsTest, TenThousandSelectionsOfAThousandFiles) {
  for (int i = 0; i < 1000; ++i) write("p" + std::to_string(i) + ".nc", "G0 X" + std::to_string(i + 1) + ".\nM30\n");
  for (const uint64_t copy_bytes : {uint64_t{1} << 20, uint64_t{0}}) {
    rt::ProgramText::Options options;
    options.copy_bytes = copy_bytes;
    ProgramFiles files(folder_, options);
    test::Bench bench;  // its program store has 32 places
    files.attach(bench.control());
    const unsigned before = descriptors();
    std::mt19937 random(5);
    for (int i = 0; i < 10000; ++i) {
      const unsigned number = i < 2000 ? static_cast<unsigned>(i) % 1000 : random() % 1000;
      selected(&files, bench, "p" + std::to_string(number) + ".nc");
      if (i % 97 != 0) continue;
      std::string x;
      ASSERT_EQ(run(bench, &x), "");
      ASSERT_EQ(x, std::to_string(number + 1) + " ");
      ASSERT_LE(descriptors(), before + 4);
    }
  }
}

// More sub programs in one run than there are places: those whose last call is longest ago are removed.
TEST_F(ProgramsTest, ARunThatCallsMoreProgramsThanTheStoreHolds) {
  std::string main, expected;
  for (int i = 1; i <= 500; ++i) {
    write("O" + std::to_string(i), "G0 X" + std::to_string(i) + ".\n" + "G0 X0\n#100=1\nM99\n");
    main += "M98 P" + std::to_string(i) + "\nM98 P1\n";
    expected += std::to_string(i) + " 0 1 0 ";
  }
  write("main.nc", main + "M30\n");
  ProgramFiles files(folder_);
  test::Bench bench(NC_DIALECT_M700, [](nc_config& c) { c.look_ahead = 64, c.programs = 200; });
  files.attach(bench.control());
  std::string x;
  selected(&files, bench, "main.nc");
  EXPECT_EQ(run(bench, &x), "");
  EXPECT_EQ(x, expected);
  EXPECT_EQ(files.entered(), 501u) << "O1 was called every time and has stayed";
}

TEST_F(ProgramsTest, SubProgramsAreThoseOfTheSelection) {
  write("main.nc", "M98 P5\nM98 P5\nM30\n");
  write("O5", "G0 X1.\nG0 X2.\nM99\n");
  ProgramFiles files(folder_);
  test::Bench bench;
  files.attach(bench.control());
  unsigned file = selected(&files, bench, "main.nc");
  std::string x;
  EXPECT_EQ(run(bench, &x, [&](unsigned item) {
              if (item == 3) write("O5", "G0 X8.\nG0 X9.\nM99\n");
            }), "");
  EXPECT_EQ(x, "1 2 1 2 ");
  ASSERT_EQ(nc_program_select(bench.control(), 0, file), NC_OK);  // M30 rewinds the program, but does not select it anew
  x.clear();
  EXPECT_EQ(run(bench, &x), "");
  EXPECT_EQ(x, "1 2 1 2 ");
  selected(&files, bench, "main.nc");
  selected(&files, bench, "main.nc");
  x.clear();
  EXPECT_EQ(run(bench, &x), "");
  EXPECT_EQ(x, "8 9 8 9 ");
}

TEST_F(ProgramsTest, WhatIsRememberedStays) {
  write("a.nc", "G0 X1.\nM30\n");
  write("b.nc", "G0 X2.\nM30\n");
  ProgramFiles files(folder_);
  test::Bench bench;
  const unsigned a = selected(&files, bench, "a.nc");
  files.set_remembered([a](unsigned file) { return file == a; });
  selected(&files, bench, "b.nc");
  selected(&files, bench, "b.nc");
  ASSERT_EQ(nc_program_select(bench.control(), 0, a), NC_OK);
  std::string x;
  EXPECT_EQ(run(bench, &x), "");
  EXPECT_EQ(x, "1 ");
}

// Who selects a program waits for it, and so do all commands behind: a large one is not read for its hash.
TEST_F(ProgramsTest, TheHashOfALargeProgramIsThatOfItsFile) {
  write("large.nc", "M30\n");
  std::filesystem::resize_file(folder_ + "/large.nc", std::uintmax_t{64} << 30);  // sparse, but nobody reads so much
  ProgramFiles files(folder_);
  test::Bench bench;
  const std::string hash = files.hash_of(selected(&files, bench, "large.nc"));
  EXPECT_EQ(hash.size(), 64u);
  EXPECT_EQ(files.hash_of(selected(&files, bench, "large.nc")), hash);
  std::filesystem::last_write_time(folder_ + "/large.nc", std::filesystem::last_write_time(folder_ + "/large.nc") - std::chrono::hours(1));
  EXPECT_NE(files.hash_of(selected(&files, bench, "large.nc")), hash);
}

TEST_F(ProgramsTest, AProtectedProgramCanBeSelectedAgain) {
  write("O9001", "G0 X1.\nM30\n");
  ProgramFiles files(folder_);
  test::Bench bench;
  bench.param("1121", "1");
  const unsigned first = selected(&files, bench, "O9001");
  EXPECT_EQ(selected(&files, bench, "O9001"), first);
  write("O9001", "G0 X2.   \nM30\n");
  unsigned file = 0;
  std::string error;
  EXPECT_EQ(files.add(bench.control(), folder_ + "/O9001", &file, &error), NC_E_STATE);
  EXPECT_NE(error.find("protected"), std::string::npos) << error;
}

// A parameter protects a program from those who operate the control. Its file is what is checked before a start, so it is what runs.
TEST_F(ProgramsTest, AProtectedSubProgramIsThatOfItsFile) {
  write("O9001.nc", "G0 X1.\nM99\n");
  write("a.nc", "M98 P9001\nM30\n");
  ProgramFiles files(folder_);
  test::Bench bench;
  files.attach(bench.control());
  bench.param("1121", "1");
  for (const std::string wanted : {"1", "2"}) {
    write("O9001.nc", "G0 X" + wanted + ".\nM99\n");
    selected(&files, bench, "a.nc");
    std::string x;
    EXPECT_EQ(run(bench, &x), "");
    EXPECT_EQ(x, wanted + " ");
    ASSERT_EQ(nc_reset(bench.control(), 0), NC_OK);  // blocks that were read ahead do not come back
  }
  std::filesystem::remove(folder_ + "/O9001.nc");
  selected(&files, bench, "a.nc");
  std::string x;
  EXPECT_NE(run(bench, &x), "") << "there is no such program any more";
}

TEST_F(ProgramsTest, NamesOf255Bytes) {
  const std::string name(255, 'p');
  write(name, "G0 X4.\nM30\n");
  ProgramFiles files(folder_);
  test::Bench bench;
  selected(&files, bench, name);
  std::string x;
  EXPECT_EQ(run(bench, &x), "");
  EXPECT_EQ(x, "4 ");
}

// The program jumps in its text while somebody rewrites the file, at any item and in any way: the old program is executed, to its end or to an
// alarm.
TEST_F(ProgramsTest, PropertyWhatRunsIsTheOldProgram) {
  const auto text_of = [](int x) {
    std::string text = "G91\n#1=0\nWHILE[#1LT3]DO1\n";
    const std::string at = std::to_string(x) + ".\n";
    for (int i = 0; i < 40; ++i) text += "G0 X" + at + "(" + std::string(60, 'C') + ")\n";
    text += "M98 H100\n#1=#1+1\nIF[#1EQ2]GOTO50\nG0 X" + at + "N50 G0 X" + at + "END1\nM30\n(" + std::string(70000, 'C') + ")\nN100 G0 X" + at + "M99\n";
    return text;
  };
  std::string expected;
  for (int i = 1; i <= 3 * 40 + 3 + 2 + 3; ++i) expected += std::to_string(i) + " ";
  const std::string old = text_of(1), other = text_of(2);
  ASSERT_EQ(old.size(), other.size());
  std::mt19937 random(9);
  unsigned alarms = 0, ended = 0;
  for (const uint64_t copy_bytes : {uint64_t{1} << 20, uint64_t{0}}) {
    rt::ProgramText::Options options;
    options.copy_bytes = copy_bytes;
    for (int trial = 0; trial < 60; ++trial) {
      write("main.nc", old);
      ProgramFiles files(folder_, options);
      test::Bench bench(NC_DIALECT_M700, [](nc_config& c) { c.window_bytes = 1024, c.look_ahead = 64; });
      selected(&files, bench, "main.nc");
      const unsigned first = random() % 250, way = random() % 6;
      size_t written = 0;
      int writer = -1;
      std::string x;
      const std::string alarm = run(bench, &x, [&](unsigned item) {
        if (item < first) return;
        const std::string path = folder_ + "/main.nc";
        if (item == first && way == 3) std::filesystem::remove(path);
        if (item == first && way == 4) std::filesystem::resize_file(path, random() % old.size());
        if (item == first && way == 5) write("new", other), std::filesystem::rename(folder_ + "/new", path);
        if (way > 2) return;
        if (writer < 0) writer = open(path.c_str(), O_WRONLY | O_CLOEXEC | (way == 0 ? O_TRUNC : way == 1 ? O_APPEND : 0));
        const size_t length = std::min<size_t>(random() % 700, other.size() - written);
        ASSERT_EQ(::write(writer, other.data() + written, length), static_cast<ssize_t>(length));
        written += length;
      });
      if (writer >= 0) close(writer);
      EXPECT_EQ(expected.compare(0, x.size(), x), 0) << "way " << way << " at item " << first << ": " << x;
      if (alarm.empty()) {
        EXPECT_EQ(x, expected);
        ++ended;
      } else {
        EXPECT_EQ(alarm, "P461");
        EXPECT_EQ(copy_bytes, 0u) << "a copy does not change";
        ++alarms;
      }
    }
  }
  EXPECT_GE(ended, 60u);
  EXPECT_GT(alarms, 0u);
}

}  // namespace
}  // namespace nc::tools
