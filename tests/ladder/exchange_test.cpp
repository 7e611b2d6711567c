// SPDX-License-Identifier: Apache-2.0
// A program takes the place of another one between two scans: devices, timers and counters go on by name, edges of instructions that both have go on, and nothing happens because
// of the exchange.
#include "ladder/exchange.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <tuple>

#include "ladder/rig.hpp"

namespace nc::ladder {
namespace {

// A program with its image, which another one may take the place of.
class Running {
 public:
  explicit Running(const std::string& text) : rig_(std::make_unique<Rig>(text)) {}
  Rig* operator->() { return rig_.get(); }
  // "" = done, else why not.
  std::string take(const std::string& text) {
    auto next = std::make_unique<Rig>(text);
    std::string reason;
    if (!exchange_.prepare(rig_->program(), next->program(), &reason)) return reason;
    exchange_.carry(rig_->image, &next->image);
    rig_ = std::move(next);
    return "";
  }
  const Exchange& exchange() const { return exchange_; }

 private:
  std::unique_ptr<Rig> rig_;
  Exchange exchange_;
};

TEST(LadderExchange, DevicesTimersAndCountersGoOnByTheirNames) {
  Running running("LD X0\nOUT T1 K5\nLD X1\nOUT C2 K9\nLD SM400\nMOV K7 D100\nSET M5\nSET L3\nDMOV K100000 out32\nEND\n");
  running->set("X0", 1);
  running->scan(150);
  for (unsigned n = 0; n < 6; ++n) running->set("X1", n % 2), running->scan();
  ASSERT_EQ(running->get("TN1"), 1);
  ASSERT_EQ(running->get("CN2"), 3);
  ASSERT_EQ(running.take("; other lines, and each in another place\nLD X1\nOUT C2 K9\nLD X0\nANI X5\nOUT T1 K2\nLD SM402\nSET M77\nLD SM400\nDMOV K5 out32\nEND\n"), "");
  EXPECT_EQ(running->get("D100"), 7);
  EXPECT_EQ(running->get("M5"), 1);
  EXPECT_EQ(running->get("L3"), 1);
  EXPECT_EQ(running->get("TN1"), 1);
  EXPECT_EQ(running->get("CN2"), 3);
  EXPECT_EQ(running->get("out32"), 100000);
  running->scan();
  EXPECT_EQ(running->get("M77"), 0) << "it goes on: this is not its first scan";
  EXPECT_EQ(running->get("CN2"), 3);
  running->scan(50);
  EXPECT_EQ(running->get("T1"), 1) << "the time that had passed before counts, and the new set value";
}

TEST(LadderExchange, ATimerOfAnotherUnitIsRefused) {
  Running running("LD X0\nOUT T1 K5\nLD X0\nOUTH ST3 K5\nLD X0\nOUTHS T7 K5\nEND\n");
  EXPECT_EQ(running.take("LD X0\nOUT T1 K5\nEND\n"), "");
  Running other("LD X0\nOUT T1 K5\nLD X0\nOUTH ST3 K5\nEND\n");
  EXPECT_EQ(other.take("END\n"), "") << "a timer that is used no more may count what it likes";
  Running third("LD X0\nOUT T1 K5\nLD X0\nOUTH ST3 K5\nEND\n");
  EXPECT_EQ(third.take("LD X0\nOUT T1 K5\nLD X0\n\nOUT ST3 K5\nEND\n"),
            "ST3 counts 100 ms in line 5 and 10 ms in line 4 of the program that runs: its value would be another time. Take another timer");
  EXPECT_NE(third.take("LD X0\nOUTHS T1 K5\nEND\n"), "");
  EXPECT_EQ(third.take("LD X0\nOUT T2 K5\nEND\n"), "");
}

TEST(LadderExchange, APeriodOrATableOfAnotherMachineIsRefused) {
  Program one, other;
  DeviceTable more = test_table();
  more.add("one_more", DeviceType::kBit, false);
  CompileOptions slow;
  slow.scan_s = 0.002;
  std::string reason;
  Exchange exchange;
  ASSERT_TRUE(compile("END\n", "a.il", test_table(), {}, &one, nullptr));
  ASSERT_TRUE(compile("END\n", "b.il", more, {}, &other, nullptr));
  EXPECT_FALSE(exchange.prepare(one, other, &reason));
  ASSERT_TRUE(compile("END\n", "b.il", test_table(), slow, &other, nullptr));
  EXPECT_FALSE(exchange.prepare(one, other, &reason));
}

// Each of these rungs counts edges of its condition. What it has seen goes on when it has not changed, and one that has changed reports no edge in its first scan.
TEST(LadderExchange, AnEdgeIsNotReportedBecauseOfTheExchange) {
  const char* const kinds[] = {"LDP X0\nINC D1\n", "LD X0\nINCP D1\n", "LD X0\nPLS M1\nLD M1\nINC D1\n", "LD X0\nMEP\nINC D1\n", "LD X0\nOUT C1 K100\nLD SM400\nMOV C1 D1\n",
                               "LD X0\nFF M9\nLD M9\nMOV K1 D1\n", "LD X1\nORP X0\nINC D1\n", "LD SM400\nANDP X0\nINC D1\n"};
  for (const std::string kind : kinds) {
    for (const bool on : {false, true}) {
      // The condition is on already when the new program with such a rung comes.
      Running fresh("LD SM400\nOUT M20\nEND\n");
      fresh->set("X0", on);
      fresh->scan(3);
      ASSERT_EQ(fresh.take(kind + "END\n"), "");
      fresh->scan(3);
      EXPECT_EQ(fresh->get("D1"), 0) << kind;
      fresh->set("X0", 0), fresh->scan(), fresh->set("X0", 1), fresh->scan();
      EXPECT_EQ(fresh->get("D1"), 1) << kind << "then it counts";
    }
    // The same rung in another place: an edge in the very scan of the exchange is not lost, and none is seen twice.
    for (const bool before : {false, true})
      for (const bool after : {false, true}) {
        Running same(kind + "END\n");
        same->set("X0", before);
        same->scan(2);
        ASSERT_EQ(same->get("D1"), 0);
        ASSERT_EQ(same.take("LD X3\nOR X4\nPLS M30\n" + kind + "LDP X5\nINC D2\nEND\n"), "");
        same->set("X0", after);
        same->scan(2);
        EXPECT_EQ(same->get("D1"), !before && after) << kind;
      }
    // Another condition in front of it.
    Running changed("LD X2\nOUT M3\n" + kind + "END\n");
    changed->set("X0", 0);
    changed->scan(2);
    std::string with = kind;
    with.replace(with.find("X0"), 2, "X4");
    changed->set("X4", 1);
    ASSERT_EQ(changed.take(with + "END\n"), "");
    changed->scan(2);
    EXPECT_EQ(changed->get("D1"), 0) << with;
  }
}

TEST(LadderExchange, AnotherNameOfADeviceIsTheSameInstructionAndAnotherDeviceIsNot) {
  Running running("ALIAS start X0\nALIAS w D5\nLDP start\nINC D1\nLD w.3\nINCP D2\nEND\n");
  running->scan(2);
  ASSERT_EQ(running.take("ALIAS begin X0\nLDP begin\nINC D1\nLD D5.3\nINCP D2\nEND\n"), "");
  running->set("X0", 1), running->set("D5", 8);
  running->scan(2);
  EXPECT_EQ(running->get("D1"), 1) << "the same device by another name";
  EXPECT_EQ(running->get("D2"), 1);
  running->set("X0", 0), running->scan(2);
  running->set("X1", 1);
  ASSERT_EQ(running.take("ALIAS begin X1\nLDP begin\nINC D1\nEND\n"), "");
  running->scan(2);
  EXPECT_EQ(running->get("D1"), 1) << "the same name of another device, which was on before";
}

// What a jump passes over has seen its condition long ago. Only where the whole flow is the same does it go on.
TEST(LadderExchange, WhatAJumpPassedOverReportsNoEdge) {
  const std::string passed = "LD X1\nCJ P1\nLDP X0\nINC D1\nP1\n";
  for (const bool same : {false, true}) {
    Running running(passed + "END\n");
    running->scan(2);
    running->set("X1", 1), running->scan(2);
    running->set("X0", 1), running->scan(2);  // nobody has seen it
    ASSERT_EQ(running.take(same ? "LD X5\nOUT M1\n" + passed + "END\n" : "LDP X0\nINC D1\nEND\n"), "");
    running->set("X1", 0);
    running->scan(2);
    EXPECT_EQ(running->get("D1"), same) << "as it would have been without the exchange";
  }
}

TEST(LadderExchange, ARungBelongsToItsMasterControl) {
  Running running("LD X1\nMC N0 M0\nLD X0\nINCP D1\nMCR N0\nEND\n");
  running->set("X0", 1);
  running->scan(2);  // the master control is off, so it has seen 0
  ASSERT_EQ(running.take("LD X0\nINCP D1\nEND\n"), "");
  running->scan(2);
  EXPECT_EQ(running->get("D1"), 0);
  Running other("LD X1\nMC N0 M0\nLD X0\nINCP D1\nMCR N0\nEND\n");
  other->set("X0", 1);
  other->scan(2);
  ASSERT_EQ(other.take("LD X2\nOUT M7\nLD X1\nMC N0 M0\nLD X0\nINCP D1\nMCR N0\nEND\n"), "");
  other->set("X1", 1), other->scan(2);
  EXPECT_EQ(other->get("D1"), 1);
}

TEST(LadderExchange, SaysWhichOutputsNobodyWritesAnyMore) {
  Running running("LD X0\nOUT Y1\nLD X0\nSET Y2\nLD SM400\nMOV K1 out16\nLD X1\nOUT out32.3\nLD X1\nMC N0 Y4\nMCR N0\nLD X0\nPLS Y5\nEND\n");
  ASSERT_EQ(running.take("LD X1\nOUT Y1\nLD SM400\nINC out16\nEND\n"), "");
  std::vector<std::string> names;
  for (const Device& device : running.exchange().left()) names.push_back(device.name);
  EXPECT_EQ(names, (std::vector<std::string>{"Y2", "Y4", "Y5", "out32"}));
}

// ---- random programs ----

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  unsigned below(unsigned count) { return static_cast<unsigned>(engine_() % count); }
  std::string input() { return (below(3) != 0 ? "X" : "M") + std::to_string(below(6)); }
  std::string condition() {
    static const char* const kFirst[] = {"LD ", "LDI ", "LDP ", "LDF "};
    static const char* const kMore[] = {"AND ", "ANI ", "OR ", "ORI ", "ANDP ", "ORF ", "ANDF "};
    std::string text = kFirst[below(4)] + input() + "\n";
    for (unsigned n = below(3); n > 0; --n) text += kMore[below(7)] + input() + "\n";
    if (below(6) == 0) text += "LD " + input() + "\nMEP\nORB\n";
    if (below(8) == 0) text += below(2) == 0 ? "MEP\n" : "MEF\n";
    return text;
  }
  // One rung whose results are devices with numbers from `base` on.
  std::string rung(unsigned base) {
    const std::string m = "M" + std::to_string(base + below(8)), d = "D" + std::to_string(base + below(8));
    const unsigned n = base % 400 + below(4);
    switch (below(12)) {
      case 0: return condition() + "OUT " + m + "\n";
      case 1: return condition() + "SET " + m + "\nLD " + input() + "\nRST " + m + "\n";
      case 2: return condition() + "PLS " + m + "\n";
      case 3: return condition() + "PLF " + m + "\n";
      case 4: return condition() + "INCP " + d + "\n";
      case 5: return condition() + "DINCP D" + std::to_string(base + 30) + "\n";
      case 6: return condition() + "FF " + m + "\n";
      case 7: return condition() + (n % 2 == 0 ? "OUTHS T" : "OUTH T") + std::to_string(n) + " K" + std::to_string(1 + below(4)) + "\nLDP T" + std::to_string(n) + "\nINC " + d + "\n";
      case 8: return condition() + "OUT C" + std::to_string(n) + " K" + std::to_string(1 + below(4)) + "\nLD C" + std::to_string(n) + "\nAND X5\nRST C" + std::to_string(n) + "\n";
      case 9: return condition() + "MPS\nAND " + input() + "\nPLS " + m + "\nMPP\nINCP " + d + "\n";
      case 10: return condition() + "OUT " + d + "." + std::to_string(below(8)) + "\n";
      default: return condition() + "INC " + d + "\n";
    }
  }

 private:
  std::mt19937 engine_;
};

// Rungs, some in a master control, behind a jump, in a loop, in a subroutine. `foreign`, when it is there, adds rungs with devices of their own in any place.
std::string program_of(unsigned seed, std::optional<unsigned> foreign) {
  Random random(seed), other(foreign.value_or(0));
  std::string text, subroutines;
  const auto rungs = [&](unsigned count) {
    std::string some;
    for (unsigned n = 0; n < count; ++n) {
      if (foreign && other.below(3) == 0) some += other.rung(200);
      some += random.rung(0);
    }
    return some;
  };
  for (unsigned part = 0; part < 6; ++part) {
    const std::string label = "P" + std::to_string(part);
    switch (random.below(6)) {
      case 0: text += "LD " + random.input() + "\nMC N0 M" + std::to_string(40 + part) + "\n" + rungs(2) + "MCR N0\n"; break;
      case 1: text += "LD " + random.input() + "\nCJ " + label + "\n" + rungs(2) + label + "\n"; break;
      case 2: text += "FOR K2\n" + rungs(1) + "NEXT\n"; break;
      case 3:
        text += "LD " + random.input() + "\nCALL " + label + "\n";
        subroutines += label + "\n" + rungs(2) + "RET\n";
        break;
      default: text += rungs(2); break;
    }
  }
  return text + "FEND\n" + subroutines + "END\n";
}

void set_inputs(Random* random, Running* a, Running* b) {
  for (unsigned x = 0; x < 6; ++x) {
    const int on = random->below(2) == 0;
    (*a)->set("X" + std::to_string(x), on);
    (*b)->set("X" + std::to_string(x), on);
  }
}

// The oracle is the program that was not exchanged: with the same program under it, and with one that has rungs for devices of their own beside it, nothing of what it does may change.
TEST(LadderExchange, RandomProgramsGoOnAsIfNothingHadHappened) {
  unsigned edges = 0;
  for (unsigned seed = 1; seed <= 120; ++seed) {
    const std::string text = program_of(seed, std::nullopt);
    Running plain(text), exchanged(text);
    Random inputs(seed + 7000);
    for (unsigned scan = 0; scan < 60; ++scan) {
      set_inputs(&inputs, &plain, &exchanged);
      // With rungs of its own between them an instruction that may be passed over is known by its place in the flow, which these rungs do not change.
      if (inputs.below(3) == 0) {
        const std::string next = inputs.below(2) == 0 ? text : program_of(seed, seed + inputs.below(1000));
        ASSERT_EQ(exchanged.take(next), "");
      }
      plain->scan();
      exchanged->scan();
      if (testing::Test::HasFatalFailure()) return;
      for (const char* const family : {"M", "D"})
        for (unsigned n = 0; n < 50; ++n) {
          const std::string name = family + std::to_string(n);
          ASSERT_EQ(exchanged->get(name), plain->get(name)) << "seed " << seed << ", scan " << scan << ", " << name << "\n" << text;
        }
      for (unsigned n = 0; n < 12; ++n)
        for (const char* const family : {"TN", "T", "CN", "C"}) ASSERT_EQ(exchanged->get(family + std::to_string(n)), plain->get(family + std::to_string(n))) << "seed " << seed;
    }
    edges += static_cast<unsigned>(plain->program().code()->memories.size());
  }
  EXPECT_GT(edges, 1000u);
}

// Pairs of programs that share some rungs. The oracle knows the meaning of these rungs and one rule: a rung that both have, equally often, goes on; another one has seen in its first scan
// what it sees there, and reports no edge.
TEST(LadderExchange, RandomPairsCountTheEdgesThatThereAre) {
  struct Rung {
    unsigned kind, x, y;
    bool operator<(const Rung& o) const { return std::tie(kind, x, y) < std::tie(o.kind, o.x, o.y); }
    unsigned number() const { return kind * 36 + x * 6 + y; }
    std::string text() const {
      const std::string a = "X" + std::to_string(x), b = "X" + std::to_string(y), d = "D" + std::to_string(number());
      switch (kind) {
        case 0: return "LD " + b + "\nANDP " + a + "\nINC " + d + "\n";
        case 1: return "LD " + a + "\nAND " + b + "\nINCP " + d + "\n";
        case 2: return "LD " + a + "\nORI " + b + "\nMEF\nINC " + d + "\n";
        default: return "LD " + a + "\nANI " + b + "\nOUT C" + std::to_string(number()) + " K32767\nLD SM400\nMOV C" + std::to_string(number()) + " " + d + "\n";
      }
    }
    // Whether it counts, and what it has seen then. -1 = nothing yet.
    bool counts(int* seen, const bool* in) const {
      const bool now = kind == 0 ? in[x] : kind == 1 ? in[x] && in[y] : kind == 2 ? in[x] || !in[y] : in[x] && !in[y];
      const int before = *seen;
      *seen = now;
      if (kind == 2) return before == 1 && !now;
      return before == 0 && now && (kind != 0 || in[y]);
    }
  };
  for (unsigned seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    const auto make = [&] {
      std::vector<Rung> rungs;
      for (unsigned n = 3 + random.below(10); n > 0; --n) rungs.push_back({random.below(4), random.below(3), random.below(3)});
      // Two coils of one counter are one memory, which is another case.
      std::vector<Rung> some;
      for (const Rung& rung : rungs)
        if (rung.kind != 3 || std::none_of(some.begin(), some.end(), [&](const Rung& o) { return !(o < rung) && !(rung < o); })) some.push_back(rung);
      return some;
    };
    const auto text_of = [](const std::vector<Rung>& rungs) {
      std::string text;
      for (const Rung& rung : rungs) text += rung.text();
      return text + "END\n";
    };
    std::vector<Rung> rungs = make();
    std::map<Rung, std::vector<int>> seen;
    for (const Rung& rung : rungs) seen[rung].push_back(-1);
    std::map<unsigned, int> counted;
    Running running(text_of(rungs));
    for (unsigned scan = 0; scan < 60; ++scan) {
      bool in[3];
      for (unsigned x = 0; x < 3; ++x) {
        in[x] = random.below(2) == 0;
        running->set("X" + std::to_string(x), in[x]);
      }
      if (random.below(4) == 0) {
        std::vector<Rung> next = make();
        for (const Rung& rung : rungs)
          if (random.below(2) == 0 && rung.kind != 3) next.push_back(rung);
        std::shuffle(next.begin(), next.end(), std::mt19937(seed + scan));
        ASSERT_EQ(running.take(text_of(next)), "");
        std::map<Rung, std::vector<int>> now;
        for (const Rung& rung : next) now[rung].push_back(-1);
        for (auto& [rung, memories] : now)
          if (seen.count(rung) != 0 && seen[rung].size() == memories.size()) memories = seen[rung];
        seen = std::move(now);
        rungs = std::move(next);
      }
      running->scan();
      std::map<Rung, unsigned> place;
      for (const Rung& rung : rungs) counted[rung.number()] += rung.counts(&seen[rung][place[rung]++], in);
      for (const auto& [number, count] : counted) ASSERT_EQ(running->get("D" + std::to_string(number)), count) << "seed " << seed << ", scan " << scan << "\n" << text_of(rungs);
    }
  }
}

}  // namespace
}  // namespace nc::ladder
