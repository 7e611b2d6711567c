// SPDX-License-Identifier: Apache-2.0
// Who gives up a place: by hand, and what must hold of any crowd.
#include "runtime/services/places.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <random>
#include <vector>

namespace nc::rt::services {
namespace {

TEST(ServicePlaces, TheCrowdedOwnerOfTheLowestRankGivesUpItsMostSilentPlace) {
  const std::vector<Place> taken{{"a", 0, 5, false}, {"b", 0, 1, false}, {"a", 0, 3, false}, {"a", 0, 2, true}, {"c", 1, 0, false}};
  EXPECT_EQ(place_to_give_up(taken, "d", 0), 2u) << "the kept one has been silent longer";
  EXPECT_EQ(place_to_give_up(taken, "d", 2), 2u) << "those of the lowest rank first";
  EXPECT_EQ(place_to_give_up(taken, "b", 0), 2u) << "three against one: afterwards two against two";
  EXPECT_EQ(place_to_give_up(taken, "a", 0), std::nullopt) << "nobody has more than this one";
  EXPECT_EQ(place_to_give_up({}, "a", 0), std::nullopt);
}

TEST(ServicePlaces, EqualsShareAndTheLowerOneNeverTakesFromTheHigher) {
  const std::vector<Place> taken{{"a", 1, 5, false}, {"a", 1, 1, false}, {"b", 1, 3, false}};
  EXPECT_EQ(place_to_give_up(taken, "c", 0), std::nullopt);
  EXPECT_EQ(place_to_give_up(taken, "b", 1), std::nullopt) << "one against two afterwards";
  EXPECT_EQ(place_to_give_up(taken, "c", 1), 1u);
}

// Any crowd that comes in any order and never leaves: ranks are not harmed from below, owners of one rank end as equal as they can be, and it comes to rest.
TEST(ServicePlaces, WhateverComesPlacesAreShared) {
  const char* of_environment = std::getenv("NC_SEEDS");
  const unsigned seeds = of_environment == nullptr ? 300 : static_cast<unsigned>(std::atoi(of_environment));
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto any = [&](unsigned most) { return std::uniform_int_distribution<unsigned>(0, most)(random); };
    const unsigned room = 1 + any(15), owners = 1 + any(7), ranks = any(3);
    std::map<std::string, unsigned> rank_of;
    for (unsigned i = 0; i < owners; ++i) rank_of[std::string(1, static_cast<char>('a' + i))] = any(ranks);
    std::vector<Place> taken;
    std::int64_t time = 0;
    const auto places_of = [&](const std::string& who) {
      unsigned count = 0;
      for (const Place& place : taken) count += place.owner == who;
      return count;
    };
    const auto come = [&](const std::string& who) {
      const unsigned rank = rank_of[who];
      if (taken.size() < room) {
        taken.push_back({who, rank, ++time, false});
        return true;
      }
      const std::vector<Place> before = taken;
      const auto given = place_to_give_up(taken, who, rank);
      if (!given) return false;
      const Place& lost = before[*given];
      EXPECT_FALSE(lost.kept);
      EXPECT_LE(lost.rank, rank);
      EXPECT_NE(lost.owner, who);
      for (const Place& other : before) {
        EXPECT_TRUE(other.kept || lost.rank <= other.rank);
        EXPECT_FALSE(other.owner == lost.owner && !other.kept && other.heard_ns < lost.heard_ns) << "this one has been silent longer";
      }
      const unsigned left = places_of(lost.owner) - 1, now = places_of(who) + 1;
      if (lost.rank == rank) {
        EXPECT_GE(left, now);
      }
      taken[*given] = {who, rank, ++time, false};
      return true;
    };
    bool kept = false;
    for (unsigned step = 0; step < 200; ++step) {
      auto owner = rank_of.begin();
      std::advance(owner, any(owners - 1));
      (void)come(owner->first);
      if (!kept && any(9) == 0) kept = taken[any(static_cast<unsigned>(taken.size()) - 1)].kept = true;
    }
    unsigned moves = 0;
    for (bool moved = true; moved; ++moves) {  // everybody wants as much as there is, until nobody gets more
      ASSERT_LT(moves, 1000u);
      moved = false;
      for (const auto& [who, rank] : rank_of) moved = come(who) || moved;
    }
    for (const auto& [who, rank] : rank_of)
      for (const auto& [other, other_rank] : rank_of) {
        unsigned free = 0;  // places of the other one that can be taken
        for (const Place& place : taken) free += place.owner == other && !place.kept;
        if (free == 0) continue;
        EXPECT_GE(rank_of[other], rank) << who << " is without what a lower one has";
        if (other_rank == rank) {
          EXPECT_LE(places_of(other), places_of(who) + 1) << other << " has more than " << who;
        }
      }
  }
}

}  // namespace
}  // namespace nc::rt::services
