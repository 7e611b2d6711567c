// SPDX-License-Identifier: Apache-2.0
// Standard fixed cycles (M700 13.1.1, DGSHAPE G80-G89): each a small generator of moves. It is asked for one step after the other,
// so a peck cycle with ten thousand pecks takes no more memory than a plain hole.
#pragma once

#include "stream/stream.hpp"

namespace nc {

enum class CycleKind : uint8_t { none, drill, spot, peck, step, bore_feed, bore_dwell };

/// Hole data, modal while the cycle is (M700 13.1.1). Lengths mm in the active workpiece coordinates.
struct CycleState {
  CycleKind kind = CycleKind::none;
  uint8_t drill_axis = 2;
  bool has_z = false, has_r = false;
  double z = 0;              ///< bottom as commanded: coordinate (absolute) or distance from R (incremental)
  double r = 0;              ///< R point as commanded: coordinate or distance from the initial level
  bool z_incremental = false, r_incremental = false;
  double q = 0;              ///< peck depth, > 0
  double dwell_s = 0;        ///< P
  double in_position = 0;    ///< ,J: in-position width behind the return from the bottom, mm; 0 = by the parameters
  double initial_level = 0;  ///< level of the drilling axis when the cycle was commanded, machine coordinates without tool length: a
                             ///< shift of the coordinates in the cycle mode (M700 13.1.2, 13.1.3) does not move it
};

/// What a hole needs, resolved to coordinates of the drilling axis.
struct Hole {
  CycleKind kind = CycleKind::none;
  double initial = 0, r = 0, bottom = 0;   ///< coordinates
  double return_to = 0;                    ///< initial level or R point (G98, G99)
  double q = 0;                            ///< > 0 for peck and step
  double clearance = 0;                    ///< d of G83/G73: #8013/#8012, DGSHAPE 1 mm
  double dwell_s = 0;
};

/// One step of a hole.
struct CycleStep {
  enum class Kind : uint8_t { done, rapid, feed, dwell, stop_point } kind = Kind::done;
  double to = 0;        ///< coordinate of the drilling axis
  double seconds = 0;
};

/// Execution through one hole; trivially copyable.
struct HoleProgress {
  uint32_t step = 0;
  double depth = 0;     ///< bottom reached so far (coordinate), pecks
};

/// Next step of the hole. Positioning in the plane has been done before.
CycleStep next_step(const Hole& hole, HoleProgress& progress);

}  // namespace nc
