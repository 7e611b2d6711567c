// SPDX-License-Identifier: Apache-2.0
#include "tools/lib/print_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

namespace nc::tools {
namespace {

// Appends the whole line, or nothing: half of one would run into the next one. False with errno.
bool append(int file, std::string_view line) {
  struct stat before {};
  const bool known = fstat(file, &before) == 0 && S_ISREG(before.st_mode);
  while (!line.empty()) {
    const ssize_t count = ::write(file, line.data(), line.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      const int code = count < 0 ? errno : ENOSPC;
      if (!known || ftruncate(file, before.st_size) == 0) errno = code;
      return false;
    }
    line.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace

PrintFile::~PrintFile() {
  if (file_ >= 0) ::close(file_);
}

bool PrintFile::open(const std::string& path, std::string* error) {
  if (file_ >= 0) ::close(file_);
  file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file_ >= 0) return true;
  *error = path + ": " + std::generic_category().message(errno);
  return false;
}

bool PrintFile::write(const nc_text& text) {
  if (file_ < 0) return true;
  std::string line(text.s, text.size);
  for (const char* c = text.s; text.size == 0 && *c != 0; ++c)
    if (static_cast<unsigned char>(*c) >= 0x20) line += *c;
  line += '\n';
  if (append(file_, line)) return true;
  if (error_.empty()) error_ = std::generic_category().message(errno);
  return false;
}

void PrintLines::write(const nc_text& text) {
  constexpr std::size_t kMost = 1000;  // limit for a program that prints in a loop while the lines are not taken
  std::string line;
  const std::size_t size = text.size != 0 ? text.size : std::char_traits<char>::length(text.s);
  for (std::size_t i = 0; i < size; ++i) {
    const auto byte = static_cast<unsigned char>(text.s[i]);
    if (byte >= 0x20 && byte != 0x7F) line += text.s[i];
    else if (text.size != 0) line += '.';  // a byte of BPRNT that cannot be printed
  }
  if (line == "%") return;
  const std::lock_guard lock(mutex_);
  if (lines_.size() < kMost) lines_.push_back(std::move(line));
  else ++left_out_;
}

std::vector<std::string> PrintLines::take() {
  const std::lock_guard lock(mutex_);
  if (left_out_ != 0) lines_.push_back(std::to_string(std::exchange(left_out_, 0)) + " more lines, not shown");
  return std::exchange(lines_, {});
}

}  // namespace nc::tools
