// SPDX-License-Identifier: Apache-2.0
// Keeps retained data over a restart. It reads them before the first scan, looks at them at a fixed interval and writes them
// when they have changed, and once more after the last scan. It runs in an ordinary thread and asks scan and feeder for copies
// of the data.
//
// When data are lost or cannot be written, that is an alarm and not only a line of text: a machine that has forgotten which tool is
// in the spindle must not start as if nothing had happened.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "runtime/alarms.hpp"
#include "runtime/power/power_watch.hpp"
#include "runtime/retain/retained_data.hpp"
#include "runtime/retain/store.hpp"
#include "runtime/rt_thread.hpp"

namespace nc::rt {

class RetainKeeper {
 public:
  // Takes retain_detail() of a trouble that begins or ends; called before the first scan and in the keeper's thread.
  using Trouble = std::function<void(unsigned detail, bool begins)>;

  // Returns whether a reported loss has been acknowledged. Any thread.
  using Seen = std::function<bool()>;
  // How hurry() has ended.
  using Finished = std::function<void(std::uint32_t request, SaveResult result)>;

  RetainKeeper(unsigned every_ms, Trouble trouble, Seen seen, Finished finished = nullptr)
      : every_ms_(every_ms), trouble_(std::move(trouble)), seen_(std::move(seen)), finished_(std::move(finished)) {}
  ~RetainKeeper() { stop(); }

  // `number`: the number of these data in alarms (kRetainedData).
  void add(unsigned number, std::unique_ptr<RetainedData> data, const std::string& path);
  bool empty() const { return entries_.empty(); }

  // Before the first scan. Data that are damaged or cannot be written are reported as a trouble and as a sentence in *warnings. The control
  // starts all the same, with damaged data replaced by those of a first start.
  void restore(std::vector<std::string>* warnings);
  // Starts the thread. False with a sentence in *error.
  bool start(std::string* error);
  // Everything is written at once that has changed; `request` is a number that rises. The answer comes in the keeper's thread, or, when there is nothing to
  // keep, from here. Any thread.
  void hurry(std::uint32_t request);
  // The same for what nobody waits for: a change that must not be as late as the interval. Any thread.
  void wake();
  // Ends the thread and writes the data once more; to be called after the last scan.
  void stop();
  // The last trouble with these data as a sentence, "" = none. Any thread.
  std::string trouble(unsigned number) const;

 private:
  struct Entry {
    unsigned number = 0;
    std::unique_ptr<RetainedData> data;
    std::unique_ptr<RetainStore> store;
    bool usable = false;
    bool failed = false;  // the last write failed, which has been reported
    bool unseen = false;  // a loss has not been acknowledged yet: nothing is written, so that the next start reports it again
    std::string saved, trouble;
  };
  void restore(Entry* entry, std::vector<std::string>* warnings);
  void run();
  bool pause_ms(unsigned time);  // false: the thread is to end
  bool wait_for_turn();          // the interval, or until hurry(); false: the thread is to end
  bool save_all();               // false: the thread is to end
  void answer(std::uint32_t request);
  bool may_save(Entry* entry);
  void save(Entry* entry, const std::string& bytes);
  void tell(Entry* entry, RetainTrouble what, const std::string& why, std::vector<std::string>* warnings);

  const unsigned every_ms_;
  const Trouble trouble_;
  const Seen seen_;
  const Finished finished_;
  std::vector<std::unique_ptr<Entry>> entries_;
  RtThread thread_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::uint32_t request_ = 0, answered_ = 0;  // guarded by mutex_
  bool soon_ = false;                         // guarded by mutex_: there is what cannot wait for the interval
  bool running_ = false, stopping_ = false;
};

}  // namespace nc::rt
