// SPDX-License-Identifier: Apache-2.0
// Turns the parameters that are set into the typed values with which the interpreter works. Parameters are found by their meaning and never by their number,
// which belongs to the family (dialect/parameter_rows.hpp). A parameter that the family does not have counts as not set.
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>

#include "base/units.hpp"
#include "interpret/parameters.hpp"

namespace nc {
namespace {

using P = Parameter;

/// One bit for each of eight signals; no bit is set when the value is negative or too large.
uint8_t signals(double value) {
  return value >= 0 && value <= 4294967295.0 ? static_cast<uint8_t>(static_cast<uint32_t>(value) & 0xff) : uint8_t{0};
}

class SettingsReader {
 public:
  SettingsReader(const Parameters& parameters, const Dialect& dialect) : parameters_(parameters), dialect_(dialect) {}

  Settings read() {
    units();
    start();
    words();
    auxiliary();
    macros();
    feeds();
    cycles();
    curves();
    high_accuracy();
    fairing();
    filters();
    axes();
    work_turn();
    return s_;
  }

 private:
  double value(ParameterOf parameter, double fallback, int axis = -1) const {
    double found = fallback;
    if (parameters_.get(dialect_, parameter, axis, &found)) return found;
    for (const FixedParameter& row : dialect_.parameters->fixed)
      if (row.what == parameter.what) return row.value;
    return found;
  }
  bool flag(ParameterOf parameter) const { return value(parameter, 0) != 0; }
  /// The word of an axis whose name is given by a parameter, `fallback` where it is not set; kNoWord: it is blank, 0, or no letter.
  WordSlot axis_name(ParameterOf parameter, WordSlot fallback = kNoWord) const {
    const double code = value(parameter, std::numeric_limits<double>::quiet_NaN());
    return std::isnan(code) ? fallback : word_of_character(code);
  }
  /// Bit i: the parameter is on for axis i.
  uint32_t axes_with(Parameter parameter) const {
    uint32_t mask = 0;
    for (unsigned i = 0; i < kMaxAxes; ++i) mask |= value(parameter, 0, static_cast<int>(i)) != 0 ? 1u << i : 0;
    return mask;
  }

  void units();
  void start();
  void words();
  void auxiliary();
  void macros();
  void feeds();
  void cycles();
  void curves();
  void high_accuracy();
  void fairing();
  void filters();
  void axes();
  void one_axis(int axis);
  void work_turn();

  const Parameters& parameters_;
  const Dialect& dialect_;
  Settings s_;
};

/// Units: M700 2.1, 2.2, 5.3.
void SettingsReader::units() {
  const double finer = dialect_.rules.number.units_per_micrometre(value(P::setting_unit, 0));
  s_.setting_unit_mm = 0.001 / finer;
  s_.setting_unit_inch = 0.0001 / finer;
  s_.setting_unit_deg = 0.001 / finer;
  const RangeRules& range = dialect_.rules.range;
  s_.last_mm = range.end_of_positions_mm - s_.setting_unit_mm + Settings::kNoise;
  s_.last_deg = range.end_of_positions_mm - s_.setting_unit_deg + Settings::kNoise;
  s_.last_inch = (range.end_of_positions_inch - s_.setting_unit_inch) * kMillimetresPerInch + Settings::kNoise;
  const double cunit = value(P::command_unit, 0);
  s_.command_unit_mm = cunit > 0 ? cunit * 0.0001 : s_.setting_unit_mm;
  s_.command_unit_inch = cunit > 0 ? cunit * 0.00001 : s_.setting_unit_inch;
  s_.command_unit_deg = cunit > 0 ? cunit * 0.0001 : s_.setting_unit_deg;
  for (unsigned i = 0; i < kMaxAxes; ++i) {
    const double own = value(P::command_unit, cunit, static_cast<int>(i));
    if (own != cunit) s_.own_unit_axes |= 1u << i;
    s_.own_unit[i] = own > 0 ? own * 0.0001 : s_.setting_unit_mm;
  }
  s_.decimal_type_2 = flag(P::decimal_type_2);
  s_.tenfold = value(P::tenfold, 1);
  if (s_.tenfold == 0) s_.tenfold = 1;
  s_.calculator = flag(P::calculator);
  s_.calculator_words = static_cast<uint8_t>(value(P::calculator_words, s_.calculator ? 1 : 0));
}

/// What is in force at power on, and which codes exist.
void SettingsReader::start() {
  s_.start_inch = flag(P::start_inch);
  s_.initial_inch = flag(P::initial_inch);
  s_.start_absolute = value(P::start_absolute, 1) != 0;
  s_.start_linear = flag(P::start_linear);
  s_.start_stroke_check = flag(P::start_stroke_check);
  s_.start_scaling = flag(P::start_scaling);
  s_.start_rotation = flag(P::start_rotation);
  s_.start_synchronous = flag(P::start_synchronous);
  s_.start_high_accuracy = flag(P::start_high_accuracy);
  const double start_plane = value(P::start_plane, 1);  // 1 G17, 2 G18, 3 G19
  s_.start_plane = start_plane == 2 ? Function::plane_zx : start_plane == 3 ? Function::plane_yz : Function::plane_xy;
  s_.preset_allowed = value(P::code_type, 1) != 0;
  s_.high_accuracy_code = value(P::code_type, 0) == 0;
  s_.high_speed_codes = value(P::code_type, 1) != 0;
}

/// How texts are read, and what compensation does.
void SettingsReader::words() {
  for (unsigned unit = 1; unit <= 5; ++unit) s_.parity_units |= flag({P::parity_unit, unit - 1}) ? 1u << unit : 0;  // 3.6
  s_.semicolon_comments = flag(P::semicolon_comments);
  for (unsigned i = 0; i < 8; ++i) {
    const double m = value({P::reading_stop, i}, 0);
    s_.misc_codes.reading_stops[i] = m >= 1 && m <= dialect_.rules.range.largest_misc ? static_cast<uint32_t>(m) : 0;
    s_.misc_codes.any_reading_stop |= s_.misc_codes.reading_stops[i] != 0;
  }
  s_.tool_memory_2 = value(P::tool_memory_type, 1) == 2;
  s_.diameter_offsets = flag(P::diameter_offsets);
  s_.comp_type_b = flag(P::comp_type_b);
  s_.interference_check = dialect_.parameters->checks_interference && !flag(P::interference_ignored);
  s_.interference_avoid = flag(P::interference_avoided);
  s_.contour_check = s_.interference_check && flag(P::contour_checked);
  s_.corner_arcs = flag(P::corner_arcs);
  s_.space_divisor = value(P::space_divisor, 0);
  for (unsigned i = 0; i < 3; ++i) {
    s_.plane_basic[i] = axis_name({P::plane_axis, i}, dialect_.addresses.word(basic_along(i)));
    s_.plane_parallel[i] = axis_name({P::parallel_axis, i});
  }
  s_.scaling_factor = value(P::scaling_factor, 1);
  for (unsigned i = 0; i < kMaxAxes; ++i) s_.axis_factor[i] = value(P::axis_factor, 0, static_cast<int>(i)) / 1000;
  s_.rotation_deg = value(P::rotation_angle, 0);
}

/// M700 9, 10: M codes and the spindle.
void SettingsReader::auxiliary() {
  s_.codes_after_motion = flag(P::codes_after_motion);
  const double surface_axis = value(P::surface_axis, 0);
  s_.surface_axis = surface_axis >= 1 && surface_axis <= 3 ? static_cast<uint8_t>(surface_axis) : 0;
  s_.clamp_command_always = flag(P::clamp_command_always);
  s_.clamp_in_surface_speed_only = flag(P::clamp_in_surface_speed);
  s_.keeps_clamp = flag(P::keeps_clamp);
  s_.keeps_polar_command = flag(P::keeps_polar_command);
}

/// M700 13.4, 13.5, 13.12.
void SettingsReader::macros() {
  s_.macro_single = flag(P::macro_single);
  s_.macro_extensions = flag(P::macro_extensions);
  s_.negative_count = flag(P::negative_count);
  s_.print_blanks = flag(P::print_blanks);
  s_.asin_0_360 = flag(P::asin_0_360);
  s_.run_time_hours = flag(P::run_time_hours);
  const bool interrupts = dialect_.rules.program.macro_interrupt;
  if (interrupts) {
    s_.misc_codes.interrupt_on = misc_code(dialect_, MiscFunction::interrupt_on);
    s_.misc_codes.interrupt_off = misc_code(dialect_, MiscFunction::interrupt_off);
  }
  if (interrupts && flag(P::interrupt_own_m)) {  // 13.12: M codes 03 to 97, except 30
    const auto m_code = [this](Parameter parameter, uint32_t fallback) {
      const double m = value(parameter, fallback);
      const CodeRange range = dialect_.interrupt_misc;
      return m >= range.first && m <= range.last && goes_out(misc_function(dialect_, static_cast<unsigned>(m))) ? static_cast<uint32_t>(m) : fallback;
    };
    s_.misc_codes.interrupt_on = m_code(P::interrupt_on_m, s_.misc_codes.interrupt_on);
    s_.misc_codes.interrupt_off = m_code(P::interrupt_off_m, s_.misc_codes.interrupt_off);
  }
  s_.interrupt_by_level = flag(P::interrupt_by_level);
  s_.interrupt_type_2 = flag(P::interrupt_type_2);
  s_.interrupt_as_sub = flag(P::interrupt_as_sub);
  s_.reset_clears_common = flag(P::reset_clears_common);
  constexpr Parameter kLastShared[] = {P::last_shared_of_first, P::last_shared_of_second};
  for (unsigned i = 0; i < 2; ++i) {
    const double n = value(kLastShared[i], 0);
    const VariableRange range = dialect_.variables->divided[i];
    if (n >= range.first && n <= range.last) s_.last_shared[i] = static_cast<uint32_t>(n);
  }
}

/// M700 8.1, 13.1, 15: cycles, dwell, skip and measurement.
void SettingsReader::cycles() {
  s_.drilling_axis_z = flag(P::drilling_axis_z);
  s_.peck_clearance = value(P::peck_clearance, 0);
  // HX 12.3.3, 12.3.4: one parameter is of both.
  s_.step_clearance = parameter_row(dialect_, P::step_clearance) != nullptr ? value(P::step_clearance, 0) : s_.peck_clearance;
  s_.spindle_forward_m = static_cast<uint32_t>(value(P::spindle_forward_code, 0));
  s_.spindle_reverse_m = s_.spindle_forward_m + 1;
  s_.tap_synchronous = flag(P::tap_synchronous);
  if (flag(P::tap_by_code) && value(P::tap_code, 0) > 0) s_.misc_codes.synchronous_tap = static_cast<uint32_t>(value(P::tap_code, 0));
  s_.tap_to_r = flag(P::tap_to_r);
  s_.tap_clearance = value(P::tap_clearance, 0);
  s_.tap_checks = flag(P::tap_checks);
  s_.tap_check_approach = flag(P::tap_check_approach);
  s_.tap_check_bottom = flag(P::tap_check_bottom);
  s_.tap_check_r = flag(P::tap_check_r);
  s_.tap_dwell_s = value(P::tap_dwell, 0) / 1000;
  s_.tap_return = value(P::tap_return_override, 0) / 100;
  s_.life_managed = flag(P::life_managed);
  s_.life_by_tool = flag(P::life_by_tool);
  s_.tap_most_rev_min = value({P::spindle_most, 0}, 0);
  for (unsigned i = 0; i < 2; ++i) s_.tap_stage[i].rev_min = value({P::tap_speed, i}, 0);
  for (unsigned i = 0; i < 3; ++i) s_.tap_stage[i].seconds = value(i < 2 ? ParameterOf{P::tap_time, i} : ParameterOf{P::spindle_most, 1}, 0) / 1000;
  s_.shift_ignored = axes_with(P::shift_ignored);
  s_.shift_minus = axes_with(P::shift_minus);
  s_.shift_axis = static_cast<int8_t>(value(P::shift_axis, -1));
  const double minus = value(P::shift_direction, -1);
  s_.shift_direction = static_cast<int8_t>(minus < 0 ? 0 : minus != 0 ? -1 : 1);
  s_.dwell_p_decimal = flag(P::dwell_p_decimal);
  s_.dwell_in_revolutions = flag(P::dwell_in_revolutions);
  s_.box_outside = flag(P::box_outside);
  s_.dwell_skip = static_cast<uint8_t>(value(P::dwell_skip, 0));
  s_.skip_feed = value(P::skip_feed, 0);
  for (unsigned i = 0; i < Settings::kMultiSkips; ++i) {  // 15.3
    s_.multi_skip_mask[i] = signals(value({P::multi_skip_signals, i}, s_.multi_skip_mask[i]));
    s_.multi_skip_feed[i] = value({P::multi_skip_feed, i}, 0);
  }
  s_.measure_feed = value(P::measure_feed, 0);
  s_.measure_deceleration = value(P::measure_deceleration, 0);
  s_.measure_range = value(P::measure_range, 0);
}

/// Curves: M700 6, 13.18.
void SettingsReader::curves() {
  s_.arc_tolerance = value(P::arc_tolerance, dialect_.parameters->arc_tolerance_mm);
  s_.helix_plane_feed = flag(P::helix_plane_feed);
  s_.precision_lead = flag(P::precision_lead);
  s_.spiral_type_2 = flag(P::spiral_type_2);
  s_.spiral_tolerance = value(P::spiral_tolerance, s_.spiral_tolerance);
  s_.mill_axis = axis_name(P::mill_axis);
  s_.polar_linear = axis_name(P::polar_linear_axis);
  s_.hypothetical_by_name = flag(P::hypothetical_by_name);
  s_.cylinder_second_axis = flag(P::cylinder_second_axis);
  for (unsigned i = 0; i < 2; ++i) s_.polar_axis[i] = static_cast<uint8_t>(value({P::polar_axis, i}, 0));
  s_.exponential_linear = axis_name({P::exponential_axis, 0});
  s_.exponential_rotary = axis_name({P::exponential_axis, 1});
  s_.spline_allowed = flag(P::spline_allowed);
  s_.spline_cancel_angle = value(P::spline_cancel_angle, 0);
  s_.spline_minute_length = value(P::spline_minute_length, 0);
  if (s_.spline_minute_length == 0) s_.spline_minute_length = 1;  // 13.18 (1) (b)
  s_.spline_tolerance_inflected = value({P::spline_tolerance, 0}, 0);
  s_.spline_tolerance_arched = value({P::spline_tolerance, 1}, 0);
}

/// M700 13.15, 13.17.
void SettingsReader::high_accuracy() {
  s_.smooth_control = flag(P::smooth_control);
  s_.accuracy.target_mm_min = value(P::accuracy_speed, 0);
  s_.accuracy.time_ms = value(P::accuracy_time, 0);
  s_.accuracy.radius_percent = value(P::radius_percent, 0);
  s_.accuracy.corner_angle_deg = value(P::corner_angle, 0);
  s_.accuracy.separate = flag(P::separate_percents);
  s_.accuracy.corner_percent = value({P::corner_percent, 0}, 0);
  s_.accuracy.curve_percent = value({P::corner_percent, 1}, 0);
  s_.accuracy.acceleration_clamp = flag(P::acceleration_clamp);
  for (unsigned i = 0; i < kMaxAxes; ++i) {
    const int axis = static_cast<int>(i);
    s_.accuracy.rapid_mm_min[i] = value({P::accuracy_clamp, 0}, 0, axis);
    s_.accuracy.clamp_mm_min[i] = value({P::accuracy_clamp, 1}, 0, axis);
    s_.accuracy.corner_least_mm_min[i] = value(P::corner_least_speed, 0, axis);
  }
  if (flag(P::arc_joint_clamp)) s_.accuracy.arc_joint_mm_min = value(P::arc_joint_speed, 0);
}

/// M700 7.7, 13.15, 15.5.
void SettingsReader::filters() {
  FilterParameters& f = s_.filters;
  const auto number = [this](ParameterOf parameter, int axis = -1) { return value(parameter, 0, axis); };
  const bool rounds = number(P::arc_compensation) != 0 && number(P::arc_compensation_by_axis) != 0;  // #8108 acts only together with #8107
  for (unsigned i = 0; i < kMaxAxes; ++i) {
    const int axis = static_cast<int>(i);
    f.rapid.linear_ms[i] = number(P::rapid_linear, axis);
    f.rapid.exponential_ms[i] = number(P::rapid_exponential, axis);
    f.cut.linear_ms[i] = number(P::cut_linear, axis);
    f.cut.exponential_ms[i] = number(P::cut_exponential, axis);
    f.skip.linear_ms[i] = number(P::skip_linear, axis);
    f.skip.exponential_ms[i] = number(P::skip_exponential, axis);
    f.round_mm[i] = rounds ? number(P::arc_radius_shift, axis) : 0;
  }
  f.rapid_before = number(P::rapid_before) != 0;
  f.pattern_cut_ms = number({P::pattern_filter, 0});
  f.pattern_rapid_ms = number({P::pattern_filter, 1});
  f.pattern_second_ms = number(P::pattern_second);
  f.any = f.pattern_cut_ms > 0 || f.pattern_rapid_ms > 0 || f.pattern_second_ms > 0;
  for (unsigned i = 0; i < kMaxAxes; ++i) {
    for (const TimeConstants* constants : {&f.cut, &f.rapid, &f.skip})
      f.any = f.any || constants->linear_ms[i] > 0 || constants->exponential_ms[i] > 0;
    f.any = f.any || f.round_mm[i] != 0;
  }
}

/// M700 7.
void SettingsReader::feeds() {
  s_.feed_by_digit = flag(P::feed_by_digit);
  s_.digit_most = value(P::digit_most, 0);
  const double divisions = value(P::digit_divisions, 0);
  s_.digit_step = divisions > 0 ? s_.digit_most / divisions : 0;
  for (unsigned i = 0; i < 5; ++i) {
    s_.digit_feed[i] = value({P::digit_feed, i}, 0);
    if (s_.digit_most > 0 && s_.digit_feed[i] > s_.digit_most) s_.digit_feed[i] = s_.digit_most;
  }
  // 7.9 (a), (b): with #1306 = 0 rapid traverse and cutting have a parameter each, otherwise one parameter is for both.
  const bool in_position = flag(P::checks_position);
  s_.check_rapid = in_position;
  s_.check_cutting = flag(P::one_position_check) ? in_position : flag(P::checks_cutting);
  s_.check_reversal = flag(P::checks_reversal);
  s_.corner_override = value(P::corner_override, 0);
  s_.corner_angle = value(P::corner_override_angle, 0);
  s_.corner_zone = value(P::corner_override_zone, 0);
  s_.corner_behind = value(P::corner_behind, 0);
  s_.corner_feed = value(P::corner_feed, 0);
  s_.inner_arc_least = value(P::inner_arc_least, 0) / 100;
  s_.corners_always = flag(P::corner_always);
  s_.stays_behind_reset = flag(P::stays_behind_reset);
  for (unsigned i = 0; i < 7; ++i) s_.stitch_length[i] = value({P::stitch_length, i}, 0);
  for (unsigned i = 0; i < 8; ++i) {
    s_.stitch_feed[0][i] = value({P::stitch_feed, i}, 0);
    s_.stitch_feed[1][i] = value({P::stitch_feed_2, i}, 0);
    s_.stitch_wait_s[0][i] = value({P::stitch_wait, i}, 0) / 1000;
    s_.stitch_wait_s[1][i] = value({P::stitch_wait_2, i}, 0) / 1000;
    s_.stitch_call_s[0][i] = value({P::stitch_call, i}, 0) / 1000;
    s_.stitch_call_s[1][i] = value({P::stitch_call_2, i}, 0) / 1000;
  }
  s_.stitch_signals = flag(P::stitch_signals);
  s_.stitch_release_s = value(P::stitch_release, 0) / 1000;
  s_.stitch_next_s = value(P::stitch_next, 0) / 1000;
  s_.stitch_longest = value(P::stitch_longest, 0);
}

/// M700 13.13, 14.7, 14.13: parameters that each axis has for itself.
void SettingsReader::one_axis(int axis) {
  const auto number = [this, axis](ParameterOf parameter, double fallback) { return value(parameter, fallback, axis); };
  const uint32_t bit = 1u << axis;
  for (unsigned which = 0; which < 4; ++which)
    s_.reference[which][axis] = number({P::reference_position, which}, std::numeric_limits<double>::quiet_NaN());
  s_.tool_change[axis] = number(P::tool_change_position, 0);
  if (number(P::tool_change_axis, 0) != 0) s_.tool_change_axes |= bit;
  const double type = number(P::rotary_type, 3);
  if (type < 2) s_.turning |= bit;
  if (type == 1) s_.short_cut |= bit;
  if (type < 3) s_.machine_turn |= bit;
  s_.creep[axis] = number(P::creep, 0);
  s_.index_increment[axis] = number(P::index_increment, 0);
}

/// 13.17.1, additional functions (1) and (3).
void SettingsReader::fairing() {
  const auto number = [this](ParameterOf parameter) { return value(parameter, 0); };
  constexpr double kStandardAngle = 10;  // deg: #8020 in the standard values of 13.17.2
  constexpr double kDegree = std::numbers::pi / 180;
  const double angle = s_.accuracy.corner_angle_deg > 0 ? std::fmin(s_.accuracy.corner_angle_deg, 180) : kStandardAngle;
  s_.fairing.length_mm = number(P::fairing_length);
  s_.fairing.fairing = number(P::fairing) != 0 && s_.fairing.length_mm > 0;
  s_.fairing.corner_cos = std::cos(angle * kDegree);
  s_.fairing.judge_length_mm = number(P::judgement_length);
  s_.fairing.judge = number(P::corner_judgement) != 0 && s_.fairing.judge_length_mm > 0;
}

void SettingsReader::axes() {
  s_.rapid_dry = flag(P::rapid_dry);
  s_.rapid_by_axis = flag(P::rapid_by_axis);
  s_.index_axes = axes_with(P::index_axis);
  s_.no_reference = axes_with(P::no_reference);
  s_.mirror_axes = axes_with(P::mirrored);
  for (unsigned i = 0; i < kMaxAxes; ++i) one_axis(static_cast<int>(i));
}

/// M700 13.21.
void SettingsReader::work_turn() {
  for (unsigned i = 0; i < 2; ++i) {
    s_.work_turn_axis[i] = axis_name({P::work_turn_axis, i});
    s_.work_turn_center[i] = value({P::work_turn_center, i}, 0);
    s_.work_turn_vector[i] = value({P::work_turn_vector, i}, 0);
  }
  s_.work_turn_deg = value(P::work_turn_angle, 0);
}

}  // namespace

Settings Parameters::settings(const Dialect& dialect) const { return SettingsReader(*this, dialect).read(); }

}  // namespace nc
