// SPDX-License-Identifier: Apache-2.0
// From what is written in an operand to a device or a constant.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "ladder/families.hpp"

namespace nc::ladder {

// A word of the text as an operand.
struct Operand {
  enum class Form { kDevice, kConstant, kDigits } form = Form::kDevice;
  Place place;                       // device, or the first bit of digits
  std::uint32_t z = Indirect::kNoZ;  // index register (its word)
  std::int64_t constant = 0;
  bool hexadecimal = false;
  std::uint32_t digits = 0;  // K4M0: 4
};

class Names {
 public:
  Names(const DeviceTable& table, const Layout& layout) : table_(table), layout_(layout) {}

  // Nothing, and why, when there is no such device or constant.
  std::optional<Operand> operand(std::string_view word, std::string* message) const;
  std::optional<Place> device(std::string_view word, std::string* message) const;

  // False, and why, when the name is taken or not a name.
  bool alias(std::string_view name, std::string_view target, std::string* message);
  const std::map<std::string, std::string>& aliases() const { return aliases_; }

 private:
  std::optional<Place> word_bit(std::string_view word) const;
  std::optional<Operand> constant(std::string_view word, std::string* message) const;
  std::string nearest(std::string_view word) const;

  const DeviceTable& table_;
  const Layout& layout_;
  std::map<std::string, std::string> aliases_;
};

// A timer or counter as a word: its current value.
Place current_value(const Place& place);

}  // namespace nc::ladder
