// SPDX-License-Identifier: Apache-2.0
// Tool offsets, work offsets, variables and parameters through the services: set, read, written down, kept, and refused while a program is in execution.
#include <gtest/gtest.h>

#include <set>

#include "services/local_machine.hpp"

namespace nc::rt::services {
namespace {

using test::LocalMachine;
using test::ServiceClient;

class TableServices : public LocalMachine {
 protected:
  // Runs the blocks in MDI to their end.
  void run(ServiceClient* client, const std::string& blocks) {
    begin(client, blocks);
    until(client, "status", [this](const Json& now) { return now["systems"][0]["runs"] == runs_; });
  }
  void begin(ServiceClient* client, const std::string& blocks) {
    ASSERT_EQ(client->outcome("control.take"), "");
    ASSERT_EQ(client->outcome("mode", {{"mode", "mdi"}}), "");
    ASSERT_EQ(client->outcome("mdi", {{"blocks", blocks}}), "");
    ASSERT_EQ(client->outcome("start"), "");
    ++runs_;
  }
  double variable(ServiceClient* client, unsigned number) {
    const Json reply = client->call("variables.list", {{"from", number}, {"count", 1}})["reply"];
    for (const Json& row : reply["variables"])
      if (row["number"] == number) return row["value"];
    return -1;
  }
  unsigned runs_ = 0;
};

TEST_F(TableServices, WhatIsSetIsReadAndWrittenDown) {
  ServiceClient client(path_);
  EXPECT_EQ(client.outcome("tools.set", {{"number", 3}, {"length", 81.25}, {"radius_wear", -0.02}}), "");
  const Json tool = client.call("tools.list", {{"from", 3}, {"count", 1}})["reply"];
  EXPECT_EQ(tool["tools"][0], (Json{{"number", 3}, {"length", 81.25}, {"length_wear", 0.0}, {"radius", 0.0}, {"radius_wear", -0.02}}));
  EXPECT_EQ(tool["next"], 4);
  EXPECT_EQ(client.outcome("offsets.set", {{"index", 1}, {"axis", "Y"}, {"value", -7.5}}), "");
  EXPECT_EQ(client.outcome("offsets.set", {{"index", 102}, {"axis", "Z"}, {"value", 1}}), "");
  const Json offsets = client.call("offsets.list")["reply"]["offsets"];
  EXPECT_EQ(offsets[1]["axes"][1], (Json{{"name", "Y"}, {"value", -7.5}}));
  EXPECT_EQ(offsets[8]["index"], 102);
  EXPECT_EQ(offsets[8]["axes"][2]["value"], 1.0);
  EXPECT_EQ(client.outcome("variables.set", {{"number", 501}, {"value", 2.5}}), "");
  EXPECT_EQ(variable(&client, 501), 2.5);
  EXPECT_EQ(client.outcome("variables.set", {{"number", 501}, {"vacant", true}}), "");
  EXPECT_EQ(variable(&client, 501), -1);
  EXPECT_EQ(client.outcome("parameters.set", {{"key", "1078"}, {"value", "1"}}), "");
  const Json changes = client.call("changes")["reply"]["changes"];
  ASSERT_EQ(changes.size(), 6u);
  EXPECT_EQ(changes[0]["service"], "parameters.set");
  EXPECT_EQ(changes[1]["before"], "2.5");
  EXPECT_EQ(changes[1]["after"], "");
  EXPECT_EQ(changes[5]["what"], "tool 3 length, tool 3 radius_wear");
  EXPECT_EQ(changes[5]["before"], "0, 0");
  EXPECT_EQ(changes[5]["after"], "81.25, -0.02");
  EXPECT_EQ(changes[5]["client"], client.greeting["client"]);
  EXPECT_GT(changes[0]["time_ns"].get<std::int64_t>(), 1'000'000'000'000'000'000);
}

TEST_F(TableServices, WhatIsNotThereIsSaid) {
  ServiceClient client(path_);
  EXPECT_EQ(client.outcome("tools.set", {{"number", 900}, {"length", 1}}), "not found");
  EXPECT_EQ(client.outcome("tools.set", {{"number", 1}}), "malformed");
  EXPECT_EQ(client.outcome("offsets.set", {{"index", 50}, {"axis", "X"}, {"value", 1}}), "not found");
  EXPECT_EQ(client.outcome("offsets.set", {{"index", 1}, {"axis", "Q"}, {"value", 1}}), "not found");
  EXPECT_EQ(client.outcome("offsets.set", {{"index", 1}, {"axis", "X"}, {"value", 1}, {"system", 2}}), "not found");
  EXPECT_EQ(client.outcome("variables.set", {{"number", 5}, {"value", 1}}), "not found") << "a local variable belongs to its program";
  EXPECT_EQ(client.outcome("variables.set", {{"number", 5001}, {"value", 1}}), "not found") << "a system variable";
  EXPECT_EQ(client.outcome("variables.set", {{"number", 501}}), "malformed");
  EXPECT_EQ(client.outcome("variables.set", {{"number", 501}, {"value", 1}, {"vacant", true}}), "malformed");
  EXPECT_EQ(client.outcome("parameters.set", {{"key", "no such"}, {"value", "1"}}), "not found");
  EXPECT_EQ(client.outcome("parameters.set", {{"key", "1078"}, {"value", "77"}}), "refused");
  EXPECT_TRUE(client.call("changes")["reply"]["changes"].empty()) << "what was refused is no change";
}

TEST_F(TableServices, RefusedWhileAProgramIsInExecution) {
  ServiceClient client(path_);
  begin(&client, "G1 X100. F600.\n#500=#501");
  until(&client, "status", [](const Json& now) { return now["systems"][0]["state"] == "running"; });
  for (const auto& [service, args] : {std::pair<const char*, Json>{"tools.set", {{"number", 1}, {"length", 1}}}, {"offsets.set", {{"index", 1}, {"axis", "X"}, {"value", 1}}},
                                      {"variables.set", {{"number", 501}, {"value", 1}}}, {"parameters.set", {{"key", "1078"}, {"value", "1"}}}}) {
    const Json reply = client.call(service, args);
    EXPECT_EQ(reply["error"], "refused") << service;
    EXPECT_EQ(reply["text"], answer_text(Answer::kNotWhileRunning)) << service;
  }
  EXPECT_EQ(client.outcome("tools.list"), "") << "reading is always possible";
  ASSERT_EQ(client.outcome("hold"), "");
  EXPECT_EQ(client.outcome("tools.set", {{"number", 1}, {"length", 1}}), "refused") << "an interrupted program is one in execution";
  ASSERT_EQ(client.outcome("reset"), "");
  EXPECT_EQ(client.outcome("tools.set", {{"number", 1}, {"length", 1}}), "");
}

// Blocks that wait for their start have been read ahead, with the old values.
TEST_F(TableServices, BlocksThatWaitForTheirStartUseTheNewValues) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("variables.set", {{"number", 501}, {"value", 10}}), "");
  ASSERT_EQ(client.outcome("control.take"), "");
  ASSERT_EQ(client.outcome("mode", {{"mode", "mdi"}}), "");
  ASSERT_EQ(client.outcome("mdi", {{"blocks", "G54 G90 G0 X#501\n#502=#501*2"}}), "");
  usleep(50'000);  // read ahead by now; the result must be the same in any case
  ASSERT_EQ(client.outcome("variables.set", {{"number", 501}, {"value", 30}}), "");
  ASSERT_EQ(client.outcome("offsets.set", {{"index", 1}, {"axis", "X"}, {"value", 5}}), "");
  ASSERT_EQ(client.outcome("start"), "");
  until(&client, "status", [](const Json& now) { return now["systems"][0]["runs"] == 1; });
  EXPECT_NEAR(runtime_->snapshot().system[0].nc.command.v[0], 35, 1e-6);
  EXPECT_EQ(variable(&client, 502), 60);
}

TEST_F(TableServices, WhatIsSetIsThereAfterARestart) {
  {
    ServiceClient client(path_);
    ASSERT_EQ(client.outcome("tools.set", {{"number", 9}, {"length", 44.5}}), "");
    ASSERT_EQ(client.outcome("variables.set", {{"number", 507}, {"value", -3}}), "");
  }
  stop();
  start();
  ServiceClient client(path_);
  EXPECT_EQ(client.call("tools.list", {{"from", 9}, {"count", 1}})["reply"]["tools"][0]["length"], 44.5);
  EXPECT_EQ(variable(&client, 507), -3);
  EXPECT_EQ(client.call("changes")["reply"]["changes"].size(), 2u) << "who has changed it is known still";
}

TEST_F(TableServices, ListsComeInPages) {
  ServiceClient client(path_);
  std::set<unsigned> numbers;
  unsigned from = 0, pages = 0;
  do {
    const Json page = client.call("tools.list", {{"from", from}, {"count", 30}})["reply"];
    for (const Json& tool : page["tools"]) EXPECT_TRUE(numbers.insert(tool["number"].get<unsigned>()).second);
    from = page["next"];
    ++pages;
  } while (from != 0);
  EXPECT_EQ(numbers.size(), config_.nc.tool_offsets);
  EXPECT_EQ(pages, (config_.nc.tool_offsets + 29) / 30);
}

}  // namespace
}  // namespace nc::rt::services
