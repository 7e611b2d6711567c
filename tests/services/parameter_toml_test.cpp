// SPDX-License-Identifier: Apache-2.0
// Parameters as TOML: what is exported is imported again, an import is whole or nothing, and what is wrong is named with its line.
#include <gtest/gtest.h>

#include "services/local_machine.hpp"

namespace nc::rt::services {
namespace {

using test::LocalMachine;
using test::ServiceClient;

class ParameterToml : public LocalMachine {
 protected:
  static std::string exported(ServiceClient* client) { return client->call("parameters.export")["reply"]["toml"]; }
  static std::string refused(ServiceClient* client, const std::string& text) {
    const Json reply = client->call("parameters.import", {{"toml", text}});
    return reply["ok"] == true ? "" : reply["text"].get<std::string>();
  }
};

TEST_F(ParameterToml, WhatIsExportedIsImportedAgain) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("parameters.set", {{"key", "1078"}, {"value", "0"}}), "");
  ASSERT_EQ(client.outcome("parameters.set", {{"key", "2037"}, {"axis", "X"}, {"value", "12.5"}}), "");
  const std::string before = exported(&client);
  for (const char* row : {"[parameters]\n", "\"1078\" = 0\n", "\"2037\" = { X = 12.5 }\n"}) EXPECT_NE(before.find(row), std::string::npos) << row << before;
  const Json reply = client.call("parameters.import", {{"toml", "[parameters]\n1078 = 1\n2037 = { X = 12.5, Y = -3 }\n"}});
  ASSERT_EQ(reply["ok"], true) << reply;
  EXPECT_EQ(reply["reply"]["text"], "3 values as in the file, changed: 2 parameters");
  const std::string after = exported(&client);
  EXPECT_NE(after.find("\"2037\" = { X = 12.5, Y = -3 }\n"), std::string::npos) << after;
  const Json change = client.call("changes", {{"count", 1}})["reply"]["changes"][0];
  EXPECT_EQ(change["service"], "parameters.import");
  EXPECT_EQ(client.call("parameters.import", {{"toml", after}})["reply"]["text"].get<std::string>().find("none of them another one than before") == std::string::npos, false);
  ASSERT_EQ(client.outcome("parameters.import", {{"toml", "[parameters]\n1078 = 0\n"}}), "");
  EXPECT_EQ(client.outcome("parameters.undo"), "");
  EXPECT_EQ(exported(&client), after);
  EXPECT_EQ(client.outcome("undo"), "not found") << "another right takes parameters back";
}

// 1078 is good, and was not set: it would stay if the values were tried one after the other on the machine.
TEST_F(ParameterToml, OneBadLineAndNothingIsImported) {
  ServiceClient client(path_);
  const std::string before = exported(&client);
  const std::string text = refused(&client, "[parameters]\n2037 = { Y = 7 }\n1078 = 77\nnonsense = 1\n1037 = 1\n");
  EXPECT_NE(text.find("line 3: parameter 1078 of part system 1: "), std::string::npos) << text;
  EXPECT_NE(text.find("line 4: parameter nonsense of part system 1: there is no such parameter"), std::string::npos) << text;
  EXPECT_EQ(text.find("line 2"), std::string::npos) << text;
  EXPECT_EQ(text.find("line 5"), std::string::npos) << text;
  EXPECT_EQ(exported(&client), before);
  EXPECT_NE(refused(&client, "[parameters]\n1078 = { Q = 1 }\n").find("line 2: parameters.1078.Q: no axis"), std::string::npos);
  EXPECT_NE(refused(&client, "[parameters]\n1078 = [1]\n").find("line 2"), std::string::npos);
  EXPECT_NE(refused(&client, "[tool_offsets]\n1 = 1\n").find("unknown"), std::string::npos) << "tables have another right";
  EXPECT_NE(refused(&client, "\n").find("holds none of [parameters]"), std::string::npos);
  EXPECT_EQ(exported(&client), before);
  EXPECT_TRUE(client.call("changes")["reply"]["changes"].empty());
}

TEST_F(ParameterToml, NeedsTheRightToMaintain) {
  give({Right::kSetUp});
  ServiceClient client(path_);
  EXPECT_EQ(client.outcome("parameters.export"), "");
  EXPECT_EQ(client.outcome("parameters.import", {{"toml", "[parameters]\n1078 = 1\n"}}), "no right");
}

TEST_F(ParameterToml, RefusedWhileAProgramIsInExecution) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("control.take"), "");
  ASSERT_EQ(client.outcome("mode", {{"mode", "mdi"}}), "");
  ASSERT_EQ(client.outcome("mdi", {{"blocks", "G1 X100. F600."}}), "");
  ASSERT_EQ(client.outcome("start"), "");
  until(&client, "status", [](const Json& now) { return now["systems"][0]["state"] == "running"; });
  EXPECT_EQ(client.outcome("parameters.import", {{"toml", "[parameters]\n1078 = 1\n"}}), "refused");
}

}  // namespace
}  // namespace nc::rt::services
