// SPDX-License-Identifier: Apache-2.0
// Name and magazine pocket of tools through the services: set, read, written down, kept, taken back, as TOML, one tool in a pocket, and possible while a program is in execution.
#include <gtest/gtest.h>

#include <utility>

#include "services/local_machine.hpp"

namespace nc::rt::services {
namespace {

using test::LocalMachine;
using test::ServiceClient;

class ToolLabelServices : public LocalMachine {
 protected:
  std::string machine_text() override {
    std::string text = LocalMachine::machine_text() + configured_;
    return text.replace(text.find("name = \"test\"\n"), 0, "tool_offset_sets = " + std::to_string(tools_) + "\n");
  }
  static Json row(ServiceClient* client, unsigned number) { return client->call("tools.list", {{"from", number}, {"count", 1}})["reply"]["tools"][0]; }
  static std::string text_of(const Json& message) { return message["text"].get<std::string>(); }
  static std::string exported(ServiceClient* client) { return client->call("tables.export", {{"table", "tools"}})["reply"]["toml"]; }
  // Ends the machine and starts it with these tools in its configuration.
  void start_with(const std::string& tools) {
    stop();
    configured_ = tools;
    start();
  }
  std::string configured_;
  unsigned tools_ = 200;
};

TEST_F(ToolLabelServices, AreSetReadAndWrittenDown) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"name", "Schaftfr\xc3\xa4ser \xc3\x98" "10 \"HM\""}, {"pocket", 7}, {"radius", 5}}), "");
  const Json tool = row(&client, 3);
  EXPECT_EQ(tool["name"], "Schaftfr\xc3\xa4ser \xc3\x98" "10 \"HM\"");
  EXPECT_EQ(tool["pocket"], 7);
  EXPECT_EQ(tool["radius"], 5.0);
  EXPECT_EQ(row(&client, 4)["name"], "");
  EXPECT_EQ(row(&client, 4)["pocket"], 0);
  ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"pocket", 12}}), "");
  const Json changes = client.call("changes", {{"of", "tool 3"}})["reply"]["changes"];
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_EQ(changes[0]["what"], "tool 3 pocket");
  EXPECT_EQ(changes[0]["before"], "7");
  EXPECT_EQ(changes[0]["after"], "12");
  EXPECT_EQ(changes[0]["client"], client.greeting["client"]);
  EXPECT_GT(changes[0]["time_ns"].get<std::int64_t>(), 1'000'000'000'000'000'000);
  EXPECT_EQ(changes[1]["what"], "tool 3 radius, tool 3 name, tool 3 pocket");
  EXPECT_EQ(client.call("changes", {{"of", "tool 3 name"}})["reply"]["changes"].size(), 1u);
  ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"name", ""}, {"pocket", 0}}), "") << "both are taken away so";
  EXPECT_EQ(row(&client, 3)["name"], "");
  EXPECT_EQ(row(&client, 3)["pocket"], 0);
}

TEST_F(ToolLabelServices, WhatCannotBeANameOrAPocketIsRefused) {
  ServiceClient client(path_);
  const std::string longest(64, 'x');
  EXPECT_EQ(client.outcome("tools.set", {{"number", 1}, {"name", longest}}), "");
  for (const std::string& name : {longest + "x", std::string("a\nb"), std::string("a\tb"), std::string("a\0b", 3), std::string("a\x7f"), std::string("a\xc2\x9b" "31m"), std::string("a\xe2\x80\xa8")})
    EXPECT_NE(client.outcome("tools.set", {{"number", 1}, {"name", name}}), "") << Json(name).dump();
  EXPECT_EQ(row(&client, 1)["name"], longest);
  EXPECT_EQ(client.outcome("tools.set", {{"number", 1}, {"pocket", -1}}), "malformed");
  EXPECT_EQ(client.outcome("tools.set", {{"number", 1}, {"pocket", 1.5}}), "malformed");
  EXPECT_EQ(client.outcome("tools.set", {{"number", 1}, {"pocket", 10000}}), "malformed");
  EXPECT_EQ(client.outcome("tools.set", {{"number", 900}, {"pocket", 1}}), "not found");
  EXPECT_EQ(client.outcome("tools.set", {{"number", 900}, {"name", "x"}}), "not found");
  EXPECT_EQ(client.call("changes")["reply"]["changes"].size(), 1u) << "what was refused is no change";
}

TEST_F(ToolLabelServices, APocketHasOneTool) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"name", "drill"}, {"pocket", 7}}), "");
  const Json refused = client.call("tools.set", {{"number", 4}, {"pocket", 7}, {"length", 9}});
  EXPECT_EQ(refused["error"], "refused");
  EXPECT_NE(text_of(refused).find("pocket 7 has tool 3 (drill)"), std::string::npos) << refused;
  EXPECT_EQ(row(&client, 4)["pocket"], 0);
  EXPECT_EQ(row(&client, 4)["length"], 0.0) << "all of it or nothing";
  EXPECT_EQ(client.outcome("tools.set", {{"number", 3}, {"pocket", 7}}), "") << "its own pocket";
  for (unsigned tool = 5; tool < 8; ++tool) EXPECT_EQ(client.outcome("tools.set", {{"number", tool}, {"pocket", 0}}), "") << "in none there may be many";
}

// The changes of one request are looked at together, so that two tools can change places.
TEST_F(ToolLabelServices, TwoToolsChangePlacesInOneImport) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("tables.import", {{"toml", "[tool_offsets]\n1 = { pocket = 11 }\n2 = { pocket = 12, name = \"tap M6\" }\n"}}), "");
  ASSERT_EQ(client.outcome("tables.import", {{"toml", "[tool_offsets]\n1 = { pocket = 12 }\n2 = { pocket = 11 }\n"}}), "");
  EXPECT_EQ(row(&client, 1)["pocket"], 12);
  EXPECT_EQ(row(&client, 2)["pocket"], 11);
  ASSERT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(row(&client, 1)["pocket"], 11);
  const Json refused = client.call("tables.import", {{"toml", "[tool_offsets]\n1 = { length = 5 }\n3 = { pocket = 12 }\n"}});
  EXPECT_EQ(refused["error"], "refused");
  EXPECT_NE(text_of(refused).find("line 3: tool 3 pocket: pocket 12 has tool 2 (tap M6)"), std::string::npos) << refused;
  EXPECT_EQ(row(&client, 1)["length"], 0.0) << "all of it or nothing";
}

TEST_F(ToolLabelServices, AreTakenBack) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"name", "1"}, {"pocket", 7}}), "");
  ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"name", "1.0"}, {"pocket", 0}}), "");
  ASSERT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(row(&client, 3)["name"], "1") << "a name is a text, though it may look like a number";
  EXPECT_EQ(row(&client, 3)["pocket"], 7);
  ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"pocket", 0}}), "");
  ASSERT_EQ(client.outcome("tables.import", {{"toml", "[tool_offsets]\n4 = { pocket = 7 }\n"}}), "");
  const Json refused = client.call("undo", {{"change", 4}});
  EXPECT_EQ(refused["error"], "refused") << "another tool is there now";
  EXPECT_NE(text_of(refused).find("pocket 7 has tool 4"), std::string::npos) << refused;
  ASSERT_EQ(client.outcome("undo"), "");
  ASSERT_EQ(client.outcome("undo", {{"change", 4}}), "");
  EXPECT_EQ(row(&client, 3)["pocket"], 7);
}

TEST_F(ToolLabelServices, AsToml) {
  ServiceClient client(path_);
  const std::string empty = exported(&client);
  const std::string line = "3 = { length = 81.25, length_wear = 0, radius = 5, radius_wear = 0, name = \"Bohrer \\\"8\\\" \\\\ \xc3\x98\", pocket = 7 }\n";
  ASSERT_EQ(client.outcome("tables.import", {{"toml", "[tool_offsets]\n" + line}}), "");
  EXPECT_EQ(row(&client, 3)["name"], "Bohrer \"8\" \\ \xc3\x98");
  const std::string full = exported(&client);
  EXPECT_NE(full.find(line), std::string::npos) << full.substr(0, 500);
  ASSERT_EQ(client.outcome("tables.import", {{"toml", empty}}), "");
  EXPECT_EQ(row(&client, 3)["pocket"], 0);
  EXPECT_EQ(exported(&client), empty);
  ASSERT_EQ(client.outcome("tables.import", {{"toml", full}}), "");
  EXPECT_EQ(exported(&client), full);
  for (const auto& [row, said] : {std::pair<const char*, const char*>{"1 = { name = \"a\\nb\" }", "control character"},
                                  {"1 = { name = \"a\\u009b\" }", "control character"},
                                  {"1 = { name = 5 }", "must be a string"},
                                  {"1 = { pocket = 1.5 }", "must be an integer"},
                                  {"1 = { pocket = 10000 }", "from 0 to 9999"},
                                  {"1 = { pocket = 4 }\n2 = { pocket = 4 }", "line 3: tool_offsets.2.pocket: pocket 4 has tool 1"}}) {
    const Json reply = client.call("tables.import", {{"toml", std::string("[tool_offsets]\n") + row + "\n"}});
    EXPECT_EQ(reply["error"], "malformed") << row;
    EXPECT_NE(reply.dump().find(said), std::string::npos) << row << ": " << reply;
    EXPECT_NE(reply.dump().find("line "), std::string::npos) << row << ": " << reply;
  }
  EXPECT_EQ(exported(&client), full);
}

// The longest names in all rows, each of them as long again as TOML and then JSON make them.
TEST_F(ToolLabelServices, AFullTableHasRoomInAReplyAndInARequest) {
  tools_ = 999;
  start_with("");
  ServiceClient client(path_);
  std::string name, text = "[tool_offsets]\n";
  for (unsigned i = 0; i < 64; ++i) name += "\\\"";
  for (unsigned tool = 1; tool <= 999; ++tool)
    text += std::to_string(tool) + " = { length = -123456.789, length_wear = -123456.789, radius = -123456.789, radius_wear = -123456.789, name = \"" + name + "\", pocket = " + std::to_string(9000 + tool) + " }\n";
  ASSERT_EQ(client.outcome("tables.import", {{"toml", text}}), "");
  EXPECT_EQ(exported(&client), text);
  EXPECT_EQ(row(&client, 999)["name"], std::string(64, '"'));
}

// A name and a pocket hurt no program: the magazine is loaded while the machine works.
TEST_F(ToolLabelServices, AreSetWhileAProgramIsInExecution) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("control.take"), "");
  ASSERT_EQ(client.outcome("mode", {{"mode", "mdi"}}), "");
  ASSERT_EQ(client.outcome("mdi", {{"blocks", "G1 X100. F600."}}), "");
  ASSERT_EQ(client.outcome("start"), "");
  until(&client, "status", [](const Json& now) { return now["systems"][0]["state"] == "running"; });
  EXPECT_EQ(client.outcome("tools.set", {{"number", 9}, {"name", "reamer"}, {"pocket", 3}}), "");
  EXPECT_EQ(row(&client, 9)["pocket"], 3);
  EXPECT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(row(&client, 9)["pocket"], 0);
  EXPECT_EQ(client.outcome("tools.set", {{"number", 9}, {"name", "reamer"}, {"length", 3}}), "refused");
  EXPECT_EQ(row(&client, 9)["name"], "") << "all of it or nothing";
}

TEST_F(ToolLabelServices, AreThereAfterARestart) {
  {
    ServiceClient client(path_);
    ASSERT_EQ(client.outcome("tools.set", {{"number", 9}, {"name", "a=b\xe2\x82\xac"}, {"pocket", 44}}), "");
    ASSERT_EQ(client.outcome("tools.set", {{"number", 10}, {"name", "end"}}), "") << "the last word of the file is no name's";
  }
  stop();
  start();
  ServiceClient client(path_);
  EXPECT_EQ(row(&client, 9)["name"], "a=b\xe2\x82\xac");
  EXPECT_EQ(row(&client, 9)["pocket"], 44);
  EXPECT_EQ(row(&client, 10)["name"], "end");
  EXPECT_EQ(client.outcome("undo"), "") << "also behind a restart";
  EXPECT_EQ(row(&client, 10)["name"], "");
}

// The configuration gives the values of the first start; where it is changed later, it wins, as it does with offsets.
TEST_F(ToolLabelServices, TheConfigurationHasTheFirstOnes) {
  start_with("[tool_offsets]\n1 = { name = \"face mill\", pocket = 1 }\n2 = { length = 3, pocket = 2 }\n");
  {
    ServiceClient client(path_);
    EXPECT_EQ(row(&client, 1)["name"], "face mill");
    EXPECT_EQ(row(&client, 2)["pocket"], 2);
    ASSERT_EQ(client.outcome("tools.set", {{"number", 1}, {"name", "face mill 63"}, {"pocket", 20}}), "");
    ASSERT_EQ(client.outcome("tools.set", {{"number", 5}, {"pocket", 30}}), "");
  }
  start_with("[tool_offsets]\n1 = { name = \"face mill\", pocket = 8 }\n2 = { length = 3, pocket = 2 }\n6 = { pocket = 30 }\n");
  ServiceClient client(path_);
  EXPECT_EQ(row(&client, 1)["name"], "face mill 63") << "kept, as the configuration is the same";
  EXPECT_EQ(row(&client, 1)["pocket"], 8) << "changed in the configuration";
  EXPECT_EQ(row(&client, 6)["pocket"], 30);
  EXPECT_EQ(row(&client, 5)["pocket"], 0) << "the configuration has given its pocket to another tool";
  bool said = false;
  for (const std::string& warning : runtime_->warnings()) said = said || warning.find("tool 5 was in pocket 30, which the configuration gives to tool 6") != std::string::npos;
  EXPECT_TRUE(said);
}

}  // namespace
}  // namespace nc::rt::services
