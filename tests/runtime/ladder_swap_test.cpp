// SPDX-License-Identifier: Apache-2.0
// A ladder program takes the place of another one between two scans of a machine that works.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <sstream>

#include "ladder_machine.hpp"

namespace nc::test {
namespace {

using rt::Answer;
using rt::CommandKind;
using std::chrono::milliseconds;

std::string text_of_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::string all_text(const std::vector<ladder::Error>& errors) {
  std::string text;
  for (const ladder::Error& error : errors) text += error.text() + "\n";
  return text;
}

// "" = the program runs from the next scan on, else why not.
std::string swap(rt::Runtime& runtime, const std::string& text, std::vector<std::string>* set_back = nullptr) {
  std::vector<ladder::Error> errors;
  auto next = runtime.ladder()->prepare_swap(text, "next.il", &errors);
  if (next == nullptr) return all_text(errors);
  if (set_back != nullptr) *set_back = next->set_back();
  return runtime.ladder()->swap(std::move(next), milliseconds(60000), [&] { runtime.step(); }) ? "" : "no scan";
}

class SwappedMill : public LadderMachine {};

// The oracle is the same machine with the same program that is left alone. In every scan of the other one another program comes: with rungs more, with other names, in another order of lines.
TEST_F(SwappedMill, APartIsMadeAsIfNothingHadHappenedWithASwapInEveryScan) {
  const std::string mill = text_of_file(kSourceDir + "/etc/mill.il");
  const std::string rungs = "LDP SM413\nINC D600\nLD M500\nFF M501\nLD M501\nOUT T100 K3\nLD M501\nOUT C100 K5\nLD C100\nRST C100\n";
  const std::string variants[] = {mill, rungs + mill, "; nothing but a comment\n" + mill, "ALIAS counted D600\nLDP SM412\nINC counted\n" + mill};
  const std::string part = "G54 G90 M3 S1000\nG0 X10. Y10.\nT2 M6\nG1 Z-1. F600. M8\nX14.\nG2 X18. I2.\nM9\nG4 P50\nG0 Z10. M5\nM30\n";
  struct Machine {
    rt::VirtualClock clock;
    std::unique_ptr<hal::SimMachine> machine;
    std::unique_ptr<rt::Runtime> runtime;
  } plain, swapped;
  for (Machine* one : {&plain, &swapped}) {
    one->machine = std::make_unique<hal::SimMachine>(config.sim, config.points);
    std::vector<rt::ConfigError> errors;
    one->runtime = rt::Runtime::create(config, {&one->clock, one->machine.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(one->runtime, nullptr);
    std::string error;
    ASSERT_TRUE(one->runtime->start_stepping(&error)) << error;
    unsigned file = 0;
    ASSERT_EQ(nc_program_add_text(one->runtime->control(), "p", part.data(), part.size(), &file), NC_OK);
    ASSERT_EQ(one->runtime->select_program(file), Answer::kDone);
    ASSERT_EQ(one->runtime->execute(CommandKind::kCycleStart), Answer::kDone);
  }
  unsigned scans = 0;
  for (; scans < 60000 && plain.runtime->info().system[0].runs == 0; ++scans) {
    plain.runtime->step();
    ASSERT_EQ(swap(*swapped.runtime, variants[scans % 4]), "");  // makes one step
    const rt::Snapshot a = plain.runtime->snapshot(), b = swapped.runtime->snapshot();
    ASSERT_EQ(a.scan, b.scan);
    for (unsigned p = 0; p < config.points.size(); ++p)
      ASSERT_EQ(plain.machine->outputs().value[p], swapped.machine->outputs().value[p]) << "scan " << scans << ", " << config.points.at(p).name;
    ASSERT_EQ(a.system[0].nc.state, b.system[0].nc.state);
    ASSERT_EQ(a.system[0].nc.strobe, b.system[0].nc.strobe);
    for (unsigned x = 0; x < 3; ++x) ASSERT_EQ(a.system[0].nc.command.v[x], b.system[0].nc.command.v[x]) << "scan " << scans;
  }
  EXPECT_EQ(swapped.runtime->info().system[0].runs, 1u);
  EXPECT_TRUE(swapped.runtime->info().system[0].ended_ok);
  EXPECT_EQ(swapped.runtime->ladder()->swaps(), scans);
  EXPECT_GT(scans, 1000u);
}

class LadderSwap : public OwnLadder {
 protected:
  std::string take(const std::string& text, std::vector<std::string>* set_back = nullptr) { return swap(*runtime, text, set_back); }
};

TEST_F(LadderSwap, ABadProgramIsRefusedWithItsLinesAndNothingChanges) {
  use("LD SM400\nINC D0\nEND\n");
  build();
  steps(5);
  EXPECT_EQ(take("LD SM400\nINC D0\nOUT nowhere\nEND\n"), "next.il:3: OUT nowhere: no such device 'nowhere'\n");
  EXPECT_EQ(take("; nothing\n"), "next.il: holds no instruction: a ladder program has at least END\n");
  EXPECT_EQ(take("LD SM400\n"), "next.il:1: LD SM400: the result of the rung before it is not used\n");
  EXPECT_EQ(runtime->ladder()->swaps(), 0u);
  steps(5);
  EXPECT_EQ(device("D0"), 10);
}

TEST_F(LadderSwap, ATimerOfAnotherUnitIsRefused) {
  use("LD SM400\nOUT T0 K500\nEND\n");
  build();
  EXPECT_NE(take("LD SM400\nOUTH T0 K500\nEND\n").find("next.il: T0 counts 10 ms in line 2 and 100 ms in line 2 of the program that runs"), std::string::npos);
}

TEST_F(LadderSwap, StateGoesOnAndTheFirstScanIsNotOneOfAStart) {
  use("LD SM400\nINC D0\nLD SM402\nSET M5\nEND\n");
  build();
  steps(10);
  ASSERT_EQ(take("LD SM402\nMOV K0 D0\nLD SM400\nINC D0\nINC D1\nEND\n"), "");
  EXPECT_EQ(device("D0"), 11);
  EXPECT_EQ(device("D1"), 1);
  EXPECT_EQ(device("M5"), 1);
}

// What only an instruction holds ends with it: a jog of an axis, a coolant that is on.
TEST_F(LadderSwap, OutputsAndSignalsThatNobodyWritesAnyMoreAreSetBack) {
  use("LD SM400\nOUT out0\nOUT plc.machine_lock\nSET M7\nEND\n");
  build();
  steps(3);
  ASSERT_EQ(point("out0"), 1u);
  ASSERT_EQ(device("plc.machine_lock"), 1);
  std::vector<std::string> set_back;
  ASSERT_EQ(take("LD M7\nOUT M8\nEND\n", &set_back), "");
  EXPECT_EQ(point("out0"), 0u);
  EXPECT_EQ(device("plc.machine_lock"), 0);
  EXPECT_EQ(device("M8"), 1) << "relays of the program itself keep their state";
  EXPECT_EQ(set_back.size(), 2u);
}

TEST_F(LadderSwap, ForcedDevicesStayHeld) {
  use("LD SM400\nMOV K1 D5\nOUT out0\nEND\n");
  build();
  ASSERT_EQ(runtime->force("D5", 77), Answer::kDone);
  ASSERT_EQ(runtime->force("out0", 0), Answer::kDone);
  steps(2);
  ASSERT_EQ(take("LD SM400\nMOV K2 D5\nMOV D5 D6\nOUT out0\nEND\n"), "");
  EXPECT_EQ(device("D6"), 77);
  EXPECT_EQ(point("out0"), 0u);
  ASSERT_EQ(runtime->snapshot().forces.count, 2u);
  ASSERT_EQ(runtime->release(""), Answer::kDone);
  steps(2);
  EXPECT_EQ(device("D6"), 2);
  EXPECT_EQ(point("out0"), 1u);
}

// A program that stands with a fault is replaced, and the new one begins with the reset that the fault needs anyway.
TEST_F(LadderSwap, BehindAFaultTheNewProgramBeginsWithTheReset) {
  use("LD SM400\nINC D0\nLD in0\nCALL P1\nFEND\nP1\nLD SM400\nCALL P1\nRET\nEND\n");
  build();
  steps(3);
  in("in0", 1);
  steps(3);
  const std::string before = alarm();
  ASSERT_NE(before.find(":8: CALL P1: more than 16 subroutines inside each other"), std::string::npos) << before;
  const std::int32_t count = device("D0");
  for (const int round : {1, 2}) {
    ASSERT_EQ(take("; round " + std::to_string(round) + "\nLD SM400\nINC D1\nLD SM402\nMOV K3 D2\nEND\n"), "");
    steps(3);
    EXPECT_EQ(alarm(), before) << "the text is that of the program that has it";
    EXPECT_EQ(device("D0"), count) << "nothing runs";
    EXPECT_EQ(device("D1"), 0);
  }
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  steps(300);
  EXPECT_EQ(alarm(), "");
  EXPECT_GT(device("D1"), 0);
  EXPECT_EQ(device("D2"), 3) << "it begins as at power on";
  EXPECT_EQ(device("D0"), 0);
  ASSERT_EQ(take("P3\nLD in0\nCJ P3\nEND\n"), "");
  steps(3);
  EXPECT_NE(alarm().find("next.il:3: CJ P3: watchdog"), std::string::npos) << alarm();
}

TEST_F(LadderSwap, WithoutAScanNothingIsSwapped) {
  use("LD SM400\nINC D0\nEND\n");
  build();
  steps(4);
  std::vector<ladder::Error> errors;
  EXPECT_FALSE(runtime->ladder()->swap(runtime->ladder()->prepare_swap("LD SM400\nINC D1\nEND\n", "next.il", &errors), milliseconds(0), [] {}));
  steps(4);
  EXPECT_EQ(device("D0"), 8);
  EXPECT_EQ(runtime->ladder()->swaps(), 0u);
  ASSERT_EQ(take("LD SM400\nINC D1\nEND\n"), "");
  steps(1);
  EXPECT_EQ(device("D1"), 2);
}

TEST_F(LadderSwap, WhatWasPreparedForAnotherProgramIsNotTaken) {
  use("LD SM400\nINC D0\nEND\n");
  build();
  std::vector<ladder::Error> errors;
  auto old = runtime->ladder()->prepare_swap("LDP in0\nINC D1\nEND\n", "old.il", &errors);
  ASSERT_EQ(take("LD SM400\nINC D2\nEND\n"), "");
  EXPECT_FALSE(runtime->ladder()->swap(std::move(old), milliseconds(60000), [&] { runtime->step(); }));
  EXPECT_EQ(runtime->ladder()->swaps(), 1u);
}

TEST_F(LadderSwap, OtherNamesAreThoseOfTheNewProgram) {
  use("ALIAS one M1\nLD SM400\nOUT one\nEND\n");
  build();
  steps(1);
  ASSERT_TRUE(runtime->ladder()->find_device("one"));
  ASSERT_EQ(take("ALIAS two M1\nLD SM400\nOUT two\nEND\n"), "");
  EXPECT_FALSE(runtime->ladder()->find_device("one"));
  ASSERT_TRUE(runtime->ladder()->find_device("two"));
  EXPECT_EQ(runtime->ladder()->find_device("two")->name, "M1");
}

// Retained devices belong to the machine: what was kept before a swap is kept behind it.
TEST_F(LadderSwap, RetainedDevicesAreTheSame) {
  use("LD SM402\nSET L5\nLD SM400\nOUT ST3 K1000\nEND\n");
  build();
  steps(250);
  const std::vector<rt::RetainedRow> before = runtime->ladder()->retained();
  ASSERT_EQ(take("LD SM401\nOUT M0\nEND\n"), "");
  const std::vector<rt::RetainedRow> after = runtime->ladder()->retained();
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_EQ(after[i].name, before[i].name);
    EXPECT_EQ(after[i].values, before[i].values) << after[i].name;
  }
}

}  // namespace
}  // namespace nc::test
