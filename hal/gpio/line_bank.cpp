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

constexpr milliseconds kFaultShown{500};  // so long a count is not good behind a fault
constexpr milliseconds kSayAgain{10000};  // pause between two lines about edges that were lost

std::int64_t ns(LineBank::Time time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

}  // namespace

LineBank::LineBank(const BankConfig& config, std::unique_ptr<LineChip> chip, Report report)
    : config_(config), chip_(std::move(chip)), report_(std::move(report)), filter_(config.lines.size()), pause_(kFirstPause), probe_(config.probes.size()) {
  std::vector<std::int64_t> debounce_ns;
  const auto add = [&](const LineSetup& line, unsigned debounce_ms) {
    const bool by_kernel = !line.output && !line.edges && chip_->debounces();
    setup_.push_back(line);
    setup_.back().debounce_ms = by_kernel ? debounce_ms : 0;
    debounce_ns.push_back(debounce_ms * 1'000'000LL);
  };
  for (const PointLine& line : config_.lines) add(line.line, line.debounce_ms);
  for (const Encoder& encoder : config_.encoders) {
    add(encoder.a, encoder.debounce_ms);
    add(encoder.b, encoder.debounce_ms);
    encoder_.push_back({Quadrature(encoder.counts, encoder.bits), false, false, 0, {}, false});
  }
  if (config_.has_watchdog) add(config_.watchdog, 0);
  edge_lines_ = std::make_unique<EdgeLines>(setup_, debounce_ns);
  read_.resize(setup_.size());
}

// ---- getting and losing the lines ----

bool LineBank::open(Time now, const Values& initial, std::string* error) {
  now_ = now;
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
  edge_lines_->restart();
  edges_known_ = false;
  to_count_.clear();
  polled_at_ = now;
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
  if (const std::string rest = gate_.rest(); !rest.empty()) say(rest);
}

// ---- one poll ----

void LineBank::poll(Time now, const Values& wanted, bool scanned) {
  std::string why;
  now_ = now;
  if (const std::string line = gate_.due(ns(now)); !line.empty()) say(line);
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
  if (edge_lines_->any() && !take_edges(now, why)) return false;
  for (std::size_t i = 0; i < filter_.size(); ++i)
    if (!setup_[i].output && !setup_[i].edges) take(now, i, read_[i]);
  polled_at_ = now;
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
  const unsigned debounce_ms = kernel_debounces(line) ? 0 : config_.lines[line].debounce_ms;
  if (!filter.known || now - filter.since >= milliseconds(debounce_ms)) filter.shown = raw;
  filter.known = true;
}

// ---- edges ----

bool LineBank::take_edges(Time now, std::string* why) {
  edges_.clear();
  changes_.clear();
  if (!chip_->edges(&edges_, why)) return false;
  const bool first = !edges_known_;
  edge_lines_->poll(ns(now), read_, edges_, &changes_);
  for (std::size_t i = 0; i < filter_.size(); ++i) {
    if (!setup_[i].edges) continue;
    filter_[i].known = true;
    filter_[i].shown = edge_lines_->level(i) ? 1 : 0;
  }
  if (first) begin_encoders();
  edges_known_ = true;
  for (const LineChange& change : changes_) {
    if (change.line < config_.lines.size()) note_probe(change);
    else to_count_.push_back(change);
  }
  count_encoders(now);
  report_losses(now);
  return true;
}

// The first level is no edge.
void LineBank::note_probe(const LineChange& change) {
  for (std::size_t i = 0; i < config_.probes.size(); ++i) {
    const Probe& probe = config_.probes[i];
    if (probe.line != change.line || change.lost || change.level == probe.falling) continue;
    ProbeEdges& edges = probe_[i];
    edges.time_ns[edges.count++ % kProbeEdges] = change.timed ? change.time_ns : 0;
  }
}

void LineBank::begin_encoders() {
  for (std::size_t e = 0; e < encoder_.size(); ++e) {
    Wheel& wheel = encoder_[e];
    wheel.a = edge_lines_->level(line_of_encoder(e));
    wheel.b = edge_lines_->level(line_of_encoder(e) + 1);
    wheel.wheel.begin(wheel.a, wheel.b);
    wheel.faulty = false;
  }
}

// Changes of two lines are counted in the order of their times. The lines are read one behind the other, so an earlier change of the one may be read behind a later
// one of the other, with the next poll: a change waits until that has been.
void LineBank::count_encoders(Time now) {
  std::stable_sort(to_count_.begin(), to_count_.end(), [](const LineChange& one, const LineChange& other) { return one.time_ns < other.time_ns; });
  std::size_t counted = 0;
  for (; counted < to_count_.size(); ++counted) {
    const LineChange& change = to_count_[counted];
    const std::size_t e = (change.line - config_.lines.size()) / 2;
    if (change.time_ns > ns(polled_at_ - milliseconds(config_.encoders[e].debounce_ms))) break;
    Wheel& wheel = encoder_[e];
    if (change.lost) {
      wheel.wheel.fault();
      continue;
    }
    (change.line == line_of_encoder(e) ? wheel.a : wheel.b) = change.level;
    wheel.wheel.step(wheel.a, wheel.b);
  }
  to_count_.erase(to_count_.begin(), to_count_.begin() + static_cast<std::ptrdiff_t>(counted));
  for (Wheel& wheel : encoder_) {
    if (wheel.wheel.faults() != wheel.faults) {
      wheel.faulty = true;
      wheel.fault_at = now;
    }
    wheel.faults = wheel.wheel.faults();
    if (now - wheel.fault_at >= kFaultShown) wheel.faulty = false;
  }
}

void LineBank::report_losses(Time now) {
  if (edge_lines_->other_clock() && !clock_said_) {
    report("the kernel does not give the times of edges by CLOCK_MONOTONIC, as Linux does from 5.7 on: skip positions are those of the scan");
    clock_said_ = true;
  }
  const std::uint64_t losses = edge_lines_->losses();
  if (losses == losses_said_ || (losses_said_ != 0 && now - losses_at_ < kSayAgain)) return;
  report("edges were lost " + std::to_string(losses - losses_said_) + " times: a contact bounces, or edges come faster than they are read");
  losses_said_ = losses;
  losses_at_ = now;
}

bool LineBank::count_good(std::size_t encoder) const {
  return up_ && edge_lines_->known(line_of_encoder(encoder)) && !encoder_[encoder].faulty;
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

void LineBank::report(const std::string& line) {
  if (gate_.takes(line, ns(now_))) say(line);
}

void LineBank::say(const std::string& line) const {
  if (report_) report_(config_.name + ": " + line);
}

}  // namespace nc::hal::gpio
