// SPDX-License-Identifier: Apache-2.0
// See store.hpp.
#include "runtime/history/store.hpp"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

#include "runtime/services/system_error.hpp"

namespace nc::rt::history {
namespace {

constexpr int kApplication = 0x6e636869;  // "nchi": tells the file from those of others
constexpr int kVersion = 1;
constexpr std::int64_t kPageBytes = 4096;
constexpr std::uint64_t kSpareBytes = 16u << 20;  // a disk with less counts as full
constexpr std::int64_t kNsPerDay = 86'400'000'000'000;

constexpr const char* kTables =
    "CREATE TABLE entries(id INTEGER PRIMARY KEY, time INTEGER NOT NULL, ended INTEGER NOT NULL, kind INTEGER NOT NULL, system INTEGER NOT NULL, "
    "line INTEGER NOT NULL, seconds REAL NOT NULL, warning INTEGER NOT NULL, code TEXT NOT NULL, words TEXT NOT NULL, axis TEXT NOT NULL, program TEXT NOT NULL, "
    "user TEXT NOT NULL, client TEXT NOT NULL, service TEXT NOT NULL, outcome TEXT NOT NULL);"
    "CREATE INDEX active ON entries(id) WHERE ended = 0;"
    "CREATE TABLE programs(name TEXT PRIMARY KEY, runs INTEGER NOT NULL, last REAL NOT NULL, shortest REAL NOT NULL, longest REAL NOT NULL, total REAL NOT NULL, "
    "time INTEGER NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE counters(name TEXT PRIMARY KEY, value REAL NOT NULL) WITHOUT ROWID;";

constexpr const char* kDropTenth = "DELETE FROM entries WHERE id IN (SELECT id FROM entries ORDER BY id LIMIT (SELECT 1 + count(*) / 10 FROM entries))";

// Texts come from programs, users and files. A row is bounded, so that the number of entries bounds the file.
std::string_view cut(std::string_view text) { return text.substr(0, 1000); }

}  // namespace

// One statement, prepared, with its values in their order.
class Store::Statement {
 public:
  Statement(sqlite3* database, const char* text) { good_ = sqlite3_prepare_v2(database, text, -1, &statement_, nullptr) == SQLITE_OK; }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& add(std::int64_t value) {
    good_ = good_ && sqlite3_bind_int64(statement_, ++place_, value) == SQLITE_OK;
    return *this;
  }
  Statement& add(double value) {
    good_ = good_ && sqlite3_bind_double(statement_, ++place_, std::isfinite(value) ? value : 0) == SQLITE_OK;
    return *this;
  }
  Statement& add(std::string_view value) {
    const std::string_view part = cut(value);
    good_ = good_ && sqlite3_bind_text(statement_, ++place_, part.data(), static_cast<int>(part.size()), SQLITE_TRANSIENT) == SQLITE_OK;
    return *this;
  }
  // True when there is a row; good() is false after a fault.
  bool next() {
    if (!good_) return false;
    const int result = sqlite3_step(statement_);
    good_ = result == SQLITE_ROW || result == SQLITE_DONE;
    return result == SQLITE_ROW;
  }
  bool good() const { return good_; }
  bool done() {
    while (next()) continue;
    return good_;
  }
  std::int64_t whole(int column) { return sqlite3_column_int64(statement_, column); }
  double number(int column) { return sqlite3_column_double(statement_, column); }
  std::string text(int column) {
    const unsigned char* bytes = sqlite3_column_text(statement_, column);
    const int size = sqlite3_column_bytes(statement_, column);
    return bytes == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
  }

 private:
  sqlite3_stmt* statement_ = nullptr;
  int place_ = 0;
  bool good_ = false;
};

bool Store::failed(std::string* error) {
  const int code = database_ == nullptr ? SQLITE_NOMEM : sqlite3_extended_errcode(database_);
  damaged_ = damaged_ || (code & 0xff) == SQLITE_CORRUPT || (code & 0xff) == SQLITE_NOTADB;
  *error = path_ + ": " + ((code & 0xff) == SQLITE_BUSY ? "another process uses it" : database_ == nullptr ? "no memory" : sqlite3_errmsg(database_));
  return false;
}

bool Store::run(const char* text) { return sqlite3_exec(database_, text, nullptr, nullptr, nullptr) == SQLITE_OK; }

bool Store::number_of(const char* text, std::int64_t* value) {
  Statement statement(database_, text);
  const bool there = statement.next();
  if (there) *value = statement.whole(0);
  return there;
}

void Store::close() {
  if (database_ != nullptr) (void)sqlite3_close_v2(database_);
  database_ = nullptr;
}

// Makes the file, which only its user and its group may read, and refuses what is no plain file.
bool Store::prepare_file(std::string* error) {
  if (path_.empty()) return true;
  const int file = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0640);
  struct stat info {};
  const bool plain = file >= 0 && fstat(file, &info) == 0 && S_ISREG(info.st_mode);
  *error = file < 0 ? services::system_error(path_) : path_ + " is no file";
  if (file >= 0) ::close(file);
  return plain;
}

bool Store::read_counters() {
  std::vector<Counter> read;
  Statement statement(database_, "SELECT name, value FROM counters");
  while (statement.next()) {
    Counter& counter = read.emplace_back();
    counter.name = statement.text(0);
    counter.value = statement.number(1);
  }
  if (!read.empty() || statement.good()) counters_ = std::move(read);  // of a damaged table what could be read
  return statement.good();
}

double Store::counter(const std::string& key) const {
  for (const Counter& counter : counters_)
    if (counter.name == key) return std::isfinite(counter.value) && counter.value > 0 ? counter.value : 0;
  return 0;
}

bool Store::make_tables(std::string* error) {
  std::int64_t version = 0, application = 0, tables = 0;
  if (!number_of("PRAGMA user_version", &version) || !number_of("PRAGMA application_id", &application) || !number_of("SELECT count(*) FROM sqlite_schema", &tables))
    return failed(error);
  if (tables == 0 && version == 0 && application == 0) {
    const std::string marks = "BEGIN IMMEDIATE;" + std::string(kTables) + "PRAGMA application_id=" + std::to_string(kApplication) + ";PRAGMA user_version=" + std::to_string(kVersion) + ";COMMIT;";
    return run(marks.c_str()) || failed(error);
  }
  if (application != kApplication) *error = path_ + " is the database of another program, and is left as it is";
  else if (version != kVersion) *error = path_ + " was written by another version of ncrtd, and is left as it is";
  else return true;
  return false;
}

// Renames a damaged file and its log.
bool Store::put_aside(std::string* error, std::string* told) {
  close();
  std::string why = "there are " + std::to_string(kMostAside) + " such files already";
  for (unsigned n = 1; n <= kMostAside; ++n) {
    const std::string aside = path_ + ".damaged-" + std::to_string(n);
    struct stat info {};
    if (lstat(aside.c_str(), &info) == 0) continue;
    if (rename(path_.c_str(), aside.c_str()) != 0) {
      why = services::system_error(aside);
      break;
    }
    (void)rename((path_ + "-wal").c_str(), (aside + "-wal").c_str());  // may be missing
    *told = "the history " + path_ + " is damaged: it was put aside as " + aside + ", and a new one begins" + (counters_.empty() ? "; its counters could not be read" : "");
    return true;
  }
  *error = "the history " + path_ + " is damaged, and cannot be put aside: " + why;
  return false;
}

bool Store::open(std::string* error, std::string* told) {
  close();
  const bool again = damaged_;  // it was found while the file was in use
  if (again && !put_aside(error, told)) return false;
  for (unsigned turn = 0; turn < 2; ++turn) {
    damaged_ = false;
    if (!prepare_file(error)) return false;
    const char* name = path_.empty() ? ":memory:" : path_.c_str();
    bool good = sqlite3_open_v2(name, &database_, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX, nullptr) == SQLITE_OK;
    // Exclusive: no other process writes into it, and no file of shared memory is needed. Full: a transaction is on the disk when its commit returns.
    good = good && run("PRAGMA trusted_schema=OFF;PRAGMA cell_size_check=ON;PRAGMA page_size=4096;PRAGMA locking_mode=EXCLUSIVE;PRAGMA journal_mode=WAL;"
                       "PRAGMA synchronous=FULL;PRAGMA temp_store=MEMORY;PRAGMA wal_autocheckpoint=256;PRAGMA journal_size_limit=4194304");
    const std::string most = "PRAGMA max_page_count=" + std::to_string(limits_.bytes / static_cast<std::uint64_t>(kPageBytes));
    good = (good && run(most.c_str())) || failed(error);
    good = good && make_tables(error);
    if (good) {
      Statement check(database_, "PRAGMA quick_check(1)");
      const bool sound = check.next() && check.text(0) == "ok";
      if (!sound && check.good()) damaged_ = true;
      good = sound || (!damaged_ && failed(error));
    }
    std::int64_t last = 0, began = 0;
    if (database_ != nullptr && (good || damaged_) && counters_.empty()) (void)read_counters();
    if (good) good = number_of("SELECT coalesce(max(id), 0) FROM entries", &last) || failed(error);
    if (good) {
      (void)number_of("SELECT code = 'begin' FROM entries WHERE kind = 5 AND code IN ('begin', 'end') ORDER BY id DESC LIMIT 1", &began);
      last_id_ = std::max(last_id_, static_cast<std::uint64_t>(std::max<std::int64_t>(last, 0)));
      was_cut_off_ = began != 0;
      bool kept = run(("UPDATE entries SET ended = " + std::to_string(kEndUnknown) + " WHERE ended = 0").c_str());
      if (!told->empty())  // the counters of the file that was put aside
        for (const Counter& counter : counters_)
          kept = kept && Statement(database_, "INSERT OR REPLACE INTO counters VALUES(?, ?)").add(counter.key()).add(counter.value).done();
      return kept || failed(error);
    }
    if (!damaged_) break;
    if (turn != 0 || !put_aside(error, told)) break;
  }
  close();
  return false;
}

bool Store::write_entry(const Entry& e) {
  return Statement(database_, "INSERT OR REPLACE INTO entries VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)")
      .add(static_cast<std::int64_t>(e.id))
      .add(e.time_ns)
      .add(e.end_ns)
      .add(static_cast<std::int64_t>(e.kind))
      .add(static_cast<std::int64_t>(e.system))
      .add(static_cast<std::int64_t>(e.line))
      .add(e.seconds)
      .add(static_cast<std::int64_t>(e.warning))
      .add(e.code)
      .add(e.text)
      .add(e.axis)
      .add(e.program)
      .add(e.user)
      .add(e.client)
      .add(e.service)
      .add(e.outcome)
      .done();
}

bool Store::write_run(const ProgramTimes& run) {
  return Statement(database_,
                   "INSERT INTO programs VALUES(?1, 1, ?2, ?2, ?2, ?2, ?3) ON CONFLICT(name) DO UPDATE SET runs = runs + 1, last = ?2, shortest = min(shortest, ?2), "
                   "longest = max(longest, ?2), total = total + ?2, time = ?3")
      .add(run.name)
      .add(run.last_s)
      .add(run.last_ns)
      .done();
}

bool Store::write_all(const Batch& batch) {
  for (const Entry& entry : batch.added)
    if (!write_entry(entry)) return false;
  for (const ProgramTimes& run : batch.runs)
    if (!write_run(run)) return false;
  for (const Counter& counter : batch.counters)
    if (!Statement(database_, "INSERT OR REPLACE INTO counters VALUES(?, ?)").add(counter.key()).add(counter.value).done()) return false;
  return prune(batch.now_ns);
}

// Numbers are given out in their order, and a number that was left out makes the history shorter, not longer.
bool Store::prune(std::int64_t now_ns) {
  std::int64_t newest = 0;
  if (!number_of("SELECT coalesce(max(id), 0) FROM entries", &newest)) return false;
  if (!Statement(database_, "DELETE FROM entries WHERE id <= ?").add(newest - static_cast<std::int64_t>(limits_.entries)).done()) return false;
  std::int64_t pages = 0, unused = 0;
  if (!number_of("PRAGMA page_count", &pages) || !number_of("PRAGMA freelist_count", &unused)) return false;
  if (pages - unused > static_cast<std::int64_t>(limits_.bytes) / kPageBytes * 4 / 5 && !run(kDropTenth)) return false;
  if (now_ns == 0) return true;
  return Statement(database_, "DELETE FROM entries WHERE id IN (SELECT id FROM entries WHERE id <= ? ORDER BY id LIMIT ?) AND time < ?")
             .add(newest - static_cast<std::int64_t>(kAlwaysKept))
             .add(static_cast<std::int64_t>(kMostAged))
             .add(now_ns - static_cast<std::int64_t>(limits_.days) * kNsPerDay)
             .done() &&
         Statement(database_, "DELETE FROM programs WHERE name IN (SELECT name FROM programs ORDER BY time DESC LIMIT -1 OFFSET ?)").add(static_cast<std::int64_t>(kMostPrograms)).done();
}

// The file would become larger than it may: the oldest tenth of the entries goes. False when it is the disk that is full.
bool Store::make_room() {
  struct statvfs disk {};
  if (!path_.empty() && (statvfs(path_.c_str(), &disk) != 0 || disk.f_bavail * disk.f_frsize < kSpareBytes)) return false;
  std::int64_t pages = 0;
  return number_of("PRAGMA page_count", &pages) && pages > static_cast<std::int64_t>(limits_.bytes) / kPageBytes / 2 && run(kDropTenth);
}

bool Store::write(const Batch& batch, std::string* error) {
  if (database_ == nullptr) {
    *error = path_ + " is not open";
    return false;
  }
  for (bool more_room = true;; more_room = false) {
    if (run("BEGIN IMMEDIATE") && write_all(batch) && run("COMMIT")) break;
    const bool full = (sqlite3_errcode(database_) & 0xff) == SQLITE_FULL;
    (void)failed(error);
    if (sqlite3_get_autocommit(database_) == 0) (void)run("ROLLBACK");
    if (full && more_room && make_room()) continue;
    if (damaged_) close();
    return false;
  }
  for (const Entry& entry : batch.added) last_id_ = std::max(last_id_, entry.id);
  if (!batch.counters.empty()) {
    counters_.clear();
    for (const Counter& counter : batch.counters) counters_.push_back({counter.key(), 0, 0, counter.value, ""});
  }
  return true;
}

bool Store::list(const Filter& filter, std::vector<Entry>* entries, std::uint64_t* next, std::string* error) {
  const std::uint64_t from = filter.from;  // the caller may give the same place for both
  *next = 0;
  if (database_ == nullptr) {
    *error = path_ + " is not open";
    return false;
  }
  constexpr std::int64_t kLargest = INT64_MAX;
  Statement statement(database_,
                      "SELECT id, time, ended, kind, system, line, seconds, warning, code, words, axis, program, user, client, service, outcome FROM entries "
                      "WHERE id <= ?1 AND time >= ?2 AND time <= ?3 AND (?4 < 0 OR kind = ?4) AND (?5 = '' OR user = ?5) ORDER BY id DESC LIMIT ?6");
  statement.add(from == 0 ? kLargest : static_cast<std::int64_t>(from))
      .add(filter.since_ns)
      .add(filter.until_ns == 0 ? kLargest : filter.until_ns)
      .add(static_cast<std::int64_t>(filter.kind))
      .add(filter.user)
      .add(static_cast<std::int64_t>(filter.count) + 1);
  while (statement.next()) {
    if (entries->size() == filter.count) {
      *next = static_cast<std::uint64_t>(statement.whole(0));
      continue;
    }
    Entry& e = entries->emplace_back();
    e.id = static_cast<std::uint64_t>(statement.whole(0));
    e.time_ns = statement.whole(1);
    e.end_ns = statement.whole(2);
    e.kind = static_cast<EntryKind>(std::clamp<std::int64_t>(statement.whole(3), 0, kEntryKinds - 1));
    e.system = static_cast<unsigned>(statement.whole(4));
    e.line = static_cast<unsigned>(statement.whole(5));
    e.seconds = statement.number(6);
    e.warning = statement.whole(7) != 0;
    int column = 8;
    for (std::string* text : {&e.code, &e.text, &e.axis, &e.program, &e.user, &e.client, &e.service, &e.outcome}) *text = statement.text(column++);
  }
  return statement.good() || failed(error);
}

bool Store::programs(std::uint64_t from, unsigned count, std::vector<ProgramTimes>* programs, bool* more, std::string* error) {
  *more = false;
  if (database_ == nullptr) {
    *error = path_ + " is not open";
    return false;
  }
  Statement statement(database_, "SELECT name, runs, last, shortest, longest, total, time FROM programs ORDER BY name LIMIT ? OFFSET ?");
  statement.add(static_cast<std::int64_t>(count) + 1).add(static_cast<std::int64_t>(from));
  while (statement.next()) {
    if (programs->size() == count) {
      *more = true;
      continue;
    }
    programs->push_back({statement.text(0), static_cast<std::uint64_t>(statement.whole(1)), statement.number(2), statement.number(3), statement.number(4), statement.number(5),
                         statement.whole(6)});
  }
  return statement.good() || failed(error);
}

}  // namespace nc::rt::history
