// SPDX-License-Identifier: Apache-2.0
// One servo cycle of one part system: states and the walk along the records. Order of a cycle: plan, edges,
// handshake, states, records (path motion), manual motion, shape, outputs, publish.
#include "interpolate/interpolator.hpp"
#include "base/same_place.hpp"

#include <algorithm>
#include <cmath>

namespace nc {
namespace {

/// The most records that are executed in one cycle. At speed the planner keeps their number below (kSegmentsPerCycle + 1) *
/// (kRecordsBetween + 1).
constexpr unsigned kRecordsPerCycle = 256;
/// The most records in one cycle of the optimal mode, where the path goes on by itself and records are only counted off: enough for lines of 1 um at
/// full speed.
constexpr unsigned kRecordsPassed = 2048;

/// Some axis is asked to move by hand.
bool asks_by_hand(const nc_inputs& in) {
  for (const nc_manual& wish : in.manual)
    if (wish.kind != NC_MANUAL_NONE) return true;
  return false;
}

nc_axes to_nc(const AxisVec& a) {
  nc_axes out;
  for (unsigned i = 0; i < kMaxAxes; ++i) out.v[i] = a[i];
  return out;
}

}  // namespace

void Interpolator::create(const ExecutorConfig& config, const Record* ring, LeftRecord* left, Planner* planner, optimal::OptimalPlanner* optimal,
                          ScanShared* shared, double* filters) {
  config_ = config;
  ring_ = ring;
  left_ = left;
  mask_ = config.capacity - 1;
  planner_ = planner;
  optimal_ = optimal;
  if (optimal != nullptr) follower_.create(&optimal->store(), &optimal->axis_limits());
  sync_.create(config.cycle_s);
  shared_ = shared;
  filter_.create(config.axis_count, config.cycle_s, filters, PositionFilter::places(kLongestMean, config.cycle_s));
  spindles_.create(config.spindle_count);
  for (unsigned i = 0; i < config.axis_count; ++i)
    if (config.axis_spindle[i] != 0) c_axes_ = static_cast<uint8_t>(c_axes_ | 1u << i);
  border_.create(config.axis_count, config.max_feed_override, config.cycle_s);
  ManualConfig m;
  m.axis_count = config.axis_count;
  for (unsigned i = 0; i < kMaxAxes; ++i) m.limits[i] = config.limits[i];
  m.soft_min = config.soft_min;
  m.soft_max = config.soft_max;
  m.soft_limited = config.soft_limited;
  m.reference = config.reference;
  m.cycle_s = config.cycle_s;
  manual_.create(m);
}

void Interpolator::set_position(const AxisVec& machine) {
  wanted_ = command_ = last_command_ = target_ = machine;
  filter_.reset(machine);
  ScanStatus status;
  status.command = machine;
  shared_->status.write(status);
}

void Interpolator::count_from(uint32_t first) {
  tail_ = ordinal_ = end_ = reread_ = first;
  run_ = RunWord(first & ~1u);
  follower_.count_from(first);
}

void Interpolator::cycle(const nc_inputs& given, nc_outputs& out) {
  const nc_inputs& in = border_.check(given);
  ++power_cycles_;
  time_ = config_.cycle_s;
  latest_ = nullptr;
  if (state_ != NC_STATE_STOPPED) cause_ = NC_CAUSE_NONE;
  held_ = 0;
  const AxisVec began = wanted_;
  answer_truncate();
  ask_for_interrupt();
  length_dropped_ = false;
  await_reread();
  take_plan();
  handshake(in);
  messages();
  watch_index(in);
  take_recalculation(in);
  follow_spindles(in);
  take_dry_run(in);
  states(in);
  interrupt(in);
  turn_feed_handle(in);
  take_length_handle(in);
  if (filter_.active()) watch_skip(in);
  if (!frozen_ && !rereading_) run(in);  // the ring from here on may be the feeder's
  if (cutting_ && stands() && !frozen_ && !rereading_) cut_block();
  manual(in, wanted_ == began);
  last_command_ = command_;
  command_ = filter_.filter(place(), at_rest());
  if (stale_ != 0) [[unlikely]] {
    for (unsigned i = 0; i < config_.axis_count; ++i) command_[i] += turned_[i];
  }
  follow_tap(in);
  follow(in);
  count_cutting(in);
  if (state_ == NC_STATE_RUNNING) {
    ++run_cycles_;
    ++start_cycles_;
  }
  outputs(in, out);
  publish(in);
}

/// The feeder wants to give up records that are committed: the scan agrees only at rest in a stop, and touches no record until the feeder is done.
void Interpolator::answer_truncate() {
  Truncation& truncation = shared_->truncation;
  if (frozen_ && truncation.holds()) return;
  frozen_ = false;
  if (!truncation.open()) return;
  frozen_ = stands() && !manual_.active() && !reset_ &&
            (state_ == NC_STATE_STOPPED || state_ == NC_STATE_HOLD || state_ == NC_STATE_IDLE ||
             state_ == NC_STATE_ALARM);
  shared_->block_begun.store(block_begun_ ? 1 : 0, std::memory_order_relaxed);
  truncation.answer(frozen_);
}

/// Notices that the feeder has read again from where the axes are. It is called before the plan of this cycle is taken, because the plan of the
/// cycle before may lead over records that are given up.
void Interpolator::await_reread() {
  if (!rereading_ || shared_->reread_done.load(std::memory_order_acquire) != reread_) return;
  rereading_ = displaced_ = false;
  take_length_answer();
}

/// FIN completes the strobes that are on, whatever the program does meanwhile. FIN2 completes them when it rises; FIN1 takes the strobes off when it
/// rises, and the program goes on when it falls. A FIN that was on before the strobe does not count until it has been off once. The FIN of one group does
/// for that group what FIN1 does for all.
void Interpolator::handshake(const nc_inputs& in) {
  fin_ = in.fin || in.fin2;
  if (!in.fin) fin1_groups_ = 0;
  if (!fin_) fin_low_ = true;
  own_fin_ = in.fin_groups;
  own_groups_ &= own_fin_;
  own_low_ = static_cast<uint8_t>(own_low_ | ~own_fin_);
  const auto completed = static_cast<uint8_t>(strobe_ & own_fin_ & own_low_);
  own_groups_ = static_cast<uint8_t>(own_groups_ | completed);
  strobe_ = static_cast<uint8_t>(strobe_ & ~completed);
  own_low_ = static_cast<uint8_t>(own_low_ & ~completed);
  if (strobe_ != 0 && fin_ && fin_low_) {
    if (in.fin) fin1_groups_ = strobe_;
    strobe_ = 0;
    fin_low_ = false;
  }
}

/// Gives out operator messages and lines for the external output one at a time, with a cycle between two of them, so that each has a rising edge.
void Interpolator::messages() {
  if (message_) {
    message_ = false;
  } else if (!messages_.empty()) {
    message_ = true;
    message_text_ = messages_.front();
    messages_.pop();
  }
}

/// M700 4.2, 10.5 (2): a recalculation request acts at the end of the block in execution, so when its M code is complete.
void Interpolator::take_recalculation(const nc_inputs& in) {
  if (in.recalculate && !recalculate_last_ && state_ == NC_STATE_RUNNING) recalculate_ = true;
  recalculate_last_ = in.recalculate;
}

/// M700 13.12: the interrupt signal is accepted by its level or by its rising edge, between M96 and M97, not while an interrupt is in service, and
/// only while a program runs.
void Interpolator::interrupt(const nc_inputs& in) {
  const bool rises = in.macro_interrupt && !interrupt_last_;
  interrupt_last_ = in.macro_interrupt;
  if (!in.macro_interrupt) interrupt_rest_.forget();
  cutting_ = false;
  if (interrupt_mode_ == 0) return;
  const bool accepted = (interrupt_mode_ & (NC_INTERRUPT_ENABLED | NC_INTERRUPT_IN_SERVICE)) == NC_INTERRUPT_ENABLED &&
                        (state_ == NC_STATE_RUNNING || state_ == NC_STATE_HOLD);
  if (!accepted) {
    interrupt_wanted_ = false;
    return;
  }
  const bool stays = (interrupt_mode_ & NC_INTERRUPT_BY_LEVEL) != 0 && in.macro_interrupt && interrupt_rest_.over();
  if (rises || stays) interrupt_wanted_ = true;
  cutting_ = interrupt_wanted_ && (interrupt_mode_ & NC_INTERRUPT_AT_ONCE) != 0 && state_ == NC_STATE_RUNNING && may_cut();
}

/// An interrupt of type 1 may stop the program now, in the middle of a block. It may not before FIN has come (M700 13.12), in a thread, in a hole of a
/// fixed cycle (with what is left of the hole its way out would be lost, and the next one be gone to at its depth, perhaps with a spindle that stands), in
/// the mode of tapping (7.11 (3)), in an arc whose radius is compensated, in a contour (where the blocks cannot be told apart), in a skip move whose signal
/// has come, behind a skip move, while a table is unclamped, or in a block that changes the state of the interrupt: all these are finished first.
bool Interpolator::may_cut() const {
  if ((tapping_ & NC_TAPPING_MODE) != 0) return false;
  if (!block_begun_ || block_waits_ || index_.busy() || last_staged_ || (fin_wait() != 0 && !(suppress_ & NC_SUPPRESS_FIN))) return false;
  if (tail_ == end_) return !last_in_hole_;
  const Record& r = current();
  if (!is_current(r) || r.staged || r.in_hole || r.kind == ItemKind::sync) return false;
  if (r.kind == ItemKind::mark) return false;  // it takes no time
  return !(moving_ && (r.segment.thread || skip_braking_ || r.segment.rounds()));
}

/// To be called at rest inside a block: what is left of the block is given up, and the feeder goes on with the interrupt program.
void Interpolator::cut_block() {
  if (!may_cut()) return;  // the block has ended before the axes stood
  if (stale_ != 0) settle_axes();
  const bool begun = done_ != last_mark_ || law_.s > 0 || gate_begun_;  // else nothing of the block has been executed
  cut_ = Cut{begun, done_, block_syncs_, wanted_, moving_ ? law_.s : 0, gate_begun_ ? gate_left_ : 0};
  cutting_ = interrupt_wanted_ = moving_ = gate_begun_ = false;
  law_.s = 0;
  interrupt_mode_ |= NC_INTERRUPT_IN_SERVICE;  // already now, so that a signal before the program says the same is ignored
  rereading_ = reread_reached_ = reread_interrupt_ = true;
}

/// Something other than the program is about to move the axes, which stand at `place`.
void Interpolator::leave_at(const AxisVec& place) {
  if (!elsewhere_) left_at_ = place;
  elsewhere_ = true;
}

/// Tells the feeder where the program has left the axes: what they are beside that place, they were moved by hand, or turned as a spindle.
void Interpolator::tell_where_left() {
  shared_->reread_from = elsewhere_ ? left_at_ : wanted_;
  elsewhere_ = false;
}

/// Asks the feeder to read again. It does so one cycle after the mark, so that the place which the scan has published is that of the mark.
void Interpolator::ask_for_interrupt() {
  if (!reread_reached_) return;
  reread_reached_ = false;
  shared_->block_begun.store(0, std::memory_order_relaxed);
  shared_->reread_interrupt.store(reread_interrupt_ ? 1 : 0, std::memory_order_relaxed);
  tell_where_left();
  tell_returned();
  if (reread_interrupt_) shared_->reread_handle = 0;
  else tell_length_way();
  shared_->reread_shift = {};
  shared_->reread_mdi.store(0, std::memory_order_relaxed);
  shared_->reread_request.store(++reread_, std::memory_order_release);
}

/// Takes a press of cycle start. A reset acts when the axes stand and the feeder does not use the ring, which may be some cycles after it was
/// pressed. If IDLE was shown meanwhile, a press of start counts, and the program begins when the reset is done. In other states a start would go on
/// with what the reset gives up, so it is refused, and NC_CAUSE_RESET is shown.
void Interpolator::take_start(const nc_inputs& in) {
  if (in.cycle_start && !last_start_ && !in.reset && (!reset_ || shown_ == NC_STATE_IDLE)) start_ = true;
  last_start_ = in.cycle_start;
  if (!start_) start_told_ = false;
  if (!in.feed_hold) start_refused_ = false;
  if (!tap_bars()) tap_refuses_ = false;
}

void Interpolator::states(const nc_inputs& in) {
  take_start(in);
  if (in.reset && !last_reset_) {
    reset_ = true;
    start_ = false;  // a start that was pressed before and still waits is taken back
  }
  last_reset_ = in.reset;
  interlock_ = in.interlock;
  if (in.alarm) {
    const bool program = state_ == NC_STATE_RUNNING || state_ == NC_STATE_HOLD || state_ == NC_STATE_STOPPED;
    // Between the end of a block and the beginning of the next, the alarm counts as one of the block that has ended. The block executed before that one
    // tells which calls led to it.
    if (!alarmed_ && program && placed_) stop_in(source_, serial_ == last_mark_ ? last_block_ - 1 : last_block_);
    alarmed_ = true;
    start_ = false;
  }

  const bool still = stands() && !manual_.active();
  if (reset_) {
    if (frozen_ && shared_->truncation.withdraw()) frozen_ = false;
    if (!still || frozen_ || rereading_) return;
    give_up();
    reset_ = stopped_ = false;
    faulted_ = ScanFault::none;
    alarmed_ = in.alarm;
    state_ = NC_STATE_IDLE;
  }
  if (alarmed_) {
    start_ = false;
    if (frozen_ && shared_->truncation.withdraw()) frozen_ = false;
    if (state_ != NC_STATE_ALARM && still && !frozen_ && !rereading_) {
      give_up();
      state_ = NC_STATE_ALARM;
    }
    return;
  }
  const bool holds = in.feed_hold && !(disable_ & NC_DISABLE_FEED_HOLD) && (tapping_ & NC_TAPPING_MODE) == 0;  // M700 13.5.10: #3004 bit 0; 7.11 (3)
  if (holds && state_ == NC_STATE_RUNNING && (tapping_ & NC_TAPPING_STROKES) != 0) {
    hold_behind_tap_ = true;
  } else if (holds && state_ == NC_STATE_RUNNING && cutting_thread()) {
    hold_behind_thread_ = true;
  } else if (holds && state_ == NC_STATE_RUNNING && !hold_behind_thread_) {  // M700 6.7.1 (6): also one that stays on, or the tool would stop in the groove
    hold_ = true;
    state_ = NC_STATE_HOLD;
  }
  if (start_ && in.feed_hold && !(disable_ & NC_DISABLE_FEED_HOLD)) {  // feed hold refuses a start, also one that still waits
    start_ = false;
    start_refused_ = true;
  }
  // Whatever the program does first, the tap would break, or the thread. Where the spindle does not follow any more there is no other way out of the hole
  // than for somebody to free the tap, so the alarm that says so ends the refusal.
  if (start_ && tap_bars()) {
    start_ = false;
    tap_refuses_ = true;
  }
  if (start_ && !frozen_ && !rereading_) {
    const bool mdi = starts_ != 0 && shared_->mdi_waits.load(std::memory_order_acquire) == starts_;
    if (restart_bars(mdi) || held_stop_bars(mdi) || aside_bars()) return;
    // Axes were moved by hand, the handle has changed the length along the tool, or there are blocks of MDI: the start acts when blocks have been read again.
    const bool lengthens = length_waits() && !start_told_ && between_blocks();
    if ((displaced_ || lengthens || mdi) && still && state_ == NC_STATE_STOPPED) {
      rereading_ = true;
      in_mdi_ = in_mdi_ || mdi;
      shared_->reread_mdi.store(mdi ? 1 : 0, std::memory_order_relaxed);
      shared_->block_begun.store(block_begun_ ? 1 : 0, std::memory_order_relaxed);
      shared_->reread_interrupt.store(0, std::memory_order_relaxed);
      tell_where_left();
      tell_returned();
      tell_length_way();
      start_told_ = true;
      for (unsigned i = 0; i < config_.axis_count; ++i) {
        const bool shifts = in.manual_absolute_off && !begins_again_ && (by_hand_ >> i & 1) != 0;
        shared_->reread_shift[i] = shifts ? wanted_[i] - shared_->reread_from[i] : 0;
      }
      if (in.manual_absolute_off) by_hand_ = 0;
      shared_->reread_request.store(++reread_, std::memory_order_release);
      return;
    }
    if (state_ == NC_STATE_IDLE && shared_->run_taken.load(std::memory_order_acquire) != run_.word()) return;  // the start acts when the feeder has taken it
    start_ = false;
    if (still || state_ == NC_STATE_HOLD) start(in);
  }
}

void Interpolator::start(const nc_inputs& in) {
  if (++starts_ == 0) ++starts_;
  switch (state_) {
    case NC_STATE_IDLE:
      path_length_ = 0;
      start_cycles_ = 0;
      blocks_ = 0;
      last_mark_ = 0;
      last_block_ = 0;
      placed_ = false;
      done_ = 0;
      last_staged_ = last_in_hole_ = block_waits_ = false;
      block_syncs_ = 0;
      by_hand_ = 0;
      if (tap_.held) leave_tap();  // out of its hole, or freed by hand: else the start was refused
      shared_->mirror.store(in.mirror, std::memory_order_relaxed);
      tell_returned();
      run_.start();
      run_ended_ = false;
      follower_.give_up();  // path lengths are counted from 0 again, so that they do not grow with the years
      [[fallthrough]];
    case NC_STATE_STOPPED:
      if (begins_again_ && !in_mdi_) {
        begins_again_ = false;
        shared_->gone_on_inside.store(true, std::memory_order_release);
      }
      held_stop_[in_mdi_ ? 1 : 0].on = false;
      [[fallthrough]];
    case NC_STATE_HOLD:
      state_ = NC_STATE_RUNNING;
      hold_ = false;
      cause_ = NC_CAUSE_NONE;
      break;
    default:
      break;
  }
}

/// To be called at rest: makes everything void that is committed, and all records that still come with the same epoch. Macro outputs and the codes M, T,
/// B stay.
void Interpolator::give_up() {
  run_.give_up();
  hold_tap();
  leave_aside();
  law_ = {};
  end_rounding();
  check_ = false;
  skip_behind_ = 0;
  follower_.give_up();
  moving_ = passing_ = gate_begun_ = skip_braking_ = hold_ = block_begun_ = displaced_ = false;
  hold_behind_thread_ = hold_behind_tap_ = block_has_thread_ = elsewhere_ = false;
  tapping_ = 0;
  by_hand_ = 0;
  begins_again_ = in_mdi_ = false;
  fin1_groups_ = own_groups_ = 0;
  strobe_ = 0;               // a FIN that comes after the reset completes nothing
  suppress_ = disable_ = 0;  // M700 13.5.9, 13.5.10: cleared by reset
  interrupt_mode_ = 0;
  interrupt_rest_.forget();
  interrupt_wanted_ = false;
  recalculate_ = false;
  forget_length();
  spindles_.reset();
  settle_axes();
  messages_.clear();
  shared_->world.write({});
}

/// Behind the last block of MDI single block has stopped already: this stop and the one behind the text are one.
void Interpolator::end_mdi() {
  serial_ = current().serial;
  cause_ = NC_CAUSE_MDI_ENDED;
  in_mdi_ = false;
  block_begun_ = true;
  leave(current(), true);
}

/// Throws records of an older epoch away.
void Interpolator::drop_old() {
  for (unsigned n = 0; n < kRecordsPerCycle && tail_ != end_ && !is_current(current()); ++n)
    leave(current(), false);
}

void Interpolator::run(const nc_inputs& in) {
  drop_old();
  if (state_ == NC_STATE_ALARM && tail_ != end_ && is_current(current()) &&
      current().kind == ItemKind::end) {
    leave(current(), true);  // the end item that follows an alarm
    run_.end();
    run_ended_ = true;
  }
  if (state_ == NC_STATE_STOPPED && at_rest() && tail_ != end_ && is_current(current()) && current().kind == ItemKind::gate && current().gate.behind_mdi)
    end_mdi();
  if (state_ != NC_STATE_RUNNING && at_rest()) return;
  const unsigned most = optimal_ != nullptr ? kRecordsPassed : kRecordsPerCycle;
  unsigned n = 0;
  for (; n < most; ++n) {
    if (held() && at_rest()) break;
    if (tail_ == end_) {
      cause_ = NC_CAUSE_STARVED;
      come_to_rest();
      break;
    }
    const Record& r = current();
    if (!is_current(r)) {
      leave(r, false);
      continue;
    }
    if (index_.busy() && !clamp_before(r, in)) break;  // M700 9.3
    if (filter_.active() && waits_for_filters(r, in)) break;
    serial_ = r.serial;
    source_ = r.source;
    placed_ = true;
    if (r.kind == ItemKind::mark && r.mark.resume) {
      last_mark_ = r.serial;
      last_block_ = r.mark.seq;
      block_waits_ = false;
      block_syncs_ = 0;
    }
    if (execute(r, in) == Done::no) break;
    leave(r, true);
    if (rereading_ || (state_ != NC_STATE_RUNNING && at_rest())) break;
  }
  if (n < most) passing_ = false;  // otherwise further records are passed in the next cycle
}

/// Every record has been passed. The path comes to rest at the end of the last one, but because of rounding the record may have counted as passed
/// just before.
void Interpolator::come_to_rest() {
  if (optimal_ == nullptr || follower_.at_rest()) return;
  (void)follower_.advance(time_);
  law_.v = follower_.v();
  wanted_ = follower_.position();
}

/// Goes on to the next record; the host is told when this one has been executed.
void Interpolator::leave(const Record& r, bool executed) {
  if (executed) {
    nc_event event{};
    event.serial = r.serial;
    event.source = r.source;
    event.kind = static_cast<uint8_t>(r.kind);
    event.again = r.kind == ItemKind::mark && r.mark.again;
    // A record that is passed at speed within the cycle is reported with its end point.
    event.machine = to_nc(optimal_ != nullptr && (passing_ || !follower_.at_rest()) ? passed_at_ : wanted_);
    shared_->events.push(event);
    done_ = r.serial;
    last_staged_ = r.staged;
    last_in_hole_ = r.in_hole;
    if (r.kind == ItemKind::sync) {
      ++block_syncs_;
      block_waits_ = block_waits_ || (r.sync.what & NC_SYNC_SKIP) != 0;
    }
  }
  if (r.kind == ItemKind::move && r.segment.curve.length > 0) ++ordinal_;
  if (left_ != nullptr) left_[tail_ & mask_] = {static_cast<uint32_t>(power_cycles_), executed};
  ++tail_;
}

/// In a block stop: no move of the block in execution is left, so the next block can begin from any place. *behind: the block that is in execution, or has
/// been executed.
bool Interpolator::between_blocks(BlockSeq* behind) const {
  *behind = last_block_;
  if (!block_begun_) return true;
  for (uint32_t at = tail_; at != end_; ++at) {
    const Record& r = ring_[at & mask_];
    if (r.kind == ItemKind::mark && r.mark.resume) {
      *behind = r.mark.seq;
      return true;
    }
    if (r.kind == ItemKind::move || r.kind == ItemKind::sync) return false;
  }
  return false;  // its end is not committed yet
}

/// While the feeder uses the ring, what was found last stands.
void Interpolator::note_block_stop() {
  if (frozen_ || rereading_) return;
  block_stop_ = state_ == NC_STATE_STOPPED && stands() && !manual_.active() && !alarmed_ && !reset_ && between_blocks(&stop_behind_);
}

/// Jog, step, handle and reference return, while no program moves. When the path has come to its end within this cycle, manual motion waits for the
/// next: an axis that brakes and sets off by hand in the same cycle would use its acceleration twice.
void Interpolator::manual(const nc_inputs& in, bool rested) {
  manual_allowed_ = rested && stands() && !alarmed_ && !reset_ && !in.reset && !frozen_ && !rereading_ &&
                    (state_ == NC_STATE_IDLE || (state_ == NC_STATE_STOPPED && between_blocks()) || hold_frees_hands());
  const bool acts = manual_allowed_ && (state_ != NC_STATE_HOLD || asks_by_hand(in));  // a hold without hands leaves the path as it is
  if (!acts && !manual_.active()) {
    manual_.idle(in.manual);
    if (index_.busy()) clamp_at_rest(0, in);
    return;
  }
  if (acts && state_ == NC_STATE_HOLD) step_aside();
  const AxisVec before = wanted_;
  let_tap_go_outside(in);
  if (manual_allowed_) filter_.use({});  // by hand each axis has an acceleration of its own
  manual_cycle(in);
  for (unsigned i = 0; i < config_.axis_count; ++i) {
    if (state_ != NC_STATE_STOPPED || wanted_[i] == before[i]) continue;
    leave_at(before);
    displaced_ = true;
    by_hand_ |= 1u << i;
    if (wanted_[i] == (begins_again_ ? restart_at_ : left_at_)[i]) by_hand_ &= ~(1u << i);  // it has gone back
  }
  note_returned(before);
  // All have: the program goes on with what was read. Not where it begins inside, because then its path was planned from where the axes stood before that.
  if (displaced_ && elsewhere_ && !begins_again_ && wanted_ == left_at_ && returned_ == 0) displaced_ = elsewhere_ = false;
}

/// While the drives are off the commanded position follows the measured one, so that nothing jumps when the drives come on again.
void Interpolator::follow(const nc_inputs& in) {
  const bool given_up = state_ == NC_STATE_IDLE || state_ == NC_STATE_ALARM;
  followed_ = false;
  if (!in.follow_up || !in.actual_valid || !given_up || !stands() || manual_.active() || frozen_) return;
  for (unsigned i = 0; i < config_.axis_count; ++i)
    if ((spindles_now() >> i & 1) == 0) wanted_[i] = in.actual.v[i];
  command_ = last_command_ = target_ = wanted_;
  filter_.reset(wanted_);
  tap_follower_.drop();
  followed_ = true;
}

void Interpolator::publish(const nc_inputs& in) {
  ScanStatus status;
  status.command = command_;
  status.command[tap_.axis] -= tap_follower_.beside();
  status.tap = tap();
  status.tool = tool_;
  status.feed_override = feed_override(in);
  status.dry = dry_;
  // The plan also comes to rest at the end of a block when an interrupt waits for it, a hold was pressed in a thread, or blocks are to be read again.
  status.single_block = (in.single_block && !(suppress_ & NC_SUPPRESS_SINGLE_BLOCK)) || interrupt_wanted_ || hold_behind_thread_ || stale_ != 0 || recalculate_ || length_waits();
  status.servo_ready = servo_ready_;
  status.referenced = referenced_;
  status.ended = run_ended_;
  status.last_mark = last_mark_;
  status.last_block = last_block_;
  status.cut = cut_;
  status.faulted = faulted_;
  status.stopped = stopped_;
  status.stopped_at = stopped_at_;
  status.stopped_behind = stopped_behind_;
  note_block_stop();
  status.starts = starts_;
  status.block_stop = block_stop_;
  status.stop_behind = stop_behind_;
  shared_->status.write(status);
  shared_->ordinal.store(ordinal_, std::memory_order_relaxed);
  shared_->run.store(run_.word(), std::memory_order_release);
  shared_->tail.store(tail_, std::memory_order_release);
  shared_->cycle.store(static_cast<uint32_t>(power_cycles_), std::memory_order_release);
  if (optimal_ != nullptr) tell_planner(in, status);
}

/// Feed override in force for cuts in general: #3004 bit 1 switches overrides off.
double Interpolator::feed_override(const nc_inputs& in) const {
  return (disable_ & NC_DISABLE_OVERRIDE) != 0 ? 1 : in.feed_override;
}

/// Feed override of the move in execution, for displays. A thread (M700 6.7.1), the tapping mode (7.11) and a skip move (15.2) go at 100 %, except that
/// an override of 0 stops a skip move.
double Interpolator::override_in_force(const nc_inputs& in, nc_override_source* source) const {
  const Segment* s = moving_ ? &current().segment : nullptr;
  const bool fixed = s != nullptr && (s->thread || s->fixed_override || (s->skip && feed_override(in) > 0));
  *source = (disable_ & NC_DISABLE_OVERRIDE) != 0 || fixed ? NC_OVERRIDE_PROGRAM : NC_OVERRIDE_INPUT;
  return *source == NC_OVERRIDE_PROGRAM ? 1 : in.feed_override;
}

/// Counts how long the tool in the spindle cuts, and tells it to the feeder by the second.
void Interpolator::count_cutting(const nc_inputs& in) {
  constexpr double kTell_s = 1, kMillis = 1000;
  const bool breaks = in.tool_broken && !broken_last_;
  broken_last_ = in.tool_broken && (broken_last_ || tool_.place == 0 || shared_->lives.push(tool_, LifeRing::kBroken));
  if (tool_.place == 0 || breaks || dry_.on() || in.locked != 0) return;
  if (moving_ && !current().segment.rapid && law_.v > 0) cut_s_ += config_.cycle_s;
  if (cut_s_ >= kTell_s && shared_->lives.push(tool_, static_cast<uint32_t>(std::lround(cut_s_ * kMillis)))) cut_s_ = 0;
}

void Interpolator::outputs(const nc_inputs& in, nc_outputs& out) {
  const double per_s = 1 / config_.cycle_s;
  const AxisParameters& axes = shared_->axes.read();
  const uint32_t turning = axes.turning;
  out = {};
  out.turning = turning;
  out.distance_zero = true;
  if (latest_ != nullptr) {
    to_work_ = latest_->to_work;
    target_ = latest_->curve.end;
  } else if (state_ == NC_STATE_IDLE && axes.idle) {
    AxisVec back;
    for (unsigned i = 0; i < config_.axis_count; ++i) back[i] = -axes.zero[i];
    to_work_ = Affine::translation(back);
  }
  const AxisVec work = to_work_.apply(command_);
  const bool on_the_way = moving_ || !drained();
  for (unsigned i = 0; i < config_.axis_count; ++i) {
    out.command.v[i] = command_[i];
    out.velocity.v[i] = (command_[i] - last_command_[i]) * per_s;
    if (command_[i] != last_command_[i]) out.distance_zero = false;
    out.work.v[i] = work[i];
    out.distance_to_go.v[i] = on_the_way ? target_[i] + turned_[i] - command_[i] : 0;
    double away = command_[i] - config_.reference[i];
    if ((turning >> i & 1) != 0) away -= 360 * std::nearbyint(away / 360);
    if (std::fabs(away) <= kAddingUp) out.at_reference |= 1u << i;
  }
  for (unsigned i = 0; i < NC_WORDS; ++i) {
    out.output[i] = output_[i];
    out.output_written[i] = output_written_[i];
    output_written_[i] = 0;
  }
  for (unsigned i = 0; i < kMaxAxes; ++i) out.current_limit[i] = current_limit_[i];
  shown_ = alarmed_ ? NC_STATE_ALARM : manual_.moving() ? NC_STATE_MANUAL : state_;
  out.state = static_cast<uint8_t>(shown_);
  out.cause = static_cast<uint8_t>(alarmed_                                              ? NC_CAUSE_ALARM
                                   : reset_ && shown_ != NC_STATE_IDLE                   ? NC_CAUSE_RESET
                                   : state_ == NC_STATE_HOLD || start_refused_           ? NC_CAUSE_FEED_HOLD
                                   : tap_refuses_                                        ? NC_CAUSE_TAP_IN_HOLE
                                   : interlock_ && moving_ && state_ == NC_STATE_RUNNING ? NC_CAUSE_INTERLOCK
                                   : index_waits_ || index_lost_                         ? NC_CAUSE_FIN
                                                                                         : cause_);
  out.tapping = tapping_ != 0;
  out.strobe = strobe_;
  out.fin_wait = static_cast<uint16_t>(fin_wait() | held_ | (index_waits_ || index_lost_ ? NC_FIN_WAIT_UNCLAMP : 0));
  out.unclamp = index_.unclamp();
  out.m = m_;
  out.t = t_;
  out.b = b_;
  // Constant surface speed needs the workpiece coordinate of its axis.
  spindles_.update([&work](unsigned axis) { return work[axis]; });
  out.s = spindles_.commanded();
  for (unsigned i = 0; i < config_.spindle_count; ++i) out.spindle_rev_min[i] = spindles_.now(i);
  for (unsigned i = 0; c_axes_ != 0 && i < config_.axis_count; ++i)
    if ((servo_on_ >> i & 1) != 0) out.spindle_rev_min[config_.axis_spindle[i] - 1] = 0;  // M700 10.5 (1): spindle control is not possible
  turn_tap_spindle(in, out);
  out.tool_life = static_cast<uint8_t>(shared_->tool_life.load(std::memory_order_relaxed));
  out.tool_group = shared_->tool_group.load(std::memory_order_relaxed);
  out.spindle_selected = spindles_.selected();
  out.spindle_encoder = static_cast<uint8_t>(encoder_);
  out.servo_on = servo_on_;
  out.servo_ready = servo_ready_;
  out.referenced = referenced_;
  out.manual_allowed = manual_allowed_;
  out.followed = followed_;
  out.handle_dropped = manual_.handle_dropped();
  out.moved_by_hand = by_hand_;
  out.restart_axes = axes_away();
  const AxisVec* back = &command_;
  (void)return_places(&back);
  out.return_place = to_nc(*back);
  out.tool_length_added = length_.by_handle + length_told_ + length_way_;
  out.tool_length_dropped = length_dropped_;
  out.manual_absolute = !in.manual_absolute_off;
  out.message = message_;
  out.message_text = message_text_.id;
  out.message_port = message_text_.port;
  if (moving_) {
    const Segment& s = current().segment;
    out.rapid = s.rapid;
    out.feed_command_mm_min = (dry_feed(s) >= 0    ? (!in.dry_run ? dry_feed(s) : in.manual_rapid ? s.speed_limit : in.manual_feed)
                               : s.feed_mm_rev > 0 ? s.feed_mm_rev * std::fabs(encoder(in).rev_per_s)
                                                   : programmed_feed(s)) * 60;
    out.feed_digit_on = s.feed_digit != 0;
    out.feed_digit = s.feed_digit != 0 ? static_cast<uint8_t>(s.feed_digit - 1) : uint8_t{0};
  }
  if (!moving_ && rapid_behind_ && on_the_way) out.rapid = true;
  out.feed_mm_min = (filter_.active() ? feed_of_axes() : law_.v) * 60;
  out.serial = serial_;
  out.source = source_;
  out.modal = modal_;
  out.inputs_refused = border_.refused();
  nc_override_source source = NC_OVERRIDE_INPUT;
  out.feed_override = override_in_force(in, &source);
  out.override_source = static_cast<uint8_t>(source);
  out.rapid_override = in.rapid_override;
  out.path_length = path_length_;
  out.run_s = static_cast<double>(start_cycles_) * config_.cycle_s;
  out.blocks = blocks_;
}

}  // namespace nc
