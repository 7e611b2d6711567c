// SPDX-License-Identifier: Apache-2.0
#include "ladder/families.hpp"

#include <charconv>

namespace nc::ladder {

Layout make_layout(const DeviceTable& table, std::uint32_t edges, std::uint32_t loops) {
  Layout at{};
  std::uint32_t bit = table.bits(), word = table.words();
  const auto take = [](std::uint32_t* next, std::uint32_t count) {
    const std::uint32_t first = *next;
    *next += count;
    return first;
  };
  at.sm = take(&bit, kSm);
  at.m = take(&bit, kM);
  at.l = take(&bit, kL);
  at.timer = take(&bit, kAllTimers);
  at.timer_on = take(&bit, kAllTimers);
  at.counter = take(&bit, kCounters);
  at.counter_on = take(&bit, kCounters);
  at.started = take(&bit, 1);
  at.edges = take(&bit, edges);
  at.bits = bit;
  at.d = take(&word, kD);
  at.z = take(&word, kZ);
  at.sd = take(&word, kSd);
  at.timer_value = take(&word, kAllTimers);
  at.counter_value = take(&word, kCounters);
  at.timer_rest = take(&word, 2 * kAllTimers);
  at.clock = take(&word, 4);
  at.loops = take(&word, 2 * loops);
  at.words = word;
  return at;
}

namespace {

struct Family {
  std::string_view name;
  Kind kind;
  std::uint32_t count;
  std::uint32_t Layout::*where;  // first contact, relay or register
  std::uint32_t Layout::*value;  // first current value
  std::uint32_t offset;          // ST comes after T in the same arrays: number of its first timer
  bool writable;
};

constexpr Family kFamilies[] = {
    {"M", Kind::kRelay, kM, &Layout::m, nullptr, 0, true},
    {"L", Kind::kRelay, kL, &Layout::l, nullptr, 0, true},
    {"SM", Kind::kRelay, kSm, &Layout::sm, nullptr, 0, false},
    {"T", Kind::kTimer, kTimers, &Layout::timer, &Layout::timer_value, 0, false},
    {"ST", Kind::kTimer, kRetentive, &Layout::timer, &Layout::timer_value, kTimers, false},
    {"C", Kind::kCounter, kCounters, &Layout::counter, &Layout::counter_value, 0, false},
    {"TS", Kind::kContact, kTimers, &Layout::timer, nullptr, 0, false},
    {"STS", Kind::kContact, kRetentive, &Layout::timer, nullptr, kTimers, false},
    {"CS", Kind::kContact, kCounters, &Layout::counter, nullptr, 0, false},
    {"TN", Kind::kCurrentValue, kTimers, &Layout::timer_value, nullptr, 0, true},
    {"STN", Kind::kCurrentValue, kRetentive, &Layout::timer_value, nullptr, kTimers, true},
    {"CN", Kind::kCurrentValue, kCounters, &Layout::counter_value, nullptr, 0, true},
    {"D", Kind::kRegister, kD, &Layout::d, nullptr, 0, true},
    {"Z", Kind::kRegister, kZ, &Layout::z, nullptr, 0, true},
    {"SD", Kind::kRegister, kSd, &Layout::sd, nullptr, 0, true},
};

// The program may reset the error relay and the carry; the other special relays belong to the engine.
bool writable_sm(std::uint32_t number) {
  return number == kSmError || number == kSmCarry;
}
bool existing_sm(std::uint32_t number) {
  return writable_sm(number) || (number >= kSmOn && number <= kSmNotFirst) ||
         (number >= kSmClock && number < kSmClock + 4);
}

}  // namespace

std::optional<Place> internal_device(std::string_view name, const Layout& layout, std::string* message) {
  const std::size_t digits = name.find_first_of("0123456789");
  if (digits == std::string_view::npos || digits == 0) return std::nullopt;
  for (const Family& family : kFamilies) {
    if (name.substr(0, digits) != family.name) continue;
    std::uint32_t number = 0;
    const char* last = name.data() + name.size();
    const auto [end, error] = std::from_chars(name.data() + digits, last, number);
    if (end != last) return std::nullopt;
    const std::string letter(family.name);
    if (error != std::errc() || number >= family.count) {
      message->assign("no such device: ").append(letter).append("0 to ").append(letter).append(std::to_string(family.count - 1));
      return std::nullopt;
    }
    if (family.name == "SM" && !existing_sm(number)) {
      *message = "no such device: SM0, SM400 to SM403, SM410 to SM413, SM700";
      return std::nullopt;
    }
    Place place;
    place.kind = family.kind;
    place.family = family.name;
    place.writable = family.name == "SM" ? writable_sm(number) : family.writable;
    place.type = family.kind == Kind::kRegister || family.kind == Kind::kCurrentValue ? DeviceType::kWord16
                                                                                      : DeviceType::kBit;
    place.pairs = family.kind == Kind::kRegister && family.name != "SD";
    place.number = number + family.offset;
    place.first = layout.*family.where + family.offset;
    place.end = place.first + family.count;
    place.index = place.first + number;
    if (family.value != nullptr) place.value = layout.*family.value + place.number;
    return place;
  }
  return std::nullopt;
}

Place named_device(const Device& device) {
  Place place;
  place.type = device.type;
  place.writable = device.writable;
  place.index = place.first = device.index;
  place.end = device.index + (device.type == DeviceType::kWord32 ? 2 : 1);
  return place;
}

}  // namespace nc::ladder
