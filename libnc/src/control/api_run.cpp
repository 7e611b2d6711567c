// SPDX-License-Identifier: Apache-2.0
// The public functions of nc/run.h.
#include <cmath>

#include "control/control.hpp"

namespace {
bool known(const nc_control* c, unsigned system) { return c != nullptr && system < c->config.system_count; }
}  // namespace

nc_status nc_pull(nc_control* c, unsigned system, uint32_t budget, nc_item* item) {
  if (!known(c, system) || item == nullptr) return NC_E_ARGUMENT;
  if (c->system[system].busy()) return NC_E_STATE;  // the machine would miss what is taken here
  return c->system[system].pull(budget, item);
}

nc_status nc_move_point(const nc_control* c, unsigned system, double share, nc_axes* machine) {
  if (!known(c, system) || machine == nullptr || !(share >= 0 && share <= 1)) return NC_E_ARGUMENT;
  return c->system[system].move_point(share, machine);
}

nc_status nc_move_zero(const nc_control* c, unsigned system, nc_axes* zero) {
  if (!known(c, system) || zero == nullptr) return NC_E_ARGUMENT;
  return c->system[system].move_zero(zero);
}

nc_status nc_answer(nc_control* c, unsigned system, const nc_world* world) {
  if (!known(c, system) || world == nullptr) return NC_E_ARGUMENT;
  for (unsigned i = 0; i < c->config.system[system].axis_count; ++i)
    if (!std::isfinite(world->machine.v[i]) || (world->skipped && !std::isfinite(world->skip_machine.v[i]))) return NC_E_ARGUMENT;
  if (!std::isfinite(world->power_on_ms) || !std::isfinite(world->run_ms)) return NC_E_ARGUMENT;
  if (c->system[system].busy()) return NC_E_STATE;  // the scan answers
  return c->system[system].answer(*world);
}

nc_status nc_rewind(nc_control* c, unsigned system, uint64_t serial) {
  if (!known(c, system)) return NC_E_ARGUMENT;
  if (c->system[system].busy()) return NC_E_STATE;
  return c->system[system].rewind(serial);
}

nc_status nc_recalculate(nc_control* c, unsigned system) {
  if (!known(c, system)) return NC_E_ARGUMENT;
  return c->system[system].recalculate();
}

nc_status nc_interrupt_signal(nc_control* c, unsigned system, bool on, bool* take_back) {
  if (!known(c, system) || take_back == nullptr) return NC_E_ARGUMENT;
  if (c->system[system].busy()) return NC_E_STATE;  // the signal comes with nc_inputs
  return c->system[system].interrupt_signal(on, take_back);
}

nc_status nc_reset(nc_control* c, unsigned system) {
  if (!known(c, system)) return NC_E_ARGUMENT;
  return c->system[system].reset();
}

nc_status nc_feed(nc_control* c, uint32_t budget) {
  if (c == nullptr) return NC_E_ARGUMENT;
  // The most that any part system still has to say: something committed, then budget, waiting, the ends.
  nc_status result = NC_ENDED;
  for (unsigned i = 0; i < c->config.system_count; ++i) {
    const nc_status status = c->system[i].feed(budget);
    if (status == NC_OK || result == NC_OK) {
      result = NC_OK;
    } else if (status == NC_ALARMED || result == NC_ALARMED) {
      result = NC_ALARMED;
    } else if (status != NC_ENDED && result != NC_BUDGET) {
      result = status;
    }
  }
  return result;
}

nc_status nc_event_poll(nc_control* c, unsigned system, nc_event* event, uint64_t* dropped) {
  if (!known(c, system) || event == nullptr) return NC_E_ARGUMENT;
  uint64_t lost = 0;
  const bool any = c->system[system].executor.poll_event(event, &lost);
  if (dropped != nullptr) *dropped = lost;
  return any ? NC_OK : NC_E_NOT_FOUND;
}

nc_status nc_sync_get(const nc_control* c, unsigned system, nc_source* source, uint32_t* main_line) {
  if (!known(c, system) || source == nullptr || main_line == nullptr) return NC_E_ARGUMENT;
  return c->system[system].sync_place(source, main_line) ? NC_OK : NC_E_NOT_FOUND;
}

void nc_cycle(nc_control* c, const nc_inputs* in, nc_outputs* out) {
  if (c == nullptr || in == nullptr || out == nullptr) return;
  for (unsigned i = 0; i < c->config.system_count; ++i) c->system[i].executor.cycle(in[i], out[i]);
}
