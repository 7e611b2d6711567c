// SPDX-License-Identifier: Apache-2.0
// The commanded speeds of the spindles (M700 10.3, 10.4, 10.6.1).
#include "interpolate/spindle.hpp"

#include <gtest/gtest.h>

namespace nc {
namespace {

class Speeds : public testing::Test {
 protected:
  Speeds() { speeds.create(3); }
  double now(unsigned spindle) {
    speeds.update([this](unsigned) { return radius; });
    return speeds.now(spindle);
  }
  SpindleSpeeds speeds;
  double radius = 50;
};

TEST_F(Speeds, ASpindleThatIsNotSelectedKeepsItsSpeed) {
  speeds.select(1);
  speeds.command(500);
  EXPECT_EQ(now(0), 500);
  EXPECT_EQ(now(1), 0);
  speeds.select(2);
  EXPECT_EQ(now(1), 500) << "the S command goes to whoever is selected";
  speeds.command(800);
  EXPECT_EQ(now(1), 800);
  EXPECT_EQ(now(0), 500);
  speeds.select(5);
  EXPECT_EQ(now(0), 800);
  EXPECT_EQ(now(2), 800);
  EXPECT_EQ(speeds.lead(), 0u);
}

TEST_F(Speeds, WithNoneSelectedNothingChanges) {
  speeds.select(2);
  speeds.command(500);
  EXPECT_EQ(now(1), 500);
  speeds.select(0);
  speeds.command(900);
  for (unsigned spindle = 0; spindle < 3; ++spindle) EXPECT_EQ(now(spindle), spindle == 1 ? 500 : 0);
  EXPECT_EQ(speeds.commanded(), 900) << "the code for the PLC";
  EXPECT_EQ(speeds.lead(), 1u) << "the one that was selected last";
}

TEST_F(Speeds, TheClampIsOfTheSelectedSpindles) {
  speeds.command(3000);
  speeds.select(1);
  speeds.clamp(1000, 0, NC_CLAMP_S | NC_CLAMP_ALWAYS);
  EXPECT_EQ(now(0), 1000);
  speeds.select(2);
  EXPECT_EQ(now(1), 3000);
  speeds.clamp(2000, 0, NC_CLAMP_S | NC_CLAMP_ALWAYS);
  EXPECT_EQ(now(1), 2000);
  speeds.select(1);
  EXPECT_EQ(now(0), 1000) << "kept";
  speeds.command(50);
  speeds.clamp(0, 200, NC_CLAMP_Q | NC_CLAMP_ALWAYS);  // the S command of this spindle stays
  EXPECT_EQ(now(0), 200);
  speeds.command(5000);
  EXPECT_EQ(now(0), 1000);
}

TEST_F(Speeds, WhereSIsSmallerThanQTheyChangePlaces) {  // M700 10.4, precaution (1)
  speeds.select(1);
  speeds.clamp(1000, 200, NC_CLAMP_S | NC_CLAMP_Q | NC_CLAMP_ALWAYS);
  speeds.clamp(0, 0, NC_CLAMP_S | NC_CLAMP_ALWAYS);  // G92 S0
  speeds.command(700);
  EXPECT_EQ(now(0), 200);
  speeds.command(100);
  EXPECT_EQ(now(0), 100);
}

TEST_F(Speeds, QAloneIsTheLowerClamp) {  // M700 10.4: until an S is given
  speeds.select(1);
  speeds.clamp(0, 200, NC_CLAMP_Q | NC_CLAMP_ALWAYS);
  speeds.command(100);
  EXPECT_EQ(now(0), 200);
  speeds.command(5000);
  EXPECT_EQ(now(0), 5000);
}

TEST_F(Speeds, ConstantSurfaceSpeedOfWhoeverIsSelected) {
  speeds.select(1);
  speeds.surface(100, 1);
  const double at_50 = now(0);
  EXPECT_NEAR(at_50, 1000 * 100 / (2 * 3.14159265358979 * 50), 1e-6);
  speeds.select(2);
  radius = 25;
  EXPECT_NEAR(now(1), 2 * at_50, 1e-6);
  EXPECT_NEAR(now(0), at_50, 1e-9) << "the speed at which it was before it was cancelled";
  speeds.surface(0, 0);
  radius = 10;
  EXPECT_NEAR(now(1), 2 * at_50, 1e-6) << "G97";
}

TEST_F(Speeds, AResetTakesEveryClampBack) {
  speeds.select(3);
  speeds.command(3000);
  speeds.clamp(1000, 0, NC_CLAMP_S | NC_CLAMP_ALWAYS);
  speeds.select(2);
  speeds.clamp(1500, 0, NC_CLAMP_S | NC_CLAMP_ALWAYS | NC_CLAMP_OVER_RESET);  // M700 10.4 (3), #1210 bit 19
  speeds.select(1);
  EXPECT_EQ(now(0), 1000);
  speeds.reset();
  EXPECT_EQ(now(0), 3000);
  speeds.select(3);
  EXPECT_EQ(now(1), 1500);
  speeds.select(1);
  speeds.clamp(0, 0, 0);  // the end of a program
  speeds.select(3);
  EXPECT_EQ(now(1), 3000);
}

// The example of the Series 8 reference, G92: 300 feet per minute at X8 with a radius of 4 inches, at most 600 r/min; X is a diameter from then on.
TEST_F(Speeds, FollowsTheRadiusThatWasGivenForAPosition) {
  constexpr double kInch = 25.4;
  radius = 8 * kInch;
  speeds.surface_radius(4 * kInch, 1);
  speeds.clamp(600, 0, NC_CLAMP_S);
  speeds.surface(300 * 0.3048, 1);
  EXPECT_NEAR(now(0), 143, 0.5);
  radius = 1.9099 * kInch;
  EXPECT_NEAR(now(0), 600, 0.1);
  radius = 2 * kInch;
  EXPECT_NEAR(now(0), 573, 0.5);
  radius = -0.01 * kInch;
  EXPECT_EQ(now(0), 600);
  speeds.reset();
  speeds.surface(300 * 0.3048, 1);
  radius = 4 * kInch;
  EXPECT_NEAR(now(0), 143, 0.5) << "behind a reset the coordinate is the radius again";
}

}  // namespace
}  // namespace nc
