// SPDX-License-Identifier: Apache-2.0
// The table of tool life through the services: set, read, written down, kept, taken back, as TOML, and refused while a program is in execution.
#include <gtest/gtest.h>

#include "services/local_machine.hpp"

namespace nc::rt::services {
namespace {

using test::LocalMachine;
using test::ServiceClient;

class ToolLifeServices : public LocalMachine {
 protected:
  static Json row(ServiceClient* client, unsigned number) { return client->call("life.list", {{"from", number}, {"count", 1}})["reply"]["lives"][0]; }
  static std::string exported(ServiceClient* client) { return client->call("tables.export", {{"table", "life"}})["reply"]["toml"]; }
};

TEST_F(ToolLifeServices, ARowIsSetReadAndWrittenDown) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("life.set", {{"number", 2}, {"group", 7}, {"tool", 31}, {"flags", 16}, {"life", 500}, {"used", 12}, {"length_offset", 3}}), "");
  const Json change = client.call("changes", {{"count", 1}})["reply"]["changes"][0];
  EXPECT_EQ(row(&client, 2), (Json{{"changed_by", change["user"]}, {"changed_ns", change["time_ns"]}, {"number", 2}, {"group", 7.0}, {"tool", 31.0}, {"flags", 16.0}, {"status", 0.0}, {"life", 500.0}, {"used", 12.0}, {"length_offset", 3.0}, {"radius_offset", 0.0}, {"auxiliary", 0.0}, {"counts", "mounts"}, {"state", "not used"}}));
  EXPECT_EQ(change["service"], "life.set");
  EXPECT_EQ(change["what"], "6 entries of tool life");
  ASSERT_EQ(client.outcome("life.set", {{"number", 2}, {"used", 13}}), "");
  EXPECT_EQ(client.call("changes", {{"count", 1}})["reply"]["changes"][0]["what"], "tool life 2 used");
  EXPECT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(row(&client, 2)["used"], 12.0);
  EXPECT_EQ(client.outcome("life.set", {{"number", 2}}), "malformed");
  EXPECT_EQ(client.outcome("life.set", {{"number", 201}, {"used", 1}}), "malformed");
}

// What is counted binds the range of the life, so no order of the columns is right for every change: 9000 mounts cannot become minutes before they are 100.
TEST_F(ToolLifeServices, TheColumnsOfARequestDoNotDependOnTheirOrder) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("life.set", {{"number", 1}, {"group", 1}, {"tool", 5}, {"flags", 16}, {"life", 9000}}), "");
  ASSERT_EQ(client.outcome("life.set", {{"number", 1}, {"flags", 0}, {"life", 100}, {"used", 20.5}}), "");
  EXPECT_EQ(row(&client, 1)["counts"], "minutes");
  EXPECT_EQ(row(&client, 1)["life"], 100.0);
  EXPECT_EQ(row(&client, 1)["used"], 20.5);
  ASSERT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(row(&client, 1)["life"], 9000.0);
  EXPECT_EQ(row(&client, 1)["counts"], "mounts");
  EXPECT_EQ(client.outcome("life.set", {{"number", 1}, {"used", 7}, {"flags", 0}}), "refused") << "9000 minutes are too many";
  EXPECT_EQ(row(&client, 1)["used"], 0.0) << "all of it or nothing";
}

TEST_F(ToolLifeServices, AsToml) {
  ServiceClient client(path_);
  EXPECT_EQ(exported(&client), "[tool_life]\n") << "only rows with a tool are in it";
  const std::string text = "[tool_life]\n1 = { group = 4, tool = 12, flags = 32, status = 1, life = 300, used = 20, length_offset = 1, radius_offset = 2, auxiliary = 0 }\n";
  ASSERT_EQ(client.outcome("tables.import", {{"toml", text}}), "");
  EXPECT_EQ(exported(&client), text);
  EXPECT_EQ(row(&client, 1)["counts"], "uses");
  EXPECT_EQ(row(&client, 1)["state"], "in use");
  const Json wrong = client.call("tables.import", {{"toml", "[tool_life]\n1 = { used = 21 }\n2 = { group = 4, life = 10000, flags = 16 }\n3 = { group = 4, status = 9 }\n"}});
  EXPECT_EQ(wrong["ok"], false);
  EXPECT_NE(wrong["text"].get<std::string>().find("line 3: tool life 2 life: "), std::string::npos) << wrong;
  EXPECT_NE(wrong["text"].get<std::string>().find("line 4: tool life 3 status: "), std::string::npos) << wrong;
  EXPECT_EQ(exported(&client), text) << "all of it or nothing";
  const Json unknown = client.call("tables.import", {{"toml", "[tool_life]\n1 = { wear = 1 }\n201 = { used = 1 }\n"}});
  EXPECT_NE(unknown["text"].get<std::string>().find("line 2"), std::string::npos) << unknown;
  EXPECT_NE(unknown["text"].get<std::string>().find("line 3: tool_life.201"), std::string::npos) << unknown;
}

TEST_F(ToolLifeServices, IsKeptAndRefusedWhileAProgramIsInExecution) {
  {
    ServiceClient client(path_);
    ASSERT_EQ(client.outcome("life.set", {{"number", 200}, {"group", 9}, {"tool", 77}, {"life", 60}}), "");
  }
  stop();
  start();
  ServiceClient client(path_);
  EXPECT_EQ(row(&client, 200)["tool"], 77.0);
  EXPECT_EQ(row(&client, 200)["life"], 60.0);
  ASSERT_EQ(client.outcome("control.take"), "");
  ASSERT_EQ(client.outcome("mode", {{"mode", "mdi"}}), "");
  ASSERT_EQ(client.outcome("mdi", {{"blocks", "G1 X100. F600."}}), "");
  ASSERT_EQ(client.outcome("start"), "");
  until(&client, "status", [](const Json& now) { return now["systems"][0]["state"] == "running"; });
  EXPECT_EQ(client.outcome("life.set", {{"number", 200}, {"used", 1}}), "refused");
  EXPECT_EQ(client.outcome("life.list"), "");
}

// What a screen asks for beside a row: who changed it last, and when.
TEST_F(ToolLifeServices, TheChangesOfOneRow) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"length", 1}, {"radius", 2}}), "");
  ASSERT_EQ(client.outcome("tools.set", {{"number", 31}, {"length", 1}}), "");
  ASSERT_EQ(client.outcome("life.set", {{"number", 3}, {"group", 1}}), "");
  ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"radius", 3}}), "");
  const auto numbers = [&](const char* of) {
    std::string text;
    const Json reply = client.call("changes", {{"of", of}})["reply"]["changes"];
    for (const Json& change : reply) text += std::to_string(change["number"].get<int>()) + " ";
    return text;
  };
  EXPECT_EQ(numbers("tool 3"), "4 1 ");
  EXPECT_EQ(numbers("tool 3 length"), "1 ");
  EXPECT_EQ(numbers("tool 31"), "2 ");
  EXPECT_EQ(numbers("life 3"), "3 ");
  EXPECT_EQ(numbers("tool 4"), "");
  const Json newest = client.call("changes", {{"of", "tool 3"}, {"count", 1}})["reply"]["changes"];
  ASSERT_EQ(newest.size(), 1u);
  EXPECT_EQ(newest[0]["number"], 4);
  EXPECT_GT(newest[0]["time_ns"], 0);
  EXPECT_EQ(client.outcome("changes", {{"of", "spoon 3"}}), "malformed");
}

}  // namespace
}  // namespace nc::rt::services
