// SPDX-License-Identifier: Apache-2.0
// Any bytes as tables in TOML, which a client of the services sends. What is taken names places whose keys are read back, each of them once, with values that are
// numbers, vacant, or names; what is refused has a sentence.
#include <set>

#include "fuzz/input.hpp"
#include "runtime/services/table_toml.hpp"
#include "runtime/toml_reader.hpp"

namespace {

using namespace nc::rt::services;
using nc::fuzz::require;
using Table = TablePlace::Table;

// Two part systems with some axes; nothing else of the configuration is asked for.
const nc::rt::Config& machine() {
  static const nc::rt::Config config = [] {
    nc::rt::Config made;
    made.nc.system_count = 2;
    made.nc.system[0].axis_count = 3;
    made.nc.system[1].axis_count = 1;
    for (unsigned a = 0; a < 3; ++a) made.nc.system[0].axis[a].name = "XYZ"[a];
    made.nc.system[1].axis[0].name = 'X';
    return made;
  }();
  return config;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<TableValue> values;
  const std::string wrong = parse_tables_toml(machine(), {reinterpret_cast<const char*>(data), size}, &values);
  if (!wrong.empty()) return 0;
  require(!values.empty());
  std::set<std::string> keys;
  for (const auto& [place, value, line] : values) {
    require(line != 0);
    TablePlace back;
    const std::string key = place_key(place);
    require(keys.insert(key).second && parse_place(key, &back) && place_key(back) == key);
    require(place.table != Table::kParameter && place.system < 2);
    double number = 0;
    if (place.table == Table::kVariableName) require(value.size() <= 7);
    else require(parse_number(value, &number) || (place.table == Table::kVariable && value.empty()));
    if (!value.empty() && place.table != Table::kVariableName) require(nc::rt::number_text(number) == value);
  }
  return 0;
}
