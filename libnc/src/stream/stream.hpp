// SPDX-License-Identifier: Apache-2.0
//
// THE STREAM: the contract between the stages of libnc. Read this header first; everything else fills it.
//
//   text -> block -> [interpret] -> ITEMS -> [contour] -> [fairing] -> [offset] -> [space] -> [commit] -> ring -> [motion plan] -> [interpolate] -> set-points
//
// Everything that a program causes is an Item in one ordered stream. There are seven kinds:
//
//   move    a curve in the *compensation frame* (active workpiece coordinates, after scaling and rotation, before tool radius
//           compensation) and the id of the affine map (frame/affine.hpp) that leads from there to machine coordinates
//   action  something the world sees at this point and not when the text is read: M S T B, a macro output, a message
//   gate    wait here: FIN, dwell, in-position, program stop
//   sync    the interpreter cannot go on without a value that exists only when everything before this has happened
//   mark    a block has ended; carries the modal snapshot and whether single block may stop here
//   alarm   the program stops here
//   end     the last item
//
// What the stages do with them
//   interpret  makes items, one block at a time. After a sync it makes nothing until it is answered.
//   contour    holds a move back whose end only a later block settles (,C ,R, blocks that meet) until that block is there.
//   fairing    leaves out protruding lines of high-speed high-accuracy control II and moves the ends of their neighbours; judges corners.
//              Holds a row of lines back with the marks between; any other item closes the row.
//   offset     replaces the geometry of moves by their compensated geometry and may insert moves. It holds items back while it
//              looks ahead, never reorders them, and closes its contour perpendicular when it meets an item for which
//              `inhibits_read_ahead` is true, because nothing beyond such an item can be waited for.
//   space      ends a move beside its programmed end by the vector that it carries (M700 12.3, 12.5).
//              These four stand in a row (control/stage_row.hpp). Each may hold items; a mark that is given out brings with it what each
//              of them needs to go on right behind it.
//   commit     gives every item its serial, applies the transform, checks the stroke limits, and hands it to the sink: nc_pull()
//              offline, the ring of the executor online. From here on an item never changes.
//
// Serials are given at commit: strictly increasing, without gaps, so an offline sink and the machine name the same item by the
// same number. "The block in execution" is the serial that the interpolator has reached.
//
// Reading ahead is a bet that can be lost. The interpreter's state is one copyable value (interpret/state.hpp). Each mark stores
// a checkpoint of it; writes to variables are journalled under the block that made them (macro/journal.hpp).
// rewind(mark) restores the checkpoint and undoes the journal; resync(positions) goes on from where the machine really is.
// Nothing beyond a sync has ever been read when it is answered, so checkpoints never reach across one.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "alarm/fault.hpp"
#include "nc/item.h"

namespace nc {

inline constexpr unsigned kMaxAxes = NC_MAX_AXES;
/// Most part systems have no more axes than this. What is done for every move has a form for them that takes half of the time, for all axes at once: those that a part
/// system does not have are always 0.
inline constexpr unsigned kFewAxes = 4;

/// One value per axis of a part system, mm or degrees, in configuration order.
struct AxisVec {
  double v[kMaxAxes] = {};
  double& operator[](unsigned i) { return v[i]; }
  double operator[](unsigned i) const { return v[i]; }
  bool operator==(const AxisVec&) const = default;
};

using Serial = uint64_t;      ///< number of an item, given at commit; 0 = none
using BlockSeq = uint64_t;    ///< number of a block in the order in which the interpreter executes them; journal and checkpoints are ordered by it
using TransformId = uint32_t; ///< number of an affine map (frame/affine.hpp) in the pool of the part system
using ModalId = uint32_t;     ///< number of an interned modal snapshot
using SettingsId = uint32_t;  ///< number of interned MotionSettings (interpret/motion_settings.hpp)

enum class ItemKind : uint8_t { move, action, gate, sync, mark, alarm, end };

/// How tool radius compensation acts on a move. side 0 = the move is not compensated.
struct Compensation {
  int8_t side = 0;         ///< +1 left of the direction of travel (G41), -1 right (G42); 0 off
  bool transparent = false;  ///< the vectors in the plane are taken away for this move and come back after it (G28, G53, G33): M700 12.4.2
  bool has_vector = false; ///< G41/G42/G38 with I J K: `vector` is the direction given, no intersection is computed
  bool hold_vector = false;  ///< G38: keep the vector at the end of the move before
  bool corner_arc = false; ///< G39
  bool type_b = false;     ///< start and cancel type B (M700 #1229 bit 2, DGSHAPE startup)
  bool cancel_vector = false; ///< G40 with I J K: `vector` is the hypothetical direction
  bool check = false;      ///< interference check on (M700 12.4.8: #8103 OFF); false: paths may cross
  bool walls = false;      ///< with `check`: the path keeps off the blocks around it as well (offset/walls.hpp)
  bool avoid = false;      ///< with `check`: go round instead of the alarm (M700 #8102 ON)
  bool square_in_spike = false;  ///< an inner corner of a degree or less has no intersection but two vectors at right angles (DGSHAPE G40 to G42)
  uint8_t axis[2] = {0, 1};  ///< plane: first (h) and second (v) axis, right-handed
  float arc_cos = 0;       ///< not 0: an outer corner with a turn whose cosine is below this is gone round on an arc, any other to the intersection
  double radius = 0;       ///< mm, signed as in the table
  double vector[2] = {0, 0};
  /// How far a straight move begins beside its programmed start, mm, because the axes were moved by hand there. It has the direction of the programmed line,
  /// so that the tool is on its path again where the line ends (M700 12.4.4).
  double by_hand[2] = {0, 0};
};

/// The axes stand beside the programmed path because they were moved by hand.
inline bool stands_beside(const Compensation& comp) { return comp.by_hand[0] != 0 || comp.by_hand[1] != 0; }

/// How far beside its programmed end a move ends in space: the vector of three-dimensional radius compensation (M700 12.5), or of a length along
/// the axis of the tool (12.3). offset/space.hpp adds it.
struct SpaceVector {
  bool on = false;             ///< such a mode is in force; else the move leads back from the vector before it
  bool turns = false;          ///< it goes by the rotary axes (12.3)
  uint8_t axis[3] = {0, 1, 2};
  double v[3] = {0, 0, 0};     ///< mm, along these axes of the compensation frame
  bool operator==(const SpaceVector&) const = default;
};

/// An arc with less than this from its centre begins or ends in it: a tenth of the smallest command unit there is, far above what
/// rounding leaves of two equal positions.
inline constexpr double kNoRadius_mm = 1e-7;

/// By how much the two radii of an arc differ; without end where one is none.
inline double circle_apart(double radius_start, double radius_end) {
  return radius_start >= kNoRadius_mm && radius_end >= kNoRadius_mm ? std::abs(radius_start - radius_end) : std::numeric_limits<double>::infinity();
}
/// By so much two radii that agree within the tolerance may be computed to differ.
inline constexpr double kRadiusRounding_mm = 1e-9;

/// Geometry of a move on the plane (h, v) = plane_axis; all other axes go linearly along.
struct Circle {
  double center[2] = {0, 0};
  double radius_start = 0, radius_end = 0; ///< differ by at most the arc tolerance (M700 #1084)
  double angle_start = 0;                  ///< rad, atan2(v, h) of start - center
  double sweep = 0;                        ///< rad, counter-clockwise positive, full extra turns included
};

enum class Plane : uint8_t { xy = NC_PLANE_XY, zx = NC_PLANE_ZX, yz = NC_PLANE_YZ, none = NC_PLANE_NONE };

/// What decides the feed of a move in addition to the number F; all zero for the plain feed per minute.
struct FeedRule {
  uint8_t digit = 0;           ///< n + 1: commanded as Fn of one digit (M700 7.3)
  bool inverse_time = false;   ///< G93: the time of the block stays as it is compensated (M700 7.5)
  bool tapping = false;        ///< G63 and the cuts of a tap: the override is 100 % (M700 7.11, 13.1.1)
  bool check_reversal = false; ///< no axis turns round at its start at speed (M700 7.9.2)
  double scale = 0;            ///< of the compensated path, so that the time or the cut keeps its speed; 0 = 1
  float digit_most = 0, digit_step = 0;  ///< F1 to F5: limit of the handle, change by one pulse of it, mm/min
  float corner_override = 0;   ///< G62: factor before an inner corner (M700 7.10), 0 = none
  float corner_angle = 0;      ///< at corners that are sharper than this, rad
  float slow_zone = 0;         ///< over this length before the end, which is such a corner, mm
  float corner_reach = 0;      ///< the same for a corner at the end of a block behind, mm
  float behind_zone = 0;       ///< G62: over this length behind such a corner as well, mm (HX 5.3.5)
  float inner_arc = 0;         ///< an arc that the tool cuts from the inside is slower by the ratio of its radii, not below this (HX 5.3.6); 0 = it is not
};

/// Feeds that the skip signals of a G31 change to (M700 15.5). Only one such move is under way at a time, because a sync follows it.
struct SkipSpeeds {
  static constexpr unsigned kSignals = 8;
  uint8_t mask = 0;                  ///< signals that change the feed, bit n = signal n+1
  double feed_mm_min[kSignals] = {};
};

/// Which functions of M700 13.15 and 13.17 are on for a move: bits.
enum HighAccuracy : uint8_t { kHighAccuracyOn = 1, kFineSegmentsOn = 2 /**< high-speed high-accuracy control II */ };

/// A corner at the end of a block, whose geometry only the next movement decides: contour/ holds such a move back until then.
enum class Corner : uint8_t {
  none,
  chamfer,  ///< ,C (M700 13.7.1)
  rounding, ///< ,R (M700 13.7.2)
  meet,     ///< ends where the movement behind begins, if that one meets it (Move::meets, M700 13.9); otherwise it goes as it stands
  meet_by_radius  ///< the same of an arc of a radius, without a centre: radius_start (negative: the longer way round), the sense of its sweep
};

struct Move {
  Move() = default;
  Move(const AxisVec& from, const AxisVec& to, const Compensation& c) : start(from), end(to), work(to), comp(c) {}

  nc_move_kind kind = NC_MOVE_LINE;
  bool circular = false;
  bool exact_stop = false;       ///< at rest at its end: rapid, G09/G61, and where the dialect says so
  bool connecting = false;       ///< inserted by a stage (corner of a compensated contour), not programmed
  uint8_t skip_mask = 0;
  bool skip_away = false;        ///< skip: ends where these signals are off
  bool inch = false;             ///< the last digit of its words is a ten-thousandth of an inch, not a thousandth of a millimetre
  const SkipSpeeds* skip_speeds = nullptr; ///< skip: signals that change its feed (M700 15.5); nullptr in nearly every move
  uint32_t stroke_box = 0;       ///< id of the prohibited area in force, counted from 1; 0 = none (M700 15.7)
  Plane plane = Plane::none;     ///< plane of a circular move, and of a line with a rounding at its end
  uint8_t plane_axis[2] = {0, 1};  ///< first and second axis of that plane
  bool plane_feed = false;       ///< helix: the feed is the speed in the plane of its arc (M700 6.6)
  uint8_t unclamps = 0;          ///< bit i: axis i of an index table is unclamped meanwhile, for the move behind (M700 9.3 (3))
  uint8_t high_accuracy = 0;     ///< corners and arcs by the rules of high-accuracy control: bits of HighAccuracy
  float judged_turn = -1;        ///< |change of direction| that the corner at its start counts as (M700 #8036); negative: its own
  Corner corner = Corner::none;  ///< at its end; the plane of a rounding is `plane`, `plane_axis`
  double corner_mm = 0;          ///< of the chamfer its legs, of the rounding its radius, > 0; meet: > 0 where nothing is left of it if nothing meets it
  bool meets = false;            ///< the move before, which is pending, ends where this one begins
  bool flows = false;            ///< rapid traverse: the path goes on at speed where what is behind begins with its direction
  bool leaves = false;           ///< leads to a place of the machine, which is no part of a compensated contour: no corner is made in front of it
  bool leads_space = false;      ///< goes nowhere by itself: it is made for the way from one vector in space to another (M700 12.3, 12.5)
  bool leaves_space = false;     ///< it goes without the vectors in space (M700 12.3, 12.5), as one to a place of the machine does
  SettingsId settings = 0;       ///< parameters as they were when the move was made: stages and commit go by them alone
  TransformId transform = 0;
  uint32_t shape = 0;            ///< number of its MoveShape, counted from 1; 0 = the move is just the line or circle below
  AxisVec start, end;            ///< compensation frame; after the offset stage: of the compensated path
  AxisVec work;                  ///< programmed end point, in the same frame; the offset stage does not change it
  double work_center[2] = {0, 0};  ///< circular: programmed centre; the offset stage does not change it
  Circle circle;                 ///< circular only
  double feed_mm_min = 0;        ///< 0 = rapid
  double feed_mm_rev = 0;        ///< feed per revolution; 0 = the feed is per minute
  float feed_end = 0;            ///< exponential: feed at its end, mm/min; 0 = constant
  float thread_angle = 0;        ///< thread: start angle of the spindle, deg
  float tap_rev_min = 0;         ///< synchronous tap: speed of the spindle for it, forward positive; the feed per revolution is its lead
  float tap_slope = 0;           ///< highest acceleration of the spindle for it, rev/s^2; 0 = what the axes bear
  FeedRule rule;
  float speed_clamp = 0;         ///< highest speed whatever the feed and the override are, mm/s; 0 = none
  Compensation comp;
  SpaceVector space;
};

/// What an M code commands the selected spindles to do; stop_all, for the end of a program, concerns all spindles.
enum class SpindleTurn : uint8_t { as_it_is, forward, reverse, stop, stop_all };

struct Action {
  nc_action_kind kind = NC_ACTION_M;
  char letter = 0;
  SpindleTurn turn = SpindleTurn::as_it_is;  ///< NC_ACTION_M
  bool program_flow = false;  ///< NC_ACTION_M: it stops or ends the program, which an auxiliary lock does not prevent
  bool changes_tool = false;  ///< NC_ACTION_M: it brings the tool of the last T into the spindle
  double value = 0;
  uint32_t mask = 0, bits = 0, index = 0, text = 0;
};

struct Gate {
  nc_gate_kind kind = NC_GATE_FIN;
  bool announce = false;
  double value = 0;
  uint8_t skip_mask = 0;  ///< dwell: ends where one of these signals is on (M700 8.1 (8))
  bool behind_mdi = false;  ///< stop: blocks of MDI that interrupt a program have ended (M700 12.4.4)
  bool begins_again = false;  ///< stop: the program is begun inside, and the axes have to be where it goes on (nc/restart.h)
};

struct Sync {
  uint32_t what = 0;  ///< nc_sync_what bits
  /// A read in a contour whose next corner needs the blocks behind it: a stage that waits for them lets it pass in front of what it holds.
  bool ahead = false;
  uint8_t axis[2] = {0, 1};   ///< ... and says here what it adds to the end of what has been read, on these axes: the radius vector,
  double vector[2] = {0, 0};  ///< mm, compensation frame
};

/// A block that a macro interrupt has cut and that goes on: what has been executed of it is not executed again (M700 13.12).
struct Repeat {
  bool active = false;
  uint16_t items = 0;   ///< number of items of that block that have been executed
};

/// The length that is compensated along the axis of the tool behind a block (M700 12.3).
struct LengthAlongTool {
  uint32_t number = 0;  ///< of its amount; 0 = there is none
  double by_handle = 0; ///< what the handle has added to that amount, mm
};

struct Mark {
  AxisVec work;                  ///< programmed position at the end of the block, active workpiece coordinates
  ModalId modal = 0;
  BlockSeq seq = 0;              ///< with `resume`: number of the checkpoint here
  TransformId transform = 0;     ///< the map in force at the end of the block
  bool stop = true, report = true;  ///< as in nc_mark
  bool resume = true;            ///< the blocks that follow can be read again from here: it is the end of a block, or a call that has been entered
  bool again = false;            ///< M99 of the main program: the next block is the first one of the program
  Repeat repeat;                 ///< of the block that follows
  uint32_t place = 0;            ///< number, from 1, under which the stages keep what they need behind this mark (StageRow); 0 = nothing is kept
  bool of_call = false;          ///< of a block that has called a program: what stands between it and the mark before is that program
  bool aside = false;            ///< of a block of MDI in a block stop, or of an interrupt program: it is none of the program
  bool beside = false;           ///< the axes stand beside the programmed end, because a corner was cut: a macro interrupt waits for a later block end
  LengthAlongTool along_tool{};
};

/// Rule of a stage that needs no parameters (StageRow).
struct NoRule {};

struct End {
  AxisVec work;
  ModalId modal = 0;
  bool ok = false;
  LengthAlongTool along_tool{};  ///< of blocks of MDI, whose modes stay for those that follow (M700 5.1)
};

struct Item {
  ItemKind kind = ItemKind::mark;
  nc_source source{};
  /// For the offset stage: the item ends a block that counts for its look-ahead, also one without movement in the plane or an M00 (M700 12.4.2).
  bool block_end = false;
  /// A stroke of a hole, or what belongs to it: a macro interrupt of type 1 acts behind the hole (M700 13.12).
  bool in_hole = false;
  union {
    Move move;
    Action action;
    Gate gate;
    Sync sync;
    Mark mark;
    Fault alarm;
    End end;
  };
  Item() : mark() {}
};

/// True when the stages must not wait for anything that comes after this item (M700 9.1 "pre-read inhibit").
inline bool inhibits_read_ahead(const Item& item) {
  switch (item.kind) {
    case ItemKind::sync:
    case ItemKind::alarm:
    case ItemKind::end: return true;
    // The last block of MDI meets the program that goes on behind it.
    case ItemKind::gate: return (item.gate.kind == NC_GATE_STOP && !item.gate.behind_mdi) || item.gate.kind == NC_GATE_OPTIONAL_STOP;
    default: return false;
  }
}

}  // namespace nc
