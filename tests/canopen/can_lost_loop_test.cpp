// SPDX-License-Identifier: Apache-2.0
// Axes whose position the control holds, and whose loop is lost: the motor turns the wrong way, the encoder stands or jumps. What the control gives such a drive then only takes the axis further away.
#include <cmath>

#include "can_rig.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::test::can_toml;
using nc::test::CanRig;
using nc::test::kIncrementsPerMm;

constexpr double kLimit = 2.0;                 // mm: following_error_limit of the rig
constexpr double kIncrement = 1 / kIncrementsPerMm;
constexpr double kBoundSpeed = 200.0 * 1.25;   // mm/s: no axis is given more
constexpr unsigned kReaction = 4;              // SYNCs from the place beyond the limit to the quick stop: measured with one, known and answered behind it, taken with the next one
constexpr double kQuickStopSyncs = 5;          // in which the simulated quick stop would go on at its first speed

// Z is in the same mode, and has no fault.
std::string lost_loop_toml() {
  std::string text = can_toml("", "mode = \"velocity\"\nvelocity_delay = 2.0\n");
  return text + "mode = \"velocity\"\nvelocity_delay = 2.0\n";
}

struct LostLoop : testing::Test {
  CanRig rig{lost_loop_toml()};

  void SetUp() override { rig.bring_up(); }
  nc::test::SimPlantAxis& x() { return rig.drives[0]->plant(); }
  bool following_error() const { return rig.alarms().find("R11 Following error beyond its limit, axis X") != std::string::npos; }
  // Goes on until the alarm is there and X stands without torque.
  void expect_let_go(unsigned most = 3000) {
    ASSERT_TRUE(rig.until([this] { return following_error(); }, most)) << rig.alarms();
    rig.step(100);
    EXPECT_FALSE(rig.drives[0]->enabled());
    EXPECT_FALSE(x().enabled) << "its quick stop has ended";
    EXPECT_EQ(rig.drives[0]->speed(), 0);
  }
  // X has no torque and no speed, and stays where it is. The other drives hold their axes.
  void expect_stays_let_go(unsigned scans) {
    const double place = x().position, y = rig.plant_mm(1), z = rig.plant_mm(2);
    for (unsigned i = 0; i < scans; ++i) {
      rig.step();
      ASSERT_FALSE(rig.drives[0]->enabled()) << i;
      ASSERT_EQ(rig.drives[0]->speed(), 0) << i;
    }
    EXPECT_DOUBLE_EQ(x().position, place);
    EXPECT_TRUE(rig.drives[1]->enabled());
    EXPECT_TRUE(rig.drives[2]->enabled());
    EXPECT_NEAR(rig.plant_mm(1), y, kIncrement);
    EXPECT_NEAR(rig.plant_mm(2), z, kIncrement);
    EXPECT_TRUE(following_error()) << rig.alarms();
    EXPECT_EQ(rig.alarms().find("R12"), std::string::npos) << rig.alarms();
  }
  void mend_and_reset() {
    x().turns = 1;
    x().encoder_at.reset();
    ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
    ASSERT_TRUE(rig.until([this] { return rig.following() && rig.alarms().empty(); }, 3000)) << rig.alarms();
  }
  void expect_works() {
    ASSERT_EQ(rig.mdi("G90 G01 X10. Y-10. Z5. F3000"), Answer::kDone);
    rig.step(20);
    ASSERT_TRUE(rig.until([this] { return rig.idle(); }, 20000)) << rig.alarms();
    rig.step(300);
    EXPECT_EQ(rig.alarms(), "");
    EXPECT_NEAR(rig.actual(0), 10.0, 2 * kIncrement);
    EXPECT_NEAR(rig.plant_mm(1), -10.0, 2 * kIncrement);
    EXPECT_NEAR(rig.plant_mm(2), 5.0, 2 * kIncrement);
  }
};

// What holds an axis at rest drives it away, faster with every SYNC: within the limit it is found, and there is the way that it makes in the reaction and in its quick stop.
TEST_F(LostLoop, AMotorThatTurnsTheWrongWayIsLetGoWithinTheLimitAlsoAtRest) {
  x().turns = -1;
  x().position = 2;  // increments
  expect_let_go(5000);
  EXPECT_LE(std::abs(rig.plant_mm(0)), kLimit + 30 * kLimit * 0.001 * (kReaction + kQuickStopSyncs)) << "gain times limit is its speed there";
  expect_stays_let_go(3000);
  mend_and_reset();
  EXPECT_NEAR(rig.command(0), rig.actual(0), kIncrement) << "it begins with no distance";
  expect_works();
}

TEST_F(LostLoop, AMotorThatTurnsTheWrongWayInAMoveIsLetGoAndTheOthersStopOnTheirPaths) {
  x().turns = -1;
  ASSERT_EQ(rig.mdi("G90 G01 X100. Y100. Z100. F6000"), Answer::kDone);
  double speed = 0, hardest = 0, place = rig.plant_mm(1);
  for (unsigned i = 0; i < 1500; ++i) {
    rig.step();
    const double now = rig.plant_mm(1) - place;
    hardest = std::max(hardest, std::abs(now - speed));
    speed = now;
    place = rig.plant_mm(1);
    ASSERT_TRUE(rig.drives[1]->enabled() && rig.drives[2]->enabled());
  }
  EXPECT_LE(hardest, 2000.0 * 1e-6 + 2 * kIncrement) << "no more than max_acceleration takes in a SYNC";
  EXPECT_NEAR(rig.plant_mm(1), rig.plant_mm(2), 0.001) << "on the path";
  expect_let_go();
  EXPECT_LE(std::abs(rig.plant_mm(0)), kLimit + kBoundSpeed * 0.001 * (kReaction + kQuickStopSyncs));
  expect_stays_let_go(3000);
  mend_and_reset();
  expect_works();
}

// The motor has turned as it should; how far is bounded by the way of the command and what a distance of the limit adds until it is found.
TEST_F(LostLoop, AnEncoderThatStandsLetsTheAxisGo) {
  x().encoder_at = 0;
  ASSERT_EQ(rig.mdi("G90 G01 X40. Y40. F600"), Answer::kDone);
  expect_let_go();
  const double speed = 10.0 / std::sqrt(2.0);  // mm/s, of X on the diagonal
  const double worst = kLimit + 30 * kLimit * kLimit / (2 * speed) + kBoundSpeed * 0.001 * (kReaction + kQuickStopSyncs);
  EXPECT_LE(std::abs(rig.plant_mm(0)), worst);
  expect_stays_let_go(3000);
}

// At a slow feed the distance takes long to come to its limit, and the motor turns faster all the time: by 62 mm at 1 mm/s. What it was given is compared with what was measured (way_watch.hpp).
TEST_F(LostLoop, AnEncoderThatStandsAtASlowFeedLetsTheAxisGo) {
  for (const double feed : {0.2, 1.0, 4.0}) {
    SCOPED_TRACE(feed);
    const double place = rig.plant_mm(0), to = rig.actual(0) + 100;
    x().encoder_at = x().position;
    ASSERT_EQ(rig.mdi("G90 G01 X" + std::to_string(to) + " F" + std::to_string(feed * 60)), Answer::kDone);
    expect_let_go(40000);
    EXPECT_LE(std::abs(rig.plant_mm(0) - place), 4.5 * kLimit + 30 * kLimit * kLimit / (22 * feed) + 30 * kLimit * 0.001 * (kReaction + kQuickStopSyncs));
    expect_stays_let_go(100);
    x().position = *x().encoder_at;  // back at the place that it says
    mend_and_reset();
    EXPECT_EQ(rig.alarms(), "");
  }
  expect_works();
}

// By less than an axis can move in that time, else it is a fault of the drive (PositionCount.*). A distance of 2.2 mm would be 66 mm/s.
TEST_F(LostLoop, AnEncoderThatJumpsMovesNothing) {
  x().encoder_at = 2.2 * kIncrementsPerMm;
  rig.step(20);
  EXPECT_DOUBLE_EQ(x().position, 0);
  expect_let_go();
  expect_stays_let_go(500);
  x().position = *x().encoder_at;  // where it says that it is
  mend_and_reset();
  EXPECT_DOUBLE_EQ(rig.plant_mm(0), 2.2) << "it comes on where it is measured, and nothing moves";
  EXPECT_NEAR(rig.command(0), 2.2, kIncrement);
  expect_works();
}

TEST_F(LostLoop, AFeedHoldChangesNothingOfIt) {
  ASSERT_EQ(rig.mdi("G90 G01 X100. Y100. F3000"), Answer::kDone);
  rig.step(300);
  ASSERT_EQ(rig.run(CommandKind::kFeedHold), Answer::kDone);
  rig.step(10);
  x().turns = -1;
  expect_let_go(5000);
  expect_stays_let_go(1000);
}

// Another axis has stopped the path: X is watched on.
TEST_F(LostLoop, TwoAxesAreLetGoEachByItsOwnError) {
  rig.drives[2]->plant().turns = -1;
  rig.drives[2]->plant().position = 2;
  ASSERT_TRUE(rig.until([this] { return rig.alarms().find("axis Z") != std::string::npos; }, 5000)) << rig.alarms();
  EXPECT_TRUE(rig.drives[0]->enabled());
  x().turns = -1;
  x().position = 2;
  expect_let_go(5000);
  EXPECT_FALSE(rig.drives[2]->enabled());
  EXPECT_TRUE(rig.drives[1]->enabled());
}

// The fault is still there: each reset gives it the limit once more, and no speed stays.
TEST_F(LostLoop, AResetWithoutAMendedFaultIsTheLimitOnceMore) {
  x().turns = -1;
  x().position = 2;
  expect_let_go(5000);
  for (unsigned n = 0; n < 3; ++n) {
    const double place = rig.plant_mm(0);
    ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
    ASSERT_TRUE(rig.until([this] { return rig.following(); }, 3000)) << rig.alarms();
    x().position += 2;
    expect_let_go(5000);
    EXPECT_LE(std::abs(rig.plant_mm(0) - place), kLimit + 30 * kLimit * 0.001 * (kReaction + kQuickStopSyncs) + 2 * kIncrement);
    expect_stays_let_go(300);
  }
}

// A reset pressed at once: the drive comes on when its quick stop has ended, the axis stands and the command has come to it; not while it moves.
TEST_F(LostLoop, AResetInTheQuickStopWaitsUntilTheAxisStands) {
  x().turns = -1;
  ASSERT_EQ(rig.mdi("G90 G01 X100. Y100. F6000"), Answer::kDone);
  ASSERT_TRUE(rig.until([this] { return following_error(); }, 3000)) << rig.alarms();
  x().turns = 1;
  (void)rig.run(CommandKind::kReset);
  double before = x().position;
  for (unsigned i = 0; i < 3000 && !rig.drives[0]->enabled(); ++i) {
    before = x().position;
    rig.step();
  }
  ASSERT_TRUE(rig.drives[0]->enabled());
  EXPECT_DOUBLE_EQ(x().position, before);
  ASSERT_TRUE(rig.until([this] { return rig.following() && rig.idle(); }, 3000)) << rig.alarms();
  EXPECT_EQ(rig.alarms(), "");
  EXPECT_NEAR(rig.command(0), rig.actual(0), kIncrement);
  expect_works();
}

// A hanging axis that sinks, or one that somebody turns, is not caught in its way.
TEST_F(LostLoop, AnAxisThatIsMovedIsNotSwitchedOn) {
  x().turns = -1;
  x().position = 2;
  expect_let_go(5000);
  x().turns = 1;
  (void)rig.run(CommandKind::kReset);
  for (unsigned i = 0; i < 1000; ++i) {
    x().position += 40;  // 20 mm/s
    rig.step();
    ASSERT_FALSE(rig.drives[0]->enabled()) << i;
  }
  ASSERT_TRUE(rig.until([this] { return rig.following(); }, 1000)) << rig.alarms();
  EXPECT_NEAR(rig.command(0), rig.actual(0), kIncrement);
}

// Its drive has let the axis go, so nothing but the brake holds it.
TEST(LostLoopBrake, ItsBrakeClosesAtOnce) {
  std::string text = lost_loop_toml();
  text.insert(text.find("max_velocity"), "brake = { point = \"x_brake\", open_s = 0.05, close_s = 0.1 }\n");
  text.insert(text.find("[[point]]"), "[[point]]\nname = \"x_brake\"\ndirection = \"output\"\n");
  CanRig rig(text);
  rig.bring_up();
  const auto open = [&rig] { return (rig.runtime->snapshot().system[0].axes.brake_open & 1u) != 0; };
  ASSERT_TRUE(rig.until(open, 2000));
  rig.drives[0]->plant().turns = -1;
  ASSERT_TRUE(rig.until([&rig] { return rig.following(); }, 2000));
  rig.drives[0]->plant().position += 2;
  ASSERT_TRUE(rig.until([&rig] { return !rig.alarms().empty(); }, 5000));
  rig.step(2);
  EXPECT_FALSE(open());
  rig.step(500);
  EXPECT_FALSE(open());
  EXPECT_FALSE(rig.drives[0]->enabled());
  rig.drives[0]->plant().turns = 1;
  ASSERT_EQ(rig.run(CommandKind::kReset), Answer::kDone);
  ASSERT_TRUE(rig.until([&rig] { return rig.following(); }, 2000)) << rig.alarms();
  ASSERT_TRUE(rig.until(open, 2000));
  EXPECT_EQ(rig.alarms(), "");
}

}  // namespace
