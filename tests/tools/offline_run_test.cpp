// SPDX-License-Identifier: Apache-2.0
// From items to events: the order and the selection that docs/trace.md promises, on prepared items.
#include "tools/lib/offline_run.hpp"

#include <gtest/gtest.h>

#include "fake_items.hpp"

namespace nc::tools {
namespace {

/** Writes down what it is told, one word each. */
class Notes final : public RunSink {
 public:
  std::string text;
  bool enough = false;
  void move(const nc_source& s, const nc_move& m) override {
    add(s, "move" + std::to_string(static_cast<int>(m.machine.v[0])));
  }
  void block(const nc_source& s, const nc_axes&, const nc_axes& machine) override {
    add(s, "block@" + std::to_string(static_cast<int>(machine.v[0])));
  }
  void aux(const nc_source& s, char code, double value) override {
    add(s, code + std::to_string(static_cast<int>(value)));
  }
  void dwell(const nc_source& s, bool turns, double value) override {
    add(s, (turns ? "turns" : "dwell") + std::to_string(static_cast<int>(value)));
  }
  void sync(const nc_source& s, uint32_t what) override { add(s, "sync" + std::to_string(what)); }
  void message(const nc_source& s, uint32_t port, const nc_text& t) override {
    add(s, t.s + std::to_string(port));
  }
  void alarm(const nc_alarm& a) override { add(a.source, a.code); }
  void end(const nc_source& s, bool ok, const nc_axes&, const nc_axes& machine, uint32_t) override {
    add(s, (ok ? "ok@" : "bad@") + std::to_string(static_cast<int>(machine.v[0])));
  }
  bool stop() const override { return enough; }

 private:
  void add(const nc_source& s, const std::string& what) {
    text += (text.empty() ? "" : " ") + std::to_string(s.line) + (s.depth ? "'" : "") + ":" + what;
  }
};

struct Scene {
  FakeItems items;
  Notes notes;
  RunResult result;
  void go(const std::string& setup_text = "{}", uint32_t calling_line = 0) {
    items.calling_line = calling_line;
    tools::Setup setup;
    std::string error;
    ASSERT_TRUE(parse_setup(setup_text, "s.json", &setup, &error)) << error;
    VirtualWorld world(setup, xyz());
    result = run_offline(&items, &world, &notes, {}, 0);
  }
  nc_action& action(uint32_t line, nc_action_kind kind, double value) {
    nc_item& item = items.add(NC_ITEM_ACTION, line);
    item.u.action.kind = static_cast<uint8_t>(kind);
    item.u.action.value = value;
    return item.u.action;
  }
  void gate(uint32_t line, nc_gate_kind kind, double value, bool announce) {
    nc_item& item = items.add(NC_ITEM_GATE, line);
    item.u.gate.kind = static_cast<uint8_t>(kind);
    item.u.gate.value = value;
    item.u.gate.announce = announce;
  }
};

TEST(OfflineRun, EventsInOrder) {
  Scene run;
  run.items.line(1, {}, {{5, 0, 0}}, 0, NC_MOVE_RAPID);
  run.items.mark(1, {{5, 0, 0}});
  run.action(2, NC_ACTION_S, 100);
  run.action(2, NC_ACTION_T, 7);
  run.action(2, NC_ACTION_B, 3).letter = 'A';
  run.action(2, NC_ACTION_M, 8);
  run.gate(2, NC_GATE_FIN, 0, false);
  run.action(2, NC_ACTION_OUTPUT, 1);
  run.action(2, NC_ACTION_MESSAGE, 0).index = 3;
  run.items.text_value = "hello";
  run.items.mark(2, {{5, 0, 0}});
  run.gate(3, NC_GATE_DWELL_SECONDS, 2, true);
  run.gate(3, NC_GATE_DWELL_TURNS, 4, true);
  run.gate(3, NC_GATE_DWELL_SECONDS, 9, false);
  run.items.mark(3, {{5, 0, 0}});
  run.items.add(NC_ITEM_SYNC, 4).u.sync.what = NC_SYNC_INPUT;
  run.items.add(NC_ITEM_MARK, 4).u.mark.report = false;
  run.items.mark(4, {{5, 0, 0}});
  run.items.end(5, {{5, 0, 0}});
  run.go();
  EXPECT_EQ(run.notes.text,
            "1:move5 1:block@5 2:S100 2:T7 2:A3 2:M8 2:hello3 2:block@5 3:dwell2 3:turns4 3:block@5 4:sync2 "
            "4:block@5 5:ok@5");
  EXPECT_EQ(run.result.how, RunResult::How::kEnded);
  EXPECT_EQ(run.result.blocks, 4u);
  EXPECT_EQ(run.result.moves, 1u);
  EXPECT_DOUBLE_EQ(run.result.length, 5.0);
  EXPECT_DOUBLE_EQ(run.result.seconds, 0.03 + 2 + 4 / 100.0 * 60 + 9);
}

TEST(OfflineRun, ASkipSignalEndsADwell) {  // M700 15.3 (2): the event says how long it has lasted
  for (const uint8_t mask : {uint8_t{1}, uint8_t{2}}) {
    Scene run;
    run.gate(1, NC_GATE_DWELL_SECONDS, 5, true);
    run.items.items.back().u.gate.skip_mask = mask;
    run.items.end(2, {});
    run.go(R"({"skip": [{"signal": 1, "box": {"X": [-1, 1]}}]})");
    EXPECT_EQ(run.notes.text, mask == 1 ? "1:dwell0 2:ok@0" : "1:dwell5 2:ok@0");
    EXPECT_DOUBLE_EQ(run.result.seconds, mask == 1 ? 0 : 5);
  }
}

TEST(OfflineRun, OptionalStopIsAnEventOnlyWithItsSwitch) {
  for (const bool on : {false, true}) {
    Scene run;
    run.gate(1, NC_GATE_OPTIONAL_STOP, 0, false);
    run.items.end(2, {});
    run.go(on ? R"({"switches": {"optional_stop": true}})" : "{}");
    EXPECT_EQ(run.notes.text, on ? "1:M1 2:ok@0" : "2:ok@0");
  }
}

TEST(OfflineRun, ASkippedMoveEndsAtTheSurfaceAndItsBlockToo) {
  Scene run;
  run.items.line(1, {}, {{90, 0, 0}}, 100, NC_MOVE_SKIP).u.move.skip_mask = 1;
  run.items.add(NC_ITEM_SYNC, 1).u.sync.what = NC_SYNC_SKIP;
  run.items.mark(1, {{40, 0, 0}});
  run.items.end(2, {{40, 0, 0}});
  run.go(R"({"skip": [{"box": {"X": [40, 50]}}]})");
  EXPECT_EQ(run.notes.text, "1:move40 1:sync8 1:block@40 2:ok@40");
  ASSERT_EQ(run.items.answers.size(), 1u);
  EXPECT_TRUE(run.items.answers[0].skipped);
  EXPECT_EQ(run.items.answers[0].machine.v[0], 40);
}

TEST(OfflineRun, ASkipMoveThatCannotStartIsNoEvent) {
  Scene run;
  run.items.line(1, {}, {{90, 0, 0}}, 100, NC_MOVE_SKIP).u.move.skip_mask = 1;
  run.items.add(NC_ITEM_SYNC, 1).u.sync.what = NC_SYNC_SKIP;
  run.items.mark(1, {});
  run.items.end(2, {});
  run.go(R"({"skip": [{"box": {"X": [-1, 50]}}]})");
  EXPECT_EQ(run.notes.text, "1:sync8 1:block@0 2:ok@0");
  EXPECT_EQ(run.result.moves, 0u);
}

TEST(OfflineRun, AlarmThenEnd) {
  Scene run;
  run.items.mark(1, {});
  run.items.has_alarm = true;
  std::snprintf(run.items.alarm_value.code, 16, "P62");
  run.items.alarm_value.source = {2, 0, 1, 0, 0};
  run.items.add(NC_ITEM_ALARM, 2);
  run.items.end(2, {}, false);
  run.go();
  EXPECT_EQ(run.notes.text, "1:block@0 2:P62 2:bad@0");
  EXPECT_EQ(run.result.how, RunResult::How::kAlarmed);
  EXPECT_STREQ(run.result.alarm.code, "P62");
}

TEST(OfflineRun, EventOfACallLineComesBeforeItsSubProgramReads) {
  Scene run;
  run.items.mark(1, {});
  run.items.add(NC_ITEM_SYNC, 1, 1).u.sync.what = NC_SYNC_INPUT;
  run.items.mark(1, {}, 1);
  run.items.mark(4, {});
  run.items.end(5, {});
  run.go(R"({"events": [{"when": {"line": 4}, "inputs": {"1000": 1}}]})", 4);
  ASSERT_EQ(run.items.answers.size(), 1u);
  EXPECT_EQ(run.items.answers[0].input[0], 1u);
}

TEST(OfflineRun, ResetEventEndsWithoutAlarm) {
  Scene run;
  run.items.line(1, {}, {{5, 0, 0}}, 100);
  run.items.mark(1, {{5, 0, 0}});
  run.items.line(2, {{5, 0, 0}}, {{9, 0, 0}}, 100);
  run.items.end(3, {});
  run.go(R"({"events": [{"when": {"line": 2}, "signals": {"reset": 1}}]})");
  EXPECT_EQ(run.notes.text, "1:move5 1:block@5 2:ok@5");
  EXPECT_TRUE(run.items.was_reset);
  EXPECT_EQ(run.result.how, RunResult::How::kReset);
}

TEST(OfflineRun, StopsWhenTheSinkHasEnough) {
  Scene run;
  run.notes.enough = true;
  run.items.mark(1, {});
  run.items.mark(2, {});
  run.items.end(3, {});
  run.go();
  EXPECT_EQ(run.notes.text, "1:block@0");
  EXPECT_EQ(run.result.how, RunResult::How::kStopped);
}

/** Only ever spends its budget, as an endless GOTO does. */
class Endless final : public ItemSource {
 public:
  nc_status pull(uint32_t, nc_item*) override { return NC_BUDGET; }
  nc_status answer(const nc_world&) override { return NC_OK; }
  nc_status reset() override { return NC_OK; }
  bool alarm(nc_alarm*) override { return false; }
  bool text(uint32_t, nc_text*) override { return false; }
  unsigned modal_codes(uint32_t, char (*)[8], unsigned) override { return 0; }
  bool next_common(uint32_t, uint32_t*, double*) override { return false; }
};

TEST(OfflineRun, AnEndlessLoopIsAnError) {
  Endless items;
  tools::Setup setup;
  VirtualWorld world(setup, xyz());
  RunSink sink;
  const RunResult result = run_offline(&items, &world, &sink, {}, 100'000);
  EXPECT_EQ(result.how, RunResult::How::kEndless);
  EXPECT_NE(result.error.find("endless loop"), std::string::npos);
}

/** Gives marks without end, as a loop that only calculates; every `clock_every` blocks it reads the clock. */
class Calculating final : public ItemSource {
 public:
  explicit Calculating(int clock_every, int end_at) : clock_every_(clock_every), end_at_(end_at) {}
  nc_status pull(uint32_t, nc_item* item) override {
    *item = {};
    item->serial = static_cast<uint64_t>(count_) + 1;
    item->source = {7, 0, 1, 0, 0};
    if (count_ == end_at_) {  // one payload of the union for each kind
      item->kind = NC_ITEM_END;
      item->u.end = {true, {}, 0};
    } else if (clock_every_ && count_ % clock_every_ == 0) {
      item->kind = NC_ITEM_SYNC;
      item->u.sync = {NC_SYNC_CLOCK};
    } else {
      item->kind = NC_ITEM_MARK;
      item->u.mark = {{}, 0, true, true, false};
    }
    if (count_++ > end_at_) return NC_ENDED;
    return NC_OK;
  }
  nc_status answer(const nc_world&) override { return NC_OK; }
  nc_status reset() override { return NC_OK; }
  bool alarm(nc_alarm*) override { return false; }
  bool text(uint32_t, nc_text*) override { return false; }
  unsigned modal_codes(uint32_t, char (*)[8], unsigned) override { return 0; }
  bool next_common(uint32_t, uint32_t*, double*) override { return false; }

 private:
  int clock_every_, end_at_, count_ = 0;
};

TEST(OfflineRun, CalculationWithoutEndIsAnErrorButWaitingForTheClockIsNot) {
  tools::Setup setup;
  RunSink sink;
  VirtualWorld one(setup, xyz()), two(setup, xyz());
  Calculating loop(0, 1 << 30), wait(10, 50'000);
  const RunResult endless = run_offline(&loop, &one, &sink, {}, 10'000);
  EXPECT_EQ(endless.how, RunResult::How::kEndless);
  EXPECT_NE(endless.error.find("line 7: 10000 blocks"), std::string::npos) << endless.error;
  EXPECT_EQ(run_offline(&wait, &two, &sink, {}, 10'000).how, RunResult::How::kEnded);
}

TEST(OfflineRun, ALongRunIsToldWithEachDoubling) {
  tools::Setup setup;
  RunSink sink;
  VirtualWorld world(setup, xyz());
  Calculating blocks(0, 5'000);
  std::string told;
  RunProgress progress;
  EXPECT_EQ(progress.first, 10'000'000u);
  progress.first = 1'000;
  progress.tell = [&](const nc_source& source, uint64_t count) { told += std::to_string(source.line) + "@" + std::to_string(count) + " "; };
  EXPECT_EQ(run_offline(&blocks, &world, &sink, {}, 0, false, progress).how, RunResult::How::kEnded);
  EXPECT_EQ(told, "7@1000 7@2000 7@4000 ");
}

TEST(HasDecision, OutsideOfCommentsAndInAnyCase) {
  EXPECT_TRUE(has_decision("G1\nif[#1EQ2]GOTO 3\nM30"));
  EXPECT_TRUE(has_decision("(a\nWHILE[1]DO1"));  // a comment ends with its line
  EXPECT_FALSE(has_decision("G1 (IF)\n(WHILE\nM30"));
  EXPECT_FALSE(has_decision(""));
}

}  // namespace
}  // namespace nc::tools
