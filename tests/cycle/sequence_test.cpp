// SPDX-License-Identifier: Apache-2.0
// Random programs of fixed cycles, block by block: which data stay in force, from where levels count, what a block without a position does, L0, G98 and G99, G90 and
// G91, changes of the cycle, of the work offset and of the place between the holes, patterns of holes, and what ends the mode (M700 13.1.1 to 13.1.3, 13.2). Beside each
// block the test writes down what the manual makes of it, without the control's tables and state.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "support/pull.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

constexpr double kOut = 0.5, kBreak = 0.25;                      // #8013, #8012
constexpr int kToolNumber = 7;                                   // its offset is the radius of the tool
constexpr double kOfTool = 1.25;
constexpr double kOffset[2][2] = {{0, 0}, {100.5, -20.25}};      // of G54 and G55, X and Y

std::string word(char letter, double value) {
  const std::string text = brief(value);
  return std::string(" ") + letter + text + (text.find('.') == std::string::npos ? "." : "");
}

class Writer {
 public:
  explicit Writer(uint64_t seed) : random_(seed) {
    text = "G90 G54 G0 X0 Y0 Z20.\nS500\nM3\nF" + brief(feed_);
    at_ = {0, 0, 20};
    list.push_back("rapid 0 0 20"), list.push_back("S500"), list.push_back("M3");
  }
  std::string text;
  Path list;

  void write(unsigned blocks) {
    for (unsigned n = 0; n < blocks; ++n) block();
    line("G80");
    line("M30");
    list.push_back("M30");
  }

 private:
  using Level = std::pair<double, bool>;  ///< as written, in G91

  unsigned pick(unsigned n) { return static_cast<unsigned>(random_() % n); }
  bool chance(double p) { return std::uniform_real_distribution<double>(0, 1)(random_) < p; }
  double number(double low, double high) { return std::round(std::uniform_real_distribution<double>(low, high)(random_) * 1000) / 1000; }
  void line(const std::string& block) { text += "\n" + block; }

  void block() {
    if (code_ == 0) return chance(0.7) ? begin_cycle() : move();
    switch (pick(14)) {
      case 0: return line(g91_ ? "G90" : "G91"), change_distance();
      case 1: return line((to_r_ = !to_r_) ? "G99" : "G98");
      case 2: return line("P" + std::to_string(pick(900)) + word('Q', number(1, 5)));  // without a position: ignored
      case 3: return line("G04 X0.1"), list.push_back("dwell 0.1");
      case 4: return change_system();
      case 5: return end_cycle();
      case 6: return move();
      case 7: return pattern();
      case 8: return change_cycle();
      default: return hole_block("");
    }
  }
  void change_distance() {
    g91_ = !g91_;
  }
  void change_system() {
    system_ = 1 - system_;
    line(system_ == 0 ? "G54" : "G55");
  }
  void end_cycle() {
    line("G80");
    code_ = 0;
  }
  void move() {
    const double x = number(-50, 50), y = number(-50, 50), z = number(5, 25);
    line("G90 G0" + word('X', x) + word('Y', y) + word('Z', z));
    if (g91_) change_distance();
    code_ = 0;
    go("rapid", {x + kOffset[system_][0], y + kOffset[system_][1], z});
  }
  static std::string name(int code) { return "G" + std::to_string(code); }
  int any_cycle() {
    static constexpr int kCodes[] = {73, 74, 75, 76, 81, 82, 83, 84, 85, 86, 88, 89};
    return kCodes[pick(12)];
  }
  void begin_cycle() {
    initial_ = at_[2];
    q_ = p_ = shift_[0] = shift_[1] = 0;
    levels_needed_ = true;
    change_cycle();
  }
  void change_cycle() {
    code_ = any_cycle();
    hole_block(name(code_));
  }

  /// X, Y, Z, R, P, Q, L of a block that makes holes, as many of them as it likes.
  void hole_block(std::string block) {
    const bool pecks = code_ == 73 || code_ == 83;
    bool drills = false;
    double by[2] = {0, 0};
    bool given[2] = {};
    for (unsigned i = 0; i < 2; ++i) {
      if (!(given[i] = chance(0.6))) continue;
      by[i] = number(-20, 20);
      block += word("XY"[i], by[i]);
      drills = true;
    }
    if (levels_needed_ || chance(0.2)) {
      z_ = {g91_ ? -number(3, 12) : -number(1, 9), g91_};
      r_ = {g91_ ? number(-4, 4) : number(0.5, 4), g91_};  // the sign of R is that of Z, also of one that is a coordinate
      block += word('Z', z_.first) + word('R', r_.first);
      levels_needed_ = false;
    } else if (chance(0.1)) {  // R alone, with a Z of the other mode, too
      r_ = {g91_ ? number(-4, 4) : number(0.5, 4), g91_};
      block += word('R', r_.first);
    } else if (!drills || chance(0.1)) {  // Z alone
      if (z_.second != g91_ || chance(0.5)) z_ = {g91_ ? -number(3, 12) : -number(1, 9), g91_};
      block += word('Z', z_.first);
    }
    if (pecks && (q_ == 0 || chance(0.3))) q_ = number(1, 6), block += word('Q', q_);
    if (code_ == 75 && (std::fabs(q_) < 2 * kOfTool || chance(0.3))) q_ = (chance(0.5) ? 1 : -1) * number(3, 6), block += word('Q', q_);
    if (code_ == 76 && (shift_[0] == 0 || chance(0.3))) block += word('I', shift_[0] = number(0.1, 1));
    if (code_ == 76 && chance(0.3)) block += word('J', shift_[1] = number(-1, 1));
    if (code_ == 75 ? p_ != kToolNumber : chance(0.3)) {  // what is the number of an offset for G75 is a dwell for the others
      p_ = code_ == 75 ? kToolNumber : 10 * pick(50);
      block += " P" + brief(p_);
    }
    unsigned count = 1;
    if (chance(0.2)) block += " L" + std::to_string(count = pick(4));
    line(block);
    const double from[2] = {at_[0], at_[1]};
    for (unsigned n = 0; n < count; ++n) {
      std::array<double, 3> over = at_;
      for (unsigned i = 0; i < 2; ++i)
        if (given[i]) over[i] = g91_ ? from[i] + (n + 1) * by[i] : by[i] + kOffset[system_][i];
      go("rapid", over);
      hole();
    }
  }
  /// G35, in a mode that knows its levels.
  void pattern() {
    if (levels_needed_) return;
    const double x = number(-20, 20), y = number(-20, 20), interval = number(1, 9);
    const int angle = 90 * static_cast<int>(pick(4));
    const unsigned count = 1 + pick(4);
    line("G35" + word('X', x) + word('Y', y) + word('I', interval) + " J" + std::to_string(angle) + ". K" + std::to_string(count));
    const double first[2] = {g91_ ? at_[0] + x : x + kOffset[system_][0], g91_ ? at_[1] + y : y + kOffset[system_][1]};
    const double c[4] = {1, 0, -1, 0}, s[4] = {0, 1, 0, -1};
    for (unsigned n = 0; n < count; ++n) {
      go("rapid", {first[0] + n * interval * c[angle / 90], first[1] + n * interval * s[angle / 90], at_[2]});
      hole();
    }
  }

  // ---- what the manual's figures make of one hole

  void go(const char* kind, const std::array<double, 3>& to) {
    bool moves = false;
    for (unsigned i = 0; i < 3; ++i) moves = moves || std::fabs(to[i] - at_[i]) > 1e-9;
    at_ = to;
    if (moves) list.push_back(std::string(kind) + " " + brief(to[0]) + " " + brief(to[1]) + " " + brief(to[2]));
  }
  void z(const char* kind, double to) { go(kind, {at_[0], at_[1], to}); }
  void dwell() {
    if (p_ > 0) list.push_back("dwell " + brief(p_ / 1000));
  }
  void m(int code) { list.push_back("M" + std::to_string(code)); }
  void hole() {
    const double r = r_.second ? initial_ - std::fabs(r_.first) : r_.first, bottom = z_.second ? r + z_.first : z_.first;
    const double back = to_r_ ? r : initial_;
    z("rapid", r);
    if (code_ == 73 || code_ == 83) {
      const double q = std::fabs(q_);
      for (double depth = r - q;; depth -= q) {
        const double to = depth - bottom > 1e-9 ? depth : bottom;
        z("line", to);
        if (code_ == 73) dwell();
        if (to == bottom) break;
        if (code_ == 83) z("rapid", r), z("rapid", std::fmin(r, to + kOut));
        else z("rapid", to + kBreak);
      }
      return z("rapid", back);
    }
    z("line", bottom);
    if (code_ == 75) return circle(back);
    if (code_ == 76) return bore(back);
    if (code_ != 81 && code_ != 85) dwell();
    if (code_ == 84) m(4);
    if (code_ == 74) m(3);
    if (code_ == 86 || code_ == 88) m(5);
    if (code_ == 74 || code_ == 84 || code_ == 85 || code_ == 89) z("line", r);
    if (code_ == 84) dwell(), m(3);
    if (code_ == 74) dwell(), m(4);
    z("rapid", back);
    if (code_ == 86 || code_ == 88) m(3);
  }

  /// (l): half a circle to X-(q-r), the whole one, half a circle back; it cuts no dwell.
  void circle(double back) {
    const std::array<double, 3> over = at_, edge{over[0] - (std::fabs(q_) - kOfTool), over[1], over[2]};
    go("line", edge);
    list.push_back(list.back());
    go("line", over);
    z("rapid", back);
  }
  /// (m)
  void bore(double back) {
    const std::array<double, 3> over = at_;
    m(19), go("line", {over[0] + shift_[0], over[1] + shift_[1], over[2]});
    z("rapid", back), go("rapid", {over[0], over[1], back}), m(3);
  }

  std::mt19937_64 random_;
  const double feed_ = 150;
  std::array<double, 3> at_{};
  int code_ = 0;
  bool g91_ = false, to_r_ = false, levels_needed_ = true;
  unsigned system_ = 0;
  Level z_{}, r_{};
  double q_ = 0, p_ = 0, shift_[2] = {}, initial_ = 0;
};

Path events(const Outcome& run) {
  Path all;
  for (const Step& step : run.steps) {
    const nc_item& item = step.item;
    if (item.kind == NC_ITEM_MOVE) {
      const double* v = item.u.move.machine.v;
      all.push_back(std::string(item.u.move.kind == NC_MOVE_RAPID ? "rapid " : "line ") + brief(v[0]) + " " + brief(v[1]) + " " + brief(v[2]));
      if (item.u.move.kind != NC_MOVE_RAPID && item.u.move.feed_mm_min != 150) all.back() += " with another feed";
    }
    if (item.kind == NC_ITEM_GATE && item.u.gate.kind == NC_GATE_DWELL_SECONDS) all.push_back("dwell " + brief(item.u.gate.value));
    if (item.kind == NC_ITEM_ACTION && item.u.action.kind <= NC_ACTION_B) all.push_back(item.u.action.letter + brief(item.u.action.value));
  }
  return all;
}

TEST(Sequence, RandomProgramsAreMadeAsTheManualSays) {
  Bench bench;
  bench.param("8013", brief(kOut).c_str()).param("8012", brief(kBreak).c_str());
  bench.tool(kToolNumber, kOfTool);
  bench.work_offset(1, {kOffset[0][0], kOffset[0][1], 0}).work_offset(2, {kOffset[1][0], kOffset[1][1], 0});
  const uint64_t first = wish("NC_FIRST_SEED", 1), count = seeds(400, 60);
  for (uint64_t seed = first; seed < first + count; ++seed) {
    Writer writer(seed);
    writer.write(25);
    bench.at(0, 0, 0);
    const Outcome run = bench.run(writer.text);
    ASSERT_EQ(run.alarm, "") << "seed " << seed << ", line " << run.alarm_line << "\n" << writer.text;
    const Path made = events(run);
    size_t same = 0;
    while (same < made.size() && same < writer.list.size() && made[same] == writer.list[same]) ++same;
    ASSERT_EQ(made.size(), writer.list.size()) << "seed " << seed << ", the first difference is " << same << ": " << (same < made.size() ? made[same] : "-") << " and not "
                                               << (same < writer.list.size() ? writer.list[same] : "-") << "\n" << writer.text;
    ASSERT_EQ(same, made.size()) << "seed " << seed << ": " << made[same] << " and not " << writer.list[same] << "\n" << writer.text;
  }
}

}  // namespace
}  // namespace nc::test
