// SPDX-License-Identifier: Apache-2.0
// The public functions of nc/restart.h.
#include <cmath>

#include "base/struct_size.hpp"
#include "control/control.hpp"

namespace {

/// The numbers are small enough to be added to a position.
bool are_sane(const nc_axes& axes, unsigned count) {
  for (unsigned i = 0; i < count; ++i)
    if (!(std::fabs(axes.v[i]) < 1e9)) return false;
  return true;
}

/// The other part systems that have a place which is in date.
uint32_t places_beside(const nc_control* c, unsigned system) {
  uint32_t places = 0;
  for (unsigned i = 0; i < c->config.system_count; ++i)
    if (i != system && c->system[i].has_place()) places |= 1u << i;
  return places;
}

/// What the search of one part system writes does not make the place of another one out of date: that stands at its place while this one comes to its own.
void keep_places(nc_control* c, uint32_t places, bool begins) {
  for (unsigned i = 0; i < c->config.system_count; ++i)
    if ((places >> i & 1u) != 0) c->system[i].searched_beside(begins);
}

}  // namespace

nc_status nc_restart_coordinates_get(const nc_control* c, unsigned system, bool begun, nc_restart_coordinates* coordinates) {
  if (!has_system(c, system) || coordinates == nullptr) return NC_E_ARGUMENT;
  const nc::PartInterpreter& of = c->system[system].interpreter;
  *coordinates = begun ? of.begun_with() : of.coordinates();
  return NC_OK;
}

nc_status nc_restart_coordinates_set(nc_control* c, unsigned system, const nc_restart_coordinates* coordinates) {
  if (!has_system(c, system) || coordinates == nullptr) return NC_E_ARGUMENT;
  const unsigned axes = c->config.system[system].axis_count;
  bool good = are_sane(coordinates->shift, axes) && are_sane(coordinates->shift_kept, axes);
  for (const nc_axes& local : coordinates->local) good = good && are_sane(local, axes);
  if (!good) return NC_E_ARGUMENT;
  if (c->system[system].occupied() || c->system[system].interpreter.in_vendor_function()) return NC_E_STATE;
  c->system[system].interpreter.set_coordinates(*coordinates);
  return NC_OK;
}

nc_status nc_restart_begin(nc_control* c, unsigned system, const nc_restart_place* given, const nc_world* of_machine) {
  if (!has_system(c, system) || given == nullptr) return NC_E_ARGUMENT;
  nc_restart_place place{};
  nc_world world{};
  if (!nc::take_struct(given, &place) || (of_machine != nullptr && !nc::take_struct(of_machine, &world))) return NC_E_ARGUMENT;
  if (!are_tool_angles(world.tool_angle)) return NC_E_ARGUMENT;
  nc::PartSystem& of = c->system[system];
  const bool line = place.by != NC_RESTART_BLOCK;
  if (place.by > NC_RESTART_LINE || (line && (place.number == 0 || place.number > UINT32_MAX))) return NC_E_ARGUMENT;
  if (place.in_file && c->store.entry(place.file) == nullptr) return NC_E_ARGUMENT;
  if (place.start_given && !are_sane(place.start, c->config.system[system].axis_count)) return NC_E_ARGUMENT;
  if (of.interpreter.in_vendor_function()) return NC_E_STATE;
  const uint32_t beside = places_beside(c, system);
  const nc_status status = of.restart_begin(place, world);
  keep_places(c, beside, true);
  return status;
}

nc_status nc_restart_find(nc_control* c, unsigned system, uint32_t budget, nc_restart_found* found) {
  if (!has_system(c, system) || found == nullptr || nc::caller_bytes(found) == 0) return NC_E_ARGUMENT;
  if (c->system[system].interpreter.in_vendor_function()) return NC_E_STATE;
  nc_restart_found known;
  nc_restart_found_init(&known);
  const uint32_t beside = places_beside(c, system);
  const nc_status status = c->system[system].restart_find(budget, &known);
  keep_places(c, beside, false);
  if (status == NC_OK) nc::give_struct(known, found);
  return status;
}

nc_status nc_restart_cancel(nc_control* c, unsigned system) {
  if (!has_system(c, system)) return NC_E_ARGUMENT;
  return c->system[system].restart_cancel();
}
