// SPDX-License-Identifier: Apache-2.0
// Tables as TOML: what is exported is imported again, an import is whole or nothing, and what is wrong is named with its line.
#include "runtime/services/table_toml.hpp"

#include <gtest/gtest.h>

#include "services/local_machine.hpp"

namespace nc::rt::services {
namespace {

using test::LocalMachine;
using test::ServiceClient;

class TableToml : public LocalMachine {
 protected:
  std::string exported(ServiceClient* client, const Json& args = Json::object()) { return client->call("tables.export", args)["reply"]["toml"]; }
};

TEST_F(TableToml, WhatIsExportedIsImportedAgain) {
  ServiceClient client(path_);
  const std::string empty = exported(&client);
  ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"length", 81.25}, {"length_wear", 0.1}, {"radius_wear", -0.02}}), "");
  ASSERT_EQ(client.outcome("offsets.set", {{"index", 0}, {"axis", "X"}, {"value", 1e-7}}), "");
  ASSERT_EQ(client.outcome("offsets.set", {{"index", 1}, {"axis", "Y"}, {"value", -7.5}}), "");
  ASSERT_EQ(client.outcome("offsets.set", {{"index", 102}, {"axis", "Z"}, {"value", 123.456789}}), "");
  ASSERT_EQ(client.outcome("variables.set", {{"number", 501}, {"value", 1.0 / 3}}), "");
  ASSERT_EQ(client.outcome("variables.set", {{"number", 100}, {"value", 1e15}}), "");
  ASSERT_EQ(client.outcome("tables.import", {{"toml", "[variable_names]\n501 = \"DEPTH1\"\n"}}), "");
  const std::string full = exported(&client);
  for (const char* row : {"3 = { length = 81.25, length_wear = 0.1, radius = 0, radius_wear = -0.02, name = \"\", pocket = 0 }\n", "\"EXT\" = { X = 1e-07, Y = 0, Z = 0 }\n", "\"G54\" = { X = 0, Y = -7.5, Z = 0 }\n",
                          "\"G54.1P2\" = { X = 0, Y = 0, Z = 123.456789 }\n", "501 = 0.3333333333333333\n", "100 = 1e+15\n", "501 = \"DEPTH1\"\n"})
    EXPECT_NE(full.find(row), std::string::npos) << row;
  // Back to where it was, but for variables: those that the file does not name keep their values.
  ASSERT_EQ(client.outcome("tables.import", {{"toml", empty}}), "");
  EXPECT_EQ(exported(&client, {{"table", "tools"}}), empty.substr(0, empty.find("\n[work_offsets]")));
  EXPECT_EQ(exported(&client, {{"table", "variables"}}), full.substr(full.find("[variables]")));
  ASSERT_EQ(client.outcome("tables.import", {{"toml", "[variables]\n501 = \"vacant\"\n100 = \"vacant\"\n[variable_names]\n501 = \"\"\n"}}), "");
  EXPECT_EQ(exported(&client), empty);
  const Json again = client.call("tables.import", {{"toml", full}});
  EXPECT_EQ(again["ok"], true) << again;
  EXPECT_EQ(exported(&client), full) << "the same tables give the same bytes";
}

TEST_F(TableToml, IsOneChangeThatCanBeTakenBack) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("tools.set", {{"number", 2}, {"length", 5}}), "");
  const std::string before = exported(&client);
  const Json reply = client.call("tables.import", {{"toml", "[tool_offsets]\n1 = 10\n2 = { length = 5, radius = 3 }\n[work_offsets]\nG54 = { X = 1, Y = 2 }\n[variables]\n500 = 7\n501 = \"vacant\"\n[variable_names]\n502 = \"W\"\n"}});
  ASSERT_EQ(reply["ok"], true) << reply;
  EXPECT_EQ(reply["reply"]["text"], "8 values as in the file, changed: 2 tool offsets, 2 work offsets, 1 common variable, 1 name of a variable");
  const Json changes = client.call("changes")["reply"]["changes"];
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_EQ(changes[0]["service"], "tables.import");
  EXPECT_EQ(changes[0]["what"], "2 tool offsets, 2 work offsets, 1 common variable, 1 name of a variable");
  EXPECT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(exported(&client), before);
  EXPECT_EQ(client.call("changes")["reply"]["changes"].size(), 3u);
  const Json same = client.call("tables.import", {{"toml", before}});
  EXPECT_NE(same["reply"]["text"].get<std::string>().find("none of them another one than before"), std::string::npos) << same;
  EXPECT_EQ(client.call("changes")["reply"]["changes"].size(), 3u) << "nothing has changed";
  EXPECT_EQ(client.call("history.list", {{"kind", "change"}})["reply"]["entries"].size(), 3u);
}

// The first line of each is good, so that a half of the import would be seen.
TEST_F(TableToml, AllOfItOrNothing) {
  ServiceClient client(path_);
  const std::string before = exported(&client);
  const struct {
    const char *rest, *error, *said;
  } cases[] = {
      {"901 = 1", "malformed", "line 3: tool_offsets.901: must be an offset number from 1 to 200"},
      {"02 = 1\n2 = 1", "malformed", "line 4: tool_offsets.2: offset 2 is already there, first in line 3 as tool_offsets.02"},
      {"2 = 1\n02 = 1", "malformed", "line 4: tool_offsets.02: offset 2 is already there, first in line 3 as tool_offsets.2"},
      {"2 = 1\n3 = 1\n2 = 1\n4 = 1", "malformed", "line 5: Error while parsing key-value pair: cannot redefine existing integer '2', first in line 3"},
      {"2 = { length = 1, length = 2 }", "malformed", "existing integer 'length', first in line 3"},
      {"[variables]\n501 = 1\n500 = 1\n[work_offsets]\n[variables]\n500 = 1", "malformed", "line 7: Error while parsing table header: cannot redefine existing table 'variables', first in line 3"},
      {"2 = { size = 3 }", "malformed", "unknown key (known here: length, length_wear, name, pocket, radius, radius_wear)"},
      {"2 = { length = nan }", "malformed", "must be a finite number, not nan"},
      {"2 = { length = 1e7 }", "malformed", "line 3"},
      {"2 = \"long\"", "malformed", "line 3"},
      {"[work_offsets]\nG60 = { X = 1 }", "malformed", "line 4: work_offsets.G60: must be EXT, G54 to G59"},
      {"[work_offsets]\nG54 = { Q = 1 }", "malformed", "no axis \"Q\" is configured"},
      {"[work_offsets]\nG54 = { X = 1, X1 = 2 }", "malformed", "G54 of this axis is already there, also in this line as work_offsets.G54.X"},
      {"[variables]\n500 = true", "malformed", "must be a finite number, or \"vacant\", not a boolean"},
      {"[variables]\n500 = \"empty\"", "malformed", "vacant"},
      {"[variables]\nA = 1", "malformed", "must be the number of a common variable"},
      {"[variables]\n500 = 1\n0500 = 2", "malformed", "line 5: variables.0500: stands twice, first in line 4 as variables.500"},
      {"[variables]\n0500 = 1\n\n500 = 2", "malformed", "line 6: variables.500: stands twice, first in line 4 as variables.0500"},
      {"[variables]\n501 = 1\n500 = 1\n# two\n501 = 2\n", "malformed", "line 7: Error while parsing key-value pair: cannot redefine existing integer '501', first in line 4"},
      {"[variables]\n500 = 1\n5 = 2", "not found", "#5 of part system 1: there is no such common variable"},
      {"[variables]\n500 = 1\n5001 = 2", "not found", "#5001"},
      {"[variables]\n500 = 1e300", "malformed", "line 4: variables.500: must be -1e+15 to 1e+15, as with variables.set"},
      {"[variables]\n500 = -1.0000001e15", "malformed", "line 4: variables.500: must be"},
      {"[variables2]\n500 = 1", "malformed", "unknown key"},
      {"[variable_names]\n500 = \"lower\"", "malformed", "capital letters"},
      {"[variable_names]\n500 = \"TOOLONGX\"", "malformed", "capital letters"},
      {"[variable_names]\n499 = \"A\"", "malformed", "that can have a name"},
      {"[parameters]\n1078 = 1", "malformed", "unknown key (known here: tool_life, tool_offsets, variable_names, variables, work_offsets)"},
      {"[tool_offsets]\n2 = 1", "malformed", "line 3"},
      {"2 = ", "malformed", "line 3"},
      {"2 = \"\"\"a\"\"\"", "malformed", "several lines"},
  };
  for (const auto& c : cases) {
    const Json reply = client.call("tables.import", {{"toml", std::string("[tool_offsets]\n1 = 10.0\n") + c.rest + "\n"}});
    EXPECT_EQ(reply.value("error", ""), c.error) << c.rest << reply;
    EXPECT_NE(reply.value("text", "").find(c.said), std::string::npos) << c.rest << reply;
  }
  for (const char* none : {" ", "# nothing\n", "[tool_offsets]\n", "\xef\xbb\xbf"}) EXPECT_EQ(client.outcome("tables.import", {{"toml", none}}), "malformed") << none;
  EXPECT_EQ(client.outcome("tables.import"), "malformed");
  EXPECT_EQ(client.outcome("tables.export", {{"table", "everything"}}), "malformed");
  EXPECT_EQ(exported(&client), before);
  EXPECT_TRUE(client.call("changes")["reply"]["changes"].empty());
}

TEST_F(TableToml, RefusedWhileAProgramIsInExecution) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("control.take"), "");
  ASSERT_EQ(client.outcome("mode", {{"mode", "mdi"}}), "");
  ASSERT_EQ(client.outcome("mdi", {{"blocks", "G1 X100. F600."}}), "");
  ASSERT_EQ(client.outcome("start"), "");
  const Json reply = client.call("tables.import", {{"toml", "[tool_offsets]\n1 = 10\n"}});
  EXPECT_EQ(reply["error"], "refused");
  EXPECT_EQ(reply["text"], answer_text(Answer::kNotWhileRunning));
  EXPECT_EQ(client.outcome("tables.export"), "") << "reading is always possible";
  ASSERT_EQ(client.outcome("reset"), "");
  EXPECT_EQ(client.outcome("tables.import", {{"toml", "[tool_offsets]\n1 = 10\n"}}), "");
}

// The parser calls itself for each level: it must never come so deep that the stack of the thread ends.
TEST_F(TableToml, DepthIsBoundedBeforeItIsParsed) {
  ServiceClient client(path_);
  const auto deep = [](const char* open, const char* close, unsigned levels, const std::string& between = "") {
    std::string text = "x = ";
    for (unsigned i = 0; i < levels; ++i) text += open + between;
    text += "1";
    for (unsigned i = 0; i < levels; ++i) text += close;
    return text + "\n";
  };
  for (const unsigned levels : {9u, 255u, 5000u}) {
    for (const std::string& text : {deep("[", "]", levels), deep("{a = ", "}", levels), deep("[", "]", levels, "# ]\n"), deep("[", "]", levels, "\"]\",")}) {
      const Json reply = client.call("tables.import", {{"toml", text}});
      EXPECT_EQ(reply["error"], "malformed");
      EXPECT_NE(reply["text"].get<std::string>().find("too deep"), std::string::npos) << reply;
    }
  }
  std::string parts = "a";
  for (unsigned i = 0; i < 20000; ++i) parts += ".b";
  EXPECT_NE(client.call("tables.import", {{"toml", parts + " = 1\n"}})["text"].get<std::string>().find("too many parts"), std::string::npos);
  EXPECT_EQ(client.outcome("tables.import", {{"toml", "x = {a = \"\"\"\n\"\"\", " + parts + " = 1}\n"}}), "malformed");
  EXPECT_EQ(client.outcome("tables.import", {{"toml", "[tool_offsets]\n# [[[[[[[[[[[[ {{{{{{{{{{{{\n1 = 2 # \"[[[[[[[[[[[[\n"}}), "") << "brackets in a comment are none";
}

// As much as a request may hold.
TEST_F(TableToml, TheLargestTextIsTaken) {
  ServiceClient client(path_);
  std::string text = "[tool_offsets]\n1 = 2\n#";
  text += std::string(kMostToml - text.size(), 'x');
  EXPECT_EQ(client.outcome("tables.import", {{"toml", text}}), "");
  EXPECT_EQ(client.outcome("tables.import", {{"toml", text + "x"}}), "malformed");
  text = "[variables]\n";
  for (unsigned n = 1; text.size() + 9 < kMostToml; ++n) text += std::to_string(n) + "=1\n";  // as many keys as can be, most of them no variables
  EXPECT_EQ(client.outcome("tables.import", {{"toml", text}}), "not found");
}

class TwoSystems : public LocalMachine {
 protected:
  std::string machine_text() override {
    std::string text = LocalMachine::machine_text();
    return text.replace(text.find("[[point]]"), 0, "[[axis]]\nname = \"X\"\nsystem = 2\nmax_velocity = 100.0\nmax_acceleration = 1000.0\nmax_jerk = 50000.0\nsoft_limits = [-300.0, 300.0]\n");
  }
};

TEST_F(TwoSystems, EachHasItsOffsetsAndVariables) {
  ServiceClient client(path_);
  const auto exported = [&] { return client.call("tables.export")["reply"]["toml"].get<std::string>(); };
  const Json reply = client.call("tables.import", {{"toml", "[work_offsets]\nG54 = { X = 1, X2 = 2 }\n[variables]\n100 = 3\n500 = 5\n[variables2]\n100 = 4\n500 = 5\n"}});
  ASSERT_EQ(reply["ok"], true) << reply;
  const std::string text = exported();
  EXPECT_NE(text.find("\"G54\" = { X = 1, Y = 0, Z = 0, X2 = 2 }"), std::string::npos) << text;
  EXPECT_NE(text.find("[variables]\n100 = 3\n500 = 5\n\n[variables2]\n100 = 4\n500 = 5\n"), std::string::npos) << text;
  // #500 is one variable for both.
  const Json wrong = client.call("tables.import", {{"toml", "[variables]\n100 = 9\n500 = 6\n[variables2]\n500 = 7\n"}});
  EXPECT_EQ(wrong["error"], "malformed") << wrong;
  EXPECT_NE(wrong["text"].get<std::string>().find("given twice with different values"), std::string::npos) << wrong;
  EXPECT_EQ(exported(), text) << "what was written before it was found is given back";
}

}  // namespace
}  // namespace nc::rt::services
