// SPDX-License-Identifier: Apache-2.0
// Who has changed what through the services, and when: a file with one line of JSON for each change. It is bounded: a file of kMostBytes becomes PATH.1, which
// replaces the one before. Each line is brought to the disk before the change is answered, so a power cut loses none that was answered as written down. A line for which there is no room
// waits for it, and is written with the next one, when the changes are listed, or at the end.
//
// Remembered are the newest changes, and of the older ones those that somebody still asks for: the last one of each value, which says who has set it, and the newest of each user, which he may
// take back. So nobody wipes what others have changed by changing much. A file that is turned takes the lines of these with it.
//
// A file in which there is something else than lines of changes is kept aside under another name, and the lines that can be read go on in a new one. What a power cut has cut off is no damage.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "runtime/services/call.hpp"
#include "runtime/services/lost_changes.hpp"
#include "runtime/services/table_values.hpp"

namespace nc::rt::services {

// What one request has changed.
struct Change {
  std::uint64_t number = 0;  // counted up from 1, over all starts
  std::int64_t time_ns = 0;  // time of day
  std::string user, client, service, what, before, after;
  std::vector<ValueChange> values = {};  // of tables, for the undo: none for a change of another kind, or one that is too old
  std::uint64_t undoes = 0;      // number of the change that this one has taken back, 0 = none
  std::uint64_t undone_by = 0;   // number of the change that has taken this one back
};

// Whether nothing of it is there any more.
bool is_lost(const Change& change);

// To be used by one thread.
class ChangeLog {
 public:
  // `path`: "" = the changes are only remembered until the end.
  explicit ChangeLog(std::string path) : path_(std::move(path)) {}
  ~ChangeLog();
  ChangeLog(const ChangeLog&) = delete;
  ChangeLog& operator=(const ChangeLog&) = delete;

  // Opens the file and reads the last changes from it. False with a sentence in *error when it cannot be written. *damage gets a sentence when a file was damaged.
  bool open(std::string* error, std::string* damage = nullptr);
  // Gives the change its number. False with a sentence in *error when it could not be written; it is remembered all the same, and its line waits for room.
  bool add(Change change, std::string* error);
  // Writes the lines that wait. False with a sentence in *error when there is still no room for them.
  bool settle(std::string* error);
  // Entries behind the `from` newest ones, the newest first.
  // `of`: only those that have changed this row or value of a table (is_of()), "" = all.
  Json newest(std::uint64_t from, std::uint64_t count, const std::string& of = "") const;

  // The change with this number; null when it is not remembered.
  const Change* find(std::uint64_t number) const;
  // The newest change of the user that can be taken back and has not been, by a service with this right; null = there is none. *lost gets those that stand in front
  // of it and are lost, which nobody has been told of by an undo yet.
  const Change* last_of(const std::string& user, Right right, std::vector<const Change*>* lost = nullptr) const;
  // Who has changed a value last, and when. Null when no change of it is remembered.
  struct Last {
    std::string user;
    std::int64_t time_ns = 0;
    std::string after;
  };
  const Last* last_change_of(const TablePlace& place) const;
  // The places of all changes that are remembered, each of them once.
  std::vector<TablePlace> places() const;
  // Marks what was lost before this start.
  void compare(const ValueOf& value_of);

  static constexpr std::size_t kRemembered = 1000;    // the newest, whatever they are
  static constexpr std::size_t kOfUser = 100;         // of each user that he may take back
  static constexpr std::size_t kMostOlder = 20'000;   // changes that are older than the newest
  static constexpr std::size_t kRememberedValues = 50'000;  // of all changes together; the oldest ones of the user with the most lose theirs
  static constexpr off_t kMostBytes = 4 << 20;
  static constexpr std::size_t kMostOlderBytes = 1 << 20;  // of lines that a new file takes over
  static constexpr std::size_t kLookEvery = 256;
  static constexpr unsigned kDamagedFiles = 5;  // that are kept aside
  static constexpr std::size_t kMostWaiting = 1 << 20;  // bytes of lines that wait for room; the oldest ones go

 private:
  unsigned read_back(const std::string& file);
  bool keep_aside(const std::string& file, std::string* damage);
  void remember(Change change);
  void note_last(const Change& change);
  void forget_older();
  void forget_values();
  void forget(Change* change);
  std::string lines_of_older(std::uint64_t first) const;
  bool open_file(std::string* error);
  bool turn(std::string* error);
  const std::string path_;
  std::deque<Change> changes_;
  std::map<std::string, Last> last_changes_;         // by place_key()
  std::map<std::string, std::uint64_t> forgotten_;   // of each value the number of the newest change that is not remembered any more
  std::size_t look_at_ = kRemembered + kLookEvery;   // number of changes at which older ones are forgotten
  std::uint64_t last_ = 0;   // number of the newest change
  std::uint64_t first_in_file_ = 0;  // number of the first change that came when the file was there
  std::size_t values_ = 0;   // of all changes that are remembered
  std::string waiting_;      // lines that are not in the file yet
  int file_ = -1;
};

// The name of a user, or his number.
std::string user_name(uid_t user);

}  // namespace nc::rt::services
