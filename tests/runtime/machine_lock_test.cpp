// SPDX-License-Identifier: Apache-2.0
// The resources of which a machine consists, and that only one lock at a time has them.
#include "runtime/machine_lock.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "has_bus.hpp"
#include "test_config.hpp"

namespace {

namespace fs = std::filesystem;
using nc::rt::Config;
using nc::rt::machine_resources;
using nc::rt::MachineLock;
using nc::rt::MachineResource;

class Folder : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/nc-lock-XXXXXX";
    ASSERT_NE(mkdtemp(name), nullptr);
    folder_ = name;
  }
  void TearDown() override { fs::remove_all(folder_); }
  // Writes a configuration; if a host is named it has a Modbus link to that unit.
  std::string write(const std::string& name, const std::string& host = "", unsigned unit = 1, const char* direction = "output") {
    std::string text = nc::test::base_toml();
    if (!host.empty())
      text += "[[modbus]]\nname = \"io\"\nhost = \"" + host + "\"\nport = 5020\nunit = " + std::to_string(unit) +
              "\n[[point]]\nname = \"valve\"\ndirection = \"" + direction +
              "\"\nmodbus = { link = \"io\", table = \"coil\", address = 0 }\n";
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  static Config load(const std::string& path) {
    Config config;
    const auto errors = nc::rt::load_config(path, &config);
    for (const auto& error : errors) ADD_FAILURE() << error.text();
    return config;
  }
  static bool can_run_beside(const Config& one, const Config& other, std::string* error) {
    MachineLock first, second;
    EXPECT_TRUE(first.take(machine_resources(one, true), error)) << *error;
    return second.take(machine_resources(other, true), error);
  }
  fs::path folder_;
};

// This is true for inputs, too: the kernel gives a line to one owner only.
TEST_F(Folder, EachLineOfAChipBelongsToOneControl) {
  if (!nc::test::has_bus("gpio")) GTEST_SKIP() << "built without libgpiod";
  const auto with_line = [&](const std::string& name, const std::string& chip, const std::string& line) {
    std::ofstream(folder_ / name) << nc::test::base_toml() << "[[gpio]]\nname = \"io\"\nchip = \"" << chip << "\"\nwatchdog = { line = \"WD " << name
                                  << "\" }\n[[point]]\nname = \"door\"\ndirection = \"input\"\ngpio = { bank = \"io\", " << line << " }\n";
    return load(folder_ / name);
  };
  const Config one = with_line("a.toml", "pinctrl", "line = \"DOOR\"");
  std::string error;
  EXPECT_FALSE(can_run_beside(one, with_line("b.toml", "pinctrl", "line = \"DOOR\""), &error));
  EXPECT_NE(error.find("GPIO line DOOR of chip pinctrl"), std::string::npos) << error;
  EXPECT_FALSE(can_run_beside(one, with_line("b.toml", "pinctrl", "line = \"WD a.toml\""), &error));
  EXPECT_TRUE(can_run_beside(one, with_line("b.toml", "pinctrl", "line = \"STOP\""), &error)) << error;
  EXPECT_TRUE(can_run_beside(one, with_line("b.toml", "expander", "line = \"DOOR\""), &error)) << error;
  EXPECT_TRUE(can_run_beside(with_line("a.toml", "pinctrl", "offset = 1"), with_line("b.toml", "pinctrl", "offset = 2"), &error)) << error;
}

TEST_F(Folder, OneFileIsOneMachineUnderEveryName) {
  const std::string path = write("a.toml");
  fs::create_symlink(path, folder_ / "link.toml");
  fs::create_hard_link(path, folder_ / "hard.toml");
  std::string error;
  for (const char* name : {"a.toml", "link.toml", "hard.toml", "../" /* and back, below */}) {
    const std::string other = std::string(name) == "../" ? folder_ / ".." / folder_.filename() / "a.toml" : folder_ / name;
    error.clear();
    EXPECT_FALSE(can_run_beside(load(path), load(other), &error)) << other;
    EXPECT_NE(error.find("process " + std::to_string(getpid())), std::string::npos) << error;
    EXPECT_NE(error.find("configuration"), std::string::npos) << error;
  }
  const std::string other = write("b.toml");
  EXPECT_TRUE(can_run_beside(load(path), load(other), &error)) << error;
}

// A new file under the old name, as an editor may write it, is still the same machine.
TEST_F(Folder, AFileThatWasReplacedIsTheSameMachine) {
  const std::string path = write("a.toml");
  const Config before = load(path);
  std::string error;
  MachineLock first, second;
  ASSERT_TRUE(first.take(machine_resources(before, true), &error)) << error;
  fs::rename(write("new.toml"), path);
  EXPECT_FALSE(second.take(machine_resources(load(path), true), &error));
}

TEST_F(Folder, OneModbusUnitIsOneMachineInEverySpelling) {
  const Config one = load(write("a.toml", "127.0.0.1"));
  std::string error;
  for (const char* host : {"127.0.0.1", "::ffff:127.0.0.1", "127.1", "0x7f000001"}) {
    error.clear();
    EXPECT_FALSE(can_run_beside(one, load(write("b.toml", host)), &error)) << host;
    EXPECT_NE(error.find("Modbus unit 1 of "), std::string::npos) << error;
  }
  EXPECT_TRUE(can_run_beside(one, load(write("c.toml", "127.0.0.1", 2)), &error)) << error;
  EXPECT_TRUE(can_run_beside(one, load(write("d.toml", "127.0.0.2")), &error)) << error;
  EXPECT_TRUE(can_run_beside(one, load(write("e.toml", "127.0.0.1", 1, "input")), &error)) << "who only reads: " << error;
}

TEST_F(Folder, OneFileOfRetainedDataIsOneMachine) {
  Config one = load(write("a.toml")), other = load(write("b.toml"));
  one.variables = "kept.variables";
  other.variables = (folder_ / "." / "kept.variables").string();
  std::string error;
  EXPECT_FALSE(can_run_beside(one, other, &error));
  EXPECT_NE(error.find("retained data"), std::string::npos) << error;
  // A control on virtual time does not use the devices, so it does not lock them.
  MachineLock first, second;
  EXPECT_TRUE(first.take(machine_resources(one, true), &error)) << error;
  EXPECT_TRUE(second.take(machine_resources(other, false), &error)) << error;
}

// A lock that is refused gives back the resources that it had already taken.
TEST_F(Folder, AllOrNothing) {
  const std::vector<MachineResource> common = {{"test " + folder_.string() + " 2", "two"}};
  std::vector<MachineResource> more = {{"test " + folder_.string() + " 1", "one"}, common[0]};
  std::string error;
  MachineLock first, second, third;
  ASSERT_TRUE(first.take(common, &error)) << error;
  EXPECT_FALSE(second.take(more, &error));
  EXPECT_TRUE(third.take({more[0]}, &error)) << error;
  first.release();
  third.release();
  EXPECT_TRUE(second.take(more, &error)) << error;
}

TEST_F(Folder, TheFileItselfIsUnderALock) {
  const std::string path = write("a.toml");
  std::string error;
  MachineLock first, second;
  ASSERT_TRUE(first.take_file(path, &error)) << error;
  EXPECT_FALSE(second.take_file(path, &error));
  EXPECT_NE(error.find("process " + std::to_string(getpid())), std::string::npos) << error;
  first.release();
  EXPECT_TRUE(second.take_file(path, &error)) << error;
}

TEST_F(Folder, AMachineWithoutOutputsIsSimulatedAsOftenAsOneLikes) {
  std::string error;
  for (const bool with_bus : {false, true}) {
    const Config config = load(with_bus ? write("bus.toml", "127.0.0.1") : write("sim.toml"));
    MachineLock virtual_one, virtual_two, real_one, real_two;
    ASSERT_TRUE(virtual_one.take_machine(config, true, &error)) << error;
    EXPECT_EQ(virtual_two.take_machine(config, true, &error), !with_bus) << "its outputs are real on virtual time, too";
    EXPECT_EQ(real_one.take_machine(config, false, &error), !with_bus);
    EXPECT_FALSE(real_two.take_machine(config, false, &error));
    EXPECT_NE(error.find("in use"), std::string::npos) << error;
  }
}

}  // namespace
