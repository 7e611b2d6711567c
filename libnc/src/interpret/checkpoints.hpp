// SPDX-License-Identifier: Apache-2.0
// Checkpoints of the interpreter's state, one for each block, in a ring of bytes: a state without open calls and loops has a tenth of the size of the
// largest one, and what is written in every block should stay in the cache.
#pragma once

#include "interpret/state.hpp"

namespace nc {

class Checkpoints {
 public:
  /// Room for `count` (power of two) states of ordinary size.
  void create(unsigned count, Arena& arena);

  /// Keeps `state` as the state after block state.seq; states of later blocks are forgotten.
  void save(const State& state);
  /// The state after block `seq` is kept.
  bool holds(BlockSeq seq) const { return seq >= oldest_ && seq < next_; }
  /// The state after block `seq` is kept, and will still be kept when one more block has been executed.
  bool keeps(BlockSeq seq) const;
  /// Restores the state after block `seq`, which must be kept. Later states are forgotten.
  void restore(BlockSeq seq, State* state);
  void clear();
  /// The block after which the newest kept state is; holds() is false for it when no state is kept.
  BlockSeq newest() const { return next_ - 1; }
  /// The values of the state after block `seq`, which must be kept.
  void values(BlockSeq seq, StateValues* out) const;
  /// The outermost `count` frames of the state after block `seq`, which must be kept; false when it has fewer.
  bool frames(BlockSeq seq, unsigned count, CallFrame* out) const;
  /// The program is in the call stack of a state that is kept.
  bool call(unsigned file) const;

 private:
  struct Entry {
    uint32_t begin = 0, end = 0;   ///< bytes in the ring
  };
  Entry& entry(BlockSeq seq) const { return entries_[seq & mask_]; }

  Entry* entries_ = nullptr;
  char* bytes_ = nullptr;
  uint32_t mask_ = 0;
  uint32_t capacity_ = 0;
  BlockSeq oldest_ = 0, next_ = 0;  ///< the states after blocks oldest_ to next_ - 1 are kept
};

}  // namespace nc
