// SPDX-License-Identifier: Apache-2.0
// Records signals in the scan (recording.hpp). It stands between the scan and the ladder, outside of the board of signals: signals and devices of the ladder are
// taken when the ladder is done, points at the end of the scan, as they go to the machine.
//
// A recording belongs alternately to its owner, who makes it and reads it, and to the scan, which fills it in; neither waits for the other. A scan without one
// reads a flag.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "runtime/ladder_hook.hpp"
#include "runtime/signals/signal_board.hpp"
#include "runtime/trace/recording.hpp"

namespace nc::rt {
class LadderTask;
}

namespace nc::rt::trace {

class TraceTap final : public LadderHook {
 public:
  // `ladder`: null when the machine has no ladder program. All must outlive this object.
  TraceTap(const Config& config, SignalBoard* board, LadderTask* ladder) : config_(config), board_(*board), ladder_(ladder) {}

  void scan(LadderImage* image) noexcept override;  // NC_RT
  void restart() noexcept override { board_.restart(); }
  Answer force(std::uint32_t number, std::int32_t value) noexcept override { return board_.force(number, value); }
  Answer release(std::uint32_t number) noexcept override { return board_.release(number); }
  Answer write(std::uint32_t number, std::int32_t value) noexcept override { return board_.write(number, value); }
  void hold_outputs(hal::PointImage* points) noexcept override;  // NC_RT
  void list_forces(ForceList* list) const noexcept override { board_.list_forces(list); }

  // ---- the owner, one thread ----
  // What has this name: a signal of the NC, a point, a device of the ladder. False when nothing has it.
  bool find(const std::string& name, Source* source) const;
  // The scan begins to record with its next run. False while a recording is in the scan. The plan has no fault.
  bool arm(Plan plan);
  // Asks the scan to end the recording; it does so at the end of its next run.
  void stop() { stop_.store(true, std::memory_order_release); }
  bool is_recording() const { return turn_.load(std::memory_order_acquire) == kScan; }
  // The newest recording; null when there was none. All of it may be read when is_recording() is false, else what any thread may read.
  const Recording* recording() const { return recording_.get(); }

 private:
  enum Turn : unsigned { kOwner, kScan };
  std::int32_t value_of(const Source& source, const LadderImage& image) const noexcept;

  const Config& config_;
  SignalBoard& board_;
  LadderTask* const ladder_;
  std::atomic<unsigned> turn_{kOwner};
  std::atomic<bool> stop_{false};
  std::unique_ptr<Recording> recording_;  // turn_ says who may use it
  // Of the scan thread.
  bool in_row_ = false;  // the row of this scan was begun
  std::uint64_t scan_ = 0;
  std::int64_t time_ns_ = 0;
};

}  // namespace nc::rt::trace
