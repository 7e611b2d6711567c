// SPDX-License-Identifier: Apache-2.0
// What a handler of a function works with. Each layer has what the one before has, and is all that a function gets which needs no more:
//
//   InForce       in_force.hpp        the machine and its family, the state, the tables
//   BlockInHand   block_in_hand.hpp   and the command of the block, the answers of the machine, alarms
//   BlockContext  this file           and the functions that put items into the stream
//
// Handlers (functions/*.cpp, motion.cpp, feed.cpp ...) get no more than the last. The queue, the checkpoints and what the stream has last said are protected.
// How blocks are read, taken back, interrupted and called belongs to the interpreter (interpreter.hpp), and a change there does not touch the handlers.
#pragma once

#include <cstring>
#include <new>

#include "frame/affine.hpp"
#include "interpret/block_in_hand.hpp"
#include "interpret/checkpoints.hpp"
#include "interpret/motion_settings.hpp"
#include "interpret/stroke_counter.hpp"
#include "stream/item_queue.hpp"

namespace nc {

/// A text on its way to the operator or to an output.
struct Message {
  nc_text text{};
  bool operator==(const Message& other) const {
    if (text.size != other.text.size) return false;
    return text.size != 0 ? std::memcmp(text.s, other.text.s, text.size) == 0 : std::strcmp(text.s, other.text.s) == 0;
  }
};

/// Base of the Interpreter; no other class makes one.
struct BlockContext : BlockInHand {
  InternPool<Affine> transforms;   ///< from the compensation frame to machine coordinates; Move::transform
  InternPool<MoveShape> shapes;    ///< shapes of moves under way; Move::shape counts from 1
  const StrokeCounter* stroke_counter = nullptr;  ///< who only counts the strokes of holes; nullptr: each becomes an item
  unsigned counted = 0;            ///< what has been counted in this step in the place of items
  bool mdi = false;                ///< the main program is blocks of MDI: their end is no alarm

  /// A new item at the end of the queue, with the default payload of its kind; moves are made by emit_move().
  Item& emit(ItemKind kind);
  /// A move with the compensation in force; the caller sets its transform and kind.
  Move& emit_move(const AxisVec& start, const AxisVec& end) {
    Item& item = next_item(ItemKind::move, false);
    world_fresh = false;
    // Constructed with its values, because clearing three positions before they are set would be felt in every block.
    Move& move = *new (&item.move) Move(start, end, state.comp);
    move.stroke_box = state.stroke_box;
    if (settings_of_moves_stale_) [[unlikely]] take_settings_of_moves();
    move.settings = settings_of_moves_;
    return move;
  }
  bool queue_has_room() const { return queue.room() > kReserve + counted; }
  /// The items of the block in hand that have been made and not yet taken.
  unsigned items_made() const { return queue.size(); }
  Item& item_made(unsigned index) { return queue[index]; }
  /// The block of `source` has ended: emits its mark (and the end, after M02/M30), and keeps the checkpoint to rewind to. `executable`: the block counts
  /// for radius compensation (M700 12.4.2 lists such blocks; 13.5.9: macro statements do not count).
  void finish_block(bool stop, bool executable);
  /// Emits a mark for a place inside a block where single block may stop. `resume`: it can also be rewound to, and what the block has done so far is kept.
  void emit_stop_point(bool resume = false);
  /// The block has called a program and done its own part: keeps a checkpoint, so that a fault in the program does not undo this block.
  void keep_call();

 protected:
  ItemQueue queue;   ///< items of the block in hand that have been made and not yet taken
  InternPool<ModalState> modals;
  InternPool<Message> texts;
  InternPool<MotionSettings> motion_settings;  ///< Move::settings
  bool begins_again = false;       ///< the block holds M99 of the main program, which its mark has to say
  bool aside = false;              ///< Mark::aside of the block in hand
  bool call_ends = false;          ///< Mark::of_call of the mark that is made next
  bool ended = false;
  static constexpr unsigned kReserve = 24;  ///< the most items that one step of a block makes

  /// Keeps a checkpoint of the state, whose modes may have changed since the newest mark.
  void keep_state() {
    state.modes_ahead = !(state.executed == state.modal);
    checkpoints_.save(state);
  }
  void note_interrupt_items();
  void emit_end();
  Item& next_item(ItemKind kind, bool block_end) {
    Item& item = queue.add();
    item.kind = kind;
    item.block_end = block_end;
    item.in_hole = jobs.holes.inside;
    item.source = source;
    return item;
  }
  /// Id of the modal state, for a mark. When the block counts as executed, its modal state is also that in execution.
  ModalId modal_now(bool executable);
  SettingsId settings_of_moves_ = 0;
  void take_settings_of_moves();
  Repeat next_repeat_;         ///< goes out with the next mark
  Checkpoints checkpoints_;
  static constexpr ModalId kNoModal = ~ModalId{0};
  ModalId newest_modal_ = kNoModal;  ///< modal state of the newest mark
  bool modal_unchanged_ = false;     ///< the modal state has not changed since the newest mark
};

}  // namespace nc
