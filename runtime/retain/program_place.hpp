// SPDX-License-Identifier: Apache-2.0
// A place in a program at which it was stopped.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "runtime/restart/coordinates.hpp"

namespace nc::rt {

// Of one part system whose program was in execution or interrupted.
struct ProgramPlace {
  unsigned system = 0;         // counted from 0
  std::string program;         // name of the file, or "MDI"
  std::uint32_t main_line = 0; // line of the main program that was finished last; 0: none
  std::uint32_t line = 0;      // of the block in execution ...
  std::uint32_t number = 0, depth = 0;  // ... in the program with this O number (0: it has none), called so deep
  std::vector<std::pair<char, double>> at;  // axes and where they were commanded to, machine coordinates
  // What a restart needs (runtime/restart/); a place that was kept by an older version has nothing of it.
  std::uint64_t blocks = 0;    // blocks that were finished
  bool restartable = false;    // the members below are known
  std::uint64_t size = 0;      // bytes of the program ...
  std::string hash = {};       // ... and their SHA-256, "" = not known
  std::vector<std::pair<char, double>> begun = {};  // where the axes stood when the program was begun
  CoordinatesBegun coordinates = {};  // and with what of the coordinate systems
  std::string cause = {};      // "power", "reset" or "alarm"
  bool operator==(const ProgramPlace&) const = default;
};

}  // namespace nc::rt
