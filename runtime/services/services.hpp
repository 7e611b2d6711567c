// SPDX-License-Identifier: Apache-2.0
// Executes calls of the services on a running Runtime. Whether the client has the right is asked here, before anything else, for every way in.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "runtime/runtime.hpp"
#include "runtime/services/call.hpp"
#include "runtime/services/change_log.hpp"
#include "runtime/services/history.hpp"
#include "runtime/services/ladder.hpp"
#include "runtime/services/program_checks.hpp"
#include "runtime/services/program_store.hpp"
#include "runtime/services/trace.hpp"
#include "runtime/services/watch.hpp"
#include "runtime/share/intake_desk.hpp"
#include "runtime/share/program_table.hpp"

namespace nc::rt::services {

// A client of the services, from its connection to its end.
struct Session {
  std::uint64_t number = 0;  // no other session of this process has it
  std::string client;        // name in the intake: printable ASCII, at most 31 characters
  uid_t user = 0;
  std::string behalf;        // for whom it asks; empty = for its user
  std::string owner;         // whose requests take turns with those of others: its user, or for whom it asks
  bool may_speak = false;    // it may ask for others
  RightSet rights;
  // With which of them requests have come that name one (Call::right), as those over DDS do: who needs two rights for a service has shown the second one so.
  std::atomic<RightSet> came{RightSet()};
  std::atomic<bool> open{true};
  std::uint64_t sequence = 0;  // of its commands; in the thread of Lane::kCommand
};

class Services {
 public:
  // All must outlive the services. The segment shows the state, and must exist before the first call. `history` may be null: then there is none.
  Services(Runtime* runtime, const share::ProgramTable* programs, share::IntakeDesk* desk, const share::Segment* segment, history::Recorder* history);
  // Without them nothing is known of any program. Before the first call.
  void set_checks(ProgramChecks* checks) { checks_ = checks; }
  // Prepares the files of the services. A sentence in *warning when changes cannot be written down.
  void open(std::string* warning);

  // "" = the client may use the service with this request, else what it lacks. Any thread.
  static std::string lack(const Session& session, const Call& call);
  // Service rights.limit: what the session is from now on, in *after. Whether another one asks for the same is the caller's.
  static Outcome limit(const Session& session, const Call& call, Session* after);

  // One function for each lane, each to be called in one thread of its own.
  Outcome show(const Session& session, const Call& call) const;
  Outcome data(const Session& session, const Call& call);
  // Looks which changes a power cut has taken. Once, in the thread of Lane::kData, when the control runs and before anything is asked of it.
  void find_lost_changes();
  // `came_ns`: when the request came, on RealClock: its lifespan counts from there. False: the answer comes later, to IntakeDesk::set_local(), with the session's number as writer and the sequence *sequence. `expect` is called with the sequence
  // before the command is given, because that answer may come before this function returns.
  bool command(Session* session, const Call& call, std::int64_t came_ns, const std::function<void(std::uint64_t sequence)>& expect, Outcome* outcome, const share::Arrival& arrival);
  // To be called when a request comes: a hold is given to the machine then, and not when its turn among the commands comes. For command(). Any thread.
  share::Arrival arrived(const Session& session, const Call& call, std::int64_t came_ns);

  // The client is gone. In the thread of the lane.
  void command_gone(const Session& session);
  void data_gone(const Session& session) {
    store_.abandon_all(session.number);
    watch_.gone(session.number);
  }
  // Watch lists, in the thread of Lane::kData: when there is something to do next, on RealClock, and what it is.
  std::int64_t next_update_ns() const { return watch_.next_ns(); }
  std::vector<Update> updates(std::int64_t now_ns) { return watch_.updates(now_ns); }

  // The client that has control, "" = nobody. Any thread.
  std::string controlling() const { return desk_.controlling(); }
  static Outcome outcome_of(const share::Ack& ack);
  // Where commands are written down, and who was refused.
  ActionNotes* notes() { return &notes_; }

 private:
  std::string actor(const Session& session) { return session.behalf.empty() ? notes_.name_of(session.user) : user_of_behalf(session.behalf); }
  bool fill(const Call& call, share::Request* request, Outcome* outcome) const;
  ProgramStore::Use use(const ProgramStore::Names& names) const;
  Outcome change(const Session& session, const Call& call);
  Outcome undo(const Session& session, const Call& call);
  void look_at_heads();
  Outcome renamed(const Call& call);
  Outcome removed(const Call& call);
  Outcome list_changes(const Call& call);
  Outcome list(Outcome (*read)(Runtime*, const Call&), const Call& call) const;
  void warn_of_selected(const std::string& name, Outcome* outcome) const;
  Outcome list_programs(const Call& call) const;
  Outcome program(const Session& session, const Call& call);
  void note(const Session& session, const Call& call, Change change, Outcome* outcome);

  Runtime& runtime_;
  const share::ProgramTable& programs_;
  share::IntakeDesk& desk_;
  const share::Segment& segment_;
  ProgramStore store_;
  ProgramChecks* checks_ = nullptr;
  ChangeLog log_;
  TraceDesk trace_;
  LadderDesk ladder_;
  WatchDesk watch_;
  history::Recorder* const history_;
  ActionNotes notes_;
};

}  // namespace nc::rt::services
