// SPDX-License-Identifier: Apache-2.0
// The tables of one part system as the host reads and writes them: parameters, offsets, variables, outputs of the macro interface. What the
// host writes no rewind brings back, and other part systems that share it have it, too.
#pragma once

#include "dialect/parameter.hpp"
#include "frame/frames.hpp"
#include "interpret/motion_settings.hpp"
#include "macro/variables.hpp"
#include "nc/control.h"

namespace nc {

struct Interpreter;

/// Handle; the interpreter outlives it.
class HostTables {
 public:
  explicit HostTables(Interpreter& in) : in_(&in) {}

  nc_status set_parameter(const char* key, int axis, const char* text) const;
  double parameter(const char* key, int axis) const;  ///< 0 where it is not set
  double parameter(ParameterOf parameter, int axis = -1) const;
  /// The first parameter from *place on that has been set; false: there is none. Key, axis (-1 = of none) and what it is: a number, or a text.
  bool next_parameter(unsigned* place, char key[24], int* axis, double* number, char text[64]) const;
  int axis_named(char name) const;  ///< its index, -1 = none
  const FilterParameters& filters() const;
  const Frames& frames() const;
  void set_table(unsigned key, double value) const;
  /// The macro interface's outputs as read ahead.
  uint32_t interface_output(unsigned word) const;
  void set_interface_output(unsigned word, uint32_t mask, uint32_t bits) const;
  void set_tool(unsigned number, nc_tool_column column, double value) const;
  /// False: there is no such variable.
  bool variable(uint32_t number, Value* value) const;
  bool set_variable(uint32_t number, Value value) const;
  bool next_variable(uint32_t from, uint32_t* number, double* value) const;
  unsigned variable_name(uint32_t number, char* name) const;  ///< its length
  bool set_variable_name(uint32_t number, const char* name) const;
  void set_devices(nc_device_read read, void* user) const;

 private:
  Interpreter* in_;
};

}  // namespace nc
