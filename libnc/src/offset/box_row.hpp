// SPDX-License-Identifier: Apache-2.0
// A row of records of which each lies in a box of the plane: which of them come near another box? Blocks that follow each other lie beside each
// other, so the row itself is the order of a tree: over each pair of records lies the box of both, over each two of these another. A question goes
// down from the top and leaves out what is too far away, which takes a number of steps in the order of the logarithm of the row's length.
//
// Records are numbered on without an end and lie in a ring; the oldest are overwritten.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "base/arena.hpp"
#include "offset/plane_vector.hpp"

namespace nc {

struct Box {
  double low[2] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  double high[2] = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  void take(Vec2 p) {
    low[0] = std::min(low[0], p.h);
    low[1] = std::min(low[1], p.v);
    high[0] = std::max(high[0], p.h);
    high[1] = std::max(high[1], p.v);
  }
  void take(const Box& other) {
    for (unsigned i = 0; i < 2; ++i) {
      low[i] = std::min(low[i], other.low[i]);
      high[i] = std::max(high[i], other.high[i]);
    }
  }
  Box grown(double by) const {
    Box box = *this;
    for (unsigned i = 0; i < 2; ++i) {
      box.low[i] -= by;
      box.high[i] += by;
    }
    return box;
  }
  bool touches(const Box& other) const { return low[0] <= other.high[0] && other.low[0] <= high[0] && low[1] <= other.high[1] && other.low[1] <= high[1]; }
};

template <class Record>
class BoxRow {
 public:
  /// Room for at least `count` records that may be asked for at the same time.
  void create(unsigned count, Arena& arena) {
    size_ = std::bit_ceil(std::max(count + count / (kParts - 1) + 2, 2 * kParts));
    top_ = static_cast<unsigned>(std::countr_zero(size_ / kParts));
    records_ = arena.make_blank<Record>(size_);
    boxes_ = arena.make_blank<Box>(size_t{2} * size_);
  }
  uint64_t end() const { return end_; }
  /// None of those from number `first` on has been overwritten, and there is room for one more.
  bool keeps(uint64_t first) const { return size_ != 0 && std::max(written_, end_ + 1) - first <= size_ - size_ / kParts; }
  const Record& operator[](uint64_t number) const { return records_[number & (size_ - 1)]; }

  Record& at(uint64_t number) { return records_[number & (size_ - 1)]; }

  void push(const Record& record, const Box& box) {
    const uint64_t slot = end_ & (size_ - 1);
    records_[slot] = record;
    for (unsigned level = 0; level <= top_; ++level) {
      Box& over = box_at(level, end_ >> level);
      const bool first_in_it = (end_ & ((uint64_t{1} << level) - 1)) == 0;
      if (first_in_it) over = Box{};
      over.take(box);
    }
    ++end_;
    written_ = std::max(written_, end_);
  }
  /// Forgets those from number `end` on. Boxes above them stay as large as they were, which costs time and nothing else.
  void cut(uint64_t end) { end_ = std::min(end, end_); }

  /// Calls `visit(number, record)` for those from number `first` on whose boxes touch this one, until it returns true.
  template <class Visit>
  bool any(uint64_t first, const Box& box, const Visit& visit) const {
    if (first >= end_) return false;
    const unsigned over_all = std::min(top_, static_cast<unsigned>(std::bit_width(first ^ (end_ - 1))));  // one box lies over all of a short row
    for (uint64_t part = first >> over_all; part <= (end_ - 1) >> over_all; ++part)
      if (any_below(over_all, part, first, box, visit)) return true;
    return false;
  }

 private:
  static constexpr unsigned kParts = 16;  ///< trees in the ring: the one that is written anew keeps nothing of what was there

  Box& box_at(unsigned level, uint64_t number) const { return boxes_[(size_t{2} * size_ - (size_t{2} * size_ >> level)) + (number & ((size_ >> level) - 1))]; }

  template <class Visit>
  bool any_below(unsigned level, uint64_t number, uint64_t first, const Box& box, const Visit& visit) const {
    if (number << level >= end_ || (number + 1) << level <= first || !box_at(level, number).touches(box)) return false;
    if (level == 0) return visit(number, (*this)[number]);
    return any_below(level - 1, 2 * number, first, box, visit) || any_below(level - 1, 2 * number + 1, first, box, visit);
  }

  Record* records_ = nullptr;
  Box* boxes_ = nullptr;  ///< first those of one record each, then those of two, ...
  unsigned size_ = 0, top_ = 0;
  uint64_t end_ = 0;      ///< number of the next record
  uint64_t written_ = 0;  ///< the largest that it ever was
};

}  // namespace nc
