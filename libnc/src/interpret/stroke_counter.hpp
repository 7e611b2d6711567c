// SPDX-License-Identifier: Apache-2.0
// Strokes of holes that are only counted. Who passes over moves (nc_pull_past()) needs no item for each of them, and a hole has several: they are told to it one by
// one instead, as long as nothing else is under way. What it does not take becomes an item as ever, so the stream is the same either way.
#pragma once

#include "stream/stream.hpp"

namespace nc {

struct BlockContext;
struct CycleStep;

/// Functions of who counts. Where one says false nothing has changed, and an item has to be made.
struct StrokeCounter {
  void* user = nullptr;
  /// The axes stand at this machine position: strokes begin there.
  bool (*stands)(void* user, const AxisVec& machine) = nullptr;
  /// One axis goes to this machine coordinate, in rapid traverse or with a feed in mm/min.
  bool (*stroke)(void* user, unsigned axis, double to, bool rapid, double feed) = nullptr;
  /// A place where single block may stop.
  bool (*stop_point)(void* user) = nullptr;
  /// What has been counted in this step stands here. The last stroke, if there was one, ends at this place in workpiece coordinates; nullptr: there was none.
  void (*end)(void* user, const nc_source& source, const AxisVec* work) = nullptr;
};

/// The strokes of a hole that are made in one step.
class CountedStrokes {
 public:
  /// Looks whether strokes can be counted that are made now: none is held back by a stage, and nothing but its end and its feed matters.
  explicit CountedStrokes(BlockContext& in);
  /// This is the end of the step.
  void end();
  /// True: the axis is at the end of this stroke along it.
  bool take(const CycleStep& step);
  /// True: the place behind it has been counted.
  bool take_stop_point();

 private:
  BlockContext& in_;
  const StrokeCounter* counter_ = nullptr;  ///< nullptr: none is counted
  unsigned axis_ = 0;
  bool taken_ = false, any_ = false;  ///< a stroke, or anything, has been counted
  double offset_ = 0, feed_ = 0;
  double work_ = 0;   ///< where the axis stands, as programmed
};

}  // namespace nc
