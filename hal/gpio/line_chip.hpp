// SPDX-License-Identifier: Apache-2.0
// Lines of one GPIO chip behind a small interface, so that the bus knows no version of the library that it uses and the tests have a chip of
// their own. Values are those of the point: 1 is active, whatever level that is on the wire.
//
// All functions are called in one thread at a time, and may enter the kernel: never in the scan. A chip on an expander (I2C, SPI) may sleep in
// them for a millisecond.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace nc::hal::gpio {

enum class Bias : std::uint8_t { kAsIs, kNone, kPullUp, kPullDown };
enum class Drive : std::uint8_t { kPushPull, kOpenDrain, kOpenSource };

// One line as it is asked for.
struct LineSetup {
  std::string name;     // as the device tree or the board names it; empty = the offset says which
  unsigned offset = 0;  // on the chip
  bool output = false;
  bool active_low = false;
  Bias bias = Bias::kAsIs;
  Drive drive = Drive::kPushPull;  // of an output

  // "ESTOP", or "17" without a name.
  std::string text() const { return name.empty() ? std::to_string(offset) : name; }
};

enum class Opening : std::uint8_t {
  kOpen,
  kNoChip,   // there is no such chip now: it may come
  kTaken,    // a line has another owner
  kRefused,  // no such line, a bias or drive that the chip cannot do, no right to open it
};

class LineChip {
 public:
  virtual ~LineChip() = default;
  // All lines of the chip with this label, name (gpiochip0) or path, or none of them. An output has its value of `values` (one for each line) from
  // the first moment on. The lines belong to `consumer` (at most 31 bytes) until release(). With a sentence in *error unless it is kOpen.
  virtual Opening request(const std::string& chip, const std::string& consumer, std::span<const LineSetup> lines, std::span<const std::uint8_t> values, std::string* error) = 0;
  // The inputs, at the places of their lines; those of outputs are left as they are. False with a sentence: nothing in *values counts then.
  virtual bool read(std::vector<std::uint8_t>* values, std::string* error) = 0;
  // The outputs, from the places of their lines.
  virtual bool write(std::span<const std::uint8_t> values, std::string* error) = 0;
  // The lines are free for others. What an output does then is the chip's affair.
  virtual void release() noexcept = 0;
};

// A chip of this computer's kernel, through libgpiod. It is there where the build has that library.
std::unique_ptr<LineChip> make_gpiod_chip();

}  // namespace nc::hal::gpio
