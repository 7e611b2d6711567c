// SPDX-License-Identifier: Apache-2.0
// System variables that read what lies outside the program: coordinate rotation, tool life, parameters, devices of the PLC
// (M700 13.5.5).
#include <cmath>
#include <cstring>
#include <numbers>

#include "dialect/text.hpp"
#include "interpret/system_variable_table.hpp"

namespace nc {
namespace {

/// The manual's devices: code, width, number of them.
struct Device {
  uint8_t code;
  bool word;
  uint32_t count;
};
constexpr Device kDevices[] = {
    {0, false, 10240}, {1, true, 2048},    {2, false, 256}, {4, false, 0x2000}, {5, false, 0x2000}, {6, true, 13312},
    {7, false, 704},   {9, false, 128},    {10, false, 1024}, {13, false, 512}, {18, false, 256},   {19, false, 64},
    {20, true, 128},   {21, false, 0x200}, {22, true, 0x200}, {23, false, 0x2000}, {24, true, 0x2000},
};

const Device* find_device(double code) {
  for (const Device& device : kDevices)
    if (device.code == code) return &device;
  return nullptr;
}

double selected(const Interpreter& in, unsigned what) { return in.notes.get(Notes::select_key(what)); }

Did no_such(Access& a) { return a.in.raise(Condition::no_such_data, '#', a.written); }

bool whole_between(double value, double low, double high) { return value >= low && value <= high && value == std::trunc(value); }

/// Bits of the selected devices from #100101 on, `count` of them; what lies beyond the last device is 0.
uint64_t device_bits(const Interpreter& in, const Device& device, uint32_t number, unsigned count) {
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

// ---- #30060-#30068 (10.14): coordinate rotation by program ----------------------------------------------------------------

Eval read_rotation(Access& a) {
  const int16_t plane = a.in.state.modal.code[kGroupPlane];
  const char letter[2] = {plane == 180 ? 'Z' : plane == 190 ? 'Y' : 'X', plane == 180 ? 'X' : plane == 190 ? 'Z' : 'Y'};
  const double degrees = a.in.notes.get(Notes::rotation_key(Notes::kRotationAngle)), angle = degrees * std::numbers::pi / 180;
  switch (a.offset) {
    case 0:
    case 1: return give(a, a.in.axis_of[letter[a.offset] - 'A'] + 1);
    case 6: return give(a, a.in.state.rotated ? std::cos(angle) : 1);
    case 2:
    case 3:  // a position: it was where the program stood, or has moved with an offset
      return give(a, a.in.state.rotated ? whole_units(a.in.notes.get(Notes::rotation_key(a.offset - 2)), a.in.settings.setting_unit_mm) : 0);
    case 4: return give(a, a.in.state.rotated ? degrees : 0);
    case 5: return give(a, a.in.state.rotated ? std::sin(angle) : 0);
    default: return give(a, 0);
  }
}

// ---- #60000 and up (10.15): no group is registered ------------------------------------------------------------------------------

Did select_tool_group(Access& a) {
  if (!whole_between(a.written, 0, 99999999)) return a.in.raise(Condition::value_range, '#', a.written);
  a.in.set_note(Notes::select_key(Notes::kToolGroup), a.written);
  return Did::done;
}

Eval read_tool_group(Access& a) { return give(a, -1); }

/// Registration numbers 1 to 200 behind each base (M system).
Eval read_tool_life(Access& a) {
  const uint32_t r = a.number % 500;
  return r >= 1 && r <= 200 ? give(a, -1) : no_variable(a);
}

// ---- #100000 and up (10.16) ---------------------------------------------------------------------------------------------------------

Did select_parameter(Access& a) {
  constexpr double kLast[3] = {99999, 1, NC_MAX_AXES};
  const double low = a.offset == 1 ? 0 : 1;
  if (!whole_between(a.written, low, kLast[a.offset])) return no_such(a);
  if (a.offset == 2 && a.written > a.in.axis_count) return no_such(a);
  a.in.set_note(Notes::select_key(Notes::kParameter + a.offset), a.written);
  return Did::done;
}

/// What the configuration of the machine says and no parameter repeats; false: nothing of it.
bool machine_parameter(const Interpreter& in, uint32_t number, unsigned axis, double* value) {
  switch (number) {
    case 1002: *value = in.axis_count; return true;                      // axisno, the manual's own example
    case 1013: *value = in.system->axis[axis].name; return true;         // axname
    case 1017: *value = (in.rotary >> axis) & 1; return true;            // rot
    default: return false;
  }
}

/// A parameter that nobody has set reads 0. Text of one letter reads as its code.
Eval read_parameter(Access& a) {
  char key[12];
  const double selection = selected(a.in, Notes::kParameter);
  const uint32_t number = selection >= 1 ? static_cast<uint32_t>(selection) : 1u;
  TextWriter(key, sizeof key).put_integer(number);
  const double axis = selected(a.in, Notes::kAxis);
  double value = 0;
  const int index = axis >= 1 ? static_cast<int>(axis) - 1 : 0;
  if (machine_parameter(a.in, number, static_cast<unsigned>(index), &value)) return give(a, value);
  if (!a.in.parameters.get(key, index, &value) && a.in.parameters.text(key, index) != nullptr) {  // a long text is no number
    a.in.raise(Condition::no_such_data, '#', a.number);
    return Eval::fault;
  }
  return give(a, value);
}

// ---- #100100 and up (10.17) ---------------------------------------------------------------------------------------------------------

Did select_device(Access& a) {
  const bool good = a.offset == 0   ? a.in.devices.read != nullptr && find_device(a.written) != nullptr
                    : a.offset == 1 ? whole_between(a.written, 0, 99999)
                    : a.offset == 2 ? a.written == 0 || a.written == 1 || a.written == 101 || a.written == 2 || a.written == 102 ||
                                          a.written == 4 || a.written == 104
                                    : whole_between(a.written, 0, 15);  // (4) (b): a device has 16
  if (!good) return no_such(a);
  a.in.set_note(Notes::select_key(Notes::kDevice + a.offset), a.written);
  return Did::done;
}

Eval read_device(Access& a) {
  if (!world_known(a, NC_SYNC_INPUT)) return Eval::need_sync;
  const Device* device = find_device(selected(a.in, Notes::kDevice));
  if (a.in.devices.read == nullptr || device == nullptr) {
    a.in.raise(Condition::no_such_data, '#', a.number);
    return Eval::fault;
  }
  const auto number = static_cast<uint32_t>(selected(a.in, Notes::kDeviceNumber));
  if (number >= device->count) {  // (2); only what lies behind an existing one reads 0
    a.in.raise(Condition::no_such_data, '#', number);
    return Eval::fault;
  }
  const auto bytes = static_cast<uint32_t>(selected(a.in, Notes::kBytes));
  if (bytes == 0) {  // one bit: of a word its bit #100103
    const auto bit = static_cast<unsigned>(selected(a.in, Notes::kBit));
    return give(a, static_cast<double>(device_bits(a.in, *device, number, device->word ? 32 : 1) >> (device->word ? bit : 0) & 1));
  }
  const unsigned width = bytes % 100 * 8;
  const uint64_t bits = device_bits(a.in, *device, number, width);
  if (bytes < 100 || (bits >> (width - 1) & 1) == 0) return give(a, static_cast<double>(bits));
  return give(a, static_cast<double>(bits) - std::ldexp(1.0, static_cast<int>(width)));  // two's complement
}

}  // namespace nc
