// SPDX-License-Identifier: Apache-2.0
// Edges with their times: debouncing, quadrature, and where the axes were.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "hal/edge_latch.hpp"
#include "hal/gpio/edge_filter.hpp"
#include "hal/gpio/quadrature.hpp"

namespace {

using nc::hal::Command;
using nc::hal::EdgeLatch;
using nc::hal::Feedback;
using nc::hal::PlaceTrack;
using nc::hal::ProbeSeen;
using nc::hal::gpio::EdgeFilter;
using nc::hal::gpio::Quadrature;

constexpr std::int64_t kMs = 1'000'000;

// ---- debouncing ----

TEST(EdgeFilter, WithoutDebounceEveryEdgeCountsAtItsTime) {
  EdgeFilter filter;
  EdgeFilter::Change change;
  filter.begin(false, 0);
  EXPECT_FALSE(filter.settle(5, &change));
  EXPECT_TRUE(filter.edge(true, 7));
  ASSERT_TRUE(filter.settle(7, &change));
  EXPECT_TRUE(change.level);
  EXPECT_EQ(change.time_ns, 7);
  EXPECT_FALSE(filter.edge(true, 9)) << "the edge between was lost";
  EXPECT_FALSE(filter.settle(9, &change));
}

TEST(EdgeFilter, AContactThatBouncesCountsFromItsFirstEdgeOnWhenItHasStood) {
  EdgeFilter filter(5 * kMs);
  EdgeFilter::Change change;
  filter.begin(false, 0);
  bool level = false;
  for (const std::int64_t edge : {100, 101, 103, 104, 106}) {
    EXPECT_FALSE(filter.settle(edge * kMs, &change));
    EXPECT_TRUE(filter.edge(level = !level, edge * kMs));
  }
  EXPECT_FALSE(filter.settle(111 * kMs - 1, &change));
  ASSERT_TRUE(filter.settle(111 * kMs, &change));
  EXPECT_TRUE(change.level);
  EXPECT_EQ(change.time_ns, 100 * kMs);
}

TEST(EdgeFilter, APulseThatIsShorterThanTheDebounceIsNone) {
  EdgeFilter filter(5 * kMs);
  EdgeFilter::Change change;
  filter.begin(false, 0);
  (void)filter.edge(true, 10 * kMs);
  EXPECT_FALSE(filter.settle(12 * kMs, &change));
  (void)filter.edge(false, 12 * kMs);
  EXPECT_FALSE(filter.settle(20 * kMs, &change));
  (void)filter.edge(true, 20 * kMs);
  ASSERT_TRUE(filter.settle(25 * kMs, &change));
  EXPECT_EQ(change.time_ns, 20 * kMs) << "the edge of the pulse is not that of the contact";
}

// ---- quadrature ----

// Levels of the lines at a place in quarters of a period.
bool a_at(std::int64_t place) { return ((place % 4 + 4) % 4 == 1) || ((place % 4 + 4) % 4 == 2); }
bool b_at(std::int64_t place) { return (place % 4 + 4) % 4 >= 2; }

RC_GTEST_PROP(Quadrature, ItCountsAnyWayToAndFro, (const std::vector<bool>& way)) {
  for (const unsigned counts : {1u, 2u, 4u}) {
    Quadrature wheel(counts, 32), narrow(counts, 16);
    std::int64_t place = 0;
    for (Quadrature* each : {&wheel, &narrow}) each->begin(false, false);
    for (const bool up : way) {
      place += up ? 1 : -1;
      for (Quadrature* each : {&wheel, &narrow}) each->step(a_at(place), b_at(place));
    }
    const auto whole = static_cast<std::int64_t>(std::floor(static_cast<double>(place * counts) / 4 + (counts == 4 ? 0 : 0.5)));
    RC_ASSERT(wheel.count() == static_cast<std::uint32_t>(whole));
    RC_ASSERT(narrow.count() == (static_cast<std::uint32_t>(whole) & 0xffffu));
    RC_ASSERT(wheel.faults() == 0u);
  }
}

TEST(Quadrature, BothLinesAtOnceAreAFaultAndNoWay) {
  Quadrature wheel(4, 32);
  wheel.begin(false, false);
  wheel.step(true, true);
  EXPECT_EQ(wheel.count(), 0u);
  EXPECT_EQ(wheel.faults(), 1u);
  wheel.step(false, true);
  EXPECT_EQ(wheel.count(), 1u) << "it counts on from where it is";
  wheel.begin(false, false);
  EXPECT_EQ(wheel.count(), 1u);
}

TEST(Quadrature, AWheelThatTremblesInItsDetentDoesNotCount) {
  Quadrature wheel(1, 32);
  wheel.begin(false, false);
  for (const std::int64_t place : {1, 0, -1, 0, 1, 0}) {
    wheel.step(a_at(place), b_at(place));
    EXPECT_EQ(wheel.count(), 0u) << place;
  }
  for (std::int64_t place = 1; place <= 8; ++place) wheel.step(a_at(place), b_at(place));
  EXPECT_EQ(wheel.count(), 2u);
}

// Nobody knows how far it went in a fault or while its chip was away, but where in a period it stands its lines say: so it does not tremble behind that either, and no
// count is added by it.
TEST(Quadrature, BehindAFaultOrALossItDoesNotTrembleEither) {
  for (const bool lost_chip : {false, true})
    for (const std::int64_t stood : {0, 1, 2, 3, 4, 5, -1, -2, -3})
      for (const std::int64_t jump : {0, 1, 2, 3}) {
        if (!lost_chip && jump != 2) continue;  // what one edge does is no fault
        SCOPED_TRACE(std::to_string(stood) + " + " + std::to_string(jump) + (lost_chip ? " lost" : ""));
        Quadrature wheel(1, 32);
        wheel.begin(false, false);
        std::int64_t place = 0;
        for (; place != stood; wheel.step(a_at(place), b_at(place))) place += stood > 0 ? 1 : -1;
        const std::uint32_t count = wheel.count();
        place += jump;
        if (lost_chip) wheel.begin(a_at(place), b_at(place));
        else wheel.step(a_at(place), b_at(place));
        EXPECT_EQ(wheel.count(), count);
        while (place % 4 != 0) ++place, wheel.step(a_at(place), b_at(place));  // to its next detent
        const std::uint32_t rests = wheel.count();
        for (const std::int64_t by : {1, 0, -1, 0}) {
          wheel.step(a_at(place + by), b_at(place + by));
          EXPECT_EQ(wheel.count(), rests) << by;
        }
      }
}

// ---- the place at a time ----

nc_axes at(double x, double y = 0) {
  nc_axes place{};
  place.v[0] = x;
  place.v[1] = y;
  return place;
}

TEST(PlaceTrack, APlaceLiesOnTheLineBetweenTwoScans) {
  PlaceTrack track;
  nc_axes place{};
  EXPECT_EQ(track.at(5, &place), PlaceTrack::Found::kNotYet);
  track.note(100, at(1, 10));
  track.note(200, at(2, 30));
  EXPECT_EQ(track.at(201, &place), PlaceTrack::Found::kNotYet);
  EXPECT_EQ(track.at(99, &place), PlaceTrack::Found::kTooOld);
  ASSERT_EQ(track.at(125, &place), PlaceTrack::Found::kYes);
  EXPECT_DOUBLE_EQ(place.v[0], 1.25);
  EXPECT_DOUBLE_EQ(place.v[1], 15);
  ASSERT_EQ(track.at(200, &place), PlaceTrack::Found::kYes);
  EXPECT_EQ(place.v[0], 2);
  track.note(200, at(3));
  ASSERT_EQ(track.at(200, &place), PlaceTrack::Found::kYes);
  EXPECT_EQ(place.v[0], 3) << "a second place of that time";
  track.note(150, at(7));
  EXPECT_EQ(track.at(125, &place), PlaceTrack::Found::kTooOld) << "a clock that went back begins the track anew";
}

TEST(PlaceTrack, ItKeepsTheLastPlaces) {
  PlaceTrack track;
  nc_axes place{};
  for (std::int64_t t = 0; t < 1000; ++t) track.note(t * 10, at(static_cast<double>(t)));
  EXPECT_EQ(track.at((999 - PlaceTrack::kPlaces) * 10 + 9, &place), PlaceTrack::Found::kTooOld);
  ASSERT_EQ(track.at((1000 - PlaceTrack::kPlaces) * 10 + 5, &place), PlaceTrack::Found::kYes);
  EXPECT_DOUBLE_EQ(place.v[0], 1000 - PlaceTrack::kPlaces + 0.5);
}

// ---- the skip signal ----

class EdgeLatchTest : public testing::Test {
 protected:
  // One scan at `now`, whose machine is at x and whose probe of signal 2 is as `seen` says.
  void scan(std::int64_t now, double x, bool on, std::int64_t edge_ns = -1, std::int64_t measured = 0) {
    SystemOf(feedback) = {};
    SystemOf(feedback).actual_valid = measured >= 0;
    SystemOf(feedback).actual = at(x);
    SystemOf(feedback).actual_ns = measured;
    latch.begin(now, feedback);
    latch.add(0, {0, 1, on, edge_ns >= 0, edge_ns < 0 ? 0 : edge_ns}, &feedback);
  }
  static nc::hal::SystemFeedback& SystemOf(Feedback& feedback) { return feedback.system[0]; }
  nc::hal::SystemFeedback& out = feedback.system[0];
  Feedback feedback;
  EdgeLatch latch{2};
};

TEST_F(EdgeLatchTest, TheSignalComesWithThePlaceAtItsEdgeAndStaysWithoutIt) {
  scan(1000, 1, false);
  EXPECT_EQ(out.skip, 0u);
  scan(2000, 2, true, 1500);
  EXPECT_EQ(out.skip, 2u);
  EXPECT_EQ(out.skip_latched, 2u);
  EXPECT_DOUBLE_EQ(out.skip_place.v[0], 1.5);
  scan(3000, 3, true);
  EXPECT_EQ(out.skip, 2u);
  EXPECT_EQ(out.skip_latched, 0u) << "a skip move that begins now finds the signal on";
  scan(4000, 4, false);
  EXPECT_EQ(out.skip, 0u);
}

TEST_F(EdgeLatchTest, APulseBetweenTwoScansIsASignalOfOneScan) {
  scan(1000, 1, false);
  scan(2000, 2, false, 1250);
  EXPECT_EQ(out.skip_latched & out.skip, 2u);
  EXPECT_DOUBLE_EQ(out.skip_place.v[0], 1.25);
  scan(3000, 3, false);
  EXPECT_EQ(out.skip, 0u);
}

TEST_F(EdgeLatchTest, WhereTheMachineMeasuresLaterTheSignalWaitsForThePlace) {
  scan(3000, 1, false, -1, 1000);
  scan(4000, 2, true, 3500, 2000);
  EXPECT_EQ(out.skip, 0u) << "though the contact is closed";
  scan(5000, 3, false, 4500, 3000);
  EXPECT_EQ(out.skip, 0u) << "a bounce in the meantime does not count";
  scan(6000, 4, true, -1, 4000);
  EXPECT_EQ(out.skip_latched & out.skip, 2u);
  EXPECT_DOUBLE_EQ(out.skip_place.v[0], 3.5);
}

TEST_F(EdgeLatchTest, WhatHasNoPlaceIsASignalAllTheSame) {
  scan(1'000'000, 1, false);
  scan(2'000'000, 2, true, 999'999);
  EXPECT_EQ(out.skip, 2u) << "older than the track";
  EXPECT_EQ(out.skip_latched, 0u);
  scan(3'000'000, 2, false);
  scan(4'000'000, 2, true, 0);
  EXPECT_EQ(out.skip, 2u) << "without a time";
  EXPECT_EQ(out.skip_latched, 0u);
  scan(5'000'000, 2, false);
  std::int64_t now = 6'000'000;
  scan(now, 2, true, std::int64_t{1} << 60);
  unsigned scans = 0;
  for (; out.skip == 0 && scans < 100; ++scans) scan(now += 1'000'000, 2, true);
  EXPECT_EQ(scans, 19u) << "a time that does not come";
  EXPECT_EQ(out.skip_latched, 0u);
}

TEST_F(EdgeLatchTest, WithoutAMeasurementThePlaceIsTheCommandedOne) {
  Command command;
  command.system[0].position = at(10);
  latch.commanded(command);
  scan(1000, 99, false, -1, -1);
  command.system[0].position = at(11);
  latch.commanded(command);
  scan(2000, 99, true, 1250, -1);
  EXPECT_EQ(out.skip_latched, 2u);
  EXPECT_DOUBLE_EQ(out.skip_place.v[0], 10.25);
}

TEST_F(EdgeLatchTest, OfTwoEdgesInAScanTheEarlierHasThePlace) {
  scan(1000, 1, false);
  out = {};
  out.actual_valid = true;
  out.actual = at(2);
  latch.begin(2000, feedback);
  latch.add(0, {0, 1, true, true, 1750}, &feedback);
  latch.add(1, {0, 4, true, true, 1250}, &feedback);
  EXPECT_EQ(out.skip, 2u | 16u);
  EXPECT_EQ(out.skip_latched, 16u);
  EXPECT_DOUBLE_EQ(out.skip_place.v[0], 1.25);
}

TEST_F(EdgeLatchTest, AProbeOfTheDrivesKeepsItsPlace) {
  scan(1000, 1, false);
  out = {};
  out.actual_valid = true;
  out.skip = out.skip_latched = 1;
  out.skip_place = at(-7);
  latch.begin(2000, feedback);
  latch.add(0, {0, 1, true, true, 1750}, &feedback);
  EXPECT_EQ(out.skip, 3u);
  EXPECT_EQ(out.skip_latched, 1u);
  EXPECT_EQ(out.skip_place.v[0], -7);
}

TEST_F(EdgeLatchTest, ALostMachineHasNoTrack) {
  scan(1000, 1, false);
  feedback.lost = true;
  latch.begin(1500, feedback);
  feedback.lost = false;
  scan(2000, 2, true, 1750);
  EXPECT_EQ(out.skip, 2u);
  EXPECT_EQ(out.skip_latched, 0u);
}

// An axis that speeds up at `a` is within a T^2 / 8 of the line between two scans, however much the scans tremble.
RC_GTEST_PROP(EdgeLatchProperty, ThePlaceIsThatOfTheEdgeAtAnySpeed, ()) {
  const double speed = *rc::gen::inRange(1, 201), acceleration = *rc::gen::inRange(-500, 501) * 4;  // mm/s, mm/s2
  const auto place = [&](std::int64_t t) { return speed * static_cast<double>(t) * 1e-9 + acceleration / 2 * std::pow(static_cast<double>(t) * 1e-9, 2); };
  EdgeLatch latch(1);
  Feedback feedback;
  std::int64_t before = 0, now = 0;
  for (unsigned n = 0; n < 50; ++n) {
    before = now;
    now += kMs + *rc::gen::inRange<std::int64_t>(-kMs / 5, kMs / 5);
    nc::hal::SystemFeedback& out = feedback.system[0];
    out = {};
    out.actual_valid = true;
    out.actual = at(place(now));
    const std::int64_t edge = before + *rc::gen::inRange<std::int64_t>(1, now - before);
    latch.begin(now, feedback);
    latch.add(0, {0, 0, true, n > 0, edge}, &feedback);
    if (n == 0) continue;
    const double span = static_cast<double>(now - before) * 1e-9;
    RC_ASSERT(out.skip_latched == 1u);
    RC_ASSERT(std::abs(out.skip_place.v[0] - place(edge)) <= std::abs(acceleration) * span * span / 8 + 1e-9);
  }
}

}  // namespace
