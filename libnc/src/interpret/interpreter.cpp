// SPDX-License-Identifier: Apache-2.0
// The main loop: reading the next block, blocks that take several calls, checkpoints, rewind, reset.
#include "interpret/interpreter.hpp"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <new>
#include <utility>

#include "interpret/functions/functions.hpp"
#include "interpret/journal_keys.hpp"
#include "interpret/plane.hpp"
#include "interpret/shared_tables.hpp"
#include "interpret/work_rotation.hpp"

namespace nc {
namespace {

unsigned power_of_two_above(unsigned n) {
  unsigned p = 1;
  while (p < n) p *= 2;
  return p;
}

}  // namespace

void Interpreter::create(const InterpreterConfig& config, ProgramStore* program_store, CommonVariables* common_variables, Arena& arena) {
  dialect = config.dialect;
  system = config.system;
  system_index = config.system_index;
  axis_count = config.system->axis_count;
  refresh_axis_words();
  for (unsigned i = 0; i < axis_count; ++i) {
    if (config.system->axis[i].rotary) rotary |= 1u << i;
  }
  codes.create(*dialect);
  vendor = config.vendor;
  retract_overlap = config.retract_overlap;
  if (vendor->replaces_g(codes.linear().code)) codes.forget_linear();
  words.addresses = &dialect->addresses;
  front.dialect = dialect;
  front.codes = &codes;
  front.axis_words = &axis_words;
  front.vendor = vendor;
  front.calls = &code_calls;
  front.misc_codes = &settings.misc_codes;
  front.code_words = set_of({Role::code, Role::misc_code, Role::sequence_number, Role::program_number});
  front.core = this;
  front.questions = &kCoreAnswers;
  front.fault = &fault;
  front.sync = &sync_needed;
  store = program_store;
  common = common_variables;
  const unsigned under_way = power_of_two_above(2 * config.look_ahead + 256);
  parameters.create(512, arena, &variables.journal());
  frames.create(config.frames, arena);
  variables.create(common, dialect->variables->last_local, journal_capacity(config.look_ahead), arena);
  if (dialect->lex->formula == Formula::ngc) variables.create_named(arena);
  reader.create(store, dialect->lex, config.window_bytes, config.look_ahead < 256 ? 16 : 128, arena);
  transforms.create(under_way, arena);
  modals.create(under_way, arena);
  texts.create(power_of_two_above(config.look_ahead + 64), arena);  // enough for a DPRNT in every block that is under way
  records.create(&variables.journal(), kRecordKey, arena);
  lives.create(&variables.journal(), kLifeKey, arena);
  rewritten = arena.make<Block>();
  shapes.create(128, arena);
  stroke_boxes.create(64, arena);
  motion_settings.create(kMotionSettings, arena);
  points.create(power_of_two_above(config.look_ahead + 128), arena);
  queue.create(arena);
  checkpoints_.create(power_of_two_above(config.look_ahead + 64), arena);
  if (!arena.measuring() && !arena.overflowed()) {
    refresh_settings();
    reset();
    ended = true;  // nothing is selected yet
  }
}

unsigned Interpreter::journal_capacity(unsigned look_ahead) {
  return power_of_two_above(4 * look_ahead < 4096 ? 4096 : 4 * look_ahead);
}

void Interpreter::set_table_from_outside(unsigned key, double value) {
  frames.set(key, value);
  variables.changed_from_outside(kFrameKey + key, JournalValue::of(value));
  if (frames.is_tool_key(key)) take_changed_amounts(*this);
}

void Interpreter::undo(void* self, uint32_t key, JournalValue old) {
  exchange(self, key, old);
  if (place_of(key).table == JournalTable::parameters) static_cast<Interpreter*>(self)->settings_stale_ = true;
}

/// Exchanges a value that is not a variable. The settings are not made anew, because nothing is executed while values are exchanged for a look.
JournalValue Interpreter::exchange(void* self, uint32_t key, JournalValue value) {
  Interpreter& in = *static_cast<Interpreter*>(self);
  const JournalPlace place = place_of(key);
  switch (place.table) {
    case JournalTable::records: return in.records.exchange(place.index, value);
    case JournalTable::lives: return in.lives.exchange(place.index, value);
    case JournalTable::parameters: return in.parameters.exchange(place.index, ParameterValue::of(value)).journalled();
    case JournalTable::variables:
    case JournalTable::frames: break;
  }
  const JournalValue old = JournalValue::of(in.frames.get(place.index));
  in.frames.set(place.index, value.as<double>());
  return old;
}

// ---- program selection, reset, rewind ----------------------------------------------------------------------------------

InitialValues Interpreter::initial_values() const {
  InitialValues initial;
  ModalState& modal = initial.modal;
  modal = initial_modal(*dialect);
  if (!settings.start_absolute) modal.set(Function::incremental);  // M700 5.1 (4)
  if (settings.start_inch) modal.set(Function::inch);
  if (settings.start_synchronous) modal.set(Function::feed_per_revolution);  // M700 7.4 note 6, 7.5 (3)
  if (settings.start_high_accuracy) modal.set(Function::high_accuracy_mode);  // M700 13.15 (4)
  if (settings.start_linear) modal.set(Function::linear);  // HX 3.2
  if (settings.start_stroke_check) modal.set(Function::stroke_check_on);  // HX 3.2
  if (settings.start_scaling) modal.set(Function::scaling_on);
  if (settings.start_rotation) modal.set(Function::rotation_on);
  modal.set(settings.start_plane);
  basic_plane_axes(*this, settings.start_plane, initial.plane_axis, &initial.third_axis);
  initial.motion_outlives_end = dialect->rules.program.motion_outlives_end;
  initial.keeps_polar_command = settings.keeps_polar_command;
  initial.keeps_clamp = settings.keeps_clamp;
  return initial;
}

/// HX 3.2: scaling by the factors of the axes, and rotation by the angle that is set, begin with the program, about its zero point.
void Interpreter::start_maps(ProgramMaps* maps) {
  const RangeRules& range = dialect->rules.range;
  if (settings.start_scaling) {
    state.scaled = static_cast<uint8_t>(~rotary & ((1u << axis_count) - 1));
    for (unsigned i = 0; i < axis_count; ++i) {
      const double size = std::fabs(settings.axis_factor[i]);
      maps->scaling_factor[i] = size >= range.least_scale && size <= range.most_scale ? settings.axis_factor[i] : 1;
      maps->scaling_center[i] = 0;
    }
  }
  if (!settings.start_rotation) return;
  maps->rotation_deg = settings.rotation_deg;
  maps->rotation_center[0] = maps->rotation_center[1] = 0;
  state.rotated = true;
}

/// HX 3.2: the stroke check begins with the program, for the area that was given last. Without one nothing may move.
void Interpreter::start_stroke_check() {
  if (!settings.start_stroke_check) return;
  StrokeBox box = records->area.box;
  box.outside = settings.box_outside;
  box.unknown = !box.limits_any();
  state.stroke_box = stroke_boxes.intern(box) + 1;
}

void Interpreter::refresh_derived() {
  state.refresh_accuracy();
  state.refresh_special();
  refresh_axis_words();
  refresh_work_rotation(*this);
}

/// M700 3.7 "reset 2": modal state to its initial values; positions, offsets and G92 shifts stay (M700 9.1). Where the place of a program is kept
/// (program_restart.cpp), that program goes on there in its modes.
void Interpreter::reset(bool keep_modal) {
  begun_inside_.kept = false;
  take_machine_truth();
  keep_modal = keep_modal || place_.kept;
  SpaceVector along_tool = state.moved_space;
  const SpaceVector beside_radius = space_compensation_vector(*this);
  for (unsigned i = 0; state.space.on && i < 3; ++i) along_tool.v[i] -= beside_radius.v[i];
  begin_program(state, initial_values(), keep_modal);
  if (state.tool_length != 0) state.moved_space = along_tool;  // the axes still stand beside the program by it
  if (dialect->rules.coordinate.shift_ends_with_program && !keep_modal)
    for (unsigned i = 0; i < axis_count; ++i) set_table_from_outside(Frames::shift_key(i), 0);
  if (place_.kept) {
    static_cast<CallStack&>(state) = place_.stack;
    state.percent_seen = !place_.head;  // a '%' to come is the end
  } else {
    state.frame[0].program = main_program;
    state.frame[0].offset = state.frame[0].begin = main_program.offset;
    state.frame[0].line = state.frame[0].begin_line = main_program.line;
    variables.clear_locals(1);
  }
  if (shared != nullptr) {
    shared->publish(*this, ~BlockSeq{0});  // everything that has not been taken back by now has been executed
    shared->keep_for_good(*this);
  }
  variables.forget();
  ProgramRecords left = *records;
  begin_program(left, keep_modal, dialect->rules.reference.forgets_with_program);
  if (!keep_modal) start_maps(&left.maps);
  if (!keep_modal) start_stroke_check();
  records.change_from_outside(left);
  program_changed();
  refresh_derived();
  take_work_rotation(*this, true);  // M700 13.21 (4): the parameters act from the cycle start on
  store->forget_notes(system_index);
  if (!place_.kept) begun_with_ = coordinates();
  forget_block();
  ended = !main_program.valid();
  alarm_fault = Fault{};
  answered_ = ~BlockSeq{0};
  checkpoints_.clear();
  keep_state();
  forget_vendor_call();
}

/// Forgets everything that was under way, because reading begins at another place.
void Interpreter::forget_block() {
  newest_modal_ = kNoModal;
  queue.clear();
  waiting_ = false;
  next_step = Step::none;
  after_block = nullptr;
  next_repeat_ = {};
  statement = 0;
  begins_again = false;
  alarmed = false;
  world_fresh = false;
}

/// The axes do not stand where the program has left them. In the plane of G12.1 a point can be reached by two positions of the axes: the program goes on
/// from the one at which they really are (M700 6.10). What a curve knew of the way before does not count any more.
/// Notes how far the tool stands beside a path under radius compensation. In a map of programmed coordinates that is not known, and the next line leads on from
/// where the tool is.
void Interpreter::displace_compensated(const AxisVec& beside) {
  Compensation& comp = state.comp;
  if (comp.side == 0 || state.moved_side != comp.side || state.mapped || state.map.active()) return;
  for (unsigned i = 0; i < 2; ++i) comp.by_hand[i] += beside[comp.axis[i]];
}

void Interpreter::moved_by_hand() {
  if (state.map.kind == AxisMap::Kind::polar) {
    const unsigned linear = state.map.linear;
    const double radius = state.machine[linear] - zero()[linear] - state.applied[linear];
    if (radius != 0) state.map.side = radius < 0 ? -1 : 1;
  }
  state.spline_way = {};
  state.polar_angle_known = false;
}

void Interpreter::shift_coordinates(unsigned axis, double by) {
  if (state.map.kind == AxisMap::Kind::polar && axis == state.map.rotary) {
    state.map.angle += by;  // the plane is rotated together with the axis
    return;
  }
  set_table_from_outside(Frames::shift_key(axis), frames.get(Frames::shift_key(axis)) + by);
}

bool Interpreter::add_by_handle(double way) {
  if (along_tool().number == 0) return false;
  const double before = state.length_by_handle;
  state.length_by_handle += way;
  state.tool_length = amount_along_tool(*this);
  const bool fits = std::fabs(state.tool_length) < end_of_offset(*this, NC_TOOL_LENGTH);
  if (fits) {
    state.length_changed_by_handle = true;
  } else {
    state.length_by_handle = before;
    state.tool_length = amount_along_tool(*this);
  }
  keep_state();
  return fits;
}

bool Interpreter::refers_to(unsigned file) const {
  if (main_program.valid() && main_program.file == file) return true;
  for (unsigned level = 0; level <= state.depth; ++level)
    if (state.frame[level].program.file == file) return true;
  return (store->entry(file)->noted >> system_index & 1) != 0 || checkpoints_.call(file);
}

AxisVec Interpreter::beside_by(const SpaceVector& vector) const {
  AxisVec beside;
  for (unsigned i = 0; vector.on && i < 3; ++i) beside[vector.axis[i]] = vector.v[i];
  const Affine* map = transforms.newest();
  return map == nullptr ? beside : map->direct(beside);
}

AxisVec Interpreter::stands_at() const {
  AxisVec place = state.machine;
  const AxisVec beside = beside_by(state.moved_space);
  for (unsigned i = 0; i < kMaxAxes; ++i) place[i] += beside[i];
  return place;
}

/// The vector along the tool is none any more where the axes stand, and no movement leads back from it.
void Interpreter::returned_by_hand(uint32_t axes) {
  const AxisVec place = stands_at();
  cancel_length_by_hand(*this, axes);
  const AxisVec beside = beside_by(state.moved_space);
  for (unsigned i = 0; i < kMaxAxes; ++i) state.machine[i] = place[i] - beside[i];
  keep_state();
}

void Interpreter::set_machine(const AxisVec& machine) {
  const AxisVec beside = beside_by(state.moved_space);
  const bool moved = !(machine == stands_at());
  for (unsigned i = 0; i < kMaxAxes; ++i) state.machine[i] = machine[i] - beside[i];
  if (moved) moved_by_hand();
  const auto mirrored = static_cast<uint8_t>(mirror_switch | mirror_signal | settings.mirror_axes);
  if (state.seq == 0 && (mirrored | state.switch_mirror) != 0) {  // at the head of a program
    state.switch_mirror = mirrored;
    records.change_from_outside(&ProgramRecords::switch_mirror, SwitchMirror{machine});
    program_changed();
  }
  if (state.seq == 0) take_work_rotation(*this, true);
  checkpoints_.clear();
  keep_state();
}

void Interpreter::clear_by_reset() {
  end_by_operator(state);
  if (!settings.reset_clears_common) return;
  const VariableRange cleared = dialect->variables->cleared;
  for (uint32_t n = cleared.first; n <= cleared.last; ++n) {
    if (!common->exists(n)) continue;
    if (shared != nullptr && variables.shares(n)) {
      shared->set_variable(n, Value{});
    } else {
      variables.set_from_outside(n, 0, Value{});
    }
  }
}

/// Takes back what blocks after `seq` have written; false: the journal does not reach back that far.
bool Interpreter::take_back(BlockSeq seq) {
  if (shared != nullptr && !shared->reaches(*this, seq)) return false;
  if (!variables.rewind(seq, this, undo)) return false;
  if (settings_stale_) refresh_settings();
  if (shared != nullptr) shared->take_back(*this, seq);
  return true;
}

bool Interpreter::rewind(BlockSeq seq) {
  if (!checkpoints_.holds(seq) || !take_back(seq)) return false;
  if (seq < vendor_call_.seq) forget_vendor_call();
  checkpoints_.restore(seq, &state);
  take_changed_amounts(*this);  // the host may have changed offsets since then
  refresh_axis_words();
  forget_block();
  ended = false;
  if (state.end_seen) emit_end();  // the end item comes behind the mark, so it has been given up
  know_world_again();
  return true;
}

void Interpreter::answer(const nc_world& answered) {
  world = answered;
  waiting_ = false;
  if ((waiting_for_ & NC_SYNC_SKIP) != 0) return;
  world_fresh = true;
  answered_ = state.seq;
}

// ---- blocks ------------------------------------------------------------------------------------------------------------

nc_status Interpreter::step(uint32_t& budget) {
  while (queue.empty()) {
    if (waiting_) return NC_WAITING;
    if (ended) return alarmed ? NC_ALARMED : NC_ENDED;
    if (budget == 0) return NC_BUDGET;
    --budget;
    if (next_step == Step::none) {
      made_ = 0;
      block_seq_ = state.seq;
    }
    const nc_status status = run_block(budget);
    made_ += queue.size() + std::exchange(counted, 0);
    if (status != NC_OK) return status;
  }
  return NC_OK;
}

bool Interpreter::at_line(unsigned file, uint32_t line, nc_source* at) const {
  const CallFrame& frame = state.frame[state.depth];
  if (frame.line != line || frame.program.file != file) return false;
  if (!queue.empty() || next_step != Step::none || waiting_ || ended || state.owes_mark || frame.last_begun) return false;
  *at = {line, frame.program.number, system_index, static_cast<uint8_t>(state.depth), frame.program.file};
  return true;
}

bool Interpreter::skipped(const Block& b) const { return b.skip != 0 && ((optional_skip >> b.skip) & 1) != 0; }

/// Handles what comes before the words of a block: its place in the program, '%', O, N, optional skip. False: there are no words to execute, and *status
/// is the result of the step.
bool Interpreter::enter_block(CallFrame& frame, nc_status* status) {
  *status = NC_OK;
  const auto settled = [&](Execution did) {
    *status = settle(did);
    return false;
  };
  source.line = block->end_of_text ? last_line : block->line;
  if (!block->end_of_text) last_line = block->line;
  if (!frame.started && store->entry(frame.program.file)->edited) return settled(raise(Condition::program_edited));  // M700 P235
  const auto bad_row = [](const Block& b) {  // M700 3.4: parity is checked whether the block is skipped or not
    return b.has_fault && (b.fault.condition == Condition::parity || b.fault.condition == Condition::parity_vertical);
  };
  const bool half_done = ((state.codes_left >> state.depth) & 1) != 0;  // the block has moved already, so it is not skipped now
  if (skipped(*block) && !bad_row(*block) && !half_done) {
    frame.offset = block->next;
    frame.line = block->next_line;
    return false;
  }
  // A further O number begins another program. A family without sub programs has one O number in a program, and its manual shows it behind a block, too.
  const bool number_again = block->has_o && frame.started;
  const bool one_number = dialect->call_depth == 0;
  if (number_again && one_number && frame.program.number != 0) return settled(raise(Condition::format_error, Role::program_number, block->o));  // DGSHAPE 1-1, 2-6
  if (block->percent || block->end_of_text || (number_again && !one_number)) {
    const bool data_end = dialect->percent_required && state.percent_seen;  // DGSHAPE 2-6: the second '%' ends the data, even if nothing is between the two
    if (block->percent && !frame.started && !data_end) {  // the start mark
      if (block->has_fault) {
        fault = block->fault;
        return settled(Execution::fault);
      }
      state.percent_seen = true;
      frame.offset = block->next;
      frame.line = block->next_line;
      return false;
    }
    const Execution did = text_ended(*this);
    return did == Execution::later ? false : settled(did);
  }
  const bool blank = block->empty && !block->has_n && !block->has_o && !block->has_fault;  // there are only comments
  if (dialect->percent_required && state.depth == 0 && !state.percent_seen && !blank) return settled(raise(Condition::no_start_mark));
  if (block->has_o) {
    frame.program.number = source.program = block->o;
    state.modal.o = block->o;
  }
  if (block->has_n) state.modal.n = block->n;
  if (block->has_fault) {
    fault = block->fault;
    return settled(Execution::fault);
  }
  if (!block->empty || block->has_n || block->has_o) frame.started = true;
  if (!block->empty) return true;
  if (frame.last_sequence != 0) note_last_block(frame);
  frame.offset = block->next;
  frame.line = block->next_line;
  if (block->has_n || block->has_o) finish_block(false, false);
  return false;
}

/// The block that has called a program ends with the return from it: its mark. `source` has the place but for the line.
void Interpreter::finish_call() {
  state.owes_mark = false;
  source.line = state.frame[state.depth].call_line;
  call_ends = true;
  finish_block(false, false);  // M700 13.3.1: single block has had its stop before the call
}

nc_status Interpreter::run_block(uint32_t& budget) {
  (void)budget;
  if (next_step != Step::none) return settle(continue_block(*this));
  CallFrame& frame = state.frame[state.depth];
  place_in_program();
  if (state.owes_mark) {
    finish_call();
    return NC_OK;
  }
  if (state.stop_reading) {  // M700 4.2: an M code that prohibits reading ahead
    state.stop_reading = false;
    source.line = frame.line;
    return settle(need(NC_SYNC_STOPPED));
  }
  if (frame.last_begun) return settle(return_behind_last(*this));
  block = reader.read(frame.program.file, frame.offset, frame.line);
  if (block == nullptr) {
    source.line = frame.line;
    return settle(raise(Condition::read_failed));
  }
  if (block->ordinary && frame.started) [[likely]] {
    source.line = last_line = block->line;
  } else {
    nc_status status = NC_OK;
    if (!enter_block(frame, &status)) return status;
  }
  const uint64_t begin = block->begin;
  const uint32_t line = block->line;
  const uint8_t depth = state.depth;
  frame.offset = block->next;
  frame.line = block->next_line;
  if (frame.last_sequence != 0) note_last_block(frame);
  const bool no_statements = block->statements.empty();
  if (no_statements && execute_plain_line(*this)) return settle(Execution::done);
  const Execution did = no_statements ? execute_words(*this) : execute_statements();
  if (did == Execution::sync && next_step == Step::none) {  // this block is read again when the answer is there
    state.frame[depth].offset = begin;
    state.frame[depth].line = line;
    state.frame[depth].last_begun = false;
  }
  return settle(did);
}

void Interpreter::note_last_block(CallFrame& frame) const { frame.last_begun = block->has_n && block->n == frame.last_sequence; }

Execution Interpreter::execute_statements() {
  // M700 13.17.1 precaution (12): no variables and macro statements in high-speed high-accuracy control II.
  if (state.fine_mode > FineMode::accuracy1) return raise(Condition::format_error, Sign::variable);
  while (statement < block->statements.size()) {
    jumped = false;
    const Execution did = execute_statement(*this, block->statements[statement]);
    if (did != Execution::done) {
      if (did != Execution::sync && did != Execution::fault) statement = 0;  // note_cause() still needs the number of a statement that is wrong
      return did;
    }
    if (jumped) {
      state.frame[state.depth].last_begun = false;  // it goes on there
      break;
    }
    ++statement;
  }
  statement = 0;
  return Execution::done;
}

/// Puts into the stream what follows from the result of a block.
nc_status Interpreter::settle(Execution did) {
  const bool kept = modal_kept;
  modal_kept = false;
  switch (did) {
    case Execution::done: {
      next_step = Step::none;
      // Macro statements are executed together with the executable block before them, unless #8101 is on (M700 13.5.9).
      const bool macro = block != nullptr && !block->statements.empty();
      modal_unchanged_ = block != nullptr && (macro || kept) && !block->has_n && !block->has_o && newest_modal_ != kNoModal;
      finish_block(!macro || settings.macro_single, !macro);
      return NC_OK;
    }
    case Execution::later: return NC_OK;
    case Execution::sync: {
      if (statement > 0) keep_call();  // the statements before this one are done
      Item& item = emit(ItemKind::sync);
      item.sync.what = waiting_for_ = sync_needed & ~kSyncAhead;
      item.sync.ahead = (sync_needed & kSyncAhead) != 0;
      waiting_ = true;
      return NC_OK;
    }
    case Execution::fault: break;
  }
  note_calls(source, state.frame);
  note_cause(*this);
  // Nothing of a block with an alarm is executed, unless parts of it have been given out already.
  if (next_step == Step::none) take_block_back();
  stop(fault, source);
  return NC_OK;
}

/// Takes back what the block in hand has put into the stream, and what it has changed.
void Interpreter::take_block_back() {
  queue.cut(0);
  if (!checkpoints_.holds(state.seq) || !take_back(state.seq)) return;
  checkpoints_.restore(state.seq, &state);
  newest_modal_ = kNoModal;
  refresh_axis_words();
}

void Interpreter::stop(const Fault& what, const nc_source& where) {
  next_step = Step::none;
  after_block = nullptr;
  next_repeat_ = {};
  statement = 0;
  waiting_ = false;
  alarm_fault = what;
  alarm_source = source = where;
  emit(ItemKind::alarm).alarm = what;
  Item& end = emit(ItemKind::end);
  end.end.ok = false;
  end.end.work = position();
  end.end.modal = modals.intern(state.modal);
  ended = alarmed = true;
}

unsigned Interpreter::calls_of(const nc_source& where, const CallFrame* levels, nc_source (&calls)[kMaxFrames]) {
  unsigned count = 0;
  for (; count < where.depth; ++count) {
    const CallFrame& frame = levels[count];
    nc_source& call = calls[count];
    call = where;
    call.line = frame.call_line;
    call.program = frame.program.number;
    call.file = frame.program.file;
    call.depth = static_cast<uint8_t>(count);
  }
  calls[count++] = where;
  return count;
}

void Interpreter::note_calls(const nc_source& where, const CallFrame* levels) {
  alarm_story = AlarmStory{};
  alarm_story.count = static_cast<uint8_t>(calls_of(where, levels, alarm_story.calls));
}

unsigned Interpreter::calls_behind(const nc_source& where, BlockSeq seq, nc_source (&calls)[kMaxFrames]) const {
  if (where.depth == 0) return calls_of(where, nullptr, calls);
  // After a block come calls, which have no mark yet, and then the next block. So the first state that is as deep as the block `where` has its callers.
  CallFrame levels[kMaxFrames];
  for (; checkpoints_.holds(seq); ++seq) {
    if (!checkpoints_.frames(seq, where.depth + 1u, levels)) continue;
    const ProgramRef& program = levels[where.depth].program;
    if (program.file == where.file && program.number == where.program) return calls_of(where, levels, calls);
  }
  return 0;
}

void Interpreter::note_calls(const nc_source& where, BlockSeq seq) {
  alarm_story = AlarmStory{};
  alarm_story.count = static_cast<uint8_t>(calls_behind(where, seq, alarm_story.calls));
  if (alarm_story.count == 0) note_calls(where, state.frame);
}

void Interpreter::abort(const Fault& what, const nc_source& where) {
  queue.cut(0);
  stop(what, where);
}

}  // namespace nc
