// SPDX-License-Identifier: Apache-2.0
// The M, S, T and B that a block gives out before it moves wait until all moves of the block are known to be possible, so that a block which a
// stroke limit stops has given out nothing. Only blocks that begin with such a code come here; any other block costs one comparison.
//
//   A block without radius compensation and without a corner at its end: its items lie in the interpreter's queue, and its moves are tried
//   there. A fixed cycle makes its moves little by little; those that it has still to make are rehearsed, without the pecks, which lie within
//   their hole.
//
//   A block with radius compensation, or with a corner at its end: the geometry of its moves is known only when the stages give them out. So all
//   items of the block are first fetched from the stages. A fault that a stage finds (interference, no intersection, a corner that does not
//   fit) then stops the block as a whole, too. The same is done with a block behind lines that fairing has held back. In other blocks fairing
//   moves the ends of lines only to places between programmed points, and the programmed points are tried.
#include "control/part_system.hpp"

namespace nc {
namespace {

/// The item is the last one of its block, or nothing behind it can be waited for.
bool ends_look_ahead(const Item& item) {
  return (item.kind == ItemKind::mark && item.mark.resume) || item.kind == ItemKind::sync || item.kind == ItemKind::alarm ||
         item.kind == ItemKind::end;
}

}  // namespace

/// The front of the stream is the first code of its block. NC_OK: the whole block has been checked, or an alarm has taken its place.
nc_status PartSystem::look_ahead(uint32_t& budget) {
  if (!gathering_ && !from_stage_ && !goes_to_stage()) {
    if (block_fits()) looked_behind_ = newest_mark();
    return NC_OK;
  }
  const nc_status status = gather_block(budget);
  if (status != NC_OK) return status;
  if (staged_fits()) looked_behind_ = newest_mark();
  return NC_OK;
}

/// The block at the front of the interpreter's queue has a move that a stage will compensate, or give a corner.
bool PartSystem::goes_to_stage() const {
  for (unsigned i = 0; i < interpreter.queue().size(); ++i) {
    const Item& item = interpreter.queue()[i];
    if (ends_look_ahead(item)) break;
    if (item.kind == ItemKind::move && (item.move.comp.side != 0 || item.move.corner != Corner::none || item.move.space.on)) return true;
  }
  return false;
}

bool PartSystem::try_item(const Item& item, Committed* committed) {
  if (item.kind != ItemKind::move) return true;
  *committed = commit_.try_item(item, named(item));
  return *committed == Committed::yes || *committed == Committed::nothing;
}

bool PartSystem::block_fits() {
  const Commit::Place place = commit_.place();
  nc_source source{};
  Committed committed = Committed::yes;
  bool fits = true, whole = false;
  for (unsigned i = 0; fits && !whole && i < interpreter.queue().size(); ++i) {
    const Item& item = interpreter.queue()[i];
    source = item.source;
    whole = ends_look_ahead(item);
    fits = try_item(item, &committed);
  }
  if (fits && !whole && interpreter.in_cycle()) fits = cycle_fits(&committed);
  commit_.put_back(place);
  if (!fits) stop_on(refused(committed), source);
  return fits;
}

/// Whether the moves that the fixed cycle in execution has still to make are within the limits.
bool PartSystem::cycle_fits(Committed* committed) {
  if (interpreter.maps().other_axes) return true;  // its moves have shapes, for which there are few places: each is checked when it is made
  struct Trial {
    PartSystem& system;
    Committed* committed;
  } trial{*this, committed};
  return interpreter.rehearse_cycle(
      [](void* user, const Item& move) {
        Trial& trying = *static_cast<Trial*>(user);
        return trying.system.try_item(move, trying.committed);
      },
      &trial);
}

/// Fetches the rest of the block that begins with staged_[0], or with the interpreter's front.
nc_status PartSystem::gather_block(uint32_t& budget) {
  if (!gathering_) {
    gathering_ = true;
    if (!from_stage_) {
      staged_[0] = interpreter.queue()[0];
      staged_head_ = 0;
      staged_count_ = 1;
      interpreter.queue().pop();
    }
  }
  bool whole = false;
  while (!whole && staged_count_ < kStaged) {  // no block that can be compensated makes more than kStaged items
    Item& place = staged_[staged_count_];
    if (!stages_.idle() && pop_held(place)) {
      ++staged_count_;
      whole = ends_look_ahead(place);
      continue;
    }
    Item* front = nullptr;
    const nc_status status = interpreter.next(budget, &front);
    if (answered_block_ != 0) [[unlikely]] publish_answered();
    if (status != NC_OK) return status;
    const Stages::Intake intake = stages_.push(*front);
    if (intake == Stages::Intake::later) continue;
    if (intake == Stages::Intake::straight) {
      place = *front;
      ++staged_count_;
      whole = ends_look_ahead(place);
    }
    interpreter.queue().pop();
  }
  gathering_ = false;
  return NC_OK;
}

bool PartSystem::staged_fits() {
  const Commit::Place place = commit_.place();
  Committed committed = Committed::yes;
  const Item* bad = nullptr;
  for (unsigned i = 0; bad == nullptr && i < staged_count_; ++i) {
    const Item& item = staged_[i];
    if (item.kind == ItemKind::alarm || !try_item(item, &committed)) bad = &item;
  }
  commit_.put_back(place);
  if (bad == nullptr) return true;
  const nc_source source = bad->source;
  stop_on(bad->kind == ItemKind::alarm ? bad->alarm : refused(committed), source);
  return false;
}

}  // namespace nc
