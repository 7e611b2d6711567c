// SPDX-License-Identifier: Apache-2.0
// Offline: the items of a part system given out one after the other, passed over, or looked through for a place to restart from.
#include <cstring>

#include "control/part_system_stream.hpp"
#include "interpret/stroke_counter.hpp"

namespace nc {

/// A macro interrupt that has been asked for begins in front of the next item, where it may.
[[gnu::always_inline]] inline void PartSystem::begin_wanted_interrupt() {
  if (!watched_) [[likely]] return;
  if ((uit_mode_ & NC_INTERRUPT_ENABLED) == 0) uit_pending_ = false;
  const bool wanted = uit_pending_ || (uit_ && interpreter.interrupts().by_level && uit_rest_.over());
  if (wanted && pulled_ == ItemKind::mark && !beside_ && interruptible()) begin_interrupt();
}

[[gnu::always_inline]] inline void PartSystem::give(const Item& item, nc_item* out) {
  pulled_ = item.kind;
  pulled_in_hole_ = item.in_hole;
  is_amid_ = false;
  if (item.kind == ItemKind::mark) {
    commit_.mark_to_public(item, out);
    if (watched_ && item.mark.report) [[unlikely]] uit_rest_.block_ended();
    beside_ = item.mark.beside;
    note_mark(item);
  } else {
    commit_.to_public(item, out);
    if (item.kind == ItemKind::move) [[likely]] {
      const Move& move = item.move;
      move_transform_ = move.transform;
      move_kind_ = move.kind;
      move_offset_ = move.comp.side * move.comp.radius;
      move_plane_axis_[0] = move.comp.axis[0];
      move_plane_axis_[1] = move.comp.axis[1];
      move_in_space_ = move.space.on;
    } else {
      note_given(item);
      note_interrupt_mode(item);
    }
  }
  take();
}

nc_status PartSystem::pull(uint32_t budget, nc_item* out) {
  for (;;) {
    begin_wanted_interrupt();
    const Item* item = nullptr;
    const nc_status status = pump(budget, &item);
    if (status != NC_OK) return status;
    if (item == nullptr) continue;
    give(*item, out);
    return NC_OK;
  }
}

/// A move that is counted instead of being given out; and a mark, of which only those inside a block are.
[[gnu::always_inline]] inline bool PartSystem::passes(const Item& item, bool behind_move) const {
  if (item.kind == ItemKind::move) return item.move.kind != NC_MOVE_SKIP;
  return item.kind == ItemKind::mark && !item.mark.report && behind_move;
}

/// Counts an item that passes and has been committed.
[[gnu::always_inline]] inline void PartSystem::count_passed(const Item& item, nc_passed* passed) {
  if (item.kind == ItemKind::move) {
    ++passed->moves;
    ++passed->moves_in_row;
    passed->marks = 0;
    commit_.count_move(item.move, passed);
  } else {
    ++passed->marks;
    passed->moves_in_row = 0;
    beside_ = item.mark.beside;
    note_mark(item);
  }
}

/// What is known of the item passed last, and of the last move among the items before it, nullptr = there is none.
[[gnu::always_inline]] inline void PartSystem::note_passed(const Item& item, const Item* move, nc_passed* passed) {
  pulled_ = ItemKind::mark;  // nothing that was given out last: nc_move_point() has no move
  pulled_in_hole_ = item.in_hole;
  passed->source = item.source;
  static_assert(sizeof passed->work == sizeof move->move.work);
  if (move != nullptr) std::memcpy(&passed->work, &move->move.work, sizeof passed->work);
}

/// What counts strokes of holes while a row is passed, as pass_row() does it with their items.
struct PartSystem::Row {
  PartSystem& system;
  const uint64_t before;
  nc_passed* const passed;
  const StrokeCounter counter;

  Row(PartSystem& of, uint64_t moves_before, nc_passed* past) : system(of), before(moves_before), passed(past), counter{this, &Row::stands, &Row::stroke, &Row::stop_point, &Row::end} {
    system.interpreter.count_strokes(&counter);
  }
  ~Row() { system.interpreter.count_strokes(nullptr); }
  Row(const Row&) = delete;
  Row& operator=(const Row&) = delete;

  static bool stands(void* user, const AxisVec& machine) { return static_cast<Row*>(user)->system.commit_.machine() == machine; }
  static bool stroke(void* user, unsigned axis, double to, bool rapid, double feed) {
    const Row& row = *static_cast<Row*>(user);
    nc_passed& passed = *row.passed;
    double length = 0;
    if (passed.most_in_row != 0 && passed.moves_in_row + 1 >= passed.most_in_row) return false;  // the row ends with it
    if (!row.system.commit_.commit_stroke(axis, to, &length)) return false;
    ++passed.moves;
    ++passed.moves_in_row;
    passed.marks = 0;
    if (rapid) feed = passed.rapid_mm_min;
    if (feed > 0) passed.seconds += length / feed * 60;
    passed.length += length;
    return true;
  }
  static bool stop_point(void* user) {
    const Row& row = *static_cast<Row*>(user);
    if (row.passed->moves == row.before) return false;
    row.system.commit_.commit_mark();
    ++row.passed->marks;
    row.passed->moves_in_row = 0;
    row.system.beside_ = false;
    return true;
  }
  static void end(void* user, const nc_source& source, const AxisVec* work) {
    const Row& row = *static_cast<Row*>(user);
    row.system.pulled_ = ItemKind::mark;
    row.system.pulled_in_hole_ = true;
    row.passed->source = source;
    if (work == nullptr) return;
    std::memcpy(&row.passed->machine, &row.system.commit_.machine(), sizeof row.passed->machine);
    std::memcpy(&row.passed->work, work, sizeof *work);
  }
};

/// Passes the items in front of the interpreter's queue that nothing concerns but commit: lines, and marks inside a block. What next() and pump() ask with every item
/// and no such item changes is asked once here. Any other item, and one that commit refuses, is left to them (NC_OK). `before`: number of moves that had been passed
/// before this call of nc_pull_past().
nc_status PartSystem::pass_row(uint32_t& budget, uint64_t before, nc_passed* passed) {
  if (watched_ || commit_watch_ != nullptr || staged_count_ != 0 || !stages_.idle() || answered_block_ != 0 || shape_left_ != nullptr) return NC_OK;
  const Row row(*this, before, passed);
  Item *item = nullptr, *last = nullptr, *last_move = nullptr;
  nc_status status = interpreter.next(budget, &item);
  while (status == NC_OK && passes(*item, passed->moves != before)) {
    if (item->kind == ItemKind::mark) {
      commit_.commit_mark();
    } else {
      if (item->move.shape != 0 || may_be_held(*item) || commit_.commit(*item, named(*item)) != Committed::yes) break;
      last_move = item;
    }
    count_passed(*item, passed);
    last = item;
    interpreter.queue().pop();
    const bool full = passed->moves_in_row >= passed->most_in_row && passed->most_in_row != 0;
    if (interpreter.queue().empty()) {
      note_passed(*last, last_move, passed);
      last = last_move = nullptr;  // their places are used again for what is made next
    }
    status = full ? NC_BUDGET : interpreter.next(budget, &item);
  }
  if (last != nullptr) note_passed(*last, last_move, passed);
  return status;
}

nc_status PartSystem::pull_past(uint32_t budget, nc_passed* passed, nc_item* out) {
  const uint64_t before = passed->moves;
  for (;;) {
    nc_status status = pass_row(budget, before, passed);
    if (status != NC_OK) return status;
    begin_wanted_interrupt();
    const Item* item = nullptr;
    status = pump(budget, &item);
    if (status != NC_OK) return status;
    if (item == nullptr) continue;
    if (watched_ || !passes(*item, passed->moves != before)) {
      give(*item, out);
      return NC_OK;
    }
    count_passed(*item, passed);
    note_passed(*item, item->kind == ItemKind::move ? item : nullptr, passed);
    take();
  }
}

/// The interpreter is about to read the block on the line that is looked for. In front of a call that is the only time to stop, because the items behind it are
/// those of what it calls. Where stages hold items back it is too late: there the block is found by its first item, and a call by its end.
bool PartSystem::at_place(Passed* passed) {
  const nc_source& wanted = search_.wanted();
  if (!search_.of_line() || staged_count_ != 0 || !stages_.idle() || !interpreter.at_line(wanted.file, wanted.line, &passed->source)) return false;
  return passed->reached = search_.comes_to_line(interpreter.newest_block());
}

/// An item that commit leaves out is passed as a mark without meaning.
PartSystem::Passed PartSystem::pass_item(uint32_t& budget) {
  const Item* item = nullptr;
  Passed passed;
  if (at_place(&passed)) return passed;
  passed.status = next(budget, &item);
  if (passed.status != NC_OK) return passed;
  passed.reached = search_.reached(*item);
  passed.source = item->source;
  if (passed.reached) return passed;
  passed.status = pump(budget, &item);
  if (passed.status != NC_OK || item == nullptr) return passed;
  passed.kind = pulled_ = item->kind;
  search_.note(*item);
  if (item->kind == ItemKind::mark) {
    restart_modal_ = item->mark.modal;
    note_mark(*item);
  } else {
    note_given(*item);
  }
  take();
  return passed;
}

}  // namespace nc
