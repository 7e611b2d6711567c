// SPDX-License-Identifier: Apache-2.0
// Online: what is read ahead and committed for the scan, in slices of a budget.
#include "control/optimal_mode.hpp"
#include "control/part_system_stream.hpp"

namespace nc {

/// Shows the item just committed to the commit watch. True: it has to wait for a later nc_feed(), and committing it has been undone.
bool PartSystem::put_off(const Item& item) {
  nc_item shown;
  commit_.to_public(item, &shown);
  if (commit_watch_(commit_watch_user_, &shown)) return false;
  commit_.put_back(before_watched_);
  return true;
}

nc_status PartSystem::commit_online(uint32_t& budget) {
  const Item* item = nullptr;
  const nc_status status = pump(budget, &item);
  if (status != NC_OK || item == nullptr) return status;
  if (commit_watch_ != nullptr && put_off(*item)) [[unlikely]] return NC_WAITING;
  Record record;
  commit_.to_record(*item, named(*item), &record);
  record.epoch = run_.epoch();
  record.staged = from_stage_;
  record.in_hole = item->in_hole;
  if (resumes_) [[unlikely]] resume_record(record);
  if (optimal_ && item->kind == ItemKind::move && !OptimalMode::moves(record.segment)) [[unlikely]] {
    commit_.take_back(true);
    stop_on(OptimalMode::refusal(), item->source);
    return NC_OK;
  }
  if (item->kind == ItemKind::move) commit_.note_record(executor.head());
  executor.push(record);
  if (item->kind == ItemKind::mark) {
    note_mark(*item);
    if (stop_ == Stop::committed) stop_ = Stop::passed;
  }
  note_given(*item);
  if (item->kind == ItemKind::gate && stops(item->gate)) stop_ = Stop::committed;
  if (item->kind == ItemKind::end) finished_ = true;
  take();
  return NC_OK;
}

bool PartSystem::sync_place(nc_source* source, uint32_t* main_line) const {
  if (open_sync_ == 0) return false;
  *source = sync_source_;
  *main_line = this->main_line(sync_source_);
  return true;
}

/// Whether the next block may be read before the machine has done more.
bool PartSystem::may_read_on() {
  if (executor.drained()) {
    stop_ = Stop::none;
    return true;
  }
  return stop_ != Stop::passed && interpreter.remembers(executed_);
}

void PartSystem::tell_axis_parameters() {
  const AxisSettings settings = interpreter.axis_settings();
  AxisParameters axes;
  axes.index = settings.index_axes;
  axes.turning = settings.machine_turn;
  axes.short_cut = settings.short_cut;
  for (unsigned i = 0; i < axis_count_; ++i)  // M700 2.3: of rotary axes only
    axes.increment[i] = (rotary_ >> i & 1) != 0 ? settings.index_increment[i] : 0;
  // While a mirror is still on, the counters stay as the last block has left them.
  axes.idle = !run_.active() && !interpreter.maps().mirror;
  axes.zero = axes.idle ? interpreter.work_zero() : told_axes_.zero;
  if (axes == told_axes_) return;
  told_axes_ = axes;
  executor.set_axis_parameters(axes);
}

/// Acts upon a change of the run that the scan has made (interpolate/run_word.hpp).
void PartSystem::follow_run() {
  const RunWord now(executor.run()), before = run_;
  if (now.word() == before.word()) return;
  publish_all();
  online_ = true;
  run_ = now;
  if (executor.gone_on_inside()) interpreter.machine_has_followed();
  if (now.epoch() != before.epoch()) {
    nc_source calls[NC_MAX_CALLS];
    const unsigned count = stop_calls(calls);
    // Blocks beyond the last one that was executed have been read but not executed: offsets, variables and outputs become as before them.
    const bool stopped = before.active() && !executor.ended() && rewind(executor.last_mark()) == NC_OK;
    if (before.active()) interpreter.keep_place(stopped);  // further resets leave it there
    interpreter.clear_by_reset();
    restart(executor.commanded());
    commit_.restart();
    interpreter.set_alarm_calls(calls, count);
  }
  if (!now.active() && now.epoch() == before.epoch()) interpreter.keep_place(false);  // the program has ended
  if (now.active() && !begin_found()) {
    interpreter.set_mirror_signal(executor.mirror());
    restart(executor.commanded(), interpreter.is_mdi());
    commit_.restart();
    take_returned();
  }
  executor.run_taken(now.word());
}

/// Reads and commits until nothing more may be read, the round has read its blocks, or `left` is spent. Then it goes on in the next call.
void PartSystem::read_on(int64_t* left) {
  Feeding& f = feeding_;
  while (f.status == NC_OK && !finished_ && open_sync_ == 0 && executor.room() > 1 && executor.may_push() && commit_.shape_room(executor.tail(), executor.head()) &&
         may_read_on()) {
    if (*left <= 0) return;
    const auto units = static_cast<uint32_t>(std::min<int64_t>((*left + kUnit - 1) / kUnit, f.blocks));
    uint32_t budget = units;
    shape_left_ = executor.slices() ? left : nullptr;
    f.status = commit_online(budget);
    shape_left_ = nullptr;
    f.blocks -= units - budget;
    *left -= kUnit * (units - budget) + (units == budget && executor.slices() ? kItem : 0);
    if (f.status == NC_OK) f.committed = true;
    if (f.status == NC_BUDGET && (f.blocks > 0 || shape_waits_)) {
      shape_waits_ = false;
      f.status = NC_OK;
      *left = 0;
      return;
    }
  }
  f.reading = false;
}

/// In the run of a program: one slice of a round in which blocks are read and then planned. What is done in which order does not hang on where
/// slices end.
nc_status PartSystem::feed_program(int64_t left) {
  Feeding& f = feeding_;
  executed_ = executor.last_block();
  if (spindle_axes_ != 0) {  // M700 10.5: a C command needs its servo, and the reference position return unless #2031 says so
    const uint32_t referenced = executor.referenced() | interpreter.axis_settings().no_reference;
    interpreter.set_closed_axes(spindle_axes_ & ~(executor.servo_ready() & referenced));
  }
  if (!f.open) {
    f = {};
    f.open = f.reading = true;
    f.blocks = executor.slices() ? kBlocksOfRound : UINT32_MAX;
  }
  if (f.reading) {
    read_on(&left);
    if (f.reading && executor.slices()) return NC_BUDGET;
    if (open_sync_ != 0) {
      nc_world world{};
      if (executor.sync_reached(open_sync_, &world)) {
        answer(world);
        if (spindle_axes_ != 0) take_spindle_axes(world);
      }
    }
    if (f.reading) f.status = NC_BUDGET;
  }
  if (!executor.plan(&left)) return NC_BUDGET;
  f.open = false;
  if (finished_) return interpreter.alarmed() ? NC_ALARMED : NC_ENDED;
  if (f.status == NC_BUDGET) return f.status;
  return f.committed ? NC_OK : NC_WAITING;
}

nc_status PartSystem::feed(uint32_t budget) {
  online_ = true;
  tell_axis_parameters();  // a program may have changed the parameters
  count_tool_life();
  follow_run();
  int64_t left = int64_t{budget} * kUnit;
  if (!run_.active() || !interpreter.is_selected()) {
    if (executor.reread_asked()) {  // there is nothing left to be read again
      executor.tell_along_tool(false, {});
      executor.reread_done();
    }
    feeding_.open = false;
    if (!executor.answer(&left) || !executor.plan(&left)) return NC_BUDGET;
    if (!finished_) return NC_WAITING;
    return interpreter.alarmed() ? NC_ALARMED : NC_ENDED;
  }
  if (executor.reread_asked()) {
    const bool interrupt = executor.interrupt_asked();
    const ProgramRef blocks = executor.mdi_asked() ? mdi_blocks_ : ProgramRef{};
    if (executor.mdi_asked()) forget_mdi();
    if (!read_again(executor.give_up_ahead())) {
      executor.tell_along_tool(false, interpreter.along_tool());  // stopped with an alarm
    } else if (take_returned(); interrupt) {
      executor.tell_along_tool(false, interpreter.along_tool());
      interrupt_online();
    } else {
      displace(executor.commanded(), executor.left_at(), executor.shift_asked());
      add_by_handle(executor.handle_asked());
      if (blocks.valid()) interpreter.enter_mdi(blocks);  // they are read first, and then the program
    }
    executor.reread_done();
  } else if (mdi_stop_ != 0 && executor.starts() != mdi_stop_) {
    forget_mdi();  // the program had been started when they came
  }
  if (!executor.answer(&left)) return NC_BUDGET;
  return feed_program(left);
}

}  // namespace nc
