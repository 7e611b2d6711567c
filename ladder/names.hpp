// SPDX-License-Identifier: Apache-2.0
// Finds the device or the constant that an operand in the text means.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "ladder/families.hpp"

namespace nc::ladder {

// The meaning of an operand.
struct Operand {
  enum class Form { kDevice, kConstant, kDigits } form = Form::kDevice;
  Place place;                       // the device, or the first bit of digits
  std::uint32_t z = Indirect::kNoZ;  // index of the word of the index register
  std::int64_t constant = 0;
  bool hexadecimal = false;
  std::uint32_t digits = 0;  // number of digits: 4 for K4M0
};

class Names {
 public:
  Names(const DeviceTable& table, const Layout& layout) : table_(table), layout_(layout) {}

  // Nothing when there is no such device or constant; then *message says why.
  std::optional<Operand> operand(std::string_view word, std::string* message) const;
  std::optional<Place> device(std::string_view word, std::string* message) const;

  // False when the name is taken or is not a valid name; then *message says why.
  bool alias(std::string_view name, std::string_view target, std::string* message);
  const std::map<std::string, std::string>& aliases() const { return aliases_; }
  // An operand with the devices in the place of other names for them.
  std::string without_aliases(std::string_view word) const;

 private:
  std::optional<Place> word_bit(std::string_view word) const;
  std::optional<Operand> constant(std::string_view word, std::string* message) const;
  std::string nearest(std::string_view word) const;

  const DeviceTable& table_;
  const Layout& layout_;
  std::map<std::string, std::string> aliases_;
};

// For a timer or counter the place of its current value; every other place unchanged.
Place current_value(const Place& place);

}  // namespace nc::ladder
