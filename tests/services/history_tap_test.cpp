// SPDX-License-Identifier: Apache-2.0
// What the scan tells the history: each change once, and what is lost is counted.
#include "runtime/history/scan_tap.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace nc::rt::history {
namespace {

ActiveAlarm alarm_of(std::uint64_t scan) {
  ActiveAlarm alarm;
  alarm.id = AlarmId::kDriveFault;
  alarm.scan = scan;
  return alarm;
}

struct Taps {
  std::unique_ptr<ScanTap> tap = std::make_unique<ScanTap>();
  std::unique_ptr<Snapshot> now = std::make_unique<Snapshot>();
  void scan(std::vector<std::uint64_t> alarms) {
    ++now->scan;
    now->time_ns += 1'000'000;
    now->alarms.count = 0;
    for (const std::uint64_t alarm : alarms) now->alarms.alarm[now->alarms.count++] = alarm_of(alarm);
    tap->look(*now);
  }
  std::vector<ScanEvent> take(std::size_t most = 1000) {
    std::vector<ScanEvent> events;
    for (ScanEvent event; events.size() < most && tap->pop(&event);) events.push_back(event);
    return events;
  }
};

TEST(HistoryTap, TellsEachAlarmOnceWhenItComesAndWhenItGoes) {
  Taps taps;
  taps.scan({});
  taps.scan({2});
  taps.scan({2});
  taps.scan({2, 4});
  taps.scan({4});
  const std::vector<ScanEvent> events = taps.take();
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[0].kind, ScanEvent::Kind::kRaised);
  EXPECT_EQ(events[0].time_ns, 2'000'000);
  EXPECT_EQ(events[1].alarm.scan, 4u);
  EXPECT_EQ(events[2].kind, ScanEvent::Kind::kCleared);
  EXPECT_EQ(events[2].alarm.scan, 2u);
  EXPECT_EQ(taps.tap->scans(), 5u);
}

TEST(HistoryTap, AFullQueueIsToldLaterAndWhatIsLostIsCounted) {
  Taps taps;
  taps.now->system_count = 1;
  // Fills the queue with changes of state.
  for (unsigned i = 0; i < ScanTap::kQueue; ++i) {
    taps.now->system[0].nc.state = i % 2 == 0 ? NC_STATE_RUNNING : NC_STATE_IDLE;
    taps.scan({});
  }
  taps.scan({1000});        // comes and goes unseen
  taps.scan({});
  taps.scan({2000, 3000});  // these stay
  taps.scan({2000, 3000});
  EXPECT_EQ(taps.tap->lost(), 1u);
  EXPECT_EQ(taps.take().size(), ScanTap::kQueue);
  taps.scan({2000, 3000});
  const std::vector<ScanEvent> events = taps.take();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].alarm.scan, 2000u);
  EXPECT_EQ(events[1].alarm.scan, 3000u);
  EXPECT_EQ(taps.tap->lost(), 1u);
}

TEST(HistoryTap, AnEndThatFindsNoRoomIsToldLater) {
  Taps taps;
  taps.scan({7});
  (void)taps.take();
  for (unsigned i = 0; i < ScanTap::kQueue; ++i) {
    taps.now->system[0].nc.state = i % 2 == 0 ? NC_STATE_RUNNING : NC_STATE_IDLE;
    taps.scan({7});
  }
  taps.scan({});
  (void)taps.take();
  taps.scan({});
  const std::vector<ScanEvent> events = taps.take();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, ScanEvent::Kind::kCleared);
  EXPECT_EQ(taps.tap->lost(), 0u);
}

TEST(HistoryTap, CountsOnlySpindlesThatAreMeasured) {
  Taps taps;
  taps.now->system[0].nc.state = NC_STATE_RUNNING;
  taps.now->system[0].spindle[0].rev_per_s = -20;
  taps.now->system[0].spindle[1].rev_per_s = 20;
  taps.now->system[0].spindle[1].unmeasured = true;
  for (unsigned i = 0; i < 10; ++i) taps.scan({});
  EXPECT_EQ(taps.tap->turning(0, 0), 10u);
  EXPECT_EQ(taps.tap->turning(0, 1), 0u);
  EXPECT_EQ(taps.tap->turning(0, 2), 0u);
  EXPECT_EQ(taps.tap->running(0), 10u);
}

}  // namespace
}  // namespace nc::rt::history
