// SPDX-License-Identifier: Apache-2.0
// The offline machine: where skip moves end, how the clock goes, when events fire.
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
  world.spindle(300);
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
  EXPECT_TRUE(world.waits_for_line());
  world.on_item(items.items[2], 0);
  EXPECT_EQ(world.answer(NC_SYNC_INPUT).input[0], 1u);
  EXPECT_EQ(world.answer(NC_SYNC_INPUT).input[3], 0x80000000u);
  EXPECT_FALSE(world.waits_for_line());
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
  world.on_item(items.items[0], 4);
  EXPECT_EQ(world.input(0), 0u);
  world.on_item(items.items[1], 4);  // the block behind line 2 stands on line 4
  EXPECT_EQ(world.input(0), 1u);
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
