// SPDX-License-Identifier: Apache-2.0
// The time of day is set by an hour while the machine works: the history keeps its order and says so, and nothing that is measured, and no limit of time, feels it.
//
// This test program replaces clock_gettime() and adds to CLOCK_REALTIME what a test wants; that is zero for all other tests.
#include <gtest/gtest.h>

#include "runtime/sanitizer.hpp"

#if defined(NC_UNDER_SANITIZER)

TEST(ClockStep, NeedsTheOrdinaryClock) { GTEST_SKIP() << "a sanitizer has replaced the clock"; }

#else

#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "services/local_machine.hpp"

namespace {
std::atomic<long> g_step_s{0};
}

extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const auto result = static_cast<int>(syscall(SYS_clock_gettime, clock, time));
  if (result == 0 && clock == CLOCK_REALTIME) time->tv_sec += g_step_s.load(std::memory_order_relaxed);
  return result;
}

namespace nc::rt::services {
namespace {

using test::LocalMachine;
using test::ServiceClient;

constexpr std::int64_t kSecond = 1'000'000'000;

class ClockStep : public LocalMachine {
 protected:
  void TearDown() override {
    LocalMachine::TearDown();
    g_step_s = 0;
  }
  // Sets the time of day, and waits until the history has seen it.
  void set(ServiceClient* client, long seconds) {
    const Json before = client->call("history.list", {{"kind", "system"}, {"count", 1}})["reply"]["entries"][0]["number"];
    g_step_s += seconds;
    until(client, "history.list", [&](const Json& now) { return now["entries"][0]["number"] > before && now["entries"][0]["code"] == "clock"; }, {{"kind", "system"}, {"count", 1}});
  }
  static double counter(ServiceClient* client, const std::string& name) {
    const Json counters = client->call("history.counters")["reply"]["counters"];
    for (const Json& each : counters)
      if (each["name"] == name) return each["value"];
    return -1;
  }
};

TEST_F(ClockStep, TheHistoryKeepsItsOrderAndWhatItMeasures) {
  write_program("part.nc", "G1 X5. F1000.\nG4 X1.\nM0\nM30\n");
  ServiceClient client(path_);
  until(&client, "status", [](const Json& now) { return now["scan"] > 0; });
  ASSERT_EQ(client.outcome("control.take", {{"lease_ms", 60000}}), "");
  ASSERT_EQ(client.outcome("select", {{"name", "part.nc"}}), "");
  ASSERT_EQ(client.outcome("start"), "");
  const auto begin = std::chrono::steady_clock::now();
  set(&client, 3600);
  until(&client, "status", [](const Json& now) { return now["systems"][0]["state"] == "stopped"; });
  set(&client, -7200);
  ASSERT_EQ(client.outcome("start"), "");
  const Json run = until(&client, "history.list", [](const Json& now) { return !now["entries"].empty() && now["entries"][0]["outcome"] == "completed"; }, {{"kind", "run"}, {"count", 1}})["entries"][0];
  const double most = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() + 1;
  EXPECT_GT(run["seconds"], 1.0);
  EXPECT_LT(run["seconds"], most) << "the time in execution is not that of the clock on the wall";
  EXPECT_LT(run["end_ns"].get<std::int64_t>(), run["time_ns"].get<std::int64_t>()) << "as the clock has shown it";
  EXPECT_LT(counter(&client, "on"), most + 60);
  EXPECT_LT(counter(&client, "running"), most);
  EXPECT_GE(counter(&client, "running"), 1.0);
  const Json times = client.call("history.programs")["reply"]["programs"][0];
  EXPECT_EQ(times["last_s"], run["seconds"]);

  const Json steps = client.call("history.list", {{"kind", "system"}})["reply"]["entries"];
  ASSERT_EQ(steps[0]["text"], "the time of day was set back by 7200 s");
  ASSERT_EQ(steps[1]["text"], "the time of day was set forward by 3600 s");
  EXPECT_LT(steps[0]["time_ns"].get<std::int64_t>(), steps[1]["time_ns"].get<std::int64_t>() - 7000 * kSecond);
  const Json all = client.call("history.list")["reply"]["entries"];
  for (std::size_t i = 1; i < all.size(); ++i) EXPECT_LT(all[i]["number"], all[i - 1]["number"]) << "their order is that in which they came";
  // An alarm that comes and goes behind the step has both times on the same clock.
  ASSERT_EQ(client.outcome("mode", {{"mode", "mdi"}}), "");
  ASSERT_EQ(client.outcome("mdi", {{"blocks", "G2 X1. R0.01"}}), "");
  (void)client.outcome("start");
  until(&client, "history.list", [](const Json& now) { return !now["entries"].empty(); }, {{"kind", "alarm"}});
  ASSERT_EQ(client.outcome("reset"), "");
  const Json alarm = until(&client, "history.list", [](const Json& now) { return now["entries"][0]["end_ns"] > 0; }, {{"kind", "alarm"}})["entries"][0];
  EXPECT_GE(alarm["end_ns"].get<std::int64_t>(), alarm["time_ns"].get<std::int64_t>());
  EXPECT_LT(alarm["time_ns"].get<std::int64_t>(), steps[1]["time_ns"].get<std::int64_t>());
}

// A lease, the lifespan of a command and the update of a watch list are times that pass, and not times of day.
TEST_F(ClockStep, LimitsOfTimeStay) {
  ServiceClient one(path_), two(path_);
  until(&one, "status", [](const Json& now) { return now["scan"] > 0; });
  ASSERT_EQ(one.outcome("control.take", {{"lease_ms", 60000}}), "");
  for (const long step : {3600L, -7200L}) {
    set(&two, step);
    EXPECT_EQ(two.outcome("control.take"), "no control") << "the lease has not ended";
    EXPECT_EQ(one.outcome("mode", {{"mode", "manual"}, {"lifespan_ms", 5000}}), "") << "the command is as young as before";
    EXPECT_EQ(one.outcome("mode", {{"mode", "auto"}, {"lifespan_ms", 5000}}), "");
  }
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(one.outcome("control.take", {{"lease_ms", 200}}), "");
  g_step_s -= 3600;
  while (two.outcome("control.take") == "no control") usleep(1000);
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(200)) << "it ends when its time has passed, and it does end";
  // A recording has the times of the scan.
  ASSERT_EQ(one.outcome("trace.arm", {{"signals", {"in0"}}, {"samples", 400}}), "");
  g_step_s += 3600;
  until(&one, "trace.status", [](const Json& now) { return now["state"] == "complete"; });
  const Json rows = one.call("trace.read", {{"recording", 1}})["reply"]["rows"];
  ASSERT_EQ(rows.size(), 400u);
  for (std::size_t i = 1; i < rows.size(); ++i) ASSERT_LT(rows[i]["time_s"].get<double>() - rows[i - 1]["time_s"].get<double>(), 60.0);
}

}  // namespace
}  // namespace nc::rt::services

#endif
