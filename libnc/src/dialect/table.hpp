// SPDX-License-Identifier: Apache-2.0
// A table of a family: a pointer to constant rows and their number. The rows themselves are constants in the files of the family.
#pragma once

namespace nc {

template <class T>
struct Table {
  const T* row = nullptr;
  unsigned size = 0;
  constexpr Table() = default;
  constexpr Table(const T* first, unsigned count) : row(first), size(count) {}
  /// All rows of an array.
  template <unsigned n>
  constexpr Table(const T (&rows)[n]) : row(rows), size(n) {}
  const T* begin() const { return row; }
  const T* end() const { return row + size; }
};

}  // namespace nc
