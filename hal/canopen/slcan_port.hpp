// SPDX-License-Identifier: Apache-2.0
// An adapter on a serial line with the ASCII protocol slcan ("LAWICEL"). A frame is `t`, three digits of the identifier, the length, the data and a
// carriage return. For commissioning, and for tests through a pseudo terminal; it has the jitter of a serial line.
#pragma once

#include <cstddef>

#include "hal/canopen/can_port.hpp"

namespace nc::hal::canopen {

// Writes the text of a frame with its carriage return into `text`, which has room for 32 characters. Returns the length.
std::size_t slcan_text(const CanFrame& frame, char* text) noexcept;
// Takes characters as they come; true with the frame when one is complete.
class SlcanReader {
 public:
  bool take(char c, CanFrame* frame) noexcept;

 private:
  static constexpr std::size_t kLine = 32;
  char line_[kLine] = {};
  std::size_t size_ = 0;
  bool too_long_ = false;
};

class SlcanPort final : public CanPort {
 public:
  SlcanPort(std::string device, unsigned bit_s) : device_(std::move(device)), bit_s_(bit_s) {}
  ~SlcanPort() override { close(); }
  bool open(std::string* error) override;
  void close() noexcept override;
  bool send(const CanFrame& frame) noexcept override;
  bool receive(CanFrame* frame) noexcept override;

 private:
  const std::string device_;
  const unsigned bit_s_;
  int fd_ = -1;
  SlcanReader reader_;
  char buffer_[256] = {};
  std::size_t at_ = 0, size_ = 0;
};

}  // namespace nc::hal::canopen
