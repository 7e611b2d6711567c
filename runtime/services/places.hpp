// SPDX-License-Identifier: Apache-2.0
// Who gives up a place when all are taken, so that nobody can keep others out by holding places.
//
// A newcomer of a higher rank gets the place of somebody with a lower one. Among equals it gets one of an owner who keeps at least one place more than the newcomer's
// owner even then: so places go from those who have many to those who have few, never back, and an owner without any finds one as long as there are not as many
// owners as places. Who gives one up is, among those of the lowest rank, the owner with the most places, and of those the one that has been silent the longest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace nc::rt::services {

struct Place {
  std::string owner;
  unsigned rank = 0;
  std::int64_t heard_ns = 0;  // when its client was heard last, or has read something
  bool kept = false;          // it is never taken away, as that of the client with control
};

// The place for a newcomer, as an index; none = nobody has to make room for it. Where `taken` has only some of the places, these are the ones that may be given up.
std::optional<std::size_t> place_to_give_up(std::span<const Place> taken, const std::string& owner, unsigned rank);

}  // namespace nc::rt::services
