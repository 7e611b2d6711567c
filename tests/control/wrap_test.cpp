// SPDX-License-Identifier: Apache-2.0
// A control after years of running (docs/counters.md): the ids of transforms, modal states, texts and shapes, and the counts of marks, records
// and cells overflow and begin again, which must have no effect.
#include <gtest/gtest.h>

#include "control/control.hpp"
#include "online_helpers.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

constexpr uint32_t kBefore[] = {1, 2, 7, 40, 150};  ///< the counters begin so far before the end of 31 and of 32 bits

std::vector<uint32_t> begins() {
  std::vector<uint32_t> all;
  for (const uint32_t before : kBefore)
    for (const uint32_t end : {0u, 0x80000000u}) all.push_back(end - before);
  return all;
}

/// The text of a random program with areas of G22, shapes and messages added.
std::string text_of(const RandomProgram& program) {
  return "G22 X5000. I4000. Y5000. J4000.\n#3006=1(LOOK)\nG12.1\nG1 X3. C20. F500\nG13.1\nG2.3 X10. I30. J30. R20. F100 Q100\nPOPEN\nDPRNT[X#5041[44]]\nPCLOS\n" + program.main;
}

std::vector<std::string> offline(uint32_t seed, uint32_t first) {
  Bench bench(NC_DIALECT_M700, machine(64));
  bench.control()->system[0].count_from(first);
  const RandomProgram program = ProgramMaker(seed + 7000).make();
  set_up(bench, program);
  std::vector<std::string> all;
  for (unsigned run = 0; run < 2; ++run) {
    const Outcome outcome = bench.run(run == 0 ? text_of(program) : program.main);
    for (const Step& step : outcome.steps) all.push_back(exactly(step));
    all.push_back(outcome.alarm);
  }
  return all;
}

TEST(WrapOffline, TheSameStreamBehindTheEndOfEveryCounter) {
  for (uint32_t seed = 0; seed < 12; ++seed) {
    const std::vector<std::string> fresh = offline(seed, 0);
    for (const uint32_t first : begins()) {
      SCOPED_TRACE("seed " + std::to_string(seed) + " from " + std::to_string(first));
      ASSERT_EQ(offline(seed, first), fresh);
    }
  }
}

struct Online {
  std::vector<double> positions;
  std::vector<uint64_t> serials;
  std::string left, texts;
};

Online online(nc_motion_mode mode, uint32_t seed, uint32_t first) {
  Bench bench(NC_DIALECT_M700, [mode](nc_config& c) {
    machine(64)(c);
    c.motion_mode = static_cast<uint8_t>(mode);
    for (unsigned i = 0; i < 3; ++i) c.system[0].axis[i].max_jerk = 1e7;
  });
  bench.control()->system[0].count_from(first);
  const RandomProgram program = ProgramMaker(seed + 7100, false).make();
  set_up(bench, program);
  Drive drive(bench, "#3006=1(LOOK)\n" + program.main);
  Online said;
  std::mt19937 random(seed);
  for (unsigned n = 0; n < 100000 && !drive.ended; ++n) {
    drive.in.cycle_start = n == 2 || (n > 2 && n % 7 == 0);
    drive.in.single_block = (n / 200) % 3 == 2;
    drive.in.feed_hold = random() % 50 == 0;
    drive.step(n % 3 == 0 ? 0 : 20);
    for (unsigned i = 0; i < 3; ++i) said.positions.push_back(drive.out.command.v[i]);
    nc_text text;
    if (drive.out.message && nc_text_get(bench.control(), 0, drive.out.message_text, &text) == NC_OK) said.texts += text.s;
    nc_modal modal;
    if (drive.out.blocks > 0) {
      EXPECT_EQ(nc_modal_get(bench.control(), 0, drive.out.modal, &modal), NC_OK) << n;
    }
  }
  for (const nc_event& event : drive.events) said.serials.push_back(event.serial);
  said.left = left_by(bench);
  return said;
}

class WrapOnline : public ::testing::TestWithParam<nc_motion_mode> {};

TEST_P(WrapOnline, TheSamePositionsBehindTheEndOfEveryCounter) {
  for (uint32_t seed = 0; seed < seeds(2, 1); ++seed) {
    const Online fresh = online(GetParam(), seed, 0);
    ASSERT_NE(fresh.texts, "");
    for (const uint32_t first : begins()) {
      SCOPED_TRACE("seed " + std::to_string(seed) + " from " + std::to_string(first));
      const Online late = online(GetParam(), seed, first);
      ASSERT_EQ(late.serials, fresh.serials);
      ASSERT_EQ(late.positions, fresh.positions);
      ASSERT_EQ(late.texts, fresh.texts);
      ASSERT_EQ(late.left, fresh.left);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Both, WrapOnline, ::testing::Values(NC_MOTION_TRAPEZOID, NC_MOTION_OPTIMAL),
                         [](const auto& mode) { return mode.param == NC_MOTION_OPTIMAL ? "Optimal" : "Trapezoid"; });

}  // namespace
}  // namespace nc::test
