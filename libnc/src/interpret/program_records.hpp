// SPDX-License-Identifier: Apache-2.0
// What a program leaves for later blocks and is too large for the state, which is copied at every block, or is a number that the program counts,
// puts out or reads back. Each write is journalled under the block that made it (macro/journalled.hpp), so that a rewind takes it back.
//
// The records stand in groups by what they outlive, like the state (interpret/state.hpp, where the columns are explained):
//
//   group                over M98,   interrupt   next text   M02, M30,    reset by the   power off
//                        G65, M99    and M99     of MDI      next start   operator
//   ProgramRecordsLife      yes          -           -           -            -             -
//   MapRecordsLife          yes       RETURNS       yes          -            -             -
//   MachineRecordsLife      yes          -          yes         yes          yes            -
//
// Whether a figure or a modal call is in force is told by its call frame (CallFrame), whether an interrupt, a map, a mirror or a way by hand is, by the state.
// The intermediate points of G28 end with the program where the family says so (ReferenceRules::forgets_with_program). What has to outlast power off
// is stored and given back by the host (nc/control.h).
#pragma once

#include <type_traits>

#include "base/optional_double.hpp"
#include "cycle/pattern.hpp"
#include "frame/stroke_box.hpp"
#include "frame/tool_life.hpp"
#include "interpret/state.hpp"
#include "macro/journalled.hpp"
#include "macro/variables.hpp"
#include "nc/types.h"
#include "program/store.hpp"

namespace nc {

inline constexpr unsigned kModalCalls = 8;

/// A modal macro call: by G66, G66.1, or a registered code that calls in the same way (M700 13.5.1).
struct ModalCall {
  ProgramRef program;
  uint32_t repeats = 0;             ///< L
  bool every_block = false;         ///< true: as G66.1; false: as G66
  bool by_code = false;             ///< commanded by a registered code
  uint8_t below = 0;                ///< slot, from 1, of the call that was in force before; 0 = none
  uint8_t depth = 0;                ///< call level of the program that commanded it
  OptionalDouble argument[kLocals]; ///< values for #1 to #33
  bool operator==(const ModalCall&) const = default;
};

/// A pattern at whose places the modal call in force calls its macro (M700 13.2, 13.5.1): what the words of its block have said before the first of them.
struct PlacesOfCalls {
  HolePattern pattern;
  AxisVec at;                    ///< its reference point as programmed
  uint8_t axis[2] = {0, 1};      ///< of the plane
  bool operator==(const PlacesOfCalls&) const = default;
};

/// A figure that is rotated pass by pass, in the plane in force (M700 13.3.3).
struct Figure {
  double center[2] = {0, 0};
  double start[2] = {0, 0};  ///< start point of pass 1
  double step = 0;           ///< angle from pass to pass, rad; 0 = pass 1 has not ended
  double angle = 0;          ///< angle of the pass under way, rad
  bool operator==(const Figure&) const = default;
};

/// The program of M96 (M700 13.12).
struct InterruptProgram {
  ProgramRef program;
  uint64_t begin = 0;  ///< byte offset of its first block
  uint32_t begin_line = 0;  ///< line of that block
  bool operator==(const InterruptProgram&) const = default;
};

/// Where the maps of the program are centred, and how much they scale and turn.
struct ProgramMaps {
  AxisVec mirror_center;                ///< M700 13.6
  AxisVec scaling_center;               ///< 13.19
  AxisVec scaling_factor;
  double rotation_center[2] = {0, 0};   ///< 13.20: workpiece coordinates
  double rotation_deg = 0;
  double start[2] = {0, 0};             ///< programmed position in the plane when the newest map about the zero point began
  bool operator==(const ProgramMaps&) const = default;
};

/// Mirror image by switch: where each axis stood when the program began, machine coordinates.
struct SwitchMirror {
  AxisVec center;
  bool operator==(const SwitchMirror&) const = default;
};

/// How far axes stand beside the programmed end of the block before, because they were moved by hand in a block stop with manual absolute on (M700 12.4.4). An
/// absolute word of an axis ends it (interpret/by_hand.hpp).
struct WayByHand {
  AxisVec beside;
  bool operator==(const WayByHand&) const = default;
};

/// What a macro has selected to read next; 0 = nothing yet.
struct Selection {
  uint32_t parameter[3] = {0, 0, 0};  ///< #100000: number, part, axis (M700 10.16)
  uint32_t device[4] = {0, 0, 0, 0};  ///< #100100: device, number, bytes, bit (10.17)
  uint32_t tool_group = 0;            ///< #60000 (10.15)
  bool operator==(const Selection&) const = default;
};

/// Rotation of the workpiece coordinate systems about a point of the machine (M700 13.21).
struct WorkTurn {
  double deg = 0;
  double center[2] = {0, 0};      ///< machine coordinates
  int32_t axis[2] = {-1, -1};     ///< -1 = the machine has no axis with the name in the parameter
  bool turns() const { return deg != 0; }
  bool has_plane() const { return axis[0] >= 0 && axis[1] >= 0 && axis[0] != axis[1]; }
  bool operator==(const WorkTurn&) const = default;
};
struct WorkTurns {
  WorkTurn commanded;  ///< the rotation that the parameters command
  WorkTurn reached;    ///< the rotation that the axes have reached
  bool operator==(const WorkTurns&) const = default;
};

/// The intermediate point of the newest G28 or G30 of each axis.
struct ReferenceMidpoints {
  OptionalDouble axis[kMaxAxes];
  bool operator==(const ReferenceMidpoints&) const = default;
};

/// What the newest wait for an input has found (LinuxCNC M66, #5399): the input, or -1 where it did not come.
struct InputAnswer {
  double value = 0;
  bool operator==(const InputAnswer&) const = default;
};

/// The shift that G92.2 has taken away, for G92.3 (LinuxCNC G92).
struct ShiftKept {
  AxisVec at;
  bool operator==(const ShiftKept&) const = default;
};

/// The area that the newest G22 has given, where the family keeps it (CoordinateRules::stroke_check_needs_area).
struct StoredArea {
  StrokeBox box;
  bool operator==(const StoredArea&) const = default;
};

/// Where the newest G31 has ended, workpiece coordinates (#5061).
struct SkipPosition {
  AxisVec work;
  bool touched = false;         ///< the signal has come
  bool operator==(const SkipPosition&) const = default;
};

/// A word of the outputs of the macro interface (#1100, #1132) after the blocks that were read so far.
struct InterfaceOutput {
  uint32_t bits = 0;
  bool operator==(const InterfaceOutput&) const = default;
};

/// Workpieces (#3901, #3902, M700 10.13).
struct WorkpieceCounts {
  int32_t count[2] = {0, 0};  ///< machined, maximum
  bool operator==(const WorkpieceCounts&) const = default;
};

/// The tools with a managed life that a part system uses (frame/tool_life.hpp). Without a slot the life of that tool is not managed.
struct ToolsInUse {
  RegisteredTool spindle;
  RegisteredTool selected;  ///< by T
  bool cutting = false;                  ///< the tool in the spindle has cut in the move before
  bool operator==(const ToolsInUse&) const = default;
};

// ---- the groups ------------------------------------------------------------------------------------------------------------------

struct ProgramRecordsLife {
  ModalCall modal_call[kModalCalls];  ///< slot n is element n - 1
  PlacesOfCalls places[kMaxFrames];   ///< of the block under way in the program of each call level
  Figure figure;
  InterruptProgram interrupt;
  SwitchMirror switch_mirror;
  Selection selection;
  WorkTurns work_turn;
  WayByHand way_by_hand;
  bool operator==(const ProgramRecordsLife&) const = default;
};

struct MapRecordsLife {
  ProgramMaps maps;
  bool operator==(const MapRecordsLife&) const = default;
};

struct MachineRecordsLife {
  ReferenceMidpoints midpoints;
  SkipPosition skip;
  InterfaceOutput output[NC_WORDS];
  WorkpieceCounts workpieces;
  InputAnswer answer;
  ShiftKept shift_kept;
  StoredArea area;
  ToolsInUse tools;
  bool operator==(const MachineRecordsLife&) const = default;
};

/// All records; each is in exactly one group (tests/interpret/lifetimes_test.cpp).
struct ProgramRecords : ProgramRecordsLife, MapRecordsLife, MachineRecordsLife {};
static_assert(std::is_trivially_copyable_v<ProgramRecords>);

}  // namespace nc
