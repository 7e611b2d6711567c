// SPDX-License-Identifier: Apache-2.0
// A program that is begun inside (nc/restart.h). The search is a sink as nc_pull() is one: it takes the items up to the place, and nothing of them comes to the
// machine. What is behind the place stays where it is, in the interpreter and in the stages, and the run that a cycle start begins takes it from there.
//
//   search    head of the program ... mark of the block before the place | first item of the place
//   run       states of the scan, that mark, the stop, that mark again   | first item of the place ...
//
// The mark in front of the stop tells the scan which blocks have been executed, so that a reset in the stop, and what is read again behind it, find the
// place. The one behind it is executed by the start that goes on: until then nothing more is read, as behind M00. At the head of a program they have the number 0.
#include <cstring>

#include "control/part_system.hpp"

namespace nc {

nc_status PartSystem::restart_begin(const nc_restart_place& place, const nc_world& world) {
  if (occupied()) return NC_E_STATE;
  if (!interpreter.is_selected() || interpreter.is_mdi()) return NC_E_NOT_FOUND;
  interpreter.keep_place(false);
  interpreter.set_mirror_signal(place.mirror);
  AxisVec start = online_ ? executor.commanded() : commit_.machine();
  for (unsigned i = 0; place.start_given && i < axis_count_; ++i) start[i] = place.start.v[i];
  restart(start);
  commit_.restart();
  interpreter.begin_search();
  search_.begin(place, place.in_file ? place.file : interpreter.selected().file, world);
  return NC_OK;
}

/// Looks for the line of a sequence number. NC_OK: it is known.
nc_status PartSystem::find_sequence() {
  constexpr uint64_t kBytes = 1 << 20;  // of one call
  const nc_restart_place& place = search_.place();
  const ProgramRef& main = interpreter.selected();
  const unsigned file = place.in_file ? place.file : main.file;
  const bool begins = search_.offset == 0;
  if (begins && file == main.file) search_.offset = main.offset, search_.line = main.line;
  bool again = false;
  const bool found = interpreter.find_sequence(file, static_cast<uint32_t>(place.number), &search_.offset, &search_.line, kBytes, &again, begins);
  if (again) return NC_BUDGET;
  if (!found) return NC_E_NOT_FOUND;
  search_.found_sequence(search_.line);
  return NC_OK;
}

nc_status PartSystem::restart_find(uint32_t budget, nc_restart_found* found) {
  if (!search_.looks() || occupied()) return NC_E_STATE;
  publish_all();
  if (search_.phase() == RestartSearch::Phase::sequence) {
    const nc_status status = find_sequence();
    if (status != NC_OK) return give_up_search(status);
  }
  Passed passed;
  do {
    passed = pass_item(budget);
    if (passed.status != NC_OK) return give_up_search(passed.status);
    if (passed.kind == ItemKind::sync) answer_search();
    if (passed.kind == ItemKind::alarm) return give_up_search(NC_ALARMED);
    if (passed.kind == ItemKind::end) return give_up_search(NC_ENDED);
  } while (!passed.reached);
  if (search_.torn() || search_.radius_given()) return give_up_search(NC_E_NOT_FOUND);
  const MarkPoint* const before = commit_.newest();
  if (search_.blocks() != 0 && (before == nullptr || before->serial != commit_.serial())) return give_up_search(NC_E_NOT_FOUND);
  publish_all();  // what it has written last: the other part systems are told before their places are compared with what this search has left
  search_.found(interpreter.state_hash());
  if (search_.blocks() == 0) restart_modal_ = 0;
  search_.tell(found);
  found->source = passed.source;
  found->modal = restart_modal_;
  for (unsigned i = 0; i < axis_count_; ++i) found->machine.v[i] = commit_.machine()[i];
  return NC_OK;
}

/// The program asks for something of the machine: it stands where the program has led it.
void PartSystem::answer_search() {
  nc_world world = search_.world();
  std::memcpy(world.machine.v, commit_.machine().v, sizeof world.machine.v);
  world.skip_machine = world.machine;
  world.skipped = false;
  answer(world);
}

/// The search does not go on, unless it only waits for another call.
nc_status PartSystem::give_up_search(nc_status status) {
  if (status == NC_BUDGET) return status;
  publish_all();
  forget_search();
  return status;
}

/// Nothing of what was read on the way has come to the machine: the tool in the spindle is still that of before.
void PartSystem::forget_search() {
  if (search_.phase() == RestartSearch::Phase::none) return;
  search_.forget();
  interpreter.give_up_search();
}

nc_status PartSystem::restart_cancel() {
  if (occupied()) return NC_E_STATE;
  if (search_.phase() == RestartSearch::Phase::none) return NC_OK;
  return reset();
}

/// The scan has begun a run. True: it begins at the place that was found, and what stands before the place is given to the scan.
bool PartSystem::begin_found() {
  if (search_.phase() == RestartSearch::Phase::none) return false;
  const bool same = has_place() && executor.mirror() == search_.place().mirror;
  search_.forget();
  publish_all();
  published_ = 0;
  interpreter.set_feeding(true);
  executor.restart_at(commit_.machine(), search_.blocks());
  if (!same) {
    Fault fault;
    fault.condition = Condition::restart_void;
    stop_on(fault, interpreter.source());
    return true;
  }
  const MarkPoint* const before = commit_.newest();
  interpreter.begin_inside(before != nullptr ? before->seq : 0);
  Record record;
  record.serial = before != nullptr ? before->serial : 0;
  record.epoch = run_.epoch();
  for (unsigned i = 0; i < search_.control_count(); ++i) {
    record.kind = ItemKind::action;
    record.action = search_.controls()[i];
    executor.push(record);
  }
  const auto push_mark = [&] {
    record.kind = ItemKind::mark;
    record.mark = {};
    record.mark.modal = restart_modal_;
    record.mark.seq = before != nullptr ? before->seq : 0;
    record.mark.stop = record.mark.report = false;
    record.mark.along_tool = interpreter.along_tool();
    executor.push(record);
  };
  push_mark();
  record.kind = ItemKind::gate;
  record.gate = {};
  record.gate.kind = NC_GATE_STOP;
  record.gate.begins_again = true;
  executor.push(record);
  push_mark();
  stop_ = Stop::passed;  // what the operator sets right in the stop acts from the next block that is read
  return true;
}

}  // namespace nc
