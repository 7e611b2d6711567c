// SPDX-License-Identifier: Apache-2.0
// Modbus RTU devices for tests, on the far side of a pseudo-terminal, written from the protocol and not with libmodbus. What they answer is
// what the server on loopback answers (loopback_server.hpp), in frames of a serial line; a test may put anything else on the line.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "modbus/loopback_server.hpp"

namespace nc::test {

/// Check sum of a frame, Modbus over serial line V1.02, 6.2.2; low byte first on the line.
std::uint16_t crc_of(const std::uint8_t* bytes, std::size_t size);
/// A frame of the unit and the PDU behind it.
Bytes rtu_frame(const Bytes& unit_and_pdu);

class SerialDevice {
 public:
  /// What goes onto the line for one request; `right` is a whole frame.
  using Fault = std::function<Answer(const Bytes& request, Answer right)>;

  SerialDevice();
  ~SerialDevice();

  /// Path of the line that the link opens.
  const std::string& path() const { return path_; }
  void set_fault(Fault fault);
  /// Units that say nothing, as if they had no power.
  void set_silent(const std::set<unsigned>& units);
  /// Bytes that nobody asked for.
  void put(const Bytes& bytes);
  LoopbackServer& tables() { return tables_; }
  /// Shortest time between the end of one frame and the beginning of the next, seen from this side, in us.
  double shortest_gap_us() const { return shortest_gap_us_; }
  /// Requests whose check sum was wrong, or that were no frames.
  unsigned damaged() const { return damaged_; }
  /// The adapter is pulled out.
  void vanish();

 private:
  void serve();
  bool take_request(Bytes* request);
  void send(const Bytes& bytes, unsigned drip_ms);

  int far_ = -1;
  std::string path_;
  std::atomic<bool> stopping_{false};
  std::atomic<double> shortest_gap_us_{1e9};
  std::atomic<unsigned> damaged_{0};
  std::mutex mutex_;
  Fault fault_;
  std::set<unsigned> silent_;
  LoopbackServer tables_;
  std::thread thread_;
};

}  // namespace nc::test
