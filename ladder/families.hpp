// SPDX-License-Identifier: Apache-2.0
// The internal devices of a program: kinds, ranges, places in the image, and names.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ladder/code.hpp"

namespace nc::ladder {

enum class Kind {
  kNamed,         // of the table
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
  DeviceType type = DeviceType::kBit;  // of a timer or counter: of its contact
  bool writable = false;
  bool pairs = false;                // two neighbours make a 32-bit device
  std::uint32_t index = 0;           // in the image; of a timer or counter: of its contact
  std::uint32_t value = 0;           // of a timer or counter: word of its current value
  std::uint32_t number = 0;          // M10: 10; ST3: kTimers + 3
  std::uint32_t first = 0, end = 0;  // places of the same kind in the array of its type
  std::string_view family;           // "M"; empty for a named device
};

Layout make_layout(const DeviceTable& table, std::uint32_t edges, std::uint32_t loops);

// An internal device by name. Nothing when the name is not of that form; *message says when it is, but the
// number does not exist.
std::optional<Place> internal_device(std::string_view name, const Layout& layout, std::string* message);

// A device of the table.
Place named_device(const Device& device);

}  // namespace nc::ladder
