// SPDX-License-Identifier: Apache-2.0
// Every pair of keys that can name a point names the same one: it is an error with both lines, or it is allowed, as the table in docs/connecting-a-machine.md says.
#include "runtime/point_uses.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "places/places.hpp"
#include "test_config.hpp"

namespace {

using nc::rt::Config;
using nc::rt::ConfigError;

struct Key {
  const char* name;
  const char* type;
  const char* direction;
};

// A machine with drives on a bus. X and Y are homed by their drives, Z and A by dogs one after the other, B with Z, and U by a limit switch; each key names a point of its own.
constexpr Key kKeys[] = {{"macro_out", "bit", "output"},  {"macro_out2", "bit", "output"}, {"signal_out", "bit", "output"}, {"signal_out2", "bit", "output"}, {"brake_z", "bit", "output"},
                         {"brake_a", "bit", "output"},    {"home_x", "bit", "output"},     {"home_y", "bit", "output"},     {"forward1", "bit", "output"},    {"backward1", "bit", "output"},
                         {"orient1", "bit", "output"},    {"forward2", "bit", "output"},   {"backward2", "bit", "output"},  {"x_homed", "bit", "input"},      {"y_homed", "bit", "input"},
                         {"oriented1", "bit", "input"},   {"dog_z", "bit", "input"},       {"dog_a", "bit", "input"},       {"dog_b", "bit", "input"},        {"index_z", "bit", "input"},
                         {"index_a", "bit", "input"},     {"minus_x", "bit", "input"},     {"plus_x", "bit", "input"},      {"minus_y", "bit", "input"},      {"plus_u", "bit", "input"},
                         {"macro_in", "bit", "input"},    {"signal_in", "bit", "input"},   {"signal_in2", "bit", "input"},  {"times10", "bit", "input"},      {"times100", "bit", "input"},
                         {"times100_2", "bit", "input"},  {"grip", "bit", "input"},        {"count1", "word", "input"},     {"count2", "word", "input"},      {"stick_x", "word", "input"},
                         {"stick_y", "word", "input"}};

std::string text_of(const std::function<std::string(const std::string&)>& point) {
  std::ostringstream text;
  text << "[machine]\nname = \"uses\"\nhal = \"canopen\"\nspindles = [2]\n";
  const auto axis = [&](const char* name, const std::string& rest) {
    text << "[[axis]]\nname = \"" << name << "\"\nmax_velocity = 100.0\nmax_acceleration = 1000.0\nsoft_limits = [-100.0, 1.0]\n" << rest << "\n";
  };
  const auto p = [&](const char* key) { return "\"" + point(key) + "\""; };
  const auto searched = [&](const char* dog, const std::string& more) { return "homing = { kind = \"switch\", direction = \"+\", fast = 10.0, creep = 1.0, dog = " + p(dog) + more + " }\n"; };
  axis("X", "homing = { kind = \"drive\", request = " + p("home_x") + ", done = " + p("x_homed") + " }\nlimit_switches = { minus = " + p("minus_x") + ", plus = " + p("plus_x") + " }");
  axis("Y", "homing = { kind = \"drive\", request = " + p("home_y") + ", done = " + p("y_homed") + " }\nlimit_switches = { minus = " + p("minus_y") + " }");
  axis("Z", searched("dog_z", ", order = 1, index_travel = 5.0, index = " + p("index_z")) + "brake = { point = " + p("brake_z") + " }");
  axis("A", searched("dog_a", ", order = 2, index_travel = 5.0, index = " + p("index_a")) + "brake = { point = " + p("brake_a") + " }");
  axis("B", searched("dog_b", ", order = 1"));
  axis("U", "homing = { kind = \"limit\", direction = \"+\", fast = 10.0, creep = 1.0 }\nlimit_switches = { plus = " + p("plus_u") + " }");
  for (const Key& key : kKeys) text << "[[point]]\nname = \"" << key.name << "\"\ntype = \"" << key.type << "\"\ndirection = \"" << key.direction << "\"\n";
  text << "[macro_interface]\n\"#1000\" = " << p("macro_in") << "\n\"#1100\" = " << p("macro_out") << "\n\"#1101\" = " << p("macro_out2") << "\n";
  text << "[signals]\n\"nc.alarm\" = " << p("signal_out") << "\n\"nc.ready\" = " << p("signal_out2") << "\n\"plc.feed_hold_n\" = " << p("signal_in") << "\n\"plc.interlock_n\" = " << p("signal_in2") << "\n";
  text << "[[handwheel]]\ncounter = " << p("count1") << "\ntimes_10 = " << p("times10") << "\ntimes_100 = " << p("times100") << "\naxes = {}\n";
  text << "[[handwheel]]\ncounter = " << p("count2") << "\ntimes_100 = " << p("times100_2") << "\naxes = {}\n";
  for (const auto& [letter, stick] : {std::pair{"X", "stick_x"}, std::pair{"Y", "stick_y"}})
    text << "[[joystick]]\naxis = \"" << letter << "\"\ninput = " << p(stick) << "\nlow = 0\nmiddle = 50\nhigh = 100\ntop_speed = 10.0\ndead_man = " << p("grip") << "\n";
  text << "[canopen]\ninterface = \"can0\"\nsync_us = 10000\n";
  unsigned node = 0;
  for (const char* const letter : {"X", "Y", "Z", "A", "B", "U"}) {
    text << "[[canopen.drive]]\nnode = " << ++node << "\n[[canopen.drive.axis]]\nname = \"" << letter << "\"\nencoder = 4096\npitch = 5.0\n";
    const std::string lower(1, static_cast<char>(letter[0] + 32));
    if (node <= 2) text << "homing = { method = 17, fast = 10.0, slow = 1.0, acceleration = 50.0, request = " << p(("home_" + lower).c_str()) << ", done = " << p((lower + "_homed").c_str()) << " }\n";
  }
  for (const char* const number : {"1", "2"}) {
    const std::string forward = std::string("forward") + number, backward = std::string("backward") + number;
    text << "[[canopen.drive]]\nnode = " << ++node << "\n[[canopen.drive.spindle]]\nnumber = " << number << "\nencoder = 4096\nmax_rpm = 3000.0\nacceleration = 3000.0\nforward = " << p(forward.c_str())
         << "\nbackward = " << p(backward.c_str()) << "\n";
    if (node == 7) text << "orient = { request = " << p("orient1") << ", done = " << p("oriented1") << " }\n";
  }
  return text.str();
}

std::vector<ConfigError> errors_of(const std::string& text, Config* config = nullptr) {
  Config own;
  return nc::rt::parse_config(text, "uses.toml", config != nullptr ? config : &own);
}

std::string all_of(const std::vector<ConfigError>& errors) {
  std::string text;
  for (const ConfigError& error : errors) text += error.text() + "\n";
  return text;
}

using Pair = std::set<std::string>;

// The pairs of outputs that are allowed: what is set by a program or a signal may start or turn several things of one kind, and homes of drives are started by their axes too, so
// that those of two axes would be two that set it.
bool outputs_may(const std::string& one, const std::string& other) {
  const auto setter = [](const std::string& key) { return key.starts_with("macro_out") || key.starts_with("signal_out"); };
  const auto turns = [](const std::string& key) { return key.starts_with("forward") || key.starts_with("backward"); };
  const auto obeys = [&](const std::string& key) { return turns(key) || key == "orient1"; };
  if (setter(one) || setter(other)) return obeys(one) || obeys(other);
  return turns(one) && turns(other) && one.back() != other.back();
}

// The pairs of inputs that are not.
bool inputs_may(const std::string& one, const std::string& other) {
  static const std::set<std::string> kReports = {"x_homed", "y_homed", "oriented1"}, kSwitches = {"dog_z", "dog_a", "dog_b", "index_z", "index_a", "minus_x", "plus_x", "minus_y", "plus_u"};
  const auto both = [&](const std::set<std::string>& set) { return set.contains(one) && set.contains(other); };
  const Pair pair = {one, other};
  if (both(kReports)) return false;
  if ((kReports.contains(one) && kSwitches.contains(other)) || (kReports.contains(other) && kSwitches.contains(one))) return false;
  if (both(kSwitches)) {
    static const std::set<Pair> kAllowed = {{"dog_z", "dog_a"}, {"dog_a", "dog_b"}, {"index_z", "index_a"}, {"dog_z", "index_a"}, {"dog_a", "index_z"}, {"dog_b", "index_a"}, {"minus_x", "minus_y"}, {"plus_x", "minus_y"}};
    return kAllowed.contains(pair);
  }
  if (pair == Pair{"times10", "times100"}) return false;
  const std::set<std::string> words = {"count1", "count2", "stick_x", "stick_y"};
  return !both(words) || pair == Pair{"stick_x", "stick_y"};
}

TEST(PointUses, EachKeyHasItsOwnPointAndNothingIsWrong) {
  Config config;
  EXPECT_EQ(all_of(errors_of(text_of([](const std::string& key) { return key; }), &config)), "");
  std::set<nc::rt::PointRole> roles;
  for (const nc::rt::PointUse& use : config.point_uses) {
    roles.insert(use.role);
    EXPECT_GE(use.place.line, 1u);
    EXPECT_FALSE(use.place.key.empty());
  }
  EXPECT_GE(roles.size(), 18u) << "all but the simulated ones, gears and measured speeds";
}

TEST(PointUses, EveryPairIsAllowedOrNamesBothLines) {
  unsigned pairs = 0, refused = 0;
  for (const Key& one : kKeys) {
    for (const Key& other : kKeys) {
      if (one.name == other.name || std::string(one.type) != other.type || std::string(one.direction) != other.direction) continue;
      ++pairs;
      const std::string text = text_of([&](const std::string& key) { return key == other.name ? std::string(one.name) : key; });
      const std::vector<ConfigError> errors = errors_of(text);
      const bool may = std::string(one.direction) == "output" ? outputs_may(one.name, other.name) : inputs_may(one.name, other.name);
      refused += may ? 0u : 1u;
      EXPECT_EQ(errors.empty(), may) << one.name << " is also " << other.name << "\n" << all_of(errors);
      for (const ConfigError& error : errors) {
        EXPECT_GE(error.line, 1u);
        const std::size_t at = error.message.find(", first in line ");
        if (at == std::string::npos) {
          EXPECT_NE(error.message.find(", also in this line as "), std::string::npos) << error.text();
        } else {
          EXPECT_LT(std::stoul(error.message.substr(at + 16)), error.line) << error.text();
        }
        EXPECT_NE(error.message.find(std::string("point \"") + one.name + "\" "), std::string::npos) << error.text();
      }
    }
  }
  EXPECT_GT(pairs, 500u);
  EXPECT_GT(refused, 200u);
}

// What is not one point, though nothing connects two: the axis would ask, and its drive would never hear of it.
TEST(PointUses, TheDriveHearsItsAxis) {
  std::string text = text_of([](const std::string& key) { return key; });
  const std::size_t drive = text.find("request = \"home_x\"", text.find("method = 17"));
  text.replace(drive, 18, "request = \"macro_out\"");
  const std::string all = all_of(errors_of(text));
  EXPECT_NE(all.find("canopen.drive[1].axis[1].homing.request: the homing request of axis X and the start of homing of the drive of axis X must be one point: without a ladder program nothing connects two, first in line "), std::string::npos) << all;
  EXPECT_EQ(all_of(errors_of(text + "[ladder]\nprogram = \"x.il\"\n")).find("must be one point"), std::string::npos);
}

// An axis that its drive homes, and a drive that does not: the request goes nowhere, unless a bus or the ladder program takes it on.
TEST(PointUses, SomeDriveHearsTheAxis) {
  std::string text = text_of([](const std::string& key) { return key; });
  const std::size_t from = text.find("homing = ", text.find("[[canopen.drive.axis]]")), to = text.find('\n', from);
  text.erase(from, to - from);
  const std::string all = all_of(errors_of(text));
  EXPECT_NE(all.find("axis[1].homing.request: the homing request of axis X goes nowhere: its [[canopen.drive.axis]] has no homing, and point \"home_x\" is on no bus"), std::string::npos) << all;
  EXPECT_NE(all.find("axis[1].homing.done: the end of homing of axis X comes from nowhere: its [[canopen.drive.axis]] has no homing, and point \"x_homed\" is on no bus"), std::string::npos) << all;
  EXPECT_EQ(all.find("axis Y"), std::string::npos) << all;
  EXPECT_EQ(all_of(errors_of(text + "[ladder]\nprogram = \"x.il\"\n")).find("nowhere"), std::string::npos);
}

// A brake, or a request of homing, that the ladder program writes would get another value in the same scan.
TEST(PointUses, WhatIsSetForAnAxisIsNotForTheLadder) {
  Config config;
  ASSERT_EQ(all_of(errors_of(text_of([](const std::string& key) { return key; }), &config)), "");
  for (const Key& key : kKeys) {
    const auto point = static_cast<unsigned>(config.points.find(key.name));
    const std::string name = key.name;
    EXPECT_EQ(config.is_set_for_axis(point), name == "brake_z" || name == "brake_a" || name == "home_x" || name == "home_y") << name;
  }
}

// The table of the document is this one.
TEST(PointUses, TheDocumentHasTheRows) {
  std::ifstream stream(nc::test::kSourceDir + "/docs/connecting-a-machine.md");
  std::ostringstream document;
  document << stream.rdbuf();
  constexpr const char* kWays[] = {"sets an output", "obeys an output", "gives an input", "goes by an input"};
  std::string table = "| key | what it is | of a point that is this, other uses |\n| --- | --- | --- |\n";
  for (const nc::rt::PointRoleRow& row : nc::rt::point_roles()) table += std::string("| ") + row.keys + " | " + kWays[static_cast<unsigned>(row.way)] + " | " + row.other + " |\n";
  EXPECT_NE(document.str().find(table), std::string::npos) << "docs/connecting-a-machine.md wants:\n" << table;
}

}  // namespace
