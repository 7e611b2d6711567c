// SPDX-License-Identifier: Apache-2.0
// See cut_item.hpp.
#include "tools/lib/cut_item.hpp"

#include <algorithm>
#include <cmath>

namespace nc::tools {
namespace {

constexpr double kSamePlace = 1e-6;  // mm

double distance(const nc_axes& a, const nc_axes& b) {
  double sum = 0.0;
  for (unsigned i = 0; i < NC_MAX_AXES; ++i) sum += (a.v[i] - b.v[i]) * (a.v[i] - b.v[i]);
  return std::sqrt(sum);
}

nc_axes between(const nc_axes& from, const nc_axes& to, double share) {
  nc_axes at = from;
  for (unsigned i = 0; i < NC_MAX_AXES; ++i) at.v[i] += share * (to.v[i] - from.v[i]);
  return at;
}

/** Takes this share of the length of a move, and of the angle of an arc. */
void shorten(nc_move* move, double share) {
  move->length *= share;
  move->sweep_deg *= share;
  if (move->center_axes != 0) move->turns = static_cast<uint32_t>(std::max(0.0, std::ceil(std::fabs(move->sweep_deg) / 360.0 - 1e-9) - 1.0));
}

bool is_interrupt_state(const nc_item& item) {
  return item.kind == NC_ITEM_ACTION && item.u.action.kind == NC_ACTION_CONTROL && item.u.action.index == NC_CONTROL_INTERRUPT;
}

}  // namespace

// The first item behind the end of the interrupt program is the one that was cut, or its block is lost.
bool CutItem::is_rest(const nc_item& item) const {
  return item.kind == kind_ && item.source.line == source_.line && item.source.file == source_.file && item.source.depth == source_.depth;
}

void CutItem::resume(nc_item* item, const nc_axes& at, ItemSource* items) {
  const bool is_move = item->kind == NC_ITEM_MOVE;
  from_ = 0.0;
  straight_ = false;
  whole_ = is_move ? item->u.move.length : item->kind == NC_ITEM_GATE ? item->u.gate.value : 0.0;
  if (!waits_) return;
  if (is_interrupt_state(*item)) {
    served_ = served_ || (static_cast<uint32_t>(item->u.action.value) & NC_INTERRUPT_IN_SERVICE) == 0;
    return;
  }
  if (!served_ || item->source.depth > source_.depth) return;
  waits_ = false;
  if (!is_rest(*item)) return;
  from_ = done_;
  if (is_move) resume_move(&item->u.move, at, items);
  else item->u.gate.value *= 1.0 - from_;
}

// Where the interrupt program has changed what the move is made from, the axes do not stand on its path: a line leads to its end, as on the machine.
void CutItem::resume_move(nc_move* move, const nc_axes& at, ItemSource* items) {
  straight_ = distance(place(*move, 0.0, items), at) > kSamePlace;
  move->machine_start = at;
  if (straight_) {
    if (move->center_axes != 0 || move->curved) move->kind = NC_MOVE_LINE;
    move->center_axes = 0;
    move->plane = NC_PLANE_NONE;
    move->curved = false;
    move->length = whole_ = distance(at, move->machine);
    from_ = 0.0;
    return;
  }
  shorten(move, 1.0 - from_);
  items->part(from_, 1.0);
  if (move->center_axes == 2) move->radius = std::hypot(at.v[move->plane_axis[0]] - move->machine_center[0], at.v[move->plane_axis[1]] - move->machine_center[1]);
}

nc_axes CutItem::place(const nc_move& move, double share, ItemSource* items) const {
  nc_axes at = move.machine_start;
  items->part(0.0, 1.0);
  const double done = whole_ > 0.0 ? from_ + share * move.length / whole_ : share;
  if (straight_ || !items->move_point(std::clamp(done, 0.0, 1.0), &at)) at = between(move.machine_start, move.machine, share);
  items->part(from_, 1.0);
  return at;
}

void CutItem::cut_move(nc_item* item, double share, const nc_axes& work, unsigned axis_count, ItemSource* items) {
  nc_move& move = item->u.move;
  const nc_axes at = place(move, share, items);
  nc_axes start = move.machine_start;  // in workpiece coordinates, unless the program's coordinates are others than those of the axes (G12.1)
  for (unsigned a = 0; a < axis_count; ++a) start.v[a] += move.work.v[a] - move.machine.v[a];
  if (move.curved && distance(start, work) > kSamePlace) move.work = between(work, move.work, share);
  else
    for (unsigned a = 0; a < axis_count; ++a) move.work.v[a] -= move.machine.v[a] - at.v[a];
  move.machine = at;
  shorten(&move, share);
  done_ = whole_ > 0.0 ? std::min(1.0, from_ + move.length / whole_) : 0.0;
  if (!straight_) items->part(from_, done_);
  waits_ = true;
  served_ = straight_ = false;
  source_ = item->source;
  kind_ = item->kind;
}

void CutItem::cut_dwell(nc_item* item, double passed) {
  done_ = whole_ > 0.0 ? std::min(1.0, from_ + passed / whole_) : 0.0;
  item->u.gate.value = passed;
  waits_ = true;
  served_ = false;
  source_ = item->source;
  kind_ = item->kind;
}

}  // namespace nc::tools
