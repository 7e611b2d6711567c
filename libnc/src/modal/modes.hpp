// SPDX-License-Identifier: Apache-2.0
// The modes of a program: exactly one function of each mode is in force. This table serves all families; the number that a family gives to its group
// of codes is only a column of the family's own table.
#pragma once

#include "dialect/function.hpp"

namespace nc {

enum class Mode : uint8_t {
  motion, plane, distance, stroke_check, feed, unit, radius, length, cycle, return_level, scaling, work,
  cutting, macro, normal_line, rotation, surface_speed, polar_command, mirror, interpolation,
  arc_centre, high_speed,
  none   ///< of a function that acts in its own block only
};
inline constexpr unsigned kModes = static_cast<unsigned>(Mode::none);

namespace detail {

struct ModeTable {
  Mode of[kFunctions];
};

struct ModeRow {
  Mode mode;
  Function function;
};

inline constexpr ModeRow kModeRows[] = {
    {Mode::motion, Function::rapid},
    {Mode::motion, Function::linear},
    {Mode::motion, Function::arc_cw},
    {Mode::motion, Function::arc_ccw},
    {Mode::motion, Function::spiral_cw},
    {Mode::motion, Function::spiral_ccw},
    {Mode::motion, Function::exponential_positive},
    {Mode::motion, Function::exponential_negative},
    {Mode::motion, Function::space_arc_first},
    {Mode::motion, Function::space_arc_second},
    {Mode::motion, Function::nurbs},
    {Mode::motion, Function::thread},
    {Mode::plane, Function::plane_xy},
    {Mode::plane, Function::plane_zx},
    {Mode::plane, Function::plane_yz},
    {Mode::distance, Function::absolute},
    {Mode::distance, Function::incremental},
    {Mode::stroke_check, Function::stroke_check_off},
    {Mode::stroke_check, Function::stroke_check_on},
    {Mode::feed, Function::feed_per_minute},
    {Mode::feed, Function::feed_per_revolution},
    {Mode::feed, Function::inverse_time_feed},
    {Mode::unit, Function::metric},
    {Mode::unit, Function::inch},
    {Mode::radius, Function::comp_off},
    {Mode::radius, Function::comp_left},
    {Mode::radius, Function::comp_right},
    {Mode::length, Function::length_off},
    {Mode::length, Function::length_plus},
    {Mode::length, Function::length_minus},
    {Mode::length, Function::length_along_tool},
    {Mode::length, Function::length_of_block},
    {Mode::length, Function::tool_tip_1},
    {Mode::length, Function::tool_tip_2},
    {Mode::cycle, Function::cycle_off},
    {Mode::cycle, Function::cycle_drill},
    {Mode::cycle, Function::cycle_spot},
    {Mode::cycle, Function::cycle_peck},
    {Mode::cycle, Function::cycle_step},
    {Mode::cycle, Function::cycle_bore_feed},
    {Mode::cycle, Function::cycle_bore_dwell},
    {Mode::cycle, Function::cycle_tap},
    {Mode::cycle, Function::cycle_reverse_tap},
    {Mode::cycle, Function::cycle_circle},
    {Mode::cycle, Function::cycle_fine_bore},
    {Mode::cycle, Function::cycle_bore_stop},
    {Mode::cycle, Function::cycle_back_bore},
    {Mode::cycle, Function::cycle_bore_stop_dwell},
    {Mode::cycle, Function::user_cycle},
    {Mode::cycle, Function::user_fixed_cycle},
    {Mode::return_level, Function::return_initial},
    {Mode::return_level, Function::return_r},
    {Mode::scaling, Function::scaling_off},
    {Mode::scaling, Function::scaling_on},
    {Mode::work, Function::work_system},
    {Mode::work, Function::extended_system},
    {Mode::cutting, Function::cutting_mode},
    {Mode::cutting, Function::exact_stop_mode},
    {Mode::cutting, Function::high_accuracy_mode},
    {Mode::cutting, Function::corner_override},
    {Mode::cutting, Function::tapping_mode},
    {Mode::cutting, Function::synchronous_tapping},
    {Mode::cutting, Function::synchronous_tapping_reverse},
    {Mode::macro, Function::macro_modal_off},
    {Mode::macro, Function::macro_modal},
    {Mode::macro, Function::macro_every_block},
    {Mode::normal_line, Function::normal_line_off},
    {Mode::normal_line, Function::normal_line_left},
    {Mode::normal_line, Function::normal_line_right},
    {Mode::rotation, Function::rotation_off},
    {Mode::rotation, Function::rotation_on},
    {Mode::surface_speed, Function::surface_off},
    {Mode::surface_speed, Function::surface_on},
    {Mode::polar_command, Function::polar_command_off},
    {Mode::polar_command, Function::polar_command_on},
    {Mode::mirror, Function::mirror_off},
    {Mode::mirror, Function::mirror_on},
    {Mode::interpolation, Function::polar_off},
    {Mode::interpolation, Function::polar_on},
    {Mode::interpolation, Function::cylinder},
    {Mode::arc_centre, Function::centre_incremental},
    {Mode::arc_centre, Function::centre_absolute},
    {Mode::cycle, Function::cycle_rigid_tap},
    {Mode::cycle, Function::cycle_rigid_reverse_tap},
    {Mode::cycle, Function::cycle_bore_restart},
    {Mode::cycle, Function::cycle_case_bore},
    {Mode::cycle, Function::cycle_bore_oriented},
    {Mode::cycle, Function::cycle_face_upwards},
    {Mode::high_speed, Function::high_speed_off},
    {Mode::high_speed, Function::high_speed_on},
    {Mode::motion, Function::probe},
    {Mode::motion, Function::probe_try},
    {Mode::motion, Function::probe_away},
    {Mode::motion, Function::probe_away_try},
};

constexpr ModeTable make_mode_table() {
  ModeTable table{};
  for (Mode& mode : table.of) mode = Mode::none;
  for (const ModeRow& row : kModeRows) table.of[static_cast<unsigned>(row.function)] = row.mode;
  return table;
}
inline constexpr ModeTable kModeTable = make_mode_table();

}  // namespace detail

/// The mode to which a function belongs, Mode::none when it is not modal.
constexpr Mode mode_of(Function function) { return detail::kModeTable.of[static_cast<unsigned>(function)]; }

/// The function in force where a family has no codes for a mode: that of the first row of the mode above.
constexpr Function resting(Mode mode) {
  for (const detail::ModeRow& row : detail::kModeRows)
    if (row.mode == mode) return row.function;
  return Function::count_;
}

}  // namespace nc
