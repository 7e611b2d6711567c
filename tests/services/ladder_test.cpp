// SPDX-License-Identifier: Apache-2.0
// The ladder in execution, seen through the services: rungs with their power flow, and values of devices of one scan.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
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
  EXPECT_EQ(line(reply, 2)["operands"], (Json::array({{{"name", "SM400"}, {"value", 1}}})));
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
  for (const Service service : {Service::kLadderRungs, Service::kLadderDevices}) {
    std::set<std::string> known, found;
    for (const ReplyRow& member : row_of(service).reply) known.insert(member.path);
    test::collect_members(client.call(row_of(service).name, service == Service::kLadderDevices ? Json{{"devices", {"D0"}}} : Json::object())["reply"], "", &found);
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

using NoLadder = LocalMachine;
TEST_F(NoLadder, SaysThatThereIsNone) {
  ServiceClient client(path_);
  EXPECT_EQ(client.outcome("ladder.rungs"), "not found");
  EXPECT_EQ(client.outcome("ladder.devices", {{"devices", {"M0"}}}), "not found");
}

}  // namespace
}  // namespace nc::rt::services
