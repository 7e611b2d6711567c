// SPDX-License-Identifier: Apache-2.0
// The tables of system variables: which meaning a number has, and which place within it.
#include "dialect/variable_rows.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "dialect/dialect.hpp"
#include "macro/variables.hpp"
#include "nc/control.h"

namespace nc {
namespace {

using V = SystemVariable;

const FamilyVariables& m700() { return *dialect(NC_DIALECT_M700).variables; }

void expect_place(uint32_t number, V what, uint32_t part, uint32_t index) {
  const VariableRow* row = find_variable(m700(), number);
  ASSERT_NE(row, nullptr) << number;
  EXPECT_EQ(row->what, what) << number;
  EXPECT_EQ(place_in(*row, number).part, part) << number;
  EXPECT_EQ(place_in(*row, number).index, index) << number;
}

TEST(VariableRows, ARangeIsPartsOfPlaces) {
  expect_place(1031, V::input_bit, 0, 31);
  expect_place(1200, V::input_bit, 1, 0);  // bit 0 of #1033
  expect_place(1395, V::output_bit, 1, 95);
  expect_place(1135, V::output_word, 0, 3);
  expect_place(2001, V::tool_offset, 0, 0);
  expect_place(2200, V::tool_offset, 0, 199);
  expect_place(2201, V::tool_offset, 1, 0);
  expect_place(2800, V::tool_offset, 3, 199);
  expect_place(10999, V::tool_offset, 0, 998);
  expect_place(11001, V::tool_offset, 1, 0);
  expect_place(16001, V::tool_offset, 2, 0);
  expect_place(17005, V::tool_offset, 3, 4);
  expect_place(5201, V::work_offset, 0, 0);  // external
  expect_place(5222, V::work_offset, 1, 1);  // G54, second axis
  expect_place(5321, V::work_offset, 6, 0);  // G59
  expect_place(7001, V::work_offset, 7, 0);  // G54.1 P1
  expect_place(8903, V::work_offset, 102, 2);  // G54.1 P96, third axis
  expect_place(3004, V::control, 0, 1);
  expect_place(4021, V::code, 0, 20);
  EXPECT_EQ(find_variable(m700(), 12000), nullptr);
  EXPECT_EQ(find_variable(m700(), 999), nullptr);
}

TEST(VariableRows, RangesAreSortedAndApartAndEveryMeaningHasOne) {
  std::set<V> seen;
  for (const nc_dialect family : {NC_DIALECT_M700, NC_DIALECT_HX, NC_DIALECT_ISO, NC_DIALECT_SERIES8}) {
    uint32_t last = 0;
    for (const VariableRow& row : dialect(family).variables->rows) {
      EXPECT_GT(row.first, last);
      EXPECT_LE(row.first, row.last);
      last = row.last;
      seen.insert(row.what);
    }
  }
  EXPECT_EQ(seen.size(), kSystemVariables);
}

// The public table is the table of the dialect.
TEST(VariableRows, ThePublicTableIsTheFamilys) {
  nc_system_variable row{};
  unsigned count = 0;
  for (; nc_system_variable_row(NC_DIALECT_M700, count, &row) == NC_OK; ++count) {
    EXPECT_EQ(row.first, m700().rows.row[count].first);
    EXPECT_EQ(row.last, m700().rows.row[count].last);
    EXPECT_STREQ(row.name, m700().rows.row[count].name);
    EXPECT_TRUE(row.readable || row.writable) << row.first;
  }
  EXPECT_EQ(count, m700().rows.size);
  // What a host can ask for by role: the words of the macro interface, and the word with which a range of bits begins.
  std::string interface;
  for (unsigned i = 0; nc_system_variable_row(NC_DIALECT_M700, i, &row) == NC_OK; ++i)
    if (row.role != NC_VARIABLE_OTHER) interface += std::to_string(row.first) + ":" + std::to_string(row.role) + "." + std::to_string(row.word) + " ";
  EXPECT_EQ(interface, "1000:1.0 1032:2.0 1100:3.0 1132:4.0 1200:1.1 1300:3.1 ");
  EXPECT_EQ(nc_system_variable_row(NC_DIALECT_DGSHAPE, 0, &row), NC_E_NOT_FOUND);  // it has no variables
  EXPECT_EQ(nc_system_variable_row(NC_DIALECT_M700, 0, nullptr), NC_E_ARGUMENT);
  EXPECT_EQ(nc_system_variable_row(static_cast<nc_dialect>(77), 0, &row), NC_E_ARGUMENT);
}

// What a host asks for by what holds for the variables.
TEST(VariableRows, KindsAreThoseOfTheFamily) {
  for (unsigned id = 0; id < NC_DIALECT_COUNT; ++id) {
    const auto family = static_cast<nc_dialect>(id);
    nc_variable_range range{};
    ASSERT_EQ(nc_variable_kind_get(family, NC_VARIABLES_LOCAL, &range), NC_OK);
    EXPECT_EQ(range.first, 1u);
    EXPECT_EQ(range.last, dialect(family).variables->last_local);
    EXPECT_TRUE(range.last >= kLocals && range.last <= kMostLocals) << "there is room for the values";
    ASSERT_EQ(nc_variable_kind_get(family, NC_VARIABLES_NAMED, &range), NC_OK);
    EXPECT_EQ(range.first, dialect(family).variables->named.first);
    EXPECT_EQ(range.last, dialect(family).variables->named.last);
    EXPECT_LE(range.last - range.first + 1, kNames) << "there is room for the names";
    ASSERT_EQ(nc_variable_kind_get(family, NC_VARIABLES_CLEARED, &range), NC_OK);
    EXPECT_EQ(range.first, dialect(family).variables->cleared.first);
    EXPECT_EQ(range.last, dialect(family).variables->cleared.last);
    EXPECT_EQ(nc_variable_kind_get(family, static_cast<nc_variable_kind>(3), &range), NC_E_ARGUMENT);
    EXPECT_EQ(nc_variable_kind_get(family, NC_VARIABLES_LOCAL, nullptr), NC_E_ARGUMENT);
  }
  nc_variable_range range{};
  EXPECT_EQ(nc_variable_kind_get(NC_DIALECT_COUNT, NC_VARIABLES_LOCAL, &range), NC_E_ARGUMENT);
  EXPECT_EQ(nc_control_dialect(nullptr), kDefaultDialect);
}

}  // namespace
}  // namespace nc
