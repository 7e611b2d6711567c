// SPDX-License-Identifier: Apache-2.0
// See event_schedule.hpp.
#include "tools/lib/event_schedule.hpp"

#include <algorithm>

namespace nc::tools {
namespace {

bool begins_with(const SetupEvent& event, const nc_item& item, uint32_t main_line) {
  if (event.m) return item.kind == NC_ITEM_ACTION && item.u.action.kind == NC_ACTION_M && item.u.action.value == *event.m;
  if (event.program) return *event.program == item.source.program && *event.line == item.source.line;
  return *event.line == main_line;
}

}  // namespace

EventSchedule::EventSchedule(const Setup& setup) {
  for (const SetupEvent& event : setup.events)
    if (!event.seconds) waiting_.push_back(&event);
}

bool EventSchedule::waits(const SetupEvent& event) const {
  return std::find(waiting_.begin(), waiting_.end(), &event) != waiting_.end();
}

std::vector<const SetupEvent*> EventSchedule::take(const nc_item& item, uint32_t main_line) {
  std::vector<const SetupEvent*> begun;
  for (const SetupEvent* event : waiting_)
    if (begins_with(*event, item, main_line)) begun.push_back(event);
  if (!begun.empty())
    std::erase_if(waiting_, [&](const SetupEvent* event) { return std::find(begun.begin(), begun.end(), event) != begun.end(); });
  return begun;
}

// All events of a setup are in one vector, so the order of their addresses is that of the setup.
void EventSchedule::put_back(const SetupEvent* event) {
  waiting_.insert(std::lower_bound(waiting_.begin(), waiting_.end(), event), event);
}

}  // namespace nc::tools
