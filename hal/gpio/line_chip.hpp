// SPDX-License-Identifier: Apache-2.0
// The lines of one GPIO chip behind a small interface, so that the bus does not depend on a version of the library, and tests can have a simulated
// chip. Values are those of the points: 1 is active, whatever level that is on the wire.
//
// The functions are called by one thread at a time. They may enter the kernel, so the scan must not call them. For a chip on an expander (I2C, SPI) they may
// take a millisecond.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace nc::hal::gpio {

enum class Bias : std::uint8_t { kAsIs, kNone, kPullUp, kPullDown };
enum class Drive : std::uint8_t { kPushPull, kOpenDrain, kOpenSource };

// One line and its settings.
struct LineSetup {
  std::string name;     // its name in the device tree or on the board; empty = the line is given by its offset
  unsigned offset = 0;  // number of the line on the chip
  bool output = false;
  bool active_low = false;
  Bias bias = Bias::kAsIs;
  Drive drive = Drive::kPushPull;  // only for an output
  bool edges = false;              // an input whose edges the kernel is to note with their times
  unsigned debounce_ms = 0;        // an input that the kernel is to debounce; only where LineChip::debounces()

  // "ESTOP", or "17" without a name.
  std::string text() const { return name.empty() ? std::to_string(offset) : name; }
};

enum class Opening : std::uint8_t {
  kOpen,
  kNoChip,   // there is no such chip now; it may come later
  kTaken,    // a line is in use by another process
  kRefused,  // there is no such line, the chip does not have this bias or drive, or the process may not open it
};

// An edge as the kernel has noted it.
struct LineEdge {
  std::size_t line = 0;      // place in the request
  bool rising = false;       // the line became active
  std::int64_t time_ns = 0;  // CLOCK_MONOTONIC; before Linux 5.7 CLOCK_REALTIME
};

class LineChip {
 public:
  virtual ~LineChip() = default;
  // Requests lines of the chip with this label, name (gpiochip0) or path: all of them or none. `values` has one value for each line; an output has its value
  // from the first moment on. The lines belong to `consumer` (at most 31 bytes) until release(). Unless the result is kOpen, *error gets a sentence.
  virtual Opening request(const std::string& chip, const std::string& consumer, std::span<const LineSetup> lines, std::span<const std::uint8_t> values, std::string* error) = 0;
  // Reads the inputs into *values, in the order of the request; the values of outputs are not changed. False with a sentence in *error: then *values is not valid.
  virtual bool read(std::vector<std::uint8_t>* values, std::string* error) = 0;
  // Appends the edges that have come since the last call, those of one line in their order. It does not wait. The kernel keeps only some edges of a line (16
  // in version 1 of its interface); of further ones it drops some, which the caller sees by two edges of the same kind in a row or by a level that does not fit.
  virtual bool edges(std::vector<LineEdge>* edges, std::string* error) = 0;
  // Whether the kernel can debounce, with this library.
  virtual bool debounces() const { return false; }
  // Writes the outputs from `values`, in the order of the request.
  virtual bool write(std::span<const std::uint8_t> values, std::string* error) = 0;
  // Releases the lines for other processes. The level of an output after that depends on the chip.
  virtual void release() noexcept = 0;
};

// A chip of this computer, through libgpiod. Defined only when the program is built with that library.
std::unique_ptr<LineChip> make_gpiod_chip();

}  // namespace nc::hal::gpio
