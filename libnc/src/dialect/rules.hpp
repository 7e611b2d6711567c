// SPDX-License-Identifier: Apache-2.0
// Rules in which the families of controllers differ, by subject. A family states each of them in
// dialect/<family>/rules.hpp; the functions of interpret/ ask for the rule and never for the family. Each
// comment says what the rule is where it holds, and then the sections of the manuals for and against it.
// Nothing has a default here: a new family has to think of every line.
#pragma once

#include <cstdint>

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
  /// F without a point counts in units of 0.001 mm/min or 0.0001 inch/min, unless a setting reads it whole
  /// (DGSHAPE 3). Else F1 is 1.000 whatever the settings of positions are (M700 7.2).
  bool undotted_feed_in_least_unit;
  /// A position without a point may have all the digits of its word (DGSHAPE 2-1 "range 1"). Else the range
  /// of coordinates in mm, inch or deg holds for it as for any other (M700 2.1, 5.3).
  bool undotted_range_is_digits;
  /// Largest F with and without a point, mm/min and inch/min (M700 5.3; DGSHAPE 2-1 "range 1").
  double largest_feed_mm, largest_feed_inch;
  double largest_undotted_feed_mm, largest_undotted_feed_inch;
  /// How many times finer than a micrometre the setting unit is, by the value of its parameter, 0 = not set
  /// (M700 2.1). DGSHAPE 2-1: it is a micrometre.
  double (*units_per_micrometre)(double parameter);
  /// A length that a formula gives is rounded to the least unit (HX 14.2.4). Else it is what has been calculated (M700 13.5.4; DGSHAPE has no
  /// formulas).
  bool rounds_formulas;
};

/// What may stand in a block.
struct BlockRules {
  /// Each axis word goes by the absolute or incremental code in front of it in the block (M700 5.1). Else
  /// the last such code counts for all words of the block (DGSHAPE 1-2: of two codes of one group the last
  /// one takes effect).
  bool distance_by_word;
  /// Codes, speeds, numbers of things and counts have no decimal point (DGSHAPE 2). Else decimals are cut
  /// off (M700 5.3).
  bool whole_words_refuse_point;
  /// M codes that stop or end the program stand alone in their block (DGSHAPE 2). M700 9.1 lets them share
  /// it.
  bool stops_stand_alone;
  /// A dwell stands alone in its block (DGSHAPE G04). M700 8.1 lets it share one.
  bool dwell_stands_alone;
  /// Two words of a letter other than those of codes, and two codes of one mode, are faults (RS-274/NGC 3.3.1, 3.4). Else the last one
  /// counts (M700 3.7; DGSHAPE 1-2).
  bool words_stand_once;
  /// Of several variables that a block sets none has its value before all have been calculated: #1=2 #2=#1 takes the #1 of before
  /// (RS-274/NGC 3.3.2.2). Else one after the other (M700 13.5.4).
  bool assigns_at_once;
};

/// M, T and the second auxiliary function.
struct AuxiliaryRules {
  /// So many M codes of a block are executed, the last ones (M700 9.1: four). DGSHAPE 2 names no bound: all
  /// that fit in a block.
  unsigned most_m_codes;
  /// A tool number and the code of the tool change come as a pair, never more than one of each in a block
  /// (DGSHAPE M06). M700 11 knows the tool number alone.
  bool tool_change_is_pair;
};

struct SpindleRules {
  /// Speed in r/min that a value of S asks for: the value (M700 10.1, 10.2), or below 100 a code of a
  /// series (DGSHAPE 2, S).
  double (*speed_of_word)(uint32_t value);
  /// S and Q of coordinate system setting are limits of the spindle speed (M700 10.4). Else an S there is a
  /// speed (DGSHAPE G92).
  bool limits_by_coordinate_setting;
  /// A start while it turns and a stop while it stands are not put out (DGSHAPE 2). M700 10 puts out every
  /// M code.
  bool skips_repeated_codes;
};

struct FeedRules {
  /// In inch F of a move of rotary axes alone is in 10 deg/min (M700 3.2 note 6). Else an inch is 25.4 as
  /// everywhere: DGSHAPE has no such rule.
  bool inch_is_ten_degrees;
  /// F of a line is that of linear and rotary axes together, a degree as long as a millimetre (M700 7.6).
  /// Else it is the linear axes' (DGSHAPE, "F").
  bool degree_counts_as_millimetre;
  /// F of inverse time is one over the minutes of the whole block, of an arc, too (RS-274/NGC 3.5.19). Else that of an arc is the speed over
  /// its radius (M700 7.5).
  bool inverse_time_is_of_block;
};

/// The feed that a signal ends.
struct SkipRules {
  /// It goes by the F in force, and an F of its block stays in force (LinuxCNC G38). Else F is its own, or that of a parameter (M700
  /// 15.2).
  bool feed_is_modal;
};

struct ArcRules {
  /// A block of an arc may name rotary axes (M700 3.2 note 5, 6.3). DGSHAPE G02/G03: A cannot take part.
  bool takes_rotary_axes;
  /// In inch an arc of a linear and a rotary axis is drawn with a degree as a tenth of an inch (M700 3.2
  /// note 5).
  bool degree_is_tenth_of_inch;
  /// P, the number of full turns, does not stand beside R (M700 6.6). DGSHAPE G02/G03 does not say what
  /// becomes of P: it is no fault.
  bool turns_exclude_radius;
  /// An arc by its radius that ends where it starts is a fault (RS-274/NGC 3.5.3.1). Else nothing goes (M700 6.5; DGSHAPE G02/G03).
  bool closed_by_radius_is_fault;
  /// P counts the turn in which the end lies, so that it is 1 of a plain arc (LinuxCNC G2). Else those before it (M700 6.6).
  bool turns_count_last;
};

struct DwellRules {
  /// A dwell without a time is none, but the axes come to rest (M700 15.2 prints it behind a skip). Else a
  /// fault (DGSHAPE G04).
  bool time_optional;
  /// In inch the X in front of the code has been read as a length, whose unit is ten times finer: its time
  /// comes out tenfold (M700 8.1 note 3). DGSHAPE G04 knows nothing of it.
  bool early_x_is_length;
  double longest_s;  ///< M700 8.1; DGSHAPE G04: 3600 s
  /// X is in seconds without a point, too (HX 5.4). Else it goes by the settings of numbers (M700 8.1; DGSHAPE 1-5).
  bool x_is_seconds;
};

/// Compensation of the tool radius.
struct CompensationRules {
  /// XY is the only plane of radius compensation (DGSHAPE G40-G42). Else it works in each (M700 12.4.1).
  bool xy_plane_only;
  /// The plane cannot be changed while it is on, nor right behind its end (M700 App. 1 P112). Else selecting the plane
  /// anew is no fault (DGSHAPE G40-G42).
  bool plane_is_fixed;
  /// The codes of scaling and the cancel code of cycles are faults while it is on (DGSHAPE G40-G42). M700 13.19
  /// compensates the scaled shape.
  bool bars_scaling_and_cycle_end;
  /// Codes of workpiece coordinate systems, coordinate system setting and data setting are faults while it is on
  /// (DGSHAPE G40-G42). M700 12.4.4 allows them.
  bool bars_systems_and_data;
  /// Reference return is a fault while it is on (DGSHAPE G28). M700 12.4.4 allows it: the vector is cancelled at the intermediate point.
  bool bars_reference_return;
  /// Compensation may change from one side to the other without a cancel in between (M700 12.4.1). DGSHAPE G41/G42: "the
  /// direction cannot be changed".
  bool may_change_side;
  /// I J K beside its code are the direction of its vector (M700 12.4.3). DGSHAPE G41/G42 has no such
  /// words.
  bool vector_by_words;
  /// An amount that is changed while it is in force acts from the next command on (M700 12.1). Else what
  /// was in force at the code (DGSHAPE "D": cancel first).
  bool takes_changed_amounts;
  /// A block of its code without a move does nothing; the next move leads to the contour, or away from it (LinuxCNC G40 to G42). Else the tool goes
  /// to the point beside it at once (M700 12.4.2; DGSHAPE G41).
  bool code_alone_waits;
  /// Its code without D takes the number of the tool (RS-274/NGC 3.5.10). Else that of before (M700 12.4.1; DGSHAPE G41).
  bool number_is_that_of_tool;
};

/// Compensation of the tool length.
struct LengthRules {
  /// The axis words of its block choose the axis (M700 12.2 (3)). Else it is Z (DGSHAPE G43).
  bool axis_by_words;
  /// An H holds until the next one, whatever block it stands in (M700 12.1 (2), (3)). Else only beside the
  /// code that begins it (DGSHAPE G43: "G43 H n").
  bool number_in_any_block;
  /// The code without H takes the number of before, and 0 is one (M700 12.2 (2) (d), App. 1 P170). Else 0
  /// is none (DGSHAPE G43).
  bool zero_is_number;
  /// Beginning and end move the axis at once, also without a word for it (DGSHAPE G43). Else its next
  /// command does (M700 12.2).
  bool moves_at_once;
  /// Beginning and end leave the axis where it is, and from there on its coordinate is another one (RS-274/NGC 3.5.11): an incremental word
  /// counts from that. Else the next command of the axis takes it there as well (M700 12.2).
  bool shifts_reading;
  /// The code without H takes the number of the tool (LinuxCNC G43). Else that of before (M700 12.2 (2) (d); DGSHAPE G43 has to have one).
  bool number_is_that_of_tool;
  /// The axis is the one that stands on the plane in force (HX 13.1.1). Else axis_by_words says (M700 12.2 (3); DGSHAPE G43).
  bool axis_on_plane;
};

struct CycleRules {
  /// XY is the only plane of cycles (DGSHAPE G80-G89). M700 13.1.1: any.
  bool xy_plane_only;
  /// Rotary axes may stand in a block with a hole (M700 13.1.1 precaution (6)). DGSHAPE G80-G89: A is a
  /// fault.
  bool takes_rotary_axes;
  /// A hole with a spindle that does not turn is a fault (DGSHAPE G80-G89). M700 13.1.1 does not look.
  bool needs_turning_spindle;
  /// A block in the mode without a bottom, now or before, positions and drills nothing (DGSHAPE G81). Else
  /// the hole goes to R (M700 13.1.1).
  bool without_bottom_positions;
  /// Where R and Z are incremental, R has the sign of Z (M700 13.1.1 "Absolute/incremental"). Else it
  /// counts as it stands (DGSHAPE).
  bool r_takes_sign_of_z;
  /// Axes outside the plane go to the hole by the motion code from before the cycle (M700 13.1.1 precaution
  /// (6), 13.1.2 example 2). Else in rapid traverse (DGSHAPE G81).
  bool others_keep_motion_mode;
  /// Distance from the last peck at which the next begins, mm (DGSHAPE G83: 1 mm, fixed); 0 = the
  /// parameters say (M700 13.1.1).
  double fixed_clearance_mm;
  /// P is in seconds, with a fraction (RS-274/NGC 3.5.16.2). Else in whole milliseconds (M700 13.1.1; DGSHAPE G82).
  bool dwell_in_seconds;
  /// The first block of a cycle has its bottom and its R (RS-274/NGC 3.5.16). Else the level of before stands for them (M700 13.1.1; DGSHAPE
  /// G81).
  bool begins_with_both_levels;
  /// Where the axis stands below R it goes up to it before the others go to the hole (RS-274/NGC 3.5.16). Else they go first (M700
  /// 13.1.1; DGSHAPE G81).
  bool rises_before_positioning;
  double longest_dwell_ms;  ///< P (M700 13.1.1: eight digits; DGSHAPE: as of the dwell)
  /// Taps turn the spindle back in front of the dwell, bores let it turn again as before, and both want it turning (RS-274/NGC 3.5.16). Else
  /// the strokes are those of M700 13.1.1, and it turns forward behind a bore.
  bool keeps_spindle_direction = false;
  /// Each block drills along the axis of the plane in force (RS-274/NGC 3.5.16). Else the axis stays as long as the mode does (M700 13.1.1 note
  /// 2; DGSHAPE has one plane).
  bool axis_follows_plane = false;
};

/// Reference positions.
struct ReferenceRules {
  /// An axis that is not named goes by the intermediate point that an earlier return gave it (DGSHAPE G28).
  /// Else it stays (M700 14.7).
  bool remembered_axes_go;
  /// Intermediate points are forgotten with the program (DGSHAPE G28). Else they hold since power on (M700
  /// 14.7 (5), (8)).
  bool forgets_with_program;
  /// Rotary axes may be named (M700 14.7). DGSHAPE G28: A is a fault.
  bool takes_rotary_axes;
  /// An axis that reaches its position has its length compensation cancelled (M700 12.2, 14.7 (9), 14.8
  /// (6)). DGSHAPE G28 says nothing of it.
  bool cancels_length;
  /// Without axis words all axes go, and by no intermediate point (RS-274/NGC 3.5.8). Else words are missing (M700 14.7; DGSHAPE G28).
  bool all_axes_without_words;
};

struct CoordinateRules {
  /// A move in machine coordinates may be incremental (M700 14.4 (4)). DGSHAPE G53: a fault.
  bool machine_move_may_be_incremental;
  /// The code for machine coordinates beside coordinate system setting takes its shift away (M700 14.5
  /// note). DGSHAPE G92, G53 have none.
  bool machine_code_ends_shift;
  /// A move in machine coordinates goes by the motion in force, G0 or G1, and no other may be (RS-274/NGC 3.5.12). Else in rapid traverse (M700
  /// 14.4; DGSHAPE G53).
  bool machine_move_by_motion;
  /// An incremental move in machine coordinates does nothing (HX 7.1.1). Else it goes, or is a fault (M700 14.4 (4); DGSHAPE G53).
  bool incremental_machine_move_rests;
};

struct ScalingRules {
  /// All linear axes are scaled, those without a centre about where the tool stands (DGSHAPE G51). Else the
  /// axes whose centre is given (M700 13.19).
  bool all_linear_axes;
  /// P has to be there (DGSHAPE G51). Else a parameter stands for it (M700 13.19).
  bool factor_required;
  /// Factor of a P; false = out of range (M700 13.19: in millionths without a point; DGSHAPE G51: held
  /// within its range).
  bool (*factor_of_word)(double value, bool pointed, double* factor);
  /// I J K are factors of the basic axes, a negative one mirrors, and a parameter of each axis stands for one that is missing (HX 15.2.2, 15.3).
  /// Else one factor is that of all (M700 13.19; DGSHAPE G51).
  bool factor_by_axis;
  /// An arc whose axes have different factors is one by what has become of its words, R times the larger factor, where these still are of one circle
  /// (HX 15.2.2). Else a fault (M700 13.19 (4); DGSHAPE G51 has one factor).
  bool arcs_may_be_uneven;
};

/// Rotation of coordinates by program.
struct RotationRules {
  /// The code of its plane may stand in its block (HX 15.4.1). Else a fault (M700 13.20 (13); DGSHAPE has no rotation).
  bool plane_in_block;
  /// Without an angle it is that of a parameter (HX 15.4.1). Else that of before (M700 13.20 (4)).
  bool angle_by_parameter;
};

/// Interpolation on a cylinder and in polar coordinates.
struct MillRules {
  /// The word of the cylinder's block names its rotary axis, which stands for an axis of each plane; parameters number the axes of polar coordinates
  /// (HX 4.6, 4.7). Else parameters name them (M700 6.9, 6.10; DGSHAPE has neither).
  bool rotary_in_block;
  /// In polar coordinates nothing but cuts and what belongs to them goes (HX 4.6). Else rapid traverse and cycles as well (M700 6.10).
  bool polar_cuts_only;
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
};

/// Data setting by program. Which value of L sets what is a table (DataInputRow).
struct DataInputRules {
  /// In incremental mode what is set is added (M700 12.7, 14.10 (6)). DGSHAPE G10: the modes make no
  /// difference.
  bool incremental_adds;
  /// The number of the coordinate system has to be there (DGSHAPE G10). Else it is the selected one (M700
  /// 14.10 (6)).
  bool system_required;
  /// A coordinate system without axis words is a fault: such blocks were written for a control where no L
  /// sets the tool (docs/decisions.md). DGSHAPE G10 prints all axes in brackets.
  bool axes_required;
  /// I J K without L turn the workpiece (M700 13.21).
  bool vector_turns_work;
  /// Number 0 is the selected coordinate system (LinuxCNC G10 L2). Else the external offset, which is common to all (M700 14.10 (6); DGSHAPE
  /// G10).
  bool zero_is_selected_system;
  /// R of a coordinate system turns it (LinuxCNC G10 L2), which is not built. Else it means nothing there (M700 14.10 (6); DGSHAPE G10).
  bool amount_turns_system;
};

struct ProgramRules {
  /// There is the macro interrupt, begun and ended by M codes (M700 13.12). DGSHAPE has no macros.
  bool macro_interrupt;
  /// The first coordinate words behind the end of a program go on in its mode of motion and with its feed
  /// (M700 9.1, 7.2 note 1). Else every program begins with the state at power on (DGSHAPE 1-1).
  bool motion_outlives_end;
  /// So many loops stand in one another (M700 13.5.7: 27; HX 14.2.5: three; DGSHAPE has none).
  unsigned loops_in_one_another;
  /// L beside the return in a main program is how often it goes back, then it goes on (HX 2.4.4). Else it goes back without end (M700 13.3.1; DGSHAPE
  /// has no sub programs).
  bool main_program_counts;
  /// Blocks of MDI call no sub program (HX 2.4.3). Else they may (M700 13.3.1; DGSHAPE has none).
  bool no_call_in_mdi;
  /// So many sub programs stand in one another, whatever macros stand between them (HX 2.4.1: four; M700 13.3.1: eight; DGSHAPE has none).
  unsigned sub_programs_in_one_another;
};

struct MotionRules {
  /// What high-accuracy control asks of a move that is made in it (M700 13.15, 13.17.1). nullptr: no code
  /// of the family begins it (DGSHAPE).
  AccuracyLimits (*accuracy_limits)(const AccuracyParameters& parameters, const AccuracyMove& move);
  /// Highest speed at the joint of two moves that are made in it, mm/s; infinite = any (M700 13.15, 13.17.1). nullptr as above.
  double (*accuracy_joint_speed)(const AccuracyLimits& before, const AccuracyLimits& behind, const AccuracyJoint& joint);
  /// Highest speed of a part of a spline, mm/min, by its smallest radius; infinite = any (M700 13.18 (3)).
  /// nullptr: the family has no splines (DGSHAPE).
  double (*spline_speed_mm_min)(const AccuracyParameters& parameters, double radius_mm);
  /// The filters behind interpolation that a move has (M700 7.7, 13.15, 15.5). nullptr: the family has none
  /// (DGSHAPE).
  FilterTimes (*filter_times)(const FilterParameters& parameters, const FilteredMove& move, double cycle_s);
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
};

}  // namespace nc
