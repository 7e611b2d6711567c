// SPDX-License-Identifier: Apache-2.0
// Copies the process image for a reader in another thread when it asks for it; stands between the scan and the machine. The
// buffer belongs alternately to the scan and to the reader, so neither waits for the other. A scan without a request only
// reads one flag.
#pragma once

#include <atomic>
#include <cstring>
#include <string>

#include "hal/hal.hpp"

namespace nc::rt::share {

class PointTap final : public hal::Hal {
 public:
  // `count` points are copied.
  PointTap(hal::Hal* machine, unsigned count) : machine_(*machine), count_(count) {}

  bool start(const hal::PointImage& initial, std::string* error) override { return machine_.start(initial, error); }
  void read(hal::Feedback* feedback, hal::PointImage* image) noexcept override {
    machine_.read(feedback, image);
    lost_now_ = feedback->lost;
  }
  void write(const hal::Command& command, const hal::PointImage& image) noexcept override {
    machine_.write(command, image);
    if (turn_.load(std::memory_order_acquire) != kWanted) return;
    std::memcpy(image_.value, image.value, count_ * sizeof image.value[0]);
    std::memcpy(image_.good, image.good, count_ * sizeof image.good[0]);
    lost_ = lost_now_;
    turn_.store(kFilled, std::memory_order_release);
  }
  void stop() noexcept override { machine_.stop(); }

  // ---- reader, one thread ----
  void want() {
    if (turn_.load(std::memory_order_relaxed) == kIdle) turn_.store(kWanted, std::memory_order_release);
  }
  // The image asked for, once it is there; false before.
  bool take(hal::PointImage* image, bool* lost) {
    if (turn_.load(std::memory_order_acquire) != kFilled) return false;
    *image = image_;
    *lost = lost_;
    turn_.store(kIdle, std::memory_order_release);
    return true;
  }

 private:
  enum Turn : unsigned { kIdle, kWanted, kFilled };
  hal::Hal& machine_;
  const unsigned count_;
  bool lost_now_ = false;  // used only by the scan thread
  std::atomic<unsigned> turn_{kIdle};
  hal::PointImage image_;
  bool lost_ = false;
};

}  // namespace nc::rt::share
