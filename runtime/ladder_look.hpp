// SPDX-License-Identifier: Apache-2.0
// One look at the ladder while it runs: the values of some devices as the program has left them in one scan, and on request the power flow of that scan.
//
// A look belongs alternately to its owner, who prepares it, and to the scan, which fills it in; the scan waits for nobody and takes no memory. A scan without one reads a
// number.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <vector>

#include "ladder/devices.hpp"

namespace nc::rt {

inline constexpr auto kScanPatience = std::chrono::milliseconds(500);  // a service waits so long for a scan that answers it

class LadderLook {
 public:
  struct Source {
    ladder::DeviceType type = ladder::DeviceType::kBit;
    std::uint32_t index = 0;
  };

  // ---- the owner, one thread ----
  // Asks the scan for a look and waits for it. `flow_bytes`: Program::flow_bytes() of the program in execution, 0 = without the power flow. False when no scan has run
  // within `patience`; then the results are those of no scan.
  bool take(std::vector<Source> sources, std::size_t flow_bytes, std::chrono::milliseconds patience);
  const std::vector<std::int32_t>& values() const { return values_; }  // in the order of the sources
  const std::vector<std::uint8_t>& flow() const { return flow_; }
  std::uint64_t scan() const { return scan_; }  // its number

  // ---- the scan, NC_RT ----
  // Where the power flow of this scan is to be noted, null = nobody wants it.
  std::uint8_t* begin() noexcept {
    unsigned wanted = kWanted;
    if (turn_.load(std::memory_order_relaxed) != kWanted || !turn_.compare_exchange_strong(wanted, kTaken, std::memory_order_acquire)) return nullptr;
    return flow_.empty() ? nullptr : flow_.data();
  }
  void end(const ladder::DeviceImage& image, std::uint64_t scan) noexcept {
    if (turn_.load(std::memory_order_relaxed) != kTaken) return;
    for (std::size_t i = 0; i < sources_.size(); ++i) values_[i] = image.value(sources_[i].type, sources_[i].index);
    scan_ = scan;
    turn_.store(kFilled, std::memory_order_release);
  }

 private:
  enum Turn : unsigned { kIdle, kWanted, kTaken, kFilled };
  std::atomic<unsigned> turn_{kIdle};  // kWanted and kTaken: what follows belongs to the scan
  std::vector<Source> sources_;
  std::vector<std::int32_t> values_;
  std::vector<std::uint8_t> flow_;
  std::uint64_t scan_ = 0;
};

}  // namespace nc::rt
