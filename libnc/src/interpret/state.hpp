// SPDX-License-Identifier: Apache-2.0
// The whole state of the interpreter of one part system, as one copyable value. What is not in here is either a table that is
// journalled (frame/frames.hpp, macro/variables.hpp) or fixed while a program runs (parameters, programs).
//
// The members are grouped by the events that they outlive. A group is copied as a whole or begins anew as a whole (interpret/lifetimes.cpp), so that a new
// member is kept and given back with its group, without a line elsewhere. The few values that are treated otherwise than their group are written down
// there, each with its section.
//
//   group              over M98,   interrupt   next text   M02, M30,    reset by the   power off
//                      G65, M99    and M99     of MDI      next start   operator
//   BlockLife             yes          -           -           -            -             -
//   ProgramLife           yes          -           -           -            -             -
//   MachinePosition       yes        place        yes         yes          yes            -
//   AppliedLength         yes        place        yes          -            -             -
//   ModalLife             yes       RETURNS       yes          -            -             -
//   ModalInProgram        yes       RETURNS        -           -            -             -
//   UntilReset            yes          -          yes          -            -             -
//   UntilOperatorReset    yes          -          yes         yes           -             -
//   UntilPowerOff         yes          -          yes         yes          yes            -
//   Derived            is made of the other groups whenever one of them has been assigned
//   CallStack          is what M98 and G65 push and M99 pops; empty where a program or a text of MDI begins
//   ModesInExecution   is set by each block that counts as executed; the modes that a program or a text of MDI begins with are its first value
//
//   M98, G65, M99   M700 13.3.1, 13.5.1: a program that is called uses and changes the modes of the program that calls it
//   interrupt       M700 13.12. RETURNS: has the value from before the interrupt again; - : goes on with what the interrupt program made
//                   of it; place: RETURNS where the interrupted block is read again from its head, else goes on. Behind M99 P, and where
//                   a program of type 1 has moved, everything goes on
//   text of MDI     M700 5.1: blocks of MDI one behind the other; yes: is kept, - : begins anew
//   M02, M30        M700 9.1: what the end and the start after it leave; the initial values are those of reset 2 (3.7)
//   reset           M700 3.7, reset 2 and reset & rewind
//   power off       nothing of the state is retained; nc_create begins with State{} and the initial values of 3.7
//
// tests/interpret/lifetimes_test.cpp reads this table and holds the code to it.
#pragma once

#include "cycle/hole.hpp"
#include "dialect/dialect.hpp"
#include "frame/tool_life.hpp"
#include "modal/modal_state.hpp"
#include "path/shape.hpp"
#include "program/store.hpp"
#include "stream/stream.hpp"

namespace nc {

inline constexpr unsigned kMaxFrames = 9;     ///< main program and eight levels (M700 13.3.1)
inline constexpr unsigned kMaxLoops = 108;    ///< open DO loops: 27 in each program (M700 13.5.7), with four macro levels at most

enum class CallKind : uint8_t { main, sub, macro };

/// What has called a program.
enum class CallOrigin : uint8_t {
  word,       ///< M98, G65
  modal,      ///< G66, G66.1
  code,       ///< a registered G M S T B or ASCII code; in the program that it calls such codes do not call (M700 13.5.2, 13.5.3)
  external,   ///< M198
  interrupt,  ///< M96
  mdi         ///< the operator has entered blocks of MDI in a block stop (M700 12.4.4)
};

/// Values of CallFrame::figure: this pass has not moved yet, or it has moved.
inline constexpr uint8_t kFigureStarts = 1, kFigureMoved = 2;

/// One level of the call stack.
struct CallFrame {
  ProgramRef program;
  uint64_t offset = 0;        ///< byte offset of the next block
  uint64_t begin = 0;         ///< byte offset of the first block of a pass (H word), where a repetition starts again
  uint32_t line = 1, begin_line = 1;  ///< lines of these two blocks
  uint32_t call_line = 0;     ///< line of the block that has called the program of the next level; its mark comes after the return
  uint32_t repeats = 0;       ///< number of passes still to come after this one
  CallKind kind = CallKind::main;
  uint8_t macro_level = 0;
  uint8_t loop_base = 0;      ///< the loops of this level begin at this index of CallStack::loop
  bool started = false;       ///< a block of this program has been executed, so that a further O line begins another program
  CallOrigin origin = CallOrigin::word;
  uint8_t modal_call = 0;     ///< slot (interpret/program_records.hpp) of the modal macro call in force in this program, 0 = none
  uint8_t modal_slot = 0;     ///< slot of the modal call that runs this program, 0 = none
  uint8_t figure = 0;         ///< passes are rotated (M700 13.3.3): one of the two below, 0 = no
  uint32_t last_sequence = 0;  ///< behind the block of this number a pass has ended (HX 2.4.3), 0 = M99 says so
  bool last_begun = false;    ///< that block has been read
  bool puts_back = false;     ///< blocks of MDI at a place where the program is begun inside: behind them its modes are those of the place
  uint32_t places_made = 0;   ///< of the pattern in the next block, which is read again behind the macro that is called at each of them (PlacesOfCalls)
};
static_assert(sizeof(CallFrame) == 80);

/// An open DO.
struct Loop {
  uint64_t offset = 0;        ///< byte offset of its WHILE/DO block
  uint64_t body = 0;          ///< byte offset of the block behind that
  uint64_t end = 0;           ///< byte offset of the block behind its END; 0 = not known yet
  uint32_t line = 0;
  uint32_t end_line = 0;
  uint32_t number = 0;
};

/// What a block still has to do after its first items. At a mark that ends a block it is always Step::none.
enum class Step : uint8_t { none, cycle, skip_answered, measured, reference_check, cavity, loop, input, stitch, after_motion };

/// What cylindrical and polar coordinate interpolation restore when they end (M700 6.9, 6.10).
struct MillReturn {
  double feed = 0;
  Function plane = Function::plane_xy, feed_mode = Function::feed_per_minute;
  int8_t plane_axis[2] = {0, 1}, third_axis = 2;
  WordSlot hypothetical_word = kNoWord;  ///< word that commands the rotary axis in the plane; kNoWord = that of its own name
  bool moved = false;            ///< there was a movement in this mode
};

/// An arc in space over two blocks (M700 6.14).
enum class ArcStep : uint8_t { none, middle_given, halfway };

/// A NURBS that is being given block by block (M700 6.15).
struct NurbsState {
  uint32_t first = 0;   ///< id of its first point; the others follow (Interpreter::points)
  uint32_t knots = 0;   ///< number of knots given so far; 0 = no curve is open
  uint32_t points = 0;  ///< number of control points given so far
  uint8_t order = 4;    ///< degree + 1
  uint8_t axes = 0;     ///< bit i: axis i is commanded in the first block
  bool active() const { return knots != 0; }
};

/// The first block of a pair of M700 13.9: it has no end, and the block behind says where it is.
struct MeetingFirst {
  enum class Kind : uint8_t { none, line, arc } kind = Kind::none;
  bool ccw = false;
  bool by_radius = false;   ///< an arc: of `radius`, else about `center`
  bool by_hand = false;     ///< it begins where the axes were moved by hand, beside `start`
  int8_t choice = -1;       ///< H: 0 the meeting point with the shorter line, 1 the longer; -1 = not said
  double angle_deg = 0;     ///< of a line
  double center[2] = {0, 0};  ///< in the plane, programmed coordinates
  double radius = 0;
  double start[2] = {0, 0};   ///< the same
};

/// Constant surface speed (M700 10.3).
struct SpindleControl {
  double surface = 0;          ///< S of G96, m/min
  uint8_t axis = 0;            ///< number of the axis of G96, from 1; 0 = G97
  bool held = false;           ///< the speed stays as it is, whatever the axis and S do (Series 8 M59)
};

/// The mode of fine segments in force. It decides which codes may be commanded (M700 13.17; functions/fine_mode.cpp).
enum class FineMode : uint8_t {
  none,
  accuracy1,   ///< high-speed high-accuracy control I: G05.1 Q1
  accuracy2,   ///< II: G05 P10000
  smooth       ///< II with SSS control: G05 P10000 while #8090 is on
};

/// Spline G05.1 Q2 (M700 13.18; functions/spline.cpp).
struct SplineState {
  bool on = false;
  uint8_t axes = 0;          ///< bit i: axis i was named with G05.1 Q2
};

/// Between G10 of tool life and its end.
struct LifeInput {
  enum class Kind : uint8_t { none, anew, add, remove } kind = Kind::none;
  LifeMethod method = LifeMethod::time;  ///< of the tools that follow
  uint32_t group = 0;          ///< their group, 0 = not said yet
  uint32_t life = 0;
  uint8_t registered[(kLifeTools + 7) / 8] = {};  ///< a bit for each slot that has got its tool by this input
};

/// What a spline has to know of the block before.
struct SplineWay {
  bool joined = false;       ///< the block before ended so that the next one goes on smoothly
  bool moved = false;        ///< the block before was a movement, by `back`
  double back[3] = {0, 0, 0};  ///< way of the block before along the basic axes
};

/// What the end of a program leaves for a first movement of the next program that names no mode (M700 9.1, 7.2 note 1).
struct LeftByEnd {
  double feed = 0;
  Function motion = Function::rapid, feed_mode = Function::feed_per_minute;
  bool any = false;            ///< a program has ended since the last reset
};

/// Bits of State::special.
enum Special : uint8_t {
  kSpecialMap = 1,         ///< programmed coordinates are not those of the axes (AxisMap)
  kSpecialWords = 2,       ///< axis words mean something else (G16)
  kSpecialFeed = 4,        ///< F is not a plain feed per minute, or a special cutting mode is in force (interpret/feed.hpp)
  kSpecialSpline = 8,      ///< G01 goes along a spline
  kSpecialStitch = 16,     ///< lines have the feed of their length (HX 15.6)
  kSpecialMotionOff = 32    ///< axis words have no motion (CycleRules::end_is_motion)
};
// ---- the groups ---------------------------------------------------------------------------------------------------------

/// Belongs to one block and the next one: each block sets it, and nothing restores it.
struct BlockLife {
  BlockSeq seq = 0;             ///< number of blocks executed
  Repeat repeat;                ///< of the next block; its mark carries it to the stages and to control, which drop what has been executed
  bool owes_mark = false;       ///< a block has called a program, which has returned, and its mark is still to be made
  bool stop_reading = false;    ///< an M code that prohibits reading ahead stood in the block before
  bool modes_ahead = false;     ///< blocks that do not count as executed have changed `modal` since: it is not ModesInExecution::executed
};

/// Where the axes are.
struct MachinePosition {
  AxisVec machine;              ///< end of the last move, machine coordinates, without radius compensation
};

/// Belongs to the position: how much of the length compensation the moves have applied to it.
struct AppliedLength {
  AxisVec applied;              ///< tool length as applied to each axis
};

/// The modes, and the values that a mode needs as long as it is in force.
struct ModalLife {
  ModalState modal;
  double tool_length = 0;       ///< length compensation along the axis of the tool (M700 12.3)
  double length_value = 0;      ///< tool length compensation in force ...
  uint8_t length_axis = 2;      ///< ... on this axis
  int8_t plane_axis[2] = {0, 1};  ///< axes of the plane in force, -1 = none
  int8_t third_axis = 2;        ///< of the pair that lies in no plane with them the axis that the plane's code has named, or the basic one (M700 12.5)
  bool polar_angle_known = false;
  uint16_t work_system = 0;     ///< 0..5 G54..G59, 6.. G54.1 P1..
  SpeedMode high_speed = SpeedMode::off;  ///< high-speed machining that is commanded
  FineMode fine_mode = FineMode::none;
  bool accuracy_command = false;  ///< between G08 P1 and G08 P0
  uint8_t scaled = 0;           ///< bit i: axis i is scaled (M700 13.19)
  uint8_t mirror = 0;           ///< bit i: axis i is mirrored by program (M700 13.6)
  bool rotated = false;         ///< coordinates are rotated by program (M700 13.20)
  bool stitch = false;          ///< lines have the feed of their length (HX 15.6)
  SplineState spline;
  uint32_t held_point = 0;      ///< id of the point at which the axes of G07 stand (Interpreter::points)
  uint32_t stroke_box = 0;      ///< prohibited area of G22 (Interpreter::stroke_boxes), counted from 1; 0 = G23
  double polar_angle = 0;       ///< G16: angle of the block before, deg
  double polar_pole[2] = {0, 0};  ///< G16: what the radius counts from, in the plane (CoordinateRules::pole_stays)
  double thread_lead = 0;       ///< G33: mm along the long axis
  double last_feed = 0;         ///< G93: feed of the last cutting block, mm/min; a block that only displaces the tool uses it
  double arc_radius = 0;        ///< last R of an arc, mm as programmed; 0 = none yet (ArcRules::radius_is_modal)
  bool map_begins = false;      ///< a map about the zero point has come into force and the plane has not moved: ProgramMaps::start is programmed
  AxisMap map;
  MillReturn mill;
  SpindleControl spindle;
};

/// Modes that end with the program, or with the MDI text, that has commanded them.
struct ModalInProgram {
  Compensation comp;            ///< tool radius compensation in force
  CycleState cycle;
  bool motion_off = false;      ///< the end of a cycle is the motion in force (CycleRules::end_is_motion)
  uint32_t moves_since_comp_off = 1;  ///< M700 P112: a plane change right after G40 needs a move in between
  int8_t moved_side = 0;        ///< Compensation::side of the last movement; where it differs from the one in force the next movement starts or ends
                                ///< compensation
  uint32_t arc_points = 0;      ///< id of the start point of the arc in space; its middle point has the next id
  NurbsState nurbs;
  uint8_t nurbs_order = 0;      ///< order of the last curve, for a curve that begins with a knot alone
  ArcStep arc_step = ArcStep::none;
  bool parameter_input = false; ///< between G10 L70 and G11 (M700 13.11)
  bool tap_code = false;        ///< the M code that makes taps synchronous has been given out
  uint8_t switch_mirror = 0;    ///< bit i: axis i is mirrored by the switch since the program began
  uint8_t figure_scaled = 0;    ///< of `scaled` and `mirror`: commanded in the program that is being rotated (13.3.3, 13.19 (6));
  uint8_t figure_mirror = 0;    ///< they mean something in that program only
  uint16_t vacant_feed_file = 0;
  uint32_t vacant_feed = 0;     ///< number of the variable of the last F, where it was vacant and so gave no feed (M700 13.5.4); 0 = F has a value
  uint32_t vacant_feed_line = 0;  ///< line, and above file, of that F
  SplineWay spline_way;
  MeetingFirst meeting;         ///< of the block before
  SpaceVector space;            ///< three-dimensional radius compensation in force (M700 12.5), its vector as I J K say it: before mirror image and 13.21
  uint8_t space_mirror = 0;     ///< bit i: its vector stands mirrored on axis i
  uint32_t space_number = 0;    ///< the D of its code
  LifeInput life_input;
  SpaceVector moved_space;      ///< Move::space of the last movement, without a vector where it had taken it away
  bool by_hand = false;         ///< the axes stand beside the programmed end of the block before by ProgramRecords::way_by_hand (M700 12.4.4)
};

/// Belongs to the run of one program, or of one MDI text, with all programs that it calls. These are not modes, so they are not restored after an
/// interrupt program.
struct ProgramLife {
  bool end_seen = false;
  bool percent_seen = false;    ///< the start mark of the main program has been read
  bool unit_used = false;       ///< a word has counted in the unit, where it is that of the program (DGSHAPE 2-2)
  bool interrupt_on = false;    ///< M96 in force (M700 13.12: "to M97 or NC reset")
  bool interrupt_moved = false; ///< the interrupt program has moved or given out M S T B
  uint8_t interrupt_depth = 0;  ///< level of the interrupt program in service, 0 = none
  uint8_t suppressed = 0, disabled = 0;  ///< nc_suppress_bits and nc_disable_bits (M700 13.5.5): cleared by a reset
};

/// G92 S Q (M700 10.4). The speeds of the spindles are clamped where they are executed (interpolate/spindle.hpp); a synchronous tap turns its spindle by its path,
/// which has to keep the clamp from the start.
struct SpindleClamp {
  bool any = false;
  bool always = false;          ///< in G97, too
  bool has_s = false;
  uint32_t s = 0, q = 0;        ///< as programmed, r/min

  /// The highest speed of a synchronous tap, r/min; 0 = not clamped. Precaution (1): an S below Q changes places with it.
  uint32_t of_tap() const { return always && has_s ? std::max(s, q) : 0; }
};

/// What the machine has been commanded to do: it stays over an interrupt and over MDI blocks.
struct UntilReset {
  bool spindle_on = false;
  bool spindle_reverse = false; ///< as it was last turned
  SpindleClamp spindle_clamp;
  uint32_t length_handle_number = 0;  ///< number of the length along the tool to which the handle has added ...
  double length_by_handle = 0;        ///< ... this, mm (M700 12.3)
  bool length_changed_by_handle = false;  ///< since the last movement
  bool tool_angles_old = false;           ///< the machine has been told something that may have turned the tool since its angles were read
  double tool_angle[2] = {0, 0};          ///< of the tool, deg, where no axis of the part system turns it (M700 12.3 (3))
};

/// What outlives the end of a program, but not a reset by the operator (M700 9.1).
struct UntilOperatorReset {
  LeftByEnd left_by_end;
};

inline constexpr uint32_t kNoTool = ~0u;

/// The tools that the machine has, and how its spindle turns, as far as the codes tell that have gone out to it.
struct InHand {
  uint32_t called = 0;              ///< ModalState::tool
  uint32_t selected = 0;            ///< UntilPowerOff::selected_tool
  uint32_t in_spindle = kNoTool;    ///< UntilPowerOff::spindle_tool
  bool spindle_on = false, spindle_reverse = false;
};

/// What neither a program nor a reset ends.
struct UntilPowerOff {
  double clock_base[2] = {0, 0};  ///< time of the machine, ms, at which #3001 and #3002 are 0 (M700 13.5.5: only writing to them changes them)
  int64_t clock_shift_s = 0;      ///< s by which the clock of programs (#3011, #3012) is ahead of the machine's
  bool port_open = false;         ///< POPEN has been executed (M700 13.5.8)
  uint32_t selected_tool = 0;     ///< of the last T
  uint32_t spindle_tool = kNoTool;  ///< of the last tool change; kNoTool = there was none yet
  bool reads_beside_machine = false;  ///< a place to begin inside is looked for, or stood at (nc/restart.h): the codes that were read have not gone out, and the machine has ...
  InHand machine_has;                 ///< ... this
};

/// Follows from the other groups, the records and the parameters, and is kept because every block or move needs it (refresh_special, refresh_accuracy,
/// refresh_work_rotation, Interpreter::program_changed).
struct Derived {
  uint8_t special = 0;            ///< Special bits: 0 in nearly every program
  uint8_t high_accuracy = 0;      ///< bits of HighAccuracy, whichever command has switched it on (13.15)
  uint8_t modal_call = 0;         ///< CallFrame::modal_call of the program that runs
  bool mapped = false;            ///< a map of interpret/program_map.hpp is in force
  bool work_turned = false;       ///< workpiece coordinates are rotated by parameter (13.21): in the rotation commanded or in the one reached
  bool work_turn_pending = false; ///< the rotation commanded and the rotation reached differ
};

/// The open programs and loops. Only the first depth + 1 frames and loop_count loops are meaningful, and only these are copied into checkpoints.
struct CallStack {
  uint32_t codes_left = 0;      ///< bit d: the next block of level d has moved and a modal call has run behind it; only its M98 or M99 is left
  uint8_t depth = 0;
  uint8_t loop_count = 0;
  CallFrame frame[kMaxFrames];
  Loop loop[kMaxLoops];
};

/// What is shown of the block in execution (#4201, #4301 ..., M700 13.5.5). Macro statements and calls are executed together with the block before them, so
/// behind them that is still this block. It is copied into checkpoints only where it is not `modal` (BlockLife::modes_ahead).
struct ModesInExecution {
  ModalState executed;
};

/// All groups except the call stack and the modes in execution: small, of fixed size, copied at every block.
struct StateValues : BlockLife,
                     MachinePosition,
                     AppliedLength,
                     ModalLife,
                     ModalInProgram,
                     ProgramLife,
                     UntilReset,
                     UntilOperatorReset,
                     UntilPowerOff,
                     Derived {};

/// It has no members of its own: each member is in exactly one group (tests/interpret/lifetimes_test.cpp).
struct State : StateValues, CallStack, ModesInExecution {
  /// Radius compensation is in force, in the plane or in space.
  bool compensated() const { return comp.side != 0 || space.on; }
  uint8_t any_mirror() const { return mirror | switch_mirror; }
  void refresh_special() {
    const bool feed = modal.is(Function::inverse_time_feed) || modal.is(Function::feed_per_revolution) || modal.feed_digit != 0 ||
                      modal.is(Function::corner_override) || modal.is(Function::tapping_mode);
    special = static_cast<uint8_t>((map.active() ? kSpecialMap : 0) | (modal.is(Function::polar_command_on) ? kSpecialWords : 0) |
                                   (feed ? kSpecialFeed : 0) | (spline.on ? kSpecialSpline : 0) | (stitch ? kSpecialStitch : 0) | (motion_off ? kSpecialMotionOff : 0));
  }
  void refresh_accuracy() {
    const bool on = modal.is(Function::high_accuracy_mode) || accuracy_command || fine_mode != FineMode::none;
    high_accuracy = static_cast<uint8_t>((on ? kHighAccuracyOn : 0) | (fine_mode > FineMode::accuracy1 ? kFineSegmentsOn : 0));
  }
};
// The call stack lies behind the values without a gap, so that a checkpoint copies the values and the frames in use in one piece.
static_assert(sizeof(State) == sizeof(StateValues) + sizeof(CallStack) + sizeof(ModesInExecution) && alignof(CallStack) == alignof(State));

}  // namespace nc
