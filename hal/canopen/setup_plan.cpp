// SPDX-License-Identifier: Apache-2.0
// The order of a drive's set-up. See setup_plan.hpp. Objects 1000h to 1FFFh are those of CiA 301, 6000h to 9FFFh those of CiA 402.
#include "hal/canopen/setup_plan.hpp"

#include <cmath>

#include "hal/canopen/frame.hpp"

namespace nc::hal::canopen {
namespace {

using Kind = SetupStep::Kind;

constexpr std::uint32_t kPdoOff = 0x80000000, kEverySync = 1, kAtOnce = 255, kProfile402 = 0x0192, kProfile401 = 0x0191;
constexpr unsigned kDefaultPdos = 4;  // number of PDOs of each direction that a drive may have switched on by default
constexpr double kPatience = 2.5;     // heartbeat periods after which the drive takes the control for lost

class Plan {
 public:
  void add(Kind kind, unsigned index, unsigned sub, unsigned bytes, std::uint32_t value, std::uint32_t mask = 0xFFFFFFFF) {
    steps.push_back({kind, {static_cast<std::uint16_t>(index), static_cast<std::uint8_t>(sub), static_cast<std::uint8_t>(bytes), value}, mask});
  }
  void write(unsigned index, unsigned sub, unsigned bytes, std::uint32_t value) { add(Kind::kWrite, index, sub, bytes, value); }
  void try_write(unsigned index, unsigned sub, unsigned bytes, std::uint32_t value) { add(Kind::kWriteIfThere, index, sub, bytes, value); }

  // CiA 301: the identifier is switched off, the mapping is emptied, filled and its count written, then the identifier is switched on. The mapping
  // is read back, because some drives keep a mapping of their own without an error.
  void pdo(unsigned communication, unsigned mapping, unsigned number, std::uint32_t cob_id, const std::vector<std::uint32_t>& objects, std::uint32_t type = kEverySync) {
    const unsigned c = communication + number - 1, m = mapping + number - 1;
    write(c, 1, 4, cob_id | kPdoOff);
    write(m, 0, 1, 0);
    for (unsigned i = 0; i < objects.size(); ++i) write(m, i + 1, 4, objects[i]);
    write(m, 0, 1, static_cast<std::uint32_t>(objects.size()));
    write(c, 2, 1, type);
    write(c, 1, 4, cob_id);
    check(m, 0, 1, static_cast<std::uint32_t>(objects.size()), 0xFF);
    for (unsigned i = 0; i < objects.size(); ++i) check(m, i + 1, 4, objects[i], 0xFFFFFFFF);
    check(c, 1, 4, cob_id, 0x800007FF);
  }
  // What is read back at once, and once more behind everything else, so that a drive that has started anew in the middle is found.
  void check(unsigned index, unsigned sub, unsigned bytes, std::uint32_t value, std::uint32_t mask) {
    add(Kind::kCheck, index, sub, bytes, value, mask);
    checks.push_back({Kind::kCheck, {static_cast<std::uint16_t>(index), static_cast<std::uint8_t>(sub), static_cast<std::uint8_t>(bytes), value}, mask});
  }

  std::vector<SetupStep> steps, checks;
};

std::uint32_t map_entry(const AxisMap& axis, unsigned index, unsigned bits) { return axis.object(index) << 16 | bits; }

void interpolation_time(Plan* plan, const AxisMap& axis, unsigned us) {
  const InterpolationTime time = interpolation_time_of(us);
  plan->write(axis.object(0x60C2), 1, 1, time.mantissa);
  plan->write(axis.object(0x60C2), 2, 1, static_cast<std::uint8_t>(time.exponent));
}

void homing(Plan* plan, const AxisMap& axis) {
  const double scale = std::abs(axis.increments_per_unit);
  const auto increments = [](double value) { return static_cast<std::uint32_t>(std::llround(value)); };
  plan->write(axis.object(0x6098), 0, 1, static_cast<std::uint8_t>(axis.homing_method));
  plan->write(axis.object(0x6099), 1, 4, increments(axis.homing_fast * scale));
  plan->write(axis.object(0x6099), 2, 4, increments(axis.homing_slow * scale));
  if (axis.homing_acceleration > 0) plan->write(axis.object(0x609A), 0, 4, increments(axis.homing_acceleration * scale));
  plan->add(Kind::kIsZero, axis.object(0x607C), 0, 4, 0);  // its sign is not the same in all drives, so the place of the mark is AxisMap::zero
}

void set_up_axis(Plan* plan, const AxisMap& axis, unsigned sync_us) {
  plan->try_write(axis.object(0x6007), 0, 2, 3);  // when the connection is lost: quick stop
  plan->try_write(axis.object(0x605A), 0, 2, 2);  // at a quick stop: the drive's own ramp, then no torque
  if (axis.mode != kModeProfileVelocity) interpolation_time(plan, axis, sync_us);
  if (axis.has_homing()) homing(plan, axis);
}

// CiA 401: what the digital outputs become when the module does not hear the control any more. 1029h:1 = 0: it goes to "pre-operational" then; 6206h: an output
// takes the value of 6207h in place of keeping its own. For analog outputs that is 6444h, which is the module's own (0 unless `objects` sets it).
void outputs_at_loss(Plan* plan, const ModuleMap& module) {
  std::uint8_t bytes[kMostDigital / 8] = {};
  for (const IoPoint& point : module.points) {
    if (!point.output || point.analog || (point.stop_value != 0) == point.active_low) continue;
    bytes[point.channel / 8] = static_cast<std::uint8_t>(bytes[point.channel / 8] | 1u << point.channel % 8);
  }
  plan->try_write(0x1029, 1, 1, 0);
  for (unsigned n = 0; n < (module.channels(true, false) + 7) / 8; ++n) {
    plan->try_write(0x6206, n + 1, 1, 0xFF);
    plan->try_write(0x6207, n + 1, 1, bytes[n]);
  }
}

void set_up_module(Plan* plan, const NodeMap& node) {
  const ModuleMap& module = *node.module;
  for (const ModulePdo& pdo : module_pdos(module, false))
    plan->pdo(0x1800, 0x1A00, pdo.number, kTpdoId + kPdoStep * (pdo.number - 1) + node.id, pdo.mapping, module.every);
  for (const ModulePdo& pdo : module_pdos(module, true))
    plan->pdo(0x1400, 0x1600, pdo.number, kRpdoId + kPdoStep * (pdo.number - 1) + node.id, pdo.mapping, kAtOnce);
  if (module.channels(false, true) > 0) plan->try_write(0x6423, 0, 1, 1);  // analog inputs are sent at all
  outputs_at_loss(plan, module);
}

}  // namespace

InterpolationTime interpolation_time_of(unsigned us) {
  int exponent = -6;
  for (; us != 0 && us % 10 == 0; us /= 10) ++exponent;
  return {us, exponent};
}

std::vector<std::uint32_t> rpdo_mapping(const AxisMap& axis) {
  std::vector<std::uint32_t> objects{map_entry(axis, 0x6040, 16), map_entry(axis, axis.takes_speed() ? 0x60FF : 0x607A, 32)};
  if (axis.has_probe()) objects.push_back(map_entry(axis, 0x60B8, 16));
  return objects;
}
std::vector<std::uint32_t> tpdo_mapping(const AxisMap& axis) { return {map_entry(axis, 0x6041, 16), map_entry(axis, 0x6064, 32)}; }
std::vector<std::uint32_t> probe_mapping(const AxisMap& axis) {
  return {map_entry(axis, 0x60B9, 16), map_entry(axis, axis.skip_falling ? 0x60BB : 0x60BA, 32)};
}

std::vector<SetupStep> axis_setup(const AxisMap& axis, unsigned sync_us) {
  Plan plan;
  set_up_axis(&plan, axis, sync_us);
  return plan.steps;
}

std::vector<SetupStep> setup_plan(const BusMap& bus, const NodeMap& node) {
  Plan plan;
  plan.add(Kind::kCheck, 0x1000, 0, 4, node.module ? kProfile401 : kProfile402, 0xFFFF);
  if (node.vendor != 0) plan.add(Kind::kCheck, 0x1018, 1, 4, node.vendor);
  if (node.product != 0) plan.add(Kind::kCheck, 0x1018, 2, 4, node.product);
  plan.write(0x1017, 0, 2, bus.heartbeat_ms);
  plan.write(0x1016, 1, 4, bus.own_id << 16 | static_cast<std::uint32_t>(bus.heartbeat_ms * kPatience));
  plan.try_write(0x1006, 0, 4, bus.sync_us);
  for (unsigned n = 0; n < kDefaultPdos; ++n) {
    plan.try_write(0x1400 + n, 1, 4, kPdoOff | (kRpdoId + kPdoStep * n + node.id));
    plan.try_write(0x1800 + n, 1, 4, kPdoOff | (kTpdoId + kPdoStep * n + node.id));
  }
  if (node.module) set_up_module(&plan, node);
  unsigned takes = 0, sends = 0;
  for (const AxisMap& axis : node.axes) {
    plan.pdo(0x1400, 0x1600, axis.rpdo, kRpdoId + kPdoStep * takes++ + node.id, rpdo_mapping(axis));
    plan.pdo(0x1800, 0x1A00, axis.tpdo, kTpdoId + kPdoStep * sends++ + node.id, tpdo_mapping(axis));
    if (axis.has_probe()) plan.pdo(0x1800, 0x1A00, axis.tpdo + 1, kTpdoId + kPdoStep * sends++ + node.id, probe_mapping(axis));
    set_up_axis(&plan, axis, bus.sync_us);
  }
  for (const ObjectValue& object : node.objects) plan.write(object.index, object.sub, object.bytes, object.value);
  plan.steps.insert(plan.steps.end(), plan.checks.begin(), plan.checks.end());
  plan.add(Kind::kCheck, 0x1016, 1, 4, bus.own_id << 16, 0x00FF0000);  // the last one: an object whose value of its own is another
  return plan.steps;
}

std::vector<ObjectValue> own_objects(const BusMap& bus, NodeMap node) {
  constexpr unsigned kModeOfOperation = 0x6060;  // written by the service (service.cpp)
  node.objects.clear();
  std::vector<ObjectValue> own;
  for (const SetupStep& step : setup_plan(bus, node))
    if (step.kind != Kind::kCheck) own.push_back(step.object);
  const auto add = [&own](std::uint32_t entry) { own.push_back({static_cast<std::uint16_t>(entry >> 16), static_cast<std::uint8_t>(entry >> 8), 0, 0}); };
  for (const AxisMap& axis : node.axes) {
    add(axis.object(kModeOfOperation) << 16);
    for (const std::uint32_t entry : rpdo_mapping(axis)) add(entry);
  }
  if (node.module)
    for (const ModulePdo& pdo : module_pdos(*node.module, true))
      for (const std::uint32_t entry : pdo.mapping) add(entry);
  return own;
}

}  // namespace nc::hal::canopen
