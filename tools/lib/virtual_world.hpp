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
#include "tools/lib/path_clock.hpp"
#include "tools/lib/setup.hpp"

namespace nc::tools {

/// Time of the simulated clock in whole milliseconds. The small addition keeps rounding from turning a whole number into the one below.
inline int64_t whole_ms(double seconds) { return static_cast<int64_t>(std::floor(seconds * 1000.0 + 1e-6)); }

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

  /** True while an event waits for its time, which may come in the middle of an item. */
  bool waits_for_time() const { return !time_events_.empty(); }
  unsigned axis_count() const { return axis_count_; }

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
   * Begins a move, which go_on() executes. A skip move is cut where it first enters a solid whose signal ends it; then *move is changed to what will really
   * be executed. @return false when there is no motion at all, because the signal is on at the start.
   */
  bool begin(nc_move* move) {
    if (move->kind == NC_MOVE_SKIP) [[unlikely]] return begin_skip(move);
    begin_item(seconds_ + clock_.seconds(*move));
    return true;
  }
  /** Begins a dwell in seconds or spindle turns, which one of the skip signals ends. @return how many of them it will last // M700 15.3 (2) */
  double begin_dwell(bool turns, double value, uint32_t skip_mask = 0);
  /**
   * Lets time pass until the item that has begun ends, or until an event of the clock fires before that: then it is to be called again, unless the
   * event ends the item there. @return true at the end of the item.
   */
  bool go_on() {
    if (!time_events_.empty()) [[unlikely]] return go_on_to_event();
    seconds_ = item_end_;
    return true;
  }
  /** The share of the length of the move that has begun (begin()) that is done. */
  double share(const nc_move& move) const { return clock_.share_after(move, seconds_ - item_begin_); }
  /** Seconds or turns of the dwell that has begun that have passed. */
  double dwelt(bool turns) const { return turns ? (seconds_ - item_begin_) * rev_min() / 60.0 : seconds_ - item_begin_; }
  /** The axes have come to the end of this move. */
  void arrive(const nc_move& move) {
    machine_ = move.machine;
    work_ = move.work;
  }
  /** The move that has begun is not executed to its end: a hit that ends it is there for the rest of it. */
  void cut_short() {
    put_back(skip_hit_);
    skipped_ = false;
  }

  /** Executes a move, whatever happens meanwhile. @return as begin() */
  bool execute(nc_move* move) {
    const bool moves = begin(move);
    while (!go_on()) continue;
    arrive(*move);
    return moves;
  }

  /** Nothing but the program itself changes anything: no event is waited for, so moves need not be seen one by one. */
  bool waits_for_nothing() const { return !schedule_.any() && time_events_.empty() && !reset_; }
  /** What nc_pull_past() has to know; afterwards what it has passed over has been executed. */
  void prepare(nc_passed* passed) const {
    passed->rapid_mm_min = kRapidMmMin;
    passed->spindle_rev_min = rev_min();
    passed->seconds = seconds_;
  }
  void execute(const nc_passed& passed) {
    machine_ = passed.machine;
    work_ = passed.work;
    seconds_ = passed.seconds;
  }

  /** Executes a dwell, whatever happens meanwhile. @return as begin_dwell() */
  double dwell(bool turns, double value, uint32_t skip_mask = 0) {
    const double lasts = begin_dwell(turns, value, skip_mask);
    while (!go_on()) continue;
    return lasts;
  }
  /** What the program commands of the spindle, and with that how long its moves take. */
  PathClock& clock() { return clock_; }
  const PathClock& clock() const { return clock_; }
  void control(const nc_action& action) { clock_.control(action, work_); }
  /** Of the spindle, r/min. */
  double rev_min() const { return clock_.rev_min(work_); }
  /** The spindle may turn without an S of the program: a machine on which it is to run has been used before. */
  void spindle_may_turn() { spindle_may_turn_ = true; }
  bool spindle_stands() const { return !spindle_may_turn_ && !(rev_min() > 0.0); }

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
  bool begin_skip(nc_move* move);
  void begin_item(double end) {
    item_begin_ = seconds_;
    item_end_ = end;
    skip_hit_ = {};
  }
  bool go_on_to_event();
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
  double item_begin_ = 0.0, item_end_ = 0.0;  // of the item that has begun
  Touch skip_hit_;                            // the hit that belongs to it
  PathClock clock_;
  bool reset_ = false, spindle_may_turn_ = false;
  bool interrupt_ = false;
  EventSchedule schedule_;
  std::vector<const SetupEvent*> time_events_;  // events with a time that have not been fired yet
};

}  // namespace nc::tools
