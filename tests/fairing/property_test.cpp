// SPDX-License-Identifier: Apache-2.0
// What fairing promises for any polyline: no point moves by more than the length, ends and marks are kept, and a continuation from any mark gives
// the same items.
#include <gtest/gtest.h>

#include "stage_bench.hpp"

namespace nc::test {
namespace {

constexpr unsigned kPaths = 400;

double distance_to_line(const AxisVec& p, const AxisVec& a, const AxisVec& b) {
  double along = 0, length2 = 0;
  for (unsigned i = 0; i < 3; ++i) along += (p[i] - a[i]) * (b[i] - a[i]), length2 += (b[i] - a[i]) * (b[i] - a[i]);
  const double u = length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0;
  AxisVec foot;
  for (unsigned i = 0; i < 3; ++i) foot[i] = a[i] + u * (b[i] - a[i]);
  return gap(p, foot);
}

struct Random {
  std::mt19937 engine;
  explicit Random(uint32_t seed) : engine(seed) {}
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
  unsigned whole(unsigned below) { return static_cast<unsigned>(engine() % below); }
};

/// Long and short lines, zigzags, spikes, reversals, curves; rounded to micrometres.
std::vector<Point> random_path(Random& random) {
  std::vector<Point> points{{0, 0, 0}};
  double heading = 0;
  const unsigned kind = random.whole(4), count = 3 + random.whole(60);
  for (unsigned i = 0; i < count; ++i) {
    const Point& last = points.back();
    const bool is_short = kind == 0 || (kind != 1 && random.whole(3) != 0);
    const double length = is_short ? random.real(0.001, 0.15) : random.real(0.1, 5);
    heading += kind == 3 ? random.real(-0.15, 0.15) : random.whole(3) == 0 ? random.real(-M_PI, M_PI) : random.real(-0.3, 0.3);
    const double tilt = kind == 2 ? random.real(-1, 1) : 0;
    const auto micrometres = [](double w) { return std::nearbyint(w * 1000) / 1000; };
    points.push_back({micrometres(last.x + length * std::cos(heading) * std::cos(tilt)), micrometres(last.y + length * std::sin(heading) * std::cos(tilt)),
                      micrometres(last.z + length * std::sin(tilt))});
  }
  return points;
}

/// The polyline as items, with another item now and then that ends a sequence of lines.
std::vector<Item> random_items(Random& random, const std::vector<Point>& points) {
  std::vector<Item> items = polyline(points);
  for (size_t i = 2; i < items.size(); i += 2) {
    if (random.whole(15) == 0) items.insert(items.begin() + static_cast<long>(i), action_item()), ++i;
    if (random.whole(15) == 0) items.insert(items.begin() + static_cast<long>(i), mark_item(1000 + i)), ++i;
  }
  return items;
}

FairingRule random_rule(Random& random) {
  FairingRule rule = fairing_rule(random.real(0.01, 0.2), random.real(1, 30));
  rule.judge = random.whole(2) == 0;
  rule.judge_length_mm = random.real(0.01, 0.3);
  return rule;
}

TEST(FairingProperty, NoPointMovesByMoreThanTheLength) {
  unsigned left_out = 0;
  double furthest = 0;
  for (uint32_t seed = 0; seed < kPaths; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const std::vector<Item> items = random_items(random, random_path(random));
    const FairingRule rule = random_rule(random);
    const Passed run = pass(items, rule);
    // All items but lines come out as they went in, and in order; lines connect, and sequences of lines keep their ends.
    const auto moves = moves_of(run.items);
    AxisVec at = items[0].move.start;
    size_t in = 0;
    for (size_t i = 0; i < run.items.size(); ++i) {
      const Item& item = run.items[i];
      if (item.kind == ItemKind::move) {
        ASSERT_LE(gap(item.move.start, at), 1e-12);
        at = item.move.end;
        while (in < items.size() && !(items[in].kind == ItemKind::move && items[in].move.work == item.move.work)) {
          ASSERT_EQ(items[in].kind, ItemKind::move);  // only lines are left out
          ++in;
        }
        ASSERT_LT(in, items.size());
        ++in;
        continue;
      }
      while (items[in].kind == ItemKind::move) ++in;
      ASSERT_EQ(item.kind, items[in].kind);
      if (item.kind == ItemKind::mark) {
        ASSERT_EQ(item.mark.seq, items[in].mark.seq);
      } else {  // an item at which the machine stops has its programmed place
        size_t before = in;
        while (before > 0 && items[before].kind != ItemKind::move) --before;
        ASSERT_EQ(at, items[before].move.end);
      }
      ++in;
    }
    ASSERT_EQ(in, items.size());
    // In both directions: points of the program from the new path, and points of the new path from the program.
    const auto programmed = moves_of(items);
    left_out += static_cast<unsigned>(programmed.size() - moves.size());
    const auto distance_to_path = [](const AxisVec& p, const std::vector<const Move*>& path) {
      double least = HUGE_VAL;
      for (const Move* m : path) least = std::min(least, distance_to_line(p, m->start, m->end));
      return least;
    };
    for (const Move* m : programmed) {
      const double far = distance_to_path(m->end, moves);
      furthest = std::max(furthest, far / rule.length_mm);
      ASSERT_LE(far, rule.length_mm + 1e-9);
    }
    for (const Move* m : moves)
      for (double u : {0.0, 0.3, 0.6, 1.0}) {
        AxisVec p;
        for (unsigned i = 0; i < 3; ++i) p[i] = m->start[i] + u * (m->end[i] - m->start[i]);
        ASSERT_LE(distance_to_path(p, programmed), rule.length_mm + 1e-9);
      }
  }
  EXPECT_GT(left_out, kPaths * 2);  // otherwise these paths would test little
  EXPECT_GT(furthest, 0.3);
}

TEST(FairingProperty, GoingOnFromAnyMarkGivesTheSameAgain) {
  unsigned inside = 0;
  for (uint32_t seed = 0; seed < kPaths; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed + 5000);
    const std::vector<Item> items = random_items(random, random_path(random));
    const FairingRule rule = random_rule(random);
    const Passed run = pass(items, rule);
    for (size_t i = 0; i < run.items.size(); ++i) {
      if (run.items[i].kind != ItemKind::mark) continue;
      inside += run.resume[i].left_out != 0;
      size_t behind = 0;  // in the program
      while (!(items[behind].kind == ItemKind::mark && items[behind].mark.seq == run.items[i].mark.seq)) ++behind;
      Stage stage;
      stage.restore(run.resume[i]);
      const Passed rest = pass(stage, items, rule, behind + 1);
      ASSERT_EQ(rest.items.size(), run.items.size() - i - 1) << "mark " << run.items[i].mark.seq;
      for (size_t k = 0; k < rest.items.size(); ++k) {
        const Item &a = rest.items[k], &b = run.items[i + 1 + k];
        ASSERT_EQ(a.kind, b.kind);
        if (a.kind != ItemKind::move) continue;
        ASSERT_EQ(a.move.start, b.move.start);
        ASSERT_EQ(a.move.end, b.move.end);
        ASSERT_EQ(a.move.judged_turn, b.move.judged_turn);
      }
    }
  }
  EXPECT_GT(inside, kPaths);
}

/// Separate protrusions: the result has none, and a second fairing changes nothing.
TEST(FairingProperty, OnceIsEnough) {
  unsigned left_out = 0;
  for (uint32_t seed = 0; seed < kPaths; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed + 9000);
    std::vector<Point> points{{0, 0}};
    for (unsigned i = 0; i < 10; ++i) {
      const Point last = points.back();
      const double heading = random.real(-0.05, 0.05);
      points.push_back({last.x + random.real(2, 5), last.y + heading});
      if (random.whole(2) == 0) points.push_back({points.back().x + random.real(-0.05, 0.05), points.back().y + random.real(0.04, 0.08)});
    }
    const std::vector<Item> items = polyline(points);
    const FairingRule rule = fairing_rule(0.1);
    std::vector<Item> once = pass(items, rule).items;
    left_out += static_cast<unsigned>(moves_of(items).size() - moves_of(once).size());
    const std::vector<Item> twice = pass(once, rule).items;
    ASSERT_EQ(text_of(once), text_of(twice));
  }
  EXPECT_GT(left_out, kPaths);
}

/// Random polylines that turn by less than the angle are not changed in any bit.
TEST(FairingProperty, WhatHasNoCornersStays) {
  for (uint32_t seed = 0; seed < kPaths; ++seed) {
    Random random(seed + 20000);
    std::vector<Point> points{{0, 0}};
    double heading = 0;
    for (unsigned i = 0; i < 80; ++i) {
      heading += random.real(-0.17, 0.17);  // 9.7 degrees
      const double length = random.real(0.001, 0.1);
      points.push_back({points.back().x + length * std::cos(heading), points.back().y + length * std::sin(heading)});
    }
    const std::vector<Item> items = polyline(points);
    const Passed run = pass(items, fairing_rule(10, 10));
    ASSERT_EQ(run.items.size(), items.size());
    for (size_t i = 0; i < items.size(); ++i)
      if (items[i].kind == ItemKind::move) {
        ASSERT_EQ(items[i].move.end, run.items[i].move.end);
      }
  }
}

}  // namespace
}  // namespace nc::test
