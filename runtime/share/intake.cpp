// SPDX-License-Identifier: Apache-2.0
// The rules of the command intake. See intake.hpp.
#include "runtime/share/intake.hpp"

#include <cmath>

#include "nc/run.h"
#include "runtime/share/request_table.hpp"
#include "runtime/share/text.hpp"

namespace nc::rt::share {
namespace {

constexpr double kMostExact = 9007199254740992.0;  // whole numbers up to here are exact
constexpr double kMaxVelocity = 1e6;  // mm/s; the scan checks the limit of the axis itself

bool is_graphic(std::string_view text) {
  for (const char c : text)
    if (c <= ' ' || c > '~') return false;
  return true;
}

// True when the text has no control characters other than tabs and line ends.
bool is_program_text(std::string_view text) {
  for (const char c : text)
    if (static_cast<unsigned char>(c) < ' ' && c != '\n' && c != '\r' && c != '\t') return false;
  return true;
}

// True for the name of a file in the folder of programs: a name without a path, and not of a hidden file.
bool is_file_name(std::string_view text) {
  if (text.empty() || text[0] == '.' || text.find('/') != std::string_view::npos) return false;
  for (const char c : text)
    if (static_cast<unsigned char>(c) < ' ') return false;
  return true;
}

// True when the text may be the name of a device of the ladder: at most 64 printable ASCII characters.
bool is_device_name(std::string_view text) {
  return !text.empty() && text.size() <= 64 && is_graphic(text);
}

bool has_client(const Request& request) { return is_ended(request.client) && !text_of(request.client).empty() && is_graphic(text_of(request.client)); }

Ack make_ack(const Request& request, Way way, std::int64_t now_ns) {
  Ack ack{};
  set_text(&ack.client, text_of(request.client));
  ack.sequence = request.sequence;
  ack.writer = request.writer;
  ack.kind = request.kind;
  ack.time_ns = now_ns;
  ack.way = static_cast<std::uint32_t>(way);
  return ack;
}

bool is_named(const Request& request, unsigned system) {
  return request.system == kEverySystem || request.system == system;
}

// The text of the answer to a client that has named one part system in a command that acts on all of them.
const char* scope_text(const Request& request, unsigned systems) {
  const bool more = systems > 1 && request.system != kEverySystem && request_row(request).scope == Scope::kControl;
  return more ? "of all part systems" : "";
}

template <class Is>
bool any_system(const Machine::State& state, Is is) {
  for (unsigned s = 0; s < state.system_count; ++s)
    if (is(s)) return true;
  return false;
}

// Whether the state that an accepted command asks for has been reached. A start is done when one of the named part systems runs or has run, because a start of
// all part systems begins only those that are ready.
// `goes_on`: whether a part system moves by what was asked for behind this hold.
template <class GoesOn>
bool reached(const Request& request, const Machine::State& state, const std::array<std::uint64_t, NC_MAX_SYSTEMS>& runs_before, GoesOn goes_on) {
  const auto& run = state.run_state;
  switch (static_cast<RequestKind>(request.kind)) {
    case RequestKind::kCycleStart:
      return any_system(state, [&](unsigned s) {
        return is_named(request, s) && (run[s] == NC_STATE_RUNNING || run[s] == NC_STATE_STOPPED || state.runs[s] != runs_before[s]);
      });
    case RequestKind::kFeedHold:
      return !any_system(state, [&](unsigned s) { return is_named(request, s) && (run[s] == NC_STATE_RUNNING || state.moves[s]) && !goes_on(s); });
    case RequestKind::kReset:
      return !state.resetting && !any_system(state, [&](unsigned s) { return run[s] != NC_STATE_IDLE && run[s] != NC_STATE_MANUAL; });
    case RequestKind::kSetMode:
      return static_cast<std::uint32_t>(state.mode) == request.number;
    default:
      return true;
  }
}

std::string in_vain_text(const std::string& alarm) {
  return "an alarm is there behind the reset" + (alarm.empty() ? "" : ": " + alarm);
}

}  // namespace

const char* reason_text(AckReason reason) {
  switch (reason) {
    case AckReason::kNone: return "";
    case AckReason::kMalformed: return "malformed";
    case AckReason::kUnknownKind: return "unknown command";
    case AckReason::kLate: return "late";
    case AckReason::kOutOfOrder: return "out of order";
    case AckReason::kNoControl: return "no control";
    case AckReason::kExpectedState: return "state is another one";
    case AckReason::kOverflow: return "too many commands at once";
    case AckReason::kTooManyClients: return "too many clients";
    case AckReason::kRefused: return "refused";
    case AckReason::kNotReached: return "not reached in time";
    case AckReason::kClientInUse: return "client id in use";
    case AckReason::kCount: break;
  }
  return "?";
}

Ack refusal_of(const Request& request, std::int64_t now_ns, AckReason reason, const char* text) {
  Ack ack = make_ack(request, Way::kGateway, now_ns);
  ack.state = static_cast<std::uint32_t>(AckState::kRejected);
  ack.reason = static_cast<std::uint32_t>(reason);
  set_text(&ack.text, text);
  return ack;
}

std::string Intake::controlling() const {
  return control_ == nullptr ? std::string() : std::string(text_of(control_->name));
}

// ---- rule 1 ----

Intake::Verdict Intake::check_form(const Request& r, const Machine::State& state) const {
  const auto bad = [](const char* text) { return Verdict{AckState::kRejected, AckReason::kMalformed, text}; };
  if (!is_ended(r.expected_program) || !is_ended(r.text)) return bad("a text is too long");
  if (r.sequence == 0) return bad("sequence numbers begin with 1");
  if (r.lifespan_ms == 0 || r.lifespan_ms > kMaxLifespanMs) return bad("lifespan must be 1 to 10000 ms");
  if (r.lease_ms != 0 && (r.lease_ms < kMinLeaseMs || r.lease_ms > kMaxLeaseMs))
    return bad("lease must be 100 to 60000 ms");
  if (!std::isfinite(r.value)) return bad("value is not a number");
  const bool all = r.system == kEverySystem && request_row(r).scope != Scope::kOne;
  if (r.system >= state.system_count && !all) return bad("no such part system");
  if (r.expected_mode < kAny || r.expected_mode > static_cast<std::int32_t>(Mode::kManual))
    return bad("expected mode is unknown");
  if (r.expected_run_state < kAny || r.expected_run_state > NC_STATE_MANUAL) return bad("expected run state is unknown");
  const std::string_view text = text_of(r.text);
  switch (static_cast<RequestKind>(r.kind)) {
    case RequestKind::kTakeControl:
    case RequestKind::kReleaseControl:
    case RequestKind::kCycleStart:
    case RequestKind::kFeedHold:
    case RequestKind::kReset:
      return {};
    case RequestKind::kSetMode:
      return r.number <= static_cast<std::uint32_t>(Mode::kManual) ? Verdict{} : bad("no such mode");
    case RequestKind::kFeedOverride:
      return r.value >= 0 && r.value <= state.max_feed_override ? Verdict{} : bad("feed override out of range");
    case RequestKind::kRapidOverride:
      return r.value >= 0 && r.value <= 1 ? Verdict{} : bad("rapid override must be 0 to 1");
    case RequestKind::kSingleBlock:
    case RequestKind::kOptionalStop:
      return r.number <= 1 ? Verdict{} : bad("must be 0 or 1");
    case RequestKind::kJog:
      if (r.axis >= state.axis_count[r.system]) return bad("no such axis");
      return std::abs(r.value) <= kMaxVelocity ? Verdict{} : bad("velocity out of range");
    case RequestKind::kMdi:
      return !text.empty() && is_program_text(text) ? Verdict{} : bad("no blocks, or not a program's text");
    case RequestKind::kSelectProgram:
      return is_file_name(text) ? Verdict{} : bad("not the name of a file in the folder of programs");
    case RequestKind::kForce:
    case RequestKind::kWriteDevice:
      if (!is_device_name(text)) return bad("not the name of a device");
      return r.value == std::floor(r.value) && r.value >= -2147483648.0 && r.value <= 4294967295.0
                 ? Verdict{}
                 : bad("the value of a device is a whole number of 32 bits");
    case RequestKind::kReleaseForce:
      return text.empty() || is_device_name(text) ? Verdict{} : bad("not the name of a device");
    case RequestKind::kRestartFind:
      if (r.axis >= static_cast<std::uint32_t>(RestartBy::kCount)) return bad("no such way to name a place");
      if (!(r.value >= 0 && r.value <= kMostExact && r.value == std::floor(r.value))) return bad("not a number of blocks, a sequence number or a line");
      return text.empty() || is_file_name(text) ? Verdict{} : bad("not the name of a program");
    case RequestKind::kRestartConfirm:
    case RequestKind::kRestartCancel:
      return {};
    case RequestKind::kRestartApproach:
      if (r.axis >= state.axis_count[r.system]) return bad("no such axis");
      return r.value >= 0 && r.value <= kMaxVelocity ? Verdict{} : bad("velocity out of range");
    case RequestKind::kClientGone:
    case RequestKind::kGatewayBegan:
    case RequestKind::kCount:
      break;
  }
  return {AckState::kRejected, AckReason::kUnknownKind, "unknown kind of command"};
}

// ---- clients ----

// Whether a client may lose its place: then nothing of it is executed again when it comes once more.
bool Intake::may_displace(const Client& client, std::int64_t now_ns) const {
  if (&client == control_) return false;
  return client.way == Way::kLocal || !client.executed || now_ns - client.heard_ns > kForgetNs;
}

// A free place, or that of the longest silent client that may lose it. Null = there is none for this participant; never for a local one, because the gateway
// leaves kKeptForLocal places, and only one client has control.
Intake::Client* Intake::place_for(std::uint64_t writer, Way way, std::int64_t now_ns) {
  const auto is_own = [&](const Client& client) { return client.way == way && client.writer == writer; };
  unsigned of_gateway = 0, own = 0;
  for (const Client& client : client_) {
    of_gateway += client.used && client.way == Way::kGateway;
    own += client.used && is_own(client);
  }
  const bool gateway = way == Way::kGateway, own_full = gateway && own >= kPerWriter, way_full = gateway && of_gateway >= kClients - kKeptForLocal;
  Client* longest = nullptr;
  for (Client& client : client_) {
    if (!client.used && !own_full && !way_full) return &client;
    if (!client.used || !may_displace(client, now_ns)) continue;
    if ((own_full && !is_own(client)) || (way_full && client.way != way)) continue;
    if (longest == nullptr || client.heard_ns < longest->heard_ns) longest = &client;
  }
  return longest;
}

// The client that a command comes from, which may be a new one. Null = there is no place.
Intake::Client* Intake::client_of(const Request& request, Way way, std::int64_t now_ns) {
  for (Client& client : client_)
    if (client.used && client.way == way && text_of(client.name) == text_of(request.client)) return &client;
  Client* place = place_for(request.writer, way, now_ns);
  if (place == nullptr) return nullptr;
  *place = {};
  place->used = true;
  place->way = way;
  set_text(&place->name, text_of(request.client));
  place->writer = request.writer;
  place->heard_ns = now_ns;
  return place;
}

void Intake::remember(Client* client, const Ack& ack) {
  client->answered[client->answers++ % kRemembered] = ack;
}

// When a client loses control, the jogs that it has commanded are stopped.
void Intake::lose_control() {
  control_ = nullptr;
  for (unsigned s = 0; s < NC_MAX_SYSTEMS; ++s) {
    for (unsigned a = 0; a < NC_MAX_AXES; ++a) {
      if (!jogging_[s][a]) continue;
      Command stop;
      stop.kind = CommandKind::kJog;
      stop.system = static_cast<std::uint8_t>(s);
      stop.axis = static_cast<std::uint8_t>(a);
      (void)machine_.execute(stop);  // a refusal is ignored: in another mode nothing jogs any more
      jogging_[s][a] = false;
    }
  }
}

// Removes the clients of a participant that is gone. A participant may have several clients: only the named one is removed, or all of them when none is
// named.
void Intake::gone(const Request& request, Way way, bool everyone) {
  const bool named = is_ended(request.client) && !text_of(request.client).empty();
  const auto is_meant = [&](const Text<32>& name, Way of, std::uint64_t writer) {
    return of == way && (everyone || (writer == request.writer && (!named || text_of(name) == text_of(request.client))));
  };
  for (Client& client : client_) {
    if (!client.used || !is_meant(client.name, client.way, client.writer)) continue;
    if (&client == control_) lose_control();
    client = {};
  }
  for (Pending& pending : pending_)  // their answers would reach nobody
    if (pending.used && is_meant(pending.request.client, pending.way, pending.request.writer)) pending.used = false;
}

// ---- rules 5 to 7 ----

Intake::Verdict Intake::take_control(Client* client, const Request& request, std::int64_t now_ns) {
  if (control_ != nullptr && control_ != client)
    return {AckState::kRejected, AckReason::kNoControl, "client " + controlling() + " has control"};
  control_ = client;
  lease_ns_ = std::int64_t{request.lease_ms == 0 ? kDefaultLeaseMs : request.lease_ms} * 1'000'000;
  lease_end_ns_ = now_ns + lease_ns_;
  return {AckState::kDone, AckReason::kNone, "has control"};
}

// Rule 6: whether mode, run state and program of each named part system are those that the client expects.
bool Intake::expected(const Request& request, const Machine::State& state, std::string* text) const {
  if (request.expected_mode != kAny && request.expected_mode != static_cast<std::int32_t>(state.mode)) {
    *text = "the mode is another one";
    return false;
  }
  const auto run_state_differs = [&](unsigned s) { return is_named(request, s) && request.expected_run_state != state.run_state[s]; };
  if (request.expected_run_state != kAny && any_system(state, run_state_differs)) {
    *text = "the run state is another one";
    return false;
  }
  const std::string_view program = text_of(request.expected_program);
  const auto program_differs = [&](unsigned s) {  // compares the name as status shows it, cut to the length that a client can write
    Text<sizeof request.expected_program> shown;
    set_text(&shown, state.program[s]);
    return is_named(request, s) && program != text_of(shown);
  };
  if (program.empty() || !any_system(state, program_differs)) return true;
  *text = "the program is another one";
  return false;
}

// A command of the runtime.
Answer Intake::give(const RequestRow& row, const Request& request, const Arrival& arrival) {
  Command command;
  command.kind = *row.command;
  command.system = request.system == kEverySystem ? kAllSystems : static_cast<std::uint8_t>(request.system);
  if (arrival.hold != 0) return machine_.await_hold(arrival.hold, command.system);  // what was asked for behind it goes on
  command.axis = static_cast<std::uint8_t>(request.axis);
  command.number = request.number;
  command.value = request.value;
  command.by = Asker::kClient;
  command.holds = arrival.holds;
  const Answer answer = machine_.execute(command);
  if (answer != Answer::kDone) return answer;
  if (row.kind == RequestKind::kJog) jogging_[request.system][request.axis] = request.value != 0;
  if (row.kind == RequestKind::kRestartApproach) jogging_[request.system][request.axis] = true;
  for (unsigned s = 0; row.moves() && s < NC_MAX_SYSTEMS; ++s)
    if (is_named(request, s)) moved_[s] = std::max(moved_[s], arrival.holds);
  return answer;
}

Intake::Verdict Intake::execute(const Request& request, const Arrival& arrival) {
  const auto kind = static_cast<RequestKind>(request.kind);
  Answer answer = Answer::kOutOfRange;
  bool takes_time = false;
  if (kind == RequestKind::kMdi) {
    answer = machine_.load_mdi(request.system, std::string(text_of(request.text)) + "\n");
  } else if (kind == RequestKind::kForce) {
    answer = machine_.force(std::string(text_of(request.text)), static_cast<std::int64_t>(request.value));
  } else if (kind == RequestKind::kWriteDevice) {
    answer = machine_.write_device(std::string(text_of(request.text)), static_cast<std::int64_t>(request.value));
  } else if (kind == RequestKind::kReleaseForce) {
    answer = machine_.release(std::string(text_of(request.text)));
  } else if (kind == RequestKind::kRestartFind) {
    answer = machine_.find_restart(request.system, {static_cast<RestartBy>(request.axis), static_cast<std::uint64_t>(request.value), request.number, std::string(text_of(request.text))});
  } else if (kind == RequestKind::kSelectProgram) {
    answer = machine_.select_program(request.system, std::string(text_of(request.text)));
    takes_time = answer == Answer::kDone && machine_.checks(request.system);  // who is told that it is selected may start it at once
    if (answer == Answer::kDone && !takes_time) return {AckState::kDone, AckReason::kNone, machine_.remark(request.system)};
  } else if (const RequestRow& row = request_row(kind); row.command) {
    answer = give(row, request, arrival);
    takes_time = row.takes_time;
  }
  if (answer != Answer::kDone) return {AckState::kRejected, AckReason::kRefused, machine_.explain(answer), refusal_cause(answer)};
  return {takes_time ? AckState::kAccepted : AckState::kDone, AckReason::kNone, ""};
}

// Rule 4.
Intake::Verdict Intake::check_time(const Request& request, const Now& now) {
  const std::int64_t lifespan_ns = std::int64_t{request.lifespan_ms} * 1'000'000;
  // The lifespan is subtracted from our own time and not from issued_ns: that comes from outside, so the subtraction could overflow.
  if (request.issued_ns < now.wall_ns - lifespan_ns)
    return {AckState::kRejected, AckReason::kLate, "older than its lifespan"};
  if (request.issued_ns > now.wall_ns + kClockSkewNs)
    return {AckState::kRejected, AckReason::kLate, "from the future: the clocks of client and control differ"};
  return {};
}

// `client`: null for a hold without a place.
Intake::Verdict Intake::decide(Client* client, const Request& request, Way way, const Machine::State& state, const Now& now, const Arrival& arrival) {
  const bool held = arrival.hold != 0;
  const auto kind = static_cast<RequestKind>(request.kind);
  if (const Verdict late = check_time(request, now); late.state != AckState::kDone && !held) return late;
  if (kind == RequestKind::kTakeControl) return take_control(client, request, now.steady_ns);
  const bool has_control = client != nullptr && control_ == client;
  if (kind == RequestKind::kReleaseControl) {
    if (!has_control) return {AckState::kRejected, AckReason::kNoControl, "this client has no control"};
    lose_control();
    return {};
  }
  if (!has_control && !request_row(kind).stops_at_once())
    return {AckState::kRejected, AckReason::kNoControl,
            control_ == nullptr ? "take control first" : "client " + controlling() + " has control"};
  if (has_control) lease_end_ns_ = now.steady_ns + lease_ns_;
  std::string text;
  if (!held && !expected(request, state, &text)) return {AckState::kRejected, AckReason::kExpectedState, text};
  Verdict verdict = execute(request, arrival);
  if (verdict.state != AckState::kRejected && verdict.text.empty()) verdict.text = scope_text(request, state.system_count);
  if (verdict.state == AckState::kAccepted && !wait_for(request, way, now.steady_ns, state, arrival)) verdict.state = AckState::kDone;
  return verdict;
}

// ---- one command ----

Intake::Verdict Intake::hold_without_place(const Request& request, Way way, const Now& now, const Arrival& arrival) {
  const Machine::State state = machine_.state();
  Verdict form = check_form(request, state);
  return form.state == AckState::kDone ? decide(nullptr, request, way, state, now, arrival) : form;
}

Arrival Intake::arrived(const Request& request, const Now& now) {
  Arrival arrival{0, machine_.holds()};
  if (!request_row(request).stops_at_once() || !has_client(request) || check_time(request, now).state != AckState::kDone) return arrival;
  const Machine::State state = machine_.state();
  std::string text;
  if (check_form(request, state).state != AckState::kDone || !expected(request, state, &text)) return arrival;
  arrival.hold = machine_.hold_at_once(request.system == kEverySystem ? kAllSystems : request.system);
  return arrival;
}

void Intake::take(const Request& request, const Now& now, std::vector<Ack>* acks, Way way, const Arrival& known) {
  const Arrival arrival{known.hold, std::min(known.holds, machine_.holds())};
  const auto kind = static_cast<RequestKind>(request.kind);
  if (is_from_gateway(request)) {
    gone(request, way, kind == RequestKind::kGatewayBegan);
    return;
  }
  // A request without a valid name of a client can neither be answered nor remembered.
  if (!has_client(request)) return;
  Ack ack = make_ack(request, way, now.wall_ns);
  const auto answer = [&](const Verdict& verdict) {
    ack.state = static_cast<std::uint32_t>(verdict.state);
    ack.reason = static_cast<std::uint32_t>(verdict.reason);
    ack.refusal = static_cast<std::uint32_t>(verdict.refusal);
    set_text(&ack.text, verdict.text);
    acks->push_back(ack);
  };
  Client* client = client_of(request, way, now.steady_ns);
  if (request_row(kind).stops_at_once() && (client == nullptr || client->writer != request.writer)) {
    answer(hold_without_place(request, way, now, arrival));
    return;
  }
  if (client == nullptr) {
    answer({AckState::kRejected, AckReason::kTooManyClients, "too many clients"});
    return;
  }
  if (client->writer != request.writer) {
    answer({AckState::kRejected, AckReason::kClientInUse, "this client id belongs to another participant"});
    return;
  }
  client->heard_ns = now.steady_ns;
  for (unsigned i = 0; i < std::min(client->answers, kRemembered); ++i) {
    if (client->answered[i].sequence != request.sequence || request.sequence == 0) continue;
    acks->push_back(client->answered[i]);
    acks->back().repeated = 1;
    return;
  }
  const Machine::State state = machine_.state();
  if (Verdict form = check_form(request, state); form.state != AckState::kDone) {
    // The number counts as used, so that a duplicate gets the same answer. That is not possible for the number 0.
    if (request.sequence > client->last_sequence) {
      client->last_sequence = request.sequence;
      answer(form);
      remember(client, ack);
    } else {
      answer(form);
    }
    return;
  }
  if (request.sequence <= client->last_sequence) {
    answer({AckState::kRejected, AckReason::kOutOfOrder,
            "the last sequence number of this client is " + std::to_string(client->last_sequence)});
    return;
  }
  client->last_sequence = request.sequence;
  const Verdict verdict = decide(client, request, way, state, now, arrival);
  client->executed = client->executed || (verdict.state != AckState::kRejected && !request_row(kind).stops_at_once());
  answer(verdict);
  remember(client, ack);
}

// ---- what comes with time ----

// Notes a command whose state comes later. False when the list is full: then the command has been executed all the same, and its answer is `done` at once.
bool Intake::wait_for(const Request& request, Way way, std::int64_t now_ns, const Machine::State& before, const Arrival& arrival) {
  for (Pending& pending : pending_) {
    if (pending.used) continue;
    pending = {true, way, request, now_ns, arrival, before.runs, before.resets};
    return true;
  }
  return false;
}

void Intake::settle(Pending* pending, const Verdict& verdict, std::int64_t now_ns, std::vector<Ack>* acks) {
  Ack ack = make_ack(pending->request, pending->way, now_ns);
  ack.state = static_cast<std::uint32_t>(verdict.state);
  ack.reason = static_cast<std::uint32_t>(verdict.reason);
  ack.refusal = static_cast<std::uint32_t>(verdict.refusal);
  set_text(&ack.text, verdict.text);
  acks->push_back(ack);
  pending->used = false;
  for (Client& client : client_) {
    if (!client.used || client.way != pending->way || client.writer != ack.writer || text_of(client.name) != text_of(ack.client)) continue;
    for (Ack& answered : client.answered)
      if (answered.sequence == ack.sequence) answered = ack;  // a duplicate gets this answer from now on
  }
}

bool Intake::is_reached(const Pending& pending, const Machine::State& state) {
  const std::uint64_t hold = pending.arrival.hold;
  if (hold != 0 && machine_.has_stood(hold, pending.request.system == kEverySystem ? kAllSystems : pending.request.system)) return true;
  return reached(pending.request, state, pending.runs, [&](unsigned s) { return hold != 0 && moved_[s] >= hold; });
}

// Whether a feed hold has come behind a start, which has then not begun, or stands already.
bool Intake::is_held(const Pending& pending) {
  const std::uint32_t since = machine_.held_since(pending.arrival.holds);
  return static_cast<RequestKind>(pending.request.kind) == RequestKind::kCycleStart && (pending.request.system == kEverySystem ? since : since >> pending.request.system & 1u) != 0;
}

// Whether a reset is done and has left an alarm, whose cause is still there or has come meanwhile: waiting brings nothing, only another reset does.
bool Intake::is_in_vain(const Pending& pending, const Machine::State& state) const {
  const bool done = state.resets != pending.resets && (!state.resetting || state.reset_held);
  return static_cast<RequestKind>(pending.request.kind) == RequestKind::kReset && done && state.alarmed;
}

void Intake::tick(const Now& now, std::vector<Ack>* acks) {
  if (control_ != nullptr && now.steady_ns > lease_end_ns_) lose_control();
  bool any = false;
  for (const Pending& pending : pending_) any |= pending.used;
  if (!any) return;
  const Machine::State state = machine_.state();
  for (Pending& pending : pending_) {
    if (!pending.used) continue;
    if (static_cast<RequestKind>(pending.request.kind) == RequestKind::kSelectProgram) {
      const unsigned system = pending.request.system;
      if (!machine_.checks(system) || now.steady_ns - pending.since_ns > kReachNs)
        settle(&pending, {AckState::kDone, AckReason::kNone, machine_.remark(system)}, now.wall_ns, acks);
      continue;
    }
    if (is_reached(pending, state))
      settle(&pending, {AckState::kDone, AckReason::kNone, scope_text(pending.request, state.system_count)}, now.wall_ns, acks);
    else if (static_cast<RequestKind>(pending.request.kind) == RequestKind::kCycleStart && state.alarmed)
      settle(&pending, {AckState::kFailed, AckReason::kRefused, "an alarm came", RefusalCause::kAlarm}, now.wall_ns, acks);
    else if (is_in_vain(pending, state))
      settle(&pending, {AckState::kFailed, AckReason::kRefused, in_vain_text(machine_.alarm()), RefusalCause::kAlarm}, now.wall_ns, acks);
    else if (is_held(pending))
      settle(&pending, {AckState::kFailed, AckReason::kRefused, answer_text(Answer::kTakenBack), refusal_cause(Answer::kTakenBack)}, now.wall_ns, acks);
    else if (now.steady_ns - pending.since_ns > kReachNs)
      settle(&pending, {AckState::kFailed, AckReason::kNotReached, "not reached in time"}, now.wall_ns, acks);
  }
}

}  // namespace nc::rt::share
