// SPDX-License-Identifier: Apache-2.0
// The real-time part of a bus of drives: one cycle, and the frames from the bus. The handling of one axis is in cyclic_axis.cpp. See cyclic.hpp.
#include "hal/canopen/cyclic.hpp"

#include <algorithm>
#include <cmath>

#include "hal/canopen/bus_load.hpp"

namespace nc::hal::canopen {
namespace {

constexpr unsigned kFramesPerCycle = 256;  // more than a bus carries in a cycle of 1 ms
constexpr double kSilences = 2.5;          // a node is lost after this number of heartbeat periods without a heartbeat
constexpr double kStandstill = 0.005;      // mm or deg: more than the noise of an encoder
constexpr double kStepSlack = 0.1;         // mm or deg: a step of an axis that stands, by which its drive may correct itself
constexpr double kTurnSlack = 0.01;        // turns of a motor: the same of a spindle
constexpr std::uint8_t kStateBootUp = 0, kStateOperational = 5;

}  // namespace

Cyclic::Cyclic(const BusMap& bus, CanPort* port)
    : bus_(bus),
      port_(port),
      heartbeat_ns_(bus.heartbeat_ms * 1'000'000LL),
      heartbeat_limit_ns_(static_cast<std::int64_t>(bus.heartbeat_ms * 1e6 * kSilences)),
      command_limit_ns_(bus.command_timeout_ms * 1'000'000LL),
      cycles_per_sync_(std::max(1u, bus.sync_us / bus.cycle_us)),
      slow_every_(slow_every(bus)) {
  node_at_.fill(-1);
  for (unsigned n = 0; n < bus_.nodes.size() && n < kMaxNodes; ++n) {
    const NodeMap& node = bus_.nodes[n];
    nodes_.push_back({});
    nodes_.back().id = node.id;
    nodes_.back().drives = !node.axes.empty();
    if (node.module) modules_.push_back({n, std::make_unique<ModuleIo>(node, bus.lost_after)});
    node_at_[node.id & kLastNode] = static_cast<std::int8_t>(n);
    unsigned sends = 0, takes = 0;
    for (const AxisMap& map : node.axes) {
      Axis axis;
      axis.map = &map;
      axis.node = n;
      axis.count = count_of(map);
      const double per_unit = std::abs(map.increments_per_unit);
      axis.loop = LostLoop(std::max<std::int64_t>(1, std::llround(kStandstill * per_unit)));
      if (map.holds_position()) axis.watch = WayWatch(map.velocity_gain, bus.sync_us * 1e-6, map.following_limit * per_unit, map.velocity_delay);
      axis.way = DriveWay(static_cast<unsigned>(syncs_of(bus.stop_timeout_ms)));
      axis.rpdo_id = static_cast<std::uint16_t>(kRpdoId + kPdoStep * takes++ + node.id);
      axis.tpdo_id = static_cast<std::uint16_t>(kTpdoId + kPdoStep * sends++ + node.id);
      if (map.has_probe()) axis.probe_id = static_cast<std::uint16_t>(kTpdoId + kPdoStep * sends++ + node.id);
      wanted_mode_[axes_.size()].store(map.mode, std::memory_order_relaxed);
      axes_.push_back(axis);
    }
  }
}

// What the axis can move in some time, in increments of its drive.
PositionCount Cyclic::count_of(const AxisMap& map) const noexcept {
  const std::int64_t sync_ns = bus_.sync_us * 1000LL;
  if (!map.spindle) return {map.max_velocity * std::abs(map.increments_per_unit), kStepSlack * std::abs(map.increments_per_unit), sync_ns};
  double turns = 0;
  for (const double gear : map.spindle->gears) turns = std::max(turns, std::abs(gear));
  return {map.spindle->law.most * turns * map.spindle->increments, kTurnSlack * map.spindle->increments, sync_ns};
}

void Cyclic::cycle(std::int64_t now_ns) noexcept {
  const bool sync = cycles_++ % cycles_per_sync_ == 0;
  if (sync) {
    CanFrame frame;
    frame.id = kSyncId;
    send(frame);
    statistics_.syncs.fetch_add(1, std::memory_order_relaxed);
  }
  take_frames(now_ns);
  if (sync) {
    sync_ns_ = now_ns;
    watch_nodes(now_ns);
    for (unsigned i = 0; i < axes_.size(); ++i) watch_axis(i);
    const bool commanded = take_wanted(now_ns);
    for (unsigned i = 0; i < axes_.size(); ++i) move_axis(i, commanded);
    given_[1] = given_[0];
    given_[0] = serial_;
    note_edges();
    work_modules();
  }
  if (now_ns - beat_ns_ >= heartbeat_ns_) {
    CanFrame beat;
    beat.id = static_cast<std::uint16_t>(kHeartbeatId + bus_.own_id);
    beat.length = 1;
    beat.data[0] = kStateOperational;
    send(beat);
    beat_ns_ = now_ns;
  }
  bool any = false;  // while no node is operational, the slow part may send with every SYNC
  for (const Node& node : nodes_) any |= node.operational;
  if (sync && ++slow_wait_ >= (any ? slow_every_ : 1)) {
    CanFrame slow;
    if (out_.pop(&slow)) {
      send(slow);
      slow_wait_ = 0;
    }
  }
  publish();
}

void Cyclic::send(const CanFrame& frame) noexcept {
  (port_->send(frame) ? statistics_.sent : statistics_.send_failed).fetch_add(1, std::memory_order_relaxed);
}

// ---- from the bus ----

void Cyclic::take_frames(std::int64_t now_ns) noexcept {
  CanFrame frame;
  for (unsigned n = 0; n < kFramesPerCycle && port_->receive(&frame); ++n) dispatch(frame, now_ns);
}

void Cyclic::dispatch(const CanFrame& frame, std::int64_t now_ns) noexcept {
  if (frame.event != BusEvent::kNone) return take_event(frame.event);
  statistics_.received.fetch_add(1, std::memory_order_relaxed);
  if (bus_off_) take_event(BusEvent::kRestarted);  // a frame that is received shows that the bus works again
  if (take_tpdo(frame)) return;
  const unsigned id = frame.id & kLastNode, kind = frame.id & ~kLastNode;
  const std::int8_t node = node_at_[id];
  if (node >= 0 && kind == kHeartbeatId) return take_heartbeat(static_cast<unsigned>(node), frame, now_ns);
  if (node >= 0 && kind == kEmergencyId && id != 0) return take_emergency(static_cast<unsigned>(node), frame);
  if (node >= 0 && kind == kSdoAnswerId) return hand_over(frame);
  statistics_.strange.fetch_add(1, std::memory_order_relaxed);
}

// While the bus is off, the state of the nodes is unknown. When the bus is back, each node is set up again, because it may have been without power.
void Cyclic::take_event(BusEvent event) noexcept {
  if (event == BusEvent::kBusOff) {
    if (!bus_off_) statistics_.bus_off.fetch_add(1, std::memory_order_relaxed);
    bus_off_ = true;
    for (unsigned n = 0; n < nodes_.size(); ++n) set_phase(n, NodePhase::kAway);
  } else if (event == BusEvent::kRestarted && bus_off_) {
    bus_off_ = false;
  }
}

// A module whose node is operational while its inputs stay away is set up again.
void Cyclic::work_modules() noexcept {
  for (Module& module : modules_) {
    const bool operational = nodes_[module.node].operational;
    if (!module.io->sync(operational) && operational) set_phase(module.node, NodePhase::kAway);
    module.io->give([this](const CanFrame& frame) { send(frame); });
  }
}

bool Cyclic::take_tpdo(const CanFrame& frame) noexcept {
  for (Module& module : modules_) {
    const ModuleIo::Taken taken = module.io->take(frame, phase(module.node) == NodePhase::kOperational);
    if (taken == ModuleIo::Taken::kStrange) statistics_.strange.fetch_add(1, std::memory_order_relaxed);
    if (taken != ModuleIo::Taken::kNotMine) return true;
  }
  for (Axis& axis : axes_) {
    if (frame.id != axis.tpdo_id && (axis.probe_id == 0 || frame.id != axis.probe_id)) continue;
    if (frame.length < 6) {  // the PDO does not have the mapping that was written into the drive
      statistics_.strange.fetch_add(1, std::memory_order_relaxed);
    } else if (phase(axis.node) == NodePhase::kOperational) {
      if (frame.id == axis.tpdo_id) take_position(&axis, frame);
      else take_probe(&axis, frame);
    }
    return true;
  }
  return false;
}

// The position goes on counting when the drive's 32 bits overflow, and a step that the axis cannot make is a fault (position_count.hpp). It was measured with the last SYNC whose answers can have come: in the cycle of a SYNC that
// is the one before, since the frames are taken right behind it. What had been given before that SYNC was in force then (cyclic.hpp).
void Cyclic::take_position(Axis* axis, const CanFrame& frame) noexcept {
  const auto raw = static_cast<std::int32_t>(get_le(frame.data + 2, 4));
  if (!axis->count.take(raw, sync_ns_)) {
    lose_place(axis);
    fault(axis, DriveTrouble::kStep);
  }
  axis->position = axis->count.position();
  axis->measured_at = given_[1];
  axis->measured_ns = sync_ns_;
  axis->status = static_cast<std::uint16_t>(get_le(frame.data, 2));
  axis->known = true;
  axis->set_up_again = false;
  ++axis->ahead;
  axis->fresh = true;
}

void Cyclic::take_probe(Axis* axis, const CanFrame& frame) noexcept {
  axis->probe_status = static_cast<std::uint16_t>(get_le(frame.data, 2));
  axis->probe_raw = static_cast<std::int32_t>(get_le(frame.data + 2, 4));
}

void Cyclic::hand_over(const CanFrame& frame) noexcept {
  if (!in_.push(frame)) statistics_.strange.fetch_add(1, std::memory_order_relaxed);
}

// A node that boots again or leaves "operational" has lost its set-up, so it is set up again.
void Cyclic::take_heartbeat(unsigned n, const CanFrame& frame, std::int64_t now_ns) noexcept {
  if (frame.length < 1) return;
  nodes_[n].heard_ns = now_ns;
  const std::uint8_t state = frame.data[0] & 0x7F;
  if (state == kStateBootUp) nodes_[n].emergency = 0;  // what it has said before is of another life
  if (phase(n) == NodePhase::kOperational && state != kStateOperational) {
    for (Axis& axis : axes_)
      if (axis.node == n) fault(&axis, DriveTrouble::kRestarted);
    set_phase(n, NodePhase::kAway);
  }
  if (phase(n) != NodePhase::kOperational || state == kStateBootUp) hand_over(frame);
}

void Cyclic::take_emergency(unsigned n, const CanFrame& frame) noexcept {
  if (frame.length < 3) return;
  nodes_[n].emergency = static_cast<std::uint16_t>(get_le(frame.data, 2));
  nodes_[n].error_register = frame.data[2];
  hand_over(frame);
}

void Cyclic::watch_nodes(std::int64_t now_ns) noexcept {
  for (unsigned n = 0; n < nodes_.size(); ++n) {
    Node& node = nodes_[n];
    const bool operational = phase(n) == NodePhase::kOperational;
    if (operational && !node.operational) node.heard_ns = now_ns;
    const bool silent = operational && now_ns - node.heard_ns > heartbeat_limit_ns_;
    for (Axis& axis : axes_) {
      if (axis.node != n) continue;
      if (operational && !node.operational) {
        axis.missed = 0;
        axis.ahead = 0;
        axis.status = 0;
        axis.fresh = true;
        axis.probe_status = axis.probe_function = 0;
        axis.probe_on = axis.edge_waits = false;
        axis.track.clear();
      }
      if (silent) fault(&axis, DriveTrouble::kHeartbeat);
      if (!node.operational || (operational && !silent)) continue;
      fault(&axis, bus_off_ ? DriveTrouble::kHeartbeat : DriveTrouble::kRestarted);  // has no effect when a more exact reason was noted before
      lose_place(&axis);  // nobody knows whether the drive has counted on
    }
    if (silent) set_phase(n, NodePhase::kAway);
    node.operational = operational && !silent;
  }
}

// The drive may count from another zero now, so its positions are taken as they come until the axis is led again, and it is not homed.
void Cyclic::lose_place(Axis* axis) noexcept {
  axis->homed = false;
  axis->count.forget();
  ++axis->places_lost;
}

// ---- to the scan ----

bool Cyclic::has_torque(const Axis& axis) const noexcept {
  const DriveState state = drive_state(axis.status);
  return nodes_[axis.node].operational && (state == DriveState::kOperationEnabled || state == DriveState::kQuickStopActive);
}

// What the alarm of a faulty axis says. That its node was refused when it came back is worth more than the reason for which it had stopped, because
// a reset alone does not help then.
std::uint32_t Cyclic::fault_code(const Axis& axis) const noexcept {
  const Node& node = nodes_[axis.node];
  if (phase(axis.node) == NodePhase::kRefused) return drive_fault_code(DriveTrouble::kNotConfigured);
  if (axis.trouble != DriveTrouble::kNone || node.emergency == 0) return drive_fault_code(axis.trouble);
  return drive_fault_code(DriveTrouble::kEmergency, node.emergency, node.error_register);
}

void Cyclic::publish() noexcept {
  BusShown& shown = shown_.back();
  bool any = false, all = !bus_off_;
  for (const Node& node : nodes_) {
    if (!node.drives) continue;
    any |= node.operational;
    all &= node.operational;
  }
  shown.lost = bus_off_ || !any;
  shown.serial = serial_;
  shown.latched = latched_;
  for (unsigned i = 0; i < axes_.size(); ++i) {
    const Axis& axis = axes_[i];
    AxisShown& out = shown.axis[i];
    enabled_[i].store(has_torque(axis), std::memory_order_relaxed);
    out.position = axis.position;
    out.measured_at = axis.measured_at;
    out.measured_ns = axis.measured_ns;
    out.known = axis.known;
    all &= axis.known;
    out.follows = follows(i);
    out.homed = axis.homed;
    out.places_lost = axis.places_lost;
    out.homing = axis.homing != Homing::kNo;
    out.following_fault = axis.following_fault || axis.loop.waits_for_reset();
    out.fault = axis.faulty ? kFaulty | fault_code(axis) : 0;
    out.edge = axis.edge;
    out.probe_on = axis.probe_on;
  }
  shown_.publish();
  ready_.store(all, std::memory_order_release);
}

}  // namespace nc::hal::canopen
