// SPDX-License-Identifier: Apache-2.0
// The services of a program that is begun inside: who may use them, what they refuse, and what they reply.
#include "services/local_machine.hpp"

namespace {

using nc::rt::services::Json;
using nc::rt::services::Right;
using nc::test::ServiceClient;

class RestartServices : public nc::test::LocalMachine {
 protected:
  void SetUp() override {
    LocalMachine::SetUp();
    write_program("part.nc", "G90 G1 X1. F6000. S500 M3\n#1=#1000\nN3 X2.\nN4 X3.\nM30\n");
  }
};

TEST_F(RestartServices, NeedTheRightToOperateAndControl) {
  give({Right::kView});
  ServiceClient viewer(path_);
  for (const char* service : {"restart.find", "restart.confirm", "restart.cancel"}) EXPECT_EQ(viewer.outcome(service), "no right") << service;
  EXPECT_EQ(viewer.outcome("restart.approach", {{"axis", "X"}}), "no right");
  EXPECT_EQ(viewer.outcome("restart.status"), "");
  give({Right::kSetUp, Right::kMaintain});
  ServiceClient other(path_);
  EXPECT_EQ(other.outcome("restart.find", {{"line", 3}}), "no right") << "neither gives it";
  give({Right::kOperate});
  ServiceClient first(path_), second(path_);
  EXPECT_EQ(first.outcome("restart.find", {{"line", 3}}), "no control");
  EXPECT_EQ(first.outcome("control.take", {{"lease_ms", 60000}}), "");
  EXPECT_EQ(first.outcome("select", {{"name", "part.nc"}}), "");
  EXPECT_EQ(second.outcome("restart.find", {{"line", 3}}), "no control");
  EXPECT_EQ(first.outcome("restart.find", {{"line", 3}}), "");
  EXPECT_EQ(second.outcome("restart.cancel"), "no control");
  EXPECT_EQ(second.outcome("restart.confirm"), "no control");
  EXPECT_EQ(second.outcome("restart.approach", {{"axis", "X"}}), "no control");
}

TEST_F(RestartServices, GarbageIsMalformed) {
  ServiceClient client(path_);
  EXPECT_EQ(client.outcome("control.take", {{"lease_ms", 60000}}), "");
  EXPECT_EQ(client.outcome("select", {{"name", "part.nc"}}), "");
  const Json places[] = {Json::object(), {{"line", 3}, {"block", 1}}, {{"power_off", false}}, {{"power_off", true}, {"last_stop", true}}, {{"line", 0}}, {{"line", -3}}, {{"line", 1.5}}, {{"line", "3"}},
                         {{"block", 1e17}}, {{"block", nullptr}}, {{"sequence", 3}, {"passing", 0}}, {{"block", 3}, {"passing", 2}}, {{"block", 3}, {"file", "part.nc"}}, {{"line", 3}, {"file", "../part.nc"}},
                         {{"line", 3}, {"file", ""}}, {{"line", 3}, {"system", 2}}, {{"line", 3}, {"system", 0}}, {{"line", 3}, {"where", 1}}, Json::array(), 7};
  for (const Json& place : places) EXPECT_EQ(client.outcome("restart.find", place), "malformed") << place.dump();
  for (const Json& entry : {Json{{"entry", 0}}, Json{{"entry", 101}}, Json{{"entry", "M3"}}}) EXPECT_EQ(client.outcome("restart.confirm", entry), "malformed") << entry.dump();
  for (const Json& axis : {Json::object(), Json{{"axis", "Q"}}, Json{{"axis", "XY"}}, Json{{"axis", "X"}, {"velocity", -1}}, Json{{"axis", "X"}, {"velocity", 1e9}}})
    EXPECT_EQ(client.outcome("restart.approach", axis), "malformed") << axis.dump();
  EXPECT_EQ(client.outcome("restart.status", {{"system", 2}}), "malformed");
  EXPECT_EQ(client.call("restart.status")["reply"]["phase"], "none") << "nothing of it has begun a search";
}

TEST_F(RestartServices, ReplyWithWhatTheTableHas) {
  ServiceClient client(path_);
  EXPECT_EQ(client.outcome("control.take", {{"lease_ms", 60000}}), "");
  EXPECT_EQ(client.outcome("restart.find", {{"sequence", 4}}), "refused") << "no program is selected";
  EXPECT_EQ(client.outcome("select", {{"name", "part.nc"}}), "");
  EXPECT_EQ(client.outcome("restart.find", {{"sequence", 4}}), "");
  const Json found = until(&client, "restart.status", [](const Json& reply) { return reply["phase"] != "searching"; });
  EXPECT_EQ(found["phase"], "found") << found.dump();
  EXPECT_EQ(found["file"], "part.nc");
  EXPECT_EQ(found["line"], 4);
  EXPECT_EQ(found["asked"], Json::array({"inputs"}));
  EXPECT_EQ(found["open"], 2);
  EXPECT_EQ(found["axes"][0]["place"], 2);
  std::set<std::string> members, table;
  nc::test::collect_members(found, "", &members);
  for (const nc::rt::services::ReplyRow& row : nc::rt::services::row_of(nc::rt::services::Service::kRestartStatus).reply) table.insert(row.path);
  EXPECT_EQ(members, table);
  EXPECT_EQ(client.outcome("restart.confirm", {{"entry", 1}}), "");
  EXPECT_EQ(client.outcome("restart.confirm", {{"entry", 3}}), "refused") << "there are two";
  EXPECT_EQ(until(&client, "restart.status", [](const Json& reply) { return reply["open"] == 1; })["codes"][0]["state"], "confirmed");
  EXPECT_EQ(client.outcome("restart.cancel"), "");
  EXPECT_EQ(client.outcome("restart.cancel"), "refused");
}

// A feed hold amid a block has a place as well, and where the axes are; nothing was looked for.
TEST_F(RestartServices, AFeedHoldShowsWhereThePathHasStopped) {
  write_program("long.nc", "G90 G1 X100. F600.\nM30\n");
  ServiceClient client(path_);
  EXPECT_EQ(client.outcome("control.take", {{"lease_ms", 60000}}), "");
  EXPECT_EQ(client.outcome("select", {{"name", "long.nc"}}), "");
  EXPECT_FALSE(client.call("restart.status")["reply"]["axes"][0].contains("place")) << "nothing is held";
  EXPECT_EQ(client.outcome("start"), "");
  EXPECT_EQ(client.outcome("hold"), "");
  EXPECT_EQ(client.outcome("mode", {{"mode", "mdi"}}), "refused");
  EXPECT_EQ(client.outcome("mode", {{"mode", "manual"}}), "");
  const Json held = until(&client, "restart.status", [](const Json& reply) { return reply["axes"][0].contains("place"); });
  EXPECT_EQ(held["phase"], "none");
  EXPECT_EQ(held["axes"][0]["place"], held["axes"][0]["machine"]);
  EXPECT_EQ(held["axes"][0]["away"], false);
  EXPECT_EQ(client.outcome("jog", {{"axis", "Y"}, {"velocity", 20}}), "");
  const Json away = until(&client, "restart.status", [](const Json& reply) { return reply["axes"][1]["away"] == true; });
  EXPECT_EQ(away["axes"][1]["place"], 0);
  EXPECT_EQ(client.outcome("jog", {{"axis", "Y"}, {"velocity", 0}}), "");
}

}  // namespace
