// SPDX-License-Identifier: Apache-2.0
// A window on a text: a text in memory is read where it lies, any other one through a buffer that moves along with the reader.
#pragma once

#include "base/arena.hpp"
#include "nc/control.h"

namespace nc {

/// A text of the program store.
struct TextEntry {
  char name[NC_MAX_NAME] = {};  ///< "" = the place is free
  uint32_t number = 0;        ///< from the name, 0 = none
  nc_read_at read = nullptr;  ///< nullptr: the text is in `memory`
  void* user = nullptr;
  const char* memory = nullptr;
  uint64_t size = 0;
  bool mdi = false;           ///< blocks of MDI
  bool edited = false;        ///< the text is being edited
  bool own = false;           ///< the text belongs to the control itself: blocks of MDI
  uint8_t tape = NC_TAPE_NONE;  ///< nc_tape: the bytes are rows of a tape (program/tape.hpp)
  uint8_t unit = 0;             ///< input device of the tape, 1 to 5
  uint64_t label = 0;           ///< bytes before the significant section of the tape
  uint8_t noted = 0;            ///< bit n: part system n + 1 uses the program in a modal call or as interrupt program, or has done so since its reset
  uint64_t used = 0;            ///< count of the store's uses (entering, selecting, calling) when this program was used last
  uint32_t generation =
      0;  ///< changes when the entry is replaced, so that compiled blocks of the old text are not used again
};

class TextWindow {
 public:
  void create(unsigned bytes, Arena& arena);

  /// Moves the window so that text()[0] is the byte at `offset`; at the end of the text size() is 0. False: the read callback has failed.
  bool seek(const TextEntry& entry, uint64_t offset) {
    if (entry.generation == generation_ && offset >= begin_ && offset - begin_ < length_) [[likely]] {
      at_ = static_cast<size_t>(offset - begin_);
      return true;
    }
    return load(entry, offset);
  }
  const char* text() const { return base_ + at_; }
  size_t size() const { return length_ - at_; }
  /// The text ends with the window.
  bool last() const { return last_; }
  /// text() is the beginning of the buffer, so that more text can only be read with a larger buffer.
  bool at_front() const { return at_ == 0; }
  /// Moves the window so that it begins at text(), and reads more text behind. False: the read callback has failed.
  bool advance(const TextEntry& entry);
  void forget() { generation_ = 0, length_ = at_ = 0; }
  /// What the read callback returned when seek() or advance() failed.
  long failure() const { return failure_; }

  /// Gives the buffer for another use; the text that it held is forgotten.
  char* take_buffer() {
    forget();
    return buffer_;
  }
  size_t capacity() const { return capacity_; }

  /// Reads at most `size` bytes without the window. Returns the bytes read, 0 at the end, a negative number on failure.
  static long read(const TextEntry& entry, uint64_t offset, char* buffer, size_t size);

 private:
  bool load(const TextEntry& entry, uint64_t offset);
  bool fill(const TextEntry& entry);

  char* buffer_ = nullptr;
  size_t capacity_ = 0;
  const char* base_ = nullptr;
  long failure_ = 0;
  uint64_t begin_ = 0;  ///< offset of base_[0]
  size_t length_ = 0, at_ = 0;
  uint32_t generation_ = 0;  ///< generation of the entry whose text the window holds; 0 = none
  bool last_ = false;
};

}  // namespace nc
