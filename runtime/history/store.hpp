// SPDX-License-Identifier: Apache-2.0
// The file of the history: an SQLite database with a write-ahead log. write() is one transaction that is on the disk when it returns, so a power cut loses what was
// not written yet, and never the file. The file is bounded by the number of entries, by their age and by its size.
//
// A damaged file is renamed to PATH.damaged-N with its log, and a new one begins, with the counters of the old one as far as they can be read. A file of somebody
// else, or of a newer version, is left as it is.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/history/entry.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace nc::rt::history {

struct StoreLimits {
  std::uint64_t entries = 200'000;
  unsigned days = 730;
  std::uint64_t bytes = 256u << 20;
};

// What is written at once.
struct Batch {
  std::vector<Entry> added;        // one whose number is there already replaces it
  std::vector<ProgramTimes> runs;  // each one run of a program: last_s, last_ns
  std::vector<Counter> counters;   // their present values; empty = they are not written
  std::int64_t now_ns = 0;         // time of day: entries that are too old for it go; 0 = none
  bool empty() const { return added.empty() && runs.empty() && counters.empty(); }
};

// Which entries are wanted; what is empty does not matter.
struct Filter {
  std::int64_t since_ns = 0, until_ns = 0;  // time of day; 0 = open
  int kind = -1;                            // EntryKind
  std::string user;
  std::uint64_t from = 0;                   // the newest entry that is wanted, 0 = the newest there is
  unsigned count = 500;
};

// To be used by one thread at a time.
class Store {
 public:
  // `path`: "" = the history is in memory, and ends with the process.
  Store(std::string path, const StoreLimits& limits) : path_(std::move(path)), limits_(limits) {}
  ~Store() { close(); }
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  // False with a sentence in *error. *told gets a sentence when a damaged file was put aside.
  bool open(std::string* error, std::string* told);
  void close();
  bool is_open() const { return database_ != nullptr; }

  // False with a sentence in *error: nothing of it was written. After damage the file is closed; open() puts it aside.
  bool write(const Batch& batch, std::string* error);

  // The newest first. *next: Filter::from for what comes behind them, 0 = there is nothing more.
  bool list(const Filter& filter, std::vector<Entry>* entries, std::uint64_t* next, std::string* error);
  // By name, behind the `from` first ones.
  bool programs(std::uint64_t from, unsigned count, std::vector<ProgramTimes>* programs, bool* more, std::string* error);

  // After open(): the number of the newest entry, and the counters as they were written last.
  std::uint64_t last_id() const { return last_id_; }
  double counter(const std::string& key) const;
  // The last entry of the kind kSystem with a code "begin" or "end" is a "begin": ncrtd has not ended cleanly.
  bool was_cut_off() const { return was_cut_off_; }

  static constexpr unsigned kMostAside = 5;       // damaged files that are kept
  static constexpr unsigned kMostPrograms = 2000; // whose times are kept; the one that ran longest ago goes first
  static constexpr unsigned kAlwaysKept = 1000;   // entries that stay however old they are ...
  static constexpr unsigned kMostAged = 1000;     // ... and that go in one write because of their age, so that a clock that is wrong for a while takes little

 private:
  class Statement;
  bool prepare_file(std::string* error);
  bool make_tables(std::string* error);
  bool write_all(const Batch& batch);
  bool write_entry(const Entry& entry);
  bool write_run(const ProgramTimes& run);
  bool prune(std::int64_t now_ns);
  bool make_room();
  bool run(const char* text);
  bool number_of(const char* text, std::int64_t* value);
  bool read_counters();
  bool put_aside(std::string* error, std::string* told);
  bool failed(std::string* error);

  const std::string path_;
  const StoreLimits limits_;
  sqlite3* database_ = nullptr;
  bool damaged_ = false;
  std::uint64_t last_id_ = 0;
  bool was_cut_off_ = false;
  std::vector<Counter> counters_;  // name: key
};

}  // namespace nc::rt::history
