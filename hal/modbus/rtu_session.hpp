// SPDX-License-Identifier: Apache-2.0
// A serial line with Modbus RTU partners, RS-232 or RS-485. Modbus over serial line V1.02.
//
// An answer names its unit and function and nothing else of its request, so a late one cannot be told from the answer to the next request of
// the same kind. A time-out is therefore followed by silence: nothing is sent until nothing has come for another response time-out, and what has
// come until then is thrown away. Behind an answer that was not understood the silence is the one between two frames (2.5.1.1). A doubt does not
// close the line: opening it again would tell nothing of its partners. It is closed when the device itself is gone.
#pragma once

#include <chrono>

#include "hal/modbus/session.hpp"

namespace nc::hal::modbus {

// Silence that parts two frames of a line: 3.5 characters, and 1.75 ms where they are faster than 19200 bit/s (2.5.1.1).
std::chrono::microseconds frame_gap(const SerialConfig& line);

class RtuSession final : public Session {
 public:
  explicit RtuSession(const LinkConfig& config);
  ~RtuSession() override;

  Result connect() override;
  void close() override;
  void abort() override;

 private:
  using Time = std::chrono::steady_clock::time_point;

  bool clear_to_send() override;
  int send_all(const Frame& request) override;
  int receive(const Frame& request, std::uint8_t* answer) override;
  void doubt(int error) override;
  bool open_line(std::string* why);
  bool set_direction(std::string* why);
  bool take_silence(std::chrono::microseconds silence);
  bool fail(const std::string& why);

  std::chrono::microseconds silence_{0};  // of the line before the next request, because of a doubt; 0 = none
  Time last_byte_{};                      // when something was on the line, as far as it is known here
};

}  // namespace nc::hal::modbus
