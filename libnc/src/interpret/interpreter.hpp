// SPDX-License-Identifier: Apache-2.0
// The interpreter of one part system: reads a block, works out what it means, puts items into the stream.
//
//   context.cpp           what functions work with, and all that they see of this (context.hpp)
//   interpreter.cpp       the loop: next block, jobs that go over several calls, checkpoints, rewind, reset
//   read_command.cpp      the command of a block (command/), units and decimal point rules of its numbers
//   execute_block.cpp     the order in which the words of one block act
//   plain_line.cpp        the same for a line in absolute millimetres, in short
//   functions/*.cpp       what the one-shot and modal functions do, one handler per Function (functions.hpp is the table)
//   motion.cpp, arc.cpp   moves
//   program_control.cpp   M codes behind the moves of their block: which call, return, end
//   flow.cpp              GOTO, WHILE, M98/M99, the ends of programs
//   macro_call.cpp        G65, G66, G66.1, G67
//   interrupt.cpp         M96, M97 and the interrupt program
//   mdi_interrupt.cpp     blocks of MDI in a block stop
//   code_call.cpp         G M S T B and ASCII codes that call programs
//   system_variables.cpp  #1000 and up
#pragma once

#include "interpret/by_hand.hpp"
#include "interpret/context.hpp"
#include "interpret/lifetimes.hpp"
#include "interpret/part_interpreter.hpp"

namespace nc {

struct Caller;

/// What led to an alarm, noted when the block is given up.
struct AlarmStory {
  nc_text cause{};        ///< a further sentence about the alarm; "" = none
  bool instead = false;   ///< that sentence replaces the one that the fault gives
  uint8_t count = 0;      ///< number of `calls`
  nc_source calls[kMaxFrames]{};  ///< the blocks that led to the alarm, outermost first; the last one is the block of the alarm
};

struct Interpreter : BlockContext {
  void create(const InterpreterConfig& config, ProgramStore* store, CommonVariables* common, Arena& arena);

  /// Number of old values that are kept: a few for each block that is read ahead, and enough for a block that writes many.
  static unsigned journal_capacity(unsigned look_ahead);

  // ---- the stream ---------------------------------------------------------------------------------------------------
  /// Makes more items. NC_OK: they are in `queue`; NC_WAITING: a sync is open; NC_BUDGET, NC_ENDED, NC_ALARMED.
  nc_status step(uint32_t& budget);
  void answer(const nc_world& world);

  // ---- programs -----------------------------------------------------------------------------------------------------
  /// Goes to the beginning of the selected program; the modal state becomes that of reset 2 (M700 3.7).
  void reset() { reset(false); }
  /// With `keep_modal` (MDI after MDI, M700 5.1) modal codes and words, work system and tool length stay; cycles and radius
  /// compensation do not.
  void reset(bool keep_modal);
  /// Clears what a reset by the operator clears and the end of a program does not: what the end has left in force, and, where a parameter says so, #100
  /// to #199 (M700 13.4, #1128 RstVC1).
  void clear_by_reset();
  /// HX 2.3.4, where a parameter says so: the resets to come go to the block behind the newest one, not to the head of the program, and leave its modes in
  /// force (program_restart.cpp). `stands` is false where the newest block is not the last one that the machine has executed: the place is forgotten.
  void keep_place(bool stands);
  void forget_place() { place_.kept = false; }
  /// interpret/coordinates_left.cpp: what outlives programs of the coordinate systems beside the tables of offsets (nc/restart.h).
  nc_restart_coordinates coordinates() const;
  const nc_restart_coordinates& begun_with() const { return begun_with_; }
  void set_coordinates(const nc_restart_coordinates& left);
  /// The next block begins at such a place, and the axes do not stand where the block before it has led them.
  bool begins_inside() const { return state.seq == 0 && place_.kept && !(state.machine == place_.machine); }
  /// Where the axes stood at the beginning of that block.
  const AxisVec& began_at() const { return place_.machine; }
  /// The next block is read again and has to be executed anew as a whole: also its vendor's function is called again.
  void forget_vendor_call() { vendor_call_ = {}; }
  /// Whether the vendor's function of the block in hand has been called already; and notes that it has.
  bool vendor_called() const { return vendor_call_.known && vendor_call_.seq == state.seq && vendor_call_.begin == block->begin && vendor_call_.file == source.file; }
  void note_vendor_call() { vendor_call_ = {true, source.file, block->begin, state.seq}; }
  /// Back to right behind the block `seq`; false when it is too old.
  bool rewind(BlockSeq seq);
  /// If `back` is true, tables, variables and parameters get the values that they had after block `seq`, so that they can be read from outside. If it is
  /// false, they get their present values again. Nothing may be written in between.
  void look_back(BlockSeq seq, bool back) { variables.swap(seq, back, this, exchange); }
  /// The program is selected, is in the call stack (now, or after a rewind), or is the program of a modal call or of the macro interrupt.
  bool refers_to(unsigned file) const;
  /// rewind(seq) is possible, and will still be possible when one more block has been executed.
  bool remembers(BlockSeq seq) const { return checkpoints_.keeps(seq) && variables.keeps(seq); }
  /// Forgets the checkpoints and goes on from this position of the machine.
  void set_machine(const AxisVec& machine);
  /// The axes have been moved by hand behind the newest block; a rewind to that block finds them at `machine`, too. `beside`: how far that is beside the
  /// programmed end of the block.
  void move_to(const AxisVec& machine, const AxisVec& beside) {
    state.machine = machine;
    displace_compensated(beside);
    note_way_by_hand(*this, beside);
    moved_by_hand();
    keep_state();
  }
  /// The handle has been turned by `way` since the newest block: the length along the tool changes from the next block on (M700 12.3). A rewind to that block
  /// finds it changed, too. False: there is none now, or the amount would be out of the range of an offset, and nothing has changed.
  bool add_by_handle(double way);
  /// These axes have come to their reference positions by hand, behind the newest block. A rewind to that block finds it so, too.
  void returned_by_hand(uint32_t axes);
  /// Where the axes are that stand beside the program by a vector in space, and how far that is in machine coordinates.
  AxisVec stands_at() const;
  AxisVec beside_by(const SpaceVector& vector) const;
  /// Moves all coordinate systems along with an axis that was moved by hand.
  void shift_coordinates(unsigned axis, double by);
  /// Macro interrupt (M700 13.12): an interrupt signal would be accepted.
  bool interruptible() const;
  /// Makes the interrupt program run next; the machine stands at `machine`. Everything made so far has been executed, except the newest `taken_back` items,
  /// which are given up. Inside a block it is done only with `cut_block`. False: it is not possible now.
  bool interrupt(const AxisVec& machine, unsigned taken_back, bool cut_block);
  /// Online: the machine has stopped inside the next block, of which it has executed `items` items. False: no interrupt is accepted any more, and the block
  /// goes on.
  bool interrupt_inside(const AxisVec& machine, unsigned items);
  /// Whether blocks of MDI may interrupt the program behind block `seq`, which the machine has executed (mdi_interrupt.cpp).
  bool at_line(unsigned file, uint32_t line, nc_source* at) const;
  bool takes_mdi(BlockSeq seq) const;
  /// These blocks of MDI run next; the program goes on behind them. Everything made so far has been executed.
  void enter_mdi(const ProgramRef& blocks);
  /// The blocks of MDI that interrupt a program have ended: the program, in which they were entered, goes on with the next start.
  Execution leave_mdi();
  /// A place in the program is looked for, and nothing of what is read comes to the machine; given up, what neither a program nor a reset ends, as the tool in the
  /// spindle, is again what it was.
  void begin_search();
  void give_up_search() { static_cast<UntilPowerOff&>(state) = before_search_; }
  /// The program is begun inside, behind block `seq` (nc/restart.h): what blocks of MDI change of its modes there is put back behind them.
  void begin_inside(BlockSeq seq);
  /// The machine has gone on from that place, and the operator has confirmed it: it has what the program has given out on the way.
  void machine_has_followed() { machine_followed_ = true; }
  /// The next block goes on where it was cut (State::repeat).
  void go_on_inside(unsigned items) {
    note_world();
    if (!state.repeat.active) state.repeat = Repeat{};
    state.repeat.active = true;
    state.repeat.items = static_cast<uint16_t>(state.repeat.items + items);
    know_world_again();
  }
  /// A block that goes on where it was cut gets the same answers of syncs as before.
  void know_world_again() {
    if (!state.repeat.active || !interrupted_.world_known) return;
    world = interrupted_.world;
    world_fresh = true;
    answered_ = state.seq;
    if (!interrupted_.vendor_call.known) return;
    vendor_call_ = interrupted_.vendor_call;
    vendor_call_.seq = state.seq;
  }
  /// The modal state at the interrupt (#4401...).
  const ModalState& interrupted_modal() const { return interrupted_.state.modal; }
  /// The state to which the interrupt program returns, or to which the last one has returned.
  const StateValues& interrupted_state() const { return interrupted_.state; }
  void leave_interrupt(bool to_sequence);
  /// A stage behind the interpreter has found a fault: the queued items are given up, and the alarm and the end take their place.
  void abort(const Fault& what, const nc_source& where);
  /// To be called before abort(), while the blocks from `seq` on are still known: notes which of them have called the program of `where`.
  void note_calls(const nc_source& where, BlockSeq seq);
  /// The blocks that led to the block `where`, which comes after block `seq`: outermost first, `where` itself last. Returns their number; 0: they are not
  /// known any more.
  unsigned calls_behind(const nc_source& where, BlockSeq seq, nc_source (&calls)[kMaxFrames]) const;
  /// The host writes to the table of frames: no rewind brings the old value back.
  void set_table_from_outside(unsigned key, double value);

  // ---- for the files of this room that get the whole interpreter -----------------------------------------------------
  using BlockContext::begins_again, BlockContext::ended, BlockContext::modals, BlockContext::motion_settings, BlockContext::queue, BlockContext::texts;
  using BlockInHand::code_calls, BlockInHand::codes_call, BlockInHand::sync_needed, BlockInHand::vendor;
  using InForce::shared;

  struct {
    nc_device_read read = nullptr;
    void* user = nullptr;
  } devices;                       ///< reads devices of the PLC (#100110)
  CommonVariables* common = nullptr;
  ProgramStore* store = nullptr;
  /// For tests: all numbers that name something are counted from `first`.
  void count_from(uint32_t first) {
    transforms.count_from(first);
    modals.count_from(first);
    texts.count_from(first);
    shapes.count_from(first);
    points.count_from(first);
    stroke_boxes.count_from(first);
    motion_settings.count_from(first);
    settings_of_moves_stale_ = true;
  }
  ProgramRef main_program;
  uint8_t mirror_switch = 0;       ///< axes that the next program is mirrored in
  uint8_t mirror_signal = 0;       ///< the same by the signals of the machine when it was started

  Fault alarm_fault;
  nc_source alarm_source{};
  AlarmStory alarm_story;
  uint32_t last_line = 1;          ///< line of the last block read
  uint32_t user_alarm_text = 0;    ///< id of the text of the last #3000
  nc_alarm vendor_alarm{};         ///< alarm of the last vendor's function that has failed
  bool in_vendor_function = false; ///< a vendor's function is running: calls that drive this part system are refused meanwhile
  bool feeding = false;            ///< blocks are read for the machine (nc_feed()), not for nc_pull()

  // the block in hand
  unsigned statement = 0;          ///< next macro statement of the block
  bool alarmed = false;            ///< the program has ended with an alarm
  bool modal_kept = false;         ///< the block in hand has not changed the modal state
  bool block_starts_incremental = false; ///< G91 was modal before this block
  bool distance_by_word = false;         ///< for an axis word the G90/G91 before it in the block counts (M700 5.1)
  bool jumped = false;             ///< a statement has jumped, so the statements behind it in the block are not executed
  Block* rewritten = nullptr;      ///< copy of the block in hand without the code that calls a program
  const CodeCall* after_block = nullptr; ///< the call to be made when the block in hand has been executed

  /// Makes everything that follows from the groups of the state anew, after they have been assigned.
  void start_maps(ProgramMaps* maps);
  void start_stroke_check();
  void refresh_derived();

 private:
  /// A block whose vendor's function has been called.
  struct VendorCall {
    bool known = false;
    uint16_t file = 0;
    uint64_t begin = 0;
    BlockSeq seq = 0;            ///< number of the block before it
  };
  /// What is kept for the return from an interrupt program.
  struct InterruptReturn {
    StateValues state;           ///< the state at the beginning of the interrupted block, or behind the block before the interrupt
    unsigned items = 0;          ///< number of items of that block that have been executed
    bool inside_block = false;
    VendorCall vendor_call;      ///< vendor's function of the interrupted block: it is not called again when the block goes on
    bool world_known = false;    ///< the interrupted block has read `world`, and reads the same when it goes on
    nc_world world{};
    ProgramMaps maps;            ///< centres and factors of the maps that are in force in `state`
  };
  /// A place at which the program is begun inside, and what it comes there with.
  struct BegunInside {
    bool kept = false;
    BlockSeq seq = 0;        ///< the newest block in front of it, the blocks of MDI there included
    StateValues state;
    ProgramMaps maps;        ///< centres and factors of the maps that are in force in `state`
    uint64_t tables = 0;     ///< tables_hash()
  };
  void bring_there();
  void put_back_modes();
  void take_machine_truth();
  /// Where a reset goes back to, in place of the head of the program.
  struct Place {
    bool kept = false;
    bool head = false;  ///< it is the head of the program, of which nothing has been executed
    AxisVec machine;  ///< where the block in front of it has led the axes
    CallStack stack;
  };
  bool may_begin_here() const;
  Execution enter_interrupt();
  /// Called at the beginning of a block that is going to be cut: notes the answers that it has.
  void note_world() {
    interrupted_.world_known = answered_ == state.seq;
    interrupted_.world = world;
    note_block_call();
  }
  InitialValues initial_values() const;
  void note_block_call() { interrupted_.vendor_call = vendor_call_.known && vendor_call_.seq == state.seq ? vendor_call_ : VendorCall{}; }
  /// The program that runs is the place of what is made from now on; its line is not known yet.
  void place_in_program() {
    const CallFrame& frame = state.frame[state.depth];
    source.system = system_index;
    source.depth = state.depth;
    source.file = frame.program.file;
    source.program = frame.program.number;
    aside = state.depth != 0 && goes_aside();
  }
  /// The program that runs, or one that led to it, is an interrupt program or a text of MDI that interrupts.
  bool goes_aside() const {
    for (unsigned level = 1; level <= state.depth; ++level)
      if (state.frame[level].origin == CallOrigin::interrupt || state.frame[level].origin == CallOrigin::mdi) return true;
    return false;
  }
  void place_at_next_block();
  void finish_call();
  bool begin_interrupt(bool inside_block, unsigned items, const AxisVec& machine);
  void restore_modal();
  void moved_by_hand();
  void displace_compensated(const AxisVec& beside);

  nc_status run_block(uint32_t& budget);
  bool enter_block(CallFrame& frame, nc_status* status);
  void note_last_block(CallFrame& frame) const;
  nc_status settle(Execution did);
  void stop(const Fault& what, const nc_source& where);
  void note_calls(const nc_source& where, const CallFrame* levels);
  static unsigned calls_of(const nc_source& where, const CallFrame* levels, nc_source (&calls)[kMaxFrames]);
  void take_block_back();
  void forget_block();
  Execution execute_statements();
  bool skipped(const Block& b) const;

  bool waiting_ = false;
  uint32_t waiting_for_ = 0;
  bool take_back(BlockSeq seq);
  static void undo(void* self, uint32_t key, JournalValue old);
  static JournalValue exchange(void* self, uint32_t key, JournalValue value);
  unsigned made_ = 0;          ///< number of items of the block in hand so far
  BlockSeq block_seq_ = 0;     ///< number of the block before it
  InterruptReturn interrupted_;
  BegunInside begun_inside_;
  UntilPowerOff before_search_;
  bool machine_followed_ = false;  ///< State::machine_has is outdated
  Place place_;
  VendorCall vendor_call_;       ///< newest block whose vendor's function has been called; when the block is read again the function is not called again
  BlockSeq answered_ = ~BlockSeq{0};  ///< number of the block before the one that the newest answer of a sync was for
  nc_restart_coordinates begun_with_{};  ///< coordinates() when the program that is read was begun
};

/// interpret/program_restart.cpp: a block whose words have been read and that begins in its middle, or the alarm that it cannot begin there.
Execution execute_begun_inside(Interpreter& in);
/// interpret/execute_block.cpp: a block of words; and what is left to do of it where they have been read.
Execution execute_words(Interpreter& in);
Execution execute_read_words(Interpreter& in);
/// interpret/plain_line.cpp: executes a straight line in absolute millimetres. False: nothing has been done, and the block needs execute_words().
bool execute_plain_line(Interpreter& in);
/// Applies the G codes of in.words that decide how other words are read.
Execution apply_reading_modes(Interpreter& in);
/// Goes on with a block that has returned Execution::later.
Execution continue_block(Interpreter& in);

/// interpret/flow.cpp
Execution execute_statement(Interpreter& in, const Statement& statement);
Execution call_sub(Interpreter& in);          ///< M98
Execution return_sub(Interpreter& in);        ///< M99
Execution call_external(Interpreter& in);     ///< M198
Execution check_loops_closed(Interpreter& in);  ///< at the end of a program: a DO without END is P294
Execution text_ended(Interpreter& in);        ///< the end of the text, or '%'
void leave_program(Interpreter& in);          ///< the program in hand has ended: the one that has called it goes on
/// The program in hand is a text that is read from its beginning: the main program, or blocks of MDI that interrupt it.
inline bool is_text_of_its_own(const Interpreter& in) { return in.state.depth == 0 || in.state.frame[in.state.depth].origin == CallOrigin::mdi; }
/// The program in hand is blocks of MDI, whether a program is interrupted by them or not.
inline bool in_mdi(const Interpreter& in) { return in.state.depth == 0 ? in.mdi : in.state.frame[in.state.depth].origin == CallOrigin::mdi; }
Execution return_behind_last(Interpreter& in);  ///< the last block of a pass has been run: as M99

/// interpret/program_control.cpp: what the M codes of the block do behind its moves: stops, ends, calls.
Execution codes_behind(Interpreter& in);

/// interpret/macro_call.cpp
Execution call_macro(Interpreter& in);           ///< G65, G66, G66.1
Execution call_with_block(Interpreter& in);      ///< a block in the mode of G66.1
bool modal_call_takes_blocks(const Interpreter& in);
void cancel_modal_call(Interpreter& in);      ///< G67

/// interpret/execute_block.cpp: a fixed cycle is in force behind the block that has been read.
bool cycle_goes_on(const BlockInHand& in);

/// interpret/code_call.cpp
/// Handles a block that may hold a registered code. *taken: the call has been made, and all words of the block belong to it.
Execution dispatch_block(Interpreter& in, bool* taken);
/// interpret/vendor_call.cpp: a code of the vendor calls a function. Calls it when everything before has been executed.
Execution call_vendor(Interpreter& in, const Caller& caller);
/// G66.1 is in force, and the words of this block (in.words) are its arguments.
bool block_is_argument(const Interpreter& in);
/// Makes the call that comes after a block: that of a code that calls as M98 does, or the modal call after a move.
Execution call_behind_block(Interpreter& in);
/// Executes M, S and T that come behind the motion, and the call of a code among them, but no modal call.
Execution execute_behind_motion(Interpreter& in);
/// The block moves under a modal call (G66), and also calls a program or returns from its own.
bool goes_on_elsewhere(const Interpreter& in);
Execution make_modal_call_first(Interpreter& in);

/// interpret/interrupt.cpp
Execution enable_interrupt(Interpreter& in);
Execution disable_interrupt(Interpreter& in);

/// interpret/alarm_cause.cpp: notes why the block in hand has raised Interpreter::fault, where the fault itself does not say it.
void note_cause(Interpreter& in);

/// interpret/system_variables.cpp
Eval read_system_variable(Interpreter& in, uint32_t number, Value* value, Fault* fault, uint32_t* sync);
Execution write_system_variable(Interpreter& in, uint32_t number, Value value, const Statement& statement);
/// print.cpp: finds the variable to which SETVN has given this name.
bool find_variable_name(void* self, const char* name, size_t length, uint32_t* number);
/// The reader of all variables, for evaluate().
VariableReader variable_reader(Interpreter& in);
EvalOptions eval_options(const Interpreter& in);

}  // namespace nc
