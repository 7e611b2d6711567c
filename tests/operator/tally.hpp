// SPDX-License-Identifier: Apache-2.0
// How many programs a session has executed, by the way in which they were started. A program counts when an item of it has been executed.
#pragma once

#include <cstdint>

#include "nc/nc.h"
#include "operator/random_part.hpp"

namespace nc::test {

struct Programs {
  uint64_t selected = 0;    ///< programs that were executed for the first time since they were selected
  uint64_t restarted = 0;   ///< programs that were executed once more without a new selection
  uint64_t mdi = 0;
  uint64_t interrupts = 0;  ///< interrupt programs (M700 13.12)

  uint64_t all() const { return selected + restarted + mdi + interrupts; }
  Programs& operator+=(const Programs& other) {
    selected += other.selected;
    restarted += other.restarted;
    mdi += other.mdi;
    interrupts += other.interrupts;
    return *this;
  }
};

class Tally {
 public:
  void selected() { next_ = &Programs::selected; }
  void mdi() { next_ = &Programs::mdi; }
  /// Programs from now on are not counted.
  void close() { open_ = false; }

  void cycle(const nc_outputs& out) {
    const bool rests = out.state == NC_STATE_IDLE || out.state == NC_STATE_MANUAL;
    // The time since cycle start begins again with each program, also with one that begins and ends within a cycle.
    if ((rested_ && !rests) || out.run_s < run_s_) begins_ = true;
    rested_ = rests;
    run_s_ = out.run_s;
  }
  void event(const nc_event& event) {
    const bool interrupt = event.source.program == kInterruptProgram;
    if (open_ && begins_) {
      ++(programs_.*next_);
      next_ = &Programs::restarted;
    } else if (open_ && interrupt && !interrupt_) {
      ++programs_.interrupts;
    }
    begins_ = false;
    interrupt_ = interrupt;
  }
  const Programs& programs() const { return programs_; }

 private:
  Programs programs_;
  uint64_t Programs::*next_ = &Programs::selected;
  double run_s_ = 0;
  bool open_ = true, rested_ = true, begins_ = false, interrupt_ = false;
};

}  // namespace nc::test
