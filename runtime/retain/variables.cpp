// SPDX-License-Identifier: Apache-2.0
// Common variables as bytes. See variables.hpp.
//
//   u32 count of variables; for each: u32 number, with the index of the part system in its highest byte, f64 value
//   u32 count of names; for each: u32 number, 8 bytes
//
// A variable that part systems share stands in the rows of each of them.
#include "runtime/retain/variables.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <vector>

#include "runtime/nc_system.hpp"
#include "runtime/programs/encoding.hpp"

namespace nc::rt {
namespace {

constexpr std::uint32_t kMaxVariables = 200000;  // more than all part systems together can have
constexpr unsigned kSystemShift = 24;
constexpr std::uint32_t kNumber = (1u << kSystemShift) - 1;

nc_variable_range kind_of(const nc_control* control, nc_variable_kind kind) {
  nc_variable_range range{};
  (void)nc_variable_kind_get(nc_control_dialect(control), kind, &range);
  return range;
}

bool holds(const nc_variable_range& range, std::uint32_t number) { return number >= range.first && number <= range.last; }

template <class T>
void put(std::string* bytes, const T& value) {
  bytes->append(reinterpret_cast<const char*>(&value), sizeof value);
}
template <class T>
bool get(const std::string& bytes, std::size_t* at, T* value) {
  if (bytes.size() - *at < sizeof *value) return false;
  std::memcpy(value, bytes.data() + *at, sizeof *value);
  *at += sizeof *value;
  return true;
}

// The shortest text that gives the number when it is read back.
std::string plain_number(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

struct Variable {
  std::uint32_t number = 0;
  double value = 0;
};
struct Name {
  std::uint32_t number = 0;
  char text[8] = {};
};

bool decode(const std::string& bytes, std::vector<Variable>* variables, std::vector<Name>* names) {
  std::size_t at = 0;
  std::uint32_t count = 0;
  if (!get(bytes, &at, &count) || count > kMaxVariables) return false;
  for (std::uint32_t i = 0; i < count; ++i) {
    Variable& variable = variables->emplace_back();
    if (!get(bytes, &at, &variable.number) || !get(bytes, &at, &variable.value) || !std::isfinite(variable.value))
      return false;
  }
  if (!get(bytes, &at, &count) || count > kMaxVariables) return false;
  for (std::uint32_t i = 0; i < count; ++i) {
    Name& name = names->emplace_back();
    if (!get(bytes, &at, &name.number) || !get(bytes, &at, &name.text) || name.text[7] != 0) return false;
  }
  return at == bytes.size();
}

// Values and names by their numbers.
struct ByNumber {
  std::map<std::uint32_t, double> value;
  std::map<std::uint32_t, std::string> name;
};

std::string encode(const std::vector<Variable>& variables, const std::vector<Name>& names) {
  std::string bytes;
  put(&bytes, static_cast<std::uint32_t>(variables.size()));
  for (const Variable& variable : variables) {
    put(&bytes, variable.number);
    put(&bytes, variable.value);
  }
  put(&bytes, static_cast<std::uint32_t>(names.size()));
  for (const Name& name : names) {
    put(&bytes, name.number);
    put(&bytes, name.text);
  }
  return bytes;
}

std::string encode(const ByNumber& all) {
  std::vector<Variable> variables;
  for (const auto& [number, value] : all.value) variables.push_back({number, value});
  std::vector<Name> names;
  for (const auto& [number, text] : all.name) {
    Name& name = names.emplace_back();
    name.number = number;
    std::strncpy(name.text, text.c_str(), sizeof name.text - 1);
  }
  return encode(variables, names);
}

bool decode(const std::string& bytes, ByNumber* all) {
  std::vector<Variable> variables;
  std::vector<Name> names;
  if (!decode(bytes, &variables, &names)) return false;
  for (const Variable& variable : variables) all->value[variable.number] = variable.value;
  for (const Name& name : names) all->name[name.number] = name.text;
  return true;
}

// Calls put_back(number, what it was, nullptr = nothing) for what has changed from `before` to `after` and is now as in `after`.
template <class Value, class PutBack>
void each_changed(const std::map<std::uint32_t, Value>& before, const std::map<std::uint32_t, Value>& after, const std::map<std::uint32_t, Value>& now, PutBack put_back) {
  const auto in = [](const std::map<std::uint32_t, Value>& all, std::uint32_t number) {
    const auto found = all.find(number);
    return found == all.end() ? nullptr : &found->second;
  };
  const auto same = [](const Value* a, const Value* b) { return a == nullptr || b == nullptr ? a == b : *a == *b; };
  std::map<std::uint32_t, Value> all = before;  // becomes the set of the numbers of both
  all.insert(after.begin(), after.end());
  for (const auto& [number, ignored] : all) {
    const Value* const was = in(before, number);
    const Value* const left = in(after, number);
    if (!same(was, left) && same(left, in(now, number))) put_back(number, was);
  }
}

}  // namespace

std::string encode_variables(const nc_control* control) {
  std::vector<Variable> variables;
  for (unsigned s = 0; s < NC_MAX_SYSTEMS; ++s) {  // a part system that does not exist has no variables
    Variable next;
    while (nc_variable_next(control, api_system(s), next.number, &next.number, &next.value) == NC_OK) {
      if (std::isfinite(next.value)) variables.push_back({s << kSystemShift | next.number, next.value});
      ++next.number;
    }
  }
  std::vector<Name> names;
  const nc_variable_range named = kind_of(control, NC_VARIABLES_NAMED);
  for (std::uint32_t number = named.first; number <= named.last; ++number) {
    Name name{number, {}};
    if (nc_variable_name_get(control, number, name.text) == NC_OK && name.text[0] != 0) names.push_back(name);
  }
  return encode(variables, names);
}

std::string executed_variables(nc_control* control) {
  std::string bytes;
  nc_look_executed(
      control, [](void* to, const nc_control* seen) { *static_cast<std::string*>(to) = encode_variables(seen); }, &bytes);
  return bytes;
}

bool is_local_variable(const nc_control* control, std::uint32_t number) { return holds(kind_of(control, NC_VARIABLES_LOCAL), number); }

void set_variables(nc_control* control, const std::string& bytes) {
  std::vector<Variable> variables;
  std::vector<Name> names;
  if (!decode(bytes, &variables, &names)) return;
  for (const Variable& variable : variables)
    if (!is_local_variable(control, variable.number & kNumber)) (void)nc_variable_set(control, api_system(variable.number >> kSystemShift), variable.number & kNumber, variable.value, false);
  for (const Name& name : names) (void)nc_variable_name_set(control, name.number, name.text);
}

void put_back_variables(nc_control* control, const std::string& before, const std::string& after) {
  ByNumber was, left, now;
  if (!decode(before, &was) || !decode(after, &left) || !decode(executed_variables(control), &now)) return;
  each_changed(was.value, left.value, now.value, [&](std::uint32_t number, const double* value) {
    if (!is_local_variable(control, number & kNumber))
      (void)nc_variable_set(control, api_system(number >> kSystemShift), number & kNumber, value != nullptr ? *value : 0, value == nullptr);
  });
  each_changed(was.name, left.name, now.name, [&](std::uint32_t number, const std::string* name) { (void)nc_variable_name_set(control, number, name != nullptr ? name->c_str() : ""); });
}

std::string variables_without(const std::string& before, const std::string& after, const std::string& now) {
  ByNumber was, left, all;
  if (!decode(before, &was) || !decode(after, &left) || !decode(now, &all)) return now;
  const ByNumber seen = all;
  each_changed(was.value, left.value, seen.value, [&](std::uint32_t number, const double* value) {
    if (value != nullptr) all.value[number] = *value;
    else all.value.erase(number);
  });
  each_changed(was.name, left.name, seen.name, [&](std::uint32_t number, const std::string* name) {
    if (name != nullptr) all.name[number] = *name;
    else all.name.erase(number);
  });
  return encode(all);
}

std::vector<VariableChange> changed_variables(const std::string& before, const std::string& after, unsigned system) {
  ByNumber was, left;
  std::vector<VariableChange> changes;
  if (!decode(before, &was) || !decode(after, &left)) return changes;
  for (const auto& [number, value] : was.value) {
    const auto now = left.value.find(number);
    const bool vacant = now == left.value.end();
    if (number >> kSystemShift == system && (vacant || now->second != value)) changes.push_back({number & kNumber, value, vacant ? 0 : now->second, vacant});
  }
  return changes;
}

std::vector<VariableWrite> written_variables(const std::string& before, const std::string& after, nc_variable_range local) {
  ByNumber was, left;
  std::vector<VariableWrite> writes;
  if (!decode(before, &was) || !decode(after, &left)) return writes;
  const auto write = [&](std::uint32_t number, std::string value) {
    if (!holds(local, number & kNumber)) writes.push_back({"variable " + std::to_string(number >> kSystemShift) + " " + std::to_string(number & kNumber), std::move(value)});
  };
  for (const auto& [number, value] : left.value)
    if (const auto old = was.value.find(number); old == was.value.end() || old->second != value) write(number, plain_number(value));
  for (const auto& [number, value] : was.value)
    if (left.value.count(number) == 0) write(number, "");
  for (const auto& [number, name] : left.name)
    if (const auto old = was.name.find(number); old == was.name.end() || old->second != name) writes.push_back({"name " + std::to_string(number), name});
  for (const auto& [number, name] : was.name)
    if (left.name.count(number) == 0) writes.push_back({"name " + std::to_string(number), ""});
  return writes;
}

bool restore_variables(nc_control* control, const std::string& bytes, const std::vector<VariableRangeSetting>& not_kept, std::vector<std::string>* left_out) {
  std::vector<Variable> variables;
  std::vector<Name> names;
  if (!decode(bytes, &variables, &names)) return false;
  double cleared = 0;
  char key[24];
  if (nc_parameter_key_get(control, NC_PARAMETER_POWER_OFF_CLEARS, key) == NC_OK)  // a dialect without it clears nothing
    (void)nc_parameter_get(control, api_system(0), key, 0, &cleared);
  const nc_variable_range local = kind_of(control, NC_VARIABLES_LOCAL), clears = kind_of(control, NC_VARIABLES_CLEARED);
  for (const Variable& variable : variables) {
    const unsigned system = variable.number >> kSystemShift;
    const std::uint32_t number = variable.number & kNumber;
    const auto holds_number = [number](const VariableRangeSetting& range) { return number >= range.first && number <= range.last; };
    if (holds(local, number) || (cleared != 0 && holds(clears, number))) continue;
    if (std::any_of(not_kept.begin(), not_kept.end(), holds_number)) continue;
    (void)nc_variable_set(control, api_system(system), number, variable.value, false);
  }
  for (const Name& name : names)
    if (nc_variable_name_set(control, name.number, name.text) != NC_OK && left_out != nullptr)
      left_out->push_back("#" + std::to_string(name.number) + " has lost its name " + valid_utf8(name.text) + ": the variable can have no name, or none that begins with that of a function");
  return true;
}

}  // namespace nc::rt
