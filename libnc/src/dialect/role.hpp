// SPDX-License-Identifier: Apache-2.0
// What a word of a block means to the function that takes it. A table of the family says which address (letter) carries which meaning. The
// same address may carry several meanings; which of them applies follows from the function that asks for the word.
#pragma once

#include <cstdint>
#include <initializer_list>

#include "program/word_slot.hpp"

namespace nc {

enum class Role : uint8_t {
  // ---- words of any block
  code, misc_code,                      ///< G and M codes
  sequence_number, program_number,
  feed, spindle_speed, tool,
  second_function, second_function_2, second_function_3,   ///< the first of them that is no axis of the machine is the second auxiliary function
  offset_number, length_number,         ///< number of the offset of the tool radius and of the tool length
  basic_x, basic_y, basic_z,            ///< names of the basic axes, used if a rule names these axes and no parameter does
  vector_x, vector_y, vector_z,         ///< components along the basic axes of the centre of an arc, of a vector or of a second corner

  // ---- motions
  arc_radius, arc_turns,
  spiral_pitches, spiral_step, helix_pitches,   ///< of a spiral: number of pitches, change of the radius in one pitch, number of pitches of the helix
  thread_lead, fine_thread_lead, thread_start,  ///< the fine lead has more digits, or is in threads per inch
  taper_angle, torsion_angle, exponential_radius, exponential_end_feed,   ///< of an exponential curve
  curve_order, curve_knot, curve_weight,        ///< of a NURBS
  circle_radius,                                ///< of a circle that is cut from its centre
  line_angle, meeting_choice,                   ///< slope of a line; which of two points it meets a circle in
  meeting_center, meeting_center_2,             ///< coordinates of the centre of such a circle, along the axes of the plane in the order X Y Z
  turn_x, turn_y, turn_z,                       ///< names of the axes that turn about the basic ones

  // ---- dwell, cycles
  dwell_seconds, dwell_time,                    ///< a dwell has one of the two; the second is in ms if it has no decimal point
  cycle_level, cycle_depth_step, cycle_dwell, cycle_count, cycle_count_2,   ///< R point, cut of one peck or shift, time at the bottom, number of holes

  // ---- calls and jumps
  call_program, call_repeats, call_sequence, call_option, return_sequence, return_passes, interrupt_program,
  loop_number, loop_end, port, binary_port,                  ///< of statements that have no words of their own: letters for their alarms

  // ---- coordinates and data
  input_kind, input_number, input_amount, turn_angle,     ///< of data setting: what is set, its number, its value; angle of the workpiece
  system_number,                                ///< number of an extended workpiece coordinate system
  parameter_number, parameter_system, parameter_axis, parameter_bit, parameter_data,
  scaling_factor, rotation_angle,
  return_place,                                 ///< number of a reference position

  // ---- options behind a comma
  option_in_position, option_in_position_drill, option_device, option_chamfer, option_corner_radius, option_angle,

  // ---- spindle, skip and measuring
  clamp_highest, clamp_lowest, surface_axis,
  skip_signals,
  measure_deceleration, measure_range,

  // ---- modes of accuracy and speed
  speed_mode, speed_option, accuracy_switch,    ///< value of the high-speed modes, of those of its second code, of the high-accuracy mode

  call_end_sequence,                            ///< of a call: the last block that is run
  // ---- taps and patterns of holes
  option_tap_control, option_return_speed, tap_ridges,   ///< behind a comma the first two; threads per inch
  hole_interval, hole_angle, hole_angle_step, hole_columns, hole_interval_2, hole_count,   ///< the interval of a circle is its radius
  cycle_first_depth, tap_lead,                  ///< end of the first cut; way of a tap in one turn of the spindle
  cavity_length, cavity_width, cavity_cut, cavity_step, cavity_corner,   ///< of a circle the length is its radius
  surface_radius,                               ///< radius at the present position, for constant surface speed
  // ---- machine inputs and outputs by number
  output_number, word_number, word_value, input_wait, input_limit,   ///< a bit; a word and its value; how an input is waited for, and for how long, s
  path_tolerance, line_tolerance,               ///< how far corners may be cut; how far lines that become one may lie off
  override_switch, named_tool, orient_angle,    ///< allows or bars one override; tool in the spindle; angle of an oriented spindle, deg
  // ---- tool life: of a group its number, the life of each tool and what is counted; of a tool its number and those of its offsets
  life_group, life_span, life_method, life_tool, life_length, life_radius,
  count_
};
inline constexpr unsigned kRoles = static_cast<unsigned>(Role::count_);

/// vector_along() is the vector component along basic axis 0, 1 or 2; basic_along() is the name of this axis.
constexpr Role vector_along(unsigned axis) { return static_cast<Role>(static_cast<unsigned>(Role::vector_x) + axis); }
constexpr Role basic_along(unsigned axis) { return static_cast<Role>(static_cast<unsigned>(Role::basic_x) + axis); }

struct RoleRow {
  Role role;
  char letter;
};

/// A meaning and its word, for families whose words are not letters.
struct SlotRow {
  Role role;
  WordSlot slot;
};

/// How a family spells a word that is not a letter.
struct WordName {
  WordSlot slot;
  const char* name;  ///< "FEED"
};

/// The address of each meaning, and the spelling of the words.
class AddressTable {
 public:
  /// A meaning that no row names has no address: the family has no such word. Every word is spelled as its letter.
  template <unsigned n>
  explicit constexpr AddressTable(const RoleRow (&rows)[n]) {
    for (uint8_t& address : at_) address = kNoAddress;
    for (const RoleRow& row : rows) at_[static_cast<unsigned>(row.role)] = static_cast<uint8_t>(index_of(word_named(row.letter)));
  }
  /// The same for words that need not be letters. A word that `names` does not list is spelled as its letter; one that has no letter has to be listed.
  template <unsigned n, unsigned m>
  constexpr AddressTable(const SlotRow (&rows)[n], const WordName (&names)[m]) {
    for (uint8_t& address : at_) address = kNoAddress;
    for (const SlotRow& row : rows) at_[static_cast<unsigned>(row.role)] = static_cast<uint8_t>(index_of(row.slot));
    for (const WordName& row : names) name_[index_of(row.slot)] = row.name;
  }
  /// Gives a meaning another letter.
  constexpr void bind(Role role, char letter) { at_[static_cast<unsigned>(role)] = static_cast<uint8_t>(index_of(word_named(letter))); }
  /// The set of the addresses in the string `of`, which consists of capital letters; bit n = address n.
  static constexpr uint32_t letters(const char* of) {
    uint32_t set = 0;
    for (; *of != 0; ++of) set |= set_of(word_named(*of));
    return set;
  }
  /// The address of a meaning, below kNoAddress, or kNoAddress.
  constexpr unsigned at(Role role) const { return at_[static_cast<unsigned>(role)]; }
  /// The character by which a fault names the word with this meaning, 0 = the family has none. In a family of letters it is the letter.
  constexpr char letter(Role role) const { return letter_of(word(role)); }
  constexpr bool is(WordSlot slot, Role role) const { return index_of(slot) == at(role); }
  /// The same of the character by which a fault names a word.
  constexpr bool is(char named_by, Role role) const { return has(role) && word(role) == word_named(named_by); }
  /// The name of a word that is not spelled as its letter, nullptr = it is.
  constexpr const char* name(WordSlot slot) const { return slot == kNoWord ? nullptr : name_[index_of(slot)]; }
  /// The word with a meaning, kNoWord = the family has none.
  constexpr WordSlot word(Role role) const { return WordSlot{at_[static_cast<unsigned>(role)]}; }
  constexpr bool has(Role role) const { return at(role) != kNoAddress; }
  /// Two meanings have the same word, or none has one.
  constexpr bool same(Role a, Role b) const { return at(a) == at(b); }
  /// The set of the addresses of these meanings, bit n = address n. A meaning without an address adds nothing.
  constexpr uint32_t set(std::initializer_list<Role> roles) const {
    uint32_t set = 0;
    for (const Role role : roles) set |= set_of(word(role));
    return set;
  }

 private:
  uint8_t at_[kRoles]{};
  const char* name_[kAddresses]{};
};

}  // namespace nc
