// SPDX-License-Identifier: Apache-2.0
// Connects signals with points directly, as the configuration says, and supplies the values of all signals to monitors. It stands
// between the scan and the ladder.
//
// The buffer for monitors belongs alternately to the scan and to the reader, so neither waits for the other. A scan without a
// request only reads one flag.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "runtime/config.hpp"
#include "runtime/ladder_hook.hpp"
#include "runtime/signals/signal_table.hpp"

namespace nc::rt {

class LadderTask;

class SignalBoard final : public LadderHook {
 public:
  // `inner`: the ladder's hook. `task`: the ladder program, null when `inner` is not a LadderTask. Both must outlive
  // this object.
  SignalBoard(const Config& config, LadderHook* inner, const LadderTask* task);

  void scan(LadderImage* image) noexcept override;  // NC_RT
  void restart() noexcept override { inner_->restart(); }
  Answer force(std::uint32_t number, std::int32_t value) noexcept override { return inner_->force(number, value); }
  Answer release(std::uint32_t number) noexcept override { return inner_->release(number); }
  void hold_outputs(hal::PointImage* points) noexcept override { inner_->hold_outputs(points); }
  Answer write(std::uint32_t number, std::int32_t value) noexcept override { return inner_->write(number, value); }
  void list_forces(ForceList* list) const noexcept override { inner_->list_forces(list); }

  // The value of a signal, by its index in signals(), when the ladder has run. Scan thread. NC_RT.
  std::int32_t value(unsigned signal, const LadderImage& image) const noexcept;

  // ---- reader, one thread ----
  const std::vector<Signal>& signals() const { return signals_; }
  void want() {
    if (turn_.load(std::memory_order_relaxed) == kIdle) turn_.store(kWanted, std::memory_order_release);
  }
  // The values asked for with want(), in the order of signals(), once they are there; false before. `scan` gets the number of the scan that they are from.
  bool take(std::int32_t* values, std::uint64_t* scan);

 private:
  enum Turn : unsigned { kIdle, kWanted, kFilled };
  struct Wire {
    const SignalRow* row;
    std::uint8_t system, index;
    unsigned point;
    unsigned signal;  // index in signals_
  };

  LadderHook* inner_;
  const LadderTask* task_;
  std::vector<Signal> signals_;
  std::vector<Wire> wires_;
  std::vector<int> wired_;  // for each signal the point that gives it to the NC, -1 = none
  std::vector<std::int32_t> values_;
  std::uint64_t scan_ = 0;
  std::atomic<unsigned> turn_{kIdle};
};

}  // namespace nc::rt
