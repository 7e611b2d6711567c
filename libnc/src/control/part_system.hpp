// SPDX-License-Identifier: Apache-2.0
// One part system: interpreter, stages, commit and executor in a row, and the two ways to drive them (pull, feed).
#pragma once

#include "control/commit.hpp"
#include "control/restart_search.hpp"
#include "interpolate/executor.hpp"
#include "interpolate/run_word.hpp"
#include "interpret/part_interpreter.hpp"
#include "interpret/shared_tables.hpp"
#include "stream/interrupt_rest.hpp"

namespace nc {

class PartSystem {
 public:
  /// What the part systems of a control share.
  struct Shared {
    ProgramStore* store;
    CommonVariables* common;
    const VendorCodes* vendor;
  };
  void create(const nc_config& config, unsigned index, const Dialect& dialect, const Shared& shared, Arena& arena);
  /// Where there are several part systems: tells this one of all `count` of them, after create() of each.
  void join(PartSystem* systems, unsigned count, SharedTables* shared) {
    systems_ = systems;
    system_count_ = count;
    interpreter.join(shared);
  }
  /// Makes what the machine has executed in each part system known to the others, in the order of execution. It is called before blocks are read.
  void publish_all() {
    if (system_count_ != 0) publish_systems();
  }

  /// `mdi`: MDI blocks, which go on with the modal state that the MDI blocks before them have left.
  nc_status select(const ProgramRef& program, bool mdi = false);
  /// A program stands in a block stop, in which blocks of MDI may interrupt it (M700 12.4.4). `take_mdi()`: the next start executes them; an invalid program
  /// takes back what waits.
  bool may_take_mdi();
  void take_mdi(const ProgramRef& blocks);
  nc_status reset();
  nc_status pull(uint32_t budget, nc_item* item);
  /// The same, but passes over moves and the marks behind them inside a block (nc_pull_past()).
  nc_status pull_past(uint32_t budget, nc_passed* passed, nc_item* item);
  nc_status move_point(double share, nc_axes* machine) const;
  nc_status move_zero(nc_axes* zero) const;
  nc_status move_side(nc_side* side, uint8_t plane_axis[2]) const;
  nc_status answer(const nc_world& world);
  nc_world at_end_of_what_is_read(const nc_world& world) const;
  nc_status rewind(Serial serial);
  /// Offline: the level of the interrupt signal (M700 13.12). *take_back becomes true when the item pulled last must not be executed. Where set_position()
  /// has said behind that item where the axes stand, it has been executed up to there.
  nc_status interrupt_signal(bool on, bool* take_back);
  nc_status feed(uint32_t budget);
  // restart.cpp: a program that is begun inside (nc/restart.h)
  nc_status restart_begin(const nc_restart_place& place, const nc_world& world);
  nc_status restart_find(uint32_t budget, nc_restart_found* found);
  nc_status restart_cancel();
  void forget_restart() { search_.forget(); }
  void outdate_restart() { search_.outdate(); }
  /// A place is looked for, or found.
  bool has_search() const { return search_.phase() != RestartSearch::Phase::none; }
  /// A place is found, and a start would begin there now.
  bool has_place() const { return search_.phase() == RestartSearch::Phase::found && !search_.outdated() && search_.goes_on_in(interpreter.state_hash()); }
  void searched_beside(bool begins) { search_.searched_beside(interpreter.state_hash(), begins); }
  /// A unit of the budget, and an item that is committed without a new block, in instructions of a processor (nc_feed()).
  static constexpr int64_t kUnit = 20000, kItem = 2500;
  /// To the scan, which has to know them before anything is moved by hand; nothing while they are as before.
  void count_tool_life();  // life_count.cpp
  void tell_axis_parameters();
  nc_status recalculate();
  /// For tests of counters that have run for years (docs/counters.md). To be called right after create().
  void count_from(uint32_t first);
  void set_position(const AxisVec& machine);
  /// The block that waits for the answer to a sync, and the line of the main program that it belongs to; false: no block waits.
  bool sync_place(nc_source* source, uint32_t* main_line) const;
  uint32_t main_line(const nc_source& source) const { return source.depth == 0 ? source.line : interpreter.main_line(); }
  /// Online: `watch` is shown each item before it is committed, and may put it off.
  void watch_commits(nc_commit_watch to_call, void* user) {
    commit_watch_ = to_call;
    commit_watch_user_ = user;
  }
  /// A program is in execution or interrupted, as far as the feeder knows yet, or a function of the vendor is running: nothing may be changed from
  /// outside then.
  bool busy() const { return (online_ && run_.active()) || interpreter.in_vendor_function(); }
  /// busy(), after the feeder has taken notice of what the scan has done.
  bool occupied() {
    follow_run();
    return busy();
  }
  /// The newest block that the machine has executed; where there are several part systems, the newest that publish_all() has published. False: the
  /// machine has executed all blocks that were read.
  bool executed_block(BlockSeq* seq) const {
    if (busy()) *seq = system_count_ != 0 ? published_ : executor.last_block();
    return busy();
  }
  /// The alarm in words: one whose item has been given out, or one of the scan, which has no item. False = there is none.
  bool alarm(nc_alarm* out) const;
  unsigned alarm_calls(nc_source* out, unsigned capacity) const;

  PartInterpreter interpreter;
  Executor executor;

 private:
  PartSystem* first_executed(uint32_t until, BlockSeq* seq);
  void publish_answered();
  void note_answered();
  /// Next item in stream order behind the stages; NC_OK, or why there is none. take() removes it.
  nc_status next(uint32_t& budget, const Item** item);
  /// Takes the next item, commits it and gives it to the caller, nc_pull() or nc_feed(). NC_OK with nullptr: work was done but gave no item; call again.
  nc_status pump(uint32_t& budget, const Item** item);
  void take();
  void begin_wanted_interrupt();
  void give(const Item& item, nc_item* out);
  bool passes(const Item& item, bool behind_move) const;
  void count_passed(const Item& item, nc_passed* passed);
  void note_passed(const Item& item, const Item* move, nc_passed* passed);
  struct Row;
  nc_status pass_row(uint32_t& budget, uint64_t before, nc_passed* passed);
  bool pop_held(Item& out) { return stages_.pop(out); }
  // What follows after an item has been given out.
  void note_mark(const Item& mark);
  void note_given(const Item& item);
  void note_interrupt_mode(const Item& item);
  // look_ahead.cpp
  nc_status look_ahead(uint32_t& budget);
  nc_status gather_block(uint32_t& budget);
  bool try_item(const Item& item, Committed* committed);
  bool block_fits();
  bool cycle_fits(Committed* committed);
  bool staged_fits();
  bool goes_to_stage() const;
  /// The item must not be given out before its whole block has been checked.
  bool wants_look_ahead(const Item& item) const {
    return item.kind == ItemKind::action && item.action.kind <= NC_ACTION_B && looked_behind_ != newest_mark();
  }
  Serial newest_mark() const { return commit_.newest() != nullptr ? commit_.newest()->serial : 0; }
  void clear_staged() {
    staged_count_ = 0;
    gathering_ = false;
    looked_behind_ = kNowhere;
  }
  Named named(const Item& item) const {
    if (item.kind != ItemKind::move) return {};
    const Move& move = item.move;
    return {&(*interpreter.pools().transforms)[move.transform], move.shape != 0 ? &(*interpreter.pools().shapes)[move.shape - 1] : nullptr,
            &(*interpreter.pools().motion_settings)[move.settings]};
  }
  void remember_mark(const Item& mark) {
    if (mark.mark.place == 0) return commit_.remember(mark);
    commit_.remember(mark, stages_.behind(mark.mark));
  }
  void publish_systems();
  Fault refused(Committed committed) const;
  void stop_on(const Fault& fault, const nc_source& source);
  void describe_alarm();
  void put_fault(const Fault& fault, const nc_source& source, nc_alarm* out) const;
  unsigned stop_calls(nc_source (&calls)[NC_MAX_CALLS]) const;
  void restart(const AxisVec& machine, bool keep_modal = false);
  /// What the search for a place has come to: an item that it has passed, or the place, whose first item stays. NC_BUDGET and others: neither.
  struct Passed {
    nc_status status = NC_OK;
    ItemKind kind = ItemKind::mark;
    bool reached = false;
    nc_source source{};
  };
  Passed pass_item(uint32_t& budget);
  bool at_place(Passed* passed);
  nc_status find_sequence();
  void answer_search();
  nc_status give_up_search(nc_status status);
  void forget_search();
  bool begin_found();
  void follow_run();
  void read_on(int64_t* left);
  nc_status feed_program(int64_t left);
  nc_status commit_online(uint32_t& budget);
  bool may_read_on();
  bool put_off(const Item& item);
  static bool stops(const Gate& gate) { return gate.kind == NC_GATE_STOP || gate.kind == NC_GATE_OPTIONAL_STOP; }
  bool read_again(Serial last);
  void displace_contour(const AxisVec& by_hand);
  void displace(const AxisVec& machine, const AxisVec& left_at, const AxisVec& shift);
  void add_by_handle(double way);
  void take_returned();
  void take_spindle_axes(const nc_world& world);
  bool begin_interrupt();
  void forget_mdi();
  /// Offline: an interrupt signal would be accepted after the items that have been given out; what has been read beyond them does not count.
  bool interruptible() const { return (uit_mode_ & (NC_INTERRUPT_ENABLED | NC_INTERRUPT_IN_SERVICE)) == NC_INTERRUPT_ENABLED && pulled_ < ItemKind::alarm; }
  bool interrupt_between();
  void drop_repeated(const Repeat& repeat, const AxisVec& head);
  void interrupt_online();
  bool drops(const Item& item);
  void resume_record(Record& record);
  bool takes_time(ItemKind kind) const { return kind == ItemKind::move || kind == ItemKind::gate; }
  bool cut_within() const;
  /// Offline: where the axes stand, as far as it is known.
  const AxisVec& standing() const { return is_amid_ ? amid_ : commit_.machine(); }
  void forget_interrupt() {
    uit_pending_ = is_amid_ = false;
    pulled_ = ItemKind::mark;
    drop_ = 0;
    resumes_ = false;
    watch();
  }

  const Dialect* dialect_ = nullptr;
  const nc_system_config* system_ = nullptr;
  unsigned axis_count_ = 0;
  uint32_t rotary_ = 0;            ///< bit i: axis i is rotary
  PartSystem* systems_ = nullptr;  ///< the array of all part systems of the control; null where this is the only one
  unsigned system_count_ = 0;
  bool beside_ = false;            ///< offline: of the newest mark (Mark::beside)
  BlockSeq answered_block_ = 0;    ///< the next block acts where the machine stands, and has this number; 0 = it does not
  BlockSeq published_ = 0;         ///< online: newest block of this run that is known to the other part systems
  Stages stages_;
  Commit commit_;
  nc_alarm alarm_{};
  bool alarm_given_ = false;
  /// Items that the stages have given out: only the next one, or all items of a block that begins with M, S, T or B.
  static constexpr unsigned kStaged = 32;
  Item* staged_ = nullptr;  ///< kStaged
  unsigned staged_head_ = 0, staged_count_ = 0;
  bool gathering_ = false;   ///< the items of such a block are being fetched, and its end has not come yet
  int64_t* shape_left_ = nullptr;  ///< instructions that are left for the table of a curve, which may be made in the next calls, too; nullptr: no end
  bool shape_waits_ = false;       ///< the item in front waits for its table
  bool from_stage_ = false;  ///< the item next() gave is one of `staged_`, not the interpreter's front
  static constexpr Serial kNowhere = ~Serial{0};
  Serial looked_behind_ = kNowhere;  ///< the block behind this mark has been checked
  bool online_ = false;      ///< driven by feed()
  /// The round that feed() is in: first blocks are read, so many at most, and then all is planned.
  struct Feeding {
    bool open = false, reading = false;
    bool committed = false;  ///< something
    nc_status status = NC_OK;
    uint32_t blocks = 0;     ///< that may still be read
  };
  static constexpr uint32_t kBlocksOfRound = 1024;
  Feeding feeding_;
  bool optimal_ = false;     ///< time-optimal motion
  RunWord run_;              ///< newest run word that the feeder has acted upon
  nc_commit_watch commit_watch_ = nullptr;
  void* commit_watch_user_ = nullptr;
  Commit::Place before_watched_;  ///< state of commit_ before the item that is shown to commit_watch_
  bool finished_ = false;    ///< the end item has been committed
  void watch() { watched_ = uit_ || uit_pending_ || drop_ != 0; }
  bool watched_ = false;                    ///< uit_, uit_pending_ or drop_ is set: the one question asked with every item
  bool uit_ = false, uit_pending_ = false;  ///< interrupt signal: its level, and a request that waits until it can be accepted
  uint32_t uit_mode_ = 0;                    ///< nc_interrupt_bits after the items given out
  InterruptRest uit_rest_;                   ///< when an interrupt signal that stays on counts again
  ItemKind pulled_ = ItemKind::mark;         ///< kind of the item given out last
  bool pulled_in_hole_ = false;              ///< ... which belongs to a hole (Item::in_hole)
  uint8_t move_kind_ = NC_MOVE_LINE;         ///< nc_move_kind of the move given out last
  bool is_amid_ = false;                     ///< offline: the item given out last has been executed in part ...
  AxisVec amid_;                             ///< ... and the axes stand here
  TransformId move_transform_ = 0;           ///< the map of the move given out last
  double move_offset_ = 0;                   ///< how far to the left of its programmed path it goes, mm
  uint8_t move_plane_axis_[2] = {0, 1};      ///< ... in this plane
  bool move_in_space_ = false;               ///< it has a vector in space
  unsigned drop_ = 0;                        ///< number of items to come that have been executed already, before an interrupt
  bool resumes_ = false;                     ///< online: the item behind these has been executed in part, as cut_ says
  Cut cut_;
  /// M700 9.1: M00 and M01 suspend pre-reading. committed: the gate has been committed, but not yet the end of its block; passed: the end has, too,
  /// and nothing more is read until the machine has executed it.
  enum class Stop : uint8_t { none, committed, passed };
  Stop stop_ = Stop::none;
  ProgramRef mdi_blocks_;    ///< online: blocks of MDI that wait for the start ...
  uint32_t mdi_stop_ = 0;    ///< ... that comes behind this number of starts; 0 = there are none
  AxisParameters told_axes_; ///< online: the axis parameters that the scan has been told
  RestartSearch search_;
  ModalId restart_modal_ = 0;  ///< of the newest mark that the search has passed
  BlockSeq executed_ = 0;    ///< online: newest block that has been executed, as feed() found it
  nc_source sync_source_{};
  Serial open_sync_ = 0;
  Sync sync_{};  ///< the one that has been given last
  uint32_t spindle_axes_ = 0;   ///< bit i: axis i is a spindle as well (M700 10.5)
};

}  // namespace nc
