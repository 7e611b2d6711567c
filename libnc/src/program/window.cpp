// SPDX-License-Identifier: Apache-2.0
#include "program/window.hpp"

#include <cstring>

#include "program/store.hpp"
#include "program/tape.hpp"

namespace nc {

void TextWindow::create(unsigned bytes, Arena& arena) {
  buffer_ = arena.make<char>(bytes);
  capacity_ = bytes;
  forget();
}

long TextWindow::read(const TextEntry& entry, uint64_t offset, char* buffer, size_t size) {
  if (offset >= entry.size) return 0;
  if (size > entry.size - offset) size = static_cast<size_t>(entry.size - offset);
  if (entry.read == nullptr) {
    std::memcpy(buffer, entry.memory + offset, size);
    if (entry.tape != NC_TAPE_NONE) decode_tape(entry, offset, buffer, size);
    return static_cast<long>(size);
  }
  const long got = entry.read(entry.user, offset, buffer, size);
  if (got > static_cast<long>(size)) return -1;
  if (entry.tape != NC_TAPE_NONE && got > 0) decode_tape(entry, offset, buffer, static_cast<size_t>(got));
  return got;
}

bool TextWindow::load(const TextEntry& entry, uint64_t offset) {
  generation_ = entry.generation;
  if (entry.read == nullptr && entry.tape == NC_TAPE_NONE) {
    base_ = entry.memory;
    begin_ = 0;
    length_ = static_cast<size_t>(entry.size);
    at_ = offset < entry.size ? static_cast<size_t>(offset) : length_;
    last_ = true;
    return true;
  }
  base_ = buffer_;
  begin_ = offset;
  length_ = at_ = 0;
  return fill(entry);
}

bool TextWindow::advance(const TextEntry& entry) {
  std::memmove(buffer_, base_ + at_, length_ - at_);
  begin_ += at_;
  length_ -= at_;
  at_ = 0;
  return fill(entry);
}

bool TextWindow::fill(const TextEntry& entry) {
  last_ = false;
  while (length_ < capacity_) {
    const long got = read(entry, begin_ + length_, buffer_ + length_, capacity_ - length_);
    if (got < 0) {
      failure_ = got;
      forget();
      return false;
    }
    if (got == 0) break;
    length_ += static_cast<size_t>(got);
  }
  last_ = length_ < capacity_ || begin_ + length_ >= entry.size;
  return true;
}

}  // namespace nc
