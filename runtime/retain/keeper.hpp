// SPDX-License-Identifier: Apache-2.0
// Keeps the retained devices of the ladder program over a restart: reads them before the first scan, looks at
// them once a second and writes them when they have changed, and once more behind the last scan. An ordinary
// thread; the scan leaves a copy when it is asked for one.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

#include "runtime/ladder_task.hpp"
#include "runtime/retain/store.hpp"
#include "runtime/rt_thread.hpp"

namespace nc::rt {

class RetainKeeper {
 public:
  RetainKeeper(LadderTask* task, const std::string& path) : task_(*task), store_(path) {}
  ~RetainKeeper() { stop(); }

  // Before the first scan. What is damaged or cannot be written is a sentence in *warnings: the machine runs
  // all the same, with devices that are 0.
  void restore(std::vector<std::string>* warnings);
  // The thread. False with a sentence in *error.
  bool start(std::string* error);
  // Behind the last scan.
  void stop();

 private:
  void run();
  bool pause_ms(int time);  // false: it ends
  void save(const std::vector<RetainedRow>& rows);

  LadderTask& task_;
  RetainStore store_;
  bool usable_ = false;
  std::vector<RetainedRow> saved_;
  bool failed_ = false;  // said once
  RtThread thread_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool running_ = false, stopping_ = false;
};

}  // namespace nc::rt
