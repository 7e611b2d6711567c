// SPDX-License-Identifier: Apache-2.0
// The runtime: creation, threads, commands. See runtime.hpp.
#include "runtime/runtime.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "hal/drive_fault.hpp"
#include "runtime/alarm_message.hpp"
#include "runtime/nc_system.hpp"
#include "runtime/power/power_text.hpp"
#include "runtime/retain/ladder_data.hpp"
#include "runtime/retain/place.hpp"
#include "runtime/retain/tables.hpp"
#include "runtime/retain/tool_label_data.hpp"
#include "runtime/retain/variables.hpp"

namespace nc::rt {
namespace {

constexpr std::size_t kControlAlignment = 64;
constexpr std::uint32_t kNoCode = ~0u;
constexpr unsigned kAnswerSteps = 100;  // on virtual time: number of scans within which an answer must come
constexpr auto kAnswerTime = std::chrono::milliseconds(500);  // in real time: time within which the scan must answer
constexpr auto kFeederTime = std::chrono::seconds(10);  // the same for the feeder, which reads files and may wait for one that is being written (ProgramText)

// The groups that wait, such as "M6" or "M3 S". M or T is shown with its code when the code has been given out.
std::string fin_groups(std::uint32_t groups, std::uint32_t code) {
  std::string text;
  bool coded = false;
  for (unsigned g = 0; g < 4; ++g) {
    if ((groups >> g & 1u) == 0) continue;
    if (!text.empty()) text += ' ';
    text += "MSTB"[g];
    if (!coded && code != kNoCode && (g == 0 || g == 2)) {
      text += std::to_string(code);
      coded = true;
    }
  }
  return text;
}

// What is wrong with the handshake of FIN or of a clamp, as a sentence.
std::string fin_fault_text(std::uint32_t fault, std::uint32_t code) {
  if (fault == kNotUnclamped) return "The index table is not unclamped";
  if (fault == kNotClamped) return "The index table is not clamped";
  if (fault == kNoClampHere) return "The index table stands where it cannot be clamped: move it on";
  const std::string groups = fin_groups(fault & kFinGroups, code);
  std::string which;
  unsigned count = 0;
  const auto add = [&](bool on, const char* name) {
    if (!on) return;
    which += (count++ == 0 ? "" : " and ") + std::string(name);
  };
  constexpr const char* kOwn[] = {"MFIN", "SFIN", "TFIN", "BFIN"};
  for (unsigned g = 0; g < 4; ++g) add((fault & kFinOwn) != 0 && (fault >> g & 1u) != 0, kOwn[g]);
  add((fault & kFinOne) != 0, "FIN1");
  add((fault & kFinTwo) != 0, "FIN2");
  const bool both = count > 1;
  if ((fault & kFinStays) != 0) return which + (both ? " do" : " does") + " not go off: " + groups + " is done, and the program waits for that";
  if ((fault & kFinEarly) != 0)
    return which + (both ? " were" : " was") + " on before the strobe: " + groups + " waits until " +
           (both ? "they have" : "it has") + " been off";
  return "FIN does not come: " + groups;
}

}  // namespace

void Runtime::FreeMemory::operator()(void* memory) const {
  std::free(memory);
}

Runtime::Runtime(const Config& config, const RuntimeParts& parts) : config_(config), parts_(parts) {
  if (parts_.ladder == nullptr) parts_.ladder = &empty_ladder_;
  tool_labels_.replace(configured_labels(config));
}

std::unique_ptr<Runtime> Runtime::create(const Config& config, const RuntimeParts& parts,
                                         std::vector<ConfigError>* errors) {
  std::unique_ptr<Runtime> runtime(new Runtime(config, parts));
  // The ladder program is compiled even when the control cannot be made, so that all mistakes are reported at once.
  bool good = parts.nc != nullptr || runtime->make_control(errors);
  if (parts.ladder == nullptr && !config.ladder.program.empty()) {
    runtime->own_ladder_ = LadderTask::create(config, errors);
    good = good && runtime->own_ladder_ != nullptr;
  }
  if (!good) return nullptr;
  for (const ParameterSetting& parameter : config.parameters)
    if (!nc_parameter_used(static_cast<nc_dialect>(config.nc.dialect), parameter.key.c_str()))
      runtime->warnings_.push_back(ConfigError{config.file, parameter.place.line, parameter.place.key,
                                               "nothing in the control asks for this parameter: it is kept for programs that read it"}.text());
  nc_parameter_note note;
  for (unsigned s = 0; runtime->control_ != nullptr && s < config.nc.system_count; ++s)
    for (unsigned i = 0; nc_parameter_note_row(runtime->control_, api_system(s), i, &note) == NC_OK; ++i)
      runtime->warnings_.push_back(parameter_note_text(config, s, note));
  for (const std::string& warning : spindle_warnings(config)) runtime->warnings_.push_back(warning);
  for (const std::string& warning : power_warnings(config)) runtime->warnings_.push_back(warning);
  if (runtime->own_ladder_ != nullptr) {
    runtime->parts_.ladder = runtime->own_ladder_.get();
    for (const std::string& warning : runtime->own_ladder_->warnings()) runtime->warnings_.push_back(warning);
  }
  runtime->board_ = std::make_unique<SignalBoard>(config, runtime->parts_.ladder, runtime->own_ladder_.get());
  runtime->trace_ = std::make_unique<trace::TraceTap>(config, runtime->board_.get(), runtime->own_ladder_.get());
  runtime->parts_.ladder = runtime->trace_.get();
  if (runtime->control_ != nullptr && runtime->own_ladder_ != nullptr)
    nc_device_on_read(runtime->control_, &Runtime::read_device, runtime.get());
  runtime->scan_ =
      std::make_unique<Scan>(config, parts.clock, parts.hal, runtime->parts_.ladder, runtime->parts_.nc);
  runtime->feeder_ =
      std::make_unique<Feeder>(config.nc.system_count, runtime->parts_.nc, runtime->scan_.get());
  return runtime;
}

bool Runtime::make_control(std::vector<ConfigError>* errors) {
  nc_config_fault fault;
  if (nc_config_check(&config_.nc, &fault) != NC_OK) {
    errors->push_back({config_.file, 0, "", std::string("the control refuses ") + fault.field + ": " + fault.reason});
    return false;
  }
  const std::size_t size = nc_memory_required(&config_.nc);
  const std::size_t rounded = (size + kControlAlignment - 1) / kControlAlignment * kControlAlignment;
  memory_.reset(std::aligned_alloc(kControlAlignment, rounded));
  nc_status status = NC_E_MEMORY;
  if (memory_ != nullptr) control_ = nc_create(&config_.nc, memory_.get(), rounded, &status);
  if (control_ == nullptr) {
    errors->push_back({config_.file, 0, "",
                       "the control cannot be made in " + std::to_string(rounded) + " bytes: " + nc_status_text(status)});
    return false;
  }
  std::vector<ConfigError> refused = apply_config(config_, control_);
  errors->insert(errors->end(), refused.begin(), refused.end());
  if (!refused.empty()) return false;
  own_nc_ = std::make_unique<LibNc>(control_, config_.nc);
  parts_.nc = own_nc_.get();
  return true;
}

Runtime::~Runtime() {
  stop();
  if (wake_fd_ >= 0) close(wake_fd_);
}

bool Runtime::bring_up(std::string* error) {
  hal::PointImage initial;
  for (unsigned p = 0; p < config_.points.size(); ++p) initial.value[p] = config_.points.at(p).initial;
  if (parts_.hal->start(initial, error)) return true;
  parts_.hal->stop();
  return false;
}

// ---- virtual time ----

bool Runtime::start_stepping(std::string* error) {
  if (!bring_up(error)) return false;
  scan_->begin();
  stepping_ = true;
  return true;
}

void Runtime::step() {
  feeder_->step();
  save_when_asked();
  scan_->loop_step();
}

// Passes a request of the scan, which may not wake a thread, on to the keeper. On virtual time nothing is kept.
void Runtime::save_when_asked() {
  const std::uint32_t asked = scan_->save_asked();
  if (asked == save_told_) return;
  save_told_ = asked;
  if (keeper_ != nullptr) keeper_->hurry(asked);
  else scan_->save_finished(asked, SaveResult::kNothingKept);
}

// A tap that goes into a hole is written at once: a power cut within the interval would leave it in the work, and the next start would tear it out.
void Runtime::save_new_taps() {
  if (control_ == nullptr || keeper_ == nullptr) return;
  for (unsigned s = 0; s < config_.nc.system_count; ++s) {
    nc_tap tap = NC_INIT(nc_tap);
    if (nc_tap_get(control_, api_system(s), &tap) != NC_OK) continue;
    nc_tap& told = tap_told_[s];
    const bool same = tap.axis == told.axis && tap.entry == told.entry && tap.turns_per_mm == told.turns_per_mm && tap.speed == told.speed && tap.acceleration == told.acceleration &&
                      tap.spindles == told.spindles && tap.encoder == told.encoder;
    told = tap;
    if (!same && tap.axis != 0) keeper_->wake();
  }
}

// ---- real time ----

bool Runtime::start(std::string* error) {
  if (wake_fd_ < 0) wake_fd_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);  // kept from one start to the next
  if (wake_fd_ < 0) {
    *error = std::string("eventfd: ") + std::strerror(errno);
    return false;
  }
  if (!bring_up(error)) return false;
  stop_scan_ = stop_feeder_ = false;
  keeper_ = std::make_unique<RetainKeeper>(static_cast<unsigned>(config_.retain_every_s * 1000),
      [this](unsigned detail, bool begins) {
        if (begins) scan_->post_retain_trouble(detail);
        else scan_->end_retain_trouble(detail);
      },
      [this] { return scan_->retain_loss_seen(); }, [this](std::uint32_t request, SaveResult result) { scan_->save_finished(request, result); });
  nc_variable_range local{};
  if (control_ != nullptr && config_.services.enabled && nc_variable_kind_get(nc_control_dialect(control_), NC_VARIABLES_LOCAL, &local) == NC_OK) writers_ = std::make_unique<WriterTable>(local);
  feeder_->set_writers(writers_.get());
  if (own_ladder_ != nullptr && !config_.retain_path().empty())
    keeper_->add(0, std::make_unique<LadderData>(own_ladder_.get()), config_.retain_path());
  if (control_ != nullptr && !config_.variables_path().empty())
    keeper_->add(1, std::make_unique<VariableData>(control_, feeder_.get(), config_.not_kept), config_.variables_path());
  if (control_ != nullptr && !config_.offsets_path().empty())
    keeper_->add(2, std::make_unique<TableData>(control_, config_.nc, feeder_.get()), config_.offsets_path());
  if (!config_.offsets_path().empty())
    keeper_->add(5, std::make_unique<ToolLabelData>(&tool_labels_, config_.nc.tool_offsets, configured_labels(config_)), config_.offsets_path() + ".tools");
  if (writers_ != nullptr && !config_.changes_path().empty()) keeper_->add(kRetainedData, std::make_unique<WriterData>(writers_.get()), config_.changes_path() + ".programs");
  PlaceData* places = nullptr;
  if (control_ != nullptr && !config_.place_path().empty()) {
    auto data = std::make_unique<PlaceData>(feeder_.get(), scan_.get());
    places = data.get();
    keeper_->add(3, std::move(data), config_.place_path());
  }
  if (control_ != nullptr && !config_.place_path().empty()) keeper_->add(4, std::make_unique<StopData>(feeder_.get()), config_.place_path() + ".stops");
  keeper_->restore(&warnings_);
  if (places != nullptr && !places->found().empty()) {
    found_place_ = place_text(places->found(), config_.nc.system_count > 1);
    scan_->post_found_place();
    feeder_->set_stops(places->found());
  }
  feeder_->step();  // reads the first blocks before the first scan
  if (!feeder_thread_.start([this] { feeder_thread(); }, error)) {
    parts_.hal->stop();
    return false;
  }
  running_ = true;
  if (!scan_thread_.start([this] { scan_thread(); }, error)) {
    stop();
    return false;
  }
  if (!keeper_->start(error)) {
    stop();
    return false;
  }
  // Memory is locked last, when all stacks and buffers exist.
  if (config_.scheduling.lock_memory) lock_memory(&warnings_);
  while (!thread_warnings_ready_.load(std::memory_order_acquire))
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  return true;
}

void Runtime::stop() {
  if (running_) {
    stop_scan_ = true;
    scan_thread_.join();
    stop_feeder_ = true;
    wake_feeder();
    feeder_thread_.join();
    running_ = false;
    parts_.hal->stop();
    keeper_->stop();  // writes the data that the last scan has left
  } else if (stepping_) {
    stepping_ = false;
    parts_.hal->stop();
  }
}

void Runtime::scan_thread() {
  promote_scan_thread(config_.scheduling, &thread_warnings_);
  scan_->begin();
  scan_->loop_step();
  first_scan_ns_ = RealClock().now_ns();
  thread_warnings_ready_.store(true, std::memory_order_release);
  while (!stop_scan_.load(std::memory_order_relaxed)) scan_->loop_step();
}

void Runtime::feeder_thread() {
  sharpen_timers();
  const long period_ns = static_cast<long>(config_.scheduling.feeder_us) * 1000;
  while (!stop_feeder_.load(std::memory_order_relaxed)) {
    feeder_->step();
    save_when_asked();
    save_new_taps();
    pollfd wake{wake_fd_, POLLIN, 0};
    const timespec timeout{0, period_ns};
    if (ppoll(&wake, 1, &timeout, nullptr) <= 0) continue;
    std::uint64_t count = 0;
    if (read(wake_fd_, &count, sizeof count) < 0) continue;  // the counter was 0 already
  }
  feeder_->step();  // takes the events of the last scans
  feeder_->note_writers();
}

void Runtime::wake_feeder() {
  const std::uint64_t one = 1;
  if (wake_fd_ >= 0 && write(wake_fd_, &one, sizeof one) < 0) return;  // the counter is full, so the feeder is awake already
}

std::vector<std::string> Runtime::warnings() const {
  std::vector<std::string> all = warnings_;
  if (thread_warnings_ready_.load(std::memory_order_acquire))
    all.insert(all.end(), thread_warnings_.begin(), thread_warnings_.end());
  return all;
}

// ---- commands ----

bool Runtime::find_answer(std::uint64_t ticket, bool from_feeder, Answer* answer) {
  CommandAnswer found;
  while (from_feeder ? feeder_->poll_answer(&found) : scan_->poll_answer(&found)) {
    if (found.ticket != ticket) continue;  // the answer to an earlier command that was given up
    *answer = found.answer;
    return true;
  }
  return false;
}

// What a start begins is looked at before it: the files that its program calls may have been changed a moment ago, and a check that has just come to its end
// may not have been told to the scan. Without operator_, because the disk may take its time.
bool Runtime::is_still_checked() {
  if (gate_ == nullptr) return true;
  const StartGate::Looked looked = gate_->look_again();
  if (looked == StartGate::Looked::kNoAnswer) return false;
  if (looked == StartGate::Looked::kDoubtful || scan_->any_not_checked()) (void)look([](nc_control*) {});  // behind this step of the feeder the scan knows of it
  return true;
}

static std::uint32_t systems_of(unsigned system, unsigned count) { return system == kAllSystems ? (1u << count) - 1 : 1u << system; }

std::uint64_t Runtime::ask_hold(unsigned system) {
  const unsigned count = config_.nc.system_count;
  if (!running_ || (system != kAllSystems && system >= count)) return 0;
  return scan_->hold_door().ask(systems_of(system, count));
}

Answer Runtime::await_hold(std::uint64_t number, unsigned system) {
  const auto give_up = std::chrono::steady_clock::now() + kAnswerTime;
  while (!scan_->hold_door().is_answered(number, systems_of(system, config_.nc.system_count))) {
    if (std::chrono::steady_clock::now() > give_up) return Answer::kNoAnswer;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return Answer::kDone;
}

bool Runtime::has_stood(std::uint64_t number, unsigned system) const { return scan_->hold_door().has_stood(number, systems_of(system, config_.nc.system_count)); }

Answer Runtime::execute(Command command) {
  if (const std::uint64_t hold = command.kind == CommandKind::kFeedHold ? ask_hold(command.system) : 0; hold != 0) return await_hold(hold, command.system);
  command.holds = std::min(command.holds, holds());
  if (command.kind == CommandKind::kCycleStart && !is_still_checked()) return Answer::kNotChecked;
  const std::lock_guard lock(operator_);
  return execute_alone(command);
}

Answer Runtime::execute_alone(Command command) {
  if (!running_ && !stepping_) return Answer::kNoAnswer;
  command.ticket = next_ticket_++;
  const bool feeder = for_feeder(command.kind);
  if (!(feeder ? feeder_->post(command) : scan_->post(command))) return Answer::kQueueFull;
  Answer answer = Answer::kNoAnswer;
  if (stepping_) {
    for (unsigned i = 0; i < kAnswerSteps; ++i) {
      step();
      if (find_answer(command.ticket, feeder, &answer)) break;
    }
    return answer;
  }
  wake_feeder();
  auto give_up = std::chrono::steady_clock::now() + (feeder ? kFeederTime : kAnswerTime);
  bool taken_back = false;
  while (!find_answer(command.ticket, feeder, &answer)) {
    if (std::chrono::steady_clock::now() > give_up) {
      if (!feeder || taken_back || feeder_->take_back(command.ticket)) return Answer::kNoAnswer;
      taken_back = true;  // the feeder is executing the command already, so its answer is waited for
      give_up += kAnswerTime;
    }
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return answer;
}

Answer Runtime::execute(CommandKind kind, double value, std::uint32_t number) {
  Command command;
  command.kind = kind;
  if (takes_all_systems(kind)) command.system = kAllSystems;
  command.value = value;
  command.number = number;
  return execute(command);
}

static Command command_of(CommandKind kind, unsigned system, std::uint32_t number = 0) {
  Command command;
  command.kind = kind;
  command.system = static_cast<std::uint8_t>(system);
  command.number = number;
  return command;
}

Answer Runtime::load_mdi(const std::string& text, unsigned system) {
  const std::lock_guard lock(operator_);
  feeder_->set_mdi_text(text);
  return execute_alone(command_of(CommandKind::kLoadMdi, system));
}

Answer Runtime::select_program(unsigned system, const std::string& name) {
  const std::lock_guard lock(operator_);
  feeder_->set_program_name(name);
  return execute_alone(command_of(CommandKind::kSelectProgram, system, kProgramByName));
}

Answer Runtime::find_restart(unsigned system, const RestartWish& wish) {
  const std::lock_guard lock(operator_);
  feeder_->set_restart_wish(wish);
  return execute_alone(command_of(CommandKind::kFindRestart, system));
}

Answer Runtime::with_job(CommandKind kind, ControlJob job) {
  const std::lock_guard lock(operator_);
  feeder_->set_job(std::move(job));
  Command command;
  command.kind = kind;
  return execute_alone(command);
}

Answer Runtime::look(ControlJob job) {
  return with_job(CommandKind::kLook, std::move(job));
}

Answer Runtime::change(ControlJob job) {
  return with_job(CommandKind::kChange, std::move(job));
}

// Does something with a device of the ladder; `find` gives its number, or -1 with the reason in refused_.
Answer Runtime::act_on_device(CommandKind kind, std::int64_t value, const std::function<std::int64_t()>& find) {
  const std::lock_guard lock(operator_);
  refused_.clear();
  if (own_ladder_ == nullptr) return Answer::kNoLadder;
  const std::int64_t number = find();
  if (number < 0) return Answer::kNoDevice;
  Command command;
  command.kind = kind;
  command.number = static_cast<std::uint32_t>(number);
  command.value = static_cast<double>(static_cast<std::int32_t>(value));
  return execute_alone(command);
}

Answer Runtime::force(const std::string& device, std::int64_t value) {
  return act_on_device(CommandKind::kForce, value, [&] { return own_ladder_->force_number(device, value, &refused_); });
}

Answer Runtime::write_device(const std::string& device, std::int64_t value) {
  return act_on_device(CommandKind::kWriteDevice, value, [&] { return own_ladder_->write_number(device, value, &refused_); });
}

Answer Runtime::release(const std::string& device) {
  return act_on_device(CommandKind::kRelease, 0, [&] { return device.empty() ? std::int64_t{kAllForces} : own_ladder_->force_number(device, 0, &refused_); });
}

std::string Runtime::forced_name(std::uint32_t number) const {
  return own_ladder_ != nullptr ? own_ladder_->force_name(number) : std::string();
}

std::string Runtime::explain(Answer answer) const {
  std::string text;
  if (answer == Answer::kNotLoaded || answer == Answer::kRefusedByControl || answer == Answer::kNoPlace) text = feeder_->refusal();
  if (answer == Answer::kNoDevice) {
    const std::lock_guard lock(operator_);
    text = refused_;
  }
  if (answer == Answer::kNotChecked && gate_ != nullptr)
    for (unsigned s = 0; s < config_.nc.system_count; ++s) {
      const std::string remark = gate_->remark(s);
      if (!remark.empty()) text += (text.empty() ? "" : "; ") + remark;
    }
  return text.empty() ? answer_text(answer) : text;
}

// M700 13.5.5: reads a device of the ladder for #100100. `code` is the device's code in the manual's table; the rows give its name in the ladder program.
void Runtime::read_device(void* self, unsigned code, std::uint32_t number, std::uint32_t* value) {
  struct Row {
    unsigned code;
    const char* letters;
    bool hexadecimal;
  };
  static constexpr Row kRows[] = {{0, "M", false},   {1, "D", false},  {2, "C", false},  {4, "X", true},   {5, "Y", true},
                                  {6, "R", false},   {7, "T", false},  {9, "SM", false}, {10, "F", false}, {13, "L", false},
                                  {18, "V", false},  {19, "ST", false}, {20, "SD", false}, {21, "SB", true}, {22, "SW", true},
                                  {23, "B", true},   {24, "W", true}};
  auto& runtime = *static_cast<Runtime*>(self);
  *value = 0;
  if (runtime.own_ladder_ == nullptr) return;
  for (const Row& row : kRows) {
    if (row.code != code) continue;
    char name[24];
    std::snprintf(name, sizeof name, row.hexadecimal ? "%s%X" : "%s%u", row.letters, number);
    *value = runtime.own_ladder_->read_device(name, runtime.stepping_);
  }
}

// What the keeper says of the trouble, such as ": common variables are lost and are vacant: ...".
std::string Runtime::retain_text(const ActiveAlarm& alarm) const {
  const std::string why = keeper_ != nullptr ? keeper_->trouble(alarm.detail / 4) : "";
  return why.empty() ? "" : ": " + why;
}

// The fault of the ladder program, such as "mill.il:40: CJ P1: watchdog: ...", with the file named as in the configuration.
std::string Runtime::ladder_fault(const ActiveAlarm& alarm) const {
  if (own_ladder_ == nullptr) return "line " + std::to_string(alarm.detail);
  std::string text = own_ladder_->fault_text(alarm.code, alarm.detail);
  const std::string path = config_.ladder_file();
  if (text.rfind(path, 0) == 0) text.replace(0, path.size(), config_.ladder.program);
  return text;
}

// A line as text. For a line of a sub program it names that program, because its text is not the one that the operator has selected.
static std::string line_text(const nc_source& source) {
  const std::string sub = source.program != 0 ? "O" + std::to_string(source.program) : "sub program";
  return (source.depth != 0 ? sub + ", " : "") + "line " + std::to_string(source.line);
}

static std::string place_text(const nc_source& source) { return source.line == 0 ? "" : " (" + line_text(source) + ")"; }

// The blocks that called the program of the alarm, outermost first, such as ", called by line 12 > O9001, line 4".
static std::string callers_text(const FeederInfo::System& info) {
  std::string text;
  for (std::uint32_t i = 0; i + 1 < info.alarm_calls; ++i) text += (i == 0 ? ", called by " : " > ") + line_text(info.alarm_call[i]);
  return text;
}

// The names of the inputs that were refused, such as ": spindle, measured position".
static std::string bad_input_text(std::uint32_t bits) {
  struct Row {
    std::uint32_t bit;
    const char* name;
  };
  static constexpr Row kRows[] = {{NC_INPUT_FEED_OVERRIDE, "feed override"}, {NC_INPUT_RAPID_OVERRIDE, "rapid override"},
                                  {NC_INPUT_SPINDLE, "spindle"},             {NC_INPUT_ACTUAL, "measured position"},
                                  {NC_INPUT_MANUAL, "manual motion"},             {NC_INPUT_MANUAL_FEED, "manual feed rate"},
                                  {NC_INPUT_SKIP_PLACE, "skip position"},         {NC_INPUT_TOOL_LENGTH, "handle of the tool length"},
                                  {NC_INPUT_TOOL_ANGLE, "angle of the tool"}};
  std::string text;
  for (const Row& row : kRows)
    if ((bits & row.bit) != 0) text += (text.empty() ? ": " : ", ") + std::string(row.name);
  return text;
}

// What the family of the machine calls something that the runtime finds and libnc does not.
struct FamilyAlarm {
  char code[16] = "";
  const char* message = "";
};
static FamilyAlarm family_alarm(const Config& config, nc_alarm_role role) {
  FamilyAlarm alarm;
  (void)nc_alarm_role_get(static_cast<nc_dialect>(config.nc.dialect), role, alarm.code, &alarm.message);
  return alarm;
}

std::string Runtime::alarm_code(AlarmId id) const {
  return id == AlarmId::kPrinter ? family_alarm(config_, NC_ALARM_PRINTER).code : alarm_row(id).code;
}

// ": +"
static const char* limit_text(std::uint32_t detail) {
  return detail == kLimitMinus ? " in -" : detail == kLimitPlus ? " in +" : "es of both ends are on at once: look at their wires";
}

std::string Runtime::alarm_text(const ActiveAlarm& alarm) const {
  if (alarm.id == AlarmId::kProgram) {
    const FeederInfo::System now = info().system[alarm.system];
    if (!now.alarm) return "program alarm";
    return std::string(now.program_alarm.code) + " " + alarm_message(now.program_alarm) + place_text(now.program_alarm.source) + callers_text(now);
  }
  const AlarmRow& row = alarm_row(alarm.id);
  const std::string code = alarm_code(alarm.id);
  std::string text = code + " " + row.text;
  if (alarm.id == AlarmId::kFinTimeout) text = code + " " + fin_fault_text(alarm.detail, alarm.code);
  if (alarm.id == AlarmId::kRetainedLost || alarm.id == AlarmId::kRetainedUnwritable) text += retain_text(alarm);
  if (alarm.id == AlarmId::kPrinter) {
    text = code + " " + family_alarm(config_, NC_ALARM_PRINTER).message + ": " + row.text;
    if (const std::string why = info().system[alarm.system].print_trouble; !why.empty()) text += ": " + why;
  }
  if (alarm.id == AlarmId::kLadder) {
    const std::string& own = config_.ladder.alarm[alarm.detail % config_.ladder.alarm.size()];
    text += " " + std::to_string(alarm.detail + 1) + (own.empty() ? "" : ": " + own);
  }
  if (alarm.id == AlarmId::kLinkLost) {
    const PointBusConfig& bus = config_.buses[alarm.detail % config_.buses.size()];
    text += ": " + bus.name + " (" + bus.device + ")";
  }
  if (alarm.id == AlarmId::kHoming) text += std::string(": ") + homing_fault_text(static_cast<HomingFault>(alarm.detail));
  if (alarm.id == AlarmId::kLimitSwitch) text += limit_text(alarm.detail);
  if (alarm.id == AlarmId::kBadInput) text += bad_input_text(alarm.detail);
  if (alarm.id == AlarmId::kPowerFails) text += ": " + power_text(alarm.detail, alarm.code);
  if (alarm.id == AlarmId::kPowerFailedBefore) text += ": " + found_place_;
  if (alarm.id == AlarmId::kLadderStopped) text += ": " + ladder_fault(alarm);
  if (alarm.id == AlarmId::kDriveFault)
    if (const std::string why = hal::drive_fault_text(alarm.code); !why.empty()) text += ": " + why;
  if (alarm.id == AlarmId::kDriveFault && alarm.detail != 0) text += ", spindle " + std::to_string(alarm.detail);
  if (alarm.axis >= 0) text += std::string(", axis ") + config_.nc.system[alarm.system].axis[alarm.axis].name;
  return text + place_text(alarm.source);
}

}  // namespace nc::rt
