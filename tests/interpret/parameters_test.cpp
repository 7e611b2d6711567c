// SPDX-License-Identifier: Apache-2.0
// The store of parameters: what a key names, numbers and texts, and what a write returns so that it can be taken back.
#include "interpret/parameters.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace nc::test {
namespace {

// Numbers from here on are no parameter of the family's table, so that they take any value.
constexpr unsigned kFree = 50000;

class ParametersTest : public testing::Test {
 protected:
  ParametersTest() { parameters.create(256, arena); }
  nc_status set(const std::string& key, const std::string& text, int axis = -1) { return parameters.set(dialect, key.c_str(), axis, text.c_str()); }
  std::string text(unsigned number, int axis = -1) const {
    const char* const found = parameters.text(ParameterId::of_number(number), axis);
    return found != nullptr ? found : "";
  }
  double get(unsigned number, int bit = -1, int axis = -1) const {
    double value = -1;
    return parameters.get(ParameterId::of_number(number), bit, axis, &value) ? value : -1;
  }

  const Dialect& dialect = nc::dialect(NC_DIALECT_M700);
  std::unique_ptr<char[]> memory = std::make_unique_for_overwrite<char[]>(64 << 10);
  Arena arena{memory.get(), 64 << 10};
  Parameters parameters;
};

TEST_F(ParametersTest, NumbersBitsAxesAndTexts) {
  EXPECT_EQ(set("50000", "12.5"), NC_OK);
  EXPECT_EQ(get(50000), 12.5);
  EXPECT_EQ(set("50001/bit3", "1"), NC_OK);
  EXPECT_EQ(get(50001), 8);
  EXPECT_EQ(get(50001, 3), 1);
  EXPECT_EQ(get(50001, 2), 0);
  EXPECT_EQ(set("50001/bit3", "2"), NC_E_ARGUMENT);
  EXPECT_EQ(set("50002", "7"), NC_OK);
  EXPECT_EQ(set("50002", "8", 1), NC_OK);
  EXPECT_EQ(get(50002, -1, 0), 7);
  EXPECT_EQ(get(50002, -1, 1), 8);
  EXPECT_EQ(set("50003", "IP192"), NC_OK);
  EXPECT_EQ(text(50003), "IP192");
  EXPECT_EQ(get(50003), (((('I' * 256.0 + 'P') * 256 + '1') * 256 + '9') * 256 + '2'));
  EXPECT_EQ(set("50003", "longer than six"), NC_OK);
  EXPECT_EQ(get(50003), -1);
  EXPECT_EQ(set("50003", "4503599627370495"), NC_OK);
  EXPECT_EQ(text(50003), "");
  EXPECT_EQ(set("50003", "4503599627370496"), NC_E_ARGUMENT);
  for (const char* key : {"", "12x", "1234567", "50000/bit32", "no such name"}) EXPECT_EQ(set(key, "1"), NC_E_NOT_FOUND) << key;
}

// A clearance below 0 would send G73 and G83 into the work in rapid traverse; each has the range that its row states.
TEST_F(ParametersTest, AValueOutsideOfTheStatedRangeIsRefused) {
  const struct {
    const char *key, *first_taken, *last_taken;
    std::vector<const char*> refused;
  } rows[] = {{"8012", "0", "2.5", {"-0.001", "-2"}},           {"8013", "0", "2.5", {"-1"}},      {"1110", "3", "97", {"2", "98", "3.5"}}, {"1181", "0", "3", {"4", "-1"}},
              {"1303", "0", "199", {"1", "99", "200"}},         {"1304", "500", "999", {"499"}},   {"7002", "0", "3", {"4"}},               {"8030", "-1", "6", {"-0.5", "-2"}},
              {"CONTOUR_CHECK", "0", "1", {"7", "-1", "0.5"}}, {"UNIT*10", "1", "10000", {"0"}}};
  for (const auto& row : rows) {
    EXPECT_EQ(set(row.key, row.first_taken), NC_OK) << row.key;
    EXPECT_EQ(set(row.key, row.last_taken), NC_OK) << row.key;
    for (const char* value : row.refused) EXPECT_EQ(set(row.key, value), NC_E_ARGUMENT) << row.key << " = " << value;
  }
}

TEST_F(ParametersTest, ANumberIsOneParameterHoweverItIsWritten) {
  EXPECT_EQ(set("050000", "1"), NC_OK);
  EXPECT_EQ(get(50000), 1);
  EXPECT_EQ(set("50000", "2"), NC_OK);
  ParameterId id;
  ParameterValue value;
  int axis = 0;
  EXPECT_TRUE(parameters.at(0, &id, &axis, &value));
  EXPECT_FALSE(parameters.at(1, &id, &axis, &value));
  char key[kParameterKeySize];
  put_parameter_key(dialect, id, key);
  EXPECT_STREQ(key, "50000");
}

// M700 #2037 to #2040 have a value for each axis; of HX's reference positions each axis has numbers of its own (6.2).
TEST_F(ParametersTest, AMeaningIsSetForAnAxisWhereverTheFamilyKeepsIt) {
  const ParameterOf second{Parameter::reference_position, 1};
  unsigned index = 0;
  ParameterValue old;
  double value = 0;
  ASSERT_EQ(parameters.set(dialect, second, 2, 12.5, &index, &old), NC_OK);
  EXPECT_EQ(get(2038, -1, 2), 12.5);
  EXPECT_EQ(get(2038, -1, 1), -1);
  EXPECT_TRUE(parameters.get(dialect, second, 2, &value));
  EXPECT_EQ(value, 12.5);
  const Dialect& hx = nc::dialect(NC_DIALECT_HX);
  ASSERT_EQ(parameters.set(hx, second, 2, -3, &index, &old), NC_OK);
  EXPECT_EQ(get(22099), -3);
  EXPECT_TRUE(parameters.get(hx, second, 2, &value));
  EXPECT_EQ(value, -3);
  EXPECT_EQ(parameters.set(hx, {Parameter::reference_position, 0}, 2, 1, &index, &old), NC_E_NOT_FOUND) << "HX has the 2nd to the 4th";
  EXPECT_EQ(parameters.set(nc::dialect(NC_DIALECT_DGSHAPE), second, 2, 1, &index, &old), NC_E_NOT_FOUND);
}

TEST_F(ParametersTest, AWriteGivesWhatIsToBePutBack) {
  unsigned index = 0;
  ParameterValue old;
  ASSERT_EQ(parameters.set(dialect, "50000", -1, "first", &index, &old), NC_OK);
  EXPECT_FALSE(old.is_set());
  ASSERT_EQ(parameters.set(dialect, "50000", -1, "3", &index, &old), NC_OK);
  EXPECT_EQ(parameters.exchange(index, ParameterValue::of(old.journalled())).number.value_or(0), 3);
  EXPECT_EQ(text(50000), "first");
  parameters.restore(index, ParameterValue{});
  EXPECT_EQ(text(50000), "");
  EXPECT_EQ(get(50000), -1);
}

/// Each text has its own place: a text of another parameter never takes it, and a write is refused when there is no place left.
TEST_F(ParametersTest, NoTextTakesThePlaceOfAnothersParameter) {
  constexpr unsigned kPlaces = 128;
  for (unsigned i = 0; i < kPlaces; ++i) ASSERT_EQ(set(std::to_string(kFree + i), "text" + std::to_string(i)), NC_OK);
  EXPECT_EQ(set(std::to_string(kFree + kPlaces), "one more"), NC_E_MEMORY);
  for (unsigned i = 0; i < kPlaces; ++i) EXPECT_EQ(text(kFree + i), "text" + std::to_string(i));
  ASSERT_EQ(set(std::to_string(kFree + 5), "1"), NC_OK);  // which leaves its place
  EXPECT_EQ(set(std::to_string(kFree + kPlaces), "one more"), NC_OK);
  EXPECT_EQ(text(kFree + kPlaces), "one more");
  EXPECT_EQ(text(kFree + 6), "text6");
}

}  // namespace
}  // namespace nc::test
