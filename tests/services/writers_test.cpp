// SPDX-License-Identifier: Apache-2.0
// Which program has written a value of a table, and when: in the lists, over a restart, behind a power cut, with what users change in between.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "runtime/retain/writers.hpp"
#include "runtime/share/text.hpp"
#include "services/local_machine.hpp"

namespace nc::rt::services {
namespace {

using test::LocalMachine;
using test::ServiceClient;

class Writers : public LocalMachine {
 protected:
  void run_to_the_end(ServiceClient* client) {
    const auto runs = client->call("status")["reply"]["systems"][0]["runs"].get<std::uint64_t>();
    const Json begun = client->call("start");
    ASSERT_EQ(begun["ok"], true) << begun << client->call("alarms");
    until(client, "status", [runs](const Json& now) { return now["systems"][0]["runs"] == runs + 1; });
  }
  void run_program(ServiceClient* client, const std::string& name, const std::string& text) {
    write_program(name, text);
    ASSERT_EQ(client->outcome("control.take"), "");
    ASSERT_EQ(client->outcome("mode", {{"mode", "auto"}}), "");
    ASSERT_EQ(client->outcome("select", {{"name", name}}), "");
    run_to_the_end(client);
  }
  void run_blocks(ServiceClient* client, const std::string& blocks) {
    ASSERT_EQ(client->outcome("control.take"), "");
    ASSERT_EQ(client->outcome("mode", {{"mode", "mdi"}}), "");
    ASSERT_EQ(client->outcome("mdi", {{"blocks", blocks}}), "");
    run_to_the_end(client);
  }
  // Who, and whether the time is one from `began_` to now.
  std::string who(ServiceClient* client, const char* list, const Json& args, const char* member, unsigned row = 0) {
    const Json found = client->call(list, args)["reply"][member][row];
    const auto when = found["changed_ns"].get<std::int64_t>();
    return found["changed_by"].get<std::string>() + (when == 0 ? ", nobody knows when" : when < began_ || when > share::wall_ns() ? ", at another time" : "");
  }
  std::string who_variable(ServiceClient* client, unsigned number) { return who(client, "variables.list", {{"from", number}, {"count", 1}}, "variables"); }
  std::string who_tool(ServiceClient* client, unsigned number) { return who(client, "tools.list", {{"from", number}, {"count", 1}}, "tools"); }
  std::string who_offset(ServiceClient* client, unsigned place) { return who(client, "offsets.list", {{"from", place}, {"count", 1}}, "offsets"); }
  std::string who_parameter(ServiceClient* client, const std::string& key) {
    const Json rows = client->call("parameters.list")["reply"]["parameters"];
    for (unsigned row = 0; row < rows.size(); ++row)
      if (rows[row]["key"] == key) return who(client, "parameters.list", Json::object(), "parameters", row);
    return "not set";
  }
  // Each of the tables that a program can write.
  static constexpr char kWritesAll[] = "#501=7\nSETVN501[DEPTH]\nG10 L10 P3 R81.25\nG10 L2 P1 X12.5\nG10 L70\nP8013 D2\nG11\nM30\n";
  std::int64_t began_ = share::wall_ns();
};

TEST_F(Writers, AProgramIsNamedWithTheTimeInEachTable) {
  ServiceClient client(path_);
  run_program(&client, "part.nc", kWritesAll);
  EXPECT_EQ(who_variable(&client, 501), "program part.nc");
  EXPECT_EQ(who_tool(&client, 3), "program part.nc");
  EXPECT_EQ(who_offset(&client, 1), "program part.nc");
  EXPECT_EQ(who_parameter(&client, "8013"), "program part.nc");
  EXPECT_EQ(who_tool(&client, 4), ", nobody knows when") << "nobody has changed it";
}

TEST_F(Writers, WhoComesLaterIsNamed) {
  ServiceClient client(path_);
  run_program(&client, "first.nc", "#501=1 #502=1 #503=1\nM30\n");
  run_program(&client, "second.nc", "#502=2 #503=2\nM30\n");
  run_blocks(&client, "#503=3");
  EXPECT_EQ(who_variable(&client, 501), "program first.nc");
  EXPECT_EQ(who_variable(&client, 502), "program second.nc");
  EXPECT_EQ(who_variable(&client, 503), "MDI blocks");
  const std::string user = client.call("history.list", {{"kind", "action"}})["reply"]["entries"][0]["user"];
  ASSERT_EQ(client.outcome("variables.set", {{"number", 502}, {"value", 5}}), "");
  EXPECT_EQ(who_variable(&client, 502), user);
  run_program(&client, "third.nc", "#502=4\nM30\n");
  EXPECT_EQ(who_variable(&client, 502), "program third.nc");
  run_program(&client, "third.nc", "#502=5\nM30\n");
  EXPECT_EQ(who_variable(&client, 502), "program third.nc") << "the value of the user was written again, and not by him";
}

// The change comes right behind the program, before the feeder looks by itself.
TEST_F(Writers, AChangeBehindAProgramLeavesWhatTheProgramHasWritten) {
  ServiceClient client(path_);
  for (unsigned n = 1; n <= 20; ++n) {
    const std::string name = "part" + std::to_string(n) + ".nc";
    run_program(&client, name, "#501=" + std::to_string(n) + "\n#502=" + std::to_string(n) + "\nM30\n");
    ASSERT_EQ(client.outcome("variables.set", {{"number", 502}, {"value", 100 + n}}), "");
    ASSERT_EQ(who_variable(&client, 501), "program " + name);
    ASSERT_EQ(who_variable(&client, 502).find("program"), std::string::npos);
  }
}

TEST_F(Writers, ItIsKeptOverARestart) {
  {
    ServiceClient client(path_);
    run_program(&client, "part.nc", kWritesAll);
    ASSERT_EQ(client.outcome("variables.set", {{"number", 502}, {"value", 1}}), "");
  }
  stop();
  start();
  ServiceClient client(path_);
  EXPECT_EQ(who_variable(&client, 501), "program part.nc");
  EXPECT_EQ(who_tool(&client, 3), "program part.nc");
  EXPECT_EQ(who_offset(&client, 1), "program part.nc");
  EXPECT_EQ(who_parameter(&client, "8013"), "program part.nc");
  EXPECT_EQ(who_variable(&client, 502).find("program"), std::string::npos);
}

// The files of the values and that of the writers are of different moments: nobody is named for a value that he has not written.
TEST_F(Writers, BehindAPowerCutNobodyIsNamedForAnotherValue) {
  {
    ServiceClient client(path_);
    run_program(&client, "early.nc", "#501=1\nM30\n");
  }
  stop();
  std::filesystem::copy_file(folder_ + "/changes.programs", folder_ + "/kept");
  start();
  {
    ServiceClient client(path_);
    run_program(&client, "late.nc", "#501=2\nM30\n");
  }
  stop();
  std::filesystem::copy_file(folder_ + "/kept", folder_ + "/changes.programs", std::filesystem::copy_options::overwrite_existing);
  std::filesystem::remove(folder_ + "/changes.programs.old");
  start();
  ServiceClient client(path_);
  EXPECT_EQ(who_variable(&client, 501), "program, nobody knows when");
}

// No machine stands because it is not known who has written a value.
TEST_F(Writers, ADamagedFileIsToldAndIsNoAlarm) {
  stop();
  for (const char* name : {"/changes.programs", "/changes.programs.old"}) std::ofstream(folder_ + name) << "x";
  start();
  bool told = false;
  for (const std::string& warning : runtime_->warnings()) told |= warning.find("which program has written what") != std::string::npos;
  EXPECT_TRUE(told);
  ServiceClient client(path_);
  EXPECT_EQ(client.call("alarms")["reply"]["alarms"].size(), 0u);
  run_program(&client, "part.nc", "#501=1\nM30\n");
  EXPECT_EQ(who_variable(&client, 501), "program part.nc");
  EXPECT_TRUE(std::filesystem::exists(folder_ + "/changes.programs.damaged"));
}

// M700 12.4.4: blocks of MDI interrupt the program in a block stop, and a macro that they call is theirs, too.
TEST_F(Writers, BlocksOfMdiInABlockStopAreNotTheProgram) {
  ServiceClient client(path_);
  write_program("O7001", "#504=4\nM99\n");
  write_program("part.nc", "#501=1\nG10 L10 P3 R1.\nM0\n#502=2\nM30\n");
  ASSERT_EQ(client.outcome("control.take"), "");
  ASSERT_EQ(client.outcome("mode", {{"mode", "auto"}}), "");
  ASSERT_EQ(client.outcome("select", {{"name", "part.nc"}}), "");
  ASSERT_EQ(client.outcome("start"), "");
  until(&client, "status", [](const Json& now) { return now["systems"][0]["state"] == "stopped"; });
  ASSERT_EQ(client.outcome("mode", {{"mode", "mdi"}}), "");
  ASSERT_EQ(client.outcome("mdi", {{"blocks", "#503=3\nG65 P7001\nG10 L10 P4 R2.\nG1 X1. F3000.\n"}}), "");
  ASSERT_EQ(client.outcome("start"), "");
  while (client.outcome("mode", {{"mode", "auto"}}) == "refused") usleep(5000);  // until they have come to their end
  run_to_the_end(&client);
  EXPECT_EQ(who_variable(&client, 501), "program part.nc");
  EXPECT_EQ(who_variable(&client, 502), "program part.nc");
  EXPECT_EQ(who_variable(&client, 503), "MDI blocks");
  EXPECT_EQ(who_variable(&client, 504), "MDI blocks");
  EXPECT_EQ(who_tool(&client, 3), "program part.nc");
  EXPECT_EQ(who_tool(&client, 4), "MDI blocks");
}

std::string names_of_variables(unsigned count, const std::string& name) {
  std::string bytes;
  const auto put = [&bytes](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(std::uint32_t{count});
  for (std::uint32_t number = 0; number < count; ++number) {
    put(std::uint32_t{500 + number});
    put(static_cast<double>(name.size()));
  }
  put(std::uint32_t{0});
  return bytes;
}

TEST(WriterTable, TheOldestRowsGoAndTheFileHasRoom) {
  WriterTable table({});
  WriterTable::Ran ran;
  table.look(names_of_variables(0, ""), "tool 1 0=1\n", ran, 1);
  ran.by[0] = "program old.nc";
  table.look(names_of_variables(0, ""), "tool 1 0=2\n", ran, 2);
  Written written;
  ASSERT_TRUE(table.find("tool 1 0", &written));
  for (unsigned round = 0; round < 3; ++round) {
    ran.by[0] = "program " + std::string(120 + round, 'n');
    table.look(names_of_variables(WriterTable::kMostRows + 100, ran.by[0]), "tool 1 0=2\n", ran, 3 + round);
    EXPECT_LT(table.encode().size(), 1u << 20);
  }
  EXPECT_FALSE(table.find("tool 1 0", &written));
  WriterTable again({});
  EXPECT_TRUE(again.restore(table.encode()));
  EXPECT_EQ(again.encode(), table.encode());
}

TEST(WriterTable, WhereSeveralPartSystemsRunAllAreNamed) {
  WriterTable table({});
  WriterTable::Ran ran;
  table.look("", "tool 1 0=1\nwork 1 1 X=1\n", ran, 1);
  ran.by[0] = "program a.nc";
  ran.by[1] = "program b.nc";
  table.look("", "tool 1 0=2\nwork 1 1 X=2\n", ran, 2);
  Written written;
  ASSERT_TRUE(table.find("tool 1 0", &written));
  EXPECT_EQ(written.by, "program a.nc or program b.nc");
  ASSERT_TRUE(table.find("work 1 1 X", &written));
  EXPECT_EQ(written.by, "program b.nc");
  table.look("", "tool 1 0=3\nwork 1 1 X=2\n", {}, 3);
  ASSERT_TRUE(table.find("tool 1 0", &written));
  EXPECT_EQ(written.by, "machine");
  table.look_behind_change("", "tool 1 0=4\nwork 1 1 X=2\n");
  EXPECT_FALSE(table.find("tool 1 0", &written));
}

// The files of the tables are copies of one moment, and so is what is kept of their writers: a later value has no part in it.
TEST(WriterTable, WhatIsKeptBelongsToTheValuesThatAreKept) {
  WriterTable table({});
  WriterTable::Ran ran;
  table.look(names_of_variables(1, "a"), "tool 1 0=1\n", ran, 1);
  ran.by[0] = "program part.nc";
  table.look(names_of_variables(1, "ab"), "tool 1 0=2\n", ran, 2);
  table.keep(true);
  table.look(names_of_variables(1, "abc"), "tool 1 0=3\n", ran, 3);
  table.keep(false);
  table.look(names_of_variables(1, "abcd"), "tool 1 0=4\n", ran, 4);
  WriterTable again({});
  ASSERT_TRUE(again.restore(table.encode_kept()));
  Written written;
  ASSERT_TRUE(again.find("variable 0 500", &written));
  EXPECT_EQ(written.value, "2");
  ASSERT_TRUE(again.find("tool 1 0", &written));
  EXPECT_EQ(written.value, "3");
  ASSERT_TRUE(again.restore(table.encode()));
  ASSERT_TRUE(again.find("tool 1 0", &written));
  EXPECT_EQ(written.value, "4");
}

TEST(WriterTable, WhatMakesNoSenseIsRefused) {
  WriterTable table({});
  for (const char* bytes : {"", "x", "nc writers 1\n", "nc writers 1\nend", "nc writers 1\na\nb\nc\nend\n", "nc writers 1\na\n1 \nc\nend\n", "nc writers 1\na\n1x by\nc\nend\n", "nc writers 2\nend\n"}) EXPECT_FALSE(table.restore(bytes)) << bytes;
  EXPECT_TRUE(table.restore("nc writers 1\na\n1 by whom\nc\nend\n"));
}

}  // namespace
}  // namespace nc::rt::services
