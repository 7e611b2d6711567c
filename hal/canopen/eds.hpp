// SPDX-License-Identifier: Apache-2.0
// The electronic data sheet of a drive (CiA 306): which objects it has, how long they are, and whether a PDO can carry them. It is read before
// anything is sent to the drive, so that an impossible mapping is an error in the configuration, with its line.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hal/canopen/bus_map.hpp"

namespace nc::hal::canopen {

struct EdsObject {
  unsigned line = 0;
  unsigned type = 0;  // number of the data type, such as 0007h for UNSIGNED32
  unsigned bits = 0;  // 0 = no fixed length
  std::string access;  // "rw", "rww", "ro" ...
  bool mappable = false;
};

struct EdsError {
  unsigned line = 0;  // 0 = the file as a whole
  std::string text;
};

struct Eds {
  std::map<std::uint32_t, EdsObject> objects;  // index << 8 | sub-index
  std::uint32_t vendor = 0, product = 0;        // from [DeviceInfo]; 0 = not given
  // From [DeviceInfo], too: the first so many PDOs are there without sections of their own (CompactPDO).
  unsigned compact_takes = 0, compact_sends = 0;

  const EdsObject* find(unsigned index, unsigned sub) const {
    const auto entry = objects.find(index << 8 | sub);
    return entry == objects.end() ? nullptr : &entry->second;
  }
};

inline constexpr std::size_t kMostEdsBytes = 4 << 20;

// Reads a data sheet. Returns the errors in the text; when there are none, *eds holds all of it.
std::vector<EdsError> read_eds(std::string_view text, Eds* eds);

// Errors for everything that this control needs of the drive and that the data sheet does not have.
std::vector<EdsError> check_eds(const Eds& eds, const NodeMap& node);

}  // namespace nc::hal::canopen
