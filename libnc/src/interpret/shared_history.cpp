// SPDX-License-Identifier: Apache-2.0
#include "interpret/shared_history.hpp"

namespace nc {

void SharedHistory::create(unsigned capacity, Arena& arena) {
  ring_ = arena.make<Entry>(capacity);
  mask_ = capacity - 1;
}

void SharedHistory::note(unsigned system, BlockSeq seq, uint32_t key, JournalValue before) {
  if (head_ - tail_ > mask_) {
    const Entry& oldest = at(tail_++);
    if (oldest.system != kNobody && oldest.seq > lost_[oldest.system]) lost_[oldest.system] = oldest.seq;
  }
  at(head_++) = Entry{seq, before.bytes, key, before.kind, static_cast<uint8_t>(system)};
}

void SharedHistory::replace(uint32_t key, JournalValue value) {
  for (uint64_t i = tail_; i != head_; ++i) {
    if (at(i).key != key) continue;
    at(i).bytes = value.bytes;
    at(i).kind = value.kind;
  }
}

void SharedHistory::keep_for_good(unsigned system) {
  for (uint64_t i = tail_; i != head_; ++i) {
    if (at(i).system == system) at(i).seq = 0;
  }
  lost_[system] = 0;
}

}  // namespace nc
