// SPDX-License-Identifier: Apache-2.0
// One sentence for the person at the machine: what in this block is wrong and, if it helps, what to do. The sentences are the same for all
// families, and the codes in them are those of the family. The alarm's code and its short text are the manual's and are not made here.
//
// A sentence is a template. {word} stands for the offending word with its value ("X12.5", "G54.1"), {axis} for the axis ("axis X"), {value}
// for the value alone, {function} for the function or operator of a formula. {comp_off} and other names of kNamedCodes stand for the code that
// the family has for the function; kNamedMisc and kNamedWords list further names. If a fault does not carry all that the first sentence of its
// row needs, the second sentence is taken. If the letter of a fault is that of G or M codes, the fault is about a code, and its value is the
// number of this code; it has no other value for {value}.
#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "dialect/alarms.hpp"
#include "dialect/dialect.hpp"
#include "dialect/function_table.hpp"
#include "dialect/text.hpp"

namespace nc {
namespace {

using C = Condition;

struct Sentence {
  Condition condition;
  const char* full;
  const char* plain;           ///< a sentence that needs no word and no value; nullptr = `full` needs none either
  const char* code = nullptr;  ///< taken instead of `full` if the letter of the fault is that of G or M codes
  bool (*only)(const Dialect&, const Fault&) = nullptr;  ///< the row is one for such faults alone; it stands in front of the row for all others
};

// ---- what a fault may be, beside its condition, to have a sentence of its own
/// The fault is about a code with this function.
template <Function kFunction>
bool of(const Dialect& dialect, const Fault& fault) {
  if (!dialect.addresses.is(fault.letter, Role::code) || !fault.has_value || !(fault.value >= 0 && fault.value < 1e6)) return false;
  const FunctionRow* const row = find_function(dialect, static_cast<int>(std::lround(fault.value * 10)));
  return row != nullptr && row->function == kFunction;
}
/// The fault is about a code of the family: the control has it.
bool of_known_code(const Dialect& dialect, const Fault& fault) {
  if (!dialect.addresses.is(fault.letter, Role::code) || !fault.has_value || !(fault.value >= 0 && fault.value < 1e6)) return false;
  return find_function(dialect, static_cast<int>(std::lround(fault.value * 10))) != nullptr;
}
/// A centre whose words have no sign (Series 8 G02): a circle through both ends may well exist.
bool of_unsigned_centre(const Dialect& dialect, const Fault& fault) {
  return dialect.rules.arc.centre_by_quadrant && fault.letter != dialect.addresses.letter(Role::arc_radius);
}
/// The code of a mode in which a plane is programmed and linear and rotary axes follow it.
bool of_cylinder_or_polar(const Dialect& dialect, const Fault& fault) {
  return of<Function::cylinder>(dialect, fault) || of<Function::polar_on>(dialect, fault) || of<Function::polar_off>(dialect, fault);
}
/// The choice between two places in which two blocks meet (M700 13.9).
bool of_meeting_choice(const Dialect& dialect, const Fault& fault) { return fault.has_value && fault.letter != 0 && fault.letter == dialect.addresses.letter(Role::meeting_choice); }
/// A coordinate that is given, with its value.
bool of_coordinate(const Dialect&, const Fault& fault) { return fault.axis >= 0 && fault.has_value; }
/// A curve that no compensation can displace (M700 6.11, 6.12): along the tool neither (12.3).
bool of_free_curve(const Dialect& dialect, const Fault& fault) {
  return find_function(dialect, 431) != nullptr && (of<Function::nurbs>(dialect, fault) || of<Function::exponential_positive>(dialect, fault) || of<Function::exponential_negative>(dialect, fault));
}
bool of_variable(const Dialect&, const Fault& fault) { return fault.letter == '#'; }
/// The spindle turns in one direction, and so there is no tap (DGSHAPE).
bool turns_one_way(const Dialect& dialect, const Fault&) {
  const auto reverses = [](const auto& row) { return row.function == MiscFunction::spindle_reverse; };
  return std::none_of(dialect.misc.begin(), dialect.misc.end(), reverses) && std::none_of(dialect.outputs.begin(), dialect.outputs.end(), reverses);
}
bool of_unit(const Dialect& dialect, const Fault& fault) { return of<Function::inch>(dialect, fault) || of<Function::metric>(dialect, fault); }
bool end_is_at_once(const Dialect& dialect, const Fault&) { return dialect.rules.compensation.end_is_at_once; }
bool scaling_binds_plane(const Dialect& dialect, const Fault&) { return dialect.rules.scaling.binds_plane; }
/// A code for machine coordinates that has no arcs (LinuxCNC G53), and one that has them (Series 8 G69).
bool of_machine_line(const Dialect& dialect, const Fault& fault) {
  return of<Function::machine_move>(dialect, fault) && !dialect.rules.coordinate.machine_move_is_absolute;
}
bool of_machine_arc(const Dialect& dialect, const Fault& fault) {
  return of<Function::machine_move>(dialect, fault) && dialect.rules.coordinate.machine_move_is_absolute;
}

/// A name that may stand for a G code in a sentence: {comp_off} becomes the code that the family has for this function.
struct NamedCode {
  const char* name;
  Function function;
};
constexpr NamedCode kNamedCodes[] = {
    {"rotation_on", Function::rotation_on}, {"rotation_off", Function::rotation_off}, {"scaling_off", Function::scaling_off},
    {"offset_longer", Function::offset_longer}, {"offset_shorter", Function::offset_shorter},
    {"comp_off", Function::comp_off}, {"rapid", Function::rapid}, {"linear", Function::linear},
    {"corner_arc", Function::comp_corner_arc}, {"corner_turn", Function::comp_corner_turn}, {"cycle_off", Function::cycle_off}, {"plane_xy", Function::plane_xy},
    {"incremental", Function::incremental}, {"absolute", Function::absolute},
    {"comp_left", Function::comp_left}, {"comp_right", Function::comp_right},
    {"space_arc_first", Function::space_arc_first}, {"space_arc_second", Function::space_arc_second},
    {"inverse_time_feed", Function::inverse_time_feed}, {"reference_check", Function::reference_check},
    {"start_return", Function::start_return}, {"measure_length", Function::measure_length},
    {"length_plus", Function::length_plus}, {"stroke_check_on", Function::stroke_check_on},
    {"stroke_check_off", Function::stroke_check_off}, {"feed_per_minute", Function::feed_per_minute},
    {"high_accuracy", Function::high_accuracy}, {"high_speed", Function::high_speed},
    {"data_input", Function::data_input}, {"local_system", Function::local_system},
    {"extended_system", Function::extended_system}, {"macro_modal_off", Function::macro_modal_off},
    {"length_off", Function::length_off}, {"stitch_off", Function::stitch_off},
    {"macro_modal", Function::macro_modal}, {"data_input_end", Function::data_input_end},
};

/// A name that may stand for M codes: it becomes all codes with this meaning, with "or" between them.
struct NamedMisc {
  const char* name;
  MiscFunction function;
};
constexpr NamedMisc kNamedMisc[] = {
    {"program_end", MiscFunction::program_end}, {"call_sub", MiscFunction::call_sub},
    {"tool_change", MiscFunction::tool_change}, {"tool_number", MiscFunction::tool_number}, {"spindle_forward", MiscFunction::spindle_forward},
};
/// A name that may stand for a word: {feed} becomes the letter of its address.
struct NamedWord {
  const char* name;
  Role role;
};
constexpr NamedWord kNamedWords[] = {
    {"feed", Role::feed}, {"spindle_speed", Role::spindle_speed}, {"tool", Role::tool},
    {"offset_number", Role::offset_number}, {"length_number", Role::length_number},
    {"program_number", Role::program_number}, {"sequence_number", Role::sequence_number},
    {"vector_x", Role::vector_x}, {"vector_y", Role::vector_y}, {"vector_z", Role::vector_z}, {"arc_radius", Role::arc_radius},
    {"cycle_level", Role::cycle_level}, {"cavity_step", Role::cavity_step}, {"chamfer", Role::option_chamfer}, {"rounding", Role::option_corner_radius}, {"angle", Role::option_angle},
    {"line_angle", Role::line_angle}, {"turn_x", Role::turn_x}, {"turn_y", Role::turn_y}, {"turn_z", Role::turn_z},
    {"accuracy_switch", Role::accuracy_switch}, {"speed_mode", Role::speed_mode},
    {"input_kind", Role::input_kind}, {"input_number", Role::input_number},
    {"parameter_number", Role::parameter_number}, {"parameter_bit", Role::parameter_bit}, {"parameter_data", Role::parameter_data},
};

constexpr Sentence kSentences[] = {
    // words and blocks
    {C::illegal_address, "The word {word} is not possible in this block.",
     "A word of the block is not possible in it."},
    {C::exponent, "{word} has no meaning in this block. If it is meant as an exponent: numbers have none, write 0.00001 for 1E-5.",
     "Numbers have no exponent: write 0.00001 for 1E-5."},
    {C::format_error, "This must stand in a block of its own.", nullptr, "{word} must stand in a block of its own.", of_cylinder_or_polar},
    {C::format_error,
     "The word {word} is not written correctly, or does not fit the other words of the block.",
     "The block is not written correctly: a number, a letter or a sign is missing or stands in the wrong "
     "place."},
    {C::behind_semicolon, "Text behind ';', the end of the block. Give a block its own line, a comment ( ), or set semicolon_comments.", nullptr},
    {C::value_range, "The axes stand where the loop is to turn: it has no length.", nullptr, "The axes stand where {word} is to turn: the loop has no length.", of<Function::sine_loop>},
    {C::no_direction, "The words of a vector are all 0: it has no direction. Give one of them a value.", nullptr},
    {C::value_range, "The value of {word} is outside its range.",
     "A value in the block is outside its range."},
    {C::comment_open, "A comment that begins with '(' has no ')' in its line.", nullptr},
    {C::illegal_character, "The character {word} has no meaning here.",
     "The block holds a character that is not part of the code."},
    {C::block_too_long, "The block holds more words or characters than the control can take. Split it.",
     nullptr},
    {C::number_zero, "The number of {word} must be larger than 0.",
     "An {program_number} or {sequence_number} number must be larger than 0."},
    {C::program_end, "The text of the program ends without {program_end}.", nullptr,
     "The text of the sub program ends without {word}."},
    {C::no_start_mark, "The first block of a program must be '%' alone.", nullptr},
    {C::illegal_axis, "{word}: there is no such axis, or it cannot take part in this block.",
     "The block names an axis that does not exist or cannot take part in it."},
    {C::too_many_axes, "The block moves more axes than the control can move together.", nullptr},
    {C::index_increment, "{word} is not a multiple of the axis's indexing increment.",
     "{axis} can only go to multiples of its indexing increment."},
    {C::parity, "A row of the tape has a wrong number of holes. Check the tape and its reader.", nullptr},
    {C::parity_vertical, "The block has an odd number of characters on the tape. Check the tape, or switch the parity check off.",
     nullptr},
    // G and M codes
    {C::illegal_g, "A code of the block is not possible in the modes that are in force, or a parameter switches it off.", nullptr,
     "{word} is not possible in the modes that are in force, or a parameter switches it off.", of_known_code},
    {C::illegal_g, "{word} is not a code of this control.", "There is no such code on this control."},
    {C::no_function, "The function that {word} asks for is not fitted.", "This function is not fitted.",
     "{word} is not available on this control."},
    {C::must_stand_alone, "{word} must stand alone in its block.", "This must stand alone in its block."},
    {C::words_missing, "The block needs the word {word}.", "The block needs a word that is not there.",
     "{word} needs a word that is not there."},
    {C::center_missing, "The centre is missing: the block needs {vector_x}, {vector_y} or {vector_z}, one of the two of its plane.", nullptr},
    // motion
    {C::no_feed, "No feed rate is in force. Program {feed} before or in this block.", nullptr},
    {C::arc_deviation,
     "Start and end of the arc are not on one circle: the radius at the end would be {value} mm.",
     "Start and end of the arc are not on one circle about its centre."},
    {C::arc_displaced, "Vectors in space make the radii at both ends of the arc differ by {value} mm. Use vectors across its plane, or lines.",
     "Vectors in space make the radii at both ends of the arc differ. Use vectors across its plane, or lines."},
    {C::arc_by_hand, "The axes were moved by hand in front of this compensated arc. Lead them back to where the program has stopped.", nullptr},
    {C::corner_uneven, "The two axes of the plane are scaled differently, so {word} would not be the corner that is written.",
     "The two axes of the plane are scaled differently, so the corner would not be the one that is written."},
    {C::tool_unknown, "Which tool is in the spindle is not known. Program {tool_change} or {tool_number}, or the number of the offset.", nullptr},
    {C::length_beside_arc, "{word} cannot stand in the block of an arc. Give it a block in front.",
     "Length compensation cannot begin in the block of an arc. Give it a block in front."},
    {C::arc_center,
     "{vector_x} {vector_y} {vector_z} have no sign and give no centre from which both ends are as far and within one quadrant. Divide the arc, or program {arc_radius}.",
     nullptr, nullptr, of_unsigned_centre},
    {C::arc_center, "No circle of radius {value} mm goes through the start and the end of the arc.",
     "No circle of this radius goes through the start and the end of the arc."},
    {C::helix_option, "The arc moves {axis} too, and helical interpolation is not fitted.", nullptr},
    {C::plane_mismatch, "{word} does not fit the plane that is selected.",
     "The words of the arc do not belong to the plane that is selected."},
    {C::plane_in_rotation, "The plane stays while the part is rotated or scaled. Select it in front of that, or behind {rotation_off} and {scaling_off}.", nullptr,
     nullptr, scaling_binds_plane},
    {C::plane_in_rotation,
     "The plane cannot be selected while {rotation_on} rotates the coordinates. Select it before, or behind {rotation_off}.", nullptr},
    {C::space_conversion, "{rotation_on} with {vector_x}, {vector_y} and {vector_z} is the conversion in space, which this control does not have.", nullptr},
    {C::plane_in_compensation,
     "The plane cannot be changed while tool radius compensation is on. Cancel it with {comp_off} first.", nullptr, nullptr, end_is_at_once},
    {C::plane_in_compensation,
     "The plane cannot be changed while tool radius compensation is on, nor behind {comp_off} before the tool has moved.", nullptr},
    {C::arc_in_compensation_start,
     "Tool radius compensation can only start and end on a straight move ({rapid} or {linear}).", nullptr},
    {C::no_offset_number, "There is no offset number {value}.", "No offset number was given ({offset_number} or {length_number})."},
    {C::cycle_in_compensation,
     "Fixed cycles and tool radius compensation exclude each other. Cancel with {cycle_off} or {comp_off} first.", nullptr},
    {C::skip_in_compensation,
     "Skip is not possible while tool radius compensation is on. Cancel it with {comp_off} first.", nullptr},
    {C::skip_feed_zero, "The feed rate of the skip is 0. Program {feed} in this block or set the skip feed rate.",
     nullptr},
    {C::skip_feed_mode, "A skip is fed per minute. Program {feed_per_minute} and {feed} in front of it.", nullptr},
    {C::no_reference, "{axis} has not been to its reference position.", nullptr},
    {C::soft_limit, "{axis} would go to {value}, beyond its stroke limit.",
     "{axis} would go beyond its stroke limit."},
    {C::spindle_not_turning, "The spindle has to turn. Program {spindle_speed} and {spindle_forward} before it.", nullptr, nullptr, turns_one_way},
    {C::spindle_not_turning, "The spindle has to turn, for a tap the way of its thread. Program {spindle_speed} and {spindle_forward} (or the reverse) before it.", nullptr},
    {C::cycle_wrong_plane, "Fixed cycles and tool-diameter offset work in the XY plane only. Program {plane_xy}.",
     nullptr},
    {C::not_in_compensation, "A stitch and tool radius compensation exclude each other. End one of them with {stitch_off} or {comp_off} first.", nullptr, nullptr, of<Function::stitch_on>},
    {C::not_in_compensation, "Variable #{value} cannot be read while tool radius compensation is on. Cancel it with {comp_off} first.",
     "The variable cannot be read while tool radius compensation is on. Cancel it with {comp_off} first.", nullptr, of_variable},
    {C::not_in_compensation, "{word} is not possible while the radius of the tool is compensated, or its length along it. End that with {comp_off} or {length_off}.",
     "A curve is not possible while the radius of the tool is compensated, or its length along it. End that with {comp_off} or {length_off}.", nullptr, of_free_curve},
    {C::not_in_compensation,
     "{word} is not possible while tool radius compensation is on. Cancel it with {comp_off} first.",
     "This is not possible while tool radius compensation is on. Cancel it with {comp_off} first."},
    {C::code_in_incremental, "{word} is not possible with {incremental}. Program {absolute} first.",
     "This is not possible with {incremental}. Program {absolute} first."},
    {C::tool_pair, "{tool_change} and {tool} must stand together in one block.", nullptr},
    {C::comp_no_intersection,
     "The compensated paths of two blocks do not meet. Use a smaller tool or a larger inner radius.",
     nullptr},
    {C::comp_interference, "Line {value} leads the tool into the contour. Use a smaller tool or change the contour.",
     "The tool would cut into the contour. Use a smaller tool or change the contour."},
    {C::comp_way, "The way in or out in line {value} leads into the contour. Begin or end it farther on the tool's side, or 2 radii straight on.",
     "The way in or out of the contour leads into it. Begin or end it farther on the tool's side, or 2 radii straight on."},
    {C::comp_turn_open, "Behind {corner_arc} a block has to move before a stop, and before four do not (its own counts): move those, or leave it out.", nullptr},
    {C::comp_turn_inside, "An arc by {corner_turn} goes round an outer corner with the words of the block behind it. Give it those words, or leave it out.", nullptr},
    {C::contour_too_long, "The contour is longer than its check can hold: cancel compensation earlier ({comp_off}), or allow more contour_blocks.", nullptr},
    {C::corner_option, "A corner ({comma}{chamfer} {comma}{rounding}) is not possible in this mode. Leave it out, or program it as a block of its own.", nullptr},
    {C::corner_arc, "A corner ({comma}{chamfer} {comma}{rounding}) lies between two lines; the block before or behind it is an arc. Program the corner as a block of its own.", nullptr},
    {C::corner_no_move, "The block behind a corner ({comma}{chamfer} {comma}{rounding}) must be a straight cut. Move what stands between in front of the corner.", nullptr},
    {C::corner_short, "The block is shorter than its corner {comma}{word}. Make the corner smaller.",
     "The block is shorter than its corner ({comma}{chamfer} {comma}{rounding}). Make the corner smaller."},
    {C::corner_reversal, "No rounding fits here: the block behind it goes straight back. Leave {comma}{rounding} out.", nullptr},
    {C::corner_next_short, "The block is shorter than the corner {comma}{word} at its start. Make that corner smaller.",
     "The block is shorter than the corner ({comma}{chamfer} {comma}{rounding}) at its start. Make that corner smaller."},
    {C::corner_motion, "A corner, programmed or of radius compensation, lies between two cuts. Program {linear} first.", nullptr},
    {C::pre_read, "Too many statements behind a block with ,{chamfer} ,{rounding} or radius compensation: calculate in front of it.", nullptr},
    {C::geometric_option, "A line by its angle ({line_angle} or ,{angle}) is not possible here: the letter has another meaning, or a mode bars it. Program both ends.", nullptr},
    {C::geometric_arc_option, "An arc that touches the block before or behind it is not possible in this mode. Program the end of each block.", nullptr},
    {C::geometric_circle_option, "A circle that meets the block before or behind it is not possible in this mode. Program the end of each block.", nullptr},
    {C::geometric_parallel, "The two lines run within one degree of each other: they have no corner. Check the angles.", nullptr},
    {C::geometric_incremental, "The end of the second block of a pair has to be absolute. Program {absolute}.", nullptr},
    {C::geometric_no_line, "Behind a block without an end the block that meets it must move: a line ({linear}) or an arc.", nullptr},
    {C::geometric_address, "{word}: 0 or 1 chooses one of the two places in which the blocks meet.", "0 or 1 chooses one of the two places in which the blocks meet.", nullptr, of_meeting_choice},
    {C::geometric_address, "A line at this angle does not come to {word}. Give the other coordinate of its end in place of it.", "A line at this angle does not come to the coordinate. Give the other one in place of it.", nullptr, of_coordinate},
    {C::geometric_address, "The words do not fit a line by its angle, or two blocks that meet. Give the second its whole end, a line its A, and no other.", nullptr},
    {C::geometric_plane, "The plane cannot change between a block without an end and the one that meets it. Select it in front of both.", nullptr},
    {C::geometric_contact, "The two blocks do not meet: check the centre, the radius, the angle and the ends.", nullptr},
    {C::space_compensation, "Three-dimensional radius compensation ({vector_x} {vector_y} {vector_z} together) starts from {rapid} or {linear}, in no other mode.", nullptr},
    {C::tool_axis_pair, "A length along the tool axis needs the rotary axis {turn_z} and one of {turn_x} and {turn_y}.", nullptr},
    {C::tool_axis_code, "{word}: no corner is cut where a rotary axis moves in one of the two blocks: it turns the tool. Turn it elsewhere.",
     "This is not possible while the length is compensated along the tool axis. Cancel it first ({length_off}).",
     "{word} is not possible while the length is compensated along the tool axis. Cancel it first ({length_off})."},
    {C::space_conversion_block, "{word} cannot stand in one block with a length along the tool axis.", "This cannot stand in one block with a length along the tool axis."},
    {C::outside_compensation, "{word} acts in radius compensation. Program {comp_left} or {comp_right} first.",
     "This acts in radius compensation. Program {comp_left} or {comp_right} first."},
    {C::second_aux, "The word {word} is not the address of the second auxiliary function.",
     "The address of the second auxiliary function is another one."},
    {C::thread_lead, "The thread lead {word} cannot be cut.", "The thread lead cannot be cut."},
    {C::mill_code, "{word} is not possible during cylindrical or polar coordinate interpolation.",
     "This is not possible during cylindrical or polar coordinate interpolation."},
    {C::mill_axis, "{word}: the axis cannot take part in cylindrical or polar coordinate interpolation.",
     "An axis of cylindrical or polar coordinate interpolation does not exist or cannot take part in it."},
    {C::mill_modal,
     "{word} is not possible in the modes that are in force: plane, radius compensation, surface speed.",
     "The modes in force (plane, compensation, surface speed) do not suit cylindrical or polar interpolation."},
    {C::mill_state, "{word} is not possible in this state of cylindrical or polar coordinate interpolation.",
     "The path of cylindrical or polar coordinate interpolation cannot be followed here."},
    {C::polar_code, "{word} is not possible during polar coordinate interpolation.", "This is not possible during polar coordinate interpolation."},
    {C::polar_axis, "{word}: the axis cannot take part in polar coordinate interpolation.",
     "An axis of polar coordinate interpolation does not exist or cannot take part in it."},
    {C::polar_modal, "Polar coordinate interpolation does not end in radius compensation. Cancel it with {comp_off} first.", nullptr,
     "{word} does not end polar coordinate interpolation in radius compensation. Cancel it with {comp_off} first.", of<Function::polar_off>},
    {C::polar_modal, "{word} is not possible with polar coordinate interpolation: plane, radius compensation, surface speed.",
     "The modes in force (plane, compensation, surface speed) do not suit polar coordinate interpolation."},
    {C::polar_state, "{word} is not possible in this state of polar coordinate interpolation.",
     "The path of polar coordinate interpolation cannot be followed here."},
    {C::space_arc_blocks, "An arc in space needs two blocks: the point on the way and the end point.",
     nullptr},
    {C::space_arc_mode, "{word} and the arc in space ({space_arc_first}, {space_arc_second}) exclude each other.",
     "The arc in space ({space_arc_first}, {space_arc_second}) is not possible in the modes that are in force."},
    {C::exponential_mode, "The exponential curve is not possible in the modes that are in force.", nullptr},
    {C::exponential_axes,
     "The parameters name no linear and rotary axis for the exponential curve, or it does not reach the end "
     "point.",
     nullptr},
    {C::nurbs_knot, "The knot {word} is smaller than the one before.",
     "A knot is smaller than the one before."},
    {C::nurbs_start, "The first control point is not where the axes are.", nullptr},
    {C::displaced, "The axes are not where this curve begins: they were moved by hand. Start the program again.", nullptr},
    {C::space_conversion_code, "{word} and the conversion of coordinates in space exclude each other.",
     "This and the conversion of coordinates in space exclude each other."},
    {C::inverse_time_code, "{word} and inverse time feed ({inverse_time_feed}) exclude each other.",
     "This and inverse time feed ({inverse_time_feed}) exclude each other."},
    {C::circle_radius, "The radius of the circle, {word}, is not larger than the tool offset. Use a smaller tool or a larger radius.",
     "The circle has no radius. Program it in this block."},
    {C::arc_feed_zero, "{feed}0 is the rapid traverse rate, and an arc cannot be cut with it.", nullptr},
    {C::reference_compare, "{axis} is not at its reference position.", nullptr},
    {C::reference_check_m, "An M code cannot stand in a block with the reference position check {reference_check}.", nullptr},
    {C::start_return_m, "An M code cannot stand in a block with the start position return {start_return}.", nullptr},
    {C::measure_axis, "Tool length measurement ({measure_length}) needs exactly one axis.", nullptr},
    {C::measure_h, "{word} cannot stand in a block with tool length measurement ({measure_length}).",
     "{length_number} and {tool} cannot stand in a block with tool length measurement ({measure_length})."},
    {C::measure_no_length,
     "Tool length measurement ({measure_length}) needs a tool length offset of the axis. Program {length_plus} {length_number} before it.", nullptr},
    {C::measure_signal,
     "The signal of the sensor did not come within the measuring range about {value}.",
     "The signal of the sensor did not come within the measuring range."},
    {C::stroke_check, "The block starts or ends in the area that {stroke_check_on} prohibits.", nullptr},
    {C::stroke_area_unknown, "{stroke_check_on} is in force from the start of the program, and no area has been given yet. Program {stroke_check_on} with its area, or {stroke_check_off}.", nullptr},
    {C::not_accepted, "This stands in the block of the first move with {comp_left} or {comp_right}, and in no other.", nullptr,
     "{word} stands in the block of the first move with {comp_left} or {comp_right}, and in no other.", of<Function::comp_entry>},
    {C::not_accepted, "Machine coordinates are gone to by {rapid} or {linear}, in no other motion. Program one of them here.", nullptr,
     "{word} goes to machine coordinates by {rapid} or {linear}, in no other motion. Program one of them beside it.", of_machine_line},
    {C::not_accepted, "An arc that the program has turned or scaled has no place in machine coordinates.", nullptr,
     "{word} goes to machine coordinates, where an arc that the program has turned or scaled has no place.", of_machine_arc},
    {C::not_accepted, "The unit is chosen at the head of the program, in front of movements and F, and stays.", nullptr,
     "{word} is chosen at the head of the program, in front of movements and F: the unit stays.", of_unit},
    {C::not_accepted, "{word} is not accepted in the mode that is on.", "This is not accepted in the mode that is on."},
    {C::in_high_accuracy, "{word} is not possible between {high_accuracy} {accuracy_switch}1 and {high_accuracy} {accuracy_switch}0. Command {high_accuracy} {accuracy_switch}0 first.",
     "This is not possible between {high_accuracy} {accuracy_switch}1 and {high_accuracy} {accuracy_switch}0. Command {high_accuracy} {accuracy_switch}0 first."},
    {C::high_speed_3,
     "High-speed machining mode III ({high_speed} {speed_mode}3) is not fitted. {speed_mode}0 ends the modes, {speed_mode}1 and {speed_mode}2 are I and II.", nullptr},
    // offsets
    {C::data_input_kind, "{data_input} does not know {input_kind}{value}.", "{data_input} has no {input_kind}, or one that it does not know."},
    {C::data_input_number, "{data_input}: there is no data set {input_number}{value}.",
     "{data_input}: the number {input_number} of the data set is missing or wrong."},
    {C::local_in_extended,
     "{local_system} is not possible while an extended workpiece coordinate system ({extended_system}) is selected.", nullptr},
    // programs and macros
    {C::program_missing, "The program {program_number}{value} is not in the memory.",
     "The program called is not in the memory."},
    {C::sequence_missing, "There is no block {sequence_number}{value} in this program.",
     "The block number to go to is not in this program."},
    {C::nesting, "Sub programs call each other more deeply than the control can follow.", nullptr},
    {C::macro_nesting, "Macros call each other more deeply than the control can follow.", nullptr},
    {C::no_macro, "User macros are not fitted.", nullptr},
    {C::macro_and_words, "A macro statement and ordinary words cannot stand in one block.", nullptr},
    {C::macro_argument, "The macro call has more sets of {vector_x} {vector_y} {vector_z} arguments than a macro can take.", nullptr},
    {C::cancel_without_call, "{macro_modal_off} has no {macro_modal} to cancel.", nullptr},
    {C::user_alarm, "The program has raised alarm {value} itself ({alarm_variable}).",
     "The program has raised an alarm itself ({alarm_variable})."},
    {C::bracket_nesting, "Brackets [ ] are nested too deeply.", nullptr},
    {C::bracket_pair, "The block has not as many [ as ].", nullptr},
    {C::calculation,
     "{function} has no result for {value}.",
     "The formula is not written correctly: an operand, an operator or a bracket is missing or stands in the "
     "wrong place."},
    {C::division_by_zero, "{function} {value}: the formula divides by zero.", "The formula divides by zero."},
    {C::if_statement, "The IF statement is not written correctly: IF [condition] GOTO number.", nullptr},
    {C::while_statement,
     "The WHILE statement is not written correctly: WHILE [condition] DO number ... END number.", nullptr},
    {C::name_statement, "The SETVN statement is not written correctly.", nullptr},
    {C::loop_nesting, "WHILE or DO loops are nested too deeply.", nullptr},
    {C::jump_on_tape, "A program that is read from a tape cannot jump: no WHILE, no GOTO.", nullptr},
    {C::loop_pair, "DO{value} and END{value} do not match.", "A DO has no END, or an END has no DO."},
    {C::address_missing, "The call needs the word {word}.", "The call needs a word that is not there."},
    {C::variable_number, "There is no variable #{value}.", "There is no variable with this number."},
    {C::no_equals, "A variable is named without '=' and a value.", nullptr},
    {C::variable_use, "Variable #{value} cannot be used here.", "This variable cannot be used here."},
    {C::variable_name, "The name of the variable is not correct.", nullptr},
    {C::variable_name_twice, "Another variable has the name that #{value} is to have.", "Another variable has this name."},
    {C::control_structure,
     "Control structures and sub programs (O words) are not built. Write the blocks out, or let the CAM system do so.",
     nullptr},
    {C::name_without_value, "No value has been given to the named parameter before this block.", nullptr},
    {C::too_many_names, "The program has more named parameters than there is room for ({value}).", "The program has more named parameters than there is room for."},
    {C::block_skip, "A block skip stands at the head of its block, as / or with the number of a switch, /1 to /9.", nullptr},
    {C::sub_without_return, "The text of the sub program ends without {word}.", "The text of the sub program ends without its return."},
    {C::call_in_mdi, "Blocks of MDI call no sub program. Put {word} into a program.", "Blocks of MDI call no sub program."},
    {C::probe_no_contact, "The probe has touched nothing up to the end of the move.", nullptr, "The signal of the probe has not changed up to the end of {word}."},
    {C::probe_contact, "The probe touches where the move begins: draw it back first.", nullptr, "{word}: where the move begins the signal of the probe is already as at its end."},
    {C::two_words, "{word} and another word of the block exclude each other.", "Two words of the block exclude each other.", "{word} takes one of its two words, not both."},
    {C::level_below_bottom, "{cycle_level} must be above the bottom.", nullptr},
    {C::cavity_size, "The cavity is smaller than its cutter: {word}.", "The cavity is smaller than its cutter."},
    {C::cavity_corner, "Corners have a radius from that of the cutter to half of the shorter side: {word} is none.", "The corners of the cavity have no such radius."},
    {C::cavity_step, "The rings would be farther from each other than the cutter is wide: make {cavity_step} smaller.", nullptr},
    {C::head_silent, "The stitching head gives no answer: its stitch is not done (PPE), or the next place may not come (NPFIN).", nullptr},
    {C::print_port, "Nothing can be printed: POPEN has not been executed.", nullptr},
    {C::call_in_cycle, "A macro cannot be called by {word} during a fixed cycle.",
     "A macro cannot be called by a code during a fixed cycle."},
    {C::parameter_input,
     "Parameter input ({data_input} {input_kind}70 ... {data_input_end}): {word} is not possible, or there is no such parameter or value.",
     "Parameter input: {data_input} {input_kind}70 and {data_input_end} stand alone, between them only blocks with {parameter_number} and {parameter_bit}, {parameter_data} or <text>."},
    {C::program_edited, "The program that begins here is being edited: start it again when that is done.", nullptr},
    {C::rotation_in_figure, "{word} cannot be used while a program is called with rotation ({call_sub} {vector_x} {vector_y} {vector_z}).",
     "Rotation cannot be used while a program is called with rotation ({call_sub} {vector_x} {vector_y} {vector_z})."},
    {C::offset_in_figure, "{word} cannot be used while coordinates are rotated ({rotation_on}) or a program is called with rotation ({call_sub} {vector_x} {vector_y} {vector_z}).",
     "A position offset cannot be used while coordinates or a program are rotated."},
    {C::offset_arc, "{word}: where the start of the arc is offset, program it in {incremental}; 1/4, 1/2 or 3/4 of a circle from axis to axis.",
     "A position offset takes 1/4, 1/2 or 3/4 of a circle from axis to axis.", nullptr, of<Function::absolute>},
    {C::offset_arc, "{word}: the radius of the arc has to be larger than the amount by which the position offset makes it smaller.",
     "A position offset takes 1/4, 1/2 or 3/4 of a circle from axis to axis.",
     "{word} takes 1/4, 1/2 or 3/4 of a circle from axis to axis: {offset_longer} and {offset_shorter} the quarters, the other two the half."},
    {C::machine_in_figure, "{word} goes to machine coordinates: axes of the plane cannot do that while a program is rotated ({call_sub} {vector_x} {vector_y} {vector_z}).",
     "Axes of the plane cannot go to machine coordinates while a program is rotated ({call_sub} {vector_x} {vector_y} {vector_z})."},
    {C::surface_axis, "There is no axis {value} for constant surface speed.",
     "There is no such axis for constant surface speed."},
    {C::surface_speed, "Constant surface speed needs a speed: {spindle_speed} with a value greater than 0.", nullptr},
    {C::no_such_data, "There is no parameter, part system, axis or device {value} to read.",
     "The data that is to be read does not exist."},
    {C::read_failed, "The program could not be read any further.", nullptr},
    {C::program_changed, "The file of the program has changed since it was selected: reset, and select it again.", nullptr},
    {C::vendor_function, "The machine's own function {word} could not be carried out.", "A function of the machine's own could not be carried out."},
    {C::tap_no_speed, "A tap needs the spindle speed {spindle_speed}; one that goes with the spindle has it in the block of its code.", nullptr},
    {C::tap_no_pitch, "A tap that goes with the spindle needs its lead {word}, in mm or inch per revolution.", "A tap that goes with the spindle needs its lead, in mm or inch per revolution."},
    {C::tap_pitch, "{word} is no lead that can be tapped.", "The lead of the tap is out of range."},
    {C::tap_speed_word, "{word} is not possible while a tap that goes with the spindle is in force. Cancel it with {cycle_off}, or repeat its code.",
     "The spindle speed cannot be commanded while a tap that goes with the spindle is in force."},
    {C::restart_void, "The program, or what it goes by, has changed since the place was looked for, or it is not found yet. Look again.", nullptr},
    {C::tap_apart, "The spindle does not turn as the tap commands it. Behind a reset the tap can be drawn out.", nullptr},
    {C::encoder_jumps, "The angle that the encoder of the spindle shows has jumped. The place of the tap in its thread is no longer known.", nullptr},
    {C::life_full, "No more tools can be registered for the management of their lives.", nullptr},
    {C::life_group, "{word}: no tools are registered for this group of tool life management, or they are registered twice.",
     "No tools are registered for this group of tool life management, or they are registered twice."},
    {C::no_holes, "{word}: the pattern has no holes.", "The pattern needs the number of its holes."},
    {C::hole_angle_zero, "The holes of an arc need an angle from one to the next that is not 0.", nullptr},
    {C::drilling_axis_changed, "{word}: another axis than the one in force is to drill. End the cycle with {cycle_off} before.",
     "Another axis is to drill. End the cycle with {cycle_off} before."},
    {C::internal,
     "The control has met a state that should not exist. Please report the program that led to it.", nullptr},
};

/// The word in braces at `at` is `name`.
constexpr bool is_key(const char* at, const char* name) {
  for (++at; *name != 0; ++at, ++name)
    if (*at != *name) return false;
  return *at == '}';
}

template <class Row, unsigned kRows>
constexpr const Row* named(const Row (&rows)[kRows], const char* at) {
  for (const Row& row : rows)
    if (is_key(at, row.name)) return &row;
  return nullptr;
}

constexpr char kAlarmVariable[] = "alarm_variable";

constexpr bool names_word_or_value(const char* sentence) {
  for (; *sentence != 0; ++sentence)
    if (*sentence == '{' && (is_key(sentence, "word") || is_key(sentence, "value") || is_key(sentence, "function"))) return true;
  return false;
}

constexpr bool every_row_has_a_sentence_for_a_bare_fault() {
  for (const Sentence& row : kSentences) {
    if (names_word_or_value(row.plain != nullptr ? row.plain : row.full)) return false;
  }
  return true;
}
static_assert(every_row_has_a_sentence_for_a_bare_fault());

constexpr bool all_keys_known(const char* sentence) {
  for (; sentence != nullptr && *sentence != 0; ++sentence) {
    if (*sentence != '{') continue;
    bool known = is_key(sentence, kAlarmVariable) || named(kNamedCodes, sentence) != nullptr || named(kNamedMisc, sentence) != nullptr ||
                 named(kNamedWords, sentence) != nullptr;
    for (const char* name : {"word", "axis", "value", "function", "comma"}) known = known || is_key(sentence, name);
    if (!known) return false;
  }
  return true;
}
constexpr bool every_key_is_known() {
  for (const Sentence& row : kSentences)
    if (!all_keys_known(row.full) || !all_keys_known(row.plain) || !all_keys_known(row.code)) return false;
  return true;
}
static_assert(every_key_is_known());

bool about_code(const Dialect& dialect, const Fault& fault) {
  return dialect.addresses.is(fault.letter, Role::code) || dialect.addresses.is(fault.letter, Role::misc_code);
}

// The fault has a letter that can be shown. Bytes outside printable ASCII are not shown: they may be a part of a character.
bool has_letter(const Dialect& dialect, const Fault& fault) {
  return (fault.letter > ' ' && fault.letter <= '~') || dialect.addresses.name(word_named(fault.letter)) != nullptr;
}

// Writes the offending word: "G54.1", "X12.5", "P" if it has no value. A sign that is no address is put in quotes.
void put_word(TextWriter& out, const Dialect& dialect, const Fault& fault) {
  char code[24];
  if (about_code(dialect, fault) && fault.has_value && fault.value >= 0 && fault.value < 1e6) {
    // The value of no_function is the code of a table row, which is times 10 for a G code. In all other faults it is the number as programmed.
    const bool misc = dialect.addresses.is(fault.letter, Role::misc_code);
    const bool times_ten = misc || fault.condition == C::no_function;
    const double number = times_ten ? fault.value : fault.value * 10;
    if (std::fabs(number - std::nearbyint(number)) < 1e-6) {  // G0.15 and M3.5 cannot be codes and are shown as they were programmed
      if (misc) m_code_text(dialect, static_cast<unsigned>(std::lround(number)), code, sizeof code);
      else g_code_text(dialect, static_cast<int>(std::lround(number)), code, sizeof code);
      out.put(code);
      return;
    }
  }
  if (fault.letter == '#' && fault.condition != C::illegal_character) {
    // The value is not shown: it may be the number of the variable or what was written into it.
    out.put(out.used() == 0 ? "The variable" : "the variable");
    return;
  }
  if (const char* const name = dialect.addresses.name(word_named(fault.letter)); name != nullptr) {
    out.put(name);
    if (fault.has_value) out.put(' ').put_number(fault.value);
    return;
  }
  const bool is_address = fault.letter >= 'A' && fault.letter <= 'Z';
  if (!is_address) out.put('\'');
  out.put(fault.letter);
  if (!is_address) out.put('\'');
  if (!is_address || !fault.has_value) return;
  if (std::fabs(fault.value) >= TextWriter::kVeryLarge) out.put(" (a very large number)");
  else out.put_number(fault.value);
}

// The fault carries everything that a sentence names. {axis} is not checked: there is also a text for an axis that is not known.
bool complete(const Dialect& dialect, const char* sentence, const Fault& fault) {
  for (; *sentence != 0; ++sentence) {
    if (*sentence != '{') continue;
    if (is_key(sentence, "word") && !has_letter(dialect, fault)) return false;
    if (is_key(sentence, "function") && fault.function == nullptr) return false;
    if (is_key(sentence, "value") && (!fault.has_value || about_code(dialect, fault))) return false;
  }
  return true;
}

/// What the row of a code that is not there says of it, nullptr = nothing.
const char* why_missing(const Dialect& dialect, const Fault& fault) {
  if (fault.condition != C::no_function || !about_code(dialect, fault) || !fault.has_value || !(fault.value >= 0 && fault.value < 1e6)) return nullptr;
  const long code = std::lround(fault.value);
  if (dialect.addresses.is(fault.letter, Role::misc_code)) {
    const MiscRow* const row = find_misc(dialect, static_cast<unsigned>(code));
    return row != nullptr ? row->part : nullptr;  // what is not built of it begins with its words ("P0: ...")
  }
  const FunctionRow* const row = find_function(dialect, static_cast<int>(code));
  return row != nullptr && row->missing != nullptr ? row->part : nullptr;
}

const char* choose(const Dialect& dialect, const Fault& fault) {
  for (const Sentence& row : kSentences) {
    if (row.condition != fault.condition || (row.only != nullptr && !row.only(dialect, fault))) continue;
    const char* sentence = row.code != nullptr && about_code(dialect, fault) ? row.code : row.full;
    return row.plain == nullptr || complete(dialect, sentence, fault) ? sentence : row.plain;
  }
  return "";
}

// Writes the family's code for a function. A family without such a code does not raise an alarm that names it, but the sentence has to be
// readable all the same.
void put_code(TextWriter& out, const Dialect& dialect, Function function) {
  char code[24];
  const FunctionRow* const row = find_function(dialect, function);
  if (row == nullptr) {
    out.put("its code");
    return;
  }
  g_code_text(dialect, row->code, code, sizeof code);
  out.put(code);
}

void put_misc(TextWriter& out, const Dialect& dialect, MiscFunction function) {
  char code[24];
  bool any = false;
  const auto put = [&](unsigned number) {
    m_code_text(dialect, number, code, sizeof code);
    out.put(any ? " or " : "").put(code);
    any = true;
  };
  for (const MiscRow& row : dialect.misc)
    if (row.function == function) put(row.code);
  for (const OutputRow& row : dialect.outputs)
    if (row.function == function) put(row.code);
  if (!any) out.put("its code");
}

/// Behind the key at `at` stands the value of the fault.
bool a_number_follows(const char* at) {
  while (*at != '}') ++at;
  return at[1] == '{' && is_key(at + 1, "value");
}

/// Writes the word with a meaning. A name is kept apart from a number behind it; between a letter and its number nothing stands.
void put_letter(TextWriter& out, const Dialect& dialect, Role role, bool number_follows) {
  const char letter = dialect.addresses.letter(role);
  if (const char* const name = dialect.addresses.name(dialect.addresses.word(role)); name != nullptr) out.put(name).put(number_follows ? " " : "");
  else if (letter != 0) out.put(letter);
  else out.put("its word");
}

void put_alarm_variable(TextWriter& out, const Dialect& dialect) {
  for (const VariableRow& row : dialect.variables->rows) {
    if (row.what != SystemVariable::alarm) continue;
    out.put('#').put_integer(row.first);
    return;
  }
  out.put("its variable");
}

// Writes the axis, with a capital letter if the sentence begins with it.
void put_axis(TextWriter& out, const char* axis_name) {
  const bool known = axis_name != nullptr && axis_name[0] != 0, first = out.used() == 0;
  out.put(first ? (known ? "Axis" : "An axis") : (known ? "axis" : "axis of this name"));
  if (known) out.put(' ').put(axis_name);
}

/// The words of a corner stand behind a comma. Otherwise a code makes them those of a corner (Series 8 G10).
bool corners_by_comma(const Dialect& dialect) { return find_function(dialect, Function::corner_behind) == nullptr; }

void put_key(TextWriter& out, const char* at, const Dialect& dialect, const Fault& fault, const char* axis_name) {
  if (const NamedCode* const code = named(kNamedCodes, at); code != nullptr) put_code(out, dialect, code->function);
  else if (const NamedMisc* const misc = named(kNamedMisc, at); misc != nullptr) put_misc(out, dialect, misc->function);
  else if (const NamedWord* const word = named(kNamedWords, at); word != nullptr) put_letter(out, dialect, word->role, a_number_follows(at));
  else if (is_key(at, kAlarmVariable)) put_alarm_variable(out, dialect);
  else if (is_key(at, "word")) put_word(out, dialect, fault);
  else if (is_key(at, "comma")) out.put(corners_by_comma(dialect) ? "," : "");
  else if (is_key(at, "function")) out.put(fault.function);
  else if (is_key(at, "value")) out.put_number(fault.value);
  else put_axis(out, axis_name);
}

}  // namespace

void alarm_detail(const Dialect& dialect, const Fault& fault, const char* axis_name, char* text, size_t size) {
  TextWriter out(text, size);
  if (const char* const why = why_missing(dialect, fault)) {
    put_word(out, dialect, fault);
    out.put(" ").put(why).put(".");
    return;
  }
  for (const char* at = choose(dialect, fault); *at != 0; ++at) {
    if (*at != '{') {
      out.put(*at);
      continue;
    }
    put_key(out, at, dialect, fault, axis_name);
    while (*at != '}') ++at;
  }
}

}  // namespace nc
