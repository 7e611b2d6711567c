// SPDX-License-Identifier: Apache-2.0
// The port through which frames are sent and received: an interface of SocketCAN, an adapter that speaks slcan, or a simulated bus in a test.
#pragma once

#include <memory>
#include <string>

#include "hal/canopen/frame.hpp"

namespace nc::hal::canopen {

class CanPort {
 public:
  virtual ~CanPort() = default;
  // Called in an ordinary thread. False with a sentence in *error.
  virtual bool open(std::string* error) = 0;
  virtual void close() noexcept = 0;
  // send() and receive() are called in the bus's thread, between open() and close(). They neither wait nor lock nor allocate. send() is false when the
  // queue of the controller is full or the bus is off.
  virtual bool send(const CanFrame& frame) noexcept = 0;
  // False when no frame has come.
  virtual bool receive(CanFrame* frame) noexcept = 0;
};

// "can0" is an interface of SocketCAN. "slcan:/dev/ttyACM0" is an adapter on a serial line, which is switched to `bit_s`.
std::unique_ptr<CanPort> make_port(const std::string& interface, unsigned bit_s);
// What two controls cannot have at the same time: the same text for every name of one interface: a serial line has links (/dev/serial/by-id/...), an interface of Linux further names.
std::string device_of(const std::string& interface);

}  // namespace nc::hal::canopen
