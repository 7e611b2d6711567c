// SPDX-License-Identifier: Apache-2.0
// nc_memory_required, nc_create.
#include "control/config.hpp"
#include "control/control.hpp"
#include "control/vendor_check.hpp"

namespace {

/// Copies the vendor's codes, so that the caller's table need not stay.
void lay_out_vendor(const nc_config& config, const nc::Dialect& dialect, nc_control* control, nc::VendorCodes* vendor, nc::Arena& arena) {
  nc_vendor_code* rows = config.vendor_code_count != 0 ? arena.make<nc_vendor_code>(config.vendor_code_count) : nullptr;
  for (unsigned i = 0; i < config.vendor_code_count && rows != nullptr; ++i) nc::take_vendor_code(config.vendor_codes, i, &rows[i]);
  vendor->create(rows, config.vendor_code_count, dialect, control, arena);
}

/// Lays a control out in the arena. With a measuring arena only the size of the control is found.
nc_control* lay_out(const nc_config& config, nc::Arena& arena) {
  nc_control* control = arena.make<nc_control>();
  const nc::Dialect& dialect = nc::dialect(static_cast<nc_dialect>(config.dialect));
  const nc::CommonRanges ranges = nc::ranges_of(config);
  if (control == nullptr) {
    // Each room takes its memory through the same calls as for a real control; a store and a part system that are thrown away take their place.
    nc::ProgramStore store;
    nc::CommonVariables common;
    store.create(config.programs, config.system_count, {dialect.lex->program_letter, dialect.rules.range.largest_program}, arena);
    nc::VendorCodes vendor;
    lay_out_vendor(config, dialect, nullptr, &vendor, arena);
    for (unsigned i = 0; i < config.system_count; ++i) {
      nc::PartSystem system;
      common.create(ranges, arena);
      system.create(config, i, dialect, {&store, &common, &vendor}, arena);
    }
    nc::SharedTables shared;
    if (config.system_count > 1) shared.create(config.system_count, config.look_ahead, arena);
    return nullptr;
  }
  control->config = config;
  control->dialect = &dialect;
  control->store.create(config.programs, config.system_count, {dialect.lex->program_letter, dialect.rules.range.largest_program}, arena);
  lay_out_vendor(config, dialect, control, &control->vendor, arena);
  control->config.vendor_codes = nullptr;  // these pointers lead into the caller's memory; from here on only the copies are used
  for (const nc_kinematics*& kinematics : control->config.kinematics) kinematics = nullptr;
  for (unsigned i = 0; i < config.system_count; ++i) {
    control->common[i].create(ranges, arena);
    control->system[i].create(control->config, i, dialect, {&control->store, &control->common[i], &control->vendor}, arena);
    control->joints[i].create(config.kinematics[i], config.cycle_s);
    control->any_joints = control->any_joints || control->joints[i].any();
    if (arena.overflowed()) return nullptr;
  }
  if (config.system_count > 1) control->shared.create(config.system_count, config.look_ahead, arena);
  if (arena.overflowed()) return nullptr;
  for (unsigned i = 0; i < config.system_count && config.system_count > 1; ++i)
    control->system[i].join(control->system, config.system_count, &control->shared);
  return control;
}

/// Bytes of a control, as a measuring arena counts them, and 64 more for the alignment of the memory's beginning.
size_t bytes_of(const nc_config& config) {
  nc::Arena arena;
  lay_out(config, arena);
  return arena.used() + 64;
}

}  // namespace

size_t nc_memory_required(const nc_config* config) {
  nc_config known;
  if (!nc::take_config(config, &known) || nc_config_check(&known, nullptr) != NC_OK) return 0;
  return bytes_of(known);
}

nc_control* nc_create(const nc_config* config, void* memory, size_t size, nc_status* status) {
  nc_status ignored;
  if (status == nullptr) status = &ignored;
  *status = NC_E_ARGUMENT;
  nc_config known;
  if (!nc::take_config(config, &known) || nc_config_check(&known, nullptr) != NC_OK) return nullptr;
  if (memory == nullptr || reinterpret_cast<uintptr_t>(memory) % 64 != 0) return nullptr;
  *status = NC_E_MEMORY;
  if (size < bytes_of(known)) return nullptr;
  nc::Arena arena(memory, size);
  nc_control* control = lay_out(known, arena);
  if (control == nullptr) return nullptr;
  *status = NC_OK;
  return control;
}
