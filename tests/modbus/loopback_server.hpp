// SPDX-License-Identifier: Apache-2.0
// A Modbus TCP server for tests, on 127.0.0.1 and a free port, written from the protocol without libmodbus. It is an
// ordinary device, whose answers a test may replace by anything else.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace nc::test {

using Bytes = std::vector<std::uint8_t>;

// The answer to one request.
struct Answer {
  Bytes bytes;
  unsigned delay_ms = 0;
  unsigned drip_ms = 0;  // pause behind each byte
  bool close = false;    // afterwards
};

// The tables of one unit.
struct Unit {
  std::map<unsigned, std::uint16_t> coil, discrete, input,
      holding;  // an address that is not in the map is refused
};

class LoopbackServer {
 public:
  using Fault = std::function<Answer(const Bytes& request, Answer right)>;

  explicit LoopbackServer(std::uint16_t port = 0);  // 0 = any free one
  ~LoopbackServer();

  std::uint16_t port() const { return port_; }
  // Acts from the next request on; an empty function = right answers.
  void set_fault(Fault fault);
  // Access to the device; no request is served meanwhile.
  void with(const std::function<void(std::map<unsigned, Unit>&)>& use);
  std::uint16_t holding(unsigned unit, unsigned address);
  std::uint16_t coil(unsigned unit, unsigned address);
  unsigned connections() const { return connections_; }
  // Function codes of all requests so far.
  std::vector<std::uint8_t> functions();
  // What the same device answers on a serial line: `request` is a whole frame of it, and so is what comes back.
  Bytes serial_answer(const Bytes& request);
  void stop();

 private:
  void accept_all();
  void serve(int fd);
  Answer right_answer(const Bytes& request);
  Bytes reply_pdu(const Bytes& request);

  int listen_fd_ = -1;
  std::uint16_t port_ = 0;
  std::atomic<bool> stopping_{false};
  std::atomic<unsigned> connections_{0};
  std::mutex mutex_;
  Fault fault_;
  std::map<unsigned, Unit> units_;
  std::vector<std::uint8_t> functions_;
  std::vector<int> open_;
  std::list<std::thread> threads_;
  std::thread acceptor_;
};

}  // namespace nc::test
