// SPDX-License-Identifier: Apache-2.0
// One TCP connection to a Modbus server: connect, requests, close. libmodbus takes answers from the socket (framing,
// time-outs); what they say is checked here, because it does not look at all of it (frame.hpp).
//
// Whatever leaves a doubt about the next answer closes the socket: a time-out (the late answer would be taken
// for the next one, and every answer after it would be one behind), a wrong transaction, unit or length, a malformed
// answer, an answer that nobody asked for. An exception reply is an answer like any other. MODBUS_ERROR_RECOVERY_LINK
// is never used: it sleeps and reconnects inside the call.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "hal/modbus/blocks.hpp"
#include "hal/modbus/frame.hpp"

struct _modbus;  // NOLINT(bugprone-reserved-identifier): libmodbus calls it so
struct addrinfo;

namespace nc::hal::modbus {

enum class Result : std::uint8_t {
  kOk,
  kException,  // the partner refuses; the connection stays
  kTimeout,    // the connection is closed, as for kFailed
  kFailed,
};

class Session {
 public:
  explicit Session(const LinkConfig& config);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // ---- the link's thread ----
  // Blocks for response_timeout_ms at most, per address of the host (and for the resolver when the host is a
  // name).
  Result connect();
  void close();
  bool is_open() const { return fd_ >= 0; }
  // Reads block.count cells (registers, or bits as 0 and 1).
  Result read(const Block& block, std::uint16_t* cells);
  Result write(const Block& block, const std::uint16_t* cells);
  // What went wrong in the last call: "holding 10..13 unit 1, function 3: illegal data address".
  const std::string& error() const { return error_; }

  // Code of the exception that the last call has brought, 0 = none.
  unsigned exception() const { return exception_; }

  // ---- any thread ----
  // Ends a call that blocks. The session cannot be used afterwards.
  void abort();

 private:
  struct FreeContext {
    void operator()(_modbus* context) const;
  };
  Result connect_to(const addrinfo& address);
  bool adopt(int fd);
  bool ready(const Block& block);
  Result exchange(const Block& block, const Frame& request, std::uint8_t* answer);
  int send_all(const Frame& request);

  const LinkConfig& config_;
  std::unique_ptr<_modbus, FreeContext> context_;
  std::string error_;
  unsigned exception_ = 0;
  std::mutex mutex_;  // fd_ while it changes, against abort()
  int fd_ = -1;
  std::uint16_t transaction_ = 0;
  bool aborted_ = false;
};

}  // namespace nc::hal::modbus
