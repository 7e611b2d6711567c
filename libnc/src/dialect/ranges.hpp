// SPDX-License-Identifier: Apache-2.0
// The ranges of words, parameters and system variables in which the families of controllers differ. Each family states its own in
// dialect/<family>/ranges.hpp, each with the section of its manual that gives it, or with the remark that the manual is silent; what counts then is the
// practice of FANUC's controls (docs/decisions.md). No range has a value of its own here, so that a new family has to think of every one. A family that has
// no such word, parameter or variable says 0.
#pragma once

#include <cstdint>

namespace nc {

struct RangeRules {
  // ---- numbers of programs and of the functions of the machine
  uint32_t largest_program;         ///< number of a program, where it is called, searched for or the name of a file (and so never 0)
  uint32_t largest_misc;            ///< M
  uint32_t largest_second_misc;     ///< the second auxiliary function
  uint32_t largest_spindle_value;   ///< S, and the limits of the spindle speed
  uint32_t largest_tool;            ///< T
  // ---- positions and feeds. A number is below the end of its range by at least one least unit, so that with finer units it has more decimals.
  double end_of_positions_mm;       ///< also in deg
  double end_of_positions_inch;
  double end_of_offset_mm, end_of_offset_inch;  ///< work offset and amount of tool length, either sign, while millimetres or inches are in force; also in deg
  double end_of_radius_mm, end_of_radius_inch;  ///< amount of radius compensation, either sign, while millimetres or inches are in force
  double end_of_revolution_feed;    ///< feed per revolution, mm or inch
  double end_of_inverse_time;       ///< inverse-time feed, 1/min
  // ---- leads of threads and taps: below the end
  double end_of_lead_mm, end_of_lead_inch;
  double end_of_fine_lead_inch;                      ///< by the word with more digits
  double end_of_ridges_mm, end_of_ridges_inch;       ///< threads per inch, while millimetres or inches are in force
  // ---- words of functions
  uint32_t most_arc_turns;          ///< full turns of an arc
  uint32_t most_call_repeats;       ///< repetitions of a call
  uint32_t most_hole_repeats;       ///< holes of one block of a fixed cycle
  uint32_t most_holes;              ///< of a row, a circle or a grid; one less than a power of ten, where only the last digits count
  uint32_t most_pitches;            ///< of a spiral or a cone
  double least_curve_weight, most_curve_weight;      ///< of a point of NURBS
  double steepest_exponential_deg;                   ///< taper and torsion of exponential interpolation, either sign
  double most_current_percent;                       ///< of the rated current of an axis
  double least_scale, most_scale;                    ///< factor of scaling; a parameter beyond them counts as 1
  double least_in_position_mm, most_in_position_mm;  ///< width of a block's own in-position check
  uint32_t most_return_speed;                        ///< spindle speed of the way out of a tap, r/min
  double largest_turn_vector, largest_turn_deg;      ///< vector and angle that turn the workpiece coordinate systems, either sign
  double longest_input_wait_s;                       ///< of a block that waits for an input
  double largest_calling_value;                      ///< of a word that a parameter registers to call a program, either sign
  // ---- system variables
  uint32_t largest_alarm;           ///< number of an alarm that a program raises
  uint32_t most_workpieces;         ///< counter of workpieces and its maximum
  double longest_counter_ms;        ///< counters of time
  uint32_t first_year, last_year;   ///< of a date that a program sets
  uint32_t largest_parameter;       ///< number of a parameter that is read by variables
  uint32_t largest_device;          ///< number of a device of the PLC that is read by variables
  // ---- management of the lives of tools
  uint32_t largest_life_number;     ///< of a group, and of a tool in it
  uint32_t most_life_minutes, most_life_times;
  double most_life(bool in_minutes) const { return in_minutes ? most_life_minutes : most_life_times; }
};

}  // namespace nc
