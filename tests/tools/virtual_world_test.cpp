// SPDX-License-Identifier: Apache-2.0
// The offline machine: where skip moves end, how the clock runs, when events come.
#include "tools/lib/virtual_world.hpp"

#include <gtest/gtest.h>

#include "fake_items.hpp"

namespace nc::tools {
namespace {

tools::Setup setup_of(const std::string& text) {
  tools::Setup setup;
  std::string error;
  EXPECT_TRUE(parse_setup(text, "s.json", &setup, &error)) << error;
  return setup;
}

nc_move skip_move(nc_axes from, nc_axes to, uint8_t mask = 1) {
  FakeItems items;
  nc_move m = items.line(1, from, to, 100, NC_MOVE_SKIP).u.move;
  m.skip_mask = mask;
  for (int i = 0; i < 3; ++i) m.work.v[i] = to.v[i] + 10;  // the workpiece origin lies at machine -10
  return m;
}

TEST(Skip, EndsAtTheSurfaceExactly) {
  const tools::Setup setup = setup_of(R"({"skip": [{"box": {"X": [20, 30], "Y": [-5, 5]}}]})");
  VirtualWorld world(setup, xyz());
  nc_move m = skip_move({{0, 0, 0}}, {{100, 10, -40}});
  ASSERT_TRUE(world.execute(&m));
  EXPECT_DOUBLE_EQ(m.machine.v[0], 20);
  EXPECT_DOUBLE_EQ(m.machine.v[1], 2);
  EXPECT_DOUBLE_EQ(m.machine.v[2], -8);
  EXPECT_DOUBLE_EQ(m.work.v[0], 30);
  EXPECT_DOUBLE_EQ(m.work.v[2], 2);
  const nc_world answer = world.answer(NC_SYNC_SKIP);
  EXPECT_TRUE(answer.skipped);
  EXPECT_DOUBLE_EQ(answer.skip_machine.v[0], 20);
  EXPECT_DOUBLE_EQ(answer.machine.v[2], -8);
}

TEST(Skip, MissesBesideAndBehind) {
  const tools::Setup setup = setup_of(R"({"skip": [{"box": {"X": [20, 30], "Y": [-5, 5]}}]})");
  VirtualWorld world(setup, xyz());
  nc_move beside = skip_move({{0, 6, 0}}, {{100, 6, 0}});
  ASSERT_TRUE(world.execute(&beside));
  EXPECT_EQ(beside.machine.v[0], 100);
  EXPECT_FALSE(world.answer(NC_SYNC_SKIP).skipped);
  nc_move short_of = skip_move({{0, 0, 0}}, {{20, 0, 0}});
  world.execute(&short_of);
  EXPECT_TRUE(world.answer(NC_SYNC_SKIP).skipped) << "it ends where it would go in";
  EXPECT_EQ(short_of.machine.v[0], 20);
  nc_move beyond = skip_move({{30, 0, 0}}, {{100, 0, 0}});
  world.execute(&beyond);
  EXPECT_FALSE(world.answer(NC_SYNC_SKIP).skipped) << "it leaves the surface";
  nc_move other_signal = skip_move({{0, 0, 0}}, {{100, 0, 0}}, 2);
  world.execute(&other_signal);
  EXPECT_FALSE(world.answer(NC_SYNC_SKIP).skipped) << "the move listens to signal 2 only";
}

TEST(Skip, SignalOnAtTheStartMovesNothing) {
  const tools::Setup setup = setup_of(R"({"skip": [{"box": {"Z": [-10, 0]}}]})");
  VirtualWorld world(setup, xyz());
  nc_move inside = skip_move({{1, 0, -5}}, {{1, 0, 50}});
  EXPECT_FALSE(world.execute(&inside));
  EXPECT_TRUE(world.answer(NC_SYNC_SKIP).skipped);
  EXPECT_EQ(world.machine().v[2], -5);
  nc_move from_surface_in = skip_move({{0, 0, 0}}, {{0, 0, -5}});
  EXPECT_FALSE(world.execute(&from_surface_in));
  EXPECT_TRUE(world.answer(NC_SYNC_SKIP).skipped);
  nc_move from_surface_out = skip_move({{0, 0, 0}}, {{0, 0, 5}});
  EXPECT_TRUE(world.execute(&from_surface_out));
  EXPECT_FALSE(world.answer(NC_SYNC_SKIP).skipped);
  nc_move along = skip_move({{0, 0, 0}}, {{7, 0, 0}});
  EXPECT_TRUE(world.execute(&along));
  EXPECT_FALSE(world.answer(NC_SYNC_SKIP).skipped);
}

TEST(Skip, TheNearestOfSeveralSolidsWins) {
  const tools::Setup setup = setup_of(
      R"({"skip": [{"signal": 2, "box": {"X": [50, 60]}}, {"signal": 1, "box": {"X": [70, 80]}}, {"signal": 2, "box": {"X": [40, 45]}}]})");
  VirtualWorld world(setup, xyz());
  nc_move both = skip_move({{0, 0, 0}}, {{100, 0, 0}}, 3);
  world.execute(&both);
  EXPECT_DOUBLE_EQ(both.machine.v[0], 40);
  nc_move first = skip_move({{0, 0, 0}}, {{100, 0, 0}}, 1);
  world.execute(&first);
  EXPECT_DOUBLE_EQ(first.machine.v[0], 70);
  EXPECT_EQ(world.signals_at({{42, 0, 0}}), 2u);
  EXPECT_EQ(world.signals_at({{75, 0, 0}}), 1u);
  EXPECT_EQ(world.signals_at({{70, 0, 0}}), 0u);
}

TEST(Skip, AMoveThatEndsOnTheSurfaceHasItsSignal) {
  const tools::Setup setup = setup_of(R"({"skip": [{"box": {"Z": [-40, -10]}}]})");
  VirtualWorld world(setup, xyz());
  nc_move onto = skip_move({{0, 0, 0}}, {{0, 0, -10}});
  EXPECT_TRUE(world.execute(&onto));
  EXPECT_TRUE(world.answer(NC_SYNC_SKIP).skipped);
  EXPECT_EQ(world.machine().v[2], -10);
  nc_move short_of_it = skip_move({{0, 0, 0}}, {{0, 0, -9.999}});
  EXPECT_TRUE(world.execute(&short_of_it));
  EXPECT_FALSE(world.answer(NC_SYNC_SKIP).skipped);
}

TEST(Skip, ASignalThatIsOnEndsADwell) {  // M700 15.3 (2)
  const tools::Setup setup = setup_of(R"({"skip": [{"signal": 2, "box": {"Z": [-1, 1]}}], "clock": "1970-01-01T00:00:00"})");
  VirtualWorld world(setup, xyz());
  world.dwell(false, 10, 2);
  EXPECT_EQ(world.answer(0).power_on_ms, 0);
  world.dwell(false, 10, 1);
  EXPECT_EQ(world.answer(0).power_on_ms, 10000);
}

TEST(Skip, AMoveAwayEndsWhereNothingIsTouched) {
  const tools::Setup setup = setup_of(R"({"skip": [{"box": {"X": [20, 30], "Y": [-5, 5]}}, {"box": {"X": [28, 40], "Y": [-5, 5]}}]})");
  VirtualWorld world(setup, xyz());
  const auto away = [&](nc_axes from, nc_axes to, uint8_t mask = 1) {
    nc_move m = skip_move(from, to, mask);
    m.skip_away = true;
    world.execute(&m);
    return m.machine.v[0];
  };
  EXPECT_NEAR(away({{22, 0, 0}}, {{-50, 0, 0}}), 20, 1e-6);
  EXPECT_TRUE(world.skipped());
  EXPECT_NEAR(away({{25, 0, 0}}, {{100, 0, 0}}), 40, 1e-6) << "out of the one within the other";
  EXPECT_NEAR(away({{20, 0, 0}}, {{0, 0, 0}}), 20, 1e-6) << "where a probe has just touched";
  EXPECT_LT(world.answer(NC_SYNC_SKIP).machine.v[0], 20) << "and it has moved";
  EXPECT_TRUE(world.skipped());
  EXPECT_EQ(away({{22, 0, 0}}, {{29, 0, 0}}), 29) << "it stays inside";
  EXPECT_FALSE(world.skipped());
  EXPECT_EQ(away({{5, 0, 0}}, {{0, 0, 0}}), 5) << "it touches nothing where it begins";
  EXPECT_TRUE(world.skipped());
  const tools::Setup of_work = setup_of(R"({"skip": [{"coordinates": "work", "ball": {"radius": 3}, "box": {"X": [50, 90], "Y": [0, 60], "Z": [-30, 8]}}]})");
  VirtualWorld ball(of_work, xyz());
  nc_move out = skip_move({{40, 20, -5}}, {{0, 20, -5}});
  out.skip_away = true;
  ASSERT_TRUE(ball.execute(&out));
  EXPECT_NEAR(out.work.v[0], 47, 1e-6);
}

TEST(Clock, GoesByLengthOverFeedRapidsDwellsAndReads) {
  const tools::Setup setup = setup_of(R"({"clock": "1970-01-01T00:00:00"})");
  VirtualWorld world(setup, xyz());
  FakeItems items;
  nc_move line = items.line(1, {{0, 0, 0}}, {{100, 0, 0}}, 600).u.move;                // 10 s
  nc_move rapid = items.line(1, {{100, 0, 0}}, {{0, 0, 0}}, 0, NC_MOVE_RAPID).u.move;  // 0.6 s
  world.execute(&line);
  world.execute(&rapid);
  world.dwell(false, 1.5);
  EXPECT_DOUBLE_EQ(world.answer(0).power_on_ms, 12100);
  world.dwell(true, 5);  // the spindle stands: no time passes
  world.clock().speed(300);
  world.dwell(true, 5);  // 1 s
  EXPECT_EQ(world.answer(NC_SYNC_CLOCK).clock_ms, 13100);
  EXPECT_EQ(world.answer(NC_SYNC_CLOCK).clock_ms, 13101) << "a read lets 1 ms pass";
  EXPECT_EQ(world.answer(NC_SYNC_INPUT).clock_ms, 13102);
  EXPECT_EQ(world.answer(NC_SYNC_INPUT).clock_ms, 13102) << "another sync does not";
  nc_move synchronous = items.line(1, {{0, 0, 0}}, {{30, 0, 0}}, 0).u.move;
  synchronous.feed_mm_rev = 0.5;  // at 300/min: 150 mm/min, 12 s
  world.execute(&synchronous);
  EXPECT_EQ(world.answer(NC_SYNC_INPUT).clock_ms, 25102);
}

// M700 10.3, 10.4: the speed of the spindle follows the place, within the clamp.
TEST(Clock, AFeedPerRevolutionGoesByTheSurfaceSpeedAndItsClamp) {
  FakeItems items;
  const auto control = [](nc_control_index index, double value, uint32_t mask, uint32_t bits) {
    nc_action action = {};
    action.kind = NC_ACTION_CONTROL;
    action.index = index;
    action.value = value;
    action.mask = mask;
    action.bits = bits;
    return action;
  };
  PathClock clock;
  nc_move along = items.line(1, {{50, 0, 0}}, {{50, 10, 0}}, 0).u.move, across = items.line(1, {{10, 0, 0}}, {{50, 0, 0}}, 0).u.move;
  along.feed_mm_rev = across.feed_mm_rev = 1;
  clock.speed(100);  // of G96: m/min
  clock.control(control(NC_CONTROL_SURFACE_SPEED, 100, 0, 1), {});
  const double per_mm = 2 * M_PI / 100'000 * 60;  // s for a revolution and each mm of the radius
  EXPECT_FALSE(clock.is_constant());
  EXPECT_NEAR(clock.seconds(along), 10 * 50 * per_mm, 1e-9);
  EXPECT_NEAR(clock.seconds(across), (50 * 50 - 10 * 10) / 2 * per_mm, 1e-9);
  EXPECT_NEAR(clock.share_after(across, (30 * 30 - 10 * 10) / 2 * per_mm), 0.5, 1e-6);
  clock.control(control(NC_CONTROL_SPINDLE_CLAMP, NC_CLAMP_S, 0, 200), {});
  EXPECT_NEAR(clock.seconds(along), 10.0 / 200 * 60, 1e-9);
  clock.control(control(NC_CONTROL_SURFACE_SPEED, 0, 0, 0), {{1000, 0, 0}});  // the spindle keeps its speed
  EXPECT_NEAR(clock.seconds(along), 10 * 1000 * per_mm, 1e-9);
  clock.speed(1000);
  EXPECT_NEAR(clock.seconds(along), 10.0 / 1000 * 60, 1e-9) << "such a clamp acts with a constant surface speed alone";
  clock.control(control(NC_CONTROL_SPINDLE_CLAMP, NC_CLAMP_S | NC_CLAMP_ALWAYS, 0, 500), {});
  EXPECT_NEAR(clock.seconds(along), 10.0 / 500 * 60, 1e-9);
}

TEST(Clock, ATaperThreadGoesByItsLongAxisAndAHelixPerhapsByItsArc) {
  FakeItems items;
  PathClock clock;
  clock.speed(600);
  nc_move taper = items.line(1, {{0, 0, 0}}, {{3, 0, -20}}, 0, NC_MOVE_THREAD).u.move;
  taper.feed_mm_rev = 2;
  EXPECT_NEAR(clock.seconds(taper), 1, 1e-12);
  nc_move helix = items.line(1, {{10, 0, 0}}, {{-10, 0, 5}}, 600, NC_MOVE_HELIX).u.move;
  helix.plane_axis[1] = 1;
  helix.center_axes = 2;
  helix.radius = 10;
  helix.sweep_deg = 180;
  helix.length = std::hypot(10 * M_PI, 5);
  EXPECT_NEAR(clock.seconds(helix), helix.length / 10, 1e-12);
  clock.set_helix_in_plane(true);
  EXPECT_NEAR(clock.seconds(helix), M_PI, 1e-12);
}

TEST(Clock, ManyReadsLoseNoMillisecond) {
  const tools::Setup setup = setup_of("{}");
  VirtualWorld world(setup, xyz());
  for (int i = 0; i < 100'000; ++i) ASSERT_EQ(world.answer(NC_SYNC_CLOCK).power_on_ms, i);
}

TEST(Events, FireOnceWhenTheirLineOrTimeComes) {
  const tools::Setup setup = setup_of(R"({"inputs": {"1001": 1}, "events": [
      {"when": {"line": 3}, "inputs": {"1000": 1, "1001": 0}},
      {"when": {"line": 3}, "inputs": {"1295": 1}},
      {"when": {"seconds": 2}, "inputs": {"1000": 0}}]})");
  VirtualWorld world(setup, xyz());
  FakeItems items;
  items.mark(2, {});
  items.mark(3, {}, 1);  // line 3 of a sub program
  items.mark(3, {});
  EXPECT_FALSE(world.on_item(items.items[0], 0));
  EXPECT_FALSE(world.on_item(items.items[1], 0));
  EXPECT_EQ(world.answer(NC_SYNC_INPUT).input[0], 2u);
  EXPECT_TRUE(world.waits_for_block());
  world.on_item(items.items[2], 0);
  EXPECT_EQ(world.answer(NC_SYNC_INPUT).input[0], 1u);
  EXPECT_EQ(world.answer(NC_SYNC_INPUT).input[3], 0x80000000u);
  EXPECT_FALSE(world.waits_for_block());
  world.dwell(false, 2);
  world.on_item(items.items[2], 0);
  EXPECT_EQ(world.answer(NC_SYNC_INPUT).input[0], 0u);
}

TEST(Events, ALineThatCallsBeginsWithItsSubProgram) {
  const tools::Setup setup = setup_of(R"({"events": [{"when": {"line": 4}, "inputs": {"1000": 1}}]})");
  VirtualWorld world(setup, xyz());
  FakeItems items;
  items.mark(2, {});
  items.mark(1, {}, 1);
  world.on_item(items.items[0], 2);
  EXPECT_EQ(world.input(0), 0u);
  world.on_item(items.items[1], 4);  // line 4 of the main program has called it
  EXPECT_EQ(world.input(0), 1u);
}

TEST(Hits, AreTakenBySkipMovesInTheirOrder) {
  const tools::Setup setup = setup_of(R"({"hits": [{"at": {"X": 30}}, null, {"at": {"Z": 5}}, {"at": {"X": 12}, "when": {"line": 9}}, {"at": {"X": 999}}]})");
  VirtualWorld world(setup, xyz());
  FakeItems items;
  const auto at_line = [&](uint32_t line, uint8_t depth = 0) {
    items.mark(line, {}, depth);
    world.on_item(items.items.back(), 0);
  };
  at_line(1);
  nc_move first = skip_move({{0, 0, 0}}, {{100, 10, 0}});  // work X is machine X + 10
  ASSERT_TRUE(world.execute(&first));
  EXPECT_TRUE(world.skipped());
  EXPECT_DOUBLE_EQ(first.work.v[0], 30);
  EXPECT_DOUBLE_EQ(first.machine.v[0], 20);
  EXPECT_DOUBLE_EQ(first.machine.v[1], 2);
  EXPECT_DOUBLE_EQ(world.answer(NC_SYNC_SKIP).skip_machine.v[0], 20);
  at_line(9);  // the entry for this line, not the next one in order
  nc_move named = skip_move({{0, 0, 0}}, {{100, 0, 0}});
  world.execute(&named);
  EXPECT_DOUBLE_EQ(named.work.v[0], 12);
  at_line(10);
  nc_move second = skip_move({{0, 0, 0}}, {{100, 0, 0}});
  world.execute(&second);
  EXPECT_FALSE(world.skipped());
  EXPECT_EQ(second.machine.v[0], 100);
  EXPECT_EQ(world.unused().size(), 2u);
  nc_move third = skip_move({{0, 0, 10}}, {{0, 0, -50}});
  world.execute(&third);
  EXPECT_DOUBLE_EQ(third.machine.v[2], -5);
  at_line(12);
  nc_move off = skip_move({{0, 0, 0}}, {{100, 0, 0}});
  world.execute(&off);
  EXPECT_FALSE(world.skipped());
  ASSERT_EQ(world.unused().size(), 1u);
  EXPECT_NE(world.unused()[0].find("s.json:1: hits[4]: the skip move on line 12 does not pass this place"), std::string::npos) << world.unused()[0];
}

TEST(Hits, BelongToASignal) {
  const tools::Setup setup = setup_of(R"({"hits": [{"signal": 2, "at": {"X": 30}}, {"signal": 2, "at": {"X": 30}}]})");
  VirtualWorld world(setup, xyz());
  nc_move other = skip_move({{0, 0, 0}}, {{100, 0, 0}}, 1);
  world.execute(&other);
  EXPECT_FALSE(world.skipped());
  nc_move both = skip_move({{0, 0, 0}}, {{100, 0, 0}}, 3);
  world.execute(&both);
  EXPECT_TRUE(world.skipped());
}

TEST(Skip, SolidsOfTheWorkpieceAndABall) {
  // A box with holes, a ball, in workpiece coordinates, which differ by 10 from those of the machine (see skip_move).
  const tools::Setup setup = setup_of(R"({"skip": [{"coordinates": "work", "ball": {"radius": 3}, "box": {"X": [50, 90], "Y": [0, 60], "Z": [-30, 8]},
      "holes": [{"cylinder": {"axis": "Z", "center": {"X": 70, "Y": 30}, "radius": 15}}]}]})");
  VirtualWorld world(setup, xyz());
  nc_move side = skip_move({{0, 20, -5}}, {{100, 20, -5}});
  ASSERT_TRUE(world.execute(&side));
  EXPECT_NEAR(side.work.v[0], 47, 1e-9);
  EXPECT_NEAR(side.machine.v[0], 37, 1e-9);
  nc_move bore = skip_move({{60, 20, -5}}, {{60, 100, -5}});  // the middle of the hole is at machine 60, 20
  ASSERT_TRUE(world.execute(&bore));
  EXPECT_NEAR(bore.work.v[1], 42, 1e-9);
  EXPECT_EQ(world.signals_at({{60, 20, -5}}), 0u);
  EXPECT_EQ(world.signals_at({{60, 40, -5}}), 1u);
}

TEST(Events, SwitchTheSkipSignal) {
  const tools::Setup setup = setup_of(R"({"events": [{"when": {"line": 3}, "signals": {"skip": 1}}, {"when": {"line": 4}, "signals": {"skip": 0}},
      {"when": {"seconds": 2.5}, "signals": {"skip2": 1}}]})");
  VirtualWorld world(setup, xyz());
  FakeItems items;
  items.mark(3, {});
  items.mark(4, {});
  world.on_item(items.items[0], 0);
  nc_move none = skip_move({{0, 0, 0}}, {{10, 0, 0}});
  EXPECT_FALSE(world.execute(&none));  // it is on already: nothing moves
  EXPECT_TRUE(world.skipped());
  world.on_item(items.items[1], 0);
  nc_move all = skip_move({{0, 0, 0}}, {{2, 0, 0}}, 3);  // 100 mm/min: 1.2 s
  ASSERT_TRUE(world.execute(&all));
  EXPECT_FALSE(world.skipped());
  nc_move cut = skip_move({{2, 0, 0}}, {{12, 0, 0}}, 2);  // from 1.2 s to 7.2 s: the signal comes at 2.5 s
  ASSERT_TRUE(world.execute(&cut));
  EXPECT_TRUE(world.skipped());
  EXPECT_NEAR(cut.machine.v[0], 2 + 1.3 / 0.6, 1e-9);
  EXPECT_EQ(world.seconds(), 2.5);
  world.on_item(items.items[1], 0);
  EXPECT_EQ(world.signals_at({}), 2u);
  EXPECT_TRUE(world.unused().empty());
}

TEST(Events, OfMCodesAndLinesOfSubPrograms) {
  const tools::Setup setup = setup_of(R"({"events": [{"when": {"m": 6}, "inputs": {"1000": 1}}, {"when": {"line": 2, "program": 1000}, "inputs": {"1001": 1}},
      {"when": {"m": 7}, "inputs": {"1002": 1}},
      {"when": {"line": 2, "program": 1001}, "inputs": {"1003": 1}}, {"when": {"line": 77}, "inputs": {"1004": 1}}, {"when": {"seconds": 900}}]})");
  VirtualWorld world(setup, xyz());
  FakeItems items;
  items.mark(2, {});     // of the main program
  items.mark(2, {}, 1);  // of O1000
  nc_item& m = items.add(NC_ITEM_ACTION, 3);
  m.u.action.kind = NC_ACTION_M;
  m.u.action.value = 6;
  world.on_item(items.items[0], 0);
  EXPECT_EQ(world.input(0), 0u);
  world.on_item(items.items[1], 0);
  EXPECT_EQ(world.input(0), 2u);
  world.on_item(items.items[2], 0);
  EXPECT_EQ(world.input(0), 3u);
  const std::vector<std::string> unused = world.unused();
  ASSERT_EQ(unused.size(), 4u);
  EXPECT_NE(unused[0].find("events[2]: has not fired: M7 was not given out"), std::string::npos) << unused[0];
  EXPECT_NE(unused[1].find("events[3]: has not fired: line 2 of O1001"), std::string::npos) << unused[1];
  EXPECT_NE(unused[2].find("events[4]: has not fired: line 77 of the main program"), std::string::npos) << unused[2];
  EXPECT_NE(unused[3].find("events[5]: has not fired: the program ended"), std::string::npos) << unused[3];
  m.u.action.value = 7;
  world.on_item(m, 0);
  EXPECT_EQ(world.input(0), 7u);
}

TEST(Events, ResetEndsTheRun) {
  const tools::Setup setup =
      setup_of(R"({"events": [{"when": {"line": 1}, "signals": {"feed_hold": 1, "reset": 1}}]})");
  VirtualWorld world(setup, xyz());
  FakeItems items;
  items.mark(1, {});
  EXPECT_TRUE(world.on_item(items.items[0], 0));
}

}  // namespace
}  // namespace nc::tools
