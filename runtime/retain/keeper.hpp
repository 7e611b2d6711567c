// SPDX-License-Identifier: Apache-2.0
// Keeps retained data over a restart: reads them before the first scan, looks at them now and then and writes them
// when they have changed, and once more behind the last scan. An ordinary thread; scan and feeder leave a copy when
// they are asked for one.
//
// What is lost or cannot be written is an alarm, not only a line of text: a machine that has forgotten which tool is
// in the spindle must not start as if nothing had happened.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "runtime/alarms.hpp"
#include "runtime/retain/retained_data.hpp"
#include "runtime/retain/store.hpp"
#include "runtime/rt_thread.hpp"

namespace nc::rt {

class RetainKeeper {
 public:
  // Takes retain_detail() of what has gone wrong, or is right again; called before the first scan and in the keeper's thread.
  using Trouble = std::function<void(unsigned detail, bool begins)>;

  // Whether what was told to be lost has been acknowledged. Any thread.
  using Seen = std::function<bool()>;

  RetainKeeper(unsigned every_ms, Trouble trouble, Seen seen)
      : every_ms_(every_ms), trouble_(std::move(trouble)), seen_(std::move(seen)) {}
  ~RetainKeeper() { stop(); }

  // `number`: of the data in alarms.
  void add(unsigned number, std::unique_ptr<RetainedData> data, const std::string& path);
  bool empty() const { return entries_.empty(); }

  // Before the first scan. What is damaged or cannot be written is told, and a sentence in *warnings: the control
  // comes up all the same, with data as at its first start.
  void restore(std::vector<std::string>* warnings);
  // The thread. False with a sentence in *error.
  bool start(std::string* error);
  // Behind the last scan.
  void stop();
  // What was wrong with these data last, "" = nothing. Any thread.
  std::string trouble(unsigned number) const;

 private:
  struct Entry {
    unsigned number = 0;
    std::unique_ptr<RetainedData> data;
    std::unique_ptr<RetainStore> store;
    bool usable = false;
    bool failed = false;  // the last write; told once
    bool unseen = false;  // a loss that nobody has acknowledged: nothing is written, so that the next start tells it again
    std::string saved, trouble;
  };
  void restore(Entry* entry, std::vector<std::string>* warnings);
  void run();
  bool pause_ms(unsigned time);  // false: it ends
  bool may_save(Entry* entry);
  void save(Entry* entry, const std::string& bytes);
  void tell(Entry* entry, RetainTrouble what, const std::string& why, std::vector<std::string>* warnings);

  const unsigned every_ms_;
  const Trouble trouble_;
  const Seen seen_;
  std::vector<std::unique_ptr<Entry>> entries_;
  RtThread thread_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool running_ = false, stopping_ = false;
};

}  // namespace nc::rt
