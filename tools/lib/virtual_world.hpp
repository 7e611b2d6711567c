// SPDX-License-Identifier: Apache-2.0
// The machine behind an offline run: it is where the last move ended, its clock goes by the length of what
// was done, its inputs and solids are those of the setup. Nothing depends on wall-clock time.
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

/** What comes from outside beside positions: inputs of the macro interface, and skip signals that events have switched on (bit n = signal n+1). */
struct OutsideSignals {
  uint32_t input[NC_WORDS] = {};
  uint32_t skip = 0;
  /** As the event leaves them. */
  void change(const SetupEvent& event);
};

/** Follows the items of one part system and answers its syncs. */
class VirtualWorld {
 public:
  /** Both must outlive the world. */
  VirtualWorld(const Setup& setup, const nc_system_config& system);

  /**
   * To be called with every item before anything else is done with it: fires the events that are due, those of the clock first. For whoever
   * executes items one by one; an executor that reads ahead has a Foresight.
   * @param main_line line of the main program to which the item belongs, 0 = not known; of an item of the main program it is not looked at
   * @return true when an event commands reset: the run ends here, and the item is not executed.
   */
  bool on_item(const nc_item& item, uint32_t main_line) {
    now_ = item.source;
    return schedule_.any() || !time_events_.empty() ? fire_due(item, main_line) : reset_;
  }

  /** True while an event waits for a block or an M code, so that the caller need not look for `main_line` otherwise. */
  bool waits_for_block() const { return schedule_.any(); }

  /** Events or hits are left: what is to come may differ from what was. */
  bool changes() const;

  /** The schedule of the events, for an executor that fires them itself. */
  EventSchedule& schedule() { return schedule_; }
  void fire(const SetupEvent& event);
  /** Fires the events whose time has come. */
  void fire_by_time();
  /** An event has commanded reset. */
  bool reset() const { return reset_; }

  /**
   * Execute a move: position and clock. A skip move is cut where it first enters a solid whose signal ends
   * it; then *move is changed to what was really done. @return false when nothing was moved at all (the
   * signal was on at the start).
   */
  bool execute(nc_move* move);

  /** A dwell in seconds or spindle turns; none while one of the skip signals is on. // M700 15.3 (2) */
  void dwell(bool turns, double value, uint32_t skip_mask = 0);
  void spindle(double rev_per_min) { spindle_rev_min_ = rev_per_min; }

  /** The world for a sync; a read of the clock lets 1 ms pass. */
  nc_world answer(uint32_t what);

  /** The last skip move was ended by its signal. */
  bool skipped() const { return skipped_; }

  /** What the setup gives that has had no effect so far: sentences that begin with its place. */
  std::vector<std::string> unused() const;

  /** Level of the macro interrupt signal. */
  bool macro_interrupt() const { return interrupt_; }

  const nc_axes& machine() const { return machine_; }
  double seconds() const { return seconds_; }
  /** Set the clock where another executor measures the time. */
  void set_seconds(double seconds) { seconds_ = seconds; }
  uint32_t input(unsigned word) const { return signals_.input[word]; }
  /** As the events that have fired have left them. */
  const OutsideSignals& signals() const { return signals_; }
  bool optional_stop() const { return setup_.optional_stop; }

  /** Skip signals that are on at a place in machine coordinates, which is `work` in those of the workpiece: bit n = signal n+1. */
  uint32_t signals_at(const nc_axes& machine, const nc_axes& work) const { return signals_.skip | solids_at(machine, work); }
  uint32_t signals_at(const nc_axes& machine) const;  // work coordinates as in the last move
  /** Those that a solid gives there, without those of events. */
  uint32_t solids_at(const nc_axes& machine, const nc_axes& work) const;

  /** The hit of the setup that a skip move takes. */
  struct Touch {
    size_t hit = SIZE_MAX;  // SIZE_MAX: the setup has none for it
    double part = INFINITY; // of the way, 0 to 1; infinity: nothing is met
    unsigned signal = 1;
  };
  /** Takes the hit that belongs to this skip move. */
  Touch take_hit(const nc_source& source, const nc_move& move);
  /** The move was not executed and will be given again. */
  void put_back(const Touch& touch);

 private:
  struct HitState {
    const SkipHit* hit;
    bool taken = false, missed = false;  // by a move that does not pass the place or listens to other signals
    uint32_t line = 0;                   // of that move
  };
  double duration(const nc_move& move) const;
  double first_box(const nc_move& move, const SkipSolid& solid, double length) const;
  double first_probe(const nc_move& move, const SkipSolid& solid) const;
  const SetupEvent* signal_within(double seconds, uint32_t mask) const;
  bool fire_due(const nc_item& item, uint32_t main_line);
  double first_entry(const nc_move& move) const;

  const Setup& setup_;
  unsigned axis_count_;
  nc_axes machine_;
  nc_axes skip_machine_;
  bool skipped_ = false;
  OutsideSignals signals_;
  nc_axes work_offset_ = {};  // workpiece minus machine coordinates, of the last move
  nc_source now_ = {};
  std::vector<HitState> hits_;
  double seconds_ = 0.0;
  double spindle_rev_min_ = 0.0;
  bool reset_ = false;
  bool interrupt_ = false;
  EventSchedule schedule_;
  std::vector<const SetupEvent*> time_events_;  // not yet fired
};

}  // namespace nc::tools
