// SPDX-License-Identifier: Apache-2.0
// See lost_changes.hpp.
#include "runtime/services/lost_changes.hpp"

#include <map>
#include <vector>

#include "runtime/services/change_log.hpp"

namespace nc::rt::services {
namespace {

using History = std::vector<ValueChange*>;  // of one value, the oldest first

// The newest of the first `count` changes in front of which the value was `now`; `count` when it was never so.
std::size_t begin_of_lost(const History& history, std::size_t count, const std::string& now) {
  for (std::size_t i = count; i-- > 0;)
    if (same_value(history[i]->place, history[i]->before, now)) return i;
  return count;
}

// From the newest one back. What was lost at an earlier start is found in the same way: the change behind it has found another value than it should have left.
void mark_history(const History& history, std::string now) {
  for (std::size_t count = history.size(); count > 0;) {
    const ValueChange& newest = *history[count - 1];
    const std::size_t first = same_value(newest.place, newest.after, now) ? count : begin_of_lost(history, count, now);
    if (first == count) {  // it is in force, or was until a program set something else
      now = newest.before;
      --count;
      continue;
    }
    for (; count > first; --count) history[count - 1]->lost = true;
  }
}

// Undos that nothing has followed on the same values. What was done behind another one has counted on it.
void forget_lost_undos(std::deque<Change>* changes, const std::map<std::string, History>& histories) {
  for (const Change& undo : *changes) {
    if (undo.undoes == 0 || !is_lost(undo)) continue;
    bool last = true;
    for (const ValueChange& value : undo.values) last = last && histories.at(place_key(value.place)).back() == &value;
    for (Change& change : *changes)
      if (last && change.undone_by == undo.number) change.undone_by = 0;
  }
}

}  // namespace

void mark_lost(std::deque<Change>* changes, const ValueOf& value_of) {
  std::map<std::string, History> histories;
  for (Change& change : *changes)
    for (ValueChange& value : change.values) histories[place_key(value.place)].push_back(&value);
  for (const auto& [key, history] : histories) {
    std::string now;
    if (value_of(history.back()->place, &now)) mark_history(history, std::move(now));
  }
  forget_lost_undos(changes, histories);
}

}  // namespace nc::rt::services
