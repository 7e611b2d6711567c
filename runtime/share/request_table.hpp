// SPDX-License-Identifier: Apache-2.0
// The one table of commands: what is said of each kind of request wherever it comes from, the topic nc_Command or a service (runtime/services/service_table.hpp).
#pragma once

#include <cstdint>
#include <optional>

#include "runtime/command.hpp"
#include "runtime/share/layout.hpp"

namespace nc::rt::share {

// Whether a command stops the machine.
enum class Stop : std::uint8_t {
  kNo,
  kInTurn,  // when its turn comes, also when its client has gone before that
  kAtOnce   // when it comes, and not at its turn; it needs no control, no place and no name of its own
};

// Which part systems a command concerns.
enum class Scope : std::uint8_t {
  kNamed,   // the one that it names, or all of them
  kOne,     // the one that it names
  kControl  // all of them, whichever it names
};

struct RequestRow {
  RequestKind kind;
  Stop stop;
  Scope scope;
  bool takes_time;                     // answered with `accepted` first, and with `done` or `failed` later
  std::optional<CommandKind> command;  // of the runtime; none = the intake does it in another way

  bool stops() const { return stop != Stop::kNo; }
  bool stops_at_once() const { return stop == Stop::kAtOnce; }
  // It sets something in motion, and a feed hold behind it takes it back as long as that has not happened.
  bool moves() const { return kind == RequestKind::kCycleStart || kind == RequestKind::kJog || kind == RequestKind::kRestartApproach; }
};

// The row of a kind; of one that does not exist, a row of which nothing is true.
const RequestRow& request_row(RequestKind kind);
inline const RequestRow& request_row(const Request& request) { return request_row(static_cast<RequestKind>(request.kind)); }

// What the gateway says of its clients, without an acknowledgement.
inline bool is_from_gateway(const Request& request) {
  const auto kind = static_cast<RequestKind>(request.kind);
  return kind == RequestKind::kClientGone || kind == RequestKind::kGatewayBegan;
}

}  // namespace nc::rt::share
