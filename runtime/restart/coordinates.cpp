// SPDX-License-Identifier: Apache-2.0
// See coordinates.hpp.
#include "runtime/restart/coordinates.hpp"

#include <algorithm>
#include <cstdio>

namespace nc::rt {
namespace {

template <class Coordinates>
auto& axes_of(Coordinates& coordinates, unsigned of) {
  return of == 0 ? coordinates.shift : of == 1 ? coordinates.shift_kept : coordinates.local[of - 2];
}

// The families have codes of their own for them.
std::string name_of(unsigned of) {
  if (of == 0) return "shift of the workpiece coordinates";
  return of == 1 ? "shift out of force" : "local system in workpiece coordinates " + std::to_string(of - 1);
}

}  // namespace

CoordinatesBegun coordinate_rows(const nc_restart_coordinates& coordinates, const std::string& letters) {
  CoordinatesBegun begun;
  begun.known = true;
  begun.polar = coordinates.polar;
  for (unsigned of = 0; of < kCoordinateKinds; ++of)
    for (unsigned a = 0; a < letters.size() && a < NC_MAX_AXES; ++a)
      if (const double value = axes_of(coordinates, of).v[a]; value != 0) begun.rows.push_back({of, letters[a], value});
  return begun;
}

std::string mirrored_axes(std::uint32_t mirror, const std::string& letters) {
  std::string mirrored;
  for (unsigned a = 0; a < letters.size() && a < NC_MAX_AXES; ++a)
    if ((mirror >> a & 1u) != 0) mirrored += letters[a];
  return mirrored;
}

std::string axes_words(const std::string& letters) {
  std::string words;
  for (const char letter : letters) words += (words.empty() ? "" : " and ") + std::string(1, letter);
  return words.empty() ? "no axis" : words;
}

nc_restart_coordinates coordinates_of(const CoordinatesBegun& begun, const std::string& letters) {
  nc_restart_coordinates coordinates{};
  coordinates.polar = begun.polar;
  for (const CoordinateRow& row : begun.rows)
    if (const std::size_t index = letters.find(row.axis); index < NC_MAX_AXES) axes_of(coordinates, row.of).v[index] = row.value;
  return coordinates;
}

std::string coordinates_text(const CoordinatesBegun& begun) {
  std::string text;
  for (unsigned of = 0; of < kCoordinateKinds; ++of) {
    std::string values;
    for (const CoordinateRow& row : begun.rows) {
      if (row.of != of) continue;
      char value[40];
      std::snprintf(value, sizeof value, " %c%.10g", row.axis, row.value);
      values += value;
    }
    if (!values.empty()) text += (text.empty() ? "" : ", ") + name_of(of) + values;
  }
  if (begun.polar) text += text.empty() ? "polar coordinates" : ", polar coordinates";
  return text;
}

nc_restart_coordinates coordinates_without(const nc_restart_coordinates& before, const nc_restart_coordinates& after, const nc_restart_coordinates& now) {
  nc_restart_coordinates put_back = now;
  for (unsigned of = 0; of < kCoordinateKinds; ++of)
    for (unsigned a = 0; a < NC_MAX_AXES; ++a)
      if (axes_of(now, of).v[a] == axes_of(after, of).v[a]) axes_of(put_back, of).v[a] = axes_of(before, of).v[a];
  if (now.polar == after.polar) put_back.polar = before.polar;
  return put_back;
}

}  // namespace nc::rt
