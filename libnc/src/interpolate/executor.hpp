// SPDX-License-Identifier: Apache-2.0
// The executor of one part system: the ring of committed records, the plan over it, and the scan that walks
// along it. Feeder side and scan side are two threads; what they share is in here and nowhere else.
#pragma once

#include "base/arena.hpp"
#include "interpolate/axis_parameters.hpp"
#include "motion/axis_limits.hpp"
#include "nc/run.h"
#include "ring/record.hpp"

namespace nc {

struct ExecutorConfig {
  unsigned axis_count = 3;
  uint32_t rotary = 0;  ///< bit i: axis i is rotary
  AxisLimits limits[kMaxAxes];
  AxisVec soft_min, soft_max;  ///< for manual motion; commits are checked before they come here
  uint32_t soft_limited = 0;   ///< bit i: axis i has soft limits
  AxisVec reference;           ///< first reference position
  unsigned spindle_count = 1;
  uint8_t spindle_unsigned = 0;         ///< bit n: the measured speed of spindle n+1 does not say which way it turns
  uint8_t axis_spindle[kMaxAxes] = {};  ///< number of the spindle that is this axis (M700 10.5), 0 = none
  double cycle_s = 0.001;
  double max_feed_override = 2.0;
  AccuracyJointSpeed accuracy_joint_speed = nullptr;  ///< MotionLimits::accuracy_joint_speed
  uint32_t capacity = 1024;  ///< records in the ring, power of two
  bool tells_marks = false;  ///< executed_mark() is asked
  bool filters = false;      ///< there may be filters behind interpolation, each mean up to kLongestMean
  bool optimal = false;      ///< time-optimal jerk-limited law instead of the trapezoid
  double tolerance = 0.01;   ///< optimal: by which lines may leave the programmed path, mm; else by which the mean of a segment may round its corners
};

class ExecutorState;  ///< all members; defined in interpolate/executor_state.hpp

/// Where the scan has stopped for a macro interrupt.
struct Cut {
  bool inside = false;   ///< a block, else behind the newest mark
  Serial done = 0;       ///< newest record that has been executed
  unsigned syncs = 0;    ///< among those of the block
  AxisVec machine;
  double length = 0;     ///< of the move behind it that has been gone, mm
  double left = 0;       ///< of the dwell behind it, s or revolutions
};

/// Handle with the state in arena memory.
class Executor {
 public:
  /// Lays the executor out in `arena`. With a measuring arena only counts.
  void create(const ExecutorConfig& config, Arena& arena);

  // ---- feeder thread
  // ----------------------------------------------------------------------------------------------
  /// Records that may be pushed now.
  unsigned room() const;
  /// Numbers of the records under way: [tail, head).
  uint32_t head() const;
  uint32_t tail() const;
  /// Commits one record: computes its speed limits, and makes it visible to the scan after the next plan().
  void push(const Record& record);
  /// Recomputes the time law over everything committed (always ending at rest at its end) for the override
  /// the scan last saw, and swaps it in. Cheap when nothing changed. Call after pushing, and once per feeder
  /// period.
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
  /// The feeder has acted upon this word; the next start waits for that.
  void run_taken(uint32_t word);
  /// The newest run has come to its end item; it need not be taken back.
  bool ended() const;
  /// Axes that the signals of the machine mirror since the newest start.
  uint32_t mirror() const;
  /// At rest in a block stop or hold: give up every committed record behind the block in execution. On
  /// success *last is the mark of that block, which will still be executed, or where no block has been begun
  /// the newest that has been (0: none in this run). The first call asks and returns false, a later one finds
  /// the answer: false again when the machine moves, when the end of the block in execution is not committed
  /// yet, or when the scan has not run in between.
  /// A request whose answer is not fetched within 1000 calls of plan() is forgotten, so that the machine can
  /// be started again.
  bool truncate(Serial* last);
  /// The axes were moved by hand in a block stop and the program is to go on: the scan waits, and the ring
  /// from its tail on is the feeder's alone until reread_done().
  bool reread_asked() const;
  /// The request is for a macro interrupt (M700 13.12); cut() says where.
  bool interrupt_asked() const;
  Cut cut() const;
  /// Gives up every committed record behind the block stop; the mark to go on behind, as truncate().
  Serial give_up_ahead();
  /// By which axes were moved by hand that take the coordinate systems along.
  AxisVec shift_asked() const;
  void reread_done();
  /// Next executed record for the host.
  bool poll_event(nc_event* event, uint64_t* dropped);
  /// End of the newest block that has been executed in this run, 0: none. Right behind a new run(): as of when the program was given up.
  Serial last_mark() const;
  BlockSeq last_block() const;
  // ---- where it matters to others in which order blocks are executed (ExecutorConfig::tells_marks)
  /// The oldest block end that has been executed in the run `epoch` and not been taken yet: its block, and the cycle of the scan. False: none.
  bool executed_mark(uint32_t epoch, uint32_t* cycle, BlockSeq* seq);
  void take_executed_mark();
  /// All that was executed up to this cycle, and in it, can be seen.
  uint32_t cycle_seen() const;
  /// The places of those that are not taken yet are not needed for the next record.
  bool may_push() const;
  /// The alarm of the scan is its own: the move at *where cannot be begun or gone on with. Holds until reset.
  bool faulted(nc_source* where) const;
  /// An alarm that is in no record, the scan's own or one of the machine, has stopped the program in the block *where, behind *behind. Holds
  /// until reset.
  bool stopped(nc_source* where, BlockSeq* behind) const;
  /// Bit i: axis i is a spindle, too (M700 10.5), and holds its position; and its reference position return is complete.
  uint8_t servo_ready() const;
  uint8_t referenced() const;
  /// Commanded machine position as of the last scan (consistent snapshot).
  AxisVec commanded() const;
  /// For tests of what becomes of counters after years (docs/counters.md): everything that is counted begins here. Before anything else.
  void count_from(uint32_t first);
  /// Set position; only while idle, before the scan runs.
  void set_position(const AxisVec& machine);

  // ---- scan thread
  // --------------------------------------------------------------------------------------------------
  void cycle(const nc_inputs& in, nc_outputs& out) NC_RT;

 private:
  bool give_up_behind_block(Serial* last);
  ExecutorState* state_ = nullptr;
};

}  // namespace nc
