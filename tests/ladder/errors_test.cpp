// SPDX-License-Identifier: Apache-2.0
// Every error of a program, with file, line and instruction.
#include <algorithm>

#include "rig.hpp"

namespace nc::ladder {
namespace {

struct Bad {
  const char* text;
  unsigned line;
  const char* instruction;
  const char* message;  // part of it
};

const Bad kBad[] = {
    // names
    {"FOO X0", 1, "FOO X0", "no such instruction"},
    {"LDX X0", 1, "LDX X0", "no such instruction"},
    {"OUTP Y0", 1, "OUTP Y0", "no such instruction"},
    {"LD X0\nOUT Y99", 2, "OUT Y99", "no such device"},
    {"LD X9\nOUT Y0", 1, "LD X9", "no such device"},
    {"LD nc.m_strob\nOUT Y0", 1, "LD nc.m_strob", "did you mean 'nc.m_strobe'?"},
    {"LD m5\nOUT Y0", 1, "LD m5", "did you mean 'M5'?"},
    {"LD M8192\nOUT Y0", 1, "LD M8192", "M0 to M8191"},
    {"LD L2048\nOUT Y0", 1, "LD L2048", "L0 to L2047"},
    {"LD M99999999999\nOUT Y0", 1, "LD M99999999999", "M0 to M8191"},
    {"LD SM5\nOUT Y0", 1, "LD SM5", "SM400"},
    {"LD T512\nOUT Y0", 1, "LD T512", "T0 to T511"},
    {"LD SM400\nMOV K1 Z16", 2, "MOV K1 Z16", "Z0 to Z15"},
    {"LD SM400\nMOV K1 D8192", 2, "MOV K1 D8192", "D0 to D8191"},
    // what other controllers of the family have
    {"LD X0\nE+ D0 D2 D4", 2, "E+ D0 D2 D4", "not supported: there are no real numbers"},
    {"LD X0\nEMOVP E1.5 D0", 2, "EMOVP E1.5 D0", "not supported: there are no real numbers"},
    {"LD X0\nED+ D0 D4 D8", 2, "ED+ D0 D4 D8", "not supported: there are no real numbers"},
    {"LD X0\nMOV K1.5 D0", 2, "MOV K1.5 D0", "there are no real numbers"},
    {"LD X0\nMOV K+-5 D0", 2, "MOV K+-5 D0", "no such device"},
    {"LDE>= D0 D2\nOUT Y0", 1, "LDE>= D0 D2", "not supported: there are no real numbers"},
    {"LD X0\nDFLT D0 D2", 2, "DFLT D0 D2", "D+ D- D* D/"},
    {"LD X0\nOUT LC0 K5", 2, "OUT LC0 K5", "16 bits here; for 32 bits count with DINCP"},
    {"LD X0\nOUT C0 K40000", 2, "OUT C0 K40000", "from K0 to K32767; for more count in 32 bits, with DINCP"},
    {"LD X0\nUDCNT1 X0 C0 K5", 2, "UDCNT1 X0 C0 K5", "not supported: there is no counter up and down"},
    {"LD V0\nOUT Y0", 1, "LD V0", "edge relays"},
    {"LD X0\nMOV R100 D0", 2, "MOV R100 D0", "no file registers"},
    {"EI", 1, "EI", "not supported: there are no interrupt programs"},
    {"STL S20", 1, "STL S20", "not supported: there are no step ladders"},
    // number of operands
    {"LD\nOUT Y0", 1, "LD", "operands: bit"},
    {"LD X0 X1\nOUT Y0", 1, "LD X0 X1", "operands: bit"},
    {"LD X0\nMOV K1", 2, "MOV K1", "operands: s d"},
    {"LD X0\n+ K1", 2, "+ K1", "operands: s d | s1 s2 d"},
    {"LD X0\nLD X1\nANB X0\nOUT Y0", 3, "ANB X0", "no operand"},
    {"LD X0\nOUT Y0 K5", 2, "OUT Y0 K5", "operands:"},
    {"ALIAS X10", 1, "ALIAS X10", "operands: name device"},
    // direction and type
    {"LD X0\nOUT X1", 2, "OUT X1", "read-only"},
    {"LD X0\nSET X1", 2, "SET X1", "read-only"},
    {"LD X0\nPLS X1", 2, "PLS X1", "read-only"},
    {"LD X0\nRST X1", 2, "RST X1", "read-only"},
    {"LD X0\nMC N0 X1\nMCR N0", 2, "MC N0 X1", "read-only"},
    {"LD X0\nMOV K1 in16", 2, "MOV K1 in16", "read-only"},
    {"LD X0\nDMOV K1 in32", 2, "DMOV K1 in32", "read-only"},
    {"LD X0\n+ K1 in16", 2, "+ K1 in16", "read-only"},
    {"LD X0\nRST in32", 2, "RST in32", "read-only"},
    {"LD X0\nBMOV D0 in16 K1", 2, "BMOV D0 in16 K1", "read-only"},
    {"LD X0\nOUT SM400", 2, "OUT SM400", "read-only"},
    {"LD X0\nSET T0", 2, "SET T0", "contact of a timer or counter"},
    {"LD X0\nMOV in32 D0", 2, "MOV in32 D0", "32 bits; use the D form DMOV"},
    {"LD X0\nWAND in32 D0", 2, "WAND in32 D0", "32 bits; use the D form DAND"},
    {"LD= in32 K1\nOUT Y0", 1, "LD= in32 K1", "use the D form LDD="},
    {"LD X0\nAND<> in32 K1\nOUT Y0", 2, "AND<> in32 K1", "use the D form ANDD<>"},
    {"LD X0\nDMOV in16 D0", 2, "DMOV in16 D0", "16 bits; use the 16-bit form MOV"},
    {"LD X0\nDMOV D0 out16", 2, "DMOV D0 out16", "16 bits; use the 16-bit form MOV"},
    {"LD X0\nDAND in16 D0", 2, "DAND in16 D0", "use the 16-bit form WAND"},
    {"LDD= in16 K1\nOUT Y0", 1, "LDD= in16 K1", "use the 16-bit form LD="},
    {"LD X0\nDMOV T0 D0", 2, "DMOV T0 D0", "16 bits"},
    {"LD X0\nMOV X1 D0", 2, "MOV X1 D0", "is a bit; a word is needed"},
    {"LD D0\nOUT Y0", 1, "LD D0", "is a word; a bit is needed"},
    {"LD X0\nOUT D0", 2, "OUT D0", "is a word; a bit is needed"},
    {"LD X0\nMOV D0 K5", 2, "MOV D0 K5", "cannot be a destination"},
    {"LD K5\nOUT Y0", 1, "LD K5", "no bit"},
    {"LD X0\nBMOV K1 D0 K1", 2, "BMOV K1 D0 K1", "a row of words"},
    {"LD X0\n/ D0 D1 out16", 2, "/ D0 D1 out16", "takes 2 words"},
    {"LD X0\nD* D0 D2 out32", 2, "D* D0 D2 out32", "takes 4 words"},
    {"LD X0\n* D0 D2 out16", 2, "* D0 D2 out16", "has 16 bits"},
    {"LD X0\nDMOV K1 D8191", 2, "DMOV K1 D8191", "second of the two words"},
    {"LD X0\n/ K1 K1 D8191", 2, "/ K1 K1 D8191", "does not exist"},
    // constants
    {"LD X0\nMOV K32768 D0", 2, "MOV K32768 D0", "K is from -32768 to 32767; use the D form DMOV"},
    {"LD X0\nMOV K-32769 D0", 2, "MOV K-32769 D0", "K is from"},
    {"LD X0\nMOV H10000 D0", 2, "MOV H10000 D0", "FFFF"},
    {"LD X0\nDMOV K2147483648 D0", 2, "DMOV K2147483648 D0", "K is from"},
    {"LD X0\nDMOV H100000000 D0", 2, "DMOV H100000000 D0", "FFFFFFFF"},
    {"LD X0\nDMOV K99999999999999999999 D0", 2, "DMOV K99999999999999999999 D0", "out of range"},
    {"LD X0\nMOV E1.5 D0", 2, "MOV E1.5 D0", "no real numbers"},
    {"LD X0\nMOV K1X D0", 2, "MOV K1X D0", "no such device"},
    {"LD X0\nMOV K5M0 D0", 2, "MOV K5M0 D0", "K1 to K4"},
    {"LD X0\nDMOV K9M0 D0", 2, "DMOV K9M0 D0", "K1 to K8"},
    {"LD X0\nMOV K4M8180 D0", 2, "MOV K4M8180 D0", "does not exist"},
    {"LD X0\nMOV K1X0 D0", 2, "MOV K1X0 D0", "of M or L"},
    {"LD X0\nMOV out16Z1 D0", 2, "MOV out16Z1 D0", "can be indexed"},
    {"LD X0\nMOV D0Z16 D0", 2, "MOV D0Z16 D0", "Z0 to Z15"},
    // timers and counters
    {"LD X0\nOUT T0", 2, "OUT T0", "needs its set value"},
    {"LD X0\nOUT C0", 2, "OUT C0", "needs its set value"},
    {"LD X0\nOUT T0 10", 2, "OUT T0 10", "no such device '10': constants are K"},
    {"LD X0\nMOV -5 D0", 2, "MOV -5 D0", "such as K10 or H1F"},
    {"LD X0\nOUT T0 K-1", 2, "OUT T0 K-1", "K0 to K32767"},
    {"LD X0\nOUT C0 K-1", 2, "OUT C0 K-1", "K0 to K32767"},
    {"LD X0\nOUT T0 X1", 2, "OUT T0 X1", "is a bit; a word is needed"},
    {"LD X0\nOUTH C0 K5", 2, "OUTH C0 K5", "is no timer"},
    {"LD X0\nOUTHS Y0 K5", 2, "OUTHS Y0 K5", "is no timer"},
    // rungs
    {"OUT Y0", 1, "OUT Y0", "begins with LD"},
    {"AND X0\nOUT Y0", 1, "AND X0", "begins with LD"},
    {"INV", 1, "INV", "begins with LD"},
    {"MOV K1 D0", 1, "MOV K1 D0", "begins with LD"},
    {"LD X0\nLD X1\nOUT Y0", 3, "OUT Y0", "ANB or ORB is missing"},
    {"LD X0\nANB\nOUT Y0", 2, "ANB", "no two blocks"},
    {"LD X0\nOUT Y0\nORB", 3, "ORB", "no two blocks"},
    {"LD X0\nOUT Y0\nOR X1\nOUT Y1", 3, "OR X1", "a parallel contact cannot follow"},
    {"LD X0\nMPS\nOR X1\nOUT Y0\nMPP\nOUT Y1", 3, "OR X1", "a parallel contact cannot follow"},
    {"LD X0\nMPS\nLD X1\nORB\nOUT Y0\nMPP\nOUT Y1", 4, "ORB", "a parallel block cannot follow"},
    {"LD X0\nMRD\nOUT Y0", 2, "MRD", "no MPS"},
    {"LD X0\nMPP\nOUT Y0", 2, "MPP", "no MPS"},
    {"LD X0\nMPS\nOUT Y0\nLD X1\nOUT Y1", 5, "OUT Y1", "line 2 has no MPP"},
    {"LD X0\nMPS\nOUT Y0\nEND", 4, "END", "line 2 has no MPP"},
    {"LD X0\nMPS\nAND X1\nMPP\nOUT Y0", 4, "MPP", "not used"},
    {"LD X0\nEND", 2, "END", "is not used"},
    {"LD X0\nP1", 2, "P1", "is not used"},
    // flow
    {"LD X0\nCJ P7", 2, "CJ P7", "no label P7"},
    {"LD X0\nCJ 7", 2, "CJ 7", "P0 to P4095"},
    {"P4096", 1, "P4096", "P0 to P4095"},
    {"P1\nP1", 2, "P1", "in line 1 already"},
    {"CJ P1\nP1", 1, "CJ P1", "begins with LD"},
    {"LD X0\nCALL P1\nP1\nFEND", 2, "CALL P1", "behind FEND"},
    {"LD X0\nCJ P1\nFEND\nP1\nRET", 2, "CJ P1", "cross FEND"},
    {"RET", 1, "RET", "behind FEND"},
    {"FEND\nFEND", 2, "FEND", "FEND before it"},
    {"FOR K3", 1, "FOR K3", "NEXT is missing"},
    {"NEXT", 1, "NEXT", "no FOR"},
    {"FOR X0\nNEXT", 1, "FOR X0", "is a bit"},
    {"LD X0\nCJ P1\nFOR K3\nP1\nNEXT", 2, "CJ P1", "into FOR and NEXT"},
    {"FOR K1\nP1\nNEXT\nFOR K1\nLD X0\nCJ P1\nNEXT", 6, "CJ P1", "into FOR and NEXT"},
    {"LD X0\nCALL P1\nFEND\nFOR K2\nP1\nNEXT\nRET", 2, "CALL P1", "inside FOR"},
    {"LD X0\nMC N0 M0", 2, "MC N0 M0", "MCR is missing"},
    {"LD X0\nMC N0 M0\nFEND\nMCR N0", 2, "MC N0 M0", "MCR is missing"},
    {"MCR N0", 1, "MCR N0", "no MC N0"},
    {"LD X0\nMC N15 M0", 2, "MC N15 M0", "N0 to N14"},
    {"LD X0\nMC N1 M0\nLD X1\nMC N0 M1\nMCR N1", 4, "MC N0 M1", "higher N"},
    {"LD X0\nZRST D0 M5", 2, "ZRST D0 M5", "one kind"},
    {"LD X0\nZRST D5 D0", 2, "ZRST D5 D0", "in this order"},
    {"LD X0\nZRST Y0 Y3", 2, "ZRST Y0 Y3", "one kind"},
    {"LD X0\nZRST SM0 SM400", 2, "ZRST SM0 SM400", "one kind"},
    // aliases
    {"ALIAS X10 nothing", 1, "ALIAS X10 nothing", "no such device"},
    {"ALIAS M5 door_closed", 1, "ALIAS M5 door_closed", "a device already"},
    {"ALIAS X0 door_closed", 1, "ALIAS X0 door_closed", "a device already"},
    {"ALIAS M9999 door_closed", 1, "ALIAS M9999 door_closed", "a device already"},
    {"ALIAS a door_closed\nALIAS a X0", 2, "ALIAS a X0", "a device already"},
    {"ALIAS K10 door_closed", 1, "ALIAS K10 door_closed", "is a constant"},
    {"ALIAS a/b door_closed", 1, "ALIAS a/b door_closed", "a name consists of"},
};

TEST(LadderErrors, EachWithFileLineAndInstruction) {
  for (const Bad& bad : kBad) {
    const std::vector<Error> errors = errors_of(bad.text);
    const bool found = std::any_of(errors.begin(), errors.end(), [&](const Error& error) {
      return error.file == "test.il" && error.line == bad.line && error.instruction == bad.instruction &&
             error.message.find(bad.message) != std::string::npos;
    });
    EXPECT_TRUE(found) << bad.text << "\n-> " << all_text(errors);
    EXPECT_LE(errors.size(), 2u) << bad.text << "\n-> " << all_text(errors);
  }
}

TEST(LadderErrors, Text) {
  const std::vector<Error> errors = errors_of("  \n\tLD  X0 ; start\r\n OUT\tY99   // lamp\r\n");
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].text().find("test.il:3: OUT Y99: no such device"), 0u) << errors[0].text();
}

TEST(LadderErrors, AllAreReported) {
  const std::vector<Error> errors =
      errors_of("LD X99\nOUT Y0\nBAD\nLD X0\nMOV in32 D0\nCJ P1\nLD X1\nOUT X2");
  ASSERT_EQ(errors.size(), 5u) << all_text(errors);
}

TEST(LadderErrors, NotWithoutEnd) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "BAD\n";
  const std::vector<Error> errors = errors_of(text);
  EXPECT_EQ(errors.size(), kMaxErrors + 1);
  EXPECT_EQ(errors.back().line, 0u);
}

TEST(LadderErrors, LimitsOfSize) {
  std::string text;
  for (unsigned i = 0; i <= kMaxInstructions; ++i) text += "NOP\n";
  EXPECT_NE(all_text(errors_of(text)).find("more than 100000 instructions"), std::string::npos);
  EXPECT_NE(all_text(errors_of(std::string(kMaxTextBytes + 1, ' '))).find("bytes"), std::string::npos);
  text = "LD X0\n";
  for (int i = 0; i < 100; ++i) text += "LD X0\n";
  EXPECT_NE(all_text(errors_of(text)).find("60 blocks"), std::string::npos);
  text = "LD X0\n";
  for (int i = 0; i < 40; ++i) text += "MPS\n";
  EXPECT_NE(all_text(errors_of(text)).find("32 branches"), std::string::npos);
  text.clear();
  for (int i = 0; i < 20; ++i) text += "FOR K1\n";
  EXPECT_NE(all_text(errors_of(text)).find("16 loops"), std::string::npos);
}

TEST(LadderErrors, Options) {
  CompileOptions options;
  for (const double period : {0.0, -1.0, 1e-9, 2.0, 0.0 / 0.0}) {
    options.scan_s = period;
    EXPECT_NE(all_text(errors_of("", options)).find("period"), std::string::npos) << period;
  }
  options = {};
  options.retain_d_first = 8000;
  options.retain_d_count = 193;
  EXPECT_NE(all_text(errors_of("", options)).find("retained"), std::string::npos);
}

TEST(LadderErrors, ControlCharactersAreNotShown) {
  const std::vector<Error> errors = errors_of(std::string("LD \x1b[31m\x01X0\nOUT Y0\n"));
  ASSERT_EQ(errors.size(), 1u);
  for (const char c : errors[0].text()) EXPECT_GE(static_cast<unsigned char>(c), 0x20);
}

TEST(LadderErrors, WhatIsNoTextIsSaidOnce) {
  const std::vector<Error> errors = errors_of(std::string("LD X0\nOUT Y0\nL\0D\0 \0X\0", 21));
  ASSERT_EQ(errors.size(), 1u) << all_text(errors);
  EXPECT_EQ(errors[0].line, 3u);
  EXPECT_NE(errors[0].message.find("not in UTF-16"), std::string::npos);
}

TEST(LadderErrors, ALongLineIsShownByItsBegin) {
  std::string text = "LD";
  for (int i = 0; i < 100000; ++i) text += " M0";
  const std::vector<Error> errors = errors_of(text);
  ASSERT_FALSE(errors.empty());
  EXPECT_LT(errors[0].text().size(), 300u);
}

TEST(LadderText, CommentsCaseAndSeparators) {
  Rig rig(
      "\xef\xbb\xbfld x_in ; contact\n"
      "Out Y0,\t// coil\n"
      "mov K5,D0\n"
      "LD X0\r\n/ K7 K2 D2 // quotient\r\n",
      [] {
        DeviceTable table = test_table();
        table.add("x_in", DeviceType::kBit, false);
        return table;
      }());
  rig.set("x_in", 1);
  rig.set("X0", 1);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 1);
  EXPECT_EQ(rig.get("D0"), 5);
  EXPECT_EQ(rig.get("D2"), 3);
  EXPECT_EQ(rig.program().instruction_count(), 5u);
}

TEST(LadderText, AliasesNameTheSameDevice) {
  Rig rig(
      "ALIAS X10 door_closed\nALIAS Y10 plc.fin1\nALIAS R100 D50\nALIAS again X10\nLD X10\nAND again\nOUT "
      "Y10\nMOV K3 R100");
  rig.set("door_closed", 1);
  rig.scan();
  EXPECT_EQ(rig.get("plc.fin1"), 1);
  EXPECT_EQ(rig.get("D50"), 3);
  EXPECT_EQ(rig.get("R100"), 3);
  EXPECT_EQ(rig.get("X10"), 1);
  EXPECT_EQ(rig.engine().find("nothing"), nullptr);
  EXPECT_EQ(rig.engine().find("M8192"), nullptr);
  EXPECT_EQ(rig.device("T0").type, DeviceType::kBit);
  EXPECT_EQ(rig.device("TN0").type, DeviceType::kWord16);
}

}  // namespace
}  // namespace nc::ladder
