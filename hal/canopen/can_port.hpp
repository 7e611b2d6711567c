// SPDX-License-Identifier: Apache-2.0
// What carries the frames: an interface of SocketCAN, an adapter that speaks slcan, or a bus in the memory of a test.
#pragma once

#include <memory>
#include <string>

#include "hal/canopen/frame.hpp"

namespace nc::hal::canopen {

class CanPort {
 public:
  virtual ~CanPort() = default;
  // In an ordinary thread. False with a sentence in *error.
  virtual bool open(std::string* error) = 0;
  virtual void close() noexcept = 0;
  // In the bus's thread, between open() and close(); neither waits, locks or allocates. False: the queue of the controller is full, or
  // the bus is off.
  virtual bool send(const CanFrame& frame) noexcept = 0;
  // False: nothing has come.
  virtual bool receive(CanFrame* frame) noexcept = 0;
};

// "can0": SocketCAN. "slcan:/dev/ttyACM0": an adapter on a serial line, which is switched to `bit_s`.
std::unique_ptr<CanPort> make_port(const std::string& interface, unsigned bit_s);
// What two controls cannot have at the same time: the same text for every name of one interface: a serial line has links (/dev/serial/by-id/...), an interface of Linux further names.
std::string device_of(const std::string& interface);

}  // namespace nc::hal::canopen
