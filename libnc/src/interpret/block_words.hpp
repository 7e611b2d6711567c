// SPDX-License-Identifier: Apache-2.0
// The words of one block with their values: expressions evaluated, units applied where they do not depend on the rest of the block.
#pragma once

#include <bit>
#include <initializer_list>

#include "dialect/dialect.hpp"

namespace nc {

struct BlockContext;
struct Interpreter;
enum class Execution : uint8_t;

/// An address is the number of its letter, from 0 = A.
inline constexpr unsigned kAddresses = 26;
constexpr unsigned address_of(char letter) { return static_cast<unsigned>(letter - 'A'); }
constexpr unsigned address_of(const Word& word) { return address_of(word.letter); }
constexpr char letter_of(unsigned address) { return static_cast<char>('A' + address); }
/// The lowest member of a set that is not empty.
constexpr unsigned first_of(uint32_t set) { return static_cast<unsigned>(std::countr_zero(set)); }

struct BlockWords {
  const AddressTable* addresses = nullptr;  ///< what the addresses mean in this family
  uint32_t present = 0;            ///< bit n: address n stands in the block, with a value
  double raw[kAddresses + 1];      ///< value of each address as programmed, of several words the last one; undefined where not present
  uint8_t flags[kAddresses + 1];   ///< WordFlag bits of that word
  uint32_t axes = 0;               ///< bit i: axis i is commanded
  uint32_t incremental = 0;        ///< bit i: axis i is commanded incrementally (G91)
  AxisVec axis;                    ///< commanded value of each axis, mm or deg
  FixedVector<const FunctionRow*, 16> g; ///< G codes in order
  FixedVector<uint32_t, 16> m;     ///< M codes in order
  const FunctionRow* one_shot = nullptr; ///< the one-shot function that takes the words, or null
  const FunctionRow* motion = nullptr;   ///< the motion that this block names, or null
  const FunctionRow* cycle = nullptr;    ///< the fixed cycle that this block names, or null
  bool exact_stop = false;         ///< G09
  const FunctionRow* corner_code = nullptr;    ///< G10 of the Series 8: the block ends with a corner, or null
  const FunctionRow* distance_once = nullptr;  ///< the code by which all words of this block are absolute or incremental, or null
  bool comp_entry = false;         ///< compensation that begins here leads straight to its first end (Series 8 G43)
  bool fin_behind_dwell = false;   ///< M S T B beside G04: their completion is waited for after the dwell
  char late_number = 0;            ///< letter of an N or O that stands behind other words, 0 = none
  uint8_t counted_feeds = 0;       ///< F1= to F8=, bit n - 1 (M700 15.5); their values stand in counted_feed
  double counted_feed[8];
  double in_position = 0;          ///< ,I: in-position width of this block, mm (M700 6.1, 6.2, 13.1.1); 0 = none
  double in_position_drill = 0;    ///< ,J: that of the drilling axis in a fixed cycle, mm (M700 13.1.1); 0 = none
  Corner corner = Corner::none;    ///< ,C ,R (M700 13.7): the later one counts
  uint8_t corner_flags = 0;        ///< WordFlag of it
  double corner_raw = 0;           ///< as programmed
  bool has_tap_control = false, has_return_speed = false;  ///< ,R ,S of a tap (M700 13.1.1) ...
  double tap_control = 0, return_speed = 0;                ///< ... as programmed
  bool has_angle = false;          ///< ,A (M700 13.8)
  uint8_t angle_flags = 0;         ///< WordFlag of it
  double angle_raw = 0;            ///< as programmed
  bool meeting = false;            ///< the block has no end, or meets the one before, which has none (M700 13.9)
  int8_t device = 0;               ///< ,D: where a sub program is looked for (M700 13.3.1), 0 = the memory
  bool comp_command = false;       ///< G40-G42 that means something here
  uint64_t absolute_at = 0, incremental_at = 0;  ///< bit i: word i of the block is G90, G91

  bool any(uint32_t of) const { return (present & of) != 0; }
  bool any(std::initializer_list<Role> of) const { return any(addresses->set(of)); }
  /// Whether the word with this meaning stands in the block; its value as programmed and its WordFlag bits, which are valid only then.
  bool has(Role word) const { return (present >> addresses->at(word)) & 1; }
  double get(Role word) const { return raw[addresses->at(word)]; }
  uint8_t flag(Role word) const { return flags[addresses->at(word)]; }
  /// The word is written with a point, or is an expression, which counts as one with a point (M700 5.3).
  bool pointed(Role word) const { return (flag(word) & (kWordPoint | kWordExpression)) != 0; }
  /// Whether a word stands in the block, and its value, by the name that the configuration or a parameter gives an axis.
  bool has(char name) const { return (present >> address_of(name)) & 1; }
  double get(char name) const { return raw[address_of(name)]; }
};

/// The word of the block that commands a corner.
inline Role corner_word(const BlockWords& words) { return words.corner == Corner::chamfer ? Role::option_chamfer : Role::option_corner_radius; }

/// Words of the block in hand that belong to no axis in particular are increments.
bool is_incremental(const BlockContext& in);

/// Evaluates every word, and finds the G and M codes and their functions. Changes only in.words.
Execution gather_words(Interpreter& in);

/// The letter of the first word of the block whose address is in `of` (not empty), for alarms.
char first_of_block(const BlockContext& in, uint32_t of);

/// Applies the unit and distance modes to the axis words. To be called when the modal codes of the block are in force.
Execution resolve_axes(Interpreter& in);

/// Value of a length word (I J K R Q and the like) in mm, or of an angle word in deg (`rotary`). `setting_unit`: a word without a point counts in the
/// setting unit, otherwise in the command unit. `tenfold`: "UNIT*10" acts on it (M700 2.2).
double length_value(const BlockContext& in, double raw, uint8_t flags, bool rotary, bool setting_unit, bool tenfold = true);
double length_of(const BlockContext& in, Role word, bool setting_unit = true);
double length_of(const BlockContext& in, char axis_name, bool setting_unit = true);
/// Value of a position word of an axis, by the command unit of this axis (M700 2.1, #1015).
double axis_value(const BlockContext& in, unsigned axis, double raw, uint8_t flags, bool rotary);
/// Turns the F of the block into the number that becomes modal.
Execution feed_of(BlockContext& in, double* feed);
/// Turns a value into a whole number; a fraction is dropped (M700 5.3). False when it is negative or too large.
bool whole_number(double raw, uint32_t* number);

}  // namespace nc
