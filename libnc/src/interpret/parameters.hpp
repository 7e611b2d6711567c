// SPDX-License-Identifier: Apache-2.0
// Control parameters: a store for their values, and the typed values with which the interpreter works.
#pragma once

#include "base/arena.hpp"
#include "base/optional_double.hpp"
#include "base/units.hpp"
#include "command/auxiliary.hpp"
#include "dialect/accuracy.hpp"
#include "dialect/dialect.hpp"
#include "fairing/rule.hpp"
#include "filter/filter_parameters.hpp"
#include "macro/journal.hpp"

namespace nc {

/// A stage of the acceleration of a synchronous tap (M700 13.1.1): up to this speed, in this time from the stage before.
struct TapStage {
  double rev_min = 0, seconds = 0;
};

/// Parameters as the interpreter uses them. Names say what they do; the manual's number stands beside each.
struct Settings {
  double command_unit_mm = 0.001;     ///< #1015 cunit (where it is 0: #1003 iunit): unit of a position word without a point, mm
  double command_unit_inch = 0.0001;  ///< the same in inch
  double command_unit_deg = 0.001;    ///< the same for rotary axes, deg
  uint32_t own_unit_axes = 0;         ///< #1015 may differ between axes: bit i: axis i has its own unit ...
  double own_unit[kMaxAxes] = {};     ///< ... which is this one, mm or deg; in inch a tenth of the number
  double setting_unit_mm = 0.001;     ///< #1003 iunit: unit of I J K R without a point, mm
  double setting_unit_inch = 0.0001;
  double setting_unit_deg = 0.001;
  // Largest coordinate and length, in mm or deg: one setting unit below the end of the family's range. kNoise allows for the rounding of inches to mm, far
  // below the finest unit.
  static constexpr double kNoise = 1e-9;
  double last_mm = 0, last_inch = 0, last_deg = 0;
  bool decimal_type_2 = false;        ///< #1078
  double tenfold = 1;                 ///< "UNIT*10"
  bool dwell_p_decimal = false;       ///< #8112
  double arc_tolerance = 0.1;         ///< #1084 RadErr, mm
  bool drilling_axis_z = false;       ///< #1080
  bool tool_memory_2 = false;         ///< #1037 = 2
  bool diameter_offsets = false;      ///< #8117
  bool comp_type_b = false;           ///< #1229 bit 2
  bool contour_check = false;         ///< CONTOUR_CHECK
  bool corner_arcs = false;           ///< corner_ii
  double space_divisor = 0;           ///< #8071 3-D CMP, mm
  bool interference_check = false;    ///< #8103 OFF (M700; DGSHAPE checks nothing)
  bool interference_avoid = false;    ///< #8102 ON
  double skip_feed = 0;               ///< #1174, mm/min
  static constexpr unsigned kMultiSkips = 4;  ///< HX 4.9; M700 15.3: three
  double multi_skip_feed[kMultiSkips] = {};     ///< #1176 #1178 #1180: G31.1 G31.2 G31.3, mm/min
  uint8_t multi_skip_mask[kMultiSkips] = {1, 2, 4, 8};  ///< #1175 #1177 #1179: their skip signals, bit n = signal n+1
  double measure_feed = 0;            ///< #8004, mm/min
  double measure_deceleration = 0;    ///< #8005, mm
  double measure_range = 0;           ///< #8006, mm
  double reference[4][kMaxAxes];      ///< #2037 to #2040, machine coordinates; NaN = the one in the configuration of the machine
  double tool_change[kMaxAxes] = {};  ///< #8206, machine coordinates
  uint32_t tool_change_axes = 0;      ///< #1092: bit i: axis i, an added axis, goes there, too
  // #8213, bit i: axis i. Only rotary axes have bits (Interpreter::refresh_settings).
  uint32_t turning = 0;               ///< types 0 and 1: workpiece coordinates within one turn
  uint32_t short_cut = 0;             ///< type 1: G90 goes the shorter way
  uint32_t machine_turn = 0;          ///< types 0 to 2: machine coordinates within one turn
  double peck_clearance = 0;       ///< #8013, mm
  double step_clearance = 0;       ///< #8012, mm
  uint32_t spindle_forward_m = 0, spindle_reverse_m = 0;  ///< #3028 sprcmn, and the one behind it; 0 = the family's
  bool tap_synchronous = false;       ///< #1229 bit 4
  bool tap_to_r = false;              ///< #1272 bit 4
  double tap_clearance = 0;           ///< #8018, mm
  bool tap_checks = false, tap_check_approach = false, tap_check_bottom = false, tap_check_r = false;  ///< #1223 bits 3, 2, 4, 5
  double tap_dwell_s = 0;             ///< #1313 TapDwl
  TapStage tap_stage[3];              ///< #3013 #3017, #3037 #3041, and #3045 up to the highest speed
  double tap_most_rev_min = 0;        ///< #3005, 0 = none
  double tap_return = 0;              ///< #1172: speed of the way back as a share of S, 0 = the same
  bool life_managed = false, life_by_tool = false;  ///< #1103, #1104
  uint32_t shift_ignored = 0, shift_minus = 0;  ///< #8207, #8208, bit = axis
  bool codes_after_motion = false;    ///< MSTB_AFTER_MOTION: M S T B of a block that moves go out behind its motion
  uint8_t surface_axis = 0;           ///< #1181 G96_ax
  bool clamp_command_always = false;  ///< #1146 Sclamp
  bool clamp_in_surface_speed_only = false;     ///< #1227 bit 5, with Sclamp 1
  bool keeps_clamp = false;           ///< #1210 bit 19
  uint32_t mirror_axes = 0;           ///< #8211, bit = axis
  bool keeps_polar_command = false;   ///< #1210 bit 11
  uint32_t index_axes = 0;            ///< #2076 index_x, bit = axis
  uint32_t no_reference = 0;          ///< #2031 noref, bit = axis
  bool rapid_dry = false;             ///< #1085 G00Drn: dry run concerns rapid traverse
  bool rapid_by_axis = false;         ///< #1086 G0Intp: rapid traverse without interpolation
  bool macro_single = false;          ///< #8101
  bool semicolon_comments = false;    ///< ';' begins a comment in program texts
  bool macro_extensions = false;      ///< IF THEN of later models
  bool negative_count = false;        ///< #3901 may be below 0
  MiscCodes misc_codes;
  bool interrupt_by_level = false;    ///< #1112 S_TRG
  bool interrupt_type_2 = false;      ///< #1113 INT_2
  bool interrupt_as_sub = false;      ///< #1229 bit 0
  bool reset_clears_common = false;   ///< #1128 RstVC1
  uint32_t last_shared[2] = {0, UINT32_MAX};  ///< #1303, #1304: last variable of each range of common variables that all part systems share
  bool print_blanks = false;          ///< DPRNT: leading zeros become blanks (M700 13.5.8 (4))
  bool asin_0_360 = false;            ///< #1273 bit 0
  bool start_absolute = true;
  bool start_inch = false;            ///< #1152
  bool initial_inch = false;          ///< #1041 I_inch
  uint32_t parity_units = 0;          ///< #9n15: bit n: of the tapes of input device n the characters of each block are counted
  double scaling_factor = 1;          ///< #8072 SCALING P
  WordSlot work_turn_axis[2] = {kNoWord, kNoWord};  ///< #8621, #8622: plane of the rotation of 13.21, kNoWord = the first and the second axis
  double work_turn_center[2] = {};    ///< #8623, #8624, machine coordinates
  double work_turn_vector[2] = {};    ///< #8625, #8626
  double work_turn_deg = 0;           ///< #8627
  double index_increment[kMaxAxes] = {};  ///< #2106, deg, 0 = not checked
  bool run_time_hours = false;        ///< #1273 bit 1
  bool preset_allowed = true;         ///< #1267 bit 0: G92.1 in list 1
  WordSlot plane_basic[3] = {kNoWord, kNoWord, kNoWord};     ///< #1026-#1028: the axes of I, J, K
  WordSlot plane_parallel[3] = {kNoWord, kNoWord, kNoWord};  ///< #1029-#1031: their parallel axes, kNoWord = none
  Function start_plane = Function::plane_xy;  ///< #1025
  bool helix_plane_feed = false;          ///< #1235 bit 0: F of a helix is the speed in the plane of its arc
  bool precision_lead = false;            ///< #1229 bit 1: E of G33 is a lead, not ridges per inch
  bool spiral_type_2 = false;             ///< #1272 bit 2
  double spiral_tolerance = 0.1;          ///< #8075 SpiralEndErr, mm
  WordSlot mill_axis = kNoWord;           ///< #1516: rotary axis of cylindrical and polar coordinate interpolation
  WordSlot polar_linear = kNoWord;        ///< #1533
  bool hypothetical_by_name = false;      ///< #1517
  WordSlot exponential_linear = kNoWord, exponential_rotary = kNoWord;  ///< #1514, #1515
  double creep[kMaxAxes] = {};            ///< #8209 G60 shift, mm, signed
  bool start_synchronous = false;         ///< #1074 I_Sync: G95 at power on and after M02/M30
  bool feed_by_digit = false;             ///< #1079 F1digt
  double digit_feed[5] = {};              ///< #1185-#1189: F1 to F5, mm/min, not above #1506
  double digit_most = 0;                  ///< #1506 F1_FM, mm/min, 0 = the handle changes nothing
  double digit_step = 0;                  ///< #1506 / #1507: by one pulse of the handle, mm/min
  bool check_rapid = false;               ///< 7.9: rapid traverse ends with a check that the axes are in position, not only at rest
  bool check_cutting = false;             ///< 7.9: the same for cuts with G09 or G61
  bool check_reversal = false;            ///< #1503 G1Ipfg
  double corner_override = 0;             ///< #8007, %
  double corner_angle = 0;                ///< #8008, deg
  double corner_zone = 0;                 ///< #8009, mm
  uint8_t dwell_skip = 0;                 ///< #1173 dwlskp: skip signals that end a dwell
  bool high_accuracy_code = true;         ///< #1267 bit 0 is not 1: G61.1 exists (13.15)
  bool high_speed_codes = true;           ///< #1267 bit 0 is not 0: G05 P10000, G05.1 exist (13.17)
  bool start_high_accuracy = false;       ///< #1148 I_G611
  bool smooth_control = false;            ///< #8090 SSS ON
  bool spline_allowed = false;            ///< #8025 SPLINE ON
  double spline_cancel_angle = 0;         ///< #8026 CANCEL ANG., deg; 0 = never
  double spline_minute_length = 1;        ///< #8030 MINUTE LENGTH, mm; negative = any length
  double spline_tolerance_inflected = 0;  ///< #8027 Toler-1, mm; 0 = no revision
  double spline_tolerance_arched = 0;     ///< #8028 Toler-2, mm
  AccuracyParameters accuracy;            ///< parameters of high-accuracy control, 13.15
  FairingRule fairing;                    ///< #8033, #8029, #8036, #8037 (13.17.1)
  FilterParameters filters;               ///< behind interpolation, 7.7, 13.15
  bool start_linear = false;              ///< HX PI 144
  bool start_stroke_check = false;        ///< HX PI 148
  double axis_factor[kMaxAxes] = {};      ///< HX PI 108 to 116, 0 = not set
  double rotation_deg = 0;                ///< HX PI 117
  bool dwell_in_revolutions = false;      ///< HX PI 120
  uint8_t polar_axis[2] = {};             ///< HX PM 4623, 4624: number of the axis from 1, 0 = not set
  bool cylinder_second_axis = false;      ///< HX PI 155
  bool box_outside = false;               ///< HX PM 3474
  double corner_behind = 0;               ///< HX PI 126, mm
  double corner_feed = 0;                 ///< HX PI 153, mm/min, 0 = none
  double inner_arc_least = 0;             ///< HX PI 132, factor, 0 = arcs go with F
  bool corners_always = false;            ///< HX PI 131
  int8_t shift_axis = -1, shift_direction = 0;  ///< HX PI 70, 71: axis of the plane, -1 = not set; 1 or -1, 0 = not set
  bool start_scaling = false, start_rotation = false;  ///< HX PI 149, 150
  bool stays_behind_reset = false;        ///< HX PI 133
  double stitch_length[7] = {};           ///< HX PM 7321 to 7327, mm
  double stitch_feed[2][8] = {};          ///< HX PM 7328 to 7335, 7344 to 7351: by axis of the plane, mm/min, 0 = any
  double stitch_wait_s[2][8] = {};        ///< HX PM 7336 to 7343, 7352 to 7359
  bool stitch_signals = false;            ///< HX PM 7308
  double stitch_call_s[2][8] = {};        ///< HX PM 7374 to 7389
  double stitch_release_s = 0, stitch_next_s = 0;  ///< HX PM 7395, 7394
  double stitch_longest = 0;              ///< HX PM 7408, mm, 0 = any
  // DGSHAPE settings
  bool calculator = false;
  uint8_t calculator_words = 0;       ///< 0 none, 1 all, 2 F, 3 IJKRXYZA
  bool calculator_reads_positions() const { return calculator && (calculator_words == 1 || calculator_words == 3); }
  bool calculator_reads_feed() const { return calculator && (calculator_words == 1 || calculator_words == 2); }

  /// Positions, lengths and dwell times without a point are in mm, inch, deg and s (M700 5.3 type II, DGSHAPE 3), and not in the least command unit.
  bool whole_positions() const { return decimal_type_2 || calculator_reads_positions(); }
  /// So is the depth of a peck, whose word is not among those to which the calculator type may be limited (DGSHAPE 1-5).
  bool whole_steps() const { return decimal_type_2 || (calculator && calculator_words == 1); }
};

/// The value of a parameter: a number, or a text, given by its place in the part system's store of texts.
struct ParameterValue {
  OptionalDouble number;  ///< absent = not set, or a text
  uint8_t text = 0;       ///< place of the text, from 1; 0 = there is none
  bool is_set() const { return text != 0 || number.has_value(); }
  JournalValue journalled() const { return JournalValue::of(number, text); }
  static ParameterValue of(JournalValue value) { return {value.as<OptionalDouble>(), value.kind}; }
};

class Parameters {
 public:
  /// A text keeps its place as long as a parameter has it, or `journal` could give it back to one.
  void create(unsigned capacity, Arena& arena, const Journal* journal = nullptr);
  bool has_text_place() const { return free_text_place() != 0; }  ///< there is room for a text more
  /// Sets a parameter from the text that the public interface gives: a number, a word of the family, or a text.
  nc_status set(const Dialect& dialect, const char* key, int axis, const char* text) {
    unsigned index = 0;
    ParameterValue old;
    return set(dialect, key, axis, text, &index, &old);
  }
  /// Sets it in the same way. restore(*index, *old) puts the previous value back.
  nc_status set(const Dialect& dialect, const char* key, int axis, const char* text, unsigned* index, ParameterValue* old);
  /// Sets a parameter, or one bit of it (-1 = the whole parameter), from a number or from a text.
  nc_status set(const Dialect& dialect, ParameterId id, int bit, int axis, double number, unsigned* index, ParameterValue* old);
  nc_status set(const Dialect& dialect, ParameterId id, int bit, int axis, const char* text, unsigned* index, ParameterValue* old);
  /// Sets a whole parameter by its meaning, to a number as the manual has it; `axis` is -1 for one of all axes. NC_E_NOT_FOUND: the family has no such parameter, or it is a bit of one.
  nc_status set(const Dialect& dialect, ParameterOf parameter, int axis, double number, unsigned* index, ParameterValue* old);
  void restore(unsigned index, ParameterValue old) { exchange(index, old); }
  /// Sets the value of an entry and returns the previous value.
  ParameterValue exchange(unsigned index, ParameterValue value) {
    const ParameterValue old = entries_[index].value();
    entries_[index].set(value);
    return old;
  }
  /// Entry `index` is a parameter that all part systems share.
  bool is_common(unsigned index) const { return entries_[index].common; }
  ParameterValue stored(unsigned index) const { return entries_[index].value(); }
  /// Finds the entry for the parameter of entry `index` of another part system; where it was never set here, an entry without a value is made. False: there
  /// is no room for one.
  bool same_entry(const Parameters& other, unsigned index, unsigned* there);
  /// Entry `index`, from 0 on: axis -1 = all axes; a value that is not set was taken back; false: behind the last entry.
  bool at(unsigned index, ParameterId* id, int* axis, ParameterValue* value) const;
  /// Value of a parameter or of a bit of it (-1 = the whole parameter). A text of at most six characters gives a number, one byte for the code of each
  /// character (#100010: "ASCII codes as decimal"). False: it was never set, or is a longer text.
  bool get(ParameterId id, int bit, int axis, double* value) const;
  /// Value of a parameter by its meaning. False also when the family has no such parameter.
  bool get(const Dialect& dialect, ParameterOf parameter, int axis, double* value) const;
  /// The text of a parameter that is set to a text of two or more characters; nullptr = it is not.
  const char* text(ParameterId id, int axis) const;
  const char* text(const ParameterValue& value) const { return value.text == 0 ? nullptr : texts_[value.text - 1]; }
  /// Sets what decides which filter parameters the machine accepts: the longest mean that fits behind interpolation, and whether it is the first part
  /// system.
  void set_filter_room(double longest_ms, bool first_system) {
    longest_filter_ms_ = longest_ms;
    first_system_ = first_system;
  }
  /// The typed values, to be asked for after changes.
  Settings settings(const Dialect& dialect) const;

 private:
  struct Entry {
    ParameterId id;
    int8_t axis;           ///< -1 = all axes
    bool common;           ///< all part systems share it
    uint8_t text;
    OptionalDouble number;
    ParameterValue value() const { return {number, text}; }
    void set(const ParameterValue& value) {
      number = value.number;
      text = value.text;
    }
  };
  static_assert(sizeof(Entry) == 16);
  Entry* find(ParameterId id, int axis) const;
  /// The entry for the axis, otherwise the one for all axes; nullptr = it is not set.
  const Entry* in_force(ParameterId id, int axis) const;
  Entry* add(ParameterId id, int axis, bool common);
  double with_bit(ParameterId id, int bit, int axis, bool on) const;
  nc_status put(ParameterId id, int bit, int axis, bool common, ParameterValue value, unsigned* index, ParameterValue* old);
  bool machine_takes(Parameter parameter, double value) const;
  uint8_t keep_text(const char* text);
  uint8_t free_text_place() const;
  static constexpr unsigned kCommon = 16;  ///< places for shared parameters, in addition to `capacity_`
  static constexpr unsigned kTexts = 128, kTextSize = 64;  ///< M700 13.11: at most 63 characters; a place whose text is not used any more is used again,
                                                          ///< the oldest first
  Entry* entries_ = nullptr;
  char (*texts_)[kTextSize] = nullptr;
  unsigned capacity_ = 0, count_ = 0, newest_text_ = 0;
  const Journal* journal_ = nullptr;
  double longest_filter_ms_ = kLongestMean;
  bool first_system_ = true;
};

}  // namespace nc
