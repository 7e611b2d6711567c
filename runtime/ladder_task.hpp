// SPDX-License-Identifier: Apache-2.0
// The ladder program of the machine in its place in the scan: signals and points into the devices, the program,
// devices back.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "ladder/ladder.hpp"
#include "runtime/config.hpp"
#include "runtime/ladder_hook.hpp"
#include "runtime/retain/rows.hpp"
#include "runtime/signals/signal_table.hpp"

namespace nc::rt {

class LadderTask final : public LadderHook {
 public:
  // Reads and compiles the program that the configuration names. Null with the errors (file, line, instruction)
  // when it cannot be run.
  static std::unique_ptr<LadderTask> create(const Config& config, std::vector<ConfigError>* errors);

  // The devices of a machine: its signals and points. What does not fit is an error.
  static ladder::DeviceTable device_table(const Config& config, std::vector<ConfigError>* errors);

  void scan(LadderImage* image) noexcept override;  // NC_RT
  // The program begins again, as at power on; retained devices keep their values. NC_RT.
  void restart() noexcept override;

  // ---- retained devices ----
  // Not while it is scanned.
  void restore(const std::vector<RetainedRow>& rows);
  std::vector<RetainedRow> retained() const;
  // One other thread, while it is scanned: a copy is asked for, and taken when it is there.
  void want_retained();
  bool take_retained(std::vector<RetainedRow>* rows);

  const std::vector<std::string>& warnings() const { return warnings_; }
  std::size_t instruction_count() const { return program_.instruction_count(); }
  // For monitors and tests; the image belongs to the scan thread.
  const ladder::DeviceImage& devices() const { return devices_; }
  const ladder::Engine& engine() const { return *engine_; }
  // Value of a signal to the NC, by place in machine_signals(). Scan thread. NC_RT.
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
  std::int32_t get(const ladder::DeviceType type, std::uint32_t device) const noexcept;
  void set(ladder::DeviceType type, std::uint32_t device, std::int32_t value) noexcept;

  ladder::Program program_;
  std::unique_ptr<ladder::Engine> engine_;
  ladder::DeviceImage devices_, fresh_;  // fresh_: as at power on
  std::vector<ladder::RetainedRange> ranges_;
  enum Turn : unsigned { kIdle, kWanted, kFilled };
  std::atomic<unsigned> turn_{kIdle};
  ladder::DeviceImage copied_;  // of the retained devices; the scan's or the reader's, by turns
  std::vector<const SignalPlace*> by_signal_;  // to the NC; null = from it
  std::vector<SignalPlace> from_nc_, to_nc_;
  std::vector<PointPlace> inputs_, outputs_, quality_;
  std::vector<std::string> warnings_;
};

}  // namespace nc::rt
