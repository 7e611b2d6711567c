// SPDX-License-Identifier: Apache-2.0
// The scan side of the executor: walks along committed records, one servo cycle at a time. Everything in here
// belongs to the scan thread; `ScanShared` is what crosses to the feeder.
#pragma once

#include <atomic>

#include "base/fixed.hpp"
#include "base/triple_buffer.hpp"
#include "filter/position_filter.hpp"
#include "interpolate/event_ring.hpp"
#include "interpolate/executor.hpp"
#include "interpolate/follower.hpp"
#include "interpolate/index_clamp.hpp"
#include "interpolate/input_border.hpp"
#include "interpolate/life_ring.hpp"
#include "interpolate/run_word.hpp"
#include "interpolate/spindle.hpp"
#include "interpolate/spindle_sync.hpp"
#include "interpolate/tap_follower.hpp"
#include "interpolate/truncation.hpp"
#include "manual/manual.hpp"
#include "motion/dry_run.hpp"
#include "motion/law.hpp"
#include "motion/optimal/optimal_planner.hpp"
#include "motion/planner.hpp"
#include "stream/interrupt_rest.hpp"

namespace nc {

/// What the scan publishes in every cycle.
struct ScanStatus {
  AxisVec command;
  double feed_override = 1;
  DryFeeds dry;
  bool single_block = false;
  uint8_t servo_ready = 0, referenced = 0;  ///< bit i: axis i, which is a spindle as well, holds its position; and is referenced (M700 10.5)
  bool ended = true;     ///< the newest run has come to its end item
  Serial last_mark = 0;  ///< newest block end that has been executed in this run
  BlockSeq last_block = 0;  ///< number of that block
  Cut cut;
  // A program that was in execution has been stopped by an alarm that is no item of it.
  bool stopped = false;     ///< there is such an alarm, of the machine or of the scan itself
  ScanFault faulted = ScanFault::none;  ///< it is one of the scan itself
  nc_source stopped_at{};   ///< block in execution at that moment
  BlockSeq stopped_behind = 0;  ///< the last block that had been executed to its end
  nc_tap tap{};  ///< nc_tap_get()
  MountedTool tool;  ///< in the spindle
  uint32_t starts = 0;       ///< number of starts so far, which is that of the stop behind the last one; 0 = there was none
  bool block_stop = false;   ///< the machine stands in a block stop, between two blocks; and
  BlockSeq stop_behind = 0;  ///< the block behind which a program that is interrupted there goes on
};

/// What has become of a record that the scan has gone past.
struct LeftRecord {
  uint32_t cycle = 0;     ///< cycle in which it was
  bool executed = false;  ///< true: it has been executed; false: it has been thrown away
};

/// The state of the machine at the last sync, the answer for the interpreter.
struct ScanWorld {
  Serial serial = 0;
  nc_world world{};
};

/// What scan and feeder tell each other. The protocols of `run` and `truncation` are described in interpolate/run_word.hpp and truncation.hpp.
struct ScanShared {
  alignas(64) std::atomic<uint32_t> tail{0};  ///< ring index of the record in execution
  std::atomic<uint32_t> ordinal{0};           ///< number of the segment in execution, or of the next one
  std::atomic<uint32_t> cycle{0};             ///< newest cycle for which everything else has been published
  std::atomic<uint32_t> run{0};     ///< RunWord
  std::atomic<uint32_t> mirror{0};  ///< nc_inputs::mirror of the newest start
  std::atomic<uint32_t> block_begun{
      0};  ///< 1: a part of the block in execution has been executed (valid with the answer to a truncation)
  Truncation truncation;
  alignas(64) std::atomic<uint32_t> run_taken{0};  ///< by the feeder: the newest run word that it has acted upon
  std::atomic<uint32_t> reread_request{0};  ///< by the scan: number of its newest request to read again from where the axes are; it waits for the answer
  std::atomic<uint32_t> reread_interrupt{0};  ///< by the scan: 1: the feeder is to begin with the interrupt program
  std::atomic<uint32_t> mdi_waits{0};  ///< by the feeder: the start behind start number this is to begin with blocks of MDI, 0 = none
  std::atomic<uint32_t> reread_mdi{0};  ///< by the scan, with the request: 1: the feeder is to begin with them
  AxisVec reread_from;                      ///< by the scan, with the request: where the program has left the axes, before they were moved by hand
  AxisVec reread_shift;                     ///< by the scan, with the request: by how much the coordinate systems are moved along
  std::atomic<uint32_t> returned{0};        ///< by the scan, with a request and with a run: bit i: axis i has come to its reference position by hand since the last one
  double reread_handle = 0;                 ///< by the scan, with the request: way of the handle that changes the length along the tool
  bool handle_added = false;                ///< by the feeder, with the answer: it has been added
  LengthAlongTool along_tool;               ///< ... and the length with which reading goes on
  AxisVec restart_at;                       ///< by the feeder, before it pushes the gate of a program that is begun inside: Executor::restart_at()
  uint64_t restart_blocks = 0;              ///< ... and with it
  std::atomic<bool> gone_on_inside{false};  ///< by the scan: the program that was begun inside has gone on; false again with restart_at
  std::atomic<uint32_t> reread_done{0};     ///< by the feeder: number of the request that is done
  Latest<ScanStatus> status;
  Latest<ScanWorld> world;
  Latest<AxisParameters> axes;  ///< by the feeder
  LifeRing lives;
  std::atomic<uint32_t> tool_life{0};   ///< by the feeder: nc_tool_life_bits of the tool in the spindle
  std::atomic<uint32_t> tool_group{0};  ///< by the feeder
  EventRing events;
};

class Interpolator {
 public:
  void create(const ExecutorConfig& config, const Record* ring, LeftRecord* left, Planner* planner, optimal::OptimalPlanner* optimal, ScanShared* shared,
              double* filters = nullptr);
  void set_position(const AxisVec& machine);
  void set_tap(const nc_tap& tap);  ///< before the first cycle
  void count_from(uint32_t first);  ///< for tests
  void cycle(const nc_inputs& in, nc_outputs& out) NC_RT;

 private:
  enum class Done : uint8_t { yes, no };  ///< whether a record is done: go on with the next one, or stay at it

  // interpolator.cpp: states
  void handshake(const nc_inputs& in) NC_RT;
  void messages() NC_RT;
  void take_recalculation(const nc_inputs& in) NC_RT;
  void interrupt(const nc_inputs& in) NC_RT;
  void ask_for_interrupt() NC_RT;
  bool may_cut() const NC_RT;
  void cut_block() NC_RT;
  void take_start(const nc_inputs& in) NC_RT;
  void states(const nc_inputs& in) NC_RT;
  void start(const nc_inputs& in) NC_RT;
  void drop_old() NC_RT;
  void come_to_rest() NC_RT;
  void give_up() NC_RT;
  void answer_truncate() NC_RT;
  void await_reread() NC_RT;
  bool between_blocks(BlockSeq* behind) const NC_RT;
  bool between_blocks() const NC_RT {
    BlockSeq behind = 0;
    return between_blocks(&behind);
  }
  void note_block_stop() NC_RT;
  void end_mdi() NC_RT;
  // interpolator_restart.cpp
  void stand_at_restart() NC_RT;
  bool restart_bars(bool mdi) NC_RT;
  uint32_t return_places(const AxisVec** places) const NC_RT;
  // interpolator_aside.cpp: axes are moved by hand in a feed hold
  /// Behind a thread a hold is a block stop, and bars as a hold does.
  struct HeldStop {
    bool on = false;
    AxisVec place;  ///< where the axes have stopped, and have to be again
  };
  bool hold_frees_hands() const NC_RT;
  void step_aside() NC_RT;
  bool aside_bars() NC_RT;
  void leave_aside() NC_RT;
  uint32_t axes_off_path() const NC_RT;
  uint32_t axes_off(const AxisVec& place) const NC_RT;
  const HeldStop& held_stop() const { return held_stop_[in_mdi_ ? 1 : 0]; }
  void stop_held() NC_RT;
  bool held_stop_bars(bool mdi) NC_RT;
  uint32_t axes_away() const NC_RT;
  void follow(const nc_inputs& in) NC_RT;
  void run(const nc_inputs& in) NC_RT;
  void manual(const nc_inputs& in, bool rested) NC_RT;
  void outputs(const nc_inputs& in, nc_outputs& out) NC_RT;
  void publish(const nc_inputs& in) NC_RT;

  // interpolator_spindle.cpp: spindles, and axes that are a spindle as well
  void follow_spindles(const nc_inputs& in) NC_RT;
  void take_position(unsigned axis, const nc_inputs& in) NC_RT;
  void settle_axes() NC_RT;
  void leave_at(const AxisVec& place) NC_RT;
  void tell_where_left() NC_RT;
  void drop(const Segment& s) NC_RT;
  bool beside_path_end() const NC_RT;
  bool moves_any(const Segment& segment, uint8_t axes) const NC_RT;
  bool lost_move(const Record& record, Done* done) NC_RT;
  bool may_read_again() const NC_RT;
  const nc_spindle_inputs& encoder(const nc_inputs& in) const NC_RT;
  double encoder_age_s(const nc_inputs& in) const NC_RT { return encoder_ != 0 ? in.spindle_age_s[encoder_ - 1] : 0; }

  void count_cutting(const nc_inputs& in) NC_RT;

  // interpolator_length.cpp: the handle changes the length along the tool (M700 12.3)
  void take_length_handle(const nc_inputs& in) NC_RT;
  bool length_handle_acts(const nc_inputs& in) const NC_RT;
  bool length_waits() const NC_RT { return length_way_ != 0 && (interrupt_mode_ & NC_INTERRUPT_IN_SERVICE) == 0; }  ///< for blocks to be read again
  void tell_length_way() NC_RT;
  void note_returned(const AxisVec& before) NC_RT;
  void tell_returned() NC_RT;
  void take_length_answer() NC_RT;
  void note_length(const LengthAlongTool& length) NC_RT;
  void block_ends_with(const Mark& mark) NC_RT;
  void forget_length() NC_RT;
  // interpolator_dry.cpp: dry run
  void take_dry_run(const nc_inputs& in) NC_RT;
  double dry_feed(const Segment& segment) const NC_RT;
  bool goes_by_spindle(const Segment& segment) const NC_RT { return segment.thread && !dry_.on(); }
  nc_stop_cause dry_stop(const nc_inputs& in) const NC_RT;
  bool skip_ends(const Segment& segment, const nc_inputs& in) const NC_RT;
  bool all_locked(const Segment& segment, const nc_inputs& in) const NC_RT;

  // interpolator_tap.cpp: taps that go with the spindle
  bool tap_disturbed(const nc_inputs& in) const NC_RT;
  bool tap_spindle_ready(const nc_inputs& in) NC_RT;
  void note_tap(const Segment& s, const nc_inputs& in) NC_RT;
  void fail_tap(ScanFault fault) NC_RT;
  bool tap_lets_go() NC_RT;
  Done take_tapping(uint8_t bits) NC_RT;
  void hold_tap() NC_RT;
  void release_tap() NC_RT;
  void leave_tap() NC_RT;
  double tap_turns() const NC_RT;
  void follow_tap(const nc_inputs& in) NC_RT;
  void take_tap_where_it_stands(const nc_inputs& in) NC_RT;
  bool draw_tap_out(const nc_inputs& in, nc_manual* wish, Manual::Rules* rules) NC_RT;
  bool tap_stands_in_hole() const NC_RT;
  double out_by(double place) const NC_RT;
  bool tap_bars() const NC_RT;
  void let_tap_go_outside(const nc_inputs& in) NC_RT;
  uint32_t tap_holds(const nc_inputs& in) const NC_RT;
  uint8_t tap_spindles() const NC_RT;
  void turn_tap_spindle(const nc_inputs& in, nc_outputs& out) NC_RT;
  nc_tap tap() const NC_RT;

  // interpolator_tap_axis.cpp: taps whose spindle is a C axis
  int tap_as_axis() const NC_RT;
  bool tap_axis_ready() NC_RT;
  void take_tap_axis(const nc_inputs& in) NC_RT;
  void adopt_tap_axis(const nc_inputs& in) NC_RT;
  void leave_tap_axis() NC_RT;
  double tap_axis_most(const Segment& s, double AxisLimits::*limit) const NC_RT;
  bool tap_turns_axis(unsigned axis) const NC_RT;
  double added_by_tap(unsigned axis) const NC_RT { return static_cast<int>(axis) == tap_.c_axis ? tap_.added : 0; }
  double tap_axis_place(const nc_inputs& in) const NC_RT;
  bool tap_axis_measured(const nc_inputs& in) const NC_RT;
  void turn_tap_axis() NC_RT;
  bool tap_axis_fails(const nc_inputs& in) const NC_RT;
  void begin_following_tap_axis(const nc_inputs& in) NC_RT;
  void spare_tap_axis(Manual::Rules* rules) const NC_RT;

  // interpolator_records.cpp: what each kind of record does
  Done execute(const Record& record, const nc_inputs& in) NC_RT;
  Done move(const Record& record, const nc_inputs& in) NC_RT;
  void take_plan() NC_RT;
  Done follow_plan(const Record& record, const nc_inputs& in) NC_RT;
  bool begin_thread(const Segment& segment, const nc_inputs& in) NC_RT;
  void follow_spindle(const Segment& segment, const nc_inputs& in) NC_RT;
  bool misses(const AxisVec& stop) const NC_RT;
  Done passed(const Record& record, const nc_inputs& in) NC_RT;
  bool would_jump(const AxisVec& place) const NC_RT;
  bool rests_at(const AxisVec& place) const NC_RT;
  bool path_stops(const nc_inputs& in) const NC_RT;
  nc_stop_cause standing(const Segment& segment, const nc_inputs& in) NC_RT;
  void tell_planner(const nc_inputs& in, const ScanStatus& status) NC_RT;
  bool begin_move(const Record& record, const nc_inputs& in) NC_RT;
  void end_move(const Record& record, const nc_inputs& in) NC_RT;
  void change_skip_feed(const SkipSpeeds& speeds, uint32_t signals) NC_RT;
  double speed_cap(const Segment& segment, const nc_inputs& in) NC_RT;
  double corner_factor(const Segment& segment) const NC_RT;
  double feed_override(const nc_inputs& in) const NC_RT;
  double override_in_force(const nc_inputs& in, nc_override_source* source) const NC_RT;
  nc_stop_cause no_spindle(const nc_inputs& in) const NC_RT;
  Done action(const Action& action, const nc_inputs& in) NC_RT;
  Done strobe(const Action& action, const nc_inputs& in) NC_RT;
  Done gate(const Gate& gate, const nc_inputs& in) NC_RT;
  Done optional_stop(const nc_inputs& in) NC_RT;
  Done dwell(double rate, double amount) NC_RT;
  Done dwell_turns(double turns, const nc_inputs& in) NC_RT;
  Done sync(const Record& record, const nc_inputs& in) NC_RT;
  // interpolator_filter.cpp: records that wait for the filters, and the compensation that is added behind interpolation
  bool waits_for_filters(const Record& record, const nc_inputs& in) NC_RT;
  bool filters_ready(const Record& record) NC_RT;
  void note_skip(const nc_inputs& in, uint32_t came) NC_RT;
  void watch_skip(const nc_inputs& in) NC_RT;
  void round_arc(const Segment& segment) NC_RT;
  void end_rounding() NC_RT;
  double feed_of_axes() const NC_RT;
  Done wait(nc_stop_cause cause) NC_RT;
  void mark(const Mark& mark, const nc_inputs& in) NC_RT;
  bool stops_at(const Mark& mark, const nc_inputs& in) const NC_RT;
  void alarm() NC_RT;
  void stop_in(const nc_source& block, BlockSeq behind) NC_RT;
  Done fault(const Record& record) NC_RT;
  void leave(const Record& record, bool executed) NC_RT;
  /// `width` > 0: in-position width that the block gives, in the place of those of the axes.
  bool in_position(const nc_inputs& in, double width = 0) const NC_RT;

  // interpolator_index.cpp: index tables
  Done wait_for_clamp() NC_RT;
  bool unclamp_for(const Segment& segment, const nc_inputs& in) NC_RT;
  bool clamp_before(const Record& record, const nc_inputs& in) NC_RT;
  uint32_t may_clamp() NC_RT;
  void watch_index(const nc_inputs& in) NC_RT;
  void clamp_at_rest(uint32_t wanted, const nc_inputs& in) NC_RT;
  void manual_cycle(const nc_inputs& in) NC_RT;

  const Record& current() const { return ring_[tail_ & mask_]; }
  /// The record belongs to this run; records of other runs are thrown away.
  bool is_current(const Record& r) const { return r.epoch == run_.epoch(); }
  bool at_rest() const { return law_.v == 0 && !passing_; }  ///< the interpolated path rests; behind the filters the axes may still move
  /// The filters hold nothing any more.
  bool drained() const NC_RT { return !filter_.active() || filter_.drained(place()); }
  bool stands() const NC_RT { return at_rest() && drained(); }
  /// The interpolated place with the radius compensation of an arc (M700 13.15).
  AxisVec place() const NC_RT {
    AxisVec at = wanted_;
    if (rounding_)
      for (unsigned i = 0; i < 2; ++i) at[round_axis_[i]] += round_[i];
    return at;
  }
  uint32_t spindles_now() const { return c_axes_ & ~uint32_t{servo_ready_}; }  ///< axes that are spindles at present (M700 10.5)
  bool held() const { return hold_ || reset_ || alarmed_ || cutting_; }  ///< at rest no further record is executed
  bool braking() const { return held() || interlock_ || index_lost_ || losing_; }  ///< no axis may move
  /// What stops a thread that is being cut. M700 6.7.1: feed hold does not.
  bool thread_braking() const { return reset_ || alarmed_ || interlock_ || index_lost_; }
  bool cutting_thread() const {
    return moving_ && (optimal_ != nullptr ? !follower_.at_rest() : law_.v > 0) && current().segment.thread;
  }
  double programmed_feed(const Segment& s) const NC_RT;
  void turn_feed_handle(const nc_inputs& in) NC_RT;
  bool thread_may_begin(const Segment& segment, const nc_inputs& in) NC_RT;
  double thread_speed(const Segment& segment, const nc_inputs& in) NC_RT;
  bool spindle_reversed(const nc_inputs& in) const;
  /// Turns of the spindle at this moment of the cycle.
  double spindle_turns(const nc_inputs& in) const { return encoder(in).turns + (config_.cycle_s - time_) * encoder(in).rev_per_s; }

  // ---- set once
  ExecutorConfig config_;
  const Record* ring_ = nullptr;
  LeftRecord* left_ = nullptr;  ///< one for each place of the ring; nullptr: not needed
  uint32_t mask_ = 0;
  Planner* planner_ = nullptr;
  optimal::OptimalPlanner* optimal_ = nullptr;  ///< nullptr in the trapezoid mode
  ScanShared* shared_ = nullptr;

  // ---- place in the ring
  const Plan* plan_ = nullptr;  ///< plan of this cycle (trapezoid mode)
  uint32_t end_ = 0;            ///< ring index behind the last record that may be executed
  uint32_t tail_ = 0, ordinal_ = 0;  ///< ring index of the record in execution; number of its segment, or of the next one
  RunWord run_;
  bool run_ended_ = true;  ///< the newest run has come to its end item
  bool frozen_ = false;    ///< the feeder may be truncating
  bool block_begun_ = false;  ///< a part of the block in execution has been executed
  bool displaced_ = false;  ///< axes were moved by hand since the block stop
  AxisVec left_at_;         ///< where the program has left the axes, if something else has moved them since (elsewhere_)
  bool elsewhere_ = false;
  AxisVec path_end_;  ///< end of the newest move that has been executed
  uint32_t returned_ = 0;   ///< bit i: axis i has come to its reference position by hand, and the feeder does not know it yet
  uint32_t by_hand_ = 0;    ///< bit i: axis i was moved by hand, and the program has not moved it since
  /// Motion by hand in a feed hold: what the path goes on with when the axes are back.
  struct Aside {
    bool on = false;        ///< axes were moved by hand in this hold, or are about to be
    bool rounding = false;  ///< rounding_ as the path has stopped
    AxisVec path;           ///< wanted_ as the path has stopped
    AxisVec place;          ///< where the axes have stopped, and have to be again
    uint32_t returned = 0;  ///< bit i: axis i has come to its reference position by hand
  };
  Aside aside_;
  HeldStop held_stop_[2];  ///< of the program, and of blocks of MDI that interrupt it ([in_mdi_])
  bool rereading_ = false;  ///< the feeder reads again from here; meanwhile nothing is executed, moved or given up
  bool begins_again_ = false;  ///< a program that is begun inside stands at its place, and has not gone on yet
  AxisVec restart_at_;         ///< where its axes have to be
  bool in_mdi_ = false;        ///< blocks of MDI that interrupt the program have begun, and not come to their end
  uint32_t starts_ = 0;       ///< ScanStatus::starts, and below block_stop and stop_behind
  bool block_stop_ = false;
  BlockSeq stop_behind_ = 0;
  uint32_t reread_ = 0;     ///< number of requests to read again so far

  InputBorder border_;

  // ---- motion
  LawState law_;         ///< on the segment in execution; v carries over to the next one
  Follower follower_;    ///< optimal: goes along the plan; law_ is set from it
  AxisVec passed_at_;    ///< optimal: end of the newest record that was passed
  bool passing_ = false; ///< optimal: in the cycle in which a stop ends, until the record in which it ends has been reached
  double silent_ = 0;    ///< optimal: s for which a stop has been asked for without a plan that stops
  bool no_law_ = false;  ///< optimal: the planner has found no law for what follows
  double turns_ = 0;     ///< optimal: speed of the spindle that the planner has been told, rev/s
  double feed_scale_ = 1;  ///< optimal: feed override that the planner has been told
  SpindleSync sync_;     ///< optimal: keeps the thread in execution with the spindle
  bool moving_ = false;  ///< the current record is a segment that has begun
  double time_ = 0;      ///< what is left of this cycle, s
  AxisVec wanted_;       ///< interpolated position
  bool rounding_ = false;  ///< on an arc with radius compensation (M700 13.15)
  uint8_t round_axis_[2] = {0, 1};
  double round_[2] = {};   ///< mm that the radius compensation adds to these two axes
  bool rapid_behind_ = false;  ///< the move that ended last was rapid traverse
  bool check_ = false;     ///< the move that ended last ends with a deceleration check (M700 7.9)
  AxisVec command_, last_command_;  ///< commanded positions, behind the filters, of this cycle and the one before
  const Segment* latest_ = nullptr;                        ///< segment that was executed last in this cycle
  Affine to_work_;  ///< from machine to workpiece coordinates, of the segment executed last
  AxisVec target_;                                         ///< end of the segment in execution
  PositionFilter filter_;
  Manual manual_;
  bool manual_allowed_ = false;
  bool followed_ = false;  ///< nc_outputs::followed

  // ---- state
  nc_run_state state_ = NC_STATE_IDLE;
  nc_stop_cause cause_ = NC_CAUSE_NONE;
  bool hold_ = false, reset_ = false, alarmed_ = false, interlock_ = false;
  bool last_start_ = false, last_reset_ = false;
  bool start_ = false;  ///< cycle start was pressed and not yet acted upon
  bool start_refused_ = false;  ///< a cycle start was refused because feed hold was on, and feed hold still is
  bool tap_refuses_ = false;    ///< a cycle start was refused because a tap stands in its hole, and it still does
  nc_run_state shown_ = NC_STATE_IDLE;  ///< nc_outputs::state of the cycle before
  ScanFault faulted_ = ScanFault::none;  ///< the alarm that the scan has raised; until reset
  bool placed_ = false;         ///< source_ is a block of this run
  bool stopped_ = false;        ///< ScanStatus::stopped, and below stopped_at and stopped_behind; until reset
  nc_source stopped_at_{};
  BlockSeq stopped_behind_ = 0;

  // ---- handshake of M S T B
  uint8_t strobe_ = 0;
  uint8_t held_ = 0;     ///< bit of the code whose strobe cannot rise in this cycle, because FIN is on or its last strobe still waits
  uint8_t fin_wait() const { return strobe_ | fin1_groups_ | own_groups_; }
  bool fin_ = false;     ///< FIN1 or FIN2 is on in this cycle
  uint8_t fin1_groups_ = 0;  ///< bits of the codes that the FIN1 which is on completes when it falls
  bool fin_low_ = true;  ///< FIN has been off since a strobe rose
  uint8_t own_fin_ = 0;      ///< bits of the groups whose own FIN is on in this cycle
  uint8_t own_groups_ = 0;   ///< of these, those that it completes when it falls
  uint8_t own_low_ = 0xf;    ///< bits of the groups whose own FIN has been off since their strobe rose
  uint32_t m_ = 0, t_ = 0, b_ = 0;
  uint32_t suppress_ = 0;  ///< nc_suppress_bits
  uint32_t disable_ = 0;   ///< nc_disable_bits

  // ---- index tables (M700 9.3)
  IndexClamp index_;
  bool index_waits_ = false;  ///< in this cycle something waits for a table to be clamped or unclamped
  bool index_lost_ = false;   ///< a table that moves is not unclamped any more

  // ---- macro interrupt (M700 13.12)
  uint32_t interrupt_mode_ = 0;      ///< nc_interrupt_bits
  bool interrupt_last_ = false;      ///< level of the signal
  InterruptRest interrupt_rest_;     ///< when a signal that stays on counts again
  bool interrupt_wanted_ = false;    ///< the signal has been accepted: it acts at the end of the block in execution, or at once
  bool cutting_ = false;             ///< the axes come to rest inside a block, to cut it
  bool block_waits_ = false;         ///< the block in execution cannot be cut any more: its skip move has ended, or it holds M96 or M97
  unsigned block_syncs_ = 0;         ///< number of syncs of the block in execution that have been answered
  bool last_staged_ = false;         ///< the record executed last came out of a stage (Record::staged)
  bool last_in_hole_ = false;        ///< ... belonged to a hole (Record::in_hole)
  Serial done_ = 0;                  ///< newest record that has been executed
  Cut cut_;
  bool recalculate_ = false, recalculate_last_ = false;  ///< a recalculation waits for the end of the block; level of the signal
  // ---- length along the tool (M700 12.3)
  LengthAlongTool length_;           ///< behind the newest block end that has been executed
  double length_way_ = 0;            ///< way of the handle that the feeder does not know yet, mm
  double length_told_ = 0;           ///< way that it has been told and has not answered yet
  bool length_dropped_ = false;      ///< nc_outputs::tool_length_dropped
  bool end_is_old_ = false;          ///< the end of the block behind which blocks have been read again is still to come, and was read with the length before
  bool start_told_ = false;          ///< blocks have been read again for the start that is under way, with what the handle had been turned by then

  bool reread_reached_ = false;      ///< the place from which blocks are read again has been reached: the feeder is asked in the next cycle
  bool reread_interrupt_ = false;    ///< the feeder begins with the interrupt program then

  // ---- gates
  bool gate_begun_ = false;
  double gate_left_ = 0;

  // ---- threads (M700 6.7.1)
  bool block_has_thread_ = false;    ///< the block in execution has cut a thread
  bool hold_behind_thread_ = false;  ///< feed hold was pressed in a thread: it acts behind the first block without a thread

  bool thread_locked_ = false;       ///< the thread has reached its speed and keeps its place on the spindle
  double thread_origin_ = 0;         ///< turns of the spindle where the segment in execution would have begun at speed

  // ---- feed (M700 7)
  uint8_t tapping_ = 0;              ///< nc_tapping_bits in force
  DryFeeds dry_;                     ///< of dry run, where it is on
  struct TapInHand {                 ///< the synchronous tap (M700 13.1.1) in force, or left in its hole by a reset
    bool known = false;              ///< a stroke has begun: what stands below is its
    bool taken = false;              ///< the same of the strokes of this hole: its spindles have been taken over
    bool held = false;               ///< in the hole without a program: the spindle turns with its axis by hand, and not else
    bool drawing = false;            ///< it is drawn out
    bool stuck = false;              ///< held, and its spindle has not followed: it cannot be drawn out with it
    bool pressed = false;            ///< level of the signal for that
    bool locked = false;             ///< its axis stands in a machine lock, and so does its spindle
    bool adopts = false;             ///< held, behind a power cut: its spindle is what that is as the tap begins to move, spindle or C axis
    bool selects = false;            ///< ... and nobody knows which spindle it was: the one that is selected then
    int c_axis = -1;                 ///< its spindle is this axis
    unsigned axis = 0;               ///< that the tap moves
    double entry = 0;                ///< place of the axis where the tap has begun
    double per_mm = 0;               ///< turns of the spindle by the way of the axis, forward positive
    double speed = 0, acceleration = 0;  ///< of the axis, mm/s with the sign of the way in, and mm/s^2
    double turns = 0;                ///< of the spindle since it was taken over, up to the move in execution
    double waited_s = 0;             ///< for the spindle, where it is to be let go
    double shown = 0;                ///< turns of the cycle before
    double added = 0;                ///< to the commands of c_axis, deg
    double c_from = 0;               ///< place of c_axis where the encoder of its spindle is at 0, deg
  };
  TapInHand tap_;
  TapFollower tap_follower_;         ///< keeps the axis with the measured angle
  bool hold_behind_tap_ = false;     ///< feed hold was pressed between R and R again of a tap
  double digit_pulses_[5] = {};      ///< what the handle has made of F1 to F5

  // ---- spindles (M700 10.6), and axes that are a spindle as well (M700 10.5)
  SpindleSpeeds spindles_;
  unsigned encoder_ = 1;       ///< number (from 1) of the spindle whose encoder is used, 0 = none
  uint8_t c_axes_ = 0;         ///< bit i: axis i is a spindle as well; only these have bits in the three below
  uint8_t servo_on_ = 0, servo_ready_ = 0, referenced_ = 0;
  AxisVec turned_;             ///< how far such axes stand beside the committed path, which does not know of it yet
  uint8_t stale_ = 0;          ///< bit i: axis i stands beside that path: what is committed is read again before it moves
  bool losing_ = false;        ///< the move in execution has lost its C axis, and comes to rest
  bool dropping_ = false;      ///< the rest of the block is not executed

  // ---- tool life
  MountedTool tool_;             ///< ScanStatus::tool
  double cut_s_ = 0;             ///< it has cut for so long since the feeder was told
  bool broken_last_ = false;     ///< level of the signal

  // ---- skip
  bool skipped_ = false;       ///< the last skip move ended by its signal
  bool skip_braking_ = false;  ///< on the way to rest after the signal
  uint8_t skip_behind_ = 0;    ///< signals of a skip move whose path has ended before its axes have
  bool skip_behind_away_ = false;  ///< ... which ends where they are off
  AxisVec skip_position_;
  double skip_feed_ = 0;       ///< feed of a move whose skip signals change it (M700 15.5), mm/s
  uint32_t skip_last_ = 0;     ///< skip signals of the cycle before, to find their rising edges
  uint16_t current_limit_[kMaxAxes] = {};  ///< percent (M700 15.6)

  // ---- what is shown to the outside
  uint32_t output_[NC_WORDS] = {};
  uint32_t output_written_[NC_WORDS] = {};  ///< bits that blocks have written in this cycle
  struct Text {
    uint32_t id = 0, port = 0;
  };
  FixedQueue<Text, 32> messages_;
  bool message_ = false;
  Text message_text_;
  Serial serial_ = 0;
  nc_source source_{};
  ModalId modal_ = 0;
  Serial last_mark_ = 0;
  BlockSeq last_block_ = 0;
  double path_length_ = 0;
  uint64_t run_cycles_ = 0, start_cycles_ = 0, power_cycles_ = 0, blocks_ = 0;
};

}  // namespace nc
