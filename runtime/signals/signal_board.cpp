// SPDX-License-Identifier: Apache-2.0
// Signals around the ladder. See signal_board.hpp.
#include "runtime/signals/signal_board.hpp"

#include <algorithm>

#include "runtime/ladder_task.hpp"

namespace nc::rt {

SignalBoard::SignalBoard(const Config& config, LadderHook* inner, const LadderTask* task)
    : inner_(inner),
      task_(task),
      signals_(machine_signals(config.nc)),
      wired_(signals_.size(), -1),
      values_(signals_.size()) {
  for (const SignalWire& wire : config.wires) {
    const Signal& signal = signals_[wire.signal];
    wires_.push_back({signal.row, signal.system, signal.index, wire.point, wire.signal});
    if (signal.row->direction == SignalDirection::kToNc) wired_[wire.signal] = static_cast<int>(wire.point);
  }
}

void SignalBoard::scan(LadderImage* image) noexcept {
  inner_->scan(image);
  for (const Wire& wire : wires_) {
    std::uint32_t& point = image->points->value[wire.point];
    if (wire.row->read != nullptr)
      point = static_cast<std::uint32_t>(wire.row->read(*image, wire.system, wire.index));
    else
      wire.row->write(static_cast<std::int32_t>(point), image, wire.system, wire.index);
  }
  if (turn_.load(std::memory_order_acquire) != kWanted) return;
  for (unsigned i = 0; i < values_.size(); ++i) values_[i] = value(i, *image);
  scan_ = image->status->scan;
  turn_.store(kFilled, std::memory_order_release);
}

std::int32_t SignalBoard::value(unsigned signal, const LadderImage& image) const noexcept {
  const Signal& s = signals_[signal];
  if (s.row->read != nullptr) return s.row->read(image, s.system, s.index);
  if (wired_[signal] >= 0) return static_cast<std::int32_t>(image.points->value[wired_[signal]]);
  return task_ != nullptr ? task_->signal(signal) : s.row->safe;
}

bool SignalBoard::take(std::int32_t* values, std::uint64_t* scan) {
  if (turn_.load(std::memory_order_acquire) != kFilled) return false;
  std::copy(values_.begin(), values_.end(), values);
  *scan = scan_;
  turn_.store(kIdle, std::memory_order_release);
  return true;
}

}  // namespace nc::rt
