// SPDX-License-Identifier: Apache-2.0
// Changes of tables are taken back: by whom, when it is refused, and behind a restart.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

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
  EXPECT_EQ(reply["ok"], true) << "what is set stays set, and it is said";
  EXPECT_NE(reply["reply"]["text"].get<std::string>().find("was not set before"), std::string::npos) << reply;
  EXPECT_EQ(keeper.call("parameters.list")["reply"]["parameters"][0]["value"], "1");
  EXPECT_EQ(keeper.outcome("parameters.undo"), "not found") << "nothing stands in the way of what was changed before it";
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
    file << R"({"after":"1","before":"0","cli)";
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

// A power cut: the changes are on the disk before their replies, the tables up to some seconds later.
class LostChanges : public Undo {
 protected:
  // Ends ncrtd in order; what it has kept is what a power cut will leave of these files.
  void keep(std::initializer_list<const char*> names) {
    stop();
    for (const char* name : names) std::filesystem::copy_file(folder_ + "/" + name, folder_ + "/kept." + name, std::filesystem::copy_options::overwrite_existing);
    kept_ = names;
    start();
  }
  void cut_the_power() {
    stop();
    for (const char* name : kept_) std::filesystem::rename(folder_ + "/kept." + name, folder_ + "/" + name);
    start();
  }
  std::vector<const char*> kept_;
};

TEST_F(LostChanges, UndoGoesOnBehindThem) {
  {
    ServiceClient client(path_);
    ASSERT_EQ(client.outcome("variables.set", {{"number", 501}, {"value", 1}}), "");
    ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"length", 10}}), "");
  }
  keep({"offsets", "variables"});
  {
    ServiceClient client(path_);
    ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"length", 20}}), "");
    ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"length", 30}}), "");
    ASSERT_EQ(client.outcome("variables.set", {{"number", 501}, {"value", 5}}), "");
  }
  cut_the_power();
  ServiceClient client(path_);
  ASSERT_EQ(length(&client, 3), 10) << "the test has done what it says";
  const Json changes = client.call("changes")["reply"]["changes"];
  for (unsigned n = 0; n < 5; ++n) EXPECT_EQ(changes[n]["lost"], n < 3) << changes[n];
  const Json named = client.call("undo", {{"change", 4}});
  EXPECT_EQ(named["error"], "refused");
  EXPECT_EQ(named["text"], "change 4 was lost before the last start: tool 3 length is as it was before it");
  const Json reply = client.call("undo");
  EXPECT_EQ(reply["reply"]["text"], "undo of 2: tool 3 length; lost before the last start, and so left out: 5 (#501 of part system 1), 4 (tool 3 length), 3 (tool 3 length)") << reply;
  EXPECT_EQ(length(&client, 3), 0);
  EXPECT_EQ(client.call("undo")["reply"]["text"], "undo of 1: #501 of part system 1") << "they are named once";
  EXPECT_TRUE(variable(&client, 501).is_null());
  EXPECT_EQ(client.outcome("undo"), "not found");
}

TEST_F(LostChanges, AreRememberedBehindTheNextStart) {
  ServiceClient(path_).outcome("tools.set", {{"number", 3}, {"length", 10}});
  keep({"offsets"});
  ServiceClient(path_).outcome("tools.set", {{"number", 3}, {"length", 20}});
  cut_the_power();
  ServiceClient(path_).outcome("tools.set", {{"number", 3}, {"length", 40}});
  stop();
  start();
  ServiceClient client(path_);
  EXPECT_EQ(client.call("undo")["reply"]["text"], "undo of 3: tool 3 length");
  EXPECT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(length(&client, 3), 0) << "2 was lost under the change that came behind it";
}

TEST_F(LostChanges, AnUndoThatIsLostIsDoneAgain) {
  {
    ServiceClient client(path_);
    ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"length", 10}}), "");
    ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"length", 20}}), "");
  }
  keep({"offsets"});
  ASSERT_EQ(ServiceClient(path_).outcome("undo"), "");
  cut_the_power();
  ServiceClient client(path_);
  ASSERT_EQ(length(&client, 3), 20);
  EXPECT_EQ(client.call("changes")["reply"]["changes"][1]["undone_by"], 0);
  EXPECT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(length(&client, 3), 10);
  EXPECT_EQ(newest(&client)["what"], "undo of 2: tool 3 length");
  EXPECT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(length(&client, 3), 0);
}

TEST_F(LostChanges, AnUndoIsDoneAgainThatIsLostWithWhatCameBehindIt) {
  for (const int length : {10, 20}) ASSERT_EQ(ServiceClient(path_).outcome("tools.set", {{"number", 3}, {"length", length}}), "");
  keep({"offsets"});
  ASSERT_EQ(ServiceClient(path_).outcome("undo"), "");
  ASSERT_EQ(ServiceClient(path_).outcome("tools.set", {{"number", 3}, {"length", 30}}), "");
  cut_the_power();
  ServiceClient client(path_);
  ASSERT_EQ(length(&client, 3), 20);
  EXPECT_EQ(client.call("undo")["reply"]["text"], "undo of 2: tool 3 length; lost before the last start, and so left out: 4 (tool 3 length)");
  EXPECT_EQ(length(&client, 3), 10);
  EXPECT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(length(&client, 3), 0);
}

// Of an undo that has two files one was written in time: the other half of what it has taken back is taken back then.
TEST_F(LostChanges, TheHalfOfAnUndoThatIsLostIsDoneAgain) {
  ASSERT_EQ(ServiceClient(path_).outcome("tools.set", {{"number", 3}, {"length", 10}, {"pocket", 4}}), "");
  ASSERT_EQ(ServiceClient(path_).outcome("tools.set", {{"number", 3}, {"length", 20}, {"pocket", 7}}), "");
  keep({"offsets.tools"});
  ASSERT_EQ(ServiceClient(path_).outcome("undo"), "");
  cut_the_power();
  ServiceClient client(path_);
  const auto tool = [&] { return client.call("tools.list", {{"from", 3}, {"count", 1}})["reply"]["tools"][0]; };
  ASSERT_EQ(tool()["length"], 10);
  ASSERT_EQ(tool()["pocket"], 7);
  EXPECT_EQ(client.call("undo")["reply"]["text"], "undo of 2: tool 3 pocket");
  EXPECT_EQ(tool()["pocket"], 4);
  EXPECT_EQ(tool()["length"], 10);
  EXPECT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(tool()["length"], 0);
  EXPECT_EQ(tool()["pocket"], 0);
  EXPECT_EQ(client.outcome("undo"), "not found");
}

// Whatever was changed and taken back, and whatever a power cut has left of the files: undo after undo leads to what was there at the beginning.
TEST_F(LostChanges, UndoLeadsToTheBeginningBehindAnyCut) {
  const char* of_environment = std::getenv("NC_SEEDS");
  const unsigned seeds = of_environment == nullptr ? 12 : static_cast<unsigned>(std::atoi(of_environment));
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto any = [&](unsigned least, unsigned most) { return least + random() % (most - least + 1); };
    const auto change = [&](unsigned count) {
      ServiceClient client(path_);
      for (unsigned n = 0; n < count; ++n) {
        const unsigned what = any(0, 5), number = any(1, 3);
        if (what < 2) client.call("tools.set", {{"number", number}, {"length", any(1, 1000)}, {"pocket", 3 * any(1, 3000) + number}});
        else if (what == 2) client.call("tools.set", {{"number", number}, {"length", any(1, 1000)}});
        else if (what == 3) client.call("variables.set", {{"number", 500 + number}, {"value", any(1, 1000)}});
        else client.call("undo");
      }
    };
    change(any(1, 12));
    ServiceClient(path_).call("variables.set", {{"number", 510}, {"value", seed}});  // so that each of the files is there
    ServiceClient(path_).call("tools.set", {{"number", 5}, {"length", seed}, {"pocket", 9990}});
    switch (any(0, 3)) {
      case 0: keep({"offsets"}); break;
      case 1: keep({"offsets.tools"}); break;
      case 2: keep({"offsets", "variables"}); break;
      default: keep({"offsets", "offsets.tools", "variables"}); break;
    }
    change(any(1, 12));
    cut_the_power();
    ServiceClient client(path_);
    std::string outcome;
    while (outcome.empty()) {
      const Json reply = client.call("undo");
      outcome = reply.value("error", "");
      EXPECT_NE(outcome, "refused") << reply << "\n" << client.call("changes")["reply"].dump(1);
    }
    for (unsigned number = 1; number <= 3; ++number) {
      const Json tool = client.call("tools.list", {{"from", number}, {"count", 1}})["reply"]["tools"][0];
      EXPECT_EQ(tool["length"], 0) << tool;
      EXPECT_EQ(tool["pocket"], 0) << tool;
      EXPECT_TRUE(variable(&client, 500 + number).is_null());
    }
    client.leave();
    stop();
    for (const char* file : {"changes", "offsets", "offsets.old", "offsets.tools", "offsets.tools.old", "variables", "variables.old"}) std::filesystem::remove(folder_ + "/" + file);
    start();
  }
}

// Values of one change stand in two files, of which one was written in time.
TEST_F(LostChanges, WhatIsLeftOfAChangeIsTakenBack) {
  ServiceClient(path_).outcome("tools.set", {{"number", 3}, {"length", 10}, {"pocket", 4}});
  keep({"offsets"});
  ServiceClient(path_).outcome("tools.set", {{"number", 3}, {"length", 20}, {"pocket", 7}});
  cut_the_power();
  ServiceClient client(path_);
  const auto tool = [&] { return client.call("tools.list", {{"from", 3}, {"count", 1}})["reply"]["tools"][0]; };
  ASSERT_EQ(tool()["length"], 10);
  ASSERT_EQ(tool()["pocket"], 7);
  EXPECT_EQ(client.call("changes")["reply"]["changes"][0]["lost"], false) << "not all of it";
  EXPECT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(tool()["pocket"], 4);
  EXPECT_EQ(tool()["length"], 10);
  EXPECT_EQ(client.outcome("undo"), "");
  EXPECT_EQ(tool()["length"], 0);
}

// What a program has set is not lost, also behind a start.
TEST_F(LostChanges, WhatAProgramHasSetIsNone) {
  {
    ServiceClient client(path_);
    ASSERT_EQ(client.outcome("variables.set", {{"number", 501}, {"value", 1}}), "");
    ASSERT_EQ(client.outcome("control.take"), "");
    ASSERT_EQ(client.outcome("mode", {{"mode", "mdi"}}), "");
    ASSERT_EQ(client.outcome("mdi", {{"blocks", "#501=2"}}), "");
    ASSERT_EQ(client.outcome("start"), "");
    until(&client, "status", [](const Json& now) { return now["systems"][0]["runs"] == 1; });
  }
  stop();
  start();
  ServiceClient client(path_);
  EXPECT_EQ(client.call("changes")["reply"]["changes"][0]["lost"], false);
  EXPECT_EQ(client.outcome("undo"), "refused");
  EXPECT_EQ(variable(&client, 501), 2);
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
  ASSERT_NE(log.find(6), nullptr) << "the last one that she can take back is remembered behind any number of others";
  EXPECT_EQ(log.last_of("anna", Right::kSetUp)->number, 6u);
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
