// SPDX-License-Identifier: Apache-2.0
// A request for a service that has come over DDS, as a frame of the local protocol; and a message of the local protocol as parts of a reply. Without DDS.
//
// The decoder of the local services (runtime/services/call.hpp) reads every request before it is passed on: both ways in refuse the same.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "nc_dds.h"
#include "runtime/services/call.hpp"

namespace nc::dds {

using rt::services::Outcome;
using rt::services::Refused;
using rt::services::Right;
using rt::services::RightSet;
using rt::services::ServiceRow;

// What this gateway passes on, and why nothing more.
struct ServiceGate {
  RightSet rights;
  RightSet most;                // what it may pass on at any time: the connections to the control are limited to that when they begin
  bool by_permissions = false;  // DDS Security says what each client may write
  std::string why;  // "this gateway takes no commands: ncdds --commands"
};

// Whether a client of the services may have this name, of which a partition of DDS is made.
bool is_client_name(std::string_view name);

// A request as it has come.
struct ServiceRequest {
  Right right = Right::kView;  // of its topic
  std::uint64_t number = 0;    // of the client's choice
  std::string service, args;
  bool hides = false;          // there is something behind the end of a text
  std::int64_t sent_ns = 0;    // time of day by the clock of the client
};
// The bytes behind the end of each text must be those that have come, or 0.
ServiceRequest read_request(const nc_ServiceRequest& sample, Right right, std::int64_t sent_ns);

// The text of a frame for the local services. False with the refusal in *outcome.
bool service_frame(const ServiceRequest& request, std::uint64_t id, std::int64_t wall_ns, const ServiceGate& gate, std::string* frame, Outcome* outcome);

// One message that is to go to a client.
struct ServiceMessage {
  std::uint64_t number = 0;  // of its request, 0 = an update of a watch list
  nc_ServiceStatus status = nc_SERVICE_DONE;
  std::string refusal, body;
};
ServiceMessage refusal_message(std::uint64_t number, const Outcome& outcome);
// Reads a message of the local services; *id = 0 for an update. False when it is none.
bool read_message(std::string_view text, std::uint64_t* id, ServiceMessage* message);

// Leaves in the reply of the service `rights` only what the client may.
void narrow_rights(ServiceMessage* message, RightSet rights);

// Cuts a text into parts of at most `most` bytes, which are at least four, between two characters. There is at least one part.
std::vector<std::string_view> parts_of(std::string_view text, std::size_t most);

}  // namespace nc::dds
