// SPDX-License-Identifier: Apache-2.0
// Random programs with every function that the m700 and dgshape families have. A program is a series of short passages from a table. Most
// passages are correct by themselves, so that programs come far; now and then a word or a letter is spoilt.
// In a passage {x} stands for a number, by the table of `value()`.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include "nc/nc.h"
#include "operator/dice.hpp"

namespace nc::test {

/// Passages of the m700 family. Most passages switch off again what they have switched on; what they leave on acts in the next ones.
inline constexpr const char* kPassages[] = {
    "G0 X{x} Y{x}\n",
    "G1 X{x} Y{x} F{f}\n",
    "G1 X{x} Y{x} Z{x} F{f}\nX{x}\nY{x}\nZ{x}\n",
    "G1 X{x} F{f}\nX{x}\nX{x}\n",
    "G91 G1 X{d} Y{d} F{f}\nX{d} Y{d}\nX{t} Y{t}\nX{t}\nG90\n",
    "G91 G1 F{f}\nX{t} Y{t}\nX{t} Y{t}\nX{t} Y{t}\nX{t} Y{t}\nX{t} Y{t}\nX{t} Y{t}\nX{t} Y{t}\nG90\n",
    "G91 G{g} X{d} Y{d} R20. F{f}\nG90\n",
    "G91 G{g} X{d} Y{d} R-9. F{f}\nG90\n",
    "G{g} I{r} J{r} F{f}\n",
    "G91 G{g} I{r} Z{d} P{n} F{f}\nG90\n",
    "G91 G{g} X{t} Y{t} I0 J{t} F{f}\nG90\n",
    "G18 G91 G{g} X{d} Z{d} R12. F{f}\nG90 G17\n",
    "G19 G{g} J{r} K{r} F{f}\nG17\n",
    "G91 G{g}.1 X{d} Y{d} I{r} J{r} P{n} F{f}\nG90\n",
    "G91 G{g}.3 X{r} Z{r} I{a} J{a} R{r} F{f}\nG90\n",
    "G91 G{g}.4 X{d} Y{d} Z{d} X{d} Y{d} Z{d} F{f}\nG90\n",
    "G2.4 X{x} Y{x} Z{x}\nX{x} Y{x} Z{x} F{f}\n",
    "G6.2 P4 X{x} Y{x} R1. K0 F{f}\nK0 X{x} Y{x}\nK0 X{x} Y{x}\nK0 X{x} Y{x}\nK1\nK1\nK1\nK1\nG1\n",
    "G5.1 Q2\nG1 X{x} Y{x} F{f}\nX{x} Y{x}\nX{x} Y{x}\nX{x} Y{x}\nG5.1 Q0\n",
    "G5 P2\nG91 G1 X{t} Y{t} F{f}\nX{t} Y{t}\nX{t}\nX{d}\nG90\nG5 P0\n",
    "G5.1 Q1\nG1 X{x} Y{x} F{f}\nX{x} Y{x}\nG5.1 Q0\n",
    "G61.1\nG1 X{x} Y{x} F{f}\nY{x}\nG64\n",
    "G61\nG1 X{x} F{f}\nY{x}\nG64\n",
    "G62\nG91 G1 X{d} F{f}\nY{d}\nG90 G64\n",
    "G63\nG1 Z{x} F{f}\nG64\n",
    "G9 G1 X{x} F{f}\nY{x}\n",
    "G60 X{x} Y{x}\n",
    "G4 P{p}\n",
    "G4 X0.0{n}\n",
    "G93 G1 X{x} F{a}.\nX{x} F{a}.\nG94 F{f}\n",
    "S{s} M3\nG95 G1 X{x} F0.{n}\nY{x}\nG94 F{f}\n",
    "S{s} M3\nG33 Z{x} F{n}.\nG0 X{x}\n",
    "S{s} M3\nG96 P1\nG1 X{x} F{f}\nG97\n",
    "G1 X{x} F{n}\nF{f}\n",
    "G43 H{h}\nG0 Z{x}\nG1 X{x} F{f}\nG49\n",
    "G44 Z{x} H{h}\nG49 Z{x}\n",
    "G41 D{h} G1 X{x} Y{x} F{f}\nX{x} Y{x}\nG91 G{g} X{d} Y{d} R20.\nG1 X{d} Y{d}\nG90\nG40 X{x} Y{x}\n",
    "G42 D{h} G1 X{x} Y{x} F{f}\nG91 X{d}\nY{d}\nX{t} Y{t}\nX{d} Y{d}\nG90\nG40 X{x} Y{x}\n",
    "G{c} D{h} G1 X{x} Y{x} F{f}\nG91\nG{g} X{t} Y{t} I{t} J{t}\nG1 X{d}\nG90 G40 X{x}\n",
    "G{c} D{h} G1 X{x} Y{x} F{f}\nM{m}\n{v}={v}+1.\nG1 Y{x}\n#100=#5041\nX{x}\nG40 Y{x} Z{x}\n",
    "G{c} D{h} G1 X{x} F{f}\nG{g} I{r}\nG40 X{x}\n",
    "G{c} D{h} G1 X{x} Y{x} F{f}\nG91 X8. Y{d} ,R1.{n}\nX{d} Y9. ,C1.\nX-7. Y{d} ,R0.0{n}\nX{d} Y{d}\nG90 G40 X{x} Y{x}\n",
    "G{c} D{h} G1 X{x} Y{x} F{f}\nG38 X{x} Y{x} I{d} J{d}\nG39\nX{x} Y{x}\nG38 X{x}\nG40 X{x} Y{x} I{d} J{d}\n",
    "G{c} D{h} G1 X{x} Y{x} F{f}\nX{x} Y{x}\nG41 X{x} Y{x}\nG42 X{x} Y{x} D{h}\nG40\n",
    "G{c} D{h} G1 X{x} Y{x} F{f}\nX{x} Y{x}\nG28 X{x}\nY{x}\nG53 X{x}\nX{x} Y{x}\nG40 X{x}\n",
    "G18 G{c} D{h} G1 X{x} Z{x} F{f}\nX{x}\nZ{x} ,C0.{n}\nX{x} Z{x}\nG40 X{x}\nG17\n",
    "G{c} D{h} X{x} Y{x} Z{x} I{d} J{d} K{d} F{f}\nX{x} Y{x} Z{x}\nX{x} I{d} J0 K0\nG91 G{g} X{d} Y{d} R20.\nG90 G1\nG40 X{x}\n",
    "G1 X{x} Y{x} ,R0.{n} F{f}\nX{x} Y{x} ,C0.{n}\nX{x} Y{x}\n",
    "G91 G1 X9. ,R1. F{f}\nG{g} X{d} Y8. R20. ,R0.{n}\nG1 Y9. ,C0.{n}\nX{d} Y{d}\nG90\n",
    "G1 X{x} ,A{a} F{f}\nY{x} ,A{a} ,R0.{n}\nX{x}\n",
    "G1 ,A{a} F{f}\nX{x} Y{x} ,A{a}\n",
    "G12 I{r} D{h} F{f}\nG13 I{r} D{h}\n",
    "G45 G1 X{x} D{h} F{f}\nG46 Y{x}\nG47 X{x}\nG48 X{x} Y{x}\nG45 G91 G{g} X{d} Y{d} I{d} J0\nG90 G1\n",
    "G43.1 H{h}\nG1 X{x} Z{x} F{f}\nX{x}\nG49\n",
    "G51 X{x} Y{x} P{k}\nG1 X{x} Y{x} F{f}\nG91 G{g} X{d} Y{d} R15.\nG90 G50\n",
    "G51.1 X{x}\nG1 X{x} Y{x} F{f}\nG{g} I{r}\nG50.1 X0\n",
    "G68 X{x} Y{x} R{a}\nG1 X{x} Y{x} F{f}\nG{g} J{r}\nG69\n",
    "G68 X0 Y0 R{a}\nG{c} D{h} G1 X{x} Y{x} F{f}\nX{x}\nG40 Y{x}\nG69\n",
    "G16\nG1 X{r} Y{a} F{f}\nY{a}\nG15\n",
    "G12.1\nG1 X{x} C{x} F{f}\nX{x}\nC{x}\nG13.1\n",
    "G12.1\nG{c} D{h} G1 X{x} C{x} F{f}\nX{x}\nC{x}\nG40 X{x}\nG13.1\n",
    "G7.1 C{r}\nG1 Z{x} C{a} F{f}\nC{a}\nG7.1 C0\n",
    "G52 X{d} Y{d}\nG1 X{x} F{f}\nG52 X0 Y0\n",
    "G92 X{x} Y{x}\nG1 X{x} F{f}\nG92.1 X0 Y0\n",
    "G5{w} G1 X{x} F{f}\nG54\n",
    "G54.1 P{n}\nG1 X{x} F{f}\nG54\n",
    "G90 G10 L2 P{n} X{d} Y{d}\n",
    "G10 L10 P{h} R{d}\n",
    "G10 L12 P{h} R{d}\n",
    "G53 G0 X{x} Y{x}\n",
    "G28 X{x} Y{x}\n",
    "G91 G28 Z0\nG90\n",
    "G28 X{x}\nG29 X{x}\n",
    "G30 P2 X{x}\n",
    "G27 X{x}\n",
    "G31 X{x} F{f}\n#100=#5061\n",
    "G31.1 X{x} F{f}\n",
    "G22 X60. Y60. Z60. I-60. J-60. K-60.\nG1 X{x} F{f}\nG23\n",
    "G81 X{x} Y{x} Z{x} R{x} F{f}\nX{x}\nY{x} L2\nG80\n",
    "G98 G82 X{x} Z-{r} R{d} P{p} F{f}\nG99 Y{x}\nG80\n",
    "G83 X{x} Z-{r} R2. Q{r} F{f}\nX{x}\nG80\n",
    "G73 X{x} Z-{r} R2. Q{r} F{f}\nG80\n",
    "G85 X{x} Z-{r} R2. F{f}\nG89 X{x} Z-{r} P{p}\nG80\n",
    "G18 G81 X{x} Y{x} Z{x} R{x} F{f}\nG80 G17\n",
    "G99 G76 X{x} Z-{r} R2. I0.{n} J0 F{f}\nX{x}\nG87 X{x} Z{r} R-4. I0.{n} F{f}\nG80\n",
    "S{s} M3\nG84 X{x} Z-{r} R2. F1. ,R1\nY{x}\nG74 X{x} Z-{r} R2. Q{r} F0.{n} ,R1\nG80\n",
    "S{s} M3\nG84 X{x} Z-{r} R2. F1. ,R0\nX{x} P{p}\nG80\n",
    "G81 Z-{r} R2. L0 F{f}\nG34 X{x} Y{x} I{r} J{a} K{n}\nG35 X{x} Y{x} I{d} J{a} K{n}\nG80\n",
    "G81 Z-{r} R2. ,I0.{n} ,J0.{n} L0 F{f}\nG36 X{x} Y{x} I{r} J{a} P{a} K{n}\nG37.1 X{x} Y{x} I{d} P{n} J{d} K{n}\nG80\n",
    "G75 X{x} Z-{r} R2. Q0.{n} I{r} D{h} F{f}\nG80\n",
    "M98 P9001\n",
    "M98 P9001 L{n}\n",
    "M98 P9002\n",
    "G65 P9003 A{x} B{x} C{n}.\n",
    "G66 P9004 A{d}\nG1 X{x} F{f}\nX{x}\nG67\n",
    "G66.1 P9004 A{d}\nX{x}\nG67\n",
    "M96 P9005\nG1 X{x} F{f}\nY{x}\nM97\n",
    "M96 P9005\n",
    "{v}={x}\n{v}={v}*2.-{v}\n",
    "IF[{v} GT {x}] GOTO {l}\nG1 X{x} F{f}\nN{l}\n",
    "#120=0\nWHILE[#120 LT {n}] DO1\n#120=#120+1\nG1 X[#120*{d}] F{f}\nEND1\n",
    "#1100=1\n#1132={s}\nG1 X{x} F{f}\n#1100=0\n",
    "IF[#1000 EQ 1] GOTO {l}\nG1 Y{x} F{f}\nN{l}\n",
    "#101=#5021\n#102=#5041\n#103=#4001\nG1 X{x} F{f}\n",
    "#2001={d}\n#5221={d}\nG1 X{x} F{f}\n",
    "#3003=1\nG1 X{x} F{f}\nY{x}\n#3003=0\n",
    "#3004=7\nG1 X{x} F{f}\n#3004=0\n",
    "#3006=1(TAKE IT)\n",
    "#3000={n}(TOO FAR)\n",
    "DPRNT[X#100[53]]\n",
    "M0\n",
    "M1\n",
    "M{m}\n",
    "G1 X{x} F{f} M{m} S{s} T{h}\n",
    "T{h} M6\n",
    "G20\nG1 X0.{n} F{n}.\nG21 F{f}\n",
    "G1 A{a} F{f}\nA{a}\n",
    "G0 A{a}\nG1 X{x} A{a} F{f}\n",
    "/G1 X{x} F{f}\n/2 Y{x}\n",
    "G10 L50\nN8204 P1 R{n}\nG11\n",
};

/// The sub programs behind the main program, which are called from it.
inline constexpr uint32_t kInterruptProgram = 9005;
inline constexpr const char* kSubPrograms =
    "O9001\nG91 G1 X1.5 Y-0.75 F3000\nG2 X2. R4.\nG0 X-3.5 Y0.75\nG90\nM99\n"
    "O9002\nG91\nM98 P9001\nG1 X0.3 F2000\nM98 P9001\nG90\nM99\n"
    "O9003\nG1 X#1 F4000\nIF[#3 LE 1] GOTO 9\nG65 P9003 A[#1/2] C[#3-1]\nN9 Y#2\nM99\n"
    "O9004\n#140=#140+1\nG91 G1 Z#1 F3000\nZ-#1\nG90\nM99\n"
    "O9005\n#141=#141+1\nG0 Z20.\nG1 X1. F3000\nM99\n";

class PartMaker {
 public:
  explicit PartMaker(Dice& dice, double reach_mm) : dice_(dice), reach_mm_(reach_mm) {}

  /// A main program of some passages and its sub programs.
  std::string make(unsigned passages) {
    std::string text = "G90 G21 G17 G94 G1 F2000\n";
    for (unsigned i = 0; i < passages; ++i) text += fill(dice_.one_of(kPassages));
    text += dice_.chance(0.95) ? "M30\n" : dice_.chance(0.5) ? "M2\n" : "";
    text += kSubPrograms;
    if (dice_.chance(0.1)) spoil(text);
    return text;
  }
  /// Some blocks for MDI.
  std::string mdi() { return fill(dice_.one_of(kPassages)); }

 private:
  std::string fill(const char* passage) {
    std::string text;
    const unsigned label = ++label_;
    for (const char* p = passage; *p != 0; ++p) {
      if (*p == '{' && p[1] != 0 && p[2] == '}') {
        text += value(p[1], label);
        p += 2;
      } else {
        text += *p;
      }
    }
    return text;
  }
  std::string value(char kind, unsigned label) {
    switch (kind) {
      case 'x': return fixed(dice_.uniform(-reach_mm_, reach_mm_));
      case 'd': return fixed(dice_.uniform(-4, 4));
      case 't': return fixed(dice_.uniform(-0.02, 0.02));
      case 'r': return fixed(dice_.uniform(0.1, 12));
      case 'a': return fixed(dice_.uniform(-400, 400));
      case 'k': return fixed(dice_.scale(0.2, 4));
      case 'f': return fixed(dice_.scale(200, 30000));
      case 'g': return whole(2, 3);
      case 'c': return whole(41, 42);
      case 'n': return whole(1, 6);
      case 'w': return whole(4, 9);
      case 'h': return whole(1, 20);
      case 'm': return whole(10, 40);
      case 'p': return whole(1, 60);
      case 's': return whole(60, 6000);
      case 'v': return "#" + whole(100, 110);
      case 'l': return std::to_string(1000 + label);
      default: std::abort();  // a passage has a name of a value that does not exist
    }
  }
  static std::string fixed(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.3f", value);
    return text;
  }
  std::string whole(unsigned low, unsigned high) { return std::to_string(low + dice_.draw(high - low + 1)); }

  /// Changes, removes or inserts some characters.
  void spoil(std::string& text) {
    static constexpr char kAny[] = "GMXYZIJKRFNOTSDHPQL0123456789.-+*/#[]()=, \n;%EeA";
    for (unsigned n = 1 + dice_.draw(4); n > 0; --n) {
      const size_t at = dice_.draw(static_cast<unsigned>(text.size()));
      const char any = kAny[dice_.draw(sizeof kAny - 1)];
      switch (dice_.draw(3)) {
        case 0: text[at] = any; break;
        case 1: text.erase(at, 1); break;
        default: text.insert(at, 1, any); break;
      }
      if (text.empty()) text = "\n";
    }
  }

  Dice& dice_;
  double reach_mm_;
  unsigned label_ = 0;
};

}  // namespace nc::test
