// SPDX-License-Identifier: Apache-2.0
// One Modbus link: the thread. The scan's side is in link_image.cpp. See link.hpp.
#include "hal/modbus/link.hpp"

#include <algorithm>

#include "hal/bus_thread.hpp"
#include "hal/modbus/codec.hpp"
#include "hal/modbus/frame.hpp"

namespace nc::hal::modbus {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr unsigned kSliceMs = 100;                            // interval at which a waiting thread shows that it is alive
constexpr milliseconds kStopLimit{5000};                      // time for writing the safe values of one link
constexpr unsigned kFirstPauseMs = 100, kLastPauseMs = 5000;  // pauses between the attempts for a block that fails

std::int64_t now_ns() { return std::chrono::nanoseconds(steady_clock::now().time_since_epoch()).count(); }

}  // namespace

// ---- start and stop ----

void ModbusLink::prepare(const PointImage& initial) {
  jobs_.clear();
  for (const bool write : {true, false})
    for (Block& block :
         write ? write_blocks(config_.points) : read_blocks(config_.points, config_.merge_gap)) {
      Job job;
      job.block = std::move(block);
      jobs_.push_back(std::move(job));
    }
  for (std::size_t i = 0; i < config_.points.size(); ++i) {
    value_[i] = found_[i] = start_[i] = sent_.value[i] = initial.value[config_.points[i].point];
    sent_.own[i] = config_.points[i].holds() ? 0 : 1;
    valid_[i] = 1;
  }
  taken_over_ = false;
  outputs_.back() = sent_;
  outputs_.publish();
  cursor_ = 0;
  errors_ = 0;
  lost_ = true;
  backoff_ms_ = config_.backoff_min_ms;
  stopping_ = ended_ = false;
  session_ = make_session(config_);
  alive();
  publish();
}

bool ModbusLink::start(const PointImage& initial, std::string* error) {
  prepare(initial);
  return make_thread(error);
}

bool ModbusLink::make_thread(std::string* error) {
  const auto body = [](void* link) -> void* {
    static_cast<ModbusLink*>(link)->run();
    return nullptr;
  };
  std::string why;
  has_thread_ = make_bus_thread(&thread_, body, this, "mb-" + config_.name, &why);
  if (!has_thread_) *error = "Modbus link " + config_.name + ": no thread: " + why;
  return has_thread_;
}

void ModbusLink::stop() noexcept {
  if (!has_thread_) return;
  std::unique_lock lock(mutex_);
  stopping_ = true;
  wake_.notify_all();
  const auto writes =
      std::count_if(jobs_.begin(), jobs_.end(), [](const Job& job) { return job.block.write; });
  const milliseconds request(config_.response_timeout_ms + config_.byte_timeout_ms);
  const bool ended =
      wake_.wait_for(lock, std::min(kStopLimit, request * (writes + 2)), [this] { return ended_; });
  lock.unlock();
  if (!ended) session_->abort();
  pthread_join(thread_, nullptr);
  has_thread_ = false;
}

// ---- the thread ----

void ModbusLink::run() {
  while (wait(milliseconds(0))) {
    if (const std::string line = gate_.due(now_ns()); !line.empty()) say(line);
    if (!session_->is_open() && !connect()) {
      wait(next_backoff());
      continue;
    }
    const Time begin = steady_clock::now();
    round();
    if (!session_->is_open())
      wait(next_backoff());
    else
      wait(std::chrono::ceil<milliseconds>(begin + milliseconds(config_.poll_ms) - steady_clock::now()));
  }
  write_safe_values();
  if (const std::string line = gate_.rest(); !line.empty()) say(line);
  session_->close();
  const std::lock_guard lock(mutex_);
  statistics_.state = LinkState::kLost;
  ended_ = true;
  wake_.notify_all();
}

// False when the link is to end.
bool ModbusLink::wait(milliseconds time) {
  const Time end = steady_clock::now() + time;
  std::unique_lock lock(mutex_);
  for (;;) {
    alive();
    if (stopping_) return false;
    const Time now = steady_clock::now();
    if (now >= end) return true;
    wake_.wait_until(lock, std::min(end, now + milliseconds(kSliceMs)), [this] { return stopping_; });
  }
}

// The pause doubles each time, so that a partner that is off costs little. It is varied at random by up to a quarter, so that
// many links do not reconnect at the same moment.
milliseconds ModbusLink::next_backoff() {
  const unsigned base = backoff_ms_;
  backoff_ms_ = std::min(std::max(1u, 2 * base), config_.backoff_max_ms);
  std::uniform_int_distribution<unsigned> spread(base - base / 4, base + base / 4);
  return milliseconds(std::min(spread(random_), config_.backoff_max_ms));
}

bool ModbusLink::connect() {
  const Time begin = steady_clock::now();
  const Result result = session_->connect();
  account(result, begin, false);
  if (result != Result::kOk) {
    if (++errors_ >= config_.lost_after) lose(session_->error());
    publish();
    return false;
  }
  for (Job& job : jobs_) job.written = false;  // write all outputs again, because the partner may have lost them
  return true;
}

// Serves every block once; ends early when the connection breaks.
void ModbusLink::round() {
  const std::size_t first = cursor_;
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    const std::size_t place = (first + i) % jobs_.size();
    cursor_ = (place + 1) % jobs_.size();
    const bool through = serve(&jobs_[place]);
    publish();
    if (!through || !wait(milliseconds(0))) return;
  }
  cursor_ = 0;
}

// False when the connection is gone.
bool ModbusLink::serve(Job* job) {
  if (job->bad && !lost_ && steady_clock::now() < job->retry_at) return true;
  if (job->block.write) outputs_.take();
  const bool finds = job->block.holds && !job->known && waits_for_scan(*job, outputs_.front());
  const bool writes = job->block.write && !finds;
  std::vector<std::uint16_t> cells;
  if (writes) {
    if (waits_for_scan(*job, outputs_.front())) return true;
    cells = output_cells(*job, outputs_.front().value);
    if (!write_due(*job, cells)) return true;
  }
  const Time sent = steady_clock::now();
  const Result result = writes ? session_->write(job->block, cells.data()) : session_->read(job->block, scratch_.data());
  alive();
  account(result, sent, true);
  if (result == Result::kTimeout || result == Result::kFailed) {
    unanswered(job);
    return false;
  }
  if (finds) {
    answered(job, find_outputs(job, result));
    return true;
  }
  if (result == Result::kOk && job->block.write) {
    job->written = true;
    job->cells = std::move(cells);
    job->written_at = sent;
  } else if (result == Result::kOk) {
    take_inputs(*job);
  }
  answered(job, result);
  return true;
}

// Takes the values that outputs that hold have before this control writes to them. When the partner does not support reading them, that is reported, and they
// begin with their initial values. When the partner is busy or its gateway does not reach it yet, it is asked again, because a device that has
// just been switched on answers so.
Result ModbusLink::find_outputs(Job* job, Result result) {
  const bool never = result == Result::kException && (session_->exception() == kIllegalFunction || session_->exception() == kIllegalAddress);
  if (result != Result::kOk && !never) return result;
  job->known = true;
  for (const unsigned i : job->block.maps) {
    const PointMap& map = config_.points[i];
    if (never || !decode(map, &scratch_[map.address - job->block.first], &found_[i])) found_[i] = map.initial;
  }
  if (never) report("on_stop = \"hold\" begins with the initial values, because they cannot be read back: " + session_->error());
  return Result::kOk;
}

// True while an output of the block must not be written: it has not been read back yet, or no scan has taken over the value that was found.
bool ModbusLink::waits_for_scan(const Job& job, const Wanted& wanted) const {
  return std::any_of(job.block.maps.begin(), job.block.maps.end(), [&](unsigned i) { return wanted.own[i] == 0; });
}

bool ModbusLink::write_due(const Job& job, const std::vector<std::uint16_t>& cells) const {
  return !job.written || cells != job.cells ||
         steady_clock::now() - job.written_at >= milliseconds(config_.refresh_ms);
}

std::vector<std::uint16_t> ModbusLink::output_cells(const Job& job,
                                                    const std::vector<std::uint32_t>& values) const {
  std::vector<std::uint16_t> cells(job.block.count, 0);
  for (const unsigned i : job.block.maps)
    encode(config_.points[i], values[i], &cells[config_.points[i].address - job.block.first]);
  return cells;
}

void ModbusLink::take_inputs(const Job& job) {
  for (const unsigned i : job.block.maps) {
    const PointMap& map = config_.points[i];
    valid_[i] = decode(map, &scratch_[map.address - job.block.first], &value_[i]) ? 1 : 0;
  }
}

// ---- the consequences of an answer or of its absence ----

void ModbusLink::account(Result result, Time sent, bool request) {
  const auto us = std::chrono::duration_cast<std::chrono::microseconds>(steady_clock::now() - sent).count();
  const bool failed = result == Result::kTimeout || result == Result::kFailed;
  const std::lock_guard lock(mutex_);
  LinkStatistics& s = statistics_;
  if (request) ++s.requests;
  if (!request && !failed) ++s.connects;
  if (failed) ++s.errors;
  if (result == Result::kTimeout) ++s.timeouts;
  if (result == Result::kException) ++s.exceptions;
  if (result != Result::kOk) s.last_error = session_->error();
  if (!request || failed) return;
  s.round_trip_us = static_cast<std::uint32_t>(us);
  s.round_trip_max_us = std::max(s.round_trip_max_us, s.round_trip_us);
  round_trip_sum_us_ += static_cast<double>(us);
  s.round_trip_mean_us = round_trip_sum_us_ / static_cast<double>(++round_trips_);
}

void ModbusLink::answered(Job* job, Result result) {
  errors_ = 0;
  backoff_ms_ = config_.backoff_min_ms;
  job->errors = 0;
  if (lost_) {
    lost_ = false;
    for (Job& each : jobs_) {
      each.retry_at = {};
      if (&each != job) each.written = false;  // the partner may have forgotten it
    }
    report("connected to " + config_.partner());
  }
  if (result == Result::kOk) {
    if (!job->trouble.empty()) report("again good: " + place_text(job->block));
    job->bad = false;
    job->pause_ms = 0;
    job->trouble.clear();
    return;
  }
  job->bad = true;
  postpone(job);
  if (job->trouble != session_->error()) report(session_->error());
  job->trouble = session_->error();
}

void ModbusLink::unanswered(Job* job) {
  const std::string why = session_->error();
  for (Job& each : jobs_)
    if (each.block.unit == job->block.unit) each.written = false;  // the unit may be without power
  // What is known to be dead says nothing new about the link, as long as something else lives.
  const bool known = job->bad && !lost_;
  const bool others = std::any_of(jobs_.begin(), jobs_.end(), [](const Job& each) { return !each.bad; });
  if (!(known && others) && ++errors_ >= config_.lost_after) lose(why);
  if (++job->errors < config_.lost_after) return;
  if (!job->bad && !lost_) {
    report(why);
    job->trouble = why;
  }
  job->bad = true;
  postpone(job);
}

void ModbusLink::lose(const std::string& why) {
  for (Job& job : jobs_) job.bad = true;
  if (!lost_ || errors_ == config_.lost_after) report("lost: " + why);  // reported once; also when the link was never connected
  lost_ = true;
}

// A block that fails is tried less and less often, because each attempt may delay the other blocks by a
// time-out.
void ModbusLink::postpone(Job* job) {
  job->pause_ms = job->pause_ms == 0 ? kFirstPauseMs : std::min(2 * job->pause_ms, kLastPauseMs);
  job->retry_at = steady_clock::now() + milliseconds(job->pause_ms);
}

// ---- stop ----

void ModbusLink::write_safe_values() {
  const auto is_written = [](const Job& job) { return job.block.write && !job.block.holds; };
  if (std::none_of(jobs_.begin(), jobs_.end(), is_written)) return;
  if (!session_->is_open() && !lost_) connect();
  std::vector<std::uint32_t> safe;
  for (const PointMap& map : config_.points) safe.push_back(map.on_stop == OnStop::kValue ? map.stop_value : map.initial);
  for (const Job& job : jobs_) {
    if (!is_written(job)) continue;
    const Time sent = steady_clock::now();
    Result result = Result::kFailed;
    if (session_->is_open()) {
      result = session_->write(job.block, output_cells(job, safe).data());
      account(result, sent, true);
    }
    if (result != Result::kOk)
      report("safe values not written, the partner keeps what it has or does what it is set to: " +
             session_->error());
    if (!session_->is_open()) return;
  }
}

void ModbusLink::report(const std::string& line) {
  if (gate_.takes(line, now_ns())) say(line);
}

void ModbusLink::say(const std::string& line) const {
  if (report_) report_(config_.name + ": " + line);
}

bool ModbusLink::held_outputs_known() const {
  const bool holds = std::any_of(config_.points.begin(), config_.points.end(), [](const PointMap& map) { return map.holds(); });
  return !holds || statistics().state == LinkState::kOk;
}

}  // namespace nc::hal::modbus
