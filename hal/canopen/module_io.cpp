// SPDX-License-Identifier: Apache-2.0
// The inputs and outputs of one CiA 401 module at run time. See module_io.hpp.
#include "hal/canopen/module_io.hpp"

#include <algorithm>

namespace nc::hal::canopen {

ModuleIo::ModuleIo(const NodeMap& node, unsigned lost_after) : module_(*node.module), lost_after_(lost_after) {
  for (const ModulePdo& pdo : module_pdos(module_, false))
    sends_[pdo.number - 1] = {static_cast<std::uint16_t>(kTpdoId + kPdoStep * (pdo.number - 1) + node.id), pdo.bytes, 0, false};
  for (const ModulePdo& pdo : module_pdos(module_, true))
    takes_[pdo.number - 1] = {static_cast<std::uint16_t>(kRpdoId + kPdoStep * (pdo.number - 1) + node.id), pdo.bytes, 0, false};
  for (const IoPoint& point : module_.points)
    if (point.output) set(&stop_, point, point.stop_value);
}

void ModuleIo::set(Channels* channels, const IoPoint& point, std::uint32_t value) const noexcept {
  if (point.analog) {
    channels->analog[point.channel] = static_cast<std::int16_t>(std::clamp(static_cast<std::int32_t>(value), -32768, 32767));
    return;
  }
  const std::uint64_t bit = std::uint64_t{1} << point.channel;
  channels->digital = (value != 0) != point.active_low ? channels->digital | bit : channels->digital & ~bit;
}

std::uint32_t ModuleIo::get(const Channels& channels, const IoPoint& point) const noexcept {
  if (point.analog) return static_cast<std::uint32_t>(static_cast<std::int32_t>(channels.analog[point.channel]));
  return ((channels.digital >> point.channel & 1u) != 0) != point.active_low ? 1 : 0;
}

// ---- bus's thread ----

ModuleIo::Taken ModuleIo::take(const CanFrame& frame, bool operational) noexcept {
  for (unsigned n = 0; n < kModulePdos; ++n) {
    Pdo& pdo = sends_[n];
    if (pdo.bytes == 0 || pdo.id != frame.id) continue;
    if (frame.length < pdo.bytes) return Taken::kStrange;
    if (!operational) return Taken::kTaken;
    if (n == 0) {
      in_.digital = 0;
      for (unsigned byte = 0; byte < pdo.bytes; ++byte) in_.digital |= std::uint64_t{frame.data[byte]} << 8 * byte;
    } else {
      for (unsigned word = 0; word < pdo.bytes / 2; ++word)
        in_.analog[kAnalogPerPdo * (n - 1) + word] = static_cast<std::int16_t>(get_le(frame.data + 2 * word, 2));
    }
    pdo.silent = 0;
    pdo.come = true;
    return Taken::kTaken;
  }
  return Taken::kNotMine;
}

bool ModuleIo::sync(bool operational) noexcept {
  bool complete = operational, lost = false;
  for (Pdo& pdo : sends_) {
    if (operational && !was_operational_) pdo.silent = 0, pdo.come = false;
    if (pdo.bytes == 0 || !operational) continue;
    lost |= ++pdo.silent > lost_after_ * module_.every;
    complete &= pdo.come;
  }
  due_ = operational && (!was_operational_ || ++count_ >= module_.every);
  if (due_) count_ = 0;
  was_operational_ = operational && !lost;
  outputs_.take();
  const bool ending = ending_.load(std::memory_order_acquire);
  out_ = ending ? stop_ : outputs_.front();
  ended_syncs_ = !ending ? 0 : ended_syncs_ + (due_ || !operational ? 1 : 0);
  if (ended_syncs_ > 1) ended_.store(true, std::memory_order_release);  // what was due with the SYNC before has been sent
  shown_.back() = {in_, complete && !lost};
  shown_.publish();
  return !lost;
}

CanFrame ModuleIo::frame_of(unsigned pdo) const noexcept {
  CanFrame frame;
  frame.id = takes_[pdo].id;
  frame.length = static_cast<std::uint8_t>(takes_[pdo].bytes);
  for (unsigned byte = 0; pdo == 0 && byte < takes_[pdo].bytes; ++byte) frame.data[byte] = static_cast<std::uint8_t>(out_.digital >> 8 * byte);
  for (unsigned word = 0; pdo > 0 && word < takes_[pdo].bytes / 2; ++word)
    put_le(frame.data + 2 * word, 2, static_cast<std::uint16_t>(out_.analog[kAnalogPerPdo * (pdo - 1) + word]));
  return frame;
}

// ---- scan ----

void ModuleIo::begin(const PointImage& initial) noexcept {
  ending_.store(false, std::memory_order_release);
  ended_.store(false, std::memory_order_release);
  write(initial);
}

void ModuleIo::read(PointImage* image) noexcept {
  shown_.take();
  const Shown& shown = shown_.front();
  const std::uint8_t good = shown.ok ? 1 : 0;
  for (const IoPoint& point : module_.points) {
    image->good[point.point] = good;
    if (point.output) continue;
    if (shown.ok) image->value[point.point] = get(shown.in, point);
    else if (!point.hold_on_loss) image->value[point.point] = point.loss_value;
  }
  image->value[module_.ok_point] = good;
  image->good[module_.ok_point] = 1;
}

void ModuleIo::write(const PointImage& image) noexcept {
  Channels& out = outputs_.back();
  out = {};
  for (const IoPoint& point : module_.points)
    if (point.output) set(&out, point, image.value[point.point]);
  outputs_.publish();
}

}  // namespace nc::hal::canopen
