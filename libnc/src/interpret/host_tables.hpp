// SPDX-License-Identifier: Apache-2.0
// The tables of one part system as the host reads and writes them: parameters, offsets, variables, outputs of the macro interface. No rewind undoes what
// the host writes, and the host writes to shared places for all part systems.
#pragma once

#include <type_traits>

#include "dialect/parameter.hpp"
#include "frame/frames.hpp"
#include "frame/tool_life.hpp"
#include "interpret/motion_settings.hpp"
#include "macro/variables.hpp"
#include "nc/control.h"

namespace nc {

struct Interpreter;

/// A handle; the interpreter must outlive it.
class HostTables {
 public:
  explicit HostTables(Interpreter& in) : in_(&in) {}

  nc_status set_parameter(const char* key, int axis, const char* text) const;
  bool parameter(const char* key, int axis, double* value) const;  ///< 0 where it is not set; false: there is no such key
  double parameter(ParameterOf parameter, int axis = -1) const;
  /// The first parameter that is set, from *place on; false: there is none. Gives its key, its axis (-1 = for all axes), and its value: a number, or a text.
  bool next_parameter(unsigned* place, char key[24], int* axis, double* number, char text[64]) const;
  bool whole_positions() const;  ///< a position without a point is in mm, inch or deg; else it counts in the least unit
  int axis_named(char name) const;  ///< index of the axis, -1 = there is no such axis
  const FilterParameters& filters() const;
  const Frames& frames() const;
  void set_table(unsigned key, double value) const;
  /// Outputs of the macro interface after the blocks that were read so far.
  uint32_t interface_output(unsigned word) const;
  void set_interface_output(unsigned word, uint32_t mask, uint32_t bits) const;
  void set_tool(unsigned number, nc_tool_column column, double value) const;
  const ToolLives& lives() const;
  /// For each type of a member of ToolLife.
  template <class Member>
  void set_life(unsigned slot, Member ToolLife::*member, std::type_identity_t<Member> value) const;
  /// False: there is no such variable.
  bool variable(uint32_t number, Value* value) const;
  bool set_variable(uint32_t number, Value value) const;
  bool next_variable(uint32_t from, uint32_t* number, double* value) const;
  unsigned variable_name(uint32_t number, char* name) const;  ///< returns the length of the name, 0 = none
  bool set_variable_name(uint32_t number, const char* name) const;
  void set_devices(nc_device_read read, void* user) const;

 private:
  Interpreter* in_;
};

}  // namespace nc
