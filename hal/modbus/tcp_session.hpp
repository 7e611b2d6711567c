// SPDX-License-Identifier: Apache-2.0
// One TCP connection to a Modbus server. A doubt about the next answer closes it (session.hpp).
#pragma once

#include "hal/modbus/session.hpp"

struct addrinfo;

namespace nc::hal::modbus {

class TcpSession final : public Session {
 public:
  explicit TcpSession(const LinkConfig& config);
  ~TcpSession() override;

  Result connect() override;
  void close() override;
  void abort() override;

 private:
  bool clear_to_send() override;
  int send_all(const Frame& request) override;
  int receive(const Frame& request, std::uint8_t* answer) override;
  void doubt(int error) override;
  Result connect_to(const addrinfo& address);
};

}  // namespace nc::hal::modbus
