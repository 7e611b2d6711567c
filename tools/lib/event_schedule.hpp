// SPDX-License-Identifier: Apache-2.0
// Decides with which item of the stream an event of the setup begins, for runs that pull the items and for
// executors that are told of the items ahead of time.
#pragma once

#include <cstdint>
#include <vector>

#include "nc/nc.h"
#include "tools/lib/setup.hpp"

namespace nc::tools {

/** The events of a setup that wait for a block or an M code; each is taken once. */
class EventSchedule {
 public:
  /** The setup must outlive the schedule. */
  explicit EventSchedule(const Setup& setup);

  /** True while an event waits. */
  bool any() const { return !waiting_.empty(); }
  bool waits(const SetupEvent& event) const;

  /**
   * Takes out the events that begin with this item, in the order of the setup. A line of the main program begins with the first item that
   * belongs to it; that may be one of a program that the line calls. A line of a program with a number begins with the first item of its own,
   * an M code with its action.
   * @param main_line line of the main program to which the item belongs (nc_main_line_get)
   */
  std::vector<const SetupEvent*> take(const nc_item& item, uint32_t main_line);

  /** Puts back an event whose item was not executed and will come again. */
  void put_back(const SetupEvent* event);

 private:
  std::vector<const SetupEvent*> waiting_;  // in the order of the setup
};

}  // namespace nc::tools
