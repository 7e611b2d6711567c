// SPDX-License-Identifier: Apache-2.0
// The tables of a family as the public API shows them. Documentation and HMIs can read them without creating a control.
#include "dialect/function_table.hpp"

#include <cstring>

#include "base/struct_size.hpp"
#include "dialect/dialect.hpp"
#include "dialect/text.hpp"

namespace nc {

void g_code_text(char letter, int code, char* text, size_t size) {
  TextWriter out(text, size);
  if (code < 0) return;
  const unsigned value = static_cast<unsigned>(code);
  out.put(letter).put_integer(value / 10, 2);
  if (value % 10 != 0) out.put('.').put_integer(value % 10);
}

void m_code_text(char letter, unsigned code, char* text, size_t size) {
  TextWriter(text, size).put(letter).put_integer(code, 2);
}

namespace {

/// Writes the name of a code, or where it has no row the word of codes and its number.
void code_name(const Dialect& dialect, Role role, const char* name, unsigned long long number, char* text, size_t size) {
  TextWriter out(text, size);
  if (name != nullptr) {
    out.put(name);
    return;
  }
  const char* const word = dialect.addresses.name(dialect.addresses.word(role));
  out.put(word != nullptr ? word : "").put(' ').put_integer(number);
}

}  // namespace

void g_code_text(const Dialect& dialect, int code, char* text, size_t size) {
  if (!dialect.codes_by_name || code < 0) return g_code_text(dialect.addresses.letter(Role::code), code, text, size);
  const FunctionRow* const row = find_function(dialect, code);
  code_name(dialect, Role::code, row != nullptr ? row->name : nullptr, static_cast<unsigned>(code) / 10, text, size);
}

void m_code_text(const Dialect& dialect, unsigned code, char* text, size_t size) {
  if (!dialect.codes_by_name) return m_code_text(dialect.addresses.letter(Role::misc_code), code, text, size);
  const MiscRow* const row = find_misc(dialect, code);
  code_name(dialect, Role::misc_code, row != nullptr ? row->name : nullptr, code, text, size);
}

namespace {

nc_code_role code_role(Function function) {
  if (function == Function::dwell) return NC_CODE_DWELL;
  if (function == Function::data_input) return NC_CODE_DATA_INPUT;
  return is_macro_call(function) ? NC_CODE_MACRO_CALL : NC_CODE_OTHER;
}

nc_code_role code_role(MiscFunction function) {
  switch (function) {
    case MiscFunction::program_stop: return NC_CODE_PROGRAM_STOP;
    case MiscFunction::optional_stop: return NC_CODE_OPTIONAL_STOP;
    case MiscFunction::program_end: return NC_CODE_PROGRAM_END;
    case MiscFunction::call_sub: return NC_CODE_CALL;
    case MiscFunction::call_external: return NC_CODE_CALL_EXTERNAL;
    case MiscFunction::interrupt_on: return NC_CODE_INTERRUPT;
    case MiscFunction::return_sub: return NC_CODE_RETURN;
    case MiscFunction::spindle_forward: return NC_CODE_SPINDLE_FORWARD;
    case MiscFunction::spindle_reverse: return NC_CODE_SPINDLE_REVERSE;
    case MiscFunction::spindle_stop: return NC_CODE_SPINDLE_STOP;
    case MiscFunction::tool_change: return NC_CODE_TOOL_CHANGE;
    case MiscFunction::output:
    case MiscFunction::interrupt_off:
    case MiscFunction::override_allowed:
    case MiscFunction::override_barred:
    case MiscFunction::override_of_one:
    case MiscFunction::surface_hold:
    case MiscFunction::surface_resume:
    case MiscFunction::spindle_oriented:
    case MiscFunction::tool_number:
    case MiscFunction::machine_output:
    case MiscFunction::machine_value:
    case MiscFunction::machine_input:
    case MiscFunction::modal_state: break;
  }
  return NC_CODE_OTHER;
}

void set(nc_function* out, uint8_t group, const char* missing, const char* name, const char* section) {
  out->group = group;
  out->supported = missing == nullptr;
  TextWriter(out->alarm, sizeof out->alarm).put(missing != nullptr ? missing : "");
  out->name = name;
  out->section = section;
  out->part = nullptr;
}

}  // namespace
}  // namespace nc

// The rows are the G codes first, then the M codes that the control keeps for itself.
nc_status nc_function_row(nc_dialect dialect, unsigned index, nc_function* row) {
  if (row == nullptr || nc::caller_bytes(row) == 0 || !nc::known(dialect)) return NC_E_ARGUMENT;
  const nc::Dialect& family = nc::dialect(dialect);
  nc_function found{};
  if (index < family.functions.size) {
    const nc::FunctionRow& from = family.functions.row[index];
    nc::g_code_text(family, from.code, found.code, sizeof found.code);
    nc::set(&found, from.group, from.missing, from.name, from.section);
    found.part = from.part;
    nc::give_struct(found, row);
    return NC_OK;
  }
  index -= family.functions.size;
  if (index >= family.misc.size) return NC_E_NOT_FOUND;
  const nc::MiscRow& from = family.misc.row[index];
  nc::m_code_text(family, from.code, found.code, sizeof found.code);
  nc::set(&found, 0, from.missing, from.name, from.section);
  found.part = from.part;
  nc::give_struct(found, row);
  return NC_OK;
}

nc_status nc_alarm_row(nc_dialect dialect, unsigned index, char code[16], const char** message) {
  if (code == nullptr || message == nullptr || !nc::known(dialect)) return NC_E_ARGUMENT;
  const nc::Dialect& family = nc::dialect(dialect);
  const nc::AlarmText* const alarm = nc::alarm_at(family, index);
  if (alarm == nullptr) return NC_E_NOT_FOUND;
  nc::TextWriter(code, 16).put(alarm->code);
  *message = alarm->message;
  return NC_OK;
}

nc_status nc_alarm_role_get(nc_dialect dialect, nc_alarm_role role, char code[16], const char** message) {
  if (code == nullptr || message == nullptr || role != NC_ALARM_PRINTER || !nc::known(dialect)) return NC_E_ARGUMENT;
  nc::Fault fault;
  fault.condition = nc::Condition::print_port;
  const nc::AlarmText text = nc::alarm_text(nc::dialect(dialect), fault);
  nc::TextWriter(code, 16).put(text.code);
  *message = text.message;
  return NC_OK;
}

const char* nc_dialect_name(nc_dialect dialect) { return nc::known(dialect) ? nc::dialect(dialect).name : nullptr; }

const char* nc_dialect_title(nc_dialect dialect) { return nc::known(dialect) ? nc::dialect(dialect).title : nullptr; }

nc_status nc_dialect_get(const char* name, nc_dialect* dialect) {
  if (name == nullptr || dialect == nullptr) return NC_E_ARGUMENT;
  for (unsigned id = 0; id < NC_DIALECT_COUNT; ++id) {
    if (std::strcmp(nc::dialect(static_cast<nc_dialect>(id)).name, name) != 0) continue;
    *dialect = static_cast<nc_dialect>(id);
    return NC_OK;
  }
  return NC_E_NOT_FOUND;
}

nc_code_role nc_code_role_get(nc_dialect dialect, char letter, uint32_t number) {
  if (!nc::known(dialect)) return NC_CODE_OTHER;
  const nc::Dialect& family = nc::dialect(dialect);
  if (letter == family.addresses.letter(nc::Role::misc_code)) return nc::code_role(nc::misc_function(family, number));
  if (letter != family.addresses.letter(nc::Role::code) || number > 0x7fff) return NC_CODE_OTHER;
  const nc::FunctionRow* const row = nc::find_function(family, static_cast<int>(number));
  return row != nullptr ? nc::code_role(row->function) : NC_CODE_OTHER;
}

const char* nc_version(void) {
  return NC_VERSION;
}
