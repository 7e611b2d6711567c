// SPDX-License-Identifier: Apache-2.0
// How long items last on the clock of an offline run: a move by its length over its feed, without acceleration (docs/trace.md). A feed per revolution goes
// by the speed that the spindle is commanded to have: the S code or a constant surface speed, within the clamp (M700 10.3, 10.4).
#pragma once

#include <cstdint>

#include "nc/nc.h"

namespace nc::tools {

inline constexpr double kRapidMmMin = 10'000.0;  // the clock of the trace assumes rapids of 10 m/min

class PathClock {
 public:
  /** An S code, r/min. While a constant surface speed is in force it is taken only for what comes behind that. */
  void speed(double rev_min) { code_ = rev_min; }
  /** Takes what concerns the spindle of an NC_ACTION_CONTROL. `work`: where the axes are, workpiece coordinates. */
  void control(const nc_action& action, const nc_axes& work);

  /** r/min of the spindle while the axes are at this place. */
  double rev_min(const nc_axes& work) const;
  /** The speed is the same at every place. */
  bool is_constant() const { return axis_ == 0; }

  /** F of a helix is the speed in the plane of its arc (M700 6.6, #1235 bit 0). */
  void set_helix_in_plane(bool on) { helix_in_plane_ = on; }

  /** Of the whole move. It stands here because it is asked for every move. */
  double seconds(const nc_move& move) const {
    double feed = move.feed_mm_min;
    if (move.kind == NC_MOVE_RAPID) feed = kRapidMmMin;
    if (move.feed_mm_rev > 0.0 && move.kind != NC_MOVE_TAP) [[unlikely]] return synchronous(move, 1.0);
    if (move.kind == NC_MOVE_HELIX && helix_in_plane_) [[unlikely]] return feed > 0.0 ? arc_length(move) / feed * 60.0 : 0.0;
    return feed > 0.0 ? move.length / feed * 60.0 : 0.0;
  }
  /** The share of the length of a move that is done after so many seconds, 0 to 1. */
  double share_after(const nc_move& move, double seconds) const;

 private:
  double synchronous(const nc_move& move, double share) const;
  double clamped(double speed) const;
  static double arc_length(const nc_move& move);

  double code_ = 0.0, m_min_ = 0.0;
  unsigned axis_ = 0;         // axis of the constant surface speed, from 1; 0 = there is none
  unsigned radius_axis_ = 0;  // axis whose radius has been given, from 1; its coordinates are diameters
  double radius_mm_ = 0.0, radius_at_ = 0.0;
  uint32_t clamp_ = 0;        // nc_clamp_bits
  double clamp_s_ = 0.0, clamp_q_ = 0.0;
  bool has_s_ = false, helix_in_plane_ = false;
};

}  // namespace nc::tools
