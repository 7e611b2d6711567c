// SPDX-License-Identifier: Apache-2.0
// The events and hits of a setup for an executor that reads ahead but reads its inputs only in the cycle in which it reaches a block. Events and hits
// are assigned to the items when these are committed, in the order of the stream, as in a run that pulls the items. They are kept here until the
// executor reaches the item.
//
// The scan looks at inputs only in a sync, and at skip signals only in a skip move and in some dwells. These items are called listeners. The inputs that the
// first listener that has not been executed is to find are given to the scan early, because nothing looks at them before. All other effects of an event
// (macro interrupt, and that it counts as fired) come when its item has begun, a cycle later. The item of a reset is put off and not executed at all.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "nc/nc.h"
#include "tools/lib/virtual_world.hpp"

namespace nc::tools {

class Foresight {
 public:
  /** @param world must outlive this object, and only this object may fire its events. */
  Foresight(VirtualWorld* world, unsigned axis_count) : world_(*world), axis_count_(axis_count) {}

  /** Takes an item that is to be committed (nc_commit_watch). @return false: it must not be committed now. */
  bool commit(const nc_item& item, uint32_t main_line);

  /** Notes that this item has been executed to its end. */
  void executed(uint64_t serial) { executed_ = serial; }

  /**
   * To be called before a cycle: fires the events whose items have begun. @return true when an event commands reset.
   * @param begun serial of the item in execution
   */
  bool fire(uint64_t begun);

  /** The inputs of the scan in this cycle. `command`: position of the axes. To be called once per cycle. */
  OutsideSignals signals(const nc_axes& command, const nc_axes& work);

 private:
  struct Entry {
    uint64_t serial = 0;
    std::vector<const SetupEvent*> events;
    bool listens = false, put_off = false, fired = false;
  };
  struct Probe {  // the skip move that was committed last; no other one is committed before its sync has been answered
    uint64_t serial = 0;
    VirtualWorld::Touch touch;
    nc_axes from = {}, by = {};
    double part = 0.0;  // part of its way that is done, 0 to 1
    bool away = false;  // it listens to the end of a signal
  };
  void go_back(uint64_t serial);
  uint64_t next_listener() const;
  bool touches(const nc_axes& command);

  VirtualWorld& world_;
  unsigned axis_count_;
  std::deque<Entry> ahead_;  // items that are committed and not executed, if they listen or have events
  Probe probe_;
  uint64_t committed_ = 0, executed_ = 0;
  bool over_ = false;  // an event has commanded reset
};

}  // namespace nc::tools
