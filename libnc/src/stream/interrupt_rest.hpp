// SPDX-License-Identifier: Apache-2.0
// When a macro interrupt signal that stays on counts again (M700 13.12, #1112 = 1: "by keeping the interrupt signal ON, the interrupt program can be
// executed repeatedly"). Between two runs of the interrupt program one block of the interrupted program is executed: otherwise that program would
// never go on, because the signal would be accepted again at once.
#pragma once

#include <cstdint>

#include "nc/item.h"

namespace nc {

class InterruptRest {
 public:
  /// The state of the macro interrupt changes (nc_interrupt_bits).
  void change(uint32_t before, uint32_t now) NC_RT {
    if ((before & NC_INTERRUPT_IN_SERVICE) == 0 || (now & NC_INTERRUPT_IN_SERVICE) != 0) return;
    blocks_ = 2;  // the block of the M99 that has ended the interrupt program, and the block behind the return
  }
  void block_ended() NC_RT {
    if (blocks_ != 0) --blocks_;
  }
  /// The signal has gone off, or the program has ended: when the signal comes on again it counts at once.
  void forget() NC_RT { blocks_ = 0; }
  /// A signal that is on counts.
  bool over() const NC_RT { return blocks_ == 0; }

 private:
  uint8_t blocks_ = 0;  ///< blocks that have to end before the signal counts
};

}  // namespace nc
