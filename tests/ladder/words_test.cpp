// SPDX-License-Identifier: Apache-2.0
// Instructions on words: moves, arithmetic, logic, tables, compares, indexed devices, digits of bits.
#include <cstdlib>
#include <functional>
#include <limits>

#include "rig.hpp"

namespace nc::ladder {
namespace {

constexpr std::int32_t kMin16 = -32768, kMax16 = 32767;
constexpr std::int32_t kMin32 = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax32 = std::numeric_limits<std::int32_t>::max();

// Runs one instruction for one scan with these values in D0 and D2 (`wide`: in the pairs); returns the rig.
Rig after(const std::string& instruction, std::int32_t d0 = 0, std::int32_t d2 = 0, bool wide = false) {
  Rig rig("LD SM400\n" + instruction);
  if (wide) {
    rig.set32("D0", d0);
    rig.set32("D2", d2);
  } else {
    rig.set("D0", d0);
    rig.set("D2", d2);
  }
  rig.scan();
  return rig;
}
void expect_failed(const Rig& rig, int code, const char* what) {
  EXPECT_EQ(rig.get("SM0"), 1) << what;
  EXPECT_EQ(rig.get("SD0"), code) << what;
  EXPECT_EQ(rig.get("SD1"), 2) << what;
}
std::int32_t result16(const std::string& instruction, std::int32_t d0, std::int32_t d2 = 0) {
  const Rig rig = after(instruction, d0, d2);
  EXPECT_EQ(rig.get("SM0"), 0) << instruction;
  return rig.get("D4");
}
std::int32_t result32(const std::string& instruction, std::int32_t d0, std::int32_t d2 = 0) {
  const Rig rig = after(instruction, d0, d2, true);
  EXPECT_EQ(rig.get("SM0"), 0) << instruction;
  return rig.get32("D4");
}

TEST(LadderWords, OnlyWhenTheResultIsOn) {
  Rig rig("LD X0\nMOV K5 D0\nINC D1\n+ K1 D2\nRST D3");
  rig.set("D3", 9);
  rig.scan(3);
  EXPECT_EQ(rig.get("D0"), 0);
  EXPECT_EQ(rig.get("D1"), 0);
  EXPECT_EQ(rig.get("D2"), 0);
  EXPECT_EQ(rig.get("D3"), 9);
  rig.set("X0", 1);
  rig.scan(3);
  EXPECT_EQ(rig.get("D0"), 5);
  EXPECT_EQ(rig.get("D1"), 3);
  EXPECT_EQ(rig.get("D2"), 3);
  EXPECT_EQ(rig.get("D3"), 0);
}

TEST(LadderWords, Moves) {
  EXPECT_EQ(result16("MOV K-7 D4", 0), -7);
  EXPECT_EQ(result16("MOV HFFFF D4", 0), -1);
  EXPECT_EQ(result16("MOV D0 D4", 1234), 1234);
  EXPECT_EQ(result32("DMOV K-100000 D4", 0), -100000);
  EXPECT_EQ(result32("DMOV HFFFF0000 D4", 0), -65536);
  EXPECT_EQ(result32("DMOV D0 D4", 7654321), 7654321);
  EXPECT_EQ(result16("CML D0 D4", 0x0f0f), static_cast<std::int16_t>(0xf0f0));
  EXPECT_EQ(result32("DCML D0 D4", 0x0f0f0f0f), ~0x0f0f0f0f);
  Rig rig = after("XCH D0 D2", 3, 4);
  EXPECT_EQ(rig.get("D0"), 4);
  EXPECT_EQ(rig.get("D2"), 3);
  Rig wide = after("DXCH D0 D2", 70000, -80000, true);
  EXPECT_EQ(wide.get32("D0"), -80000);
  EXPECT_EQ(wide.get32("D2"), 70000);
}

TEST(LadderWords, NamedSignalsOfBothWidths) {
  Rig rig(
      "LD SM400\nMOV in16 out16\nDMOV in32 out32\nLDD= in32 out32\nOUT Y0\nLD SM400\nDMOV in32 D10\nRST "
      "out16\nLD X0\nRST out32");
  rig.set("in16", -5);
  rig.set("in32", 1234567);
  rig.scan();
  EXPECT_EQ(rig.get("out16"), 0);
  EXPECT_EQ(rig.get("out32"), 1234567);
  EXPECT_EQ(rig.get32("D10"), 1234567);
  EXPECT_EQ(rig.get("Y0"), 1);
  rig.set("X0", 1);
  rig.scan();
  EXPECT_EQ(rig.get("out32"), 0);
}

TEST(LadderWords, SumsWrap) {
  EXPECT_EQ(result16("+ D0 D2 D4", 30000, 10000), 40000 - 65536);
  EXPECT_EQ(result16("- D0 D2 D4", -30000, 10000), -40000 + 65536);
  EXPECT_EQ(result16("+ D0 K1 D4", kMax16), kMin16);
  EXPECT_EQ(result32("D+ D0 D2 D4", kMax32, 1), kMin32);
  EXPECT_EQ(result32("D- D0 D2 D4", kMin32, 1), kMax32);
  EXPECT_EQ(after("+ K3 D0", 4).get("D0"), 7);
  EXPECT_EQ(after("- K3 D0", 4).get("D0"), 1);
  EXPECT_EQ(after("D+ K3 D0", 400000, 0, true).get32("D0"), 400003);
  EXPECT_EQ(after("D- D2 D0", 400000, 1, true).get32("D0"), 399999);
  EXPECT_EQ(after("INC D0", kMax16).get("D0"), kMin16);
  EXPECT_EQ(after("DEC D0", kMin16).get("D0"), kMax16);
  EXPECT_EQ(after("NEG D0", 5).get("D0"), -5);
  EXPECT_EQ(after("NEG D0", kMin16).get("D0"), kMin16);
  EXPECT_EQ(after("DINC D0", kMax32, 0, true).get32("D0"), kMin32);
  EXPECT_EQ(after("DDEC D0", kMin32, 0, true).get32("D0"), kMax32);
  EXPECT_EQ(after("DNEG D0", 65536, 0, true).get32("D0"), -65536);
}

TEST(LadderWords, ProductsAndQuotients) {
  EXPECT_EQ(after("* D0 D2 D4", -300, 300).get32("D4"), -90000);
  EXPECT_EQ(after("* D0 D2 D4", kMin16, kMin16).get32("D4"), 1 << 30);
  EXPECT_EQ(after("* D0 D2 out32", 300, 300).get("out32"), 90000);
  Rig rig = after("/ D0 D2 D4", -7, 2);
  EXPECT_EQ(rig.get("D4"), -3);
  EXPECT_EQ(rig.get("D5"), -1);
  rig = after("D/ D0 D2 D4", 1000000, 7, true);
  EXPECT_EQ(rig.get32("D4"), 142857);
  EXPECT_EQ(rig.get32("D6"), 1);
  rig = after("D* D0 D2 D4", kMin32, kMin32, true);
  EXPECT_EQ(rig.get32("D4"), 0);
  EXPECT_EQ(rig.get32("D6"), 1 << 30);
}

TEST(LadderWords, WhatCannotBeDoneWritesNothingAndIsReported) {
  struct Case {
    const char* instruction;
    std::int32_t d0, d2;
    bool wide;
    int code;
  };
  for (const Case& c :
       {Case{"/ D0 D2 D4", 5, 0, false, 4100}, Case{"/ D0 D2 D4", kMin16, -1, false, 4100},
        Case{"D/ D0 D2 D4", 5, 0, true, 4100}, Case{"D/ D0 D2 D4", kMin32, -1, true, 4100},
        Case{"BCD D0 D4", 10000, 0, false, 4100}, Case{"BCD D0 D4", -1, 0, false, 4100},
        Case{"DBCD D0 D4", 100000000, 0, true, 4100}, Case{"BIN D0 D4", 0x0a00, 0, false, 4100},
        Case{"DBIN D0 D4", 0x0000000f, 0, true, 4100}, Case{"BSET D4 D0", 16, 0, false, 4100},
        Case{"ROR D4 D0", 16, 0, false, 4100}, Case{"SFL D4 D0", -1, 0, false, 4100},
        Case{"BMOV D8190 D4 D0", 3, 0, false, 4101}, Case{"FMOV K1 D4 D0", -1, 0, false, 4100},
        Case{"FMOV K1 D4 D0", 8189, 0, false, 4101}, Case{"ROTS D0 K1 K1 D4", 0, 0, false, 4100},
        Case{"ROTS K10 D0 K1 D4", 11, 0, false, 4100}, Case{"SER K1 D8190 D4 D0", 3, 0, false, 4101}}) {
    Rig rig("LD SM400\n" + std::string(c.instruction));
    c.wide ? rig.set32("D0", c.d0) : rig.set("D0", c.d0);
    c.wide ? rig.set32("D2", c.d2) : rig.set("D2", c.d2);
    for (int i = 4; i < 8; ++i) rig.set("D" + std::to_string(i), 77);
    rig.scan();
    expect_failed(rig, c.code, c.instruction);
    for (int i = 4; i < 8; ++i) EXPECT_EQ(rig.get("D" + std::to_string(i)), 77) << c.instruction;
  }
}

TEST(LadderWords, TheFirstErrorStaysUntilItIsReset) {
  Rig rig("LD X0\n/ K1 D9 D0\nLD SM400\nBIN D8 D0\nLD X1\nRST SM0");
  rig.set("D8", 0x0a);
  rig.scan();
  EXPECT_EQ(rig.get("SD1"), 4);
  rig.set("X0", 1);
  rig.scan();
  EXPECT_EQ(rig.get("SD1"), 4);
  rig.set("X1", 1);
  rig.scan();
  EXPECT_EQ(rig.get("SM0"), 0);
  rig.set("X1", 0);
  rig.scan();
  EXPECT_EQ(rig.get("SM0"), 1);
  EXPECT_EQ(rig.get("SD1"), 2);
}

TEST(LadderWords, Bcd) {
  EXPECT_EQ(result16("BCD D0 D4", 9999), static_cast<std::int16_t>(0x9999));
  EXPECT_EQ(result16("BCD D0 D4", 1234), 0x1234);
  EXPECT_EQ(result16("BIN D0 D4", static_cast<std::int16_t>(0x9999)), 9999);
  EXPECT_EQ(result16("BIN D0 D4", 0x0042), 42);
  EXPECT_EQ(result32("DBCD D0 D4", 12345678), 0x12345678);
  EXPECT_EQ(result32("DBIN D0 D4", static_cast<std::int32_t>(0x99999999)), 99999999);
}

TEST(LadderWords, LogicAndShifts) {
  EXPECT_EQ(result16("WAND D0 D2 D4", 0x00ff, 0x0f0f), 0x000f);
  EXPECT_EQ(result16("WOR D0 D2 D4", 0x00ff, 0x0f0f), 0x0fff);
  EXPECT_EQ(result16("WXOR D0 D2 D4", 0x00ff, 0x0f0f), 0x0ff0);
  EXPECT_EQ(after("WAND H0F D0", 0x3c).get("D0"), 0x0c);
  EXPECT_EQ(result32("DAND D0 D2 D4", 0x00ff00ff, 0x0f0f0f0f), 0x000f000f);
  EXPECT_EQ(result32("DOR D0 D2 D4", 0x00ff00ff, 0x0f0f0f0f), 0x0fff0fff);
  EXPECT_EQ(result32("DXOR D0 D2 D4", 0x00ff00ff, 0x0f0f0f0f), 0x0ff00ff0);
  struct Case {
    const char* instruction;
    std::int32_t from, to, carry;
  };
  for (const Case& c :
       {Case{"ROR D0 K1", 1, kMin16, 1}, Case{"ROL D0 K1", kMin16, 1, 1},
        Case{"ROR D0 K4", 0x1230, 0x0123, 0}, Case{"ROL D0 K4", 0x1230, 0x2301, 1},
        Case{"SFR D0 K1", -1, kMax16, 1}, Case{"SFL D0 K15", 3, kMin16, 1},
        Case{"SFR D0 K4", 0x1230, 0x0123, 0}, Case{"SFL D0 K0", 5, 5, 0}, Case{"BSET D0 K15", 0, kMin16, 0},
        Case{"BRST D0 K15", -1, kMax16, 0}, Case{"BSET D0 K3", 1, 9, 0}}) {
    const Rig rig = after(c.instruction, c.from);
    EXPECT_EQ(rig.get("D0"), c.to) << c.instruction;
    EXPECT_EQ(rig.get("SM700"), c.carry) << c.instruction;
  }
  EXPECT_EQ(after("DROR D0 K4", 0x12345678, 0, true).get32("D0"), static_cast<std::int32_t>(0x81234567));
  EXPECT_EQ(after("DROL D0 K4", 0x12345678, 0, true).get32("D0"), 0x23456781);
}

TEST(LadderWords, Rows) {
  Rig rig("LD X0\nFMOV K7 D10 K5\nBMOV D10 D12 K5\nLD X1\nZRST D10 D13\nZRST M5 M6\nZRST T3 T4\nZRST C1 C1");
  rig.set("D17", 99);
  rig.set("D10", 1);
  rig.set("X0", 1);
  rig.scan();
  for (int i = 10; i <= 16; ++i) EXPECT_EQ(rig.get("D" + std::to_string(i)), 7) << i;
  EXPECT_EQ(rig.get("D17"), 99);
  EXPECT_EQ(rig.get("D9"), 0);
  rig.set("X0", 0);
  rig.set("X1", 1);
  for (const char* name : {"M4", "M5", "M6", "M7", "T2", "T3", "T4", "T5", "TN3", "C0", "C1", "CN1"})
    rig.set(name, 1);
  rig.scan();
  for (const char* name : {"D10", "D13", "M5", "M6", "T3", "T4", "TN3", "C1", "CN1"})
    EXPECT_EQ(rig.get(name), 0) << name;
  for (const char* name : {"M4", "M7", "T2", "T5", "C0"}) EXPECT_EQ(rig.get(name), 1) << name;
  EXPECT_EQ(rig.get("D14"), 7);
}

TEST(LadderWords, OverlappingRowsMoveWhole) {
  Rig rig("LD SM400\nBMOV D0 D1 K4");
  for (int i = 0; i < 4; ++i) rig.set("D" + std::to_string(i), i + 1);
  rig.scan();
  for (int i = 0; i < 4; ++i) EXPECT_EQ(rig.get("D" + std::to_string(i + 1)), i + 1);
}

TEST(LadderWords, IndexedDevices) {
  Rig rig(
      "LD SM400\nMOV D0Z1 D100\nMOV K5 D10Z2\nINC D20Z1\nDMOV K70000 D30Z1\nLD= D0Z1 K42\nOUT Y0\nLD "
      "SM400\nOUTHS T0 D0Z1");
  rig.set("Z1", 3);
  rig.set("Z2", -2);
  rig.set("D3", 42);
  rig.scan();
  EXPECT_EQ(rig.get("D100"), 42);
  EXPECT_EQ(rig.get("D8"), 5);
  EXPECT_EQ(rig.get("D23"), 1);
  EXPECT_EQ(rig.get32("D33"), 70000);
  EXPECT_EQ(rig.get("Y0"), 1);
  EXPECT_EQ(rig.get("SM0"), 0);
}

TEST(LadderWords, AnIndexOutsideItsDevicesIsAnError) {
  for (const int z : {-1, 8192, 32767, -32768}) {
    Rig rig("LD SM400\nMOV K5 D0Z0\nLD= D0Z0 K0\nOUT Y0");
    rig.set("Z0", z);
    const DeviceImage before = rig.image;
    rig.scan();
    expect_failed(rig, 4101, "MOV K5 D0Z0");
    EXPECT_EQ(rig.get("Y0"), 0);
    EXPECT_EQ(rig.get("D8191"), 0);
  }
  Rig pair("LD SM400\nDMOV K5 D0Z0");
  pair.set("Z0", 8191);
  pair.scan();
  expect_failed(pair, 4101, "DMOV K5 D0Z0");
}

TEST(LadderWords, DigitsOfBits) {
  Rig rig("LD SM400\nMOV K2M10 D0\nMOV K4M10 D1\nDMOV K8M10 D2\nMOV D4 K1M100\nDMOV D6 K8L0\nMOV H0 K1M200");
  rig.set("M10", 1);
  rig.set("M15", 1);
  rig.set("M18", 1);
  rig.set("M25", 1);
  rig.set("M41", 1);
  rig.set("D4", 0x1ff5);
  rig.set32("D6", static_cast<std::int32_t>(0x80000001));
  rig.set("M203", 1);
  rig.set("M204", 1);
  rig.scan();
  EXPECT_EQ(rig.get("D0"), 0x21);
  EXPECT_EQ(rig.get("D1"), static_cast<std::int16_t>(0x8121));
  EXPECT_EQ(rig.get32("D2"), static_cast<std::int32_t>(0x80008121));
  EXPECT_EQ(rig.get("M100"), 1);
  EXPECT_EQ(rig.get("M101"), 0);
  EXPECT_EQ(rig.get("M102"), 1);
  EXPECT_EQ(rig.get("M103"), 0);
  EXPECT_EQ(rig.get("M104"), 0);
  EXPECT_EQ(rig.get("L0"), 1);
  EXPECT_EQ(rig.get("L31"), 1);
  EXPECT_EQ(rig.get("L30"), 0);
  EXPECT_EQ(rig.get("M203"), 0);
  EXPECT_EQ(rig.get("M204"), 1);
}

TEST(LadderWords, SearchInATable) {
  Rig rig("LD SM400\nSER D0 D10 D100 K6\nDSER K70000 D20 D102 K3");
  const int row[] = {4, 9, 7, 9, 9, 1};
  for (int i = 0; i < 6; ++i) rig.set("D" + std::to_string(10 + i), row[i]);
  rig.set32("D22", 70000);
  rig.set("D0", 9);
  rig.scan();
  EXPECT_EQ(rig.get("D100"), 2);
  EXPECT_EQ(rig.get("D101"), 3);
  EXPECT_EQ(rig.get("D102"), 2);
  EXPECT_EQ(rig.get("D103"), 1);
  rig.set("D0", 5);
  rig.scan();
  EXPECT_EQ(rig.get("D100"), 0);
  EXPECT_EQ(rig.get("D101"), 0);
}

TEST(LadderWords, ShortestWayOfATurret) {
  for (int places = 1; places <= 13; ++places)
    for (int from = 1; from <= places; ++from)
      for (int to = 1; to <= places; ++to) {
        Rig rig("LD SM400\nROTS D0 D1 D2 D3");
        rig.set("D0", places);
        rig.set("D1", from);
        rig.set("D2", to);
        rig.scan();
        const int way = rig.get("D3");
        EXPECT_EQ((from - 1 + way + places) % places, to - 1);
        EXPECT_LE(2 * std::abs(way), places);
        if (2 * std::abs(way) == places) {
          EXPECT_GT(way, 0);
        }
      }
}

TEST(LadderWords, Compares) {
  struct Relation {
    const char* sign;
    std::function<bool(std::int32_t, std::int32_t)> holds;
  };
  const Relation relations[] = {{"=", std::equal_to<>()}, {"<>", std::not_equal_to<>()},
                                {">", std::greater<>()},  {"<=", std::less_equal<>()},
                                {"<", std::less<>()},     {">=", std::greater_equal<>()}};
  for (const Relation& relation : relations)
    for (const bool wide : {false, true}) {
      const std::string sign = (wide ? "D" : "") + std::string(relation.sign);
      Rig rig("LD" + sign + " D0 D2\nOUT Y0\nLD X0\nAND" + sign + " D0 D2\nOUT Y1\nLD X1\nOR" + sign +
              " D0 D2\nOUT Y2\n" + "LD X0\nLD" + sign + " D0 D2\nANB\nOUT Y3\n");
      const std::int32_t values16[] = {kMin16, -1, 0, 1, kMax16};
      const std::int32_t values32[] = {kMin32, -65536, 0, 65535, kMax32};
      for (const std::int32_t left : wide ? values32 : values16)
        for (const std::int32_t right : wide ? values32 : values16)
          for (const int x : {0, 1}) {
            rig.set("X0", x);
            rig.set("X1", x);
            wide ? rig.set32("D0", left) : rig.set("D0", left);
            wide ? rig.set32("D2", right) : rig.set("D2", right);
            rig.scan();
            const bool holds = relation.holds(left, right);
            ASSERT_EQ(rig.get("Y0"), holds) << sign << left << " " << right;
            ASSERT_EQ(rig.get("Y1"), holds && x) << sign << left << " " << right;
            ASSERT_EQ(rig.get("Y2"), holds || x) << sign << left << " " << right;
            ASSERT_EQ(rig.get("Y3"), holds && x) << sign << left << " " << right;
          }
    }
}

}  // namespace
}  // namespace nc::ladder
