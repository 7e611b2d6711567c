// SPDX-License-Identifier: Apache-2.0
// Changes of tables are taken back: by whom, when it is refused, and behind a restart.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "services/local_machine.hpp"

namespace nc::rt::services {
namespace {

using test::LocalMachine;
using test::ServiceClient;

class Undo : public LocalMachine {
 protected:
  double length(ServiceClient* client, unsigned tool) { return client->call("tools.list", {{"from", tool}, {"count", 1}})["reply"]["tools"][0]["length"]; }
  Json variable(ServiceClient* client, unsigned number) {
    const Json rows = client->call("variables.list", {{"from", number}, {"count", 1}})["reply"]["variables"];
    return rows.empty() || rows[0]["number"] != number ? Json() : rows[0]["value"];
  }
  Json newest(ServiceClient* client) { return client->call("changes", {{"count", 1}})["reply"]["changes"][0]; }
};

TEST_F(Undo, TakesBackOneChangeAfterTheOther) {
  ServiceClient client(path_);
  EXPECT_EQ(client.outcome("undo"), "not found") << "nothing has been changed";
  ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"length", 10}}), "");
  ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"length", 20}, {"radius", 5}}), "");
  ASSERT_EQ(client.outcome("variables.set", {{"number", 501}, {"value", 0.1}}), "");
  ASSERT_EQ(client.outcome("offsets.set", {{"index", 2}, {"axis", "Z"}, {"value", -7.25}}), "");
  EXPECT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(client.call("offsets.list")["reply"]["offsets"][2]["axes"][2]["value"], 0.0);
  Json change = newest(&client);
  EXPECT_EQ(change["number"], 5);
  EXPECT_EQ(change["service"], "undo");
  EXPECT_EQ(change["what"], "undo of 4: offset 2 Z of part system 1");
  EXPECT_EQ(change["before"], "-7.25");
  EXPECT_EQ(change["after"], "0");
  EXPECT_EQ(client.outcome("undo"), "");
  EXPECT_TRUE(variable(&client, 501).is_null()) << "it was vacant before";
  EXPECT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(length(&client, 3), 10) << "both columns of one request are one change";
  EXPECT_EQ(client.call("tools.list", {{"from", 3}, {"count", 1}})["reply"]["tools"][0]["radius"], 0.0);
  EXPECT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(length(&client, 3), 0);
  EXPECT_EQ(client.outcome("undo"), "not found") << "an undo is not taken back";
  const Json changes = client.call("changes")["reply"]["changes"];
  ASSERT_EQ(changes.size(), 8u);
  for (unsigned n = 0; n < 8; ++n) EXPECT_EQ(changes[n]["undone_by"], n < 4 ? 0 : n + 1) << n;
}

TEST_F(Undo, WhatWasChangedSinceStays) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"length", 10}}), "");
  ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"length", 20}}), "");
  const Json reply = client.call("undo", {{"change", 1}});
  EXPECT_EQ(reply["error"], "refused");
  EXPECT_EQ(reply["text"], "tool 3 length was changed since: it is 20, and not 10");
  EXPECT_EQ(length(&client, 3), 20);
  // A program has changed it.
  ASSERT_EQ(client.outcome("variables.set", {{"number", 501}, {"value", 1}}), "");
  ASSERT_EQ(client.outcome("control.take"), "");
  ASSERT_EQ(client.outcome("mode", {{"mode", "mdi"}}), "");
  ASSERT_EQ(client.outcome("mdi", {{"blocks", "#501=2"}}), "");
  ASSERT_EQ(client.outcome("start"), "");
  until(&client, "status", [](const Json& now) { return now["systems"][0]["runs"] == 1; });
  EXPECT_EQ(client.outcome("undo"), "refused");
  EXPECT_EQ(variable(&client, 501), 2);
  EXPECT_EQ(client.outcome("undo", {{"change", 2}}), "") << "an older one whose value stands";
  EXPECT_EQ(client.outcome("undo", {{"change", 2}}), "refused") << "once";
  EXPECT_EQ(client.outcome("undo", {{"change", 1}}), "") << "now its value is there again";
  EXPECT_EQ(client.outcome("undo", {{"change", 4}}), "refused") << "that is an undo";
  EXPECT_EQ(client.outcome("undo", {{"change", 400}}), "not found");
}

TEST_F(Undo, RefusedWhileAProgramIsInExecution) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"length", 10}}), "");
  ASSERT_EQ(client.outcome("control.take"), "");
  ASSERT_EQ(client.outcome("mode", {{"mode", "mdi"}}), "");
  ASSERT_EQ(client.outcome("mdi", {{"blocks", "G1 X100. F600."}}), "");
  ASSERT_EQ(client.outcome("start"), "");
  const Json reply = client.call("undo");
  EXPECT_EQ(reply["error"], "refused");
  EXPECT_EQ(reply["text"], answer_text(Answer::kNotWhileRunning));
  EXPECT_EQ(newest(&client)["undone_by"], 0);
  ASSERT_EQ(client.outcome("reset"), "");
  EXPECT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(length(&client, 3), 0);
}

// Parameters need another right, so they have an undo of their own.
TEST_F(Undo, EachRightTakesBackWhatItMayChange) {
  ServiceClient all(path_);
  ASSERT_EQ(all.outcome("parameters.set", {{"key", "1078"}, {"value", "1"}}), "");
  ASSERT_EQ(all.outcome("parameters.set", {{"key", "1078"}, {"value", "0.0"}}), "");
  EXPECT_EQ(newest(&all)["before"], "1");
  EXPECT_EQ(newest(&all)["after"], "0") << "as the control has it";
  ASSERT_EQ(all.outcome("tools.set", {{"number", 3}, {"length", 10}}), "");
  give({Right::kSetUp});
  ServiceClient setter(path_);
  EXPECT_EQ(setter.outcome("parameters.undo"), "no right");
  EXPECT_EQ(setter.outcome("undo", {{"change", 2}}), "refused") << "a parameter";
  EXPECT_EQ(setter.outcome("undo"), "");
  EXPECT_EQ(setter.outcome("undo"), "not found");
  give({Right::kMaintain});
  ServiceClient keeper(path_);
  EXPECT_EQ(keeper.outcome("undo"), "no right");
  EXPECT_EQ(keeper.outcome("parameters.undo"), "");
  EXPECT_EQ(keeper.call("parameters.list")["reply"]["parameters"][0]["value"], "1");
  const Json reply = keeper.call("parameters.undo");
  EXPECT_EQ(reply["error"], "refused") << "what is set stays set";
  EXPECT_NE(reply["text"].get<std::string>().find("was not set before"), std::string::npos) << reply;
}

TEST_F(Undo, IsPossibleBehindARestart) {
  {
    ServiceClient client(path_);
    ASSERT_EQ(client.outcome("tools.set", {{"number", 9}, {"length", 44.5}}), "");
    ASSERT_EQ(client.outcome("variables.set", {{"number", 507}, {"value", -3}}), "");
    ASSERT_EQ(client.outcome("undo"), "");
  }
  stop();
  // A line of an older version, one that a power cut has cut off, and one with values of nobody.
  {
    std::ofstream file(folder_ + "/changes", std::ios::app);
    file << R"({"time_ns":1,"user":"x","client":"c","service":"tools.set","what":"tool 1 length","before":"0","after":"1"})" << "\n";
    file << R"({"number":9,"time_ns":1,"user":"x","client":"c","service":"tools.set","what":"w","before":"0","after":"1","values":[["tool 1 nothing","0","1"]]})" << "\n";
    file << R"({"number":10,"time_ns":1,"us)";
  }
  start();
  ServiceClient client(path_);
  EXPECT_EQ(length(&client, 9), 44.5);
  EXPECT_EQ(client.outcome("undo", {{"change", 4}}), "refused") << "it does not say what it has changed";
  EXPECT_EQ(client.outcome("undo", {{"change", 9}}), "refused");
  EXPECT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(length(&client, 9), 0);
  EXPECT_EQ(client.outcome("undo"), "not found");
  EXPECT_EQ(newest(&client)["number"], 10) << "the numbers go on";
}

// Changes that are too many, or too large, to be remembered.
TEST(ChangeLogBounds, TheOldestCannotBeTakenBack) {
  ChangeLog log("");
  std::string error;
  Change change;
  change.user = "anna";
  change.service = "tables.import";
  change.values.resize(ChangeLog::kRememberedValues / 4);
  for (int n = 0; n < 6; ++n) ASSERT_TRUE(log.add(change, &error));
  std::size_t values = 0;
  for (std::uint64_t n = 1; n <= 6; ++n) values += log.find(n)->values.size();
  EXPECT_EQ(values, ChangeLog::kRememberedValues);
  EXPECT_TRUE(log.find(1)->values.empty());
  EXPECT_EQ(log.last_of("anna", Right::kSetUp)->number, 6u);
  EXPECT_EQ(log.last_of("anna", Right::kMaintain), nullptr);
  EXPECT_EQ(log.last_of("otto", Right::kSetUp), nullptr);
  change.values.clear();
  for (std::size_t n = 0; n < ChangeLog::kRemembered; ++n) ASSERT_TRUE(log.add(change, &error));
  EXPECT_EQ(log.find(6), nullptr);
  EXPECT_EQ(log.last_of("anna", Right::kSetUp), nullptr);
  change.values.resize(2 * ChangeLog::kRememberedValues);
  ASSERT_TRUE(log.add(change, &error));
  EXPECT_EQ(log.last_of("anna", Right::kSetUp)->values.size(), change.values.size()) << "the newest one can be taken back, whatever its size";
}

TEST(TablePlaces, TheirKeysAreReadBack) {
  for (const char* key : {"tool 3 length", "tool 999 radius_wear", "tool 3 name", "tool 7 pocket", "offset 1 0 X", "offset 4 102 C", "variable 2 501", "name 500", "parameter 1 - 8012", "parameter 2 X 1267/bit0"}) {
    TablePlace place;
    EXPECT_TRUE(parse_place(key, &place)) << key;
    EXPECT_EQ(place_key(place), key);
  }
  for (const char* key : {"", "tool", "tool 3", "tool 3 size", "tool x length", "tool 3 length more", "offset 0 1 X", "offset 5 1 X", "offset 1 1", "variable 1", "variable 1 -3", "parameter 1 -", "life 1 1", "tool 03 length"}) {
    TablePlace place;
    EXPECT_FALSE(parse_place(key, &place)) << key;
  }
}

}  // namespace
}  // namespace nc::rt::services
