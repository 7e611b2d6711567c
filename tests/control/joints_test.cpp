// SPDX-License-Identifier: Apache-2.0
// Joints behind the axes (nc_config::kinematics): what comes out in each cycle, which of their limits are checked, and what stops the machine.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "control/online_helpers.hpp"

namespace nc::test {
namespace {

/// A bar of two arms in XY that carries a Z axis: 300 mm and 200 mm long, angles in degrees, elbow to the right.
constexpr double kFirst = 300, kSecond = 200, kDegree = std::numbers::pi / 180;

bool inverse(void* user, const nc_axes* machine, nc_axes* joint) {
  ++*static_cast<unsigned*>(user);
  const double x = machine->v[0], y = machine->v[1];
  const double cosine = (x * x + y * y - kFirst * kFirst - kSecond * kSecond) / (2 * kFirst * kSecond);
  if (!(std::fabs(cosine) <= 1)) return false;
  const double elbow = std::acos(cosine);
  joint->v[0] = (std::atan2(y, x) - std::atan2(kSecond * std::sin(elbow), kFirst + kSecond * std::cos(elbow))) / kDegree;
  joint->v[1] = elbow / kDegree;
  joint->v[2] = machine->v[2];
  return true;
}

bool forward(void*, const nc_axes* joint, nc_axes* machine) {
  const double a = joint->v[0] * kDegree, b = a + joint->v[1] * kDegree;
  machine->v[0] = kFirst * std::cos(a) + kSecond * std::cos(b);
  machine->v[1] = kFirst * std::sin(a) + kSecond * std::sin(b);
  machine->v[2] = joint->v[2];
  return joint->v[3] == 0;  // 0: the encoders are ready
}

struct Arm {
  unsigned asked = 0;
  nc_kinematics kinematics{};
  std::unique_ptr<Bench> bench;
  nc_inputs in{};
  nc_outputs out{};

  explicit Arm(const std::function<void(nc_kinematics&)>& change = {}) {
    kinematics.joint_count = 3;
    kinematics.inverse = inverse;
    kinematics.user = &asked;
    if (change) change(kinematics);
    bench = std::make_unique<Bench>(NC_DIALECT_M700, [this](nc_config& c) {
      machine(64)(c);
      c.kinematics[0] = &kinematics;
    });
    bench->at(400, 0, 0);
    nc_inputs_init(&in);
  }
  void cycle() {
    nc_feed(bench->control(), 100);
    ASSERT_EQ(nc_cycle(bench->control(), &in, &out), NC_OK);
    in.fin = out.strobe != 0;
  }
  void start(const std::string& text) {
    bench->start(text);
    for (unsigned i = 0; i < 3; ++i) in.cycle_start = i == 1, cycle();
  }
};

TEST(Joints, FollowTheCommandedPlaceInEveryCycle) {
  Arm arm;
  arm.kinematics.joint_count = 1;  // the control has its own copy
  arm.start("G1 X300. Y200. Z-5. F6000\nM30");
  nc_axes before = arm.out.joint;
  for (unsigned n = 0; n < 3000 && arm.out.state != NC_STATE_IDLE; ++n) {
    arm.cycle();
    nc_axes back{};
    ASSERT_TRUE(forward(nullptr, &arm.out.joint, &back));
    for (unsigned i = 0; i < 3; ++i) ASSERT_NEAR(back.v[i], arm.out.command.v[i], 1e-9);
    for (unsigned i = 0; i < 3; ++i) ASSERT_NEAR(arm.out.joint_velocity.v[i], (arm.out.joint.v[i] - before.v[i]) / 0.004, 1e-9);
    ASSERT_EQ(arm.out.joint_faults, 0);
    before = arm.out.joint;
  }
  EXPECT_EQ(arm.out.state, NC_STATE_IDLE);
  EXPECT_NEAR(arm.out.joint.v[2], -5, 1e-9);
  EXPECT_GT(arm.asked, 100u);
}

TEST(Joints, APlaceOutOfReachStopsThePartSystem) {
  Arm arm;
  arm.start("G1 X600. F60000\nM30");
  nc_axes last{};
  while (arm.out.joint_faults == 0) {
    last = arm.out.joint;
    arm.cycle();
    ASSERT_LT(arm.out.command.v[0], 599);
  }
  EXPECT_EQ(arm.out.joint_faults, NC_JOINT_UNREACHABLE);
  for (unsigned n = 0; n < 200; ++n) arm.cycle();
  EXPECT_EQ(arm.out.state, NC_STATE_ALARM);
  for (unsigned i = 0; i < 3; ++i) EXPECT_EQ(arm.out.joint.v[i], last.v[i]) << "they stay at the last good ones";
  EXPECT_EQ(arm.out.joint_velocity.v[0], 0);
  arm.in.reset = true;
  arm.cycle();
  arm.in.reset = false;
  arm.cycle();
  EXPECT_EQ(arm.out.state, NC_STATE_ALARM) << "still out of reach";
  arm.bench->at(400, 0, 0);
  for (unsigned n = 0; n < 3; ++n) arm.cycle();
  arm.in.reset = true;
  for (unsigned n = 0; n < 3; ++n) arm.cycle();
  EXPECT_EQ(arm.out.state, NC_STATE_IDLE);
  EXPECT_EQ(arm.out.joint_faults, 0);
}

TEST(Joints, TheirRangeIsKept) {
  Arm arm([](nc_kinematics& k) { k.joint[2].min = -1, k.joint[2].max = 1; });
  arm.start("G1 Z-5. F60000\nM30");
  for (unsigned n = 0; n < 300; ++n) {
    arm.cycle();
    ASSERT_GE(arm.out.joint.v[2], -1);
  }
  EXPECT_EQ(arm.out.joint_faults, NC_JOINT_RANGE);
  EXPECT_EQ(arm.out.state, NC_STATE_ALARM);
}

TEST(Joints, SpeedsAreReportedAndStopNothing) {
  Arm arm([](nc_kinematics& k) { k.joint[2].max_velocity = 10, k.joint[0].max_acceleration = 100; });
  arm.start("G1 Z-5. F60000\nX300. Y200.\nM30");
  unsigned seen = 0;
  for (unsigned n = 0; n < 3000 && arm.out.state != NC_STATE_IDLE; ++n) {
    arm.cycle();
    seen |= arm.out.joint_faults;
  }
  EXPECT_EQ(seen, unsigned{NC_JOINT_VELOCITY | NC_JOINT_ACCELERATION});
  EXPECT_EQ(arm.out.state, NC_STATE_IDLE);
  EXPECT_NEAR(arm.out.joint.v[2], -5, 1e-9);
}

TEST(Joints, MeasuredJointsBecomeThePlace) {
  Arm arm([](nc_kinematics& k) { k.forward = forward; });
  arm.in.follow_up = arm.in.actual_valid = true;
  arm.in.actual = nc_axes{};
  arm.in.actual.v[1] = 90;
  for (unsigned n = 0; n < 3; ++n) arm.cycle();
  EXPECT_NEAR(arm.out.command.v[0], 300, 1e-9);
  EXPECT_NEAR(arm.out.command.v[1], 200, 1e-9);
  EXPECT_NEAR(arm.out.joint.v[1], 90, 1e-9);
  arm.in.actual.v[3] = 1;
  arm.cycle();
  EXPECT_EQ(arm.out.joint_faults, NC_JOINT_ACTUAL);
  EXPECT_NEAR(arm.out.command.v[0], 300, 1e-9);
  arm.in.actual.v[3] = 0;
  arm.in.actual.v[0] = NAN;
  arm.cycle();
  EXPECT_EQ(arm.out.joint_faults, NC_JOINT_ACTUAL);
}

TEST(Joints, LatchedJointsBecomeTheSkipPosition) {
  for (const bool good : {true, false}) {
    Arm arm([](nc_kinematics& k) { k.forward = forward; });
    arm.in.skip_latched = 1;
    arm.in.skip_place.v[1] = 90;
    if (!good) arm.in.skip_place.v[3] = 1;
    arm.cycle();
    EXPECT_EQ(arm.out.joint_faults, good ? 0 : NC_JOINT_ACTUAL);
    EXPECT_EQ(arm.out.inputs_refused, 0u);
  }
}

TEST(Joints, ANumberThatIsNoneIsOutOfReach) {
  Arm arm([](nc_kinematics& k) {
    k.inverse = [](void*, const nc_axes* machine, nc_axes* joint) {
      *joint = *machine;
      if (machine->v[0] > 402) joint->v[1] = INFINITY;
      return true;
    };
  });
  arm.start("G1 X410. F6000\nM30");
  for (unsigned n = 0; n < 500; ++n) arm.cycle();
  EXPECT_EQ(arm.out.joint_faults, NC_JOINT_UNREACHABLE);
  EXPECT_LE(arm.out.joint.v[0], 402);
  EXPECT_EQ(arm.out.state, NC_STATE_ALARM);
}

TEST(Joints, WithoutThemThereAreNone) {
  Bench bench;
  nc_inputs in{};
  nc_inputs_init(&in);
  nc_outputs out{};
  out.joint_faults = 7;
  bench.at(5, 6, 7);
  nc_cycle(bench.control(), &in, &out);
  EXPECT_EQ(out.joint.v[0], 0);
  EXPECT_EQ(out.joint_faults, 0);
}

TEST(Joints, WhatIsRefusedIsNamed) {
  const auto refused = [](const std::function<void(nc_kinematics&)>& change) {
    nc_config config;
    nc_config_init(&config);
    nc_kinematics kinematics{};
    kinematics.joint_count = 3;
    kinematics.inverse = inverse;
    change(kinematics);
    config.kinematics[0] = &kinematics;
    nc_config_fault fault;
    return nc_config_check(&config, &fault) == NC_OK ? std::string() : std::string(fault.field);
  };
  EXPECT_EQ(refused([](nc_kinematics&) {}), "");
  EXPECT_EQ(refused([](nc_kinematics& k) { k.struct_size = 3; }), "kinematics[0].struct_size");
  EXPECT_EQ(refused([](nc_kinematics& k) { k.joint_count = 0; }), "kinematics[0].joint_count");
  EXPECT_EQ(refused([](nc_kinematics& k) { k.joint_count = NC_MAX_AXES + 1; }), "kinematics[0].joint_count");
  EXPECT_EQ(refused([](nc_kinematics& k) { k.inverse = nullptr; }), "kinematics[0].inverse");
  EXPECT_EQ(refused([](nc_kinematics& k) { k.joint[2].min = 1; }), "kinematics[0].joint[2].min");
  EXPECT_EQ(refused([](nc_kinematics& k) { k.joint[1].max = NAN; }), "kinematics[0].joint[1].max");
  EXPECT_EQ(refused([](nc_kinematics& k) { k.joint[1].max_velocity = -1; }), "kinematics[0].joint[1].max_velocity");
  EXPECT_EQ(refused([](nc_kinematics& k) { k.joint[0].max_acceleration = INFINITY; }), "kinematics[0].joint[0].max_acceleration");
}

}  // namespace
}  // namespace nc::test
