// SPDX-License-Identifier: Apache-2.0
// The interference check at joints with several vectors: which of them are erased, and when it is an alarm (M700 12.4.8).
#include "offset/interference.hpp"

#include <gtest/gtest.h>

namespace nc::test {
namespace {

Section line_section(Vec2 delta, double offset) {
  Section section;
  section.begin = section.end = {unit(delta), 0};
  section.delta = delta;
  section.offset = offset;
  section.check = true;
  return section;
}

void set_joint(Section* section, std::initializer_list<Vec2> vectors) {
  section->joint = ContourJoint{};
  for (Vec2 w : vectors) section->joint.v[section->joint.n++] = w;
  section->jointed = true;
}

TEST(Interference, OutermostVectorsFirstInnerOnesErased) {
  // "(1) (4)' no interference, (2) (3)' no interference, (3) (2)' interference: erase (3) (2)', erase (4)
  // (1)'".
  Chain chain;
  chain.push_back(line_section({0, -50}, 10));
  chain.push_back(line_section({10, 0}, 10));
  chain.push_back(line_section({0, 50}, 10));
  set_joint(&chain[0], {{-10, 0}, {-10, 5}, {8, 10}, {9, 10}});
  set_joint(&chain[1], {{-9, 10}, {-8, 10}, {10, 5}, {10, 0}});
  unsigned at = 99;
  EXPECT_EQ(check_interference(&chain, 0, {}, &at), Finding::none);
  ASSERT_EQ(chain[0].joint.n, 2);
  EXPECT_EQ(chain[0].joint.v[0], (Vec2{-10, 0}));
  EXPECT_EQ(chain[0].joint.v[1], (Vec2{-10, 5}));
  ASSERT_EQ(chain[1].joint.n, 2);
  EXPECT_EQ(chain[1].joint.v[0], (Vec2{10, 5}));
  EXPECT_EQ(chain[1].joint.v[1], (Vec2{10, 0}));
}

TEST(Interference, NothingCrossesNothingChanges) {
  Chain chain;
  chain.push_back(line_section({50, 0}, 10));
  chain.push_back(line_section({0, -30}, 10));
  chain.push_back(line_section({-50, 0}, 10));
  set_joint(&chain[0], {{10, 10}});
  set_joint(&chain[1], {{10, -10}});
  unsigned at = 99;
  EXPECT_EQ(check_interference(&chain, 3, {}, &at), Finding::none);
  EXPECT_EQ(chain[0].joint.n, 1);
  EXPECT_FALSE(chain[1].dead);
}

TEST(Interference, CommandedVectorsAreNeverErased) {
  // M700 12.4.3 precaution (2): the same crossing, but one of the vectors was given by I, J.
  for (const bool commanded : {false, true}) {
    Chain chain;
    chain.push_back(line_section({20, -40}, 20));
    chain.push_back(line_section({10, 0}, 20));
    chain.push_back(line_section({20, 40}, 20));
    set_joint(&chain[0], {{12, 20}});
    set_joint(&chain[1], {{-12, 20}});
    chain[1].commanded = commanded;
    unsigned at = 99;
    EXPECT_EQ(check_interference(&chain, 0, {}, &at), commanded ? Finding::none : Finding::alarm);
  }
}

TEST(Interference, RemainingPathThatRunsBackwardsIsAnAlarm) {
  Chain chain;
  chain.push_back(line_section({0, -50}, 10));
  chain.push_back(line_section({10, 0}, 10));
  chain.push_back(line_section({0, 50}, 10));
  set_joint(&chain[0], {{30, 1}, {8, 10}});
  set_joint(&chain[1], {{-8, 10}, {-30, 2}});
  unsigned at = 99;
  EXPECT_EQ(check_interference(&chain, 0, {}, &at), Finding::alarm);
}

TEST(Interference, WideAngleBetweenTheVectorsIsAnAlarm) {
  // (2)(b): the walls converge towards the opening.
  Chain chain;
  chain.push_back(line_section({-40, -20}, 10));
  chain.push_back(line_section({10, 0}, 10));
  chain.push_back(line_section({-40, 20}, 10));
  for (unsigned i = 0; i < 3; ++i) chain[i].avoid = true;
  set_joint(&chain[0], {{20, 8}});
  set_joint(&chain[1], {{-20, 8}});
  unsigned at = 99;
  EXPECT_EQ(check_interference(&chain, 0, {}, &at), Finding::alarm);
  EXPECT_EQ(at, 0u);
}

}  // namespace
}  // namespace nc::test
