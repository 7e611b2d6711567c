// SPDX-License-Identifier: Apache-2.0
// Text of one line of a program, for displays: goes forward from the line asked for last. It is read where the program is, so a display
// shows what runs and not what has been written into the file since.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "runtime/programs/program_text.hpp"

namespace nc::rt::share {

class BlockText {
 public:
  // Line `line` (from 1) of the program, without its end, at most 127 bytes. "" when it cannot be had by reading
  // at most kBytesPerCall: the next call goes on from there.
  std::string line(const std::shared_ptr<ProgramText>& program, std::uint32_t line);

  static constexpr std::size_t kBytesPerCall = 256 * 1024;

 private:
  std::weak_ptr<ProgramText> program_;
  std::string buffer_;         // text from offset_ on that has been read
  std::uint64_t offset_ = 0;   // first byte of line next_, or of what is left of it
  std::uint32_t next_ = 1;     // line that offset_ stands in
  std::uint32_t have_ = 0;     // line of text_
  std::string text_;
  std::string begun_;          // of line next_, as far as it has been passed
};

// The N number at the head of a block, 0 = none.
std::uint32_t sequence_number(const std::string& block);
// Line `line` of a text in memory.
std::string line_of_text(const std::string& text, std::uint32_t line);

}  // namespace nc::rt::share
