// SPDX-License-Identifier: Apache-2.0
// The machine behind an offline run: it is where the last move ended, its clock goes by the length of what
// was done, its inputs and solids are those of the setup. Nothing depends on wall-clock time.
#pragma once

#include <cstdint>
#include <vector>

#include "nc/nc.h"
#include "tools/lib/setup.hpp"

namespace nc::tools {

/** Follows the items of one part system and answers its syncs. */
class VirtualWorld {
 public:
  /** Both must outlive the world. */
  VirtualWorld(const Setup& setup, const nc_system_config& system);

  /**
   * To be called with every item before anything else is done with it: fires the events that are due.
   * An event "when line N" fires with the first item of line N of the main program. A line that calls a sub
   * program shows itself only after the return; then the event fires when the sub program begins, found as
   * the line behind the last one that has ended (`next_line`, 0 = not known).
   * @return true when an event commands reset: the run ends here.
   */
  bool on_item(const nc_item& item, uint32_t next_line) {
    return line_events_.empty() && time_events_.empty() ? reset_ : fire_due(item, next_line);
  }

  /** True while an event waits for a line, so that the caller need not look for `next_line` otherwise. */
  bool waits_for_line() const { return !line_events_.empty(); }

  /**
   * Execute a move: position and clock. A skip move is cut where it first enters a solid whose signal ends
   * it; then *move is changed to what was really done. @return false when nothing was moved at all (the
   * signal was on at the start).
   */
  bool execute(nc_move* move);

  /** A dwell in seconds or spindle turns; none while one of the skip signals is on. // M700 15.3 (2) */
  void dwell(bool turns, double value, uint32_t skip_mask = 0);
  void spindle(double rev_per_min) { spindle_rev_min_ = rev_per_min; }

  /** The world for a sync; a read of the clock lets 1 ms pass. */
  nc_world answer(uint32_t what);

  /** Level of the macro interrupt signal. */
  bool macro_interrupt() const { return interrupt_; }

  const nc_axes& machine() const { return machine_; }
  double seconds() const { return seconds_; }
  /** Set the clock where another executor measures the time. */
  void set_seconds(double seconds) { seconds_ = seconds; }
  uint32_t input(unsigned word) const { return input_[word]; }
  bool optional_stop() const { return setup_.optional_stop; }

  /** Skip signals that are on at a place in machine coordinates: bit n = signal n+1. */
  uint32_t signals_at(const nc_axes& machine) const;

 private:
  bool fire_due(const nc_item& item, uint32_t next_line);
  void fire(const SetupEvent& event);
  double first_entry(const nc_move& move) const;

  const Setup& setup_;
  unsigned axis_count_;
  nc_axes machine_;
  nc_axes skip_machine_;
  bool skipped_ = false;
  uint32_t input_[NC_WORDS];
  double seconds_ = 0.0;
  double spindle_rev_min_ = 0.0;
  bool reset_ = false;
  bool interrupt_ = false;
  bool called_ = false;  // a sub program has begun since the last item of the main program
  std::vector<const SetupEvent*> line_events_, time_events_;  // not yet fired
};

}  // namespace nc::tools
