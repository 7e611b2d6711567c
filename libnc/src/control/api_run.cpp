// SPDX-License-Identifier: Apache-2.0
// The public functions of nc/run.h.
#include <cmath>
#include <type_traits>

#include "base/struct_size.hpp"
#include "control/control.hpp"

namespace {

/// Element `index` of an array whose elements are `bytes` apart, which may be another size than T has here.
template <class T>
T* element(T* first, uint32_t bytes, unsigned index) {
  using Byte = std::conditional_t<std::is_const_v<T>, const unsigned char, unsigned char>;
  return reinterpret_cast<T*>(reinterpret_cast<Byte*>(first) + size_t{bytes} * index);
}

/// One cycle of a part system, and of the joints behind its axes.
void cycle(nc_control* c, unsigned system, const nc_inputs& in, nc_outputs& out) NC_RT {
  nc::Joints& joints = c->joints[system];
  if (!joints.any()) return c->system[system].executor.cycle(in, out);
  nc_inputs of_axes = in;
  joints.before(&of_axes);
  c->system[system].executor.cycle(of_axes, out);
  joints.after(&out);
}

/// nc_cycle() for a caller that was compiled with another version of the headers. All structs are checked before anything moves.
nc_status cycle_of_another_version(nc_control* c, const nc_inputs* in, nc_outputs* out) NC_RT {
  const uint32_t in_bytes = nc::caller_bytes(in), out_bytes = nc::caller_bytes(out);
  if (in_bytes == 0 || out_bytes == 0) return NC_E_ARGUMENT;
  nc_inputs known_in[NC_MAX_SYSTEMS];
  for (unsigned i = 0; i < c->config.system_count; ++i) {
    const nc_inputs* given = element(in, in_bytes, i);
    nc_inputs_init(&known_in[i]);
    if (nc::caller_bytes(given) != in_bytes || nc::caller_bytes(element(out, out_bytes, i)) != out_bytes) return NC_E_ARGUMENT;
    if (!nc::take_struct(given, &known_in[i])) return NC_E_ARGUMENT;
  }
  for (unsigned i = 0; i < c->config.system_count; ++i) {
    nc_outputs known_out;
    cycle(c, i, known_in[i], known_out);
    nc::give_struct(known_out, element(out, out_bytes, i));
  }
  return NC_OK;
}

/// nc_pull() for a caller that was compiled with another version of the headers.
[[gnu::noinline, gnu::cold]] nc_status pull_for_another_version(nc::PartSystem& system, uint32_t budget, nc_item* item) {
  if (nc::caller_bytes(item) == 0) return NC_E_ARGUMENT;
  nc_item known;
  const nc_status status = system.pull(budget, &known);
  if (status == NC_OK) nc::give_struct(known, item);
  return status;
}

/// nc_pull_past() for such a caller.
[[gnu::noinline, gnu::cold]] nc_status pull_past_for_another_version(nc::PartSystem& system, uint32_t budget, nc_passed* passed, nc_item* item) {
  nc_passed known = NC_INIT(nc_passed);
  if (nc::caller_bytes(item) == 0 || !nc::take_struct(passed, &known)) return NC_E_ARGUMENT;
  nc_item given;
  const nc_status status = system.pull_past(budget, &known, &given);
  nc::give_struct(known, passed);
  if (status == NC_OK) nc::give_struct(given, item);
  return status;
}

}  // namespace

nc_status nc_pull(nc_control* c, unsigned system, uint32_t budget, nc_item* item) {
  if (!has_system(c, system) || item == nullptr) return NC_E_ARGUMENT;
  nc::PartSystem& part = c->system[system];
  if (part.busy()) return NC_E_STATE;  // an item that is taken here would be missing at the machine
  part.forget_restart();
  part.publish_all();
  if (item->struct_size != sizeof(nc_item)) [[unlikely]] return pull_for_another_version(part, budget, item);
  return part.pull(budget, item);
}

nc_status nc_pull_past(nc_control* c, unsigned system, uint32_t budget, nc_passed* passed, nc_item* item) {
  if (!has_system(c, system) || passed == nullptr || item == nullptr) return NC_E_ARGUMENT;
  nc::PartSystem& part = c->system[system];
  if (part.busy()) return NC_E_STATE;
  part.forget_restart();
  part.publish_all();
  if (item->struct_size != sizeof(nc_item) || passed->struct_size != sizeof(nc_passed)) [[unlikely]] return pull_past_for_another_version(part, budget, passed, item);
  return part.pull_past(budget, passed, item);
}

nc_status nc_move_point(const nc_control* c, unsigned system, double share, nc_axes* machine) {
  if (!has_system(c, system) || machine == nullptr || !(share >= 0 && share <= 1)) return NC_E_ARGUMENT;
  return c->system[system].move_point(share, machine);
}

nc_status nc_move_zero(const nc_control* c, unsigned system, nc_axes* zero) {
  if (!has_system(c, system) || zero == nullptr) return NC_E_ARGUMENT;
  return c->system[system].move_zero(zero);
}

nc_status nc_move_side(const nc_control* c, unsigned system, nc_side* side, uint8_t plane_axis[2]) {
  if (!has_system(c, system) || side == nullptr || plane_axis == nullptr) return NC_E_ARGUMENT;
  return c->system[system].move_side(side, plane_axis);
}

nc_status nc_answer(nc_control* c, unsigned system, const nc_world* given) {
  if (!has_system(c, system) || given == nullptr) return NC_E_ARGUMENT;
  nc_world world{};
  if (!nc::take_struct(given, &world)) return NC_E_ARGUMENT;
  for (unsigned i = 0; i < c->config.system[system].axis_count; ++i)
    if (!std::isfinite(world.machine.v[i]) || (world.skipped && !std::isfinite(world.skip_machine.v[i]))) return NC_E_ARGUMENT;
  for (unsigned i = c->config.system[system].axis_count; i < NC_MAX_AXES; ++i) world.machine.v[i] = world.skip_machine.v[i] = 0;
  if (!std::isfinite(world.power_on_ms) || !std::isfinite(world.run_ms)) return NC_E_ARGUMENT;
  if (!are_tool_angles(world.tool_angle)) return NC_E_ARGUMENT;
  if (c->system[system].busy()) return NC_E_STATE;  // the scan answers
  return c->system[system].answer(world);
}

nc_status nc_rewind(nc_control* c, unsigned system, uint64_t serial) {
  if (!has_system(c, system)) return NC_E_ARGUMENT;
  if (c->system[system].busy()) return NC_E_STATE;
  c->system[system].interpreter.forget_vendor_call();
  c->system[system].forget_restart();
  return c->system[system].rewind(serial);
}

nc_status nc_recalculate(nc_control* c, unsigned system) {
  if (!has_system(c, system)) return NC_E_ARGUMENT;
  if (c->system[system].interpreter.in_vendor_function()) return NC_E_STATE;
  return c->system[system].recalculate();
}

nc_status nc_interrupt_signal(nc_control* c, unsigned system, bool on, bool* take_back) {
  if (!has_system(c, system) || take_back == nullptr) return NC_E_ARGUMENT;
  if (c->system[system].busy()) return NC_E_STATE;  // the signal comes with nc_inputs
  return c->system[system].interrupt_signal(on, take_back);
}

nc_status nc_reset(nc_control* c, unsigned system) {
  if (!has_system(c, system)) return NC_E_ARGUMENT;
  return c->system[system].reset();
}

nc_status nc_feed(nc_control* c, uint32_t budget) {
  if (c == nullptr) return NC_E_ARGUMENT;
  for (unsigned i = 0; i < c->config.system_count; ++i)
    if (c->system[i].interpreter.in_vendor_function()) return NC_E_STATE;
  // The answer of the part system that comes first in this order: something committed, alarm, budget used up, waiting, ended.
  nc_status result = NC_ENDED;
  c->system[0].publish_all();
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
  if (!has_system(c, system) || event == nullptr || nc::caller_bytes(event) == 0) return NC_E_ARGUMENT;
  uint64_t lost = 0;
  nc_event known;
  const bool any = c->system[system].executor.poll_event(&known, &lost);
  if (any) nc::give_struct(known, event);
  if (dropped != nullptr) *dropped = lost;
  return any ? NC_OK : NC_E_NOT_FOUND;
}

nc_status nc_sync_get(const nc_control* c, unsigned system, nc_source* source, uint32_t* main_line) {
  if (!has_system(c, system) || source == nullptr || main_line == nullptr) return NC_E_ARGUMENT;
  return c->system[system].sync_place(source, main_line) ? NC_OK : NC_E_NOT_FOUND;
}

nc_status nc_main_line_get(const nc_control* c, unsigned system, const nc_source* source, uint32_t* main_line) {
  if (!has_system(c, system) || source == nullptr || main_line == nullptr) return NC_E_ARGUMENT;
  *main_line = c->system[system].main_line(*source);
  return NC_OK;
}

nc_status nc_commit_watch_set(nc_control* c, unsigned system, nc_commit_watch watch, void* user) {
  if (!has_system(c, system)) return NC_E_ARGUMENT;
  c->system[system].watch_commits(watch, user);
  return NC_OK;
}

nc_status nc_tap_get(const nc_control* c, unsigned system, nc_tap* tap) {
  if (!has_system(c, system) || tap == nullptr || nc::caller_bytes(tap) == 0) return NC_E_ARGUMENT;
  nc::give_struct(c->system[system].executor.tap(), tap);
  return NC_OK;
}

nc_status nc_tap_set(nc_control* c, unsigned system, const nc_tap* given) {
  nc_tap tap = NC_INIT(nc_tap);
  if (!has_system(c, system) || given == nullptr || !nc::take_struct(given, &tap)) return NC_E_ARGUMENT;
  const auto sane = [](double value) { return std::fabs(value) < 1e9; };
  const bool moves = tap.turns_per_mm != 0 && sane(tap.turns_per_mm) && tap.speed != 0 && sane(tap.speed);
  const bool good = moves && sane(tap.entry) && tap.acceleration >= 0 && sane(tap.acceleration);
  if (tap.axis > c->config.system[system].axis_count || (tap.axis != 0 && !good)) return NC_E_ARGUMENT;
  const nc_system_config& of = c->config.system[system];
  const unsigned spindles = of.spindle_count == 0 ? 1u : of.spindle_count;
  if (tap.spindles >> spindles != 0 || tap.encoder > spindles) return NC_E_ARGUMENT;
  return c->system[system].executor.set_tap(tap) ? NC_OK : NC_E_STATE;
}

nc_status nc_cycle(nc_control* c, const nc_inputs* in, nc_outputs* out) {
  if (c == nullptr || in == nullptr || out == nullptr) return NC_E_ARGUMENT;
  const unsigned count = c->config.system_count;
  if (in->struct_size != sizeof(nc_inputs) || out->struct_size != sizeof(nc_outputs)) [[unlikely]] return cycle_of_another_version(c, in, out);
  for (unsigned i = 1; i < count; ++i)
    if (in[i].struct_size != in->struct_size || out[i].struct_size != out->struct_size) return NC_E_ARGUMENT;
  if (c->any_joints) [[unlikely]] {
    for (unsigned i = 0; i < count; ++i) cycle(c, i, in[i], out[i]);
    return NC_OK;
  }
  for (unsigned i = 0; i < count; ++i) c->system[i].executor.cycle(in[i], out[i]);
  return NC_OK;
}
