// SPDX-License-Identifier: Apache-2.0
// One Modbus link: an ordinary thread that talks to one host or serial line, and the image that it exchanges with the
// scan.
//
// A link is LOST when it has never answered, and after lost_after errors in a row. Then every input has its
// on-loss value, and no point is good. It is DEGRADED when it answers, but the last request failed or a block
// fails. Otherwise it is OK.
//
// A point is good while the requests of its block succeed. A block stops being good at once after an exception reply, after
// lost_after time-outs of its own (a dead unit behind a gateway that works), and when the link is lost. The
// scan also watches the thread: when it has been in one call for a second longer than a request may take,
// its values count as lost.
//
// An output that holds (OnStop::kHold) keeps its value until the control has taken it over: its block is read before it is
// written, the scan begins with the value that was found, and at the end nothing is written. So a clamp stays closed from one
// control to the next, whether or not the first one ended properly.
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

#include "hal/log_gate.hpp"
#include "hal/modbus/session.hpp"
#include "hal/point_bus.hpp"
#include "hal/triple_buffer.hpp"

namespace nc::hal::modbus {

enum class LinkState : std::uint8_t { kLost, kDegraded, kOk };
const char* state_name(LinkState state);

struct LinkStatistics {
  LinkState state = LinkState::kLost;
  std::uint64_t requests = 0;  // requests sent; attempts to connect are not counted
  std::uint64_t errors = 0;    // attempts to connect that failed and requests without a valid answer, including time-outs
  std::uint64_t timeouts = 0;
  std::uint64_t exceptions = 0;                            // exception replies
  std::uint64_t connects = 0;                              // attempts to connect that succeeded
  std::string last_error;                                  // empty = none yet
  std::uint32_t round_trip_us = 0, round_trip_max_us = 0;  // last and longest time of requests that were answered
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
  // Writes the safe values if the link is connected (if it is not but is not lost either, there is one attempt to connect) and ends the
  // thread. When the partner does not answer, the connection is closed by force.
  void stop() noexcept override;

  // ---- any thread ----
  // True when the link is OK: then every block has succeeded, also those of the outputs that hold.
  bool held_outputs_known() const override;
  LinkStatistics statistics() const;
  const LinkConfig& config() const { return config_; }

 private:
  using Time = std::chrono::steady_clock::time_point;
  // A block and the state of its request, which is repeated.
  struct Job {
    Block block;
    bool bad = true;      // its points are not good
    unsigned errors = 0;  // attempts in a row without a valid answer
    unsigned pause_ms = 0;
    Time retry_at{};       // time of the next attempt while bad
    std::string trouble;   // the trouble that was reported last
    bool written = false;  // outputs: they have been written on this connection
    std::vector<std::uint16_t> cells;
    Time written_at{};
    bool known = false;    // outputs that hold: their values at the start have been read
  };
  // Indexed as config_.points.
  struct Shown {
    std::vector<std::uint32_t> value;
    std::vector<std::uint8_t> good;
    bool ok = false;
    std::vector<std::uint32_t> found;  // outputs that hold: their values at the start, valid where `known` is 1
    std::vector<std::uint8_t> known;
  };
  // Outputs as the scan wants them. `own`: the output may be written. For one that holds it is set when the scan has taken over the value that
  // was found, or when the scan has given it another value before.
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
  static constexpr unsigned kLinesAMinute = 60;
  void report(const std::string& line);
  void say(const std::string& line) const;
  std::chrono::milliseconds next_backoff();

  const LinkConfig config_;
  const Report report_;
  LogGate gate_{kLinesAMinute};  // of the thread
  const std::int64_t stuck_ns_;
  std::unique_ptr<Session> session_;
  pthread_t thread_{};
  bool has_thread_ = false;

  // ---- scan ----
  TripleBuffer<Shown> inputs_;
  TripleBuffer<Wanted> outputs_;
  Wanted sent_;                       // outputs that were published last
  std::vector<std::uint32_t> start_;  // values of the outputs at the start of the control
  bool taken_over_ = false;           // a value that was found has been taken over and is not published yet
  std::atomic<std::int64_t> alive_ns_{0};

  // ---- link's thread ----
  std::vector<Job> jobs_;             // outputs first
  std::size_t cursor_ = 0;            // job with which the next round begins: after a failure the one after the job that failed
  std::vector<std::uint32_t> value_;  // last valid values of the inputs
  std::vector<std::uint8_t> valid_;   // 1 = the last answer held a number
  std::vector<std::uint32_t> found_;  // values that were found, of outputs that hold
  std::vector<std::uint16_t> scratch_;
  unsigned errors_ = 0;  // number of errors in a row
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
