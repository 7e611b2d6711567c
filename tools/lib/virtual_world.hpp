// SPDX-License-Identifier: Apache-2.0
// The machine of an offline run. Its position is the end of the last move, its clock goes on by the time that each item
// takes, and its inputs and solids are those of the setup. Nothing depends on the time of day.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nc/nc.h"
#include "tools/lib/event_schedule.hpp"
#include "tools/lib/setup.hpp"

namespace nc::tools {

/// Time of the simulated clock in whole milliseconds. The small addition keeps rounding from turning a whole number into the one below.
inline int64_t whole_ms(double seconds) { return static_cast<int64_t>(std::floor(seconds * 1000.0 + 1e-6)); }

inline constexpr double kRapidMmMin = 10'000.0;  // the clock of the trace assumes rapids of 10 m/min

/** Inputs from outside: those of the macro interface, and skip signals that events have switched on (bit n = signal n+1). */
struct OutsideSignals {
  uint32_t input[NC_WORDS] = {};
  uint32_t skip = 0;
  /** Applies the changes of an event. */
  void change(const SetupEvent& event);
};

/** Follows the items of one part system and answers its syncs. */
class VirtualWorld {
 public:
  /** Both must outlive the world. */
  VirtualWorld(const Setup& setup, const nc_system_config& system);

  /**
   * To be called with every item before anything else is done with it: fires the events that are due, first those of the clock. For an executor that
   * executes items one by one; an executor that reads ahead uses a Foresight.
   * @param main_line line of the main program to which the item belongs, 0 = not known; not used for an item of the main program itself
   * @return true when an event commands reset: the run ends here, and the item is not executed.
   */
  bool on_item(const nc_item& item, uint32_t main_line) {
    now_ = item.source;
    return schedule_.any() || !time_events_.empty() ? fire_due(item, main_line) : reset_;
  }

  /** True while an event waits for a block or an M code, so that the caller need not look for `main_line` otherwise. */
  bool waits_for_block() const { return schedule_.any(); }

  /** True when events or hits are left, so that what comes may differ from what was before. */
  bool changes() const;

  /** The schedule of the events, for an executor that fires them itself. */
  EventSchedule& schedule() { return schedule_; }
  void fire(const SetupEvent& event);
  /** Fires the events whose time has come. */
  void fire_by_time();
  /** An event has commanded reset. */
  bool reset() const { return reset_; }

  /**
   * Executes a move: changes position and clock. A skip move is cut where it first enters a solid whose signal ends
   * it; then *move is changed to what was really executed. @return false when there was no motion at all, because the
   * signal was on at the start.
   */
  bool execute(nc_move* move) {
    if (move->kind == NC_MOVE_SKIP) [[unlikely]] return execute_skip(move);
    machine_ = move->machine;
    work_ = move->work;
    seconds_ += duration(*move);
    return true;
  }

  /** Nothing but the program itself changes anything: no event is waited for, so moves need not be seen one by one. */
  bool waits_for_nothing() const { return !schedule_.any() && time_events_.empty() && !reset_; }
  /** What nc_pull_past() has to know; afterwards what it has passed over has been executed. */
  void prepare(nc_passed* passed) const {
    passed->rapid_mm_min = kRapidMmMin;
    passed->spindle_rev_min = spindle_rev_min_;
    passed->seconds = seconds_;
  }
  void execute(const nc_passed& passed) {
    machine_ = passed.machine;
    work_ = passed.work;
    seconds_ = passed.seconds;
  }

  /** Executes a dwell in seconds or spindle turns, which one of the skip signals ends. @return how many of them it has lasted // M700 15.3 (2) */
  double dwell(bool turns, double value, uint32_t skip_mask = 0);
  void spindle(double rev_per_min) { spindle_rev_min_ = rev_per_min; }

  /** The answer to a sync; reading the clock takes 1 ms. */
  nc_world answer(uint32_t what);

  /** True when the last skip move was ended by its signal. */
  bool skipped() const { return skipped_; }

  /** The parts of the setup that have had no effect so far, as sentences that begin with their place. */
  std::vector<std::string> unused() const;

  /** Level of the macro interrupt signal. */
  bool macro_interrupt() const { return interrupt_; }

  const nc_axes& machine() const { return machine_; }
  double seconds() const { return seconds_; }
  /** Sets the clock, when another executor measures the time. */
  void set_seconds(double seconds) { seconds_ = seconds; }
  uint32_t input(unsigned word) const { return signals_.input[word]; }
  /** The inputs after the events that have fired. */
  const OutsideSignals& signals() const { return signals_; }
  bool optional_stop() const { return setup_.optional_stop; }

  /** Skip signals that are on at a place, which is given in machine and in workpiece coordinates: bit n = signal n+1. */
  uint32_t signals_at(const nc_axes& machine, const nc_axes& work) const { return signals_.skip | solids_at(machine, work); }
  uint32_t signals_at(const nc_axes& machine) const;  // with the workpiece zero of the last move
  /** The skip signals that solids give there, without those of events. */
  uint32_t solids_at(const nc_axes& machine, const nc_axes& work) const;

  /** The hit of the setup that belongs to a skip move. */
  struct Touch {
    size_t hit = SIZE_MAX;  // index of the hit; SIZE_MAX: the setup has none for this move
    double part = INFINITY; // part of the way at which it is touched, 0 to 1; infinity: nothing is touched
    unsigned signal = 1;
  };
  /** Takes the hit that belongs to this skip move. */
  Touch take_hit(const nc_source& source, const nc_move& move);
  /** Puts back a hit whose move was not executed and will come again. */
  void put_back(const Touch& touch);

 private:
  struct HitState {
    const SkipHit* hit;
    bool taken = false, missed = false;  // missed: the move that took it does not pass the place or listens to other signals
    uint32_t line = 0;                   // line of that move
  };
  bool execute_skip(nc_move* move);
  /** Of the whole move, in seconds. It stands here because it is asked for every move. */
  double duration(const nc_move& move) const {
    double feed = move.feed_mm_min;
    if (move.kind == NC_MOVE_RAPID) feed = kRapidMmMin;
    if (move.feed_mm_rev > 0.0 && move.kind != NC_MOVE_TAP) feed = move.feed_mm_rev * spindle_rev_min_;
    return feed > 0.0 ? move.length / feed * 60.0 : 0.0;
  }
  double first_box(const nc_move& move, const SkipSolid& solid, double length) const;
  double first_probe(const nc_move& move, const SkipSolid& solid) const;
  const SetupEvent* signal_within(double seconds, uint32_t mask, bool off = false) const;
  bool fire_due(const nc_item& item, uint32_t main_line);
  double first_entry(const nc_move& move) const;
  bool touches_at(const nc_move& move, const SkipSolid& solid, double part) const;
  double exit_of(const nc_move& move, const SkipSolid& solid, double length) const;
  double first_exit(const nc_move& move) const;

  const Setup& setup_;
  unsigned axis_count_;
  nc_axes machine_;
  nc_axes skip_machine_;
  bool skipped_ = false;
  OutsideSignals signals_;
  nc_axes work_;  // machine_ in the workpiece coordinates of the last move
  nc_source now_ = {};
  std::vector<HitState> hits_;
  double seconds_ = 0.0;
  double spindle_rev_min_ = 0.0;
  bool reset_ = false;
  bool interrupt_ = false;
  EventSchedule schedule_;
  std::vector<const SetupEvent*> time_events_;  // events with a time that have not been fired yet
};

}  // namespace nc::tools
