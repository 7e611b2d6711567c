// SPDX-License-Identifier: Apache-2.0
// G38 and G39: the vector of radius compensation at the end of their block, held or commanded, and the corner that is gone round on an arc
// (M700 12.4.2, DGSHAPE G39). The geometry is offset/.
#include <cmath>

#include "interpret/functions/functions.hpp"
#include "interpret/plane.hpp"
#include "interpret/program_map.hpp"

namespace nc {
namespace {

/// What the block commands of its vector stands in the state while its movement is made, and nowhere else.
class OfThisBlock {
 public:
  explicit OfThisBlock(InForce& in) : comp_(in.state.comp) {}
  ~OfThisBlock() { comp_.has_vector = comp_.hold_vector = comp_.corner_arc = false; }
  OfThisBlock(const OfThisBlock&) = delete;
  OfThisBlock& operator=(const OfThisBlock&) = delete;

 private:
  Compensation& comp_;
};

Execution check_mode(BlockInHand& in) {
  const FunctionRow& row = *in.words.one_shot;
  if (in.state.comp.side == 0) return in.raise_code(Condition::outside_compensation, row);
  if (in.state.cycle.kind != CycleKind::none && in.words.motion == nullptr) return in.raise_code(Condition::cycle_in_compensation, row);
  return plain_motion(in.state.modal.of(Mode::motion)) ? Execution::done : in.raise_mode(Condition::illegal_g, Mode::motion);
}

/// A corner arc is a cut: it has no feed where rapids are in force. M700 13.7 (P385) has this for ,R; 12.4.2 does not say it of G39.
Execution check_corner_motion(BlockInHand& in) {
  return in.state.modal.is(Function::rapid) ? in.raise_code(Condition::corner_motion, *in.words.one_shot) : Execution::done;
}

/// The movement of the block, or where it has none a command for the stage.
Execution move_with_vector(BlockContext& in) {
  const AxisVec before = in.state.machine;
  const Execution did = move_by_words(in);
  if (did == Execution::done && in.state.machine == before && !in.words.comp_command) move_nowhere(in);
  return did;
}

}  // namespace

/// With I J K the vector lies along them, as long as the amount; without, it stays that of the end before.
Execution do_comp_vector(BlockContext& in) {
  Execution did = check_mode(in);
  if (did != Execution::done) return did;
  const OfThisBlock scope(in);
  Compensation& comp = in.state.comp;
  const PlaneAxes plane = plane_axes(in);
  bool any = false;
  for (unsigned i = 0; i < 2; ++i) {
    const bool has = in.words.has(plane.center[i]);
    comp.vector[i] = has ? length_of(in, plane.center[i]) : 0;
    any = any || has;
  }
  if (any && comp.vector[0] == 0 && comp.vector[1] == 0) return in.raise(Condition::no_direction, plane.center[0], 0);
  // The words of an arc's centre are the vector's: then the arc has none.
  if (any && is_arc(in.state.modal.of(Mode::motion)) && !in.words.has(Role::arc_radius)) return in.raise(Condition::center_missing, plane.center[0]);
  comp.has_vector = any;
  comp.hold_vector = true;
  return move_with_vector(in);
}

Execution do_corner_arc(BlockContext& in) {
  Execution did = check_mode(in);
  if (did != Execution::done) return did;
  did = check_corner_motion(in);
  if (did != Execution::done) return did;
  const OfThisBlock scope(in);
  in.state.comp.corner_arc = true;
  return move_with_vector(in);
}

/// DGSHAPE G39, HX 13.2.1: X and Y lead on from the corner, as those of the block behind do; nothing goes there. I and J of HX are the same way as increments.
Execution do_corner_turn(BlockContext& in) {
  const FunctionRow& row = *in.words.one_shot;
  Compensation& comp = in.state.comp;
  // Where the code alone waits there is no vector yet that could go round.
  const bool pending = in.state.moved_side == 0 && in.dialect->rules.compensation.code_alone_waits;
  if (comp.side == 0 || pending) return in.raise_code(Condition::outside_compensation, row);
  if (const Execution did = check_corner_motion(in); did != Execution::done) return did;
  const uint32_t plane = 1u << comp.axis[0] | 1u << comp.axis[1], others = in.words.target.axes() & ~plane;
  if (others != 0) return in.raise_axis(Condition::illegal_axis, first_of(others));
  const PlaneAxes words = plane_axes(in);
  const bool by_vector = in.words.target.axes() == 0 && in.words.any({words.center[0], words.center[1]});
  if (in.words.target.axes() == 0 && !by_vector) return in.raise_code(Condition::words_missing, row);
  AxisVec position = in.position(), target = target_of_words(in);
  if (program_mapped(in)) {  // the vector of the move is mapped as the move is
    position = to_program(in, position);
    target = as_programmed_end(in, target);
  }
  const OfThisBlock scope(in);
  for (unsigned i = 0; i < 2; ++i) {
    const bool given = by_vector && in.words.has(words.center[i]);
    comp.vector[i] = given ? length_of(in, words.center[i]) : by_vector ? 0 : target[comp.axis[i]] - position[comp.axis[i]];
  }
  if (std::hypot(comp.vector[0], comp.vector[1]) < kNoRadius_mm) return in.raise_code(Condition::words_missing, row);
  in.words.target.clear();
  comp.has_vector = comp.corner_arc = true;
  move_nowhere(in);
  return Execution::done;
}

}  // namespace nc
