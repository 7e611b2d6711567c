// SPDX-License-Identifier: Apache-2.0
// SocketCAN: a raw socket on an interface of Linux (can0, vcan0), which the system has set up with its bit rate.
#pragma once

#include "hal/canopen/can_port.hpp"

namespace nc::hal::canopen {

class SocketPort final : public CanPort {
 public:
  explicit SocketPort(std::string interface) : interface_(std::move(interface)) {}
  ~SocketPort() override { close(); }
  bool open(std::string* error) override;
  void close() noexcept override;
  bool send(const CanFrame& frame) noexcept override;
  bool receive(CanFrame* frame) noexcept override;

 private:
  const std::string interface_;
  int fd_ = -1;
};

}  // namespace nc::hal::canopen
