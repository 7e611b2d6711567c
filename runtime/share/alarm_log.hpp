// SPDX-License-Identifier: Apache-2.0
// Makes occurrences from the list of active alarms of each snapshot. An occurrence gets a number when the alarm comes and a time
// when it goes. The last 256 occurrences are kept; operator messages are among them.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/alarms.hpp"
#include "runtime/share/layout.hpp"

namespace nc::rt::share {

class AlarmLog {
 public:
  // Supplies the texts of an alarm. False = they are not known yet, because they come from the feeder; then it is asked again in the next update.
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

  // An alarm whose texts have not come within this time is shown without them.
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
