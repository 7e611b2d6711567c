// SPDX-License-Identifier: Apache-2.0
// The interpreter of one part system as control sees it: control creates it, takes items from it, rewinds it and asks it. The members of an interpreter
// (interpreter.hpp) are not visible outside of this room, so that a change of them does not rebuild control.
#pragma once

#include "alarm/fault.hpp"
#include "base/arena.hpp"
#include "base/intern_pool.hpp"
#include "command/vendor_codes.hpp"
#include "frame/affine.hpp"
#include "frame/frames.hpp"
#include "frame/stroke_box.hpp"
#include "interpret/host_tables.hpp"
#include "interpret/motion_settings.hpp"
#include "nc/control.h"
#include "nc/restart.h"
#include "path/shape.hpp"
#include "program/store.hpp"
#include "stream/item_queue.hpp"

namespace nc {

struct Dialect;
struct Interpreter;
struct StrokeCounter;
class SharedTables;

struct InterpreterConfig {
  const Dialect* dialect = nullptr;
  const nc_system_config* system = nullptr;
  uint8_t system_index = 0;        ///< part system, from 0
  uint32_t look_ahead = 1024;
  uint32_t window_bytes = 65536;
  FramesConfig frames;
  const VendorCodes* vendor = nullptr;
  double longest_filter_ms = 0;    ///< longest mean for which the filters behind interpolation have room, ms
  double retract_overlap = 0;      ///< how far the tool goes beyond the level between two holes of a cycle, mm; 0 = it stops at the level
};

/// The alarm that has ended the program: its fault, and texts that do not follow from the fault.
struct RaisedAlarm {
  const Fault& fault;
  const nc_source& source;
  const char* own_words;    ///< message of the program itself (#3000, M700 13.5.5), "" = none
  const nc_alarm& vendor;   ///< alarm of the last vendor's function that has failed
  const nc_text& cause;     ///< a further sentence about the alarm; "" = none
  bool cause_instead;       ///< that sentence replaces the one that the fault gives
};

/// What the parameters say about the axes. Bit i of a set: axis i.
struct AxisSettings {
  uint32_t index_axes, machine_turn, short_cut, no_reference;
  const double* index_increment;  ///< for each axis, deg
};

/// The tables of what moves name by a number.
struct MovePools {
  const InternPool<Affine>* transforms = nullptr;
  const InternPool<MoveShape>* shapes = nullptr;  ///< Move::shape counts from 1
  const InternPool<MotionSettings>* motion_settings = nullptr;
  const InternPool<StrokeBox>* stroke_boxes = nullptr;
};

/// Maps between programmed coordinates and the axes that are in force behind the newest block.
struct MapsInForce {
  bool mirror;           ///< a mirror image, of whatever kind
  bool other_axes;       ///< moves have a map of axes (cylinder, polar, hypothetical axis)
  uint32_t frozen_axes;  ///< bit i: axis i is held (G07): it is a part of the path but does not move
};

/// Macro interrupt (M700 13.12) by the parameters and the blocks up to the newest.
struct InterruptSettings {
  bool by_level, type_2;
  uint32_t mode;  ///< nc_interrupt_bits
};

/// Handle with the interpreter in arena memory.
class PartInterpreter {
 public:
  /// Lays the interpreter out in `arena`. With a measuring arena only counts.
  void create(const InterpreterConfig& config, ProgramStore* store, CommonVariables* common, Arena& arena);

  // ---- the stream: items that have been made and not yet taken
  ItemQueue& queue() { return *queue_; }
  const ItemQueue& queue() const { return *queue_; }
  /// The first item of the queue; when the queue is empty more items are made first. NC_OK, or why there is none: NC_WAITING (a sync is open),
  /// NC_BUDGET, NC_ENDED, NC_ALARMED.
  nc_status next(uint32_t& budget, Item** front) {
    *front = queue_->front();
    return *front != nullptr ? NC_OK : make_more(budget, front);
  }
  /// Strokes of holes that are made next are told to `counter` where it takes them; nullptr: to nobody.
  void count_strokes(const StrokeCounter* counter) { *stroke_counter_ = counter; }
  void answer(const nc_world& world);
  /// A fixed cycle is under way: items of its block are still to be made.
  bool in_cycle() const;
  /// Calls `fits` for each move that the cycle has still to make, hole by hole and straight to the bottom, until `fits` returns false. Afterwards the
  /// interpreter is as it was before. @return what `fits` has returned last.
  bool rehearse_cycle(bool (*fits)(void* user, const Item& move), void* user);

  // ---- what items name by a number (there is none after a measuring arena has counted)
  const MovePools& pools() const { return pools_; }
  /// False: the snapshot, or the text, with this number is not known any more.
  bool modal(uint32_t id, nc_modal* out) const;
  bool text(uint32_t id, nc_text* out) const;
  /// For tests: all numbers that name something are counted from `first`.
  void count_from(uint32_t first);

  // ---- programs
  /// Selects a program; reset() goes to its beginning. `mdi`: it is a text of MDI, whose end without M02 is not an alarm.
  void select(const ProgramRef& program, bool mdi);
  bool is_selected() const;
  const ProgramRef& selected() const;
  /// The next block is read from this line of the text `file`. False also while anything of the block before is left.
  bool at_line(unsigned file, uint32_t line, nc_source* source) const;
  /// BlockReader::find_sequence(), up to the end of the program.
  bool find_sequence(unsigned file, uint32_t n, uint64_t* offset, uint32_t* line, uint64_t bytes, bool* again, bool from_head);
  bool is_mdi() const;
  /// Goes to the beginning of the selected program; the modal state becomes that of reset 2 (M700 3.7). With `keep_modal` (MDI after MDI, M700 5.1) modal
  /// codes and words, work system and tool length stay; cycles and radius compensation do not.
  void reset(bool keep_modal);
  /// Clears what a reset by the operator clears and the end of a program does not.
  void clear_by_reset();
  /// The resets to come go to the block behind the newest one where a parameter says so; not `stands`: to the head of the program.
  void keep_place(bool stands);
  /// The program is selected, is in the call stack (now, or after a rewind), or is the program of a modal call or of the macro interrupt.
  bool refers_to(unsigned file) const;
  bool ended() const;
  bool alarmed() const;
  /// Sets whether blocks are read for the machine (nc_feed()) or for nc_pull().
  void set_feeding(bool feeding);
  /// Bit i: a signal of the machine mirrors the next program in axis i.
  void set_mirror_signal(uint32_t axes);
  void set_switches(uint32_t optional_skip, uint32_t mirror_axes);
  /// Bit i: axis i takes no command now (M700 10.5).
  void set_closed_axes(uint32_t axes);
  /// A vendor's function is running: calls that drive this part system are refused meanwhile.
  bool in_vendor_function() const { return *in_vendor_function_; }
  /// The next block is read again and has to be executed anew as a whole: also its vendor's function is called again.
  void forget_vendor_call();
  /// Where the block in hand stands; and, where it stands in a called program, the line of the main program that has led to it.
  const nc_source& source() const;
  uint32_t main_line() const;
  BlockSeq newest_block() const;
  /// The answer to a sync is the newest thing that has happened: the next block acts where the machine stands.
  bool stands_at_machine() const;

  // ---- going back
  /// Back to right behind the block `seq`; false when it is too old.
  bool rewind(BlockSeq seq);
  /// rewind(seq) is possible, and will still be possible when one more block has been executed.
  bool remembers(BlockSeq seq) const;
  /// If `back` is true, tables, variables and parameters get the values that they had after block `seq`, so that they can be read from outside. If it is
  /// false, they get their present values again. Nothing may be written in between.
  void look_back(BlockSeq seq, bool back);

  // ---- positions, machine coordinates
  const AxisVec& machine() const;
  /// ... and a radius vector on these axes, as a move maps it to the machine.
  AxisVec beside_end(const uint8_t (&axis)[2], const double (&vector)[2]) const;
  /// Sets where the newest block has ended.
  void end_at(const AxisVec& machine);
  /// Forgets what has been read, and goes on from this position.
  void set_machine(const AxisVec& machine);
  /// The axes have been moved by hand behind the newest block; a rewind to that block finds them at `machine`, too.
  void move_to(const AxisVec& machine, const AxisVec& beside);
  /// The handle changes the length along the tool from the next block on (M700 12.3). False: it does not.
  bool add_by_handle(double way);
  LengthAlongTool along_tool() const;
  /// These axes have come to their reference positions by hand behind the newest block (M700 12.2 (4), 12.3).
  void returned_by_hand(uint32_t axes);
  /// Where the axes are, and the vector in space by which they stand beside machine().
  AxisVec stands_at() const;
  const SpaceVector& vector_in_space() const;
  /// Moves all coordinate systems along with an axis that was moved by hand.
  void shift_coordinates(unsigned axis, double by);
  /// Machine coordinates of the workpiece zero, with the tool length that is applied.
  AxisVec work_zero() const;
  MapsInForce maps() const;
  /// The positions as the counters show them (M700 14.13).
  AxisVec work_shown(const AxisVec& work) const;
  AxisVec machine_shown(const AxisVec& machine) const;
  AxisSettings axis_settings() const;

  // ---- macro interrupt (M700 13.12)
  InterruptSettings interrupts() const;
  /// Makes the interrupt program run next; the machine stands at `machine`. Everything made so far has been executed, except the newest `taken_back` items,
  /// which are given up. Inside a block it is done only with `cut_block`. False: it is not possible now.
  bool interrupt(const AxisVec& machine, unsigned taken_back, bool cut_block);
  /// Online: the machine has stopped inside the next block, of which it has executed `items` items. False: no interrupt is accepted any more, and the block
  /// goes on.
  bool interrupt_inside(const AxisVec& machine, unsigned items);
  /// Whether blocks of MDI may interrupt the program behind block `seq`, which the machine has executed.
  bool takes_mdi(uint64_t seq) const;
  /// These blocks of MDI run next; the program goes on behind them. Everything made so far has been executed.
  void enter_mdi(const ProgramRef& blocks);
  /// What is in force of the coordinate systems behind the newest block (nc/restart.h); what the program was begun with; and what the next one begins with.
  nc_restart_coordinates coordinates() const;
  const nc_restart_coordinates& begun_with() const;
  void set_coordinates(const nc_restart_coordinates& left);
  /// A place in the program is looked for (nc/restart.h), or is not any more.
  void begin_search();
  void give_up_search();
  /// The program is begun inside, behind block `seq`.
  void begin_inside(BlockSeq seq);
  /// The machine has gone on from there.
  void machine_has_followed();
  /// The next block goes on where it was cut.
  void go_on_inside(unsigned items);
  /// Tells whether the next block was cut by an interrupt, and how many of its items have been executed.
  const Repeat& repeat() const;
  /// Machine position at the beginning of the block that was interrupted last.
  const AxisVec& interrupted_at() const;

  // ---- alarms
  RaisedAlarm raised() const;
  /// The blocks that led to the alarm, outermost first, up to `capacity`. @return how many.
  unsigned alarm_calls(nc_source* out, unsigned capacity) const;
  void set_alarm_calls(const nc_source* calls, unsigned count);
  /// A stage behind the interpreter has found a fault: the queued items are given up, and the alarm and the end take their place.
  void abort(const Fault& what, const nc_source& where);
  /// To be called before abort(), while the blocks from `seq` on are still known: notes which of them have called the program of `where`.
  void note_calls(const nc_source& where, BlockSeq seq);
  /// The blocks that led to the block `where`, which comes after block `seq`: outermost first, `where` itself last. Returns their number; 0: they are not
  /// known any more.
  unsigned calls_behind(const nc_source& where, BlockSeq seq, nc_source (&calls)[NC_MAX_CALLS]) const;

  // ---- tables
  /// The tables as the host reads and writes them.
  HostTables tables() const { return HostTables(*in_); }
  void join(SharedTables* shared);
  bool shares() const;  ///< there are other part systems
  /// The machine has executed the blocks up to `executed`: publishes what they have written to places that part systems share.
  void publish(BlockSeq executed);
  uint64_t state_hash() const;  ///< interpret/state_hash.hpp

 private:
  nc_status make_more(uint32_t& budget, Item** front);

  Interpreter* in_ = nullptr;
  // Members of *in_ that are needed with every item.
  ItemQueue* queue_ = nullptr;
  MovePools pools_;
  const StrokeCounter** stroke_counter_ = nullptr;
  const bool* in_vendor_function_ = nullptr;
};

}  // namespace nc
