// SPDX-License-Identifier: Apache-2.0
// See places.hpp.
#include "runtime/services/places.hpp"

#include <algorithm>
#include <tuple>

namespace nc::rt::services {

std::optional<std::size_t> place_to_give_up(std::span<const Place> taken, const std::string& owner, unsigned rank) {
  const auto places_of = [&](const std::string& who) { return std::count_if(taken.begin(), taken.end(), [&](const Place& place) { return place.owner == who; }); };
  const auto own = places_of(owner);
  std::optional<std::size_t> found;
  std::tuple<unsigned, std::ptrdiff_t, std::int64_t> least{};  // rank, places of its owner (more is less), when it was heard
  for (std::size_t i = 0; i < taken.size(); ++i) {
    const Place& place = taken[i];
    const auto has = places_of(place.owner);
    if (place.kept || place.rank > rank || (place.rank == rank && has < own + 2)) continue;
    const std::tuple candidate(place.rank, -has, place.heard_ns);
    if (found && candidate >= least) continue;
    found = i;
    least = candidate;
  }
  return found;
}

}  // namespace nc::rt::services
