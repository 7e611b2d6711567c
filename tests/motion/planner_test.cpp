// SPDX-License-Identifier: Apache-2.0
// The limits of segments and joints compared with the geometry; and the plan, which is feasible, rests at its end, and is
// never slower because more has been committed. And the checker that the other tests trust: a wrong plan must make it
// fail.
#include <gtest/gtest.h>

#include "interpolate/interpolator.hpp"
#include "interpolate/random_program.hpp"
#include "interpolate/test_machine.hpp"

namespace nc::test {
namespace {

MotionLimits limits_of(const ExecutorConfig& c) {
  MotionLimits l;
  l.axis_count = c.axis_count;
  for (unsigned i = 0; i < kMaxAxes; ++i) l.axis[i] = c.limits[i];
  l.cycle_s = c.cycle_s;
  l.max_feed_override = c.max_feed_override;
  return l;
}

/// Planner and scan put together by hand, so that a test can reach between them.
struct Rig {
  explicit Rig(const ExecutorConfig& scan_config, const ExecutorConfig& plan_config) : checker(scan_config) {
    memory.reset(std::aligned_alloc(64, kBytes));
    Arena arena(memory.get(), kBytes);
    ring = arena.make<Record>(scan_config.capacity);
    planner = arena.make<Planner>();
    shared = arena.make<ScanShared>();
    scan = arena.make<Interpolator>();
    planner->create(limits_of(plan_config), ring, scan_config.capacity, arena);
    shared->events.create(scan_config.capacity, arena);
    scan->create(scan_config, ring, nullptr, planner, nullptr, shared, nullptr);
    in.feed_override = in.rapid_override = 1;
  }
  void push(const Program& p) {
    for (const Record& r : p.records) {
      ring[head] = r;
      planner->commit(head++);
    }
    planner->replan(said());
  }
  Planner::Inputs said() {
    Planner::Inputs s;
    s.tail = shared->tail.load();
    s.ordinal = shared->ordinal.load();
    s.feed_override = in.feed_override;
    return s;
  }
  void run() {
    in.cycle_start = true;
    for (int i = 0; i < 100000; ++i) {
      scan->cycle(in, out);
      checker.sample(out);
      in.cycle_start = false;
      if (out.state == NC_STATE_IDLE) break;
    }
  }
  static constexpr size_t kBytes = 4u << 20;
  std::unique_ptr<void, FreeAligned> memory;
  Record* ring;
  Planner* planner;
  ScanShared* shared;
  Interpolator* scan;
  uint32_t head = 0;
  nc_inputs in{};
  nc_outputs out{};
  LimitChecker checker;
};

Program corner(const ExecutorConfig& c, double degrees, double length = 20, double feed = 100) {
  Program p(c);
  AxisVec a;
  a[0] = length;
  p.line(a, feed);
  p.mark();
  a[0] += length * std::cos(to_rad(degrees));
  a[1] += length * std::sin(to_rad(degrees));
  p.line(a, feed);
  p.mark();
  p.end();
  return p;
}

double exit_speed(Rig& rig, uint32_t ordinal) {
  return std::sqrt(rig.planner->newest().exit2(ordinal));
}

TEST(Plan, CornerSpeedIsTheOneDerived) {
  const ExecutorConfig c = standard_config();
  Rig rig(c, c);
  rig.push(corner(c, 10, 0.07));
  // v (v dt/L + 1) |sin 10 deg| = 0.75 a dt on Y
  const double v = exit_speed(rig, 0), dt = 0.001, change = std::sin(to_rad(10));
  EXPECT_NEAR(v * (v * dt / 0.07 + 1) * change, 0.75 * 2000 * dt, 1e-9);
  EXPECT_NEAR(v, 7.78, 0.01);
  EXPECT_EQ(exit_speed(rig, 1), 0);
}

TEST(Plan, SharpCornersComeToRestStraightOnesDoNotSlow) {
  const ExecutorConfig c = standard_config();
  Rig sharp(c, c), straight(c, c);
  sharp.push(corner(c, 90));
  EXPECT_EQ(exit_speed(sharp, 0), 0);
  straight.push(corner(c, 0));
  EXPECT_NEAR(exit_speed(straight, 0), 100, 1e-9);
}

TEST(Plan, TangentArcIsPassedAtFeed) {
  const ExecutorConfig c = standard_config();
  Program p(c);
  AxisVec a;
  a[0] = 30;
  p.line(a, 50);
  p.mark();
  p.arc(0, 1, 20, to_rad(-90), to_rad(90), 50);
  p.mark();
  a = p.at();
  a[1] += 30;
  p.line(a, 50);
  p.end();
  Rig rig(c, c);
  rig.push(p);
  EXPECT_NEAR(exit_speed(rig, 0), 50, 1e-6);
  EXPECT_NEAR(exit_speed(rig, 1), 50, 1e-6);
}

TEST(Plan, ArcSpeedKeepsCentripetalAcceleration) {
  const ExecutorConfig c = standard_config();
  Program p(c);
  p.arc(0, 1, 2, 0, to_rad(360), 100);
  p.end();
  Rig rig(c, c);
  rig.push(p);
  const Segment& s = rig.ring[0].segment;
  EXPECT_LE(s.speed_limit * s.speed_limit / 2, 2000);
  EXPECT_GE(s.speed_limit * s.speed_limit / 2, 0.85 * 2000);
  EXPECT_GT(s.acceleration, 0.4 * 2000);
  const double whole = std::hypot(s.acceleration, std::pow(std::min(s.speed_limit, 200.0), 2) / 2);
  EXPECT_LE(whole, 2000 * (1 + 1e-9));
}

TEST(Plan, RestWhereItIsDemanded) {
  const ExecutorConfig c = standard_config();
  const auto speed_between = [&](const std::function<void(Program&)>& between, bool rapid = false,
                                 bool exact = false) {
    Program p(c);
    AxisVec a;
    a[0] = 20;
    if (rapid) {
      p.rapid(a);
    } else {
      p.line(a, 50).exact_stop = exact;
    }
    between(p);
    a[0] = 40;
    p.line(a, 50);
    p.end();
    Rig rig(c, c);
    rig.push(p);
    return exit_speed(rig, 0);
  };
  const auto nothing = [](Program&) {};
  EXPECT_NEAR(speed_between(nothing), 50, 1e-9);
  EXPECT_EQ(speed_between(nothing, true), 0);
  EXPECT_EQ(speed_between(nothing, false, true), 0);
  EXPECT_NEAR(speed_between([](Program& p) { p.mark(); }), 50, 1e-9);
  EXPECT_NEAR(speed_between([](Program& p) { p.action(NC_ACTION_OUTPUT, 0, 0, 1, 1); }), 50, 1e-9);
  EXPECT_NEAR(speed_between([](Program& p) { p.action(NC_ACTION_M, 50); }), 50, 1e-9)
      << "no gate: on the fly";
  EXPECT_EQ(speed_between([](Program& p) { p.gate(NC_GATE_FIN); }), 0);
  EXPECT_EQ(speed_between([](Program& p) { p.gate(NC_GATE_DWELL_SECONDS, 0.1); }), 0);
  EXPECT_EQ(speed_between([](Program& p) { p.gate(NC_GATE_OPTIONAL_STOP); }), 0);
  EXPECT_EQ(speed_between([](Program& p) { p.sync(); }), 0);
  EXPECT_EQ(speed_between([](Program& p) { p.action(NC_ACTION_MESSAGE, 1); }), 0);
  EXPECT_EQ(speed_between([](Program& p) {
              for (int i = 0; i < 20; ++i) p.mark();
            }),
            0)
      << "too many records to be executed in one cycle";
}

TEST(Plan, IsFeasibleEndsAtRestAndNeverFallsWhenMoreIsCommitted) {
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    std::mt19937_64 rng(seed);
    ExecutorConfig c = standard_config(4);
    c.capacity = 2048;
    Program p = random_program(c, rng, 20);
    if (p.records.size() > c.capacity) p.records.resize(c.capacity);
    Rig rig(c, c);
    std::vector<double> last;
    uint32_t segments = 0, shown_before = 0;
    for (size_t i = 0; i < p.records.size(); ++i) {
      rig.ring[rig.head] = p.records[i];
      rig.planner->commit(rig.head++);
      if (rng() % 4) continue;
      rig.planner->replan(rig.said());
      const Plan& plan = rig.planner->newest();
      ASSERT_GE(plan.end, shown_before);
      shown_before = plan.end;
      segments = 0;
      const Segment* before = nullptr;
      for (uint32_t k = 0; k < plan.end; ++k) {
        if (rig.ring[k].kind != ItemKind::move) continue;
        const Segment& s = rig.ring[k].segment;
        ASSERT_EQ(s.ordinal, segments);
        ASSERT_GT(s.acceleration, 0);
        ASSERT_GT(s.speed_limit, 0);
        if (before) {
          const double entry2 = plan.exit2(segments - 1);
          ASSERT_LE(entry2, plan.exit2(segments) + 2 * s.acceleration * s.curve.length * (1 + 1e-12));
          ASSERT_LE(std::sqrt(entry2), std::min(before->speed_limit, s.speed_limit) * (1 + 1e-12));
        }
        if (segments < last.size()) {
          ASSERT_GE(plan.exit2(segments), last[segments]) << "seed " << seed;
        }
        before = &s;
        ++segments;
      }
      last.clear();
      for (uint32_t k = 0; k < segments; ++k) last.push_back(plan.exit2(k));
      if (segments) {
        ASSERT_EQ(last.back(), 0) << "rest at the end of what is shown";
      }
    }
    EXPECT_GT(segments, 0u);
  }
}

TEST(Plan, IncrementalEqualsWhole) {
  for (uint64_t seed = 1; seed <= 30; ++seed) {
    std::mt19937_64 rng(seed);
    ExecutorConfig c = standard_config();
    c.capacity = 4096;
    const Program p = random_program(c, rng, 30);
    ASSERT_LE(p.records.size(), c.capacity);
    Rig whole(c, c), parts(c, c);
    whole.push(p);
    for (const Record& r : p.records) {
      parts.ring[parts.head] = r;
      parts.planner->commit(parts.head++);
      if (rng() % 3 == 0) {
        parts.in.feed_override = 0.5 + 0.5 * static_cast<double>(rng() % 3);
        parts.planner->replan(parts.said());
        if (rng() % 3 == 0) parts.planner->newest();  // the reader takes some versions and misses others
      }
    }
    parts.in.feed_override = 1;
    parts.planner->replan(parts.said());
    const Plan &a = whole.planner->newest(), &b = parts.planner->newest();
    ASSERT_EQ(a.end, b.end);
    for (uint32_t k = 0; k < a.end; ++k) {
      if (whole.ring[k].kind != ItemKind::move) continue;
      const uint32_t o = whole.ring[k].segment.ordinal;
      ASSERT_EQ(a.exit2(o), b.exit2(o)) << "seed " << seed << " segment " << o;
      ASSERT_EQ(whole.ring[k].segment.acceleration, parts.ring[k].segment.acceleration);
    }
  }
}

TEST(Limits, SegmentsKeepEveryAxisAtTheirLimits) {
  std::mt19937_64 rng(7);
  const ExecutorConfig c = standard_config(4);
  const MotionLimits l = limits_of(c);
  double closest = 0;
  for (int n = 0; n < 200; ++n) {
    Program p = random_program(c, rng, 6);
    for (Record& r : p.records) {
      if (r.kind != ItemKind::move) continue;
      Segment& s = r.segment;
      AxisVec share;
      for (unsigned a = 0; a < c.axis_count; ++a) share[a] = static_cast<double>(rng() % 3) * 0.25;
      const SegmentShape shape = shape_of(s, l);
      set_segment_limits(s, shape, share, l);
      const double feed =
          s.rapid ? s.speed_limit : std::min(s.speed_limit, s.feed_mm_s * c.max_feed_override);
      for (int i = 0; i <= 200; ++i) {
        const CurvePoint q = curve_evaluate(s.curve, s.curve.length * i / 200.0, c.axis_count);
        for (unsigned a = 0; a < c.axis_count; ++a) {
          const double velocity = s.rapid ? c.limits[a].rapid : c.limits[a].velocity;
          ASSERT_LE(std::fabs(q.d1[a]) * s.speed_limit, velocity * (1 + 1e-9));
          for (const double sign : {-1.0, 1.0}) {
            const double used =
                std::fabs(q.d1[a] * s.acceleration * sign + q.d2[a] * feed * feed) / c.limits[a].acceleration;
            ASSERT_LE(used, (1 - share[a]) * (1 + 1e-9))
                << "axis " << a << " of serial " << r.serial << " in program " << n;
            closest = std::max(closest, used);
          }
        }
      }
    }
  }
  EXPECT_GT(closest, 0.999) << "and the limits are used";
}

TEST(Checker, SeesASoundPlanAsSound) {
  const ExecutorConfig c = standard_config();
  Rig rig(c, c);
  rig.push(corner(c, 20, 0.02));
  rig.run();
  EXPECT_EQ(rig.out.state, NC_STATE_IDLE);
  EXPECT_TRUE(rig.checker.ok()) << rig.checker.report();
  EXPECT_GT(rig.checker.worst_acceleration, 0.4) << "the step falls into two cycles";
}

TEST(Checker, SeesACornerPassedTooFast) {
  const ExecutorConfig c = standard_config();
  Rig rig(c, c);
  rig.push(corner(c, 20));
  rig.planner->newest().exit_speed2[0] = 20 * 20;
  rig.run();
  EXPECT_FALSE(rig.checker.ok());
}

TEST(Checker, SeesAPlannerThatBelievesInMoreAcceleration) {
  const ExecutorConfig c = standard_config();
  ExecutorConfig strong = c;
  for (unsigned i = 0; i < 3; ++i) strong.limits[i].acceleration *= 1.01;
  Rig rig(c, strong);
  rig.push(corner(c, 0));
  rig.run();
  EXPECT_FALSE(rig.checker.ok());
}

TEST(Checker, SeesAPlannerThatBelievesInMoreVelocity) {
  const ExecutorConfig c = standard_config();
  ExecutorConfig fast = c;
  for (unsigned i = 0; i < 3; ++i) fast.limits[i].velocity *= 1.01;
  Rig rig(c, fast);
  rig.push(corner(c, 0, 100, 1000));
  rig.run();
  EXPECT_FALSE(rig.checker.ok());
}

TEST(Checker, SeesAPerturbedPath) {
  const ExecutorConfig c = standard_config();
  Rig rig(c, c);
  Program p = corner(c, 0);
  // The second line is turned by 2 degrees without the planner's knowledge, which has planned its beginning as straight.
  rig.push(p);
  Curve& curve = rig.ring[2].segment.curve;
  curve.delta[1] = 20 * std::tan(to_rad(2));
  curve.end[1] = curve.start[1] + curve.delta[1];
  rig.run();
  EXPECT_FALSE(rig.checker.ok());
}

}  // namespace
}  // namespace nc::test
