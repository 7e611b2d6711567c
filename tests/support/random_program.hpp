// SPDX-License-Identifier: Apache-2.0
// Random M700 programs that end: moves, arcs, cycles, compensation, offsets, macros, loops, calls, skips, reads of the world.
// The same seed gives the same program.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace nc::test {

struct RandomProgram {
  std::string main;
  std::vector<std::string> subs;   ///< O1, O2, ...
};

class ProgramMaker {
 public:
  /// Without `reads_world` the programs do not depend on inputs, clocks and skip signals. With `corners` they have chamfers and roundings.
  explicit ProgramMaker(uint32_t seed, bool reads_world = true, bool corners = true) : random_(seed), reads_world_(reads_world), corners_(corners) {}

  RandomProgram make() {
    RandomProgram p;
    constexpr int kSubs = 4;
    for (int i = 1; i <= kSubs; ++i) {
      text_ = "O" + std::to_string(i) + "\n";
      last_sub_ = kSubs;
      first_sub_ = i + 1;
      loop_ = 10 * i;
      blocks(number(1, 6), 1);
      text_ += "M99\n";
      p.subs.push_back(text_);
    }
    text_ = "G90 G54 G0 X0 Y0 Z20. F500\nM3 S1000\n";
    first_sub_ = 1;
    loop_ = 0;
    blocks(number(8, 30), 0);
    text_ += "G40 G80 G0 Z50.\nM30\n";
    p.main = text_;
    return p;
  }

 private:
  int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  std::string coordinate(int reach = 100) {
    std::string text = std::to_string(number(-reach * 1000, reach * 1000) / 1000.0);
    return text;
  }
  std::string common() { return "#" + std::to_string(number(100, 109)); }

  void blocks(int count, int depth) {
    for (int i = 0; i < count; ++i) block(depth);
  }

  void block(int depth) {
    const int kind = number(0, corners_ ? 25 : 24);
    const bool reads = kind == 16 || kind == 17 || kind == 23;
    switch (reads && !reads_world_ ? 1 : kind) {
      case 0: text_ += "G0 X" + coordinate() + " Y" + coordinate() + "\n"; break;
      case 1:
      case 2: text_ += "G1 X" + coordinate() + " Z" + coordinate(20) + "\n"; break;
      case 3: text_ += "G91 G1 X" + coordinate(5) + " G90 Y" + coordinate() + "\nG90\n"; break;
      case 4: text_ += "G91 G" + std::to_string(number(2, 3)) + " X10. Y10. R" + (number(0, 1) ? "" : "-") + std::to_string(number(8, 40)) + ".\nG90\n"; break;
      case 5: text_ += "G" + std::to_string(number(2, 3)) + " I" + coordinate(20) + " J3. Z" + coordinate(10) + " P" + std::to_string(number(0, 2)) + "\n"; break;
      case 6: text_ += "G" + std::to_string(number(54, 59)) + "\n"; break;
      case 7: text_ += "G10 L2 P" + std::to_string(number(0, 6)) + " X" + coordinate(10) + " Z" + coordinate(3) + "\n"; break;
      case 8: text_ += "G91 G10 L10 P" + std::to_string(number(1, 9)) + " R0.25\nG90\n"; break;
      case 9: text_ += number(0, 1) ? "G92 X" + coordinate(50) + "\n" : "G52 Y" + coordinate(5) + "\n"; break;
      case 10: text_ += "G43 H" + std::to_string(number(1, 5)) + " G0 Z" + coordinate(30) + "\n"; break;
      case 11: text_ += number(0, 1) ? "G49\n" : "G28 Z60.\n"; break;
      case 12: cycle(); break;
      case 13: contour(); break;
      case 14: text_ += common() + "=" + common() + "+" + coordinate(9) + "\n"; break;
      case 15: text_ += "#" + std::to_string(number(1100, 1131)) + "=" + std::to_string(number(0, 1)) + "\n"; break;
      case 16: text_ += "#" + std::to_string(number(1, 9)) + "=#5041 " + common() + "=#1032\n"; break;
      case 17: text_ += "G31 Z-" + std::to_string(number(5, 50)) + ". F100\n" + common() + "=#5063\n"; break;
      case 18: {
        const std::string label = std::to_string(++label_);
        text_ += "IF[" + common() + " GT " + coordinate() + "] GOTO " + label + "\nG0 X" + coordinate() + "\nN" + label + "\n";
        break;
      }
      case 19: loop(depth); break;
      case 20: call(); break;
      case 21: text_ += "M" + std::to_string(number(10, 40)) + " T" + std::to_string(number(1, 99)) + "\n"; break;
      case 22: text_ += number(0, 1) ? "G4 P" + std::to_string(number(1, 900)) + "\n" : "M1\n"; break;
      case 23: text_ += "#3006=1(NOTE " + std::to_string(number(1, 99)) + ")\n" + common() + "=#3001\n"; break;
      case 24:
        if (corners_) {
          corners();
          break;
        }
        [[fallthrough]];
      default: text_ += "/G" + std::to_string(number(0, 1)) + " X" + coordinate() + "\n(comment)\n#" + std::to_string(2000 + number(1, 9)) + "=" + coordinate(3) + "\n"; break;
    }
  }

  void cycle() {
    static constexpr const char* kCodes[] = {"G81", "G82", "G83", "G73", "G85", "G89"};
    text_ += "G0 Z20.\nG9" + std::to_string(number(8, 9)) + " " + kCodes[number(0, 5)] + " X" + coordinate() + " Z-" + std::to_string(number(1, 12)) +
             ". R3. Q2.5 P100\n";
    for (int i = number(0, 3); i > 0; --i) text_ += "X" + coordinate() + " Y" + coordinate() + (number(0, 3) == 0 ? " L2" : "") + "\n";
    text_ += "G80\n";
  }

  /// A contour with radius compensation that is possible with radii of up to 2 mm.
  void contour() {
    text_ += std::string("G90 G0 X0 Y0\nG1 ") + (number(0, 1) ? "G41" : "G42") + " D" + std::to_string(number(1, 9)) + " X20. Y" + std::to_string(number(-2, 2)) + ".\n";
    text_ += "X60.\n";
    for (int i = number(0, 2); i > 0; --i) text_ += number(0, 1) ? common() + "=" + common() + "+1\n" : "M" + std::to_string(number(50, 60)) + "\n";
    text_ += "Y50.\n";
    if (number(0, 2) == 0) text_ += "G10 L2 P3 X1.\n";
    text_ += "G3 X40. Y70. I-20.\nG1 X10.\n";
    if (number(0, 2) == 0 && reads_world_) text_ += "#100=#1000\n";  // stops the reading ahead in the middle of a contour
    text_ += "Y30.\nX0 Y25.\nG40 X-20. Y-20.\n";
  }

  /// Lines with chamfers and roundings between them (M700 13.7); one time in three with radius compensation.
  void corners() {
    const bool compensated = number(0, 2) == 0;
    if (compensated) text_ += "G0 X0 Y0\nG91 G1 G41 D" + std::to_string(number(1, 9)) + " X20.\n";
    text_ += "G91 G1 F3000 Y3. X15. ,R" + std::to_string(number(1, 4)) + ".\n";
    if (number(0, 1)) text_ += common() + "=" + common() + "+1\n";
    text_ += (number(0, 1) ? "M" + std::to_string(number(50, 60)) + " " : "") + "X-3. Y18. ,C" + std::to_string(number(1, 4)) + ".\n";
    text_ += "/X-24. Z1. ,R" + std::to_string(number(0, 3)) + ".5\nX-15. Y4.\n";
    text_ += compensated ? "G40 X-10. Y-20.\nG90\n" : "G90\n";
  }

  void loop(int depth) {
    if (depth > 2) return;
    const int mine = ++loop_;
    const std::string counter = "#" + std::to_string(600 + mine);
    text_ += counter + "=0\nWHILE[" + counter + " LT " + std::to_string(number(1, 4)) + "] DO" + std::to_string(mine) + "\n" + counter + "=" + counter + "+1\n";
    blocks(number(1, 3), depth + 1);
    text_ += "END" + std::to_string(mine) + "\n";
  }

  void call() {
    if (first_sub_ > last_sub_) return;
    const std::string p = std::to_string(number(first_sub_, last_sub_));
    if (number(0, 1) == 0) {
      text_ += "M98 P" + p + " L" + std::to_string(number(1, 2)) + "\n";
    } else {
      text_ += "G65 P" + p + " A" + coordinate() + " X" + common() + " I1. J2. I3.\n";
    }
  }

  std::mt19937 random_;
  bool reads_world_, corners_;
  std::string text_;
  int first_sub_ = 1, last_sub_ = 4;
  int loop_ = 0;
  int label_ = 1000;
};

}  // namespace nc::test
