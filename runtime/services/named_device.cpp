// SPDX-License-Identifier: Apache-2.0
// See named_device.hpp.
#include "runtime/services/named_device.hpp"

#include <string_view>
#include <utility>

namespace nc::rt::services {

NamedDevice find_named(const LadderTask& task, const std::string& name) {
  if (auto device = task.find_device(name)) return {std::move(device)};
  constexpr std::string_view kBits = "0123456789ABCDEF";
  if (name.size() < 3 || name[name.size() - 2] != '.') return {};
  const std::size_t bit = kBits.find(name.back());
  auto device = bit == std::string_view::npos ? std::nullopt : task.find_device(name.substr(0, name.size() - 2));
  if (!device || device->type == ladder::DeviceType::kBit) return {};
  return {std::move(device), static_cast<int>(bit)};
}

}  // namespace nc::rt::services
