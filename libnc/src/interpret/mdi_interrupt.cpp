// SPDX-License-Identifier: Apache-2.0
// Blocks of MDI in a block stop (M700 12.4.4 "MDI interrupt"): the operator enters them, a start executes them, and the next start goes on with the program.
//
// They act as if they stood in the program behind the block of the stop: they begin in the modal state of the program, radius compensation included, and what
// they change stays changed. In radius compensation "the offset vectors are automatically re-calculated at the movement block after the interrupt": the stage
// of compensation goes on from the vector at the stop, with the blocks that come now. Without a movement the path of the program stays as it was.
//
// At a place where a program is begun inside (nc/restart.h) they bring tool, spindle and coolant there, and the program comes to it in its own modes: what they
// change of these is put back behind them. Offsets and parameters cannot be: the place was found with those that were there, and another one ends the run.
// What the program has given out on the way has not come to the machine: these blocks begin with the tools and the spindle that the machine has, so a family that
// passes over the tool that is held, or the spindle that turns (DGSHAPE M06, M03), passes over what is there in truth. They stay known (State::machine_has) until
// the program goes on: what it has given out is there then, because the operator has worked through it.
//
// They are a call without a block that makes it (CallOrigin::mdi), and count as one level of calls (M700 13.3.1 (3) (5)).
#include "interpret/calls.hpp"
#include "interpret/feed.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/interpreter.hpp"
#include "interpret/lifetimes.hpp"
#include "interpret/state_hash.hpp"

namespace nc {
namespace {

/// The block behind is a part of something that has begun, and blocks in between would tear it apart or would be read as a part of it. M700 6.15 says it of a
/// NURBS ("MDI interruption: invalid"), 13.3.3 (6) of a rotating sub program, from which nothing branches.
bool inside_something(const StateValues& s) {
  return s.repeat.active || s.nurbs.active() || s.arc_step != ArcStep::none || s.meeting.kind != MeetingFirst::Kind::none || s.parameter_input ||
         s.life_input.kind != LifeInput::Kind::none;
}

}  // namespace

bool Interpreter::takes_mdi(BlockSeq seq) const {
  if (mdi || !main_program.valid() || !checkpoints_.holds(seq)) return false;
  for (unsigned level = 0; level <= state.depth; ++level)
    if (state.frame[level].origin == CallOrigin::mdi) return false;  // what has been read last is a text of MDI, which is not to be changed while it is read
  StateValues values;
  checkpoints_.values(seq, &values);
  if (values.end_seen || inside_something(values)) return false;
  CallFrame levels[kMaxFrames];
  unsigned count = 0;
  while (count < kMaxFrames && checkpoints_.frames(seq, count + 1, levels)) ++count;
  for (unsigned level = 0; level < count; ++level)
    if (levels[level].origin == CallOrigin::mdi || levels[level].figure != 0) return false;  // one text of MDI at a time
  return true;
}

void Interpreter::begin_search() {
  before_search_ = state;
  state.machine_has = in_hand(state);
  state.reads_beside_machine = true;
  keep_state();
}

/// The program does not go on from where it was begun inside, or has gone on: which tools and which spindle are known from now on.
void Interpreter::take_machine_truth() {
  if (state.reads_beside_machine && !machine_followed_) take_in_hand(state, state.machine_has);
  state.reads_beside_machine = machine_followed_ = false;
  state.machine_has = {};
}

void Interpreter::begin_inside(BlockSeq seq) {
  machine_followed_ = false;
  begun_inside_.kept = checkpoints_.holds(seq);
  if (!begun_inside_.kept) return;
  begun_inside_.seq = seq;
  checkpoints_.values(seq, &begun_inside_.state);
  look_back(seq, true);  // blocks behind the place may have been read
  begun_inside_.maps = records->maps;
  begun_inside_.tables = tables_hash(*this);
  look_back(seq, false);
}

/// As behind an interrupt program (M700 13.12), the tools and the spindle of the program, and the length that the moves have applied, too: the axes go back to the place before the program goes on.
void Interpreter::put_back_modes() {
  const Function cutting = state.modal.of(Mode::cutting);
  const SpindleControl spindle = state.spindle;
  state.machine_has = in_hand(state);
  state.reads_beside_machine = true;
  take_in_hand(state, in_hand(begun_inside_.state));
  return_from_interrupt(state, begun_inside_.state, false);
  take<AppliedLength>(state, begun_inside_.state);
  change_cutting_mode(*this, cutting);
  if (spindle.axis != state.spindle.axis || (state.spindle.axis != 0 && spindle.surface != state.spindle.surface)) announce_surface(*this);
  refresh_derived();
  change(&ProgramRecords::maps, begun_inside_.maps);
}

/// What blocks of MDI do at the place where a program is begun inside is none of its holes, and no word of its tap, which would be P186.
void Interpreter::bring_there() {
  take_in_hand(state, state.machine_has);
  state.reads_beside_machine = false;
  state.modal.set(initial_modal(*dialect).of(Mode::cycle));
  state.cycle = {};
  state.tap_code = false;
}

void Interpreter::enter_mdi(const ProgramRef& blocks) {
  const bool puts_back = begun_inside_.kept && state.seq == begun_inside_.seq;
  place_at_next_block();
  if (state.owes_mark) {  // the block that called the program which has just returned ends before them
    finish_call();
    place_at_next_block();
  }
  Entry entry;
  entry.program = blocks;
  entry.origin = CallOrigin::mdi;
  if (enter(*this, entry) == Execution::fault) {
    note_calls(source, state.frame);
    stop(fault, source);
    return;
  }
  state.frame[state.depth].modal_call = 0;  // no macro is called behind the moves of blocks that do not belong to the program
  state.frame[state.depth].puts_back = puts_back;
  if (puts_back) bring_there();
  state.spline_way = {};                    // the curve of fine segments begins again
  show_modal_call(*this);
  keep_state();
}

Execution Interpreter::leave_mdi() {
  if (check_loops_closed(*this) != Execution::done) return Execution::fault;
  if (inside_something(state)) return raise(Condition::program_end);
  const bool puts_back = state.frame[state.depth].puts_back;
  if (puts_back && tables_hash(*this) != begun_inside_.tables) return raise(Condition::restart_void);
  state.loop_count = state.frame[state.depth].loop_base;
  leave_program(*this);
  if (puts_back) put_back_modes();
  state.spline_way = {};
  Gate& stop_here = emit(ItemKind::gate).gate;
  stop_here.kind = NC_GATE_STOP;
  stop_here.behind_mdi = true;
  finish_block(false, false);
  if (puts_back) begun_inside_.seq = state.seq;
  return Execution::later;
}

}  // namespace nc
