// SPDX-License-Identifier: Apache-2.0
// nc_config_init_sized, nc_config_check, nc_variable_range_check: the values that a configuration may have, and which member is refused.
#include <cmath>
#include <cstring>
#include <iterator>

#include "base/struct_size.hpp"
#include "control/config.hpp"
#include "control/control.hpp"
#include "control/vendor_check.hpp"
#include "dialect/common_options.hpp"

namespace {

using nc::CommonRanges;

constexpr double kMostLimit = 1e12;  ///< mm/s, mm/s^2 ...: products of such limits stay finite
constexpr double kMostPlace = 1e9;   ///< mm or deg

/// Path of a member as it is written in C, put together from the outside inwards; a path that is too long is cut.
class Path {
 public:
  Path& member(const char* name) {
    if (size_ != 0) put('.');
    for (; *name != 0; ++name) put(*name);
    return *this;
  }
  Path& element(unsigned index) {
    put('[');
    if (index >= 10) put(static_cast<char>('0' + index / 10 % 10));
    put(static_cast<char>('0' + index % 10));
    put(']');
    return *this;
  }
  void write(char (&to)[sizeof(nc_config_fault::field)]) const { std::memcpy(to, text_, sizeof to); }

 private:
  void put(char c) {
    if (size_ + 1 < sizeof text_) text_[size_++] = c;
  }
  char text_[sizeof(nc_config_fault::field)] = {};
  size_t size_ = 0;
};

/// Checks a configuration up to the first fault; members behind it are not looked at.
class Check {
 public:
  explicit Check(const nc_config& config) : c_(config) {}
  bool passes();
  const nc_config_fault& fault() const { return fault_; }

 private:
  bool refuse(const Path& path, const char* reason, bool not_finite = false) {
    path.write(fault_.field);
    size_t size = 0;
    const auto append = [&](const char* text) {
      for (; *text != 0 && size + 1 < sizeof fault_.reason; ++text) fault_.reason[size++] = *text;
    };
    if (not_finite) append("is no finite number; ");
    append(reason);
    return false;
  }
  /// False for NaN, too.
  bool within(const Path& path, double value, double least, double most, const char* reason) {
    return (value >= least && value <= most) || refuse(path, reason, !std::isfinite(value));
  }
  template <size_t kCount>
  bool unused(const Path& path, const double (&reserved)[kCount]) {
    for (const double value : reserved)
      if (!(value == 0)) return refuse(path, "must be 0: a later version of the library may give it a meaning");
    return true;
  }
  bool sizes();
  bool system(unsigned index);
  bool axis(unsigned system, unsigned index);
  bool c_axis(unsigned system, unsigned index);
  bool motion();
  bool optimal_axis(unsigned system, unsigned index);
  bool ranges();
  bool vendor();

  static Path axis_path(unsigned system, unsigned index) { return Path().member("system").element(system).member("axis").element(index); }

  const nc_config& c_;
  nc_config_fault fault_{};
};

/// One number of an axis.
struct AxisRule {
  const char* name;
  double nc_axis_config::*value;
  double least, most;
  const char* reason;
};

constexpr AxisRule kAxisRules[] = {
    {"rapid", &nc_axis_config::rapid, 0, kMostLimit, "must be 0 to 1e12 mm/s or deg/s; 0 = max_velocity"},
    {"max_velocity", &nc_axis_config::max_velocity, 0, kMostLimit, "must be 0 to 1e12 mm/s or deg/s; 0 = no limit"},
    {"max_acceleration", &nc_axis_config::max_acceleration, 0, kMostLimit, "must be 0 to 1e12 mm/s^2 or deg/s^2; 0 = no limit"},
    {"max_jerk", &nc_axis_config::max_jerk, 0, kMostLimit, "must be 0 to 1e12 mm/s^3 or deg/s^3; 0 = no limit"},
    {"in_position", &nc_axis_config::in_position, 0, kMostLimit, "must be 0 to 1e12 mm or deg"},
};

/// What the time-optimal law needs of every axis.
constexpr AxisRule kOptimalRules[] = {
    {"max_velocity", &nc_axis_config::max_velocity, 0, 0, "must be above 0: NC_MOTION_OPTIMAL needs it on every axis"},
    {"max_acceleration", &nc_axis_config::max_acceleration, 0, 0, "must be above 0: NC_MOTION_OPTIMAL needs it on every axis"},
    {"max_jerk", &nc_axis_config::max_jerk, 0, 0, "must be above 0: NC_MOTION_OPTIMAL needs it on every axis"},
};

/// One size of the control.
struct SizeRule {
  const char* name;
  uint32_t nc_config::*value;
  uint32_t least, most;
  const char* reason;
};

constexpr SizeRule kSizeRules[] = {
    {"programs", &nc_config::programs, 1, 65535, "must be 1 to 65535"},
    {"tool_offsets", &nc_config::tool_offsets, 1, 999, "must be 1 to 999"},
    {"work_offsets", &nc_config::work_offsets, 0, 300, "must be 0 to 300"},
    {"window_bytes", &nc_config::window_bytes, 512, 1u << 24, "must be 512 to 16777216"},
    {"contour_blocks", &nc_config::contour_blocks, 16, 1000000, "must be 16 to 1000000"},
};

bool power_of_two(uint32_t n) { return n != 0 && (n & (n - 1)) == 0; }

bool Check::passes() {
  if (!nc::known(c_.dialect)) return refuse(Path().member("dialect"), "must be an nc_dialect");
  if (c_.system_count < 1 || c_.system_count > NC_MAX_SYSTEMS) return refuse(Path().member("system_count"), "must be 1 to 4");
  for (unsigned i = 0; i < c_.system_count; ++i)
    if (!system(i)) return false;
  return sizes() && motion() && ranges() && vendor();
}

bool Check::sizes() {
  if (!within(Path().member("cycle_s"), c_.cycle_s, 1e-6, 0.1, "must be 0.000001 to 0.1 s")) return false;
  if (!power_of_two(c_.look_ahead) || c_.look_ahead < 64 || c_.look_ahead > 65536)
    return refuse(Path().member("look_ahead"), "must be a power of two, 64 to 65536");
  for (const SizeRule& rule : kSizeRules)
    if (c_.*rule.value < rule.least || c_.*rule.value > rule.most) return refuse(Path().member(rule.name), rule.reason);
  if (!nc::is_common_option(c_.variable_sets)) return refuse(Path().member("variable_sets"), "must be 100, 200, 300 or 600");
  return within(Path().member("max_feed_override"), c_.max_feed_override, 1, 10, "must be 1 to 10; 1 = 100 %");
}

bool Check::system(unsigned index) {
  const nc_system_config& s = c_.system[index];
  const Path path = Path().member("system").element(index);
  if (s.axis_count < 1 || s.axis_count > NC_MAX_AXES) return refuse(Path(path).member("axis_count"), "must be 1 to 8");
  if (s.spindle_count > NC_MAX_SPINDLES) return refuse(Path(path).member("spindle_count"), "must be 0 to 4; 0 = one");
  if (s.spindle_unsigned >> (s.spindle_count == 0 ? 1 : s.spindle_count) != 0)
    return refuse(Path(path).member("spindle_unsigned"), "must have bits of spindles that there are: bit 0 to spindle_count - 1");
  if (s.tool_axis > NC_TOOL_AXIS_MECHANICAL_B) return refuse(Path(path).member("tool_axis"), "must be an nc_tool_axis");
  for (unsigned i = 0; i < s.axis_count; ++i)
    if (!axis(index, i)) return false;
  return unused(Path(path).member("reserved"), s.reserved);
}

bool Check::axis(unsigned system, unsigned index) {
  const nc_system_config& s = c_.system[system];
  const nc_axis_config& a = s.axis[index];
  const Path path = axis_path(system, index);
  if (a.name == 0 || std::strchr("ABCUVWXYZ", a.name) == nullptr)
    return refuse(Path(path).member("name"), "must be one of the letters A B C U V W X Y Z");
  for (unsigned i = 0; i < index; ++i)
    if (s.axis[i].name == a.name) return refuse(Path(path).member("name"), "is the name of an axis before it in the same part system");
  for (const AxisRule& rule : kAxisRules)
    if (!within(Path(path).member(rule.name), a.*rule.value, rule.least, rule.most, rule.reason)) return false;
  constexpr const char* kPlace = "must be -1e9 to 1e9 mm or deg";
  for (unsigned i = 0; i < std::size(a.reference); ++i)
    if (!within(Path(path).member("reference").element(i), a.reference[i], -kMostPlace, kMostPlace, kPlace)) return false;
  if (a.soft_limited) {
    if (!within(Path(path).member("soft_min"), a.soft_min, -kMostPlace, kMostPlace, kPlace)) return false;
    if (!within(Path(path).member("soft_max"), a.soft_max, -kMostPlace, kMostPlace, kPlace)) return false;
    if (!(a.soft_min < a.soft_max)) return refuse(Path(path).member("soft_max"), "must be above soft_min while soft_limited is true");
  }
  return c_axis(system, index) && unused(Path(path).member("reserved"), a.reserved);
}

/// M700 10.5: the spindle of a C axis must exist, and must not be the spindle of another axis.
bool Check::c_axis(unsigned system, unsigned index) {
  const nc_system_config& s = c_.system[system];
  const nc_axis_config& a = s.axis[index];
  if (a.spindle == 0) return true;
  const Path path = axis_path(system, index).member("spindle");
  if (!a.rotary) return refuse(path, "must be 0: only a rotary axis can be a spindle");
  if (a.spindle > (s.spindle_count == 0 ? 1 : s.spindle_count)) return refuse(path, "must be the number of a spindle, 1 to spindle_count");
  for (unsigned i = 0; i < index; ++i)
    if (s.axis[i].spindle == a.spindle) return refuse(path, "is the spindle of an axis before it in the same part system");
  return true;
}

bool Check::motion() {
  if (c_.path_tolerance != 0 &&
      !within(Path().member("path_tolerance"), c_.path_tolerance, 1e-5, 10, "must be 0, or 0.00001 to 10 mm"))
    return false;
  if (!within(Path().member("retract_overlap"), c_.retract_overlap, 0, 100, "must be 0 to 100 mm")) return false;
  if (!within(Path().member("tap_most_apart"), c_.tap_most_apart, 0.05, 100, "must be 0.05 to 100 revolutions")) return false;
  if (c_.motion_mode == NC_MOTION_TRAPEZOID) return true;
  if (c_.motion_mode != NC_MOTION_OPTIMAL) return refuse(Path().member("motion_mode"), "must be an nc_motion_mode");
  for (unsigned i = 0; i < c_.system_count; ++i)
    for (unsigned k = 0; k < c_.system[i].axis_count; ++k)
      if (!optimal_axis(i, k)) return false;
  return true;
}

bool Check::optimal_axis(unsigned system, unsigned index) {
  for (const AxisRule& rule : kOptimalRules)
    if (!(c_.system[system].axis[index].*rule.value > 0)) return refuse(axis_path(system, index).member(rule.name), rule.reason);
  return true;
}

bool Check::ranges() {
  for (unsigned i = 0; i < NC_VARIABLE_RANGES; ++i) {
    uint32_t taken = 0;
    if (nc_variable_range_check(&c_, i, &taken) == NC_OK) continue;
    return refuse(Path().member("variable_ranges").element(i),
                  taken != 0 ? "has variables that exist already: common ones by option, those of another range, or system variables"
                             : "must be 34 to 999999, last not before first, at most 10000 variables; both 0 = none");
  }
  return true;
}

bool Check::vendor() {
  if (c_.vendor_code_count > NC_MAX_VENDOR_CODES) return refuse(Path().member("vendor_code_count"), "must be 0 to 64");
  if (c_.vendor_code_count != 0 && c_.vendor_codes == nullptr) return refuse(Path().member("vendor_codes"), "must not be NULL while vendor_code_count is above 0");
  const nc::Dialect& dialect = nc::dialect(static_cast<nc_dialect>(c_.dialect));
  for (unsigned i = 0; i < c_.vendor_code_count; ++i) {
    const nc::VendorFault fault = nc::check_vendor_code(dialect, c_.vendor_codes, i);
    if (fault.member != nullptr) return refuse(Path().member("vendor_codes").element(i).member(fault.member), fault.reason);
  }
  for (unsigned i = 0; i < c_.system_count; ++i) {
    if (c_.kinematics[i] == nullptr) continue;
    const nc::VendorFault fault = nc::check_kinematics(*c_.kinematics[i]);
    if (fault.member == nullptr) continue;
    Path path = Path().member("kinematics").element(i);
    if (fault.joint >= 0) path.member("joint").element(static_cast<unsigned>(fault.joint));
    return refuse(path.member(fault.member), fault.reason);
  }
  return true;
}

void set_defaults(nc_config* config) {
  *config = nc_config{};
  config->dialect = nc::kDefaultDialect;
  config->system_count = 1;
  config->system[0].axis_count = 3;
  for (unsigned i = 0; i < 3; ++i) config->system[0].axis[i].name = "XYZ"[i];
  config->cycle_s = 0.001;
  config->look_ahead = 1024;
  config->programs = 256;
  config->tool_offsets = 200;
  config->work_offsets = 96;
  config->variable_sets = 600;
  config->window_bytes = 65536;
  config->max_feed_override = 2.0;
  config->path_tolerance = 0.01;
  config->contour_blocks = 3800;
  config->tap_most_apart = 2;
}

}  // namespace

bool nc::take_config(const nc_config* given, nc_config* known) {
  if (given == nullptr) return false;
  set_defaults(known);
  return take_struct(given, known);
}

nc::CommonRanges nc::ranges_of(const nc_config& c) {
  CommonRanges r;
  for (const CommonOption& row : kCommonOptions) {
    if (row.sets > c.variable_sets) continue;
    unsigned i = 0;
    while (r.last[i] != 0 && row.first != r.last[i] + 1) ++i;  // the range that the row makes longer, or a new one
    if (r.last[i] == 0) r.first[i] = row.first;
    r.last[i] = row.last;
  }
  const FamilyVariables& family = *dialect(static_cast<nc_dialect>(c.dialect)).variables;
  for (unsigned i = 0; i < CommonRanges::kExtended && family.common[i].last != 0; ++i) {
    r.first[i] = family.common[i].first;
    r.last[i] = family.common[i].last;
  }
  r.first_named = family.named.first;
  r.named = family.named.last - family.named.first + 1;
  r.first[CommonRanges::kExtended] = kExtendedCommon.first;
  r.last[CommonRanges::kExtended] = c.extended_variables ? kExtendedCommon.last : 0;
  for (unsigned i = 0; i < NC_VARIABLE_RANGES; ++i) {
    r.first[CommonRanges::kExtended + 1 + i] = c.variable_ranges[i].first;
    r.last[CommonRanges::kExtended + 1 + i] = c.variable_ranges[i].last;
  }
  return r;
}

void nc_config_init_sized(nc_config* config, size_t struct_size) {
  if (config == nullptr || struct_size < sizeof(uint32_t) || struct_size > nc::kMostStructBytes) return;
  std::memset(static_cast<void*>(config), 0, struct_size);  // members that only a newer caller knows are 0, so that they ask for nothing
  nc_config defaults;
  set_defaults(&defaults);
  const uint32_t size = static_cast<uint32_t>(struct_size);
  std::memcpy(static_cast<void*>(config), &size, sizeof size);
  nc::give_struct(defaults, config);
}

nc_status nc_config_check(const nc_config* config, nc_config_fault* fault) {
  if (config == nullptr) return NC_E_ARGUMENT;
  nc_config known;
  nc_config_fault found{};
  if (!nc::take_config(config, &known)) {
    std::strcpy(found.field, "struct_size");
    std::strcpy(found.reason, "must be sizeof(nc_config); what this library does not know behind its own end must be 0");
  } else {
    Check check(known);
    if (check.passes()) return NC_OK;
    found = check.fault();
  }
  if (fault != nullptr) nc::give_struct(found, fault);
  return NC_E_ARGUMENT;
}

nc_status nc_variable_range_check(const nc_config* config, unsigned index, uint32_t* taken) {
  constexpr uint32_t kFirst = nc::kLocals + 1, kLast = 999999, kMost = 10000;
  uint32_t ignored = 0;
  if (taken == nullptr) taken = &ignored;
  *taken = 0;
  if (index >= NC_VARIABLE_RANGES) return NC_E_ARGUMENT;
  nc_config known;
  if (!nc::take_config(config, &known)) return NC_E_ARGUMENT;
  const uint32_t first = known.variable_ranges[index].first, last = known.variable_ranges[index].last;
  if (first == 0 && last == 0) return NC_OK;
  if (first < kFirst || last < first || last > kLast || last - first >= kMost) return NC_E_ARGUMENT;
  const nc::CommonRanges all = nc::ranges_of(known);
  const auto overlap = [&](uint32_t other_first, uint32_t other_last) {
    if (other_last < first || other_first > last) return;
    const uint32_t from = other_first > first ? other_first : first;
    if (*taken == 0 || from < *taken) *taken = from;
  };
  for (unsigned i = 0; i < nc::CommonRanges::kCount; ++i)
    if (i != nc::CommonRanges::kExtended + 1 + index && all.size(i) != 0) overlap(all.first[i], all.last[i]);
  const nc::FamilyVariables& family = *nc::dialect(static_cast<nc_dialect>(known.dialect)).variables;
  overlap(1, family.last_local);
  for (const nc::VariableRow& row : family.rows) overlap(row.first, row.last);
  return *taken == 0 ? NC_OK : NC_E_ARGUMENT;
}
