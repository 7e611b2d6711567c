// SPDX-License-Identifier: Apache-2.0
// Records whose changes are journalled: changes by blocks and from outside, rewinding, and views of earlier states.
#include "macro/journalled.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

namespace nc::test {
namespace {

struct Point {
  double x = 1;
  uint32_t line = 2;
  uint16_t file = 3;
  bool on = false;
  int8_t side = -1;
  bool operator==(const Point&) const = default;
};
struct Word {
  uint32_t bits = 0;
  bool operator==(const Word&) const = default;
};
struct FirstGroup {
  Point point;
  Point points[3];
  bool operator==(const FirstGroup&) const = default;
};
struct SecondGroup {
  Word word[4];
  uint64_t offset = 0;
  bool operator==(const SecondGroup&) const = default;
};
struct Records : FirstGroup, SecondGroup {
  bool operator==(const Records&) const = default;
};

constexpr uint32_t kFirstKey = 1000;

/// Owns the journal and rewinds it, as the interpreter does.
class Program {
 public:
  explicit Program(unsigned journal = 4096) {
    journal_.create(journal, arena_);
    records.create(&journal_, kFirstKey, arena_);
  }
  void rewind(BlockSeq to) {
    journal_.rewind(to, [this](uint32_t key, JournalValue old) { records.exchange(key - kFirstKey, old); });
  }
  void look_back(BlockSeq to, bool back) {
    journal_.swap(to, back, [this](uint32_t key, JournalValue value) { return records.exchange(key - kFirstKey, value); });
  }
  BlockSeq oldest() const { return journal_.oldest(); }

  Journalled<Records, Program> records;

 private:
  std::unique_ptr<char[]> memory_ = std::make_unique_for_overwrite<char[]>(256 << 10);
  Arena arena_{memory_.get(), 256 << 10};
  Journal journal_;
};

// Only functions that journal can write.
template <class R>
concept CanBeWritten = requires(R records) { records->offset = 1; }
|| requires(R records) { (*records).offset = 1; }
||
    requires(R records) { records.exchange(0, JournalValue{}); };
static_assert(!CanBeWritten<Journalled<Records, Program>&>);
static_assert(CanBeWritten<Records*>);  // shows that the concept is true where writing is possible

TEST(Journalled, BeginsWithTheDefaultsOfItsRecords) {
  Program program;
  EXPECT_EQ(*program.records, Records{});
  EXPECT_EQ(program.records->point.x, 1);
}

TEST(Journalled, TakesBackFieldsOfEveryTypeOverSeveralBlocks) {
  Program program;
  program.records.change(1, &Records::point, &Point::x, 7.5);
  program.records.change(1, &Records::point, &Point::on, true);
  const Records behind_1 = *program.records;
  program.records.change(2, &Records::point, &Point::file, uint16_t{9});
  program.records.change(2, &Records::offset, uint64_t{1} << 60);
  const Records behind_2 = *program.records;
  program.records.change(3, &Records::points, 2, Point{4, 5, 6, true, 7});
  program.records.change(3, &Records::word, 1, {0xffffffffu});
  program.records.change(3, &Records::word, 1, {5});
  EXPECT_EQ(program.records->points[2], (Point{4, 5, 6, true, 7}));
  EXPECT_EQ(program.records->points[1], Point{});
  EXPECT_EQ(program.records->word[1].bits, 5u);
  EXPECT_EQ(program.records->word[0].bits, 0u);
  EXPECT_EQ(program.records->offset, uint64_t{1} << 60);
  program.rewind(2);
  EXPECT_EQ(*program.records, behind_2);
  EXPECT_EQ(program.records->point, (Point{7.5, 2, 9, true, -1}));
  program.rewind(1);
  EXPECT_EQ(*program.records, behind_1);
  program.rewind(0);
  EXPECT_EQ(*program.records, Records{});
}

TEST(Journalled, GoesOnFromWhereItHasBeenRewoundTo) {
  Program program;
  program.records.change(1, &Records::offset, 1);
  program.records.change(2, &Records::offset, 2);
  program.rewind(1);
  program.records.change(2, &Records::offset, 3);
  program.records.change(3, &Records::offset, 4);
  program.rewind(2);
  EXPECT_EQ(program.records->offset, 3u);
  program.rewind(1);
  EXPECT_EQ(program.records->offset, 1u);
}

TEST(Journalled, WhatStaysAsItIsTakesNoPlaceInTheJournal) {
  Program program(4);
  program.records.change(1, &Records::offset, 8);
  for (BlockSeq seq = 2; seq < 100; ++seq) {
    program.records.change(seq, &Records::offset, 8);
    program.records.change(seq, &Records::points, 1, Point{});
  }
  EXPECT_EQ(program.oldest(), 1u);
  program.rewind(0);
  EXPECT_EQ(program.records->offset, 0u);
}

TEST(Journalled, FieldsOfRecordsOfAnArray) {
  Program program;
  program.records.change(1, &Records::points, 1, &Point::x, 5);
  program.records.change(2, &Records::points, 1, &Point::file, 6);
  program.records.change(2, &Records::points, 2, &Point::x, 7);
  EXPECT_EQ(program.records->points[1].x, 5);
  EXPECT_EQ(program.records->points[1].file, 6);
  EXPECT_EQ(program.records->points[1].line, 2u);
  EXPECT_EQ(program.records.key(&Records::points, 1, &Point::x), kFirstKey + 4);
  EXPECT_EQ(program.records.key(&Records::points, 2, &Point::file), kFirstKey + 7);
  program.records.change_from_outside(&Records::points, 1, &Point::x, 8);
  program.rewind(1);
  EXPECT_EQ(program.records->points[1].x, 8);
  EXPECT_EQ(program.records->points[1].file, 3);
  EXPECT_EQ(program.records->points[2].x, 1);
  program.rewind(0);
  EXPECT_EQ(program.records->points[1].x, 8) << "the host has written it";
}

/// Owns records that other part systems have copies of.
class Shared {
 public:
  Shared() {
    journal.create(16, arena_);
    records.create(&journal, kFirstKey, arena_);
  }
  void rewind(BlockSeq to) {
    journal.rewind(to, [this](uint32_t key, JournalValue old) { records.exchange(key - kFirstKey, old); });
  }
  Journalled<Records, Shared, true> records;
  Journal journal;

 private:
  std::unique_ptr<char[]> memory_ = std::make_unique_for_overwrite<char[]>(8 << 10);
  Arena arena_{memory_.get(), 8 << 10};
};

/// A block has written the value that was there already when it was read; then another part system has executed a write of another value.
TEST(Journalled, AWriteOfTheSameValueCountsWhereOthersWriteToo) {
  const uint32_t word = sizeof(FirstGroup) / 8 + 2;  // of `offset`
  Shared shared;
  shared.records.change(1, &Records::offset, 0);
  shared.records.take_published(word, JournalValue{7});
  EXPECT_EQ(shared.records->offset, 0u) << "the block comes behind";
  shared.rewind(0);
  EXPECT_EQ(shared.records->offset, 7u);
  shared.records.take_published(word, JournalValue{9});
  EXPECT_EQ(shared.records->offset, 9u);
  EXPECT_EQ(shared.records.word(word).bytes, 9u);
}

TEST(Journalled, NoRewindTakesBackWhatComesFromOutside) {
  Program program;
  program.records.change(1, &Records::word, 0, {1});
  program.records.change(1, &Records::word, 1, {1});  // the two share a word of the journal
  program.records.change(2, &Records::word, 0, {2});
  program.records.change_from_outside(&Records::word, 0, {77});
  program.records.change_from_outside(&Records::offset, 9);
  program.rewind(1);
  EXPECT_EQ(program.records->word[0].bits, 77u);
  EXPECT_EQ(program.records->word[1].bits, 1u);
  program.rewind(0);
  EXPECT_EQ(program.records->word[0].bits, 77u);
  EXPECT_EQ(program.records->word[1].bits, 0u);
  EXPECT_EQ(program.records->offset, 9u);
}

TEST(Journalled, WhatComesFromOutsideCountsAlsoWhereItIsSoAlready) {
  Program program;
  program.records.change(1, &Records::offset, 5);
  program.records.change_from_outside(&Records::offset, 5);
  program.rewind(0);
  EXPECT_EQ(program.records->offset, 5u);
}

TEST(Journalled, ChangesCountsWhateverMakesADifference) {
  Program program;
  uint64_t before = program.records.changes();
  const auto has_changed = [&] {
    const bool changed = program.records.changes() != before;
    before = program.records.changes();
    return changed;
  };
  program.records.change(1, &Records::point, &Point::line, 3u);
  EXPECT_TRUE(has_changed());
  program.records.change(2, &Records::point, &Point::line, 3u);
  EXPECT_FALSE(has_changed());
  program.records.change_from_outside(&Records::point, Point{});
  EXPECT_TRUE(has_changed());
  program.records.change(3, &Records::point, &Point::on, true);
  EXPECT_TRUE(has_changed());
  program.rewind(2);
  EXPECT_TRUE(has_changed());
}

/// Any sequence of writes, writes from outside and rewinds is compared with complete copies, one for each block.
TEST(Journalled, EqualsACopyOfEverything) {
  std::mt19937 random(15);
  Program program(1 << 12);
  std::vector<Records> after{*program.records};  // after[seq]
  const auto point = [&] {
    return Point{static_cast<double>(random() % 4), static_cast<uint32_t>(random() % 3), static_cast<uint16_t>(random() % 3), random() % 2 == 0, static_cast<int8_t>(random() % 3)};
  };
  const auto write = [&](BlockSeq seq, Records& copy) {
    switch (random() % 6) {
      case 0:
        copy.point = point();
        program.records.change(seq, &Records::point, copy.point);
        break;
      case 1: {
        const unsigned index = random() % 3;
        copy.points[index] = point();
        program.records.change(seq, &Records::points, index, copy.points[index]);
        break;
      }
      case 2: {
        const unsigned index = random() % 4;
        copy.word[index].bits = static_cast<uint32_t>(random() % 3);
        program.records.change(seq, &Records::word, index, copy.word[index]);
        break;
      }
      case 3:
        copy.point.side = static_cast<int8_t>(random());
        program.records.change(seq, &Records::point, &Point::side, copy.point.side);
        break;
      case 4:
        copy.point.x = static_cast<double>(random());
        program.records.change(seq, &Records::point, &Point::x, copy.point.x);
        break;
      default:
        copy.offset = uint64_t{random()} << 32 | random();
        program.records.change(seq, &Records::offset, copy.offset);
    }
  };
  for (int round = 0; round < 20000; ++round) {
    const unsigned what = random() % 12;
    if (what == 0) {
      const BlockSeq to = after.size() - 1 - random() % std::min<size_t>(after.size(), 40);
      program.rewind(to);
      after.resize(to + 1);
    } else if (what == 1) {
      const unsigned index = random() % 4;
      const Word given{static_cast<uint32_t>(random())};
      program.records.change_from_outside(&Records::word, index, given);
      for (Records& copy : after) copy.word[index] = given;
    } else if (what == 2) {
      const BlockSeq to = after.size() - 1 - random() % std::min<size_t>(after.size(), 20);
      program.look_back(to, true);
      ASSERT_EQ(*program.records, after[to]);
      program.look_back(to, false);
    } else {
      Records copy = after.back();
      for (unsigned i = 0, count = random() % 4; i < count; ++i) write(after.size(), copy);
      after.push_back(copy);
    }
    ASSERT_EQ(*program.records, after.back()) << round;
  }
}

}  // namespace
}  // namespace nc::test
