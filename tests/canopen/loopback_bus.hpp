// SPDX-License-Identifier: Apache-2.0
// A CAN bus in the memory of a test: every drive gets what the control sends, and the control what a drive sends, from the next cycle of the bus on: an answer
// takes some tenths of a millisecond, and the control looks at what has come only once in its cycle.
#pragma once

#include <deque>
#include <functional>
#include <utility>
#include <vector>

#include "hal/canopen/can_port.hpp"
#include "sim_drive.hpp"

namespace nc::test {

// It must exist longer than its port, which the machine owns.
class LoopbackBus {
 public:
  void attach(SimDrive* drive) {
    drives_.push_back(drive);
    drive->out = [this](const CanFrame& frame) { from_drive(frame); };
  }
  void from_drive(const CanFrame& frame) {
    if (off) return;
    if (const unsigned cycles = late ? late(frame) : 0; cycles > 0) late_.push_back({frame, cycles});
    else on_the_way_.push_back(frame);
    ++frames;
  }
  void tick(std::int64_t now_ns) {
    for (SimDrive* drive : drives_) drive->tick(now_ns);
    to_control_.insert(to_control_.end(), on_the_way_.begin(), on_the_way_.end());
    on_the_way_.clear();
    for (auto of = late_.begin(); of != late_.end();) {
      if (--of->second == 0) on_the_way_.push_back(of->first);
      of = of->second == 0 ? late_.erase(of) : of + 1;
    }
  }
  // The controller of the control goes off the bus, and comes back.
  void go_off() {
    off = true;
    CanFrame event;
    event.event = hal::canopen::BusEvent::kBusOff;
    to_control_.push_back(event);
  }
  void come_back() {
    off = false;
    CanFrame event;
    event.event = hal::canopen::BusEvent::kRestarted;
    to_control_.push_back(event);
  }

  bool off = false, refuses_to_open = false;
  std::size_t frames = 0;
  std::vector<CanFrame> sent;  // frames of the control, collected while `records` is true
  bool records = false;
  std::function<unsigned(const CanFrame&)> late;  // by how many cycles of the bus a frame of a drive comes later
  std::function<void()> behind_frame;  // is called behind each frame of the control

  class Port final : public hal::canopen::CanPort {
   public:
    explicit Port(LoopbackBus* bus) : bus_(bus) {}
    bool open(std::string* error) override {
      if (bus_->refuses_to_open) *error = "there is no such interface";
      return !bus_->refuses_to_open;
    }
    void close() noexcept override {}
    bool send(const CanFrame& frame) noexcept override {
      if (bus_->off) return false;
      ++bus_->frames;
      if (bus_->records) bus_->sent.push_back(frame);
      for (SimDrive* drive : bus_->drives_) drive->on_frame(frame);
      if (bus_->behind_frame) bus_->behind_frame();
      return true;
    }
    bool receive(CanFrame* frame) noexcept override {
      if (bus_->to_control_.empty()) return false;
      *frame = bus_->to_control_.front();
      bus_->to_control_.pop_front();
      return true;
    }

   private:
    LoopbackBus* bus_;
  };

 private:
  std::vector<SimDrive*> drives_;
  std::deque<CanFrame> to_control_, on_the_way_;
  std::deque<std::pair<CanFrame, unsigned>> late_;
};

}  // namespace nc::test
