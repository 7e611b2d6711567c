// SPDX-License-Identifier: Apache-2.0
// Another ladder program takes the place of the one in execution. See ladder_task.hpp and ladder/exchange.hpp.
#include <thread>
#include <utility>

#include "runtime/ladder_task.hpp"

namespace nc::rt {

std::unique_ptr<LadderSwap> LadderTask::prepare_swap(const std::string& text, const std::string& file, std::vector<ladder::Error>* errors) const {
  auto next = std::make_unique<LadderSwap>();
  next->from_ = program_;
  errors->clear();
  if (!compile(text, file, &next->program_, errors)) return nullptr;
  std::string reason;
  if (!next->exchange_.prepare(program_, next->program_, &reason)) {
    errors->push_back({file, 0, "", reason});
    return nullptr;
  }
  next->engine_ = std::make_unique<ladder::Engine>(next->program_);
  next->image_ = next->engine_->make_image();
  next->fresh_ = next->image_;
  set_start_values(&next->fresh_);
  for (const ladder::Device& device : next->exchange_.left()) {
    LadderSwap::Start start{device.type, device.index, next->fresh_.value(device.type, device.index), -1};
    for (const PointPlace& place : outputs_)
      if (place.device == device.index && place.type == device.type) start.point = place.point;
    next->starts_.push_back(start);
  }
  return next;
}

bool LadderTask::swap(std::unique_ptr<LadderSwap> next, std::chrono::milliseconds patience, const std::function<void()>& meanwhile) {
  if (next->from_.code() != program_.code()) return false;  // it was prepared for another one
  {
    const std::lock_guard lock(find_mutex_);
    next_names_ = std::make_unique<ladder::Engine>(next->program_);
  }
  wanted_swap_.store(next.get(), std::memory_order_release);
  const auto give_up = std::chrono::steady_clock::now() + patience;
  while (!next->taken_.load(std::memory_order_acquire)) {
    meanwhile();
    LadderSwap* mine = next.get();
    if (std::chrono::steady_clock::now() > give_up && wanted_swap_.compare_exchange_strong(mine, nullptr)) {
      const std::lock_guard lock(find_mutex_);
      next_names_.reset();
      return false;
    }
  }
  std::unique_ptr<ladder::Engine> old;
  const std::lock_guard lock(find_mutex_);
  old = std::move(names_);
  names_ = std::move(next_names_);
  if (const unsigned kept = faults_kept_.load(std::memory_order_acquire); kept != faults_known_) {
    before_names_ = std::move(old);
    faults_known_ = kept;
  }
  swaps_known_ = swaps();
  program_ = next->program_;
  return true;
}

std::string LadderTask::fault_text(unsigned fault, unsigned line) const {
  const std::lock_guard lock(find_mutex_);
  const bool kept = fault_kept_.load(std::memory_order_acquire);
  // Between the scan that has swapped and the end of swap() the names are one program behind.
  const bool behind = swaps() != swaps_known_;
  const bool just_kept = faults_kept_.load(std::memory_order_acquire) != faults_known_;
  const ladder::Engine* of = behind ? next_names_.get() : names_.get();
  if (kept) of = just_kept ? names_.get() : before_names_.get();
  return of->fault_text(fault, line);
}

// Copies the state, a few tens of kilobytes, and exchanges pointers.
void LadderTask::take_swap(hal::PointImage* points) noexcept {
  if (wanted_swap_.load(std::memory_order_relaxed) == nullptr) return;
  LadderSwap* const next = wanted_swap_.exchange(nullptr, std::memory_order_acquire);
  if (next == nullptr) return;
  next->exchange_.carry(devices_, &next->image_);
  for (const LadderSwap::Start& start : next->starts_) {
    next->image_.set_value(start.type, start.index, start.value);
    if (start.point >= 0) points->value[start.point] = static_cast<std::uint32_t>(start.value);
  }
  if (fault() != ladder::kNoFault && kept_fault_ == ladder::kNoFault) {  // it stands until the reset that begins it, as the one before it would have
    kept_line_ = engine_->fault_line();
    kept_fault_ = engine_->fault();
    fault_kept_.store(true, std::memory_order_release);
    faults_kept_.fetch_add(1, std::memory_order_acq_rel);
  }
  std::swap(devices_, next->image_);
  std::swap(fresh_, next->fresh_);
  engine_.swap(next->engine_);
  swaps_.fetch_add(1, std::memory_order_release);
  next->taken_.store(true, std::memory_order_release);
}

}  // namespace nc::rt
