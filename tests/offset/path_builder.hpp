// SPDX-License-Identifier: Apache-2.0
// Writes a stream of items block by block, as the interpreter does, and reads what the offset stage makes of it.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "offset/offset.hpp"

namespace nc::test {

struct Point {
  double h = 0, v = 0;
};

/// Points are in the plane (h, v) of `comp.axis`; `off` is the axis that is not in it. Each call adds one block, that is,
/// its items and a mark.
class PathBuilder {
 public:
  explicit PathBuilder(double h = 0, double v = 0, uint8_t first = 0, uint8_t second = 1) {
    comp.axis[0] = first;
    comp.axis[1] = second;
    at_[first] = h;
    at_[second] = v;
    start_ = at_;
  }

  Compensation comp;                 ///< modal part, copied to every move
  nc_move_kind kind = NC_MOVE_LINE;  ///< kind of the next lines
  double feed = 500;
  std::vector<Item> items;

  void side(int s, double radius) {
    comp.side = static_cast<int8_t>(s);
    comp.radius = radius;
  }
  PathBuilder& one_shot(const Compensation& c) {
    next_ = c;
    has_next_ = true;
    return *this;
  }
  Compensation vector(double i, double j) const {
    Compensation c = comp;
    c.has_vector = true;
    c.vector[0] = i;
    c.vector[1] = j;
    return c;
  }

  PathBuilder& line(double h, double v) {  // absolute
    Item item = move_item();
    item.move.end[h_axis()] = h;
    item.move.end[v_axis()] = v;
    return add(item);
  }
  PathBuilder& by(double h, double v) { return line(at_[h_axis()] + h, at_[v_axis()] + v); }
  PathBuilder& off_plane(double d) {
    Item item = move_item();
    item.move.end[off_axis()] += d;
    return add(item);
  }
  /// An arc by its end point (absolute) and its centre relative to the start; the axis `off` moves along.
  PathBuilder& arc(bool ccw, double h, double v, double i, double j, double off = 0) {
    Item item = move_item();
    Move& m = item.move;
    const Point start{at_[h_axis()], at_[v_axis()]}, center{start.h + i, start.v + j};
    m.kind = off != 0 ? NC_MOVE_HELIX : NC_MOVE_ARC;
    m.circular = true;
    m.plane = Plane::xy;
    for (unsigned k = 0; k < 2; ++k) m.plane_axis[k] = comp.axis[k];
    m.end[h_axis()] = h;
    m.end[v_axis()] = v;
    m.end[off_axis()] += off;
    m.circle.center[0] = m.work_center[0] = center.h;
    m.circle.center[1] = m.work_center[1] = center.v;
    m.circle.radius_start = std::hypot(i, j);
    m.circle.radius_end = std::hypot(h - center.h, v - center.v);
    m.circle.angle_start = std::atan2(-j, -i);
    const double angle_end = std::atan2(v - center.v, h - center.h), full = 2 * std::acos(-1.0);
    double sweep = angle_end - m.circle.angle_start;
    while (ccw && sweep <= 1e-9) sweep += full;
    while (!ccw && sweep >= -1e-9) sweep -= full;
    m.circle.sweep = sweep;
    return add(item);
  }
  PathBuilder& arc_by(bool ccw, double h, double v, double i, double j) {
    return arc(ccw, at_[h_axis()] + h, at_[v_axis()] + v, i, j);
  }
  /// A block with a compensation command that does not move.
  PathBuilder& command() { return add(move_item()); }
  PathBuilder& idle() {
    push_mark();
    return *this;
  }
  PathBuilder& program_stop() {
    Item item;
    item.kind = ItemKind::gate;
    item.gate = Gate{};
    item.gate.kind = NC_GATE_STOP;
    item.source.line = line_;
    items.push_back(item);
    push_mark();
    return *this;
  }
  PathBuilder& end() {
    Item item;
    item.kind = ItemKind::end;
    item.end = End{};
    item.source.line = line_;
    items.push_back(item);
    return *this;
  }
  PathBuilder& cancel() {
    comp.side = 0;
    return *this;
  }
  const AxisVec& start() const { return start_; }
  const AxisVec& position() const { return at_; }
  /// The coordinates of the next block count from another zero (G92, G54-G59).
  void shift_zero(double h, double v) {
    at_[h_axis()] += h;
    at_[v_axis()] += v;
  }

 private:
  unsigned h_axis() const { return comp.axis[0]; }
  unsigned v_axis() const { return comp.axis[1]; }
  unsigned off_axis() const { return 3u - h_axis() - v_axis(); }

  Item move_item() {
    Item item;
    item.kind = ItemKind::move;
    item.move = Move{};
    item.move.kind = kind;
    item.move.start = item.move.end = at_;
    item.move.feed_mm_min = kind == NC_MOVE_RAPID ? 0 : feed;
    item.move.comp = has_next_ ? next_ : comp;
    has_next_ = false;
    return item;
  }
  PathBuilder& add(Item item) {
    item.move.work = item.move.end;
    item.source.line = line_;
    items.push_back(item);
    at_ = item.move.end;
    push_mark();
    return *this;
  }
  void push_mark() {
    Item item;
    item.kind = ItemKind::mark;
    item.mark = Mark{};
    item.mark.work = at_;
    item.mark.seq = line_;
    item.source.line = line_++;
    item.block_end = true;
    items.push_back(item);
  }

  AxisVec at_, start_;
  uint32_t line_ = 1;
  Compensation next_;
  bool has_next_ = false;
};

/// A stage with memory of its own. `contour_blocks`: the longest contour of the check of walls.
class StageWithMemory : public OffsetStage {
 public:
  explicit StageWithMemory(unsigned contour_blocks = 0) {
    Arena measure;
    create(contour_blocks, measure);
    memory_ = std::make_unique_for_overwrite<std::max_align_t[]>(measure.used() / sizeof(std::max_align_t) + 1);
    Arena arena(memory_.get(), measure.used());
    create(contour_blocks, arena);
  }

 private:
  std::unique_ptr<std::max_align_t[]> memory_;
};

/// Pushes all items, popping as far as possible after each (or only when there is no room, when `lazy`).
inline std::vector<Item> run_stage(OffsetStage& stage, const std::vector<Item>& items, bool lazy = false) {
  std::vector<Item> out;
  Item item;
  for (const Item& in : items) {
    while ((!lazy || !stage.can_push()) && stage.pop(item)) out.push_back(item);
    if (!stage.can_push()) break;  // the caller's test sees the missing items
    stage.push(in);
  }
  while (stage.pop(item)) out.push_back(item);
  return out;
}

inline std::vector<Item> run_stage(const PathBuilder& path) {
  StageWithMemory stage;
  return run_stage(stage, path.items);
}

inline std::vector<Move> moves_of(const std::vector<Item>& items) {
  std::vector<Move> moves;
  for (const Item& item : items)
    if (item.kind == ItemKind::move) moves.push_back(item.move);
  return moves;
}

/// The position of the tool centre at the end of block `line`, which is the end of the last move before that block's mark.
inline AxisVec at_block(const std::vector<Item>& out, const AxisVec& start, uint32_t line) {
  AxisVec p = start;
  for (const Item& item : out) {
    if (item.kind == ItemKind::move) p = item.move.end;
    if (item.kind == ItemKind::mark && item.source.line == line) return p;
  }
  p[0] = std::nan("");  // the block never ended
  return p;
}

inline const Item* alarm_of(const std::vector<Item>& items) {
  for (const Item& item : items)
    if (item.kind == ItemKind::alarm) return &item;
  return nullptr;
}

}  // namespace nc::test
