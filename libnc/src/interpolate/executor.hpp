// SPDX-License-Identifier: Apache-2.0
// The executor of one part system: the ring of committed records, the plan over it, and the scan that walks
// along it. Feeder side and scan side are two threads; what they share is in here and nowhere else.
#pragma once

#include "base/arena.hpp"
#include "interpolate/axis_parameters.hpp"
#include "interpolate/life_ring.hpp"
#include "motion/axis_limits.hpp"
#include "nc/run.h"
#include "ring/record.hpp"

namespace nc {

/// Alarms of the scan itself: the move in execution cannot begin or go on; the spindle of a synchronous tap does not follow it; its encoder jumps.
enum class ScanFault : uint8_t { none, move, tap, encoder };

struct ExecutorConfig {
  unsigned axis_count = 3;
  uint32_t rotary = 0;  ///< bit i: axis i is rotary
  AxisLimits limits[kMaxAxes];
  AxisVec soft_min, soft_max;  ///< for manual motion; commits are checked before they come here
  uint32_t soft_limited = 0;   ///< bit i: axis i has soft limits
  AxisVec reference;           ///< first reference position
  unsigned spindle_count = 1;
  uint8_t spindle_unsigned = 0;         ///< bit n: the measured speed of spindle n+1 has no sign for the direction in which it turns
  uint8_t axis_spindle[kMaxAxes] = {};  ///< number (from 1) of the spindle that becomes this axis while its servo is on (M700 10.5), 0 = none
  double cycle_s = 0.001;
  double max_feed_override = 2.0;
  double tap_most_apart = 2;  ///< revolutions that the spindle of a synchronous tap may be away from its command
  AccuracyJointSpeed accuracy_joint_speed = nullptr;  ///< MotionLimits::accuracy_joint_speed
  uint32_t capacity = 1024;  ///< records in the ring, power of two
  bool tells_marks = false;  ///< executed_mark() will be called
  bool filters = false;      ///< there may be filters behind interpolation, each mean up to kLongestMean
  bool optimal = false;      ///< time-optimal jerk-limited law instead of the trapezoid
  double tolerance = 0.01;   ///< mm. optimal: the distance by which lines may leave the programmed path; else by which a filter of high-accuracy
                             ///< control may round corners
};

class ExecutorState;  ///< the members of an executor; defined in interpolate/executor_state.hpp

/// Where the scan has stopped for a macro interrupt.
struct Cut {
  bool inside = false;   ///< true: inside a block; false: behind the newest mark that has been executed
  Serial done = 0;       ///< newest record that has been executed
  unsigned syncs = 0;    ///< number of syncs among the executed records of the block
  AxisVec machine;       ///< interpolated place at which the axes stand
  double length = 0;     ///< length of the next record, a move, that is done already, mm
  double left = 0;       ///< what is left of the next record, a dwell, s or revolutions
};

/// Handle with the state in arena memory.
class Executor {
 public:
  /// Lays the executor out in `arena`. With a measuring arena only counts.
  void create(const ExecutorConfig& config, Arena& arena);

  // ---- feeder thread
  // ----------------------------------------------------------------------------------------------
  /// Number of records that may be pushed now.
  unsigned room() const;
  /// Ring numbers of the records that are not executed yet: from tail() up to, but not including, head().
  uint32_t head() const;
  uint32_t tail() const;
  /// Commits one record: computes its speed limits. The scan sees the record after the next plan().
  void push(const Record& record);
  /// Computes the time law over everything committed, which always ends at rest, for the override that the scan has reported last, and
  /// hands it to the scan. Cheap when nothing has changed. To be called after pushing, and once per feeder period.
  void plan();
  /// The same in slices of about so many `instructions`, of which they leave what is left. First what the scan asks for and what can wait for
  /// nothing, a stop before all; then, when that is done (true), a round for what was pushed before it began. True at its end.
  bool answer(int64_t* instructions);
  bool plan(int64_t* instructions);
  /// The law is made in slices; else plan() does all of it at once, whatever it is given.
  bool slices() const;
  void set_axis_parameters(const AxisParameters& axes);
  /// The scan has reached the sync `serial`, is at rest and in position: copies the world and returns true.
  bool sync_reached(Serial serial, nc_world* world) const;
  /// The scan has executed everything that was pushed and is at rest.
  bool drained() const;
  /// The run that the scan is in (interpolate/run_word.hpp). Records of another epoch are thrown away.
  uint32_t run() const;
  /// Tells the scan that the feeder has acted upon this run word; the next start waits for it.
  void run_taken(uint32_t word);
  /// The newest run has come to its end item, so nothing of it has to be taken back.
  bool ended() const;
  /// Bit i: axis i is mirrored by a signal of the machine since the newest start.
  uint32_t mirror() const;
  /// At rest in a block stop or hold: give up every committed record behind the block in execution. On success *last is the mark of that
  /// block, which will still be executed; where no block has been begun, it is the newest mark that has been executed (0: none in this run).
  /// The first call asks the scan and returns false, a later call finds the answer. It returns false again when the machine moves, when the
  /// end of the block in execution is not committed yet, or when the scan has not run in between.
  /// A request whose answer is not fetched within 1000 calls of plan() is forgotten, so that the machine can be started again.
  bool truncate(Serial* last);
  /// The scan waits until blocks are read again, and only the feeder uses the ring from its tail on until reread_done(). So it is when axes were
  /// moved by hand in a block stop and the program is to go on, for a macro interrupt, and for a recalculation.
  bool reread_asked() const;
  /// The request of reread_asked() is for a macro interrupt (M700 13.12); cut() says where the machine stands.
  bool interrupt_asked() const;
  /// The request of reread_asked() is for the blocks of MDI that wait.
  bool mdi_asked() const;
  /// The machine stands in a block stop, between two blocks; *behind is the block behind which the program goes on.
  bool block_stop(BlockSeq* behind) const;
  /// Number of starts so far, never 0 behind the first: it tells one stop from another.
  uint32_t starts() const;
  /// The next start begins with blocks of MDI, if it is the one behind this number of starts; 0 = none does.
  void let_mdi_wait(uint32_t starts);
  Cut cut() const;
  /// Gives up every committed record behind the block stop. Returns the mark behind which reading goes on, as truncate() does.
  Serial give_up_ahead();
  /// The ways by which axes were moved by hand, where the coordinate systems are to be moved along; else 0.
  AxisVec shift_asked() const;
  /// With reread_asked(): where the program has left the axes, before they were moved by hand or turned as a spindle.
  AxisVec left_at() const;
  /// With reread_asked(), and with a run that is new: bit i: axis i has come to its reference position by hand meanwhile.
  uint32_t returned() const;
  /// With reread_asked(): by how much the handle has been turned to change the length along the tool (M700 12.3); 0 = it was not.
  double handle_asked() const;
  /// To be called before reread_done(): whether that has been added, and the length along the tool with which reading goes on.
  void tell_along_tool(bool added, const LengthAlongTool& length);
  void reread_done();
  /// Where the axes have to be for the program that is begun inside by the gate pushed next (Gate::begins_again), and how many blocks come before.
  void restart_at(const AxisVec& machine, uint64_t blocks);
  bool gone_on_inside() const;
  /// Next executed record for the host; *dropped: how many have been dropped in all.
  bool poll_event(nc_event* event, uint64_t* dropped);
  /// Mark at the end of the newest block that has been executed in this run, 0: none. Right after run() has changed it is still that of the program
  /// which was given up.
  Serial last_mark() const;
  BlockSeq last_block() const;
  // ---- for other part systems, to which the order matters in which blocks are executed (ExecutorConfig::tells_marks)
  /// The oldest block end that has been executed in the run `epoch` and has not been taken yet: its block, and the cycle of the scan in which it was
  /// executed. False: there is none.
  bool executed_mark(uint32_t epoch, uint32_t* cycle, BlockSeq* seq);
  void take_executed_mark();
  /// Number of the newest cycle that is complete: everything that was executed in it and before can be seen.
  uint32_t cycle_seen() const;
  /// The next record does not need the ring place of a block end that has not been taken yet.
  bool may_push() const;
  /// The scan itself has raised the alarm, in the block *where. It holds until reset.
  bool faulted(nc_source* where) const;
  ScanFault scan_fault() const;
  /// An alarm that is no record, one of the scan or of the machine, has stopped the program in the block *where. *behind: the last block that had been
  /// executed to its end. It holds until reset.
  bool stopped(nc_source* where, BlockSeq* behind) const;
  /// Bit i: axis i, which is a spindle as well (M700 10.5), holds its position; and: its reference position return is complete.
  uint8_t servo_ready() const;
  uint8_t referenced() const;
  /// Commanded machine position of the last cycle (all axes of the same cycle).
  AxisVec commanded() const;
  /// For tests of counters that have run for years (docs/counters.md): all counters begin at `first`. To be called before anything else.
  void count_from(uint32_t first);
  /// Sets the position; only while idle, before the scan runs.
  void set_position(const AxisVec& machine);
  // ---- tool life management: the scan counts for how long a tool of the table cuts
  /// A tool has cut for so many ms, LifeRing::kBroken = it is broken. False: there is nothing new.
  bool tool_cut(MountedTool* tool, uint32_t* ms);
  MountedTool tool_in_spindle() const;
  void tell_tool_life(uint32_t bits, uint32_t group);
  /// The tap of this part system as the scan has left it; and before the first cycle the one that a power cut has left (nc_tap_set()). False: the scan runs.
  nc_tap tap() const;
  bool set_tap(const nc_tap& tap);

  // ---- scan thread
  // --------------------------------------------------------------------------------------------------
  void cycle(const nc_inputs& in, nc_outputs& out) NC_RT;

 private:
  bool give_up_behind_block(Serial* last);
  ExecutorState* state_ = nullptr;
};

}  // namespace nc
