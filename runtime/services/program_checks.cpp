// SPDX-License-Identifier: Apache-2.0
// See program_checks.hpp.
#include "runtime/services/program_checks.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>

#include "runtime/programs/program_text.hpp"
#include "runtime/share/text.hpp"

namespace nc::rt::services {
namespace {

constexpr auto kLookPeriod = std::chrono::milliseconds(50);  // how often the files of the programs that may be started are looked at ...
constexpr unsigned kLooksOfAll = 10;                           // ... and, each so many times, those of all that was found
constexpr auto kPatience = std::chrono::milliseconds(250);     // with the disk, at a start: a feed hold of the same client waits behind it
constexpr int kNiceness = 10;  // below the feeder, which is an ordinary thread, and high enough to come to an end on a busy computer

bool is_unchanged(const CheckReport::File& file) {
  struct stat now {};
  return stat(file.path.c_str(), &now) == 0 && same_content(now, file.info);
}

}  // namespace

const char* check_state_name(CheckState state) {
  constexpr const char* kNames[] = {"unchecked", "checking", "passed", "refused"};
  return kNames[static_cast<unsigned>(state)];
}

ProgramChecks::ProgramChecks(const Config& config, const share::ProgramTable* programs, CheckRun run)
    : policy_(config.services.check), limit_s_(config.services.check_seconds), systems_(config.nc.system_count), folder_(config.programs_folder()), programs_(*programs), run_(std::move(run)) {}

bool ProgramChecks::start(std::string* error) {
  if (!work_thread_.start([this] { work(); }, error) || !watch_thread_.start([this] { watch(); }, error)) return false;
  const std::lock_guard lock(mutex_);
  watching_ = true;
  return true;
}

void ProgramChecks::stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    given_up_ = true;
  }
  wake_.notify_all();
  asked_.notify_all();
  looked_.notify_all();
  work_thread_.join();
  watch_thread_.join();
}

// ---- the threads ----

void ProgramChecks::work() {
  (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNiceness);
  std::unique_lock lock(mutex_);
  while (!stop_) {
    if (waiting_.empty()) {
      wake_.wait(lock);
      continue;
    }
    const CheckOrder order = waiting_.front();
    waiting_.pop_front();
    in_work_ = {order.name, order.system};
    working_ = true;
    given_up_ = false;
    const std::uint64_t arrived_before = arrivals_;
    lock.unlock();
    CheckReport report = run_(order, given_up_);
    report.time_ns = share::wall_ns();
    bool is_old = !std::all_of(report.files.begin(), report.files.end(), is_unchanged);
    lock.lock();
    working_ = false;
    if (given_up_) continue;
    // What has been read meanwhile is no longer what would run, and one that was refused may have missed what has come since: nobody is told of it.
    is_old |= report.state == CheckState::kRefused && arrivals_ != arrived_before;
    if (is_old && !is_waiting(in_work_) && enqueue(order, false)) continue;
    if (reports_.size() >= kMostKept) reports_.erase(reports_.begin());
    reports_[in_work_] = std::move(report);
  }
}

// The files are looked at in a thread of their own: a check may take a minute, and a start meanwhile must not miss a change.
void ProgramChecks::watch() {
  std::unique_lock lock(mutex_);
  for (unsigned looks = 0; !stop_; ++looks) {
    ask_ = false;
    ++looks_begun_;
    lock.unlock();
    // In this order: what was found must be gone before a head is taken as one that has not passed, or the next step of the feeder finds it again.
    forget_changed(false);
    look_at_heads();
    lock.lock();
    looks_ended_ = looks_begun_;
    looked_.notify_all();
    if (looks % kLooksOfAll == 0) {
      lock.unlock();
      forget_changed(true);
      lock.lock();
    }
    asked_.wait_for(lock, kLookPeriod, [this] { return stop_ || ask_; });
  }
}

// What a program at a head calls has changed: it has not passed any more. The disk is asked without the lock, because that may take its time.
void ProgramChecks::look_at_heads() {
  for (Head& head : head_) {
    std::vector<CheckReport::File> called;
    std::weak_ptr<ProgramText> text;
    {
      const std::lock_guard lock(mutex_);
      called = head.called;
      text = head.text;
    }
    if (std::all_of(called.begin(), called.end(), is_unchanged)) continue;
    const std::lock_guard lock(mutex_);
    if (head.text.lock() != text.lock()) continue;  // another program has been selected meanwhile
    head.passed = false;
    head.called.clear();
  }
}

// What was found ends with a change of a file that it was found in; `all`: also of programs that are at no head.
void ProgramChecks::forget_changed(bool all) {
  std::map<Key, CheckReport> kept;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& found : reports_)
      if (all || std::any_of(head_.begin(), head_.end(), [&](const Head& head) { return head.key == found.first; })) kept.insert(found);
  }
  for (const auto& [key, report] : kept) {
    if (std::all_of(report.files.begin(), report.files.end(), is_unchanged)) continue;
    const std::lock_guard lock(mutex_);
    const auto found = reports_.find(key);
    if (found != reports_.end() && found->second.time_ns == report.time_ns) reports_.erase(found);
  }
}

// ---- the queue ----

bool ProgramChecks::is_waiting(const Key& key) const {
  return (working_ && in_work_ == key && !given_up_) ||
         std::any_of(waiting_.begin(), waiting_.end(), [&](const CheckOrder& order) { return order.name == key.first && order.system == key.second; });
}

CheckOrder ProgramChecks::order_of(const Key& key) const { return {key.first, path_of(key.first), key.second, limit_s_}; }

bool ProgramChecks::enqueue(const CheckOrder& order, bool first) {
  if (waiting_.size() >= kMostWaiting) return false;
  if (first) waiting_.push_front(order);
  else waiting_.push_back(order);
  wake_.notify_all();
  return true;
}

void ProgramChecks::gone(const std::string& name) {
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [&](const CheckOrder& order) { return order.name == name; });
  std::erase_if(reports_, [&](const auto& kept) { return kept.first.first == name; });
  if (working_ && in_work_.first == name) given_up_ = true;
}

void ProgramChecks::arrived(const std::string& name) {
  gone(name);
  if (policy_ == ProgramCheck::kOff) return;
  const std::lock_guard lock(mutex_);
  ++arrivals_;
  std::vector<Key> again = {{name, 0}};
  for (const auto& [key, report] : reports_)
    if (report.state == CheckState::kRefused) again.push_back(key);
  for (const Key& key : again) {
    reports_.erase(key);
    if (!is_waiting(key)) (void)enqueue(order_of(key), false);  // where there is no room, it is checked when it is selected
  }
}

bool ProgramChecks::order(const std::string& name, unsigned system, double limit_s) {
  const Key key{name, system};
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [&](const CheckOrder& order) { return order.name == name && order.system == system; });
  if (working_ && in_work_ == key) given_up_ = true;
  reports_.erase(key);
  return enqueue({name, path_of(name), system, limit_s}, true);
}

CheckState ProgramChecks::state(const std::string& name, unsigned system) const {
  const std::lock_guard lock(mutex_);
  const Key key{name, system};
  if (is_waiting(key)) return CheckState::kChecking;
  const auto found = reports_.find(key);
  return found == reports_.end() ? CheckState::kUnchecked : found->second.state;
}

std::vector<std::string> ProgramChecks::called() const {
  const std::string folder = folder_ + "/";
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  for (const Head& head : head_)
    for (const CheckReport::File& file : head.called)
      if (file.path.starts_with(folder)) names.push_back(file.path.substr(folder.size()));
  return names;
}

// ---- cycle start ----

bool ProgramChecks::may_begin(unsigned system, unsigned file) {
  const share::ProgramTable::Program program = programs_.at(file);
  const std::shared_ptr<ProgramText> text = program.text.lock();
  const std::string name = share::file_name(program.path);
  const std::lock_guard lock(mutex_);
  Head& head = head_[system];
  if (policy_ == ProgramCheck::kOff || text == nullptr || program.path != path_of(name)) {  // none of the folder of programs
    head = {};
    return true;
  }
  if (head.text.lock() != text) head = {text, {name, system}, false, false, {}};
  auto found = reports_.find(head.key);
  const bool is_of_text = found != reports_.end() && !found->second.files.empty() && text->is_file(found->second.files.front().info);
  // It was found in a text that is in the file no more: that of the head is newer.
  if (!is_of_text && !head.passed && found != reports_.end() && !found->second.files.empty() && !is_unchanged(found->second.files.front())) {
    reports_.erase(found);
    found = reports_.end();
  }
  head.waits = is_waiting(head.key);
  if (found == reports_.end()) {
    if (!head.passed && !head.waits) head.waits = enqueue(order_of(head.key), true);
  } else if (is_of_text) {
    head.passed = found->second.state == CheckState::kPassed;
    head.called.assign(found->second.files.begin() + 1, found->second.files.end());
  }
  return head.passed || policy_ == ProgramCheck::kWarn;
}

// The thread that watches looks, so that a disk that does not answer keeps nobody for longer than kPatience.
StartGate::Looked ProgramChecks::look_again() {
  std::unique_lock lock(mutex_);
  const bool calls = std::any_of(head_.begin(), head_.end(), [](const Head& head) { return !head.called.empty(); });
  if (watching_ && calls) {
    const std::uint64_t wanted = looks_begun_ + 1;  // one that is under way may have seen the files before they were changed
    ask_ = true;
    asked_.notify_all();
    if (!looked_.wait_for(lock, kPatience, [&] { return stop_ || looks_ended_ >= wanted; })) return Looked::kNoAnswer;
  }
  const bool same = std::all_of(head_.begin(), head_.end(), [](const Head& head) { return head.key.first.empty() || head.passed; });
  return same ? Looked::kSame : Looked::kDoubtful;
}

bool ProgramChecks::waits(unsigned system) {
  const std::lock_guard lock(mutex_);
  return head_[system].waits && !head_[system].passed;
}

std::string ProgramChecks::remark(unsigned system) {
  const std::lock_guard lock(mutex_);
  const Head& head = head_[system];
  if (head.key.first.empty() || head.passed) return "";
  const auto found = reports_.find(head.key);
  if (is_waiting(head.key)) return head.key.first + " is being checked";
  if (found == reports_.end()) return head.key.first + " is not checked yet";
  const CheckReport& report = found->second;
  if (report.state == CheckState::kPassed) return head.key.first + " was changed since it was selected: select it again";
  return head.key.first + (report.state == CheckState::kRefused ? " was refused by its check: " : " is not checked: ") + report.text;
}

// ---- services ----

ProgramChecks::Key ProgramChecks::key_of(const Call& call) const {
  const auto system = static_cast<unsigned>(call.value_or(Field::kSystem, 1));
  return {call.words(Field::kFile), system == 0 ? 0 : system - 1};
}

Outcome ProgramChecks::show(const Call& call) const {
  const Key key = key_of(call);
  if (key.second >= systems_) return Outcome::refused(Refused::kMalformed, "there is no such part system");
  struct stat info {};
  if (stat(path_of(key.first).c_str(), &info) != 0) return Outcome::refused(Refused::kNotFound, key.first + ": there is no such program");
  const CheckState now = state(key.first, key.second);
  const std::lock_guard lock(mutex_);
  const auto found = reports_.find(key);
  CheckReport report;
  if (now != CheckState::kChecking && found != reports_.end()) report = found->second;
  Json alarms = Json::array(), axes = Json::array();
  for (const CheckAlarm& alarm : report.alarms) alarms.push_back({{"code", alarm.code}, {"text", alarm.text}, {"program", alarm.program}, {"line", alarm.line}, {"behind", alarm.behind}});
  for (const CheckReport::Axis& axis : report.axes) axes.push_back({{"name", std::string(1, axis.name)}, {"least", axis.least}, {"most", axis.most}});
  return Outcome::with({{"state", check_state_name(now)},
                        {"text", report.text},
                        {"alarms", std::move(alarms)},
                        {"asks_line", report.asks_line},
                        {"asks_program", report.asks_program},
                        {"seconds", report.seconds},
                        {"length", report.length},
                        {"blocks", report.blocks},
                        {"axes", std::move(axes)},
                        {"tools", report.tools},
                        {"time_ns", report.time_ns}});
}

Outcome ProgramChecks::again(const Call& call) {
  const Key key = key_of(call);
  if (key.second >= systems_) return Outcome::refused(Refused::kMalformed, "there is no such part system");
  struct stat info {};
  if (stat(path_of(key.first).c_str(), &info) != 0) return Outcome::refused(Refused::kNotFound, key.first + ": there is no such program");
  return order(key.first, key.second, call.value_or(Field::kCheckSeconds, limit_s_)) ? Outcome::done() : Outcome::refused(Refused::kBusy, "too many programs wait for their check");
}

}  // namespace nc::rt::services
