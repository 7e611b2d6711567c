// SPDX-License-Identifier: Apache-2.0
// nc_config_init, nc_memory_required, nc_create.
#include <cmath>
#include <cstring>
#include <initializer_list>

#include "control/control.hpp"

namespace {

bool power_of_two(uint32_t n) { return n != 0 && (n & (n - 1)) == 0; }

constexpr double kMostLimit = 1e12;  ///< mm/s and so on: what is multiplied with it stays a number
constexpr double kMostPlace = 1e9;   ///< mm or deg

/// False for NaN, too.
bool is_place(double value) { return std::fabs(value) <= kMostPlace; }

bool axes_valid(const nc_system_config& system) {
  if (system.axis_count < 1 || system.axis_count > NC_MAX_AXES || system.spindle_count > NC_MAX_SPINDLES) return false;
  for (unsigned i = 0; i < system.axis_count; ++i) {
    const nc_axis_config& axis = system.axis[i];
    if (std::strchr("ABCUVWXYZ", axis.name) == nullptr || axis.name == 0) return false;
    for (unsigned j = 0; j < i; ++j)
      if (system.axis[j].name == axis.name) return false;
    for (const double limit : {axis.rapid, axis.max_velocity, axis.max_acceleration, axis.max_jerk, axis.in_position})
      if (!(limit >= 0 && limit <= kMostLimit)) return false;
    for (const double place : axis.reference)
      if (!is_place(place)) return false;
    if (axis.soft_limited && !(axis.soft_min < axis.soft_max && is_place(axis.soft_min) && is_place(axis.soft_max))) return false;
    // M700 10.5: a C axis turns with a spindle that there is, and with no other axis.
    if (axis.spindle == 0) continue;
    if (!axis.rotary || axis.spindle > (system.spindle_count == 0 ? 1 : system.spindle_count)) return false;
    for (unsigned j = 0; j < i; ++j)
      if (system.axis[j].spindle == axis.spindle) return false;
  }
  return true;
}

/// M700 13.4.
bool is_option(uint32_t variable_sets) { return variable_sets == 100 || variable_sets == 200 || variable_sets == 300 || variable_sets == 600; }

/// The optimal law needs a limit of each kind on every axis.
bool motion_valid(const nc_config& c) {
  if (c.motion_mode == NC_MOTION_TRAPEZOID) return true;
  const bool tolerance = c.path_tolerance == 0 || (c.path_tolerance >= 1e-5 && c.path_tolerance <= 10);
  if (c.motion_mode != NC_MOTION_OPTIMAL || !tolerance) return false;
  for (unsigned i = 0; i < c.system_count; ++i) {
    for (unsigned k = 0; k < c.system[i].axis_count; ++k) {
      const nc_axis_config& axis = c.system[i].axis[k];
      if (!(axis.max_velocity > 0) || !(axis.max_acceleration > 0) || !(axis.max_jerk > 0)) return false;
    }
  }
  return true;
}

/// M700 13.4: which common variables there are by option, and those that the machine has beside them.
nc::CommonRanges ranges_of(const nc_config& c) {
  const uint32_t sets = c.variable_sets;
  nc::CommonRanges r;
  r.first[0] = 100;
  r.last[0] = sets <= 100 ? 149 : 199;
  r.first[1] = 500;
  r.last[1] = sets <= 100 ? 549 : sets <= 200 ? 599 : sets <= 300 ? 699 : 999;
  if (c.extended_variables) r.last[nc::CommonRanges::kExtended] = 907399;
  for (unsigned i = 0; i < NC_VARIABLE_RANGES; ++i) {
    r.first[nc::CommonRanges::kExtended + 1 + i] = c.variable_ranges[i].first;
    r.last[nc::CommonRanges::kExtended + 1 + i] = c.variable_ranges[i].last;
  }
  return r;
}

bool ranges_valid(const nc_config& c) {
  for (unsigned i = 0; i < NC_VARIABLE_RANGES; ++i)
    if (nc_variable_range_check(&c, i, nullptr) != NC_OK) return false;
  return true;
}

bool valid(const nc_config* c) {
  if (c == nullptr || c->struct_size != sizeof(nc_config)) return false;
  if (!nc::known(c->dialect) || c->system_count < 1 || c->system_count > NC_MAX_SYSTEMS) return false;
  for (unsigned i = 0; i < c->system_count; ++i)
    if (!axes_valid(c->system[i])) return false;
  return c->cycle_s >= 1e-6 && c->cycle_s <= 0.1 && power_of_two(c->look_ahead) && c->look_ahead >= 64 && c->look_ahead <= 65536 &&
         c->programs >= 1 && c->programs <= 65535 && c->tool_offsets >= 1 && c->tool_offsets <= 999 && c->work_offsets <= 300 &&
         c->window_bytes >= 512 && c->window_bytes <= (1u << 24) && is_option(c->variable_sets) && c->max_feed_override >= 1 &&
         c->max_feed_override <= 10 && motion_valid(*c) && ranges_valid(*c);
}

/// Lays a control out; with a measuring arena only its size comes out.
nc_control* lay_out(const nc_config& config, nc::Arena& arena) {
  nc_control* control = arena.make<nc_control>();
  const nc::Dialect& dialect = nc::dialect(static_cast<nc_dialect>(config.dialect));
  const nc::CommonRanges ranges = ranges_of(config);
  if (control == nullptr) {
    // The rooms lay themselves out through the same calls; a throw-away store and part system stand in for the real ones.
    nc::ProgramStore store;
    nc::CommonVariables common;
    store.create(config.programs, config.system_count, arena);
    common.create(ranges, arena);
    for (unsigned i = 0; i < config.system_count; ++i) {
      nc::PartSystem system;
      system.create(config, i, dialect, &store, &common, arena);
    }
    return nullptr;
  }
  control->config = config;
  control->dialect = &dialect;
  control->store.create(config.programs, config.system_count, arena);
  control->common.create(ranges, arena);
  for (unsigned i = 0; i < config.system_count; ++i) {
    control->system[i].create(control->config, i, dialect, &control->store, &control->common, arena);
    if (arena.overflowed()) return nullptr;
  }
  return control;
}

}  // namespace

void nc_config_init(nc_config* config) {
  if (config == nullptr) return;
  *config = nc_config{};
  config->struct_size = sizeof(nc_config);
  config->dialect = NC_DIALECT_M700;
  config->system_count = 1;
  config->system[0].axis_count = 3;
  for (unsigned i = 0; i < 3; ++i) config->system[0].axis[i].name = "XYZ"[i];
  config->cycle_s = 0.001;
  config->look_ahead = 1024;
  config->programs = 256;
  config->tool_offsets = 200;
  config->work_offsets = 96;
  config->variable_sets = 600;
  config->window_bytes = 65536;
  config->max_feed_override = 2.0;
  config->path_tolerance = 0.01;
}

nc_status nc_variable_range_check(const nc_config* config, unsigned index, uint32_t* taken) {
  constexpr uint32_t kFirst = nc::kLocals + 1, kLast = 999999, kMost = 10000;
  uint32_t ignored = 0;
  if (taken == nullptr) taken = &ignored;
  *taken = 0;
  if (config == nullptr || index >= NC_VARIABLE_RANGES) return NC_E_ARGUMENT;
  const uint32_t first = config->variable_ranges[index].first, last = config->variable_ranges[index].last;
  if (first == 0 && last == 0) return NC_OK;
  if (first < kFirst || last < first || last > kLast || last - first >= kMost) return NC_E_ARGUMENT;
  const nc::CommonRanges all = ranges_of(*config);
  const auto overlap = [&](uint32_t other_first, uint32_t other_last) {
    if (other_last < first || other_first > last) return;
    const uint32_t from = other_first > first ? other_first : first;
    if (*taken == 0 || from < *taken) *taken = from;
  };
  for (unsigned i = 0; i < nc::CommonRanges::kCount; ++i)
    if (i != nc::CommonRanges::kExtended + 1 + index && all.size(i) != 0) overlap(all.first[i], all.last[i]);
  nc_system_variable row;
  for (unsigned i = 0; nc_system_variable_get(i, &row) == NC_OK; ++i) overlap(row.first, row.last);
  return *taken == 0 ? NC_OK : NC_E_ARGUMENT;
}

size_t nc_memory_required(const nc_config* config) {
  if (!valid(config)) return 0;
  nc::Arena arena;
  lay_out(*config, arena);
  return arena.used() + 64;
}

nc_control* nc_create(const nc_config* config, void* memory, size_t size, nc_status* status) {
  nc_status ignored;
  if (status == nullptr) status = &ignored;
  *status = NC_E_ARGUMENT;
  if (!valid(config) || memory == nullptr || reinterpret_cast<uintptr_t>(memory) % 64 != 0) return nullptr;
  *status = NC_E_MEMORY;
  if (size < nc_memory_required(config)) return nullptr;
  nc::Arena arena(memory, size);
  nc_control* control = lay_out(*config, arena);
  if (control == nullptr) return nullptr;
  *status = NC_OK;
  return control;
}
