// SPDX-License-Identifier: Apache-2.0
// Path speed, and acceleration and jerk of every axis over time, from the positions of the cycles; as SVG and
// as PNG.
//
// All are finite differences of the commanded positions, so they are what a drive gets. Time is kept in at
// most kBuckets pieces with the lowest and the highest value of each: a peak of one cycle is drawn however
// long the program runs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "nc/nc.h"
#include "tools/lib/motion_writer.hpp"

namespace nc::tools {

class ProfilePlot {
 public:
  explicit ProfilePlot(const nc_config& config);
  void set_title(std::string title) { title_ = std::move(title); }

  /** Where the axes stand before the first cycle. */
  void begin(const nc_axes& start);
  /** What one cycle gave out. */
  void cycle(const nc_outputs& out);
  /** The axes stand where they are from now on: what the last stop asks of them is seen too. */
  void end();

  uint64_t cycles() const { return cycles_; }
  /** Largest value of a curve so far: 0 = path speed, 1 + 2 i = acceleration of axis i (either sign), 2 + 2 i
   * = its jerk. */
  double peak(size_t curve) const;

  /** The limit that the mode keeps of this curve; 0 = it keeps none. */
  double limit(size_t curve) const { return curves_[curve].limit; }

  /** Write the drawing. @return false with *error when the file cannot be written. */
  bool write_svg(const std::string& path, std::string* error) const;
  bool write_png(const std::string& path, std::string* error) const;

  static constexpr size_t kBuckets = 4096;

 private:
  friend class ProfilePainter;
  struct Range {
    float low, high;
  };
  struct Curve {
    std::string name, unit;
    double limit;  // 0 = none
    std::vector<Range> range;
  };
  void add(const nc_axes& position);
  void add(size_t curve, double value, bool first);
  void halve();

  const nc_system_config& system_;
  double cycle_s_;
  MotionCycles rows_;
  nc_axes last_ = {}, velocity_ = {}, acceleration_ = {};
  bool linear_ = false;  // there are linear axes: the path speed is theirs
  std::vector<Curve> curves_;
  uint64_t cycles_ = 0, per_bucket_ = 1;
  std::string title_ = "Motion";
};

}  // namespace nc::tools
