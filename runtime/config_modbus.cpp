// SPDX-License-Identifier: Apache-2.0
// Configuration sections [[modbus]] and the `modbus` table of a [[point]]. docs/modbus.md.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>

#include "hal/modbus/codec.hpp"
#include "hal/modbus/serial_line.hpp"
#include "hal/serial_key.hpp"
#include "runtime/bus_modbus.hpp"
#include "runtime/config_sections.hpp"

namespace nc::rt {
namespace {

using hal::modbus::Format;
using hal::modbus::LinkConfig;
using hal::modbus::OnLoss;
using hal::modbus::OnStop;
using hal::modbus::PointMap;
using hal::modbus::Table;
using hal::modbus::WordOrder;
using hal::serial_key;

constexpr unsigned kLastAddress = 65535;
constexpr double kMaxScale = 1e9;
constexpr unsigned kLineByteTimeoutMs = 1000;  // what is in one frame of a serial line comes in one go

bool valid_link_name(const std::string& name) {
  return !name.empty() && name.size() <= 32 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

// libmodbus sends to 0 to 247 and 255. On a serial line 0 is everybody, who does not answer.
bool read_unit(TableReader* reader, const LinkConfig* link, std::uint8_t* unit) {
  unsigned read = 0;
  if (!reader->integer("unit", &read, 0, 255)) return false;
  if (link != nullptr && !link->serial.device.empty() && (read == 0 || read > 247)) {
    reader->error("unit", "must be from 1 to 247 on a serial line, not " + std::to_string(read));
    return false;
  }
  if (read > 247 && read < 255) {
    reader->error("unit", "must be from 0 to 247, or 255, not " + std::to_string(read));
    return false;
  }
  *unit = static_cast<std::uint8_t>(read);
  return true;
}

// Keys that have no meaning here are errors, not ignored.
void refuse(TableReader* reader, std::initializer_list<const char*> keys, const std::string& why) {
  for (const char* key : keys)
    if (reader->find(key) != nullptr) reader->error(key, why);
}

void read_host(TableReader* reader, LinkConfig* link) {
  refuse(reader, {"baud", "parity", "stop_bits", "rs485", "rts_delay_us"}, "is for a serial line: device = \"/dev/...\" and no host");
  reader->integer("port", &link->port, 1, 65535);
  reader->require("host");
  if (!reader->string("host", &link->host, TableReader::Empty::kTaken)) return;
  const bool graphic = std::all_of(link->host.begin(), link->host.end(), [](char c) { return c > ' ' && c <= '~'; });
  if (link->host.empty() || link->host.size() > 255 || !graphic)
    reader->error("host", "must be an address or the name of a host");
  else if (std::count(link->host.begin(), link->host.end(), ':') == 1)  // IPv6 has more of them
    reader->error("host", "must be an address or the name of a host; the port has a key of its own: port");
}

void read_line(TableReader* reader, const Config& config, LinkConfig* link) {
  hal::modbus::SerialConfig& line = link->serial;
  refuse(reader, {"host", "port"}, "is for TCP: a link has either a host or a device");
  if (reader->string("device", &line.device, TableReader::Empty::kTaken)) {
    if (line.device.empty() || line.device[0] != '/' || line.device.size() > 255) reader->error("device", "must be the path of a serial line, such as \"/dev/ttyS1\"");
    for (const ModbusLinkConfig& other : config.modbus)
      if (!line.device.empty() && serial_key(other.link.serial.device) == serial_key(line.device))
        reader->error("device", "link \"" + other.link.name + "\" has this line; its units are named at the points");
  }
  const auto* const rates = std::end(hal::modbus::kRates);
  if (reader->integer("baud", &line.baud, 1, 10000000) && std::find(std::begin(hal::modbus::kRates), rates, line.baud) == rates) {
    std::string all;
    for (const unsigned rate : hal::modbus::kRates) all += (all.empty() ? "" : ", ") + std::to_string(rate);
    reader->error("baud", "must be one of " + all);
  }
  unsigned parity = 1, rs485 = 0;
  if (reader->choice("parity", {"none", "even", "odd"}, &parity)) line.parity = "NEO"[parity];
  reader->integer("stop_bits", &line.stop_bits, 1, 2);
  if (reader->choice("rs485", {"none", "driver", "rts_high", "rts_low"}, &rs485)) line.rs485 = static_cast<hal::modbus::Rs485>(rs485);
  const bool rts = line.rs485 == hal::modbus::Rs485::kRtsHigh || line.rs485 == hal::modbus::Rs485::kRtsLow;
  if (!rts) refuse(reader, {"rts_delay_us"}, "is for rs485 = \"rts_high\" or \"rts_low\"");
  if (rts) reader->integer("rts_delay_us", &line.rts_delay_us, 0, 100000);
  if (link->byte_timeout_ms > kLineByteTimeoutMs) reader->error("byte_timeout_ms", "must be at most " + std::to_string(kLineByteTimeoutMs) + " on a serial line");
}

void read_link(TableReader* reader, Config* config) {
  ModbusLinkConfig entry;
  PointBusConfig bus;
  LinkConfig& link = entry.link;
  entry.place = {reader->line("name"), reader->path("name")};
  reader->require("name");
  const bool named = reader->string("name", &link.name);
  reader->integer("byte_timeout_ms", &link.byte_timeout_ms, 1, 60000);
  if (reader->find("device") != nullptr) read_line(reader, *config, &link);
  else read_host(reader, &link);
  read_unit(reader, &link, &entry.unit);
  reader->integer("poll_ms", &link.poll_ms, 1, 60000);
  reader->integer("response_timeout_ms", &link.response_timeout_ms, 1, 60000);
  reader->integer("lost_after", &link.lost_after, 1, 1000);
  reader->integer("refresh_ms", &link.refresh_ms, 10, 3600000);
  reader->integer("merge_gap", &link.merge_gap, 0, 124);
  reader->boolean("alarm", &bus.alarm);
  if (!named) return;
  if (!valid_link_name(link.name)) {
    reader->error("name", "must be 1 to 32 letters, digits, '_' or '-'");
    return;
  }
  for (const PointBusConfig& other : config->buses)
    if (other.name == link.name) return reader->errors()->add_twice({reader->line("name"), reader->path("name")}, other.named_at, "link \"" + link.name + "\" is already there");
  if (config->buses.size() == kMaxPointBuses) {
    reader->error("name", "there are more than " + std::to_string(kMaxPointBuses) + " links");
    return;
  }
  hal::Point ok;
  ok.name = link.name + ".ok";
  ok.meaning = "the Modbus link answers";
  ok.bus = entry.bus = static_cast<std::uint8_t>(config->buses.size() + 1);
  link.ok_point = bus.ok_point = config->points.size();
  if (!config->points.add(ok)) reader->error("name", "there is no room for the point \"" + ok.name + "\"");
  bus.name = link.name;
  bus.device = link.serial.device.empty() ? link.host + " port " + std::to_string(link.port) : link.serial.device;
  bus.place = config->modbus.size();
  bus.named_at = {reader->line("name"), reader->path("name")};
  config->buses.push_back(std::move(bus));
  config->modbus.push_back(std::move(entry));
}

// ---- the `modbus` table of a point ----

bool read_table(TableReader* reader, Table* table) {
  unsigned word = 0;
  reader->require("table");
  if (!reader->choice("table", {"coil", "discrete", "input", "holding"}, &word)) return false;
  *table = static_cast<Table>(word);
  return true;
}

std::optional<WordOrder> word_order(std::string_view text) {
  constexpr std::string_view kOrders[] = {"ABCD", "CDAB", "BADC", "DCBA"};
  for (unsigned i = 0; i < 4; ++i)
    if (kOrders[i] == text) return static_cast<WordOrder>(i);
  return {};
}

void read_bit_format(TableReader* reader, PointMap* map) {
  map->format = Format::kBit;
  refuse(reader, {"words", "signed", "float", "scale", "offset"}, "has no meaning: the point is a bit");
  if (hal::modbus::is_bit_table(map->table)) {
    refuse(reader, {"bit"}, std::string("has no meaning in table \"") + table_name(map->table) + "\"");
  } else {
    reader->require("bit");
    reader->integer("bit", &map->bit, 0, 15);
  }
}

void read_word_format(TableReader* reader, PointMap* map) {
  bool is_signed = false, is_float = false;
  refuse(reader, {"bit"}, "has no meaning: the point is a word");
  if (hal::modbus::is_bit_table(map->table))
    reader->error("table",
                  std::string("\"") + table_name(map->table) + "\" holds bits, but the point is a word");
  reader->boolean("signed", &is_signed);
  reader->boolean("float", &is_float);
  std::string order;
  const bool wide = reader->string("words", &order, TableReader::Empty::kTaken) || is_float;
  if (!order.empty() || reader->find("words") != nullptr) {
    const auto read = word_order(order);
    if (read)
      map->order = *read;
    else if (const auto* node = reader->find("words"); node->is_string())
      reader->error(
          "words",
          "must be \"ABCD\", \"CDAB\", \"BADC\" or \"DCBA\", the order of a 32-bit value; a value of "
          "16 bits has none and leaves the key out");
  }
  if (is_float && reader->find("signed") != nullptr)
    reader->error("signed", "has no meaning: a float has a sign of its own");
  map->format = is_float            ? Format::kF32
                : wide && is_signed ? Format::kS32
                : wide              ? Format::kU32
                : is_signed         ? Format::kS16
                                    : Format::kU16;
  if (reader->number("scale", &map->scale, -kMaxScale, kMaxScale) && std::abs(map->scale) < 1 / kMaxScale)
    reader->error("scale", "must not be zero or nearly so");
  reader->number("offset", &map->offset, -4294967295.0, 4294967295.0);
}

std::string range_text(const hal::modbus::ValueRange& range) {
  return std::to_string(range.min) + " to " + std::to_string(range.max);
}

// The initial value of an output is written into the register unchanged, and an input has it until the first answer. So a value outside
// the range of the register is an error; it is not clamped.
void check_initial(TableReader* point_reader, const PointMap& map) {
  const bool given = point_reader->find("initial") != nullptr;
  if (!given && !map.output) return;
  const bool is_signed = map.format != Format::kBit && point_is_signed(map);
  const std::int64_t value = is_signed ? static_cast<std::int32_t>(map.initial) : std::int64_t{map.initial};
  const hal::modbus::ValueRange range = value_range(map);
  if (range.holds(value)) return;
  point_reader->error("initial", std::string(given ? "must be" : "is 0 when it is left out, but must be") + " from " + range_text(range) + ", what " + table_name(map.table) + " " +
                                     std::to_string(map.address) + " can hold with its sign, width and scale, not " +
                                     std::to_string(value) + (value > INT32_MAX ? ", which is what " + std::to_string(value - 0x100000000) + " means here" : ""));
}

// Reads "hold", "off" or a number, which may be written as a text. With kValue the number is in *kept.
enum class Kept { kNothing, kHold, kOff, kValue };
Kept read_kept(TableReader* reader, const char* key, const PointMap& map, std::uint32_t* kept) {
  const toml::node* node = reader->find(key);
  const hal::modbus::ValueRange range = value_range(map);
  std::int64_t value = 0;
  bool number = false;
  if (const auto* integer = node->as_integer()) {
    value = integer->get();
    number = true;
  } else if (const auto* text = node->as_string()) {
    const std::string& word = text->get();
    const auto read = std::from_chars(word.data(), word.data() + word.size(), value);
    number = !word.empty() && read.ec == std::errc{} && read.ptr == word.data() + word.size();
    if (word == "hold") return Kept::kHold;
    if (word == "off") return Kept::kOff;
  }
  if (!number || !range.holds(value)) {
    reader->error(key, "must be \"hold\", \"off\" or a number from " + range_text(range));
    return Kept::kNothing;
  }
  *kept = static_cast<std::uint32_t>(value);
  return Kept::kValue;
}

void read_on_loss(TableReader* reader, PointMap* map) {
  if (reader->find("on_loss") == nullptr) return;
  if (map->output) {
    reader->error(
        "on_loss",
        "is for inputs; an output has on_stop for the end of the control, and what the device does without "
        "the link is set in the device");
    return;
  }
  const Kept kept = read_kept(reader, "on_loss", *map, &map->loss_value);
  if (kept == Kept::kHold) map->on_loss = OnLoss::kHold;
  if (kept == Kept::kValue) map->on_loss = OnLoss::kValue;
}

void read_on_stop(TableReader* reader, PointMap* map) {
  if (reader->find("on_stop") == nullptr) return;
  if (!map->output) {
    reader->error("on_stop", "is for outputs; an input has on_loss");
    return;
  }
  const Kept kept = read_kept(reader, "on_stop", *map, &map->stop_value);
  if (kept == Kept::kHold) map->on_stop = OnStop::kHold;
  if (kept == Kept::kValue || kept == Kept::kOff) map->on_stop = OnStop::kValue;
  if (kept == Kept::kOff && !value_range(*map).holds(0))
    reader->error("on_stop", "\"off\" is 0, and the register can only hold " + range_text(value_range(*map)));
}

// True when two outputs write the same bits. Two outputs may share a register only when they are different bits of it.
bool collide(const PointMap& a, const PointMap& b) {
  if (!a.output || !b.output || a.unit != b.unit || a.table != b.table) return false;
  if (a.address >= b.end() || b.address >= a.end()) return false;
  const bool bits = a.format == Format::kBit && b.format == Format::kBit && !is_bit_table(a.table);
  return !bits || a.bit == b.bit;
}

// True when two outputs are parts of one register. The bits of a register are written together, so at the end of the control either all of
// them are written or none.
bool share_a_register(const PointMap& a, const PointMap& b) {
  return a.output && b.output && a.unit == b.unit && a.table == b.table && !is_bit_table(a.table) && a.address < b.end() && b.address < a.end();
}

void check_collisions(TableReader* reader, const Config& config, const LinkConfig& link,
                      const PointMap& map) {
  for (const ModbusLinkConfig& other : config.modbus) {
    if (other.link.partner() != link.partner()) continue;
    for (const PointMap& taken : other.link.points) {
      if (share_a_register(map, taken) && map.holds() != taken.holds() && !collide(map, taken)) {
        reader->error("on_stop", "\"hold\" is for all bits of a register or for none: \"" + config.points.at(taken.point).name + "\" is one, too");
        return;
      }
      if (!collide(map, taken)) continue;
      reader->error("address", "point \"" + config.points.at(taken.point).name + "\" writes " +
                                   table_name(map.table) + " " + std::to_string(taken.address) + " of unit " +
                                   std::to_string(taken.unit) + " as well");
      return;
    }
  }
}

}  // namespace

void read_modbus(TableReader* root, Config* config) {
  root->tables("modbus", [&](TableReader& reader, std::size_t) { read_link(&reader, config); });
}

PlaceOnBus read_point_modbus(TableReader* point_reader, const hal::Point& point, Config* config) {
  PlaceOnBus result;
  point_reader->table("modbus", [&](TableReader& reader) {
    PointMap map;
    map.output = point.direction == hal::PointDirection::kOutput;
    map.initial = point.initial;
    for (const char* key : {"link", "address"}) reader.require(key);
    std::string name;
    const bool linked = reader.string("link", &name);
    const auto link = std::find_if(config->modbus.begin(), config->modbus.end(),
                                   [&](const ModbusLinkConfig& entry) { return entry.link.name == name; });
    const bool found = linked && link != config->modbus.end();
    if (linked && !found) reader.error("link", "no link is named \"" + name + "\": see [[modbus]]");
    if (found) map.unit = link->unit;
    if (found) link->named = true;
    read_unit(&reader, found ? &link->link : nullptr, &map.unit);
    const bool placed = read_table(&reader, &map.table);
    if (placed && map.output && !can_be_written(map.table))
      reader.error("table", std::string("\"") + table_name(map.table) +
                                "\" can only be read, but the point is an output");
    if (point.type == hal::PointType::kBit)
      read_bit_format(&reader, &map);
    else
      read_word_format(&reader, &map);
    const bool addressed = reader.integer("address", &map.address, 0, kLastAddress);
    if (addressed && map.end() > kLastAddress + 1)
      reader.error("address", "a 32-bit value needs two registers, the second would be 65536");
    read_on_loss(&reader, &map);
    read_on_stop(&reader, &map);
    if (placed && addressed) check_initial(point_reader, map);
    if (!found || !placed || !addressed) return;
    check_collisions(&reader, *config, link->link, map);
    result.bus = link->bus;
    result.add = [map, place = link - config->modbus.begin()](Config* owner) mutable {
      map.point = owner->points.size() - 1;
      owner->modbus[static_cast<std::size_t>(place)].link.points.push_back(map);
    };
  });
  return result;
}

void check_modbus(TableReader* root, const Config& config) {
  for (const ModbusLinkConfig& entry : config.modbus)
    if (!entry.named)
      root->errors()->add(entry.place.line, entry.place.key,
                          "no point uses the link \"" + entry.link.name + "\"");
}

}  // namespace nc::rt
