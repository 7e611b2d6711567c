// SPDX-License-Identifier: Apache-2.0
// See watch.hpp.
#include "runtime/services/watch.hpp"

#include <algorithm>
#include <chrono>
#include <set>

namespace nc::rt::services {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kTickNs = kShortestInterval * kMs;
constexpr std::int64_t kRestNs = 1000 * kMs;                   // until the next try when no scan runs
constexpr double kDefaultIntervalMs = 200;

std::int64_t tick_from(std::int64_t time_ns) { return (time_ns + kTickNs - 1) / kTickNs * kTickNs; }

}  // namespace

void WatchDesk::look_up(List* list) const {
  const LadderTask& task = *runtime_.ladder();
  list->swaps = task.swaps();
  list->devices.clear();
  for (const std::string& name : list->names) list->devices.push_back(find_named(task, name));
}

// Different devices of those lists that are counted, and of one more.
template <class Counted>
unsigned WatchDesk::devices_with(const List& more, Counted counted) const {
  std::set<Key> all;
  const auto add = [&](const std::vector<NamedDevice>& devices) {
    for (const NamedDevice& named : devices)
      if (named.device) all.insert({named.device->type, named.device->index});
  };
  for (const auto& [key, list] : lists_)
    if (counted(list)) add(list.devices);
  add(more.devices);
  return static_cast<unsigned>(all.size());
}

// "" = there is room for the devices of this list, else whose bound is reached.
std::string WatchDesk::what_is_full(const List& more) const {
  if (more.rank < kHighestRank && devices_with(more, [&](const List& list) { return list.owner == more.owner; }) > kOfUser)
    return "a user watches at most " + std::to_string(kOfUser) + " different devices";
  for (unsigned rank = more.rank; rank <= kHighestRank; ++rank)
    if (devices_with(more, [&](const List& list) { return list.rank <= rank; }) > kMostOf[rank])
      return (rank == kHighestRank ? "all clients together watch at most " : "all clients that may do no more than this one watch at most ") + std::to_string(kMostOf[rank]) + " different devices";
  return "";
}

Outcome WatchDesk::begin(const Watcher& watcher, const Call& call, std::int64_t now_ns) {
  if (runtime_.ladder() == nullptr) return Outcome::refused(Refused::kNotFound, "the machine has no ladder program");
  const auto own = std::count_if(lists_.begin(), lists_.end(), [&](const auto& entry) { return entry.first.first == watcher.session; });
  if (own >= kLists) return Outcome::refused(Refused::kBusy, "a client has at most " + std::to_string(kLists) + " watch lists");
  List list;
  list.owner = watcher.owner;
  list.rank = watcher.rank;
  list.names = call.list(Field::kDevices);
  look_up(&list);
  for (std::size_t i = 0; i < list.names.size(); ++i)
    if (!list.devices[i].device) return Outcome::refused(Refused::kNotFound, "there is no device \"" + list.names[i] + "\"");
  if (const std::string full = what_is_full(list); !full.empty()) return Outcome::refused(Refused::kBusy, full);
  list.interval_ns = static_cast<std::int64_t>(call.value_or(Field::kInterval, kDefaultIntervalMs)) * kMs;
  list.next_ns = tick_from(now_ns);
  Json devices = Json::array();
  for (std::size_t i = 0; i < list.names.size(); ++i) devices.push_back({{"name", list.names[i]}, {"type", list.devices[i].type()}});
  const std::uint32_t number = next_watch_++;
  lists_[{watcher.session, number}] = std::move(list);
  return Outcome::with({{"watch", number}, {"devices", std::move(devices)}});
}

Outcome WatchDesk::end(std::uint64_t session, const Call& call) {
  const auto number = static_cast<std::uint32_t>(call.value(Field::kWatch));
  if (lists_.erase({session, number}) == 0) return Outcome::refused(Refused::kNotFound, "this client has no watch list " + std::to_string(number));
  return Outcome::done();
}

void WatchDesk::gone(std::uint64_t session) {
  std::erase_if(lists_, [&](const auto& entry) { return entry.first.first == session; });
}

std::int64_t WatchDesk::next_ns() const {
  std::int64_t next = kNever;
  for (const auto& [key, list] : lists_) next = std::min(next, tick_from(list.next_ns));
  return next;
}

std::string WatchDesk::text_of(std::uint32_t watch, const List& list, const std::map<Key, std::size_t>& places, const LadderLook& look, const ForcedDevices& forced) {
  Json values = Json::array();
  for (const NamedDevice& named : list.devices) {
    if (!named.device) values.push_back(nullptr);
    else values.push_back(named.part_of(look.values()[places.at({named.device->type, named.device->index})]));
  }
  Json update{{"watch", watch}, {"scan", look.scan()}, {"values", std::move(values)}};
  for (std::size_t i = 0; i < list.devices.size(); ++i)
    if (forced.has(list.devices[i])) update["forced"].push_back(i);
  return update.dump();
}

std::vector<Update> WatchDesk::updates(std::int64_t now_ns) {
  std::vector<Update> updates;
  std::vector<std::pair<const std::pair<std::uint64_t, std::uint32_t>*, List*>> due;
  std::map<Key, std::size_t> places;
  std::vector<LadderLook::Source> sources;
  for (auto& [key, list] : lists_) {
    if (tick_from(list.next_ns) > now_ns) continue;
    if (list.swaps != runtime_.ladder()->swaps()) look_up(&list);
    due.emplace_back(&key, &list);
    for (const NamedDevice& named : list.devices)
      if (named.device && places.emplace(Key{named.device->type, named.device->index}, sources.size()).second) sources.push_back({named.device->type, named.device->index});
  }
  if (due.empty()) return updates;
  LadderLook& look = runtime_.ladder()->look();
  const bool seen = look.take(std::move(sources), 0, kScanPatience);
  // With a long period of the scan the look has taken a while. The next one is behind it, so that other work of this thread has its turn.
  const std::int64_t done_ns = std::max(now_ns, RealClock().now_ns());
  const ForcedDevices forced(runtime_);
  for (const auto& [key, list] : due) {
    list->next_ns += list->interval_ns;
    if (list->next_ns <= done_ns) list->next_ns = done_ns + list->interval_ns;
    if (seen) updates.push_back({key->first, key->second, text_of(key->second, *list, places, look, forced)});
    else list->next_ns = done_ns + kRestNs;
  }
  return updates;
}

}  // namespace nc::rt::services
