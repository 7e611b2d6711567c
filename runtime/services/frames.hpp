// SPDX-License-Identifier: Apache-2.0
// Frames on a stream socket: the length of a text as 4 bytes, the highest first, then the text.
#pragma once

#include <algorithm>
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
    std::string_view frame;
    const Next found = frame_at(at_, &frame);
    if (found == Next::kNone) return leave();
    if (found == Next::kTooLong) return found;
    text->assign(frame);
    at_ += 4 + frame.size();
    return found;
  }
  // Shows each whole text that waits, once. It stays where it is.
  template <class See>
  void look_ahead(See see) {
    std::string_view frame;
    for (seen_ = std::max(seen_, at_); frame_at(seen_, &frame) == Next::kFrame; seen_ += 4 + frame.size()) see(frame);
  }
  // True when the beginning of a frame is there, but not its end.
  bool waits() const { return waiting() != 0; }
  std::size_t waiting() const { return bytes_.size() - at_; }  // bytes

 private:
  Next frame_at(std::size_t at, std::string_view* frame) const {
    if (bytes_.size() - at < 4) return Next::kNone;
    std::size_t length = 0;
    for (unsigned i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(bytes_[at + i]);
    if (length > kMostFrameBytes) return Next::kTooLong;
    if (bytes_.size() - at < 4 + length) return Next::kNone;
    *frame = std::string_view(bytes_).substr(at + 4, length);
    return Next::kFrame;
  }
  // Gives up the bytes that were read.
  Next leave() {
    bytes_.erase(0, at_);
    seen_ -= std::min(seen_, at_);
    at_ = 0;
    return Next::kNone;
  }
  std::string bytes_;
  std::size_t at_ = 0, seen_ = 0;
};

}  // namespace nc::rt::services
