// SPDX-License-Identifier: Apache-2.0
// The internal devices of a program: kinds, ranges, places in the image, and names.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ladder/code.hpp"

namespace nc::ladder {

enum class Kind {
  kNamed,         // a device of the table
  kRelay,         // M, L, SM: bits
  kTimer,         // T, ST: number of the timer
  kCounter,       // C
  kContact,       // TS, STS, CS: read-only bits
  kRegister,      // D, Z, SD: words
  kCurrentValue,  // TN, STN, CN: words
  kWordBit,       // D0.5: `index` is the word, `number` the bit
};

// A device as an operand.
struct Place {
  Kind kind = Kind::kNamed;
  DeviceType type = DeviceType::kBit;  // for a timer or counter the type of its contact
  bool writable = false;
  bool pairs = false;                // two neighbours may be used as a 32-bit device
  std::uint32_t index = 0;           // index in the image; for a timer or counter that of its contact
  std::uint32_t value = 0;           // for a timer or counter the index of its current value
  std::uint32_t number = 0;          // 10 for M10; kTimers + 3 for ST3
  std::uint32_t first = 0, end = 0;  // range of the devices of the same kind in the array of their type
  std::string_view family;           // "M"; empty for a named device
};

Layout make_layout(const DeviceTable& table, std::uint32_t edges, std::uint32_t loops);

// An internal device by name. Nothing when the name does not have the form of one, or when its number does not exist; then *message
// says so.
std::optional<Place> internal_device(std::string_view name, const Layout& layout, std::string* message);

// A device of the table.
Place named_device(const Device& device);

}  // namespace nc::ladder
