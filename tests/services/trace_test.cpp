// SPDX-License-Identifier: Apache-2.0
// The signal trace through the services: what is recorded is read, what cannot be is refused with the reason.
#include <gtest/gtest.h>

#include <fstream>

#include "runtime/share/text.hpp"
#include "services/local_machine.hpp"
#include "tools/lib/trace_csv.hpp"

namespace nc::rt::services {
namespace {

using test::LocalMachine;
using test::ServiceClient;

class TraceServices : public LocalMachine {
 protected:
  // D0 counts the scans.
  std::string machine_text() override {
    std::ofstream(folder_ + "/own.il") << "LD SM400\nINC D0\nLD in0\nOUT M1\nLD nc.m_strobe\nOUT plc.fin2\nEND\n";
    return LocalMachine::machine_text() + "[ladder]\nprogram = \"own.il\"\n";
  }
  // Waits for the end of the recording, and reads all of it.
  Json whole(ServiceClient* client, Json* status) {
    *status = until(client, "trace.status", [](const Json& now) { return now["state"] == "complete" || now["state"] == "stopped"; });
    Json rows = Json::array();
    for (Json page = {{"next", 0}};;) {
      page = client->call("trace.read", {{"recording", (*status)["recording"]}, {"from", page["next"]}, {"count", 70}})["reply"];
      EXPECT_LE(page["rows"].size(), 70u);
      for (const Json& row : page["rows"]) rows.push_back(row);
      if (page["next"] == 0) return rows;
    }
  }
};

TEST_F(TraceServices, RecordsEachScan) {
  ServiceClient client(path_);
  EXPECT_EQ(client.call("trace.status")["reply"], (Json{{"recording", 0}, {"state", "none"}}));
  EXPECT_EQ(client.call("trace.arm", {{"signals", {"D0", "in0", "nc.mode_auto"}}, {"samples", 300}})["reply"]["recording"], 1);
  Json status;
  const Json rows = whole(&client, &status);
  ASSERT_EQ(rows.size(), 300u);
  for (std::size_t n = 1; n < rows.size(); ++n) {
    ASSERT_EQ(rows[n]["scan"].get<std::uint64_t>(), rows[n - 1]["scan"].get<std::uint64_t>() + 1);
    ASSERT_EQ(static_cast<std::int16_t>(rows[n]["values"][0].get<int>() - rows[n - 1]["values"][0].get<int>()), 1);
    ASSERT_GT(rows[n]["time_s"].get<double>(), rows[n - 1]["time_s"].get<double>());
    ASSERT_EQ(rows[n]["values"][2], 1);
  }
  EXPECT_EQ(rows[0]["time_s"], 0.0);
  EXPECT_EQ(status["client"], client.greeting["client"]);
  EXPECT_EQ(status["signals"], (Json{"D0", "in0", "nc.mode_auto"}));
  EXPECT_EQ(status["recorded"], 300);
  EXPECT_NEAR(status["trigger_ns"].get<double>(), static_cast<double>(share::wall_ns()), 600e9);
  const std::string csv = tools::trace_csv_head(status) + tools::trace_csv_rows({{"rows", {rows[0], rows[1]}}});
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "scan,time_s,D0,in0,nc.mode_auto");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
  EXPECT_NE(csv.find(",0.000000000,"), std::string::npos) << csv;
}

TEST_F(TraceServices, WaitsForItsTriggerAndHasWhatWasBefore) {
  ServiceClient client(path_);
  {
    ServiceClient other(path_);
    ASSERT_EQ(other.outcome("trace.arm", {{"signals", {"nc.mode_mdi", "D0"}}, {"trigger", "nc.mode_mdi"}, {"samples", 100}, {"before", 40}}), "");
  }  // the recording belongs to the machine and not to its client
  until(&client, "trace.status", [](const Json& now) { return now["recorded"] == 100; });
  EXPECT_EQ(client.call("trace.status")["reply"]["state"], "waiting");
  EXPECT_EQ(client.call("trace.arm", {{"signals", {"D0"}}})["error"], "busy");
  EXPECT_EQ(client.outcome("trace.read", {{"recording", 1}}), "refused") << "it has not ended";
  ASSERT_EQ(client.outcome("control.take"), "");
  ASSERT_EQ(client.outcome("mode", {{"mode", "mdi"}}), "");
  Json status;
  const Json rows = whole(&client, &status);
  ASSERT_EQ(rows.size(), 100u);
  EXPECT_EQ(status["trigger_row"], 40);
  EXPECT_EQ(status["triggered"], true);
  for (std::size_t n = 0; n < rows.size(); ++n) ASSERT_EQ(rows[n]["values"][0], n < 40 ? 0 : 1) << n;
  EXPECT_LT(rows[39]["time_s"].get<double>(), 0);
  EXPECT_EQ(rows[40]["time_s"], 0.0);
}

TEST_F(TraceServices, EndsByHand) {
  ServiceClient client(path_);
  EXPECT_EQ(client.outcome("trace.stop"), "refused") << "nothing is being recorded";
  ASSERT_EQ(client.outcome("trace.arm", {{"signals", {"M1"}}, {"trigger", "M1"}, {"when", "high"}, {"samples", 50}}), "");
  until(&client, "trace.status", [](const Json& now) { return now["recorded"] == 50; });
  EXPECT_EQ(client.outcome("trace.stop"), "");
  Json status;
  EXPECT_EQ(whole(&client, &status).size(), 50u);
  EXPECT_EQ(status["state"], "stopped");
  EXPECT_EQ(status["triggered"], false);
  EXPECT_EQ(client.outcome("trace.read", {{"recording", 2}}), "not found");
  ASSERT_EQ(client.outcome("trace.arm", {{"signals", {"M1"}}, {"samples", 1}}), "");
  EXPECT_EQ(client.outcome("trace.read", {{"recording", 1}}), "not found") << "there is a newer one";
}

TEST_F(TraceServices, WhatCannotBeRecordedIsSaid) {
  ServiceClient client(path_);
  Json many = Json::array(), long_name = {std::string(65, 'x')};
  for (int n = 0; n < 65; ++n) many.push_back("M" + std::to_string(n));
  Json most = many;
  most.erase(most.size() - 1);
  const struct {
    Json args;
    const char *error, *said;
  } cases[] = {
      {{{"signals", {"D0", "none"}}}, "not found", "\"none\""},
      {{{"signals", {"D0", "D0"}}}, "malformed", "twice"},
      {{{"signals", many}}, "malformed", "1 to 64"},
      {{{"signals", Json::array()}}, "malformed", "1 to 64"},
      {{{"signals", "D0"}}, "malformed", "list"},
      {{{"signals", {1}}}, "malformed", "texts"},
      {{{"signals", {""}}}, "malformed", "bytes"},
      {{{"signals", {"D0\n"}}}, "malformed", "control characters"},
      {{{"signals", long_name}}, "malformed", "bytes"},
      {{{"signals", {"D0"}}, {"trigger", "M1"}}, "malformed", "one of the signals"},
      {{{"signals", {"D0"}}, {"trigger", "D0"}, {"when", "noon"}}, "malformed", "rise, fall"},
      {{{"signals", {"D0"}}, {"trigger", "D0"}, {"when", "change"}, {"level", 3}}, "malformed", "no level"},
      {{{"signals", {"D0"}}, {"when", "rise"}}, "malformed", "needs a trigger"},
      {{{"signals", {"D0"}}, {"level", 2}}, "malformed", "needs a trigger"},
      {{{"signals", {"D0"}}, {"before", 2}}, "malformed", "needs a trigger"},
      {{{"signals", {"D0"}}, {"trigger", "D0"}, {"samples", 20}, {"before", 20}}, "malformed", "less than samples"},
      {{{"signals", {"D0"}}, {"samples", 0}}, "malformed", "samples"},
      {{{"signals", {"D0"}}, {"samples", 1000001}}, "malformed", "samples"},
      {{{"signals", most}, {"samples", 63551}}, "malformed", "63550"},
  };
  for (const auto& c : cases) {
    const Json reply = client.call("trace.arm", c.args);
    EXPECT_EQ(reply["error"], c.error) << c.args << reply;
    EXPECT_NE(reply["text"].get<std::string>().find(c.said), std::string::npos) << c.args << reply;
  }
  EXPECT_EQ(client.call("trace.status")["reply"]["state"], "none") << "what was refused is not recorded";
  EXPECT_EQ(client.outcome("trace.arm", {{"signals", most}, {"samples", 63550}, {"trigger", "M0"}}), "");
  EXPECT_EQ(client.outcome("trace.stop"), "");
}

// A page of the widest rows must have room in a reply.
TEST_F(TraceServices, ThePagesHaveRoomForTheWidestRows) {
  ServiceClient client(path_);
  Json signals = Json::array();
  for (int n = 0; n < 64; ++n) signals.push_back("D" + std::to_string(n));
  ASSERT_EQ(client.outcome("trace.arm", {{"signals", signals}, {"samples", 600}}), "");
  Json status;
  EXPECT_EQ(whole(&client, &status).size(), 600u);
  const Json page = client.call("trace.read", {{"recording", status["recording"]}})["reply"];
  EXPECT_EQ(page["rows"].size(), 500u);
  EXPECT_EQ(page["next"], 500);
  // Every value could have 11 signs, the scan 20 and the time 25.
  EXPECT_LT(500u * (64 * 12 + 90), kMostFrameBytes);
}

TEST_F(TraceServices, ListsWhatCanBeRecorded) {
  ServiceClient client(path_);
  std::size_t count = 0;
  bool feed = false, point = false;
  for (Json page = {{"next", 0}};;) {
    page = client.call("trace.signals", {{"from", page["next"]}, {"count", 100}})["reply"];
    for (const Json& row : page["signals"]) {
      ++count;
      feed = feed || (row["name"] == "nc.feed" && row["type"] == "32 bit");
      point = point || (row["name"] == "in0" && row["type"] == "bit");
    }
    if (page["next"] == 0) break;
  }
  EXPECT_TRUE(feed);
  EXPECT_TRUE(point);
  EXPECT_EQ(count, machine_signals(config_.nc).size() + config_.points.size());
}

TEST(TraceCsv, NamesAreQuotedWhereTheyMustBe) {
  EXPECT_EQ(tools::trace_csv_head({{"signals", {"a", "b,c", "d\"e"}}}), "scan,time_s,a,\"b,c\",\"d\"\"e\"\n");
  EXPECT_EQ(tools::trace_csv_rows({{"rows", {{{"scan", 7}, {"time_s", -0.001}, {"values", {1, -2}}}}}}), "7,-0.001000000,1,-2\n");
}

}  // namespace
}  // namespace nc::rt::services
