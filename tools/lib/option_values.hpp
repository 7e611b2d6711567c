// SPDX-License-Identifier: Apache-2.0
// Checks of the values of command-line options. CLI11 accepts values that are probably mistakes: -1 as a very large number, 010 as eight,
// nan inside every range, an empty text as if the option were not there. These checks refuse them with a sentence.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace nc::tools {

/// A text that is not empty.
inline CLI::Validator given() {
  return CLI::Validator([](std::string& text) { return text.empty() ? std::string("must not be empty") : std::string(); }, "");
}

/// A whole number in decimal digits. To be used with transform(): leading zeros, which CLI11 would read as octal, are removed.
inline CLI::Validator whole(std::uint64_t least, std::uint64_t most) {
  return CLI::Validator(
      [least, most](std::string& text) {
        std::string wrong =
            "must be a whole number from " + std::to_string(least) + " to " + std::to_string(most) + ", is " + (text.empty() ? "empty" : text);
        if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos) return wrong;
        text.erase(0, std::min(text.find_first_not_of('0'), text.size() - 1));
        constexpr std::size_t kSafeDigits = 19;  // fits into 64 bits
        if (text.size() > kSafeDigits) return wrong;
        const std::uint64_t value = std::stoull(text);
        return value >= least && value <= most ? std::string() : wrong;
      },
      "");
}

/// A time in seconds, above 0, or from 0 on if `zero_allowed`.
inline CLI::Validator seconds(bool zero_allowed, const char* most_text) {
  const double most = std::strtod(most_text, nullptr);
  return CLI::Validator(
      [zero_allowed, most, most_text](std::string& text) {
        double value = 0;
        const bool number = CLI::detail::lexical_cast(text, value) && (value > 0 || (zero_allowed && value == 0)) && value <= most;
        if (number) return std::string();
        return std::string(zero_allowed ? "must be at least 0" : "must be above 0") + " and at most " + most_text + ", is " + (text.empty() ? "empty" : text);
      },
      "SECONDS");
}

/// One of some words, in upper or lower case. To be used with transform(): the word becomes that of the list.
inline CLI::Validator one_of(std::vector<std::string> words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
  return CLI::Validator(
      [words = std::move(words), list](std::string& text) {
        for (const std::string& word : words) {
          if (CLI::detail::to_lower(text) != word) continue;
          text = word;
          return std::string();
        }
        return "must be one of " + list + ", is " + (text.empty() ? "empty" : text);
      },
      "");
}

}  // namespace nc::tools
