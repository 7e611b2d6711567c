// SPDX-License-Identifier: Apache-2.0
// See point_uses.hpp.
#include "runtime/point_uses.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include "runtime/config_sections.hpp"
#include "runtime/hal_factory.hpp"

namespace nc::rt {
namespace {

using Role = PointRole;
using Way = PointWay;

constexpr const char* kAlone = "nothing else sets it";
constexpr const char* kAnything = "anything";
constexpr const char* kNoOther = "no other drive or spindle gives it, and no bus";

constexpr PointRoleRow kPointRoles[] = {
    {Role::kMacroOutput, Way::kSetsOutput, "`[macro_interface]`, an output", "an output of the macro interface", "the ladder program may write it as well; no signal, homing or brake sets it"},
    {Role::kSignalOutput, Way::kSetsOutput, "`[signals]`, `nc.`", "a signal of the control", kAlone},
    {Role::kHomingRequest, Way::kSetsOutput, "`[[axis]]` `homing.request`", "the homing request of axis %", "nothing else sets it, and only the drive of this axis obeys it"},
    {Role::kBrake, Way::kSetsOutput, "`[[axis]]` `brake.point`", "the brake of axis %", "nothing else sets it or obeys it"},
    {Role::kDriveHoming, Way::kObeysOutput, "`[[canopen.drive.axis]]` `homing.request`", "the start of homing of the drive of axis %", "of several drives; no command of a spindle"},
    {Role::kSpindleTurn, Way::kObeysOutput, "`[[canopen.drive.spindle]]` `forward`, `backward`", "a way for % to turn", "of several spindles, of each for one way only"},
    {Role::kSpindleOrient, Way::kObeysOutput, "`[[canopen.drive.spindle]]` `orient.request`", "the orientation of %", "of several spindles"},
    {Role::kSpindleGear, Way::kObeysOutput, "`[[canopen.drive.spindle]]` `gear_select`", "the gear step of %", "of several spindles"},
    {Role::kSimulatedCommand, Way::kObeysOutput, "`[sim.spindle]`, `[sim.tool_changer]`", "a command of the simulated machine", "one command only"},
    {Role::kDriveHomed, Way::kGivesInput, "`[[canopen.drive.axis]]` `homing.done`", "what the drive of axis % says of its homing", kNoOther},
    {Role::kSpindleOriented, Way::kGivesInput, "`[[canopen.drive.spindle]]` `orient.done`", "what % says of its orientation", kNoOther},
    {Role::kSimulatedAnswer, Way::kGivesInput, "`[sim.spindle]`, `[sim.tool_changer]`", "an answer of the simulated machine", kNoOther},
    {Role::kHomingDone, Way::kReadsInput, "`[[axis]]` `homing.done`", "the end of homing of axis %", "not of another axis, and no switch"},
    {Role::kDog, Way::kReadsInput, "`[[axis]]` `homing.dog`", "the dog of axis %", "also the dog of axes with another `order`; no limit switch, whose alarm would end each search"},
    {Role::kIndex, Way::kReadsInput, "`[[axis]]` `homing.index`", "the index pulse of axis %", "also that of axes with another `order`; no switch"},
    {Role::kLimit, Way::kReadsInput, "`[[axis]]` `limit_switches`", "a limit switch of axis %", "several axes in one line, but not both ends of one axis; not where an axis looks for it (`kind = \"limit\"`): the others would be in alarm"},
    {Role::kWheelCounter, Way::kReadsInput, "`[[handwheel]]` `counter`", "the counter of handwheel %", "one wheel only"},
    {Role::kWheelTimes10, Way::kReadsInput, "`[[handwheel]]` `times_10`", "the factor 10 of handwheel %", "of several wheels"},
    {Role::kWheelTimes100, Way::kReadsInput, "`[[handwheel]]` `times_100`", "the factor 100 of handwheel %", "of several wheels, not beside `times_10` of the same one"},
    {Role::kStick, Way::kReadsInput, "`[[joystick]]` `input`", "a joystick", "of several axes"},
    {Role::kMeasuredSpeed, Way::kReadsInput, "`[[spindle]]` `feedback`", "the measured speed of %", "of several spindles"},
    {Role::kSupply, Way::kReadsInput, "`[signals]` `plc.power_fail_n`", "what the supply says", kAnything},
    {Role::kFree, Way::kReadsInput, "`[signals]` other `plc.`, `[macro_interface]`, `[[handwheel]]` `axes`, `[[joystick]]` `dead_man` and `chosen_by`, the ladder program", "an input", kAnything},
};

constexpr bool point_roles_are_in_order() {
  for (unsigned i = 0; i < std::size(kPointRoles); ++i)
    if (static_cast<unsigned>(kPointRoles[i].role) != i) return false;
  return std::size(kPointRoles) == static_cast<unsigned>(Role::kFree) + 1;
}
static_assert(point_roles_are_in_order());

Way way_of(const PointUse& use) { return kPointRoles[static_cast<unsigned>(use.role)].way; }
bool same_owner(const PointUse& one, const PointUse& other) { return one.system == other.system && one.number == other.number; }

bool is_word_meaning(Role role) { return role == Role::kWheelCounter || role == Role::kStick || role == Role::kMeasuredSpeed; }
bool is_switch(Role role) { return role == Role::kDog || role == Role::kIndex || role == Role::kLimit; }
bool is_report(Role role) { return role == Role::kDriveHomed || role == Role::kSpindleOriented; }

// Axes of one order look for their dogs at the same time.
unsigned order_of(const Config& config, const PointUse& use) { return config.equipment[use.system][use.number].homing.order; }

// The axis looks for this limit switch.
bool is_looked_for(const Config& config, const PointUse& use) {
  const AxisEquipment& equipment = config.equipment[use.system][use.number];
  return use.role == Role::kLimit && equipment.homing.kind == HomingKind::kLimit && equipment.homing.dog.point == use.point;
}

constexpr const char* kNotTogether = "says two things that are not true together";

// Both go by the input; `one` is the one whose role comes first. Null: they may.
const char* trouble_of_readers(const Config& config, const PointUse& one, const PointUse& other) {
  const bool own = same_owner(one, other);
  if (is_word_meaning(one.role) && is_word_meaning(other.role)) return one.role != other.role || one.role == Role::kWheelCounter ? kNotTogether : nullptr;
  if (one.role == Role::kWheelTimes10 && other.role == Role::kWheelTimes100) return own ? kNotTogether : nullptr;
  if (one.role == Role::kHomingDone) return is_switch(other.role) || (other.role == Role::kHomingDone && !own) ? kNotTogether : nullptr;
  if (!is_switch(one.role) || !is_switch(other.role)) return nullptr;
  if (one.role == Role::kLimit) return own || is_looked_for(config, one) || is_looked_for(config, other) ? kNotTogether : nullptr;
  if (other.role == Role::kLimit) return kNotTogether;
  return own || order_of(config, one) == order_of(config, other) ? kNotTogether : nullptr;
}

// What is wrong with two uses of one point, of which `one` has the role that comes first; null: nothing.
const char* trouble_of(const Config& config, const PointUse& one, const PointUse& other) {
  const Way first = way_of(one), second = way_of(other);
  if (first == Way::kSetsOutput && second == Way::kSetsOutput) return "is set by two";
  if (first == Way::kGivesInput && second == Way::kGivesInput) return "is given by two";
  if (first == Way::kSetsOutput && second == Way::kObeysOutput) {
    const bool own_drive = other.role == Role::kDriveHoming && same_owner(one, other);
    return one.role == Role::kBrake || (one.role == Role::kHomingRequest && !own_drive) ? "asks for two things" : nullptr;
  }
  if (first == Way::kObeysOutput && second == Way::kObeysOutput)
    return one.role != other.role || one.role == Role::kSimulatedCommand || (one.role == Role::kSpindleTurn && same_owner(one, other)) ? "asks for two things" : nullptr;
  if (first == Way::kReadsInput && second == Way::kReadsInput) return trouble_of_readers(config, one, other);
  if (first != Way::kGivesInput || second != Way::kReadsInput) return nullptr;
  if (is_report(one.role) && is_switch(other.role)) return kNotTogether;
  const bool own_report = one.role == Role::kDriveHomed && same_owner(one, other);
  return other.role == Role::kHomingDone && is_report(one.role) && !own_report ? kNotTogether : nullptr;
}

std::string words_of(const Config& config, const PointUse& use) {
  std::string text = kPointRoles[static_cast<unsigned>(use.role)].what;
  const std::size_t at = text.find('%');
  if (at == std::string::npos) return text;
  std::string owner;
  if (use.role == Role::kSpindleTurn || use.role == Role::kSpindleOrient || use.role == Role::kSpindleGear || use.role == Role::kSpindleOriented || use.role == Role::kMeasuredSpeed)
    owner = "spindle " + std::to_string(use.number + 1);
  else if (use.role >= Role::kWheelCounter)
    owner = std::to_string(use.number + 1);
  else
    owner = std::string(1, config.nc.system[use.system].axis[use.number].name);
  if (use.system != 0) owner += " of part system " + std::to_string(use.system + 1);
  return text.replace(at, 1, owner);
}

const PointUse* find_use(const Config& config, Role role, const PointUse& of) {
  const auto found = std::find_if(config.point_uses.begin(), config.point_uses.end(), [&](const PointUse& use) { return use.role == role && same_owner(use, of); });
  return found == config.point_uses.end() ? nullptr : &*found;
}

// The drive on the bus does not home by points, so the point has to go to another device.
void check_somebody_hears(TableReader* root, const Config& config, const PointUse& use) {
  const hal::Point& point = config.points.at(static_cast<unsigned>(use.point));
  if (config.canopen.nodes.empty() || point.bus != 0) return;
  root->errors()->add(use.place.line, use.place.key, words_of(config, use) + (use.role == Role::kHomingRequest ? " goes nowhere" : " comes from nowhere") + ": its [[canopen.drive.axis]] has no homing, and point \"" + point.name + "\" is on no bus");
}

// An axis that its drive homes, and the drive on the bus that does: without a ladder program between them nothing but their points connects them.
void check_drives_hear(TableReader* root, const Config& config) {
  if (!config.ladder.program.empty()) return;
  for (const auto& [asks, hears] : {std::pair{Role::kHomingRequest, Role::kDriveHoming}, std::pair{Role::kHomingDone, Role::kDriveHomed}}) {
    for (const PointUse& use : config.point_uses) {
      if (use.role != asks) continue;
      const PointUse* const drive = find_use(config, hears, use);
      if (drive == nullptr) check_somebody_hears(root, config, use);
      if (drive == nullptr || drive->point == use.point) continue;
      root->errors()->add_twice(use.place, drive->place, words_of(config, use) + " and " + words_of(config, *drive) + " must be one point: without a ladder program nothing connects two");
    }
  }
}

}  // namespace

std::span<const PointRoleRow> point_roles() { return kPointRoles; }

void check_point_uses(TableReader* root, const Config& config) {
  std::vector<const PointUse*> uses;
  uses.reserve(config.point_uses.size());
  for (const PointUse& use : config.point_uses) uses.push_back(&use);
  std::stable_sort(uses.begin(), uses.end(), [](const PointUse* one, const PointUse* other) { return one->role < other->role; });
  for (std::size_t j = 1; j < uses.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      const PointUse &one = *uses[i], &other = *uses[j];
      if (one.point != other.point) continue;
      const char* const trouble = trouble_of(config, one, other);
      if (trouble == nullptr) continue;
      root->errors()->add_twice(one.place, other.place,
                                "point \"" + config.points.at(static_cast<unsigned>(one.point)).name + "\" " + trouble + ": " + words_of(config, one) + ", and " + words_of(config, other));
      break;  // once for each use is enough
    }
  }
  check_drives_hear(root, config);
}

}  // namespace nc::rt
