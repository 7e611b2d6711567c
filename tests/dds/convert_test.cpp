// SPDX-License-Identifier: Apache-2.0
// How a subscriber sees the enumerations of the control: each value has its own one in the IDL, in the same order, and an unknown value of a later
// control is "other".
#include "dds/convert.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "nc/run.h"
#include "runtime/console.hpp"
#include "runtime/refusal.hpp"

namespace {

namespace share = nc::rt::share;

struct Shown {
  nc_StopCause cause;
  nc_RefusalCause refusal;
  std::uint32_t core;
};

// Part system 1 of a control with this cause and this refusal.
Shown shown(std::uint32_t cause, std::uint32_t refusal) {
  const auto machine = std::make_unique<share::MachineBlock>();
  const auto block = std::make_unique<share::StatusBlock>();
  const auto sample = std::make_unique<nc::dds::StatusSample>();
  machine->system_count = block->system_count = 1;
  block->system[0].stop_cause = cause;
  block->system[0].refusal_cause = refusal;
  sample->fill(*machine, *block, 0, "unit");
  return {sample->status.stop_cause, sample->status.refusal_cause, nc::dds::core_status(*machine, *block, 0, "unit").stop_cause};
}

// The last cause. That convert.cpp has all of them is checked by the compiler (-Wswitch).
constexpr std::uint32_t kLastCause = NC_CAUSE_RESTART;

TEST(DdsConvert, EveryStopCauseHasItsOwn) {
  std::set<int> seen;
  for (std::uint32_t cause = 0; cause <= kLastCause; ++cause) {
    const Shown now = shown(cause, 0);
    EXPECT_NE(now.cause, nc_CAUSE_OTHER) << cause;
    EXPECT_TRUE(seen.insert(now.cause).second) << cause << " is shown as one before it";
    EXPECT_EQ(now.core, static_cast<std::uint32_t>(now.cause));
    EXPECT_EQ(static_cast<std::uint32_t>(now.cause), cause < nc_CAUSE_OTHER ? cause : cause + 1) << "in order";
  }
  EXPECT_EQ(shown(NC_CAUSE_RESET, 0).cause, nc_CAUSE_RESET);
  EXPECT_EQ(shown(NC_CAUSE_SPINDLE_REVERSED, 0).cause, nc_CAUSE_SPINDLE_REVERSED);
  EXPECT_EQ(shown(NC_CAUSE_MDI_ENDED, 0).cause, nc_CAUSE_MDI_ENDED);
  for (const std::uint32_t later : {kLastCause + 1, 255u, ~0u}) {
    EXPECT_EQ(shown(later, 0).cause, nc_CAUSE_OTHER) << later << ": a cause was added, and this test does not know it";
    EXPECT_EQ(shown(later, 0).core, static_cast<std::uint32_t>(nc_CAUSE_OTHER));
  }
}

TEST(DdsConvert, EveryRefusalHasItsOwn) {
  for (std::uint32_t refusal = 0; refusal <= static_cast<std::uint32_t>(nc::rt::RefusalCause::kLast); ++refusal) {
    EXPECT_EQ(static_cast<std::uint32_t>(shown(0, refusal).refusal), refusal);
    share::Ack ack{};
    ack.refusal = refusal;
    EXPECT_EQ(static_cast<std::uint32_t>(nc::dds::ack(ack).refusal), refusal);
  }
  EXPECT_EQ(shown(0, static_cast<std::uint32_t>(nc::rt::RefusalCause::kLast) + 1).refusal, nc_REFUSED_OTHER);
}

// The same for the texts of the causes.
TEST(DdsConvert, EveryStopCauseHasItsWords) {
  std::set<std::string> seen;
  for (std::uint32_t cause = 1; cause <= kLastCause; ++cause) {
    nc_outputs outputs{};
    outputs.state = NC_STATE_RUNNING;
    outputs.cause = static_cast<std::uint8_t>(cause);
    const std::string words = nc::rt::state_text(outputs);
    EXPECT_NE(words, "running") << cause;
    EXPECT_TRUE(seen.insert(words).second) << words;
    EXPECT_LT(words.size(), 64u) << "SystemStatus::state_text";
  }
}

}  // namespace
