// SPDX-License-Identifier: Apache-2.0
// The list of alarms is full of what stops the machine: what is told once gives way, or finds no room, and is told when there is room again.
#include <gtest/gtest.h>

#include <memory>

#include "fake_nc.hpp"
#include "runtime/scan.hpp"
#include "test_config.hpp"

namespace {

using nc::rt::AlarmId;

// Eight contacts, and three axes and two spindles with all faults that there are: sixteen alarms.
class TroubledHal final : public nc::hal::Hal {
 public:
  bool start(const nc::hal::PointImage&, std::string*) override { return true; }
  void read(nc::hal::Feedback* feedback, nc::hal::PointImage*) noexcept override {
    feedback->system[0].drive_fault = feedback->system[0].following_fault = troubled ? 7 : 0;
    feedback->system[0].spindle_fault = troubled ? 3 : 0;
  }
  void write(const nc::hal::Command&, const nc::hal::PointImage&) noexcept override {}
  void stop() noexcept override {}
  bool troubled = false;
};

class ContactLadder final : public nc::rt::LadderHook {
 public:
  void scan(nc::rt::LadderImage* image) noexcept override { image->requests->alarm = open ? 0xff : 0; }
  bool open = false;
};

TEST(AlarmsToldLater, WhatIsToldOnceIsToldWhenThereIsRoom) {
  for (const bool before : {true, false}) {
    SCOPED_TRACE(before ? "it was in the list, and has given way" : "it found no room");
    const nc::rt::Config config = nc::test::parse_or_fail(nc::test::base_toml());
    nc::rt::VirtualClock clock;
    TroubledHal hal;
    ContactLadder ladder;
    nc::test::FakeNc control;
    const auto scan = std::make_unique<nc::rt::Scan>(config, &clock, &hal, &ladder, &control);
    const auto steps = [&scan](int n) {
      while (n-- > 0) scan->run_once();
    };
    const auto listed = [&scan](AlarmId id) {
      const nc::rt::Snapshot now = scan->snapshot();
      for (unsigned i = 0; i < now.alarms.count; ++i)
        if (now.alarms.alarm[i].id == id) return true;
      return false;
    };
    const auto lost = [&scan] {
      scan->post_retain_trouble(nc::rt::retain_detail(1, nc::rt::RetainTrouble::kLost));
      scan->post_found_place();
      scan->post_print_trouble(0);
    };
    scan->begin();
    if (before) {
      lost();
      steps(2);
      EXPECT_TRUE(listed(AlarmId::kRetainedLost));
    }
    hal.troubled = ladder.open = true;
    steps(3);
    ASSERT_EQ(scan->snapshot().alarms.count, nc::rt::kMaxActiveAlarms);
    EXPECT_EQ(scan->snapshot().alarms.alarm[0].acknowledged, false);
    if (!before) lost();
    steps(3);
    for (const AlarmId id : {AlarmId::kRetainedLost, AlarmId::kPowerFailedBefore, AlarmId::kPrinter}) EXPECT_FALSE(listed(id)) << "sixteen others stop the machine";
    hal.troubled = ladder.open = false;
    ASSERT_TRUE(scan->post({nc::rt::CommandKind::kReset, 0, 0, 0, 0, 0, nc::rt::Asker::kConsole}));
    steps(5);
    for (const AlarmId id : {AlarmId::kRetainedLost, AlarmId::kPowerFailedBefore, AlarmId::kPrinter}) EXPECT_TRUE(listed(id));
    EXPECT_FALSE(scan->retain_loss_seen());
    EXPECT_FALSE(scan->place_seen());
  }
}

}  // namespace
