// SPDX-License-Identifier: Apache-2.0
// Decimal numbers are compared with strtod of the C library, bit for bit.
#include "program/number.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <string>

#include "lex_helpers.hpp"
#include "program/cursor.hpp"

namespace nc::test {
namespace {

Decimal scan(const std::string& text) {
  Cursor c;
  c.p = text.data();
  c.end = c.p + text.size();
  return c.number();
}

std::string random_digits(std::mt19937_64& random, unsigned count) {
  std::string s;
  for (unsigned i = 0; i < count; ++i) s += static_cast<char>('0' + random() % 10);
  return s;
}

TEST(Number, MillionRandomNumbersEqualStrtod) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 1000000; ++i) {
    const unsigned digits = 1 + static_cast<unsigned>(random() % 19);
    std::string text = random_digits(random, digits);
    text.insert(random() % (digits + 1), ".");
    ASSERT_EQ(scan(text).value, std::strtod(text.c_str(), nullptr)) << text;
  }
}

TEST(Number, ManyFractionDigitsEqualStrtod) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 3000; ++i) {
    const std::string text =
        "." + std::string(random() % 340, '0') + random_digits(random, 1 + random() % 19);
    ASSERT_EQ(scan(text).value, std::strtod(text.c_str(), nullptr)) << text;
  }
}

TEST(Number, TiesAndPowersOfTwoRoundToEven) {
  // 2^53 + 1 and its neighbours, the smallest normal and denormal numbers, and a value just below a power of
  // two.
  for (const char* text :
       {"9007199254740993", "9007199254740991", "9007199254740992.5", "9007199254740993.001",
        "18446744073709551", "1844674407370955161", "4503599627370496.5", "4503599627370497.5", "0.1",
        "0.30000000000000004", "1023.999999999999943", ".9999999999999999445", ".9999999999999999444"}) {
    EXPECT_EQ(scan(text).value, std::strtod(text, nullptr)) << text;
  }
  std::string tiny = "." + std::string(307, '0') + "2225073858507201";
  EXPECT_EQ(scan(tiny).value, std::strtod(tiny.c_str(), nullptr));
  tiny = "." + std::string(323, '0') + "2470328229206232721";
  EXPECT_EQ(scan(tiny).value, std::strtod(tiny.c_str(), nullptr));
  EXPECT_EQ(scan("." + std::string(500, '0') + "1").value, 0);
}

TEST(Number, CountsDigits) {
  const Decimal d = scan("00120.0340");
  EXPECT_EQ(d.value, 120.034);
  EXPECT_EQ(d.integer, 120u);
  EXPECT_EQ(d.integer_digits, 3u);
  EXPECT_EQ(d.fraction_digits, 4u);
  EXPECT_EQ(d.digits, 9u);
  EXPECT_TRUE(d.point);
  EXPECT_EQ(scan("X").digits, 0u);
  EXPECT_EQ(scan(".").digits, 0u);
  EXPECT_EQ(scan("1.2.3").value, 1.2);
  EXPECT_EQ(scan("1 2 (comment) . 5").value, 12.5);
  EXPECT_EQ(scan(std::string(25, '9')).integer_digits, 25u);
  EXPECT_EQ(scan("0." + std::string(40, '3')).value, 0.3333333333333333333);
}

TEST(Number, EightCharactersAtOnceCountAndConvert) {
  std::mt19937_64 random(9);
  for (int i = 0; i < 200000; ++i) {
    char text[9] = {};
    for (int k = 0; k < 8; ++k)
      text[k] = random() % 4 != 0 ? static_cast<char>('0' + random() % 10) : static_cast<char>(random());
    unsigned digits = 0;
    uint64_t value = 0;
    for (; digits < 8 && is_digit(text[digits]); ++digits)
      value = value * 10 + static_cast<uint64_t>(text[digits] - '0');
    const EightCharacters eight(text);
    ASSERT_EQ(eight.digits(), digits);
    if (digits < 8) {
      ASSERT_EQ(eight.value(), value);
    }
  }
}

/// The two ways through the lexer (eight characters at a time, one at a time near the end of the text) and
/// every word format.
TEST(Number, WordsEqualStrtodNearAndFarFromTheEnd) {
  std::mt19937_64 random(10);
  const IsoRules rules = m700_rules();
  for (int i = 0; i < 100000; ++i) {
    std::string number = random_digits(random, static_cast<unsigned>(random() % 9));
    if (random() % 2 != 0) number += "." + random_digits(random, static_cast<unsigned>(random() % 12));
    if (number.empty() || number == ".") continue;
    const char* sign = random() % 3 == 0 ? "-" : random() % 3 == 0 ? "+" : "";
    const double expected = std::strtod((sign + number).c_str(), nullptr);
    for (const char* tail : {"", "\n", " (a comment that is longer than what is looked at)\n"}) {
      const auto block = lex("X" + (sign + number) + tail, rules);
      ASSERT_FALSE(block->has_fault) << number;
      ASSERT_EQ(block->words.size(), 1u);
      ASSERT_EQ(block->words[0].value, expected) << sign << number;
      ASSERT_EQ(std::signbit(block->words[0].value), *sign == '-');
      ASSERT_EQ((block->words[0].flags & kWordPoint) != 0, number.find('.') != std::string::npos);
    }
  }
}

}  // namespace
}  // namespace nc::test
