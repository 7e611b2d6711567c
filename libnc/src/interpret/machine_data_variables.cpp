// SPDX-License-Identifier: Apache-2.0
// System variables that read what lies outside the program: coordinate rotation, tool life, parameters, devices of the PLC
// (M700 13.5.5).
#include <cmath>
#include <cstring>
#include <numbers>

#include "base/units.hpp"
#include "frame/tool_life.hpp"
#include "interpret/functions/functions.hpp"
#include "interpret/interpreter.hpp"
#include "interpret/plane.hpp"
#include "interpret/system_variable_table.hpp"

namespace nc {
namespace {

const DeviceRow* find_device(const Interpreter& in, double code) {
  for (const DeviceRow& device : in.dialect->variables->devices)
    if (device.code == code) return &device;
  return nullptr;
}

const DeviceWidth* find_width(const Interpreter& in, double written) {
  for (const DeviceWidth& width : in.dialect->variables->device_widths)
    if (width.written == written) return &width;
  return nullptr;
}

Execution no_such(Access& a) { return a.in.raise(Condition::no_such_data, Sign::variable, a.written); }

bool whole_between(double value, double low, double high) { return value >= low && value <= high && value == std::trunc(value); }

/// `count` bits of devices, from device `number` on; bits beyond the last device are 0.
uint64_t device_bits(const Interpreter& in, const DeviceRow& device, uint32_t number, unsigned count) {
  uint64_t bits = 0;
  if (device.word) {
    for (unsigned i = 0; i * 16 < count; ++i) {
      uint32_t value = 0;
      if (number + i < device.count) in.devices.read(in.devices.user, device.code, number + i, &value);
      bits |= uint64_t{value & 0xffff} << (16 * i);
    }
    return count < 16 ? bits & ((uint64_t{1} << count) - 1) : bits;
  }
  for (unsigned i = 0; i < count; ++i) {
    uint32_t value = 0;
    if (number + i < device.count) in.devices.read(in.devices.user, device.code, number + i, &value);
    bits |= uint64_t{value & 1} << i;
  }
  return bits;
}

}  // namespace

// ---- coordinate rotation by parameter (M700 13.5.5 (10.14), 13.21) ---------------------------------------------------------

/// The "coordinate rotation parameters" are those of 13.21 in their order (#8621 to #8627) with sine and cosine of their angle, as they are in force.
Eval read_rotation(Access& a) {
  const WorkTurn& turn = a.in.records->work_turn.commanded;
  const double angle = turn.deg * std::numbers::pi / 180;
  switch (a.index) {
    case 0:
    case 1: return give(a, turn.axis[a.index] + 1);
    case 2:
    case 3: return give(a, turn.center[a.index - 2]);
    case 4: return give(a, turn.deg);
    case 5: return give(a, std::sin(angle));
    case 6: return give(a, std::cos(angle));
    default: return give(a, a.in.settings.work_turn_vector[a.index - 7]);
  }
}

// ---- tool life (13.5.5, 10.15) ---------------------------------------------------------------------------------------------------------

Execution select_tool_group(Access& a) {
  if (!whole_between(a.written, 0, a.in.dialect->rules.range.largest_life_number)) return a.in.raise(Condition::value_range, Sign::variable, a.written);
  a.in.change(&ProgramRecords::selection, &Selection::tool_group, static_cast<uint32_t>(a.written));
  return Execution::done;
}

/// Lives end as the machine cuts, so what is read has to wait for it.
bool lives_known(Access& a) { return shared_known(a) && (!a.in.settings.life_managed || world_known(a, NC_SYNC_CLOCK)); }

/// The group that is read: the one of #60000, else the first one registered.
uint64_t group_read(const Access& a) {
  const uint32_t chosen = a.in.records->selection.tool_group;
  return chosen != 0 ? chosen : a.in.lives->first_group();
}

/// #60001 to #60008; -1 where the group is not registered.
Eval read_tool_group(Access& a) {
  if (!lives_known(a)) return Eval::need_sync;
  const ToolLives& lives = *a.in.lives;
  const uint64_t group = group_read(a);
  const unsigned tools = lives.registered(group);
  if (tools == 0) return give(a, -1);
  const unsigned in_spindle = a.in.managed_tool(), now = lives.current_of(group, in_spindle), next = lives.next_of(group);
  switch (a.index) {
    case 0: return give(a, tools);
    case 1: return give(a, std::trunc(lives.tool[now].used));
    case 2: return give(a, lives.number_in_group(now));
    case 3: return give(a, lives.all_ended(group) ? 0 : lives.number_in_group(lives.first_alive(group)));
    case 4: return give(a, in_spindle == now ? 1 : 0);
    case 5: return give(a, 0);  // "not used"
    case 6: return give(a, lives.all_ended(group) ? 1 : 0);
    default: return give(a, lives.tool[next].status == LifeStatus::unused ? 1 : 0);
  }
}

/// #60501 to #64700, which have a variable for each registration number; -1 where no tool is registered.
Eval read_tool_life(Access& a) {
  if (!lives_known(a)) return Eval::need_sync;
  const unsigned slot = a.in.lives->nth(group_read(a), a.index + 1);
  if (slot == ToolLives::kNone) return give(a, -1);
  const auto column = static_cast<LifeColumn>(a.part);
  const double value = life_number(a.in.lives->tool[slot], column);
  return give(a, column == LifeColumn::used ? std::trunc(value) : value);
}

// ---- parameters (13.5.5, 10.16) ---------------------------------------------------------------------------------------------------------

/// A parameter whose value comes from the configuration of the machine; false: the number is not such a parameter.
bool machine_parameter(const Interpreter& in, uint32_t number, unsigned axis, double* value) {
  for (const MachineParameter& row : in.dialect->parameters->machine) {
    if (row.number != number) continue;
    switch (row.what) {
      case MachineDatum::system_used: *value = 1; return true;
      case MachineDatum::axis_count: *value = in.axis_count; return true;
      case MachineDatum::axis_name: *value = character_of(in.axis_words.word(axis)); return true;
      case MachineDatum::rotary: *value = (in.rotary >> axis) & 1; return true;
    }
  }
  return false;
}

/// M700 13.5.5 (10.16 (1)), 13.11: there are the parameters among the maker's numbers, those that the control uses, and those that somebody has set for this machine.
bool parameter_exists(const InForce& in, uint32_t number) {
  double value = 0;
  const NumberRange& there = in.dialect->parameters->there;
  if (number >= there.first && number <= there.last) return true;
  if (find_parameter(*in.dialect, ParameterKey{number, 0, -1}) != nullptr) return true;
  for (const MachineParameter& row : in.dialect->parameters->machine)
    if (row.number == number) return true;
  const ParameterId id = ParameterId::of_number(number);
  for (int axis = -1; axis < static_cast<int>(in.axis_count); ++axis)
    if (in.parameters.get(id, -1, axis, &value) || in.parameters.text(id, axis) != nullptr) return true;
  return false;
}

Execution select_parameter(Access& a) {
  const double last[3] = {static_cast<double>(a.in.dialect->rules.range.largest_parameter), 1, NC_MAX_AXES};
  const double low = a.index == 1 ? 0 : 1;
  if (!whole_between(a.written, low, last[a.index])) return no_such(a);
  if (a.index == 2 && a.written > a.in.axis_count) return no_such(a);
  if (a.index == 0 && !parameter_exists(a.in, static_cast<uint32_t>(a.written))) return no_such(a);
  Selection selection = a.in.records->selection;
  selection.parameter[a.index] = static_cast<uint32_t>(a.written);
  a.in.change(&ProgramRecords::selection, selection);
  return Execution::done;
}

/// M700 2.1 note 1, 13.5.5 "Precautions for reading parameters" (2), 13.11: mm of one unit of a parameter where a program reads or sets this value of it. The -1 of #8030 is no length
/// (13.18).
double unit_of_parameter(const InForce& in, uint32_t number, int axis, double value) {
  if (!in.settings.initial_inch) return 1;
  const ParameterRow* const row = find_parameter(*in.dialect, ParameterKey{number, 0, -1});
  if (row == nullptr || !is_length(row->what)) return 1;
  if (row->by_axis && axis >= 0 && ((in.rotary >> axis) & 1) != 0) return 1;
  return row->what == Parameter::spline_minute_length && value == -1 ? 1 : kMillimetresPerInch;
}

/// A parameter that was never set reads as 0. A text of one letter reads as the code of the letter.
Eval read_parameter(Access& a) {
  const auto& [selected, part, axis] = a.in.records->selection.parameter;
  const uint32_t number = selected >= 1 ? selected : 1u;
  double value = 0;
  const int index = axis >= 1 ? static_cast<int>(axis) - 1 : 0;
  if (machine_parameter(a.in, number, static_cast<unsigned>(index), &value)) return give(a, value);
  if (parameter_is_common(*a.in.dialect, number) && !shared_known(a)) return Eval::need_sync;
  const ParameterId id = ParameterId::of_number(number);
  if (!a.in.parameters.get(id, -1, index, &value) && a.in.parameters.text(id, index) != nullptr) {  // a long text cannot be read as a number
    a.in.raise(Condition::no_such_data, Sign::variable, a.number);
    return Eval::fault;
  }
  return give(a, value / unit_of_parameter(a.in, number, index, value));
}

/// HX 14.2.3: a parameter as a variable of its own number.
/// A number that nothing in the control asks for is no parameter: what a program means by it would be lost. One that the machine has set can be read.
bool known_parameter(const Access& a) { return find_parameter(*a.in.dialect, ParameterKey{a.number, 0, -1}) != nullptr; }

Eval read_parameter_itself(Access& a) {
  if (parameter_is_common(*a.in.dialect, a.number) && !shared_known(a)) return Eval::need_sync;
  double value = 0;
  const bool set = a.in.parameters.get(ParameterId::of_number(a.number), -1, -1, &value);
  return set || known_parameter(a) ? give(a, value) : no_variable(a);
}
Execution write_parameter_itself(Access& a) {
  if (!known_parameter(a)) return a.in.raise(Condition::variable_number, Sign::variable, a.number);
  if (parameter_is_common(*a.in.dialect, a.number) && !a.in.shared_known()) return a.in.need(NC_SYNC_SHARED);
  if (a.in.set_parameter(ParameterId::of_number(a.number), -1, -1, a.written)) return Execution::done;
  return a.in.raise(Condition::value_range, Sign::variable, a.written);
}

// ---- devices (13.5.5, 10.17) ---------------------------------------------------------------------------------------------------------

Execution select_device(Access& a) {
  const bool good = a.index == 0   ? a.in.devices.read != nullptr && find_device(a.in, a.written) != nullptr
                    : a.index == 1 ? whole_between(a.written, 0, a.in.dialect->rules.range.largest_device)
                    : a.index == 2 ? find_width(a.in, a.written) != nullptr
                                    : whole_between(a.written, 0, 15);  // (4) (b): a device has 16
  if (!good) return no_such(a);
  Selection selection = a.in.records->selection;
  selection.device[a.index] = static_cast<uint32_t>(a.written);
  a.in.change(&ProgramRecords::selection, selection);
  return Execution::done;
}

Eval read_device(Access& a) {
  if (!world_known(a, NC_SYNC_INPUT)) return Eval::need_sync;
  const auto& [code, number, written_width, bit] = a.in.records->selection.device;
  const DeviceRow* device = find_device(a.in, code);
  const DeviceWidth* width = find_width(a.in, written_width);
  if (a.in.devices.read == nullptr || device == nullptr || width == nullptr) {
    a.in.raise(Condition::no_such_data, Sign::variable, a.number);
    return Eval::fault;
  }
  if (number >= device->count) {  // (2): the device does not exist; only bits behind an existing device read as 0
    a.in.raise(Condition::no_such_data, Sign::variable, number);
    return Eval::fault;
  }
  const unsigned bytes = width->bytes;
  if (bytes == 0) {  // one bit: of a word the selected bit of it
    return give(a, static_cast<double>(device_bits(a.in, *device, number, device->word ? 32 : 1) >> (device->word ? bit : 0) & 1));
  }
  const unsigned count = bytes * 8u;
  const uint64_t bits = device_bits(a.in, *device, number, count);
  if (!width->is_signed || (bits >> (count - 1) & 1) == 0) return give(a, static_cast<double>(bits));
  return give(a, static_cast<double>(bits) - std::ldexp(1.0, static_cast<int>(count)));  // two's complement
}

}  // namespace nc
