// SPDX-License-Identifier: Apache-2.0
// What a service tells its service manager: the datagrams of sd_notify(3), without its library. The protocol
// is stable and documented by systemd: one datagram of "NAME=value" lines to the socket that $NOTIFY_SOCKET names.
#pragma once

#include <cstdint>
#include <string>

namespace nc::tools {

class ServiceNotify {
 public:
  // Reads $NOTIFY_SOCKET, $WATCHDOG_USEC and $WATCHDOG_PID.
  ServiceNotify();
  ~ServiceNotify();
  ServiceNotify(const ServiceNotify&) = delete;
  ServiceNotify& operator=(const ServiceNotify&) = delete;

  // False when there is no service manager, or when it does not take the datagram; never waits.
  bool send(const std::string& lines);

  // The longest interval between two WATCHDOG=1 that the manager allows; 0 = it expects none.
  std::int64_t watchdog_ns() const { return watchdog_ns_; }

 private:
  int socket_ = -1;
  std::string address_;  // in the form of sockaddr_un.sun_path
  std::int64_t watchdog_ns_ = 0;
};

}  // namespace nc::tools
