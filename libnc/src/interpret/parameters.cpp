// SPDX-License-Identifier: Apache-2.0
#include "interpret/parameters.hpp"

#include <cmath>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <numbers>

#include "interpret/parameter_table.hpp"

namespace nc {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same_word(const char* word, size_t length, const char* text) {
  for (size_t i = 0; i < length; ++i)
    if (text[i] == 0 || lower(word[i]) != lower(text[i])) return false;
  return text[length] == 0;
}

/// Decimal number with sign and point; false when the text is anything else.
bool parse_number(const char* text, double* value) {
  bool negative = false;
  if (*text == '-' || *text == '+') negative = *text++ == '-';
  double number = 0, scale = 1;
  bool any = false, point = false;
  for (; *text != 0; ++text) {
    if (*text == '.' && !point) {
      point = true;
    } else if (is_digit(*text)) {
      any = true;
      if (point) scale *= 10;
      number = number * 10 + (*text - '0');
    } else {
      return false;
    }
  }
  *value = (negative ? -number : number) / scale;
  return any && std::isfinite(*value);
}

/// Index of `text` in "a|b|c", -1 when it is none of them.
int word_index(const char* words, const char* text) {
  int index = 0;
  for (const char* at = words;; ++index) {
    const char* bar = std::strchr(at, '|');
    const size_t length = bar != nullptr ? static_cast<size_t>(bar - at) : std::strlen(at);
    if (same_word(at, length, text)) return index;
    if (bar == nullptr) return -1;
    at = bar + 1;
  }
}

/// Values from here on are places of texts.
constexpr double kTextBase = 4503599627370496.0;  // 2^52: no parameter is as large

/// Letters, digits and signs, at most 63, a letter first.
bool is_text(const char* text) {
  if (lower(text[0]) < 'a' || lower(text[0]) > 'z') return false;
  size_t length = 0;
  for (; text[length] != 0; ++length)
    if (text[length] < ' ' || text[length] > '~') return false;
  return length <= 63;
}

/// An axis name, 0 = none (blank, 0, or a number that is no letter).
char axis_letter(double value) {
  if (!(value >= 'A' && value <= 'z')) return 0;
  const char letter = static_cast<char>(value);
  if (letter >= 'A' && letter <= 'Z') return letter;
  return letter >= 'a' ? static_cast<char>(letter - 'a' + 'A') : char{0};
}

/// A parameter as bits; what is no whole number of 32 bits has none set.
uint32_t bits_of(double value) { return value >= 0 && value <= 4294967295.0 ? static_cast<uint32_t>(value) : 0; }

}  // namespace

/// "1229" out of "1229/bit2".
const char* Parameters::whole_key(const char* key, const ParameterKey& parsed, char (&whole)[kKeySize]) {
  std::memcpy(whole, key, parsed.digits);
  whole[parsed.digits] = 0;
  return whole;
}

void Parameters::create(unsigned capacity, Arena& arena) {
  entries_ = arena.make<Entry>(capacity);
  texts_ = reinterpret_cast<char(*)[kTextSize]>(arena.make<char>(size_t{kTexts} * kTextSize));
  capacity_ = capacity;
}

/// Keys are compared as numbers: a hundred of them are looked for whenever a parameter has changed.
Parameters::Entry* Parameters::find(const char* key, int axis) const {
  uint64_t wanted[kKeySize / 8] = {}, there[kKeySize / 8];
  const size_t length = std::strlen(key);
  if (length >= kKeySize) return nullptr;
  std::memcpy(wanted, key, length);
  for (unsigned i = 0; i < count_; ++i) {
    std::memcpy(there, entries_[i].key, kKeySize);
    if (there[0] == wanted[0] && there[1] == wanted[1] && there[2] == wanted[2] && entries_[i].axis == axis) return &entries_[i];
  }
  return nullptr;
}

nc_status Parameters::set(const Dialect& dialect, const char* key, int axis, const char* text, unsigned* index, double* old) {
  if (key == nullptr || text == nullptr || std::strlen(key) >= kKeySize) return NC_E_NOT_FOUND;
  double value = 0;
  ParameterKey parsed{};
  parsed.bit = -1;
  const ParameterName* named = nullptr;
  for (const ParameterName& row : dialect.parameters)
    if (std::strcmp(row.key, key) == 0) named = &row;
  if (named != nullptr && named->words != nullptr) {
    const int word = word_index(named->words, text);
    if (word < 0) return NC_E_ARGUMENT;
    value = word;
  } else if (named == nullptr && (dialect.id != NC_DIALECT_M700 || !parse_parameter_key(key, &parsed))) {
    return NC_E_NOT_FOUND;
  } else {
    // #1003 takes the letters of 2.1; any letter is stored by its code.
    if (!parse_number(text, &value)) {
      if (parsed.bit >= 0 || named != nullptr || !is_text(text)) return NC_E_ARGUMENT;
      const bool letter = text[1] == 0;
      if (!letter && parameter_used(dialect, key)) return NC_E_ARGUMENT;  // none of these is a text of several characters
      value = letter ? static_cast<unsigned char>(text[0]) : keep_text(text);
    } else if (!(value < kTextBase)) {
      return NC_E_ARGUMENT;
    }
    if (named != nullptr && value < 0) return NC_E_ARGUMENT;
    if (named == nullptr && parsed.bit < 0 && value < kTextBase && !parameter_takes(parsed, value)) return NC_E_ARGUMENT;
    if (named == nullptr && parsed.bit < 0 && value < kTextBase && !machine_takes(parsed.number, value)) return NC_E_ARGUMENT;
  }
  char whole[kKeySize];
  if (parsed.bit >= 0) {  // one bit of a parameter: the others stay
    if (value != 0 && value != 1) return NC_E_ARGUMENT;
    whole_key(key, parsed, whole);
    double before = 0;
    get(whole, axis, &before);
    const uint32_t mask = uint32_t{1} << parsed.bit;
    value = value != 0 ? bits_of(before) | mask : bits_of(before) & ~mask;
    key = whole;
  }
  Entry* entry = find(key, axis);
  if (entry == nullptr) {
    if (count_ == capacity_) return NC_E_MEMORY;
    entry = &entries_[count_++];
    std::memset(entry->key, 0, kKeySize);
    std::strcpy(entry->key, key);
    entry->axis = static_cast<int8_t>(axis);
    entry->value = std::numeric_limits<double>::quiet_NaN();
  }
  *index = static_cast<unsigned>(entry - entries_);
  *old = entry->value;
  entry->value = value;
  return NC_OK;
}

bool Parameters::get(const char* key, int axis, double* value) const {
  ParameterKey parsed;
  char whole[kKeySize];
  const int bit = parse_parameter_key(key, &parsed) ? parsed.bit : -1;
  const char* name = bit >= 0 ? whole_key(key, parsed, whole) : key;
  const Entry* entry = find(name, axis);
  if ((entry == nullptr || std::isnan(entry->value)) && axis >= 0) entry = find(name, -1);
  if (entry == nullptr || std::isnan(entry->value)) return false;
  if (entry->value >= kTextBase) {
    const char* at = texts_[static_cast<unsigned>(entry->value - kTextBase)];
    double codes = 0;
    unsigned length = 0;
    for (; at[length] != 0; ++length) codes = codes * 256 + static_cast<unsigned char>(at[length]);
    *value = codes;
    return bit < 0 && length <= 6;
  }
  *value = bit >= 0 ? (bits_of(entry->value) >> bit) & 1 : entry->value;
  return true;
}

/// What the table cannot know.
bool Parameters::machine_takes(uint32_t number, double value) const {
  switch (number) {
    case 1205:  // M700 13.15, precaution (5): with one part system only, else Y51 parameter error 17
      return value == 0 || first_system_;
    case 2004:
    case 2007:
    case 2102:
      return value <= longest_filter_ms_;
    case 1568:
    case 1569:
    case 1570:  // two of them stand one behind the other
      return value <= 0.5 * longest_filter_ms_;
    default:
      return true;
  }
}

/// M700 7.7, 13.15, 15.5.
void Parameters::filter_settings(FilterParameters* filters) const {
  const auto number = [this](const char* key, int axis = -1) {
    double value = 0;
    get(key, axis, &value);
    return value;
  };
  const bool rounds = number("8107") != 0 && number("8108") != 0;  // #8108 holds only with #8107
  for (unsigned i = 0; i < kMaxAxes; ++i) {
    const int axis = static_cast<int>(i);
    filters->rapid.linear_ms[i] = number("2004", axis);
    filters->rapid.exponential_ms[i] = number("2005", axis);
    filters->cut.linear_ms[i] = number("2007", axis);
    filters->cut.exponential_ms[i] = number("2008", axis);
    filters->skip.linear_ms[i] = number("2102", axis);
    filters->skip.exponential_ms[i] = number("2103", axis);
    filters->round_mm[i] = rounds ? number("2069", axis) : 0;
  }
  filters->rapid_before = number("1205") != 0;
  filters->pattern_cut_ms = number("1568");
  filters->pattern_rapid_ms = number("1569");
  filters->pattern_second_ms = number("1570");
  filters->any = filters->pattern_cut_ms > 0 || filters->pattern_rapid_ms > 0 || filters->pattern_second_ms > 0;
  for (unsigned i = 0; i < kMaxAxes; ++i) {
    for (const TimeConstants* constants : {&filters->cut, &filters->rapid, &filters->skip})
      filters->any = filters->any || constants->linear_ms[i] > 0 || constants->exponential_ms[i] > 0;
    filters->any = filters->any || filters->round_mm[i] != 0;
  }
}

/// M700 7, 8.1.
void Parameters::feed_settings(Settings& s) const {
  auto number = [this](const char* key, double fallback) {
    double value = fallback;
    get(key, -1, &value);
    return value;
  };
  s.start_synchronous = number("1074", 0) != 0;
  s.feed_by_digit = number("1079", 0) != 0;
  s.digit_most = number("1506", 0);
  const double divisions = number("1507", 0);
  s.digit_step = divisions > 0 ? s.digit_most / divisions : 0;
  const char* const speeds[] = {"1185", "1186", "1187", "1188", "1189"};
  for (unsigned i = 0; i < 5; ++i) {
    s.digit_feed[i] = number(speeds[i], 0);
    if (s.digit_most > 0 && s.digit_feed[i] > s.digit_most) s.digit_feed[i] = s.digit_most;
  }
  // 7.9 (a), (b): with #1306 = 0 rapid traverse and cutting have a parameter each, else one for both.
  const bool in_position = number("1193", 0) != 0;
  s.check_rapid = in_position;
  s.check_cutting = number("1306", 0) != 0 ? in_position : number("1223/bit1", 0) != 0;
  s.check_reversal = number("1503", 0) != 0;
  s.corner_override = number("8007", 0);
  s.corner_angle = number("8008", 0);
  s.corner_zone = number("8009", 0);
  s.dwell_skip = static_cast<uint8_t>(number("1173", 0));
}

/// M700 13.13, 14.7, 14.13: what stands for each axis.
void Parameters::axis_settings(int axis, Settings* s) const {
  const auto number = [this, axis](const char* key, double fallback) {
    double value = fallback;
    get(key, axis, &value);
    return value;
  };
  const uint32_t bit = 1u << axis;
  // #2037 is printed; the 2nd to 4th have the numbers behind it.
  for (unsigned which = 0; which < 4; ++which) {
    constexpr const char* kKeys[4] = {"2037", "2038", "2039", "2040"};
    s->reference[which][axis] = number(kKeys[which], std::numeric_limits<double>::quiet_NaN());
  }
  s->tool_change[axis] = number("8206", 0);
  if (number("1092", 0) != 0) s->tool_change_axes |= bit;
  const double type = number("8213", 3);
  if (type < 2) s->turning |= bit;
  if (type == 1) s->short_cut |= bit;
  if (type < 3) s->machine_turn |= bit;
}

double Parameters::keep_text(const char* text) {
  const unsigned place = text_count_++ % kTexts;
  std::strcpy(texts_[place], text);
  return kTextBase + place;
}

const char* Parameters::text(const char* key, int axis) const {
  const Entry* entry = find(key, axis);
  if (entry == nullptr && axis >= 0) entry = find(key, -1);
  if (entry == nullptr || !(entry->value >= kTextBase)) return nullptr;
  return texts_[static_cast<unsigned>(entry->value - kTextBase)];
}

bool Parameters::at(unsigned index, const char** key, int* axis, double* value, const char** text) const {
  if (index >= count_) return false;
  const Entry& entry = entries_[index];
  *key = entry.key;
  *axis = entry.axis;
  *value = entry.value;
  *text = entry.value >= kTextBase ? texts_[static_cast<unsigned>(entry.value - kTextBase)] : nullptr;
  return true;
}

/// 13.17.1, additional functions (1) and (3).
void Parameters::fairing_settings(Settings& s) const {
  auto number = [this](const char* key) {
    double value = 0;
    get(key, -1, &value);
    return value;
  };
  constexpr double kStandardAngle = 10;  // deg: #8020 in the standard values of 13.17.2
  constexpr double kDegree = std::numbers::pi / 180;
  const double angle = s.accuracy.corner_angle_deg > 0 ? std::fmin(s.accuracy.corner_angle_deg, 180) : kStandardAngle;
  s.fairing.length_mm = number("8029");
  s.fairing.fairing = number("8033") != 0 && s.fairing.length_mm > 0;
  s.fairing.corner_cos = std::cos(angle * kDegree);
  s.fairing.judge_length_mm = number("8037");
  s.fairing.judge = number("8036") != 0 && s.fairing.judge_length_mm > 0;
}

Settings Parameters::settings(const Dialect& dialect) const {
  Settings s;
  auto number = [this](const char* key, double fallback, int axis = -1) {
    double value = fallback;
    get(key, axis, &value);
    return value;
  };
  auto flag = [&number](const char* key) { return number(key, 0) != 0; };
  for (auto& place : s.reference)
    for (double& coordinate : place) coordinate = std::numeric_limits<double>::quiet_NaN();
  if (dialect.id == NC_DIALECT_DGSHAPE) {
    s.calculator = number("interpretation", 0) != 0;
    s.calculator_words = static_cast<uint8_t>(number("calculator_words", s.calculator ? 1 : 0));
    s.comp_type_b = number("startup", 0) != 0;
    s.arc_tolerance = 0.01;  // the manual gives none; docs/decisions.md
    return s;
  }
  // M700 2.1: #1003 B C D E, each ten times finer.
  double finer = 1;
  const int letter = static_cast<int>(number("1003", 'B'));
  for (int i = 'B'; i < letter && i < 'E'; ++i) finer *= 10;
  s.setting_unit_mm = 0.001 / finer;
  s.setting_unit_inch = 0.0001 / finer;
  s.setting_unit_deg = 0.001 / finer;
  s.last_mm = 100000 - s.setting_unit_mm + Settings::kNoise;
  s.last_deg = 100000 - s.setting_unit_deg + Settings::kNoise;
  s.last_inch = (10000 - s.setting_unit_inch) * 25.4 + Settings::kNoise;
  const double cunit = number("1015", 0);
  s.command_unit_mm = cunit > 0 ? cunit * 0.0001 : s.setting_unit_mm;
  s.command_unit_inch = cunit > 0 ? cunit * 0.00001 : s.setting_unit_inch;
  s.command_unit_deg = cunit > 0 ? cunit * 0.0001 : s.setting_unit_deg;
  for (unsigned i = 0; i < kMaxAxes; ++i) {
    const double own = number("1015", cunit, static_cast<int>(i));
    if (own != cunit) s.own_unit_axes |= 1u << i;
    s.own_unit[i] = own > 0 ? own * 0.0001 : s.setting_unit_mm;
  }
  s.decimal_type_2 = flag("1078");
  s.scaling_factor = number("8072", 1);
  s.work_turn_axis[0] = axis_letter(number("8621", 0));
  s.work_turn_axis[1] = axis_letter(number("8622", 0));
  s.work_turn_center[0] = number("8623", 0);
  s.work_turn_center[1] = number("8624", 0);
  s.work_turn_vector[0] = number("8625", 0);
  s.work_turn_vector[1] = number("8626", 0);
  s.work_turn_deg = number("8627", 0);
  const char* const parity[] = {"9115", "9215", "9315", "9415", "9515"};  // 3.6
  for (unsigned unit = 1; unit <= 5; ++unit) s.parity_units |= flag(parity[unit - 1]) ? 1u << unit : 0;
  s.tenfold = number("UNIT*10", 1);
  if (s.tenfold == 0) s.tenfold = 1;
  s.dwell_p_decimal = flag("8112");
  s.arc_tolerance = number("1084", s.arc_tolerance);
  s.drilling_axis_z = flag("1080");
  s.tool_memory_2 = number("1037", 1) == 2;
  s.diameter_offsets = flag("8117");
  s.comp_type_b = flag("1229/bit2");
  s.interference_check = !flag("8103");
  s.interference_avoid = flag("8102");
  s.skip_feed = number("1174", 0);
  const auto signals = [&number](const char* key, uint8_t fallback) { return static_cast<uint8_t>(bits_of(number(key, fallback)) & 0xff); };
  for (unsigned i = 0; i < 3; ++i) {  // 15.3
    const char mask[5] = {'1', '1', '7', static_cast<char>('5' + 2 * i), 0};
    const char feed[5] = {'1', '1', i == 2 ? '8' : '7', i == 2 ? '0' : static_cast<char>('6' + 2 * i), 0};
    s.multi_skip_mask[i] = signals(mask, s.multi_skip_mask[i]);
    s.multi_skip_feed[i] = number(feed, 0);
  }
  s.measure_feed = number("8004", 0);
  s.measure_deceleration = number("8005", 0);
  s.measure_range = number("8006", 0);
  s.peck_clearance_83 = number("8013", 0);
  s.peck_clearance_73 = number("8012", 0);
  s.macro_single = flag("8101");
  for (unsigned i = 0; i < 8; ++i) {
    const char key[] = {'P', 'R', 'E', 'R', 'E', 'A', 'D', '_', 'S', 'T', 'O', 'P', '_', 'M', static_cast<char>('1' + i), 0};
    const double m = number(key, 0);
    s.reading_stops[i] = m >= 1 && m <= 99999999 ? static_cast<uint32_t>(m) : 0;
    s.any_reading_stop |= s.reading_stops[i] != 0;
  }
  s.codes_after_motion = flag("MSTB_AFTER_MOTION");
  const double surface_axis = number("1181", 0);
  s.surface_axis = surface_axis >= 1 && surface_axis <= 3 ? static_cast<uint8_t>(surface_axis) : 0;
  s.clamp_command_always = flag("1146");
  s.clamp_in_g96_only = flag("1227/bit5");
  s.keeps_clamp = flag("1210/bit19");
  s.keeps_polar_command = flag("1210/bit11");
  const auto axes = [&number](const char* key) {
    uint32_t mask = 0;
    for (unsigned i = 0; i < kMaxAxes; ++i) mask |= number(key, 0, static_cast<int>(i)) != 0 ? 1u << i : 0;
    return mask;
  };
  s.index_axes = axes("2076");
  s.no_reference = axes("2031");
  s.mirror_axes = axes("8211");
  s.rapid_by_axis = flag("1086");
  s.semicolon_comments = flag("semicolon_comments");
  s.macro_extensions = flag("macro_extensions");
  s.negative_count = flag("negative_count");
  if (flag("1109")) {  // M700 13.12: M codes 03 to 97 but 30
    const auto m_code = [&number](const char* key, uint32_t fallback) {
      const double m = number(key, fallback);
      return m >= 3 && m <= 97 && m != 30 ? static_cast<uint32_t>(m) : fallback;
    };
    s.interrupt_on_m = m_code("1110", 96);
    s.interrupt_off_m = m_code("1111", 97);
  }
  s.interrupt_by_level = flag("1112");
  s.interrupt_type_2 = flag("1113");
  s.interrupt_as_sub = flag("1229/bit0");
  s.reset_clears_common = flag("1128");
  const auto last_shared = [&number](const char* key, uint32_t first, uint32_t last, uint32_t fallback) {
    const double n = number(key, 0);
    return n >= first && n <= last ? static_cast<uint32_t>(n) : fallback;
  };
  s.shared_100 = last_shared("1303", 100, 199, 0);
  s.shared_500 = last_shared("1304", 500, 999, s.shared_500);
  s.print_blanks = flag("DPRNT_BLANK");
  s.asin_0_360 = flag("1273/bit0");
  s.preset_allowed = number("1267/bit0", 1) != 0;
  s.run_time_hours = flag("1273/bit1");
  s.start_inch = flag("1152");
  s.start_absolute = number("1073", 1) != 0;
  for (unsigned i = 0; i < 3; ++i) {
    const char basic[5] = {'1', '0', '2', static_cast<char>('6' + i), 0};
    const char parallel[5] = {'1', '0', i == 0 ? '2' : '3', i == 0 ? '9' : static_cast<char>('0' + i - 1), 0};
    s.plane_basic[i] = axis_letter(number(basic, s.plane_basic[i]));
    s.plane_parallel[i] = axis_letter(number(parallel, 0));
  }
  const double start_plane = number("1025", 1);  // 1 G17, 2 G18, 3 G19
  s.start_plane = start_plane == 2 ? 180 : start_plane == 3 ? 190 : 170;
  s.helix_plane_feed = flag("1235/bit0");
  s.precision_lead = flag("1229/bit1");
  s.spiral_type_2 = flag("1272/bit2");
  s.spiral_tolerance = number("8075", s.spiral_tolerance);
  s.mill_axis = axis_letter(number("1516", 0));
  s.polar_linear = axis_letter(number("1533", 0));
  s.hypothetical_by_name = flag("1517");
  s.exponential_linear = axis_letter(number("1514", 0));
  s.exponential_rotary = axis_letter(number("1515", 0));
  feed_settings(s);
  s.high_accuracy_code = number("1267/bit0", 0) == 0;
  s.high_speed_codes = number("1267/bit0", 1) != 0;
  s.start_high_accuracy = flag("1148");
  s.smooth_control = flag("8090");
  s.spline_allowed = flag("8025");
  s.spline_cancel_angle = number("8026", 0);
  s.spline_minute_length = number("8030", 0);
  if (s.spline_minute_length == 0) s.spline_minute_length = 1;  // 13.18 (1) (b)
  s.spline_tolerance_inflected = number("8027", 0);
  s.spline_tolerance_arched = number("8028", 0);
  s.accuracy.target_mm_min = number("1206", 0);
  s.accuracy.time_ms = number("1207", 0);
  s.accuracy.radius_percent = number("8019", 0);
  s.accuracy.corner_angle_deg = number("8020", 0);
  s.accuracy.separate = flag("8021");
  s.accuracy.corner_percent = number("8022", 0);
  s.accuracy.curve_percent = number("8023", 0);
  s.accuracy.acceleration_clamp = flag("8034");
  for (unsigned i = 0; i < kMaxAxes; ++i) {
    const int axis = static_cast<int>(i);
    s.accuracy.clamp_mm_min[i] = number("2110", 0, axis);
    s.accuracy.rapid_mm_min[i] = number("2109", 0, axis);
    s.accuracy.corner_least_mm_min[i] = number("2096", 0, axis);
  }
  if (flag("1149")) s.accuracy.arc_joint_mm_min = number("1209", 0);
  fairing_settings(s);
  filter_settings(&s.filters);
  for (unsigned i = 0; i < kMaxAxes; ++i) s.creep[i] = number("8209", 0, static_cast<int>(i));
  for (unsigned i = 0; i < kMaxAxes; ++i) axis_settings(static_cast<int>(i), &s);
  for (unsigned i = 0; i < kMaxAxes; ++i) s.index_increment[i] = number("2106", 0, static_cast<int>(i));
  return s;
}

}  // namespace nc
