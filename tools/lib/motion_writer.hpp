// SPDX-License-Identifier: Apache-2.0
// The commanded position of every axis in every cycle, as CSV or as raw doubles (docs/trace.md, "Motion").
#pragma once

#include <cstdint>

#include "nc/nc.h"
#include "tools/lib/output_file.hpp"

namespace nc::tools {

enum class MotionFormat { kCsv, kF64 };

/**
 * Decides which cycles count: those in which the time of the program goes on (nc_outputs::run_s) or an axis moves. The
 * cycles in which a block stop waits for cycle start do not count.
 */
class MotionCycles {
 public:
  explicit MotionCycles(unsigned axis_count) : axis_count_(axis_count) {}
  void begin(const nc_axes& start) { last_ = start; }
  bool counts(const nc_outputs& out);

 private:
  unsigned axis_count_;
  nc_axes last_ = {};
  double last_run_s_ = 0.0;
};

/** Writes rows; the OutputFile keeps errors. */
class MotionWriter {
 public:
  MotionWriter(OutputFile* out, const nc_config& config, MotionFormat format);

  /** Writes the head and the row for t = 0: the position before the first cycle. */
  void begin(const nc_axes& start);
  /** Writes a row for one cycle, if it counts. */
  void cycle(const nc_outputs& out);

  uint64_t rows() const { return rows_; }

 private:
  void row(const nc_axes& position);

  OutputFile& out_;
  const nc_system_config& system_;
  double cycle_s_;
  MotionFormat format_;
  MotionCycles cycles_;
  uint64_t rows_ = 0;
};

}  // namespace nc::tools
