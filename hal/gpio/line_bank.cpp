// SPDX-License-Identifier: Apache-2.0
// The lines of one chip over time. See line_bank.hpp.
#include "hal/gpio/line_bank.hpp"

#include <algorithm>

namespace nc::hal::gpio {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kFirstPause{100}, kLastPause{5000};  // shortest and longest pause between two requests for lines that are not there
// Outputs are written again after this time even when they have not changed: a bank without inputs notices only by writing that its chip is gone, and an
// expander forgets its outputs when its supply fails for a moment.
constexpr milliseconds kRefresh{100};

}  // namespace

LineBank::LineBank(const BankConfig& config, std::unique_ptr<LineChip> chip, Report report)
    : config_(config), chip_(std::move(chip)), report_(std::move(report)), filter_(config.lines.size()), pause_(kFirstPause) {
  for (const PointLine& line : config_.lines) setup_.push_back(line.line);
  if (config_.has_watchdog) setup_.push_back(config_.watchdog);
  read_.resize(setup_.size());
}

// ---- getting and losing the lines ----

bool LineBank::open(Time now, const Values& initial, std::string* error) {
  for (std::size_t i = 0; i < filter_.size(); ++i) filter_[i].shown = initial[i];
  pause_ = kFirstPause;
  trouble_.clear();
  watchdog_ = 0;
  std::string why;
  const Opening opening = request(now, initial, &why);
  if (opening == Opening::kOpen) return true;
  if (opening != Opening::kNoChip) {
    *error = "GPIO " + config_.name + ": " + why;
    return false;
  }
  wait_for_lines(now, why);
  return true;
}

Opening LineBank::request(Time now, const Values& outputs, std::string* why) {
  Values values = levels(outputs);
  const Opening opening = chip_->request(config_.chip, config_.consumer, setup_, values, why);
  up_ = opening == Opening::kOpen;
  if (!up_) return opening;
  written_ = std::move(values);
  written_at_ = now;
  errors_ = 0;
  pause_ = kFirstPause;
  for (Filter& filter : filter_) filter.known = false;
  if (!trouble_.empty()) report("the lines of " + config_.chip + " are there");
  trouble_.clear();
  return opening;
}

// Sets the time of the next attempt. The same trouble is reported only once in a row.
void LineBank::wait_for_lines(Time now, const std::string& why) {
  if (trouble_ != why) report(why);
  trouble_ = why;
  retry_at_ = now + pause_;
  pause_ = std::min(2 * pause_, kLastPause);
}

void LineBank::failed(Time now, const std::string& why) {
  if (++errors_ < config_.lost_after) return;
  chip_->release();
  up_ = false;
  wait_for_lines(now, "lost: " + why);
}

void LineBank::close() {
  const bool outputs = std::any_of(setup_.begin(), setup_.end(), [](const LineSetup& line) { return line.output; });
  std::string why = "the lines are not there";
  watchdog_ = 0;
  Values stop;
  for (const PointLine& line : config_.lines) stop.push_back(line.stop_value);
  if (outputs && !(up_ && chip_->write(levels(stop), &why))) report("safe values not written: " + why);
  if (up_) chip_->release();
  up_ = false;
}

// ---- one poll ----

void LineBank::poll(Time now, const Values& wanted, bool scanned) {
  std::string why;
  if (scanned) watchdog_ ^= 1;
  if (!up_ && now < retry_at_) return;
  if (!up_ && request(now, wanted, &why) != Opening::kOpen) return wait_for_lines(now, why);
  if (exchange(now, wanted, &why)) errors_ = 0;
  else failed(now, why);
}

bool LineBank::exchange(Time now, const Values& wanted, std::string* why) {
  const Values values = levels(wanted);
  const auto output = [](const LineSetup& line) { return line.output; };
  if (values != written_ || (now - written_at_ >= kRefresh && std::any_of(setup_.begin(), setup_.end(), output))) {
    if (!chip_->write(values, why)) return false;
    written_ = values;
    written_at_ = now;
  }
  if (std::all_of(setup_.begin(), setup_.end(), output)) return true;
  if (!chip_->read(&read_, why)) return false;
  for (std::size_t i = 0; i < filter_.size(); ++i)
    if (!setup_[i].output) take(now, i, read_[i]);
  return true;
}

// The values that the chip is given, one for each line; those of inputs have no meaning.
LineBank::Values LineBank::levels(const Values& wanted) const {
  Values values(setup_.size(), 0);
  for (std::size_t i = 0; i < config_.lines.size(); ++i)
    if (setup_[i].output) values[i] = wanted[i] != 0 ? 1 : 0;
  if (config_.has_watchdog) values.back() = watchdog_;
  return values;
}

// Debounces an input. The first level after the request counts at once, because there is no earlier level.
void LineBank::take(Time now, std::size_t line, std::uint8_t raw) {
  Filter& filter = filter_[line];
  if (!filter.known || filter.raw != raw) filter.since = now;
  filter.raw = raw;
  if (!filter.known || now - filter.since >= milliseconds(config_.lines[line].debounce_ms)) filter.shown = raw;
  filter.known = true;
}

// ---- the values of the points ----

bool LineBank::good(std::size_t line) const {
  return up_ && (setup_[line].output || filter_[line].known);
}

std::uint8_t LineBank::shown(std::size_t line) const {
  const PointLine& config = config_.lines[line];
  if (good(line) || config.hold_on_loss) return filter_[line].shown;
  return config.loss_value;
}

void LineBank::report(const std::string& line) const {
  if (report_) report_(config_.name + ": " + line);
}

}  // namespace nc::hal::gpio
