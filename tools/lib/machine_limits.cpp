// SPDX-License-Identifier: Apache-2.0
// Machine limits; see machine_limits.hpp.
#include "tools/lib/machine_limits.hpp"

#include <fstream>
#include <iterator>

#include "tools/lib/json_check.hpp"
#include "tools/lib/number_text.hpp"

namespace nc::tools {
namespace {

using namespace json;

constexpr double kMinWidth = 1e-6, kMaxLength = 1e6;
constexpr double kShortestCycle_s = 1e-5, kLongestCycle_s = 0.1;

std::string shown(double value) {
  char out[kNumberText];
  return std::string(out, value_text(value, out));
}

double in_range(const JsonNode& node, const std::string& path, double low, double high) {
  const double value = number(node, path);
  if (!(value >= low && value <= high))
    fail(node, path, "must be from " + shown(low) + " to " + shown(high) + ", is " + shown(value));
  return value;
}

double rate(const JsonNode& node, const std::string& path) {
  return in_range(node, path, kSlowest, kFastest);
}

void read_axis(const JsonNode& node, const std::string& path, nc_axis_config* axis) {
  check_keys(expect(node, path, Type::kObject), path,
             {"velocity", "rapid", "acceleration", "jerk", "in_position", "stroke"});
  if (const JsonNode* v = member(node, "velocity"))
    axis->max_velocity = axis->rapid = rate(*v, path + ".velocity");
  if (const JsonNode* v = member(node, "rapid")) axis->rapid = rate(*v, path + ".rapid");
  if (const JsonNode* v = member(node, "acceleration"))
    axis->max_acceleration = rate(*v, path + ".acceleration");
  if (const JsonNode* v = member(node, "jerk")) axis->max_jerk = rate(*v, path + ".jerk");
  if (const JsonNode* v = member(node, "in_position"))
    axis->in_position = in_range(*v, path + ".in_position", kMinWidth, kMaxLength);
  if (const JsonNode* stroke = member(node, "stroke")) {
    const std::string at = path + ".stroke";
    if (expect(*stroke, at, Type::kArray).items.size() != 2) fail(*stroke, at, "must be [low, high]");
    axis->soft_limited = true;
    axis->soft_min = in_range(stroke->items[0], item_path(at, 0), -kMaxLength, kMaxLength);
    axis->soft_max = in_range(stroke->items[1], item_path(at, 1), -kMaxLength, kMaxLength);
    if (!(axis->soft_min < axis->soft_max)) fail(*stroke, at, "low must be less than high");
  }
}

void read(const JsonNode& root, nc_config* config) {
  if (root.type != Type::kObject)
    fail(root, "", std::string("limits must be an object, are ") + root.type_name());
  check_keys(root, "", {"cycle_s", "axes"});
  if (const JsonNode* cycle = member(root, "cycle_s")) {
    config->cycle_s = in_range(*cycle, "cycle_s", kShortestCycle_s, kLongestCycle_s);
  }
  const JsonNode* axes = member(root, "axes");
  if (!axes) return;
  nc_system_config& system = config->system[0];
  for (const auto& [name, value] : expect(*axes, "axes", Type::kObject).members) {
    nc_axis_config* axis = nullptr;
    for (unsigned i = 0; i < system.axis_count; ++i)
      if (name.size() == 1 && system.axis[i].name == name[0]) axis = &system.axis[i];
    if (!axis) fail(value, join("axes", name), "the setup has no such axis");
    read_axis(value, join("axes", name), axis);
  }
}

}  // namespace

void default_machine_limits(nc_config* config) {
  nc_system_config& system = config->system[0];
  for (unsigned i = 0; i < system.axis_count; ++i) {
    nc_axis_config& axis = system.axis[i];
    axis.rapid = axis.max_velocity = 250.0;
    axis.max_acceleration = 2000.0;
    axis.max_jerk = 50000.0;
    axis.in_position = 0.02;
  }
}

bool parse_machine_limits(const std::string& text, const std::string& name, nc_config* config,
                          std::string* error) {
  JsonNode root;
  std::string why;
  if (!parse_json(text, &root, &why)) {
    *error = name + ":" + why.substr(5);  // "line N: why" -> "NAME:N: why"
    return false;
  }
  try {
    read(root, config);
  } catch (const JsonError& problem) {
    *error = name + ":" + std::to_string(problem.line) + ": " + problem.text;
    return false;
  }
  return true;
}

bool load_machine_limits(const std::string& path, nc_config* config, std::string* error) {
  std::string text;
  if (path.ends_with(".toml")) {  // a likely mistake: in ncrtd and ncdds --config is the same as --machine
    *error = path + ": limits are JSON (docs/trace.md); the configuration of a machine is --machine " + path;
    return false;
  }
  if (!json::read_text_file(path, &text, error)) return false;
  return parse_machine_limits(text, path, config, error);
}

}  // namespace nc::tools
