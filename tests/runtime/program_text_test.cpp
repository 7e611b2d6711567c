// SPDX-License-Identifier: Apache-2.0
// The text of a program while somebody writes into its file: it stays wholly what it was, or an error says that it did not. And its encodings.
#include "runtime/programs/program_text.hpp"

#include <fcntl.h>
#include <grp.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <thread>

#include "nc/control.h"

namespace nc::rt {
namespace {

constexpr std::uint64_t kWatched = 0;  // copy_bytes: nothing is copied

class ProgramTextTest : public testing::TestWithParam<std::uint64_t> {
 protected:
  void SetUp() override {
    char pattern[] = "/tmp/nc-program-XXXXXX";
    ASSERT_NE(mkdtemp(pattern), nullptr);
    folder_ = pattern;
    path_ = folder_ + "/part.nc";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  // A program in which every line names its version.
  static std::string version(unsigned number, std::size_t bytes) {
    std::string text;
    while (text.size() < bytes) text += "G1 X1.000 Y2.000 (VERSION " + std::to_string(number % 10) + ")\n";
    return text;
  }
  void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }
  std::shared_ptr<ProgramText> open(Encoding encoding = Encoding::kUtf8) {
    ProgramText::Options options;
    options.copy_bytes = GetParam();
    options.encoding = encoding;
    return ProgramText::open_file(path_, options, &error_);
  }
  static std::string all_of(ProgramText* text, long* failure = nullptr, std::size_t piece = 1000) {
    std::string all, buffer(piece, 0);
    for (long got = 1; got > 0;) {
      got = text->read(all.size(), buffer.data(), piece);
      if (got > 0) all.append(buffer, 0, static_cast<std::size_t>(got));
      if (failure != nullptr) *failure = got;
    }
    return all;
  }
  std::string folder_, path_, error_;
};
INSTANTIATE_TEST_SUITE_P(CopiedAndWatched, ProgramTextTest, testing::Values(std::uint64_t{16} << 20, kWatched));

TEST_P(ProgramTextTest, GivesWhatIsInTheFile) {
  for (const std::size_t bytes : {0, 1, 500, 65536, 65537, 300000}) {
    const std::string text = version(1, bytes);
    write(text);
    const auto program = open();
    ASSERT_NE(program, nullptr) << error_;
    EXPECT_EQ(program->size(), text.size());
    EXPECT_EQ(program->copied(), text.size() <= GetParam());
    EXPECT_EQ(all_of(program.get()), text);
    EXPECT_EQ(all_of(program.get(), nullptr, 200000), text);
  }
}

struct Change {
  const char* name;
  std::function<void(const std::string& path, const std::string& other)> make;
};
const Change kChanges[] = {
    {"cp", [](const std::string& path, const std::string& other) { std::ofstream(path, std::ios::binary) << other; }},
    {"in place, with the old time",
     [](const std::string& path, const std::string& other) {
       const auto time = std::filesystem::last_write_time(path);
       std::fstream(path, std::ios::binary | std::ios::in | std::ios::out) << other;
       std::filesystem::last_write_time(path, time);
     }},
    {"rename over",
     [](const std::string& path, const std::string& other) {
       std::ofstream(path + "~", std::ios::binary) << other;
       std::filesystem::rename(path + "~", path);
     }},
    {"delete", [](const std::string& path, const std::string&) { std::filesystem::remove(path); }},
    {"append", [](const std::string& path, const std::string& other) { std::ofstream(path, std::ios::binary | std::ios::app) << other; }},
    {"truncate", [](const std::string& path, const std::string&) { std::filesystem::resize_file(path, 70000); }},
    {"truncate to nothing", [](const std::string& path, const std::string&) { std::filesystem::resize_file(path, 0); }},
};

TEST_P(ProgramTextTest, NothingOfAChangedFileIsGivenOut) {
  const std::string old = version(1, 400000), other = version(2, 400000);
  for (const Change& change : kChanges) {
    for (const std::size_t before : {std::size_t{0}, std::size_t{100000}, std::size_t{399000}}) {
      write(old);
      const auto program = open();
      ASSERT_NE(program, nullptr) << error_;
      std::string head(before, 0), again(1000, 0);
      EXPECT_EQ(program->read(0, head.data(), before), static_cast<long>(before));
      change.make(path_, other);
      long failure = 0;
      const std::string seen = all_of(program.get(), &failure);
      EXPECT_EQ(old.compare(0, seen.size(), seen), 0) << change.name;
      if (program->copied()) {
        EXPECT_EQ(seen, old) << change.name;
        continue;
      }
      EXPECT_EQ(failure, NC_READ_CHANGED) << change.name << " " << before;
      EXPECT_EQ(program->read(350000, again.data(), again.size()), NC_READ_CHANGED) << change.name << ": once changed, always changed";
    }
  }
}

TEST_P(ProgramTextTest, SelectingAgainTakesTheNewOne) {
  write(version(1, 1000));
  const auto before = open();
  write(version(2, 2000));
  const auto after = open();
  ASSERT_NE(after, nullptr) << error_;
  EXPECT_EQ(all_of(after.get()), version(2, 2000));
  if (before->copied()) {
    EXPECT_EQ(all_of(before.get()), version(1, 1000));
  }
}

TEST_P(ProgramTextTest, AFileThatIsBeingWrittenIsNotTaken) {
  write(version(1, 1000));
  const int writer = ::open(path_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  ASSERT_GE(writer, 0);
  ProgramText::Options options;
  options.copy_bytes = GetParam();
  options.patience = std::chrono::milliseconds(60);
  EXPECT_EQ(ProgramText::open_file(path_, options, &error_), nullptr);
  EXPECT_NE(error_.find("is being written"), std::string::npos) << error_;
  close(writer);
  EXPECT_NE(open(), nullptr) << error_;
}

// Runs `action` as another user, without capabilities; returns its result, or false if it could not become another user.
bool as_another_user(const std::function<bool()>& action) {
  constexpr uid_t kOther = 65534;
  const pid_t child = fork();
  if (child == 0) {
    const bool other = setgroups(0, nullptr) == 0 && setresgid(kOther, kOther, kOther) == 0 && setresuid(kOther, kOther, kOther) == 0;
    _exit(other && action() ? 0 : 1);
  }
  int status = 1;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

// Only the owner of a file, and a process with CAP_LEASE, can find out that it is open for writing. For others it must have been unchanged for
// some time.
TEST_P(ProgramTextTest, AWriterOfAnotherUserMayPause) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can be somebody else";
  ASSERT_EQ(chmod(folder_.c_str(), 0755), 0);
  const auto opens = [this](std::chrono::milliseconds patience) {
    return as_another_user([&] {
      ProgramText::Options options;
      options.copy_bytes = GetParam();
      options.patience = patience;
      return ProgramText::open_file(path_, options, &error_) != nullptr;
    });
  };
  const std::string text = version(1, 2000);
  const int writer = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  ASSERT_GE(writer, 0);
  ASSERT_EQ(::write(writer, text.data(), 1000), 1000);  // and then it pauses
  EXPECT_FALSE(opens(10 * ProgramText::kQuiet)) << "half of a program";
  ASSERT_EQ(::write(writer, text.data() + 1000, 1000), 1000);
  close(writer);
  EXPECT_TRUE(opens(std::chrono::seconds(30))) << "left alone for long enough";
}

// Somebody rewrites the file at any moment, in all the ways in which files are rewritten; every reader sees one complete version, or an error.
TEST_P(ProgramTextTest, PropertyNeverAMixture) {
  constexpr std::size_t kBytes = 200000;
  write(version(0, kBytes));
  std::atomic<bool> done{false};
  std::thread writer([&] {
    std::mt19937 random(7);
    for (unsigned number = 1; !done.load(); ++number) {
      const std::string text = version(number, kBytes);
      const unsigned way = random() % 3;
      const std::string target = way == 2 ? path_ + "~" : path_;
      const int file = ::open(target.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | (way == 0 ? O_TRUNC : 0), 0600);
      for (std::size_t at = 0; at < text.size();) {
        const std::size_t length = std::min<std::size_t>(1 + random() % 60000, text.size() - at);
        if (::write(file, text.data() + at, length) != static_cast<ssize_t>(length)) break;
        at += length;
        if (random() % 3 == 0) std::this_thread::sleep_for(std::chrono::microseconds(random() % 40000));
      }
      close(file);
      if (way == 2) std::filesystem::rename(target, path_);
      std::this_thread::sleep_for(std::chrono::milliseconds(random() % 120));
    }
  });
  unsigned whole = 0, refused = 0, changed = 0;
  std::mt19937 random(11);
  for (int i = 0; i < 60; ++i) {
    const auto program = open();
    if (program == nullptr) {
      ++refused;
      continue;
    }
    std::string seen, buffer(20000, 0);
    long got = 1;
    while (got > 0) {
      got = program->read(seen.size(), buffer.data(), 1 + random() % buffer.size());
      if (got > 0) seen.append(buffer, 0, static_cast<std::size_t>(got));
      if (random() % 4 == 0) std::this_thread::sleep_for(std::chrono::microseconds(random() % 3000));
    }
    const std::size_t mark = seen.find("VERSION ");
    const unsigned number = mark == std::string::npos ? 0 : static_cast<unsigned>(seen[mark + 8] - '0');
    const std::string expected = version(number, kBytes);
    EXPECT_EQ(expected.compare(0, seen.size(), seen), 0) << "a mixture";
    if (got == 0) {
      EXPECT_EQ(seen.size(), expected.size()) << "part of a program";
      ++whole;
    } else {
      EXPECT_EQ(got, NC_READ_CHANGED);
      ++changed;
    }
  }
  done = true;
  writer.join();
  EXPECT_GT(whole, 5u) << refused << " refused, " << changed << " changed";
  if (GetParam() != 0) {
    EXPECT_EQ(changed, 0u);
  }
}

// A file that has been left alone for long is read once, so its times alone tell that somebody has written into it meanwhile: its last line and its first one, at once.
TEST_P(ProgramTextTest, PropertyNoMixtureOfAnOldFile) {
  constexpr std::size_t kBytes = 6'000'000;
  constexpr unsigned kFiles = 16;
  const std::string before = version(1, kBytes), line = version(2, 1);
  std::string behind = before;
  behind.replace(0, line.size(), line).replace(behind.size() - line.size(), line.size(), line);
  for (unsigned i = 0; i < kFiles; ++i) std::ofstream(path_ + std::to_string(i), std::ios::binary) << before;
  std::this_thread::sleep_for(ProgramText::kCoarse + std::chrono::milliseconds(100));
  const std::string folder = path_;
  std::mt19937 random(13);
  unsigned taken = 0;
  for (unsigned i = 0; i < kFiles; ++i) {
    path_ = folder + std::to_string(i);
    const auto later = std::chrono::microseconds(random() % 4000);
    std::thread writer([&] {
      std::this_thread::sleep_for(later);
      const int file = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
      EXPECT_EQ(pwrite(file, line.data(), line.size(), static_cast<off_t>(behind.size() - line.size())), static_cast<ssize_t>(line.size()));
      EXPECT_EQ(pwrite(file, line.data(), line.size(), 0), static_cast<ssize_t>(line.size()));
      close(file);
    });
    const auto program = open();
    const std::string seen = program == nullptr ? "" : all_of(program.get(), nullptr, 1'000'000);
    writer.join();
    if (program == nullptr || (GetParam() == kWatched && seen.size() < kBytes)) continue;  // refused, or found to be changed later
    ++taken;
    EXPECT_TRUE(seen == before || seen == behind) << "a mixture";
  }
  if (GetParam() != kWatched) {
    EXPECT_GT(taken, kFiles / 2);
  }
}

// ---- encodings ----

TEST_P(ProgramTextTest, Latin1) {
  write("(FR\xC4SER \xD8" "20)\nG0 X1.\n");
  EXPECT_EQ(all_of(open(Encoding::kLatin1).get()), "(FR\u00c4SER \u00d8" "20)\nG0 X1.\n");
}

TEST_P(ProgramTextTest, ShiftJis) {
  // "kako" (processing), and characters whose second byte is a backslash, a bracket, a letter.
  write("(\x89\xC1\x8D\x48 \x95\x5C \x83\x5B \x83\x5D \x8D\x58)\nG0 X1.\n");
  EXPECT_EQ(all_of(open(Encoding::kShiftJis).get()), "(\u52a0\u5de5 \u8868 \u30bc \u30be \u66f4)\nG0 X1.\n");
}

TEST_P(ProgramTextTest, UndecodableBytes) {
  write("(\x81" "1 \xFF)\nX1\n");  // a lead byte without a second byte, and a byte that is no character
  EXPECT_EQ(all_of(open(Encoding::kShiftJis).get()), "(\ufffd" "1 \ufffd)\nX1\n");
  write("(\xC4 \xE2\x82)\nX1\n");
  const std::string seen = all_of(open().get());
  EXPECT_EQ(valid_utf8(seen), "(\ufffd \ufffd\ufffd)\nX1\n");
}

// Characters whose bytes lie in two of the parts in which a large file is read.
TEST_P(ProgramTextTest, ConvertedAcrossParts) {
  for (const Encoding encoding : {Encoding::kLatin1, Encoding::kShiftJis}) {
    for (std::size_t before = 65530; before < 65540; ++before) {
      std::string bytes = "(" + std::string(before, 'A'), expected = bytes;
      for (int i = 0; i < 50000; ++i) {
        bytes += encoding == Encoding::kLatin1 ? "\xD8" : "\x95\x5C";
        expected += encoding == Encoding::kLatin1 ? "\u00d8" : "\u8868";
      }
      write(bytes + ")\n");
      const auto program = open(encoding);
      ASSERT_NE(program, nullptr) << error_;
      EXPECT_GE(program->size(), expected.size() + 2);
      char last[3] = {};
      EXPECT_EQ(program->read(expected.size(), last, 3), 2) << "before anything else has been read";
      EXPECT_STREQ(last, ")\n");
      EXPECT_EQ(all_of(program.get()), expected + ")\n");
      EXPECT_EQ(program->read(expected.size() + 2, last, 3), 0);
    }
  }
}

// Bytes that this process has read from files.
std::uint64_t bytes_read() {
  std::ifstream file("/proc/self/io");
  std::string name;
  std::uint64_t bytes = 0;
  return file >> name >> bytes && name == "rchar:" ? bytes : 0;
}

// A program of gigabytes is selected while an operator waits, and everybody who asks for something else.
TEST_P(ProgramTextTest, ALargeFileIsNotReadWhenItIsOpened) {
  if (GetParam() != kWatched || bytes_read() == 0) GTEST_SKIP() << "it is copied, or the system does not count what is read";
  constexpr std::uint64_t kSize = 64 << 20;
  write("(\x95\x5C)\n");
  std::filesystem::resize_file(path_, kSize);
  for (const Encoding encoding : {Encoding::kUtf8, Encoding::kLatin1, Encoding::kShiftJis}) {
    const std::uint64_t before = bytes_read();
    const auto program = open(encoding);
    ASSERT_NE(program, nullptr) << error_;
    EXPECT_LT(bytes_read() - before, kSize / 16);
    EXPECT_GE(program->size(), kSize);
    char first = 0;
    EXPECT_EQ(program->read(0, &first, 1), 1);
    EXPECT_EQ(first, '(');
  }
}

TEST_P(ProgramTextTest, LinesEndedByCarriageReturnsAlone) {
  write("O1\rG0 X1.\rM30\r");
  EXPECT_EQ(all_of(open().get()), "O1\nG0 X1.\nM30\n");
  write("O1\r\nG0 X1.\r\nM30\r\n");
  EXPECT_EQ(all_of(open().get()), "O1\r\nG0 X1.\r\nM30\r\n");
}

TEST_P(ProgramTextTest, AByteOrderMarkIsNoPartOfIt) {
  write("\xEF\xBB\xBFO1\nM30\n");
  const auto program = open();
  EXPECT_EQ(program->size(), 7u);
  EXPECT_EQ(all_of(program.get()), "O1\nM30\n");
}

TEST_P(ProgramTextTest, TheImageOfATapeIsNotTouched) {
  std::string rows;
  for (int i = 0; i < 256; ++i) rows += static_cast<char>(i);
  write(rows + "\r\r");
  ProgramText::Options options;
  options.copy_bytes = GetParam();
  options.encoding = Encoding::kShiftJis;
  options.as_it_is = true;
  EXPECT_EQ(all_of(ProgramText::open_file(path_, options, &error_).get()), rows + "\r\r");
}

TEST(Decoder, PieceByPieceIsTheSameAsWhole) {
  std::mt19937 random(3);
  for (const Encoding encoding : {Encoding::kUtf8, Encoding::kLatin1, Encoding::kShiftJis}) {
    for (int run = 0; run < 300; ++run) {
      std::string bytes;
      for (unsigned i = 0; i < 60; ++i) bytes += static_cast<char>(random() % 4 == 0 ? 'A' + random() % 26 : random() % 256);
      std::string whole, pieces;
      Decoder one(encoding), many(encoding);
      EXPECT_EQ(one.take(bytes, true, &whole), bytes.size());
      for (std::size_t at = 0, end = 0; at < bytes.size();) {
        end = std::min(bytes.size(), std::max(at, end) + 1 + random() % 5);
        at += many.take(std::string_view(bytes).substr(at, end - at), end == bytes.size(), &pieces);
      }
      EXPECT_EQ(pieces, whole);
      EXPECT_EQ(valid_utf8(whole), whole);
    }
  }
}

// No character of two bytes ends a comment in which it stands, and what follows the comment is read.
TEST(Decoder, NoCharacterOfShiftJisEndsAComment) {
  Decoder decoder(Encoding::kShiftJis);
  unsigned characters = 0;
  for (unsigned lead = 0x81; lead <= 0xFC; ++lead) {
    if (lead >= 0xA0 && lead < 0xE0) continue;
    for (unsigned trail = 0x40; trail <= 0xFC; ++trail) {
      const std::string bytes = {static_cast<char>(lead), static_cast<char>(trail)};
      std::string text;
      decoder.take(bytes, true, &text);
      if (text.find("\xEF\xBF\xBD") != std::string::npos) continue;
      ++characters;
      EXPECT_EQ(text.find_first_of("()<>[];%\\\n"), std::string::npos) << std::hex << lead << trail;
      EXPECT_EQ(utf8_length(text), text.size());
    }
  }
  EXPECT_GT(characters, 7000u);
}

TEST(ValidUtf8, CutsBetweenCharacters) {
  EXPECT_EQ(cut_utf8("a\u00d8", 2), "a");
  EXPECT_EQ(cut_utf8("a\u00d8", 3), "a\u00d8");
  EXPECT_EQ(cut_utf8("\u5de5", 2), "");
  EXPECT_EQ(valid_utf8("\xED\xA0\x80"), "\ufffd\ufffd\ufffd");
  char text[6] = "abc\xD8";
  make_valid(text, sizeof text);
  EXPECT_STREQ(text, "abc");
  EXPECT_EQ(encoding_from_name("shift-jis"), Encoding::kShiftJis);
  EXPECT_EQ(encoding_from_name("ebcdic"), std::nullopt);
}

}  // namespace
}  // namespace nc::rt
