// SPDX-License-Identifier: Apache-2.0
// A configuration with a wrong value, whatever the key and whatever is wrong: the error names file, line and key, and no value of another type is taken
// without a word. Every key that the control knows is in one of the configurations here, which a test holds.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sstream>

#include "places/places.hpp"
#include "runtime/config.hpp"
#include "runtime/hal_factory.hpp"
#include "runtime/runtime.hpp"
#include "runtime/toml_reader.hpp"

namespace {

using nc::rt::Config;
using nc::rt::ConfigError;

constexpr const char* kMachines[] = {"machine", "can_mill", "drill-mill", "homed_mill", "knee-mill", "modbus-example", "modelling-machine", "pulse_mill", "router", "table_mill"};

// Keys that none of the machines in etc/ has.
constexpr const char* kRest[] = {R"(
[machine]
name = "rest"
print = "print.txt"
variables = "rest.variables"
offsets = "rest.offsets"
external = "."
program_encoding = "latin-1"
program_copy_mb = 3
look_ahead = 1024
contour_blocks = 4000
variable_ranges = [{ first = 400, last = 499, kept = false }]
tool_axis = ["turned", "mechanical_a"]
spindles = [2, 1]
macro_extensions = true
negative_count = true
[motion]
mode = "trapezoid"
tolerance = 0.02
retract_overlap = 1.5
tap_most_apart = 0.3
[power]
stop_s = 2.0
delay_s = 0.5
settle_s = 0.5
place = "rest.place"
[tool_offsets]
1 = { length = 1.0, length_wear = 0.5, radius = 2.0, radius_wear = 0.25, name = "Mill 4", pocket = 3 }
[parameters]
"1003" = "B"
"8206" = { X = 5.5 }
"UNIT*10" = 1
[signals]
"plc.power_fail_n" = "supply"
"plc.home" = "button"
[[axis]]
name = "X"
max_velocity = 100.0
max_acceleration = 1000.0
max_jerk = 20000.0
rapid = 90.0
soft_limits = [-400.0, 1.0]
homing = { kind = "switch", direction = "+", fast = 20.0, creep = 1.0, dog = "dog", dog_contact = "open", edge = "enter", index = "mark", index_travel = 6.0, offset = 0.5, travel = 500.0, order = 1, timeout_s = 50.0, jog = 10.0, required = true }
limit_switches = { contact = "closed", minus = "minus", plus = "plus" }
screw = { error = [0.0, 0.01, 0.02], error_minus = [0.01, 0.02, 0.03], from = 0.0, step = 10.0, acceleration = 100.0 }
brake = { point = "brake", open_s = 0.1, close_s = 0.1 }
[[axis]]
name = "Y"
max_velocity = 100.0
max_acceleration = 1000.0
homing = { kind = "drive", request = "home_y", done = "y_homed" }
screw = { backlash = 0.01 }
[[axis]]
name = "C"
rotary = true
spindle = 2
max_velocity = 100.0
max_acceleration = 1000.0
[[axis]]
name = "X"
system = 2
max_velocity = 100.0
max_acceleration = 1000.0
[[gpio]]
name = "head"
chip = "chip0"
consumer = "rest"
poll_ms = 2
lost_after = 3
alarm = true
watchdog = { line = "DOG", active_low = true, bias = "none", drive = "open-drain" }
[[gpio]]
name = "tail"
chip = "chip1"
watchdog = { offset = 4 }
[[modbus]]
name = "serial"
device = "/dev/nc-line"
baud = 19200
parity = "even"
stop_bits = 1
rs485 = "rts_high"
rts_delay_us = 100
unit = 3
alarm = true
[[point]]
name = "dog"
direction = "input"
gpio = { bank = "head", line = "L1", debounce_ms = 3, bias = "pull-up", active_low = true, on_loss = "hold" }
[[point]]
name = "mark"
direction = "input"
gpio = { bank = "head", offset = 7, on_loss = 1, probe = { skip_signal = 2, edge = "falling", system = 1 } }
[[point]]
name = "minus"
direction = "input"
[[point]]
name = "plus"
direction = "input"
[[point]]
name = "brake"
direction = "output"
gpio = { bank = "head", line = "L2", drive = "push-pull", on_stop = 0 }
[[point]]
name = "wheel"
type = "word"
direction = "input"
gpio = { bank = "head", encoder = { a = "A", b = 9, counts = 4, bits = 16 }, debounce_ms = 0 }
[[point]]
name = "home_y"
direction = "output"
modbus = { link = "serial", table = "coil", address = 5, unit = 4, on_stop = "off" }
[[point]]
name = "y_homed"
direction = "input"
[[point]]
name = "supply"
direction = "input"
initial = 1
[[point]]
name = "button"
direction = "input"
[[point]]
name = "set_speed"
type = "word"
direction = "output"
modbus = { link = "serial", table = "holding", address = 5, signed = true, scale = 2.0, offset = 1.0, words = "CDAB", on_stop = "hold" }
[[point]]
name = "bit_of_word"
direction = "input"
modbus = { link = "serial", table = "input", address = 6, bit = 2, on_loss = "off" }
[[point]]
name = "speed"
type = "word"
direction = "input"
modbus = { link = "serial", table = "input", address = 8, float = true }
[[spindle]]
system = 2
number = 1
feedback = "speed"
rpm_per_count = 0.5
signed = true
[[handwheel]]
counter = "wheel"
counts = 4
bits = 16
times_10 = "button"
times_100 = "y_homed"
axes = { X = "minus", Y = "plus" }
[[point]]
name = "stick"
type = "word"
direction = "input"
[[joystick]]
axis = "X"
input = "stick"
dead_man = "button"
chosen_by = "y_homed"
low = 0
middle = 500
high = 1000
dead_band = 0.1
top_speed = 50.0
[[sim.axis]]
name = "X"
minus = -401.0
plus = 2.0
stands_at = -10.0
weight = 3.0
[[sim.solid]]
system = 2
signal = 3
X = [0.0, 1.0]
)",
                                 R"(
[machine]
name = "drives"
hal = "canopen"
spindles = [2]
[[axis]]
name = "X"
max_velocity = 100.0
max_acceleration = 1000.0
[[can_io]]
name = "module"
node = 20
every = 2
vendor = 5
product = 6
alarm = true
objects = [{ index = 0x2000, sub = 1, bytes = 2, value = 7 }]
[[point]]
name = "in"
direction = "input"
can_io = { module = "module", digital = 1, active_low = true, on_loss = 1 }
[[point]]
name = "word_in"
type = "word"
direction = "input"
can_io = { module = "module", analog = 1, on_loss = -5 }
[[point]]
name = "out"
direction = "output"
can_io = { module = "module", digital = 1, on_stop = 1 }
[[point]]
name = "cw"
direction = "output"
[[point]]
name = "ccw"
direction = "output"
[[point]]
name = "gear"
type = "word"
direction = "output"
[canopen]
interface = "can0"
sync_us = 5000
[[canopen.drive]]
node = 1
vendor = 1
product = 2
[[canopen.drive.axis]]
name = "X"
slot = 1
rpdo = 65
tpdo = 66
encoder = 4096
pitch = 5.0
mode = "velocity"
velocity_gain = 15.0
velocity_scale = 60.0
velocity_delay = 3.0
following_error_limit = 1.0
probe = { skip_signal = 1, edge = "rising" }
[[canopen.drive]]
node = 2
[[canopen.drive.spindle]]
system = 1
number = 2
slot = 0
rpdo = 1
tpdo = 1
encoder = 4096
velocity_scale = 1.0
reverse = true
max_rpm = 3000.0
acceleration = 3000.0
gain = 15.0
mode = "profile"
tap_axis_lag_ms = 2.0
gears = [[2, 1], [1, 1]]
gear_select = "gear"
forward = "cw"
backward = "ccw"
)"};

// Keys that take values of several types: a name or a number, a level or a word, a wish or nothing.
bool takes_several(const std::string& path) {
  for (const char* const key : {".on_loss", ".on_stop", ".encoder.a", ".encoder.b"})
    if (path.size() > std::string(key).size() && path.ends_with(key)) return true;
  return path.starts_with("parameters.") || path.starts_with("tool_offsets.");
}

// Numbers that a program may have computed, and that are exported and imported: as near to 0 as they come out.
bool may_be_computed(const std::string& path) {
  for (const char* const table : {"parameters.", "work_offsets.", "tool_offsets."})
    if (path.starts_with(table)) return true;
  return false;
}

// Keys at which "" says that there is no such thing, or that it is chosen by others.
bool takes_none(const std::string& path) {
  for (const char* const key : {"machine.programs", "machine.external", "machine.print", "machine.variables", "machine.offsets", "ladder.program", "ladder.retain", "power.place", "point.meaning",
                                "services.socket", "tool_offsets.1.name", "ladder.alarms", "services.changes", "services.history", "share.name"})
    if (path == key) return true;
  return false;
}

// Keys that are data: the tables that have them ask for all that there are.
bool is_data(const std::string& table) {
  for (const char* const name : {"parameters", "work_offsets", "tool_offsets", "macro_interface", "signals", "axes"})
    if (table == name || table.starts_with(std::string(name) + ".") || table.ends_with(std::string(".") + name)) return true;
  return false;
}

std::string read_file(const std::string& name) {
  std::ifstream stream(name, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

struct Machine {
  std::string file, text;
};

// The machines in etc/, each with the keys that stand there as remarks where the control takes them together with the others; and the rest.
std::vector<Machine> machines() {
  std::vector<Machine> all;
  for (const char* const name : kMachines) {
    Machine machine{nc::test::kSourceDir + "/etc/" + name + ".toml", ""};
    machine.text = read_file(machine.file);
    EXPECT_FALSE(machine.text.empty()) << machine.file;
    all.push_back(std::move(machine));
  }
  for (const char* const text : kRest) all.push_back({nc::test::kSourceDir + "/etc/rest.toml", text});
  return all;
}

// All errors, those that only the control finds included.
std::vector<ConfigError> errors_of(const Machine& machine, const std::string& text) {
  Config config;
  std::vector<ConfigError> errors = nc::rt::parse_config(text, machine.file, &config);
  if (!errors.empty()) return errors;
  config.nc.look_ahead = 64;  // little to be made for each of thousands of controls
  const std::unique_ptr<nc::hal::Hal> axes = nc::rt::make_axes(config);
  nc::rt::VirtualClock clock;
  (void)nc::rt::Runtime::create(config, {&clock, axes.get(), nullptr, nullptr}, &errors);
  return errors;
}

std::string text_of(const toml::table& root) {
  std::ostringstream text;
  text << toml::toml_formatter(root, toml::toml_formatter::default_flags & ~toml::format_flags::allow_literal_strings);
  return text.str();
}

// A node of the tree by the keys and indices that lead to it.
struct Step {
  std::string key;
  std::size_t index = 0;  // where the key is empty
};
using Way = std::vector<Step>;

std::string path_text(const Way& way, bool numbered) {
  std::string path;
  for (const Step& step : way) {
    if (step.key.empty()) path += numbered ? "[" + std::to_string(step.index + 1) + "]" : "";
    else path += (path.empty() ? "" : ".") + step.key;
  }
  return path;
}

void collect(const toml::node& node, Way* way, std::vector<Way>* ways) {
  if (!way->empty()) ways->push_back(*way);
  if (const toml::table* const table = node.as_table()) {
    for (const auto& [key, value] : *table) {
      way->push_back({std::string(key.str()), 0});
      collect(value, way, ways);
      way->pop_back();
    }
  } else if (const toml::array* const array = node.as_array()) {
    for (std::size_t i = 0; i < array->size(); ++i) {
      way->push_back({"", i});
      collect((*array)[i], way, ways);
      way->pop_back();
    }
  }
}

toml::node* node_at(toml::table* root, const Way& way, std::size_t steps) {
  toml::node* node = root;
  for (std::size_t i = 0; i < steps; ++i) node = way[i].key.empty() ? node->as_array()->get(way[i].index) : node->as_table()->get(way[i].key);
  return node;
}

template <class Value>
void put(toml::table* root, const Way& way, const Value& value) {
  toml::node* const owner = node_at(root, way, way.size() - 1);
  if (toml::table* const table = owner->as_table()) table->insert_or_assign(way.back().key, value);
  else owner->as_array()->replace(owner->as_array()->cbegin() + static_cast<std::ptrdiff_t>(way.back().index), value);
}

struct Wrong {
  const char* name;
  std::function<void(toml::table*, const Way&)> put_there;
  toml::node_type type;
  bool never = false;  // no key takes it
};

template <class Value>
Wrong wrong(const char* name, Value value, toml::node_type type, bool never = false) {
  return {name, [value](toml::table* root, const Way& way) { put(root, way, value); }, type, never};
}

std::vector<Wrong> wrongs() {
  using Type = toml::node_type;
  return {wrong("word", std::string("word"), Type::string),
          wrong("letter", std::string("Q"), Type::string),
          wrong("empty", std::string(), Type::string),
          wrong("true", true, Type::boolean),
          wrong("number", std::int64_t{7}, Type::integer),
          wrong("negative", std::int64_t{-3}, Type::integer),
          wrong("least", INT64_MIN, Type::integer),
          wrong("fraction", 0.37, Type::floating_point),
          wrong("huge", 1e300, Type::floating_point, true),
          wrong("tiny", 1e-320, Type::floating_point, true),
          wrong("tiny and negative", -1e-12, Type::floating_point, true),
          wrong("nan", std::numeric_limits<double>::quiet_NaN(), Type::floating_point, true),
          wrong("-inf", -std::numeric_limits<double>::infinity(), Type::floating_point, true),
          wrong("date", toml::date{2026, 11, 29}, Type::date, true),
          wrong("array", toml::array{}, Type::array),
          wrong("array of words", toml::array{"a", "b"}, Type::array),
          wrong("table", toml::table{}, Type::table),
          wrong("table of a word", toml::table{{"zz", "b"}}, Type::table)};
}

bool is_number(toml::node_type type) { return type == toml::node_type::integer || type == toml::node_type::floating_point; }

void expect_places(const Machine& machine, const std::vector<ConfigError>& errors, const std::string& text, const std::string& what) {
  const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
  for (const ConfigError& error : errors) {
    if (error.file != machine.file) continue;  // of the ladder program, with its own lines
    EXPECT_GE(error.line, 1u) << what << "\n  " << error.text();
    EXPECT_LE(error.line, lines) << what << "\n  " << error.text();
    EXPECT_FALSE(error.key.empty()) << what << "\n  " << error.text();
  }
}

// Every eighth value of each machine, so that the packs of the test are short; eight tests take them all.
class ConfigValues : public testing::TestWithParam<unsigned> {};

TEST_P(ConfigValues, WrongOnesAreErrorsWithTheirPlace) {
  unsigned turn = 0, seen = 0;
  for (const Machine& machine : machines()) {
    const toml::table root = toml::parse(machine.text);
    std::vector<Way> ways;
    Way way;
    collect(root, &way, &ways);
    for (const Way& each : ways) {
      for (const Wrong& value : wrongs()) {
        if (turn++ % 8 != GetParam()) continue;
        toml::table changed = root;
        const toml::node_type before = node_at(&changed, each, each.size())->type();
        value.put_there(&changed, each);
        const std::string text = text_of(changed), what = machine.file + ": " + path_text(each, true) + " = " + value.name;
        const std::vector<ConfigError> errors = errors_of(machine, text);
        expect_places(machine, errors, text, what);
        const bool same = value.type == before || (is_number(value.type) && is_number(before));
        const bool in_array = each.back().key.empty();
        const bool wrong_type = !same && !in_array && !takes_several(path_text(each, false));
        const bool computed = std::string_view(value.name).starts_with("tiny") && may_be_computed(path_text(each, false));
        EXPECT_FALSE(errors.empty() && ((value.never && !computed) || wrong_type)) << what << " is taken";
        const bool no_name = std::string_view(value.name) == "empty" && !takes_none(path_text(each, false));
        EXPECT_FALSE(errors.empty() && no_name) << what << " is taken";
        ++seen;
      }
    }
  }
  EXPECT_GT(seen, 1000u);
}

INSTANTIATE_TEST_SUITE_P(All, ConfigValues, testing::Range(0u, 8u));

// As they stand, the configurations of this test are right, and one of them has each key that the control knows.
TEST(ConfigValuesCover, EveryKeyThatTheControlKnows) {
  std::map<std::string, std::set<std::string>> known, present;
  for (const Machine& machine : machines()) {
    for (const ConfigError& error : errors_of(machine, machine.text)) ADD_FAILURE() << error.text();
    const toml::table root = toml::parse(machine.text);
    std::vector<Way> ways{{}};
    Way way;
    collect(root, &way, &ways);
    for (const Way& each : ways) {
      toml::table changed = root;
      toml::node* const node = node_at(&changed, each, each.size());
      if (!each.empty() && !each.back().key.empty()) present[path_text({each.begin(), each.end() - 1}, false)].insert(each.back().key);
      toml::table* const table = node->as_table();
      const std::string path = path_text(each, false);
      if (table == nullptr || is_data(path)) continue;
      table->insert("zz", 1);
      for (const ConfigError& error : errors_of(machine, text_of(changed))) {
        constexpr std::string_view kHead = "unknown key (known here: ";
        if (!error.message.starts_with(kHead)) continue;
        std::istringstream list(error.message.substr(kHead.size(), error.message.size() - kHead.size() - 1));
        for (std::string key; list >> key;) known[path].insert(key.back() == ',' ? key.substr(0, key.size() - 1) : key);
      }
    }
  }
  // They name a file that would have to be there, or stand beside a ladder program that drives several spindles.
  const std::set<std::string> left_out = {"can_io.eds", "canopen.drive.eds", "ladder.retain_d", "sim.spindle2", "sim.spindle3", "sim.spindle4"};
  unsigned count = 0;
  for (const auto& [path, keys] : known)
    for (const std::string& key : keys) {
      if (left_out.contains(path + "." + key)) continue;
      ++count;
      EXPECT_TRUE(present[path].contains(key)) << "no configuration of this test has the key " << path << (path.empty() ? "" : ".") << key;
    }
  EXPECT_GT(count, 200u);
}

}  // namespace
