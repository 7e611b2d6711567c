// SPDX-License-Identifier: Apache-2.0
// What the setup gives to an executor that reads ahead and reads its inputs in the cycle in which it gets to a block. The events and the hits
// are dealt out to the items as they are committed, in the order of the stream, as a run that pulls them does; here it is kept until the
// executor gets there.
//
// The scan looks at inputs only in a sync, and at skip signals only in a skip move and in some dwells: its listeners. What the first listener
// that has not been executed is to find is given to the scan before, because nothing looks at it until then. Everything else of an event
// (macro interrupt, and that it has fired) comes when its item has begun, a cycle later; the item of a reset is put off and not executed at all.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "nc/nc.h"
#include "tools/lib/virtual_world.hpp"

namespace nc::tools {

class Foresight {
 public:
  /** @param world fired by nobody else; must outlive this. */
  Foresight(VirtualWorld* world, unsigned axis_count) : world_(*world), axis_count_(axis_count) {}

  /** An item that is to be committed (nc_commit_watch). @return false: not now. */
  bool commit(const nc_item& item, uint32_t main_line);

  /** This item has been executed to its end. */
  void executed(uint64_t serial) { executed_ = serial; }

  /**
   * Before a cycle: fires what has begun by then. @return true when an event commands reset.
   * @param begun serial of the item in execution
   */
  bool fire(uint64_t begun);

  /** What the scan is to find in this cycle. `command`: where the axes are; once per cycle. */
  OutsideSignals signals(const nc_axes& command, const nc_axes& work);

 private:
  struct Entry {
    uint64_t serial = 0;
    std::vector<const SetupEvent*> events;
    bool listens = false, put_off = false, fired = false;
  };
  struct Probe {  // the skip move that was committed last; none is committed behind it before it has been answered
    uint64_t serial = 0;
    VirtualWorld::Touch touch;
    nc_axes from = {}, by = {};
    double part = 0.0;  // of its way that is done
  };
  void go_back(uint64_t serial);
  uint64_t next_listener() const;
  bool touches(const nc_axes& command);

  VirtualWorld& world_;
  unsigned axis_count_;
  std::deque<Entry> ahead_;  // committed and not executed, of items with something to say
  Probe probe_;
  uint64_t committed_ = 0, executed_ = 0;
  bool over_ = false;  // reset has been commanded
};

}  // namespace nc::tools
