// SPDX-License-Identifier: Apache-2.0
// The memory of a machine that runs: what the scan tells, what operators do, and what is left of it behind a restart.
#include "runtime/history/recorder.hpp"

#include <gtest/gtest.h>

#include "runtime/services/change_log.hpp"
#include "services/local_machine.hpp"

namespace nc::rt::history {
namespace {

using services::Json;
using services::Right;
using test::LocalMachine;
using test::ServiceClient;

class MachineHistory : public LocalMachine {
 protected:
  // The entries of a kind, the newest first.
  static Json entries(ServiceClient* client, const Json& args) {
    const Json reply = client->call("history.list", args);
    EXPECT_EQ(reply["ok"], true) << reply;
    return reply["ok"] == true ? reply["reply"]["entries"] : Json::array();
  }
  void run_program(ServiceClient* client, const std::string& name) {
    ASSERT_EQ(client->outcome("control.take", {{"lease_ms", 60000}}), "");
    ASSERT_EQ(client->outcome("mode", {{"mode", "auto"}}), "");
    ASSERT_EQ(client->outcome("select", {{"name", name}}), "");
    const std::uint64_t runs = client->call("status")["reply"]["systems"][0]["runs"].get<std::uint64_t>();
    ASSERT_EQ(client->outcome("start"), "");
    until(client, "status", [&](const Json& now) { return now["systems"][0]["runs"].get<std::uint64_t>() > runs || now["alarms"] != 0; });
  }
};

// A client may ask before the thread that writes has opened the file.
TEST_F(MachineHistory, CountsOverAllStartsFromTheFirstRequestOn) {
  write_program("good.nc", "G4 X.3\nM30\n");
  {
    ServiceClient client(path_);
    run_program(&client, "good.nc");
  }
  history_->stop();
  Recorder next(runtime_.get(), programs_.get(), config_.history_path(), StoreLimits{}, [](const std::string& what) { ADD_FAILURE() << what; });
  std::vector<Counter> counters;
  std::string error;
  ASSERT_TRUE(next.counters(&counters, &error)) << error;
  double running = 0;
  for (const Counter& counter : counters)
    if (counter.name == "running") running = counter.value;
  EXPECT_GE(running, 0.3);
  ASSERT_TRUE(next.start(&error)) << error;
  next.stop();
}

TEST_F(MachineHistory, RemembersRunsAlarmsAndWhoHasDoneWhatBehindARestart) {
  const std::string me = services::user_name(geteuid());
  write_program("good.nc", "G0 X1.\nG4 X.3\nM30\n");
  write_program("bad.nc", "G0 X2.\nG999\nM30\n");
  {
    ServiceClient client(path_);
    run_program(&client, "good.nc");
    run_program(&client, "good.nc");
    run_program(&client, "bad.nc");
    until(&client, "history.list", [](const Json& now) { return !now["entries"].empty() && now["entries"].dump().find("\"alarm\"") != std::string::npos; });
    ASSERT_EQ(client.outcome("reset"), "");
    ASSERT_EQ(client.outcome("tools.set", {{"number", 3}, {"length", 81.25}}), "");
    EXPECT_EQ(client.outcome("override.feed", {{"percent", 900}}), "malformed");
    EXPECT_EQ(entries(&client, {{"kind", "system"}})[0]["code"], "begin");
  }
  stop();
  start();
  ServiceClient client(path_);
  const Json runs = entries(&client, {{"kind", "run"}});
  ASSERT_EQ(runs.size(), 3u) << runs;
  EXPECT_EQ(runs[0]["program"], "bad.nc");
  EXPECT_EQ(runs[0]["outcome"], "alarm");
  EXPECT_EQ(runs[2]["program"], "good.nc");
  EXPECT_EQ(runs[2]["outcome"], "completed");
  EXPECT_GE(runs[2]["seconds"].get<double>(), 0.3);
  EXPECT_GE(runs[2]["end_ns"].get<std::int64_t>(), runs[2]["time_ns"].get<std::int64_t>() + 300'000'000);
  const Json alarms = entries(&client, {{"kind", "alarm"}});
  ASSERT_GE(alarms.size(), 1u);
  EXPECT_NE(alarms[0]["code"], "");
  EXPECT_EQ(alarms[0]["line"], 2);
  EXPECT_GT(alarms[0]["end_ns"].get<std::int64_t>(), alarms[0]["time_ns"].get<std::int64_t>()) << "the reset has ended it";
  const Json starts = entries(&client, {{"kind", "action"}, {"user", me}});
  unsigned started = 0;
  for (const Json& action : starts) {
    started += action["service"] == "start" ? 1 : 0;
    EXPECT_NE(action["client"], "");
    EXPECT_NE(action["service"], "control.take") << "only control that is refused is written";
  }
  EXPECT_EQ(started, 3u) << starts;
  EXPECT_TRUE(entries(&client, {{"user", "nobody-has-this-name"}}).empty());
  const Json changes = entries(&client, {{"kind", "change"}});
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0]["service"], "tools.set");
  EXPECT_EQ(changes[0]["user"], me);
  EXPECT_NE(changes[0]["text"].get<std::string>().find("81.25"), std::string::npos);
  const Json systems = entries(&client, {{"kind", "system"}});
  ASSERT_EQ(systems.size(), 3u);
  EXPECT_EQ(systems[1]["code"], "end");
  EXPECT_EQ(systems[0]["outcome"], "") << "it has ended cleanly";
  const Json programs = client.call("history.programs")["reply"]["programs"];
  ASSERT_EQ(programs.size(), 1u) << programs;
  EXPECT_EQ(programs[0]["name"], "good.nc");
  EXPECT_EQ(programs[0]["runs"], 2);
  EXPECT_GE(programs[0]["shortest_s"].get<double>(), 0.3);
  const Json counters = client.call("history.counters")["reply"]["counters"];
  for (const Json& counter : counters) {
    if (counter["name"] == "runs") {
      EXPECT_EQ(counter["value"], 2);
    }
    if (counter["name"] == "running") {
      EXPECT_GE(counter["value"].get<double>(), 0.6);
    }
    if (counter["name"] == "alarms") {
      EXPECT_GE(counter["value"].get<double>(), 1);
    }
    if (counter["name"] == "on") {
      EXPECT_GE(counter["value"].get<double>(), 0.6);
    }
  }
}

// Who counts parts by `runs` counts none that an alarm has ended. When the reset comes decides whether the control sees such a run come to its end, so many are tried.
TEST_F(MachineHistory, AProgramThatAnAlarmHasEndedIsNoRunThatCameToItsEnd) {
  write_program("good.nc", "G0 X1.\nM30\n");
  write_program("bad.nc", "G0 X2.\nG999\nM30\n");
  ServiceClient client(path_);
  const auto runs = [&] { return client.call("status")["reply"]["systems"][0]["runs"]; };
  run_program(&client, "good.nc");
  EXPECT_EQ(runs(), 1);
  for (int n = 0; n < 20; ++n) {
    ASSERT_EQ(client.outcome("select", {{"name", "bad.nc"}}), "");
    (void)client.call("start");
    until(&client, "status", [](const Json& now) { return now["alarms"] != 0; });
    ASSERT_EQ(client.outcome("reset"), "");
    until(&client, "status", [](const Json& now) { return now["alarms"] == 0 && now["systems"][0]["state"] == "idle"; });
  }
  EXPECT_EQ(runs(), 1);
  run_program(&client, "good.nc");
  EXPECT_EQ(runs(), 2);
}

TEST_F(MachineHistory, WhatIsRefusedIsWrittenAndARepetitionOnce) {
  ServiceClient one(path_), two(path_);
  ASSERT_EQ(one.outcome("control.take", {{"lease_ms", 60000}}), "");
  for (unsigned i = 0; i < 20; ++i) EXPECT_EQ(two.outcome("mode", {{"mode", "mdi"}}), "no control");
  ASSERT_EQ(one.outcome("mode", {{"mode", "manual"}}), "");
  for (unsigned i = 0; i < 20; ++i) ASSERT_EQ(one.outcome("jog", {{"axis", "X"}, {"velocity", 5}}), "");
  ASSERT_EQ(one.outcome("jog", {{"axis", "X"}, {"velocity", 0}}), "");
  unsigned refused = 0, jogs = 0;
  for (const Json& action : entries(&one, {{"kind", "action"}})) {
    refused += action["client"] == two.greeting["client"] ? 1 : 0;
    jogs += action["service"] == "jog" ? 1 : 0;
    if (action["service"] == "mode" && action["client"] == two.greeting["client"]) {
      EXPECT_EQ(action["text"], "mdi");
      EXPECT_EQ(action["outcome"].get<std::string>().rfind("refused: ", 0), 0u) << action;
    }
  }
  EXPECT_GE(refused, 1u);
  EXPECT_LE(refused, 3u);  // on a slow computer more than a second may be between two of them
  EXPECT_GE(jogs, 2u);
  EXPECT_LE(jogs, 6u);
}

TEST_F(MachineHistory, WhoHasNotTheRightIsWrittenOnceInAMinute) {
  give({Right::kView});
  ServiceClient viewer(path_);
  for (unsigned i = 0; i < 30; ++i) EXPECT_EQ(viewer.outcome("start"), "no right");
  give({});
  ServiceClient nobody(path_);
  EXPECT_EQ(nobody.greeting["ok"], false);
  const Json actions = until(&viewer, "history.list", [](const Json& now) { return now["entries"].dump().find("no right") != std::string::npos; })["entries"];
  unsigned denied = 0;
  for (const Json& action : actions)
    if (action["kind"] == "action") {
      ++denied;
      EXPECT_EQ(action["service"], "start");
      EXPECT_EQ(action["user"], services::user_name(geteuid()));
    }
  EXPECT_EQ(denied, 1u) << actions;
}

TEST_F(MachineHistory, BadRequestsAreRefused) {
  ServiceClient client(path_);
  EXPECT_EQ(client.outcome("history.list", {{"kind", "song"}}), "malformed");
  EXPECT_EQ(client.outcome("history.list", {{"since", 1e12}}), "malformed");
  EXPECT_EQ(client.outcome("history.list", {{"since", -1}}), "malformed");
  EXPECT_EQ(client.outcome("history.list", {{"user", ""}}), "malformed");
  EXPECT_EQ(client.outcome("history.list", {{"user", "' OR 1 --"}}), "");
  EXPECT_EQ(client.outcome("history.list", {{"count", 501}}), "malformed");
  EXPECT_EQ(client.outcome("history.counters", {{"from", 1}}), "malformed");
}

TEST_F(MachineHistory, PagesAreWholeAndFollowEachOther) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("control.take", {{"lease_ms", 60000}}), "");
  for (unsigned i = 0; i < 40; ++i) ASSERT_EQ(client.outcome("override.feed", {{"percent", 50 + i}}), "");
  std::uint64_t from = 0, last = ~0ull, count = 0;
  do {
    const Json reply = client.call("history.list", {{"from", from}, {"count", 7}})["reply"];
    for (const Json& entry : reply["entries"]) {
      EXPECT_LT(entry["number"].get<std::uint64_t>(), last);
      last = entry["number"].get<std::uint64_t>();
      ++count;
    }
    from = reply["next"].get<std::uint64_t>();
  } while (from != 0);
  EXPECT_EQ(last, 1u);
  EXPECT_GE(count, 41u);
}

TEST_F(MachineHistory, ADamagedFileIsSaidAndANewOneBegins) {
  stop();
  std::ofstream(folder_ + "/history", std::ios::binary | std::ios::trunc) << std::string(50'000, 'x');
  start();
  ServiceClient client(path_);
  const Json systems = until(&client, "history.list", [](const Json& now) { return !now["entries"].empty(); })["entries"];
  EXPECT_NE(systems.dump().find("damaged-1"), std::string::npos) << systems;
  const std::lock_guard lock(mutex_);
  EXPECT_NE(said_.find("damaged-1"), std::string::npos) << said_;
}

TEST_F(MachineHistory, WithoutAFileTheMachineRunsOnAndSaysWhy) {
  stop();
  std::filesystem::remove(folder_ + "/history");
  std::filesystem::create_directory(folder_ + "/history");
  start();
  {
    ServiceClient client(path_);
    ASSERT_EQ(client.outcome("control.take", {{"lease_ms", 60000}}), "");
    EXPECT_EQ(client.outcome("mode", {{"mode", "mdi"}}), "");
    const Json refused = client.call("history.list");
    EXPECT_EQ(refused["error"], "failed");
    EXPECT_NE(refused["text"].get<std::string>().find("/history"), std::string::npos) << refused;
    EXPECT_EQ(client.outcome("history.counters"), "") << "they are counted all the same";
    EXPECT_EQ(client.outcome("status"), "");
  }
  const std::lock_guard lock(mutex_);
  EXPECT_NE(said_.find("is not written"), std::string::npos) << said_;
}

}  // namespace
}  // namespace nc::rt::history
