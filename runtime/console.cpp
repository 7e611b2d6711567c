// SPDX-License-Identifier: Apache-2.0
// Progress and summary of ncrtd. See console.hpp.
#include "runtime/console.hpp"

#include <algorithm>
#include <cstdarg>
#include <filesystem>
#include <vector>

#include "runtime/axis_shown.hpp"

namespace nc::rt {
namespace {

constexpr std::uint64_t kCountedBytes = 64u << 20;
constexpr std::size_t kBlock = 1u << 16;

__attribute__((format(printf, 2, 3))) void append(std::string* text, const char* format, ...) {
  char buffer[256];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer, sizeof buffer, format, arguments);
  va_end(arguments);
  *text += buffer;
}

// Counts the lines up to the first code outside of a comment that ends the program. Sub programs may follow after it.
class EndFinder {
 public:
  explicit EndFinder(nc_dialect dialect) : dialect_(dialect) {}
  // True when the end code is complete.
  bool take(char c) {
    const bool digit = c >= '0' && c <= '9';
    if (in_m_ && digit) {
      number_ = std::min(number_ * 10 + static_cast<unsigned>(c - '0'), 1000000u);
      digits_ = true;
      return false;
    }
    const bool found = in_m_ && digits_ && nc_code_role_get(dialect_, 'M', number_) == NC_CODE_PROGRAM_END;
    in_m_ = !comment_ && (c == 'M' || c == 'm');
    number_ = 0;
    digits_ = false;
    if (c == '(') comment_ = true;
    if (c == ')' || c == '\n') comment_ = false;
    if (found) return true;
    if (c == '\n') ++line_;
    return false;
  }
  std::uint64_t line() const { return line_; }

 private:
  nc_dialect dialect_;
  std::uint64_t line_ = 1;
  unsigned number_ = 0;
  bool comment_ = false, in_m_ = false, digits_ = false;
};

double us(std::uint64_t ns) {
  return static_cast<double>(ns) / 1000.0;
}

void append_histogram(std::string* text, const char* name, const Histogram& histogram) {
  append(text, "  %-16s p50 %8.1f us   p99 %8.1f us   p99.9 %8.1f us   max %8.1f us\n", name,
         us(histogram.percentile_ns(0.5)), us(histogram.percentile_ns(0.99)),
         us(histogram.percentile_ns(0.999)), us(histogram.max_ns()));
}

}  // namespace

std::uint64_t estimate_lines(ProgramText* program, nc_dialect dialect) {
  const std::uint64_t size = program->copied() ? program->size() : static_cast<std::uint64_t>(program->info().st_size);  // of one that is converted about as many
  const std::uint64_t wanted = size <= kCountedBytes ? size : 1u << 20;
  std::vector<char> block(kBlock);
  std::uint64_t read = 0;
  EndFinder finder(dialect);
  while (read < wanted) {
    const long got = program->read(read, block.data(), block.size());
    if (got <= 0) break;
    for (long i = 0; i < got; ++i)
      if (finder.take(block[static_cast<std::size_t>(i)])) return finder.line();
    read += static_cast<std::uint64_t>(got);
  }
  if (read == 0) return 0;
  return std::max<std::uint64_t>(1, finder.line() * size / read);
}

unsigned percent_done(std::uint32_t main_line, std::uint64_t lines) {
  if (lines == 0) return 0;
  return static_cast<unsigned>(std::min<std::uint64_t>(100, std::uint64_t{main_line} * 100 / lines));
}

// Between a start and the end of the first block the feeder still has the last line of the previous run; `info.ended` tells that.
RunProgress run_progress(const FeederInfo::System& info, const nc_outputs& now, std::uint64_t lines) {
  const bool idle = now.state == NC_STATE_IDLE;
  RunProgress progress;
  if (idle || !info.ended) progress.main_line = info.main_line;
  if (now.source.depth == 0 && !idle) progress.main_line = std::max(progress.main_line, now.source.line);
  progress.percent = idle && info.ended ? 100 : percent_done(progress.main_line, lines);
  return progress;
}

namespace {

std::string state_alone(const nc_outputs& outputs) {
  switch (outputs.state) {
    case NC_STATE_IDLE:
      return "idle";
    case NC_STATE_HOLD:
      return "feed hold";
    case NC_STATE_ALARM:
      return "alarm";
    case NC_STATE_MANUAL:
      return "manual";
    default:
      break;
  }
  switch (static_cast<nc_stop_cause>(outputs.cause)) {  // without a default, so that the compiler reports a missing cause
    case NC_CAUSE_FIN: {
      if ((outputs.fin_wait & NC_FIN_WAIT_UNCLAMP) != 0) return "waits for the clamp of an index table";
      std::string text = "waits for FIN of";
      if (outputs.strobe == 0) {  // FIN1 stays on, or a FIN is on before the strobe; then the code may not have been given out yet
        for (unsigned group = 0; group < 4; ++group)
          if (outputs.fin_wait >> group & 1) append(&text, " %c", "MSTB"[group]);
        return outputs.fin_wait == 0 ? "waits for FIN to go off" : text + " to go off";
      }
      if (outputs.fin_wait & 1) append(&text, " M%02u", outputs.m);
      if (outputs.fin_wait & 2) append(&text, " S%.0f", outputs.s);
      if (outputs.fin_wait & 4) append(&text, " T%u", outputs.t);
      if (outputs.fin_wait & 8) append(&text, " B%u", outputs.b);
      return text;
    }
    case NC_CAUSE_DWELL:
      return "dwell";
    case NC_CAUSE_IN_POSITION:
      return "in-position check";
    case NC_CAUSE_PROGRAM_STOP:
      return "program stop";
    case NC_CAUSE_SINGLE_BLOCK:
      return "block stop";
    case NC_CAUSE_INTERLOCK:
      return "interlock";
    case NC_CAUSE_OVERRIDE_ZERO:
      return "override 0 %";
    case NC_CAUSE_STARVED:
      return "waits for blocks";
    case NC_CAUSE_FEED_ZERO:
      return "104 F1 to F5 is 0";
    case NC_CAUSE_RESTART:
      return outputs.restart_axes != 0 ? "at the place of restart, axes away" : "at the place of restart";
    case NC_CAUSE_MANUAL_FEED_ZERO:
      return "dry run: the manual feed rate is 0";
    case NC_CAUSE_SPINDLE_STOPPED:
      return "105 spindle stopped";
    case NC_CAUSE_SPINDLE_ANGLE:
      return "waits for the spindle";
    case NC_CAUSE_SPINDLE_FAST:
      return "thread feed too high";
    case NC_CAUSE_SERVO_OFF:
      return "C axis without its servo";
    case NC_CAUSE_TAP_SPINDLE:
      return "1026 spindle of a tap";
    case NC_CAUSE_SPINDLE_UNMEASURED:
      return "105 spindle speed not measured";
    case NC_CAUSE_NO_LAW:
      return "no motion within the limits of the axes";
    case NC_CAUSE_RESET:
      return "reset";
    case NC_CAUSE_SPINDLE_REVERSED:
      return "thread waits: spindle turns the other way round";
    case NC_CAUSE_TAP_IN_HOLE:
      return "start refused: a tap stands in its hole";
    case NC_CAUSE_MDI_ENDED:
      return "MDI done, program interrupted";
    case NC_CAUSE_FEED_HOLD:
      return "feed hold";
    case NC_CAUSE_ALARM:
      return "alarm";
    case NC_CAUSE_NONE:
      break;
  }
  return outputs.state == NC_STATE_STOPPED ? "stopped" : outputs.rapid ? "rapid" : "running";
}

}  // namespace

std::string state_text(const nc_outputs& outputs) {
  std::string text = state_alone(outputs);
  if (outputs.restart_axes != 0 && outputs.cause != NC_CAUSE_RESTART) text += ", axes away from the path";
  if (outputs.moved_by_hand != 0) text += outputs.manual_absolute ? ", moved by hand" : ", by hand: coordinates shift";
  return text;
}

std::string progress_line(const Runtime& runtime, std::uint64_t lines) {
  const Snapshot snapshot = runtime.snapshot();
  const FeederInfo::System info = runtime.info().system[0];
  const SystemSnapshot& system = snapshot.system[0];
  const nc_system_config& axes = runtime.config().nc.system[0];
  const nc_source& source = system.nc.source;
  std::string text;
  append(&text, "%3u %%  ", run_progress(info, system.nc, lines).percent);
  if (source.depth == 0)
    append(&text, "line %-5u", source.line);
  else
    append(&text, "O%u:%-4u", source.program, source.line);
  for (unsigned a = 0; a < axes.axis_count; ++a)
    append(&text, " %c%9.3f", axes.axis[a].name, axis_shown(system.nc.work.v[a], info.work_turn, a));
  append(&text, "  F%-6.0f S%-6.0f T%-3u ", system.nc.feed_mm_min, system.shown_spindle().rev_per_s * 60, system.nc.t);
  text += state_text(system.nc);
  if (snapshot.alarmed()) text += "  " + runtime.alarm_text(snapshot.alarms.alarm[0]);
  return text;
}

std::string not_read_text(const Config& config) {
  std::string files;
  for (const std::string& path : {config.retain_path(), config.variables_path(), config.offsets_path()}) {
    std::error_code ignored;
    if (path.empty() || !(std::filesystem::exists(path, ignored) || std::filesystem::exists(path + ".old", ignored))) continue;
    files += (files.empty() ? "" : ", ") + path;
  }
  return files.empty() ? ""
                       : "virtual time: retained data is neither read nor written (" + files +
                             "): devices begin with 0, common variables vacant, offsets and parameters as configured";
}

std::string summary_text(const Runtime& runtime, const nc_outputs& last_run, std::int64_t since_ns) {
  const ScanStatistics& statistics = runtime.statistics();
  std::string text;
  append(&text, "cycle time   %.3f s\n", last_run.run_s);
  append(&text, "path length  %.3f mm\n", last_run.path_length);
  append(&text, "blocks       %llu\n", static_cast<unsigned long long>(last_run.blocks));
  if (runtime.first_scan_ns() != 0)
    append(&text, "start-up     %.1f ms to the first scan\n",
           static_cast<double>(runtime.first_scan_ns() - since_ns) / 1e6);
  append(&text, "scans        %llu of %u us, %llu overruns, %llu slots missed\n",
         static_cast<unsigned long long>(statistics.execution.count()), runtime.config().cycle_us,
         static_cast<unsigned long long>(statistics.overruns.load()),
         static_cast<unsigned long long>(statistics.missed_slots.load()));
  append_histogram(&text, "execution time", statistics.execution);
  append_histogram(&text, "wake-up jitter", statistics.jitter);
  return text;
}

void Progress::show(const Runtime& runtime) {
  const std::string line = progress_line(runtime, lines_);
  if (terminal_) {
    std::fprintf(out_, "\r\033[K%.200s", line.c_str());
    std::fflush(out_);
    live_ = true;
    return;
  }
  const Snapshot snapshot = runtime.snapshot();
  const int tenth = std::atoi(line.c_str()) / 10;
  const std::string state =
      snapshot.system[0].nc.state == NC_STATE_RUNNING ? "" : state_text(snapshot.system[0].nc);
  if (tenth == last_tenth_ && state == last_state_) return;
  last_tenth_ = tenth;
  last_state_ = state;
  std::fprintf(out_, "%s\n", line.c_str());
  std::fflush(out_);
}

void Progress::finish() {
  if (!live_) return;
  std::fputc('\n', out_);
  live_ = false;
}

void Progress::note(const std::string& text) {
  finish();
  std::fprintf(out_, "%s\n", text.c_str());
  std::fflush(out_);
}

}  // namespace nc::rt
