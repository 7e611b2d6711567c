// SPDX-License-Identifier: Apache-2.0
// Local and common variables, the journal, rewinding.
#include "macro/variables.hpp"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <random>
#include <vector>

namespace nc::test {
namespace {

/// As the option of 600 sets of M700 13.4 has them.
CommonRanges six_hundred_sets() {
  CommonRanges ranges;
  ranges.first[0] = 100, ranges.last[0] = 199;
  ranges.first[1] = 500, ranges.last[1] = 999;
  ranges.first_named = 500, ranges.named = 20;
  return ranges;
}

class VariablesTest : public testing::Test {
 protected:
  explicit VariablesTest(unsigned journal = 64, CommonRanges ranges = six_hundred_sets()) {
    common.create(ranges, arena);
    variables.create(&common, kLocals, journal, arena);
  }
  Value get(uint32_t number, unsigned level = 0) {
    Value v = Value::of(-999);
    EXPECT_TRUE(variables.get(number, level, &v)) << number;
    return v;
  }
  void set(uint32_t number, double x, BlockSeq seq = 1, unsigned level = 0) {
    EXPECT_TRUE(variables.set(number, level, Value::of(x), seq)) << number;
  }

  std::unique_ptr<char[]> memory = std::make_unique_for_overwrite<char[]>(256 << 10);
  Arena arena{memory.get(), 256 << 10};
  CommonVariables common;
  Variables variables;
};

TEST_F(VariablesTest, RangesOfSixHundredSets) {  // M700 13.4 (2)
  for (uint32_t n : {1u, 33u, 100u, 199u, 500u, 999u}) {
    EXPECT_TRUE(get(n).vacant) << n;
    set(n, n + 0.5);
    EXPECT_EQ(get(n).number, n + 0.5);
    EXPECT_FALSE(get(n).vacant);
  }
  Value v;
  for (uint32_t n : {0u, 34u, 99u, 200u, 499u, 1000u, 900000u, 0xffffffffu}) {
    EXPECT_FALSE(variables.get(n, 0, &v)) << n;
    EXPECT_FALSE(variables.set(n, 0, Value::of(1), 1)) << n;
  }
}

TEST_F(VariablesTest, VacantCanBeStored) {
  set(100, 5);
  variables.set(100, 0, Value{}, 2);
  EXPECT_TRUE(get(100).vacant);
}

TEST_F(VariablesTest, LevelsAreIndependent) {  // M700 13.5.5
  for (unsigned level = 0; level < kLocalLevels; ++level) set(7, level * 10.0, 1, level);
  for (unsigned level = 0; level < kLocalLevels; ++level) EXPECT_EQ(get(7, level).number, level * 10.0);
  Value arguments[kLocals];
  arguments[0] = Value::of(60);
  arguments[18] = Value::of(100);
  variables.enter(1, arguments, 2);
  EXPECT_EQ(get(1, 1).number, 60);
  EXPECT_EQ(get(19, 1).number, 100);
  EXPECT_TRUE(get(7, 1).vacant);  // an argument that was not given is vacant, and not that of an earlier call
  EXPECT_EQ(get(7, 0).number, 0);
  variables.clear_locals(3);
  for (unsigned level = 0; level < kLocalLevels; ++level) EXPECT_TRUE(get(7, level).vacant);
}

TEST_F(VariablesTest, NextCommon) {
  set(150, 1);
  set(700, 2);
  set(999, 3);
  uint32_t n = 0;
  double v = 0;
  std::map<uint32_t, double> all;
  for (uint32_t from = 0; common.next(from, &n, &v); from = n + 1) all[n] = v;
  EXPECT_EQ(all, (std::map<uint32_t, double>{{150, 1}, {700, 2}, {999, 3}}));
  EXPECT_FALSE(common.next(1000, &n, &v));
}

class ExtendedVariables : public VariablesTest {
 protected:
  ExtendedVariables() : VariablesTest(64, {{900000, 100, 500}, {907399, 149, 549}}) {}
};

TEST_F(ExtendedVariables, RangesInAnyOrder) {
  for (uint32_t n : {900000u, 907399u, 149u, 549u}) set(n, n);
  Value v;
  for (uint32_t n : {907400u, 150u, 550u}) EXPECT_FALSE(variables.get(n, 0, &v));
  uint32_t n = 0;
  double x = 0;
  ASSERT_TRUE(common.next(0, &n, &x));
  EXPECT_EQ(n, 149u);
  ASSERT_TRUE(common.next(150, &n, &x));
  EXPECT_EQ(n, 549u);
  ASSERT_TRUE(common.next(550, &n, &x));
  EXPECT_EQ(n, 900000u);
}

TEST_F(VariablesTest, Rewind) {
  set(100, 1, 1);
  set(100, 2, 2);
  set(100, 3, 3);
  set(5, 4, 3);
  variables.set(100, 0, Value{}, 4);
  EXPECT_TRUE(variables.rewind(3, nullptr, nullptr));
  EXPECT_EQ(get(100).number, 3);
  EXPECT_EQ(get(5).number, 4);
  EXPECT_TRUE(variables.rewind(1, nullptr, nullptr));
  EXPECT_EQ(get(100).number, 1);
  EXPECT_TRUE(get(5).vacant);
  EXPECT_TRUE(variables.rewind(0, nullptr, nullptr));
  EXPECT_TRUE(get(100).vacant);
  set(100, 9, 1);  // and goes on from there
  EXPECT_EQ(get(100).number, 9);
}

TEST_F(VariablesTest, ForeignKeysGoBackToTheirOwnerNewestFirst) {
  std::vector<std::pair<uint32_t, double>> undone;
  variables.note(1, Variables::kForeignKey + 7, JournalValue::of(1.5));
  variables.note(2, Variables::kForeignKey + 8, JournalValue::of(2.5));
  variables.note(2, Variables::kForeignKey + 7, JournalValue::of(3.5));
  variables.rewind(1, &undone, [](void* self, uint32_t key, JournalValue old) {
    static_cast<std::vector<std::pair<uint32_t, double>>*>(self)->emplace_back(key - Variables::kForeignKey, old.as<double>());
  });
  EXPECT_EQ(undone, (std::vector<std::pair<uint32_t, double>>{{7, 3.5}, {8, 2.5}}));
}

class SmallJournal : public VariablesTest {
 protected:
  SmallJournal() : VariablesTest(8) {}
};

TEST_F(SmallJournal, ForgetsTheOldestFirst) {
  for (unsigned i = 1; i <= 20; ++i) set(100, i, i);
  EXPECT_FALSE(variables.rewind(11, nullptr, nullptr));  // 12 has been forgotten
  EXPECT_EQ(get(100).number, 20);                        // and nothing was changed
  EXPECT_TRUE(variables.rewind(12, nullptr, nullptr));
  EXPECT_EQ(get(100).number, 12);
}

/// Any sequence of writes and rewinds is compared with complete copies.
TEST_F(VariablesTest, RewindEqualsACopy) {
  std::mt19937 random(6);
  const uint32_t numbers[] = {1, 2, 33, 100, 199, 500, 999};
  using Snapshot = std::vector<std::pair<bool, double>>;
  const auto snapshot = [&] {
    Snapshot s;
    for (uint32_t n : numbers) {
      for (unsigned level = 0; level < kLocalLevels; ++level)
        s.emplace_back(get(n, level).vacant, get(n, level).or_zero());
    }
    return s;
  };
  std::vector<Snapshot> after{snapshot()};  // after[seq]
  for (int round = 0; round < 3000; ++round) {
    if (random() % 6 == 0) {
      const BlockSeq to = after.size() > 4 ? after.size() - 1 - random() % 4 : random() % after.size();
      ASSERT_TRUE(variables.rewind(to, nullptr, nullptr));
      after.resize(to + 1);
      ASSERT_EQ(snapshot(), after[to]);
      continue;
    }
    for (unsigned i = 0, n = random() % 3; i < n; ++i) {
      const Value v = random() % 5 == 0 ? Value{} : Value::of(static_cast<double>(random() % 1000));
      variables.set(numbers[random() % 7], random() % kLocalLevels, v, after.size());
    }
    after.push_back(snapshot());
  }
}

}  // namespace
}  // namespace nc::test
