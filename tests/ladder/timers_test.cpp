// SPDX-License-Identifier: Apache-2.0
// Timers and counters, to the scan.
#include <algorithm>

#include "rig.hpp"

namespace nc::ladder {
namespace {

// Scans from the one in which the coil turns on to the one in which the contact is on.
unsigned scans_until_on(Rig& rig, const char* contact, unsigned limit) {
  for (unsigned scan = 0; scan <= limit; ++scan) {
    rig.scan();
    if (rig.get(contact) != 0) return scan;
  }
  return limit + 1;
}

CompileOptions period(double seconds) {
  CompileOptions options;
  options.scan_s = seconds;
  return options;
}

TEST(LadderTimers, SetValueInTheirUnitExactToTheScan) {
  struct Case {
    const char* out;
    double period_s;
    unsigned scans;
  };
  for (const Case& c :
       {Case{"OUT T0 K5", 0.001, 500}, Case{"OUTH T0 K5", 0.001, 50}, Case{"OUTHS T0 K5", 0.001, 5},
        Case{"OUT T0 K1", 0.002, 50}, Case{"OUTHS T0 K1", 0.0005, 2}, Case{"OUTHS T0 K1", 0.0003, 4},
        Case{"OUTHS T0 K3", 0.0004, 8}, Case{"OUT T0 K1", 0.25, 1}, Case{"OUT T0 K0", 0.001, 0},
        Case{"OUTHS T0 K10", 0.004, 3}}) {
    Rig rig("LD X0\n" + std::string(c.out), period(c.period_s));
    rig.scan(3);
    rig.set("X0", 1);
    EXPECT_EQ(scans_until_on(rig, "T0", 1000), c.scans) << c.out << " " << c.period_s;
  }
}

TEST(LadderTimers, ManyPeriodsLoseNothing) {
  // 0.7 ms does not divide the unit of 10 ms.
  Rig rig("LD X0\nOUTH T0 K300", period(0.0007));
  rig.set("X0", 1);
  EXPECT_EQ(scans_until_on(rig, "T0", 10000), 4286u);  // 3 s / 0.7 ms = 4285.7
}

TEST(LadderTimers, OffResetsAndTheValueStopsAtTheSetValue) {
  Rig rig("LD X0\nOUTHS T0 K3\nLD T0\nOUT Y0");
  rig.set("X0", 1);
  rig.scan(3);
  EXPECT_EQ(rig.get("TN0"), 2);
  EXPECT_EQ(rig.get("Y0"), 0);
  rig.scan(5);
  EXPECT_EQ(rig.get("TN0"), 3);
  EXPECT_EQ(rig.get("Y0"), 1);
  rig.set("X0", 0);
  rig.scan();
  EXPECT_EQ(rig.get("TN0"), 0);
  EXPECT_EQ(rig.get("Y0"), 0);
  rig.set("X0", 1);
  rig.scan();
  EXPECT_EQ(rig.get("TN0"), 0) << "counts from nothing again";
}

TEST(LadderTimers, SetValueFromAWord) {
  Rig rig("LD X0\nOUTHS T0 D10");
  rig.set("D10", 7);
  rig.set("X0", 1);
  EXPECT_EQ(scans_until_on(rig, "T0", 100), 7u);
  rig.set("D10", 100);
  rig.scan();
  EXPECT_EQ(rig.get("T0"), 1) << "stays until the coil turns off";
}

TEST(LadderTimers, CurrentValueIsAWord) {
  Rig rig("LD X0\nOUTHS T0 K100\nLD> T0 K3\nOUT Y0\nLD SM400\nMOV T0 D0\nLDP X1\nMOV K99 T0");
  rig.set("X0", 1);
  rig.scan(5);
  EXPECT_EQ(rig.get("D0"), 4);
  EXPECT_EQ(rig.get("Y0"), 1);
  rig.set("X1", 1);
  rig.scan();
  EXPECT_EQ(rig.get("T0"), 0);
  rig.scan();
  EXPECT_EQ(rig.get("T0"), 1);
}

TEST(LadderTimers, RetentiveOnesKeepTheirTime) {
  Rig rig("LD X0\nOUTHS ST1 K5\nLD X1\nRST ST1\nLD ST1\nOUT Y0");
  rig.set("X0", 1);
  rig.scan(4);
  EXPECT_EQ(rig.get("STN1"), 3);
  rig.set("X0", 0);
  rig.scan(10);
  EXPECT_EQ(rig.get("STN1"), 3);
  rig.set("X0", 1);
  rig.scan(3);
  EXPECT_EQ(rig.get("Y0"), 1);
  rig.set("X0", 0);
  rig.scan(3);
  EXPECT_EQ(rig.get("Y0"), 1) << "the contact stays too";
  rig.set("X1", 1);
  rig.scan();
  EXPECT_EQ(rig.get("Y0"), 0);
  EXPECT_EQ(rig.get("STN1"), 0);
}

TEST(LadderTimers, RstStartsAgain) {
  Rig rig("LD X0\nOUTHS T0 K5\nLD X1\nRST T0");
  rig.set("X0", 1);
  rig.scan(10);
  EXPECT_EQ(rig.get("T0"), 1);
  rig.set("X1", 1);
  rig.scan();
  EXPECT_EQ(rig.get("T0"), 0);
  rig.set("X1", 0);
  EXPECT_EQ(scans_until_on(rig, "T0", 100), 5u);
}

TEST(LadderTimers, ATimerThatIsJumpedOverStands) {
  Rig rig("LD X1\nCJ P1\nLD X0\nOUTHS T0 K5\nP1");
  rig.set("X0", 1);
  rig.scan(3);
  rig.set("X1", 1);
  rig.scan(10);
  EXPECT_EQ(rig.get("TN0"), 2);
}

TEST(LadderTimers, HighestNumbers) {
  Rig rig("LD X0\nOUTHS T511 K2\nOUTHS ST63 K2\nOUT C511 K1\nLD X1\nRST T511\nRST ST63\nRST C511");
  rig.scan();
  rig.set("X0", 1);
  rig.scan(3);
  for (const char* name : {"T511", "ST63", "C511"}) EXPECT_EQ(rig.get(name), 1) << name;
  rig.set("X1", 1);
  rig.scan();
  for (const char* name : {"T511", "ST63", "C511", "TN511", "STN63", "CN511"})
    EXPECT_EQ(rig.get(name), 0) << name;
}

TEST(LadderCounters, CountRisingEdgesUpToTheSetValue) {
  Rig rig("LD X0\nOUT C0 K3\nLD X1\nRST C0\nLD C0\nOUT Y0");
  rig.set("X0", 1);
  rig.scan(2);
  EXPECT_EQ(rig.get("CN0"), 0) << "on from the start is no edge";
  for (int i = 1; i <= 5; ++i) {
    rig.set("X0", 0);
    rig.scan();
    rig.set("X0", 1);
    rig.scan(2);
    EXPECT_EQ(rig.get("CN0"), std::min(i, 3));
    EXPECT_EQ(rig.get("Y0"), i >= 3);
  }
  rig.set("X1", 1);
  rig.scan();
  EXPECT_EQ(rig.get("CN0"), 0);
  EXPECT_EQ(rig.get("Y0"), 0);
  rig.set("X1", 0);
  rig.scan();
  EXPECT_EQ(rig.get("CN0"), 0) << "RST is no edge of the input";
}

TEST(LadderCounters, SetValueFromAWordAndCurrentValueAsAWord) {
  Rig rig("LD X0\nOUT C7 D0\nLD= C7 K2\nOUT Y0");
  rig.set("D0", 2);
  rig.scan();
  for (int i = 0; i < 2; ++i) {
    rig.set("X0", 1);
    rig.scan();
    rig.set("X0", 0);
    rig.scan();
  }
  EXPECT_EQ(rig.get("C7"), 1);
  EXPECT_EQ(rig.get("Y0"), 1);
}

TEST(LadderRetained, RangesAreOfTheDevicesTheyName) {
  CompileOptions options;
  options.retain_counters = true;
  options.retain_d_first = 100;
  options.retain_d_count = 50;
  Rig rig("LD X0\nSET L0\nOUTHS ST0 K100\nOUT C0 K5\nMOV K3 D100", options);
  unsigned found = 0;
  for (const RetainedRange& range : rig.engine().retained()) {
    const std::size_t size = range.words ? rig.image.word.size() : rig.image.bit.size();
    EXPECT_LE(range.first + range.count, size) << range.name;
    const auto starts_at = [&](const char* name) { return range.first == rig.device(name).index; };
    if (range.name == "L") found += starts_at("L0") && range.count == 2048;
    if (range.name == "ST contact") found += starts_at("ST0") && range.count == 64;
    if (range.name == "ST value") found += starts_at("STN0");
    if (range.name == "ST rest") ++found;
    if (range.name == "C contact") found += starts_at("C0");
    if (range.name == "C value") found += starts_at("CN0");
    if (range.name == "D") found += starts_at("D100") && range.count == 50;
  }
  EXPECT_EQ(found, 7u);
  EXPECT_EQ(Rig("").engine().retained().size(), 4u);
}

TEST(LadderRetained, AValueCopiedIntoANewImageGoesOn) {
  Rig rig("LD X0\nOUT ST0 K1\nLD X1\nSET L5");
  rig.set("X0", 1);
  rig.set("X1", 1);
  rig.scan(60);
  DeviceImage fresh = rig.engine().make_image();
  for (const RetainedRange& range : rig.engine().retained())
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i)
      range.words ? void(fresh.word[i] = rig.image.word[i]) : void(fresh.bit[i] = rig.image.bit[i]);
  rig.image = fresh;
  rig.set("X0", 1);
  EXPECT_EQ(rig.get("L5"), 1);
  EXPECT_EQ(scans_until_on(rig, "ST0", 1000), 41u);  // 59 of the 100 scans were counted before
}

}  // namespace
}  // namespace nc::ladder
