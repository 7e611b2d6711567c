// SPDX-License-Identifier: Apache-2.0
// What is said of a chip whose lines cannot be had, in the same words for both versions of libgpiod (gpiod1_chip.cpp, gpiod2_chip.cpp).
#pragma once

#include <cerrno>
#include <cstring>
#include <string>

#include "hal/gpio/line_chip.hpp"

namespace nc::hal::gpio {

// What a failed call means for the lines.
inline Opening opening_of(int problem) {
  if (problem == ENOENT || problem == ENODEV || problem == ENXIO) return Opening::kNoChip;
  return problem == EBUSY ? Opening::kTaken : Opening::kRefused;
}

inline std::string of_chip(const LineSetup& line, const std::string& chip) { return "line " + line.text() + " of chip \"" + chip + "\""; }

// `owner`: who has the line; nullptr = not known.
inline Opening taken(const std::string& chip, const LineSetup& line, const char* owner, std::string* error) {
  *error = of_chip(line, chip) + " is taken" + (owner != nullptr ? std::string(" by \"") + owner + "\"" : " by another");
  return Opening::kTaken;
}

// errno says why.
inline Opening without_edges(const std::string& chip, const LineSetup& line, std::string* error) {
  *error = of_chip(line, chip) + " gives no edges: " + std::strerror(errno);
  return Opening::kRefused;
}

inline Opening twice(const std::string& chip, const LineSetup& line, const LineSetup& other, std::string* error) {
  *error = "lines " + line.text() + " and " + other.text() + " of chip \"" + chip + "\" are the same";
  return Opening::kRefused;
}

inline Opening refused(const std::string& chip, const LineSetup& line, int problem, std::string* error) {
  const bool setting = problem == EINVAL || problem == ENOTSUP || problem == ENOTTY;
  *error = of_chip(line, chip) + " cannot be had" + (setting ? " with its direction, bias and drive: " : ": ") + std::strerror(problem);
  return opening_of(problem);
}

// errno says why.
inline bool failed(const std::string& chip, const char* what, std::string* error) {
  *error = "chip \"" + chip + "\" " + what + ": " + std::strerror(errno);
  return false;
}

}  // namespace nc::hal::gpio
