// SPDX-License-Identifier: Apache-2.0
// A program that is to take the place of the one in execution, with everything that the scan needs for that: it copies values and exchanges pointers, and takes no memory.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ladder/exchange.hpp"
#include "ladder/ladder.hpp"

namespace nc::rt {

class LadderSwap {
 public:
  const ladder::Program& program() const { return program_; }
  // Outputs and signals to the NC that the program in execution writes and this one does not: they get the value that they have at power on.
  std::vector<std::string> set_back() const {
    std::vector<std::string> names;
    for (const ladder::Device& device : exchange_.left()) names.push_back(device.name);
    return names;
  }

 private:
  friend class LadderTask;
  struct Start {
    ladder::DeviceType type = ladder::DeviceType::kBit;
    std::uint32_t index = 0;
    std::int32_t value = 0;
    int point = -1;  // of an output, -1 = it is none
  };
  ladder::Program from_, program_;  // the one whose place it is to take, and itself
  ladder::Exchange exchange_;
  std::unique_ptr<ladder::Engine> engine_;
  ladder::DeviceImage image_, fresh_;
  std::vector<Start> starts_;
  std::atomic<bool> taken_{false};
};

}  // namespace nc::rt
