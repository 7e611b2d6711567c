// SPDX-License-Identifier: Apache-2.0
// Who has changed what through the services, and when: a file with one line of JSON for each change. It is bounded: a file of kMostBytes becomes PATH.1, which
// replaces the one before. Each line is brought to the disk before the change is answered, so a power cut loses none that was answered.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <deque>
#include <string>

#include "runtime/services/call.hpp"

namespace nc::rt::services {

struct Change {
  std::int64_t time_ns = 0;  // time of day
  std::string user, client, service, what, before, after;
};

// To be used by one thread.
class ChangeLog {
 public:
  // `path`: "" = the changes are only remembered until the end.
  explicit ChangeLog(std::string path) : path_(std::move(path)) {}
  ~ChangeLog();
  ChangeLog(const ChangeLog&) = delete;
  ChangeLog& operator=(const ChangeLog&) = delete;

  // Opens the file and reads the last changes from it. False with a sentence in *error when it cannot be written.
  bool open(std::string* error);
  // False with a sentence in *error when the change could not be written; it is remembered all the same.
  bool add(const Change& change, std::string* error);
  // Entries behind the `from` newest ones, the newest first.
  Json newest(std::uint64_t from, std::uint64_t count) const;

  static constexpr std::size_t kRemembered = 1000;
  static constexpr off_t kMostBytes = 4 << 20;

 private:
  void read_back(const std::string& file);
  bool turn(std::string* error);
  const std::string path_;
  std::deque<Change> changes_;
  int file_ = -1;
};

// The name of a user, or his number.
std::string user_name(uid_t user);

}  // namespace nc::rt::services
