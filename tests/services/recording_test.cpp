// SPDX-License-Identifier: Apache-2.0
// What a recording keeps of the values that it is given: each trigger, the rows in front of it, the ring that runs round, an end by hand; and the tap on a machine
// with a ladder, where values must be those of one scan.
#include "runtime/trace/recording.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "runtime/ladder_machine.hpp"
#include "runtime/trace/trace_tap.hpp"

namespace nc::rt::trace {
namespace {

struct Kept {
  std::vector<std::int32_t> values;
  std::vector<std::uint64_t> scans;
  bool triggered = false, complete = false;
  std::uint32_t trigger = 0;
};

// Gives the recording one value in each scan, from scan 100 on, until it has ended or there are no more; then it is stopped.
Kept record(When when, std::int32_t level, std::uint32_t rows, std::uint32_t before, const std::vector<std::int32_t>& values) {
  Plan plan;
  plan.sources.resize(1);
  plan.when = when;
  plan.level = level;
  plan.rows = rows;
  plan.before = before;
  EXPECT_STREQ(plan_fault(plan), "");
  Recording recording(plan);
  bool goes_on = true;
  for (std::size_t i = 0; i < values.size() && goes_on; ++i) {
    recording.row()[0] = values[i];
    goes_on = recording.end_row(100 + i, static_cast<std::int64_t>(i) * 1000);
  }
  if (goes_on) recording.stop();
  Kept kept;
  kept.triggered = recording.triggered();
  kept.complete = recording.state() == State::kComplete;
  kept.trigger = recording.trigger_row();
  for (std::uint32_t row = 0; row < recording.row_count(); ++row) {
    const Recording::Row at = recording.at(row);
    kept.values.push_back(at.values[0]);
    kept.scans.push_back(at.scan);
    EXPECT_EQ(at.time_ns, static_cast<std::int64_t>(at.scan - 100) * 1000);
  }
  EXPECT_EQ(recording.progress(), recording.row_count());
  return kept;
}

using Values = std::vector<std::int32_t>;

TEST(Recording, BeginsAtItsTrigger) {
  const struct {
    When when;
    std::int32_t level;
    Values values;
    std::uint64_t scan;  // of the trigger, 0 = it does not come
  } cases[] = {
      {When::kAtOnce, 1, {7, 7, 7}, 100},
      {When::kRise, 1, {0, 0, 1, 1, 1}, 102},
      {When::kRise, 1, {1, 1, 0, 0, 1, 1}, 104},
      {When::kRise, 5, {-3, 4, 5, 9}, 102},
      {When::kRise, 5, {-3, 4, 4, 4}, 0},
      {When::kFall, 5, {9, 5, 4, 4}, 102},
      {When::kFall, 1, {0, 0, 0, 0}, 0},
      {When::kChange, 1, {3, 3, 4, 4}, 102},
      {When::kChange, 1, {3, 3, 3, 3}, 0},
      {When::kHigh, 5, {5, 5, 5}, 100},
      {When::kHigh, 5, {-9, 4, 6, 6}, 102},
      {When::kLow, 5, {5, 5, 4, 4}, 102},
      {When::kLow, 5, {4, 4, 4}, 100},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(std::to_string(static_cast<int>(c.when)) + " at " + std::to_string(c.level));
    const Kept kept = record(c.when, c.level, 2, 0, c.values);
    EXPECT_EQ(kept.triggered, c.scan != 0);
    EXPECT_EQ(kept.complete, c.scan != 0);
    if (c.scan != 0) {
      EXPECT_EQ(kept.scans, (std::vector<std::uint64_t>{c.scan, c.scan + 1}));
    }
  }
}

TEST(Recording, KeepsWhatWasBeforeTheTrigger) {
  Values values(1000, 0);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::int32_t>(i);
  for (const std::uint32_t rows : {1u, 2u, 5u, 7u, 300u, 999u})
    for (std::uint32_t before = 0; before < rows; before += 1 + rows / 5)
      for (const std::int32_t level : {1, 2, 6, 400, 640}) {
        SCOPED_TRACE(std::to_string(rows) + " rows, " + std::to_string(before) + " before " + std::to_string(level));
        const Kept kept = record(When::kRise, level, rows, before, values);
        ASSERT_TRUE(kept.triggered);
        // A trigger that comes early is taken with as many rows as there are in front of it.
        const std::int32_t first = std::max(0, level - static_cast<std::int32_t>(before)), last = std::min(999, level + static_cast<std::int32_t>(rows - before) - 1);
        ASSERT_EQ(kept.values.size(), static_cast<std::size_t>(last - first + 1));
        for (std::size_t i = 0; i < kept.values.size(); ++i) {
          ASSERT_EQ(kept.values[i], first + static_cast<std::int32_t>(i));
          ASSERT_EQ(kept.scans[i], 100u + static_cast<unsigned>(kept.values[i]));
        }
        EXPECT_EQ(kept.values[kept.trigger], level);
      }
}

TEST(Recording, StoppedWithoutATriggerItHasTheNewest) {
  EXPECT_EQ(record(When::kHigh, 9, 3, 1, {1, 2, 3, 4, 5}).values, (Values{3, 4, 5}));
  EXPECT_EQ(record(When::kHigh, 9, 3, 1, {1, 2}).values, (Values{1, 2}));
  EXPECT_EQ(record(When::kHigh, 9, 3, 1, {}).values, Values{});
  const Kept begun = record(When::kHigh, 4, 4, 1, {1, 2, 3, 4});
  EXPECT_EQ(begun.values, (Values{3, 4}));
  EXPECT_TRUE(begun.triggered);
  EXPECT_FALSE(begun.complete);
}

TEST(Recording, ItsMemoryIsBounded) {
  Plan plan;
  EXPECT_STRNE(plan_fault(plan), "") << "no signal";
  plan.sources.resize(64);
  plan.rows = most_rows(64);
  EXPECT_STREQ(plan_fault(plan), "");
  EXPECT_LE(std::size_t{plan.rows} * row_bytes(64), kMostBytes);
  ++plan.rows;
  EXPECT_STRNE(plan_fault(plan), "");
  plan.rows = 10;
  plan.before = 1;
  EXPECT_STRNE(plan_fault(plan), "") << "before what?";
  plan.when = When::kLow;
  EXPECT_STREQ(plan_fault(plan), "");
  plan.before = 10;
  EXPECT_STRNE(plan_fault(plan), "");
  plan.before = 9;
  plan.trigger = 64;
  EXPECT_STRNE(plan_fault(plan), "");
  plan.trigger = 0;
  plan.sources.resize(65);
  EXPECT_STRNE(plan_fault(plan), "");
}

class Tap : public test::OwnLadder {
 protected:
  Plan plan(const std::vector<std::string>& names, std::uint32_t rows) {
    Plan plan;
    plan.rows = rows;
    for (const std::string& name : names) EXPECT_TRUE(runtime->trace()->find(name, &plan.sources.emplace_back())) << name;
    return plan;
  }
};

// D0 counts the scans, M1 follows in0, out0 follows M1: all of one scan must fit together.
constexpr char kLadder[] = "LD SM400\nINC D0\nLD in0\nOUT M1\nOUT out0\nLD SM400\nDMOV K-7 word_out\nLD nc.m_strobe\nOUT plc.fin2\nLDI in1\nOUT plc.interlock_n\nEND\n";

TEST_F(Tap, RecordsEveryScanOnceAndWhole) {
  use(kLadder);
  build();
  steps(10);
  ASSERT_TRUE(runtime->trace()->arm(plan({"D0", "in0", "M1", "out0", "word_out", "nc.mode_auto", "plc.interlock_n"}, 60)));
  const std::uint64_t begun = runtime->snapshot().scan;
  const std::int32_t counted = device("D0");
  for (int n = 0; n < 60; ++n) {
    EXPECT_TRUE(runtime->trace()->is_recording()) << n;
    in("in0", static_cast<std::uint32_t>(n) / 7 % 2);
    in("in1", n >= 30 ? 1 : 0);
    steps(1);
  }
  ASSERT_FALSE(runtime->trace()->is_recording());
  const Recording& recording = *runtime->trace()->recording();
  ASSERT_EQ(recording.row_count(), 60u);
  EXPECT_EQ(recording.state(), State::kComplete);
  for (std::uint32_t n = 0; n < 60; ++n) {
    const Recording::Row row = recording.at(n);
    const auto in0 = static_cast<std::int32_t>(n / 7 % 2);
    EXPECT_EQ(row.scan, begun + 1 + n);
    EXPECT_EQ(row.values[0], counted + 1 + static_cast<std::int32_t>(n));
    EXPECT_EQ(row.values[1], in0);
    EXPECT_EQ(row.values[2], in0);
    EXPECT_EQ(row.values[3], in0) << "the output of this scan, and not of the one before";
    EXPECT_EQ(row.values[4], -7);
    EXPECT_EQ(row.values[5], 1);
    EXPECT_EQ(row.values[6], n >= 30 ? 0 : 1);
    if (n > 0) {
      EXPECT_EQ(row.time_ns - recording.at(n - 1).time_ns, config.cycle_us * 1000) << n;
    }
  }
}

// What a program of the NC switches behind the ladder goes to the machine in the same scan.
TEST_F(Tap, PointsAreAsTheyGoToTheMachine) {
  use("LD nc.m_strobe\nOUT plc.fin2\nEND\n");
  build();
  ASSERT_TRUE(runtime->trace()->arm(plan({"out0"}, 2000)));
  start("#1100=1\nG4 X0.05\n#1100=0\nM30\n");
  std::vector<std::uint32_t> put;
  while (runtime->trace()->is_recording()) {
    steps(1);
    put.push_back(machine->outputs().value[config.points.find("out0")]);
  }
  const Recording& recording = *runtime->trace()->recording();
  unsigned on = 0;
  const std::size_t before = recording.row_count() - put.size();  // scans of the commands that have started the program
  for (std::size_t n = 0; n < put.size(); ++n) {
    EXPECT_EQ(recording.at(static_cast<std::uint32_t>(before + n)).values[0], static_cast<std::int32_t>(put[n])) << n;
    on += put[n];
  }
  EXPECT_GT(on, 20u);
  EXPECT_LT(on, 200u);
}

TEST_F(Tap, FindsSignalsPointsAndDevices) {
  use(kLadder);
  build();
  Source source;
  EXPECT_TRUE(runtime->trace()->find("nc.feed", &source));
  EXPECT_EQ(source.kind, Source::Kind::kSignal);
  EXPECT_TRUE(runtime->trace()->find("in0", &source));
  EXPECT_EQ(source.kind, Source::Kind::kPoint);
  EXPECT_TRUE(runtime->trace()->find("TN3", &source));
  EXPECT_EQ(source.kind, Source::Kind::kDevice);
  for (const char* none : {"", "nc.", "nc.feed.X", "in9", "Q3", "D999999", "M-1", "K5"}) EXPECT_FALSE(runtime->trace()->find(none, &source)) << none;
}

TEST_F(Tap, OneAtATimeAndTheOwnerCanEndIt) {
  use(kLadder);
  build();
  Plan waits = plan({"in0"}, 50);
  waits.when = When::kHigh;
  waits.before = 20;
  ASSERT_TRUE(runtime->trace()->arm(waits));
  EXPECT_FALSE(runtime->trace()->arm(waits));
  steps(300);
  EXPECT_EQ(runtime->trace()->recording()->state(), State::kWaiting);
  runtime->trace()->stop();
  EXPECT_TRUE(runtime->trace()->is_recording()) << "it is the scan's until its next run";
  steps(1);
  EXPECT_FALSE(runtime->trace()->is_recording());
  EXPECT_EQ(runtime->trace()->recording()->state(), State::kStopped);
  EXPECT_EQ(runtime->trace()->recording()->row_count(), 50u);
  ASSERT_TRUE(runtime->trace()->arm(waits)) << "the stop was for the recording before";
  in("in0", 1);
  steps(30);
  EXPECT_EQ(runtime->trace()->recording()->state(), State::kComplete);
}

}  // namespace
}  // namespace nc::rt::trace
