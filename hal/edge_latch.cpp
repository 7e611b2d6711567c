// SPDX-License-Identifier: Apache-2.0
// Skip signals with the times of their edges. See edge_latch.hpp.
#include "hal/edge_latch.hpp"

namespace nc::hal {
namespace {

constexpr unsigned kMostScans = 20;  // so long a signal waits for the place of its edge, as it has to for the drives of a bus

}  // namespace

void EdgeLatch::begin(std::int64_t now_ns, const Feedback& feedback) noexcept {
  for (unsigned s = 0; s < NC_MAX_SYSTEMS; ++s) {
    System& system = system_[s];
    const SystemFeedback& machine = feedback.system[s];
    system.latched_ns = 0;
    if (feedback.lost) system.track.clear();
    else if (machine.actual_valid) system.track.note(machine.actual_ns != 0 ? machine.actual_ns : now_ns, machine.actual);
    else if (system.known) system.track.note(now_ns, system.commanded);
  }
}

void EdgeLatch::commanded(const Command& command) noexcept {
  for (unsigned s = 0; s < NC_MAX_SYSTEMS; ++s) {
    system_[s].commanded = command.system[s].position;
    system_[s].known = true;
  }
}

// Of several edges before the signal is given the first one counts: those behind it are the bouncing of a contact.
void EdgeLatch::add(std::size_t index, const ProbeSeen& seen, Feedback* feedback) noexcept {
  Waiting& waiting = waiting_[index];
  SystemFeedback& out = feedback->system[seen.system];
  const std::uint32_t signal = 1u << seen.signal;
  if (seen.edge && !waiting.on) waiting = {true, seen.edge_ns, 0};
  if (!waiting.on) {
    if (seen.on) out.skip |= signal;
    return;
  }
  nc_axes place{};
  const auto found = waiting.edge_ns == 0 ? PlaceTrack::Found::kTooOld : system_[seen.system].track.at(waiting.edge_ns, &place);
  if (found == PlaceTrack::Found::kNotYet && ++waiting.scans < kMostScans) return;
  waiting.on = false;
  out.skip |= signal;
  if (found == PlaceTrack::Found::kYes) latch(seen.system, signal, waiting.edge_ns, place, &out);
}

// A part system has one skip position in a scan: that of a probe of the machine's own, or else that of the earliest edge. Signals with another place have the
// measured one.
void EdgeLatch::latch(unsigned system, std::uint32_t signal, std::int64_t edge_ns, const nc_axes& place, SystemFeedback* out) noexcept {
  std::int64_t& latched_ns = system_[system].latched_ns;
  if (latched_ns == 0 ? out->skip_latched != 0 : latched_ns <= edge_ns) return;
  latched_ns = edge_ns;
  out->skip_latched = signal;
  out->skip_place = place;
}

}  // namespace nc::hal
