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
  staged_ = arena.make<Item>(kStaged);
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

void PartSystem::note_given(const Item& item) {
  if (item.kind == ItemKind::sync) sync_ = item.sync, sync_source_ = item.source, open_sync_ = commit_.serial();
  if (item.kind == ItemKind::alarm) describe_alarm();
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
  const bool amid = is_amid_;
  if (!online_ && !interpreter.ended()) {  // blocks that the stages hold back have not been executed
    const MarkPoint* last = commit_.newest();
    interpreter.keep_place(rewind(last != nullptr ? last->serial : 0) == NC_OK);
  } else if (!online_) {
    interpreter.keep_place(false);
  }
  interpreter.clear_by_reset();
  restart(online_ ? executor.commanded() : amid ? amid_ : commit_.machine());  // online the machine may have been moved by hand, or while its drives were off
  commit_.restart();
  return NC_OK;
}

nc_status PartSystem::select(const ProgramRef& program, bool mdi) {
  if (occupied()) return NC_E_STATE;
  const bool keep_modal = mdi && interpreter.is_mdi();
  interpreter.select(program, mdi);
  restart(online_ ? executor.commanded() : standing(), keep_modal);
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
  executor.set_position(machine);
  is_amid_ = !online_ && takes_time(pulled_);
  if (is_amid_) {
    amid_ = machine;
    return;
  }
  interpreter.set_machine(machine);
  commit_.set_machine(machine);
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

/// What the check of a contour has seen stays where it is when the axes are moved by hand (M700 12.4.4). A map of axes (G12.1) has no such way in its plane.
void PartSystem::displace_contour(const AxisVec& by_hand) {
  const OffsetStage& stage = stages_.stage<OffsetStage>();
  if (stage.idle() || interpreter.maps().other_axes) return;
  OffsetResume resume = stage.resume_point();
  const AxisVec& machine = interpreter.machine();
  double way[2] = {0, 0};
  for (unsigned k = 0; k < 2; ++k) {
    const double along[2] = {k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0};
    const AxisVec end = interpreter.beside_end(resume.comp.axis, along);
    for (unsigned i = 0; i < axis_count_; ++i) way[k] += (end[i] - machine[i]) * by_hand[i];
  }
  resume.contour.at = resume.contour.at + Vec2{way[0], way[1]};
  stages_.go_on_from<OffsetStage>(resume);
  commit_.change_stage<OffsetStage>(resume);
}

/// The axes were moved by hand in a block stop, and what follows starts where the machine is. An axis that the next block does not name stays
/// there, and an incremental word counts from there; under radius compensation the vector in force is kept.
/// M700 12.4.4, 14.12: with manual absolute on, the coordinate systems stay, and an absolute word goes to its programmed position. With it off they
/// are moved along by `shift`, so the rest of the program is shifted until G92.1. `left_at` is where the program had left the axes. In the time-optimal
/// mode that may be beside the end of the block, within the tolerance: the program knows nothing of it, only the next move begins there.
void PartSystem::displace(const AxisVec& machine, const AxisVec& left_at, const AxisVec& shift) {
  AxisVec programmed = interpreter.machine(), beside_program, by_hand, rounding;
  bool any = false;
  for (unsigned i = 0; i < axis_count_; ++i) {
    if (shift[i] != 0) interpreter.shift_coordinates(i, shift[i]);
    const double moved = machine[i] - left_at[i], beside = left_at[i] - commit_.machine()[i];
    rounding[i] = beside;
    if (moved == 0) continue;
    any = true;
    by_hand[i] = moved;
    beside_program[i] = moved - shift[i];
    programmed[i] = stages_.idle() ? machine[i] - beside : programmed[i] + moved;
  }
  if (any) {
    commit_.forget_stages(stages_.displaced());
    interpreter.move_to(programmed, beside_program);
    displace_contour(by_hand);
  }
  commit_.displace(machine, rounding);
}

}  // namespace nc
