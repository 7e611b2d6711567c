// SPDX-License-Identifier: Apache-2.0
// The configuration: what is read from it, and that every error names file, line and key.
#include "runtime/config.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "places/places.hpp"
#include "runtime/motion_choice.hpp"
#include "test_config.hpp"

namespace {

using nc::rt::Config;
using nc::rt::ConfigError;

// The base configuration with one line changed or added, and the error that must be reported.
struct Case {
  const char* name;
  const char* from;  // text of the base that is replaced; nullptr = `to` is appended
  const char* to;
  const char* key;
  const char* message;  // a part of it
};

// So that gtest prints the name instead of the bytes of the pointers.
std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

unsigned line_of(const std::string& text, std::size_t offset) {
  return 1 + static_cast<unsigned>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(offset), '\n'));
}

// The first line at which an error about the text at `place` may be reported: that of the text itself; for a missing key
// that of the head of its table; for a mistake of all axes together that of the first axis.
unsigned first_line(const std::string& text, std::size_t place, const Case& c) {
  if (std::string(c.key) == "axis") return line_of(text, text.find("[[axis]]"));
  if (std::string(c.message) == "is missing") place = text.rfind("\n[", place) + 1;
  return line_of(text, place);
}

#define NC_LONG_30 "123456789012345678901234567890"
#define NC_LONG NC_LONG_30 NC_LONG_30 NC_LONG_30 NC_LONG_30 NC_LONG_30

class ConfigErrors : public testing::TestWithParam<Case> {};

TEST_P(ConfigErrors, NameFileLineAndKey) {
  const Case& c = GetParam();
  std::string text = nc::test::base_toml();
  std::size_t place = text.size();
  if (c.from == nullptr) {
    text += c.to;
  } else {
    place = text.find(c.from);
    ASSERT_NE(place, std::string::npos);
    text.replace(place, std::string(c.from).size(), c.to);
  }
  Config config;
  const std::vector<ConfigError> errors = nc::rt::parse_config(text, "m.toml", &config);
  ASSERT_FALSE(errors.empty());
  bool found = false;
  std::string all;
  for (const ConfigError& error : errors) {
    all += error.text() + "\n";
    EXPECT_EQ(error.file, "m.toml");
    EXPECT_GE(error.line, 1u) << error.text();
    found |= error.key == c.key && error.message.find(c.message) != std::string::npos &&
             error.line >= first_line(text, place, c) &&
             error.line <= line_of(text, std::min(text.size(), place + std::string(c.to).size()));
  }
  EXPECT_TRUE(found) << "wanted " << c.key << ": " << c.message << "\n" << all;
}

// A link, and a point "p" on it.
#define NC_LINK "\n[[modbus]]\nname = \"io\"\nhost = \"10.0.0.1\"\n"
#define NC_LINE "\n[[modbus]]\nname = \"io\"\ndevice = \"/dev/nc-line\"\n"
#define NC_POINT(name, type, direction, modbus)                                                        \
  "[[point]]\nname = \"" name "\"\ntype = \"" type "\"\ndirection = \"" direction "\"\nmodbus = { " modbus \
  " }\n"
#define NC_BIT(direction, modbus) NC_LINK NC_POINT("p", "bit", direction, modbus)
#define NC_WORD(direction, modbus) NC_LINK NC_POINT("p", "word", direction, modbus)

// A point that is refused occupies no address on its link: another point with the same address collides with nothing.
TEST(ModbusConfig, PointsThatAreRefusedTakeNoAddress) {
  const std::string same = "link = \"io\", table = \"coil\", address = 7";
  const auto point = [&](const std::string& name) {
    return "[[point]]\nname = \"" + name + "\"\ntype = \"bit\"\ndirection = \"output\"\nmodbus = { " + same + " }\n";
  };
  for (const char* refused : {"cool ant", "M100", "nc.x", "in1"}) {
    Config config, partial;
    const auto errors =
        nc::rt::parse_config(nc::test::base_toml() + NC_LINK + point(refused) + point("coolant"), "m.toml", &config, &partial);
    ASSERT_EQ(errors.size(), 1u) << refused;
    EXPECT_EQ(errors[0].key, "point[6].name");
    ASSERT_EQ(partial.modbus.size(), 1u);
    ASSERT_EQ(partial.modbus[0].link.points.size(), 1u);
    EXPECT_EQ(partial.points.at(partial.modbus[0].link.points[0].point).name, "coolant");
  }
}

const Case kCases[] = {
    {"unknown_top", nullptr, "\n[spindel]\nx = 1\n", "spindel", "unknown key"},
    {"unknown_key", "name = \"test\"", "nmae = \"test\"", "machine.nmae", "unknown key"},
    {"wrong_type_string", "name = \"test\"", "name = 5", "machine.name", "must be a string, not an integer"},
    {"wrong_type_number", "max_velocity = 200.0", "max_velocity = \"fast\"", "axis[1].max_velocity",
     "finite number"},
    {"infinite", "max_velocity = 200.0", "max_velocity = inf", "axis[1].max_velocity",
     "finite number, not inf"},
    {"not_a_number", "max_velocity = 200.0", "max_velocity = nan", "axis[1].max_velocity",
     "finite number, not nan"},
    {"not_a_number_in_a_list", "soft_limits = [-500.0, 500.0]", "soft_limits = [-500.0, -inf]",
     "axis[1].soft_limits", "finite numbers, not -inf"},
    {"too_large", "max_velocity = 200.0", "max_velocity = 1e300", "axis[1].max_velocity", "must be from"},
    {"out_of_range", "max_velocity = 150.0", "max_velocity = -1", "axis[2].max_velocity", "must be from"},
    {"cycle", "name = \"test\"", "cycle_us = 3", "machine.cycle_us", "must be from 100"},
    {"cycle_float", "name = \"test\"", "cycle_us = 1000.5", "machine.cycle_us", "an integer"},
    {"look_ahead", "name = \"test\"", "look_ahead = 1000", "machine.look_ahead", "power of two"},
    {"variable_sets", "name = \"test\"", "variable_sets = 250", "machine.variable_sets",
     "100, 200, 300 or 600"},
    {"range_taken", "name = \"test\"", "variable_ranges = [{first = 400, last = 500}]", "machine.variable_ranges[1].first",
     "#500 is another variable already"},
    {"range_order", "name = \"test\"", "variable_ranges = [{first = 450, last = 400}]", "machine.variable_ranges[1].last", "from first on"},
    {"range_twice", "name = \"test\"", "variable_ranges = [{first = 400, last = 450}, {first = 440, last = 460}]",
     "machine.variable_ranges[2].first", "#440 is another"},
    {"range_key", "name = \"test\"", "variable_ranges = [{first = 400, last = 450, keep = true}]", "machine.variable_ranges[1].keep", "unknown key"},
    {"range_half", "name = \"test\"", "variable_ranges = [{first = 400}]", "machine.variable_ranges[1].last", "is missing"},
    {"extended", "name = \"test\"", "extended_variables = 1", "machine.extended_variables", "true or false"},
    {"extensions", "name = \"test\"", "macro_extensions = \"on\"", "machine.macro_extensions", "true or false"},
    {"dialect", "name = \"test\"", "dialect = \"series9\"", "machine.dialect", "\"m700\", \"dgshape\", \"iso\", \"hx\" or \"series8\""},
    {"hal", "name = \"test\"", "hal = \"ethercat\"", "machine.hal", "must be \"sim\""},
    {"duplicate_axis", "name = \"Y\"", "name = \"X\"", "axis[2].name", "already there"},
    {"axis_name", "name = \"Y\"", "name = \"Q\"", "axis[2].name", "one letter of"},
    {"axis_missing_limit", "max_velocity = 150.0", "", "axis[2].max_velocity", "is missing"},
    {"axis_as_table", nullptr, "\n[scheduling]\n[axes]\n", "axes", "unknown key"},
    {"rapid", "max_velocity = 200.0", "max_velocity = 200.0\nrapid = 300.0", "axis[1].rapid",
     "above max_velocity"},
    {"soft_order", "soft_limits = [-300.0, 300.0]", "soft_limits = [3, -3]", "axis[3].soft_limits",
     "below the second"},
    {"soft_count", "soft_limits = [-300.0, 300.0]", "soft_limits = [3]", "axis[3].soft_limits",
     "must have 2 numbers"},
    {"soft_type", "soft_limits = [-300.0, 300.0]", "soft_limits = [3, true]", "axis[3].soft_limits",
     "not a boolean"},
    {"start", "soft_limits = [-300.0, 300.0]", "soft_limits = [-3.0, 3.0]\nstart = 4", "axis[3].start",
     "inside"},
    {"start_not_given", "soft_limits = [-300.0, 300.0]", "soft_limits = [10.0, 50.0]\nreference = [20.0]", "axis[3].soft_limits", "start (0 where it is not given)"},
    {"reference_not_given", "soft_limits = [-300.0, 300.0]", "soft_limits = [10.0, 50.0]\nstart = 20.0", "axis[3].soft_limits", "reference position (0 where"},
    {"reference", "soft_limits = [-300.0, 300.0]", "soft_limits = [-300.0, 300.0]\nreference = [0.0, 300.5]", "axis[3].reference",
     "inside"},
    {"system_gap", "name = \"Z\"", "name = \"Z\"\nsystem = 3", "axis", "part system 2 has no axis"},
    {"point_twice", "name = \"in1\"", "name = \"in0\"", "point[2].name", "already there"},
    {"point_device_m", "name = \"in1\"", "name = \"M5\"", "point[2].name", "a device or a constant"},
    {"point_digits", "name = \"in1\"", "name = \"K4M0\"", "point[2].name", "a device or a constant"},
    {"point_bit", "name = \"in1\"", "name = \"in0.3\"", "point[2].name", "would be bit 3"},
    {"point_signal_name", "name = \"in1\"", "name = \"nc.ready\"", "point[2].name", "is a signal"},
    {"point_like_signal", "name = \"in1\"", "name = \"nc2.mystery\"", "point[2].name", "belong to the signals"},
    {"point_name", "name = \"in1\"", "name = \"in 1\"", "point[2].name", "letters, digits"},
    {"point_device", "name = \"in1\"", "name = \"K5\"", "point[2].name", "constant of the ladder"},
    {"point_signal", "name = \"in1\"", "name = \"nc.ready\"", "point[2].name", "signal between"},
    {"point_direction", "name = \"in1\"\ndirection = \"input\"", "name = \"in1\"", "point[2].direction",
     "is missing"},
    {"point_initial", "name = \"in1\"", "name = \"in1\"\ninitial = 2", "point[2].initial", "from 0 to 1"},
    {"mapped_twice", "\"#1001\" = \"in1\"", "\"#1001\" = \"in0\"", "macro_interface.\"#1001\"",
     "mapped twice"},
    {"output_as_input", "\"#1001\" = \"in1\"", "\"#1101\" = \"in1\"", "macro_interface.\"#1101\"",
     "is an output of"},
    {"input_as_output", "\"#1100\" = \"out0\"", "\"#1200\" = \"out0\"", "macro_interface.\"#1200\"",
     "is an input of"},
    {"bit_as_word", "\"#1001\" = \"in1\"", "\"#1034\" = \"in1\"", "macro_interface.\"#1034\"", "32-bit word"},
    {"word_as_bit", "\"#1033\" = \"word_in\"", "\"#1264\" = \"word_in\"", "macro_interface.\"#1264\"",
     "one bit"},
    {"no_point", "\"#1001\" = \"in1\"", "\"#1001\" = \"in9\"", "macro_interface.\"#1001\"",
     "no point is named"},
    {"not_interface", "\"#1001\" = \"in1\"", "\"#1036\" = \"in1\"", "macro_interface.\"#1036\"",
     "is not a number of the macro interface (#1000-#1035, #1100-#1135, #1200-#1295, #1300-#1395)"},
    {"not_interface2", "\"#1001\" = \"in1\"", "\"1001\" = \"in1\"", "macro_interface.1001",
     "is not a number of"},
    {"parameter", nullptr, "\n[parameters]\n\"1078\" = []\n", "parameters.1078", "not an array"},
    {"parameter_axis", nullptr, "\n[parameters]\n\"8206\" = { Q = 1 }\n", "parameters.8206.Q", "no axis"},
    {"work_name", nullptr, "\n[work_offsets]\nG53 = { X = 1 }\n", "work_offsets.G53", "must be EXT"},
    {"work_p", nullptr, "\n[work_offsets]\n\"G54.1P97\" = { X = 1 }\n", "work_offsets.\"G54.1P97\"",
     "G54.1P96"},
    {"work_axis", nullptr, "\n[work_offsets]\nG54 = { C = 1 }\n", "work_offsets.G54.C", "no axis"},
    {"work_type", nullptr, "\n[work_offsets]\nG54 = 3\n", "work_offsets.G54", "table by axis"},
    {"tool_number", nullptr, "\n[tool_offsets]\n0 = 3.0\n", "tool_offsets.0", "from 1 to 200"},
    {"tool_column", nullptr, "\n[tool_offsets]\n1 = { lenght = 3.0 }\n", "tool_offsets.1.lenght",
     "unknown key"},
    {"tool_name", nullptr, "\n[tool_offsets]\n1 = { name = \"a\\nb\" }\n", "tool_offsets.1.name", "must not have control characters"},
    {"tool_long_name", nullptr, "\n[tool_offsets]\n1 = { name = \"0123456789012345678901234567890123456789012345678901234567890123x\" }\n", "tool_offsets.1.name", "at most 64 bytes"},
    {"tool_pocket", nullptr, "\n[tool_offsets]\n1 = { pocket = -1 }\n", "tool_offsets.1.pocket", "must be from 0 to 9999"},
    {"tool_pocket_twice", nullptr, "\n[tool_offsets]\n1 = { name = \"drill\", pocket = 5 }\n2 = { pocket = 5 }\n", "tool_offsets.2.pocket", "pocket 5 has tool 1 (drill)"},
    {"tool_twice", nullptr, "\n[tool_offsets]\n1 = 2.0\n01 = 3.0\n", "tool_offsets.01", "already there, first in line"},
    {"overrun", nullptr, "\n[scheduling]\noverrun = \"panic\"\n", "scheduling.overrun",
     "\"count\", \"feed_hold\" or"},
    {"priority", nullptr, "\n[scheduling]\npriority = 99\n", "scheduling.priority", "from 1 to 98"},
    {"solid", nullptr, "\n[[sim.solid]]\nsignal = 9\nX = [1, 2]\n", "sim.solid[1].signal", "from 1 to 8"},
    {"solid_axis", nullptr, "\n[[sim.solid]]\nW = [1, 2]\n", "sim.solid[1].W", "unknown key"},
    {"solid_empty", nullptr, "\n[[sim.solid]]\n", "sim.solid[1]", "at least one axis"},
    {"script", "m_time_s = 0.004", "script = [\n\"when line 1: out0 = 1\"]", "sim.script", "is an output"},
    // [[modbus]] and the modbus table of a point; the base has 5 points, "<link>.ok" is not in the file.
    {"modbus_name_missing", nullptr, "\n[[modbus]]\nhost = \"h\"\n", "modbus[1].name", "is missing"},
    {"modbus_host_missing", nullptr, "\n[[modbus]]\nname = \"io\"\n", "modbus[1].host", "is missing"},
    {"modbus_host_and_device", nullptr, "\n[[modbus]]\nname = \"io\"\nhost = \"h\"\ndevice = \"/dev/ttyS1\"\n", "modbus[1].host", "either a host or a device"},
    {"modbus_port_and_device", nullptr, NC_LINE "port = 502\n", "modbus[1].port", "is for TCP"},
    {"modbus_device", nullptr, "\n[[modbus]]\nname = \"io\"\ndevice = \"ttyS1\"\n", "modbus[1].device", "the path of a serial line"},
    {"modbus_device_twice", nullptr, NC_LINE "[[modbus]]\nname = \"other\"\ndevice = \"/dev/nc-line\"\n", "modbus[2].device", "link \"io\" has this line"},
    {"modbus_baud", nullptr, NC_LINE "baud = 9601\n", "modbus[1].baud", "must be one of 1200, 2400, 4800, 9600,"},
    {"modbus_parity", nullptr, NC_LINE "parity = \"mark\"\n", "modbus[1].parity", "none"},
    {"modbus_stop_bits", nullptr, NC_LINE "stop_bits = 3\n", "modbus[1].stop_bits", "from 1 to 2"},
    {"modbus_rs485", nullptr, NC_LINE "rs485 = \"yes\"\n", "modbus[1].rs485", "driver"},
    {"modbus_rts_delay", nullptr, NC_LINE "rts_delay_us = 100\n", "modbus[1].rts_delay_us", "is for rs485"},
    {"modbus_rts_delay_range", nullptr, NC_LINE "rs485 = \"rts_high\"\nrts_delay_us = 100001\n", "modbus[1].rts_delay_us", "100000"},
    {"modbus_byte_timeout_line", nullptr, NC_LINE "byte_timeout_ms = 1001\n", "modbus[1].byte_timeout_ms", "at most 1000 on a serial line"},
    {"modbus_baud_of_tcp", nullptr, NC_LINK "baud = 9600\n", "modbus[1].baud", "is for a serial line"},
    {"modbus_unit_everybody", nullptr, NC_LINE "unit = 0\n", "modbus[1].unit", "from 1 to 247 on a serial line"},
    {"modbus_unit_of_point_line", nullptr, NC_LINE "[[point]]\nname = \"p\"\ndirection = \"input\"\nmodbus = { link = \"io\", table = \"coil\", address = 0, unit = 255 }\n", "point[6].modbus.unit", "from 1 to 247 on a serial line"},
    {"modbus_host", nullptr, "\n[[modbus]]\nname = \"io\"\nhost = \"\"\n", "modbus[1].host", "an address"},
    {"modbus_name", nullptr, "\n[[modbus]]\nname = \"i o\"\nhost = \"h\"\n", "modbus[1].name", "letters"},
    {"modbus_twice", nullptr, NC_LINK NC_LINK, "modbus[2].name", "already there"},
    {"modbus_unused", nullptr, NC_LINK, "modbus[1].name", "no point uses the link \"io\""},
    {"modbus_ok_taken", "name = \"in1\"", "name = \"io.ok\"\ndirection = \"input\"\n" NC_LINK "[[point]]\nname = \"in1\"",
     "point[2].name", "already there"},
    {"modbus_port", nullptr, NC_LINK "port = 65536\n", "modbus[1].port", "from 1 to 65535"},
    {"modbus_poll", nullptr, NC_LINK "poll_ms = 0\n", "modbus[1].poll_ms", "from 1 to"},
    {"modbus_timeout", nullptr, NC_LINK "response_timeout_ms = 0\n", "modbus[1].response_timeout_ms", "from 1 to"},
    {"modbus_byte_timeout", nullptr, NC_LINK "byte_timeout_ms = -1\n", "modbus[1].byte_timeout_ms", "from 1 to"},
    {"modbus_lost", nullptr, NC_LINK "lost_after = 0\n", "modbus[1].lost_after", "from 1 to"},
    {"modbus_refresh", nullptr, NC_LINK "refresh_ms = 0\n", "modbus[1].refresh_ms", "from 10 to"},
    {"modbus_gap", nullptr, NC_LINK "merge_gap = 125\n", "modbus[1].merge_gap", "from 0 to 124"},
    {"modbus_unit", nullptr, NC_LINK "unit = 248\n", "modbus[1].unit", "0 to 247, or 255"},
    {"modbus_unknown_key", nullptr, NC_LINK "hosts = 1\n", "modbus[1].hosts", "unknown key"},
    {"modbus_unknown_link", nullptr, NC_BIT("input", "link = \"oi\", table = \"coil\", address = 0"),
     "point[6].modbus.link", "no link is named \"oi\""},
    {"modbus_no_link", nullptr, NC_BIT("input", "table = \"coil\", address = 0"), "point[6].modbus.link", "is missing"},
    {"modbus_no_table", nullptr, NC_BIT("input", "link = \"io\", address = 0"), "point[6].modbus.table", "is missing"},
    {"modbus_no_address", nullptr, NC_BIT("input", "link = \"io\", table = \"coil\""), "point[6].modbus.address",
     "is missing"},
    {"modbus_table", nullptr, NC_BIT("input", "link = \"io\", table = \"coils\", address = 0"),
     "point[6].modbus.table", "must be \"coil\""},
    {"modbus_address_high", nullptr, NC_BIT("input", "link = \"io\", table = \"coil\", address = 65536"),
     "point[6].modbus.address", "from 0 to 65535"},
    {"modbus_address_low", nullptr, NC_BIT("input", "link = \"io\", table = \"coil\", address = -1"),
     "point[6].modbus.address", "from 0 to 65535"},
    {"modbus_address_end", nullptr,
     NC_WORD("input", "link = \"io\", table = \"holding\", address = 65535, words = \"ABCD\""),
     "point[6].modbus.address", "two registers"},
    {"modbus_point_unit", nullptr, NC_BIT("input", "link = \"io\", table = \"coil\", address = 0, unit = 250"),
     "point[6].modbus.unit", "0 to 247, or 255"},
    {"modbus_output_discrete", nullptr, NC_BIT("output", "link = \"io\", table = \"discrete\", address = 0"),
     "point[6].modbus.table", "can only be read"},
    {"modbus_output_input", nullptr, NC_WORD("output", "link = \"io\", table = \"input\", address = 0"),
     "point[6].modbus.table", "can only be read"},
    {"modbus_word_coil", nullptr, NC_WORD("input", "link = \"io\", table = \"coil\", address = 0"),
     "point[6].modbus.table", "holds bits"},
    {"modbus_bit_of_what", nullptr, NC_BIT("input", "link = \"io\", table = \"holding\", address = 0"),
     "point[6].modbus.bit", "is missing"},
    {"modbus_bit_range", nullptr, NC_BIT("input", "link = \"io\", table = \"holding\", address = 0, bit = 16"),
     "point[6].modbus.bit", "from 0 to 15"},
    {"modbus_bit_of_coil", nullptr, NC_BIT("input", "link = \"io\", table = \"coil\", address = 0, bit = 1"),
     "point[6].modbus.bit", "no meaning"},
    {"modbus_bit_of_word", nullptr, NC_WORD("input", "link = \"io\", table = \"holding\", address = 0, bit = 1"),
     "point[6].modbus.bit", "the point is a word"},
    {"modbus_order_of_bit", nullptr, NC_BIT("input", "link = \"io\", table = \"coil\", address = 0, words = \"ABCD\""),
     "point[6].modbus.words", "the point is a bit"},
    {"modbus_scale_of_bit", nullptr, NC_BIT("input", "link = \"io\", table = \"coil\", address = 0, scale = 2"),
     "point[6].modbus.scale", "the point is a bit"},
    {"modbus_order_of_16", nullptr,
     NC_WORD("input", "link = \"io\", table = \"holding\", address = 0, words = \"BA\""), "point[6].modbus.words",
     "a value of 16 bits has none"},
    {"modbus_order_empty", nullptr,
     NC_WORD("input", "link = \"io\", table = \"holding\", address = 0, words = \"\""), "point[6].modbus.words",
     "must be \"ABCD\""},
    {"modbus_float_signed", nullptr,
     NC_WORD("input", "link = \"io\", table = \"holding\", address = 0, float = true, signed = true"),
     "point[6].modbus.signed", "no meaning"},
    {"modbus_scale", nullptr, NC_WORD("input", "link = \"io\", table = \"holding\", address = 0, scale = 0"),
     "point[6].modbus.scale", "must not be zero"},
    {"modbus_scale_nan", nullptr, NC_WORD("input", "link = \"io\", table = \"holding\", address = 0, scale = nan"),
     "point[6].modbus.scale", "not nan"},
    {"modbus_on_loss", nullptr, NC_BIT("input", "link = \"io\", table = \"coil\", address = 0, on_loss = \"keep\""),
     "point[6].modbus.on_loss", "must be \"hold\", \"off\" or"},
    {"modbus_on_loss_bit", nullptr, NC_BIT("input", "link = \"io\", table = \"coil\", address = 0, on_loss = 2"),
     "point[6].modbus.on_loss", "from 0 to 1"},
    {"modbus_on_stop", nullptr, NC_BIT("output", "link = \"io\", table = \"coil\", address = 0, on_stop = \"keep\""),
     "point[6].modbus.on_stop", "must be \"hold\", \"off\" or"},
    {"modbus_on_stop_input", nullptr, NC_BIT("input", "link = \"io\", table = \"coil\", address = 0, on_stop = \"hold\""),
     "point[6].modbus.on_stop", "is for outputs"},
    {"modbus_on_stop_high", nullptr, NC_WORD("output", "link = \"io\", table = \"holding\", address = 0, on_stop = 65536"),
     "point[6].modbus.on_stop", "from 0 to 65535"},
    {"modbus_on_stop_register", nullptr,
     NC_BIT("output", "link = \"io\", table = \"holding\", address = 0, bit = 0, on_stop = \"hold\"")
         NC_POINT("q", "bit", "output", "link = \"io\", table = \"holding\", address = 0, bit = 1"),
     "point[7].modbus.on_stop", "for all bits of a register or for none"},
    {"modbus_on_loss_sign", nullptr,
     NC_WORD("input", "link = \"io\", table = \"input\", address = 0, on_loss = \"-1\""), "point[6].modbus.on_loss",
     "from 0 to 65535"},
    {"modbus_on_loss_high", nullptr,
     NC_WORD("input", "link = \"io\", table = \"input\", address = 0, on_loss = 65536"), "point[6].modbus.on_loss",
     "from 0 to 65535"},
    {"modbus_on_loss_scaled", nullptr,
     NC_WORD("input", "link = \"io\", table = \"input\", address = 0, signed = true, scale = 0.1, on_loss = 3278"),
     "point[6].modbus.on_loss", "from -3277 to 3277"},
    {"modbus_on_loss_float", nullptr,
     NC_WORD("input", "link = \"io\", table = \"input\", address = 0, float = true, on_loss = 2147483648"),
     "point[6].modbus.on_loss", "from -2147483648 to 2147483647"},
    {"modbus_initial_high", nullptr,
     NC_WORD("output", "link = \"io\", table = \"holding\", address = 7") "initial = 70000\n", "point[6].initial",
     "from 0 to 65535, what holding 7 can hold"},
    {"modbus_initial_sign", nullptr,
     NC_WORD("output", "link = \"io\", table = \"holding\", address = 7, signed = true") "initial = 40000\n",
     "point[6].initial", "from -32768 to 32767"},
    {"modbus_initial_negative", nullptr,
     NC_WORD("output", "link = \"io\", table = \"holding\", address = 7") "initial = -1\n", "point[6].initial",
     "from 0 to 65535"},
    {"modbus_initial_scaled", nullptr,
     NC_WORD("output", "link = \"io\", table = \"holding\", address = 7, scale = 0.01") "initial = 700\n",
     "point[6].initial", "from 0 to 655,"},
    {"modbus_initial_left_out", nullptr,
     NC_WORD("output", "link = \"io\", table = \"holding\", address = 7, offset = 10"), "point[6].initial",
     "is 0 when it is left out, but must be from 10 to 65545"},
    {"modbus_host_with_port", nullptr, "\n[[modbus]]\nname = \"io\"\nhost = \"10.0.0.1:502\"\n", "modbus[1].host", "key of its own: port"},
    {"modbus_host_blank", nullptr, "\n[[modbus]]\nname = \"io\"\nhost = \"a b\"\n", "modbus[1].host", "an address or the name"},
    {"nul_in_a_text", nullptr, "[ladder]\nprogram = \"x.il\\u0000y\"\n", "ladder.program", "must not hold a NUL"},
    {"retained_twice", "name = \"test\"", "name = \"test\"\nvariables = \"kept\"\n[ladder]\nprogram = \"x.il\"\nretain = \"kept\"",
     "ladder.retain", "common variables too"},
    {"offsets_and_variables_in_one", "name = \"test\"", "name = \"test\"\nvariables = \"kept\"\noffsets = \"kept\"", "machine.offsets",
     "common variables too"},
    {"offsets_and_devices_in_one", "name = \"test\"", "name = \"test\"\noffsets = \"kept\"\n[ladder]\nprogram = \"x.il\"\nretain = \"./kept\"",
     "ladder.retain", "the offsets too"},
    {"retain_every", "name = \"test\"", "name = \"test\"\nretain_every_s = 0.0", "machine.retain_every_s", "from 0.02 to 3600"},
    {"initial_of_a_bit", "name = \"in1\"", "name = \"in1\"\ninitial = -1", "point[2].initial", "from 0 to 1"},
    {"modbus_on_loss_output", nullptr, NC_BIT("output", "link = \"io\", table = \"coil\", address = 0, on_loss = \"off\""),
     "point[6].modbus.on_loss", "is for inputs"},
    {"modbus_collision_coil", nullptr,
     NC_BIT("output", "link = \"io\", table = \"coil\", address = 7")
         NC_POINT("q", "bit", "output", "link = \"io\", table = \"coil\", address = 7"),
     "point[7].modbus.address", "point \"p\" writes coil 7"},
    {"modbus_collision_wide", nullptr,
     NC_WORD("output", "link = \"io\", table = \"holding\", address = 7, words = \"ABCD\"")
         NC_POINT("q", "word", "output", "link = \"io\", table = \"holding\", address = 8"),
     "point[7].modbus.address", "writes holding 7"},
    {"modbus_collision_bit", nullptr,
     NC_WORD("output", "link = \"io\", table = \"holding\", address = 7")
         NC_POINT("q", "bit", "output", "link = \"io\", table = \"holding\", address = 7, bit = 2"),
     "point[7].modbus.address", "writes holding 7"},
    {"modbus_collision_same_bit", nullptr,
     NC_BIT("output", "link = \"io\", table = \"holding\", address = 7, bit = 2")
         NC_POINT("q", "bit", "output", "link = \"io\", table = \"holding\", address = 7, bit = 2"),
     "point[7].modbus.address", "writes holding 7"},
    {"modbus_scripted", "m_time_s = 0.004",
     "script = [\"at scan 1: p = 1\"]\n" NC_BIT("input", "link = \"io\", table = \"coil\", address = 0"), "sim.script",
     "carried by another bus"},
    {"modbus_not_a_table", nullptr, NC_LINK "[[point]]\nname = \"p\"\ndirection = \"input\"\nmodbus = \"io\"\n",
     "point[6].modbus", "must be a table"},
    {"modbus_alarm", nullptr, "[[modbus]]\nname = \"io\"\nhost = \"h\"\nalarm = 1\n", "modbus[1].alarm", "must be"},
    {"signal_unknown", nullptr, "[signals]\n\"plc.feed_hold\" = \"in0\"\n", "signals.\"plc.feed_hold\"", "no signal of this machine"},
    {"signal_axis_unknown", nullptr, "[signals]\n\"nc.moving_p.Q\" = \"out1\"\n", "signals.\"nc.moving_p.Q\"", "no signal"},
    {"signal_second_system", nullptr, "[signals]\n\"nc2.cycle_lamp\" = \"out0\"\n", "signals.\"nc2.cycle_lamp\"", "no signal"},
    {"signal_no_point", nullptr, "[signals]\n\"plc.fin1\" = \"nowhere\"\n", "signals.\"plc.fin1\"", "no point is named"},
    {"signal_direction", nullptr, "[signals]\n\"plc.fin1\" = \"out0\"\n", "signals.\"plc.fin1\"", "is an output"},
    {"signal_direction_back", nullptr, "[signals]\n\"nc.ready\" = \"in0\"\n", "signals.\"nc.ready\"", "is an input"},
    {"signal_type", nullptr, "[signals]\n\"plc.fin1\" = \"word_in\"\n", "signals.\"plc.fin1\"", "is a bit, but"},
    {"signal_type_word", nullptr, "[signals]\n\"plc.feed_override\" = \"in0\"\n", "signals.\"plc.feed_override\"", "is a word, but"},
    {"signal_macro", nullptr, "[signals]\n\"nc.ready\" = \"out0\"\n", "signals.\"nc.ready\"", "point \"out0\" is set by two: an output of the macro interface, and a signal of the control, first in line"},
    {"signal_ladder", nullptr, "[ladder]\nprogram = \"x.il\"\n[signals]\n\"plc.fin1\" = \"in0\"\n", "signals.\"plc.fin1\"",
     "given by the ladder"},
    {"signal_twice", nullptr,
     "[[point]]\nname = \"lamp\"\ndirection = \"output\"\n[signals]\n\"nc.ready\" = \"lamp\"\n\"nc.alarm\" = \"lamp\"\n",
     "signals.\"nc.alarm\"", "point \"lamp\" is set by two: a signal of the control, and a signal of the control, first in line"},
    {"signal_not_text", nullptr, "[signals]\n\"nc.ready\" = 1\n", "signals.\"nc.ready\"", "must be"},
    {"retain_d_order", nullptr, "[ladder]\nprogram = \"x.il\"\nretain_d = [10, 5]\n", "ladder.retain_d", "first and the last"},
    {"retain_d_range", nullptr, "[ladder]\nprogram = \"x.il\"\nretain_d = [0, 8192]\n", "ladder.retain_d", "0 to 8191"},
    {"retain_d_fraction", nullptr, "[ladder]\nprogram = \"x.il\"\nretain_d = [0.5, 8]\n", "ladder.retain_d", "first and the last"},
    {"point_meaning", "name = \"in1\"", "name = \"in1\"\nmeaning = \"" NC_LONG "\"", "point[2].meaning", "longer than 127"},
    {"tool_axis_word", "name = \"test\"", "name = \"test\"\ntool_axis = [\"mechanical\"]", "machine.tool_axis", "\"mechanical_a\" or \"mechanical_b\", not \"mechanical\""},
    {"tool_axis_of_nobody", "name = \"test\"", "name = \"test\"\ntool_axis = [\"turned\", \"turned\"]", "machine.tool_axis", "for 2 part systems, and the axes belong to 1"},
    {"spindles_none", "name = \"test\"", "name = \"test\"\nspindles = [0]", "machine.spindles", "1 to 4 spindles, not 0"},
    {"spindles_many", "name = \"test\"", "name = \"test\"\nspindles = [5]", "machine.spindles", "1 to 4 spindles, not 5"},
    {"spindles_half", "name = \"test\"", "name = \"test\"\nspindles = [1.5]", "machine.spindles", "1 to 4 spindles, not 1.5"},
    {"spindles_of_nobody", "name = \"test\"", "name = \"test\"\nspindles = [1, 2]", "machine.spindles", "of 2 part systems, and the axes belong to 1"},
    {"spindle_of_a_linear_axis", "name = \"Z\"", "name = \"Z\"\nspindle = 1", "axis[3].spindle", "rotary axes"},
    {"spindle_unknown", "name = \"Z\"", "name = \"Z\"\nrotary = true\nspindle = 2", "axis[3].spindle", "has one spindle: see machine.spindles"},
    {"spindle_out_of_range", "name = \"Z\"", "name = \"Z\"\nrotary = true\nspindle = 5", "axis[3].spindle", "4"},
    {"spindle_twice", nullptr,
     "[[axis]]\nname = \"A\"\nrotary = true\nspindle = 1\nmax_velocity = 1.0\nmax_acceleration = 1.0\n"
     "[[axis]]\nname = \"C\"\nrotary = true\nspindle = 1\nmax_velocity = 1.0\nmax_acceleration = 1.0\n",
     "axis[5].spindle", "spindle 1 is axis A already"},
    {"plant_of_no_spindle", nullptr, "[ladder]\nprogram = \"x.il\"\n[sim.spindle2]\nforward = \"out0\"\nspeed = \"word_out\"\n", "sim.spindle2",
     "part system 1 has no spindle 2"},
    {"syntax", "name = \"test\"", "name = \"test", "", "syntax"},
    {"duplicate_key", "name = \"test\"", "name = \"test\"\nname = \"again\"", "", "syntax"},
    {"integer_of_70_bits", "name = \"Z\"", "name = \"Z\"\nmax_jerk = 1180591620717411303424", "axis[3].max_jerk", "is not representable in 64 bits"},
    {"integer_of_70_bits_in_a_list", "name = \"Z\"", "name = \"Z\"\nreference = [0,\n  -1180591620717411303424]", "axis[3].reference", "is not representable in 64 bits"},
    {"homing_offset_beyond_the_travel", "name = \"Z\"", "name = \"Z\"\nhoming = { kind = \"here\", offset = 5000.0 }", "axis[3].homing.offset", "is farther than the axis travels"},
    {"no_name", "name = \"test\"", "name = \"\"", "machine.name", "must not be empty"},
    {"denormal", "name = \"Z\"", "name = \"Z\"\nin_position = 1e-320", "axis[3].in_position", "must be from 1e-06 to 1e+06"},
    {"tiny_where_0_is_none", "name = \"Z\"", "name = \"Z\"\nfollowing_error_limit = 0.00001", "axis[3].following_error_limit", "must be 0, or from 0.001 to 1e+06"},
    {"denormal_in_a_list", "name = \"Z\"", "name = \"Z\"\nreference = [1e-320]", "axis[3].reference", "nor anything that a machine can mean"},
};

INSTANTIATE_TEST_SUITE_P(All, ConfigErrors, testing::ValuesIn(kCases),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(Config, AWordAndItsBitsAreOneImage) {
  std::string text = nc::test::base_toml();
  text.replace(text.find("\"#1001\""), 7, "\"#1200\"");  // bit 0 of #1033, which is mapped as a word
  Config config;
  const auto errors = nc::rt::parse_config(text, "m.toml", &config);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].message.find("word and a bit"), std::string::npos) << errors[0].text();
}

TEST(Config, APointIsOneWireOfTheSimulatedMachine) {
  std::string text = nc::test::base_toml() + "[ladder]\nprogram = \"x.il\"\n[[point]]\nname = \"w2\"\ntype = \"word\"\ndirection = \"output\"\n";
  const std::string spindle = "[sim.spindle]\nforward = \"out0\"\nspeed = \"word_out\"\n";
  Config config;
  EXPECT_TRUE(nc::rt::parse_config(text + spindle, "m.toml", &config).empty());
  const auto errors = nc::rt::parse_config(text + spindle + "reverse = \"out0\"\n", "m.toml", &config);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].key, "sim.spindle.reverse");
  EXPECT_NE(errors[0].message.find("as sim.spindle.forward"), std::string::npos) << errors[0].text();
  const auto across = nc::rt::parse_config(text + spindle + "[sim.tool_changer]\nprepare = \"out0\"\npocket = \"word_out\"\n"
                                               "prepared = \"in0\"\nchange = \"out0\"\nchanged = \"in1\"\n", "m.toml", &config);
  ASSERT_EQ(across.size(), 3u) << "prepare, pocket, change";
}

TEST(Config, WhatCouldBeReadIsThereForThoseWhoLookFurther) {
  Config config, partial;
  config.name = "untouched";
  const std::string text = nc::test::base_toml() + "[ladder]\nprogram = \"x.il\"\nalarms = 3\n";
  EXPECT_EQ(nc::rt::parse_config(text, "m.toml", &config, &partial).size(), 1u);
  EXPECT_EQ(config.name, "untouched");
  EXPECT_EQ(partial.ladder.program, "x.il");
  EXPECT_GE(partial.points.find("in0"), 0);
}

TEST(Config, ReportsEveryErrorInTheOrderOfLines) {
  std::string text = nc::test::base_toml();
  for (const auto& [from, to] : {std::pair{"max_velocity = 200.0", "max_velocity = 0"},
                                 {"name = \"Y\"", "nam = \"Y\""},
                                 {"name = \"in1\"", "name = \"\""}})
    text.replace(text.find(from), std::string(from).size(), to);
  Config config;
  config.name = "untouched";
  const auto errors = nc::rt::parse_config(text, "m.toml", &config);
  EXPECT_GE(errors.size(),
            5u);  // range, unknown key, missing name, empty point name, #1001 without its point
  EXPECT_TRUE(std::is_sorted(errors.begin(), errors.end(),
                             [](const ConfigError& a, const ConfigError& b) { return a.line < b.line; }));
  EXPECT_EQ(config.name, "untouched") << "a configuration with errors changes nothing";
}

TEST(Config, EmptyTextNamesWhatIsMissing) {
  Config config;
  std::string all;
  for (const ConfigError& error : nc::rt::parse_config("", "m.toml", &config)) all += error.text() + "\n";
  EXPECT_NE(all.find("machine: is missing"), std::string::npos) << all;
  EXPECT_NE(all.find("axis: is missing"), std::string::npos) << all;
}

TEST(Config, AKeyOfAThousandPartsIsRefusedOnItsLine) {
  std::string deep = "a";
  for (int i = 0; i < 100000; ++i) deep += i % 2 == 0 ? ".a" : " . 'a'";
  for (const std::string& text : {deep + " = 1", "[" + deep + "]", "x = { " + deep + " = 1 }", "\"#\"." + deep + " = 1"}) {
    Config config;
    const std::vector<ConfigError> errors = nc::rt::parse_config("# ok\n" + text + "\n", "deep.toml", &config);
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_EQ(errors[0].line, 2u);
    EXPECT_NE(errors[0].message.find("too many parts"), std::string::npos);
  }
  Config config;
  const std::string dots(200, '.');
  for (const ConfigError& error : nc::rt::parse_config("# " + dots + "\nname = \"" + dots + "\"\n", "dots.toml", &config))
    EXPECT_EQ(error.message.find("too many parts"), std::string::npos);
}

TEST(Config, ReadsValues) {
  const Config config = nc::test::parse_or_fail(nc::test::base_toml() + R"(
[scheduling]
overrun = "feed_hold"
[parameters]
"1003" = "B"
"1267/bit0" = 1
"8206" = { X = 5.5 }
[work_offsets]
G54 = { X = -100.0, Z = 2 }
"G54.1P2" = { Y = 7.0 }
EXT = { Z = 1.0 }
[tool_offsets]
1 = 10.0
2 = { length = 1.0, radius_wear = 0.25 }
[[sim.solid]]
X = [1.0, 2.0]
)");
  EXPECT_EQ(config.nc.system[0].axis_count, 3);
  EXPECT_EQ(config.nc.system[0].axis[1].name, 'Y');
  EXPECT_DOUBLE_EQ(config.nc.system[0].axis[1].rapid, 150.0) << "rapid defaults to max_velocity";
  EXPECT_TRUE(config.nc.system[0].axis[2].soft_limited);
  EXPECT_DOUBLE_EQ(config.nc.cycle_s, 0.001);
  EXPECT_EQ(config.scheduling.overrun, nc::rt::OverrunReaction::kFeedHold);
  ASSERT_EQ(config.parameters.size(), 3u);
  ASSERT_EQ(config.work_offsets.size(), 4u);
  ASSERT_EQ(config.tool_offsets.size(), 2u);
  for (const auto& parameter : config.parameters) {
    if (parameter.key == "1003") {
      EXPECT_EQ(parameter.text, "B");
    }
    if (parameter.key == "8206") {
      EXPECT_EQ(parameter.axis, 'X');
    }
  }
  EXPECT_EQ(config.macro.input_bit[0][1], 1);
  EXPECT_EQ(config.macro.input_word[1], 2);
  EXPECT_EQ(config.macro.output_bit[0][0], 3);
  EXPECT_EQ(config.macro.output_bit[0][1], -1);
  ASSERT_EQ(config.sim.solids.size(), 1u);
  EXPECT_DOUBLE_EQ(config.sim.solids[0].max[0], 2.0);
}

TEST(Config, EveryInterfaceNumberHasItsPlace) {
  // M700 13.5.5: the bit of each number, computed here once more from the manual's table.
  for (unsigned number = 1000; number < 1400; ++number) {
    int word = -1, bit = -1;
    bool output = false;
    if (number <= 1031) word = 0, bit = static_cast<int>(number - 1000);
    if (number >= 1200 && number <= 1295)
      word = 1 + static_cast<int>(number - 1200) / 32, bit = (static_cast<int>(number) - 1200) % 32;
    if (number >= 1100 && number <= 1131) word = 0, bit = static_cast<int>(number - 1100), output = true;
    if (number >= 1300 && number <= 1395)
      word = 1 + static_cast<int>(number - 1300) / 32, bit = (static_cast<int>(number) - 1300) % 32,
      output = true;
    const bool whole = (number >= 1032 && number <= 1035) || (number >= 1132 && number <= 1135);
    if (whole) {
      output = number >= 1132;
      word = static_cast<int>(number - (output ? 1132 : 1032));
    }
    const std::string text =
        "[machine]\n[[axis]]\nname=\"X\"\nmax_velocity=1\nmax_acceleration=1\n[[point]]\nname=\"p\"\ntype="
        "\"" +
        std::string(whole ? "word" : "bit") + "\"\ndirection=\"" + (output ? "output" : "input") +
        "\"\n[macro_interface]\n\"#" + std::to_string(number) + "\"=\"p\"\n";
    Config config;
    const auto errors = nc::rt::parse_config(text, "m.toml", &config);
    if (word < 0) {
      EXPECT_FALSE(errors.empty()) << number;
      continue;
    }
    ASSERT_TRUE(errors.empty()) << number << ": " << errors[0].text();
    const auto& map = config.macro;
    const int point = whole
                          ? (output ? map.output_word : map.input_word)[static_cast<unsigned>(word)]
                          : (output ? map.output_bit
                                    : map.input_bit)[static_cast<unsigned>(word)][static_cast<unsigned>(bit)];
    EXPECT_EQ(point, 0) << number;
  }
}

// The Series 8 has a name for its input, and HX has numbers of its own.
TEST(Config, TheMacroInterfaceGoesByTheNamesOfTheFamily) {
  const auto parse = [](const std::string& dialect, const std::string& key, Config* config, const std::string& type = "bit") {
    return nc::rt::parse_config("[machine]\ndialect=\"" + dialect + "\"\n[[axis]]\nname=\"X\"\nmax_velocity=1\nmax_acceleration=1\n[[point]]\nname=\"p\"\ntype=\"" + type + "\"\ndirection=\"input\"\n"
                                    "[macro_interface]\n\"" + key + "\"=\"p\"\n", "m.toml", config);
  };
  Config named, numbered, wrong;
  EXPECT_TRUE(parse("series8", "@RUNG6", &named).empty());
  EXPECT_EQ(named.macro.input_bit[0][0], 0);
  EXPECT_TRUE(parse("hx", "#7001", &numbered).empty());
  EXPECT_EQ(numbered.macro.input_bit[0][1], 0);
  Config bit, word;
  EXPECT_TRUE(parse("iso", "@motion.digital-in-07", &bit).empty());
  EXPECT_EQ(bit.macro.input_bit[0][7], 0);
  EXPECT_TRUE(parse("iso", "@motion.analog-in-02", &word, "word").empty());
  EXPECT_EQ(word.macro.input_word[3], 0);
  for (const char* key : {"@motion.digital-in-32", "@motion.digital-in-7", "@motion.analog-in-03", "@motion.digital-in-0x", "@motion.digital-inn-07", "@motion.digital-in--1"})
    EXPECT_FALSE(parse("iso", key, &wrong).empty()) << key;
  EXPECT_FALSE(parse("series8", "@RUNG7", &wrong).empty());
  EXPECT_FALSE(parse("series8", "@", &wrong).empty());
  EXPECT_FALSE(parse("m700", "@RUNG6", &wrong).empty());
}

TEST(Config, ADialectWithoutVariablesHasNoMacroInterface) {
  Config config;
  const std::vector<ConfigError> errors = nc::rt::parse_config(
      "[machine]\ndialect=\"dgshape\"\n[[axis]]\nname=\"X\"\nmax_velocity=1\nmax_acceleration=1\n[[point]]\nname=\"p\"\ndirection=\"input\"\n"
      "[macro_interface]\n\"#1000\"=\"p\"\n",
      "m.toml", &config);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].key, "macro_interface.\"#1000\"");
  EXPECT_EQ(errors[0].message, "is not possible: this dialect has no macro interface");
}

// Whether the computer has what the file asks for is checked on the computer that uses it, not when the file is read.
TEST(Config, ProcessorAndFolderMustBeThere) {
  Config config;
  const std::string text = nc::test::base_toml() + "[scheduling]\ncpu = 999\n";
  ASSERT_TRUE(nc::rt::parse_config(text, "/tmp/m.toml", &config).empty());
  std::vector<ConfigError> errors = nc::rt::check_host(config);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].key, "scheduling.cpu");
  EXPECT_EQ(errors[0].line, line_of(text, text.find("cpu =")));
  EXPECT_NE(errors[0].message.find("not 999"), std::string::npos);

  ASSERT_TRUE(nc::rt::parse_config("[machine]\nprograms = \"no-such-folder\"\n" +
                                       nc::test::base_toml().substr(std::string("[machine]\n").size()),
                                   "/tmp/m.toml", &config)
                  .empty());
  errors = nc::rt::check_host(config);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].text(), "/tmp/m.toml:2: machine.programs: there is no folder \"/tmp/no-such-folder\"");

  config.programs = ".";
  config.scheduling.cpu = 0;
  EXPECT_TRUE(nc::rt::check_host(config).empty());
  config.file = "m.toml";  // in the current folder
  EXPECT_TRUE(nc::rt::check_host(config).empty());
}

TEST(Config, FilesOfRetainedDataNeedTheirFolder) {
  Config config = nc::test::parse_or_fail(nc::test::base_toml() + "[ladder]\nprogram = \"x.il\"\nretain = \"/nowhere/at/all\"\n");
  config.variables = "/";
  config.variables_place = {7, "machine.variables"};
  config.offsets = "/tmp";
  config.offsets_place = {8, "machine.offsets"};
  const std::vector<ConfigError> errors = nc::rt::check_host(config);
  std::string all;
  for (const ConfigError& error : errors) all += error.text() + "\n";
  EXPECT_NE(all.find("test.toml:7: machine.variables: \"/\" is a folder, not a file"), std::string::npos) << all;
  EXPECT_NE(all.find("test.toml:8: machine.offsets: \"/tmp\" is a folder, not a file"), std::string::npos) << all;
  EXPECT_NE(all.find("ladder.retain: there is no folder \"/nowhere/at\""), std::string::npos) << all;
}

TEST(Config, AWrongLimitIsOneErrorAndAFolderIsNoFile) {
  std::string text = nc::test::base_toml();
  text.replace(text.find("max_velocity = 200.0"), 20, "rapid = 5.0\nmax_velocity = nan");
  Config config;
  EXPECT_EQ(nc::rt::parse_config(text, "m.toml", &config).size(), 1u);
  const std::vector<ConfigError> errors = nc::rt::load_config("/tmp", &config);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].text(), "/tmp: cannot be read: is a folder");
}

TEST(Config, MissingFileIsAnError) {
  Config config;
  const auto errors = nc::rt::load_config("/nonexistent/machine.toml", &config);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].text().find("/nonexistent/machine.toml: cannot be read"), std::string::npos);
  EXPECT_EQ(nc::rt::load_config("/", &config).size(), 1u) << "a folder is not a file";
}

TEST(Config, ProgramsFolderIsRelativeToTheFile) {
  Config config;
  config.file = "/opt/etc/machine.toml";
  config.programs = "../parts";
  EXPECT_EQ(config.programs_folder(), "/opt/parts");
  config.programs = "/srv/nc";
  EXPECT_EQ(config.programs_folder(), "/srv/nc");
}

TEST(Config, HowProgramsAreRead) {
  const std::string axis = "[[axis]]\nname = \"X\"\nrapid = 100.0\nmax_velocity = 100.0\nmax_acceleration = 100.0\n";
  const auto with = [&](const std::string& keys, Config* config) {
    return nc::rt::parse_config("[machine]\n" + keys + axis, "machine.toml", config);
  };
  Config config;
  EXPECT_EQ(config.program_text.copy_bytes, 16u << 20);
  EXPECT_EQ(config.program_text.encoding, nc::rt::Encoding::kUtf8);
  (void)with("program_encoding = \"shift-jis\"\nprogram_copy_mb = 3\n", &config);
  Config wrong;
  const auto errors = with("program_encoding = \"ebcdic\"\nprogram_copy_mb = 2000\n", &wrong);
  unsigned found = 0;
  for (const auto& error : errors) found += error.key.find("program_encoding") != std::string::npos || error.key.find("program_copy_mb") != std::string::npos;
  EXPECT_EQ(found, 2u);
  Config partial;
  (void)nc::rt::parse_config("[machine]\nprogram_encoding = \"latin-1\"\nprogram_copy_mb = 3\n" + axis, "machine.toml", &config, &partial);
  EXPECT_EQ(partial.program_text.encoding, nc::rt::Encoding::kLatin1);
  EXPECT_EQ(partial.program_text.copy_bytes, 3u << 20);
}

TEST(Config, ShippedFilesAreValid) {
  unsigned files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(nc::test::kSourceDir + "/etc")) {
    if (entry.path().extension() != ".toml") continue;
    ++files;
    Config config;
    for (const ConfigError& error : nc::rt::load_config(entry.path().string(), &config))
      ADD_FAILURE() << error.text();
  }
  EXPECT_GE(files, 2u);
}

TEST(Config, TheOptimalModeNeedsTheJerkOfEveryAxis) {
  const std::string motion = "[motion]\nmode = \"optimal\"\ntolerance = 0.005\n";
  const Config config = nc::test::parse_or_fail(nc::test::base_toml() + motion);
  EXPECT_EQ(config.nc.motion_mode, NC_MOTION_OPTIMAL);
  EXPECT_DOUBLE_EQ(config.nc.path_tolerance, 0.005);
  EXPECT_EQ(nc::test::parse_or_fail(nc::test::base_toml() + "[motion]\nmode = \"optimal\"\ntolerance = 0.0\n").nc.path_tolerance, 0);
  EXPECT_DOUBLE_EQ(nc::test::parse_or_fail(nc::test::base_toml() + motion + "retract_overlap = 2.5\n").nc.retract_overlap, 2.5);
  EXPECT_EQ(config.nc.retract_overlap, 0);
  Config between;
  EXPECT_FALSE(nc::rt::parse_config(nc::test::base_toml() + motion + "retract_overlap = 101.0\n", "test.toml", &between).empty());
  EXPECT_FALSE(nc::rt::parse_config(nc::test::base_toml() + "[motion]\nmode = \"optimal\"\ntolerance = 0.00005\n", "test.toml", &between).empty());
  std::string text = nc::test::base_toml();
  const std::string jerk = "max_jerk = 50000.0";
  text.replace(text.find(jerk), jerk.size(), "max_jerk = 0.0");
  Config wrong;
  const std::vector<ConfigError> errors = nc::rt::parse_config(text + motion, "test.toml", &wrong);
  ASSERT_FALSE(errors.empty());
  EXPECT_NE(errors.front().text().find("motion.mode"), std::string::npos) << errors.front().text();
}

// A machine whose configuration names no law moves by the time-optimal one if every axis has the limits for it, and a check tells why it does.
TEST(Config, AMachineThatNamesNoLawIsOptimalWhereEveryAxisHasAllLimits) {
  const auto text_of = [](const Config& config) { return nc::rt::motion_text(config.nc, config.motion_given); };
  const Config all = nc::test::parse_or_fail(nc::test::base_toml());
  EXPECT_EQ(all.nc.motion_mode, NC_MOTION_OPTIMAL);
  EXPECT_EQ(all.nc.look_ahead, nc::rt::kLookAheadOptimal);
  EXPECT_EQ(text_of(all), "optimal: every axis has limits of velocity, acceleration and jerk");
  std::string text = nc::test::base_toml();
  const std::string jerk = "max_jerk = 50000.0\n";
  text.erase(text.rfind(jerk), jerk.size());
  const Config without = nc::test::parse_or_fail(text);
  EXPECT_EQ(without.nc.motion_mode, NC_MOTION_TRAPEZOID);
  EXPECT_EQ(without.nc.look_ahead, 1024u);
  EXPECT_EQ(text_of(without), "trapezoid: Z has no max_jerk");
  const Config tolerant = nc::test::parse_or_fail(text + "[motion]\ntolerance = 0.02\n");
  EXPECT_EQ(tolerant.nc.motion_mode, NC_MOTION_TRAPEZOID);
  const Config named = nc::test::parse_or_fail(nc::test::base_toml() + "[motion]\nmode = \"trapezoid\"\n");
  EXPECT_EQ(named.nc.motion_mode, NC_MOTION_TRAPEZOID);
  EXPECT_EQ(text_of(named), "trapezoid, as it is configured");
  std::string given = nc::test::base_toml();
  given.replace(given.find("name = \"test\""), 13, "name = \"test\"\nlook_ahead = 512");
  EXPECT_EQ(nc::test::parse_or_fail(given).nc.look_ahead, 512u);
}

TEST(Config, TheShippedMachinesAreOptimal) {
  for (const char* file : {"machine.toml", "modelling-machine.toml", "router.toml", "homed_mill.toml", "drill-mill.toml", "knee-mill.toml", "modbus-example.toml"}) {
    Config config;
    EXPECT_TRUE(nc::rt::load_config(nc::test::kSourceDir + "/etc/" + file, &config).empty()) << file;
    EXPECT_EQ(config.nc.motion_mode, NC_MOTION_OPTIMAL) << file;
  }
}

}  // namespace
