// SPDX-License-Identifier: Apache-2.0
// A whole control with simulated drives in memory: runtime, bus and axes on one virtual time.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hal/canopen/can_machine.hpp"
#include "hal/canopen/module_bus.hpp"
#include "loopback_bus.hpp"
#include "runtime/runtime.hpp"

namespace nc::test {

inline std::string can_axis(const char* name, const std::string& more = "") {
  return std::string("[[axis]]\nname = \"") + name + "\"\nmax_velocity = 200.0\nmax_acceleration = 2000.0\nmax_jerk = 50000.0\nsoft_limits = [-500.0, 500.0]\n" + more;
}

// Three axes of 10000 increments per turn, gear 2 : 1, screw of 10 mm: 2000 increments per mm.
inline std::string can_toml(const std::string& bus = "", const std::string& axis = "", const std::string& drive = "") {
  std::string text = "[machine]\nname = \"can\"\nhal = \"canopen\"\n" + can_axis("X") + can_axis("Y") + can_axis("Z") +
                     "[[point]]\nname = \"home_x\"\ndirection = \"output\"\n[[point]]\nname = \"x_homed\"\ndirection = \"input\"\n[macro_interface]\n\"#1100\" = \"home_x\"\n\"#1000\" = \"x_homed\"\n"
                     "[canopen]\ninterface = \"test\"\n" +
                     bus;
  const char* names[] = {"X", "Y", "Z"};
  for (unsigned n = 0; n < 3; ++n)
    text += "[[canopen.drive]]\nname = \"" + std::string(names[n]) + " drive\"\nnode = " + std::to_string(n + 1) + "\n" + drive +
            "[[canopen.drive.axis]]\nname = \"" + names[n] + "\"\nencoder = 10000\ngear = [2, 1]\npitch = 10.0\nfollowing_error_limit = 2.0\n" + (n == 0 ? axis : "");
  return text;
}

inline constexpr double kIncrementsPerMm = 2000;

class CanRig {
 public:
  explicit CanRig(const std::string& toml = can_toml(), std::vector<unsigned> nodes = {1, 2, 3}) {
    for (const rt::ConfigError& error : rt::parse_config(toml, "can.toml", &config)) ADD_FAILURE() << error.text();
    for (const unsigned node : nodes) {
      drives.push_back(std::make_unique<SimDrive>(node));
      bus.attach(drives.back().get());
    }
  }
  // A machine file of the tree, whose drives the caller attaches.
  struct File {
    std::string path;
  };
  explicit CanRig(const File& file) {
    for (const rt::ConfigError& error : rt::load_config(file.path, &config)) ADD_FAILURE() << error.text();
  }
  ~CanRig() {
    if (machine != nullptr) machine->stop();
  }

  // Makes the machine; false when the drives do not become operational within `ms`.
  bool boot(unsigned ms = 8000) {
    machine = std::make_unique<hal::canopen::CanMachine>(config.canopen, std::make_unique<LoopbackBus::Port>(&bus), [this](const std::string& line) { log.push_back(line); });
    std::string error;
    if (!machine->start_stepping(&error)) {
      log.push_back(error);
      return false;
    }
    for (unsigned i = 0; i < ms && !machine->cyclic().ready(); ++i) bus_step();
    return machine->cyclic().ready();
  }
  void make_runtime() {
    std::vector<rt::ConfigError> errors;
    runtime = rt::Runtime::create(config, {&clock, &shell, nullptr, nullptr}, &errors);
    for (const rt::ConfigError& error : errors) ADD_FAILURE() << error.text();
    shell.inner = machine.get();
    shell.rig = this;
    for (unsigned n = 0; n < machine->cyclic().module_count(); ++n) shell.modules.emplace_back(machine->module(n));
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
  }
  // Brings the machine up until its axes follow the command.
  void bring_up() {
    ASSERT_TRUE(boot()) << said();
    make_runtime();
    ASSERT_TRUE(until([this] { return following(); }, 2000)) << alarms();
  }

  void bus_step() {
    now_ns += 1'000'000;
    bus.tick(now_ns);
    machine->step_bus(now_ns);
  }
  void step(unsigned n = 1) {
    while (n-- > 0) runtime->step();
  }
  template <class Done>
  bool until(Done done, unsigned most) {
    while (most-- > 0) {
      if (done()) return true;
      step();
    }
    return done();
  }

  bool following() const {
    hal::Feedback feedback;
    hal::PointImage image;
    machine->read(&feedback, &image);
    return feedback.system[0].not_following == 0 && !feedback.lost;
  }
  bool enabled() const {
    for (const auto& drive : drives)
      if (!drive->enabled()) return false;
    return true;
  }
  double plant_mm(unsigned n) { return drives[n]->plant().position / kIncrementsPerMm; }
  double command(unsigned a) const { return runtime->snapshot().system[0].nc.command.v[a]; }
  double actual(unsigned a) const { return runtime->snapshot().system[0].actual.v[a]; }
  std::string alarms() const {
    std::string text;
    const rt::Snapshot now = runtime->snapshot();
    for (unsigned i = 0; i < now.alarms.count; ++i) text += runtime->alarm_text(now.alarms.alarm[i]) + "\n";
    return text;
  }
  std::string said() const {
    std::string text = machine->service().missing();
    for (const std::string& line : log) text += "\n" + line;
    return text;
  }
  rt::Answer mdi(const std::string& block) {
    if (const rt::Answer mode = run(rt::CommandKind::kSetMode, static_cast<std::uint32_t>(rt::Mode::kMdi)); mode != rt::Answer::kDone) return mode;
    if (const rt::Answer loaded = runtime->load_mdi(block); loaded != rt::Answer::kDone) return loaded;
    return run(rt::CommandKind::kCycleStart);
  }
  rt::Answer run(rt::CommandKind kind, std::uint32_t number = 0) { return runtime->execute(kind, 0, number); }
  bool idle() const { return runtime->snapshot().system[0].nc.state == NC_STATE_IDLE && runtime->snapshot().system[0].nc.distance_zero; }

  // Runtime::execute() steps only the runtime. So the bus is stepped in each scan, whoever makes it.
  struct Shell final : hal::Hal {
    hal::canopen::CanMachine* inner = nullptr;
    CanRig* rig = nullptr;
    std::vector<hal::canopen::ModuleBus> modules;
    std::map<unsigned, std::uint32_t> inputs;  // of points that no bus carries, as the machine gives them
    int held_on = -1;  // an output that is on, whatever the runtime makes of it, as a ladder program would have it
    bool start(const hal::PointImage&, std::string*) override { return true; }
    void read(hal::Feedback* feedback, hal::PointImage* image) noexcept override {
      inner->read(feedback, image);
      for (hal::canopen::ModuleBus& module : modules) module.read(image);
      for (const auto& [point, value] : inputs) image->value[point] = value;
    }
    void write(const hal::Command& command, const hal::PointImage& given) noexcept override {
      hal::PointImage image = given;
      if (held_on >= 0) image.value[held_on] = 1;
      inner->write(command, image);
      for (hal::canopen::ModuleBus& module : modules) module.write(image);
      rig->bus_step();
    }
    void stop() noexcept override {}
  };

  rt::Config config;
  rt::VirtualClock clock;
  LoopbackBus bus;
  std::vector<std::unique_ptr<SimDrive>> drives;
  std::unique_ptr<hal::canopen::CanMachine> machine;
  Shell shell;
  std::unique_ptr<rt::Runtime> runtime;
  std::vector<std::string> log;
  std::int64_t now_ns = 0;
};

}  // namespace nc::test
