// SPDX-License-Identifier: Apache-2.0
#include "control/part_system.hpp"

#include "base/same_place.hpp"
#include "control/optimal_mode.hpp"
#include "dialect/dialect.hpp"
#include "dialect/text.hpp"
#include "filter/position_filter.hpp"
#include "motion/limits.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace nc {
namespace {

/// The filter (a mean) of cuts in high-accuracy control for which the parameters give none.
FilterTimes rounding_of(const nc_config& config, const nc_system_config& system) {
  MotionLimits limits;
  limits.axis_count = system.axis_count;
  for (unsigned i = 0; i < system.axis_count; ++i) limits.axis[i].acceleration = system.axis[i].max_acceleration;
  limits.cycle_s = config.cycle_s;
  limits.tolerance = config.path_tolerance;
  return rounding_filter(limits);
}

}  // namespace

void PartSystem::create(const nc_config& config, unsigned index, const Dialect& dialect, const Shared& shared, Arena& arena) {
  const nc_system_config& system = config.system[index];
  dialect_ = &dialect;
  system_ = &system;
  axis_count_ = system.axis_count;
  InterpreterConfig in;
  in.dialect = &dialect;
  in.system = &system;
  in.system_index = static_cast<uint8_t>(index);
  in.look_ahead = config.look_ahead;
  in.window_bytes = config.window_bytes;
  in.frames.extended_systems = config.work_offsets;
  in.frames.tool_offsets = config.tool_offsets;
  in.vendor = shared.vendor;
  in.longest_filter_ms = PositionFilter::places(kLongestMean, config.cycle_s) * config.cycle_s * 1000;
  if (config.motion_mode == NC_MOTION_OPTIMAL) in.retract_overlap = config.retract_overlap;
  interpreter.create(in, shared.store, shared.common, arena);

  CommitConfig commit;
  commit.system = &system;
  commit.stroke_boxes = interpreter.pools().stroke_boxes;
  commit.marks = config.look_ahead;
  commit.records = config.look_ahead;
  commit.rotary_makes_length = dialect.rules.feed.degree_counts_as_millimetre;
  commit.cycle_s = config.cycle_s;
  commit.rules = &dialect.rules.motion;
  commit.filters = dialect.rules.motion.filter_times != nullptr && config.motion_mode != NC_MOTION_OPTIMAL;
  if (commit.filters) commit.rounding = rounding_of(config, system);
  commit_.create(commit, arena);

  ExecutorConfig ex;
  ex.axis_count = axis_count_;
  for (unsigned i = 0; i < system.axis_count; ++i) {
    const nc_axis_config& axis = system.axis[i];
    if (axis.rotary) rotary_ |= 1u << i;
    if (axis.soft_limited) ex.soft_limited |= 1u << i;
    ex.limits[i] = AxisLimits{axis.rapid, axis.max_velocity, axis.max_acceleration, axis.max_jerk, axis.in_position};
    ex.soft_min[i] = axis.soft_min;
    ex.soft_max[i] = axis.soft_max;
    ex.reference[i] = axis.reference[0];
    ex.axis_spindle[i] = axis.spindle;
    if (axis.spindle != 0) spindle_axes_ |= 1u << i;
  }
  ex.rotary = rotary_;
  ex.spindle_count = system.spindle_count == 0 ? 1u : system.spindle_count;
  ex.spindle_unsigned = static_cast<uint8_t>(system.spindle_unsigned);
  ex.cycle_s = config.cycle_s;
  ex.max_feed_override = config.max_feed_override;
  ex.tap_most_apart = config.tap_most_apart;
  ex.accuracy_joint_speed = dialect.rules.motion.accuracy_joint_speed;
  ex.capacity = config.look_ahead;
  ex.tells_marks = config.system_count > 1;
  ex.filters = commit.filters;
  optimal_ = config.motion_mode == NC_MOTION_OPTIMAL;
  ex.optimal = config.motion_mode == NC_MOTION_OPTIMAL;
  ex.tolerance = config.path_tolerance;
  executor.create(ex, arena);
  stages_.create(interpreter.pools().motion_settings, arena);
  const AddressTable& addresses = dialect.addresses;
  stages_.stage<ContourStage>().create(axis_count_, rotary_, addresses.letter(Role::option_chamfer),
                                       addresses.letter(Role::option_corner_radius), arena);
  stages_.stage<OffsetStage>().create(config.contour_blocks, arena);
  stages_.stage<FairingStage>().create(axis_count_, rotary_, arena);
  if (!arena.measuring() && !arena.overflowed()) stages_.reset();
}

void PartSystem::count_from(uint32_t first) {
  interpreter.count_from(first);
  executor.count_from(first);
  run_ = RunWord(executor.run());
}

// ---- the stream behind the stages ----------------------------------------------------------------------------------------

/// Inlined into both loops that take items, because a function call for each item would be felt.
[[gnu::always_inline]] inline nc_status PartSystem::next(uint32_t& budget, const Item** item) {
  if (staged_count_ != 0) {
    from_stage_ = true;
    *item = &staged_[staged_head_];
    return NC_OK;
  }
  for (;;) {
    if (!stages_.idle()) {
      staged_head_ = 0;
      if (pop_held(staged_[0])) {
        staged_count_ = 1;
        from_stage_ = true;
        *item = &staged_[0];
        return NC_OK;
      }
    }
    Item* front = nullptr;
    const nc_status status = interpreter.next(budget, &front);
    if (answered_block_ != 0) [[unlikely]] publish_answered();
    if (status != NC_OK) return status;
    if (!stages_.idle() || may_be_held(*front)) {
      const Stages::Intake intake = stages_.push(*front);
      if (intake == Stages::Intake::taken) interpreter.queue().pop();
      if (intake != Stages::Intake::straight) continue;
    }
    from_stage_ = false;  // nothing to hold back: straight through
    *item = front;
    return NC_OK;
  }
}

void PartSystem::take() {
  if (from_stage_) {
    ++staged_head_;
    --staged_count_;
  } else {
    interpreter.queue().pop();
  }
}

/// Why commit has not taken a move.
Fault PartSystem::refused(Committed committed) const {
  Fault fault;
  if (committed == Committed::at_pole) {
    fault.condition = Condition::polar_state;
    return fault;
  }
  if (committed == Committed::displaced) {
    const Curve& curve = commit_.curve();
    const AxisMap::Kind map = curve.shape != nullptr ? curve.shape->what.map.kind : AxisMap::Kind::none;
    fault.condition = map == AxisMap::Kind::polar ? Condition::polar_state : map != AxisMap::Kind::none ? Condition::mill_state : curve.shape != nullptr ? Condition::displaced : Condition::arc_deviation;
    return fault;
  }
  if (committed == Committed::prohibited || committed == Committed::unknown_area) {
    fault.condition = committed == Committed::prohibited ? Condition::stroke_check : Condition::stroke_area_unknown;
    return fault;
  }
  fault.condition = Condition::soft_limit;
  fault.axis = commit_.limit_axis();
  return fault;
}

/// A stage behind the interpreter has found a fault: everything that was read beyond the newest mark is void.
void PartSystem::stop_on(const Fault& fault, const nc_source& source) {
  const MarkPoint* last = commit_.newest();
  interpreter.note_calls(source, last != nullptr ? last->seq : 0);
  interpreter.rewind(last != nullptr ? last->seq : 0);
  // Some moves of the block that stops may have been committed already. Where compensated moves end is not what the program says, so it is not taken.
  if (!from_stage_) interpreter.end_at(commit_.machine());
  stages_.reset();
  clear_staged();
  interpreter.abort(fault, source);
}

/// Puts the cause of an alarm behind the sentence of its fault, or in its place where there is no room for both.
static void put_cause(const RaisedAlarm& alarm, nc_text* detail) {
  const size_t sentence = std::strlen(detail->s), cause = std::strlen(alarm.cause.s);
  if (cause == 0) return;
  const bool both = !alarm.cause_instead && sentence != 0 && sentence + 1 + cause < sizeof detail->s;
  TextWriter out(detail->s + (both ? sentence : 0), sizeof detail->s - (both ? sentence : 0));
  if (both) out.put(' ');
  out.put(alarm.cause.s);
}

void PartSystem::put_fault(const Fault& fault, const nc_source& source, nc_alarm* out) const {
  const AlarmText text = alarm_text(*dialect_, fault);
  *out = nc_alarm{};
  std::strncpy(out->code, text.code, sizeof(out->code) - 1);
  std::strncpy(out->message, text.message, sizeof(out->message) - 1);
  char axis_name[2] = {0, 0};
  if (fault.axis >= 0) axis_name[0] = system_->axis[fault.axis].name;
  alarm_detail(*dialect_, fault, axis_name, out->detail.s, sizeof(out->detail.s));
  out->axis = fault.axis;
  out->source = source;
}

void PartSystem::describe_alarm() {
  const RaisedAlarm raised = interpreter.raised();
  const Fault& fault = raised.fault;
  put_fault(fault, raised.source, &alarm_);
  alarm_given_ = true;
  if (fault.condition == Condition::user_alarm && raised.own_words[0] != 0)  // M700 13.5.5: the message and its number, as printed
    TextWriter(alarm_.detail.s, sizeof alarm_.detail.s).put(raised.own_words).put(' ').put_number(fault.value);
  if (fault.condition == Condition::vendor_function) {
    std::memcpy(alarm_.code, raised.vendor.code, sizeof alarm_.code);
    std::memcpy(alarm_.message, raised.vendor.message, sizeof alarm_.message);
    alarm_.detail = raised.vendor.detail;
  }
  put_cause(raised, &alarm_.detail);
}

bool PartSystem::alarm(nc_alarm* out) const {
  nc_source place;
  if (online_ && executor.faulted(&place)) {  // it comes before an alarm that has been read but not reached
    const ScanFault found = executor.scan_fault();
    Fault fault;
    fault.condition = found == ScanFault::tap ? Condition::tap_apart : found == ScanFault::encoder ? Condition::encoder_jumps : Condition::internal;
    put_fault(fault, place, out);
    return true;
  }
  if (alarm_given_) *out = alarm_;
  return alarm_given_;
}

/// The blocks that led to the block in which an alarm that is no record (one of the scan or of the machine) has stopped the program. 0: there is no
/// such alarm, or the blocks are not known. The calls are found from the blocks read behind that block, so only until these are given up.
unsigned PartSystem::stop_calls(nc_source (&calls)[NC_MAX_CALLS]) const {
  nc_source place;
  BlockSeq behind = 0;
  return executor.stopped(&place, &behind) ? interpreter.calls_behind(place, behind, calls) : 0;
}

unsigned PartSystem::alarm_calls(nc_source* out, unsigned capacity) const {
  nc_source place;
  BlockSeq behind = 0;
  const bool stopped = online_ && executor.stopped(&place, &behind);  // it comes before an alarm that has been read but not reached
  if (stopped && (run_.active() || run_.word() != executor.run())) {
    nc_source calls[NC_MAX_CALLS];
    const unsigned count = interpreter.calls_behind(place, behind, calls);
    std::copy_n(calls, std::min(count, capacity), out);
    return count;
  }
  if (!stopped && !alarm_given_) return 0;
  return interpreter.alarm_calls(out, capacity);
}

// ---- offline ---------------------------------------------------------------------------------------------------------------

nc_status PartSystem::interrupt_signal(bool on, bool* take_back) {
  *take_back = false;
  const bool rises = on && !uit_;
  uit_ = on;
  if (!on) uit_rest_.forget();
  watch();
  const bool stays = on && interpreter.interrupts().by_level && uit_rest_.over();
  if (!(rises || stays) || !interruptible()) return NC_OK;
  uit_pending_ = true;
  watch();
  // M700 13.12: an interrupt of type 1 acts at once. It interrupts the item that was given out last, where that takes time; a contour under
  // compensation, a hole of a fixed cycle and a block that waits for an answer are finished first.
  const bool cuttable = !pulled_in_hole_ && (pulled_ == ItemKind::move || pulled_ == ItemKind::action || pulled_ == ItemKind::gate);
  if (interpreter.interrupts().type_2 || !cuttable || !stages_.idle() || staged_count_ != 0 || open_sync_ != 0) return NC_OK;
  commit_.take_back(pulled_ == ItemKind::move);
  if (interpreter.interrupt(commit_.machine(), 1, true)) {
    uit_pending_ = false;
    uit_mode_ |= NC_INTERRUPT_IN_SERVICE;
    pulled_ = ItemKind::mark;
    looked_behind_ = kNowhere;
    *take_back = true;
  } else {
    commit_.put_back(pulled_ == ItemKind::move);
  }
  return NC_OK;
}

/// Begins the interrupt program at the end of a block. The blocks that were read ahead behind this block are given up.
bool PartSystem::begin_interrupt() {
  const MarkPoint* last = commit_.newest();
  if (last == nullptr || last->serial != commit_.serial()) return false;
  const Serial serial = last->serial;
  if (rewind(serial) != NC_OK) return false;
  uit_pending_ = false;
  if (!interrupt_between()) return false;
  uit_mode_ |= NC_INTERRUPT_IN_SERVICE;
  return true;
}

/// Begins the interrupt program behind the newest mark. The next block may be one that an earlier interrupt has cut: then the machine is not where
/// that block begins.
bool PartSystem::interrupt_between() {
  AxisVec machine = interpreter.machine();
  if (interpreter.repeat().active) {
    forget_interrupt();
    machine = commit_.newest()->machine;
    commit_.set_machine(machine);
  }
  return interpreter.interrupt(machine, 0, false);
}

/// The scan has stopped for an interrupt, and the interpreter stands behind the newest mark that has been executed. The machine stands there, too, or
/// inside the next block (type 1).
void PartSystem::interrupt_online() {
  const Cut cut = executor.cut();
  if (!cut.inside) {
    interrupt_between();
    return;
  }
  const auto items = static_cast<unsigned>(cut.done - commit_.serial()) - cut.syncs;  // a sync is not executed again, but answered again
  cut_ = cut;
  if (interpreter.interrupt_inside(cut.machine, items)) {
    forget_interrupt();  // what a block cut earlier had done does not belong to the interrupt program
    commit_.go_on(cut.done, cut.machine);
  } else {  // M97 has been executed meanwhile, so the block goes on
    interpreter.go_on_inside(items);
    commit_.go_on(cut.done, cut.machine);
    drop_repeated(interpreter.repeat(), interpreter.machine());
  }
}

/// The item was executed before its block was interrupted, so it is dropped. No such item lies behind the end of the block.
bool PartSystem::drops(const Item& item) {
  if (item.kind == ItemKind::mark && item.mark.resume) drop_ = 0;
  if (drop_ == 0 || item.kind == ItemKind::sync) return false;
  --drop_;
  return true;
}

/// Reduces the record of a move or dwell that was cut to what is left of it.
void PartSystem::resume_record(Record& record) {
  resumes_ = false;
  if (record.kind == ItemKind::gate && cut_.left > 0 && (record.gate.kind == NC_GATE_DWELL_SECONDS || record.gate.kind == NC_GATE_DWELL_TURNS))
    record.gate.value = cut_.left;
  if (record.kind != ItemKind::move || !(cut_.length > 0)) return;
  Segment& s = record.segment;
  const AxisVec at = curve_position(s.curve, cut_.length, axis_count_);
  double off = 0;
  for (unsigned i = 0; i < axis_count_; ++i) off = std::fmax(off, std::fabs(at[i] - cut_.machine[i]));
  if (off < kReached) {  // the curve, which has been made again, passes through the point where it was cut
    s.begun = cut_.length;
  } else {  // the interrupt program has changed what the block is made from, so the axes do not stand on its curve: a line leads to its end
    s.curve = make_line(cut_.machine, s.curve.end, axis_count_, rotary_);
    s.round_mm[0] = s.round_mm[1] = 0;
    commit_.set_index_axes(&s);
  }
}

/// A block that was interrupted is read again from its head: what it has done is not done twice.
void PartSystem::drop_repeated(const Repeat& repeat, const AxisVec& head) {
  drop_ = repeat.items;
  commit_.set_machine(head);
  resumes_ = online_;
  watch();
}

/// The only way from the interpreter to a sink. Inlined into both loops that take items, as next() is.
[[gnu::always_inline]] inline nc_status PartSystem::pump(uint32_t& budget, const Item** given) {
  *given = nullptr;
  const Item* item = nullptr;
  const nc_status status = next(budget, &item);
  if (status != NC_OK) return status;
  if (commit_watch_ != nullptr) [[unlikely]] before_watched_ = commit_.place();
  if (item->kind == ItemKind::mark && !watched_) [[likely]] {  // a mark is every second item of a program, and nearly every item of a macro
    commit_.commit_mark();
    *given = item;
    return NC_OK;
  }
  if (item->kind == ItemKind::alarm && from_stage_) {
    stop_on(item->alarm, item->source);
    return NC_OK;
  }
  if (wants_look_ahead(*item)) [[unlikely]] return look_ahead(budget);
  if (shape_left_ != nullptr && item->kind == ItemKind::move && named(*item).shape != nullptr) [[unlikely]] {
    shape_waits_ = !commit_.make_ahead(item->move, *named(*item).shape, shape_left_);
    if (shape_waits_) return NC_BUDGET;
  }
  const Committed committed = commit_.commit(*item, named(*item));
  if (committed != Committed::yes && committed != Committed::nothing) {
    stop_on(refused(committed), item->source);
    return NC_OK;
  }
  if (watched_ && drops(*item)) [[unlikely]] {
    if (committed == Committed::yes) commit_.uncount();
    take();
  } else if (committed == Committed::nothing) {
    take();
  } else {
    *given = item;
  }
  return NC_OK;
}

/// What follows from a mark for the caller that drives the part system.
[[gnu::always_inline]] inline void PartSystem::note_mark(const Item& mark) {
  remember_mark(mark);
  // The place of the interrupt comes with the mark, because the stages may have held the mark while the interpreter has read on.
  if (mark.mark.repeat.active) [[unlikely]] drop_repeated(mark.mark.repeat, interpreter.interrupted_at());
}

void PartSystem::note_given(const Item& item) {
  if (item.kind == ItemKind::sync) sync_ = item.sync, sync_source_ = item.source, open_sync_ = commit_.serial();
  if (item.kind == ItemKind::alarm) describe_alarm();
}

/// Notes the state of the macro interrupt that M96, M97, the beginning and the end of an interrupt program give out. Such a block cannot be cut.
void PartSystem::note_interrupt_mode(const Item& item) {
  if (item.kind != ItemKind::action || item.action.kind != NC_ACTION_CONTROL || item.action.index != NC_CONTROL_INTERRUPT) return;
  const auto mode = static_cast<uint32_t>(item.action.value);
  uit_rest_.change(uit_mode_, mode);
  uit_mode_ = mode;
  pulled_ = ItemKind::sync;
}

/// A macro interrupt that has been asked for begins in front of the next item, where it may.
[[gnu::always_inline]] inline void PartSystem::begin_wanted_interrupt() {
  if (!watched_) [[likely]] return;
  if ((uit_mode_ & NC_INTERRUPT_ENABLED) == 0) uit_pending_ = false;
  const bool wanted = uit_pending_ || (uit_ && interpreter.interrupts().by_level && uit_rest_.over());
  if (wanted && pulled_ == ItemKind::mark && !beside_ && interruptible()) begin_interrupt();
}

[[gnu::always_inline]] inline void PartSystem::give(const Item& item, nc_item* out) {
  pulled_ = item.kind;
  pulled_in_hole_ = item.in_hole;
  if (item.kind == ItemKind::mark) {
    commit_.mark_to_public(item, out);
    if (watched_ && item.mark.report) [[unlikely]] uit_rest_.block_ended();
    beside_ = item.mark.beside;
    note_mark(item);
  } else {
    commit_.to_public(item, out);
    if (item.kind == ItemKind::move) [[likely]] {
      const Move& move = item.move;
      move_transform_ = move.transform;
      move_offset_ = move.comp.side * move.comp.radius;
      move_plane_axis_[0] = move.comp.axis[0];
      move_plane_axis_[1] = move.comp.axis[1];
      move_in_space_ = move.space.on;
    } else {
      note_given(item);
      note_interrupt_mode(item);
    }
  }
  take();
}

nc_status PartSystem::pull(uint32_t budget, nc_item* out) {
  for (;;) {
    begin_wanted_interrupt();
    const Item* item = nullptr;
    const nc_status status = pump(budget, &item);
    if (status != NC_OK) return status;
    if (item == nullptr) continue;
    give(*item, out);
    return NC_OK;
  }
}

/// Counts an item instead of giving it out; `before`: number of moves that had been passed before this call. False: it has to be given.
[[gnu::always_inline]] inline bool PartSystem::pass(const Item& item, uint64_t before, nc_passed* passed) {
  if (watched_) [[unlikely]] return false;
  if (item.kind == ItemKind::move) {
    const Move& move = item.move;
    if (move.kind == NC_MOVE_SKIP) [[unlikely]] return false;
    ++passed->moves;
    ++passed->moves_in_row;
    passed->marks = 0;
    commit_.count_move(move, passed);
  } else {
    if (item.kind != ItemKind::mark || item.mark.report || passed->moves == before) return false;
    ++passed->marks;
    passed->moves_in_row = 0;
    beside_ = item.mark.beside;
    note_mark(item);
  }
  pulled_ = ItemKind::mark;  // nothing that was given out last: nc_move_point() has no move
  pulled_in_hole_ = item.in_hole;
  passed->source = item.source;
  take();
  return true;
}

nc_status PartSystem::pull_past(uint32_t budget, nc_passed* passed, nc_item* out) {
  const uint64_t before = passed->moves;
  for (;;) {
    begin_wanted_interrupt();
    const Item* item = nullptr;
    const nc_status status = pump(budget, &item);
    if (status != NC_OK) return status;
    if (item == nullptr) continue;
    if (!pass(*item, before, passed)) {
      give(*item, out);
      return NC_OK;
    }
    if (passed->moves_in_row >= passed->most_in_row && passed->most_in_row != 0) [[unlikely]] return NC_BUDGET;
  }
}

/// The interpreter is about to read the block on the line that is looked for. In front of a call that is the only time to stop, because the items behind it are
/// those of what it calls. Where stages hold items back it is too late: there the block is found by its first item, and a call by its end.
bool PartSystem::at_place(Passed* passed) {
  const nc_source& wanted = search_.wanted();
  if (!search_.of_line() || staged_count_ != 0 || !stages_.idle() || !interpreter.at_line(wanted.file, wanted.line, &passed->source)) return false;
  return passed->reached = search_.comes_to_line(interpreter.newest_block());
}

/// It stands here because of the inlined functions of the stream. An item that commit leaves out is passed as a mark without meaning.
PartSystem::Passed PartSystem::pass_item(uint32_t& budget) {
  const Item* item = nullptr;
  Passed passed;
  if (at_place(&passed)) return passed;
  passed.status = next(budget, &item);
  if (passed.status != NC_OK) return passed;
  passed.reached = search_.reached(*item);
  passed.source = item->source;
  if (passed.reached) return passed;
  passed.status = pump(budget, &item);
  if (passed.status != NC_OK || item == nullptr) return passed;
  passed.kind = pulled_ = item->kind;
  search_.note(*item);
  if (item->kind == ItemKind::mark) {
    restart_modal_ = item->mark.modal;
    note_mark(*item);
  } else {
    note_given(*item);
  }
  take();
  return passed;
}

/// The part system whose next block end was executed earliest, and not after the cycle `until`. Within one cycle the part system with the lowest
/// number is first, which is the order of nc_cycle(). nullptr: there is no such block end any more.
PartSystem* PartSystem::first_executed(uint32_t until, BlockSeq* seq) {
  PartSystem* first = nullptr;
  uint32_t earliest = until;
  for (unsigned i = 0; i < system_count_; ++i) {
    PartSystem& system = systems_[i];
    uint32_t cycle = 0;
    BlockSeq block = 0;
    if (!system.busy() || !system.executor.executed_mark(system.run_.epoch(), &cycle, &block)) continue;
    const auto later = static_cast<int32_t>(cycle - earliest);
    if (later > 0 || (later == 0 && first != nullptr)) continue;
    first = &system;
    earliest = cycle;
    *seq = block;
  }
  return first;
}

void PartSystem::publish_systems() {
  uint32_t until = executor.cycle_seen();
  for (unsigned i = 0; i < system_count_; ++i) {
    PartSystem& system = systems_[i];
    const uint32_t seen = system.executor.cycle_seen();
    if (static_cast<int32_t>(seen - until) < 0) until = seen;
    if (system.busy()) continue;
    const MarkPoint* const last = system.commit_.newest();
    if (last != nullptr) system.interpreter.publish(last->seq);
  }
  BlockSeq block = 0;
  while (PartSystem* const system = first_executed(until, &block)) {
    system->executor.take_executed_mark();
    system->published_ = block;
    system->interpreter.publish(block);
  }
}

/// The machine stands at the block that has waited for it, and at those behind it up to the next block end. What they write counts for the other part
/// systems as soon as it has been read, though the scan has still to come past the mark: so a block that reads a shared value and writes it is one step,
/// and no part system's count is lost.
void PartSystem::publish_answered() {
  const BlockSeq newest = interpreter.newest_block();
  if (newest < answered_block_) return;
  if (interpreter.shares()) interpreter.publish(newest);
  note_answered();
}

void PartSystem::note_answered() { answered_block_ = interpreter.stands_at_machine() ? interpreter.newest_block() + 1 : 0; }

/// The answer to a read in a contour: blocks in front of it are still to be executed. Positions are those at their end, with the radius vector there, and as far
/// beside it as the machine stands beside its program now (a shift by hand).
nc_world PartSystem::at_end_of_what_is_read(const nc_world& world) const {
  nc_world known = world;
  const AxisVec end = interpreter.beside_end(sync_.axis, sync_.vector), &here = commit_.machine();
  for (unsigned i = 0; i < axis_count_; ++i) known.machine.v[i] = end[i] + (world.machine.v[i] - here[i]);
  return known;
}

nc_status PartSystem::answer(const nc_world& world) {
  if (open_sync_ == 0) return NC_E_STATE;
  open_sync_ = 0;
  if (interpreter.shares()) {  // everything that was read has been executed, also calls that have no mark of their own
    publish_all();
    interpreter.publish(interpreter.newest_block());
  }
  interpreter.answer(sync_.ahead ? at_end_of_what_is_read(world) : world);
  note_answered();
  if ((sync_.what & NC_SYNC_SKIP) != 0 && world.skipped) {
    AxisVec machine;
    std::memcpy(machine.v, world.machine.v, sizeof(machine.v));
    commit_.set_machine(machine);
  }
  return NC_OK;
}

nc_status PartSystem::rewind(Serial serial) {
  MarkPoint head;  // the beginning of the program: nothing has been read there
  const MarkPoint* point = serial == 0 ? &head : commit_.find(serial);
  if (point == nullptr || !interpreter.rewind(point->seq)) return NC_E_NOT_FOUND;
  if (serial == 0) head.machine = interpreter.stands_at();
  forget_interrupt();
  if (stop_ == Stop::committed) stop_ = Stop::none;  // the block of the stop is read again; where it is `passed` the machine has still to execute it
  clear_staged();
  open_sync_ = 0;
  beside_ = false;
  note_answered();
  finished_ = false;
  alarm_given_ = false;
  uit_mode_ = interpreter.interrupts().mode;
  if (point->stages != 0) {
    stages_.restore(commit_.resume(*point), point->stages);
  } else {
    stages_.reset();
  }
  if (serial == 0) stages_.go_on_from<SpaceStage>(interpreter.vector_in_space());
  commit_.rewind_to(*point);
  if (interpreter.repeat().active) drop_repeated(interpreter.repeat(), interpreter.machine());
  return NC_OK;
}

void PartSystem::restart(const AxisVec& machine, bool keep_modal) {
  forget_mdi();
  forget_search();
  stop_ = Stop::none;
  interpreter.set_feeding(run_.active());
  publish_all();
  published_ = 0;
  interpreter.reset(keep_modal);
  interpreter.set_machine(machine);
  forget_interrupt();
  uit_mode_ = 0;
  uit_rest_.forget();
  stages_.reset();
  stages_.go_on_from<SpaceStage>(interpreter.vector_in_space());
  clear_staged();
  open_sync_ = 0;
  answered_block_ = 0;
  finished_ = false;
  alarm_given_ = false;
  commit_.set_machine(machine);
}

nc_status PartSystem::reset() {
  if (occupied()) return NC_E_STATE;
  if (!online_ && !interpreter.ended()) {  // blocks that the stages hold back have not been executed
    const MarkPoint* last = commit_.newest();
    interpreter.keep_place(rewind(last != nullptr ? last->serial : 0) == NC_OK);
  } else if (!online_) {
    interpreter.keep_place(false);
  }
  interpreter.clear_by_reset();
  restart(online_ ? executor.commanded() : commit_.machine());  // online the machine may have been moved by hand, or while its drives were off
  commit_.restart();
  return NC_OK;
}

nc_status PartSystem::select(const ProgramRef& program, bool mdi) {
  if (occupied()) return NC_E_STATE;
  const bool keep_modal = mdi && interpreter.is_mdi();
  interpreter.select(program, mdi);
  restart(online_ ? executor.commanded() : commit_.machine(), keep_modal);
  commit_.restart();
  return NC_OK;
}

bool PartSystem::may_take_mdi() {
  BlockSeq behind = 0;
  return occupied() && run_.active() && !interpreter.in_vendor_function() && !executor.reread_asked() && executor.block_stop(&behind) &&
         interpreter.takes_mdi(behind);
}

void PartSystem::take_mdi(const ProgramRef& blocks) {
  mdi_blocks_ = blocks;
  mdi_stop_ = blocks.valid() ? executor.starts() : 0;
  executor.let_mdi_wait(mdi_stop_);
}

void PartSystem::forget_mdi() {
  if (mdi_stop_ != 0) take_mdi({});
}

void PartSystem::set_position(const AxisVec& machine) {
  forget_search();
  interpreter.set_machine(machine);
  commit_.set_machine(machine);
  executor.set_position(machine);
}

// ---- online ----------------------------------------------------------------------------------------------------------------

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

/// After a sync: takes the positions that axes which are spindles as well have, because a spindle turns without the program (M700 10.5 (1)). Where a
/// skip move was dropped when the servo went off (precaution (3)) the other axes are not at its end either, and theirs are taken, too.
void PartSystem::take_spindle_axes(const nc_world& world) {
  const bool skip = (sync_.what & NC_SYNC_SKIP) != 0 && !world.skipped;
  const uint32_t axes = (skip ? ~uint32_t{0} : spindle_axes_) & ~interpreter.maps().frozen_axes;
  AxisVec here = commit_.machine(), read_to = interpreter.machine();
  for (unsigned i = 0; i < axis_count_; ++i)
    if ((axes >> i & 1) != 0) read_to[i] = here[i] = world.machine.v[i];
  interpreter.end_at(read_to);
  commit_.set_machine(here);
}

/// M700 4.2 "recalculation request": what was read beyond the block in execution is read again.
nc_status PartSystem::recalculate() {
  if (!occupied()) return NC_OK;
  Serial last = 0;
  if (!executor.truncate(&last)) return NC_WAITING;
  return read_again(last) ? NC_OK : NC_ALARMED;
}

bool PartSystem::read_again(Serial last) {
  if (rewind(last) == NC_OK) return true;
  // The records that the machine has not executed are given up already, but the blocks cannot be read again: too many writes or calls lie in between.
  Fault fault;
  fault.condition = Condition::internal;
  stop_on(fault, interpreter.source());
  return false;
}

/// Axes that have come to their reference positions by hand end the compensation of a length (M700 12.2 (4), 12.3). No axis moves by that.
void PartSystem::take_returned() {
  const uint32_t axes = executor.returned();
  if (axes == 0) return;
  interpreter.returned_by_hand(axes);
  const SpaceVector& vector = interpreter.vector_in_space();
  stages_.go_on_from<SpaceStage>(vector);
  commit_.change_stage<SpaceStage>(vector);
}

/// M700 12.3: what follows goes with the length along the tool that the handle has changed.
void PartSystem::add_by_handle(double way) {
  const bool added = way != 0 && interpreter.add_by_handle(way);
  executor.tell_along_tool(added, interpreter.along_tool());
}

/// The axes were moved by hand in a block stop, and what follows starts where the machine is. An axis that the next block does not name stays
/// there, and an incremental word counts from there; under radius compensation the vector in force is kept.
/// M700 12.4.4, 14.12: with manual absolute on, the coordinate systems stay, and an absolute word goes to its programmed position. With it off they
/// are moved along by `shift`, so the rest of the program is shifted until G92.1. `left_at` is where the program had left the axes. In the time-optimal
/// mode that may be beside the end of the block, within the tolerance: the program knows nothing of it, only the next move begins there.
void PartSystem::displace(const AxisVec& machine, const AxisVec& left_at, const AxisVec& shift) {
  AxisVec programmed = interpreter.machine(), beside_program;
  bool any = false;
  for (unsigned i = 0; i < axis_count_; ++i) {
    if (shift[i] != 0) interpreter.shift_coordinates(i, shift[i]);
    const double moved = machine[i] - left_at[i], beside = left_at[i] - commit_.machine()[i];
    if (moved == 0) continue;
    any = true;
    beside_program[i] = moved - shift[i];
    programmed[i] = stages_.idle() ? machine[i] - beside : programmed[i] + moved;
  }
  if (any) {
    commit_.forget_stages(stages_.displaced());
    interpreter.move_to(programmed, beside_program);
  }
  commit_.displace(machine);
}

}  // namespace nc
