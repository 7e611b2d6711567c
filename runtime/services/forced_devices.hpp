// SPDX-License-Identifier: Apache-2.0
// Which devices of the ladder are forced now: whoever shows the value of a device says so beside it, because a coil without power that is on has no other reason.
#pragma once

#include <cstdint>
#include <set>
#include <utility>

#include "runtime/runtime.hpp"
#include "runtime/services/named_device.hpp"

namespace nc::rt::services {

class ForcedDevices {
 public:
  explicit ForcedDevices(const Runtime& runtime);
  // A bit of a word is forced with its word.
  bool has(const NamedDevice& named) const { return named.device && devices_.count(key_of(*named.device)) != 0; }

 private:
  using Key = std::pair<bool, std::uint32_t>;  // whether it is a bit, and its place
  static Key key_of(const ladder::Device& device) { return {device.type == ladder::DeviceType::kBit, device.index}; }
  std::set<Key> devices_;
};

}  // namespace nc::rt::services
