// SPDX-License-Identifier: Apache-2.0
// The length along a tool that a head turns which is no axis of the part system (M700 12.3, "when mechanical axes are used"): its angles are inputs. Places are those of a second
// writing of the section.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "support/watched_machine.hpp"

namespace nc::test {
namespace {

constexpr double kLength = 50;

std::array<double, 3> vector_of(nc_tool_axis kind, double tilt_deg, double turn_deg) {
  const double t = tilt_deg * std::acos(-1.0) / 180, c = turn_deg * std::acos(-1.0) / 180;
  if (kind == NC_TOOL_AXIS_MECHANICAL_A) return {kLength * std::sin(t) * std::sin(c), -kLength * std::sin(t) * std::cos(c), kLength * std::cos(t)};
  return {kLength * std::sin(t) * std::cos(c), kLength * std::sin(t) * std::sin(c), kLength * std::cos(t)};
}

struct Head {
  WatchedMachine machine;
  nc_tool_axis kind;
  double near;  ///< the optimal mode stops on the rounding of a corner, within the tolerance

  Head(nc_tool_axis of, bool optimal)
      : machine(NC_DIALECT_M700, "XYZ", {300, 300, 300}, optimal, 40, [of](nc_config& c) { c.system[0].tool_axis = of; }), kind(of), near(optimal ? 0.0101 : 1e-9) {
    machine.bench.tool(1, kLength);
  }
  nc_inputs& in() { return machine.drive->in; }
  const nc_outputs& out() const { return machine.drive->out; }
  void turn(double tilt, double about_z) { in().tool_angle[0] = tilt, in().tool_angle[1] = about_z; }
  /// Executes the first line, which stops in a block stop.
  void start(const std::string& text) {
    machine.start(text);
    until_stop();
  }
  void until_stop() {
    machine.step(5);
    for (unsigned n = 0; n < 60000 && out().state == NC_STATE_RUNNING; ++n) machine.step();
    machine.step(3);
  }
  void block() {
    machine.press();
    until_stop();
  }
  void expect_at(double x, double y, double z, double tilt, double about_z) const {
    const std::array<double, 3> vector = vector_of(kind, tilt, about_z);
    const double place[] = {x, y, z};
    for (unsigned i = 0; i < 3; ++i) EXPECT_NEAR(out().command.v[i], place[i] + vector[i], near) << "axis " << i << " angles " << tilt << " " << about_z;
  }
};

class MechanicalToolAxis : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(BothLaws, MechanicalToolAxis, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

TEST_P(MechanicalToolAxis, TheVectorGoesByTheAnglesThatTheMachineGives) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> angle(-200, 200);
  for (unsigned n = 0; n < 20; ++n) {
    Head head(n % 2 == 0 ? NC_TOOL_AXIS_MECHANICAL_A : NC_TOOL_AXIS_MECHANICAL_B, GetParam());
    const double tilt = n < 2 ? 90 : angle(random), about_z = n < 2 ? 90 : angle(random);
    head.start("G90 G1 F9000\nG43.1 H1 X1. Y2. Z3.\nX10.\nM30");
    head.turn(tilt, about_z);
    head.block();
    head.expect_at(1, 2, 3, tilt, about_z);
    head.turn(1, 1);  // nothing has been told the machine that turns the head: the angles stay
    head.block();
    head.expect_at(10, 2, 3, tilt, about_z);
    EXPECT_EQ(head.machine.drive->alarm(), "");
  }
}

TEST_P(MechanicalToolAxis, BehindACodeForTheMachineTheAnglesAreReadAgain) {
  Head head(NC_TOOL_AXIS_MECHANICAL_A, GetParam());
  head.start("G90 G1 F9000\nG43.1 H1 X0 Y0 Z0\nX1.\nM50\nX10.\nX20. M51\nG91 X1.\nG90 G49 Z0\nM50\nX3.\nM30");
  head.in().single_block = false;
  head.turn(30, 40);
  head.machine.press();
  double tilt = 30, about_z = 40;
  bool seen[4] = {};
  const auto ends_at = [](const nc_event& event, double x, double tilt_deg, double turn_deg) {
    const std::array<double, 3> vector = vector_of(NC_TOOL_AXIS_MECHANICAL_A, tilt_deg, turn_deg);
    return std::fabs(event.machine.v[0] - x - vector[0]) + std::fabs(event.machine.v[1] - vector[1]) + std::fabs(event.machine.v[2] - vector[2]) < 1e-6;
  };
  for (unsigned n = 0; n < 60000 && head.out().state == NC_STATE_RUNNING; ++n) {
    head.machine.step();
    if (head.out().strobe != 0 && head.out().m == 50) tilt = 90, about_z = 90;
    if (head.out().strobe != 0 && head.out().m == 51) tilt = 0, about_z = 10;
    head.turn(tilt, about_z);
    for (size_t i = head.machine.drive->fresh; i < head.machine.drive->events.size(); ++i) {
      const nc_event& event = head.machine.drive->events[i];
      if (event.kind != NC_ITEM_MOVE) continue;
      if (event.source.line == 3) seen[0] = ends_at(event, 1, 30, 40);
      if (event.source.line == 5) seen[1] = ends_at(event, 10, 90, 90);
      if (event.source.line == 7) seen[2] = ends_at(event, 21, 0, 10);
      if (event.source.line == 10) seen[3] = true;
    }
  }
  for (unsigned i = 0; i < 4; ++i) EXPECT_TRUE(seen[i]) << i;
  EXPECT_NEAR(head.out().command.v[0], 3, head.near);
  EXPECT_EQ(head.machine.drive->alarm(), "");
  EXPECT_LT(head.machine.worst, 1.001);
}

TEST_P(MechanicalToolAxis, AnglesThatAreNoneAreRefusedAndTheLastOnesAct) {
  Head head(NC_TOOL_AXIS_MECHANICAL_B, GetParam());
  head.start("G90 G1 F9000\nG43.1 H1 X0 Y0 Z0\nM30");
  head.turn(30, 40);
  head.machine.step();
  EXPECT_EQ(head.out().inputs_refused, 0u);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1.1e6}) {
    head.turn(bad, -bad);
    head.machine.step();
    EXPECT_EQ(head.out().inputs_refused, static_cast<uint32_t>(NC_INPUT_TOOL_ANGLE));
  }
  head.block();
  head.expect_at(0, 0, 0, 30, 40);
}

TEST_P(MechanicalToolAxis, TheHandleAndTheReferenceReturnActAsWithAxes) {
  Head head(NC_TOOL_AXIS_MECHANICAL_A, GetParam());
  head.start("G90 G1 F9000\nG43.1 H1 X0 Y0 Z0\nX10.\nY5.\nM30");
  head.turn(90, 90);
  head.block();
  head.in().tool_length_handle = 2;
  head.machine.step();
  head.in().tool_length_handle = 0;
  head.block();
  EXPECT_NEAR(head.out().command.v[0], 10 + kLength + 2, head.near);
  head.in().manual[1] = {NC_MANUAL_REFERENCE, 0, 0};
  head.machine.step(200);
  head.in().manual[1] = {};
  head.machine.step(2);
  head.block();
  EXPECT_NEAR(head.out().command.v[0], 10 + kLength + 2, head.near);
  EXPECT_NEAR(head.out().command.v[1], 5, head.near);
  EXPECT_EQ(head.out().tool_length_added, 0);
}

// Offline the host answers; P930 is for a machine that has neither such a head nor a pair of axes.
TEST(MechanicalToolAxisOffline, TheHostGivesTheAngles) {
  const auto run = [](uint64_t kind, double tilt) {
    Bench bench(NC_DIALECT_M700, [kind](nc_config& c) { c.system[0].tool_axis = kind; });
    bench.tool(1, kLength);
    bench.start("G90 G1 F100 G43.1 H1 X0 Y0 Z0\nM30");
    nc_item item;
    double reached = NAN;
    for (unsigned n = 0; n < 100; ++n) {
      nc_item_init(&item);
      const nc_status status = nc_pull(bench.control(), 0, 100, &item);
      if (status != NC_OK) return status == NC_ENDED ? reached : status == NC_ALARMED ? -1.0 : NAN;
      if (item.kind == NC_ITEM_MOVE) reached = item.u.move.machine.v[1];
      if (item.kind != NC_ITEM_SYNC) continue;
      EXPECT_EQ(item.u.sync.what, static_cast<uint32_t>(NC_SYNC_INPUT));
      nc_world world;
      nc_world_init(&world);
      for (const double bad : {std::numeric_limits<double>::quiet_NaN(), 1e7}) {
        world.tool_angle[1] = bad;
        EXPECT_EQ(nc_answer(bench.control(), 0, &world), NC_E_ARGUMENT);
      }
      world.tool_angle[0] = tilt;
      world.tool_angle[1] = 0;
      EXPECT_EQ(nc_answer(bench.control(), 0, &world), NC_OK);
    }
    return static_cast<double>(NAN);
  };
  EXPECT_NEAR(run(NC_TOOL_AXIS_MECHANICAL_A, 90), -kLength, 1e-9);
  EXPECT_NEAR(run(NC_TOOL_AXIS_MECHANICAL_A, 30), -kLength / 2, 1e-9);
  EXPECT_EQ(run(NC_TOOL_AXIS_TURNED, 0), -1);
}

}  // namespace
}  // namespace nc::test
