// SPDX-License-Identifier: Apache-2.0
// The tables of the fixed cycles (M700 13.1.1, RS-274/NGC 3.5.16): a cycle is a row of strokes, one for each number of the manual's figure but
// for (1), which takes the axes of the plane over the hole and is the same in all of them.
#pragma once

#include <cstdint>

namespace nc {

/// The cycles there are. Which code means which of them is the family's (Dialect::cycles).
enum class CycleKind : uint8_t {
  none,
  drill,              ///< down with the feed, back in rapid
  spot,               ///< with a dwell at the bottom
  peck,               ///< in cuts, each with a return to R
  step,               ///< in cuts, each with a way back that breaks the chip
  tap, reverse_tap,   ///< the spindle turns back behind the dwell
  peck_tap, peck_reverse_tap,   ///< in cuts, each with a way back by the clearance
  deep_tap, deep_reverse_tap,   ///< in cuts, each with a return to R
  circle,             ///< a circle around the hole at the bottom
  fine_bore,          ///< back beside the wall, the spindle oriented
  bore_feed,          ///< back with the feed
  bore_stop,          ///< back with the spindle stopped
  back_bore,          ///< from below
  bore_waits_for_hand, ///< the program stops at the bottom with the spindle stopped; what the hand has left of the way back is made in rapid
  bore_by_hand,       ///< a place where single block stops at the bottom, with the spindle stopped
  bore_dwell,         ///< a dwell at the bottom, back with the feed
  // RS-274/NGC 3.5.16, where the same names have other strokes.
  tap_by_direction, reverse_tap_by_direction,   ///< the spindle turns back in front of the dwell
  bore_stop_as_before,                          ///< the spindle turns again as it has turned
  back_bore_to_level,                           ///< cut to a third level and back
  bore_left_by_hand,                            ///< the program stops at the bottom; the operator draws the tool back
  // Series 8
  case_bore,                                    ///< the tool stays at the bottom; the next layer begins at another R
  bore_oriented,                                ///< back beside the wall, the spindle oriented, behind a dwell
  face_upwards,                                 ///< from below, with a dwell and a way back to R
  count_
};

enum class StrokeKind : uint8_t {
  rapid, feed,               ///< along the drilling axis to a level
  shift_rapid, shift_feed,   ///< in the plane: to the place beside the hole, or over it (Level::over)
  circle_in, circle, circle_out,   ///< in the plane: half a circle from the centre, a circle, half a circle back
  dwell,
  spindle,                   ///< an M code of the spindle
  program_stop,
  again                      ///< on with the first stroke that cuts
};

/// Along the drilling axis, as most strokes go.
constexpr bool goes_along(StrokeKind kind) { return kind == StrokeKind::rapid || kind == StrokeKind::feed; }

/// Where a stroke goes.
enum class Level : uint8_t {
  none,
  r, bottom, third,      ///< as the words say; the third is that of a cut back to the bottom
  exit,                  ///< R or the initial level, by the mode
  initial,
  peck,                  ///< the next peck deeper, the bottom at most
  above_peck,            ///< the clearance above the bottom of the last peck, R at most
  back_from_peck,        ///< the clearance back from there
  beside, over           ///< of the hole, in the plane
};

/// What the M code of a stroke makes of the spindle.
enum class CycleSpindle : uint8_t { none, forward, reverse, stop, orient, as_before };

enum StrokeFlag : uint8_t {
  kStrokeStops = 1,     ///< single block stops behind it; behind the last stroke it is the end of the block
  kWhilePecking = 2,    ///< only where the bottom has not been reached
  kStrokeReturns = 4,   ///< the return that ,J belongs to
  kStrokeTaps = 8,      ///< tapping: at 100 %, and a hold waits until the tool is at R again
};

struct Stroke {
  StrokeKind kind;
  Level to = Level::none;
  CycleSpindle spindle = CycleSpindle::none;
  uint8_t flags = 0;
};

struct CycleTable {
  const Stroke* stroke;
  uint8_t count;
  bool takes_widths;   ///< ,I and ,J hold (M700 13.1.1, "programmable in-position width command in fixed cycle")
  bool pecks;          ///< it wants the depth of a cut
  bool shifts;         ///< it goes beside the hole
  bool moves_in_plane; ///< it does that, or goes round in the hole
  bool turns_spindle;  ///< it has M codes of the spindle
  bool restarts;       ///< one of them is that of the direction in which the spindle turned before
  bool leaves_rapidly; ///< it goes to its exit in rapid traverse
};

struct CycleTables {
  CycleTable of[static_cast<unsigned>(CycleKind::count_)];
};
extern const CycleTables kCycleTables;

inline const CycleTable& strokes_of(CycleKind kind) { return kCycleTables.of[static_cast<unsigned>(kind)]; }

constexpr bool is_tap(CycleKind kind) {
  switch (kind) {
    case CycleKind::tap:
    case CycleKind::reverse_tap:
    case CycleKind::peck_tap:
    case CycleKind::peck_reverse_tap:
    case CycleKind::deep_tap:
    case CycleKind::deep_reverse_tap:
    case CycleKind::tap_by_direction:
    case CycleKind::reverse_tap_by_direction: return true;
    default: return false;
  }
}
/// A tap with the spindle in reverse.
constexpr bool taps_left_hand(CycleKind kind) {
  return kind == CycleKind::reverse_tap || kind == CycleKind::peck_reverse_tap || kind == CycleKind::deep_reverse_tap ||
         kind == CycleKind::reverse_tap_by_direction;
}

}  // namespace nc
