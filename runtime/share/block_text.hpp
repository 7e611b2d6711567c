// SPDX-License-Identifier: Apache-2.0
// Text of one line of a program file, for displays: goes forward from the line asked for last.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

namespace nc::rt::share {

class BlockText {
 public:
  // Line `line` (from 1) of the file, without its end, at most 127 bytes. "" when it cannot be had by reading
  // at most kBytesPerCall: the next call goes on from there.
  std::string line(const std::string& path, std::uint32_t line);

  static constexpr std::size_t kBytesPerCall = 256 * 1024;

 private:
  std::string path_;
  std::ifstream stream_;
  std::uint32_t next_ = 1;    // line that the stream stands before
  std::uint32_t have_ = 0;    // line of text_
  std::string text_;
};

// The N number at the head of a block, 0 = none.
std::uint32_t sequence_number(const std::string& block);
// Line `line` of a text in memory.
std::string line_of_text(const std::string& text, std::uint32_t line);

}  // namespace nc::rt::share
