// SPDX-License-Identifier: Apache-2.0
// Users take turns in a queue that one of them fills.
#include "runtime/services/turn_table.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace nc::rt::services {
namespace {

struct Asked {
  std::string owner;
  std::uint64_t client = 0;
  unsigned number = 0;
};

class TurnsOfUsers : public testing::Test {
 protected:
  void ask(const std::string& owner, std::uint64_t client, unsigned count) {
    for (unsigned n = 0; n < count; ++n) queue_.push_back({owner, client, number_++});
  }
  Asked next() {
    std::vector<TurnTable::Waiting> waiting;
    for (const Asked& asked : queue_) waiting.push_back({asked.owner, asked.client});
    const auto place = queue_.begin() + static_cast<std::ptrdiff_t>(turns_.take(waiting));
    const Asked asked = *place;
    queue_.erase(place);
    return asked;
  }
  TurnTable turns_;
  std::vector<Asked> queue_;
  unsigned number_ = 0;
};

TEST_F(TurnsOfUsers, WhoAsksForMuchWaitsForHimself) {
  for (std::uint64_t client = 1; client <= 24; ++client) ask("viewer", client, 8);
  EXPECT_EQ(next().owner, "viewer");
  for (unsigned n = 0; n < 20; ++n) {
    ask("setter", 100, 1);
    EXPECT_EQ(next().owner, "setter");
    EXPECT_EQ(next().owner, "viewer") << "and he is not kept waiting either";
  }
}

TEST_F(TurnsOfUsers, TheClientsOfAUserTakeTurns) {
  ask("anna", 1, 50);
  EXPECT_EQ(next().client, 1u);
  ask("anna", 2, 2);
  EXPECT_EQ(next().client, 2u);
  EXPECT_EQ(next().client, 1u);
  EXPECT_EQ(next().client, 2u);
}

// Whatever comes: the requests of a client stay in their order, and a user waits at most once for each other one.
TEST_F(TurnsOfUsers, TheOrderOfAClientIsKept) {
  std::mt19937 random(7);
  std::vector<std::int64_t> last(30, -1);
  std::vector<unsigned> passed(5, 0);
  for (unsigned n = 0; n < 20'000; ++n) {
    const unsigned owner = static_cast<unsigned>(random() % 5);
    if (queue_.size() < 100 && random() % 2 == 0) ask(std::to_string(owner), owner * 6 + random() % 6, static_cast<unsigned>(random() % 4));
    if (queue_.empty()) {
      passed.assign(5, 0);
      continue;
    }
    const Asked asked = next();
    ASSERT_LT(last[asked.client], asked.number);
    last[asked.client] = asked.number;
    const auto whose = static_cast<unsigned>(std::stoi(asked.owner));
    passed[whose] = 0;
    for (unsigned other = 0; other < 5; ++other) {
      bool waits = false;
      for (const Asked& one : queue_) waits |= one.owner == std::to_string(other);
      passed[other] = waits && other != whose ? passed[other] + 1 : 0;
      ASSERT_LE(passed[other], 4u);
    }
  }
}

}  // namespace
}  // namespace nc::rt::services
