// SPDX-License-Identifier: Apache-2.0
// Forced devices. See force_table.hpp.
#include "runtime/force_table.hpp"

namespace nc::rt {

ForceTable::ForceTable() : places_(std::make_unique<Place[]>(kMaxNames)) {}

std::int64_t ForceTable::number_of(const std::string& name, const ladder::Device& device, int point, bool output) {
  const std::lock_guard lock(mutex_);
  for (std::size_t n = 0; n < names_; ++n)  // an alias gets the number of its device
    if (places_[n].index == device.index && (places_[n].type == ladder::DeviceType::kBit) == (device.type == ladder::DeviceType::kBit))
      return static_cast<std::int64_t>(n);
  if (names_ == kMaxNames) return -1;
  places_[names_] = {device.type, output, device.index, point, name};
  return static_cast<std::int64_t>(names_++);
}

std::string ForceTable::name_of(std::uint32_t number) const {
  const std::lock_guard lock(mutex_);
  return number < names_ ? places_[number].name : std::string();
}

bool ForceTable::fits(ladder::DeviceType type, std::int64_t value) {
  switch (type) {
    case ladder::DeviceType::kBit:
      return value == 0 || value == 1;
    case ladder::DeviceType::kWord16:
      return value >= -32768 && value <= 65535;
    case ladder::DeviceType::kWord32:
      return value >= -2147483648LL && value <= 4294967295LL;
  }
  return false;
}

Answer ForceTable::force(std::uint32_t number, std::int32_t value) noexcept {
  if (number >= kMaxNames) return Answer::kNoDevice;
  if (places_[number].type == ladder::DeviceType::kWord16) value = static_cast<std::int16_t>(value);
  for (unsigned i = 0; i < count_; ++i) {
    if (active_[i].number != number) continue;
    active_[i].value = value;
    return Answer::kDone;
  }
  if (count_ == kMaxForces) return Answer::kTooManyForces;
  active_[count_++] = {number, value, 0, false};
  return Answer::kDone;
}

// Releasing a device that is not forced is no error: afterwards the device is free, as was asked for.
Answer ForceTable::release(std::uint32_t number) noexcept {
  for (unsigned i = count_; i-- > 0;)
    if (number == kAllForces || active_[i].number == number) free(i);
  return Answer::kDone;
}

// A device that is written is treated as one that is released and had this value before.
Answer ForceTable::write(std::uint32_t number, std::int32_t value) noexcept {
  if (number >= kMaxNames) return Answer::kNoDevice;
  for (unsigned i = 0; i < count_; ++i)
    if (active_[i].number == number) return Answer::kForced;
  if (freed_ == released_.size()) return Answer::kQueueFull;
  released_[freed_++] = {number, 0, value, true};
  return Answer::kDone;
}

void ForceTable::free(unsigned place) noexcept {
  const Active gone = active_[place];
  active_[place] = active_[--count_];
  if (gone.begun && freed_ < released_.size()) released_[freed_++] = gone;  // no place is left: the device keeps the forced value
}

void ForceTable::begin(ladder::DeviceImage* image, hal::PointImage* points) noexcept {
  for (unsigned i = 0; i < freed_; ++i) {
    const Place& place = places_[released_[i].number];
    image->set_value(place.type, place.index, released_[i].before);
    if (place.point >= 0 && place.output) points->value[place.point] = static_cast<std::uint32_t>(released_[i].before);
  }
  freed_ = 0;
  for (unsigned i = 0; i < count_; ++i) {
    if (active_[i].begun) continue;
    const Place& place = places_[active_[i].number];
    active_[i].before = image->value(place.type, place.index);
    active_[i].begun = true;
  }
}

void ForceTable::hold_points(hal::PointImage* points, bool outputs) const noexcept {
  for (unsigned i = 0; i < count_; ++i) {
    const Place& place = places_[active_[i].number];
    if (place.point >= 0 && place.output == outputs)
      points->value[place.point] = static_cast<std::uint32_t>(active_[i].value);
  }
}

void ForceTable::hold_devices(ladder::DeviceImage* image) const noexcept {
  for (unsigned i = 0; i < count_; ++i) {
    const Place& place = places_[active_[i].number];
    image->set_value(place.type, place.index, active_[i].value);
  }
}

const ladder::Hold* ForceTable::holds(unsigned* count) noexcept {
  for (unsigned i = 0; i < count_; ++i) {
    const Place& place = places_[active_[i].number];
    holds_[i] = {place.type, place.index, active_[i].value};
  }
  *count = count_;
  return holds_.data();
}

void ForceTable::list(ForceList* list) const noexcept {
  list->count = count_;
  for (unsigned i = 0; i < count_; ++i) list->device[i] = {active_[i].number, active_[i].value};
}

}  // namespace nc::rt
