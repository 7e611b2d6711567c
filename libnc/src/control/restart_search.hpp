// SPDX-License-Identifier: Apache-2.0
// A place in a program that is looked for, and what the program has given to the machine on the way there (nc/restart.h).
#pragma once

#include "nc/restart.h"
#include "stream/stream.hpp"

namespace nc {

class RestartSearch {
 public:
  enum class Phase : uint8_t { none, sequence, passing, found };

  /// Looks for `place` in the text `file`, from the head of the program on.
  void begin(const nc_restart_place& place, unsigned file, const nc_world& world);
  void forget() { phase_ = Phase::none; }
  Phase phase() const { return phase_; }
  bool looks() const { return phase_ == Phase::sequence || phase_ == Phase::passing; }
  const nc_restart_place& place() const { return place_; }
  const nc_world& world() const { return world_; }

  /// A sequence number was found on a line of its text.
  void found_sequence(uint32_t line);
  /// Where the search for the sequence number goes on.
  uint64_t offset = 0;
  uint32_t line = 1;

  /// A line is looked for, and no number of blocks.
  bool of_line() const { return wanted_.line != 0; }
  const nc_source& wanted() const { return wanted_; }
  /// The block on that line is read next; `seq`: behind this block. A call is known only here: its items are those of what it calls. To be asked again and again
  /// until the block is read. True: it is the passing that is looked for.
  bool comes_to_line(BlockSeq seq);
  /// The item, which has not been executed yet, belongs to the block that is looked for. To be asked of each item before note().
  bool reached(const Item& item);
  /// The place is a call amid what the stages hold back: it cannot be begun in front of it.
  bool torn() const { return torn_; }
  /// A radius of constant surface speed was given at a place where the axes do not stand now: the scan cannot be told.
  bool radius_given() const { return radius_given_; }
  /// Behind an item that has been executed up to the machine: what it would have done there.
  void note(const Item& item);
  uint64_t blocks() const { return blocks_; }
  /// The place is reached. `hash` is that of the state in which the program goes on.
  void found(uint64_t hash) { phase_ = Phase::found, hashes_ = 1, hash_[0] = hash; }
  /// In this state the program goes on as it was found. Searches of other part systems are as if their programs had come to their places behind this one, so a
  /// state that one of them has left is such a state; that of before is one again when the host has put back what the search has written.
  bool goes_on_in(uint64_t hash) const;
  /// Another part system has searched on from such a state, and has left this one. `begins`: its search has begun with it, else it has gone on.
  void searched_beside(uint64_t hash, bool begins);
  /// A text that the program is in has been replaced: the place is no longer the one that was found.
  void outdate() { outdated_ = true; }
  bool outdated() const { return outdated_; }
  /// What was given to the machine; where the place is and in which state the program is there says the part system.
  void tell(nc_restart_found* out) const;

  /// States of the scan, as the program has set them last before the place, in the order in which it has: the scan of a program that begins here has
  /// to be told them. The tool in the spindle is none of them: it is the one that is there.
  const Action* controls() const { return control_; }
  unsigned control_count() const { return control_count_; }

 private:
  bool on_line(const Item& item) const { return item.source.file == wanted_.file && item.source.line == wanted_.line; }
  void note_action(const Action& action);
  void note_m(uint32_t number, bool changes_tool);
  void note_control(const Action& action);
  static constexpr unsigned kControls = 16;
  static constexpr unsigned kHashes = 8;  ///< of more searches beside this one the oldest are forgotten; what they have left makes the place out of date

  Phase phase_ = Phase::none;
  nc_restart_place place_{};
  nc_world world_{};
  nc_source wanted_{};      ///< file and line of the block; line 0: blocks are counted
  bool in_block_ = false;   ///< items of the block in hand have come
  uint32_t passings_ = 0;   ///< so often has the program come to it
  bool counted_ = false;    ///< comes_to_line() has been asked behind block counted_at_
  BlockSeq counted_at_ = 0;
  unsigned open_ = 0;       ///< blocks that comes_to_line() has counted and that have not come to their ends
  bool torn_ = false;
  bool radius_given_ = false;
  uint64_t blocks_ = 0;
  uint64_t hash_[kHashes] = {};
  unsigned hashes_ = 0;
  bool outdated_ = false;
  nc_restart_found given_{};
  uint32_t codes_ = 0;      ///< codes that have come: the order of the newest
  bool changed_ = false;    ///< a tool change has come, whose code is change_
  uint32_t change_ = 0;
  Action control_[kControls];
  unsigned control_count_ = 0;
};

}  // namespace nc
