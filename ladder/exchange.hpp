// SPDX-License-Identifier: Apache-2.0
// A program takes the place of another one between two scans, with the state of its devices.
//
// Both are programs of one machine: they have the same devices at the same places, so every device, timer and counter keeps its value by its name. What an instruction remembers of
// its own, as an edge does, is carried over when the other program has the same instruction under the same condition; otherwise it begins anew: no edge is reported by it
// in its first scan, so nothing happens because of the exchange.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ladder/ladder.hpp"

namespace nc::ladder {

class Exchange {
 public:
  // False with a sentence in *reason when the state of `from` would mean something else in `to`.
  bool prepare(const Program& from, const Program& to, std::string* reason);

  // Makes `to`, which Engine::make_image() of the new program has made, go on from `from`, the image of the other one. NC_RT.
  void carry(const DeviceImage& from, DeviceImage* to) const noexcept;

  // Devices of the table that the program `from` writes and the program `to` does not.
  const std::vector<Device>& left() const { return left_; }

 private:
  struct Pair {
    std::uint32_t from, to;
  };
  std::uint32_t bits_ = 0, words_ = 0;  // how many both have
  std::vector<Pair> known_;
  std::vector<std::uint32_t> unknown_;  // coils of counters of which the new program cannot say what it has seen
  std::vector<Device> left_;
};

}  // namespace nc::ladder
