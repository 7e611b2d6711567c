// SPDX-License-Identifier: Apache-2.0
// The shared-memory segment: who may create it, and what a reader refuses.
#include "runtime/share/segment.hpp"

#include <fcntl.h>
#include <grp.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include <thread>

#include "runtime/share/text.hpp"

namespace nc::rt::share {
namespace {

MachineBlock machine() {
  MachineBlock block{};
  set_text(&block.machine, "Test");
  set_text(&block.share, "test");
  block.system_count = 1;
  block.axis_count[0] = 2;
  set_text(&block.axis[0][0].name, "X");
  set_text(&block.axis[0][1].name, "Y");
  return block;
}

void set_alive(Segment* segment) {
  StatusBlock status{};
  status.system_count = 1;
  segment->status.store(status);
  segment->life = static_cast<std::uint32_t>(Life::kAlive);
}

class Share : public testing::Test {
 protected:
  void SetUp() override {
    name_ = "unit-" + std::to_string(getpid());
  }
  void TearDown() override { take_away(); }

  bool create(SegmentOwner* owner) {
    if (!owner->create(name_, false, true, machine(), &error_)) return false;
    set_alive(owner->get());
    return true;
  }
  // Puts a memory with these bytes in the place of the segment.
  void put(const void* data, std::size_t size) {
    take_away();
    std::string error;
    foreign_ = make_sealed_memory("unit", size, &error);
    ASSERT_GE(foreign_, 0) << error;
    ASSERT_EQ(pwrite(foreign_, data, size, 0), static_cast<ssize_t>(size));
    bool in_use = false;
    ASSERT_TRUE(door_.open(segment_path(name_), foreign_, false, &in_use, &error)) << error;
  }
  void take_away() {
    door_.close();
    if (foreign_ >= 0) close(foreign_);
    foreign_ = -1;
  }
  // The reason why a reader refuses the segment; "" if it accepts it.
  std::string refusal() {
    SegmentReader reader;
    std::string error;
    return reader.open(name_, &error) ? "" : error;
  }
  std::string name_, error_;
  Door door_;
  int foreign_ = -1;
};

TEST(ShareName, IsOneForFilesAndPartitions) {
  EXPECT_EQ(share_name("Sim mill"), "sim-mill");
  EXPECT_EQ(share_name("../etc/passwd"), "etc-passwd");
  EXPECT_EQ(share_name("Fräse *?[3]"), "fr-se-3");
  EXPECT_EQ(share_name(""), "machine");
  EXPECT_LE(share_name(std::string(1000, 'a')).size(), 48u);
  EXPECT_EQ(share_name(share_name("A  b--c ")), share_name("A  b--c "));
}

TEST(ShareText, IsCutAtACharacterAndAlwaysEnded) {
  Text<8> text;
  set_text(&text, "abcdefghij");
  EXPECT_EQ(text_of(text), "abcdefg");
  set_text(&text, "abcdef\xc3\xa4");  // the two bytes of a letter do not both fit
  EXPECT_EQ(text_of(text), "abcdef");
  EXPECT_TRUE(is_ended(text));
  text.fill('x');
  EXPECT_FALSE(is_ended(text));
  EXPECT_EQ(text_of(text).size(), 8u);
}

TEST_F(Share, ReaderSeesWhatTheOwnerWrote) {
  SegmentOwner owner;
  ASSERT_TRUE(create(&owner)) << error_;
  SegmentReader reader;
  ASSERT_TRUE(reader.open(name_, &error_)) << error_;
  StatusBlock block{};
  block.system_count = 1;
  block.scan = 77;
  block.alarm_count = 1;
  set_text(&block.alarm[0].code, "P62");
  owner.get()->status.store(block);
  StatusBlock got{};
  ASSERT_TRUE(reader.status(&got, &error_)) << error_;
  EXPECT_EQ(got.scan, 77u);
  EXPECT_EQ(text_of(got.alarm[0].code), "P62");
  EXPECT_FALSE(reader.owner_gone());
  owner.remove();
  EXPECT_TRUE(reader.owner_gone()) << "the goodbye is in the memory that the reader still has";
  EXPECT_NE(refusal().find("there is no control"), std::string::npos);
}

TEST_F(Share, SegmentOfALivingControlIsRefused) {
  SegmentOwner owner, second;
  ASSERT_TRUE(create(&owner)) << error_;
  EXPECT_FALSE(create(&second));
  EXPECT_NE(error_.find("belongs to a control that is running"), std::string::npos) << error_;
  SegmentReader reader;
  EXPECT_TRUE(reader.open(name_, &error_)) << "the first one is not harmed: " << error_;
}

TEST_F(Share, SegmentOfADeadProcessIsReplaced) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    SegmentOwner owner;
    std::string error;
    const char made = owner.create(name_, false, false, machine(), &error) ? 1 : 0;
    if (made != 0) set_alive(owner.get());
    if (write(ready[1], &made, 1) != 1) _exit(1);
    for (;;) pause();
  }
  char made = 0;
  ASSERT_EQ(read(ready[0], &made, 1), 1);
  ASSERT_EQ(made, 1);
  SegmentReader old;
  ASSERT_TRUE(old.open(name_, &error_)) << error_;
  EXPECT_FALSE(old.owner_gone());
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  close(ready[0]);
  close(ready[1]);
  EXPECT_TRUE(old.owner_gone());
  EXPECT_NE(refusal().find("there is no control"), std::string::npos) << "its name went with it: " << refusal();
  SegmentOwner owner;
  ASSERT_TRUE(create(&owner)) << error_;
  SegmentReader reader;
  ASSERT_TRUE(reader.open(name_, &error_)) << error_;
  EXPECT_FALSE(reader.owner_gone());
  EXPECT_NE(reader.get()->identity.created_ns, old.get()->identity.created_ns) << "the old one keeps its memory";
}

// A process with the descriptor can change all values, but it must not be able to shorten the memory: the next access of
// the control would be a bus error.
TEST_F(Share, NobodyCanMakeTheMemoryShorter) {
  SegmentOwner owner;
  ASSERT_TRUE(create(&owner)) << error_;
  int memory = -1;
  ASSERT_EQ(fetch_memory(segment_path(name_), &memory, &error_), Knock::kGiven) << error_;
  EXPECT_NE(ftruncate(memory, 0), 0);
  EXPECT_EQ(errno, EPERM);
  EXPECT_NE(ftruncate(memory, 1), 0);
  EXPECT_NE(ftruncate(memory, sizeof(Segment) + 1), 0);
  const std::string again = "/proc/self/fd/" + std::to_string(memory);
  EXPECT_LT(open(again.c_str(), O_RDWR | O_TRUNC | O_CLOEXEC), 0) << "nor by opening it again";
  EXPECT_NE(fcntl(memory, F_ADD_SEALS, F_SEAL_WRITE), 0);
  struct stat status {};
  ASSERT_EQ(fstat(memory, &status), 0);
  EXPECT_EQ(status.st_size, static_cast<off_t>(sizeof(Segment)));
  EXPECT_EQ(status.st_mode & 0777, 0600u);
  // A hole is no end of the memory: its bytes become zero, and reads and writes there still work.
  EXPECT_EQ(fallocate(memory, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, 0, sizeof(Segment)), 0);
  close(memory);
  EXPECT_NE(refusal(), "");
  owner.remove();
  ASSERT_TRUE(create(&owner)) << error_;
  StatusBlock got{};
  SegmentReader reader;
  ASSERT_TRUE(reader.open(name_, &error_)) << error_;
  EXPECT_TRUE(reader.status(&got, &error_)) << error_;
}

TEST_F(Share, MemoryThatCouldShrinkIsRefused) {
  foreign_ = memfd_create("unit", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  ASSERT_GE(foreign_, 0);
  ASSERT_EQ(ftruncate(foreign_, sizeof(Segment)), 0);
  bool in_use = false;
  ASSERT_TRUE(door_.open(segment_path(name_), foreign_, false, &in_use, &error_)) << error_;
  EXPECT_NE(refusal().find("no sealed memory"), std::string::npos) << refusal();
}

TEST_F(Share, AControlThatHangsIsNotWaitedForForEver) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    SegmentOwner owner;
    std::string error;
    const char made = owner.create(name_, false, false, machine(), &error) ? 1 : 0;
    if (write(ready[1], &made, 1) != 1) _exit(1);
    for (;;) pause();
  }
  char made = 0;
  ASSERT_EQ(read(ready[0], &made, 1), 1);
  kill(child, SIGSTOP);
  int status = 0;
  waitpid(child, &status, WUNTRACED);
  EXPECT_NE(refusal().find("hangs"), std::string::npos) << refusal();
  kill(child, SIGKILL);
  waitpid(child, &status, 0);
  close(ready[0]);
  close(ready[1]);
}

// The reason why a process of this user and group refuses the segment.
std::string refusal_of(uid_t user, gid_t group, const std::string& name) {
  int answer[2];
  if (pipe(answer) != 0) return "no pipe";
  const pid_t child = fork();
  if (child == 0) {
    std::string error = "no other user";
    SegmentReader reader;
    if (setgroups(0, nullptr) == 0 && setresgid(group, group, group) == 0 && setresuid(user, user, user) == 0) {
      error.clear();
      (void)reader.open(name, &error);
    }
    _exit(write(answer[1], error.data(), error.size()) == static_cast<ssize_t>(error.size()) ? 0 : 1);
  }
  close(answer[1]);
  std::string text(1000, '\0');
  const ssize_t got = read(answer[0], text.data(), text.size());
  text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  close(answer[0]);
  int status = 0;
  waitpid(child, &status, 0);
  return text;
}

TEST_F(Share, OtherUsersAreKeptOut) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can be somebody else";
  constexpr uid_t kOther = 65533, kGroup = 65532;
  SegmentOwner owner;
  ASSERT_TRUE(owner.create(name_, false, false, machine(), &error_)) << error_;
  set_alive(owner.get());
  EXPECT_NE(refusal_of(kOther, getegid(), name_).find("is not for this user"), std::string::npos);
  owner.remove();
  ASSERT_TRUE(owner.create(name_, true, false, machine(), &error_)) << error_;
  set_alive(owner.get());
  EXPECT_EQ(refusal_of(kOther, getegid(), name_), "") << "of the group";
  EXPECT_NE(refusal_of(kOther, kGroup, name_).find("is not for this user"), std::string::npos) << "of another group";
}

// A stranger who takes the name first is not taken for the control.
TEST_F(Share, AStrangerIsNotBelieved) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can be somebody else";
  constexpr uid_t kStranger = 65531, kOther = 65533;
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    SegmentOwner owner;
    std::string error;
    char made = 0;
    if (setgroups(0, nullptr) == 0 && setresgid(kStranger, kStranger, kStranger) == 0 &&
        setresuid(kStranger, kStranger, kStranger) == 0)
      made = owner.create(name_, true, false, machine(), &error) ? 1 : 0;
    if (write(ready[1], &made, 1) != 1) _exit(1);
    for (;;) pause();
  }
  char made = 0;
  EXPECT_EQ(read(ready[0], &made, 1), 1);
  EXPECT_EQ(made, 1);
  EXPECT_NE(refusal_of(kOther, kOther, name_).find("belongs to another user"), std::string::npos)
      << refusal_of(kOther, kOther, name_);
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  close(ready[0]);
  close(ready[1]);
}

// Readers that come and go, and those that connect and say nothing, do not keep the next one out.
TEST_F(Share, TheDoorStaysOpen) {
  SegmentOwner owner;
  ASSERT_TRUE(create(&owner)) << error_;
  for (unsigned i = 0; i < 200; ++i) {
    int memory = -1;
    ASSERT_EQ(fetch_memory(segment_path(name_), &memory, &error_), Knock::kGiven) << i << ": " << error_;
    close(memory);
  }
  EXPECT_EQ(refusal(), "");
}

TEST_F(Share, ForeignMemoryIsRefused) {
  put("hello", 5);
  EXPECT_NE(refusal().find("too short"), std::string::npos) << refusal();
  const std::string garbage(sizeof(Segment) + 100, '\x5a');
  put(garbage.data(), garbage.size());
  EXPECT_NE(refusal().find("is not a segment of ncrtd"), std::string::npos) << refusal();
  put(garbage.data(), 4096);
  EXPECT_NE(refusal().find("is not a segment of ncrtd"), std::string::npos) << refusal();
}

TEST_F(Share, OtherLayoutsAreRefused) {
  SegmentOwner owner;
  ASSERT_TRUE(create(&owner)) << error_;
  Segment& segment = *owner.get();
  const Identity good = segment.identity;
  segment.identity.layout_version = 9;
  EXPECT_NE(refusal().find("layout version 9"), std::string::npos) << refusal();
  segment.identity = good;
  segment.identity.layout_hash ^= 1;
  EXPECT_NE(refusal().find("another build"), std::string::npos) << refusal();
  segment.identity = good;
  segment.identity.size -= 64;
  EXPECT_NE(refusal().find("too short"), std::string::npos) << refusal();
  segment.identity = good;
  segment.machine.cycle_us ^= 1;
  EXPECT_NE(refusal().find("damaged"), std::string::npos) << refusal();
  segment.machine.cycle_us ^= 1;
  segment.life = static_cast<std::uint32_t>(Life::kMaking);
  EXPECT_NE(refusal().find("not complete"), std::string::npos) << refusal();
  segment.life = static_cast<std::uint32_t>(Life::kAlive);
  EXPECT_EQ(refusal(), "");
  // Nonsense is refused even if its check sum is right.
  segment.machine.axis_count[0] = 200;
  segment.check = check_sum(segment);
  EXPECT_NE(refusal().find("makes no sense"), std::string::npos) << refusal();
}

TEST_F(Share, SegmentCutAtAnyPlaceIsRefused) {
  std::string bytes;
  {
    SegmentOwner owner;
    ASSERT_TRUE(create(&owner)) << error_;
    bytes.assign(reinterpret_cast<const char*>(owner.get()), sizeof(Segment));
  }
  for (std::size_t size = 1; size < bytes.size(); size += size < 256 ? 1 : 4099) {
    put(bytes.data(), size);
    EXPECT_NE(refusal().find("too short"), std::string::npos) << size << ": " << refusal();
  }
  put(bytes.data(), bytes.size());
  EXPECT_EQ(refusal(), "");
}

TEST_F(Share, ValuesThatMakeNoSenseAreRefused) {
  SegmentOwner owner;
  ASSERT_TRUE(create(&owner)) << error_;
  SegmentReader reader;
  ASSERT_TRUE(reader.open(name_, &error_)) << error_;
  StatusBlock good{}, got{};
  good.system_count = 1;
  const auto refused = [&](const StatusBlock& block) {
    owner.get()->status.store(block);
    return !reader.status(&got, &error_) && error_.find("no sense") != std::string::npos;
  };
  EXPECT_FALSE(refused(good));
  StatusBlock bad = good;
  bad.alarm_count = kAlarms + 1;
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad.system_count = 3;
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad.forced_count = kForced + 1;
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad.forced_count = 1;
  bad.forced[0].device.fill('M');
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad.system[0].axis_count = NC_MAX_AXES + 1;
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad.system[0].refusal_text.fill('R');
  EXPECT_TRUE(refused(bad));
  bad = good;
  bad.system[0].block.fill('G');
  EXPECT_TRUE(refused(bad));
  HistoryBlock history{};
  std::uint64_t sequence = 0;
  history.last_sequence = 300;  // but there are no entries
  owner.get()->history.store(history);
  EXPECT_FALSE(reader.history(&history, &sequence, &error_));
  PointsBlock points{};
  points.count = hal::kMaxPoints + 1;
  owner.get()->points.store(points);
  EXPECT_FALSE(reader.points(&points, &error_));
}

TEST_F(Share, WriterThatDiedInTheMiddleIsSeen) {
  SegmentOwner owner;
  ASSERT_TRUE(create(&owner)) << error_;
  SegmentReader reader;
  ASSERT_TRUE(reader.open(name_, &error_)) << error_;
  // The sequence is the first word of the block: odd = in the middle.
  auto* sequence = reinterpret_cast<std::atomic<std::uint64_t>*>(&owner.get()->status);
  sequence->fetch_add(1);
  StatusBlock got{};
  EXPECT_FALSE(reader.status(&got, &error_));
  EXPECT_NE(error_.find("in the middle"), std::string::npos) << error_;
  StatusBlock next{};
  next.system_count = 1;
  owner.get()->status.store(next);  // the next write makes it complete again
  EXPECT_TRUE(reader.status(&got, &error_)) << error_;
}

TEST_F(Share, OneProcessGivesCommands) {
  SegmentOwner owner;
  ASSERT_TRUE(create(&owner)) << error_;
  SegmentReader reader;
  ASSERT_TRUE(reader.open(name_, &error_)) << error_;
  ASSERT_TRUE(reader.claim_commands(&error_)) << error_;
  const pid_t child = fork();
  if (child == 0) {
    SegmentReader second;
    std::string error;
    const bool refused = second.open(name_, &error) && !second.claim_commands(&error);
    _exit(refused ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  owner.get()->command_pid = child;  // dead by now
  EXPECT_TRUE(reader.claim_commands(&error_)) << error_;
  EXPECT_EQ(owner.get()->command_pid, getpid());
  reader.close();
  EXPECT_EQ(owner.get()->command_pid, 0);
}

// A gateway with new keys takes the place of another one of its process.
TEST_F(Share, ARightToCommandGoesOverWithinAProcess) {
  SegmentOwner owner;
  ASSERT_TRUE(create(&owner)) << error_;
  SegmentReader first, second;
  ASSERT_TRUE(first.open(name_, &error_)) << error_;
  ASSERT_TRUE(second.open(name_, &error_)) << error_;
  ASSERT_TRUE(first.claim_commands(&error_)) << error_;
  second.close();  // has no right, and takes none away
  EXPECT_EQ(owner.get()->command_pid, getpid());
  ASSERT_TRUE(second.open(name_, &error_)) << error_;
  second.take_claim_of(&first);
  first.close();
  EXPECT_EQ(owner.get()->command_pid, getpid());
  second.close();
  EXPECT_EQ(owner.get()->command_pid, 0);
}

TEST_F(Share, CommandsAreOffUnlessTheControlTakesThem) {
  SegmentOwner owner;
  ASSERT_TRUE(owner.create(name_, false, false, machine(), &error_)) << error_;
  set_alive(owner.get());
  SegmentReader reader;
  ASSERT_TRUE(reader.open(name_, &error_)) << error_;
  EXPECT_FALSE(reader.claim_commands(&error_));
  EXPECT_NE(error_.find("takes no commands"), std::string::npos) << error_;
  EXPECT_EQ(owner.get()->command_pid, 0);
}

TEST_F(Share, SegmentThatIsBeingMadeIsNotTakenForForeign) {
  put("", 0);
  EXPECT_NE(refusal().find("not complete"), std::string::npos) << refusal();
  const std::string zeros(sizeof(Segment), '\0');
  put(zeros.data(), zeros.size());
  EXPECT_NE(refusal().find("not complete"), std::string::npos) << refusal();
}

TEST(ShareHeartbeat, StandsStill) {
  HeartbeatWatch watch(100);
  EXPECT_TRUE(watch.alive(5, 1000));
  EXPECT_TRUE(watch.alive(5, 1099));
  EXPECT_FALSE(watch.alive(5, 1100));
  EXPECT_TRUE(watch.alive(6, 1101));
  EXPECT_FALSE(watch.alive(6, 5000));
  watch.restart();
  EXPECT_TRUE(watch.alive(6, 5000));
}

struct Numbers {
  std::uint64_t n[64];
};

TEST(ShareBlock, ReaderNeverSeesHalfAValue) {
  static SharedBlock<Numbers> block;
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    Numbers numbers{};
    for (std::uint64_t k = 1; !stop; ++k) {
      for (std::uint64_t& n : numbers.n) n = k;
      block.store(numbers);
      if (k % 64 == 0) std::this_thread::yield();
    }
  });
  std::uint64_t last = 0, sequence = 0;
  unsigned good = 0;
  for (unsigned i = 0; i < 20000; ++i) {
    Numbers numbers{};
    if (!block.load(&numbers, &sequence)) continue;
    ++good;
    for (const std::uint64_t n : numbers.n) ASSERT_EQ(n, numbers.n[0]);
    ASSERT_GE(numbers.n[0], last);
    last = numbers.n[0];
    ASSERT_EQ(sequence % 2, 0u);
  }
  stop = true;
  writer.join();
  EXPECT_GT(good, 0u);
}

TEST(ShareRing, KeepsOrderAndRefusesWhenFull) {
  static SharedRing<int, 8> ring;
  int value = 0;
  EXPECT_FALSE(ring.pop(&value));
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(ring.push(i));
  EXPECT_FALSE(ring.push(8));
  EXPECT_EQ(ring.size(), 8u);
  for (int i = 0; i < 8; ++i) {
    ASSERT_TRUE(ring.pop(&value));
    EXPECT_EQ(value, i);
  }
  EXPECT_FALSE(ring.pop(&value));
}

TEST(ShareRing, SurvivesIndicesThatCannotBe) {
  static SharedRing<int, 8> ring;
  int value = 0;
  ring.force(4000000000u, 5);
  EXPECT_FALSE(ring.pop(&value));
  EXPECT_FALSE(ring.pop(&value)) << "it is empty now, not full of garbage";
  EXPECT_TRUE(ring.push(42));
  EXPECT_TRUE(ring.pop(&value));
  EXPECT_EQ(value, 42);
  ring.force(3, 0xfffffffeu);  // five elements across the wrap of the indices
  EXPECT_EQ(ring.size(), 5u);
  for (unsigned i = 0; i < 5; ++i) EXPECT_TRUE(ring.pop(&value));
  EXPECT_FALSE(ring.pop(&value));
}

TEST(ShareRing, TwoThreadsExchangeEverything) {
  static SharedRing<std::uint64_t, 16> ring;
  constexpr std::uint64_t kCount = 20000;
  std::thread producer([] {
    for (std::uint64_t k = 1; k <= kCount;)
      if (ring.push(k)) ++k;
      else std::this_thread::yield();
  });
  for (std::uint64_t k = 1; k <= kCount;) {
    std::uint64_t value = 0;
    if (!ring.pop(&value)) {
      std::this_thread::yield();
      continue;
    }
    ASSERT_EQ(value, k);
    ++k;
  }
  producer.join();
}

}  // namespace
}  // namespace nc::rt::share
