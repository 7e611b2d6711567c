// SPDX-License-Identifier: Apache-2.0
// Configuration sections [[point]], [macro_interface], [sim].
#include <algorithm>
#include <charconv>
#include <map>
#include <optional>

#include "runtime/config_equipment.hpp"
#include "runtime/config_sections.hpp"
#include "runtime/hal_factory.hpp"
#include "runtime/signals/signal_table.hpp"

namespace nc::rt {
namespace {

constexpr std::size_t kMaxPointName = 55, kMaxMeaning = 127;  // bytes that monitors can show

bool valid_point_name(std::string_view name) {
  if (name.empty() || name.size() > kMaxPointName) return false;
  return std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '.' || c == '-';
  });
}

// A name that the ladder would read as one of its own devices or constants: capital letters and a number, such as K5, M100, TN0.
bool is_device_name(std::string_view name) {
  std::size_t letters = 0;
  while (letters < name.size() && name[letters] >= 'A' && name[letters] <= 'Z') ++letters;
  return letters > 0 && letters <= 2 && letters < name.size() &&
         std::all_of(name.begin() + static_cast<std::ptrdiff_t>(letters), name.end(), [](char c) {
           return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'F') || c == '.' || c == '-';
         });
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// A group of bits in the ladder's notation, such as K4M0.
bool is_digit_group(std::string_view name) {
  return name.size() > 3 && name[0] == 'K' && name[1] >= '1' && name[1] <= '8' && is_device_name(name.substr(2));
}

// A bit of a word in the ladder's notation, such as w.3.
bool is_bit_name(std::string_view name) {
  if (name.size() < 3 || name[name.size() - 2] != '.') return false;
  const char last = name.back();
  return is_digit(last) || (last >= 'A' && last <= 'F');
}

// A name that looks like a signal: nc.x, nc2.x, plc.x, plc2.x. Every such name is reserved, so that a later version can add signals.
bool is_like_a_signal(std::string_view name) {
  for (const std::string_view family : {"nc", "plc"}) {
    if (name.substr(0, family.size()) != family) continue;
    std::size_t at = family.size();
    while (at < name.size() && is_digit(name[at])) ++at;
    if (at < name.size() && name[at] == '.') return true;
  }
  return false;
}

bool is_signal_name(std::string_view name, const nc_config& nc) {
  for (const Signal& signal : machine_signals(nc))
    if (signal.name == name) return true;
  return false;
}

// A variable number of the macro interface, decoded.
struct InterfaceNumber {
  bool output = false;
  bool word = false;
  unsigned bank = 0;  // word 0..3
  unsigned bit = 0;
};

constexpr unsigned kBits = 32;  // bits of a word

// The signal that a family has a name for among its inputs and outputs, nullptr = such a row is none.
const char* signal_of_role(unsigned role) {
  if (role == NC_VARIABLE_SPEED_CODE) return "nc.s_code";
  return role == NC_VARIABLE_SPINDLE_SPEED ? "nc.spindle_command.1" : nullptr;
}

template <class Use>
void each_row(nc_dialect dialect, const Use& use) {
  nc_system_variable row{};
  for (unsigned i = 0; nc_system_variable_row(dialect, i, &row) == NC_OK; ++i)
    if (row.role != NC_VARIABLE_OTHER) use(row);
}

// Calls `use` for every range of variable numbers that the dialect has in its macro interface.
template <class Use>
void each_interface_range(nc_dialect dialect, const Use& use) {
  each_row(dialect, [&](const nc_system_variable& row) {
    if (signal_of_role(row.role) == nullptr) use(row);
  });
}

// What a row is called: "@RUNG6" begins its name where the family has names in place of numbers.
std::string_view key_of(const nc_system_variable& row) {
  const std::string_view name = row.name;
  return name.substr(0, name.find(' '));
}

// The signal that a key such as "@SCODE" is the family's name of, nullptr = it is none.
const char* named_signal(nc_dialect dialect, std::string_view key) {
  const char* signal = nullptr;
  each_row(dialect, [&](const nc_system_variable& row) {
    if (key_of(row) == key && signal == nullptr) signal = signal_of_role(row.role);
  });
  return signal;
}

// Where the name of a row ends in "-00", each of its places has that name with its number: "@motion.digital-in-07". 0 = the key is none of them.
unsigned numbered(const nc_system_variable& row, std::string_view name, std::string_view key) {
  constexpr std::string_view kFirst = "-00";
  if (name.size() != key.size() || name.size() < kFirst.size() || name.substr(name.size() - kFirst.size()) != kFirst) return 0;
  if (name.substr(0, name.size() - 2) != key.substr(0, key.size() - 2)) return 0;
  unsigned place = 0;
  const auto result = std::from_chars(key.data() + key.size() - 2, key.data() + key.size(), place);
  return result.ptr == key.data() + key.size() && place <= row.last - row.first ? row.first + place : 0;
}

std::optional<InterfaceNumber> interface_number(nc_dialect dialect, std::string_view key) {
  unsigned n = 0;
  std::optional<InterfaceNumber> found;
  if (!key.empty() && key[0] == '@') {  // a family whose inputs and outputs have names
    each_interface_range(dialect, [&](const nc_system_variable& row) {
      const std::string_view name = key_of(row);
      if (name == key) n = row.first;
      n = std::max(n, numbered(row, name, key));
    });
    if (n == 0) return {};
  } else {
    if (key.empty() || key[0] != '#') return {};
    key.remove_prefix(1);
    const auto result = std::from_chars(key.data(), key.data() + key.size(), n);
    if (result.ec != std::errc{} || result.ptr != key.data() + key.size()) return {};
  }
  each_interface_range(dialect, [&](const nc_system_variable& row) {
    if (n < row.first || n > row.last) return;
    const bool output = row.role == NC_VARIABLE_OUTPUT_BIT || row.role == NC_VARIABLE_OUTPUT_WORD;
    const bool word = row.role == NC_VARIABLE_INPUT_WORD || row.role == NC_VARIABLE_OUTPUT_WORD;
    const unsigned offset = n - row.first;
    found = word ? InterfaceNumber{output, true, row.word + offset, 0} : InterfaceNumber{output, false, row.word + offset / kBits, offset % kBits};
  });
  return found;
}

// The error text for a number outside the macro interface. It lists the ranges that exist; ranges that adjoin are listed as one.
std::string no_interface_number(nc_dialect dialect) {
  std::string text, names;
  each_row(dialect, [&](const nc_system_variable& row) {
    const std::string_view name = key_of(row);
    if (!name.empty() && name[0] == '@') names.append(names.empty() ? "" : ", ").append(name);
  });
  if (!names.empty()) return "is no name of the macro interface (" + names + ")";
  std::uint32_t last = 0;
  each_interface_range(dialect, [&](const nc_system_variable& row) {
    if (last != 0 && row.first == last + 1) text.resize(text.rfind('-'));
    else text += (text.empty() ? "#" : ", #") + std::to_string(row.first);
    text += "-#" + std::to_string(row.last);
    last = row.last;
  });
  return text.empty() ? "is not possible: this dialect has no macro interface" : "is not a number of the macro interface (" + text + ")";
}

// The entry of a number in the map.
int* slot(MacroMap* map, const InterfaceNumber& number) {
  if (number.word) return &(number.output ? map->output_word : map->input_word)[number.bank];
  return &(number.output ? map->output_bit : map->input_bit)[number.bank][number.bit];
}

// What is mapped, and where that stands.
struct MappedNumber {
  InterfaceNumber number;
  int point = -1;
  ConfigPlace place;
};

// True where the number cannot be mapped beside this one, which is told with the lines of both. A word and its bits are one image: only one of them may be mapped, and a
// number has two spellings ("#1000" and "#01000"). check_point_uses() finds two outputs that are one point.
bool mapped_twice(const MappedNumber& one, const MappedNumber& other, const std::string& point, ErrorList* errors) {
  const InterfaceNumber &number = one.number, &before = other.number;
  std::string what;
  if (number.output != before.output) return false;
  if (one.point == other.point && !number.output) what = "point \"" + point + "\" is mapped twice";
  else if (number.bank != before.bank) return false;
  else if (number.word != before.word) what = "a word and a bit of the same word are both mapped";
  else if (number.bit == before.bit) what = "is mapped twice";
  else return false;
  errors->add_twice(one.place, other.place, what);
  return true;
}

void map_number(TableReader* reader, const std::string& key, Config* config, std::vector<MappedNumber>* mapped) {
  std::string name;
  if (!reader->string(key, &name)) return;
  const auto dialect = static_cast<nc_dialect>(config->nc.dialect);
  if (const char* signal = named_signal(dialect, key); signal != nullptr) return connect_signal(reader, key, signal, config);
  const auto number = interface_number(dialect, key);
  if (!number) {
    reader->error(key, no_interface_number(dialect));
    return;
  }
  const int index = config->points.find(name);
  if (index < 0) {
    reader->error(key, "no point is named \"" + name + "\"");
    return;
  }
  const hal::Point& point = config->points.at(static_cast<unsigned>(index));
  const bool point_is_output = point.direction == hal::PointDirection::kOutput;
  if (point_is_output != number->output) {
    reader->error(key, number->output
                           ? "is an output of the control, but point \"" + name + "\" is an input"
                           : "is an input of the control, but point \"" + name + "\" is an output");
    return;
  }
  if ((point.type == hal::PointType::kWord) != number->word) {
    reader->error(key, number->word ? "is a 32-bit word, but point \"" + name + "\" is a bit"
                                    : "is one bit, but point \"" + name + "\" is a word");
    return;
  }
  const MappedNumber one{*number, index, {reader->line(key), reader->path(key)}};
  for (const MappedNumber& other : *mapped)
    if (mapped_twice(one, other, name, reader->errors())) return;
  *slot(&config->macro, *number) = index;
  mapped->push_back(one);
  config->point_uses.push_back({number->output ? PointRole::kMacroOutput : PointRole::kFree, index, {reader->line(key), reader->path(key)}});
}

void read_solid(TableReader* reader, Config* config) {
  hal::SimSolid solid;
  unsigned system = 1;
  reader->integer("system", &system, 1, config->nc.system_count);
  solid.system = system - 1;
  reader->integer("signal", &solid.signal, 1, 8);
  const nc_system_config& axes = config->nc.system[solid.system];
  bool any = false;
  for (unsigned a = 0; a < axes.axis_count; ++a) {
    const std::string name(1, axes.axis[a].name);
    std::vector<double> range;
    if (!reader->numbers(name, &range, 2, 2)) continue;
    any = true;
    solid.min[a] = range[0];
    solid.max[a] = range[1];
    if (range[0] > range[1]) reader->error(name, "the first number must not be above the second");
  }
  if (!any) reader->errors()->add(reader->line(), reader->path(), "needs at least one axis with [min, max]");
  config->sim.solids.push_back(solid);
}

}  // namespace

void read_points(TableReader* root, Config* config) {
  std::map<std::string, ConfigPlace> named;  // without those of buses
  root->tables("point", [&](TableReader& reader, std::size_t) {
    hal::Point point;
    unsigned word = 0;
    for (const char* key : {"name", "direction"}) reader.require(key);
    const bool has_name = reader.string("name", &point.name);
    const ConfigPlace named_at{reader.line("name"), reader.path("name")};
    if (reader.choice("type", {"bit", "word"}, &word))
      point.type = word == 0 ? hal::PointType::kBit : hal::PointType::kWord;
    if (reader.choice("direction", {"input", "output"}, &word))
      point.direction = word == 0 ? hal::PointDirection::kInput : hal::PointDirection::kOutput;
    const bool bit = point.type == hal::PointType::kBit;
    reader.integer("initial", &point.initial, bit ? 0 : -0x80000000ll, bit ? 1 : 0xFFFFFFFFll);
    if (reader.string("meaning", &point.meaning, TableReader::Empty::kTaken) && point.meaning.size() > kMaxMeaning)
      reader.error("meaning", "is longer than " + std::to_string(kMaxMeaning) + " bytes");
    const PlaceOnBus place = read_place_on_bus(&reader, point_bus_kinds(), point, config);
    point.bus = place.bus;
    if (!has_name) return;
    if (!valid_point_name(point.name))
      reader.error("name", "must be 1 to 55 letters, digits, '_', '-' or '.'");
    else if (is_device_name(point.name) || is_digit_group(point.name))
      reader.error("name", "\"" + point.name + "\" is a device or a constant of the ladder; tie addresses to points by ALIAS");
    else if (is_signal_name(point.name, config->nc))
      reader.error("name", "\"" + point.name + "\" is a signal between NC and ladder");
    else if (is_like_a_signal(point.name))
      reader.error("name", "names that begin with nc. and plc. belong to the signals between NC and ladder");
    else if (is_bit_name(point.name))
      reader.error("name", "\"" + point.name + "\" would be bit " + point.name.back() + " of a word in the ladder");
    else if (const auto other = named.find(point.name); other != named.end())
      reader.errors()->add_twice(named_at, other->second, "point \"" + point.name + "\" is already there");
    else if (config->points.find(point.name) >= 0)
      reader.error("name", "point \"" + point.name + "\" is already there");
    else if (!config->points.add(point))
      reader.error("name", "there are more than " + std::to_string(hal::kMaxPoints) + " points");
    else {
      named.emplace(point.name, named_at);
      if (place.bus != 0) place.add(config);
    }
  });
}

void read_macro_interface(TableReader* root, Config* config) {
  root->table("macro_interface", [&](TableReader& reader) {
    std::vector<MappedNumber> mapped;
    reader.each([&](const std::string& key, const toml::node&) { map_number(&reader, key, config, &mapped); });
  });
}

void read_sim(TableReader* root, Config* config) {
  root->table("sim", [&](TableReader& reader) {
    hal::SimConfig& sim = config->sim;
    reader.number("spindle_ramp_rpm_per_s", &sim.spindle_ramp_rpm_per_s, 1, 1e9);
    reader.number("spindle_max_rpm", &sim.spindle_max_rpm, quantity::kSpindleSpeed);
    reader.number("tool_change_s", &sim.tool_change_s, quantity::kActionTime);
    reader.number("tool_select_s", &sim.tool_select_s, quantity::kActionTime);
    reader.number("m_time_s", &sim.m_time_s, quantity::kActionTime);
    read_sim_plant(&reader, config);
    read_sim_axes(&reader, config);
    reader.tables("solid", [&](TableReader& solid, std::size_t) { read_solid(&solid, config); });
    std::vector<std::pair<std::string, unsigned>> statements;
    reader.strings("script", &statements);
    for (const auto& [text, line] : statements) {
      hal::InputChange change;
      std::string error;
      if (hal::parse_input_change(text, config->points, &change, &error))
        sim.script.push_back(change);
      else
        reader.errors()->add(line, reader.path("script"), std::string("\"").append(text).append("\": ").append(error));
    }
  });
}

}  // namespace nc::rt
