// SPDX-License-Identifier: Apache-2.0
// A reader waits for a writer that is put aside in the middle of writing, and gives up when it never comes back.
#include "runtime/share/shared_block.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

namespace nc::rt::share {
namespace {

struct Pair {
  std::uint64_t first, second;
};

// The words of a block: its sequence, then the value. An odd sequence says that the value is being written.
class HalfWritten : public testing::Test {
 protected:
  HalfWritten() {
    block_->store({1, 2});
    sequence_->fetch_add(1);
  }
  std::unique_ptr<SharedBlock<Pair>> block_ = std::make_unique<SharedBlock<Pair>>();
  std::atomic<std::uint64_t>* sequence_ = reinterpret_cast<std::atomic<std::uint64_t>*>(block_.get());
};

TEST_F(HalfWritten, TheReaderWaitsForAWriterThatGoesOn) {
  std::thread writer([this] {
    usleep(60'000);
    block_->store({3, 4});
  });
  Pair pair{};
  EXPECT_TRUE(block_->load(&pair));
  writer.join();
  EXPECT_EQ(pair.first, 3u);
  EXPECT_EQ(pair.second, 4u);
}

TEST_F(HalfWritten, TheReaderGivesUpWhenNobodyWrites) {
  Pair pair{};
  EXPECT_FALSE(block_->load(&pair));
}

TEST_F(HalfWritten, TheNextValueOfANewWriterIsWhole) {
  block_->store({5, 6});
  Pair pair{};
  std::uint64_t sequence = 0;
  EXPECT_TRUE(block_->load(&pair, &sequence));
  EXPECT_EQ(pair.first, 5u);
  EXPECT_EQ(sequence % 2, 0u);
}

}  // namespace
}  // namespace nc::rt::share
