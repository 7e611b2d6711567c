// SPDX-License-Identifier: Apache-2.0
// Cycles that are made in cuts (M700 13.1.1: G73, G83, and taps with Q) over many values of their words and parameters, against the operation pattern of
// the manual written down once more; the number of holes by L and K; and the alarm of each word that is missing or illegal, for each cycle.
#include <gtest/gtest.h>

#include <cmath>

#include "support/pull.hpp"

namespace nc::test {
namespace {

constexpr double kTop = 30, kR = 2;

std::string word(double value) {
  const std::string text = brief(value);
  return text.find('.') == std::string::npos ? text + "." : text;
}

/// Kind and level of each move along Z, and dwells: "rapid 2", "line -8", "tap -8", "dwell 0.1".
Path strokes(const Outcome& run) {
  static constexpr const char* kNames[] = {"rapid", "line", "arc", "helix", "skip", "thread", "tap"};
  Path all;
  for (const Step& step : run.steps) {
    const nc_item& item = step.item;
    if (item.kind == NC_ITEM_MOVE) all.push_back(kNames[item.u.move.kind] + (" " + brief(item.u.move.machine.v[2])));
    if (item.kind == NC_ITEM_GATE && item.u.gate.kind == NC_GATE_DWELL_SECONDS) all.push_back("dwell " + brief(item.u.gate.value));
  }
  return all;
}

/// Writes strokes that lead somewhere.
class Pen {
 public:
  void to(const char* kind, double level) {
    if (std::fabs(level - at_) > 1e-9) list.push_back(kind + (" " + brief(level)));
    at_ = level;
  }
  void dwell(double seconds) {
    if (seconds > 0) list.push_back("dwell " + brief(seconds));
  }
  Path list;

 private:
  double at_ = kTop;
};

/// How deep the cuts of Q go: the bottom is the last of them.
std::vector<double> cuts(double bottom, double q) {
  std::vector<double> all;
  const int whole = static_cast<int>(std::ceil((kR - bottom) / q - 1e-9));
  for (int n = 1; n < whole; ++n) all.push_back(kR - n * q);
  all.push_back(bottom);
  return all;
}

struct Words {
  double bottom, q, amount, dwell;  ///< amount: #8013, #8012, #8018
  bool to_r;
};

Path of_g83(const Words& w) {
  Pen pen;
  pen.to("rapid", kR);
  for (const double depth : cuts(w.bottom, w.q)) {
    pen.to("line", depth);  // (3), (6), (9)
    if (depth == w.bottom) break;
    pen.to("rapid", kR);                               // (4), (7)
    pen.to("rapid", std::fmin(depth + w.amount, kR));  // (5), (8)
  }
  pen.to("rapid", w.to_r ? kR : kTop);
  return pen.list;
}

Path of_g73(const Words& w) {
  Pen pen;
  pen.to("rapid", kR);
  for (const double depth : cuts(w.bottom, w.q)) {
    pen.to("line", depth);
    pen.dwell(w.dwell);
    if (depth != w.bottom) pen.to("rapid", std::fmin(depth + w.amount, kR));
  }
  pen.to("rapid", w.to_r ? kR : kTop);
  return pen.list;
}

/// docs/decisions.md, "Q of a tap". A floating holder without a way back makes one cut.
Path of_tap(const Words& w, const char* kind, bool back_to_r) {
  Pen pen;
  pen.to("rapid", kR);
  const bool whole = kind == std::string("line") && w.amount == 0 && !back_to_r;
  for (const double depth : whole ? std::vector<double>{w.bottom} : cuts(w.bottom, w.q)) {
    pen.to(kind, depth);
    if (depth != w.bottom) pen.to(kind, back_to_r ? kR : std::fmin(depth + w.amount, kR));
  }
  pen.dwell(w.dwell);
  pen.to(kind, kR);
  pen.dwell(w.dwell);
  pen.to("rapid", w.to_r ? kR : kTop);
  return pen.list;
}

std::vector<Words> all_words() {
  std::vector<Words> all;
  for (const double bottom : {-6., -7.5, 1.25})
    for (const double q : {0.75, 2., 4., 8., 50.})
      for (const double amount : {0., 0.25, 0.5, 5., 40.})
        for (const double dwell : {0., 0.3})
          for (const bool to_r : {false, true}) all.push_back({bottom, q, amount, dwell, to_r});
  return all;
}

std::string block(const char* code, const Words& w, bool incremental) {
  const double z = incremental ? w.bottom - kR : w.bottom, r = incremental ? kR - kTop : kR;
  std::string text = std::string(w.to_r ? "G99" : "G98") + (incremental ? " G91 " : " G90 ") + code + " Z" + word(z) + " R" + word(r) + " Q" + word(w.q);
  return w.dwell > 0 ? text + " P300" : text;
}

Outcome drilled(const std::string& cycle, const std::map<std::string, std::string>& parameters) {
  Bench bench;
  for (const auto& [key, value] : parameters) bench.param(key.c_str(), value.c_str());
  return bench.at(0, 0, kTop).run("G0\nS600\nM3\n" + cycle + "\nG80\nM30");
}

TEST(Cuts, ArePecksWithTheirAmounts) {
  for (const Words& w : all_words()) {
    for (const bool incremental : {false, true}) {
      const std::map<std::string, std::string> amounts{{"8013", brief(w.amount)}, {"8012", brief(w.amount)}};
      Words no_dwell = w;
      no_dwell.dwell = 0;
      const std::string g83 = block("G83", no_dwell, incremental) + " F100", g73 = block("G73", w, incremental) + " F100";
      EXPECT_EQ(strokes(drilled(g83, amounts)), of_g83(w)) << g83 << " #8013=" << w.amount;
      EXPECT_EQ(strokes(drilled(g73, amounts)), of_g73(w)) << g73 << " #8012=" << w.amount;
    }
  }
}

TEST(Cuts, OfTapsGoBackByTheAmountOrToR) {
  for (const Words& w : all_words()) {
    for (const bool back_to_r : {false, true}) {
      const std::map<std::string, std::string> set{{"8018", brief(w.amount)}, {"1272", back_to_r ? "16" : "0"}};
      for (const char* code : {"G84", "G74"}) {
        const std::string floating = block(code, w, false) + " F900 ,R0", synchronous = block(code, w, true) + " F1. S600 ,R1";
        EXPECT_EQ(strokes(drilled(floating, set)), of_tap(w, "line", back_to_r)) << floating << " #8018=" << w.amount;
        EXPECT_EQ(strokes(drilled(synchronous, set)), of_tap(w, "tap", back_to_r)) << synchronous << " #8018=" << w.amount;
      }
    }
  }
}

/// How often each cycle cuts along Z in a block with these words.
size_t holes(const std::string& code, const std::string& count) {
  const std::string words = code == "G75" ? " Q5. P7" : code == "G83" || code == "G73" ? " Q50." : code == "G76" || code == "G87" ? " I1." : "";
  Bench bench;
  const Outcome run = bench.tool(7, 1).at(0, 0, kTop).run("G0\nS600\nM3\nG91 " + code + " X1. Z-5. R-20." + words + " F100 " + count + "\nG80\nM30");
  EXPECT_EQ(run.alarm, "") << code << count;
  size_t all = 0;
  double x = 0;
  for (const nc_move& move : run.moves()) {
    if (std::fabs(move.machine.v[0] - move.machine_start.v[0]) > 0.999 && move.kind == NC_MOVE_RAPID && move.machine.v[0] > x + 0.5) ++all, x = move.machine.v[0];
  }
  return all;
}

TEST(Cuts, AsManyHolesAsLOrKSays) {
  for (const char* code : {"G73", "G74", "G81", "G82", "G83", "G84", "G85", "G86", "G88", "G89"}) {
    for (const char* letter : {"L", "K"}) {
      EXPECT_EQ(holes(code, ""), 1U) << code;
      EXPECT_EQ(holes(code, std::string(letter) + "0"), 0U) << code;
      EXPECT_EQ(holes(code, std::string(letter) + "1"), 1U) << code;
      EXPECT_EQ(holes(code, std::string(letter) + "7"), 7U) << code;
    }
  }
}

TEST(Cuts, G98ComesBackToTheLevelOfTheModeWhateverWasInBetween) {
  const Outcome run = drilled("G99 G81 Z-5. R2. F100\nG98 X1.\nG99 G83 X2. Q3.\nX3. R4.\nG98 X4.\nG85 X5.", {{"8013", "0"}});
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(strokes(run), (Path{"rapid 2", "line -5", "rapid 2",                                                     // G99
                                "rapid 2", "line -5", "rapid 30",                                                    // G98
                                "rapid 30", "rapid 2", "line -1", "rapid 2", "rapid -1", "line -4", "rapid 2", "rapid -4", "line -5", "rapid 2",  //
                                "rapid 2", "rapid 4", "line 1", "rapid 4", "rapid 1", "line -2", "rapid 4", "rapid -2", "line -5", "rapid 4",     //
                                "rapid 4", "line 1", "rapid 4", "rapid 1", "line -2", "rapid 4", "rapid -2", "line -5", "rapid 30",               //
                                "rapid 30", "rapid 4", "line -5", "line 4", "rapid 30"}));
}

// ---- missing and illegal words

struct Cycle {
  const char* code;
  const char* words;  ///< that it needs besides Z, R and F
};
constexpr Cycle kCycles[] = {{"G73", "Q2."}, {"G74", ""}, {"G75", "Q5. P7"}, {"G76", "I1."}, {"G81", ""},     {"G82", "P100"}, {"G83", "Q2."},
                             {"G84", ""},    {"G85", ""}, {"G86", ""},       {"G87", "I1."}, {"G88", ""}, {"G89", ""}};

std::string alarm_of(const std::string& text) {
  Bench bench;
  return bench.tool(7, 1).at(0, 0, kTop).run("G0\nS600\nM3\n" + text + "\nG80\nM30").alarm;
}

TEST(CycleAlarms, OfWordsThatEveryCycleHas) {
  for (const Cycle& cycle : kCycles) {
    const std::string all = std::string(cycle.code) + (cycle.code == std::string("G87") ? " Z-5. R-8. " : " Z-5. R2. ") + cycle.words;
    EXPECT_EQ(alarm_of(all + " F100"), "") << all;
    EXPECT_EQ(alarm_of(all), "P62") << all;
    EXPECT_EQ(alarm_of(all + " F0"), "P62") << all;
    for (const char* count : {"L-1", "L10000", "K-1", "K10000"}) EXPECT_EQ(alarm_of(all + " F100 " + count), "P35") << all << count;
    for (const char* width : {",I0", ",I1000.", ",J0", ",J1000."}) EXPECT_EQ(alarm_of(all + " F100 " + width), "P35") << all << width;
    EXPECT_EQ(alarm_of("G93\n" + all + " F100"), "P125") << all;
    EXPECT_EQ(alarm_of(all + " F100\nG93"), "P125") << all;
    EXPECT_EQ(alarm_of("G41 D1 G1 X1. F9\n" + all + " F100"), "P155") << all;
    EXPECT_EQ(alarm_of(all + " F100\nG42 D1 X5."), "P155") << all;
    if (cycle.code != std::string("G75")) {
      EXPECT_EQ(alarm_of(std::string(cycle.code) + " Z-5. R2. F100 Q2. P-1"), "P35") << all;
    }
    const bool taps = cycle.code == std::string("G84") || cycle.code == std::string("G74");
    EXPECT_EQ(alarm_of(all + " F100 ,R1"), taps ? "P181" : "P380") << all;
    EXPECT_EQ(alarm_of(all + " F100 ,S500"), taps ? "" : "P32") << all;
    EXPECT_EQ(alarm_of(all + " F100\nX1. S700"), "") << all;
  }
}

TEST(CycleAlarms, OfWordsThatSomeCyclesNeed) {
  const struct {
    const char* text;
    const char* alarm;
  } kRows[] = {
      {"G73 Z-5. R2. F100", "P33"},
      {"G83 Z-5. R2. F100", "P33"},
      {"G83 Z-5. R2. F100 Q0", "P33"},
      {"G75 Z-5. R2. F100 P7", "P33"},
      {"G75 Z-5. R2. F100 Q5.", "P170"},
      {"G75 Z-5. R2. F100 Q5. P999", "P170"},
      {"G75 Z-5. R2. F100 Q1. P7", "P223"},
      {"G76 Z-5. R2. F100 Q0.3", "P33"},  // without #1080 it would be no shift
      {"G87 Z-5. R-8. F100 Q0.3", "P33"},
      {"G76 Z-5. R2. F100", "P33"},  // along the wall
      {"G87 Z-5. R-8. F100", "P33"},
      {"G87 Z-5. R-8. F100 I0", "P33"},
      {"G83 Z-5. R2. F100 Q2.\nG76 X1.", "P33"},  // the Q of another cycle
      {"G83 Z-5. R2. F100 Q2.\nG76 X1. J1.\nX2.", ""},
      {"G81 Z-5. R2. F100 I1. J.5\nG76 X1.", ""},  // "modals during the canned cycle", whatever hole they stand in
      {"G18\nG81 Y-5. R2. F100 K2\nG76 X1.", "P33"},  // there K counts holes
      {"G84 Z-5. R2. S500 Q4. F100 ,R0\nG83 X1.", ""},
      {"G84 Z-5. R2. S500 F100 ,R0\nG83 X1.", "P33"},
      {"G87 Z-8. R-5. F100 I1.", "P35"},  // from below downwards
      {"G87 Z-5. R-5. F100 I1.", ""},
      {"G84 Z-5. R2. F1. S500 ,R2", "P35"},
      {"G84 Z-5. R2. S500 ,R1", "P183"},
      {"G84 Z-5. R2. F0 S500 ,R1", "P184"},
      {"G84 Z-5. R2. F1000. S500 ,R1", "P184"},
      {"G74 Z-5. R2. E0 S500 ,R1", "P184"},
      {"G74 Z-5. R2. F1. S500 ,S100000 ,R1", "P35"},
      {"G74 Z-5. R2. F1. S500 ,R1\nX1. S600", "P186"},
      {"G74 Z-5. R2. F1. S500 ,R1\nS600", "P186"},
  };
  for (const auto& row : kRows) EXPECT_EQ(alarm_of(row.text), row.alarm) << row.text;
  Bench bench;
  EXPECT_EQ(bench.at(0, 0, kTop).run("G0\nG84 Z-5. R2. F100\nM30").alarm, "P181") << "no speed has been commanded";
}

}  // namespace
}  // namespace nc::test
