// SPDX-License-Identifier: Apache-2.0
// The interpreter of one part system as control sees it: what it constructs, takes items from, rewinds and asks. What an interpreter is made
// of (interpreter.hpp) stays in this room, so a change of it does not rebuild control.
#pragma once

#include "alarm/fault.hpp"
#include "base/arena.hpp"
#include "base/intern_pool.hpp"
#include "frame/affine.hpp"
#include "frame/frames.hpp"
#include "frame/stroke_box.hpp"
#include "interpret/host_tables.hpp"
#include "interpret/motion_settings.hpp"
#include "interpret/vendor_codes.hpp"
#include "nc/control.h"
#include "path/shape.hpp"
#include "program/store.hpp"
#include "stream/item_queue.hpp"

namespace nc {

struct Dialect;
struct Interpreter;
class SharedTables;

struct InterpreterConfig {
  const Dialect* dialect = nullptr;
  const nc_system_config* system = nullptr;
  uint8_t system_index = 0;        ///< part system, from 0
  uint32_t look_ahead = 1024;
  uint32_t window_bytes = 65536;
  FramesConfig frames;
  const VendorCodes* vendor = nullptr;
  double longest_filter_ms = 0;    ///< the longest mean that fits behind interpolation
};

/// The alarm that has ended the program, as far as it is not made of its condition.
struct RaisedAlarm {
  const Fault& fault;
  const nc_source& source;
  const char* own_words;    ///< those of the program (M700 13.5.5), "" = none
  const nc_alarm& vendor;   ///< what the last function of the vendor that failed has said
  const nc_text& cause;     ///< a sentence more than the fault has; "" = none
  bool cause_instead;       ///< it says all that there is to say
};

/// What parameters say of the axes while no block moves them. Bit i of a set: axis i.
struct AxisSettings {
  uint32_t index_axes, machine_turn, short_cut, no_reference;
  const double* index_increment;  ///< by axis
};

/// What moves name by a number.
struct MovePools {
  const InternPool<Affine>* transforms = nullptr;
  const InternPool<MoveShape>* shapes = nullptr;  ///< Move::shape counts from 1
  const InternPool<MotionSettings>* motion_settings = nullptr;
  const InternPool<StrokeBox>* stroke_boxes = nullptr;
};

/// Maps between what is programmed and the axes, as they are behind the newest block.
struct MapsInForce {
  bool mirror;           ///< of any kind
  bool other_axes;       ///< moves go through a map of axes (cylinder, polar, hypothetical axis)
  uint32_t frozen_axes;  ///< bit i: axis i does not move itself, a map of axes moves for it
};

/// Macro interrupt (M700 13.12), as parameters and the newest block say.
struct InterruptSettings {
  bool by_level, type_2;
  uint32_t mode;  ///< nc_interrupt_bits
};

/// Handle with the interpreter in arena memory.
class PartInterpreter {
 public:
  /// Lays the interpreter out in `arena`. With a measuring arena only counts.
  void create(const InterpreterConfig& config, ProgramStore* store, CommonVariables* common, Arena& arena);

  // ---- the stream: items that have been made and not been taken
  ItemQueue& queue() { return *queue_; }
  const ItemQueue& queue() const { return *queue_; }
  /// The queue's front; where it is empty more items are made first. NC_OK, or why there is none: NC_WAITING (a sync is open), NC_BUDGET,
  /// NC_ENDED, NC_ALARMED.
  nc_status next(uint32_t& budget, Item** front) {
    *front = queue_->front();
    return *front != nullptr ? NC_OK : make_more(budget, front);
  }
  void answer(const nc_world& world);
  /// A fixed cycle is under way: items of its block are still to be made.
  bool in_cycle() const;
  /// Shows `fits` each move that the cycle has still to make, hole by hole and straight to the bottom, until it says false. Nothing has
  /// happened afterwards. @return what `fits` has said last.
  bool rehearse_cycle(bool (*fits)(void* user, const Item& move), void* user);

  // ---- what items name by a number
  // (none of them while a measuring arena counts)
  const MovePools& pools() const { return pools_; }
  /// False: what has this number is not known any more.
  bool modal(uint32_t id, nc_modal* out) const;
  bool text(uint32_t id, nc_text* out) const;
  /// For tests: what is named by a number is counted from here.
  void count_from(uint32_t first);

  // ---- programs
  /// reset() goes to its head. `mdi`: blocks of MDI, whose end is no alarm.
  void select(const ProgramRef& program, bool mdi);
  bool is_selected() const;
  bool is_mdi() const;
  /// To the head of the selected program; modal state as after reset 2 (M700 3.7). With `keep_modal` (MDI after MDI, M700 5.1) modal codes
  /// and words, work system and tool length stay; cycles and radius compensation do not.
  void reset(bool keep_modal);
  /// What a reset by the operator clears and the end of a program does not.
  void clear_by_reset();
  /// The program is selected, in the call stack now or after a rewind, in a modal call or the interrupt program.
  bool refers_to(unsigned file) const;
  bool ended() const;
  bool alarmed() const;
  /// The block that is read next is read for the machine, else for nc_pull().
  void set_feeding(bool feeding);
  /// Axes that a signal of the machine mirrors in the next program.
  void set_mirror_signal(uint32_t axes);
  void set_switches(uint32_t optional_skip, uint32_t mirror_axes);
  /// Bit i: axis i takes no command now (M700 10.5).
  void set_closed_axes(uint32_t axes);
  /// A function of the vendor's runs: nothing else drives this part system meanwhile.
  bool in_vendor_function() const { return *in_vendor_function_; }
  /// The next block is read again for somebody who wants everything done again: a function of the vendor, too.
  void forget_vendor_call();
  /// The block in hand, and the line of the main program that has called its program.
  const nc_source& source() const;
  uint32_t main_line() const;
  BlockSeq newest_block() const;

  // ---- going back
  /// Back to right behind the block `seq`; false when it is too old.
  bool rewind(BlockSeq seq);
  /// rewind(seq) is possible, and still will be when one more block has been executed.
  bool remembers(BlockSeq seq) const;
  /// Tables, variables and parameters are as block `seq` has left them (back), and again as they were: for a look from outside, without a write.
  void look_back(BlockSeq seq, bool back);

  // ---- positions, machine coordinates
  const AxisVec& machine() const;
  /// The newest block ends here.
  void end_at(const AxisVec& machine);
  /// Forget what has been read; go on from here.
  void set_machine(const AxisVec& machine);
  /// The axes have been moved behind the newest block; whoever goes back there finds them so.
  void move_to(const AxisVec& machine);
  /// All coordinate systems go along with an axis that is moved by hand.
  void shift_coordinates(unsigned axis, double by);
  /// Zero of the workpiece with the tool length as applied.
  AxisVec work_zero() const;
  MapsInForce maps() const;
  /// As the counters show them (M700 14.13).
  AxisVec work_shown(const AxisVec& work) const;
  AxisVec machine_shown(const AxisVec& machine) const;
  AxisSettings axis_settings() const;

  // ---- macro interrupt (M700 13.12)
  InterruptSettings interrupts() const;
  /// The interrupt program runs next, the machine stands at `machine`. Everything made before has happened but for the newest
  /// `taken_back` items, which are given up. Inside a block only with `cut_block`; false: not now.
  bool interrupt(const AxisVec& machine, unsigned taken_back, bool cut_block);
  /// The same on the machine: it has stopped inside the next block, of which `items` have happened. False: the block goes on.
  bool interrupt_inside(const AxisVec& machine, unsigned items);
  /// The next block goes on where it was cut.
  void go_on_inside(unsigned items);
  /// The next block has been cut: it is read again.
  const Repeat& repeat() const;
  /// Head of the block that was interrupted last.
  const AxisVec& interrupted_at() const;

  // ---- alarms
  RaisedAlarm raised() const;
  /// The blocks that led to the alarm, outermost first, up to `capacity`. @return how many.
  unsigned alarm_calls(nc_source* out, unsigned capacity) const;
  void set_alarm_calls(const nc_source* calls, unsigned count);
  /// A stage behind has found a fault: what is queued is void, the alarm and the end take its place.
  void abort(const Fault& what, const nc_source& where);
  /// For abort(), before the blocks from `seq` on are given up: which of them called the program of `where`.
  void note_calls(const nc_source& where, BlockSeq seq);
  /// The blocks that led to `where`, which comes behind block `seq`, outermost first and with it; 0: that is not known any more.
  unsigned calls_behind(const nc_source& where, BlockSeq seq, nc_source (&calls)[NC_MAX_CALLS]) const;

  // ---- tables
  /// What the host reads and writes of them.
  HostTables tables() const { return HostTables(*in_); }
  void join(SharedTables* shared);
  bool shares() const;  ///< there are other part systems
  /// The machine has executed the blocks up to `executed`: what they have written to shared places is published.
  void publish(BlockSeq executed);
  uint64_t state_hash() const;  ///< interpret/state_hash.hpp

 private:
  nc_status make_more(uint32_t& budget, Item** front);

  Interpreter* in_ = nullptr;
  // Of *in_: asked for with every item.
  ItemQueue* queue_ = nullptr;
  MovePools pools_;
  const bool* in_vendor_function_ = nullptr;
};

}  // namespace nc
