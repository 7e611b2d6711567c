// SPDX-License-Identifier: Apache-2.0
// Keys of [[axis]]: homing, limit_switches, brake; screw: config_screw.cpp. See config_equipment.hpp, docs/homing.md.
#include "runtime/config_equipment.hpp"

#include <algorithm>

namespace nc::rt {
namespace {

constexpr double kTravelShare = 1.2; // of the way between the soft limits: the switches lie behind them
constexpr double kTravelOfTurn = 400;  // deg
constexpr double kJogShare = 0.1;    // of the largest velocity, where no speed of a search is given

using Part = EquipmentName::Part;

bool searches(HomingKind kind) { return kind == HomingKind::kSwitch || kind == HomingKind::kLimit; }

// Behind an error that makes them mean nothing.
void leave_rest(TableReader* reader) {
  reader->each([](const std::string&, const toml::node&) {});
}

// Keys that only some kinds have.
void refuse_keys_of_others(TableReader* reader, HomingKind kind, const std::string& name) {
  struct Row {
    const char* key;
    bool fits;
  };
  const bool searching = searches(kind), dog = kind == HomingKind::kSwitch, drive = kind == HomingKind::kDrive;
  const bool placed = searching || kind == HomingKind::kHere;
  for (const Row& row : {Row{"direction", searching}, {"fast", searching}, {"creep", searching}, {"travel", searching}, {"index", searching},
                         {"index_travel", searching}, {"edge", dog}, {"dog", dog}, {"dog_contact", dog}, {"offset", placed},
                         {"request", drive}, {"done", drive}}) {
    if (!row.fits && reader->find(row.key) != nullptr) reader->error(row.key, "is nothing that homing of kind \"" + name + "\" has");
  }
}

void read_name(TableReader* reader, const char* key, Part part, hal::PointDirection direction, Config* config, unsigned s, unsigned a) {
  EquipmentName name{"", {reader->line(key), reader->path(key)}, part, direction, static_cast<std::uint8_t>(s), static_cast<std::uint8_t>(a)};
  if (reader->string(key, &name.name)) config->equipment_names.push_back(name);
}

void read_contact(TableReader* reader, const char* key, bool* closed) {
  unsigned word = 0;
  if (reader->choice(key, {"closed", "open"}, &word)) *closed = word == 0;
}

void read_search(TableReader* reader, const nc_axis_config& axis, HomingConfig* homing) {
  for (const char* key : {"direction", "fast", "creep"}) reader->require(key);
  unsigned word = 0;
  if (reader->choice("direction", {"-", "+"}, &word)) homing->direction = word == 0 ? -1 : 1;
  const bool fast = reader->number("fast", &homing->fast, quantity::kSpeed), creep = reader->number("creep", &homing->creep, quantity::kSpeed);
  if (fast && axis.max_velocity > 0 && homing->fast > axis.max_velocity)
    reader->error("fast", "must not be above max_velocity (" + number_text(axis.max_velocity) + ")");
  if (fast && creep && homing->creep > homing->fast) reader->error("creep", "must not be above fast (" + number_text(homing->fast) + ")");
  homing->travel = axis.soft_limited ? kTravelShare * (axis.soft_max - axis.soft_min) : kTravelOfTurn;
  if (!axis.soft_limited && !axis.rotary) reader->require("travel");
  reader->number("travel", &homing->travel, quantity::kWay);
  if (reader->find("index") != nullptr) reader->require("index_travel");
  else if (reader->find("index_travel") != nullptr) reader->error("index_travel", "is for an index pulse: index");
  reader->number("index_travel", &homing->index_travel, quantity::kWay);
}

void check_reference(TableReader* reader, const nc_axis_config& axis, const HomingConfig& homing) {
  if (!axis.soft_limited || homing.kind == HomingKind::kDrive) return;
  const double at = axis.reference[0];
  if (at < axis.soft_min || at > axis.soft_max)
    reader->error("kind", "the axis goes to its reference position, and that (" + number_text(at) + ") is not inside soft_limits: reference");
}

// From the mark to the reference position, which is inside the soft limits, and the mark is where the axis can go. So it is no farther than that, or than a turn where nothing ends it.
void check_offset(TableReader* reader, const nc_axis_config& axis, const HomingConfig& homing) {
  constexpr double kTurn = 360;
  const double travel = axis.soft_limited ? axis.soft_max - axis.soft_min : axis.rotary ? kTurn : kMaxLength;
  const double most = std::max(travel, searches(homing.kind) && !axis.rotary ? homing.travel : 0);
  if (std::abs(homing.offset) > most) reader->error("offset", "is farther than the axis travels (" + number_text(most) + ")");
}

void read_homing(TableReader* reader, Config* config, unsigned s, unsigned a) {
  const nc_axis_config& axis = config->nc.system[s].axis[a];
  HomingConfig& homing = config->equipment[s][a].homing;
  constexpr std::string_view kKinds[] = {"switch", "limit", "here", "absolute", "drive"};
  unsigned word = 0;
  reader->require("kind");
  if (axis.spindle != 0) reader->error("kind", "the axis is a spindle, which has a zero mark of its own");
  const bool known = reader->choice("kind", kKinds, &word);
  if (known) homing.kind = static_cast<HomingKind>(word + 1);
  reader->boolean("required", &homing.required);
  reader->integer("order", &homing.order, 1, 99);
  reader->number("timeout_s", &homing.timeout_s, 0.1, 36000);
  if (!known) return leave_rest(reader);
  refuse_keys_of_others(reader, homing.kind, std::string(kKinds[word]));
  if (searches(homing.kind)) read_search(reader, axis, &homing);
  if (homing.kind == HomingKind::kSwitch) {
    reader->require("dog");
    homing.dog.closed = true;
    read_contact(reader, "dog_contact", &homing.dog.closed);
    if (reader->choice("edge", {"enter", "leave"}, &word)) homing.leaves = word == 1;
    read_name(reader, "dog", Part::kDog, hal::PointDirection::kInput, config, s, a);
  }
  read_name(reader, "index", Part::kIndex, hal::PointDirection::kInput, config, s, a);
  if (reader->number("offset", &homing.offset, -kMaxLength, kMaxLength)) check_offset(reader, axis, homing);
  if (homing.kind == HomingKind::kDrive) {
    for (const char* key : {"request", "done"}) reader->require(key);
    read_name(reader, "request", Part::kRequest, hal::PointDirection::kOutput, config, s, a);
    read_name(reader, "done", Part::kDone, hal::PointDirection::kInput, config, s, a);
  }
  homing.jog = homing.fast > 0 ? homing.fast : kJogShare * axis.max_velocity;
  if (reader->number("jog", &homing.jog, quantity::kSpeed) && axis.max_velocity > 0 && homing.jog > axis.max_velocity)
    reader->error("jog", "must not be above max_velocity (" + number_text(axis.max_velocity) + ")");
  check_reference(reader, axis, homing);
}

int* place_of(Config* config, const EquipmentName& name) {
  AxisEquipment& equipment = config->equipment[name.system][name.axis];
  switch (name.part) {
    case Part::kDog: return &equipment.homing.dog.point;
    case Part::kIndex: return &equipment.homing.index.point;
    case Part::kRequest: return &equipment.homing.request;
    case Part::kDone: return &equipment.homing.done;
    case Part::kMinus: return &equipment.limit[0].point;
    case Part::kPlus: return &equipment.limit[1].point;
    case Part::kBrake: break;
  }
  return &equipment.brake.point;
}

PointRole role_of(Part part) {
  switch (part) {
    case Part::kDog: return PointRole::kDog;
    case Part::kIndex: return PointRole::kIndex;
    case Part::kRequest: return PointRole::kHomingRequest;
    case Part::kDone: return PointRole::kHomingDone;
    case Part::kMinus:
    case Part::kPlus: return PointRole::kLimit;
    case Part::kBrake: break;
  }
  return PointRole::kBrake;
}

// What is wrong with a point for this; empty: nothing.
std::string fault_of(const Config& config, const EquipmentName& name, int index) {
  if (index < 0) return "no point is named \"" + name.name + "\"";
  const hal::Point& point = config.points.at(static_cast<unsigned>(index));
  const std::string shown = "point \"" + name.name + "\" ";
  const bool input = name.direction == hal::PointDirection::kInput;
  if (point.direction != name.direction) return shown + (input ? "must be an input" : "must be an output");
  if (point.type != hal::PointType::kBit) return shown + "must be a bit";
  if (input) return "";
  if (name.part == Part::kBrake && point.initial != 0) return shown + "must be 0 in the beginning: that closes the brake";
  return "";
}

void use_limit_as_dog(TableReader* root, Config* config, unsigned s, unsigned a) {
  AxisEquipment& equipment = config->equipment[s][a];
  if (equipment.homing.kind != HomingKind::kLimit) return;
  equipment.homing.dog = equipment.limit[side_of(equipment.homing.direction)];
  if (equipment.homing.dog.present()) return;
  const ConfigPlace& place = config->homing_place[s][a];
  root->errors()->add(place.line, place.key,
                      std::string("needs the limit switch in ") + (equipment.homing.direction > 0 ? "+: limit_switches.plus" : "-: limit_switches.minus"));
}

}  // namespace

void read_equipment(TableReader* axis, Config* config, unsigned s, unsigned a) {
  AxisEquipment& equipment = config->equipment[s][a];
  config->homing_place[s][a] = {axis->line("homing"), axis->path("homing")};
  axis->table("homing", [&](TableReader& reader) { read_homing(&reader, config, s, a); });
  axis->table("limit_switches", [&](TableReader& reader) {
    bool closed = true;
    read_contact(&reader, "contact", &closed);
    equipment.limit[0].closed = equipment.limit[1].closed = closed;
    read_name(&reader, "minus", Part::kMinus, hal::PointDirection::kInput, config, s, a);
    read_name(&reader, "plus", Part::kPlus, hal::PointDirection::kInput, config, s, a);
    if (reader.find("minus") == nullptr && reader.find("plus") == nullptr)
      reader.errors()->add(reader.line(), reader.path(), "needs minus, plus or both");
  });
  axis->table("brake", [&](TableReader& reader) {
    reader.require("point");
    read_name(&reader, "point", Part::kBrake, hal::PointDirection::kOutput, config, s, a);
    reader.number("open_s", &equipment.brake.open_s, quantity::kBrakeTime);
    reader.number("close_s", &equipment.brake.close_s, quantity::kBrakeTime);
    if (config->nc.system[s].axis[a].spindle != 0) reader.error("point", "the axis is a spindle, whose servo goes off by itself");
  });
  axis->table("screw", [&](TableReader& reader) { read_screw(&reader, config->nc.system[s].axis[a], config->nc.cycle_s, &equipment.screw); });
}

void resolve_equipment(TableReader* root, Config* config) {
  for (const EquipmentName& name : config->equipment_names) {
    const int index = config->points.find(name.name);
    const std::string fault = fault_of(*config, name, index);
    if (!fault.empty()) {
      root->errors()->add(name.place.line, name.place.key, fault);
      continue;
    }
    *place_of(config, name) = index;
    config->point_uses.push_back({role_of(name.part), index, name.place, name.system, name.axis});
  }
  for (unsigned s = 0; s < config->nc.system_count; ++s) {
    for (unsigned a = 0; a < config->nc.system[s].axis_count; ++a) use_limit_as_dog(root, config, s, a);
  }
}

namespace {

// The simulated switches are those that the axis has.
void read_sim_axis(TableReader* reader, Config* config) {
  std::string name;
  unsigned s = 0, a = 0;
  reader->require("name");
  if (!reader->string("name", &name)) return leave_rest(reader);
  if (!find_axis(*config, name, &s, &a)) {
    reader->error("name", "there is no axis \"" + name + "\"");
    return leave_rest(reader);
  }
  const AxisEquipment& equipment = config->equipment[s][a];
  hal::SimSwitches& sim = config->sim.axis[s][a].switches;
  double stands_at = config->start[s].v[a];
  if (reader->number("stands_at", &stands_at, -kMaxLength, kMaxLength)) sim.offset = stands_at - config->start[s].v[a];
  const auto own = [&](int point) { return point >= 0 && config->points.at(static_cast<unsigned>(point)).bus == 0; };
  const auto lacks = [&](const char* key, bool there, const char* what) {
    if (!there && reader->find(key) != nullptr) reader->error(key, std::string("the axis has no ") + what + " on a point of the simulated machine");
    return there;
  };
  std::vector<double> range;
  if (lacks("dog", own(equipment.homing.dog.point) && equipment.homing.kind == HomingKind::kSwitch, "dog") && reader->numbers("dog", &range, 2, 2)) {
    sim.dog = {equipment.homing.dog.point, equipment.homing.dog.closed, range[0], range[1]};
    if (range[0] > range[1]) reader->error("dog", "the first number must not be above the second");
  }
  if (lacks("minus", own(equipment.limit[0].point), "limit switch in -") && reader->number("minus", &sim.minus.to, -kMaxLength, kMaxLength))
    sim.minus = {equipment.limit[0].point, equipment.limit[0].closed, -1e9, sim.minus.to};
  if (lacks("plus", own(equipment.limit[1].point), "limit switch in +") && reader->number("plus", &sim.plus.from, -kMaxLength, kMaxLength))
    sim.plus = {equipment.limit[1].point, equipment.limit[1].closed, sim.plus.from, 1e9};
  if (lacks("index", own(equipment.homing.index.point), "index pulse") && reader->numbers("index", &range, 2, 2)) {
    sim.index = equipment.homing.index.point;
    sim.pitch = range[0];
    sim.mark = range[1];
    if (!(range[0] > 0)) reader->error("index", "the first number, from mark to mark, must be above 0");
  }
  reader->number("weight", &sim.weight, quantity::kWeight);
  if (own(equipment.brake.point)) sim.brake = equipment.brake.point;
  if (lacks("brake_open_s", sim.brake >= 0, "brake")) reader->number("brake_open_s", &sim.brake_times.unclamp_s, quantity::kBrakeTime);
  if (lacks("brake_close_s", sim.brake >= 0, "brake")) reader->number("brake_close_s", &sim.brake_times.clamp_s, quantity::kBrakeTime);
}

}  // namespace

void read_sim_axes(TableReader* sim, Config* config) {
  sim->tables("axis", [&](TableReader& reader, std::size_t) { read_sim_axis(&reader, config); });
}

}  // namespace nc::rt
