// SPDX-License-Identifier: Apache-2.0
// A connection to the socket of the local services, which asks on behalf of one client of DDS. Nothing here waits.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/services/frames.hpp"
#include "runtime/services/rights.hpp"

namespace nc::dds {

class ServiceLine {
 public:
  enum class State {
    kClosed,
    kGreets,  // connected, and not limited to what it may do yet: nothing else is sent
    kReady,
    kTaken,   // another gateway asks for this client
  };
  ServiceLine() = default;
  ~ServiceLine() { close(); }
  ServiceLine(const ServiceLine&) = delete;
  ServiceLine& operator=(const ServiceLine&) = delete;

  // Connects, and gives up all rights but these. False with a sentence in *error.
  bool open(const std::string& path, const std::string& behalf, rt::services::RightSet rights, std::string* error);
  void close();
  State state() const { return state_; }
  int socket() const { return socket_; }
  bool writes() const { return sent_ < out_.size(); }

  // Sends a request when the connection is ready for it.
  void put(const std::string& text);
  // Sends what has room. False when the connection has ended.
  bool send_out();
  // Reads what has come, once. False when the connection has ended or the control has refused it; *error says why.
  bool receive(std::string* error);
  // The next message that is not part of the greeting.
  bool next(std::string* text);

 private:
  bool take_greeting(std::string* error);

  State state_ = State::kClosed;
  int socket_ = -1;
  bool greeted_ = false;
  std::string limit_;    // the first request
  std::string waiting_;  // frames for when it is ready
  std::string out_;
  std::size_t sent_ = 0;
  rt::services::FrameReader in_;
};

// Where the control of this name has its services: in /run/ncrtd, or in the folder of the user's session.
std::string find_service_socket(const std::string& share);

}  // namespace nc::dds
