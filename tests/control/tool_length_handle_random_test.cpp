// SPDX-License-Identifier: Apache-2.0
// The handle changes the length along the axis of the tool (M700 12.3) at any cycle of random programs, which run, are held, stop between blocks, are interrupted by MDI or by a reference
// return by hand, and are reset. Where each block ends is compared with a second writing of the section: the vector of the amount that the handle had made when the block began. A turn that comes
// while a block runs may act one block later, because the axes have to rest before blocks are read again. No axis gets a larger step than it can do in a cycle.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support/seeds.hpp"
#include "support/watched_machine.hpp"

namespace nc::test {
namespace {

constexpr unsigned kAxes = 5;  // X Y Z A C
constexpr double kLength[] = {0, 50, 20};
constexpr unsigned kLate = 2;  // a turn acts behind the block that follows the one in which it came, at the latest

class HandleSession {
 public:
  HandleSession(uint64_t seed, bool optimal) : random_(seed), beside_(optimal ? 0.0201 : 1e-6), machine_(NC_DIALECT_M700, "XYZac", {200, 200, 200, 360, 360}, optimal, 40) {
    machine_.bench.tool(1, kLength[1]).tool(2, kLength[2]);
  }

  void run() {
    std::string text = "G90 G94 G1 F9000\n";
    program_.push_back({});
    for (unsigned blocks = 6 + pick(8); blocks > 0; --blocks) text += add_block(&program_) + "\n";
    text += "M30";
    SCOPED_TRACE(text);
    machine_.start(text);
    in().single_block = false;
    for (unsigned cycle = 0; cycle < 30000 && !testing::Test::HasFailure() && out().state != NC_STATE_IDLE; ++cycle) {
      act();
      step();
    }
    EXPECT_EQ(machine_.drive->alarm(), "") << log_;
    EXPECT_LT(machine_.worst, 1.001) << "axis " << machine_.worst_axis << " line " << machine_.worst_line << log_;
  }

 private:
  struct Effect {
    bool named[kAxes] = {};
    double to[kAxes] = {};
    bool increments = false;
    int number = -1;  ///< of the length along the tool, 0: G49
  };

  nc_inputs& in() { return machine_.drive->in; }
  const nc_outputs& out() const { return machine_.drive->out; }
  unsigned pick(unsigned n) { return std::uniform_int_distribution<unsigned>(0, n - 1)(random_); }
  double number(double low, double high) { return std::round(std::uniform_real_distribution<double>(low, high)(random_) * 1e3) / 1e3; }

  std::string add_block(std::vector<Effect>* effects) {
    Effect effect;
    std::string block = pick(5) == 0 ? "G0" : "G1";
    if (pick(3) == 0) {
      effect.number = static_cast<int>(pick(5) % 3);
      block += effect.number == 0 ? " G49" : " G43.1 H" + std::to_string(effect.number);
    }
    effect.increments = pick(4) == 0;
    block += effect.increments ? " G91" : " G90";
    bool any = false;
    for (unsigned i = 0; i < kAxes; ++i) {
      if (pick(2) == 0 && (any || i < kAxes - 1)) continue;
      any = effect.named[i] = true;
      effect.to[i] = number(-20, 20);
      char word[30];
      std::snprintf(word, sizeof word, " %c%.3f", "XYZAC"[i], effect.to[i]);
      block += word;
    }
    effects->push_back(effect);
    return block;
  }

  /// What an operator does in one cycle.
  void act() {
    in().cycle_start = in().reset = false;
    in().tool_length_handle = 0;
    if (pick(12) == 0) in().tool_length_handle = 0.1 * (static_cast<double>(pick(7)) - 3);
    if (pick(300) == 0) in().single_block = !in().single_block;
    if (in().feed_hold ? pick(40) == 0 : pick(400) == 0) in().feed_hold = !in().feed_hold;
    const bool stands = out().state == NC_STATE_STOPPED || out().state == NC_STATE_HOLD;
    if (stands && pick(60) == 0) in().cycle_start = true;
    if (out().state == NC_STATE_STOPPED && pick(120) == 0) enter_mdi();
    if (out().state == NC_STATE_STOPPED && pick(200) == 0) return_by_hand(pick(kAxes));
    if (pick(4000) == 0) reset();
  }
  /// An axis goes to its reference position by hand. Each of them has to do with the length along the tool, which ends: the axes stay where the vector has led them.
  void return_by_hand(unsigned axis) {
    if (starting_ || in().cycle_start || in().feed_hold || !out().manual_allowed) return;
    log_ += "\nreturn of axis " + std::to_string(axis);
    in().tool_length_handle = 0;
    const double left = out().command.v[axis];
    in().manual[axis] = {NC_MANUAL_REFERENCE, 0, 0};
    for (unsigned n = 0; n < 5000 && (n < 2 || out().state != NC_STATE_STOPPED); ++n) step();
    in().manual[axis] = {};
    EXPECT_EQ(out().command.v[axis], 0) << log_;
    at_[axis] -= left;
    if (number_ == 0) return;
    for (unsigned i = 0; i < kAxes; ++i) at_[i] += beside_of_[i];
    change_number(0);
    ended_by_hand_ = true;
  }
  void enter_mdi() {
    std::vector<Effect> effects;
    const std::string text = add_block(&effects);
    if (nc_mdi_load(machine_.bench.control(), 0, text.data(), text.size()) != NC_OK) return;
    log_ += "\nMDI " + text;
    mdi_ = effects[0];
  }
  /// The axes stay where they stand, without a vector.
  void reset() {
    log_ += "\nreset";
    in().tool_length_handle = 0;
    in().reset = true;
    step();
    in().reset = in().feed_hold = false;
    for (unsigned n = 0; n < 2000 && out().state != NC_STATE_IDLE; ++n) step();
    EXPECT_EQ(out().tool_length_added, 0);
    for (unsigned i = 0; i < kAxes; ++i) at_[i] = out().command.v[i];
    beside_of_ = {};
    change_number(0);
    moved_ = false;
    machine_.step(5);
    in().cycle_start = true;
    step();
    in().cycle_start = false;
    for (unsigned n = 0; n < 20 && out().state == NC_STATE_IDLE; ++n) step();
  }

  void step() {
    const uint8_t before = out().state;
    const double way = in().tool_length_handle;
    const bool stood = before == NC_STATE_STOPPED && !starting_ && !in().cycle_start;  // a start may lead to the stop behind MDI within its cycle
    machine_.step();
    for (size_t i = machine_.drive->fresh; i < machine_.drive->events.size(); ++i) follow(machine_.drive->events[i]);
    const bool counted = way != 0 && !out().tool_length_dropped;
    if (counted && !ended_by_hand_) {
      sums_.push_back(sums_.back() + way);
      log_ += "\nturned " + std::to_string(way) + " line " + std::to_string(out().source.line);
    }
    starting_ = in().cycle_start || (starting_ && out().state == NC_STATE_STOPPED);
    if (out().state == NC_STATE_RUNNING) ended_by_hand_ = false;
    if (stood && out().state == NC_STATE_STOPPED && way != 0 && !ended_by_hand_) {  // a turn behind the return counts until the start, and is dropped there
      EXPECT_EQ(counted, number_ != 0) << log_;
    }
    if (out().state == NC_STATE_STOPPED && !starting_) least_ = sums_.size() - 1;
  }
  void follow(const nc_event& event) {
    const bool mdi = event.source.depth != 0;
    if (!mdi && event.source.line - 1 >= program_.size()) return;
    const Effect& effect = mdi ? mdi_ : program_[event.source.line - 1];
    if (event.kind == NC_ITEM_MOVE) block_ends(effect, event);
    if (event.kind != NC_ITEM_MARK) return;
    if (!moved_ && !mdi) ends_where_it_stands(effect);  // behind the last block of MDI there is a mark more
    moved_ = false;
    change_number(moved_number_);
    least_ = std::max(least_, turns_[0]);
    for (unsigned i = 0; i + 1 < kLate; ++i) turns_[i] = turns_[i + 1];
    turns_[kLate - 1] = sums_.size() - 1;
  }
  /// A block whose end with its vector is where a reset has left the axes has no move. Its words and its number count all the same.
  void ends_where_it_stands(const Effect& effect) {
    const std::array<double, kAxes> before = at_;
    for (unsigned i = 0; i < kAxes && !effect.increments; ++i)
      if (effect.named[i]) at_[i] = effect.to[i];
    for (unsigned i = 0; i < kAxes; ++i) beside_of_[i] += before[i] - at_[i];
    if (effect.number >= 0) moved_number_ = static_cast<unsigned>(effect.number);
  }
  void block_ends(const Effect& effect, const nc_event& event) {
    moved_ = true;
    for (unsigned i = 0; i < kAxes; ++i)
      if (effect.named[i]) at_[i] = effect.increments ? at_[i] + effect.to[i] : effect.to[i];
    const unsigned number = moved_number_ = effect.number >= 0 ? static_cast<unsigned>(effect.number) : number_;
    double nearest = number != number_ ? beside(number, 0, event) : INFINITY;  // of a new number nothing has been turned yet
    for (size_t i = least_; number == number_ && i < sums_.size(); ++i) nearest = std::min(nearest, beside(number, sums_[i], event));
    for (unsigned i = 0; i < kAxes; ++i) beside_of_[i] = event.machine.v[i] - at_[i];
    const bool fits = nearest < beside_;
    EXPECT_TRUE(fits) << "line " << event.source.line << " depth " << int(event.source.depth) << " number " << number << " off " << nearest << " sums " << sums_.size() << " least "
                      << least_ << log_;
  }
  double beside(unsigned number, double added, const nc_event& event) const {
    const double a = at_[3] * std::acos(-1.0) / 180, c = at_[4] * std::acos(-1.0) / 180, l = number == 0 ? 0 : kLength[number] + added;
    const double vector[kAxes] = {l * std::sin(a) * std::sin(c), -l * std::sin(a) * std::cos(c), l * std::cos(a), 0, 0};
    double off = 0;
    for (unsigned i = 0; i < kAxes; ++i) off = std::max(off, std::fabs(event.machine.v[i] - at_[i] - vector[i]));
    return off;
  }
  /// The turns for the number before are cancelled.
  void change_number(unsigned to) {
    moved_number_ = to;
    if (to == number_) return;
    number_ = to;
    sums_ = {0};
    least_ = 0;
    turns_ = {};
  }

  std::mt19937_64 random_;
  double beside_;
  WatchedMachine machine_;
  std::vector<Effect> program_;
  Effect mdi_;
  std::array<double, kAxes> at_{};  ///< programmed
  unsigned number_ = 0;             ///< of the length along the tool behind the newest block that has ended
  unsigned moved_number_ = 0;       ///< the same behind the newest move
  bool moved_ = false;              ///< the block in execution has had its move
  std::vector<double> sums_{0};     ///< what the handle had made of its amount, after each turn
  size_t least_ = 0;                ///< the next block has this one of them, or a later one
  std::array<size_t, kLate> turns_{};  ///< number of turns at the ends of the last blocks
  std::array<double, kAxes> beside_of_{};  ///< the axes stood so far beside the programmed end of the newest block
  bool ended_by_hand_ = false;      ///< a return has ended the length in this block stop
  bool starting_ = false;           ///< start was pressed in a block stop
  std::string log_;
};

class ToolLengthHandleRandom : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(BothLaws, ToolLengthHandleRandom, testing::Bool(), [](const auto& law) { return law.param ? "Optimal" : "Trapezoid"; });

TEST_P(ToolLengthHandleRandom, EachBlockEndsWithTheAmountThatTheHandleHasMade) {
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(60, 6);
  for (uint64_t seed = first; seed < first + count && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    HandleSession(seed, GetParam()).run();
  }
}

}  // namespace
}  // namespace nc::test
