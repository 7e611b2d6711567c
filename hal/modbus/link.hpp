// SPDX-License-Identifier: Apache-2.0
// One Modbus link: an ordinary thread that talks to one host or serial line, and the image that it exchanges with the
// scan.
//
// A link is LOST when it never answered yet or after lost_after errors in a row: every input shows its
// on-loss value, nothing is good. It is DEGRADED when it answers, but an error is recent or a block does not
// come through; else OK.
//
// A point is good while its block comes through. A block stops being good by an exception reply at once, by
// time-outs after lost_after of its own (a dead unit behind a living gateway), with the link in any case. The
// thread itself is watched by the scan: when it has been stuck in one call for longer than a request may take
// and a second, its values count as lost.
//
// An output that holds (OnStop::kHold) belongs to the partner until the control has taken it over: its block is read before anything
// is written to it, the scan begins with what was found, and at the end nothing is written. So a clamp stays closed from one
// control to the next, whether the first one ended in order or not.
#pragma once

#include <pthread.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <random>
#include <string>
#include <vector>

#include "hal/modbus/session.hpp"
#include "hal/point_bus.hpp"
#include "hal/triple_buffer.hpp"

namespace nc::hal::modbus {

enum class LinkState : std::uint8_t { kLost, kDegraded, kOk };
const char* state_name(LinkState state);

struct LinkStatistics {
  LinkState state = LinkState::kLost;
  std::uint64_t requests = 0;  // sent, connecting not counted
  std::uint64_t errors = 0;    // connecting or requests without a valid answer, time-outs among them
  std::uint64_t timeouts = 0;
  std::uint64_t exceptions = 0;                            // exception replies
  std::uint64_t connects = 0;                              // connections that came about
  std::string last_error;                                  // empty = none yet
  std::uint32_t round_trip_us = 0, round_trip_max_us = 0;  // of requests that were answered
  double round_trip_mean_us = 0;

  std::uint64_t reconnects() const { return connects > 0 ? connects - 1 : 0; }
};

// Takes one line for the operator's log; called in the link's thread, on changes only.
using Report = std::function<void(const std::string& line)>;

class ModbusLink final : public PointBus {
 public:
  explicit ModbusLink(const LinkConfig& config, Report report = {});
  ~ModbusLink() override;

  bool start(const PointImage& initial, std::string* error) override;
  void read(PointImage* image) noexcept override;
  void write(const PointImage& image) noexcept override;
  // Writes the safe values when the link is up (one attempt to connect when it is not lost) and ends the
  // thread; a partner that does not answer ends it by force.
  void stop() noexcept override;

  // ---- any thread ----
  // Every block of a link that is OK has come through, with them those of the outputs that hold.
  bool held_outputs_known() const override;
  LinkStatistics statistics() const;
  const LinkConfig& config() const { return config_; }

 private:
  using Time = std::chrono::steady_clock::time_point;
  // A request that comes again and again.
  struct Job {
    Block block;
    bool bad = true;      // its points are not good
    unsigned errors = 0;  // without a valid answer, in a row
    unsigned pause_ms = 0;
    Time retry_at{};       // while bad
    std::string trouble;   // the last one that was reported
    bool written = false;  // outputs: since the connection came about
    std::vector<std::uint16_t> cells;
    Time written_at{};
    bool known = false;    // outputs that hold: what the partner had at the start has been read
  };
  // By place in config_.points.
  struct Shown {
    std::vector<std::uint32_t> value;
    std::vector<std::uint8_t> good;
    bool ok = false;
    std::vector<std::uint32_t> found;  // outputs that hold: what they had at the start, where `known`
    std::vector<std::uint8_t> known;
  };
  // Outputs as the scan wants them. One that holds is the scan's own, and written, when the scan has taken over what was found,
  // or has given it another value before that was known.
  struct Wanted {
    std::vector<std::uint32_t> value;
    std::vector<std::uint8_t> own;
  };

  bool make_thread(std::string* error);
  void run();
  void prepare(const PointImage& initial);
  bool connect();
  void round();
  bool serve(Job* job);
  bool write_due(const Job& job, const std::vector<std::uint16_t>& cells) const;
  std::vector<std::uint16_t> output_cells(const Job& job, const std::vector<std::uint32_t>& values) const;
  void take_inputs(const Job& job);
  Result find_outputs(Job* job, Result result);
  bool waits_for_scan(const Job& job, const Wanted& wanted) const;
  void account(Result result, Time sent, bool request);
  void answered(Job* job, Result result);
  void unanswered(Job* job);
  void lose(const std::string& why);
  void postpone(Job* job);
  void publish();
  void write_safe_values();
  bool wait(std::chrono::milliseconds time);
  void alive() noexcept;
  void report(const std::string& line) const;
  std::chrono::milliseconds next_backoff();

  const LinkConfig config_;
  const Report report_;
  const std::int64_t stuck_ns_;
  std::unique_ptr<Session> session_;
  pthread_t thread_{};
  bool has_thread_ = false;

  // ---- scan ----
  TripleBuffer<Shown> inputs_;
  TripleBuffer<Wanted> outputs_;
  Wanted sent_;                       // outputs as last published
  std::vector<std::uint32_t> start_;  // as the control began
  bool taken_over_ = false;           // since then
  std::atomic<std::int64_t> alive_ns_{0};

  // ---- link's thread ----
  std::vector<Job> jobs_;             // outputs first
  std::size_t cursor_ = 0;            // where the next round begins: behind the job that broke the last one
  std::vector<std::uint32_t> value_;  // last valid input values
  std::vector<std::uint8_t> valid_;   // the answer held a number
  std::vector<std::uint32_t> found_;  // of outputs that hold
  std::vector<std::uint16_t> scratch_;
  unsigned errors_ = 0;  // in a row
  bool lost_ = true;
  unsigned backoff_ms_;
  std::minstd_rand random_;

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false, ended_ = false;
  LinkStatistics statistics_;
  double round_trip_sum_us_ = 0;
  std::uint64_t round_trips_ = 0;
};

}  // namespace nc::hal::modbus
