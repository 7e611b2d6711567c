// SPDX-License-Identifier: Apache-2.0
// Lines of the stitch function (HX 15.6): how far an axis goes in a block says how fast it may, and how long it rests behind it. With PM 7308 each place is a
// stitch of the head, too: the control asks for it by PPF, the head says by PPE that it is done and by NPFIN that the next place may come. Which bits
// of the macro interface they are says the family; a ladder or the configuration leads them to the head (docs/decisions.md).
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

constexpr double kAskEvery_s = 0.01;                           ///< from one question for an input to the next
constexpr uint32_t kQuestions = 1000;                        ///< so long the head may take: 10 s
enum Waits : uint8_t { kForStitch, kForNextPlace };

void pause(BlockContext& in, double seconds) {
  if (!(seconds > 0)) return;
  Gate& gate = in.emit(ItemKind::gate).gate;
  gate.kind = NC_GATE_DWELL_SECONDS;
  gate.announce = true;
  gate.value = seconds;
}

void call_head(BlockContext& in, bool on) { give_out_bits(in, 0, in.dialect->rules.stitch.call, on ? in.dialect->rules.stitch.call : 0, on ? 1 : 0); }

void begin_wait(BlockInHand& in, Waits what) {
  in.jobs.input_wait = InputWait{};
  in.jobs.input_wait.kind = what;
  in.jobs.input_wait.left = kQuestions;
}

}  // namespace

/// The codes begin and end a mode, and nothing moves in their block.
Execution do_stitch(BlockContext& in) {
  in.state.stitch = in.words.one_shot->function == Function::stitch_on;
  in.state.refresh_special();
  if (in.settings.stitch_signals) call_head(in, false);  // a reset in a stitch has left it on
  return Execution::done;
}

Execution continue_stitch(BlockContext& in) {
  if (!in.world_fresh) return in.need(NC_SYNC_INPUT);
  InputWait& wait = in.jobs.input_wait;
  const bool of_stitch = wait.kind == kForStitch;
  if ((in.world.input[0] & (of_stitch ? in.dialect->rules.stitch.done : in.dialect->rules.stitch.next_may)) == 0) {
    if (wait.left == 0) {
      if (of_stitch) call_head(in, false);  // behind an alarm nobody waits for the head
      return in.raise_mode(Condition::head_silent, Mode::motion);
    }
    --wait.left;
    Gate& gate = in.emit(ItemKind::gate).gate;
    gate.kind = NC_GATE_DWELL_SECONDS;
    gate.value = kAskEvery_s;
    return in.need(NC_SYNC_INPUT);
  }
  if (of_stitch) {
    pause(in, in.settings.stitch_release_s);
    call_head(in, false);
    begin_wait(in, kForNextPlace);
    return in.need(NC_SYNC_INPUT);
  }
  pause(in, in.settings.stitch_next_s);
  return Execution::done;
}

Execution move_stitch(BlockContext& in, const AxisVec& target, uint32_t commanded) {
  AxisVec at = in.position();
  for (unsigned i = 0; i < in.axis_count; ++i)
    if ((commanded >> i & 1) == 0) at[i] = target[i];  // it stays where it is
  const PlaneAxes plane = plane_axes(in);
  const int axes[2] = {plane.h, plane.v};
  double way = 0, feed = 0, wait_s = 0, call_s = 0, in_plane = 0;
  bool limited = true;  // by values of all axes that move
  for (unsigned i = 0; i < in.axis_count; ++i)
    if ((in.rotary >> i & 1) == 0) way += (target[i] - at[i]) * (target[i] - at[i]);
  way = std::sqrt(way);
  for (unsigned i = 0; i < 2; ++i) {
    const double length = axes[i] < 0 ? 0 : std::fabs(target[static_cast<unsigned>(axes[i])] - at[static_cast<unsigned>(axes[i])]);
    if (!(length > 0)) continue;
    const unsigned range = range_of(in.settings, length);
    in_plane = std::hypot(in_plane, length);
    const double own = in.settings.stitch_feed[i][range] * way / length;
    if (own > 0 && (feed == 0 || own < feed)) feed = own;
    limited = limited && own > 0;
    wait_s = std::fmax(wait_s, in.settings.stitch_wait_s[i][range]);
    call_s = std::fmax(call_s, in.settings.stitch_call_s[i][range]);
  }
  const bool stitches = in.settings.stitch_signals && in_plane > 0;
  if (stitches && (in.state.compensated() || keeps_vector(in))) return in.raise_function(Condition::not_in_compensation, Function::stitch_on);  // the place is known only with the block behind
  if (in.settings.stitch_longest > 0 && in_plane > in.settings.stitch_longest)
    return in.raise_axis(Condition::value_range, first_of(commanded), in_plane);
  const bool rapid = in.state.modal.is(Function::rapid);
  if (feed == 0 && rapid) {
    LinearStyle style;
    style.kind = NC_MOVE_RAPID;
    style.exact_stop = stitches;
    move_linear(in, target, commanded, style);
  } else {
    if (!rapid && (feed == 0 || !limited)) {  // F limits what the stitch does not
      const Execution did = check_feed(in, Function::linear);
      if (did != Execution::done) return did;
      if (feed > 0) feed = std::fmin(feed, feed_mm_min(in));
    }
    LinearStyle style;
    style.feed_mm_min = feed > 0 ? feed : feed_mm_min(in);
    style.special_feed = feed == 0 && special_feed(in);
    style.exact_stop = true;  // the needle goes down where the axes stand
    move_linear(in, target, commanded, style);
  }
  pause(in, wait_s);
  if (!stitches) return Execution::done;
  pause(in, call_s);
  call_head(in, true);
  in.next_step = Step::stitch;
  begin_wait(in, kForStitch);
  return Execution::later;
}

}  // namespace nc
