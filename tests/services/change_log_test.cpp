// SPDX-License-Identifier: Apache-2.0
// The file of the changes on a disk that is full.
#include "runtime/services/change_log.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace nc::rt::services {
namespace {

Change change(const std::string& what) {
  Change made;
  made.time_ns = 1;
  made.user = "anna";
  made.client = "c";
  made.service = "tools.set";
  made.what = what;
  return made;
}

// A disk that is full: the process may not make a file larger than this. What a write has begun there is no half of a line that swallows the next one, and what had no room is written
// when there is some.
TEST(ChangeLogFile, WhatHasNoRoomOnAFullDiskIsWrittenLater) {
  char pattern[] = "/tmp/nc-changes-XXXXXX";
  ASSERT_NE(mkdtemp(pattern), nullptr);
  const std::string path = std::string(pattern) + "/changes";
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    (void)signal(SIGXFSZ, SIG_IGN);
    rlimit limit{1'000, RLIM_INFINITY};
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(1);
    ChangeLog log(path);
    std::string error;
    if (!log.open(&error)) _exit(2);
    unsigned written = 0;
    while (written < 100 && log.add(change("written " + std::to_string(written)), &error)) ++written;
    if (written == 0 || written == 100 || error.empty() || error.find("Success") != std::string::npos) _exit(3);
    if (log.add(change("no room either"), &error)) _exit(4);
    if (log.newest(0, 1)["changes"][0]["what"] != "no room either") _exit(5);  // it is remembered
    ChangeLog meanwhile(path);
    if (!meanwhile.open(&error) || meanwhile.newest(0, 500)["changes"].size() != written) _exit(10);  // whole lines alone
    limit.rlim_cur = RLIM_INFINITY;
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(6);
    if (!log.add(change("with room again"), &error)) _exit(7);
    ChangeLog again(path);
    if (!again.open(&error)) _exit(8);
    const Json changes = again.newest(0, 500)["changes"];
    if (changes.size() != written + 3 || changes[0]["what"] != "with room again" || changes[1]["what"] != "no room either") _exit(9);
    for (std::size_t i = 0; i < changes.size(); ++i)
      if (changes[i]["number"] != changes.size() - i) _exit(11);
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  std::filesystem::remove_all(pattern);
}

// What waits is written without another change, too: when the changes are listed, and at the end.
TEST(ChangeLogFile, WhatWaitsIsWrittenWithoutAnotherChange) {
  char pattern[] = "/tmp/nc-changes-XXXXXX";
  ASSERT_NE(mkdtemp(pattern), nullptr);
  const std::string path = std::string(pattern) + "/changes";
  std::string error;
  {
    ChangeLog log(path);
    std::filesystem::create_directory(path);  // no file can be made there, as where a file system has no room for one more
    EXPECT_FALSE(log.open(&error));
    EXPECT_FALSE(log.add(change("one"), &error));
    EXPECT_EQ(error.find(path), 0u) << error;
    std::filesystem::remove(path);
    EXPECT_TRUE(log.settle(&error)) << error;
    std::filesystem::rename(path, path + "-kept");
    std::filesystem::create_directory(path);
    EXPECT_TRUE(log.add(change("two"), &error)) << "the file is open";
    std::filesystem::remove(path);
    std::filesystem::rename(path + "-kept", path);
    ChangeLog other(path);
    ASSERT_TRUE(other.open(&error));
    EXPECT_EQ(other.newest(0, 9)["changes"].size(), 2u);
  }
  std::filesystem::remove(path);
  {
    ChangeLog log(path);
    std::filesystem::create_directory(path);
    EXPECT_FALSE(log.open(&error));
    EXPECT_FALSE(log.add(change("three"), &error));
    std::filesystem::remove(path);
  }
  ChangeLog again(path);
  ASSERT_TRUE(again.open(&error));
  EXPECT_EQ(again.newest(0, 9)["changes"].size(), 1u) << "written at the end";
  std::filesystem::remove_all(pattern);
}

// What waits is bounded: the oldest lines go, and that is said.
TEST(ChangeLogFile, WhatWaitsIsBounded) {
  char pattern[] = "/tmp/nc-changes-XXXXXX";
  ASSERT_NE(mkdtemp(pattern), nullptr);
  const std::string path = std::string(pattern) + "/changes";
  std::string error;
  ChangeLog log(path);
  std::filesystem::create_directory(path);
  EXPECT_FALSE(log.open(&error));
  const std::string large(100'000, 'x');
  const unsigned count = static_cast<unsigned>(ChangeLog::kMostWaiting / large.size()) + 5;
  for (unsigned n = 0; n < count; ++n) EXPECT_FALSE(log.add(change(std::to_string(n) + large), &error));
  EXPECT_NE(error.find("older ones are lost"), std::string::npos) << error;
  std::filesystem::remove(path);
  EXPECT_TRUE(log.settle(&error)) << error;
  EXPECT_LE(std::filesystem::file_size(path), ChangeLog::kMostWaiting);
  ChangeLog again(path);
  ASSERT_TRUE(again.open(&error));
  EXPECT_EQ(again.newest(0, 1)["changes"][0]["number"], count);
  std::filesystem::remove_all(pattern);
}

// A file that has reached its size becomes PATH.1; where that cannot be, it keeps its name and its size, and what comes waits.
TEST(ChangeLogFile, WhatComesWaitsForAFileThatCannotBeTurned) {
  char pattern[] = "/tmp/nc-changes-XXXXXX";
  ASSERT_NE(mkdtemp(pattern), nullptr);
  const std::string path = std::string(pattern) + "/changes";
  std::string error;
  const std::string begin = "{\"after\":\"";  // what a power cut leaves of a line
  std::ofstream(path) << begin << std::string(static_cast<std::size_t>(ChangeLog::kMostBytes) - begin.size(), 'x') << "\n";
  std::filesystem::create_directories(path + ".1/in-the-way");
  ChangeLog log(path);
  EXPECT_FALSE(log.open(&error));
  EXPECT_FALSE(log.add(change("one"), &error));
  EXPECT_EQ(std::filesystem::file_size(path), static_cast<std::uintmax_t>(ChangeLog::kMostBytes) + 1);
  std::filesystem::remove_all(path + ".1");
  EXPECT_TRUE(log.add(change("two"), &error)) << error;
  ChangeLog again(path);
  ASSERT_TRUE(again.open(&error));
  EXPECT_EQ(again.newest(0, 9)["changes"].size(), 2u);
  std::filesystem::remove_all(pattern);
}

// One user changes one row, another one a row of his own again and again.
Change value_change(const std::string& user, const std::string& place, int value, std::size_t length = 0) {
  Change made = change(place + std::string(length, '.'));
  made.user = user;
  ValueChange& one = made.values.emplace_back();
  EXPECT_TRUE(parse_place(place, &one.place));
  one.before = std::to_string(value - 1);
  one.after = std::to_string(value);
  return made;
}

// Whoever changes much wipes neither who has changed a row last, nor what others may take back; also not behind starts, when the file has been turned several times.
TEST(ChangeLogFile, TheLastChangeOfARowIsKept) {
  char pattern[] = "/tmp/nc-changes-XXXXXX";
  ASSERT_NE(mkdtemp(pattern), nullptr);
  const std::string path = std::string(pattern) + "/changes";
  TablePlace tool;
  ASSERT_TRUE(parse_place("tool 33 length", &tool));
  const auto look = [&](const ChangeLog& log, unsigned round) {
    const Json of_tool = log.newest(0, 5, "tool 33")["changes"];
    ASSERT_EQ(of_tool.size(), 1u) << round;
    EXPECT_EQ(of_tool[0]["user"], "anna");
    const Change* last = log.last_of("anna", Right::kSetUp);
    ASSERT_NE(last, nullptr) << round;
    EXPECT_EQ(last->number, 1u);
    ASSERT_NE(log.last_change_of(tool), nullptr);
    EXPECT_EQ(log.last_change_of(tool)->after, "7");
    EXPECT_EQ(log.last_of("ben", Right::kSetUp)->values[0].after, std::to_string((round + 1) * 1300));
    EXPECT_LT(log.newest(0, 100'000)["changes"].size(), ChangeLog::kRemembered + 600);
  };
  std::string error;
  for (unsigned round = 0; round < 3; ++round) {
    ChangeLog log(path);
    ASSERT_TRUE(log.open(&error)) << error;
    if (round == 0) {
      ASSERT_TRUE(log.add(value_change("anna", "tool 33 length", 7), &error)) << error;
    }
    for (int n = 1; n <= 1300; ++n) ASSERT_TRUE(log.add(value_change("ben", "variable 1 505", static_cast<int>(round) * 1300 + n, 3500), &error)) << error;
    look(log, round);
    ChangeLog again(path);
    ASSERT_TRUE(again.open(&error)) << error;
    look(again, round);
    again.compare([](const TablePlace&, std::string* value) {
      *value = "another one";
      return true;
    });
    EXPECT_FALSE(is_lost(*again.last_of("anna", Right::kSetUp)));
  }
  EXPECT_TRUE(std::filesystem::exists(path + ".1"));
  std::filesystem::remove_all(pattern);
}

// Tables that are imported again and again cost him their undo who does that.
TEST(ChangeLogFile, ManyValuesCostTheirOwnUser) {
  ChangeLog log("");
  std::string error;
  ASSERT_TRUE(log.add(value_change("anna", "tool 33 length", 7), &error));
  for (int n = 0; n < 12; ++n) {
    Change import = change("import");
    import.user = "ben";
    for (unsigned v = 1; v <= 9'000; ++v) {
      ValueChange& value = import.values.emplace_back();
      value.place.table = TablePlace::Table::kVariable;
      value.place.number = v;
    }
    ASSERT_TRUE(log.add(std::move(import), &error));
  }
  ASSERT_NE(log.last_of("anna", Right::kSetUp), nullptr);
  EXPECT_EQ(log.last_of("ben", Right::kSetUp)->number, 13u);
  EXPECT_TRUE(log.find(2)->values.empty()) << "the oldest of him who has the most";
}

}  // namespace
}  // namespace nc::rt::services
