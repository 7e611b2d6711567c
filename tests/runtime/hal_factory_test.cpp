// SPDX-License-Identifier: Apache-2.0
// Each kind of machine and of point bus is a row of a table: it is found by its name, and made from the shortest section that is allowed.
#include "runtime/hal_factory.hpp"

#include <gtest/gtest.h>

#include <map>

#include "hal/modbus/link.hpp"
#include "hal/sim/sim_machine.hpp"
#include "runtime/config_sections.hpp"
#include "test_config.hpp"

namespace {

using nc::rt::BusReport;
using nc::rt::Config;
using nc::rt::ErrorList;
using nc::rt::MachineKind;
using nc::rt::MadeMachine;
using nc::rt::PlaceOnBus;
using nc::rt::PointBusConfig;
using nc::rt::PointBusKind;
using nc::rt::TableReader;

// The shortest configuration of one bus of each kind. A new row of the table needs its own here.
const std::map<std::string_view, std::string> kLeastBus = {
    {"modbus",
     "[[modbus]]\nname = \"io\"\nhost = \"127.0.0.1\"\n"
     "[[point]]\nname = \"valve\"\ndirection = \"output\"\nmodbus = { link = \"io\", table = \"coil\", address = 0 }\n"},
    {"gpio",
     "[[gpio]]\nname = \"board\"\nchip = \"pinctrl\"\n"
     "[[point]]\nname = \"valve\"\ndirection = \"output\"\ngpio = { bank = \"board\", line = \"VALVE\" }\n"},
    {"can_io",
     "[[can_io]]\nname = \"io\"\nnode = 10\n"
     "[[point]]\nname = \"valve\"\ndirection = \"output\"\ncan_io = { module = \"io\", digital = 1 }\n"},
};

// The shortest configuration of each kind of machine, without its name.
const std::map<std::string_view, std::string> kLeastMachine = {
    {"sim", ""},
    {"canopen",
     "[canopen]\ninterface = \"can0\"\nsync_us = 2000\n"
     "[[canopen.drive]]\nnode = 1\naxis = [{ name = \"X\", encoder = 10000, pitch = 10.0 }]\n"
     "[[canopen.drive]]\nnode = 2\naxis = [{ name = \"Y\", encoder = 10000, pitch = 10.0 }]\n"
     "[[canopen.drive]]\nnode = 3\naxis = [{ name = \"Z\", encoder = 10000, pitch = 10.0 }]\n"},
};

std::string with_hal(const std::string& name) {
  std::string text = nc::test::base_toml();
  return text.insert(text.find('\n') + 1, "hal = \"" + name + "\"\n");
}

TEST(HalFactory, EachMachineIsMadeFromALeastConfiguration) {
  for (const MachineKind& kind : nc::rt::machine_kinds()) {
    if (kind.make == nullptr) continue;
    ASSERT_TRUE(kLeastMachine.contains(kind.name)) << kind.name;
    const Config config = nc::test::parse_or_fail(with_hal(std::string(kind.name)) + kLeastMachine.at(kind.name));
    ASSERT_EQ(config.machine_kind, &kind);
    EXPECT_NE(nc::rt::make_axes(config), nullptr) << kind.name;
  }
}

TEST(HalFactory, EachBusIsMadeFromALeastConfiguration) {
  for (const PointBusKind& kind : nc::rt::point_bus_kinds()) {
    if (kind.make == nullptr) continue;
    ASSERT_TRUE(kLeastBus.contains(kind.name)) << kind.name;
    // A module is on the line of a machine of drives.
    const std::string machine_text = kind.name == "can_io" ? with_hal("canopen") + kLeastMachine.at("canopen") : nc::test::base_toml();
    const Config config = nc::test::parse_or_fail(machine_text + kLeastBus.at(kind.name));
    ASSERT_EQ(config.buses.size(), 1u);
    EXPECT_EQ(config.buses[0].kind, &kind);
    EXPECT_EQ(config.points.find(config.buses[0].name + ".ok"), static_cast<int>(config.buses[0].ok_point));
    EXPECT_EQ(config.points.at(static_cast<unsigned>(config.points.find("valve"))).bus, 1);
    const MadeMachine machine = nc::rt::make_machine(config, {});
    ASSERT_EQ(machine.buses.size(), 1u);
    EXPECT_NE(machine.buses[0], nullptr);
    EXPECT_NE(machine.hal, nullptr);
  }
}

TEST(HalFactory, AConfigurationThatNamesNoMachineHasTheFirst) {
  const Config config = nc::test::parse_or_fail(nc::test::base_toml());
  EXPECT_EQ(config.machine_kind, &nc::rt::machine_kinds().front());
  EXPECT_NE(dynamic_cast<nc::hal::SimMachine*>(nc::rt::make_axes(config).get()), nullptr);
}

TEST(HalFactory, TheNamesOfARowAreItsOwn) {
  std::map<std::string_view, int> names, machines;
  for (const MachineKind& kind : nc::rt::machine_kinds()) EXPECT_EQ(machines[kind.name]++, 0) << kind.name;
  for (const PointBusKind& kind : nc::rt::point_bus_kinds()) EXPECT_EQ(names[kind.name]++, 0) << kind.name;
}

std::vector<std::string> errors_of(const std::string& text) {
  Config config;
  std::vector<std::string> texts;
  for (const auto& error : nc::rt::parse_config(text, "machine.toml", &config)) texts.push_back(error.text());
  return texts;
}

TEST(HalFactory, AnUnknownMachineIsRefusedWithItsLine) {
  const auto errors = errors_of(with_hal("ethercat"));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0], "machine.toml:2: machine.hal: must be \"sim\", \"canopen\", not \"ethercat\"; no other machine is built in");
}

TEST(HalFactory, AnUnknownBusIsRefusedWithItsLineAndThoseThatThereAre) {
  const auto errors = errors_of("[[profibus]]\nname = \"io\"\n" + nc::test::base_toml());
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].rfind("machine.toml:1: profibus: unknown key (known here: ", 0), 0u) << errors[0];
  EXPECT_NE(errors[0].find("modbus"), std::string::npos) << errors[0];
}

TEST(HalFactory, APointOnAnUnknownBusIsRefusedWithItsLine) {
  const auto errors = errors_of(nc::test::base_toml() + "[[point]]\nname = \"p\"\ndirection = \"input\"\nprofibus = { slot = 1 }\n");
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].find("point[6].profibus: unknown key (known here: "), std::string::npos) << errors[0];
  EXPECT_NE(errors[0].find("modbus"), std::string::npos) << errors[0];
}

// ---- rows of a build that lacks a library, and of two buses ----

void read_nothing(TableReader* root, Config*) { (void)root->find("second"); }
PlaceOnBus on_bus_two(TableReader*, const nc::hal::Point&, Config*) {
  return {2, [](Config*) {}};
}
std::unique_ptr<nc::hal::PointBus> make_nothing(const Config&, const PointBusConfig&, nc::hal::Hal*, const BusReport&) { return nullptr; }

constexpr MachineKind kMachines[] = {
    {.name = "sim", .needs = "", .read = nullptr, .make = [](const Config&) { return std::unique_ptr<nc::hal::Hal>(); }, .resources = nullptr, .no_virtual_time = ""},
    {.name = "drives", .needs = "libdrives", .read = nullptr, .make = nullptr, .resources = nullptr, .no_virtual_time = ""},
};
constexpr PointBusKind kBuses[] = {
    {.name = "first", .needs = "", .read = read_nothing, .read_point = on_bus_two, .check = nullptr, .resources = nullptr, .make = make_nothing, .on_virtual_time = ""},
    {.name = "second", .needs = "", .read = read_nothing, .read_point = on_bus_two, .check = nullptr, .resources = nullptr, .make = make_nothing, .on_virtual_time = ""},
    {.name = "lines", .needs = "liblines", .read = nullptr, .read_point = nullptr, .check = nullptr, .resources = nullptr, .make = nullptr, .on_virtual_time = ""},
};

// The errors that `read` reports about one table.
template <class Read>
std::string said(const std::string& toml, Read read) {
  ErrorList errors("machine.toml");
  const toml::table table = toml::parse(toml);
  TableReader reader(table, "point[1]", &errors);
  read(&reader);
  std::string text;
  for (const auto& error : errors.take()) text += error.text() + "\n";
  return text;
}

TEST(HalFactory, AMachineWithoutItsLibraryIsRefusedWithWhatItNeeds) {
  Config config;
  const std::string text = said("\nhal = \"drives\"", [&](TableReader* reader) { nc::rt::read_machine_kind(reader, kMachines, &config); });
  EXPECT_EQ(text, "machine.toml:2: point[1].hal: \"drives\" is not built in, it needs libdrives; built in: \"sim\"\n");
  EXPECT_EQ(config.machine_kind, &kMachines[0]);
}

TEST(HalFactory, ABusWithoutItsLibraryIsRefusedWithWhatItNeeds) {
  const std::string missing = "\"lines\" is not built in, it needs liblines; built in: \"first\", \"second\"\n";
  Config config;
  EXPECT_EQ(said("[[lines]]\n", [&](TableReader* reader) { nc::rt::read_point_buses(reader, kBuses, &config); }), "machine.toml:1: point[1].lines: " + missing);
  EXPECT_EQ(said("lines = {}\n", [&](TableReader* reader) { EXPECT_EQ(nc::rt::read_place_on_bus(reader, kBuses, {}, &config).bus, 0); }),
            "machine.toml:1: point[1].lines: " + missing);
}

TEST(HalFactory, APointIsOnOneBus) {
  Config config;
  EXPECT_EQ(said("second = {}\n", [&](TableReader* reader) { EXPECT_EQ(nc::rt::read_place_on_bus(reader, kBuses, {}, &config).bus, 2); }), "");
  EXPECT_EQ(said("first = {}\nsecond = {}\n", [&](TableReader* reader) { nc::rt::read_place_on_bus(reader, kBuses, {}, &config); }),
            "machine.toml:2: point[1].second: is a second bus: first carries this point already\n");
}

// ---- outputs that hold ----

struct SlowBus final : nc::hal::PointBus {
  explicit SlowBus(unsigned looks) : looks_(looks) {}
  bool start(const nc::hal::PointImage&, std::string*) override { return true; }
  void read(nc::hal::PointImage*) noexcept override {}
  void write(const nc::hal::PointImage&) noexcept override {}
  bool held_outputs_known() const override { return asked++ >= looks_; }
  void stop() noexcept override {}
  mutable unsigned asked = 0;

 private:
  const unsigned looks_;
};

TEST(HalFactory, HeldOutputsAreWaitedForUntilTheyAreKnown) {
  MadeMachine machine;
  machine.buses.push_back(std::make_unique<SlowBus>(3));
  nc::rt::wait_for_held_outputs(machine, [] { return false; });
  EXPECT_EQ(static_cast<SlowBus&>(*machine.buses[0]).asked, 4u);
}

TEST(HalFactory, HeldOutputsAreNotWaitedForBehindASignal) {
  MadeMachine machine;
  machine.buses.push_back(std::make_unique<SlowBus>(~0u));
  unsigned asked = 0;
  nc::rt::wait_for_held_outputs(machine, [&] { return ++asked == 2; });
  EXPECT_EQ(asked, 2u);
}

TEST(HalFactory, AModbusLinkKnowsItsHeldOutputsWhenItHasNone) {
  const Config config = nc::test::parse_or_fail(nc::test::base_toml() + kLeastBus.at("modbus"));
  EXPECT_TRUE(nc::rt::make_machine(config, {}).buses[0]->held_outputs_known());
  std::string holds = kLeastBus.at("modbus");
  holds.insert(holds.find(" }"), ", on_stop = \"hold\"");
  EXPECT_FALSE(nc::rt::make_machine(nc::test::parse_or_fail(nc::test::base_toml() + holds), {}).buses[0]->held_outputs_known());
}

}  // namespace
