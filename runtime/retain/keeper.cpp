// SPDX-License-Identifier: Apache-2.0
// Retained devices over a restart. See keeper.hpp.
#include "runtime/retain/keeper.hpp"

#include <chrono>
#include <cstdio>

namespace nc::rt {
namespace {

constexpr int kEveryMs = 1000;  // what a power cut may cost at most, with the time of the disk
constexpr int kLookMs = 5;

}  // namespace

void RetainKeeper::restore(std::vector<std::string>* warnings) {
  std::string bytes, error;
  usable_ = store_.lock(&error);
  if (!usable_) {
    warnings->push_back("retained devices are not kept: " + error);
    return;
  }
  const RetainStore::Loaded loaded = store_.load(&bytes, &error);
  std::vector<RetainedRow> rows;
  if (loaded == RetainStore::Loaded::kDamaged) {
    warnings->push_back("retained devices are lost and begin with 0: " + error);
  } else if (loaded != RetainStore::Loaded::kNothing) {
    if (loaded == RetainStore::Loaded::kOlder)
      warnings->push_back("retained devices are those of the last time but one: " + error);
    if (decode_rows(bytes, &rows)) task_.restore(rows);
    else warnings->push_back("retained devices are lost and begin with 0: " + store_.path() + " makes no sense");
  }
  saved_ = task_.retained();
  if (store_.save(encode_rows(saved_), &error)) return;  // tells now whether it will work later
  warnings->push_back("retained devices cannot be written: " + error);
}

bool RetainKeeper::start(std::string* error) {
  if (!usable_ || running_) return true;
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
  save(task_.retained());
}

bool RetainKeeper::pause_ms(int time) {
  std::unique_lock lock(mutex_);
  return !wake_.wait_for(lock, std::chrono::milliseconds(time), [this] { return stopping_; });
}

void RetainKeeper::run() {
  std::vector<RetainedRow> rows;
  while (pause_ms(kEveryMs)) {
    task_.want_retained();
    while (!task_.take_retained(&rows))
      if (!pause_ms(kLookMs)) return;
    save(rows);
  }
}

void RetainKeeper::save(const std::vector<RetainedRow>& rows) {
  if (!failed_ && rows == saved_) return;
  std::string error;
  if (store_.save(encode_rows(rows), &error)) {
    saved_ = rows;
    failed_ = false;
    return;
  }
  if (!failed_) std::fprintf(stderr, "warning: retained devices cannot be written: %s\n", error.c_str());
  failed_ = true;
}

}  // namespace nc::rt
