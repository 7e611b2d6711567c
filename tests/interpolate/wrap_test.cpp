// SPDX-License-Identifier: Apache-2.0
// Every counter between feeder and scan begins again after 2^31 or 2^32 (docs/counters.md): a machine whose counters are there gives the same
// positions as one that has just been switched on.
#include <gtest/gtest.h>

#include "support/seeds.hpp"
#include "test_machine.hpp"

namespace nc::test {
namespace {

struct Said {
  std::vector<AxisVec> positions;
  std::vector<Serial> serials;
  bool ended = true;
};

/// Lines that are passed at speed, corners, rests, an arc, stops of single block; as many records as fill the ring three times.
Program winding(const ExecutorConfig& c) {
  Program p(c);
  AxisVec at{};
  for (unsigned n = 0; n < 120; ++n) {
    at[n % 2] += n % 7 == 0 ? 3 : 0.4;
    if (n % 31 == 30) p.rapid(at);
    else p.line(at, 40 + n % 5);
    if (n % 23 == 22) p.arc(0, 1, 4, 0.3 * n, 2, 30);
    at = p.at();
    p.mark();
    p.action(NC_ACTION_OUTPUT, 0, 0, 1, n & 1);
    if (n % 40 == 39) p.gate(NC_GATE_IN_POSITION);
  }
  p.end();
  return p;
}

size_t place_behind(const Program& p, Serial last) {
  size_t n = 0;
  while (n < p.records.size() && p.records[n].serial != last) ++n;
  return n + 1;
}

/// Runs the program, then once more with holds, single block and truncations, then with an always changing override and a reset.
Said drive(const ExecutorConfig& c, uint32_t first) {
  Machine m(c);
  m.executor.count_from(first);
  Said said;
  const auto cycle = [&] {
    m.cycle();
    said.positions.push_back(m.command());
  };
  const Program p = winding(c);
  for (unsigned run = 0; run < 3; ++run) {
    m.next = 0;
    Program from_here(c, m.command());
    AxisVec home{};
    from_here.rapid(home);
    from_here.mark();
    for (const Record& r : p.records) {
      from_here.records.push_back(r);
      from_here.records.back().serial = from_here.records.size();
    }
    m.feed(from_here, 40);
    m.start();
    bool ended = false;
    for (unsigned n = 0; n < 60000 && !ended; ++n) {
      m.feed(from_here, 3);
      m.in.single_block = run == 1 && n % 400 < 40;
      m.in.feed_hold = run == 1 && n % 900 < 60;
      m.in.cycle_start = run == 1 && n % 50 == 0;
      m.in.reset = run == 2 && n == 700;
      if (run == 2) m.in.feed_override = n % 60 < 30 ? 0.7 : 1.2;  // a new plan, and new cells, again and again
      if (run == 1 && n % 900 == 50) {  // the truncation is asked for in one turn, and answered in another
        Serial last = 0;
        (void)m.executor.truncate(&last);
        cycle();
        if (m.executor.truncate(&last)) m.next = place_behind(from_here, last);
      }
      cycle();
      ended = m.out.state == NC_STATE_IDLE && n > 10;
    }
    said.ended = said.ended && ended;
    m.in = {};
    m.in.feed_override = m.in.rapid_override = 1;
    for (unsigned n = 0; n < 5; ++n) {
      m.feed(from_here, 0);
      cycle();
    }
  }
  for (const nc_event& e : m.events) said.serials.push_back(e.serial);
  EXPECT_LE(m.checker.worst_velocity, 1.001) << m.checker.report();
  return said;
}

class Wrap : public ::testing::TestWithParam<bool> {};

TEST_P(Wrap, TheSamePositionsBehindTheEndOfEveryCounter) {
  ExecutorConfig c = standard_config();
  c.capacity = 128;
  c.optimal = GetParam();
  for (unsigned i = 0; i < 3; ++i) c.limits[i].jerk = 40000;
  const Said fresh = drive(c, 0);
  ASSERT_TRUE(fresh.ended);
  ASSERT_GT(fresh.positions.size(), 3000u);
  // The counters pass their end at different moments of the run: records and segments, cells (several times as many), events.
  for (const uint32_t before : {1u, 2u, 3u, 60u, 100u, 333u, 700u, 1500u, 5000u}) {
    if (sanitized() && before != 2 && before != 333) continue;
    for (const uint32_t end : {0u, 0x80000000u, 0x40000000u}) {
      SCOPED_TRACE(std::to_string(before) + " in front of " + std::to_string(end));
      const Said late = drive(c, end - before);
      ASSERT_TRUE(late.ended);
      ASSERT_EQ(late.serials, fresh.serials);
      ASSERT_EQ(late.positions.size(), fresh.positions.size());
      for (size_t n = 0; n < fresh.positions.size(); ++n)
        for (unsigned i = 0; i < 3; ++i) ASSERT_EQ(late.positions[n][i], fresh.positions[n][i]) << "cycle " << n;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Wrap, ::testing::Bool(), [](const auto& mode) { return mode.param ? "Optimal" : "Trapezoid"; });

}  // namespace
}  // namespace nc::test
