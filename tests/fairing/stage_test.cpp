// SPDX-License-Identifier: Apache-2.0
// What fairing leaves out, where it joins, and what it never touches (M700 13.17.1, additional functions (1) and (3)).
#include <gtest/gtest.h>

#include "stage_bench.hpp"

namespace nc::test {
namespace {

std::string faired(const std::vector<Point>& points, double length = 0.1) { return text_of(pass(polyline(points), fairing_rule(length)).items); }

TEST(Fairing, AProtrudingLineIsLeftOutAndItsNeighboursMeetInItsMiddle) {
  EXPECT_EQ(faired({{0, 0}, {10, 0}, {10, 0.08}, {20, 0.08}}), "10,0.04 |1 |2 20,0.08 |3 end");
  // The next line begins where the one before ends; feeds and programmed ends stay.
  const Passed run = pass(polyline({{0, 0}, {10, 0}, {10, 0.08}, {20, 0.08}}), fairing_rule(0.1));
  const auto moves = moves_of(run.items);
  ASSERT_EQ(moves.size(), 2u);
  EXPECT_EQ(moves[0]->end, moves[1]->start);
  EXPECT_EQ(moves[0]->work, axes_of({10, 0}));
  EXPECT_EQ(moves[1]->work, axes_of({20, 0.08}));
  EXPECT_EQ(moves[1]->feed_mm_min, 1000);
}

TEST(Fairing, OnlyShorterLinesThanTheLengthAre) {
  EXPECT_EQ(faired({{0, 0}, {10, 0}, {10, 0.1}, {20, 0.1}}), "10,0 |1 10,0.1 |2 20,0.1 |3 end");
  EXPECT_EQ(faired({{0, 0}, {10, 0}, {10, 0.0999}, {20, 0.0999}}), "10,0.04995 |1 |2 20,0.0999 |3 end");
  EXPECT_EQ(faired({{0, 0}, {10, 0}, {10, 0.05}, {20, 0.05}}, 0), "10,0 |1 10,0.05 |2 20,0.05 |3 end");
}

TEST(Fairing, ASpikeOfTwoLinesTakesTwoTurns) {  // "if there is any protruding path after fairing, fairing is repeated"
  // (10,0)-(10.02,.09)-(10.04,0): first the middle of one flank, (10.01,.045); then the middle between that and the foot of the other.
  EXPECT_EQ(faired({{0, 0}, {10, 0}, {10.02, 0.09}, {10.04, 0}, {20, 0}}), "10.025,0.0225 |1 |2 |3 20,0 |4 end");
}

TEST(Fairing, AWayBackIsLeftOut) {
  EXPECT_EQ(faired({{0, 0}, {10, 0}, {9.95, 0}, {20, 0}}), "9.975,0 |1 |2 20,0 |3 end");
}

TEST(Fairing, AStaircaseBecomesASlope) {
  // Steps of 0.02 mm, alternately up and along: every second one is left out, the others lead from middle to middle.
  std::vector<Point> points{{0, 0}, {10, 0}};
  for (unsigned i = 0; i < 40; ++i) {
    Point next = points.back();
    (i % 2 == 0 ? next.y : next.x) += 0.02;
    points.push_back(next);
  }
  points.push_back({20, points.back().y});
  const Passed run = pass(polyline(points), fairing_rule(0.1));
  const auto moves = moves_of(run.items);
  EXPECT_EQ(run.items.size(), moves.size() + points.size());
  unsigned sloping = 0;
  for (const Move* move : moves) {
    const double slope = std::atan2(move->end[1] - move->start[1], move->end[0] - move->start[0]) * 180 / M_PI;
    EXPECT_LT(slope, 60);  // none goes straight up
    sloping += std::fabs(slope - 45) < 1e-6;
  }
  EXPECT_GT(sloping, 12u);
  EXPECT_LE(moves.size(), 23u);
}

TEST(Fairing, SmallStepoversAndChamfersStay) {
  // A U-turn of two corners in the same sense is no protrusion, nor is a chamfer or a round corner of short lines.
  EXPECT_EQ(faired({{0, 0}, {10, 0}, {10, 0.08}, {0, 0.08}}), "10,0 |1 10,0.08 |2 0,0.08 |3 end");
  EXPECT_EQ(faired({{0, 0}, {10, 0}, {10.05, 0.05}, {10.05, 9}}), "10,0 |1 10.05,0.05 |2 10.05,9 |3 end");
  EXPECT_EQ(faired({{0, 0}, {10, 0}, {10.04, 0.02}, {10.06, 0.06}, {10.06, 9}}), "10,0 |1 10.04,0.02 |2 10.06,0.06 |3 10.06,9 |4 end");
  // In space, three lines along the axes turn in neither the same nor the opposite sense.
  EXPECT_EQ(moves_of(pass(polyline({{0, 0, 0}, {10, 0, 0}, {10, 0.05, 0}, {10, 0.05, 9}}), fairing_rule(0.1)).items).size(), 3u);
}

TEST(Fairing, ASmoothPolylineStaysToTheLastBit) {
  for (const double angle : {0.0, 0.7}) {  // chords of an s-curve with an inflection, rounded to micrometres, in two directions
    std::vector<Point> points;
    for (unsigned i = 0; i <= 400; ++i) {
      const double u = 0.05 * i, v = 3 * std::sin(u / 2);
      const auto micrometres = [](double w) { return std::nearbyint(w * 1000) / 1000; };
      points.push_back({micrometres(u * std::cos(angle) - v * std::sin(angle)), micrometres(u * std::sin(angle) + v * std::cos(angle))});
    }
    const std::vector<Item> items = polyline(points);
    const Passed run = pass(items, fairing_rule(1));
    ASSERT_EQ(run.items.size(), items.size());
    for (size_t i = 0; i < items.size(); ++i)
      if (items[i].kind == ItemKind::move) {
        ASSERT_EQ(run.items[i].move.start, items[i].move.start);
        ASSERT_EQ(run.items[i].move.end, items[i].move.end);
      }
  }
}

TEST(Fairing, CornersBelowTheAngleAreNone) {
  // 6 degrees up and down again: a corner for 5 degrees, none for 10.
  const double rise = 0.09 * std::sin(6 * M_PI / 180), run = 0.09 * std::cos(6 * M_PI / 180);
  const std::vector<Point> points{{0, 0}, {10, 0}, {10 + run, rise}, {20, rise}};
  EXPECT_EQ(moves_of(pass(polyline(points), fairing_rule(0.1, 10)).items).size(), 3u);
  EXPECT_EQ(moves_of(pass(polyline(points), fairing_rule(0.1, 5)).items).size(), 2u);
}

TEST(Fairing, NothingIsLeftOutAcrossAnotherItem) {  // precaution (13)
  const auto with = [](const std::function<void(std::vector<Item>&)>& change) {
    std::vector<Item> items = polyline({{0, 0}, {10, 0}, {10, 0.08}, {20, 0.08}});
    change(items);
    return moves_of(pass(items, fairing_rule(0.1)).items).size();
  };
  EXPECT_EQ(with([](auto&) {}), 2u);
  EXPECT_EQ(with([](auto& items) { items.insert(items.begin() + 1, action_item()); }), 3u);  // an M code
  EXPECT_EQ(with([](auto& items) { items.insert(items.begin() + 3, action_item()); }), 3u);
  EXPECT_EQ(with([](auto& items) { items[2].move.kind = NC_MOVE_RAPID; }), 3u);
  EXPECT_EQ(with([](auto& items) { items[4].move.circular = true; }), 3u);
  EXPECT_EQ(with([](auto& items) { items[0].move.exact_stop = true; }), 3u);
  EXPECT_EQ(with([](auto& items) { items[2].move.skip_mask = 1; }), 3u);
  EXPECT_EQ(with([](auto& items) { items[2].move.shape = 1; }), 3u);
  EXPECT_EQ(with([](auto& items) { items[2].move.comp.side = 1; }), 3u);
  EXPECT_EQ(with([](auto& items) { items[4].move.high_accuracy = kHighAccuracyOn; }), 3u);  // the mode is off
  EXPECT_EQ(with([](auto& items) { items[4].move.transform = 1; }), 3u);  // other coordinates
  EXPECT_EQ(with([](auto& items) { items[1].mark.again = true; }), 3u);
  EXPECT_EQ(with([](auto& items) { items.insert(items.begin() + 3, mark_item(9)); }), 2u);  // a block of no effect
}

TEST(Fairing, LinesOfRotaryAxesAreNotFaired) {
  Stage stage(4);  // the third axis turns
  const std::vector<Item> flat = polyline({{0, 0}, {10, 0}, {10, 0.08}, {20, 0.08}});
  EXPECT_EQ(moves_of(pass(stage, flat, fairing_rule(0.1)).items).size(), 2u);
  const std::vector<Item> turned = polyline({{0, 0}, {10, 0}, {10, 0.08, 0.01}, {20, 0.08, 0.01}});
  EXPECT_EQ(moves_of(pass(stage, turned, fairing_rule(0.1)).items).size(), 3u);
}

TEST(Fairing, AnotherRuleClosesTheRow) {  // G10 L70 in between
  const std::vector<Item> items = polyline({{0, 0}, {10, 0}, {10, 0.08}, {20, 0.08}, {20, 0.16}, {30, 0.16}});
  Stage stage;
  std::vector<Item> out;
  Item item;
  for (size_t i = 0; i < items.size();) {
    if (stage.pop(item)) {
      out.push_back(item);
    } else if (stage.push(items[i], fairing_rule(i < 5 ? 0.01 : 0.1))) {
      ++i;
    }
  }
  while (stage.pop(item)) out.push_back(item);
  EXPECT_EQ(text_of(out), "10,0 |1 10,0.08 |2 20,0.08 |3 20,0.16 |4 30,0.16 |5 end");
}

TEST(Fairing, LinesWithoutLengthVanish) {
  EXPECT_EQ(faired({{0, 0}, {10, 0}, {10, 0}, {10, 0.08}, {10, 0.08}, {20, 0.08}}), "10,0.04 |1 |2 |3 |4 20,0.08 |5 end");
}

TEST(Fairing, HoldsLittleAndGivesEverything) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> step(-0.05, 0.05);
  std::vector<Point> points{{0, 0, 0}};
  for (unsigned i = 0; i < 100000; ++i) points.push_back({points.back().x + 0.03, points.back().y + step(random), points.back().z + step(random)});
  const std::vector<Item> items = polyline(points);
  const Passed run = pass(items, fairing_rule(0.1));
  EXPECT_EQ(run.items.size() - moves_of(run.items).size(), points.size());  // every mark, and the end
  EXPECT_LT(moves_of(run.items).size(), points.size() * 3 / 4);
  // Blocks without a move between two lines: the stage waits for a line, but not for ever.
  std::vector<Item> marks = polyline({{0, 0}, {10, 0}});
  for (unsigned i = 0; i < 1000; ++i) marks.insert(marks.end() - 1, mark_item(2 + i));
  EXPECT_LE(pass(marks, fairing_rule(0.1)).most_ahead, 24u);
}

TEST(Fairing, AnAlarmBehindItLetsEverythingGo) {
  std::vector<Item> items = polyline({{0, 0}, {10, 0}, {10, 0.08}, {20, 0.08}});
  items.back().kind = ItemKind::alarm;
  new (&items.back().alarm) Fault();
  EXPECT_EQ(text_of(pass(items, fairing_rule(0.1)).items), "10,0.04 |1 |2 20,0.08 |3 other");
}

// ---- corners ---------------------------------------------------------------------------------------------------------------

FairingRule judging(double length) {
  FairingRule rule = fairing_rule(0);
  rule.judge = true;
  rule.judge_length_mm = length;
  return rule;
}

std::vector<float> turns(const std::vector<Point>& points, const FairingRule& rule) {
  std::vector<float> all;
  const Passed run = pass(polyline(points), rule);
  for (const Move* move : moves_of(run.items)) all.push_back(move->judged_turn);
  return all;
}

const float kRightAngle = static_cast<float>(std::sqrt(2.0));  // 2 sin(45 deg)

TEST(CornerJudgement, ShortLinesAreLeftOut) {  // 13.17.1 (3)
  // A right angle with a chamfer of two short lines: every joint in it counts as the right angle of the whole corner.
  const std::vector<float> chamfer = turns({{0, 0}, {10, 0}, {10.08, 0.03}, {10.11, 0.11}, {10.11, 10}, {20, 10}}, judging(0.1));
  ASSERT_EQ(chamfer.size(), 5u);
  EXPECT_EQ(chamfer[0], -1);
  EXPECT_FLOAT_EQ(chamfer[1], kRightAngle);
  EXPECT_FLOAT_EQ(chamfer[2], kRightAngle);
  EXPECT_FLOAT_EQ(chamfer[3], kRightAngle);
  EXPECT_EQ(chamfer[4], -1);  // both its lines are long, so that the corner counts as it is
  // A step of a tenth of a millimetre in a straight path is no corner.
  const std::vector<float> step = turns({{0, 0}, {10, 0}, {10, 0.09}, {20, 0.09}}, judging(0.1));
  EXPECT_FLOAT_EQ(step[1], 0);
  EXPECT_FLOAT_EQ(step[2], 0);
}

TEST(CornerJudgement, WithoutALongLineOnBothSidesNeighboursCount) {
  const std::vector<float> begins = turns({{0, 0}, {0.05, 0}, {0.05, 0.05}, {10, 0.05}}, judging(0.1));
  for (const float turn : begins) EXPECT_EQ(turn, -1);
  const std::vector<float> ends = turns({{0, 0}, {10, 0}, {10, 0.05}, {10.05, 0.05}}, judging(0.1));
  for (const float turn : ends) EXPECT_EQ(turn, -1);
  // From the first of ten short lines the stage does not see the long line behind them.
  std::vector<Point> many{{0, 0}, {10, 0}};
  for (unsigned i = 0; i < 10; ++i) many.push_back({10, 0.05 * (i + 1)});
  many.push_back({20, 0.5});
  const std::vector<float> far = turns(many, judging(0.1));
  EXPECT_EQ(far[1], -1);
  EXPECT_EQ(far[2], -1);
  for (size_t i = 3; i < far.size(); ++i) EXPECT_FLOAT_EQ(far[i], 0) << i;
}

TEST(CornerJudgement, IsThatOfTheFairedPath) {
  FairingRule rule = judging(0.2);
  rule.fairing = true;
  rule.length_mm = 0.1;
  const std::vector<float> turn = turns({{0, 0}, {10, 0}, {10, 0.08}, {20, 0.08}}, rule);
  ASSERT_EQ(turn.size(), 2u);
  EXPECT_EQ(turn[1], -1);  // both lines are long, and the corner between them is a shallow one
}

}  // namespace
}  // namespace nc::test
