// SPDX-License-Identifier: Apache-2.0
// The journal that can undo what was written while reading ahead: what stood in each place before a block wrote to it. Places are named by keys;
// what a key stands for and of which type its value is, its table knows (macro/variables.hpp, interpret/journal_keys.hpp).
#pragma once

#include <cstring>
#include <type_traits>

#include "base/arena.hpp"
#include "stream/stream.hpp"

namespace nc {

/// The value of a place: its bytes, at most eight, with zeros behind them, and for places that take values of several kinds the kind, by a
/// number of their table's own.
struct JournalValue {
  uint64_t bytes = 0;
  uint8_t kind = 0;

  template <class T>
  static JournalValue of(const T& value, uint8_t kind = 0) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= sizeof bytes);
    JournalValue journalled;
    std::memcpy(&journalled.bytes, &value, sizeof value);
    journalled.kind = kind;
    return journalled;
  }
  template <class T>
  T as() const {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= sizeof bytes);
    T value;
    std::memcpy(static_cast<void*>(&value), &bytes, sizeof value);
    return value;
  }
};

/// Old values by the block that overwrote them; bounded: the oldest entries go first, and with them the
/// ability to rewind that far.
class Journal {
 public:
  void create(unsigned capacity, Arena& arena);  ///< capacity: power of two
  void note(BlockSeq seq, uint32_t key, JournalValue old);
  BlockSeq oldest() const;  ///< rewinding to seq >= oldest() - 1 is possible
  /// Rewinding to `seq` is possible, and still will be after `more` notes.
  bool keeps(BlockSeq seq, unsigned more) const;
  /// Takes entries newer than `seq` back, newest first, through `undo`.
  template <class Undo>
  void rewind(BlockSeq seq, Undo&& undo);
  /// Entries newer than `seq` change places with what they speak of, newest first (back), or oldest first, which undoes exactly that.
  /// exchange(key, value) puts a value in place and gives what was there.
  template <class Exchange>
  void swap(BlockSeq seq, bool back, Exchange&& exchange);
  void clear();
  /// Someone outside the program has changed `key`: whatever is taken back from now on, it keeps this value. `mask` has a 1 for each bit of
  /// the value that has been changed, where it holds more than that.
  void replace(uint32_t key, JournalValue value, uint64_t mask = ~uint64_t{0});

  // ---- of several part systems
  /// Blocks up to `executed` have been executed: give(seq, key, before, value) is called for each key of theirs that is shared(key), with the
  /// block, what stood there before it and the value that it has left, nullptr where that is the present one. Once for each entry.
  template <class Shared, class Give>
  void publish(BlockSeq executed, Shared&& shared, Give&& give);
  /// Another part system has executed a write to `key` before the blocks of this journal that are not published: no rewind brings an older value
  /// back. False: one of those blocks writes `key`, and what it has written stays.
  bool precede(uint32_t key, JournalValue value);
  /// The value that `key` has behind the published blocks; `present` is the one that it has now.
  JournalValue published(uint32_t key, JournalValue present) const;
  /// Called with the block of an entry that is not published yet and is going to be lost.
  void before_loss(void* self, void (*call)(void* self, BlockSeq seq)) {
    loser_ = self;
    before_loss_ = call;
  }

 private:
  struct Entry {
    BlockSeq seq;
    uint64_t bytes;
    uint32_t key;
    uint8_t kind;
    JournalValue value() const { return {bytes, kind}; }
    void set(JournalValue value) {
      bytes = value.bytes;
      kind = value.kind;
    }
  };
  static_assert(sizeof(Entry) == 24);
  Entry* ring_ = nullptr;
  uint32_t mask_ = 0;
  uint64_t head_ = 0, tail_ = 0;
  BlockSeq lost_ = 0;
  uint64_t published_ = 0;  ///< entries below this number are
  void* loser_ = nullptr;
  void (*before_loss_)(void* self, BlockSeq seq) = nullptr;
};

template <class Undo>
void Journal::rewind(BlockSeq seq, Undo&& undo) {
  while (head_ != tail_ && ring_[(head_ - 1) & mask_].seq > seq) {
    --head_;
    const Entry& e = ring_[head_ & mask_];
    undo(e.key, e.value());
  }
  if (published_ > head_) published_ = head_;
}

template <class Shared, class Give>
void Journal::publish(BlockSeq executed, Shared&& shared, Give&& give) {
  while (published_ != head_ && ring_[published_ & mask_].seq <= executed) {
    const Entry written = ring_[published_++ & mask_];
    if (!shared(written.key)) continue;
    uint64_t newer = published_;
    while (newer != head_ && ring_[newer & mask_].key != written.key) ++newer;
    const JournalValue then = ring_[newer & mask_].value();
    give(written.seq, written.key, written.value(), newer != head_ ? &then : nullptr);
  }
}

template <class Exchange>
void Journal::swap(BlockSeq seq, bool back, Exchange&& exchange) {
  uint64_t first = head_;
  while (first != tail_ && ring_[(first - 1) & mask_].seq > seq) --first;
  for (uint64_t n = 0; n < head_ - first; ++n) {
    Entry& e = ring_[(back ? head_ - 1 - n : first + n) & mask_];
    e.set(exchange(e.key, e.value()));
  }
}

}  // namespace nc
