// SPDX-License-Identifier: Apache-2.0
// What a run was begun with of the coordinate systems beside the tables of offsets (nc_restart_coordinates), as it is kept with the place of a stop, shown, and put
// back.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nc/nc.h"

namespace nc::rt {

// One value that is not 0. `of`: 0 the shift (G92), 1 the shift that G92.2 keeps, 2 to 7 the local systems (G52) of G54 to G59.
struct CoordinateRow {
  unsigned of = 0;
  char axis = 0;
  double value = 0;
  bool operator==(const CoordinateRow&) const = default;
};
inline constexpr unsigned kCoordinateKinds = 8;

struct CoordinatesBegun {
  bool known = false;   // false: a place that was kept by an older version
  bool polar = false;
  std::vector<CoordinateRow> rows = {};
  bool mirror_known = false;  // false: as with `known`
  std::string mirrored = {};  // letters of the axes that the machine's switches (plc.mirror) mirror, in the order of the axes
  bool operator==(const CoordinatesBegun&) const = default;
};

CoordinatesBegun coordinate_rows(const nc_restart_coordinates& coordinates, const std::string& letters);
// The letters of the axes in a mask (nc_inputs::mirror).
std::string mirrored_axes(std::uint32_t mirror, const std::string& letters);
// "X", "X and Z", "no axis"
std::string axes_words(const std::string& letters);
// Axes that are not in `letters` are left out.
nc_restart_coordinates coordinates_of(const CoordinatesBegun& begun, const std::string& letters);
// "shift X30 (G92), local system G54 X10 Y12 (G52)"; "" = nothing is in force.
std::string coordinates_text(const CoordinatesBegun& begun);
// `now` with the values of `before` where they have changed from `before` to `after` and are still those of `after`.
nc_restart_coordinates coordinates_without(const nc_restart_coordinates& before, const nc_restart_coordinates& after, const nc_restart_coordinates& now);

}  // namespace nc::rt
