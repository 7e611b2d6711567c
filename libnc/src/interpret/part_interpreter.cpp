// SPDX-License-Identifier: Apache-2.0
// Hands on to the interpreter what control asks of it.
#include "interpret/part_interpreter.hpp"

#include <algorithm>
#include <cstring>

#include "interpret/functions/functions.hpp"
#include "interpret/interpreter.hpp"
#include "interpret/shared_tables.hpp"
#include "interpret/state_hash.hpp"

namespace nc {

void PartInterpreter::create(const InterpreterConfig& config, ProgramStore* store, CommonVariables* common, Arena& arena) {
  in_ = arena.make<Interpreter>();
  if (in_ == nullptr) {  // the arena measures: the tables are laid out for an interpreter that is thrown away
    Interpreter measured;
    measured.create(config, store, common, arena);
    return;
  }
  in_->create(config, store, common, arena);
  in_->parameters.set_filter_room(config.longest_filter_ms, config.system_index == 0);
  queue_ = &in_->queue;
  pools_ = {&in_->transforms, &in_->shapes, &in_->motion_settings, &in_->stroke_boxes};
  stroke_counter_ = &in_->stroke_counter;
  in_vendor_function_ = &in_->in_vendor_function;
}

// ---- the stream -------------------------------------------------------------------------------------------------------------

nc_status PartInterpreter::make_more(uint32_t& budget, Item** front) {
  const nc_status status = in_->step(budget);
  *front = in_->queue.front();
  return status;
}
void PartInterpreter::answer(const nc_world& world) { in_->answer(world); }
bool PartInterpreter::in_cycle() const { return in_->next_step == Step::cycle; }

/// The cycle is rehearsed as plain drilling, without the pecks, which lie within their hole. Afterwards the interpreter is as it was before.
bool PartInterpreter::rehearse_cycle(bool (*fits)(void* user, const Item& move), void* user) {
  Interpreter& in = *in_;
  const State state = in.state;
  const HolesOfBlock holes = in.jobs.holes;
  const unsigned queued = in.queue.size();
  in.jobs.holes.whole = true;
  in.jobs.holes.hole.q = 0;
  bool fit = true;
  Execution did = Execution::later;
  while (fit && did == Execution::later) {
    did = continue_cycle(in);
    if (in.queue.size() == queued) break;  // the codes of the block fill the queue, so that no move fits in
    for (unsigned i = queued; fit && i < in.queue.size(); ++i) fit = in.queue[i].kind != ItemKind::move || fits(user, in.queue[i]);
    in.queue.cut(queued);
  }
  in.state = state;
  in.jobs.holes = holes;
  return fit;
}

bool PartInterpreter::modal(uint32_t id, nc_modal* out) const {
  if (!in_->modals.holds(id)) return false;
  *out = to_public(*in_->dialect, in_->modals[id]);
  return true;
}

bool PartInterpreter::text(uint32_t id, nc_text* out) const {
  if (!in_->texts.holds(id)) return false;
  *out = in_->texts[id].text;
  return true;
}

void PartInterpreter::count_from(uint32_t first) { in_->count_from(first); }

// ---- programs ---------------------------------------------------------------------------------------------------------------

void PartInterpreter::select(const ProgramRef& program, bool mdi) {
  in_->main_program = program;
  in_->mdi = mdi;
  in_->forget_place();
}
bool PartInterpreter::is_selected() const { return in_->main_program.valid(); }
const ProgramRef& PartInterpreter::selected() const { return in_->main_program; }
bool PartInterpreter::at_line(unsigned file, uint32_t line, nc_source* source) const { return in_->at_line(file, line, source); }
bool PartInterpreter::find_sequence(unsigned file, uint32_t n, uint64_t* offset, uint32_t* line, uint64_t bytes, bool* again, bool from_head) {
  return in_->reader.find_sequence(file, n, offset, line, 0, bytes, again, from_head);
}
bool PartInterpreter::is_mdi() const { return in_->mdi; }
void PartInterpreter::reset(bool keep_modal) { in_->reset(keep_modal); }
void PartInterpreter::clear_by_reset() { in_->clear_by_reset(); }
void PartInterpreter::keep_place(bool stands) { in_->keep_place(stands); }
bool PartInterpreter::refers_to(unsigned file) const { return in_->refers_to(file); }
bool PartInterpreter::ended() const { return in_->ended; }
bool PartInterpreter::alarmed() const { return in_->alarmed; }
void PartInterpreter::set_feeding(bool feeding) { in_->feeding = feeding; }
void PartInterpreter::set_mirror_signal(uint32_t axes) { in_->mirror_signal = static_cast<uint8_t>(axes & ((1u << in_->axis_count) - 1)); }
void PartInterpreter::set_switches(uint32_t optional_skip, uint32_t mirror_axes) {
  in_->optional_skip = optional_skip;
  in_->mirror_switch = static_cast<uint8_t>(mirror_axes & ((1u << in_->axis_count) - 1));
}
void PartInterpreter::set_closed_axes(uint32_t axes) { in_->closed_axes = axes; }
void PartInterpreter::forget_vendor_call() { in_->forget_vendor_call(); }
const nc_source& PartInterpreter::source() const { return in_->source; }
uint32_t PartInterpreter::main_line() const { return in_->state.frame[0].call_line; }
BlockSeq PartInterpreter::newest_block() const { return in_->state.seq; }
bool PartInterpreter::stands_at_machine() const { return in_->world_fresh; }

bool PartInterpreter::rewind(BlockSeq seq) { return in_->rewind(seq); }
bool PartInterpreter::remembers(BlockSeq seq) const { return in_->remembers(seq); }
void PartInterpreter::look_back(BlockSeq seq, bool back) { in_->look_back(seq, back); }

// ---- positions --------------------------------------------------------------------------------------------------------------

const AxisVec& PartInterpreter::machine() const { return in_->state.machine; }
AxisVec PartInterpreter::beside_end(const uint8_t (&axis)[2], const double (&vector)[2]) const {
  AxisVec end = in_->state.machine, beside;
  const Affine* map = in_->transforms.newest();
  if (map == nullptr || in_->state.map.active()) return end;
  for (unsigned i = 0; i < 2; ++i) beside[axis[i]] = vector[i];
  beside = map->direct(beside);
  for (unsigned i = 0; i < kMaxAxes; ++i) end[i] += beside[i];
  return end;
}
void PartInterpreter::end_at(const AxisVec& machine) { in_->state.machine = machine; }
void PartInterpreter::set_machine(const AxisVec& machine) { in_->set_machine(machine); }
bool PartInterpreter::add_by_handle(double way) { return in_->add_by_handle(way); }
LengthAlongTool PartInterpreter::along_tool() const { return in_->along_tool(); }
void PartInterpreter::returned_by_hand(uint32_t axes) { in_->returned_by_hand(axes); }
AxisVec PartInterpreter::stands_at() const { return in_->stands_at(); }
const SpaceVector& PartInterpreter::vector_in_space() const { return in_->state.moved_space; }
void PartInterpreter::move_to(const AxisVec& machine, const AxisVec& beside) { in_->move_to(machine, beside); }
void PartInterpreter::shift_coordinates(unsigned axis, double by) { in_->shift_coordinates(axis, by); }
AxisVec PartInterpreter::work_zero() const {
  AxisVec zero = in_->zero();
  for (unsigned i = 0; i < in_->axis_count; ++i) zero[i] += in_->state.applied[i];
  return zero;
}
MapsInForce PartInterpreter::maps() const { return {in_->state.any_mirror() != 0, in_->state.map.active(), in_->state.map.frozen}; }
AxisVec PartInterpreter::work_shown(const AxisVec& work) const { return nc::work_shown(*in_, work); }
AxisVec PartInterpreter::machine_shown(const AxisVec& machine) const { return nc::machine_shown(*in_, machine); }
AxisSettings PartInterpreter::axis_settings() const {
  const Settings& s = in_->settings;
  return {s.index_axes, s.machine_turn, s.short_cut, s.no_reference, s.index_increment};
}

// ---- macro interrupt --------------------------------------------------------------------------------------------------------

InterruptSettings PartInterpreter::interrupts() const {
  uint32_t mode = 0;
  if (in_->state.interrupt_on) mode |= NC_INTERRUPT_ENABLED;
  if (in_->state.interrupt_depth != 0) mode |= NC_INTERRUPT_IN_SERVICE;
  return {in_->settings.interrupt_by_level, in_->settings.interrupt_type_2, mode};
}
bool PartInterpreter::interrupt(const AxisVec& machine, unsigned taken_back, bool cut_block) { return in_->interrupt(machine, taken_back, cut_block); }
bool PartInterpreter::interrupt_inside(const AxisVec& machine, unsigned items) { return in_->interrupt_inside(machine, items); }
bool PartInterpreter::takes_mdi(uint64_t seq) const { return in_->takes_mdi(seq); }
void PartInterpreter::enter_mdi(const ProgramRef& blocks) { in_->enter_mdi(blocks); }
nc_restart_coordinates PartInterpreter::coordinates() const { return in_->coordinates(); }
const nc_restart_coordinates& PartInterpreter::begun_with() const { return in_->begun_with(); }
void PartInterpreter::set_coordinates(const nc_restart_coordinates& left) { in_->set_coordinates(left); }
void PartInterpreter::begin_search() { in_->begin_search(); }
void PartInterpreter::give_up_search() { in_->give_up_search(); }
void PartInterpreter::begin_inside(BlockSeq seq) { in_->begin_inside(seq); }
void PartInterpreter::machine_has_followed() { in_->machine_has_followed(); }
void PartInterpreter::go_on_inside(unsigned items) { in_->go_on_inside(items); }
const Repeat& PartInterpreter::repeat() const { return in_->state.repeat; }
const AxisVec& PartInterpreter::interrupted_at() const { return in_->interrupted_state().machine; }

// ---- alarms -----------------------------------------------------------------------------------------------------------------

RaisedAlarm PartInterpreter::raised() const {
  const AlarmStory& story = in_->alarm_story;
  return {in_->alarm_fault, in_->alarm_source, in_->texts[in_->user_alarm_text].text.s, in_->vendor_alarm, story.cause, story.instead};
}
unsigned PartInterpreter::alarm_calls(nc_source* out, unsigned capacity) const {
  const AlarmStory& story = in_->alarm_story;
  std::copy_n(story.calls, std::min<unsigned>(story.count, capacity), out);
  return story.count;
}
void PartInterpreter::set_alarm_calls(const nc_source* calls, unsigned count) {
  AlarmStory& story = in_->alarm_story;
  story.count = static_cast<uint8_t>(std::min(count, kMaxFrames));
  std::copy_n(calls, story.count, story.calls);
}
void PartInterpreter::abort(const Fault& what, const nc_source& where) { in_->abort(what, where); }
void PartInterpreter::note_calls(const nc_source& where, BlockSeq seq) { in_->note_calls(where, seq); }
unsigned PartInterpreter::calls_behind(const nc_source& where, BlockSeq seq, nc_source (&calls)[NC_MAX_CALLS]) const {
  static_assert(kMaxFrames <= NC_MAX_CALLS);
  nc_source found[kMaxFrames];
  const unsigned count = in_->calls_behind(where, seq, found);
  std::copy_n(found, count, calls);
  return count;
}

// ---- tables -----------------------------------------------------------------------------------------------------------------

void PartInterpreter::join(SharedTables* shared) { shared->join(*in_); }
bool PartInterpreter::shares() const { return in_->shared != nullptr; }
void PartInterpreter::publish(BlockSeq executed) { in_->shared->publish(*in_, executed); }

uint64_t PartInterpreter::state_hash() const { return nc::state_hash(*in_); }

}  // namespace nc
