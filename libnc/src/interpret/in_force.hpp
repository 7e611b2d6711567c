// SPDX-License-Identifier: Apache-2.0
// What is in force between two blocks: the machine and its family, the state, and the tables. A question that needs nothing of the block in hand gets this
// and no more.
#pragma once

#include "base/intern_pool.hpp"
#include "command/words_of_block.hpp"
#include "dialect/code_index.hpp"
#include "frame/frames.hpp"
#include "frame/stroke_box.hpp"
#include "frame/tool_life.hpp"
#include "interpret/parameters.hpp"
#include "interpret/program_matrices.hpp"
#include "interpret/program_records.hpp"
#include "interpret/state.hpp"
#include "macro/variables.hpp"
#include "nc/config.h"
#include "stream/stream.hpp"

namespace nc {

/// A point that later blocks need: where axes are held (G07), a point of an arc in space, or a control point of a NURBS.
struct PathPoint {
  AxisVec at;
  double weight = 1, knot = 0;  ///< weight and knot of a control point
  double feed = 0;              ///< feed of the block in which an arc in space starts ...
  uint16_t feed_digit = 0;      ///< ... and ModalState::feed_digit in it
  nc_source source{};
  bool operator==(const PathPoint&) const { return false; }  // two points are never stored as one
};

class SharedTables;
struct Interpreter;

struct InForce {
  // ---- the machine and its family: fixed, except for the words that a mode gives to axes
  const Dialect* dialect = nullptr;
  const nc_system_config* system = nullptr;
  uint8_t system_index = 0;        ///< part system, from 0
  unsigned axis_count = 3;
  uint32_t rotary = 0;             ///< bit i: axis i is rotary
  AxisWords axis_words;            ///< which words command axes
  uint32_t closed_axes = 0;        ///< bit i: axis i is a spindle, or a C axis without its reference (M700 10.5); no command now
  CodeIndex codes;                 ///< the family's G codes
  double retract_overlap = 0;      ///< how far the tool goes beyond the level between two holes of a cycle, mm; 0 = it stops there
  uint32_t optional_skip = 0;      ///< optional block skip switches, bit n = switch n

  // ---- the state and the tables
  State state;
  Settings settings;
  Parameters parameters;
  Frames frames;
  Variables variables;
  Journalled<ProgramRecords, Interpreter> records;
  Journalled<ToolLives, Interpreter, true> lives;  ///< tools whose life is managed
  InternPool<PathPoint> points;
  InternPool<StrokeBox> stroke_boxes;   ///< areas of G22; Move::stroke_box counts from 1
  mutable ProgramMatrices program_matrices;  ///< matrices of the maps in force (interpret/program_map.hpp), calculated when they are needed

  /// The word with a meaning, kNoWord = the family has none; and the set of several. A word may have several meanings; the function in hand decides which one
  /// it asks for.
  WordSlot word(Role role) const { return dialect->addresses.word(role); }
  WordSet set_of(std::initializer_list<Role> roles) const { return dialect->addresses.set(roles); }
  /// Index of the axis with a meaning from a rule. -1 = the machine has no such axis.
  int axis_called(Role role) const { return axis_words.axis(word(role)); }

  // ---- positions
  /// The zero point of the active workpiece coordinates, and the position in these coordinates.
  const AxisVec& zero() const { return frames.zero(state.work_system); }
  AxisVec position() const {
    if (state.map.kind == AxisMap::Kind::polar) [[unlikely]] return polar_position();
    const AxisVec& z = zero();
    AxisVec p;  // for all axes, because the compiler knows that count; axes that the machine does not have are 0
    for (unsigned i = 0; i < kMaxAxes; ++i) p[i] = state.machine[i] - z[i] - state.applied[i];
    return p;
  }
  AxisVec polar_position() const;
  /// Reference position 1 to 4 (`which` 0 to 3) of an axis, machine coordinates (M700 14.3).
  double reference(unsigned which, unsigned axis) const {
    const double set = settings.reference[which][axis];
    return set == set ? set : system->axis[axis].reference[which];
  }
  /// Sets the words that command axes: their names, and the words that a mode of the state gives them.
  void refresh_axis_words();
  /// The highest number of an offset of a tool.
  unsigned tool_offsets() const { return frames.tool_offsets() < dialect->most_offsets ? frames.tool_offsets() : dialect->most_offsets; }
  /// The slot of the tool in the spindle in the table of tool life, ToolLives::kNone = its life is not managed, or it is not registered there any more.
  unsigned managed_tool() const { return lives->find(records->tools.spindle); }
  unsigned macro_level() const { return state.frame[state.depth].macro_level; }
  /// What the machine has to know of the length along the tool in force.
  LengthAlongTool along_tool() const {
    if (!state.modal.is(Function::length_along_tool)) return {};
    return {state.modal.h, state.length_handle_number == state.modal.h ? state.length_by_handle : 0};
  }

  /// The program that runs, or what is in force in it, has changed: sets the members of the state that follow from it.
  void program_changed() {
    const CallFrame& frame = state.frame[state.depth];
    state.modal_call = frame.modal_call;
    state.mapped = state.any_mirror() != 0 || frame.figure != 0 || state.scaled != 0 || state.rotated ||
                   state.work_turned || state.space_mirror != 0;
  }

  // ---- journalled writes
  /// Journalled write to the table of frames.
  void set_table(unsigned key, double value);
  /// Journalled write to a record, or to a field of one: change(&ProgramRecords::figure, &Figure::angle, angle).
  template <class... Change>
  void change(const Change&... what) {
    records.change(state.seq + 1, what...);
  }
  /// Journalled write to a member of a tool whose life is managed.
  template <class Member>
  void change_life(unsigned slot, Member ToolLife::*member, const std::type_identity_t<Member>& value) {
    lives.change(state.seq + 1, &ToolLives::tool, slot, member, value);
  }

 protected:
  SharedTables* shared = nullptr;  ///< what is shared with other part systems; nullptr: there are none
};

/// M700 12.1: an offset amount that is changed while it is in force acts from the next block on; a length acts with the next command of its axis.
void take_changed_amounts(InForce& in);

}  // namespace nc
