// SPDX-License-Identifier: Apache-2.0
// Macro interrupts, input changes and resets at random points of random macro programs, all in one run: the machine
// executes the same until the reset as the trace with the same events, the reset leaves the same, and so does the run
// after it.
#include <gtest/gtest.h>

#include <deque>

#include "online_helpers.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

const uint32_t kPrograms = sanitized() ? 10 : 40;

/// A run of the machine: its items, and its answers to the syncs.
struct MachineRun {
  std::vector<nc_event> events;
  std::deque<nc_world> answers;
  bool ended = false, reset = false;
  unsigned input_changes = 0;
};

/// Makes the program read an input instead of the clock, which differs from run to run; everything else that it reads is part of the events.
std::string with_reads(std::string text) {
  for (size_t at; (at = text.find("#3001")) != std::string::npos;) text.replace(at, 5, "#1033");
  // Blocks that read the machine and move: when they are cut they must go on with the values that they have read.
  for (size_t at = 0; (at = text.find("G1 X", at)) != std::string::npos; at += 4)
    if (text.compare(at, 5, "G1 X[") != 0 && text.find('.', at) < text.find_first_of(" \n", at + 3))
      text.insert(text.find_first_of(" \n", at + 3), "+#1000");
  return text;
}

/// From cycle start to the end, or until the reset in cycle `reset_at` (0 = none) is through.
MachineRun run_machine(Bench& bench, std::mt19937& random, nc_inputs& in, unsigned reset_at) {
  MachineRun run;
  nc_control* control = bench.control();
  nc_outputs out{};
  bool idle = false;
  for (unsigned n = 1; n < 400000 && !run.ended && !idle; ++n) {
    nc_feed(control, 1 + random() % 40);
    in.reset = reset_at != 0 && n >= reset_at;
    in.cycle_start = n == 2;
    in.fin = out.strobe != 0;
    in.macro_interrupt = out.state == NC_STATE_RUNNING && random() % 50 == 0;
    if (random() % 30 == 0) {
      in.input[random() % 2] ^= 1u << random() % 8;
      ++run.input_changes;
    }
    nc_cycle(control, &in, &out);
    nc_event event;
    while (nc_event_poll(control, 0, &event, nullptr) == NC_OK) {
      run.events.push_back(event);
      run.ended = run.ended || event.kind == NC_ITEM_END;
      if (event.kind != NC_ITEM_SYNC) continue;
      nc_world world{};
      world.machine = event.machine;
      for (unsigned w = 0; w < NC_WORDS; ++w) world.input[w] = in.input[w];
      run.answers.push_back(world);
    }
    idle = in.reset && out.state == NC_STATE_IDLE;
    run.reset = run.reset || (idle && !run.ended);
  }
  in.reset = in.macro_interrupt = in.cycle_start = false;
  for (unsigned n = 0; n < 3; ++n) {  // the feeder handles the reset
    nc_feed(control, 100);
    nc_cycle(control, &in, &out);
  }
  if (run.reset)  // how much of an unfinished block was executed depends on the machine: it is not compared
    while (!run.events.empty() && run.events.back().kind != NC_ITEM_MARK) run.events.pop_back();
  return run;
}

/// The trace with the events that the machine has seen, up to its last item.
Outcome trace_machine(Bench& bench, MachineRun& run) {
  const std::vector<Seen> interrupts = interrupts_of(run.events);
  bench.on_sync = [&](const nc_item&) {
    ASSERT_FALSE(run.answers.empty());
    for (unsigned w = 0; w < NC_WORDS; ++w) bench.input[w] = run.answers.front().input[w];
    run.answers.pop_front();
  };
  Outcome traced;
  size_t next = 0;
  Step step;
  while (traced.steps.size() < run.events.size()) {
    traced.status = bench.pull(&step);
    if (traced.status == NC_BUDGET) continue;
    if (traced.status != NC_OK) break;
    bool take_back = false, ignored = false;
    if (next < interrupts.size() &&
        step.item.serial == interrupts[next].behind + (interrupts[next].inside ? 1 : 0)) {
      ++next;
      nc_interrupt_signal(bench.control(), 0, true, &take_back);
      nc_interrupt_signal(bench.control(), 0, false, &ignored);
    }
    if (!take_back) traced.steps.push_back(step);
  }
  bench.on_sync = {};
  EXPECT_EQ(next, interrupts.size());
  return traced;
}

/// The items around item `at` as text, for the message of a failed test.
std::string around(const MachineRun& run, const Outcome& traced, size_t at) {
  std::string text;
  for (size_t i = at < 6 ? 0 : at - 6; i < at + 4 && i < run.events.size() && i < traced.steps.size(); ++i) {
    const nc_event& e = run.events[i];
    const nc_item& t = traced.steps[i].item;
    text += "\n#" + std::to_string(e.serial) + " kind " + std::to_string(e.kind) + " O" +
            std::to_string(e.source.program) + " line " + std::to_string(e.source.line) + " X" +
            brief(e.machine.v[0]) + " Y" + brief(e.machine.v[1]) + " Z" + brief(e.machine.v[2]) +
            "   traced #" + std::to_string(t.serial) + " kind " + std::to_string(t.kind) + " O" +
            std::to_string(t.source.program) + " line " + std::to_string(t.source.line) + " X" +
            brief(traced.steps[i].machine.v[0]);
  }
  return text;
}

void expect_same(const MachineRun& run, const Outcome& traced) {
  for (size_t i = 0; i < run.events.size() && i < traced.steps.size(); ++i) {
    const Step& step = traced.steps[i];
    const nc_event& event = run.events[i];
    ASSERT_EQ(event.serial, step.item.serial) << around(run, traced, i);
    ASSERT_EQ(event.kind, step.item.kind) << around(run, traced, i);
    ASSERT_EQ(event.source.line, step.item.source.line) << around(run, traced, i);
    ASSERT_EQ(event.source.program, step.item.source.program) << around(run, traced, i);
    if (event.kind != NC_ITEM_MOVE) continue;  // at other items the machine may stand where a move was cut
    for (unsigned axis = 0; axis < 3; ++axis)
      ASSERT_NEAR(event.machine.v[axis], step.machine.v[axis], 1e-9) << around(run, traced, i);
  }
  ASSERT_EQ(run.events.size(), traced.steps.size()) << around(run, traced, traced.steps.size());
}

TEST(Disturbance, InterruptsInputsAndResetsTogether) {
  unsigned served = 0, reset = 0, inputs = 0, syncs = 0, compared = 0, ends = 0;
  for (uint32_t seed = 0; seed < kPrograms; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomProgram program = ProgramMaker(seed + 2500, true, false).make();
    for (std::string& sub : program.subs) sub = with_reads(sub);
    const std::string text = "M96 P1000\n" + with_reads(program.main);
    const bool moves = seed % 3 != 0;
    const auto prepare = [&](Bench& bench) {
      set_up(bench, program);
      bench.param("1174", "100");
      // The interrupt program moves to a place at which no move of the program can have been cut; else its own move would have no length.
      bench.add("O1000", std::string("#199=#199+1\n#198=#1000+#1034\nIF[#1001 EQ 1] GOTO 5\n") +
                             (moves ? "G90 G49 G80 G40 G0 X[#199+0.00037] Y[5+#198] Z30.\nM7\n"
                                    : "#197=#1035\nG91 F1\n") +
                             "N5 M99\n");
      bench.param("1229/bit0", "1").param("1113", seed % 5 == 0 ? "1" : "0");
    };
    Bench online(NC_DIALECT_M700, machine(seed % 2 == 0 ? 64 : 256)), offline(NC_DIALECT_M700, machine(256));
    prepare(online);
    prepare(offline);
    online.start(text);
    offline.start(text);
    std::mt19937 random(seed);
    nc_inputs in{};
    in.feed_override = in.rapid_override = 1;
    in.spindle[0].rev_per_s = 50;
    for (unsigned pass = 0; pass < 3; ++pass) {
      SCOPED_TRACE("pass " + std::to_string(pass));
      MachineRun run = run_machine(online, random, in, pass < 2 ? 20 + random() % 1200 : 0);
      served += static_cast<unsigned>(interrupts_of(run.events).size());
      syncs += static_cast<unsigned>(run.answers.size());
      reset += run.reset;
      inputs += run.input_changes;
      ends += run.ended;
      const Outcome traced = trace_machine(offline, run);
      expect_same(run, traced);
      if (HasFatalFailure()) return;
      compared += static_cast<unsigned>(run.events.size());
      nc_reset(offline.control(), 0);
      nc_reset(online.control(), 0);
      ASSERT_EQ(tables(online), tables(offline));
      nc_outputs out{};
      nc_cycle(online.control(), &in, &out);
      offline.at(out.command.v[0], out.command.v[1], out.command.v[2]);
    }
  }
  EXPECT_GT(served, 2 * kPrograms);
  EXPECT_GT(reset, kPrograms / 2);
  EXPECT_GT(ends, kPrograms / 2);
  EXPECT_GT(inputs, 10 * kPrograms);
  EXPECT_GT(syncs, 2 * kPrograms);
  EXPECT_GT(compared, 50 * kPrograms);
}

}  // namespace
}  // namespace nc::test
