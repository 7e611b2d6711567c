// SPDX-License-Identifier: Apache-2.0
// What a function of a block works with: the state, the tables, the words of the block, and the way items go into the stream. Handlers
// (functions/*.cpp, motion.cpp, feed.cpp ...) get this and no more: how blocks are read, taken back, interrupted and called is the
// interpreter's (interpreter.hpp), and a change there does not touch them.
#pragma once

#include <cstring>

#include "base/intern_pool.hpp"
#include "cycle/pattern.hpp"
#include "dialect/code_index.hpp"
#include "frame/affine.hpp"
#include "frame/frames.hpp"
#include "frame/stroke_box.hpp"
#include "interpret/block_words.hpp"
#include "interpret/checkpoints.hpp"
#include "interpret/code_calls.hpp"
#include "interpret/motion_settings.hpp"
#include "interpret/parameters.hpp"
#include "interpret/program_matrices.hpp"
#include "interpret/program_records.hpp"
#include "interpret/state.hpp"
#include "interpret/vendor_codes.hpp"
#include "macro/variables.hpp"
#include "nc/run.h"
#include "stream/item_queue.hpp"

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

/// The holes that the block in hand makes (functions/cycle.cpp).
struct HolesOfBlock {
  Hole hole;                  ///< the one under way ...
  HoleProgress progress;
  uint32_t left = 0;          ///< with it
  uint32_t axes = 0;          ///< that the block positions, ...
  AxisVec increment;          ///< ... by these values of its words
  HolePattern pattern;        ///< where they lie, of a pattern
  AxisVec pattern_at;         ///< its reference point as programmed
  AxisVec over, beside;       ///< the hole, and the place that a shift goes to
  bool whole = false;         ///< no pecks: what is tried before the block begins
  bool tapping = false;       ///< between R and R again
};

class SharedTables;
struct Interpreter;

/// Base of the Interpreter, which is the only one to make it. What is protected is for the way items go into the stream.
struct BlockContext {
  // ---- the machine and its family: fixed, but for the letters that a mode gives to axes
  const Dialect* dialect = nullptr;
  const nc_system_config* system = nullptr;
  uint8_t system_index = 0;        ///< part system, from 0
  unsigned axis_count = 3;
  uint32_t rotary = 0;             ///< bit i: axis i is rotary
  int8_t axis_of[26];              ///< axis index by letter, -1 = none
  uint32_t closed_axes = 0;        ///< bit i: axis i is a spindle, or a C axis without its reference (M700 10.5); no command now
  uint32_t axis_letters = 0;       ///< bit n: address n is an axis
  uint32_t code_addresses = 0;     ///< those of codes and of numbers of blocks
  CodeIndex codes;                 ///< the family's G codes
  const VendorCodes* vendor = nullptr;  ///< the machine's own codes
  CodeCalls code_calls;            ///< codes that parameters have registered
  bool codes_call = false;         ///< some code calls: a parameter has registered it, or it is the vendor's
  uint32_t optional_skip = 0;      ///< switches, bit n = /n

  // ---- what is in force, and the tables
  State state;
  Settings settings;
  Parameters parameters;
  Frames frames;
  Variables variables;
  Journalled<ProgramRecords, Interpreter> records;
  mutable ProgramMatrices program_matrices;  ///< of the maps in force (interpret/program_map.hpp), made when they are asked for
  SharedTables* shared = nullptr;  ///< with the other part systems; nullptr: there are none
  BlockReader reader;
  InternPool<Affine> transforms;   ///< from the compensation frame to machine coordinates; Move::transform
  InternPool<ModalState> modals;
  InternPool<Message> texts;
  InternPool<MoveShape> shapes;    ///< of moves under way; Move::shape counts from 1
  InternPool<PathPoint> points;
  InternPool<StrokeBox> stroke_boxes;   ///< of G22; Move::stroke_box counts from 1
  InternPool<MotionSettings> motion_settings;  ///< Move::settings

  // ---- the block in hand
  const Block* block = nullptr;
  nc_source source{};
  BlockWords words;
  Step next_step = Step::none;
  HolesOfBlock holes;
  bool motion_done = false;
  bool modal_kept = false;         ///< the block in hand has changed nothing of the modal state
  bool block_starts_incremental = false; ///< G91 was modal before this block
  bool distance_by_word = false;         ///< an axis word goes by the G90/G91 before it in the block (M700 5.1)
  SkipSpeeds skip_speeds;               ///< of the G31 under way
  double measured_position = 0, measured_range = 0;  ///< of the G37 under way
  bool measured_nothing = false;                     ///< it has no range to measure in

  // ---- what is known of the machine, and what a handler answers
  Fault fault;
  uint32_t sync_needed = 0;
  nc_world world{};
  bool world_fresh = false;        ///< `world` is the answer to a sync and nothing has been emitted since
  bool begins_again = false;       ///< M99 of the main program in this block: its mark says so
  bool ended = false, alarmed = false;
  ModalState finished_modal;       ///< as the last finished block left it: the block in execution, at a sync (#4201...)

  /// What a word of the block means. Which of several meanings of its address is asked for, the function in hand decides.
  bool is(const Word& word, Role role) const { return address_of(word) == dialect->addresses.at(role); }
  uint32_t addresses(std::initializer_list<Role> roles) const { return dialect->addresses.set(roles); }
  /// Index of the axis that the configuration or a parameter names so, and of the one that a rule names; -1 = the machine has none.
  int axis_named(char name) const { return name == 0 ? -1 : axis_of[address_of(name)]; }
  int axis_called(Role role) const {
    const unsigned address = dialect->addresses.at(role);
    return address < kAddresses ? axis_of[address] : -1;
  }

  // ---- positions
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
  unsigned macro_level() const { return state.frame[state.depth].macro_level; }

  /// The program that runs, or what is in force in it, has changed: what blocks ask of it.
  void program_changed() {
    const CallFrame& frame = state.frame[state.depth];
    state.modal_call = frame.modal_call;
    state.mapped = state.any_mirror() != 0 || frame.figure != 0 || state.scaled != 0 || state.rotated ||
                   state.work_turned;
  }

  // ---- journalled writes
  /// After parameters have been changed: everything that is made of them.
  void refresh_settings();
  /// Journalled write to the frames' table.
  void set_table(unsigned key, double value);
  /// Journalled write to a parameter; false when there is no such parameter or value.
  template <class Given>  // double, const char*
  bool set_parameter(ParameterId id, int bit, int axis, Given given) {
    unsigned index = 0;
    ParameterValue old;
    if (parameters.set(*dialect, id, bit, axis, given, &index, &old) != NC_OK) return false;
    note_parameter(index, old);
    return true;
  }
  bool set_parameter(ParameterOf parameter, double number);
  /// The same to the records, or to a field of one: change(&ProgramRecords::figure, &Figure::angle, angle).
  template <class... Change>
  void change(const Change&... what) {
    records.change(state.seq + 1, what...);
  }

  // ---- alarms and questions
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

  // ---- the stream
  /// A new item at the end of the queue, its payload as constructed; moves come from emit_move().
  Item& emit(ItemKind kind);
  /// A move with the compensation in force; transform and kind are left to the caller.
  Move& emit_move(const AxisVec& start, const AxisVec& end);
  ItemQueue queue;   ///< items made and not yet taken: those of the block in hand
  bool queue_has_room() const { return queue.room() > kReserve; }
  /// The block of `source` has ended: its mark (and the end, after M02/M30), and the checkpoint to rewind to.
  /// `executable`: it counts as a block for radius compensation (M700 12.4.2 lists NC blocks; 13.5.9: macro statements are none).
  void finish_block(bool stop, bool executable);
  /// A place inside a block where single block may stop. `resume`: what has been read so far is kept, and what follows can be read
  /// again from here.
  void emit_stop_point(bool resume = false);
  /// The block has done its part and the program goes on in the one it calls: what comes there does not undo it.
  void keep_call();

 protected:
  static constexpr unsigned kReserve = 24;  ///< one step of a job never makes more than this

  void note_parameter(unsigned index, ParameterValue old);
  void note_interrupt_items();
  void emit_end();
  Item& next_item(ItemKind kind, bool block_end);
  /// Id of the modal state, for a mark. When the block that the mark ends is executable, the state becomes that of the last finished block, too.
  ModalId modal_now(bool executable);
  bool settings_stale_ = false;
  bool settings_of_moves_stale_ = true;   ///< made anew with the next move, so that numbers go to moves only
  SettingsId settings_of_moves_ = 0;
  void take_settings_of_moves();
  Repeat next_repeat_;         ///< from the next mark on
  Checkpoints checkpoints_;
  static constexpr ModalId kNoModal = ~ModalId{0};
  ModalId newest_modal_ = kNoModal;  ///< of the newest mark
  bool modal_unchanged_ = false;     ///< since the newest mark
  bool finished_behind_ = false;     ///< macro calls have changed the modal state since the block that finished_modal belongs to
};

/// M700 12.1: an amount that changes while it is in force counts from the next block on: a length with the next command of its axis.
void take_changed_amounts(BlockContext& in);
/// interpret/interrupt.cpp, macro_call.cpp: what other functions ask of program control.
bool is_interrupt_on(const BlockContext& in, uint32_t m);   ///< M96, or what stands for it
bool is_interrupt_off(const BlockContext& in, uint32_t m);  ///< M97
bool has_modal_call(const BlockContext& in);   ///< something that G67 can cancel

}  // namespace nc
