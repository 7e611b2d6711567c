// SPDX-License-Identifier: Apache-2.0
// System variables (M700 13.5.5 and its section 10.x): every range, its direction, its unit, and when it is read.
#include <gtest/gtest.h>

#include <cmath>

#include "support/drive.hpp"
#include "support/pull.hpp"

namespace nc::test {
namespace {

std::string text(uint32_t number) { return "#" + std::to_string(number); }

/// The alarm when a variable is read, and when it is written.
std::string read_alarm(uint32_t number) { return m700("#100=" + text(number) + "\nM30").alarm; }
std::string write_alarm(uint32_t number, const char* value = "1") { return m700(text(number) + "=" + value + "\nM30").alarm; }

// ---- macro interface ---------------------------------------------------------------------------------------------------------

struct Bank {
  uint32_t word, first;
};
constexpr Bank kInputs[] = {{1032, 1000}, {1033, 1200}, {1034, 1232}, {1035, 1264}};
constexpr Bank kOutputs[] = {{1132, 1100}, {1133, 1300}, {1134, 1332}, {1135, 1364}};

uint32_t output_of(Bench& bench, unsigned word) {
  uint32_t bits = ~0u;
  EXPECT_EQ(nc_interface_output_get(bench.control(), 0, word, &bits), NC_OK);
  return bits;
}

TEST(MacroInterface, EveryInputBitAndWord) {
  for (unsigned w = 0; w < 4; ++w) {
    for (unsigned bit = 0; bit < 32; ++bit) {
      Bench bench;
      bench.input[w] = 1u << bit;
      const uint32_t number = kInputs[w].first + bit;
      const uint32_t other = kInputs[w].first + (bit + 1) % 32;
      const Outcome run = bench.run("#100=" + text(number) + "\n#101=" + text(other) + "\n#102=" + text(kInputs[w].word) + "\n#103=" +
                                    text(kInputs[(w + 1) % 4].word) + "\nM30");
      EXPECT_EQ(run.var(100), 1) << number;
      EXPECT_EQ(run.var(101), 0) << number;
      EXPECT_EQ(run.var(102), static_cast<double>(1u << bit)) << number;  // unsigned
      EXPECT_EQ(run.var(103), 0) << number;
    }
  }
}

TEST(MacroInterface, InputsAreReadWhenTheMachineIsThere) {
  Bench bench;
  bench.input[0] = 1;
  bool was_asked = false;
  bench.on_sync = [&](const nc_item& sync) {
    EXPECT_NE(sync.u.sync.what & NC_SYNC_INPUT, 0u);
    was_asked = true;
  };
  const Outcome run = bench.run("G0 X1.\n#100=#1000\nM30");
  EXPECT_TRUE(was_asked);
  ASSERT_GE(run.steps.size(), 3u);
  EXPECT_EQ(run.steps[0].item.kind, NC_ITEM_MOVE);
  EXPECT_EQ(run.steps[1].item.kind, NC_ITEM_MARK);
  EXPECT_EQ(run.steps[2].item.kind, NC_ITEM_SYNC);
}

TEST(MacroInterface, InputsAreReadAgainInEveryBlock) {
  Bench bench;
  unsigned asked = 0;
  bench.on_sync = [&](const nc_item&) { bench.input[0] = ++asked >= 5 ? 1 : 0; };
  EXPECT_TRUE(bench.run("WHILE[#1000 EQ 0]DO1\nEND1\nM30").ended_ok);  // the usual waiting loop
  EXPECT_EQ(asked, 5u);
}

TEST(MacroInterface, EveryOutputBitReadsBackAndIsOneOfTheWord) {
  for (unsigned w = 0; w < 4; ++w) {
    for (unsigned bit = 0; bit < 32; ++bit) {
      Bench bench;
      const uint32_t number = kOutputs[w].first + bit;
      const Outcome run = bench.run(text(number) + "=1\n#100=" + text(number) + " #101=" + text(kOutputs[w].word) + "\nM30");
      EXPECT_EQ(run.var(100), 1) << number;
      EXPECT_EQ(run.var(101), static_cast<double>(1u << bit)) << number;
      const std::vector<nc_item> actions = run.of(NC_ITEM_ACTION);
      ASSERT_EQ(actions.size(), 2u);
      EXPECT_EQ(actions[0].u.action.kind, NC_ACTION_OUTPUT);
      EXPECT_EQ(actions[0].u.action.index, w);
      EXPECT_EQ(actions[0].u.action.mask, 1u << bit);
      EXPECT_EQ(actions[0].u.action.bits, 1u << bit);
      EXPECT_EQ(output_of(bench, w), 1u << bit);
    }
  }
}

TEST(MacroInterface, WordsChangeAllBitsAtOnce) {
  Bench bench;
  const Outcome run = bench.run("#1132=4294967295\n#1100=0\n#1133=-1\n#1134=5.9\n#100=#1132 #101=#1133 #102=#1334 #103=#1332\nM30");
  EXPECT_EQ(run.var(100), 4294967294.0);
  EXPECT_EQ(run.var(101), 4294967295.0);
  EXPECT_EQ(run.var(102), 1);
  EXPECT_EQ(run.var(103), 1);
  EXPECT_EQ(output_of(bench, 0), 0xfffffffeu);
  EXPECT_EQ(output_of(bench, 2), 5u);
}

TEST(MacroInterface, WhatABitTakes) {  // vacant = 0, any other number than 0 = 1
  const Outcome run = m700("#1100=1\n#1100=#1\n#1101=0.5\n#1102=-3\n#1103=0\n#100=#1132\nM30");
  EXPECT_EQ(run.var(100), 0b0110);
}

TEST(MacroInterface, OutputsOutliveTheProgram) {
  Bench bench;
  bench.run("#1105=1\nM30");
  EXPECT_EQ(bench.run("#100=#1105\nM30").var(100), 1);
  nc_reset(bench.control(), 0);
  EXPECT_EQ(output_of(bench, 0), 32u);
}

TEST(MacroInterface, OutputsBeginAsTheMachineHasThem) {
  Bench bench;
  ASSERT_EQ(nc_interface_output_set(bench.control(), 0, 0, 0b0110, 0b1111), NC_OK);
  ASSERT_EQ(nc_interface_output_set(bench.control(), 0, 3, ~0u, 0xfffffffe), NC_OK);
  EXPECT_EQ(output_of(bench, 0), 0b0110u) << "only what the mask names";
  const Outcome run = bench.run("#100=#1100+#1101*10\n#103=#1135\n#1101=0\n#102=#1132\nM30");
  EXPECT_EQ(run.var(100), 10);
  EXPECT_EQ(run.var(103), 4294967294.0);
  EXPECT_EQ(run.var(102), 0b0100);
}

// A write of a block that was read ahead is taken back with the block, even if other bits of the word have been set meanwhile.
TEST(MacroInterface, OnlyTheBitsOfTheMaskAreTheMachines) {
  for (const uint32_t before : {0u, 0b1000u, 0b1001u}) {
    Bench bench;
    ASSERT_EQ(nc_interface_output_set(bench.control(), 0, 1, ~0u, before), NC_OK);
    Drive drive(bench, "G1 X100. F100\n#1300=1 #1301=1\n#1133=[#1133+16]\nM30");
    for (unsigned n = 0; n < 20; ++n) drive.press_start(), drive.step();
    ASSERT_EQ(output_of(bench, 1), (before | 0b11u) + 16) << "read, not executed";
    ASSERT_EQ(nc_interface_output_set(bench.control(), 0, 1, 0b0110, 0b0100), NC_OK);
    ASSERT_EQ(nc_interface_output_set(bench.control(), 0, 0, 1, 1), NC_OK);
    EXPECT_EQ(output_of(bench, 1), (((before | 0b11u) + 16) & ~0b0110u) | 0b0100u);
    drive.in.reset = true;
    for (unsigned n = 0; n < 5; ++n) drive.step();
    nc_reset(bench.control(), 0);
    EXPECT_EQ(output_of(bench, 1), before | 0b0100u) << before;
    EXPECT_EQ(output_of(bench, 0), 1u);
  }
}

TEST(MacroInterface, AnOutputOfABlockThatAlarmsIsNotSet) {
  Bench bench;
  const Outcome run = bench.run("#1100=1 #101=1/0\nM30");
  EXPECT_EQ(run.alarm, "P283");
  EXPECT_TRUE(run.of(NC_ITEM_ACTION).empty());
  EXPECT_EQ(output_of(bench, 0), 0u);
}

TEST(MacroInterface, WrongUses) {
  EXPECT_EQ(write_alarm(1000), "P243");
  EXPECT_EQ(write_alarm(1032), "P243");
  EXPECT_EQ(write_alarm(1295), "P243");
  for (uint32_t gap : {1036u, 1099u, 1136u, 1199u, 1296u, 1299u, 1396u}) EXPECT_EQ(read_alarm(gap), "P241") << gap;
  EXPECT_EQ(write_alarm(1132, "4294967296"), "P35");
  EXPECT_EQ(write_alarm(1132, "-2147483649"), "P35");
}

// ---- offsets -------------------------------------------------------------------------------------------------------------------

TEST(SystemVariables, ToolOffsets) {  // M700 10.1
  Bench one;
  one.tool(3, 4.5);
  const Outcome run = one.run("#100=#2003 #101=#10003\n#2200=7\n#10001=1000\nM30");
  EXPECT_EQ(run.var(100), 4.5);
  EXPECT_EQ(run.var(101), 4.5);
  EXPECT_EQ(one.tool_now(200), 7);
  EXPECT_EQ(one.tool_now(1), 1000);
  for (uint32_t n : {2201u, 2401u, 2601u, 11001u, 16001u, 17001u}) EXPECT_EQ(read_alarm(n), "P241") << n;  // memory type I
  EXPECT_EQ(read_alarm(10201), "P241");
  Bench two;
  two.param("1037", "2");
  two.run("#2001=1 #2201=2 #2401=3 #2601=4\n#10002=5 #11002=6 #16002=7 #17002=8\nM30");
  const double expected[2][4] = {{1, 2, 3, 4}, {5, 6, 7, 8}};
  for (unsigned n = 1; n <= 2; ++n)
    for (unsigned column = 0; column < 4; ++column) EXPECT_EQ(two.tool_now(n, static_cast<nc_tool_column>(column)), expected[n - 1][column]);
  EXPECT_EQ(write_alarm(2001, "100000"), "P35");
}

TEST(SystemVariables, WorkOffsets) {  // M700 10.2, both printed examples
  Bench bench;
  EXPECT_EQ(bench.run("#5221=-20. #5222=-20.\nG90 G00 G54 X0 Y0\n#5221=-90. #5222=-10.\nX0 Y0\nM30").path(),
            (Path{"rapid -20 -20 0", "rapid -90 -10 0"}));
  bench.run("#5201=1 #5203=3 #5241=55 #5323=59\n#7001=101 #7022=102 #8901=196\nM30");
  EXPECT_EQ(bench.work_offset_now(0, 0), 1);
  EXPECT_EQ(bench.work_offset_now(0, 2), 3);
  EXPECT_EQ(bench.work_offset_now(2, 0), 55);
  EXPECT_EQ(bench.work_offset_now(6, 2), 59);
  EXPECT_EQ(bench.work_offset_now(101, 0), 101);
  EXPECT_EQ(bench.work_offset_now(102, 1), 102);
  EXPECT_EQ(bench.work_offset_now(196, 0), 196);
  EXPECT_EQ(bench.run("#100=#5221 #101=#8901\nM30").var(101), 196);
  EXPECT_EQ(read_alarm(5204), "P241");  // there is no fourth axis
  EXPECT_EQ(write_alarm(5221, "-100000"), "P35");
}

// M700 2.1 note 1: "compensation amounts as well as the variable data" are in the unit of #1041, whatever G20 and G21 say.
TEST(SystemVariables, OffsetsAreInTheInitialUnit) {
  Bench bench(NC_DIALECT_M700, axes("XYZc"));
  bench.param("1041", "1").tool(3, 50.8);
  const Outcome run = bench.run("#100=#2003\n#5221=1. #5224=30.\n#10001=.5\n#101=#5221 #102=#5224\nG54 G0 X0 C0\nG20\n#103=#2003\nG10 L10 P2 R1.\n#104=#10002\nG21 G10 L10 P4 R1.\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_DOUBLE_EQ(run.var(100), 2);
  EXPECT_EQ(run.path(), (Path{"rapid 25.4 0 0 30"}));
  EXPECT_DOUBLE_EQ(bench.tool_now(1), 12.7);
  EXPECT_DOUBLE_EQ(run.var(101), 1);
  EXPECT_EQ(run.var(102), 30);
  EXPECT_DOUBLE_EQ(run.var(103), 2);
  EXPECT_DOUBLE_EQ(run.var(104), 1);
  EXPECT_EQ(bench.tool_now(4), 1);  // the data of G10 are a command
  EXPECT_EQ(bench.run("#10001=9999.\nM30").alarm, "");
  EXPECT_EQ(bench.run("#10001=10000.\nM30").alarm, "P35");
}

// 13.5.5 "Precautions for reading parameters" (2), 13.11: "set from the setting and display unit".
TEST(SystemVariables, ParametersAreInTheInitialUnit) {
  Bench bench(NC_DIALECT_M700, axes("XYZc"));
  bench.param("1041", "1").param("8206", "25.4", 'X').param("8206", "90", 'C').param("8030", "-1").param("1174", "254").param("8007", "50");
  const auto read = [&bench](const char* number, const char* axis) {
    const Outcome run = bench.run("#100000=" + std::string(number) + " #100002=" + axis + "\n#100=#100010\nM30");
    EXPECT_EQ(run.alarm, "") << number;
    return run.var(100);
  };
  EXPECT_DOUBLE_EQ(read("8206", "1"), 1);
  EXPECT_EQ(read("8206", "4"), 90);  // degrees
  EXPECT_DOUBLE_EQ(read("1174", "1"), 10);
  EXPECT_EQ(read("8030", "1"), -1);  // which is no length
  EXPECT_EQ(read("8007", "1"), 50);  // percent
  EXPECT_EQ(bench.run("G10 L70\nP8206 A1 D2.00004\nP8206 A4 D45.\nP8030 D-1.\nG11\nM30").alarm, "");
  EXPECT_DOUBLE_EQ(read("8206", "1"), 2);  // note 5: a ten-thousandth of an inch
  EXPECT_EQ(read("8206", "4"), 45);
  EXPECT_EQ(read("8030", "1"), -1);
}

TEST(SystemVariables, AnAmountInForceCountsFromTheNextBlockOn) {  // 12.1: a length with the next command of its axis
  Bench bench;
  bench.tool(1, 10).tool(2, 2);
  EXPECT_EQ(bench.run("G0 G43 H1 Z0\n#10001=20\nX1.\nZ0\n#2001=#2001+1\nZ0\nG10 L10 P1 R30.\nG44 Z0\n#10001=5\nZ0\n#10002=99\nZ1.\nG49 Z0\n#10001=1\nZ0\nM30").path(),
            (Path{"rapid 0 0 10", "rapid 1 0 10", "rapid 1 0 20", "rapid 1 0 21", "rapid 1 0 -30", "rapid 1 0 -5", "rapid 1 0 -4", "rapid 1 0 0"}));
  // A changed radius acts as if D were given again (12.4.5).
  const Outcome with_d = bench.tool(1, 10).tool(2, 2).at(0, 0, 0).run("G90 G1 G41 D2 X10. F100\nX20.\n#10002=4\nX30. D2\nX40.\nG40 Y20.\nM30");
  const Outcome without = bench.tool(2, 2).at(0, 0, 0).run("G90 G1 G41 D2 X10. F100\nX20.\n#10002=4\nX30.\nX40.\nG40 Y20.\nM30");
  EXPECT_EQ(with_d.alarm, "");
  EXPECT_EQ(without.path(), with_d.path());
}

// ---- alarm, message, control ------------------------------------------------------------------------------------------------------

TEST(SystemVariables, Alarm3000) {  // M700 10.3
  const Outcome run = m700("G0 X1.\n#3000=70(CALL#PROGRAMMER#TEL#530)\nG0 X2.\nM30");
  EXPECT_EQ(run.alarm, "P277");
  EXPECT_EQ(run.alarm_line, 2u);
  EXPECT_EQ(run.alarm_detail, "CALL#PROGRAMMER#TEL#530 70");  // as in the manual
  EXPECT_EQ(run.path(), (Path{"rapid 1 0 0"}));
  EXPECT_EQ(m700("#3000=10000(X)\nM30").alarm, "P35");
  EXPECT_EQ(m700("#3000=0(X)\nM30").alarm, "P35");
  EXPECT_EQ(m700("#3000=5\nM30").alarm, "P277");
  EXPECT_EQ(read_alarm(3000), "P243");
}

TEST(SystemVariables, MessageOfAlarm3000WithoutBrackets) {  // 13.5.5, #3000, note 2: from the first letter on; brackets are recommended
  const auto detail = [](const char* block) {
    const Outcome run = m700(std::string("#1=30\n") + block + "\nM30");
    EXPECT_EQ(run.alarm, "P277") << block;
    EXPECT_EQ(run.alarm_line, 2u) << block;
    return run.alarm_detail;
  };
  EXPECT_EQ(detail("#3000=70 STOPIT"), "STOPIT 70");
  EXPECT_EQ(detail("#3000=5STOPIT"), "STOPIT 5");
  EXPECT_EQ(detail("#3000=#1+5 CALL TEL#530 "), "CALL TEL#530 35");
  EXPECT_EQ(detail("#3000=70 ORDER[5"), "ORDER[5 70");  // no operator
  EXPECT_EQ(detail("#3000=[#1 MOD 7]MODE"), "MODE 2");
  EXPECT_EQ(detail("#3000=ABS[-70]"), "The program has raised alarm 70 itself (#3000).");
  for (const char* block : {"#3000=70(STOP)X1.", "#3006=1STOP", "#100=70 STOPIT", "#3000=1 #100=5 STOPIT"}) EXPECT_NE(m700(std::string(block) + "\nM30").alarm, "P277") << block;
  EXPECT_EQ(m700("#100=70 X1.\nM30").alarm, "P272");
}

TEST(SystemVariables, Message3006) {  // M700 13.5.5 (10.7)
  const Outcome run = m700("G0 X1.\n#3006=1(TAKE FIVE)\nG0 X2.\nM30");
  EXPECT_TRUE(run.ended_ok);
  std::string shown;
  for (const Step& step : run.steps) shown += step.text;
  EXPECT_EQ(shown, "TAKE FIVE");
  ASSERT_EQ(run.of(NC_ITEM_GATE).size(), 2u);  // and the completion of M30
  EXPECT_EQ(run.of(NC_ITEM_GATE)[0].u.gate.kind, NC_GATE_STOP);
  EXPECT_EQ(run.of(NC_ITEM_MOVE)[1].source.line, 3u);
}

TEST(SystemVariables, StopSuppression3003) {  // M700 10.5
  auto stops = [](const char* program) {
    std::vector<unsigned> lines;
    for (const nc_item& item : m700(program).of(NC_ITEM_MARK))
      if (item.u.mark.stop) lines.push_back(item.source.line);
    return lines;
  };
  EXPECT_EQ(stops("G0 X1.\n#3003=1\nX2.\nX3.\n#3003=0\nX4.\nM30"), (std::vector<unsigned>{1, 6}));
  EXPECT_EQ(stops("#3003=2\nX2. F1\nM30"), (std::vector<unsigned>{2}));
  // Bit 1: FIN is not awaited.
  auto gates = [](const char* program) {
    unsigned n = 0;
    for (const nc_item& item : m700(program).of(NC_ITEM_GATE)) n += item.u.gate.kind == NC_GATE_FIN;
    return n;
  };
  EXPECT_EQ(gates("M8\n#3003=2\nM9\n#3003=0\nM5\nM30"), 3u);
  Bench bench;
  bench.run("#3003=3 #3004=7\nM30");
  EXPECT_EQ(bench.run("#100=#3003 #101=#3004\nM30").var(100), 0);  // cleared by reset
  for (const char* bad : {"4", "7", "8", "-1"}) EXPECT_EQ(write_alarm(3003, bad), "P35") << bad;
  for (const char* bad : {"8", "-1"}) EXPECT_EQ(write_alarm(3004, bad), "P35") << bad;
  EXPECT_EQ(write_alarm(3003, "3"), "");
  EXPECT_EQ(write_alarm(3004, "7"), "");
  const std::vector<nc_item> actions = m700("#3004=5\nM30").of(NC_ITEM_ACTION);
  ASSERT_GE(actions.size(), 1u);
  EXPECT_EQ(actions[0].u.action.kind, NC_ACTION_CONTROL);
  EXPECT_EQ(actions[0].u.action.index, NC_CONTROL_DISABLE);
  EXPECT_EQ(actions[0].u.action.value, 5);
}

TEST(SystemVariables, TheTableSaysWhatIsTrue) {
  // The ranges are in order and do not overlap; variables are readable, writable and synchronising as the table says.
  nc_system_variable row{};
  uint32_t last = 0;
  unsigned index = 0;
  for (; nc_system_variable_row(NC_DIALECT_M700, index, &row) == NC_OK; ++index) {
    EXPECT_GT(row.first, last) << row.name;
    EXPECT_LE(row.first, row.last);
    last = row.last;
    if (row.first == 4101 || row.first == 4301 || row.first == 4501 || row.first == 4401) continue;  // not every number, not everywhere
    if (row.first == 11001 || row.first == 16001 || row.first == 17001 || row.first == 100110) continue;  // by parameter, by host
    Bench bench;
    bool asked = false;
    bench.on_sync = [&](const nc_item&) { asked = true; };
    const Outcome run = bench.run("G0 X1.\n#100=" + text(row.first) + "\nM30");
    EXPECT_EQ(run.alarm == "P243", !row.readable) << row.first;
    if (row.readable) {
      EXPECT_EQ(run.alarm, "") << row.first;
    }
    EXPECT_EQ(asked, row.sync != 0) << row.first;
    const std::string written = m700(text(row.first) + "=" + (row.first == 3011 ? "20260101" : "1") + "\nM30").alarm;
    EXPECT_EQ(written == "P243", !row.writable) << row.first << ' ' << written;
  }
  EXPECT_GT(index, 40u);
  EXPECT_EQ(nc_system_variable_row(NC_DIALECT_M700, index, &row), NC_E_NOT_FOUND);
}

TEST(SystemVariables, ParametersByNumber) {  // 13.5.5 (10.16)
  Bench bench;
  bench.param("2037", "12.5", 'Y').param("1003", "C").param("1004", "7");
  const Outcome run = bench.run("#100000=2037 #100001=0 #100002=2\n#100=#100010\n#100000=1003\n#101=#100010\n#100000=1004\n#102=#100010\n#100000=1001\n#103=#100010\nM30");
  EXPECT_EQ(run.alarm, "");
  EXPECT_EQ(run.var(100), 12.5);
  EXPECT_EQ(run.var(101), 'C');  // text as its code
  EXPECT_EQ(run.var(102), 7);    // one that the machine has set
  EXPECT_EQ(run.var(103), 1);
  // Values from the configuration; the example of the manual reads the number of axes.
  const Outcome machine = bench.run("#100000=1002\n#100=#100010\n#100000=1013 #100002=3\n#101=#100010\n#100000=1017\n#102=#100010\nM30");
  EXPECT_EQ(machine.var(100), 3);
  EXPECT_EQ(machine.var(101), 'Z');
  EXPECT_EQ(machine.var(102), 0);
  EXPECT_EQ(write_alarm(100000, "0"), "P39");
  EXPECT_EQ(write_alarm(100000, "99999"), "P39");  // (1): one that does not exist
  EXPECT_EQ(write_alarm(100000, "1000"), "P39");
  EXPECT_EQ(bench.run("#100000=1999\n#100=#100010\nM30").var(100), 0);
  EXPECT_EQ(write_alarm(100001, "5"), "P39");
  EXPECT_EQ(write_alarm(100002, "4"), "P39");
}

TEST(SystemVariables, DevicesOfThePlc) {  // 13.5.5 (10.17): widths, signs, and what lies beyond the last device
  struct Devices {
    static void read(void*, unsigned code, uint32_t number, uint32_t* value) {
      if (code == 1) *value = number == 0 ? 0xFFFE : number == 1 ? 0xFFFF : number == 2 ? 0x0102 : number == 2047 ? 0x8001 : 0;
      if (code == 4) *value = number % 3 == 0;
    }
  };
  Bench bench;
  nc_device_on_read(bench.control(), Devices::read, nullptr);
  const auto value = [&](const char* device, const char* number, const char* bytes, const char* bit) {
    return bench.run(std::string("#100100=") + device + "\n#100101=" + number + "\n#100102=" + bytes + "\n#100103=" + bit + "\n#100=#100110\nM30").var(100);
  };
  EXPECT_EQ(value("1", "0", "104", "0"), -2);
  EXPECT_EQ(value("1", "2", "0", "1"), 1);
  EXPECT_EQ(value("1", "2", "1", "0"), 2);
  EXPECT_EQ(value("1", "2", "2", "0"), 258);
  EXPECT_EQ(value("1", "0", "102", "0"), -2);
  EXPECT_EQ(value("1", "2047", "4", "0"), 0x8001);
  EXPECT_EQ(value("4", "0", "1", "0"), 0x49);
  EXPECT_EQ(value("4", "0", "101", "0"), 0x49);
  EXPECT_EQ(value("4", "8190", "1", "0"), 1);
  EXPECT_EQ(write_alarm(100100, "1"), "P39");  // no host that has devices
  EXPECT_EQ(read_alarm(100110), "P39");
  EXPECT_EQ(bench.run("#100100=3\nM30").alarm, "P39");
  EXPECT_EQ(bench.run("#100102=3\nM30").alarm, "P39");
  EXPECT_EQ(bench.run("#100103=16\nM30").alarm, "P39");  // bits 0 to 15
  EXPECT_EQ(bench.run("#100100=1 #100101=2048 #100102=2\n#100=#100110\nM30").alarm, "P39");  // D0 to D2047
}

TEST(SystemVariables, ToolLifeWithoutAGroup) {  // 13.5.5 (10.15)
  const Outcome run = m700("#60000=5\n#100=#60001\n#101=#62002\n#102=#60700\nM30");
  EXPECT_EQ(run.var(100), -1);
  EXPECT_EQ(run.var(101), -1);
  EXPECT_EQ(run.var(102), -1);
  EXPECT_EQ(read_alarm(61201), "P241");  // registration number out of specification
  EXPECT_EQ(read_alarm(61000), "P241");
}

TEST(SystemVariables, NamesFromTheHost) {
  Bench bench;
  EXPECT_EQ(nc_variable_name_set(bench.control(), 505, "LENGTH"), NC_OK);
  EXPECT_EQ(bench.run("[#LENGTH]=4\nM30").var(505), 4);
  bench.run("SETVN506[WIDTH]\nM30");
  char name[8];
  nc_variable_name_get(bench.control(), 506, name);
  EXPECT_STREQ(name, "WIDTH");
  nc_variable_name_get(bench.control(), 507, name);
  EXPECT_STREQ(name, "");
  EXPECT_EQ(nc_variable_name_set(bench.control(), 505, ""), NC_OK);
  EXPECT_EQ(bench.run("[#LENGTH]=4\nM30").alarm, "P300");
  EXPECT_EQ(nc_variable_name_set(bench.control(), 520, "A"), NC_E_ARGUMENT);
  EXPECT_EQ(nc_variable_name_set(bench.control(), 505, "9A"), NC_E_ARGUMENT);
  EXPECT_EQ(nc_variable_name_set(bench.control(), 505, "ABCDEFGH"), NC_E_ARGUMENT);
}

TEST(SystemVariables, MirrorState3007) { EXPECT_EQ(m700("#100=#3007\nM30").var(100), 0); }

// ---- clocks -----------------------------------------------------------------------------------------------------------------------

TEST(SystemVariables, RunTimes) {  // M700 10.4
  EXPECT_TRUE(m700("#3001=0\nWHILE[#3001 LE 100]DO1\nEND1\nM30").ended_ok);  // the printed waiting loop
  // Two readings of the clock in one block give the same time.
  const Outcome both = m700("#100=#3001-#3001\nIF[#3001 GT #3002]GOTO2\nN2 M30");
  EXPECT_EQ(both.alarm, "");
  EXPECT_EQ(both.var(100), 0);
  EXPECT_EQ(write_alarm(3001, "-1"), "P35");
  EXPECT_EQ(write_alarm(3002, "244335917227"), "P35");
  EXPECT_TRUE(Bench().param("1273/bit1", "1").run("#3002=5\n#100=#3002\nM30").ended_ok);  // in hours
}

TEST(SystemVariables, DateAndTime) {  // M700 13.5.5 (10.18)
  Bench bench;
  bench.clock_ms = 1767225600000 + (13 * 3600 + 14 * 60 + 15) * 1000;  // 2026-01-01 13:14:15
  const Outcome run = bench.run("#100=#3011 #101=#3012\n#3011=20010214\n#3012=235959\n#102=#3011 #103=#3012\nM30");
  EXPECT_EQ(run.var(100), 20260101);
  EXPECT_EQ(run.var(101), 131415);
  EXPECT_EQ(run.var(102), 20010214);
  EXPECT_EQ(run.var(103), 235959);
  for (const char* date : {"20261301", "20260230", "19991231", "21000101", "-5", "20260100"}) EXPECT_EQ(write_alarm(3011, date), "P35") << date;
  for (const char* time : {"240000", "126000", "120060", "-1"}) EXPECT_EQ(write_alarm(3012, time), "P35") << time;
}

TEST(SystemVariables, Counters) {  // M700 13.5.5 (10.13)
  Bench bench;
  EXPECT_EQ(bench.run("#3901=#3901+1\n#3902=999999\n#100=#3901 #101=#3902\nM30").var(100), 1);
  EXPECT_EQ(bench.run("#3901=#3901+1\n#100=#3901\nM30").var(100), 2);
  EXPECT_EQ(write_alarm(3901, "1000000"), "P35");
  EXPECT_EQ(write_alarm(3901, "-1"), "P35");
  // An option: macros of the maker write -1.
  EXPECT_EQ(Bench().param("negative_count", "1").run("#3901=-1\n#100=#3901 #3901=#3901+1 #101=#3901\nM30").var(100), -1);
  EXPECT_EQ(Bench().param("negative_count", "1").run("#3901=-1\n#3901=#3901+1 #101=#3901\nM30").var(101), 0);
  EXPECT_EQ(Bench().param("negative_count", "1").run("#3901=-1000000\nM30").alarm, "P35");
  EXPECT_EQ(Bench().param("negative_count", "1").run("#3902=-1\nM30").alarm, "P35");
}

TEST(SystemVariables, ExtendedWorkSystemInForce) {
  const Outcome run = m700("#100=#4130\nG54.1 P48\n#101=#4130\nG55\n#102=#4130\nG54.1 P1\n#103=#4130\nM30");
  EXPECT_EQ(run.alarm, "") << run.alarm_detail;
  EXPECT_EQ(run.var(100), 0);
  EXPECT_EQ(run.var(101), 48);
  EXPECT_EQ(run.var(102), 0);
  EXPECT_EQ(run.var(103), 1);
  EXPECT_EQ(write_alarm(4130), "P243");
  EXPECT_EQ(read_alarm(4129), "P241");
}

TEST(CommonVariables, FurtherRangesOfTheMachine) {
  const auto ranges = [](std::vector<nc_variable_range> all) {
    return [all](nc_config& config) {
      for (size_t i = 0; i < all.size(); ++i) config.variable_ranges[i] = all[i];
    };
  };
  EXPECT_EQ(write_alarm(400), "P241");
  Bench bench(NC_DIALECT_M700, ranges({{400, 499}, {}, {34, 40}, {990000, 999999}}));
  const Outcome run = bench.run("#400=1 #499=#400+1 #34=3 #999999=4\nG1 X#499 F100\n#[398+2]=#0\n#100=#400\nM30");
  EXPECT_EQ(run.alarm, "") << run.alarm_detail;
  EXPECT_TRUE(std::isnan(run.var(400)));
  EXPECT_TRUE(std::isnan(run.var(100)));
  EXPECT_EQ(run.var(499), 2);
  EXPECT_EQ(run.var(34), 3);
  EXPECT_EQ(run.var(999999), 4);
  EXPECT_EQ(run.path(), Path({"line 2 0 0 F100"}));
  for (const char* none : {"#399=1\nM30", "#41=1\nM30", "#989999=1\nM30"}) EXPECT_EQ(bench.run(none).alarm, "P241") << none;
  // A rewind restores their old values.
  bench.start("#450=1\nG1 X1. F100\n#450=2\nG1 X2.\nM30");
  Step step;
  uint64_t serial = 0;
  while (bench.pull(&step) == NC_OK && serial == 0)
    if (step.item.kind == NC_ITEM_MARK && step.item.source.line == 2) serial = step.item.serial;
  while (bench.pull(&step) == NC_OK) {
  }
  EXPECT_EQ(bench.var_now(450), 2);
  nc_axes at{};
  at.v[0] = 1;
  EXPECT_EQ(bench.rewind(serial, at), NC_OK);
  EXPECT_EQ(bench.var_now(450), 1);
}

TEST(CommonVariables, RangesThatCannotBe) {
  nc_config config;
  const auto check = [&](uint32_t first, uint32_t last, uint32_t* taken) {
    nc_config_init(&config);
    config.variable_ranges[1] = {first, last};
    const bool built = nc_memory_required(&config) != 0;
    const nc_status status = nc_variable_range_check(&config, 1, taken);
    EXPECT_EQ(built, status == NC_OK) << first << ' ' << last;
    return status == NC_OK;
  };
  uint32_t taken = 99;
  EXPECT_TRUE(check(200, 499, &taken));
  EXPECT_EQ(taken, 0u);
  const struct {
    uint32_t first, last, taken;
  } wrong[] = {{150, 250, 150}, {400, 500, 500}, {33, 40, 0}, {499, 400, 0}, {400, 0, 0}, {990000, 1000000, 0}, {200000, 210000, 0}, {990, 1000, 990},
               {5000, 5000, 0}, {4990, 5010, 5001}, {12000, 15999, 0}, {0, 40, 0}};
  for (const auto& w : wrong) {
    const bool good = check(w.first, w.last, &taken);
    const bool free = (w.first == 5000 && w.last == 5000) || w.first == 12000;
    EXPECT_EQ(good, free) << w.first;
    if (!free) {
      EXPECT_EQ(taken, w.taken) << w.first << ' ' << w.last;
    }
  }
  nc_config_init(&config);
  config.variable_ranges[0] = {400, 450};
  config.variable_ranges[3] = {450, 460};
  EXPECT_EQ(nc_variable_range_check(&config, 0, &taken), NC_E_ARGUMENT);
  EXPECT_EQ(taken, 450u);
  EXPECT_EQ(nc_memory_required(&config), 0u);
  nc_config_init(&config);
  config.extended_variables = true;
  config.variable_ranges[0] = {907000, 908000};
  EXPECT_EQ(nc_variable_range_check(&config, 0, &taken), NC_E_ARGUMENT);
  EXPECT_EQ(taken, 907000u);
  EXPECT_EQ(nc_variable_range_check(&config, NC_VARIABLE_RANGES, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_variable_range_check(nullptr, 0, nullptr), NC_E_ARGUMENT);
}

TEST(CommonVariables, FurtherRangesAreSharedByAllPartSystems) {
  Bench bench(NC_DIALECT_M700, [](nc_config& config) {
    config.system_count = 2;
    config.system[1] = config.system[0];
    config.variable_ranges[0] = {400, 499};
  });
  ASSERT_EQ(nc_variable_set(bench.control(), 0, 400, 7, false), NC_OK);
  double value = 0;
  bool vacant = true;
  ASSERT_EQ(nc_variable_get(bench.control(), 1, 400, &value, &vacant), NC_OK);
  EXPECT_EQ(value, 7);
  uint32_t number = 0;
  ASSERT_EQ(nc_variable_next(bench.control(), 1, 0, &number, &value), NC_OK);
  EXPECT_EQ(number, 400u);
}

// ---- modal state ---------------------------------------------------------------------------------------------------------------------

TEST(SystemVariables, ModalCodesReadAhead) {  // M700 13.5.5 (10.9)
  EXPECT_EQ(m700("G95 G62\n#101=#4005 #102=#4013\nG93\n#103=#4005\nM30").var(101), 95);
  const Outcome codes = m700(
      "G0 G19 G91 G20 G43 H1 G99 G57 G61\n"
      "#101=#4001 #102=#4002 #103=#4003 #105=#4005 #106=#4006\n#107=#4007 #108=#4008 #109=#4009 #110=#4010 #112=#4012 #113=#4013\n"
      "#114=#4014 #117=#4017 #119=#4019\nG54.1 P2\n#120=#4012\nM30");
  EXPECT_EQ(codes.alarm, "");
  const std::map<uint32_t, double> expected = {{101, 0},  {102, 19}, {103, 91}, {105, 94}, {106, 20}, {107, 40}, {108, 43},    {109, 80},
                                               {110, 99}, {112, 57}, {113, 61}, {114, 67}, {117, 97}, {119, 50.1}, {120, 54.1}};
  for (const auto& [number, value] : expected) EXPECT_DOUBLE_EQ(codes.var(number), value) << number;
}

TEST(SystemVariables, ModalCodesInExecution) {  // M700 13.5.5 (10.9): #42xx belongs to the block in execution
  const Outcome run = m700("G91 G0\nG90\n#100=#4203 #101=#4003\nM30");
  EXPECT_EQ(run.var(100), 90);
  EXPECT_EQ(run.var(101), 90);
  bool waits = false;
  for (const nc_item& item : run.of(NC_ITEM_SYNC)) waits = waits || (item.u.sync.what & NC_SYNC_MODAL) != 0;
  EXPECT_TRUE(waits);
}

TEST(SystemVariables, CodesBesideACallArePreRead) {  // M700 13.5.5, the example of 22738: #4003 91, #4203 90
  const Outcome run = m700("G90 G1 X100. F1000\nG91 G65 P300 X100. Y100.\nG1 X1.\n#103=#4203\nM02\nO300\n#101=#4003\n#102=#4203\nG#101 X#24 Y#25\nM99");
  EXPECT_EQ(run.var(101), 91);
  EXPECT_EQ(run.var(102), 90);
  EXPECT_EQ(run.var(103), 91);
  EXPECT_EQ(run.path(), (Path{"line 100 0 0 F1000", "line 200 100 0 F1000", "line 201 100 0 F1000"}));
}

TEST(SystemVariables, ProgramNumberOfANameIsBlank) {  // M700 13.5.5 (10.10) note 1
  Bench bench;
  bench.add("12AB", "#100=#4115\nM99");
  bench.add("0123", "#101=#4115\nM99");
  const Outcome run = bench.var(100, 5).run("M98 <12AB>\nM98 <0123>\nM30");
  EXPECT_TRUE(std::isnan(run.var(100)));
  EXPECT_EQ(run.var(101), 123);
}

TEST(SystemVariables, OtherModals) {  // M700 13.5.5 (10.10)
  const Outcome run = m700("O5\nN7 S800 T4 D3 F250 M8 G43 H2\n#107=#4107 #109=#4109 #111=#4111 #113=#4113 #114=#4114\n#115=#4115 #119=#4119 #120=#4120\nM30");
  EXPECT_EQ(run.var(107), 3);
  EXPECT_EQ(run.var(109), 250);
  EXPECT_EQ(run.var(111), 2);
  EXPECT_EQ(run.var(113), 8);
  EXPECT_EQ(run.var(114), 7);
  EXPECT_EQ(run.var(115), 5);
  EXPECT_EQ(run.var(119), 800);
  EXPECT_EQ(run.var(120), 4);
  EXPECT_EQ(m700("F250\nG4 P1\n#100=#4309\nM30").var(100), 250);
  EXPECT_EQ(write_alarm(4001), "P243");
  EXPECT_EQ(read_alarm(4101), "P241");
}

// ---- positions -----------------------------------------------------------------------------------------------------------------------

TEST(SystemVariables, Positions) {  // M700 13.5.5 (10.11)
  Bench bench;
  bench.work_offset(1, {10, 20, 30}).tool(1, 5);
  const Outcome run = bench.run("G43 H1 G0 X1. Y2. Z3.\n#101=#5001 #103=#5003\n#104=#5021 #106=#5023\n#109=#5043\n#110=#5083 #111=#5081\n#112=#5103\nM30");
  EXPECT_EQ(run.var(101), 1);
  EXPECT_EQ(run.var(103), 3);   // end point: without compensation
  EXPECT_EQ(run.var(104), 11);  // machine
  EXPECT_EQ(run.var(106), 38);
  EXPECT_EQ(run.var(109), 8);   // workpiece: with compensation
  EXPECT_EQ(run.var(110), 5);
  EXPECT_EQ(run.var(111), 0);
  EXPECT_EQ(run.var(112), 0);
  EXPECT_EQ(read_alarm(5004), "P241");
  EXPECT_EQ(write_alarm(5001), "P243");
}

TEST(SystemVariables, PositionsInInches) {
  const Outcome run = Bench(NC_DIALECT_M700, axes("XYZc")).run("G0 X25.4 C90.\nG20\n#100=#5001 #101=#5004\n#102=#5021\nM30");
  EXPECT_DOUBLE_EQ(run.var(100), 1);
  EXPECT_EQ(run.var(101), 90);
  EXPECT_DOUBLE_EQ(run.var(102), 1);
}

TEST(SystemVariables, TheMachineIsWhereItReallyIs) {
  Bench bench;
  bench.skip_at = [](const nc_item&) { return 0.5; };
  const Outcome run = bench.run("G31 X10. F1\n#100=#5021\nM30");
  EXPECT_EQ(run.var(100), 5);
}

TEST(SystemVariables, EveryNumberIsReadableOrAnAlarm) {
  // No number gives a meaningless value: one that is not in the tables is P241, one that cannot be read is P243.
  Bench bench;
  for (uint32_t n = 1; n < 20000; n += 7) {
    const Outcome run = bench.run("#500=" + text(n) + "\nM30");
    EXPECT_TRUE(run.alarm.empty() || run.alarm == "P241" || run.alarm == "P243") << n << ' ' << run.alarm;
  }
  EXPECT_EQ(read_alarm(60009), "P241");
  EXPECT_EQ(read_alarm(100003), "P241");
  EXPECT_EQ(read_alarm(4294967295u), "P241");
}

}  // namespace
}  // namespace nc::test
