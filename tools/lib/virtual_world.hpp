// SPDX-License-Identifier: Apache-2.0
// The machine behind an offline run: it is where the last move ended, its clock goes by the length of what
// was done, its inputs and solids are those of the setup. Nothing depends on wall-clock time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nc/nc.h"
#include "tools/lib/setup.hpp"

namespace nc::tools {

/** Follows the items of one part system and answers its syncs. */
class VirtualWorld {
 public:
  /** Both must outlive the world. */
  VirtualWorld(const Setup& setup, const nc_system_config& system);

  /**
   * To be called with every item before anything else is done with it: fires the events that are due.
   * An event "when line N" fires with the first item of line N of the main program. A line that calls a sub
   * program shows itself only after the return; then the event fires when the sub program begins, found as
   * the line behind the last one that has ended (`next_line`, 0 = not known). An event on a line of a program with a number fires with the
   * first item of that line, one on an M code with the code itself.
   * @return true when an event commands reset: the run ends here.
   */
  bool on_item(const nc_item& item, uint32_t next_line) {
    now_ = item.source;
    return line_events_.empty() && time_events_.empty() && other_events_.empty() ? reset_ : fire_due(item, next_line);
  }
  /** The same for an M code where another executor gives it out. */
  void on_m(double code);

  /**
   * This line of the main program will read inputs when it is executed: the events that wait for it set theirs now, and give their
   * signals when the line begins. For an executor that reads an input in the cycle in which it gets there.
   */
  void foresee(uint32_t line);

  /** True while an event waits for a line, so that the caller need not look for `next_line` otherwise. */
  bool waits_for_line() const { return !line_events_.empty(); }

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
  uint32_t input(unsigned word) const { return input_[word]; }
  bool optional_stop() const { return setup_.optional_stop; }

  /** Skip signals that are on at a place in machine coordinates, which is `work` in those of the workpiece: bit n = signal n+1. */
  uint32_t signals_at(const nc_axes& machine, const nc_axes& work) const;
  uint32_t signals_at(const nc_axes& machine) const;  // work coordinates as in the last move

 private:
  struct HitState {
    const SkipHit* hit;
    bool taken = false, missed = false;  // by a move that does not pass the place or listens to other signals
    uint32_t line = 0;                   // of that move
  };
  double duration(const nc_move& move) const;
  double first_box(const nc_move& move, const SkipSolid& solid, double length) const;
  double first_probe(const nc_move& move, const SkipSolid& solid) const;
  double take_hit(const nc_move& move);
  const SetupEvent* signal_within(double seconds, uint32_t mask) const;
  bool fire_due(const nc_item& item, uint32_t next_line);
  void fire(const SetupEvent& event);
  void set_inputs(const SetupEvent& event);
  double first_entry(const nc_move& move) const;

  const Setup& setup_;
  unsigned axis_count_;
  nc_axes machine_;
  nc_axes skip_machine_;
  bool skipped_ = false;
  uint32_t input_[NC_WORDS];
  nc_axes work_offset_ = {};  // workpiece minus machine coordinates, of the last move
  nc_source now_ = {};
  uint32_t skip_level_ = 0;   // signals that events have switched on
  std::vector<HitState> hits_;
  double seconds_ = 0.0;
  double spindle_rev_min_ = 0.0;
  bool reset_ = false;
  bool interrupt_ = false;
  bool called_ = false;  // a sub program has begun since the last item of the main program
  // Not yet fired; the other ones are those of a program with a number, and of M codes.
  std::vector<const SetupEvent*> line_events_, time_events_, other_events_;
  std::vector<const SetupEvent*> foreseen_;  // their inputs are set
};

}  // namespace nc::tools
