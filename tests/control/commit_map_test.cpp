// SPDX-License-Identifier: Apache-2.0
// Commit under maps that do more than shift: what becomes of lines and arcs, of their place on the machine, and of the displayed coordinates.
#include "control/commit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

namespace nc::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr unsigned kAxes = 4;

class Stage {
 public:
  explicit Stage(const AxisVec& machine, double highest_z = 1e6) {
    system_.axis_count = kAxes;
    system_.axis[2].soft_limited = true;
    system_.axis[2].soft_min = -1e6;
    system_.axis[2].soft_max = highest_z;
    system_.axis[3].rotary = 1;
    config_.system = &system_;
    config_.marks = config_.records = 64;
    Arena measure;
    Commit().create(config_, measure);
    memory_ = std::make_unique<char[]>(measure.used() + 64);
    Arena arena(memory_.get(), measure.used() + 64);
    commit.create(config_, arena);
    commit.set_machine(machine);
  }
  /// The references of a move that has no shape and no parameters of its own.
  static Named named(const Affine& map) {
    static constexpr MotionSettings kNone{};
    return {&map, nullptr, &kNone};
  }
  nc_item shown(const Item& item) const {
    nc_item out{};
    commit.to_public(item, &out);
    return out;
  }
  Segment segment(const Item& item, const Affine& map) {
    Record record;
    commit.to_record(item, named(map), &record);
    return record.segment;
  }
  Commit commit;

 private:
  nc_system_config system_{};
  CommitConfig config_;
  std::unique_ptr<char[]> memory_;
};

Item move_of(const AxisVec& start, const AxisVec& end) {
  Item item;
  item.kind = ItemKind::move;
  item.move = Move(start, end, Compensation{});
  item.move.feed_mm_min = 600;
  return item;
}

/// An arc in the plane (h, v) about (ch, cv), from the angle `from` on; if axis 2 is not in the plane it moves by `rise` meanwhile.
Item arc_of(unsigned h, unsigned v, double ch, double cv, double radius, double from, double sweep, double rise) {
  AxisVec start{{1, 2, 3, 40}};
  start[h] = ch + radius * std::cos(from);
  start[v] = cv + radius * std::sin(from);
  AxisVec end = start;
  if (h != 2 && v != 2) end[2] += rise;
  end[h] = ch + radius * std::cos(from + sweep);
  end[v] = cv + radius * std::sin(from + sweep);
  Item item = move_of(start, end);
  item.move.kind = NC_MOVE_ARC;
  item.move.circular = true;
  item.move.plane = Plane::xy;
  item.move.plane_axis[0] = static_cast<uint8_t>(h);
  item.move.plane_axis[1] = static_cast<uint8_t>(v);
  item.move.circle = Circle{{ch, cv}, radius, radius, from, sweep};
  return item;
}

/// The point of an arc of arc_of() at `share` (0 to 1) of its length.
AxisVec on_arc(const Item& item, double share) {
  const Circle& c = item.move.circle;
  AxisVec p;
  for (unsigned i = 0; i < kAxes; ++i) p[i] = item.move.start[i] + share * (item.move.end[i] - item.move.start[i]);
  p[item.move.plane_axis[0]] = c.center[0] + c.radius_start * std::cos(c.angle_start + share * c.sweep);
  p[item.move.plane_axis[1]] = c.center[1] + c.radius_start * std::sin(c.angle_start + share * c.sweep);
  return p;
}

/// A random map that turns and reflects the three linear axes about any place.
Affine any_isometry(std::mt19937_64& random, bool tilts) {
  const auto any = [&random](double most) { return std::uniform_real_distribution<double>(-most, most)(random); };
  Affine map = Affine::rotation(0, 1, Affine::Angle::degrees(any(200)), any(50), any(50));
  bool fits = true;
  if (tilts) fits = map.then(Affine::rotation(1, 2, Affine::Angle::degrees(any(200)), any(50), any(50)));
  if (tilts) fits = fits && map.then(Affine::rotation(0, 2, Affine::Angle::degrees(any(200)), any(50), any(50)));
  for (unsigned i = 0; i < 3; ++i)
    if (any(1) > 0) fits = fits && map.then(Affine::stretch(i, -1, any(50)));
  EXPECT_TRUE(fits && map.then(Affine::translation({{any(100), any(100), any(100), any(100)}})));
  return map;
}

void expect_place(const AxisVec& is, const AxisVec& wanted, const char* what) {
  for (unsigned i = 0; i < kAxes; ++i) EXPECT_NEAR(is[i], wanted[i], 1e-9) << what << ", axis " << i;
}

TEST(CommitUnderAMap, EveryPointOfAnArcGoesWhereTheMapTakesIt) {
  std::mt19937_64 random(1);
  const unsigned planes[3][2] = {{0, 1}, {2, 0}, {1, 2}};
  for (unsigned run = 0; run < 300; ++run) {
    const bool tilts = run % 2 == 0;
    const unsigned* plane = planes[tilts ? run % 3 : 0];
    const Affine map = any_isometry(random, tilts);
    const Item item = arc_of(plane[0], plane[1], 5, -7, 3 + run % 5, 0.1 * run, run % 4 < 2 ? 2.5 : -4.0, run % 3);
    Stage stage(map.apply(item.move.start));
    ASSERT_EQ(stage.commit.commit(item, Stage::named(map)), Committed::yes) << run;
    const Curve& curve = stage.commit.curve();
    EXPECT_EQ(curve.circular, !tilts);
    for (double share = 0; share <= 1; share += 0.125)
      expect_place(curve_position(curve, share * curve.length, kAxes), map.apply(on_arc(item, share)), "on the arc");
    const double rise = item.move.end[2] - item.move.start[2], flat = std::fabs(item.move.circle.sweep) * item.move.circle.radius_start;
    EXPECT_NEAR(curve.length, plane[0] == 0 ? std::hypot(flat, rise) : flat, 1e-9);
    expect_place(stage.commit.machine(), map.apply(item.move.end), "end");
    const Segment segment = stage.segment(item, map);
    expect_place(segment.to_work.apply(stage.commit.machine()), item.move.end, "shown");
    // The item as the host sees it.
    const nc_move shown = stage.shown(item).u.move;
    AxisVec center = item.move.start;
    center[plane[0]] = 5;
    center[plane[1]] = -7;
    center = map.apply(center);
    ASSERT_EQ(shown.center_axes, tilts ? 3 : 2);
    EXPECT_EQ(shown.curved, tilts);
    for (unsigned i = 0; i < shown.center_axes; ++i) EXPECT_NEAR(shown.machine_center[i], center[shown.plane_axis[i]], 1e-9);
    EXPECT_NEAR(shown.radius, item.move.circle.radius_start, 1e-12);
    if (tilts) continue;
    EXPECT_EQ(shown.ccw, (item.move.circle.sweep > 0) != map.reflects(0, 1));
  }
}

TEST(CommitUnderAMap, TheWholeWayOfATiltedArcIsHeldAgainstTheLimits) {
  const Affine map = Affine::rotation(1, 2, Affine::Angle::degrees(90), 0, 0);  // the Y of the program goes along Z
  const Item item = arc_of(0, 1, 0, 0, 10, 0, kPi, 0);                         // over Y10
  Stage stage(map.apply(item.move.start), 10.001);
  ASSERT_EQ(stage.commit.commit(item, Stage::named(map)), Committed::yes);
  AxisVec low, high;
  curve_bounds(stage.commit.curve(), kAxes, &low, &high);
  EXPECT_NEAR(high[2], 10, 1e-9);
  EXPECT_NEAR(low[2], 0, 1e-9);
  EXPECT_NEAR(high[1], -3, 1e-9);  // this is the Z of the program
  EXPECT_NEAR(low[1], -3, 1e-9);
  Stage lower(map.apply(item.move.start), 9.999);
  EXPECT_EQ(lower.commit.commit(item, Stage::named(map)), Committed::soft_limit);
  EXPECT_EQ(lower.commit.limit_axis(), 2);
}

TEST(CommitUnderAMap, AnArcBeginsWhereTheMachineStands) {
  const Affine map = Affine::rotation(0, 2, Affine::Angle::degrees(30), 0, 0);
  const Item item = arc_of(0, 1, 0, 0, 10, 0, 1, 0);
  AxisVec elsewhere = map.apply(item.move.start);
  elsewhere[2] += 0.01;
  EXPECT_EQ(Stage(elsewhere).commit.commit(item, Stage::named(map)), Committed::displaced);
}

TEST(CommitUnderAMap, LinesAndTheCoordinatesShown) {
  std::mt19937_64 random(2);
  for (unsigned run = 0; run < 100; ++run) {
    const Affine map = any_isometry(random, true);
    const Item item = move_of({{1, 2, 3, 4}}, {{10, -20, 30, 44}});
    Stage stage(map.apply(item.move.start));
    ASSERT_EQ(stage.commit.commit(item, Stage::named(map)), Committed::yes);
    EXPECT_NEAR(stage.commit.curve().length, std::sqrt(9.0 * 9 + 22 * 22 + 27 * 27), 1e-9);
    const Segment segment = stage.segment(item, map);
    for (const double share : {0.0, 0.3, 1.0}) {
      const AxisVec machine = curve_position(stage.commit.curve(), share * stage.commit.curve().length, kAxes);
      expect_place(segment.to_work.apply(machine), {{1 + 9 * share, 2 - 22 * share, 3 + 27 * share, 4 + 40 * share}}, "shown");
    }
  }
}

}  // namespace
}  // namespace nc::test
