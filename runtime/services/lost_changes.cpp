// SPDX-License-Identifier: Apache-2.0
// See lost_changes.hpp.
#include "runtime/services/lost_changes.hpp"

#include <algorithm>
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

// Whether nothing that is in force has followed on the same value. What was done behind a change has counted on it.
bool is_last_in_force(const History& history, const ValueChange* value) {
  for (std::size_t i = history.size(); i-- > 0 && history[i] != value;)
    if (!history[i]->lost) return false;
  return true;
}

// What an undo has taken back is there again where the undo is lost; where it is not, it stays taken back, and is no part of the change any more.
void forget_lost_undo(const Change& undo, Change* undone, const std::map<std::string, History>& histories) {
  const auto is_there_again = [&](const ValueChange& value) {
    if (value.lost) return false;
    for (const ValueChange& back : undo.values)
      if (place_key(back.place) == place_key(value.place)) return back.lost && is_last_in_force(histories.at(place_key(back.place)), &back);
    return false;
  };
  if (std::none_of(undone->values.begin(), undone->values.end(), is_there_again)) return;
  undone->undone_by = 0;
  for (ValueChange& value : undone->values) value.lost = !is_there_again(value);
}

}  // namespace

void mark_lost(std::deque<Change>* changes, const ValueOf& value_of) {
  std::map<std::string, History> histories;
  for (Change& change : *changes)
    for (ValueChange& value : change.values)
      if (!value.apart) histories[place_key(value.place)].push_back(&value);
  for (const auto& [key, history] : histories) {
    std::string now;
    if (value_of(history.back()->place, &now)) mark_history(history, std::move(now));
  }
  for (const Change& undo : *changes)
    for (Change& change : *changes)
      if (undo.undoes != 0 && undo.undoes == change.number && change.undone_by == undo.number) forget_lost_undo(undo, &change, histories);
}

}  // namespace nc::rt::services
