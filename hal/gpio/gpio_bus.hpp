// SPDX-License-Identifier: Apache-2.0
// One bank of GPIO lines as a point bus: an ordinary thread that polls the lines (line_bank.hpp), and the image that it exchanges with the scan.
//
// The thread itself is watched by the scan: when it has been stuck for more than a second, the values of its points count as lost.
#pragma once

#include <pthread.h>

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "hal/gpio/line_bank.hpp"
#include "hal/point_bus.hpp"
#include "hal/triple_buffer.hpp"

namespace nc::hal::gpio {

class GpioBus final : public PointBus {
 public:
  // The chip is this bus's own. `report` is called in the thread that calls start(), and between start() and stop() in the bus's.
  GpioBus(const BankConfig& config, std::unique_ptr<LineChip> chip, Report report = {});
  ~GpioBus() override;

  // Requests the lines. False when a line is taken, or does not exist on a chip that does.
  bool start(const PointImage& initial, std::string* error) override;
  void read(PointImage* image) noexcept override;
  void write(const PointImage& image) noexcept override;
  // Writes the values for the end and gives the lines back. Waits for the call of the kernel in which the thread is, which nothing can break off.
  void stop() noexcept override;

 private:
  // By place in config_.lines.
  struct Shown {
    std::vector<std::uint8_t> value;
    std::vector<std::uint8_t> good;
    bool ok = false;
  };

  void run();
  bool wait_until(LineBank::Time time);
  void publish();

  const BankConfig config_;
  LineBank bank_;  // the thread's, once there is one
  pthread_t thread_{};
  bool has_thread_ = false;

  // ---- scan ----
  TripleBuffer<Shown> inputs_;
  TripleBuffer<LineBank::Values> outputs_;
  LineBank::Values sent_;                   // as last published
  std::atomic<std::uint32_t> scans_{0};     // written by the scan, for the watchdog's line
  std::atomic<std::int64_t> alive_ns_{0};   // of the thread

  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
};

}  // namespace nc::hal::gpio
