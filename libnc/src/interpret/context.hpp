// SPDX-License-Identifier: Apache-2.0
// What a handler of a function works with: the state, the tables, the words of the block, and the functions that put items into the stream. Handlers
// (functions/*.cpp, motion.cpp, feed.cpp ...) get only this. How blocks are read, taken back, interrupted and called belongs to the interpreter
// (interpreter.hpp), and a change there does not touch the handlers.
#pragma once

#include <cstring>
#include <new>
#include <optional>

#include "base/intern_pool.hpp"
#include "command/words_of_block.hpp"
#include "cycle/cavity.hpp"
#include "cycle/pattern.hpp"
#include "dialect/code_index.hpp"
#include "frame/affine.hpp"
#include "frame/frames.hpp"
#include "frame/stroke_box.hpp"
#include "frame/tool_life.hpp"
#include "interpret/checkpoints.hpp"
#include "interpret/motion_settings.hpp"
#include "interpret/parameters.hpp"
#include "interpret/program_matrices.hpp"
#include "interpret/program_records.hpp"
#include "interpret/read_command.hpp"
#include "interpret/state.hpp"
#include "macro/variables.hpp"
#include "nc/run.h"
#include "stream/item_queue.hpp"

namespace nc {

/// Result of executing a block or a part of it.
enum class Execution : uint8_t {
  done,
  fault,   ///< Interpreter::fault says what is wrong
  sync,    ///< Interpreter::sync_needed says what is missing; the same is executed again when the answer is there
  later    ///< the block goes on at the next call (a cycle, an answer)
};

/// What an alarm is about: nothing, a word, given by itself or by its meaning, or a variable, a name or a character of a text.
class AlarmSubject {
 public:
  constexpr AlarmSubject() = default;
  constexpr AlarmSubject(WordSlot word) : kind_(Kind::word), number_(static_cast<uint8_t>(word)) {}    // NOLINT(google-explicit-constructor): a call names its subject
  constexpr AlarmSubject(Role role) : kind_(Kind::role), number_(static_cast<uint8_t>(role)) {}        // NOLINT(google-explicit-constructor)
  constexpr AlarmSubject(Sign sign) : kind_(Kind::sign), number_(static_cast<uint8_t>(sign)) {}        // NOLINT(google-explicit-constructor)
  /// Puts it into an alarm of a family.
  void name_in(Fault& fault, const AddressTable& addresses) const;

 private:
  enum class Kind : uint8_t { nothing, word, role, sign };
  Kind kind_ = Kind::nothing;
  uint8_t number_ = 0;
};

/// A text on its way to the operator or to an output.
struct Message {
  nc_text text{};
  bool operator==(const Message& other) const {
    if (text.size != other.text.size) return false;
    return text.size != 0 ? std::memcmp(text.s, other.text.s, text.size) == 0 : std::strcmp(text.s, other.text.s) == 0;
  }
};

/// A point that later blocks need: where axes are held (G07), a point of an arc in space, or a control point of a NURBS.
struct PathPoint {
  AxisVec at;
  double weight = 1, knot = 0;  ///< weight and knot of a control point
  double feed = 0;              ///< feed of the block in which an arc in space starts ...
  uint16_t feed_digit = 0;      ///< ... and ModalState::feed_digit in it
  nc_source source{};
  bool operator==(const PathPoint&) const { return false; }  // two points are never stored as one
};

/// How the holes of one block lie where its words are radius and angle and one of them is an increment (functions/polar_command.cpp).
struct PolarHoles {
  uint8_t axis[2] = {0, 1};   ///< of the plane
  bool on = false;
  double pole[2] = {0, 0};    ///< in the plane, as programmed
  double radius = 0, angle = 0;             ///< of the hole under way, mm, deg
  double radius_step = 0, angle_step = 0;   ///< to the next one
};

/// The holes that the block in hand makes (functions/cycle.cpp).
struct HolesOfBlock {
  Hole hole;                  ///< the one under way ...
  HoleProgress progress;
  uint32_t left = 0;          ///< with it
  Targets target;             ///< of the axes that the block positions
  PolarHoles polar;
  HolePattern pattern;        ///< where they lie, of a pattern
  AxisVec pattern_at;         ///< its reference point as programmed
  AxisVec over, beside;       ///< the hole, and the place that a shift goes to
  bool whole = false;         ///< no pecks: what is tried before the block begins
  bool tapping = false;       ///< between R and R again
  bool inside = false;        ///< the item in hand belongs to a stroke

  /// A block begins: what says whether another member means anything is as at first. The others are not cleared, for they are many, and set where they mean
  /// something.
  void begin() {
    left = 0;
    polar.on = false;
    pattern.kind = PatternKind::none;
    whole = tapping = inside = false;
  }
};

/// The cavity that the block in hand mills (functions/cavity.cpp); lengths as programmed.
struct CavityOfBlock {
  Cavity shape;
  double center[2] = {0, 0};
  uint8_t axis = 2;           ///< that goes down
  double r = 0, bottom = 0, cut = 0;
  double depth = 0;           ///< level under way
  uint32_t ring = 0;
  unsigned piece = 0;
};

/// What the block in hand waits for (functions/machine_io.cpp).
struct InputWait {
  uint32_t number = 0, left = 0;   ///< of the input; questions that are left
  uint8_t kind = 0;
  bool analog = false, seen = false, last = false;  ///< ...; the level of the last question is known, and is `last`
};

class SharedTables;
struct Interpreter;

/// Base of the Interpreter; no other class makes one. The protected members serve to put items into the stream.
struct BlockContext {
  // ---- the machine and its family: fixed, except for the words that a mode gives to axes
  const Dialect* dialect = nullptr;
  const nc_system_config* system = nullptr;
  uint8_t system_index = 0;        ///< part system, from 0
  unsigned axis_count = 3;
  uint32_t rotary = 0;             ///< bit i: axis i is rotary
  AxisWords axis_words;            ///< which words command axes
  uint32_t closed_axes = 0;        ///< bit i: axis i is a spindle, or a C axis without its reference (M700 10.5); no command now
  CodeIndex codes;                 ///< the family's G codes
  const VendorCodes* vendor = nullptr;  ///< the codes that the vendor of the machine has added
  CodeCalls code_calls;            ///< codes that parameters have registered to call a program
  bool codes_call = false;         ///< there are such codes, or codes of the vendor
  FrontEnd front;                  ///< what the words of a block are read with
  double retract_overlap = 0;      ///< how far the tool goes beyond the level between two holes of a cycle, mm; 0 = it stops there
  uint32_t optional_skip = 0;      ///< optional block skip switches, bit n = switch n

  // ---- what is in force, and the tables
  State state;
  Settings settings;
  Parameters parameters;
  Frames frames;
  Variables variables;
  Journalled<ProgramRecords, Interpreter> records;
  Journalled<ToolLives, Interpreter, true> lives;  ///< tools whose life is managed
  mutable ProgramMatrices program_matrices;  ///< matrices of the maps in force (interpret/program_map.hpp), calculated when they are needed
  SharedTables* shared = nullptr;  ///< what is shared with other part systems; nullptr: there are none
  BlockReader reader;
  InternPool<Affine> transforms;   ///< from the compensation frame to machine coordinates; Move::transform
  InternPool<ModalState> modals;
  InternPool<Message> texts;
  InternPool<MoveShape> shapes;    ///< shapes of moves under way; Move::shape counts from 1
  InternPool<PathPoint> points;
  InternPool<StrokeBox> stroke_boxes;   ///< areas of G22; Move::stroke_box counts from 1
  InternPool<MotionSettings> motion_settings;  ///< Move::settings

  // ---- the block in hand
  const Block* block = nullptr;
  nc_source source{};
  Command words;
  Step next_step = Step::none;
  HolesOfBlock holes;
  PolarHoles polar_holes;          ///< what the words of the block say of its holes
  CavityOfBlock cavity;
  InputWait input_wait;
  bool motion_done = false;
  bool modal_kept = false;         ///< the block in hand has not changed the modal state
  bool block_starts_incremental = false; ///< G91 was modal before this block
  bool distance_by_word = false;         ///< for an axis word the G90/G91 before it in the block counts (M700 5.1)
  SkipSpeeds skip_speeds;               ///< feeds of the G31 under way
  AxisVec skip_start;                   ///< where the G31 under way begins, machine coordinates
  double measured_position = 0, measured_range = 0;  ///< expected position and range of the G37 under way
  bool measured_nothing = false;                     ///< that G37 has no range in which it could measure

  // ---- what is known of the machine, and what a handler gives back
  Fault fault;
  uint32_t sync_needed = 0;
  nc_world world{};
  bool world_fresh = false;        ///< `world` is the answer to a sync and nothing has been emitted since
  bool begins_again = false;       ///< the block holds M99 of the main program, which its mark has to say
  bool aside = false;              ///< Mark::aside of the block in hand
  bool call_ends = false;          ///< Mark::of_call of the mark that is made next
  bool ended = false, alarmed = false;

  /// The word with a meaning, kNoWord = the family has none; and the set of several. A word may have several meanings; the function in hand decides which one
  /// it asks for.
  WordSlot word(Role role) const { return dialect->addresses.word(role); }
  WordSet set_of(std::initializer_list<Role> roles) const { return dialect->addresses.set(roles); }
  /// Index of the axis with a meaning from a rule. -1 = the machine has no such axis.
  int axis_called(Role role) const { return axis_words.axis(word(role)); }

  // ---- positions
  /// The zero point of the active workpiece coordinates, and the position in these coordinates.
  const AxisVec& zero() const { return frames.zero(state.work_system); }
  AxisVec position() const {
    if (state.map.kind == AxisMap::Kind::polar) [[unlikely]] return polar_position();
    const AxisVec& z = zero();
    AxisVec p;  // for all axes, because the compiler knows that count; axes that the machine does not have are 0
    for (unsigned i = 0; i < kMaxAxes; ++i) p[i] = state.machine[i] - z[i] - state.applied[i];
    return p;
  }
  AxisVec polar_position() const;
  /// Reference position 1 to 4 (`which` 0 to 3) of an axis, machine coordinates (M700 14.3).
  double reference(unsigned which, unsigned axis) const {
    const double set = settings.reference[which][axis];
    return set == set ? set : system->axis[axis].reference[which];
  }
  /// Sets the words that command axes: their names, and the words that a mode of the state gives them.
  void refresh_axis_words();
  /// The highest number of an offset of a tool.
  unsigned tool_offsets() const { return frames.tool_offsets() < dialect->most_offsets ? frames.tool_offsets() : dialect->most_offsets; }
  /// The slot of the tool in the spindle in the table of tool life, ToolLives::kNone = its life is not managed, or it is not registered there any more.
  unsigned managed_tool() const { return lives->find(records->tools.spindle); }
  unsigned macro_level() const { return state.frame[state.depth].macro_level; }

  /// The program that runs, or what is in force in it, has changed: sets the members of the state that follow from it.
  void program_changed() {
    const CallFrame& frame = state.frame[state.depth];
    state.modal_call = frame.modal_call;
    state.mapped = state.any_mirror() != 0 || frame.figure != 0 || state.scaled != 0 || state.rotated ||
                   state.work_turned;
  }

  // ---- journalled writes
  /// Makes everything that follows from parameters anew, after parameters have been changed.
  void refresh_settings();
  /// Journalled write to the table of frames.
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
  /// The same by meaning; `axis` is the index of the axis for a parameter that each axis has for itself, -1 = one of all axes.
  bool set_parameter(ParameterOf parameter, double number, int axis = -1);
  /// Journalled write to a record, or to a field of one: change(&ProgramRecords::figure, &Figure::angle, angle).
  template <class... Change>
  void change(const Change&... what) {
    records.change(state.seq + 1, what...);
  }
  /// Journalled write to a member of a tool whose life is managed.
  template <class Member>
  void change_life(unsigned slot, Member ToolLife::*member, const std::type_identity_t<Member>& value) {
    lives.change(state.seq + 1, &ToolLives::tool, slot, member, value);
  }

  // ---- alarms and questions
  /// Raises an alarm, with what it is about and with the value that it shows. Where the text could not be read, that is the alarm, because `condition`
  /// (something is missing) may only follow from it.
  Execution raise(Condition condition, AlarmSubject about = {}, std::optional<double> value = {});
  /// An alarm about the first word of the block that is one of `of` (not empty).
  Execution raise_first(Condition condition, WordSet of) {
    const WordSlot first = first_of_block(*block, of);
    return raise(condition, first, words.get(first));
  }
  /// An alarm about an axis, given by its index.
  Execution raise_axis(Condition condition, unsigned axis, std::optional<double> value = {}) {
    raise(condition, axis_words.word(axis), value);
    fault.axis = static_cast<int8_t>(axis);
    return Execution::fault;
  }
  /// An alarm about a code of the block in hand. Condition::no_function gives the code times ten, by which alarm_text() finds its row.
  Execution raise_code(Condition condition, const FunctionRow& row) {
    return raise(condition, Role::code, condition == Condition::no_function ? row.code : row.code / 10.0);
  }
  /// An alarm about a function, where its code is not at hand: the family's first code with this function is named.
  Execution raise_function(Condition condition, Function function) {
    const FunctionRow* const row = codes.row(function);
    return row != nullptr ? raise_code(condition, *row) : raise(condition, Role::code);
  }
  /// An alarm about the code that is in force for a mode.
  Execution raise_mode(Condition condition, Mode mode) {
    const FunctionRow* const row = row_in_force(*dialect, state.modal, mode);
    return row != nullptr ? raise_code(condition, *row) : raise(condition, Role::code);
  }
  Execution raise_misc(Condition condition, MiscFunction function) { return raise(condition, Role::misc_code, misc_code(*dialect, function)); }
  /// What reading words with `front` has come to.
  Execution executed(Reading reading) {
    if (reading == Reading::refused) return raise(front.refusal.condition, front.refusal.word, front.refusal.has_value ? std::optional(front.refusal.value) : std::nullopt);
    return reading == Reading::done ? Execution::done : reading == Reading::sync ? Execution::sync : Execution::fault;
  }
  /// The data that part systems share can be read now: the machine has come to this block, or there is only one part system. False: a sync is needed
  /// (NC_SYNC_SHARED).
  bool shared_known() const { return shared == nullptr || world_fresh; }
  /// Part of Interpreter::sync_needed: a variable is read in a contour with radius compensation, or before its end has been made.
  static constexpr uint32_t kSyncAhead = uint32_t{1} << 31;
  bool in_contour() const { return state.comp.side != 0 || state.moved_side != 0; }
  Execution need(uint32_t what) {
    sync_needed = what;
    return Execution::sync;
  }

  // ---- the stream
  /// A new item at the end of the queue, with the default payload of its kind; moves are made by emit_move().
  Item& emit(ItemKind kind);
  /// A move with the compensation in force; the caller sets its transform and kind.
  Move& emit_move(const AxisVec& start, const AxisVec& end) {
    Item& item = next_item(ItemKind::move, false);
    world_fresh = false;
    // Constructed with its values, because clearing three positions before they are set would be felt in every block.
    Move& move = *new (&item.move) Move(start, end, state.comp);
    move.stroke_box = state.stroke_box;
    if (settings_of_moves_stale_) [[unlikely]] take_settings_of_moves();
    move.settings = settings_of_moves_;
    return move;
  }
  ItemQueue queue;   ///< items of the block in hand that have been made and not yet taken
  bool queue_has_room() const { return queue.room() > kReserve; }
  /// The block of `source` has ended: emits its mark (and the end, after M02/M30), and keeps the checkpoint to rewind to. `executable`: the block counts
  /// for radius compensation (M700 12.4.2 lists such blocks; 13.5.9: macro statements do not count).
  void finish_block(bool stop, bool executable);
  /// Emits a mark for a place inside a block where single block may stop. `resume`: it can also be rewound to, and what the block has done so far is kept.
  void emit_stop_point(bool resume = false);
  /// The block has called a program and done its own part: keeps a checkpoint, so that a fault in the program does not undo this block.
  void keep_call();

 protected:
  static constexpr unsigned kReserve = 24;  ///< the most items that one step of a block makes

  /// Keeps a checkpoint of the state, whose modes may have changed since the newest mark.
  void keep_state() {
    state.modes_ahead = !(state.executed == state.modal);
    checkpoints_.save(state);
  }
  void note_parameter(unsigned index, ParameterValue old);
  void note_interrupt_items();
  void emit_end();
  Item& next_item(ItemKind kind, bool block_end) {
    Item& item = queue.add();
    item.kind = kind;
    item.block_end = block_end;
    item.in_hole = holes.inside;
    item.source = source;
    return item;
  }
  /// Id of the modal state, for a mark. When the block counts as executed, its modal state is also that in execution.
  ModalId modal_now(bool executable);
  bool settings_stale_ = false;
  bool settings_of_moves_stale_ = true;   ///< they are interned anew with the next move, so that only moves take up numbers
  SettingsId settings_of_moves_ = 0;
  void take_settings_of_moves();
  Repeat next_repeat_;         ///< goes out with the next mark
  Checkpoints checkpoints_;
  static constexpr ModalId kNoModal = ~ModalId{0};
  ModalId newest_modal_ = kNoModal;  ///< modal state of the newest mark
  bool modal_unchanged_ = false;     ///< the modal state has not changed since the newest mark
};

/// M700 12.1: an offset amount that is changed while it is in force acts from the next block on; a length acts with the next command of its axis.
void take_changed_amounts(BlockContext& in);
/// interpret/interrupt.cpp, macro_call.cpp: what other functions need of program control.
/// A code of the block calls a program, or names one (M96): then P, H and I J K are words of that code (M700 13.3.1, 13.3.3, 13.12).
bool has_words_of_call(const BlockContext& in);
bool has_modal_call(const BlockContext& in);   ///< something that G67 can cancel

}  // namespace nc
