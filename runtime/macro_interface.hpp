// SPDX-License-Identifier: Apache-2.0
// The macro interface image: 4 words in (#1032..#1035), 4 words out (#1132..#1135), and the named points they
// stand for.
//
// A bit variable is one bit of a word (M700 13.5.5, table in macro_interface.cpp), so bits and words cannot
// disagree: there is one image. Inputs are gathered from the points before the NC; an output point is written
// only when a block writes its bit, so what the machine holds stays over a reset and is not touched by
// anything but the program. The outputs begin with what their points have, and a bus that has found another value in its
// partner (on_stop = "hold") goes into them: a program reads what is so.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/config.hpp"

namespace nc::rt {

class MacroInterface {
 public:
  MacroInterface(const MacroMap& map, const hal::PointImage& initial);
  // Points -> words of #1032..#1035. NC_RT.
  void gather(const hal::PointImage& points, std::uint32_t input[NC_WORDS]) const noexcept;
  // Output points that the bus has changed since leave(), into the image; their bits into `found`, true when there is one. NC_RT.
  bool take_over(const hal::PointImage& points, std::uint32_t found[NC_WORDS]) noexcept;
  // Words of #1132..#1135 as one part system gives them -> points of the bits that a block has written in this cycle. NC_RT.
  void distribute(const std::uint32_t output[NC_WORDS], const std::uint32_t written[NC_WORDS], hal::PointImage* points) noexcept;
  // The output points as the bus gets them. NC_RT.
  void leave(const hal::PointImage& points) noexcept;
  // The image of the outputs, all part systems together.
  const std::uint32_t* output() const { return image_; }
  // The bits that have a point.
  void mapped(std::uint32_t outputs[NC_WORDS]) const;

 private:
  struct Entry {
    std::uint8_t word, bit;  // bit 255 = the whole word
    std::uint16_t point;
    std::uint32_t left = 0;  // value that the bus was given
  };
  static std::uint32_t bits(const Entry& entry) noexcept;
  void take(const Entry& entry) noexcept;

  std::vector<Entry> inputs_, outputs_;  // only what is mapped
  std::uint32_t image_[NC_WORDS] = {};
};

}  // namespace nc::rt
