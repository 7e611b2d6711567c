// SPDX-License-Identifier: Apache-2.0
// The queue between the interpreter and the part system: items leave it in the order in which they came, however often its ring has wrapped.
#include "stream/item_queue.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <deque>
#include <random>
#include <vector>

namespace nc::test {
namespace {

struct Queue {
  alignas(64) char memory[64 * (sizeof(Item) + 64)];
  Arena arena{memory, sizeof memory};
  ItemQueue items;
  Queue() { items.create(arena); }
  void add(uint32_t line) { items.add().source.line = line; }
};

TEST(ItemQueue, IsAsLongAsSaid) {
  Queue queue;
  EXPECT_TRUE(queue.items.empty());
  EXPECT_EQ(queue.items.front(), nullptr);
  for (uint32_t line = 0; line < ItemQueue::kCapacity; ++line) {
    EXPECT_EQ(queue.items.room(), ItemQueue::kCapacity - line);
    queue.add(line);
  }
  EXPECT_EQ(queue.items.room(), 0u);
  for (uint32_t line = 0; line < ItemQueue::kCapacity; ++line) EXPECT_EQ(queue.items[line].source.line, line);
}

TEST(ItemQueue, GivesUpThoseBehindANumber) {
  Queue queue;
  for (uint32_t line = 0; line < 5; ++line) queue.add(line);
  queue.items.pop();
  queue.items.cut(2);
  ASSERT_EQ(queue.items.size(), 2u);
  EXPECT_EQ(queue.items[0].source.line, 1u);
  EXPECT_EQ(queue.items[1].source.line, 2u);
  queue.items.clear();
  EXPECT_EQ(queue.items.front(), nullptr);
}

// It must behave like a deque.
TEST(ItemQueue, KeepsTheOrderOverManyTurns) {
  Queue queue;
  std::deque<uint32_t> expected;
  std::mt19937 random(1);
  for (uint32_t line = 0; line < 20000; ++line) {
    if (queue.items.room() != 0 && random() % 2 == 0) {
      queue.add(line);
      expected.push_back(line);
    } else if (!expected.empty()) {
      ASSERT_EQ(queue.items.front()->source.line, expected.front());
      queue.items.pop();
      expected.pop_front();
    }
    ASSERT_EQ(queue.items.size(), expected.size());
    for (unsigned i = 0; i < expected.size(); ++i) ASSERT_EQ(queue.items[i].source.line, expected[i]);
  }
}

TEST(ItemQueue, TakesItsMemoryFromTheArena) {
  Arena measuring;
  ItemQueue items;
  items.create(measuring);
  EXPECT_EQ(measuring.used(), ItemQueue::kCapacity * sizeof(Item));
}

}  // namespace
}  // namespace nc::test
