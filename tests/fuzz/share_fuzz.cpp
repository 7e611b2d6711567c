// SPDX-License-Identifier: Apache-2.0
// Any bytes in the blocks, the description and the rings of a shared-memory segment, as a reader sees them after the door. What the reader passes
// on has counts in their range and texts that end; a refusal has a sentence; a ring gives no more than it holds.
#include <unistd.h>

#include <memory>

#include "fuzz/input.hpp"
#include "runtime/share/segment.hpp"
#include "runtime/share/text.hpp"

namespace {

using namespace nc::rt::share;
using nc::fuzz::Bytes;
using nc::fuzz::require;

constexpr unsigned kSystems = 2, kPoints = 5, kSignals = 4;

std::unique_ptr<MachineBlock> machine_block() {
  auto machine = std::make_unique<MachineBlock>();
  set_text(&machine->machine, "fuzz mill");
  machine->system_count = kSystems;
  machine->axis_count = {3, 2, 0, 0};
  machine->point_count = kPoints;
  machine->signal_count = kSignals;
  return machine;
}

/// One segment for all inputs, behind a real door, and its reader.
struct Shared {
  std::unique_ptr<MachineBlock> machine = machine_block();
  SegmentOwner owner;
  SegmentReader reader;
  std::string name = "fuzz-" + std::to_string(getpid());
  Shared() {
    std::string error;
    require(owner.create(name, false, true, *machine, &error));
    owner.get()->life.store(static_cast<std::uint32_t>(Life::kAlive));
    require(reader.open(name, &error));
  }
};

/// Overwrites some bytes of `block`, mostly near its beginning, where the counts are.
template <class T>
void damage(T* block, Bytes* in) {
  auto* bytes = reinterpret_cast<unsigned char*>(block);
  for (unsigned patches = 1 + in->byte() % 8; patches > 0 && !in->empty(); --patches) {
    const std::size_t at = in->value<std::uint32_t>() % sizeof(T);
    const unsigned length = 1 + in->byte() % 16;
    const unsigned repeat = 1 + in->byte() % 64;
    const std::string pattern = in->text(length);
    for (std::size_t i = 0; i < pattern.size() * repeat && at + i < sizeof(T); ++i)
      bytes[at + i] = static_cast<unsigned char>(pattern[i % pattern.size()]);
  }
}

void require_entry(const Entry& entry) {
  require(is_ended(entry.code) && is_ended(entry.axis) && is_ended(entry.text) && entry.system < NC_MAX_SYSTEMS);
}

void require_status(const StatusBlock& block) {
  require(block.system_count == kSystems && block.alarm_count <= kAlarms && block.forced_count <= kForced);
  for (unsigned i = 0; i < block.alarm_count; ++i) require_entry(block.alarm[i]);
  for (unsigned i = 0; i < block.forced_count; ++i) require(is_ended(block.forced[i].device));
  for (unsigned s = 0; s < kSystems; ++s) {
    const SystemStatus& system = block.system[s];
    require(system.axis_count <= NC_MAX_AXES);
    require(is_ended(system.state_text) && is_ended(system.modal) && is_ended(system.program) && is_ended(system.file));
    require(is_ended(system.block) && is_ended(system.refusal_text));
  }
}

void read_status(Shared* shared, Bytes* in) {
  auto block = std::make_unique<StatusBlock>();
  block->system_count = kSystems;
  damage(block.get(), in);
  shared->owner.get()->status.store(*block);
  std::string error;
  auto seen = std::make_unique<StatusBlock>();
  if (shared->reader.status(seen.get(), &error)) require_status(*seen);
  else require(!error.empty() && seen->system_count == 0 && seen->alarm_count == 0 && seen->forced_count == 0);
}

void read_history(Shared* shared, Bytes* in) {
  auto block = std::make_unique<HistoryBlock>();
  const std::uint64_t first = in->byte() % 4 == 0 ? in->value<std::uint64_t>() : 1;
  const unsigned count = in->byte() * 2u;
  for (unsigned i = 0; i < count; ++i) {
    block->last_sequence = first + i;
    block->entry[(first + i - 1) % kHistory].sequence = first + i;
  }
  damage(block.get(), in);
  shared->owner.get()->history.store(*block);
  std::string error;
  auto seen = std::make_unique<HistoryBlock>();
  std::uint64_t sequence = 0;
  if (!shared->reader.history(seen.get(), &sequence, &error)) {
    require(!error.empty());
    return;
  }
  const std::uint64_t filled = std::min<std::uint64_t>(seen->last_sequence, kHistory);
  for (std::uint64_t i = 0; i < filled; ++i) {
    const Entry& entry = seen->entry[(seen->last_sequence - i - 1) % kHistory];
    require(entry.sequence == seen->last_sequence - i);
    require_entry(entry);
  }
}

void read_points_and_signals(Shared* shared, Bytes* in) {
  auto points = std::make_unique<PointsBlock>();
  points->count = kPoints;
  damage(points.get(), in);
  shared->owner.get()->points.store(*points);
  auto signals = std::make_unique<SignalsBlock>();
  signals->count = kSignals;
  damage(signals.get(), in);
  shared->owner.get()->signals.store(*signals);
  std::string error;
  if (shared->reader.points(points.get(), &error)) require(points->count <= nc::hal::kMaxPoints);
  else require(!error.empty());
  if (shared->reader.signals(signals.get(), &error)) require(signals->count <= kSignals);
  else require(!error.empty());
}

/// Damages the description and the identity before it: a reader that opens the door accepts them or says why not.
void open_again(Shared* shared, Bytes* in) {
  Segment& segment = *shared->owner.get();
  const Identity identity = segment.identity;
  if (in->byte() % 4 == 0) damage(&segment.identity, in);
  damage(&segment.machine, in);
  if (in->byte() % 8 != 0) segment.check = check_sum(segment);  // so that the reader looks further than the check sum
  SegmentReader reader;
  std::string error;
  if (reader.open(shared->name, &error)) {
    const MachineBlock& machine = reader.get()->machine;
    require(machine.system_count >= 1 && machine.system_count <= NC_MAX_SYSTEMS);
    require(machine.point_count <= nc::hal::kMaxPoints && machine.signal_count <= kMaxSignals);
    require(is_ended(machine.machine) && is_ended(machine.share) && is_ended(machine.version));
    for (unsigned s = 0; s < NC_MAX_SYSTEMS; ++s) require(machine.axis_count[s] <= NC_MAX_AXES);
    for (unsigned p = 0; p < machine.point_count; ++p) require(is_ended(machine.point[p].name) && is_ended(machine.point[p].meaning));
    for (unsigned i = 0; i < machine.signal_count; ++i) require(machine.signal[i].type <= 2 && is_ended(machine.signal[i].name));
  } else {
    require(!error.empty() && error.find('\n') == std::string::npos && !reader.is_open());
  }
  segment.identity = identity;
  segment.machine = *shared->machine;
  segment.check = check_sum(segment);
}

void empty_the_rings(Shared* shared, Bytes* in) {
  Segment& segment = *shared->owner.get();
  auto request = std::make_unique<Request>();
  Ack ack{};
  segment.commands.force(in->value<std::uint32_t>(), in->value<std::uint32_t>());
  segment.acks.force(in->value<std::uint32_t>(), in->value<std::uint32_t>());
  unsigned count = 0;
  while (segment.commands.pop(request.get())) require(++count <= kCommandRing);
  for (count = 0; segment.acks.pop(&ack);) require(++count <= kAckRing);
  require(segment.commands.size() == 0 && segment.acks.size() == 0);
  // After any nonsense the ring must work again.
  request->sequence = in->byte();
  require(segment.commands.push(*request));
  const std::uint64_t sequence = request->sequence;
  require(segment.commands.pop(request.get()) && request->sequence == sequence && !segment.commands.pop(request.get()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Shared shared;
  Bytes in(data, size);
  constexpr void (*kWays[])(Shared*, Bytes*) = {read_status, read_history, read_points_and_signals, open_again, empty_the_rings};
  kWays[in.byte() % std::size(kWays)](&shared, &in);
  return 0;
}
