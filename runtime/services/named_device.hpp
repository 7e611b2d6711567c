// SPDX-License-Identifier: Apache-2.0
// A device as the services name it: by a name that the ladder program may use, or a bit of one: "D0.5".
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/ladder_task.hpp"

namespace nc::rt::services {

struct NamedDevice {
  std::optional<ladder::Device> device = {};  // nothing = there is none
  int bit = -1;                               // -1 = the whole device

  std::int32_t part_of(std::int32_t value) const { return bit == -1 ? value : static_cast<std::int32_t>(static_cast<std::uint32_t>(value) >> bit & 1u); }
  const char* type() const { return bit == -1 ? ladder::type_name(device->type) : "bit"; }
};

NamedDevice find_named(const LadderTask& task, const std::string& name);

}  // namespace nc::rt::services
