// SPDX-License-Identifier: Apache-2.0
// The interpreter of one part system: reads a block, works out what it means, puts items into the stream.
//
//   context.cpp           what functions work with, and all that they see of this (context.hpp)
//   interpreter.cpp       the loop: next block, jobs that go over several calls, checkpoints, rewind, reset
//   block_words.cpp       words -> values: expressions, units, decimal point rules of the dialect
//   execute_block.cpp     the order in which the words of one block act
//   plain_line.cpp        the same for a line in absolute millimetres, in short
//   functions/*.cpp       what the one-shot and modal functions do, one handler per Function (functions.hpp is the table)
//   motion.cpp, arc.cpp   moves
//   program_control.cpp   M codes behind the moves of their block: which call, return, end
//   flow.cpp              GOTO, WHILE, M98/M99, the ends of programs
//   macro_call.cpp        G65, G66, G66.1, G67 and their arguments
//   interrupt.cpp         M96, M97 and the interrupt program
//   code_call.cpp         G M S T B and ASCII codes that call programs
//   system_variables.cpp  #1000 and up
#pragma once

#include "interpret/context.hpp"
#include "interpret/lifetimes.hpp"
#include "interpret/part_interpreter.hpp"

namespace nc {

/// What stands behind an alarm, noted when the block is given up.
struct AlarmStory {
  nc_text cause{};        ///< a sentence more than the fault has; "" = none
  bool instead = false;   ///< it says all that there is to say
  uint8_t count = 0;      ///< of calls
  nc_source calls[kMaxFrames]{};  ///< the blocks that led there, outermost first, the last one that of the alarm
};

struct Interpreter : BlockContext {
  void create(const InterpreterConfig& config, ProgramStore* store, CommonVariables* common, Arena& arena);

  /// How many old values are kept: a few of each block that is read ahead, and all of a block that writes many.
  static unsigned journal_capacity(unsigned look_ahead);

  // ---- the stream ---------------------------------------------------------------------------------------------------
  /// Makes more items: NC_OK (look at `queue`), NC_WAITING (a sync is open), NC_BUDGET, NC_ENDED, NC_ALARMED.
  nc_status step(uint32_t& budget);
  void answer(const nc_world& world);

  // ---- programs -----------------------------------------------------------------------------------------------------
  /// To the head of the selected program; modal state as after reset 2 (M700 3.7).
  void reset() { reset(false); }
  /// With `keep_modal` (MDI after MDI, M700 5.1) modal codes and words, work system and tool length stay; cycles and radius
  /// compensation do not.
  void reset(bool keep_modal);
  /// What a reset by the operator clears and the end of a program does not: what the end has left in force, and by parameter #100 to
  /// #199 (M700 13.4, #1128 RstVC1).
  void clear_by_reset();
  /// The next block is read again for somebody who wants everything done again: a function of the vendor, too.
  void forget_vendor_call() { vendor_call_ = {}; }
  /// Whether the vendor's function of the block in hand has been called, and note that it has.
  bool vendor_called() const { return vendor_call_.known && vendor_call_.seq == state.seq && vendor_call_.begin == block->begin && vendor_call_.file == source.file; }
  void note_vendor_call() { vendor_call_ = {true, source.file, block->begin, state.seq}; }
  /// Back to right behind the block `seq`; false when it is too old.
  bool rewind(BlockSeq seq);
  /// Tables, variables and parameters are as block `seq` has left them (back), and again as they were: for a look from outside, without a write.
  void look_back(BlockSeq seq, bool back) { variables.swap(seq, back, this, exchange); }
  /// The program is selected, in the call stack now or after a rewind, in a modal call or the interrupt program.
  bool refers_to(unsigned file) const;
  /// rewind(seq) is possible, and still will be when one more block has been executed.
  bool remembers(BlockSeq seq) const { return checkpoints_.keeps(seq) && variables.keeps(seq); }
  /// Forget checkpoints; go on from here (position of the machine).
  void set_machine(const AxisVec& machine);
  /// The axes have been moved behind the newest block; whoever goes back there finds them so.
  void move_to(const AxisVec& machine) {
    state.machine = machine;
    moved_by_hand();
    checkpoints_.save(state);
  }
  /// All coordinate systems go along with an axis that is moved by hand.
  void shift_coordinates(unsigned axis, double by);
  /// Macro interrupt (M700 13.12): an interrupt signal would be accepted.
  bool interruptible() const;
  /// The interrupt program runs next, the machine stands at `machine`. Everything made before has happened but for the newest
  /// `taken_back` items, which are given up. Inside a block only with `cut_block`; false: not now.
  bool interrupt(const AxisVec& machine, unsigned taken_back, bool cut_block);
  /// The same on the machine: it has stopped inside the next block, of which `items` have happened. False: the block goes on.
  bool interrupt_inside(const AxisVec& machine, unsigned items);
  /// The next block goes on where it was cut (State::repeat).
  void go_on_inside(unsigned items) {
    note_world();
    if (!state.repeat.active) state.repeat = Repeat{};
    state.repeat.active = true;
    state.repeat.items = static_cast<uint16_t>(state.repeat.items + items);
    know_world_again();
  }
  /// A block that goes on where it was cut has the answers that it had.
  void know_world_again() {
    if (!state.repeat.active || !interrupted_.world_known) return;
    world = interrupted_.world;
    world_fresh = true;
    answered_ = state.seq;
    if (!interrupted_.vendor_call.known) return;
    vendor_call_ = interrupted_.vendor_call;
    vendor_call_.seq = state.seq;
  }
  /// Program and modal state at the interrupt (#4401...).
  const ModalState& interrupted_modal() const { return interrupted_.state.modal; }
  /// What the interrupt program goes back to, or what the last one went back to.
  const StateValues& interrupted_state() const { return interrupted_.state; }
  void leave_interrupt(bool to_sequence);
  /// A stage behind has found a fault: what is queued is void, the alarm and the end take its place.
  void abort(const Fault& what, const nc_source& where);
  /// For abort(), before the blocks from `seq` on are given up: which of them called the program of `where`.
  void note_calls(const nc_source& where, BlockSeq seq);
  /// The blocks that led to `where`, which comes behind block `seq`, outermost first and with it; 0: that is not known any more.
  unsigned calls_behind(const nc_source& where, BlockSeq seq, nc_source (&calls)[kMaxFrames]) const;
  /// The host has changed a number of the frames' table: no rewind brings the old one back.
  void set_table_from_outside(unsigned key, double value);

  // ---- for the functions (interpret/ only) --------------------------------------------------------------------------

  struct {
    nc_device_read read = nullptr;
    void* user = nullptr;
  } devices;                       ///< of the PLC (#100110)
  CommonVariables* common = nullptr;
  ProgramStore* store = nullptr;
  /// For tests: what is named by a number is counted from here.
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
  bool mdi = false;                ///< the main program is blocks of MDI: their end is no alarm
  uint8_t mirror_switch = 0;       ///< axes that the next program is mirrored in
  uint8_t mirror_signal = 0;       ///< the same by the signals of the machine when it was started

  Fault alarm_fault;
  nc_source alarm_source{};
  AlarmStory alarm_story;
  uint32_t last_line = 1;          ///< of the last block read
  uint32_t user_alarm_text = 0;    ///< text of the last #3000
  nc_alarm vendor_alarm{};         ///< what the last function of the vendor that failed has said
  bool in_vendor_function = false; ///< one runs: nothing else drives this part system meanwhile
  bool feeding = false;            ///< read for the machine, else for nc_pull()

  // the block in hand
  unsigned statement = 0;          ///< next macro statement of the block
  bool jumped = false;             ///< a statement has sent the program elsewhere: those behind it in the block are not executed
  Block* rewritten = nullptr;      ///< copy of the block in hand without the code that calls a program
  const CodeCall* after_block = nullptr; ///< the program to be called when the block in hand has done its part

  /// Everything that is made of the state's groups, after they have been assigned.
  void refresh_derived();

 private:
  /// A block whose function of the vendor's has been called.
  struct VendorCall {
    bool known = false;
    uint16_t file = 0;
    uint64_t begin = 0;
    BlockSeq seq = 0;            ///< the state before it
  };
  /// What an interrupt program goes back to.
  struct InterruptReturn {
    StateValues state;           ///< at the head of the interrupted block, or behind the block that came before
    unsigned items = 0;          ///< of that block that have happened
    bool inside_block = false;
    VendorCall vendor_call;      ///< of the interrupted block: what it has called is not called again when it goes on
    bool world_known = false;    ///< the interrupted block has read `world`: it reads the same when it goes on
    nc_world world{};
    ProgramMaps maps;            ///< where those of `state` are centred
  };
  Execution enter_interrupt();
  /// At the head of a block that is going to be cut.
  void note_world() {
    interrupted_.world_known = answered_ == state.seq;
    interrupted_.world = world;
    note_block_call();
  }
  InitialValues initial_values() const;
  void note_block_call() { interrupted_.vendor_call = vendor_call_.known && vendor_call_.seq == state.seq ? vendor_call_ : VendorCall{}; }
  bool begin_interrupt(bool inside_block, unsigned items, const AxisVec& machine);
  void restore_modal();
  void moved_by_hand();

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
  unsigned made_ = 0;          ///< items of the block in hand so far
  BlockSeq block_seq_ = 0;     ///< the state before it
  InterruptReturn interrupted_;
  VendorCall vendor_call_;       ///< the newest block whose function of the vendor's has been called: read again, it has been
  BlockSeq answered_ = ~BlockSeq{0};  ///< the state before the block that the newest answer was for
};

/// interpret/execute_block.cpp: a block of words.
Execution execute_words(Interpreter& in);
/// interpret/plain_line.cpp: a straight line in absolute millimetres. False: nothing has been done, the block needs execute_words().
bool execute_plain_line(BlockContext& in);
/// The G codes of in.words that say how other words are read.
Execution apply_reading_modes(Interpreter& in);
/// Goes on with a block that said Execution::later.
Execution continue_block(Interpreter& in);

/// interpret/flow.cpp
Execution execute_statement(Interpreter& in, const Statement& statement);
Execution call_sub(Interpreter& in);          ///< M98
Execution return_sub(Interpreter& in);        ///< M99
Execution call_external(Interpreter& in);     ///< M198
Execution check_loops_closed(Interpreter& in);  ///< at the end of a program: a DO without END is P294
Execution text_ended(Interpreter& in);        ///< the end of the text, or '%'
Execution return_behind_last(Interpreter& in);  ///< the last block of a pass has been run: as M99

/// interpret/program_control.cpp: what the M codes of the block do behind its moves: stops, ends, calls.
Execution codes_behind(Interpreter& in);

/// interpret/macro_call.cpp
Execution call_macro(Interpreter& in);           ///< G65, G66, G66.1
Execution call_with_block(Interpreter& in);      ///< a block in the mode of G66.1
bool modal_call_takes_blocks(const Interpreter& in);
void cancel_modal_call(Interpreter& in);      ///< G67

/// interpret/code_call.cpp
/// A block that may hold a registered code. *taken: the call has been made and takes all the words.
Execution dispatch_block(Interpreter& in, bool* taken);
/// interpret/vendor_call.cpp: word `at` of the block is a code of the vendor's that calls a function; everything before it has happened.
Execution call_vendor(Interpreter& in, unsigned at, const nc_vendor_code& code);
/// G66.1 is in force and takes the words of this block (in.words).
bool block_is_argument(const Interpreter& in);
/// What a block calls behind its own part: a code of type M98, the modal call after a move.
Execution call_behind_block(Interpreter& in);
/// M, S, T that come behind the motion, and the call of a code among them; no modal call.
Execution execute_behind_motion(Interpreter& in);
/// The block moves under a modal call (G66), and calls a program or returns from its own.
bool goes_on_elsewhere(const Interpreter& in);
Execution make_modal_call_first(Interpreter& in);

/// interpret/interrupt.cpp
Execution enable_interrupt(Interpreter& in);
Execution disable_interrupt(Interpreter& in);

/// interpret/alarm_cause.cpp: why the block in hand has raised Interpreter::fault, as far as the fault itself does not say so.
void note_cause(Interpreter& in);

/// interpret/system_variables.cpp
Eval read_system_variable(Interpreter& in, uint32_t number, Value* value, Fault* fault, uint32_t* sync);
Execution write_system_variable(Interpreter& in, uint32_t number, Value value, const Statement& statement);
/// print.cpp: the variable that SETVN has given this name.
bool find_variable_name(void* self, const char* name, size_t length, uint32_t* number);
/// Reader over everything, for evaluate().
VariableReader variable_reader(Interpreter& in);

}  // namespace nc
