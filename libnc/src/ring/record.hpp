// SPDX-License-Identifier: Apache-2.0
// What lies in the ring between feeder and scan: items that are committed and never change any more.
#pragma once

#include "ring/segment.hpp"
#include "stream/stream.hpp"

namespace nc {

struct Record {
  Serial serial = 0;
  nc_source source{};
  ItemKind kind = ItemKind::mark;
  bool staged = false;  ///< it has come out of a stage, where the items of neighbouring blocks cannot be told apart
  bool in_hole = false;  ///< Item::in_hole
  uint32_t epoch = 0;   ///< RunWord::epoch() in which it was made: the scan throws records of another epoch away
  union {
    Segment segment;
    Action action;
    Gate gate;
    Sync sync;
    Mark mark;
    Fault alarm;
    End end;
  };
  Record() : mark() {}
};

}  // namespace nc
