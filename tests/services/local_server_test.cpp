// SPDX-License-Identifier: Apache-2.0
// The socket: rights of each service, two that want control, clients that are killed, slow, or send garbage.
#include "runtime/services/local_server.hpp"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <atomic>
#include <chrono>
#include <set>
#include <thread>

#include "services/local_machine.hpp"
#include "services/service_arguments.hpp"

namespace nc::rt::services {
namespace {

using test::arguments_of;
using test::LocalMachine;
using test::ServiceClient;

class LocalServices : public LocalMachine {};

TEST_F(LocalServices, EveryServiceIsRefusedToEveryOneWithoutItsRight) {
  unsigned refused = 0, let = 0;
  for (unsigned bits = 1; bits < 1u << kRightCount; ++bits) {
    RightSet rights;
    for (unsigned right = 0; right < kRightCount; ++right)
      if ((bits >> right & 1u) != 0) rights.add(static_cast<Right>(right));
    {
      const std::lock_guard lock(mutex_);
      rights_ = rights;
    }
    ServiceClient client(path_);
    ASSERT_EQ(client.greeting["ok"], true);
    for (const ServiceRow& row : service_table()) {
      SCOPED_TRACE(std::string(row.name) + " with " + client.greeting["rights"].dump());
      const Json reply = client.call(row.name, arguments_of(row));
      ASSERT_FALSE(reply.is_null());
      const bool lacks = reply["ok"] == false && reply["error"] == "no right";
      EXPECT_EQ(lacks, !rights.has(row.right) || (row.and_right && !rights.has(*row.and_right))) << reply;
      // The pieces of a program that was begun before it are not right, which is asked for after the right.
      const bool piece = row.service == Service::kProgramData || row.service == Service::kProgramFinish;
      EXPECT_TRUE(piece || reply.value("error", "") != "malformed") << reply;
      if (lacks) {
        EXPECT_NE(reply["text"].get<std::string>().find(right_name(row.right)), std::string::npos);
        if (row.and_right) {
          EXPECT_NE(reply["text"].get<std::string>().find(right_name(*row.and_right)), std::string::npos);
        }
      }
      lacks ? ++refused : ++let;
    }
  }
  EXPECT_EQ(refused + let, 15 * kServiceRows);
  EXPECT_GT(refused, 100u);
}

// What a device of the ladder is given, or a ladder program commands, can be plc.cycle_start or plc.jog_p: that takes the right to operate as well.
TEST_F(LocalServices, WhoOnlySetsUpOrMaintainsMovesNothing) {
  constexpr Service kMoves[] = {Service::kForce, Service::kRelease, Service::kWriteDevice, Service::kLadderSwap};
  for (const Right right : {Right::kSetUp, Right::kMaintain}) {
    give({right});
    ServiceClient client(path_);
    for (const ServiceRow& row : service_table()) {
      SCOPED_TRACE(std::string(row.name) + " with the right to " + right_name(right));
      const bool moves = row.lane == Lane::kCommand || std::find(std::begin(kMoves), std::end(kMoves), row.service) != std::end(kMoves);
      if (moves) {
        EXPECT_EQ(client.outcome(row.name, arguments_of(row)), "no right");
      }
    }
  }
  give({Right::kMaintain, Right::kOperate});
  ServiceClient both(path_);
  EXPECT_EQ(both.outcome("release"), "no control");
  ASSERT_EQ(both.outcome("control.take"), "");
  EXPECT_NE(both.outcome("release"), "no right");
  EXPECT_NE(both.outcome("ladder.swap", {{"program", "END\n"}}), "no right");
}

// Over DDS a request shows the right of its topic, and one client has several.
TEST_F(LocalServices, TheSecondRightIsShownByAnotherRequest) {
  ServiceClient client(path_);
  const auto outcome_with = [&](const char* service, const char* right) {
    EXPECT_TRUE(client.send_bytes(frame_of(Json{{"id", 1}, {"service", service}, {"args", arguments_of(*find_service(service))}, {"right", right}}.dump())));
    return client.receive();
  };
  const Json alone = outcome_with("force", "maintain");
  EXPECT_EQ(alone["error"], "no right");
  EXPECT_NE(alone["text"].get<std::string>().find("no request of this client has come with that to operate"), std::string::npos) << alone;
  EXPECT_EQ(outcome_with("control.take", "operate")["ok"], true);
  EXPECT_NE(outcome_with("force", "maintain").value("error", ""), "no right");
  EXPECT_EQ(outcome_with("force", "operate")["error"], "no right");
}

TEST_F(LocalServices, ARightThatIsGivenUpDoesNotComeBack) {
  ServiceClient client(path_);
  EXPECT_EQ(client.outcome("rights.limit", {{"rights", {"set up", "nonsense"}}}), "malformed");
  const Json limited = client.call("rights.limit", {{"rights", {"set up"}}});
  EXPECT_EQ(limited["reply"]["rights"], Json({"view", "set up"}));
  for (const ServiceRow& row : service_table()) {
    if (row.service == Service::kLimit) continue;
    SCOPED_TRACE(row.name);
    EXPECT_EQ(client.outcome(row.name, arguments_of(row)) == "no right", row.right == Right::kOperate || row.right == Right::kMaintain);
  }
  EXPECT_EQ(client.call("rights.limit", {{"rights", {"operate", "maintain"}}})["reply"]["rights"], Json({"view"}));
  EXPECT_EQ(client.outcome("hold"), "no right");
  EXPECT_EQ(ServiceClient(path_).outcome("hold"), "");  // another connection has its own
}

TEST_F(LocalServices, ARequestCanComeWithOneRight) {
  ServiceClient client(path_);
  for (unsigned right = 0; right < kRightCount; ++right)
    for (const ServiceRow& row : service_table()) {
      if (row.and_right) continue;  // TheSecondRightIsShownByAnotherRequest
      SCOPED_TRACE(std::string(row.name) + " with " + right_name(static_cast<Right>(right)));
      ASSERT_TRUE(client.send_bytes(frame_of(Json{{"id", 1}, {"service", row.name}, {"args", arguments_of(row)}, {"right", right_name(static_cast<Right>(right))}}.dump())));
      const Json reply = client.receive();
      const bool lacks = reply["ok"] == false && reply["error"] == "no right";
      EXPECT_EQ(lacks, row.right != Right::kView && row.right != static_cast<Right>(right)) << reply;
    }
  ASSERT_TRUE(client.send_bytes(frame_of(R"({"id":2,"service":"status","right":"everything"})")));
  EXPECT_EQ(client.receive()["error"], "malformed");
}

TEST_F(LocalServices, WhatACommandHasBeenOnItsWayCountsForItsLifespan) {
  ServiceClient client(path_);
  EXPECT_EQ(client.outcome("control.take"), "");
  const auto ask = [&](int age) {
    EXPECT_TRUE(client.send_bytes(frame_of(Json{{"id", 1}, {"service", "mode"}, {"args", {{"mode", "mdi"}, {"lifespan_ms", 5000}}}, {"age_ms", age}}.dump())));
    return client.receive();
  };
  EXPECT_EQ(ask(5100)["error"], "late");
  EXPECT_EQ(ask(10)["ok"], true);
  EXPECT_EQ(ask(-1)["error"], "malformed");
}

TEST_F(LocalServices, AConnectionAsksForOneOther) {
  ServiceClient gateway(path_), second(path_);
  EXPECT_EQ(gateway.outcome("rights.limit", {{"rights", {"set up"}}, {"behalf", "anna"}}), "malformed");  // could be a user of the computer
  EXPECT_EQ(gateway.outcome("rights.limit", {{"rights", {"set up"}}, {"behalf", "dds:an na"}}), "malformed");
  EXPECT_EQ(gateway.outcome("rights.limit", {{"rights", {"set up", "operate"}}, {"behalf", "dds:screen"}}), "");
  EXPECT_EQ(gateway.call("rights")["reply"]["client"], "dds:screen");
  EXPECT_EQ(second.outcome("rights.limit", {{"rights", {"view"}}, {"behalf", "dds:screen"}}), "busy");
  EXPECT_EQ(gateway.outcome("rights.limit", {{"rights", {"set up", "operate"}}, {"behalf", "dds:other"}}), "no right");
  EXPECT_EQ(gateway.outcome("tools.set", {{"number", 3}, {"length", 7}}), "");
  EXPECT_EQ(second.outcome("tools.set", {{"number", 4}, {"length", 8}}), "");
  const Json changes = second.call("changes")["reply"]["changes"];
  EXPECT_EQ(changes[1]["user"], "dds:screen") << changes;
  EXPECT_EQ(changes[1]["client"], "dds:screen");
  EXPECT_NE(changes[0]["user"], "dds:screen");
  EXPECT_EQ(gateway.outcome("undo"), "");  // its own change, and not the last one
  EXPECT_EQ(second.call("changes")["reply"]["changes"][2]["undone_by"], second.call("changes")["reply"]["changes"][0]["number"]);
  EXPECT_EQ(gateway.outcome("control.take"), "");
  EXPECT_EQ(second.call("rights")["reply"]["control"], "dds:screen");
  gateway.leave();
  const auto free = [&] { return second.outcome("rights.limit", {{"rights", {"view"}}, {"behalf", "dds:screen"}}); };
  for (int i = 0; i < 100 && free() == "busy"; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(second.call("rights")["reply"]["client"], "dds:screen");
}

// An identity may be several clients at once, NAME@ANYTHING: each call of ncctl is one of its own, and all of them are the same user.
TEST_F(LocalServices, TheClientsOfOneIdentityAreOneUser) {
  const auto as = [&](const char* behalf) {
    auto client = std::make_unique<ServiceClient>(path_);
    EXPECT_EQ(client->outcome("rights.limit", {{"rights", {"operate", "set up", "maintain"}}, {"behalf", behalf}}), "");
    return client;
  };
  const auto first = as("dds:boss@1");
  EXPECT_EQ(first->call("rights")["reply"]["client"], "dds:boss@1") << "control and jogs belong to one of them";
  ASSERT_EQ(first->outcome("tools.set", {{"number", 3}, {"length", 7}}), "");
  for (const char* value : {"1", "0"}) ASSERT_EQ(first->outcome("parameters.set", {{"key", "1121"}, {"value", value}}), "");
  for (const char* other : {"dds:boss2@1", "dds:bos@1", "dds:b", "DDS:boss@1", "dds:boss-1"}) EXPECT_EQ(as(other)->outcome("undo"), "not found") << other;
  const Json change = first->call("changes")["reply"]["changes"][0];
  EXPECT_EQ(change["user"], "dds:boss");
  EXPECT_EQ(change["client"], "dds:boss@1");
  EXPECT_EQ(as("dds:boss@2")->outcome("undo"), "");
  EXPECT_EQ(as("dds:boss")->outcome("parameters.undo"), "");
}

TEST_F(LocalServices, WithoutAnyRightThePeerIsPutOut) {
  give({});
  ServiceClient client(path_);
  EXPECT_EQ(client.greeting["ok"], false);
  EXPECT_EQ(client.greeting["error"], "no right");
  EXPECT_TRUE(client.receive().is_null());
}

TEST_F(LocalServices, ShowsTheMachine) {
  ServiceClient client(path_);
  const Json status = until(&client, "status", [](const Json& now) { return now["scan"] > 0; });
  EXPECT_EQ(status["mode"], "auto");
  EXPECT_EQ(status["systems"][0]["state"], "idle");
  EXPECT_EQ(status["systems"][0]["axes"][2]["name"], "Z");
  const Json machine = client.call("machine")["reply"];
  EXPECT_EQ(machine["systems"][0]["axes"][0]["soft_limits"], Json::array({-500.0, 500.0}));
  EXPECT_EQ(client.call("services")["reply"]["services"].size(), kServiceRows);
  EXPECT_EQ(client.call("rights")["reply"]["rights"].size(), kRightCount);
}

// What a reply holds must stand in the table, and the members that are always there must be in the reply.
TEST_F(LocalServices, RepliesHoldWhatTheTableSays) {
  ServiceClient client(path_);
  until(&client, "status", [](const Json& now) { return now["scan"] > 0; });
  ASSERT_EQ(client.outcome("variables.set", {{"number", 500}, {"value", 1.5}}), "");
  ASSERT_EQ(client.outcome("parameters.set", {{"key", "1078"}, {"value", "1"}}), "");
  write_program("part.nc", "T1\nG0 X1.\nG7.7\nM30\n");
  ASSERT_EQ(client.outcome("programs.recheck", {{"name", "part.nc"}}), "");
  until(&client, "programs.check", [](const Json& now) { return now["state"] == "refused"; }, {{"name", "part.nc"}});
  ASSERT_EQ(client.outcome("trace.arm", {{"signals", {"in0"}}, {"samples", 3}}), "");
  until(&client, "trace.status", [](const Json& now) { return now["state"] == "complete"; });
  for (const ServiceRow& row : service_table()) {
    if (row.right != Right::kView) continue;
    if (row.service == Service::kLadderRungs || row.service == Service::kLadderDevices || row.service == Service::kWatchBegin || row.service == Service::kWatchEnd) continue;  // this machine has no ladder: ladder_test.cpp
    SCOPED_TRACE(row.name);
    const Json reply = client.call(row.name, row.service == Service::kProgramRead ? Json{{"name", "part.nc"}, {"begin", 0}, {"bytes", 10}} : row.service == Service::kTraceRead ? Json{{"recording", 1}} : row.service == Service::kProgramCheck ? Json{{"name", "part.nc"}} : row.service == Service::kLimit ? arguments_of(row) : Json::object());
    ASSERT_EQ(reply["ok"], true) << reply;
    std::set<std::string> known, found;
    for (const ReplyRow& member : row.reply) known.insert(member.path);
    test::collect_members(reply["reply"], "", &found);
    for (const std::string& path : found) EXPECT_TRUE(known.count(path)) << path << " is not in the table";
    if (row.service == Service::kTools || row.service == Service::kLives || row.service == Service::kOffsets || row.service == Service::kVariables || row.service == Service::kParameters ||
        row.service == Service::kPrograms || row.service == Service::kProgramCheck || row.service == Service::kHistory || row.service == Service::kCounters || row.service == Service::kChanges || row.service == Service::kProgramRead || row.service == Service::kExport || row.service == Service::kParameterExport || row.service == Service::kTraceSignals ||
        row.service == Service::kTraceStatus || row.service == Service::kTraceRead || row.service == Service::kMachine) {
      EXPECT_EQ(found, known);
    }
  }
}

// What a client sends in one piece is not answered in one piece: above the bound nothing more is taken until it reads.
TEST_F(LocalServices, AnswersWaitOnlyUpToTheirBound) {
  constexpr unsigned kRequests = 400;
  std::string all;
  for (unsigned id = 0; id < kRequests; ++id) all += frame_of("{\"id\":" + std::to_string(id) + ",\"service\":\"services\"}");
  ServiceClient client(path_), other(path_);
  ASSERT_TRUE(client.send_bytes(all));
  for (unsigned n = 0; n < 20; ++n) ASSERT_EQ(other.outcome("status"), "");
  std::string text;
  ASSERT_TRUE(client.receive_text(&text));
  EXPECT_LT(server_->most_waiting(), LocalServer::kMostOut + text.size() + 10);
  for (unsigned id = 0; id < kRequests; ++id) {
    if (id != 0 && !client.receive_text(&text)) FAIL() << "request " << id;
    ASSERT_EQ(Json::parse(text)["id"], id);
  }
  EXPECT_LT(server_->most_waiting(), LocalServer::kMostOut + text.size() + 10);
  EXPECT_EQ(client.outcome("status"), "");
}

TEST_F(LocalServices, OnlyTheOneWithControlCommands) {
  ServiceClient one(path_), two(path_);
  EXPECT_EQ(one.outcome("mode", {{"mode", "manual"}}), "no control");
  EXPECT_EQ(one.outcome("control.take"), "");
  EXPECT_EQ(two.outcome("control.take"), "no control");
  EXPECT_EQ(two.call("rights")["reply"]["control"], one.greeting["client"]);
  EXPECT_EQ(one.outcome("mode", {{"mode", "manual"}}), "");
  EXPECT_EQ(two.outcome("mode", {{"mode", "auto"}}), "no control");
  EXPECT_NE(two.outcome("hold"), "no control") << "a hold is taken from everyone who may operate";
  EXPECT_EQ(one.outcome("control.release"), "");
  EXPECT_EQ(two.outcome("control.take"), "");
}

TEST_F(LocalServices, ACommandThatTakesTimeIsAnsweredWhenItsStateIsThere) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("control.take"), "");
  ASSERT_EQ(client.outcome("mode", {{"mode", "mdi"}}), "");
  EXPECT_EQ(runtime_->snapshot().mode, Mode::kMdi);
  ASSERT_EQ(client.outcome("mdi", {{"blocks", "G0 X20."}}), "");
  ASSERT_EQ(client.outcome("start"), "");
  until(&client, "status", [](const Json& now) { return now["systems"][0]["state"] == "idle" && now["systems"][0]["runs"] == 1; });
  EXPECT_NEAR(runtime_->snapshot().system[0].nc.command.v[0], 20, 1e-6);
  const Json refused = client.call("mdi", {{"blocks", "G0 X1."}, {"system", 0}});
  EXPECT_EQ(refused["error"], "malformed") << refused;
  EXPECT_EQ(client.outcome("override.feed", {{"percent", 50}}), "");
  EXPECT_EQ(client.outcome("override.feed", {{"percent", 900}}), "malformed");
}

// Whatever the thread that reads programs waits for, and who waits for it: a hold does not.
TEST_F(LocalServices, AHoldWaitsForNobody) {
  write_program("long.nc", "G1 X50. F60.\nM30\n");
  ServiceClient client(path_), other(path_), third(path_);
  ASSERT_EQ(client.outcome("control.take", {{"lease_ms", 60000}}), "");
  ASSERT_EQ(client.outcome("mode", {{"mode", "auto"}}), "");
  ASSERT_EQ(client.outcome("select", {{"name", "long.nc"}}), "");
  ASSERT_EQ(client.outcome("start"), "");
  std::atomic<bool> waits{false}, goes_on{false};
  std::thread asks([&] {
    (void)runtime_->look([&](nc_control*) {
      waits = true;
      while (!goes_on) usleep(1000);
    });
  });
  while (!waits) usleep(1000);
  ASSERT_TRUE(third.ask(1, "programs.list"));                // the thread of the data waits
  ASSERT_TRUE(client.ask(1, "mdi", {{"blocks", "G0 X1."}}));  // and that of the commands
  usleep(20000);
  ASSERT_TRUE(other.ask(1, "hold"));
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(5);  // only a failure takes so long
  while (runtime_->snapshot().system[0].nc.state != NC_STATE_HOLD && std::chrono::steady_clock::now() < give_up) usleep(1000);
  EXPECT_EQ(runtime_->snapshot().system[0].nc.state, NC_STATE_HOLD);
  goes_on = true;
  asks.join();
  EXPECT_EQ(other.receive()["ok"], true);
  EXPECT_EQ(client.receive()["ok"], false);
}

// Not for its own client either, which has as many requests without an answer as it may have.
TEST_F(LocalServices, AHoldIsHeardBehindTheMostRequests) {
  write_program("long.nc", "G1 X50. F60.\nM30\n");
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("control.take", {{"lease_ms", 60000}}), "");
  ASSERT_EQ(client.outcome("mode", {{"mode", "auto"}}), "");
  ASSERT_EQ(client.outcome("select", {{"name", "long.nc"}}), "");
  for (const bool runs : {true, false}) {  // the second time with a start among the requests that wait
    const std::string begun = runs ? client.outcome("start") : "";
    ASSERT_EQ(begun, "");
    std::atomic<bool> waits{false}, goes_on{false};
    std::thread asks([&] {
      (void)runtime_->look([&](nc_control*) {
        waits = true;
        while (!goes_on) usleep(1000);
      });
    });
    while (!waits) usleep(1000);
    for (unsigned n = 0; n < 8; ++n) ASSERT_TRUE(client.ask(100 + n, "tools.list"));
    const bool asked = runs || client.ask(150, "start");
    ASSERT_TRUE(asked);
    ASSERT_TRUE(client.ask(200, "status"));
    ASSERT_TRUE(client.ask(201, "hold", {{"lifespan_ms", 10000}}));
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(5);  // only a failure takes so long
    while (runs && runtime_->snapshot().system[0].nc.state != NC_STATE_HOLD && std::chrono::steady_clock::now() < give_up) usleep(1000);
    EXPECT_EQ(runtime_->snapshot().system[0].nc.state, runs ? NC_STATE_HOLD : NC_STATE_IDLE);
    goes_on = true;
    asks.join();
    for (Json reply = client.receive(); reply["id"] != 201; reply = client.receive()) ASSERT_FALSE(reply.is_null());
    EXPECT_NE(runtime_->snapshot().system[0].nc.state, NC_STATE_RUNNING);
    ASSERT_TRUE(client.ask(300, "reset"));
    for (Json reply = client.receive(); reply["id"] != 300; reply = client.receive()) ASSERT_FALSE(reply.is_null());
  }
}

// A hold does not get past a start that the same client has sent before it.
TEST_F(LocalServices, AStartDoesNotOutrunTheHoldBehindIt) {
  write_program("long.nc", "G1 X50. F60.\nM30\n");
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("control.take", {{"lease_ms", 60000}}), "");
  ASSERT_EQ(client.outcome("mode", {{"mode", "auto"}}), "");
  ASSERT_EQ(client.outcome("select", {{"name", "long.nc"}}), "");
  const auto reply_to = [&](unsigned id) {  // that to a start which is held before it has begun comes much later
    Json reply = client.receive();
    while (reply["id"] != id) reply = client.receive();
    return reply;
  };
  for (unsigned n = 0; n < 6; ++n) {
    ASSERT_TRUE(client.ask(100 + n, "start"));
    ASSERT_TRUE(client.ask(200 + n, "hold"));
    ASSERT_EQ(reply_to(200 + n)["ok"], true);
    EXPECT_NE(runtime_->snapshot().system[0].nc.state, NC_STATE_RUNNING) << n;
    ASSERT_TRUE(client.ask(300 + n, "reset"));
    ASSERT_EQ(reply_to(300 + n)["ok"], true);
  }
}

// The lifespan of a command counts from its arrival, and commands wait for those before them: here for a large program that is read.
TEST_F(LocalServices, ACommandThatHasWaitedTooLongIsNotExecuted) {
  std::string text;
  while (text.size() < 3u << 20) text += "G1 X1. Y2.5 F500.\n";
  write_program("large.nc", text + "M30\n");
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("control.take", {{"lease_ms", 60000}}), "");
  const auto frame = [](unsigned id, const char* service, const Json& args) { return frame_of(Json{{"id", id}, {"service", service}, {"args", args}}.dump()); };
  ASSERT_TRUE(client.send_bytes(frame(1000, "select", {{"name", "large.nc"}}) + frame(1001, "mode", {{"mode", "manual"}, {"lifespan_ms", 1}}) + frame(1002, "single", {{"on", true}, {"lifespan_ms", 10000}})));
  EXPECT_EQ(client.receive()["ok"], true);
  const Json late = client.receive();
  EXPECT_EQ(late["error"], "late") << late;
  EXPECT_EQ(client.receive()["ok"], true) << "this one had the time";
  EXPECT_EQ(client.call("status")["reply"]["mode"], "auto");
}

TEST_F(LocalServices, TheJogOfAClientEndsWithIt) {
  ServiceClient watcher(path_);
  {
    ServiceClient client(path_);
    ASSERT_EQ(client.outcome("control.take", {{"lease_ms", 60000}}), "");
    ASSERT_EQ(client.outcome("mode", {{"mode", "manual"}}), "");
    ASSERT_EQ(client.outcome("jog", {{"axis", "X"}, {"velocity", 20}}), "");
    EXPECT_EQ(client.outcome("jog", {{"axis", "Q"}, {"velocity", 20}}), "malformed");
    until(&watcher, "status", [&](const Json& now) {
      (void)client.outcome("jog", {{"axis", "X"}, {"velocity", 20}});
      return now["systems"][0]["axes"][0]["work"] > 0.5;
    });
  }
  until(&watcher, "status", [](const Json& now) { return now["control"] == "" && now["systems"][0]["axes"][0]["velocity"] == 0; });
  EXPECT_EQ(watcher.outcome("control.take"), "");
}

TEST_F(LocalServices, GarbageEndsInARefusal) {
  ServiceClient client(path_);
  for (const char* text : {"", "x", "{}", "[1]", "null", "{\"id\": 1, \"service\": \"status\", \"args\": {\"x\": 1}}"}) {
    ASSERT_TRUE(client.send_bytes(frame_of(text)));
    const Json reply = client.receive();
    EXPECT_EQ(reply["ok"], false) << text;
    EXPECT_EQ(reply["error"], "malformed") << text;
  }
  EXPECT_EQ(client.outcome("status"), "") << "the connection goes on";
  ASSERT_TRUE(client.send_bytes("GET / HTTP/1.1\r\n\r\n"));  // its first bytes are a length beyond every frame
  EXPECT_EQ(client.receive()["error"], "malformed");
  EXPECT_TRUE(client.receive().is_null());
  ServiceClient next(path_);
  EXPECT_EQ(next.outcome("status"), "");
}

TEST_F(LocalServices, AClientThatLeavesInTheMiddleOfAFrameHarmsNobody) {
  ServiceClient other(path_);
  const std::string frame = frame_of(Json{{"id", 1}, {"service", "control.take"}}.dump());
  for (std::size_t length = 0; length < frame.size(); length += 5) {
    ServiceClient client(path_);
    ASSERT_TRUE(client.send_bytes(frame.substr(0, length)));
    client.leave();
    EXPECT_EQ(other.outcome("status"), "");
  }
  for (unsigned i = 0; i < 50; ++i) {  // gone before the answer comes
    ServiceClient client(path_);
    ASSERT_TRUE(client.ask(1, "tools.list"));
  }
  until(&other, "status", [](const Json& now) { return now["control"] == ""; });
}

// On a busy computer under a sanitizer it takes longer than LocalServer::kPatienceNs until so many answers wait.
class PatientServices : public LocalMachine {
  std::int64_t patience_ns() override { return 100 * rt::services::LocalServer::kPatienceNs; }
};

// It asks for long answers, so that a few dozens are more than the server keeps for a peer. An answer to another peer shows that the server has looked at both.
TEST_F(PatientServices, WhoDoesNotReadIsNotReadFromAndHoldsUpNobody) {
  ServiceClient slow(path_), other(path_);
  slow.queue_little();
  unsigned sent = 0;
  for (unsigned without_room = 0; without_room < 5 && sent < 1000;) {
    const bool offered = slow.offer(sent, "services");
    sent += offered;
    without_room = offered ? 0 : without_room + 1;
    EXPECT_EQ(other.outcome("status"), "");
  }
  ASSERT_LT(sent, 1000u) << "the server goes on reading although its answers are not read";
  EXPECT_EQ(other.outcome("tools.list"), "");
  std::size_t bytes = 0;
  for (unsigned i = 0; i < sent; ++i) {
    std::string reply;
    ASSERT_TRUE(slow.receive_text(&reply)) << i;
    ASSERT_NE(reply.find("\"id\":" + std::to_string(i) + ","), std::string::npos) << "answers come in the order of their requests, and none is lost";
    bytes += reply.size();
  }
  EXPECT_GT(bytes, LocalServer::kMostOut) << "it has stopped reading before its room for answers was full";
}

TEST_F(LocalServices, ManyRequestsAtOnceAreAllAnswered) {
  ServiceClient client(path_);
  std::set<std::uint64_t> answered;
  for (std::uint64_t id = 1; id <= 200; ++id) ASSERT_TRUE(client.ask(id, id % 3 == 0 ? "tools.list" : id % 3 == 1 ? "status" : "override.feed", id % 3 == 2 ? Json{{"percent", 100}} : id % 3 == 0 ? Json{{"count", 2}} : Json::object()));
  for (unsigned i = 0; i < 200; ++i) answered.insert(client.receive()["id"].get<std::uint64_t>());
  EXPECT_EQ(answered.size(), 200u);
}

// While the thread of the data waits (here for a scan that does not run), whoever comes, asks and goes leaves nothing behind in its queue.
TEST_F(LocalServices, WhoComesAndGoesFillsNoQueue) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("trace.arm", {{"signals", {"nc.feed"}}, {"trigger", "nc.feed"}, {"level", 1000000}}), "");
  runtime_->stop();
  for (unsigned n = 1; n <= 4; ++n) ASSERT_TRUE(client.ask(n, "trace.stop"));
  for (unsigned n = 0; n < 2000; ++n) {
    ServiceClient other(path_);
    if (n % 2 == 0) other.ask(1, "tools.list");
  }
  give({});
  for (unsigned n = 0; n < 1000; ++n) ServiceClient none(path_);
  EXPECT_LT(server_->most_queued(), std::size_t{LocalServer::kConnections} * LocalServer::kOutstanding);
}

// A script that sends a hold and goes at once has stopped the machine, although the commands of others came before it.
TEST_F(LocalServices, AHoldCountsAlthoughItsClientHasGone) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("control.take", {{"lease_ms", 60000}}), "");
  ASSERT_EQ(client.outcome("mode", {{"mode", "mdi"}}), "");
  ASSERT_EQ(client.outcome("mdi", {{"blocks", "G91 G1 X100. F1."}}), "");
  for (unsigned n = 0; n < 50; ++n) {
    ASSERT_EQ(client.outcome("start"), "") << n;
    for (unsigned id = 1; id <= 16; ++id) ASSERT_TRUE(client.ask(id, "override.feed", {{"percent", 100}}));
    {
      ServiceClient other(path_);
      ASSERT_TRUE(other.ask(1, "hold"));
    }
    for (unsigned id = 1; id <= 16; ++id) client.receive();
    until(&client, "status", [](const Json& now) { return now["systems"][0]["state"] == "hold"; });
    ASSERT_FALSE(HasFailure()) << n;
  }
}

// The same of a reset, whose client has control, amid its own commands, which are dropped.
TEST_F(LocalServices, AResetCountsAlthoughItsClientHasGone) {
  for (unsigned n = 0; n < 30; ++n) {
    {
      ServiceClient other(path_);
      ASSERT_EQ(other.outcome("control.take", {{"lease_ms", 60000}}), "") << n;
      ASSERT_EQ(other.outcome("mode", {{"mode", "mdi"}}), "");
      ASSERT_EQ(other.outcome("mdi", {{"blocks", "G91 G1 X100. F1."}}), "");
      ASSERT_EQ(other.outcome("start"), "");
      std::string frames;
      for (unsigned id = 1; id <= 6; ++id) frames += frame_of(Json{{"id", id}, {"service", "override.feed"}, {"args", {{"percent", 100}}}}.dump());
      ASSERT_TRUE(other.send_bytes(frames + frame_of(Json{{"id", 7}, {"service", "reset"}, {"args", Json::object()}}.dump())));
    }
    const auto state = [this] { return runtime_->snapshot().system[0].nc.state; };
    for (unsigned look = 0; look < 2000 && state() != NC_STATE_IDLE; ++look) usleep(5000);
    ASSERT_EQ(state(), NC_STATE_IDLE) << n;
  }
}

TEST_F(LocalServices, OneUserCannotTakeAllPlaces) {
  std::vector<std::unique_ptr<ServiceClient>> clients;
  for (unsigned i = 0; i < LocalServer::kPerUser; ++i) {
    clients.push_back(std::make_unique<ServiceClient>(path_));
    ASSERT_EQ(clients.back()->greeting["ok"], true);
  }
  ServiceClient more(path_);
  EXPECT_EQ(more.greeting["error"], "busy");
  clients.clear();
  for (;;) {
    ServiceClient again(path_);
    if (again.greeting["ok"] == true) break;
    usleep(5000);
  }
}

TEST_F(LocalServices, ThePathOfAnotherIsNotTaken) {
  std::string error;
  LocalServer second(services_.get(), "second", [](const Credentials&) { return RightSet::all(); });
  EXPECT_FALSE(second.open(path_, &error));
  EXPECT_NE(error.find("another process"), std::string::npos) << error;
  const std::string file = folder_ + "/file";
  std::ofstream(file) << "x";
  EXPECT_FALSE(second.open(file, &error));
  EXPECT_TRUE(std::filesystem::exists(file)) << "what is no socket is not removed";
  EXPECT_FALSE(second.open(folder_ + "/" + std::string(200, 'x'), &error));
  EXPECT_FALSE(second.open("/nowhere-at-all/x/y.sock", &error));
  ServiceClient client(path_);
  EXPECT_EQ(client.outcome("status"), "");
}

TEST_F(LocalServices, ASocketThatWasLeftBehindIsReplaced) {
  const std::string left = folder_ + "/left.sock";
  {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, left.data(), left.size());
    const int dead = socket(AF_UNIX, SOCK_STREAM, 0);
    ASSERT_EQ(bind(dead, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    close(dead);
  }
  std::string error;
  LocalServer second(services_.get(), "second", [](const Credentials&) { return RightSet::all(); });
  EXPECT_TRUE(second.open(left, &error)) << error;
  struct stat info {};
  ASSERT_EQ(stat(left.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0666u);
  second.stop();
  EXPECT_FALSE(std::filesystem::exists(left));
}

}  // namespace
}  // namespace nc::rt::services
