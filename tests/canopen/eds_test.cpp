// SPDX-License-Identifier: Apache-2.0
// Electronic data sheets (EDS) of drives: what is read from them, and which parts of a configuration they show to be impossible.
#include "hal/canopen/eds.hpp"

#include <gtest/gtest.h>

namespace {

using namespace nc::hal::canopen;

std::string object(const char* name, unsigned type, const char* access, int mappable) {
  char text[200];
  std::snprintf(text, sizeof text, "[%s]\nParameterName=x\nObjectType=0x7\nDataType=0x%04X\nAccessType=%s\nPDOMapping=%d\n", name, type, access, mappable);
  return text;
}

// A data sheet with all objects that an axis needs.
std::string good_eds() {
  std::string text = "; a drive\n[DeviceInfo]\nVendorNumber=0x1234\nProductNumber=22136\n";
  text += object("6040", 6, "rww", 1) + object("607A", 4, "rw", 1) + object("6041", 6, "ro", 1) + object("6064", 4, "ro", 1);
  text += object("6060", 2, "rw", 0) + object("6061", 2, "ro", 0) + object("60B8", 6, "rw", 1) + object("60B9", 6, "ro", 1) + object("60BA", 4, "ro", 1);
  text += "[60C2]\nObjectType=0x9\nSubNumber=3\n" + object("60C2sub1", 5, "rw", 0) + object("60C2sub2", 2, "rw", 0);
  text += object("1600sub0", 5, "rw", 0) + object("1A00sub0", 5, "rw", 0) + object("1A01sub0", 5, "rw", 0);
  return text;
}
NodeMap node() {
  NodeMap made;
  made.axes.emplace_back();
  return made;
}
std::vector<std::string> wrong(const std::string& text, const NodeMap& map = node()) {
  Eds eds;
  std::vector<EdsError> errors = read_eds(text, &eds);
  if (errors.empty()) errors = check_eds(eds, map);
  std::vector<std::string> texts;
  for (const EdsError& error : errors) texts.push_back(std::to_string(error.line) + ": " + error.text);
  return texts;
}
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Eds, ADriveThatFitsHasNothingWrong) {
  EXPECT_TRUE(wrong(good_eds()).empty());
  Eds eds;
  EXPECT_TRUE(read_eds(good_eds(), &eds).empty());
  EXPECT_EQ(eds.vendor, 0x1234u);
  EXPECT_EQ(eds.product, 22136u);
  ASSERT_NE(eds.find(0x607A, 0), nullptr);
  EXPECT_EQ(eds.find(0x607A, 0)->bits, 32u);
  EXPECT_EQ(eds.find(0x607A, 0)->line, 11u);
  EXPECT_EQ(eds.find(0x60C2, 0), nullptr);  // the heading of a record
  EXPECT_NE(eds.find(0x60C2, 1), nullptr);
}

TEST(Eds, CarriageReturnsCapitalsAndSpacesMeanNothing) {
  std::string text = good_eds(), windows;
  for (const char c : replaced(text, "DataType=0x0004", " datatype = 0x4 ")) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_TRUE(wrong(windows).empty());
}

TEST(Eds, WhatCannotBeMappedIsNamedWithItsLine) {
  EXPECT_EQ(wrong(replaced(good_eds(), object("607A", 4, "rw", 1), object("607A", 4, "rw", 0))), std::vector<std::string>{"11: 607Ah:0 cannot be mapped into a PDO (PDOMapping)"});
  EXPECT_EQ(wrong(replaced(good_eds(), object("6064", 4, "ro", 1), object("6064", 3, "ro", 1))), std::vector<std::string>{"23: 6064h:0 has 16 bits, not 32 (DataType)"});
  EXPECT_EQ(wrong(replaced(good_eds(), object("607A", 4, "rw", 1), object("607A", 4, "ro", 1))), std::vector<std::string>{"11: 607Ah:0 cannot be written (AccessType=ro)"});
  EXPECT_EQ(wrong(replaced(good_eds(), object("6041", 6, "ro", 1), "")), std::vector<std::string>{"0: 6041h:0 does not exist in this drive"});
}

TEST(Eds, WhatAnAxisNeedsBesidesIsLookedFor) {
  NodeMap map = node();
  map.axes[0].homing_method = 17;
  EXPECT_EQ(wrong(good_eds(), map).size(), 3u);  // 6098h, 6099h:1 and :2
  const std::string homes = good_eds() + object("6098", 2, "rw", 0) + object("6099sub1", 7, "rw", 0) + object("6099sub2", 7, "rw", 0);
  EXPECT_TRUE(wrong(homes, map).empty());
  map.axes[0].homing_acceleration = 100;
  EXPECT_EQ(wrong(homes, map), std::vector<std::string>{"0: 609Ah:0 does not exist in this drive"});
  EXPECT_TRUE(wrong(homes + object("609A", 7, "rw", 0) + object("607C", 4, "rw", 0), map).empty());
  EXPECT_EQ(wrong(homes + object("609A", 7, "rw", 0) + object("607C", 4, "const", 0), map).size(), 1u) << "what it is set to may be another value than 0";
  map = node();
  map.axes[0].slot = 1;
  EXPECT_EQ(wrong(good_eds(), map).front(), "0: 6840h:0 does not exist in this drive");
  map = node();
  map.axes[0].skip_signal = 1;
  EXPECT_TRUE(wrong(good_eds(), map).empty());
  map.axes[0].skip_falling = true;
  EXPECT_EQ(wrong(good_eds(), map), std::vector<std::string>{"0: 60BBh:0 does not exist in this drive"});
  map = node();
  map.objects.push_back({0x6060, 0, 4, 8});
  EXPECT_EQ(wrong(good_eds(), map).size(), 1u);
  map = node();
  map.vendor = 0x999;
  EXPECT_EQ(wrong(good_eds(), map), std::vector<std::string>{"0: is of another vendor (VendorNumber) than the drive is to be"});
}

TEST(Eds, ACompactArrayHasItsSubIndices) {
  Eds eds;
  EXPECT_TRUE(read_eds("[2000]\nObjectType=0x8\nDataType=0x0007\nAccessType=rw\nPDOMapping=1\nCompactSubObj=3\n", &eds).empty());
  ASSERT_NE(eds.find(0x2000, 3), nullptr);
  EXPECT_EQ(eds.find(0x2000, 3)->bits, 32u);
  EXPECT_EQ(eds.find(0x2000, 0)->bits, 8u);
  EXPECT_EQ(eds.find(0x2000, 4), nullptr);
}

TEST(Eds, ASubIndexIsHexadecimal) {  // as CiA 306 writes it, without 0x
  Eds eds;
  EXPECT_TRUE(read_eds(object("2000subA", 4, "rw", 1) + object("2000sub10", 6, "rw", 1), &eds).empty());
  ASSERT_NE(eds.find(0x2000, 10), nullptr);
  EXPECT_EQ(eds.find(0x2000, 10)->bits, 32u);
  ASSERT_NE(eds.find(0x2000, 16), nullptr);
  EXPECT_EQ(eds.find(0x2000, 16)->bits, 16u);
}

TEST(Eds, MarksOfEncodingAndCommentsBehindANumberMeanNothing) {
  EXPECT_TRUE(wrong("\xEF\xBB\xBF" + good_eds()).empty());
  EXPECT_TRUE(wrong("\xEF\xBB\xBF" + replaced(good_eds(), "; a drive\n", "")).empty());
  EXPECT_TRUE(wrong(replaced(good_eds(), "DataType=0x0004", "DataType=0x0004 ; INTEGER32")).empty());
}

// CiA 306: PDOs of a drive with many of them need no sections.
TEST(Eds, CompactPdosAreThere) {
  std::string text = good_eds();
  for (const char* name : {"1600sub0", "1A00sub0", "1A01sub0"}) text = replaced(text, object(name, 5, "rw", 0), "");
  EXPECT_EQ(wrong(text).size(), 2u);
  const auto with = [&](const char* keys) { return replaced(text, "[DeviceInfo]\n", std::string("[DeviceInfo]\n") + keys); };
  EXPECT_TRUE(wrong(with("CompactPDO=0x3\nNrOfRXPDO=4\nNrOfTXPDO=4\n")).empty());
  EXPECT_EQ(wrong(with("CompactPDO=0\nNrOfRXPDO=4\nNrOfTXPDO=4\n")).size(), 2u);
  NodeMap second = node();
  second.axes[0].tpdo = 5;
  EXPECT_EQ(wrong(with("NrOfRXPDO=4\nNrOfTXPDO=4\nCompactPDO=1\n"), second), std::vector<std::string>{"0: 1A04h:0 does not exist in this drive"});
}

TEST(Eds, AMappingThatIsFixedIsNamed) {
  EXPECT_EQ(wrong(replaced(good_eds(), object("1600sub0", 5, "rw", 0), object("1600sub0", 5, "const", 0))).size(), 1u);
}

TEST(Eds, ATextThatIsNoneIsRefusedWithItsLines) {
  EXPECT_EQ(wrong(""), std::vector<std::string>{"0: describes no object"});
  EXPECT_EQ(wrong("hello\n"), std::vector<std::string>{"1: neither [section] nor key=value: \"hello\""});
  EXPECT_EQ(wrong("a=1\n[6040]\n"), std::vector<std::string>{"1: a key in front of the first [section]"});
  EXPECT_EQ(wrong("[6040\n"), std::vector<std::string>{"1: the name of a section ends with ]"});
  EXPECT_EQ(wrong("[6040]\nDataType=0xQQ\n"), std::vector<std::string>{"2: datatype is no number: \"0xQQ\""});
  EXPECT_EQ(wrong(object("6040", 6, "rw", 1) + object("6040", 6, "rw", 1)), std::vector<std::string>{"7: 6040h:0 is described twice, before in line 1"});
  EXPECT_LE(wrong(std::string(5000, '\n') + std::string(1000, 'x') + "\n").size(), 20u);
  EXPECT_EQ(wrong(std::string(kMostEdsBytes + 1, ';')), std::vector<std::string>{"0: is larger than 4 MiB: no data sheet"});
}

// The bytes of a file that is no text do not come to a terminal or into a log.
TEST(Eds, BytesThatAreNoTextAreNotQuoted) {
  const std::string escape = "pI\x1b[2J\x99\xc3\x7f";
  EXPECT_EQ(wrong(escape + "\n"), std::vector<std::string>{"1: is no text: an EDS has lines [section] and key=value"});
  EXPECT_EQ(wrong("[6040]\nDataType=0x" + escape + "\n"), std::vector<std::string>{"2: is no text: an EDS has lines [section] and key=value"});
  EXPECT_EQ(wrong("[6040]\nVendor\xe4=M\xfcller\nDataType=\xb5\n"), std::vector<std::string>{"3: datatype is no number: \"\xef\xbf\xbd\""}) << "a text in Latin 1";
  std::string random;
  unsigned state = 1;
  for (int n = 0; n < 5000; ++n) random += static_cast<char>((state = state * 1103515245u + 12345u) >> 16);
  for (const std::string& error : wrong(random))
    for (const char c : error) EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f) << error;
}

}  // namespace
