// SPDX-License-Identifier: Apache-2.0
// The joystick of the shipped machine etc/homed_mill.toml.
#include <fstream>
#include <sstream>

#include "axes_machine.hpp"
#include "places/places.hpp"

namespace {

class HomedMillStick : public nc::test::AxesMachine {
 protected:
  void SetUp() override {
    std::ifstream file(nc::test::kSourceDir + "/etc/homed_mill.toml");
    std::stringstream text;
    text << file.rdbuf();
    build(text.str(), 300);
    home_machine();
    in("stick_x", kMiddle);
    in("stick_y", kMiddle);
    in("grip", 1);
    steps(20);
  }
  double speed(unsigned axis) const { return out().velocity.v[axis]; }
  static constexpr std::uint32_t kMiddle = 2048;
};

TEST_F(HomedMillStick, LeadsBothAxesAsFarAsItIsOut) {
  in("stick_x", 40);
  in("stick_y", 4050);
  ASSERT_GE(until([&] { return std::abs(speed(kX) + 100) < 1e-6 && std::abs(speed(kY) + 100) < 1e-6; }, 1000), 0) << speed(kX) << " " << speed(kY) << " " << refusal();
  in("stick_x", 2048 - 1104);  // half of the way from the dead band to the end
  ASSERT_GE(until([&] { return std::abs(speed(kX) + 50) < 0.1; }, 1000), 0) << speed(kX);
  in("stick_y", kMiddle);
  ASSERT_GE(until([&] { return speed(kY) == 0; }, 1000), 0);
  in("grip", 0);
  ASSERT_GE(until([&] { return speed(kX) == 0; }, 1000), 0);
  steps(50);  // what follows the command
  const double stands = place(kX);
  in("grip", 1);
  steps(500);
  EXPECT_NEAR(place(kX), stands, 1e-3) << "the stick was out when the grip was taken";
  expect_limits_kept();
}

TEST_F(HomedMillStick, EndsAtTheSoftLimitAndMovesNothingInAProgram) {
  in("stick_x", 40);
  steps(500);
  ASSERT_LT(out().command.v[kX], -10);
  in("stick_x", 4055);
  ASSERT_GE(until([&] { return speed(kX) > 0; }, 1000), 0);
  ASSERT_GE(until([&] { return speed(kX) == 0; }, 20000), 0);
  EXPECT_NEAR(out().command.v[kX], 0, 1e-6) << "its soft limit";
  EXPECT_EQ(alarm(), "");
  in("stick_x", kMiddle);
  steps(20);
  ASSERT_EQ(start_program("G90 G53 G0 X-100. Y-50.\nM30\n"), nc::rt::Answer::kDone) << refusal();
  in("stick_y", 45);
  ASSERT_GE(until([&] { return out().state == NC_STATE_IDLE; }, 20000), 0);
  steps(100);
  EXPECT_NEAR(place(kX), -100, 1e-2);
  EXPECT_NEAR(place(kY), -50, 1e-2);
}

}  // namespace
