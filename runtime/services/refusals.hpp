// SPDX-License-Identifier: Apache-2.0
// The refusal of several values of tables: each with its place, and the line of the text that gives it.
#pragma once

#include <string>

#include "runtime/services/call.hpp"
#include "runtime/services/table_values.hpp"

namespace nc::rt::services {

class Refusals {
 public:
  void add(const TableValue& wanted, const Outcome& refused) {
    if (++count_ == 1) first_ = refused.why;
    if (count_ > kMost) return;
    const std::string line = wanted.line != 0 ? "line " + std::to_string(wanted.line) + ": " : "";
    text_ += (count_ > 1 ? "; " : "") + line + place_text(wanted.place) + ": " + refused.text;
  }
  bool empty() const { return count_ == 0; }
  Outcome outcome() const { return Outcome::refused(first_, text_ + (count_ > kMost ? "; and " + std::to_string(count_ - kMost) + " more" : "")); }

 private:
  static constexpr std::size_t kMost = 5;
  std::size_t count_ = 0;
  Refused first_ = Refused::kFailed;
  std::string text_;
};

}  // namespace nc::rt::services
