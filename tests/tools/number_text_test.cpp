// SPDX-License-Identifier: Apache-2.0
// How numbers are printed: by the rule of number_text.hpp, and without a loss of digits.
#include "tools/lib/number_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

namespace nc::tools {
namespace {

std::string fixed(double value) {
  char out[kNumberText];
  return std::string(out, number_text(value, out));
}
std::string any(double value) {
  char out[kNumberText];
  return std::string(out, value_text(value, out));
}

TEST(NumberText, NoNoiseNoMinusZeroNoTrailingZeros) {
  EXPECT_EQ(fixed(0.0), "0");
  EXPECT_EQ(fixed(-0.0), "0");
  EXPECT_EQ(fixed(-1e-12), "0");
  EXPECT_EQ(fixed(9.99999999999), "10");
  EXPECT_EQ(fixed(-9.99999999999), "-10");
  EXPECT_EQ(fixed(0.1 + 0.2), "0.3");
  EXPECT_EQ(fixed(1.5), "1.5");
  EXPECT_EQ(fixed(-0.0001), "-0.0001");
  EXPECT_EQ(fixed(1e-9), "0.000000001");
  EXPECT_EQ(fixed(100.0), "100");
  EXPECT_EQ(fixed(0.030000001), "0.030000001");
}

TEST(NumberText, LargeAndNotFinite) {
  EXPECT_EQ(fixed(8999999.25), "8999999.25");
  EXPECT_EQ(fixed(9000000.5), "9000000.5");
  EXPECT_EQ(fixed(1e20), "1e+20");
  EXPECT_EQ(fixed(std::numeric_limits<double>::infinity()), "null");
  EXPECT_EQ(fixed(std::nan("")), "null");
}

TEST(NumberText, EveryNineDecimalNumberComesBackAsItself) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 200'000; ++i) {
    const int64_t scaled =
        static_cast<int64_t>(random() % 8'000'000'000'000'000ull) - 4'000'000'000'000'000ll;
    const double value = static_cast<double>(scaled) / 1e9;
    const std::string text = fixed(value);
    ASSERT_EQ(std::llround(std::strtod(text.c_str(), nullptr) * 1e9), scaled) << text;
    ASSERT_NE(text.back(), '.');
    ASSERT_FALSE(text.find('.') != std::string::npos && text.back() == '0') << text;
  }
}

TEST(ValueText, FifteenDigitsWithoutNoise) {
  EXPECT_EQ(any(0.1 + 0.2), "0.3");
  EXPECT_EQ(any(1e-12), "1e-12");
  EXPECT_EQ(any(-0.0), "0");
  EXPECT_EQ(any(1.0 / 3.0), "0.333333333333333");
  EXPECT_EQ(any(4294967295.0), "4294967295");
}

TEST(IntegerText, Limits) {
  char out[kNumberText];
  EXPECT_EQ(std::string(out, integer_text(0, out)), "0");
  EXPECT_EQ(std::string(out, integer_text(std::numeric_limits<uint64_t>::max(), out)),
            "18446744073709551615");
}

}  // namespace
}  // namespace nc::tools
