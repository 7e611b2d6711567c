// SPDX-License-Identifier: Apache-2.0
// The simulated machine. Its time is that of the scan (one pair of read() and write() is one
// cycle), so that it behaves in the same way in real and in virtual time.
//
//  * axes: first-order servo. A position loop with gain Kv = 1/lag follows a ramp with the constant error v * lag:
//      actual += (command - actual) * (1 - exp(-cycle/lag)).  Beyond following_error_limit the axis has a fault.
//      Without its drive (switched off, bus lost) it coasts: its speed fades with the time constant coast_s.
//  * spindles: their speed follows the commanded one with a fixed ramp; M03/M04 turn those that the NC has selected,
//  M05 (and M02/M30) stops them. One that is an axis too becomes that axis with its servo (sim_spindle.hpp).
//  * M, S, T, B: FIN comes after the time of the function (tool change, spindle ramp, m_time) and drops with
//  the strobe. With a plant (sim_plant.hpp) spindle and tools are driven by points, and FIN is the ladder's.
//  * index tables: the clamp of an axis answers after its times (sim_clamp.hpp); it holds nothing.
//  * switches of an axis at places of the machine, its brake and its weight (sim_switches.hpp).
//  * skip: signal n is on while the actual point is inside one of its solids.
//  * points: inputs are what the script says (else their initial value); outputs are recorded.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/hal.hpp"
#include "hal/sim/input_script.hpp"
#include "hal/sim/sim_clamp.hpp"
#include "hal/sim/sim_plant.hpp"
#include "hal/sim/sim_switches.hpp"

namespace nc::hal {

// A box in machine coordinates; an axis without limits is unbounded.
struct SimSolid {
  unsigned system = 0;  // index of the part system
  unsigned signal = 1;  // skip signal 1..8
  double min[NC_MAX_AXES];
  double max[NC_MAX_AXES];
  SimSolid();
};

struct SimAxis {
  double lag_s = 0.0;                // 0 = the measured position is the command of the previous cycle
  double following_error_limit = 0;  // mm or deg; 0 = never faults
  double coast_s = 0.03;             // 0 = stands at once
  SimClamp clamp;                    // of an index table
  SimSwitches switches;
};

struct SimConfig {
  double cycle_s = 0.001;
  std::uint8_t dialect = 0;  // nc_dialect, which gives the meaning of M codes
  unsigned system_count = 1;
  unsigned axis_count[NC_MAX_SYSTEMS] = {3, 0, 0, 0};
  SimAxis axis[NC_MAX_SYSTEMS][NC_MAX_AXES];
  nc_axes start[NC_MAX_SYSTEMS] = {};
  unsigned spindle_count[NC_MAX_SYSTEMS] = {1, 1, 1, 1};
  std::uint8_t axis_spindle[NC_MAX_SYSTEMS][NC_MAX_AXES] = {};  // number of the spindle that is this axis, 0 = none
  double spindle_ramp_rpm_per_s = 3000.0;
  double spindle_max_rpm = 12000.0;
  double tool_change_s = 1.0;   // time of the M code for a tool change
  double tool_select_s = 0.02;  // time of T
  double m_time_s = 0.01;       // time of every other M, S and B
  SimPlantConfig plant;         // spindle and tool changer that points drive instead of codes
  std::vector<SimSolid> solids;
  std::vector<InputChange> script;
};

// One recorded change of an output point.
struct SimOutputChange {
  std::uint64_t scan;
  unsigned point;
  std::uint32_t value;
};

class SimMachine final : public Hal {
 public:
  SimMachine(const SimConfig& config, const PointTable& table);

  bool start(const PointImage& initial, std::string* error) override;
  void read(Feedback* feedback, PointImage* image) noexcept override;
  void write(const Command& command, const PointImage& image) noexcept override;
  void stop() noexcept override;

  // For tests and the terminal. Same thread as the scan, or after it has stopped.
  const nc_axes& actual(unsigned system) const { return system_[system].actual; }  // as its encoders count
  double place(unsigned system, unsigned axis) const {  // where the axis really is on the machine
    return system_[system].actual.v[axis] + config_.axis[system][axis].switches.offset;
  }
  double spindle_turns(unsigned system, unsigned number = 0) const { return spindle(system, number).turns(); }  // signed, since the beginning
  double spindle_rpm(unsigned system, unsigned number = 0) const { return spindle(system, number).rpm(); }
  unsigned tool(unsigned system) const {
    return system == 0 && plant_.present() ? plant_.tool() : system_[system].tool;
  }
  std::uint32_t input(unsigned point) const { return input_.value[point]; }
  std::uint64_t scans() const { return scan_; }
  bool stopped() const { return stopped_; }
  const PointImage& outputs() const { return output_; }
  // The changes of output points in order, until the record of fixed size is full; `lost_changes()` counts the rest.
  std::size_t change_count() const { return change_count_; }
  const SimOutputChange& change(std::size_t i) const { return changes_[i]; }
  std::uint64_t lost_changes() const { return lost_changes_; }

  // Faults that tests inject; they take effect with the next read().
  void fail_bus(bool lost) { lost_ = lost; }
  void fail_drive(unsigned system, unsigned axis, bool fault);
  void block_axis(unsigned system, unsigned axis, bool blocked);  // the axis does not follow: following error
  void hold_fin(bool held) { fin_held_ = held; }                  // FIN never comes
  void fail_unclamp(unsigned system, unsigned axis, bool fault);  // the axis is never unclamped
  void set_input(unsigned point, std::uint32_t value) { input_.value[point] = value; }

 private:
  struct System {
    nc_axes command{}, actual{};
    double follow[NC_MAX_AXES] = {};  // 1 - exp(-cycle/lag)
    double fade[NC_MAX_AXES] = {};    // exp(-cycle/coast)
    double step[NC_MAX_AXES] = {};    // distance moved in the last cycle
    std::uint32_t following_fault = 0, drive_fault = 0, blocked = 0;
    std::uint32_t unclamped = 0, clamp_failed = 0;
    std::uint32_t off = 0;            // drives that are switched off one by one
    SimSwitchState switches[NC_MAX_AXES];
    SimClampState clamp[NC_MAX_AXES];
    SimSpindle spindle[NC_MAX_SPINDLES];
    double wanted_rpm[NC_MAX_SPINDLES] = {};  // commanded speed without a sign
    int direction[NC_MAX_SPINDLES] = {};      // +1 M03, -1 M04, 0 stopped
    unsigned tool = 0, selected = 0;
    bool busy = false, fin = false;
    double remaining_s = 0;
    std::uint8_t strobe = 0;
    std::uint64_t serial = 0;
  };

  void move_axes(unsigned index, const SystemCommand& command) noexcept;
  void work_clamps(unsigned index, std::uint32_t unclamp) noexcept;
  void work_switches(unsigned index, const PointImage& outputs) noexcept;
  void coast(unsigned index, unsigned axis) noexcept;
  const SimSpindle& spindle(unsigned system, unsigned number) const noexcept {
    return system == 0 && plant_.turns_spindle(number) ? plant_.spindle(number) : system_[system].spindle[number];
  }
  SimSpindle& spindle(unsigned system, unsigned number) noexcept {
    return system == 0 && plant_.turns_spindle(number) ? plant_.spindle(number) : system_[system].spindle[number];
  }
  bool is_spindle_now(unsigned system, unsigned axis, const SystemCommand& command) const noexcept;
  void switch_servos(unsigned index, const SystemCommand& command) noexcept;
  void turn_spindles(unsigned index, const SystemCommand& command) noexcept;
  nc_code_role role_of(std::uint32_t m) const noexcept;
  double target_rpm(const System& system, unsigned number) const noexcept;
  void direct_spindles(System* system, const SystemCommand& command) noexcept;
  void handshake(System* system, const SystemCommand& command) noexcept;
  double begin_function(System* system, const SystemCommand& command, std::uint8_t strobe) noexcept;
  std::uint32_t skip_signals(unsigned index) const noexcept;
  void record_outputs(const PointImage& image) noexcept;

  SimConfig config_;
  const PointTable table_;
  SimPlant plant_;
  InputScript script_;
  System system_[NC_MAX_SYSTEMS];
  PointImage input_, output_;
  std::vector<SimOutputChange> changes_;  // fixed size
  std::size_t change_count_ = 0;
  std::uint64_t lost_changes_ = 0;
  std::uint64_t scan_ = 0;
  bool lost_ = false, fin_held_ = false, stopped_ = true;
};

}  // namespace nc::hal
