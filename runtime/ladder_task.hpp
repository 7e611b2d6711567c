// SPDX-License-Identifier: Apache-2.0
// The ladder program of the machine in its place in the scan: signals and points are copied into the devices, the program runs, and the
// devices are copied back.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "ladder/ladder.hpp"
#include "runtime/config.hpp"
#include "runtime/force_table.hpp"
#include "runtime/ladder_hook.hpp"
#include "runtime/ladder_look.hpp"
#include "runtime/ladder_swap.hpp"
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

  // A device by a name that the program may use. Any thread but the scan.
  std::optional<ladder::Device> find_device(const std::string& name) const;
  // Its value. Scan thread. NC_RT.
  std::int32_t value(ladder::DeviceType type, std::uint32_t device) const noexcept { return devices_.value(type, device); }

  // ---- looking at the program in execution: one thread that is not the scan ----
  LadderLook& look() { return look_; }
  const ladder::Program& program() const { return program_; }

  // ---- another program takes the place of the one in execution, between two scans: the thread that looks ----
  // Compiles a text for this machine, and sees whether the state of the program in execution means the same in it. Null with the errors when not. `file`: its name, for messages.
  std::unique_ptr<LadderSwap> prepare_swap(const std::string& text, const std::string& file, std::vector<ladder::Error>* errors) const;
  // Waits until the scan has taken it; `meanwhile` is called again and again until then. False: no scan has run within `patience`, or it was prepared for another program than the one in execution; nothing has changed then. The one that ran until then
  // is destroyed here and not in the scan.
  bool swap(std::unique_ptr<LadderSwap> next, std::chrono::milliseconds patience, const std::function<void()>& meanwhile);
  // Number of programs that have taken the place of the configuration's one. Any thread.
  unsigned swaps() const { return swaps_.load(std::memory_order_acquire); }
  // The text of a fault that a scan has passed on in LadderRequests. Any thread.
  std::string fault_text(unsigned fault, unsigned line) const;

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
  bool compile(const std::string& text, const std::string& file, ladder::Program* program, std::vector<ladder::Error>* errors) const;
  void set_start_values(ladder::DeviceImage* image) const;
  void take_swap(hal::PointImage* points) noexcept;  // NC_RT
  // Of the program in execution, or of the one before it that had the fault with which this one stands. Scan thread.
  unsigned fault() const noexcept { return kept_fault_ != ladder::kNoFault ? kept_fault_ : engine_->fault(); }
  void find_places(const Config& config, const ladder::DeviceTable& table);
  void copy_retained(const ladder::DeviceImage& from, ladder::DeviceImage* to) const noexcept;
  std::vector<RetainedRow> rows_of(const ladder::DeviceImage& image) const;
  void answer() noexcept;

  ladder::DeviceTable table_;
  ladder::CompileOptions options_;
  ladder::Program program_;
  std::unique_ptr<ladder::Engine> engine_;  // of the scan; what other threads ask for names is names_
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
  mutable std::mutex find_mutex_;  // guards names_, next_names_ and before_names_; never taken by the scan
  std::unique_ptr<ladder::Engine> names_;         // knows the names of the program in execution
  std::unique_ptr<ladder::Engine> next_names_;    // while a swap waits: those of the next program
  std::unique_ptr<ladder::Engine> before_names_;  // of the program that had the fault with which this one stands
  std::atomic<LadderSwap*> wanted_swap_{nullptr};
  std::atomic<unsigned> swaps_{0};
  std::atomic<bool> fault_kept_{false};      // the program was swapped while it stood with a fault; until it begins again
  std::atomic<unsigned> faults_kept_{0};     // how often that was so
  unsigned swaps_known_ = 0;                 // names_ are those behind so many swaps
  unsigned faults_known_ = 0;                // of them before_names_ has that of this one
  unsigned kept_fault_ = 0, kept_line_ = 0;  // scan
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
