// SPDX-License-Identifier: Apache-2.0
// The interpreter of one part system: reads a block, works out what it means, puts items into the stream.
//
//   interpreter.cpp       the loop: next block, jobs that go over several calls, checkpoints, rewind, reset
//   block_words.cpp       words -> values: expressions, units, decimal point rules of the dialect
//   execute_block.cpp     the order in which the words of one block act
//   plain_line.cpp        the same for a line in absolute millimetres, in short
//   functions/*.cpp       what the one-shot and modal functions do, one handler per Function (functions.hpp is the table)
//   motion.cpp, arc.cpp   moves
//   flow.cpp              GOTO, WHILE, M98/M99, the ends of programs
//   macro_call.cpp        G65, G66, G66.1, G67 and their arguments
//   interrupt.cpp         M96, M97 and the interrupt program
//   code_call.cpp         G M S T B and ASCII codes that call programs
//   system_variables.cpp  #1000 and up
#pragma once

#include <cstring>

#include "base/intern_pool.hpp"
#include "dialect/code_index.hpp"
#include "frame/affine.hpp"
#include "frame/frames.hpp"
#include "frame/stroke_box.hpp"
#include "interpret/block_words.hpp"
#include "interpret/checkpoints.hpp"
#include "interpret/code_calls.hpp"
#include "interpret/lifetimes.hpp"
#include "interpret/motion_settings.hpp"
#include "interpret/notes.hpp"
#include "interpret/parameters.hpp"
#include "interpret/program_matrices.hpp"
#include "interpret/state.hpp"
#include "interpret/vendor_codes.hpp"
#include "macro/variables.hpp"
#include "nc/run.h"

namespace nc {

/// Result of executing something.
enum class Execution : uint8_t {
  done,
  fault,   ///< Interpreter::fault says what
  sync,    ///< Interpreter::sync_needed says what is missing; do the same again when it is there
  later    ///< the block goes on at the next call (a cycle, an answer)
};

/// A text under way to the operator.
struct Message {
  nc_text text{};
  bool operator==(const Message& other) const {
    if (text.size != other.text.size) return false;
    return text.size != 0 ? std::memcmp(text.s, other.text.s, text.size) == 0 : std::strcmp(text.s, other.text.s) == 0;
  }
};

/// A point that blocks to come need: of an axis that is held, on the way of an arc in space, a control point.
struct PathPoint {
  AxisVec at;
  double weight = 1, knot = 0;  ///< of a control point
  double feed = 0;              ///< of the block where an arc in space starts, ...
  uint16_t feed_digit = 0;      ///< ... and the digit of its F
  nc_source source{};
  bool operator==(const PathPoint&) const { return false; }  // each is one of its own
};

/// What stands behind an alarm, noted when the block is given up.
struct AlarmStory {
  nc_text cause{};        ///< a sentence more than the fault has; "" = none
  bool instead = false;   ///< it says all that there is to say
  uint8_t count = 0;      ///< of calls
  nc_source calls[kMaxFrames]{};  ///< the blocks that led there, outermost first, the last one that of the alarm
};

struct InterpreterConfig {
  const Dialect* dialect = nullptr;
  const nc_system_config* system = nullptr;
  uint8_t system_index = 0;        ///< part system, from 0
  uint32_t look_ahead = 1024;
  uint32_t window_bytes = 65536;
  FramesConfig frames;
  const VendorCodes* vendor = nullptr;
};

class SharedTables;

struct Interpreter {
  void create(const InterpreterConfig& config, ProgramStore* store, CommonVariables* common, Arena& arena);

  // ---- the stream ---------------------------------------------------------------------------------------------------
  /// Front of the items made and not yet taken, nullptr = none.
  Item* front() { return queued_ == 0 ? nullptr : &queue_[head_ % kQueue]; }
  void pop() {
    ++head_;
    if (--queued_ == 0) head_ = 0;  // from the front again: a short queue stays in the cache
  }
  /// All of them; number 0 is the front.
  unsigned queued() const { return queued_; }
  const Item& queued(unsigned number) const { return queue_[(head_ + number) % kQueue]; }
  /// Gives up those from `number` on.
  void forget_queued(unsigned number) { queued_ = number; }
  /// Makes more items: NC_OK (look at front()), NC_WAITING (a sync is open), NC_BUDGET, NC_ENDED, NC_ALARMED.
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
  /// rewind(seq) is possible, and still will be when one more block has been executed.
  /// The program is selected, in the call stack now or after a rewind, in a modal call or the interrupt program.
  bool refers_to(unsigned file) const;
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
  void leave_interrupt(bool to_sequence);
  /// A stage behind has found a fault: what is queued is void, the alarm and the end take its place.
  void abort(const Fault& what, const nc_source& where);
  /// For abort(), before the blocks from `seq` on are given up: which of them called the program of `where`.
  void note_calls(const nc_source& where, BlockSeq seq);
  /// The blocks that led to `where`, which comes behind block `seq`, outermost first and with it; 0: that is not known any more.
  unsigned calls_behind(const nc_source& where, BlockSeq seq, nc_source (&calls)[kMaxFrames]) const;
  void refresh_settings();
  /// The host has changed a number of the frames' table: no rewind brings the old one back.
  void set_table_from_outside(unsigned key, double value);

  // ---- for the functions (interpret/ only) --------------------------------------------------------------------------
  const Dialect* dialect = nullptr;
  const nc_system_config* system = nullptr;
  uint8_t system_index = 0;        ///< part system, from 0
  unsigned axis_count = 3;
  uint32_t rotary = 0;             ///< bit i: axis i is rotary
  int8_t axis_of[26];              ///< axis index by letter, -1 = none
  uint32_t axis_letters = 0;       ///< bit n: address n is an axis
  uint32_t code_addresses = 0;     ///< those of codes and of numbers of blocks
  CodeIndex codes;                 ///< the family's G codes

  State state;
  Settings settings;
  Parameters parameters;
  Frames frames;
  Variables variables;
  Notes notes;
  mutable ProgramMatrices program_matrices;  ///< of the maps in force (interpret/program_map.hpp), made when they are asked for
  CodeCalls code_calls;
  const VendorCodes* vendor = nullptr;  ///< the machine's own codes
  bool codes_call = false;         ///< some code calls: a parameter has registered it, or it is the vendor's
  struct {
    nc_device_read read = nullptr;
    void* user = nullptr;
  } devices;                       ///< of the PLC (#100110)
  CommonVariables* common = nullptr;
  SharedTables* shared = nullptr;  ///< with the other part systems; nullptr: there are none
  ProgramStore* store = nullptr;
  BlockReader reader;
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
  InternPool<Affine> transforms;   ///< from the compensation frame to machine coordinates; Move::transform
  InternPool<ModalState> modals;
  InternPool<Message> texts;
  InternPool<MoveShape> shapes;    ///< of moves under way; Move::shape counts from 1
  InternPool<PathPoint> points;
  InternPool<StrokeBox> stroke_boxes;   ///< of G22; Move::stroke_box counts from 1
  InternPool<MotionSettings> motion_settings;  ///< Move::settings
  SkipSpeeds skip_speeds;               ///< of the G31 under way
  double measured_position = 0, measured_range = 0;  ///< of the G37 under way
  bool measured_nothing = false;                     ///< it has no range to measure in
  ProgramRef main_program;
  bool mdi = false;                ///< the main program is blocks of MDI: their end is no alarm
  uint32_t closed_axes = 0;        ///< bit i: axis i is a spindle, or a C axis without its reference (M700 10.5); no command now
  uint32_t optional_skip = 0;      ///< switches, bit n = /n
  uint8_t mirror_switch = 0;       ///< axes that the next program is mirrored in
  uint8_t mirror_signal = 0;       ///< the same by the signals of the machine when it was started

  Fault fault;
  uint32_t sync_needed = 0;
  nc_world world{};
  bool world_fresh = false;        ///< `world` is the answer to a sync and nothing has been emitted since
  bool begins_again = false;       ///< M99 of the main program in this block: its mark says so
  bool ended = false, alarmed = false;
  Fault alarm_fault;
  nc_source alarm_source{};
  AlarmStory alarm_story;
  ModalState finished_modal;       ///< as the last finished block left it: the block in execution, at a sync (#4201...)
  uint32_t last_line = 1;          ///< of the last block read
  uint32_t user_alarm_text = 0;    ///< text of the last #3000
  nc_alarm vendor_alarm{};         ///< what the last function of the vendor that failed has said
  bool in_vendor_function = false; ///< one runs: nothing else drives this part system meanwhile
  bool feeding = false;            ///< read for the machine, else for nc_pull()

  // the block in hand
  const Block* block = nullptr;
  nc_source source{};
  BlockWords words;
  unsigned statement = 0;          ///< next macro statement of the block
  bool jumped = false;             ///< a statement has sent the program elsewhere: those behind it in the block are not executed
  bool modal_kept = false;         ///< the block in hand has changed nothing of the modal state
  Step next_step = Step::none;
  Hole hole;
  HoleProgress progress;
  uint32_t holes_left = 0;
  AxisVec hole_increment;
  uint32_t hole_axes = 0;
  bool motion_done = false;
  Block* rewritten = nullptr;      ///< copy of the block in hand without the code that calls a program
  const CodeCall* after_block = nullptr; ///< the program to be called when the block in hand has done its part
  bool block_starts_incremental = false; ///< G91 was modal before this block
  bool distance_by_word = false;         ///< an axis word goes by the G90/G91 before it in the block (M700 5.1)

  /// What a word of the block means. Which of several meanings of its address is asked for, the function in hand decides.
  bool is(const Word& word, Role role) const { return address_of(word) == dialect->addresses.at(role); }
  uint32_t addresses(std::initializer_list<Role> roles) const { return dialect->addresses.set(roles); }
  /// Index of the axis that the configuration or a parameter names so, and of the one that a rule names; -1 = the machine has none.
  int axis_named(char name) const { return name == 0 ? -1 : axis_of[address_of(name)]; }
  int axis_called(Role role) const {
    const unsigned address = dialect->addresses.at(role);
    return address < kAddresses ? axis_of[address] : -1;
  }

  /// A new item at the end of the queue, its payload as constructed; moves come from emit_move().
  Item& emit(ItemKind kind);
  /// A move with the compensation in force; transform and kind are left to the caller.
  Move& emit_move(const AxisVec& start, const AxisVec& end);
  bool queue_has_room() const { return queued_ < kQueue - kReserve; }
  /// What is missing because the text could not be read is not missing: then that is the alarm.
  Execution raise(Condition condition, char letter = 0) {
    fault = Fault{};
    fault.condition = reader.failure() != Condition::none ? reader.failure() : condition;
    fault.letter = letter;
    return Execution::fault;
  }
  /// About a word of the block, by what it means.
  Execution raise(Condition condition, Role word) { return raise(condition, dialect->addresses.letter(word)); }
  Execution raise(Condition condition, Role word, double value) { return raise(condition, dialect->addresses.letter(word), value); }
  Execution raise(Condition condition, char letter, double value) {
    raise(condition, letter);
    fault.has_value = true;
    fault.value = value;
    return Execution::fault;
  }
  /// Of an axis, by its index.
  Execution raise_axis(Condition condition, unsigned axis) {
    raise(condition, system->axis[axis].name);
    fault.axis = static_cast<int8_t>(axis);
    return Execution::fault;
  }
  Execution raise_axis(Condition condition, unsigned axis, double value) {
    raise(condition, system->axis[axis].name, value);
    fault.axis = static_cast<int8_t>(axis);
    return Execution::fault;
  }
  /// About a code of the block in hand. What is not fitted names its row (alarm_text), which is the code times ten.
  Execution raise_code(Condition condition, const FunctionRow& row) {
    return raise(condition, Role::code, condition == Condition::no_function ? row.code : row.code / 10.0);
  }
  /// About what a code means, where the code itself is not at hand: by the family's first code with this meaning.
  Execution raise_function(Condition condition, Function function) {
    const FunctionRow* const row = codes.row(function);
    return row != nullptr ? raise_code(condition, *row) : raise(condition, Role::code);
  }
  /// About the code in force of a mode.
  Execution raise_mode(Condition condition, Mode mode) {
    const FunctionRow* const row = row_in_force(*dialect, state.modal, mode);
    return row != nullptr ? raise_code(condition, *row) : raise(condition, Role::code);
  }
  Execution raise_misc(Condition condition, MiscFunction function) { return raise(condition, Role::misc_code, misc_code(*dialect, function)); }
  /// What part systems share is as the machine has come to it, or there is one part system. False: it has to be asked for (NC_SYNC_SHARED).
  bool shared_known() const { return shared == nullptr || world_fresh; }
  Execution need(uint32_t what) {
    sync_needed = what;
    return Execution::sync;
  }

  /// The block of `source` has ended: its mark (and the end, after M02/M30), and the checkpoint to rewind to.
  /// `executable`: it counts as a block for radius compensation (M700 12.4.2 lists NC blocks; 13.5.9: macro statements are none).
  void finish_block(bool stop, bool executable);
  /// A place inside a block where single block may stop. `resume`: what has been read so far is kept, and what follows can be read
  /// again from here.
  void emit_stop_point(bool resume = false);
  /// The block has done its part and the program goes on in the one it calls: what comes there does not undo it.
  void keep_call();
  /// The program that runs, or what is in force in it, has changed: what blocks ask of it.
  void program_changed() {
    const CallFrame& frame = state.frame[state.depth];
    state.modal_call = frame.modal_call;
    state.mapped = state.any_mirror() != 0 || frame.figure != 0 || state.scaled != 0 || state.rotated ||
                   state.work_turned;
  }
  unsigned macro_level() const { return state.frame[state.depth].macro_level; }

  /// Active zero and the position in it.
  const AxisVec& zero() const { return frames.zero(state.work_system); }
  AxisVec position() const {
    if (state.map.kind == AxisMap::Kind::polar) [[unlikely]] return polar_position();
    const AxisVec& z = zero();
    AxisVec p;  // all axes: a count that the compiler knows; those that the machine does not have are zero everywhere
    for (unsigned i = 0; i < kMaxAxes; ++i) p[i] = state.machine[i] - z[i] - state.applied[i];
    return p;
  }
  AxisVec polar_position() const;
  /// Reference position 1 to 4 (`which` 0 to 3) of an axis, machine coordinates (M700 14.3).
  double reference(unsigned which, unsigned axis) const {
    const double set = settings.reference[which][axis];
    return set == set ? set : system->axis[axis].reference[which];
  }
  /// The letters that command axes: those of the axes, or what a mode of the state makes of them.
  void refresh_axis_names();
  /// Everything that is made of the state's groups, after they have been assigned.
  void refresh_derived();
  /// Journalled write to the frames' table.
  void set_table(unsigned key, double value);
  /// Journalled write to a parameter; false when there is no such parameter or value.
  bool set_parameter(const char* key, int axis, const char* text);
  bool set_parameter(ParameterOf parameter, const char* text);
  /// The same to the notes.
  void set_note(unsigned key, double value);

 private:
  static constexpr unsigned kQueue = 64;    ///< items a block may make before the stages take them
  static constexpr unsigned kReserve = 24;  ///< one step of a job never makes more than this

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
    double map_note[Notes::kMapSize] = {};   ///< where these are centred
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
  void note_interrupt_items();

  nc_status run_block(uint32_t& budget);
  bool enter_block(CallFrame& frame, nc_status* status);
  nc_status settle(Execution did);
  void stop(const Fault& what, const nc_source& where);
  void note_calls(const nc_source& where, const CallFrame* levels);
  static unsigned calls_of(const nc_source& where, const CallFrame* levels, nc_source (&calls)[kMaxFrames]);
  void take_block_back();
  void emit_end();
  Item& next_item(ItemKind kind, bool block_end);
  void forget_block();
  /// Id of the modal state for a mark; behind an executable block finished_modal becomes it.
  ModalId modal_now(bool executable);
  Execution execute_statements();
  bool skipped(const Block& b) const;

  Item* queue_ = nullptr;
  unsigned head_ = 0, queued_ = 0;
  bool waiting_ = false;
  uint32_t waiting_for_ = 0;
  bool settings_stale_ = false;
  bool settings_of_moves_stale_ = true;   ///< made anew with the next move, so that numbers go to moves only
  SettingsId settings_of_moves_ = 0;
  void take_settings_of_moves();
  bool take_back(BlockSeq seq);
  static void undo(void* self, uint32_t key, double old);
  static double exchange(void* self, uint32_t key, double value);
  unsigned made_ = 0;          ///< items of the block in hand so far
  BlockSeq block_seq_ = 0;     ///< the state before it
  Repeat next_repeat_;         ///< from the next mark on
  InterruptReturn interrupted_;
  VendorCall vendor_call_;       ///< the newest block whose function of the vendor's has been called: read again, it has been
  BlockSeq answered_ = ~BlockSeq{0};  ///< the state before the block that the newest answer was for
  Checkpoints checkpoints_;
  static constexpr ModalId kNoModal = ~ModalId{0};
  ModalId newest_modal_ = kNoModal;  ///< of the newest mark
  bool modal_unchanged_ = false;     ///< since the newest mark
  bool finished_behind_ = false;     ///< macro calls have changed the modal state since the block that finished_modal belongs to
};

/// interpret/execute_block.cpp: a block of words.
Execution execute_words(Interpreter& in);
/// interpret/plain_line.cpp: a straight line in absolute millimetres. False: nothing has been done, the block needs execute_words().
bool execute_plain_line(Interpreter& in);
/// The G codes of in.words that say how other words are read.
Execution apply_reading_modes(Interpreter& in);
/// interpret/functions/parameter_input.cpp: a block between G10 L70 and G11.
Execution parameter_block(Interpreter& in);
/// Goes on with a block that said Execution::later.
Execution continue_block(Interpreter& in);

/// interpret/flow.cpp
Execution execute_statement(Interpreter& in, const Statement& statement);
Execution call_sub(Interpreter& in);          ///< M98
Execution return_sub(Interpreter& in);        ///< M99
Execution call_external(Interpreter& in);     ///< M198
Execution check_loops_closed(Interpreter& in);  ///< at the end of a program: a DO without END is P294
Execution text_ended(Interpreter& in);        ///< the end of the text, or '%'

/// interpret/macro_call.cpp
Execution call_macro(Interpreter& in);           ///< G65, G66, G66.1
Execution call_with_block(Interpreter& in);      ///< a block in the mode of G66.1
bool modal_call_takes_blocks(const Interpreter& in);
bool has_modal_call(const Interpreter& in);   ///< something that G67 can cancel
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
/// M700 12.1: an amount that changes while it is in force counts from the next block on: a length with the next command of its axis.
void take_changed_amounts(Interpreter& in);
/// The block moves under a modal call (G66), and calls a program or returns from its own.
bool goes_on_elsewhere(const Interpreter& in);
Execution make_modal_call_first(Interpreter& in);

/// interpret/interrupt.cpp
bool is_interrupt_on(const Interpreter& in, uint32_t m);   ///< M96, or what stands for it
bool is_interrupt_off(const Interpreter& in, uint32_t m);  ///< M97
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

/// interpret/motion.cpp
struct LinearStyle {
  nc_move_kind kind = NC_MOVE_LINE;
  double feed_mm_min = 0;
  const SkipSpeeds* skip_speeds = nullptr;
  bool exact_stop = false;
  bool transparent = false;   ///< radius compensation vectors are away for this move
  uint8_t skip_mask = 0;
  uint8_t unclamps = 0;       ///< index tables that are unclamped meanwhile (M700 9.3)
  double feed_mm_rev = 0;     ///< thread: lead along the longest axis
  double thread_angle = 0;
  bool special_feed = false;  ///< the modal feed, and it is not the plain one (interpret/feed.hpp)
  Corner corner = Corner::none;  ///< at its end ...
  double corner_mm = 0;       ///< ... of this size
  double in_position = 0;     ///< ,I ,J: what comes behind waits until each axis is as near to its end as this, mm; 0 = by the parameters
};
/// A straight move to `target` in the active coordinates; `commanded` = axes named in the block (tool length is applied to them).
void move_linear(Interpreter& in, const AxisVec& target, uint32_t commanded, const LinearStyle& style);
/// A straight rapid to machine coordinates of the `commanded` axes (G53, second leg of G28), without any compensation on those of them
/// that are `bare`.
void move_machine(Interpreter& in, const AxisVec& machine, uint32_t commanded, uint32_t bare = ~uint32_t{0});
/// An arc in the plane in force by the words of the block.
Execution move_arc(Interpreter& in, const AxisVec& target, uint32_t commanded, bool ccw);
struct ArcWords;
struct PlaneAxes;
/// The same by words that the caller has made.
Execution move_arc_by(Interpreter& in, const PlaneAxes& plane, const AxisVec& target, uint32_t commanded, ArcWords words, bool ccw);
/// Programmed coordinates of a move: where it starts and ends, and the map behind them.
struct MoveFrame {
  Affine to_machine;
  AxisVec start, end;
};
/// Tool length goes to the commanded axes; axes that are not stay where they are.
MoveFrame frame_of_move(Interpreter& in, const AxisVec& target, uint32_t commanded);
/// A circular move (arc, helix, spiral) at the feed in force.
void emit_circular(Interpreter& in, const MoveFrame& frame, const PlaneAxes& plane, const Circle& circle, nc_move_kind kind);
/// A move of any other shape; its feed is the caller's.
Move& emit_shaped(Interpreter& in, const MoveFrame& frame, const MoveShape& shape, nc_move_kind kind);
/// Modal curves that do not bear some other codes.
inline bool bars_codes(Function motion) { return is_space_arc(motion) || is_exponential(motion); }
/// A compensation command in a block that does not move: a move without length carries it to the offset stage (offset/offset.hpp).
void move_nowhere(Interpreter& in);
/// P20: a rotary axis commanded to a position that is no multiple of #2106 (M700 2.3).
Execution check_index_positions(Interpreter& in);
/// The motion that the words of the block ask for by the motion in force.
Execution move_by_words(Interpreter& in);
/// F in force as mm/min, 0 = none.
double feed_mm_min(const Interpreter& in);
/// The same for a line between these points, of which rotary axes alone may be moved.
double feed_for(const Interpreter& in, const AxisVec& start, const AxisVec& end);
/// The end point that the words ask for.
AxisVec target_of_words(const Interpreter& in);
/// The same from values by axis; `axes` of them are programmed.
AxisVec target_of(const Interpreter& in, const AxisVec& position, uint32_t axes, const AxisVec& value);
AxisVec target_of_words(const Interpreter& in, const AxisVec& position);  ///< with position() at hand

/// interpret/arc.cpp
struct ArcWords {
  bool has_radius = false;
  double radius = 0;
  double center[2] = {0, 0};   ///< increments from the start, plane axes
  uint32_t turns = 0;
};
/// Circle through start and end on the plane axes; Condition::none when it exists. *straight: nothing goes round, the path is the straight
/// line to the end, or nothing where that is the start.
Condition make_circle(const double start[2], const double end[2], const ArcWords& words, bool ccw, double tolerance, Circle* circle,
                      bool* straight);

}  // namespace nc
