// SPDX-License-Identifier: Apache-2.0
// The ladder program of the machine in its place in the scan: signals and points are copied into the devices, the program runs, and the
// devices are copied back.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "ladder/ladder.hpp"
#include "runtime/config.hpp"
#include "runtime/force_table.hpp"
#include "runtime/ladder_hook.hpp"
#include "runtime/ladder_look.hpp"
#include "runtime/retain/rows.hpp"
#include "runtime/signals/signal_table.hpp"

namespace nc::rt {

class LadderTask final : public LadderHook {
 public:
  // Reads and compiles the program that the configuration names. Null with the errors (file, line, instruction)
  // when it cannot be run.
  static std::unique_ptr<LadderTask> create(const Config& config, std::vector<ConfigError>* errors);

  // The devices that a machine adds to those of the ladder: its signals and points. One that cannot be added is an error.
  static ladder::DeviceTable device_table(const Config& config, std::vector<ConfigError>* errors);

  void scan(LadderImage* image) noexcept override;  // NC_RT
  // The program begins again, as at power on; retained devices keep their values. NC_RT.
  void restart() noexcept override;

  // ---- forced devices ----
  // Number of a device for CommandKind::kForce; a device always has the same number. -1 with a sentence in *error when there
  // is no such device, when it cannot have this value, or when it belongs to the engine (SM, SD). Any thread.
  std::int64_t force_number(const std::string& name, std::int64_t value, std::string* error);
  // The same for CommandKind::kWriteDevice: -1 also for a device that the machine or the NC writes in each scan.
  std::int64_t write_number(const std::string& name, std::int64_t value, std::string* error);
  std::string force_name(std::uint32_t number) const { return forces_.name_of(number); }
  Answer force(std::uint32_t number, std::int32_t value) noexcept override { return forces_.force(number, value); }
  Answer release(std::uint32_t number) noexcept override { return forces_.release(number); }
  Answer write(std::uint32_t number, std::int32_t value) noexcept override { return forces_.write(number, value); }
  void hold_outputs(hal::PointImage* points) noexcept override;
  void list_forces(ForceList* list) const noexcept override { forces_.list(list); }

  // ---- reading one device from another thread ----
  // The value of a device. The scan is asked for it and the call waits for the answer, so that only the scan accesses the devices. `direct`: the
  // scan runs in the calling thread, so the device is read at once. 0 when there is no such device, or when no scan runs.
  std::uint32_t read_device(const std::string& name, bool direct);

  // A device by a name that the program may use, null = there is none. Any thread but the scan.
  const ladder::Device* find_device(const std::string& name) const;
  // Its value. Scan thread. NC_RT.
  std::int32_t value(ladder::DeviceType type, std::uint32_t device) const noexcept { return devices_.value(type, device); }

  // ---- looking at the program in execution: one thread that is not the scan ----
  LadderLook& look() { return look_; }
  const ladder::Program& program() const { return program_; }

  // ---- retained devices ----
  // To be called only while no scan runs.
  void restore(const std::vector<RetainedRow>& rows);
  std::vector<RetainedRow> retained() const;
  // For one other thread while scans run: want_retained() asks for a copy; take_retained() takes it and is false until it is there.
  void want_retained();
  bool take_retained(std::vector<RetainedRow>* rows);

  const std::vector<std::string>& warnings() const { return warnings_; }
  std::size_t instruction_count() const { return program_.instruction_count(); }
  // For monitors and tests; the image belongs to the scan thread.
  const ladder::DeviceImage& devices() const { return devices_; }
  const ladder::Engine& engine() const { return *engine_; }
  // Value of a signal to the NC, by its index in machine_signals(). Scan thread. NC_RT.
  std::int32_t signal(unsigned place) const noexcept;

 private:
  struct SignalPlace {
    const SignalRow* row;
    std::uint8_t system, index;
    std::uint32_t device;
  };
  struct PointPlace {
    std::uint16_t point;
    ladder::DeviceType type;
    std::uint32_t device;
  };

  LadderTask() = default;
  bool load(const Config& config, std::vector<ConfigError>* errors);
  void find_places(const Config& config, const ladder::DeviceTable& table);
  void set_start_values(const Config& config);
  void copy_retained(const ladder::DeviceImage& from, ladder::DeviceImage* to) const noexcept;
  std::vector<RetainedRow> rows_of(const ladder::DeviceImage& image) const;
  void answer() noexcept;

  ladder::Program program_;
  std::unique_ptr<ladder::Engine> engine_;
  ladder::DeviceImage devices_, fresh_;  // fresh_: the state at power on
  std::vector<ladder::RetainedRange> ranges_;
  enum Turn : unsigned { kIdle, kWanted, kFilled };
  std::atomic<unsigned> turn_{kIdle};
  ladder::DeviceImage copied_;  // copy of the retained devices; turn_ says whether the scan or the reader may access it
  std::vector<const SignalPlace*> by_signal_;  // for each signal its entry in to_nc_; null for a signal from the NC
  std::vector<SignalPlace> from_nc_, to_nc_;
  std::vector<PointPlace> inputs_, outputs_, quality_;
  const hal::PointTable* points_ = nullptr;  // point table of the configuration
  ForceTable forces_;
  mutable std::mutex find_mutex_;  // Engine::find() must not be called by two threads at once; never taken by the scan
  struct Question {
    std::atomic<unsigned> turn{kIdle};
    ladder::DeviceType type = ladder::DeviceType::kBit;
    std::uint32_t index = 0;
    std::int32_t value = 0;
  };
  Question question_;  // what read_device() asks of the scan
  LadderLook look_;
  std::vector<std::string> warnings_;
};

}  // namespace nc::rt
