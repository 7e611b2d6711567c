// SPDX-License-Identifier: Apache-2.0
// The folder of programs as a service.
#include "runtime/services/program_store.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <thread>

namespace nc::rt::services {
namespace {

class Store : public testing::Test {
 protected:
  void SetUp() override {
    char pattern[] = "/tmp/nc-store-XXXXXX";
    ASSERT_NE(mkdtemp(pattern), nullptr);
    folder_ = pattern;
    store_ = std::make_unique<ProgramStore>(folder_, StoreLimits{1000, 2500, 100}, [this](const ProgramStore::Names&) { return use_; });
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static Call call(Service service, std::initializer_list<std::pair<Field, std::string>> texts, std::initializer_list<std::pair<Field, double>> numbers = {}) {
    Call made;
    made.row = &row_of(service);
    for (const auto& [field, text] : texts) {
      made.given.set(static_cast<unsigned>(field));
      made.text[static_cast<unsigned>(field)] = text;
    }
    for (const auto& [field, number] : numbers) {
      made.given.set(static_cast<unsigned>(field));
      made.number[static_cast<unsigned>(field)] = number;
    }
    return made;
  }
  static std::string hash(const std::string& bytes) {
    Sha256 sum;
    sum.add(bytes);
    return sum.finish();
  }
  Outcome begin(const std::string& name, const std::string& text, bool replace = false, std::uint64_t session = 1) {
    const Outcome outcome = store_->begin(session, call(Service::kProgramBegin, {{Field::kFile, name}, {Field::kHash, hash(text)}},
                                                        {{Field::kSize, static_cast<double>(text.size())}, {Field::kReplace, replace ? 1.0 : 0.0}}));
    if (outcome.ok) upload_ = outcome.reply["upload"].get<double>();
    return outcome;
  }
  Outcome data(const std::string& bytes, std::size_t at, std::uint64_t session = 1) {
    return store_->data(session, call(Service::kProgramData, {{Field::kData, bytes}}, {{Field::kUpload, upload_}, {Field::kBegin, static_cast<double>(at)}}));
  }
  Outcome finish(std::uint64_t session = 1) {
    std::string name;
    return store_->finish(session, call(Service::kProgramFinish, {}, {{Field::kUpload, upload_}}), &name);
  }
  Outcome put(const std::string& name, const std::string& text, bool replace = false) {
    Outcome outcome = begin(name, text, replace);
    for (std::size_t at = 0; outcome.ok && at < text.size(); at += 7) outcome = data(text.substr(at, 7), at);
    return outcome.ok ? finish() : outcome;
  }
  Outcome named(Outcome (ProgramStore::*what)(const Call&), Service service, const std::string& name, double on = 0) {
    return (store_.get()->*what)(call(service, {{Field::kFile, name}}, {{Field::kOn, on}}));
  }
  Outcome remove(const std::string& name) { return named(&ProgramStore::remove, Service::kProgramDelete, name); }
  Outcome rename(const std::string& name, const std::string& to) { return store_->rename(call(Service::kProgramRename, {{Field::kFile, name}, {Field::kNewName, to}})); }
  std::string content(const std::string& name) const {
    std::ifstream in(folder_ + "/" + name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  std::size_t files() const { return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {})); }

  std::string folder_;
  ProgramStore::Use use_;
  std::unique_ptr<ProgramStore> store_;
  double upload_ = 0;
};

// Digits of both cases are the same digest; what is none is refused before a byte of the program is sent.
TEST_F(Store, TheDigestIsLookedAtBeforeTheFirstPiece) {
  const std::string text = "G0 X0\nM30\n";
  const auto with = [this, &text](const std::string& digest) {
    const Outcome outcome = store_->begin(1, call(Service::kProgramBegin, {{Field::kFile, "a.nc"}, {Field::kHash, digest}}, {{Field::kSize, static_cast<double>(text.size())}}));
    if (outcome.ok) upload_ = outcome.reply["upload"].get<double>();
    return outcome;
  };
  const std::string right = hash(text);
  for (const std::string& wrong : {std::string(64, 'z'), right.substr(1), right + "0", std::string("0x") + right.substr(2)}) {
    const Outcome outcome = with(wrong);
    EXPECT_FALSE(outcome.ok) << wrong;
    EXPECT_EQ(outcome.why, Refused::kMalformed) << wrong;
  }
  std::string capitals = right;
  for (char& c : capitals) c = c >= 'a' && c <= 'f' ? static_cast<char>(c - 'a' + 'A') : c;
  ASSERT_TRUE(with(capitals).ok);
  ASSERT_TRUE(data(text, 0).ok);
  EXPECT_TRUE(finish().ok);
  EXPECT_EQ(content("a.nc"), text);
}

TEST_F(Store, WritesAndReadsAProgram) {
  const std::string text = "G0 X1.\nM30\n%\xff";
  ASSERT_TRUE(put("part.nc", text).ok);
  EXPECT_EQ(content("part.nc"), text);
  EXPECT_EQ(files(), 1u);
  std::string bytes;
  const Outcome read = store_->read(call(Service::kProgramRead, {{Field::kFile, "part.nc"}}, {{Field::kBegin, 3}, {Field::kBytes, 4}}));
  ASSERT_TRUE(from_base64(read.reply["data"].get<std::string>(), &bytes));
  EXPECT_EQ(bytes, text.substr(3, 4));
  EXPECT_EQ(read.reply["size"], text.size());
  const Outcome list = store_->list(call(Service::kPrograms, {}));
  ASSERT_EQ(list.reply["programs"].size(), 1u);
  EXPECT_EQ(list.reply["programs"][0]["name"], "part.nc");
  EXPECT_EQ(list.reply["bytes"], text.size());
}

TEST_F(Store, NobodySeesAHalfOfAProgram) {
  ASSERT_TRUE(begin("part.nc", "0123456789").ok);
  ASSERT_TRUE(data("01234", 0).ok);
  EXPECT_TRUE(store_->list(call(Service::kPrograms, {})).reply["programs"].empty());
  EXPECT_EQ(finish().why, Refused::kMalformed) << "five bytes are missing";
  EXPECT_EQ(data("01234", 0).why, Refused::kMalformed) << "the piece that comes next begins at 5";
  EXPECT_EQ(data("567890", 5).why, Refused::kMalformed) << "more than the size";
  EXPECT_EQ(data("56789", 5, 2).why, Refused::kNotFound) << "an upload belongs to its connection";
  ASSERT_TRUE(data("56788", 5).ok);
  EXPECT_EQ(finish().why, Refused::kMalformed) << "the hash is another one";
  EXPECT_EQ(files(), 0u);
}

TEST_F(Store, WhatAClientHasBegunEndsWithIt) {
  ASSERT_TRUE(begin("a.nc", "abc", false, 1).ok);
  ASSERT_TRUE(begin("b.nc", "abc", false, 2).ok);
  EXPECT_EQ(files(), 2u);
  store_->abandon_all(1);
  EXPECT_EQ(files(), 1u);
  ASSERT_TRUE(data("abc", 0, 2).ok);
  ASSERT_TRUE(finish(2).ok);
  EXPECT_EQ(content("b.nc"), "abc");
  std::ofstream(folder_ + "/.nc-upload-1-1") << "left behind by a process that was killed";
  store_->clean();
  EXPECT_EQ(files(), 1u);
}

TEST_F(Store, WhoIsSilentMakesRoom) {
  StoreLimits limits{1000, 2500, 100};
  limits.silence = std::chrono::milliseconds(0);
  store_ = std::make_unique<ProgramStore>(folder_, limits, [](const ProgramStore::Names&) { return ProgramStore::Use{}; });
  for (unsigned n = 0; n < 2 * ProgramStore::kUploads; ++n) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    ASSERT_TRUE(begin("a" + std::to_string(n) + ".nc", std::string(1000, 'x')).ok) << n;
    EXPECT_EQ(files(), 1u) << "and what it had taken of the disk";
  }
  ASSERT_TRUE(data(std::string(1000, 'x'), 0).ok);
  ASSERT_TRUE(finish().ok);
}

TEST_F(Store, SizesAreBounded) {
  EXPECT_EQ(begin("large.nc", std::string(1001, 'x')).why, Refused::kNoSpace);
  ASSERT_TRUE(put("a.nc", std::string(1000, 'x')).ok);
  ASSERT_TRUE(put("b.nc", std::string(1000, 'x')).ok);
  EXPECT_EQ(begin("c.nc", std::string(501, 'x')).why, Refused::kNoSpace);
  ASSERT_TRUE(begin("c.nc", std::string(300, 'x')).ok);
  EXPECT_EQ(begin("d.nc", std::string(300, 'x')).why, Refused::kNoSpace) << "what is being written counts";
  ASSERT_TRUE(begin("d.nc", "1").ok);
  ASSERT_TRUE(begin("e.nc", "1").ok);
  ASSERT_TRUE(begin("f.nc", "1").ok);
  EXPECT_EQ(begin("g.nc", "1").why, Refused::kBusy);
}

TEST_F(Store, TenGigabytesAreRefusedAndTwoArePossible) {
  ProgramStore store(folder_, {std::uint64_t{4096} << 20, std::uint64_t{16384} << 20, 16 << 20}, [this](const ProgramStore::Names&) { return use_; });
  const auto begin_size = [&](double size) { return store.begin(1, call(Service::kProgramBegin, {{Field::kFile, "huge.nc"}, {Field::kHash, std::string(64, '0')}}, {{Field::kSize, size}})); };
  EXPECT_EQ(begin_size(10e9).why, Refused::kNoSpace);
  EXPECT_EQ(files(), 0u);
  const Outcome two = begin_size(2e9);  // on a small disk it may be refused for that reason only
  EXPECT_TRUE(two.ok || two.text.find("disk is full") != std::string::npos) << two.text;
}

TEST_F(Store, AnExistingProgramIsReplacedOnlyWhenThatIsAsked) {
  ASSERT_TRUE(put("part.nc", "one").ok);
  EXPECT_EQ(put("part.nc", "two").why, Refused::kProtected);
  EXPECT_EQ(content("part.nc"), "one");
  ASSERT_TRUE(put("part.nc", "two", true).ok);
  EXPECT_EQ(content("part.nc"), "two");
  ASSERT_TRUE(begin("new.nc", "mine").ok);
  std::ofstream(folder_ + "/new.nc") << "that of somebody who was faster";
  ASSERT_TRUE(data("mine", 0).ok);
  EXPECT_EQ(finish().why, Refused::kProtected);
  EXPECT_EQ(content("new.nc"), "that of somebody who was faster");
}

TEST_F(Store, RenamesAndDeletes) {
  ASSERT_TRUE(put("a.nc", "a").ok);
  ASSERT_TRUE(put("b.nc", "b").ok);
  EXPECT_EQ(rename("a.nc", "b.nc").why, Refused::kProtected);
  EXPECT_EQ(content("b.nc"), "b");
  EXPECT_TRUE(rename("a.nc", "c.nc").ok);
  EXPECT_EQ(rename("a.nc", "d.nc").why, Refused::kNotFound);
  EXPECT_EQ(remove("a.nc").why, Refused::kNotFound);
  EXPECT_TRUE(remove("c.nc").ok);
  EXPECT_EQ(files(), 1u);
}

TEST_F(Store, AProtectedProgramIsNotChanged) {
  ASSERT_TRUE(put("O9000", "a").ok);
  ASSERT_TRUE(named(&ProgramStore::protect, Service::kProgramProtect, "O9000", 1).ok);
  EXPECT_EQ(store_->list(call(Service::kPrograms, {})).reply["programs"][0]["protected"], true);
  EXPECT_EQ(remove("O9000").why, Refused::kProtected);
  EXPECT_EQ(rename("O9000", "b").why, Refused::kProtected);
  EXPECT_EQ(put("O9000", "b", true).why, Refused::kProtected);
  ASSERT_TRUE(named(&ProgramStore::protect, Service::kProgramProtect, "O9000", 0).ok);
  EXPECT_TRUE(remove("O9000").ok);
  ASSERT_TRUE(put("O8000", "a").ok);
  use_.locked = {"O8000"};
  EXPECT_EQ(remove("O8000").why, Refused::kProtected) << "a parameter of the control protects it";
}

// A parameter protects a number, so nobody brings in a program with it, either.
TEST_F(Store, AProtectedNumberIsNotGiven) {
  ASSERT_TRUE(put("a.nc", "a").ok);
  ASSERT_TRUE(begin("late.nc", "b").ok);
  use_.locked = {"O9001.nc", "late.nc"};
  EXPECT_EQ(put("O9001.nc", "b").why, Refused::kProtected);
  EXPECT_EQ(rename("a.nc", "O9001.nc").why, Refused::kProtected);
  ASSERT_TRUE(data("b", 0).ok);
  EXPECT_EQ(finish().why, Refused::kProtected) << "the parameter was set meanwhile";
  use_.known = false;
  EXPECT_EQ(remove("a.nc").why, Refused::kFailed);
  EXPECT_EQ(files(), 1u);
}

TEST_F(Store, WhatRunsStays) {
  ASSERT_TRUE(put("run.nc", "a").ok);
  ASSERT_TRUE(put("other.nc", "a").ok);
  ASSERT_TRUE(put("long.nc", std::string(200, 'x')).ok);
  use_.selected = {"run.nc"};
  use_.active = true;
  EXPECT_EQ(remove("run.nc").why, Refused::kProtected);
  EXPECT_EQ(rename("run.nc", "x.nc").why, Refused::kProtected);
  EXPECT_EQ(put("run.nc", "b", true).why, Refused::kProtected);
  EXPECT_EQ(remove("long.nc").why, Refused::kProtected) << "it may run from its file";
  EXPECT_TRUE(remove("other.nc").ok);
  use_.active = false;
  EXPECT_TRUE(put("run.nc", "b", true).ok);
  EXPECT_TRUE(remove("long.nc").ok);
}

TEST_F(Store, LinksAndFoldersAreNoPrograms) {
  const std::string outside = folder_ + "-outside";
  std::ofstream(outside) << "secret";
  std::filesystem::create_symlink(outside, folder_ + "/link.nc");
  std::filesystem::create_directory(folder_ + "/sub");
  ASSERT_EQ(mkfifo((folder_ + "/pipe.nc").c_str(), 0600), 0);
  EXPECT_TRUE(store_->list(call(Service::kPrograms, {})).reply["programs"].empty());
  for (const char* name : {"link.nc", "sub", "pipe.nc"}) {
    EXPECT_FALSE(store_->read(call(Service::kProgramRead, {{Field::kFile, name}}, {{Field::kBegin, 0}, {Field::kBytes, 4}})).ok) << name;
    EXPECT_EQ(remove(name).why, Refused::kProtected) << name;
    EXPECT_EQ(put(name, "x", true).why, Refused::kProtected) << name;
    EXPECT_FALSE(named(&ProgramStore::protect, Service::kProgramProtect, name, 1).ok) << name;
  }
  EXPECT_TRUE(std::filesystem::exists(outside));
  std::filesystem::remove(outside);
}

TEST_F(Store, AFolderThatIsGoneIsSaid) {
  std::filesystem::remove_all(folder_);
  EXPECT_EQ(begin("a.nc", "abc").why, Refused::kNotFound);
  EXPECT_EQ(store_->list(call(Service::kPrograms, {})).why, Refused::kNotFound);
  EXPECT_EQ(remove("a.nc").why, Refused::kNotFound);
}

// A file system of its own with 64 KiB, in a process of its own, because that hides folders from all threads.
int with_small_disk(const std::string& folder, int (*what)(const std::string& folder)) {
  const pid_t child = fork();
  if (child == 0) {
    constexpr int kCannot = 77;
    if (unshare(CLONE_NEWNS) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) _exit(kCannot);
    (void)mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr);
    if (mount("tmpfs", folder.c_str(), "tmpfs", 0, "size=64k") != 0) _exit(kCannot);
    _exit(what(folder));
  }
  int status = 0;
  return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

class FullDisk : public Store {
 public:
  void TestBody() override {}
  // The number of the first thing that is not as it should be; 0 = none.
  int run(const std::string& folder) {
    folder_ = folder;
    store_ = std::make_unique<ProgramStore>(folder_, StoreLimits{1 << 20, 1 << 20, 100}, [this](const ProgramStore::Names&) { return use_; });
    const std::string old(30'000, 'a');
    if (!put("old.nc", old).ok) return 1;
    // It is told before a byte has been sent, and nothing of it stays; what was there is there.
    Outcome outcome = begin("new.nc", std::string(100'000, 'b'));
    if (outcome.why != Refused::kNoSpace || outcome.text.find("full") == std::string::npos) return 2;
    outcome = begin("old.nc", std::string(100'000, 'b'), true);
    if (outcome.why != Refused::kNoSpace || content("old.nc") != old || files() != 1) return 3;
    // What was begun has its room, whatever else comes.
    const std::string small(8'000, 'c');
    if (!begin("small.nc", small).ok) return 4;
    std::ofstream(folder_ + "/other", std::ios::binary) << std::string(100'000, 'x');
    if (!data(small, 0).ok || !finish().ok || content("small.nc") != small) return 5;
    if (begin("more.nc", std::string(4'096, 'd')).why != Refused::kNoSpace || content("old.nc") != old) return 6;
    // With room again it goes on.
    std::filesystem::remove(folder_ + "/other");
    return put("more.nc", std::string(500, 'd')).ok && content("old.nc") == old ? 0 : 7;
  }
};

TEST_F(Store, AFullDiskIsToldBeforeAnythingIsSent) {
  const int result = with_small_disk(folder_, [](const std::string& folder) { return FullDisk().run(folder); });
  if (result == 77) GTEST_SKIP() << "no file system can be mounted here";
  EXPECT_EQ(result, 0);
}

// A call finds the exact name before one with an ending, and others by their number: a new file is not put in front of what was checked.
TEST_F(Store, NothingIsPutInFrontOfACalledProgram) {
  use_.active = true;
  use_.selected = {"main.nc"};
  use_.called = {"O2000.nc", "Part.nc"};
  for (const char* name : {"O2000", "o2000.a.nc", "O02000.nc", "part.NC"}) EXPECT_EQ(begin(name, "M99").why, Refused::kProtected) << name;
  EXPECT_TRUE(begin("O2001.nc", "M99").ok);
  EXPECT_EQ(store_->rename(call(Service::kProgramRename, {{Field::kFile, "other.nc"}, {Field::kNewName, "O2000"}})).why, Refused::kProtected);
  ASSERT_TRUE(data("M99", 0).ok);
  ASSERT_TRUE(finish().ok);
  EXPECT_EQ(store_->rename(call(Service::kProgramRename, {{Field::kFile, "O2001.nc"}, {Field::kNewName, "O2000"}})).why, Refused::kProtected);
  use_.active = false;
  EXPECT_TRUE(store_->rename(call(Service::kProgramRename, {{Field::kFile, "O2001.nc"}, {Field::kNewName, "O2000"}})).ok);
}

}  // namespace
}  // namespace nc::rt::services
