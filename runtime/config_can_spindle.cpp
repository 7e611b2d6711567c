// SPDX-License-Identifier: Apache-2.0
// Configuration [[canopen.drive.spindle]]: a spindle on a drive. docs/canopen.md.
#include <algorithm>
#include <cmath>

#include "runtime/config_sections.hpp"
#include "runtime/machine_canopen.hpp"

namespace nc::rt {
namespace {

using hal::canopen::AxisMap;
using hal::canopen::NodeMap;
using hal::canopen::SpindleMap;

constexpr double kMostRatio = 1e6;
constexpr std::size_t kMostGears = 8;
constexpr double kMostVelocity = 2147483647.0;  // 60FFh is a signed number of 32 bits

// gears = [[motor, spindle], ...]: turns of the motor and of the spindle in each gear step.
void read_gears(TableReader* reader, SpindleMap* spindle) {
  spindle->gears = {1};
  const toml::node* node = reader->find("gears");
  if (node == nullptr) return;
  const toml::array* steps = node->as_array();
  const auto wrong = [reader] { reader->error("gears", "is one pair for each gear step, up to 8: [[turns of the motor, turns of the spindle], ...], all above 0"); };
  if (steps == nullptr || steps->empty() || steps->size() > kMostGears) return wrong();
  spindle->gears.clear();
  for (const toml::node& step : *steps) {
    const toml::array* pair = step.as_array();
    double motor = 0, tool = 0;
    if (pair == nullptr || pair->size() != 2 || !node_number((*pair)[0], &motor) || !node_number((*pair)[1], &tool)) return wrong();
    if (!(motor >= kLeastMeant && tool >= kLeastMeant && motor <= kMostRatio && tool <= kMostRatio)) return wrong();
    spindle->gears.push_back(motor / tool);
  }
}

void read_gear_select(TableReader* reader, const AxisMap& owner, Config* config, SpindleMap* spindle) {
  const bool given = reader->find("gear_select") != nullptr;
  if (given) read_drive_point(reader, "gear_select", hal::PointType::kWord, hal::PointDirection::kOutput, PointRole::kSpindleGear, owner, config, &spindle->gear_select);
  if (spindle->gears.size() > 1 && !given) reader->error("gears", "with several steps gear_select names the point that says which one is in");
  if (spindle->gears.size() == 1 && given) reader->error("gear_select", "is for several gears");
}

void read_orient(TableReader* spindle_reader, const AxisMap& owner, Config* config, SpindleMap* spindle) {
  spindle_reader->table("orient", [&](TableReader& reader) {
    double rpm = 60, angle = 0, window = 1;
    reader.number("speed", &rpm, 0.1, kMostRpm);
    reader.number("angle", &angle, 0, 359.999);
    reader.number("window", &window, 0.01, 90);
    if (spindle->law.most > 0 && rpm / 60 > spindle->law.most) reader.error("speed", "is above max_rpm (" + number_text(spindle->law.most * 60) + ")");
    spindle->law.orient_speed = rpm / 60;
    spindle->law.orient_angle = angle / 360;
    spindle->law.orient_window = window / 360;
    for (const char* key : {"request", "done"}) reader.require(key);
    read_drive_point(&reader, "request", hal::PointType::kBit, hal::PointDirection::kOutput, PointRole::kSpindleOrient, owner, config, &spindle->orient);
    read_drive_point(&reader, "done", hal::PointType::kBit, hal::PointDirection::kInput, PointRole::kSpindleOriented, owner, config, &spindle->oriented);
    if (spindle->gears.size() > 1) reader.error("request", "a spindle with gear steps cannot be oriented by its motor: behind a change nobody knows its angle");
  });
}

// The speed that the drive is given in the longest gear must be a number that 60FFh can have.
void check_velocity(TableReader* reader, const SpindleMap& spindle) {
  const double most = std::abs(*std::max_element(spindle.gears.begin(), spindle.gears.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  if (spindle.law.most * 60 * most * std::abs(spindle.velocity_scale) > kMostVelocity)
    reader->error("max_rpm", "is more than the 32 bits of 60FFh can say with this gear and velocity_scale");
}

}  // namespace

void read_drive_spindle(TableReader* reader, Config* config, NodeMap* node) {
  AxisMap map;
  SpindleMap spindle;
  unsigned system = 1, number = 1, mode = 0;
  double rpm = 0, acceleration = 0;
  bool reverse = false;
  for (const char* key : {"encoder", "max_rpm", "acceleration", "forward", "backward"}) reader->require(key);
  reader->integer("system", &system, 1, config->nc.system_count);
  const unsigned count = std::max<unsigned>(1, config->nc.system[system - 1].spindle_count);
  reader->integer("number", &number, 1, count);
  map.system = system - 1;
  map.axis = NC_MAX_AXES + number - 1;
  read_drive_place(reader, *node, &map);
  if (reader->number("encoder", &spindle.increments, 1, 4294967296.0)) spindle.velocity_scale = spindle.increments / 60;
  if (reader->number("velocity_scale", &spindle.velocity_scale, 1e-9, 1e9) && spindle.velocity_scale == 0) reader->error("velocity_scale", "must not be 0");
  reader->boolean("reverse", &reverse);
  if (reader->number("max_rpm", &rpm, 1, kMostRpm)) spindle.law.most = rpm / 60;
  if (reader->number("acceleration", &acceleration, 1, 1e9)) spindle.law.acceleration = acceleration / 60;
  read_loop_gain(reader, "gain", 1, 200, config->canopen.sync_us, "the spindle", &spindle.law.gain);
  if (reader->choice("mode", {"cyclic", "profile"}, &mode) && mode == 1) map.mode = hal::canopen::kModeProfileVelocity;
  else map.mode = hal::canopen::kModeCyclicVelocity;
  if (double lag_ms = 0; reader->number("tap_axis_lag_ms", &lag_ms, quantity::kAxisLag)) spindle.tap_axis_lag_s = lag_ms / 1000;
  read_gears(reader, &spindle);
  read_gear_select(reader, map, config, &spindle);
  read_drive_point(reader, "forward", hal::PointType::kBit, hal::PointDirection::kOutput, PointRole::kSpindleTurn, map, config, &spindle.forward);
  read_drive_point(reader, "backward", hal::PointType::kBit, hal::PointDirection::kOutput, PointRole::kSpindleTurn, map, config, &spindle.backward);
  read_orient(reader, map, config, &spindle);
  check_velocity(reader, spindle);
  if (reverse)
    for (double& gear : spindle.gears) gear = -gear;
  spindle.number = number - 1;
  map.name = "spindle " + std::to_string(number);
  map.spindle = std::move(spindle);
  const nc_system_config& axes = config->nc.system[map.system];
  for (unsigned a = 0; a < axes.axis_count; ++a)
    if (axes.axis[a].spindle == number)
      reader->error(reader->find("number") != nullptr ? "number" : "encoder", std::string("axis ") + axes.axis[a].name + " is this spindle: only the simulated one can be a C axis so far");
  for (const NodeMap& other : config->canopen.nodes)
    for (const AxisMap& taken : other.axes)
      if (taken.system == map.system && taken.axis == map.axis) return reader->error("encoder", map.name + " is on drive \"" + other.name + "\" already");
  for (const AxisMap& taken : node->axes)
    if (taken.system == map.system && taken.axis == map.axis) return reader->error("encoder", map.name + " is on this drive already");
  node->axes.push_back(std::move(map));
}

bool is_on_drive(const Config& config, unsigned system, unsigned number) {
  if (config.machine_kind == nullptr || config.machine_kind->name != "canopen") return false;
  for (const NodeMap& node : config.canopen.nodes)
    for (const AxisMap& axis : node.axes)
      if (axis.spindle && axis.system == system && axis.spindle->number == number) return true;
  return false;
}

}  // namespace nc::rt
