// SPDX-License-Identifier: Apache-2.0
// The client's side of the services on a local socket: connects, asks, waits for the reply.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/services/frames.hpp"

namespace nc::tools {

using Json = nlohmann::json;

/** Exit statuses of ncctl. */
inline constexpr int kControlUsage = 1, kControlRefused = 2, kControlNoRight = 3, kControlNoControl = 4, kControlFailed = 5, kControlNobody = 6;

/** A refusal as ncctl reports it. */
struct ServiceRefusal {
  int status = 0;     ///< exit status, 0 = it was not refused
  std::string error;  ///< the name of the refusal in the protocol
  std::string text;   ///< a sentence
};

/** The sockets of controls that run on this computer, sorted: those in /run/ncrtd and in the user's folder of run-time files. */
std::vector<std::string> find_sockets();

class ServiceClient {
 public:
  ServiceClient() {}  // not = default, which would be noexcept: a Json may need memory
  ~ServiceClient();
  ServiceClient(const ServiceClient&) = delete;
  ServiceClient& operator=(const ServiceClient&) = delete;

  /** Connects and reads the greeting. On failure `refusal` says why. */
  bool open(const std::string& path, ServiceRefusal* refusal);
  /** Asks for a service and waits for its reply, at most 30 s. On failure `refusal` says why. */
  bool call(const std::string& service, const Json& args, Json* reply, ServiceRefusal* refusal);
  /** Waits for the next update of a watch list, at most 30 s. On failure `refusal` says why. */
  bool next_update(Json* update, ServiceRefusal* refusal);
  /** What the control said when it let the client in. */
  const Json& greeting() const { return greeting_; }

 private:
  bool receive(Json* message, ServiceRefusal* refusal);
  int socket_ = -1;
  std::uint64_t next_id_ = 1;
  rt::services::FrameReader in_;
  Json greeting_;
};

}  // namespace nc::tools
