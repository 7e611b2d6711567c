// SPDX-License-Identifier: Apache-2.0
// The text of one line of a program, for displays. The search goes forward from the line that was asked for last. It reads the text that runs, so a
// display does not show what has been written into the file since.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "runtime/programs/program_text.hpp"

namespace nc::rt::share {

class BlockText {
 public:
  // Line `line` (from 1) of the program, without its line end, at most 127 bytes. "" when it is not found within
  // kBytesPerCall: the next call goes on from there.
  std::string line(const std::shared_ptr<ProgramText>& program, std::uint32_t line);

  static constexpr std::size_t kBytesPerCall = 256 * 1024;

 private:
  std::weak_ptr<ProgramText> program_;
  std::string buffer_;         // text that has been read, from offset_ on
  std::uint64_t offset_ = 0;   // offset of the first byte that has not been searched
  std::uint32_t next_ = 1;     // number of the line in which offset_ lies
  std::uint32_t have_ = 0;     // number of the line in text_
  std::string text_;
  std::string begun_;          // beginning of line next_, up to offset_
};

// The N number at the head of a block, 0 = none.
std::uint32_t sequence_number(const std::string& block);
// Line `line` of a text in memory.
std::string line_of_text(const std::string& text, std::uint32_t line);

}  // namespace nc::rt::share
