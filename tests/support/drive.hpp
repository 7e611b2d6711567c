// SPDX-License-Identifier: Apache-2.0
// Drives a control on the bench as a machine does: in each cycle the feeder, the inputs, one scan, and its events.
#pragma once

#include <string>
#include <vector>

#include "support/pull.hpp"

namespace nc::test {

class Drive {
 public:
  /// Selects `text`. The test presses cycle start itself, for example with press_start().
  Drive(Bench& bench, const std::string& text) : control_(bench.control()) {
    bench.start(text);
    in.feed_override = in.rapid_override = 1;
    in.spindle[0].rev_per_s = 50;
  }

  nc_inputs in{};                ///< of the next cycle
  nc_outputs out{};              ///< of the last one
  unsigned cycle = 0;            ///< cycles done
  unsigned fin_cycles = 1;       ///< FIN answers a strobe after so many cycles
  std::vector<nc_event> events;  ///< all events since the beginning
  size_t fresh = 0;              ///< index in `events` of the first event of the last cycle
  uint64_t dropped = 0;          ///< events that were lost
  bool ended = false;            ///< the end has been executed

  /// One cycle. `feed` is the budget of the feeder in blocks; with 0 it is not called.
  void step(unsigned feed = 100) {
    if (feed != 0) nc_feed(control_, feed);
    waited_ = out.strobe != 0 ? waited_ + 1 : 0;
    in.fin = waited_ >= fin_cycles;
    nc_cycle(control_, &in, &out);
    ++cycle;
    fresh = events.size();
    nc_event event;
    while (nc_event_poll(control_, 0, &event, &dropped) == NC_OK) {
      events.push_back(event);
      ended = ended || event.kind == NC_ITEM_END;
    }
  }
  /// To be called before each step: presses cycle start for one cycle, number 2 counted from 0, as a finger would.
  void press_start() { in.cycle_start = cycle == 2; }
  /// End points of the moves that have been executed.
  std::vector<nc_axes> ends() const {
    std::vector<nc_axes> all;
    for (const nc_event& event : events)
      if (event.kind == NC_ITEM_MOVE) all.push_back(event.machine);
    return all;
  }
  std::string alarm() const {
    nc_alarm alarm{};
    return nc_alarm_get(control_, 0, &alarm) == NC_OK ? alarm.code : "";
  }

 private:
  nc_control* control_;
  unsigned waited_ = 0;
};

}  // namespace nc::test
