// SPDX-License-Identifier: Apache-2.0
// Who has which right.
#include "runtime/services/rights.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include "runtime/test_config.hpp"

namespace nc::rt::services {
namespace {

constexpr uid_t kOwner = 900;
const RightGroups kGroups = {{{10}, {20, 21}, {30}, {40}}};

Credentials someone(gid_t group, std::vector<gid_t> further = {}) { return {1234, group, 1, std::move(further)}; }

bool only(RightSet rights, std::vector<Right> wanted) {
  RightSet expected;
  for (const Right right : wanted) expected.add(right);
  return rights == expected;
}

TEST(ServiceRights, ComeFromTheGroupsOfThePeer) {
  EXPECT_TRUE(rights_of(someone(1, {2, 3}), kGroups, kOwner).none());
  EXPECT_TRUE(only(rights_of(someone(10), kGroups, kOwner), {Right::kView}));
  EXPECT_TRUE(only(rights_of(someone(1, {5, 21}), kGroups, kOwner), {Right::kOperate}));
  EXPECT_TRUE(only(rights_of(someone(30, {40}), kGroups, kOwner), {Right::kSetUp, Right::kMaintain}));
  EXPECT_TRUE(rights_of(someone(30), kGroups, kOwner).has(Right::kView)) << "every right includes the right to view";
  EXPECT_FALSE(rights_of(someone(30), kGroups, kOwner).has(Right::kOperate)) << "rights do not include each other otherwise";
  EXPECT_EQ(rights_of({0, 0, 1, {}}, kGroups, kOwner), RightSet::all());
  EXPECT_EQ(rights_of({kOwner, 7, 1, {}}, kGroups, kOwner), RightSet::all());
}

TEST(ServiceRights, AGroupThatIsNotThereGivesNoRight) {
  ServicesConfig config;
  std::vector<std::string> unknown;
  config.holders[1] = {"nc-nobody-has-such-a-group"};
  const RightGroups groups = find_groups(config, &unknown);
  EXPECT_TRUE(groups[1].empty());
  EXPECT_EQ(unknown, std::vector<std::string>{"nc-nobody-has-such-a-group"});
}

TEST(ServiceRights, TheKernelSaysWhoThePeerIs) {
  int ends[2];
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  Credentials peer;
  ASSERT_TRUE(credentials_of(ends[0], &peer));
  EXPECT_EQ(peer.user, geteuid());
  EXPECT_EQ(peer.group, getegid());
  EXPECT_EQ(peer.process, getpid());
  close(ends[0]);
  EXPECT_FALSE(credentials_of(ends[0], &peer));
  close(ends[1]);
}

TEST(ServiceRights, TheConfigurationNamesTheGroups) {
  const Config standard = test::parse_or_fail(test::base_toml());
  EXPECT_TRUE(standard.services.enabled);
  EXPECT_EQ(standard.services.holders[3], std::vector<std::string>{"nc-maintain"});
  const Config own = test::parse_or_fail(test::base_toml() + "[services]\nsocket = \"/run/x.sock\"\nview = [\"a\", \"b\"]\noperate = []\nprogram_mb = 5\n");
  EXPECT_EQ(own.services.socket, "/run/x.sock");
  EXPECT_EQ(own.services.holders[0], (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(own.services.holders[1].empty());
  EXPECT_EQ(own.services.program_mb, 5u);
  for (const char* bad : {"view = \"a\"", "view = [\"\"]", "view = [\"a b\"]", "socket = \"relative.sock\"", "program_mb = 0", "vew = []"}) {
    Config config;
    EXPECT_FALSE(parse_config(test::base_toml() + "[services]\n" + bad + "\n", "test.toml", &config).empty()) << bad;
  }
}

}  // namespace
}  // namespace nc::rt::services
