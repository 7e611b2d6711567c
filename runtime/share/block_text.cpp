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

std::string shown(std::string text) {
  while (!text.empty() && (text.back() == '\r' || text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return std::string(cut_utf8(seen_text(text), kShown));
}

}  // namespace

std::string file_name(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

void ProgramTable::add(unsigned file, const std::string& path, const Text& text) {
  const std::uint64_t lines = text == nullptr ? 0 : estimate_lines(text.get(), dialect_);
  const std::lock_guard lock(mutex_);
  programs_[file] = {path, lines, text};
}

std::string BlockText::line(const std::shared_ptr<ProgramText>& program, std::uint32_t line) {
  if (line == 0 || program == nullptr) return "";
  const bool same = program == program_.lock();
  if (same && line == have_) return text_;
  if (!same || line < next_) {
    program_ = program;
    buffer_.clear();
    begun_.clear();
    offset_ = 0;
    next_ = 1;
    have_ = 0;
  }
  constexpr std::size_t kPiece = 4096;
  for (std::size_t passed = 0; next_ <= line;) {
    if (buffer_.empty()) {
      if (passed >= kBytesPerCall) return "";
      buffer_.resize(kPiece);
      const long got = program->read(offset_, buffer_.data(), kPiece);
      buffer_.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
      if (got < 0 || (got == 0 && begun_.empty())) return "";
      passed += buffer_.size();
    }
    const std::size_t end = buffer_.find('\n');
    const bool ended = end != std::string::npos || buffer_.empty();  // the line has ended, with a line feed or with the text
    const std::size_t length = std::min(end, buffer_.size());
    if (begun_.size() <= kShown) begun_.append(buffer_, 0, length);  // keeps more than is shown, so that shown() can cut at a whole character
    const std::size_t used = end != std::string::npos ? length + 1 : length;
    buffer_.erase(0, used);
    offset_ += used;
    if (!ended) continue;
    have_ = next_++;
    text_ = shown(std::move(begun_));
    begun_.clear();
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
