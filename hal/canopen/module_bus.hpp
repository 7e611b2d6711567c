// SPDX-License-Identifier: Apache-2.0
// A CiA 401 module as a bus of points. The line, its thread and the set-up of the module are those of the machine of drives (can_machine.hpp), which must outlive
// this object and is started before it and stopped before it.
#pragma once

#include "hal/canopen/module_io.hpp"
#include "hal/point_bus.hpp"

namespace nc::hal::canopen {

class ModuleBus final : public PointBus {
 public:
  explicit ModuleBus(ModuleIo* io) : io_(io) {}
  bool start(const PointImage&, std::string*) override { return true; }  // CanMachine::start() has given the initial values
  void read(PointImage* image) noexcept override { io_->read(image); }
  void write(const PointImage& image) noexcept override { io_->write(image); }
  void stop() noexcept override {}

 private:
  ModuleIo* const io_;
};

}  // namespace nc::hal::canopen
