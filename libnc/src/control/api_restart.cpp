// SPDX-License-Identifier: Apache-2.0
// The public functions of nc/restart.h.
#include <cmath>

#include "base/struct_size.hpp"
#include "control/control.hpp"

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
  const auto sane = [](double value) { return std::fabs(value) < 1e9; };
  for (unsigned i = 0; place.start_given && i < c->config.system[system].axis_count; ++i)
    if (!sane(place.start.v[i])) return NC_E_ARGUMENT;
  if (of.interpreter.in_vendor_function()) return NC_E_STATE;
  return of.restart_begin(place, world);
}

nc_status nc_restart_find(nc_control* c, unsigned system, uint32_t budget, nc_restart_found* found) {
  if (!has_system(c, system) || found == nullptr || nc::caller_bytes(found) == 0) return NC_E_ARGUMENT;
  if (c->system[system].interpreter.in_vendor_function()) return NC_E_STATE;
  nc_restart_found known;
  nc_restart_found_init(&known);
  const nc_status status = c->system[system].restart_find(budget, &known);
  if (status == NC_OK) nc::give_struct(known, found);
  return status;
}

nc_status nc_restart_cancel(nc_control* c, unsigned system) {
  if (!has_system(c, system)) return NC_E_ARGUMENT;
  return c->system[system].restart_cancel();
}
