// SPDX-License-Identifier: Apache-2.0
// Retained devices: their file survives a power cut at any moment; what happens when it is damaged, and what comes back from it.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "runtime/ladder_task.hpp"
#include "runtime/retain/rows.hpp"
#include "runtime/retain/store.hpp"
#include "test_config.hpp"

namespace {

using namespace nc::rt;
using Loaded = RetainStore::Loaded;

class Retain : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("nc-retain-" + std::to_string(getpid()));
    std::filesystem::create_directory(folder_);
    path_ = (folder_ / "m.retain").string();
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  static std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream all;
    all << file.rdbuf();
    return all.str();
  }
  static void put(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  }
  // What a control would find that started now.
  Loaded found(std::string* payload) {
    RetainStore store(path_);
    payload->clear();
    return store.load(payload, &error_);
  }
  void save(const std::string& payload) {
    RetainStore store(path_);
    std::string old;
    (void)store.load(&old, &error_);
    ASSERT_TRUE(store.save(payload, &error_)) << error_;
  }
  std::filesystem::path folder_;
  std::string path_, error_;
};

TEST_F(Retain, WhatWasSavedComesBack) {
  std::string payload;
  EXPECT_EQ(found(&payload), Loaded::kNothing);
  save("first");
  EXPECT_EQ(found(&payload), Loaded::kWhole);
  EXPECT_EQ(payload, "first");
  const std::string all("\0\xff\n second", 10);
  save(all);
  EXPECT_EQ(found(&payload), Loaded::kWhole);
  EXPECT_EQ(payload, all);
  save("");
  EXPECT_EQ(found(&payload), Loaded::kWhole);
  EXPECT_EQ(payload, "");
  struct stat status {};
  ASSERT_EQ(stat(path_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
}

// Whenever the power fails during a save(), one of the two generations is there.
TEST_F(Retain, APowerCutAtAnyMomentLeavesOneGeneration) {
  save("one");
  save("two");
  const std::string two = bytes_of(path_), one = bytes_of(path_ + ".old");
  save("three");
  const std::string three = bytes_of(path_);
  std::string payload;
  for (std::size_t cut = 0; cut <= three.size(); ++cut) {  // in the middle of writing
    put(path_, two);
    put(path_ + ".old", one);
    put(path_ + ".new", three.substr(0, cut));
    EXPECT_EQ(found(&payload), Loaded::kWhole) << cut;
    EXPECT_EQ(payload, cut == three.size() ? "three" : "two") << cut;
  }
  std::filesystem::remove(path_);  // between the two renames
  put(path_ + ".old", two);
  EXPECT_EQ(found(&payload), Loaded::kWhole);
  EXPECT_EQ(payload, "three");
  std::filesystem::remove(path_ + ".new");
  EXPECT_EQ(found(&payload), Loaded::kOlder) << "no power cut leaves this: somebody has taken the last one away";
  EXPECT_NE(error_.find("m.retain is missing"), std::string::npos) << error_;
  EXPECT_EQ(payload, "two");
  save("four");  // saving continues from there
  EXPECT_EQ(found(&payload), Loaded::kWhole);
  EXPECT_EQ(payload, "four");
}

// A process that writes without end is killed at random moments: the file that it leaves is complete, and never older than
// the one that was found before.
TEST_F(Retain, AKillAtARandomMomentLeavesAWholeGeneration) {
  std::mt19937 chance(7);
  std::uint64_t newest = 0;
  unsigned in_the_middle = 0;
  // At least 60 rounds, and as many more as a slow or busy machine needs to have written and to have been cut in the middle.
  for (unsigned round = 0; round < 60 || ((newest <= 60 || in_the_middle == 0) && round < 6000); ++round) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      RetainStore store(path_);
      std::string payload, error;
      (void)store.load(&payload, &error);
      for (std::uint64_t n = store.generation() + 1;; ++n) {
        payload.assign(1 + n % 50000, static_cast<char>('a' + n % 26));
        payload.replace(0, std::min<std::size_t>(payload.size(), 20), std::to_string(n) + ":");
        if (!store.save(payload, &error)) _exit(1);
      }
    }
    usleep(500 + chance() % 20000);
    kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "it could not write";
    in_the_middle += std::filesystem::exists(path_ + ".new") ? 1 : 0;
    RetainStore store(path_);
    std::string payload;
    const Loaded loaded = store.load(&payload, &error_);
    ASSERT_TRUE(loaded == Loaded::kWhole || (loaded == Loaded::kNothing && newest == 0)) << round << ": " << error_;
    if (loaded == Loaded::kNothing) continue;
    ASSERT_GE(store.generation(), newest);
    newest = store.generation();
    EXPECT_EQ(payload.substr(0, payload.find(':')), std::to_string(newest)) << "the payload of that generation";
  }
  EXPECT_GT(newest, 60u);
  EXPECT_GT(in_the_middle, 0u) << "some of them came in the middle of a write";
}

TEST_F(Retain, EveryDamagedBitAndEveryCutIsSeen) {
  save("one");
  save("two");
  const std::string two = bytes_of(path_);
  std::string payload;
  for (std::size_t bit = 0; bit < 8 * two.size(); ++bit) {
    std::string bad = two;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << bit % 8));
    put(path_, bad);
    ASSERT_EQ(found(&payload), Loaded::kOlder) << bit;
    ASSERT_EQ(payload, "one") << bit;
    ASSERT_NE(error_.find("is damaged"), std::string::npos) << error_;
  }
  for (std::size_t cut = 0; cut < two.size(); ++cut) {
    put(path_, two.substr(0, cut));
    ASSERT_EQ(found(&payload), Loaded::kOlder) << cut;
    ASSERT_EQ(payload, "one") << cut;
  }
  put(path_, two + "x");
  EXPECT_EQ(found(&payload), Loaded::kOlder);
  std::string other = two;
  other[8] = 2;
  put(path_, other);
  EXPECT_EQ(found(&payload), Loaded::kOlder);
  EXPECT_NE(error_.find("of another version of the control"), std::string::npos) << error_;
}

TEST_F(Retain, BothDamagedIsSaidAndKeptForALook) {
  save("one");
  save("two");
  put(path_, "garbage");
  put(path_ + ".old", std::string(100000, 'x'));
  std::string payload;
  EXPECT_EQ(found(&payload), Loaded::kDamaged);
  EXPECT_NE(error_.find("m.retain is damaged"), std::string::npos) << error_;
  EXPECT_NE(error_.find("m.retain.old is damaged"), std::string::npos) << error_;
  EXPECT_EQ(found(&payload), Loaded::kDamaged) << "until something is done about it";
  RetainStore(path_).set_aside();
  EXPECT_EQ(bytes_of(path_ + ".damaged"), "garbage");
  save("three");
  EXPECT_EQ(found(&payload), Loaded::kWhole);
  EXPECT_EQ(payload, "three");
}

TEST_F(Retain, WhatIsNoFileIsNeitherWaitedForNorBelieved) {
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);
  std::string payload;
  EXPECT_EQ(found(&payload), Loaded::kDamaged);
  std::filesystem::remove(path_);
  std::filesystem::create_directory(path_);
  EXPECT_EQ(found(&payload), Loaded::kDamaged);
  std::filesystem::remove(path_);
  std::filesystem::create_symlink("/dev/zero", path_);
  EXPECT_EQ(found(&payload), Loaded::kDamaged);
}

TEST_F(Retain, AFolderThatIsNotThereIsAnErrorAndASecondControlIsKeptAway) {
  RetainStore nowhere((folder_ / "none" / "m").string());
  EXPECT_FALSE(nowhere.lock(&error_));
  EXPECT_FALSE(nowhere.save("x", &error_));
  EXPECT_NE(error_.find("none/m"), std::string::npos) << error_;
  RetainStore first(path_), second(path_);
  ASSERT_TRUE(first.lock(&error_)) << error_;
  EXPECT_FALSE(second.lock(&error_));
  EXPECT_NE(error_.find("another control"), std::string::npos) << error_;
  EXPECT_FALSE(first.save(std::string(RetainStore::kMaxPayload + 1, 'x'), &error_));
}

TEST_F(Retain, ASaveThatFailsLeavesWhatWasThere) {
  save("one");
  std::filesystem::create_directory(path_ + ".new");
  RetainStore store(path_);
  std::string payload;
  ASSERT_EQ(store.load(&payload, &error_), Loaded::kWhole);
  EXPECT_FALSE(store.save("two", &error_));
  EXPECT_EQ(found(&payload), Loaded::kWhole);
  EXPECT_EQ(payload, "one");
}

// A disk that is full: the process may not make a file larger than this. What was begun takes no room from others.
TEST_F(Retain, AFullDiskLeavesWhatWasThereAndNothingHalf) {
  save("one");
  save("two");
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    (void)signal(SIGXFSZ, SIG_IGN);
    rlimit limit{10'000, RLIM_INFINITY};
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(1);
    RetainStore store(path_);
    std::string payload, error;
    if (store.load(&payload, &error) != Loaded::kWhole) _exit(2);
    if (store.save(std::string(100'000, 'x'), &error) || error.empty()) _exit(3);
    if (std::filesystem::exists(path_ + ".new")) _exit(4);
    limit.rlim_cur = RLIM_INFINITY;
    if (setrlimit(RLIMIT_FSIZE, &limit) != 0) _exit(5);
    _exit(store.save("three", &error) ? 0 : 6);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  std::string payload;
  EXPECT_EQ(found(&payload), Loaded::kWhole);
  EXPECT_EQ(payload, "three");
}

TEST(RetainRows, AreReadBackAndNothingElseIs) {
  const std::vector<RetainedRow> rows = {{"L", 0, {0, 1, 1}}, {"D", 100, {-32768, 32767}}, {"", 7, {}}};
  const std::string bytes = encode_rows(rows);
  std::vector<RetainedRow> read;
  ASSERT_TRUE(decode_rows(bytes, &read));
  EXPECT_EQ(read, rows);
  for (std::size_t cut = 0; cut < bytes.size(); ++cut) {
    EXPECT_FALSE(decode_rows(bytes.substr(0, cut), &read)) << cut;
    EXPECT_TRUE(read.empty());
  }
  EXPECT_FALSE(decode_rows(bytes + "x", &read));
  std::mt19937 chance(1);
  for (unsigned i = 0; i < 20000; ++i) {
    std::string noise = bytes;
    for (unsigned k = 0; k < 3; ++k) noise[chance() % noise.size()] = static_cast<char>(chance());
    (void)decode_rows(noise, &read);
  }
}

class RetainLadder : public Retain {
 protected:
  std::unique_ptr<LadderTask> task(const std::string& keys, const std::string& text = "LD SM400\nOUT M0\nEND\n") {
    put((folder_ / "own.il").string(), text);
    config_ = nc::test::parse_or_fail(nc::test::base_toml() + "[ladder]\nprogram = \"" + (folder_ / "own.il").string() +
                                      "\"\n" + keys);
    std::vector<ConfigError> errors;
    auto made = LadderTask::create(config_, &errors);
    EXPECT_NE(made, nullptr) << (errors.empty() ? "" : errors[0].text());
    return made;
  }
  static const RetainedRow* row(const std::vector<RetainedRow>& rows, const std::string& name) {
    for (const RetainedRow& each : rows)
      if (each.name == name) return &each;
    return nullptr;
  }
  Config config_;
};

TEST_F(RetainLadder, ComesBackByDeviceThoughTheRangeHasMoved) {
  const auto first = task("retain_counters = true\nretain_d = [100, 109]\n");
  std::vector<RetainedRow> rows = first->retained();
  ASSERT_NE(row(rows, "D"), nullptr);
  EXPECT_EQ(row(rows, "D")->first, 100u);
  EXPECT_EQ(row(rows, "D")->values.size(), 10u);
  ASSERT_NE(row(rows, "L"), nullptr);
  ASSERT_NE(row(rows, "C value"), nullptr);
  for (RetainedRow& each : rows)
    for (std::size_t i = 0; i < each.values.size(); ++i)
      each.values[i] = each.name == "L" || each.name.find("contact") != std::string::npos ? i % 2 : static_cast<int>(i + 1);
  first->restore(rows);
  EXPECT_EQ(first->retained(), rows);
  const auto second = task("retain_d = [105, 120]\n");  // without counters
  second->restore(rows);
  const std::vector<RetainedRow> now = second->retained();
  EXPECT_EQ(row(now, "C value"), nullptr);
  EXPECT_EQ(row(now, "L")->values, row(rows, "L")->values);
  ASSERT_EQ(row(now, "D")->values.size(), 16u);
  EXPECT_EQ(row(now, "D")->values[0], 6) << "D105";
  EXPECT_EQ(row(now, "D")->values[4], 10) << "D109";
  EXPECT_EQ(row(now, "D")->values[5], 0) << "D110 was not retained";
}

TEST_F(RetainLadder, RowsThatCannotBeAreLeftOut) {
  const auto made = task("retain_d = [0, 8191]\n");
  const auto before = made->retained();
  made->restore({{"D", 0xffffffffu, {1, 2, 3}}, {"nonsense", 0, {5}}, {"L", 2047, std::vector<std::int16_t>(100000, 0)}});
  EXPECT_EQ(made->retained(), before);
}

TEST_F(RetainLadder, TheScanLeavesACopyWhenItIsAsked) {
  const auto made = task("retain_d = [0, 0]\n", "LD SM400\nINC D0\nEND\n");
  std::vector<RetainedRow> rows;
  EXPECT_FALSE(made->take_retained(&rows));
  nc_outputs out[NC_MAX_SYSTEMS] = {};
  nc_inputs in[NC_MAX_SYSTEMS] = {};
  nc::hal::PointImage points;
  nc::hal::Feedback feedback;
  LadderStatus status;
  LadderRequests requests;
  LadderImage image{&config_.points, &points, &feedback, out, in, 1, &status, &requests, &config_.nc};
  made->scan(&image);
  EXPECT_FALSE(made->take_retained(&rows)) << "nobody had asked";
  made->want_retained();
  EXPECT_FALSE(made->take_retained(&rows));
  made->scan(&image);
  made->scan(&image);
  ASSERT_TRUE(made->take_retained(&rows));
  EXPECT_EQ(row(rows, "D")->values[0], 2) << "of the scan that was asked";
  EXPECT_FALSE(made->take_retained(&rows));
  made->restart();
  made->scan(&image);
  EXPECT_EQ(row(made->retained(), "D")->values[0], 4) << "a restart of the program keeps them";
}

}  // namespace
