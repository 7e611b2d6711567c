// SPDX-License-Identifier: Apache-2.0
// The way to the partners of a link: a TCP connection to a server (tcp_session.hpp) or a serial line (rtu_session.hpp). Open, one request after
// the other, close. libmodbus takes answers from the descriptor (framing, time-outs, the check sum of a serial line); what they say is checked
// here, because it does not look at all of it (frame.hpp).
//
// Whatever leaves a doubt about the next answer keeps later answers away from it: a time-out (the late answer would be taken for the next
// one, and every answer after it would be one behind), a wrong transaction, unit or length, a malformed answer, an answer that nobody asked
// for. How this is done is each kind's own. An exception reply is an answer like any other. MODBUS_ERROR_RECOVERY_LINK is never used: it sleeps
// and reconnects inside the call.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "hal/modbus/blocks.hpp"
#include "hal/modbus/frame.hpp"

struct _modbus;  // NOLINT(bugprone-reserved-identifier): libmodbus calls it so

namespace nc::hal::modbus {

enum class Result : std::uint8_t {
  kOk,
  kException,  // the partner refuses; what is open stays open
  kTimeout,    // what comes late is kept away from the next request; is_open() says whether there can be one at once
  kFailed,     // the same
};

class Session {
 public:
  explicit Session(const LinkConfig& config) : config_(config) {}
  virtual ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // ---- the link's thread ----
  // Blocks for response_timeout_ms at most; a TCP connection for each address of the host, and for the resolver when the host is a name.
  virtual Result connect() = 0;
  virtual void close() = 0;
  bool is_open() const { return fd_ >= 0; }
  // Reads block.count cells (registers, or bits as 0 and 1).
  Result read(const Block& block, std::uint16_t* cells);
  Result write(const Block& block, const std::uint16_t* cells);
  // The error of the last call, such as "holding 10..13 unit 1, function 3: illegal data address".
  const std::string& error() const { return error_; }

  // Code of the exception in the last call, 0 = none.
  unsigned exception() const { return exception_; }

  // ---- any thread ----
  // Ends a call that blocks: a TCP session at once, a serial line after byte_timeout_ms. The session cannot be used afterwards.
  virtual void abort() = 0;

 protected:
  struct FreeContext {
    void operator()(_modbus* context) const;
  };
  // Recovery, time-outs; false: there is no memory for a context.
  bool set_up(_modbus* context);
  // Takes over the descriptor of an open partner; false: abort() came first.
  bool adopt(int fd);
  // Before a request nothing may be there to read. False: error_ says why there can be none now.
  virtual bool clear_to_send() = 0;
  // 0 or the error.
  virtual int send_all(const Frame& request) = 0;
  // An answer of this kind as one of TCP, which is what frame.hpp checks; its size, 0 or less: errno.
  virtual int receive(const Frame& request, std::uint8_t* answer) = 0;
  // The last request has ended with a time-out, an error of the line or an answer that was not its own.
  virtual void doubt(int error) = 0;

  const LinkConfig& config_;
  std::unique_ptr<_modbus, FreeContext> context_;
  std::string error_;
  std::mutex mutex_;  // fd_ while it changes, against abort()
  int fd_ = -1;
  bool aborted_ = false;

 private:
  bool ready(const Block& block);
  Result exchange(const Block& block, const Frame& request, std::uint8_t* answer);

  unsigned exception_ = 0;
  std::uint16_t transaction_ = 0;
};

// The kind that the configuration asks for.
std::unique_ptr<Session> make_session(const LinkConfig& config);

}  // namespace nc::hal::modbus
