// SPDX-License-Identifier: Apache-2.0
// What the readers and writers of system variables get (M700 13.5.5), for the files that hold them.
#pragma once

#include <cmath>

#include "interpret/interpreter.hpp"

namespace nc {

/// One access to one variable.
struct Access {
  Interpreter& in;
  uint32_t part, index;     ///< which part of its meaning is accessed (dialect/variable_rows.hpp)
  uint32_t number;          ///< number of the variable, used only in alarms
  Value* value = nullptr;   ///< reading: receives the value
  uint32_t* sync = nullptr; ///< reading: receives the nc_sync_what bits that are missing
  double written = 0;       ///< writing: the value
  const Statement* statement = nullptr;
};

using VariableGet = Eval (*)(Access& a);
using VariableSet = Execution (*)(Access& a);

/// How one meaning is read and written.
struct VariableHandler {
  SystemVariable what;
  VariableGet read;         ///< nullptr: cannot be read (P243)
  VariableSet write;        ///< nullptr: cannot be written (P243)
  uint32_t sync;            ///< nc_sync_what bits: the value exists only when everything before has been executed; 0 = it is read ahead
};

inline Eval give(Access& a, double number) {
  *a.value = Value::of(number);
  return Eval::ok;
}

inline Eval no_variable(Access& a) {
  a.in.raise(Condition::variable_number, Sign::variable, a.number);
  return Eval::fault;
}

/// The value exists only when everything before has been executed: whether the answer is there. If not, *a.sync gets `what`.
inline bool world_known(Access& a, uint32_t what) {
  if (a.in.world_fresh) return true;
  *a.sync = what;
  return false;
}

/// Part systems share the value: whether the machine has come to this block. If not, *a.sync gets NC_SYNC_SHARED.
inline bool shared_known(Access& a) {
  if (a.in.shared_known()) return true;
  *a.sync = NC_SYNC_SHARED;
  return false;
}

/// The value rounded to whole units, a half away from 0; noise of adding up does not count. `unit` is a power of ten below 1; the result is divided by its
/// inverse, which gives the double nearest to the decimal number, so that it compares and prints as that number.
inline double whole_units(double value, double unit) {
  constexpr double kNoise = 1e-9;  // mm, inch, deg: a hundredth of the finest unit
  const double per_one = std::nearbyint(1 / unit);
  const double whole = std::floor((std::fabs(value) + kNoise) * per_one + 0.5) / per_one;
  return value < 0 ? 0 - whole : whole;
}

// machine_data_variables.cpp
Eval read_rotation(Access& a);
Execution select_tool_group(Access& a);
Eval read_tool_group(Access& a);
Eval read_tool_life(Access& a);
Execution select_parameter(Access& a);
Eval read_parameter(Access& a);
Eval read_parameter_itself(Access& a);
Execution write_parameter_itself(Access& a);
Execution select_device(Access& a);
Eval read_device(Access& a);

}  // namespace nc
