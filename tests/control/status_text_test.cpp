// SPDX-License-Identifier: Apache-2.0
// Every status has a sentence of its own.
#include <gtest/gtest.h>

#include <climits>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "nc/nc.h"
#include "places/places.hpp"

namespace {

/// The numbers of the enumeration, read from the header, so that one that is added there is tested here.
std::vector<int> statuses_of_the_header() {
  std::ifstream file(nc::test::kSourceDir + "/libnc/include/nc/types.h");
  std::stringstream all;
  all << file.rdbuf();
  const std::string text = all.str();
  const size_t begin = text.find("typedef enum nc_status {"), end = text.find("} nc_status;");
  std::vector<int> numbers;
  if (begin == std::string::npos || end == std::string::npos) return numbers;
  const std::string body = text.substr(begin, end - begin);
  const std::regex row(R"(\bNC_[A-Z_]+ = (-?\d+))");
  for (std::sregex_iterator i(body.begin(), body.end(), row), none; i != none; ++i) numbers.push_back(std::stoi((*i)[1]));
  return numbers;
}

TEST(StatusText, IsOneSentenceForEach) {
  const std::vector<int> numbers = statuses_of_the_header();
  ASSERT_EQ(numbers.size(), 10u);
  const std::string unknown = nc_status_text(static_cast<nc_status>(INT_MAX));
  std::set<std::string> seen;
  for (const int number : numbers) {
    const std::string text = nc_status_text(static_cast<nc_status>(number));
    EXPECT_NE(text, unknown) << number;
    EXPECT_TRUE(seen.insert(text).second) << text;
    EXPECT_GT(text.size(), 10u);
    EXPECT_TRUE(text[0] >= 'A' && text[0] <= 'Z') << text;
    EXPECT_EQ(text.find('.'), text.size() - 1) << text;
  }
}

TEST(StatusText, OfANumberThatIsNone) {
  for (const int number : {INT_MIN, -6, 5, 1000}) EXPECT_STREQ(nc_status_text(static_cast<nc_status>(number)), "This number is no status of the library.");
}

}  // namespace
