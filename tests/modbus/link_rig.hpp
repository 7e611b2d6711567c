// SPDX-License-Identifier: Apache-2.0
// A link and its partner for tests, whose scans the test makes itself.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <thread>

#include "hal/modbus/link.hpp"
#include "modbus/loopback_server.hpp"

namespace nc::test {

using hal::modbus::Format;
using hal::modbus::LinkState;
using hal::modbus::OnLoss;
using hal::modbus::PointMap;
using hal::modbus::Table;

class LinkRig {
 public:
  LinkRig() {
    config.name = "io";
    config.host = "127.0.0.1";
    config.poll_ms = 2;
    short_timeouts(5000);  // a loaded computer must not look like a dead partner
    config.lost_after = 2;
    config.backoff_min_ms = 1;
    config.backoff_max_ms = 20;
    config.ok_point = 0;
    next_ = 1;
  }
  ~LinkRig() {
    if (link) link->stop();
  }

  void short_timeouts(unsigned ms = 300) { config.response_timeout_ms = config.byte_timeout_ms = ms; }

  // Adds a point; returns its index.
  unsigned add(Table table, unsigned address, Format format = Format::kBit, bool output = false,
               unsigned unit = 1) {
    PointMap map;
    map.point = next_++;
    map.table = table;
    map.address = static_cast<std::uint16_t>(address);
    map.format = format;
    map.output = output;
    map.unit = static_cast<std::uint8_t>(unit);
    config.points.push_back(map);
    return map.point;
  }
  PointMap& map() { return config.points.back(); }

  void start_serial(const std::string& device) {
    config.host.clear();
    config.serial.device = device;
    start(0);
  }
  void start(std::uint16_t port) {
    config.port = port;
    link = std::make_unique<hal::modbus::ModbusLink>(config, [this](const std::string& line) {
      const std::lock_guard lock(mutex_);
      log_ += line + "\n";
    });
    std::string error;
    for (const PointMap& each : config.points) image.value[each.point] = each.initial;
    ASSERT_TRUE(link->start(image, &error)) << error;
  }

  // One scan.
  void scan() {
    link->read(&image);
    link->write(image);
  }
  // Scans until `so` returns true; false if it does not within `seconds`, which is far too long.
  bool until(const std::function<bool()>& so, unsigned seconds = 30) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
    do {
      scan();
      if (so()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    } while (std::chrono::steady_clock::now() < end);
    return false;
  }
  std::uint32_t value(unsigned point) const { return image.value[point]; }
  bool good(unsigned point) const { return image.good[point] != 0; }
  bool ok() const { return image.value[config.ok_point] != 0; }
  std::string log() {
    const std::lock_guard lock(mutex_);
    return log_;
  }

  hal::modbus::LinkConfig config;
  std::unique_ptr<hal::modbus::ModbusLink> link;
  hal::PointImage image;

 private:
  unsigned next_;
  std::mutex mutex_;
  std::string log_;
};

}  // namespace nc::test
