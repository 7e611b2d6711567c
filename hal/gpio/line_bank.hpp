// SPDX-License-Identifier: Apache-2.0
// The lines of one chip over time: requested, read and written in bulk, lost and requested again. It has no thread and no clock of its own: who
// calls it says what time it is.
//
// Lost is a bank whose chip is not there, or which failed lost_after times in a row: its inputs have their values for that case, nothing is good, and
// it asks for the lines again after 0.1 s, doubling to 5 s. An error before that changes nothing: the last values stay, and the next poll tries again.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hal/gpio/bank_config.hpp"

namespace nc::hal::gpio {

// Takes one line for the operator's log, on changes only.
using Report = std::function<void(const std::string& line)>;

class LineBank {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // One for each of BankConfig::lines, at the same place.
  using Values = std::vector<std::uint8_t>;

  LineBank(const BankConfig& config, std::unique_ptr<LineChip> chip, Report report);

  // The first attempt, with the values that the points begin with. False with a sentence in *error for what does not heal by itself: a line that another
  // has, a line or a setting that the chip does not know. A chip that is not there yet is no error, poll() goes on asking for it.
  bool open(Time now, const Values& initial, std::string* error);
  // Outputs that have changed, or were not written for 0.1 s, are written; then all inputs are read. The watchdog's line changes its level when `scanned`: the scan has run since the last poll.
  void poll(Time now, const Values& wanted, bool scanned);
  // The values for the end, and the watchdog off, are written where the lines are there; then the lines are given back.
  void close();

  bool up() const { return up_; }
  std::uint8_t shown(std::size_t line) const;
  bool good(std::size_t line) const;

 private:
  // An input between what the line says and what the point shows.
  struct Filter {
    bool known = false;        // read since the lines were requested
    std::uint8_t shown = 0;    // the point's value
    std::uint8_t raw = 0;      // the line's, at the last poll
    Time since{};              // raw is what it is since then
  };

  Opening request(Time now, const Values& outputs, std::string* why);
  void wait_for_lines(Time now, const std::string& why);
  Values levels(const Values& wanted) const;
  bool exchange(Time now, const Values& wanted, std::string* why);
  void take(Time now, std::size_t line, std::uint8_t raw);
  void failed(Time now, const std::string& why);
  void report(const std::string& line) const;

  const BankConfig config_;
  const std::unique_ptr<LineChip> chip_;
  const Report report_;
  std::vector<LineSetup> setup_;  // of the points, then the watchdog
  std::vector<Filter> filter_;
  bool up_ = false;
  Values written_;                // what the outputs have, with the watchdog
  Time written_at_{};
  Values read_;
  std::uint8_t watchdog_ = 0;
  unsigned errors_ = 0;           // in a row
  std::chrono::milliseconds pause_;
  Time retry_at_{};
  std::string trouble_;           // the last one that was reported
};

}  // namespace nc::hal::gpio
