// SPDX-License-Identifier: Apache-2.0
// The client's side of the services: asks, waits for the reply. Here the one on a local socket; the one over DDS is in tools/remote.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace nc::rt::services {
struct ServiceRow;
}

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

/** The refusal with this name in the protocol, with the exit status that belongs to it. */
ServiceRefusal refusal_named(const std::string& error, const std::string& text);
/** There is nobody, or nobody answers. */
ServiceRefusal no_connection(const std::string& text);

class ServiceClient {
 public:
  ServiceClient() = default;
  virtual ~ServiceClient() = default;
  ServiceClient(const ServiceClient&) = delete;
  ServiceClient& operator=(const ServiceClient&) = delete;
  /** Asks for a service and waits for its reply, at most 30 s. On failure `refusal` says why. */
  virtual bool call(const std::string& service, const Json& args, Json* reply, ServiceRefusal* refusal) = 0;
  /** Waits for the next update of a watch list, at most 30 s. On failure `refusal` says why. */
  virtual bool next_update(Json* update, ServiceRefusal* refusal) = 0;
  /** False when this client is known to lack the right to a service, which the control then refuses. */
  virtual bool may_use(const rt::services::ServiceRow& row) = 0;
};

/** Connects to the socket and reads the greeting; null with the reason in *refusal. */
std::unique_ptr<ServiceClient> open_local_client(const std::string& path, ServiceRefusal* refusal);

/** Where a control is over DDS, and as whom. */
struct RemoteAccess {
  bool used = false;      ///< over DDS, and not on the local socket
  unsigned domain = 0;
  std::string security;   ///< folder of an identity; "" = without DDS Security
  std::string network;    ///< interface; "" = this computer only
  std::string control;    ///< its name, which is the partition
  std::string client;     ///< name of this client; "" = one of its own
};
/** What makes a client over DDS (tools/remote/remote_client.hpp); null in a program without Cyclone DDS. */
using OpenRemote = std::unique_ptr<ServiceClient> (*)(const RemoteAccess& access, ServiceRefusal* refusal);

}  // namespace nc::tools
