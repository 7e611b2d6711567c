// SPDX-License-Identifier: Apache-2.0
// One entry of the history of the machine, and what the history counts.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace nc::rt::history {

// The numbers stand in files and never change.
enum class EntryKind : std::uint8_t {
  kAlarm = 0,    // an alarm or a warning, from its coming to its going
  kMessage = 1,  // a message of a program to the operator
  kAction = 2,   // a command of somebody, or one that was refused to him
  kChange = 3,   // a table or a program was changed through the services
  kRun = 4,      // a program in execution, from its start to its end
  kSystem = 5    // of the history itself: ncrtd began or ended, the clock was set, entries are missing
};
inline constexpr unsigned kEntryKinds = 6;
inline constexpr const char* kEntryKindNames[kEntryKinds] = {"alarm", "message", "action", "change", "run", "system"};

inline constexpr std::int64_t kEndUnknown = -1;  // ncrtd ended before it

struct Entry {
  std::uint64_t id = 0;         // number, counted up from 1 over all starts
  std::int64_t time_ns = 0;     // time of day, as it was set then
  std::int64_t end_ns = 0;      // alarms, runs: time of day at the end; 0 = not yet; else the same as time_ns
  EntryKind kind = EntryKind::kSystem;
  unsigned system = 0;          // part system from 1, 0 = none
  unsigned line = 0;
  double seconds = 0;           // runs: time in execution
  bool warning = false;
  std::string code, text, axis, program, user, client, service, outcome;
};

struct Counter {
  std::string name;       // on, running, spindle, runs, alarms
  unsigned system = 0;    // part system from 1, 0 = of the whole machine
  unsigned number = 0;    // of the spindle, from 1
  double value = 0;
  const char* unit = "";  // "s", or "" for a number

  // The name in a file.
  std::string key() const {
    std::string text = name;
    if (system != 0) text += " " + std::to_string(system);
    if (number != 0) text += " " + std::to_string(number);
    return text;
  }
};

// The cycle times of a program that came to its end without an alarm.
struct ProgramTimes {
  std::string name;
  std::uint64_t runs = 0;
  double last_s = 0, shortest_s = 0, longest_s = 0, total_s = 0;
  std::int64_t last_ns = 0;  // time of day of its last end
};

}  // namespace nc::rt::history
