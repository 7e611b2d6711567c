// SPDX-License-Identifier: Apache-2.0
// The configuration of GPIO: what is read from it, and that each mistake is reported with its line and key.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "has_bus.hpp"
#include "places/places.hpp"
#include "runtime/config.hpp"
#include "test_config.hpp"

namespace {

using nc::hal::gpio::BankConfig;
using nc::hal::gpio::Bias;
using nc::hal::gpio::Drive;
using nc::rt::Config;
using nc::rt::ConfigError;

const std::string kBank = "\n[[gpio]]\nname = \"board\"\nchip = \"pinctrl-bcm2711\"\n";

std::string point(const std::string& name, const std::string& direction, const std::string& gpio, const std::string& more = "") {
  return "[[point]]\nname = \"" + name + "\"\ndirection = \"" + direction + "\"\n" + more + "gpio = { " + gpio + " }\n";
}

std::string input(const std::string& gpio) { return kBank + point("p", "input", "bank = \"board\", " + gpio); }
std::string output(const std::string& gpio) { return kBank + point("p", "output", "bank = \"board\", " + gpio); }

class GpioConfig : public testing::Test {
 protected:
  void SetUp() override {
    if (!nc::test::has_bus("gpio")) GTEST_SKIP() << "built without libgpiod";
  }
};

TEST_F(GpioConfig, EverythingThatCanBeSaidIsRead) {
  const Config config = nc::test::parse_or_fail(
      nc::test::base_toml() + kBank +
      "consumer = \"mill\"\npoll_ms = 5\nlost_after = 2\nalarm = true\nwatchdog = { offset = 4, drive = \"open-source\", active_low = true }\n" +
      point("door", "input", "bank = \"board\", line = \"DOOR\", active_low = true, bias = \"pull-up\", debounce_ms = 8, on_loss = 1") +
      point("level", "input", "bank = \"board\", offset = 17, bias = \"none\", on_loss = \"hold\"", "initial = 1\n") +
      point("lamp", "output", "bank = \"board\", line = \"LAMP\", drive = \"open-drain\"", "initial = 1\n") +
      point("pump", "output", "bank = \"board\", line = \"PUMP\", bias = \"pull-down\", on_stop = \"off\"", "initial = 1\n"));
  ASSERT_EQ(config.gpio.size(), 1u);
  const BankConfig& bank = config.gpio[0].bank;
  EXPECT_EQ(bank.chip, "pinctrl-bcm2711");
  EXPECT_EQ(bank.consumer, "mill");
  EXPECT_EQ(bank.poll_ms, 5u);
  EXPECT_EQ(bank.lost_after, 2u);
  EXPECT_TRUE(config.buses.at(0).alarm);
  ASSERT_TRUE(bank.has_watchdog);
  EXPECT_EQ(bank.watchdog.offset, 4u);
  EXPECT_EQ(bank.watchdog.drive, Drive::kOpenSource);
  EXPECT_TRUE(bank.watchdog.output && bank.watchdog.active_low);
  EXPECT_EQ(bank.ok_point, static_cast<unsigned>(config.points.find("board.ok")));
  ASSERT_EQ(bank.lines.size(), 4u);
  const nc::hal::gpio::PointLine &door = bank.lines[0], &level = bank.lines[1], &lamp = bank.lines[2], &pump = bank.lines[3];
  EXPECT_EQ(door.point, static_cast<unsigned>(config.points.find("door")));
  EXPECT_EQ(door.line.name, "DOOR");
  EXPECT_TRUE(door.line.active_low && !door.line.output && !door.hold_on_loss);
  EXPECT_EQ(door.line.bias, Bias::kPullUp);
  EXPECT_EQ(door.debounce_ms, 8u);
  EXPECT_EQ(door.loss_value, 1);
  EXPECT_TRUE(level.line.name.empty() && level.hold_on_loss);
  EXPECT_EQ(level.line.offset, 17u);
  EXPECT_EQ(level.line.bias, Bias::kNone);
  EXPECT_TRUE(lamp.line.output);
  EXPECT_EQ(lamp.line.drive, Drive::kOpenDrain);
  EXPECT_EQ(lamp.stop_value, 1) << "initial";
  EXPECT_EQ(pump.line.bias, Bias::kPullDown);
  EXPECT_EQ(pump.stop_value, 0);
}

TEST_F(GpioConfig, ProbesAndEncodersAreRead) {
  const Config config = nc::test::parse_or_fail(
      nc::test::base_toml() + kBank + point("door", "input", "bank = \"board\", line = \"DOOR\"") +
      point("probe", "input", "bank = \"board\", line = \"PROBE\", debounce_ms = 200, probe = { skip_signal = 3, edge = \"falling\", system = 1 }") +
      point("wheel", "input", "bank = \"board\", active_low = true, bias = \"pull-up\", debounce_ms = 1, encoder = { a = \"A\", b = 21, counts = 1, bits = 16 }", "type = \"word\"\n") +
      point("other", "input", "bank = \"board\", encoder = { a = 5, b = 6 }", "type = \"word\"\n"));
  const BankConfig& bank = config.gpio.at(0).bank;
  ASSERT_EQ(bank.lines.size(), 2u);
  EXPECT_TRUE(bank.lines[1].line.edges && !bank.lines[0].line.edges);
  ASSERT_EQ(bank.probes.size(), 1u);
  EXPECT_EQ(bank.probes[0].line, 1u);
  EXPECT_EQ(bank.probes[0].signal, 2);
  EXPECT_EQ(bank.probes[0].system, 0);
  EXPECT_TRUE(bank.probes[0].falling);
  ASSERT_EQ(bank.encoders.size(), 2u);
  const nc::hal::gpio::Encoder& wheel = bank.encoders[0];
  EXPECT_EQ(wheel.point, static_cast<unsigned>(config.points.find("wheel")));
  EXPECT_EQ(wheel.a.name, "A");
  EXPECT_TRUE(wheel.b.name.empty());
  EXPECT_EQ(wheel.b.offset, 21u);
  EXPECT_TRUE(wheel.a.active_low && wheel.b.active_low && wheel.a.edges && wheel.b.edges);
  EXPECT_EQ(wheel.b.bias, Bias::kPullUp);
  EXPECT_EQ(wheel.counts, 1u);
  EXPECT_EQ(wheel.bits, 16u);
  EXPECT_EQ(wheel.debounce_ms, 1u);
  EXPECT_EQ(bank.encoders[1].counts, 4u);
  EXPECT_EQ(bank.encoders[1].bits, 32u);
}

// The indented text at the beginning of the document is a configuration.
TEST_F(GpioConfig, TheExampleOfTheDocumentIsOne) {
  std::ifstream document(nc::test::kSourceDir + "/docs/gpio.md");
  std::string example;
  for (std::string line; std::getline(document, line) && line != "## Banks";)
    if (line.starts_with("    ")) example += line.substr(4) + "\n";
  const Config config = nc::test::parse_or_fail(nc::test::base_toml() + example);
  ASSERT_EQ(config.gpio.size(), 1u);
  EXPECT_EQ(config.gpio[0].bank.lines.size(), 2u);
  EXPECT_TRUE(config.gpio[0].bank.has_watchdog);
}

TEST_F(GpioConfig, ABankOfAWatchdogAloneIsOne) {
  const Config config = nc::test::parse_or_fail(nc::test::base_toml() + kBank + "watchdog = { line = \"WD\" }\n");
  EXPECT_TRUE(config.gpio.at(0).bank.has_watchdog);
  EXPECT_EQ(config.gpio[0].bank.consumer, "ncrtd");
  EXPECT_EQ(config.gpio[0].bank.poll_ms, 1u);
}

TEST_F(GpioConfig, PointsThatAreRefusedTakeNoLine) {
  const std::string line = "bank = \"board\", line = \"DOOR\"";
  Config config, partial;
  const auto errors = nc::rt::parse_config(nc::test::base_toml() + kBank + point("M100", "input", line) + point("door", "input", line), "m.toml", &config, &partial);
  ASSERT_EQ(errors.size(), 1u) << errors[1].text();
  EXPECT_EQ(errors[0].key, "point[6].name");
  ASSERT_EQ(partial.gpio.at(0).bank.lines.size(), 1u);
  EXPECT_EQ(partial.points.at(partial.gpio[0].bank.lines[0].point).name, "door");
}

struct Mistake {
  const char* name;
  std::string added;  // appended to a correct configuration
  const char* key;
  const char* message;
  unsigned line;      // of the added text, from 1
};
std::ostream& operator<<(std::ostream& out, const Mistake& mistake) { return out << mistake.name; }

class GpioMistakes : public GpioConfig, public testing::WithParamInterface<Mistake> {};

TEST_P(GpioMistakes, IsNamedWithItsLineAndKey) {
  const Mistake& mistake = GetParam();
  const std::string base = nc::test::base_toml();
  Config config;
  const std::vector<ConfigError> errors = nc::rt::parse_config(base + mistake.added, "m.toml", &config);
  ASSERT_EQ(errors.size(), 1u) << (errors.empty() ? "" : errors.back().text());
  EXPECT_EQ(errors[0].key, mistake.key);
  EXPECT_NE(errors[0].message.find(mistake.message), std::string::npos) << errors[0].text();
  EXPECT_EQ(errors[0].line, static_cast<unsigned>(std::count(base.begin(), base.end(), '\n')) + mistake.line) << errors[0].text();
}

const Mistake kMistakes[] = {
    {"no_chip", "[[gpio]]\nname = \"board\"\nwatchdog = { line = \"WD\" }\n", "gpio[1].chip", "is missing", 1},
    {"no_name", "[[gpio]]\nchip = \"c\"\n", "gpio[1].name", "is missing", 1},
    {"name", "[[gpio]]\nname = \"a b\"\nchip = \"c\"\n", "gpio[1].name", "letters, digits", 2},
    {"chip_empty", "[[gpio]]\nname = \"board\"\nchip = \"\"\nwatchdog = { line = \"WD\" }\n", "gpio[1].chip", "1 to 31 bytes", 3},
    {"chip_twice", kBank + "watchdog = { line = \"WD\" }\n[[gpio]]\nname = \"two\"\nchip = \"pinctrl-bcm2711\"\n", "gpio[2].chip", "the chip of \"board\" already", 8},
    {"name_twice", kBank + "watchdog = { line = \"WD\" }\n[[gpio]]\nname = \"board\"\nchip = \"c\"\n", "gpio[2].name", "already there", 7},
    {"name_of_a_link", "[[modbus]]\nname = \"io\"\nhost = \"h\"\n[[point]]\nname = \"p\"\ndirection = \"input\"\nmodbus = { link = \"io\", table = \"coil\", address = 0 }\n"
                       "[[gpio]]\nname = \"io\"\nchip = \"c\"\n", "gpio[1].name", "already there", 9},
    {"unused", kBank, "gpio[1].name", "no point uses the bank \"board\"", 3},
    {"poll", kBank + "poll_ms = 0\nwatchdog = { line = \"WD\" }\n", "gpio[1].poll_ms", "from 1 to 100", 5},
    {"lost_after", kBank + "lost_after = 0\nwatchdog = { line = \"WD\" }\n", "gpio[1].lost_after", "from 1 to 1000", 5},
    {"consumer", kBank + "consumer = \"a name of more than thirty-one bytes\"\nwatchdog = { line = \"WD\" }\n", "gpio[1].consumer", "1 to 31 bytes", 5},
    {"alarm", kBank + "alarm = 1\nwatchdog = { line = \"WD\" }\n", "gpio[1].alarm", "must be", 5},
    {"unknown_key", kBank + "chips = 1\nwatchdog = { line = \"WD\" }\n", "gpio[1].chips", "unknown key", 5},
    {"watchdog_no_line", kBank + "watchdog = { active_low = true }\n", "gpio[1].watchdog.line", "is missing: the name of the line, or its offset", 5},
    {"watchdog_debounce", kBank + "watchdog = { line = \"WD\", debounce_ms = 1 }\n", "gpio[1].watchdog.debounce_ms", "unknown key", 5},
    {"no_bank", kBank + "watchdog = { line = \"WD\" }\n" + point("p", "input", "line = \"DOOR\""), "point[6].gpio.bank", "is missing", 9},
    {"unknown_bank", kBank + "watchdog = { line = \"WD\" }\n" + point("p", "input", "bank = \"bord\", line = \"DOOR\""), "point[6].gpio.bank", "no bank is named \"bord\"", 9},
    {"no_line", input("bias = \"none\""), "point[6].gpio.line", "is missing", 8},
    {"line_and_offset", input("line = \"DOOR\", offset = 3"), "point[6].gpio.offset", "no meaning beside line", 8},
    {"line_empty", input("line = \"\""), "point[6].gpio.line", "1 to 31 bytes", 8},
    {"offset", input("offset = -1"), "point[6].gpio.offset", "from 0 to 65535", 8},
    {"bias", input("line = \"DOOR\", bias = \"up\""), "point[6].gpio.bias", "must be \"as-is\", \"none\", \"pull-up\" or \"pull-down\", not \"up\"", 8},
    {"drive", output("line = \"LAMP\", drive = \"strong\""), "point[6].gpio.drive", "must be \"push-pull\"", 8},
    {"drive_of_an_input", input("line = \"DOOR\", drive = \"open-drain\""), "point[6].gpio.drive", "is for outputs", 8},
    {"active_low", input("line = \"DOOR\", active_low = 1"), "point[6].gpio.active_low", "must be", 8},
    {"debounce", input("line = \"DOOR\", debounce_ms = 1001"), "point[6].gpio.debounce_ms", "from 0 to 1000", 8},
    {"debounce_of_an_output", output("line = \"LAMP\", debounce_ms = 5"), "point[6].gpio.debounce_ms", "is for inputs", 8},
    {"on_loss", input("line = \"DOOR\", on_loss = 2"), "point[6].gpio.on_loss", "\"hold\", \"off\", 0 or 1", 8},
    {"on_loss_of_an_output", output("line = \"LAMP\", on_loss = 1"), "point[6].gpio.on_loss", "is for inputs", 8},
    {"on_stop_of_an_input", input("line = \"DOOR\", on_stop = 1"), "point[6].gpio.on_stop", "is for outputs", 8},
    {"on_stop_hold", output("line = \"LAMP\", on_stop = \"hold\""), "point[6].gpio.on_stop", "must be \"off\", 0 or 1", 8},
    {"word", kBank + point("p", "input", "bank = \"board\", line = \"DOOR\"", "type = \"word\"\n"), "point[6].gpio", "a line is a bit, but the point is a word", 9},
    {"two_points_on_a_line", input("line = \"DOOR\"") + point("q", "output", "bank = \"board\", line = \"DOOR\""), "point[7].gpio.line",
     "point \"p\" has line DOOR of \"board\" already", 12},
    {"two_points_on_an_offset", input("offset = 3") + point("q", "input", "bank = \"board\", offset = 3"), "point[7].gpio.offset", "point \"p\" has line 3", 12},
    {"point_on_the_watchdog", kBank + "watchdog = { line = \"WD\" }\n" + point("p", "output", "bank = \"board\", line = \"WD\""), "point[6].gpio.line", "is the watchdog of \"board\"", 9},
    {"two_buses", "[[modbus]]\nname = \"io\"\nhost = \"h\"\n[[point]]\nname = \"m\"\ndirection = \"input\"\nmodbus = { link = \"io\", table = \"coil\", address = 0 }\n" +
                      kBank + "watchdog = { line = \"WD\" }\n" + point("p", "input", "bank = \"board\", line = \"DOOR\"") + "modbus = { link = \"io\", table = \"coil\", address = 1 }\n", "point[7].gpio", "is a second bus: modbus", 16},
    {"probe_no_signal", input("line = \"P\", probe = { edge = \"rising\" }"), "point[6].gpio.probe.skip_signal", "is missing", 8},
    {"probe_signal", input("line = \"P\", probe = { skip_signal = 9 }"), "point[6].gpio.probe.skip_signal", "from 1 to 8", 8},
    {"probe_edge", input("line = \"P\", probe = { skip_signal = 1, edge = \"both\" }"), "point[6].gpio.probe.edge", "must be \"rising\" or \"falling\", not \"both\"", 8},
    {"probe_system", input("line = \"P\", probe = { skip_signal = 1, system = 2 }"), "point[6].gpio.probe.system", "1", 8},
    {"probe_of_an_output", output("line = \"P\", probe = { skip_signal = 1 }"), "point[6].gpio.probe", "is for inputs", 8},
    {"probe_debounce", input("line = \"P\", debounce_ms = 201, probe = { skip_signal = 1 }"), "point[6].gpio.debounce_ms", "of a probe is at most 200", 8},
    {"encoder_of_a_bit", input("encoder = { a = \"A\", b = \"B\" }"), "point[6].gpio", "an encoder is an input that is a word", 8},
    {"encoder_one_line", kBank + point("p", "input", "bank = \"board\", encoder = { a = \"A\" }", "type = \"word\"\n"), "point[6].gpio.encoder.b", "is missing", 9},
    {"encoder_same_lines", kBank + point("p", "input", "bank = \"board\", encoder = { a = \"A\", b = \"A\" }", "type = \"word\"\n"), "point[6].gpio.encoder.b", "is line a", 9},
    {"encoder_counts", kBank + point("p", "input", "bank = \"board\", encoder = { a = \"A\", b = \"B\", counts = 3 }", "type = \"word\"\n"), "point[6].gpio.encoder.counts", "1, 2 or 4", 9},
    {"encoder_bits", kBank + point("p", "input", "bank = \"board\", encoder = { a = \"A\", b = \"B\", bits = 24 }", "type = \"word\"\n"), "point[6].gpio.encoder.bits", "16 or 32", 9},
    {"encoder_beside_line", kBank + point("p", "input", "bank = \"board\", line = \"C\", encoder = { a = \"A\", b = \"B\" }", "type = \"word\"\n"), "point[6].gpio.line", "no meaning beside encoder", 9},
    {"encoder_on_loss", kBank + point("p", "input", "bank = \"board\", on_loss = 1, encoder = { a = \"A\", b = \"B\" }", "type = \"word\"\n"), "point[6].gpio.on_loss", "no meaning for an encoder", 9},
    {"encoder_on_a_line", input("line = \"A\"") + point("q", "input", "bank = \"board\", encoder = { a = \"A\", b = \"B\" }", "type = \"word\"\n"), "point[7].gpio.encoder.a", "point \"p\" has line A of \"board\" already", 13},
    {"line_of_an_encoder", kBank + point("p", "input", "bank = \"board\", encoder = { a = \"A\", b = \"B\" }", "type = \"word\"\n") + point("q", "input", "bank = \"board\", line = \"B\""), "point[7].gpio.line",
     "point \"p\" has line B", 13},
    {"not_a_table", kBank + "watchdog = { line = \"WD\" }\n[[point]]\nname = \"p\"\ndirection = \"input\"\ngpio = \"DOOR\"\n", "point[6].gpio", "must be a table", 9},
};

INSTANTIATE_TEST_SUITE_P(All, GpioMistakes, testing::ValuesIn(kMistakes), [](const auto& parameter) { return std::string(parameter.param.name); });

}  // namespace
