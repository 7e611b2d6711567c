// SPDX-License-Identifier: Apache-2.0
// G31: a straight feed that a signal ends (M700 15.2, 15.4). Where it ended is known only when it has happened, so the block goes on
// behind a sync.
#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// #5061...: skip position in workpiece coordinates, tool compensation included (M700 10.11). Axes not named keep their value.
void store_skip_position(Interpreter& in, const AxisVec& machine, uint32_t axes) {
  const AxisVec zero = in.zero();
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (((axes >> i) & 1) != 0) in.set_table(Frames::skip_key(i), machine[i] - zero[i]);
}

}  // namespace

Did do_skip(Interpreter& in) {
  const BlockWords& w = in.words;
  if (in.state.comp.side != 0) return in.raise(Condition::skip_in_compensation, 'G', 31);
  uint32_t mask = 1;
  if (w.has('P') && (!whole_number(w.get('P'), &mask) || mask < 1 || mask > 255)) return in.raise(Condition::value_range, 'P', w.get('P'));
  const bool inch = in.state.modal.code[kGroupUnit] == 200;
  double feed = in.settings.skip_feed;
  if (w.has('F')) {
    const Did did = feed_of(in, &feed);
    if (did != Did::done) return did;
    if (inch) feed *= 25.4;
  }
  if (!(feed > 0)) return in.raise(Condition::skip_feed_zero, 'F');
  LinearStyle style;
  style.kind = NC_MOVE_SKIP;
  style.feed_mm_min = feed;
  style.exact_stop = true;
  style.skip_mask = static_cast<uint8_t>(mask);
  const AxisVec before = in.state.machine;
  move_linear(in, target_of_words(in), w.axes, style);
  if (in.state.machine == before) {  // nothing to go: no signal can come
    store_skip_position(in, in.state.machine, w.axes);
    return Did::done;
  }
  in.next_step = Step::skip_answered;
  return in.need(NC_SYNC_SKIP | NC_SYNC_POSITION);
}

Did skip_answered(Interpreter& in) {
  AxisVec at = in.state.machine;  // without a signal: the end point of the block
  if (in.world.skipped) {
    for (unsigned i = 0; i < in.axis_count; ++i) {
      at[i] = in.world.skip_machine.v[i];
      in.state.machine[i] = in.world.machine.v[i];
    }
  }
  store_skip_position(in, at, in.words.axes);
  return Did::done;
}

}  // namespace nc
