// SPDX-License-Identifier: Apache-2.0
// The items that a block has made and that have not been taken yet, in the order of the stream. The interpreter adds them at the end, the part system
// takes them from the front. Both use this type directly, without a function call into another file, because it is used twice for every item.
#pragma once

#include "base/arena.hpp"
#include "stream/stream.hpp"

namespace nc {

class ItemQueue {
 public:
  static constexpr unsigned kCapacity = 64;

  /// Takes memory from `arena`; a measuring arena only counts it.
  void create(Arena& arena) { item_ = arena.make<Item>(kCapacity); }
  bool empty() const { return count_ == 0; }
  unsigned size() const { return count_; }
  unsigned room() const { return kCapacity - count_; }
  /// The first item, nullptr = there is none.
  Item* front() { return count_ == 0 ? nullptr : &item_[head_ % kCapacity]; }
  /// Number 0 is the front; `number` is below size().
  const Item& operator[](unsigned number) const { return item_[(head_ + number) % kCapacity]; }
  Item& operator[](unsigned number) { return item_[(head_ + number) % kCapacity]; }
  /// A place at the end, with what has stood there before: whoever asks for it fills it. There has to be room.
  Item& add() {
    Item& item = item_[(head_ + count_) % kCapacity];
    ++count_;
    return item;
  }
  /// Removes the first item.
  void pop() {
    ++head_;
    if (--count_ == 0) head_ = 0;  // a queue that is empty begins at its first place again, so that a short one stays in the cache
  }
  /// Removes the items from `number` on.
  void cut(unsigned number) { count_ = number; }
  void clear() { head_ = count_ = 0; }

 private:
  Item* item_ = nullptr;
  unsigned head_ = 0, count_ = 0;
};

}  // namespace nc
