// SPDX-License-Identifier: Apache-2.0
// The macro interface image: 4 words in (#1032..#1035), 4 words out (#1132..#1135), and the named points they
// stand for.
//
// A bit variable is one bit of a word (M700 13.5.5, table in macro_interface.cpp). Bits and words share one image, so they cannot
// disagree. Inputs are gathered from the points before the NC runs. An output point is written
// only when a block writes its bit, so its value stays over a reset and nothing but the program
// changes it. The outputs begin with the values of their points. When a bus finds another value in its device (on_stop = "hold"), the image
// takes that value over, so that a program reads the value that the machine really has.
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
  // Takes output points that the bus has changed since leave() into the image. `found` gets their bits; true when there is one. NC_RT.
  bool take_over(const hal::PointImage& points, std::uint32_t found[NC_WORDS]) noexcept;
  // `output`: words #1132 to #1135 of one part system; `written`: the bits that a block has written in this cycle. They go into the image and into their
  // points. NC_RT.
  void distribute(const std::uint32_t output[NC_WORDS], const std::uint32_t written[NC_WORDS], hal::PointImage* points) noexcept;
  // Remembers the values of the output points that the bus is given. NC_RT.
  void leave(const hal::PointImage& points) noexcept;
  // The image of the outputs, which all part systems share.
  const std::uint32_t* output() const { return image_; }
  // Sets in `outputs` the bits that are connected with a point.
  void mapped(std::uint32_t outputs[NC_WORDS]) const;

 private:
  struct Entry {
    std::uint8_t word, bit;  // bit = 255: the whole word
    std::uint16_t point;
    std::uint32_t left = 0;  // value of the point when leave() was called last
  };
  static std::uint32_t bits(const Entry& entry) noexcept;
  void take(const Entry& entry) noexcept;

  std::vector<Entry> inputs_, outputs_;  // only numbers that are connected with a point
  std::uint32_t image_[NC_WORDS] = {};
};

}  // namespace nc::rt
