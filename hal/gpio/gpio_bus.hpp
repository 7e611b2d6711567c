// SPDX-License-Identifier: Apache-2.0
// One bank of GPIO lines as a point bus: an ordinary thread that polls the lines (line_bank.hpp), and the images that it exchanges with the scan.
//
// The scan also watches the thread: when it has made no progress for more than a second, the values of its points count as lost.
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
  // `report` is called in the thread that calls start(), and between start() and stop() in the thread of the bus.
  GpioBus(const BankConfig& config, std::unique_ptr<LineChip> chip, Report report = {});
  ~GpioBus() override;

  // Requests the lines. False with a sentence in *error when a line is in use, or when the chip is there but does not have the line or refuses its setting.
  bool start(const PointImage& initial, std::string* error) override;
  void read(PointImage* image) noexcept override;
  std::span<const ProbeSeen> probes() const noexcept override { return probes_; }
  void write(const PointImage& image) noexcept override;
  // Writes the values for the end and releases the lines. It waits for the thread, whose call of the kernel cannot be interrupted.
  void stop() noexcept override;

 private:
  struct Shown {
    std::vector<std::uint8_t> value;  // indexed as config_.lines, as is good
    std::vector<std::uint8_t> good;
    std::vector<LineBank::ProbeEdges> probe;
    std::vector<std::uint32_t> count;  // indexed as config_.encoders, as is count_good
    std::vector<std::uint8_t> count_good;
    bool ok = false;
  };
  static Shown empty(const BankConfig& config);

  void see_probe(std::size_t index, const LineBank::ProbeEdges& edges, bool on) noexcept;
  void run();
  bool wait_until(LineBank::Time time);
  void publish();

  const BankConfig config_;
  LineBank bank_;  // used only by the thread while it runs
  pthread_t thread_{};
  bool has_thread_ = false;

  // ---- scan ----
  TripleBuffer<Shown> inputs_;
  TripleBuffer<LineBank::Values> outputs_;
  LineBank::Values sent_;                   // outputs that were published last
  std::vector<ProbeSeen> probes_;           // as the last read() has found them
  std::vector<std::uint64_t> edges_seen_;   // of each probe
  std::atomic<std::uint32_t> scans_{0};     // number of scans, from which the thread drives the line of the watchdog
  std::atomic<std::int64_t> alive_ns_{0};   // time at which the thread published last

  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
};

}  // namespace nc::hal::gpio
