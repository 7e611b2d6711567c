// SPDX-License-Identifier: Apache-2.0
// The state machine of CiA 402: each row of the table of the status word, and the control words that lead through the states.
#include "hal/canopen/drive_state.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "hal/drive_fault.hpp"

namespace {

using namespace nc::hal::canopen;

TEST(DriveState, EachCodingOfTheStatusWord) {
  const std::vector<std::pair<std::uint16_t, DriveState>> rows = {
      {0x0000, DriveState::kNotReady},       {0x0040, DriveState::kSwitchOnDisabled}, {0x0060, DriveState::kSwitchOnDisabled}, {0x0021, DriveState::kReadyToSwitchOn},
      {0x0023, DriveState::kSwitchedOn},     {0x0027, DriveState::kOperationEnabled}, {0x0007, DriveState::kQuickStopActive},  {0x000F, DriveState::kFaultReaction},
      {0x002F, DriveState::kFaultReaction},  {0x0008, DriveState::kFault},            {0x0028, DriveState::kFault}};
  for (const auto& [status, state] : rows)
    for (const unsigned others : {0x0000u, 0xFF90u})  // bits that are not part of the state
      EXPECT_EQ(drive_state(static_cast<std::uint16_t>(status | others)), state) << std::hex << (status | others);
}

TEST(DriveState, TheWayToOperationEnabled) {
  DriveWay way;
  EXPECT_EQ(way.next(0x0040, DriveWish::kOn), kShutdown);
  EXPECT_EQ(way.next(0x0021, DriveWish::kOn), kSwitchOn);
  EXPECT_EQ(way.next(0x0023, DriveWish::kOn), kEnableOperation);
  EXPECT_EQ(way.next(0x0027, DriveWish::kOn), kEnableOperation);
  EXPECT_EQ(way.next(0x0007, DriveWish::kOn), kDisableVoltage);
  EXPECT_EQ(way.next(0x0008, DriveWish::kOn), kDisableVoltage);  // only a reset leaves a fault
}

TEST(DriveState, OffIsAQuickStopThatEnds) {
  DriveWay way(3);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(way.next(i == 0 ? 0x0027 : 0x0007, DriveWish::kOff), kQuickStop);
  EXPECT_EQ(way.next(0x0007, DriveWish::kOff), kDisableVoltage);  // a drive that stays in quick stop is switched off
  EXPECT_EQ(way.next(0x0040, DriveWish::kOff), kShutdown);
  EXPECT_EQ(way.next(0x0027, DriveWish::kOff), kQuickStop);  // the time limit begins again
}

TEST(DriveState, AResetIsARisingEdgeAgainAndAgain) {
  DriveWay way;
  unsigned edges = 0;
  std::uint16_t last = kFaultReset;
  for (int i = 0; i < 64; ++i) {
    const std::uint16_t word = way.next(0x0008, DriveWish::kReset);
    EXPECT_TRUE(word == kFaultReset || word == kDisableVoltage);
    edges += word == kFaultReset && last != kFaultReset ? 1 : 0;
    last = word;
  }
  EXPECT_EQ(edges, 8u);
  EXPECT_EQ(way.next(0x0040, DriveWish::kReset), kShutdown);
}

TEST(DriveFault, EachCodeHasItsNarrowestText) {
  using nc::hal::emergency_text;
  EXPECT_STREQ(emergency_text(0x8611), "following error");
  EXPECT_STREQ(emergency_text(0x8130), "the heartbeat of the control did not come");
  EXPECT_STREQ(emergency_text(0x8150), "two nodes with one identifier");
  EXPECT_STREQ(emergency_text(0x8199), "monitoring of the communication");
  EXPECT_STREQ(emergency_text(0x2399), "current");
  EXPECT_STREQ(emergency_text(0xFF01), "of the manufacturer");
  EXPECT_STREQ(emergency_text(0), "error reset or no error");
  EXPECT_EQ(nc::hal::drive_fault_text(nc::hal::drive_fault_code(nc::hal::DriveTrouble::kEmergency, 0x3120, 4)), "EMCY 3120h: mains under-voltage (error register 04h)");
  EXPECT_EQ(nc::hal::drive_fault_text(0), "");
  for (unsigned trouble = 2; trouble <= static_cast<unsigned>(nc::hal::DriveTrouble::kJump); ++trouble)
    EXPECT_NE(nc::hal::drive_fault_text(trouble << 24), "") << trouble;
}

}  // namespace
