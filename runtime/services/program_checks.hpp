// SPDX-License-Identifier: Apache-2.0
// The checks of programs before they may run: which program is checked next, what was found, and whether a cycle start may begin a program. How a
// program is checked is not known here (tools/lib/program_check.hpp).
//
// The checks are made one after the other in a thread of their own that yields to the scan and, most of the time, to the feeder (nice 10). What was found holds for the files that the check has read, as they were then: a change of one of them ends it.
// The program at the head of a part system runs as it was when it was selected, whatever becomes of its own file; what it calls is read again, so a change of that ends
// what was found, too.
#pragma once

#include <sys/stat.h>

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "nc/config.h"
#include "runtime/config.hpp"
#include "runtime/rt_thread.hpp"
#include "runtime/services/call.hpp"
#include "runtime/share/program_table.hpp"
#include "runtime/start_gate.hpp"

namespace nc::rt::services {

// kUnchecked: not yet, or the check has come to no result.
enum class CheckState : std::uint8_t { kUnchecked, kChecking, kPassed, kRefused };
const char* check_state_name(CheckState state);

// What stops a program, or would stop the machine in it.
struct CheckAlarm {
  std::string code, text;  // the code of the family; empty = an axis beyond its limit
  std::string program;     // file of the program store
  std::uint32_t line = 0;
  bool behind = false;     // found without the lines of the alarms before it: it may come of their absence
};

struct CheckReport {
  CheckState state = CheckState::kUnchecked;
  std::string text;                // why, in a sentence
  std::vector<CheckAlarm> alarms;  // the first ones, at most kMostAlarms
  std::uint32_t asks_line = 0;     // the first line whose block asks the machine (an input, a skip signal, the clock); 0 = none
  std::string asks_program;
  double seconds = 0, length = 0;  // estimated; mm
  std::uint64_t blocks = 0;
  struct Axis {
    char name = 0;
    double least = 0, most = 0;  // machine coordinates
  };
  std::vector<Axis> axes;
  std::vector<std::uint32_t> tools;  // as they are called, each once
  struct File {
    std::string path;
    struct stat info {};
  };
  std::vector<File> files;  // that were read; the first one is the program itself. Where it calls others the folders in which they were looked for are among them: a new name may be called
  std::int64_t time_ns = 0;

  static constexpr std::size_t kMostAlarms = 20, kMostTools = 500;
};

struct CheckOrder {
  std::string name, path;
  unsigned system = 0;  // index of the part system in which it would run
  double limit_s = 60;  // processor time
};

// Checks a program; ends soon after *given_up is true. In the thread of the checks.
using CheckRun = std::function<CheckReport(const CheckOrder& order, const std::atomic<bool>& given_up)>;

class ProgramChecks final : public StartGate {
 public:
  // `programs` must outlive it.
  ProgramChecks(const Config& config, const share::ProgramTable* programs, CheckRun run);
  ~ProgramChecks() override { stop(); }
  // After the start of the runtime, and before its end.
  bool start(std::string* error);
  void stop();

  // ---- any thread ----
  // A program of this name has been written. Those that were refused may have missed it, so they are checked again.
  void arrived(const std::string& name);
  // There is no program of this name any more; its check ends.
  void gone(const std::string& name);
  // False when too many wait.
  bool order(const std::string& name, unsigned system, double limit_s);
  CheckState state(const std::string& name, unsigned system) const;
  // Names of the programs that those at the heads call.
  std::vector<std::string> called() const;
  Outcome show(const Call& call) const;
  Outcome again(const Call& call);

  bool may_begin(unsigned system, unsigned file) override;
  Looked look_again() override;
  bool waits(unsigned system) override;
  std::string remark(unsigned system) override;

  static constexpr std::size_t kMostWaiting = 256, kMostKept = 4096;

 private:
  using Key = std::pair<std::string, unsigned>;  // name, part system
  // What the gate has found of the program at the head of a part system.
  struct Head {
    std::weak_ptr<ProgramText> text;
    Key key;
    bool passed = false, waits = false;
    std::vector<CheckReport::File> called;  // with which it has passed, besides its own file
  };
  void work();
  void watch();
  bool enqueue(const CheckOrder& order, bool first);
  bool is_waiting(const Key& key) const;
  void forget_changed(bool all);
  void look_at_heads();
  CheckOrder order_of(const Key& key) const;
  Key key_of(const Call& call) const;
  std::string path_of(const std::string& name) const { return folder_ + "/" + name; }

  const ProgramCheck policy_;
  const double limit_s_;
  const unsigned systems_;
  const std::string folder_;
  const share::ProgramTable& programs_;
  const CheckRun run_;
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable wake_, asked_, looked_;
  std::deque<CheckOrder> waiting_;
  std::map<Key, CheckReport> reports_;
  std::array<Head, NC_MAX_SYSTEMS> head_;
  Key in_work_;
  bool working_ = false, watching_ = false, ask_ = false, stop_ = false;
  std::uint64_t looks_begun_ = 0, looks_ended_ = 0;  // of watch(), at the heads
  std::uint64_t arrivals_ = 0;                       // programs that have been written
  std::atomic<bool> given_up_{false};
  RtThread work_thread_, watch_thread_;
};

}  // namespace nc::rt::services
