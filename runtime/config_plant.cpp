// SPDX-License-Identifier: Apache-2.0
// Configuration sections [sim.spindle] and [sim.tool_changer]: the output points that drive them and the input points with which they answer.
#include "runtime/config_sections.hpp"
#include "runtime/hal_factory.hpp"

namespace nc::rt {
namespace {

struct PointKey {
  const char* key;
  hal::PointType type;
  hal::PointDirection direction;
  bool required;
  int* index;
};

void read_point_key(TableReader* reader, Config* config, const PointKey& wanted) {
  if (wanted.required) reader->require(wanted.key);
  std::string name;
  if (!reader->string(wanted.key, &name)) return;
  const int index = config->points.find(name);
  if (index < 0) return reader->error(wanted.key, "no point is named \"" + name + "\"");
  const hal::Point& point = config->points.at(static_cast<unsigned>(index));
  if (point.direction != wanted.direction)
    return reader->error(wanted.key, "point \"" + name + "\" must be an " +
                                         (wanted.direction == hal::PointDirection::kInput ? "input" : "output"));
  if (point.type != wanted.type)
    return reader->error(wanted.key, "point \"" + name + "\" must be a " +
                                         (wanted.type == hal::PointType::kBit ? "bit" : "word"));
  if (point.bus != 0) return reader->error(wanted.key, "point \"" + name + "\" belongs to another bus");
  *wanted.index = index;
  if (config->machine_kind == nullptr || config->machine_kind->name != "sim") return;
  const bool obeys = wanted.direction == hal::PointDirection::kOutput;
  config->point_uses.push_back({obeys ? PointRole::kSimulatedCommand : PointRole::kSimulatedAnswer, index, {reader->line(wanted.key), reader->path(wanted.key)}});
}

constexpr auto kBit = hal::PointType::kBit;
constexpr auto kWord = hal::PointType::kWord;
constexpr auto kIn = hal::PointDirection::kInput;
constexpr auto kOut = hal::PointDirection::kOutput;

}  // namespace

void read_sim_plant(TableReader* sim, Config* config) {
  hal::SimPlantConfig& plant = config->sim.plant;
  plant.ramp_rpm_per_s = config->sim.spindle_ramp_rpm_per_s;
  plant.max_rpm = config->sim.spindle_max_rpm;
  plant.prepare_s = config->sim.tool_select_s;
  plant.change_s = config->sim.tool_change_s;
  const auto needs_ladder = [&](TableReader& reader) {
    if (config->ladder.program.empty())
      reader.errors()->add(reader.line(), reader.path(), "needs a ladder program: see [ladder]");
  };
  for (unsigned n = 0; n < NC_MAX_SPINDLES; ++n) {  // the spindles of part system 1
    sim->table(n == 0 ? "spindle" : "spindle" + std::to_string(n + 1), [&](TableReader& reader) {
      hal::SimSpindlePoints& spindle = plant.spindle[n];
      spindle.driven = true;
      for (const PointKey& key : {PointKey{"forward", kBit, kOut, true, &spindle.forward},
                                  {"reverse", kBit, kOut, false, &spindle.reverse},
                                  {"speed", kWord, kOut, true, &spindle.speed},
                                  {"at_speed", kBit, kIn, false, &spindle.at_speed},
                                  {"stopped", kBit, kIn, false, &spindle.stopped}})
        read_point_key(&reader, config, key);
      needs_ladder(reader);
      if (n >= config->sim.spindle_count[0])
        reader.errors()->add(reader.line(), reader.path(), "part system 1 has no spindle " + std::to_string(n + 1) + ": see machine.spindles");
    });
  }
  sim->table("tool_changer", [&](TableReader& reader) {
    plant.tool_changer = true;
    for (const PointKey& key : {PointKey{"prepare", kBit, kOut, true, &plant.prepare},
                                {"pocket", kWord, kOut, true, &plant.pocket},
                                {"prepared", kBit, kIn, true, &plant.prepared},
                                {"change", kBit, kOut, true, &plant.change},
                                {"changed", kBit, kIn, true, &plant.changed},
                                {"tool", kWord, kIn, false, &plant.tool}})
      read_point_key(&reader, config, key);
    needs_ladder(reader);
  });
}

}  // namespace nc::rt
