// SPDX-License-Identifier: Apache-2.0
// See turn_table.hpp.
#include "runtime/services/turn_table.hpp"

#include <functional>
#include <utility>

namespace nc::rt::services {

std::size_t TurnTable::take(std::span<const Waiting> waiting) {
  const auto last_of = [](const auto& table, const auto& key) {
    const auto found = table.find(key);
    return found == table.end() ? std::uint64_t{0} : found->second;
  };
  std::size_t next = 0;
  std::pair<std::uint64_t, std::uint64_t> oldest(UINT64_MAX, UINT64_MAX);
  for (std::size_t i = 0; i < waiting.size(); ++i) {
    const std::pair last(last_of(owners_, waiting[i].owner), last_of(clients_, waiting[i].client));
    if (last >= oldest) continue;
    oldest = last;
    next = i;
  }
  // Where nobody waits behind this one, everybody is new again: what is remembered stays as small as the queue.
  if (waiting.size() == 1 || clients_.size() > kMostRemembered) {
    owners_.clear();
    clients_.clear();
  }
  ++turns_;
  owners_[std::string(waiting[next].owner)] = turns_;
  clients_[waiting[next].client] = turns_;
  return next;
}

}  // namespace nc::rt::services
