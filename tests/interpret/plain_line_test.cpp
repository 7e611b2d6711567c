// SPDX-License-Identifier: Apache-2.0
// Compares the short way for plain lines (interpret/plain_line.cpp) with the long one. The G90 or G91 that is in force,
// written before the words, changes nothing, but makes the block go the long way.
#include <gtest/gtest.h>

#include <random>

#include "support/pull.hpp"
#include "support/seeds.hpp"

namespace nc::test {
namespace {

struct TwoWays {
  std::string shortly, at_length;
};

bool has_fourth(uint32_t seed) {
  return seed % 3 == 0;
}

class Maker {
 public:
  Maker(uint32_t seed, nc_dialect dialect)
      : random_(seed), m700_(dialect == NC_DIALECT_M700), four_axes_(has_fourth(seed)) {}

  TwoWays make(unsigned lines) {
    both(m700_ ? "G21 G90 G94 F500." : "%\nG21 G90 F500.");
    for (unsigned i = 0; i < lines; ++i) {
      if (random_() % 5 == 0) {
        mode();
      } else {
        line();
      }
    }
    both("M30");
    return text_;
  }

 private:
  void both(const std::string& line) {
    text_.shortly += line + "\n";
    text_.at_length += line + "\n";
  }

  std::string number() {
    static constexpr const char* kOdd[] = {"-0.",        "0.", ".5",   "99999.999", "100000.",
                                           "12.3456789", "7",  "-.25", "1234567.",  "00012.50"};
    if (random_() % 40 == 0) return kOdd[random_() % std::size(kOdd)];
    static constexpr const char* kVariables[] = {"#1", "#2", "#3", "#1", "#2", "#33", "-#2", "[#1+#2]", "#100", "#1001", "#5001"};
    if (m700_ && random_() % 8 == 0) return kVariables[random_() % std::size(kVariables)];
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", static_cast<int>(1 + random_() % 4),
                  static_cast<int>(random_() % 4000) / 97.0 - 20);
    return text;
  }

  void line() {
    std::string words;
    for (const char* axis = "XYZA"; *axis != 0; ++axis)
      if (random_() % 100 < (*axis != 'A' ? 60u : four_axes_ ? 15u : 0u))
        words += std::string(random_() % 2 != 0 ? " " : "") + *axis + number();
    if (words.empty()) words = " X" + number();
    if (random_() % 30 == 0) words += " Y" + number();  // twice: the last one counts
    const std::string code = random_() % 2 != 0 ? "G1" : random_() % 8 == 0 ? "G01." : "";
    const std::string sequence = random_() % 10 == 0 ? "N" + std::to_string(1 + random_() % 99) + " " : "";
    text_.shortly += sequence + code + words + "\n";
    text_.at_length += sequence + (incremental_ ? "G91 " : "G90 ") + code + words + "\n";
  }

  void mode() {
    static constexpr const char* kShared[] = {"G0 X1. Y2.",
                                              "G1 Z3.",
                                              "G2 X0. Y0. R80.",
                                              "G17",
                                              "G18",
                                              "G19",
                                              "G40 X5.",
                                              "G41 D1 X8. Y3.",
                                              "G43 H2 Z9.",
                                              "G49 Z1.",
                                              "G52 X1. Y-2.",
                                              "G52 X0. Y0.",
                                              "G54",
                                              "G55",
                                              "G59",
                                              "G53 X1.",
                                              "F250.",
                                              "F0.5",
                                              "G92 X2. Z1.",
                                              "G81 R2. Z-3. F100.",
                                              "G80",
                                              "M3 S500",
                                              "G4 P10",
                                              "T2",
                                              "G28 Z5."};
    static constexpr const char* kM700[] = {
        "G61",       "G64",         "G62",      "G63",   "G51.1 X2.", "G50.1 X0.", "G95 F0.2",
        "G94 F300.", "G96 S50",     "G97 S200", "G61.1", "G16",       "G15",       "G33 Z5. F1.",
        "G9 X3.",    "G1 X3.,I0.1", "#1=#1+1",  "X[#1]", "#1=#2/7-#1", "#2=12.75", "#2=-3", "#3=123456", "#3=#0", "#33=#33+.5", "G5.1 Q1",   "G5.1 Q0",   "G93 F2.", "G68 X1. Y0. R30.", "G69", "G51 X0. Y0. P2.", "G50"};
    if (random_() % 12 == 0) {
      incremental_ = !incremental_;
      both(incremental_ ? "G91" : "G90");
    } else if (random_() % 14 == 0) {
      both(random_() % 2 != 0 ? "G20" : "G21");
    } else if (m700_ && random_() % 2 == 0) {
      both(kM700[random_() % std::size(kM700)]);
    } else {
      both(kShared[random_() % std::size(kShared)]);
    }
  }

  std::mt19937 random_;
  bool m700_, four_axes_;
  bool incremental_ = false;
  TwoWays text_;
};

struct Setting {
  const char* key;
  const char* value;
};

Outcome run(nc_dialect dialect, uint32_t seed, const std::string& text) {
  Bench bench(dialect, has_fourth(seed) ? axes("XYZa") : axes("XYZ"));
  bench.tool(1, 3).tool(2, 40).work_offset(1, {1, 2, 3}).work_offset(2, {-5, 0, 1});
  if (dialect == NC_DIALECT_M700) {
    static constexpr Setting kSettings[] = {
        {"8013", "0.5"}, {"1306", "1"}, {"1078", "1"}, {"1223/bit1", "1"}};
    const Setting& setting = kSettings[seed % std::size(kSettings)];
    bench.param(setting.key, setting.value);
  }
  return bench.run(text);
}

/// Compares both ways; returns the number of moves.
size_t compare(nc_dialect dialect, uint32_t seed) {
  const TwoWays program = Maker(seed, dialect).make(80);
  const Outcome shortly = run(dialect, seed, program.shortly),
                at_length = run(dialect, seed, program.at_length);
  EXPECT_EQ(shortly.alarm, at_length.alarm) << shortly.alarm_detail;
  EXPECT_EQ(shortly.alarm_line, at_length.alarm_line);
  EXPECT_EQ(shortly.alarm_detail, at_length.alarm_detail);
  EXPECT_EQ(shortly.steps.size(), at_length.steps.size());
  for (size_t i = 0; i < std::min(shortly.steps.size(), at_length.steps.size()); ++i) {
    EXPECT_EQ(exactly(shortly.steps[i]), exactly(at_length.steps[i])) << program.shortly;
    if (testing::Test::HasFailure()) break;
  }
  return shortly.moves().size();
}

TEST(PlainLine, IsTheLongWayInShort) {
  for (const nc_dialect dialect : {NC_DIALECT_M700, NC_DIALECT_DGSHAPE}) {
    size_t moves = 0;
    const uint64_t count = seeds(300, 60);
    for (uint32_t seed = 0; seed < count; ++seed) {
      moves += compare(dialect, seed);
      ASSERT_FALSE(HasFailure()) << "dialect " << dialect << ", seed " << seed;
    }
    EXPECT_GT(moves, 10 * count) << "most programs end too early to say anything";
  }
}

}  // namespace
}  // namespace nc::test
