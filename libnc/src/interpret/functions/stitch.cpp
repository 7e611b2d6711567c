// SPDX-License-Identifier: Apache-2.0
// Lines of the stitch function (HX 15.6): how far an axis goes in a block says how fast it may, and how long it rests behind it. The signals of the stitching
// head (PPF, PPE, NPFIN) are the machine's.
#include <cmath>

#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"
#include "interpret/program_map.hpp"

namespace nc {
namespace {

/// The range of a length, 0 to 7: the first whose end it does not exceed.
unsigned range_of(const Settings& settings, double length) {
  unsigned range = 0;
  while (range < 7 && length > settings.stitch_length[range]) ++range;
  return range;
}

}  // namespace

/// The codes begin and end a mode, and nothing moves in their block.
Execution do_stitch(BlockContext& in) {
  in.state.stitch = in.words.one_shot->function == Function::stitch_on;
  in.state.refresh_special();
  return Execution::done;
}

Execution move_stitch(BlockContext& in, const AxisVec& target, uint32_t commanded) {
  AxisVec at = in.position();
  for (unsigned i = 0; i < in.axis_count; ++i)
    if ((commanded >> i & 1) == 0) at[i] = target[i];  // it stays where it is
  const PlaneAxes plane = plane_axes(in);
  const int axes[2] = {plane.h, plane.v};
  double way = 0, feed = 0, wait_s = 0;
  for (unsigned i = 0; i < in.axis_count; ++i)
    if ((in.rotary >> i & 1) == 0) way += (target[i] - at[i]) * (target[i] - at[i]);
  way = std::sqrt(way);
  for (unsigned i = 0; i < 2; ++i) {
    const double length = axes[i] < 0 ? 0 : std::fabs(target[static_cast<unsigned>(axes[i])] - at[static_cast<unsigned>(axes[i])]);
    if (!(length > 0)) continue;
    const unsigned range = range_of(in.settings, length);
    const double own = in.settings.stitch_feed[i][range] * way / length;
    if (own > 0 && (feed == 0 || own < feed)) feed = own;
    wait_s = std::fmax(wait_s, in.settings.stitch_wait_s[i][range]);
  }
  const bool rapid = in.state.modal.is(Function::rapid);
  if (feed == 0 && rapid) {
    LinearStyle style;
    style.kind = NC_MOVE_RAPID;
    move_linear(in, target, commanded, style);
  } else {
    if (feed == 0) {
      const Execution did = check_feed(in, Function::linear);
      if (did != Execution::done) return did;
    }
    LinearStyle style;
    style.feed_mm_min = feed > 0 ? feed : feed_mm_min(in);
    style.special_feed = feed == 0 && special_feed(in);
    style.exact_stop = true;  // the needle goes down where the axes stand
    move_linear(in, target, commanded, style);
  }
  if (!(wait_s > 0)) return Execution::done;
  Gate& gate = in.emit(ItemKind::gate).gate;
  gate.kind = NC_GATE_DWELL_SECONDS;
  gate.announce = true;
  gate.value = wait_s;
  return Execution::done;
}

}  // namespace nc
