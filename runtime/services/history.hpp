// SPDX-License-Identifier: Apache-2.0
// The services that show the memory of the machine (runtime/history/), and what is written down of the commands of operators.
#pragma once

#include <map>
#include <mutex>
#include <string>

#include "runtime/history/recorder.hpp"
#include "runtime/services/call.hpp"
#include "runtime/services/change_log.hpp"
#include "runtime/share/layout.hpp"

namespace nc::rt::services {

// `history` may be null: then there is none.
Outcome list_history(history::Recorder* history, const Call& call);
Outcome list_counters(history::Recorder* history);
Outcome list_program_times(history::Recorder* history, const Call& call);

// The name of the service that gives a command of this kind to the intake.
const char* service_of(share::RequestKind kind);

// The user for whom a connection asks: an identity of the services over DDS may be several clients at once, "dds:boss@27087", and all of them are "dds:boss".
std::string user_of_behalf(const std::string& behalf);

// Writes the commands that the intake has answered, on either way in, with their users. A command that is repeated (a jog, or one that is refused again and again)
// is written once until nothing has come of it for a second. Control that is taken or given back is not written, control that is refused is. Any thread.
class ActionNotes {
 public:
  explicit ActionNotes(history::Recorder* history) : history_(history) {}

  // A local client has this user, until it is gone. The way of DDS has no users.
  // `behalf`: for whom it asks, empty = for its user.
  void came(std::uint64_t writer, uid_t user, const std::string& behalf);
  void gone(std::uint64_t writer);
  // `request`: null for an answer that came later than the command.
  void answered(const share::Request* request, const share::Ack& ack);
  void changed(const Change& change);
  // A peer has asked for a service without its right, or has none at all (service ""): `more` times before that were not written.
  void denied(uid_t user, const std::string& behalf, const std::string& client, const std::string& service, unsigned more);
  // The name of a user. It may ask other computers, so never in the thread of the sockets.
  std::string name_of(uid_t user);

 private:
  struct Last {
    history::Entry entry;
    std::int64_t seen_ns = 0;
  };
  history::Recorder* const history_;
  std::mutex mutex_;
  struct Actor {
    uid_t user = 0;
    std::string behalf;
  };
  std::map<std::uint64_t, Actor> users_;     // of the local clients, by their number
  std::map<uid_t, std::string> names_;
  std::map<std::string, Last> last_;         // the last command of each client
};

}  // namespace nc::rt::services
