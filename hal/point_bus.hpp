// SPDX-License-Identifier: Apache-2.0
// A bus that carries points only (field I/O): what a link of Modbus, or a bank of GPIO lines, is to the scan.
// Several of them stand beside the one Hal that carries the axes (hal/composite.hpp).
//
// read() and write() are NC_RT and exchange with the bus's own thread through memory. A bus owns the points
// whose Point::bus is its number: it reads and writes no others.
#pragma once

#include <string>

#include "hal/points.hpp"

namespace nc::hal {

class PointBus {
 public:
  virtual ~PointBus() = default;
  // Before the first scan, in an ordinary thread. A bus whose partner does not answer yet starts all the same:
  // its points are not good until it does. False with a sentence in *error only for what cannot heal by itself.
  virtual bool start(const PointImage& initial, std::string* error) = 0;
  // Inputs of this bus into the image, with their quality. NC_RT.
  virtual void read(PointImage* image) noexcept = 0;
  // Outputs of this bus out of the image. NC_RT.
  virtual void write(const PointImage& image) noexcept = 0;
  // False while outputs that keep their value from one control to the next have not been read back. Any thread.
  virtual bool held_outputs_known() const { return true; }
  // After the last scan: outputs to their safe values, threads ended.
  virtual void stop() noexcept = 0;
};

}  // namespace nc::hal
