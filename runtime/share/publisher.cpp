// SPDX-License-Identifier: Apache-2.0
// From snapshot and feeder to the segment. See publisher.hpp.
#include "runtime/share/publisher.hpp"

#include <algorithm>

#include "runtime/axis_shown.hpp"
#include "runtime/console.hpp"
#include "runtime/share/alarm_entry.hpp"
#include "runtime/share/segment.hpp"
#include "runtime/share/text.hpp"

namespace nc::rt::share {
namespace {

constexpr unsigned kFiguresEvery = 10;  // figures are computed in every tenth publication only, because a percentile walks through the whole histogram

}  // namespace

std::string modal_text(const nc_control* control, const nc_modal& modal) {
  char codes[NC_GROUPS][8];
  const unsigned count = nc_modal_codes_get(control, &modal, codes, NC_GROUPS);
  std::string text;
  for (unsigned i = 0; i < count; ++i) text += (i == 0 ? "" : " ") + std::string(codes[i]);
  return text;
}

MachineBlock machine_block(const Config& config, const std::string& name) {
  MachineBlock block{};
  set_text(&block.machine, config.name);
  set_text(&block.share, share_name(name));
  set_text(&block.version, nc_version());
  block.dialect = config.nc.dialect;
  block.system_count = config.nc.system_count;
  block.cycle_us = config.cycle_us;
  block.max_feed_override = config.nc.max_feed_override;
  for (unsigned s = 0; s < config.nc.system_count; ++s) {
    block.axis_count[s] = config.nc.system[s].axis_count;
    for (unsigned a = 0; a < config.nc.system[s].axis_count; ++a) {
      const nc_axis_config& axis = config.nc.system[s].axis[a];
      AxisRow& row = block.axis[s][a];
      set_text(&row.name, std::string(1, axis.name));
      row.rotary = axis.rotary;
      row.soft_limited = axis.soft_limited;
      row.soft_min = axis.soft_min;
      row.soft_max = axis.soft_max;
      row.max_velocity = axis.max_velocity;
    }
  }
  block.point_count = config.points.size();
  for (unsigned p = 0; p < config.points.size(); ++p) {
    const hal::Point& point = config.points.at(p);
    set_text(&block.point[p].name, point.name);
    block.point[p].is_word = point.type == hal::PointType::kWord;
    block.point[p].is_input = point.direction == hal::PointDirection::kInput;
    block.point[p].safe = point.initial;
    set_text(&block.point[p].meaning, point.meaning);
  }
  for (const Signal& signal : machine_signals(config.nc)) {
    if (block.signal_count == kMaxSignals) break;  // even the largest machine has fewer, which a test checks
    SignalText& row = block.signal[block.signal_count++];
    set_text(&row.name, signal.name);
    row.type = static_cast<std::uint32_t>(signal.row->type);
    row.from_nc = signal.row->direction == SignalDirection::kFromNc;
    row.safe = signal.row->safe;
    set_text(&row.meaning, signal.row->meaning);
    set_text(&row.timing, signal.row->timing);
  }
  return block;
}

Publisher::Publisher(Runtime* runtime, const ProgramTable* programs, PointTap* tap, Segment* segment,
                     bool virtual_time)
    : runtime_(*runtime),
      config_(runtime->config()),
      programs_(*programs),
      tap_(tap),
      segment_(*segment),
      virtual_time_(virtual_time) {}

void Publisher::publish() {
  const Snapshot snapshot = runtime_.snapshot();
  info_ = runtime_.info();
  status_.published_ns = wall_ns();
  status_.scan_time_ns = status_.published_ns;
  if (!virtual_time_) status_.scan_time_ns -= RealClock().now_ns() - snapshot.time_ns;
  fill_machine(snapshot);
  for (unsigned s = 0; s < status_.system_count; ++s) fill_system(s, snapshot, info_.system[s]);
  if (pictures_++ % kFiguresEvery == 0) fill_figures();
  status_.figures.scans = snapshot.scan;
  status_.figures.overruns = snapshot.overruns;
  status_.figures.missed_slots = snapshot.missed_slots;
  fill_alarms(snapshot, info_);
  if (segment_.points_until.load(std::memory_order_relaxed) > RealClock().now_ns()) {
    if (tap_ != nullptr) fill_points(snapshot);
    fill_signals();
  }
  segment_.status.store(status_);
  segment_.heartbeat.fetch_add(1, std::memory_order_release);
  if (segment_.life.load(std::memory_order_relaxed) == static_cast<std::uint32_t>(Life::kMaking))
    segment_.life.store(static_cast<std::uint32_t>(Life::kAlive), std::memory_order_release);
  wake(&segment_.wake_reader);
}

void Publisher::fill_machine(const Snapshot& snapshot) {
  status_.scan = snapshot.scan;
  status_.mode = static_cast<std::uint32_t>(snapshot.mode);
  status_.system_count = config_.nc.system_count;
  status_.single_block = snapshot.single_block;
  status_.optional_stop = snapshot.optional_stop;
  status_.resetting = snapshot.resetting;
  if (snapshot.forces.count != 0 || status_.forced_count != 0) {
    status_.forced = {};
    status_.forced_count = std::min(snapshot.forces.count, kForced);
    for (unsigned i = 0; i < status_.forced_count; ++i) {
      set_text(&status_.forced[i].device, runtime_.forced_name(snapshot.forces.device[i].number));
      status_.forced[i].value = snapshot.forces.device[i].value;
    }
  }
  std::copy(std::begin(snapshot.interface_input), std::end(snapshot.interface_input), status_.interface_input);
  std::copy(std::begin(snapshot.interface_output), std::end(snapshot.interface_output), status_.interface_output);
}

void Publisher::fill_system(unsigned index, const Snapshot& snapshot, const FeederInfo::System& info) {
  const SystemSnapshot& system = snapshot.system[index];
  const nc_outputs& nc = system.nc;
  SystemStatus& out = status_.system[index];
  out.run_state = nc.state;
  out.stop_cause = nc.cause;
  set_text(&out.state_text, state_text(nc));
  out.axis_count = config_.nc.system[index].axis_count;
  out.rapid = nc.rapid;
  out.manual_allowed = nc.manual_allowed;
  out.strobe = nc.strobe;
  out.m = nc.m;
  out.t = nc.t;
  out.b = nc.b;
  out.s_commanded = nc.s;
  out.spindle_rpm = system.shown_spindle().rev_per_s * 60;
  out.spindle_measured = !system.shown_spindle().unmeasured;
  out.feed_mm_min = nc.feed_mm_min;
  out.feed_command_mm_min = nc.feed_command_mm_min;
  out.feed_override = system.feed_override;
  out.rapid_override = system.rapid_override;
  out.feed_override_source = static_cast<std::uint32_t>(system.feed_override_source);
  out.rapid_override_source = static_cast<std::uint32_t>(system.rapid_override_source);
  out.serial = nc.serial;
  out.blocks = nc.blocks;
  out.path_length = nc.path_length;
  out.run_s = nc.run_s;
  out.refusals = system.refusal.count;
  out.refusal_cause = static_cast<std::uint32_t>(refusal_cause(system.refusal));
  set_text(&out.refusal_text, refusal_text(config_, index, system.refusal));
  set_text(&out.modal, info.modal_known ? modal_text(runtime_.control(), info.modal) : std::string());
  for (unsigned a = 0; a < out.axis_count; ++a)
    out.axis[a] = {axis_shown(nc.command.v[a], info.machine_turn, a), axis_shown(system.actual.v[a], info.machine_turn, a),
                   axis_shown(nc.work.v[a], info.work_turn, a), nc.distance_to_go.v[a], nc.velocity.v[a]};
  fill_run(nc, info, &out);
  fill_block(index, nc, info.selected, &out);
}

// Fills in how far the program has come, and how the previous runs ended.
void Publisher::fill_run(const nc_outputs& nc, const FeederInfo::System& info, SystemStatus* out) {
  const std::uint64_t lines = info.selected.any && !info.selected.mdi ? programs_.at(info.selected.file).lines : 0;
  const RunProgress progress = run_progress(info, nc, lines);
  out->program_ready = info.selected.any;
  out->main_line = progress.main_line;
  out->percent = progress.percent;
  out->program_lines = static_cast<std::uint32_t>(std::min<std::uint64_t>(lines, UINT32_MAX));
  out->runs = info.good_runs;
  out->last_run_ok = info.ended_ok;
}

// Fills in program, line and text of the block in execution.
void Publisher::fill_block(unsigned index, const nc_outputs& nc, const FeederInfo::Selected& selected, SystemStatus* out) {
  out->program_number = nc.source.program;
  out->line = nc.source.line;
  out->depth = nc.source.depth;
  std::string program, file, block;
  if (selected.any && selected.mdi) {
    program = file = "MDI";
    if (nc.source.depth == 0) block = line_of_text(programs_.mdi(index), nc.source.line);
  } else if (selected.any) {
    program = file_name(programs_.at(selected.file).path);
    if (nc.source.line != 0) {
      const ProgramTable::Program running = programs_.at(nc.source.file);
      const bool mdi = (running.path.empty() || running.dropped) && nc.source.depth != 0;  // blocks of MDI that interrupt the program are no file
      file = mdi ? "MDI" : file_name(running.path);
      block = mdi ? line_of_text(programs_.mdi(index), nc.source.line) : text_[index].line(running.text.lock(), nc.source.line);
    }
  }
  out->sequence_number = sequence_number(block);
  set_text(&out->program, program);
  set_text(&out->file, file);
  set_text(&out->block, block);
}

void Publisher::fill_figures() {
  const ScanStatistics& statistics = runtime_.statistics();
  ScanFigures& out = status_.figures;
  out.execution_p50_ns = statistics.execution.percentile_ns(0.5);
  out.execution_p999_ns = statistics.execution.percentile_ns(0.999);
  out.execution_max_ns = statistics.execution.max_ns();
  out.jitter_p50_ns = statistics.jitter.percentile_ns(0.5);
  out.jitter_p999_ns = statistics.jitter.percentile_ns(0.999);
  out.jitter_max_ns = statistics.jitter.max_ns();
}

void Publisher::fill_alarms(const Snapshot& snapshot, const FeederInfo& info) {
  bool changed = log_.update(snapshot.alarms, this, status_.published_ns);
  for (const FeederInfo::Message& message : info.messages_since(messages_)) {  // several may have come since the last publication
    log_.add_message(message.text, message.system, status_.published_ns);
    SystemStatus& system = status_.system[message.system];
    set_text(&system.message, message.text);
    ++system.message_count;
    changed = true;
  }
  messages_ = info.messages;
  if (!changed) return;
  const std::vector<Entry>& active = log_.active();
  status_.alarm_count = static_cast<std::uint32_t>(std::min<std::size_t>(active.size(), kAlarms));
  status_.alarms_left_out = static_cast<std::uint32_t>(active.size()) - status_.alarm_count;
  std::copy_n(active.begin(), status_.alarm_count, status_.alarm.begin());
  segment_.history.store(log_.history());
}

bool Publisher::describe(const ActiveAlarm& alarm, Entry* entry) { return describe_alarm(runtime_, info_, alarm, entry); }

void Publisher::fill_points(const Snapshot& snapshot) {
  bool lost = false;
  if (tap_->take(&image_, &lost)) {
    points_.scan = snapshot.scan;
    points_.count = config_.points.size();
    for (unsigned p = 0; p < points_.count; ++p) {
      points_.value[p] = image_.value[p];
      points_.good[p] = config_.points.at(p).bus == 0 ? !lost : image_.good[p] != 0;
    }
    segment_.points.store(points_);
  }
  tap_->want();
}

void Publisher::fill_signals() {
  SignalBoard& board = *runtime_.signals();
  if (board.signals().size() > kMaxSignals) return;
  if (board.take(signals_.value.data(), &signals_.scan)) {
    signals_.count = static_cast<std::uint32_t>(board.signals().size());
    segment_.signals.store(signals_);
  }
  board.want();
}

}  // namespace nc::rt::share
