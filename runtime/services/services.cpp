// SPDX-License-Identifier: Apache-2.0
// See services.hpp.
#include "runtime/services/services.hpp"

#include <algorithm>

#include "runtime/programs/called_number.hpp"
#include "runtime/services/last_changes.hpp"
#include "runtime/services/restart.hpp"
#include "runtime/services/shown.hpp"
#include "runtime/services/table_changes.hpp"
#include "runtime/services/tables.hpp"
#include "runtime/share/text.hpp"

namespace nc::rt::services {
namespace {

constexpr std::uint32_t kDefaultLifespanMs = 2000;
constexpr std::uint64_t kMega = 1u << 20;

StoreLimits limits_of(const Config& config) {
  return {config.services.program_mb * kMega, config.services.programs_mb * kMega, config.program_text.copy_bytes};
}

Refused refused_of(const share::Ack& ack) {
  using share::AckReason;
  switch (static_cast<AckReason>(ack.reason)) {
    case AckReason::kMalformed:
    case AckReason::kUnknownKind:
    case AckReason::kOutOfOrder:
      return Refused::kMalformed;
    case AckReason::kLate:
      return Refused::kLate;
    case AckReason::kNoControl:
      return Refused::kNoControl;
    case AckReason::kOverflow:
    case AckReason::kTooManyClients:
    case AckReason::kClientInUse:
      return Refused::kBusy;
    case AckReason::kNotReached:
      return Refused::kNotReached;
    default:
      return Refused::kState;
  }
}

Json rights_json(const Session& session) {
  Json rights = Json::array();
  for (unsigned right = 0; right < kRightCount; ++right)
    if (session.rights.has(static_cast<Right>(right))) rights.push_back(right_name(static_cast<Right>(right)));
  return {{"client", session.client}, {"rights", std::move(rights)}};
}

// The one way in which a place is named.
bool fill_place(const Call& call, share::Request* request, Outcome* outcome) {
  struct Row {
    Field field;
    RestartBy by;
  };
  constexpr Row kWays[] = {{Field::kBlock, RestartBy::kBlock}, {Field::kSequence, RestartBy::kSequence}, {Field::kLine, RestartBy::kLine}, {Field::kPowerOff, RestartBy::kPowerOff}, {Field::kLastStop, RestartBy::kLastStop}};
  unsigned ways = 0;
  RestartBy by = RestartBy::kBlock;
  for (const Row& row : kWays) {
    const bool flag = row.by >= RestartBy::kPowerOff;
    if (!call.has(row.field) || (flag && !call.flag(row.field))) continue;
    ++ways;
    by = row.by;
    if (!flag) request->value = call.value(row.field);
  }
  const bool line = by == RestartBy::kSequence || by == RestartBy::kLine;
  std::string wrong;
  if (ways != 1) wrong = "exactly one of block, sequence, line, power_off and last_stop names the place";
  else if (!line && (call.has(Field::kPassing) || call.has(Field::kInFile))) wrong = "passing and file belong to a sequence number or a line";
  request->axis = static_cast<std::uint32_t>(by);
  request->number = static_cast<std::uint32_t>(call.value_or(Field::kPassing, 0));
  if (!wrong.empty()) *outcome = Outcome::refused(Refused::kMalformed, wrong);
  return wrong.empty();
}

}  // namespace

Services::Services(Runtime* runtime, const share::ProgramTable* programs, share::IntakeDesk* desk, const share::Segment* segment, history::Recorder* history)
    : runtime_(*runtime),
      programs_(*programs),
      desk_(*desk),
      segment_(*segment),
      store_(runtime->config().programs_folder(), limits_of(runtime->config()), [this](const ProgramStore::Names& names) { return use(names); }),
      log_(runtime->config().changes_path()),
      trace_(runtime),
      ladder_(runtime),
      watch_(runtime),
      history_(history),
      notes_(history) {
  desk->set_witness([this](const share::Request* request, const share::Ack& ack) { notes_.answered(request, ack); });
}

void Services::open(std::string* warning) {
  store_.clean();
  std::string error, damage;
  if (!log_.open(&error, &damage)) *warning = "changes through the services are not written down: " + error;
  if (damage.empty()) return;
  *warning += (warning->empty() ? "" : "; ") + damage;
  if (history_ == nullptr) return;
  history::Entry entry;
  entry.time_ns = entry.end_ns = share::wall_ns();
  entry.code = "damaged";
  entry.text = damage;
  history_->add(std::move(entry));
}

std::string Services::lack(const Session& session, const Call& call) {
  const ServiceRow& row = *call.row;
  const std::string needs = std::string(row.name) + " needs the right to " + rights_text(row);
  if (!row.allows(session.rights)) return needs;
  if (!call.right) return "";
  RightSet came;
  came.add(*call.right);
  if (!came.has(row.right)) return needs + ", and this request has come with that to " + right_name(*call.right);
  const bool shown = !row.and_right || session.came.load(std::memory_order_relaxed).has(*row.and_right);
  return shown ? "" : needs + ", and no request of this client has come with that to " + right_name(*row.and_right);
}

Outcome Services::limit(const Session& session, const Call& call, Session* after) {
  RightSet kept;
  kept.add(Right::kView);
  for (const std::string& name : call.list(Field::kKeptRights)) {
    const std::optional<Right> right = find_right(name);
    if (!right) return Outcome::refused(Refused::kMalformed, "rights must hold view, operate, set up, maintain");
    kept.add(*right);
  }
  after->number = session.number;
  after->client = session.client;
  after->user = session.user;
  after->behalf = session.behalf;
  after->owner = session.owner;
  after->sequence = session.sequence;
  after->rights = session.rights.both(kept);
  after->came.store(session.came.load(std::memory_order_relaxed).both(after->rights), std::memory_order_relaxed);
  after->may_speak = session.may_speak && session.behalf.empty();
  if (!call.has(Field::kBehalf)) return Outcome::with(rights_json(*after));
  const std::string& behalf = call.words(Field::kBehalf);
  const bool ascii = std::all_of(behalf.begin(), behalf.end(), [](char c) { return c > ' ' && c < '\x7f'; });
  if (!ascii || behalf.find(':') == std::string::npos) return Outcome::refused(Refused::kMalformed, "behalf must be printable ASCII with a colon, such as dds:screen-1");
  if (!session.may_speak || session.sequence != 0) return Outcome::refused(Refused::kNoRight, "only root and the user of ncrtd ask for others, for one of them, and before the first command");
  after->client = after->behalf = behalf;
  after->owner = user_of_behalf(behalf);
  after->may_speak = false;
  return Outcome::with(rights_json(*after));
}

Outcome Services::show(const Session& session, const Call& call) const {
  if (const std::string lacks = lack(session, call); !lacks.empty()) return Outcome::refused(Refused::kNoRight, lacks);
  auto hung = Outcome::refused(Refused::kFailed, "the state cannot be read");
  switch (call.row->service) {
    case Service::kRights: {
      Json rights = rights_json(session);
      rights["control"] = desk_.controlling();
      return Outcome::with(std::move(rights));
    }
    case Service::kServices:
      return Outcome::with(services_json());
    case Service::kMachine:
      return Outcome::with(machine_json(segment_.machine));
    default: {
      const auto block = std::make_unique<share::StatusBlock>();
      if (!segment_.status.load(block.get())) return hung;
      return Outcome::with(call.row->service == Service::kAlarms ? alarms_json(*block) : status_json(*block, segment_.machine, desk_.controlling()));
    }
  }
}

// ---- commands ----

// The command as the intake takes it. Its rules check what it holds; here only names become numbers.
bool Services::fill(const Call& call, share::Request* request, Outcome* outcome) const {
  const Config& config = runtime_.config();
  const share::RequestKind kind = call.row->command;
  const bool one = share::request_row(kind).scope == share::Scope::kOne;
  if (kind == share::RequestKind::kRestartFind && !fill_place(call, request, outcome)) return false;
  if (kind == share::RequestKind::kRestartConfirm) request->number = call.has(Field::kEntry) ? static_cast<std::uint32_t>(call.value(Field::kEntry)) - 1 : kEveryEntry;
  if (call.has(Field::kSpeed)) request->value = call.value(Field::kSpeed);
  const auto system = static_cast<unsigned>(call.value_or(Field::kSystem, one ? 1 : 0));
  request->kind = static_cast<std::uint32_t>(kind);
  request->system = system == 0 ? share::kEverySystem : system - 1;
  request->lifespan_ms = static_cast<std::uint32_t>(call.value_or(Field::kLifespan, kDefaultLifespanMs));
  request->lease_ms = static_cast<std::uint32_t>(call.value_or(Field::kLease, 0));
  request->expected_mode = request->expected_run_state = share::kAny;
  if (call.has(Field::kMode)) {
    constexpr const char* kModes[] = {"auto", "mdi", "manual"};  // in the order of Mode
    const auto mode = std::find(std::begin(kModes), std::end(kModes), call.words(Field::kMode));
    if (mode == std::end(kModes)) {
      *outcome = Outcome::refused(Refused::kMalformed, "mode must be auto, mdi or manual");
      return false;
    }
    request->number = static_cast<std::uint32_t>(mode - std::begin(kModes));
  }
  if (call.has(Field::kOn)) request->number = call.flag(Field::kOn) ? 1 : 0;
  if (call.has(Field::kPercent)) request->value = call.value(Field::kPercent) / 100;
  if (call.has(Field::kVelocity)) request->value = call.value(Field::kVelocity);
  if (call.has(Field::kDeviceValue)) request->value = call.value(Field::kDeviceValue);
  if (call.has(Field::kAxis) && request->system < config.nc.system_count) {
    const nc_system_config& axes = config.nc.system[request->system];
    while (request->axis < axes.axis_count && axes.axis[request->axis].name != call.words(Field::kAxis)[0]) ++request->axis;
  }
  for (const Field field : {Field::kBlocks, Field::kFile, Field::kDevice, Field::kInFile})
    if (call.has(field)) share::set_text(&request->text, call.words(field));
  return true;
}

// Who has sent a request, and when on the clock of requests. Now, on both clocks.
static share::Now sent_by(const Session& session, std::int64_t came_ns, share::Request* request) {
  share::set_text(&request->client, session.client);
  const share::Now now{share::wall_ns(), RealClock().now_ns()};
  request->issued_ns = now.wall_ns - (now.steady_ns - came_ns);
  return now;
}

share::Arrival Services::arrived(const Session& session, const Call& call, std::int64_t came_ns) {
  const share::Arrival waits{0, runtime_.holds()};
  if (call.row == nullptr || !call.row->of_command().stops_at_once() || !lack(session, call).empty()) return waits;
  const auto request = std::make_unique<share::Request>();
  Outcome refused;
  if (!fill(call, request.get(), &refused)) return waits;
  request->sequence = 1;  // any: its own comes with its turn
  return desk_.arrived(*request, sent_by(session, came_ns, request.get()));
}

bool Services::command(Session* session, const Call& call, std::int64_t came_ns, const std::function<void(std::uint64_t sequence)>& expect, Outcome* outcome, const share::Arrival& arrival) {
  if (const std::string lacks = lack(*session, call); !lacks.empty()) {
    *outcome = Outcome::refused(Refused::kNoRight, lacks);
    return true;
  }
  const auto request = std::make_unique<share::Request>();
  if (!fill(call, request.get(), outcome)) return true;
  request->writer = session->number;
  request->sequence = ++session->sequence;
  const share::Now now = sent_by(*session, came_ns, request.get());
  expect(request->sequence);
  notes_.came(session->number, session->user, session->behalf);
  std::vector<share::Ack> acks;
  desk_.take(*request, now, share::Way::kLocal, &acks, arrival);
  if (acks.empty()) {
    *outcome = Outcome::refused(Refused::kFailed, "the intake does not answer");
    return true;
  }
  if (static_cast<share::AckState>(acks.back().state) == share::AckState::kAccepted) return false;
  *outcome = outcome_of(acks.back());
  return true;
}

Outcome Services::outcome_of(const share::Ack& ack) {
  const std::string text(share::text_of(ack.text));
  if (static_cast<share::AckState>(ack.state) == share::AckState::kDone) return Outcome::done(text);
  return Outcome::refused(refused_of(ack), text);
}

void Services::command_gone(const Session& session) {
  const auto request = std::make_unique<share::Request>();
  request->kind = static_cast<std::uint32_t>(share::RequestKind::kClientGone);
  request->writer = session.number;
  share::set_text(&request->client, session.client);
  std::vector<share::Ack> none;
  desk_.take(*request, {share::wall_ns(), RealClock().now_ns()}, share::Way::kLocal, &none);
  notes_.gone(session.number);
}

// ---- data ----

// The number of the name itself, and the one by which a call finds the file: "O9003.a.nc" has none, and M98 P9003 runs it.
static bool has_protected_number(const nc_control* control, const std::string& name) {
  const auto is_protected = [control](const std::string& asked) {
    bool answer = false;
    return nc_program_name_protected(control, asked.c_str(), &answer) == NC_OK && answer;
  };
  const auto called = called_number(name);
  return is_protected(name) || (called && is_protected(std::to_string(*called)));
}

ProgramStore::Use Services::use(const ProgramStore::Names& names) const {
  ProgramStore::Use use;
  const FeederInfo info = runtime_.info();
  use.active = runtime_.snapshot().program_active();
  for (unsigned s = 0; s < runtime_.config().nc.system_count; ++s) {
    const FeederInfo::Selected& selected = info.system[s].selected;
    if (selected.any && !selected.mdi) use.selected.push_back(share::file_name(programs_.at(selected.file).path));
  }
  if (checks_ != nullptr) use.called = checks_->called();
  if (names.empty()) return use;
  const auto locked = std::make_shared<ProgramStore::Names>();
  const Answer answer = runtime_.look([locked, names](nc_control* control) {
    for (const std::string& name : names)
      if (has_protected_number(control, name)) locked->push_back(name);
  });
  use.known = answer == Answer::kDone;
  if (use.known) use.locked = std::move(*locked);
  return use;
}

Outcome Services::list_changes(const Call& call) {
  const std::string of = call.has(Field::kOf) ? call.words(Field::kOf) : "";
  if (!of.empty() && !names_table(of)) return Outcome::refused(Refused::kMalformed, "of must begin with tool, life, offset, variable, name or parameter, such as \"tool 3\"");
  std::string error;
  (void)log_.settle(&error);  // lines that have had no room: the changes are remembered in any case
  return Outcome::with(log_.newest(static_cast<std::uint64_t>(call.value_or(Field::kFrom, 0)), static_cast<std::uint64_t>(call.value_or(Field::kCount, 500)), of));
}

// A list of a table with who has changed its rows.
Outcome Services::list(Outcome (*read)(Runtime*, const Call&), const Call& call) const {
  if (runtime_.writers() != nullptr) runtime_.writers()->ask();  // what programs have written up to now, and not up to a second ago
  Outcome outcome = read(&runtime_, call);
  unsigned system = 0;
  if (outcome.ok && system_of(runtime_, call, &system)) add_last_changes(log_, runtime_.writers(), call.row->service, system, &outcome.reply);
  return outcome;
}

Outcome Services::data(const Session& session, const Call& call) {
  if (const std::string lacks = lack(session, call); !lacks.empty()) return Outcome::refused(Refused::kNoRight, lacks);
  switch (call.row->service) {
    case Service::kChanges: return list_changes(call);
    case Service::kHistory: return list_history(history_, call);
    case Service::kCounters: return list_counters(history_);
    case Service::kProgramTimes: return list_program_times(history_, call);
    case Service::kTools: return list(list_tools, call);
    case Service::kLives: return list(list_lives, call);
    case Service::kOffsets: return list(list_offsets, call);
    case Service::kVariables: return list(list_variables, call);
    case Service::kParameters: return list(list_parameters, call);
    case Service::kParameterExport: return export_parameters(&runtime_);
    case Service::kExport: return export_tables(&runtime_, call);
    case Service::kTraceSignals: return trace_.list_signals(call);
    case Service::kTraceStatus: return trace_.status();
    case Service::kTraceRead: return trace_.read(call);
    case Service::kLadderRungs: return ladder_.list_rungs(call);
    case Service::kLadderDevices: return ladder_.list_devices(call);
    case Service::kWatchBegin: return watch_.begin({session.number, session.owner, rank_of(session.rights, session.may_speak)}, call, RealClock().now_ns());
    case Service::kWatchEnd: return watch_.end(session.number, call);
    case Service::kRestartStatus: return show_restart(&runtime_, call);
    case Service::kTraceArm: return trace_.arm(call, actor(session), session.client);
    case Service::kTraceStop: return trace_.stop();
    case Service::kSetTool:
    case Service::kSetLife:
    case Service::kSetOffset:
    case Service::kSetVariable:
    case Service::kSetParameter:
    case Service::kParameterImport:
    case Service::kImport:
    case Service::kLadderSwap:
      return change(session, call);
    case Service::kUndo:
    case Service::kUndoParameter:
      return undo(session, call);
    default:
      return program(session, call);
  }
}

Outcome Services::change(const Session& session, const Call& call) {
  Change change;
  Outcome outcome;
  switch (call.row->service) {
    case Service::kSetTool: outcome = set_tool(&runtime_, call, &change); break;
    case Service::kSetLife: outcome = set_life(&runtime_, call, &change); break;
    case Service::kSetOffset: outcome = set_offset(&runtime_, call, &change); break;
    case Service::kSetVariable: outcome = set_variable(&runtime_, call, &change); break;
    case Service::kParameterImport: outcome = import_parameters(&runtime_, call, &change); break;
    case Service::kImport: outcome = import_tables(&runtime_, call, &change); break;
    case Service::kLadderSwap:
      // Another program can command anything of the NC, so nobody is surprised by it who has control.
      if (const std::string controls = desk_.controlling(); !controls.empty() && controls != session.client) return Outcome::refused(Refused::kNoControl, "client " + controls + " has control");
      outcome = ladder_.swap(call, &change);
      if (outcome.ok) note(session, call, std::move(change), &outcome);
      return outcome;
    default: outcome = set_parameter(&runtime_, call, &change); break;
  }
  if (!change.values.empty()) note(session, call, std::move(change), &outcome);
  return outcome;
}

void Services::find_lost_changes() { find_lost(&runtime_, &log_); }

// Takes a change back that a service with the right of this one has made: so nobody undoes what he may not do.
Outcome Services::undo(const Session& session, const Call& call) {
  const bool named = call.has(Field::kChange);
  std::vector<const Change*> lost;
  const Change* done = named ? log_.find(static_cast<std::uint64_t>(call.value(Field::kChange))) : log_.last_of(actor(session), call.row->right, &lost);
  std::string left_out;
  for (const Change* change : lost) left_out += (left_out.empty() ? "; lost before the last start, and so left out: " : ", ") + std::to_string(change->number) + " (" + change->what + ")";
  if (done == nullptr) return Outcome::refused(Refused::kNotFound, named ? "there is no such change, or it is too old" : "there is nothing of this user to be taken back" + left_out);
  const ServiceRow* row = find_service(done->service);
  if (row == nullptr || row->right != call.row->right || done->undoes != 0)
    return Outcome::refused(Refused::kState, "change " + std::to_string(done->number) + " is none that " + call.row->name + " takes back: " + done->service);
  if (done->undone_by != 0) return Outcome::refused(Refused::kState, "change " + std::to_string(done->number) + " was taken back by change " + std::to_string(done->undone_by));
  if (done->values.empty()) return Outcome::refused(Refused::kState, "change " + std::to_string(done->number) + " is too old, or is no change of tables");
  if (is_lost(*done)) return Outcome::refused(Refused::kState, "change " + std::to_string(done->number) + " was lost before the last start: " + done->what + " is as it was before it");
  Change change;
  Outcome outcome = take_back(&runtime_, *done, &change);
  if (outcome.ok) outcome.reply["text"] = change.what + left_out;
  if (outcome.ok) note(session, call, std::move(change), &outcome);
  return outcome;
}

// Who is told that a program is there, or gone, may press a button of the machine at once: by then the scan knows that what calls it has to be checked.
void Services::look_at_heads() {
  if (checks_->look_again() != StartGate::Looked::kSame) (void)runtime_.look([](nc_control*) {});
}

Outcome Services::renamed(const Call& call) {
  const Outcome outcome = store_.rename(call);
  if (outcome.ok && checks_ != nullptr) {
    checks_->gone(call.words(Field::kFile));
    checks_->arrived(call.words(Field::kNewName));
    look_at_heads();
  }
  return outcome;
}

Outcome Services::removed(const Call& call) {
  const Outcome outcome = store_.remove(call);
  if (outcome.ok && checks_ != nullptr) {
    checks_->gone(call.words(Field::kFile));
    look_at_heads();
  }
  return outcome;
}

// A machine runs the text that was selected, until something is selected again: who has put another one in its place is told so.
void Services::warn_of_selected(const std::string& name, Outcome* outcome) const {
  const ProgramStore::Use now = use({});
  if (std::find(now.selected.begin(), now.selected.end(), name) == now.selected.end()) return;
  std::string text = outcome->reply.value("text", "");
  text += (text.empty() ? "" : "; ") + name + " is selected: a start does not know of this change before a program is selected again";
  outcome->reply["text"] = std::move(text);
}

Outcome Services::list_programs(const Call& call) const {
  Outcome outcome = store_.list(call);
  if (outcome.ok)
    for (Json& program : outcome.reply["programs"])
      program["check"] = check_state_name(checks_ == nullptr ? CheckState::kUnchecked : checks_->state(program["name"].get<std::string>(), 0));
  return outcome;
}

Outcome Services::program(const Session& session, const Call& call) {
  Change done;
  const auto noted = [&](Outcome outcome, const std::string& name) {
    if (outcome.ok) note(session, call, done, &outcome);
    if (outcome.ok) warn_of_selected(name, &outcome);
    return outcome;
  };
  done.what = "program " + call.words(Field::kFile);
  switch (call.row->service) {
    case Service::kPrograms: return list_programs(call);
    case Service::kProgramCheck: return checks_ == nullptr ? Outcome::refused(Refused::kNotFound, "programs are not checked here") : checks_->show(call);
    case Service::kProgramRecheck: return checks_ == nullptr ? Outcome::refused(Refused::kNotFound, "programs are not checked here") : checks_->again(call);
    case Service::kProgramRead: return store_.read(call);
    case Service::kProgramBegin: return store_.begin(session.number, call);
    case Service::kProgramData: return store_.data(session.number, call);
    case Service::kProgramAbandon: return store_.abandon(session.number, call);
    case Service::kProgramFinish: {
      std::string name;
      const Outcome outcome = store_.finish(session.number, call, &name);
      done.what = "program " + name;
      if (outcome.ok && checks_ != nullptr) {
        checks_->arrived(name);
        look_at_heads();
      }
      return noted(outcome, name);
    }
    case Service::kProgramRename:
      done.before = call.words(Field::kFile);
      done.after = call.words(Field::kNewName);
      return noted(renamed(call), done.before);
    case Service::kProgramDelete: return noted(removed(call), call.words(Field::kFile));
    case Service::kProgramProtect:
      done.after = call.flag(Field::kOn) ? "protected" : "not protected";
      return noted(store_.protect(call), "");
    default: return Outcome::refused(Refused::kUnknownService, "there is no such service");
  }
}

// Writes down who has changed what. A change that cannot be written down is done all the same, and its answer says that.
void Services::note(const Session& session, const Call& call, Change change, Outcome* outcome) {
  change.time_ns = share::wall_ns();
  change.user = actor(session);
  change.client = session.client;
  change.service = call.row->name;
  notes_.changed(change);
  std::string error;
  if (!log_.add(std::move(change), &error) && outcome->ok) outcome->reply["text"] = "done, but not written down yet: " + error;
}

}  // namespace nc::rt::services
