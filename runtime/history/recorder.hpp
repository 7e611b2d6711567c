// SPDX-License-Identifier: Apache-2.0
// Makes the history: takes what the scan tells (scan_tap.hpp), the messages of the feeder and the actions of operators, and writes them in one ordinary thread, at most
// half a second later. What cannot be written waits in a bounded list; what the list cannot hold is counted, and the history says how much is missing.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "runtime/history/scan_tap.hpp"
#include "runtime/history/store.hpp"
#include "runtime/rt_thread.hpp"
#include "runtime/runtime.hpp"
#include "runtime/share/layout.hpp"
#include "runtime/share/program_table.hpp"

namespace nc::rt::history {

class Recorder {
 public:
  // `path`: "" = the history ends with the process. All must outlive the recorder. Says what the operator should know, such as a damaged file: `say`, in its thread.
  Recorder(Runtime* runtime, const share::ProgramTable* programs, std::string path, const StoreLimits& limits, std::function<void(const std::string&)> say);
  ~Recorder() { stop(); }
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // The tap for the scan, to be given to the runtime before its start.
  ScanTap* tap() { return &tap_; }
  // False with a sentence in *error when there is no thread. A file that cannot be used is said, and tried again later.
  bool start(std::string* error);
  // Writes what is left. After the end of the scan.
  void stop();

  // Any thread; does not wait for the disk. Number, time and end are filled in.
  void add(Entry entry);

  // ---- for the services. False with a sentence in *error ----
  bool list(const Filter& filter, std::vector<Entry>* entries, std::uint64_t* next, std::string* error);
  bool programs(std::uint64_t from, unsigned count, std::vector<ProgramTimes>* programs, bool* more, std::string* error);
  bool counters(std::vector<Counter>* counters, std::string* error);
  // Entries that are missing since the start.
  std::uint64_t lost() const { return lost_.load(std::memory_order_relaxed) + tap_.lost(); }

  static constexpr unsigned kLookMs = 50, kWriteMs = 500;
  static constexpr std::size_t kWaiting = 4096;            // entries of operators, and entries that wait for a disk
  static constexpr std::int64_t kTryNs = 10'000'000'000;   // after a fault of the file
  static constexpr std::int64_t kCountNs = 1'000'000'000, kIdleCountNs = 60'000'000'000;  // counters of a machine that works, and of one that is only on

 private:
  // An alarm that is active, or whose texts are waited for.
  struct Open {
    ActiveAlarm alarm;
    bool written = false;
    Entry entry;
  };
  // The program that is in execution in a part system, or has ended without the feeder having said how.
  struct Run {
    bool active = false, ends = false;
    std::int64_t ended_ns = 0;  // steady clock
    std::uint64_t runs = 0;     // FeederInfo::System::runs when it began
    nc_run_state state = NC_STATE_IDLE;
    Entry entry;
  };
  void work();
  void take();
  void take_state(const ScanEvent& event, std::int64_t wall_ns, std::int64_t steady_ns);
  void clear(const ActiveAlarm& alarm, std::int64_t wall_ns);
  void settle_alarms(std::int64_t wall_ns);
  void settle_runs(std::int64_t steady_ns, bool last);
  void settle(Run* run);
  void take_messages(std::int64_t wall_ns);
  void watch_clock(std::int64_t wall_ns, std::int64_t steady_ns);
  void put(Entry* entry);
  void write(bool last);
  bool open_store();
  void open_first();
  bool trouble(const std::string& why);
  std::vector<Counter> count() const;
  bool working();
  bool lock_soon(std::unique_lock<std::mutex>* lock, std::string* error);
  bool reach(std::unique_lock<std::mutex>* lock, std::string* error);

  Runtime& runtime_;
  const share::ProgramTable& programs_;
  const std::function<void(const std::string&)> say_;
  const std::string path_;
  ScanTap tap_;
  RtThread thread_;
  std::atomic<bool> stop_{false};
  bool started_ = false;
  std::atomic<std::uint64_t> lost_{0};

  std::mutex given_mutex_;
  std::deque<Entry> given_;  // of operators; guarded by given_mutex_

  std::mutex mutex_;  // guards what follows; held while the disk is written, so readers wait for it a bounded time
  Store store_;
  bool opened_ = false;  // once: the numbers go on behind those of the file
  std::string trouble_;  // why nothing is written, "" = it is
  std::int64_t try_ns_ = 0, counted_ns_ = 0, aged_ns_ = 0, offset_ns_ = 0;
  Batch batch_;
  std::uint64_t next_id_ = 1, told_lost_ = 0, messages_ = 0, worked_ = 0;
  std::vector<Open> open_;
  Run runs_[NC_MAX_SYSTEMS];
  FeederInfo info_;
  std::vector<Counter> before_;  // of earlier starts, in the order of count()
  double alarms_ = 0, completed_[NC_MAX_SYSTEMS] = {};
};

}  // namespace nc::rt::history
