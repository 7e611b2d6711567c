// SPDX-License-Identifier: Apache-2.0
// The trace of ncsim and the machine get the same stream of items. So what the runtime executes on the simulated machine
// must be the same, serial by serial and end point by end point, as what an offline control gives, with random overrides,
// hold and resume, single block, inputs that change in the middle of a macro, and skips. And in every scan every axis
// keeps its velocity, its acceleration and its soft limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "places/places.hpp"
#include "program_generator.hpp"
#include "support/seeds.hpp"
#include "test_config.hpp"
#include "walls_machine.hpp"
#include "walls_offline.hpp"

namespace {

using nc::test::Listing;
using nc::test::Operator;
using nc::test::Recording;

/// A twentieth of `all` under a sanitizer, half of them with NC_SHORT=1.
unsigned programs(unsigned all) {
  return static_cast<unsigned>(nc::test::seeds(all, (all + 19) / 20));
}

nc::rt::Config random_config(const std::vector<std::string>& script, std::uint32_t seed) {
  std::string text = nc::test::base_toml();
  text += "script = [";
  for (const std::string& statement : script) text += "\"" + statement + "\",\n";
  text += "]\n" + std::string(nc::test::probe_solid_toml());
  text += "[work_offsets]\nG54 = { X = 3.5, Y = -2.25, Z = 1.125 }\n[tool_offsets]\n1 = 2.5\n2 = 12.0\n";
  nc::rt::Config config = nc::test::parse_or_fail(text);
  config.nc.motion_mode = NC_MOTION_TRAPEZOID;  // the other law has a test of its own
  config.nc.look_ahead = 1024;
  if (seed % 5 == 4) config.nc.look_ahead = 64;  // the ring is full all the time
  return config;
}

Operator random_operator(std::uint32_t seed) {
  Operator op;
  op.seed = seed;
  op.overrides = (seed & 1) != 0;
  op.holds = (seed & 2) != 0;
  op.single_block = (seed & 4) != 0;
  op.optional_stop = (seed & 8) != 0;
  op.optional_skip = (seed & 16) != 0 ? 2u : (seed & 32) != 0 ? 4u : 0u;  // bit n = switch n
  return op;
}

struct Totals {
  double velocity = 0, acceleration = 0;
  std::uint64_t items = 0, scans = 0, holds = 0, stops = 0, overrides = 0, skips = 0, syncs = 0;
};

void compare(const nc::rt::Config& config, const std::string& text, const Operator& op, Totals* totals) {
  const Recording online = nc::test::run_online(config, text, op);
  const Listing offline = nc::test::pull_offline(config, text, op, online);
  EXPECT_GT(offline.items.size(), 3u);
  EXPECT_EQ(offline.alarm, "") << "line " << offline.alarm_line;  // every program here is valid
  nc::test::expect_same(online, offline, config);
  totals->velocity = std::max(totals->velocity, online.velocity_ratio);
  totals->acceleration = std::max(totals->acceleration, online.acceleration_ratio);
  totals->items += online.items.size();
  totals->scans += online.scans;
  totals->holds += online.holds;
  totals->stops += online.block_stops;
  totals->overrides += online.override_changes;
  totals->skips += offline.skips;
  totals->syncs += offline.syncs;
}

TEST(Walls, RandomProgramsExecuteAsTheyTrace) {
  Totals totals;
  const unsigned count = programs(160);
  for (std::uint32_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    nc::test::ProgramGenerator generator(seed);
    const nc::test::GeneratedProgram program = generator.make(12);
    const nc::rt::Config config = random_config(program.script, seed);
    compare(config, program.text, random_operator(seed), &totals);
    if (HasFailure()) {
      std::ofstream("walls-failed.nc") << program.text;
      FAIL() << "the program is in walls-failed.nc";
    }
  }
  std::ostringstream said;
  said << count << " programs: " << totals.items << " items, " << totals.scans << " scans, " << totals.holds
       << " holds, " << totals.stops << " block stops, " << totals.overrides << " override changes, "
       << totals.skips << " skips, " << totals.syncs << " syncs; largest velocity " << totals.velocity
       << ", acceleration " << totals.acceleration << " of the limit";
  std::puts(said.str().c_str());
  // The test would prove nothing if none of this had happened.
  EXPECT_GT(totals.holds, count / 20);
  EXPECT_GT(totals.stops, count / 20);
  EXPECT_GT(totals.overrides, count / 20);
  EXPECT_GT(totals.skips, count / 20);
  EXPECT_GT(totals.syncs, count / 20);
}

/// Adds time constants, S patterns and radius compensation; depending on the seed some axes or kinds of moves have none.
void add_time_constants(std::uint32_t seed, nc::rt::Config* config) {
  const auto set = [config](const char* key, char axis, unsigned value) {
    nc::rt::ParameterSetting parameter;
    parameter.key = key;
    parameter.axis = axis;
    parameter.text = std::to_string(value);
    config->parameters.push_back(parameter);
  };
  std::mt19937 random(seed);
  for (const char axis : {'X', 'Y', 'Z'}) {
    if (seed % 7 == 3 && axis == 'Y') continue;
    if (seed % 4 != 0) set("2007", axis, 20 + random() % 80);
    if (seed % 4 == 1) set("2008", axis, 10 + random() % 40);
    if (seed % 3 != 0) set("2004", axis, 20 + random() % 80);
    if (seed % 3 == 2) set("2005", axis, 10 + random() % 40);
    if (seed % 5 == 0) set("2102", axis, 40);
  }
  set("1568", 0, random() % 60);
  set("1569", 0, random() % 60);
  set("1570", 0, random() % 30);
  set("1206", 0, 6000);
  set("1207", 0, 100);
  if (seed % 6 == 0) set("1205", 0, 1);
  if (seed % 2 == 0) set("1148", 0, 1);
  set("8107", 0, 1);
  set("8108", 0, 1);
  config->parameters.push_back(config->parameters.back());
  config->parameters.back().key = "2069";
  config->parameters.back().text = "0.02";
}

TEST(Walls, RandomProgramsWithTimeConstantsExecuteAsTheyTrace) {
  Totals totals;
  const unsigned count = programs(40);
  for (std::uint32_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    nc::test::ProgramGenerator generator(seed + 1000);
    const nc::test::GeneratedProgram program = generator.make(6);
    nc::rt::Config config = random_config(program.script, seed);
    add_time_constants(seed, &config);
    compare(config, program.text, random_operator(seed), &totals);
    if (HasFailure()) {
      std::ofstream("walls-failed.nc") << program.text;
      FAIL() << "the program is in walls-failed.nc";
    }
  }
  EXPECT_LE(totals.velocity, 1.001);
  EXPECT_LE(totals.acceleration, 1.001);
  EXPECT_GT(totals.acceleration, 0.99);
  EXPECT_GT(totals.holds + totals.stops, count / 20);
}

TEST(Walls, RandomProgramsExecuteAsTheyTraceInTheOptimalMode) {
  Totals totals;
  // It begins with seed 3, whose operator holds and changes the override, so that even the single program under a sanitizer meets both.
  const std::uint32_t first = 3;
  const unsigned count = programs(8);
  for (std::uint32_t seed = first; seed < first + count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    nc::test::ProgramGenerator generator(seed);
    const nc::test::GeneratedProgram program = generator.make(6);
    nc::rt::Config config = random_config(program.script, seed);
    config.nc.motion_mode = NC_MOTION_OPTIMAL;
    compare(config, program.text, random_operator(seed), &totals);
    if (HasFailure()) {
      std::ofstream("walls-failed.nc") << program.text;
      FAIL() << "the program is in walls-failed.nc";
    }
  }
  EXPECT_GT(totals.holds + totals.stops, 0u);
  EXPECT_LE(totals.acceleration, 1.001);
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

TEST(Walls, ShippedPartsExecuteAsTheyTrace) {
  const std::filesystem::path root(nc::test::kSourceDir);
  const unsigned wanted = nc::test::sanitized() ? 1 : 5;  // ncrtd_offline_test.sh runs each of them under the sanitizers, too
  unsigned parts = 0;
  for (const auto& [part, machine] :
       {std::pair{"flange.nc", "machine.toml"}, {"keytag.nc", "modelling-machine.toml"}, {"plate.ngc", "router.toml"}, {"bracket.nc", "drill-mill.toml"}, {"jig-plate.s8", "knee-mill.toml"}}) {
    nc::rt::Config config;
    for (const auto& error : nc::rt::load_config((root / "etc" / machine).string(), &config))
      ADD_FAILURE() << error.text();
    const std::string text = read_file(root / "examples" / "parts" / part);
    ASSERT_FALSE(text.empty()) << part;
    if (parts == wanted) break;
    ++parts;
    for (const std::uint32_t seed : {0u, 7u}) {
      SCOPED_TRACE(std::string(part) + " seed " + std::to_string(seed));
      if (nc::test::sanitized() && seed != 7) continue;
      Totals totals;
      compare(config, text, random_operator(seed), &totals);
      EXPECT_GT(totals.items, 50u);
    }
  }
  EXPECT_EQ(parts, wanted);
}

// Real programs of other people, if they are present: they are executed as their trace says, to their end or to the
// alarm of their dialect for what it does not know.
TEST(Walls, SharedProgramsExecuteAsTheyTrace) {
  const std::filesystem::path folder = std::filesystem::path(nc::test::kSharedDir) / "programs";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << folder << " is not there";
  const nc::rt::Config config = nc::test::parse_or_fail(R"([machine]
cycle_us = 4000
[[axis]]
name = "X"
max_velocity = 250.0
max_acceleration = 2000.0
max_jerk = 50000.0
[[axis]]
name = "Y"
max_velocity = 250.0
max_acceleration = 2000.0
max_jerk = 50000.0
[[axis]]
name = "Z"
max_velocity = 250.0
max_acceleration = 2000.0
max_jerk = 50000.0
[parameters]
"1078" = 1
[sim]
tool_change_s = 0.1
)");
  unsigned programs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string ending = entry.path().extension().string();
    if ((ending != ".nc" && ending != ".ngc") || (nc::test::sanitized() && entry.file_size() > 15000)) continue;
    SCOPED_TRACE(entry.path().filename().string());
    const std::string text = read_file(entry.path());
    Operator op;
    op.max_scans = 10'000'000;
    const Recording online = nc::test::run_online(config, text, op);
    const Listing offline = nc::test::pull_offline(config, text, op, online);
    nc::test::expect_same(online, offline, config);
    ++programs;
  }
  EXPECT_GT(programs, 0u);
}

// The same in real time, with the scan and the feeder in their own threads: the timing must not change what is
// executed.
TEST(Walls, ThreadsExecuteWhatTheTraceSays) {
  for (const std::uint32_t seed : {3u, 11u}) {
    if (nc::test::sanitized() && seed != 11) continue;
    SCOPED_TRACE("seed " + std::to_string(seed));
    nc::test::ProgramGenerator generator(seed);
    const nc::test::GeneratedProgram program = generator.make(3);
    nc::rt::Config config = random_config(program.script, seed);
    config.scheduling.overrun = nc::rt::OverrunReaction::kCount;
    Operator op = random_operator(seed);
    op.overrides = false;  // wall-clock time matters here
    op.threads = true;
    Totals totals;
    compare(config, program.text, op, &totals);
  }
}

TEST(Walls, TheSameRunTwiceIsTheSame) {
  nc::test::ProgramGenerator generator(77);
  const nc::test::GeneratedProgram program = generator.make(10);
  const nc::rt::Config config = random_config(program.script, 77);
  const Operator op = random_operator(77 | 7);
  const Recording first = nc::test::run_online(config, program.text, op);
  const Recording second = nc::test::run_online(config, program.text, op);
  EXPECT_EQ(first.scans, second.scans);
  ASSERT_EQ(first.items.size(), second.items.size());
  for (std::size_t i = 0; i < first.items.size(); ++i)
    EXPECT_EQ(std::memcmp(&first.items[i].machine, &second.items[i].machine, sizeof(nc_axes)), 0);
}

}  // namespace
