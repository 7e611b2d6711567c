// SPDX-License-Identifier: Apache-2.0
// The file of the history: bounded, whole behind a kill, a full disk and damage.
#include "runtime/history/store.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>

namespace nc::rt::history {
namespace {

namespace fs = std::filesystem;
constexpr std::int64_t kNow = 1'790'000'000'000'000'000;  // a day in 2026
constexpr std::int64_t kDay = 86'400'000'000'000;

class HistoryStore : public testing::Test {
 protected:
  void SetUp() override {
    char pattern[] = "/tmp/nc-history-XXXXXX";
    ASSERT_NE(mkdtemp(pattern), nullptr);
    folder_ = pattern;
    path_ = folder_ + "/history";
  }
  void TearDown() override { fs::remove_all(folder_); }

  static Entry entry(std::uint64_t id, EntryKind kind = EntryKind::kAction, std::int64_t time_ns = kNow) {
    Entry e;
    e.id = id;
    e.kind = kind;
    e.time_ns = e.end_ns = time_ns;
    e.text = "entry " + std::to_string(id);
    e.user = id % 2 == 0 ? "anna" : "bert";
    return e;
  }
  static Batch batch(std::uint64_t first, std::uint64_t last) {
    Batch all;
    for (std::uint64_t id = first; id <= last; ++id) all.added.push_back(entry(id));
    return all;
  }
  // Opens the file and gives what is in it.
  static std::vector<Entry> all_of(Store* store, Filter filter = {}) {
    std::vector<Entry> all;
    std::string error;
    do {
      std::vector<Entry> page;
      EXPECT_TRUE(store->list(filter, &page, &filter.from, &error)) << error;
      all.insert(all.end(), page.begin(), page.end());
    } while (filter.from != 0);
    return all;
  }
  void open(Store* store, const std::string& told_part = "") {
    std::string error, told;
    ASSERT_TRUE(store->open(&error, &told)) << error;
    EXPECT_NE(told.find(told_part), std::string::npos) << told;
    EXPECT_EQ(told.empty(), told_part.empty()) << told;
  }
  void write(Store* store, const Batch& all) {
    std::string error;
    ASSERT_TRUE(store->write(all, &error)) << error;
  }

  std::string folder_, path_;
};

TEST_F(HistoryStore, KeepsWhatWasWritten) {
  {
    Store store(path_, {});
    open(&store);
    EXPECT_EQ(store.last_id(), 0u);
    Batch first = batch(1, 3);
    first.added[1].kind = EntryKind::kAlarm;
    first.added[1].end_ns = 0;
    first.added[1].text = std::string("a\0b'; DROP TABLE entries;--\xff", 28);
    first.counters = {{"on", 0, 0, 12.5, "s"}, {"spindle", 1, 2, 3.0, "s"}};
    first.runs = {{"part.nc", 1, 10, 0, 0, 0, kNow}, {"part.nc", 1, 8, 0, 0, 0, kNow + 1}};
    write(&store, first);
  }
  struct stat info {};
  ASSERT_EQ(stat(path_.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 07u, 0u) << "others cannot read it";
  Store store(path_, {});
  open(&store);
  EXPECT_EQ(store.last_id(), 3u);
  EXPECT_EQ(store.counter("on"), 12.5);
  EXPECT_EQ(store.counter("spindle 1 2"), 3.0);
  EXPECT_EQ(store.counter("never"), 0);
  const std::vector<Entry> all = all_of(&store);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].text, "entry 3");
  EXPECT_EQ(all[1].text, std::string("a\0b'; DROP TABLE entries;--\xff", 28));
  EXPECT_EQ(all[1].end_ns, kEndUnknown) << "nobody knows when an alarm has gone that was active at the end of ncrtd";
  std::vector<ProgramTimes> programs;
  bool more = true;
  std::string error;
  ASSERT_TRUE(store.programs(0, 10, &programs, &more, &error));
  ASSERT_EQ(programs.size(), 1u);
  EXPECT_FALSE(more);
  EXPECT_EQ(programs[0].runs, 2u);
  EXPECT_EQ(programs[0].shortest_s, 8);
  EXPECT_EQ(programs[0].longest_s, 10);
  EXPECT_EQ(programs[0].total_s, 18);
}

TEST_F(HistoryStore, AnEntryThatIsWrittenAgainIsReplaced) {
  Store store(path_, {});
  open(&store);
  write(&store, batch(1, 1));
  Batch again = batch(1, 1);
  again.added[0].outcome = "completed";
  write(&store, again);
  ASSERT_EQ(all_of(&store).size(), 1u);
  EXPECT_EQ(all_of(&store)[0].outcome, "completed");
}

TEST_F(HistoryStore, IsFilteredAndComesInPages) {
  Store store(path_, {});
  open(&store);
  Batch all;
  for (std::uint64_t id = 1; id <= 50; ++id) all.added.push_back(entry(id, static_cast<EntryKind>(id % kEntryKinds), kNow + static_cast<std::int64_t>(id) * 1000));
  write(&store, all);
  Filter filter;
  filter.count = 7;
  EXPECT_EQ(all_of(&store, filter).size(), 50u);
  filter.user = "anna";
  EXPECT_EQ(all_of(&store, filter).size(), 25u);
  filter.kind = static_cast<int>(EntryKind::kChange);
  EXPECT_EQ(all_of(&store, filter).size(), 0u) << "changes have odd numbers here";
  filter.user = "bert";
  EXPECT_EQ(all_of(&store, filter).size(), 8u);
  filter.since_ns = kNow + 10'000;
  filter.until_ns = kNow + 21'000;
  EXPECT_EQ(all_of(&store, filter).size(), 2u);
}

TEST_F(HistoryStore, TheNumberOfEntriesIsBounded) {
  Store store(path_, {1000, 730, 256u << 20});
  open(&store);
  for (std::uint64_t first = 1; first < 5000; first += 100) write(&store, batch(first, first + 99));
  const std::vector<Entry> all = all_of(&store);
  EXPECT_EQ(all.size(), 1000u);
  EXPECT_EQ(all.front().id, 5000u);
}

TEST_F(HistoryStore, TheFileIsBounded) {
  Store store(path_, {1'000'000, 730, 1u << 20});
  open(&store);
  std::uint64_t id = 1;
  for (unsigned i = 0; i < 200; ++i) {
    Batch some = batch(id, id + 99);
    for (Entry& e : some.added) e.text += std::string(200, 'x');
    id += 100;
    write(&store, some);
  }
  EXPECT_EQ(all_of(&store).front().id, id - 1);
  EXPECT_LE(fs::file_size(path_), 1u << 20);
  EXPECT_LE(fs::file_size(path_ + "-wal"), 8u << 20);
}

TEST_F(HistoryStore, WhatIsTooOldGoesButNeverAllAtOnce) {
  Store store(path_, {1'000'000, 10, 256u << 20});
  open(&store);
  Batch old;
  for (std::uint64_t id = 1; id <= 5000; ++id) old.added.push_back(entry(id, EntryKind::kAction, kNow - 20 * kDay));
  write(&store, old);
  Batch aged = batch(5001, 5001);
  aged.now_ns = kNow;
  write(&store, aged);
  EXPECT_EQ(all_of(&store).size(), 4001u);
  for (unsigned i = 0; i < 10; ++i) write(&store, aged);
  EXPECT_EQ(all_of(&store).size(), Store::kAlwaysKept) << "the newest ones stay, whatever the clock says";
}

TEST_F(HistoryStore, AClockThatJumpsBackTakesNothingAndKeepsTheOrder) {
  Store store(path_, {});
  open(&store);
  write(&store, batch(1, 2000));
  Batch before = batch(2001, 2001);
  before.added[0].time_ns = 1'000'000'000;  // 1970
  before.now_ns = 1'000'000'000;
  write(&store, before);
  const std::vector<Entry> all = all_of(&store);
  ASSERT_EQ(all.size(), 2001u);
  EXPECT_EQ(all[0].id, 2001u) << "the order is that in which they came";
  EXPECT_EQ(all[1].id, 2000u);
}

// Writes entries until it is killed, and says after each write how far it has come.
[[noreturn]] void write_for_ever(const std::string& path, int said) {
  Store store(path, {2000, 730, 256u << 20});
  std::string error, told;
  if (!store.open(&error, &told)) _exit(1);
  for (std::uint64_t id = store.last_id() + 1;;) {
    Batch some;
    for (unsigned i = 0; i < 20; ++i, ++id) {
      some.added.push_back({});
      some.added.back().id = id;
      some.added.back().text = std::string(300, static_cast<char>('a' + id % 26));
    }
    some.counters = {{"on", 0, 0, static_cast<double>(id - 1), "s"}};
    if (!store.write(some, &error)) _exit(2);
    const std::uint64_t written = id - 1;
    if (write(said, &written, sizeof written) != sizeof written) _exit(3);
  }
}

TEST_F(HistoryStore, AKillAtAnyMomentLosesNothingThatWasWritten) {
  std::mt19937 random(11);
  for (unsigned kill_number = 0; kill_number < 25; ++kill_number) {
    int said[2];
    ASSERT_EQ(pipe(said), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      close(said[0]);
      write_for_ever(path_, said[1]);
    }
    close(said[1]);
    std::uint64_t written = 0;
    const unsigned writes = 1 + random() % 12;  // the kill comes somewhere behind this one
    for (unsigned i = 0; i < writes; ++i) ASSERT_EQ(read(said[0], &written, sizeof written), static_cast<ssize_t>(sizeof written));
    usleep(random() % 3000);
    ASSERT_EQ(kill(child, SIGKILL), 0);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "it ended by itself: " << WEXITSTATUS(status);
    for (std::uint64_t more = 0; read(said[0], &more, sizeof more) == static_cast<ssize_t>(sizeof more);) written = more;
    close(said[0]);
    Store store(path_, {2000, 730, 256u << 20});
    open(&store);
    // The one write more is the one that was killed between its commit and its message.
    EXPECT_GE(store.last_id(), written) << kill_number;
    EXPECT_LE(store.last_id(), written + 20) << kill_number;
    EXPECT_EQ(store.counter("on"), static_cast<double>(store.last_id())) << "a write is whole";
    const std::vector<Entry> all = all_of(&store);
    EXPECT_EQ(all.size(), std::min<std::uint64_t>(store.last_id(), 2000));
    for (const Entry& e : all) ASSERT_EQ(e.text, std::string(300, static_cast<char>('a' + e.id % 26)));
  }
}

TEST_F(HistoryStore, ADamagedFileIsPutAsideAndANewOneBegins) {
  for (unsigned n = 1; n <= Store::kMostAside; ++n) {
    std::ofstream(path_, std::ios::binary) << std::string(20'000, 'x');
    Store store(path_, {});
    open(&store, "history.damaged-" + std::to_string(n));
    write(&store, batch(1, 10));
    EXPECT_EQ(all_of(&store).size(), 10u);
    EXPECT_EQ(fs::file_size(path_ + ".damaged-" + std::to_string(n)), 20'000u) << "it is as it was";
  }
  std::ofstream(path_, std::ios::binary) << std::string(20'000, 'x');
  Store store(path_, {});
  std::string error, told;
  EXPECT_FALSE(store.open(&error, &told));
  EXPECT_NE(error.find("damaged"), std::string::npos) << error;
  EXPECT_NE(error.find("files already"), std::string::npos) << error;
  EXPECT_EQ(fs::file_size(path_), 20'000u);
}

TEST_F(HistoryStore, TheCountersOfADamagedFileAreTakenOver) {
  {
    Store store(path_, {});
    open(&store);
    Batch some = batch(1, 3000);
    some.counters = {{"spindle", 1, 1, 7200.0, "s"}};
    write(&store, some);
  }
  {
    // A page in the middle, which belongs to the entries.
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(40 * 4096);
    file << std::string(4096, '\x5a');
  }
  Store store(path_, {});
  open(&store, "damaged-1");
  EXPECT_EQ(store.counter("spindle 1 1"), 7200);
  store.close();
  std::string error, told;
  ASSERT_TRUE(store.open(&error, &told)) << error;
  EXPECT_EQ(store.counter("spindle 1 1"), 7200) << "it is in the new file";
}

TEST_F(HistoryStore, AFileOfSomebodyElseIsLeftAsItIs) {
  std::string error, told;
  const auto statements = [&](const char* text) {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &database), SQLITE_OK);
    ASSERT_EQ(sqlite3_exec(database, text, nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(database);
  };
  statements("CREATE TABLE songs(name TEXT)");
  {
    Store store(path_, {});
    EXPECT_FALSE(store.open(&error, &told));
    EXPECT_NE(error.find("another program"), std::string::npos) << error;
  }
  fs::remove_all(path_);
  {
    Store store(path_, {});
    open(&store);
  }
  statements("PRAGMA user_version=99");
  Store store(path_, {});
  EXPECT_FALSE(store.open(&error, &told));
  EXPECT_NE(error.find("another version"), std::string::npos) << error;
  EXPECT_FALSE(fs::exists(path_ + ".damaged-1"));
}

TEST_F(HistoryStore, WhatIsNoPlainFileIsRefused) {
  std::string error, told;
  fs::create_directory(path_);
  Store folder(path_, {});
  EXPECT_FALSE(folder.open(&error, &told));
  fs::remove(path_);
  std::ofstream(folder_ + "/other") << "text";
  fs::create_symlink(folder_ + "/other", path_);
  Store link(path_, {});
  EXPECT_FALSE(link.open(&error, &told));
  Store nowhere(folder_ + "/none/history", {});
  EXPECT_FALSE(nowhere.open(&error, &told));
  EXPECT_NE(error.find("none/history"), std::string::npos) << error;
}

TEST_F(HistoryStore, TwoProcessesDoNotWriteIntoOneFile) {
  Store one(path_, {}), two(path_, {});
  open(&one);
  write(&one, batch(1, 1));
  std::string error, told;
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) _exit(two.open(&error, &told) ? 1 : error.find("another process") != std::string::npos ? 0 : 2);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  write(&one, batch(2, 2));
}

// A disk that is full: the process may not make a file larger than this.
TEST_F(HistoryStore, AFullDiskLosesNothingThatWasWritten) {
  {
    Store store(path_, {});
    open(&store);
    write(&store, batch(1, 500));
  }
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    (void)signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{300'000, 300'000};
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(1);
    Store store(path_, {});
    std::string error, told;
    if (!store.open(&error, &told)) _exit(2);
    std::uint64_t id = 501;
    bool failed = false;
    for (; id < 100'000 && !failed; id += 500) {
      Batch some;
      for (std::uint64_t i = 0; i < 500; ++i) some.added.push_back(HistoryStore::entry(id + i));
      failed = !store.write(some, &error);
    }
    if (!failed || error.empty()) _exit(3);
    std::vector<Entry> entries;
    std::uint64_t next = 0;
    if (!store.list({}, &entries, &next, &error) || entries.empty() || entries[0].id + 1 != id - 500) _exit(4);  // what is there can still be read
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  Store store(path_, {});
  open(&store);
  EXPECT_GE(store.last_id(), 500u);
  write(&store, batch(store.last_id() + 1, store.last_id() + 500));
  EXPECT_FALSE(fs::exists(path_ + ".damaged-1")) << "a full disk is no damage";
}

}  // namespace
}  // namespace nc::rt::history
