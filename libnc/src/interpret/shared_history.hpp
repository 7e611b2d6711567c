// SPDX-License-Identifier: Apache-2.0
// The journal of the places that part systems share, in the order of execution: what stood there before each write that the machine has executed.
//
// Each part system's own journal (macro/journal.hpp) undoes what that one has read ahead. Offline, a host may also go back behind what has been
// executed, in one part system alone; what the others have written since then stays. So a write is taken out of the middle of a chain: the next
// write to the same place, whoever made it, has overwritten what this one had overwritten. Only where there is no later write does the place
// itself get the older value back.
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

  /// Block `seq` of part system `system` has been executed and has written to `key`, where `before` stood.
  void note(unsigned system, BlockSeq seq, uint32_t key, JournalValue before);
  /// A program of `system` has ended or was given up: no way leads back to what was before its writes.
  void keep_for_good(unsigned system);
  /// Somebody outside of the programs has written `value` to `key`: whatever is taken out from now on, no older value comes back.
  void replace(uint32_t key, JournalValue value);
  /// Everything that `system` has executed behind `seq` is still known.
  bool reaches(unsigned system, BlockSeq seq) const { return lost_[system] <= seq; }
  /// Takes the writes of `system` behind `seq` out, newest first; give(key, value) for each that was the last one to its place.
  template <class Give>
  void take_out(unsigned system, BlockSeq seq, Give&& give);

 private:
  struct Entry {
    BlockSeq seq;  ///< 0: kept for good
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
