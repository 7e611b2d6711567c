// SPDX-License-Identifier: Apache-2.0
#include "interpret/by_hand.hpp"

#include <cmath>

#include "base/same_place.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/program_map.hpp"

namespace nc {
namespace {

/// In programmed coordinates.
AxisVec programmed_way(const BlockInHand& in, const AxisVec& beside) {
  if (!program_mapped(in)) return beside;
  const AxisVec here = in.position();
  AxisVec before = here;
  for (unsigned i = 0; i < in.axis_count; ++i) before[i] -= beside[i];
  const AxisVec to = as_programmed_end(in, here), from = as_programmed_end(in, before);
  AxisVec way;
  for (unsigned i = 0; i < in.axis_count; ++i) way[i] = to[i] - from[i];
  return way;
}

/// The way back from programmed_way().
AxisVec way_of_axes(const BlockInHand& in, const AxisVec& way) {
  if (!program_mapped(in)) return way;
  const AxisVec to = as_programmed_end(in, in.position());
  AxisVec from = to;
  for (unsigned i = 0; i < in.axis_count; ++i) from[i] -= way[i];
  const AxisVec here = from_program(in, to), before = from_program(in, from);
  AxisVec beside;
  for (unsigned i = 0; i < in.axis_count; ++i) beside[i] = here[i] - before[i];
  return beside;
}

void keep(InForce& in, AxisVec beside) {
  for (unsigned i = 0; i < kMaxAxes; ++i)
    if (std::fabs(beside[i]) <= kAddingUp) beside[i] = 0;  // what a map has rounded
  in.state.by_hand = !(beside == AxisVec{});
  if (in.state.by_hand) in.change(&ProgramRecords::way_by_hand, WayByHand{beside});
}

/// The words of the block are ends of a line or an arc. Those of other functions, and of cycles, are places of their own.
bool plain_words(const BlockInHand& in) {
  const Command& w = in.words;
  return w.cycle == nullptr && in.state.cycle.kind == CycleKind::none && (w.one_shot == nullptr || offsets_position(w.one_shot->function));
}

}  // namespace

void note_way_by_hand(InForce& in, const AxisVec& beside) {
  if (in.state.map.active()) return;  // a way of the axes is none of the plane that is programmed
  AxisVec all = in.state.by_hand ? in.records->way_by_hand.beside : AxisVec{};
  for (unsigned i = 0; i < kMaxAxes; ++i) all[i] += beside[i];
  in.state.by_hand = !(all == AxisVec{});
  if (in.state.by_hand) in.records.change_from_outside(&ProgramRecords::way_by_hand, WayByHand{all});
}

AxisVec way_by_hand(const BlockInHand& in) { return in.state.by_hand ? programmed_way(in, in.records->way_by_hand.beside) : AxisVec{}; }

void end_way_by_hand(BlockInHand& in, const AxisVec& start, const AxisVec& target) {
  AxisVec beside = in.records->way_by_hand.beside;
  const uint32_t named = in.words.target.axes();
  if (plain_words(in)) {
    AxisVec way = programmed_way(in, beside);
    for (uint32_t left = named & ~in.words.target.incremental(); left != 0; left &= left - 1) way[first_of(left)] = 0;
    keep(in, way_of_axes(in, way));
    return;
  }
  for (unsigned i = 0; i < kMaxAxes; ++i)
    if ((named >> i & 1) != 0 || start[i] != target[i]) beside[i] = 0;
  keep(in, beside);
}

void forget_way_by_hand(InForce& in, uint32_t axes) {
  if (!in.state.by_hand) return;
  AxisVec beside = in.records->way_by_hand.beside;
  for (; axes != 0; axes &= axes - 1) beside[first_of(axes)] = 0;
  keep(in, beside);
}

}  // namespace nc
