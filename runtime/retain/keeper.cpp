// SPDX-License-Identifier: Apache-2.0
// Retained data over a restart. See keeper.hpp.
#include "runtime/retain/keeper.hpp"

#include <chrono>
#include <cstdio>

namespace nc::rt {
namespace {

constexpr unsigned kLookMs = 5, kHurryMs = 1;  // between two looks at whether a copy is there

}  // namespace

void RetainKeeper::add(unsigned number, std::unique_ptr<RetainedData> data, const std::string& path) {
  auto entry = std::make_unique<Entry>();
  entry->number = number;
  entry->data = std::move(data);
  entry->store = std::make_unique<RetainStore>(path);
  entries_.push_back(std::move(entry));
}

void RetainKeeper::tell(Entry* entry, RetainTrouble what, const std::string& why, std::vector<std::string>* warnings) {
  {
    const std::lock_guard lock(mutex_);
    entry->trouble = why;
  }
  if (entry->data->is_vital()) trouble_(retain_detail(entry->number, what), true);
  if (warnings != nullptr) warnings->push_back("retained data: " + why);
  else std::fprintf(stderr, "warning: retained data: %s\n", why.c_str());
}

std::string RetainKeeper::trouble(unsigned number) const {
  const std::lock_guard lock(mutex_);
  for (const auto& entry : entries_)
    if (entry->number == number) return entry->trouble;
  return "";
}

void RetainKeeper::restore(Entry* entry, std::vector<std::string>* warnings) {
  const std::string name = entry->data->name(), lost = name + " are lost and " + entry->data->start() + ": ";
  std::string bytes, error;
  entry->usable = entry->store->lock(&error);
  if (!entry->usable) return tell(entry, RetainTrouble::kNotKept, name + " are not kept: " + error, warnings);
  const RetainStore::Loaded loaded = entry->store->load(&bytes, &error);
  entry->unseen = loaded == RetainStore::Loaded::kDamaged || loaded == RetainStore::Loaded::kOlder;
  if (loaded == RetainStore::Loaded::kDamaged) {
    tell(entry, RetainTrouble::kLost, lost + error, warnings);
  } else if (loaded != RetainStore::Loaded::kNothing) {
    const bool sense = entry->data->restore(bytes);
    entry->unseen |= !sense;
    if (!sense)
      tell(entry, RetainTrouble::kLost, lost + entry->store->path() + entry->data->why_refused(bytes), warnings);
    else if (loaded == RetainStore::Loaded::kOlder)
      tell(entry, RetainTrouble::kOlder, name + " are those of the last time but one: " + error, warnings);
  }
  if (entry->unseen && !entry->data->is_vital()) {
    entry->unseen = false;
    entry->store->set_aside();
  }
  if (entry->unseen) return;
  for (const std::string& remark : entry->data->remarks()) warnings->push_back("retained data: " + remark);
  entry->saved = entry->data->now();
  entry->failed = !entry->store->save(entry->saved, &error);  // shows at the start whether writing works
  if (entry->failed) tell(entry, RetainTrouble::kUnwritable, name + " cannot be written: " + error, warnings);
}

void RetainKeeper::restore(std::vector<std::string>* warnings) {
  for (const auto& entry : entries_) restore(entry.get(), warnings);
}

bool RetainKeeper::start(std::string* error) {
  bool any = false;
  for (const auto& entry : entries_) any |= entry->usable;
  if (!any || running_) return true;
  stopping_ = false;
  running_ = thread_.start([this] { run(); }, error);
  return running_;
}

void RetainKeeper::stop() {
  if (!running_) return;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  thread_.join();
  running_ = false;
  for (const auto& entry : entries_)
    if (entry->usable && may_save(entry.get())) save(entry.get(), entry->data->now());
}

bool RetainKeeper::pause_ms(unsigned time) {
  std::unique_lock lock(mutex_);
  return !wake_.wait_for(lock, std::chrono::milliseconds(time), [this] { return stopping_; });
}

bool RetainKeeper::wait_for_turn() {
  std::unique_lock lock(mutex_);
  wake_.wait_for(lock, std::chrono::milliseconds(every_ms_), [this] { return stopping_ || soon_ || request_ != answered_; });
  return !stopping_;
}

void RetainKeeper::wake() {
  if (!running_) return;
  {
    const std::lock_guard lock(mutex_);
    soon_ = true;
  }
  wake_.notify_all();
}

void RetainKeeper::hurry(std::uint32_t request) {
  if (!running_) return answer(request);
  {
    const std::lock_guard lock(mutex_);
    request_ = request;
  }
  wake_.notify_all();
}

// A copy that was asked for before a request may be older than it. So a request that comes in the middle of a round is answered by the next one.
void RetainKeeper::run() {
  while (wait_for_turn()) {
    std::uint32_t request = 0;
    bool hurried = false;
    {
      const std::lock_guard lock(mutex_);
      request = request_;
      hurried = request_ != answered_;
      soon_ = false;
    }
    if (!save_all()) return;
    if (!hurried) continue;
    {
      const std::lock_guard lock(mutex_);
      answered_ = request;
    }
    answer(request);
  }
}

bool RetainKeeper::save_all() {
  std::string bytes;
  for (const auto& entry : entries_) {
    if (!entry->usable || !may_save(entry.get())) continue;
    entry->data->want();
    while (!entry->data->take(&bytes)) {
      bool hurried = false;
      {
        const std::lock_guard lock(mutex_);
        hurried = request_ != answered_;
      }
      if (!pause_ms(hurried ? kHurryMs : kLookMs)) return false;
    }
    save(entry.get(), bytes);
  }
  return true;
}

void RetainKeeper::answer(std::uint32_t request) {
  if (!finished_) return;
  bool all = true;
  for (const auto& entry : entries_) all &= !entry->data->is_vital() || (entry->usable && !entry->unseen && !entry->failed);
  finished_(request, entries_.empty() ? SaveResult::kNothingKept : all ? SaveResult::kSaved : SaveResult::kNotSaved);
}

// After a loss nothing is written until an operator has acknowledged it: otherwise the next control would start as if nothing had happened.
bool RetainKeeper::may_save(Entry* entry) {
  if (!entry->unseen) return true;
  if (!seen_()) return false;
  entry->unseen = false;
  entry->saved.clear();
  entry->store->set_aside();
  return true;
}

// Data that could not be written are written again each time. A failure is reported once, and again only after a write has succeeded in between.
void RetainKeeper::save(Entry* entry, const std::string& bytes) {
  if (!entry->failed && bytes == entry->saved) return;
  std::string error;
  if (entry->store->save(bytes, &error)) {
    entry->saved = bytes;
    if (entry->failed && entry->data->is_vital()) trouble_(retain_detail(entry->number, RetainTrouble::kUnwritable), false);
    entry->failed = false;
    return;
  }
  if (!entry->failed)
    tell(entry, RetainTrouble::kUnwritable, std::string(entry->data->name()) + " cannot be written: " + error, nullptr);
  entry->failed = true;
}

}  // namespace nc::rt
