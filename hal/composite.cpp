// SPDX-License-Identifier: Apache-2.0
// One machine and its point buses. See composite.hpp.
#include "hal/composite.hpp"

#include <system_error>
#include <thread>

namespace nc::hal {
namespace {

std::size_t count_probes(const std::vector<PointBus*>& buses) {
  std::size_t count = 0;
  for (const PointBus* bus : buses) count += bus->probes().size();
  return count;
}

}  // namespace

Composite::Composite(Hal* machine, std::vector<PointBus*> buses, const PointTable& table, std::int64_t (*now_ns)() noexcept)
    : machine_(machine), buses_(std::move(buses)), now_ns_(now_ns), has_probes_(count_probes(buses_) != 0), latch_(count_probes(buses_)) {
  for (unsigned p = 0; p < table.size(); ++p)
    if (table.at(p).bus == 0) own_points_.push_back(static_cast<std::uint16_t>(p));
}

bool Composite::start(const PointImage& initial, std::string* error) {
  if (!machine_->start(initial, error)) return false;
  for (PointBus* bus : buses_)
    if (!bus->start(initial, error)) return false;  // the caller calls stop(), which stops everything that was started
  return true;
}

void Composite::read(Feedback* feedback, PointImage* image) noexcept {
  machine_->read(feedback, image);
  const std::uint8_t good = feedback->lost ? 0 : 1;
  for (const std::uint16_t point : own_points_) image->good[point] = good;
  for (PointBus* bus : buses_) bus->read(image);
  if (!has_probes_) return;
  latch_.begin(now_ns_(), *feedback);
  std::size_t index = 0;
  for (const PointBus* bus : buses_)
    for (const ProbeSeen& probe : bus->probes()) latch_.add(index++, probe, feedback);
}

void Composite::write(const Command& command, const PointImage& image) noexcept {
  machine_->write(command, image);
  for (PointBus* bus : buses_) bus->write(image);
  if (has_probes_) latch_.commanded(command);
}

void Composite::stop() noexcept {
  machine_->stop();
  std::vector<std::thread> stopping;
  for (PointBus* bus : buses_) {
    try {
      stopping.emplace_back([bus] { bus->stop(); });
    } catch (const std::system_error&) {  // no thread can be made, so this bus is stopped here
      bus->stop();
    }
  }
  for (std::thread& thread : stopping) thread.join();
}

}  // namespace nc::hal
