// SPDX-License-Identifier: Apache-2.0
// The real-time part of a bus of drives: SYNC, PDOs, the state machine of each axis, heartbeats, and what is watched. cycle() is called once
// per servo cycle in the bus's thread: bounded work, no allocation, no lock, no system call other than the port's send and receive.
//
//   cycle k:  SYNC ─▶ frames that have come in ─▶ RPDOs with the newest positions of the scan ─▶ heartbeat, a frame of the slow part ─▶ publish
//
// With SYNC k+1 a drive takes over the set-point that came after SYNC k, and with SYNC k it measures the position that it reports. So a position of the scan
// takes effect one to two cycles later, and the following error is measured from the commands of the last SYNCs (check_following()).
//
// It exchanges images with the scan (triple buffers), and frames (queues) and a phase for each node with the slow part (service.hpp).
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "hal/canopen/bus_map.hpp"
#include "hal/canopen/can_port.hpp"
#include "hal/canopen/drive_state.hpp"
#include "hal/canopen/homing_answer.hpp"
#include "hal/canopen/lost_loop.hpp"
#include "hal/canopen/module_io.hpp"
#include "hal/canopen/position_count.hpp"
#include "hal/canopen/position_track.hpp"
#include "hal/canopen/way_watch.hpp"
#include "hal/drive_fault.hpp"
#include "hal/spsc.hpp"
#include "hal/triple_buffer.hpp"

namespace nc::hal::canopen {

// The phase of a node; the slow part brings it forward.
enum class NodePhase : std::uint8_t {
  kAway,         // the node has not answered yet, or is lost
  kSetUp,        // its objects are being written
  kOperational,  // its PDOs are used
  kRefused       // it cannot be set up, which somebody has to look at; the set-up is tried again after some seconds
};

// What the scan wants of one axis.
struct AxisWanted {
  std::int64_t target = 0;  // increments; of a spindle the value of 60FFh
  bool on = false;
  bool reset = false;       // clear faults; if the drive has a fault, reset it, too
  bool home = false;        // homing begins at the rising edge
  bool stop_homing = false; // homing that is under way is given up: the drive comes to rest and follows again
};
struct BusWanted {
  std::uint64_t serial = 0;  // number of the command; counts up with each scan
  std::int64_t stamp_ns = 0;
  std::array<AxisWanted, kMaxAxes> axis{};
};

// What the scan sees of one axis.
struct AxisShown {
  std::int64_t position = 0;  // increments
  std::uint64_t measured_at = 0;  // serial number of the command at which a drive that follows stood when `position` was measured
  std::int64_t measured_ns = 0;   // time of the SYNC with which `position` was measured
  bool known = false;         // a position has come
  bool follows = false;       // the drive is enabled, in cyclic position, and bit 12 says that it follows the command
  bool homed = false;
  bool homing = false;
  unsigned places_lost = 0;   // how often nobody has known any more whether the drive counts from the same zero; unlike a fault no reset takes it back
  bool following_fault = false;
  std::uint32_t fault = 0;    // drive_fault_code() | kFaulty
  std::int64_t edge = 0;      // position at the newest edge of a touch probe in the part system, in increments
  bool probe_on = false;      // the touch probe of this axis gives its skip signal
};
inline constexpr std::uint32_t kFaulty = 0x80000000u;
struct BusShown {
  std::array<AxisShown, kMaxAxes> axis{};
  std::array<std::uint32_t, NC_MAX_SYSTEMS> latched{};  // bit n: `edge` of the axes of the part system is where skip signal n+1 came
  bool lost = true;  // the bus is off, or no node is operational
  std::uint64_t serial = 0;  // serial number of the last command that has been carried out
};

struct CyclicStatistics {
  std::atomic<std::uint64_t> syncs{0}, sent{0}, received{0}, send_failed{0}, missed_positions{0}, missed_commands{0}, strange{0}, bus_off{0};
};

class Cyclic {
 public:
  Cyclic(const BusMap& bus, CanPort* port);

  // ---- bus's thread ----
  void cycle(std::int64_t now_ns) noexcept;
  // The time at which the scan gave its last command. The bus's thread keeps its cycle half a period after it.
  std::int64_t scan_stamp_ns() const noexcept { return wanted_.front().stamp_ns; }

  // ---- scan ----
  BusWanted& wanted() noexcept { return wanted_.back(); }
  void give() noexcept { wanted_.publish(); }
  const BusShown& shown() noexcept {
    shown_.take();
    return shown_.front();
  }

  // ---- slow part ----
  bool from_bus(CanFrame* frame) noexcept { return in_.pop(frame); }
  bool to_bus(const CanFrame& frame) noexcept { return out_.push(frame); }
  void set_phase(unsigned node, NodePhase phase) noexcept { phase_[node].store(phase, std::memory_order_release); }
  // The set-up of a node has come to its end. False when the bus's thread has taken the node for lost meanwhile: then it stays away.
  bool set_operational(unsigned node) noexcept {
    NodePhase before = NodePhase::kSetUp;
    return phase_[node].compare_exchange_strong(before, NodePhase::kOperational, std::memory_order_acq_rel);
  }
  NodePhase phase(unsigned node) const noexcept { return phase_[node].load(std::memory_order_acquire); }
  // The mode that an axis should be in, and (set) the mode that its drive has confirmed.
  std::int8_t wanted_mode(unsigned axis) const noexcept { return wanted_mode_[axis].load(std::memory_order_acquire); }
  void set_mode(unsigned axis, std::int8_t mode) noexcept { mode_[axis].store(mode, std::memory_order_release); }

  // ---- any thread ----
  // The n-th I/O module of the bus.
  ModuleIo* module(unsigned index) const noexcept { return modules_[index].io.get(); }
  unsigned module_count() const noexcept { return static_cast<unsigned>(modules_.size()); }
  const CyclicStatistics& statistics() const { return statistics_; }
  unsigned axis_count() const { return static_cast<unsigned>(axes_.size()); }
  const AxisMap& axis(unsigned index) const { return *axes_[index].map; }
  // True when every drive is operational and every axis has sent its position.
  bool ready() const noexcept { return ready_.load(std::memory_order_acquire); }
  // True while the drive controls the axis: its operation is enabled, or it is stopping.
  bool is_enabled(unsigned index) const noexcept { return enabled_[index].load(std::memory_order_relaxed); }

 private:
  static constexpr unsigned kTargets = kMostVelocityDelay + 2;
  enum class Homing : std::uint8_t { kNo, kMode, kRuns, kStops, kBack };
  struct Axis {
    const AxisMap* map = nullptr;
    unsigned node = 0;
    std::uint16_t rpdo_id = 0, tpdo_id = 0, probe_id = 0;
    DriveWay way;
    LostLoop loop;  // of an axis whose position is held here
    WayWatch watch;  // the same
    std::uint16_t status = 0, control = 0;
    PositionCount count;
    std::int64_t position = 0;  // of `count`
    unsigned places_lost = 0;   // as AxisShown::places_lost
    std::uint64_t measured_at = 0;  // as AxisShown::measured_at
    std::int64_t measured_ns = 0;   // as AxisShown::measured_ns
    bool known = false, fresh = false;
    unsigned missed = 0;         // SYNCs in a row without a position
    bool set_up_again = false;   // its node was, because positions did not come; none has come since
    int ahead = 0;               // positions received minus SYNCs sent
    std::int64_t target[kTargets] = {};  // set-points of the last SYNCs, the newest first; of a spindle the value of 60FFh
    std::int32_t speed = 0;              // value of 60FFh of an axis whose position is held here
    unsigned on_syncs = 0;       // SYNCs since the axis was to be switched on
    bool was_on = false;         // the drive has followed since then
    DriveTrouble trouble = DriveTrouble::kNone;
    bool faulty = false, following_fault = false;
    unsigned reset_left = 0;     // SYNCs in which a fault is still being reset
    bool in_fault = false;       // its newest status says so
    Homing homing = Homing::kNo;
    unsigned homing_syncs = 0;
    HomingAnswer answer;
    bool home_before = false, homed = false;
    unsigned mode_syncs = 0;      // of a homing that waits for its mode: SYNCs in it
    std::int64_t stop_place = 0;  // of one that is given up: where it was last seen to move
    unsigned stood_syncs = 0;     // since then
    // touch probe
    std::uint16_t probe_status = 0, probe_function = 0;
    std::int32_t probe_raw = 0;
    std::int64_t probe = 0;      // the place that the drive has latched, in increments
    unsigned probe_syncs = 0;
    bool probe_on = false, edge_waits = false;  // it gives its signal; the drive has latched a place, and the signal waits until those of the other axes are known
    unsigned edge_syncs = 0;     // SYNCs for which it has waited
    std::int64_t edge = 0;       // position at the newest edge of a probe in the part system
    PositionTrack track;
  };
  struct Node {
    unsigned id = 0;
    std::int64_t heard_ns = 0;
    bool operational = false;  // state in the last cycle
    bool drives = false;       // it has axes
    std::uint16_t emergency = 0;
    std::uint8_t error_register = 0;
  };

  void take_frames(std::int64_t now_ns) noexcept;
  void dispatch(const CanFrame& frame, std::int64_t now_ns) noexcept;
  void take_event(BusEvent event) noexcept;
  bool take_tpdo(const CanFrame& frame) noexcept;
  void take_position(Axis* axis, const CanFrame& frame) noexcept;
  void take_probe(Axis* axis, const CanFrame& frame) noexcept;
  void take_heartbeat(unsigned node, const CanFrame& frame, std::int64_t now_ns) noexcept;
  void take_emergency(unsigned node, const CanFrame& frame) noexcept;
  void forget_emergency(unsigned node) noexcept;
  void hand_over(const CanFrame& frame) noexcept;
  void watch_nodes(std::int64_t now_ns) noexcept;
  void work_modules() noexcept;
  void watch_axis(unsigned index) noexcept;
  bool silent_for_good(const Axis& axis) const noexcept;
  bool take_wanted(std::int64_t now_ns) noexcept;
  void move_axis(unsigned index, bool commanded) noexcept;
  DriveWish wish_of(Axis* axis, const AxisWanted& wanted, bool commanded) noexcept;
  std::int64_t target_of(Axis* axis, const AxisWanted& wanted) noexcept;
  std::int32_t speed_of(const Axis& axis) const noexcept;
  void check_following(Axis* axis) noexcept;
  void check_way(Axis* axis, bool led) noexcept;
  std::int64_t syncs_of(unsigned ms) const noexcept { return std::int64_t{ms} * 1000 / bus_.sync_us; }
  bool home_axis(unsigned index, Axis* axis, const AxisWanted& wanted) noexcept;
  void begin_homing(Axis* axis, std::int8_t mode) noexcept;
  bool judge_homing(Axis* axis) noexcept;
  void give_up_homing(Axis* axis, const AxisWanted& wanted) noexcept;
  void work_probe(Axis* axis) noexcept;
  void note_edges() noexcept;
  bool knows_places(const Axis& probe) const noexcept;
  void note_edge(const Axis& probe) noexcept;
  void send_rpdo(const Axis& axis) noexcept;
  void send(const CanFrame& frame) noexcept;
  void fault(Axis* axis, DriveTrouble trouble) noexcept;
  PositionCount count_of(const AxisMap& map) const noexcept;
  void lose_place(Axis* axis) noexcept;
  std::uint32_t fault_code(const Axis& axis) const noexcept;
  void publish() noexcept;
  bool follows(unsigned index) const noexcept;
  bool has_torque(const Axis& axis) const noexcept;
  static std::int64_t still_of(const Axis& axis) noexcept;

  const BusMap bus_;
  CanPort* port_;
  const std::int64_t heartbeat_ns_, heartbeat_limit_ns_, command_limit_ns_;
  const unsigned cycles_per_sync_, slow_every_;
  std::vector<Axis> axes_;
  std::vector<Node> nodes_;
  struct Module {
    unsigned node = 0;
    std::unique_ptr<ModuleIo> io;
  };
  std::vector<Module> modules_;
  std::array<std::int8_t, kLastNode + 1> node_at_{};  // index in nodes_ for each node id, -1 = not configured

  TripleBuffer<BusWanted> wanted_{BusWanted{}};
  TripleBuffer<BusShown> shown_{BusShown{}};
  SpscQueue<CanFrame, 512> in_;
  SpscQueue<CanFrame, 64> out_;
  std::array<std::atomic<NodePhase>, kMaxNodes> phase_{};
  std::array<std::atomic<std::int8_t>, kMaxAxes> wanted_mode_{}, mode_{};
  std::array<std::atomic<bool>, kMaxAxes> enabled_{};
  std::atomic<bool> ready_{false};
  CyclicStatistics statistics_;

  unsigned cycles_ = 0, slow_wait_ = 0;
  std::int64_t beat_ns_ = 0;
  std::int64_t command_ns_ = 0;  // time at which the last new command of the scan was seen
  std::int64_t sync_ns_ = 0;  // time of the last SYNC whose answers can have come
  std::array<std::uint32_t, NC_MAX_SYSTEMS> latched_{};  // as BusShown::latched
  std::uint64_t serial_ = 0;
  std::uint64_t given_[2] = {};  // serial numbers of the commands that went to the drives after the last SYNC and after the one before
  bool fresh_command_ = false;
  unsigned late_syncs_ = 0;  // SYNCs in a row without one
  bool bus_off_ = false;
};

}  // namespace nc::hal::canopen
