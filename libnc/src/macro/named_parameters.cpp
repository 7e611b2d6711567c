// SPDX-License-Identifier: Apache-2.0
#include "macro/named_parameters.hpp"

#include <cstring>

namespace nc {

void NamedParameters::create(Arena& arena) {
  slot_ = arena.make<Slot>(kMost);
  for (unsigned i = 0; slot_ != nullptr && i < kMost; ++i) slot_[i] = Slot{};
}

bool NamedParameters::find(const char* name, size_t length, uint32_t* place) const {
  if (slot_ == nullptr || length == 0) return false;
  for (uint32_t i = 0; i < kMost; ++i) {
    if (slot_[i].length != length || std::memcmp(slot_[i].name, name, length) != 0) continue;
    *place = i;
    return true;
  }
  return false;
}

bool NamedParameters::make(const char* name, size_t length, uint32_t* place) {
  if (find(name, length, place)) return true;
  if (slot_ == nullptr || length == 0 || length > kLongest) return false;
  for (uint32_t i = 0; i < kMost; ++i) {
    if (slot_[i].length != 0) continue;
    slot_[i].length = static_cast<uint8_t>(length);
    std::memcpy(slot_[i].name, name, length);
    slot_[i].value = Value{};
    *place = i;
    return true;
  }
  return false;
}

void NamedParameters::forget_program() {
  for (unsigned i = 0; slot_ != nullptr && i < kMost; ++i)
    if (slot_[i].length != 0 && slot_[i].name[0] != '_') slot_[i] = Slot{};
}

}  // namespace nc
