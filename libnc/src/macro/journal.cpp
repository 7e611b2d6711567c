// SPDX-License-Identifier: Apache-2.0
#include "macro/journal.hpp"

namespace nc {

void Journal::create(unsigned capacity, Arena& arena) {
  ring_ = arena.make<Entry>(capacity);
  mask_ = capacity - 1;
  clear();
}

void Journal::note(BlockSeq seq, uint32_t key, JournalValue old) {
  if (head_ - tail_ > mask_) {
    if (before_loss_ != nullptr && published_ == tail_) before_loss_(loser_, ring_[tail_ & mask_].seq);
    lost_ = ring_[tail_++ & mask_].seq;
  }
  ring_[head_++ & mask_] = Entry{seq, old.bytes, key, old.kind};
}

BlockSeq Journal::oldest() const {
  return lost_ + 1;
}

bool Journal::keeps(BlockSeq seq, unsigned more) const {
  if (lost_ > seq) return false;
  const uint64_t under_way = head_ - tail_, room = uint64_t{mask_} + 1 - under_way;
  if (more <= room) return true;
  const uint64_t overwritten = more - room;  // the oldest ones
  return overwritten <= under_way && ring_[(tail_ + overwritten - 1) & mask_].seq <= seq;
}

void Journal::lose(BlockSeq seq) {
  if (before_loss_ != nullptr) before_loss_(loser_, seq);
  while (tail_ != head_ && ring_[tail_ & mask_].seq <= seq) lost_ = ring_[tail_++ & mask_].seq;
}

void Journal::clear() {
  head_ = tail_ = 0;
  published_ = 0;
  lost_ = 0;
}

bool Journal::precede(uint32_t key, JournalValue value) {
  bool written_later = false;
  for (uint64_t i = tail_; i != head_ && !written_later; ++i) {
    Entry& e = ring_[i & mask_];
    if (e.key != key) continue;
    e.set(value);
    written_later = i >= published_;
  }
  return !written_later;
}

JournalValue Journal::published(uint32_t key, JournalValue present) const {
  for (uint64_t i = published_ > tail_ ? published_ : tail_; i != head_; ++i) {
    const Entry& e = ring_[i & mask_];
    if (e.key == key) return e.value();
  }
  return present;
}

void Journal::replace(uint32_t key, JournalValue value, uint64_t mask) {
  for (uint64_t i = tail_; i != head_; ++i) {
    Entry& e = ring_[i & mask_];
    if (e.key != key) continue;
    e.set({(e.bytes & ~mask) | (value.bytes & mask), value.kind});
  }
}

}  // namespace nc
