// SPDX-License-Identifier: Apache-2.0
#include "control/vendor_check.hpp"

#include <cmath>

#include "base/struct_size.hpp"

namespace nc {
namespace {

constexpr const char* kSize = "must be the size of its struct; what this library does not know behind its own end must be 0";

/// Codes that the control itself looks for when it reads programs; a vendor's function in the place of one would never be called.
bool irreplaceable(const FunctionRow& row) {
  return is_macro_call(row.function) || row.function == Function::macro_modal_off || row.function == Function::data_input ||
         ends_data_input(row.function);
}

VendorFault check_number(const Dialect& dialect, const nc_vendor_code& code) {
  constexpr const char *kKept = "is a code that programs are stopped, ended and called by, or whose words are data: it cannot be replaced",
                       *kTaken = "is a code of the dialect; override_dialect takes its place";
  if (code.letter == dialect.addresses.letter(Role::misc_code)) {
    if (code.number > 99999999) return {"number", "must be 0 to 99999999"};
    if (find_misc(dialect, code.number) != nullptr) return {"number", kKept};
    if (misc_function(dialect, code.number) != MiscFunction::output && !code.override_dialect) return {"number", kTaken};
    return {};
  }
  if (code.letter != dialect.addresses.letter(Role::code)) return {"letter", "must be 'G' or 'M'"};
  constexpr uint32_t kHighest = 9999;
  if (code.number > kHighest) return {"number", "must be 0 to 9999: ten times the code"};
  const FunctionRow* const row = find_function(dialect, static_cast<int>(code.number));
  if (row == nullptr || row->function == Function::user_macro) return {};
  if (irreplaceable(*row)) return {"number", kKept};
  return code.override_dialect ? VendorFault{} : VendorFault{"number", kTaken};
}

VendorFault check_call(const Dialect& dialect, const nc_vendor_code& code) {
  if (code.call > NC_CALL_EVERY_BLOCK) return {"call", "must be an nc_call_type"};
  if (code.function != nullptr) return code.program == 0 ? VendorFault{} : VendorFault{"program", "must be 0 where there is a function"};
  if (code.program == 0) return {"function", "must not be NULL where program is 0"};
  if (code.program > 99999999) return {"program", "must be 1 to 99999999"};
  if (dialect.call_depth == 0 || dialect.argument_of == nullptr) return {"program", "must be 0: this dialect calls no programs"};
  return {};
}

bool limit(double value) { return std::isfinite(value) && value >= 0; }

}  // namespace

bool take_vendor_code(const nc_vendor_code* rows, unsigned index, nc_vendor_code* known) {
  const uint32_t bytes = caller_bytes(rows);
  if (bytes == 0) return false;
  const auto* const row = reinterpret_cast<const nc_vendor_code*>(reinterpret_cast<const unsigned char*>(rows) + size_t{bytes} * index);
  return caller_bytes(row) == bytes && take_struct(row, known);
}

VendorFault check_vendor_code(const Dialect& dialect, const nc_vendor_code* rows, unsigned index) {
  nc_vendor_code code{};
  if (!take_vendor_code(rows, index, &code)) return {"struct_size", kSize};
  if (const VendorFault fault = check_number(dialect, code); fault.member != nullptr) return fault;
  for (unsigned i = 0; i < index; ++i) {
    nc_vendor_code before{};
    if (take_vendor_code(rows, i, &before) && before.letter == code.letter && before.number == code.number) return {"number", "is the code of a row before it"};
  }
  return check_call(dialect, code);
}

VendorFault check_kinematics(const nc_kinematics& given) {
  nc_kinematics known{};
  if (!take_struct(&given, &known)) return {"struct_size", kSize};
  if (known.joint_count < 1 || known.joint_count > NC_MAX_AXES) return {"joint_count", "must be 1 to 8"};
  if (known.inverse == nullptr) return {"inverse", "must not be NULL"};
  for (unsigned i = 0; i < known.joint_count; ++i) {
    const nc_joint_config& joint = known.joint[i];
    const int at = static_cast<int>(i);
    if (!std::isfinite(joint.max)) return {"max", "must be a finite number", at};
    if (!std::isfinite(joint.min) || (joint.min >= joint.max && (joint.min != 0 || joint.max != 0))) return {"min", "must be below max, or both 0", at};
    if (!limit(joint.max_velocity)) return {"max_velocity", "must be 0 or more; 0 = any", at};
    if (!limit(joint.max_acceleration)) return {"max_acceleration", "must be 0 or more; 0 = any", at};
  }
  return {};
}

}  // namespace nc
