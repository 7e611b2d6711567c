// SPDX-License-Identifier: Apache-2.0
// Tapping cycles (M700 13.1.1, G84 and G74): their words, and what decides between a tap with a floating holder and a synchronous one.
#include <gtest/gtest.h>

#include "support/pull.hpp"

namespace nc::test {
namespace {

Outcome tap(const std::string& block, const std::map<std::string, std::string>& parameters = {}, const std::string& before = "S600\nM3\n") {
  Bench bench;
  for (const auto& [key, value] : parameters) bench.param(key.c_str(), value.c_str());
  return bench.at(0, 0, 10).run("G0\n" + before + block + "\nG80\nM30");
}

/// Kinds of the moves along the drilling axis and the M codes between them: "rapid 2", "tap -8", "M4".
Path strokes(const Outcome& run) {
  static constexpr const char* kNames[] = {"rapid", "line", "arc", "helix", "skip", "thread", "tap"};
  Path all;
  for (const Step& step : run.steps) {
    const nc_item& item = step.item;
    if (item.kind == NC_ITEM_MOVE) all.push_back(kNames[item.u.move.kind] + (" " + brief(item.u.move.machine.v[2])));
    if (item.kind == NC_ITEM_GATE && item.u.gate.kind == NC_GATE_DWELL_SECONDS) all.push_back("dwell " + brief(item.u.gate.value));
    if (item.kind == NC_ITEM_GATE && item.u.gate.kind == NC_GATE_IN_POSITION) all.push_back("check");
    if (item.kind == NC_ITEM_ACTION && item.u.action.kind <= NC_ACTION_B) all.push_back(item.u.action.letter + brief(item.u.action.value));
  }
  all.pop_back();  // M30
  return all;
}

const Path kFloating{"S600", "M3", "rapid 2", "line -8", "M4", "line 2", "M3", "rapid 10"};
const Path kSynchronous{"S600", "M3", "rapid 2", "tap -8", "tap 2", "rapid 10"};

TEST(Tap, SynchronousOrFloating) {  // precaution (20): all combinations
  const std::string words = "G84 Z-8. R2. S600 F1.5";
  for (unsigned bits = 0; bits < 4; ++bits) {
    const bool parameter = (bits & 1) != 0, code = (bits & 2) != 0;
    std::map<std::string, std::string> set{{"1229", parameter ? "16" : "0"}, {"1272", "2"}, {"1513", "29"}};
    const std::string before = code ? "M29\n" : "";
    const auto kind = [&](const char* word) { return tap(words + word, set, before).moves().at(1).kind; };
    EXPECT_EQ(kind(" ,R0"), NC_MOVE_LINE) << bits;
    EXPECT_EQ(kind(" ,R1"), NC_MOVE_TAP) << bits;
    EXPECT_EQ(kind(""), parameter || code ? NC_MOVE_TAP : NC_MOVE_LINE) << bits;
    EXPECT_EQ(kind(" M29"), NC_MOVE_TAP) << bits;
    set["1272"] = "0";  // "cannot be selected with the M function when this parameter is OFF"
    EXPECT_EQ(tap(words + " M29", set).moves().at(1).kind, parameter ? NC_MOVE_TAP : NC_MOVE_LINE) << bits;
  }
  // The M code holds to the end of the cycle; ,R holds in it.
  const std::map<std::string, std::string> set{{"1272", "2"}, {"1513", "29"}};
  EXPECT_EQ(tap("M29\n" + words + "\nG80\n" + words, set).moves().at(5).kind, NC_MOVE_LINE);
  EXPECT_EQ(tap(words + " ,R1\nX5.").moves().at(6).kind, NC_MOVE_TAP);
  EXPECT_EQ(tap(words + " ,R1\nG80\n" + words).moves().at(5).kind, NC_MOVE_LINE);
}

TEST(Tap, Floating) {
  EXPECT_EQ(strokes(tap("G84 Z-8. R2. F900")), kFloating);
  EXPECT_EQ(strokes(tap("G84 Z-8. R2. F900", {{"3028", "40"}})), (Path{"S600", "M3", "rapid 2", "line -8", "M41", "line 2", "M40", "rapid 10"}));
  const Outcome run = tap("G84 Z-8. R2. P200 F900\nX5.");
  EXPECT_EQ(run.dwells(), (std::vector<double>{0.2, 0.2, 0.2, 0.2}));
  EXPECT_EQ(run.path().at(1), "line 0 0 -8 F900");
  EXPECT_EQ(strokes(tap("G95 G74 Z-8. R2. F1.5")), (Path{"S600", "M3", "rapid 2", "line -8", "M3", "line 2", "M4", "rapid 10"}));
  EXPECT_EQ(tap("G95 G84 Z-8. R2. F1.5").moves().at(1).feed_mm_rev, 1.5);  // 7.4 note 5: in the feed mode that is in force
}

/// 13.1.1 (6) (b): per minute, per revolution, and with the one-digit feed F0 to F8 without a point.
TEST(Tap, FeedOfAFloatingOneMayBeOfOneDigit) {
  const std::map<std::string, std::string> digits{{"1079", "1"}, {"1185", "800"}, {"1186", "1650"}, {"1187", "2400"}, {"1188", "3100"}, {"1189", "4200"}};
  const auto feeds = [&](const std::string& words, bool digit) {
    std::vector<double> all;
    for (const nc_move& move : tap("G84 Z-8. R2. ,R0 " + words, digit ? digits : std::map<std::string, std::string>{}).moves())
      if (move.kind == NC_MOVE_LINE) all.push_back(move.feed_mm_rev > 0 ? -move.feed_mm_rev : move.feed_mm_min);
    return all;
  };
  const auto both = [](double feed) { return std::vector<double>{feed, feed}; };
  EXPECT_EQ(feeds("F3", false), both(3));
  EXPECT_EQ(feeds("F3", true), both(2400)) << "in and out again";
  EXPECT_EQ(feeds("F1", true), both(800));
  EXPECT_EQ(feeds("F3.", true), both(3)) << "with a point it is a feed";
  EXPECT_EQ(feeds("F9", true), both(9)) << "there are F0 to F8";
  EXPECT_EQ(feeds("F900", true), both(900));
  EXPECT_EQ(feeds("G95 F1.5", false), both(-1.5));
  EXPECT_EQ(feeds("G95 F2", true), feeds("G95 F2", false)) << "per revolution, whatever the parameter says";
}

TEST(Tap, SynchronousHasItsLeadAndSpeed) {
  const Outcome run = tap("G84 Z-8. R2. S800 F1.5 ,R1");
  EXPECT_EQ(strokes(run), kSynchronous);  // neither S nor M3, M4, M5 goes out in it
  EXPECT_EQ(run.moves().at(1).feed_mm_rev, 1.5);
  EXPECT_EQ(run.moves().at(1).feed_mm_min, 1200);
  EXPECT_EQ(run.moves().at(2).feed_mm_min, 1200);
  EXPECT_EQ(tap("G84 Z-8. R2. S800 F1.5 ,R1 ,S1600").moves().at(2).feed_mm_min, 2400);
  EXPECT_EQ(tap("G84 Z-8. R2. S800 F1.5 ,R1 ,S400").moves().at(2).feed_mm_min, 1200);  // (12)
  EXPECT_EQ(tap("G84 Z-8. R2. S800 F1.5 ,R1 ,S1600\nX5.").moves().at(7).feed_mm_min, 2400);
  EXPECT_EQ(tap("G84 Z-8. R2. S800 F1 ,R1").moves().at(1).feed_mm_rev, 1);
  EXPECT_DOUBLE_EQ(tap("G84 Z-8. R2. S800 E20 ,R1").moves().at(1).feed_mm_rev, 1.27);  // ridges per inch
  EXPECT_DOUBLE_EQ(tap("G20 G84 Z-.3 R.1 S800 F.05 ,R1").moves().at(1).feed_mm_rev, 1.27);
  // The feed of other cuts is another one, and stays.
  EXPECT_EQ(tap("G84 Z-8. R2. S800 F1.5 ,R1\nG80\nG1 X50.", {}, "F333\n").moves().back().feed_mm_min, 333);
}

/// 10.4: "the lowest upper limit is valid", also of a spindle that a tap turns; in G97 where #1146 is 1 and #1227 bit 5 is 0.
TEST(Tap, ASynchronousOneKeepsTheClampOfTheSpindle) {
  const auto feeds = [](const std::string& clamp, const std::string& words = "", const std::map<std::string, std::string>& set = {{"1146", "1"}}) {
    const Outcome run = tap("G84 Z-8. R2. S800 F1.5 ,R1 " + words, set, clamp + "\n");
    return run.alarm.empty() ? std::vector<double>{run.moves().at(1).feed_mm_min, run.moves().at(2).feed_mm_min} : std::vector<double>{};
  };
  EXPECT_EQ(feeds("G92 S500"), (std::vector<double>{750, 750}));
  EXPECT_EQ(feeds("G92 S500", ",S1600"), (std::vector<double>{750, 750}));
  EXPECT_EQ(feeds("G92 S1000", ",S1600"), (std::vector<double>{1200, 1500}));
  EXPECT_EQ(feeds("G92 S500\nG92 S1000", ",S1600"), (std::vector<double>{1200, 1500})) << "the last one counts";
  EXPECT_EQ(feeds("G92 S500 Q600"), (std::vector<double>{900, 900})) << "precaution (1): they change places";
  EXPECT_EQ(feeds("G92 Q900"), (std::vector<double>{1200, 1200})) << "a lower limit makes no tap faster than its S";
  EXPECT_EQ(feeds("G92 S500", "", {{"1146", "1"}, {"1227", "32"}}), (std::vector<double>{1200, 1200})) << "in G96 only";
  EXPECT_EQ(feeds("G92 S500", "", {{"1146", "0"}}), (std::vector<double>{1200, 1200})) << "a spindle speed";
  EXPECT_EQ(feeds("G92 S600", "", {{"1146", "1"}, {"3005", "500"}}), (std::vector<double>{750, 750})) << "the lowest";
}

TEST(Tap, TheSpeedOfASynchronousOneIsNotThatOfASurface) {  // 10.3: in G96 another S would be
  const Outcome run = tap("G84 Z-8. R2. S800 F1.5 ,R1", {}, "G96 S100\n");
  EXPECT_EQ(run.moves().at(1).feed_mm_min, 1200);
  std::vector<double> surfaces;
  for (const Step& step : run.steps)
    if (step.item.kind == NC_ITEM_ACTION && step.item.u.action.kind == NC_ACTION_CONTROL && step.item.u.action.index == NC_CONTROL_SURFACE_SPEED) surfaces.push_back(step.item.u.action.value);
  EXPECT_EQ(surfaces, (std::vector<double>{100, 0})) << "and at the end of the program none";
}

TEST(Tap, ChecksOfASynchronousTap) {  // "setting values of synchronous tap in-position check parameters"
  const auto path = [](unsigned bits, const char* p, const char* least = "0") {
    return strokes(tap(std::string("G84 Z-8. R2. S800 F1.5 ,R1 ") + p, {{"1223", std::to_string(bits)}, {"1313", least}}, ""));
  };
  const unsigned approach = 4, on = 8, bottom = 16, r = 32;
  EXPECT_EQ(path(on | bottom | r | approach, "P0"), (Path{"rapid 2", "check", "tap -8", "check", "tap 2", "check", "rapid 10"}));
  EXPECT_EQ(path(on | bottom, "P0"), (Path{"rapid 2", "tap -8", "check", "tap 2", "rapid 10"}));
  EXPECT_EQ(path(on | r, "P0"), (Path{"rapid 2", "tap -8", "tap 2", "check", "rapid 10"}));
  EXPECT_EQ(path(on | approach, "P0"), (Path{"rapid 2", "check", "tap -8", "tap 2", "rapid 10"}));
  EXPECT_EQ(path(on | bottom | r | approach, ""), (Path{"rapid 2", "tap -8", "tap 2", "rapid 10"}));  // no P: no checks
  EXPECT_EQ(path(bottom | r | approach, "P0"), (Path{"rapid 2", "tap -8", "tap 2", "rapid 10"}));
  EXPECT_EQ(path(0, "P100", "250"), (Path{"rapid 2", "tap -8", "dwell 0.1", "tap 2", "dwell 0.1", "rapid 10"}));
  // #1313 is a "hole bottom wait time"; back at R there is P, "G4 Pp1".
  EXPECT_EQ(path(on | bottom, "P100", "250"), (Path{"rapid 2", "tap -8", "check", "dwell 0.25", "tap 2", "dwell 0.1", "rapid 10"}));
  EXPECT_EQ(path(on, "", "250"), (Path{"rapid 2", "tap -8", "dwell 0.25", "tap 2", "rapid 10"}));
  EXPECT_EQ(path(on, "P400", "250"), (Path{"rapid 2", "tap -8", "dwell 0.4", "tap 2", "dwell 0.4", "rapid 10"}));
  // The last cut of a tap in cuts is the one that ends at the bottom.
  EXPECT_EQ(path(on | bottom | r | approach, "P0 Q6."), (Path{"rapid 2", "check", "tap -4", "tap -8", "check", "tap 2", "check", "rapid 10"}));
}

// Without bit 3 all three places are checked, "determined by inpos (#1193) and aux07 (#1223) bit 1", G61 or not; with it these parameters say nothing there, as they
// go on to do for the way to the initial level.
TEST(Tap, ChecksByTheParametersOfEveryMove) {
  const auto path = [](unsigned bits, const std::string& block, const char* rapid) {
    return strokes(tap(block, {{"1223", std::to_string(bits)}, {"1193", rapid}}, ""));
  };
  const std::string words = "G84 Z-8. R2. S800 F1.5 ,R1 P0";
  const unsigned cutting = 2, approach = 4, on = 8, bottom = 16;
  EXPECT_EQ(path(cutting, words, "1"), (Path{"rapid 2", "check", "tap -8", "check", "tap 2", "check", "rapid 10", "check"}));
  EXPECT_EQ(path(cutting, words, "0"), (Path{"rapid 2", "tap -8", "check", "tap 2", "check", "rapid 10"}));
  EXPECT_EQ(path(0, words, "1"), (Path{"rapid 2", "check", "tap -8", "tap 2", "rapid 10", "check"}));
  EXPECT_EQ(path(0, "G61 " + words, "0"), (Path{"rapid 2", "tap -8", "tap 2", "rapid 10"}));
  EXPECT_EQ(path(cutting | on, "G61 " + words, "1"), (Path{"rapid 2", "tap -8", "tap 2", "rapid 10", "check"}));
  EXPECT_EQ(path(cutting | on | approach | bottom, words, "1"), (Path{"rapid 2", "check", "tap -8", "check", "tap 2", "rapid 10", "check"}));
  EXPECT_EQ(path(cutting, "G84 Z-8. R2. F900 S800 P0", "0"), (Path{"S800", "rapid 2", "line -8", "M4", "line 2", "M3", "rapid 10"})) << "a floating holder: cuts as any";
}

TEST(Tap, InCuts) {
  EXPECT_EQ(strokes(tap("G84 Z-8. R2. Q4. F900", {{"8018", "0.5"}}, "S600\n")),
            (Path{"S600", "rapid 2", "line -2", "M4", "line -1.5", "M3", "line -6", "M4", "line -5.5", "M3", "line -8", "M4", "line 2", "M3", "rapid 10"}));
  EXPECT_EQ(strokes(tap("G84 Z-8. R2. Q4. S600 F1. ,R1", {{"8018", "0.5"}}, "")),
            (Path{"rapid 2", "tap -2", "tap -1.5", "tap -6", "tap -5.5", "tap -8", "tap 2", "rapid 10"}));
  EXPECT_EQ(strokes(tap("G74 Z-8. R2. Q4. S600 F1. ,R1", {{"1272", "16"}}, "")),
            (Path{"rapid 2", "tap -2", "tap 2", "tap -6", "tap 2", "tap -8", "tap 2", "rapid 10"}));
  // Q of another cycle is none of a tap's.
  EXPECT_EQ(strokes(tap("G83 Z-8. R2. Q4. F900\nG84 X5.")).size(), 2U + 9U + 7U);
}

TEST(Tap, ShiftByQWhereTheDrillingAxisIsAlwaysZ) {  // G76, G87, note
  const auto path = [](const char* block, const char* ignored, const char* minus) {
    Bench bench;
    bench.param("1080", "1").param("8207", ignored, 'Y').param("8208", minus, 'X').at(0, 0, 10);
    return bench.run(std::string("G0\n") + block + "\nG80\nM30").path();
  };
  EXPECT_EQ(path("G76 Z-8. R2. Q0.5 F100", "0", "0").at(2), "line 0.5 0.5 -8 F100");
  EXPECT_EQ(path("G76 Z-8. R2. Q-0.5 F100", "1", "1").at(2), "line -0.5 0 -8 F100");  // the sign of Q is ignored
  EXPECT_EQ(path("G76 Z-8. R2. Q0.5 I0.25 F100", "0", "0").at(2), "line 0.25 0 -8 F100");
  EXPECT_EQ(path("G83 Z-8. R2. Q0.5 F100 L0\nG76 X1.", "0", "0").at(3), "line 1.5 0.5 -8 F100");  // one modal Q
}

// M700 13.1.1, G76 and G87: the shift is one in the plane. Where #1080 makes Z drill in a plane that has it, a word along Z is none, and without another one the bar
// would go down through the work.
TEST(Tap, AShiftAlongTheAxisThatDrillsIsNone) {
  const auto run = [](const char* block, const char* ignored = "0") {
    Bench bench;
    bench.param("1080", "1").param("8207", ignored, 'X').param("8207", ignored, 'Y').at(0, 0, 10);
    return bench.run(std::string("G0 F100\n") + block + "\nG80\nM30");
  };
  for (const char* block : {"G18 G76 Z-8. R2. K0.5", "G19 G76 Z-8. R2. K0.5", "G18 G87 Z-3. R-12. K0.5", "G17 G87 Z-3. R-12. I0 J0"}) EXPECT_EQ(run(block).alarm, "P33") << block;
  EXPECT_EQ(run("G18 G76 Z-8. R2. K0.5 I0.25").path().at(2), "line 0.25 0 -8 F100");
  EXPECT_EQ(run("G19 G76 Z-8. R2. K0.5 J0.25").path().at(2), "line 0 0.25 -8 F100");
  EXPECT_EQ(run("G18 G76 Z-8. R2. Q0.5").path().at(2), "line 0.5 0 -8 F100");
  EXPECT_EQ(run("G17 G76 Z-8. R2. Q0.5", "1").path().at(2), "rapid 0 0 10") << "#8207: no shift";
}

TEST(Tap, Alarms) {
  EXPECT_EQ(tap("G84 Z-8. R2. F900", {}, "").alarm, "P181");                            // no S so far
  EXPECT_EQ(tap("G84 Z-8. R2. F1. ,R1").alarm, "P181");                                 // none in the block of a synchronous tap
  EXPECT_EQ(tap("G84 Z-8. R2. S600 ,R1").alarm, "P183");
  EXPECT_EQ(tap("G84 Z-8. R2. S600", {}, "").alarm, "P62");
  for (const char* word : {"F0", "F1000.", "F-1.", "E0"}) EXPECT_EQ(tap(std::string("G84 Z-8. R2. S600 ,R1 ") + word).alarm, "P184") << word;
  EXPECT_EQ(tap("G84 Z-8. R2. S600 F1. ,R1\nX5. S700").alarm, "P186");
  EXPECT_EQ(tap("G84 Z-8. R2. S600 F1. ,R1\nS700").alarm, "P186");
  for (const char* beside : {"G34 X0 Y0 I10. K2 S700", "G04 X1. S700", "G54 S700", "G52 X1. S700", "X5. L0 S700"})
    EXPECT_EQ(tap(std::string("G84 Z-8. R2. S600 F1. ,R1\n") + beside).alarm, "P186") << beside;
  for (const char* ended : {"G80\nS700", "G80 S700", "G0 X1. S700", "G84 X2. Z-8. R2. F1. S700"}) EXPECT_EQ(tap(std::string("G84 Z-8. R2. S600 F1. ,R1\n") + ended).alarm, "") << ended;
  EXPECT_EQ(tap("G84 Z-8. R2. S600 F1. ,R1\nG84 X5. S700").alarm, "");
  for (const char* word : {",R2", ",R0.5", ",R-1", ",S100000", ",S-1"})
    EXPECT_EQ(tap(std::string("G84 Z-8. R2. S600 F1. ") + word).alarm, "P35") << word;
  EXPECT_EQ(tap("G81 Z-8. R2. F100 ,S600").alarm, "P32");
  EXPECT_EQ(tap("G81 Z-8. R2. F100 ,R1").alarm, "P380");
  EXPECT_EQ(tap("G84 Z-8. R2. F900 E20 ,R0").alarm, "P32");
  EXPECT_EQ(tap("G84 Z-8. R2. S600 F1. ,R1\nX5. S1=700").alarm, "P33");  // 10.6.1: no form of S here
}

}  // namespace
}  // namespace nc::test
