// SPDX-License-Identifier: Apache-2.0
// The level of an input over time, from edges with their times. It debounces: a new level counts when it has stood for the time of the debounce, and it counts
// from the edge on with which the line first left the old level. A shorter pulse is none.
#pragma once

#include <cstdint>

namespace nc::hal::gpio {

class EdgeFilter {
 public:
  // A level that counts now, and the time at which the line first had it.
  struct Change {
    bool level = false;
    std::int64_t time_ns = 0;
  };

  explicit EdgeFilter(std::int64_t debounce_ns = 0) : debounce_ns_(debounce_ns) {}

  // The first level counts at once, because there is no earlier one.
  void begin(bool level, std::int64_t time_ns) {
    shown_ = raw_ = level;
    since_ns_ = time_ns;
    leaves_ = false;
  }
  bool shown() const { return shown_; }
  bool raw() const { return raw_; }

  // An edge to `level`, not earlier than the last one. False when the line had this level already: an edge between the two was lost. A level that has stood
  // until here is taken by settle() first.
  bool edge(bool level, std::int64_t time_ns) {
    const bool new_level = level != raw_;
    raw_ = level;
    since_ns_ = time_ns;
    if (!leaves_ && raw_ != shown_) {
      leaves_ = true;
      left_ns_ = time_ns;
    }
    return new_level;
  }

  // True when a new level counts, now that the line has had its last level until `time_ns`.
  bool settle(std::int64_t time_ns, Change* change) {
    if (!leaves_ || time_ns - since_ns_ < debounce_ns_) return false;
    leaves_ = false;
    if (raw_ == shown_) return false;
    shown_ = raw_;
    *change = {shown_, left_ns_};
    return true;
  }

 private:
  std::int64_t debounce_ns_;
  bool shown_ = false, raw_ = false;
  bool leaves_ = false;         // the line has left the level that counts, at left_ns_, and has not yet stood at either level for long enough
  std::int64_t since_ns_ = 0;   // time of the last edge
  std::int64_t left_ns_ = 0;
};

}  // namespace nc::hal::gpio
