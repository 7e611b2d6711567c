// SPDX-License-Identifier: Apache-2.0
// Every cycle of M700 13.1.1 in three planes, absolute and incremental, with both return levels and each optional word: what the control makes of
// it against the operation pattern of the manual, written down here once more, stroke by stroke and without the control's tables.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "support/pull.hpp"

namespace nc::test {
namespace {

/// Moves, dwells, M codes of the program's cycle and places where single block may stop, in the order of the stream.
Path events(const Outcome& run) {
  Path all;
  size_t next_move = 0;
  const Path moves = run.path();
  for (const Step& step : run.steps) {
    const nc_item& item = step.item;
    const size_t move = next_move;
    if (item.kind == NC_ITEM_MOVE) ++next_move;
    if (item.source.line != 4) continue;  // the block of the cycle
    if (item.kind == NC_ITEM_MOVE) all.push_back(moves[move]);
    if (item.kind == NC_ITEM_GATE && item.u.gate.kind == NC_GATE_DWELL_SECONDS) all.push_back("dwell " + brief(item.u.gate.value));
    if (item.kind == NC_ITEM_GATE && item.u.gate.kind == NC_GATE_IN_POSITION) all.push_back("width " + brief(item.u.gate.value));
    if (item.kind == NC_ITEM_ACTION && item.u.action.kind <= NC_ACTION_B) all.push_back(item.u.action.letter + brief(item.u.action.value));
    if (item.kind == NC_ITEM_MARK && item.u.mark.stop) all.push_back(item.u.mark.report ? "end" : "stop");
  }
  return all;
}

/// How a tap is made: with a floating holder or with the spindle, the latter with ,S; and in cuts of Q.
enum class TapBy { floating, floating_in_cuts, spindle, spindle_back_faster, spindle_in_cuts };

struct Case {
  int plane;         ///< 17, 18, 19
  bool incremental, to_r, dwell, twice, width_over, width_back;
  TapBy tap = TapBy::floating;
  bool with_spindle() const { return tap != TapBy::floating && tap != TapBy::floating_in_cuts; }
  bool in_cuts() const { return tap == TapBy::floating_in_cuts || tap == TapBy::spindle_in_cuts; }
};

constexpr double kX = 12.5, kY = -7.25;        // the hole, on the first and second axis of the plane
constexpr double kTop = 50, kR = 3, kZ = -20;  // levels
constexpr double kQ = 9, kShift[2] = {0.75, -0.5}, kFeed = 120, kOut = 1.5, kBreak = 0.5;
constexpr double kSpeed = 600, kBackSpeed = 900, kLead = 1.25, kTapBack = 0.75;  // of taps; #8018

/// The manual's figures in the words of its lists.
class Figure {
 public:
  explicit Figure(const Case& c) : c_(c) {
    // G17 X Y Z, G18 Z X Y, G19 Y Z X: first and second axis of the plane, drilling axis.
    const std::array<std::array<unsigned, 3>, 3> axes{{{0, 1, 2}, {2, 0, 1}, {1, 2, 0}}};
    axis_ = axes[static_cast<unsigned>(c.plane - 17)];
    at_[axis_[2]] = kTop;
  }
  void g0_plane(double first, double second) { plane(first, second), move("rapid"); }
  void g1_plane(double first, double second) { plane(first, second), move("line"); }
  void g0(double level) { at_[axis_[2]] = level, move("rapid"); }
  void g1(double level) { at_[axis_[2]] = level, move("line"); }
  void arc(double first, double center, bool ccw) {
    plane(first, at_[axis_[1]]);
    list.push_back(std::string(ccw ? "ccw" : "cw") + place() + " c" + brief(center) + "," + brief(at_[axis_[1]]) + " F" + brief(kFeed));
    before_ = at_;
  }
  void g4() {
    if (c_.dwell) list.push_back("dwell 0.35");
  }
  void m(int code) { list.push_back("M" + std::to_string(code)); }
  void sb() { list.push_back("stop"); }
  void end(bool of_block) { list.push_back(of_block ? "end" : "stop"); }
  void width_over() {
    if (c_.width_over && moved_) list.push_back("width 0.2");
  }
  void width_back() {
    if (c_.width_back && moved_) list.push_back("width 0.3");
  }
  /// With the spindle, at this speed.
  void g1_tap(double level, double speed) {
    if (!c_.with_spindle()) return g1(level);
    at_[axis_[2]] = level;
    moved_ = at_ != before_;
    before_ = at_;
    if (moved_) list.push_back("tap" + place() + " F" + brief(kLead * speed));
  }
  /// No M code goes out while the tap turns the spindle.
  void m_tap(int code) {
    if (!c_.with_spindle()) m(code);
  }
  const Case& words() const { return c_; }
  double first() const { return at_[axis_[0]]; }
  double second() const { return at_[axis_[1]]; }
  double back() const { return c_.to_r ? kR : kTop; }
  Path list;

 private:
  void plane(double first, double second) { at_[axis_[0]] = first, at_[axis_[1]] = second; }
  std::string place() const { return " " + brief(at_[0]) + " " + brief(at_[1]) + " " + brief(at_[2]); }
  void move(const char* kind) {
    moved_ = at_ != before_;
    before_ = at_;
    if (moved_) list.push_back(kind + place() + (*kind == 'l' ? " F" + brief(kFeed) : ""));
  }
  Case c_;
  bool moved_ = false;
  std::array<unsigned, 3> axis_;
  std::array<double, 3> at_{}, before_ = at_;
};

/// (c) and (j): the bottoms that the cuts reach.
std::vector<double> bottoms(double from, double to, double q) {
  std::vector<double> all;
  for (double depth = from - q; depth > to + 1e-9; depth -= q) all.push_back(depth);
  all.push_back(to);
  return all;
}

/// (d) and (k), `in` and `out` being the codes of the spindle; in cuts as docs/decisions.md has it, "Q of a tap".
void tap(Figure& f, int in, int out) {
  const double back = f.words().tap == TapBy::spindle_back_faster ? kBackSpeed : kSpeed;
  if (f.words().in_cuts()) {
    for (const double depth : bottoms(kR, kZ, kQ)) {
      f.g1_tap(depth, kSpeed);
      if (depth == kZ) break;
      f.m_tap(out), f.g1_tap(depth + kTapBack, kSpeed), f.m_tap(in);
    }
  }
  f.g1_tap(kZ, kSpeed), f.g4(), f.m_tap(out), f.g1_tap(kR, back), f.g4(), f.m_tap(in);
}

void hole(Figure& f, int code, double x, double y) {
  f.g0_plane(x, y);                            // (1)
  if (code != 75 && code != 76 && code < 86) f.width_over();
  if (code == 89) f.width_over();
  f.sb();
  if (code == 87) {
    f.m(19);                                          // (2)
    f.g0_plane(x + kShift[0], y + kShift[1]);         // (3)
    f.g0(kZ), f.sb();                                 // (4)
    f.g1_plane(x, y);                                 // (5)
    f.m(3), f.sb();                                   // (6)
    f.g1(kZ + 11);                                    // (7)
    f.m(19);                                          // (8)
    f.g0_plane(x + kShift[0], y + kShift[1]);         // (9)
    f.g0(kTop);                                       // (10)
    f.g0_plane(x, y), f.sb();                         // (11)
    f.m(3);                                           // (12)
    return;
  }
  f.g0(kR), f.sb();  // (2)
  const auto last = [&f] { f.g0(f.back()), f.width_back(); };
  switch (code) {
    case 81: f.g1(kZ), last(); break;
    case 82: f.g1(kZ), f.g4(), last(); break;
    case 83:
      for (const double depth : bottoms(kR, kZ, kQ)) {
        f.g1(depth);
        if (depth == kZ) break;
        f.g0(kR), f.g0(depth + kOut);
      }
      last();
      break;
    case 73:
      for (const double depth : bottoms(kR, kZ, kQ)) {
        f.g1(depth), f.g4();
        if (depth != kZ) f.g0(depth + kBreak);
      }
      last();
      break;
    case 84: tap(f, 3, 4), last(); break;
    case 74: tap(f, 4, 3), last(); break;
    case 85: f.g1(kZ), f.g1(kR), last(); break;
    case 86: f.g1(kZ), f.g4(), f.m(5), f.g0(f.back()), f.m(3); break;
    case 88: f.g1(kZ), f.g4(), f.m(5), f.sb(), f.g0(f.back()), f.m(3); break;
    case 89: f.g1(kZ), f.g4(), f.g1(kR), last(); break;
    case 76:
      f.g1(kZ), f.m(19), f.g1_plane(x + kShift[0], y + kShift[1]), f.g0(f.back()), f.g0_plane(x, y), f.sb(), f.m(3);
      break;
    case 75: {  // q1 = 9, the offset r = 2: a circle of radius 7
      f.g1(kZ);
      f.arc(x - 7, x - 3.5, false), f.arc(x - 7, x, false), f.arc(x, x - 3.5, false), f.sb();
      f.g0(f.back());
      break;
    }
    default: FAIL() << code;
  }
}

std::string number(double value) {
  std::string text = brief(value);
  return text.find('.') == std::string::npos ? text + "." : text;
}

std::string program(int code, const Case& c) {
  const char* const letters[3] = {"XYZ", "ZXY", "YZX"};
  const char* const shifts[3] = {"IJ", "KI", "JK"};
  const std::string letter = letters[c.plane - 17], shift = shifts[c.plane - 17];
  double bottom = kZ, r = kR;
  if (code == 87) r = kZ, bottom = kZ + 11;
  const double z_word = c.incremental ? bottom - r : bottom, r_word = c.incremental ? r - kTop : r;
  std::string text = std::string("G") + std::to_string(c.plane) + (c.incremental ? " G91" : " G90") + (c.to_r ? " G99 G" : " G98 G") + std::to_string(code);
  text += std::string(" ") + letter[0] + number(kX) + " " + letter[1] + number(kY) + " " + letter[2] + number(z_word) + " R" + number(r_word);
  if (code == 83 || code == 73 || code == 75) text += " Q" + number(kQ);
  if (code == 76 || code == 87) text += std::string(" ") + shift[0] + number(kShift[0]) + " " + shift[1] + number(kShift[1]);
  if (code == 75) text += " P7";
  if (code != 75 && c.dwell) text += " P350";
  const bool taps = code == 84 || code == 74, with_spindle = taps && c.with_spindle();
  if (taps) text += with_spindle ? " ,R1 S" + brief(kSpeed) : " ,R0";
  if (taps && c.in_cuts()) text += " Q" + number(kQ);
  if (taps && c.tap == TapBy::spindle_back_faster) text += " ,S" + brief(kBackSpeed);
  if (c.width_over) text += " ,I0.2";
  if (c.width_back) text += " ,J0.3";
  text += " F" + number(with_spindle ? kLead : kFeed) + (c.twice ? " L2" : "");
  return text;
}

Path expected(int code, const Case& c) {
  Figure f(c);
  const double again = c.incremental ? 2 : 1;
  hole(f, code, kX, kY);
  if (c.twice) {
    f.end(false);
    hole(f, code, again * kX, again * kY);
  }
  f.end(true);
  return f.list;
}

/// Compares a cycle with every combination of its words.
unsigned compare(Bench& bench, int code, TapBy by) {
  unsigned compared = 0;
  for (unsigned bits = 0; bits < 3 * 64; ++bits) {
    const Case c{17 + static_cast<int>(bits / 64), (bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0, (bits & 16) != 0, (bits & 32) != 0, by};
    const char* const start[3] = {"Z50.", "Y50.", "X50."};
    bench.at(0, 0, 0);
    const std::string text = program(code, c);
    const Outcome run = bench.run(std::string("G0 ") + start[c.plane - 17] + "\nS500\nM3\n" + text + "\nG80\nM30");
    EXPECT_EQ(run.alarm, "") << text;
    EXPECT_EQ(events(run), expected(code, c)) << text;
    if (testing::Test::HasFailure()) return compared;
    ++compared;
  }
  return compared;
}

TEST(Strokes, AreThoseOfTheManualsFigures) {
  Bench bench;
  bench.param("8013", "1.5").param("8012", "0.5").tool(7, 2);
  for (const int code : {73, 74, 75, 76, 81, 82, 83, 84, 85, 86, 87, 88, 89}) EXPECT_EQ(compare(bench, code, TapBy::floating), 192U) << "G" << code;
}

TEST(Strokes, OfTapsInCutsAndWithTheSpindle) {
  Bench bench;
  bench.param("8018", "0.75").param("1272", "0");
  for (const int code : {84, 74})
    for (const TapBy by : {TapBy::floating_in_cuts, TapBy::spindle, TapBy::spindle_back_faster, TapBy::spindle_in_cuts}) EXPECT_EQ(compare(bench, code, by), 192U) << "G" << code;
}

}  // namespace
}  // namespace nc::test
