// SPDX-License-Identifier: Apache-2.0
// A bus that carries points only (field I/O): the interface of a Modbus link or a bank of GPIO lines to the scan.
// There may be several of them beside the one Hal that carries the axes (hal/composite.hpp).
//
// read() and write() are NC_RT and exchange data with the bus's own thread through memory. A bus reads and writes
// only its own points, which are those whose Point::bus is its number.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "hal/points.hpp"

namespace nc::hal {

// A skip signal of a bus that notes the times of edges.
struct ProbeSeen {
  std::uint8_t system = 0, signal = 0;  // signal: bit of SystemFeedback::skip
  bool on = false;                      // level of the signal
  bool edge = false;                    // it has come since the read() before, though it may be off again
  std::int64_t edge_ns = 0;             // with `edge`: when it came first since then, in nanoseconds of CLOCK_MONOTONIC; 0 = not known
};

class PointBus {
 public:
  virtual ~PointBus() = default;
  // Called before the first scan, in an ordinary thread. A bus whose partner does not answer yet starts all the same:
  // its points are not good until it answers. False with a sentence in *error only for an error that waiting does not cure.
  virtual bool start(const PointImage& initial, std::string* error) = 0;
  // Copies the inputs of this bus, and the quality of its points, into the image. NC_RT.
  virtual void read(PointImage* image) noexcept = 0;
  // The skip signals as the last read() has found them, always as many of them and in the same order. NC_RT.
  virtual std::span<const ProbeSeen> probes() const noexcept { return {}; }
  // Takes the outputs of this bus from the image. NC_RT.
  virtual void write(const PointImage& image) noexcept = 0;
  // False while outputs that keep their value from one control to the next have not been read back. Any thread.
  virtual bool held_outputs_known() const { return true; }
  // Called after the last scan: sets the outputs to their safe values and ends the threads.
  virtual void stop() noexcept = 0;
};

}  // namespace nc::hal
