// SPDX-License-Identifier: Apache-2.0
// Configuration sections [machine], [scheduling], [[axis]], [motion], and the names of axes that the others use.
#include <algorithm>
#include <bit>
#include <string_view>
#include <vector>

#include "runtime/config_equipment.hpp"
#include "runtime/config_sections.hpp"
#include "runtime/hal_factory.hpp"
#include "runtime/motion_choice.hpp"

namespace nc::rt {
namespace {

constexpr double kLeastTolerance = 1e-4;  // mm; smallest tolerance of a smoothed path
constexpr std::string_view kAxisLetters = "XYZABCUVW";

struct AxisEntry {
  nc_axis_config axis{};
  unsigned system = 1;
  double start = 0;
  hal::SimAxis sim;
};

// An array of places of an axis.
bool read_places(TableReader* reader, const char* key, std::size_t least, std::size_t most, std::vector<double>* places) {
  if (!reader->numbers(key, places, least, most)) return false;
  if (std::all_of(places->begin(), places->end(), [](double place) { return place >= -kMaxLength && place <= kMaxLength; })) return true;
  reader->error(key, "must hold numbers from " + number_text(-kMaxLength) + " to " + number_text(kMaxLength));
  return false;
}

void read_limits(TableReader* reader, AxisEntry* entry) {
  nc_axis_config& axis = entry->axis;
  for (const char* key : {"max_velocity", "max_acceleration"}) reader->require(key);
  const bool limited = reader->number("max_velocity", &axis.max_velocity, quantity::kSpeed);
  reader->number("max_acceleration", &axis.max_acceleration, quantity::kAcceleration);
  reader->number("max_jerk", &axis.max_jerk, quantity::kJerk);
  axis.rapid = axis.max_velocity;
  if (reader->number("rapid", &axis.rapid, quantity::kSpeed) && limited && axis.rapid > axis.max_velocity)
    reader->error("rapid", "must not be above max_velocity (" + number_text(axis.max_velocity) + ")");
  reader->number("in_position", &axis.in_position, quantity::kWindow);
  std::vector<double> numbers;
  if (read_places(reader, "soft_limits", 2, 2, &numbers)) {
    axis.soft_limited = true;
    axis.soft_min = numbers[0];
    axis.soft_max = numbers[1];
    if (numbers[0] >= numbers[1]) reader->error("soft_limits", "the first number must be below the second");
  }
  const bool referenced = read_places(reader, "reference", 1, 4, &numbers);
  if (referenced) std::copy(numbers.begin(), numbers.end(), axis.reference);
  const auto outside = [&axis](double position) { return axis.soft_limited && axis.soft_min < axis.soft_max && (position < axis.soft_min || position > axis.soft_max); };
  // Outside the soft limits every G28 would be an alarm.
  if (!referenced) numbers = {axis.reference[0]};
  if (std::any_of(numbers.begin(), numbers.end(), outside))
    reader->error(referenced ? "reference" : "soft_limits", referenced ? "must be inside soft_limits" : "do not have the axis' reference position (0 where it is not given) inside: reference");
  const bool started = reader->number("start", &entry->start, -kMaxLength, kMaxLength);
  if (outside(entry->start)) reader->error(started ? "start" : "soft_limits", started ? "must be inside soft_limits" : "do not have the axis' start (0 where it is not given) inside: start");
}

// Returns the letter of the axis, or 0 when the key is missing or wrong, which is reported.
char read_axis_name(TableReader* reader) {
  std::string name;
  reader->require("name");
  if (!reader->string("name", &name)) return 0;
  if (name.size() == 1 && kAxisLetters.find(name[0]) != std::string_view::npos) return name[0];
  reader->error("name", "must be one letter of " + std::string(kAxisLetters) + ", not \"" + name + "\"");
  return 0;
}

// M700 10.5: reads the number of the spindle that is also this axis.
void read_spindle_of_axis(TableReader* reader, const Config& config, unsigned system_number, nc_axis_config* axis) {
  unsigned spindle = 0;
  if (!reader->integer("spindle", &spindle, 1, NC_MAX_SPINDLES)) return;
  const nc_system_config& system = config.nc.system[system_number - 1];
  const unsigned count = std::max<unsigned>(system.spindle_count, 1);
  if (!axis->rotary) return reader->error("spindle", "is for rotary axes: rotary = true");
  if (spindle > count)
    return reader->error("spindle", "part system " + std::to_string(system_number) + " has " +
                                        (count == 1 ? std::string("one spindle") : std::to_string(count) + " spindles") + ": see machine.spindles");
  for (unsigned a = 0; a < system.axis_count; ++a)
    if (system.axis[a].spindle == spindle)
      return reader->error("spindle", "spindle " + std::to_string(spindle) + " is axis " + system.axis[a].name + " already");
  axis->spindle = static_cast<std::uint8_t>(spindle);
}

void read_axis(TableReader* reader, Config* config) {
  AxisEntry entry;
  entry.axis.in_position = 0.01;
  entry.axis.name = read_axis_name(reader);
  reader->integer("system", &entry.system, 1, NC_MAX_SYSTEMS);
  reader->boolean("rotary", &entry.axis.rotary);
  read_spindle_of_axis(reader, *config, entry.system, &entry.axis);
  read_limits(reader, &entry);
  double lag_ms = 5.0;
  reader->number("servo_lag_ms", &lag_ms, quantity::kLag);
  entry.sim.lag_s = lag_ms / 1000.0;
  reader->number("following_error_limit", &entry.sim.following_error_limit, quantity::kErrorLimit);
  reader->number("unclamp_s", &entry.sim.clamp.unclamp_s, quantity::kActionTime);
  reader->number("clamp_s", &entry.sim.clamp.clamp_s, quantity::kActionTime);
  for (const char* key : {"homing", "limit_switches", "brake", "screw"}) (void)reader->find(key);  // read_equipment() below
  if (entry.axis.name == 0) return;

  const unsigned s = entry.system - 1;
  nc_system_config& system = config->nc.system[s];
  const auto* end = system.axis + system.axis_count;
  if (std::any_of(static_cast<const nc_axis_config*>(system.axis), end,
                  [&](const nc_axis_config& a) { return a.name == entry.axis.name; })) {
    reader->error("name", std::string("axis ") + entry.axis.name + " is already there in part system " +
                              std::to_string(entry.system));
    return;
  }
  if (system.axis_count == NC_MAX_AXES) {
    reader->error("name", "a part system has at most " + std::to_string(NC_MAX_AXES) + " axes");
    return;
  }
  const unsigned a = system.axis_count++;
  system.axis[a] = entry.axis;
  config->start[s].v[a] = entry.start;
  config->sim.axis[s][a] = entry.sim;
  read_equipment(reader, config, s, a);
  config->nc.system_count =
      static_cast<std::uint8_t>(std::max<unsigned>(config->nc.system_count, entry.system));
}

}  // namespace

namespace {

// M700 10.6: reads the number of spindles of each part system.
void read_spindles(TableReader* reader, Config* config) {
  std::vector<double> numbers;
  for (nc_system_config& system : config->nc.system) system.spindle_count = 1;
  if (!reader->numbers("spindles", &numbers, 1, NC_MAX_SYSTEMS)) return;
  for (std::size_t s = 0; s < numbers.size(); ++s) {
    if (!(numbers[s] >= 1 && numbers[s] <= NC_MAX_SPINDLES) || numbers[s] != static_cast<int>(numbers[s]))
      return reader->error("spindles", "each part system has 1 to " + std::to_string(NC_MAX_SPINDLES) + " spindles, not " + number_text(numbers[s]));
    config->nc.system[s].spindle_count = static_cast<std::uint8_t>(numbers[s]);
    config->sim.spindle_count[s] = static_cast<unsigned>(numbers[s]);
  }
  config->spindles_given = static_cast<unsigned>(numbers.size());
  config->spindles_place = {reader->line("spindles"), reader->path("spindles")};
}

// What turns the tool in each part system for a length along its axis (M700 12.3). Part systems behind the last word have "turned".
void read_tool_axes(TableReader* reader, Config* config) {
  constexpr std::string_view kWords[] = {"turned", "mechanical_a", "mechanical_b"};  // in the order of nc_tool_axis
  std::vector<std::pair<std::string, unsigned>> words;
  if (!reader->strings("tool_axis", &words)) return;
  if (words.size() > NC_MAX_SYSTEMS) return reader->error("tool_axis", "has a word for each part system, at most " + std::to_string(NC_MAX_SYSTEMS));
  for (std::size_t s = 0; s < words.size(); ++s) {
    const auto* const known = std::find(std::begin(kWords), std::end(kWords), words[s].first);
    if (known == std::end(kWords)) return reader->error("tool_axis", "must have \"turned\", \"mechanical_a\" or \"mechanical_b\", not \"" + words[s].first + "\"");
    config->nc.system[s].tool_axis = static_cast<std::uint64_t>(known - std::begin(kWords));
  }
  config->tool_axes_given = static_cast<unsigned>(words.size());
  config->tool_axes_place = {reader->line("tool_axis"), reader->path("tool_axis")};
}

// Reads ranges of common variables in addition to those of variable_sets. It comes after the other options of variables, because a range must not
// overlap with the variables that they give.
void read_variable_ranges(TableReader* machine, Config* config) {
  nc_config& nc = config->nc;
  machine->tables("variable_ranges", [&](TableReader& reader, std::size_t index) {
    std::uint32_t first = 0, last = 0;
    bool kept = true;
    reader.require("first");
    reader.require("last");
    const bool whole = reader.integer("first", &first, 34, 999999) && reader.integer("last", &last, 34, 999999);
    reader.boolean("kept", &kept);
    if (index >= NC_VARIABLE_RANGES)
      return reader.error("first", "there can be " + std::to_string(NC_VARIABLE_RANGES) + " further ranges of common variables");
    if (!whole) return;
    nc.variable_ranges[index] = {first, last};
    std::uint32_t taken = 0;
    if (nc_variable_range_check(&nc, static_cast<unsigned>(index), &taken) == NC_OK) {
      if (!kept) config->not_kept.push_back({first, last});
      return;
    }
    nc.variable_ranges[index] = {};
    if (taken != 0) reader.error("first", "#" + std::to_string(taken) + " is another variable already");
    else reader.error("last", "must be from first on, at most 10000 variables");
  });
}

}  // namespace

namespace {

// Names of the dialects, in the order of nc_dialect.
std::vector<std::string_view> dialects() {
  std::vector<std::string_view> names;
  for (int id = 0; nc_dialect_name(static_cast<nc_dialect>(id)) != nullptr; ++id) names.emplace_back(nc_dialect_name(static_cast<nc_dialect>(id)));
  return names;
}

}  // namespace

void read_machine(TableReader* root, Config* config) {
  root->require("machine");
  root->table("machine", [&](TableReader& reader) {
    nc_config& nc = config->nc;
    unsigned word = 0;
    reader.string("name", &config->name);
    if (reader.choice("dialect", dialects(), &word)) nc.dialect = static_cast<std::uint8_t>(word);
    read_machine_kind(&reader, machine_kinds(), config);
    reader.string("programs", &config->programs, TableReader::Empty::kTaken);
    config->programs_place = {reader.line("programs"), reader.path("programs")};
    reader.string("external", &config->external, TableReader::Empty::kTaken);
    if (reader.choice("program_encoding", {"utf-8", "latin-1", "shift-jis"}, &word)) config->program_text.encoding = static_cast<Encoding>(word);
    unsigned copy_mb = 0;
    if (reader.integer("program_copy_mb", &copy_mb, 0, 1024)) config->program_text.copy_bytes = std::uint64_t{copy_mb} << 20;
    reader.string("print", &config->print, TableReader::Empty::kTaken);
    reader.string("variables", &config->variables, TableReader::Empty::kTaken);
    config->variables_place = {reader.line("variables"), reader.path("variables")};
    reader.string("offsets", &config->offsets, TableReader::Empty::kTaken);
    config->offsets_place = {reader.line("offsets"), reader.path("offsets")};
    if (same_file(config->offsets, config->variables))
      reader.error("offsets", "is the file of the common variables too: variables");
    reader.number("retain_every_s", &config->retain_every_s, 0.02, 3600);
    reader.integer("cycle_us", &config->cycle_us, 100, 100000);
    nc.cycle_s = config->cycle_us * 1e-6;
    config->look_ahead_given = reader.integer("look_ahead", &nc.look_ahead, 64, 65536);
    if (config->look_ahead_given && !std::has_single_bit(nc.look_ahead)) reader.error("look_ahead", "must be a power of two");
    reader.integer("program_entries", &nc.programs, 1, 4096);
    reader.integer("tool_offset_sets", &nc.tool_offsets, 1, 999);
    reader.integer("work_offset_sets", &nc.work_offsets, 1, 300);
    reader.integer("contour_blocks", &nc.contour_blocks, 16, 1000000);
    if (reader.integer("variable_sets", &nc.variable_sets, 100, 600) && nc.variable_sets != 100 &&
        nc.variable_sets != 200 && nc.variable_sets != 300 && nc.variable_sets != 600)
      reader.error("variable_sets", "must be 100, 200, 300 or 600");  // M700 13.4
    reader.boolean("extended_variables", &nc.extended_variables);
    read_variable_ranges(&reader, config);
    reader.boolean("macro_extensions", &config->macro_extensions);
    config->macro_extensions_place = {reader.line("macro_extensions"), reader.path("macro_extensions")};
    reader.boolean("negative_count", &config->negative_count);
    config->negative_count_place = {reader.line("negative_count"), reader.path("negative_count")};
    reader.integer("window_bytes", &nc.window_bytes, 4096, 1 << 24);
    read_spindles(&reader, config);
    read_tool_axes(&reader, config);
    reader.number("max_feed_override", &nc.max_feed_override, 1.0, 3.0);
  });
}

void read_scheduling(TableReader* root, Config* config) {
  root->table("scheduling", [&](TableReader& reader) {
    SchedulingConfig& scheduling = config->scheduling;
    unsigned word = 0;
    if (reader.choice("policy", {"fifo", "other"}, &word)) scheduling.fifo = word == 0;
    reader.integer("priority", &scheduling.priority, 1, 98);
    reader.integer("cpu", &scheduling.cpu, -1, 1023);
    scheduling.cpu_place = {reader.line("cpu"), reader.path("cpu")};
    reader.boolean("lock_memory", &scheduling.lock_memory);
    reader.integer("feeder_us", &scheduling.feeder_us, 100, 100000);
    if (reader.choice("overrun", {"count", "feed_hold", "alarm"}, &word))
      scheduling.overrun = static_cast<OverrunReaction>(word);
    reader.integer("overrun_limit", &scheduling.overrun_limit, 1, 1000000);
  });
}

void read_axes(TableReader* root, Config* config) {
  root->require("axis");
  root->tables("axis", [&](TableReader& reader, std::size_t) { read_axis(&reader, config); });
  for (unsigned s = 0; s < config->nc.system_count; ++s) {
    if (config->nc.system[s].axis_count == 0 && root->find("axis") != nullptr)
      root->error("axis", "part system " + std::to_string(s + 1) + " has no axis");
    config->sim.axis_count[s] = config->nc.system[s].axis_count;
    config->sim.start[s] = config->start[s];
    for (unsigned a = 0; a < config->nc.system[s].axis_count; ++a) config->sim.axis_spindle[s][a] = config->nc.system[s].axis[a].spindle;
  }
  if (config->spindles_given > config->nc.system_count)
    root->errors()->add(config->spindles_place.line, config->spindles_place.key,
                        "counts the spindles of " + std::to_string(config->spindles_given) + " part systems, and the axes belong to " +
                            std::to_string(config->nc.system_count));
  if (config->tool_axes_given > config->nc.system_count)
    root->errors()->add(config->tool_axes_place.line, config->tool_axes_place.key,
                        "has a word for " + std::to_string(config->tool_axes_given) + " part systems, and the axes belong to " + std::to_string(config->nc.system_count));
  config->sim.system_count = config->nc.system_count;
  config->sim.cycle_s = config->nc.cycle_s;
  config->sim.dialect = config->nc.dialect;
}

void read_motion(TableReader* root, Config* config) {
  root->table("motion", [&](TableReader& reader) {
    nc_config& nc = config->nc;
    unsigned word = NC_MOTION_TRAPEZOID;
    config->motion_given = reader.choice("mode", {"trapezoid", "optimal"}, &word);
    if (config->motion_given) nc.motion_mode = static_cast<std::uint8_t>(word);
    reader.number("tolerance", &nc.path_tolerance, quantity::kPathTolerance);
    if (nc.path_tolerance > 0 && nc.path_tolerance < kLeastTolerance)
      reader.error("tolerance", "is 0 (a rest at each corner) or at least 0.0001 mm");
    reader.number("retract_overlap", &nc.retract_overlap, quantity::kOverlap);
    reader.number("tap_most_apart", &nc.tap_most_apart, 0.05, 100);
    const std::string lacks = optimal_lacks(nc);
    if (nc.motion_mode == NC_MOTION_OPTIMAL && !lacks.empty()) reader.error("mode", "optimal needs limits of velocity, acceleration and jerk of every axis, " + lacks);
  });
  nc_config& nc = config->nc;
  if (!config->motion_given) nc.motion_mode = static_cast<std::uint8_t>(default_motion(nc));
  if (nc.motion_mode == NC_MOTION_OPTIMAL && !config->look_ahead_given) nc.look_ahead = kLookAheadOptimal;
}

bool find_axis(const Config& config, std::string_view name, unsigned* system, unsigned* axis) {
  if (name.empty() || name.size() > 2) return false;
  unsigned s = 0;
  if (name.size() == 2) {
    if (name[1] < '1' || name[1] > '0' + NC_MAX_SYSTEMS) return false;
    s = static_cast<unsigned>(name[1] - '1');
  }
  if (s >= config.nc.system_count) return false;
  for (unsigned a = 0; a < config.nc.system[s].axis_count; ++a) {
    if (config.nc.system[s].axis[a].name != name[0]) continue;
    *system = s;
    *axis = a;
    return true;
  }
  return false;
}

}  // namespace nc::rt
