// SPDX-License-Identifier: Apache-2.0
// From the list of active alarms of each snapshot to occurrences: each gets a number when it comes and a time
// when it goes; the last 256 are kept, with the operator messages among them.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/alarms.hpp"
#include "runtime/share/layout.hpp"

namespace nc::rt::share {

class AlarmLog {
 public:
  // Texts of an alarm; false = not known yet (they come from the feeder): asked again the next time.
  class Describer {
   public:
    virtual ~Describer() = default;
    virtual bool describe(const ActiveAlarm& alarm, Entry* entry) = 0;
  };

  // True when something came or went.
  bool update(const AlarmList& alarms, Describer* describer, std::int64_t now_ns);
  void add_message(std::string_view text, unsigned system, std::int64_t now_ns);

  const std::vector<Entry>& active() const { return active_entries_; }
  const HistoryBlock& history() const { return history_; }

  // An alarm is shown without its texts when they have not come by then.
  static constexpr std::int64_t kWaitForTextNs = 200'000'000;

 private:
  struct Active {
    ActiveAlarm alarm;
    std::int64_t since_ns = 0;
    std::uint64_t sequence = 0;  // 0 = not shown yet
  };
  Entry* entry_of(std::uint64_t sequence);
  std::uint64_t append(Entry entry);

  std::vector<Active> active_;
  std::vector<Entry> active_entries_;
  HistoryBlock history_{};
};

}  // namespace nc::rt::share
