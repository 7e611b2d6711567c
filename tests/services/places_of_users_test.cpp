// SPDX-License-Identifier: Apache-2.0
// Users that hold connections: others still get in, and whoever has control keeps it.
#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "services/local_machine.hpp"

namespace nc::rt::services {
namespace {

using test::LocalMachine;
using test::ServiceClient;

class PlacesOfUsers : public LocalMachine {
 protected:
  using Clients = std::vector<std::unique_ptr<ServiceClient>>;
  // A client that connects as this user with these rights.
  std::unique_ptr<ServiceClient> as(uid_t user, std::initializer_list<Right> rights) {
    give(rights);
    {
      const std::lock_guard lock(mutex_);
      user_ = user;
    }
    return std::make_unique<ServiceClient>(path_);
  }
  // Connects until it is refused.
  void hold_all(uid_t user, std::initializer_list<Right> rights, Clients* held) {
    for (;;) {
      held->push_back(as(user, rights));
      if (held->back()->greeting["ok"] == true) continue;
      EXPECT_EQ(held->back()->greeting["error"], "busy");
      held->pop_back();
      return;
    }
  }
  static constexpr uid_t kRoot = 0, kOperator = 70001, kFirst = 70002;  // whoever runs the test is another one
};

// As many viewers as there are, with all the places that they get, each connection idle.
TEST_F(PlacesOfUsers, ViewersKeepNobodyOutWhoMayDoMore) {
  Clients held;
  for (uid_t user = kFirst; user < kFirst + 8; ++user) hold_all(user, {Right::kView}, &held);
  const auto one = as(kOperator, {Right::kOperate});
  ASSERT_EQ(one->greeting["ok"], true) << one->greeting;
  EXPECT_EQ(one->outcome("control.take"), "");
  const auto setter = as(kOperator + 100, {Right::kSetUp});
  EXPECT_EQ(setter->outcome("tools.list"), "");
  const auto root = as(kRoot, {Right::kView, Right::kOperate, Right::kSetUp, Right::kMaintain});
  EXPECT_EQ(root->outcome("hold"), "");
}

TEST_F(PlacesOfUsers, WhoCannotOperateHasAPartOfThePlacesOnly) {
  Clients held;
  for (uid_t user = kFirst; user < kFirst + 8; ++user) hold_all(user, {Right::kView}, &held);
  unsigned still = 0;
  for (const auto& client : held) still += client->outcome("status") == "";
  EXPECT_EQ(still, LocalServer::kWithoutOperate);
  Clients operators;  // they find their places, and take none from anybody
  for (unsigned i = 0; i < LocalServer::kConnections - LocalServer::kWithoutOperate; ++i) operators.push_back(as(kOperator, {Right::kOperate}));
  for (const auto& client : operators) EXPECT_EQ(client->outcome("status"), "");
  unsigned after = 0;
  for (const auto& client : held) after += client->outcome("status") == "";
  EXPECT_EQ(after, LocalServer::kWithoutOperate);
}

TEST_F(PlacesOfUsers, OperatorsKeepNoOperatorOutAndNotRoot) {
  Clients held;
  const auto controls = as(kFirst, {Right::kOperate});
  ASSERT_EQ(controls->outcome("control.take", {{"lease_ms", 60000}}), "");
  for (uid_t user = kFirst; user < kFirst + 4; ++user) hold_all(user, {Right::kOperate}, &held);
  const auto late = as(kOperator, {Right::kOperate});
  EXPECT_EQ(late->outcome("status"), "") << late->greeting;
  Clients roots;
  for (unsigned i = 0; i < LocalServer::kPerUser; ++i) {
    roots.push_back(as(kRoot, {Right::kView, Right::kOperate, Right::kSetUp, Right::kMaintain}));
    ASSERT_EQ(roots.back()->outcome("status"), "");
  }
  EXPECT_EQ(as(kOperator + 100, {Right::kOperate})->outcome("status"), "");
  EXPECT_EQ(controls->outcome("mode", {{"mode", "manual"}}), "") << "it was silent longer than all others, and has control";
  for (const auto& root : roots) EXPECT_EQ(root->outcome("status"), "");
}

// Who reads nothing, and is on the way out because of a frame that is too long, has a place still.
TEST_F(PlacesOfUsers, ConnectionsThatAreToEndAreCounted) {
  Clients held;
  const std::string asks = frame_of(R"({"id":1,"service":"services"})");
  for (unsigned round = 0; round < 4; ++round)
    for (unsigned i = 0; i < LocalServer::kPerUser; ++i) {
      held.push_back(as(kFirst, {Right::kView}));
      if (held.back()->greeting["ok"] != true) continue;
      std::string all;
      for (unsigned n = 0; n < 12; ++n) all += asks;
      EXPECT_TRUE(held.back()->send_bytes(all + std::string(8, '\xff')));
    }
  const auto one = as(kOperator, {Right::kOperate});
  EXPECT_EQ(one->outcome("control.take"), "");
}

TEST_F(PlacesOfUsers, WhoLosesItsPlaceIsToldSo) {
  Clients held;
  for (uid_t user = kFirst; user < kFirst + 2; ++user) hold_all(user, {Right::kView}, &held);
  ASSERT_EQ(held.size(), std::size_t{LocalServer::kWithoutOperate});
  for (std::size_t i = 1; i < held.size(); ++i) ASSERT_EQ(held[i]->outcome("status"), "");  // the first one has been silent the longest
  const auto late = as(kFirst + 2, {Right::kView});
  ASSERT_EQ(late->greeting["ok"], true);
  const Json last = held[0]->receive();
  EXPECT_EQ(last["error"], "busy") << last;
  EXPECT_NE(last["text"].get<std::string>().find("another user needs its place"), std::string::npos);
  EXPECT_TRUE(held[0]->receive().is_null());
  EXPECT_EQ(held[1]->outcome("status"), "");
}

// The feeder does something for another client meanwhile, so that the requests of all stand in the queue before the second one is executed. In which order they were is what their changes say.
TEST_F(PlacesOfUsers, AUserWaitsForOneRequestOfEachOtherUser) {
  constexpr uid_t kMany = kFirst, kSecond = kFirst + 1, kThird = kFirst + 2;
  constexpr unsigned kClients = 6, kRequests = 7;
  std::atomic<bool> goes_on{false}, stands{false};
  std::thread busy([&] {
    (void)runtime_->look([&](nc_control*) {
      stands = true;
      while (!goes_on) usleep(1000);
    });
  });
  while (!stands) usleep(1000);
  Clients held;
  unsigned tool = 0;
  const auto fill = [&](uid_t user, unsigned requests) {
    held.push_back(as(user, {Right::kSetUp}));
    ServiceClient* const client = held.back().get();
    for (unsigned n = 0; n < requests; ++n) ASSERT_TRUE(client->ask(100 + n, "tools.set", {{"number", ++tool}, {"length", 1}}));
    ASSERT_TRUE(client->ask(1, "rights"));  // is answered when those before it stand in the queue
    ASSERT_EQ(client->receive()["id"], 1);
  };
  for (unsigned n = 0; n < kClients; ++n) fill(kMany, kRequests);
  fill(kSecond, 2);
  fill(kThird, 1);
  goes_on = true;
  busy.join();
  for (unsigned n = 0; n < held.size(); ++n)
    for (unsigned left = n < kClients ? kRequests : held.size() - n; left > 0; --left) ASSERT_EQ(held[n]->receive()["ok"], true);
  const Json changes = held[0]->call("changes")["reply"]["changes"];
  ASSERT_EQ(changes.size(), tool);
  std::vector<std::string> users;
  for (auto change = changes.rbegin(); change != changes.rend(); ++change) users.push_back((*change)["user"]);
  const std::vector<std::string> first(users.begin(), users.begin() + 5);
  const std::string many = std::to_string(kMany), second = std::to_string(kSecond), third = std::to_string(kThird);
  EXPECT_EQ(first, (std::vector<std::string>{many, second, third, many, second})) << "the first one was under way";
}

}  // namespace
}  // namespace nc::rt::services
