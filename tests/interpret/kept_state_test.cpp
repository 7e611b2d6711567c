// SPDX-License-Identifier: Apache-2.0
// Which parts of the interpreter's state survive an interrupt program (M700 13.12), a call (13.3.1), the change from one MDI block to the next (5.1),
// an end and a reset (3.7, 9.1), tested with every mode that a program can set. lifetimes_test.cpp tests the groups of the state.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "support/pull.hpp"

namespace nc::test {
namespace {

void milling(nc_config& config) {
  axes("XYZc")(config);
  config.extended_variables = false;
}

std::unique_ptr<Bench> machine() {
  auto bench = std::make_unique<Bench>(NC_DIALECT_M700, milling);
  bench->param("1516", "C").param("8025", "1").param("1229/bit1", "1").param("1272/bit2", "0").at(20, 0, 0);
  bench->work_offset(2, {10, 0, 0}).work_offset(101, {7, 0, 0});
  for (unsigned n = 1; n <= 5; ++n) bench->tool(n, n);
  return bench;
}

struct Result {
  Path path;
  std::string alarm, events;
};

std::string called;  ///< O2000

/// Runs the text; if `interrupt` is given, that interrupt program runs after the block of line 2. It must have no move.
Result run(const std::string& text, const char* interrupt, bool type_2) {
  const std::unique_ptr<Bench> bench = machine();
  bench->param("1113", type_2 ? "1" : "0");
  bench->add("O1000", std::string(interrupt == nullptr ? "" : interrupt) + "\nM99\n");
  if (!called.empty()) bench->add("O2000", called);
  bench->start("M96 P1000\n" + text + "\nM30");
  Outcome all;
  all.axis_count = 4;
  Step step;
  bool done = interrupt == nullptr;
  bool in_service = false;
  Result result;
  unsigned head = static_cast<unsigned>(std::count(text.begin(), text.begin() + static_cast<long>(text.find("(HERE)")), '\n')) + 2;
  for (nc_status status; all.steps.size() < 500 && ((status = bench->pull(&step)) == NC_OK || status == NC_BUDGET);) {
    if (status != NC_OK) continue;
    in_service = step.item.source.depth > 0;
    if (!in_service) all.steps.push_back(step);
    const bool mark = step.item.kind == NC_ITEM_MARK && step.item.u.mark.report;
    if (!done && !in_service && mark && step.item.source.line == head) {
      done = true;
      bool back = false;
      EXPECT_EQ(nc_interrupt_signal(bench->control(), 0, true, &back), NC_OK);
      EXPECT_FALSE(back);
      nc_interrupt_signal(bench->control(), 0, false, &back);
    }
  }
  EXPECT_TRUE(done) << text;
  result.path = all.path();
  nc_alarm alarm{};
  if (nc_alarm_get(bench->control(), 0, &alarm) == NC_OK) result.alarm = alarm.code;
  for (const Step& s : all.steps) {
    if (s.item.kind != NC_ITEM_MOVE) continue;
    const nc_move& m = s.item.u.move;
    result.events += " k" + std::to_string(m.kind) + (m.curved ? "c" : "") + " F" + brief(m.feed_mm_min) + "/" + brief(m.feed_mm_rev) + " L" + brief(m.length);
  }
  return result;
}

struct Case {
  const char* what;
  const char* text;       ///< the interrupt comes behind the block that has (HERE) in it
  const char* interrupt;  ///< changes the mode without a move
};

const Case kCases[] = {
    {"plane", "G1 G17 X0 F100 (HERE)\nG2 X30. R15.", "G18"},
    {"plane of a wrong radius", "G1 G17 X0 F100 (HERE)\nG2 X30. R5.", "G18"},
    {"length", "G43 H2 Z5. G0 (HERE)\nZ1.", "H5"},
    {"work system", "G54 G0 X1. (HERE)\nX2.", "G55"},
    {"extended work system", "G54.1 P1 G0 X1. (HERE)\nX2.", "G54"},
    {"distance and unit", "G90 G21 G0 X1. (HERE)\nX2.", "G91 G20"},
    {"feed", "G94 G1 X1. F100 (HERE)\nX2.", "G95 F2."},
    {"inverse time", "G93 G1 X1. F10. (HERE)\nX2. F5.", "G94 F9."},
    {"thread", "G33 Z-10. F2. (HERE)\nZ-20.", "G33 F3.\nG1"},
    {"polar command", "G16 G0 X10. Y30. (HERE)\nG91 Y30.", "G15"},
    {"cylinder off", "G19 Z0 C0 G0\nG07.1 C10.\nG1 Z5. F100 (HERE)\nC90.", "G07.1 C0"},
    {"polar interpolation off", "G12.1\nG1 X10. F100 (HERE)\nY5.", "G13.1"},
    {"polar interpolation on", "G0 X10. (HERE)\nX5. C30.", "G12.1"},
    {"mirror", "G51.1 X5. (HERE)\nG0 X10.", "G50.1 X0"},
    {"scaling", "G51 X0 Y0 P2. (HERE)\nG0 X10.", "G50"},
    {"rotation", "G68 X0 Y0 R90. (HERE)\nG0 X10. Y0", "G69"},
    {"rotation on", "G0 X10. (HERE)\nX5. Y5.", "G68 X0 Y0 R90."},
    {"cycle", "G99 G81 X1. Z-1. R1. F100 (HERE)\nX2.", "G80"},
    {"return level", "G0 Z20.\nG99 G81 X1. Z-1. R1. F100 (HERE)\nX2.", "G98"},
    {"hypothetical axis", "G07 X0\nG1 X25. Y5. F100 (HERE)\nX30. Y10.", "G07 X1"},
    {"parameter input", "G10 L70 (HERE)\nP1084 D0.5\nG11\nG17 G1 X0 F100\nG2 X0.4 Y0.4 I0.3", "#100=1"},
    {"high speed", "G05 P2 (HERE)\nG1 X1. F100\nG05 P0", "G05 P0"},
    {"prohibited area", "G22 X50. Y50. Z50. I40. J-10. K-10. (HERE)\nG0 X45.\nG23", "G23"},
};

class KeptState : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Fields, KeptState, testing::ValuesIn(kCases), [](const auto& row) {
  std::string name = row.param.what;
  for (char& c : name)
    if (c == ' ') c = '_';
  return name;
});

TEST_P(KeptState, AnInterruptProgramChangesNothing) {
  const Result plain = run(GetParam().text, nullptr, false);
  for (const bool type_2 : {false, true}) {
    const Result interrupted = run(GetParam().text, GetParam().interrupt, type_2);
    EXPECT_EQ(interrupted.alarm, plain.alarm) << type_2;
    EXPECT_EQ(interrupted.path, plain.path) << type_2;
    EXPECT_EQ(interrupted.events, plain.events) << type_2;
  }
}

// 12.2: G43 and G49 move their axis, and 13.12 gives back the modes behind a move in type 2 alone.
TEST(KeptStateOfTheLength, ComesBackBehindItsMoveInTypeTwo) {
  const char* const text = "G43 H2 Z5. G0 (HERE)\nZ1.";
  const Path plain = run(text, nullptr, false).path;
  EXPECT_EQ(plain, (Path{"rapid 20 0 7 0", "rapid 20 0 3 0"}));
  EXPECT_EQ(run(text, "G49", true).path, plain);
  EXPECT_EQ(run(text, "G43 H5", true).path, plain);
  EXPECT_EQ(run(text, "G49", false).path, (Path{"rapid 20 0 7 0", "rapid 20 0 1 0"}));
  EXPECT_EQ(run(text, "G43 H5", false).path, (Path{"rapid 20 0 7 0", "rapid 20 0 6 0"}));
}

TEST(KeptStateOfTheSpindle, SurfaceSpeedIsAnnouncedAgain) {
  Bench bench;
  bench.add("O1000", "G97\nM99\n");
  bench.start("M96 P1000\nG96 S100 M3 (HERE)\nG0 X1.\nM30");
  Step step;
  double surface = 0;
  bool done = false;
  for (nc_status status; (status = bench.pull(&step)) == NC_OK || status == NC_BUDGET;) {
    if (status != NC_OK) continue;
    const nc_item& item = step.item;
    if (item.kind == NC_ITEM_ACTION && item.u.action.kind == NC_ACTION_CONTROL && item.u.action.index == NC_CONTROL_SURFACE_SPEED)
      surface = item.u.action.value;
    if (item.kind == NC_ITEM_MOVE) break;
    if (done || item.kind != NC_ITEM_MARK || item.source.line != 2) continue;
    done = true;
    bool back = false;
    nc_interrupt_signal(bench.control(), 0, true, &back);
    nc_interrupt_signal(bench.control(), 0, false, &back);
  }
  EXPECT_EQ(surface, 100);
}

/// MDI blocks that are entered one after the other give the same path as a program with all of them.
TEST_P(KeptState, BlocksOfMdiGoOnFromEachOther) {
  const std::string text = GetParam().text;
  if (std::string(GetParam().what) == "parameter input" ||
      text.find("G81") != std::string::npos)
    return;  // these belong to one run: cycles and parameter input end with it
  const Result whole = run(text, nullptr, false);
  const std::unique_ptr<Bench> bench = machine();
  Path path;
  std::string alarm;
  for (size_t at = 0; at < text.size() && alarm.empty();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const std::string block = text.substr(at, end - at);
    ASSERT_EQ(nc_mdi_load(bench->control(), 0, block.data(), block.size()), NC_OK);
    Outcome one = bench->finish();
    one.axis_count = 4;
    for (const std::string& move : one.path()) path.push_back(move);
    alarm = one.alarm;
    at = end + 1;
  }
  EXPECT_EQ(path, whole.path);
  EXPECT_EQ(alarm, whole.alarm);
}

/// M700 13.3.1, 13.5.1: a called program has the modes of its caller, and its changes stay after the return.
TEST_P(KeptState, ACalledProgramChangesTheModesOfItsCaller) {
  if (std::string(GetParam().what) == "parameter input") return;  // there is no call between G10 L70 and G11
  const std::string text = GetParam().text;
  const size_t end = text.find('\n', text.find("(HERE)"));
  const auto with = [&](const std::string& between) { return run(text.substr(0, end) + "\n" + between + text.substr(end), nullptr, false); };
  const Result in_line = with(GetParam().interrupt);
  for (const char* call : {"M98 P2000", "G65 P2000"}) {
    called = std::string(GetParam().interrupt) + "\nM99\n";
    const Result result = with(call);
    called.clear();
    EXPECT_EQ(result.alarm, in_line.alarm) << call;
    EXPECT_EQ(result.path, in_line.path) << call;
    EXPECT_EQ(result.events, in_line.events) << call;
  }
}

/// The run of a program whose moves show the modes that it finds.
Outcome found_by_the_next(Bench& bench) {
  Outcome next = bench.run("G0 X1. Y2. Z3.\nG1 X5. F100\nG2 X7. Y4. R10.\nG1 X8.\nG0 Z1.\nX2.\nM30");
  next.axis_count = 4;
  return next;
}

void expect_same_start(Outcome& next, Outcome& first) {
  EXPECT_EQ(first.alarm, "");
  EXPECT_EQ(next.alarm, "");
  EXPECT_EQ(next.path(), first.path());
  const nc_modal a = next.last_modal(), b = first.last_modal();
  EXPECT_EQ(std::memcmp(a.code, b.code, sizeof a.code), 0);
  EXPECT_EQ(a.feed, b.feed);
  EXPECT_EQ(a.d, b.d);
  EXPECT_EQ(a.h, b.h);
  EXPECT_EQ(a.tool, b.tool);
}

/// M700 3.7, 9.1: after M30, and after a reset in the middle, a program begins as after power on.
TEST_P(KeptState, AnEndAndAResetLeaveTheModesOfPowerOn) {
  const std::string text = GetParam().text;
  const std::string part = text.substr(0, text.find('\n', text.find("(HERE)"))) + "\n";
  for (const char* close : {"M30", "M2", "reset"}) {
    const std::unique_ptr<Bench> bench = machine();
    const bool reset = std::string(close) == "reset";
    nc_axes at{};
    if (part.find("G10 L70") != std::string::npos && !reset) continue;  // M30 would be a parameter
    if (reset) {
      bench->start(part + "G4 X1.\nM30");
      Step step;
      for (bool dwell = false; !dwell && bench->pull(&step) == NC_OK;) dwell = step.item.kind == NC_ITEM_GATE;
      at = step.machine;
      ASSERT_EQ(nc_reset(bench->control(), 0), NC_OK);
    } else {
      const Outcome ended = bench->run(part + close);
      EXPECT_EQ(ended.alarm, "");
      at = ended.steps.back().machine;
    }
    Outcome next = found_by_the_next(*bench);
    const std::unique_ptr<Bench> fresh = machine();
    fresh->at(at.v[0], at.v[1], at.v[2], at.v[3]);
    Outcome first = found_by_the_next(*fresh);
    SCOPED_TRACE(close);
    expect_same_start(next, first);
  }
}

TEST(KeptStateOfTheClocks, AnotherStartDoesNotSetThemBack) {  // M700 13.5.5: the program's own date and counters
  Bench bench;
  EXPECT_EQ(bench.run("#3011=20300102\n#3012=030405\nM30").alarm, "");
  const Outcome later = bench.run("#100=#3011\n#101=#3012\nM30");
  EXPECT_EQ(later.var(100), 20300102);
  EXPECT_EQ(later.var(101), 30405);
  bench.run("G4 X1.\n#3001=50000\nM30");
  EXPECT_GE(bench.run("#102=#3001\nM30").var(102), 49000);
}

}  // namespace
}  // namespace nc::test
