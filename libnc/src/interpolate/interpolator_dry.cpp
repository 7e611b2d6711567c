// SPDX-License-Identifier: Apache-2.0
// Switches for trying a program: dry run (M700 7.4 note 4), and what a machine lock means for the path.
#include <cmath>

#include "interpolate/interpolator.hpp"

namespace nc {

/// Dry run may be switched at any time, and the path goes over to its other feed within the limits of the axes; but a thread that has begun ends as it has
/// begun (M700 6.7.1 (12)), and goes by the manual feed of each cycle until then.
void Interpolator::take_dry_run(const nc_inputs& in) {
  const bool in_thread = moving_ ? current().segment.thread && law_.s > current().segment.begun : block_has_thread_ && !at_rest();
  const bool on = in_thread ? dry_.on() : in.dry_run;
  dry_ = {};
  if (!on) return;
  const double share = feed_override(in), feed = in.manual_feed * share;
  // Where the manual prints feeds of dry run (13.19) the override acts on the manual feed rate and not on what the axes may cut with.
  dry_.cut = in.manual_rapid ? (share > 0 ? DryFeeds::kUnbound : 0) : feed;
  dry_.rapid = in.manual_rapid ? -1 : feed;
}

/// Feed of dry run for this move, the override included; below 0: its own acts.
double Interpolator::dry_feed(const Segment& s) const { return s.dry ? dry_.of(s.rapid) : -1; }

/// Why a move does not go in dry run.
nc_stop_cause Interpolator::dry_stop(const nc_inputs& in) const { return feed_override(in) > 0 ? NC_CAUSE_MANUAL_FEED_ZERO : NC_CAUSE_OVERRIDE_ZERO; }

/// M700 15.2 (8): no signal ends a skip move of which no axis can come to what gives the signal.
bool Interpolator::skip_ends(const Segment& s, const nc_inputs& in) const { return s.ended_by(in.skip) && !all_locked(s, in); }

bool Interpolator::all_locked(const Segment& s, const nc_inputs& in) const {
  if (in.locked == 0) return false;
  for (unsigned i = 0; i < config_.axis_count; ++i)
    if ((in.locked >> i & 1) == 0 && std::fabs(s.curve.delta[i]) > 0) return false;
  return true;
}

}  // namespace nc
