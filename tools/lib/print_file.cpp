// SPDX-License-Identifier: Apache-2.0
#include "tools/lib/print_file.hpp"

#include <cerrno>
#include <system_error>
#include <utility>

namespace nc::tools {

bool PrintFile::open(const std::string& path, std::string* error) {
  file_.reset(std::fopen(path.c_str(), "ae"));
  if (file_) return true;
  *error = path + ": " + std::generic_category().message(errno);
  return false;
}

bool PrintFile::write(const nc_text& text) {
  if (!file_) return true;
  std::string line(text.s, text.size);
  for (const char* c = text.s; text.size == 0 && *c != 0; ++c)
    if (static_cast<unsigned char>(*c) >= 0x20) line += *c;
  line += '\n';
  if (std::fwrite(line.data(), 1, line.size(), file_.get()) == line.size() && std::fflush(file_.get()) == 0) return true;
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
