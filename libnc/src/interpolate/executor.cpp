// SPDX-License-Identifier: Apache-2.0
// The feeder's side of the executor. Records are written into the ring, planned, and become visible to the
// scan only with the plan that covers them, so the scan never sees geometry that it could not stop on.
#include "interpolate/executor.hpp"

#include <limits>

#include "interpolate/executor_state.hpp"

namespace nc {
namespace {

optimal::OptimalPlanner* create_optimal(const ExecutorConfig& config, const Record* ring, Arena& arena) {
  optimal::OptimalPlanner::Setup setup;
  setup.limits.axis_count = config.axis_count;
  for (unsigned i = 0; i < config.axis_count; ++i) {
    const AxisLimits& l = config.limits[i];
    setup.limits.velocity[i] = l.velocity;
    setup.limits.rapid[i] = l.rapid;
    setup.limits.acceleration[i] = l.acceleration;
    setup.limits.jerk[i] = l.jerk;
  }
  setup.limits.linear = ~config.rotary;
  setup.tolerance = config.tolerance;
  setup.cycle_s = config.cycle_s;
  setup.capacity = config.capacity;
  optimal::OptimalPlanner* const planner = arena.make<optimal::OptimalPlanner>();
  optimal::OptimalPlanner measured;
  (planner != nullptr ? *planner : measured).create(setup, ring, arena);
  return planner;
}

MotionLimits motion_limits(const ExecutorConfig& config) {
  MotionLimits limits;
  limits.axis_count = config.axis_count;
  for (unsigned i = 0; i < kMaxAxes; ++i) limits.axis[i] = config.limits[i];
  limits.cycle_s = config.cycle_s;
  limits.max_feed_override = config.max_feed_override;
  limits.accuracy_joint_speed = config.accuracy_joint_speed;
  limits.tolerance = config.optimal ? 0 : config.tolerance;
  return limits;
}

/// Sets the speed above which a thread of the optimal mode could not stay at its angle of the spindle.
void limit_thread(Segment& s, const ExecutorConfig& config) {
  const MotionLimits limits = motion_limits(config);
  set_segment_limits(s, shape_of(s, limits), {}, limits);
  s.speed_limit /= optimal::ThreadShare::kFaster;
}

}  // namespace

void Executor::create(const ExecutorConfig& config, Arena& arena) {
  ExecutorState* const state = arena.make<ExecutorState>();
  Record* const ring = arena.make<Record>(config.capacity);
  LeftRecord* const left = config.tells_marks ? arena.make<LeftRecord>(config.capacity) : nullptr;
  double* const filters = config.filters ? arena.make<double>(size_t{PositionFilter::places(kLongestMean, config.cycle_s)} * config.axis_count) : nullptr;
  const MotionLimits limits = motion_limits(config);
  // While an arena only measures there is no state: parts that are thrown away are laid out in the place of its members.
  Planner measured_planner;
  EventRing measured_events;
  // Only the planner of the mode that is chosen gets memory.
  optimal::OptimalPlanner* optimal = nullptr;
  if (config.optimal) {
    optimal = create_optimal(config, ring, arena);
  } else {
    (state != nullptr ? state->planner : measured_planner).create(limits, ring, config.capacity, arena);
  }
  (state != nullptr ? state->shared.events : measured_events).create(config.capacity * 2, arena);
  state_ = state;
  if (state == nullptr) return;
  state->config = config;
  state->ring = ring;
  state->left = left;
  state->mask = config.capacity - 1;
  state->optimal = optimal;
  state->scan.create(config, ring, left, &state->planner, optimal, &state->shared, filters);
}

Planner::Inputs ExecutorState::scan_said() {
  Planner::Inputs in;
  in.tail = shared.tail.load(std::memory_order_acquire);
  in.ordinal = shared.ordinal.load(std::memory_order_relaxed);
  const ScanStatus& status = shared.status.read();
  in.feed_override = status.feed_override;
  in.dry = status.dry;
  in.single_block = status.single_block;
  return in;
}

unsigned Executor::room() const {
  return state_->config.capacity - (state_->head - state_->shared.tail.load(std::memory_order_acquire));
}

uint32_t Executor::head() const {
  return state_->head;
}

uint32_t Executor::tail() const {
  return state_->shared.tail.load(std::memory_order_acquire);
}

void Executor::push(const Record& record) {
  ExecutorState& e = *state_;
  e.ring[e.head & e.mask] = record;
  const uint32_t index = e.head++;
  Record& pushed = e.ring[index & e.mask];
  if (e.optimal == nullptr) {
    e.planner.commit(index);
  } else if (pushed.kind == ItemKind::move && pushed.segment.thread && pushed.segment.curve.length > 0) {
    limit_thread(pushed.segment, e.config);
  }
}

void Executor::plan() {
  int64_t all = std::numeric_limits<int64_t>::max();
  answer(&all);
  plan(&all);
}

bool Executor::slices() const { return state_->optimal != nullptr; }

bool Executor::answer(int64_t* instructions) {
  return state_->optimal == nullptr || state_->optimal->answer(instructions);
}

bool Executor::plan(int64_t* instructions) {
  if (state_->optimal != nullptr) {
    if (!state_->optimal->replan(state_->head, instructions)) return false;
  } else {
    state_->planner.replan(state_->scan_said());
  }
  state_->forget_truncation();
  return true;
}

/// Forgets a truncation that was asked for and whose answer was never fetched, so that the scan does not wait for ever.
void ExecutorState::forget_truncation() {
  constexpr unsigned kPatience = 1000;
  if (!truncate_open || ++truncate_age < kPatience || !shared.truncation.answered()) return;
  truncate_open = false;
  if (shared.truncation.claim()) shared.truncation.release();
}

void Executor::set_axis_parameters(const AxisParameters& axes) {
  state_->shared.axes.write(axes);
}

bool Executor::sync_reached(Serial serial, nc_world* world) const {
  const ScanWorld& reached = state_->shared.world.read();
  if (serial == 0 || reached.serial != serial) return false;
  *world = reached.world;
  return true;
}

bool Executor::drained() const {
  return state_->shared.tail.load(std::memory_order_acquire) == state_->head;
}

uint32_t Executor::run() const {
  return state_->shared.run.load(std::memory_order_acquire);
}

void Executor::run_taken(uint32_t word) {
  state_->shared.run_taken.store(word, std::memory_order_release);
}

bool Executor::ended() const {
  return state_->shared.status.read().ended;
}

uint32_t Executor::mirror() const {
  return state_->shared.mirror.load(std::memory_order_relaxed);
}

bool Executor::truncate(Serial* last) {
  ExecutorState& e = *state_;
  Truncation& truncation = e.shared.truncation;
  if (!e.truncate_open) {
    truncation.ask();
    e.truncate_open = true;
    e.truncate_age = 0;
    return false;
  }
  if (!truncation.answered()) return false;
  e.truncate_open = false;
  if (!truncation.claim()) return false;
  const bool complete = give_up_behind_block(last);
  truncation.release();
  return complete;
}

/// False, and nothing is given up, when the end of the block in execution is not committed yet.
bool Executor::give_up_behind_block(Serial* last) {
  ExecutorState& e = *state_;
  const Planner::Inputs in = e.scan_said();
  *last = e.shared.status.read().last_mark;
  uint32_t end = in.tail;
  bool complete = e.shared.block_begun.load(std::memory_order_relaxed) == 0;
  while (!complete && end != e.head) {
    const Record& r = e.ring[end++ & e.mask];
    if (r.kind == ItemKind::mark && r.mark.resume) {
      *last = r.serial;
      complete = true;
    }
  }
  if (complete) {
    if (e.optimal != nullptr) {
      e.optimal->truncate(end);
    } else {
      e.planner.truncate(end, in);
    }
    e.head = end;
  }
  return complete;
}

bool Executor::reread_asked() const {
  const ScanShared& shared = state_->shared;
  return shared.reread_request.load(std::memory_order_acquire) !=
         shared.reread_done.load(std::memory_order_relaxed);
}

bool Executor::interrupt_asked() const {
  return state_->shared.reread_interrupt.load(std::memory_order_relaxed) != 0;
}

bool Executor::mdi_asked() const { return state_->shared.reread_mdi.load(std::memory_order_relaxed) != 0; }

bool Executor::block_stop(BlockSeq* behind) const {
  const ScanStatus& status = state_->shared.status.read();
  *behind = status.stop_behind;
  return status.block_stop;
}

uint32_t Executor::starts() const { return state_->shared.status.read().starts; }

void Executor::let_mdi_wait(uint32_t starts) { state_->shared.mdi_waits.store(starts, std::memory_order_release); }

AxisVec Executor::left_at() const { return state_->shared.reread_from; }

AxisVec Executor::shift_asked() const {
  return state_->shared.reread_shift;
}

uint32_t Executor::returned() const { return state_->shared.returned.load(std::memory_order_relaxed); }

double Executor::handle_asked() const { return state_->shared.reread_handle; }

void Executor::tell_along_tool(bool added, const LengthAlongTool& length) {
  state_->shared.handle_added = added;
  state_->shared.along_tool = length;
}

Cut Executor::cut() const {
  return state_->shared.status.read().cut;
}

Serial Executor::give_up_ahead() {
  Serial last = 0;
  give_up_behind_block(&last);  // always complete: the scan lets no axis be moved by hand before the end of the block is committed
  return last;
}

void Executor::reread_done() {
  ScanShared& shared = state_->shared;
  shared.reread_done.store(shared.reread_request.load(std::memory_order_relaxed), std::memory_order_release);
}

void Executor::restart_at(const AxisVec& machine, uint64_t blocks) {
  state_->shared.restart_at = machine;
  state_->shared.restart_blocks = blocks;
  state_->shared.gone_on_inside.store(false, std::memory_order_relaxed);
}

bool Executor::gone_on_inside() const { return state_->shared.gone_on_inside.load(std::memory_order_acquire); }

bool Executor::poll_event(nc_event* event, uint64_t* dropped) {
  return state_->shared.events.pop(event, dropped);
}

Serial Executor::last_mark() const {
  return state_->shared.status.read().last_mark;
}

bool Executor::executed_mark(uint32_t epoch, uint32_t* cycle, BlockSeq* seq) {
  ExecutorState& e = *state_;
  for (const uint32_t end = tail(); e.seen != end; ++e.seen) {
    const Record& r = e.ring[e.seen & e.mask];
    const LeftRecord& left = e.left[e.seen & e.mask];
    if (r.kind != ItemKind::mark || !r.mark.resume || !left.executed || r.epoch != epoch) continue;
    *cycle = left.cycle;
    *seq = r.mark.seq;
    return true;
  }
  return false;
}

void Executor::take_executed_mark() {
  ++state_->seen;
}

uint32_t Executor::cycle_seen() const {
  return state_->shared.cycle.load(std::memory_order_acquire);
}

bool Executor::may_push() const {
  return state_->left == nullptr || state_->head - state_->seen < state_->config.capacity;
}

BlockSeq Executor::last_block() const {
  return state_->shared.status.read().last_block;
}

bool Executor::faulted(nc_source* where) const {
  const ScanStatus& status = state_->shared.status.read();
  *where = status.stopped_at;
  return status.faulted != ScanFault::none;
}

ScanFault Executor::scan_fault() const { return state_->shared.status.read().faulted; }

bool Executor::stopped(nc_source* where, BlockSeq* behind) const {
  const ScanStatus& status = state_->shared.status.read();
  *where = status.stopped_at;
  *behind = status.stopped_behind;
  return status.stopped;
}

uint8_t Executor::servo_ready() const {
  return state_->shared.status.read().servo_ready;
}

uint8_t Executor::referenced() const {
  return state_->shared.status.read().referenced;
}

AxisVec Executor::commanded() const {
  return state_->shared.status.read().command;
}

void Executor::set_position(const AxisVec& machine) {
  state_->scan.set_position(machine);
}

bool Executor::tool_cut(MountedTool* tool, uint32_t* ms) { return state_->shared.lives.pop(tool, ms); }
MountedTool Executor::tool_in_spindle() const { return state_->shared.status.read().tool; }
void Executor::tell_tool_life(uint32_t bits, uint32_t group) {
  state_->shared.tool_life.store(bits, std::memory_order_relaxed);
  state_->shared.tool_group.store(group, std::memory_order_relaxed);
}

nc_tap Executor::tap() const { return state_->shared.status.read().tap; }

bool Executor::set_tap(const nc_tap& tap) {
  if (cycle_seen() != 0) return false;
  state_->scan.set_tap(tap);
  return true;
}

void Executor::count_from(uint32_t first) {
  ExecutorState& e = *state_;
  e.head = e.seen = first;
  e.planner.count_from(first);
  if (e.optimal != nullptr) e.optimal->count_from(uint64_t{first});
  e.shared.tail.store(first);
  e.shared.ordinal.store(first);
  e.shared.run.store(first & ~1u);
  e.shared.run_taken.store(first & ~1u);
  e.shared.reread_request.store(first);
  e.shared.reread_done.store(first);
  e.shared.truncation.count_from(first);
  e.shared.events.count_from(first);
  e.scan.count_from(first);
}

void Executor::cycle(const nc_inputs& in, nc_outputs& out) {
  state_->scan.cycle(in, out);
}

}  // namespace nc
