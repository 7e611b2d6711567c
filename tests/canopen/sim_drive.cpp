// SPDX-License-Identifier: Apache-2.0
// A simulated CiA 402 drive. See sim_drive.hpp.
#include "sim_drive.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace nc::test {
namespace {

std::uint32_t number(const std::uint8_t* data, std::size_t bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = bytes; i-- > 0;) value = value * 256 + data[i];
  return value;
}
std::vector<std::uint8_t> little(std::uint32_t value, unsigned bytes) {
  std::vector<std::uint8_t> data;
  for (unsigned i = 0; i < bytes; ++i, value >>= 8) data.push_back(static_cast<std::uint8_t>(value & 0xFF));
  return data;
}

}  // namespace

SimDrive::SimDrive(unsigned node, unsigned axes) : node_(node), axis_(axes) { defaults(); }

void SimDrive::defaults() {
  objects_.clear();
  set_object(0x1000, 0, 4, 0x00020192, false);
  set_object(0x1001, 0, 1, 0, false);
  set_object(0x1018, 0, 1, 4, false);
  set_object(0x1018, 1, 4, 0x1234, false);
  set_object(0x1018, 2, 4, 0x5678, false);
  objects_[key(0x1008, 0)] = {0, 0, false, {'S', 'i', 'm', 'u', 'l', 'a', 't', 'e', 'd', ' ', 'd', 'r', 'i', 'v', 'e'}};
  set_object(0x1006, 0, 4, 0);
  set_object(0x1016, 1, 4, 0);
  set_object(0x1017, 0, 2, stored_heartbeat);
  for (unsigned a = 0; a < axis_.size(); ++a) {
    for (unsigned n = 0; n < 2; ++n) {
      const unsigned p = 64 * a + n;
      for (const unsigned communication : {0x1400u, 0x1800u}) {
        set_object(communication + p, 1, 4, a == 0 ? (communication == 0x1400 ? 0x200u : 0x180u) + 0x100 * n + node_ : 0x80000000u);
        set_object(communication + p, 2, 1, 255);
      }
      for (const unsigned mapping : {0x1600u, 0x1A00u}) {
        set_object(mapping + p, 0, 1, 1);
        for (unsigned sub = 1; sub <= 8; ++sub) set_object(mapping + p, sub, 4, 0);
        set_object(mapping + p, 1, 4, (base(a) + (mapping == 0x1600 ? 0x40 : 0x41)) << 16 | 16);
      }
    }
    const unsigned b = base(a);
    set_object(b + 0x40, 0, 2, 0);
    set_object(b + 0x41, 0, 2, 0, false);
    set_object(b + 0x5A, 0, 2, 2);
    set_object(b + 0x07, 0, 2, 1);
    set_object(b + 0x60, 0, 1, 0);
    set_object(b + 0x61, 0, 1, 0, false);
    set_object(b + 0x64, 0, 4, 0, false);
    set_object(b + 0x65, 0, 4, 100000);
    set_object(b + 0x7A, 0, 4, 0);
    set_object(b + 0x7C, 0, 4, 0);
    set_object(b + 0x98, 0, 1, 0);
    set_object(b + 0x99, 1, 4, 0);
    set_object(b + 0x99, 2, 4, 0);
    set_object(b + 0x9A, 0, 4, 0);
    set_object(b + 0xB8, 0, 2, 0);
    set_object(b + 0xB9, 0, 2, 0, false);
    set_object(b + 0xBA, 0, 4, 0, false);
    set_object(b + 0xBB, 0, 4, 0, false);
    set_object(b + 0xFF, 0, 4, 0);
    set_object(b + 0xC2, 1, 1, 0);
    set_object(b + 0xC2, 2, 1, 0);
  }
  if (more_defaults) more_defaults();
}

void SimDrive::set_object(unsigned index, unsigned sub, unsigned bytes, std::uint32_t value, bool writable) {
  objects_[key(index, sub)] = {bytes, value, writable, {}};
}

std::uint32_t SimDrive::object(unsigned index, unsigned sub) const {
  const auto entry = objects_.find(key(index, sub));
  return entry == objects_.end() ? 0 : entry->second.value;
}

void SimDrive::send(unsigned id, std::vector<std::uint8_t> data) {
  if (dead || !out) return;
  CanFrame frame;
  frame.id = static_cast<std::uint16_t>(id);
  frame.length = static_cast<std::uint8_t>(data.size());
  std::memcpy(frame.data, data.data(), data.size());
  out(frame);
}

void SimDrive::power_cycle() {
  for (Axis& axis : axis_) {
    const SimPlantAxis plant = axis.plant;
    axis = {};
    axis.plant = plant;
    axis.plant.enabled = false;
    axis.plant.coast = 0;
    if (loses_position) axis.plant.position = 0;
  }
  defaults();
  transfer_ = {};
  nmt_ = starts_itself ? 5 : 0x7F;
  master_heard_ns_ = -1;
  dead = false;
  if (!unheard) send(0x700 + node_, {0});
}

void SimDrive::tick(std::int64_t now_ns) {
  now_ns_ = now_ns;
  if (dead) return;
  const std::uint32_t producer = object(0x1017, 0), consumer = object(0x1016, 1);
  if (producer != 0 && !no_heartbeat && now_ns - beat_ns_ >= producer * 1'000'000LL) {
    beat_ns_ = now_ns;
    send(0x700 + node_, {static_cast<std::uint8_t>(nmt_)});
  }
  if ((consumer & 0xFFFF) != 0 && master_heard_ns_ >= 0 && nmt_ == 5 && now_ns - master_heard_ns_ > (consumer & 0xFFFF) * 1'000'000LL) {
    emergency(0x8130, 0x11);
    for (Axis& axis : axis_)
      if (axis.state == State::kEnabled) axis.state = State::kQuickStop;  // 6007h = 3
    master_heard_ns_ = -1;
  }
}

void SimDrive::on_frame(const CanFrame& frame) {
  if (dead) return;
  if (frame.id == 0) return on_nmt(frame);
  if (frame.id == 0x80) return on_sync();
  if (frame.id == 0x600 + node_ || (answers_as >= 0 && frame.id == 0x600u + static_cast<unsigned>(answers_as))) return on_sdo(frame);
  if (frame.id > 0x700 && frame.id != 0x700 + node_) {
    heard_heartbeats.insert(frame.id - 0x700u);
    if ((object(0x1016, 1) >> 16 & 0x7F) == frame.id - 0x700u) master_heard_ns_ = now_ns_;
    return;
  }
  on_rpdo(frame);
}

void SimDrive::on_nmt(const CanFrame& frame) {
  if (frame.length != 2 || (frame.data[1] != 0 && frame.data[1] != node_)) return;
  switch (frame.data[0]) {
    case 0x01: nmt_ = 5; break;
    case 0x02: nmt_ = 4; break;
    case 0x80: nmt_ = 0x7F; break;
    case 0x81:
    case 0x82:
      ++resets_seen;
      nmt_ = 0x7F;
      send(0x700 + node_, {0});
      break;
    default: break;
  }
  if (nmt_ != 5)
    for (Axis& axis : axis_)
      if (axis.state == State::kEnabled) axis.state = State::kQuickStop;
}

// ---- SDO server ----

void SimDrive::sdo_abort(unsigned index, unsigned sub, std::uint32_t code) {
  std::vector<std::uint8_t> data{0x80, static_cast<std::uint8_t>(index & 0xFF), static_cast<std::uint8_t>(index >> 8), static_cast<std::uint8_t>(sub)};
  for (const std::uint8_t byte : little(code, 4)) data.push_back(byte);
  transfer_ = {};
  send(0x580 + (answers_as >= 0 ? static_cast<unsigned>(answers_as) : node_), data);
}

void SimDrive::on_sdo(const CanFrame& frame) {
  if (frame.length != 8) return;
  const unsigned command = frame.data[0], index = number(frame.data + 1, 2), sub = frame.data[3];
  const unsigned id = 0x580 + (answers_as >= 0 ? static_cast<unsigned>(answers_as) : node_);
  std::vector<std::uint8_t> head{0, frame.data[1], frame.data[2], frame.data[3], 0, 0, 0, 0};
  if (command == 0x40) {  // upload
    const auto entry = objects_.find(key(index, sub));
    if (entry == objects_.end()) return sdo_abort(index, sub, 0x06020000);
    const Object& found = entry->second;
    const std::vector<std::uint8_t> data = found.text.empty() ? little(found.value, found.bytes) : found.text;
    if (data.size() <= 4 && !answers_segmented) {
      head[0] = static_cast<std::uint8_t>(0x43 | (4 - data.size()) << 2);
      std::memcpy(head.data() + 4, data.data(), data.size());
      return send(id, head);
    }
    transfer_ = {true, false, false, key(index, sub), data, 0};
    head[0] = 0x41;
    std::memcpy(head.data() + 4, little(static_cast<std::uint32_t>(data.size()), 4).data(), 4);
    return send(id, head);
  }
  if ((command & 0xE0) == 0x60 && transfer_.upload) {  // segment of an upload
    const std::size_t count = std::min<std::size_t>(7, transfer_.data.size() - transfer_.at);
    const bool last = transfer_.at + count == transfer_.data.size();
    std::vector<std::uint8_t> segment(8, 0);
    segment[0] = static_cast<std::uint8_t>((transfer_.toggle ? 0x10 : 0) | (7 - count) << 1 | (last ? 1 : 0));
    std::memcpy(segment.data() + 1, transfer_.data.data() + transfer_.at, count);
    transfer_.at += count;
    transfer_.toggle = !transfer_.toggle;
    if (last) transfer_.upload = false;
    return send(id, segment);
  }
  if ((command & 0xE0) == 0x20) {  // download
    head[0] = 0x60;
    if ((command & 2) == 0) {
      transfer_ = {false, true, false, key(index, sub), {}, 0};
      return send(id, head);
    }
    const std::size_t count = 4 - (command >> 2 & 3);
    const std::uint32_t why = write_object(index, sub, {frame.data + 4, frame.data + 4 + count});
    return why != 0 ? sdo_abort(index, sub, why) : send(id, head);
  }
  if ((command & 0xE0) == 0x00 && transfer_.download) {
    const std::size_t count = 7 - (command >> 1 & 7);
    transfer_.data.insert(transfer_.data.end(), frame.data + 1, frame.data + 1 + count);
    std::vector<std::uint8_t> answer(8, 0);
    answer[0] = static_cast<std::uint8_t>(0x20 | (command & 0x10));
    if ((command & 1) != 0) {
      transfer_.download = false;
      const std::uint32_t why = write_object(transfer_.key >> 8, transfer_.key & 0xFF, transfer_.data);
      if (why != 0) return sdo_abort(transfer_.key >> 8, transfer_.key & 0xFF, why);
    }
    return send(id, answer);
  }
}

std::uint32_t SimDrive::write_object(unsigned index, unsigned sub, const std::vector<std::uint8_t>& data) {
  const auto entry = objects_.find(key(index, sub));
  if (entry == objects_.end()) return 0x06020000;
  if (const auto refused = refuses.find(key(index, sub)); refused != refuses.end()) return refused->second;
  Object& found = entry->second;
  if (!found.writable) return 0x06010002;
  if (found.text.empty() && data.size() != found.bytes) return 0x06070010;
  const std::uint32_t value = number(data.data(), std::min<std::size_t>(4, data.size()));
  const bool mapping = (index >= 0x1600 && index < 0x1800) || (index >= 0x1A00 && index < 0x1C00);
  if (mapping) {
    if (sub == 0 && value != 0)
      if (const std::uint32_t why = check_mapping(index, value); why != 0) return why;
    if (sub != 0 && found.bytes == 4 && object(index, 0) != 0) return 0x06010000;  // entries may be written only while their count is 0
    if (keeps_mapping && sub != 0) return 0;
  }
  found.value = value;
  for (unsigned a = 0; a < axis_.size(); ++a)
    if (index == base(a) + 0x60) objects_[key(base(a) + 0x61, 0)].value = value;
  return 0;
}

std::uint32_t SimDrive::check_mapping(unsigned index, unsigned count) {
  unsigned bits = 0;
  for (unsigned sub = 1; sub <= count; ++sub) {
    const std::uint32_t entry = object(index, sub);
    if (!objects_.contains(entry >> 8)) return 0x06040041;
    bits += entry & 0xFF;
  }
  return bits > 64 ? 0x06040042 : 0;
}

// ---- PDOs ----

std::uint32_t SimDrive::value_of(unsigned entry) const {
  const unsigned index = entry >> 16;
  for (unsigned a = 0; a < axis_.size(); ++a) {
    if (index == base(a) + 0x41) return status(a);
    if (index == base(a) + 0x64) return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::llround(axis_[a].plant.encoder_at.value_or(axis_[a].plant.position))));
    if (index == base(a) + 0xB9) return (axis_[a].probe_before & 1) | (axis_[a].probe_stored ? 2u : 0u);
    if (index == base(a) + 0xBA) return static_cast<std::uint32_t>(axis_[a].probe_position);
  }
  return object(index, entry >> 8 & 0xFF);
}

void SimDrive::take_value(unsigned entry, std::uint32_t value) {
  const unsigned index = entry >> 16;
  if (index >= 0x6200 && index < 0x6800 && axis_.empty()) objects_.at(entry >> 8).value = value;
  for (unsigned a = 0; a < axis_.size(); ++a) {
    if (index == base(a) + 0x40) axis_[a].pending_control = static_cast<std::uint16_t>(value), axis_[a].pending = true;
    if (index == base(a) + 0xFF) axis_[a].pending_velocity = static_cast<std::int32_t>(value);
    if (index == base(a) + 0x7A) axis_[a].pending_target = static_cast<std::int32_t>(value);
    if (index == base(a) + 0xB8) axis_[a].pending_probe = static_cast<std::uint16_t>(value);
  }
}

void SimDrive::on_rpdo(const CanFrame& frame) {
  if (nmt_ != 5) return;
  for (const auto& [place, communication] : objects_) {
    const unsigned index = place >> 8;
    if (index < 0x1400 || index >= 0x1600 || (place & 0xFF) != 1 || communication.value != frame.id) continue;
    ++rpdos;
    unsigned at = 0;
    const unsigned mapping = index + 0x200;
    for (unsigned sub = 1; sub <= object(mapping, 0); ++sub) {
      const std::uint32_t entry = object(mapping, sub);
      const unsigned bytes = (entry & 0xFF) / 8;
      if (at + bytes > frame.length) return emergency(0x8210, 0x11);
      take_value(entry, number(frame.data + at, bytes));
      at += bytes;
    }
  }
}

void SimDrive::on_sync() {
  if (nmt_ != 5) return;
  ++syncs;
  for (unsigned a = 0; a < axis_.size(); ++a) run(axis_[a], a);
  if (no_tpdo) return;
  for (const auto& [place, communication] : objects_) {
    const unsigned index = place >> 8;
    if (index < 0x1800 || index >= 0x1A00 || (place & 0xFF) != 1 || (communication.value & 0x80000000u) != 0) continue;
    const std::uint32_t type = object(index, 2);  // 1 to 240: with every n-th SYNC
    if (type < 1 || type > 240 || syncs % type != 0) continue;
    std::vector<std::uint8_t> data;
    const unsigned mapping = index + 0x200;
    for (unsigned sub = 1; sub <= object(mapping, 0); ++sub) {
      const std::uint32_t entry = object(mapping, sub);
      for (const std::uint8_t byte : little(value_of(entry), (entry & 0xFF) / 8)) data.push_back(byte);
    }
    if (data.size() <= 8) send(communication.value & 0x7FF, data);
  }
}

// ---- CiA 402 and the plant ----

std::uint16_t SimDrive::status(unsigned number) const {
  const Axis& axis = axis_[number];
  std::uint16_t word = 0x0200;  // remote
  switch (axis.state) {
    case State::kSwitchOnDisabled: word |= 0x0040; break;
    case State::kReady: word |= 0x0021; break;
    case State::kSwitchedOn: word |= 0x0023; break;
    case State::kEnabled: word |= 0x0027; break;
    case State::kQuickStop: word |= 0x0007; break;
    case State::kFaultReaction: word |= 0x000F; break;
    case State::kFault: word |= 0x0008; break;
  }
  const std::uint32_t mode = object(base(number) + 0x61, 0);
  if ((mode == 8 || mode == 9) && axis.state == State::kEnabled) word |= 0x1000;
  if (mode == 6 && axis.homing_done) word |= 0x1400;
  if (mode == 6 && axis.homing_error) word |= 0x2000;
  return word;
}

// Transitions 2 to 16 of the standard, and 15 on the rising edge of bit 7.
void SimDrive::command_state(Axis& axis) {
  const std::uint16_t control = axis.control;
  const bool reset = (control & 0x80) != 0 && (axis.before & 0x80) == 0;
  axis.before = control;
  if (axis.state == State::kFaultReaction) {
    axis.state = State::kFault;
    return;
  }
  if (axis.state == State::kFault) {
    if (reset && !keeps_fault) {
      axis.state = State::kSwitchOnDisabled;
      send(0x80 + node_, {0, 0, 0, 0, 0, 0, 0, 0});
    }
    return;
  }
  const bool voltage = (control & 2) != 0, no_quick = (control & 4) != 0;
  if (!voltage) {
    axis.state = State::kSwitchOnDisabled;
    return;
  }
  if (!no_quick) {
    if (axis.state == State::kEnabled) axis.state = State::kQuickStop;
    else if (axis.state != State::kQuickStop) axis.state = State::kSwitchOnDisabled;
    return;
  }
  const unsigned low = control & 0x0F;
  if (axis.state == State::kSwitchOnDisabled && (low & 7) == 6) axis.state = State::kReady;
  else if (axis.state == State::kReady && (low & 7) == 7) axis.state = State::kSwitchedOn;
  else if (axis.state == State::kSwitchedOn && low == 0x0F) {
    if (never_enables) return;
    axis.plant.command = axis.pending_target;
    axis.state = State::kEnabled;
  } else if (axis.state == State::kSwitchedOn && (low & 7) == 6) axis.state = State::kReady;
  else if (axis.state == State::kEnabled && low == 7) axis.state = State::kSwitchedOn;
  else if (axis.state == State::kEnabled && (low & 7) == 6) axis.state = State::kReady;
}

void SimDrive::run(Axis& axis, unsigned number) {
  if (axis.pending) {
    axis.pending = false;
    axis.control = axis.pending_control;
    if ((axis.pending_probe & 1) == 0) axis.probe_stored = false;
    axis.probe_before = axis.pending_probe;
    const State before = axis.state;
    command_state(axis);
    if (faults_at_enabling && before != State::kEnabled && axis.state == State::kEnabled) trip(number, 0x2310, 0x03);
  }
  move(axis, number);
}

void SimDrive::move(Axis& axis, unsigned number) {
  SimPlantAxis& plant = axis.plant;
  const std::uint32_t mode = object(base(number) + 0x61, 0);
  plant.enabled = axis.state == State::kEnabled || axis.state == State::kQuickStop;
  if (axis.state == State::kEnabled && mode == 8) {
    plant.command = axis.pending_target;
    const double step = plant.blocked ? 0 : (plant.command - plant.position) * (1 - plant.lag);
    plant.position += step;
    plant.coast = step;
    const double window = object(base(number) + 0x65, 0);
    if (std::abs(plant.command - plant.position) > window) trip(number, 0x8611, 0x21);
  } else if (axis.state == State::kEnabled && (mode == 9 || mode == 3)) {
    plant.velocity += std::clamp(axis.pending_velocity - plant.velocity, -velocity_ramp, velocity_ramp);
    plant.coast = plant.turns * plant.velocity * sync_s;
    if (!plant.blocked) plant.position += plant.coast;
  } else if (axis.state == State::kEnabled && mode == 6) {
    home(axis, number);
  } else {  // the drive's own ramp, or friction
    plant.coast *= axis.state == State::kQuickStop ? 0.8 : 0.95;
    if (std::abs(plant.coast) < 0.5) plant.coast = 0;
    if (!plant.blocked) plant.position += plant.coast;
    if (axis.state == State::kQuickStop && plant.coast == 0) axis.state = State::kSwitchOnDisabled;
  }
}

// A drive that homes moves for a while, then its position becomes the value of 607Ch.
void SimDrive::home(Axis& axis, unsigned number) {
  const bool start = (axis.control & 0x10) != 0;
  if (!start || (axis.control & 0x100) != 0) {  // it comes to rest by its ramp
    axis.plant.coast *= 0.9;
    if (std::abs(axis.plant.coast) < 0.5) axis.plant.coast = 0;
    axis.plant.position += axis.plant.coast;
    if (!start) axis.homing_left = -1, axis.homing_waits = homing_begins;
    return;
  }
  if (axis.homing_left < 0) {
    if (axis.homing_waits != 0) {
      axis.homing_waits -= axis.homing_waits > 0;
      return;
    }
    axis.homing_left = homing_syncs;
    axis.homing_done = axis.homing_error = false;
  }
  if (axis.homing_left > 0) {
    --axis.homing_left;
    axis.plant.position -= 10;
    axis.plant.coast = axis.homing_left == 0 ? 0 : -10;
    if (axis.homing_left == 0 && homing_fails) axis.homing_error = true;
    else if (axis.homing_left == 0) {
      const auto offset = static_cast<std::int32_t>(object(base(number) + 0x7C, 0));
      axis.plant.position = offset_subtracts ? -offset : offset;
      axis.homing_done = true;
    }
  }
}

void SimDrive::trip(unsigned number, std::uint16_t code, std::uint8_t error_register) {
  axis_[number].state = State::kFaultReaction;
  emergency(code, error_register);
}

void SimDrive::emergency(std::uint16_t code, std::uint8_t error_register) {
  send(0x80 + node_, {static_cast<std::uint8_t>(code & 0xFF), static_cast<std::uint8_t>(code >> 8), error_register, 0, 0, 0, 0, 0});
}

void SimDrive::probe_edge(unsigned number) { probe_edge(number, std::lround(axis_[number].plant.position)); }

void SimDrive::probe_edge(unsigned number, long place) {
  Axis& axis = axis_[number];
  if ((axis.probe_before & 0x11) != 0x11 || axis.probe_stored) return;
  axis.probe_stored = true;
  axis.probe_position = static_cast<std::int32_t>(place);
}

}  // namespace nc::test
