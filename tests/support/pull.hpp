// SPDX-License-Identifier: Apache-2.0
// A control on the bench: runs program texts through the public C API and keeps the items that came out. Moves are written as
// short texts, so that a test reads like a list of what the machine does.
#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "nc/nc.h"

namespace nc::test {

/// A number as a person writes it (12.5, 0, -3), rounded to 1e-6.
inline std::string brief(double value) {
  double rounded = std::nearbyint(value * 1e6) / 1e6;
  if (rounded == 0) rounded = 0;  // no -0
  char text[40];
  std::snprintf(text, sizeof text, "%.13g", rounded);
  return text;
}

/// One item together with the data that its ids refer to.
struct Step {
  nc_item item{};
  nc_modal modal{};     ///< only of marks and the end
  nc_axes machine{};    ///< machine position after the item
  std::string text;     ///< only of messages
};

class Bench;

/// What a program did.
struct Outcome {
  std::vector<Step> steps;
  nc_status status = NC_OK;      ///< NC_ENDED, NC_ALARMED, or NC_BUDGET: stopped at the test's limit of items
  std::string alarm;             ///< code, "" = none
  std::string alarm_message, alarm_detail;
  unsigned alarm_line = 0;
  unsigned axis_count = 3;
  bool ended_ok = false;
  nc_axes end_work{};
  std::map<uint32_t, double> vars;

  std::vector<nc_item> of(nc_item_kind kind) const {
    std::vector<nc_item> found;
    for (const Step& step : steps)
      if (step.item.kind == kind) found.push_back(step.item);
    return found;
  }
  std::vector<nc_move> moves() const {
    std::vector<nc_move> found;
    for (const Step& step : steps)
      if (step.item.kind == NC_ITEM_MOVE) found.push_back(step.item.u.move);
    return found;
  }
  /// "rapid 10 0 0", "line 1 2 3 F100", "cw 1 2 3 c0,0 F100", "skip 0 0 -1 F50": end points in machine coordinates.
  std::vector<std::string> path() const { return describe_moves(false); }
  /// As path(), in workpiece coordinates.
  std::vector<std::string> work() const { return describe_moves(true); }
  /// All functions that are given to the machine with a strobe, in order: "S1000 M3 T5 M30".
  std::string aux() const {
    std::string all;
    for (const Step& step : steps) {
      if (step.item.kind != NC_ITEM_ACTION || step.item.u.action.kind > NC_ACTION_B) continue;
      if (!all.empty()) all += ' ';
      all += step.item.u.action.letter + brief(step.item.u.action.value);
    }
    return all;
  }
  std::vector<double> dwells() const {
    std::vector<double> found;
    for (const Step& step : steps)
      if (step.item.kind == NC_ITEM_GATE && step.item.u.gate.kind == NC_GATE_DWELL_SECONDS) found.push_back(step.item.u.gate.value);
    return found;
  }
  /// Line numbers of the blocks that have ended, in order.
  std::vector<unsigned> lines() const {
    std::vector<unsigned> found;
    for (const Step& step : steps)
      if (step.item.kind == NC_ITEM_MARK && step.item.u.mark.report) found.push_back(step.item.source.line);
    return found;
  }
  /// Value of a common variable; NaN = vacant.
  double var(uint32_t number) const {
    const auto at = vars.find(number);
    return at == vars.end() ? NAN : at->second;
  }
  nc_modal last_modal() const {
    nc_modal modal{};
    for (const Step& step : steps)
      if (step.item.kind == NC_ITEM_MARK || step.item.kind == NC_ITEM_END) modal = step.modal;
    return modal;
  }

 private:
  std::vector<std::string> describe_moves(bool in_work) const {
    static constexpr const char* kNames[] = {"rapid", "line",   "arc",         "helix", "skip",
                                             "thread", "tap",   "spiral", "exponential", "nurbs", "spline"};
    std::vector<std::string> all;
    for (const Step& step : steps) {
      if (step.item.kind != NC_ITEM_MOVE) continue;
      const nc_move& m = step.item.u.move;
      const bool circular = m.plane != NC_PLANE_NONE;
      std::string text = circular ? (m.ccw ? "ccw" : "cw") : kNames[m.kind];
      for (unsigned i = 0; i < axis_count; ++i) text += ' ' + brief((in_work ? m.work : m.machine).v[i]);
      const double* center = in_work ? m.center : m.machine_center;
      if (circular) text += " c" + brief(center[0]) + ',' + brief(center[1]);
      if (m.turns > 0) text += " P" + std::to_string(m.turns);
      if (m.kind != NC_MOVE_RAPID) text += " F" + brief(m.feed_mm_min);
      all.push_back(text);
    }
    return all;
  }
};

using Path = std::vector<std::string>;

/// Every meaningful field of an item to the last bit, as text: two streams are the same when their texts are.
inline std::string exactly(const Step& step) {
  const nc_item& item = step.item;
  char text[64];
  std::string all;
  auto number = [&](const char* name, double value) {
    std::snprintf(text, sizeof text, " %s=%.17g", name, value);
    all += text;
  };
  auto axes = [&](const char* name, const nc_axes& a) {
    for (double v : a.v) number(name, v);
  };
  std::snprintf(text, sizeof text, "#%llu L%u O%u d%u f%u k%u", static_cast<unsigned long long>(item.serial), item.source.line,
                item.source.program, item.source.depth, item.source.file, item.kind);
  all = text;
  switch (item.kind) {
    case NC_ITEM_MOVE: {
      const nc_move& m = item.u.move;
      axes("work", m.work), axes("from", m.machine_start), axes("to", m.machine);
      number("c0", m.center[0]), number("c1", m.center[1]), number("mc0", m.machine_center[0]), number("mc1", m.machine_center[1]);
      number("r", m.radius), number("sweep", m.sweep_deg), number("F", m.feed_mm_min), number("len", m.length);
      number("turns", m.turns), number("kind", m.kind), number("plane", m.plane), number("ccw", m.ccw), number("exact", m.exact_stop);
      number("skip", m.skip_mask);
      break;
    }
    case NC_ITEM_ACTION: {
      const nc_action& a = item.u.action;
      number("kind", a.kind), number("value", a.value), number("mask", a.mask), number("bits", a.bits), number("index", a.index);
      all += step.text;
      break;
    }
    case NC_ITEM_GATE: number("kind", item.u.gate.kind), number("value", item.u.gate.value); break;
    case NC_ITEM_SYNC: number("what", item.u.sync.what); break;
    case NC_ITEM_MARK:
    case NC_ITEM_END: {
      const nc_modal& m = step.modal;
      axes("work", item.kind == NC_ITEM_MARK ? item.u.mark.work : item.u.end.work);
      if (item.kind == NC_ITEM_MARK) number("stop", item.u.mark.stop), number("report", item.u.mark.report);
      if (item.kind == NC_ITEM_END) number("ok", item.u.end.ok);
      for (int16_t code : m.code) number("g", code);
      number("F", m.feed), number("S", m.spindle), number("T", m.tool), number("D", m.d), number("H", m.h), number("N", m.n);
      break;
    }
    default: break;
  }
  return all;
}

/// A control with its memory, and the machine that answers it.
class Bench {
 public:
  explicit Bench(nc_dialect dialect = NC_DIALECT_M700, const std::function<void(nc_config&)>& change = {}) {
    nc_config_init(&config_);
    config_.dialect = static_cast<uint8_t>(dialect);
    config_.window_bytes = 4096;
    config_.look_ahead = 256;
    config_.programs = 32;
    if (change) change(config_);
    const size_t size = nc_memory_required(&config_);
    memory_.reset(size == 0 ? nullptr : std::aligned_alloc(64, (size + 63) / 64 * 64));
    nc_status status = NC_OK;
    if (memory_ != nullptr) control_ = nc_create(&config_, memory_.get(), size, &status);
    if (control_ == nullptr) std::abort();  // a test bench that cannot be built is a mistake of the test
  }

  nc_control* control() { return control_; }
  const nc_config& config() const { return config_; }

  Bench& param(const char* key, const char* value, char axis = 0) { return check(nc_parameter_set(control_, 0, key, axis, value)); }
  /// Sets a work offset. index: 0 = external, 1 to 6 = G54 to G59, 100 + n = G54.1 Pn.
  Bench& work_offset(unsigned index, std::vector<double> values) {
    for (unsigned i = 0; i < values.size(); ++i) check(nc_work_offset_set(control_, 0, index, i, values[i]));
    return *this;
  }
  Bench& tool(unsigned number, double value, nc_tool_column column = NC_TOOL_LENGTH) {
    return check(nc_tool_offset_set(control_, number, column, value));
  }
  Bench& var(uint32_t number, double value) { return check(nc_variable_set(control_, 0, number, value, false)); }
  Bench& at(double x, double y, double z, double fourth = 0) {
    nc_axes axes{};
    axes.v[0] = x, axes.v[1] = y, axes.v[2] = z, axes.v[3] = fourth;
    machine_ = axes;
    return check(nc_position_set(control_, 0, &axes));
  }
  /// Adds a sub program to the control. The bench keeps the text, which the control does not copy.
  unsigned add(const std::string& name, std::string text) {
    unsigned file = 0;
    std::string& kept = texts_[name];
    kept = std::move(text);
    check(nc_program_add_text(control_, name.c_str(), kept.data(), kept.size(), &file));
    return file;
  }

  /// Rewinds to a mark (serial 0 = the head of the program), at which the machine stood at `machine`.
  nc_status rewind(uint64_t serial, const nc_axes& machine) {
    const nc_status status = nc_rewind(control_, 0, serial);
    if (status == NC_OK) machine_ = machine;
    return status;
  }

  double var_now(uint32_t number) {
    double value = 0;
    bool vacant = false;
    if (nc_variable_get(control_, 0, number, &value, &vacant) != NC_OK || vacant) return NAN;
    return value;
  }
  double tool_now(unsigned number, nc_tool_column column = NC_TOOL_LENGTH) {
    double value = NAN;
    nc_tool_offset_get(control_, number, column, &value);
    return value;
  }
  double work_offset_now(unsigned index, unsigned axis) {
    double value = NAN;
    nc_work_offset_get(control_, 0, index, axis, &value);
    return value;
  }

  // What the machine answers to a sync.
  uint32_t input[NC_WORDS] = {};
  int64_t clock_ms = 0;
  /// The part (0 to 1) of a skip move that is done when the skip signal comes; without a value no signal comes.
  std::function<std::optional<double>(const nc_item& move)> skip_at;
  /// Called before a sync is answered.
  std::function<void(const nc_item& sync)> on_sync;

  /// Selects `text` as the main program and pulls it to its end.
  Outcome run(const std::string& text, uint32_t budget = 1000, unsigned max_items = 200000) {
    start(text);
    return finish(budget, max_items);
  }
  void start(const std::string& text, const char* name = "main") {
    const unsigned file = add(name, text);
    check(nc_program_select(control_, 0, file));
  }
  Outcome finish(uint32_t budget = 1000, unsigned max_items = 200000) {
    Outcome run;
    run.axis_count = config_.system[0].axis_count;
    while (run.steps.size() < max_items) {
      Step step;
      run.status = pull(&step, budget);
      if (run.status == NC_BUDGET) continue;
      if (run.status != NC_OK) break;
      if (step.item.kind == NC_ITEM_END) run.ended_ok = step.item.u.end.ok, run.end_work = step.item.u.end.work;
      run.steps.push_back(step);
    }
    if (run.steps.size() >= max_items) run.status = NC_BUDGET;
    nc_alarm alarm{};
    if (nc_alarm_get(control_, 0, &alarm) == NC_OK) {
      run.alarm = alarm.code;
      run.alarm_message = alarm.message;
      run.alarm_detail = alarm.detail.s;
      run.alarm_line = alarm.source.line;
    }
    double value = 0;
    for (uint32_t n = 0; nc_variable_next(control_, 0, n, &n, &value) == NC_OK; ++n) run.vars[n] = value;
    return run;
  }
  /// Next item; a sync is answered at once.
  nc_status pull(Step* step, uint32_t budget = 1000) {
    const nc_status status = nc_pull(control_, 0, budget, &step->item);
    if (status != NC_OK) return status;
    const nc_item& item = step->item;
    if (item.kind == NC_ITEM_MOVE) last_move_ = item, machine_ = item.u.move.machine;
    if (item.kind == NC_ITEM_SYNC) answer(item);
    step->machine = machine_;
    if (item.kind == NC_ITEM_MARK) nc_modal_get(control_, 0, item.u.mark.modal, &step->modal);
    if (item.kind == NC_ITEM_END) nc_modal_get(control_, 0, item.u.end.modal, &step->modal);
    nc_text text{};
    if (item.kind == NC_ITEM_ACTION && item.u.action.kind == NC_ACTION_MESSAGE &&
        nc_text_get(control_, 0, item.u.action.text, &text) == NC_OK)
      step->text = text.s;
    return NC_OK;
  }

 private:
  struct Release {
    void operator()(void* memory) const { std::free(memory); }
  };

  Bench& check(nc_status status) {
    if (status != NC_OK) {
      std::fprintf(stderr, "bench: status %d\n", status);
      std::abort();
    }
    return *this;
  }

  /// The answer depends only on the stream of items and on the bench, never on the time at which it is given.
  void answer(const nc_item& sync) {
    if (on_sync) on_sync(sync);
    nc_world world{};
    world.machine = machine_;
    for (unsigned i = 0; i < NC_WORDS; ++i) world.input[i] = input[i];
    world.clock_ms = clock_ms;
    world.power_on_ms = static_cast<double>(sync.serial) * 10;
    world.run_ms = static_cast<double>(sync.serial);
    if ((sync.u.sync.what & NC_SYNC_SKIP) != 0 && skip_at) {
      const std::optional<double> part = skip_at(last_move_);
      if (part) {
        world.skipped = true;
        const nc_move& m = last_move_.u.move;
        for (unsigned i = 0; i < NC_MAX_AXES; ++i)
          world.skip_machine.v[i] = m.machine_start.v[i] + *part * (m.machine.v[i] - m.machine_start.v[i]);
        world.machine = machine_ = world.skip_machine;
      }
    }
    check(nc_answer(control_, 0, &world));
  }

  nc_config config_{};
  std::unique_ptr<void, Release> memory_;
  nc_control* control_ = nullptr;
  std::map<std::string, std::string> texts_;
  nc_item last_move_{};
  nc_axes machine_{};
};

/// The axes of part system 1 by their letters, as "XYZ"; a lower case letter is a rotary axis: "XYZc".
inline std::function<void(nc_config&)> axes(const char* names) {
  return [names](nc_config& config) {
    nc_system_config& system = config.system[0];
    system = nc_system_config{};
    for (const char* n = names; *n != 0; ++n) {
      nc_axis_config& axis = system.axis[system.axis_count++];
      axis.rotary = *n >= 'a';
      axis.name = axis.rotary ? static_cast<char>(*n - 'a' + 'A') : *n;
    }
  };
}

/// One run of one text on a fresh M700 control.
inline Outcome m700(const std::string& text) { return Bench().run(text); }
/// One run of one text on a fresh DGSHAPE control; the start mark "%" is put before it.
inline Outcome dgshape(const std::string& text) { return Bench(NC_DIALECT_DGSHAPE).run("%\n" + text); }

}  // namespace nc::test
