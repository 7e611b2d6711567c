// SPDX-License-Identifier: Apache-2.0
// What the family's table says of a parameter: its meaning, its unit or values, its section in the manual.
#pragma once

#include <string>
#include <vector>

#include "nc/dialects.h"

namespace nc::rt::services {

struct ParameterMeaning {
  std::string key;      // as nc_parameter_set() takes it: "1078", "1267/bit0", "UNIT*10"
  std::string name;     // "" = nothing in the control asks for it
  std::string values;   // unit and range, or the possible values with the one first that holds while it is not set
  std::string section;
  bool by_axis = false;
};

// All of the family, each with a key of its own, in the order of its table.
std::vector<ParameterMeaning> parameter_meanings(nc_dialect dialect);

// That of a parameter, of which a bit has the one of the whole parameter where it has none of its own; with an empty name where the table has none.
ParameterMeaning parameter_meaning(nc_dialect dialect, const std::string& key);

// "0 to 3: corner chamfering (M700 8.2)": what is named where a value is refused; "" = nothing is known.
std::string parameter_range_text(nc_dialect dialect, const std::string& key);

}  // namespace nc::rt::services
