// SPDX-License-Identifier: Apache-2.0
// A session at a machine: a random machine, random programs, and one of two operators, who does anything at any time. The quiet one uses override,
// hold, interlock, single block, dry run and the auxiliary lock, and has a late feeder; the machine must then execute the same as the trace. The wild one also resets, starts
// again, enters MDI, moves by hand, changes tables, requests recalculation, sends interrupts and skip signals, locks axes, and calls functions that are
// refused. At the end every switch is released: the machine must come to an end, and execute a part once more.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "control/control.hpp"
#include "operator/dice.hpp"
#include "operator/random_machine.hpp"
#include "operator/random_part.hpp"
#include "operator/tally.hpp"
#include "operator/watch.hpp"

namespace nc::test {

class Session {
 public:
  struct Size {
    unsigned passages = 6;        ///< most passages of a program
    unsigned cycles = 4000;       ///< cycles in which the operator works
    unsigned patience = 400000;   ///< cycles in which an undisturbed program must end
    uint32_t count_from = 0;      ///< start of the counters that run for years (docs/counters.md)
  };

  Session(Dice& dice, Size size) : dice_(dice), size_(size), config_(random_machine(dice)), machine_(config_), watch_(config_), wild_(dice.chance(0.6)) {
    if (!wild_) traced_.emplace(config_);
  }

  /// Runs the session; returns "" or what was wrong.
  std::string run() {
    if (machine_ == nullptr) return "no control for this configuration";
    if (size_.count_from != 0) {
      for (nc_control* control : {static_cast<nc_control*>(machine_), traced_ ? static_cast<nc_control*>(*traced_) : nullptr})
        if (control != nullptr) control->system[0].count_from(size_.count_from);
    }
    random_settings(dice_, machine_, traced_ ? static_cast<nc_control*>(*traced_) : nullptr);
    text_ = PartMaker(dice_, 25).make(1 + dice_.draw(size_.passages));
    nc_program_on_missing(machine_, nullptr, nullptr);
    if (nc_program_add_text(machine_, "O1", text_.data(), text_.size(), &file_) != NC_OK) return "a program is not taken";
    place_ = start_place();
    nc_position_set(machine_, 0, &place_);
    if (nc_program_select(machine_, 0, file_) == NC_OK) tally_.selected();
    spindle_.turns_valid = dice_.chance(0.8);
    lag_ = dice_.chance(0.3);
    for (unsigned n = 0; n < size_.cycles && what_.empty(); ++n) {
      operate(n);
      feed();
      cycle();
    }
    if (what_.empty()) let_go();
    if (what_.empty() && !wild_) compare();
    return what_.empty() ? watch_.what() : what_;
  }

  const std::string& text() const { return text_; }
  const nc_config& config() const { return config_; }
  const Watch& watch() const { return watch_; }
  bool wild() const { return wild_; }
  uint64_t blocks() const { return blocks_; }
  const Tally& tally() const { return tally_; }

 private:
  nc_axes start_place() {
    nc_axes place{};
    for (unsigned i = 0; i < config_.system[0].axis_count; ++i) place.v[i] = dice_.chance(0.5) ? 0 : dice_.uniform(-20, 20);
    return place;
  }

  void feed() {
    if (hangs_ > 0) {
      --hangs_;
      return;
    }
    if (wild_ && dice_.chance(0.001)) hangs_ = dice_.draw(300);
    if (dice_.chance(0.4)) nc_feed(machine_, 1 + dice_.draw(60));
  }

  /// What the operator does before a cycle.
  void operate(unsigned n) {
    in_.cycle_start = false;
    if (n == 2 || ((out_.state == NC_STATE_STOPPED || out_.state == NC_STATE_HOLD) && dice_.chance(0.1)) || (out_.state == NC_STATE_IDLE && dice_.chance(0.01)))
      in_.cycle_start = true;
    if (dice_.chance(0.003)) in_.feed_override = dice_.chance(0.1) ? 0 : dice_.chance(0.1) ? dice_.scale(1e-12, 1e-3) : dice_.uniform(0.1, 2);
    if (dice_.chance(0.002)) in_.rapid_override = dice_.chance(0.1) ? 0 : dice_.uniform(0.1, 1);
    toggle(in_.feed_hold, 0.003, 0.05);
    toggle(in_.interlock, 0.001, 0.05);
    toggle(in_.single_block, 0.001, 0.005);
    toggle(in_.dry_run, 0.0005, 0.005);
    toggle(in_.manual_rapid, 0.001, 0.005);
    toggle(in_.auxiliary_lock, 0.0005, 0.005);
    if (dice_.chance(0.002)) in_.manual_feed = dice_.chance(0.1) ? 0 : dice_.scale(1e-3, 500);
    if (wild_) interfere();
  }
  void toggle(bool& signal, double on, double off) {
    if (dice_.chance(signal ? off : on)) signal = !signal;
  }

  /// What only the wild operator does.
  void interfere() {
    in_.cycle_start = in_.cycle_start || dice_.chance(haste_ * 0.001);
    toggle(in_.reset, haste_ * 0.001, 0.3);
    toggle(in_.alarm, 0.0003, 0.1);
    toggle(in_.optional_stop, 0.001, 0.01);
    toggle(in_.macro_interrupt, haste_ * 0.002, 0.1);
    toggle(in_.recalculate, haste_ * 0.001, 0.2);
    if (dice_.chance(0.002)) in_.skip ^= 1u << dice_.draw(4);
    if (dice_.chance(0.001)) in_.locked ^= uint64_t{1} << dice_.draw(config_.system[0].axis_count);
    if (dice_.chance(0.0005)) in_.manual_feed = any_number(dice_.uniform(-10, 500));
    if (dice_.chance(0.002)) {
      in_.skip_latched = dice_.draw(16);
      for (double& place : in_.skip_place.v) place = any_number(dice_.uniform(-20, 20));
    }
    if (dice_.chance(0.01)) in_.input[0] ^= 1u << dice_.draw(3);
    by_hand();
    if (out_.state == NC_STATE_STOPPED && dice_.chance(0.03)) enter_mdi();
    if (dice_.chance(haste_ * 0.004)) call();
  }

  void by_hand() {
    if (out_.restart_axes != 0 && dice_.chance(0.01)) lead_back();
    nc_manual& manual = in_.manual[dice_.draw(config_.system[0].axis_count)];
    if (manual.kind == NC_MANUAL_NONE ? dice_.chance(0.002) : dice_.chance(0.02)) {
      manual.kind = manual.kind == NC_MANUAL_NONE ? static_cast<uint8_t>(dice_.draw(5)) : static_cast<uint8_t>(NC_MANUAL_NONE);
      manual.velocity = any_number(dice_.uniform(-300, 300));
      manual.distance = any_number(manual.kind == NC_MANUAL_HANDLE ? dice_.uniform(-0.05, 0.05) : dice_.uniform(-3, 3));
    }
  }
  /// Leads every axis that was moved in a hold back to the path, and lets the others go. A key that is pressed while nothing may move by hand would have to be released first.
  void lead_back() {
    const uint32_t away = out_.manual_allowed ? out_.restart_axes : 0;
    for (unsigned i = 0; i < NC_MAX_AXES; ++i) in_.manual[i] = {(away >> i & 1) != 0 ? uint8_t{NC_MANUAL_RETURN} : uint8_t{NC_MANUAL_NONE}, 0, 0};
  }
  /// Returns `usual`, but now and then NaN, infinity, or a number out of all ranges.
  double any_number(double usual) {
    static constexpr double kOdd[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), 1e300, 5e-324, -1e9};
    return dice_.chance(0.05) ? dice_.one_of(kOdd) : usual;
  }

  void enter_mdi() {
    mdi_ = PartMaker(dice_, 20).mdi();
    // In a block stop the blocks interrupt the program, which stays the one that is counted.
    if (nc_mdi_load(machine_, 0, mdi_.data(), mdi_.size()) == NC_OK && out_.state != NC_STATE_STOPPED) tally_.mdi();
  }

  /// Calls of the feeder's thread at any time; each may be refused, none may do harm.
  void call() {
    const unsigned axis = dice_.draw(config_.system[0].axis_count);
    switch (dice_.draw(14)) {
      case 0: nc_tool_offset_set(machine_, dice_.draw(22), static_cast<nc_tool_column>(dice_.draw(4)), any_number(dice_.uniform(-3, 3))); break;
      case 1: nc_work_offset_set(machine_, 0, dice_.draw(8), axis, any_number(dice_.uniform(-5, 5))); break;
      case 2: nc_variable_set(machine_, 0, 100 + dice_.draw(12), any_number(dice_.uniform(-5, 5)), dice_.chance(0.1)); break;
      case 3: nc_parameter_set(machine_, 0, "8204", 0, dice_.chance(0.5) ? "2" : "0.3"); break;
      case 4:
        if (nc_program_select(machine_, 0, dice_.draw(3)) == NC_OK) tally_.selected();
        break;
      case 5: enter_mdi(); break;
      case 6: nc_recalculate(machine_, 0); break;
      case 7: nc_reset(machine_, 0); break;
      case 8: nc_rewind(machine_, 0, dice_.draw(200)); break;
      case 9: {
        const nc_axes place = start_place();
        if (nc_position_set(machine_, 0, &place) == NC_OK) watch_.forget();
        break;
      }
      case 10: nc_switches_set(machine_, 0, dice_.draw(1024), dice_.draw(8)); break;
      case 11: {
        second_ = PartMaker(dice_, 25).make(1 + dice_.draw(3));
        unsigned file = 0;
        if (nc_program_add_text(machine_, "O2", kept_.emplace_back(second_).data(), second_.size(), &file) == NC_OK &&
            nc_program_select(machine_, 0, file) == NC_OK)
          tally_.selected();
        break;
      }
      case 12: nc_parameter_set(machine_, 0, "1084", 0, "0.05"); break;
      default: {
        nc_world world{};
        nc_item item;
        dice_.chance(0.5) ? nc_answer(machine_, 0, &world) : nc_pull(machine_, 0, 3, &item);
        break;
      }
    }
  }

  void cycle() {
    in_.fin = lag_ ? last_strobe_ != 0 : out_.strobe != 0;
    last_strobe_ = out_.strobe;
    turn_spindle();
    in_.clock_ms += 1;
    nc_cycle(machine_, &in_, &out_);
    blocks_ += out_.blocks != last_blocks_;
    last_blocks_ = out_.blocks;
    watch_.cycle(in_, out_);
    tally_.cycle(out_);
    if (log_) show();
    nc_event event;
    while (nc_event_poll(machine_, 0, &event, nullptr) == NC_OK) {
      watch_.event(event, wild_);
      tally_.event(event);
      if (collects_) executed_.push_back(event);
      collects_ = collects_ && event.kind != NC_ITEM_END && event.kind != NC_ITEM_ALARM;
    }
    if (what_.empty() && !watch_.what().empty()) what_ = watch_.what();
  }

  /// One line for each cycle: the switches, the state, the axes.
  void show() const {
    std::printf("start %d hold %d reset %d alarm %d hand", in_.cycle_start, in_.feed_hold, in_.reset, in_.alarm);
    for (const nc_manual& manual : in_.manual) std::printf(" %d", manual.kind);
    std::printf(" override %g | state %d cause %d line %u serial %llu", in_.feed_override, out_.state, out_.cause, out_.source.line,
                static_cast<unsigned long long>(out_.serial));
    for (unsigned i = 0; i < config_.system[0].axis_count; ++i) std::printf(" %.9g", out_.command.v[i]);
    std::printf("\n");
  }

  /// A spindle that follows its command within some tenths of a second.
  void turn_spindle() {
    const double wanted = out_.spindle_rev_min[0] / 60;
    const double step = 200 * config_.cycle_s;
    spindle_.rev_per_s += std::clamp((std::isfinite(wanted) ? wanted : 0) - spindle_.rev_per_s, -step, step);
    spindle_.turns += spindle_.rev_per_s * config_.cycle_s;
    spindle_.servo_ready = (out_.servo_on != 0);
    spindle_.zero_passed = spindle_.servo_ready;
    in_.spindle[0] = spindle_;
  }

  void release() {
    const nc_spindle_inputs spindle = in_.spindle[0];
    const int64_t clock = in_.clock_ms;
    in_ = {};
    in_.feed_override = in_.rapid_override = 1;
    in_.manual_feed = 50;  // a thread that has begun in dry run goes on with it
    in_.spindle[0] = spindle;
    in_.clock_ms = clock;
  }
  /// How until() has ended. Slow is not a fault: a program may have F1.
  enum class Ended : uint8_t { there, slow, stuck };

  /// Feeds and cycles until the state is one of these (bits). A running program must get on: in every ten seconds it executes something, or moves
  /// by 0.05 mm, or by a tenth of the distance of its feed, since a program may have 0.06 mm/min.
  Ended until(unsigned states, unsigned patience) {
    const unsigned ten_seconds = static_cast<unsigned>(10 / config_.cycle_s);
    constexpr double kFar = 0.05;  // mm
    double length = out_.path_length, far = kFar;
    uint64_t serial = out_.serial, blocks = out_.blocks;
    unsigned since = 0;
    for (unsigned n = 0; n < patience && what_.empty(); ++n) {
      nc_feed(machine_, 200);
      cycle();
      in_.cycle_start = false;
      if ((states >> out_.state & 1) != 0 && n > 3) return Ended::there;
      lead_back();
      if (out_.state == NC_STATE_STOPPED || out_.state == NC_STATE_HOLD) in_.cycle_start = n % 2 == 0;
      // The operator would have to choose another speed.
      if (out_.cause == NC_CAUSE_SPINDLE_FAST || out_.cause == NC_CAUSE_SPINDLE_STOPPED || out_.cause == NC_CAUSE_SPINDLE_REVERSED) return Ended::slow;
      if (out_.feed_command_mm_min > 0) far = std::min(far, 0.1 * out_.feed_command_mm_min / 60 * 10);
      if (std::fabs(out_.path_length - length) > far || out_.serial != serial || out_.blocks != blocks) {
        length = out_.path_length;
        far = kFar;
        serial = out_.serial;
        blocks = out_.blocks;
        since = n;
      } else if (out_.cause == NC_CAUSE_DWELL) {
        since = n;  // a dwell may take longer
      } else if (n - since > ten_seconds) {
        return Ended::stuck;
      }
    }
    return Ended::slow;
  }
  std::string place() const {
    return ": state " + std::to_string(out_.state) + " cause " + std::to_string(out_.cause) + " line " + std::to_string(out_.source.line);
  }

  /// Without any disturbance the running program comes to its end, a reset leads to rest, and a part is executed to its end.
  void let_go() {
    release();
    cycle();  // a reset button that was held is released
    constexpr unsigned kIdle = 1u << NC_STATE_IDLE, kAlarm = 1u << NC_STATE_ALARM;
    in_.cycle_start = out_.state == NC_STATE_HOLD || out_.state == NC_STATE_STOPPED;
    if (dice_.chance(0.5) && until(kIdle | kAlarm, size_.patience) == Ended::stuck) {
      say("does not come to an end" + place());
      return;
    }
    collects_ = false;
    in_.cycle_start = false;
    in_.reset = true;
    cycle();
    in_.reset = false;
    if (until(kIdle, Size{}.patience) != Ended::there) {
      say("a reset does not come to rest" + place());
      return;
    }
    again();
  }

  void again() {
    tally_.close();  // the following part is always the same and does not count
    static constexpr char kPart[] = "G90 G53 G0 X5. Y5.\nG91 G1 X1. F600\nY1.\nG90 G53 G0 X7.\nM30\n";
    unsigned file = 0;
    nc_status status = NC_E_STATE;
    for (unsigned n = 0; n < 100 && status != NC_OK && what_.empty(); ++n) {
      nc_feed(machine_, 200);
      cycle();
      status = nc_program_add_text(machine_, "O7", kPart, sizeof kPart - 1, &file);
      if (status == NC_OK) status = nc_program_select(machine_, 0, file);
    }
    if (status != NC_OK) {
      say("after the reset no program can be selected: " + std::to_string(status) + place());
      return;
    }
    in_.cycle_start = true;
    cycle();
    in_.cycle_start = false;
    const Ended ended = until(1u << NC_STATE_IDLE | 1u << NC_STATE_ALARM, Size{}.patience);
    nc_alarm alarm{};
    if (nc_alarm_get(machine_, 0, &alarm) == NC_OK || out_.state == NC_STATE_ALARM) {
      say(std::string("alarm ") + alarm.code + " (" + alarm.detail.s + ") in the part behind the reset, line " + std::to_string(alarm.source.line));
    } else if (ended != Ended::there) {
      say("the part behind the reset does not end" + place());
    } else if (std::fabs(out_.command.v[0] - 7) > 1e-6) {
      say("the part behind the reset ends at X " + std::to_string(out_.command.v[0]) + " instead of 7");
    }
  }
  /// Compares the items that the machine has executed with those of the trace.
  void compare() {
    unsigned file = 0;
    nc_program_add_text(*traced_, "O1", text_.data(), text_.size(), &file);
    nc_position_set(*traced_, 0, &place_);
    nc_program_select(*traced_, 0, file);
    nc_axes machine = place_;
    for (const nc_event& event : executed_) {
      nc_item item;
      nc_status status = NC_BUDGET;
      for (unsigned n = 0; n < 10000 && status == NC_BUDGET; ++n) status = nc_pull(*traced_, 0, 100, &item);
      if (status != NC_OK) return say("the trace ends with status " + std::to_string(status) + " before serial " + std::to_string(event.serial));
      if (item.serial != event.serial || item.kind != event.kind || item.source.line != event.source.line)
        return say("executed: serial " + std::to_string(event.serial) + " kind " + std::to_string(event.kind) + " line " + std::to_string(event.source.line) +
                   ", traced: serial " + std::to_string(item.serial) + " kind " + std::to_string(item.kind) + " line " + std::to_string(item.source.line));
      if (item.kind == NC_ITEM_MOVE) {
        machine = item.u.move.machine;
        // The optimal mode passes ends at speed within its tolerance; the event comes in the first cycle after that.
        const bool passed = config_.motion_mode == NC_MOTION_OPTIMAL && !item.u.move.exact_stop;
        for (unsigned i = 0; i < config_.system[0].axis_count; ++i)
          if (std::fabs(event.machine.v[i] - machine.v[i]) > (passed ? config_.path_tolerance + config_.system[0].axis[i].max_velocity * config_.cycle_s : 1e-6))
            return say("serial " + std::to_string(event.serial) + " ends at " + std::to_string(event.machine.v[i]) + " on axis " + std::to_string(i) +
                       ", traced " + std::to_string(machine.v[i]));
      } else if (item.kind == NC_ITEM_SYNC) {
        nc_world world{};
        world.machine = machine;
        nc_answer(*traced_, 0, &world);
      }
    }
  }
  void say(const std::string& what) {
    if (what_.empty()) what_ = what;
  }

  Dice& dice_;
  Size size_;
  double haste_ = std::clamp(Size{}.cycles / std::max(1.0, static_cast<double>(size_.cycles)), 1.0, 4.0);  ///< in a shorter session the operator does more
  nc_config config_;
  Control machine_;                ///< the control that moves
  std::optional<Control> traced_;  ///< for the quiet operator another control, which only traces the program
  Watch watch_;
  Tally tally_;
  bool wild_, lag_ = false;
  std::string text_, second_, mdi_;
  std::deque<std::string> kept_;  ///< texts that the store may still read
  unsigned file_ = 0, hangs_ = 0;
  nc_axes place_{};
  nc_inputs in_{};
  nc_outputs out_{};
  nc_spindle_inputs spindle_{};
  uint8_t last_strobe_ = 0;
  uint64_t blocks_ = 0, last_blocks_ = 0;
  std::vector<nc_event> executed_;  ///< events of the first run of a quiet session
  bool collects_ = !wild_;
  bool log_ = std::getenv("NC_LOG") != nullptr;
  std::string what_;
};

}  // namespace nc::test
