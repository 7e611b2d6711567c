// SPDX-License-Identifier: Apache-2.0
// The ladder program of the machine in its place in the scan: signals and points into the devices, the program,
// devices back.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ladder/ladder.hpp"
#include "runtime/config.hpp"
#include "runtime/ladder_hook.hpp"
#include "runtime/signals/signal_table.hpp"

namespace nc::rt {

class LadderTask final : public LadderHook {
 public:
  // Reads and compiles the program that the configuration names. Null with the errors (file, line, instruction)
  // when it cannot be run.
  static std::unique_ptr<LadderTask> create(const Config& config, std::vector<ConfigError>* errors);

  void scan(LadderImage* image) noexcept override;  // NC_RT

  const std::vector<std::string>& warnings() const { return warnings_; }
  std::size_t instruction_count() const { return program_.instruction_count(); }
  // For monitors and tests; the image belongs to the scan thread.
  const ladder::DeviceImage& devices() const { return devices_; }
  const ladder::Engine& engine() const { return *engine_; }

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
  void add_signals(const Config& config, ladder::DeviceTable* table);
  void add_points(const Config& config, ladder::DeviceTable* table, std::vector<ConfigError>* errors);
  std::int32_t get(const ladder::DeviceType type, std::uint32_t device) const noexcept;
  void set(ladder::DeviceType type, std::uint32_t device, std::int32_t value) noexcept;

  ladder::Program program_;
  std::unique_ptr<ladder::Engine> engine_;
  ladder::DeviceImage devices_;
  std::vector<SignalPlace> from_nc_, to_nc_;
  std::vector<PointPlace> inputs_, outputs_, quality_;
  std::vector<std::string> warnings_;
};

}  // namespace nc::rt
