// SPDX-License-Identifier: Apache-2.0
#include "interpret/context.hpp"

#include <cstring>
#include <new>

#include "interpret/journal_keys.hpp"
#include "interpret/registered_codes.hpp"
#include "interpret/shared_tables.hpp"

namespace nc {

void AlarmSubject::name_in(Fault& fault, const AddressTable& addresses) const {
  if (kind_ == Kind::word) name_word(fault, WordSlot{number_});
  if (kind_ == Kind::role) name_word(fault, addresses.word(static_cast<Role>(number_)));
  if (kind_ == Kind::sign) name_sign(fault, static_cast<Sign>(number_));
}

Execution BlockInHand::raise(Condition condition, AlarmSubject about, std::optional<double> value) {
  fault = Fault{};
  fault.condition = reader.failure() != Condition::none ? reader.failure() : condition;
  about.name_in(fault, dialect->addresses);
  fault.has_value = value.has_value();
  if (value) fault.value = *value;
  return Execution::fault;
}

void InForce::refresh_axis_words() {
  axis_words.name(system->axis, axis_count);
  if (state.mill.hypothetical_word != kNoWord) axis_words.add(state.mill.hypothetical_word, state.map.rotary);
}

AxisVec InForce::polar_position() const {
  const AxisVec& z = zero();
  AxisVec offset;
  for (unsigned i = 0; i < kMaxAxes; ++i) offset[i] = z[i] + state.applied[i];
  return to_programmed(state.map, Affine::translation(offset), state.machine);
}

void InForce::set_table(unsigned key, double value) {
  variables.note(state.seq + 1, kFrameKey + key, JournalValue::of(frames.get(key)));
  frames.set(key, value);
  if (frames.is_tool_key(key)) take_changed_amounts(*this);
}

void BlockInHand::note_parameter(unsigned index, ParameterValue old) {
  variables.note(state.seq + 1, kParameterKey + index, old.journalled());
  refresh_settings();
}

bool BlockInHand::set_parameter(ParameterOf parameter, double number, int axis) {
  unsigned index = 0;
  ParameterValue old;
  if (parameters.set(*dialect, parameter, axis, number, &index, &old) != NC_OK) return false;
  note_parameter(index, old);
  return true;
}

void BlockInHand::refresh_settings() {
  settings_stale_ = false;
  settings_of_moves_stale_ = true;
  settings = parameters.settings(*dialect);
  for (uint32_t* axes : {&settings.turning, &settings.short_cut, &settings.machine_turn, &settings.tool_change_axes})
    *axes &= axes == &settings.tool_change_axes ? (1u << axis_count) - 1 : rotary;
  settings.index_axes &= (1u << axis_count) - 1;
  settings.mirror_axes &= (1u << axis_count) - 1;
  reader.check_block_parity(settings.parity_units);
  reader.semicolon_begins_comment(settings.semicolon_comments);
  variables.share(settings.last_shared);
  code_calls = dialect->lex->macros ? read_code_calls(parameters, *dialect) : CodeCalls{};
  codes_call = code_calls.any || vendor->any();
}

Item& BlockContext::emit(ItemKind kind) {
  Item& item = next_item(kind, kind == ItemKind::mark);
  if (kind != ItemKind::mark) world_fresh = false;
  switch (kind) {
    case ItemKind::move:
    case ItemKind::mark: break;  // the caller sets all members of these
    case ItemKind::action: new (&item.action) Action(); break;
    case ItemKind::gate: new (&item.gate) Gate(); break;
    case ItemKind::sync: new (&item.sync) Sync(); break;
    case ItemKind::alarm: new (&item.alarm) Fault(); break;
    case ItemKind::end: new (&item.end) End(); break;
  }
  return item;
}

[[gnu::noinline]] void BlockContext::take_settings_of_moves() {
  settings_of_moves_stale_ = false;
  settings_of_moves_ = motion_settings.intern({settings.accuracy, settings.fairing, settings.filters, settings.index_axes, settings.machine_turn, settings.corner_arcs, settings.arc_tolerance, settings.rapid_dry});
}

void BlockContext::keep_call() {
  ++state.seq;
  state.repeat = {};
  if (state.interrupt_depth != 0) note_interrupt_items();
  keep_state();
}

void BlockContext::emit_stop_point(bool resume) {
  Item& item = emit(ItemKind::mark);
  item.block_end = false;
  new (&item.mark) Mark{position(), modals.intern(state.modal), resume ? state.seq : 0, 0,
                        (state.suppressed & NC_SUPPRESS_SINGLE_BLOCK) == 0 && !state.modal.is(Function::tapping_mode), false, resume, false, {}};
  item.mark.along_tool = along_tool();
}

ModalId BlockContext::modal_now(bool executable) {
  // Macro statements and most moves change no mode: behind them the modal state is that of the mark before.
  if (!modal_unchanged_) newest_modal_ = modals.intern(state.modal);
  if (modal_unchanged_ && !state.modes_ahead) return newest_modal_;
  // M700 13.5.5: G codes beside G65 are pre-read modals; for #4201 and so on the block in execution is still the one before the call.
  if (executable) state.executed = state.modal;
  state.modes_ahead = !executable && !(state.executed == state.modal);
  return newest_modal_;
}

void BlockContext::finish_block(bool stop, bool executable) {
  ++state.seq;
  state.repeat = next_repeat_;
  next_repeat_ = {};
  if (state.interrupt_depth != 0) note_interrupt_items();
  if (stop && (state.end_seen ||             // the program has ended, so a start could not go on from here
               state.nurbs.active() ||       // M700 6.15: single block stops only at the last control point
               (state.suppressed & NC_SUPPRESS_SINGLE_BLOCK) ||   // M700 13.5.9: #3003 bit 0 suppresses single block
               (state.special != 0 && state.modal.is(Function::tapping_mode))))  // M700 7.11 (4)
    stop = false;
  Item& item = next_item(ItemKind::mark, executable);
  new (&item.mark) Mark{position(), modal_now(executable), state.seq, 0, stop, true, true, begins_again, state.repeat};
  item.mark.along_tool = along_tool();
  item.mark.aside = aside;
  item.mark.of_call = call_ends;
  call_ends = false;
  begins_again = false;
  modal_unchanged_ = false;
  world_fresh = false;
  if (state.end_seen) emit_end();
  checkpoints_.save(state);
}

void BlockContext::emit_end() {
  Item& end = emit(ItemKind::end);
  end.end.ok = true;
  end.end.work = position();
  end.end.modal = modals.intern(state.modal);
  if (mdi) end.end.along_tool = along_tool();
  ended = true;
}

/// Notes whether the block in hand, which belongs to the interrupt program, has put a move or M S T B into the stream.
void BlockContext::note_interrupt_items() {
  for (unsigned i = 0; i < queue.size(); ++i) {
    const Item& item = queue[i];
    const bool code = item.kind == ItemKind::action && item.action.kind <= NC_ACTION_B;
    if (item.kind == ItemKind::move || code) state.interrupt_moved = true;
  }
}

}  // namespace nc
