// SPDX-License-Identifier: Apache-2.0
// See parameter_meaning.hpp.
#include "runtime/services/parameter_meaning.hpp"

#include <cctype>
#include <charconv>

namespace nc::rt::services {
namespace {

constexpr char kBit[] = "/bit";

std::string words(const char* text) { return text == nullptr ? "" : text; }

// The table separates words by "|".
std::string values_text(const char* values) {
  std::string text = words(values);
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.replace(at, 1, ", ");
  return text;
}

ParameterMeaning of_row(const nc_parameter& row, std::string key) { return {std::move(key), words(row.name), values_text(row.values), words(row.section), row.by_axis}; }

bool same_letters(const std::string& one, const std::string& other) {
  if (one.size() != other.size()) return false;
  for (std::size_t i = 0; i < one.size(); ++i)
    if (std::toupper(static_cast<unsigned char>(one[i])) != std::toupper(static_cast<unsigned char>(other[i]))) return false;
  return true;
}

}  // namespace

std::vector<ParameterMeaning> parameter_meanings(nc_dialect dialect) {
  std::vector<ParameterMeaning> all;
  nc_parameter row;
  for (unsigned i = 0; nc_parameter_row(dialect, i, &row) == NC_OK; ++i) {
    if (row.key != nullptr) {
      all.push_back(of_row(row, row.key));
      continue;
    }
    const std::string bit = row.bit < 0 ? "" : kBit + std::to_string(row.bit);
    for (std::uint32_t number = row.first; number <= row.last; number += row.step != 0 ? row.step : 1) all.push_back(of_row(row, std::to_string(number) + bit));
  }
  return all;
}

ParameterMeaning parameter_meaning(nc_dialect dialect, const std::string& key) {
  const std::string whole = key.substr(0, key.find('/'));
  ParameterMeaning found;
  found.key = key;
  std::uint32_t number = 0;
  const bool numbered = std::from_chars(whole.data(), whole.data() + whole.size(), number).ptr == whole.data() + whole.size();
  nc_parameter row;
  for (unsigned i = 0; nc_parameter_row(dialect, i, &row) == NC_OK; ++i) {
    if (row.key != nullptr) {
      if (same_letters(row.key, key)) return of_row(row, key);
      continue;
    }
    const std::uint32_t step = row.step != 0 ? row.step : 1;
    if (!numbered || number < row.first || number > row.last || (number - row.first) % step != 0) continue;
    const std::string bit = row.bit < 0 ? "" : kBit + std::to_string(row.bit);
    if (whole + bit == key) return of_row(row, key);
    if (whole == key && row.bit >= 0) {  // the bits of a whole parameter, one after the other
      found.name += (found.name.empty() ? "" : "; ") + ("bit " + std::to_string(row.bit) + ": " + words(row.name));
      found.values += (found.values.empty() ? "" : "; ") + ("bit " + std::to_string(row.bit) + ": " + values_text(row.values));
      found.section = words(row.section);
      found.by_axis |= row.by_axis;
    }
  }
  return found;
}

std::string parameter_range_text(nc_dialect dialect, const std::string& key) {
  const ParameterMeaning meaning = parameter_meaning(dialect, key);
  if (meaning.name.empty()) return "";
  return meaning.values + " (" + meaning.name + (meaning.section.empty() ? "" : ", " + meaning.section) + ")";
}

}  // namespace nc::rt::services
