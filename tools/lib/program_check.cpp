// SPDX-License-Identifier: Apache-2.0
// See program_check.hpp.
#include "tools/lib/program_check.hpp"

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <utility>

#include "runtime/alarm_message.hpp"
#include "runtime/nc_system.hpp"
#include "runtime/retain/tables.hpp"
#include "runtime/retain/variables.hpp"
#include "tools/lib/item_source.hpp"
#include "tools/lib/offline_run.hpp"
#include "tools/lib/program_files.hpp"
#include "tools/lib/virtual_world.hpp"
#include "tools/lib/way_out.hpp"

namespace nc::tools {
namespace {

using rt::services::CheckAlarm;
using rt::services::CheckOrder;
using rt::services::CheckReport;
using rt::services::CheckState;

constexpr std::size_t kAlignment = 64;
constexpr uint32_t kLookAhead = 1024;          // records of the ring, which nothing is planned in here
constexpr uint64_t kMostSilentBlocks = 1'000'000;
constexpr unsigned kPlacesOfCurve = 64;        // places of a curve at which its extents are taken
constexpr std::size_t kMostLookedBehind = 1u << 20;  // bytes of a program that is read again without the lines of its alarms
constexpr double kBehindSeconds = 5;           // processor time for that
constexpr unsigned kItemsPerLook = 256;        // between two looks at the clock
// Behind the rounds of a loop that has no end by what is written.
constexpr const char* kCounts = " are good, in which it comes to new values each time: later ones are not checked";
constexpr double kRoom = 1e-6;                 // mm, deg: so far an axis may be beyond its limit by rounding
constexpr uint32_t kAsks = NC_SYNC_INPUT | NC_SYNC_CLOCK | NC_SYNC_SKIP;  // what only the machine knows

// Processor time of this thread, s: a thread that nobody lets run has not checked for longer.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

int64_t local_ms() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  return localtime_r(&now, &local) == nullptr ? 0 : (int64_t{now} + local.tm_gmtoff) * 1000;
}

struct FreeMemory {
  void operator()(void* memory) const { std::free(memory); }
};

// The extents of a program, what its moves take beyond the clock of the virtual world, and what it asks.
class CheckSink final : public RunSink {
 public:
  CheckSink(const nc_system_config& axes, ControlSource* items, const ProgramFiles& files, const CheckOrder& order, const std::atomic<bool>& given_up, CheckReport* report)
      : axes_(axes), items_(*items), files_(files), order_(order), given_up_(given_up), report_(*report), end_s_(thread_seconds() + order.limit_s) {
    for (unsigned a = 0; a < axes_.axis_count; ++a) least_[a] = std::numeric_limits<double>::infinity(), most_[a] = -least_[a];
  }

  void move(const nc_source& source, const nc_move& move) override {
    moved_ = true;
    cover(source, move.machine_start);
    cover(source, move.machine);
    if (move.curved || move.kind == NC_MOVE_SPIRAL || move.kind == NC_MOVE_EXPONENTIAL || move.kind == NC_MOVE_NURBS || move.kind == NC_MOVE_SPLINE || move.center_axes == 3) cover_curve(source);
    else if (move.center_axes == 2) cover_circle(source, move);
    extra_s_ += seconds_beyond(move);
  }
  void block(const nc_source& source, const nc_axes&, const nc_axes&) override {
    if (source.depth == 0) main_file_ = source.file;
    else calls_itself_ |= source.file == main_file_;
    last_ = source;
  }
  void aux(const nc_source&, char code, double value) override {
    const auto tool = static_cast<uint32_t>(value);
    if (code != 'T' || report_.tools.size() >= CheckReport::kMostTools || std::find(report_.tools.begin(), report_.tools.end(), tool) != report_.tools.end()) return;
    report_.tools.push_back(tool);
  }
  void sync(const nc_source& source, uint32_t what) override {
    if ((what & kAsks) != 0) asks(source);
  }
  void alarm(const nc_alarm& alarm) override {
    ended_by_ = alarm.source;
    add({alarm.code, rt::alarm_message(alarm), program_of(alarm.source), alarm.source.line, false});
  }
  // The time of the check is over, or nobody wants it any more.
  bool is_over() const { return given_up_ || thread_seconds() >= end_s_; }
  bool stop() const override {
    if (++looks_ % kItemsPerLook != 0) return stopped_;
    return stopped_ = is_over();
  }

  // The machine decides from this block on.
  void asks(const nc_source& source) {
    if (asked_) return;
    asked_ = true;
    report_.asks_line = source.line;
    report_.asks_program = program_of(source);
  }
  bool asked() const { return asked_; }
  bool refused() const { return refused_; }
  // The line of the main program whose alarm has ended it; 0 = none.
  std::uint32_t alarm_line() const { return ended_by_.depth == 0 ? ended_by_.line : 0; }
  // A sub program stands in the text of the main program.
  bool calls_itself() const { return calls_itself_; }
  const nc_source& last() const { return last_; }
  double extra_seconds() const { return extra_s_; }
  void finish() const {
    for (unsigned a = 0; moved_ && a < axes_.axis_count; ++a) report_.axes.push_back({axes_.axis[a].name, least_[a], most_[a]});
  }
  std::string program_of(const nc_source& source) const {
    const std::string path = files_.path_of(source.file);
    return source.depth == 0 || path.empty() ? order_.name : rt::valid_utf8(path.substr(path.rfind('/') + 1));
  }

 private:
  void add(CheckAlarm alarm) {
    refused_ |= !asked_;
    if (report_.alarms.size() < CheckReport::kMostAlarms) report_.alarms.push_back(std::move(alarm));
  }

  void cover(const nc_source& source, const nc_axes& at) {
    for (unsigned a = 0; a < axes_.axis_count; ++a) cover_axis(source, a, at.v[a]);
  }
  void cover_axis(const nc_source& source, unsigned a, double at) {
    least_[a] = std::min(least_[a], at);
    most_[a] = std::max(most_[a], at);
    const nc_axis_config& axis = axes_.axis[a];
    if (!axis.soft_limited) return;
    for (const bool low : {true, false}) {
      const bool beyond = low ? at < axis.soft_min - kRoom : at > axis.soft_max + kRoom;
      if (!beyond || told_[a][low ? 0 : 1]) continue;
      told_[a][low ? 0 : 1] = true;
      char text[96];
      std::snprintf(text, sizeof text, "axis %c goes to %.3f, beyond its limit %.3f", axis.name, at, low ? axis.soft_min : axis.soft_max);
      add({"", text, program_of(source), source.line, false});
    }
  }

  void cover_curve(const nc_source& source) {
    nc_axes at{};
    for (unsigned i = 1; i < kPlacesOfCurve; ++i)
      if (items_.move_point(static_cast<double>(i) / kPlacesOfCurve, &at)) cover(source, at);
  }

  // A circle reaches farthest along an axis of its plane at its quarters, as far as its sweep passes them.
  void cover_circle(const nc_source& source, const nc_move& move) {
    constexpr double kTurn = 2 * std::numbers::pi;
    const unsigned first = move.plane_axis[0], second = move.plane_axis[1];
    const double begin = std::atan2(move.machine_start.v[second] - move.machine_center[1], move.machine_start.v[first] - move.machine_center[0]);
    const double sweep = move.sweep_deg / 360 * kTurn;
    for (unsigned quarter = 0; quarter < 4; ++quarter) {
      const double way = quarter * kTurn / 4 - begin, ahead = sweep >= 0 ? way - kTurn * std::floor(way / kTurn) : kTurn * std::ceil(way / kTurn) - way;
      if (ahead > std::abs(sweep) && move.turns == 0) continue;
      const double sign = quarter < 2 ? 1 : -1;
      const unsigned axis = quarter % 2 == 0 ? first : second;
      cover_axis(source, axis, move.machine_center[quarter % 2] + sign * move.radius);
    }
  }

  // The virtual world counts rapid moves with its own rate and cuts with the feed of their block. The axes decide how long a rapid move takes, from rest to rest,
  // and clamp a cut.
  double seconds_beyond(const nc_move& move) const {
    constexpr double kCounted = 10'000.0 / 60;  // mm/s
    const bool rapid = move.kind == NC_MOVE_RAPID;
    double counted = rapid ? move.length / kCounted : move.feed_mm_min > 0 && move.feed_mm_rev == 0 ? move.length / move.feed_mm_min * 60 : 0;
    double longest = rapid ? 0 : counted, acceleration = std::numeric_limits<double>::infinity();
    for (unsigned a = 0; a < axes_.axis_count; ++a) {
      const nc_axis_config& axis = axes_.axis[a];
      const double way = std::abs(move.machine.v[a] - move.machine_start.v[a]);
      if (way == 0) continue;
      double speed = rapid && axis.rapid > 0 ? axis.rapid : axis.max_velocity;
      if (!(speed > 0)) speed = kCounted;
      if (axis.max_acceleration > 0) acceleration = std::min(acceleration, axis.max_acceleration / speed);
      // From rest to rest; below the speed that it reaches an axis accelerates on half its way.
      const double ramp = rapid && axis.max_acceleration > 0 ? speed / axis.max_acceleration : 0;
      const double seconds = ramp > 0 && way < speed * ramp ? 2 * std::sqrt(way / axis.max_acceleration) : way / speed + ramp;
      longest = std::max(longest, seconds);
    }
    return longest - counted;
  }

  const nc_system_config& axes_;
  ControlSource& items_;
  const ProgramFiles& files_;
  const CheckOrder& order_;
  const std::atomic<bool>& given_up_;
  CheckReport& report_;
  const double end_s_;
  mutable unsigned looks_ = 0;
  mutable bool stopped_ = false;
  bool asked_ = false, refused_ = false, moved_ = false, calls_itself_ = false;
  std::uint32_t main_file_ = 0;
  nc_source last_{}, ended_by_{};
  double least_[NC_MAX_AXES], most_[NC_MAX_AXES], extra_s_ = 0;
  bool told_[NC_MAX_AXES][2] = {};
};

constexpr std::size_t kHead = 1u << 20;  // bytes of a program in which it is looked for what it decides

// The text of the main program as far as has_decision() is to see it: what a large program decides would be found too late for a check of bounded time.
std::string head_of(rt::ProgramText* text) {
  std::string head(static_cast<std::size_t>(std::min<uint64_t>(text->size(), kHead)), '\0');
  const long count = text->read(0, head.data(), head.size());
  head.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return head;
}

// Takes the contents of a line away, from 1; its end stays, so that the other lines keep their numbers. False when there is nothing to be taken away.
bool blank_line(std::string* text, std::uint32_t line) {
  std::size_t begin = 0;
  for (std::uint32_t n = 1; n < line && begin != std::string::npos; ++n) begin = text->find('\n', begin) == std::string::npos ? std::string::npos : text->find('\n', begin) + 1;
  if (line == 0 || begin == std::string::npos) return false;
  const std::size_t end = std::min(text->find('\n', begin), text->size());
  if (begin == end) return false;
  text->erase(begin, end - begin);
  return true;
}

class Check {
 public:
  Check(const rt::Config& config, const MachineTables& machine, const CheckOrder& order, const std::atomic<bool>& given_up)
      : config_(config), machine_(machine), order_(order), given_up_(given_up), files_(config.programs_folder(), config.program_text) {
    files_.set_stop([this] { return cut_here(); });
  }

  CheckReport run() {
    struct stat info {};
    (void)stat(order_.path.c_str(), &info);
    report_.files.push_back({order_.path, info});
    for (const std::string& folder : {config_.programs_folder(), config_.external_folder()})
      if (struct stat of_folder{}; !folder.empty() && stat(folder.c_str(), &of_folder) == 0) folders_.push_back({folder, of_folder});
    if (!machine_.known) return unchecked("the tables of the control cannot be read now");
    if (!make_control() || !open()) return report_;
    items_ = std::make_unique<ControlSource>(control_, static_cast<nc_dialect>(config_.nc.dialect), order_.system);
    sink_ = std::make_unique<CheckSink>(config_.nc.system[order_.system], items_.get(), files_, order_, given_up_, &report_);
    nc_device_on_read(control_, &Check::read_device, this);
    Setup setup;
    setup.start = machine_.position[order_.system];
    setup.clock_ms = local_ms();
    VirtualWorld world(setup, config_.nc.system[order_.system]);
    world.spindle_may_turn();
    RoundLimits rounds;
    rounds.never_ends = [this](const nc_source& to, uint32_t from) { return never_ends(to.line, from); };
    const RunResult result = run_offline(items_.get(), &world, sink_.get(), [this] { return has_decision(head_of(files_.text_of(file_).get())); }, kMostSilentBlocks, true, {}, LoopLimits{}, rounds);
    report_.seconds = std::max(0.0, result.seconds + sink_->extra_seconds());
    report_.length = result.length;
    report_.blocks = result.blocks;
    sink_->finish();
    note_files();
    judge(result);
    return report_;
  }

  // Behind run(), and not in it, because the stack of its thread is small: reads the program again without the lines of its alarms, as long as that shows
  // others. What is found there may come of the absence of those lines.
  CheckReport look_behind() {
    if (sink_ == nullptr || !sink_->refused()) return report_;
    std::ifstream file(order_.path, std::ios::binary);
    std::string text(kMostLookedBehind + 1, '\0');
    text.resize(static_cast<std::size_t>(file.read(text.data(), static_cast<std::streamsize>(text.size())).gcount()));
    if (text.size() > kMostLookedBehind) return report_;
    const double end = thread_seconds() + std::min(kBehindSeconds, order_.limit_s);
    CheckOrder order = order_;
    for (std::uint32_t line = sink_->alarm_line(); report_.alarms.size() < CheckReport::kMostAlarms && !given_up_ && blank_line(&text, line);) {
      order.limit_s = end - thread_seconds();
      if (order.limit_s <= 0) break;
      const auto next = std::make_unique<Check>(config_, machine_, order, given_up_);
      next->text_ = &text;
      for (CheckAlarm& alarm : next->run().alarms) add_behind(std::move(alarm));
      line = next->sink_ != nullptr ? next->sink_->alarm_line() : 0;
    }
    return report_;
  }

 private:
  void add_behind(CheckAlarm alarm) {
    for (const CheckAlarm& other : report_.alarms)
      if (other.line == alarm.line && other.program == alarm.program && other.code == alarm.code) return;
    alarm.behind = true;
    if (report_.alarms.size() < CheckReport::kMostAlarms) report_.alarms.push_back(std::move(alarm));
  }
  nc_status add_text(std::string* why) {
    const int file = memfd_create("program", MFD_CLOEXEC);
    const bool good = file >= 0 && ::write(file, text_->data(), text_->size()) == static_cast<ssize_t>(text_->size());
    if (good) return files_.add_descriptor(control_, file, order_.name, &file_, why);
    if (file >= 0) ::close(file);
    *why = "there is no memory for it";
    return NC_E_READ;
  }

  CheckReport unchecked(std::string text) {
    report_.text = std::move(text);
    return report_;
  }

  // A control as that of the machine, with what is in its tables now.
  bool make_control() {
    nc_config config = config_.nc;
    config.look_ahead = std::min(config.look_ahead, kLookAhead);
    const std::size_t size = (nc_memory_required(&config) + kAlignment - 1) / kAlignment * kAlignment;
    memory_.reset(std::aligned_alloc(kAlignment, size));
    nc_status status = NC_E_MEMORY;
    if (memory_ != nullptr) control_ = nc_create(&config, memory_.get(), size, &status);
    if (control_ == nullptr || !rt::apply_config(config_, control_).empty()) {
      report_.text = std::string("there is no control to check it with: ") + nc_status_text(status);
      return false;
    }
    const rt::TableRows configured = rt::read_tables(control_, config);
    (void)rt::restore_changes(control_, config, configured, rt::encode_changes(machine_.tables, configured));
    rt::set_variables(control_, machine_.variables);
    for (unsigned s = 0; s < config.system_count; ++s) (void)nc_position_set(control_, rt::api_system(s), &machine_.position[s]);
    return true;
  }

  bool open() {
    files_.set_external(config_.external_folder());
    files_.attach(control_);
    std::string why;
    if ((text_ != nullptr ? add_text(&why) : files_.add(control_, order_.path, &file_, &why)) != NC_OK) {
      if (why.rfind(order_.path + ": ", 0) == 0) why.erase(0, order_.path.size() + 2);
      report_.text = rt::valid_utf8(why);
      return false;
    }
    report_.files.front().info = files_.text_of(file_)->info();
    if (nc_program_select(control_, rt::api_system(order_.system), file_) == NC_OK) return true;
    report_.text = "the control does not take it";
    return false;
  }

  // Of a loop of the main program, by what is written (way_out.hpp).
  bool never_ends(std::uint32_t first, std::uint32_t last) {
    const auto [known, asked] = never_ends_.try_emplace({first, last}, false);
    if (!asked) return known->second;
    const auto dialect = static_cast<nc_dialect>(config_.nc.dialect);
    const auto whole = files_.text_of(file_);
    if (whole->size() > kHead) return false;
    const std::string text = head_of(whole.get());
    if (has_way_out(dialect, text, first, last) || (sink_->calls_itself() && may_not_return(dialect, text))) return false;
    for (const auto& [path, called] : files_.texts())
      if (called != whole && (called->size() > kHead || may_not_return(dialect, head_of(called.get())))) return false;
    return known->second = true;
  }

  void note_files() {
    for (const auto& [path, text] : files_.texts())
      if (path != order_.path) report_.files.push_back({path, text->info()});
    if (report_.files.size() > 1) report_.files.insert(report_.files.end(), folders_.begin(), folders_.end());
  }

  // Between two blocks there may be gigabytes that say nothing, so the time is looked at where they are read as well.
  bool cut_here() {
    if (sink_ != nullptr ? !sink_->is_over() : !given_up_.load()) return false;
    return cut_ = true;
  }

  void judge(const RunResult& result) {
    if (cut_) {
      report_.alarms.clear();  // that it could not be read any further
      report_.text = too_long(result.blocks);
      return;
    }
    const std::string at_asks = report_.asks_program + " line " + std::to_string(report_.asks_line);
    const std::string behind = ": " + at_asks + " asks the machine, and what is behind it may differ there";
    if (sink_->refused()) {
      const CheckAlarm& first = report_.alarms.front();
      report_.state = CheckState::kRefused;
      report_.text = first.program + " line " + std::to_string(first.line) + ": " + (first.code.empty() ? "" : first.code + " ") + first.text;
      return;
    }
    switch (result.how) {
      case RunResult::How::kEnded:
      case RunResult::How::kReset:
      case RunResult::How::kAlarmed:
        report_.state = CheckState::kPassed;
        report_.text = result.one_pass ? "the first pass, behind which M99 begins it again" : "";
        if (!report_.alarms.empty()) report_.text = "up to there" + behind;
        else if (sink_->asked()) report_.text += (report_.text.empty() ? "with every input off" : "; with every input off") + behind;
        return;
      case RunResult::How::kEndless:
        if (sink_->asked()) {
          report_.state = CheckState::kPassed;
          report_.text = "up to a loop that waits for the machine" + behind;
        } else if (result.silent) {
          report_.text = "line " + std::to_string(sink_->last().line) + ": an endless loop, " + std::to_string(kMostSilentBlocks) + " blocks in which nothing happens";
        } else {
          report_.state = CheckState::kPassed;
          report_.text = "it goes on until a reset: " + result.loop + (result.endless_as_written ? kCounts : "");
        }
        return;
      case RunResult::How::kStopped:
        if (!given_up_ && !result.loop.empty() && (result.endless_as_written || sink_->asked())) {
          report_.state = CheckState::kPassed;
          report_.text = result.endless_as_written ? "it goes on until a reset: " + result.loop + kCounts : "up to " + result.loop + behind;
          return;
        }
        report_.text = too_long(result.blocks);
        return;
      case RunResult::How::kFailed: report_.text = result.error; return;
    }
  }

  std::string too_long(std::uint64_t blocks) const {
    return "not checked: too long: " + std::to_string(blocks) + " blocks are good, more took longer than " + std::to_string(static_cast<long long>(std::ceil(order_.limit_s))) + " s of processor time";
  }

  // M700 13.5.5: a device of the ladder, which the machine alone knows.
  static void read_device(void* self, unsigned, uint32_t, uint32_t* value) {
    auto& check = *static_cast<Check*>(self);
    *value = 0;
    check.sink_->asks(check.sink_->last());
  }

  const rt::Config& config_;
  const MachineTables& machine_;
  const CheckOrder& order_;
  const std::atomic<bool>& given_up_;
  const std::string* text_ = nullptr;  // that is checked in place of the file; null = the file
  ProgramFiles files_;
  bool cut_ = false;  // a text was not read to its end (cut_here())
  std::vector<CheckReport::File> folders_;  // in which called programs are looked for, as they were before that
  CheckReport report_;
  std::unique_ptr<void, FreeMemory> memory_;
  nc_control* control_ = nullptr;
  unsigned file_ = 0;
  std::unique_ptr<ControlSource> items_;
  std::unique_ptr<CheckSink> sink_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> never_ends_;  // of the loops that were asked for
};

}  // namespace

MachineTables machine_tables(rt::Runtime* runtime) {
  struct Copy {
    rt::TableRows tables;
    std::string variables;
  };
  const auto copy = std::make_shared<Copy>();
  MachineTables machine;
  machine.known = runtime->look([copy, &config = runtime->config().nc](nc_control* control) {
    copy->tables = rt::executed_tables(control, config);
    copy->variables = rt::executed_variables(control);
  }) == rt::Answer::kDone;
  if (!machine.known) return machine;
  machine.tables = std::move(copy->tables);
  machine.variables = std::move(copy->variables);
  const rt::Snapshot now = runtime->snapshot();
  for (unsigned s = 0; s < runtime->config().nc.system_count; ++s) machine.position[s] = now.system[s].nc.command;
  return machine;
}

rt::services::CheckReport check_program(const rt::Config& config, const MachineTables& machine, const CheckOrder& order, const std::atomic<bool>& given_up) {
  Check check(config, machine, order, given_up);
  (void)check.run();
  return check.look_behind();
}

}  // namespace nc::tools
