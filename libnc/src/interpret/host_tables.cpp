// SPDX-License-Identifier: Apache-2.0
// The tables of an interpreter as the host sees them.
#include "interpret/host_tables.hpp"

#include <cstring>

#include "interpret/interpreter.hpp"
#include "interpret/journal_keys.hpp"
#include "interpret/shared_tables.hpp"

namespace nc {

nc_status HostTables::set_parameter(const char* key, int axis, const char* text) const {
  unsigned changed = 0;
  ParameterValue before;
  const nc_status status = in_->parameters.set(*in_->dialect, key, axis, text, &changed, &before);
  if (status != NC_OK) return status;
  in_->refresh_settings();
  in_->variables.changed_from_outside(kParameterKey + changed, in_->parameters.stored(changed).journalled());
  if (in_->shared != nullptr) in_->shared->parameter_changed(*in_, changed);
  return NC_OK;
}
bool HostTables::whole_positions() const { return in_->settings.whole_positions(); }

bool HostTables::parameter(const char* key, int axis, double* value) const {
  ParameterId id;
  int bit = -1;
  if (!parse_parameter(*in_->dialect, key, &id, &bit)) return false;
  *value = 0;
  in_->parameters.get(id, bit, axis, value);
  return true;
}
double HostTables::parameter(ParameterOf parameter, int axis) const {
  double value = 0;
  in_->parameters.get(*in_->dialect, parameter, axis, &value);
  return value;
}
bool HostTables::next_parameter(unsigned* place, char key[24], int* axis, double* number, char text[64]) const {
  ParameterId id;
  ParameterValue found;
  do {
    if (!in_->parameters.at(*place, &id, axis, &found)) return false;
    ++*place;
  } while (!found.is_set());  // skip parameters whose setting has been taken back
  --*place;
  char name[kParameterKeySize];
  put_parameter_key(*in_->dialect, id, name);
  std::memcpy(key, name, sizeof name);
  const char* const words = in_->parameters.text(found);
  *number = found.number.value_or(0);
  text[0] = 0;
  if (words != nullptr) std::memcpy(text, words, std::strlen(words) + 1);
  return true;
}
int HostTables::axis_named(char name) const { return in_->axis_words.axis_named(name); }
const FilterParameters& HostTables::filters() const { return in_->settings.filters; }

const Frames& HostTables::frames() const { return in_->frames; }
void HostTables::set_table(unsigned key, double value) const { in_->set_table_from_outside(key, value); }
uint32_t HostTables::interface_output(unsigned word) const { return in_->records->output[word].bits; }
void HostTables::set_interface_output(unsigned word, uint32_t mask, uint32_t bits) const {
  in_->records.change_bits_from_outside(&ProgramRecords::output, word, InterfaceOutput{bits}, InterfaceOutput{mask});
}
void HostTables::set_tool(unsigned number, nc_tool_column column, double value) const {
  const unsigned key = in_->frames.tool_key(number, column);
  if (in_->shared != nullptr) {
    in_->shared->set_tool(key, value);
  } else {
    in_->set_table_from_outside(key, value);
  }
}

const ToolLives& HostTables::lives() const { return *in_->lives; }

template <class Member>
void HostTables::set_life(unsigned slot, Member ToolLife::*member, std::type_identity_t<Member> value) const {
  const auto write = [=](Interpreter& in) { in.lives.change_from_outside(&ToolLives::tool, slot, member, value); };
  if (in_->shared != nullptr) {
    in_->shared->write_to_all(in_->lives.key(&ToolLives::tool, slot, member), write);
  } else {
    write(*in_);
  }
}
template void HostTables::set_life(unsigned, uint64_t ToolLife::*, uint64_t) const;
template void HostTables::set_life(unsigned, double ToolLife::*, double) const;
template void HostTables::set_life(unsigned, LifeFlags ToolLife::*, LifeFlags) const;
template void HostTables::set_life(unsigned, LifeStatus ToolLife::*, LifeStatus) const;

bool HostTables::variable(uint32_t number, Value* value) const { return in_->variables.get(number, in_->macro_level(), value); }
bool HostTables::set_variable(uint32_t number, Value value) const {
  if (in_->shared != nullptr && in_->variables.shares(number)) {
    in_->shared->set_variable(number, value);
    return true;
  }
  return in_->variables.set_from_outside(number, in_->macro_level(), value);
}
bool HostTables::next_variable(uint32_t from, uint32_t* number, double* value) const { return in_->variables.next(from, number, value); }
unsigned HostTables::variable_name(uint32_t number, char* name) const { return in_->variables.name_of(number, name); }
bool HostTables::set_variable_name(uint32_t number, const char* name) const {
  if (!in_->variables.name_from_outside(number, name)) return false;
  if (in_->shared != nullptr) in_->shared->set_name(number, name);
  return true;
}
void HostTables::set_devices(nc_device_read read, void* user) const { in_->devices = {read, user}; }

}  // namespace nc
