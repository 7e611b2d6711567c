// SPDX-License-Identifier: Apache-2.0
// Configuration sections [[gpio]] and the `gpio` table of a [[point]]. docs/gpio.md.
#include <algorithm>
#include <cstdint>

#include "hal/gpio/bank_config.hpp"
#include "hal/place_track.hpp"
#include "runtime/bus_gpio.hpp"
#include "runtime/config_sections.hpp"

namespace nc::rt {
namespace {

using hal::gpio::BankConfig;
using hal::gpio::Bias;
using hal::gpio::Drive;
using hal::gpio::Encoder;
using hal::gpio::LineSetup;
using hal::gpio::PointLine;
using hal::gpio::Probe;

constexpr unsigned kNarrow = 16, kWide = 32;  // bits of a count
constexpr std::size_t kMaxKernelName = 31;  // longest label of a chip, name of a line or consumer in the kernel, in bytes

bool valid_bank_name(const std::string& name) {
  return !name.empty() && name.size() <= 32 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

// Reads a name that is no longer than the kernel allows. The path of a chip may be longer.
bool read_kernel_name(TableReader* reader, const char* key, std::string* name) {
  std::string read;
  if (!reader->string(key, &read, TableReader::Empty::kTaken)) return false;
  const std::size_t most = key == std::string_view("chip") && read.starts_with('/') ? 255 : kMaxKernelName;
  if (read.empty() || read.size() > most) {
    reader->error(key, "must have 1 to " + std::to_string(most) + " bytes");
    return false;
  }
  *name = read;
  return true;
}

void read_settings(TableReader* reader, LineSetup* line) {
  unsigned word = 0;
  reader->boolean("active_low", &line->active_low);
  if (reader->choice("bias", {"as-is", "none", "pull-up", "pull-down"}, &word)) line->bias = static_cast<Bias>(word);
  if (reader->choice("drive", {"push-pull", "open-drain", "open-source"}, &word)) line->drive = static_cast<Drive>(word);
  if (!line->output && reader->find("drive") != nullptr) reader->error("drive", "is for outputs");
}

// Reads `line = "NAME"` or `offset = 17`, and the keys that points and the watchdog have in common. False when it is not clear which line is meant.
bool read_line(TableReader* reader, LineSetup* line) {
  read_settings(reader, line);
  const bool named = reader->find("line") != nullptr, numbered = reader->find("offset") != nullptr;
  if (named && numbered) reader->error("offset", "has no meaning beside line, which says which one it is");
  if (named) return read_kernel_name(reader, "line", &line->name) && !numbered;
  if (numbered) return reader->integer("offset", &line->offset, 0, 65535);
  reader->error("line", "is missing: the name of the line, or its offset on the chip as offset");
  return false;
}

bool same_line(const LineSetup& one, const LineSetup& other) {
  return one.name == other.name && (!one.name.empty() || one.offset == other.offset);
}

const char* key_of(const LineSetup& line) { return line.name.empty() ? "offset" : "line"; }

void read_bank(TableReader* reader, Config* config) {
  GpioBankConfig entry;
  PointBusConfig bus;
  BankConfig& bank = entry.bank;
  entry.place = {reader->line("name"), reader->path("name")};
  for (const char* key : {"name", "chip"}) reader->require(key);
  const bool named = reader->string("name", &bank.name);
  const bool has_chip = read_kernel_name(reader, "chip", &bank.chip);
  read_kernel_name(reader, "consumer", &bank.consumer);
  reader->integer("poll_ms", &bank.poll_ms, 1, 100);
  reader->integer("lost_after", &bank.lost_after, 1, 1000);
  reader->boolean("alarm", &bus.alarm);
  reader->table("watchdog", [&](TableReader& watchdog) {
    bank.watchdog.output = true;
    bank.has_watchdog = read_line(&watchdog, &bank.watchdog);
    entry.named = true;  // a bank with a watchdog needs no points
  });
  if (!named) return;
  if (!valid_bank_name(bank.name)) return reader->error("name", "must be 1 to 32 letters, digits, '_' or '-'");
  for (const PointBusConfig& other : config->buses)
    if (other.name == bank.name) return reader->errors()->add_twice(entry.place, other.named_at, "a bus \"" + bank.name + "\" is already there");
  for (const GpioBankConfig& other : config->gpio)
    if (has_chip && other.bank.chip == bank.chip) return reader->error("chip", "\"" + bank.chip + "\" is the chip of \"" + other.bank.name + "\" already: its lines are one bank");
  if (config->buses.size() == kMaxPointBuses) return reader->error("name", "there are more than " + std::to_string(kMaxPointBuses) + " buses");
  hal::Point ok;
  ok.name = bank.name + ".ok";
  ok.meaning = "the GPIO lines are there";
  ok.bus = entry.bus = static_cast<std::uint8_t>(config->buses.size() + 1);
  bank.ok_point = bus.ok_point = config->points.size();
  if (!config->points.add(ok)) reader->error("name", "there is no room for the point \"" + ok.name + "\"");
  bus.name = bank.name;
  bus.device = "chip " + bank.chip;
  bus.place = config->gpio.size();
  bus.named_at = entry.place;
  config->buses.push_back(std::move(bus));
  config->gpio.push_back(std::move(entry));
}

// ---- the `gpio` table of a point ----

void refuse(TableReader* reader, std::initializer_list<const char*> keys, const char* why) {
  for (const char* key : keys)
    if (reader->find(key) != nullptr) reader->error(key, why);
}

// Reads a level: "off", 0 or 1, and with `may_hold` also "hold". True when the key is there, even when its value is wrong.
bool read_level(TableReader* reader, const char* key, bool may_hold, bool* hold, std::uint8_t* value) {
  const toml::node* node = reader->find(key);
  if (node == nullptr) return false;
  const auto* number = node->as_integer();
  const auto* word = node->as_string();
  if (may_hold && word != nullptr && word->get() == "hold") {
    *hold = true;
  } else if (word != nullptr && word->get() == "off") {
    *value = 0;
  } else if (number != nullptr && (number->get() == 0 || number->get() == 1)) {
    *value = static_cast<std::uint8_t>(number->get());
  } else {
    reader->error(key, may_hold ? "must be \"hold\", \"off\", 0 or 1" : "must be \"off\", 0 or 1");
  }
  return true;
}

void read_input(TableReader* reader, PointLine* line) {
  refuse(reader, {"on_stop"}, "is for outputs; an input has on_loss");
  reader->integer("debounce_ms", &line->debounce_ms, 0, 1000);
  read_level(reader, "on_loss", true, &line->hold_on_loss, &line->loss_value);
}

void read_output(TableReader* reader, const hal::Point& point, PointLine* line) {
  refuse(reader, {"debounce_ms", "probe"}, "is for inputs");
  refuse(reader, {"on_loss"}, "is for inputs; an output that is lost is the chip's, and on_stop is for the end of the control");
  line->stop_value = point.initial != 0 ? 1 : 0;
  bool hold = false;
  read_level(reader, "on_stop", false, &hold, &line->stop_value);
}

// A place that is looked up in the track of the last scans must not be too old there when the debouncing is over. Some scans are left for the way to it.
unsigned longest_probe_debounce_ms(const Config& config) {
  constexpr unsigned kScansLeft = 56;
  return (hal::PlaceTrack::kPlaces - kScansLeft) * config.cycle_us / 1000;
}

// Reads `probe = { skip_signal = 1, edge = "rising", system = 1 }`; its line is set when the point has its place.
void read_probe(TableReader* reader, const Config& config, PointLine* line, Probe* probe) {
  reader->table("probe", [&](TableReader& table) {
    unsigned edge = 0, system = 1, signal = 1;
    table.require("skip_signal");
    table.integer("skip_signal", &signal, 1, 8);
    table.integer("system", &system, 1, config.nc.system_count);
    if (table.choice("edge", {"rising", "falling"}, &edge)) probe->falling = edge == 1;
    probe->signal = static_cast<std::uint8_t>(signal - 1);
    probe->system = static_cast<std::uint8_t>(system - 1);
    line->line.edges = true;
  });
  const unsigned most = longest_probe_debounce_ms(config);
  if (line->line.edges && line->debounce_ms > most)
    reader->error("debounce_ms", "of a probe is at most " + std::to_string(most) + ": the places of the axes are not kept for longer");
}

// A line of an encoder is its name or its offset on the chip.
bool read_encoder_line(TableReader* reader, const char* key, LineSetup* line) {
  const toml::node* node = reader->find(key);
  reader->require(key);
  if (node == nullptr) return false;
  return node->is_integer() ? reader->integer(key, &line->offset, 0, 65535) : read_kernel_name(reader, key, &line->name);
}

// Reads `encoder = { a = "GPIO20", b = "GPIO21", counts = 4, bits = 32 }`. False when it is not clear which lines are meant.
bool read_encoder(TableReader* gpio, TableReader* reader, Encoder* encoder) {
  refuse(gpio, {"line", "offset"}, "has no meaning beside encoder, which names its two lines");
  refuse(gpio, {"on_loss"}, "has no meaning for an encoder: its count stays, and is not good");
  refuse(gpio, {"on_stop"}, "is for outputs");
  refuse(gpio, {"probe"}, "is a line of its own, not one of an encoder");
  LineSetup common;
  read_settings(gpio, &common);
  gpio->integer("debounce_ms", &encoder->debounce_ms, 0, 1000);
  common.edges = true;
  encoder->a = encoder->b = common;
  const bool a = read_encoder_line(reader, "a", &encoder->a), b = read_encoder_line(reader, "b", &encoder->b);
  unsigned given = 0;
  if (reader->integer("counts", &given, 1, 4)) {
    if (given == 3) reader->error("counts", "must be 1, 2 or 4 in each period of the lines");
    else encoder->counts = given;
  }
  if (reader->integer("bits", &given, kNarrow, kWide)) {
    if (given != kNarrow && given != kWide) reader->error("bits", "must be 16 or 32");
    else encoder->bits = given;
  }
  if (!a || !b) return false;
  if (!same_line(encoder->a, encoder->b)) return true;
  reader->error("b", "is line a of the same encoder");
  return false;
}

// Each line has one user only. Whether a name and an offset mean the same line is found out only when the chip is opened.
void check_free(TableReader* reader, const Config& config, const BankConfig& bank, const LineSetup& line, const char* key) {
  for (const PointLine& taken : bank.lines)
    if (same_line(taken.line, line))
      return reader->error(key, "point \"" + config.points.at(taken.point).name + "\" has line " + line.text() + " of \"" + bank.name + "\" already");
  for (const Encoder& taken : bank.encoders)
    if (same_line(taken.a, line) || same_line(taken.b, line))
      return reader->error(key, "point \"" + config.points.at(taken.point).name + "\" has line " + line.text() + " of \"" + bank.name + "\" already");
  if (bank.has_watchdog && same_line(bank.watchdog, line)) reader->error(key, "line " + line.text() + " is the watchdog of \"" + bank.name + "\"");
}

}  // namespace

void read_gpio(TableReader* root, Config* config) {
  root->tables("gpio", [&](TableReader& reader, std::size_t) { read_bank(&reader, config); });
}

namespace {

// The bank that the table `gpio` of a point names, null = it names none.
GpioBankConfig* find_bank(TableReader* reader, Config* config) {
  reader->require("bank");
  std::string name;
  if (!reader->string("bank", &name)) return nullptr;
  const auto bank = std::find_if(config->gpio.begin(), config->gpio.end(), [&](const GpioBankConfig& entry) { return entry.bank.name == name; });
  if (bank == config->gpio.end()) {
    reader->error("bank", "no bank is named \"" + name + "\": see [[gpio]]");
    return nullptr;
  }
  bank->named = true;
  return &*bank;
}

PlaceOnBus read_line_point(TableReader* point_reader, TableReader* reader, const hal::Point& point, GpioBankConfig* bank, Config* config) {
  PlaceOnBus result;
  PointLine line;
  Probe probe;
  line.line.output = point.direction == hal::PointDirection::kOutput;
  const bool is_bit = point.type == hal::PointType::kBit;
  if (!is_bit) point_reader->error("gpio", "a line is a bit, but the point is a word");
  const bool placed = read_line(reader, &line.line);
  if (line.line.output) read_output(reader, point, &line);
  else read_input(reader, &line);
  if (!line.line.output) read_probe(reader, *config, &line, &probe);
  if (bank == nullptr || !placed || !is_bit) return result;
  check_free(reader, *config, bank->bank, line.line, key_of(line.line));
  result.bus = bank->bus;
  result.add = [line, probe, place = static_cast<std::size_t>(bank - config->gpio.data())](Config* owner) mutable {
    BankConfig& owned = owner->gpio[place].bank;
    line.point = owner->points.size() - 1;
    probe.line = static_cast<unsigned>(owned.lines.size());
    owned.lines.push_back(line);
    if (line.line.edges) owned.probes.push_back(probe);
  };
  return result;
}

PlaceOnBus read_encoder_point(TableReader* point_reader, TableReader* reader, const hal::Point& point, GpioBankConfig* bank, Config* config) {
  PlaceOnBus result;
  Encoder encoder;
  const bool is_count = point.type == hal::PointType::kWord && point.direction == hal::PointDirection::kInput;
  if (!is_count) point_reader->error("gpio", "an encoder is an input that is a word");
  reader->table("encoder", [&](TableReader& table) {
    if (!read_encoder(reader, &table, &encoder) || bank == nullptr || !is_count) return;
    check_free(&table, *config, bank->bank, encoder.a, "a");
    check_free(&table, *config, bank->bank, encoder.b, "b");
    result.bus = bank->bus;
    result.add = [encoder, place = static_cast<std::size_t>(bank - config->gpio.data())](Config* owner) mutable {
      encoder.point = owner->points.size() - 1;
      owner->gpio[place].bank.encoders.push_back(encoder);
    };
  });
  return result;
}

}  // namespace

PlaceOnBus read_point_gpio(TableReader* point_reader, const hal::Point& point, Config* config) {
  PlaceOnBus result;
  point_reader->table("gpio", [&](TableReader& reader) {
    GpioBankConfig* bank = find_bank(&reader, config);
    const auto read = reader.find("encoder") != nullptr ? read_encoder_point : read_line_point;
    result = read(point_reader, &reader, point, bank, config);
  });
  return result;
}

void check_gpio(TableReader* root, const Config& config) {
  for (const GpioBankConfig& entry : config.gpio)
    if (!entry.named) root->errors()->add(entry.place.line, entry.place.key, "no point uses the bank \"" + entry.bank.name + "\"");
}

}  // namespace nc::rt
