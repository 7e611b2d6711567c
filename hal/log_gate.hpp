// SPDX-License-Identifier: Apache-2.0
// What a bus has to say about one partner, on its way to the log: everything, until it says too much in a minute. Then the lines are counted, and each further minute
// has one line for all of them, until there is a quiet minute. So a loose contact, or a device that is busy at every second request, fills no disk.
#pragma once

#include <cstdint>
#include <string>

namespace nc::hal {

class LogGate {
 public:
  // So many lines a minute go through.
  explicit LogGate(unsigned most) : most_(most) {}

  // True when the line is to be written now.
  bool takes(const std::string& line, std::int64_t now_ns) {
    if (now_ns - since_ns_ >= kMinuteNs && counted_ == 0) begin(now_ns, 0);
    if (said_ < most_) {
      ++said_;
      return true;
    }
    ++counted_;
    newest_ = line;
    return false;
  }

  // Is called as time passes; the line for those that were counted, when its time has come, or nothing.
  std::string due(std::int64_t now_ns) {
    if (counted_ == 0 || now_ns - since_ns_ < kMinuteNs) return {};
    std::string line = rest();
    begin(now_ns, most_);
    return line;
  }
  // That line now, at the end.
  std::string rest() {
    if (counted_ == 0) return {};
    const std::string line = std::to_string(counted_) + " more of these, the last one: " + newest_;
    counted_ = 0;
    return line;
  }

 private:
  static constexpr std::int64_t kMinuteNs = 60'000'000'000;
  void begin(std::int64_t now_ns, unsigned said) {
    since_ns_ = now_ns;
    said_ = said;
  }

  unsigned most_, said_ = 0, counted_ = 0;
  std::int64_t since_ns_ = 0;
  std::string newest_;
};

}  // namespace nc::hal
