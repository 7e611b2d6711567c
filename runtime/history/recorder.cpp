// SPDX-License-Identifier: Apache-2.0
// See recorder.hpp.
#include "runtime/history/recorder.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "runtime/share/alarm_entry.hpp"
#include "runtime/share/alarm_log.hpp"
#include "runtime/share/text.hpp"

namespace nc::rt::history {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::int64_t kJumpNs = kSecond;             // a step of the time of day that is told; what a time server corrects is less
constexpr std::int64_t kWaitForEndNs = 300'000'000;   // for the feeder to say how a program has ended
constexpr std::int64_t kAgeNs = 3600 * kSecond;       // interval at which entries that are too old go
constexpr auto kReach = std::chrono::seconds(2);

bool is_active(nc_run_state state) { return state == NC_STATE_RUNNING || state == NC_STATE_HOLD || state == NC_STATE_STOPPED; }

Entry system_entry(const char* code, std::string text, std::int64_t time_ns) {
  Entry entry;
  entry.time_ns = entry.end_ns = time_ns;
  entry.code = code;
  entry.text = std::move(text);
  return entry;
}

}  // namespace

Recorder::Recorder(Runtime* runtime, const share::ProgramTable* programs, std::string path, const StoreLimits& limits, std::function<void(const std::string&)> say)
    : runtime_(*runtime), programs_(*programs), say_(std::move(say)), path_(path), store_(std::move(path), limits) {}

bool Recorder::start(std::string* error) {
  offset_ns_ = share::wall_ns() - RealClock().now_ns();
  Entry begin = system_entry("begin", std::string("ncrtd begins, libnc ") + nc_version(), share::wall_ns());
  put(&begin);
  stop_ = false;
  started_ = thread_.start([this] { work(); }, error);
  return started_;
}

void Recorder::stop() {
  if (!started_) return;
  started_ = false;
  stop_ = true;
  thread_.join();
}

void Recorder::add(Entry entry) {
  if (entry.time_ns == 0) entry.time_ns = share::wall_ns();
  entry.end_ns = entry.time_ns;
  const std::lock_guard lock(given_mutex_);
  if (given_.size() < kWaiting) given_.push_back(std::move(entry));
  else lost_.fetch_add(1, std::memory_order_relaxed);
}

void Recorder::work() {
  {
    const std::lock_guard lock(mutex_);
    open_first();
  }
  for (unsigned look = 1;; ++look) {
    const bool last = stop_;
    {
      const std::lock_guard lock(mutex_);
      take();
      if (last) {
        settle_runs(0, true);
        Entry end = system_entry("end", "ncrtd ends", share::wall_ns());
        put(&end);
      }
      if (last || look % (kWriteMs / kLookMs) == 0) write(last);
      if (last) return store_.close();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(kLookMs));
  }
}

// ---- what comes in ----

// Gives the entry its number at its first call, and writes it again at a later one.
void Recorder::put(Entry* entry) {
  const bool fresh = entry->id == 0;
  if (fresh) entry->id = next_id_++;
  const auto waits = fresh ? batch_.added.end() : std::find_if(batch_.added.begin(), batch_.added.end(), [&](const Entry& other) { return other.id == entry->id; });
  if (waits != batch_.added.end()) *waits = *entry;
  else if (batch_.added.size() < kWaiting) batch_.added.push_back(*entry);
  else lost_.fetch_add(1, std::memory_order_relaxed);
}

void Recorder::take() {
  const std::int64_t steady = RealClock().now_ns(), wall = share::wall_ns();
  watch_clock(wall, steady);
  ScanEvent event;
  while (tap_.pop(&event)) {
    const std::int64_t when = wall - (steady - event.time_ns);
    if (event.kind == ScanEvent::Kind::kState) take_state(event, when, steady);
    if (event.kind == ScanEvent::Kind::kCleared) clear(event.alarm, when);
    if (event.kind != ScanEvent::Kind::kRaised) continue;
    alarms_ += is_warning(event.alarm.id) ? 0 : 1;
    Open& open = open_.emplace_back();
    open.alarm = event.alarm;
    open.entry.kind = EntryKind::kAlarm;
    open.entry.time_ns = when;
  }
  info_ = runtime_.info();
  settle_alarms(wall);
  settle_runs(steady, false);
  take_messages(wall);
  std::deque<Entry> given;
  {
    const std::lock_guard lock(given_mutex_);
    given.swap(given_);
  }
  for (Entry& entry : given) put(&entry);
}

void Recorder::clear(const ActiveAlarm& alarm, std::int64_t wall_ns) {
  for (Open& open : open_)
    if (same_alarm(open.alarm, alarm) && open.entry.end_ns == 0) open.entry.end_ns = wall_ns;
}

// Writes the alarms whose texts are there, or do not come, and once more those that have gone.
void Recorder::settle_alarms(std::int64_t wall_ns) {
  for (Open& open : open_) {
    Entry& entry = open.entry;
    const bool ended = entry.end_ns != 0;
    if (!open.written) {
      share::Entry shown{};
      shown.line = open.alarm.source.line;
      const bool known = share::describe_alarm(runtime_, info_, open.alarm, &shown);
      // A step of the time of day backwards must not make it wait for ever.
      const std::int64_t age = wall_ns - entry.time_ns;
      if (!known && !ended && age >= 0 && age < share::AlarmLog::kWaitForTextNs) continue;
      entry.system = open.alarm.system + 1u;
      entry.line = shown.line;
      entry.warning = shown.is_warning != 0;
      entry.code = share::text_of(shown.code);
      entry.text = share::text_of(shown.text);
      entry.axis = share::text_of(shown.axis);
      if (shown.line != 0) entry.program = share::file_name(programs_.at(open.alarm.source.file).path);
    } else if (!ended) {
      continue;
    }
    open.written = true;
    put(&entry);
  }
  std::erase_if(open_, [](const Open& open) { return open.written && open.entry.end_ns != 0; });
}

void Recorder::take_state(const ScanEvent& event, std::int64_t wall_ns, std::int64_t steady_ns) {
  Run& run = runs_[event.system];
  if (run.active && !is_active(event.state)) {
    run.active = false;
    run.ends = true;
    run.ended_ns = steady_ns;
    run.state = event.state;
    run.entry.end_ns = wall_ns;
    run.entry.seconds = event.run_s;
  }
  if (run.active || !is_active(event.state)) return;
  info_ = runtime_.info();
  if (run.ends) settle(&run);
  const FeederInfo::System& now = info_.system[event.system];
  run = {};
  run.active = true;
  run.runs = now.runs;
  run.entry.kind = EntryKind::kRun;
  run.entry.time_ns = wall_ns;
  run.entry.system = event.system + 1u;
  run.entry.program = !now.selected.any ? "" : now.selected.mdi ? "MDI" : share::file_name(programs_.at(now.selected.file).path);
  put(&run.entry);
}

void Recorder::settle_runs(std::int64_t steady_ns, bool last) {
  for (unsigned s = 0; s < NC_MAX_SYSTEMS; ++s)
    if (runs_[s].ends && (last || info_.system[s].runs > runs_[s].runs || steady_ns - runs_[s].ended_ns > kWaitForEndNs)) settle(&runs_[s]);
}

void Recorder::settle(Run* run) {
  const unsigned s = run->entry.system - 1;
  const bool completed = info_.system[s].runs > run->runs, well = completed && info_.system[s].ended_ok;  // the feeder counts those that an alarm has ended, too
  run->entry.outcome = well ? "completed" : completed || run->state == NC_STATE_ALARM ? "alarm" : "interrupted";
  put(&run->entry);
  if (well) {
    completed_[s] += 1;
    ProgramTimes times;
    times.name = run->entry.program;
    times.last_s = run->entry.seconds;
    times.last_ns = run->entry.end_ns;
    if (!times.name.empty() && times.name != "MDI" && batch_.runs.size() < kWaiting) batch_.runs.push_back(std::move(times));
  }
  run->ends = false;
}

void Recorder::take_messages(std::int64_t wall_ns) {
  const auto said = info_.messages_since(messages_);
  lost_.fetch_add(info_.messages - messages_ - said.size(), std::memory_order_relaxed);
  for (const FeederInfo::Message& message : said) {
    Entry entry;
    entry.kind = EntryKind::kMessage;
    entry.time_ns = entry.end_ns = wall_ns;
    entry.system = message.system + 1;
    entry.text = message.text;
    put(&entry);
  }
  messages_ = info_.messages;
}

// The entries keep the time that the clock showed; their numbers tell their order. The two clocks are not read at the same moment, so a step of whole seconds seems to be a little more or less.
void Recorder::watch_clock(std::int64_t wall_ns, std::int64_t steady_ns) {
  const std::int64_t step = wall_ns - steady_ns - offset_ns_;
  if (std::abs(step) < kJumpNs) {
    offset_ns_ += step;
    return;
  }
  offset_ns_ += step;
  Entry entry = system_entry("clock", std::string("the time of day was set ") + (step > 0 ? "forward" : "back") + " by " + std::to_string((std::abs(step) + kSecond / 2) / kSecond) + " s", wall_ns);
  put(&entry);
}

// ---- what is counted ----

std::vector<Counter> Recorder::count() const {
  const Config& config = runtime_.config();
  const double period_s = config.cycle_us * 1e-6;
  std::vector<Counter> list;
  const auto add = [&](const char* name, unsigned system, unsigned number, double value, const char* unit) {
    const double before = list.size() < before_.size() ? before_[list.size()].value : 0;
    list.push_back({name, system, number, before + value, unit});
  };
  add("on", 0, 0, static_cast<double>(tap_.scans()) * period_s, "s");
  add("alarms", 0, 0, alarms_, "");
  for (unsigned s = 0; s < config.nc.system_count; ++s) {
    add("running", s + 1, 0, static_cast<double>(tap_.running(s)) * period_s, "s");
    add("runs", s + 1, 0, completed_[s], "");
    for (unsigned n = 0; n < std::max<unsigned>(config.nc.system[s].spindle_count, 1); ++n) add("spindle", s + 1, n + 1, static_cast<double>(tap_.turning(s, n)) * period_s, "s");
  }
  return list;
}

// True when something that is counted, other than the time that the machine is on, has gone on since the last call.
bool Recorder::working() {
  std::uint64_t now = 0;
  for (unsigned s = 0; s < NC_MAX_SYSTEMS; ++s) {
    now += tap_.running(s);
    for (unsigned n = 0; n < NC_MAX_SPINDLES; ++n) now += tap_.turning(s, n);
  }
  const bool went_on = now != worked_;
  worked_ = now;
  return went_on;
}

// ---- the file ----

bool Recorder::trouble(const std::string& why) {
  if (why != trouble_) say_("the history is not written: " + why);
  trouble_ = why;
  try_ns_ = RealClock().now_ns() + kTryNs;
  return false;
}

bool Recorder::open_store() {
  std::string error, told;
  const bool good = store_.open(&error, &told);
  if (!told.empty()) say_(told);
  if (!good) return trouble(error);
  if (opened_) return true;
  opened_ = true;
  // What has waited for the file comes behind what is in it.
  const std::uint64_t last = store_.last_id();
  for (Entry& entry : batch_.added) entry.id += last;
  for (Open& open : open_)
    if (open.entry.id != 0) open.entry.id += last;
  for (Run& run : runs_)
    if (run.entry.id != 0) run.entry.id += last;
  next_id_ += last;
  if (store_.was_cut_off() && !batch_.added.empty()) batch_.added.front().outcome = "it was cut off before";
  std::vector<Counter> before = count();
  for (Counter& counter : before) counter.value = store_.counter(counter.key());
  before_ = std::move(before);
  if (told.empty()) return true;
  Entry entry = system_entry("damaged", told, share::wall_ns());
  put(&entry);
  return true;
}

// Whoever comes first, the thread that writes or a client, opens the file: what is in it belongs to every answer.
void Recorder::open_first() {
  if (!opened_ && trouble_.empty()) (void)open_store();
}

// Writes what waits, and the counters when it is their time.
void Recorder::write(bool last) {
  const std::int64_t now = RealClock().now_ns();
  if (!trouble_.empty() && now < try_ns_ && !last) return;
  if (!store_.is_open() && !open_store()) return;
  const std::uint64_t missing = lost();
  if (missing > told_lost_ && batch_.added.size() < kWaiting) {
    Entry entry = system_entry("lost", std::to_string(missing - told_lost_) + " entries are missing before this one", share::wall_ns());
    put(&entry);
    told_lost_ = missing;
  }
  const bool due = now - counted_ns_ >= kIdleCountNs || (now - counted_ns_ >= kCountNs && working());
  if (batch_.empty() && !due && !last) return;
  batch_.counters = count();
  const bool ages = now - aged_ns_ >= kAgeNs;
  batch_.now_ns = ages ? share::wall_ns() : 0;
  std::string error;
  if (!store_.write(batch_, &error)) {
    batch_.counters.clear();
    (void)trouble(error);
    return;
  }
  if (!trouble_.empty()) say_("the history is written again");
  trouble_.clear();
  batch_ = {};
  counted_ns_ = now;
  if (ages) aged_ns_ = now;
}

// ---- for the services ----

// Waits for the writer's thread, but not longer than kReach. It asks again and again: the thread sanitizer of Debian 12 does not know the locks of timed
// mutexes, and would see conflicts in all that they guard.
bool Recorder::lock_soon(std::unique_lock<std::mutex>* lock, std::string* error) {
  const auto until = std::chrono::steady_clock::now() + kReach;
  while (!lock->try_lock()) {
    if (std::chrono::steady_clock::now() >= until) {
      *error = "the disk of the history does not answer";
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

bool Recorder::reach(std::unique_lock<std::mutex>* lock, std::string* error) {
  if (!lock_soon(lock, error)) return false;
  take();
  write(false);  // a client sees what it has just done
  if (!store_.is_open()) *error = "there is no history: " + trouble_;
  return store_.is_open();
}

bool Recorder::list(const Filter& filter, std::vector<Entry>* entries, std::uint64_t* next, std::string* error) {
  std::unique_lock lock(mutex_, std::defer_lock);
  return reach(&lock, error) && store_.list(filter, entries, next, error);
}

bool Recorder::programs(std::uint64_t from, unsigned count, std::vector<ProgramTimes>* programs, bool* more, std::string* error) {
  std::unique_lock lock(mutex_, std::defer_lock);
  return reach(&lock, error) && store_.programs(from, count, programs, more, error);
}

bool Recorder::counters(std::vector<Counter>* counters, std::string* error) {
  std::unique_lock lock(mutex_, std::defer_lock);
  if (!lock_soon(&lock, error)) return false;
  open_first();
  *counters = count();
  return true;
}

}  // namespace nc::rt::history
