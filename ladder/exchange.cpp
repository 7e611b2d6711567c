// SPDX-License-Identifier: Apache-2.0
// See exchange.hpp.
#include "ladder/exchange.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <utility>

#include "ladder/code.hpp"

namespace nc::ladder {
namespace {

bool same_devices(const Code& from, const Code& to) {
  const std::vector<Device>&a = from.table.all(), &b = to.table.all();
  return from.scan_ns == to.scan_ns && from.retain_counters == to.retain_counters && from.retained_d.first == to.retained_d.first && from.retained_d.count == to.retained_d.count &&
         std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Device& l, const Device& r) { return l.name == r.name && l.type == r.type && l.writable == r.writable && l.index == r.index; });
}

std::string timer_name(std::uint32_t number) { return number < kTimers ? "T" + std::to_string(number) : "ST" + std::to_string(number - kTimers); }

std::string unit_text(std::uint32_t unit_us) { return std::to_string(unit_us / 1000) + " ms"; }

// The value of a timer counts the unit of its coil. "" = all timers of both programs count the same.
std::string other_unit(const Code& from, const Code& to) {
  std::map<std::uint32_t, TimerCoil> known;
  for (const TimerCoil& coil : from.timer_coils) known.emplace(coil.number, coil);
  for (const auto* coils : {&from.timer_coils, &to.timer_coils})
    for (const TimerCoil& coil : *coils) {
      const auto other = known.find(coil.number);
      if (other == known.end() || other->second.unit_us == coil.unit_us) continue;
      const bool old = coils == &from.timer_coils;  // one with two units in the program that runs: its value means nothing to any other
      return timer_name(coil.number) + " counts " + unit_text(coil.unit_us) + " in line " + std::to_string(coil.line) + (old ? " of the program that runs" : "") + " and " +
             unit_text(other->second.unit_us) + " in line " + std::to_string(other->second.line) + " of the program that runs: its value would be another time. Take another timer";
    }
  return "";
}

// What says that an instruction of one program is that of another one: a key, and for one that may be passed over in a scan its place in the flow, too.
using Identity = std::pair<std::uint64_t, std::uint64_t>;
constexpr std::uint64_t kAlways = ~std::uint64_t{0};
using Known = std::map<Identity, std::vector<std::uint32_t>>;

// The memories that are not in `done`, by one of their keys.
Known memories_of(const Code& code, std::uint64_t Memory::*key, bool same_flow, const std::vector<bool>& done) {
  Known found;
  for (const Memory& memory : code.memories)
    if ((memory.always || same_flow) && !done[memory.bit]) found[{memory.*key, memory.always ? kAlways : memory.area}].push_back(memory.bit);
  return found;
}

}  // namespace

bool Exchange::prepare(const Program& from_program, const Program& to_program, std::string* reason) {
  const Code &from = *from_program.code(), &to = *to_program.code();
  *reason = same_devices(from, to) ? other_unit(from, to) : "the programs are not of one machine";
  if (!reason->empty()) return false;
  bits_ = to.layout.edges;
  words_ = to.layout.loops;
  known_.clear(), unknown_.clear(), left_.clear();
  const bool same_flow = from.flow_key == to.flow_key;
  std::vector<bool> done_from(from.layout.bits, false), done_to(to.layout.bits, false);
  // First those of rungs that are the same from their beginning to their end, then those of rungs that are the same up to the instruction.
  for (const auto key : {&Memory::rung_key, &Memory::key}) {
    const Known before = memories_of(from, key, same_flow, done_from), after = memories_of(to, key, same_flow, done_to);
    for (const auto& [identity, bits] : after) {
      const auto same = before.find(identity);
      if (same == before.end() || same->second.size() != bits.size()) continue;  // which of them is which nobody can say
      for (std::size_t i = 0; i < bits.size(); ++i) {
        known_.push_back({same->second[i], bits[i]});
        done_from[same->second[i]] = done_to[bits[i]] = true;
      }
    }
  }
  for (const Memory& memory : to.memories)
    if (memory.bit < to.layout.edges && !done_to[memory.bit]) unknown_.push_back(memory.bit);
  for (const Device& device : from.table.all()) {
    const std::vector<bool>&was = device.type == DeviceType::kBit ? from.bits_written : from.words_written, &is = device.type == DeviceType::kBit ? to.bits_written : to.words_written;
    if (was[device.index] && !is[device.index]) left_.push_back(device);
  }
  return true;
}

void Exchange::carry(const DeviceImage& from, DeviceImage* to) const noexcept {
  std::memcpy(to->bit.data(), from.bit.data(), bits_);
  std::memcpy(to->word.data(), from.word.data(), words_ * sizeof(std::int16_t));
  for (const Pair& pair : known_) to->bit[pair.to] = from.bit[pair.from];
  for (const std::uint32_t bit : unknown_) to->bit[bit] = kEdgeUnknown;
}

}  // namespace nc::ladder
