// SPDX-License-Identifier: Apache-2.0
// Rules in which the families of controllers differ, by subject. A family states each of them in dialect/<family>/rules.hpp; the functions of
// interpret/ ask for the rule and never for the family. Each comment says what happens if the rule is true, and cites the manuals that have
// it. What follows "Otherwise", or the name of another manual, is what happens if it is false. A new family has to think of every line; a rule that one
// family alone has is false where a family says nothing.
#pragma once

#include <cstdint>

#include "dialect/ranges.hpp"

namespace nc {

struct AccuracyParameters;
struct AccuracyMove;
struct AccuracyLimits;
struct AccuracyJoint;
struct FilterParameters;
struct FilteredMove;
struct FilterTimes;

/// Values of words.
struct NumberRules {
  /// F without a point counts in units of 0.001 mm/min or 0.0001 inch/min, unless a setting has it read in whole units (DGSHAPE 3).
  /// Otherwise F1 is 1.000, whatever the settings for positions are (M700 7.2).
  bool undotted_feed_in_least_unit;
  /// A position without a point may have all the digits of its word (DGSHAPE 2-1 "range 1"). Otherwise it must be in the range of coordinates
  /// in mm, inch or deg, as any other position (M700 2.1, 5.3).
  bool undotted_range_is_digits;
  /// Largest F with a point and largest F without a point, in mm/min and in inch/min (M700 5.3; DGSHAPE 2-1 "range 1").
  double largest_feed_mm, largest_feed_inch;
  double largest_undotted_feed_mm, largest_undotted_feed_inch;
  /// How many setting units there are in a micrometre, by the value of the parameter for this unit; 0 means that the parameter is not set
  /// (M700 2.1). DGSHAPE 2-1: the unit is a micrometre.
  double (*units_per_micrometre)(double parameter);
  /// A length that a formula gives is rounded to the least unit (HX 14.2.4; WordFormat::round_keeps_unit for ROUND). Else it is what has been calculated (M700 13.5.4; DGSHAPE has no
  /// formulas).
  bool rounds_formulas;
  /// A position that a program reads is what has been calculated (RS-274/NGC 3.3: numbers are not counted in a unit). Otherwise it is rounded to the setting
  /// unit (M700 2.1).
  bool positions_as_calculated = false;
  /// The number of a variable that is calculated may be so far from a whole one, else it is a fault (RS-274/NGC 3.3.2.1: 0.0001). Below 0: it is rounded
  /// (M700 13.5.4).
  double variable_numbers_within = -1;
};

/// What may stand in a block.
struct BlockRules {
  /// For each axis word the absolute or incremental code in front of it in the block counts (M700 5.1). Otherwise the last such code of the
  /// block counts for all its words (DGSHAPE 1-2: of two codes of one group the last one takes effect).
  bool distance_by_word;
  /// A decimal point is a fault in words whose value is a whole number: codes, spindle speeds, numbers of tools and offsets, counts
  /// (DGSHAPE 2). Otherwise the decimals are cut off (M700 5.3).
  bool whole_words_refuse_point;
  /// In the same words, but speeds where they are real numbers, a value farther than this from a whole number is a fault, a nearer one is that number
  /// (HX 2.2.2 "format of data": 0; RS-274/NGC 3.3.2.1: 0.0001). Below 0: the decimals are cut off (M700 5.3).
  double whole_words_within = -1;
  /// M codes that stop or end the program have to stand alone in their block (DGSHAPE 2). M700 9.1 allows other words beside them.
  bool stops_stand_alone;
  /// A dwell has to stand alone in its block (DGSHAPE G04). M700 8.1 allows other words beside it.
  bool dwell_stands_alone;
  /// It is a fault if a letter other than those of codes stands twice in a block, or if a block has two codes of one mode (RS-274/NGC 3.3.1,
  /// 3.4). Otherwise the last one counts (M700 3.7; DGSHAPE 1-2).
  bool words_stand_once;
  /// If a block sets several variables, all values are calculated before the first variable is set: in #1=2 #2=#1 variable #2 gets the value
  /// that #1 had before the block (RS-274/NGC 3.3.2.2). Otherwise they are set one after the other (M700 13.5.4).
  bool assigns_at_once;
  /// A word without a number is 0, in any block (Series 8 G01, G41 print G00XY). Otherwise it is a fault, but for the blocks that M700 14.10, 6.9 print.
  bool bare_word_is_zero = false;
  /// A word that no code of the block takes is a fault (LinuxCNC, its errors "D word with no G41", "L word with no canned cycle" and their like; the formats
  /// of DGSHAPE, HX and Series 8 list the words of each code). Otherwise it
  /// is passed over.
  bool unused_words_are_faults = false;
  /// A block has either a chamfer or a rounding (HX 4.3.1, 4.3.2: each format has one of them). Otherwise the later word counts (M700 13.7.1 (3)).
  bool corner_words_exclude = false;
  /// The unit is that of the whole program: a code that changes it behind an axis word or an F is a fault (DGSHAPE 2-2, G20). Otherwise it may change
  /// in any block.
  bool unit_is_of_program = false;
  /// A code that changes the unit leaves the feed in force as fast as it was (LinuxCNC G20: F is taken in the unit of its block). Otherwise the number stays, and
  /// counts in the new unit.
  bool unit_keeps_speed = false;
};

/// M, T and the second auxiliary function.
struct AuxiliaryRules {
  /// Most M codes of a block that are executed; if there are more, it is the last ones (M700 9.1: four). DGSHAPE 2 names no limit: all that
  /// fit in a block are executed.
  unsigned most_m_codes;
  /// A tool number and the code of the tool change have to stand together, and a block may have only one of each (DGSHAPE M06). In M700 11
  /// the tool number stands alone.
  bool tool_change_is_pair;
  /// The family's tables have every M code there is, and any other one is a fault (DGSHAPE 2-7). Otherwise a code that they do not have goes out to the machine.
  bool codes_are_listed = false;
  /// A change to the tool that the change before has brought is passed over (DGSHAPE M06). Otherwise it goes out (M700 11).
  bool skips_tool_held = false;
};

struct SpindleRules {
  /// The speed in r/min that a value of S asks for. It is the value itself (M700 10.1, 10.2), or a value below 100 is the number of a step in
  /// a series of speeds (DGSHAPE 2, S).
  double (*speed_of_word)(uint32_t value);
  /// S and Q beside the code of coordinate system setting are limits of the spindle speed (M700 10.4). Otherwise an S there is a speed
  /// (DGSHAPE G92).
  bool limits_by_coordinate_setting;
  /// The code for start is not put out while the spindle turns, nor the code for stop while it stands (DGSHAPE 2). M700 10 puts out every M
  /// code.
  bool skips_repeated_codes;
  /// R beside the code of coordinate system setting is the radius at the present position, and the words of the axis are diameters (Series 8 G92).
  /// Otherwise the coordinate of the axis is the radius (M700 10.3).
  bool radius_by_coordinate_setting = false;
  /// A word beside the code of constant surface speed is the highest speed (LinuxCNC G96 D). Otherwise coordinate system setting gives it (M700 10.4).
  bool limit_beside_surface = false;
  /// S is a real number, in r/min or as a surface speed (RS-274/NGC 3.7.2). Otherwise it is a whole one (M700 10.1).
  bool speed_is_real = false;
};

struct FeedRules {
  /// In inch mode a degree counts as a tenth of an inch in F, so that it is in units of 10 deg/min where only rotary axes move (M700 3.2 note 6).
  /// Otherwise it is converted with 25.4 as every F in inch mode: DGSHAPE has no such rule.
  bool inch_is_ten_degrees;
  /// F of a line or a curve is the speed of linear and rotary axes together, where a degree counts like a millimetre (M700 7.6). Otherwise it is the
  /// speed of the linear axes (DGSHAPE, "F").
  bool degree_counts_as_millimetre;
  /// F in inverse-time feed is 1 divided by the minutes that the whole block takes, also for an arc (RS-274/NGC 3.5.19). Otherwise F of an
  /// arc is the speed divided by the radius (M700 7.5).
  bool inverse_time_is_of_block;
  /// F of a turning axis is the speed of the tool on the circle about the axis on which it stands as the block begins, in mm/min; where Z stands at its
  /// reference position the axis turns as fast as it can (DGSHAPE 1-4, 2-5). Otherwise F is in deg/min where only turning axes move (M700 7.6).
  bool rotary_by_radius = false;
  /// F in inverse-time feed holds until the next one (Series 8 G93 prints it in a block of its own). Otherwise each cut has its own (M700 7.5).
  bool inverse_time_is_modal = false;
  /// The code that ends inverse-time feed needs an F in its block (M700 7.5, precaution (4)). Otherwise it may stand alone, and the next cut needs one
  /// (Series 8 prints G95 in a block of its own; RS-274/NGC 3.5.19).
  bool end_of_inverse_time_needs_feed = false;
  /// A line that leads nowhere needs no F (the program of HX 4.7 begins with one). Otherwise one has to be in force where the words of a cut stand (M700 3.2).
  bool no_way_needs_none = false;
};

/// Skip: a straight line at feed that a signal ends.
struct SkipRules {
  /// The move has the F in force, and an F in its block stays in force (LinuxCNC G38). Otherwise an F in the block counts for this move only,
  /// and without one a parameter gives the feed (M700 15.2).
  bool feed_is_modal;
  /// The place where a measurement of a tool has ended is that of the last skip, too (HX 4.10). Otherwise only a skip stores one (M700 15.1).
  bool measurement_stores = false;
  /// A measurement corrects the offset itself, which is one value (HX 13.1.3, 14.2.3 have no wear beside it). Otherwise one that is not 0 is corrected in its wear,
  /// where the tool memory has wear (M700 15.1).
  bool measurement_sets_length = false;
  /// A measurement without its distances or without a feed is a fault (HX 4.10 has parameters for them and no values without). Otherwise it goes to the measuring
  /// position in rapid traverse, and the least feed is taken (M700 15.1 (3), (9)).
  bool measurement_needs_values = false;
  /// A signal that is where the move begins as it is to be at its end is a fault, and so is a move without a way (LinuxCNC G38). Otherwise there is nothing
  /// to move (M700 15.2).
  bool change_required = false;
  /// The place of the last skip of an axis that the skip does not move stays that of the skip which has moved it (M700 13.5.5 position information, example 2).
  /// Otherwise it is where the axis stands (HX 14.2.3 (7), LinuxCNC G38).
  bool keeps_axes_not_moved = false;
  /// Only a length that G43 has applied can be measured (M700 15.1 (4)). Otherwise one that G44 has applied, too: it is counted the other way (HX 4.10 names none).
  bool measurement_of_added_length = false;
};

struct ArcRules {
  /// A block with an arc may name rotary axes (M700 3.2 note 5, 6.3). DGSHAPE G02/G03: A cannot take part.
  bool takes_rotary_axes;
  /// In inch mode, in an arc of a linear and a rotary axis, a degree counts as a tenth of an inch (M700 3.2 note 5).
  bool degree_is_tenth_of_inch;
  /// P, the number of full turns, cannot stand beside R (M700 6.6). DGSHAPE G02/G03 does not say what happens to P then, so it is no fault
  /// there.
  bool turns_exclude_radius;
  /// An arc that is given by its radius and ends where it starts is a fault (RS-274/NGC 3.5.3.1). Otherwise its block makes no move (M700
  /// 6.5; DGSHAPE G02/G03).
  bool closed_by_radius_is_fault;
  /// P also counts the turn in which the end lies, so that an arc of less than a full turn has P1 (LinuxCNC G2). Otherwise P counts the full
  /// turns before that one (M700 6.6).
  bool turns_count_last;
  /// Without R and centre the radius is that of the last R (Series 8 G02). Otherwise a centre without words is the start (M700 6.4).
  bool radius_is_modal = false;
  /// A radius below half the chord counts as half the chord (Series 8 G02). Otherwise it is a fault (M700 6.5).
  bool short_radius_is_half_chord = false;
  /// The words of the centre have no sign; it lies where the arc stays within a quadrant about it, and there is no other arc (Series 8 G02). Otherwise
  /// they are increments with a sign (M700 6.4).
  bool centre_by_quadrant = false;
  /// Radius and centre in one block are a fault (Series 8 G02 names two ways to give an arc). Otherwise the radius counts (M700 6.5).
  bool radius_excludes_centre = false;
};

struct DwellRules {
  /// A dwell without a time does not wait, but the axes come to rest (M700 15.2 prints it behind a skip). Otherwise it is a fault (DGSHAPE
  /// G04).
  bool time_optional;
  /// In inch mode an X that stands in front of the code is read as a length, in a unit that is ten times finer, so that the time comes out
  /// ten times as long (M700 8.1 note 3). DGSHAPE G04 has no such rule.
  bool early_x_is_length;
  double longest_s;  ///< M700 8.1; DGSHAPE G04: 3600 s
  /// X is in seconds without a point, too (HX 5.4). Else it goes by the settings of numbers (M700 8.1; DGSHAPE 1-5).
  bool x_is_seconds;
  /// Axis words beside a dwell are a fault: the dwell takes no such words (RS-274/NGC 3.5.4). Otherwise they mean nothing there (M700 8.1).
  bool refuses_axes = false;
};

/// Compensation of the tool radius.
struct CompensationRules {
  /// XY is the only plane in which radius compensation works (DGSHAPE G40-G42). Otherwise it works in every plane (M700 12.4.1).
  bool xy_plane_only;
  /// The plane cannot be changed while compensation is on, nor directly behind its end (M700 App. 1 P112). Otherwise it is no fault to select
  /// the plane again (DGSHAPE G40-G42).
  bool plane_is_fixed;
  /// The code of its end acts at once: behind it the plane is free, also where the tool has not moved since, and in its block so are the workpiece coordinate
  /// systems (RS-274/NGC 3.5.10, 3.8: set behind it). Otherwise plane_is_fixed acts until a movement (M700 App. 1 P112), and the systems wait for the next block.
  bool end_is_at_once = false;
  /// The codes of workpiece coordinate systems, of coordinate system setting and of data setting are faults while compensation is on (DGSHAPE
  /// G40-G42). M700 12.4.4 allows them.
  bool bars_systems_and_data;
  /// Reference return is a fault while compensation is on (DGSHAPE G28). M700 12.4.4 allows it: the vector is cancelled at the intermediate
  /// point.
  bool bars_reference_return;
  /// Compensation may change from one side to the other without a cancel in between (M700 12.4.1). DGSHAPE G41/G42: "the
  /// direction cannot be changed".
  bool may_change_side;
  /// I J K beside the code of compensation are the direction of its vector (M700 12.4.3). DGSHAPE G41/G42 has no such words.
  bool vector_by_words;
  /// If an offset amount is changed while compensation is on, the new amount acts from the next command on (M700 12.1). Otherwise the amount
  /// at the time of the code stays (DGSHAPE "D": cancel first).
  bool takes_changed_amounts;
  /// The code of compensation in a block without a move does nothing yet; the next move leads to the contour, or away from it (LinuxCNC G40
  /// to G42; HX 13.2.2 (1); DGSHAPE G41: "actuated when a movement instruction is specified"). Otherwise the tool goes at once to the point beside the
  /// contour, or back from there (M700 12.4.2). A vector that the words of the block give is gone to at once (M700 12.4.3).
  bool code_alone_waits;
  /// The code without D, or with D0, takes the number of the tool in the spindle as the offset number (RS-274/NGC 3.5.10, LinuxCNC G41). Otherwise the last offset number stays (M700
  /// 12.4.1; DGSHAPE G41).
  bool number_is_that_of_tool;
  /// The code without D, where none has been commanded before, has an offset of 0 (HX 4.6, 15.4.2 print such programs). Otherwise it is a fault (M700 App. 1
  /// P170).
  bool number_may_be_missing = false;
  /// The first move begins with a line to the place beside its start, unless its block has the code of an entry (Series 8 G41, G43). Otherwise it leads
  /// from the place of the code to the place beside its end (M700 12.4.1).
  bool begins_beside_start = false;
  /// At an outer corner whose blocks enclose less than this the tool goes round on an arc, at any other one to the intersection (Series 8 G41); 0 =
  /// as M700 12.4.1 has it.
  double arc_below_deg = 0;
  /// In the mode the code of the other side may stand in the block of an arc (HX 13.2.2 (3): "N6 G41 G02 J-50.0"). Otherwise these codes and an arc
  /// do not go together (M700 App. 1 P151).
  bool side_changes_on_arc = false;
  /// The offset number holds until the next one, whatever block it stands in (M700 12.1; HX 13.1.1; Series 8 G41 prints it beside T). Otherwise it counts
  /// only beside the code of compensation (RS-274/NGC 3.5.10; DGSHAPE G41: "G41 D n").
  bool number_in_any_block = true;
  /// An inner corner of a degree or less has no intersection but two vectors at right angles (DGSHAPE G40 to G42, "Exceptions"; its figure is lost, FANUC has it
  /// so). Elsewhere an intersection that is not on the path is an alarm of the interference check.
  bool square_in_spike = false;
  /// Tool position offset stands neither in compensation nor in the block of a cycle (HX 12.2.2, 13.3). Otherwise a cycle is made without it, and in
  /// compensation it lengthens the programmed way (M700 12.6).
  bool bars_position_offset = false;
  /// Codes of position offset stand beside motions alone (HX 13.3 prints G01 G02 G03). Otherwise the last one of the codes that take the words of a block counts
  /// (M700 3.7).
  bool position_offset_is_of_motion = false;
  /// As H or D it means the offset that is registered with the tool in the spindle, where the lives of tools are managed; 0 = no number does. The manual
  /// of M700 has the management (10.15) and not the number, which is the practice of the field (docs/decisions.md).
  uint32_t number_of_managed_tool = 0;
  /// The place of the axes cannot be read while compensation is on (LinuxCNC #5420: "Cannot read current position with cutter radius compensation on").
  /// Otherwise it includes the radius (M700 13.5.5 (10.11)).
  bool bars_reading_position = false;
  /// The tool is not changed while compensation is on (LinuxCNC: "Cannot change tools with cutter radius compensation on"). Otherwise the code of the change
  /// goes out as any other.
  bool bars_tool_change = false;
};

/// Compensation of the tool length.
struct LengthRules {
  /// The axis words of the block choose the axis that is compensated (M700 12.2 (3)). Otherwise it is Z (DGSHAPE G43).
  bool axis_by_words;
  /// An H holds until the next one, whatever block it stands in (M700 12.1 (2), (3)). Otherwise it counts only beside the code that begins
  /// compensation (DGSHAPE G43: "G43 H n").
  bool number_in_any_block;
  /// Beside a code of tool position offset it is none of the length (M700 12.2 (2)(e), example 3). Otherwise it holds from such a block on, too.
  bool position_offset_has_number = false;
  /// The code without H takes the last offset number, even if that is 0 (M700 12.2 (2) (d), App. 1 P170). Otherwise a last number of 0 counts
  /// as none, which is a fault (DGSHAPE G43).
  bool zero_is_number;
  /// Beginning and end of compensation move the axis at once, also without a word for it (M700 12.2 (1), App. 2; DGSHAPE G43). Otherwise the next command of the
  /// axis moves it.
  bool moves_at_once;
  /// Beginning and end leave the axis where it is, but change its coordinate there; an incremental word counts from the new coordinate
  /// (RS-274/NGC 3.5.11). Otherwise the next command of the axis also makes up for the offset, even if it is incremental (M700 12.2).
  bool shifts_reading;
  /// A code of length compensation may stand beside an arc: it acts before the motion (LinuxCNC, order of execution). Otherwise it is a fault (M700 App. 2).
  bool stands_beside_arc = false;
  /// The code without H, or with H0, takes the number of the tool in the spindle as the offset number (LinuxCNC G43). Otherwise the last offset number stays (M700 12.2
  /// (2) (d)), or H is required (DGSHAPE G43).
  bool number_is_that_of_tool;
  /// The axis is the one that stands on the plane in force (HX 13.1.1). Else axis_by_words says (M700 12.2 (3); DGSHAPE G43).
  bool axis_on_plane;
};

/// What a cycle does beside a code of a motion in its block.
enum class CycleBeside : uint8_t {
  motion,      ///< nothing: the motion counts, in either order (M700 13.1.1 precaution (4))
  last,        ///< the later one of the two counts: a motion behind the cycle ends it (HX 12.2.1, Series 8 G80)
  cycle,       ///< it is made, and the motion only becomes modal: other groups do not end it (DGSHAPE 1-2, G80)
  fault        ///< the two are of one group, and a block has one code of a group (RS-274/NGC 3.4)
};

/// How long the hole data hold that a block with the code of a cycle gives.
enum class HoleData : uint8_t {
  of_mode,   ///< to the end of the mode, behind the codes of other cycles too (M700 13.1.1)
  of_code,   ///< to the next code of a cycle: without Z nothing is drilled, without R the initial level is taken, without P there is no dwell (DGSHAPE G80 to G89)
  of_cycle,  ///< to the code of another cycle (RS-274/NGC 3.5.16: a number stays when the same cycle is used again)
};

struct CycleRules {
  CycleBeside beside = CycleBeside::motion;
  /// XY is the only plane of cycles (DGSHAPE G80-G89). M700 13.1.1 allows every plane.
  bool xy_plane_only;
  /// Rotary axes may stand in a block with a hole (M700 13.1.1 precaution (6)). DGSHAPE G80-G89: A is a fault.
  bool takes_rotary_axes;
  /// A hole is a fault while the spindle does not turn (DGSHAPE G80-G89). M700 13.1.1 does not check it.
  bool needs_turning_spindle;
  /// As long as no block of the cycle has given a bottom, a block only positions and drills nothing (DGSHAPE G81). Otherwise the hole goes to
  /// R (M700 13.1.1).
  bool without_bottom_positions;
  /// If R and Z are incremental, R takes the sign of Z (M700 13.1.1 "Absolute/incremental"). Otherwise R keeps its own sign (DGSHAPE).
  bool r_takes_sign_of_z;
  /// Axes outside the plane go to the hole with the motion code that was in force before the cycle (M700 13.1.1 precaution (6), 13.1.2
  /// example 2). Otherwise they go in rapid traverse (DGSHAPE G81).
  bool others_keep_motion_mode;
  /// Distance from the last peck at which the next one begins, in mm (DGSHAPE G83: always 1 mm). 0 = parameters give it (M700 13.1.1).
  double fixed_clearance_mm;
  /// P is in seconds and may have a fraction (RS-274/NGC 3.5.16.2). Otherwise it is in whole milliseconds (M700 13.1.1; DGSHAPE G82).
  bool dwell_in_seconds;
  /// The first block of a cycle has to give the bottom and R (RS-274/NGC 3.5.16). Otherwise a missing R is the level of the axis before the
  /// cycle, and a missing bottom is R, unless without_bottom_positions is true (M700 13.1.1; DGSHAPE G81).
  bool begins_with_both_levels;
  /// If the drilling axis stands below R, it goes up to R before the others go to the hole (RS-274/NGC 3.5.16). Otherwise the others go first
  /// (M700 13.1.1; DGSHAPE G81).
  bool rises_before_positioning;
  double longest_dwell_ms;  ///< P (M700 13.1.1: eight digits; DGSHAPE: as of the dwell)
  /// Taps turn the spindle back in front of the dwell, bores let it turn again as before, and both want it turning (RS-274/NGC 3.5.16). Else
  /// the strokes are those of M700 13.1.1, and it turns forward behind a bore.
  bool keeps_spindle_direction = false;
  /// Each block drills along the axis of the plane in force (RS-274/NGC 3.5.16). Else the axis stays as long as the mode does (M700 13.1.1 note
  /// 2; DGSHAPE has one plane).
  bool axis_follows_plane = false;
  /// Holes end at R, and no code asks for the initial level (Series 8 G81). Otherwise a code says which (M700 13.1.1).
  bool ends_at_r = false;
  /// R and the bottom stay known when the mode ends (Series 8 G80). Otherwise they end with it (M700 13.1.1).
  bool levels_outlive_mode = false;
  /// The hand of a tap is the direction in which the spindle turns (Series 8 G84). Otherwise that of its code (M700 13.1.1).
  bool tap_follows_spindle = false;
  /// Each tap goes with the spindle, its lead has a word of its own, and it dwells by a P of its own block alone (Series 8 G84: K, and steps without a dwell). Otherwise
  /// F is a feed or the lead as the block says, and P that of any hole before (M700 13.1.1 (6)).
  bool tap_has_lead_word = false;
  /// The offset number of a block with a hole is that of the length of its tool (Series 8 G81). Otherwise it is that of radius compensation.
  bool takes_length_number = false;
  /// Q without I J says where the place beside the hole is, so that those of an earlier block count no more; two parameters say which way it goes: the axis of the
  /// plane, and the direction (HX 12.3.9, Series 8 G88, G89). Otherwise a parameter of each axis says whether Q counts for it, and its direction (M700 13.1.1).
  bool q_is_shift = false;
  /// All cycles have one format: each takes the words of every other one and keeps them for it (HX 12.1.2). Otherwise each has its own (DGSHAPE G80 to G89;
  /// Series 8 G81 to G89).
  bool words_of_all = false;
  /// The words of a shift are kept for the cycles that have one from whatever hole they stand in (M700 13.1.1, G76 and G87: "modals during the canned cycle").
  /// Otherwise only such a cycle takes them.
  bool shift_of_any_hole = false;
  /// The bore that comes back with the spindle stopped dwells for P at the bottom (M700 13.1.1, G86). Otherwise its format has no P (DGSHAPE G86, HX 12.3.8).
  bool bore_stop_dwells = true;
  HoleData data = HoleData::of_mode;
  /// Z and R count as the distance mode of the block says in which a hole is made, whatever it was when they were written (LinuxCNC G81). Otherwise they stay
  /// what they were (M700 13.1.1).
  bool levels_by_mode_of_hole = false;
  /// The cycle that breaks chips dwells for P behind each cut (M700 13.1.1 (j)). Otherwise it has no P (RS-274/NGC 3.5.16, LinuxCNC G73).
  bool step_dwells = true;
  /// A bottom above R is a fault (LinuxCNC G81; Series 8 G80: R is the clearance, Z the final depth, and both stay known from one cycle to the next). Otherwise the hole is made upwards (M700 13.1.1).
  bool bottom_is_below_r = false;
  /// A peck is larger than zero (RS-274/NGC 3.5.16.3: "Q number is negative or zero" is an error). Otherwise its sign says nothing (M700 13.1.1).
  bool peck_is_positive = false;
  /// The bore that is drawn back by hand stops the program at its bottom (HX 12.3.11 "Manual Boring Cycle"). Otherwise single block has a place to stop there, and
  /// without it the way back begins by itself (M700 13.1.1 (h)).
  bool bore_waits_for_hand = false;
  /// The bottom of a back bore lies below its end (HX 12.3.10). Otherwise the signs say the way (M700 13.1.1 (g)).
  bool back_bore_is_upwards = false;
  /// The letter of the repeats is never one of a shift (HX 12.3.9: K is the count, I and J are the shift). Otherwise it is, in the planes that it belongs to (M700 13.1.1).
  bool count_is_no_shift = false;
  /// The codes that stop the program act over the first hole of their block, "after positioning" (M700 13.1.1 (2)). Otherwise they act behind the block, as
  /// elsewhere (RS-274/NGC 3.8), or stand alone (DGSHAPE 2).
  bool stops_over_hole = false;
  /// No repetition is a fault (RS-274/NGC 3.5.16: L is a positive integer). Otherwise the words are kept, and there is no hole (M700 13.1.1).
  bool repeats_from_one = false;
  /// The code that ends a cycle is one of the motions, so axis words behind it have none until a code gives one (RS-274/NGC 3.4, LinuxCNC: "Cannot use axis
  /// values without a g code that uses them"). Otherwise the motion of before goes on (M700 13.1.1).
  bool end_is_motion = false;
};

/// Reference positions.
struct ReferenceRules {
  /// In a reference return an axis that is not named goes, too, and passes the intermediate point that an earlier return gave it (DGSHAPE
  /// G28). Otherwise it does not move (M700 14.7).
  bool remembered_axes_go;
  /// Intermediate points are forgotten at the end of the program (DGSHAPE G28). Otherwise they are kept until power off (M700 14.7 (5), (8)).
  bool forgets_with_program;
  /// Rotary axes may be named (M700 14.7). DGSHAPE G28: A is a fault.
  bool takes_rotary_axes;
  /// The length compensation of an axis is cancelled when the axis reaches its reference position (M700 12.2, 14.7 (9), 14.8 (6)). DGSHAPE
  /// G28 does not say so.
  bool cancels_length;
  /// So does a reference return by hand, which also ends the compensation along the axis of the tool (M700 12.2 (4) (a), 12.3). The others do not say so.
  bool hand_cancels_length = false;
  /// P of the further reference positions is 2 to 4, and anything else a fault (HX 6.2). Otherwise it is the 2nd position (M700 14.8 (1)).
  bool place_is_checked = false;
  /// A block without axis words moves all axes, without an intermediate point (RS-274/NGC 3.5.8). Otherwise it is a fault that words are
  /// missing, unless it may move nothing (M700 14.7).
  bool all_axes_without_words;
  /// A block that names no axis, and in which none goes by an earlier intermediate point, moves nothing (DGSHAPE G28: "when no coordinate at all has been specified
  /// for a particular axis, no movement along that axis is performed"). Otherwise it is a fault that words are missing (M700 14.7).
  bool may_move_nothing = false;
};

struct CoordinateRules {
  /// A move in machine coordinates may be incremental (M700 14.4 (4)). In DGSHAPE G53 that is a fault.
  bool machine_move_may_be_incremental;
  /// The code for machine coordinates, if it stands beside that of coordinate system setting, takes the shift of the setting away (M700 14.5
  /// note). DGSHAPE G92, G53 have no such rule.
  bool machine_code_ends_shift;
  /// A move in machine coordinates has the motion code in force, which must be G0 or G1 (RS-274/NGC 3.5.12). Otherwise it is made in rapid
  /// traverse (M700 14.4; DGSHAPE G53).
  bool machine_move_by_motion;
  /// An incremental move in machine coordinates does nothing (HX 7.1.1). Else it goes, or is a fault (M700 14.4 (4); DGSHAPE G53).
  bool incremental_machine_move_rests;
  /// Words of a move in machine coordinates are absolute in incremental mode, too (Series 8 G69).
  bool machine_move_is_absolute = false;
  /// A radius of G16 that is an increment makes the place where the axes are the pole, which stays it for words without a radius; the first angle counts from
  /// the first axis; the words of an arc are no radius and angle (HX 8.3). Otherwise the pole is there for that block alone, and is the zero point for others,
  /// and those of an arc are (M700 6.12).
  bool pole_stays = false;
  /// The stroke check looks at the way of a block (HX 15.5.3). Otherwise at its start and end (M700 15.7).
  bool stroke_check_sees_way = false;
  /// An area of the stroke check has both points of each axis that it limits, and is stored: the code alone takes it again, and so does a program that begins in
  /// the mode (HX 15.5.3, 3.2). Otherwise words that are not there are 0, and the code alone checks nothing (M700 15.7 (2), (3)).
  bool stroke_check_needs_area = false;
  /// The shift of coordinate system setting ends with the program and with a reset (Series 8 G92). Otherwise it stays (M700 9.1).
  bool shift_ends_with_program = false;
  /// Coordinate system setting without axis words is a fault (RS-274/NGC 3.5.18). Otherwise it shifts nothing (M700 14.5).
  bool setting_needs_axes = false;
};

struct ScalingRules {
  /// All linear axes are scaled; for an axis without a given centre it is the position of the tool (DGSHAPE G51). Otherwise only the axes
  /// whose centre is given are scaled (M700 13.19).
  bool all_linear_axes;
  /// P is required (DGSHAPE G51). Otherwise a parameter gives the factor if P is missing (M700 13.19).
  bool factor_required;
  /// Converts the value of P into `factor`; returns false if it is out of the range that the family's row gives. `pointed`: P has a decimal point. M700
  /// 13.19: without a point P is in millionths. DGSHAPE G51: P is limited to its range.
  bool (*factor_of_word)(double value, bool pointed, const RangeRules& range, double* factor);
  /// I J K are factors of the basic axes, a negative one mirrors, and a parameter of each axis stands for one that is missing (HX 15.2.2, 15.3).
  /// Else one factor is that of all (M700 13.19; DGSHAPE G51).
  bool factor_by_axis;
  /// An arc whose axes have different factors is one by what has become of its words, R times the larger factor, where these still are of one circle
  /// (HX 15.2.2). Else a fault (M700 13.19 (4); DGSHAPE G51 has one factor).
  bool arcs_may_be_uneven;
  /// The axes of the plane are scaled about the zero point; what has been programmed before stays the programmed position, so that a first move
  /// moves both (Series 8 G57). Otherwise about the point of the words, or the position of the tool (M700 13.19).
  bool about_zero = false;
  /// The axes of the plane are scaled, and so the plane stays while they are (Series 8 G57: "in the active plane"). Otherwise it is free.
  bool binds_plane = false;
};

/// Rotation of coordinates by program.
struct RotationRules {
  /// The code of its plane may stand in its block (HX 15.4.1), and behind it that of the plane in force. Else a fault (M700 13.20 (13); DGSHAPE has no rotation).
  bool plane_in_block;
  /// Without an angle it is that of a parameter (HX 15.4.1). Else that of before (M700 13.20 (4)).
  bool angle_by_parameter;
  /// A centre that is programmed while scaling is in force is scaled (HX 15.4.2 (2)). Otherwise it is not (M700 13.20).
  bool centre_is_scaled = false;
  /// As ScalingRules::about_zero, and the angle is never added to that of before (Series 8 G55).
  bool about_zero = false;
};

/// Interpolation on a cylinder and in polar coordinates.
struct MillRules {
  /// The word of the cylinder's block names its rotary axis, which stands for an axis of each plane; parameters number the axes of polar coordinates
  /// (HX 4.6, 4.7). Else parameters name them (M700 6.9, 6.10; DGSHAPE has neither).
  bool rotary_in_block;
  /// In polar coordinates nothing but cuts and what belongs to them goes (HX 4.6). Else rapid traverse and cycles as well (M700 6.10).
  bool polar_cuts_only;
  /// Scaling in force in front of the code is a fault, as rotation is (HX 15.2.1: factors act on axes alike, and the one that turns is a length there). Otherwise it
  /// scales the linear axes (M700 6.9, 6.10 do not name it).
  bool bars_scaling = false;
};

/// Codes that call programs because a parameter says so.
struct CodeCallRules {
  /// Programs of the G codes and of the M codes in the order of their parameters (HX 14.1.3, 14.1.4: from 9010, from 9020 on). 0 = parameters name
  /// them (M700 13.5.2; DGSHAPE has no calls).
  uint32_t first_of_g, first_of_m;
  /// The words behind an M code that begins its block are arguments (HX 14.1.4), and behind other words it calls like M98 (14.1.5). Else a parameter
  /// says how it calls (M700 13.5.2).
  bool arguments_behind_m;
  /// Program that a tool number calls by the values of two parameters, 0 = none (HX 10.1.1). nullptr: parameters name it (M700 13.5.2).
  uint32_t (*tool_program)(double first, double second);
  /// Common variable that gets the tool number for this program, 0 = none (FANUC's T code call; HX 10.1.1 names none). Otherwise it is an argument, or the
  /// T that is shown (M700 13.5.2).
  uint32_t tool_variable = 0;
  /// Where one word calls like M98, another one that would call is a fault (HX 14.1.5, 14.1.6 print one of them). Otherwise it is an ordinary code (M700 13.5.2).
  bool one_in_block = false;
};

/// Data setting by program. Which value of L sets what is a table (DataInputRow).
struct DataInputRules {
  /// Offsets that a program reads and writes as variables are in the unit in force (HX 14.2.3, 13.3). Otherwise in the one of Parameter::initial_inch (M700 2.1).
  bool variables_in_unit = false;
  /// In incremental mode the value is added to the one that is set (M700 12.7, 14.10 (6)). In DGSHAPE G10 the modes make no difference.
  bool incremental_adds;
  /// The number of the coordinate system is required (DGSHAPE G10). Otherwise it is the selected system if the number is missing (M700 14.10
  /// (6)).
  bool system_required;
  /// A block that sets a coordinate system and has no axis words is a fault: such blocks were written for a control on which a block without
  /// L sets tool data (docs/decisions.md). DGSHAPE G10 prints all axes in brackets, that is, as optional.
  bool axes_required;
  /// I J K without L turn the workpiece (M700 13.21).
  bool vector_turns_work;
  /// Number 0 is the selected coordinate system (LinuxCNC G10 L2). Otherwise it is the external offset, which all systems have in common (M700
  /// 14.10 (6); DGSHAPE G10).
  bool zero_is_selected_system;
  /// R beside a coordinate system turns it (LinuxCNC G10 L2), which is not built. Otherwise R means nothing there (M700 14.10 (6); DGSHAPE
  /// G10).
  bool amount_turns_system;
};

struct ProgramRules {
  /// A call of a sub program without a number calls the program that it stands in (M700 13.3.1). Otherwise its number is missing (HX 2.4.3).
  bool own_without_number = false;
  /// The family has the macro interrupt, which M codes enable and disable (M700 13.12). DGSHAPE has no macros.
  bool macro_interrupt;
  /// The motion code and the feed stay in force after the end of a program, so that axis words which follow go on with them (M700 9.1, 7.2
  /// note 1). Otherwise every program begins with the state at power on (DGSHAPE 1-1).
  bool motion_outlives_end;
  /// So many loops stand in one another (M700 13.5.7: 27; HX 14.2.5: three; DGSHAPE has none).
  unsigned loops_in_one_another;
  /// L beside the return in a main program is how often it goes back, then it goes on (HX 2.4.4). Else it goes back without end (M700 13.3.1; DGSHAPE
  /// has no sub programs).
  bool main_program_counts;
  /// The code that ends a modal call may stand where none is in force, as any code may that is in force (HX 3.2: from power on). Otherwise it is a
  /// fault (M700 13.5.1).
  bool modal_end_may_stand_alone = false;
  /// Blocks of MDI call no sub program (HX 2.4.3). Else they may (M700 13.3.1; DGSHAPE has none).
  bool no_call_in_mdi;
  /// So many sub programs stand in one another, whatever macros stand between them (HX 2.4.1: four; M700 13.3.1: eight; DGSHAPE has none).
  unsigned sub_programs_in_one_another;
};

struct MotionRules {
  /// The limits of high-accuracy control for a move that is made in this mode (M700 13.15, 13.17.1). nullptr: the family has no code that
  /// begins the mode (DGSHAPE).
  AccuracyLimits (*accuracy_limits)(const AccuracyParameters& parameters, const AccuracyMove& move);
  /// Highest speed at the joint of two moves of high-accuracy control, in mm/s; infinite = no limit (M700 13.15, 13.17.1). nullptr: the family
  /// has no code that begins the mode (DGSHAPE).
  double (*accuracy_joint_speed)(const AccuracyLimits& before, const AccuracyLimits& behind, const AccuracyJoint& joint);
  /// Highest speed in a part of a spline, in mm/min, by the smallest radius of this part in mm; infinite = no limit (M700 13.18 (3)). nullptr:
  /// the family has no splines (DGSHAPE).
  double (*spline_speed_mm_min)(const AccuracyParameters& parameters, double radius_mm);
  /// The time constants of the filters behind interpolation that act on a move (M700 7.7, 13.15, 15.5). nullptr: the family has no filters
  /// (DGSHAPE).
  FilterTimes (*filter_times)(const FilterParameters& parameters, const FilteredMove& move, double cycle_s);
  /// The second code of a line or an arc is of one that ends at rest (Series 8 G21 to G23).
  bool second_code_rests = false;
  /// The lead of a thread is the way along its path in a turn (LinuxCNC G33). Otherwise it is that of the axis that goes furthest (M700 6.7.1).
  bool lead_along_path = false;
};

/// The signals of a stitching head (HX 15.6), bits of the first word of outputs and of inputs of the macro interface; 0 = the family has none.
struct StitchRules {
  uint32_t call = 0;      ///< output: a stitch is asked for
  uint32_t done = 0;      ///< input: it is done
  uint32_t next_may = 0;  ///< input: the next place may come
};

struct Rules {
  NumberRules number;
  BlockRules block;
  AuxiliaryRules auxiliary;
  SpindleRules spindle;
  FeedRules feed;
  SkipRules skip;
  ArcRules arc;
  DwellRules dwell;
  CompensationRules compensation;
  LengthRules length;
  CycleRules cycle;
  ReferenceRules reference;
  CoordinateRules coordinate;
  ScalingRules scaling;
  DataInputRules data_input;
  ProgramRules program;
  MotionRules motion;
  RotationRules rotation;
  MillRules mill;
  CodeCallRules code_call;
  StitchRules stitch{};
  RangeRules range;
};

}  // namespace nc
