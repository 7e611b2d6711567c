// SPDX-License-Identifier: Apache-2.0
// See history.hpp.
#include "runtime/services/history.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "runtime/clock.hpp"
#include "runtime/services/restart.hpp"
#include "runtime/services/service_table.hpp"
#include "runtime/services/shown.hpp"
#include "runtime/share/text.hpp"

namespace nc::rt::services {
namespace {

using history::Entry;
using history::EntryKind;

constexpr std::int64_t kRepeatNs = 1'000'000'000;
constexpr std::size_t kMostNames = 1000;

Outcome nothing() { return Outcome::refused(Refused::kNotFound, "this machine has no history"); }

Json entry_json(const Entry& e) {
  return {{"number", e.id},       {"time_ns", e.time_ns}, {"end_ns", e.end_ns},   {"kind", history::kEntryKindNames[static_cast<unsigned>(e.kind)]},
          {"system", e.system},   {"code", e.code},       {"text", e.text},       {"axis", e.axis},
          {"warning", e.warning}, {"program", e.program}, {"line", e.line},       {"user", e.user},
          {"client", e.client},   {"service", e.service}, {"outcome", e.outcome}, {"seconds", e.seconds}};
}

// For who reads it; nc::rt::number_text() has all digits. It has a name of its own, as sources are joined.
std::string rounded_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

// What a command is about: the members of its request in words.
std::string words_of(const share::Request& r) {
  const std::string system = r.system == share::kEverySystem ? "" : " in part system " + std::to_string(r.system + 1);
  const std::string text(share::text_of(r.text));
  switch (static_cast<share::RequestKind>(r.kind)) {
    case share::RequestKind::kSetMode: return mode_name(r.number);
    case share::RequestKind::kFeedOverride:
    case share::RequestKind::kRapidOverride: return rounded_text(100 * r.value) + " %" + system;
    case share::RequestKind::kSingleBlock:
    case share::RequestKind::kOptionalStop: return (r.number != 0 ? "on" : "off") + system;
    case share::RequestKind::kJog: return "axis " + std::to_string(r.axis + 1) + " at " + rounded_text(r.value) + system;
    case share::RequestKind::kRestartApproach: return "axis " + std::to_string(r.axis + 1) + system;
    case share::RequestKind::kMdi:
    case share::RequestKind::kSelectProgram: return text + system;
    case share::RequestKind::kForce:
    case share::RequestKind::kWriteDevice: return text + " = " + rounded_text(r.value);
    case share::RequestKind::kRestartFind: return restart_words(r) + system;
    case share::RequestKind::kRestartConfirm: return (r.number == kEveryEntry ? "all entries" : "entry " + std::to_string(r.number + 1)) + system;
    case share::RequestKind::kReleaseForce: return text.empty() ? "all devices" : text;
    default: return system.empty() ? "" : system.substr(1);
  }
}

std::string outcome_of(const share::Ack& ack) {
  const std::string text(share::text_of(ack.text));
  switch (static_cast<share::AckState>(ack.state)) {
    case share::AckState::kAccepted: return "accepted";
    case share::AckState::kDone: return "done";
    case share::AckState::kFailed: return "failed: " + text;
    default: return "refused: " + text;
  }
}

}  // namespace

const char* service_of(share::RequestKind kind) {
  for (const ServiceRow& row : service_table())
    if (row.lane == Lane::kCommand && row.command == kind) return row.name;
  return "";
}

Outcome list_history(history::Recorder* history, const Call& call) {
  if (history == nullptr) return nothing();
  history::Filter filter;
  filter.since_ns = static_cast<std::int64_t>(call.value_or(Field::kSince, 0) * 1e9);
  filter.until_ns = static_cast<std::int64_t>(call.value_or(Field::kUntil, 0) * 1e9);
  if (call.has(Field::kEntryKind)) {
    const auto* kind = std::find(std::begin(history::kEntryKindNames), std::end(history::kEntryKindNames), call.words(Field::kEntryKind));
    if (kind == std::end(history::kEntryKindNames)) return Outcome::refused(Refused::kMalformed, "kind must be alarm, message, action, change, run or system");
    filter.kind = static_cast<int>(kind - std::begin(history::kEntryKindNames));
  }
  filter.user = call.words(Field::kUser);
  filter.from = static_cast<std::uint64_t>(call.value_or(Field::kFrom, 0));
  filter.count = static_cast<unsigned>(call.value_or(Field::kCount, kWholePage));
  std::vector<Entry> entries;
  std::uint64_t next = 0;
  std::string error;
  if (!history->list(filter, &entries, &next, &error)) return Outcome::refused(Refused::kFailed, error);
  Json list = Json::array();
  std::size_t bytes = 0;
  for (const Entry& entry : entries) {
    // A reply is bounded; what does not fit comes with the next request.
    Json json = entry_json(entry);
    bytes += json.dump(-1, ' ', false, Json::error_handler_t::replace).size() + 1;
    if (bytes > kMostFrameBytes - 4096) {
      next = entry.id;
      break;
    }
    list.push_back(std::move(json));
  }
  return Outcome::with({{"entries", std::move(list)}, {"missing", history->lost()}, {"next", next}});
}

Outcome list_counters(history::Recorder* history) {
  if (history == nullptr) return nothing();
  std::vector<history::Counter> counters;
  std::string error;
  if (!history->counters(&counters, &error)) return Outcome::refused(Refused::kFailed, error);
  Json list = Json::array();
  for (const history::Counter& counter : counters)
    list.push_back({{"name", counter.name}, {"system", counter.system}, {"number", counter.number}, {"value", counter.value}, {"unit", counter.unit}});
  return Outcome::with({{"counters", std::move(list)}});
}

Outcome list_program_times(history::Recorder* history, const Call& call) {
  if (history == nullptr) return nothing();
  const auto from = static_cast<std::uint64_t>(call.value_or(Field::kFrom, 0));
  std::vector<history::ProgramTimes> programs;
  bool more = false;
  std::string error;
  if (!history->programs(from, static_cast<unsigned>(call.value_or(Field::kCount, kWholePage)), &programs, &more, &error)) return Outcome::refused(Refused::kFailed, error);
  Json list = Json::array();
  for (const history::ProgramTimes& times : programs)
    list.push_back({{"name", times.name},
                    {"runs", times.runs},
                    {"last_s", times.last_s},
                    {"shortest_s", times.shortest_s},
                    {"longest_s", times.longest_s},
                    {"total_s", times.total_s},
                    {"last_ns", times.last_ns}});
  return Outcome::with({{"programs", std::move(list)}, {"next", more ? from + programs.size() : 0}});
}

// ---- what operators do ----

std::string user_of_behalf(const std::string& behalf) { return behalf.substr(0, behalf.find('@')); }

void ActionNotes::came(std::uint64_t writer, uid_t user, const std::string& behalf) {
  const std::lock_guard lock(mutex_);
  users_[writer] = {user, behalf};
}

void ActionNotes::gone(std::uint64_t writer) {
  const std::lock_guard lock(mutex_);
  users_.erase(writer);
}

std::string ActionNotes::name_of(uid_t user) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = names_.find(user);
    if (found != names_.end()) return found->second;
  }
  std::string name = user_name(user);
  const std::lock_guard lock(mutex_);
  if (names_.size() >= kMostNames) names_.clear();
  return names_[user] = std::move(name);
}

void ActionNotes::answered(const share::Request* request, const share::Ack& ack) {
  if (history_ == nullptr || ack.repeated != 0) return;
  const auto kind = static_cast<share::RequestKind>(ack.kind);
  const auto state = static_cast<share::AckState>(ack.state);
  const bool refused = state == share::AckState::kRejected;
  // An answer that comes later is news only when the command has failed.
  if (request == nullptr && state != share::AckState::kFailed) return;
  if (!refused && (kind == share::RequestKind::kTakeControl || kind == share::RequestKind::kReleaseControl)) return;
  Entry entry;
  entry.kind = EntryKind::kAction;
  entry.client = share::text_of(ack.client);
  entry.service = service_of(kind);
  if (request != nullptr) entry.text = words_of(*request);
  entry.outcome = outcome_of(ack);
  if (static_cast<share::Way>(ack.way) == share::Way::kLocal) {
    Actor actor;
    bool known = false;
    {
      const std::lock_guard lock(mutex_);
      const auto found = users_.find(ack.writer);
      known = found != users_.end();
      if (known) actor = found->second;
    }
    if (known) entry.user = actor.behalf.empty() ? name_of(actor.user) : user_of_behalf(actor.behalf);
  }
  if (refused || kind == share::RequestKind::kJog || kind == share::RequestKind::kRestartApproach) {
    const std::int64_t now = RealClock().now_ns();
    const std::lock_guard lock(mutex_);
    if (last_.size() >= kMostNames) last_.clear();
    Last& last = last_[entry.client];
    const bool again = last.entry.service == entry.service && last.entry.text == entry.text && last.entry.outcome == entry.outcome && now - last.seen_ns < kRepeatNs;
    last.seen_ns = now;
    if (again) return;
    last.entry = entry;
  }
  history_->add(std::move(entry));
}

void ActionNotes::changed(const Change& change) {
  if (history_ == nullptr) return;
  Entry entry;
  entry.kind = EntryKind::kChange;
  entry.time_ns = change.time_ns;
  entry.user = change.user;
  entry.client = change.client;
  entry.service = change.service;
  entry.text = change.what + (change.before.empty() && change.after.empty() ? "" : ": " + (change.before.empty() ? "-" : change.before) + " -> " + (change.after.empty() ? "-" : change.after));
  entry.outcome = "done";
  history_->add(std::move(entry));
}

void ActionNotes::denied(uid_t user, const std::string& behalf, const std::string& client, const std::string& service, unsigned more) {
  if (history_ == nullptr) return;
  Entry entry;
  entry.kind = EntryKind::kAction;
  entry.user = behalf.empty() ? name_of(user) : user_of_behalf(behalf);
  entry.client = client;
  entry.service = service;
  entry.text = service.empty() ? "connected without any right" : "";
  entry.outcome = "refused: no right" + (more == 0 ? std::string() : ", and " + std::to_string(more) + " times before it");
  history_->add(std::move(entry));
}

}  // namespace nc::rt::services
