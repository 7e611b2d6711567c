// SPDX-License-Identifier: Apache-2.0
// The items that a block has made and that have not been taken yet, in the order of the stream. The interpreter adds them at the end, the part system
// takes them from the front. Both use this type directly, without a function call into another file, because it is used twice for every item.
#pragma once

#include "base/arena.hpp"
#include "stream/stream.hpp"

namespace nc {

/// A ring. Its two ends are kept as addresses: the size of an item is no power of two, and its number would be multiplied by it each time.
class ItemQueue {
 public:
  static constexpr unsigned kCapacity = 64;

  /// Takes memory from `arena`; a measuring arena only counts it.
  void create(Arena& arena) {
    begin_ = front_ = back_ = arena.make<Item>(kCapacity);
    if (begin_ != nullptr) last_ = begin_ + (kCapacity - 1);
  }
  bool empty() const { return count_ == 0; }
  unsigned size() const { return count_; }
  unsigned room() const { return kCapacity - count_; }
  /// The first item, nullptr = there is none.
  Item* front() { return count_ == 0 ? nullptr : front_; }
  /// Number 0 is the front; `number` is below size().
  const Item& operator[](unsigned number) const { return *at(number); }
  Item& operator[](unsigned number) { return *at(number); }
  /// A place at the end, with what has stood there before: whoever asks for it fills it. There has to be room.
  Item& add() {
    Item& item = *back_;
    back_ = behind(back_);
    ++count_;
    return item;
  }
  /// Removes the first item.
  void pop() {
    if (--count_ == 0) front_ = back_ = begin_;  // a queue that is empty begins at its first place again, so that a short one stays in the cache
    else front_ = behind(front_);
  }
  /// Removes the items from `number` on.
  void cut(unsigned number) {
    count_ = number;
    back_ = at(number);
  }
  void clear() { cut(0); }

 private:
  Item* behind(Item* item) const { return item == last_ ? begin_ : item + 1; }
  Item* at(unsigned number) const {
    const auto to_the_end = static_cast<unsigned>(last_ - front_) + 1;
    return number < to_the_end ? front_ + number : begin_ + (number - to_the_end);
  }

  Item *begin_ = nullptr, *last_ = nullptr;  ///< the places
  Item *front_ = nullptr, *back_ = nullptr;  ///< the first item, and the place behind the last one
  unsigned count_ = 0;
};

}  // namespace nc
