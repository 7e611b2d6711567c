// SPDX-License-Identifier: Apache-2.0
// What must be true for every contour: the distance to the programmed path is right, all items come out in order, the pace
// of the caller does not matter, the stage can be resumed at any mark, and no input breaks it.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "alarm/condition.hpp"
#include "path_builder.hpp"

namespace nc::test {
namespace {

using Random = std::mt19937_64;

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<>(low, high)(random);
}
int pick(Random& random, int n) {
  return std::uniform_int_distribution<>(0, n - 1)(random);
}

constexpr double kPi = 3.14159265358979323846;

struct Contour {
  PathBuilder path;
  double offset;  ///< signed, to the left
};

/// Lines of 20 to 60 mm and arcs with radii of 15 to 40 mm, between a start and a cancel block; corners turn by at most
/// `max_turn`.
Contour random_contour(Random& random, double max_turn, bool arcs, int blocks) {
  Contour c{PathBuilder(-50, -30), 0};
  const double r = between(random, 0.5, 4);
  const int side = pick(random, 2) == 0 ? 1 : -1;
  c.path.side(side, r);
  c.offset = side * r;
  c.path.line(0, 0);
  double heading = between(random, -kPi, kPi);
  for (int i = 0; i < blocks; ++i) {
    if (arcs && pick(random, 2) == 0) {
      const double radius = between(random, 15, 40), angle = between(random, 0.4, 1.5);
      const bool ccw = pick(random, 2) == 0;
      const double s = ccw ? 1 : -1;
      const double i_word = -s * std::sin(heading) * radius, j_word = s * std::cos(heading) * radius;
      const double turned = heading + s * angle;
      c.path.arc_by(ccw, i_word + s * std::sin(turned) * radius, j_word - s * std::cos(turned) * radius,
                    i_word, j_word);
      heading = turned;
    } else {
      const double length = between(random, 20, 60);
      c.path.by(length * std::cos(heading), length * std::sin(heading));
    }
    heading += between(random, -max_turn, max_turn);
  }
  c.path.cancel().by(40 * std::cos(heading), 40 * std::sin(heading)).end();
  return c;
}

/// The distance to the left of the programmed line or arc, which is extended beyond its ends.
double distance_left(const Move& programmed, double h, double v) {
  if (programmed.circular) {
    const double d = std::hypot(h - programmed.circle.center[0], v - programmed.circle.center[1]);
    return programmed.circle.sweep > 0 ? programmed.circle.radius_start - d
                                       : d - programmed.circle.radius_start;
  }
  const double dh = programmed.end[0] - programmed.start[0], dv = programmed.end[1] - programmed.start[1];
  return (dh * (v - programmed.start[1]) - dv * (h - programmed.start[0])) / std::hypot(dh, dv);
}

TEST(OffsetProperty, DistanceAtGentleCorners) {
  for (unsigned seed = 0; seed < 400; ++seed) {
    Random random(seed);
    const Contour c = random_contour(random, 1.2, seed % 2 == 1, 12);
    std::vector<const Item*> in;
    for (const Item& item : c.path.items)
      if (item.kind == ItemKind::move) in.push_back(&item);
    const std::vector<Item> items = run_stage(c.path);
    ASSERT_EQ(alarm_of(items), nullptr) << "seed " << seed;
    const std::vector<Move> out = moves_of(items);
    ASSERT_EQ(out.size(), in.size()) << "seed " << seed;
    for (size_t i = 1; i + 1 < out.size(); ++i) {  // all but the start and the cancel block
      const Move& programmed = in[i]->move;
      const Move& m = out[i];
      EXPECT_NEAR(distance_left(programmed, m.start[0], m.start[1]), c.offset, 1e-9)
          << "seed " << seed << " move " << i;
      EXPECT_NEAR(distance_left(programmed, m.end[0], m.end[1]), c.offset, 1e-9)
          << "seed " << seed << " move " << i;
      EXPECT_EQ(m.start, out[i - 1].end) << "seed " << seed;
      EXPECT_EQ(m.work, programmed.work);
      if (!m.circular) continue;
      EXPECT_NEAR(m.circle.radius_start, m.circle.radius_end, 1e-9);
      EXPECT_EQ(m.circle.center[0], programmed.circle.center[0]);
      EXPECT_EQ(m.circle.sweep > 0, programmed.circle.sweep > 0);
      const double angle = m.circle.angle_start + m.circle.sweep;  // the circle and the end of the move must agree
      EXPECT_NEAR(m.circle.center[0] + m.circle.radius_end * std::cos(angle), m.end[0], 1e-9);
      EXPECT_NEAR(m.circle.center[1] + m.circle.radius_end * std::sin(angle), m.end[1], 1e-9);
      EXPECT_LT(std::abs(m.circle.sweep - programmed.circle.sweep), 1.2);
    }
  }
}

/// A stream with everything: commands, other items between the moves, sharp corners, changes of side and amount.
PathBuilder random_program(Random& random, bool tame) {
  PathBuilder path(between(random, -50, 50), between(random, -50, 50));
  const bool check = pick(random, 3) == 0, avoid = pick(random, 2) == 0;
  path.comp.type_b = pick(random, 2) == 0;
  path.comp.check = check && !tame;
  path.comp.avoid = avoid;
  for (int i = 0; i < 30; ++i) {
    path.kind = pick(random, 5) == 0 ? NC_MOVE_RAPID : NC_MOVE_LINE;
    Compensation once = path.comp;
    switch (pick(random, tame ? 14 : 20)) {
      case 0:
        path.cancel();
        break;
      case 1:
      case 2:
        path.side(1, between(random, 1, 5));
        break;
      case 3:
        path.idle();
        break;
      case 4:
        path.off_plane(between(random, -5, 5));
        break;
      case 5:
        path.arc_by(pick(random, 2) == 0, 30, 0, 15, between(random, -20, 20));
        break;
      case 6:
        path.command();
        break;
      case 7:
        path.program_stop();
        break;
      case 14:
        path.side(-1, between(random, -8, 20));
        break;
      case 15:
        once = path.vector(between(random, -1, 1), between(random, -1, 1));
        once.hold_vector = pick(random, 2) == 0;
        once.has_vector = pick(random, 3) != 0;
        path.one_shot(once);
        break;
      case 16:
        once.corner_arc = true;
        path.one_shot(once);
        break;
      case 17:
        once.transparent = true;
        path.one_shot(once);
        break;
      case 18:
        once = path.vector(between(random, -1, 1), between(random, -1, 1));
        once.has_vector = false;
        once.cancel_vector = true;
        once.side = 0;
        path.one_shot(once);
        break;
      case 19:
        path.arc_by(pick(random, 2) == 0, 0, 0, between(random, -9, 9), 3);
        break;
      default: {
        const double reach = tame ? 60 : 30;
        path.by(between(random, -reach, reach), between(random, -reach, reach));
      }
    }
  }
  return path.cancel().by(50, 20).end();
}

bool same_move(const Move& a, const Move& b) {
  for (unsigned i = 0; i < kMaxAxes; ++i)
    if (std::abs(a.end[i] - b.end[i]) > 1e-7 || std::abs(a.start[i] - b.start[i]) > 1e-7) return false;
  if (a.circular != b.circular || a.connecting != b.connecting || a.kind != b.kind || a.work != b.work)
    return false;
  return !a.circular || std::abs(a.circle.sweep - b.circle.sweep) < 1e-6;
}

TEST(OffsetProperty, OrderAndConservation) {
  unsigned alarms = 0;
  for (unsigned seed = 0; seed < 2000; ++seed) {
    Random random(seed);
    const PathBuilder path = random_program(random, false);
    const std::vector<Item> out = run_stage(path);
    size_t next = 0;
    bool ended = false;
    AxisVec at = path.start();
    for (const Item& item : out) {
      ASSERT_FALSE(ended) << "seed " << seed;
      if (item.kind == ItemKind::alarm) {
        ended = true;
        ++alarms;
        continue;
      }
      if (item.kind == ItemKind::move) {
        ASSERT_EQ(item.move.start, at)
            << "seed " << seed << ": a gap in the path of line " << item.source.line;
        at = item.move.end;
      }
      if (item.kind == ItemKind::move && item.move.connecting) continue;
      // All other items must be those that went in, in the same order; only moves may be missing.
      while (next < path.items.size() && path.items[next].kind == ItemKind::move &&
             (item.kind != ItemKind::move || path.items[next].source.line != item.source.line)) {
        ++next;
      }
      ASSERT_LT(next, path.items.size()) << "seed " << seed;
      ASSERT_EQ(path.items[next].kind, item.kind) << "seed " << seed;
      ASSERT_EQ(path.items[next].source.line, item.source.line) << "seed " << seed;
      if (item.kind == ItemKind::move) {
        EXPECT_EQ(item.move.work, path.items[next].move.work);
        EXPECT_EQ(item.move.work_center[0], path.items[next].move.work_center[0]);
        EXPECT_GT(std::abs(item.move.circle.sweep) + std::hypot(item.move.end[0] - item.move.start[0],
                                                                item.move.end[1] - item.move.start[1],
                                                                item.move.end[2] - item.move.start[2]),
                  0);
      }
      ++next;
    }
    if (!ended) {
      EXPECT_EQ(next, path.items.size()) << "seed " << seed;
    }
  }
  EXPECT_GT(alarms, 50u);  // both kinds of run occur
  EXPECT_LT(alarms, 1900u);
}

/// A contour, G40 without a movement, G41 without one, and then what ends that start before it has moved: the vector of the contour is still there.
TEST(OffsetProperty, AStartBehindG40ThatIsGivenUpLeavesNoGap) {
  for (const bool again : {false, true}) {
    for (const bool moves : {false, true}) {
      PathBuilder path(0, 0);
      path.side(1, 5);
      path.by(20, 20).by(40, 0).cancel().command();
      path.side(1, 3);
      path.command().cancel();
      if (moves) path.by(0, 30);
      path.command();
      if (again) path.side(-1, 2);
      if (again) path.by(10, 0).cancel();
      const std::vector<Item> out = run_stage(path.by(50, 20).end());
      ASSERT_EQ(alarm_of(out), nullptr);
      AxisVec at = path.start();
      for (const Move& move : moves_of(out)) {
        EXPECT_EQ(move.start, at) << again << moves;
        at = move.end;
      }
      EXPECT_EQ(at, path.position());
    }
  }
}

TEST(OffsetProperty, EndsUncompensated) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    Random random(seed);
    const PathBuilder path = random_program(random, true);
    StageWithMemory stage;
    const std::vector<Item> out = run_stage(stage, path.items);
    if (alarm_of(out) != nullptr) continue;
    EXPECT_TRUE(stage.idle()) << "seed " << seed;
    const AxisVec last = moves_of(out).back().end;
    for (unsigned i = 0; i < 3; ++i) EXPECT_NEAR(last[i], path.position()[i], 1e-9) << "seed " << seed;
  }
}

TEST(OffsetProperty, ThePaceOfTheCallerDoesNotMatter) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    Random random(seed);
    const PathBuilder path = random_program(random, false);
    StageWithMemory eager, lazy;
    const std::vector<Item> a = run_stage(eager, path.items), b = run_stage(lazy, path.items, true);
    ASSERT_EQ(a.size(), b.size()) << "seed " << seed;
    for (size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(a[i].kind, b[i].kind);
      if (a[i].kind != ItemKind::move) continue;
      EXPECT_EQ(a[i].move.end, b[i].move.end);
    }
  }
}

TEST(OffsetProperty, ResumesAtAnyMark) {
  unsigned compared = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    Random random(seed);
    const PathBuilder path = random_program(random, true);
    StageWithMemory stage;
    std::vector<Item> out;
    std::vector<OffsetResume> resume;
    std::vector<size_t> out_behind, in_behind;
    Item item;
    for (size_t i = 0; i <= path.items.size(); ++i) {
      while (stage.pop(item)) {
        out.push_back(item);
        if (item.kind != ItemKind::mark) continue;
        resume.push_back(stage.resume_point());
        out_behind.push_back(out.size());
        size_t k = 0;
        while (path.items[k].kind != ItemKind::mark || path.items[k].source.line != item.source.line) ++k;
        in_behind.push_back(k + 1);
      }
      if (i < path.items.size()) stage.push(path.items[i]);
    }
    if (alarm_of(out) != nullptr) continue;
    for (size_t m = 0; m < resume.size(); ++m) {
      StageWithMemory again;
      again.restore(resume[m]);
      const std::vector<Item> rest(path.items.begin() + static_cast<std::ptrdiff_t>(in_behind[m]),
                                   path.items.end());
      const std::vector<Item> redone = run_stage(again, rest);
      ASSERT_EQ(redone.size(), out.size() - out_behind[m]) << "seed " << seed << " mark " << m;
      for (size_t i = 0; i < redone.size(); ++i) {
        const Item& first = out[out_behind[m] + i];
        ASSERT_EQ(redone[i].kind, first.kind) << "seed " << seed << " mark " << m;
        ++compared;
        if (first.kind != ItemKind::move) continue;
        EXPECT_TRUE(same_move(redone[i].move, first.move)) << "seed " << seed << " mark " << m;
      }
    }
  }
  EXPECT_GT(compared, 10000u);
}

TEST(OffsetProperty, NothingToResumeOnceCompensationIsOver) {
  PathBuilder path(-20, 0);
  path.side(1, 5);
  path.line(0, 0).line(50, 0).cancel().line(80, 20);
  path.items.pop_back();  // the caller does not give the mark of the cancel block to the idle stage
  StageWithMemory stage;
  run_stage(stage, path.items);
  EXPECT_TRUE(stage.idle());
  EXPECT_FALSE(stage.resume_point().active);
}

/// Two lines with an outer corner, and this many items between them.
std::vector<Item> items_between(int count) {
  PathBuilder path(-20, 0);
  path.side(1, 5);
  path.line(0, 0).line(50, 0);
  std::vector<Item> items = path.items;
  Item action;
  action.kind = ItemKind::action;
  action.action = Action{};
  for (int i = 0; i < count; ++i) items.push_back(action);
  const size_t before = path.items.size();
  path.line(50, -40).cancel().line(80, -40).end();
  items.insert(items.end(), path.items.begin() + static_cast<std::ptrdiff_t>(before), path.items.end());
  return items;
}

TEST(OffsetProperty, ItemsBetweenTwoMovesAreWaitedFor) {
  for (const int count : {1, 24, 100}) {
    const std::vector<Item> items = items_between(count);
    StageWithMemory stage;
    const std::vector<Item> out = run_stage(stage, items);
    EXPECT_EQ(out.size(), items.size());
    const AxisVec p = at_block(out, AxisVec{}, 2);
    EXPECT_NEAR(p[0], 55, 1e-9) << count;  // the intersection
    EXPECT_NEAR(p[1], 5, 1e-9) << count;
  }
}

TEST(OffsetProperty, MoreItemsThanThereIsRoomForAreAnAlarmInFrontOfTheBlock) {  // the end of which cannot be known
  StageWithMemory stage;
  const std::vector<Item> out = run_stage(stage, items_between(200));
  ASSERT_NE(alarm_of(out), nullptr);
  EXPECT_EQ(alarm_of(out)->alarm.condition, Condition::pre_read);
  EXPECT_EQ(moves_of(out).size(), 1u);
}

TEST(OffsetProperty, AnInhibitingItemIsNeverHeldBack) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    Random random(seed);
    PathBuilder path = random_program(random, true);
    StageWithMemory stage;
    Item item, sync;
    sync.kind = ItemKind::sync;
    sync.sync = Sync{NC_SYNC_POSITION};
    for (const Item& in : path.items) {
      while (stage.pop(item)) {
      }
      stage.push(in);
      if (pick(random, 6) != 0) continue;
      while (stage.pop(item)) {
      }
      stage.push(sync);
      bool seen = false;
      while (stage.pop(item)) seen = seen || item.kind == ItemKind::sync || item.kind == ItemKind::alarm;
      if (item.kind == ItemKind::alarm) break;
      EXPECT_TRUE(seen) << "seed " << seed;
    }
  }
}

/// A number that no program would send.
double wild(Random& random) {
  switch (pick(random, 12)) {
    case 0:
      return 0;
    case 1:
      return 1e-12;
    case 2:
      return 1e300;
    case 3:
      return std::numeric_limits<double>::quiet_NaN();
    case 4:
      return std::numeric_limits<double>::infinity();
    case 5:
      return -1e9;
    default:
      return between(random, -20, 20);
  }
}

TEST(OffsetProperty, RandomItemsNeverBreakTheStage) {
  constexpr ItemKind kKinds[] = {ItemKind::move, ItemKind::move, ItemKind::move,   ItemKind::move,
                                 ItemKind::mark, ItemKind::mark, ItemKind::action, ItemKind::gate,
                                 ItemKind::sync, ItemKind::end};
  for (unsigned seed = 0; seed < 300; ++seed) {
    Random random(seed);
    StageWithMemory stage;
    size_t popped = 0;
    for (int n = 0; n < 400; ++n) {
      Item item;
      item.kind = kKinds[pick(random, 10)];
      item.block_end = item.kind == ItemKind::mark && pick(random, 4) != 0;
      if (item.kind == ItemKind::move) {
        item.move = Move{};
        Move& m = item.move;
        for (unsigned i = 0; i < kMaxAxes; ++i) {
          m.start[i] = pick(random, 3) == 0 ? wild(random) : 1;
          m.end[i] = pick(random, 3) == 0 ? wild(random) : m.start[i];
        }
        m.circular = pick(random, 3) == 0;
        m.kind = m.circular ? NC_MOVE_ARC : static_cast<nc_move_kind>(pick(random, 7));
        m.plane_axis[0] = static_cast<uint8_t>(pick(random, 256));
        m.plane_axis[1] = static_cast<uint8_t>(pick(random, 3));
        m.circle.center[0] = wild(random);
        m.circle.center[1] = wild(random);
        m.circle.sweep = wild(random);
        m.comp.side = static_cast<int8_t>(pick(random, 3) - 1);
        m.comp.radius = wild(random);
        m.comp.vector[0] = wild(random);
        m.comp.vector[1] = wild(random);
        for (bool* flag : {&m.comp.transparent, &m.comp.has_vector, &m.comp.hold_vector, &m.comp.corner_arc,
                           &m.comp.type_b, &m.comp.cancel_vector, &m.comp.check, &m.comp.avoid})
          *flag = pick(random, 4) == 0;
        if (pick(random, 8) == 0) m.comp.axis[1] = static_cast<uint8_t>(pick(random, 256));
      } else if (item.kind == ItemKind::gate) {
        item.gate = Gate{};
        item.gate.kind = static_cast<nc_gate_kind>(pick(random, 6));
      }
      if (!stage.can_push()) {
        Item out;
        ASSERT_TRUE(stage.pop(out)) << "neither in nor out";
        ++popped;
      }
      stage.push(item);
      Item out;
      for (int k = pick(random, 4); k > 0; --k) popped += stage.pop(out) ? 1 : 0;
      if (pick(random, 40) == 0) {
        const OffsetResume resume = stage.resume_point();
        stage.restore(resume);
      }
      if (pick(random, 100) == 0) stage.reset();
      unsigned burst = 0;
      while (pick(random, 10) == 0 && stage.pop(out)) ++burst;
      popped += burst;
    }
    Item out;
    unsigned rest = 0;
    while (stage.pop(out)) ++rest;
    EXPECT_LE(rest, 32u * 5u);  // the moves that were held, each with its displacement and three connecting moves
    EXPECT_TRUE(stage.can_push());
    EXPECT_GT(popped + rest, 20u);
  }
}

}  // namespace
}  // namespace nc::test
