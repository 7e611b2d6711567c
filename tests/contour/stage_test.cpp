// SPDX-License-Identifier: Apache-2.0
// The stage of pending moves alone: what it waits for, what it gives out, from where it can continue, and what it does not wait for.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "alarm/condition.hpp"
#include "contour/contour.hpp"

namespace nc::test {
namespace {

struct Stage : ContourStage {
  explicit Stage(uint32_t rotary = 0) : memory(65536) {
    Arena arena(memory.data(), memory.size());
    create(3, rotary, 'C', 'R', arena);
    if (arena.overflowed()) std::abort();
  }
  std::vector<char> memory;
};

AxisVec point(double x, double y, double z = 0) {
  AxisVec a;
  a[0] = x, a[1] = y, a[2] = z;
  return a;
}

Item line(const AxisVec& from, const AxisVec& to, Corner corner = Corner::none, double size = 0) {
  Item item;
  item.kind = ItemKind::move;
  Move& move = *new (&item.move) Move(from, to, Compensation{});
  move.corner = corner;
  move.corner_mm = size;
  move.plane = Plane::xy;
  return item;
}

Item mark(BlockSeq seq, bool block_end = true) {
  Item item;
  new (&item.mark) Mark();
  item.mark.seq = seq;
  item.block_end = block_end;
  return item;
}

Item action() {
  Item item;
  item.kind = ItemKind::action;
  new (&item.action) Action();
  return item;
}

Item of_kind(ItemKind kind) {
  Item item = action();
  item.kind = kind;
  return item;
}

/// Items as text, as "8,0 10,2c |1 10,10 |2": the ends of moves (c: the cut of a corner), and marks behind a |.
std::string text_of(const Item& item) {
  char text[80];
  switch (item.kind) {
    case ItemKind::move:
      std::snprintf(text, sizeof text, "%.6g,%.6g%s", std::nearbyint(item.move.end[0] * 1e9) / 1e9 + 0.0, std::nearbyint(item.move.end[1] * 1e9) / 1e9 + 0.0,
                    item.move.connecting ? "c" : "");
      return text;
    case ItemKind::mark: return "|" + std::to_string(item.mark.seq);
    case ItemKind::action: return "M";
    case ItemKind::alarm: return "alarm " + std::to_string(static_cast<int>(item.alarm.condition));
    default: return "other";
  }
}

std::string text_of(const std::vector<Item>& items) {
  std::string all;
  for (const Item& item : items) all += (all.empty() ? "" : " ") + text_of(item);
  return all;
}

std::string alarm(Condition condition) { return "alarm " + std::to_string(static_cast<int>(condition)); }

struct Passed {
  std::vector<Item> items;
  std::vector<ContourResume> resume;  ///< the state after each of them
};

void fetch(ContourStage& stage, Passed* passed) {
  Item out;
  while (stage.pop(out)) {
    passed->items.push_back(out);
    passed->resume.push_back(stage.resume_point());
  }
}

Passed pass(ContourStage& stage, const std::vector<Item>& items, size_t first = 0) {
  Passed passed;
  for (size_t i = first; i < items.size(); ++i) {
    EXPECT_TRUE(stage.push(items[i]));
    fetch(stage, &passed);
  }
  return passed;
}

std::string passed(const std::vector<Item>& items) {
  Stage stage;
  return text_of(pass(stage, items).items);
}

const AxisVec kA = point(0, 0), kK = point(10, 0), kB = point(10, 10), kC = point(0, 10);

TEST(Contour, APendingMoveWaitsForTheNextOneWithAllThatComesBetween) {
  Stage stage;
  Passed out;
  EXPECT_TRUE(stage.idle());
  EXPECT_FALSE(stage.takes(line(kA, kK), {}, true));
  EXPECT_TRUE(stage.takes(line(kA, kK, Corner::chamfer, 2), {}, true));
  for (const Item& item : {line(kA, kK, Corner::chamfer, 2), mark(1), action(), mark(2, false)}) stage.push(item), fetch(stage, &out);
  EXPECT_EQ(text_of(out.items), "");
  EXPECT_FALSE(stage.idle());
  stage.push(line(kK, kB)), fetch(stage, &out);
  // The cut belongs to its block: single block stops after it.
  EXPECT_EQ(text_of(out.items), "8,0 10,2c |1 M |2 10,10");
  EXPECT_TRUE(stage.idle());
  EXPECT_EQ(out.items[5].move.start, point(10, 2));  // the next line begins where the cut ends
  EXPECT_EQ(out.items[1].move.start, point(8, 0));
}

TEST(Contour, APendingMoveBehindAPendingMove) {
  EXPECT_EQ(passed({line(kA, kK, Corner::chamfer, 2), mark(1), line(kK, kB, Corner::rounding, 3), mark(2), line(kB, kC), mark(3)}),
            "8,0 10,2c |1 10,7 7,10c |2 0,10 |3");
  // If two cuts are together as long as the line between them, only the cuts are left of it; longer ones are refused.
  EXPECT_EQ(passed({line(kA, kK, Corner::chamfer, 4), mark(1), line(kK, kB, Corner::chamfer, 6), mark(2), line(kB, kC)}),
            "6,0 10,4c |1 10,4 4,10c |2 0,10");
  EXPECT_EQ(passed({line(kA, kK, Corner::chamfer, 4), mark(1), line(kK, kB, Corner::chamfer, 6.001), mark(2), line(kB, kC)}),
            "6,0 10,4c |1 " + alarm(Condition::corner_short));
}

TEST(Contour, WhatCannotBeWaitedForStopsBeforeThePendingMove) {
  const Item pending = line(kA, kK, Corner::chamfer, 2);
  const std::string no_move = alarm(Condition::corner_no_move);
  EXPECT_EQ(passed({pending, mark(1), action(), mark(2), line(kK, kB)}), no_move);  // a block without a movement
  for (const ItemKind kind : {ItemKind::sync, ItemKind::end}) EXPECT_EQ(passed({pending, mark(1), of_kind(kind)}), no_move);
  Item own = of_kind(ItemKind::alarm);  // the next block is in alarm itself: that is what has to be mended
  own.alarm = Fault{};
  own.alarm.condition = Condition::arc_center;
  EXPECT_EQ(passed({pending, mark(1), own}), alarm(Condition::arc_center));
  EXPECT_EQ(passed({line(point(0, 5), kA), mark(1), pending, mark(2), mark(3, false), own}), "0,0 |1 " + alarm(Condition::arc_center));
  EXPECT_EQ(passed({pending, mark(1), action(), mark(2), own}), no_move);  // a block without a movement lies between
  Item rapid = line(kK, kB);
  rapid.move.kind = NC_MOVE_RAPID;
  EXPECT_EQ(passed({pending, mark(1), rapid}), no_move);
  Item arc = line(kK, kB);
  arc.move.circular = true;
  EXPECT_EQ(passed({pending, mark(1), arc}), alarm(Condition::corner_arc));
  EXPECT_EQ(passed({line(kA, kK, Corner::chamfer, 10.001), mark(1)}), alarm(Condition::corner_short));
  EXPECT_EQ(passed({line(kA, kK, Corner::chamfer, 9), mark(1), line(kK, point(10, 8.9))}), alarm(Condition::corner_next_short));
  EXPECT_EQ(passed({line(kA, kK, Corner::chamfer, 10), mark(1), line(kK, kB)}), "0,0 10,10c |1 10,10");  // equal lengths are allowed
  std::vector<Item> many{pending, mark(1)};  // macro statements, which have a mark each but are no blocks
  for (unsigned i = 0; i < 40; ++i) many.push_back(mark(2 + i, false));
  EXPECT_EQ(passed(many), alarm(Condition::pre_read));
  many.resize(28);
  many.push_back(line(kK, kB));
  EXPECT_NE(passed(many).find("10,10"), std::string::npos);
}

TEST(Contour, ARoundingTakesWhatTheTurnAsksFor) {
  // Sharper than a right angle t is longer than the radius: R 3, turn 135 deg, t = 3 tan 67.5 = 7.24.
  const AxisVec back = point(10 - 20 / std::sqrt(2.0), 20 / std::sqrt(2.0));
  EXPECT_EQ(passed({line(kA, kK, Corner::rounding, 3), mark(1), line(kK, back)}).substr(0, 8), "2.75736,");
  EXPECT_EQ(passed({line(point(5, 0), kK, Corner::rounding, 3), mark(1), line(kK, back)}), alarm(Condition::corner_short));
  EXPECT_EQ(passed({line(kA, kK, Corner::rounding, 3), mark(1), line(kK, point(6, 4))}), alarm(Condition::corner_next_short));
  EXPECT_EQ(passed({line(kA, kK, Corner::rounding, 3), mark(1), line(kK, kA)}), alarm(Condition::corner_reversal));  // a way back
  EXPECT_EQ(passed({line(kA, kK, Corner::rounding, 3), mark(1), line(kK, point(20, 0))}), "10,0 |1 20,0");        // straight on
}

TEST(Contour, ARotaryAxisIsNoLength) {
  Stage stage(1u << 2);
  const Passed out = pass(stage, {line(kA, point(10, 0, 90), Corner::chamfer, 2), mark(1), line(point(10, 0, 90), point(10, 10, 90))});
  ASSERT_EQ(out.items.size(), 4u);
  EXPECT_EQ(out.items[0].move.end, point(8, 0, 72));  // the rotary axis has its share
  EXPECT_EQ(out.items[1].move.end, point(10, 2, 90));
}

TEST(Contour, NothingIsLeftBehindAReset) {
  Stage stage;
  Passed out;
  for (const Item& item : {line(kA, kK, Corner::chamfer, 2), mark(1), action()}) stage.push(item), fetch(stage, &out);
  stage.reset();
  EXPECT_TRUE(stage.idle());
  fetch(stage, &out);
  EXPECT_TRUE(out.items.empty());
  EXPECT_EQ(passed({line(kA, kK), mark(1)}), "10,0 |1");
  // The stage does not wait after an alarm either, which ends the reading.
  pass(stage, {line(kA, kK, Corner::chamfer, 20), mark(1), line(kK, kB)});
  EXPECT_FALSE(stage.idle());
  stage.reset();
  EXPECT_TRUE(stage.idle());
}

/// A random sequence of lines with and without corners, with marks and actions in between.
std::vector<Item> random_row(std::mt19937& random) {
  const auto real = [&random](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  std::vector<Item> items;
  AxisVec at;
  const unsigned lines = 3 + random() % 8;
  double direction = real(-3, 3);
  for (unsigned i = 0; i < lines; ++i) {
    direction += real(-2, 2);  // at most 115 deg: t is up to 1.57 R
    const double length = real(20, 40);
    AxisVec next = at;
    next[0] += length * std::cos(direction), next[1] += length * std::sin(direction);
    if (random() % 3 == 0) next[2] += real(-5, 5);
    const Corner corner = i + 1 == lines ? Corner::none : static_cast<Corner>(random() % 3);
    items.push_back(line(at, next, corner, real(0.1, 6)));
    items.push_back(mark(i + 1));
    if (random() % 3 == 0) items.push_back(action());
    at = next;
  }
  return items;
}

TEST(ContourProperty, ThePathIsOnePieceAndARoundingTouchesBothLines) {
  std::mt19937 random(1);
  for (unsigned n = 0; n < 500; ++n) {
    SCOPED_TRACE(n);
    Stage stage;
    const Passed out = pass(stage, random_row(random));
    const Move* last = nullptr;
    for (const Item& item : out.items) {
      ASSERT_NE(item.kind, ItemKind::alarm);
      if (item.kind != ItemKind::move) continue;
      const Move& m = item.move;
      for (unsigned i = 0; last != nullptr && i < 3; ++i) {
        ASSERT_NEAR(m.start[i], last->end[i], 1e-9);
      }
      if (m.circular) {
        const Circle& c = m.circle;
        for (const double share : {0.0, 1.0}) {
          const AxisVec& p = share == 0 ? m.start : m.end;
          ASSERT_NEAR(c.center[0] + c.radius_start * std::cos(c.angle_start + share * c.sweep), p[0], 1e-9);
          ASSERT_NEAR(c.center[1] + c.radius_start * std::sin(c.angle_start + share * c.sweep), p[1], 1e-9);
        }
        // The arc must begin along the line before it, that is, at right angles to the radius, in the direction of the arc.
        const double dx = last->end[0] - last->start[0], dy = last->end[1] - last->start[1], length = std::hypot(dx, dy);
        const double sense = c.sweep > 0 ? 1 : -1;
        if (length > 1e-6) {
          ASSERT_NEAR(dx / length, -sense * std::sin(c.angle_start), 1e-6);
          ASSERT_NEAR(dy / length, sense * std::cos(c.angle_start), 1e-6);
        }
      } else if (last != nullptr && last->circular) {
        const double dx = m.end[0] - m.start[0], dy = m.end[1] - m.start[1], length = std::hypot(dx, dy);
        const double angle = last->circle.angle_start + last->circle.sweep, sense = last->circle.sweep > 0 ? 1 : -1;
        if (length > 1e-6) {
          ASSERT_NEAR(dx / length, -sense * std::sin(angle), 1e-6);
          ASSERT_NEAR(dy / length, sense * std::cos(angle), 1e-6);
        }
      }
      last = &m;
    }
  }
}

TEST(ContourProperty, FromEveryMarkItGoesOnAsItDid) {
  std::mt19937 random(2);
  unsigned beside = 0;
  for (unsigned n = 0; n < 300; ++n) {
    SCOPED_TRACE(n);
    const std::vector<Item> items = random_row(random);
    Stage stage;
    const Passed whole = pass(stage, items);
    for (size_t i = 0; i < whole.items.size(); ++i) {
      if (whole.items[i].kind != ItemKind::mark) continue;
      size_t from = 0;  // the text behind this mark
      while (items[from].kind != ItemKind::mark || items[from].mark.seq != whole.items[i].mark.seq) ++from;
      Stage again;
      pass(again, items);  // so that it holds something else before
      again.restore(whole.resume[i]);
      beside += whole.resume[i].displaced;
      const Passed rest = pass(again, items, from + 1);
      ASSERT_EQ(text_of(rest.items), text_of(std::vector<Item>(whole.items.begin() + static_cast<long>(i) + 1, whole.items.end())));
      for (size_t k = 0; k < rest.items.size(); ++k) {
        if (rest.items[k].kind == ItemKind::move) {
          ASSERT_EQ(rest.items[k].move.start, whole.items[i + 1 + k].move.start);
          ASSERT_EQ(rest.items[k].move.end, whole.items[i + 1 + k].move.end);
        }
        ASSERT_EQ(in_force(rest.resume[k]), in_force(whole.resume[i + 1 + k]));
      }
    }
  }
  EXPECT_GT(beside, 100u);
}

}  // namespace
}  // namespace nc::test
