// SPDX-License-Identifier: Apache-2.0
// One Modbus link: the image that its thread and the scan exchange. See link.hpp.
#include <algorithm>

#include "hal/bus_thread.hpp"
#include "hal/modbus/codec.hpp"
#include "hal/modbus/link.hpp"

namespace nc::hal::modbus {
namespace {

constexpr unsigned kStuckMarginMs = 1000;

std::uint32_t value_on_loss(const PointMap& map, std::uint32_t last) noexcept {
  return map.on_loss == OnLoss::kHold ? last : map.on_loss == OnLoss::kValue ? map.loss_value : 0;
}

}  // namespace

const char* state_name(LinkState state) {
  return state == LinkState::kOk ? "ok" : state == LinkState::kDegraded ? "degraded" : "lost";
}

ModbusLink::ModbusLink(const LinkConfig& config, Report report)
    : config_(config),
      report_(std::move(report)),
      stuck_ns_((config.response_timeout_ms + config.byte_timeout_ms + kStuckMarginMs) * 1'000'000LL),
      inputs_({std::vector<std::uint32_t>(config.points.size()),
               std::vector<std::uint8_t>(config.points.size()), false, std::vector<std::uint32_t>(config.points.size()),
               std::vector<std::uint8_t>(config.points.size())}),
      outputs_({std::vector<std::uint32_t>(config.points.size()), std::vector<std::uint8_t>(config.points.size())}),
      sent_({std::vector<std::uint32_t>(config.points.size()), std::vector<std::uint8_t>(config.points.size())}),
      start_(config.points.size()),
      value_(config.points.size()),
      valid_(config.points.size()),
      found_(config.points.size()),
      scratch_(kMaxReadBits),
      backoff_ms_(config.backoff_min_ms),
      random_(std::random_device{}()) {}

ModbusLink::~ModbusLink() {
  stop();
}

// ---- scan ----

void ModbusLink::read(PointImage* image) noexcept {
  inputs_.take();
  const Shown& shown = inputs_.front();
  const bool stuck = monotonic_ns() - alive_ns_.load(std::memory_order_relaxed) > stuck_ns_;
  for (std::size_t i = 0; i < config_.points.size(); ++i) {
    const PointMap& map = config_.points[i];
    image->good[map.point] = stuck ? 0 : shown.good[i];
    if (!map.output) image->value[map.point] = stuck ? value_on_loss(map, shown.value[i]) : shown.value[i];
    if (map.output && sent_.own[i] == 0 && shown.known[i] != 0) {
      image->value[map.point] = shown.found[i];
      sent_.own[i] = 1;
      taken_over_ = true;
    }
  }
  image->value[config_.ok_point] = shown.ok && !stuck ? 1 : 0;
  image->good[config_.ok_point] = 1;
}

void ModbusLink::write(const PointImage& image) noexcept {
  bool changed = taken_over_;
  taken_over_ = false;
  for (std::size_t i = 0; i < config_.points.size(); ++i) {
    if (!config_.points[i].output) continue;
    const std::uint32_t value = image.value[config_.points[i].point];
    changed |= value != sent_.value[i];
    sent_.value[i] = value;
    if (value != start_[i]) sent_.own[i] = 1;
  }
  if (!changed) return;
  std::copy(sent_.value.begin(), sent_.value.end(), outputs_.back().value.begin());
  std::copy(sent_.own.begin(), sent_.own.end(), outputs_.back().own.begin());
  outputs_.publish();
}

// ---- link's thread ----

void ModbusLink::alive() noexcept {
  alive_ns_.store(monotonic_ns(), std::memory_order_relaxed);
}

void ModbusLink::publish() {
  Shown& shown = inputs_.back();
  bool all_good = true;
  for (const Job& job : jobs_) {
    all_good &= !job.bad;
    for (const unsigned i : job.block.maps) {
      const PointMap& map = config_.points[i];
      const bool good = !lost_ && !job.bad && (map.output ? job.written : valid_[i] != 0);
      shown.good[i] = good ? 1 : 0;
      shown.value[i] = good ? value_[i] : value_on_loss(map, value_[i]);
      shown.found[i] = found_[i];
      shown.known[i] = job.known ? 1 : 0;
    }
  }
  shown.ok = !lost_;
  inputs_.publish();
  const std::lock_guard lock(mutex_);
  statistics_.state = lost_                      ? LinkState::kLost
                      : errors_ == 0 && all_good ? LinkState::kOk
                                                 : LinkState::kDegraded;
}

LinkStatistics ModbusLink::statistics() const {
  const std::lock_guard lock(mutex_);
  return statistics_;
}

}  // namespace nc::hal::modbus
