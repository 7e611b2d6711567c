// SPDX-License-Identifier: Apache-2.0
// Configuration sections [[can_io]] and the `can_io` table of a [[point]]. docs/canopen.md.
#include <algorithm>

#include "hal/canopen/frame.hpp"
#include "runtime/bus_can_io.hpp"
#include "runtime/config_sections.hpp"
#include "runtime/machine_canopen.hpp"

namespace nc::rt {
namespace {

using hal::canopen::IoPoint;
using hal::canopen::ModuleMap;
using hal::canopen::NodeMap;

constexpr unsigned kMostEvery = 240;  // synchronous transmission types of CiA 301
constexpr std::int64_t kLeastAnalog = -32768, kMostAnalogValue = 32767;

bool valid_module_name(const std::string& name) {
  return !name.empty() && name.size() <= 32 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

// The name is free and there is room. The module is a bus and a node then.
void add_module(TableReader* reader, NodeMap node, CanIoConfig entry, PointBusConfig bus, Config* config) {
  if (!valid_module_name(node.name)) return reader->error("name", "must be 1 to 32 letters, digits, '_' or '-'");
  for (const PointBusConfig& other : config->buses)
    if (other.name == node.name) return reader->errors()->add_twice({reader->line("name"), reader->path("name")}, other.named_at, "a bus \"" + node.name + "\" is already there");
  for (const NodeMap& other : config->canopen.nodes)
    if (other.id == node.id) return reader->error("node", "module \"" + other.name + "\" has this number already");
  if (config->can_io.size() == hal::canopen::kMaxModules) return reader->error("name", "there can be " + std::to_string(hal::canopen::kMaxModules) + " modules");
  if (config->buses.size() == kMaxPointBuses) return reader->error("name", "there are more than " + std::to_string(kMaxPointBuses) + " buses");
  hal::Point ok;
  ok.name = node.name + ".ok";
  ok.meaning = "the I/O module answers";
  ok.bus = entry.bus = static_cast<std::uint8_t>(config->buses.size() + 1);
  node.module->ok_point = bus.ok_point = config->points.size();
  if (!config->points.add(ok)) reader->error("name", "there is no room for the point \"" + ok.name + "\"");
  bus.name = entry.name = node.name;
  bus.device = "node " + std::to_string(node.id);
  bus.place = config->can_io.size();
  bus.named_at = {reader->line("name"), reader->path("name")};
  entry.node = config->canopen.nodes.size();
  config->canopen.nodes.push_back(std::move(node));
  config->buses.push_back(std::move(bus));
  config->can_io.push_back(std::move(entry));
}

void read_module(TableReader* reader, Config* config) {
  NodeMap node;
  node.module = ModuleMap{};
  CanIoConfig entry;
  PointBusConfig bus;
  for (const char* key : {"name", "node"}) reader->require(key);
  const bool named = reader->string("name", &node.name);
  const bool numbered = reader->integer("node", &node.id, hal::canopen::kFirstNode, hal::canopen::kLastNode);
  entry.place = {reader->line("node"), reader->path("node")};
  reader->integer("every", &node.module->every, 1, kMostEvery);
  reader->boolean("alarm", &bus.alarm);
  read_identity(reader, &node, &entry.objects);
  if (reader->string("eds", &entry.eds)) entry.eds_place = {reader->line("eds"), reader->path("eds")};
  if (config->machine_kind == nullptr || config->machine_kind->name != "canopen")
    return reader->error("name", "an I/O module is on the bus of the drives: it needs machine.hal = \"canopen\"");
  if (named && numbered) add_module(reader, std::move(node), std::move(entry), std::move(bus), config);
}

// ---- the `can_io` table of a point ----

bool read_io_value(TableReader* reader, const char* key, bool analog, std::uint32_t* value) {
  std::int64_t number = 0;
  if (!reader->integer(key, &number, analog ? kLeastAnalog : 0, analog ? kMostAnalogValue : 1)) return false;
  *value = static_cast<std::uint32_t>(number);
  return true;
}

// on_loss = "hold" or a value.
void read_io_loss(TableReader* reader, IoPoint* io) {
  const toml::node* node = reader->find("on_loss");
  if (node == nullptr) return;
  if (node->as_string() == nullptr) {
    read_io_value(reader, "on_loss", io->analog, &io->loss_value);
  } else if (node->as_string()->get() == "hold") {
    io->hold_on_loss = true;
  } else {
    reader->error("on_loss", io->analog ? "must be \"hold\" or a number from -32768 to 32767" : "must be \"hold\", 0 or 1");
  }
}

void read_direction(TableReader* reader, const hal::Point& point, IoPoint* io) {
  const char* other = io->output ? "on_loss" : "on_stop";
  if (reader->find(other) != nullptr) reader->error(other, io->output ? "is for inputs; an output has on_stop" : "is for outputs; an input has on_loss");
  io->stop_value = point.initial;
  if (io->output) read_io_value(reader, "on_stop", io->analog, &io->stop_value);
  else read_io_loss(reader, io);
  if (io->analog && reader->find("active_low") != nullptr) reader->error("active_low", "is for digital inputs and outputs");
  else reader->boolean("active_low", &io->active_low);
}

// `digital = 3` or `analog = 1`: the number of the input or output on the module, from 1. False when it is not clear which one is meant.
bool read_channel(TableReader* reader, IoPoint* io) {
  const bool digital = reader->find("digital") != nullptr;
  io->analog = reader->find("analog") != nullptr;
  if (digital == io->analog) {
    reader->error(digital ? "analog" : "digital", digital ? "has no meaning beside digital" : "is missing: the number of the input or output on the module; or analog");
    return false;
  }
  unsigned number = 0;
  const bool read = reader->integer(io->analog ? "analog" : "digital", &number, 1, io->analog ? hal::canopen::kMostAnalog : hal::canopen::kMostDigital);
  io->channel = number - 1;
  return read;
}

void check_channel(TableReader* reader, const Config& config, const NodeMap& node, const IoPoint& io) {
  for (const IoPoint& other : node.module->points)
    if (other.output == io.output && other.analog == io.analog && other.channel == io.channel)
      reader->error(io.analog ? "analog" : "digital", "point \"" + config.points.at(other.point).name + "\" is on it already");
}

}  // namespace

void read_can_io(TableReader* root, Config* config) {
  root->tables("can_io", [&](TableReader& reader, std::size_t) { read_module(&reader, config); });
}

PlaceOnBus read_point_can_io(TableReader* point_reader, const hal::Point& point, Config* config) {
  PlaceOnBus result;
  point_reader->table("can_io", [&](TableReader& reader) {
    IoPoint io;
    io.output = point.direction == hal::PointDirection::kOutput;
    reader.require("module");
    std::string name;
    const bool given = reader.string("module", &name);
    const auto module = std::find_if(config->can_io.begin(), config->can_io.end(), [&](const CanIoConfig& entry) { return entry.name == name; });
    const bool found = given && module != config->can_io.end();
    if (given && !found) reader.error("module", "no module is named \"" + name + "\": see [[can_io]]");
    if (found) module->named = true;
    const bool placed = read_channel(&reader, &io);
    const bool fits = io.analog == (point.type == hal::PointType::kWord);
    if (placed && !fits) reader.error(io.analog ? "analog" : "digital", io.analog ? "is a word, but the point is a bit: type = \"word\"" : "is a bit, but the point is a word");
    read_direction(&reader, point, &io);
    if (!found || !placed || !fits) return;
    check_channel(&reader, *config, config->canopen.nodes[module->node], io);
    result.bus = module->bus;
    result.add = [io, node = module->node](Config* owner) mutable {
      io.point = owner->points.size() - 1;
      owner->canopen.nodes[node].module->points.push_back(io);
    };
  });
  return result;
}

// Its PDOs, and so the objects that the control sets and those of the data sheet, are known only behind all points.
void check_can_io(TableReader* root, const Config& config) {
  for (const CanIoConfig& entry : config.can_io) {
    if (!entry.named) root->errors()->add(entry.place.line, entry.place.key, "no point uses the module \"" + entry.name + "\"");
    check_objects(root->errors(), config.canopen, config.canopen.nodes[entry.node], entry.objects);
    if (entry.eds.empty()) continue;
    for (const std::string& error : eds_errors(entry.eds, config, config.canopen.nodes[entry.node])) root->errors()->add(entry.eds_place.line, entry.eds_place.key, error);
  }
}

}  // namespace nc::rt
