// SPDX-License-Identifier: Apache-2.0
// The journal, by which everything that was written while reading ahead can be undone: it keeps the value that each place had before a block wrote to it.
// Places are named by keys; which place a key stands for, and the type of its value, is known to the table of the place (macro/variables.hpp,
// interpret/journal_keys.hpp).
#pragma once

#include <cstring>
#include <type_traits>

#include "base/arena.hpp"
#include "stream/stream.hpp"

namespace nc {

/// The value of a place: its bytes, at most eight, filled up with zeros; and for places that can have values of several kinds a number for the kind, which
/// their table defines.
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

/// Old values, with the block that overwrote each of them. The room is limited: the oldest entries are lost first, and then a rewind cannot go back that
/// far.
class Journal {
 public:
  void create(unsigned capacity, Arena& arena);  ///< capacity: power of two
  void note(BlockSeq seq, uint32_t key, JournalValue old);
  BlockSeq oldest() const;  ///< a rewind to seq >= oldest() - 1 is possible
  /// A rewind to `seq` is possible, and will still be possible after `more` notes.
  bool keeps(BlockSeq seq, unsigned more) const;
  /// Takes the entries of blocks after `seq` back, newest first: undo(key, old value) is called for each.
  template <class Undo>
  void rewind(BlockSeq seq, Undo&& undo);
  /// Exchanges the values in the entries of blocks after `seq` with those in their places: newest first (`back`), or oldest first, which undoes exactly
  /// that. exchange(key, value) puts a value into its place and returns the value that was there.
  template <class Exchange>
  void swap(BlockSeq seq, bool back, Exchange&& exchange);
  void clear();
  /// Calls see(key, value) for each value that a rewind can bring back.
  template <class See>
  void each(See&& see) const {
    for (uint64_t i = tail_; i != head_; ++i) see(ring_[i & mask_].key, ring_[i & mask_].value());
  }
  /// From now on nothing that blocks up to `seq` have written can be taken back.
  void lose(BlockSeq seq);
  /// The place `key` was changed from outside the program: it keeps this value, whatever is taken back from now on. `mask` has a 1 for each bit that was
  /// changed, where only some bits of the value were.
  void replace(uint32_t key, JournalValue value, uint64_t mask = ~uint64_t{0});

  // ---- for several part systems
  /// The machine has executed the blocks up to `executed`. For each of their entries whose key is shared(key), give(seq, key, before, value) is called: with
  /// the block, the value before it, and the value that it has left, nullptr where that is the present value.
  template <class Shared, class Give>
  void publish(BlockSeq executed, Shared&& shared, Give&& give);
  /// Another part system has written `value` to `key`, and this was executed before the blocks of this journal that are not published yet. So a rewind
  /// must bring back this value and no older one. False: one of those blocks has written `key` later, and the value in place stays.
  bool precede(uint32_t key, JournalValue value);
  /// The value that `key` has after the published blocks; `present` is the one that it has now.
  JournalValue published(uint32_t key, JournalValue present) const;
  /// Sets a function that is called with the block of an entry which is not published yet and is about to be lost.
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
  uint64_t published_ = 0;  ///< entries with a number below this are published
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
