// SPDX-License-Identifier: Apache-2.0
// A ladder whose completions come late, twice, of the wrong group, too early, for too long or not at all, with resets and holds at any moment. Every code is given out once and in
// its order, a group is done only by a completion of its own that has risen behind its strobe, and no axis moves while one waits.
#include <array>
#include <cmath>
#include <random>

#include "ladder_machine.hpp"
#include "support/seeds.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;

class RandomFin : public nc::test::OwnLadder {
 protected:
  static constexpr unsigned kFins = 5;  // FIN1, FIN2, MFIN, SFIN, TFIN
  static constexpr const char* kPoints[kFins] = {"fin_a", "fin_b", "fin_m", "fin_s", "fin_t"};
  static constexpr const char* kProgram = "G90 G1 X1. F12000\nT3 M6\nX2.\nS500 M3\nX3.\nM8 M9\nX4.\nT2 S100\nX5.\nM30\n";
  // What a run gives out: the groups of which none goes on before the others (M 1, S 2, T 4), the M code and the T code. A completion that is on already holds its own group back.
  struct Given {
    unsigned groups;
    std::uint32_t m, t;
  };
  static constexpr Given kGiven[] = {{5, 6, 3}, {3, 3, 0}, {1, 8, 0}, {1, 9, 0}, {6, 0, 2}, {1, 30, 0}};

  void begin() {
    runtime.reset();
    use("LD fin_a\nOUT plc.fin1\nLD fin_b\nOUT plc.fin2\nLD fin_m\nOUT plc.mfin\nLD fin_s\nOUT plc.sfin\nLD fin_t\nOUT plc.tfin\nEND\n");
    const std::string path = config.ladder.program;
    std::string points;
    for (const char* name : kPoints) points += std::string("[[point]]\nname = \"") + name + "\"\ndirection = \"input\"\n";
    config = nc::test::parse_or_fail(nc::test::base_toml() + points + "[ladder]\nprogram = \"own.il\"\n");
    config.ladder.program = path;
    config.ladder.fin_timeout_s = 0;
    build();
    fin_ = {};
    left_ = {};
    since_on_ = {};
    before_ = 0;
    next_ = 0;
    open_ = 0;
    runs_ = 0;
    start(kProgram);
  }
  unsigned below(unsigned n) { return static_cast<unsigned>(random() % n); }
  void set(unsigned fin, bool on, unsigned scans) {
    fin_[fin] = on;
    left_[fin] = scans;
    in(kPoints[fin], on ? 1 : 0);
  }
  // The machine builder's ladder, with everything that can be wrong with it.
  void work() {
    for (unsigned n = 0; n < kFins; ++n)
      if (fin_[n] && left_[n] > 0 && --left_[n] == 0) set(n, false, 0);
    const unsigned strobe = out().strobe;
    if (below(60) == 0) set(below(kFins), true, 1 + below(below(4) == 0 ? 80 : 5));
    if (strobe == 0 || below(25) != 0) return;
    switch (below(4)) {
      case 0: set(below(2), true, 1 + below(12)); break;
      case 1:
        for (unsigned g = 0; g < 3; ++g)
          if ((strobe >> g & 1u) != 0) set(2 + g, true, 1 + below(12));
        break;
      default: set(2 + below(3), true, 1 + below(12)); break;
    }
  }
  static bool covers(unsigned fin, unsigned group) { return fin < 2 || fin - 2 == group; }

  void look() {
    const nc_outputs now = out();
    for (unsigned n = 0; n < kFins; ++n) since_on_[n] = fin_[n] ? since_on_[n] + 1 : 0;
    const unsigned strobe = now.strobe, risen = strobe & ~before_, fallen = before_ & ~strobe;
    for (unsigned g = 0; g < 3; ++g) {
      if ((risen >> g & 1u) != 0) rose_at_[g] = scan_;
      for (unsigned n = 0; n < kFins; ++n)
        ASSERT_FALSE((risen >> g & 1u) != 0 && covers(n, g) && since_on_[n] > 3) << "the strobe of group " << g << " rises while " << kPoints[n] << " is on";
      if ((fallen >> g & 1u) == 0 || given_up_) continue;
      bool done = false;
      for (unsigned n = 0; n < kFins; ++n) done |= covers(n, g) && last_rise_[n] >= rose_at_[g];
      ASSERT_TRUE(done) << "group " << g << " is done without a completion";
    }
    if (risen != 0) {
      if (next_ == 0 || open_ == 0) open_ = next_ < std::size(kGiven) ? kGiven[next_++].groups : 0;
      ASSERT_EQ(risen & ~open_, 0u) << "code " << next_ << " of the program is given out in front of its turn, or twice";
      open_ &= ~risen;
      EXPECT_EQ((risen & 1u) != 0 ? now.m : kGiven[next_ - 1].m, kGiven[next_ - 1].m);
      EXPECT_EQ((risen & 4u) != 0 ? now.t : kGiven[next_ - 1].t, kGiven[next_ - 1].t);
      ++codes_;
    }
    ASSERT_TRUE((strobe & before_) == 0 || std::abs(now.velocity.v[0]) < 1e-6) << "an axis moves while a code waits: " << now.velocity.v[0] << " at " << now.command.v[0] << " strobe " << strobe << " line " << now.source.line;
    // Between two codes the axis goes to the place that stands between them.
    ASSERT_NEAR(strobe != 0 && next_ > 0 ? now.command.v[0] - kPlace[next_ - 1] : 0, 0, 1e-9) << next_;
    before_ = strobe;
  }
  void scan() {
    const std::array<bool, kFins> was = fin_;
    work();
    ++scan_;
    for (unsigned n = 0; n < kFins; ++n)
      if (fin_[n] && !was[n]) last_rise_[n] = scan_;
    runtime->step();
    look();
  }
  static constexpr double kPlace[] = {1, 2, 3, 3, 4, 5};

  void give_up() {
    given_up_ = true;
    ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
    ASSERT_GE(until([&] { return !runtime->snapshot().resetting; }, 3000), 0);
    steps(static_cast<int>(below(30)));
    ASSERT_EQ(out().strobe, 0);
    before_ = 0;
    next_ = 0;
    open_ = 0;
    given_up_ = false;
    ASSERT_EQ(alarm(), "");
    ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
    watch_from_here();
  }
  // A command takes scans: strobes that have risen in them are seen now.
  void watch_from_here() {
    for (unsigned n = 0; n < kFins; ++n) since_on_[n] = 0;
    look();
  }

  std::mt19937_64 random;
  std::array<bool, kFins> fin_{};
  std::array<unsigned, kFins> left_{};
  std::array<unsigned, kFins> since_on_{};
  std::array<std::uint64_t, kFins> last_rise_{};
  std::array<std::uint64_t, 3> rose_at_{};
  std::uint64_t scan_ = 0, codes_ = 0, ended_ = 0, runs_ = 0;
  unsigned before_ = 0, open_ = 0;  // open_: groups of the newest code that are still to come
  std::size_t next_ = 0;
  bool given_up_ = false;
};

TEST_F(RandomFin, EachCodeIsGivenOutOnceAndDoneByItsOwnCompletion) {
  const std::uint64_t first = nc::test::wish("NC_FIRST_SEED", 1), seeds = nc::test::seeds(10, 2);
  for (std::uint64_t seed = first; seed < first + seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    random.seed(seed);
    ASSERT_NO_FATAL_FAILURE(begin());
    ASSERT_NO_FATAL_FAILURE(watch_from_here());
    for (unsigned n = 0; n < 15000; ++n) {
      SCOPED_TRACE(n);
      ASSERT_NO_FATAL_FAILURE(scan());
      ASSERT_EQ(alarm(), "");
      if (below(2500) == 0) give_up();
      ASSERT_FALSE(HasFatalFailure());
      if (runtime->info().system[0].runs == runs_ || out().state != NC_STATE_IDLE) continue;
      EXPECT_EQ(next_, std::size(kGiven)) << "codes of the program that was ended";
      runs_ = runtime->info().system[0].runs;
      ++ended_;
      next_ = 0;
      open_ = 0;
      ASSERT_EQ(runtime->execute(CommandKind::kCycleStart), Answer::kDone);
      ASSERT_NO_FATAL_FAILURE(watch_from_here());
    }
  }
  std::printf("%llu codes, %llu programs ended\n", static_cast<unsigned long long>(codes_), static_cast<unsigned long long>(ended_));
  EXPECT_GT(codes_, 50 * seeds);
  EXPECT_GT(ended_, 2 * seeds);
}

}  // namespace
