// SPDX-License-Identifier: Apache-2.0
// A move or a dwell of an offline run that an event ends in its middle, and what is left of it. A macro interrupt of type 1 whose program neither moves nor
// gives out M S T B goes on "from the point in the block where the interrupt was caused" (M700 13.12): the control then gives the item again, and only
// the rest of it is executed.
#pragma once

#include "nc/nc.h"
#include "tools/lib/item_source.hpp"

namespace nc::tools {

class CutItem {
 public:
  /** To be called with every item before it is executed: makes an item that was cut the rest of it. `at`: where the axes stand, machine coordinates. */
  void resume(nc_item* item, const nc_axes& at, ItemSource* items);

  /** Changes the move in hand, which is `item`, to the share of it that has been executed. `work`: where it began, workpiece coordinates. */
  void cut_move(nc_item* item, double share, const nc_axes& work, unsigned axis_count, ItemSource* items);
  /** Changes the dwell in hand to what has passed of it. */
  void cut_dwell(nc_item* item, double passed);
  /** Where the axes are at this share of the move in hand, machine coordinates. */
  nc_axes place(const nc_move& move, double share, ItemSource* items) const;

 private:
  bool is_rest(const nc_item& item) const;
  void resume_move(nc_move* move, const nc_axes& at, ItemSource* items);

  // Of the item in hand, seen from the whole item: where it begins, 0 to 1, and its length or the value of the dwell.
  double from_ = 0.0, whole_ = 0.0;
  bool straight_ = false;  // the axes do not stand on its path, to whose end a line leads
  // Of the item that was cut.
  bool waits_ = false;     // it has not come again
  bool served_ = false;    // the interrupt program has ended
  nc_source source_ = {};
  uint8_t kind_ = 0;
  double done_ = 0.0;      // so much of the whole item has been executed, 0 to 1
};

}  // namespace nc::tools
