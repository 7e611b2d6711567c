// SPDX-License-Identifier: Apache-2.0
// A program that is begun inside, for one part system: the search in slices, the recovery list, and how far the operator is. It belongs to the feeder.
//
//   kNone -> kSearching -> kFound -> (cycle start) kStands -> (cycle start) kEnded
//
// Another program and who cancels it end it in any phase. A search without a place, another mode during the search, changed tables, blocks of MDI that come before
// the start, an alarm and a reset lose the place: the operator still means it, so no program begins at its head before one of those two says so, or a place is found. Further resets
// leave that bar where it is: a reset is what is pressed first where a start is refused, and says nothing of another part.
#pragma once

#include <string>
#include <vector>

#include "runtime/nc_port.hpp"
#include "runtime/restart/coordinates.hpp"
#include "runtime/restart/wish.hpp"
#include "runtime/snapshot.hpp"

namespace nc::rt {

// The search writes variables, offsets and parameters as the program does. They stay when the program goes on from its place; else put_back() gives them back.
class RestartDesk {
 public:
  // Begins the search. `what` is the place in words; `with` are the coordinate systems that the run was begun with. Where these are not known the search begins
  // with what is in force now, as a cycle start would, and what that is has to be confirmed. `order`: a search of any part system that is begun later has a higher one.
  nc_status begin(NcPort* nc, unsigned system, const nc_restart_place& place, const nc_world& world, std::string what, const CoordinatesBegun& with, std::uint64_t order);
  // A slice of the search. One search after the other, because what a search has written is the difference between its beginning and its end. True: it has ended without a place, and the program has to be read again from its head.
  bool search(NcPort* nc, unsigned system);
  // Goes by what the scan shows.
  void follow(const Snapshot& now, unsigned system);
  void given(const GivenCode& code) {
    if (in_hand()) status_.list.given(code.group, code.value);
  }
  // Where something was in hand or lost it has ended; `why` is a sentence.
  void end(const std::string& why);
  // The machine has been reset: what was in hand is lost, so that the next start does not begin the whole program where the operator has asked for a part of it.
  void reset() { lose("a reset has ended it"); }
  // Where something was in hand it is lost.
  void lose(const std::string& why);

  // The search has written what the program does not go on with.
  bool owes() const { return written_ && !in_hand(); }
  // It owes values that others have read as well.
  bool owes_values(NcPort* nc) const;
  // As begin() was told. What the newest search has written is put back first.
  std::uint64_t order() const { return order_; }
  // To be called while no program is in execution. What somebody else has changed since stays.
  void put_back(NcPort* nc);
  // What is kept over power off: without what the search has written as long as the program does not go on with it. `now` is what there is.
  std::string kept_variables(const std::string& now) const;
  std::string kept_tables(const std::string& now) const;

  bool searching() const { return status_.phase == RestartPhase::kSearching; }
  // A place is looked for or found, and the program does not go on from there yet.
  bool in_hand() const { return searching() || status_.phase == RestartPhase::kFound || status_.phase == RestartPhase::kStands; }
  bool lost() const { return status_.phase == RestartPhase::kLost; }
  // A place or a program was asked for that is not there: as behind a search that has found nothing, no start goes on before another one is selected, or this is
  // cancelled.
  void bar_start(const std::string& why);
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
  bool before_known_ = false, after_known_ = false;
  std::uint64_t order_ = 0;
  KeptValues before_, after_;  // what the search has found, and what it has left
  unsigned system_ = 0;
  nc_restart_coordinates coordinates_before_{}, coordinates_after_{};  // the same of the coordinate systems
  std::vector<std::string> to_confirm_;  // what the search has begun with, and only the operator knows whether the part did, too
  RestartStatus status_;
};

}  // namespace nc::rt
