// SPDX-License-Identifier: Apache-2.0
// The lines of one chip: they are requested, read and written together, and requested again when they were lost. The class has no thread and no clock of its
// own; the caller passes the time.
//
// A bank is lost when its chip is not there, or when it has failed lost_after times in a row. Then its inputs have their values for that case, no point is good,
// and the lines are requested again after 0.1 s; that pause doubles up to 5 s. An error before that changes nothing: the last values stay, and the next poll
// tries again.
#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal/gpio/bank_config.hpp"
#include "hal/gpio/edge_lines.hpp"
#include "hal/gpio/quadrature.hpp"
#include "hal/log_gate.hpp"

namespace nc::hal::gpio {

// Takes one line for the operator's log, on changes only.
using Report = std::function<void(const std::string& line)>;

class LineBank {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // One value for each of BankConfig::lines, in the same order.
  using Values = std::vector<std::uint8_t>;

  LineBank(const BankConfig& config, std::unique_ptr<LineChip> chip, Report report);

  // Requests the lines for the first time, with the initial values of the points. False with a sentence in *error for an error that waiting does not cure: a line
  // in use by another process, or a line or setting that the chip does not have. A chip that is not there yet is no error: poll() goes on trying.
  bool open(Time now, const Values& initial, std::string* error);
  // Writes the outputs when one has changed or they were not written for 0.1 s, then reads all inputs. `scanned`: the scan has run since the last poll; only
  // then does the line of the watchdog change its level.
  void poll(Time now, const Values& wanted, bool scanned);
  // Writes the values for the end and switches the watchdog off, if the lines are there; then releases the lines.
  void close();

  bool up() const { return up_; }
  std::uint8_t shown(std::size_t line) const;
  bool good(std::size_t line) const;

  // The edges at which the signal of a probe has come, all since the bank was made, and the times of the last ones: that of edge number n is at n % kProbeEdges;
  // 0 = not known.
  static constexpr unsigned kProbeEdges = 8;
  struct ProbeEdges {
    std::uint64_t count = 0;
    std::array<std::int64_t, kProbeEdges> time_ns{};
  };
  const ProbeEdges& probe(std::size_t probe) const { return probe_[probe]; }
  std::uint32_t count(std::size_t encoder) const { return encoder_[encoder].wheel.count(); }
  // The count is not good while its lines are not there, and for half a second behind a fault of its lines, because it has lost its way then.
  bool count_good(std::size_t encoder) const;

 private:
  // The debouncing of one input.
  struct Filter {
    bool known = false;        // it has been read since the lines were requested
    std::uint8_t shown = 0;    // value of the point
    std::uint8_t raw = 0;      // level of the line at the last poll
    Time since{};              // time since which raw has not changed
  };
  struct Wheel {
    Quadrature wheel;
    bool a = false, b = false;   // levels of its lines behind the changes that have been counted
    std::uint32_t faults = 0;    // those before this poll
    Time fault_at{};
    bool faulty = false;
  };

  Opening request(Time now, const Values& outputs, std::string* why);
  void wait_for_lines(Time now, const std::string& why);
  Values levels(const Values& wanted) const;
  bool exchange(Time now, const Values& wanted, std::string* why);
  void take(Time now, std::size_t line, std::uint8_t raw);
  bool take_edges(Time now, std::string* why);
  void note_probe(const LineChange& change);
  void count_encoders(Time now);
  void begin_encoders();
  void report_losses(Time now);
  bool kernel_debounces(std::size_t line) const { return setup_[line].debounce_ms != 0; }
  std::size_t line_of_encoder(std::size_t encoder) const { return config_.lines.size() + 2 * encoder; }
  void failed(Time now, const std::string& why);
  void report(const std::string& line);
  void say(const std::string& line) const;

  const BankConfig config_;
  const std::unique_ptr<LineChip> chip_;
  const Report report_;
  std::vector<LineSetup> setup_;  // the lines of the points, then two for each encoder, then that of the watchdog
  std::vector<Filter> filter_;
  bool up_ = false;
  Values written_;                // values that were written last, with the watchdog
  Time written_at_{};
  Values read_;
  std::uint8_t watchdog_ = 0;
  unsigned errors_ = 0;           // number of errors in a row
  std::chrono::milliseconds pause_;
  Time retry_at_{};
  std::string trouble_;           // the last one that was reported
  static constexpr unsigned kLinesAMinute = 20;
  LogGate gate_{kLinesAMinute};   // a line that comes and goes fills no disk
  Time now_{};                    // of the poll under way

  // ---- edges ----
  std::unique_ptr<EdgeLines> edge_lines_;
  bool edges_known_ = false;      // the lines with edges have been read since the lines were requested
  std::vector<LineEdge> edges_;
  std::vector<LineChange> changes_, to_count_;  // of this poll; of encoders, not yet counted
  std::vector<ProbeEdges> probe_;
  std::vector<Wheel> encoder_;
  Time polled_at_{};              // the last poll
  std::uint64_t losses_said_ = 0;
  Time losses_at_{};
  bool clock_said_ = false;
};

}  // namespace nc::hal::gpio
