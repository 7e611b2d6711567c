// SPDX-License-Identifier: Apache-2.0
// Structs of a caller that was compiled with another version of the headers (nc/types.h, NC_STRUCT_SIZE).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "nc/nc.h"

namespace nc {

/// Bytes of a struct whose last member ends at `end`: rounded up to where the next element of an array would begin.
template <class T>
constexpr uint32_t padded(size_t end) {
  return static_cast<uint32_t>((end + alignof(T) - 1) / alignof(T) * alignof(T));
}
#define NC_END_OF(type, member) (offsetof(type, member) + sizeof(type::member))

/// Bytes of T in the first version with this NC_ABI, named by its last member then: what a struct_size of 0 stands for. From the release of
/// that version on these rows never change.
template <class T>
inline constexpr uint32_t kFirstSize = 0;
template <>
inline constexpr uint32_t kFirstSize<nc_config> = padded<nc_config>(NC_END_OF(nc_config, kinematics));
template <>
inline constexpr uint32_t kFirstSize<nc_config_fault> = padded<nc_config_fault>(NC_END_OF(nc_config_fault, reason));
template <>
inline constexpr uint32_t kFirstSize<nc_inputs> = padded<nc_inputs>(NC_END_OF(nc_inputs, tool_broken));
template <>
inline constexpr uint32_t kFirstSize<nc_outputs> = padded<nc_outputs>(NC_END_OF(nc_outputs, tool_group));
template <>
inline constexpr uint32_t kFirstSize<nc_tap> = padded<nc_tap>(NC_END_OF(nc_tap, acceleration));
template <>
inline constexpr uint32_t kFirstSize<nc_world> = padded<nc_world>(NC_END_OF(nc_world, run_ms));
template <>
inline constexpr uint32_t kFirstSize<nc_item> =
    padded<nc_item>(offsetof(nc_item, u) + NC_END_OF(nc_move, index_axes));  // its longest payload
template <>
inline constexpr uint32_t kFirstSize<nc_passed> = padded<nc_passed>(NC_END_OF(nc_passed, source));
template <>
inline constexpr uint32_t kFirstSize<nc_event> = padded<nc_event>(NC_END_OF(nc_event, machine));
template <>
inline constexpr uint32_t kFirstSize<nc_alarm> = padded<nc_alarm>(NC_END_OF(nc_alarm, source));
template <>
inline constexpr uint32_t kFirstSize<nc_modal> = padded<nc_modal>(NC_END_OF(nc_modal, b));
template <>
inline constexpr uint32_t kFirstSize<nc_program_info> = padded<nc_program_info>(NC_END_OF(nc_program_info, is_protected));
template <>
inline constexpr uint32_t kFirstSize<nc_vendor_code> = padded<nc_vendor_code>(NC_END_OF(nc_vendor_code, user));
template <>
inline constexpr uint32_t kFirstSize<nc_kinematics> = padded<nc_kinematics>(NC_END_OF(nc_kinematics, user));
template <>
inline constexpr uint32_t kFirstSize<nc_function> = padded<nc_function>(NC_END_OF(nc_function, section));
template <>
inline constexpr uint32_t kFirstSize<nc_block_text> = padded<nc_block_text>(NC_END_OF(nc_block_text, used));
template <>
inline constexpr uint32_t kFirstSize<nc_system_variable> = padded<nc_system_variable>(NC_END_OF(nc_system_variable, section));
template <>
inline constexpr uint32_t kFirstSize<nc_parameter> = padded<nc_parameter>(NC_END_OF(nc_parameter, section));
template <>
inline constexpr uint32_t kFirstSize<nc_parameter_note> = padded<nc_parameter_note>(NC_END_OF(nc_parameter_note, key));
template <>
inline constexpr uint32_t kFirstSize<nc_restart_place> = padded<nc_restart_place>(NC_END_OF(nc_restart_place, start));
template <>
inline constexpr uint32_t kFirstSize<nc_restart_found> = padded<nc_restart_found>(NC_END_OF(nc_restart_found, output_written));
#undef NC_END_OF

/// More bytes than any struct of any version will have. A larger struct_size is one that was never set.
constexpr uint32_t kMostStructBytes = 1u << 16;

/// Bytes of a caller's struct; 0 when its struct_size is not valid.
template <class T>
uint32_t caller_bytes(const T* of_caller) {
  static_assert(kFirstSize<T> >= sizeof(uint32_t) && kFirstSize<T> <= sizeof(T));
  uint32_t bytes;
  std::memcpy(&bytes, of_caller, sizeof bytes);  // only the first four bytes are sure to be there
  if (bytes == 0) return kFirstSize<T>;
  return bytes >= sizeof bytes && bytes <= kMostStructBytes ? bytes : 0;
}

/**
 * Copies a caller's struct over *known, which holds the defaults.
 * @return false when its struct_size is not valid, or a byte behind what this library knows is not 0
 */
template <class T>
bool take_struct(const T* given, T* known) {
  const uint32_t bytes = caller_bytes(given);
  if (bytes == 0) return false;
  const auto* const from = reinterpret_cast<const unsigned char*>(given);
  for (size_t i = sizeof(T); i < bytes; ++i)
    if (from[i] != 0) return false;
  std::memcpy(static_cast<void*>(known), from, bytes < sizeof(T) ? bytes : sizeof(T));
  known->struct_size = sizeof(T);
  return true;
}

/// Gives a caller as much of `known` as its struct has room for; the caller's struct_size stays.
template <class T>
void give_struct(const T& known, T* to_caller) {
  const uint32_t bytes = caller_bytes(to_caller);
  const size_t both = bytes < sizeof(T) ? bytes : sizeof(T);
  if (both <= sizeof bytes) return;
  std::memcpy(reinterpret_cast<unsigned char*>(to_caller) + sizeof bytes, reinterpret_cast<const unsigned char*>(&known) + sizeof bytes,
              both - sizeof bytes);
}

}  // namespace nc
