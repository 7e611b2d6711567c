// SPDX-License-Identifier: Apache-2.0
// libnc behind the port of the runtime.
#include "runtime/nc_port.hpp"

#include "runtime/nc_system.hpp"
#include "runtime/programs/encoding.hpp"
#include "runtime/retain/tables.hpp"
#include "runtime/retain/variables.hpp"

namespace nc::rt {

nc_status LibNc::poll_event(unsigned system, nc_event* event, std::uint64_t* dropped) {
  return nc_event_poll(control_, api_system(system), event, dropped);
}
nc_status LibNc::select(unsigned system, unsigned file) {
  return nc_program_select(control_, api_system(system), file);
}
nc_status LibNc::load_mdi(unsigned system, const char* text, std::size_t length) {
  return nc_mdi_load(control_, api_system(system), text, length);
}
nc_status LibNc::reset(unsigned system) {
  return nc_reset(control_, api_system(system));
}
void LibNc::switches(unsigned system, std::uint32_t optional_skip) {
  nc_switches_set(control_, api_system(system), optional_skip, 0);
}
unsigned LibNc::alarm_calls(unsigned system, nc_source* calls, unsigned capacity) {
  return nc_alarm_calls_get(control_, api_system(system), calls, capacity);
}

nc_status LibNc::alarm(unsigned system, nc_alarm* alarm) {
  const nc_status status = nc_alarm_get(control_, api_system(system), alarm);
  if (status == NC_OK) make_valid(alarm->detail.s, sizeof alarm->detail.s);
  return status;
}
nc_status LibNc::modal(unsigned system, std::uint32_t id, nc_modal* modal) {
  return nc_modal_get(control_, api_system(system), id, modal);
}
nc_status LibNc::recalculate(unsigned system) {
  return nc_recalculate(control_, api_system(system));
}
void LibNc::outputs(unsigned system, unsigned word, std::uint32_t mask, std::uint32_t bits) {
  (void)nc_interface_output_set(control_, api_system(system), word, mask, bits);
}
void LibNc::shown(unsigned system, nc_axes* machine, nc_axes* work) {
  nc_position_shown(control_, api_system(system), machine, work);
}
std::string LibNc::variables() {
  return executed_variables(control_);
}
std::string LibNc::tables() {
  return table_text(executed_tables(control_, config_));
}
void LibNc::put_back(const KeptValues& before, const KeptValues& after) {
  TableRows was, left;
  if (parse_tables(before.tables, &was) && parse_tables(after.tables, &left)) (void)restore_changes(control_, config_, executed_tables(control_, config_), encode_changes(was, left));
  put_back_variables(control_, before.variables, after.variables);
}
nc_status LibNc::text(unsigned system, std::uint32_t id, nc_text* text) {
  const nc_status status = nc_text_get(control_, api_system(system), id, text);
  if (status == NC_OK && text->size == 0) make_valid(text->s, sizeof text->s);  // size != 0: bytes of BPRNT, which stay as they are
  return status;
}

std::string LibNc::axis_letters(unsigned system) {
  std::string letters;
  for (unsigned a = 0; a < config_.system[system].axis_count; ++a) letters += config_.system[system].axis[a].name;
  return letters;
}

int LibNc::program_of(const std::string& name) {
  for (unsigned file = 0; file < config_.programs; ++file)
    if (program_name(file) == name) return static_cast<int>(file);
  return -1;
}

std::uint64_t LibNc::program_size(unsigned file) {
  nc_program_info info;
  nc_program_info_init(&info);
  return nc_program_get(control_, file, &info) == NC_OK ? info.size : 0;
}

nc_restart_coordinates LibNc::coordinates(unsigned system, bool begun) {
  struct Look {
    unsigned system;
    bool begun;
    nc_restart_coordinates seen;
  } look{api_system(system), begun, {}};
  nc_look_executed(
      control_,
      [](void* user, const nc_control* seen) {
        Look& to = *static_cast<Look*>(user);
        (void)nc_restart_coordinates_get(seen, to.system, to.begun, &to.seen);
      },
      &look);
  return look.seen;
}
nc_status LibNc::set_coordinates(unsigned system, const nc_restart_coordinates& coordinates) {
  return nc_restart_coordinates_set(control_, api_system(system), &coordinates);
}
nc_status LibNc::restart_begin(unsigned system, const nc_restart_place& place, const nc_world& world) {
  return nc_restart_begin(control_, api_system(system), &place, &world);
}
nc_status LibNc::restart_find(unsigned system, std::uint32_t budget, nc_restart_found* found) {
  return nc_restart_find(control_, api_system(system), budget, found);
}
nc_status LibNc::restart_cancel(unsigned system) {
  return nc_restart_cancel(control_, api_system(system));
}

std::string LibNc::program_name(unsigned file) {
  nc_program_info info;
  nc_program_info_init(&info);
  return nc_program_get(control_, file, &info) == NC_OK ? info.name : "";
}

}  // namespace nc::rt
