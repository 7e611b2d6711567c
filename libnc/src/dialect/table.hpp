// SPDX-License-Identifier: Apache-2.0
// A table of a family: rows that stand somewhere as constants.
#pragma once

namespace nc {

template <class T>
struct Table {
  const T* row = nullptr;
  unsigned size = 0;
  const T* begin() const { return row; }
  const T* end() const { return row + size; }
};

}  // namespace nc
