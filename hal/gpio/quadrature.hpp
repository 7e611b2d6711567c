// SPDX-License-Identifier: Apache-2.0
// The count of an encoder with two lines in quadrature. A leads B in the direction that counts up. A change of both lines at once, and an edge that was lost,
// say no direction: they are faults, and the count stays.
#pragma once

#include <cstdint>

namespace nc::hal::gpio {

class Quadrature {
 public:
  // `counts`: for each period of the lines, 1, 2 or 4. `bits`: 1 to 32.
  Quadrature(unsigned counts, unsigned bits) : divisor_(4 / counts), mask_(bits >= 32 ? 0xffffffffu : (1u << bits) - 1) {}

  // The levels of the lines, without a way: it counts on from here.
  void begin(bool a, bool b) {
    const unsigned now = place_of(a, b);
    if (begun_) turn_phase((now - state_) & 3);
    begun_ = true;
    state_ = now;
  }
  // Levels behind an edge.
  void step(bool a, bool b) {
    const unsigned now = place_of(a, b), way = (now - state_) & 3;
    state_ = now;
    if (way == 2) {
      turn_phase(way);
      return fault();
    }
    if (way != 0) quarters_ += way == 1 ? 1 : -1;
  }
  void fault() { ++faults_; }

  // A standstill of the lines, as between two detents of a handwheel, is amid a count and not at its end, so that a wheel that trembles there does not count.
  std::uint32_t count() const {
    const std::int64_t moved = quarters_ + divisor_ / 2;
    const std::int64_t whole = moved >= 0 ? moved / divisor_ : -((-moved + divisor_ - 1) / divisor_);
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(whole)) & mask_;
  }
  std::uint32_t faults() const { return faults_; }

 private:
  // The lines have another phase, by a way that nobody knows. The count stays, and the place within it is that of the phase: else the standstill between two detents would
  // from here on be at the end of a count.
  void turn_phase(unsigned by) {
    const std::int64_t within = ((quarters_ + divisor_ / 2) % divisor_ + divisor_) % divisor_;
    quarters_ += (within + by) % divisor_ - within;
  }

  // 00, 10, 11, 01 of A and B become 0, 1, 2, 3.
  static unsigned place_of(bool a, bool b) { return b ? (a ? 2 : 3) : (a ? 1 : 0); }

  std::int64_t divisor_;
  std::uint32_t mask_;
  std::int64_t quarters_ = 0;
  unsigned state_ = 0;
  bool begun_ = false;
  std::uint32_t faults_ = 0;
};

}  // namespace nc::hal::gpio
