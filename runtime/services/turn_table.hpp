// SPDX-License-Identifier: Apache-2.0
// Whose turn it is in a queue that several users fill. Next is the user whose last turn is longest ago, of his clients the one of whom that is true, and of that client the request that came
// first. So a request waits for at most one of each other user and one of each other client of its own user, however many those have in the queue.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace nc::rt::services {

class TurnTable {
 public:
  struct Waiting {
    std::string_view owner;
    std::uint64_t client = 0;
  };
  // The place of the next one of those that wait, which is not empty. It has had its turn then.
  std::size_t take(std::span<const Waiting> waiting);

 private:
  static constexpr std::size_t kMostRemembered = 4096;  // of clients that come and go while the queue is never empty
  std::uint64_t turns_ = 0;
  std::map<std::string, std::uint64_t, std::less<>> owners_;  // the last turn of each
  std::map<std::uint64_t, std::uint64_t> clients_;
};

}  // namespace nc::rt::services
