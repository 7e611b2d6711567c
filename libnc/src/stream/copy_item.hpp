// SPDX-License-Identifier: Apache-2.0
// Copying an item for less than the size of a move, of which there is one in three: marks, actions and the rest are a quarter as large.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "stream/stream.hpp"

namespace nc {

static_assert(std::is_trivially_copyable_v<Item> && std::is_standard_layout_v<Item>);

inline void copy_item(const Item& from, Item* to) {
  constexpr size_t kLargest = std::max({sizeof(Action), sizeof(Gate), sizeof(Sync), sizeof(Mark), sizeof(Fault), sizeof(End)});
  if (from.kind == ItemKind::move) {
    *to = from;
  } else {
    std::memcpy(static_cast<void*>(to), &from, offsetof(Item, move) + kLargest);
  }
}

}  // namespace nc
