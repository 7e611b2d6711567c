// SPDX-License-Identifier: Apache-2.0
// A simulated drive for tests: an object dictionary with an SDO server, NMT, PDOs on SYNC, the states of CiA 402, heartbeats in both directions,
// and for each axis a plant whose position is known. It was written from the standards, and uses no code of the master but the frame.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hal/canopen/frame.hpp"

namespace nc::test {

using hal::canopen::CanFrame;

// One axis: what its motor really does, whatever the drive reports.
struct SimPlantAxis {
  double position = 0;      // increments
  double lag = 0;           // share of the distance to the command that is left after each SYNC, 0 = stiff
  bool blocked = false;
  std::int32_t command = 0;
  bool enabled = false;     // torque
  double velocity = 0;      // increments per second, in the velocity modes
  double coast = 0;         // increments per SYNC at which it coasts on without torque
  double turns = 1;         // in the velocity modes: -1 = the motor turns against its command
  std::optional<double> encoder_at;  // what the encoder says, wherever the motor is: it stands, or has jumped there
};

class SimDrive {
 public:
  explicit SimDrive(unsigned node, unsigned axes = 1);

  // Gets the frames that the drive sends.
  std::function<void(const CanFrame&)> out;
  void on_frame(const CanFrame& frame);
  // To be called as time passes: for heartbeats and delays.
  void tick(std::int64_t now_ns);

  SimPlantAxis& plant(unsigned axis = 0) { return axis_[axis].plant; }
  std::uint32_t object(unsigned index, unsigned sub) const;
  void set_object(unsigned index, unsigned sub, unsigned bytes, std::uint32_t value, bool writable = true);
  void remove_object(unsigned index, unsigned sub) { objects_.erase(key(index, sub)); }
  std::uint16_t status(unsigned axis = 0) const;
  unsigned nmt_state() const { return nmt_; }
  unsigned node() const { return node_; }
  std::int32_t speed(unsigned axis = 0) const { return axis_[axis].pending_velocity; }  // 60FFh
  bool enabled(unsigned axis = 0) const { return axis_[axis].state == State::kEnabled; }

  // ---- faults ----
  bool dead = false;               // no power
  bool no_heartbeat = false;
  bool no_tpdo = false;
  bool faults_at_enabling = false;
  bool never_enables = false;
  bool keeps_fault = false;        // what its fault is about goes on: a reset does not help
  bool keeps_mapping = false;      // accepts another mapping without an error, but keeps its own
  bool answers_segmented = false;  // sends numbers in segments, too
  std::map<unsigned, std::uint32_t> refuses;  // index << 8 | sub -> abort code of a write
  int answers_as = -1;             // node number in its SDO answers; -1: its own
  bool homing_fails = false;
  int homing_syncs = 50;           // so many SYNCs a homing takes
  int homing_begins = 0;           // so many SYNCs behind the start bit the status is that of the homing before, and the axis stands; -1: for ever
  bool offset_subtracts = false;   // at the mark its position is -607Ch, as the figure of CiA 402 draws it, in place of 607Ch
  void trip(unsigned axis, std::uint16_t code, std::uint8_t error_register);  // fault, and EMCY
  void emergency(std::uint16_t code, std::uint8_t error_register);
  void power_cycle();
  std::function<void()> more_defaults;  // sets further objects, also when it boots again
  bool unheard = false;            // its boot-up message is lost
  bool starts_itself = false;      // it is "operational" behind its boot, with the PDOs that it has by itself
  bool loses_position = false;     // its encoder counts from 0 when it boots
  double sync_s = 0.001;           // time between two SYNCs, for its velocity modes
  double velocity_ramp = 1e12;     // increments per second and SYNC that its motor gains
  unsigned stored_heartbeat = 0;   // 1017h, as it has it by itself
  void leave_enabled(unsigned axis) { axis_[axis].state = State::kSwitchOnDisabled; }  // as a safety input (STO) does
  void probe_edge(unsigned axis = 0);  // its touch probe input rises ...
  void probe_edge(unsigned axis, long place);  // ... where the axis was at `place`, in increments

  // Counts of what the drive has received.
  unsigned syncs = 0, rpdos = 0, resets_seen = 0;
  std::set<unsigned> heard_heartbeats;

 private:
  enum class State { kSwitchOnDisabled, kReady, kSwitchedOn, kEnabled, kQuickStop, kFaultReaction, kFault };
  struct Axis {
    State state = State::kSwitchOnDisabled;
    std::uint16_t control = 0, before = 0, pending_control = 0;
    std::int32_t pending_target = 0;
    std::int32_t pending_velocity = 0;  // 60FFh, increments per second
    std::uint16_t pending_probe = 0, probe_before = 0;
    bool pending = false;
    unsigned delay = 0;
    int homing_left = -1, homing_waits = 0;
    bool homing_done = false, homing_error = false;
    bool probe_stored = false;
    std::int32_t probe_position = 0;
    SimPlantAxis plant;
  };
  struct Object {
    unsigned bytes = 4;
    std::uint32_t value = 0;
    bool writable = true;
    std::vector<std::uint8_t> text;
  };
  struct Transfer {
    bool upload = false, download = false, toggle = false;
    unsigned key = 0;
    std::vector<std::uint8_t> data;
    std::size_t at = 0;
  };

  static unsigned key(unsigned index, unsigned sub) { return index << 8 | sub; }
  static unsigned base(unsigned axis) { return 0x6000 + 0x800 * axis; }
  void defaults();
  void send(unsigned id, std::vector<std::uint8_t> data);
  void on_nmt(const CanFrame& frame);
  void on_sdo(const CanFrame& frame);
  void sdo_abort(unsigned index, unsigned sub, std::uint32_t code);
  std::uint32_t write_object(unsigned index, unsigned sub, const std::vector<std::uint8_t>& data);
  std::uint32_t check_mapping(unsigned index, unsigned count);
  void on_rpdo(const CanFrame& frame);
  void on_sync();
  void run(Axis& axis, unsigned number);
  void command_state(Axis& axis);
  void move(Axis& axis, unsigned number);
  void home(Axis& axis, unsigned number);
  std::uint32_t value_of(unsigned entry) const;
  void take_value(unsigned entry, std::uint32_t value);

  unsigned node_;
  std::vector<Axis> axis_;
  std::map<unsigned, Object> objects_;
  Transfer transfer_;
  unsigned nmt_ = 0x7F;  // 4 stopped, 5 operational, 7F pre-operational
  std::int64_t now_ns_ = 0, beat_ns_ = 0, master_heard_ns_ = -1;
};

}  // namespace nc::test
