// SPDX-License-Identifier: Apache-2.0
// Tool offsets, work offsets, variables and parameters through the services: set, read, written down, kept, and refused while a program is in execution.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "runtime/retain/variables.hpp"
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
  Json tool = client.call("tools.list", {{"from", 3}, {"count", 1}})["reply"];
  const Json change = client.call("changes", {{"count", 1}})["reply"]["changes"][0];
  EXPECT_EQ(tool["tools"][0]["changed_by"], change["user"]);
  EXPECT_EQ(tool["tools"][0]["changed_ns"], change["time_ns"]);
  for (const char* who : {"changed_by", "changed_ns"}) tool["tools"][0].erase(who);
  EXPECT_EQ(tool["tools"][0], (Json{{"number", 3}, {"length", 81.25}, {"length_wear", 0.0}, {"radius", 0.0}, {"radius_wear", -0.02}, {"name", ""}, {"pocket", 0}}));
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

TEST_F(TableServices, AVariableGetsAName) {
  ServiceClient client(path_);
  const auto name_of = [&] {
    const Json reply = client.call("variables.list", {{"from", 501}, {"count", 1}})["reply"];
    return reply["variables"][0]["name"];
  };
  ASSERT_EQ(client.outcome("variables.set", {{"number", 501}, {"value", 2.5}, {"name", "DEPTH"}}), "");
  EXPECT_EQ(name_of(), "DEPTH");
  ASSERT_EQ(client.outcome("variables.set", {{"number", 501}, {"name", "WIDTH"}}), "");
  EXPECT_EQ(name_of(), "WIDTH");
  EXPECT_EQ(variable(&client, 501), 2.5) << "a name alone leaves the value";
  EXPECT_EQ(client.call("changes", {{"count", 1}})["reply"]["changes"][0]["what"], "name of #501");
  ASSERT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(name_of(), "DEPTH");
  EXPECT_EQ(client.outcome("variables.set", {{"number", 501}, {"name", "depth"}, {"value", 9}}), "refused");
  EXPECT_EQ(variable(&client, 501), 2.5) << "all of it or nothing";
  EXPECT_EQ(client.outcome("variables.set", {{"number", 501}, {"name", "TOOLONGA"}}), "malformed");
  EXPECT_EQ(client.outcome("variables.set", {{"number", 501}}), "malformed");
  ASSERT_EQ(client.outcome("variables.set", {{"number", 501}, {"name", ""}}), "");
  EXPECT_EQ(name_of(), "");
}

// A program asks for a variable by its name, so two of them have not the same one, as with SETVN (M700 P301).
TEST_F(TableServices, TwoVariablesHaveNotOneName) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("variables.set", {{"number", 501}, {"name", "DEPTH"}}), "");
  Json refused = client.call("variables.set", {{"number", 502}, {"value", 7}, {"name", "DEPTH"}});
  EXPECT_EQ(refused["text"], "name of #502: #501 has the name DEPTH");
  EXPECT_NE(variable(&client, 502), 7) << "all of it or nothing";
  EXPECT_EQ(client.outcome("variables.set", {{"number", 501}, {"name", "DEPTH"}}), "") << "its own name";
  ASSERT_EQ(client.outcome("variables.set", {{"number", 502}, {"name", "WIDTH"}}), "");
  ASSERT_EQ(client.outcome("tables.import", {{"toml", "[variable_names]\n501 = \"WIDTH\"\n502 = \"DEPTH\"\n"}}), "") << "two change names";
  const auto exported = [&] { return client.call("tables.export", {{"table", "variables"}})["reply"]["toml"].get<std::string>(); };
  EXPECT_NE(exported().find("501 = \"WIDTH\"\n502 = \"DEPTH\"\n"), std::string::npos) << exported();
  ASSERT_EQ(client.outcome("undo"), "") << "and change them back";
  EXPECT_NE(exported().find("501 = \"DEPTH\"\n502 = \"WIDTH\"\n"), std::string::npos) << exported();
  refused = client.call("tables.import", {{"toml", "[variable_names]\n503 = \"TOP\"\n504 = \"TOP\"\n"}});
  EXPECT_EQ(refused["text"], "line 2: name of #503: #504 has the name TOP; line 3: name of #504: #503 has the name TOP");
  ASSERT_EQ(client.outcome("variables.set", {{"number", 502}, {"name", "TOP"}}), "");
  ASSERT_EQ(client.outcome("variables.set", {{"number", 505}, {"name", "WIDTH"}}), "") << "a name that is free again";
  refused = client.call("undo", {{"change", client.call("changes", {{"of", "name 502"}, {"count", 1}})["reply"]["changes"][0]["number"]}});
  EXPECT_EQ(refused["text"], "name of #502: #505 has the name WIDTH") << "an undo makes no second one either";
  EXPECT_EQ(client.outcome("variables.set", {{"number", 506}, {"name", "SINUS"}}), "refused") << "the name of a function stands at its beginning";
}

// What an older release has kept and this one does not take is said at the start.
TEST_F(TableServices, ANameThatIsNotTakenOverIsNamed) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("tables.import", {{"toml", "[variable_names]\n501 = \"DEPTH\"\n502 = \"WIDTH\"\n"}}), "");
  std::vector<std::string> left_out;
  std::string name_of_502;
  ASSERT_EQ(runtime_->look([&](nc_control* control) {
    std::string kept = encode_variables(control);
    kept.replace(kept.find("DEPTH"), 5, "SINUS");
    (void)nc_variable_name_set(control, 501, "");
    (void)nc_variable_name_set(control, 502, "");
    EXPECT_TRUE(restore_variables(control, kept, {}, &left_out));
    char name[8] = "";
    (void)nc_variable_name_get(control, 502, name);
    name_of_502 = name;
  }), Answer::kDone);
  ASSERT_EQ(left_out.size(), 1u);
  EXPECT_EQ(left_out[0].find("#501 has lost its name SINUS: "), 0u) << left_out[0];
  EXPECT_EQ(name_of_502, "WIDTH");
}

// A program, a screen and a file know one zero.
TEST_F(TableServices, ZeroHasNoSign) {
  ServiceClient client(path_);
  const std::string minus = "{\"id\":1,\"service\":\"variables.set\",\"args\":{\"number\":501,\"value\":-0.0}}";
  ASSERT_TRUE(client.send_bytes(rt::services::frame_of(minus)));
  EXPECT_EQ(client.receive()["ok"], true);
  ASSERT_EQ(client.outcome("tools.set", {{"number", 1}, {"length", -0.0}}), "");
  ASSERT_EQ(client.outcome("offsets.set", {{"index", 1}, {"axis", "X"}, {"value", -0.0}}), "");
  ASSERT_EQ(client.outcome("tables.import", {{"toml", "[variables]\n502 = -0.0\n[tool_offsets]\n2 = { length = -0.0 }\n[work_offsets]\n\"G55\" = { X = -0.0 }\n"}}), "");
  run(&client, "#503=-0\n#504=0*-1\nG10 L2 P3 X-0.0");
  EXPECT_EQ(client.call("tables.export")["reply"]["toml"].get<std::string>().find("-0"), std::string::npos) << client.call("tables.export")["reply"]["toml"].get<std::string>();
  for (const char* list : {"tools.list", "offsets.list", "variables.list", "changes"}) EXPECT_EQ(client.call(list).dump().find("-0"), std::string::npos) << list;
}

TEST_F(TableServices, ParametersHaveTheirMeaningAndRange) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("parameters.set", {{"key", "1078"}, {"value", "1"}}), "");
  std::map<std::string, Json> all;
  const Json set = client.call("parameters.list")["reply"]["parameters"];
  for (const Json& row : set) EXPECT_EQ(row["set"], true);
  unsigned pages = 0;
  for (std::uint64_t from = 0; pages == 0 || from != 0; ++pages) {
    const Json reply = client.call("parameters.list", {{"all", true}, {"from", from}, {"count", 50}})["reply"];
    for (const Json& row : reply["parameters"]) {
      EXPECT_TRUE(row["axis"] != "" || all.emplace(row["key"], row).second) << row["key"] << " is there twice";
      EXPECT_EQ(row["set"] == false, row["value"] == "") << row;
    }
    from = reply["next"];
  }
  EXPECT_GT(pages, 2u);
  EXPECT_EQ(all["1078"]["value"], "1");
  EXPECT_EQ(all["1078"]["set"], true);
  // As the table of the family says it.
  unsigned seen = 0;
  nc_parameter row;
  for (unsigned i = 0; nc_parameter_row(NC_DIALECT_M700, i, &row) == NC_OK; ++i) {
    const std::string key = row.key != nullptr ? row.key : std::to_string(row.first) + (row.bit < 0 ? "" : "/bit" + std::to_string(row.bit));
    if (all.count(key) == 0) continue;  // a bit of a parameter that is set
    EXPECT_NE(all[key]["name"].get<std::string>().find(row.name), std::string::npos) << key;
    EXPECT_EQ(all[key]["by_axis"], row.by_axis) << key;
    EXPECT_EQ(all[key]["section"], row.section) << key;
    EXPECT_EQ(all[key]["values"] == "", std::string(row.values).empty()) << key;
    ++seen;
  }
  EXPECT_GT(seen, 50u);
}

TEST_F(TableServices, ARefusedParameterIsToldItsRange) {
  ServiceClient client(path_);
  const Json reply = client.call("parameters.set", {{"key", "1078"}, {"value", "77"}});
  EXPECT_EQ(reply["error"], "refused");
  nc_parameter row, found{};
  for (unsigned i = 0; nc_parameter_row(NC_DIALECT_M700, i, &row) == NC_OK; ++i)
    if (row.key == nullptr && row.first <= 1078 && row.last >= 1078) found = row;
  ASSERT_NE(found.name, nullptr);
  EXPECT_NE(reply["text"].get<std::string>().find(found.name), std::string::npos) << reply;
  EXPECT_NE(reply["text"].get<std::string>().find("0"), std::string::npos) << reply;
  EXPECT_EQ(client.outcome("parameters.set", {{"key", "nonsense"}, {"value", "1"}}), "not found");
}

}  // namespace
}  // namespace nc::rt::services
