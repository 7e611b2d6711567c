// SPDX-License-Identifier: Apache-2.0
// Configuration sections [[gpio]] and the `gpio` table of a [[point]]. docs/gpio.md.
#include <algorithm>
#include <cstdint>

#include "hal/gpio/bank_config.hpp"
#include "runtime/bus_gpio.hpp"
#include "runtime/config_sections.hpp"

namespace nc::rt {
namespace {

using hal::gpio::BankConfig;
using hal::gpio::Bias;
using hal::gpio::Drive;
using hal::gpio::LineSetup;
using hal::gpio::PointLine;

constexpr std::size_t kMaxKernelName = 31;  // longest label of a chip, name of a line or consumer in the kernel, in bytes

bool valid_bank_name(const std::string& name) {
  return !name.empty() && name.size() <= 32 && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

// Reads a name that is no longer than the kernel allows. The path of a chip may be longer.
bool read_kernel_name(TableReader* reader, const char* key, std::string* name) {
  std::string read;
  if (!reader->string(key, &read)) return false;
  const std::size_t most = key == std::string_view("chip") && read.starts_with('/') ? 255 : kMaxKernelName;
  if (read.empty() || read.size() > most) {
    reader->error(key, "must have 1 to " + std::to_string(most) + " bytes");
    return false;
  }
  *name = read;
  return true;
}

// Reads `line = "NAME"` or `offset = 17`, and the keys that points and the watchdog have in common. False when it is not clear which line is meant.
bool read_line(TableReader* reader, LineSetup* line) {
  unsigned word = 0;
  reader->boolean("active_low", &line->active_low);
  if (reader->choice("bias", {"as-is", "none", "pull-up", "pull-down"}, &word)) line->bias = static_cast<Bias>(word);
  if (reader->choice("drive", {"push-pull", "open-drain", "open-source"}, &word)) line->drive = static_cast<Drive>(word);
  if (!line->output && reader->find("drive") != nullptr) reader->error("drive", "is for outputs");
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
    if (other.name == bank.name) return reader->error("name", "a bus \"" + bank.name + "\" is already there");
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
  refuse(reader, {"debounce_ms"}, "is for inputs");
  refuse(reader, {"on_loss"}, "is for inputs; an output that is lost is the chip's, and on_stop is for the end of the control");
  line->stop_value = point.initial != 0 ? 1 : 0;
  bool hold = false;
  read_level(reader, "on_stop", false, &hold, &line->stop_value);
}

// Each line has one user only. Whether a name and an offset mean the same line is found out only when the chip is opened.
void check_free(TableReader* reader, const Config& config, const BankConfig& bank, const LineSetup& line) {
  for (const PointLine& taken : bank.lines)
    if (same_line(taken.line, line))
      return reader->error(key_of(line), "point \"" + config.points.at(taken.point).name + "\" has line " + line.text() + " of \"" + bank.name + "\" already");
  if (bank.has_watchdog && same_line(bank.watchdog, line)) reader->error(key_of(line), "line " + line.text() + " is the watchdog of \"" + bank.name + "\"");
}

}  // namespace

void read_gpio(TableReader* root, Config* config) {
  root->tables("gpio", [&](TableReader& reader, std::size_t) { read_bank(&reader, config); });
}

PlaceOnBus read_point_gpio(TableReader* point_reader, const hal::Point& point, Config* config) {
  PlaceOnBus result;
  point_reader->table("gpio", [&](TableReader& reader) {
    PointLine line;
    line.line.output = point.direction == hal::PointDirection::kOutput;
    reader.require("bank");
    std::string name;
    const bool given = reader.string("bank", &name);
    const auto bank = std::find_if(config->gpio.begin(), config->gpio.end(), [&](const GpioBankConfig& entry) { return entry.bank.name == name; });
    const bool found = given && bank != config->gpio.end();
    if (given && !found) reader.error("bank", "no bank is named \"" + name + "\": see [[gpio]]");
    if (found) bank->named = true;
    const bool is_bit = point.type == hal::PointType::kBit;
    if (!is_bit) point_reader->error("gpio", "a line is a bit, but the point is a word");
    const bool placed = read_line(&reader, &line.line);
    if (line.line.output) read_output(&reader, point, &line);
    else read_input(&reader, &line);
    if (!found || !placed || !is_bit) return;
    check_free(&reader, *config, bank->bank, line.line);
    result.bus = bank->bus;
    result.add = [line, place = static_cast<std::size_t>(bank - config->gpio.begin())](Config* owner) mutable {
      line.point = owner->points.size() - 1;
      owner->gpio[place].bank.lines.push_back(line);
    };
  });
  return result;
}

void check_gpio(TableReader* root, const Config& config) {
  for (const GpioBankConfig& entry : config.gpio)
    if (!entry.named) root->errors()->add(entry.place.line, entry.place.key, "no point uses the bank \"" + entry.bank.name + "\"");
}

}  // namespace nc::rt
