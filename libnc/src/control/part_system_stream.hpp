// SPDX-License-Identifier: Apache-2.0
// The stream of items behind the stages of a part system, for the files that take items from it: part_system_pull.cpp (nc_pull() and its like) and
// part_system_feed.cpp (nc_feed()).
#pragma once

#include "control/part_system.hpp"

namespace nc {

/// Inlined into all loops that take items, because a function call for each item would be felt.
[[gnu::always_inline]] inline nc_status PartSystem::next(uint32_t& budget, const Item** item) {
  if (staged_count_ != 0) {
    from_stage_ = true;
    *item = &staged_[staged_head_];
    return NC_OK;
  }
  for (;;) {
    if (!stages_.idle()) {
      staged_head_ = 0;
      if (pop_held(staged_[0])) {
        staged_count_ = 1;
        from_stage_ = true;
        *item = &staged_[0];
        return NC_OK;
      }
    }
    Item* front = nullptr;
    const nc_status status = interpreter.next(budget, &front);
    if (answered_block_ != 0) [[unlikely]] publish_answered();
    if (status != NC_OK) return status;
    if (!stages_.idle() || may_be_held(*front)) {
      const Stages::Intake intake = stages_.push(*front);
      if (intake == Stages::Intake::taken) interpreter.queue().pop();
      if (intake != Stages::Intake::straight) continue;
    }
    from_stage_ = false;  // nothing to hold back: straight through
    *item = front;
    return NC_OK;
  }
}

inline void PartSystem::take() {
  if (from_stage_) {
    ++staged_head_;
    --staged_count_;
  } else {
    interpreter.queue().pop();
  }
}

/// The only way from the interpreter to a sink. Inlined into all loops that take items, as next() is.
[[gnu::always_inline]] inline nc_status PartSystem::pump(uint32_t& budget, const Item** given) {
  *given = nullptr;
  const Item* item = nullptr;
  const nc_status status = next(budget, &item);
  if (status != NC_OK) return status;
  if (commit_watch_ != nullptr) [[unlikely]] before_watched_ = commit_.place();
  if (item->kind == ItemKind::mark && !watched_) [[likely]] {  // a mark is every second item of a program, and nearly every item of a macro
    commit_.commit_mark();
    *given = item;
    return NC_OK;
  }
  if (item->kind == ItemKind::alarm && from_stage_) {
    stop_on(item->alarm, item->source);
    return NC_OK;
  }
  if (wants_look_ahead(*item)) [[unlikely]] return look_ahead(budget);
  if (shape_left_ != nullptr && item->kind == ItemKind::move && named(*item).shape != nullptr) [[unlikely]] {
    shape_waits_ = !commit_.make_ahead(item->move, *named(*item).shape, shape_left_);
    if (shape_waits_) return NC_BUDGET;
  }
  const Committed committed = commit_.commit(*item, named(*item));
  if (committed != Committed::yes && committed != Committed::nothing) {
    stop_on(refused(committed), item->source);
    return NC_OK;
  }
  if (watched_ && drops(*item)) [[unlikely]] {
    if (committed == Committed::yes) commit_.uncount();
    take();
  } else if (committed == Committed::nothing) {
    take();
  } else {
    *given = item;
  }
  return NC_OK;
}

/// What follows from a mark for the caller that drives the part system.
[[gnu::always_inline]] inline void PartSystem::note_mark(const Item& mark) {
  remember_mark(mark);
  // The place of the interrupt comes with the mark, because the stages may have held the mark while the interpreter has read on.
  if (mark.mark.repeat.active) [[unlikely]] drop_repeated(mark.mark.repeat, interpreter.interrupted_at());
}

}  // namespace nc
