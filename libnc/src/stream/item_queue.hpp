// SPDX-License-Identifier: Apache-2.0
// The items that a block has made and that nobody has taken yet, in the order of the stream. The interpreter puts them in at the end, the
// part system takes them from the front; both see this type, because it is asked twice for every item.
#pragma once

#include "base/arena.hpp"
#include "stream/stream.hpp"

namespace nc {

class ItemQueue {
 public:
  static constexpr unsigned kCapacity = 64;

  /// Lays it out in `arena`; with a measuring arena it only counts.
  void create(Arena& arena) { item_ = arena.make<Item>(kCapacity); }
  bool empty() const { return count_ == 0; }
  unsigned size() const { return count_; }
  unsigned room() const { return kCapacity - count_; }
  /// The first of them, nullptr = none.
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
  /// Takes the front off.
  void pop() {
    ++head_;
    if (--count_ == 0) head_ = 0;  // from the first place again: a short queue stays in the cache
  }
  /// Gives up those from `number` on.
  void cut(unsigned number) { count_ = number; }
  void clear() { head_ = count_ = 0; }

 private:
  Item* item_ = nullptr;
  unsigned head_ = 0, count_ = 0;
};

}  // namespace nc
