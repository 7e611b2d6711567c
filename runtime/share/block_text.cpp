// SPDX-License-Identifier: Apache-2.0
// Program names and block texts for displays. See block_text.hpp and program_table.hpp.
#include "runtime/share/block_text.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "runtime/console.hpp"
#include "runtime/share/program_table.hpp"

namespace nc::rt::share {
namespace {

constexpr std::size_t kShown = 127;
constexpr std::size_t kLongest = 4096;  // of a line that is read at once

std::string shown(std::string text) {
  while (!text.empty() && (text.back() == '\r' || text.back() == '\n' || text.back() == ' ')) text.pop_back();
  if (text.size() > kShown) text.resize(kShown);
  return text;
}

}  // namespace

std::string file_name(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

void ProgramTable::add(unsigned file, const std::string& path) {
  const std::uint64_t lines = estimate_lines(path);
  const std::lock_guard lock(mutex_);
  programs_[file] = {path, lines};
}

std::string BlockText::line(const std::string& path, std::uint32_t line) {
  if (line == 0 || path.empty()) return "";
  if (path == path_ && line == have_) return text_;
  if (path != path_ || line < next_) {
    path_ = path;
    stream_.close();
    stream_.clear();
    stream_.open(path, std::ios::binary);
    next_ = 1;
    have_ = 0;
  }
  std::size_t budget = kBytesPerCall;
  char buffer[kLongest];
  while (stream_ && next_ <= line) {
    std::string text;
    do {  // getline() of a part of a long line sets failbit
      stream_.clear(stream_.rdstate() & ~std::ios::failbit);
      stream_.getline(buffer, sizeof buffer);
      const auto got = static_cast<std::size_t>(stream_.gcount());
      if (text.size() < kShown) text += buffer;
      budget -= std::min(budget, got);
      if (got == 0) return "";
    } while (stream_.fail() && !stream_.eof());
    have_ = next_++;
    text_ = shown(std::move(text));
    if (budget == 0 && have_ != line) return "";
  }
  return have_ == line ? text_ : "";
}

std::uint32_t sequence_number(const std::string& block) {
  std::size_t i = 0;
  while (i < block.size() && (block[i] == ' ' || block[i] == '/')) ++i;
  if (i >= block.size() || (block[i] != 'N' && block[i] != 'n')) return 0;
  std::uint32_t number = 0;
  for (++i; i < block.size() && std::isdigit(static_cast<unsigned char>(block[i])) && number < 100'000'000; ++i)
    number = number * 10 + static_cast<std::uint32_t>(block[i] - '0');
  return number;
}

std::string line_of_text(const std::string& text, std::uint32_t line) {
  std::istringstream stream(text);
  std::string found;
  for (std::uint32_t n = 0; n < line; ++n)
    if (!std::getline(stream, found)) return "";
  return shown(found);
}

}  // namespace nc::rt::share
