// SPDX-License-Identifier: Apache-2.0
// When a configuration is refused the fault names the member and the reason.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "nc/nc.h"

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// Two part systems, the second with a rotary axis C that may be a spindle, so that every member has a meaning.
nc_config good() {
  nc_config c;
  nc_config_init(&c);
  c.system_count = 2;
  c.system[1] = c.system[0];
  c.system[1].axis_count = 4;
  c.system[1].axis[3].name = 'C';
  c.system[1].axis[3].rotary = true;
  return c;
}

struct Fault {
  std::string field, reason;
};

Fault fault_of(const nc_config& c) {
  nc_config_fault fault;
  std::strcpy(fault.field, "untouched");
  fault.reason[0] = 0;
  const nc_status status = nc_config_check(&c, &fault);
  EXPECT_EQ(status == NC_OK, nc_memory_required(&c) != 0);
  EXPECT_EQ(status == NC_OK, std::string(fault.field) == "untouched");
  EXPECT_EQ(nc_config_check(&c, nullptr), status);
  alignas(64) static char memory[64];
  nc_status created = NC_OK;
  EXPECT_EQ(nc_create(&c, memory, sizeof memory, &created), nullptr);
  EXPECT_EQ(created, status == NC_OK ? NC_E_MEMORY : NC_E_ARGUMENT);
  return {fault.field, fault.reason};
}

/// One member: how a value is written into it, values that are refused, and values that are accepted.
struct Row {
  const char* field;
  std::function<void(nc_config&, double)> set;
  std::vector<double> wrong, right;
};

const Row kRows[] = {
    {"dialect", [](nc_config& c, double v) { c.dialect = static_cast<uint8_t>(v); }, {NC_DIALECT_COUNT, 255}, {0, 1}},
    {"system_count", [](nc_config& c, double v) { c.system_count = static_cast<uint8_t>(v); }, {0, 5, 255}, {1, 2}},
    {"cycle_s", [](nc_config& c, double v) { c.cycle_s = v; }, {kNan, kInf, -kInf, 0, -0.001, 0.9e-6, 0.11}, {1e-6, 0.1}},
    {"look_ahead", [](nc_config& c, double v) { c.look_ahead = static_cast<uint32_t>(v); }, {0, 32, 63, 100, 131072}, {64, 65536}},
    {"programs", [](nc_config& c, double v) { c.programs = static_cast<uint32_t>(v); }, {0, 65536, 4294967295}, {1, 65535}},
    {"tool_offsets", [](nc_config& c, double v) { c.tool_offsets = static_cast<uint32_t>(v); }, {0, 1000}, {1, 999}},
    {"work_offsets", [](nc_config& c, double v) { c.work_offsets = static_cast<uint32_t>(v); }, {301}, {0, 300}},
    {"contour_blocks", [](nc_config& c, double v) { c.contour_blocks = static_cast<uint32_t>(v); }, {0, 15, 1000001}, {16, 1000000}},
    {"tap_most_apart", [](nc_config& c, double v) { c.tap_most_apart = v; }, {kNan, kInf, 0, 101}, {0.05, 2, 100}},
    {"retract_overlap", [](nc_config& c, double v) { c.retract_overlap = v; }, {kNan, kInf, -1, 100.1}, {0, 2, 100}},
    {"window_bytes", [](nc_config& c, double v) { c.window_bytes = static_cast<uint32_t>(v); }, {0, 511, 16777217}, {512, 16777216}},
    {"variable_sets", [](nc_config& c, double v) { c.variable_sets = static_cast<uint32_t>(v); }, {0, 99, 400, 601}, {100, 200, 300, 600}},
    {"max_feed_override", [](nc_config& c, double v) { c.max_feed_override = v; }, {kNan, kInf, 0, -1, 0.99, 10.1}, {1, 10}},
    {"motion_mode", [](nc_config& c, double v) { c.motion_mode = static_cast<uint8_t>(v); }, {2, 255}, {0}},
    {"variable_ranges[1]", [](nc_config& c, double v) { c.variable_ranges[1] = {static_cast<uint32_t>(v), static_cast<uint32_t>(v) + 9}; },
     {1, 25, 33, 100, 500, 3000, 999995}, {400, 800000}},
    {"system[1].axis_count", [](nc_config& c, double v) { c.system[1].axis_count = static_cast<uint8_t>(v); }, {0, 9, 255}, {1, 4}},
    {"system[1].spindle_count", [](nc_config& c, double v) { c.system[1].spindle_count = static_cast<uint8_t>(v); }, {5, 255}, {0, 4}},
    {"system[1].reserved", [](nc_config& c, double v) { c.system[1].reserved[5] = v; }, {1, kNan}, {0}},
    {"system[1].axis[2].name", [](nc_config& c, double v) { c.system[1].axis[2].name = static_cast<char>(v); }, {0, 'x', 'F', 'X', 'Y'}, {'Z', 'W'}},
    {"system[1].axis[2].rapid", [](nc_config& c, double v) { c.system[1].axis[2].rapid = v; }, {kNan, kInf, -1, 1.1e12}, {0, 1e12}},
    {"system[1].axis[2].max_velocity", [](nc_config& c, double v) { c.system[1].axis[2].max_velocity = v; }, {kNan, kInf, -1, 1.1e12}, {0, 1e12}},
    {"system[1].axis[2].max_acceleration", [](nc_config& c, double v) { c.system[1].axis[2].max_acceleration = v; }, {kNan, kInf, -1, 1.1e12}, {0, 1}},
    {"system[1].axis[2].max_jerk", [](nc_config& c, double v) { c.system[1].axis[2].max_jerk = v; }, {kNan, kInf, -1, 1.1e12}, {0, 1}},
    {"system[1].axis[2].in_position", [](nc_config& c, double v) { c.system[1].axis[2].in_position = v; }, {kNan, kInf, -1, 1.1e12}, {0, 1}},
    {"system[1].axis[2].reference[3]", [](nc_config& c, double v) { c.system[1].axis[2].reference[3] = v; }, {kNan, kInf, 1.1e9, -1.1e9}, {-1e9, 0, 1e9}},
    {"system[1].axis[2].soft_min", [](nc_config& c, double v) { nc_axis_config& a = c.system[1].axis[2]; a.soft_limited = true; a.soft_min = v; a.soft_max = 1e9; },
     {kNan, -kInf, -1.1e9}, {-1e9, 0}},
    {"system[1].axis[2].soft_max", [](nc_config& c, double v) { nc_axis_config& a = c.system[1].axis[2]; a.soft_limited = true; a.soft_max = v; },
     {kNan, kInf, 1.1e9, 0, -1}, {1e9, 1}},
    {"system[1].axis[2].spindle", [](nc_config& c, double v) { c.system[1].axis[2].spindle = static_cast<uint8_t>(v); }, {1}, {0}},
    {"system[1].axis[3].spindle", [](nc_config& c, double v) { c.system[1].axis[3].spindle = static_cast<uint8_t>(v); }, {2, 255}, {0, 1}},
    {"system[1].axis[2].reserved", [](nc_config& c, double v) { c.system[1].axis[2].reserved[0] = v; }, {1, -1, kNan}, {0}},
};

TEST(ConfigCheck, NamesTheMemberAndTheReason) {
  EXPECT_EQ(fault_of(good()).field, "untouched");
  for (const Row& row : kRows) {
    for (const double value : row.wrong) {
      nc_config c = good();
      row.set(c, value);
      const Fault fault = fault_of(c);
      EXPECT_EQ(fault.field, row.field) << value;
      EXPECT_GT(fault.reason.size(), 8u) << row.field;
      const bool floating = !std::isfinite(value);
      const bool number_asked = fault.reason.find("is no finite number; ") == 0;
      EXPECT_EQ(number_asked, floating && fault.reason.find("must be 0: a later") == std::string::npos) << row.field << ": " << fault.reason;
    }
    for (const double value : row.right) {
      nc_config c = good();
      row.set(c, value);
      EXPECT_EQ(fault_of(c).field, "untouched") << row.field << " " << value;
    }
  }
}

nc_config optimal() {
  nc_config c = good();
  c.motion_mode = NC_MOTION_OPTIMAL;
  for (unsigned s = 0; s < 2; ++s)
    for (nc_axis_config& a : c.system[s].axis) a.max_velocity = a.max_acceleration = a.max_jerk = 1;
  return c;
}

TEST(ConfigCheck, TheOptimalModeNeedsAllLimits) {
  EXPECT_EQ(fault_of(optimal()).field, "untouched");
  const std::pair<const char*, double nc_axis_config::*> limits[] = {{"max_velocity", &nc_axis_config::max_velocity},
                                                                     {"max_acceleration", &nc_axis_config::max_acceleration},
                                                                     {"max_jerk", &nc_axis_config::max_jerk}};
  for (const auto& [name, limit] : limits) {
    nc_config c = optimal();
    c.system[1].axis[3].*limit = 0;
    EXPECT_EQ(fault_of(c).field, std::string("system[1].axis[3].") + name);
    c.motion_mode = NC_MOTION_TRAPEZOID;
    EXPECT_EQ(fault_of(c).field, "untouched");
  }
  for (const double tolerance : {kNan, kInf, -1.0, 1e-6, 11.0}) {
    nc_config c = optimal();
    c.path_tolerance = tolerance;
    EXPECT_EQ(fault_of(c).field, "path_tolerance") << tolerance;
    c.motion_mode = NC_MOTION_TRAPEZOID;
    EXPECT_EQ(fault_of(c).field, "path_tolerance") << tolerance;
  }
}

TEST(ConfigCheck, OneSpindleIsOneAxis) {
  nc_config c = good();
  c.system[1].axis[2].name = 'A';
  c.system[1].axis[2].rotary = true;
  c.system[1].axis[2].spindle = c.system[1].axis[3].spindle = 1;
  const Fault fault = fault_of(c);
  EXPECT_EQ(fault.field, "system[1].axis[3].spindle");
  EXPECT_EQ(fault.reason, "is the spindle of an axis before it in the same part system");
}

TEST(ConfigCheck, WithoutAConfiguration) {
  nc_config_fault fault;
  std::strcpy(fault.field, "untouched");
  EXPECT_EQ(nc_config_check(nullptr, &fault), NC_E_ARGUMENT);
  EXPECT_STREQ(fault.field, "untouched");
}

}  // namespace
