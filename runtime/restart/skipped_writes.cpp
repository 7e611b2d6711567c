// SPDX-License-Identifier: Apache-2.0
// See skipped_writes.hpp.
#include "runtime/restart/skipped_writes.hpp"

#include <cstdio>
#include <sstream>
#include <vector>

#include "runtime/retain/tables.hpp"
#include "runtime/retain/variables.hpp"

namespace nc::rt {
namespace {

constexpr std::size_t kNamed = 8;  // the rest is counted: an operator who has to look at more of them looks at the tables

std::string shown(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

// The row of a table as its page shows it (the keys of tables.hpp); "" = it is of another part system, or tells nothing to an operator.
std::string row_name(const std::string& key, unsigned system) {
  std::istringstream words(key);
  std::string kind, second, third;
  unsigned first = 0;
  words >> kind >> first >> second >> third;
  if (kind == "tool") return "tool offset " + std::to_string(first) + " column " + second;
  if (kind == "life") return "life of tool " + std::to_string(first) + " column " + second;
  if (first != system) return "";
  if (kind == "work") return "work offset " + second + " " + third;
  if (kind == "parameter") return "parameter " + third + (second == "-" ? "" : " " + second);
  return "";
}

}  // namespace

std::string skipped_writes(const KeptValues& before, const KeptValues& after, unsigned system, const nc_variable_range& local) {
  std::vector<std::string> writes;
  for (const VariableChange& change : changed_variables(before.variables, after.variables, system))
    if (change.number < local.first || change.number > local.last)
      writes.push_back("#" + std::to_string(change.number) + (change.vacant ? " is vacant" : " = " + shown(change.is)) + " (it was " + shown(change.was) + ")");
  for (const TableChange& change : changed_tables(before.tables, after.tables))
    if (const std::string name = row_name(change.key, system); !name.empty())
      writes.push_back(name + " = " + (change.is.empty() ? "as it was made" : change.is) + " (it was " + (change.was.empty() ? "as it was made" : change.was) + ")");
  std::string text;
  for (std::size_t i = 0; i < writes.size() && i < kNamed; ++i) text += (i == 0 ? "" : ", ") + writes[i];
  return writes.size() > kNamed ? text + " and " + std::to_string(writes.size() - kNamed) + " more" : text;
}

}  // namespace nc::rt
