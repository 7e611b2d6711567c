// SPDX-License-Identifier: Apache-2.0
// See ladder_look.hpp.
#include "runtime/ladder_look.hpp"

#include <thread>
#include <utility>

namespace nc::rt {

bool LadderLook::take(std::vector<Source> sources, std::size_t flow_bytes, std::chrono::milliseconds patience) {
  const unsigned turn = turn_.load(std::memory_order_acquire);
  if (turn == kWanted || turn == kTaken) return false;  // a scan that has begun an earlier look has not ended yet
  sources_ = std::move(sources);
  values_.assign(sources_.size(), 0);
  flow_.assign(flow_bytes, 0);
  turn_.store(kWanted, std::memory_order_release);
  const auto give_up = std::chrono::steady_clock::now() + patience;
  while (turn_.load(std::memory_order_acquire) != kFilled) {
    unsigned wanted = kWanted;
    if (std::chrono::steady_clock::now() > give_up && turn_.compare_exchange_strong(wanted, kIdle)) return false;
    if (wanted == kTaken && std::chrono::steady_clock::now() > give_up + patience) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return true;
}

}  // namespace nc::rt
