// SPDX-License-Identifier: Apache-2.0
// Forced devices of the ladder: what they prevail over, what is refused, and when they end.
#include "ladder_machine.hpp"
#include "stepping.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;

class Force : public nc::test::OwnLadder {
 protected:
  void run(const std::string& ladder) {
    use(ladder);
    build();
    steps(3);
  }
  Answer force(const char* device, std::int64_t value) { return runtime->force(device, value); }
  std::uint32_t output(const char* name) const { return point(name); }
};

TEST_F(Force, AnInputIsWhatItIsForcedToForEverybody) {
  run("LD in0\nOUT M5\nLD SM400\nDMOV word_in D10\nEND\n");
  EXPECT_EQ(device("M5"), 0);
  ASSERT_EQ(force("in0", 1), Answer::kDone);
  ASSERT_EQ(force("word_in", -7), Answer::kDone);
  steps(2);
  EXPECT_EQ(device("M5"), 1) << "against the machine";
  EXPECT_EQ(device("D10"), -7);
  EXPECT_EQ(runtime->snapshot().interface_input[0] & 1u, 1u) << "#1000 of the programs too";
  EXPECT_EQ(runtime->snapshot().interface_input[1], 0xFFFFFFF9u) << "#1033";
  in("in0", 1);
  ASSERT_EQ(force("in0", 0), Answer::kDone);
  steps(2);
  EXPECT_EQ(device("M5"), 0) << "both ways";
  ASSERT_EQ(runtime->release("in0"), Answer::kDone);
  steps(2);
  EXPECT_EQ(device("M5"), 1) << "the machine again";
}

TEST_F(Force, AnOutputIsHeldAgainstTheProgramAndTheNc) {
  run("LD in0\nOUT out0\nLD nc.m_strobe\nOUT plc.fin2\nEND\n");
  ASSERT_EQ(force("out0", 1), Answer::kDone);
  steps(2);
  EXPECT_EQ(output("out0"), 1u);
  start("#1100=1\n#1100=0\nG4 X0.02\nM30\n");  // both the ladder program and the NC set it to 0
  for (int n = 0; n < 200; ++n) {
    runtime->step();
    ASSERT_EQ(output("out0"), 1u) << "in every single scan";
  }
  ASSERT_EQ(runtime->release("out0"), Answer::kDone);
  steps(2);
  EXPECT_EQ(output("out0"), 0u);
}

TEST_F(Force, AnOutputThatNobodyWritesIsAsItWasBefore) {
  run("LD in0\nOUT M0\nEND\n");
  ASSERT_EQ(force("out0", 1), Answer::kDone);
  ASSERT_EQ(force("word_out", 1234), Answer::kDone);
  steps(3);
  EXPECT_EQ(output("out0"), 1u);
  EXPECT_EQ(output("word_out"), 1234u);
  ASSERT_EQ(runtime->release(""), Answer::kDone);
  steps(2);
  EXPECT_EQ(output("out0"), 0u);
  EXPECT_EQ(output("word_out"), 0u);
}

TEST_F(Force, RelaysRegistersTimersAndSignals) {
  run("LD M0\nOUT M1\nLD SM400\nMOV K5 D0\nLD T0\nOUT M2\nLD SM400\nMOV D0 D1\nLD nc.alarm\nOUT plc.interlock_n\n"
      "LD nc.m_strobe\nOUT plc.fin2\nEND\n");
  ASSERT_EQ(force("M0", 1), Answer::kDone);
  ASSERT_EQ(force("D0", 65535), Answer::kDone);
  ASSERT_EQ(force("T0", 1), Answer::kDone);
  ASSERT_EQ(force("nc.alarm", 1), Answer::kDone);
  steps(2);
  EXPECT_EQ(device("M1"), 1);
  EXPECT_EQ(device("D0"), -1) << "behind the program again";
  EXPECT_EQ(device("M2"), 1);
  start("G91 G1 X1. F1000\nM30\n");
  EXPECT_GE(until_end(), 0) << "the ladder believes in an alarm and gives the interlock free";
  EXPECT_EQ(alarm(), "");
  ASSERT_EQ(force("plc.feed_hold_n", 0), Answer::kDone);
  steps(2);
  ASSERT_EQ(runtime->release("plc.feed_hold_n"), Answer::kDone) << "no coil writes it: it has its safe value again";
  ASSERT_EQ(runtime->release("M0"), Answer::kDone);
  steps(2);
  EXPECT_EQ(device("M0"), 0) << "as it was before";
  start("G91 G1 X100. F1000\nM30\n");
  steps(100);
  ASSERT_GT(out().feed_mm_min, 0);
  ASSERT_EQ(force("plc.feed_hold_n", 0), Answer::kDone);
  steps(100);
  EXPECT_EQ(out().state, NC_STATE_HOLD) << "a signal to the NC, although the program does not write it";
  EXPECT_EQ(out().feed_mm_min, 0);
}

// Whatever the program writes, the next contact reads the forced value, in the same scan.
TEST_F(Force, NoInstructionOverrulesItWithinTheScan) {
  const std::pair<const char*, const char*> kBits[] = {
      {"LD SM401\nOUT M1\n", "OUT"}, {"LD SM400\nRST M1\n", "RST"}, {"LD SM400\nZRST M0 M9\n", "ZRST"}, {"LD SM401\nPLS M1\n", "PLS"},
      {"LD SM400\nMOV K0 K4M0\n", "K4M0"}, {"LD SM412\nFF M1\n", "FF"}, {"LD SM401\nMC N0 M1\nMCR N0\n", "MC"},
      {"FOR K2\nLD SM401\nOUT M1\nNEXT\n", "in a loop"}, {"LD SM400\nMPS\nANI SM400\nOUT M1\nMPP\nANI SM400\nOUT M1\n", "branches"}};
  std::string ladder = "LD SM400\nRST M200\n";
  for (const auto& [text, name] : kBits) ladder += std::string(text) + "LDI M1\nSET M200\n";  // M200 is set if a contact reads another value than the forced one
  const char* const kWords[] = {"MOV K5 D1", "INC D1", "RST D1", "FMOV K3 D0 K4", "BMOV D100 D0 K4", "DMOV K-1 D0", "* K3 K3 D0", "+ K1 D1", "ZRST D0 D9", "XCH D50 D1",
                                "BSET D1 K0", "ROL D1 K1"};
  for (const char* text : kWords) ladder += "LD SM400\n" + std::string(text) + "\nLD<> D1 K77\nSET M200\n";
  ladder += "LD SM400\nSET D1.5\nLDI D1.5\nLD D1.5\nORB\nOUT M201\nLD<> D1 K77\nSET M200\n";
  ladder += "LD SM401\nOUT T3 K5\nLDI T3\nSET M200\nLD SM400\nCALL P1\nLDI M1\nSET M200\nFEND\nP1\nLD SM400\nRST M1\nRET\nEND\n";
  run(ladder);
  ASSERT_EQ(force("M1", 1), Answer::kDone);
  ASSERT_EQ(force("D1", 77), Answer::kDone);
  ASSERT_EQ(force("T3", 1), Answer::kDone);
  steps(2);
  for (int n = 0; n < 2500; ++n) {  // long enough for an edge of SM412
    steps(1);
    ASSERT_EQ(device("M200"), 0) << n;
    ASSERT_EQ(device("D1"), 77);
    ASSERT_EQ(device("M1"), 1);
  }
  ASSERT_EQ(runtime->release(""), Answer::kDone);
  steps(2);
  EXPECT_EQ(device("M200"), 1) << "the program is such that it would be seen";
}

TEST_F(Force, IsShownAndReleased) {
  run("ALIAS X0 in0\nLD X0\nOUT M0\nEND\n");
  EXPECT_EQ(runtime->snapshot().forces.count, 0u);
  ASSERT_EQ(force("M7", 1), Answer::kDone);
  ASSERT_EQ(force("X0", 1), Answer::kDone);
  ASSERT_EQ(force("in0", 0), Answer::kDone) << "the same device by its other name";
  steps(1);
  const nc::rt::ForceList forces = runtime->snapshot().forces;
  ASSERT_EQ(forces.count, 2u);
  EXPECT_EQ(runtime->forced_name(forces.device[0].number), "M7");
  EXPECT_EQ(runtime->forced_name(forces.device[1].number), "in0");
  EXPECT_EQ(forces.device[1].value, 0);
  ASSERT_EQ(runtime->release("M100"), Answer::kDone) << "what is not forced is free";
  ASSERT_EQ(runtime->release(""), Answer::kDone);
  steps(1);
  EXPECT_EQ(runtime->snapshot().forces.count, 0u);
}

TEST_F(Force, WhatCannotBeIsRefusedWithItsReason) {
  run("LD in0\nOUT M0\nEND\n");
  const auto refused = [&](const char* device, std::int64_t value, const char* why) {
    EXPECT_EQ(force(device, value), Answer::kNoDevice) << device;
    EXPECT_NE(runtime->explain(Answer::kNoDevice).find(why), std::string::npos) << runtime->explain(Answer::kNoDevice);
  };
  refused("nowhere", 1, "no such device 'nowhere'");
  refused("M8192", 1, "no such device");
  refused("D0.5", 1, "no such device");
  refused("SM400", 0, "belongs to the engine");
  refused("SD0", 0, "belongs to the engine");
  refused("M0", 2, "is a bit");
  refused("M0", -1, "is a bit");
  refused("D0", 65536, "has 16 bits");
  refused("word_in", 4294967296LL, "has 32 bits");
  EXPECT_EQ(runtime->release("nowhere"), Answer::kNoDevice);
  for (unsigned n = 0; n < nc::rt::kMaxForces; ++n) ASSERT_EQ(force(("M" + std::to_string(n)).c_str(), 1), Answer::kDone);
  EXPECT_EQ(force("M500", 1), Answer::kTooManyForces);
  EXPECT_EQ(force("M5", 0), Answer::kDone) << "one of them may change";
  ASSERT_EQ(runtime->release("M5"), Answer::kDone);
  EXPECT_EQ(force("M500", 1), Answer::kDone);
}

TEST_F(Force, WrittenOnceADeviceKeepsTheValueUntilTheProgramWritesIt) {
  run("LD in0\nINC D1\nLD SM400\nMOV D0 D2\nLD M1\nOUT M2\nEND\n");
  const auto write = [this](const char* name, std::int64_t value) { return runtime->write_device(name, value); };
  ASSERT_EQ(write("D0", 40000), Answer::kDone);
  ASSERT_EQ(write("D1", 7), Answer::kDone);
  ASSERT_EQ(write("M1", 1), Answer::kDone);
  ASSERT_EQ(write("out0", 1), Answer::kDone);
  ASSERT_EQ(write("word_out", -5), Answer::kDone);
  steps(1);
  EXPECT_EQ(device("D2"), static_cast<std::int16_t>(40000)) << "before the program has run";
  EXPECT_EQ(device("M2"), 1);
  steps(5);
  EXPECT_EQ(output("out0"), 1u) << "nobody else writes it";
  EXPECT_EQ(output("word_out"), static_cast<std::uint32_t>(-5));
  EXPECT_EQ(device("D1"), 7);
  in("in0", 1);
  steps(4);
  EXPECT_GE(device("D1"), 9) << "once, not again and again";
  ASSERT_EQ(write("M2", 0), Answer::kDone);
  steps(1);
  EXPECT_EQ(device("M2"), 1) << "its coil writes it";
  EXPECT_EQ(runtime->snapshot().forces.count, 0u);
}

TEST_F(Force, WhatCannotBeWrittenOnceIsSaid) {
  run("LD in0\nOUT M0\nEND\n");
  const auto refused = [&](const char* name, std::int64_t value, const char* text) {
    ASSERT_NE(runtime->write_device(name, value), Answer::kDone) << name;
    EXPECT_NE(runtime->explain(runtime->write_device(name, value)).find(text), std::string::npos) << name << ": " << runtime->explain(Answer::kNoDevice);
  };
  refused("nowhere", 1, "no such device 'nowhere'");
  refused("in0", 1, "in each scan: force it");
  refused("nc.mode_auto", 1, "in each scan: force it");
  refused("SM0", 0, "belongs to the engine");
  refused("M0", 2, "is a bit");
  refused("D0", 65536, "has 16 bits");
  ASSERT_EQ(force("D0", 3), Answer::kDone);
  refused("D0", 4, "release it first");
  steps(2);
  EXPECT_EQ(device("D0"), 3);
  // More than the table has room for in one scan: none is lost without a word.
  unsigned done = 0;
  for (int n = 0; n < 100; ++n)
    if (runtime->write_device("D" + std::to_string(100 + n), n + 1) == Answer::kDone) ++done;
  steps(2);
  for (unsigned n = 0; n < done; ++n) EXPECT_EQ(device(("D" + std::to_string(100 + n)).c_str()), static_cast<int>(n) + 1);
}

TEST_F(Force, EndsWithTheProgramOfTheMachineAndWithTheControl) {
  run("LD M1\nCJ P1\nLD in0\nOUT M0\nJMP P2\nP1\nLD SM400\nCJ P1\nP2\nEND\n");
  ASSERT_EQ(force("M1", 1), Answer::kDone);
  steps(5);
  EXPECT_EQ(alarm().substr(0, 3), "R17") << alarm();
  ASSERT_EQ(runtime->execute(CommandKind::kReset), Answer::kDone);
  ASSERT_GE(until([&] { return !runtime->snapshot().resetting && alarm().empty(); }, 3000), 0)
      << "the reset begins the program as at power on, without the force";
  EXPECT_EQ(runtime->snapshot().forces.count, 0u);
  runtime.reset();
  build();
  steps(2);
  EXPECT_EQ(runtime->snapshot().forces.count, 0u);
}

TEST(ForceWithoutLadder, IsRefused) {
  const nc::rt::Config config = nc::test::parse_or_fail(nc::test::base_toml());
  nc::test::SteppedMachine stepped(config);
  const auto& runtime = stepped.runtime;
  ASSERT_NE(runtime, nullptr);
  EXPECT_EQ(runtime->force("in0", 1), Answer::kNoLadder);
  EXPECT_EQ(runtime->release(""), Answer::kNoLadder);
}

}  // namespace
