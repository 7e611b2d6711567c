// SPDX-License-Identifier: Apache-2.0
// Watch lists: a client names devices of the ladder, signals and points, and their values come to it again and again without a request, each time all of one scan.
//
// Devices that are watched are bounded, and nobody takes all of them: a user has a part, and so have all users together of whom others may do more (kMostOf).
//
// All lists that are due are served by one look at the scan (runtime/ladder_look.hpp), and they are due at the ticks of one clock, so many clients cost the scan little more than one.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "runtime/runtime.hpp"
#include "runtime/services/call.hpp"
#include "runtime/services/forced_devices.hpp"
#include "runtime/services/named_device.hpp"

namespace nc::rt::services {

// Whose a watch list is.
struct Watcher {
  std::uint64_t session = 0;
  std::string owner;  // the user
  unsigned rank = 0;  // who may do more has a higher one, at most kHighestRank
};

// The values of one list, for its client.
struct Update {
  std::uint64_t session = 0;
  std::uint32_t watch = 0;
  std::string text;  // an object of JSON
};

// To be used by one thread.
class WatchDesk {
 public:
  static constexpr unsigned kLists = 8;       // of one client
  static constexpr unsigned kDevices = 512;   // different ones of all clients
  static constexpr unsigned kOfUser = 256;    // of one user below the highest rank
  static constexpr unsigned kMostOf[kHighestRank + 1] = {320, 384, 448, kDevices};  // of all users together up to each rank, so those above find room
  static constexpr std::int64_t kNever = INT64_MAX;

  explicit WatchDesk(Runtime* runtime) : runtime_(*runtime) {}

  Outcome begin(const Watcher& watcher, const Call& call, std::int64_t now_ns);
  Outcome end(std::uint64_t session, const Call& call);
  void gone(std::uint64_t session);
  // When updates() has something to do.
  std::int64_t next_ns() const;
  // The updates of the lists that are due. Those of a list whose time has passed more than once come once.
  std::vector<Update> updates(std::int64_t now_ns);

 private:
  struct List {
    std::string owner;
    unsigned rank = 0;
    std::vector<std::string> names;
    std::vector<NamedDevice> devices;
    unsigned swaps = 0;  // of the ladder program, when the names were looked up
    std::int64_t interval_ns = 0, next_ns = 0;
  };
  using Key = std::pair<ladder::DeviceType, std::uint32_t>;
  void look_up(List* list) const;
  template <class Counted>
  unsigned devices_with(const List& more, Counted counted) const;
  std::string what_is_full(const List& more) const;
  static std::string text_of(std::uint32_t watch, const List& list, const std::map<Key, std::size_t>& places, const LadderLook& look, const ForcedDevices& forced);

  Runtime& runtime_;
  std::map<std::pair<std::uint64_t, std::uint32_t>, List> lists_;  // by session and number
  std::uint32_t next_watch_ = 1;
};

}  // namespace nc::rt::services
