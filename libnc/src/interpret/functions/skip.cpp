// SPDX-License-Identifier: Apache-2.0
// G31: a straight cut that a signal ends (M700 15.2, 15.4), or whose feed signals change (15.5); G31.1 to G31.3 have signals and feeds by parameter (15.3).
// Where the move has ended is known only after it was executed, so the block goes on after a sync.
#include <bit>

#include "interpret/functions/functions.hpp"

namespace nc {
namespace {

/// M700 15.5: takes F1= to F8=, the feed after each signal; 0 ends the move. Signals that are not named do nothing.
Execution take_speeds(BlockInHand& in, uint32_t* stops) {
  const Command& w = in.words;
  if (w.has(Role::skip_signals)) return in.raise(Condition::format_error, Role::skip_signals, w.get(Role::skip_signals));  // F1= to F8= say already which signals count
  const double unit = feed_unit(in, in.position(), target_of_words(in));
  in.jobs.skip.speeds = SkipSpeeds{};
  *stops = 0;
  for (unsigned i = 0; i < SkipSpeeds::kSignals; ++i) {
    if (((w.counted_feeds >> i) & 1) == 0) continue;
    const double feed = w.counted_feed[i] * unit;
    if (!(feed >= 0 && feed <= in.dialect->rules.number.largest_feed_mm)) return in.raise(Condition::value_range, Role::feed, w.counted_feed[i]);
    if (feed == 0) {
      *stops |= 1u << i;
      continue;
    }
    in.jobs.skip.speeds.mask = static_cast<uint8_t>(in.jobs.skip.speeds.mask | 1u << i);
    in.jobs.skip.speeds.feed_mm_min[i] = feed;
  }
  return Execution::done;
}

/// The move has to end by its signal.
bool wants_signal(const BlockInHand& in) {
  const Function function = in.words.one_shot->function;
  return function == Function::probe_once || function == Function::probe || function == Function::probe_away;
}

}  // namespace

/// The place where the signal has come: of all axes, of those that do not move as well (HX 14.2.3 (7)), or where the family keeps the others of `axes` only.
void store_skip_position(InForce& in, const AxisVec& machine, uint32_t axes, bool touched) {
  const AxisVec zero = in.zero();
  SkipPosition skip = in.records->skip;
  const bool shifted = in.dialect->rules.length.shifts_reading;  // LinuxCNC #5061: in the coordinates in which the move took place
  for (unsigned i = 0; i < in.axis_count; ++i) {
    if (in.dialect->rules.skip.keeps_axes_not_moved && ((axes >> i) & 1) == 0) continue;
    skip.work[i] = machine[i] - zero[i] - (shifted ? in.state.applied[i] : 0);
  }
  skip.touched = touched;
  in.change(&ProgramRecords::skip, skip);
}

Execution do_skip(BlockContext& in) {
  const Command& w = in.words;
  // M700 9.3 (8): an index table that can be clamped only at certain positions (#2106) could not be clamped where the signal comes.
  for (uint32_t tables = w.target.axes() & in.settings.index_axes & in.rotary; tables != 0; tables &= tables - 1) {
    const auto axis = static_cast<unsigned>(std::countr_zero(tables));
    if (in.settings.index_increment[axis] > 0) return in.raise(Condition::no_function, in.axis_words.word(axis));
  }
  const unsigned step = w.one_shot->function == Function::multi_skip ? w.one_shot->number + 1u : 0u;  // 0 G31, 1 to 4 G31.1 to G31.4
  if (in.state.compensated()) return in.raise_code(Condition::skip_in_compensation, *w.one_shot);
  uint32_t mask = step == 0 ? 1u : in.settings.multi_skip_mask[step - 1];  // M700 15.3 (5)
  if (step == 0 && w.has(Role::skip_signals) && (!whole_number(w.get(Role::skip_signals), &mask) || mask < 1 || mask > 255))
    return in.raise(Condition::value_range, Role::skip_signals, w.get(Role::skip_signals));
  double feed = step == 0 ? in.settings.skip_feed : in.settings.multi_skip_feed[step - 1];
  if (in.dialect->rules.skip.feed_is_modal) {
    if (!in.state.modal.is(Function::feed_per_minute)) return in.raise_code(Condition::skip_feed_mode, *w.one_shot);
    feed = feed_mm_min(in);
  } else if (w.has(Role::feed)) {
    const Execution did = feed_of(in, &feed);
    if (did != Execution::done) return did;
    feed *= feed_unit(in, in.position(), target_of_words(in));
  }
  if (!(feed > 0)) return in.raise(Condition::skip_feed_zero, Role::feed);
  LinearStyle style;
  style.kind = NC_MOVE_SKIP;
  style.feed_mm_min = feed;
  style.exact_stop = true;
  if (w.counted_feeds != 0) {
    const Execution did = take_speeds(in, &mask);
    if (did != Execution::done) return did;
    style.skip_speeds = &in.jobs.skip.speeds;
  }
  style.skip_mask = static_cast<uint8_t>(mask);
  style.skip_away = w.one_shot->function == Function::probe_away || w.one_shot->function == Function::probe_away_try;
  const AxisVec before = in.state.machine;
  move_linear(in, target_of_words(in), w.target.axes(), style);
  if (in.state.machine == before) {  // there is no way on which a signal could come
    if (wants_signal(in) || in.dialect->rules.skip.change_required) return in.raise_code(Condition::probe_no_contact, *w.one_shot);
    store_skip_position(in, in.state.machine, w.target.axes(), false);
    return Execution::done;
  }
  in.jobs.skip.start = before;
  in.next_step = Step::skip_answered;
  return in.need(NC_SYNC_SKIP | NC_SYNC_POSITION);
}

Execution skip_answered(BlockInHand& in) {
  AxisVec at = in.state.machine;  // when no signal has come it is the end point of the block
  uint32_t axes = in.words.target.axes();
  for (unsigned i = 0; i < in.axis_count; ++i)
    if (at[i] != in.jobs.skip.start[i]) axes |= 1u << i;  // a rotation takes along an axis without a word
  if (in.world.skipped) {
    bool moved = false;
    for (unsigned i = 0; i < in.axis_count; ++i) {
      if (((in.state.map.frozen >> i) & 1) != 0) continue;  // a held axis has not moved (M700 6.16)
      at[i] = in.world.skip_machine.v[i];
      in.state.machine[i] = in.world.machine.v[i];
      moved = moved || in.state.machine[i] != in.jobs.skip.start[i];
    }
    if (!moved && in.dialect->rules.skip.change_required) return in.raise_code(Condition::probe_contact, *in.words.one_shot);
  }
  store_skip_position(in, at, axes, in.world.skipped);
  return !in.world.skipped && wants_signal(in) ? in.raise_code(Condition::probe_no_contact, *in.words.one_shot) : Execution::done;
}

}  // namespace nc
