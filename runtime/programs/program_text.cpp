// SPDX-License-Identifier: Apache-2.0
// Texts of program files. See program_text.hpp.
#include "runtime/programs/program_text.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <system_error>
#include <thread>

#include "nc/control.h"
#include "runtime/programs/large_pages.hpp"
#include "runtime/programs/open_for_writing.hpp"

namespace nc::rt {
namespace {

using std::chrono::nanoseconds;

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::uint64_t kMostGrowth = 3;  // bytes of UTF-8 that one byte of another encoding may become: a katakana of one byte, or the sign for what is no character

nanoseconds time_of(const struct timespec& t) { return std::chrono::seconds(t.tv_sec) + nanoseconds(t.tv_nsec); }

// The time on the clock from which the kernel takes the times of files.
nanoseconds stamp_now() {
  struct timespec now = {};
  clock_gettime(CLOCK_REALTIME_COARSE, &now);
  return time_of(now);
}

}  // namespace

bool same_content(const struct stat& a, const struct stat& b) {
  return a.st_size == b.st_size && time_of(a.st_mtim) == time_of(b.st_mtim) && time_of(a.st_ctim) == time_of(b.st_ctim) &&
         a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

namespace {

// The time until the file has been unchanged for `quiet`; 0 when it has been. A time of the file that lies in the future is ignored.
nanoseconds unrest(const struct stat& info, nanoseconds quiet) {
  const nanoseconds age = stamp_now() - std::max(time_of(info.st_mtim), time_of(info.st_ctim));
  return age >= nanoseconds(0) && age < quiet ? quiet - age : nanoseconds(0);
}

// Reads `size` bytes from `offset`, fewer only at the end of the file. False with errno on failure.
bool read_file(int descriptor, std::uint64_t offset, std::size_t size, std::string* bytes) {
  bytes->resize(size);
  std::size_t got = 0;
  while (got < size) {
    const ssize_t n = pread(descriptor, bytes->data() + got, size - got, static_cast<off_t>(offset + got));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    if (n == 0) break;
    got += static_cast<std::size_t>(n);
  }
  bytes->resize(got);
  return true;
}

// A hash that detects changed texts; it does not resist deliberate collisions. It takes eight bytes at a time and multiplies after each (with the
// constants of splitmix64).
std::uint64_t hash_of(std::string_view bytes) {
  std::uint64_t h = 0x9e3779b97f4a7c15u ^ bytes.size();
  const auto mix = [&h](std::uint64_t word) {
    h = (h ^ word) * 0xbf58476d1ce4e5b9u;
    h ^= h >> 29;
  };
  std::size_t at = 0;
  for (; at + sizeof(std::uint64_t) <= bytes.size(); at += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    mix(word);
  }
  std::uint64_t rest = 0;
  std::memcpy(&rest, bytes.data() + at, bytes.size() - at);
  mix(rest);
  return h * 0x94d049bb133111ebu;
}

}  // namespace

ProgramText::ProgramText(int descriptor, std::string path, const Options& options)
    : path_(std::move(path)), options_(options), descriptor_(descriptor) {}

ProgramText::~ProgramText() {
  if (descriptor_ >= 0) close(descriptor_);
}

std::shared_ptr<ProgramText> ProgramText::open(int descriptor, const std::string& path, const Options& options, std::string* error) {
  std::shared_ptr<ProgramText> text(new ProgramText(descriptor, path, options));
  if (!options.as_it_is && !Decoder(options.encoding).usable()) {
    *error = "this computer's C library does not know the encoding of the programs";
    return nullptr;
  }
  const auto deadline = std::chrono::steady_clock::now() + options.patience;
  for (bool again = false; !again || std::chrono::steady_clock::now() < deadline; again = true) {
    if (again) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const OpenForWriting writer = open_for_writing(descriptor);
    if (writer == OpenForWriting::kYes) continue;
    if (fstat(descriptor, &text->info_) != 0) {
      *error = std::generic_category().message(errno);
      return nullptr;
    }
    if (const auto bytes = static_cast<std::uint64_t>(text->info_.st_size); bytes > options.most_bytes) {
      *error = "has " + std::to_string(bytes) + " bytes, a program at most " + std::to_string(options.most_bytes) + " (program_mb)";
      return nullptr;
    }
    const nanoseconds wait = unrest(text->info_, writer == OpenForWriting::kNo ? kQuiet : kQuietNotTold);
    if (wait > nanoseconds(0)) {
      std::this_thread::sleep_for(std::min<nanoseconds>(wait, deadline - std::chrono::steady_clock::now()));
      continue;
    }
    error->clear();
    const bool small = static_cast<std::uint64_t>(text->info_.st_size) <= options.copy_bytes;
    if (small ? text->copy(writer == OpenForWriting::kNotTold || unrest(text->info_, kCoarse) > nanoseconds(0), error) : text->divide()) return text;
    if (!error->empty()) return nullptr;
  }
  *error = "is being written: select it when that is done";
  return nullptr;
}

std::shared_ptr<ProgramText> ProgramText::open_file(const std::string& path, const Options& options, std::string* error) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor >= 0) return open(descriptor, path, options, error);
  *error = std::generic_category().message(errno);
  return nullptr;
}

// Reads a small file whole, where it is `doubtful` twice. False with an empty *error when the file was written meanwhile. It is doubtful where a write since its times
// were looked at may have left them as they were: they are so new that a coarse clock still shows the same, or they come late from another computer.
bool ProgramText::copy(bool doubtful, std::string* error) {
  std::string bytes, again;
  const auto size = static_cast<std::size_t>(info_.st_size);
  bytes.reserve(size + 1);
  ask_for_large_pages(bytes.data(), size + 1);
  const bool whole = read_file(descriptor_, 0, size + 1, &bytes);
  if (!whole) *error = std::generic_category().message(errno);
  if (!whole || bytes.size() != size) return false;
  for (std::size_t at = 0; doubtful && at < size; at += kPart) {
    const std::size_t length = std::min(kPart, size - at);
    if (!read_file(descriptor_, at, length, &again) || bytes.compare(at, length, again) != 0) return false;
  }
  struct stat after = {};
  if (fstat(descriptor_, &after) != 0 || !same_content(info_, after) || open_for_writing(descriptor_) == OpenForWriting::kYes) return false;
  look_at_head(bytes.substr(0, kPart));
  if (options_.as_it_is) {
    text_ = std::move(bytes);
  } else if (is_ascii(bytes)) {
    text_ = std::move(bytes);
    finish(&text_);
  } else {
    Decoder decoder(options_.encoding);
    text_.clear();
    text_.reserve(size);
    decoder.take(std::string_view(bytes).substr(mark_), true, &text_);
    finish(&text_);
  }
  size_ = text_.size();
  close(descriptor_);
  descriptor_ = -1;
  return true;
}

// A byte order mark, which some editors write, is not part of the program. In a file without line feeds the lines end with carriage returns, as on
// old machines; in other files a carriage return is a blank.
void ProgramText::look_at_head(const std::string& head) {
  if (options_.as_it_is) return;
  mark_ = head.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  cr_ends_line_ = head.find('\r') != std::string::npos && head.find('\n') == std::string::npos;
}

void ProgramText::finish(std::string* text) const {
  if (cr_ends_line_) std::replace(text->begin(), text->end(), '\r', '\n');
}

// Divides a large file into parts, of which the last one is where what is known of it ends. UTF-8 is not converted, so the parts of the text are those of the file, and
// nothing has to be read. A conversion changes the length, so where a part begins in the text is known when the one before it has been read.
bool ProgramText::divide() {
  const auto end = static_cast<std::uint64_t>(info_.st_size);
  std::string head;
  loaded_ = SIZE_MAX;
  if (!read_file(descriptor_, 0, kPart, &head)) return false;
  look_at_head(head);
  const bool converts = !options_.as_it_is && options_.encoding != Encoding::kUtf8;
  Part next;
  next.file_begin = std::min<std::uint64_t>(mark_, end);
  size_ = (end - next.file_begin) * (converts ? kMostGrowth : 1);
  parts_.assign(1, next);
  while (!converts && next.file_begin < end) {
    const std::uint64_t length = std::min<std::uint64_t>(kPart, end - next.file_begin);
    next.file_begin += length;
    next.text_begin += length;
    parts_.push_back(next);
  }
  return is_unchanged();
}

bool ProgramText::is_file(const struct stat& info) const { return same_content(info_, info); }

bool ProgramText::has_changed() const {
  struct stat now = {};
  return !path_.empty() && (stat(path_.c_str(), &now) != 0 || !is_file(now));
}

bool ProgramText::is_unchanged() const {
  struct stat now = {};
  if (fstat(descriptor_, &now) != 0 || !same_content(info_, now)) return false;
  return path_.empty() || (stat(path_.c_str(), &now) == 0 && same_content(info_, now));
}

long ProgramText::give_up(long code) {
  failure_ = code;
  loaded_ = SIZE_MAX;
  return code;
}

// The last one is the part behind those that are known, whose end is found with it.
bool ProgramText::load(std::size_t index) {
  if (index == loaded_) return true;
  const bool next = index + 1 == parts_.size();
  const std::uint64_t begin = parts_[index].file_begin, file_end = static_cast<std::uint64_t>(info_.st_size);
  const std::uint64_t end = next ? std::min(file_end, begin + kPart) : parts_[index + 1].file_begin;
  std::string bytes;
  loaded_ = SIZE_MAX;
  if (!read_file(descriptor_, begin, static_cast<std::size_t>(end - begin), &bytes)) {
    give_up(NC_READ_FAILED);
    return false;
  }
  bool good = bytes.size() == end - begin;
  if (options_.as_it_is || options_.encoding == Encoding::kUtf8) {
    text_ = bytes;
  } else {
    text_.clear();
    const std::size_t used = Decoder(options_.encoding).take(bytes, !next || end == file_end, &text_);
    good = good && used > 0;
    bytes.resize(used);
  }
  // The file is compared after the bytes were read: the kernel sets the time of a file before it stores what is written, so when new bytes
  // were read, the new time is there as well.
  const std::uint64_t hash = hash_of(bytes);
  if (!good || !is_unchanged() || (parts_[index].hashed && parts_[index].hash != hash)) {
    give_up(NC_READ_CHANGED);
    return false;
  }
  parts_[index].hash = hash;
  parts_[index].hashed = true;
  finish(&text_);
  loaded_ = index;
  if (!next) return true;
  Part behind;
  behind.file_begin = begin + bytes.size();
  behind.text_begin = parts_[index].text_begin + text_.size();
  parts_.push_back(behind);
  return true;
}

long ProgramText::read(std::uint64_t offset, char* buffer, std::size_t size) {
  if (offset >= size_) return 0;
  size = static_cast<std::size_t>(std::min<std::uint64_t>(size, size_ - offset));
  if (copied()) {
    std::memcpy(buffer, text_.data() + offset, size);
    return static_cast<long>(size);
  }
  const std::lock_guard lock(mutex_);
  if (failure_ != 0) return failure_;
  while (parts_.back().text_begin < offset + size && parts_.back().file_begin < static_cast<std::uint64_t>(info_.st_size))
    if (!load(parts_.size() - 1)) return failure_;
  const std::uint64_t known = parts_.back().text_begin;
  if (offset >= known) return 0;
  size = static_cast<std::size_t>(std::min<std::uint64_t>(size, known - offset));
  auto index = static_cast<std::size_t>(
      std::upper_bound(parts_.begin(), parts_.end(), offset, [](std::uint64_t at, const Part& part) { return at < part.text_begin; }) -
      parts_.begin() - 1);
  std::size_t got = 0;
  for (; got < size; ++index) {
    if (!load(index)) return failure_;
    const auto from = static_cast<std::size_t>(offset + got - parts_[index].text_begin);
    const std::size_t length = std::min(size - got, text_.size() - from);
    std::memcpy(buffer + got, text_.data() + from, length);
    got += length;
  }
  return static_cast<long>(got);
}

}  // namespace nc::rt
