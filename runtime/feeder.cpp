// SPDX-License-Identifier: Apache-2.0
// The feeder. See feeder.hpp.
#include "runtime/feeder.hpp"

#include <algorithm>

#include "runtime/programs/encoding.hpp"
#include "runtime/retain/place.hpp"
#include "runtime/share/program_table.hpp"
#include "runtime/share/text.hpp"

namespace nc::rt {
namespace {

// Between two calls a reset of an endless GOTO is seen, and a hold while something is planned: one takes some milliseconds at most.
constexpr std::uint32_t kBudget = 256;
constexpr auto kWritersEvery = std::chrono::seconds(1);
constexpr std::size_t kMostNameBytes = 127;
constexpr char kMdiWrites[] = "MDI blocks";
constexpr unsigned kCallsPerStep = 8;
constexpr std::chrono::milliseconds kLongRead{100};  // a search for a number goes through gigabytes of a program in one step

const char* status_text(nc_status status) {
  switch (status) {
    case NC_E_STATE:
      return "the control is not ready for another program";
    case NC_E_NOT_FOUND:
      return "the control has no such program";
    case NC_E_READ:
      return "the program cannot be read";
    case NC_E_MEMORY:
      return "the control has no room for the program";
    default:
      return "refused by the control";
  }
}

}  // namespace

Feeder::Feeder(unsigned systems, NcPort* nc, Scan* scan) : systems_(systems), nc_(nc), scan_(scan) {}

FeederInfo Feeder::info() const {
  const std::lock_guard lock(mutex_);
  return info_;
}

bool Feeder::remembers(unsigned file) const {
  return std::any_of(system_, system_ + systems_, [&](const System& system) {
    return (system.selected && !system.mdi && system.file == file) || (system.part && system.part_file == file);
  });
}

void Feeder::set_mdi_text(const std::string& text) {
  const std::lock_guard lock(mutex_);
  mdi_text_ = text;
}

void Feeder::set_program_name(const std::string& name) {
  const std::lock_guard lock(mutex_);
  program_name_ = name;
}

void Feeder::set_job(ControlJob job) {
  const std::lock_guard lock(mutex_);
  job_ = std::move(job);
}

bool Feeder::reads_too_long() const {
  return (leaves_.load(std::memory_order_relaxed) || scan_->reset_waits()) && std::chrono::steady_clock::now() - step_began_ > kLongRead;
}

void Feeder::step() {
  step_began_ = std::chrono::steady_clock::now();
  seen_ = scan_->snapshot();
  take_events();
  feed();
  complete_reset();
  follow_stops();
  rewind_ended();
  restore_parts();
  follow_restart();
  follow_search();
  follow_mdi();
  follow_ladder();
  follow_outputs();
  leave_kept();
  note_writers_in_time();
  CommandAnswer answered[kCommands];
  unsigned answered_count = 0;
  Command command;
  while (answered_count < kCommands && commands_.pop(&command)) {
    seen_ = scan_->snapshot();  // shows what the previous command has changed, even when the scan has executed it
    answered[answered_count++] = {command.ticket, apply(command)};
  }
  PositionSample sample;
  while (scan_->poll_position(&sample))
    if (path_sink_ != nullptr) path_sink_->moved(sample);
  take_messages();
  tell_changes();
  take_alarm();
  take_modal();
  if (!seen_.program_active() && !scan_->reset_waits() && !seen_.stopped_by_alarm()) put_back_searched();
  tell_restart();
  tell_what_is_loaded();
  // The answers come last: a client that is told that its program is selected may start it at once, and by then the scan must know of the program.
  for (unsigned n = 0; n < answered_count; ++n) (void)answers_.push(answered[n]);
}

Scan::Loaded Feeder::at_head(unsigned system) const {
  const System& head = system_[system];
  if (!head.selected) return Scan::kNothingLoaded;
  if (head.mdi) return Scan::kMdiLoaded;
  if (search_[system].step == Search::kChecks && search_[system].sequence != 0) return Scan::kPartNotChecked;  // it is to begin inside, and not at its head
  return gate_ == nullptr || gate_->may_begin(system, head.file) ? Scan::kPartLoaded : Scan::kPartNotChecked;
}

void Feeder::tell_what_is_loaded() {
  std::uint32_t loaded = Scan::kNothingLoaded;
  for (unsigned s = 0; s < systems_; ++s)
    loaded |= std::uint32_t{at_head(s)} << Scan::kLoadedBits * s;
  scan_->set_loaded(loaded);
  const std::lock_guard lock(mutex_);
  for (unsigned s = 0; s < systems_; ++s) info_.system[s].selected = {system_[s].selected, system_[s].mdi, system_[s].file};
}

// When the mode is AUTO again, the part program that was selected before MDI is selected again, at its head. MDI blocks that were not started are
// dropped.
void Feeder::restore_parts() {
  if (seen_.mode != Mode::kAuto || seen_.program_active() || scan_->reset_waits()) return;
  for (unsigned s = 0; s < systems_; ++s) {
    System& system = system_[s];
    if (system.ended || (system.selected && !system.mdi) || (!system.selected && !system.part)) continue;
    if (!system.part) {
      system.clear();
      continue;
    }
    if (ran_.any()) note_writers();
    const nc_status status = nc_->select(s, system.part_file);
    if (status == NC_E_STATE) continue;  // not yet: the next step tries again
    restart_[s].lose("the program was selected again");
    if (status < 0) system = {};
    else system.take_part(system.part_file);
  }
}

// ---- what the ladder asks of the feeder ----

// The optional block skips in force are those of the operator and those of the ladder together. A recalculation is tried again until the
// scan has taken part in it. While the machine moves that cannot happen, and the request is dropped.
void Feeder::follow_ladder() {
  for (unsigned s = 0; s < systems_; ++s) {
    const std::uint32_t wanted = operator_switches_[s] | scan_->skip_switches(s);
    if (wanted != switches_[s]) {
      switches_[s] = wanted;
      nc_->switches(s, wanted);
    }
    const std::uint32_t asked = scan_->recalculations(s);
    if (asked == recalculated_[s]) continue;
    const std::uint8_t state = seen_.system[s].nc.state;
    const bool rests = seen_.system[s].nc.distance_zero && (state == NC_STATE_STOPPED || state == NC_STATE_HOLD);
    if (!rests || nc_->recalculate(s) != NC_WAITING) recalculated_[s] = asked;
  }
}

// Tells the control the macro outputs that were found on the machine (Scan::take_found_outputs). A program that is ready to start may have been read
// ahead with the old values, so it is read again from its head. A program in execution goes on with what it has read.
void Feeder::follow_outputs() {
  std::uint32_t any = 0;
  for (unsigned w = 0; w < NC_WORDS; ++w) {
    std::uint32_t bits = 0;
    const std::uint32_t mask = scan_->take_found_outputs(w, &bits);
    found_bits_[w] = (found_bits_[w] & ~mask) | (bits & mask);
    any |= found_[w] |= mask;
  }
  if (any == 0 || seen_.program_active() || scan_->reset_waits()) return;
  for (unsigned s = 0; s < systems_; ++s)
    for (unsigned w = 0; w < NC_WORDS; ++w)
      if (found_[w] != 0) nc_->outputs(s, w, found_[w], found_bits_[w]);
  if (read_again() != NC_E_STATE) std::fill_n(found_, NC_WORDS, 0u);  // otherwise not yet: the next step tries again
}

// Programs that are ready to start are read again from their heads, because they may have been read ahead with values that are no longer those of the
// control. Nothing can be started until the end of this step. A program that stands in an alarm is left: a reset comes first, which reads it again. `but`: so are
// these part systems.
nc_status Feeder::read_again(std::uint32_t but, const char* why) {
  for (unsigned s = 0; s < systems_; ++s) {
    System& system = system_[s];
    if ((but >> s & 1u) != 0 || !system.selected || system.ended || seen_.system[s].nc.state == NC_STATE_ALARM) continue;
    scan_->set_loaded(Scan::kNothingLoaded);  // until tell_what_is_loaded() at the end of this step
    const nc_status status = system.mdi ? nc_->load_mdi(s, system.blocks.data(), system.blocks.size()) : nc_->select(s, system.file);
    if (status == NC_E_STATE) return status;
    restart_[s].lose(why);
    if (status < 0) system = {};
  }
  return NC_OK;
}

// ---- retained data ----

void Feeder::leave_kept() {
  for (KeptCopy& copy : kept_) {
    if (!copy.wanted.load(std::memory_order_acquire)) continue;
    std::string bytes = copy_of(static_cast<Kept>(&copy - kept_));
    copy.wanted.store(false, std::memory_order_relaxed);
    const std::lock_guard lock(mutex_);
    copy.bytes = std::move(bytes);
    copy.ready = true;
  }
}

// Who has written what is noted with the values that are kept: behind a power cut each value is then the one that its writer is noted with.
std::string Feeder::copy_of(Kept what) {
  if (what == kStops) return stop_bytes();
  if (what == kPlace) return place_bytes();
  if (writers_ != nullptr) take_events();
  std::string variables = kept_variables(), tables = writers_ != nullptr || what == kTables ? kept_tables() : "";
  if (writers_ != nullptr) {
    note_writers_of(variables, tables);
    writers_->keep(what == kVariables);
  }
  return what == kVariables ? std::move(variables) : std::move(tables);
}

// As it is shown, on one line.
std::string Feeder::writer_name(unsigned system) const {
  const System& of = system_[system];
  if (of.mdi || of.mdi_depth >= 0) return kMdiWrites;
  if (!of.selected) return "";
  std::string name = valid_utf8(share::file_name(nc_->program_name(of.file)));
  std::replace_if(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return "program " + std::string(cut_utf8(name, kMostNameBytes));
}

// Who has executed something since the last look: blocks of MDI in a block stop (M700 12.4.4), and what they call, are not the program that they interrupt. It has written nothing since
// the look at which they were loaded. Where it goes on before a look behind them both are named.
void Feeder::note_running(unsigned s, const nc_event& event) {
  System& of = system_[s];
  const int was = of.mdi_depth, depth = event.source.depth;
  if (of.mdi_file >= 0 && event.source.file == of.mdi_file) of.mdi_depth = depth;
  else if (depth <= of.mdi_depth) of.mdi_depth = -1;
  std::string& by = ran_.by[s];
  if (by.empty() || (was < 0 && of.mdi_depth >= 0)) by = writer_name(s);
  else if (was >= 0 && of.mdi_depth < 0) by += " or " + writer_name(s);
}

// What was executed since the last look has written what has changed since then. To be called before somebody else can write: what is read ahead of him is not executed yet.
void Feeder::note_writers() {
  if (writers_ == nullptr) return;
  take_events();
  note_writers_of(kept_variables(), kept_tables());
}

void Feeder::note_writers_of(const std::string& variables, const std::string& tables) {
  writers_->look(variables, tables, ran_, share::wall_ns());
  ran_ = {};
  writers_noted_ = std::chrono::steady_clock::now();
}

void Feeder::note_writers_in_time() {
  if (writers_ != nullptr && step_began_ - writers_noted_ >= kWritersEvery) note_writers();
}

std::string Feeder::kept_variables() {
  std::string bytes = nc_->variables();
  for (const unsigned s : newest_search_first()) bytes = restart_[s].kept_variables(bytes);
  return bytes;
}

std::string Feeder::kept_tables() {
  std::string text = nc_->tables();
  for (unsigned s = 0; s < systems_; ++s) text = restart_[s].kept_tables(text);
  return text;
}

std::string Feeder::place_bytes() {
  const std::uint32_t failed = scan_->power_failed_in();
  const Snapshot now = scan_->snapshot();
  std::vector<ProgramPlace> places;
  for (unsigned s = 0; s < systems_; ++s) {
    if ((failed >> s & 1u) == 0) continue;
    places.push_back(place_of(s, now));
  }
  return encode_places(places);
}

ProgramPlace Feeder::place_of(unsigned s, const Snapshot& now) const {
  const nc_outputs& out = now.system[s].nc;
  ProgramPlace place;
  place.system = s;
  place.program = system_[s].mdi ? "MDI" : nc_->program_name(system_[s].file);
  place.main_line = info_.system[s].main_line;  // only this thread writes it
  place.line = out.source.line;
  place.number = out.source.program;
  place.depth = out.source.depth;
  const std::string letters = nc_->axis_letters(s);
  // Where the machine stands: what is counted in a machine lock is gone with the power.
  for (unsigned a = 0; a < letters.size(); ++a) place.at.emplace_back(letters[a], out.command.v[a] - now.system[s].axes.counted[a]);
  if (system_[s].mdi || !system_[s].selected) return place;
  place.restartable = true;
  place.blocks = out.blocks;
  place.size = nc_->program_size(system_[s].file);
  place.hash = stops_[s].hash;
  for (unsigned a = 0; a < letters.size(); ++a) place.begun.emplace_back(letters[a], stops_[s].begun.v[a]);
  place.coordinates = stops_[s].coordinates;
  place.cause = "power";
  return place;
}

bool Feeder::take(Kept what, std::string* bytes) {
  const std::lock_guard lock(mutex_);
  KeptCopy& copy = kept_[what];
  if (!copy.ready) return false;
  *bytes = std::move(copy.bytes);
  copy.ready = false;
  return true;
}

// ---- commands ----

std::string Feeder::refusal() const {
  const std::lock_guard lock(mutex_);
  return refusal_;
}

Answer Feeder::refuse(Answer answer, std::string why) {
  const std::lock_guard lock(mutex_);
  refusal_ = std::move(why);
  return answer;
}

// What bars a selection, blocks of MDI and the search for a place.
Answer Feeder::hindrance() const {
  if (seen_.resetting || scan_->reset_waits()) return seen_.reset_held ? Answer::kResetHeld : Answer::kResetting;
  if (seen_.program_active()) return Answer::kNotWhileRunning;
  if (seen_.stopped_by_alarm()) return Answer::kAlarmActive;
  return seen_.alarms.waits_for_reset() ? Answer::kWarningActive : Answer::kDone;
}

Answer Feeder::apply(const Command& command) {
  (void)refuse(Answer::kDone, "");
  if (command.system >= systems_) return Answer::kAxisUnknown;
  if (command.kind == CommandKind::kSwitches) {
    operator_switches_[command.system] = command.number;
    follow_ladder();
    return Answer::kDone;
  }
  if (command.kind == CommandKind::kLook) return look(command);
  if (command.kind == CommandKind::kConfirmRestart) return confirm_restart(command);
  const Answer why = hindrance();
  if (why == Answer::kResetHeld || why == Answer::kResetting) return why;
  if (why == Answer::kNotWhileRunning) return command.kind == CommandKind::kLoadMdi ? interrupt_by_mdi(command) : why;
  if (command.kind == CommandKind::kChange) return change(command);
  if (command.kind == CommandKind::kCancelRestart) return cancel_restart(command);
  if (why != Answer::kDone) return why;
  if (command.kind == CommandKind::kSelectProgram) return select(command);
  if (command.kind == CommandKind::kLoadMdi) return load_mdi(command);
  if (command.kind == CommandKind::kFindRestart) return find_restart(command);
  return Answer::kOutOfRange;
}

// The feeder claims a command before it executes it, and the operator's thread claims a command before it gives it up. Only the first claim succeeds, so
// a command is either executed or given up.
bool Feeder::claim(std::uint64_t ticket) {
  if (ticket == kOfMachine) return true;
  std::uint64_t last = claimed_.load(std::memory_order_acquire);
  return last < ticket && claimed_.compare_exchange_strong(last, ticket, std::memory_order_acq_rel);
}

// Finding and reading a program may take some time. When the operator's thread has given the command up meanwhile, the program must not be
// selected any more.
Answer Feeder::select(const Command& command) {
  const unsigned system = command.system;
  std::uint32_t file = command.number;
  if (seen_.mode != Mode::kAuto) return Answer::kNotInThisMode;
  if (file == kProgramByName) {
    std::string name;
    {
      const std::lock_guard lock(mutex_);
      name = program_name_;
    }
    std::string error;
    if (!load(name, &file, &error)) return refuse(Answer::kNotLoaded, error);
  }
  if (!claim(command.ticket)) return Answer::kNoAnswer;
  note_writers();
  scan_->set_loaded(Scan::kNothingLoaded);  // until the end of this step, because the program in the control changes now
  if (const nc_status status = nc_->select(system, file); status < 0)
    return refuse(Answer::kRefusedByControl, status_text(status));
  restart_[system].end("a program was selected");
  system_[system].take_part(file);
  stops_[system].hash = hash_ ? hash_(file) : std::string();
  nothing_has_run(system);
  return Answer::kDone;
}

bool Feeder::load(const std::string& name, std::uint32_t* file, std::string* error) {
  unsigned loaded = 0;
  *error = "there is no folder of programs";
  if (!loader_ || !loader_(name, &loaded, error)) return false;
  *file = loaded;
  return true;
}

Answer Feeder::load_mdi(const Command& command) {
  if (seen_.mode != Mode::kMdi) return Answer::kNotInThisMode;
  if (!claim(command.ticket)) return Answer::kNoAnswer;
  const unsigned system = command.system;
  std::string text;
  {
    const std::lock_guard lock(mutex_);
    text = std::move(mdi_text_);
    mdi_text_.clear();
  }
  note_writers();
  scan_->set_loaded(Scan::kNothingLoaded);
  if (const nc_status status = nc_->load_mdi(system, text.data(), text.size()); status < 0)
    return refuse(Answer::kRefusedByControl,
                  status == NC_E_ARGUMENT ? "more than 1024 bytes of blocks" : status_text(status));
  restart_[system].lose("blocks of MDI were loaded");
  if (refresh_) refresh_();  // only after load_mdi(): now the programs called by the one that was selected here are free
  system_[system].take_mdi(std::move(text));
  nothing_has_run(system);
  return Answer::kDone;
}

// M700 12.4.4: blocks of MDI that interrupt a program in a block stop.
Answer Feeder::interrupt_by_mdi(const Command& command) {
  const unsigned s = command.system;
  const nc_outputs& out = seen_.system[s].nc;
  if (seen_.stopped_by_alarm()) return Answer::kAlarmActive;
  if (seen_.mode != Mode::kMdi) return out.state == NC_STATE_RUNNING || out.state == NC_STATE_IDLE ? Answer::kNotWhileRunning : Answer::kNotInThisMode;
  if (out.state == NC_STATE_HOLD) return Answer::kMiddleOfBlock;
  if (out.state != NC_STATE_STOPPED || !system_[s].selected || system_[s].mdi) return Answer::kNotWhileRunning;
  if (!claim(command.ticket)) return Answer::kNoAnswer;
  std::string text;
  {
    const std::lock_guard lock(mutex_);
    text = std::move(mdi_text_);
    mdi_text_.clear();
  }
  note_writers();
  System& system = system_[s];
  system.mdi_waits = 0;
  scan_->set_mdi_waits(s, 0);
  const nc_status status = nc_->load_mdi(s, text.data(), text.size());
  if (status == NC_E_STATE)
    return refuse(Answer::kRefusedByControl, "the next block belongs to what has begun, or other blocks of MDI have not come to their end");
  if (status < 0) return refuse(Answer::kRefusedByControl, status == NC_E_ARGUMENT ? "more than 1024 bytes of blocks" : status_text(status));
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) return Answer::kDone;  // it takes back what waits
  if (++mdi_texts_ == 0) ++mdi_texts_;
  system.mdi_waits = mdi_texts_;
  system.mdi_file = nc_->program_of("MDI" + std::to_string(s));
  system.mdi_behind = out.serial;
  scan_->set_mdi_waits(s, system.mdi_waits);
  return Answer::kDone;
}

// Blocks of MDI do not wait any more when they have begun, when the program has been given up, or when the mode is AUTO again. What they have written is noted where they stop, before the
// program goes on.
void Feeder::follow_mdi() {
  for (unsigned s = 0; s < systems_; ++s) {
    System& system = system_[s];
    const nc_outputs& out = seen_.system[s].nc;
    if (system.mdi_depth >= 0 && out.state == NC_STATE_STOPPED && out.cause == NC_CAUSE_MDI_ENDED) {
      note_writers();
      system.mdi_file = system.mdi_depth = -1;
    }
    if (system.mdi_waits == 0) continue;
    const bool waits = out.state == NC_STATE_STOPPED && out.serial == system.mdi_behind;
    if (waits && seen_.mode != Mode::kAuto) continue;
    if (waits) (void)nc_->load_mdi(s, "", 0);
    system.mdi_waits = 0;
    scan_->set_mdi_waits(s, 0);
  }
}

Answer Feeder::look(const Command& command) {
  if (!claim(command.ticket)) return Answer::kNoAnswer;
  if (writers_ != nullptr && writers_->take_asked()) note_writers();
  ControlJob job;
  {
    const std::lock_guard lock(mutex_);
    job = std::move(job_);
    job_ = nullptr;
  }
  return job && nc_->with_control(job) ? Answer::kDone : Answer::kRefusedByControl;
}

// Changes tables while no program is in execution. A start that the scan has taken since the last snapshot shows when the programs are read again, so that is
// tried before the change as well; after it they are read with the new values.
Answer Feeder::change(const Command& command) {
  scan_->set_loaded(Scan::kNothingLoaded);
  if (read_again() == NC_E_STATE) return Answer::kNotWhileRunning;
  put_back_searched();
  note_writers();
  const Answer answer = look(command);
  if (writers_ != nullptr) writers_->look_behind_change(kept_variables(), kept_tables());
  (void)read_again();  // cannot be refused now: nothing could be started since the first time
  return answer;
}

void Feeder::nothing_has_run(unsigned system) {
  const std::lock_guard lock(mutex_);
  FeederInfo::System& info = info_.system[system];
  info.main_line = 0;
  info.begun_again = 0;
  info.ended = false;
}

// Once the scan is at rest after a reset, the interpreter goes back to the head of the program. MDI blocks are dropped by
// a reset.
void Feeder::complete_reset() {
  if (!scan_->reset_waits()) return;
  for (unsigned s = 0; s < systems_; ++s) {
    if (nc_->reset(s) == NC_E_STATE) return;  // not yet: the next step tries again
    restart_[s].reset();
    take_events();  // with the names of those that have executed them
    if (system_[s].mdi) system_[s].clear();
    system_[s].ended = system_[s].alarmed = false;
  }
  put_back_searched();
  take_events();  // events from before the reset must be taken before it is reported as done
  scan_->reset_finished();
  const std::lock_guard lock(mutex_);
  for (unsigned s = 0; s < systems_; ++s) {
    FeederInfo::System& info = info_.system[s];
    info.alarm = info.ended = false;
    info.print_trouble.clear();
    info.main_line = 0;
  }
}

// M02 and M30 rewind: a program that has ended is at its head again and may be started. MDI blocks run only once.
void Feeder::rewind_ended() {
  for (unsigned s = 0; s < systems_; ++s) {
    System& system = system_[s];
    if (!system.ended || seen_.system[s].nc.state != NC_STATE_IDLE || scan_->reset_waits()) continue;
    if (ran_.any()) note_writers();
    const bool ok = !system.alarmed;
    if (system.mdi || !system.selected) {
      system.clear();
    } else {
      const nc_status status = nc_->select(s, system.file);
      if (status == NC_E_STATE) continue;  // the control has not seen the end of the program yet: the next step tries again
      system.ended = system.alarmed = false;
      if (status < 0) system = {};
    }
    const std::lock_guard lock(mutex_);
    FeederInfo::System& info = info_.system[s];
    info.ended = true;
    info.ended_ok = ok;
    ++info.runs;
    if (ok) ++info.good_runs;
  }
}

// Called also while a reset waits and while nothing is selected: in feed() the control notices a reset, and it passes the offsets in force to the
// scan, which needs them for the workpiece coordinates.
void Feeder::feed() {
  for (unsigned i = 0; i < kCallsPerStep; ++i) {
    const nc_status status = nc_->feed(kBudget);
    if (status != NC_OK && status != NC_BUDGET) return;
  }
}

void Feeder::take_events() {
  std::uint64_t count = 0, dropped = 0;
  for (unsigned s = 0; s < systems_; ++s) {
    nc_event event;
    std::uint64_t lost = 0;
    while (nc_->poll_event(s, &event, &lost) == NC_OK) {
      ++count;
      if (writers_ != nullptr) note_running(s, event);
      dropped = std::max(dropped, lost);
      if (sink_ != nullptr) sink_->executed(s, event);
      if (event.kind == NC_ITEM_ALARM) system_[s].alarmed = true;
      if (event.kind == NC_ITEM_END) system_[s].ended = true;
      if (event.kind == NC_ITEM_MARK) take_mark(s, event);
    }
  }
  const std::lock_guard lock(mutex_);
  info_.events += count;
  info_.dropped = std::max(info_.dropped, dropped);
}

// Takes the mark that ends a block: the block has been executed.
void Feeder::take_mark(unsigned system, const nc_event& event) {
  const std::lock_guard lock(mutex_);
  FeederInfo::System& info = info_.system[system];
  if (event.source.depth == 0) info.main_line = event.source.line;
  if (!event.again) return;
  ++info.begun_again;  // M700 13.3.1: M99 of a main program
  info.again_line = event.source.line;
}

void Feeder::take_messages() {
  Scan::Message message{};
  while (scan_->poll_message(&message)) {
    nc_text text;
    const bool known = nc_->text(message.system, message.text, &text) == NC_OK;
    if (message.port != 0) print(message.system, known ? &text : nullptr);
    if (message.port != 0 || !known) continue;
    tell(text.s, message.system);
  }
}

void Feeder::tell(std::string message, unsigned system) {
  const std::lock_guard lock(mutex_);
  if (info_.said.size() == FeederInfo::kMessagesKept) info_.said.erase(info_.said.begin());
  info_.said.push_back({system, std::move(message)});
  ++info_.messages;
}

// A program that is started again without being selected again runs as it was when it was selected. A message tells that to whoever has changed its
// file meanwhile.
void Feeder::tell_changes() {
  for (unsigned s = 0; s < systems_; ++s) {
    const std::uint8_t state = seen_.system[s].nc.state;
    const bool active = state == NC_STATE_RUNNING || state == NC_STATE_HOLD || state == NC_STATE_STOPPED;
    const bool begins = active && !was_active_[s];
    was_active_[s] = active;
    if (!begins || !system_[s].selected || system_[s].mdi) continue;
    if (const std::string remark = gate_ != nullptr ? gate_->remark(s) : ""; !remark.empty()) tell(remark, s);
    const std::string names = changed_ ? changed_() : "";
    if (!names.empty()) tell("changed since it was selected, runs as it was then: " + names, s);
  }
}

// Prints a line on the external output. Null = the text was overwritten before it could be read.
void Feeder::print(unsigned system, const nc_text* text) {
  if (!printer_) return;
  std::string trouble = text != nullptr ? printer_(*text) : "it was not taken in time";
  if (trouble.empty()) return;
  {
    const std::lock_guard lock(mutex_);
    std::string& first = info_.system[system].print_trouble;
    if (first.empty()) first = std::move(trouble);
  }
  scan_->post_print_trouble(system);
}

// Finds the axes that are shown within one turn: those for which the control shows the position 360 as 0.
void Feeder::take_turns(unsigned system) {
  nc_axes machine, work;
  for (unsigned a = 0; a < NC_MAX_AXES; ++a) machine.v[a] = work.v[a] = 360;
  nc_->shown(system, &machine, &work);
  std::uint32_t machine_turn = 0, work_turn = 0;
  for (unsigned a = 0; a < NC_MAX_AXES; ++a) {
    if (machine.v[a] == 0) machine_turn |= 1u << a;
    if (work.v[a] == 0) work_turn |= 1u << a;
  }
  FeederInfo::System& info = info_.system[system];
  if (machine_turn == info.machine_turn && work_turn == info.work_turn) return;  // only this thread writes them
  const std::lock_guard lock(mutex_);
  info.machine_turn = machine_turn;
  info.work_turn = work_turn;
}

// The modal state of the last finished block, for displays.
void Feeder::take_modal() {
  for (unsigned s = 0; s < systems_; ++s) {
    take_turns(s);
    const std::uint32_t id = seen_.system[s].nc.modal;
    if (id == modal_id_[s] && info_.system[s].modal_known) continue;  // only this thread writes them
    nc_modal modal;
    if (nc_->modal(s, id, &modal) != NC_OK) continue;
    modal_id_[s] = id;
    const std::lock_guard lock(mutex_);
    info_.system[s].modal = modal;
    info_.system[s].modal_known = true;
  }
}

// Takes the details of a program alarm once the machine has reached it.
void Feeder::take_alarm() {
  for (unsigned s = 0; s < systems_; ++s) {
    if (seen_.system[s].nc.state != NC_STATE_ALARM) continue;
    nc_alarm alarm;
    if (nc_->alarm(s, &alarm) != NC_OK) continue;
    nc_source calls[NC_MAX_CALLS] = {};
    const unsigned count = std::min(nc_->alarm_calls(s, calls, NC_MAX_CALLS), unsigned{NC_MAX_CALLS});
    const std::lock_guard lock(mutex_);
    FeederInfo::System& info = info_.system[s];
    info.alarm = true;
    info.program_alarm = alarm;
    info.alarm_calls = count;
    std::copy(calls, calls + count, info.alarm_call);
  }
}

}  // namespace nc::rt
