// SPDX-License-Identifier: Apache-2.0
// Configuration section [canopen]: the bus, its drives and their axes. docs/canopen.md.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "hal/canopen/bus_load.hpp"
#include "hal/canopen/eds.hpp"
#include "hal/canopen/frame.hpp"
#include "hal/canopen/setup_plan.hpp"
#include "runtime/config_sections.hpp"
#include "runtime/machine_canopen.hpp"

namespace nc::rt {
namespace {

using hal::canopen::AxisMap;
using hal::canopen::BusMap;
using hal::canopen::NodeMap;
using hal::canopen::ObjectValue;

constexpr double kMaxIncrements = 2147483647.0;  // the position of a drive is a signed number of 32 bits
constexpr double kMostCounted = 1 << 28;   // increments between two positions: an eighth of half the range
constexpr double kMostUnsigned = 4294967295.0;   // speeds and acceleration of its homing have no sign
constexpr unsigned kLastPdo = 512;
constexpr double kMostCanSeconds = 600;

void milliseconds(TableReader* reader, const char* key, unsigned* ms, double least) {
  double seconds = *ms / 1000.0;
  if (reader->number(key, &seconds, least, kMostCanSeconds)) *ms = static_cast<unsigned>(std::lround(seconds * 1000));
}

void read_bus(TableReader* reader, Config* config) {
  BusMap& bus = config->canopen;
  bus.cycle_us = bus.sync_us = config->cycle_us;
  reader->require("interface");
  reader->string("interface", &bus.interface);
  reader->integer("bit_rate", &bus.bit_s, 10'000, 1'000'000);
  if (reader->integer("sync_us", &bus.sync_us, 100, 100'000) && bus.sync_us % bus.cycle_us != 0)
    reader->error("sync_us", "must be a whole number of servo cycles (machine.cycle_us = " + std::to_string(bus.cycle_us) + ")");
  if (hal::canopen::interpolation_time_of(bus.sync_us).mantissa > 255)
    reader->error(reader->find("sync_us") != nullptr ? "sync_us" : "interface",
                  "a SYNC period of " + std::to_string(bus.sync_us) + " us cannot be told to a drive (60C2h): it must be a number up to 255 times a power of ten");
  reader->integer("heartbeat_ms", &bus.heartbeat_ms, 10, 10'000);
  reader->integer("node_id", &bus.own_id, hal::canopen::kFirstNode, hal::canopen::kLastNode);
  reader->integer("lost_after", &bus.lost_after, 1, 100);
  reader->integer("command_timeout_ms", &bus.command_timeout_ms, 1, 1000);
  reader->integer("sdo_timeout_ms", &bus.sdo_timeout_ms, 10, 10'000);
  milliseconds(reader, "boot_timeout_s", &bus.boot_timeout_ms, 0.1);
  milliseconds(reader, "enable_timeout_s", &bus.enable_timeout_ms, 0.01);
  milliseconds(reader, "stop_timeout_s", &bus.stop_timeout_ms, 0.01);
  reader->integer("priority", &bus.priority, 0, 98);
  bus.completes_functions = config->ladder.program.empty();
}

// What the drive is told of its homing are whole numbers of its own units, in 32 bits.
void check_homing_numbers(TableReader* reader, const AxisMap& map) {
  const double scale = std::abs(map.increments_per_unit);
  const std::string with = "with " + number_text(scale) + " increments per unit ";
  for (const auto& [key, value] : {std::pair{"fast", map.homing_fast}, {"slow", map.homing_slow}, {"acceleration", map.homing_acceleration}}) {
    if (reader->find(key) == nullptr || !(value > 0)) continue;
    if (value * scale > kMostUnsigned) reader->error(key, with + "is beyond the 32 bits that a drive takes");
    else if (value * scale < 0.5) reader->error(key, with + "is 0 for the drive, which would not move");
  }
}

// A drive that has homed says 0 at its mark (setup_plan.cpp), so `position` of the mark and `zero` are the same.
void read_mark(TableReader* axis, TableReader* homing, const nc_axis_config* moved, AxisMap* map) {
  double mark = 0;
  if (homing->number("position", &mark, -1e6, 1e6) && moved != nullptr && moved->soft_limited) {
    const double travel = moved->soft_max - moved->soft_min;  // it may lie behind a soft limit, and the axis gets there
    if (mark < moved->soft_min - travel || mark > moved->soft_max + travel) homing->error("position", "is farther beyond soft_limits than the axis travels (" + number_text(travel) + ")");
  }
  if (axis->find("zero") != nullptr && map->zero != mark)
    axis->error("zero", "is not homing.position: the drive says 0 at the mark of its homing, so leave zero out");
  map->zero = mark;
}

void read_homing(TableReader* axis, const nc_axis_config* moved, Config* config, AxisMap* map) {
  axis->table("homing", [&](TableReader& reader) {
    for (const char* key : {"method", "fast", "slow", "request", "done"}) reader.require(key);
    if (reader.integer("method", &map->homing_method, -128, 127) && map->homing_method == 0) reader.error("method", "0 is no homing: leave the table out");
    reader.number("fast", &map->homing_fast, quantity::kSpeed);
    reader.number("slow", &map->homing_slow, quantity::kSpeed);
    reader.number("acceleration", &map->homing_acceleration, quantity::kAcceleration);
    read_mark(axis, &reader, moved, map);
    reader.number("timeout_s", &map->homing_timeout_s, 0.1, 3600);
    check_homing_numbers(&reader, *map);
    read_drive_point(&reader, "request", hal::PointType::kBit, hal::PointDirection::kOutput, PointRole::kDriveHoming, *map, config, &map->homing_request);
    read_drive_point(&reader, "done", hal::PointType::kBit, hal::PointDirection::kInput, PointRole::kDriveHomed, *map, config, &map->homed);
  });
}

void read_probe(TableReader* axis, AxisMap* map) {
  axis->table("probe", [&](TableReader& reader) {
    unsigned edge = 0;
    reader.require("skip_signal");
    reader.integer("skip_signal", &map->skip_signal, 1, 8);
    if (reader.choice("edge", {"rising", "falling"}, &edge)) map->skip_falling = edge == 1;
  });
}

// `mode = "velocity"`: the drive is given a speed.
void read_mode(TableReader* reader, const BusMap& bus, double encoder, AxisMap* map) {
  unsigned mode = 0;
  double scale = encoder / 60;  // 60FFh in increments/s
  reader->choice("mode", {"position", "velocity"}, &mode);
  if (mode == 0) {
    for (const char* key : {"velocity_gain", "velocity_scale", "velocity_delay"})
      if (reader->find(key) != nullptr) reader->error(key, "belongs to mode = \"velocity\"");
    return;
  }
  map->mode = hal::canopen::kModeCyclicVelocity;
  read_loop_gain(reader, "velocity_gain", 0.1, 1000, bus.sync_us, "the axis", &map->velocity_gain);
  reader->number("velocity_delay", &map->velocity_delay, 0, hal::canopen::kMostVelocityDelay);
  reader->number("velocity_scale", &scale, 1e-6, 1e6);
  if (encoder > 0) map->velocity_per_increment = scale * 60 / encoder;
  if (!(map->following_limit > 0)) reader->error("following_error_limit", "is needed with mode = \"velocity\": the drive does not check the position");
}

// Computes the increments per mm or degree from encoder, gear and pitch. @return increments per turn of the motor, 0 when that is not known
double read_scale(TableReader* reader, AxisMap* map) {
  double encoder = 0, pitch = 0;
  bool reverse = false;
  std::vector<double> gear{1, 1};
  for (const char* key : {"encoder", "pitch"}) reader->require(key);
  const bool turns = reader->number("encoder", &encoder, 1, 4294967296.0), way = reader->number("pitch", &pitch, 1e-6, 1e6);
  if (reader->numbers("gear", &gear, 2, 2) && !(gear[0] > 0 && gear[1] > 0 && gear[0] <= 1e6 && gear[1] <= 1e6))
    reader->error("gear", "is [turns of the motor, turns of the screw], both above 0");
  reader->boolean("reverse", &reverse);
  if (turns && way && gear.size() == 2 && gear[1] > 0) map->increments_per_unit = (reverse ? -1 : 1) * encoder * gear[0] / gear[1] / pitch;
  return turns ? encoder : 0;
}

// Every position inside the soft limits must be a number that the drive can represent.
void check_range(TableReader* reader, const Config& config, const AxisMap& map) {
  const nc_axis_config& axis = config.nc.system[map.system].axis[map.axis];
  if (!axis.soft_limited) return;
  for (const double place : {axis.soft_min, axis.soft_max})
    if (std::abs((place - map.zero) * map.increments_per_unit) > kMaxIncrements)
      return reader->error("pitch", "with " + number_text(std::abs(map.increments_per_unit)) + " increments per unit the soft limit " + number_text(place) +
                                        " is beyond the 32 bits of a drive's position");
}

// Every speed that the axis may have must be a number that the drive can be given.
void check_speed(TableReader* reader, const AxisMap& map) {
  const double most = map.max_velocity * std::abs(map.increments_per_unit * map.velocity_per_increment);
  if (map.holds_position() && most > kMaxIncrements)
    reader->error("velocity_scale", "makes " + number_text(most) + " of the largest velocity, which is beyond the 32 bits of 60FFh");
}

// The axis must stay far from half the range of a drive's position in the time in which positions may be missing, else nobody knows which way it went.
void check_count(TableReader* reader, const BusMap& bus, const AxisMap& map) {
  const double most = map.max_velocity * std::abs(map.increments_per_unit) * (bus.lost_after + 3) * bus.sync_us * 1e-6;
  if (most > kMostCounted)
    reader->error("encoder", "makes " + number_text(most) + " increments of the largest velocity in the time of lost_after (" + std::to_string(bus.lost_after) +
                                 " SYNCs), and the 32 bits of a drive's position can be followed over " + number_text(kMostCounted));
}

void read_drive_axis(TableReader* reader, Config* config, NodeMap* node) {
  AxisMap map;
  reader->require("name");
  const bool named = reader->string("name", &map.name);
  const bool found = named && find_axis(*config, map.name, &map.system, &map.axis);
  if (named && !found) reader->error("name", "there is no axis \"" + map.name + "\": see [[axis]]");
  read_drive_place(reader, *node, &map);
  const double encoder = read_scale(reader, &map);
  reader->number("zero", &map.zero, -1e6, 1e6);
  reader->number("following_error_limit", &map.following_limit, quantity::kErrorLimit);
  read_mode(reader, config->canopen, encoder, &map);
  read_homing(reader, found ? &config->nc.system[map.system].axis[map.axis] : nullptr, config, &map);
  read_probe(reader, &map);
  if (!found) return;
  map.max_velocity = config->nc.system[map.system].axis[map.axis].max_velocity;
  for (const NodeMap& other : config->canopen.nodes)
    for (const AxisMap& taken : other.axes)
      if (taken.system == map.system && taken.axis == map.axis) return reader->error("name", "axis " + map.name + " is on drive \"" + other.name + "\" already");
  for (const AxisMap& taken : node->axes)
    if (taken.system == map.system && taken.axis == map.axis) return reader->error("name", "axis " + map.name + " is on this drive already");
  check_range(reader, *config, map);
  check_speed(reader, map);
  check_count(reader, config->canopen, map);
  node->axes.push_back(map);
}

void read_object(TableReader* reader, NodeMap* node, std::vector<ConfigPlace>* places) {
  ObjectValue object;
  std::int64_t value = 0;
  for (const char* key : {"index", "value"}) reader->require(key);
  object.bytes = 4;
  reader->integer("index", &object.index, 0x1000, 0xFFFF);
  reader->integer("sub", &object.sub, 0, 255);
  if (reader->integer("bytes", &object.bytes, 1, 4) && object.bytes == 3) reader->error("bytes", "must be 1, 2 or 4");
  const std::int64_t span = std::int64_t{1} << 8 * object.bytes;
  if (reader->integer("value", &value, -span / 2, span - 1)) object.value = static_cast<std::uint32_t>(value);
  node->objects.push_back(object);
  places->push_back({reader->line("index"), reader->path("index")});
}

}  // namespace

// The gain is bounded by the SYNCs that a correction takes to act.
void read_loop_gain(TableReader* reader, const char* key, double least, double most, unsigned sync_us, const char* moves, double* gain) {
  constexpr double kMostTurn = 0.1;  // of an error that may be corrected in a SYNC: what is on its way for three of them must not be corrected twice
  const double bound = kMostTurn / (sync_us * 1e-6);
  if (!reader->number(key, gain, least, most)) *gain = std::min(*gain, bound);
  else if (*gain > bound) reader->error(key, "is too large for a SYNC of " + std::to_string(sync_us) + " us: " + moves + " would swing; at most " + number_text(bound));
}

void read_drive_place(TableReader* reader, const NodeMap& node, AxisMap* map) {
  map->slot = static_cast<unsigned>(node.axes.size());
  reader->integer("slot", &map->slot, 0, 7);
  map->rpdo = map->tpdo = 64 * map->slot + 1;  // default: the numbering that is usual for drives with several axes
  reader->integer("rpdo", &map->rpdo, 1, kLastPdo);
  reader->integer("tpdo", &map->tpdo, 1, kLastPdo);
  for (const AxisMap& other : node.axes)
    if (other.slot == map->slot) reader->error("slot", (other.spindle ? "" : "axis ") + other.name + " of this drive has it already");
}

void read_drive_point(TableReader* reader, const char* key, hal::PointType type, hal::PointDirection direction, PointRole role, const AxisMap& owner, Config* config, int* place) {
  std::string name;
  if (!reader->string(key, &name)) return;
  *place = config->points.find(name);
  if (*place < 0) return reader->error(key, "no point is named \"" + name + "\"");
  const hal::Point& point = config->points.at(static_cast<unsigned>(*place));
  const bool output = direction == hal::PointDirection::kOutput;
  if (point.type != type || point.direction != direction)
    reader->error(key, "point \"" + name + "\" must be a " + (type == hal::PointType::kBit ? "bit" : "word") + " and an " + (output ? "output" : "input"));
  else if (!output && point.bus != 0)
    reader->error(key, "point \"" + name + "\" is on another bus");
  else if (config->machine_kind != nullptr && config->machine_kind->name == "canopen")
    config->point_uses.push_back({role, *place, {reader->line(key), reader->path(key)}, static_cast<std::uint8_t>(owner.system), static_cast<std::uint8_t>(owner.axis % NC_MAX_AXES)});
}

void read_identity(TableReader* reader, NodeMap* node, std::vector<ConfigPlace>* objects) {
  reader->integer("vendor", &node->vendor, 0, 0xFFFFFFFFll);
  reader->integer("product", &node->product, 0, 0xFFFFFFFFll);
  reader->tables("objects", [&](TableReader& object, std::size_t) { read_object(&object, node, objects); });
}

void check_objects(ErrorList* errors, const BusMap& bus, const NodeMap& node, const std::vector<ConfigPlace>& objects) {
  const std::vector<ObjectValue> own = hal::canopen::own_objects(bus, node);
  for (std::size_t n = 0; n < objects.size(); ++n) {
    const ObjectValue& given = node.objects[n];
    if (std::none_of(own.begin(), own.end(), [&](const ObjectValue& each) { return each.index == given.index && each.sub == given.sub; })) continue;
    char name[16];
    std::snprintf(name, sizeof name, "%04Xh:%u", given.index, given.sub);
    errors->add(objects[n].line, objects[n].key, std::string(name) + " is set by the control itself, and would be taken back behind it");
  }
}

std::vector<std::string> eds_errors(const std::string& name, const Config& config, const NodeMap& node) {
  const std::filesystem::path own(name);
  const std::filesystem::path path = own.is_absolute() ? own : std::filesystem::path(config.file).parent_path() / own;
  std::error_code ignored;
  std::ifstream stream(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path, ignored) || !stream) return {"\"" + path.string() + "\" cannot be read"};
  std::string text(hal::canopen::kMostEdsBytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  hal::canopen::Eds eds;
  std::vector<hal::canopen::EdsError> errors = hal::canopen::read_eds(text, &eds);
  if (errors.empty()) errors = hal::canopen::check_eds(eds, node);
  std::vector<std::string> texts;
  texts.reserve(errors.size());
  for (const hal::canopen::EdsError& error : errors) texts.push_back(name + (error.line != 0 ? ":" + std::to_string(error.line) : "") + ": " + error.text);
  return texts;
}

namespace {

// A PDO of the drive carries one axis; the probe of an axis is in the one behind its own.
void check_pdo_numbers(TableReader* reader, const NodeMap& node) {
  const auto last = [](const AxisMap& map) { return map.tpdo + (map.has_probe() ? 1 : 0); };
  for (std::size_t n = 0; n < node.axes.size(); ++n) {
    const AxisMap& map = node.axes[n];
    if (last(map) > kLastPdo) reader->error("axis", map.name + " needs TPDO " + std::to_string(last(map)) + " for its probe, and the last one is " + std::to_string(kLastPdo));
    for (std::size_t before = 0; before < n; ++before) {
      const AxisMap& other = node.axes[before];
      const std::string both = other.name + " and " + map.name + " would have ";
      if (map.rpdo == other.rpdo) reader->error("axis", both + "RPDO " + std::to_string(map.rpdo) + " of this drive: rpdo");
      if (map.tpdo <= last(other) && other.tpdo <= last(map)) reader->error("axis", both + "TPDO " + std::to_string(std::max(map.tpdo, other.tpdo)) + " of this drive: tpdo");
    }
  }
}

void read_drive(TableReader* reader, Config* config) {
  NodeMap node;
  BusMap& bus = config->canopen;
  reader->require("node");
  if (reader->find("axis") == nullptr && reader->find("spindle") == nullptr) reader->error("axis", "is missing: [[canopen.drive.axis]], or [[canopen.drive.spindle]]");
  const bool numbered = reader->integer("node", &node.id, hal::canopen::kFirstNode, hal::canopen::kLastNode);
  node.name = "drive " + std::to_string(node.id);
  reader->string("name", &node.name);
  for (const NodeMap& other : bus.nodes)
    if (other.name == node.name) reader->error("name", (other.module ? "module \"" : "drive \"") + other.name + "\" is node " + std::to_string(other.id) + " already");
  reader->tables("axis", [&](TableReader& axis, std::size_t) { read_drive_axis(&axis, config, &node); });
  reader->tables("spindle", [&](TableReader& spindle, std::size_t) { read_drive_spindle(&spindle, config, &node); });
  std::vector<ConfigPlace> objects;
  read_identity(reader, &node, &objects);
  check_objects(reader->errors(), bus, node, objects);
  std::string eds;
  if (reader->string("eds", &eds))
    for (const std::string& error : eds_errors(eds, *config, node)) reader->error("eds", error);
  if (numbered && node.id == bus.own_id) reader->error("node", "is the control's own number: canopen.node_id");
  for (const NodeMap& other : bus.nodes)
    if (numbered && other.id == node.id) reader->error("node", (other.module ? "module \"" : "drive \"") + other.name + "\" has this number already");
  check_pdo_numbers(reader, node);
  unsigned sends = 0;
  for (const AxisMap& axis : node.axes) sends += axis.has_probe() ? 2 : 1;
  if (node.axes.size() > hal::canopen::kMaxAxesPerNode || sends > hal::canopen::kMaxAxesPerNode)
    reader->error("axis", "a node has identifiers for four PDOs of each direction: an axis takes one, its probe another one");
  if (bus.nodes.size() == hal::canopen::kMaxNodes) return reader->error("node", "there can be " + std::to_string(hal::canopen::kMaxNodes) + " drives and modules");
  bus.nodes.push_back(node);
}

void check_axes(TableReader* root, const Config& config) {
  for (unsigned s = 0; s < config.nc.system_count; ++s)
    for (unsigned a = 0; a < config.nc.system[s].axis_count; ++a) {
      const bool carried = std::any_of(config.canopen.nodes.begin(), config.canopen.nodes.end(), [&](const NodeMap& node) {
        return std::any_of(node.axes.begin(), node.axes.end(), [&](const AxisMap& map) { return map.system == s && map.axis == a; });
      });
      if (!carried)
        root->error("canopen", std::string("axis ") + config.nc.system[s].axis[a].name + (s > 0 ? std::to_string(s + 1) : "") + " is on no drive: [[canopen.drive.axis]]");
    }
}

void check_load(TableReader* reader, const BusMap& bus) {
  const hal::canopen::BusLoad load = hal::canopen::bus_load(bus);
  if (load.share > hal::canopen::kMostLoad || load.together > hal::canopen::kMostTogether)
    reader->error(reader->find("sync_us") != nullptr ? "sync_us" : "interface",
                  (load.share > hal::canopen::kMostLoad ? "the bus would be fuller than 80 %: " : "where the PDOs of all modules come together the bus would be fuller than 95 %: ") + load.arithmetic + "; a longer sync_us, or fewer axes on this bus");
}

}  // namespace

// The section may stand in the file of any machine, but only a machine with hal = "canopen" must have all its axes in it.
void read_canopen(TableReader* root, Config* config) {
  const bool chosen = config->machine_kind != nullptr && config->machine_kind->name == "canopen";
  const bool there = root->table("canopen", [&](TableReader& reader) {
    read_bus(&reader, config);
    reader.tables("drive", [&](TableReader& drive, std::size_t) { read_drive(&drive, config); });
    for (const CanIoConfig& module : config->can_io)
      if (config->canopen.nodes[module.node].id == config->canopen.own_id)
        reader.errors()->add(module.place.line, module.place.key, "is the control's own number: canopen.node_id");
    check_load(&reader, config->canopen);
  });
  if (!chosen) return;
  if (!there && root->find("canopen") == nullptr) return root->error("machine", "hal = \"canopen\" needs a section [canopen] that names the bus and its drives");
  check_axes(root, *config);
}

}  // namespace nc::rt
