// SPDX-License-Identifier: Apache-2.0
// The tables of a family as the public API shows them: for documentation and for HMIs, without a control.
#include "dialect/function_table.hpp"

#include "dialect/dialect.hpp"
#include "dialect/text.hpp"

namespace nc {

void g_code_text(int code, char* text, size_t size) {
  TextWriter out(text, size);
  if (code < 0) return;
  const unsigned value = static_cast<unsigned>(code);
  out.put('G').put_integer(value / 10, 2);
  if (value % 10 != 0) out.put('.').put_integer(value % 10);
}

void m_code_text(unsigned code, char* text, size_t size) {
  TextWriter(text, size).put('M').put_integer(code, 2);
}

namespace {

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

// G codes first, then the M codes that the control keeps for itself.
nc_status nc_function_get(nc_dialect dialect, unsigned index, nc_function* row) {
  if (row == nullptr || !nc::known(dialect)) return NC_E_ARGUMENT;
  const nc::Dialect& family = nc::dialect(dialect);
  if (index < family.functions.size) {
    const nc::FunctionRow& from = family.functions.row[index];
    nc::g_code_text(from.code, row->code, sizeof row->code);
    nc::set(row, from.group, from.function == nc::Function::missing ? from.missing : nullptr, from.name,
            from.section);
    row->part = from.part;
    return NC_OK;
  }
  index -= family.functions.size;
  if (index >= family.misc.size) return NC_E_NOT_FOUND;
  const nc::MiscRow& from = family.misc.row[index];
  nc::m_code_text(from.code, row->code, sizeof row->code);
  nc::set(row, 0, from.function == nc::MiscFunction::missing ? from.missing : nullptr, from.name,
          from.section);
  return NC_OK;
}

nc_status nc_alarm_row(nc_dialect dialect, unsigned index, char code[16], const char** message) {
  if (code == nullptr || message == nullptr || !nc::known(dialect)) return NC_E_ARGUMENT;
  const nc::Dialect& family = nc::dialect(dialect);
  if (index >= family.alarms.size) return NC_E_NOT_FOUND;
  nc::TextWriter(code, 16).put(family.alarms.row[index].code);
  *message = family.alarms.row[index].message;
  return NC_OK;
}

const char* nc_version(void) {
  return NC_VERSION;
}
