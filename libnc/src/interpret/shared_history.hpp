// SPDX-License-Identifier: Apache-2.0
// The journal of the places that part systems share, in the order of execution: the value before each write that the machine has executed.
//
// The journal of each part system (macro/journal.hpp) undoes what it has read ahead. Offline, a host may also go back in one part system to before blocks
// that have been executed; what the other part systems have written since then stays. So a write may have to be taken out of the middle of a chain of
// writes: then the next write to the same place, by whichever part system, gets the old value of the write that is taken out. Only where there is no later
// write does the place itself get the old value back.
#pragma once

#include <cstdint>

#include "base/arena.hpp"
#include "macro/journal.hpp"
#include "stream/stream.hpp"

namespace nc {

class SharedHistory {
 public:
  /// `capacity` is a power of two.
  void create(unsigned capacity, Arena& arena);

  /// Block `seq` of part system `system` has been executed and has written to `key`, which had the value `before`.
  void note(unsigned system, BlockSeq seq, uint32_t key, JournalValue before);
  /// A program of `system` has ended or was given up: its writes are never taken out any more.
  void keep_for_good(unsigned system);
  /// The host has written `value` to `key`: whatever is taken out from now on, no older value comes back.
  void replace(uint32_t key, JournalValue value);
  /// Everything that `system` has executed after block `seq` is still known.
  bool reaches(unsigned system, BlockSeq seq) const { return lost_[system] <= seq; }
  /// Takes the writes of `system` after block `seq` out, newest first. give(key, value) is called for each that was the last write to its place.
  template <class Give>
  void take_out(unsigned system, BlockSeq seq, Give&& give);

 private:
  struct Entry {
    BlockSeq seq;  ///< 0: the write is never taken out any more
    uint64_t bytes;
    uint32_t key;
    uint8_t kind;
    uint8_t system;  ///< kNobody: taken out
  };
  static_assert(sizeof(Entry) == 24);
  static constexpr uint8_t kNobody = 0xff;
  Entry& at(uint64_t number) { return ring_[number & mask_]; }

  Entry* ring_ = nullptr;
  uint32_t mask_ = 0;
  uint64_t head_ = 0, tail_ = 0;
  BlockSeq lost_[NC_MAX_SYSTEMS] = {};  ///< the newest block of each part system of which an entry has been overwritten
};

template <class Give>
void SharedHistory::take_out(unsigned system, BlockSeq seq, Give&& give) {
  for (uint64_t i = head_; i-- != tail_;) {
    Entry& out = at(i);
    if (out.system != system || out.seq <= seq) continue;
    out.system = kNobody;
    uint64_t later = i + 1;
    while (later != head_ && (at(later).key != out.key || at(later).system == kNobody)) ++later;
    if (later == head_) {
      give(out.key, JournalValue{out.bytes, out.kind});
    } else {
      at(later).bytes = out.bytes;
      at(later).kind = out.kind;
    }
  }
}

}  // namespace nc
