// SPDX-License-Identifier: Apache-2.0
// Path speed, and acceleration and jerk of every axis over time, from the positions of the cycles; as SVG and
// as PNG.
//
// All curves are finite differences of the commanded positions, which the drives get. The time is divided into at
// most kBuckets pieces, and of each the lowest and the highest value are kept. So a peak of one cycle is drawn even when
// the program runs for a long time.
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

  /** Sets the position before the first cycle. */
  void begin(const nc_axes& start);
  /** Takes the outputs of one cycle. */
  void cycle(const nc_outputs& out);
  /** Ends the curves with the axes at rest, so that acceleration and jerk of the last stop are included. */
  void end();

  uint64_t cycles() const { return cycles_; }
  /** Largest absolute value of a curve so far: 0 = path speed, 1 + 2 i = acceleration of axis i, 2 + 2 i = its
   * jerk. */
  double peak(size_t curve) const;

  /** The limit of this curve that the mode of motion keeps; 0 = none. */
  double limit(size_t curve) const { return curves_[curve].limit; }

  /** Writes the drawing. @return false with *error when the file cannot be written. */
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
  bool linear_ = false;  // there are linear axes; then the path speed is the speed of these
  std::vector<Curve> curves_;
  uint64_t cycles_ = 0, per_bucket_ = 1;
  std::string title_ = "Motion";
};

}  // namespace nc::tools
