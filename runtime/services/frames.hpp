// SPDX-License-Identifier: Apache-2.0
// Frames on a stream socket: the length of a text as 4 bytes, the highest first, then the text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "runtime/services/service_table.hpp"

namespace nc::rt::services {

inline std::string frame_of(std::string_view text) {
  std::string frame;
  frame.reserve(4 + text.size());
  for (unsigned shift = 32; shift > 0; shift -= 8) frame += static_cast<char>(text.size() >> (shift - 8) & 0xffu);
  return frame.append(text);
}

// Takes bytes as they come and gives whole texts.
class FrameReader {
 public:
  void add(std::string_view bytes) { bytes_.append(bytes); }
  enum class Next { kNone, kFrame, kTooLong };
  // kTooLong: the stream makes no sense any more, and nothing behind it can be read.
  Next next(std::string* text) {
    if (bytes_.size() - at_ < 4) return leave(Next::kNone);
    std::size_t length = 0;
    for (unsigned i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(bytes_[at_ + i]);
    if (length > kMostFrameBytes) return Next::kTooLong;
    if (bytes_.size() - at_ < 4 + length) return leave(Next::kNone);
    text->assign(bytes_, at_ + 4, length);
    at_ += 4 + length;
    return Next::kFrame;
  }
  // True when the beginning of a frame is there, but not its end.
  bool waits() const { return at_ < bytes_.size(); }

 private:
  // Gives up the bytes that were read.
  Next leave(Next result) {
    bytes_.erase(0, at_);
    at_ = 0;
    return result;
  }
  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace nc::rt::services
