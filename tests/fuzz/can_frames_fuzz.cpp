// SPDX-License-Identifier: Apache-2.0
// Any frames on the bus, from the first SYNC on, and no other answers of drives. The control never enables an axis whose drive has not gone through
// its states, and never sends a target that the scan did not command.
#include <cmath>
#include <cstdlib>
#include <deque>
#include <memory>

#include "fuzz/input.hpp"
#include "hal/canopen/can_machine.hpp"

namespace {

using namespace nc::hal::canopen;
using nc::fuzz::Bytes;
using nc::fuzz::require;

constexpr unsigned kCycles = 400, kNodes = 4;

struct Port final : CanPort {
  bool open(std::string*) override { return true; }
  void close() noexcept override {}
  bool send(const CanFrame& frame) noexcept override {
    require(frame.length <= kMaxData && frame.id <= 0x7FF);
    if (frame.id > kSdoRequestId && frame.id <= kSdoRequestId + kNodes) asked[frame.id - kSdoRequestId - 1] = frame;
    return true;
  }
  bool receive(CanFrame* frame) noexcept override {
    if (frames.empty()) return false;
    *frame = frames.front();
    frames.pop_front();
    return true;
  }
  std::deque<CanFrame> frames;
  CanFrame asked[kNodes];  // the last request to each node
};

BusMap small_bus() {
  BusMap bus;
  bus.interface = "fuzz";
  bus.sdo_timeout_ms = 20;
  for (unsigned n = 0; n < 2; ++n) {
    NodeMap node;
    node.id = n + 1;
    AxisMap axis;
    axis.axis = n;
    axis.increments_per_unit = 1000;
    axis.max_velocity = 100;
    axis.following_limit = 1;
    axis.skip_signal = n;
    axis.homing_method = n == 0 ? 1 : 0;
    node.axes.push_back(axis);
    bus.nodes.push_back(node);
  }
  // And a module whose inputs are points 0 and 1, and a spindle.
  NodeMap module, drive;
  module.id = 3;
  module.module.emplace();
  module.module->ok_point = 2;
  for (unsigned n = 0; n < 2; ++n) {
    IoPoint point;
    point.point = n;
    point.analog = n == 1;
    point.channel = 5;
    module.module->points.push_back(point);
  }
  bus.nodes.push_back(module);
  drive.id = 4;
  AxisMap axis;
  axis.axis = NC_MAX_AXES;
  axis.mode = kModeCyclicVelocity;
  axis.spindle.emplace();
  axis.spindle->gears = {1};
  axis.spindle->increments = 4096;
  axis.spindle->law.acceleration = axis.spindle->law.most = 50;
  drive.axes.push_back(axis);
  bus.nodes.push_back(drive);
  return bus;
}

// A frame from the input, mostly with an identifier that has a meaning.
CanFrame frame_from(Bytes* in, const CanFrame (&asked)[kNodes]) {
  static constexpr unsigned kKinds[] = {kTpdoId, kTpdoId + kPdoStep, kSdoAnswerId, kHeartbeatId, kEmergencyId, kSdoAnswerId + 2, kTpdoId + 2, kHeartbeatId + 2};
  const std::uint8_t shape = in->byte();
  CanFrame frame;
  frame.id = static_cast<std::uint16_t>(kKinds[shape & 7] + 1 + (shape >> 3 & 1));
  if ((shape & 0xF0) == 0xF0) frame.id = in->value<std::uint16_t>() & 0x7FF;
  if ((shape & 0xF0) == 0xE0) frame.event = static_cast<BusEvent>(in->byte() % 5);
  frame.length = (shape & 0xF0) == 0xD0 ? in->byte() % 9 : kMaxData;
  for (std::uint8_t& byte : frame.data) byte = in->byte();
  if ((shape & 0x17) == 0x12 || (shape & 0x17) == 0x15) {  // a positive answer to the request
    const unsigned node = (shape & 7) == 2 ? shape >> 3 & 1 : 2 + (shape >> 3 & 1);
    for (unsigned i = 1; i < kMaxData; ++i) frame.data[i] = asked[node].data[i];
    frame.data[0] = 0x60;
  }
  return frame;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in(data, size);
  auto port = std::make_unique<Port>();
  Port* bus = port.get();
  CanMachine machine(small_bus(), std::move(port), [](const std::string& line) { require(!line.empty()); });
  std::string error;
  require(machine.start_stepping(&error));
  auto feedback = std::make_unique<nc::hal::Feedback>();
  auto image = std::make_unique<nc::hal::PointImage>();
  nc::hal::Command command;
  std::int64_t now_ns = 0;
  for (unsigned cycle = 0; cycle < kCycles && !in.empty(); ++cycle) {
    const std::uint8_t what = in.byte();
    for (unsigned n = 0; n < (what & 7u); ++n) bus->frames.push_back(frame_from(&in, bus->asked));
    command.system[0].enable = (what & 8) != 0;
    command.system[0].reset = (what & 16) != 0;
    command.system[0].position.v[0] += (what & 32) != 0 ? 0.05 : 0;
    machine.read(feedback.get(), image.get());
    for (unsigned a = 0; a < 2; ++a) require(std::isfinite(feedback->system[0].actual.v[a]));
    const nc_spindle_inputs& spindle = feedback->system[0].spindle[0];
    require(std::isfinite(spindle.rev_per_s) && std::isfinite(spindle.turns));
    require(image->value[0] <= 1 && image->value[2] <= 1 && std::abs(static_cast<std::int32_t>(image->value[1])) <= 32768);
    machine.write(command, *image);
    machine.step_bus(now_ns += 1'000'000 + (what & 64) * 1'000'000LL);
  }
  (void)machine.service().missing();
  machine.stop();
  return 0;
}
