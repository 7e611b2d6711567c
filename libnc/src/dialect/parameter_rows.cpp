// SPDX-License-Identifier: Apache-2.0
#include "dialect/parameter_rows.hpp"

#include <cstring>

#include "base/struct_size.hpp"
#include "dialect/dialect.hpp"
#include "dialect/text.hpp"
#include "nc/control.h"

namespace nc {

bool parse_parameter_key(const char* text, ParameterKey* key) {
  const auto digits = [](const char* at, unsigned most, uint32_t* number) {
    unsigned count = 0;
    for (*number = 0; at[count] >= '0' && at[count] <= '9' && count < most; ++count)
      *number = *number * 10 + static_cast<uint32_t>(at[count] - '0');
    return count;
  };
  key->digits = digits(text, 6, &key->number);
  key->bit = -1;
  if (key->digits == 0) return false;
  const char* at = text + key->digits;
  if (*at == 0) return true;
  if (std::strncmp(at, "/bit", 4) != 0) return false;
  at += 4;
  uint32_t bit = 0;
  const unsigned length = digits(at, 2, &bit);
  key->bit = static_cast<int>(bit);
  return length != 0 && at[length] == 0 && bit < 32;
}

bool parse_parameter(const Dialect& dialect, const char* key, ParameterId* id, int* bit) {
  *bit = -1;
  if (const ParameterName* const named = find_parameter_name(dialect, key); named != nullptr) {
    *id = ParameterId::of_name(static_cast<uint32_t>(named - dialect.parameters->names.begin()));
    return true;
  }
  ParameterKey parsed{};
  if (dialect.parameters->numbers.size == 0 || !parse_parameter_key(key, &parsed)) return false;
  *id = ParameterId::of_number(parsed.number);
  *bit = parsed.bit;
  return true;
}

void put_parameter_key(const Dialect& dialect, ParameterId id, char (&key)[kParameterKeySize]) {
  TextWriter text(key, sizeof key);
  if (id.is_name()) {
    text.put(dialect.parameters->names.row[id.value - ParameterId::kFirstName].key);
  } else {
    text.put_integer(id.value);
  }
}

const ParameterRow* parameter_row(const Dialect& dialect, Parameter what) {
  const FamilyParameters& table = *dialect.parameters;
  const unsigned place = table.places != nullptr ? table.places->row[static_cast<unsigned>(what)] : 0;
  return place != 0 ? &table.numbers.row[place - 1] : nullptr;
}

bool parameter_place(const Dialect& dialect, ParameterOf parameter, ParameterId* id, int* bit, int axis) {
  const FamilyParameters& table = *dialect.parameters;
  *bit = -1;
  if (const ParameterRow* const row = parameter_row(dialect, parameter.what); row != nullptr) {
    if (parameter.index < row->base || (row->axis_step != 0 && axis < 0)) return false;
    *bit = row->bit;
    *id = ParameterId::of_number(row->first + row->step * (parameter.index - row->base) + row->axis_step * static_cast<uint32_t>(axis < 0 ? 0 : axis));
    return id->value <= row->last;
  }
  for (const ParameterName& row : table.names) {
    if (row.what != parameter.what || row.index != parameter.index) continue;
    *id = ParameterId::of_name(static_cast<uint32_t>(&row - table.names.begin()));
    return true;
  }
  return false;
}

bool parameter_place(const Dialect& dialect, ParameterOf parameter, char (&key)[kParameterKeySize], int* bit) {
  ParameterId id;
  key[0] = 0;
  if (!parameter_place(dialect, parameter, &id, bit)) return false;
  put_parameter_key(dialect, id, key);
  return true;
}

const ParameterRow* find_parameter(const Dialect& dialect, const ParameterKey& key) {
  for (const ParameterRow& row : dialect.parameters->numbers) {
    const uint32_t step = row.axis_step != 0 ? row.axis_step : row.step;
    if (key.number < row.first || key.number > row.last || (key.number - row.first) % step != 0) continue;
    if (row.bit < 0 || key.bit < 0 || row.bit == key.bit) return &row;
  }
  return nullptr;
}

const ParameterName* find_parameter_name(const Dialect& dialect, const char* key) {
  for (const ParameterName& row : dialect.parameters->names)
    if (std::strcmp(row.key, key) == 0) return &row;
  return nullptr;
}

bool parameter_takes(const Dialect& dialect, const ParameterKey& key, double value) {
  const ParameterRow* row = find_parameter(dialect, key);
  return row == nullptr || row->bit >= 0 || row->takes(value);
}

bool parameter_name_takes(const Dialect& dialect, ParameterId id, double value) {
  const ParameterName& row = dialect.parameters->names.row[id.value - ParameterId::kFirstName];
  return value >= 0 && (row.takes == nullptr || row.takes(value));
}

bool parameter_takes_code(const Dialect& dialect, const ParameterKey& key) {
  constexpr Parameter kNamedByLetter[] = {Parameter::setting_unit, Parameter::plane_axis, Parameter::parallel_axis, Parameter::exponential_axis,
                                          Parameter::mill_axis, Parameter::polar_linear_axis, Parameter::work_turn_axis, Parameter::ascii_call_letter};
  const ParameterRow* const row = find_parameter(dialect, key);
  if (row == nullptr) return true;
  for (const Parameter named : kNamedByLetter)
    if (row->what == named) return true;
  return false;
}

bool parameter_used(const Dialect& dialect, const char* key) {
  if (find_parameter_name(dialect, key) != nullptr) return true;
  ParameterKey parsed;
  return parse_parameter_key(key, &parsed) && find_parameter(dialect, parsed) != nullptr;
}

bool parameter_of_axis(const Dialect& dialect, uint32_t number) {
  for (const NumberRange& range : dialect.parameters->of_axes)
    if (number >= range.first && number <= range.last) return true;
  return false;
}

bool is_length(Parameter parameter) {
  switch (parameter) {
    case Parameter::arc_tolerance:
    case Parameter::skip_feed:
    case Parameter::multi_skip_feed:
    case Parameter::digit_feed:
    case Parameter::digit_most:
    case Parameter::accuracy_speed:
    case Parameter::arc_joint_speed:
    case Parameter::reference_position:
    case Parameter::arc_radius_shift:
    case Parameter::corner_least_speed:
    case Parameter::accuracy_clamp:
    case Parameter::measure_feed:
    case Parameter::measure_deceleration:
    case Parameter::measure_range:
    case Parameter::corner_override_zone:
    case Parameter::step_clearance:
    case Parameter::peck_clearance:
    case Parameter::tap_clearance:
    case Parameter::spline_tolerance:
    case Parameter::fairing_length:
    case Parameter::spline_minute_length:
    case Parameter::judgement_length:
    case Parameter::space_divisor:
    case Parameter::spiral_tolerance:
    case Parameter::tool_change_position:
    case Parameter::creep:
    case Parameter::work_turn_center:
    case Parameter::work_turn_vector: return true;
    default: return false;
  }
}

bool parameter_is_common(const Dialect& dialect, uint32_t number) {
  ParameterKey key{};
  key.number = number;
  key.bit = -1;
  const ParameterRow* const row = find_parameter(dialect, key);
  return row != nullptr && is_common(row->what);
}

}  // namespace nc

nc_status nc_parameter_row(nc_dialect dialect, unsigned index, nc_parameter* row) {
  if (row == nullptr || nc::caller_bytes(row) == 0 || !nc::known(dialect)) return NC_E_ARGUMENT;
  const nc::FamilyParameters& table = *nc::dialect(dialect).parameters;
  nc_parameter found{};
  found.bit = -1;
  if (index < table.names.size) {
    const nc::ParameterName& named = table.names.row[index];
    found.key = named.key;
    found.values = named.values != nullptr ? named.values : named.words;
    found.name = named.name;
    found.section = named.section;
    nc::give_struct(found, row);
    return NC_OK;
  }
  index -= table.names.size;
  if (index >= table.numbers.size) return NC_E_NOT_FOUND;
  const nc::ParameterRow& from = table.numbers.row[index];
  nc::give_struct(nc_parameter{sizeof(nc_parameter), nullptr, from.first, from.last, from.axis_step != 0 ? from.axis_step : from.step, from.bit, from.by_axis, from.values, from.name, from.section}, row);
  return NC_OK;
}

bool nc_parameter_used(nc_dialect dialect, const char* key) {
  return key != nullptr && nc::known(dialect) && nc::parameter_used(nc::dialect(dialect), key);
}
