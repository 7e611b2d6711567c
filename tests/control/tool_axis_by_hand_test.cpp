// SPDX-License-Identifier: Apache-2.0
// Length along the axis of the tool (M700 12.3) with rotary axes, in random programs that are stopped between blocks: there axes are moved by hand, in steps, by the handle
// or by a jog, and blocks of MDI come in. Where each block ends is compared with a second writing of the section: the places of the axes, and the vector at the places
// that the rotary axes really have. No axis gets a larger step than it can do in a cycle.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>

#include "support/seeds.hpp"
#include "support/watched_machine.hpp"

namespace nc::test {
namespace {

constexpr unsigned kAxes = 5;  // X Y Z A C
constexpr double kLength[] = {0, 50, 20};
using Places = std::array<double, kAxes>;

/// What the axes do, by the section.
struct Model {
  Places at{};       ///< programmed
  double vector[3] = {0, 0, 0};
  unsigned length = 0;  ///< number of G43.1; 0: none
  /// A block, or a hand, has brought the axes here.
  void turn() {
    const double a = at[3] * std::acos(-1.0) / 180, c = at[4] * std::acos(-1.0) / 180, l = kLength[length];
    vector[0] = l * std::sin(a) * std::sin(c);
    vector[1] = -l * std::sin(a) * std::cos(c);
    vector[2] = l * std::cos(a);
  }
  double machine(unsigned i) const { return i < 3 ? at[i] + vector[i] : at[i]; }
};

class Session {
 public:
  /// The optimal mode stops on the rounding of a corner, within the tolerance.
  Session(uint64_t seed, bool optimal) : random_(seed), beside_(optimal ? 0.0101 : 1e-6), machine_(NC_DIALECT_M700, "XYZac", {200, 200, 200, 360, 360}, optimal, 40) {
    machine_.bench.tool(1, kLength[1]).tool(2, kLength[2]);
  }

  void run() {
    // The program is written before it is run: what a hand does in between is not known to it.
    text_ = "G90 G94 G1 F9000\n";
    effects_.push_back({});
    for (unsigned blocks = 4 + pick(6); blocks > 0; --blocks) text_ += add_block(&effects_) + "\n";
    text_ += "M30";
    SCOPED_TRACE(text_);
    machine_.start(text_);
    for (size_t block = 0; block < effects_.size(); ++block) {
      until_stop();
      follow(effects_[block]);
      expect_there("line " + std::to_string(block + 1));
      if (testing::Test::HasFailure()) return;
      if (machine_.drive->out.state != NC_STATE_STOPPED) break;
      if (pick(3) == 0) move_by_hand();
      if (pick(4) == 0) interrupt();
      if (testing::Test::HasFailure()) return;
      machine_.press();
    }
    EXPECT_EQ(machine_.drive->alarm(), "") << log_;
    EXPECT_LT(machine_.worst, 1.001) << "axis " << machine_.worst_axis << " line " << machine_.worst_line << log_;
  }

 private:
  /// What a block does to the model.
  struct Effect {
    bool named[kAxes] = {};
    double to[kAxes] = {};
    bool increments = false;
    int length = -1;  ///< G43.1 H, 0: G49
  };

  unsigned pick(unsigned n) { return std::uniform_int_distribution<unsigned>(0, n - 1)(random_); }
  double number(double low, double high) { return std::round(std::uniform_real_distribution<double>(low, high)(random_) * 1e3) / 1e3; }

  double side() { return pick(2) == 0 ? -1 : 1; }

  std::string add_block(std::vector<Effect>* effects) {
    Effect effect;
    std::string block = pick(4) == 0 ? "G0" : "G1";
    if (pick(3) == 0) {
      effect.length = static_cast<int>(pick(3));
      block += effect.length == 0 ? " G49" : " G43.1 H" + std::to_string(effect.length);
    }
    effect.increments = pick(3) == 0;
    block += effect.increments ? " G91" : " G90";
    bool any = false;
    for (unsigned i = 0; i < kAxes; ++i) {
      if (pick(2) == 0 && (any || i < kAxes - 1)) continue;
      any = effect.named[i] = true;
      effect.to[i] = number(-30, 30);
      char word[30];
      std::snprintf(word, sizeof word, " %c%.3f", "XYZAC"[i], effect.to[i]);
      block += word;
    }
    effects->push_back(effect);
    return block;
  }
  void follow(const Effect& effect) {
    bool any = false;
    for (unsigned i = 0; i < kAxes; ++i) {
      if (!effect.named[i]) continue;
      any = true;
      model_.at[i] = effect.increments ? model_.at[i] + effect.to[i] : effect.to[i];
    }
    if (effect.length >= 0) model_.length = static_cast<unsigned>(effect.length);
    if (any || effect.length >= 0) model_.turn();
  }
  void until_stop() {
    machine_.step(12);
    for (unsigned n = 0; n < 60000 && (machine_.drive->out.state == NC_STATE_RUNNING || machine_.drive->out.state == NC_STATE_HOLD); ++n) machine_.step();
    machine_.step(3);
  }
  void expect_there(const std::string& where) {
    EXPECT_EQ(machine_.drive->alarm(), "") << where << log_;
    for (unsigned i = 0; i < kAxes; ++i) EXPECT_NEAR(machine_.drive->out.command.v[i], model_.machine(i), beside_) << where << ", axis " << "XYZAC"[i] << log_;
  }
  /// One or two axes, each in one of the ways; the vector stays what it is until the next movement.
  void move_by_hand() {
    for (unsigned count = 1 + pick(2); count > 0; --count) {
      const unsigned axis = pick(kAxes), kind = pick(3);
      const double before = machine_.drive->out.command.v[axis];
      auto& manual = machine_.drive->in.manual[axis];
      if (kind == 0) {
        manual = {NC_MANUAL_STEP, 0, side() * number(0.01, 8)};
        machine_.step();
      } else if (kind == 1) {
        manual = {NC_MANUAL_HANDLE, 0, side() * number(0.001, 0.05)};
        machine_.step(20 + pick(100));
      } else {
        manual = {NC_MANUAL_JOG, side() * number(1, 50), 0};
        machine_.step(10 + pick(100));
      }
      manual = {};
      machine_.step(800);
      const double way = machine_.drive->out.command.v[axis] - before;
      log_ += "\nhand " + std::string(1, "XYZAC"[axis]) + " " + std::to_string(way);
      EXPECT_NE(way, 0) << kind;
      model_.at[axis] += way;
    }
    expect_there("by hand");
  }
  void interrupt() {
    std::vector<Effect> effects;
    std::string text;
    for (unsigned blocks = 1 + pick(2); blocks > 0; --blocks) text += add_block(&effects) + "\n";
    ASSERT_EQ(nc_mdi_load(machine_.bench.control(), 0, text.data(), text.size()), NC_OK);
    log_ += "\nMDI " + text;
    for (const Effect& effect : effects) {
      machine_.press();
      until_stop();
      follow(effect);
      expect_there("blocks of MDI");
      if (testing::Test::HasFailure()) return;
    }
    for (unsigned n = 0; n < 3 && machine_.drive->out.cause != NC_CAUSE_MDI_ENDED; ++n) {
      machine_.press();
      until_stop();
    }
    EXPECT_EQ(machine_.drive->out.cause, NC_CAUSE_MDI_ENDED) << log_;
    expect_there("behind the blocks of MDI");
  }

  std::mt19937_64 random_;
  double beside_;
  WatchedMachine machine_;
  Model model_;
  std::string text_, log_;
  std::vector<Effect> effects_;
};

class ToolAxisByHand : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(BothLaws, ToolAxisByHand, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

TEST_P(ToolAxisByHand, EachBlockEndsWhereTheVectorOfItsPlacesIs) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(40, 4);
  for (uint64_t seed = first; seed < first + count && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Session(seed, GetParam()).run();
  }
}

}  // namespace
}  // namespace nc::test
