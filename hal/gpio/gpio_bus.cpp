// SPDX-License-Identifier: Apache-2.0
// One bank of GPIO lines as a point bus. See gpio_bus.hpp.
#include "hal/gpio/gpio_bus.hpp"

#include <algorithm>

#include "hal/bus_thread.hpp"

namespace nc::hal::gpio {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr std::int64_t kStuckNs = 1'000'000'000;

}  // namespace

GpioBus::GpioBus(const BankConfig& config, std::unique_ptr<LineChip> chip, Report report)
    : config_(config),
      bank_(config, std::move(chip), std::move(report)),
      inputs_(empty(config)),
      outputs_(LineBank::Values(config.lines.size())),
      sent_(config.lines.size()),
      edges_seen_(config.probes.size()) {
  for (const Probe& probe : config_.probes) probes_.push_back({probe.system, probe.signal});
}

GpioBus::Shown GpioBus::empty(const BankConfig& config) {
  Shown shown;
  shown.value.resize(config.lines.size());
  shown.good.resize(config.lines.size());
  shown.probe.resize(config.probes.size());
  shown.count.resize(config.encoders.size());
  shown.count_good.resize(config.encoders.size());
  return shown;
}

GpioBus::~GpioBus() {
  stop();
}

bool GpioBus::start(const PointImage& initial, std::string* error) {
  for (std::size_t i = 0; i < config_.lines.size(); ++i) sent_[i] = initial.value[config_.lines[i].point] != 0 ? 1 : 0;
  outputs_.back() = sent_;
  outputs_.publish();
  stopping_ = false;
  if (!bank_.open(steady_clock::now(), sent_, error)) return false;
  publish();
  const auto body = [](void* bus) -> void* {
    static_cast<GpioBus*>(bus)->run();
    return nullptr;
  };
  std::string why;
  has_thread_ = make_bus_thread(&thread_, body, this, "gpio-" + config_.name, &why);
  if (has_thread_) return true;
  *error = "GPIO " + config_.name + ": no thread: " + why;
  bank_.close();
  return false;
}

void GpioBus::stop() noexcept {
  if (!has_thread_) return;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    wake_.notify_all();
  }
  pthread_join(thread_, nullptr);
  has_thread_ = false;
}

// ---- scan ----

void GpioBus::read(PointImage* image) noexcept {
  inputs_.take();
  const Shown& shown = inputs_.front();
  const bool stuck = monotonic_ns() - alive_ns_.load(std::memory_order_relaxed) > kStuckNs;
  for (std::size_t i = 0; i < config_.lines.size(); ++i) {
    const PointLine& line = config_.lines[i];
    image->good[line.point] = stuck ? 0 : shown.good[i];
    if (line.line.output) continue;
    image->value[line.point] = stuck && !line.hold_on_loss ? line.loss_value : shown.value[i];
  }
  for (std::size_t i = 0; i < config_.encoders.size(); ++i) {
    image->value[config_.encoders[i].point] = shown.count[i];
    image->good[config_.encoders[i].point] = stuck ? 0 : shown.count_good[i];
  }
  for (std::size_t i = 0; i < config_.probes.size(); ++i) {
    const Probe& probe = config_.probes[i];
    const bool level = image->value[config_.lines[probe.line].point] != 0;
    see_probe(i, shown.probe[i], level != probe.falling);
  }
  image->value[config_.ok_point] = shown.ok && !stuck ? 1 : 0;
  image->good[config_.ok_point] = 1;
}

// The scan may have missed several edges; the first one of them counts, or the oldest whose time is still there.
void GpioBus::see_probe(std::size_t index, const LineBank::ProbeEdges& edges, bool on) noexcept {
  ProbeSeen& seen = probes_[index];
  std::uint64_t& known = edges_seen_[index];
  seen.on = on;
  seen.edge = edges.count != known;
  const std::uint64_t first = std::max(known, edges.count - std::min<std::uint64_t>(edges.count, LineBank::kProbeEdges));
  seen.edge_ns = seen.edge ? edges.time_ns[first % LineBank::kProbeEdges] : 0;
  known = edges.count;
}

void GpioBus::write(const PointImage& image) noexcept {
  bool changed = false;
  for (std::size_t i = 0; i < config_.lines.size(); ++i) {
    if (!config_.lines[i].line.output) continue;
    const std::uint8_t value = image.value[config_.lines[i].point] != 0 ? 1 : 0;
    changed |= value != sent_[i];
    sent_[i] = value;
  }
  if (changed) {
    std::copy(sent_.begin(), sent_.end(), outputs_.back().begin());
    outputs_.publish();
  }
  scans_.fetch_add(1, std::memory_order_release);
}

// ---- the thread ----

void GpioBus::run() {
  std::uint32_t scans = scans_.load(std::memory_order_acquire);
  LineBank::Time next = steady_clock::now();
  do {
    const std::uint32_t scans_now = scans_.load(std::memory_order_acquire);
    outputs_.take();
    const LineBank::Time now = steady_clock::now();
    bank_.poll(now, outputs_.front(), scans_now != scans);
    scans = scans_now;
    publish();
    next = std::max(next + milliseconds(config_.poll_ms), now);  // polls that were missed are skipped
  } while (wait_until(next));
  bank_.close();
}

// False when the bus is to end.
bool GpioBus::wait_until(LineBank::Time time) {
  std::unique_lock lock(mutex_);
  return !wake_.wait_until(lock, time, [this] { return stopping_; });
}

void GpioBus::publish() {
  Shown& shown = inputs_.back();
  for (std::size_t i = 0; i < config_.lines.size(); ++i) {
    shown.value[i] = bank_.shown(i);
    shown.good[i] = bank_.good(i) ? 1 : 0;
  }
  for (std::size_t i = 0; i < config_.probes.size(); ++i) shown.probe[i] = bank_.probe(i);
  for (std::size_t i = 0; i < config_.encoders.size(); ++i) {
    shown.count[i] = bank_.count(i);
    shown.count_good[i] = bank_.count_good(i) ? 1 : 0;
  }
  shown.ok = bank_.up();
  inputs_.publish();
  alive_ns_.store(monotonic_ns(), std::memory_order_relaxed);
}

}  // namespace nc::hal::gpio
