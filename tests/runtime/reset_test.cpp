// SPDX-License-Identifier: Apache-2.0
// Start and reset with a feeder that is late: the reset comes to its end, and the next program runs.
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include "hal/sim/sim_machine.hpp"
#include "runtime/runtime.hpp"
#include "test_config.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;

// libnc with a feeder that runs only when the test allows it.
class LateNc final : public nc::rt::NcPort {
 public:
  explicit LateNc(const nc::rt::Config& config) {
    const std::size_t size = (nc_memory_required(&config.nc) + 63) / 64 * 64;
    memory_.reset(std::aligned_alloc(64, size));
    nc_status status = NC_OK;
    control = nc_create(&config.nc, memory_.get(), size, &status);
    real_ = std::make_unique<nc::rt::LibNc>(control, config.nc);
  }
  void cycle(const nc_inputs* in, nc_outputs* out) noexcept override { real_->cycle(in, out); }
  nc_status feed(std::uint32_t budget) override { return late ? NC_WAITING : real_->feed(budget); }
  nc_status poll_event(unsigned s, nc_event* event, std::uint64_t* dropped) override { return real_->poll_event(s, event, dropped); }
  nc_status select(unsigned s, unsigned file) override { return real_->select(s, file); }
  nc_status load_mdi(unsigned s, const char* text, std::size_t length) override { return real_->load_mdi(s, text, length); }
  nc_status reset(unsigned s) override { return real_->reset(s); }
  void switches(unsigned s, std::uint32_t skip) override { real_->switches(s, skip); }
  nc_status alarm(unsigned s, nc_alarm* alarm) override { return real_->alarm(s, alarm); }
  nc_status modal(unsigned s, std::uint32_t id, nc_modal* modal) override { return real_->modal(s, id, modal); }
  nc_status text(unsigned s, std::uint32_t id, nc_text* text) override { return real_->text(s, id, text); }

  nc_control* control = nullptr;
  bool late = false;

 private:
  struct Free {
    void operator()(void* memory) const { std::free(memory); }
  };
  std::unique_ptr<void, Free> memory_;
  std::unique_ptr<nc::rt::LibNc> real_;
};

TEST(Reset, EndsWhateverTheFeederHasSeenOfTheStart) {
  const nc::rt::Config config = nc::test::parse_or_fail(nc::test::base_toml());
  nc::rt::VirtualClock clock;
  nc::hal::SimMachine machine(config.sim, config.points);
  LateNc nc(config);
  ASSERT_NE(nc.control, nullptr);
  static constexpr char kText[] = "G90 G0 X1.\nG1 X2. F6000\nM30\n";
  unsigned file = 0;
  ASSERT_EQ(nc_program_add_text(nc.control, "a.nc", kText, sizeof kText - 1, &file), NC_OK);
  std::vector<nc::rt::ConfigError> errors;
  const auto runtime = nc::rt::Runtime::create(config, {&clock, &machine, nullptr, &nc}, &errors);
  ASSERT_NE(runtime, nullptr);
  std::string error;
  ASSERT_TRUE(runtime->start_stepping(&error)) << error;
  for (unsigned scans = 0; scans < 20; ++scans) {
    SCOPED_TRACE(scans);
    ASSERT_EQ(runtime->select_program(file), Answer::kDone);
    nc.late = true;
    ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
    for (unsigned n = 0; n < scans; ++n) runtime->step();
    ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
    for (unsigned n = 0; n < scans % 5; ++n) runtime->step();
    nc.late = scans % 2 == 0;  // the reset does not need nc_feed()
    for (unsigned n = 0; n < 10; ++n) runtime->step();
    ASSERT_FALSE(runtime->snapshot().resetting);
    nc.late = false;
    ASSERT_EQ(runtime->select_program(file), Answer::kDone);
    ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
    for (unsigned n = 0; n < 2000 && (n < 5 || runtime->snapshot().program_active()); ++n) runtime->step();
    ASSERT_FALSE(runtime->snapshot().program_active());
    ASSERT_NEAR(runtime->snapshot().system[0].nc.command.v[0], 2, 1e-9);
    for (unsigned n = 0; n < 3; ++n) runtime->step();
  }
}

// Who waits for a reset knows by the count that it is done, whatever alarm is there behind it.
TEST(Reset, IsCountedWhenItIsDone) {
  const nc::rt::Config config = nc::test::parse_or_fail(nc::test::base_toml() + "[signals]\n\"plc.alarm.1\" = \"in0\"\n");
  nc::rt::VirtualClock clock;
  nc::hal::SimMachine machine(config.sim, config.points);
  std::vector<nc::rt::ConfigError> errors;
  const auto runtime = nc::rt::Runtime::create(config, {&clock, &machine, nullptr, nullptr}, &errors);
  ASSERT_NE(runtime, nullptr);
  std::string error;
  ASSERT_TRUE(runtime->start_stepping(&error)) << error;
  machine.set_input(static_cast<unsigned>(config.points.find("in0")), 1);
  for (unsigned n = 0; n < 5; ++n) runtime->step();
  ASSERT_TRUE(runtime->snapshot().stopped_by_alarm());
  EXPECT_EQ(runtime->snapshot().resets, 0u);
  for (unsigned count = 1; count <= 2; ++count) {
    ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
    for (unsigned n = 0; n < 100 && runtime->snapshot().resets != count; ++n) {
      EXPECT_TRUE(runtime->snapshot().resetting || n == 0);
      runtime->step();
    }
    EXPECT_EQ(runtime->snapshot().resets, count);
    EXPECT_TRUE(runtime->snapshot().stopped_by_alarm()) << "its cause is still there, and is seen no later than the end of the reset";
  }
}

}  // namespace
