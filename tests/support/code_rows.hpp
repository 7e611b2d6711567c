// SPDX-License-Identifier: Apache-2.0
// The codes of a family, one row for each: what a program with the code does by its section, and which words and neighbours it cannot have. Each family has
// such a table (tests/interpret/*_codes_test.cpp), which can be laid beside the list of its manual.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "dialect/dialect.hpp"
#include "dialect/function_table.hpp"
#include "support/pull.hpp"

namespace nc::test {

/// A program whose last line is refused.
struct Refused {
  const char *program, *alarm;
};
struct CodeRow {
  const char* code;
  const char* program;
  Path path;        ///< in machine coordinates; the moves may go on behind kGoesOn
  const char* aux;  ///< with the code of the end
  std::vector<Refused> refused;
};
/// The last entry of a path of which only the beginning stands in the row.
inline constexpr const char* kGoesOn = "...";

/// Each program does what its row says. `run_of`: runs a program with what the tables of the machine hold, and ends it.
template <class Rows, class Run>
void expect_done(const Rows& rows, const Run& run_of) {
  for (const CodeRow& row : rows) {
    const Outcome run = run_of(row.program);
    EXPECT_EQ(run.alarm, "") << row.code << ": " << run.alarm_detail;
    Path path = run.path(), expected = row.path;
    if (!expected.empty() && expected.back() == kGoesOn) {
      expected.pop_back();
      EXPECT_GT(path.size(), expected.size()) << row.code;
      path.resize(std::min(path.size(), expected.size()));
    }
    EXPECT_EQ(path, expected) << row.code;
    EXPECT_EQ(run.aux(), row.aux) << row.code;
  }
}

/// Each refused program raises its alarm on its last line. `lines_before`: lines that run_of() puts in front of a program.
template <class Rows, class Run>
void expect_refused(const Rows& rows, const Run& run_of, unsigned lines_before) {
  for (const CodeRow& row : rows)
    for (const Refused& refused : row.refused) {
      const std::string text = refused.program;
      const Outcome run = run_of(text);
      EXPECT_EQ(run.alarm, refused.alarm) << row.code << ": " << text << ": " << run.alarm_detail;
      EXPECT_EQ(run.alarm_line, lines_before + 1 + std::count(text.begin(), text.end(), '\n')) << row.code << ": " << text;
    }
}

/// The rows are the codes that the tables of the family have built.
template <class Rows>
void expect_codes_of(nc_dialect family, const Rows& rows) {
  std::set<std::string> here, there;
  for (const CodeRow& row : rows) EXPECT_TRUE(here.insert(row.code).second) << row.code << " stands twice";
  char text[12];
  for (const FunctionRow& row : dialect(family).functions)
    if (row.missing == nullptr) g_code_text('G', row.code, text, sizeof text), there.insert(text);
  for (const MiscRow& row : dialect(family).misc)
    if (row.missing == nullptr) m_code_text('M', row.code, text, sizeof text), there.insert(text);
  for (const OutputRow& row : dialect(family).outputs) m_code_text('M', row.code, text, sizeof text), there.insert(text);
  EXPECT_EQ(here, there);
}

}  // namespace nc::test
