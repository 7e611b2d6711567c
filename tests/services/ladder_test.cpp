// SPDX-License-Identifier: Apache-2.0
// The ladder in execution, seen through the services: rungs with their power flow, and values of devices of one scan.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <map>
#include <set>
#include <thread>

#include "services/local_machine.hpp"

namespace nc::rt::services {
namespace {

using test::LocalMachine;
using test::ServiceClient;

class LadderServices : public LocalMachine {
 protected:
  // D0 counts the scans; M0 has no edge and never changes, so D3 counts all of them and D2 none.
  std::string machine_text() override {
    std::ofstream(folder_ + "/own.il") << "; counts\nLD SM400\nINC D0\nFF M0\n\nLD M0\nINC D2\nLDI M0\nINC D3\nLD D0.0\nOUT M1\nLD nc.m_strobe\nOUT plc.fin2\nALIAS half D2\nEND\n";
    return LocalMachine::machine_text() + "[ladder]\nprogram = \"own.il\"\n";
  }
  static const Json& line(const Json& reply, unsigned number) {
    static const Json none;
    for (const Json& each : reply["lines"])
      if (each["line"] == number) return each;
    return none;
  }
};

TEST_F(LadderServices, ShowsRungsWithTheirPower) {
  ServiceClient client(path_);
  const Json reply = client.call("ladder.rungs")["reply"];
  EXPECT_EQ(reply["file"], folder_ + "/own.il");
  EXPECT_EQ(reply["next"], 0);
  ASSERT_EQ(reply["lines"].size(), 13u) << reply.dump(1);
  EXPECT_EQ(line(reply, 2)["rung"], 2);
  EXPECT_EQ(line(reply, 4)["rung"], 2);
  EXPECT_EQ(line(reply, 2)["power"], true);
  EXPECT_EQ(line(reply, 2)["operands"], (Json::array({{{"name", "SM400"}, {"value", 1}, {"forced", false}}})));
  EXPECT_EQ(line(reply, 6)["rung"], 6);
  EXPECT_FALSE(line(reply, 15).contains("power")) << "END";
}

// The power and the values are those of one scan: a contact and its opposite never have the same power, and the parity of the counter is that of its value.
TEST_F(LadderServices, PowerAndValuesAreOfOneScan) {
  ServiceClient client(path_);
  std::uint64_t last = 0;
  for (unsigned n = 0; n < 20; ++n) {
    const Json reply = client.call("ladder.rungs")["reply"];
    ASSERT_NE(line(reply, 6)["power"], line(reply, 8)["power"]) << reply.dump(1);
    if (reply["flow_scan"] != reply["scan"]) continue;
    const int counted = line(reply, 3)["operands"][0]["value"];
    ASSERT_EQ(line(reply, 10)["power"], (counted & 1) != 0) << reply.dump(1);
    ASSERT_EQ(line(reply, 10)["operands"][0]["value"], counted & 1) << "a bit of a word";
    EXPECT_GT(reply["scan"].get<std::uint64_t>(), last);
    last = reply["scan"].get<std::uint64_t>();
    std::this_thread::sleep_for(std::chrono::milliseconds(23));
  }
  EXPECT_GT(last, 0u);
}

// Whoever asks again and again does not make the scans longer: the power flow is one of the last fifth of a second.
TEST_F(LadderServices, TakesThePowerFlowAtMostFiveTimesASecond) {
  ServiceClient client(path_);
  std::set<std::uint64_t> scans;
  const auto begin = std::chrono::steady_clock::now();
  unsigned calls = 0;
  for (; std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(700); ++calls) scans.insert(client.call("ladder.rungs")["reply"]["flow_scan"].get<std::uint64_t>());
  const auto took = std::chrono::steady_clock::now() - begin;
  EXPECT_GT(calls, scans.size());
  EXPECT_LE(scans.size(), static_cast<std::size_t>(took / std::chrono::milliseconds(200)) + 1);
}

TEST_F(LadderServices, GivesPages) {
  ServiceClient client(path_);
  std::vector<unsigned> lines;
  unsigned from = 0;
  do {
    const Json reply = client.call("ladder.rungs", {{"from", from}, {"count", 3}})["reply"];
    for (const Json& each : reply["lines"]) lines.push_back(each["line"]);
    from = reply["next"];
  } while (from != 0 && lines.size() < 100);
  EXPECT_EQ(lines, (std::vector<unsigned>{2, 3, 4, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}));
  EXPECT_EQ(client.outcome("ladder.rungs", {{"from", 16}}), "not found");
  EXPECT_EQ(client.outcome("ladder.rungs", {{"from", -1}}), "malformed");
  EXPECT_EQ(client.outcome("ladder.rungs", {{"count", 0}}), "malformed");
}

TEST_F(LadderServices, GivesValuesOfDevices) {
  ServiceClient client(path_);
  for (unsigned n = 0; n < 5; ++n) {
    const Json reply = client.call("ladder.devices", {{"devices", {"D0", "D0.0", "half", "D3", "in0", "T0", "plc.feed_override"}}})["reply"];
    const Json& devices = reply["devices"];
    ASSERT_EQ(devices.size(), 7u);
    EXPECT_EQ(devices[0]["value"].get<int>() & 1, devices[1]["value"].get<int>());
    EXPECT_EQ(static_cast<std::int16_t>(devices[2]["value"].get<int>() + devices[3]["value"].get<int>()), devices[0]["value"].get<int>()) << "one scan has left all of them";
    EXPECT_EQ(devices[1]["type"], "bit");
    EXPECT_EQ(devices[0]["type"], "16 bit");
    EXPECT_EQ(devices[0]["forced"], false);
    EXPECT_NE(devices[6]["meaning"], "");
  }
  EXPECT_EQ(client.outcome("ladder.devices", {{"devices", {"D0", "nowhere"}}}), "not found");
  EXPECT_EQ(client.outcome("ladder.devices", {{"devices", {"D0.G"}}}), "not found");
  EXPECT_EQ(client.outcome("ladder.devices", {{"devices", {"M0.1"}}}), "not found") << "a bit has no bits";
  EXPECT_EQ(client.outcome("ladder.devices", {{"devices", Json::array()}}), "malformed");
  EXPECT_EQ(client.outcome("ladder.devices", {{"devices", std::vector<std::string>(65, "D0")}}), "malformed");
}

TEST_F(LadderServices, RepliesHoldWhatTheTableSays) {
  ServiceClient client(path_);
  for (const Service service : {Service::kLadderRungs, Service::kLadderDevices, Service::kWatchBegin}) {
    std::set<std::string> known, found;
    for (const ReplyRow& member : row_of(service).reply) known.insert(member.path);
    test::collect_members(client.call(row_of(service).name, service != Service::kLadderRungs ? Json{{"devices", {"D0"}}} : Json::object())["reply"], "", &found);
    EXPECT_EQ(found, known);
  }
}

TEST_F(LadderServices, MarksWhatIsForced) {
  ServiceClient client(path_);
  ASSERT_EQ(client.outcome("control.take"), "");
  ASSERT_EQ(client.outcome("force", {{"device", "half"}, {"value", 7}}), "");
  const Json status = until(&client, "ladder.devices", [](const Json& now) { return now["devices"][0]["forced"] == true; }, {{"devices", {"D2", "D3"}}});
  EXPECT_EQ(status["devices"][0]["value"], 7);
  EXPECT_EQ(status["devices"][1]["forced"], false);
  const Json rungs = client.call("ladder.rungs")["reply"];
  EXPECT_EQ(line(rungs, 7)["operands"][0], (Json{{"name", "D2"}, {"value", 7}, {"forced", true}}));
  EXPECT_EQ(line(rungs, 9)["operands"][0]["forced"], false);
  ASSERT_EQ(client.outcome("watch.begin", {{"devices", {"D3", "D2", "D2.0"}}, {"interval_ms", 20}}), "");
  EXPECT_EQ(client.receive()["forced"], (Json{1, 2})) << "their places";
  ASSERT_TRUE(client.ask(99, "release"));
  for (Json message = client.receive(); message.contains("forced") || message.contains("id"); message = client.receive()) continue;
}

// Users who only view keep watch lists from nobody who may do more, nor one of them from others.
TEST_F(LadderServices, NobodyTakesAllDevicesOfWatchLists) {
  std::vector<std::unique_ptr<ServiceClient>> held;
  const auto as = [&](uid_t user, std::initializer_list<Right> rights) {
    give(rights);
    {
      const std::lock_guard lock(mutex_);
      user_ = user;
    }
    held.push_back(std::make_unique<ServiceClient>(path_));
    return held.back().get();
  };
  unsigned first = 0;
  const auto watch = [&](ServiceClient* client, unsigned count) {
    std::vector<std::string> names;
    for (unsigned n = 0; n < count; ++n) names.push_back("D" + std::to_string(first + n));
    if (!client->ask(1, "watch.begin", {{"devices", names}, {"interval_ms", 60000}})) return false;
    Json reply;
    do reply = client->receive();
    while (reply.contains("watch"));
    if (reply["ok"] == true) first += count;
    else EXPECT_EQ(reply["error"], "busy");
    return reply["ok"] == true;
  };
  const auto take_all = [&](ServiceClient* client) {
    unsigned count = 0;
    while (count < 8 && watch(client, 64)) ++count;
    return 64 * count;
  };
  EXPECT_EQ(take_all(as(70001, {Right::kView})), WatchDesk::kOfUser);
  EXPECT_EQ(take_all(as(70001, {Right::kView})), 0u) << "another connection of the same user";
  EXPECT_EQ(take_all(as(70002, {Right::kView})), 64u);
  EXPECT_EQ(take_all(as(70003, {Right::kView})), 0u);
  EXPECT_EQ(take_all(as(70004, {Right::kView, Right::kSetUp})), 64u);
  EXPECT_EQ(take_all(as(70005, {Right::kView, Right::kOperate})), 64u);
  EXPECT_EQ(take_all(as(0, {Right::kView})), 64u) << "root";
}

TEST_F(LadderServices, WritesOnce) {
  ServiceClient client(path_);
  EXPECT_EQ(client.outcome("ladder.write", {{"device", "M100"}, {"value", 1}}), "no control");
  ASSERT_EQ(client.outcome("control.take"), "");
  ASSERT_EQ(client.outcome("ladder.write", {{"device", "D500"}, {"value", -12}}), "");
  EXPECT_EQ(until(&client, "ladder.devices", [](const Json& now) { return now["devices"][0]["value"] == -12; }, {{"devices", {"D500"}}})["devices"][0]["forced"], false);
  const Json refused = client.call("ladder.write", {{"device", "in0"}, {"value", 1}});
  EXPECT_EQ(refused["error"], "refused");
  EXPECT_NE(refused["text"].get<std::string>().find("force it"), std::string::npos);
  give({Right::kOperate, Right::kSetUp});
  ServiceClient other(path_);
  EXPECT_EQ(other.outcome("ladder.write", {{"device", "D500"}, {"value", 1}}), "no right");
  EXPECT_NE(other.call("ladder.devices", {{"devices", {"D500"}}})["reply"], nullptr) << "looking needs the right to view alone";
}

// ---- another program ----

// Both count the scans in D0: what a client sees must be without a gap, whichever of them runs.
constexpr const char* kCountsOn = "; the next one\nLD SM400\nINC D0\nLD M0\nINC D2\nLDI M0\nINC D3\nLDP SM413\nINC D9\nEND\n";

TEST_F(LadderServices, SwapsTheProgram) {
  ServiceClient client(path_);
  EXPECT_EQ(client.call("ladder.rungs")["reply"]["swaps"], 0);
  const Json before = client.call("ladder.devices", {{"devices", {"D0"}}})["reply"];
  const Json reply = client.call("ladder.swap", {{"program", kCountsOn}, {"name", "next.il"}});
  ASSERT_EQ(reply["ok"], true) << reply;
  EXPECT_EQ(reply["reply"]["swaps"], 1);
  EXPECT_NE(reply["reply"]["text"].get<std::string>().find("until ncrtd ends"), std::string::npos);
  EXPECT_EQ(reply["reply"]["set_back"], Json::array({"plc.fin2"}));
  const Json after = client.call("ladder.devices", {{"devices", {"D0"}}})["reply"];
  EXPECT_EQ(static_cast<std::int16_t>(after["devices"][0]["value"].get<int>() - before["devices"][0]["value"].get<int>()),
            static_cast<std::int16_t>(after["scan"].get<std::int64_t>() - before["scan"].get<std::int64_t>()));
  const Json rungs = client.call("ladder.rungs")["reply"];
  EXPECT_EQ(rungs["file"], "next.il");
  EXPECT_EQ(rungs["swaps"], 1);
  EXPECT_EQ(line(rungs, 8)["instruction"], "LDP");
  EXPECT_EQ(client.outcome("ladder.devices", {{"devices", {"half"}}}), "not found") << "a name of the program before";

  const Json change = client.call("changes")["reply"]["changes"][0];
  EXPECT_EQ(change["service"], "ladder.swap");
  EXPECT_EQ(change["client"], client.greeting["client"]);
  EXPECT_NE(change["user"], "");
  EXPECT_EQ(change["before"], "own.il, 12 instructions");
  EXPECT_EQ(change["after"].get<std::string>().rfind("next.il, 9 instructions, SHA-256 ", 0), 0u) << change["after"];
  const Json entry = until(&client, "history.list", [](const Json& now) { return now["entries"][0]["service"] == "ladder.swap"; }, {{"kind", "change"}})["entries"][0];
  EXPECT_EQ(entry["client"], client.greeting["client"]);
  EXPECT_NE(client.outcome("parameters.undo"), "") << "a program is no value of a table";

  stop();
  start();
  ServiceClient again(path_);
  EXPECT_EQ(again.call("ladder.rungs")["reply"]["file"], folder_ + "/own.il") << "the file of the configuration is what a start takes";
  EXPECT_EQ(again.call("changes")["reply"]["changes"][0]["service"], "ladder.swap");
}

// The power flow that is kept for a while is that of its program, also where the next one is as long.
TEST_F(LadderServices, ThePowerIsThatOfTheNewProgram) {
  ServiceClient client(path_);
  for (unsigned n = 0; n < 6; ++n) {
    ASSERT_EQ(client.outcome("ladder.swap", {{"program", n % 2 == 0 ? "LD SM400\nOUT M5\nEND\n" : "LD SM401\nOUT M5\nEND\n"}}), "");
    const Json rungs = client.call("ladder.rungs")["reply"];
    ASSERT_EQ(line(rungs, 1)["power"], n % 2 == 0) << rungs.dump(1);
    ASSERT_EQ(line(rungs, 2)["operands"][0]["value"], n % 2 == 0 ? 1 : 0);
  }
}

// A ladder program can command anything of the NC: it is not changed under the hands of who has control.
TEST_F(LadderServices, WhoHasControlIsNotSurprised) {
  ServiceClient client(path_), other(path_);
  const Json program = {{"program", "LD SM400\nOUT M5\nEND\n"}};
  ASSERT_EQ(other.outcome("control.take", {{"lease_ms", 60000}}), "");
  EXPECT_EQ(client.outcome("ladder.swap", program), "no control");
  EXPECT_EQ(client.call("ladder.rungs")["reply"]["swaps"], 0);
  EXPECT_EQ(other.outcome("ladder.swap", program), "");
  ASSERT_EQ(other.outcome("control.release"), "");
  EXPECT_EQ(client.outcome("ladder.swap", program), "");
  EXPECT_EQ(client.call("ladder.rungs")["reply"]["swaps"], 2);
}

TEST_F(LadderServices, ABadProgramIsRefusedWithAllItsLines) {
  ServiceClient client(path_);
  const Json reply = client.call("ladder.swap", {{"program", "LD SM400\nOUT nowhere\nLD M0\nAND\nOUT M1\nEND\n"}});
  EXPECT_EQ(reply["error"], "refused");
  EXPECT_EQ(reply["text"], "swapped:2: OUT nowhere: no such device 'nowhere'\nswapped:4: AND: operands: bit");
  std::string many;
  for (unsigned n = 0; n < 50; ++n) many += "LD nowhere\nOUT M1\n";
  EXPECT_NE(client.call("ladder.swap", {{"program", many}})["text"].get<std::string>().find("\nand 30 more"), std::string::npos);
  EXPECT_EQ(client.outcome("ladder.swap", {{"program", ""}}), "malformed");
  EXPECT_EQ(client.outcome("ladder.swap", {{"program", std::string(kMostLadder + 1, ';')}}), "malformed");
  EXPECT_EQ(client.outcome("ladder.swap", {{"program", "END\n"}, {"name", "../etc/x.il"}}), "malformed");
  EXPECT_EQ(client.outcome("ladder.swap", {{"program", std::string("END\0", 4)}}), "malformed");
  EXPECT_EQ(client.call("ladder.rungs")["reply"]["swaps"], 0);
  EXPECT_TRUE(client.call("changes")["reply"]["changes"].empty());
}

// One client swaps again and again, another one looks at the rungs and the values, a third one has a watch list. The counter of the scans has no gap for any of them.
TEST_F(LadderServices, SwapsWhileOthersLook) {
  const std::string own = "LD SM400\nINC D0\nFF M0\nLD M0\nINC D2\nLDI M0\nINC D3\nLD D0.0\nOUT M1\nEND\n";
  ServiceClient watcher(path_);
  ASSERT_EQ(watcher.outcome("watch.begin", {{"devices", {"D0", "D2", "D3"}}, {"interval_ms", 20}}), "");
  std::atomic<bool> done{false};
  std::atomic<unsigned> looks{0};
  std::thread looking([&] {
    ServiceClient client(path_);
    std::int64_t offset = -1;
    while (!done) {
      const Json rungs = client.call("ladder.rungs")["reply"];
      if (rungs["lines"].size() < 9) ADD_FAILURE() << rungs.dump(1);
      const Json reply = client.call("ladder.devices", {{"devices", {"D0"}}})["reply"];
      const auto now = (reply["scan"].get<std::int64_t>() - reply["devices"][0]["value"].get<std::int64_t>()) & 0xffff;
      if (offset == -1) offset = now;
      EXPECT_EQ(now, offset) << "a scan was counted twice, or not";
      ++looks;
    }
  });
  ServiceClient client(path_);
  for (unsigned n = 0; n < 60 || looks < 10; ++n) ASSERT_EQ(client.outcome("ladder.swap", {{"program", n % 2 == 0 ? kCountsOn : own.c_str()}}), "") << n;
  done = true;
  looking.join();
  std::int64_t offset = -1;
  for (unsigned n = 0; n < 20; ++n) {
    const Json update = watcher.receive();
    ASSERT_EQ(update["watch"], 1) << update;
    const auto now = (update["scan"].get<std::int64_t>() - update["values"][0].get<std::int64_t>()) & 0xffff;
    if (offset == -1) offset = now;
    ASSERT_EQ(now, offset);
    ASSERT_EQ(static_cast<std::int16_t>(update["values"][1].get<int>() + update["values"][2].get<int>()), update["values"][0].get<int>()) << "one scan has left all of them";
  }
}

// ---- watch lists ----

TEST_F(LadderServices, AWatchListComesWithoutBeingAskedFor) {
  ServiceClient client(path_);
  const Json reply = client.call("watch.begin", {{"devices", {"D0", "D0.0", "half", "D3", "in0", "plc.feed_override"}}, {"interval_ms", 20}});
  ASSERT_EQ(reply["ok"], true) << reply;
  const Json watch = reply["reply"]["watch"];
  EXPECT_EQ(reply["reply"]["devices"][1], (Json{{"name", "D0.0"}, {"type", "bit"}}));
  std::int64_t scan = 0;
  for (unsigned n = 0; n < 20; ++n) {
    const Json update = client.receive();
    ASSERT_EQ(update.size(), 4u) << update;
    ASSERT_EQ(update["watch"], watch);
    ASSERT_TRUE(update["left_out"].is_number_unsigned());
    ASSERT_EQ(update["values"].size(), 6u);
    ASSERT_EQ(update["values"][0].get<int>() & 1, update["values"][1].get<int>());
    ASSERT_EQ(static_cast<std::int16_t>(update["values"][2].get<int>() + update["values"][3].get<int>()), update["values"][0].get<int>());
    ASSERT_GT(update["scan"].get<std::int64_t>(), scan);
    scan = update["scan"].get<std::int64_t>();
  }
  ASSERT_TRUE(client.ask(99, "watch.end", {{"watch", watch}}));
  for (Json message = client.receive(); !message.contains("id"); message = client.receive()) ASSERT_EQ(message["watch"], watch);
  EXPECT_EQ(client.outcome("watch.end", {{"watch", watch}}), "not found") << "and nothing has come behind the reply";
}

TEST_F(LadderServices, ANameThatASwapTakesAwayHasNoValue) {
  ServiceClient client(path_), other(path_);
  ASSERT_EQ(client.outcome("watch.begin", {{"devices", {"half", "D3"}}, {"interval_ms", 20}}), "");
  ASSERT_TRUE(client.receive()["values"][0].is_number());
  ASSERT_EQ(other.outcome("ladder.swap", {{"program", kCountsOn}}), "");
  Json update;
  do update = client.receive();
  while (!update.is_null() && !update["values"][0].is_null());
  EXPECT_TRUE(update["values"][1].is_number()) << update;
}

TEST_F(LadderServices, WatchListsAreBounded) {
  ServiceClient client(path_);
  std::vector<Json> numbers;
  const auto names = [](unsigned from) {
    std::vector<std::string> some;
    for (unsigned n = 0; n < kMostWatched; ++n) some.push_back("D" + std::to_string(from + n));
    return some;
  };
  const auto begin = [](ServiceClient* of, const std::vector<std::string>& devices, const Json& interval = 60000) {
    if (!of->ask(1, "watch.begin", {{"devices", devices}, {"interval_ms", interval}})) return std::string("no connection");
    Json reply;
    do reply = of->receive();
    while (reply.contains("watch"));  // the first update of a list before it
    return reply["ok"] == true ? std::string() : reply["error"].get<std::string>();
  };
  EXPECT_EQ(begin(&client, {"D0", "nowhere"}), "not found");
  EXPECT_EQ(begin(&client, {}), "malformed");
  EXPECT_EQ(begin(&client, std::vector<std::string>(kMostWatched + 1, "D0")), "malformed");
  EXPECT_EQ(begin(&client, {"D0"}, 19), "malformed");
  for (unsigned n = 0; n < WatchDesk::kLists; ++n) EXPECT_EQ(begin(&client, names(64 * n)), "");
  EXPECT_EQ(begin(&client, {"D0"}), "busy") << "a client has so many lists";
  ServiceClient other(path_);
  EXPECT_EQ(begin(&other, {"D5000"}), "busy") << "and all clients so many different devices";
  EXPECT_EQ(begin(&other, {"D0"}), "");
  client.leave();
  for (std::string outcome = "busy"; !outcome.empty(); usleep(1000)) outcome = begin(&other, {"D5000"});
}

// A client that does not read gets no update until it has read, then the next one, which says how many there were in between. None is torn, and nobody else feels it.
// All lists of a client are due at the same ticks, and what one of them has just got is not what the client has not read.
TEST_F(LadderServices, EachListOfAClientHasItsUpdates) {
  ServiceClient client(path_);
  for (unsigned n = 0; n < WatchDesk::kLists; ++n) ASSERT_TRUE(client.ask(n + 1, "watch.begin", {{"devices", {"D" + std::to_string(n)}}, {"interval_ms", 20}}));
  std::map<unsigned, unsigned> updates;
  unsigned left_out = 0;
  while (updates[1] < 50) {
    const Json message = client.receive();
    if (message.contains("id")) continue;
    ++updates[message["watch"].get<unsigned>()];
    left_out += message["left_out"].get<unsigned>();
  }
  for (unsigned n = 2; n <= WatchDesk::kLists; ++n) EXPECT_GT(updates[n], 40u) << "list " << n;
  EXPECT_LT(left_out, 80u) << "of 400";
}

TEST_F(LadderServices, ASlowReaderLosesWholeUpdatesAndOthersNone) {
  std::vector<std::string> names = {"D0"};
  for (unsigned n = 1; n < kMostWatched; ++n) names.push_back("D" + std::to_string(100 + n));
  ServiceClient slow(path_), fast(path_);
  ASSERT_EQ(slow.outcome("watch.begin", {{"devices", names}, {"interval_ms", 20}}), "");
  ASSERT_EQ(fast.outcome("watch.begin", {{"devices", names}, {"interval_ms", 20}}), "");
  std::uint64_t fast_left_out = 0;  // when this test did not get the processor for so long
  for (unsigned n = 0; n < 200; ++n) fast_left_out += fast.receive()["left_out"].get<std::uint64_t>();
  std::uint64_t got = 0, left_out = 0;
  std::int64_t offset = -1;
  while (left_out == 0) {
    const Json update = slow.receive();
    ASSERT_EQ(update["values"].size(), names.size()) << update;
    const auto now = (update["scan"].get<std::int64_t>() - update["values"][0].get<std::int64_t>()) & 0xffff;
    if (offset == -1) offset = now;
    ASSERT_EQ(now, offset);
    left_out += update["left_out"].get<std::uint64_t>();
    ++got;
    ASSERT_LT(got, 190u) << "what nobody reads waits";
  }
  EXPECT_GE(got + left_out, 190u) << "each that is missing is counted";
  EXPECT_LT(fast_left_out, left_out);
  EXPECT_EQ(slow.receive()["left_out"], 0) << "it reads again";
}

using NoLadder = LocalMachine;
TEST_F(NoLadder, SaysThatThereIsNone) {
  ServiceClient client(path_);
  EXPECT_EQ(client.outcome("ladder.rungs"), "not found");
  EXPECT_EQ(client.outcome("ladder.devices", {{"devices", {"M0"}}}), "not found");
  EXPECT_EQ(client.outcome("ladder.swap", {{"program", "END\n"}}), "not found");
  EXPECT_EQ(client.outcome("watch.begin", {{"devices", {"M0"}}}), "not found");
}

}  // namespace
}  // namespace nc::rt::services
