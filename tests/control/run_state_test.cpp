// SPDX-License-Identifier: Apache-2.0
// The states of a run between scan and feeder (interpolate/run_word.hpp): after any presses and calls in any order, a reset leads to IDLE
// within a bounded number of turns, and from there everything works.
#include <gtest/gtest.h>

#include "online_helpers.hpp"
#include "support/drive.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

/// One thing that an operator, the machine or the host does. Each press is one cycle long.
enum Act : unsigned { kStart, kReset, kFeed, kCycle, kSelect, kMdi, kOffset, kAlarm, kTurns, kHold, kRecalculate, kSteps };

const char* const kNames[] = {"start", "reset", "feed", "cycle", "select", "mdi", "offset", "alarm", "turns", "hold", "recalculate"};

class Rig {
 public:
  explicit Rig(nc_motion_mode mode)
      : bench_(NC_DIALECT_M700, [mode](nc_config& c) {
          machine(64)(c);
          c.motion_mode = static_cast<uint8_t>(mode);
          for (unsigned i = 0; i < 3; ++i) {
            c.system[0].axis[i].max_acceleration = 5000;
            c.system[0].axis[i].max_jerk = 500000;
            c.system[0].axis[i].soft_limited = true;
            c.system[0].axis[i].soft_min = -1000;
            c.system[0].axis[i].soft_max = 1000;
          }
        }) {
    // Long enough to be interrupted anywhere; its end in Y depends on the work offset.
    file_ = bench_.add("O1", "G90 G54 G0 X1.\nG1 X3. Y1. F6000\nM0\nX4.\nM30\n");
    in_.feed_override = in_.rapid_override = 1;
    select();
    cycle();
  }

  void act(unsigned what) {
    switch (what) {
      case kStart: press(&in_.cycle_start); break;
      case kReset: press(&in_.reset); break;
      case kFeed: nc_feed(bench_.control(), 3); break;
      case kCycle: cycle(); break;
      case kSelect: select(); break;
      case kMdi: {  // the second block raises an alarm, since it goes beyond a soft limit
        static constexpr char kText[] = "G91 G0 X1.\nG90 G0 X5000.\n";
        (void)nc_mdi_load(bench_.control(), 0, kText, sizeof kText - 1);
        break;
      }
      case kOffset: nc_work_offset_set(bench_.control(), 0, 1, 1, offset_ = std::fmod(offset_ + 0.01, 5)); break;
      case kAlarm: press(&in_.alarm); break;
      case kTurns:
        for (unsigned n = 0; n < 12; ++n) turn();
        break;
      case kHold: press(&in_.feed_hold); break;
      default: (void)nc_recalculate(bench_.control(), 0); break;
    }
  }

  /// Presses reset, and lets feeder and scan run until the state is IDLE. @return the number of turns
  unsigned reset() {
    press(&in_.reset);
    unsigned n = 0;
    for (; n < kMost && out_.state != NC_STATE_IDLE; ++n) turn();
    return n;
  }
  nc_status select() { return nc_program_select(bench_.control(), 0, file_); }

  /// Runs the program; returns an empty text if it ended where it should, else what went wrong.
  std::string run() {
    if (const nc_status status = select(); status != NC_OK) return "select: " + std::to_string(status);
    drop_events();
    press(&in_.cycle_start);
    unsigned n = 0;
    for (; n < 4000; ++n) {
      turn();
      if (out_.state == NC_STATE_STOPPED) press(&in_.cycle_start);
      if (n > 8 && out_.state == NC_STATE_IDLE) break;
    }
    if (drop_events() != 1) return "it has not run";
    if (out_.state != NC_STATE_IDLE) return "state " + std::to_string(out_.state) + " cause " + std::to_string(out_.cause);
    if (std::fabs(out_.command.v[0] - 4) > 1e-9 || std::fabs(out_.command.v[1] - 1 - offset_) > 1e-9)
      return "ends at " + brief(out_.command.v[0]) + " " + brief(out_.command.v[1]);
    return nc_reset(bench_.control(), 0) == NC_OK ? "" : "nc_reset";
  }

  static constexpr unsigned kMost = 200;  ///< turns from a reset to IDLE: the longest stop, and the records of the ring

 private:
  /// Takes all events. @return how many of them are ends of programs
  unsigned drop_events() {
    unsigned ends = 0;
    nc_event event;
    while (nc_event_poll(bench_.control(), 0, &event, nullptr) == NC_OK) ends += event.kind == NC_ITEM_END ? 1 : 0;
    return ends;
  }
  void cycle() { nc_cycle(bench_.control(), &in_, &out_); }
  void press(bool* button) {
    *button = true;
    cycle();
    *button = false;
  }
  void turn() {
    nc_feed(bench_.control(), 3);
    in_.fin = out_.strobe != 0;
    cycle();
  }

  Bench bench_;
  unsigned file_ = 0;
  nc_inputs in_{};
  nc_outputs out_{};
  double offset_ = 0;
};

std::string names(const std::vector<unsigned>& steps) {
  std::string all;
  for (const unsigned s : steps) all += std::string(all.empty() ? "" : " ") + kNames[s];
  return all;
}

void try_sequence(Rig& rig, const std::vector<unsigned>& steps) {
  for (const unsigned s : steps) rig.act(s);
  ASSERT_LT(rig.reset(), Rig::kMost) << "no IDLE behind a reset behind: " << names(steps);
  const std::string wrong = rig.run();
  ASSERT_EQ(wrong, "") << names(steps);
}

class RunState : public ::testing::TestWithParam<nc_motion_mode> {};

/// Every sequence of up to four steps.
TEST_P(RunState, EverySequence) {
  Rig rig(GetParam());
  for (unsigned length = 1; length <= (sanitized() ? 3u : 4u); ++length) {
    std::vector<unsigned> steps(length, 0);
    for (;;) {
      ASSERT_NO_FATAL_FAILURE(try_sequence(rig, steps));
      unsigned at = 0;
      while (at < length && ++steps[at] == kSteps) steps[at++] = 0;
      if (at == length) break;
    }
  }
}

/// Longer sequences, at random.
TEST_P(RunState, LongSequences) {
  Rig rig(GetParam());
  std::mt19937 random(31);
  for (unsigned n = 0; n < (sanitized() ? 2000u : 20000u); ++n) {
    std::vector<unsigned> steps(5 + random() % 8);
    for (unsigned& s : steps) s = random() % kSteps;
    ASSERT_NO_FATAL_FAILURE(try_sequence(rig, steps)) << n;
  }
}

/// An alarm anywhere in programs of all kinds, while the operator does anything and the feeder is late.
TEST_P(RunState, AlarmsAnywhere) {
  constexpr unsigned kLongest = 3000;  // cycles of 4 ms: a stop from full speed on every axis, and the rings emptied
  for (uint32_t seed = 0; seed < (sanitized() ? 8u : 40u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const RandomProgram program = ProgramMaker(seed + 4000, false).make();
    Bench bench(NC_DIALECT_M700, [](nc_config& c) {
      machine(256)(c);
      c.motion_mode = static_cast<uint8_t>(GetParam());
      for (unsigned i = 0; i < 3; ++i) {
        c.system[0].axis[i].max_velocity = 400;
        c.system[0].axis[i].max_acceleration = 3000;
        c.system[0].axis[i].max_jerk = 100000;
        c.system[0].axis[i].soft_limited = true;
        c.system[0].axis[i].soft_min = -60;  // some programs go beyond these limits
        c.system[0].axis[i].soft_max = 60;
      }
    });
    set_up(bench, program);
    const unsigned file = bench.add("O5000", program.main);
    nc_control* const control = bench.control();
    nc_inputs in{};
    nc_outputs out{};
    in.feed_override = in.rapid_override = 1;
    in.spindle[0].rev_per_s = 20;
    std::mt19937 random(seed);
    for (unsigned attempt = 0; attempt < 12; ++attempt) {
      ASSERT_EQ(nc_program_select(control, 0, file), NC_OK) << attempt;
      const unsigned last = 1 + random() % 600;
      const bool by_alarm = random() % 2 == 0;
      for (unsigned n = 0; n < last; ++n) {
        if (random() % 3 != 0) nc_feed(control, 1 + random() % 30);
        in.cycle_start = n % 16 == 1;
        in.feed_hold = random() % 40 < 2;
        in.single_block = (n / 64) % 4 == 3;
        in.interlock = random() % 60 == 0;
        if (random() % 30 == 0) in.feed_override = static_cast<double>(random() % 5) / 4;
        if (random() % 30 == 0) in.rapid_override = static_cast<double>(random() % 5) / 4;
        in.fin = out.strobe != 0;
        nc_cycle(control, &in, &out);
      }
      in.cycle_start = in.feed_hold = in.single_block = in.interlock = false;
      in.feed_override = in.rapid_override = 1;
      in.alarm = by_alarm;
      nc_cycle(control, &in, &out);
      in.alarm = false;
      for (unsigned n = by_alarm ? random() % 40 : 0; n > 0; --n) nc_cycle(control, &in, &out);
      in.reset = true;
      nc_cycle(control, &in, &out);
      in.reset = false;
      unsigned n = 0;
      for (; n < kLongest && out.state != NC_STATE_IDLE; ++n) {
        nc_feed(control, 10);
        nc_cycle(control, &in, &out);
      }
      ASSERT_EQ(out.state, NC_STATE_IDLE) << "attempt " << attempt << " cause " << unsigned{out.cause} << " line " << out.source.line;
      ASSERT_TRUE(out.distance_zero);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Both, RunState, ::testing::Values(NC_MOTION_TRAPEZOID, NC_MOTION_OPTIMAL),
                         [](const auto& mode) { return mode.param == NC_MOTION_OPTIMAL ? "Optimal" : "Trapezoid"; });

/// Cycle start while the reset button is held starts nothing, neither then nor when the reset button is released.
TEST(ResetHeld, NothingIsStarted) {
  for (const nc_motion_mode mode : {NC_MOTION_TRAPEZOID, NC_MOTION_OPTIMAL}) {
    Bench bench(NC_DIALECT_M700, [mode](nc_config& c) {
      machine(64)(c);
      c.motion_mode = static_cast<uint8_t>(mode);
      for (unsigned i = 0; i < 3; ++i) c.system[0].axis[i].max_acceleration = 5000, c.system[0].axis[i].max_jerk = 500000;
    });
    Drive drive(bench, "G90 G0 X4.\nM30\n");
    const auto steps = [&drive](unsigned n) {
      for (; n > 0; --n) drive.step();
    };
    drive.in.reset = true;
    steps(3);
    drive.in.cycle_start = true;
    steps(3);
    drive.in.cycle_start = false;
    steps(3);
    drive.in.reset = false;
    steps(300);
    EXPECT_EQ(drive.out.state, NC_STATE_IDLE);
    EXPECT_EQ(drive.out.command.v[0], 0);
    EXPECT_TRUE(drive.events.empty());
    drive.in.cycle_start = true;
    steps(2);
    drive.in.cycle_start = false;
    steps(2000);
    EXPECT_TRUE(drive.ended);
    EXPECT_EQ(drive.out.command.v[0], 4);
  }
}

}  // namespace
}  // namespace nc::test
