// SPDX-License-Identifier: Apache-2.0
// Feeder and scan on two threads, as fast as both can, and with everything that they exchange: records, plans, events,
// syncs, truncation, resets. Under the thread sanitizer this shows that they share nothing else.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "interpolate/random_program.hpp"
#include "interpolate/test_machine.hpp"

namespace nc::test {
namespace {

/// The side of the scan's thread: an operator who uses the switches at random. Everything that is shared with the test is
/// atomic.
struct Operator {
  std::atomic<bool> stop{false}, calm{false};
  std::atomic<uint32_t> resets{0};
  std::atomic<double> worst{0};

  void run(Machine& m, uint64_t seed, bool with_resets) {
    std::mt19937_64 rng(seed);
    const auto chance = [&](unsigned one_in) { return rng() % one_in == 0; };
    nc_inputs in = m.in;
    nc_outputs out{};
    LimitChecker checker(m.config);
    while (!stop.load(std::memory_order_relaxed)) {
      const bool quiet = calm.load(std::memory_order_relaxed);
      if (chance(200)) in.feed_override = static_cast<double>(rng() % 21) / 10;
      if (chance(300)) in.single_block = !in.single_block;
      if (chance(200)) in.feed_hold = !in.feed_hold;
      if (quiet) {
        in.feed_hold = in.single_block = false;
        in.feed_override = 1;
      }
      in.reset = with_resets && !quiet && chance(5000);
      if (in.reset) resets.fetch_add(1, std::memory_order_relaxed);
      in.cycle_start = !in.cycle_start && out.state != NC_STATE_RUNNING;
      in.fin = out.strobe != 0;
      m.executor.cycle(in, out);
      checker.sample(out);
      if (chance(64)) std::this_thread::yield();
    }
    worst.store(std::max(checker.worst_velocity, checker.worst_acceleration));
  }
};

TEST(Threads, EverythingPushedIsExecutedInOrder) {
  std::mt19937_64 rng(11);
  ExecutorConfig c = standard_config();
  c.capacity = 64;
  const Program p = random_program(c, rng, 60);
  Machine m(c);
  Operator op;
  std::thread scan([&] { op.run(m, 5, false); });
  std::vector<nc_event> events;
  uint64_t dropped = 0;
  nc_event e;
  const auto poll = [&] {
    while (m.executor.poll_event(&e, &dropped)) events.push_back(e);
  };
  nc_world world{};
  for (uint64_t n = 0; n < 200000000 && !(m.next == p.records.size() && m.executor.drained()); ++n) {
    m.feed(p, 1 + static_cast<unsigned>(rng() % 8));
    poll();
    (void)m.executor.commanded();
    if (m.next > 0 && p.records[m.next - 1].kind == ItemKind::sync)
      (void)m.executor.sync_reached(p.records[m.next - 1].serial, &world);
    if (n % 16 == 0) std::this_thread::yield();
  }
  EXPECT_TRUE(m.executor.drained());
  op.stop = true;
  scan.join();
  poll();
  EXPECT_LE(op.worst.load(), 1.001);
  // The host may have been too slow: dropped events were counted, and the others are in order.
  EXPECT_EQ(events.size() + dropped, p.records.size());
  for (size_t i = 1; i < events.size(); ++i) EXPECT_GT(events[i].serial, events[i - 1].serial);
}

TEST(Threads, ResetsAndTruncationLeaveTheMachineUsable) {
  ExecutorConfig c = standard_config();
  c.capacity = 128;
  Machine m(c);
  Operator op;
  std::thread scan([&] { op.run(m, 6, true); });
  std::mt19937_64 rng(12);
  Serial serial = 0;
  uint32_t epoch = m.epoch();
  AxisVec at = m.executor.commanded();
  unsigned cuts = 0;
  bool waiting = false;
  const auto push = [&](Record r) {
    r.serial = ++serial;
    r.epoch = epoch;
    m.executor.push(r);
  };
  for (uint64_t round = 0; round < 20000000 && (op.resets.load() < 60 || cuts < 12); ++round) {
    m.executor.run_taken(m.executor.run());
    const uint32_t now = m.epoch();
    if (now != epoch) {  // begin again at the place of the machine
      epoch = now;
      at = m.executor.commanded();
      waiting = false;
    }
    if (waiting && m.executor.drained()) {  // the next block begins where the kept one has ended
      at = m.executor.commanded();
      waiting = false;
    }
    for (int n = 0; n < 4 && !waiting && m.executor.room() > 4; ++n) {
      AxisVec end = at;
      end[rng() % 3] += static_cast<double>(rng() % 2001) * 1e-3 - 1;
      if (end == at) continue;
      Program p(c, at);
      p.line(end, 80);
      p.mark();
      if (rng() % 10 == 0) p.gate(NC_GATE_DWELL_SECONDS, 0.002);
      for (const Record& r : p.records) push(r);
      at = end;
    }
    m.executor.plan();
    Serial last = 0;
    if (!waiting && rng() % 64 == 0 && m.executor.truncate(&last)) {
      ++cuts;
      waiting = true;
    }
    std::this_thread::yield();
  }
  op.calm = true;
  for (int n = 0; n < 20000000 && !m.executor.drained(); ++n) {
    m.executor.plan();
    std::this_thread::yield();
  }
  EXPECT_TRUE(m.executor.drained());
  op.stop = true;
  scan.join();
  EXPECT_LE(op.worst.load(), 1.001);
  EXPECT_GE(op.resets.load(), 60u);
  EXPECT_GE(cuts, 12u);
  std::printf("%u resets, %u truncations, %llu records\n", op.resets.load(), cuts,
              static_cast<unsigned long long>(serial));
}

}  // namespace
}  // namespace nc::test
