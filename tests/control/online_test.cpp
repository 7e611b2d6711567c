// SPDX-License-Identifier: Apache-2.0
// The two ways to drive a control give the same stream: with holds, overrides, single block and recalculation requests
// nc_cycle() executes the items that nc_pull() gives.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "online_helpers.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

const auto kPrograms = static_cast<uint32_t>(seeds(40, 12));

struct Executed {
  std::vector<nc_event> events;
  std::string left;
  bool ended = false;
  unsigned recalculated = 0;
};

struct Disturbance {
  bool hold = false, single = false, override_changes = false, slow_fin = false, recalculate = false;
};

Executed execute(Bench& bench, const std::string& text, const Disturbance& disturb, uint32_t seed) {
  Drive drive(bench, text);
  nc_inputs& in = drive.in;
  if (disturb.slow_fin) drive.fin_cycles = 4;
  std::mt19937 random(seed);
  Executed done;
  bool asking = false;
  for (unsigned n = 0; n < 400000 && !drive.ended; ++n) {
    if (random() % 3 != 0 || n < 3) nc_feed(bench.control(), 1 + random() % 40);  // the feeder is slower than the scan at times
    const bool stopped = drive.out.state == NC_STATE_STOPPED;
    if (asking || (disturb.recalculate && stopped && random() % 3 == 0)) {
      const nc_status status = nc_recalculate(bench.control(), 0);
      done.recalculated += status == NC_OK;
      asking = status == NC_WAITING && stopped;
    }
    in.cycle_start = !asking && (n == 2 || (n > 2 && n % 7 == 0));
    if (disturb.hold) in.feed_hold = random() % 40 < 3;
    if (disturb.single) in.single_block = (n / 500) % 2 == 0;
    if (disturb.override_changes && random() % 50 == 0) in.feed_override = 0.2 + static_cast<double>(random() % 18) / 10;
    drive.step(0);
  }
  EXPECT_EQ(drive.dropped, 0u);
  done.events = drive.events;
  done.ended = drive.ended;
  done.left = left_by(bench);
  return done;
}

void compare(const Disturbance& disturb, uint32_t look_ahead) {
  unsigned recalculated = 0;
  for (uint32_t seed = 0; seed < kPrograms; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RandomProgram program = ProgramMaker(seed + 500, false).make();
    Bench offline(NC_DIALECT_M700, machine(256));
    set_up(offline, program);
    const Outcome expected = offline.run(program.main);
    if (!expected.ended_ok) continue;
    Bench online(NC_DIALECT_M700, machine(look_ahead));
    set_up(online, program);
    const Executed done = execute(online, program.main, disturb, seed);
    ASSERT_TRUE(done.ended);
    ASSERT_EQ(done.events.size(), expected.steps.size());
    for (size_t i = 0; i < done.events.size(); ++i) {
      const Step& step = expected.steps[i];
      const nc_event& event = done.events[i];
      ASSERT_EQ(event.serial, step.item.serial);
      ASSERT_EQ(event.kind, step.item.kind) << event.serial;
      ASSERT_EQ(event.source.line, step.item.source.line) << event.serial;
      for (unsigned axis = 0; axis < 3; ++axis) ASSERT_NEAR(event.machine.v[axis], step.machine.v[axis], 1e-9) << event.serial;
    }
    EXPECT_EQ(done.left, left_by(offline));
    recalculated += done.recalculated;
  }
  if (disturb.recalculate) {
    EXPECT_GT(recalculated, kPrograms);
  }
}

TEST(Online, ExecutesWhatWasPulled) { compare({}, 256); }
TEST(Online, ASmallRing) { compare({}, 64); }
TEST(Online, HoldsAndOverrides) { compare({.hold = true, .override_changes = true}, 64); }
TEST(Online, SingleBlockAndSlowCompletion) { compare({.single = true, .slow_fin = true}, 128); }
TEST(Online, RecalculationAtEveryStop) { compare({.single = true, .recalculate = true}, 128); }

/// M700 13.12: an interrupt program that neither moves nor gives out codes changes nothing, whenever the signal comes, inside of
/// contours, cycles, sub programs and macros too.
TEST(Online, InterruptsAtRandomPoints) {
  unsigned served = 0;
  for (uint32_t seed = 0; seed < kPrograms; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RandomProgram program = ProgramMaker(seed + 900, false).make();
    const std::string text = "M96 P1000\n" + program.main;
    const auto prepare = [&](Bench& bench) {
      set_up(bench, program);
      bench.add("O1000", "#199=#199+1\nG91 F1\nM99\n");
      bench.param("1229/bit0", "1");  // the local level of the program, whatever it is
    };
    Bench offline(NC_DIALECT_M700, machine(256));
    prepare(offline);
    const Outcome expected = offline.run(text);
    if (!expected.ended_ok) continue;
    Bench online(NC_DIALECT_M700, machine(seed % 2 == 0 ? 64 : 256));
    prepare(online);
    Drive drive(online, text);
    std::mt19937 random(seed);
    for (unsigned n = 0; n < 400000 && !drive.ended; ++n) {
      const unsigned feed = random() % 3 != 0 || n < 3 ? 1 + random() % 40 : 0;
      drive.in.cycle_start = n == 2 || (n > 2 && n % 7 == 0);
      drive.in.macro_interrupt = random() % 25 == 0;
      drive.step(feed);
    }
    const nc_outputs& out = drive.out;
    ASSERT_TRUE(drive.ended) << drive.alarm() << " line " << out.source.line << " state " << int{out.state} << " cause " << int{out.cause};
    const std::vector<nc_axes> ends = drive.ends();
    const std::vector<nc_move> moves = expected.moves();
    ASSERT_EQ(ends.size(), moves.size());
    for (size_t i = 0; i < ends.size(); ++i)
      for (unsigned axis = 0; axis < 3; ++axis) ASSERT_NEAR(ends[i].v[axis], moves[i].machine.v[axis], 1e-9) << i;
    for (const auto& [number, value] : expected.vars) {
      if (number == 199) continue;
      EXPECT_EQ(brief(online.var_now(number)), brief(value)) << number;
    }
    for (unsigned n = 1; n <= 20; ++n) EXPECT_EQ(online.tool_now(n), offline.tool_now(n)) << n;
    served += std::isnan(online.var_now(199)) ? 0 : static_cast<unsigned>(online.var_now(199));
  }
  EXPECT_GT(served, kPrograms);
}

/// A run on the machine in which `wanted` switches the interrupt signal: its items, and the places of the axes in every cycle.
struct Interrupted {
  std::vector<nc_event> events;
  std::vector<nc_axes> places;
  bool ended = false;
};
Interrupted run_interrupted(Bench& bench, const std::string& text, const std::function<bool(const nc_outputs&)>& wanted, unsigned fin_cycles = 1) {
  Drive drive(bench, text);
  drive.fin_cycles = fin_cycles;
  Interrupted run;
  while (drive.cycle < 50000 && !drive.ended) {
    drive.press_start();
    drive.in.macro_interrupt = wanted(drive.out);
    drive.step(50);
    run.places.push_back(drive.out.command);
  }
  run.events = drive.events;
  run.ended = drive.ended;
  return run;
}

/// X at the moment when Z leaves zero, NaN = never.
double x_when_z_moves(const Interrupted& run) {
  for (const nc_axes& place : run.places)
    if (place.v[2] > 0) return place.v[0];
  return NAN;
}

const auto kSlowMachine = [](nc_config& c) {
  c.cycle_s = 0.004;
  for (unsigned i = 0; i < 3; ++i) {
    c.system[0].axis[i].rapid = 200;
    c.system[0].axis[i].max_velocity = 100;
    c.system[0].axis[i].max_acceleration = 500;
  }
};

// M700 13.12, type 1: the move stops at once; with moves in the interrupt program what is left of the block is lost.
TEST(OnlineInterrupt, InTheMiddleOfAMove) {
  Bench bench(NC_DIALECT_M700, kSlowMachine);
  bench.add("O1000", "#100=#5001\nG0 Z7.\nM99\n");
  const Interrupted run = run_interrupted(bench, "M96 P1000\nG1 X100. F3000\nY5.\nM30", [](const nc_outputs& out) { return out.command.v[0] > 20; });
  ASSERT_TRUE(run.ended);
  const double x = x_when_z_moves(run);
  EXPECT_GT(x, 20);
  EXPECT_LT(x, 25);  // 50 mm/s, 500 mm/s2: rest after 2.5 mm
  EXPECT_NEAR(bench.var_now(100), x, 1e-6);
  EXPECT_NEAR(run.places.back().v[0], x, 1e-9);  // the block to X100 is lost
  EXPECT_EQ(run.places.back().v[1], 5);
}

TEST(OnlineInterrupt, WithoutMovesTheRestOfTheBlockIsGone) {
  Bench bench(NC_DIALECT_M700, kSlowMachine);
  bench.add("O1000", "#100=#100+1\n#1100=1\nM99\n");
  const Interrupted run = run_interrupted(bench, "#100=0\nM96 P1000\nG2 X40. I20. F3000\nG1 X60.\nM30", [](const nc_outputs& out) { return out.command.v[0] > 5 && out.command.v[0] < 30; });
  ASSERT_TRUE(run.ended);
  EXPECT_EQ(bench.var_now(100), 1);
  EXPECT_EQ(run.places.back().v[0], 60);
  double stood_at = 0;
  for (size_t i = 1; i < run.places.size(); ++i) {
    const double x = run.places[i].v[0], y = run.places[i].v[1];
    if (x > 0.001 && x < 40) {  // on the circle all the way
      EXPECT_NEAR(std::hypot(x - 20, y), 20, 1e-6);
    }
    if (x > 1 && x < 39 && x == run.places[i - 1].v[0]) stood_at = x;
  }
  EXPECT_GT(stood_at, 5);
}

/// A skip move is cut like any other, and still measures when it goes on.
TEST(OnlineInterrupt, ASkipMoveGoesOnWhereItWasCut) {
  for (const bool touches : {true, false}) {
    Bench bench(NC_DIALECT_M700, kSlowMachine);
    bench.add("O1000", "#100=#100+1\nM99\n");
    bench.start("#100=0\nM96 P1000\nG31 X100. F3000\n#101=#5061\nG1 X0 F3000\nM30");
    nc_inputs in{};
    nc_outputs out{};
    in.feed_override = in.rapid_override = 1;
    double rested_at = 0, before = -1;
    bool ended = false;
    for (unsigned n = 0; n < 50000 && !ended; ++n) {
      nc_feed(bench.control(), 50);
      in.cycle_start = n == 2;
      in.fin = out.strobe != 0;
      in.macro_interrupt = out.command.v[0] > 20 && out.source.line == 3;
      in.skip = touches && out.command.v[0] > 50 ? 1 : 0;
      nc_cycle(bench.control(), &in, &out);
      if (out.command.v[0] == before && before > 20 && before < 40) rested_at = before;
      before = out.command.v[0];
      nc_event event;
      while (nc_event_poll(bench.control(), 0, &event, nullptr) == NC_OK) ended = ended || event.kind == NC_ITEM_END;
    }
    ASSERT_TRUE(ended);
    EXPECT_EQ(bench.var_now(100), 1);
    EXPECT_GT(rested_at, 20);
    EXPECT_NEAR(bench.var_now(101), touches ? 50 : 100, touches ? 1 : 1e-6);
  }
}

TEST(OnlineInterrupt, ADwellGoesOnWhereItWasCut) {
  Bench bench(NC_DIALECT_M700, kSlowMachine);
  bench.add("O1000", "#100=#100+1\nM99\n");
  const std::string text = "#100=0\nM96 P1000\nG1 X1. F3000\nG4 X2.\nX2.\nM30";
  unsigned cycles = 0;
  const Interrupted run = run_interrupted(bench, text, [&](const nc_outputs& out) { return out.cause == NC_CAUSE_DWELL && ++cycles == 250; });
  ASSERT_TRUE(run.ended);
  EXPECT_EQ(bench.var_now(100), 1);
  EXPECT_NEAR(static_cast<double>(cycles), 500, 5);  // 2 s, not 3
}

// "If UIT comes while an MSTB is waiting for FIN, the interrupt's moves wait for FIN."
TEST(OnlineInterrupt, FinComesFirst) {
  Bench bench(NC_DIALECT_M700, kSlowMachine);
  bench.add("O1000", "G0 Z7.\nM99\n");
  bool waited = false, moved_before_fin = false;
  const Interrupted run = run_interrupted(
      bench, "M96 P1000\nG1 X1. F3000\nM8 X5.\nX9.\nM30",
      [&](const nc_outputs& out) {
        waited = waited || (out.strobe != 0 && out.m == 8);
        moved_before_fin = moved_before_fin || (out.strobe != 0 && out.m == 8 && out.command.v[2] > 0);
        return out.strobe != 0 && out.m == 8;
      },
      100);
  ASSERT_TRUE(run.ended);
  EXPECT_TRUE(waited);
  EXPECT_FALSE(moved_before_fin);
  EXPECT_EQ(x_when_z_moves(run), 1);  // before the move of the M8 block, which is lost
  EXPECT_EQ(run.places.back().v[0], 9);
}

TEST(OnlineInterrupt, TypeTwoEndsTheBlockFirst) {  // #1113
  Bench bench(NC_DIALECT_M700, kSlowMachine);
  bench.add("O1000", "G0 Z7.\nM99\n");
  bench.param("1113", "1");
  const Interrupted run = run_interrupted(bench, "M96 P1000\nG1 X100. F3000\nY5.\nM30", [](const nc_outputs& out) { return out.command.v[0] > 20; });
  ASSERT_TRUE(run.ended);
  EXPECT_EQ(x_when_z_moves(run), 100);
}

// #1112 = 1: a signal that stays on lets a block of the program through between two runs of the interrupt program.
TEST(OnlineInterrupt, ASignalThatStaysOnLetsTheProgramEnd) {
  for (const char* type_2 : {"0", "1"})
    for (const char* moves : {"", "G91 Z0.1\n"}) {
      Bench bench(NC_DIALECT_M700, kSlowMachine);
      bench.add("O1000", std::string("#100=#100+1\n") + moves + "M99\n");
      bench.param("1112", "1").param("1113", type_2);
      const Interrupted run = run_interrupted(bench, "#100=0\nG0\nM96 P1000\nG90 X1.\nG90 X2.\nG90 X3.\nM97\nG90 X4.\nM30",
                                              [](const nc_outputs&) { return true; });
      ASSERT_TRUE(run.ended) << type_2 << moves;
      EXPECT_EQ(run.places.back().v[0], 4) << type_2 << moves;
      EXPECT_GE(bench.var_now(100), 2) << type_2 << moves;  // type 2 accepts the signal in the next block, and comes at its end
      EXPECT_LE(bench.var_now(100), 6) << type_2 << moves;
    }
}

TEST(OnlineInterrupt, TheSameBlockAgainAndAgain) {
  Bench bench(NC_DIALECT_M700, kSlowMachine);
  bench.add("O1000", "#100=#100+1\nM99\n");
  bench.param("8013", "0.5");
  const std::string text = "#100=0\nM96 P1000\nG0 Z10.\nM3 S100\nG98 G83 X20. Z-5. R2. Q2. F1000\nX30. L2\nG80\nM30";
  Bench plain(NC_DIALECT_M700, kSlowMachine);
  plain.add("O1000", "M99\n");
  plain.param("8013", "0.5");
  const Outcome expected = plain.run(text);
  unsigned n = 0;
  const Interrupted run = run_interrupted(bench, text, [&](const nc_outputs&) { return ++n % 7 == 0; });
  ASSERT_TRUE(run.ended);
  EXPECT_GT(bench.var_now(100), 50);
  std::vector<nc_axes> ends;
  for (const nc_event& event : run.events)
    if (event.kind == NC_ITEM_MOVE) ends.push_back(event.machine);
  const std::vector<nc_move> moves = expected.moves();
  ASSERT_EQ(ends.size(), moves.size());
  for (size_t i = 0; i < ends.size(); ++i)
    for (unsigned axis = 0; axis < 3; ++axis) EXPECT_NEAR(ends[i].v[axis], moves[i].machine.v[axis], 1e-9) << i;
}

Outcome trace_with(Bench& bench, const std::string& text, const std::vector<Seen>& interrupts) {
  bench.start(text);
  Outcome run;
  size_t next = 0;
  Step step;
  while (run.steps.size() < 20000) {
    run.status = bench.pull(&step);
    if (run.status == NC_BUDGET) continue;
    if (run.status != NC_OK) break;
    bool take_back = false, ignored = false;
    if (next < interrupts.size() && step.item.serial == interrupts[next].behind + (interrupts[next].inside ? 1 : 0)) {
      ++next;
      nc_interrupt_signal(bench.control(), 0, true, &take_back);
      nc_interrupt_signal(bench.control(), 0, false, &ignored);
    }
    if (take_back) continue;
    if (step.item.kind == NC_ITEM_END) run.ended_ok = step.item.u.end.ok;
    run.steps.push_back(step);
  }
  nc_alarm alarm{};
  if (nc_alarm_get(bench.control(), 0, &alarm) == NC_OK) run.alarm = alarm.code, run.alarm_line = alarm.source.line;
  EXPECT_EQ(next, interrupts.size());
  return run;
}

/// M700 13.12, type 1 with moves: wherever the signal comes on the machine, the trace with the same signals executes the same items, to
/// the same end points and variables.
TEST(Online, InterruptsWithMovesExecuteAsTheyTrace) {
  unsigned served = 0, cut = 0, compared = 0;
  for (uint32_t seed = 0; seed < kPrograms; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RandomProgram program = ProgramMaker(seed + 1300, false).make();
    const std::string text = "M96 P1000\n" + program.main;
    const auto prepare = [&](Bench& bench) {
      set_up(bench, program);
      bench.add("O1000", "#199=#199+1\nG90 G49 G80 G40 G0 X[#199+0.37] Y5.3 Z30.\nM7\nM99\n");
      bench.param("1229/bit0", "1");
    };
    Bench online(NC_DIALECT_M700, machine(seed % 2 == 0 ? 64 : 256));
    prepare(online);
    std::mt19937 random(seed);
    const Interrupted run = run_interrupted(online, text, [&](const nc_outputs& out) { return random() % 60 == 0 && out.state == NC_STATE_RUNNING; });
    const std::vector<Seen> interrupts = interrupts_of(run.events);
    Bench offline(NC_DIALECT_M700, machine(256));
    prepare(offline);
    const Outcome expected = trace_with(offline, text, interrupts);
    nc_alarm alarm{};
    nc_alarm_get(online.control(), 0, &alarm);
    ASSERT_EQ(alarm.code, expected.alarm);
    ASSERT_TRUE(run.ended);
    ASSERT_EQ(run.events.size(), expected.steps.size());
    for (size_t i = 0; i < run.events.size(); ++i) {
      const Step& step = expected.steps[i];
      const nc_event& event = run.events[i];
      ASSERT_EQ(event.serial, step.item.serial);
      ASSERT_EQ(event.kind, step.item.kind) << event.serial;
      ASSERT_EQ(event.source.line, step.item.source.line) << event.serial;
      if (event.kind != NC_ITEM_MOVE) continue;  // at other items the machine may stand where a move was cut
      for (unsigned axis = 0; axis < 3; ++axis) ASSERT_NEAR(event.machine.v[axis], step.machine.v[axis], 1e-9) << event.serial;
    }
    for (uint32_t n = 100; n < 200; ++n) ASSERT_EQ(brief(online.var_now(n)), brief(offline.var_now(n))) << n;
    served += static_cast<unsigned>(interrupts.size());
    for (const Seen& seen : interrupts) cut += seen.inside;
    compared += static_cast<unsigned>(run.events.size());
  }
  EXPECT_GT(served, 2 * kPrograms);
  EXPECT_GT(cut, kPrograms);
  EXPECT_GT(compared, 40 * kPrograms);
}

/// Removes G92 and G52, whose shifts survive a reset and can be read only by a program.
void without_shifts(std::string& text) {
  for (const char* code : {"G92 ", "G52 "})
    for (size_t at; (at = text.find(code)) != std::string::npos;) text.erase(at, text.find('\n', at) - at);
}

/// A reset at a random point, in the middle of moves, dwells, macros and interrupts: the program then runs from its head as on a new control that
/// was given what the reset has left.
TEST(Online, ResetsAtRandomPoints) {
  unsigned inside = 0;
  for (uint32_t seed = 0; seed < kPrograms; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomProgram program = ProgramMaker(seed + 1700, false).make();
    without_shifts(program.main);
    for (std::string& sub : program.subs) without_shifts(sub);
    Bench online(NC_DIALECT_M700, machine(seed % 2 == 0 ? 64 : 256));
    set_up(online, program);
    Drive drive(online, program.main);
    const nc_outputs& out = drive.out;
    std::mt19937 random(seed);
    const unsigned reset_at = 20 + random() % 1500;
    std::optional<Bench> offline;
    Outcome expected;
    unsigned again = 0;
    size_t first = 0;
    for (unsigned n = 0; n < 400000 && (again == 0 || !drive.ended); ++n) {
      drive.in.reset = n == reset_at;
      drive.in.cycle_start = (n < reset_at && (n == 2 || n % 7 == 0)) || (again != 0 && (n == again + 2 || n % 7 == 0));
      drive.step(1 + random() % 40);
      if (n == reset_at) inside += out.source.line > 3 && out.state == NC_STATE_RUNNING;
      if (n > reset_at + 5 && again == 0 && out.state == NC_STATE_IDLE && out.distance_zero) {
        again = n;
        first = drive.events.size();
        drive.ended = false;
        offline.emplace(NC_DIALECT_M700, machine(256));
        set_up(*offline, program);
        for (unsigned k = 1; k <= 9; ++k) offline->tool(k, online.tool_now(k));
        for (unsigned k = 0; k <= 6; ++k)
          offline->work_offset(k, {online.work_offset_now(k, 0), online.work_offset_now(k, 1), online.work_offset_now(k, 2)});
        offline->at(out.command.v[0], out.command.v[1], out.command.v[2]);
        for (uint32_t v = 100; v < 1000; ++v)
          if (!std::isnan(online.var_now(v))) offline->var(v, online.var_now(v));
        expected = offline->run(program.main);
      }
    }
    const std::vector<nc_event> events(drive.events.begin() + static_cast<std::ptrdiff_t>(first), drive.events.end());
    ASSERT_TRUE(drive.ended);
    if (!expected.ended_ok) continue;
    ASSERT_EQ(events.size(), expected.steps.size());
    for (size_t i = 0; i < events.size(); ++i) {
      ASSERT_EQ(events[i].serial, expected.steps[i].item.serial);
      for (unsigned axis = 0; axis < 3; ++axis)
        ASSERT_NEAR(events[i].machine.v[axis], expected.steps[i].machine.v[axis], 1e-9) << events[i].serial << " line " << events[i].source.line;
    }
  }
  EXPECT_GT(inside, kPrograms / 4);
}

using Place = std::array<double, 3>;

/// Runs a program with pulses of the recalculation signal in motion, or without; returns where the program's blocks have ended.
std::vector<Place> ends_with_recalculation(const std::string& text, bool optimal, uint32_t seed, bool recalculate, Place* last) {
  Bench bench(NC_DIALECT_M700, [optimal](nc_config& c) {
    machine(64)(c);
    if (!optimal) return;
    c.motion_mode = NC_MOTION_OPTIMAL;
    c.path_tolerance = 0.01;
    for (unsigned i = 0; i < 3; ++i) c.system[0].axis[i].max_jerk = 1e6;
  });
  Drive drive(bench, text);
  std::mt19937 random(seed);
  for (unsigned n = 0; n < 100000 && !drive.ended; ++n) {
    nc_feed(bench.control(), 200);
    drive.in.cycle_start = n == 2;
    drive.in.recalculate = recalculate && random() % 4 == 0;
    drive.step(0);
  }
  nc_alarm alarm = NC_INIT(nc_alarm);
  EXPECT_NE(nc_alarm_get(bench.control(), 0, &alarm), NC_OK) << alarm.code << " " << alarm.message << ", line " << alarm.source.line;
  EXPECT_TRUE(drive.ended);
  std::vector<Place> ends;
  for (const nc_event& event : drive.events) {
    if (event.kind != NC_ITEM_MARK) continue;
    ends.emplace_back();
    for (unsigned axis = 0; axis < 3; ++axis) ends.back()[axis] = event.machine.v[axis];
  }
  for (unsigned axis = 0; axis < 3; ++axis) (*last)[axis] = drive.out.command.v[axis];
  return ends;
}

/// A recalculation alone moves nothing by hand: angles, ways of curves and places of the program stay, also where a smoothed corner has led the axes
/// beside the end of a block.
TEST(Online, ARecalculationInMotionMovesNoPlace) {
  std::string stairs = "G90 G54 G94 F3000\nG1 X0 Y0\nG91\n";
  for (unsigned i = 0; i < 60; ++i) stairs += i % 2 == 0 ? "X1.\n" : "Y1.\n";
  const std::string programs[] = {
      "G90 G54 F1000\nG0 X0 Y0\nG16\nG1 X10. Y30.\nG91\nG1 X10. Y30.\nG1 X10. Y30.\nG15\nG90 G1 X0\nM30",
      stairs + "G90\nM30",
      "G90 G54 F3000\nG0 X0 Y0\nG1 X50.\nY20.\nX60.\nG91 X5.\nX5. Y5.\nG2 X10. I5.\nG1 X-5.\nG90 Y0\nM30",
  };
  for (const bool optimal : {false, true}) {
    for (const std::string& text : programs) {
      Place expected_last, last;
      const std::vector<Place> expected = ends_with_recalculation(text, optimal, 0, false, &expected_last);
      for (uint32_t seed = 1; seed <= 5; ++seed) {
        SCOPED_TRACE(text.substr(0, 60) + (optimal ? " optimal " : " trapezoid ") + std::to_string(seed));
        const std::vector<Place> ends = ends_with_recalculation(text, optimal, seed, true, &last);
        ASSERT_EQ(ends.size(), expected.size());
        for (size_t i = 0; i < ends.size(); ++i)
          for (unsigned axis = 0; axis < 3; ++axis) ASSERT_NEAR(ends[i][axis], expected[i][axis], optimal ? 0.0101 : 1e-9) << i;
        for (unsigned axis = 0; axis < 3; ++axis) EXPECT_NEAR(last[axis], expected_last[axis], 1e-9);
      }
    }
  }
}

TEST(Online, ChangedDataActAfterARecalculation) {  // M700 4.2: from the next block
  Bench bench(NC_DIALECT_M700, machine(64));
  bench.var(100, 3);
  Drive drive(bench, "G0 X1.\nX2.\nX#100\nM30");
  const nc_outputs& out = drive.out;
  drive.in.single_block = true;
  bool changed = false;
  for (unsigned n = 0; n < 5000; ++n) {
    nc_feed(bench.control(), 50);
    const bool stopped_behind_first = out.state == NC_STATE_STOPPED && out.blocks == 1;
    if (stopped_behind_first && !changed) {
      bench.var(100, 7);
      changed = nc_recalculate(bench.control(), 0) == NC_OK;
      drive.in.cycle_start = false;
    } else {
      drive.in.cycle_start = n % 5 == 0 && (!stopped_behind_first || changed);
    }
    drive.step(0);
    if (out.state == NC_STATE_IDLE && out.blocks > 0) break;  // another cycle start would run it again
  }
  EXPECT_TRUE(changed);
  EXPECT_NEAR(out.command.v[0], 7, 1e-9);
  EXPECT_EQ(out.state, NC_STATE_IDLE);
}

/// Runs the program until a reset in cycle `cycles`; returns the serial of the last block end that was executed, 0 if there is none.
uint64_t reset_after(Bench& bench, const std::string& text, unsigned cycles) {
  Drive drive(bench, text);
  while (drive.cycle < cycles + 500 && !(drive.in.reset && drive.out.state == NC_STATE_IDLE)) {
    drive.press_start();
    drive.in.reset = drive.cycle >= cycles;
    drive.step();
  }
  EXPECT_EQ(drive.out.state, NC_STATE_IDLE);
  nc_feed(bench.control(), 100);
  uint64_t last = 0;
  for (const nc_event& event : drive.events)
    if (event.kind == NC_ITEM_MARK) last = event.serial;
  return last;
}

/// Blocks that were only read ahead when the program was given up have no effect: offsets, variables and outputs are those of the executed
/// blocks.
TEST(Online, AResetLeavesWhatTheExecutedBlocksHaveDone) {
  unsigned inside = 0;
  for (uint32_t seed = 0; seed < 3 * kPrograms; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RandomProgram program = ProgramMaker(seed + 1300, false).make();
    Bench online(NC_DIALECT_M700, machine(128));
    set_up(online, program);
    const uint64_t last = reset_after(online, program.main, 3 + seed * seed % 397);
    Bench offline(NC_DIALECT_M700, machine(128));
    set_up(offline, program);
    offline.start(program.main);
    Step step;
    step.item.serial = 0;
    while (step.item.serial < last && offline.pull(&step) >= NC_OK) {
    }
    inside += last > 0 && step.item.serial == last;
    nc_reset(offline.control(), 0);
    ASSERT_EQ(tables(online), tables(offline)) << "behind item " << last;
  }
  EXPECT_GT(inside, kPrograms);
}

TEST(Online, AResetTakesBackWhatWasOnlyReadAhead) {
  for (const char* ahead : {"G92 Y5.", "G52 Y3.", "G10 L2 P1 Y3.", "#5222=3", "#500=7", "#1100=1", "#1132=5", "G10 L10 P1 R50."}) {
    SCOPED_TRACE(ahead);
    Bench bench(NC_DIALECT_M700, machine(64));
    bench.tool(1, 10);
    reset_after(bench, std::string("G1 X100. F1000\n") + ahead + "\nM30", 50);
    const std::string mdi = "G90 G0 Y0\n#510=#500\n#511=#1132\n#512=#10001\nM30";
    reset_after(bench, mdi, 2000);
    EXPECT_NEAR(bench.var_now(511), 0, 1e-9);
    EXPECT_NEAR(bench.var_now(512), 10, 1e-9);
    EXPECT_TRUE(std::isnan(bench.var_now(510)));
    nc_inputs in{};
    nc_outputs out{};
    nc_cycle(bench.control(), &in, &out);
    EXPECT_NEAR(out.command.v[1], 0, 1e-9);
  }
}

/// M700 9.1: reading ahead is suspended at M00 and M01, so what the operator changes in the stop counts for the next block.
TEST(Online, NothingIsReadAheadOfAProgramStop) {
  for (const char* stop : {"M0", "M1"}) {
    Bench bench(NC_DIALECT_M700, machine(64));
    bench.tool(1, 10);
    Drive drive(bench, std::string("G0 G43 Z0 H1\n") + stop + "\nG43 Z0 H1\nM30");
    const nc_outputs& out = drive.out;
    drive.in.optional_stop = true;
    unsigned stopped = 0;
    while (drive.cycle < 3000) {
      nc_feed(bench.control(), 100);
      stopped += out.state == NC_STATE_STOPPED;
      if (stopped == 20) bench.tool(1, 25);
      drive.in.cycle_start = drive.cycle == 2 || stopped == 40;
      drive.step(0);
    }
    EXPECT_GE(stopped, 40u);
    EXPECT_EQ(out.state, NC_STATE_IDLE);
    EXPECT_NEAR(out.command.v[2], 25, 1e-9) << stop;
  }
}

TEST(Online, SingleBlockNeedsNoStartBehindTheEndOfTheProgram) {
  Bench bench(NC_DIALECT_M700, machine(64));
  Drive drive(bench, "G0 X1.\nX2.\nM30");
  nc_inputs& in = drive.in;
  in.single_block = true;
  unsigned starts = 0;
  bool idle = false;
  for (unsigned n = 0; n < 5000 && !idle; ++n) {
    const bool waits = drive.out.state == NC_STATE_STOPPED || starts == 0;
    if (waits && !in.cycle_start) ++starts;
    in.cycle_start = waits && !in.cycle_start;
    drive.step(50);
    idle = starts > 0 && n > 10 && drive.out.state == NC_STATE_IDLE;
  }
  EXPECT_TRUE(idle);
  EXPECT_EQ(starts, 3u);  // one for each block
}

TEST(Online, AnAlarmStopsTheMachineWhereTheBlockBeforeEnded) {
  Bench bench(NC_DIALECT_M700, machine(64));
  Drive drive(bench, "G0 X10.\nG1 X20. F6000\nG67\nX30.\nM30");
  while (drive.cycle < 3000) {
    drive.press_start();
    drive.step(50);
  }
  EXPECT_EQ(drive.out.state, NC_STATE_ALARM);
  EXPECT_NEAR(drive.out.command.v[0], 20, 1e-9);
  nc_alarm alarm{};
  ASSERT_EQ(nc_alarm_get(bench.control(), 0, &alarm), NC_OK);
  EXPECT_STREQ(alarm.code, "P276");
  EXPECT_EQ(alarm.source.line, 3u);
}

/// M700 13.6: the signals count at the start of a program, and the axes are mirrored about the places at which they stand then.
TEST(Online, MirrorImageBySignal) {
  Bench bench(NC_DIALECT_M700, machine(64));
  Drive drive(bench, "G0 X10. Y5.\n#100=#3007\nG91 X2.\nM30");
  const auto run = [&] {
    drive.ended = false;
    drive.cycle = 0;
    while (drive.cycle < 3000 && !drive.ended) {
      drive.press_start();
      if (drive.cycle > 3) drive.in.mirror = 2;  // too late for this program
      drive.step();
    }
    EXPECT_TRUE(drive.ended);
  };
  drive.in.mirror = 1;
  run();
  EXPECT_NEAR(drive.out.command.v[0], -12, 1e-9);
  EXPECT_NEAR(drive.out.command.v[1], 5, 1e-9);
  EXPECT_EQ(bench.var_now(100), 1);
  run();  // Y about 5
  EXPECT_NEAR(drive.out.command.v[0], 12, 1e-9);
  EXPECT_NEAR(drive.out.command.v[1], 5, 1e-9);
  EXPECT_EQ(bench.var_now(100), 2);
  drive.in.mirror = 0;
  for (int n = 0; n < 5; ++n) drive.step();  // the feeder sees the end
  bench.start("G91 G0 X-2. Y1.\nM30");
  drive.cycle = 0;
  drive.ended = false;
  while (drive.cycle < 3000 && !drive.ended) {
    drive.press_start();
    drive.step();
  }
  EXPECT_NEAR(drive.out.command.v[0], 10, 1e-9);
  EXPECT_NEAR(drive.out.command.v[1], 6, 1e-9);
}

/// The workpiece position while nothing runs: after power on, when an offset is changed, and after a program.
TEST(Online, WorkPositionsKnowTheOffsetsWhileNoProgramRuns) {
  Bench bench(NC_DIALECT_M700, machine(64));
  bench.work_offset(1, {1, 2, 3}).work_offset(2, {10, 20, 30});
  const nc_axes stand{{5, 5, 5}};
  ASSERT_EQ(nc_position_set(bench.control(), 0, &stand), NC_OK);
  Drive drive(bench, "G55 G0 X1. Y1. Z1.\nM30");
  const auto expect_work = [&](double x, double y, double z) {
    const double expected[] = {x, y, z};
    for (unsigned i = 0; i < 3; ++i) EXPECT_NEAR(drive.out.work.v[i], expected[i], 1e-9) << "axis " << i << " in cycle " << drive.cycle;
  };
  drive.step();
  EXPECT_EQ(drive.out.state, NC_STATE_IDLE);
  expect_work(4, 3, 2);  // G54 at power on
  bench.work_offset(1, {2, 2, 3});
  drive.step();
  expect_work(3, 3, 2);  // the host has changed G54 between programs
  drive.cycle = 0;
  while (drive.cycle < 3000 && !drive.ended) {
    drive.press_start();
    drive.step();
  }
  ASSERT_TRUE(drive.ended);
  EXPECT_NEAR(drive.out.command.v[0], 11, 1e-9);
  expect_work(1, 1, 1);  // as the last block has left it
  drive.in.reset = true;
  for (int n = 0; n < 10; ++n) drive.step();
  drive.in.reset = false;
  drive.step();
  double zero = 0;
  ASSERT_EQ(nc_work_offset_get(bench.control(), 0, 1, 0, &zero), NC_OK);
  EXPECT_NEAR(drive.out.work.v[0], 11 - zero, 1e-9);  // the reset chooses G54 again
}

/// The two ways exclude each other: an item that the one takes would be missing in the other.
TEST(Online, TheStreamOfARunningProgramCannotBePulled) {
  Bench bench(NC_DIALECT_M700, machine(64));
  std::string text = "G91 F60000\n";
  for (int i = 0; i < 300; ++i) text += "G1 X1.\n";
  Drive drive(bench, text + "M30");
  const nc_world world{};
  nc_item item;
  bool take_back = false;
  while (drive.cycle < 3000 && !drive.ended) {
    drive.press_start();
    drive.step(10);
    if (drive.out.state != NC_STATE_RUNNING || drive.cycle % 8 != 0) continue;
    EXPECT_EQ(nc_pull(bench.control(), 0, 100, &item), NC_E_STATE);
    EXPECT_EQ(nc_answer(bench.control(), 0, &world), NC_E_STATE);
    EXPECT_EQ(nc_interrupt_signal(bench.control(), 0, true, &take_back), NC_E_STATE);
  }
  EXPECT_TRUE(drive.ended);
  EXPECT_NEAR(drive.out.command.v[0], 300, 1e-9);
}

}  // namespace
}  // namespace nc::test
