// SPDX-License-Identifier: Apache-2.0
// Configuration section [[spindle]]: what measures the speed of a spindle.
#include <algorithm>

#include "hal/modbus/codec.hpp"
#include "runtime/config_sections.hpp"
#include "runtime/machine_canopen.hpp"

namespace nc::rt {
namespace {

void read_feedback(TableReader* reader, const Config& config, SpindleFeedback* feedback) {
  std::string by;
  if (!reader->string("feedback", &by)) return;
  if (by == "simulated" || by == "none") {
    feedback->by = by == "none" ? SpindleFeedback::By::kNothing : SpindleFeedback::By::kSimulation;
    for (const char* key : {"rpm_per_count", "signed"})
      if (reader->find(key) != nullptr) reader->error(key, "is for a speed that a point gives");
    return;
  }
  for (const char* key : {"rpm_per_count", "signed"}) (void)reader->find(key);  // these keys are known, even when the point is wrong
  const int index = config.points.find(by);
  if (index < 0) return reader->error("feedback", "no point is named \"" + by + "\"; else it is \"simulated\" or \"none\"");
  const hal::Point& point = config.points.at(static_cast<unsigned>(index));
  if (point.direction != hal::PointDirection::kInput || point.type != hal::PointType::kWord)
    return reader->error("feedback", "point \"" + by + "\" must be an input and a word: the measured speed");
  feedback->by = SpindleFeedback::By::kPoint;
  feedback->point = index;
  feedback->place = {reader->line("feedback"), reader->path("feedback")};
  reader->number("rpm_per_count", &feedback->rpm_per_count, -kMostRpm, kMostRpm);
  if (feedback->rpm_per_count == 0) reader->error("rpm_per_count", "must not be 0");
  bool has_sign = true;
  if (reader->find("signed") == nullptr) return;
  reader->boolean("signed", &has_sign);
  feedback->sign = has_sign ? SpindleFeedback::Sign::kYes : SpindleFeedback::Sign::kNo;
}

// True when a negative value arrives as a large positive one. A register of 16 bits that is not declared signed gives -1 as 65535. An unscaled value of
// 32 bits keeps its sign, because the point has 32 bits too.
bool loses_its_sign(const hal::modbus::PointMap& map) {
  if (map.format == hal::modbus::Format::kBit || hal::modbus::point_is_signed(map)) return false;
  return map.format == hal::modbus::Format::kU16 || map.scale != 1 || map.offset != 0;
}

// True when the register of the point gives no sign, so that it cannot tell in which direction the spindle turns.
bool point_without_sign(const Config& config, const SpindleFeedback& feedback) {
  if (feedback.by != SpindleFeedback::By::kPoint) return false;
  const hal::Point& point = config.points.at(static_cast<unsigned>(feedback.point));
  if (point.bus == 0) return false;
  const auto entry = std::find_if(config.modbus.begin(), config.modbus.end(), [&](const ModbusLinkConfig& each) { return each.bus == point.bus; });
  if (entry == config.modbus.end()) return false;  // on another bus
  const std::vector<hal::modbus::PointMap>& maps = entry->link.points;
  const auto map = std::find_if(maps.begin(), maps.end(), [&](const hal::modbus::PointMap& each) { return each.point == static_cast<unsigned>(feedback.point); });
  return map != maps.end() && loses_its_sign(*map);
}

}  // namespace

std::vector<std::string> spindle_warnings(const Config& config) {
  std::vector<std::string> warnings;
  for (unsigned s = 0; s < config.nc.system_count; ++s)
    for (unsigned n = 0; n < NC_MAX_SPINDLES; ++n) {
      const SpindleFeedback& feedback = config.spindle_feedback[s][n];
      if (feedback.by == SpindleFeedback::By::kNothing && n < std::max(config.nc.system[s].spindle_count, std::uint8_t{1}))
        warnings.push_back(ConfigError{config.file, feedback.given_place.line, feedback.given_place.key,
                                       "nothing measures spindle " + std::to_string(n + 1) + " of part system " + std::to_string(s + 1) +
                                           ": feed per revolution (G95), threads and dwells in revolutions will wait; [[spindle]] feedback"}.text());
      if (feedback.sign == SpindleFeedback::Sign::kNo || !point_without_sign(config, feedback)) continue;
      const hal::Point& point = config.points.at(static_cast<unsigned>(feedback.point));
      warnings.push_back(ConfigError{config.file, feedback.place.line, feedback.place.key,
                                     "point \"" + point.name + "\" has no sign: a spindle that turns backwards is measured as one that turns forwards, "
                                     "-1000 in 16 bits as 64536; signed = true in its modbus table, or signed = false here where the device gives no sign"}.text());
    }
  return warnings;
}

// A spindle for which the file names no feedback is simulated when the machine has no bus, or when [sim.spindle] drives it. On a machine with a
// bus the spindle is real, and its speed is not measured unless the file names a point that measures it.
void read_spindle_feedback(TableReader* root, Config* config) {
  root->tables("spindle", [&](TableReader& reader, std::size_t) {
    unsigned system = 1, number = 1;
    reader.require("feedback");
    reader.integer("system", &system, 1, config->nc.system_count);
    const unsigned count = config->nc.system[system - 1].spindle_count;
    reader.integer("number", &number, 1, count == 0 ? 1 : count);
    SpindleFeedback& feedback = config->spindle_feedback[system - 1][number - 1];
    const ConfigPlace given{reader.line("feedback"), reader.path("feedback")};
    for (const char* key : {"feedback", "rpm_per_count", "signed"}) (void)reader.find(key);  // these keys are known, even when the table is one too many
    if (feedback.given) return reader.errors()->add_twice(given, feedback.given_place, "spindle " + std::to_string(number) + " of part system " + std::to_string(system) + " is there already");
    feedback.given = true;
    feedback.given_place = given;
    read_feedback(&reader, *config, &feedback);
    if (feedback.point >= 0) config->point_uses.push_back({PointRole::kMeasuredSpeed, feedback.point, feedback.place, static_cast<std::uint8_t>(system - 1), static_cast<std::uint8_t>(number - 1)});
    if (is_on_drive(*config, system - 1, number - 1)) reader.error("feedback", "spindle " + std::to_string(number) + " is on a drive, which measures it: without this table");
    const nc_system_config& axes = config->nc.system[system - 1];
    for (unsigned a = 0; a < axes.axis_count; ++a)
      if (axes.axis[a].spindle == number && feedback.by != SpindleFeedback::By::kSimulation)
        reader.error("feedback", std::string("axis ") + axes.axis[a].name + " is this spindle: where it stands only the simulation tells");
  });
  for (unsigned s = 0; s < config->nc.system_count; ++s)
    for (unsigned n = 0; n < NC_MAX_SPINDLES; ++n) {
      SpindleFeedback& feedback = config->spindle_feedback[s][n];
      const bool driven = is_on_drive(*config, s, n) || (s == 0 && config->sim.plant.spindle[n].driven);
      if (!feedback.given && !driven && !config->buses.empty()) {
        feedback.by = SpindleFeedback::By::kNothing;
        feedback.given_place = config->buses.front().named_at;
      }
      const bool no_sign = feedback.sign == SpindleFeedback::Sign::kNo || (feedback.sign == SpindleFeedback::Sign::kAsPoint && point_without_sign(*config, feedback));
      if (no_sign) config->nc.system[s].spindle_unsigned |= std::uint64_t{1} << n;
    }
}

// The highest speed of a synchronous tap, where the family has a parameter for it.
constexpr char kTapSpeed[] = "3005";

// It is a parameter of the control, that of the spindle stands with its drive. A tap with a higher S would lose its spindle in the hole, so where the file does not
// give the parameter the spindle does. Of several spindles the program takes one or the other: then the file has to say it.
void limit_taps(Config* config) {
  const auto family = static_cast<nc_dialect>(config->nc.dialect);
  if (!nc_parameter_used(family, kTapSpeed) || config->nc.system_count != 1 || config->nc.system[0].spindle_count > 1) return;
  if (!is_on_drive(*config, 0, 0)) return;
  for (const ParameterSetting& set : config->parameters)
    if (set.key == kTapSpeed) return;
  for (const hal::canopen::NodeMap& node : config->canopen.nodes)
    for (const hal::canopen::AxisMap& axis : node.axes)
      // In front, so that one that is set by its name goes over it.
      if (axis.spindle) config->parameters.insert(config->parameters.begin(), {kTapSpeed, 0, 0, parameter_text(axis.spindle->law.most * 60), {}});
}

}  // namespace nc::rt
