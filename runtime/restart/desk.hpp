// SPDX-License-Identifier: Apache-2.0
// A program that is begun inside, for one part system: the search in slices, the recovery list, and how far the operator is. It belongs to the feeder.
//
//   kNone -> kSearching -> kFound -> (cycle start) kStands -> (cycle start) kEnded
//
// A reset, another program, and who cancels it end it in any phase. A search without a place, another mode during the search, changed tables and blocks of MDI that
// come before the start lose the place: the operator still means it, so no program begins at its head before one of those three says so, or a place is found.
#pragma once

#include <string>

#include "runtime/nc_port.hpp"
#include "runtime/restart/wish.hpp"
#include "runtime/snapshot.hpp"

namespace nc::rt {

// The search writes variables, offsets and parameters as the program does. They stay when the program goes on from its place; else put_back() gives them back.
class RestartDesk {
 public:
  // Begins the search. `what` is the place in words.
  nc_status begin(NcPort* nc, unsigned system, const nc_restart_place& place, const nc_world& world, std::string what);
  // A slice of the search. True: it has ended without a place, and the program has to be read again from its head.
  bool search(NcPort* nc, unsigned system);
  // Goes by what the scan shows.
  void follow(const Snapshot& now, unsigned system);
  void given(const GivenCode& code) {
    if (in_hand()) status_.list.given(code.group, code.value);
  }
  // Where something was in hand or lost it has ended; `why` is a sentence.
  void end(const std::string& why);
  // Where something was in hand it is lost.
  void lose(const std::string& why);

  // The search has written what the program does not go on with.
  bool owes() const { return written_ && !in_hand(); }
  // To be called while no program is in execution. What somebody else has changed since stays.
  void put_back(NcPort* nc);

  bool searching() const { return status_.phase == RestartPhase::kSearching; }
  // A place is looked for or found, and the program does not go on from there yet.
  bool in_hand() const { return searching() || status_.phase == RestartPhase::kFound || status_.phase == RestartPhase::kStands; }
  bool lost() const { return status_.phase == RestartPhase::kLost; }
  // Entries of the recovery list are open, so the start that goes on is refused.
  bool bars() const { return (status_.phase == RestartPhase::kFound || status_.phase == RestartPhase::kStands) && status_.list.open() != 0; }
  // Where the program was begun, as the search was told.
  const nc_axes& start() const { return place_.start; }
  RecoveryList* list() { return &status_.list; }
  const RestartStatus& status() const { return status_; }

 private:
  void found(NcPort* nc, unsigned system, const nc_restart_found& found);
  nc_restart_place place_{};
  bool written_ = false;       // a search has been begun whose writes nobody goes on with
  bool after_known_ = false;
  KeptValues before_, after_;  // what the search has found, and what it has left
  RestartStatus status_;
};

}  // namespace nc::rt
