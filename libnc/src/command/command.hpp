// SPDX-License-Identifier: Apache-2.0
// What one block commands. The front end of a family makes it of a compiled block (command/reader.hpp), and the interpreter executes it.
//
//   functions  as rows of the family's table, each with its Function: all in the order of the block, and those that decide what is done: the motion, the
//              fixed cycle, the one-shot function that takes the words, exact stop, a corner, absolute or incremental words for this block alone
//   auxiliary  functions by what they mean (MiscFunction), with the number by which they are put out
//   targets    by axis: whether it is commanded, whether the value is a place, an increment, a radius or an angle, and the value
//   words      by their meaning to the function in hand (Role). The same word may have several meanings; the function decides which one it asks for
//   options    what stands behind commas: corner, slope, widths of in-position checks, the words of taps, a device
//
// No letter is in it. A word that an alarm has to show is a WordSlot, which only this room and dialect/ can turn into a letter; a set of words is a WordSet.
#pragma once

#include <bit>
#include <initializer_list>

#include "command/auxiliary.hpp"
#include "command/target.hpp"
#include "command/word.hpp"
#include "dialect/dialect.hpp"

namespace nc {

/// The first word of a set that is not empty; the lowest member of any set of bits.
constexpr unsigned first_of(uint32_t set) { return static_cast<unsigned>(std::countr_zero(set)); }
constexpr WordSlot first_word(WordSet set) { return WordSlot{static_cast<uint8_t>(first_of(set))}; }

struct Command {
  static constexpr uint32_t kNoVariable = ~uint32_t{0};
  const AddressTable* addresses = nullptr;  ///< what the words mean in this family

  // ---- functions
  FixedVector<const FunctionRow*, 16> functions;  ///< in the order of the block
  FixedVector<Auxiliary, 16> auxiliary;           ///< in the order of the block
  const FunctionRow* one_shot = nullptr; ///< the one-shot function that takes the words, or null
  const FunctionRow* motion = nullptr;   ///< the motion that this block names, or null
  const FunctionRow* cycle = nullptr;    ///< the fixed cycle that this block names, or null
  const FunctionRow* corner_code = nullptr;    ///< G10 of the Series 8: the block ends with a corner, or null
  const FunctionRow* distance_once = nullptr;  ///< the code by which all words of this block are absolute or incremental, or null
  bool exact_stop = false;         ///< G09
  bool comp_entry = false;         ///< compensation that begins here leads straight to its first end (Series 8 G43)
  bool comp_command = false;       ///< G40-G42 that means something here
  bool vector_in_space = false;    ///< a vector in space (M700 12.3, 12.5) is in force before this block or in it
  bool meeting = false;            ///< the block has no end, or meets the one before, which has none (M700 13.9)
  bool fin_behind_dwell = false;   ///< M S T B beside G04: their completion is waited for after the dwell
  bool moved_before = false;       ///< it has been read before, and has gone to places of its pattern
  bool stops_given_out = false;    ///< M00 and M01 have gone out before the end of the block

  // ---- targets
  Targets target;

  // ---- words
  WordSet present = 0;             ///< words that stand in the block, with a value
  WordSlot late_number = kNoWord;  ///< an N or O that stands behind other words
  WordSlot bare_axis = kNoWord;    ///< an axis word without a number
  uint32_t vacant_feed = kNoVariable;  ///< the variable of an F that is left out because it is vacant
  uint8_t counted_feeds = 0;       ///< F1= to F8=, bit n - 1 (M700 15.5); their values stand in counted_feed
  double counted_feed[8];

  // ---- options behind commas
  double in_position = 0;          ///< ,I: in-position width of this block, mm (M700 6.1, 6.2, 13.1.1); 0 = none
  double in_position_drill = 0;    ///< ,J: that of the drilling axis in a fixed cycle, mm (M700 13.1.1); 0 = none
  Corner corner = Corner::none;    ///< ,C ,R (M700 13.7): the later one counts
  Written corner_size;
  bool has_tap_control = false, has_return_speed = false;  ///< ,R ,S of a tap (M700 13.1.1) ...
  double tap_control = 0, return_speed = 0;                ///< ... as programmed
  bool has_angle = false;          ///< ,A (M700 13.8)
  Written angle;
  int8_t device = 0;               ///< ,D: where a sub program is looked for (M700 13.3.1), 0 = the memory

  // ---- the words of the block by their places
  uint64_t absolute_at = 0, incremental_at = 0;  ///< bit i: word i of the block is G90, G91

  bool any(WordSet of) const { return (present & of) != 0; }
  bool any(std::initializer_list<Role> of) const { return any(addresses->set(of)); }
  /// Whether the word with this meaning stands in the block; its value as programmed, and how it is written, which are valid only then.
  bool has(Role word) const { return (present >> addresses->at(word)) & 1; }
  double get(Role word) const { return value_[addresses->at(word)]; }
  Written written(Role word) const { return written(addresses->word(word)); }
  /// The word is written with a point, or is an expression, which counts as one with a point (M700 5.3).
  bool pointed(Role word) const { return written(word).pointed(); }
  /// The same of a word that is known by the name of an axis, or as the first of a set.
  bool has(WordSlot word) const { return holds(present, word); }
  double get(WordSlot word) const { return value_[index_of(word)]; }
  Written written(WordSlot word) const { return {value_[index_of(word)], form_[index_of(word)]}; }

  /// The word counts as if it had this value.
  void put(WordSlot word, double value) { value_[index_of(word)] = value; }
  /// The block counts as if this word stood in it, with a point; as if it did not.
  void give(WordSlot word, double value) {
    value_[index_of(word)] = value;
    form_[index_of(word)] = kWordPoint;
    present |= WordSet{1} << index_of(word);
  }
  void leave_out(WordSlot word) { present &= ~(WordSet{1} << index_of(word)); }

 private:
  friend class CommandReader;
  double value_[kAddresses + 1];   ///< of each word as programmed, of several the last one; undefined where it does not stand in the block
  uint8_t form_[kAddresses + 1];   ///< WordFlag bits of it
};

/// The word of the block that commands a corner.
inline Role corner_word(const Command& words) { return words.corner == Corner::chamfer ? Role::option_chamfer : Role::option_corner_radius; }

}  // namespace nc
