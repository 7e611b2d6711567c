// SPDX-License-Identifier: Apache-2.0
// An executor that gets a program and is driven cycle by cycle, and a checker that measures every axis in every cycle by
// finite differences of the commanded positions, without any number of the planner.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "interpolate/executor.hpp"
#include "interpolate/run_word.hpp"

namespace nc::test {

inline double to_rad(double deg) {
  return deg * std::numbers::pi / 180;
}

inline ExecutorConfig standard_config(unsigned axes = 3) {
  ExecutorConfig c;
  c.axis_count = axes;
  for (unsigned i = 0; i < axes; ++i) c.limits[i] = {250, 200, 2000, 0, 0.01};
  if (axes > 3) {
    c.rotary = 1u << 3;
    c.limits[3] = {180, 150, 3000, 0, 0.01};
  }
  c.capacity = 256;
  return c;
}

/// The records of a program, in machine coordinates; serials count from 1.
class Program {
 public:
  Program(const ExecutorConfig& config, AxisVec start = {}) : config_(config), at_(start) {}

  Record& add(ItemKind kind) {
    Record r;
    r.kind = kind;
    r.serial = records.size() + 1;
    r.source.line = line_;
    records.push_back(r);
    return records.back();
  }
  Segment& segment(const Curve& curve, double feed_mm_s) {
    Record& r = add(ItemKind::move);
    r.segment = Segment{};
    r.segment.curve = curve;
    r.segment.feed_mm_s = feed_mm_s;
    at_ = curve.end;
    return r.segment;
  }
  Segment& line(const AxisVec& end, double feed_mm_s) {
    return segment(make_line(at_, end, config_.axis_count, config_.rotary), feed_mm_s);
  }
  Segment& rapid(const AxisVec& end) {
    Segment& s = line(end, 0);
    s.rapid = s.exact_stop = true;
    return s;
  }
  /// An arc in the plane of the axes h and v, from the present place, which is at `angle` as seen from the centre, by `sweep` to a radius that is
  /// larger by `spiral`; the other axes go to `others`.
  Segment& arc(uint8_t h, uint8_t v, double radius, double angle, double sweep, double feed_mm_s,
               double spiral = 0, const AxisVec* others = nullptr) {
    Circle k;
    k.angle_start = angle;
    k.sweep = sweep;
    k.radius_start = radius;
    k.radius_end = radius + spiral;
    k.center[0] = at_[h] - radius * std::cos(angle);
    k.center[1] = at_[v] - radius * std::sin(angle);
    AxisVec end = others ? *others : at_;
    end[h] = k.center[0] + k.radius_end * std::cos(angle + sweep);
    end[v] = k.center[1] + k.radius_end * std::sin(angle + sweep);
    return segment(make_arc(at_, end, h, v, k, config_.axis_count, config_.rotary), feed_mm_s);
  }
  void mark(bool stop = true, bool report = true) {
    Record& r = add(ItemKind::mark);
    r.mark = Mark{};
    r.mark.stop = stop;
    r.mark.report = report;
    r.mark.modal = line_++;
  }
  void gate(nc_gate_kind kind, double value = 0) {
    Record& r = add(ItemKind::gate);
    r.gate = {kind, false, value};
  }
  void action(nc_action_kind kind, double value = 0, uint32_t index = 0, uint32_t mask = 0,
              uint32_t bits = 0) {
    Record& r = add(ItemKind::action);
    r.action = Action{};
    r.action.kind = kind;
    r.action.value = value;
    r.action.index = index;
    r.action.mask = mask;
    r.action.bits = bits;
    r.action.text = static_cast<uint32_t>(value);
  }
  void sync(uint32_t what = NC_SYNC_STOPPED) {
    Record& r = add(ItemKind::sync);
    r.sync = {what};
  }
  void alarm() {
    Record& r = add(ItemKind::alarm);
    r.alarm = Fault{};
  }
  void end(bool ok = true) {
    Record& r = add(ItemKind::end);
    r.end = End{};
    r.end.ok = ok;
  }
  const AxisVec& at() const { return at_; }

  std::vector<Record> records;

 private:
  ExecutorConfig config_;
  AxisVec at_;
  uint32_t line_ = 1;
};

/// Compares finite differences of the commanded positions with the limits.
class LimitChecker {
 public:
  explicit LimitChecker(const ExecutorConfig& config) : config_(config) {}

  void sample(const nc_outputs& out) {
    const double dt = config_.cycle_s;
    for (unsigned i = 0; i < config_.axis_count; ++i) {
      const AxisLimits& l = config_.limits[i];
      const double x = out.command.v[i];
      if (count_ >= 1) {
        const bool rapid = out.rapid || rapid_ || out.state == NC_STATE_MANUAL;
        const double limit = rapid ? std::max(l.rapid, l.velocity) : l.velocity;
        const double v = (x - last_[i]) / dt;
        if (limit > 0) worst_velocity = std::max(worst_velocity, std::fabs(v) / limit);
        if (count_ >= 2 && l.acceleration > 0) {
          const double a = (v - velocity_[i]) / dt;
          const double ratio = std::fabs(a) / l.acceleration;
          if (ratio > worst_acceleration) {
            worst_acceleration = ratio;
            if (ratio > worst_jerk) worst_cycle = count_, worst_axis = i;
          }
          if (count_ >= 3 && l.jerk > 0) {
            const double jerk = std::fabs(a - acceleration_[i]) / dt / l.jerk;
            if (jerk > worst_jerk) {
              worst_jerk = jerk;
              if (jerk > worst_acceleration) worst_cycle = count_, worst_axis = i;
            }
          }
          acceleration_[i] = a;
        }
        velocity_[i] = v;
      }
      last_[i] = x;
    }
    rapid_ = out.rapid;
    ++count_;
  }
  bool ok() const { return worst_velocity <= 1.001 && worst_acceleration <= 1.001 && worst_jerk <= 1.001; }
  std::string report() const {
    std::ostringstream s;
    s << "velocity " << worst_velocity << " x limit, acceleration " << worst_acceleration << " x limit, jerk " << worst_jerk
      << " x limit in cycle " << worst_cycle << " on axis " << worst_axis;
    return s.str();
  }
  double worst_velocity = 0, worst_acceleration = 0, worst_jerk = 0;  ///< divided by their limits; jerk only of axes that have a limit
  uint64_t worst_cycle = 0;
  unsigned worst_axis = 0;

 private:
  ExecutorConfig config_;
  double last_[kMaxAxes] = {}, velocity_[kMaxAxes] = {}, acceleration_[kMaxAxes] = {};
  uint64_t count_ = 0;
  bool rapid_ = false;
};

struct FreeAligned {
  void operator()(void* p) const { std::free(p); }
};

/// An executor with its memory, and a simple answer by FIN.
class Machine {
 public:
  explicit Machine(const ExecutorConfig& setup) : config(setup), checker(setup) {
    Arena measure;
    Executor().create(config, measure);
    const size_t size = (measure.used() + 63) / 64 * 64 + 64;
    memory_.reset(std::aligned_alloc(64, size));
    Arena arena(memory_.get(), size);
    executor.create(config, arena);
    overflowed = arena.overflowed() || measure.used() != arena.used();
    in.feed_override = in.rapid_override = 1;
  }

  /// One scan; FIN follows the strobe one cycle late when `answer_fin`.
  void cycle() {
    if (answer_fin) in.fin = out.strobe != 0;
    executor.cycle(in, out);
    checker.sample(out);
    nc_event e;
    uint64_t dropped = 0;
    while (executor.poll_event(&e, &dropped)) events.push_back(e);
    ++cycles;
  }
  uint32_t epoch() const { return RunWord(executor.run()).epoch(); }
  void start() {
    executor.run_taken(executor.run());
    in.cycle_start = true;
    cycle();
    in.cycle_start = false;
  }
  void reset() {
    in.reset = true;
    cycle();
    in.reset = false;
  }
  /// Pushes up to `most` records of the program; returns how many.
  unsigned feed(const Program& p, unsigned most = ~0u) {
    unsigned n = 0;
    executor.run_taken(executor.run());
    while (n < most && next < p.records.size() && executor.room() > 0) {
      Record r = p.records[next++];
      r.epoch = epoch();
      executor.push(r);
      ++n;
    }
    executor.plan();
    return n;
  }
  AxisVec command() const {
    AxisVec a;
    for (unsigned i = 0; i < kMaxAxes; ++i) a[i] = out.command.v[i];
    return a;
  }
  bool still() const { return out.distance_zero; }
  /// Feeds and cycles until the condition holds; false after `limit` cycles.
  bool until(const Program& p, const std::function<bool()>& done, uint64_t limit = 200000) {
    for (uint64_t n = 0; n < limit; ++n) {
      feed(p);
      cycle();
      if (done()) return true;
    }
    return false;
  }
  bool run_to_end(const Program& p, uint64_t limit = 2000000) {
    feed(p);
    start();
    return until(
        p, [&] { return out.state == NC_STATE_IDLE && next == p.records.size() && executor.drained(); },
        limit);
  }

  ExecutorConfig config;
  Executor executor;
  nc_inputs in{};
  nc_outputs out{};
  LimitChecker checker;
  std::vector<nc_event> events;
  size_t next = 0;
  uint64_t cycles = 0;
  bool answer_fin = true;
  bool overflowed = false;

 private:
  std::unique_ptr<void, FreeAligned> memory_;
};

}  // namespace nc::test
