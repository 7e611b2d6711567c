// SPDX-License-Identifier: Apache-2.0
// The macro interface image: 4 words in (#1032..#1035), 4 words out (#1132..#1135), and the named points they
// stand for.
//
// A bit variable is one bit of a word (M700 13.5.5, table in macro_interface.cpp), so bits and words cannot
// disagree: there is one image. Inputs are gathered from the points before the NC; an output point is written
// only when the NC changed its bit, so what the machine holds stays over a reset and is not touched by
// anything but the program.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/config.hpp"

namespace nc::rt {

class MacroInterface {
 public:
  explicit MacroInterface(const MacroMap& map);
  // Points -> words of #1032..#1035. NC_RT.
  void gather(const hal::PointImage& points, std::uint32_t input[NC_WORDS]) const noexcept;
  // Words of #1132..#1135 as one part system gives them -> points of the bits that changed. NC_RT.
  void distribute(unsigned system, const std::uint32_t output[NC_WORDS], hal::PointImage* points) noexcept;
  // The image of the outputs, all part systems together.
  const std::uint32_t* output() const { return image_; }

 private:
  struct Entry {
    std::uint8_t word, bit;  // bit 255 = the whole word
    std::uint16_t point;
  };
  std::vector<Entry> inputs_, outputs_;  // only what is mapped
  std::uint32_t last_[NC_MAX_SYSTEMS][NC_WORDS] = {};
  std::uint32_t image_[NC_WORDS] = {};
};

}  // namespace nc::rt
