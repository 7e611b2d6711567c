// SPDX-License-Identifier: Apache-2.0
// See trace_tap.hpp.
#include "runtime/trace/trace_tap.hpp"

#include <utility>

#include "runtime/ladder_task.hpp"

namespace nc::rt::trace {

bool TraceTap::find(const std::string& name, Source* source) const {
  const std::vector<Signal>& signals = board_.signals();
  for (std::size_t i = 0; i < signals.size(); ++i) {
    if (signals[i].name != name) continue;
    *source = {Source::Kind::kSignal, signals[i].row->type, static_cast<std::uint32_t>(i)};
    return true;
  }
  if (const int point = config_.points.find(name); point >= 0) {
    *source = {Source::Kind::kPoint, ladder::DeviceType::kWord32, static_cast<std::uint32_t>(point)};
    return true;
  }
  const auto device = ladder_ != nullptr ? ladder_->find_device(name) : std::nullopt;
  if (!device) return false;
  *source = {Source::Kind::kDevice, device->type, device->index};
  return true;
}

bool TraceTap::arm(Plan plan) {
  if (is_recording()) return false;
  recording_ = std::make_unique<Recording>(std::move(plan));
  stop_.store(false, std::memory_order_relaxed);
  turn_.store(kScan, std::memory_order_release);
  return true;
}

// ---- the scan ----

std::int32_t TraceTap::value_of(const Source& source, const LadderImage& image) const noexcept {
  switch (source.kind) {
    case Source::Kind::kSignal: return board_.value(source.index, image);
    case Source::Kind::kDevice: return ladder_->value(source.type, source.index);
    case Source::Kind::kPoint: break;  // at the end of the scan
  }
  return 0;
}

void TraceTap::scan(LadderImage* image) noexcept {
  board_.scan(image);
  in_row_ = turn_.load(std::memory_order_acquire) == kScan;
  if (!in_row_) return;
  scan_ = image->status->scan;
  time_ns_ = image->status->time_ns;
  std::int32_t* value = recording_->row();
  for (const Source& source : recording_->plan().sources) *value++ = value_of(source, *image);
}

void TraceTap::hold_outputs(hal::PointImage* points) noexcept {
  board_.hold_outputs(points);
  if (!in_row_) return;
  in_row_ = false;
  std::int32_t* value = recording_->row();
  for (const Source& source : recording_->plan().sources) {
    if (source.kind == Source::Kind::kPoint) *value = static_cast<std::int32_t>(points->value[source.index]);
    ++value;
  }
  bool goes_on = recording_->end_row(scan_, time_ns_);
  if (goes_on && stop_.load(std::memory_order_acquire)) {
    recording_->stop();
    goes_on = false;
  }
  if (!goes_on) turn_.store(kOwner, std::memory_order_release);
}

}  // namespace nc::rt::trace
