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

struct Case {
  int plane;         ///< 17, 18, 19
  bool incremental, to_r, dwell, twice, widths;
};

constexpr double kX = 12.5, kY = -7.25;        // the hole, on the first and second axis of the plane
constexpr double kTop = 50, kR = 3, kZ = -20;  // levels
constexpr double kQ = 9, kShift[2] = {0.75, -0.5}, kFeed = 120, kOut = 1.5, kBreak = 0.5;

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
  void width(double mm) {
    if (c_.widths && moved_) list.push_back("width " + brief(mm));
  }
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

void hole(Figure& f, int code, double x, double y) {
  f.g0_plane(x, y);                            // (1)
  if (code != 75 && code != 76 && code < 86) f.width(0.2);
  if (code == 89) f.width(0.2);
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
  const auto last = [&f] { f.g0(f.back()), f.width(0.3); };
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
    case 84: f.g1(kZ), f.g4(), f.m(4), f.g1(kR), f.g4(), f.m(3), last(); break;
    case 74: f.g1(kZ), f.g4(), f.m(3), f.g1(kR), f.g4(), f.m(4), last(); break;
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
  if (code == 84 || code == 74) text += " ,R0";
  if (c.widths) text += " ,I0.2 ,J0.3";
  text += " F" + number(kFeed) + (c.twice ? " L2" : "");
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

TEST(Strokes, AreThoseOfTheManualsFigures) {
  Bench bench;
  bench.param("8013", "1.5").param("8012", "0.5").tool(7, 2);
  unsigned compared = 0;
  for (const int code : {73, 74, 75, 76, 81, 82, 83, 84, 85, 86, 87, 88, 89}) {
    for (unsigned bits = 0; bits < 3 * 32; ++bits) {
      const Case c{17 + static_cast<int>(bits / 32), (bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0, (bits & 16) != 0};
      const char* const start[3] = {"Z50.", "Y50.", "X50."};
      bench.at(0, 0, 0);
      const std::string text = program(code, c);
      const Outcome run = bench.run(std::string("G0 ") + start[c.plane - 17] + "\nS500\nM3\n" + text + "\nG80\nM30");
      ASSERT_EQ(run.alarm, "") << text;
      ASSERT_EQ(events(run), expected(code, c)) << text;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 13U * 96U);
}

}  // namespace
}  // namespace nc::test
