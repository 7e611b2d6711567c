// SPDX-License-Identifier: Apache-2.0
#include "interpret/checkpoints.hpp"

#include <cstddef>
#include <cstring>

namespace nc {
namespace {

// What is kept of a state, in this order: its values, the call stack up to the last frame in use, the loops in use, and the modes in execution where they
// are not those of the values.
constexpr size_t kDepth = sizeof(StateValues) + offsetof(CallStack, depth);
constexpr size_t kFrames = sizeof(StateValues) + offsetof(CallStack, frame);

/// Bytes of the state up to the end of the last frame in use; the loops in use follow, and behind them the modes in execution.
uint32_t head_size(const State& state) { return static_cast<uint32_t>(kFrames + (state.depth + 1u) * sizeof(CallFrame)); }
uint32_t loops_size(const State& state) { return static_cast<uint32_t>(state.loop_count * sizeof(Loop)); }
uint32_t modes_size(const State& state) { return state.modes_ahead ? sizeof state.executed : 0; }

constexpr uint32_t kOrdinary = 736;  // bytes of a state with the main program and one or two further levels

}  // namespace

void Checkpoints::create(unsigned count, Arena& arena) {
  capacity_ = count * kOrdinary;
  if (capacity_ < 16 * sizeof(State)) capacity_ = 16 * sizeof(State);
  entries_ = arena.make<Entry>(count);
  bytes_ = arena.make_blank<char>(capacity_);
  mask_ = count - 1;
}

bool Checkpoints::call(unsigned file) const {
  for (BlockSeq seq = oldest_; seq < next_; ++seq) {
    const char* const kept = bytes_ + entry(seq).begin;
    uint8_t depth = 0;
    std::memcpy(&depth, kept + kDepth, sizeof depth);
    for (unsigned level = 0; level <= depth; ++level) {
      uint16_t program = 0;
      std::memcpy(&program, kept + kFrames + level * sizeof(CallFrame) + offsetof(CallFrame, program) + offsetof(ProgramRef, file),
                  sizeof program);
      if (program == file) return true;
    }
  }
  return false;
}

void Checkpoints::clear() { oldest_ = next_ = 0; }

void Checkpoints::save(const State& state) {
  const BlockSeq seq = state.seq;
  if (next_ == oldest_ || seq > next_ || seq < oldest_) {
    oldest_ = next_ = seq;  // the kept states do not lead up to this one
  } else {
    next_ = seq;
  }
  const uint32_t head = head_size(state), loops = loops_size(state), modes = modes_size(state), size = head + loops + modes;
  uint32_t begin = next_ > oldest_ ? entry(next_ - 1).end : 0;
  if (begin + size > capacity_) {
    // The ring begins again: states that lie between the last state and the end of the ring are given up first.
    while (oldest_ < next_ && entry(oldest_).begin >= begin) ++oldest_;
    begin = 0;
  }
  // Entries lie in their order, so those that are in the way are the oldest ones.
  while (oldest_ < next_ && (next_ - oldest_ > mask_ || (entry(oldest_).begin < begin + size && entry(oldest_).end > begin))) ++oldest_;
  std::memcpy(bytes_ + begin, static_cast<const void*>(&state), head);
  if (loops != 0) std::memcpy(bytes_ + begin + head, state.loop, loops);
  if (modes != 0) std::memcpy(bytes_ + begin + head + loops, static_cast<const void*>(&state.executed), modes);
  entry(seq) = Entry{begin, begin + size};
  next_ = seq + 1;
}

bool Checkpoints::keeps(BlockSeq seq) const {
  constexpr uint32_t kStates = 4;  // the most states that one block saves: a program that it calls begins with its own state
  constexpr uint32_t kRoom = kStates * sizeof(State);
  if (!holds(seq) || next_ - seq + kStates > mask_) return false;
  const uint32_t begin = entry(seq).begin, end = entry(next_ - 1).end;
  return begin >= end ? begin - end >= kRoom : begin >= kRoom || capacity_ - end >= kRoom;
}

void Checkpoints::values(BlockSeq seq, StateValues* out) const { std::memcpy(static_cast<void*>(out), bytes_ + entry(seq).begin, sizeof(StateValues)); }

bool Checkpoints::frames(BlockSeq seq, unsigned count, CallFrame* out) const {
  const char* const kept = bytes_ + entry(seq).begin;
  uint8_t depth = 0;
  std::memcpy(&depth, kept + kDepth, sizeof depth);
  if (depth + 1u < count) return false;
  std::memcpy(static_cast<void*>(out), kept + kFrames, count * sizeof(CallFrame));
  return true;
}

void Checkpoints::restore(BlockSeq seq, State* state) {
  const Entry& e = entry(seq);
  // The fixed part tells how many frames are in use.
  std::memcpy(static_cast<void*>(state), bytes_ + e.begin, kFrames);
  const uint32_t head = head_size(*state);
  std::memcpy(static_cast<void*>(state), bytes_ + e.begin, head);
  const uint32_t loops = loops_size(*state), modes = modes_size(*state);
  std::memcpy(state->loop, bytes_ + e.begin + head, loops);
  if (modes != 0) std::memcpy(static_cast<void*>(&state->executed), bytes_ + e.begin + head + loops, modes);
  else state->executed = state->modal;
  next_ = seq + 1;
}

}  // namespace nc
