// SPDX-License-Identifier: Apache-2.0
// Three handwheels, each with a selector for the three axes and a switch for its factor, that hands turn and switch at any scan, also both at once and two on one axis; with feed hold and changes of
// the mode between them. What a wheel was turned while it had its axis alone is what the axis goes, by the factor of that scan, up to the soft limits, where nothing is stored; behind a hold nothing
// moves before a wheel is turned.
#include <functional>
#include <random>

#include "support/seeds.hpp"
#include "switch_machine.hpp"

namespace {

using nc::rt::Mode;

constexpr unsigned kWheels = 3, kAxes = 3;
constexpr double kLimit[kAxes] = {2.0, 3.0, 1.5};  // mm to either side
constexpr double kDivision = 0.001;
const char* const kAxisNames[kAxes] = {"X", "Y", "Z"};

class RandomHandwheels : public nc::test::SwitchMachine {
 protected:
  static std::string name(unsigned wheel, const std::string& what) { return "w" + std::to_string(wheel) + what; }
  static std::string input(const std::string& point, const char* type, int initial = 0) {
    return "[[point]]\nname = \"" + point + "\"\ntype = \"" + type + "\"\ndirection = \"input\"\ninitial = " + std::to_string(initial) + "\n";
  }
  void begin(std::uint64_t seed) {
    random.seed(seed);
    std::string points = input("hold_n", "bit", 1), wheels;
    for (unsigned w = 0; w < kWheels; ++w) {
      counts[w] = below(2) == 0 ? 1 : 4;
      bits[w] = below(2) == 0 ? 32 : 16;
      points += input(name(w, ""), "word") + input(name(w, "ten"), "bit") + input(name(w, "hundred"), "bit");
      wheels += "[[handwheel]]\ncounter = \"" + name(w, "") + "\"\ncounts = " + std::to_string(counts[w]) + "\nbits = " + std::to_string(bits[w]) + "\ntimes_10 = \"" + name(w, "ten") + "\"\ntimes_100 = \"" +
                name(w, "hundred") + "\"\naxes = { ";
      for (unsigned a = 0; a < kAxes; ++a) {
        points += input(name(w, kAxisNames[a]), "bit");
        wheels += std::string(a == 0 ? "" : ", ") + kAxisNames[a] + " = \"" + name(w, kAxisNames[a]) + "\"";
      }
      wheels += " }\n";
      count[w] = below(2) == 0 ? 0 : bits[w] == 16 ? 65530 : 4294967290u;
      rest[w] = 0;
      chosen[w] = factor[w] = 0;
      before[w] = -1;
    }
    more_signals = "\"plc.feed_hold_n\" = \"hold_n\"\n";
    build(points + wheels);
    limit_axes();
    for (unsigned w = 0; w < kWheels; ++w) turn(name(w, ""), count[w]);
    ASSERT_EQ(mode(Mode::kManual), nc::rt::Answer::kDone);
    steps(3);
    for (unsigned a = 0; a < kAxes; ++a) place[a] = counted(a);
  }
  // The machine of the other tests has limits that no wheel comes to.
  void limit_axes() {
    for (unsigned a = 0; a < kAxes; ++a) {
      config.nc.system[0].axis[a].soft_min = -kLimit[a];
      config.nc.system[0].axis[a].soft_max = kLimit[a];
    }
    runtime.reset();
    hal = std::make_unique<nc::test::WatchedHal>(config.sim, config.points);
    std::vector<nc::rt::ConfigError> errors;
    runtime = nc::rt::Runtime::create(config, {&clock, hal.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr);
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
    steps(2);
  }
  unsigned below(unsigned n) { return static_cast<unsigned>(random() % n); }

  // What hands do before a scan.
  void hands() {
    for (unsigned w = 0; w < kWheels; ++w) {
      if (below(40) == 0) choose(w);
      if (below(30) == 0) set_factor(w, below(4));
      way[w] = below(6) == 0 ? static_cast<int>(below(9)) - 4 : 0;
      if (way[w] == 0) continue;
      count[w] = (count[w] + static_cast<std::uint32_t>(way[w])) & (bits[w] == 16 ? 0xffffu : 0xffffffffu);
      turn(name(w, ""), count[w]);
    }
  }
  void choose(unsigned w) {
    chosen[w] = below(4) == 0 ? below(8) : 1u << below(kAxes);  // none, two or all of them, too
    for (unsigned a = 0; a < kAxes; ++a) turn(name(w, kAxisNames[a]), chosen[w] >> a & 1u);
  }
  void set_factor(unsigned w, unsigned switches) {
    factor[w] = switches;
    turn(name(w, "ten"), switches & 1u);
    turn(name(w, "hundred"), switches >> 1 & 1u);
  }
  static int first_of(std::uint32_t set) {
    for (int a = 0; a < static_cast<int>(kAxes); ++a)
      if ((set >> a & 1u) != 0) return a;
    return -1;
  }
  // What the axes are to go by that; `acts`: hands may move them.
  void expect_way(bool acts) {
    for (unsigned w = 0; w < kWheels; ++w) {
      const int axis = first_of(chosen[w]);
      if (axis != before[w]) rest[w] = 0;  // counts of a division that is not complete
      before[w] = axis;
      if (axis < 0) continue;
      rest[w] += way[w];
      const int divisions = rest[w] / counts[w];
      rest[w] -= divisions * counts[w];
      bool alone = (chosen[w] & (chosen[w] - 1)) == 0;
      for (unsigned other = 0; other < kWheels; ++other) alone &= other == w || first_of(chosen[other]) != axis;
      if (!alone || !acts) continue;
      const int times = (factor[w] & 2) != 0 ? 100 : (factor[w] & 1) != 0 ? 10 : 1;
      const auto a = static_cast<unsigned>(axis);
      place[a] = std::clamp(place[a] + divisions * times * kDivision, -kLimit[a], kLimit[a]);
    }
  }
  void watch() {
    for (unsigned a = 0; a < kAxes; ++a) {
      EXPECT_LE(std::abs(counted(a)), kLimit[a] + 1e-9) << kAxisNames[a];
      EXPECT_LE(std::abs(out().velocity.v[a]), config.nc.system[0].axis[a].max_velocity * (1 + 1e-9));
    }
  }
  void scans(unsigned n) {
    while (n-- > 0) {
      hands();
      expect_way(true);
      steps(1);
      watch();
    }
  }
  void rests() {
    ASSERT_GE(until([&] { return out().distance_zero; }, 3000), 0);
    steps(5);
  }
  void at_place(const char* when) {
    rests();
    for (unsigned a = 0; a < kAxes; ++a) {
      ASSERT_NEAR(counted(a), place[a], 1e-9) << when << " " << kAxisNames[a];
      place[a] = counted(a);
    }
  }
  // Hands go on while something keeps the axes; then it goes, and hands are still.
  void amid(const std::function<void(bool)>& keeps, unsigned brake) {
    keeps(true);
    for (unsigned n = 0; n < brake; ++n) {
      hands();
      expect_way(false);
      steps(1);
      watch();
    }
    for (unsigned a = 0; a < kAxes; ++a) {
      EXPECT_EQ(out().velocity.v[a], 0) << kAxisNames[a];
      place[a] = counted(a);
    }
    keeps(false);
    steps(200);
    for (unsigned a = 0; a < kAxes; ++a) EXPECT_EQ(counted(a), place[a]) << "of itself " << kAxisNames[a];
  }

  std::mt19937_64 random;
  int counts[kWheels] = {}, rest[kWheels] = {}, before[kWheels] = {}, way[kWheels] = {};
  unsigned bits[kWheels] = {}, factor[kWheels] = {};
  std::uint32_t count[kWheels] = {}, chosen[kWheels] = {};
  double place[kAxes] = {};
};

TEST_F(RandomHandwheels, AxesGoWhatTheirWheelIsTurned) {
  const auto first = static_cast<std::uint64_t>(nc::test::wish("NC_FIRST_SEED", 1));
  for (std::uint64_t seed = first; seed < first + nc::test::seeds(12, 4); ++seed) {
    SCOPED_TRACE(seed);
    ASSERT_NO_FATAL_FAILURE(begin(seed));
    for (unsigned round = 0; round < 12; ++round) {
      SCOPED_TRACE(round);
      scans(50 + below(400));
      switch (below(3)) {
        case 0: amid([&](bool on) { turn("hold_n", on ? 0 : 1); }, 400); break;
        case 1:
          ASSERT_NO_FATAL_FAILURE(at_place("in front of another mode"));  // it is refused while axes move
          amid([&](bool on) { ASSERT_EQ(mode(on ? Mode::kMdi : Mode::kManual), nc::rt::Answer::kDone); }, 400);
          break;
        default: ASSERT_NO_FATAL_FAILURE(at_place("hands are still")); break;
      }
      if (HasFailure()) return;
    }
    EXPECT_EQ(alarm(), "");
  }
}

}  // namespace
