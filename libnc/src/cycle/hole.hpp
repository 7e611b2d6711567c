// SPDX-License-Identifier: Apache-2.0
// One hole of a fixed cycle: what is known of it, and its strokes one after the other (cycle/stroke.hpp). It is asked for one stroke at a time, so
// a cycle with ten thousand pecks takes no more memory than a plain hole.
#pragma once

#include "cycle/stroke.hpp"
#include "stream/stream.hpp"

namespace nc {

/// Whether a tap goes with the angle of the spindle, as its block says.
enum class TapControl : uint8_t { by_parameter, floating, synchronous };

/// Hole data, modal while the cycle is (M700 13.1.1). Lengths mm in the active workpiece coordinates.
struct CycleState {
  CycleKind kind = CycleKind::none;
  uint8_t drill_axis = 2;
  bool has_z = false, has_r = false, has_p = false;
  double z = 0;              ///< bottom as commanded: coordinate (absolute) or distance from R (incremental)
  double r = 0;              ///< R point as commanded: coordinate or distance from the initial level
  bool z_incremental = false, r_incremental = false;
  double q = 0;              ///< cut of one peck, shift, or radius of a circle: a length with its sign
  double tap_q = 0;          ///< cut of a tap that is made in several, > 0
  double p = 0;              ///< time at the bottom as programmed, or the number of an offset
  double shift[3] = {0, 0, 0};  ///< beside the hole, along the basic axes
  double third = 0;          ///< third level as commanded ...
  bool has_third = false, third_incremental = false;
  double in_position = 0;    ///< ,J: in-position width behind the return from the bottom, mm; 0 = by the parameters
  double initial_level = 0;  ///< level of the drilling axis when the cycle was commanded, machine coordinates without tool length: a
                             ///< shift of the coordinates in the cycle mode (M700 13.1.2, 13.1.3) does not move it
  TapControl tap = TapControl::by_parameter;
  bool synchronous = false;  ///< what follows from it and the parameters for the cycle in force
  int8_t returned = 0;       ///< the tool has come back from a hole along the drilling axis in this direction, 1 or -1; 0 = it has not
  bool has_first = false;    ///< the first cut has an end of its own ...
  double pitch = 0;          ///< of a synchronous tap, mm/rev; 0 = none yet
  double return_speed = 0;   ///< ,S: of the spindle on the way back of a synchronous tap, r/min; 0 = that of the way in
  double first = 0;          ///< ... at this coordinate
  bool in_hole = false;      ///< the tool has stayed at the bottom of a hole, out of which leads the way by ...
  double way_out = 0;        ///< ... R of its first layer, as initial_level
};

/// What a hole needs, resolved to coordinates of the drilling axis.
struct Hole {
  CycleKind kind = CycleKind::none;
  bool synchronous = false;                ///< the spindle is turned by the tap, not by M codes
  double initial = 0, r = 0, bottom = 0, third = 0;   ///< coordinates
  double return_to = 0;                    ///< initial level or R point (G98, G99)
  double q = 0;                            ///< > 0 where it is made in cuts
  bool has_first = false;                  ///< the first of them ends ...
  double first = 0;                        ///< ... at this coordinate
  double clearance = 0;                    ///< of the cuts: #8013, #8012, DGSHAPE 1 mm
  double dwell_s = 0;                      ///< at the bottom
  double dwell_at_r_s = 0;                 ///< of a tap, where it has come back to R
};

/// The hole is made downwards. So is one without a depth: the tool comes to it from above (LinuxCNC G81 takes a bottom that is R).
inline bool cuts_down(const Hole& hole) { return hole.bottom <= hole.r; }

/// One stroke of a hole, with numbers.
struct CycleStep {
  StrokeKind kind = StrokeKind::dwell;
  Level level = Level::none;
  CycleSpindle spindle = CycleSpindle::none;
  uint8_t flags = 0;    ///< StrokeFlag
  double to = 0;        ///< coordinate of the drilling axis
};

/// Execution through one hole; trivially copyable.
struct HoleProgress {
  uint32_t row = 0;
  double depth = 0;     ///< bottom reached so far (coordinate), pecks
};

/// How long the dwell of a stroke is that has this level, s.
double dwell_of(const Hole& hole, Level level);
HoleProgress begin_strokes(const Hole& hole);
/// The next stroke of the hole; false: it is done. Positioning in the plane has been done before. Strokes that do nothing (a dwell without time)
/// are left out.
bool next_stroke(const Hole& hole, HoleProgress& progress, CycleStep* step);

}  // namespace nc
